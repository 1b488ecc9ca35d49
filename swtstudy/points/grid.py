"""The grid of named dimensions that a study or a call of `solve` spans."""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.points.canonical import COST, GIVEN_COLUMNS, Column, canonical_number, code_of
from swtstudy.points.values import NamedValues, Value, amplitudes_of, press_steadily, read_value
from swtstudy.solver.loop import Loop
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.choices import is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import (
    AXES,
    LOOP_AMPLITUDE,
    NORMAL_AMPLITUDES,
    PARAMETERS,
    STRAIN_SHARE,
    Control,
    Parameter,
    replaced_by,
)
from swtstudy.vocabulary.quantities import Request

if TYPE_CHECKING:
    import xarray as xr

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
