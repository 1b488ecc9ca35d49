"""Smooth closed curves as sums of harmonics, and the inverse of one on stretches where it is monotone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.roots import Brackets, monotone_roots, sign_changes
from swtstudy.mechanics.points import FloatArray, IntArray

#: Samples of a derivative for each harmonic between which its zeros are looked for. Four times as many find
#: no others in 2,000 random sums of up to 6 harmonics.
SAMPLES = 24
#: Nodes of the inverse's series: doubled from the first to the last until the coefficients fall below this.
LEAST_NODES, MOST_NODES, NEGLIGIBLE = 32, 1024, 1e-13


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
        """Whether it never changes."""
        return not np.any(self.amplitude[self.order > 0])

    @cached_property
    def turns(self) -> FloatArray:
        """Instants at which it turns, ascending in [0, 2π), shape (m,)."""
        if self.is_constant:
            return np.zeros(0)
        grid = even_instants(self.highest)
        _, low, high = sign_changes(grid, self.value(grid, 1)[None])
        zero = np.zeros(len(low))

        def rate(at: FloatArray, _: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, FloatArray]:
            return self.value(at, 1), self.value(at, 2), self.value(at, 3)

        return np.unique(np.mod(monotone_roots(rate, zero, Brackets.of(rate, low, high)), PERIOD))

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
        begin, end = self.at_turns, np.roll(self.at_turns, -1)
        rise = (end - begin).take(stretch)
        share = np.divide(value - begin.take(stretch), rise, out=np.zeros(value.shape), where=rise != 0.0)
        y = np.arccos(1.0 - 2.0 * np.clip(share, 0.0, 1.0)) * (2.0 / np.pi) - 1.0
        return chebyshev.evaluate(self._inverses, y, stretch)

    @cached_property
    def _inverses(self) -> FloatArray:
        """Series of the inverse on each stretch over the angle α, in which both ends are regular."""
        count = LEAST_NODES
        while True:
            series = chebyshev.series(self._inverse_at(0.5 * np.pi * (1.0 + chebyshev.nodes(count))))
            if np.abs(series[-2:]).max() < NEGLIGIBLE or 2 * count > MOST_NODES:
                return series
            count *= 2

    def _inverse_at(self, angle: FloatArray) -> FloatArray:
        """Instants at which the share 1/2 − cos α/2 of each stretch's rise is reached, shape (m, k)."""
        begin, end = self.at_turns[:, None], np.roll(self.at_turns, -1)[:, None]
        goal = begin + (end - begin) * (0.5 - 0.5 * np.cos(angle))
        low = np.broadcast_to(self.turns[:, None], goal.shape)
        last = np.append(self.turns[1:], self.turns[0] + PERIOD)[:, None]
        high = np.broadcast_to(last, goal.shape)

        def curve(at: FloatArray, _: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, FloatArray]:
            return self.value(at), self.value(at, 1), self.value(at, 2)

        brackets = Brackets.of(curve, low.ravel(), high.ravel())
        return monotone_roots(curve, goal.ravel(), brackets, 1e-8).reshape(goal.shape)


def even_instants(order: int) -> FloatArray:
    """Instants over a period, closer than a harmonic of an order can turn twice, and one beyond."""
    # The offset keeps them off the zeros of symmetric curves.
    count = SAMPLES * order
    return (PERIOD / count) * np.arange(count + 2, dtype=np.float64) + 0.0123 / order
