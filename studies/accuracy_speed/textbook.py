"""The textbook method: springs marched on fixed grids, and brute force over everything else.

A curve in the chart of accuracy against speed, and an oracle of the tests: it shares nothing with the solver.
However fine, fixed grids see the stress's cusps only to √(step), unless `aligned`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import struve

from swtstudy.paper.formalisms import march_springs

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]
IndexArray = NDArray[np.intp]


#: A point: each number is an array of shape (1,) under its public name, the ``shape`` a table of them; its
#: ``profile`` is a name, and ω2/ω1 = ``p``/``q``.
Points = Any


def spring_depth(point: Points, radius: FloatArray) -> FloatArray:
    """g(ξ)/δ0 of the springs at the radius ξ/a_H (eq. 11), 0 on a face."""
    kappa = {name: value.item() for name, value in point.shape.items()}
    ξ, b = radius, kappa.get("flat_radius", 0.0)
    s = np.sqrt(np.maximum((ξ - b) * (ξ + b), 0.0))
    if point.profile == "wavy_paraboloid" and kappa["waviness_amplitude"]:
        h = kappa["waviness_amplitude"]
        k = 2.0 * np.pi / (kappa["wavelength"] * np.sqrt(h))
        return np.asarray(ξ**2 + 0.5 * np.pi * h * k * ξ * struve(0, k * ξ))
    if point.profile == "power_law":
        return np.asarray(ξ ** kappa["exponent"])
    if point.profile == "truncated_paraboloid":
        return np.asarray(ξ * s)
    return np.asarray(ξ * (s - b * np.arctan2(s, b)))


def radius_at(point: Points, depth: float) -> float:
    """The radius at which springs have a depth, by bisection; the radius of the face at 0."""
    b = point.shape["flat_radius"].item() if "flat_radius" in point.shape else 0.0
    if depth <= 0.0:
        return float(b)
    low, high = b, b + 1.0
    while spring_depth(point, np.array([high]))[0] < depth:
        high += 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        below = spring_depth(point, np.array([middle]))[0] < depth
        low, high = (middle, high) if below else (low, middle)
    return float(high)


class TextbookSolution(NamedTuple):
    """s, the critical point x/a_H, signed, and the angle of the critical plane's normal to x, degrees."""

    s: float
    critical_x: float
    critical_angle: float


def textbook_s(
    point: Points, springs: int, steps: int, positions: int, planes: int, aligned: bool = False
) -> TextbookSolution:
    """s of one point (eqs. 7–20): a lower bound but for the error of the stress between springs.

    Parameters
    ----------
    point
        A batch of one point.
    springs, steps
        Cells between springs, and uniform time steps of a period.
    positions, planes
        Positions on each side, the last at the largest contact radius, and planes evenly spread over 180°.
    aligned
        Add the instants of the events at the positions (turning points, edge passages, slip onsets), and the
        position of the smallest contact radius.
    """
    course = _Course.of(point)
    # Springs are evenly spread in √(ξ² − b²), in which every profile's g is smooth.
    smallest, largest = (radius_at(point, depth) for depth in (max(1.0 - course.d, 0.0), 1.0 + course.d))
    b = radius_at(point, 0.0)
    radius = np.sqrt(b**2 + np.linspace(0.0, np.sqrt(largest**2 - b**2), springs + 1) ** 2)
    at = np.linspace(0, springs, positions + 1)[1:].astype(int)
    if aligned:
        nearest = 1 + int(np.abs(radius[1:] - smallest).argmin())
        radius[nearest] = max(smallest, 0.5 * radius[1])
        at = np.union1d(at, nearest)
    g = spring_depth(point, radius)
    time = np.linspace(0.0, 2.0 * np.pi, steps + 1)
    if aligned:
        time = _with_events(_with_turns(time, course), course, g[at])
    w, tau = march_springs(g, course.depth(time), course.displacement(time))
    position = radius[at]
    bulk_mean, bulk_amplitude, bulk_phase = (
        v.item() for v in (point.bulk_stress_mean, point.bulk_stress_amplitude, point.bulk_stress_phase)
    )
    if bulk_mean or bulk_amplitude:
        position = np.concatenate([position, largest * np.geomspace(1.001, 100.0, positions)])
    sigma = surface_stresses(radius, position, w, tau, point)
    sigma = sigma[0] + bulk_mean + bulk_amplitude * np.sin(course.p * time + bulk_phase), *sigma[1:]
    s, side, k, angle = brute_force(sigma, point.poisson_ratio.item(), planes, point.walker_exponent.item())
    return TextbookSolution(s, float(side * position[k]), angle)


class _Course(NamedTuple):
    """The two oscillations of the load."""

    d: float
    u0: float
    psi: float
    p: int
    q: int

    @classmethod
    def of(cls, point: Points) -> _Course:
        d, u0, psi = point.normal_amplitude, point.tangential_amplitude, point.phase
        return cls(d.item(), u0.item(), psi.item(), int(point.p[0]), int(point.q[0]))

    def depth(self, time: FloatArray) -> FloatArray:
        return 1.0 + self.d * np.sin(self.q * time + self.psi)

    def displacement(self, time: FloatArray) -> FloatArray:
        return self.u0 * np.sin(self.p * time)

    def rates(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Rates of the displacement and of the depth."""
        pull = self.p * self.u0 * np.cos(self.p * time)
        return pull, self.q * self.d * np.cos(self.q * time + self.psi)


def _with_turns(time: FloatArray, course: _Course) -> FloatArray:
    """The instants, and the instants at which u, δ, u + δ or u − δ turns."""
    mixes = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, -1.0]])
    falls = mixes @ np.stack(course.rates(time)) < 0.0
    mix, step = np.nonzero(falls[:, 1:] != falls[:, :-1])
    (a, c), fell = mixes[mix].T, falls[mix, step]

    def same_sense(t: FloatArray) -> BoolArray:
        pull, push = course.rates(t)
        return (a * pull + c * push < 0.0) == fell

    return np.union1d(time, bisect(same_sense, time, step))


def _with_events(time: FloatArray, course: _Course, g: FloatArray) -> FloatArray:
    """The instants, and the instants at which the edge passes springs, and at which they begin to slip."""
    depth, displacement = course.depth, course.displacement
    edge = depth(time)[:, None] > g
    step, where = np.nonzero(edge[1:] != edge[:-1])
    touched = edge[step, where]
    time = np.union1d(time, bisect(lambda t: (depth(t) > g[where]) == touched, time, step))
    w, tau = march_springs(g, depth(time), displacement(time))
    held = displacement(time)[:, None] - tau
    step, begins = np.nonzero((np.abs(tau) < w)[:-1] & (np.abs(np.diff(held, axis=0)) > 1e-14))
    held = held[step, begins]
    onset = bisect(lambda t: np.abs(displacement(t) - held) < depth(t) - g[begins], time, step)
    return np.union1d(time, onset)


def bisect(before: Callable[[FloatArray], BoolArray], time: FloatArray, step: IndexArray) -> FloatArray:
    """Instants within the given steps of ``time`` until which ``before`` holds."""
    low, high = time[step], time[step + 1]
    for _ in range(50):
        middle = 0.5 * (low + high)
        holds = before(middle)
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    return high


def surface_stresses(
    radius: FloatArray, position: FloatArray, w: FloatArray, tau: FloatArray, point: Points
) -> tuple[FloatArray, ...]:
    """Stress at r = ``position``, (X, T): product integration with w and τ linear between springs.

    Returns σ_xx, σ_yy, σ_zz by the normal load, and σ_xx, σ_yy, σ_xz by the tangential load at x = +r.
    """
    nu, mu = point.poisson_ratio.item(), point.friction.item()
    r = position[:, None]
    outside, inside = np.maximum(radius / r, 1.0), np.minimum(radius / r, 1.0)
    area = np.arccosh(outside)  # ∫ dξ/√(ξ²−r²)
    load = radius**2 - r**2 * (outside * np.sqrt(outside**2 - 1.0) - area)  # ∫ 2 (ξ − √(ξ²−r²)) dξ
    cosine = np.sqrt(1.0 - inside**2)  # ξ = r sin φ
    first, third = -2.0 * cosine, -2.0 * cosine + (2.0 / 3.0) * cosine**3  # ∫ 2 sin φ dφ, ∫ 2 sin³φ dφ

    def integral(kernel: FloatArray, values: FloatArray) -> FloatArray:
        return np.diff(kernel, axis=1) @ (np.diff(values, axis=1) / np.diff(radius)).T

    pressure, force = -integral(area, w) / np.pi, -integral(load, w)
    spread = 0.5 * (1.0 - 2.0 * nu) * force / (np.pi * r * r)
    pull, pull_3 = (mu / np.pi * integral(kernel, tau) for kernel in (first, third))
    normal = spread - pressure, -spread - 2.0 * nu * pressure, -pressure
    return *normal, (1.0 + nu) * pull - nu * pull_3, nu * pull_3, mu / np.pi * integral(area, tau)


def brute_force(
    sigma: tuple[FloatArray, ...], nu: float, planes: int, exponent: float = 0.5
) -> tuple[float, float, int, float]:
    """Largest swt (eq. 9, or Walker's) over sides, positions and planes: with side, position and angle."""
    n_xx, n_yy, zz, t_xx, t_yy, t_xz = sigma
    best = (-1.0, 1.0, 0, 0.0)
    for side in (1.0, -1.0):
        xx, yy = n_xx + side * t_xx, n_yy + side * t_yy
        for angle in np.pi * (np.arange(planes) / planes - 0.5):
            n_x, n_z = np.cos(angle), np.sin(angle)
            stress = xx * n_x**2 + zz * n_z**2 + 2.0 * t_xz * n_x * n_z
            strain = ((1.0 + nu) * stress - nu * (xx + yy + zz)) / (1.0 - nu**2)
            tension, swing = np.maximum(stress.max(axis=1), 0.0), 0.5 * np.ptp(strain, axis=1) * (1.0 - nu**2)
            swt = tension ** (2.0 - 2.0 * exponent) * swing ** (2.0 * exponent) / (1.0 - nu**2)
            if swt.max() > best[0]:
                best = float(swt.max()), side, int(swt.argmax()), float(np.degrees(angle))
    return best
