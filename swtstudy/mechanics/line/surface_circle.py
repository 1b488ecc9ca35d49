"""swt on the circle through the critical point of the surface line: the assumption y = 0, tested.

With a bulk stress the circle of the smallest contact radius is another one: outside of the contact the radial
tension of the pressure is largest there, and at its side the bulk stress does not press on it.

The stress on the circle is made of the same building blocks as on the line, see
`swtstudy.mechanics.stress.history`. They know only r: edge and slip fronts pass the whole circle at once, and
one look at the cycle serves all angles. At some angles the highest planes are climbed to; what is a maximum
along the circle, too, and may be above the line is followed, with instants around its own extremes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.line.look import Look, lifted
from swtstudy.mechanics.line.maximum import Maximum
from swtstudy.mechanics.numerics.arrays import SAME
from swtstudy.mechanics.planes.all_planes import CoarsePlanes
from swtstudy.mechanics.planes.ascent import ROUGH_STEP, climb, swap_instants
from swtstudy.mechanics.planes.weights import normal_weights
from swtstudy.mechanics.points import FloatArray, Rows
from swtstudy.mechanics.stress.history import History, circle_stress
from swtstudy.mechanics.stress.scene import Scene

#: Up to this ν the line is never left (results/audit_parameter_box.md): nothing is computed there.
SAFE_POISSON_RATIO = 0.35
#: Angles from the x axis that are looked at first: by symmetry in y half of the circle is all of it. Half:
#: 2e-4 low at 2 more of 1,690 points (these, and those below, are of `studies/checks/off_line.py`).
ANGLES = np.linspace(0.0, np.pi, 17)
#: Share of the largest swt that instants and angles may hide. 0.02: 3e-2 low at one point, 1e-2 at another.
NEAR = 0.05
#: Cosine of the turn, 6°, between planes of one ridge at neighbouring angles. 11°: 2e-3 low at a point of
#: tests/mechanics/test_surface_circle.py.
ALIKE = 0.995
#: So much may a place be lower than the highest one once it has instants of its own. A third: 1e-3 low at a
#: point of tests/mechanics/test_surface_circle.py.
FALLS = 0.01
#: Offsets at which each round looks, in a width that is the angles' step at first, and half as much in the
#: next one. Half of the rounds: 1e-4 to 1e-3 low at 50 points.
OFFSETS, ROUNDS = np.linspace(-1.0, 1.0, 5), 4
#: What counts as higher than the line, relative: more than what the last round leaves.
HIGHER = 1e-4
#: Steps of a smooth stretch of the cycle in the first look and around a place, and digits of tables. The
#: first halved: 1e-2 low at a point of tests/mechanics/test_surface_circle.py; the second: 2e-2. Two digits
#: less: 1e-4 to 1e-3 at 19 points.
FIRST_STEPS, TIME_STEPS, DIGITS = 4, 8, 5.5


@dataclass(frozen=True)
class _Places(Rows):
    """Places of circles, one plane each.

    Attributes
    ----------
    circle
        Shape (m,): number of the circle.
    angle, normal
        Shapes (m,), in rad from the x axis, and (m, 3).
    """

    circle: NDArray[np.intp]
    angle: FloatArray
    normal: FloatArray


def surface_maximum(scene: Scene, found: Maximum) -> FloatArray:
    """swt on the circle through the line's maximum, over all plane orientations, shape (n,).

    That of the line where nothing on the circle exceeds it, NaN where the maximum is at the edge of a flat
    face itself: on that circle the pressure has no bound. Where a bulk stress leaves no tension on the line,
    or swt is largest far away, it is the circle of the largest contact radius. With a bulk stress the circle
    of the smallest contact radius is looked at as well, but for profiles with a sharp edge.

    Parameters
    ----------
    scene
        n points.
    found
        The line's maxima.
    """
    nowhere = (found.swt <= found.error) | (np.isnan(found.position) & np.isfinite(found.swt))
    nowhere &= scene.critical_everywhere
    r = np.where(nowhere, scene.largest_radius, np.abs(found.position))
    flat = scene.profile.flat_radius
    at_edge = scene.profile.has_singular_edge & (flat > 0.0) & (r == flat)
    surface = np.where(at_edge, np.nan, found.swt)
    doubtful = ((scene.poisson_ratio > SAFE_POISSON_RATIO) | scene.critical_everywhere) & ~at_edge
    circles = [r]
    if scene.bulk is not None and not scene.profile.has_singular_edge:
        circles.append(scene.smallest_radius)
    for circle in circles:
        rows = np.flatnonzero(doubtful & (circle > 0.0))
        if rows.size:
            known = surface[rows]
            top = _highest(scene.take(rows), circle[rows], known)
            surface[rows] = np.where(top > (1.0 + HIGHER) * known, top, known)
    return surface


def _highest(scene: Scene, r: FloatArray, known: FloatArray) -> FloatArray:
    """Largest swt on circles of radius r, shape (n,), ``known`` at least."""
    highest, width = known.copy(), ANGLES[1]
    places = _first_places(scene, r, known)
    if not places.angle.size:
        return highest
    scene = scene.take(places.circle)
    look = Look.at(scene, r[places.circle, None], TIME_STEPS, DIGITS)
    whole = look.history
    for _ in range(ROUNDS):
        angle = places.angle[:, None] + width * OFFSETS
        history = _around_extremes(scene, look, whole, places)
        start = np.repeat(places.normal[:, None], OFFSETS.size, axis=1)
        swt, normal = _climb(*_circle(scene, history, angle), start, scene)
        np.maximum.at(highest, places.circle, swt.max(axis=1))
        best = np.arange(len(angle)), swt.argmax(axis=1)
        places = replace(places, angle=angle[best], normal=normal[best])
        kept = _leading(places, swt[best], highest)
        if not kept.size:
            break
        places = places.take(kept)
        scene, look, whole = scene.take(kept), look.take(kept), whole.take(kept)
        width *= 0.5
    return highest


def _leading(places: _Places, swt: FloatArray, highest: FloatArray) -> NDArray[np.intp]:
    """Numbers of the places that may be as high as the highest of their circle; of those that meet one."""
    order = np.lexsort((swt, places.angle, places.circle))
    some = places.take(order)
    meets = (np.diff(some.circle) == 0) & (np.diff(some.angle) < SAME)
    meets &= np.abs((some.normal[1:] * some.normal[:-1]).sum(axis=-1)) > ALIKE
    kept = ~np.append(meets, False) & (swt[order] >= (1.0 - FALLS) * highest[some.circle])
    return order[kept]


def _circle(scene: Scene, history: History, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Stress and the tensor of the swing at angles (n, k), or (1, k) of all circles, shape (n, k, T, 6)."""
    history = history.take((np.arange(len(scene)), 0))
    stress = circle_stress(history, scene.poisson_ratio, scene.friction, angle)
    ν = scene.poisson_ratio[:, None, None, None]
    return stress, scene.criterion.swing.tensor(stress, ν, 1.0 - ν**2)


def _climb(
    stress: FloatArray, tensor: FloatArray, start: FloatArray, scene: Scene
) -> tuple[FloatArray, FloatArray]:
    """Summits over the planes, (n, k), and their normals, (n, k, 3), of histories (n, k, T, 6)."""
    flat, k = (-1, *stress.shape[-2:]), stress.shape[1]
    criterion = scene.criterion.take(np.repeat(np.arange(len(scene)), k))
    swt, normal = climb(stress.reshape(flat), tensor.reshape(flat), start.reshape(-1, 3), criterion)
    return swt.reshape(-1, k), normal.reshape(-1, k, 3)


def _first_places(scene: Scene, r: FloatArray, known: FloatArray) -> _Places:
    """Places of circles at which swt may be largest, and above what is known."""
    look = Look.at(scene, r[:, None], FIRST_STEPS, DIGITS)
    stress, tensor = _circle(scene, look.history, ANGLES[None])
    swt, normal = _summits(scene, stress, tensor)
    chosen = (swt >= (1.0 - NEAR) * np.maximum(swt.max(axis=1), known)[:, None]) & (swt > 0.0)
    chosen &= _on_top(swt, normal)
    at = circle, angle = np.nonzero(chosen)
    swt, normal, some = swt[at], normal[at], (stress[at], tensor[at])
    # Of two summits close to one another, each by instants of its own, a coarse plane leads to one.
    criterion = scene.criterion.take(circle)
    other, turned = climb(*some, swap_instants(*some, normal, criterion), criterion, ROUGH_STEP)
    is_other = np.abs((turned * normal).sum(axis=-1)) < np.cos(2.0 * ROUGH_STEP)
    places = _Places(circle, ANGLES[angle], normal)
    new = np.flatnonzero(is_other & (other >= (1.0 - FALLS) * swt))
    return _Places.joined([places, replace(places.take(new), normal=turned[new])])


def _summits(scene: Scene, stress: FloatArray, tensor: FloatArray) -> tuple[FloatArray, FloatArray]:
    """swt at the angles on a summit over the planes, (n, k), and normals, (n, k, 3)."""
    planes, criterion = CoarsePlanes.everywhere(), scene.criterion
    normal, swt = np.empty((*stress.shape[:2], 3)), np.zeros(stress.shape[:2])
    for row, (own, ν) in enumerate(zip(stress, scene.poisson_ratio, strict=True)):
        coarse = planes.swt(own, float(ν), criterion.take(np.array([row])))
        normal[row], swt[row] = planes.normal[coarse.argmax(axis=1)], coarse.max(axis=1)
    at = np.nonzero(swt > 0.0)
    swt[at], normal[at] = climb(stress[at], tensor[at], normal[at], criterion.take(at[0]), ROUGH_STEP)
    return swt, normal


def _on_top(swt: FloatArray, normal: FloatArray) -> NDArray[np.bool_]:
    """Which summits are higher than those on alike planes at the next angles, shape (n, k)."""
    alike = np.abs((normal[:, 1:] * normal[:, :-1]).sum(axis=-1)) > ALIKE
    on_top = np.ones(swt.shape, dtype=bool)
    on_top[:, 1:] &= ~alike | (swt[:, 1:] >= swt[:, :-1])
    on_top[:, :-1] &= ~alike | (swt[:, :-1] >= swt[:, 1:])
    return on_top


def _around_extremes(scene: Scene, look: Look, whole: History, places: _Places) -> History:
    """Building blocks around the three instants that make swt at places on their planes.

    ``whole`` is the history of the look.
    """

    def curves(history: History) -> FloatArray:
        stress, tensor = (v[:, 0] for v in _circle(scene, history, places.angle[:, None]))
        tension = (stress @ normal_weights(places.normal)[..., None])[..., 0]
        swing = scene.criterion.swing.on_plane(tensor, places.normal)
        return np.stack(scene.criterion.curves(tension, swing), axis=1)

    best = lifted(curves(whole), look.inside).argmax(axis=-1)
    brackets = look.brackets(best[:, None])
    wide = look.line.history(brackets.samples())
    # Each curve in the bracket of its own.
    own = curves(wide).reshape(len(best), 3, 3, -1)[:, range(3), range(3)]
    narrow = look.line.history(brackets.narrowed(own.argmax(axis=-1)[:, None]).samples())
    return wide.followed_by(narrow)
