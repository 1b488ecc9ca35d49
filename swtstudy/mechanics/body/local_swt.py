"""swt at many places of a small part of the body, each at instants of its own.

Common to all places are few instants, aligned with the events at one circle of the surface. Beneath the
surface an event leaves a peak as narrow in time as its passage over the depth takes: each place has its own
instants there, and at last some around those that make its swt.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.body import time_nodes
from swtstudy.mechanics.body.histories import Histories
from swtstudy.mechanics.body.quick_planes import (
    CoarsePlanes,
    climb_from,
    highest_coarse_planes,
    highest_planes,
    planes_like,
)
from swtstudy.mechanics.body.spring_cells import SpringCells
from swtstudy.mechanics.events.passages import front_passes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.peaks import near_maximum, parabola_maximum
from swtstudy.mechanics.planes.ascent import normal_weights
from swtstudy.mechanics.planes.criterion import curves
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Steps of all intervals of a cycle at most, unless each has one: 200 sides are a third faster.
MANY = 256
#: The edge or a front passes so far from a place, in its depth, at its own instants.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0])
#: Passages nearer to the end of an interval, rad, are at that end, or none.
NO_PASSAGE = 1e-9
#: Instants nearer to one another, rad, are one.
SAME_INSTANT = 1e-9
#: A stress or strain this near to its extreme over the cycle, in its range, may have it close by, also at
#: other places.
HOT = 0.1
#: So many of the places that are shown tell for the others near to them.
NEAREST = 6
#: Peaks of each curve beside which instants are added in each round. Places whose swt grew by less than the
#: share need no other one.
PEAKS, SETTLED = (2, 1, 1, 1), 1e-3
#: What is missing at last, over what each round added: means of scenes all over the parameters miss less.
DOUBTS = (0.1, 0.5, 0.5, 0.5)


class Places(NamedTuple):
    """Radius, depth and angle about the axis of N places, each of shape (N,)."""

    radius: FloatArray
    depth: FloatArray
    angle: FloatArray

    def at(self, index: NDArray[np.intp]) -> Places:
        """Some of the places."""
        return Places(*(values[index] for values in self))


class Fineness(NamedTuple):
    """How finely swt is searched for.

    Attributes
    ----------
    steps
        Of the common instants on each stretch between two events.
    cells
        As for `resolving_cells`.
    """

    steps: int
    cells: int


class LocalSwt:
    """swt around a circle of the surface about the axis.

    Parameters
    ----------
    scene
        A batch of one point.
    circle
        Radius of the circle in a_H.
    shown
        Some places of that part of the body, which show what part of the cycle matters.
    fineness
        See `Fineness`.
    """

    def __init__(self, scene: Scene, circle: float, shown: Places, fineness: Fineness) -> None:
        self.scene, self.ν = scene, float(scene.poisson_ratio[0])
        self.γ = scene.one_walker_exponent
        self.springs = SpringCells.of(scene, fineness.cells, circle)
        # The sides of a polygon of many are short.
        steps = max(1, min(fineness.steps, MANY // scene.cycle.begin.shape[1]))
        instant = np.unique(np.mod(time_nodes(scene, steps, [circle]).instant, PERIOD))
        self.instant, self.circle, self.shown = instant, circle, shown
        #: Which of the gaps that follow the instants matter at the places that are shown.
        self.open, self.planes = self._decisive(shown)

    def _decisive(self, shown: Places) -> tuple[NDArray[np.bool_], CoarsePlanes]:
        """In which gaps between the instants swt is made at places, shape (m, T), and on what planes."""
        every = CoarsePlanes.everywhere()
        histories, rows = Histories(self.scene, *shown, self.springs), np.arange(shown.radius.size)
        instant = self._instants(shown, np.ones((rows.size, self.instant.size), dtype=bool))
        stress = histories.stress(instant)
        normal = highest_coarse_planes(stress, every, self.ν, self.γ)
        instant, stress = self._closer(histories, rows, instant, stress, normal, 2)
        hot = np.zeros(instant.shape, dtype=bool)
        _, normal = climb_from(stress, self.ν, highest_coarse_planes(stress, every, self.ν, self.γ), self.γ)
        for curve in self._curves(stress, normal):
            hot |= near_maximum(curve, HOT)
        row, column = np.nonzero(hot)
        at = instant[row, column]
        open_ = np.zeros((rows.size, self.instant.size), dtype=bool)
        # Beside an instant that is common both gaps.
        for side in (at - SAME_INSTANT, at + SAME_INSTANT):
            open_[row, np.searchsorted(self.instant, side) - 1] = True
        return open_, planes_like(stress, self.ν, self.γ)

    def _open_at(self, places: Places) -> NDArray[np.bool_]:
        """Which of the gaps matter at places: those that do at some of the nearest that are shown."""
        here, there = (self._scaled(some) for some in (places, self.shown))
        away = ((here[:, None] - there) ** 2).sum(axis=-1)
        nearest = np.argpartition(away, NEAREST - 1, axis=1)[:, :NEAREST]
        return np.asarray(self.open[nearest].any(axis=1))

    def _scaled(self, places: Places) -> FloatArray:
        """Offsets from the circle, over a root of the distance from it, and arcs about the axis."""
        right = places.radius - self.circle
        root = np.sqrt(np.maximum(np.hypot(right, places.depth), 1e-300))
        arc = np.minimum(places.angle, np.pi - places.angle)
        return np.stack([right / root, places.depth / root, arc], axis=1)

    def swt(self, places: Places) -> tuple[FloatArray, FloatArray]:
        """swt over E* δ0/R at N places, and an estimate of what is missing of it, shape (N,) each."""
        histories = Histories(self.scene, *places, self.springs)
        instant = self._instants(places, self._open_at(places))
        rows: NDArray[np.intp] = np.arange(len(instant))
        stress = histories.stress(instant)
        # A peak between the instants may make another plane critical: the planes are searched twice.
        normal = highest_coarse_planes(stress, self.planes, self.ν, self.γ)
        instant, stress = self._closer(histories, rows, instant, stress, normal, 2)
        swt, normal = highest_planes(stress, self.planes, self.ν, self.γ)
        missing = np.zeros_like(swt)
        for peaks, doubt in zip(PEAKS, DOUBTS, strict=True):
            instant, stress = self._closer(histories, rows, instant, stress, normal, peaks)
            better, normal = climb_from(stress, self.ν, normal, self.γ)
            missing[rows] += doubt * (better - swt[rows])
            open_ = better > (1.0 + SETTLED) * swt[rows]
            swt[rows] = better
            rows, instant, stress, normal = rows[open_], instant[open_], stress[open_], normal[open_]
            if not rows.size:
                break
        return swt, missing

    def _closer(
        self,
        histories: Histories,
        rows: NDArray[np.intp],
        instant: FloatArray,
        stress: FloatArray,
        normal: FloatArray,
        peaks: int,
    ) -> tuple[FloatArray, FloatArray]:
        """Instants and stresses of some places, and those beside the highest peaks on one plane each."""
        closer = _beside_peaks(instant, self._curves(stress, normal), peaks)
        instant = np.concatenate([instant, closer], axis=1)
        stress = np.concatenate([stress, histories.stress(closer, rows)], axis=1)
        order = np.argsort(instant, axis=1)
        return gather(instant, order), stress[np.arange(len(order))[:, None], order]

    def _instants(self, places: Places, open_: NDArray[np.bool_]) -> FloatArray:
        """Instants of places in some of the gaps, shapes (N, T): common ones and their own, ascending."""
        common = np.broadcast_to(self.instant, open_.shape)
        (common,) = packed(open_ | np.roll(open_, 1, axis=1), common)
        return np.sort(np.concatenate([common, self._own_instants(places, open_)], axis=1), axis=1)

    def _own_instants(self, places: Places, open_: NDArray[np.bool_]) -> FloatArray:
        """Instants at which the contact edge or a slip front passes near places, shape (N, E)."""
        cycle = self.scene.cycle
        near = np.maximum(places.radius[:, None] + places.depth[:, None] * OFFSETS, 0.0)
        coordinate = self.scene.coordinate.of(near.reshape(1, -1))
        found = cycle.load.passage(coordinate, cycle.begin, cycle.end), front_passes(cycle, coordinate)
        instant = np.concatenate([passes.reshape(len(near), -1) for passes in found], axis=1)
        ends = np.concatenate([[0.0], cycle.end[0]])
        after = np.clip(np.searchsorted(ends, instant), 1, ends.size - 1)
        gap = np.minimum(np.abs(instant - ends[after]), np.abs(instant - ends[after - 1]))
        within = np.searchsorted(self.instant, np.mod(instant, PERIOD), "right") - 1
        kept = (gap > NO_PASSAGE) & gather(open_, within % self.instant.size)
        # A place without instants of its own keeps one for the others' sake.
        kept[:, 0] |= ~kept.any(axis=1)
        return np.mod(packed(kept, instant)[0], PERIOD)

    def _curves(self, stress: FloatArray, normal: FloatArray) -> tuple[FloatArray, ...]:
        """The curves of the criterion, each of shape (m, T), of histories on one plane each."""
        weights = normal_weights(normal)[..., None]
        of_stress, of_strain = ((v @ weights)[..., 0] for v in (stress, strain_history(stress, self.ν)))
        return curves(of_stress, of_strain)


def _beside_peaks(instant: FloatArray, several: tuple[FloatArray, ...], peaks: int) -> FloatArray:
    """Instants beside the highest peaks of curves over the periodic cycle, shape (m, 3 · peaks · curves).

    In the middle of both gaps, and where a parabola has its maximum. Instants that meet are one.
    """
    around, at = _neighbours(instant)
    row = np.arange(len(instant))[:, None]
    found = []
    for curve in several:
        before, after = curve[row, at[0]], curve[row, at[2]]
        peaked = (curve >= before) & (curve >= after) & (around[0] < around[1])
        highest = np.argpartition(np.where(peaked, -curve, np.inf), peaks, axis=1)[:, :peaks]
        three, values = (
            np.stack([v[row, highest] for v in parts], axis=-1) for parts in (around, (before, curve, after))
        )
        top, _ = parabola_maximum(three.reshape(-1, 3), values.reshape(-1, 3))
        found += [
            0.5 * (three[..., 0] + three[..., 1]),
            top.reshape(highest.shape),
            0.5 * (three[..., 1] + three[..., 2]),
        ]
    return np.mod(np.concatenate(found, axis=1), PERIOD)


def _neighbours(instant: FloatArray) -> tuple[FloatArray, NDArray[np.intp]]:
    """The last instant before each of the rows', itself, and the next one, and where they are, (3, m, T).

    Those that meet have the same next one; only the first of them has one before.
    """
    count = instant.shape[1]
    index = np.broadcast_to(np.arange(count), instant.shape)
    new = np.ones((len(instant), count + 1), dtype=bool)
    new[:, 1:-1] = np.diff(instant) > SAME_INSTANT
    begins = np.where(new, np.arange(count + 1), count)
    after = np.minimum.accumulate(begins[:, :0:-1], axis=1)[:, ::-1]
    before = np.where(new[:, :-1], index - 1, index)
    at = np.stack([before, index, after])
    return gather(instant, at % count) + PERIOD * (at // count), at % count
