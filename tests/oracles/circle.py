"""swt on the circle through a place of the surface line, over all planes, by plain grids.

Traction in x that is the same all around the axis makes stresses of cos θ and cos 3θ at the surface: those on
the line tell them on the circle. They come from `oracles.line`; angles, planes and instants are plain grids,
and finer ones about the highest.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from oracles.line import Line, _intervals, _largest, _positions

Array = NDArray[np.float64]
#: First look: angles of half a circle, which the other half mirrors, planes, and steps of an interval.
ANGLES, PLANES, STEPS = np.linspace(0.0, np.pi, 61), 2000, 10
#: Peaks and planes above this share of the highest are looked at more closely, in rounds of ever finer grids.
SHARE, ROUNDS, NARROWER, CLOSER_STEPS = 0.97, 12, 0.55, 30
#: Other planes than the best one differ from it by so much, rad.
APART = 0.3
#: Places so near to a cusp, over the largest radius, are on it: chords move it by as much.
SNAP = 1e-7


def circle_s(arguments: Mapping[str, Any], x: float) -> tuple[float, float]:
    """Largest swt on the circle of radius |x|, and the angle from the x-axis at which it is, rad."""
    line = Line(arguments)
    if line.profile.strip:
        raise ValueError("a plane contact has no circle")
    r = np.array([abs(x)])
    intervals = _intervals(line.course, 600, float(line.coordinate(r)[0]), 1e-3)
    _, cusps = _positions(line, intervals)
    nearest = cusps[np.abs(cusps - r).argmin()]
    r = np.where(np.abs(nearest - r) <= SNAP * cusps[-1], nearest, r)
    coarse, fine = (line.stress(intervals, r, count) for count in (STEPS, CLOSER_STEPS))
    planes = hemisphere(PLANES)
    values = np.array([on_planes(line, turned(line, coarse, angle), planes, False) for angle in ANGLES])
    tops = np.pad(values.max(axis=1), 1, constant_values=-1.0)
    is_peak = (tops[1:-1] >= tops[:-2]) & (tops[1:-1] >= tops[2:]) & (tops[1:-1] > SHARE * tops.max())
    found = [(0.0, 0.0)]
    for k in np.flatnonzero(is_peak):
        for normal in high_planes(values[k], planes):
            angle, step, turn, best = ANGLES[k], ANGLES[1], 0.08, (0.0, 0.0)
            for _ in range(ROUNDS):
                normals = about(normal, turn)
                angles = angle + step * np.linspace(-1.0, 1.0, 9)
                closer = [on_planes(line, turned(line, fine, each), normals, True) for each in angles]
                i, j = np.unravel_index(np.argmax(closer), np.shape(closer))
                best, angle, normal = (float(closer[i][j]), float(angles[i])), angles[i], normals[j]
                step, turn = NARROWER * step, NARROWER * turn
            found.append(best)
    return max(found)


def turned(line: Line, stress: Array, angle: float) -> Array:
    """Stress at an angle from x, of that on the line: σ_xx, σ_yy, σ_zz, σ_yz, σ_xz, σ_xy, shape (6, X, J, C).

    σ_xx = (2 + ν/2) P cos θ − R cos 3θ, σ_yy = (3ν/2) P cos θ + R cos 3θ and σ_xy = (1 − ν/2) P sin θ −
    R sin 3θ are Cerruti's solution at the surface, summed over traction that depends on the radius alone.
    """
    ν = line.ν
    xx, yy, zz, pulled_xx, pulled_yy, xz = stress
    bulk = xx + yy - (1.0 + 2.0 * ν) * zz
    radial, c, s = xx - bulk, np.cos(angle), np.sin(angle)
    P = (pulled_xx + pulled_yy) / (2.0 * (1.0 + ν))
    R = pulled_yy - 1.5 * ν * P
    c3, s3 = np.cos(3.0 * angle), np.sin(3.0 * angle)
    return np.stack(
        [
            bulk + radial * c * c + yy * s * s + (2.0 + 0.5 * ν) * P * c - R * c3,
            radial * s * s + yy * c * c + 1.5 * ν * P * c + R * c3,
            zz,
            np.zeros_like(zz),
            xz,
            (radial - yy) * s * c + (1.0 - 0.5 * ν) * P * s - R * s3,
        ]
    )


def on_planes(line: Line, stress: Array, normals: Array, smooth: bool) -> Array:
    """swt of a history of one place, shape (6, 1, J, C), on planes, shape (m,)."""
    if line.criterion != "swt":
        raise ValueError("criteria of shear ask for chords of the shear stress")
    nx, ny, nz = normals.T
    weights = np.stack([nx * nx, ny * ny, nz * nz, 2.0 * ny * nz, 2.0 * nx * nz, 2.0 * nx * ny], axis=-1)
    normal = np.tensordot(weights, stress[:, 0], axes=1)
    strain = (1.0 + line.ν) * normal - line.ν * stress[:3, 0].sum(axis=0)
    tension, up, down = (_largest(each, smooth) for each in (normal, strain, -strain))
    return line._value(tension, 0.5 * (up + down))


def hemisphere(count: int) -> Array:
    """Unit normals that cover a half sphere evenly, shape (count, 3)."""
    k = np.arange(count) + 0.5
    z, turn = 1.0 - k / count, np.pi * (1.0 + np.sqrt(5.0)) * k
    return np.stack([np.sqrt(1.0 - z * z) * np.cos(turn), np.sqrt(1.0 - z * z) * np.sin(turn), z], axis=-1)


def high_planes(values: Array, planes: Array) -> list[Array]:
    """The best plane, and the best one of those that are far from it if that is nearly as good."""
    best = planes[values.argmax()]
    far = np.where(np.abs(planes @ best) < np.cos(APART), values, -1.0)
    return [best, planes[far.argmax()]] if far.max() > SHARE * values.max() else [best]


def about(normal: Array, turn: float) -> Array:
    """Normals on a grid about one of them, shape (81, 3)."""
    first = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    first /= np.linalg.norm(first)
    grid = np.stack(np.meshgrid(*(turn * np.linspace(-1.0, 1.0, 9),) * 2), axis=-1).reshape(-1, 2)
    normals = normal + grid @ np.stack([first, np.cross(normal, first)])
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))
