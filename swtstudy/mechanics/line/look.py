"""A look at the stress along the surface line, at event-aligned instants, as closely as a tolerance asks."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from swtstudy.mechanics.events.stretches import Nodes, Placed, Stretches, cosine_nodes, stretches
from swtstudy.mechanics.events.zoom import TimeBrackets
from swtstudy.mechanics.numerics.arrays import SAME, gather, pick
from swtstudy.mechanics.numerics.roots import parabola
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.history import History
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import Scene

#: A smooth maximum may be higher than the best instant by this share of the bend there: a parabola through
#: its neighbours says 1/8 at most, four steps to a stretch have shown 0.33. 0.3: 7e-4 low at a point of
#: tests/mechanics/test_overlooked.py.
REACH = 0.4
#: A curve falls at once where twice its first slope is at least this share of the fall over a step: 2 on a
#: line. 0: 3e-4 at a point with a bulk stress; 1.5: 6e-4 low at a point of
#: tests/mechanics/test_narrow_maxima.py.
AT_ONCE = 0.9


@dataclass(frozen=True)
class Resolution:
    """The resolution at which swt is computed.

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
class Look(Rows):
    """The stress at n × X positions and the event-aligned instants of each.

    Attributes
    ----------
    line
        The positions.
    parts
        The stretches of the cycle at each.
    count
        Steps of each stretch.
    nodes, placed
        The T instants, and where they lie in the stretches.
    """

    line: SurfaceLine
    parts: Stretches
    count: int
    nodes: Nodes
    placed: Placed

    @classmethod
    def at(cls, scene: Scene, position: FloatArray, count: int, digits: float) -> Look:
        """Look at r = ``position``, shape (n, X)."""
        line = SurfaceLine(scene.cycle, scene.coordinate, position, digits, scene.bulk)
        parts = stretches(scene.cycle, line.at)
        nodes, placed = cosine_nodes(scene.cycle, parts, count)
        return cls(line, parts, count, nodes, placed)

    @cached_property
    def history(self) -> History:
        """Building blocks of the stress at the instants: not every look needs them."""
        return self.line.history(self.nodes)

    @property
    def inside(self) -> BoolArray:
        """Shape (n, X, T): which instants are not at the end of their stretch."""
        return (self.placed.place % self.count) > 0

    def brackets(self, instants: IndexArray, falling: BoolArray | None = None) -> TimeBrackets:
        """Brackets around instants, shape (n, X, e); for ``falling`` see `TimeBrackets.around`."""
        stretch, place = (gather(number, instants) for number in (self.placed.stretch, self.placed.place))
        return TimeBrackets.around(self.parts, self.count, stretch, place, falling)


@dataclass(frozen=True)
class Extremes(Rows):
    """Instants at which three curves may be highest: σ_n, the swing and the swing downwards.

    Attributes
    ----------
    best
        Shape (…, 3).
    falling
        Shape (…, 3, 2): whether the curves fall from there to both sides, as far as that is known.
    reach
        Shape (…, 3, T): how high the curves may be about each instant; −∞ where that has been seen.
    """

    best: IndexArray
    falling: BoolArray
    reach: FloatArray

    @classmethod
    def of(cls, curves: Iterable[FloatArray], inside: BoolArray) -> Extremes:
        """Find the highest instants of three curves, (…, T); for ``inside`` see `Look.inside`."""
        best, falling, reach = [], [], []
        for curve in curves:
            crests, heights = _crests(curve, inside), curve.copy()
            heights.ravel()[crests.at] = crests.lifted
            best.append(heights.argmax(axis=-1))
            falling.append(_falling(curve, best[-1]))
            _reach(heights, crests, curve, inside)
            reach.append(heights)
        return cls(np.stack(best, axis=-1), np.stack(falling, axis=-2), np.stack(reach, axis=-2))

    def next_best(self) -> Extremes:
        """Return the highest instants but for these and the ones beside them."""
        reach = self.reach.copy()
        rows, flat = np.arange(self.best.size), reach.reshape(self.best.size, -1)
        for step in (-1, 0, 1):
            flat[rows, np.clip(self.best.ravel() + step, 0, flat.shape[1] - 1)] = -np.inf
        return Extremes(reach.argmax(axis=-1), np.zeros_like(self.falling), reach)

    def may_exceed(self, top: FloatArray) -> BoolArray:
        """True where a curve may be higher than ``top``, both of shape (…, 3)."""
        return np.asarray(pick(self.reach, self.best) > top + SAME * np.abs(top))


def _falling(curve: FloatArray, best: IndexArray) -> BoolArray:
    """True where parabolas through the ``best`` instant and two on a side fall at once, shape (…, 2)."""
    count, flat = curve.shape[-1], curve.ravel()
    row, top = count * np.arange(best.size).reshape(best.shape), pick(curve, best)
    sides = []
    for step in (-1, 1):
        first, second = (flat[row + (best + k * step) % count] for k in (1, 2))
        sides.append(3.0 * top - 4.0 * first + second >= AT_ONCE * (top - first))
    return np.stack(sides, axis=-1)


def lifted(curve: FloatArray, inside: BoolArray) -> FloatArray:
    """The curve with its local maxima as high as the parabolas through them and their neighbours.

    Of two maxima that are nearly as high, the instants alone would tell the wrong one.

    Parameters
    ----------
    curve
        Values at T instants, shape (…, T).
    inside
        Shape (…, T) or broadcast to it: which instants are not at the end of a smooth stretch.
    """
    crests, result = _crests(curve, inside), curve.copy()
    result.ravel()[crests.at] = crests.lifted
    return result


def reach(curve: FloatArray, inside: BoolArray) -> FloatArray:
    """Upper estimate of a curve's maximum, shape (…), and beside ends of stretches; see `lifted`."""
    heights = curve.copy()
    _reach(heights, _crests(curve, inside), curve, inside)
    return np.asarray(heights.max(axis=-1))


class _Crests(NamedTuple):
    """The c smooth local maxima of curves.

    Attributes
    ----------
    at
        Where they are in the flattened curves.
    left, centre, right
        Shape (c,): the values before, at and after them.
    """

    at: IndexArray
    left: FloatArray
    centre: FloatArray
    right: FloatArray

    @property
    def lifted(self) -> FloatArray:
        """Heights of the parabolas through them."""
        return self.centre + parabola(self.left, self.centre, self.right)[1]


def _crests(curve: FloatArray, inside: BoolArray) -> _Crests:
    at, flat = _peaks(curve, inside), curve.ravel()
    return _Crests(at, flat[at - 1], flat[at], flat[at + 1])


def _peaks(curve: FloatArray, where: BoolArray) -> IndexArray:
    """Where the local maxima of curves between their first and last instant are in the flattened curves."""
    is_peak, middle = np.zeros(curve.shape, dtype=bool), curve[..., 1:-1]
    higher = (middle >= curve[..., :-2]) & (middle >= curve[..., 2:])
    np.logical_and(higher, where[..., 1:-1], out=is_peak[..., 1:-1])
    return np.flatnonzero(is_peak)


def _reach(heights: FloatArray, crests: _Crests, curve: FloatArray, inside: BoolArray) -> None:
    """Put the local maxima of a curve as high as they may really be, also beside ends of stretches."""
    bend = 2.0 * crests.centre - crests.left - crests.right
    heights.ravel()[crests.at] = crests.centre + REACH * bend
    ends = _peaks(curve, ~inside)
    heights.ravel()[ends] += _rise_beside_end(curve, inside, ends)


def _rise_beside_end(curve: FloatArray, inside: BoolArray, at: IndexArray) -> FloatArray:
    """Rise of the parabolas through an end ``at`` and two instants of a stretch above that end, (m,)."""
    flat, inside = curve.ravel(), np.broadcast_to(inside, curve.shape).ravel()
    count = curve.shape[-1]
    end, place, rise = flat[at], at % count, np.zeros(at.size)
    for step, last in ((-1, 1), (1, count - 2)):
        first, second = (flat.take(at + k * step, mode="clip") for k in (1, 2))
        slope, bend = 4.0 * first - 3.0 * end - second, 2.0 * first - end - second
        beside = (place != last) & inside[at + step] & (slope > 0.0) & (bend > 0.0)
        more = np.divide(slope * slope, 8.0 * bend, out=np.zeros_like(end), where=beside)
        rise = np.maximum(rise, more)
    return rise


#: Digits that a zoom gains at least. 4.0, which saves a zoom at rtol 1e-5: 4e-8, no faster.
DIGITS_PER_ZOOM = 3.2
#: Error left to the search over x, as a share of the tolerance. All of it: 9e-7 at rtol 1e-5, no faster.
SETTLED = 0.3


@dataclass(frozen=True)
class Accuracy:
    """The resolution that a relative tolerance asks of the climb to a maximum.

    Attributes
    ----------
    search
        Resolution of the climb over x.
    check
        A finer one for the value itself; the difference of the two is the error in time and angle.
    tolerance
        Relative accuracy asked for.
    hasty
        Whether one round may be enough where swt is smooth.
    """

    search: Resolution
    check: Resolution
    tolerance: float
    hasty: bool = True

    @classmethod
    def for_tolerance(cls, rtol: float) -> Accuracy:
        """The least effort that keeps the error below ``rtol``."""
        digits = -np.log10(rtol)
        # Four digits by the first zoom, and so many more by each further one.
        zooms = max(int(np.ceil((digits - 1.0) / DIGITS_PER_ZOOM)), 1)
        # Half as many instants more in the check; 5: 1e-5 at a point of tests/mechanics/test_overlooked.py.
        return cls(Resolution(4, zooms, digits + 1.0), Resolution(6, zooms + 1, digits + 2.5), rtol)

    def finer(self) -> Accuracy:
        """The same with twice the instants, closer looks at the extremes, and more rounds."""
        search, check = (replace(r, nodes=2 * r.nodes, zooms=r.zooms + 1) for r in (self.search, self.check))
        return replace(self, search=search, check=check, hasty=False)
