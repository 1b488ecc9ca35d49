"""Closed strain cycles of a periodic history, by rainflow counting, each with its own largest stress.

The history begins and ends at its largest strain, so that every cycle closes: one closes where the strain,
after a turning point and a smaller excursion, comes back to the level of that turning point. Its time is from
the turning point until then. The outermost one's is the whole round, with all that is nested in it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class Cycles:
    """The closed cycles of h histories, at most k of each; those that a history lacks have no amplitude.

    Attributes
    ----------
    amplitude
        Shape (h, k): half of the strain between its two turning points.
    tension
        Shape (h, k): the largest stress within its time.
    """

    amplitude: FloatArray
    tension: FloatArray


def closed_cycles(strain: FloatArray, stress: FloatArray) -> Cycles:
    """Count the cycles of histories, between whose instants strain and stress go straight.

    Parameters
    ----------
    strain, stress
        Shape (h, T): one period at T instants, the first of which follows the last.
    """
    t = strain.shape[1]
    instants = (strain.argmax(axis=1)[:, None] + np.arange(t + 1)) % t
    strain, stress = (np.take_along_axis(values, instants, axis=1).T.copy() for values in (strain, stress))
    counting = _Counting(strain[0], stress[0], t)
    for instant in range(1, t + 1):
        before, now = instant - 1, instant
        counting.turn(strain[before], strain[now], stress[before])
        counting.close(strain[before], strain[now], stress[before], stress[now], now == t)
        counting.go_on(stress[now])
    most = max(int(counting.count.max(initial=0)), 1)
    return Cycles(counting.amplitude[:, :most], counting.tension[:, :most])


class _Counting:
    """h countings on their way through their histories.

    The turning points whose cycles are still open are a stack; beside each is the largest stress from it to
    the next one, or until now.
    """

    def __init__(self, strain: FloatArray, stress: FloatArray, instants: int) -> None:
        h, deepest = strain.size, instants + 2
        self.level, self.highest = np.zeros((2, h, deepest))
        self.level[:, 0], self.highest[:, 0] = strain, stress
        #: Place of the last turning point in the stack.
        self.top = np.zeros(h, dtype=np.intp)
        self.amplitude, self.tension = np.zeros((2, h, instants // 2 + 1))
        self.count = np.zeros(h, dtype=np.intp)
        self.rows = np.arange(h)

    def turn(self, before: FloatArray, now: FloatArray, stress: FloatArray) -> None:
        """A turning point of the strain at the instant before."""
        came = before - self.level[self.rows, self.top]
        turns = np.flatnonzero(came * (now - before) < 0.0)
        self.top[turns] += 1
        at = turns, self.top[turns]
        self.level[at], self.highest[at] = before[turns], stress[turns]

    def close(
        self,
        before: FloatArray,
        now: FloatArray,
        stress_before: FloatArray,
        stress_now: FloatArray,
        is_end: bool,
    ) -> None:
        """Close the cycles to whose first turning point the strain comes back from one instant to the next.

        The outermost one closes at the end alone, also where the largest strain is there more than once.
        """
        rows = self.rows
        while rows.size:
            rows = rows[self.top[rows] >= (1 if is_end else 2)]
            last = self.top[rows]
            first, turn = self.level[rows, last - 1], self.level[rows, last]
            back = np.abs(now[rows] - turn) >= np.abs(first - turn)
            rows, last, first, turn = rows[back], last[back], first[back], turn[back]
            step = now[rows] - before[rows]
            share = np.divide(first - before[rows], step, out=np.ones_like(step), where=step != 0.0)
            there = stress_before[rows] + share * (stress_now[rows] - stress_before[rows])
            tension = np.maximum(there, np.maximum(self.highest[rows, last - 1], self.highest[rows, last]))
            self.amplitude[rows, self.count[rows]] = 0.5 * np.abs(first - turn)
            self.tension[rows, self.count[rows]] = tension
            self.count[rows] += 1
            self.top[rows] = np.maximum(last - 2, 0)
            # What was open before goes on with what is nested in it.
            at = rows, self.top[rows]
            self.highest[at] = np.maximum(self.highest[at], tension)

    def go_on(self, stress: FloatArray) -> None:
        """The stress at the instant now."""
        at = self.rows, self.top
        self.highest[at] = np.maximum(self.highest[at], stress)
