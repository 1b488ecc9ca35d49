"""Stress integrals over the springs that touched down and stuck: their slope do/dG = Ṫ/Ṅ is not constant.

Both the kernels and the slope are smooth in an angle α (inner springs) or in v = √(ξ²−r²) (outer ones) but
for square roots at the two ends; a sin² map removes these, so that a short Chebyshev series of the running
integral is exact to rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from copy import copy

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import Growths
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import TINY
from swtstudy.mechanics.points import FloatArray

#: Chebyshev nodes for each oscillation of the tangential load while the ground grows. Half: 3e-7, no faster.
NODES_PER_OSCILLATION = 1.6
#: Where the tangential load moves slower than this share of the normal one, the slope turns from ±1 to that
#: share within the square of it, beside an end of the growth. With so many nodes more for each digit beyond
#: the fifth s was off by 2e-7 at most at 8.5 digits and shares of 2e-4 to 0.01, without them by up to 9e-6.
#: Half of them up to the second share, beyond which the turn is wide: without, 2e-6 at a point of
#: tests/mechanics/test_overlooked.py.
SLOW, LESS_SLOW, NODES_PER_DIGIT = 0.02, 0.08, 24

#: Densities at abscissae of some ranges, see `_OverRanges`.
Density = Callable[[tuple[NDArray[np.intp], ...], FloatArray], FloatArray]


class GrowthIntegrals:
    """Running integrals of the primitives' kernels times −Ṫ/Ṅ over each growth of each cycle.

    Parameters
    ----------
    cycle, coordinate
        n cycles and the coordinate of their memory diagrams.
    position
        Shape (n, X), r = |x|.
    digits
        Digits that the stress is to have.
    """

    def __init__(self, cycle: Cycle, coordinate: Coordinate, position: FloatArray, digits: float) -> None:
        # The tangential load may oscillate several times while the normal one rises once.
        normal, tangential = cycle.load.oscillations
        smooth = max(4.0 * digits - 6.0, 7.0 * digits - 20.0) + NODES_PER_OSCILLATION * (tangential / normal)
        count = math.ceil(smooth) + coordinate.profile.extra_nodes(digits)
        amplitude = cycle.load.normal_motion
        share = tangential * (cycle.load.motion - amplitude) / np.maximum(normal * amplitude, TINY)
        more = NODES_PER_DIGIT * max(digits - 5.0, 0.0)
        slow = np.where(share < SLOW, 1.0, 0.5 * (share < LESS_SLOW))
        nodes = count + np.ceil(slow * more).astype(np.intp)
        growths = Growths.of(cycle.memory)
        self.count = growths.begin.shape[1]
        if not self.count:
            return
        #: Shape (n, i, d): number of the growth that left each piece of the memory; 0 for lines.
        self.index = growths.index
        # Axes from here on: profile n, position X, growth k, node.
        self.position = position[:, :, None]
        self.flat = coordinate.profile.flat_radius[:, None, None]
        low, high = (coordinate.radius(g)[:, None, :] for g in (growths.begin, growths.end))
        self.cycle, self.coordinate, self.branch = cycle, coordinate, growths.branch
        r, b = self.position, self.flat
        self.inner = _OverRanges(
            _inner_angle(low, r, b), _inner_angle(high, r, b), self._inner_density, nodes
        )
        self.outer = _OverRanges(_outer_root(low, r), _outer_root(high, r), self._outer_density, nodes)

    def take(self, index: NDArray[np.intp]) -> GrowthIntegrals:
        """Return the growths of the cycles at ``index``, repetitions allowed."""
        taken = copy(self)
        if self.count:
            taken.index, taken.position, taken.flat = (
                self.index[index],
                self.position[index],
                self.flat[index],
            )
            taken.inner, taken.outer = self.inner.take(index), self.outer.take(index)
        return taken

    def _inner_density(self, at: tuple[NDArray[np.intp], ...], angle: FloatArray) -> FloatArray:
        """Densities of T1 and T3, or in the plane of A, over the angle, shape (2 or 1, m, nodes)."""
        r, b = self.position[at[:2]], self.flat[at[0], 0]
        radius = np.sqrt(b * b + np.maximum(r * r - b * b, 0.0) * np.sin(angle) ** 2)
        # Under a flat face there are no springs inside r.
        if self.coordinate.profile.plane:
            return (np.where(r > b, 2.0 / radius, 0.0) * self._weighted_growth(at, radius))[None]
        first = np.where(r > b, 2.0 / r, 0.0) * self._weighted_growth(at, radius)
        return np.stack([first, first * (radius / r) ** 2])

    def _outer_density(self, at: tuple[NDArray[np.intp], ...], root: FloatArray) -> FloatArray:
        """Density of Π over the root, shape (1, m, nodes)."""
        r, b = self.position[at[:2]], self.flat[at[0], 0]
        radius = np.sqrt(root * root + r * r)
        gap = np.sqrt(np.maximum(radius * radius - b * b, TINY))
        return (self._weighted_growth(at, radius) / (radius * gap))[None]

    def _weighted_growth(self, at: tuple[NDArray[np.intp], ...], radius: FloatArray) -> FloatArray:
        """m dτ/dG at the radii of the springs, shape (m, nodes)."""
        row, _, growth = at
        coordinate, slope = self.coordinate.take(row).with_weighted_slope(radius)
        grown = self.cycle.load.take(row).growth_slope(coordinate, self.branch[row, growth, None])
        return slope * grown

    def up_to(
        self,
        row: NDArray[np.intp],
        column: NDArray[np.intp],
        index: NDArray[np.intp],
        radius: FloatArray,
    ) -> FloatArray:
        """The integrals over single growths up to ``radius``, shape (3, m) or (2, m).

        Parameters
        ----------
        row, column, index, radius
            Shape (m,): point, position, number of the growth, upper limit ξ.
        """
        columns, count = self.position.shape[1], self.count
        at = (row * columns + column) * count + index
        r, b = self.position.take(row * columns + column), self.flat.take(row)
        angle, root = _inner_angle(radius, r, b), _outer_root(radius, r)
        return np.concatenate([self.inner.up_to(at, angle), self.outer.up_to(at, root)])


class _OverRanges:
    """Running integrals over ranges, most of which are empty.

    Parameters
    ----------
    low, high
        Shape S: ends of the ranges.
    density
        From the index of m ranges and abscissae (m, nodes) in them to c densities there, (c, m, nodes).
    count
        Shape (n,), of the first axis of S: number of nodes.
    """

    def __init__(self, low: FloatArray, high: FloatArray, density: Density, count: NDArray[np.intp]) -> None:
        self.low, self.span = low, high - low
        real, shape = self.span > 0.0, (-1,) + (1,) * (low.ndim - 1)
        self.column = np.zeros(self.span.shape, dtype=np.intp)
        #: Which ranges have the same number of nodes, of shape S, and the integrals over these.
        self.groups = []
        for nodes in np.unique(count):
            same = np.broadcast_to((count == nodes).reshape(shape), real.shape)
            at = np.nonzero(real & same)
            self.column[at] = np.arange(len(at[0]))
            self.groups.append((same.ravel(), self._integrals(at, density, int(nodes))))

    def take(self, index: NDArray[np.intp]) -> _OverRanges:
        """Return the growths at ``index`` of the first axis."""
        taken, shape = copy(self), self.span.shape
        taken.low, taken.span, taken.column = self.low[index], self.span[index], self.column[index]
        taken.groups = [(same.reshape(shape)[index].ravel(), integrals) for same, integrals in self.groups]
        return taken

    def _integrals(
        self, at: tuple[NDArray[np.intp], ...], density: Density, count: int
    ) -> chebyshev.RunningIntegrals:
        low, span = self.low[at][:, None], self.span[at][:, None]
        y = np.sin(0.25 * np.pi * (1.0 + chebyshev.nodes(count)))
        # The sin² map.
        rate = 0.5 * np.pi * y * np.sqrt(1.0 - y * y)
        return chebyshev.RunningIntegrals(density(at, low + span * (y * y)) * (rate * span))

    def up_to(self, at: NDArray[np.intp], abscissa: FloatArray) -> FloatArray:
        """The integrals number ``at`` in S up to the abscissae, (c, len(at))."""
        result = np.zeros((self.groups[0][1].components, len(at)))
        real = self.span.take(at) > 0.0
        for same, integrals in self.groups:
            some = np.flatnonzero(real & same.take(at) if len(self.groups) > 1 else real)
            if some.size:
                these = at[some]
                part = np.clip((abscissa[some] - self.low.take(these)) / self.span.take(these), 0.0, 1.0)
                y = np.arcsin(np.sqrt(part)) * (4.0 / np.pi) - 1.0
                result[:, some] = integrals.single(y, self.column.take(these))
        return result


def _inner_angle(radius: FloatArray, r: FloatArray, b: FloatArray) -> FloatArray:
    """α of a spring inside r, ξ² = b² + (r² − b²) sin²α; π/2 of one outside."""
    sine = np.maximum(radius**2 - b**2, 0.0) / np.maximum(r**2 - b**2, TINY)
    return np.asarray(np.arcsin(np.sqrt(np.clip(sine, 0.0, 1.0))))


def _outer_root(radius: FloatArray, r: FloatArray) -> FloatArray:
    """v = √(ξ² − r²) of a spring outside r; 0 of one inside."""
    return np.sqrt(np.maximum(radius**2 - r**2, 0.0))
