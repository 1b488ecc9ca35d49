"""The tables of the study's non-dimensional parameters (eq. 20, Table 1 of the paper) and of indenters.

Validation, coordinate attributes, axis labels, the command line's help and the documentation all read
them; none of them repeats a name, a symbol, a default or a range.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TypeGuard


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
        "number", "ratio" (a rational number p/q), or "name": built in, or of what the user has defined.
    part
        What it is a part of: "load", "shape" (of the indenter), "body" (what the two bodies are made of),
        "bulk" (the bulk stress of one body), "criterion", "quantity" (of what is computed beside s), or
        "contact" (of a real one).
    units
        CF units: "1", or "rad" for the phase.
    scale
        What it is measured in where it is a length, a force or a stress, a key of
        `swtstudy.units.scales.SCALES`; else empty.
    instead_of
        The parameter whose place it takes: one of the two is given. Else empty.
    note
        What else there is to know, in one line.
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
    part: str = "load"
    units: str = "1"
    scale: str = ""
    instead_of: str = ""
    optional: bool = False
    note: str = ""

    def goes_without_saying(self, value: object) -> bool:
        """Whether a value means that the scene lacks what the parameter is about."""
        return self.optional and value == self.default

    @property
    def notation(self) -> str:
        """Its symbol as plain text, over what it is measured in; empty for a name.

        Examples
        --------
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
        if self.kind == "name":
            return "one of " + ", ".join(BUILT_IN[self.name])
        interval = f"{'(' if self.open_lower else '['}{self.lower:g}, {self.upper:g}]"
        if self.kind == "ratio":
            return f"a positive rational p/q with p, q ≤ {self.upper:g}"
        if self.units == "rad":
            return f"a finite angle in {interval} rad"
        return f"a number in {interval}"


def _greek(name: str) -> str:
    return unicodedata.lookup(f"GREEK SMALL LETTER {name.upper().replace('LAMBDA', 'LAMDA')}")


#: The load of the paper.
HARMONIC = "harmonic"
#: Amplitudes of a loop that are not given: its vertices are the loads themselves.
LOOP_AMPLITUDE = 1.0

#: Largest numerator and denominator of a frequency ratio: the common period grows with them.
LARGEST_FREQUENCY_TERM = 64

PARAMETERS: dict[str, Parameter] = {
    p.name: p
    for p in (
        Parameter("poisson_ratio", r"\nu", "ν", "Poisson ratio", 0.3, 0.0, 0.5, part="body"),
        Parameter("friction", r"\mu", "μ", "coefficient of friction", 0.3, 0.0, 10.0, part="body"),
        Parameter(
            "normal_amplitude",
            r"\delta_A/\delta_0",
            "δA",
            "amplitude of the normal oscillation",
            0.75,
            0.0,
            10.0,
            scale="δ0",
        ),
        Parameter(
            "normal_force_amplitude",
            r"F_A/F_0",
            "FA",
            "amplitude of the normal force",
            None,
            0.0,
            10.0,
            scale="F0",
            instead_of="normal_amplitude",
        ),
        Parameter(
            "frequency_ratio",
            r"\omega_2/\omega_1",
            "ω2",
            "frequency of the tangential over that of the normal oscillation",
            1.0,
            0.0,
            LARGEST_FREQUENCY_TERM,
            open_lower=True,
            kind="ratio",
        ),
        Parameter(
            "tangential_amplitude",
            r"G^* u_A/(\mu E^* \delta_0)",
            "uA",
            "amplitude of the tangential oscillation",
            5 / 6,
            0.0,
            100.0,
            scale="μ E* δ0/G*",
            note="along an axis of friction it stays, so that uA itself moves with μ",
        ),
        Parameter(
            "tangential_force_amplitude",
            r"Q_A/(\mu F_0)",
            "QA",
            "amplitude of the tangential force",
            None,
            0.0,
            100.0,
            scale="μ F0",
            instead_of="tangential_amplitude",
            note="along an axis of friction it stays, so that QA itself moves with μ",
        ),
        Parameter(
            "phase", r"\psi", "ψ", "phase of the normal oscillation", 0.0, -1000.0, 1000.0, units="rad"
        ),
        Parameter(
            "load",
            r"\mathrm{load}",
            "load",
            "course of the load: two harmonic oscillations, or the name of a loop",
            HARMONIC,
            kind="name",
            optional=True,
        ),
        Parameter("profile", "f", "f", "profile of the indenter", "paraboloid", kind="name", part="shape"),
        Parameter(
            "flat_radius",
            r"b/a_H",
            "b",
            "radius of the punch face",
            None,
            0.0,
            20.0,
            part="shape",
            scale="a_H",
        ),
        Parameter(
            "waviness_amplitude",
            r"h/\delta_0",
            "h",
            "amplitude of the waviness",
            None,
            0.0,
            10.0,
            part="shape",
            scale="δ0",
        ),
        Parameter(
            "wavelength",
            r"\lambda/\sqrt{hR}",
            "λ",
            "wavelength of the waviness",
            None,
            0.0,
            1000.0,
            open_lower=True,
            part="shape",
            scale="√(hR)",
        ),
        Parameter(
            "exponent", "n", "n", "exponent of the power law", None, 1.0, 20.0, open_lower=True, part="shape"
        ),
        Parameter(
            "bulk_stress_amplitude",
            r"\sigma_{B,A}/(E^* \delta_0/a_H)",
            "BA",
            "amplitude of the bulk stress, with the tangential frequency",
            0.0,
            0.0,
            10.0,
            part="bulk",
            optional=True,
            scale="E* δ0/a_H",
        ),
        Parameter(
            "bulk_stress_mean",
            r"\sigma_{B,m}/(E^* \delta_0/a_H)",
            "Bm",
            "mean of the bulk stress",
            0.0,
            -10.0,
            10.0,
            part="bulk",
            optional=True,
            scale="E* δ0/a_H",
        ),
        Parameter(
            "bulk_stress_phase",
            r"\psi_B",
            "ψB",
            "phase of the bulk stress against the tangential oscillation",
            0.0,
            -1000.0,
            1000.0,
            part="bulk",
            optional=True,
            units="rad",
        ),
        Parameter(
            "walker_exponent",
            r"\gamma",
            "γ",
            "Walker exponent",
            0.5,
            0.0,
            0.9,
            open_lower=True,
            part="criterion",
            optional=True,
        ),
    )
}

#: Into the body from the critical point: straight down, or along the critical plane.
DIRECTIONS = ("depth", "critical_plane")

#: Parameters of which one of two is given, by the one that takes the other's place.
PAIRS: dict[str, str] = {
    name: parameter.instead_of for name, parameter in PARAMETERS.items() if parameter.instead_of
}


def replaced_by(names: Iterable[str]) -> set[str]:
    """The parameters whose places are taken by some of these."""
    return {PAIRS[name] for name in names if name in PAIRS}


@dataclass(frozen=True)
class Control:
    """What is prescribed in each direction: a displacement, or a force.

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
        """Whether a force and a displacement are prescribed."""
        return self.normal_force != self.tangential_force

    @property
    def name(self) -> str:
        """Value of the coordinate ``control``."""
        return CONTROLS[self]

    def given_for(self, name: str) -> str:
        """The parameter that is given in the place of one; that one itself where no force is."""
        forces = {"normal_amplitude": self.normal_force, "tangential_amplitude": self.tangential_force}
        return next(force for force, other in PAIRS.items() if other == name) if forces.get(name) else name


#: What the paper prescribes.
DISPLACEMENTS = Control()

#: The names of what is prescribed.
CONTROLS: dict[Control, str] = {
    DISPLACEMENTS: "displacements",
    Control(True, True): "forces",
    Control(True, False): "normal_force+tangential_displacement",
    Control(False, True): "normal_displacement+tangential_force",
}

#: Names by letter.
LETTERS: dict[str, str] = {parameter.letter: name for name, parameter in PARAMETERS.items()}


@dataclass(frozen=True)
class Family:
    """One family of indenters (eqs. 3–6); its class is in `swtstudy.mechanics.indenter.PROFILES`.

    Attributes
    ----------
    name
        Value of the parameter ``profile``.
    shape
        The shape parameters κ_i that it has.
    plain
        The shape parameter and its value that make it the `PLAIN` family, whatever the others are; None for
        none.
    """

    name: str
    shape: tuple[str, ...] = ()
    plain: tuple[str, float] | None = None


FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        Family("paraboloid"),
        Family("rounded_punch", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("truncated_paraboloid", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("wavy_paraboloid", ("waviness_amplitude", "wavelength"), plain=("waviness_amplitude", 0.0)),
        Family("power_law", ("exponent",), plain=("exponent", 2.0)),
    )
}

#: The family of what the user has defined.
TABLE = Family("table")

#: The family that others are at their plain shape.
PLAIN = "paraboloid"

#: The built-in names, by the parameter that has names.
BUILT_IN: dict[str, tuple[str, ...]] = {
    "profile": tuple(FAMILIES),
    "load": (HARMONIC,),
    "direction": DIRECTIONS,
}


def is_profile(raw: object) -> TypeGuard[str]:
    """Whether something is the name of a profile."""
    return isinstance(raw, str) and raw in FAMILIES


def family_of(profile: object) -> Family:
    """The family of a profile, or of that of a name; what the user has defined has no shape parameters."""
    return FAMILIES.get(str(profile), TABLE)


def families_with(name: str) -> list[str]:
    """Names of the families that have a shape parameter."""
    return [family.name for family in FAMILIES.values() if name in family.shape]


def spelled(symbol: str) -> str:
    """A symbol as one may type it: no LaTeX, Greek letters by name, letters and digits alone.

    Examples
    --------
    >>> spelled("δ_A"), spelled(r"G^* u_A"), spelled("λ")
    ('deltaa', 'gua', 'lambda')
    """
    # NFKC makes a keyboard's µ the letter μ; Unicode writes lambda without its b.
    words = (
        unicodedata.name(c).split()[-1].replace("LAMDA", "LAMBDA") if "α" <= c.lower() <= "ω" else c
        for c in unicodedata.normalize("NFKC", symbol)
    )
    return "".join(c for c in "".join(words).lower() if c.isalnum())


#: Name and letter of a parameter by what may be typed for it: its letter, its symbol, the numerator of that.
SYMBOLS: dict[str, tuple[str, str]] = {
    spelled(symbol): (parameter.name, parameter.letter)
    for parameter in PARAMETERS.values()
    for symbol in (parameter.letter, parameter.symbol, parameter.symbol.split("/")[0])
}
