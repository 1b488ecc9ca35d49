"""Samples of points whose s, or what comes with it, shows what the constants of the mechanics do."""

from __future__ import annotations

import numpy as np
from accuracy import points_at_ends, random_points

from swtstudy.mechanics import Points, solve_points
from swtstudy.mechanics.body import body_maximum, nonlocal_swt
from swtstudy.mechanics.stress.scene import scene_of

#: What each kind of sample takes points from: where, the profile, and one ratio p/q, so that they are solved
#: together. "circle" looks at s_surface, "edge" at sliding at the edge of a face, "body" at the whole body.
SOURCES = {
    "line": [
        (random_points, "paraboloid", (1, 2)),
        (random_points, "rounded_punch", (4, 3)),
        (random_points, "truncated_paraboloid", (2, 1)),
        (points_at_ends, "paraboloid", (1, 1)),
    ],
    "wavy": [(random_points, "wavy_paraboloid", (1, 2))],
    "circle": [(random_points, "paraboloid", (1, 2))],
    "edge": [(random_points, "truncated_paraboloid", (1, 2))],
    "body": [(random_points, "paraboloid", (1, 2)), (random_points, "rounded_punch", (2, 1))],
}
SEED = 5
#: ℓ/a_H of the means.
DISTANCE = np.array([0.1])


def solved(kind: str, count: int, rtol: float) -> tuple[np.ndarray, np.ndarray]:
    """s and s_error of a kind of sample, ``count`` points of each source."""
    found = []
    for draw, profile, ratio in SOURCES[kind]:
        points = draw(profile, max(count // 16, 1) if kind == "body" else count, SEED)
        points.p[:], points.q[:] = ratio
        if kind == "edge":
            points.friction[:] = 0.75 + 0.25 * points.friction
            points.tangential_amplitude[:] += 3.0
        with np.errstate(all="ignore"):
            found.append(_of_body(points) if kind == "body" else _of_line(points, rtol, kind))
    s, error = (np.concatenate(each) for each in zip(*found, strict=True))
    return s, error


def _of_line(points: Points, rtol: float, kind: str) -> tuple[np.ndarray, np.ndarray]:
    solution = solve_points(points, rtol)
    return solution.s_surface if kind == "circle" else solution.s, solution.s_error


def _of_body(points: Points) -> tuple[np.ndarray, np.ndarray]:
    """swt of bodies over all planes, at the line's critical points, and means about these, shape (4 n,)."""
    found = []
    solution = solve_points(points, 1e-5)
    critical_x = solution.critical_x
    for k in np.flatnonzero(np.isfinite(critical_x)):
        scene, x = scene_of(points.take(np.array([k]))), float(critical_x[k])
        largest, at_line = body_maximum.body_maximum(scene, x)
        means = nonlocal_swt.nonlocal_swt(scene, critical_x[[k]], solution.critical_angle[[k]], DISTANCE)
        found += [largest.swt, float(at_line.swt), means.volume[0, 0], means.line[0, 0, 0]]
    return np.array(found), np.full(len(found), np.inf)
