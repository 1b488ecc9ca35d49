"""Quantities of a whole cycle, such as its work, and the tangential component that is not prescribed.

That is the force of a displacement, or the way of a force. Both are integrals over the memory diagram: ∫ o′
dC over the other coordinate C of the contact radius, on lines by its values at their ends. On growths o′ dC =
Ṫ/Ṅ dC is integrated over the time of touch-down, where nothing is singular. In the plane the way is known but
for a constant share of the force.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.contact.memory import GROWTH, Memory
from swtstudy.mechanics.contact.slip_front import stick_coordinate
from swtstudy.mechanics.control.coordinate import (
    Coordinate,
    DepthCoordinate,
    ForceCoordinate,
    StripDisplacement,
)
from swtstudy.mechanics.events.stretches import split_at_breakpoints
from swtstudy.mechanics.indenter.plane import PlaneProfile
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import SAME, between
from swtstudy.mechanics.numerics.roots import parabola
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.mechanics.stress.scene import Scene

#: Digits for which growths on a wavy profile have more nodes. Other digits: 3e-11 of the work.
DIGITS = 16.0
#: Cycles times intervals times instants times pieces or nodes that are looked at together: some 100 MB.
LARGEST_SIZE = 2_000_000


@dataclass(frozen=True)
class Conjugate:
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
        Shape (n,), see `swtstudy.mechanics.control.coordinate.unit_half_load`.
    nodes
        Gauss nodes for each growth on a smooth profile.
    """

    cycle: Cycle
    coordinate: Coordinate
    other: Coordinate | StripDisplacement
    by_force: bool
    unit: FloatArray
    nodes: int

    @classmethod
    def of(cls, scene: Scene, unit: FloatArray, nodes: int) -> Conjugate:
        """Over as much of the cycles of a scene as is no mirror image of the rest: all, or the first half."""
        cycle = split_at_breakpoints(scene.cycle)
        if cycle.load.mirrored_half:
            half = cycle.first_half()
            cycle = replace(half, end=np.minimum(half.end, 0.5 * PERIOD))
        return replace(cls.whole(scene, unit, nodes), cycle=cycle)

    @classmethod
    def whole(cls, scene: Scene, unit: FloatArray, nodes: int) -> Conjugate:
        """Over the cycles of a scene, in their intervals."""
        by_force = isinstance(scene.coordinate, ForceCoordinate)
        other: Coordinate | StripDisplacement
        if isinstance(scene.profile, PlaneProfile):
            other = StripDisplacement(scene.profile)
        else:
            other = DepthCoordinate(scene.profile) if by_force else ForceCoordinate(scene.profile, unit)
        return cls(scene.cycle, scene.coordinate, other, by_force, unit, nodes)

    def take(self, index: IndexArray, nodes: int) -> Conjugate:
        """Return the tables at ``index``, with so many nodes."""
        return replace(
            self,
            cycle=self.cycle.take(index),
            coordinate=self.coordinate.take(index),
            other=self.other.take(index),
            unit=self.unit[index],
            nodes=nodes,
        )

    def take_intervals(self, index: IndexArray, interval: IndexArray) -> Conjugate:
        """Return the integrals at ``index`` over one interval each, arrays of shape (m,)."""
        cycle = self.cycle.take_intervals(index, interval[:, None])
        return replace(self.take(index, self.nodes), cycle=cycle)

    def parts(self, count: int) -> Iterator[Conjugate]:
        """These over some intervals at a time, in order, so many that ``count`` instants in each fit."""
        n, intervals, pieces = self.cycle.memory.start.shape
        # A front in a growth is integrated to with as many nodes.
        size = n * intervals * count * max(pieces, self.nodes)
        if size <= LARGEST_SIZE:
            yield self
            return
        every = np.arange(n)
        for some in np.array_split(np.arange(intervals), min(-(-size // LARGEST_SIZE), intervals)):
            chosen = np.broadcast_to(some, (n, some.size))
            yield replace(self, cycle=self.cycle.take_intervals(every, chosen))

    def at(self, instant: FloatArray) -> FloatArray:
        """The component at instants of shape (n, i, k), over μ F_0 or μ E* δ0/G*."""
        interval = np.arange(self.cycle.memory.start.shape[1])[:, None]
        states = self.cycle.states(interval, instant)
        front, edge = self._other(states.front), self._other(states.edge)
        return self._up_to(states.front, states.piece) + states.sign * (edge - front)

    def offset(self, coordinate: FloatArray) -> FloatArray:
        """Offset of the springs at coordinates inside of the front, (n, i, k): ∫ o′ dC over the other one."""
        start = self.cycle.memory.start[:, :, None]
        piece = np.maximum((start <= coordinate[..., None]).sum(axis=-1) - 1, 0)
        return self._up_to(coordinate, piece)

    def normal_force(self, normal: FloatArray) -> FloatArray:
        """The normal force over F_0 at normal loads of the diagram, shape (n, …)."""
        return normal if self.by_force else self._other(normal)

    def rule(self) -> tuple[FloatArray, FloatArray]:
        """Nodes and weights of Gauss's rule on [−1, 1]."""
        node, weight = np.polynomial.legendre.leggauss(
            self.nodes + 2 * self.other.profile.extra_nodes(DIGITS)
        )
        return node, weight

    def _up_to(self, coordinate: FloatArray, piece: IndexArray) -> FloatArray:
        """∫ o′ dC up to coordinates in pieces of the memory, each of shape (n, i, k)."""
        memory, shape = self.cycle.memory, coordinate.shape
        row = np.broadcast_to(np.arange(shape[0])[:, None, None], shape)
        interval = np.broadcast_to(np.arange(shape[1])[:, None], shape)
        pieces = memory.take((row, interval, piece))
        return self._inside()[row, interval, piece] + self._integral(row, pieces, coordinate)

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

    def _integral(self, row: IndexArray, pieces: Memory, end: FloatArray) -> FloatArray:
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
            node, weight = self.rule()
            instant = first[:, None] + (last - first)[:, None] * (0.5 + 0.5 * node)
            radius = np.maximum(coordinate.radius(load.normal(instant)), SAME)
            rate = load.tangential_rate(instant) * self._stiffness(radius, self.unit[index, None])
            result[grown] = 0.5 * (last - first) * (rate * weight).sum(axis=1)
        return result

    def _stiffness(self, radius: FloatArray, unit: FloatArray) -> FloatArray:
        """Derivative of the other coordinate by that of the diagram."""
        if isinstance(self.other, StripDisplacement):
            return self.other.compliance(radius)
        return unit / radius if self.by_force else radius / unit

    def _other(self, coordinate: FloatArray) -> FloatArray:
        return self.other.of(self.coordinate.radius(coordinate))


#: Gauss nodes for each growth and interval, doubled until the error claimed is no more than this share of the
#: work: at most 2e-6 of it is wrong then at 320 points, and as a rule nothing.
NODES, MOST_NODES, TOLERANCE = 16, 512, 1e-5
#: The error claimed, over the last change: 1 is too little at 2 of 320 points all over the ranges, by 5.
OF_CHANGE = 6.0
#: Least relative error of the work: tables of wavy profiles (1.6e-7 at 1 of 80 points); and rounding's share
#: of the way, along which works of either sign cancel.
LEAST_ERROR, ROUNDING = 2e-7, 1e-15
#: Steps of each interval between which the largest force ratio is looked for, and into which those beside its
#: maximum are divided. Half of the former: 4e-5 at 300 points, 30 % faster; both as they are: 3e-6.
SAMPLES, CLOSE_SAMPLES = 32, 8
#: A maximum so far below the largest sample is not looked at again. The samples miss 1e-3 at most.
MARGIN = 0.01


def dissipated_work(scene: Scene, unit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Work by friction in a cycle, ∮ F_x du_x over μF_0 · μE* δ0/G*, F_0 the normal force at the depth δ0.

    In the plane per length, over μP_0 · μδ0.

    Parameters
    ----------
    scene
        n points.
    unit
        Shape (n,), see `swtstudy.mechanics.control.coordinate.unit_half_load`.

    Returns
    -------
    work, error
        Shape (n,): the work and its estimated absolute error.
    """
    conjugate = Conjugate.of(scene, unit, NODES)
    work, moved = _work(conjugate)
    error = np.zeros_like(work)
    rows, nodes = np.arange(len(work)), NODES
    while rows.size and nodes < MOST_NODES:
        nodes *= 2
        finer, _ = _work(conjugate.take(rows, nodes))
        error[rows], work[rows] = OF_CHANGE * np.abs(finer - work[rows]), finer
        rows = rows[(error > TOLERANCE * work + ROUNDING * moved)[rows]]
    return np.maximum(work, 0.0), error + LEAST_ERROR * np.abs(work) + ROUNDING * moved


def _work(conjugate: Conjugate) -> tuple[FloatArray, FloatArray]:
    """∮ F_x du_x, and the way of what is prescribed, each of shape (n,)."""
    # Dense at both ends of the intervals, where the front starts or arrives.
    node, weight = conjugate.rule()
    angle = 0.5 * np.pi * (1.0 + node)
    weight = 0.25 * np.pi * np.sin(angle) * weight
    work, way = np.zeros((2, len(conjugate.unit)))
    for part in conjugate.parts(len(node)):
        cycle = part.cycle
        instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
        moved = cycle.load.tangential_rate(instant) * weight * (cycle.end - cycle.begin)[..., None]
        work += (part.at(instant) * moved).sum(axis=(1, 2))
        way += np.abs(moved).sum(axis=(1, 2))
    share = 0.5 if conjugate.cycle.load.mirrored_half else 1.0
    return (-work if conjugate.by_force else work) / share, way / share


def largest_force_ratio(scene: Scene, unit: FloatArray) -> FloatArray:
    """Largest |F_x|/(μ F_N) while there is contact, shape (n,); parameters as of `dissipated_work`."""
    conjugate = Conjugate.of(scene, unit, NODES)
    least = SAME * conjugate.normal_force(scene.cycle.load.largest_normal[:, None])[:, 0]
    angle = np.pi * np.arange(SAMPLES + 1) / SAMPLES
    ratio = _ratio(conjugate, angle, least)
    largest = ratio.max(axis=(1, 2))
    top, place = _peaks(ratio)
    row, interval = np.nonzero((top > largest[:, None] - MARGIN) & (largest[:, None] < 1.0))
    if row.size:
        step = np.pi / SAMPLES
        first = np.clip((place[row, interval] - 1.0) * step, 0.0, np.pi - 2.0 * step)
        angle = first[:, None, None] + 2.0 * step / CLOSE_SAMPLES * np.arange(CLOSE_SAMPLES + 1)
        top, _ = _peaks(_ratio(conjugate.take_intervals(row, interval), angle, least[row]))
        np.maximum.at(largest, row, top[:, 0])
    return np.minimum(largest, 1.0)


def _ratio(conjugate: Conjugate, angle: FloatArray, least: FloatArray) -> FloatArray:
    """|F_x|/(μ F_N) at angles of shape (…, k) in each interval, 0 without contact, shape (n, i, k)."""
    found = []
    for part in conjugate.parts(angle.shape[-1]):
        cycle = part.cycle
        instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
        normal = part.normal_force(np.maximum(cycle.load.normal(instant), 0.0))
        size = np.abs(cycle.load.tangential(instant) if part.by_force else part.at(instant))
        found.append(np.divide(size, normal, out=np.zeros_like(size), where=normal > least[:, None, None]))
    return np.concatenate(found, axis=1)


def _peaks(ratio: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest values along the last axis, by parabolas through three samples, and their places in steps."""
    best = ratio.argmax(axis=-1)
    middle = np.clip(best, 1, ratio.shape[-1] - 2)
    left, top, right = (
        np.take_along_axis(ratio, (middle + shift)[..., None], axis=-1)[..., 0] for shift in (-1, 0, 1)
    )
    shift, rise = parabola(left, top, right)
    inside = middle == best
    place = best + np.where(inside, shift, 0.0)
    return np.where(inside, top + rise, np.maximum(left, right)), place


def permanent_stick_radius(scene: Scene, unit: FloatArray) -> FloatArray:
    """Radius in a_H inside of which springs never slip, NaN where there are none, shape (n,).

    Parameters as of `dissipated_work`.
    """
    stick = stick_coordinate(scene.cycle.load)
    radius = scene.coordinate.radius(np.maximum(stick, 0.0)[:, None])[:, 0]
    return np.where(stick >= 0.0, radius, np.nan)


def largest_contact_radius(scene: Scene, unit: FloatArray) -> FloatArray:
    """Largest contact radius in a_H, shape (n,); parameters as of `dissipated_work`."""
    return scene.coordinate.radius(np.maximum(scene.cycle.load.largest_normal, 0.0)[:, None])[:, 0]
