"""Where to look for the maximum of swt along the surface line.

swt(r) has cusps at known places: where the contact edge or a slip front is at the instants at which something
else changes. Between two of them it is smooth but for square roots at the ends and convex kinks, so cosine-
spaced positions resolve it, as cosine-spaced instants resolve the cycle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import Cycle
from swtstudy.mechanics.gather import gather, packed
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile

#: Positions that the first look spreads over the contact besides the cusps.
SPREAD = 24
#: So many more for each wave, and for each tangential oscillation within a normal one beyond the first:
#: what sticks at touch-down keeps the oscillation.
SPREAD_PER_WAVE, SPREAD_PER_OSCILLATION = 8, 4
#: The centre is left out: swt is smooth there and not largest, unless the contact shrinks to it: then half of
#: its least radius is left out, and where contact is lost this share.
INNERMOST, INNERMOST_OF_LOST = 0.02, 1e-3
#: Depths of cusps nearer than this, in the amplitudes of the motion, are one.
SAME_DEPTH = 1e-9
#: Share of the range below which a stretch between cusps is none.
NO_STRETCH = 1e-12
#: Angles α nearer than this to 0 or π are an end of the stretch.
END = 1e-9


@dataclass(frozen=True)
class Positions:
    """Positions r of a first look, ascending, and how they lie in the smooth stretches.

    Attributes
    ----------
    r
        Shape (n, X); shorter rows repeat their first position.
    count
        Shape (n,): number of positions of each row.
    low, high, alpha, step
        Shape (n, X, 2), for the left and the right side of each position: the ends of the stretch, the
        angle α of the position in it, and the change of α to the next position.
    """

    r: FloatArray
    count: NDArray[np.intp]
    low: FloatArray
    high: FloatArray
    alpha: FloatArray
    step: FloatArray


def cusps(cycle: Cycle, profile: Profile) -> FloatArray:
    """Radii at which swt(r) may have a cusp, and the ends of the range, ascending, shape (n, k)."""
    n = len(cycle.begin)
    # Empty intervals, which fill up the rows of a batch, have nothing to say.
    lasts = cycle.end > cycle.begin
    starts = np.where(lasts[..., None], cycle.memory.start, np.inf).reshape(n, -1)
    edges = np.where(lasts, np.maximum(cycle.protocol.depth(cycle.begin), 0.0), 0.0)
    largest_depth = 1.0 + cycle.protocol.normal_amplitude[:, None]
    depth = np.concatenate([largest_depth, edges, np.where(np.isfinite(starts), starts, 0.0)], axis=1)
    depth = np.sort(depth, axis=1)
    motion = np.minimum(cycle.protocol.normal_amplitude + cycle.protocol.tangential_amplitude, 1.0)
    new = np.diff(depth, axis=1, prepend=0.0) > SAME_DEPTH * motion[:, None]
    new[:, -1] = True
    radius = profile.radius(packed(new, depth)[0])
    largest = radius.max(axis=1, keepdims=True)
    approach = profile.singular_approach
    face = profile.flat_radius[:, None]
    least = profile.radius(np.maximum(1.0 - cycle.protocol.normal_amplitude, 0.0)[:, None]) - face
    share = np.clip(0.5 * least / (largest - face), INNERMOST_OF_LOST, INNERMOST)
    innermost = face + share * (largest - face)
    if approach.shape[1]:
        nearest = approach.min(axis=1, keepdims=True)
        innermost = np.where(nearest > face, nearest, innermost)
    ends = np.concatenate([radius, innermost, approach], axis=1)
    return np.sort(np.maximum(ends, innermost), axis=1)


def spread_positions(ends: FloatArray, spread: FloatArray) -> Positions:
    """Cosine-spaced positions between the cusps, about ``spread`` of them and two for each cusp at most.

    Parameters
    ----------
    ends
        Shape (n, k), see `cusps`.
    spread
        Shape (n,): number of positions over the whole range, were there no cusps.
    """
    n, count = ends.shape
    low, high = ends[:, :-1], ends[:, 1:]
    length = high - low
    total = ends[:, -1:] - ends[:, :1]
    steps = np.clip(np.ceil(length / total * spread[:, None]), 1, None).astype(np.intp)
    most = int(steps.max())
    number = np.arange(most + 1)
    real = length > NO_STRETCH * total
    keep = real[:, :, None] & (number < steps[:, :, None])
    stretch = np.broadcast_to(np.arange(count - 1)[:, None], keep.shape)
    place = np.broadcast_to(number, keep.shape)
    # The last real stretch keeps its end.
    last = count - 2 - real[:, ::-1].argmax(axis=1)
    keep[np.arange(n), last, steps[np.arange(n), last]] = True
    # … which is the end of the range, however short a stretch is left out: a thin slip zone has its s there.
    high = high.copy()
    high[np.arange(n), last] = ends[:, -1]
    keep = keep.reshape(n, -1)
    stretch, place = packed(keep, stretch.reshape(n, -1), place.reshape(n, -1))

    previous = np.maximum.accumulate(np.where(real, np.arange(count - 1), -1), axis=1)
    before = np.where(place > 0, stretch, gather(previous, np.maximum(stretch - 1, 0)))
    before = np.where((place == 0) & (stretch == 0) | (before < 0), stretch, before)
    step = np.pi / steps
    alpha = place * gather(step, stretch)
    inside = before == stretch
    left = np.where(inside, alpha, np.pi)
    sides = np.stack([before, stretch], axis=-1)

    def of_sides(values: FloatArray) -> FloatArray:
        return gather(values, sides.reshape(n, -1)).reshape(sides.shape)

    return Positions(
        _cosine(gather(low, stretch), gather(high, stretch), alpha),
        keep.sum(axis=1),
        of_sides(low),
        of_sides(high),
        np.stack([left, alpha], axis=-1),
        of_sides(step),
    )


def positions_of_first_look(cycle: Cycle, profile: Profile) -> Positions:
    """Positions of the first look at each of the n points."""
    ends = cusps(cycle, profile)
    waves = (ends[:, -1] - ends[:, 0]) / profile.feature_length
    oscillations = max(cycle.protocol.p / cycle.protocol.q - 1.0, 0.0)
    return spread_positions(ends, SPREAD + SPREAD_PER_WAVE * waves + SPREAD_PER_OSCILLATION * oscillations)


def _cosine(low: FloatArray, high: FloatArray, alpha: FloatArray) -> FloatArray:
    return low + (high - low) * (0.5 - 0.5 * np.cos(alpha))


@dataclass(frozen=True)
class PositionBrackets:
    """m brackets around positions, walked by c from −1 (left neighbour) to 1 (right neighbour).

    Attributes
    ----------
    low, high, alpha, step
        Shape (m, 2), as in `Positions`.
    """

    low: FloatArray
    high: FloatArray
    alpha: FloatArray
    step: FloatArray

    @classmethod
    def around(
        cls, positions: Positions, row: NDArray[np.intp], column: NDArray[np.intp]
    ) -> PositionBrackets:
        """Brackets around the positions in ``column`` of ``row``, each of shape (m,)."""
        at = row, column
        return cls(positions.low[at], positions.high[at], positions.alpha[at], positions.step[at])

    @property
    def is_corner(self) -> NDArray[np.bool_]:
        """Shape (m,): whether a stretch ends at c = 0, so that swt may have a cusp there."""
        at_end = (self.alpha[:, 0] <= END) | (self.alpha[:, 1] >= np.pi - END)
        return np.asarray(
            at_end | (self.low[:, 0] != self.low[:, 1]) | (self.alpha[:, 0] != self.alpha[:, 1])
        )

    def radius(self, c: FloatArray) -> FloatArray:
        """Positions r at c, shape (m, k)."""
        right = c > 0.0

        def of_side(values: FloatArray) -> FloatArray:
            return np.where(right, values[:, 1:], values[:, :1])

        alpha = np.clip(of_side(self.alpha) + c * of_side(self.step), 0.0, np.pi)
        return _cosine(of_side(self.low), of_side(self.high), alpha)
