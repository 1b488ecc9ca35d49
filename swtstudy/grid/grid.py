"""The grid of named dimensions that a study or a call of `solve` spans."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.canonical import COLUMNS, canonical_number, canonical_points
from swtstudy.grid.codes import code_of, control_code
from swtstudy.grid.values import Value, read_value
from swtstudy.parameters import PAIRS, PARAMETERS, Control

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class Grid:
    """A grid of parameter points.

    Attributes
    ----------
    fixed
        The single-valued parameters; those that no profile of the grid has may be absent, and of two that
        take each other's place one is.
    axes
        The values along each dimension, in the order of the dimensions.
    """

    fixed: dict[str, Value]
    axes: dict[str, tuple[Value, ...]]

    @property
    def dims(self) -> tuple[str, ...]:
        """Names of the dimensions."""
        return tuple(self.axes)

    @property
    def shape(self) -> tuple[int, ...]:
        """Lengths of the dimensions."""
        return tuple(map(len, self.axes.values()))

    @property
    def size(self) -> int:
        """Number of grid points."""
        return math.prod(self.shape)

    @property
    def control(self) -> Control:
        """What is prescribed."""
        return Control.given((*self.fixed, *self.axes))

    def values(self, name: str) -> tuple[Value, ...]:
        """All values of a parameter on this grid; empty if it has none."""
        if name in self.axes:
            return self.axes[name]
        return (self.fixed[name],) if name in self.fixed else ()

    def canonical(self, start: int = 0, stop: int | None = None) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Canonical rows of the points start…stop of the grid in C order; see `canonical_points`."""
        indices = np.arange(start, self.size if stop is None else stop)
        position = (
            dict(zip(self.axes, np.unravel_index(indices, self.shape), strict=True)) if self.axes else {}
        )
        control = self.control
        columns: dict[str, NDArray] = {}
        for name in COLUMNS:
            source = "frequency_ratio" if name in ("p", "q") else control.given_for(name)
            codes = np.array([_code(name, value) for value in self.values(source)] or [0.0])
            columns[name] = codes[position[source]] if source in position else codes
        columns["control"] = control_code(np.array(control.normal_force), np.array(control.tangential_force))
        columns["profile"] = np.broadcast_to(columns["profile"], indices.shape)
        return canonical_points(columns)


def _code(name: str, value: Value) -> float:
    """The number that stands for a value in a canonical row."""
    if isinstance(value, str):
        return code_of(value)
    if isinstance(value, Fraction):
        return float({"p": value.numerator, "q": value.denominator}.get(name, value))
    # A phase is rounded in units of π once it is folded, not here.
    return value if PARAMETERS[name].units == "rad" else canonical_number(value)


def complete(fixed: dict[str, Value], axes: dict[str, tuple[Value, ...]]) -> Grid:
    """A grid with the defaults of Table 1 for every parameter that is not given, nor one in its place."""
    filled = dict(fixed)
    given = {*fixed, *axes}
    given |= {PAIRS[name] for name in given if name in PAIRS}
    for name, parameter in PARAMETERS.items():
        if name not in given and parameter.default is not None:
            filled[name] = read_value(parameter, parameter.default)
    return Grid({name: filled[name] for name in PARAMETERS if name in filled}, dict(axes))
