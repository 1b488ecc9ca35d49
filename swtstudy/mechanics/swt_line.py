"""swt at given positions of the surface line: the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants
that make swt (the largest σ_n, the largest and the smallest ε_n), ever closer.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact import Cycle
from swtstudy.mechanics.critical_plane import PlaneHistory, best_angle, coarse_swt, parabola, product
from swtstudy.mechanics.gather import gather, pick
from swtstudy.mechanics.instants import NO_STRETCH, cosine_nodes, stretches
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile
from swtstudy.mechanics.surface_stress import History, SurfaceLine, stresses
from swtstudy.mechanics.zoom import TimeBrackets

#: How often the plane is improved and the extremes over the cycle are looked up anew.
ANGLE_ROUNDS = 2
#: An interval in which a stress or strain comes this near to its extreme, in its range, may hold it.
HOT = 0.5
#: Planes that are tried where the first look finds a local maximum.
CLOSER_PLANES = 72
#: swt may have two maxima over the planes not far apart: 2θ is started from here, rad from the first look.
STARTS = np.array([0.0, -0.25, 0.25])[:, None, None]


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
class FirstLook:
    """swt at n × X positions on both sides of the contact, to the accuracy of a first look.

    Attributes
    ----------
    swt, double_angle
        Shape (n, 2, X): at x = +r and x = −r, or (n, 1, X) where both are alike; 2θ in rad.
    interval
        Shape (n, X, T): interval of the cycle in which each instant of `history` is, or whose mirror image.
    first, last
        Shape (n, 2, i): intervals of the whole cycle that each interval, and its mirror image, is made of.
    history
        What was seen there; where both sides are alike, the second half is the mirror image of the first.
    """

    swt: FloatArray
    double_angle: FloatArray
    interval: NDArray[np.intp]
    first: NDArray[np.intp]
    last: NDArray[np.intp]
    history: History

    def closer(
        self, scene: Scene, point: NDArray[np.intp], side: NDArray[np.intp], column: NDArray[np.intp]
    ) -> tuple[FloatArray, NDArray[np.bool_]]:
        """A closer look at single positions, on more planes.

        Parameters
        ----------
        scene
            The n points.
        point, side, column
            Shape (m,): index of the positions.

        Returns
        -------
        double_angle
            Shape (m,): 2θ of the best plane, rad.
        hot
            Shape (m, i): intervals of the cycle that can hold an extreme.
        """
        pieces = (v[point, column] for v in vars(self.history).values())
        x_sign = np.where(side == 0, 1.0, -1.0)[:, None]
        planes = scene.take(point).planes(History(*pieces), x_sign)
        _, angle = coarse_swt(planes, CLOSER_PLANES)
        hot = np.zeros(planes.stress.shape[1:], dtype=bool)
        for plane in (angle, self.double_angle[point, side, column]):
            stress, strain = planes.on_plane(plane)
            for curve in (stress, strain, -strain):
                high, low = curve.max(axis=-1, keepdims=True), curve.min(axis=-1, keepdims=True)
                hot |= curve >= high - HOT * (high - low)
        row, instant = np.nonzero(hot)
        count = self.interval.shape[-1]
        at = point[row], instant // count, self.interval[point[row], column[row], instant % count]
        # Ranges of intervals, as steps up and down.
        steps = np.zeros((len(point), scene.cycle.begin.shape[1] + 1), dtype=np.intp)
        np.add.at(steps, (row, self.first[at]), 1)
        np.add.at(steps, (row, self.last[at] + 1), -1)
        return angle, np.cumsum(steps, axis=1)[:, :-1] > 0


def first_look(scene: Scene, position: FloatArray, resolution: Resolution, planes: int) -> FirstLook:
    """Look at swt on both sides of the contact.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    resolution
        Its zooms are not used.
    planes
        Number of planes that are tried.
    """
    # For even q, half a common period later δ is the same and u has changed sign: half of it is enough.
    mirrored = scene.cycle.protocol.q % 2 == 0
    cycle = scene.cycle.first_half() if mirrored else scene.cycle
    line = SurfaceLine(cycle, scene.profile, position, resolution.digits)
    nodes, _ = cosine_nodes(cycle, stretches(cycle, scene.profile.depth(position)), resolution.nodes)
    history = line.history(nodes)
    interval = gather(nodes.interval, nodes.index.reshape(len(scene), -1)).reshape(nodes.index.shape)
    # An interval of the first half may reach beyond it, and its mirror image into several.
    begin, end = (np.stack([v, v + np.pi], axis=1)[..., None] for v in (cycle.begin, cycle.end))
    first = (scene.cycle.end[:, None, None] <= begin + NO_STRETCH).sum(axis=-1)
    last = np.maximum((scene.cycle.begin[:, None, None] < end - NO_STRETCH).sum(axis=-1) - 1, first)
    first, last = (np.minimum(v, scene.cycle.begin.shape[1] - 1) for v in (first, last))
    if mirrored:
        history = history.with_mirror_image()
    sides = (
        coarse_swt(scene.planes(history, side), planes) for side in ((1.0,) if mirrored else (1.0, -1.0))
    )
    swt, angle = (np.stack(both, axis=1) for both in zip(*sides, strict=True))
    return FirstLook(swt, angle, interval, first, last, history)


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
    swt, angle, other, apart = _refine_from(scene, position, side, double_angle + STARTS, resolution)
    # Two planes that the nodes cannot tell apart are both followed.
    rows = np.flatnonzero(apart.any(axis=1))
    if rows.size:
        start = other[rows][None]
        more, at, *_ = _refine_from(scene.take(rows), position[rows], side[rows], start, resolution)
        better = more > swt[rows]
        swt[rows] = np.where(better, more, swt[rows])
        angle[rows] = np.where(better, at, angle[rows])
    return swt, angle


def _refine_from(
    scene: Scene, position: FloatArray, side: FloatArray, starts: FloatArray, resolution: Resolution
) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.bool_]]:
    """`refine` from several starts of 2θ, shape (s, n, X).

    Also another plane that may be better still, and whether it has its extremes elsewhere in the cycle.
    """
    line = SurfaceLine(scene.cycle, scene.profile, position, resolution.digits)
    ends = stretches(scene.cycle, scene.profile.depth(position))
    side = side[:, None, None]
    nodes, number = cosine_nodes(scene.cycle, ends, resolution.nodes)
    planes = scene.planes(line.history(nodes), side)
    inside = (number % (resolution.nodes + 1) % resolution.nodes) > 0
    angle, other = _best_planes(planes, inside, starts)
    found, elsewhere = (np.stack(_extremes([planes] * 3, at), axis=-1) for at in (angle, other))
    # Neighbouring nodes have the same bracket.
    apart = (np.abs(found - elsewhere) > 1).any(axis=-1)
    node = gather(number, found)
    brackets = TimeBrackets.around(ends, resolution.nodes, node)
    for turn in range(resolution.zooms):
        near = _parts(scene.planes(line.history(brackets.samples()), side))
        angle = best_angle(*_active(near, _extremes(near, angle)), angle)
        best = _extremes(near, angle)
        if turn < resolution.zooms - 1:
            brackets = brackets.narrowed(np.stack(best, axis=-1))
    tops = [brackets.vertex(curve, k, best[k]) for k, curve in enumerate(_curves(near, angle))]
    return product(tops[0], tops[1], -tops[2]), angle, other, apart


def _best_planes(
    planes: PlaneHistory, inside: NDArray[np.bool_], angle: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The planes of largest swt, 2θ: by the values at the instants, and by interpolation between them.

    Parameters
    ----------
    planes
        At points (…) and T instants.
    inside
        Shape (…, T): which instants are not at the end of their stretch.
    angle
        Shape (s, …): starts, rad.
    """
    parts = [planes] * 3
    for _ in range(ANGLE_ROUNDS):
        angle = best_angle(*_active(parts, _extremes(parts, angle)), angle)
    curves = _curves(parts, angle)
    found = []
    for peaks in ([c.max(axis=-1) for c in curves], [_peak(c, inside) for c in curves]):
        swt = product(peaks[0], peaks[1], -peaks[2])
        best = np.moveaxis(swt, 0, -1).argmax(axis=-1)
        found.append(pick(np.moveaxis(angle, 0, -1), best))
    return found[0], found[1]


def _peak(curve: FloatArray, inside: NDArray[np.bool_]) -> FloatArray:
    """Maximum over the instants, interpolated in the stretches that the largest value belongs to."""
    best = curve.argmax(axis=-1)
    top = pick(curve, best)
    for step in (-1, 0, 1):
        middle = np.clip(best + step, 1, curve.shape[-1] - 2)
        left, centre, right = (pick(curve, middle + k) for k in (-1, 0, 1))
        vertex = centre + parabola(left, centre, right)[1]
        top = np.where(pick(inside, middle), np.maximum(top, vertex), top)
    return top


def _parts(planes: PlaneHistory) -> list[PlaneHistory]:
    """The samples around each of the three extremes."""
    pieces = (np.split(values, 3, axis=-1) for values in (planes.stress, planes.strain))
    return [PlaneHistory(*both) for both in zip(*pieces, strict=True)]


def _curves(parts: list[PlaneHistory], angle: FloatArray) -> list[FloatArray]:
    """σ_n, ε_n and −ε_n, whose maxima make swt, each from its own samples."""
    stress, high, low = (part.on_plane(angle) for part in parts)
    return [stress[0], high[1], -low[1]]


def _extremes(parts: list[PlaneHistory], angle: FloatArray) -> list[NDArray[np.intp]]:
    """Samples of largest σ_n, largest ε_n, smallest ε_n."""
    return [curve.argmax(axis=-1) for curve in _curves(parts, angle)]


def _active(parts: list[PlaneHistory], at: list[NDArray[np.intp]]) -> tuple[FloatArray, FloatArray]:
    """Coefficients of σ_n at its maximum and of ε_n between its extremes, each (3, …)."""
    peak, high, low = (
        np.stack([pick(v, index) for v in values])
        for values, index in zip((parts[0].stress, parts[1].strain, parts[2].strain), at, strict=True)
    )
    return peak, high - low
