"""Where to look for the maximum of swt along the surface line.

swt(r) has cusps at known places: where the contact edge or a slip front is at the instants at which something
else changes. Between two of them it is smooth but for square roots at the ends and convex kinks, so cosine-
spaced positions resolve it, as cosine-spaced instants resolve the cycle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.cosine import between
from swtstudy.mechanics.points import FloatArray

#: Positions that the first look spreads over the contact besides the cusps. Half or twice as many: less than
#: 1e-6, the same time, at 128 points of the box, which are not those with narrow maxima.
SPREAD = 24
#: So many more for each wave, and for each tangential oscillation within a normal one beyond the first:
#: what sticks at touch-down keeps the oscillation.
SPREAD_PER_WAVE, SPREAD_PER_OSCILLATION = 8, 4
#: The centre is left out: swt is smooth there and not largest, unless the contact shrinks to it: then half of
#: its least radius is left out, and where contact is lost this share. 0.2 in place of 0.02: 7e-3 at some
#: of 600 points.
INNERMOST, INNERMOST_OF_LOST = 0.02, 1e-3
#: With a bulk stress tension is everywhere: under a flat face, and outside of the contact up to so many times
#: its largest radius, beyond which swt differs from that of the bulk stress alone by less than 1e-3 of its
#: difference at the edge.
BEYOND = np.array([1.5, 5.0, 40.0])
#: Steps of each of these stretches, in which swt has no cusps.
OUTSIDE_STEPS = 5
#: A face whose edge is singular is left out from this share of its radius on: there is no tension next to it.
BESIDE_FACE = 0.999
#: A stretch between cusps shorter than this share of the range is none. 1e-14: no change; 1e-10: 2e-10.
NO_LENGTH = 1e-12
#: Stretches whose ends are more than this apart, as a ratio, are shared by the logarithm: they lead to a tip.
FAR_APART = 1e4
#: Angles α nearer than this to 0 or π are an end of the stretch. 1e-11 or 1e-7: no change at 128 points.
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


def cusps(cycle: Cycle, coordinate: Coordinate, everywhere: bool = False) -> FloatArray:
    """Radii at which swt(r) may have a cusp, and the ends of the range, ascending, shape (n, k).

    With ``everywhere`` the range is not the contact's but that of a bulk stress, see `BEYOND`.
    """
    n = len(cycle.begin)
    # Empty intervals, which fill up the rows of a batch, have nothing to say.
    lasts = cycle.end > cycle.begin
    starts = np.where(lasts[..., None], cycle.memory.start, np.inf).reshape(n, -1)
    edges = np.where(lasts, np.maximum(cycle.load.normal(cycle.begin), 0.0), 0.0)
    deepest = cycle.load.largest_normal[:, None]
    places = np.concatenate([deepest, edges, np.where(np.isfinite(starts), starts, 0.0)], axis=1)
    places = np.sort(places, axis=1)
    motion = np.minimum(cycle.load.motion, 1.0)
    new = np.diff(places, axis=1, prepend=0.0) > cycle.load.same_cusp * motion[:, None]
    new[:, -1] = True
    radius = coordinate.radius(packed(new, places)[0])
    largest = radius.max(axis=1, keepdims=True)
    profile = coordinate.profile
    approach = profile.singular_approach
    face = profile.flat_radius[:, None]
    if everywhere:
        least = coordinate.radius(np.maximum(cycle.load.least_normal, 0.0)[:, None])
        # Next to the contact the stress outside changes over the way that the edge goes.
        beyond = largest + np.append(largest - least, largest * (BEYOND - 1.0), axis=1)
        innermost = INNERMOST_OF_LOST * largest
        if approach.shape[1]:
            nearest = approach.min(axis=1, keepdims=True)
            innermost = np.where(nearest > 0.0, np.minimum(nearest, innermost), innermost)
            radius = np.where(radius <= face, BESIDE_FACE * face, radius)
            face = BESIDE_FACE * face
        ends = np.concatenate([0.0 * face, face, radius, approach, beyond], axis=1)
        return np.sort(np.maximum(ends, innermost), axis=1)
    least = coordinate.radius(np.maximum(cycle.load.least_normal, 0.0)[:, None]) - face
    share = np.clip(0.5 * least / (largest - face), INNERMOST_OF_LOST, INNERMOST)
    innermost = face + share * (largest - face)
    if approach.shape[1]:
        nearest = approach.min(axis=1, keepdims=True)
        innermost = np.where(nearest > face, nearest, innermost)
    landmarks = np.minimum(profile.landmarks, largest)
    ends = np.concatenate([radius, innermost, approach, landmarks], axis=1)
    return np.sort(np.maximum(ends, innermost), axis=1)


def spread_positions(
    ends: FloatArray,
    spread: FloatArray,
    flat_radius: FloatArray,
    within: tuple[FloatArray, FloatArray] | None = None,
) -> Positions:
    """Cosine-spaced positions between the cusps, about ``spread`` of them and two for each cusp at most.

    Parameters
    ----------
    ends
        Shape (n, k), see `cusps`.
    spread
        Shape (n,): number of positions over the whole range, were there no cusps.
    flat_radius
        Shape (n,): b. Beside a face depth is like w = √(r² − b²): by that, too, the positions are shared.
    within
        Shape (n, 1): ends of the range that is meant, if not the whole; stretches outside of it have
        `OUTSIDE_STEPS`.
    """
    parts = _StretchesOfRange.of(ends, spread, flat_radius, within)
    stretch, place, count = parts.places()
    step = gather(np.pi / parts.steps, stretch)
    alpha = place * step
    before = parts.before(stretch, place)
    left = np.where(before == stretch, alpha, np.pi)

    def both_sides(values: FloatArray) -> FloatArray:
        return np.stack([gather(values, before), gather(values, stretch)], axis=-1)

    return Positions(
        _places(gather(parts.low, stretch), gather(parts.high, stretch), alpha),
        count,
        both_sides(parts.low),
        both_sides(parts.high),
        np.stack([left, alpha], axis=-1),
        both_sides(np.pi / parts.steps),
    )


def _places(low: FloatArray, high: FloatArray, alpha: FloatArray) -> FloatArray:
    """Radii between ``low`` (α = 0) and ``high`` (α = π)."""
    places = between(low, high, alpha)
    far = np.broadcast_to(high > FAR_APART * low, alpha.shape)
    if far.any():
        low, high, alpha = (values[far] for values in np.broadcast_arrays(low, high, alpha))
        places[far] = np.exp(between(np.log(low), np.log(high), alpha))
    return places


@dataclass(frozen=True)
class _StretchesOfRange:
    """The m stretches between the cusps, arrays of shape (n, m).

    Attributes
    ----------
    low, high
        Their ends.
    steps
        Numbers of steps between the positions of each.
    real
        Which have a length.
    last
        Shape (n,): the last of these.
    """

    low: FloatArray
    high: FloatArray
    steps: NDArray[np.intp]
    real: NDArray[np.bool_]
    last: NDArray[np.intp]

    @classmethod
    def of(
        cls,
        ends: FloatArray,
        spread: FloatArray,
        flat: FloatArray,
        within: tuple[FloatArray, FloatArray] | None,
    ) -> _StretchesOfRange:
        """See `spread_positions`."""
        low, high = ends[:, :-1], ends[:, 1:].copy()
        first, last = within or (ends[:, :1], ends[:, -1:])
        length, total = high - low, last - first

        def rise(radius: FloatArray) -> FloatArray:
            return np.sqrt(np.maximum((radius - flat[:, None]) * (radius + flat[:, None]), 0.0))

        share = np.maximum(length / total, np.diff(rise(ends)) / (rise(last) - rise(first)))
        steps = np.clip(np.ceil(share * spread[:, None]), 1, None).astype(np.intp)
        if within:
            steps[(low >= last) | (high <= first)] = OUTSIDE_STEPS
        # Next to a sharp tip stretches are short, but not as they lie there.
        real = length > np.minimum(NO_LENGTH * total, 0.5 * high)
        outermost = real.shape[1] - 1 - real[:, ::-1].argmax(axis=1)
        # However short a stretch is left out behind it: a thin slip zone has its s at the end of the range.
        high[np.arange(len(ends)), outermost] = ends[:, -1]
        return cls(low, high, steps, real, outermost)

    def places(self) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        """Stretch of each position and its place in it, shape (n, X), and the number of positions, (n,).

        Each stretch with a length has the positions at its steps; only the last one has its end, too.
        """
        n, m = self.low.shape
        number = np.arange(int(self.steps.max()) + 1)
        keep = self.real[:, :, None] & (number < self.steps[:, :, None])
        keep[np.arange(n), self.last, self.steps[np.arange(n), self.last]] = True
        kept = keep.reshape(n, -1)
        stretch, place = (
            np.broadcast_to(values, keep.shape).reshape(n, -1) for values in (np.arange(m)[:, None], number)
        )
        return *packed(kept, stretch, place), kept.sum(axis=1)

    def before(self, stretch: NDArray[np.intp], place: NDArray[np.intp]) -> NDArray[np.intp]:
        """The stretch to the left of each position: its own but at its begin."""
        number = np.arange(self.low.shape[1])
        previous = np.maximum.accumulate(np.where(self.real, number, -1), axis=1)
        left = np.where(place > 0, stretch, gather(previous, np.maximum(stretch - 1, 0)))
        return np.where((place == 0) & (stretch == 0) | (left < 0), stretch, left)


def positions_of_first_look(cycle: Cycle, coordinate: Coordinate, everywhere: bool = False) -> Positions:
    """Positions of the first look at each of the n points; for ``everywhere`` see `cusps`."""
    ends = cusps(cycle, coordinate, everywhere)
    low, high = ends[:, :1], ends[:, -1:]
    if everywhere:
        low = np.maximum(low, coordinate.profile.flat_radius[:, None])
        high = ends[:, -2 - BEYOND.size, None]
    waves = (high - low)[:, 0] / coordinate.profile.feature_length
    normal, tangential = cycle.load.oscillations
    oscillations = max(tangential / normal - 1.0, 0.0)
    spread = SPREAD + SPREAD_PER_WAVE * waves + SPREAD_PER_OSCILLATION * oscillations
    flat = coordinate.profile.flat_radius
    return spread_positions(ends, spread, flat, (low, high) if everywhere else None)


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

    def take(self, index: NDArray[np.intp]) -> PositionBrackets:
        """The brackets at ``index``."""
        return PositionBrackets(*(values[index] for values in vars(self).values()))

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
        return _places(of_side(self.low), of_side(self.high), alpha)
