"""The springs of one contact cycle on cells of radii, as far as it does not matter where one looks.

At each instant the springs follow the pieces of the memory up to the slip front, and slip from there to the
edge. So integrals over the springs are sums over cells up to the start of a piece, which do not know the
instant, and closed forms up to the radius of the front and of the edge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.memory import GROWTH, DistinctPieces
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field.contact_states import resolving_cells
from swtstudy.mechanics.stress.scene import Scene

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
    cell: NDArray[np.intp]
    intercept: FloatArray
    gradient: FloatArray
    first: NDArray[np.intp]
    least: NDArray[np.intp]
    most: NDArray[np.intp]
    function: NDArray[np.intp]
    share: FloatArray
    start: NDArray[np.intp]
    below: NDArray[np.intp]
    level: NDArray[np.intp]
    below_start: NDArray[np.intp]
    index: NDArray[np.intp]

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
        slopes, branches = resolving_cells(scene.cycle, scene.coordinate, cells)
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

    def cell_of(self, radius: FloatArray, function: NDArray[np.intp]) -> NDArray[np.intp]:
        """The cells of slope functions in which radii lie."""
        found = np.searchsorted(self.ends, radius, "right") - 1
        least = self.least[function]
        return self.first[function] + np.clip(found, least, self.most[function]) - least


def _fewer(ends: FloatArray, starts: FloatArray, circle: float) -> NDArray[np.intp]:
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
