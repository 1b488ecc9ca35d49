"""The maximum of swt over the surface line (eq. 10): global first, then local."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.passages import split_at_breakpoints
from swtstudy.mechanics.line.accuracy import Accuracy
from swtstudy.mechanics.line.climb import Climb
from swtstudy.mechanics.line.first_look import first_look
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.line.positions import positions_of_first_look
from swtstudy.mechanics.line.round import climb_round
from swtstudy.mechanics.line.value import refine
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Planes that the first look tries. Half or twice: no change at 128 points, 5 % faster or slower.
SCAN_PLANES = 16
SCAN_RESOLUTION = Resolution(nodes=2, zooms=0, digits=3.5)
#: Local maxima below these shares of the largest are not followed further, after each round. The last one at
#: once: 7e-6 at 1 of 56 points, 5e-3 at some of 600 (tests/test_narrow_maxima.py); 0.9 throughout: no gain.
SHARES = 0.97, 0.995, 0.999
LARGEST_ROUND_COUNT = 16
#: Local maxima times squared intervals of the cycle that one look takes at a time: its memory is bounded.
PART_SIZE = 400_000
#: Least error that is claimed, as a share of the tolerance.
LEAST_SHARE = 0.25
#: What numbers next to r cannot tell apart counts where r − b is less than this share of r, beside a cusp as
#: the root of 2e-16 r/(r − b), and where swt is smaller than this and so is 1/2 − ν: rounding leaves 1e-8 p.
BESIDE_FACE, FAINT, NO_SPREAD = 0.05, 1e-6, 0.01
NEIGHBOURS = np.array([-1.0, 1.0])


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

    @classmethod
    def unknown(cls, count: int, value: float) -> Maximum:
        """``count`` points that all have the same ``value`` everywhere."""
        return cls(*(np.full(count, value) for _ in range(4)))

    def take(self, index: NDArray[np.intp] | NDArray[np.bool_]) -> Maximum:
        """The points at ``index``."""
        return Maximum(*(values[index] for values in vars(self).values()))

    def put(self, index: NDArray[np.intp] | NDArray[np.bool_], other: Maximum) -> Maximum:
        """The same with other points at ``index``."""
        result = [values.copy() for values in vars(self).values()]
        for values, new in zip(result, vars(other).values(), strict=True):
            values[index] = new
        return Maximum(*result)


def maximum(scene: Scene, accuracy: Accuracy) -> Maximum:
    """Largest swt on the surface line of each of the n points of the scene.

    Points that miss the tolerance are searched once more with twice the instants and more rounds.
    """
    found = _search(scene, accuracy)
    doubtful = np.flatnonzero(found.error > accuracy.tolerance * found.swt)
    if doubtful.size:
        again = _search(scene.take(doubtful), accuracy.finer())
        # What was found is there: the larger value stands, and the smaller error.
        better = (again.error < found.error[doubtful]) & (
            again.swt >= found.swt[doubtful] - found.error[doubtful]
        )
        found = found.put(doubtful[better], again.take(better))
    face = scene.profile.flat_radius
    beside = (face > 0.0) & (np.abs(found.position) - face < BESIDE_FACE * np.abs(found.position))
    beside |= (found.swt < FAINT) & (0.5 - scene.poisson_ratio < NO_SPREAD)
    rows = np.flatnonzero(beside & (found.swt > 0.0))
    if rows.size:
        spread = _spread(scene.take(rows), found.take(rows), accuracy.check)
        found.error[rows] = np.maximum(found.error[rows], spread)
    return found


def _spread(scene: Scene, found: Maximum, resolution: Resolution) -> FloatArray:
    """How much swt varies over the numbers next to the positions of the n maxima, shape (n,)."""
    r = np.abs(found.position)[:, None]
    split = replace(scene, cycle=split_at_breakpoints(scene.cycle)[0])
    near = np.maximum(r + NEIGHBOURS * np.spacing(r), scene.profile.flat_radius[:, None])
    angle = np.broadcast_to(found.double_angle[:, None], near.shape)
    value, _ = refine(split, near, np.sign(found.position), angle, resolution)
    return np.asarray(np.abs(value - found.swt[:, None]).max(axis=1))


def _search(scene: Scene, accuracy: Accuracy) -> Maximum:
    """First look, local search and check."""
    finer, part_of = split_at_breakpoints(scene.cycle)
    split = replace(scene, cycle=finer)
    positions = positions_of_first_look(split.cycle, scene.coordinate)
    look = first_look(scene, positions.r, SCAN_RESOLUTION, SCAN_PLANES)
    climb = Climb.start(scene, split, part_of, look, positions, accuracy.search)
    largest_part = max(PART_SIZE // split.cycle.begin.shape[1] ** 2, 1)
    for turn in range(LARGEST_ROUND_COUNT):
        going = np.flatnonzero(~climb.settled)
        if not going.size:
            break
        parts = np.array_split(going, -(-going.size // largest_part))
        rounds = [climb_round(split, positions, climb.take(part), accuracy) for part in parts]
        moved = Climb.joined([climb.take(climb.settled), *(same for same, _ in rounds)])
        before = np.concatenate([climb.column[climb.settled], climb.column[going]])
        others = [other for _, other in rounds]
        climb = Climb.joined([moved.without_followers(moved.column != before), *others])
        climb = climb.leading(climb.top, SHARES[min(turn, len(SHARES) - 1)])
    # What is still on its way counts for what was seen of it.
    climb = climb.leading(np.where(climb.settled, climb.top, climb.seen), SHARES[-1])
    r = climb.brackets(positions).radius(climb.centre[:, None])
    value, angle = refine(
        split.select(climb.point, climb.hot), r, climb.side, climb.angle[:, None], accuracy.check
    )
    order = np.lexsort((-value[:, 0], climb.point))
    best = order[np.unique(climb.point[order], return_index=True)[1]]
    swt = value[best, 0]
    error = np.abs(swt - climb.top[best]) + climb.remaining[best]
    # Nothing finer than this was looked at.
    error = np.maximum(error, LEAST_SHARE * accuracy.tolerance * swt)
    return Maximum(swt, error, climb.side[best] * r[best, 0], angle[best, 0])
