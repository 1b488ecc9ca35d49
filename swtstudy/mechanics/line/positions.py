"""Where to look for the maximum of swt along the surface line.

swt(r) has cusps at known places: where the contact edge or a slip front is at the instants at which something
else changes. Between two of them it is smooth but for square roots at the ends and convex kinks, so cosine-
spaced positions resolve it, as cosine-spaced instants resolve the cycle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.numerics.arrays import SAME, between, layer_share, packed, place_in_row
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.line import COORDINATE
from swtstudy.mechanics.stress.scene import Scene

#: The centre is left out, this share of the contact: swt is not largest there, but next to a sharp tip that
#: loses contact, where it may rise within any radius: there is no continuum that small.
INNERMOST = 1e-5
#: With a bulk stress tension is everywhere: under a flat face, and outside of the contact up to so many times
#: its largest radius, beyond which swt differs from that of the bulk stress alone by less than 1e-3 of its
#: difference at the edge.
BEYOND = np.array([1.5, 5.0, 40.0])
#: A face whose edge is singular is left out from this share of its radius on: there is no tension next to it.
BESIDE_FACE = 0.999


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
    new = np.diff(places, axis=1, prepend=0.0) > 0.0
    new[:, -1] = True
    radius = coordinate.radius(packed(new, places)[0])
    largest = radius.max(axis=1, keepdims=True)
    profile = coordinate.profile
    approach, landmarks = profile.singular_approach, np.minimum(profile.landmarks, largest)
    face = profile.flat_radius[:, None]
    if everywhere:
        least = coordinate.radius(np.maximum(cycle.load.least_normal, 0.0)[:, None])
        # Next to the contact the stress outside changes over the way that the edge goes.
        beyond = largest + np.append(largest - least, largest * (BEYOND - 1.0), axis=1)
        innermost = INNERMOST * largest
        if approach.shape[1]:
            nearest = approach.min(axis=1, keepdims=True)
            innermost = np.where(nearest > 0.0, np.minimum(nearest, innermost), innermost)
            radius = np.where(radius <= face, BESIDE_FACE * face, radius)
            face = BESIDE_FACE * face
        ends = np.concatenate([0.0 * face, face, radius, approach, landmarks, beyond], axis=1)
        return np.sort(np.maximum(ends, innermost), axis=1)
    innermost = face + INNERMOST * (largest - face)
    if approach.shape[1]:
        nearest = approach.min(axis=1, keepdims=True)
        innermost = np.where(nearest > face, nearest, innermost)
    ends = np.concatenate([radius, innermost, approach, landmarks], axis=1)
    return np.sort(np.maximum(ends, innermost), axis=1)


@dataclass(frozen=True)
class Pieces:
    """The P smooth pieces of the line between the cusps of n points, point by point, ascending.

    Attributes
    ----------
    point
        Shape (P,): whose they are.
    low, high
        Shape (P,): their ends in a_H; each begins where the last one of its point ends.
    """

    point: IndexArray
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(cls, split: Scene) -> Pieces:
        """Pieces of n points, whose cycles are cut where a slip front passes a breakpoint of the memory."""
        ends = cusps(split.cycle, split.coordinate, split.critical_everywhere)
        return cls.between(ends, split.profile.feature_length)

    @classmethod
    def between(cls, ends: FloatArray, feature_length: FloatArray) -> Pieces:
        """Pieces between the `cusps`, (n, k), that have a length; none is longer than a wave, (n,)."""
        low, high = ends[:, :-1], ends[:, 1:]
        # Longer ones count. All: 2e-4 at a point of tests/mechanics/test_overlooked.py; from 1e-12 of r on:
        # 3e-6 at another.
        point, number = np.nonzero(high - low > COORDINATE * high)
        last = np.append(np.diff(point) > 0, True)
        # However short a piece is left out, the next one begins there: a thin slip zone has its s at the end.
        begin = low[point, number]
        end = np.where(last, ends[point, -1], np.roll(begin, -1))
        waves = np.ceil((end - begin) / feature_length[point]).clip(1.0).astype(np.intp)
        each = np.repeat(np.arange(waves.size), waves)
        wave, length = place_in_row(each), ((end - begin) / waves)[each]
        begin, is_last = begin[each], wave == waves[each] - 1
        return cls(
            point[each], begin + wave * length, np.where(is_last, end[each], begin + (wave + 1) * length)
        )

    @property
    def is_last(self) -> BoolArray:
        """Shape (P,): which are the last of their points."""
        return np.append(np.diff(self.point) > 0, True)

    @property
    def are_long(self) -> BoolArray:
        """Shape (P,): the innermost of each point, and those as long as the mean of its others, nearly."""
        length, innermost = self.high - self.low, np.append(True, np.diff(self.point) > 0)
        others = np.bincount(self.point, np.where(innermost, 0.0, length)) / np.bincount(self.point)
        return np.asarray(innermost | (length >= others[self.point]))

    def layers(self, thin: float) -> tuple[IndexArray, FloatArray]:
        """Where thin layers of pieces end: what happens in a short piece makes one in a long neighbour, too.

        Parameters
        ----------
        thin
            Largest share of the angle of a piece that counts.

        Returns
        -------
        piece, share
            Shape (k,): numbers of the pieces, ascending, and shares of their angles.
        """
        length = self.high - self.low
        before = np.append(np.inf, np.where(np.diff(self.point) == 0, length[:-1], np.inf))
        after = np.append(np.where(np.diff(self.point) == 0, length[1:], np.inf), np.inf)
        share = layer_share(np.stack([before, after], axis=1), length[:, None])
        piece, side = np.nonzero(share < thin)
        return piece, np.where(side == 0, share[piece, side], 1.0 - share[piece, side])

    def radius(self, piece: IndexArray, alpha: FloatArray) -> FloatArray:
        """Positions r at the angles α of pieces, both of shape (m,)."""
        return between(self.low[piece], self.high[piece], alpha)


@dataclass(frozen=True)
class Positions(Rows):
    """m positions on the line of n points, one point's after the other's, ascending.

    Attributes
    ----------
    point
        Shape (m,): whose they are.
    r
        Shape (m,): |x| in a_H.
    low, high, alpha, step
        Shape (m, 2), for the left and the right side of each position: the ends of the piece, the angle α of
        the position in it, and the change of α to the next position.
    """

    point: IndexArray
    r: FloatArray
    low: FloatArray
    high: FloatArray
    alpha: FloatArray
    step: FloatArray

    @classmethod
    def of(cls, pieces: Pieces, piece: IndexArray, alpha: FloatArray) -> Positions:
        """Positions at angles of pieces, in their order; each piece but the last of a point lacks its end."""
        point = pieces.point[piece]
        first = np.append(True, np.diff(point) > 0)
        last = np.append(first[1:], True)
        begins = (alpha == 0.0) & ~first
        before = np.where(begins, piece - 1, piece)
        left = np.where(begins, np.pi, alpha)
        right = np.append(np.where(begins[1:], np.pi, alpha[1:]), 0.0) - alpha
        sides = np.stack([before, piece], axis=-1)
        step = np.stack([np.where(first, 0.0, np.roll(right, 1)), np.where(last, 0.0, right)], axis=-1)
        r = pieces.radius(piece, alpha)
        return cls(point, r, pieces.low[sides], pieces.high[sides], np.stack([left, alpha], axis=-1), step)

    @property
    def is_corner(self) -> BoolArray:
        """Shape (m,): whether a piece ends there, so that swt may have a cusp."""
        return np.asarray(
            (self.alpha[:, 0] == np.pi) | (self.alpha[:, 1] == 0.0) | (self.alpha[:, 1] == np.pi)
        )

    @property
    def is_even(self) -> BoolArray:
        """Shape (m,): whether both neighbours are equally far."""
        return np.asarray(np.abs(np.diff(self.step)[:, 0]) <= SAME * self.step[:, 0])

    def around(self, c: FloatArray) -> FloatArray:
        """r beside the positions, shape (m, k), at c from −1, the left neighbour, to 1, the right one."""
        right = c > 0.0

        def of_side(values: FloatArray) -> FloatArray:
            return np.where(right, values[:, 1:], values[:, :1])

        turn = c * of_side(self.step)
        # Within a piece r is a smooth function of c, also where the neighbours are not equally far.
        rows = np.flatnonzero(~self.is_corner & ~self.is_even)
        if rows.size:
            left, far = self.step[rows, :1], self.step[rows, 1:]
            ratio = np.log(far / left)
            turn[rows] = far * np.expm1(ratio * c[rows]) / np.expm1(ratio)
        alpha = np.clip(of_side(self.alpha) + turn, 0.0, np.pi)
        return between(of_side(self.low), of_side(self.high), alpha)
