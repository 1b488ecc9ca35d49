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
from swtstudy.mechanics.body.quick_planes import climb_from, highest_coarse_planes, quick_planes
from swtstudy.mechanics.events.passages import front_passes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.numerics.arrays import gather, packed
from swtstudy.mechanics.numerics.peaks import near_maximum, parabola_maximum
from swtstudy.mechanics.planes.ascent import normal_weights
from swtstudy.mechanics.planes.criterion import curves
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field.contact_states import resolving_cells
from swtstudy.mechanics.stress.scene import Scene

#: The edge or a front passes so far from a place, in its depth, at its own instants.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0])
#: Passages nearer to the end of an interval, rad, are at that end, or none.
NO_PASSAGE = 1e-9
#: A stress or strain this near to its extreme over the cycle, in its range, may have it close by, also at
#: other places.
HOT = 0.3
#: Peaks of each curve beside which instants are added in each round. Places whose swt grew by less than the
#: share need no other one.
PEAKS, SETTLED = (2, 1, 1, 1), 1e-3
#: What is missing at last, over what each round added: means of scenes all over the parameters miss less.
DOUBTS = (0.1, 1.0, 1.0, 1.0)


class Places(NamedTuple):
    """Radius, depth and angle about the axis of N places, each of shape (N,)."""

    radius: FloatArray
    depth: FloatArray
    angle: FloatArray

    def at(self, index: NDArray[np.intp]) -> Places:
        """Some of the places."""
        return Places(*(values[index] for values in self))


class Fineness(NamedTuple):
    """Steps of the common instants on each stretch between two events, and cells as for `resolving_cells`."""

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
        self.slopes = resolving_cells(scene.cycle, scene.coordinate, fineness.cells)
        instant = np.unique(np.mod(time_nodes(scene, fineness.steps, [circle]).instant, PERIOD))
        stress = Histories(scene, *shown, *self.slopes).stress(
            np.broadcast_to(instant, (shown.radius.size, instant.size))
        )
        hot = np.zeros(instant.size, dtype=bool)
        for curve in self._curves(stress, quick_planes(stress, self.ν)[1]):
            hot |= near_maximum(curve, HOT).any(axis=0)
        #: Instants, and which of the gaps that follow them matter.
        self.instant, self.open = instant, hot | np.roll(hot, -1)
        self.common = instant[self.open | np.roll(self.open, 1)]

    def swt(self, places: Places) -> tuple[FloatArray, FloatArray]:
        """swt over E* δ0/R at N places, and an estimate of what is missing of it, shape (N,) each."""
        histories = Histories(self.scene, *places, *self.slopes)
        own = self._own_instants(places)
        common = np.broadcast_to(self.common, (len(own), self.common.size))
        instant = np.sort(np.concatenate([common, own], axis=1), axis=1)
        rows: NDArray[np.intp] = np.arange(len(own))
        stress = histories.stress(instant)
        # A peak between the instants may make another plane critical: the planes are searched twice.
        normal = highest_coarse_planes(stress, self.ν)
        instant, stress = self._closer(histories, rows, instant, stress, normal, 2)
        swt, normal = quick_planes(stress, self.ν)
        missing = np.zeros_like(swt)
        for peaks, doubt in zip(PEAKS, DOUBTS, strict=True):
            instant, stress = self._closer(histories, rows, instant, stress, normal, peaks)
            better, normal = climb_from(stress, self.ν, normal)
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

    def _own_instants(self, places: Places) -> FloatArray:
        """Instants at which the contact edge or a slip front passes near places, shape (N, E)."""
        cycle = self.scene.cycle
        near = np.maximum(places.radius[:, None] + places.depth[:, None] * OFFSETS, 0.0)
        coordinate = self.scene.coordinate.of(near.reshape(1, -1))
        found = cycle.load.passage(coordinate, cycle.begin, cycle.end), front_passes(cycle, coordinate)
        instant = np.concatenate([passes.reshape(len(near), -1) for passes in found], axis=1)
        ends = np.concatenate([[0.0], cycle.end[0]])
        after = np.clip(np.searchsorted(ends, instant), 1, ends.size - 1)
        gap = np.minimum(np.abs(instant - ends[after]), np.abs(instant - ends[after - 1]))
        kept = (gap > NO_PASSAGE) & self.open[np.searchsorted(self.instant, instant, "right") - 1]
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

    In the middle of both gaps, and where a parabola has its maximum.
    """
    around = _with_neighbours(instant)
    around[0, :, 0] -= PERIOD
    around[2, :, -1] += PERIOD
    row = np.arange(len(instant))[:, None]
    found = []
    for curve in several:
        values = _with_neighbours(curve)
        top, height = parabola_maximum(*(np.moveaxis(v, 0, -1).reshape(-1, 3) for v in (around, values)))
        peaked = (values[1] >= values[0]) & (values[1] >= values[2])
        height = np.where(peaked, height.reshape(curve.shape), -np.inf)
        highest = np.argpartition(-height, peaks, axis=1)[:, :peaks]
        before, at, after = around[:, row, highest]
        found += [0.5 * (before + at), top.reshape(curve.shape)[row, highest], 0.5 * (at + after)]
    return np.mod(np.concatenate(found, axis=1), PERIOD)


def _with_neighbours(values: FloatArray) -> FloatArray:
    """Each value of the rows with the one before and the one after, shape (3, …)."""
    return np.stack([np.roll(values, 1, axis=1), values, np.roll(values, -1, axis=1)])
