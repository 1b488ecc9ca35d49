"""swt at given positions of the surface line: the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants
that make swt (the largest σ_n, the largest and the smallest ε_n), ever closer.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.line.look import (
    Look,
    Resolution,
    extreme_instants,
    extremes_and_rivals,
    lifted,
    near_extremes,
    reach,
)
from swtstudy.mechanics.numerics.arrays import pick
from swtstudy.mechanics.planes.criterion import curves, of_maxima
from swtstudy.mechanics.planes.through_y import PlaneHistory, best_angle, climb_over_planes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

#: How often the plane is improved and the extremes over the cycle are looked up anew. Once: 4e-4 at
#: 1 of 1,001 points at rtol 1e-6, where two planes stand 3° apart, 3 % faster.
ANGLE_ROUNDS = 2
#: swt may have two maxima over the planes not far apart: 2θ is started from here, rad from the first look.
#: The first start alone: 1e-3 at some of 600 points (tests/test_narrow_maxima.py); half or twice: no
#: change at 128.
STARTS = np.array([0.0, -0.25, 0.25])[:, None, None]
#: Planes nearer than this are one, 2θ in rad. Half or twice: no change at 128 points.
SAME_PLANE = 0.01
#: A plane whose swt, interpolated, is below this share of the best one's is no rival: 4e-4 of s was lost at a
#: point where the two were nearer (tests/test_narrow_maxima.py), and looking at all planes costs 2 %.
RIVAL_SHARE = 0.97


def hot_intervals(
    scene: Scene, position: FloatArray, side: FloatArray, double_angle: FloatArray, resolution: Resolution
) -> NDArray[np.bool_]:
    """Intervals of the cycle that can hold an extreme at one position or next to it, shape (n, i).

    Parameters
    ----------
    scene
        n points.
    position, side, double_angle
        Shape (n,): r = |x|, sign of x, 2θ in rad.
    resolution
        Its zooms are not used.
    """
    look = Look.at(scene, position[:, None], resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, side[:, None, None])
    near = near_extremes(planes, STARTS + double_angle[:, None])
    row, column, place = np.nonzero(near)
    hot = np.zeros(scene.cycle.begin.shape, dtype=bool)
    hot[row, look.placed.interval[row, column, place]] = True
    return hot


def refine(
    scene: Scene, position: FloatArray, side: FloatArray, double_angle: FloatArray, resolution: Resolution
) -> tuple[FloatArray, FloatArray]:
    """swt on one side of the contact, with the extremes found closely.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    side
        Shape (n,): sign of x.
    double_angle
        Shape (n, X): 2θ to start from, rad.
    resolution
        How closely.

    Returns
    -------
    swt, double_angle
        Shape (n, X).
    """
    look = Look.at(scene, position, resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, side[:, None, None])
    best, other = _best_planes(planes, look.inside, double_angle + STARTS)
    found, rival = extremes_and_rivals(planes, best, look.inside)
    elsewhere = extreme_instants(planes, other, look.inside)
    swt, angle = _zoomed(scene, look, side, best, found, resolution.zooms)
    # Two planes, or two instants, that the nodes cannot tell apart are both followed; neighbouring nodes have
    # the same bracket.
    for plane, extremes in ((other, elsewhere), (best, rival)):
        rows = np.flatnonzero((np.abs(found - extremes) > 1).any(axis=(1, 2)))
        if not rows.size:
            continue
        some, at, there = scene.take(rows), plane[rows], extremes[rows]
        again = Look.at(some, position[rows], resolution.nodes, resolution.digits)
        if extremes is rival:
            there = _higher(some, again, side[rows], at, (found[rows], there))
        more, at = _zoomed(some, again, side[rows], at, there, resolution.zooms)
        better = more > swt[rows]
        swt[rows] = np.where(better, more, swt[rows])
        angle[rows] = np.where(better, at, angle[rows])
    return swt, angle


def _higher(
    scene: Scene, look: Look, side: FloatArray, angle: FloatArray, either: tuple[NDArray[np.intp], ...]
) -> NDArray[np.intp]:
    """Of two instants for each extreme on a plane, both (n, X, 3), the one around which it is higher."""
    tops = []
    for extremes in either:
        brackets = look.brackets(extremes)
        near = of_extremes(scene.planes(look.line.history(brackets.samples()), side[:, None, None]))
        tops.append(on_plane(np.stack(_at_peaks(near, brackets, angle), axis=-1), angle))
    return np.where(tops[1] > tops[0], either[1], either[0])


def _zoomed(
    scene: Scene, look: Look, side: FloatArray, angle: FloatArray, extremes: NDArray[np.intp], zooms: int
) -> tuple[FloatArray, FloatArray]:
    """swt and 2θ near a plane (n, X), from samples ever closer around the instants of its extremes."""
    brackets, walker = look.brackets(extremes), scene.walker
    for turn in range(zooms):
        near = of_extremes(scene.planes(look.line.history(brackets.samples()), side[:, None, None]))
        for _ in range(ANGLE_ROUNDS):
            peak, high, low = _at_peaks(near, brackets, angle)
            angle = best_angle(peak, high + low, angle, walker)
        if turn < zooms - 1:
            brackets = brackets.narrowed(on_plane(near, angle).argmax(axis=-1))
    tops = on_plane(np.stack(_at_peaks(near, brackets, angle), axis=-1), angle)
    return of_maxima(*np.moveaxis(tops, -1, 0), walker=walker), angle


def _best_planes(
    planes: PlaneHistory, inside: NDArray[np.bool_], angle: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The planes of largest swt, 2θ: by the values at the instants, and by interpolation between them.

    Parameters
    ----------
    planes
        At points (…) and T instants.
    inside
        Shape (…, T), see `Look.inside`.
    angle
        Shape (s, …): starts, rad.
    """
    angle = climb_over_planes(planes, angle, ANGLE_ROUNDS)
    of_swt = curves(*planes.on_plane(angle))
    found = []
    for top in (lambda curve: curve.max(axis=-1), lambda curve: lifted(curve, inside).max(axis=-1)):
        swt = of_maxima(*(top(curve) for curve in of_swt), walker=planes.walker)
        found.append(np.moveaxis(swt, 0, -1))
    angle = np.moveaxis(angle, 0, -1)
    best, other = (swt.argmax(axis=-1) for swt in found)
    # Between two instants a plane may reach higher than the parabolas say.
    apart = np.abs(angle - pick(angle, best)[..., None]) > SAME_PLANE
    apart &= found[1] >= RIVAL_SHARE * pick(found[1], best)[..., None]
    at = np.nonzero(apart.any(axis=-1) & (best == other))
    if at[0].size:
        reached = (reach(np.stack([start[at] for start in curve]), inside[at]) for curve in of_swt)
        high = of_maxima(*reached, walker=planes.walker and planes.walker.take(at[0], 0))
        high = np.where(apart[at], np.moveaxis(high, 0, -1), 0.0)
        rival = high.argmax(axis=-1)
        other[at] = np.where(pick(high, rival) > pick(found[1][at], best[at]), rival, best[at])
    return pick(angle, best), pick(angle, other)


def of_extremes(planes: PlaneHistory) -> FloatArray:
    """Coefficients of σ_n, ε_n and −ε_n, whose maxima make swt, each at its own samples: (3, n, X, 3, k)."""
    stress, strain = (values.reshape(*values.shape[:-1], 3, -1) for values in (planes.stress, planes.strain))
    return np.stack([stress[..., 0, :], strain[..., 1, :], -strain[..., 2, :]], axis=-2)


def on_plane(coefficients: FloatArray, angle: FloatArray) -> FloatArray:
    """A + B cos 2θ + C sin 2θ of coefficients (3, n, X, …) at 2θ of shape (n, X)."""
    a, b, c = coefficients
    angle = angle.reshape(angle.shape + (1,) * (a.ndim - angle.ndim))
    return np.asarray(a + b * np.cos(angle) + c * np.sin(angle))


def _at_peaks(near: FloatArray, brackets: TimeBrackets, angle: FloatArray) -> tuple[FloatArray, ...]:
    """Coefficients of σ_n, ε_n and −ε_n at their maxima between the samples, each (3, n, X)."""
    weights = brackets.weights_at_peak(on_plane(near, angle))
    return tuple(np.moveaxis((near * weights).sum(axis=-1), -1, 0))
