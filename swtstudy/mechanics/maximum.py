"""The maximum of swt over the surface line (eq. 10): global first, then local.

swt(x) has cusps at known places: where the contact edge turns, a(δ0 ± δA), and where slip fronts end, the
breakpoints of the memory diagram. In between it is smooth but for convex kinks, so that every local maximum
is either at such a place or smooth.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.gather import packed
from swtstudy.mechanics.instants import split_at_breakpoints
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Resolution, Scene, refine, scan

#: Positions of the first look besides the cusps, from near the centre to the largest contact radius.
SCAN_POSITIONS = 24
#: Planes that the first look tries.
SCAN_PLANES = 8
SCAN_RESOLUTION = Resolution(nodes=2, zooms=0, growth_nodes=8)
#: Local maxima below this share of the largest are not followed.
CANDIDATE_SHARE = 0.9
#: Cusps nearer than this in depth are one.
SAME_POSITION = 1e-9


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


@dataclass
class Brackets:
    """Local maxima of swt(r): each between its two neighbours.

    Arrays of shape (m,), but ``r`` and ``swt`` of shape (m, 3).
    """

    point: NDArray[np.intp]
    side: FloatArray
    r: FloatArray
    swt: FloatArray
    double_angle: FloatArray

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> Brackets:
        return Brackets(
            self.point[index], self.side[index], self.r[index], self.swt[index], self.double_angle[index]
        )


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene."""
    split = replace(scene, cycle=split_at_breakpoints(scene.cycle))
    position = scan_positions(split)
    swt, angle = scan(scene, position, SCAN_RESOLUTION, SCAN_PLANES)
    brackets = find_brackets(position, swt, angle)
    scene = split
    for turn in range(accuracy.rounds):
        brackets = _narrow(scene, brackets, accuracy.search, first=turn == 0)
        brackets = _still_open(brackets, len(scene), CANDIDATE_SHARE if turn == 0 else 1 - 0.03**turn)
    return _best(scene, brackets, accuracy.check)


def scan_positions(scene: Scene) -> FloatArray:
    """Positions of the first look, ascending, shape (n, X); rows with fewer repeat the last.

    Cusps of swt(x) are where the contact edge or a slip front is when something else changes; in between,
    positions are spread evenly.
    """
    cycle, profile = scene.cycle, scene.profile
    n = len(scene)
    starts = cycle.memory.start.reshape(n, -1)
    edges = np.maximum(cycle.protocol.depth(cycle.begin), 0.0)
    largest_depth = 1.0 + cycle.protocol.normal_amplitude[:, None]
    cusps = np.sort(
        np.concatenate([largest_depth, edges, np.where(np.isfinite(starts), starts, 0.0)], axis=1), axis=1
    )
    new = np.diff(cusps, axis=1, prepend=0.0) > SAME_POSITION
    new[:, -1] = True
    cusps = profile.radius(packed(new, cusps)[0])
    largest, flat = cusps.max(axis=1, keepdims=True), profile.flat_radius[:, None]
    share = (np.arange(SCAN_POSITIONS) + 0.5) / SCAN_POSITIONS
    spread = flat + (largest - flat) * share
    distance = np.abs(spread[:, :, None] - cusps[:, None, :]).min(axis=2)
    lone = distance > 0.4 * (largest - flat) / SCAN_POSITIONS
    spread = np.where(lone, spread, largest)
    position = np.sort(np.concatenate([cusps, spread], axis=1), axis=1)
    new = np.diff(position, axis=1, prepend=0.0) > 0.0
    return np.minimum(packed(new, position)[0], largest)


def find_brackets(position: FloatArray, swt: FloatArray, angle: FloatArray) -> Brackets:
    """Local maxima that may hold the largest swt.

    Parameters
    ----------
    position
        Shape (n, X), ascending.
    swt, angle
        Shape (n, 2, X), at +r and −r.
    """
    padded = np.pad(swt, ((0, 0), (0, 0), (1, 1)), constant_values=-1.0)
    middle, left, right = padded[..., 1:-1], padded[..., :-2], padded[..., 2:]
    largest = swt.max(axis=(1, 2), keepdims=True)
    peak = (middle >= right) & (middle > left) & (middle >= CANDIDATE_SHARE * largest)
    # A point without tension anywhere keeps one bracket all the same.
    peak[:, 0, -1] |= largest[:, 0, 0] <= 0.0
    point, side, column = np.nonzero(peak)
    last = position.shape[1] - 1
    r = np.stack(
        [position[point, np.clip(column + k, 0, last)] for k in (-1, 0, 1)], axis=1
    )
    at = point, side, column
    values = np.stack([left[at], middle[at], right[at]], axis=1)
    return Brackets(point, 1.0 - 2.0 * side, r, values, angle[at])


def _narrow(scene: Scene, brackets: Brackets, resolution: Resolution, first: bool) -> Brackets:
    """Look at positions within each bracket and keep the best of them with its neighbours."""
    left, middle, right = brackets.r.T
    if first:
        # Near a cusp the fall on either side is seen at once.
        shares = np.array([0.0, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0])
        trial = np.where(
            shares < 1.0,
            left[:, None] + (middle - left)[:, None] * shares,
            middle[:, None] + (right - middle)[:, None] * (shares - 1.0),
        )
        known = np.full(trial.shape, np.nan)
    else:
        guess = _vertex(brackets)
        gap = 0.15 * np.minimum(middle - left, right - middle)
        trial = np.stack([guess - gap, guess, guess + gap], axis=1)
        trial = np.clip(trial, left[:, None], right[:, None])
        trial = np.concatenate([trial, brackets.r], axis=1)
        known = np.concatenate([np.full((len(guess), 3), np.nan), brackets.swt], axis=1)
    order = np.argsort(trial, axis=1, kind="stable")
    trial, known = np.take_along_axis(trial, order, axis=1), np.take_along_axis(known, order, axis=1)
    rows = scene.take(brackets.point)
    start = np.broadcast_to(brackets.double_angle[:, None], trial.shape)
    new = np.isnan(known)
    count = int(new[0].sum())
    where = np.nonzero(new)
    asked = trial[where].reshape(-1, count)
    swt, angle = refine(rows, asked, brackets.side, start[:, :count], resolution)
    values = known.copy()
    values[where] = swt.ravel()
    angles = start.copy()
    angles[where] = angle.ravel()
    best = values.argmax(axis=1)
    row = np.arange(len(best))
    last = trial.shape[1] - 1
    index = np.clip(best[:, None] + np.array([-1, 0, 1]), 0, last)
    return Brackets(
        brackets.point,
        brackets.side,
        np.take_along_axis(trial, index, axis=1),
        np.take_along_axis(values, index, axis=1),
        angles[row, best],
    )


def _vertex(brackets: Brackets) -> FloatArray:
    """Abscissa of the parabola through the three values, clipped into the bracket; the middle at a cusp."""
    (x0, x1, x2), (f0, f1, f2) = brackets.r.T, brackets.swt.T
    h0, h2 = x1 - x0, x2 - x1
    with np.errstate(divide="ignore", invalid="ignore"):
        s0, s2 = (f1 - f0) / h0, (f2 - f1) / h2
        shift = x1 - 0.5 * (h2 * s0 + h0 * s2) / (s2 - s0) * 1.0
    good = np.isfinite(shift) & (shift > x0) & (shift < x2)
    return np.where(good, shift, x1)


def _still_open(brackets: Brackets, count: int, share: float) -> Brackets:
    """Drop brackets that can no longer hold the largest swt of their point."""
    largest = np.zeros(count)
    np.maximum.at(largest, brackets.point, brackets.swt[:, 1])
    return brackets.take(brackets.swt[:, 1] >= share * largest[brackets.point])


def _best(scene: Scene, brackets: Brackets, check: Resolution) -> Maximum:
    """The largest value of each point, computed once more at a finer resolution."""
    order = np.lexsort((-brackets.swt[:, 1], brackets.point))
    first = np.unique(brackets.point[order], return_index=True)[1]
    best = brackets.take(order[first])
    swt, angle = refine(scene, best.r[:, 1:2], best.side, best.double_angle[:, None], check)
    error = np.abs(swt[:, 0] - best.swt[:, 1])
    return Maximum(swt[:, 0], error, best.side * best.r[:, 1], angle[:, 0])

