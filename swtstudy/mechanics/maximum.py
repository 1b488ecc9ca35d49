"""The maximum of swt over the surface line (eq. 10): global first, then local."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.gather import gather, pick
from swtstudy.mechanics.instants import split_at_breakpoints
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.positions import SPREAD, PositionBrackets, cusps, first_look
from swtstudy.mechanics.swt_line import Resolution, Scene, refine, scan

#: Planes that the first look tries.
SCAN_PLANES = 8
SCAN_RESOLUTION = Resolution(nodes=2, zooms=0, growth_nodes=8)
#: Local maxima below these shares of the largest are not followed, after the first look and each round.
CANDIDATE_SHARES = (0.9, 0.97, 0.995, 0.999)
#: Distances at which each round of the local search looks, in widths, and how the width shrinks.
OFFSETS = np.array([-3.0, -1.0, 0.0, 1.0, 3.0])
FIRST_WIDTH, SHRINKING = 0.2, 0.2


@dataclass(frozen=True)
class Accuracy:
    """What a relative tolerance asks of the local search.

    Attributes
    ----------
    search
        Resolution of the local search over x.
    check
        A finer one for the value itself; the difference of the two is the error in time and angle.
    rounds
        Rounds of the local search.
    """

    search: Resolution
    check: Resolution
    rounds: int

    @classmethod
    def for_tolerance(cls, rtol: float) -> Accuracy:
        """The least effort that keeps the error below ``rtol``."""
        digits = -np.log10(rtol)
        zooms = max(int(np.ceil(digits / 2.0)), 1)
        growth = int(4 * np.ceil(digits))
        return cls(
            Resolution(3, zooms, growth), Resolution(4, zooms + 1, growth + 6), 2 + int(digits > 3.5)
        )


@dataclass(frozen=True)
class Maximum:
    """Largest swt of n points.

    Attributes
    ----------
    swt, error
        Shape (n,): over E* δ0/R, and its estimated absolute error.
    position
        Shape (n,): signed x in a_H.
    double_angle
        Shape (n,): 2θ of the critical plane's normal, rad.
    """

    swt: FloatArray
    error: FloatArray
    position: FloatArray
    double_angle: FloatArray


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene."""
    split = replace(scene, cycle=split_at_breakpoints(scene.cycle))
    positions = first_look(cusps(split.cycle, scene.profile), SPREAD)
    swt, angle = scan(scene, positions.r, SCAN_RESOLUTION, SCAN_PLANES)
    point, side, column = local_maxima(swt)
    brackets = PositionBrackets.around(positions, point, 1.0 - 2.0 * side, column)
    angle = angle[point, side, column]
    centre, width = np.zeros(len(point)), FIRST_WIDTH
    for turn in range(accuracy.rounds):
        c = _look(centre, width)
        values, angles = refine(
            split.take(brackets.point),
            brackets.radius(c),
            brackets.side,
            np.repeat(angle[:, None], c.shape[1], axis=1),
            accuracy.search,
        )
        best = values.argmax(axis=1)
        angle = pick(angles, best)
        centre, top = _vertex(c, values, brackets.is_corner)
        largest = np.zeros(len(scene))
        np.maximum.at(largest, brackets.point, top)
        open_ = top >= CANDIDATE_SHARES[min(turn + 1, 3)] * largest[brackets.point]
        brackets, angle, centre, top = brackets.take(open_), angle[open_], centre[open_], top[open_]
        width *= SHRINKING
    order = np.lexsort((-top, brackets.point))
    first = order[np.unique(brackets.point[order], return_index=True)[1]]
    brackets, angle, centre, top = brackets.take(first), angle[first], centre[first], top[first]
    r = brackets.radius(centre[:, None])
    value, angle = refine(split, r, brackets.side, angle[:, None], accuracy.check)
    return Maximum(value[:, 0], np.abs(value[:, 0] - top), brackets.side * r[:, 0], angle[:, 0])


def local_maxima(swt: FloatArray) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.intp]]:
    """Point, side and column of the local maxima that may hold the largest swt.

    Parameters
    ----------
    swt
        Shape (n, 2, X), at ascending positions on both sides.
    """
    padded = np.pad(swt, ((0, 0), (0, 0), (1, 1)), constant_values=-1.0)
    largest = swt.max(axis=(1, 2), keepdims=True)
    peak = (swt >= padded[..., 2:]) & (swt > padded[..., :-2]) & (swt >= CANDIDATE_SHARES[0] * largest)
    # A point without tension anywhere keeps one bracket all the same.
    peak[:, 0, 0] |= largest[:, 0, 0] <= 0.0
    return np.nonzero(peak)


def _look(centre: FloatArray, width: float) -> FloatArray:
    """Values of c around the centres, ascending, shape (m, k), on the centre's side of a corner."""
    c = np.clip(centre[:, None] + width * OFFSETS, -1.0, 1.0)
    c = np.where(centre[:, None] > 0.0, np.maximum(c, 0.0), c)
    return np.where(centre[:, None] < 0.0, np.minimum(c, 0.0), c)


def _vertex(
    c: FloatArray, values: FloatArray, is_corner: NDArray[np.bool_]
) -> tuple[FloatArray, FloatArray]:
    """Abscissa and value of the maximum of a parabola through the best value and its neighbours.

    At a corner each side has its own parabola, through the corner and the next two values.
    """
    best = values.argmax(axis=1)
    last = c.shape[1] - 1
    corner = is_corner & (pick(c, best) == 0.0)
    position, top = pick(c, best), pick(values, best)
    for toward in (-1, 1):
        middle = np.where(corner, best + toward, best)
        middle = np.clip(middle, 1, last - 1)
        index = middle[:, None] + np.array([-1, 0, 1])
        x, y = gather(c, index), gather(values, index)
        vertex, height = _parabola_maximum(x, y)
        higher = height > top
        position, top = np.where(higher, vertex, position), np.where(higher, height, top)
    return position, top


def _parabola_maximum(x: FloatArray, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Maximum of the parabolas through three points within their range, shapes (m, 3); else the largest y."""
    left, right = x[:, 1] - x[:, 0], x[:, 2] - x[:, 1]
    proper = (left > 0.0) & (right > 0.0)
    left, right = np.where(proper, left, 1.0), np.where(proper, right, 1.0)
    rise, fall = (y[:, 1] - y[:, 0]) / left, (y[:, 2] - y[:, 1]) / right
    bend = (fall - rise) / (left + right)
    proper &= bend < 0.0
    slope = (rise * right + fall * left) / (left + right)
    shift = np.where(proper, -0.5 * slope / np.where(proper, bend, 1.0), 0.0)
    proper &= (shift >= -left) & (shift <= right)
    best = y.argmax(axis=1)
    return (
        np.where(proper, x[:, 1] + shift, pick(x, best)),
        np.where(proper, y[:, 1] + 0.5 * slope * shift, pick(y, best)),
    )
