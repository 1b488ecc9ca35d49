"""Stress histories at places of the body, each at instants of its own.

At each instant the springs follow the pieces of the memory up to the slip front, and slip from there to the
edge. So integrals over the springs are sums over cells up to the start of a piece, which do not know the
instant, and closed forms up to the radius of the front and of the edge. The sums are made once for each
place; no instant makes cells for the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from swtstudy.mechanics.contact.memory import GROWTH, DistinctPieces
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.mechanics.stress.contact_states import resolving_cells
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.mechanics.stress.superposition import kernels_of

#: Cells are at least so wide, over the distance from the circle at which they are needed. Half of it, or all
#: cells: 1e-5 of a mean beside a face.
WIDTH = 0.2


@dataclass(frozen=True)
class SpringCells:
    """Slope functions on c cells, each function only where springs have it, and m pieces of the memory.

    Attributes
    ----------
    ends
        Shape (e,): the radii between cells.
    cell
        Shape (c,): number of the end at which each cell begins, one function's cells after the other's.
    intercept, gradient
        Shape (c,): the slope function on the cell, over π.
    first, least, most
        Shape (f,): of each function, which of the cells is its first, and the ends at which its first and its
        last one begin.
    function, share
        Shape (m,): the slope function of each piece, and its share in dτ/dG.
    start
        Shape (m,): the cell at whose begin the piece starts.
    below, level
        Shape (m,): the piece right beneath, and how many there are beneath.
    below_start
        Shape (m,): the cell, of the function of the piece right beneath, at whose begin the piece starts.
    index
        Shape (i, d): the number of each piece of the cycle's memory.
    """

    ends: FloatArray
    cell: IndexArray
    intercept: FloatArray
    gradient: FloatArray
    first: IndexArray
    least: IndexArray
    most: IndexArray
    function: IndexArray
    share: FloatArray
    start: IndexArray
    below: IndexArray
    level: IndexArray
    below_start: IndexArray
    index: IndexArray

    @classmethod
    def of(cls, scene: Scene, cells: int, circle: float | None = None) -> SpringCells:
        """Cut the springs of a batch of one point into cells.

        Parameters
        ----------
        scene
            The point.
        cells
            As for `contact_states.resolving_cells`.
        circle
            Radius at which all cells are needed, in a_H; the farther from it, the fewer. Without it all are.
        """
        slopes, branches = resolving_cells(scene.cycle, scene.coordinate, cells, circle)
        memory = scene.cycle.memory.take((slice(0, 1),))
        pieces = DistinctPieces.of(memory)
        start, slope, first = pieces.start[0], pieces.slope[0], pieces.first[0]
        some = np.isfinite(memory.start.ravel()[first])
        grown = some & (slope == GROWTH)
        function = np.where(grown, 1 + np.searchsorted(branches, memory.branch.ravel()[first]), 0)
        stop = np.where(grown, memory.stop.ravel()[first], 0.0)
        starts, stops = (scene.coordinate.radius(v[None])[0] for v in (start, stop))
        if circle is not None:
            slopes = slopes.merged(_fewer(slopes.radius, np.concatenate([starts, stops]), circle))
        middle = 0.5 * (slopes.radius[1:] + slopes.radius[:-1])
        begin, stop = (np.searchsorted(middle, v) for v in (starts, stops))
        below = pieces.below[0]
        least, most = np.zeros((2, len(slopes.intercept)), dtype=np.intp)
        most[0] = len(middle) - 1
        for number in range(1, least.size):
            # Rounding may lead a piece out of the growth beneath.
            own, next_one = begin[function == number], begin[function[below] == number]
            least[number] = np.concatenate([own, next_one]).min()
            most[number] = max(*stop[function == number], *next_one, least[number] + 1) - 1
        count = most - least + 1
        before = np.cumsum(count) - count
        owner = np.repeat(np.arange(least.size), count)
        cell = np.arange(count.sum()) - before[owner] + least[owner]
        return cls(
            ends=slopes.radius,
            cell=cell,
            intercept=slopes.intercept[owner, cell] / np.pi,
            gradient=slopes.gradient[owner, cell] / np.pi,
            first=before,
            least=least,
            most=most,
            function=function,
            # τ′ = −o′ on lines.
            share=np.where(grown, 1.0, np.where(some, -slope, 0.0)),
            start=before[function] + begin - least[function],
            below=below,
            level=pieces.level[0],
            below_start=before[function[below]] + begin - least[function[below]],
            index=pieces.index[0],
        )

    def cell_of(self, radius: FloatArray, function: IndexArray) -> IndexArray:
        """The cells of slope functions in which radii lie."""
        found = np.searchsorted(self.ends, radius, "right") - 1
        least = self.least[function]
        return self.first[function] + np.clip(found, least, self.most[function]) - least


def _fewer(ends: FloatArray, starts: FloatArray, circle: float) -> IndexArray:
    """Numbers of the ends of cells that are kept, those of pieces among them."""
    needed = np.zeros(ends.size, dtype=bool)
    middle = 0.5 * (ends[1:] + ends[:-1])
    needed[np.searchsorted(middle, starts)] = True
    needed[[0, -1]] = True
    # A slope may end there like a root, or like one over it.
    from_start = np.abs(ends[:, None] - np.append(starts, ends[0])).min(axis=1)
    least = WIDTH * np.minimum(np.abs(ends - circle), 2.0 * from_start)
    last = 0
    for k in range(1, ends.size - 1):
        needed[k] |= ends[k] - ends[last] >= least[k]
        last = k if needed[k] else last
    return np.flatnonzero(needed)


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

    def stress(self, instant: FloatArray, rows: IndexArray | None = None) -> FloatArray:
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

    def _functions(self, instant: FloatArray, place: IndexArray) -> tuple[Any, Any]:
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

    def _primitives(self, radius: FloatArray, place: IndexArray) -> FloatArray:
        """Primitives of the functions, with the weights 1 and ξ, at radii, shape (2, f, …)."""
        return np.array(self.kernels.primitives(self.radius.take(place), self.depth.take(place), radius))

    def _up_to(
        self, radius: FloatArray, function: IndexArray, place: IndexArray, primitive: FloatArray
    ) -> FloatArray:
        """Integrals of slope functions from their first cells to radii at places, shape (f, …)."""
        cell = self.springs.cell_of(radius, function)
        result = self.constant.take(cell * len(self.radius) + place, axis=1)
        result += self.springs.intercept.take(cell) * primitive[0]
        result += self.springs.gradient.take(cell) * primitive[1]
        return result
