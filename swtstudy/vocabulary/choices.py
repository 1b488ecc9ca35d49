"""Names to choose from: families of indenters, of revolution (eqs. 3–6) and plane, criteria, shifts, figures.

Their formulas are in `swtstudy.vocabulary.families` and `swtstudy.kernel.criterion`.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from typing import NamedTuple

from swtstudy.vocabulary.files import read_table

#: Kinds of contact: a disc, or a strip in plane strain.
AXISYMMETRIC, PLANE = GEOMETRIES = ("axisymmetric", "plane")


class Family(NamedTuple):
    """One family of indenters; its form is in `swtstudy.vocabulary.families.FORMS`.

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


FAMILIES = {name: Family(name, **row) for name, row in read_table(__file__, "families").items()}

#: The families that others of their geometry are at their plain shape.
PLAIN, PLAIN_STRIP = "paraboloid", "cylinder"
PLAIN_OF = {AXISYMMETRIC: PLAIN, PLANE: PLAIN_STRIP}


def family_of(profile: object) -> Family:
    """The family of a profile or of its name; what the user has defined has no shape parameters."""
    return FAMILIES.get(str(profile), Family("table"))


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
    drawn_by
        File and function in ``figures``.
    """

    of: str
    words: str
    lacks: Mapping[str, str]
    over: str = ""
    drawn_by: str = "draw:draw_rows"


#: The kinds of figures.
FIGURES = {name: Drawing(**row) for name, row in read_table(__file__, "figures").items()}

#: Regimes of the contact over the stationary cycle, in the order of their flag values.
REGIMES = ("stick", "partial_slip", "gross_slip", "lift_off", "not_finite", "no_equilibrium")
#: Regimes in which s is no finite number.
WITHOUT_S = ("not_finite", "no_equilibrium")

#: Whether a bulk stress moves the stick zone, where that is known, or leaves it in its place.
MOVED = "moved"
SHIFTS = (MOVED, "none")


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
_SWINGS = {swing.name: swing for swing in (NORMAL_STRAIN, SHEAR_STRESS)}
CRITERIA = {
    name: Criterion(**row | {"swing": _SWINGS[row["swing"]]})
    for name, row in read_table(__file__, "criteria").items()
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
