"""The grid of named dimensions that a study or a call of `solve` spans, and the distinct points behind it.

A canonical point is one row of numbers for everything that is physically one point; names are codes. Two
points of a grid are one if their rounded values agree, if the symmetry of the load protocol maps one onto
the other, or if they differ only in parameters that do not matter (the shape of another profile, a profile
whose shape is plain, the phase and the control of a load that stands still).
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.kernel.loops import fold_bulk_phase, fold_phase
from swtstudy.points.values import NamedValues, Value, amplitudes_of, press_steadily, read_value
from swtstudy.solver.load_path import Loop
from swtstudy.solver.points import Points
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray, IntArray
from swtstudy.vocabulary.choices import FAMILIES, MOVED, PLAIN_OF, SWT, families_with, family_of, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import (
    AXES,
    HARMONIC,
    LOOP_AMPLITUDE,
    NORMAL_AMPLITUDES,
    PARAMETERS,
    SHIFT,
    STRAIN_SHARE,
    Control,
    Parameter,
    replaced_by,
)
from swtstudy.vocabulary.quantities import NOTHING, Request

if TYPE_CHECKING:
    import xarray as xr

#: Definitions of the user, by code.
Definitions = Mapping[int, Definition]


def code_of(value: str | Definition, parameter: str = "profile") -> int:
    """The number that stands for a value of a parameter that has names."""
    return value.code if isinstance(value, Definition) else PARAMETERS[parameter].names.index(value)


def value_of(code: int, definitions: Definitions, parameter: str = "profile") -> str | Definition:
    """The value that a number stands for."""
    names = PARAMETERS[parameter].names
    return names[code] if code < len(names) else definitions[code]


def _numbers(part: str) -> tuple[str, ...]:
    """Return the numbers of a part that have a column; one that takes another's place is in its column."""
    rows = PARAMETERS.items()
    return tuple(n for n, row in rows if row.part == part and row.kind == "number" and not row.instead_of)


#: What the load costs if it is a loop.
COST = "load_cost"
#: Shape parameters, of whichever profile.
SHAPE_COLUMNS = _numbers("shape")
#: Columns of bodies and criterion; friction is before the Poisson ratio, on which no traction depends.
_OTHERS = (*reversed(_numbers("body")), *_numbers("bulk"), *_numbers("criterion"))
#: Parameters that are a number of every point, whatever its profile.
NUMBERS = (*_numbers("load"), *_OTHERS)
#: Columns of a table of canonical points, in the order in which they are sorted. Names are codes (`code_of`);
#: a control is 1 for a normal force, 2 for a tangential one, together 3.
_INTEGERS = ("profile", "criterion", "control", COST, "load", "p", "q")  # ω2/ω1 = p/q
COLUMNS = (*_INTEGERS, *_numbers("load"), *SHAPE_COLUMNS, *_OTHERS)
#: Columns of a grid that rows are made of: a stick zone that stays has a strain share of 0.
GIVEN_COLUMNS = (*COLUMNS, SHIFT)
#: Numbers over the dimensions of a grid that they depend on, in the order of their axes.
Column = tuple[tuple[str, ...], NDArray]
#: A canonical point, in an array: a number for each of these names.
ROW = np.dtype([(name, np.int64 if name in _INTEGERS else np.float64) for name in COLUMNS])
#: Canonical points, shape (n,) of `ROW`.
Table = NDArray[np.void]

#: More grid points than this need more memory than most machines have (about 0.3 kB each).
LARGEST_GRID = 50_000_000
#: Grid points that are made canonical at once.
_SLAB = 100_000

#: Digits to which values are told apart: 0.2 and 0.1 + 0.1 are one point.
DIGITS = 12

#: Name of the dimension along which the sampled parameters vary together.
SAMPLE = "sample"


def canonical_number(value: float) -> float:
    """A number rounded to `DIGITS` significant digits, without the sign of zero."""
    return float(f"{value:.{DIGITS}g}") + 0.0


def rounded(values: NDArray) -> FloatArray:
    """`canonical_number` of many numbers."""
    distinct, index = np.unique(values, return_inverse=True)
    return np.array([canonical_number(value) for value in distinct.tolist()])[index].reshape(values.shape)


@dataclass(frozen=True)
class Grid:
    """A grid of parameter points: the product of a sample, if there is one, and of axes.

    Attributes
    ----------
    fixed
        The single-valued parameters; parameters that no profile of the grid has may be absent, and one of two
        that take each other's place.
    axes
        The values along each dimension, in the order of the dimensions.
    samples
        The values of the parameters that vary together along the first dimension: all of one length, a point
        of the sample at each place.
    sample_dim
        Name of this dimension.
    sample_labels
        Its coordinate; numbers if it is empty.
    """

    fixed: dict[str, Value]
    axes: NamedValues
    samples: NamedValues = field(default_factory=dict)
    sample_dim: str = SAMPLE
    sample_labels: tuple[Hashable, ...] = ()

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return (*(self.sample_dim,) * bool(self.samples), *self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the dimensions."""
        return (*map(len, [*self.samples.values()][:1]), *map(len, self.axes.values()))

    @property
    def sizes(self) -> dict[str, int]:
        """Lengths of the dimensions by their names."""
        return dict(zip(self.dims, self.shape, strict=True))

    @property
    def size(self) -> int:
        """Number of grid points."""
        return math.prod(self.shape)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters that it has values of."""
        return (*self.fixed, *self.axes, *self.samples)

    @cached_property
    def control(self) -> Control:
        """The control: what is prescribed."""
        return Control.given(self.names)

    @property
    def definitions(self) -> dict[int, Definition]:
        """The user's definitions, by their codes in canonical rows."""
        return {each.code: each for each in self.given}

    @property
    def given(self) -> tuple[Definition, ...]:
        """The user's definitions as they were given: several may be the same but for their names."""
        values = (value for name in self.names for value in self.values(name))
        return tuple(dict.fromkeys(value for value in values if isinstance(value, Definition)))

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Its loads that are loops."""
        return tuple(load for load in self.values("load") if isinstance(load, Loop))

    def row(self, name: str) -> Parameter:
        """The row of a parameter, with its unit."""
        return AXES[name]

    def values(self, name: str) -> tuple[Value, ...]:
        """All values of a parameter on this grid, or along its sample; empty if it has none."""
        single = (self.fixed[name],) if name in self.fixed else ()
        return self.axes.get(name) or self.samples.get(name) or single

    def dimension(self, name: str) -> str | None:
        """The dimension along which a parameter varies; None if it has a single value or none."""
        if name in self.samples:
            return self.sample_dim
        return name if name in self.axes else None

    def made(self, asked: Request) -> dict[str, tuple[str, ...]]:
        """Names and dimensions of what results have beside what is asked: margins, and that with units."""
        return dict.fromkeys(self.margins, self.dims)

    @property
    def margins(self) -> tuple[str, ...]:
        """Data variables that say how far the points are from where the model ends."""
        pulled = any(value != 0.0 for value in self.values("bulk_stress_amplitude"))
        shift = ("stick_zone", "bulk_shift", "bulk_shift_ratio") * pulled
        return (*shift, *("prescribed_force_ratio",) * self.control.tangential_force)

    def presented(self, dataset: xr.Dataset, asked: Request) -> xr.Dataset:
        """Results as users see them, with units if the grid has some."""
        return dataset

    @cached_property
    def columns(self) -> dict[str, Column]:
        """The numbers that its points are made of, by `GIVEN_COLUMNS`, and their scales.

        Beside these columns there are ``length_scale``, the unit of critical distances; ``curvature``, a_H/R;
        ``face``, the radius of a flat face with rounded edges in a_H; ``slip_scale``, μ E* δ0/(G* a_H); and
        ``body_share``, the strain of the body with the bulk stress over the mean of both bodies under equal
        tractions, negative at points of the other body. Without units no length is known.
        """
        found: dict[str, Column] = {"length_scale": ((), np.array(1.0))}
        found |= dict.fromkeys(("curvature", "face", "slip_scale"), ((), np.array(np.nan)))
        for name in GIVEN_COLUMNS:
            # One that takes the other's place is in its column.
            source = {COST: "load", "p": "frequency_ratio", "q": "frequency_ratio"}.get(name)
            source = source or self.control.given_for(name)
            numbers = np.array([_number(name, value) for value in self.values(source)] or [0])
            dim = self.dimension(source)
            found[name] = ((dim,), numbers) if dim else ((), numbers[0])
        found["control"] = (), np.array(self.control.normal_force + 2 * self.control.tangential_force)
        return found | {"body_share": found[STRAIN_SHARE]}

    def at(self, places: IndexArray, *names: str) -> list[NDArray]:
        """The numbers of columns at n places of the grid in C order, each of shape (n,)."""
        return numbers_at((self.columns[name] for name in names), self.sizes, places)


def numbers_at(columns: Iterable[Column], sizes: Mapping[str, int], places: IndexArray) -> list[NDArray]:
    """The numbers of columns over dimensions of these sizes at n places in C order, each of shape (n,)."""
    at = dict(zip(sizes, np.unravel_index(places, [*sizes.values()]), strict=True)) if sizes else {}
    return [np.broadcast_to(v[tuple(at[dim] for dim in dims)], len(places)) for dims, v in columns]


def _number(name: str, value: Value) -> float:
    """The number that stands for a value in a column."""
    match value:
        case Definition():
            return value.cost if name == COST else value.code
        case str():
            return 0 if name == COST else code_of(value, name)
        case Fraction():
            return float({"p": value.numerator, "q": value.denominator}.get(name, value))
    # A phase is rounded in units of π once it is folded, not here.
    return value if PARAMETERS[name].units == "rad" else canonical_number(value)


def complete(fixed: dict[str, Value], axes: NamedValues, samples: NamedValues | None = None) -> Grid:
    """A grid with defaults for every parameter that is not given, nor one in its place.

    They are taken from Table 1, but for the amplitudes that scale loops, which are 1. A plane contact under
    loops with a constant normal load has a normal force that does not oscillate.
    """
    samples, given = samples or {}, {*fixed, *axes, *(samples or {})}
    loads, profiles = (
        axes.get(name) or samples.get(name) or (fixed.get(name),) for name in ("load", "profile")
    )
    if NORMAL_AMPLITUDES.isdisjoint(given) and press_steadily(loads) and any(map(is_plane, profiles)):
        fixed, given = fixed | {"normal_force_amplitude": 0.0}, given | {"normal_force_amplitude"}
    given |= replaced_by(given)
    scaling = amplitudes_of(loads)
    filled = fixed | {
        name: read_value(row, LOOP_AMPLITUDE if name in scaling else row.default)
        for name, row in PARAMETERS.items()
        if name not in given and row.default is not None
    }
    return Grid({name: filled[name] for name in PARAMETERS if name in filled}, dict(axes), dict(samples))


def check_count(grid: Grid) -> None:
    """A ValueError if a grid has more than `LARGEST_GRID` points."""
    if grid.size > LARGEST_GRID:
        found = f"{grid.size} points are too many to compute, at most {LARGEST_GRID}"
        ways = "DataArrays of a common dimension, or the file of a study's [sample], are a list of points"
        raise ValueError(f"{found}: several values of parameters span a grid; {ways}")


def canonical_points(grid: Grid, places: IndexArray, fold: bool = True) -> tuple[Table, BoolArray]:
    """Canonical rows of points of a grid.

    Parameters
    ----------
    grid
        The grid.
    places
        Shape (n,): places of the grid in C order.
    fold
        Whether phases are folded. If not, the time of a point keeps its origin.

    Returns
    -------
    table
        Shape (n,) of `ROW`; columns that do not matter for a point are 0.
    mirrored
        Shape (n,): True where x is mirrored with respect to the canonical point.
    """
    table, columns = np.empty(len(places), ROW), grid.at(places, *GIVEN_COLUMNS)
    for name, numbers in zip(COLUMNS, columns, strict=False):
        table[name] = numbers
    # A parameter that does not scale a loop does not matter for it.
    name = "bulk_stress_amplitude"
    idle = [loop.code for loop in grid.loops if name not in loop.scaled_by]
    table[name][np.isin(table["load"], idle)] = 0.0
    _make_shapes_canonical(table)
    table["normal_sensitivity"][table["criterion"] == code_of(SWT, "criterion")] = 0.0
    _make_shifts_canonical(table, columns[-1])
    # A normal load at rest is prescribed as the tangential one is: loops know no mixed control.
    rests, stands = table["normal_amplitude"] == 0.0, table["tangential_amplitude"] == 0.0
    tangential = (table["control"] & 2) == 2
    normal = np.where(rests, tangential, (table["control"] & 1) == 1)
    if fold:
        # So is a tangential load at rest as the normal one, and both at rest as displacements.
        normal, tangential = normal & ~(rests & stands), np.where(stands, normal & ~rests, tangential)
    table["control"] = normal + 2 * tangential
    if not fold:
        return table, np.zeros(table.shape, bool)
    # A loop and a constant normal load have neither phase nor frequencies.
    is_loop = table["load"] != code_of(HARMONIC, "load")
    for name, value in (("phase", 0.0), ("p", 1), ("q", 1)):
        table[name][rests | is_loop] = value
    p, q = table["p"], table["q"]
    # In units of π and nudged: multiples of the period fall on one side whatever their rounding error.
    nudge = 2 * 10.0**-DIGITS
    folded, mirrored = fold_phase(table["phase"] + nudge, p, q)
    table["phase"] = _in_turns(folded - nudge)
    moves, both_ways = (table["bulk_stress_amplitude"] != 0.0) & ~is_loop, (q % 2 == 0) | rests
    folded, mirrored = fold_bulk_phase(table["bulk_stress_phase"] + nudge, moves, mirrored, both_ways)
    table["bulk_stress_phase"] = np.where(moves, _in_turns(folded - nudge), 0.0)
    return table, mirrored


def _make_shapes_canonical(table: Table) -> None:
    """A profile whose shape is plain is the plain one, and has no shape of another profile."""
    profile = table["profile"]
    for family in FAMILIES.values():
        if family.plain is not None:
            name, value = family.plain
            same = (profile == code_of(family.name)) & (table[name] == value)
            profile[same] = code_of(PLAIN_OF[family.geometry])
    for name in SHAPE_COLUMNS:
        table[name][~np.isin(profile, [code_of(family) for family in families_with(name)])] = 0.0


def _make_shifts_canonical(table: Table, shift: NDArray) -> None:
    """The stick zone is not shifted, or known not to be."""
    harmonic = table["load"] == code_of(HARMONIC, "load")
    shifted = (shift == code_of(MOVED, SHIFT)) & (table["bulk_stress_amplitude"] != 0.0)
    shifted &= (table["friction"] > 0.0) & ~(harmonic & (table["normal_amplitude"] != 0.0))
    shifted &= np.isin(table["profile"], [code_of(name) for name in PLAIN_OF.values()])
    # The other body has the shift alone.
    other = table[STRAIN_SHARE] < 0.0
    table["bulk_stress_mean"][other] = 0.0
    for name in ("bulk_stress_amplitude", "bulk_stress_phase"):
        table[name][other & ~shifted] = 0.0
    table[STRAIN_SHARE][~shifted] = 0.0


def _in_turns(angle: FloatArray) -> FloatArray:
    """An angle rounded in units of π."""
    return np.maximum(np.round(angle / np.pi, DIGITS), 0.0) * np.pi


@dataclass(frozen=True)
class Distinct:
    """The distinct points behind a grid, and the way back: what its values are computed, saved and found by.

    Attributes
    ----------
    rows
        Shape (m,) of `ROW`, in lexicographic order.
    distances
        Shape (m, k): the critical distances that are asked of each, in a_H.
    index
        Shape (grid.size,): the distinct point of every point of the grid.
    mirrored
        Shape (grid.size,): True where x is mirrored with respect to that point.
    definitions
        Definitions of the user, by code.
    """

    rows: Table
    distances: FloatArray
    index: IntArray
    mirrored: BoolArray
    definitions: Definitions

    @classmethod
    def of(cls, grid: Grid, asked: Request = NOTHING, places: IndexArray | None = None) -> Distinct:
        """The points of a grid, or of n places of it; a ValueError beyond `LARGEST_GRID` points."""
        check_count(grid)
        places = np.arange(grid.size) if places is None else places
        rows, mirrored = np.empty(len(places), ROW), np.empty(len(places), bool)
        distances = np.empty((len(places), len(asked.distances)))
        # In slabs: a point's working memory is several times its row.
        for start in range(0, len(places), _SLAB):
            some = slice(start, start + _SLAB)
            rows[some], mirrored[some] = canonical_points(grid, places[some])
            # The same length is another one in a_H from contact to contact.
            (length,) = grid.at(places[some], "length_scale")
            distances[some] = rounded(np.array(asked.distances) / length[:, None])
        first, index = group_rows(rows, *distances.T)
        for name in ROW.names or ():  # in place: a million rows are 200 MB
            rows[name][: len(first)] = rows[name][first]
        return cls(rows[: len(first)], distances[first], index, mirrored, grid.definitions)


def group_rows(table: Table, *more: FloatArray) -> tuple[IntArray, IntArray]:
    """The distinct rows of a table, in lexicographic order.

    Parameters
    ----------
    table
        Rows, without NaN, shape (n,): all columns of it are compared.
    more
        Further columns, each of shape (n,).

    Returns
    -------
    first
        Shape (m,): the index of one occurrence of every distinct row.
    group
        Shape (n,): the index into `first` of the row equal to each row.
    """
    group = np.zeros(len(table), np.int64)
    first = np.zeros(min(len(table), 1), np.int64)
    for column in (*(table[name] for name in table.dtype.names or ()), *more):
        if len(first) == len(table) or not np.any(column != column[0]):
            continue  # all are told apart, or none by this column
        values, code = np.unique(column, return_inverse=True)
        # Column by column on integers: sorting whole rows takes ten times as long.
        _, first, group = np.unique(group * len(values) + code, return_index=True, return_inverse=True)
    return first, group


def alike(table: Table, *more: FloatArray) -> list[IndexArray]:
    """Indices of rows that one call can solve, and that share further columns, one array for each kind."""
    _, group = group_rows(table[["profile", "control", "load", "criterion"]], *more)
    order = np.argsort(group, kind="stable")
    return np.split(order, np.cumsum(np.bincount(group))[:-1]) if len(table) else []


def points_from(table: Table, definitions: Definitions) -> Points:
    """A batch for the solver from canonical rows that share one profile, control and course of the load.

    Parameters
    ----------
    table
        Shape (n,) of `ROW`.
    definitions
        Definitions of the user, by code.
    """
    profile = value_of(table["profile"][0], definitions)
    course, control = value_of(table["load"][0], definitions, "load"), int(table["control"][0])
    return Points(
        profile=profile,  # type: ignore[arg-type]
        p=table["p"].copy(),
        q=table["q"].copy(),
        shape={name: table[name].copy() for name in family_of(profile).shape},
        control=Control(bool(control & 1), bool(control & 2)),
        path=course if isinstance(course, Loop) else None,
        criterion=str(value_of(table["criterion"][0], definitions, "criterion")),
        **{name: table[name].copy() for name in NUMBERS},
    )


def describe_point(row: np.void, definitions: Definitions) -> str:
    """A canonical row in words, for messages: what matters for its profile and load."""
    point = points_from(np.atleast_1d(row), definitions)
    parts = [f"profile={point.profile}", *(f"{name}={row[name]:.6g}" for name in point.shape)]
    parts.append(f"load={point.path}" if point.path else f"frequency_ratio={row['p']}/{row['q']}")
    if not PARAMETERS["criterion"].goes_without_saying(point.criterion):
        parts.append(f"criterion={point.criterion}")
    for name in (name for name in NUMBERS if not (point.path and name.endswith("phase"))):
        in_place = name == STRAIN_SHARE and row[name] == 0.0  # the stick zone is
        if not in_place and not PARAMETERS[name].goes_without_saying(row[name]):
            parts.append(f"{point.control.given_for(name)}={row[name]:.6g}")
    return ", ".join(parts)
