"""The local search, which knows that the largest of several maxima has kinks where these change places.

s is the largest of many local maxima, over points, planes and instants, each of which depends smoothly on the
parameters. Its least value is mostly in a kink, where some of them are equal: there a descent along gradients
zigzags and a simplex collapses. Planes through the values and gradients at several points around are below
all of the maxima nearby, and the lowest point of the highest plane is the kink (a bundle method). Where the
function is smooth, Newton's step with the same gradients is the better one: both are tried.
"""

from __future__ import annotations

from collections.abc import Generator

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.results.optimum.planes import Planes, lowest_of, newton, planes_from, probes

#: Where the search begins and where it ends, as a distance in the unit cube. At the end a kink of the slope 1
#: is known to 1e-5, and mostly far better: planes miss it by the square of the distance.
_FIRST, _LAST = 0.05, 1e-5
#: The distance is multiplied by this where the best point has hardly moved; 0.35 takes a fifth fewer points,
#: and leaves 2e-3 of a random kink of five parameters instead of 3e-4.
_SHRINK = 0.5
#: It has moved, if by more than this fraction of the distance.
_MOVED = 0.5
#: Planes in a round for each parameter: all that meet in a kink have to be found sooner or later.
_EACH = 2
#: Planes that count are so many distances away at most.
_NEAR = 2.0
#: Rounds at most: 13 halve the distance to its end, 30 more were enough on every valley tried.
_ROUNDS = 60


def polish(start: FloatArray, value: float, seed: int) -> Generator[FloatArray, FloatArray, None]:
    """Search for the least value near a point: yields points, shape (n, d), and is sent their values, (n,).

    Parameters
    ----------
    start, value
        The point, shape (d,), in the unit cube, and the value there.
    seed
        Seed of the random points at which planes are found.
    """
    rng = np.random.default_rng(seed)
    best, distance, dimensions = start, _FIRST, len(start)
    known = Planes.none(dimensions)
    for _ in range(_ROUNDS):
        around = best + distance * rng.uniform(-1.0, 1.0, (_EACH * dimensions, dimensions))
        around = np.clip(around, 0.0, 1.0)
        found = planes_from(around, distance, (yield probes(around, distance)))
        known = Planes.joined([known, found]).within(best, _NEAR * distance)
        moved = 0.0
        if len(known):
            steps = np.array([*lowest_of(known, best, value, distance), newton(known, best, distance)])
            points = np.concatenate([known.points, steps])
            values = np.append(known.values, (yield steps))
            lowest = int(values.argmin())
            if values[lowest] < value:
                moved = float(np.abs(points[lowest] - best).max())
                best, value = points[lowest], float(values[lowest])
        if moved < _MOVED * distance:
            distance *= _SHRINK
        if distance < _LAST:
            return
