"""A profile of a plane contact that is known as a table of f(x)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.indenter.base import Primitives
from swtstudy.mechanics.indenter.piece_primitives import PiecePrimitives
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlanePrimitives, PlaneProfile
from swtstudy.mechanics.indenter.slope_fit import SlopePieces
from swtstudy.mechanics.indenter.tabulated import Tabulated
from swtstudy.mechanics.points import FloatArray

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

    def _part(self, low: FloatArray, high: FloatArray, piece: NDArray[np.intp]) -> FloatArray:
        """∫ N/(N_0 ξ) dξ between places w of pieces."""
        node, weight = np.polynomial.legendre.leggauss(NODES)
        w = low[..., None] + (high - low)[..., None] * (0.5 + 0.5 * node)
        load = self._pieces.value(self._pieces.depth, w, np.broadcast_to(piece[..., None], w.shape))
        square = np.maximum(w * w + self._pieces.flat_radius**2, 1e-300)
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
        return super().outer(radius)[:1]

    def pressure(self, radius: FloatArray) -> FloatArray:
        return np.asarray(self.outer(radius)[0])
