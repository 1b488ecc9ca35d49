"""The maximum of swt over the whole body and all planes: the surface line's assumptions left out.

Positions are (r, θ, z): x = r cos θ, y = r sin θ. The cusps of swt lie on circles r = const about the axis, and
y → −y is a symmetry, so that 0 ≤ θ ≤ π holds every value.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.body import Body, time_nodes
from swtstudy.mechanics.critical_plane_3d import CriticalPlane
from swtstudy.mechanics.maximum import scan_positions
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Scene

#: Steps of the time nodes on a stretch: first look, climb, and value.
_LOOK, _CLIMB, _VALUE = 3, 4, 12
#: Cells of a profile that is not a paraboloid: stresses to about 1e-6 p0.
_CELLS = 60
_ANGLES = np.linspace(0.0, np.pi, 9)
#: In the largest contact radius.
_DEPTHS = np.array([0.0, 0.003, 0.01, 0.03, 0.1, 0.25, 0.5, 0.9])
_FIRST_STEPS = np.array([0.03, 0.15, 0.02])
_SUMMITS = 4
#: Places below this share of the highest in the first look are not climbed from.
_PROMISING = 0.75
_ROUNDS = 14


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
    starts = np.concatenate([own[None], _first_look(scene, largest)])
    place = _climb(scene, np.concatenate([starts, _vicinity(own, largest)]), largest)
    final = Body.of(scene, time_nodes(scene, _VALUE, np.unique([place[0], own[0]])), 2 * _CELLS)
    both = final.swt(*_cartesian(np.stack([place, own])))
    at_line = CriticalPlane(both.swt[1], both.normal[1])
    best = int(both.swt[1] >= both.swt[0])
    position = np.array(_cartesian(np.stack([place, own])[best]))
    return BodyMaximum(float(both.swt[best]), position, both.normal[best]), at_line


def _first_look(scene: Scene, largest: float) -> FloatArray:
    """The highest places of a grid, not more than `_SUMMITS`, shape (k, 3)."""
    b = float(scene.profile.flat_radius[0])
    r = np.concatenate([scan_positions(scene)[0], b * np.array([0.0, 0.5, 0.95]), largest * np.array([1.03, 1.15])])
    grid = np.stack(np.meshgrid(np.unique(r), _ANGLES, largest * _DEPTHS, indexing="ij"), axis=-1)
    places = grid.reshape(-1, 3)
    body = Body.of(scene, time_nodes(scene, _LOOK), _CELLS)
    swt = body.coarse_swt(*_cartesian(places))
    chosen: list[int] = []
    for index in np.argsort(-swt):
        far = all(
            (np.abs(places[index] - places[other]) > [0.1 * largest, 0.5, 0.1 * largest]).any()
            for other in chosen
        )
        if swt[index] < _PROMISING * swt.max() or len(chosen) == _SUMMITS:
            break
        if far:
            chosen.append(int(index))
    return places[chosen]


def _vicinity(own: FloatArray, largest: float) -> FloatArray:
    """Places close to the line's maximum, off the line and beneath it."""
    away = [[0.0, angle, 0.0] for angle in (1e-3, 1e-2, 0.1)]
    deep = [[0.0, 0.0, depth * largest] for depth in (1e-4, 1e-3, 1e-2)]
    return _folded(own + np.array(away + deep))


def _climb(scene: Scene, places: FloatArray, largest: float) -> FloatArray:
    """Pattern search from several places at once; the highest of the summits, shape (3,)."""
    stencil = np.stack(np.meshgrid(*([-1.0, 0.0, 1.0],) * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    steps = np.tile(_FIRST_STEPS * np.array([largest, 1.0, largest]), (len(places), 1))
    for _ in range(_ROUNDS):
        trial = _folded(places[:, None] + steps[:, None] * stencil)
        # Nearby radii share the aligned instants of the place in their midst.
        body = Body.of(scene, time_nodes(scene, _CLIMB, np.unique(places[:, 0])), _CELLS)
        swt = body.swt(*_cartesian(trial)).swt
        best = swt.argmax(axis=1)
        row = np.arange(len(places))
        stays = swt[row, best] <= swt[:, len(stencil) // 2] * (1.0 + 1e-9)
        places = np.where(stays[:, None], places, trial[row, best])
        steps[stays] *= 0.4
        highest = swt[row, best]
        keep = highest >= (0.9 if _ == 0 else 0.97) * highest.max()
        places, steps = places[keep], steps[keep]
    return places[np.argmax(highest[keep])]


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
