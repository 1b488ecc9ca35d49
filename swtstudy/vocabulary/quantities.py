"""The table of quantities that may be asked of every point beside s.

Reading, validation, the schema, attributes, figures and the command line read it; none of them repeats a
name, a symbol or a meaning. A quantity is the same at a point and at its mirror image, but for places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from swtstudy.vocabulary.mistakes import Report, literal, nearest
from swtstudy.vocabulary.parameters import DIRECTIONS

#: The parameter that asks for the nonlocal quantities.
DISTANCE = "critical_distance"
#: Both ends of the stick zone: asked together, since they change places at a mirror image.
STICK_ENDS = ("stick_left", "stick_right")
#: Quantities that studies with a yield strength ask for.
YIELD = "von_mises"
#: Quantities that studies with fatigue constants ask for: the strain cycles in a round, at so many places at
#: most and so many of them at each.
COUNTS = "strain_cycles"
COUNTED_SIZES = {"counted_place": 5, "counted_cycle": 8}


@dataclass(frozen=True)
class Quantity:
    """One quantity.

    Attributes
    ----------
    name
        Name of the data variable, and what a study asks for.
    symbol
        LaTeX without dollar signs.
    meaning
        A few words, used as ``long_name`` and in help texts.
    comment
        The exact definition, in one line.
    function
        Name of the field of `swtstudy.kernel.work.OF_CYCLE`, of the function in
        `swtstudy.solver.von_mises`, or its key in
        `swtstudy.solver.means.Means` or in what `swtstudy.solver.quantities.few_cycles` finds.
    has_error
        Whether there is its estimated absolute error, too, which becomes ``NAME_error``.
    dims
        Dimensions of its own, which points do not have. Critical distances ask for `DISTANCE` and others of
        `swtstudy.vocabulary.parameters.QUANTITY_AXES`, fatigue constants for `COUNTED_SIZES`, its name alone
        for none.
    is_place
        Whether it is an x, whose sign is another one at the mirror image. Archives of before may not have it.
    per_cycle
        Whether it is twice as large if the load passes twice through the same cycle.
    """

    name: str
    symbol: str
    meaning: str
    comment: str
    function: str
    has_error: bool = False
    dims: tuple[str, ...] = ()
    is_place: bool = False
    per_cycle: bool = False

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of its data variables."""
        return (self.name, error_of(self.name)) if self.has_error else (self.name,)


QUANTITIES: dict[str, Quantity] = {
    row.name: row
    for row in (
        Quantity(
            "dissipation",
            r"W/(\mu F_0\, \mu E^* \delta_0/G^*)",
            "dissipated work",
            "work by friction in a load cycle, the common period 2 pi q/omega1, over mu F0 mu E* delta0 / "
            "G*, F0 the normal force at depth delta0; of plane contacts per length, over mu P0 mu delta0",
            "work",
            has_error=True,
            per_cycle=True,
        ),
        Quantity(
            "stick_radius",
            r"c/a_H",
            "radius that always sticks",
            "radius of the permanent stick zone in units of a_H, half its width in plane contacts; "
            "NaN if the whole contact slides or is lost",
            "stick_radius",
        ),
        *(
            Quantity(
                name,
                rf"x_\mathrm{{{side}}}/a_H",
                f"{side} end of what always sticks",
                f"signed x of the {side} end of the permanent stick zone on the line y = 0, in units of a_H: "
                "a bulk stress may move it; NaN as stick_radius",
                name,
            )
            for name, side in zip(STICK_ENDS, ("left", "right"), strict=True)
        ),
        Quantity(
            "contact_radius",
            r"a_\mathrm{max}/a_H",
            "largest contact radius",
            "largest contact radius over the cycle, in units of a_H; half the width in plane contacts",
            "contact_radius",
        ),
        Quantity(
            "force_ratio",
            r"\max |F_x|/(\mu F_N)",
            "largest force ratio",
            "largest |F_x| over mu F_N while there is contact; 1 if the whole contact slides",
            "force_ratio",
        ),
        Quantity(
            "von_mises",
            r"\sigma_\mathrm{v}/(E^* \delta_0/a_H)",
            "largest von Mises stress",
            "largest von Mises stress over the cycle and the body, in E* delta0/a_H, to about 1 %; infinite "
            "at the edge of a truncated paraboloid",
            "largest_von_mises",
        ),
        Quantity(
            "s_volume",
            r"s_\mathrm{volume}",
            "mean of swt over a volume",
            "largest mean of swt/SWT0 over the half spheres of the critical distance, in the section of "
            "plane contacts half discs, about places of the surface line, which is that about volume_x",
            "volume",
            has_error=True,
            dims=(DISTANCE,),
        ),
        Quantity(
            "s_point",
            r"s_\mathrm{point}",
            "swt at a distance",
            "largest swt/SWT0 at half the critical distance from places of the surface line, which is that "
            "from point_x (point method)",
            "point",
            has_error=True,
            dims=(DISTANCE, "direction"),
        ),
        Quantity(
            "s_line",
            r"s_\mathrm{line}",
            "mean of swt along a line",
            "largest mean of swt/SWT0 over twice the critical distance from places of the surface line, "
            "which is that from line_x",
            "line",
            has_error=True,
            dims=(DISTANCE, "direction"),
        ),
        *(
            Quantity(
                f"{kind}_x",
                rf"x_\mathrm{{{kind}}}/a_H",
                f"place of s_{kind}",
                f"signed x of the place of the surface line that s_{kind} is about, in units of a_H; NaN far "
                "from the contact",
                f"{kind}_x",
                dims=dims,
                is_place=True,
            )
            for kind, dims in (
                ("volume", (DISTANCE,)),
                ("point", (DISTANCE, "direction")),
                ("line", (DISTANCE, "direction")),
            )
        ),
        Quantity(
            "counted",
            r"\mathrm{SWT}_i/\mathrm{SWT}",
            "SWT of strain cycles over SWT",
            "SWT of the strain cycles in a round over the largest SWT, at the worst places and planes, the "
            "critical one first; NaN where there are no more",
            "share",
            dims=(*COUNTED_SIZES,),
        ),
        Quantity(
            "counted_number",
            "n_i",
            "number of such strain cycles",
            "how many strain cycles of a round have this SWT, or about it; NaN where there are no more",
            "number",
            dims=(*COUNTED_SIZES,),
            per_cycle=True,
        ),
    )
}

#: Those that are asked by name, by giving critical distances, and with fatigue constants.
NAMED = {name: row for name, row in QUANTITIES.items() if not row.dims}
NONLOCAL = {name: row for name, row in QUANTITIES.items() if DISTANCE in row.dims}
COUNTED = {name: row for name, row in QUANTITIES.items() if row.dims == (*COUNTED_SIZES,)}
ALLOWED = f"a list of {', '.join(NAMED)}"


@dataclass(frozen=True)
class Request:
    """A request: the quantities to be computed at every point beside s.

    Attributes
    ----------
    names
        Of `NAMED`.
    distances
        Critical distances ℓ/a_H, for which all of `NONLOCAL` are asked; of real contacts lengths.
    is_axis
        Whether these distances are a dimension.
    counts
        Whether all of `COUNTED` are asked.
    """

    names: tuple[str, ...] = ()
    distances: tuple[float, ...] = ()
    is_axis: bool = False
    counts: bool = False

    @property
    def items(self) -> tuple[str, ...]:
        """Names of all that is asked, as runs record it: the names, `COUNTS` and `DISTANCE`."""
        return (*self.names, *(COUNTS,) * self.counts, *(DISTANCE,) * bool(self.distances))

    @property
    def rows(self) -> tuple[Quantity, ...]:
        """The quantities that are asked."""
        tables = ({name: NAMED[name] for name in self.names}, COUNTED if self.counts else {})
        return tuple(row for table in (*tables, NONLOCAL if self.distances else {}) for row in table.values())

    @property
    def variables(self) -> dict[str, tuple[str, ...]]:
        """Data variables, with their dimensions beside the points' dimensions."""
        return {
            variable: tuple(dim for dim in row.dims if dim != DISTANCE or self.is_axis)
            for row in self.rows
            for variable in row.variables
        }

    @property
    def sizes(self) -> dict[str, int]:
        """Lengths of the dimensions that quantities have and points do not."""
        return {DISTANCE: len(self.distances), "direction": len(DIRECTIONS), **COUNTED_SIZES}


#: Nothing but s.
NOTHING = Request()


def error_of(name: str) -> str:
    """Name of the estimated absolute error of a data variable."""
    return f"{name}_error"


#: Names of all data variables that may be asked.
EVERY_VARIABLE = tuple(variable for row in QUANTITIES.values() for variable in row.variables)


def attributes_of(variable: str) -> dict[str, Any]:
    """CF attributes of a data variable."""
    row = QUANTITIES.get(variable)
    if row is None:
        row = QUANTITIES[variable.removesuffix(error_of(""))]
        words = {"long_name": f"error of {row.name.replace('_', ' ')}", "comment": "absolute, estimated"}
        return {**words, "units": "1", "symbol": rf"\Delta {row.symbol}"}
    attributes = {"long_name": row.meaning, "comment": row.comment, "units": "1", "symbol": row.symbol}
    return attributes | ({"ancillary_variables": error_of(variable)} if row.has_error else {})


def read_quantities(raw: object, key: str, report: Report) -> tuple[str, ...]:
    """Names of quantities as the user gave them; every mistake is reported."""
    if isinstance(raw, str) or not isinstance(raw, Sequence):
        report(key, literal(raw), ALLOWED)
        return ()
    for index, name in enumerate(raw):
        place = f"{key}[{index}]"
        if not isinstance(name, str):
            report(place, literal(name), ALLOWED)
        elif name in NONLOCAL:
            report(place, literal(name), f"a value of {DISTANCE} instead, which asks for it")
        elif name in COUNTED:
            report(place, literal(name), "it in studies with [material], which have it")
        elif name not in NAMED:
            report(place, f"unknown quantity {literal(name)}", nearest(name, NAMED))
        elif name in raw[:index]:
            report(place, f"{literal(name)}, the same as {key}[{raw.index(name)}]", "each quantity once")
    names = [name for name in raw if isinstance(name, str) and name in NAMED]
    ends = STICK_ENDS if {*names} & {*STICK_ENDS} else ()
    return tuple(dict.fromkeys((*names, *ends)))
