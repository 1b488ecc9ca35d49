"""Profiles that are known as tables of f(r), or of f(x) in a plane contact.

Their slope g′ is made of pieces of polynomials. With w = √(ξ² − b²) and ρ² = r² − b² the integrals are of
powers of w over √(ρ² − w²) inside r, and over √(w² − ρ²) outside: in closed form, piece by piece. Up to a
radius they are the antiderivative of its own piece less that of all the jumps between pieces, each taken at
its knot: the sums over the knots are made once for each position.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile, Tables
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlanePrimitives, PlaneProfile
from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
from swtstudy.mechanics.indenter.slope_fit import SlopePieces
from swtstudy.mechanics.numerics.arrays import TINY, align, gather
from swtstudy.mechanics.numerics.roots import NEWTON_STEPS
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray

#: Gives the coefficient of a power, the same for all or one for each of what is integrated over.
Coefficient = Callable[[int], FloatArray]


#: Share of a face up to which its W is ¼ (Π(r) + Π(0)), which it is but for (r/b)⁴/16: 1e-8. At larger r the
#: rounding of the closed form, 1e-12 over r², is less.
NEAR_AXIS = 0.02


class PiecePrimitives(Primitives):
    """n profiles of one table, at positions (n, X)."""

    def __init__(self, pieces: SlopePieces, position: FloatArray) -> None:
        self.pieces, self.position = pieces, position
        b = pieces.flat_radius
        #: ρ², which is negative under a face.
        self.gap = (position - b) * (position + b)
        self.low = np.sqrt(np.maximum(self.gap, 0.0))
        self._slope, self._over_radius = (
            _in_powers_of_w(c, pieces.start) for c in (self.inner_coefficients(pieces), pieces.over_radius)
        )
        knots = np.broadcast_to(pieces.start, (*position.shape, pieces.start.size))
        jumps = np.diff(self._slope, axis=1, prepend=0.0)
        self._inner_offset = np.cumsum(self._inside(knots, lambda k: jumps[k]), axis=-1)
        self._outer_offset = self._offset_outside(knots)
        #: The integrals at the axis, about which a flat face has a hole; None without a face.
        self._axis: PiecePrimitives | None = None
        if b > 0.0 and np.any(position > 0.0):
            self._axis = type(self)(pieces, np.zeros_like(position))

    @staticmethod
    def inner_coefficients(pieces: SlopePieces) -> FloatArray:
        """Coefficients of what is integrated over the springs inside r."""
        return pieces.slope

    def inner(self, radius: FloatArray) -> FloatArray:
        first, third = self.within(radius)
        r, b = align(self.position, radius), self.pieces.flat_radius
        return np.stack([2.0 / r * first, 2.0 / r**3 * (b * b * first + third)])

    def within(self, radius: FloatArray) -> FloatArray:
        """Integrals of it times w and w³ over √(ρ² − w²) up to ``radius``, shape (2, n, X, …)."""
        w = np.minimum(self._w(radius), align(self.low, radius))
        piece = self.pieces.piece(w)
        first, third = self._inside(w, lambda k: self._slope[k].take(piece))
        first -= self._offset(self._inner_offset[0], piece)
        third -= self._offset(self._inner_offset[1], piece)
        return np.where(align(self.gap, radius) > 0.0, np.stack([first, third]), 0.0)

    def outer(self, radius: FloatArray) -> FloatArray:
        w = np.maximum(self._w(radius), align(self.low, radius))
        pressure, product = self.beyond(w)
        r, low = align(self.position, radius), align(self.low, radius)
        if self._axis is None:
            half_load = self._half_load(w) - self._half_load(low)
            return np.stack([pressure, (half_load - product) / (r * r)])
        # v = ξ at the axis: the load by the same fit, so that nothing is left to be divided by r².
        at_axis, half_load = self._axis.beyond(w)
        half_load = half_load - self._axis.beyond(low)[1]
        near_axis = r < NEAR_AXIS * self.pieces.flat_radius
        inside = np.where(near_axis, 0.25 * (pressure + at_axis), (half_load - product) / (r * r))
        return np.stack([pressure, inside])

    def pressure(self, radius: FloatArray) -> FloatArray:
        return self.beyond(np.maximum(self._w(radius), align(self.low, radius)))[0]

    def beyond(self, w: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Integrals of g′/v and of v g′ over the springs outside r up to w, each of the shape of w."""
        piece = self.pieces.piece(w)
        first, second = self._outside(w, lambda k: self._over_radius[k].take(piece))
        first -= self._offset(self._outer_offset[0], piece)
        second -= self._offset(self._outer_offset[1], piece)
        return first, second

    def _w(self, radius: FloatArray) -> FloatArray:
        b = self.pieces.flat_radius
        return np.sqrt(np.maximum((radius - b) * (radius + b), 0.0)) if b > 0.0 else radius

    def _half_load(self, w: FloatArray) -> FloatArray:
        return self.pieces.value(self.pieces.half_load, w, self.pieces.piece(w))

    def _offset(self, offset: FloatArray, piece: IndexArray) -> FloatArray:
        """Offsets (n, X, m) of the pieces of (n, X or 1, …)."""
        shape = np.broadcast_shapes(piece.shape, (*offset.shape[:2], *(1,) * (piece.ndim - 2)))
        flat = np.broadcast_to(piece, shape).reshape(*shape[:2], -1)
        return gather(offset, flat).reshape(shape)

    def _inside(self, w: FloatArray, slope: Coefficient) -> tuple[FloatArray, FloatArray]:
        """Antiderivatives of Σ a_k wᵏ⁺¹ and Σ a_k wᵏ⁺³ over √(ρ² − w²), k to the degree of g′."""
        rho = align(self.low, w)
        sine = np.minimum(w / np.maximum(rho, TINY), 1.0)
        cosine = np.sqrt((1.0 - sine) * (1.0 + sine))
        # ∫ sinᵏ: each from the one before the last.
        power, integrals = cosine, [np.arcsin(sine), -cosine]
        top = len(self._slope)
        for k in range(2, top + 3):
            power = power * sine
            integrals.append((integrals[k - 2] * (k - 1) - power) * (1.0 / k))
        first, third = np.zeros(()), np.zeros(())
        for k in range(top - 1, -1, -1):
            a = slope(k)
            first, third = first * rho + a * integrals[k + 1], third * rho + a * integrals[k + 3]
        return np.asarray(first * rho), np.asarray(third * rho**3)

    def _outside(self, w: FloatArray, over_radius: Coefficient) -> tuple[FloatArray, FloatArray]:
        """Antiderivatives of Σ b_k wᵏ⁺¹ over √(w² − ρ²), and times it, k to the degree of g′/ξ."""
        gap = align(self.gap, w)
        root = np.sqrt(np.maximum(w * w - gap, 0.0))
        # ∫ wᵏ/√(w² − ρ²): each from the one before the last.
        power, integrals = root, [np.log(np.maximum(w + root, TINY)), root]
        top = len(self._over_radius)
        for k in range(2, top + 3):
            power = power * w
            integrals.append((power + (k - 1) * gap * integrals[k - 2]) * (1.0 / k))
        first, second = np.zeros(()), np.zeros(())
        for k in range(top):
            b = over_radius(k)
            first = first + b * integrals[k + 1]
            second = second + b * (integrals[k + 3] - gap * integrals[k + 1])
        return np.asarray(first), np.asarray(second)

    def _offset_outside(self, knots: FloatArray) -> FloatArray:
        """Offsets of the outer antiderivatives of each piece, where the integral begins at r."""
        start = self.pieces.piece(self.low)
        at_start = np.stack(
            self._outside(self.low[..., None], lambda k: self._over_radius[k].take(start)[..., None])
        )
        jumps = np.diff(self._over_radius, axis=1, prepend=0.0)
        at_knots = np.stack(self._outside(knots, lambda k: jumps[k]))
        counts = np.arange(self.pieces.start.size) > start[..., None]
        return at_start + np.cumsum(np.where(counts, at_knots, 0.0), axis=-1)


def _in_powers_of_w(coefficients: FloatArray, start: FloatArray) -> FloatArray:
    """Coefficients in powers of w from those in powers of w − start."""
    from scipy.special import binom  # as long to import as all else, and few need it

    degree = len(coefficients)
    i, k = np.arange(degree)[:, None], np.arange(degree)
    shifts = (-start) ** np.maximum(i - k, 0)[..., None]
    return np.asarray((coefficients[:, None] * binom(i, k)[..., None] * shifts).sum(axis=0))


#: Nodes that running integrals need beyond those of a smooth profile, for each piece. None: 8e-7 over waves
#: at rtol 1e-7, 1 for each: 5e-8.
NODES_PER_PIECE, MOST_EXTRA_NODES = 0.3, 40
#: Cells of tables up to its end. 500 or 16,000: 5e-11 at 32 points of mixed control.
EVEN_CELLS = 4000


class Tabulated(Profile):
    """n times the profile of one table.

    Parameters
    ----------
    largest_depth
        Shape (n,), δ0.
    table
        The table.
    """

    __match_args__ = ("largest_depth", "table")

    evenly_smooth = False

    def __init__(self, largest_depth: FloatArray, table: TabulatedProfile) -> None:
        super().__init__(largest_depth)
        self.table = table
        self._pieces = table.pieces

    @classmethod
    def compact(cls, largest_depth: FloatArray, **shape: TabulatedProfile) -> BoolArray:  # type: ignore[override]
        return np.asarray(np.asarray(largest_depth) <= shape["table"].deepest)

    @classmethod
    def check(cls, largest_depth: float, **shape: TabulatedProfile) -> str | None:  # type: ignore[override]
        return shape["table"].refused_at(largest_depth)

    @property
    def flat_radius(self) -> FloatArray:
        return np.full(len(self.largest_depth), self._pieces.flat_radius)

    @property
    def landmarks(self) -> FloatArray:
        return np.broadcast_to(self.table.landmarks, (len(self.largest_depth), self.table.landmarks.size))

    def tables(self) -> Tables | None:
        if self._pieces.flat_radius > 0.0:
            return None
        whole = Tabulated(np.array([self.table.deepest]), self.table)
        return Tables(whole, np.zeros(len(self.largest_depth), dtype=np.intp), EVEN_CELLS)

    def extra_nodes(self, digits: float) -> int:
        return min(int(NODES_PER_PIECE * self._pieces.start.size), MOST_EXTRA_NODES)

    def _rise(self, radius: FloatArray) -> FloatArray:
        b = self._pieces.flat_radius
        return np.sqrt(np.maximum((radius - b) * (radius + b), 0.0)) if b > 0.0 else radius

    def depth(self, radius: FloatArray) -> FloatArray:
        w = self._rise(radius)
        return self._pieces.value(self._pieces.depth, w, self._pieces.piece(w))

    def radius(self, depth: FloatArray) -> FloatArray:
        depth, pieces = np.maximum(depth, 0.0), self._pieces
        w = np.interp(np.sqrt(depth), *self.table.guesses)
        for _ in range(NEWTON_STEPS):
            piece = pieces.piece(w)
            error = pieces.value(pieces.depth, w, piece) - depth
            rate = w * pieces.value(pieces.over_radius, w, piece)
            w = np.maximum(w - np.divide(error, rate, out=np.zeros_like(w), where=rate > 0.0), 0.0)
        return np.hypot(w, pieces.flat_radius) if pieces.flat_radius > 0.0 else w

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        w = self._rise(radius)
        return w * self._pieces.value(self._pieces.slope, w, self._pieces.piece(w))

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        w = self._rise(radius)
        piece = self._pieces.piece(w)
        depth, slope = (self._pieces.value(c, w, piece) for c in (self._pieces.depth, self._pieces.slope))
        return depth, w * slope

    def half_load(self, radius: FloatArray) -> FloatArray:
        w = self._rise(radius)
        return self._pieces.value(self._pieces.half_load, w, self._pieces.piece(w))

    def _rise_at_half_load(self, half_load: FloatArray) -> FloatArray:
        return np.interp(np.cbrt(half_load), *self.table.guesses_by_load)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return PiecePrimitives(self._pieces, position)


#: Gauss nodes for N/ξ on a piece: exact to rounding but next to a face.
NODES = 8


class TabulatedPlane(PlaneProfile, Tabulated):
    """n times the profile of one table: the pieces of its N′ stand in the place of those of g′."""

    def depth(self, radius: FloatArray) -> FloatArray:
        return super().depth(radius) / MEAN_LOAD

    def radius(self, depth: FloatArray) -> FloatArray:
        return super().radius(MEAN_LOAD * depth)

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        load, slope = super().depth_and_weighted_slope(radius)
        return load / MEAN_LOAD, slope

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        pieces = self._pieces
        w = self._rise(radius)
        piece = pieces.piece(w)
        start = pieces.start[:-1]
        whole = self._part(start, pieces.start[1:], np.arange(start.size))
        before = np.append(0.0, np.cumsum(whole))
        return before.take(piece) + self._part(pieces.start.take(piece), w, piece)

    def _part(self, low: FloatArray, high: FloatArray, piece: IndexArray) -> FloatArray:
        """∫ N/(N_0 ξ) dξ between places w of pieces."""
        node, weight = np.polynomial.legendre.leggauss(NODES)
        w = low[..., None] + (high - low)[..., None] * (0.5 + 0.5 * node)
        load = self._pieces.value(self._pieces.depth, w, np.broadcast_to(piece[..., None], w.shape))
        square = np.maximum(w * w + self._pieces.flat_radius**2, TINY)
        return np.asarray(0.5 * (high - low) * (load * w / square * weight).sum(axis=-1) / MEAN_LOAD)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return StripPiecePrimitives(self._pieces, position)


class StripPiecePrimitives(PiecePrimitives, PlanePrimitives):
    """Both integrals are of N′/ξ over w."""

    @staticmethod
    def inner_coefficients(pieces: SlopePieces) -> FloatArray:
        return pieces.over_radius

    def inner(self, radius: FloatArray) -> FloatArray:
        return 2.0 * self.within(radius)[:1]

    def outer(self, radius: FloatArray) -> FloatArray:
        return self.pressure(radius)[None]
