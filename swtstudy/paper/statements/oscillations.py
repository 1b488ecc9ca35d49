"""Oscillations of s with the amplitude of the waviness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.paper.statements.measures import turning_points

#: Ripples below this fraction of a curve's range do not count as oscillations.
_RIPPLE = 0.1
#: Share of the steps that must follow a trend for it to hold as a rule.
AS_A_RULE = 0.8


@dataclass(frozen=True)
class Oscillation:
    """The oscillation of one curve.

    Attributes
    ----------
    periods
        Distances from one maximum to the next, and from one minimum to the next, alternately.
    swings
        Absolute changes of s from each turning point to the next.
    """

    periods: FloatArray
    swings: FloatArray

    @classmethod
    def of(cls, x: FloatArray, s: FloatArray) -> Oscillation:
        """The oscillation of s over ascending x."""
        turns = turning_points(s, _RIPPLE * float(np.ptp(s)))
        return cls(x[turns][2:] - x[turns][:-2], np.abs(np.diff(s[turns])))


def longer_periods(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Number of steps over which the period grows, and of all steps."""
    return _growing([np.diff(oscillation.periods) for oscillation in oscillations])


def larger_swings(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Number of steps over which a rise exceeds the last rise, or a fall the last fall, and of all steps."""
    return _growing([oscillation.swings[2:] - oscillation.swings[:-2] for oscillation in oscillations])


def _growing(changes: list[FloatArray]) -> tuple[int, int]:
    together = np.concatenate(changes)
    return int((together > 0).sum()), len(together)


def as_a_rule(count: tuple[int, int]) -> bool:
    """Return whether most of the steps follow a trend; False without any step."""
    return count[1] > 0 and count[0] >= AS_A_RULE * count[1]
