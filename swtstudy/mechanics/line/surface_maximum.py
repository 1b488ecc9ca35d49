"""swt on the circle through the critical point of the surface line: the assumption y = 0, tested.

The stress on the circle is made of the same building blocks as on the line, see
`swtstudy.mechanics.stress.history`. They know only r: edge and slip fronts pass the whole circle at once, and
the instants that make swt on the line make it on the circle. Not so with a bulk stress: where it presses, the
line may be the lowest place of the circle, whose highest has its own instants and a plane that turns with it.
Nor with a criterion that needs no tension.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.climb import of_extremes, on_plane
from swtstudy.mechanics.line.look import Look, extreme_instants
from swtstudy.mechanics.line.maximum import Maximum
from swtstudy.mechanics.planes.ascent import climb
from swtstudy.mechanics.planes.through_y import PlaneHistory
from swtstudy.mechanics.planes.weights import normal_weights
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.history import History, circle_stress
from swtstudy.mechanics.stress.scene import Scene

#: Up to this ν the line is never left (results/audit_parameter_box.md): nothing is computed there. 0.45: no
#: change at 300 points from 0.36 to 0.5, 7 % faster.
SAFE_POISSON_RATIO = 0.35
#: Angles from the line that are looked at first, then in a narrower range. Half of either: 9e-5 at 5 of 300
#: points with ν > 0.35, no faster.
ANGLES = np.linspace(0.0, 0.5 * np.pi, 17)
CLOSER = np.linspace(-1.0, 1.0, 9)[None] * ANGLES[1]
#: With a bulk stress, at each ν: angles of a look at planes that turn with them by these shares or are
#: radial, and the fall of swt below which no climb is tried, over sin²θ: on most circles it falls like that
#: to the square or more.
LOOK_ANGLES, TURNS, SLOW_FALL = ANGLES[2::3], np.array([0.0, 0.5, 1.0]), 0.4
#: What of a criterion of shear counts as higher, relative: more than what instants leave.
HIGHER = 1e-4
#: Normals from which a criterion of shear is climbed to, besides.
OBLIQUE = np.sqrt(0.5) * np.array([[1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 1.0]])
#: Where the base is less than this share of the line's maximum the two have nothing in common: rounding of no
#: tension at all.
SAME_SHARE = 0.5
#: Steps of a smooth stretch of the cycle, and digits of tables. Half of the steps: 3e-4 at 6 of 300 points;
#: 3.5 digits: 1e-4 at 8; no faster. Twice: 7e-5; 7.5: 4e-6.
TIME_STEPS, DIGITS = 4, 5.5
#: The same of a criterion of shear, whose other planes have instants of their own. 4: 1e-2 low at one of 60
#: points; 8: 4e-5; 16: a solution takes 1.2 to 1.5 times as long.
SHEAR_STEPS = 8


def surface_maximum(scene: Scene, found: Maximum) -> FloatArray:
    """swt on the circle through the line's maximum, over all plane orientations, shape (n,).

    Found at the instants that make swt on the line; that of the line where nothing on the circle exceeds it,
    NaN where the maximum is at the edge of a flat face itself: on that circle the pressure has no bound.
    Where a bulk stress leaves no tension on the line, or swt is largest far away, it is the circle of the
    largest contact radius.

    Parameters
    ----------
    scene
        n points.
    found
        The line's maxima.
    """
    if scene.bulk is None:
        return _surface_maximum(scene, found)
    nowhere = (found.swt == 0.0) | (np.isnan(found.position) & np.isfinite(found.swt))
    surface = _surface_maximum(scene, _with_place(found, nowhere, scene.largest_radius))
    rows = np.flatnonzero(nowhere)
    if rows.size:
        # Nothing on the line says which side of the circle is higher.
        some = scene.take(rows)
        other = _with_place(found.take(rows), nowhere[rows], -some.largest_radius)
        surface[rows] = np.maximum(surface[rows], _surface_maximum(some, other))
    return surface


def _surface_maximum(scene: Scene, found: Maximum) -> FloatArray:
    r, flat = np.abs(found.position), scene.profile.flat_radius
    at_edge = scene.profile.has_singular_edge & (flat > 0.0) & (r == flat)
    surface = np.where(at_edge, np.nan, found.swt)
    doubtful = (scene.poisson_ratio > SAFE_POISSON_RATIO) | scene.critical_everywhere
    rows = np.flatnonzero(doubtful & (r > 0.0) & ~at_edge)
    if rows.size:
        some = scene.take(rows)
        history, normal = _decisive_history(some, found.position[rows], found.double_angle[rows])
        if scene.bulk is not None and scene.criterion.needs_tension:
            slow = np.flatnonzero(
                (some.poisson_ratio > SAFE_POISSON_RATIO) | _falls_slowly(some, history, normal)
            )
            rows, some, history, normal = rows[slow], some.take(slow), history.take(slow), normal[slow]
        swt = _on_circle(some, history, normal, np.broadcast_to(ANGLES, (rows.size, ANGLES.size)))
        base, best = swt[:, 0], swt.argmax(axis=1)
        off = np.flatnonzero(
            ((best > 0) | (not scene.criterion.needs_tension)) & ((base > 0.0) | scene.critical_everywhere)
        )
        if off.size:
            near = ANGLES[best[off], None] + CLOSER
            top = _on_circle(some.take(off), history.take(off), normal[off], near).max(axis=1)
            line = found.swt[rows[off]]
            if scene.criterion.needs_tension:
                surface[rows[off]] = _relative(line, base[off], top)
            else:
                # Planes that do not hold the y axis may be higher on the line itself.
                surface[rows[off]] = np.where(top > (1.0 + HIGHER) * line, top, line)
    return surface


def _with_place(found: Maximum, nowhere: NDArray[np.bool_], position: FloatArray) -> Maximum:
    """The maxima with a position, shape (n,), for those that are ``nowhere``."""
    double_angle = np.where(nowhere, 0.0, found.double_angle)
    return replace(found, position=np.where(nowhere, position, found.position), double_angle=double_angle)


def _relative(line: FloatArray, base: FloatArray, top: FloatArray) -> FloatArray:
    """swt on a circle whose ``top`` and ``base`` on the line share their errors, which the line's has not."""
    same = base > SAME_SHARE * line
    gain = np.divide(top, base, out=np.ones_like(top), where=same) - 1.0
    return np.where(same, line * (1.0 + gain), np.maximum(line, top))


def _falls_slowly(scene: Scene, history: History, normal: FloatArray) -> NDArray[np.bool_]:
    """True where swt may be higher elsewhere on the circle, from a few planes at each angle, shape (n,)."""
    angle = np.broadcast_to(np.concatenate([[0.0], LOOK_ANGLES]), (len(scene), 1 + LOOK_ANGLES.size))
    stress, tensor = _circle(scene, history, angle)
    criterion = scene.criterion_along
    highest = np.zeros(angle.shape)
    for planes in (*(_turned(normal, share * angle) for share in TURNS), _radial(angle)):
        tension = (stress @ normal_weights(planes)[..., None])[..., 0]
        swing = criterion.swing.on_plane(tensor, planes)
        tops = (curve.max(axis=-1) for curve in criterion.curves(tension, swing))
        highest = np.maximum(highest, criterion.of_maxima(*tops))
    least = (1.0 - SLOW_FALL * np.sin(angle[:, 1:]) ** 2) * highest[:, :1]
    return np.asarray((highest[:, 1:] > least).any(axis=1))


def _turned(normal: FloatArray, angle: FloatArray) -> FloatArray:
    """Normals (n, 3) of planes through y turned about z by angles (n, k), shape (n, k, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * normal[:, :1], s * normal[:, :1], normal[:, 2:] + 0.0 * c], axis=-1)


def _radial(angle: FloatArray) -> FloatArray:
    """Normals in the surface along the radii at angles (n, k): tension where it presses on the line."""
    return _turned(np.broadcast_to([1.0, 0.0, 0.0], (len(angle), 3)), angle)


def _circle(scene: Scene, history: History, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stress and the tensor of the swing at angles (n, k) on the circles, shape (n, k, T, 6)."""
    stress = circle_stress(history, scene.poisson_ratio, scene.friction, angle)
    return stress, scene.criterion.swing.tensor(stress, scene.poisson_ratio[:, None, None, None])


def _decisive_history(
    scene: Scene, position: FloatArray, double_angle: FloatArray
) -> tuple[History, FloatArray]:
    """Building blocks around the three instants that make swt on the line, and its plane's normal.

    A maximum at x < 0 is mirrored to x > 0.
    """
    r = np.abs(position)[:, None]
    steps = TIME_STEPS if scene.criterion.needs_tension else SHEAR_STEPS
    look = Look.at(scene, r, steps, DIGITS)
    side = np.where(position < 0.0, -1.0, 1.0)

    def planes(history: History) -> PlaneHistory:
        return scene.planes(history, side[:, None, None])

    found = extreme_instants(planes(look.history), double_angle[:, None], look.inside)
    brackets = look.brackets(found)
    wide = look.line.history(brackets.samples())
    closer = on_plane(of_extremes(planes(wide)), double_angle[:, None]).argmax(axis=-1)
    narrow = look.line.history(brackets.narrowed(closer).samples())
    history = wide.followed_by(narrow)
    if scene.critical_everywhere:
        history = history.followed_by(look.history)
    history = history.take((np.arange(len(r)), 0))
    history = history.with_tangential_sign(side[:, None])
    θ = 0.5 * double_angle
    return history, np.stack([side * np.cos(θ), np.zeros_like(θ), np.sin(θ)], axis=-1)


def _on_circle(scene: Scene, history: History, normal: FloatArray, angle: FloatArray) -> FloatArray:
    """swt at angles (n, k) on the circles; the planes are climbed to from the line's, turned or not."""
    stress, tensor = _circle(scene, history, angle)
    flat = (-1, *stress.shape[-2:])
    criterion = scene.criterion.take(np.repeat(np.arange(len(scene)), angle.shape[1]))
    starts = [np.broadcast_to(normal[:, None], (*angle.shape, 3))]
    if scene.critical_everywhere:
        starts += [_turned(normal, angle), _radial(angle)]
    if not scene.criterion.needs_tension:
        # Planes that do not hold the y axis may slide most.
        starts += [np.broadcast_to(each, (*angle.shape, 3)) for each in OBLIQUE]
    histories = stress.reshape(flat), tensor.reshape(flat)
    found = [climb(*histories, start.reshape(-1, 3), criterion)[0] for start in starts]
    return np.asarray(np.max(found, axis=0).reshape(angle.shape))
