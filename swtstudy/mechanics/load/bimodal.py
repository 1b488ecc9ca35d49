"""The bimodal load protocol (eqs. 7, 8), its common period and its symmetry in the phase.

Time is the angle φ = ω1 t/q of the common period, 0 ≤ φ < 2π, for ω2/ω1 = p/q in lowest terms. The
indentation depth is measured in δ0, the tangential displacement as G* u/(μ E* δ0).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.numerics.arrays import filled_rows
from swtstudy.mechanics.numerics.roots import Brackets, Function, monotone_roots
from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class Protocol:
    """n load protocols with the same frequency ratio p/q.

    Attributes
    ----------
    normal_amplitude, tangential_amplitude, phase
        Shape (n,): δA/δ0, G*uA/(μE*δ0), ψ in rad.
    p, q
        ω2/ω1 = p/q in lowest terms.

    Notes
    -----
    The methods take instants φ of shape (n, …) and return arrays of the same shape.
    """

    normal_amplitude: FloatArray
    tangential_amplitude: FloatArray
    phase: FloatArray
    p: int
    q: int

    def __len__(self) -> int:
        return len(self.phase)

    def take(self, index: NDArray[np.intp]) -> Protocol:
        """The protocols at ``index``, repetitions allowed."""
        return Protocol(
            self.normal_amplitude[index], self.tangential_amplitude[index], self.phase[index], self.p, self.q
        )

    def depth(self, instant: FloatArray) -> FloatArray:
        """Indentation depth δ/δ0 (eq. 7)."""
        d, psi = (_expand(v, instant) for v in (self.normal_amplitude, self.phase))
        return 1.0 + d * np.sin(self.q * instant + psi)

    def displacement(self, instant: FloatArray) -> FloatArray:
        """Tangential displacement G* u/(μ E* δ0) (eq. 8)."""
        return _expand(self.tangential_amplitude, instant) * np.sin(self.p * instant)

    def depth_rate(self, instant: FloatArray) -> FloatArray:
        """dδ/dφ."""
        d, psi = (_expand(v, instant) for v in (self.normal_amplitude, self.phase))
        return self.q * d * np.cos(self.q * instant + psi)

    def displacement_rate(self, instant: FloatArray) -> FloatArray:
        """du/dφ."""
        return self.p * _expand(self.tangential_amplitude, instant) * np.cos(self.p * instant)

    def touch_down(self, depth: FloatArray, branch: FloatArray) -> FloatArray:
        """Instant at which the depth is reached on a rising branch of δ.

        ``branch`` is 2πk for the branch −π/2 ≤ qφ + ψ − 2πk ≤ π/2.
        """
        return self._on_branch(self._sine(depth), branch)

    def growth_slope(self, depth: FloatArray, branch: FloatArray) -> FloatArray:
        """dτ/dG = −u̇/δ̇ that growth in stick leaves at the depth, on a branch as of `touch_down`."""
        sine = self._sine(depth)
        d = _expand(self.normal_amplitude, depth)
        depth_rate = self.q * d * np.sqrt(1.0 - sine * sine)
        rate = self.displacement_rate(self._on_branch(sine, branch))
        # At a common turning point of u and δ the ratio is bounded by 1, as everywhere in stick.
        ratio = np.divide(rate, depth_rate, out=np.zeros_like(rate), where=depth_rate > 1e-300)
        return -np.clip(ratio, -1.0, 1.0)

    def _sine(self, depth: FloatArray) -> FloatArray:
        """sin(qφ + ψ) at the instants φ with the depth."""
        d = _expand(self.normal_amplitude, depth)
        # Amplitudes below this do not move δ at all.
        sine = np.divide(depth - 1.0, d, out=np.zeros_like(depth), where=d > 1e-300)
        return np.clip(sine, -1.0, 1.0)

    def _on_branch(self, sine: FloatArray, branch: FloatArray) -> FloatArray:
        return (np.arcsin(sine) + branch - _expand(self.phase, sine)) / self.q

    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        """Ranges of instants, each of shape (n,), in which the slip line sense·u − δ is monotone."""
        return Brackets.of(self._slip_line(sense), low, high)

    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        """Instant at which the slip line has the value goal, of shape (n,), in each of n brackets.

        Where the goal is not reached, the nearer end.
        """
        if self.p == self.q:
            return self._harmonic_instant(sense, goal, brackets.low, brackets.high)
        return monotone_roots(self._slip_line(sense), goal, brackets)

    def _slip_line(self, sense: float) -> Function:
        """The slip line sense·u − δ of the protocols, and two derivatives."""

        def line(instant: FloatArray, active: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, FloatArray]:
            d, psi = self.normal_amplitude[active], self.phase[active]
            u, ground = sense * self.tangential_amplitude[active], self.q * instant + psi
            own = self.p * instant
            u_sine, depth_sine = u * np.sin(own), d * np.sin(ground)
            slope = self.p * u * np.cos(own) - self.q * d * np.cos(ground)
            return u_sine - depth_sine - 1.0, slope, self.q**2 * depth_sine - self.p**2 * u_sine

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


def _expand(values: FloatArray, like: FloatArray) -> FloatArray:
    """Append axes to ``values`` of shape (n,) so that it broadcasts against ``like`` of shape (n, …)."""
    return values.reshape(values.shape + (1,) * (like.ndim - 1))


def turning_instants(protocol: Protocol) -> FloatArray:
    """All instants at which δ, u − δ or u + δ turns, or contact is made or lost, sorted.

    Returns
    -------
    Shape (n, k), within [0, 2π]; rows with fewer instants are filled up with 2π.
    """
    q = protocol.q
    quarter = np.pi * (np.arange(2 * q) + 0.5)
    columns = [np.mod((quarter - protocol.phase[:, None]) / q, 2.0 * np.pi)]
    columns += [_turning_points_of_slip_line(protocol, sign) for sign in (1.0, -1.0)]
    d = protocol.normal_amplitude
    if np.any(d > 1.0):
        fall = np.arcsin(1.0 / np.maximum(d, 1.0))
        turns = 2.0 * np.pi * np.arange(q)
        for angle in (-fall, np.pi + fall):
            instants = np.mod((angle[:, None] + turns - protocol.phase[:, None]) / q, 2.0 * np.pi)
            columns.append(np.where(d[:, None] > 1.0, instants, 2.0 * np.pi))
    return np.sort(np.concatenate(columns, axis=1), axis=1)


def _turning_points_of_slip_line(protocol: Protocol, sign: float) -> FloatArray:
    """Zeros of d(u − sign·δ)/dφ in [0, 2π], shape (n, k), filled up with 2π."""
    order = max(protocol.p, protocol.q)
    # The offset keeps nodes off the zeros of symmetric protocols.
    step = 2.0 * np.pi / (24 * order)
    grid = np.asarray(step * np.arange(24 * order + 2) + 0.0123 / order, dtype=np.float64)
    nodes = np.broadcast_to(grid, (len(protocol), grid.size))
    rates = protocol.displacement_rate(nodes) - sign * protocol.depth_rate(nodes)

    row, cell = np.nonzero((rates[:, :-1] < 0.0) != (rates[:, 1:] < 0.0))
    low, high = grid[cell], grid[cell + 1]
    # A close pair of zeros inside a cell pair shows as a parabola whose vertex crosses zero.
    left, mid, right = rates[:, :-2], rates[:, 1:-1], rates[:, 2:]
    curvature = left - 2.0 * mid + right
    with np.errstate(divide="ignore", invalid="ignore"):
        offset = 0.5 * (left - right) / curvature
        vertex = mid - 0.25 * (left - right) * offset
        pair = (left * mid > 0.0) & (mid * right > 0.0) & (vertex * mid < 0.0) & (abs(offset) <= 1.0)
    pair_row, pair_cell = np.nonzero(pair)
    if pair_row.size:
        split = grid[pair_cell + 1] + step * offset[pair_row, pair_cell]
        row = np.concatenate([row, pair_row, pair_row])
        low = np.concatenate([low, grid[pair_cell], split])
        high = np.concatenate([high, split, grid[pair_cell + 2]])

    line = protocol.take(row)
    p, q = protocol.p, protocol.q

    def rate(instant: FloatArray, active: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, FloatArray]:
        one = line.take(active)
        slope = -p * p * one.displacement(instant) + sign * q * q * (one.depth(instant) - 1.0)
        u_rate, depth_rate = one.displacement_rate(instant), one.depth_rate(instant)
        return u_rate - sign * depth_rate, slope, sign * q * q * depth_rate - p * p * u_rate

    roots = monotone_roots(rate, np.zeros(len(row)), Brackets.of(rate, low, high))
    return filled_rows(row, np.mod(roots, 2.0 * np.pi), len(protocol), 2.0 * np.pi)
