"""swt at many places of a small part of the body, each at instants of its own.

Common to all places are few instants, aligned with the events at one circle of the surface. Beneath the
surface an event leaves a peak as narrow in time as its passage over the depth takes: each place has its own
instants there, and at last some around those that make its swt.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from swtstudy.mechanics.body.body import time_nodes
from swtstudy.mechanics.body.histories import PLACES, Histories, SpringCells
from swtstudy.mechanics.body.quick_planes import Peaks, climb_from, on_planes, planes_like, rival_planes
from swtstudy.mechanics.events.stretches import front_passes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import SAME, TINY, gather, packed, with_neighbours
from swtstudy.mechanics.numerics.roots import near_maximum
from swtstudy.mechanics.planes.all_planes import CoarsePlanes
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray
from swtstudy.mechanics.stress.scene import Scene

#: Steps of all intervals of a cycle at most, unless each has one: 200 sides are a third faster.
MANY = 256
#: The edge or a front passes so far from a place, in its depth, at its own instants. Four: 5 % faster, but
#: two of 72 means over lines were 1e-3 and 4e-3 low.
OFFSETS = np.array([-3.0, -1.5, -0.7, 0.0, 0.5, 1.0])
#: A stress or strain this near to its extreme over the cycle, in its range, may have it close by, also at
#: other places.
HOT = 0.05
#: Once a plane is known, its instants at which a curve is so near to its extreme, in its range, are kept.
#: Twice, or all: no change at 1,080 places.
HIGH = 0.2
#: So many of the places that are shown tell for the others near to them.
NEAREST = 9
#: Peaks of each curve beside which instants are added: before the planes are searched, and in rounds after.
FIRST, PEAKS = 1, (2, 1, 1, 1, 1, 1, 1, 1)
#: So many rounds are for all places, the others for single ones; none for those that can hide less of swt,
#: over it, than the next, and than `Fineness.settled` if single: of 1,080 places 19 were more than 3e-4 low,
#: and 5 with all of them single, at 1.1 times the time.
ROUNDS, SETTLED = 4, 2e-3
#: What is missing at last, over what the first round added, and the others, and over what may be hidden:
#: means of scenes all over the parameters miss less.
DOUBTS, HIDDEN = (0.05, *(0.1,) * (len(PEAKS) - 1)), 0.15


class Places(NamedTuple):
    """Radius, depth and angle about the axis of N places, each of shape (N,)."""

    radius: FloatArray
    depth: FloatArray
    angle: FloatArray

    def at(self, index: IndexArray) -> Places:
        """Some of the places."""
        return Places(*(values[index] for values in self))


class Fineness(NamedTuple):
    """The resolution of a search for swt.

    Attributes
    ----------
    steps
        Of the common instants on each stretch between two events.
    cells
        As for `resolving_cells`.
    settled
        What a single value may hide at most, over it.
    """

    steps: int
    cells: int
    settled: float = 3e-4


def coarse_swt(scene: Scene, places: Places, fineness: Fineness) -> FloatArray:
    """A lower bound of swt over E* δ0/R at N places of a batch of one point, within some per cent, (N,)."""
    springs, ν = SpringCells.of(scene, fineness.cells), float(scene.poisson_ratio[0])
    common, planes = _common_instants(scene, fineness), CoarsePlanes.everywhere()
    swt = np.empty(places.radius.size)
    for part in (slice(first, first + PLACES) for first in range(0, swt.size, PLACES)):
        some = Places(*(values[part] for values in places))
        own = _packed(*_passages(scene, some))
        instant = np.concatenate([np.broadcast_to(common, (len(own), common.size)), own], axis=1)
        stress = Histories(scene, *some, springs).stress(instant)
        swt[part] = planes.swt(stress, ν, scene.criterion).max(axis=1)
    return swt


def _common_instants(scene: Scene, fineness: Fineness, circles: Sequence[float] = ()) -> FloatArray:
    """Instants aligned with the events, at circles of the surface too."""
    # The sides of a polygon of many are short.
    steps = max(1, min(fineness.steps, MANY // scene.cycle.begin.shape[1]))
    return np.unique(np.mod(time_nodes(scene, steps, circles).instant, PERIOD))


def _passages(scene: Scene, places: Places) -> tuple[FloatArray, BoolArray]:
    """Instants at which edge or fronts pass near N places, and whether they do, shape (N, E)."""
    cycle = scene.cycle
    near = np.maximum(places.radius[:, None] + places.depth[:, None] * OFFSETS, 0.0)
    coordinate = scene.coordinate.of(near.reshape(1, -1))
    found = cycle.load.passage(coordinate, cycle.begin, cycle.end), front_passes(cycle, coordinate)
    instant = np.concatenate([passes.reshape(len(near), -1) for passes in found], axis=1)
    ends = np.concatenate([[0.0], cycle.end[0]])
    after = np.clip(np.searchsorted(ends, instant), 1, ends.size - 1)
    gap = np.minimum(np.abs(instant - ends[after]), np.abs(instant - ends[after - 1]))
    return np.mod(instant, PERIOD), gap > SAME


def _packed(instant: FloatArray, kept: BoolArray) -> FloatArray:
    """The instants that are kept, shape (N, E); a place without any keeps one for the others' sake."""
    kept[:, 0] |= ~kept.any(axis=1)
    return packed(kept, instant)[0]


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
        self.criterion = scene.criterion
        self.springs = SpringCells.of(scene, fineness.cells, circle)
        # The sides of a polygon of many are short.
        self.instant = _common_instants(scene, fineness, [circle])
        self.circle, self.shown, self.settled = circle, shown, fineness.settled
        #: Which of the gaps that follow the instants matter at the places that are shown.
        self.open, self.planes = self._decisive(shown)

    def _decisive(self, shown: Places) -> tuple[BoolArray, CoarsePlanes]:
        """In which gaps between the instants swt is made at places, shape (m, T), and on what planes."""
        open_ = np.zeros((shown.radius.size, self.instant.size), dtype=bool)
        histories, instant = Histories(self.scene, *shown, self.springs), self._instants(shown, ~open_)
        stress = histories.stress(instant)
        planes = planes_like(stress, self.ν, self.criterion)
        rows, _, normal = rival_planes(stress, planes, self.ν, self.criterion)
        hot = np.zeros(instant.shape, dtype=bool)
        for curve in self._curves(stress[rows], normal):
            np.logical_or.at(hot, rows, near_maximum(curve, HOT))
        row, column = np.nonzero(hot)
        at = instant[row, column]
        # Beside an instant that is common both gaps.
        for side in (at - SAME, at + SAME):
            open_[row, np.searchsorted(self.instant, side) - 1] = True
        return open_, planes

    def _open_at(self, places: Places) -> BoolArray:
        """Which of the gaps matter at places: those that do at some of the nearest that are shown."""
        here, there = (self._scaled(some) for some in (places, self.shown))
        away = ((here[:, None] - there) ** 2).sum(axis=-1)
        nearest = np.argpartition(away, min(NEAREST, away.shape[1]) - 1, axis=1)[:, :NEAREST]
        return np.asarray(self.open[nearest].any(axis=1))

    def _scaled(self, places: Places) -> FloatArray:
        """Offsets from the circle, over a root of the distance from it, and arcs about the axis."""
        right = places.radius - self.circle
        root = np.sqrt(np.maximum(np.hypot(right, places.depth), TINY))
        arc = np.minimum(places.angle, np.pi - places.angle)
        return np.stack([right / root, places.depth / root, arc], axis=1)

    def swt(self, places: Places, single: BoolArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """swt over E* δ0/R at N places, an estimate of what is missing of it, (N,) each, and normals, (N, 3).

        Those that are ``single``, (N,), are searched until they can hide little: nothing averages that out.
        """
        histories = Histories(self.scene, *places, self.springs)
        instant = self._instants(places, self._open_at(places))
        stress = histories.stress(instant)
        # A peak between the instants may make another plane critical: the planes are searched twice.
        normal = self.planes.normal[self.planes.swt(stress, self.ν, self.criterion).argmax(axis=1)]
        instant, stress, _ = self._closer(histories, np.arange(len(instant)), instant, stress, normal, FIRST)
        # For the same reason the rivals of the critical plane have instants of their own.
        row, value, normal = rival_planes(stress, self.planes, self.ν, self.criterion)
        instant, stress = self._high(instant[row], stress, row, normal)
        missing, hides = np.zeros((2, *value.shape))
        highest, rival, normals = np.zeros(len(single)), np.arange(len(row)), normal.copy()
        for number, (peaks, doubt) in enumerate(zip(PEAKS, DOUBTS, strict=True), start=1):
            at = row[rival]
            instant, stress, share = self._closer(histories, at, instant, stress, normal, peaks)
            better, normal = climb_from(stress, self.ν, normal, self.criterion)
            missing[rival] += doubt * (better - value[rival])
            value[rival], hides[rival], normals[rival] = better, share * better, normal
            np.maximum.at(highest, at, better)
            least = np.where(single[at], self.settled, SETTLED if number < ROUNDS else np.inf)
            open_ = (share > least) & (better * (1.0 + share) >= highest[at])
            rival, instant, stress, normal = rival[open_], instant[open_], stress[open_], normal[open_]
            if not rival.size:
                break
        best = np.lexsort((value, row))[np.append(np.diff(row) > 0, True)]
        return value[best], missing[best] + HIDDEN * hides[best], normals[best]

    def _high(
        self, instant: FloatArray, stress: FloatArray, row: IndexArray, normal: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Instants at which a curve is high on one plane each, and those beside them, with the stresses.

        The instants, (m, T), are those of rows of the stresses, (n, T, 6).
        """
        order = np.argsort(instant, axis=1)
        curve = self._curves(stress[row], normal)
        high = gather(np.logical_or.reduce(near_maximum(curve, HIGH)), order)
        (kept,) = packed(with_neighbours(high), order)
        return gather(instant, kept), stress[row[:, None], kept]

    def _closer(
        self,
        histories: Histories,
        rows: IndexArray,
        instant: FloatArray,
        stress: FloatArray,
        normal: FloatArray,
        peaks: int,
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Instants and stresses of some places, and those beside the highest peaks on one plane each.

        Also what of swt, over it, may be hidden by these peaks, as far as they are no parabolas.
        """
        order = np.argsort(instant, axis=1)
        curve = self._curves(stress, normal)
        found = Peaks.of(gather(instant, order), gather(curve, np.broadcast_to(order, curve.shape)), peaks)
        closer = np.concatenate([*found.beside], axis=1)
        new = histories.stress(closer, rows)
        beside = self._curves(new, normal, stress)
        own = [np.split(each, len(curve), axis=-1)[k] for k, each in enumerate(beside)]
        top = np.maximum(curve.max(axis=-1), beside.max(axis=-1))
        instant, stress = (np.concatenate(v, axis=1) for v in ((instant, closer), (stress, new)))
        return instant, stress, self._share(found.hidden(np.stack(own)), top)

    def _share(self, hidden: FloatArray, top: FloatArray) -> FloatArray:
        """Share of swt that is hidden by peaks of the curves, (3, m), that hide so much each."""
        tension, amplitude = top[0], top[1] + top[2]
        some = ((tension > 0.0) | (not self.criterion.needs_tension)) & (amplitude > 0.0)
        power = self.criterion.powers(*(np.where(some, v, 1.0) for v in (tension, 0.5 * amplitude)))
        tension = np.where(some & (tension != 0.0), tension, np.inf)
        amplitude = np.where(some, amplitude, np.inf)
        return power[0] * (hidden[0] / tension) + power[1] * ((hidden[1] + hidden[2]) / amplitude)

    def _instants(self, places: Places, open_: BoolArray) -> FloatArray:
        """Instants of places in some of the gaps, shapes (N, T): common ones and their own."""
        common = np.broadcast_to(self.instant, open_.shape)
        (common,) = packed(open_ | np.roll(open_, 1, axis=1), common)
        return np.concatenate([common, self._own_instants(places, open_)], axis=1)

    def _own_instants(self, places: Places, open_: BoolArray) -> FloatArray:
        """Instants at which the contact edge or a slip front passes near places, shape (N, E)."""
        instant, passes = _passages(self.scene, places)
        within = np.searchsorted(self.instant, instant, "right") - 1
        return _packed(instant, passes & gather(open_, within % self.instant.size))

    def _curves(self, stress: FloatArray, normal: FloatArray, like: FloatArray | None = None) -> FloatArray:
        """The curves of the criterion, shape (3, m, T), of histories on one plane each; see `on_planes`."""
        tension, swing = on_planes(stress, self.ν, normal[:, None], self.criterion.swing, like)
        return np.stack(self.criterion.curves(tension[:, 0], swing[:, 0]))
