"""The stationary cycle of the contact: its intervals, and the state of the springs at any instant."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.growth_times import GrowthTimes
from swtstudy.mechanics.contact.memory import Memory
from swtstudy.mechanics.contact.slip_front import Senses, SlipStates, slip_states
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.numerics.arrays import packed
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows

#: No slip in shorter intervals, rad, nor with the slip front nearer to the edge, relative. 0: stick is called
#: slip at 79 of 4,000 points, 1e-15: at 8; 1e-11 and 1e-9: no change.
NO_SLIP = 1e-13


@dataclass(frozen=True)
class Cycle(Rows):
    """The stationary cycle of n loads, cut into i intervals between turning instants.

    Within an interval the normal load and both slip lines are monotone, the front moves inwards only, and the
    memory inside of the front does not change.

    Attributes
    ----------
    load
        The n loads.
    begin, end
        Shape (n, i): first and last instants φ of the intervals, ascending from 0 to `PERIOD`.
    memory
        Pieces inside of the front, shape (n, i, d); during growth, with the growing piece.
    times
        When the memory's growths were.
    forward, backward
        Shape (n, i): whether T − N rises, so that springs slip at τ = +w, and whether T + N falls, so
        that they slip at τ = −w. With neither of them the contact sticks.
    gross_slip, lift_off
        Shape (n,): whether the whole contact slides, or is lost, somewhere in the cycle.
    """

    load: Load
    begin: FloatArray
    end: FloatArray
    memory: Memory
    times: GrowthTimes
    forward: NDArray[np.bool_]
    backward: NDArray[np.bool_]
    gross_slip: NDArray[np.bool_]
    lift_off: NDArray[np.bool_]

    def take(self, index: NDArray[np.intp]) -> Cycle:
        """The cycles at ``index``, repetitions allowed."""
        every = np.arange(self.begin.shape[1])
        return self.take_intervals(index, np.broadcast_to(every, (len(index), every.size)))

    def states(self, interval: NDArray[np.intp], instant: FloatArray) -> SlipStates:
        """Contact states at instants φ in intervals of the cycle, each of shape (n, …)."""
        return slip_states(self.load, self.memory, self.senses, self.times, interval, instant)

    @property
    def senses(self) -> Senses:
        """In which intervals springs may slip forward and backward."""
        return self.forward, self.backward

    def slips(self) -> NDArray[np.bool_]:
        """True where any spring slips somewhere in the cycle, shape (n,)."""
        interval = np.arange(self.begin.shape[1])
        middle = self.states(interval, 0.5 * (self.begin + self.end))
        slips = middle.front < (1.0 - NO_SLIP) * middle.edge
        return np.asarray((slips & (self.end - self.begin > NO_SLIP)).any(axis=1))

    def first_half(self) -> Cycle:
        """The intervals that begin in the first half of the common period, and empty ones."""
        keep = self.begin < 0.5 * PERIOD
        (interval,) = packed(keep, np.broadcast_to(np.arange(keep.shape[1]), keep.shape))
        chosen = self.take_intervals(np.arange(len(keep)), interval)
        empty = np.arange(interval.shape[1]) >= keep.sum(axis=1, keepdims=True)
        return replace(chosen, end=np.where(empty, chosen.begin, chosen.end))

    def take_intervals(self, index: NDArray[np.intp], interval: NDArray[np.intp]) -> Cycle:
        """The cycles at ``index``, of which only the intervals of shape (len(index), j) are kept."""
        at = index[:, None], interval
        return Cycle(
            self.load.take(index),
            self.begin[at],
            self.end[at],
            self.memory.take(at),
            self.times.take(index),
            self.forward[at],
            self.backward[at],
            self.gross_slip[index],
            self.lift_off[index],
        )
