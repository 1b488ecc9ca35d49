"""swt at given positions of the surface line: the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants
that make swt (the largest σ_n, the largest and the smallest ε_n), ever closer.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import Cycle
from swtstudy.mechanics.critical_plane import (
    PlaneHistory,
    best_angle,
    climb_over_planes,
    product,
)
from swtstudy.mechanics.gather import gather, pick
from swtstudy.mechanics.instants import Nodes, cosine_nodes, stretches
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile
from swtstudy.mechanics.surface_stress import History, SurfaceLine, stresses
from swtstudy.mechanics.vertex import parabola
from swtstudy.mechanics.zoom import TimeBrackets

#: How often the plane is improved and the extremes over the cycle are looked up anew.
ANGLE_ROUNDS = 2
#: swt may have two maxima over the planes not far apart: 2θ is started from here, rad from the first look.
STARTS = np.array([0.0, -0.25, 0.25])[:, None, None]
#: An interval in which a stress or strain comes this near to its extreme, in its range, may hold it, and at
#: positions next to the one that is looked at.
HOT = 0.35
#: A smooth maximum may be higher than the best instant by this share of the bend there: a parabola through
#: its neighbours says 1/8 at most, four steps to a stretch have shown 0.33.
REACH = 0.4
#: Values of a curve that differ by less, relative, are as high.
LEVEL = 1e-9


@dataclass(frozen=True)
class Resolution:
    """How finely swt is computed.

    Attributes
    ----------
    nodes
        Steps of the cosine-spaced instants of each stretch.
    zooms
        How often the extremes are looked at more closely, at least once to refine.
    digits
        Digits of the largest stress to which tables and series are made.
    """

    nodes: int
    zooms: int
    digits: float


@dataclass(frozen=True)
class Scene:
    """n points: what the stress on the surface line depends on.

    Attributes
    ----------
    cycle, profile
        n contact cycles and n profiles.
    poisson_ratio, friction
        Shape (n,).
    """

    cycle: Cycle
    profile: Profile
    poisson_ratio: FloatArray
    friction: FloatArray

    def __len__(self) -> int:
        return len(self.friction)

    def take(self, index: NDArray[np.intp]) -> Scene:
        """The points at ``index``, repetitions allowed."""
        return Scene(
            self.cycle.take(index), self.profile.take(index), self.poisson_ratio[index], self.friction[index]
        )

    def select(self, index: NDArray[np.intp], keep: NDArray[np.bool_]) -> Scene:
        """The points at ``index`` with the intervals of their cycles to keep, shape (len(index), i)."""
        return replace(self.take(index), cycle=self.cycle.select(index, keep))

    def planes(self, history: History, side: FloatArray | float) -> PlaneHistory:
        """σ_n and ε_n on the planes through y, on the given side of the contact."""
        sigma = stresses(history, self.poisson_ratio, self.friction, side)
        return PlaneHistory.from_stresses(sigma, self.poisson_ratio)


@dataclass(frozen=True)
class Look:
    """The stress at n × X positions and the event-aligned instants of each.

    Attributes
    ----------
    line
        The positions.
    ends
        Shape (n, X, i, 4): the stretches, see `swtstudy.mechanics.instants.stretches`.
    count
        Steps of each stretch.
    nodes, number
        The T instants, see `swtstudy.mechanics.instants.cosine_nodes`.
    history
        Building blocks of the stress at them.
    """

    line: SurfaceLine
    ends: FloatArray
    count: int
    nodes: Nodes
    number: NDArray[np.intp]
    history: History

    @classmethod
    def at(cls, scene: Scene, position: FloatArray, count: int, digits: float) -> Look:
        """Look at r = ``position``, shape (n, X)."""
        line = SurfaceLine(scene.cycle, scene.profile, position, digits)
        ends = stretches(scene.cycle, scene.profile.depth(position))
        nodes, number = cosine_nodes(scene.cycle, ends, count)
        return cls(line, ends, count, nodes, number, line.history(nodes))

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Shape (n, X, T): which instants are not at the end of their stretch."""
        return (self.number % (self.count + 1) % self.count) > 0

    @property
    def stretch(self) -> NDArray[np.intp]:
        """Shape (n, X, T): number of the stretch of each instant; three make an interval."""
        return self.number // (self.count + 1)

    def brackets(self, instants: NDArray[np.intp]) -> TimeBrackets:
        """Brackets around instants, shape (n, X, e)."""
        return TimeBrackets.around(self.ends, self.count, gather(self.number, instants))


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
    near = near_extremes(planes, STARTS + double_angle[:, None], HOT)
    row, column, place = np.nonzero(near)
    hot = np.zeros(scene.cycle.begin.shape, dtype=bool)
    hot[row, look.stretch[row, column, place] // 3] = True
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
    found, rival = _extremes_and_rivals(planes, best, look.inside)
    elsewhere = extreme_instants(planes, other, look.inside)
    swt, angle = _zoomed(scene, look, side, best, found, resolution.zooms)

    # Two planes that the nodes cannot tell apart are both followed; neighbouring nodes have the same bracket.
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
    brackets = look.brackets(extremes)
    for turn in range(zooms):
        near = of_extremes(scene.planes(look.line.history(brackets.samples()), side[:, None, None]))
        for _ in range(ANGLE_ROUNDS):
            peak, high, low = _at_peaks(near, brackets, angle)
            angle = best_angle(peak, high + low, angle)
        if turn < zooms - 1:
            brackets = brackets.narrowed(on_plane(near, angle).argmax(axis=-1))
    tops = on_plane(np.stack(_at_peaks(near, brackets, angle), axis=-1), angle)
    return product(tops[..., 0], tops[..., 1], -tops[..., 2]), angle


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
    stress, strain = planes.on_plane(angle)
    found = []
    for top in (lambda curve: curve.max(axis=-1), lambda curve: lifted(curve, inside).max(axis=-1)):
        swt = product(top(stress), top(strain), -top(-strain))
        best = np.moveaxis(swt, 0, -1).argmax(axis=-1)
        found.append(pick(np.moveaxis(angle, 0, -1), best))
    return found[0], found[1]


def extreme_instants(planes: PlaneHistory, angle: FloatArray, inside: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Instants nearest to the largest σ_n, largest ε_n, smallest ε_n, shape (…, 3); see `Look.inside`."""
    stress, strain = planes.on_plane(angle)
    return np.stack([lifted(curve, inside).argmax(axis=-1) for curve in (stress, strain, -strain)], axis=-1)


def _extremes_and_rivals(
    planes: PlaneHistory, angle: FloatArray, inside: NDArray[np.bool_]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """As `extreme_instants`, and another instant that may be higher once it is looked at, or the same one."""
    stress, strain = planes.on_plane(angle)
    found, rivals = [], []
    for curve in (stress, strain, -strain):
        top, reach = _crests(curve, inside)
        best = top.argmax(axis=-1)
        apart = np.abs(np.arange(curve.shape[-1]) - best[..., None]) > 1
        rival = np.where(apart, reach, -np.inf).argmax(axis=-1)
        found.append(best)
        # The best one may have been lifted too high.
        least = pick(curve, best)
        rivals.append(np.where(pick(reach, rival) > least + LEVEL * np.abs(least), rival, best))
    return np.stack(found, axis=-1), np.stack(rivals, axis=-1)


def lifted(curve: FloatArray, inside: NDArray[np.bool_]) -> FloatArray:
    """The curve with its local maxima as high as the parabolas through them and their neighbours.

    Of two maxima that are nearly as high, the instants alone would tell the wrong one.

    Parameters
    ----------
    curve
        Values at T instants, shape (…, T).
    inside
        Shape (…, T) or broadcast to it: which instants are not at the end of a smooth stretch.
    """
    return _crests(curve, inside)[0]


def _crests(curve: FloatArray, inside: NDArray[np.bool_]) -> tuple[FloatArray, FloatArray]:
    """`lifted`, and how high the smooth local maxima may really be."""
    middle = curve[..., 1:-1]
    peak = inside[..., 1:-1] & (middle >= curve[..., :-2]) & (middle >= curve[..., 2:])
    at = np.nonzero(peak)
    left, centre, right = (curve[..., k : curve.shape[-1] - 2 + k][at] for k in range(3))
    result, reach = curve.copy(), curve.copy()
    result[..., 1:-1][at] = centre + parabola(left, centre, right)[1]
    reach[..., 1:-1][at] = centre + REACH * (2.0 * centre - left - right)
    return result, reach


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


def near_extremes(planes: PlaneHistory, angles: Iterable[FloatArray], share: float) -> NDArray[np.bool_]:
    """Instants at which σ_n or ε_n come near to an extreme, within a share of their range, on any plane."""
    near = np.zeros(planes.stress.shape[1:], dtype=bool)
    for angle in angles:
        stress, strain = planes.on_plane(angle)
        for curve in (stress, strain, -strain):
            high, low = curve.max(axis=-1, keepdims=True), curve.min(axis=-1, keepdims=True)
            near |= curve >= high - share * (high - low)
    return near
