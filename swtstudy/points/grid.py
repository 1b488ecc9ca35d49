"""The grid of named dimensions that a study or a call of `solve` spans."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import (
    COST,
    GIVEN_COLUMNS,
    RATIO_COLUMNS,
    Table,
    canonical_number,
    canonical_points,
    code_of,
)
from swtstudy.points.values import NamedValues, Value, amplitudes_of, read_value
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import (
    AXES,
    HARMONIC,
    LOOP_AMPLITUDE,
    PARAMETERS,
    STRAIN_SHARE,
    Control,
    replaced_by,
)
from swtstudy.vocabulary.quantities import Request

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.loads.loop import Loop
    from swtstudy.vocabulary.arrays import BoolArray, FloatArray, IndexArray


#: Name of the dimension along which the sampled parameters vary together.
SAMPLE = "sample"


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
        The values of the parameters that vary together along the first dimension, `SAMPLE`: all of one
        length, a point of the sample at each place.
    """

    fixed: dict[str, Value]
    axes: NamedValues
    samples: NamedValues = field(default_factory=dict)

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return (*(SAMPLE,) * bool(self.samples), *self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the dimensions."""
        return (*map(len, [*self.samples.values()][:1]), *map(len, self.axes.values()))

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
        from swtstudy.loads.loop import Loop

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
            return SAMPLE
        return name if name in self.axes else None

    def canonical(self, places: IndexArray, fold: bool = True) -> tuple[Table, BoolArray]:
        """Canonical rows of the points at n places of the grid in C order; see `canonical_points`."""
        columns, control = self.columns(places), self.control
        columns["control"] = np.array(control.normal_force + 2 * control.tangential_force)
        columns["profile"] = np.broadcast_to(columns["profile"], len(places))
        # Parameters that do not scale a loop do not matter for it.
        name = "bulk_stress_amplitude"
        if idle := [loop.code for loop in self.loops if name not in loop.scaled_by]:
            columns[name] = np.where(np.isin(columns["load"], idle), 0.0, columns[name])
        return canonical_points(columns, fold)

    def made(self, asked: Request) -> dict[str, tuple[str, ...]]:
        """Names and dimensions of what results have beside what is asked: margins, and that with units."""
        return dict.fromkeys(self.margins, self.dims)

    @property
    def margins(self) -> tuple[str, ...]:
        """Data variables that say how far the points are from where the model ends."""
        pulled = any(value != 0.0 for value in self.values("bulk_stress_amplitude"))
        shift = ("stick_zone", "bulk_shift", "bulk_shift_ratio") * pulled
        return (*shift, *("prescribed_force_ratio",) * self.control.tangential_force)

    def radius_ratios(self, radii: FloatArray) -> FloatArray:
        """Contact radii over R, from radii in a_H; NaN where no length is known; shape (size,)."""
        return np.full(self.size, np.nan)

    @property
    def slip_scales(self) -> FloatArray:
        """μ E* δ0/(G* a_H) of each point, NaN where no length is known; shape (size,)."""
        return np.full(self.size, np.nan)

    @property
    def strain_shares(self) -> FloatArray:
        """Strain of the body with the bulk stress over the mean of both, under equal tractions; (size,).

        Negative at points of the other body.
        """
        return np.broadcast_to(self.columns(np.arange(self.size))[STRAIN_SHARE], self.size)

    def presented(self, dataset: xr.Dataset, asked: Request) -> xr.Dataset:
        """Results as users see them, with units if the grid has some."""
        return dataset

    def distances(self, asked: Request) -> FloatArray:
        """The critical distances that are asked of each point, in a_H, shape (size, k)."""
        own = np.array([canonical_number(distance) for distance in asked.distances])
        return np.broadcast_to(own, (self.size, own.size))

    def cycles(self, places: IndexArray) -> FloatArray:
        """Load cycles of the canonical point in the common period 2πq/ω1 of n points, shape (n,).

        The canonical point of a resting normal load has ω2 = ω1: its tangential load passes once, and p times
        in the common period.
        """
        columns = self.columns(places)
        rests = (columns["normal_amplitude"] == 0.0) & (columns["load"] == code_of(HARMONIC, "load"))
        return np.broadcast_to(np.where(rests, columns["p"], 1.0), len(places))

    def columns(self, places: IndexArray) -> dict[str, NDArray]:
        """A number for each of `GIVEN_COLUMNS` at n places of the grid in C order, of shape (n,) or (1,)."""
        position = self._position(places)
        along = {name: self.dimension(self._source(name)) for name in GIVEN_COLUMNS}
        return {n: codes[position[dim]] if (dim := along[n]) else codes for n, codes in self._codes.items()}

    def _position(self, places: IndexArray) -> dict[str, IndexArray]:
        along = np.unravel_index(places, self.shape) if self.dims else ()
        return dict(zip(self.dims, along, strict=True))

    @cached_property
    def _codes(self) -> dict[str, NDArray]:
        """The numbers that stand for the values of each column; made once, since a grid is read in slabs."""
        return {
            name: np.array([_code(name, value) for value in self.values(self._source(name))] or [0])
            for name in GIVEN_COLUMNS
        }

    def _source(self, column: str) -> str:
        """The parameter that a column of canonical rows comes from."""
        if column == COST:
            return "load"
        return "frequency_ratio" if column in RATIO_COLUMNS else self.control.given_for(column)


def _code(name: str, value: Value) -> float:
    """The number that stands for a value in a canonical row."""
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

    They are taken from Table 1, but for the amplitudes that scale loops, which are 1.
    """
    samples, given = samples or {}, {*fixed, *axes, *(samples or {})}
    given |= replaced_by(given)
    scaling = amplitudes_of(axes.get("load") or samples.get("load") or (fixed.get("load"),))
    filled = fixed | {
        name: read_value(row, LOOP_AMPLITUDE if name in scaling else row.default)
        for name, row in PARAMETERS.items()
        if name not in given and row.default is not None
    }
    return Grid({name: filled[name] for name in PARAMETERS if name in filled}, dict(axes), dict(samples))
