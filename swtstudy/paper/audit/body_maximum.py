"""The maximum of swt over the whole body and all planes: the surface line's assumptions left out.

Positions are (r, θ, z): x = r cos θ, y = r sin θ. The cusps of swt lie on circles r = const about the axis,
and y → −y is a symmetry, so that 0 ≤ θ ≤ π holds every value.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from swtstudy.kernel.field import (
    MANY,
    Opened,
    criterion_at,
    far_field_of,
    largest_radius,
    open_cycle,
    passed_radii,
)
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


class _Search(NamedTuple):
    """The load cycle of one point, its largest contact radius, and half the ring that is left out."""

    opened: Opened
    largest: float
    ring: float


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
    opened = open_cycle(**arguments_of(points))
    largest, far = largest_radius(opened), far_field_of(opened)
    line_is_far = not np.isfinite(line_x)
    line_x = largest if line_is_far else line_x
    own = np.array([abs(line_x), 0.0 if line_x >= 0.0 else np.pi, 0.0])
    flat = float(opened.profile["flat_radius"])
    search = _Search(opened, largest, min(RING * largest, 0.9 * abs(own[0] - flat)))
    place, highest = own, 0.0
    for one in (own, *_first_look(search, own)):
        summit, height = _climb_from(search, one, highest)
        if height > (1.0 + ROUNDING) * highest:
            place, highest = summit, height
    at_line, found = (_maximum_at(opened, _cartesian(each)) for each in (own, place))
    found = found if at_line.swt < found.swt else at_line
    from_far = BodyMaximum(far, np.array([np.inf, 0.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    if far > 0.0 and far >= (1.0 - FAR) * found.swt:
        found = from_far
    return found, from_far if line_is_far else at_line


def _maximum_at(opened: Opened, place: FloatArray) -> BodyMaximum:
    """swt over all planes at one place, and its critical plane."""
    swt, _, normal = criterion_at(opened, place[None], VALUE)
    return BodyMaximum(float(swt[0]), place, normal[0])


def _first_look(search: _Search, own: FloatArray) -> FloatArray:
    """The highest places of a grid that are not close to one another or to ``own``, shape (k, 3)."""
    opened, largest = search.opened, search.largest
    # Distances from the axis: ends of the memory's pieces and edges, and in between.
    b = float(opened.profile["flat_radius"])
    between = b + (largest - b) * np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, BETWEEN))
    rest = np.concatenate([b * np.array([0.0, 0.5, 0.95]), largest * np.array([1.03, 1.15])])
    passed = passed_radii(opened, MOST_CUSPS)
    radii = np.unique(np.round(np.concatenate([passed, between, rest]), 12))
    depths = largest * DEPTHS
    if opened.load["bulk_range"].any():
        radii, depths = np.append(radii, largest * BEYOND), np.append(depths, largest * BENEATH)
    angles = ANGLES[[0, -1]] if opened.profile["plane"] else ANGLES
    grid = np.stack(np.meshgrid(radii, angles, depths, indexing="ij"), axis=-1).reshape(-1, 3)
    grid = _off_ring(search, grid)
    highest = float(criterion_at(opened, _cartesian(own[None]), SEARCH)[0][0])
    swt = criterion_at(opened, _cartesian(grid), LOOK, PROMISING * highest, MANY)[0]
    chosen = [own]
    for place in grid[np.argsort(-swt)][: np.count_nonzero(swt >= PROMISING * swt.max())]:
        apart = np.abs(place - np.array(chosen)) > [0.1 * largest, 0.5, 0.1 * largest]
        if apart.any(axis=1).all():
            chosen.append(place)
        if len(chosen) > SUMMITS:
            break
    return np.array(chosen[1:]).reshape(-1, 3)


def _climb_from(search: _Search, place: FloatArray, rival: float) -> tuple[FloatArray, float]:
    """Pattern search from one place, given up when it stays below a rival: a summit and its swt."""
    stencil = np.stack(np.meshgrid(*([-1.0, 0.0, 1.0],) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    opened = search.opened
    # In the plane all is in the section.
    across = 0.0 if opened.profile["plane"] else 1.0
    steps = FIRST_STEPS * np.array([search.largest, across, search.largest])
    height, width = 0.0, 1.0
    while width > LAST_WIDTH:
        trial = _off_ring(search, _folded(place + width * steps * stencil))
        # Reflection maps trials onto one another where the place is on the line or on the surface.
        trial = np.unique(np.round(np.concatenate([place[None], trial]), 12), axis=0)
        swt = criterion_at(opened, _cartesian(trial), SEARCH, LEFT_OUT * height, MANY)[0]
        here, best = int(np.abs(trial - place).max(axis=1).argmin()), int(swt.argmax())
        if swt[best] > (1.0 + GAIN) * max(swt[here], height):
            place, width = trial[best], WALKING * width
        else:
            width *= SHRINKING
        height = max(height, float(swt[best]))
        if height < NEAR * rival:
            break
    return place, height


def _off_ring(search: _Search, places: FloatArray) -> FloatArray:
    """Places moved away from the edge of a flat face."""
    b, near = float(search.opened.profile["flat_radius"]), search.ring
    if b == 0.0:
        return places
    offset = places[..., 0] - b
    r = np.where(np.abs(offset) < near, b + np.where(offset < 0.0, -near, near), places[..., 0])
    return np.concatenate([r[..., None], places[..., 1:]], axis=-1)


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
