"""Stress integrals over the springs that touched down and stuck: their slope do/dG = Ṫ/Ṅ is not constant.

Both the kernels and the slope are smooth in an angle α (inner springs) or in v = √(ξ²−r²) (outer ones) but
for square roots at the two ends, which a sin² map removes, and for layers there in which the slope turns to
±1. In each half of the growth an abscissa that is stretched in its layer makes short Chebyshev series of the
running integral as exact as is asked for.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import Growths
from swtstudy.mechanics.control.coordinate import Coordinate
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import TINY
from swtstudy.mechanics.points import FloatArray, IndexArray, Rows

#: Chebyshev nodes of half of a growth for each oscillation of the tangential load while the ground grows.
#: 0.4: 1e-5 of the stress at ω2/ω1 = 20.
NODES_PER_OSCILLATION = 0.6
#: Share that halves have of the nodes that a wavy or tabulated profile needs beside those of a smooth one.
#: Errors of the stress are up to 4e-8.
OF_PROFILE = 0.25
#: Ratio of the distances from the ends of a growth at which its slope is looked at.
LAYER_STEP = 2.0
#: Numbers of nodes are multiples of this, since halves with as many are evaluated together. 4: no faster.
NODE_STEP = 8

#: Densities at abscissae of some ranges, see `_OverRanges`.
Density = Callable[[tuple[IndexArray, ...], FloatArray], FloatArray]


class GrowthIntegrals(Rows):
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
        layers = _layers(cycle.load, growths, digits)
        more = OF_PROFILE * coordinate.profile.extra_nodes(digits)
        nodes = _node_count(cycle.load, layers, digits, more)
        r, b = self.position, self.flat
        self.inner = _OverRanges(
            _inner_angle(low, r, b), _inner_angle(high, r, b), self._inner_density, layers, nodes
        )
        self.outer = _OverRanges(
            _outer_root(low, r), _outer_root(high, r), self._outer_density, layers, nodes
        )

    def take(self, index: IndexArray) -> GrowthIntegrals:
        """Return the growths of the cycles at ``index``, repetitions allowed."""
        names = ("index", "position", "flat", "inner", "outer") if self.count else ()
        return self._with_rows_of(names, index)

    def _inner_density(self, at: tuple[IndexArray, ...], angle: FloatArray) -> FloatArray:
        """Densities of T1 and T3, or in the plane of A, over the angle, shape (2 or 1, m, nodes)."""
        r, b = self.position[at[:2]], self.flat[at[0], 0]
        radius = np.sqrt(b * b + np.maximum(r * r - b * b, 0.0) * np.sin(angle) ** 2)
        # Under a flat face there are no springs inside r.
        if self.coordinate.profile.plane:
            return (np.where(r > b, 2.0 / radius, 0.0) * self._weighted_growth(at, radius))[None]
        first = np.where(r > b, 2.0 / r, 0.0) * self._weighted_growth(at, radius)
        return np.stack([first, first * (radius / r) ** 2])

    def _outer_density(self, at: tuple[IndexArray, ...], root: FloatArray) -> FloatArray:
        """Density of Π over the root, shape (1, m, nodes)."""
        r, b = self.position[at[:2]], self.flat[at[0], 0]
        radius = np.sqrt(root * root + r * r)
        gap = np.sqrt(np.maximum(radius * radius - b * b, TINY))
        return (self._weighted_growth(at, radius) / (radius * gap))[None]

    def _weighted_growth(self, at: tuple[IndexArray, ...], radius: FloatArray) -> FloatArray:
        """m dτ/dG at the radii of the springs, shape (m, nodes)."""
        row, _, growth = at
        coordinate, slope = self.coordinate.take(row).with_weighted_slope(radius)
        grown = self.cycle.load.take(row).growth_slope(coordinate, self.branch[row, growth, None])
        return slope * grown

    def up_to(self, row: IndexArray, column: IndexArray, index: IndexArray, radius: FloatArray) -> FloatArray:
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


def _layers(load: Load, growths: Growths, digits: float) -> FloatArray:
    """Thickness ε of the layers at both ends of growths, shape (n, k, 2), in the β at which sin²β is passed.

    Where slip ends or begins, next to a turn of N, the slope −Ṫ/Ṅ is ±1: as Ṅ² is nearly proportional to
    what is left up to there, it goes with ε/√(ε² + β²). It is looked at ever nearer to the end, to see where
    half of its change is behind: that is so at √3 ε.
    """
    # A layer changes the stress by its thickness at most, and by its change of slope.
    least = 10.0**-digits
    thickness = LAYER_STEP ** np.arange(np.floor(np.log(least) / np.log(LAYER_STEP)), 1.0)
    begin, end = growths.begin[..., None], growths.end[..., None]
    passed = (end - begin) * np.append(0.0, 0.5 * thickness**2)
    ground = np.stack([begin + passed, end - passed], axis=-2)
    slope = load.growth_slope(ground, growths.branch[..., None, None])
    change = np.abs(slope[..., 1:] - slope[..., :1])
    behind = change >= np.maximum(0.5 * change.max(axis=-1, keepdims=True), least)
    # Where nothing changes there is no layer.
    behind[..., -1] = True
    return np.asarray(thickness[behind.argmax(axis=-1)] / np.sqrt(3.0))


def _node_count(load: Load, layers: FloatArray, digits: float, more: float) -> IndexArray:
    """Number of Chebyshev nodes of both halves of growths, shape (n, k, 2).

    In w, β = ε sinh w, the slope is singular at ±iπ/2, beside the end of 0 ≤ w ≤ asinh(π/4ε), and in the
    layer of the other half, from asinh(π/2ε) on. A series of N terms misses ρ⁻ᴺ, where ρ is the sum of the
    half axes of the ellipse about the range through the nearer of these (Trefethen, Approximation Theory
    and Approximation Practice, chapter 8). What oscillates over β does so faster over w, at the farther end.
    """
    near, far = np.arcsinh(0.25 * np.pi / layers), np.arcsinh(0.5 * np.pi / layers)
    rates = [
        np.abs(np.log(np.abs(z + np.sqrt(z - 1.0) * np.sqrt(z + 1.0))))
        for z in (1j * np.pi / near - 1.0, 2.0 * far / near - 1.0 + 0.0j)
    ]
    faster = near * np.hypot(1.0, 4.0 / np.pi * layers)
    normal, tangential = load.oscillations
    oscillations = faster * (NODES_PER_OSCILLATION * tangential / normal + more)
    count = digits * np.log(10.0) / np.minimum(*rates) + oscillations
    return NODE_STEP * np.ceil(count / NODE_STEP).astype(np.intp)


class _OverRanges(Rows):
    """Running integrals over ranges, most of which are empty, by halves that begin at either end.

    Parameters
    ----------
    low, high
        Shape (n, X, k): ends of the ranges.
    density
        From the index of m ranges and abscissae (m, nodes) in them to c densities there, (c, m, nodes).
    layers, count
        Shape (n, k, 2): thickness of the layers at the ends, see `_layers`, and numbers of nodes.
    """

    def __init__(
        self, low: FloatArray, high: FloatArray, density: Density, layers: FloatArray, count: IndexArray
    ) -> None:
        self.low, self.span = low, high - low
        #: Shape (n, X, k, 2), as the arrays of halves below: in which of the groups with as many nodes each
        #: half is, and its number there.
        self.group, self.column = np.zeros((2, *low.shape[:2], *layers.shape[1:]), dtype=np.intp)
        #: Layers, and half of what a series reaches over in w.
        self.layer, self.reach = (
            np.broadcast_to(each[:, None], self.group.shape)
            for each in (layers, 0.5 * np.arcsinh(0.25 * np.pi / layers))
        )
        real = np.broadcast_to((self.span > 0.0)[..., None], self.group.shape)
        self.groups: list[chebyshev.RunningIntegrals] = []
        wholes: list[tuple[tuple[IndexArray, ...], FloatArray]] = []
        for number, nodes in enumerate(np.unique(count)):
            at = np.nonzero(real & (count == nodes)[:, None])
            self.group[at], self.column[at] = number, np.arange(len(at[0]))
            self.groups.append(self._integrals(at, density, int(nodes)))
            wholes.append((at, self.groups[-1].whole))
        halves = np.zeros((self.groups[0].components, *self.group.shape))
        for at, whole in wholes:
            for component, values in zip(halves, whole, strict=True):
                component[at] = values
        #: Shape (c, n, X, k): over all of each range.
        self.whole = halves.sum(axis=-1)

    def take(self, index: IndexArray) -> _OverRanges:
        """Return the growths at ``index`` of the first axis."""
        taken = self._with_rows_of(("low", "span", "layer", "reach", "group", "column"), index)
        taken.whole = self.whole[:, index]
        return taken

    def _integrals(
        self, at: tuple[IndexArray, ...], density: Density, count: int
    ) -> chebyshev.RunningIntegrals:
        row, column, growth, half = at
        # The nodes of a half are the same at all positions.
        layer, reach = self.layer[:, 0, :, :, None], self.reach[:, 0, :, :, None]
        w = reach * (1.0 + chebyshev.nodes(count))
        β = layer * np.sinh(w)
        passed, rate = np.sin(β) ** 2, reach * layer * np.cosh(w) * np.sin(2.0 * β)
        passed[:, :, 1] = 1.0 - passed[:, :, 1]
        of_half = 2 * (row * passed.shape[1] + growth) + half
        passed, rate = (each.reshape(-1, count).take(of_half, axis=0) for each in (passed, rate))
        low, span = (values[row, column, growth][:, None] for values in (self.low, self.span))
        values = density((row, column, growth), low + span * passed)
        return chebyshev.RunningIntegrals(values * (span * rate))

    def up_to(self, at: IndexArray, abscissa: FloatArray) -> FloatArray:
        """The integrals number ``at`` in S up to the abscissae, (c, len(at))."""
        result = np.zeros((len(self.whole), len(at)))
        real = np.flatnonzero(self.span.take(at) > 0.0)
        at = at[real]
        passed = np.clip((abscissa[real] - self.low.take(at)) / self.span.take(at), 0.0, 1.0)
        later = passed > 0.5
        half = 2 * at + later
        β = np.arcsin(np.sqrt(np.where(later, 1.0 - passed, passed)))
        y = np.arcsinh(β / self.layer.take(half)) / self.reach.take(half) - 1.0
        column, group = self.column.take(half), self.group.take(half)
        found = np.empty((len(result), len(at)))
        for number, integrals in enumerate(self.groups):
            some = np.flatnonzero(group == number) if len(self.groups) > 1 else slice(None)
            found[:, some] = integrals.single(y[some], column[some])
        whole = self.whole.reshape(len(result), -1).take(at, axis=1)
        result[:, real] = np.where(later, whole - found, found)
        return result


def _inner_angle(radius: FloatArray, r: FloatArray, b: FloatArray) -> FloatArray:
    """α of a spring inside r, ξ² = b² + (r² − b²) sin²α; π/2 of one outside."""
    sine = np.maximum(radius**2 - b**2, 0.0) / np.maximum(r**2 - b**2, TINY)
    return np.asarray(np.arcsin(np.sqrt(np.clip(sine, 0.0, 1.0))))


def _outer_root(radius: FloatArray, r: FloatArray) -> FloatArray:
    """v = √(ξ² − r²) of a spring outside r; 0 of one inside."""
    return np.sqrt(np.maximum(radius**2 - r**2, 0.0))
