"""The smooth stretches of the cycle at each position, and which of them meet."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.events.passages import front_passes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: Stretches shorter than this, in rad of the cycle, count as none; nearer than this, two of them meet. A
#: hundredth: 2e-7 and nothing; a hundred times: nothing.
NO_STRETCH, GAP = 1e-12, 1e-10
#: Stretches of each interval: two events cut it.
PER_INTERVAL = 3


@dataclass(frozen=True)
class Stretches(Rows):
    """m stretches of the cycle at n × X positions, `PER_INTERVAL` of each interval, in the order of time.

    Attributes
    ----------
    low, high
        Shape (n, X, m): first and last instant φ; both are the same where an event does not happen.
    """

    low: FloatArray
    high: FloatArray

    @cached_property
    def real(self) -> NDArray[np.bool_]:
        """Shape (n, X, m): which have a length."""
        return np.asarray(self.high - self.low > NO_STRETCH)

    @cached_property
    def last_real(self) -> NDArray[np.intp]:
        """Shape (n, X, m): the last one with a length up to each, −1 for none."""
        number = np.arange(self.low.shape[-1])
        return np.maximum.accumulate(np.where(self.real, number, -1), axis=-1)

    @cached_property
    def next_real(self) -> NDArray[np.intp]:
        """Shape (n, X, m): the first one with a length from each on, m for none."""
        total = self.low.shape[-1]
        behind = np.where(self.real, np.arange(total), total)[..., ::-1]
        return np.minimum.accumulate(behind, axis=-1)[..., ::-1]


def stretches(cycle: Cycle, of_edge: FloatArray, of_front: FloatArray) -> Stretches:
    """Each interval cut where the contact edge and the slip front pass a spring.

    Parameters
    ----------
    cycle
        n cycles of i intervals.
    of_edge, of_front
        Shape (n, X): G of the springs that they pass, those at r = |x|, or next to a tip others.
    """
    edge = cycle.load.passage(of_edge, cycle.begin, cycle.end)
    front = front_passes(cycle, of_front)
    begin, end = (np.broadcast_to(instant[:, None], edge.shape) for instant in (cycle.begin, cycle.end))
    ends = np.stack([begin, np.minimum(front, edge), np.maximum(front, edge), end], axis=-1)
    low, high = (ends[..., side].reshape(*of_edge.shape, -1) for side in (slice(3), slice(1, 4)))
    return Stretches(low, high)


def meet(end: FloatArray, begin: FloatArray) -> NDArray[np.bool_]:
    """Return whether one stretch ends where another begins, in the periodic cycle."""
    gap = np.abs(begin - end)
    return np.asarray((gap <= GAP) | (PERIOD - gap <= GAP))
