"""A first look at swt along the surface line: at few event-aligned instants, on few planes."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.look import Look, Resolution, reach
from swtstudy.mechanics.planes.criterion import curves, of_maxima
from swtstudy.mechanics.planes.through_y import PlaneHistory, coarse_swt
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
    swt, double_angle, highest
        Shape (n, 2, X): at x = +r and x = −r, or (n, 1, X) where both are alike; 2θ in rad; and how high swt
        may really be between the instants.
    history
        What was seen there; where both sides are alike, the second half is the mirror image of the first.
    """

    swt: FloatArray
    double_angle: FloatArray
    highest: FloatArray
    history: History

    def candidates(self, r: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
        """The `local_maxima`, and where swt may be highest between instants, unless beside one of these."""
        peaks = local_maxima(self.swt, self.double_angle, r)
        n, sides, columns = self.swt.shape
        chosen = np.zeros((n, sides, columns + 2), dtype=bool)
        for step in range(3):
            chosen[peaks[0], peaks[1], peaks[2] + step] = True
        side, column = np.divmod(self.highest.reshape(n, -1).argmax(axis=1), columns)
        more = np.flatnonzero(~chosen[np.arange(n), side, column + 1])
        besides = more, side[more], column[more]
        point, side, column = (np.concatenate(both) for both in zip(peaks, besides, strict=True))
        return point, side, column

    def closer(
        self, scene: Scene, point: NDArray[np.intp], side: NDArray[np.intp], column: NDArray[np.intp]
    ) -> FloatArray:
        """2θ of the best planes at single positions, rad, shape (m,), from a closer look on more planes.

        Parameters
        ----------
        scene
            The n points.
        point, side, column
            Shape (m,): index of the positions.
        """
        x_sign = np.where(side == 0, 1.0, -1.0)[:, None, None]
        planes = scene.take(point).planes(self.history.take(point[:, None], column[:, None]), x_sign)
        return coarse_swt(planes, CLOSER_PLANES)[1][:, 0]


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
    mirrored = scene.mirrored_half
    cycle = scene.cycle.first_half() if mirrored else scene.cycle
    look = Look.at(replace(scene, cycle=cycle), position, resolution.nodes, resolution.digits)
    history = look.history
    if mirrored:
        # The same instants with the tangential load reversed.
        history = history.joined(history.with_tangential_sign(-1.0))
    inside = np.concatenate([look.inside] * (2 if mirrored else 1), axis=-1)
    sides = [
        _seen(scene.planes(history, side), inside, planes) for side in ((1.0,) if mirrored else (1.0, -1.0))
    ]
    swt, angle, highest = (np.stack(both, axis=1) for both in zip(*sides, strict=True))
    return FirstLook(swt, angle, highest, history)


def _seen(
    planes: PlaneHistory, inside: NDArray[np.bool_], count: int
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """swt, 2θ and how high swt may really be on these of ``count`` planes, each (n, X)."""
    swt, angle = coarse_swt(planes, count)
    highest = swt.copy()
    at = np.nonzero(swt >= CANDIDATE_SHARE * swt.max(axis=1, keepdims=True))
    of_swt = curves(*planes.take(*at).on_plane(angle[at]))
    highest[at] = of_maxima(*(reach(curve, inside[at]) for curve in of_swt))
    return swt, angle, highest


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


def plane_jumps(double_angle: FloatArray) -> NDArray[np.bool_]:
    """Whether another plane takes over between neighbouring positions (…, X), shape (…, X − 1)."""
    return np.asarray(np.abs(np.angle(np.exp(1j * np.diff(double_angle)))) > JUMP)


def _hidden(
    swt: FloatArray,
    double_angle: FloatArray,
    over_left: NDArray[np.bool_],
    over_right: NDArray[np.bool_],
    least: FloatArray,
) -> NDArray[np.bool_]:
    """Where another plane takes over, its maximum may hide beside the flank of the former one's."""
    turn = plane_jumps(double_angle)
    turn &= np.minimum(swt[..., 1:], swt[..., :-1]) >= least
    hidden = np.zeros(swt.shape, dtype=bool)
    hidden[..., 1:] |= turn & over_right[..., 1:]
    hidden[..., :-1] |= turn & over_left[..., :-1]
    return hidden
