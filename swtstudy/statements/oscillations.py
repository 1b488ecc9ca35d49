"""How s oscillates with the amplitude of the waviness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.statements.measures import turning_points

#: Ripples below this share of the range of a curve are no oscillation of their own.
_RIPPLE = 0.1
#: Share of the steps that must show a trend which holds as a rule.
AS_A_RULE = 0.8


@dataclass(frozen=True)
class Oscillation:
    """The oscillation of one curve.

    Attributes
    ----------
    periods
        Distances from one maximum to the next, and from one minimum to the next, in turn.
    swings
        Rises and falls of s from each turning point to the next, as absolute values.
    """

    periods: FloatArray
    swings: FloatArray

    @classmethod
    def of(cls, x: FloatArray, s: FloatArray) -> Oscillation:
        """The oscillation of s over ascending x."""
        turns = turning_points(s, _RIPPLE * float(np.ptp(s)))
        return cls(x[turns][2:] - x[turns][:-2], np.abs(np.diff(s[turns])))


def longer_periods(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Over how many steps, and of how many, the period grows."""
    return _growing([np.diff(oscillation.periods) for oscillation in oscillations])


def larger_swings(oscillations: Sequence[Oscillation]) -> tuple[int, int]:
    """Over how many steps, and of how many, a rise is larger than the last rise, or a fall than the last."""
    return _growing([oscillation.swings[2:] - oscillation.swings[:-2] for oscillation in oscillations])


def _growing(changes: list[FloatArray]) -> tuple[int, int]:
    together = np.concatenate(changes)
    return int((together > 0).sum()), len(together)


def as_a_rule(count: tuple[int, int]) -> bool:
    """Whether a trend is seen in most of the steps; False without any step."""
    return count[1] > 0 and count[0] >= AS_A_RULE * count[1]
