"""The maximum of swt over the whole body and all planes: the surface line's assumptions left out.

Positions are (r, θ, z): x = r cos θ, y = r sin θ. The cusps of swt lie on circles r = const about the axis,
and y → −y is a symmetry, so that 0 ≤ θ ≤ π holds every value.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.body import Body, TimeNodes, closer_nodes, time_nodes, together
from swtstudy.mechanics.critical_plane_3d import CriticalPlane
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Scene

#: Steps of the time nodes on a stretch: first look, climb, and value.
_LOOK, _CLIMB, _VALUE = 3, 3, 5
#: Cells of a profile that is not a paraboloid: stresses to about 1e-6 p0.
_CELLS = 60
#: Places of the first look: radii besides the cusps, angles, and depths in the largest contact radius.
_BETWEEN = 20
_ANGLES = np.linspace(0.0, np.pi, 9)
_DEPTHS = np.array([0.0, 0.003, 0.01, 0.03, 0.1, 0.25, 0.5, 0.9])
_FIRST_STEPS = np.array([0.03, 0.15, 0.02])
_SUMMITS = 4
#: Places below this share of the highest in the first look are not climbed from.
_PROMISING = 0.75
_ROUNDS = 9
#: The search keeps so far from the edge of a flat face, in the largest contact radius.
_RING = 1e-3


@dataclass(frozen=True)
class BodyMaximum:
    """Largest swt of the body.

    Attributes
    ----------
    swt
        Over E* δ0/R.
    position
        Shape (3,): x, y, z in a_H.
    normal
        Shape (3,): the critical plane's.
    """

    swt: float
    position: FloatArray
    normal: FloatArray


def body_maximum(scene: Scene, line_x: float) -> tuple[BodyMaximum, CriticalPlane]:
    """Largest swt over the body, and swt over all planes at the surface line's critical point.

    Parameters
    ----------
    scene
        A batch of one point.
    line_x
        Signed x of the surface line's maximum.

    Returns
    -------
    maximum, at_line
        The search starts from the highest places of a first look and from the line's own maximum.
    """
    largest = float(scene.profile.radius(1.0 + scene.cycle.protocol.normal_amplitude[:, None])[0, 0])
    own = np.array([abs(line_x), 0.0 if line_x >= 0.0 else np.pi, 0.0])
    # What makes swt at the line's maximum makes it nearby, too: these instants serve the whole search.
    sharp = _closer(scene, own, looks=1)
    starts = np.concatenate([own[None], _first_look(scene, largest), _vicinity(own, largest)])
    place = _climb(scene, starts, largest, sharp)
    both = np.stack([place, own])
    final = Body.of(
        scene, together(scene, _closer(scene, own, looks=3), _closer(scene, place, looks=3)), 2 * _CELLS
    )
    swt, normal = final.swt(*_cartesian(both))
    best = int(swt[1] >= swt[0])
    position = np.array(_cartesian(both[best]))
    return BodyMaximum(float(swt[best]), position, normal[best]), CriticalPlane(swt[1], normal[1])


def _closer(scene: Scene, place: FloatArray, looks: int) -> TimeNodes:
    """Instants that resolve the extremes over the cycle at one place."""
    x, y, z = (float(v) for v in _cartesian(place))
    return closer_nodes(scene, time_nodes(scene, _VALUE, place[:1]), (x, y, z), _CELLS, looks)


def _first_look(scene: Scene, largest: float) -> FloatArray:
    """The highest places of a grid, not more than `_SUMMITS`, shape (k, 3)."""
    grid = np.stack(
        np.meshgrid(_radii(scene, largest), _ANGLES, largest * _DEPTHS, indexing="ij"), axis=-1
    ).reshape(-1, 3)
    grid = _off_ring(scene, grid, largest)
    swt = Body.of(scene, time_nodes(scene, _LOOK), _CELLS).coarse_swt(*_cartesian(grid))
    chosen: list[int] = []
    for index in np.argsort(-swt):
        if swt[index] < _PROMISING * swt.max() or len(chosen) == _SUMMITS:
            break
        apart = np.abs(grid[index] - grid[chosen]) > [0.1 * largest, 0.5, 0.1 * largest]
        if apart.any(axis=1).all():
            chosen.append(int(index))
    return grid[chosen]


def _radii(scene: Scene, largest: float) -> FloatArray:
    """Distances from the axis of the first look: ends of the memory's pieces and edges, and in between."""
    cycle, profile = scene.cycle, scene.profile
    start = cycle.memory.start[np.isfinite(cycle.memory.start)]
    turns = np.maximum(1.0 + cycle.protocol.normal_amplitude[0] * np.array([-1.0, 1.0]), 0.0)
    cusps = profile.radius(np.unique(np.concatenate([start, turns]))[None])[0]
    b = float(profile.flat_radius[0])
    between = b + (largest - b) * np.sin(0.5 * np.pi * np.linspace(0.0, 1.0, _BETWEEN))
    rest = np.concatenate([b * np.array([0.0, 0.5, 0.95]), largest * np.array([1.03, 1.15])])
    return np.unique(np.round(np.concatenate([cusps, between, rest]), 12))


def _vicinity(own: FloatArray, largest: float) -> FloatArray:
    """Places close to the line's maximum, off the line and beneath it."""
    away = [[0.0, angle, 0.0] for angle in (1e-3, 1e-2, 0.1)]
    deep = [[0.0, 0.0, depth * largest] for depth in (1e-4, 1e-3, 1e-2)]
    return _folded(own + np.array(away + deep))


def _climb(scene: Scene, places: FloatArray, largest: float, sharp: TimeNodes) -> FloatArray:
    """Pattern search from several places at once; the highest of the summits, shape (3,)."""
    stencil = np.stack(np.meshgrid(*([-1.0, 0.0, 1.0],) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    steps = np.tile(_FIRST_STEPS * np.array([largest, 1.0, largest]), (len(places), 1))
    for turn in range(_ROUNDS):
        trial = _off_ring(scene, _folded(places[:, None] + steps[:, None] * stencil), largest)
        # Nearby radii share the aligned instants of the place in their midst.
        nodes = together(scene, sharp, time_nodes(scene, _CLIMB, np.unique(places[:, 0])))
        swt = Body.of(scene, nodes, _CELLS).swt(*_cartesian(trial)).swt
        best = swt.argmax(axis=1)
        row = np.arange(len(places))
        highest = swt[row, best]
        stays = highest <= swt[:, len(stencil) // 2] * (1.0 + 1e-9)
        places = trial[row, best]
        steps[stays] *= 0.4
        keep = highest >= (0.9 if turn == 0 else 0.97) * highest.max()
        places, steps, highest = places[keep], steps[keep], highest[keep]
    return places[np.argmax(highest)]


def _off_ring(scene: Scene, places: FloatArray, largest: float) -> FloatArray:
    """Places moved away from the edge of a flat face, where a profile's slope can be infinite."""
    b, near = float(scene.profile.flat_radius[0]), _RING * largest
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
    y = np.where((angle == 0.0) | (angle == np.pi), 0.0, r * np.sin(angle))
    return r * np.cos(angle), y, z
