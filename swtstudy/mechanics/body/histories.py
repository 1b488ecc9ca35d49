"""Stress histories at places of the body, each at instants of its own.

The sums over `SpringCells` are made once for each place; no instant makes cells for the others.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.spring_cells import SpringCells
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field.kernels import kernels_of
from swtstudy.mechanics.stress.scene import Scene

#: Places whose sums are made at a time: 8 or 128: 1.2 times the time.
PLACES = 32


class Histories:
    """The body of one contact cycle at N places.

    Parameters
    ----------
    scene
        A batch of one point.
    radius, depth, angle
        Shape (N,): distance from the axis and depth in a_H, and angle about the axis from x.
    springs
        Those of the scene.
    """

    def __init__(
        self, scene: Scene, radius: FloatArray, depth: FloatArray, angle: FloatArray, springs: SpringCells
    ) -> None:
        self.scene, self.radius, self.depth, self.angle = scene, radius, depth, angle
        self.springs, self.kernels = springs, kernels_of(scene.profile)
        self.x, self.y = (radius * turn(angle) for turn in (np.cos, np.sin))
        cells, pieces = springs.cell.size, springs.share.size
        count = len(self.kernels.functions._fields)
        #: Shape (f, c · N): what a closed form of f functions lacks to the integral from its first cell.
        self.constant = np.empty((count, cells * radius.size))
        #: Shape (f, m · N): what it lacks to the integral from the axis, over all pieces.
        self.base = np.empty((count, pieces * radius.size))
        constant = self.constant.reshape(count, cells, -1)
        base = self.base.reshape(count, pieces, -1)
        for part in (slice(at, at + PLACES) for at in range(0, radius.size, PLACES)):
            plain, weighted = self.kernels.primitives(radius[part], depth[part], springs.ends[:, None])
            sums, constant[..., part] = self._sums(np.stack(plain), np.stack(weighted))
            base[..., part] = self._pieces(sums)

    def _sums(self, plain: FloatArray, weighted: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Integrals up to the begin of each cell, and up to the end of the last one; what they lack."""
        springs = self.springs
        intercept, gradient, cell = springs.intercept[:, None], springs.gradient[:, None], springs.cell
        left = intercept * plain[:, cell] + gradient * weighted[:, cell]
        steps = intercept * plain[:, cell + 1] + gradient * weighted[:, cell + 1] - left
        sums = np.zeros((len(plain), cell.size + 1, plain.shape[-1]))
        np.cumsum(steps, axis=1, out=sums[:, 1:])
        return sums, sums[:, :-1] - left

    def _pieces(self, sums: FloatArray) -> FloatArray:
        """Integrals over all pieces inside of each piece, without its own up to its start."""
        springs = self.springs
        share, below = springs.share[:, None], springs.below
        own = share * sums[:, springs.start]
        inner = share[below] * sums[:, springs.below_start] - own[:, below]
        base = np.zeros_like(own)
        for level in range(1, int(springs.level.max(initial=0)) + 1):
            some = springs.level == level
            base[:, some] = base[:, below[some]] + inner[:, some]
        return base - own

    def stress(self, instant: FloatArray, rows: NDArray[np.intp] | None = None) -> FloatArray:
        """Stress in E* √(δ0/R) at instants of places.

        Parameters
        ----------
        instant
            Shape (m, T).
        rows
            Shape (m,): which places; all without it.

        Returns
        -------
        Shape (m, T, 6).
        """
        at = np.arange(len(self.radius)) if rows is None else rows
        ν = float(self.scene.poisson_ratio[0])
        where = np.repeat(at, instant.shape[1])
        normal, drag = self._functions(instant.ravel(), where)
        x, y, z = (values.take(where) for values in (self.x, self.y, self.depth))
        stress = self.kernels.normal(normal, x, y, z, ν) + self.kernels.tangential(drag, x, y, z, ν)
        stress = stress.reshape(*instant.shape, 6)
        self.scene.add_bulk(stress, instant)
        return stress

    def _functions(self, instant: FloatArray, place: NDArray[np.intp]) -> tuple[Any, Any]:
        """The functions integrated over the springs at instants of places, (n,), of pressure and of drag."""
        scene, springs = self.scene, self.springs
        cycle, coordinate = scene.cycle, scene.coordinate
        interval = np.minimum(np.searchsorted(cycle.end[0], instant), cycle.end.shape[1] - 1)
        states = cycle.states(interval[None], instant[None])
        edge, front = (
            np.maximum(coordinate.radius(v)[0], springs.ends[0]) for v in (states.edge, states.front)
        )
        sign, piece = states.sign[0], springs.index[interval, states.piece[0]]
        function, share = springs.function[piece], springs.share[piece]
        profile = np.zeros_like(function)
        primitive = self._primitives(edge, place)
        normal = self._up_to(edge, profile, place, primitive)
        # Where nothing slips the front is at the edge.
        inner, slips = normal.copy(), np.flatnonzero(front < edge)
        at_front = self._primitives(front[slips], place[slips])
        inner[:, slips] = self._up_to(front[slips], profile[slips], place[slips], at_front)
        primitive[..., slips] = at_front
        held, grown = inner * share, np.flatnonzero(function)
        held[:, grown] = self._up_to(front[grown], function[grown], place[grown], primitive[..., grown])
        held += self.base.take(piece * len(self.radius) + place, axis=1)
        # q = −(μ/π) ∫ τ′ dξ/√(ξ² − r²): hence the sign of the drag.
        drag = -scene.friction[0] * (held - sign * (normal - inner))
        return self.kernels.functions(*normal), self.kernels.functions(*drag)

    def _primitives(self, radius: FloatArray, place: NDArray[np.intp]) -> FloatArray:
        """Primitives of the functions, with the weights 1 and ξ, at radii, shape (2, f, …)."""
        return np.array(self.kernels.primitives(self.radius.take(place), self.depth.take(place), radius))

    def _up_to(
        self, radius: FloatArray, function: NDArray[np.intp], place: NDArray[np.intp], primitive: FloatArray
    ) -> FloatArray:
        """Integrals of slope functions from their first cells to radii at places, shape (f, …)."""
        cell = self.springs.cell_of(radius, function)
        result = self.constant.take(cell * len(self.radius) + place, axis=1)
        result += self.springs.intercept.take(cell) * primitive[0]
        result += self.springs.gradient.take(cell) * primitive[1]
        return result
