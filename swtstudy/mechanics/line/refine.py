"""swt at a position, closely: that of the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants that
make swt (the largest σ_n, the largest and the smallest ε_n), ever closer, and the plane turns to the best one
by these samples.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.events.stretches import split_at_layers
from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.line.first_look import CLOSE_SHARE, THIN
from swtstudy.mechanics.line.look import Extremes, Look, Resolution, lifted
from swtstudy.mechanics.numerics.arrays import highest_of_rows, largest_of_rows
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.through_y import PlaneHistory, apart, best_angle, turned
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray
from swtstudy.mechanics.stress.line import OUTSIDE
from swtstudy.mechanics.stress.scene import Scene

#: How often the plane is improved and the extremes over the cycle are looked up anew, where swt does not rise
#: still: the extremes move with the plane. No more anywhere: 4e-4 at rtol 1e-4 at 1 of 1,001 points
#: (tests/mechanics/test_narrow_maxima.py).
ANGLE_ROUNDS = 2
#: Where planes beside one are tried, 2θ in rad: those for other instants may be close by
#: (tests/mechanics/test_narrow_maxima.py); nearer, two are one.
BESIDE, SAME_PLANE = np.array([0.0, -0.25, -0.05, 0.05, 0.25]), 0.01


@dataclass(frozen=True)
class Samples:
    """k samples around each of three extremes at n × X positions.

    Attributes
    ----------
    brackets
        Where they lie.
    near
        Shape (3, n, X, 3, k), see `of_extremes`.
    criterion
        Shape (n, 1).
    """

    brackets: TimeBrackets
    near: FloatArray
    criterion: Criterion

    def take(self, index: IndexArray) -> Samples:
        """Return the samples of the points at ``index``."""
        return Samples(self.brackets.take(index), self.near[:, index], self.criterion.take(index))

    def or_other(self, own: BoolArray, other: Samples) -> Samples:
        """These around the extremes that are ``own``, shape (n, X, 3), and other ones around the others."""
        near = np.where(own[..., None], self.near, other.near)
        return replace(self, brackets=self.brackets.or_other(own, other.brackets), near=near)

    def narrowed(self, angle: FloatArray) -> TimeBrackets:
        """Brackets around the best samples on planes (n, X)."""
        return self.brackets.narrowed(on_plane(self.near, angle).argmax(axis=-1))

    def tops(self, angle: FloatArray) -> FloatArray:
        """Maxima of the three curves between the samples, on planes (n, X), shape (n, X, 3)."""
        return on_plane(self._at_peaks(angle), angle)

    def best_plane(self, angle: FloatArray, gain: float) -> tuple[FloatArray, FloatArray]:
        """swt and 2θ of the best planes near some, each (n, X), until they rise by less than a share."""
        for _ in range(ANGLE_ROUNDS):
            peaks, start = self._at_peaks(angle), angle
            angle = _turned(peaks, start, self.criterion)
        before, peaks = _swt(peaks, start, self.criterion), self._at_peaks(angle)
        swt = _swt(peaks, angle, self.criterion)
        rows, some = np.arange(len(angle)), self
        for _ in range(MOST_STEPS):
            rises = np.flatnonzero((swt[rows] - before > gain * swt[rows]).any(axis=1))
            if not rises.size:
                break
            rows, some, before = rows[rises], some.take(rises), swt[rows[rises]]
            start = angle[rows]
            turned = _turned(peaks[:, rises], start, some.criterion)
            peaks = some._at_peaks(turned)
            found = _swt(peaks, turned, some.criterion)
            swt[rows], angle[rows] = found, turned
        return swt, angle

    def _at_peaks(self, angle: FloatArray) -> FloatArray:
        """Coefficients of the three curves at their maxima between the samples, shape (3, n, X, 3)."""
        weights = self.brackets.weights_at_peak(on_plane(self.near, angle))
        return np.asarray((self.near * weights).sum(axis=-1))


def _turned(peaks: FloatArray, angle: FloatArray, criterion: Criterion) -> FloatArray:
    """2θ at which the extremes (3, n, X, 3) of planes (n, X) make the largest swt."""
    return best_angle(peaks[..., 0], 0.5 * (peaks[..., 1] + peaks[..., 2]), angle, criterion)


def _swt(peaks: FloatArray, angle: FloatArray, criterion: Criterion) -> FloatArray:
    """swt by the extremes (3, n, X, 3) of planes (n, X)."""
    return criterion.of_maxima(*np.moveaxis(on_plane(peaks, angle), -1, 0))


def of_extremes(planes: PlaneHistory) -> FloatArray:
    """Coefficients of the curves whose maxima make swt, each at its own samples: (3, n, X, 3, k)."""
    stress, swing = (values.reshape(*values.shape[:-1], 3, -1) for values in (planes.stress, planes.swing))
    return np.stack([stress[..., 0, :], swing[..., 1, :], -swing[..., 2, :]], axis=-2)


def on_plane(coefficients: FloatArray, angle: FloatArray) -> FloatArray:
    """A + B cos 2θ + C sin 2θ of coefficients (3, n, X, …) at 2θ of shape (n, X)."""
    a, b, c = coefficients
    angle = angle.reshape(angle.shape + (1,) * (a.ndim - angle.ndim))
    return np.asarray(a + b * np.cos(angle) + c * np.sin(angle))


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
    return _refined(scene, look, planes, side, double_angle, resolution)


def refine_beside(
    scene: Scene, r: FloatArray, side: FloatArray, double_angle: FloatArray, resolution: Resolution
) -> tuple[FloatArray, FloatArray]:
    """`refine` at one place of each point, all of shape (n,), where summits of other planes or instants hide.

    Layers of the cycle have instants of their own (without: 1.4e-4 at a point of
    tests/mechanics/test_overlooked.py), and planes beside are tried (without: 9e-5 at another).
    """
    at = scene.coordinate.of(np.minimum(r, OUTSIDE * scene.largest_radius)[:, None])[:, 0]
    scene = replace(scene, cycle=split_at_layers(scene.cycle, at, THIN))
    look = Look.at(scene, r[:, None], resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, side[:, None, None])
    own = np.arange(len(r))
    row, angle, swt = summits(planes.take(own, 0 * own), look.inside[:, 0], *beside(own, double_angle))
    high = swt >= (1.0 - CLOSE_SHARE) * largest_of_rows(row, swt)[row]
    row, start = row[high], angle[high, None]
    swt, angle = _refined(scene.take(row), look.take(row), planes.take(row), side[row], start, resolution)
    best = highest_of_rows(row, swt[:, 0])
    return swt[best, 0], angle[best, 0]


def _refined(
    scene: Scene,
    look: Look,
    planes: PlaneHistory,
    side: FloatArray,
    double_angle: FloatArray,
    resolution: Resolution,
) -> tuple[FloatArray, FloatArray]:
    """swt and 2θ by ever closer samples around the extremes that a look shows."""
    # Not the best plane near by on these nodes: there the summit of a narrow peak may be none.
    best = double_angle
    extremes = Extremes.of(planes.criterion.curves(*planes.on_plane(best)), look.inside)
    zoom = _Zoom(scene, look, side, resolution)
    samples = zoom.around(extremes)
    swt, angle = zoom.to_maximum(samples, best)
    # What the nodes cannot tell from the highest instants is followed, too.
    rows, extremes = np.arange(len(swt)), extremes.next_best()
    while (some := np.flatnonzero(extremes.may_exceed(samples.tops(best)).any(axis=(1, 2)))).size:
        rows, extremes, samples, best = rows[some], extremes.take(some), samples.take(some), best[some]
        rival, extremes = zoom.take(rows).around(extremes), extremes.next_best()
        # Of two instants the one around which the plane is higher.
        here = rival.tops(best) > samples.tops(best)
        samples = rival.or_other(here, samples)
        new = np.flatnonzero(here.any(axis=(1, 2)))
        if new.size:
            more, at = zoom.take(rows[new]).to_maximum(samples.take(new), best[new])
            better = more > swt[rows[new]]
            swt[rows[new]] = np.where(better, more, swt[rows[new]])
            angle[rows[new]] = np.where(better, at, angle[rows[new]])
    return swt, angle


@dataclass(frozen=True)
class _Zoom:
    """Ever closer samples.

    Attributes
    ----------
    scene, look, side
        n points, their look and the signs of x.
    resolution
        How closely.
    """

    scene: Scene
    look: Look
    side: FloatArray
    resolution: Resolution

    def take(self, rows: IndexArray) -> _Zoom:
        """Return the zooms of some points."""
        return replace(self, scene=self.scene.take(rows), look=self.look.take(rows), side=self.side[rows])

    def around(self, extremes: Extremes) -> Samples:
        """Samples around the best instants."""
        return self._within(self.look.brackets(extremes.best, extremes.falling))

    def _within(self, brackets: TimeBrackets) -> Samples:
        history = self.look.line.history(brackets.samples())
        near = of_extremes(self.scene.planes(history, self.side[:, None, None]))
        return Samples(brackets, near, self.scene.criterion_along)

    def to_maximum(self, samples: Samples, angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """swt and 2θ near a plane (n, X)."""
        gain = 10.0**-self.resolution.digits
        swt, angle = samples.best_plane(angle, gain)
        for _ in range(1, self.resolution.zooms):
            samples = self._within(samples.narrowed(angle))
            swt, angle = samples.best_plane(angle, gain)
        return swt, angle


def climb_over_planes(
    planes: PlaneHistory, inside: BoolArray, start: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """swt and 2θ where it is locally largest over the planes, from 2θ = ``start``, each (…).

    The curves of points (…) are as high between T instants as parabolas are: by the instants alone the other
    one of two planes with extremes of their own may not be seen (3.6e-5 low at a point of
    tests/mechanics/test_overlooked.py, at every rtol). For ``inside``, (…, T), see `Look.inside`.
    """

    def curves(angle: FloatArray) -> list[FloatArray]:
        return [lifted(curve, inside) for curve in planes.criterion.curves(*planes.on_plane(angle))]

    angle = start
    for _ in range(ANGLE_ROUNDS):
        angle = turned(planes, angle, curves(angle))
    return planes.criterion.of_maxima(*(curve.max(axis=-1) for curve in curves(angle))), angle


def beside(row: IndexArray, double_angle: FloatArray) -> tuple[IndexArray, FloatArray]:
    """Planes at 2θ of places number ``row``, both (m,), and those beside them, with their places, (5 m,)."""
    return np.tile(row, len(BESIDE)), (double_angle + BESIDE[:, None]).ravel()


def summits(
    planes: PlaneHistory, inside: BoolArray, row: IndexArray, start: FloatArray
) -> tuple[IndexArray, FloatArray, FloatArray]:
    """Planes of locally largest swt, from starts.

    Parameters
    ----------
    planes
        At m places and T instants.
    inside
        Shape (m, T), see `Look.inside`.
    row, start
        Shape (s,): numbers of the places, and 2θ to start from, rad.

    Returns
    -------
    row, double_angle, swt
        Shape (k,): numbers of the places, ascending, 2θ of the planes in rad and swt there.
    """
    some, within = planes.take(row), inside[row]
    swt, reached = climb_over_planes(some, within, start)
    order = np.lexsort((-swt, row))
    row, reached, swt = row[order], reached[order], swt[order]
    # Of starts that lead to one summit the highest counts.
    known = np.zeros(row.size, dtype=bool)
    for back in range(1, int(np.bincount(row).max(initial=1))):
        same = apart(reached[back:] - reached[:-back]) < SAME_PLANE
        known[back:] |= (row[back:] == row[:-back]) & same
    return row[~known], reached[~known], swt[~known]
