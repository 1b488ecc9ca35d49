"""Smooth loads, both of whose components are sums of harmonics, and such loops as their users define them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.load.harmonic_sum import HarmonicSum, even_instants
from swtstudy.mechanics.load.load import LARGEST, PERIOD, Load, Loop, checked_mean, checked_name, mean_of
from swtstudy.mechanics.numerics.arrays import ROUNDING, TINY, align, filled_rows
from swtstudy.mechanics.numerics.roots import Brackets, Function, monotone_roots, sign_changes
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray
from swtstudy.vocabulary.mistakes import Mistake, StudyError, is_number, literal, plain_number


@dataclass(frozen=True)
class SmoothLoad(Load):
    """n loads along one smooth loop: N = 1 + normal_amplitude c_n(φ), T = tangential_amplitude c_t(φ).

    Attributes
    ----------
    normal_sum, tangential_sum
        c_n and c_t.
    normal_amplitude, tangential_amplitude
        Shape (n,).
    """

    normal_sum: HarmonicSum
    tangential_sum: HarmonicSum
    normal_amplitude: FloatArray
    tangential_amplitude: FloatArray

    def __len__(self) -> int:
        return len(self.normal_amplitude)

    def normal(self, instant: FloatArray) -> FloatArray:
        return 1.0 + align(self.normal_amplitude, instant) * self.normal_sum.value(instant)

    def tangential(self, instant: FloatArray) -> FloatArray:
        return align(self.tangential_amplitude, instant) * self.tangential_sum.value(instant)

    def normal_rate(self, instant: FloatArray) -> FloatArray:
        return align(self.normal_amplitude, instant) * self.normal_sum.value(instant, 1)

    def tangential_rate(self, instant: FloatArray) -> FloatArray:
        return align(self.tangential_amplitude, instant) * self.tangential_sum.value(instant, 1)

    @property
    def least_normal(self) -> FloatArray:
        return 1.0 + self.normal_amplitude * self.normal_sum.ends[0]

    @property
    def largest_normal(self) -> FloatArray:
        return 1.0 + self.normal_amplitude * self.normal_sum.ends[1]

    @property
    def motion(self) -> FloatArray:
        normal, tangential = (0.5 * np.ptp(one.ends) for one in (self.normal_sum, self.tangential_sum))
        return np.asarray(normal * self.normal_amplitude + tangential * self.tangential_amplitude)

    @property
    def has_tangential(self) -> BoolArray:
        return (self.tangential_amplitude > 0.0) & any(self.tangential_sum.ends)

    @property
    def moves_tangentially(self) -> BoolArray:
        return (self.tangential_amplitude > 0.0) & (not self.tangential_sum.is_constant)

    @property
    def oscillations(self) -> tuple[int, int]:
        return max(len(self.normal_sum.turns) // 2, 1), max(self.tangential_sum.highest, self._order)

    @property
    def mirrored_half(self) -> bool:
        def only(one: HarmonicSum, parity: int) -> bool:
            return not np.any(one.amplitude[one.order % 2 != parity])

        return only(self.normal_sum, 0) and only(self.tangential_sum, 1)

    def turning_instants(self) -> FloatArray:
        n = len(self)
        # Where the normal load almost stops, what sticks changes its slope within little ground.
        common = np.concatenate([self.normal_sum.turns, self.normal_sum.slow_instants])
        columns = [np.broadcast_to(common, (n, common.size)), self._contact_changes()]
        columns += [self._turning_points_of_slip_line(sense) for sense in (1.0, -1.0)]
        return np.sort(np.concatenate(columns, axis=1), axis=1)

    def branch(self, instant: FloatArray) -> IntArray:
        return self.normal_sum.stretch(instant)

    def touch_down(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        if self.normal_sum.is_constant:
            return np.zeros(np.shape(normal))
        return self.normal_sum.inverse(self._course(normal), branch)

    def growth_slope(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        instant = self.touch_down(normal, branch)
        rate, normal_rate = self.tangential_rate(instant), self.normal_rate(instant)
        ratio = np.divide(rate, normal_rate, out=np.zeros_like(rate), where=normal_rate > TINY)
        return -np.clip(ratio, -1.0, 1.0)

    def passage(self, normal: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
        low, high = begin[:, None], end[:, None]
        middle = 0.5 * (low + high)
        shape = np.broadcast_shapes((*normal.shape, 1), low.shape)
        if self.normal_sum.is_constant:
            return np.broadcast_to(high, shape).copy()
        found = self.normal_sum.inverse(self._course(normal)[:, :, None], self.normal_sum.stretch(middle))
        found = found + PERIOD * np.round((middle - found) / PERIOD)
        moves = (self.normal_amplitude > TINY)[:, None, None]
        return np.where(moves, np.clip(found, low, high), high)

    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        return Brackets.of(self._slip_line(sense), low, high)

    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        return monotone_roots(self._slip_line(sense), goal, brackets)

    @property
    def _order(self) -> int:
        return max(self.normal_sum.highest, self.tangential_sum.highest)

    def _course(self, normal: FloatArray) -> FloatArray:
        """c_n at normal loads."""
        amplitude = align(self.normal_amplitude, normal)
        return np.divide(normal - 1.0, amplitude, out=np.zeros_like(normal), where=amplitude > TINY)

    def _contact_changes(self) -> FloatArray:
        """Instants at which contact is made or lost, shape (n, k), filled up with the period's end."""
        begin = self.normal_sum.at_turns
        if not begin.size or not np.any(self.least_normal < 0.0):
            return np.zeros((len(self), 0))
        level = self._course(np.zeros(len(self)))[:, None]
        end, stretch = np.roll(begin, -1), np.arange(begin.size)
        crosses = (level > np.minimum(begin, end)) & (level < np.maximum(begin, end))
        return np.where(crosses, np.mod(self.normal_sum.inverse(level, stretch), PERIOD), PERIOD)

    def _slip_line(self, sense: float, derivative: int = 0) -> Function:
        """A derivative of the slip line sense·tangential − normal of the loads, and two more of them."""

        def line(instant: FloatArray, active: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            n, t = self.normal_amplitude[active], sense * self.tangential_amplitude[active]
            values = [
                t * self.tangential_sum.value(instant, k) - n * self.normal_sum.value(instant, k)
                for k in range(derivative, derivative + 3)
            ]
            return values[0] - (derivative == 0), values[1], values[2]

        return line

    def _turning_points_of_slip_line(self, sense: float) -> FloatArray:
        """Zeros of d(sense·tangential − normal)/dφ in a period, shape (n, k), filled up with its end."""
        grid = even_instants(self._order)
        nodes = np.broadcast_to(grid, (len(self), grid.size))
        samples = sense * self.tangential_rate(nodes) - self.normal_rate(nodes)
        row, low, high = sign_changes(grid, samples)
        rate = self.take(row)._slip_line(sense, 1)
        roots = monotone_roots(rate, np.zeros(len(row)), Brackets.of(rate, low, high))
        return filled_rows(row, np.mod(roots, PERIOD), len(self), PERIOD)


#: Highest harmonic of a loop: that of the frequency ratio of two.
HIGHEST_ORDER = 64
#: Samples of a function for its harmonics.
SAMPLES = 1024


class SmoothPath(Loop):
    """A loop of sums of harmonics; see `LoadPath.harmonic_sum`."""

    def __init__(
        self, name: str, normal: object, tangential: object, bulk: object = (), *, mean_normal: object = None
    ) -> None:
        self.name = checked_name(name)
        self.mean_normal = checked_mean(mean_normal, self.name)
        columns = {"normal": normal, "tangential": tangential, "bulk": bulk}
        #: Rows of order, amplitude and phase of c_n, c_t and c_b.
        self.harmonics = {key: _checked(rows, f"{key} of {name}") for key, rows in columns.items()}
        if self._bulk_sum.ends == (0.0, 0.0):
            del self.harmonics["bulk"]
        if all(_sum_of(rows).is_constant for rows in self.harmonics.values()):
            raise StudyError([Mistake(f"harmonics of {name}", "nothing that changes", "a loop")])

    def content(self) -> dict[str, Any]:
        return dict(self.harmonics) | mean_of(self)

    @classmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> SmoothPath:
        rows = content["normal"], content["tangential"], content.get("bulk", ())
        return cls(name, *rows, mean_normal=content.get("mean_normal"))

    @property
    def cost(self) -> int:
        return 1 + self._order

    @property
    def normal_ends(self) -> tuple[float, float]:
        return self._sums[0].ends

    @property
    def tangential_ends(self) -> tuple[float, float]:
        return self._sums[1].ends

    @property
    def turn_count(self) -> int:
        return 8 * self._order

    def loads(self, normal_amplitude: FloatArray, tangential_amplitude: FloatArray) -> Load:
        return SmoothLoad(*self._sums, normal_amplitude, tangential_amplitude)

    @cached_property
    def _sums(self) -> tuple[HarmonicSum, HarmonicSum]:
        return _sum_of(self.harmonics["normal"]), _sum_of(self.harmonics["tangential"])

    @cached_property
    def _bulk_sum(self) -> HarmonicSum:
        return _sum_of(self.harmonics.get("bulk", ()))

    @property
    def bulk(self) -> HarmonicSum | None:
        return self._bulk_sum if "bulk" in self.harmonics else None

    @property
    def _order(self) -> int:
        return max(one.highest for one in (*self._sums, self._bulk_sum))


def sampled(name: str, course: Callable[[FloatArray], tuple[ArrayLike, ...]]) -> SmoothPath:
    """A smooth loop from a function; see `LoadPath.sampled`."""
    instant = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    try:
        columns = [np.broadcast_to(np.asarray(each, float), instant.shape) for each in course(instant)]
        if len(columns) not in (2, 3):
            raise ValueError(f"{len(columns)} columns")
    except (TypeError, ValueError) as error:
        allowed = "c_n and c_t, or c_n, c_t and c_b, each of the shape of φ"
        raise StudyError(
            [Mistake(f"course of {name}", f"a function that fails ({error})", allowed)]
        ) from None
    if not all(np.isfinite(each).all() for each in columns):
        raise StudyError([Mistake(f"course of {name}", "a value that is no finite number", "finite numbers")])
    return SmoothPath(name, *[_harmonics(each, name) for each in columns])


def _harmonics(values: FloatArray, name: str) -> list[tuple[int, float, float]]:
    """Order, amplitude and phase of the harmonics of even samples over a period."""
    found = np.fft.rfft(values) / len(values)
    found[1:] *= 2.0
    size = np.abs(found)
    kept = np.flatnonzero(size > ROUNDING * size.max(initial=0.0))
    if kept.max(initial=0) > HIGHEST_ORDER:
        beyond = f"harmonics beyond the order {HIGHEST_ORDER}, of up to {size[HIGHEST_ORDER + 1 :].max():.1g}"
        allowed = "a smooth loop; one with corners has vertices: LoadPath(name, vertices)"
        raise StudyError([Mistake(f"course of {name}", beyond, allowed)])
    # cos(kφ + β) = sin(kφ + β + π/2).
    return [(int(k), float(size[k]), float(np.angle(found[k]) + 0.5 * np.pi)) for k in kept]


def _sum_of(rows: Sequence[Sequence[float]]) -> HarmonicSum:
    order, amplitude, phase = np.array(rows, dtype=np.float64).reshape(-1, 3).T
    return HarmonicSum(order.astype(np.int64), amplitude, phase)


def _checked(rows: object, key: str) -> list[list[float]]:
    """Rows of order, amplitude and phase."""
    allowed = f"rows of order (a whole number up to {HIGHEST_ORDER}), amplitude and phase"
    if not isinstance(rows, Sequence | np.ndarray) or isinstance(rows, str):
        raise StudyError([Mistake(key, literal(rows), allowed)])
    for row in rows:
        sound = (
            isinstance(row, Sequence | np.ndarray) and len(row) == 3 and all(is_number(each) for each in row)
        )
        sound = sound and all(abs(plain_number(each)) <= LARGEST for each in row)
        if not (sound and row[0] == int(row[0]) and 0 <= row[0] <= HIGHEST_ORDER):
            raise StudyError([Mistake(key, literal(row), allowed)])
    return [[int(row[0]), float(row[1]), float(row[2])] for row in rows]
