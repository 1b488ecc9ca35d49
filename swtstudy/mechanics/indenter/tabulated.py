"""A profile that is known as a table of f(r)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.indenter.base import Primitives, Profile, Tables
from swtstudy.mechanics.indenter.piece_primitives import PiecePrimitives
from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
from swtstudy.mechanics.points import FloatArray

#: Newton's steps for the contact radius, from a guess that is off by 1e-3.
NEWTON_STEPS = 3
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
    def compact(cls, largest_depth: FloatArray, **shape: TabulatedProfile) -> NDArray[np.bool_]:  # type: ignore[override]
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
