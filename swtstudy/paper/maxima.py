"""The largest value of the criterion without the solver's search: over the whole body, and on a dense grid.

The body's maximum leaves out the surface line's assumptions. Positions are (r, θ, z): x = r cos θ,
y = r sin θ. The cusps of swt lie on circles r = const about the axis, and y → −y is a symmetry, so that
0 ≤ θ ≤ π holds every value.

The dense grid over the surface line shares with the search the stress history and the places of the cusps,
and nothing else: every position has every plane at all instants, and the highest ones once more on closer
grids. Its result is there: s must not be less.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swtstudy.kernel import field
from swtstudy.kernel.dense import highest_on_planes
from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import FloatArray

#: Relative tolerances of the first look, of climbs and of the value.
LOOK, SEARCH, VALUE = 1e-2, 1e-3, 1e-5
#: In a climb places below this share of the height are of no interest.
LEFT_OUT = 0.9
#: Places or angles nearer than this, relative or in rad, are the same.
ROUNDING = 1e-9
#: Where the bulk stress alone is as high as the body's maximum but for this share, it is the maximum.
FAR = 1e-6
#: Most radii of the first look at which edges and fronts turn.
MOST_CUSPS = 40
#: Places of the first look: radii besides the cusps, angles, and depths in the largest contact radius. Half
#: of any of them: no change in four bodies, no faster.
BETWEEN = 12
ANGLES = np.linspace(0.0, np.pi, 9)
DEPTHS = np.array([0.0, 0.01, 0.05, 0.15, 0.4, 0.9])
#: Radii and a depth besides, in the largest contact radius, with a bulk stress: its tension is everywhere.
BEYOND, BENEATH = np.array([1.5, 4.0]), 2.5
#: First steps of a climb, in the largest contact radius, rad, and that radius, and how they shrink.
FIRST_STEPS, SHRINKING = np.array([0.03, 0.15, 0.02]), 0.4
#: Places of the first look to climb from, and the share of the highest below which there is none. None
#: climbed: 6e-9 in four.
SUMMITS, PROMISING = 3, 0.75
#: A climb that stays below this share of another summit is given up.
NEAR = 0.97
#: A climb walks on with wider steps while they gain this share, and ends with steps so many times shorter.
GAIN, WALKING, LAST_WIDTH = 1e-5, 1.5, 5e-3
#: The search keeps so far from the edge of a flat face, in the largest contact radius, where a profile's
#: slope can be infinite; if the line's maximum is nearer, it may come almost as near.
RING = 1e-3


class BodyMaximum(NamedTuple):
    """Largest swt of the body, or swt at one of its places.

    Attributes
    ----------
    swt
        Over E* δ0/R.
    position
        Shape (3,): x, y, z in a_H; x is infinite where swt comes from a bulk stress, far from the contact.
    normal
        Shape (3,): the critical plane's.
    """

    swt: float
    position: FloatArray
    normal: FloatArray


def body_maximum(points: Points, line_x: float) -> tuple[BodyMaximum, BodyMaximum]:
    """Largest swt over the body, and swt over all planes at the surface line's critical point.

    Parameters
    ----------
    points
        A batch of one point.
    line_x
        Signed x of the surface line's maximum; NaN where there is none, or far from the contact.

    Returns
    -------
    maximum, at_line
        The search starts from the highest places of a first look and from the line's own maximum.
    """
    opened = field.open_cycle(**arguments_of(points))
    largest, far = field.largest_radius(opened), field.far_field_of(opened)
    line_is_far = not np.isfinite(line_x)
    line_x = largest if line_is_far else line_x
    own = np.array([abs(line_x), 0.0 if line_x >= 0.0 else np.pi, 0.0])
    ring = min(RING * largest, 0.9 * abs(own[0] - float(opened.point.profile["flat_radius"])))
    place, highest = own, 0.0
    for one in (own, *_first_look(opened, ring, own)):
        summit, height = _climb_from(opened, ring, one, highest)
        if height > (1.0 + ROUNDING) * highest:
            place, highest = summit, height
    at_line, found = (_maximum_at(opened, _cartesian(each)) for each in (own, place))
    found = found if at_line.swt < found.swt else at_line
    from_far = BodyMaximum(far, np.array([np.inf, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    if far > 0.0 and far >= (1.0 - FAR) * found.swt:
        found = from_far
    return found, from_far if line_is_far else at_line


def _maximum_at(opened: field.Opened, place: FloatArray) -> BodyMaximum:
    """swt over all planes at one place, and its critical plane."""
    swt, _, normal = field.criterion_at(opened, place[None], VALUE)
    return BodyMaximum(float(swt[0]), place, normal[0])


def _first_look(opened: field.Opened, ring: float, own: FloatArray) -> FloatArray:
    """The highest places of a grid that are not close to one another or to ``own``, shape (k, 3)."""
    # Distances from the axis: ends of the memory's pieces and edges, and in between.
    largest = field.largest_radius(opened)
    b = float(opened.point.profile["flat_radius"])
    between = b + (largest - b) * np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, BETWEEN))
    rest = np.concatenate([b * np.array([0.0, 0.5, 0.95]), largest * np.array([1.03, 1.15])])
    passed = field.passed_radii(opened, MOST_CUSPS)
    radii = np.unique(np.round(np.concatenate([passed, between, rest]), 12))
    depths = largest * DEPTHS
    if opened.point.load["bulk_range"].any():
        radii, depths = np.append(radii, largest * BEYOND), np.append(depths, largest * BENEATH)
    angles = ANGLES[[0, -1]] if opened.point.profile["plane"] else ANGLES
    grid = np.stack(np.meshgrid(radii, angles, depths, indexing="ij"), axis=-1).reshape(-1, 3)
    grid = _off_ring(opened, ring, grid)
    highest = float(field.criterion_at(opened, _cartesian(own[None]), SEARCH)[0][0])
    swt = field.criterion_at(opened, _cartesian(grid), LOOK, PROMISING * highest, field.MANY)[0]
    chosen = [own]
    for place in grid[np.argsort(-swt)][: np.count_nonzero(swt >= PROMISING * swt.max())]:
        apart = np.abs(place - np.array(chosen)) > [0.1 * largest, 0.5, 0.1 * largest]
        if apart.any(axis=1).all():
            chosen.append(place)
        if len(chosen) > SUMMITS:
            break
    return np.array(chosen[1:]).reshape(-1, 3)


def _climb_from(
    opened: field.Opened, ring: float, place: FloatArray, rival: float
) -> tuple[FloatArray, float]:
    """Pattern search from one place, given up when it stays below a rival: a summit and its swt."""
    stencil = np.stack(np.meshgrid(*([-1.0, 0.0, 1.0],) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    # In the plane all is in the section.
    across, largest = 0.0 if opened.point.profile["plane"] else 1.0, field.largest_radius(opened)
    steps = FIRST_STEPS * np.array([largest, across, largest])
    height, width = 0.0, 1.0
    while width > LAST_WIDTH:
        trial = _off_ring(opened, ring, _folded(place + width * steps * stencil))
        # Reflection maps trials onto one another where the place is on the line or on the surface.
        trial = np.unique(np.round(np.concatenate([place[None], trial]), 12), axis=0)
        swt = field.criterion_at(opened, _cartesian(trial), SEARCH, LEFT_OUT * height, field.MANY)[0]
        here, best = int(np.abs(trial - place).max(axis=1).argmin()), int(swt.argmax())
        if swt[best] > (1.0 + GAIN) * max(swt[here], height):
            place, width = trial[best], WALKING * width
        else:
            width *= SHRINKING
        height = max(height, float(swt[best]))
        if height < NEAR * rival:
            break
    return place, height


def _off_ring(opened: field.Opened, ring: float, places: FloatArray) -> FloatArray:
    """Places moved out of half a ring about the edge of a flat face."""
    b, r = float(opened.point.profile["flat_radius"]), places[..., 0]
    if b > 0.0:
        places = places.copy()
        places[..., 0] = np.where(np.abs(r - b) < ring, np.where(r < b, b - ring, b + ring), r)
    return places


def _folded(places: FloatArray) -> FloatArray:
    """Places mapped to r ≥ 0, 0 ≤ θ ≤ π, z ≥ 0 by the symmetry in y and by reflection."""
    r, angle, z = np.moveaxis(places, -1, 0)
    angle = np.where(r < 0.0, np.pi - angle, angle)
    angle = np.pi - np.abs(np.pi - np.mod(angle, 2.0 * np.pi))
    return np.stack([np.abs(r), angle, np.maximum(z, 0.0)], axis=-1)


def _cartesian(places: FloatArray) -> FloatArray:
    """x, y, z of places r, θ, z, along the last axis."""
    r, angle, z = np.moveaxis(places, -1, 0)
    # sin π is not 0 in floating point: keep the line y = 0 a line.
    y = np.where(np.sin(angle) < ROUNDING, 0.0, r * np.sin(angle))
    return np.stack([r * np.cos(angle), y, z], axis=-1)


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
    found = np.empty((len(places), 2, 2))
    grid = places, np.cos(angles), np.sin(angles), np.int64(halved)
    highest_on_planes(cycle.point, cycle.largest, *grid, found)
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
