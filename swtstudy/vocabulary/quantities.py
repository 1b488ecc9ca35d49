"""The tables of what results hold: the data variables they always have, and quantities that may be asked.

Reading, validation, the schema, attributes, figures and the command line read them; none of them repeats a
name, a symbol or a meaning. A quantity is the same at a point and at its mirror image, but for places.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.files import read_table
from swtstudy.vocabulary.mistakes import Report, literal, nearest, refused
from swtstudy.vocabulary.parameters import DIRECTIONS

if TYPE_CHECKING:
    import xarray as xr

#: The attribute of results with units that says what their coordinates do not say of the contacts.
CONTACT = "contact"
#: States of a point, in the order of their flag values.
STATES = ("computed", "failed", "missing")
COMPUTED, FAILED, MISSING = range(3)
#: Variables that the solver finds at every point.
SOLVED = ("s", "s_error", "critical_x", "critical_angle", "regime", "s_surface")

#: Where the stick zone is in s, under a bulk stress that moves.
ZONES = ("in_place", "moved", "moved_approximately")


def flag_attributes(words: Sequence[str]) -> dict[str, Any]:
    """CF attributes of flags, from the words of their values 0, 1, …"""
    import numpy as np

    return {"flag_values": np.arange(len(words), dtype=np.int8), "flag_meanings": " ".join(words)}


#: Attributes of the data variables, following the CF conventions. The unit 1 is left out of a Dataset.
ATTRIBUTES: dict[str, dict[str, Any]] = read_table(__file__, "variables")
#: The words of those that are flags.
FLAGS: dict[str, Sequence[str]] = {"stick_zone": ZONES, "regime": REGIMES, "status": STATES}

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


class Quantity(NamedTuple):
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
    has_error: bool = False
    dims: tuple[str, ...] = ()
    is_place: bool = False
    per_cycle: bool = False

    @property
    def variables(self) -> tuple[str, ...]:
        """Names of its data variables."""
        return (self.name, error_of(self.name)) if self.has_error else (self.name,)


QUANTITIES = {name: Quantity(name, **row) for name, row in read_table(__file__, "quantities").items()}

#: Quantities that are asked by name, by giving critical distances, and with fatigue constants.
NAMED = {name: row for name, row in QUANTITIES.items() if not row.dims}
NONLOCAL = {name: row for name, row in QUANTITIES.items() if DISTANCE in row.dims}
COUNTED = {name: row for name, row in QUANTITIES.items() if row.dims == (*COUNTED_SIZES,)}
#: All that `Request.items` may name.
ITEMS = (*NAMED, COUNTS, DISTANCE)
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
    def is_of_body(self) -> bool:
        """True if values beneath the surface are asked, which take longer."""
        return YIELD in self.names or bool(self.distances)

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
    """CF attributes of a data variable that results always have, or that may be asked."""
    if variable in ATTRIBUTES:
        return ATTRIBUTES[variable] | (flag_attributes(FLAGS[variable]) if variable in FLAGS else {})
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


def has_units(dataset: xr.Dataset) -> bool:
    """Return whether results belong to real contacts."""
    return CONTACT in dataset.attrs


def require(dataset: xr.Dataset, *names: str) -> None:
    """Raise a StudyError if results have been left without some of their data variables."""
    if lacking := [name for name in names if name not in dataset]:
        raise refused("results", f"none of {', '.join(lacking)}", "results that still have them")
