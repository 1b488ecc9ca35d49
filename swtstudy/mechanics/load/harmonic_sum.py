"""Smooth closed curves as sums of harmonics, and the inverse of one on stretches where it is monotone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import ROUNDING, SAME
from swtstudy.mechanics.numerics.roots import Brackets, monotone_roots, sign_changes
from swtstudy.mechanics.points import FloatArray, IndexArray, IntArray

#: Samples of a derivative for each harmonic between which its zeros are looked for. Four times as many find
#: no others in 2,000 random sums of up to 6 harmonics.
SAMPLES = 24
#: Nodes of the inverse's series: doubled from the first to the last until the coefficients are rounding.
LEAST_NODES, MOST_NODES = 32, 256
#: Share of the largest rate below which a curve almost stops.
SLOW = 0.1


@dataclass(frozen=True)
class HarmonicSum:
    """f(φ) = Σ amplitude · sin(order · φ + phase).

    Attributes
    ----------
    order
        Shape (k,), whole numbers ≥ 0.
    amplitude, phase
        Shape (k,).
    """

    order: IntArray
    amplitude: FloatArray
    phase: FloatArray

    def value(self, instant: FloatArray, derivative: int = 0) -> FloatArray:
        """f, or one of its derivatives, at instants of any shape."""
        result = np.zeros(np.shape(instant))
        for order, amplitude, phase in zip(self.order, self.amplitude, self.phase, strict=True):
            size = amplitude * float(order) ** derivative
            result += size * np.sin(order * instant + (phase + 0.5 * np.pi * derivative))
        return result

    @property
    def highest(self) -> int:
        """Largest order, 1 at least."""
        return max(int(self.order[self.amplitude != 0.0].max(initial=1)), 1)

    @property
    def is_constant(self) -> bool:
        """True if the sum never changes."""
        return not np.any(self.amplitude[self.order > 0])

    @cached_property
    def turns(self) -> FloatArray:
        """Instants at which it turns, ascending in [0, 2π), shape (m,)."""
        if self.is_constant:
            return np.zeros(0)
        return self._zeros(1)

    @cached_property
    def slow_instants(self) -> FloatArray:
        """Instants at which it almost stops, ascending in [0, 2π), shape (m,)."""
        if self.is_constant:
            return np.zeros(0)
        zeros = self._zeros(2)
        rate, bend = self.value(zeros, 1), self.value(zeros, 3)
        return zeros[(rate * bend > 0.0) & (np.abs(rate) < SLOW * np.abs(rate).max())]

    def _zeros(self, derivative: int) -> FloatArray:
        """Zeros of a derivative, ascending in [0, 2π), shape (m,)."""
        grid = even_instants(self.highest)
        _, low, high = sign_changes(grid, self.value(grid, derivative)[None])

        def curve(at: FloatArray, _: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            values = [self.value(at, derivative + k) for k in range(3)]
            return values[0], values[1], values[2]

        brackets = Brackets.of(curve, low, high)
        return np.unique(np.mod(monotone_roots(curve, np.zeros(len(low)), brackets), PERIOD))

    @cached_property
    def ends(self) -> tuple[float, float]:
        """Least and largest value."""
        values = np.append(self.at_turns, self.value(np.zeros(1)))
        return float(values.min()), float(values.max())

    @cached_property
    def at_turns(self) -> FloatArray:
        """Its values at the turns, shape (m,)."""
        return self.value(self.turns)

    def stretch(self, instant: FloatArray) -> IntArray:
        """Number of the stretch in which each instant is; stretch j begins at turn j, the last one wraps."""
        return np.mod(np.searchsorted(self.turns, instant, "right") - 1, max(len(self.turns), 1))

    def inverse(self, value: FloatArray, stretch: IntArray) -> FloatArray:
        """Instant at which it has a value in a stretch; the nearer end where it has not.

        The shapes broadcast. Instants of the last stretch may be beyond 2π.
        """
        value, stretch = np.broadcast_arrays(value, stretch)
        if self._inverses is None:
            return self._instants(value, stretch)
        begin, end = self.at_turns, np.roll(self.at_turns, -1)
        rise = (end - begin).take(stretch)
        share = np.divide(value - begin.take(stretch), rise, out=np.zeros(value.shape), where=rise != 0.0)
        y = np.arccos(1.0 - 2.0 * np.clip(share, 0.0, 1.0)) * (2.0 / np.pi) - 1.0
        return chebyshev.evaluate(self._inverses, y, stretch)

    @cached_property
    def _inverses(self) -> FloatArray | None:
        """Series of the inverse on each stretch over the angle α, in which both ends are regular.

        None where one of them almost stops in between: its series would not end.
        """
        begin, end = self.at_turns[:, None], np.roll(self.at_turns, -1)[:, None]
        count, stretch = LEAST_NODES, np.arange(len(self.turns))[:, None]
        while count <= MOST_NODES:
            share = 0.5 - 0.5 * np.cos(0.5 * np.pi * (1.0 + chebyshev.nodes(count)))
            series = chebyshev.series(
                self._instants(*np.broadcast_arrays(begin + (end - begin) * share, stretch))
            )
            if np.abs(series[-2:]).max() < ROUNDING:
                return series
            count *= 2
        return None

    def _instants(self, value: FloatArray, stretch: IntArray) -> FloatArray:
        """`inverse` for values and stretches of one shape, by Newton's method."""
        end = np.append(self.turns[1:], self.turns[0] + PERIOD)

        def curve(at: FloatArray, _: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            return self.value(at), self.value(at, 1), self.value(at, 2)

        brackets = Brackets.of(curve, self.turns[stretch.ravel()], end[stretch.ravel()])
        return monotone_roots(curve, value.ravel(), brackets, SAME).reshape(value.shape)


def even_instants(order: int) -> FloatArray:
    """Instants over a period, closer than a harmonic of an order can turn twice, and one beyond."""
    # The offset keeps them off the zeros of symmetric curves.
    count = SAMPLES * order
    return (PERIOD / count) * np.arange(count + 2, dtype=np.float64) + 0.0123 / order
