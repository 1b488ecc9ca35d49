"""The maximum of swt over the whole body and all planes: the surface line's assumptions left out.

Positions are (r, θ, z): x = r cos θ, y = r sin θ. The cusps of swt lie on circles r = const about the axis,
and y → −y is a symmetry, so that 0 ≤ θ ≤ π holds every value.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.body.body import (
    Body,
    Spells,
    TimeNodes,
    closer_nodes,
    decisive_spells,
    time_nodes,
    together,
)
from swtstudy.mechanics.planes.all_planes import CriticalPlane
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: Steps of the time nodes on a stretch: first look and climb, and value. Half or twice the first: no change
#: in 16 values of bodies; half the second: 9e-7; twice: 7e-6, as half of `INSTANTS`; the same time.
LOOK, VALUE = 3, 5
#: Cells of a profile that is not a paraboloid and of each growth, while searching and for the value. Half or
#: twice the first: no change in 16 values of bodies; half the second: 2e-5; twice: 2e-6, the same time.
CELLS, VALUE_CELLS = 16, 60
#: Places of the first look: radii besides the cusps, angles, and depths in the largest contact radius. Half
#: of any of them: no change in four bodies, no faster.
BETWEEN = 12
ANGLES = np.linspace(0.0, np.pi, 9)
DEPTHS = np.array([0.0, 0.01, 0.05, 0.15, 0.4, 0.9])
#: Radii and a depth besides, in the largest contact radius, with a bulk stress: its tension is everywhere.
BEYOND, BENEATH = np.array([1.5, 4.0]), 2.5
#: First steps of a climb, in the largest contact radius, rad, and that radius. Half or twice: 4e-9.
FIRST_STEPS = np.array([0.03, 0.15, 0.02])
#: Places of the first look to climb from. One or six: no change in four bodies, the same time.
SUMMITS = 3
#: Places below this share of the highest in the first look are not climbed from; nor those below the second
#: share once their instants resolve the cycle, nor further below the third. None climbed: 6e-9 in four.
PROMISING, WORTHY, NEAR = 0.75, 0.9, 0.97
#: Rounds of a climb. Half: 6e-9 in four bodies, 15 % faster.
ROUNDS = 8
#: The search keeps so far from the edge of a flat face, in the largest contact radius, where a profile's
#: slope can be infinite; if the line's maximum is nearer, it may come almost as near.
RING = 1e-3
#: swt closer to that far from the contact than this is no more than that, relative, as for s.
SAME = 1e-9
#: The plane that a bulk stress alone makes critical.
_ALONG_X = np.array([1.0, 0.0, 0.0])


@dataclass(frozen=True)
class BodyMaximum:
    """Largest swt of the body.

    Attributes
    ----------
    swt
        Over E* δ0/R.
    position
        Shape (3,): x, y, z in a_H; x is infinite where swt is that of a bulk stress, far from the contact.
    normal
        Shape (3,): the critical plane's.
    """

    swt: float
    position: FloatArray
    normal: FloatArray


@dataclass(frozen=True)
class _Search:
    """Where the maximum is looked for.

    Attributes
    ----------
    scene
        A batch of one point.
    largest
        Largest contact radius of the cycle.
    ring
        Half the width of the ring around the edge of a flat face that is left out.
    """

    scene: Scene
    largest: float
    ring: float


def body_maximum(scene: Scene, line_x: float) -> tuple[BodyMaximum, CriticalPlane]:
    """Largest swt over the body, and swt over all planes at the surface line's critical point.

    Parameters
    ----------
    scene
        A batch of one point.
    line_x
        Signed x of the surface line's maximum; NaN where there is none, or far from the contact.

    Returns
    -------
    maximum, at_line
        The search starts from the highest places of a first look and from the line's own maximum.
    """
    largest = float(scene.largest_radius[0])
    far = _far_field(scene)
    line_is_far = not np.isfinite(line_x)
    line_x = largest if line_is_far else line_x
    own = np.array([abs(line_x), 0.0 if line_x >= 0.0 else np.pi, 0.0])
    flat = float(scene.profile.flat_radius[0])
    search = _Search(scene, largest, min(RING * largest, 0.9 * abs(own[0] - flat)))
    place = _climb(search, np.concatenate([own[None], _first_look(search, own)]))
    both = np.stack([place, own])
    distinct = both[: 1 + bool(np.any(place != own))]
    nodes = together(scene, *(_closer(scene, one, looks=3)[0] for one in distinct))
    swt, normal = Body(scene, nodes, VALUE_CELLS).swt(*_cartesian(both))
    best = int(swt[1] >= swt[0])
    found = BodyMaximum(float(swt[best]), np.array(_cartesian(both[best])), normal[best])
    if far > 0.0 and far >= (1.0 - SAME) * found.swt:
        found = BodyMaximum(far, np.array([np.inf, 0.0, 0.0]), _ALONG_X)
    at_line = CriticalPlane(np.array(far), _ALONG_X) if line_is_far else CriticalPlane(swt[1], normal[1])
    return found, at_line


def _far_field(scene: Scene) -> float:
    """swt of the bulk stress alone, 0 without one."""
    if scene.bulk is None:
        return 0.0
    far, _ = scene.bulk.far_field(scene.poisson_ratio, scene.criterion, scene.profile.plane)
    return float(far[0])


def _closer(scene: Scene, place: FloatArray, looks: int) -> tuple[TimeNodes, Spells]:
    """Instants that resolve the extremes over the cycle at one place, and the parts of it that matter."""
    point = tuple(float(v) for v in _cartesian(place))
    nodes = time_nodes(scene, VALUE, place[:1])
    spells = decisive_spells(Body(scene, nodes, CELLS), nodes, point)
    return closer_nodes(scene, spells.of(nodes), point, CELLS, looks), spells


def _first_look(search: _Search, own: FloatArray) -> FloatArray:
    """The highest places of a grid that are not close to one another or to ``own``, shape (k, 3)."""
    scene, largest = search.scene, search.largest
    radii, depths = _radii(scene, largest), largest * DEPTHS
    if scene.bulk is not None:
        radii, depths = np.append(radii, largest * BEYOND), np.append(depths, largest * BENEATH)
    angles = ANGLES[[0, -1]] if scene.profile.plane else ANGLES
    grid = np.stack(np.meshgrid(radii, angles, depths, indexing="ij"), axis=-1).reshape(-1, 3)
    grid = _off_ring(search, grid)
    swt = Body(scene, time_nodes(scene, LOOK), CELLS).coarse_swt(*_cartesian(grid))
    chosen = [own]
    for place in grid[np.argsort(-swt)][: np.count_nonzero(swt >= PROMISING * swt.max())]:
        apart = np.abs(place - np.array(chosen)) > [0.1 * largest, 0.5, 0.1 * largest]
        if apart.any(axis=1).all():
            chosen.append(place)
        if len(chosen) > SUMMITS:
            break
    return np.array(chosen[1:]).reshape(-1, 3)


def _radii(scene: Scene, largest: float) -> FloatArray:
    """Distances from the axis of the first look: ends of the memory's pieces and edges, and in between."""
    cycle, profile = scene.cycle, scene.profile
    start = cycle.memory.start[np.isfinite(cycle.memory.start)]
    turns = np.maximum(np.concatenate([cycle.load.least_normal, cycle.load.largest_normal]), 0.0)
    cusps = scene.coordinate.radius(np.unique(np.concatenate([start, turns]))[None])[0]
    b = float(profile.flat_radius[0])
    between = b + (largest - b) * np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, BETWEEN))
    rest = np.concatenate([b * np.array([0.0, 0.5, 0.95]), largest * np.array([1.03, 1.15])])
    return np.unique(np.round(np.concatenate([cusps, between, rest]), 12))


def _climb(search: _Search, places: FloatArray) -> FloatArray:
    """The highest of the summits to which a pattern search leads from each of the places, shape (3,)."""
    resolved = [_closer(search.scene, place, looks=1) for place in places]
    height = np.array(
        [
            Body(search.scene, nodes, CELLS).swt(*_cartesian(place)).swt
            for (nodes, _), place in zip(resolved, places, strict=True)
        ]
    )
    best, highest = places[0], float(height[0])
    for start in np.argsort(-height):
        if height[start] < WORTHY * highest:
            break
        nodes, spells = resolved[start]
        summit, swt = _climb_from(search, places[start], nodes, spells, highest)
        if swt > highest * (1.0 + 1e-9):
            best, highest = summit, swt
    return best


def _climb_from(
    search: _Search, place: FloatArray, sharp: TimeNodes, spells: Spells, rival: float
) -> tuple[FloatArray, float]:
    """Pattern search from one place, given up when it stays below a rival: a summit and its swt."""
    stencil = np.stack(np.meshgrid(*([-1.0, 0.0, 1.0],) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    scene = search.scene
    # In the plane all is in the section.
    steps = FIRST_STEPS * np.array([search.largest, 0.0 if scene.profile.plane else 1.0, search.largest])
    height = 0.0
    for _ in range(ROUNDS):
        trial = _off_ring(search, _folded(place + steps * stencil))
        # Reflection maps trials onto one another where the place is on the line or on the surface.
        trial = np.unique(np.round(np.concatenate([place[None], trial]), 12), axis=0)
        # The trials have three radii, at each of which the stress has its own cusps in time.
        aligned = time_nodes(scene, LOOK, np.unique(trial[:, 0]))
        nodes = together(scene, sharp, spells.of(aligned))
        swt = Body(scene, nodes, CELLS).swt(*_cartesian(trial)).swt
        here = int(np.abs(trial - place).max(axis=1).argmin())
        best = int(swt.argmax())
        if swt[best] <= swt[here] * (1.0 + 1e-9):
            steps = 0.4 * steps
        else:
            place = trial[best]
        height = float(swt[best])
        if height < NEAR * rival:
            break
    return place, height


def _off_ring(search: _Search, places: FloatArray) -> FloatArray:
    """Places moved away from the edge of a flat face."""
    b, near = float(search.scene.profile.flat_radius[0]), search.ring
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


def _cartesian(places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    r, angle, z = np.moveaxis(places, -1, 0)
    # sin π is not 0 in floating point: keep the line y = 0 a line.
    y = np.where(np.sin(angle) < 1e-9, 0.0, r * np.sin(angle))
    return r * np.cos(angle), y, z
