"""Two harmonic loads (eqs. 7, 8) and their common period, and the loads of parameter points.

φ = ω1 t/q for ω2/ω1 = p/q in lowest terms. With displacements prescribed the normal load is the indentation
depth δ/δ0, and the tangential load is G* u/(μ E* δ0). Phases that differ may give the same s, and points may
share one load or be solved together.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.load.harmonic_sum import even_instants
from swtstudy.mechanics.load.load import PERIOD, Load
from swtstudy.mechanics.numerics.arrays import ROUNDING, TINY, align, filled_rows
from swtstudy.mechanics.numerics.roots import Brackets, Function, monotone_roots, sign_changes
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray, IntArray, Points


@dataclass(frozen=True)
class BimodalLoad(Load):
    """n pairs of harmonic loads with the same frequency ratio p/q.

    Attributes
    ----------
    normal_amplitude, tangential_amplitude, phase
        Shape (n,): amplitudes over the normal load's mean, ψ in rad.
    p, q
        ω2/ω1 = p/q in lowest terms.
    """

    normal_amplitude: FloatArray
    tangential_amplitude: FloatArray
    phase: FloatArray
    p: int
    q: int

    def __len__(self) -> int:
        return len(self.phase)

    def normal(self, instant: FloatArray) -> FloatArray:
        d, psi = (align(v, instant) for v in (self.normal_amplitude, self.phase))
        return 1.0 + d * np.sin(self.q * instant + psi)

    def tangential(self, instant: FloatArray) -> FloatArray:
        return align(self.tangential_amplitude, instant) * np.sin(self.p * instant)

    def normal_rate(self, instant: FloatArray) -> FloatArray:
        d, psi = (align(v, instant) for v in (self.normal_amplitude, self.phase))
        return self.q * d * np.cos(self.q * instant + psi)

    def tangential_rate(self, instant: FloatArray) -> FloatArray:
        return self.p * align(self.tangential_amplitude, instant) * np.cos(self.p * instant)

    @property
    def least_normal(self) -> FloatArray:
        return 1.0 - self.normal_amplitude

    @property
    def largest_normal(self) -> FloatArray:
        return 1.0 + self.normal_amplitude

    @property
    def motion(self) -> FloatArray:
        return self.normal_amplitude + self.tangential_amplitude

    @property
    def has_tangential(self) -> BoolArray:
        return self.tangential_amplitude > 0.0

    @property
    def moves_tangentially(self) -> BoolArray:
        return self.has_tangential

    @property
    def oscillations(self) -> tuple[int, int]:
        return self.q, self.p

    @property
    def mirrored_half(self) -> bool:
        return self.q % 2 == 0

    def turning_instants(self) -> FloatArray:
        slip_lines = [_turning_points_of_slip_line(self, sign) for sign in (1.0, -1.0)]
        return np.sort(np.concatenate([self.normal_turning_instants(), *slip_lines], axis=1), axis=1)

    def normal_turning_instants(self) -> FloatArray:
        """The `turning_instants` at which the normal load turns, or contact is made or lost."""
        q, d = self.q, self.normal_amplitude
        quarter = np.pi * (np.arange(2 * q) + 0.5)
        columns = [np.mod((quarter - self.phase[:, None]) / q, PERIOD)]
        if np.any(d > 1.0):
            fall = np.arcsin(1.0 / np.maximum(d, 1.0))
            turns = 2.0 * np.pi * np.arange(q)
            for angle in (-fall, np.pi + fall):
                instants = np.mod((angle[:, None] + turns - self.phase[:, None]) / q, PERIOD)
                columns.append(np.where(d[:, None] > 1.0, instants, PERIOD))
        return np.sort(np.concatenate(columns, axis=1), axis=1)

    def branch(self, instant: FloatArray) -> IntArray:
        # Branch k is −π/2 ≤ qφ + ψ − 2πk ≤ π/2.
        turns = (self.q * instant + align(self.phase, instant)) / (2.0 * np.pi)
        return np.round(turns).astype(np.int64)

    def touch_down(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        return self._on_branch(self._sine(normal), branch)

    def growth_slope(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        rate, normal_rate = self.rates_at_touch_down(normal, branch)
        # At a common turning point of both loads the ratio is bounded by 1, as everywhere in stick.
        ratio = np.divide(rate, normal_rate, out=np.zeros_like(rate), where=normal_rate > TINY)
        return -np.clip(ratio, -1.0, 1.0)

    def rates_at_touch_down(self, normal: FloatArray, branch: IntArray) -> tuple[FloatArray, FloatArray]:
        """The rates of the tangential and the normal load at `touch_down`."""
        sine = self._sine(normal)
        normal_rate = self.q * align(self.normal_amplitude, normal) * np.sqrt(1.0 - sine * sine)
        return self.tangential_rate(self._on_branch(sine, branch)), normal_rate

    def passage(self, normal: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
        low, high, psi = begin[:, None], end[:, None], self.phase[:, None, None]
        middle = 0.5 * (low + high)
        angle = np.arcsin(self._sine(normal))[:, :, None]
        angle = np.where(self.normal_rate(middle) > 0.0, angle, np.pi - angle)
        angle = angle + 2.0 * np.pi * np.round((self.q * middle + psi - angle) / (2.0 * np.pi))
        found = np.clip((angle - psi) / self.q, low, high)
        beyond = np.abs(normal - 1.0) > self.normal_amplitude[:, None]
        return np.where(beyond[:, :, None], high, found)

    def _sine(self, normal: FloatArray) -> FloatArray:
        """sin(qφ + ψ) at the instants φ at which the normal load has the value."""
        d = align(self.normal_amplitude, normal)
        sine = np.divide(normal - 1.0, d, out=np.zeros_like(normal), where=d > TINY)
        return np.clip(sine, -1.0, 1.0)

    def _on_branch(self, sine: FloatArray, branch: IntArray) -> FloatArray:
        return (np.arcsin(sine) + 2.0 * np.pi * branch - align(self.phase, sine)) / self.q

    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        if self.p == self.q:
            # The root is in closed form.
            return Brackets(low, high, *(np.zeros_like(low),) * 4)
        return Brackets.of(self._slip_line(sense), low, high)

    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        if self.p == self.q:
            return self._harmonic_instant(sense, goal, brackets.low, brackets.high)
        return monotone_roots(self._slip_line(sense), goal, brackets)

    def _slip_line(self, sense: float) -> Function:
        """The slip line sense·tangential − normal of the loads, and two derivatives."""

        def line(instant: FloatArray, active: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
            d, psi = self.normal_amplitude[active], self.phase[active]
            u, ground = sense * self.tangential_amplitude[active], self.q * instant + psi
            own = self.p * instant
            u_sine, normal_sine = u * np.sin(own), d * np.sin(ground)
            slope = self.p * u * np.cos(own) - self.q * d * np.cos(ground)
            return u_sine - normal_sine - 1.0, slope, self.q**2 * normal_sine - self.p**2 * u_sine

        return line

    def _harmonic_instant(
        self, sense: float, goal: FloatArray, low: FloatArray, high: FloatArray
    ) -> FloatArray:
        """`slip_line_instant` for p = q = 1, where the slip line is C sin(φ − β) − 1."""
        a = sense * self.tangential_amplitude - self.normal_amplitude * np.cos(self.phase)
        b = self.normal_amplitude * np.sin(self.phase)
        size, shift = np.hypot(a, b), np.arctan2(b, a)
        sine = np.divide(goal + 1.0, size, out=np.zeros_like(goal), where=size > 0.0)
        angle = np.arcsin(np.clip(sine, -1.0, 1.0))
        middle = 0.5 * (low + high) - shift
        angle = np.where(np.cos(middle) >= 0.0, angle, np.pi - angle)
        angle = angle + 2.0 * np.pi * np.round((middle - angle) / (2.0 * np.pi))
        return np.clip(angle + shift, low, high)


def _turning_points_of_slip_line(load: BimodalLoad, sign: float) -> FloatArray:
    """Zeros of d(tangential − sign·normal)/dφ in a period, shape (n, k), filled up with its end."""
    p, q = load.p, load.q
    grid = even_instants(max(p, q))
    nodes = np.broadcast_to(grid, (len(load), grid.size))
    row, low, high = sign_changes(grid, load.tangential_rate(nodes) - sign * load.normal_rate(nodes))
    line = load.take(row)

    def rate(instant: FloatArray, active: IndexArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        one = line.take(active)
        slope = -p * p * one.tangential(instant) + sign * q * q * (one.normal(instant) - 1.0)
        own, normal_rate = one.tangential_rate(instant), one.normal_rate(instant)
        return own - sign * normal_rate, slope, sign * q * q * normal_rate - p * p * own

    roots = monotone_roots(rate, np.zeros(len(row)), Brackets.of(rate, low, high))
    return filled_rows(row, np.mod(roots, PERIOD), len(load), PERIOD)


def without_what_stands_still(
    constant: BoolArray, phase: FloatArray, p: IntArray, q: IntArray
) -> tuple[FloatArray, IntArray, IntArray]:
    """Phase and ω2/ω1 = p/q, each (n,): 0 and 1 for a constant normal load, which has neither."""
    return np.where(constant, 0.0, phase), np.where(constant, 1, p), np.where(constant, 1, q)


def fold_phase(phase: FloatArray, p: IntArray, q: IntArray) -> tuple[FloatArray, BoolArray]:
    """Fold ψ into one symmetry period of s(ψ): 2π/p for even q, π/p for odd q.

    Shifting time by π/ω2 flips u and mirrors x.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    p, q
        Shape (n,), ω2/ω1 = p/q in lowest terms.

    Returns
    -------
    folded, mirrored
        The equivalent phase in [0, period), and whether x and the plane's angle change sign with it.
    """
    period = np.where(q % 2 == 0, 2.0, 1.0) * np.pi / p
    turns = np.floor(phase / period + ROUNDING)
    folded = np.maximum(phase - turns * period, 0.0)
    mirrored = (q % 2 == 1) & (turns % 2 == 1)
    return folded, mirrored


def fold_bulk_phase(
    phase: FloatArray, moves: BoolArray, mirrored: BoolArray, both_ways: BoolArray
) -> tuple[FloatArray, BoolArray]:
    """Fold ψ_B of bulk stresses that oscillate with the tangential load, once ψ is folded.

    Mirroring x leaves a bulk stress as it is, but the shift of time by π/ω2 that flips u flips its
    oscillation, too.

    Parameters
    ----------
    phase
        Shape (n,), rad.
    moves
        Shape (n,): whether the bulk stress oscillates; elsewhere it has no phase.
    mirrored
        Shape (n,): where `fold_phase` mirrors x.
    both_ways
        Shape (n,): whether that shift of time leaves ψ as it is, so that ψ_B + π mirrors x.

    Returns
    -------
    folded, mirrored
        The equivalent ψ_B in [0, π) or [0, 2π), and whether x is mirrored by both folds together.
    """
    phase = phase + np.where(mirrored, np.pi, 0.0)
    period = np.where(both_ways, 1.0, 2.0) * np.pi
    turns = np.floor(phase / period + ROUNDING)
    folded = np.maximum(phase - turns * period, 0.0)
    return np.where(moves, folded, 0.0), mirrored ^ (moves & both_ways & (turns % 2 == 1))


def load_of(points: Points) -> Load:
    """The loads (eqs. 7, 8) of points that are alike, see `alike`."""
    if points.path is not None:
        return points.path.loads(points.normal_amplitude, points.tangential_amplitude)
    of_load = points.normal_amplitude, points.tangential_amplitude, points.phase
    return BimodalLoad(*of_load, int(points.p[0]), int(points.q[0]))


def alike(points: Points) -> list[IndexArray]:
    """Indices of points whose loads are one `Load`; within each, points with the same load are neighbours."""
    if not len(points):
        return []
    of_load = points.phase, points.tangential_amplitude, points.normal_amplitude
    order = np.lexsort((*of_load, points.p, points.q))
    ratio = np.stack([points.p, points.q])[:, order]
    return np.split(order, np.flatnonzero((np.diff(ratio, axis=1) != 0).any(axis=0)) + 1)


def largest_normal(points: Points) -> FloatArray:
    """The largest normal load of each point, shape (n,)."""
    largest = np.empty(len(points))
    for index in alike(points):
        largest[index] = load_of(points.take(index)).largest_normal
    return largest


def largest_turn_count(points: Points) -> int:
    """Largest number of turning instants that the load of points with equal shared columns can have."""
    if points.path is not None:
        return points.path.turn_count
    return 6 * int(max(points.p[0], points.q[0]))


def shared_load(points: Points) -> tuple[Load, IndexArray]:
    """The distinct loads of points that are alike, and which of them each point has."""
    table = np.stack([points.normal_amplitude, points.tangential_amplitude, points.phase], axis=1)
    _, first, number = np.unique(table, axis=0, return_index=True, return_inverse=True)
    return load_of(points.take(first)), number.reshape(-1)
