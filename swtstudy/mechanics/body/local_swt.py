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
    on_planes,
    planes_like,
)
from swtstudy.mechanics.body.spring_cells import SpringCells
from swtstudy.mechanics.body.time_peaks import SAME_INSTANT, Peaks
from swtstudy.mechanics.events.passages import front_passes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.peaks import near_maximum
from swtstudy.mechanics.planes.criterion import curves
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Steps of all intervals of a cycle at most, unless each has one: 200 sides are a third faster.
MANY = 256
#: The edge or a front passes so far from a place, in its depth, at its own instants.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0])
#: Passages nearer to the end of an interval, rad, are at that end, or none.
NO_PASSAGE = 1e-9
#: A stress or strain this near to its extreme over the cycle, in its range, may have it close by, also at
#: other places.
HOT = 0.05
#: So many of the places that are shown tell for the others near to them.
NEAREST = 9
#: Peaks of each curve beside which instants are added, before the planes are searched and in rounds after.
#: Places need no other round that can hide less of swt, over it, than the next.
FIRST, PEAKS, SETTLED = 1, (2, 1, 1, 1), 2e-3
#: What is missing at last, over what each round added, and over what may be hidden: means of scenes all over
#: the parameters miss less.
DOUBTS, HIDDEN = (0.05, 0.1, 0.1, 0.1), 0.15


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
        instant, stress, _ = self._closer(histories, rows, instant, stress, normal, FIRST)
        hot = np.zeros(instant.shape, dtype=bool)
        planes, normal = planes_like(stress, self.ν, self.γ)
        _, normal = climb_from(stress, self.ν, normal, self.γ)
        for curve in self._curves(stress, normal):
            hot |= near_maximum(curve, HOT)
        row, column = np.nonzero(hot)
        at = instant[row, column]
        open_ = np.zeros((rows.size, self.instant.size), dtype=bool)
        # Beside an instant that is common both gaps.
        for side in (at - SAME_INSTANT, at + SAME_INSTANT):
            open_[row, np.searchsorted(self.instant, side) - 1] = True
        return open_, planes

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
        instant, stress, _ = self._closer(histories, rows, instant, stress, normal, FIRST)
        swt, normal = highest_planes(stress, self.planes, self.ν, self.γ)
        missing, hides = np.zeros((2, *swt.shape))
        for peaks, doubt in zip(PEAKS, DOUBTS, strict=True):
            instant, stress, share = self._closer(histories, rows, instant, stress, normal, peaks)
            better, normal = climb_from(stress, self.ν, normal, self.γ)
            missing[rows] += doubt * (better - swt[rows])
            swt[rows], hides[rows] = better, share * better
            open_ = share > SETTLED
            rows, instant, stress, normal = rows[open_], instant[open_], stress[open_], normal[open_]
            if not rows.size:
                break
        return swt, missing + HIDDEN * hides

    def _closer(
        self,
        histories: Histories,
        rows: NDArray[np.intp],
        instant: FloatArray,
        stress: FloatArray,
        normal: FloatArray,
        peaks: int,
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Instants and stresses of some places, and those beside the highest peaks on one plane each.

        Also what of swt, over it, may be hidden by these peaks, as far as they are no parabolas.
        """
        order = np.argsort(instant, axis=1)
        curves = [gather(curve, order) for curve in self._curves(stress, normal)]
        several = [Peaks.of(gather(instant, order), curve, peaks) for curve in curves]
        closer = np.concatenate([each.beside for each in several], axis=1)
        new = histories.stress(closer, rows)
        beside = self._curves(new, normal)
        parts = (np.split(curve, len(several), axis=1)[k] for k, curve in enumerate(beside))
        hidden = [peaks.hidden(part) for peaks, part in zip(several, parts, strict=True)]
        tops = [np.maximum(a.max(axis=1), b.max(axis=1)) for a, b in zip(curves, beside, strict=True)]
        instant, stress = (np.concatenate(v, axis=1) for v in ((instant, closer), (stress, new)))
        return instant, stress, self._share(hidden, tops)

    def _share(self, hidden: list[FloatArray], tops: list[FloatArray]) -> FloatArray:
        """What of swt, over it, is hidden by peaks of the curves that hide so much each."""
        tension, amplitude = tops[0], tops[1] + tops[2]
        some = (tension > 0.0) & (amplitude > 0.0)
        tension, amplitude = np.where(some, tension, np.inf), np.where(some, amplitude, np.inf)
        of_amplitude = (hidden[1] + hidden[2]) / amplitude
        return 2.0 * ((1.0 - self.γ) * hidden[0] / tension + self.γ * of_amplitude)

    def _instants(self, places: Places, open_: NDArray[np.bool_]) -> FloatArray:
        """Instants of places in some of the gaps, shapes (N, T): common ones and their own."""
        common = np.broadcast_to(self.instant, open_.shape)
        (common,) = packed(open_ | np.roll(open_, 1, axis=1), common)
        return np.concatenate([common, self._own_instants(places, open_)], axis=1)

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
        of_stress, of_strain = on_planes(stress, self.ν, normal[:, None])
        return curves(of_stress[:, 0], of_strain[:, 0])
