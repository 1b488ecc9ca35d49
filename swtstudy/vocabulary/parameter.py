"""One named parameter: its symbols, meaning, default and range."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from textwrap import shorten


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

    def __post_init__(self) -> None:
        if self.names:
            object.__setattr__(self, "kind", "name")

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
