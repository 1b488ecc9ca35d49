"""A dense grid over the surface line: every position, plane and instant, without a search.

The grid shares with the search the stress history and the places of the cusps, and nothing else: every
position has every plane at all instants, and the highest ones once more on closer grids. Its result is
there: s must not be less.
"""

from __future__ import annotations

import numpy as np

from swtstudy.kernel.dense import highest_on_planes
from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points
from swtstudy.vocabulary.arrays import FloatArray

#: How often the four intervals of each smooth part of the cycle are halved, at first and in the first closer
#: grid; each further one halves them once more.
HALVED, CLOSER_HALVED = 1, 2
#: Local maxima that get closer grids: so many, and this share of the highest. Each time so many places and
#: planes about the best ones, NARROWER from one time to the next, until one stays below the share LOW.
KEPT, HIGH, ROUNDS, CLOSER, NARROWER, LOW = 8, 0.9, 5, 17, 0.25, 0.98
#: Pieces shorter than this share of the range are none.
NO_LENGTH = 1e-13


def dense_maximum(points: Points, steps: int = 400, planes: int = 64) -> tuple[float, float]:
    """Largest value of the criterion on the surface line, and signed x/a_H there, of a batch of one point.

    Parameters
    ----------
    points
        A batch of one point.
    steps
        Cosine-spaced steps of each piece between two cusps.
    planes
        Planes through y, evenly spaced.
    """
    cycle = LoadCycle(points)
    ends = cycle.cusps()
    ends = ends[np.append(np.diff(ends) > NO_LENGTH * np.ptp(ends), True)]
    share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps))
    places = np.append(ends[:-1, None] + np.diff(ends)[:, None] * share, ends[-1])
    turn = 2.0 * np.pi / planes
    values, angles = _highest(cycle, places, np.asarray(turn * np.arange(planes)), HALVED)
    found: list[tuple[float, int, int]] = []
    for side in range(2):
        framed = np.pad(values[:, side], 1, constant_values=-1.0)
        peak = (framed[1:-1] > framed[:-2]) & (framed[1:-1] >= framed[2:])
        found += [(float(values[k, side]), side, int(k)) for k in np.flatnonzero(peak)]
    found.sort(reverse=True)
    best, position = 0.0, np.nan
    for height, side, k in found[:KEPT]:
        if height >= HIGH * found[0][0]:
            around = places[[max(k - 2, 0), k, min(k + 2, places.size - 1)]]
            closer = _closer(cycle, ends, around, side, float(angles[k, side]), turn, LOW * best)
            best, position = max((best, position), closer)
    return best, position


def _highest(
    cycle: LoadCycle, places: FloatArray, angles: FloatArray, halved: int
) -> tuple[FloatArray, FloatArray]:
    """Largest value at each place over the planes at 2θ, at x > 0 and x < 0, and 2θ there, each (X, 2)."""
    of_cycle = cycle.cycle, cycle.growth, cycle.profile, cycle.tables, cycle.load, cycle.ask
    found = np.empty((len(places), 2, 2))
    grid = places, np.cos(angles), np.sin(angles), np.int64(halved)
    highest_on_planes(cycle.history, cycle.work, *of_cycle, cycle.largest, *grid, found)
    return found[..., 0], angles[found[..., 1].astype(np.intp)]


def _closer(
    cycle: LoadCycle, ends: FloatArray, around: FloatArray, side: int, angle: float, turn: float, least: float
) -> tuple[float, float]:
    """The largest value near a place, and signed x there, on ever closer grids.

    Parameters
    ----------
    ends
        Shape (k,): the cusps, which are places themselves.
    around
        Shape (3,): from where, about which place and up to where the first grid goes.
    """
    best, position = 0.0, np.nan
    down, up = np.diff(around)
    centre, half = around[1], CLOSER // 2 + 1
    for closer in range(ROUNDS):
        low, high = max(centre - down, ends[0]), min(centre + up, ends[-1])
        within = ends[(ends > low) & (ends < high)]
        places = np.concatenate([np.linspace(low, centre, half), np.linspace(centre, high, half), within])
        places = np.unique(places)
        tried = angle + turn * np.linspace(-1.0, 1.0, CLOSER)
        values, angles = (of[:, side] for of in _highest(cycle, places, tried, CLOSER_HALVED + closer))
        k = int(values.argmax())
        if values[k] > best:
            best, position = float(values[k]), (1.0 - 2.0 * side) * float(cycle.radius(places[k]))
        centre, angle = places[k], float(angles[k])
        if best < least:
            break
        down, up, turn = NARROWER * down, NARROWER * up, NARROWER * turn
    return best, position
