"""Climbs to the maxima of swt along the surface line, many at once: where they start and where they stand.

swt at a position is that of the extremes over the cycle and over the planes. First all event-aligned instants
are looked at; then the stress is sampled anew around the three instants that make swt (the largest σ_n, the
largest and the smallest ε_n), ever closer, and the plane turns to the best one by these samples.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.events.stretches import split_at_layers
from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.line.first_look import CLOSE_SHARE, SHARE, THIN, Seen, high_positions
from swtstudy.mechanics.line.look import Extremes, Look, Resolution, lifted
from swtstudy.mechanics.line.positions import Positions
from swtstudy.mechanics.numerics.arrays import SAME, largest_of_rows
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.through_y import PlaneHistory, apart, best_angle, climb_over_planes, on_planes
from swtstudy.mechanics.points import FloatArray, Rows
from swtstudy.mechanics.stress.scene import Scene

#: How often the plane is improved and the extremes over the cycle are looked up anew, where swt does not rise
#: still: the extremes move with the plane. No more anywhere: 4e-4 at rtol 1e-4 at 1 of 1,001 points
#: (tests/mechanics/test_narrow_maxima.py).
ANGLE_ROUNDS = 2


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

    def take(self, index: NDArray[np.intp]) -> Samples:
        """Return the samples of the points at ``index``."""
        return Samples(self.brackets.take(index), self.near[:, index], self.criterion.take(index))

    def or_other(self, own: NDArray[np.bool_], other: Samples) -> Samples:
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
    at = scene.coordinate.of(r[:, None])[:, 0]
    scene = replace(scene, cycle=split_at_layers(scene.cycle, at, THIN))
    look = Look.at(scene, r[:, None], resolution.nodes, resolution.digits)
    planes = scene.planes(look.history, side[:, None, None])
    own = np.arange(len(r))
    starts = (double_angle + BESIDE[:, None]).ravel()
    row, angle, swt = _distinct(
        planes.take(own, 0 * own), look.inside[:, 0], np.tile(own, len(BESIDE)), starts
    )
    high = swt >= (1.0 - CLOSE_SHARE) * largest_of_rows(row, swt)[row]
    row, start = row[high], angle[high, None]
    found = _refined(scene.take(row), look.take(row), planes.take(row), side[row], start, resolution)
    best = np.lexsort((-found[0][:, 0], row))[np.unique(row, return_index=True)[1]]
    return found[0][best, 0], found[1][best, 0]


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

    def take(self, rows: NDArray[np.intp]) -> _Zoom:
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


#: Half the distance between the positions of a climb's first round, in gaps of the first look, and how it
#: shrinks from round to round. Twice the first: 1e-4 at 1 of 128 points; half: 3e-7.
#: Shrinking to a tenth: 3e-6 at rtol 1e-5; to 0.4: 3e-5 at 2 of 128.
FIRST_WIDTH, SHRINKING = 0.25, 0.2
#: Planes on which swt is looked at where climbs may start, and where more are tried beside the summits, 2θ
#: in rad: those for other instants may be close by (tests/mechanics/test_narrow_maxima.py); nearer, two are
#: one.
PLANES, BESIDE, SAME_PLANE = 48, np.array([0.0, -0.25, -0.05, 0.05, 0.25]), 0.01


@dataclass(frozen=True)
class Climb(Rows):
    """Climbs to m local maxima of swt along x; arrays of shape (m,).

    Attributes
    ----------
    point, side, place
        Number of the point, sign of x, and number of the position around which is searched.
    angle
        2θ of the best plane so far, rad.
    centre, width
        Where the next round looks, in the c of `Positions.around`.
    top, seen
        Estimated maximum of swt, and the largest value so far.
    remaining
        How much `top` would change in further rounds, at most; all of it where the last round had the maximum
        at its outermost place.
    rounds
        Rounds that narrowed the search.
    settled
        Whether the next round would change too little to matter.
    """

    point: NDArray[np.intp]
    side: FloatArray
    place: NDArray[np.intp]
    angle: FloatArray
    centre: FloatArray
    width: FloatArray
    top: FloatArray
    seen: FloatArray
    remaining: FloatArray
    rounds: NDArray[np.intp]
    settled: NDArray[np.bool_]

    @classmethod
    def start(
        cls,
        scene: Scene,
        positions: Positions,
        seen: Seen,
        resolution: Resolution,
        least: FloatArray | None = None,
    ) -> Climb:
        """From a first look at positions of n points, on each plane on which swt may be largest.

        With ``least``, of shape (n,), on each on which it may be as high as that.
        """
        place, side = high_positions(positions, seen, least)
        own, x_sign = scene.take(positions.point[place]), np.where(side == 0, 1.0, -1.0)
        look = Look.at(own, positions.r[place][:, None], resolution.nodes, resolution.digits)
        planes = own.planes(look.history, x_sign[:, None, None]).take(np.arange(place.size), 0 * place)
        row, angle, swt = _summits(planes, look.inside[:, 0], seen.double_angle[place, side])
        point = positions.point[place[row]]
        if least is None:
            least = largest_of_rows(point, swt)
        # Positions that were predicted by half of them leave less than half of the share.
        high = swt >= (1.0 - 0.5 * SHARE) * least[point]
        row, angle, zero = row[high], angle[high], np.zeros(np.count_nonzero(high))
        heights = zero, zero + FIRST_WIDTH, zero, zero, zero
        return cls(point[high], x_sign[row], place[row], angle, *heights, zero.astype(np.intp), zero > 0.0)

    def leading(self, height: FloatArray, share: float) -> Climb:
        """Keep the climbs whose height, shape (m,), is at least a share of the largest one at their point."""
        return self.take(height >= share * largest_of_rows(self.point, height)[self.point])

    def without_followers(self, moved: NDArray[np.bool_]) -> Climb:
        """Without those that have just moved to a position around which another one searches no lower.

        On another plane the position itself may be higher than the other one has seen.
        """
        order = np.lexsort((moved, self.place, self.side, self.point))
        key = np.stack([self.point, self.side, self.place])[:, order]
        same = np.zeros(len(order), dtype=bool)
        same[1:] = (key[:, 1:] == key[:, :-1]).all(axis=0)
        first = np.maximum.accumulate(np.where(same, 0, np.arange(len(order))))
        seen = self.seen[order]
        higher = seen > (1.0 + SAME) * seen[first]
        return self.take(order[~(same & moved[order]) | higher])

    def twins(
        self, index: NDArray[np.intp], centre: FloatArray, value: FloatArray, angle: FloatArray
    ) -> Climb:
        """Searches between the same neighbours as those at ``index``, around other values that were seen."""
        twins = self.take(index)
        return replace(
            twins,
            angle=angle,
            centre=centre,
            width=twins.width * SHRINKING,
            top=value,
            seen=value,
            remaining=value,
            rounds=twins.rounds + 1,
            settled=np.zeros(len(twins.point), dtype=bool),
        )


def _summits(
    planes: PlaneHistory, inside: NDArray[np.bool_], double_angle: FloatArray
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """Planes on which swt has its local maxima at m places, as far as they may be the largest.

    Parameters
    ----------
    planes
        At m places and T instants.
    inside
        Shape (m, T), see `Look.inside`.
    double_angle
        Shape (m,): 2θ of the best planes of the first look, rad.

    Returns
    -------
    row, double_angle, swt
        Shape (k,): numbers of the places, ascending, 2θ of the planes in rad and swt there.
    """

    angles = 2.0 * np.pi / PLANES * np.arange(PLANES)
    table = on_planes(planes, PLANES)
    peak = (table >= np.roll(table, 1, axis=0)) & (table > np.roll(table, -1, axis=0))
    peak &= table >= (1.0 - 2.0 * SHARE) * table.max(axis=0)
    # A place without tension keeps one.
    peak[table.argmax(axis=0), np.arange(len(inside))] = True
    row, plane = np.nonzero(peak.T)
    starts = np.append(angles[plane] + BESIDE[:, None], double_angle)
    return _distinct(planes, inside, np.append(np.tile(row, len(BESIDE)), np.arange(len(inside))), starts)


def _distinct(
    planes: PlaneHistory, inside: NDArray[np.bool_], row: NDArray[np.intp], start: FloatArray
) -> tuple[NDArray[np.intp], FloatArray, FloatArray]:
    """`_summits` to which starts lead, 2θ of k planes at the places number ``row``."""
    some, within = planes.take(row), inside[row]
    reached = climb_over_planes(some, start, ANGLE_ROUNDS)
    of_swt = some.criterion.curves(*some.on_plane(reached))
    swt = some.criterion.of_maxima(*(lifted(curve, within).max(axis=-1) for curve in of_swt))
    order = np.lexsort((-swt, row))
    row, reached, swt = row[order], reached[order], swt[order]
    # Of starts that lead to one summit the highest counts.
    known = np.zeros(row.size, dtype=bool)
    for back in range(1, int(np.bincount(row).max(initial=1))):
        same = apart(reached[back:] - reached[:-back]) < SAME_PLANE
        known[back:] |= (row[back:] == row[:-back]) & same
    return row[~known], reached[~known], swt[~known]
