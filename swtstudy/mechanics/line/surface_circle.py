"""swt on the circle through the critical point of the surface line: the assumption y = 0, tested.

With a bulk stress the circle of the smallest contact radius is another one: outside of the contact the radial
tension of the pressure is largest there, and at its side the bulk stress does not press on it.

The stress on the circle is made of the same building blocks as on the line, see
`swtstudy.mechanics.stress.history`. They know only r: edge and slip fronts pass the whole circle at once, and
one look at the cycle serves all angles. At some angles the highest planes are climbed to; what may be above
the line is followed along the circle, with instants around its own extremes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.line.first_look import CLOSE_SHARE, SHARE
from swtstudy.mechanics.line.look import Extremes, Look
from swtstudy.mechanics.numerics.arrays import SAME
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.planes.all_planes import CoarsePlanes
from swtstudy.mechanics.planes.ascent import ROUGH_STEP, climb, swap_instants
from swtstudy.mechanics.planes.weights import normal_weights
from swtstudy.mechanics.points import FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.history import History, circle_stress
from swtstudy.mechanics.stress.scene import Scene

#: Up to this ν the line is never left (results/audit_parameter_box.md): nothing is computed there.
SAFE_POISSON_RATIO = 0.35
#: Angles from the x axis that are looked at first: by symmetry in y half of the circle is all of it. Half:
#: 2e-4 low at 2 more of 1,690 points (these, and those below, are of `studies/checks/off_line.py`).
ANGLES = np.linspace(0.0, np.pi, 17)
#: Cosine of the turn between planes that are one.
SAME_PLANE = np.cos(2.0 * ROUGH_STEP)
#: Offsets at which each round looks, in a width that is the angles' step at first, half as much once the
#: highest place is within, and at last this share of it. Four times that: 1e-4 to 1e-3 low at 50 points.
OFFSETS, LAST_WIDTH = np.linspace(-1.0, 1.0, 5), 1.0 / 8.0
#: What counts as higher than the line, relative: more than what the last round leaves.
HIGHER = 1e-4
#: Steps of a smooth stretch of the cycle, and digits of tables. The first halved: 1e-2 low at a point of
#: tests/mechanics/test_surface_circle.py. Two digits less: 1e-4 to 1e-3 at 19 points.
STEPS, DIGITS = 4, 5.5


@dataclass(frozen=True)
class _Places(Rows):
    """Places of circles, one plane each.

    Attributes
    ----------
    circle
        Shape (m,): number of the circle.
    angle, normal
        Shapes (m,), in rad from the x axis, and (m, 3).
    width
        Shape (m,): how far to either side the next round looks, rad.
    """

    circle: IndexArray
    angle: FloatArray
    normal: FloatArray
    width: FloatArray


def surface_maximum(scene: Scene, swt: FloatArray, error: FloatArray, position: FloatArray) -> FloatArray:
    """swt on the circle through the line's maximum, over all plane orientations, shape (n,).

    That of the line where nothing on the circle exceeds it, NaN where the maximum is at the edge of a flat
    face itself: on that circle the pressure has no bound. Where a bulk stress leaves no tension on the line,
    or swt is largest far away, it is the circle of the largest contact radius. With a bulk stress the circle
    of the smallest contact radius is looked at as well, but for profiles with a sharp edge.

    Parameters
    ----------
    scene
        n points.
    swt, error, position
        The line's maxima, their errors and places x, each of shape (n,).
    """
    nowhere = (swt <= error) | (np.isnan(position) & np.isfinite(swt))
    nowhere &= scene.critical_everywhere
    r = np.where(nowhere, scene.largest_radius, np.abs(position))
    flat = scene.profile.flat_radius
    at_edge = scene.profile.has_singular_edge & (flat > 0.0) & (r == flat)
    surface = np.where(at_edge, np.nan, swt)
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
    highest = known.copy()
    look = Look.at(scene, r[:, None], STEPS, DIGITS)
    places = _first_places(scene, look.history, known)
    own = places.circle
    scene, look, whole = scene.take(own), look.take(own), look.history.take(own)
    for _ in range(MOST_STEPS):
        if not places.angle.size:
            break
        angle = places.angle[:, None] + places.width[:, None] * OFFSETS
        history = _around_extremes(scene, look, whole, places)
        start = np.repeat(places.normal[:, None], OFFSETS.size, axis=1)
        swt, normal = _climb(*_circle(scene, history, angle), start, scene)
        np.maximum.at(highest, places.circle, swt.max(axis=1))
        best = np.arange(len(angle)), swt.argmax(axis=1)
        # While the highest place is an outermost one, the maximum may be farther.
        width = np.where(np.abs(OFFSETS[best[1]]) < 1.0, 0.5, 1.0) * places.width
        places = _Places(places.circle, angle[best], normal[best], width)
        kept = _leading(places, swt[best], highest)
        places = places.take(kept)
        scene, look, whole = scene.take(kept), look.take(kept), whole.take(kept)
    return highest


def _leading(places: _Places, swt: FloatArray, highest: FloatArray) -> IndexArray:
    """Numbers of the places that may be as high as the highest of their circle and are not yet at the top.

    Of those that meet it is one.
    """
    order = np.lexsort((swt, places.angle, places.circle))
    some = places.take(order)
    meets = (np.diff(some.circle) == 0) & (np.diff(some.angle) < SAME)
    meets &= np.abs((some.normal[1:] * some.normal[:-1]).sum(axis=-1)) > SAME_PLANE
    kept = ~np.append(meets, False) & (swt[order] >= (1.0 - CLOSE_SHARE) * highest[some.circle])
    kept &= some.width >= LAST_WIDTH * ANGLES[1]
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


def _first_places(scene: Scene, history: History, known: FloatArray) -> _Places:
    """Places of circles at which swt may be largest, and above what is known."""
    stress, tensor = _circle(scene, history, ANGLES[None])
    swt, normal = _summits(scene, stress, tensor)
    chosen = (swt >= (1.0 - SHARE) * np.maximum(swt.max(axis=1), known)[:, None]) & (swt > 0.0)
    at = circle, angle = np.nonzero(chosen)
    swt, normal, some = swt[at], normal[at], (stress[at], tensor[at])
    # Of two summits close to one another, each by instants of its own, a coarse plane leads to one.
    criterion = scene.criterion.take(circle)
    other, turned = climb(*some, swap_instants(*some, normal, criterion), criterion, ROUGH_STEP)
    is_other = np.abs((turned * normal).sum(axis=-1)) < SAME_PLANE
    places = _Places(circle, ANGLES[angle], normal, np.full(len(circle), ANGLES[1]))
    new = np.flatnonzero(is_other & (other >= (1.0 - CLOSE_SHARE) * swt))
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


def _around_extremes(scene: Scene, look: Look, whole: History, places: _Places) -> History:
    """Building blocks around the three instants that make swt at places on their planes, and at these.

    ``whole`` is the history of the look.
    """
    extremes = Extremes.of(np.moveaxis(_curves(scene, whole, places)[:, None], 2, 0), look.inside)
    brackets = look.brackets(extremes.best, extremes.falling)
    wide, own = _samples(scene, look, places, brackets)
    best = _or_rivals(scene, look, places, extremes, _tops(brackets, own))
    same = best == extremes.best
    if not same.all():
        brackets = look.brackets(best, extremes.falling & same[..., None])
        wide, own = _samples(scene, look, places, brackets)
    brackets = brackets.narrowed(own.argmax(axis=-1))
    narrow, own = _samples(scene, look, places, brackets)
    peak = narrow.weighted(brackets.weights_at_peak(own))
    return wide.followed_by(narrow).followed_by(peak)


def _or_rivals(scene: Scene, look: Look, places: _Places, extremes: Extremes, top: FloatArray) -> IndexArray:
    """The best instants, with maxima ``top`` about them, (m, 1, 3), or those that turn out to be higher."""
    best, top, rows = extremes.best.copy(), top.copy(), np.arange(len(top))
    extremes = extremes.next_best()
    # What the nodes cannot tell from the highest instants is looked at, too.
    while (some := np.flatnonzero(extremes.may_exceed(top[rows]).any(axis=(1, 2)))).size:
        rows, extremes = rows[some], extremes.take(some)
        scene, look, places = scene.take(some), look.take(some), places.take(some)
        brackets = look.brackets(extremes.best)
        height = _tops(brackets, _samples(scene, look, places, brackets)[1])
        best[rows] = np.where(height > top[rows], extremes.best, best[rows])
        top[rows], extremes = np.maximum(height, top[rows]), extremes.next_best()
    return best


def _samples(scene: Scene, look: Look, places: _Places, brackets: TimeBrackets) -> tuple[History, FloatArray]:
    """Building blocks in the brackets of m places, and each curve in its own, shape (m, 1, 3, samples)."""
    history = look.line.history(brackets.samples())
    curves = _curves(scene, history, places).reshape(len(scene), 3, 3, -1)
    return history, curves[:, range(3), range(3)][:, None]


def _tops(brackets: TimeBrackets, own: FloatArray) -> FloatArray:
    """Maxima between the samples of curves in their own brackets, shape (m, 1, 3)."""
    return np.asarray((own * brackets.weights_at_peak(own)).sum(axis=-1))


def _curves(scene: Scene, history: History, places: _Places) -> FloatArray:
    """The three curves over the cycle at m places on their planes, shape (m, 3, T)."""
    stress, tensor = (v[:, 0] for v in _circle(scene, history, places.angle[:, None]))
    tension = (stress @ normal_weights(places.normal)[..., None])[..., 0]
    swing = scene.criterion.swing.on_plane(tensor, places.normal)
    return np.stack(scene.criterion.curves(tension, swing), axis=1)
