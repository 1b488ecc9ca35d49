"""Stress histories at places of the body, each at instants of its own.

At each instant the springs follow the pieces of the memory up to the slip front, and slip from there to the
edge. So the integrals over the springs are sums up to the start of a piece, which do not know the instant,
and closed forms of the front's and the edge's radius: no instant makes cells for the others.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.memory import GROWTH
from swtstudy.mechanics.points import FloatArray, IntArray
from swtstudy.mechanics.stress.field.primitives import primitives
from swtstudy.mechanics.stress.field.punch import PunchFunctions, normal_components, tangential_components
from swtstudy.mechanics.stress.field.slope_cells import SlopeCells
from swtstudy.mechanics.stress.scene import Scene


class Histories:
    """The body of one contact cycle at N places.

    Parameters
    ----------
    scene
        A batch of one point.
    radius, depth, angle
        Shape (N,): distance from the axis and depth in a_H, and angle about the axis from x.
    slopes, branches
        See `contact_states.resolving_cells`.
    """

    def __init__(
        self,
        scene: Scene,
        radius: FloatArray,
        depth: FloatArray,
        angle: FloatArray,
        slopes: SlopeCells,
        branches: IntArray,
    ) -> None:
        self.scene, self.radius, self.depth, self.angle = scene, radius, depth, angle
        self.ends = slopes.radius
        #: Shape (f · m,): the slope functions on the cells, over π.
        self.intercept, self.gradient = (v.ravel() / np.pi for v in (slopes.intercept, slopes.gradient))
        plain, weighted = (np.stack(f) for f in primitives(radius, depth, self.ends[:, None]))
        cell = (len(slopes.intercept), 1, -1, 1)
        intercept, gradient = self.intercept.reshape(cell), self.gradient.reshape(cell)
        step = intercept * np.diff(plain, axis=1) + gradient * np.diff(weighted, axis=1)
        sums = np.concatenate([np.zeros_like(step[:, :, :1]), np.cumsum(step, axis=2)], axis=2)
        constant = sums[:, :, :-1] - intercept * plain[:, :-1] - gradient * weighted[:, :-1]
        #: Shape (10, f · m · N): what a closed form lacks to the integral from the axis.
        self.constant = np.moveaxis(constant, 1, 0).reshape(len(plain), -1)
        self._sum_pieces(sums, branches)

    def _sum_pieces(self, sums: FloatArray, branches: IntArray) -> None:
        """Sums over all pieces inside of each piece of the memory."""
        memory = self.scene.cycle.memory.take((0,))
        finite = np.isfinite(memory.start)
        start = np.where(finite, memory.start, 0.0)
        radius = self.scene.coordinate.radius(start[None])[0]
        middle = 0.5 * (self.ends[1:] + self.ends[:-1])
        at = np.searchsorted(middle, radius)
        grown = finite & (memory.slope == GROWTH)
        #: Shape (i, d): number of the slope function, and its share in dτ/dG; τ′ = −o′ on lines.
        self.function = np.where(grown, 1 + np.searchsorted(branches, memory.branch), 0)
        self.share = np.where(grown, 1.0, np.where(finite, -memory.slope, 0.0))
        first = self.share[..., None, None] * sums[self.function, :, at]
        base = np.zeros_like(first)
        for piece in range(1, start.shape[1]):
            before = self.share[:, piece - 1, None, None] * sums[self.function[:, piece - 1], :, at[:, piece]]
            base[:, piece] = base[:, piece - 1] + before - first[:, piece - 1]
        #: Shape (10, i · d · N).
        self.base = np.moveaxis(base - first, 2, 0).reshape(base.shape[2], -1)

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
        ν = float(self.scene.poisson_ratio[0])
        at = np.arange(len(self.radius)) if rows is None else rows
        normal, drag = self._functions(instant, np.broadcast_to(at[:, None], instant.shape))
        x, y = (self.radius[at] * turn(self.angle[at]) for turn in (np.cos, np.sin))
        place = x[:, None], y[:, None], self.depth[at, None]
        return normal_components(normal, *place, ν) + tangential_components(drag, *place, ν)

    def _functions(
        self, instant: FloatArray, place: NDArray[np.intp]
    ) -> tuple[PunchFunctions, PunchFunctions]:
        """The ten functions integrated over the springs at instants of places, of pressure and of drag."""
        scene = self.scene
        cycle, coordinate = scene.cycle, scene.coordinate
        interval = np.minimum(np.searchsorted(cycle.end[0], instant), cycle.end.shape[1] - 1)
        states = cycle.states(interval[None], instant[None])
        edge, front = (np.maximum(coordinate.radius(v)[0], self.ends[0]) for v in (states.edge, states.front))
        sign, piece = states.sign[0], interval * self.share.shape[1] + states.piece[0]
        function, share = self.function.ravel()[piece], self.share.ravel()[piece]
        profile = np.zeros_like(function)
        normal = self._up_to(edge, profile, place)
        # Where nothing slips the front is at the edge.
        inner = normal.copy()
        slips = front < edge
        inner[:, slips] = self._up_to(front[slips], profile[slips], place[slips])
        held = inner * share
        grown = function > 0
        held[:, grown] = self._up_to(front[grown], function[grown], place[grown])
        held += self.base.take(piece * len(self.radius) + place, axis=1)
        # q = −(μ/π) ∫ τ′ dξ/√(ξ² − r²): hence the sign of the drag.
        drag = -scene.friction[0] * (held - sign * (normal - inner))
        return PunchFunctions(*normal), PunchFunctions(*drag)

    def _up_to(self, radius: FloatArray, function: NDArray[np.intp], place: NDArray[np.intp]) -> FloatArray:
        """Integrals of slope functions from the axis to radii at places, shape (10, …)."""
        cells, places = len(self.ends) - 1, len(self.radius)
        cell = np.clip(np.searchsorted(self.ends, radius, "right") - 1, 0, cells - 1) + function * cells
        result = self.constant.take(cell * places + place, axis=1)
        intercept, gradient = self.intercept.take(cell), self.gradient.take(cell)
        plain, weighted = primitives(self.radius[place], self.depth[place], radius)
        for total, a, b in zip(result, plain, weighted, strict=True):
            total += intercept * a + gradient * b
        return result
