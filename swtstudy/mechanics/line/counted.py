"""Strain cycles of a round of the load at its worst place and plane, and how bad each is.

A life N(SWT) is one of strain cycles. The strain of a plane is counted by rainflow, each cycle with its own
amplitude and its own largest σ_n: a swt of its own. A round does the damage Σ 1/N(SWT_i), which depends on a
material's constants; so what is kept are the cycles themselves, over the largest swt, as few numbers: those
that are alike are one, with how many they are.

The place and plane of the largest swt are not always those of the largest damage: others may have more
cycles. Between any two values of SWT, 1/N goes like a power of it, for strain-life constants one from 1 to
some 10. So the places and planes are looked for at which the sum of swt_i to the power of 1, 2, 4, 8 is
largest, on both sides of the line y = 0 and over all planes through y: first at the positions of the first
look and at `PLANES` planes, then closer. Only those can be better whose swt, to that power, times V/4ε_a is
larger than the sum at the critical place, V being the way that ε_n goes in a round and ε_a its amplitude:
that is an upper bound of the sum, and little is left to count where a round has one cycle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from swtstudy.mechanics.line.first_look import PLANES, joined_pieces, resolved
from swtstudy.mechanics.line.look import Look, lifted
from swtstudy.mechanics.line.positions import Pieces, Positions
from swtstudy.mechanics.numerics.arrays import as_rows
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.rainflow import closed_cycles
from swtstudy.mechanics.planes.through_y import PlaneHistory
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.vocabulary.quantities import COUNTED_SIZES

#: Powers of swt of which the sum is made largest.
POWERS = np.array([1.0, 2.0, 4.0, 8.0])
#: A place or plane with a sum larger by less than this is left out.
GAIN = 0.01
#: Steps of each stretch of the cycle in the search and where cycles are counted, and digits of tables.
STEPS, FINE_STEPS, DIGITS = 4, 8, 5.0
#: What an upper bound may be low by, since it is seen at instants.
SLACK = 1.05
#: Places and planes around the best ones in a closer look, in steps of the former ones, how the steps shrink,
#: and how often.
OFFSETS, SHRINKING, ROUNDS = np.array([-1.0, -0.5, 0.0, 0.5, 1.0]), 0.4, 4
#: Points times positions times instants that are looked at together, and histories that are counted so.
LOOK_SIZE, COUNT_SIZE = 200_000, 4000
#: Smallest strain cycle that counts, over the largest swt; and how far from the edge of a flat face, over its
#: radius, cycles at that edge are counted.
NONE, BESIDE = 1e-6, 1e-6


class Histories(NamedTuple):
    """σ_n and the swing of h planes at places, (h, T), which instants are in stretches; criterion, (h,)."""

    stress: FloatArray
    swing: FloatArray
    inside: BoolArray
    criterion: Criterion

    @classmethod
    def at(cls, look: Look, planes: PlaneHistory, double_angle: FloatArray) -> Histories:
        """On planes at 2θ, shape (h, X), of the positions (h, X) of a look."""
        stress, swing = planes.on_plane(double_angle)
        count, inside = stress.shape[-1], np.broadcast_to(look.inside, stress.shape)
        criterion = planes.criterion.spread(*double_angle.shape).reshape(-1)
        stress, swing = stress.reshape(-1, count), swing.reshape(-1, count)
        return cls(stress, swing, inside.reshape(-1, count), criterion)

    def take(self, rows: IndexArray) -> Histories:
        """Some of them."""
        stress, swing, inside, criterion = self
        return Histories(stress[rows], swing[rows], inside[rows], criterion.take(rows))

    def swt(self) -> FloatArray:
        """swt of the closed cycles, descending, shape (h, k)."""
        tops = (lifted(curve, self.inside) for curve in self.criterion.curves(self.stress, self.swing))
        tension, largest, least = tops
        swing = np.where(largest > self.swing, largest, -least)
        found = closed_cycles(swing, tension)
        return -np.sort(-self.criterion.reshape(-1, 1).value(found.tension, found.amplitude), axis=1)


def sums(swt: FloatArray) -> FloatArray:
    """Sums over the cycles of swt to `POWERS`, shape (h, k) to (powers, h)."""
    return np.stack([(swt**power).sum(axis=1) for power in POWERS])


class _Places(NamedTuple):
    """m places and planes, each the best of its point for one of the powers; arrays of shape (m,).

    Attributes
    ----------
    point, power
        Numbers of the point, and of the power.
    side, place
        Sign of x, and number of the position of the first look.
    c
        Where around that position, see `Positions.around`.
    angle
        2θ, rad.
    """

    point: IndexArray
    power: IndexArray
    side: FloatArray
    place: IndexArray
    c: FloatArray
    angle: FloatArray


def strain_cycles(scene: Scene, position: FloatArray, double_angle: FloatArray) -> list[list[FloatArray]]:
    """swt of the strain cycles in a round, over the largest swt, at the worst places and planes of n points.

    Parameters
    ----------
    scene
        n points.
    position, double_angle
        Shape (n,): signed x of the critical points, and 2θ of the critical planes, rad.

    Returns
    -------
    list
        For each point the cycles of its critical plane, the first of which is 1, then those of up to one
        place and plane for each of `POWERS` where the sum is larger by `GAIN`; each in descending order.
    """
    split = scene.split_at_breakpoints()
    home = _at(split, _off_edge(scene, np.abs(position)), np.sign(position), double_angle)
    largest = home[:, :1]
    # A sum may be largest where swt is half as high.
    positions, _ = resolved(scene, joined_pieces(scene, Pieces.of(split)), 0.5 * largest[:, 0])
    home = home / largest
    best = sums(home)
    worse = _closer(split, positions, largest, _higher(split, positions, largest, best))
    found = [[shares[shares > NONE]] for shares in home]
    for point, power, shares in worse:
        own = sums(shares[None])[:, 0]
        if own[power] > (1.0 + GAIN) * best[power, point]:
            best[:, point] = np.maximum(best[:, point], own)
            found[point].append(shares[shares > NONE])
    return found


def far_cycles(scene: Scene) -> list[list[FloatArray]]:
    """The same far from the contact, where there is a bulk stress alone, for n points that have one."""
    assert scene.bulk is not None
    instants = np.sort(np.concatenate([scene.cycle.begin, scene.bulk.turning_instants()], axis=1), axis=1)
    stress = scene.bulk.at(instants)
    modulus = (1.0 - scene.poisson_ratio**2)[:, None]
    found = closed_cycles(stress / modulus, stress)
    swt = -np.sort(-scene.criterion_along.value(found.tension, found.amplitude), axis=1)
    return [[shares[shares > NONE]] for shares in swt / swt[:, :1]]


def _off_edge(scene: Scene, r: FloatArray) -> FloatArray:
    """r next to the edge of a flat face, where the stress itself may have no bound, shape (n,)."""
    flat = scene.profile.flat_radius
    return np.where(r == flat, r * (1.0 + BESIDE), r)


def _at(split: Scene, r: FloatArray, side: FloatArray, double_angle: FloatArray) -> FloatArray:
    """swt of the closed cycles at one place and plane of each of n points, descending, shape (n, k)."""
    look = Look.at(split, r[:, None], FINE_STEPS, DIGITS)
    planes = split.planes(look.history, side[:, None, None])
    return Histories.at(look, planes, double_angle[:, None]).swt()


def _higher(split: Scene, positions: Positions, largest: FloatArray, least: FloatArray) -> _Places:
    """Where the first look finds the largest sums, if they may be above the ``least``, (powers, n)."""
    index, _ = as_rows(positions.point, np.arange(len(split)))
    size = max(LOOK_SIZE // (index.shape[1] * STEPS * split.cycle.begin.shape[1]), 1)
    parts = []
    for rows in np.array_split(np.arange(len(split)), -(-len(split) // size)):
        found = _higher_of_some(split.take(rows), positions.r[index[rows]], largest[rows], least[:, rows])
        point = rows[found.point]
        parts.append(found._replace(point=point, place=index[point, found.place]))
    return _Places(*(np.concatenate(values) for values in zip(*parts, strict=True)))


def _higher_of_some(split: Scene, r: FloatArray, largest: FloatArray, least: FloatArray) -> _Places:
    look = Look.at(split, r, STEPS, DIGITS)
    kept: list[tuple[Histories, IndexArray, IndexArray, float, float]] = []
    for x_sign in (1.0,) if split.mirrored_half else (1.0, -1.0):
        planes = split.planes(look.history, x_sign)
        for plane in 2.0 * np.pi * np.arange(PLANES) / PLANES:
            every = Histories.at(look, planes, np.full(r.shape, plane))
            bound = _bounds(every).reshape(len(POWERS), *r.shape) / largest ** POWERS[:, None, None]
            rows = np.flatnonzero((SLACK * bound > (1.0 + GAIN) * least[..., None]).any(axis=0))
            kept.append((every.take(rows), *np.divmod(rows, r.shape[1]), x_sign, plane))
    point, column = (np.concatenate([part[k] for part in kept]) for k in (1, 2))
    side, angle = (np.concatenate([np.full(part[1].size, part[k]) for part in kept]) for k in (3, 4))
    found = _counted([part[0] for part in kept]) / largest[point, 0] ** POWERS[:, None]
    # The best of each point comes last, for each power.
    order = [np.lexsort((sums_of, point)) for sums_of in found]
    last = [each[np.diff(point[each], append=-1) != 0] for each in order]
    power = np.repeat(np.arange(len(POWERS)), [each.size for each in last])
    at = np.concatenate(last)
    higher = found[power, at] > least[power, point[at]]
    at, power = at[higher], power[higher]
    return _Places(point[at], power, side[at], column[at], np.zeros(at.size), angle[at])


def _bounds(histories: Histories) -> FloatArray:
    """Upper bounds of `sums`, from the way that the swing goes in a round, shape (powers, h)."""
    stress, swing, _, criterion = histories
    tops = (curve.max(axis=-1) for curve in criterion.curves(stress, swing))
    swt = criterion.of_maxima(*tops)
    steps = np.diff(swing, append=swing[:, :1])
    way, reach = np.abs(steps).sum(axis=1), np.ptp(swing, axis=1)
    # The amplitudes of the cycles, over the largest, add up to so much.
    number = np.divide(way, 2.0 * reach, out=np.ones_like(way), where=reach > 0.0)
    turns = np.maximum((steps * np.roll(steps, 1, axis=1) < 0.0).sum(axis=1), 1.0)
    of_swing = POWERS[:, None] * criterion.powers(swt, reach)[1]
    # A root of the amplitudes adds up to most where all are equal.
    equal = turns ** np.maximum(1.0 - of_swing, 0.0) * number ** np.minimum(of_swing, 1.0)
    return np.asarray(swt ** POWERS[:, None] * equal)


def _counted(histories: list[Histories]) -> FloatArray:
    """`sums` of many histories, some at a time, which have as many instants each, shape (powers, h)."""
    stress, swing, inside = (np.concatenate([each[k] for each in histories]) for k in range(3))
    criteria = [each.criterion for each in histories]
    every = Histories(stress, swing, inside, type(criteria[0]).joined(criteria))
    parts = np.array_split(np.arange(len(stress)), -(-len(stress) // COUNT_SIZE) or 1)
    return np.concatenate([sums(every.take(rows).swt()) for rows in parts], axis=1)


def _closer(
    split: Scene, positions: Positions, largest: FloatArray, places: _Places
) -> list[tuple[int, int, FloatArray]]:
    """Point, power and cycles over the largest swt at the best places near to some, by point and power."""
    point, power, side, place, c, angle = places
    if not point.size:
        return []
    own = split.take(point)
    here = positions.take(place)
    wide, turned = 1.0, 2.0 * np.pi / PLANES
    for _ in range(ROUNDS):
        around = np.clip(c[:, None] + wide * OFFSETS, -1.0, 1.0)
        look = Look.at(own, here.around(around), FINE_STEPS, DIGITS)
        planes = own.planes(look.history, side[:, None, None])
        angles = angle[:, None] + turned * OFFSETS
        tried = [Histories.at(look, planes, np.repeat(a[:, None], OFFSETS.size, axis=1)) for a in angles.T]
        found = _counted(tried).reshape(len(POWERS), OFFSETS.size, point.size, OFFSETS.size)
        own_power = found[power, :, np.arange(point.size)].reshape(point.size, -1)
        plane, step = np.divmod(own_power.argmax(axis=1), OFFSETS.size)
        rows = np.arange(point.size)
        c, angle = around[rows, step], angles[rows, plane]
        wide, turned = SHRINKING * wide, SHRINKING * turned
    shares = _at(own, here.around(c[:, None])[:, 0], side, angle) / largest[point]
    order = np.lexsort((power, point))
    return [(int(point[k]), int(power[k]), shares[k]) for k in order]


#: Cycles whose SWT differ by less than this, relative, are equal.
EQUAL = 1e-6
#: Cycles are alike whose logarithms of SWT differ by less than a width times that to the largest SWT plus so
#: much; the first width with which they are few enough. So are 300 random cycles 8, with a damage that is
#: right to 14 % for lives that go with SWT to the minus 1 to 9. 0.4 in place of 0.05: 27 %.
WIDTHS, LEAST_DEPTH = 1e-3 * 1.5 ** np.arange(25), 0.05
#: Cycles that are alike have the mean of this power of SWT, so that a life which goes with SWT to the minus
#: this power stays as it is.
POWER = 4.0


@dataclass(frozen=True)
class FewCycles:
    """Strain cycles in a round of n points, of shape (n, places, cycles) by `COUNTED_SIZES`.

    Attributes
    ----------
    share
        SWT of a cycle over the largest SWT, descending at each place; NaN where there are no more.
    number
        How many cycles have it.
    """

    share: FloatArray
    number: FloatArray

    @classmethod
    def of(cls, scene: Scene, position: FloatArray, double_angle: FloatArray) -> FewCycles:
        """Find the strain cycles of n points, see `strain_cycles`; NaN where the angle is.

        Where only the position is, s is that far from the contact.
        """
        share, number = np.full((2, len(scene), *COUNTED_SIZES.values()), np.nan)
        near = np.flatnonzero(np.isfinite(position))
        far = np.flatnonzero(np.isnan(position) & np.isfinite(double_angle))
        found = strain_cycles(scene.take(near), position[near], double_angle[near]) if near.size else []
        found += far_cycles(scene.take(far)) if far.size else []
        for point, places in zip(np.concatenate([near, far]), found, strict=True):
            for place, cycles in enumerate(places):
                shares, numbers = few(cycles, share.shape[-1])
                share[point, place, : shares.size], number[point, place, : shares.size] = shares, numbers
        return cls(share, number)


def few(shares: FloatArray, most: int) -> tuple[FloatArray, FloatArray]:
    """At most so many cycles in the place of many, and how many each stands for.

    The largest stays as it is, so that the damage is never less than its own.

    Parameters
    ----------
    shares
        Shape (k,), positive and descending.
    most
        Two at least.

    Examples
    --------
    >>> few(np.array([1.0, 1.0, 0.5]), 8)
    (array([1. , 0.5]), array([2., 1.]))
    """
    depth = np.log(shares[0] / shares)
    equal = int(np.searchsorted(depth, EQUAL, side="right"))
    rest = depth[equal:]
    for width in WIDTHS:
        begins = _begins(rest, width)
        if len(begins) < most:
            break
    groups = np.split(shares[equal:], begins[1 : most - 1]) if rest.size else []
    means = [float((group**POWER).mean() ** (1.0 / POWER)) for group in groups]
    return np.array([shares[0], *means]), np.array([float(equal), *(float(len(group)) for group in groups)])


def _begins(ascending: FloatArray, width: float) -> list[int]:
    """Where groups begin, by the depths below the largest SWT."""
    begins: list[int] = []
    for place, value in enumerate(ascending):
        begin = ascending[begins[-1]] if begins else -np.inf
        if value - begin > width * (LEAST_DEPTH + begin):
            begins.append(place)
    return begins
