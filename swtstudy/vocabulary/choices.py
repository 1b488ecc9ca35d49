"""Names to choose from: families of indenters, of revolution (eqs. 3–6) and plane, criteria, shifts, figures.

Their formulas are in `swtstudy.profiles.families` and `swtstudy.kernel.criterion`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import NamedTuple, TypeGuard

#: Kinds of contact: a disc, or a strip in plane strain.
AXISYMMETRIC, PLANE = GEOMETRIES = ("axisymmetric", "plane")


@dataclass(frozen=True)
class Family:
    """One family of indenters; its form is in `swtstudy.profiles.families.FORMS`.

    Attributes
    ----------
    name
        Value of the parameter ``profile``.
    shape
        The shape parameters κ_i that it has.
    plain
        The shape parameter and its value that make it the `PLAIN` family of its geometry, whatever the
        others are; None for none.
    geometry
        One of `GEOMETRIES`.
    """

    name: str
    shape: tuple[str, ...] = ()
    plain: tuple[str, float] | None = None
    geometry: str = AXISYMMETRIC


FAMILIES: dict[str, Family] = {
    family.name: family
    for family in (
        Family("paraboloid"),
        Family("rounded_punch", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("truncated_paraboloid", ("flat_radius",), plain=("flat_radius", 0.0)),
        Family("wavy_paraboloid", ("waviness_amplitude", "wavelength"), plain=("waviness_amplitude", 0.0)),
        Family("power_law", ("exponent",), plain=("exponent", 2.0)),
        Family("cylinder", geometry=PLANE),
        Family("rounded_flat", ("flat_half_width",), ("flat_half_width", 0.0), PLANE),
        Family("wavy_cylinder", ("waviness_amplitude", "wavelength"), ("waviness_amplitude", 0.0), PLANE),
        Family("power_law_cylinder", ("exponent",), ("exponent", 2.0), PLANE),
    )
}

#: The family of what the user has defined.
TABLE = Family("table")

#: The families that others of their geometry are at their plain shape.
PLAIN, PLAIN_STRIP = "paraboloid", "cylinder"
PLAIN_OF = {AXISYMMETRIC: PLAIN, PLANE: PLAIN_STRIP}


def is_profile(raw: object) -> TypeGuard[str]:
    """Return whether something is the name of a profile."""
    return isinstance(raw, str) and raw in FAMILIES


def family_of(profile: object) -> Family:
    """The family of a profile or of its name; what the user has defined has no shape parameters."""
    return FAMILIES.get(str(profile), TABLE)


def is_plane(profile: object) -> bool:
    """Return whether a profile, or its name, stands for a plane contact."""
    return getattr(profile, "geometry", family_of(profile).geometry) == PLANE


def families_with(name: str) -> list[str]:
    """Names of the families that have a shape parameter."""
    return [family.name for family in FAMILIES.values() if name in family.shape]


class Drawing(NamedTuple):
    """A kind of figure.

    Attributes
    ----------
    of
        Whether it shows "lines", a "surface" over x and vertical, or a "sample".
    words
        A reader's words for it.
    lacks
        The keys of a figure that it has none of, and the reason.
    over
        Words for what it is drawn over, instead of x.
    """

    of: str
    words: str
    lacks: Mapping[str, str]
    over: str = ""


_UPRIGHT = {"vertical": ", whose vertical axis is y"}
_CONTOUR = '; kind = "contour" draws borders of regimes, and y = "regime" the regimes themselves'
#: The kinds of figures.
FIGURES = {
    "lines": Drawing("lines", "lines over x", _UPRIGHT),
    "life": Drawing("lines", "lines with x upright over a life, as S–N curves", {**_UPRIGHT, "regimes": ""}),
    "contour": Drawing("surface", "contours over x and vertical", {"hue": ""}),
    "heatmap": Drawing(
        "surface", "a cell for each point over x and vertical", {"hue": "", "regimes": _CONTOUR}
    ),
    "scatter": Drawing(
        "sample",
        "the points of a sample, with a panel for each of its parameters",
        {**_UPRIGHT, "panels": ": every sampled parameter has its own", "regimes": ""},
        "over each sampled parameter",
    ),
    "histogram": Drawing(
        "sample",
        "how often a sample has which values",
        {**_UPRIGHT, "regimes": "", "validity": ""},
        "at the points of the sample",
    ),
}


#: Regimes of the contact over the stationary cycle, in the order of their flag values.
REGIMES = ("stick", "partial_slip", "gross_slip", "lift_off", "not_finite", "no_equilibrium")
#: Those in which s is no finite number.
WITHOUT_S = ("not_finite", "no_equilibrium")

#: Whether a bulk stress moves the stick zone, where that is known, or leaves it in its place.
MOVED, NONE = SHIFTS = ("moved", "none")


class Swing(NamedTuple):
    """The swing of a plane: its name as a variable, a reader's words for it, and its symbol in LaTeX."""

    name: str
    words: str
    symbol: str


class Criterion(NamedTuple):
    """A criterion; its formula is in `swtstudy.kernel.criterion`.

    Attributes
    ----------
    words, symbol
        A reader's words for it, and its symbol in LaTeX.
    degree
        With which power of the stress it goes: with 2 its unit is stress times strain, with 1 stress.
    swing
        The quantity that swings on a plane.
    values
        A reader's words for its values.
    meaning, over_unit
        The meaning of s, in words for attributes, and its symbol over its unit.
    name, sign, unit, scale
        Of its values with units the data variable, its symbol, the kind of unit, "stress" or "1", and the
        property of a contact at rest that is the factor of s.
    life, subscript, by, constants
        Of the life at a value the data variable, the index of its symbol, words for the criterion behind it,
        and the facts of contacts of which one gives it; empty where there is no life.
    limit, usage
        The limits that its values are compared with, a fact of contacts, and the data variable that compares
        them; empty where there are none.
    normal_unit
        The strength, a fact of contacts, over which its normal stress is taken; empty if that stays a stress.
    """

    words: str
    symbol: str
    degree: int
    swing: Swing
    values: str
    meaning: str
    over_unit: str
    name: str
    sign: str
    unit: str
    scale: str
    life: str = ""
    subscript: str = ""
    by: str = ""
    constants: tuple[str, ...] = ()
    limit: str = ""
    usage: str = ""
    normal_unit: str = ""


NORMAL_STRAIN = Swing("normal_strain", "strain normal to the plane", r"\varepsilon_n")
SHEAR_STRESS = Swing("shear_stress", "shear stress on the plane", r"\tau")
#: Names of the Smith–Watson–Topper parameter and of the criteria of shear.
SWT, FATEMI_SOCIE, FINDLEY = "swt", "fatemi_socie", "findley"
CRITERIA = {
    SWT: Criterion(
        "Smith-Watson-Topper parameter",
        "swt",
        2,
        NORMAL_STRAIN,
        "SWT",
        "maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R",
        r"\mathrm{SWT}/\mathrm{SWT}_0",
        *("SWT", r"\mathrm{SWT}", "stress", "swt_of"),
        life="cycles",
        constants=("materials",),
    ),
    FATEMI_SOCIE: Criterion(
        "Fatemi-Socie parameter",
        r"\mathrm{FS}",
        1,
        SHEAR_STRESS,
        "Fatemi-Socie parameter",
        "maximum Fatemi-Socie parameter times G over E* delta0 / a_H",
        r"G \mathrm{FS}/(E^*\delta_0/a_H)",
        *("FS", r"\mathrm{FS}", "1", "strain_of"),
        life="FS_cycles",
        subscript="FS",
        by=" by Fatemi and Socie",
        constants=("materials", "shear_materials"),
        normal_unit="yield_strengths",
    ),
    FINDLEY: Criterion(
        "Findley stress",
        "f",
        1,
        SHEAR_STRESS,
        "Findley stress",
        "maximum Findley stress over E* delta0 / a_H",
        r"f/(E^*\delta_0/a_H)",
        *("findley_stress", "f", "stress", "stress_scale"),
        limit="findley_limits",
        usage="findley_usage",
    ),
}


def without_life(criteria: Collection[object]) -> str:
    """Names of the criteria if there are some and none of them has a life; else empty."""
    lives = any(CRITERIA[str(name)].life for name in criteria)
    return "" if lives else ", ".join(map(str, criteria))


#: Where a criterion of shear may be larger than s (results/audit_criteria_box.md).
BENEATH = (
    "a criterion of shear may be larger beside that line or beneath the surface, where friction is below "
    "0.3, the Poisson ratio below 0.1 or the tangential motion small: swtstudy audit compares"
)
#: The profile at whose sharp edge only SWT may be finite while it slips.
SHARP = "truncated_paraboloid"


def with_values_of(text: str, value: str) -> str:
    """A text about SWT in which another criterion's values have replaced swt.

    Examples
    --------
    >>> with_values_of("mean of swt/SWT0 over depth, about the largest swt", "Findley stress")
    'mean of Findley stress in the unit of s over depth, about the largest Findley stress'
    """
    return re.sub(r"\b(?:swt|SWT)\b", value, text.replace("swt/SWT0", f"{value} in the unit of s"))
