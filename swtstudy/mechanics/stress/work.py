"""Results of the whole cycle: its tangential force, dissipated work and radii.

Both tangential components, displacement and force, are integrals over the memory diagram: the one that is not
prescribed is ∫ o′ dC over the other coordinate C of the contact radius, on lines by its values at their ends.
On growths o′ dC = Ṫ/Ṅ dC is integrated over the time of touch-down, where nothing is singular.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, Memory
from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.control.coordinate import Coordinate, DepthCoordinate
from swtstudy.mechanics.control.force import ForceCoordinate
from swtstudy.mechanics.control.normal_map import LEAST_RADIUS
from swtstudy.mechanics.events.passages import split_at_breakpoints
from swtstudy.mechanics.numerics.cosine import between
from swtstudy.mechanics.numerics.peaks import parabola
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Gauss nodes for each growth and interval on a smooth profile, and digits for which a wavy one has more.
#: Half the nodes: over 1e-6 of the work at 284 of 305 points; twice: at 30, 2e-4 at most; other digits:
#: 3e-11.
NODES, DIGITS = 16, 16.0
#: Steps of each interval of the cycle between which the largest force ratio is looked for. Half: 4e-3 of it,
#: 15 % faster; twice: 5e-4 at most, more than 1e-6 at 91 of 305 points, 40 % slower.
SAMPLES = 32
#: A normal force below this share of the largest is none. 0, 1e-12 or 1e-6: no change at 305 points.
NO_CONTACT = 1e-9


@dataclass(frozen=True)
class CycleResults:
    """Results of n cycles, each of shape (n,).

    Attributes
    ----------
    dissipated_work
        Work by friction in a cycle over μF_0 · μE* δ0/G*, F_0 the normal force at the depth δ0.
    permanent_stick_radius
        In a_H: springs inside of it never slip. NaN where there are none.
    largest_radius
        Largest contact radius in a_H.
    largest_force_ratio
        Largest |F_x|/(μ F_N) while there is contact.
    """

    dissipated_work: FloatArray
    permanent_stick_radius: FloatArray
    largest_radius: FloatArray
    largest_force_ratio: FloatArray


def cycle_results(scene: Scene, unit: FloatArray) -> CycleResults:
    """Results of the cycles of n points.

    Parameters
    ----------
    scene
        n points.
    unit
        Shape (n,), see `swtstudy.mechanics.control.force.unit_half_load`.
    """
    conjugate = _Conjugate.of(scene, unit)
    load = scene.cycle.load
    return CycleResults(
        conjugate.dissipated_work(),
        _stick_radius(scene),
        scene.coordinate.radius(np.maximum(load.largest_normal, 0.0)[:, None])[:, 0],
        conjugate.largest_force_ratio(),
    )


def _stick_radius(scene: Scene) -> FloatArray:
    stick = stick_coordinate(scene.cycle.load)
    radius = scene.coordinate.radius(np.maximum(stick, 0.0)[:, None])[:, 0]
    return np.where(stick >= 0.0, radius, np.nan)


@dataclass(frozen=True)
class _Conjugate:
    """The tangential component that is not prescribed.

    Attributes
    ----------
    cycle
        n cycles, cut where the front passes breakpoints.
    coordinate, other
        The coordinate of their diagrams and the other one.
    by_force
        Whether the tangential force is prescribed.
    unit
        See `cycle_results`.
    """

    cycle: Cycle
    coordinate: Coordinate
    other: Coordinate
    by_force: bool
    unit: FloatArray

    @classmethod
    def of(cls, scene: Scene, unit: FloatArray) -> _Conjugate:
        """From a scene; ``unit`` see `cycle_results`."""
        by_force = isinstance(scene.coordinate, ForceCoordinate)
        other = DepthCoordinate(scene.profile) if by_force else ForceCoordinate(scene.profile, unit)
        return cls(split_at_breakpoints(scene.cycle)[0], scene.coordinate, other, by_force, unit)

    def dissipated_work(self) -> FloatArray:
        """∮ F_x du_x, shape (n,)."""
        cycle = self.cycle
        # Dense at both ends of the intervals, where the front starts or arrives.
        node, weight = self._rule()
        angle = 0.5 * np.pi * (1.0 + node)
        instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
        weight = 0.25 * np.pi * np.sin(angle) * weight * (cycle.end - cycle.begin)[..., None]
        rate = cycle.load.tangential_rate(instant)
        work = (self.at(instant) * rate * weight).sum(axis=(1, 2))
        return np.maximum(-work if self.by_force else work, 0.0)

    def largest_force_ratio(self) -> FloatArray:
        """Largest |F_x|/(μ F_N), shape (n,)."""
        angle = np.pi * np.arange(SAMPLES + 1) / SAMPLES
        instant = between(self.cycle.begin[..., None], self.cycle.end[..., None], angle)
        load = self.cycle.load
        normal = np.maximum(load.normal(instant), 0.0)
        tangential = load.tangential(instant) if self.by_force else self.at(instant)
        if not self.by_force:
            normal = self.other.of(self.coordinate.radius(normal))
        least = NO_CONTACT * normal.max(axis=(1, 2), keepdims=True)
        size = np.abs(tangential)
        ratio = np.divide(size, normal, out=np.zeros_like(size), where=normal > least)
        rise = parabola(ratio[..., :-2], ratio[..., 1:-1], ratio[..., 2:])[1]
        peak = (ratio[..., 1:-1] >= ratio[..., :-2]) & (ratio[..., 1:-1] >= ratio[..., 2:])
        top = ratio[..., 1:-1] + np.where(peak, rise, 0.0)
        return np.minimum(np.maximum(ratio.max(axis=(1, 2)), top.max(axis=(1, 2))), 1.0)

    def at(self, instant: FloatArray) -> FloatArray:
        """The component at instants of shape (n, i, k), over μ F_0 or μ E* δ0/G*."""
        memory = self.cycle.memory
        interval = np.arange(memory.start.shape[1])[:, None]
        states = self.cycle.states(interval, instant)
        row = np.broadcast_to(np.arange(len(instant))[:, None, None], instant.shape)
        pieces = memory.take((row, np.broadcast_to(interval, instant.shape), states.piece))
        inside = self._inside()[row, interval, states.piece]
        front, edge = self._other(states.front), self._other(states.edge)
        return inside + self._integral(row, pieces, states.front) + states.sign * (edge - front)

    def _inside(self) -> FloatArray:
        """∫ o′ dC up to the start of each piece of the memory, shape (n, i, d)."""
        memory = self.cycle.memory
        row = np.broadcast_to(np.arange(len(memory.start))[:, None, None], memory.start.shape)[..., 1:]
        every = slice(None)
        first, end = memory.take((every, every, slice(-1))), memory.start[..., 1:]
        inside = np.zeros_like(memory.start)
        part = self._integral(row, first, np.where(np.isfinite(end), end, first.start))
        np.cumsum(part, axis=-1, out=inside[..., 1:])
        return inside

    def _integral(self, row: NDArray[np.intp], pieces: Memory, end: FloatArray) -> FloatArray:
        """∫ o′ dC over pieces of the cycles number ``row`` up to a coordinate."""
        finite = np.isfinite(pieces.start)
        start = np.where(finite, pieces.start, 0.0)
        end = np.where(finite, np.maximum(end, start), 0.0)
        grown = (pieces.slope == GROWTH) & (end > start)
        slope = np.where(pieces.slope == GROWTH, 0.0, pieces.slope)
        result = slope * (self._other(end) - self._other(start))
        if np.any(grown):
            index, branch = row[grown], pieces.branch[grown]
            load, coordinate = self.cycle.load.take(index), self.coordinate.take(index)
            first, last = (load.touch_down(ends[grown], branch) for ends in (start, end))
            node, weight = self._rule()
            instant = first[:, None] + (last - first)[:, None] * (0.5 + 0.5 * node)
            radius = np.maximum(coordinate.radius(load.normal(instant)), LEAST_RADIUS)
            unit = self.unit[index, None]
            stiffness = unit / radius if self.by_force else radius / unit
            rate = load.tangential_rate(instant) * stiffness
            result[grown] = 0.5 * (last - first) * (rate * weight).sum(axis=1)
        return result

    def _rule(self) -> tuple[FloatArray, FloatArray]:
        """Nodes and weights of Gauss's rule on [−1, 1]."""
        node, weight = np.polynomial.legendre.leggauss(NODES + 2 * self.other.profile.extra_nodes(DIGITS))
        return node, weight

    def _other(self, coordinate: FloatArray) -> FloatArray:
        return self.other.of(self.coordinate.radius(coordinate))
