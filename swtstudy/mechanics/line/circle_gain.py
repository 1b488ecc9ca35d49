"""swt on the circle through the critical point of the surface line: the assumption y = 0, tested.

The stress on the circle is made of the same building blocks as on the line, see
`swtstudy.mechanics.stress.circle`. They know only r: edge and slip fronts pass the whole circle at once, and
the instants that make swt on the line make it on the circle.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.line.look import Look, extreme_instants
from swtstudy.mechanics.line.samples import of_extremes, on_plane
from swtstudy.mechanics.planes.ascent import climb
from swtstudy.mechanics.planes.hooke import strain_history
from swtstudy.mechanics.planes.through_y import PlaneHistory
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.circle import circle_stress
from swtstudy.mechanics.stress.history import History
from swtstudy.mechanics.stress.scene import Scene

#: Up to this ν the line is never left (results/audit_parameter_box.md): nothing is computed there. 0.45: no
#: change at 300 points from 0.36 to 0.5, 7 % faster.
SAFE_POISSON_RATIO = 0.35
#: Angles from the line that are looked at first, then in a narrower range. Half of either: 9e-5 at 5 of 300
#: points with ν > 0.35, no faster.
ANGLES = np.linspace(0.0, 0.5 * np.pi, 17)
CLOSER = np.linspace(-1.0, 1.0, 9)[None] * ANGLES[1]
#: Steps of a smooth stretch of the cycle, and digits of tables. Half of the steps: 3e-4 at 6 of 300 points;
#: 3.5 digits: 1e-4 at 8; no faster. Twice: 7e-5; 7.5: 4e-6.
TIME_STEPS, DIGITS = 4, 5.5


def circle_gain(
    scene: Scene, position: FloatArray, double_angle: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """By how much swt on the circle through the line's maximum exceeds swt on the line.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n,): signed x in a_H of the line's maximum.
    double_angle
        Shape (n,): 2θ of its critical plane, rad.

    Returns
    -------
    gain, angle
        Shape (n,): the relative excess, 0 where the line has the maximum, and where on the circle it is, rad
        from the line; over all plane orientations, at the instants that make swt on the line. NaN where the
        maximum is at the edge of a flat face itself: on that circle the pressure has no bound.
    """
    r, flat = np.abs(position), scene.profile.flat_radius
    at_edge = (flat > 0.0) & (r == flat)
    gain, angle = (np.where(at_edge, np.nan, 0.0) for _ in range(2))
    rows = np.flatnonzero((scene.poisson_ratio > SAFE_POISSON_RATIO) & (r > 0.0) & ~at_edge)
    if rows.size:
        some = scene.take(rows)
        history, normal = _decisive_history(some, position[rows], double_angle[rows])
        swt = _on_circle(some, history, normal, np.broadcast_to(ANGLES, (rows.size, ANGLES.size)))
        base, best = swt[:, 0], swt.argmax(axis=1)
        off = np.flatnonzero((best > 0) & (base > 0.0))
        if off.size:
            near = ANGLES[best[off], None] + CLOSER
            found = _on_circle(some.take(off), history.take(off), normal[off], near)
            top = found.argmax(axis=1), np.arange(off.size)
            gain[rows[off]] = found[top[::-1]] / base[off] - 1.0
            angle[rows[off]] = near[top[::-1]]
    return gain, angle


def _decisive_history(
    scene: Scene, position: FloatArray, double_angle: FloatArray
) -> tuple[History, FloatArray]:
    """Building blocks around the three instants that make swt on the line, and its plane's normal.

    A maximum at x < 0 is mirrored to x > 0.
    """
    r = np.abs(position)[:, None]
    look = Look.at(scene, r, TIME_STEPS, DIGITS)
    side = np.where(position < 0.0, -1.0, 1.0)

    def planes(history: History) -> PlaneHistory:
        return scene.planes(history, side[:, None, None])

    found = extreme_instants(planes(look.history), double_angle[:, None], look.inside)
    brackets = look.brackets(found)
    wide = look.line.history(brackets.samples())
    closer = on_plane(of_extremes(planes(wide)), double_angle[:, None]).argmax(axis=-1)
    narrow = look.line.history(brackets.narrowed(closer).samples())
    history = wide.joined(narrow).take(np.arange(len(r)), np.zeros(len(r), dtype=np.intp))
    history = history.with_tangential_sign(side[:, None])
    θ = 0.5 * double_angle
    return history, np.stack([side * np.cos(θ), np.zeros_like(θ), np.sin(θ)], axis=-1)


def _on_circle(scene: Scene, history: History, normal: FloatArray, angle: FloatArray) -> FloatArray:
    """swt at angles (n, k) on the circles; the planes are climbed to from the line's."""
    stress = circle_stress(history, scene.poisson_ratio, scene.friction, angle)
    strain = strain_history(stress, scene.poisson_ratio[:, None, None, None])
    start = np.broadcast_to(normal[:, None], (*angle.shape, 3)).reshape(-1, 3)
    flat = (-1, *stress.shape[-2:])
    return climb(stress.reshape(flat), strain.reshape(flat), start)[0].reshape(angle.shape)
