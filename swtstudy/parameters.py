"""The one table of the study's non-dimensional parameters (eq. 20, Table 1 of the paper).

Validation, coordinate attributes, axis labels, the command line's help and the documentation all read
it; none of them repeats a name, a symbol, a default or a range.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass


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
        "number", "ratio" (a rational number p/q) or "profile".
    part
        What it is a part of: "load", "shape" (of the indenter), or "body" (what the two bodies are made of).
    units
        CF units: "1", or "rad" for the phase.
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

    @property
    def allowed(self) -> str:
        """The allowed range in words, for messages and help."""
        if self.kind == "profile":
            return "one of " + ", ".join(PROFILE_SHAPES)
        interval = f"{'(' if self.open_lower else '['}{self.lower:g}, {self.upper:g}]"
        if self.kind == "ratio":
            return f"a positive rational p/q with p, q ≤ {self.upper:g}"
        if self.units == "rad":
            return f"a finite angle in {interval} rad"
        return f"a number in {interval}"


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
        ),
        Parameter(
            "phase", r"\psi", "ψ", "phase of the normal oscillation", 0.0, -1000.0, 1000.0, units="rad"
        ),
        Parameter("profile", "f", "f", "profile of the indenter", "paraboloid", kind="profile", part="shape"),
        Parameter("flat_radius", r"b/a_H", "b", "radius of the punch face", None, 0.0, 20.0, part="shape"),
        Parameter(
            "waviness_amplitude",
            r"h/\delta_0",
            "h",
            "amplitude of the waviness",
            None,
            0.0,
            10.0,
            part="shape",
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
        ),
    )
}

#: Names by letter.
LETTERS: dict[str, str] = {parameter.letter: name for name, parameter in PARAMETERS.items()}

#: Every profile with the shape parameters κ_i that it has (eqs. 3–6).
PROFILE_SHAPES: dict[str, tuple[str, ...]] = {
    "paraboloid": (),
    "rounded_punch": ("flat_radius",),
    "truncated_paraboloid": ("flat_radius",),
    "wavy_paraboloid": ("waviness_amplitude", "wavelength"),
}


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


def profiles_with(name: str) -> list[str]:
    """The profiles that have a shape parameter."""
    return [profile for profile, names in PROFILE_SHAPES.items() if name in names]
