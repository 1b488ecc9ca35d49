"""A first look at swt along the surface line, and which parts of the cycle make it.

Few event-aligned instants and planes show where swt may be largest, and in which intervals of the cycle its
three extremes can be: the local search looks nowhere else.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle
from swtstudy.mechanics.events.stretches import NO_STRETCH
from swtstudy.mechanics.line.look import Look, Resolution, near_extremes
from swtstudy.mechanics.load.load import PERIOD
from swtstudy.mechanics.planes.through_y import coarse_swt
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.history import History
from swtstudy.mechanics.stress.scene import Scene

#: Local maxima below this share of the largest are not followed: so far the few planes and instants are off.
#: 0.95: no change at 128 points, nor at those of tests/test_narrow_maxima.py, less than 10 % faster.
CANDIDATE_SHARE = 0.85
#: Change of 2θ to the next position by which another plane has taken over, rad, and the share of the largest
#: swt from which that is followed. Never: 6e-3 and 4e-4 at two points of tests/test_narrow_maxima.py.
JUMP, HIDDEN_SHARE = 0.15, 0.97
#: Two local maxima whose heights differ by less, relative, are both followed. 0: no change at 128 points, nor
#: at those of tests/test_narrow_maxima.py.
TWIN = 0.01
#: Positions nearer than this share of their range lie side by side. 0: no change at 128 points.
SIDE_BY_SIDE = 1e-4
#: Planes that are tried where the first look finds a local maximum. Half or twice: rounding, at 128 points.
CLOSER_PLANES = 72


@dataclass(frozen=True)
class FirstLook:
    """swt at n × X positions on both sides of the contact, to the accuracy of a first look.

    Attributes
    ----------
    swt, double_angle
        Shape (n, 2, X): at x = +r and x = −r, or (n, 1, X) where both are alike; 2θ in rad.
    interval
        Shape (n, X, T): interval of the cycle in which each instant of `history` is, or whose mirror image.
    first, last
        Shape (n, 2, i): intervals of the whole cycle that each interval, and its mirror image, is made of.
    history
        What was seen there; where both sides are alike, the second half is the mirror image of the first.
    """

    swt: FloatArray
    double_angle: FloatArray
    interval: NDArray[np.intp]
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    history: History

    def closer(
        self, scene: Scene, point: NDArray[np.intp], side: NDArray[np.intp], column: NDArray[np.intp]
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """A closer look at single positions, on more planes.

        Parameters
        ----------
        scene
            The n points.
        point, side, column
            Shape (m,): index of the positions.

        Returns
        -------
        double_angle
            Shape (m,): 2θ of the best plane, rad.
        hot
            Shape (m, i): intervals of the cycle that can hold an extreme.
        """
        x_sign = np.where(side == 0, 1.0, -1.0)[:, None, None]
        planes = scene.take(point).planes(self.history.take(point[:, None], column[:, None]), x_sign)
        _, angle = coarse_swt(planes, CLOSER_PLANES)
        both = angle, self.double_angle[point, side, column][:, None]
        row, _, instant = np.nonzero(near_extremes(planes, both))
        count = self.interval.shape[-1]
        at = point[row], instant // count, self.interval[point[row], column[row], instant % count]
        # Ranges of intervals, as steps up and down.
        steps = np.zeros((len(point), scene.cycle.begin.shape[1] + 1), dtype=np.intp)
        np.add.at(steps, (row, self.first[at]), 1)
        np.add.at(steps, (row, self.last[at] + 1), -1)
        return angle[:, 0], np.cumsum(steps, axis=1)[:, :-1] > 0


def first_look(scene: Scene, position: FloatArray, resolution: Resolution, planes: int) -> FirstLook:
    """Look at swt on both sides of the contact.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    resolution
        Its zooms are not used.
    planes
        Number of planes that are tried.
    """
    # Half of the period is enough where the other half is its mirror image.
    mirrored = scene.cycle.load.mirrored_half
    cycle = scene.cycle.first_half() if mirrored else scene.cycle
    look = Look.at(replace(scene, cycle=cycle), position, resolution.nodes, resolution.digits)
    history = look.history
    if mirrored:
        # The same instants with the tangential load reversed.
        history = history.joined(history.with_tangential_sign(-1.0))
    sides = [
        coarse_swt(scene.planes(history, side), planes) for side in ((1.0,) if mirrored else (1.0, -1.0))
    ]
    swt, angle = (np.stack(both, axis=1) for both in zip(*sides, strict=True))
    interval = look.nodes.spread(look.nodes.interval)
    return FirstLook(swt, angle, interval, *_parts_of_whole(cycle, scene.cycle), history)


def _parts_of_whole(cycle: Cycle, whole: Cycle) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First and last interval of the whole cycle in each interval of a cycle, and in its mirror image.

    An interval of the first half may reach beyond it, and its mirror image into several.

    Returns
    -------
    Each of shape (n, 2, i).
    """
    begin, end = (np.stack([v, v + 0.5 * PERIOD], axis=1)[..., None] for v in (cycle.begin, cycle.end))
    first = (whole.end[:, None, None] <= begin + NO_STRETCH).sum(axis=-1)
    last = np.maximum((whole.begin[:, None, None] < end - NO_STRETCH).sum(axis=-1) - 1, first)
    most = whole.begin.shape[1] - 1
    return np.minimum(first, most), np.minimum(last, most)


def local_maxima(
    swt: FloatArray, double_angle: FloatArray, r: FloatArray
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Point, side and column of the local maxima that may hold the largest swt.

    Parameters
    ----------
    swt, double_angle
        Shape (n, 1 or 2, X), on one or both sides; 2θ of the best planes, rad.
    r
        Shape (n, X): the positions, ascending; shorter rows repeat their first one.
    """
    largest = swt.max(axis=(1, 2), keepdims=True)
    over_left, over_right = _over_neighbours(swt, r)
    peak = over_left & over_right & (swt >= CANDIDATE_SHARE * largest)
    peak |= _hidden(swt, double_angle, over_left, over_right, HIDDEN_SHARE * largest)
    # A point without tension anywhere keeps one bracket all the same.
    peak[:, 0, 0] |= largest[:, 0, 0] <= 0.0
    point, side, column = np.nonzero(peak)
    return point, side, column


def _over_neighbours(swt: FloatArray, r: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether swt is higher than at the left neighbour, and whether it is no lower than at the right one.

    Of two cusps side by side that make a maximum together, each has its own neighbour on the other side.
    """
    ends = ((0, 0), (0, 0))
    left, right = swt[..., :-1], swt[..., 1:]
    over_right = np.pad(left >= right, (*ends, (0, 1)), constant_values=True)
    over_left = np.pad(right > left, (*ends, (1, 0)), constant_values=True)
    gap = np.diff(r)
    together = ((gap > 0.0) & (gap < SIDE_BY_SIDE * (r.max(axis=1) - r[:, 0])[:, None]))[:, None]
    together = together & (np.minimum(right, left) >= (1.0 - TWIN) * np.maximum(right, left))
    over_right[..., :-1] |= together & over_right[..., 1:]
    over_left[..., 1:] |= together & over_left[..., :-1]
    return over_left, over_right


def _hidden(
    swt: FloatArray,
    double_angle: FloatArray,
    over_left: NDArray[np.bool_],
    over_right: NDArray[np.bool_],
    least: FloatArray,
) -> NDArray[np.bool_]:
    """Where another plane takes over, its maximum may hide beside the flank of the former one's."""
    turn = np.abs(np.angle(np.exp(1j * np.diff(double_angle)))) > JUMP
    turn &= np.minimum(swt[..., 1:], swt[..., :-1]) >= least
    hidden = np.zeros(swt.shape, dtype=bool)
    hidden[..., 1:] |= turn & over_right[..., 1:]
    hidden[..., :-1] |= turn & over_left[..., :-1]
    return hidden
