"""The table of the study's non-dimensional parameters (eq. 20, Table 1), which are prescribed, and axes.

Validation, coordinate attributes, axis labels, the command line's help and the documentation all read it;
none of them repeats a name, a symbol, a default or a range. In each direction a displacement or a force is
prescribed: the names of the parameters say which. An axis, everything that a dimension of results may be, is
a parameter, or what only some results range over.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections import ChainMap
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from textwrap import shorten
from typing import NamedTuple

from swtstudy.vocabulary.choices import CRITERIA, FAMILIES, SHIFTS
from swtstudy.vocabulary.files import read_table


@dataclass(frozen=True)
class Parameter:
    """One non-dimensional parameter.

    Attributes
    ----------
    name
        Name of the dimension, the keyword and the TOML key.
    symbol
        Symbol as in the paper, LaTeX without dollar signs.
    letter
        The paper's letter, which may stand for the name in a place such as ``s/s(b=0)``.
    meaning
        One line, used as ``long_name`` and in help texts.
    default
        Value of Table 1; None for a shape parameter that its profile requires.
    lower, upper
        Allowed range, in the unit of the parameter.
    open_lower
        True if ``lower`` itself is not allowed.
    kind
        "number", "ratio" (a rational number p/q), or, with names, "name": built in, or of what the user has
        defined.
    names
        The built-in ones of a name.
    part
        Its part of the scene: "load", "shape" (of the indenter), "body" (what the two bodies are made of),
        "bulk" (the bulk stress of one body), "criterion", "quantity" (of what is computed beside s), or
        "contact" (of a real one).
    units
        CF units: "1", or "rad" for the phase.
    scale
        Its scale where it is a length, a force or a stress, a key of
        `swtstudy.study.units.rows.SCALES`; else empty.
    instead_of
        The parameter whose place it takes: one of the two is given. Else empty.
    note
        A further remark, in one line.
    optional
        Whether the default means that the scene lacks it: results leave it out at its default.
    """

    name: str
    symbol: str
    letter: str
    meaning: str
    default: float | str | None = None
    lower: float = 0.0
    upper: float = 1.0
    open_lower: bool = False
    kind: str = "number"
    names: tuple[str, ...] = ()
    part: str = "load"
    units: str = "1"
    scale: str = ""
    instead_of: str = ""
    optional: bool = False
    note: str = ""
    words: str = ""

    def goes_without_saying(self, value: object) -> bool:
        """Return whether a value means that the scene lacks the parameter's subject."""
        return self.optional and value == self.default

    @property
    def notation(self) -> str:
        """Its symbol as plain text, over what it is measured in; empty for a name.

        Examples
        --------
        >>> from swtstudy.vocabulary.parameters import PARAMETERS
        >>> [PARAMETERS[name].notation for name in ("normal_amplitude", "wavelength", "tangential_amplitude")]
        ['δA/δ0', 'λ/√(hR)', 'G*uA/(μE*δ0)']
        """
        if self.kind == "name":
            return ""
        words = re.sub(r"\\mathrm\{(\w+)\}", r"\1", self.symbol)
        words = re.sub(r"\\sqrt\{(\w+)\}", r"√(\1)", words.replace(r"\ell", "ℓ"))
        words = re.sub(r"\\([a-z]+)", lambda found: _greek(found[1]), words)
        return re.sub(r"_(?!H)|[\^{}, ]", "", words)

    @property
    def described(self) -> str:
        """The meaning with the symbol: which number is asked for."""
        return ", ".join(filter(None, (self.meaning, self.notation)))

    @property
    def allowed(self) -> str:
        """The allowed range in words, for messages and help."""
        return " ".join(filter(None, self._allowed))

    @property
    def _allowed(self) -> tuple[str, str]:
        """The kind of value, empty where the range says it, and the range."""
        interval = f"{'(' if self.open_lower else '['}{self.lower:g}, {self.upper:g}]"
        if self.words:
            return "", self.words
        if self.kind == "name":
            return "one of", ", ".join(self.names)
        if self.kind == "ratio":
            return "a positive rational", f"p/q with p, q ≤ {self.upper:g}"
        if self.units == "rad":
            return "a finite angle", f'in {interval} rad, or "90 deg"'
        return "a number", f"in {interval}"

    @property
    def explained(self) -> str:
        """The meaning, the range and the default as a sentence, for docstrings and lists."""
        default = "" if self.default is None else f"default {short(self.default)}"
        return f"{'; '.join(filter(None, (self.described, self.note, self.allowed, default)))}."

    @property
    def brief(self) -> str:
        """The symbol, the range and the default in half a line of a terminal, for help.

        Examples
        --------
        >>> from swtstudy.vocabulary.parameters import PARAMETERS
        >>> for name in ("phase", "profile", "exponent"):
        ...     print(PARAMETERS[name].brief)
        ψ in [-1000, 1000] rad, or "90 deg"  [0]
        paraboloid, rounded_punch, …  [paraboloid]
        n in (1, 20]
        """
        default = "" if self.default is None else f"  [{short(self.default)}]"
        allowed = shorten(self._allowed[1], 34, placeholder=" …")
        return f"{self.notation} {allowed}{default}".strip()


def short(value: object) -> str:
    """A number with six digits; any other value as it is."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _greek(name: str) -> str:
    return unicodedata.lookup(f"GREEK SMALL LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")


def spelled(symbol: str) -> str:
    """A symbol as one may type it: no LaTeX, Greek letters by name, letters and digits alone.

    Examples
    --------
    >>> spelled("δ_A"), spelled(r"G^* u_A"), spelled("λ"), spelled("α"), spelled("Ω")
    ('deltaa', 'gua', 'lambda', 'alpha', 'omega')
    """
    # NFKC makes a keyboard's µ the letter μ; Unicode writes lambda without its b.
    words = (
        unicodedata.name(c).split()[-1].replace("LAMDA", "LAMBDA") if "α" <= c.lower() <= "ω" else c
        for c in unicodedata.normalize("NFKC", symbol)
    )
    return "".join(c for c in "".join(words).lower() if c.isalnum())


#: The load of the paper.
HARMONIC = "harmonic"
#: Amplitudes of a loop that are not given: its vertices are the loads themselves.
LOOP_AMPLITUDE = 1.0

#: The parameters that say whether a bulk stress moves the stick zone, and by how much its body strains.
SHIFT, STRAIN_SHARE = "stick_zone_shift", "bulk_strain_share"
#: Into the body from the critical point: straight down, or along the critical plane.
DIRECTIONS = ("depth", "critical_plane")

_NAMES = {
    "load": (HARMONIC,),
    "profile": tuple(FAMILIES),
    SHIFT: SHIFTS,
    "criterion": tuple(CRITERIA),
    "direction": DIRECTIONS,
}
_ROWS = [
    Parameter(name, names=_NAMES.get(name, ()), **row)
    for name, row in read_table(__file__, "parameters").items()
]
#: Dimensions of quantities beside s that the points do not have.
QUANTITY_AXES = {row.name: row for row in _ROWS if row.part == "quantity"}
#: Parameters of real contacts alone. The study names their units: see `swtstudy.study.units.rows`.
CONTACT_AXES = {row.name: row for row in _ROWS if row.part == "contact"}
PARAMETERS = {row.name: row for row in _ROWS if row.part not in ("quantity", "contact")}
AXES: Mapping[str, Parameter] = ChainMap(PARAMETERS, QUANTITY_AXES, CONTACT_AXES)

#: Names by letter; if names share a letter, the first of them.
LETTERS: dict[str, str] = {parameter.letter: name for name, parameter in reversed(PARAMETERS.items())}


#: Parameters of which one of two is given, by the one that takes the other's place.
PAIRS: dict[str, str] = {
    name: parameter.instead_of for name, parameter in PARAMETERS.items() if parameter.instead_of
}
#: The one of two that is a force, by the one whose place it takes.
FORCE_OF = {other: force for force, other in PAIRS.items()}
#: The two of the normal load.
NORMAL_AMPLITUDES = frozenset({"normal_amplitude", "normal_force_amplitude"})


def replaced_by(names: Iterable[str]) -> set[str]:
    """The parameters whose places are taken by some of these."""
    return {PAIRS[name] for name in names if name in PAIRS}


class Control(NamedTuple):
    """The quantities prescribed in the two directions, each a displacement or a force.

    A normal force is in units of that at the depth δ0, a tangential one in μ times that.

    Attributes
    ----------
    normal_force, tangential_force
        Whether it is a force.
    """

    normal_force: bool = False
    tangential_force: bool = False

    @classmethod
    def given(cls, names: Iterable[str]) -> Control:
        """From the names of the parameters that are given."""
        found = set(names)
        return cls("normal_force_amplitude" in found, "tangential_force_amplitude" in found)

    @property
    def mixed(self) -> bool:
        """True if one direction has a force and the other a displacement."""
        return self.normal_force != self.tangential_force

    @property
    def name(self) -> str:
        """Value of the coordinate ``control``."""
        return CONTROLS[self]

    def given_for(self, name: str) -> str:
        """The force that is given instead of a displacement; the displacement itself where no force is."""
        forces = {"normal_amplitude": self.normal_force, "tangential_amplitude": self.tangential_force}
        return FORCE_OF[name] if forces.get(name) else name


#: The control of the paper: both displacements are prescribed.
DISPLACEMENTS = Control()

#: The names of what is prescribed.
CONTROLS: dict[Control, str] = {
    DISPLACEMENTS: "displacements",
    Control(True, True): "forces",
    Control(True, False): "normal_force+tangential_displacement",
    Control(False, True): "normal_displacement+tangential_force",
}

#: An angle beyond so many rad is probably meant in degrees.
MANY_TURNS = 8.0 * math.pi
#: Units of an angle that is not in rad.
DEGREES = ("degrees", "deg", "°")

#: Name and letter of a parameter by what may be typed for it: its letter, its symbol, the numerator of that.
SYMBOLS: dict[str, tuple[str, str]] = {
    spelled(symbol): (row.name, row.letter)
    for row in (*CONTACT_AXES.values(), *reversed(PARAMETERS.values()))
    for symbol in (row.letter, row.symbol, row.symbol.split("/")[0])
}
#: And the names of values, with the words that others have for them.
SYMBOLS |= {word.lower(): ("paraboloid", word) for word in ("sphere", "ball", "Hertz")}
SYMBOLS |= {"fs": ("fatemi_socie", "FS")} | {word: ("cycles", "N") for word in ("life", "lifetime", "nf")}
#: Parameters by a symbol of others, in either case of letters; the first ones have units.
OTHER_SYMBOLS: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("P", "P0", "F", "N", "Fn", "W"), ("normal_force", "normal_force_amplitude")),
    **dict.fromkeys(("Q", "Q0", "T", "Ft"), ("tangential_force_amplitude",)),
    **dict.fromkeys(("u", "U", "d", "stroke"), ("tangential_amplitude",)),
    **dict.fromkeys(("f", "cof", "COF"), ("friction", "profile")),
}
