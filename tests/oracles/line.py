"""s of one point by a dense evaluation of the surface line that shares nothing with the package.

The offsets o(G) of the springs, at depth G or at the load N of a radius, are one polygon: growth in stick is
cut into many chords, and slip clips it by α + G from below and by β − G from above, α = v − n and β = v + n.
Between two turning points of n, v, n + v and n − v that is exact at every instant. Stresses are the textbook
integrals over ξ with their singular ends substituted away, cumulated once for each position. Positions,
planes and instants are plain grids, aligned at what passes a position, and finer ones about the highest.

Lengths in a_H, depths in δ0, stresses in E* √(δ0/R). What is defined by a table has a radius and a height,
what is a loop has vertices.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.special import j0, struve

Array = NDArray[np.float64]
#: Gauss's nodes of a cell, and cells of the tables over s and of the running integrals.
_NODE, _WEIGHT = np.polynomial.legendre.leggauss(6)
CELLS, RUNNING = 20_000, 400
#: Places on which one is as good as on another, over the largest radius.
SAME = 1e-12


@dataclass(frozen=True)
class Profile:
    """A profile by m = g′ s over s = √(ξ² − b²), or N′ s of a strip, in tables over s.

    Attributes
    ----------
    m, b, strip, waves
        The function; the flat's radius; whether it is a strip; how often m turns on a length of 1.
    s, m_at, depth, load
        Shape (k,): s, m, G, and N over that at G = 1; of strips both are N over its mean.
    mean
        N there, in E* δ0 a_H or E* δ0.
    """

    m: Callable[[Array], Array]
    b: float
    strip: bool
    waves: float
    s: Array
    m_at: Array
    depth: Array
    load: Array
    mean: float

    @classmethod
    def of(cls, arguments: Mapping[str, Any], force: bool, largest: float) -> Profile:
        """The profile of a point up to the depth, or the load, ``largest``."""
        m, b, strip, waves = _shape(arguments)
        end = np.hypot(1.0, np.sqrt(b))
        while True:
            s = end * np.linspace(0.0, 1.0, CELLS + 1) ** 2
            at = 0.5 * (s[1:] + s[:-1])[:, None] + 0.5 * np.diff(s)[:, None] * _NODE
            values, half = m(at), 0.5 * np.diff(s)
            load, depth = (
                np.append(0.0, np.cumsum(half * (of @ _WEIGHT))) for of in (values, values / np.hypot(at, b))
            )
            mean = 0.25 * pi if strip else 1.0
            if strip:
                load = depth = depth / mean
            elif depth[-1] > 1.0:
                k = int(np.searchsorted(depth, 1.0))
                share = np.interp(1.0, depth[k - 1 : k + 1], [0.0, 1.0])
                # One step of Newton's method from the chord.
                at_mean = s[k - 1] + share * (s[k] - s[k - 1])
                for _ in range(3):
                    on = s[k - 1] + 0.5 * (at_mean - s[k - 1]) * (1.0 + _NODE)
                    found = depth[k - 1] + 0.5 * (at_mean - s[k - 1]) * (m(on) / np.hypot(on, b)) @ _WEIGHT
                    at_mean -= (found - 1.0) * np.hypot(at_mean, b) / m(np.array([at_mean]))[0]
                on = s[k - 1] + 0.5 * (at_mean - s[k - 1]) * (1.0 + _NODE)
                mean = float(load[k - 1] + 0.5 * (at_mean - s[k - 1]) * m(on) @ _WEIGHT)
                load = load / mean
            if (load if force else depth)[-1] > 1.01 * largest and depth[-1] > 1.0:
                return cls(m, b, strip, waves, s, m(s), depth, load, mean)
            end *= 1.15

    @cached_property
    def coordinates(self) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Depth, and load, at the nodes, each with its derivative over s."""
        slope = self.m_at / np.maximum(np.hypot(self.s, self.b), 1e-300)
        if self.b == 0.0:
            slope[0] = 0.0 if slope[1] < slope[2] else slope[1]
        if self.strip:
            return ((self.depth, slope / self.mean),) * 2
        return (self.depth, slope), (self.load, self.m_at / self.mean)

    def s_at(self, force: bool, value: Array) -> Array:
        """s at depths or loads, by Newton's method on cubics."""
        known, slope = self.coordinates[force]
        value = np.clip(value, 0.0, known[-1])
        k = np.clip(np.searchsorted(known, value, "right") - 1, 0, CELLS - 1)
        low, step = self.s[k], self.s[k + 1] - self.s[k]
        y0, y1, d0, d1 = known[k], known[k + 1], slope[k] * step, slope[k + 1] * step
        x = np.clip((value - y0) / np.maximum(y1 - y0, 1e-300), 0.0, 1.0)
        for _ in range(3):
            y, d = _cubic(x, y0, y1, d0, d1)
            x = np.clip(x - (y - value) / np.maximum(d, 1e-300), 0.0, 1.0)
        return np.asarray(low + step * x)

    def value_at(self, force: bool, s: Array) -> Array:
        """Depth or load at s."""
        known, slope = self.coordinates[force]
        k = np.clip((np.sqrt(s / self.s[-1]) * CELLS).astype(int), 0, CELLS - 1)
        step = self.s[k + 1] - self.s[k]
        x = np.clip((s - self.s[k]) / step, 0.0, 1.0)
        return _cubic(x, known[k], known[k + 1], slope[k] * step, slope[k + 1] * step)[0]


def _cubic(x: Array, y0: Array, y1: Array, d0: Array, d1: Array) -> tuple[Array, Array]:
    """The cubic of two values and two slopes on 0…1, and its derivative."""
    rise = y1 - y0
    a, c = d0 - rise, rise - d1
    y = y0 + rise * x + x * (1.0 - x) * (a * (1.0 - x) + c * x)
    d = rise + (1.0 - 2.0 * x) * (a * (1.0 - x) + c * x) + x * (1.0 - x) * (c - a)
    return y, d


def _shape(arguments: Mapping[str, Any]) -> tuple[Callable[[Array], Array], float, bool, float]:
    """m(s), b, whether it is a strip, and how often it turns on a length of 1."""
    name = arguments["profile"]
    b = float(arguments.get("flat_radius", arguments.get("flat_half_width", 0.0)))
    n = float(arguments.get("exponent", 2.0))
    if not isinstance(name, str):
        return (*_tabulated(name), False, 20.0)
    if name.startswith("wavy"):
        h = float(arguments["waviness_amplitude"])
        k = 2.0 * pi / (float(arguments["wavelength"]) * np.sqrt(h)) if h else 0.0
        if name == "wavy_cylinder":  # N = πξ²/4 + (π/2) h k ξ J1(kξ)
            return lambda s: 0.5 * pi * s * s * (1.0 + h * k * k * j0(k * s)), 0.0, True, k
        return (
            lambda s: (
                s * (2.0 * s + 0.5 * pi * h * k * (struve(0, k * s) + k * s * (2.0 / pi - struve(1, k * s))))
            ),
            0.0,
            False,
            k,
        )
    functions: dict[str, Callable[[Array], Array]] = {
        "paraboloid": lambda s: 2.0 * s * s,
        "rounded_punch": lambda s: s * (2.0 * s - b * np.arctan2(s, b)),
        "truncated_paraboloid": lambda s: 2.0 * s * s + b * b,
        "power_law": lambda s: n * s**n,
        "cylinder": lambda s: 0.5 * pi * s * s,
        "rounded_flat": lambda s: s * np.hypot(s, b) * np.arctan2(s, b),
        "power_law_cylinder": lambda s: 0.25 * pi * n * s**n,
    }
    strip = name in ("cylinder", "rounded_flat", "power_law_cylinder")
    return (
        functions[name],
        b if name in ("rounded_punch", "truncated_paraboloid", "rounded_flat") else 0.0,
        strip,
        0.0,
    )


def _tabulated(table: Any) -> tuple[Callable[[Array], Array], float]:
    """m and b of a table: the cubic spline through it, which behind a face begins where √f would be 0."""
    r, f = np.array(table.radius, float), np.array(table.height, float)
    face = int(np.argmax(f != 0.0)) - 1
    r, f = r[face:].copy(), f[face:]
    if face > 0:
        rise = np.sqrt(f[1:3])
        r[0] = np.clip(r[1] - rise[0] * (r[2] - r[1]) / (rise[1] - rise[0]), r[0], r[1] - 0.1 * (r[1] - r[0]))
    spline = CubicSpline(r, f, bc_type=((1, 0.0), "not-a-knot"))
    # (r f′)′ = c0 + c1 r + c2 r² on each piece.
    c3, c2, c1, _ = spline.c
    x = spline.x[:-1]
    one, two, three = c1 - 2.0 * c2 * x + 3.0 * c3 * x * x, 2.0 * c2 - 6.0 * c3 * x, 3.0 * c3
    ends = np.append(x, np.inf)

    def m(s: Array) -> Array:
        ξ = np.maximum(np.hypot(s, r[0]), 1e-12)[..., None]
        at = np.minimum(ends, ξ)
        angle, root = np.arcsin(np.minimum(at / ξ, 1.0)), np.sqrt(np.maximum(ξ * ξ - at * at, 0.0))
        first = np.diff(angle)
        second = -np.diff(root)
        third = np.diff(0.5 * ξ * ξ * angle - 0.5 * at * root)
        return np.asarray(s * (one * first + 2.0 * two * second + 3.0 * three * third).sum(axis=-1))

    return m, float(r[0])


@dataclass(frozen=True)
class Course:
    """The load over one cycle, as the diagram sees it: n and v of the time, and where they turn.

    ``turns`` has the first and the last instant; ``straight`` loads are linear in between.
    """

    n: Callable[[Array], Array]
    v: Callable[[Array], Array]
    bulk: Callable[[Array], Array]
    turns: Array
    straight: bool

    @classmethod
    def of(cls, arguments: Mapping[str, Any], profile: Profile) -> Course:
        """The course of a point."""
        by_force = "normal_force_amplitude" in arguments
        force = "tangential_force_amplitude" in arguments
        deep = float(arguments["normal_force_amplitude" if by_force else "normal_amplitude"])
        far = float(arguments["tangential_force_amplitude" if force else "tangential_amplitude"])
        pull, mean, turn = (
            float(arguments.get(f"bulk_stress_{of}", 0.0)) for of in ("amplitude", "mean", "phase")
        )
        path = arguments.get("load")
        if path is not None:
            corners = np.array(path.vertices, float)
            corners = np.vstack([corners, corners[:1]])
            at = np.arange(len(corners)) * 1.0

            def column(k: int, mean: float, amplitude: float) -> Callable[[Array], Array]:
                return lambda t: np.asarray(mean + amplitude * np.interp(t, at, corners[:, k]))

            of_bulk = column(2, mean, pull) if corners.shape[1] > 2 else column(0, mean, 0.0)
            return cls(column(0, 1.0, deep), column(1, 0.0, far), of_bulk, at, True)
        ratio, phase = Fraction(str(arguments["frequency_ratio"])), float(arguments["phase"])
        p, q = ratio.numerator, ratio.denominator

        def given(t: Array) -> Array:
            return np.asarray(1.0 + deep * np.sin(q * t + phase))

        def n(t: Array) -> Array:
            if by_force == force or profile.strip:
                return given(t)
            return profile.value_at(force, profile.s_at(by_force, given(t)))

        def v(t: Array) -> Array:
            return np.asarray(far * np.sin(p * t))

        def rates(t: Array) -> tuple[Array, Array]:
            rise = q * deep * np.cos(q * t + phase)
            if by_force != force and not profile.strip:
                s = profile.s_at(by_force, given(t))
                ξ = np.hypot(s, profile.b)
                rise = rise * (ξ / profile.mean if force else profile.mean / ξ)
            return rise, p * far * np.cos(p * t)

        turns = _turns(rates, p + q)
        return cls(n, v, lambda t: mean + pull * np.sin(p * t + turn), turns, False)


def _turns(rates: Callable[[Array], tuple[Array, Array]], terms: int) -> Array:
    """Instants at which n, v, n + v or n − v turns, with 0 and 2π."""
    t = np.linspace(0.0, 2.0 * pi, 1500 * terms + 1)
    found = [np.array([0.0, 2.0 * pi])]
    for a, c in ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, -1.0)):

        def rate(at: Array, a: float = a, c: float = c) -> Array:
            rise, pull = rates(at)
            return np.asarray(a * rise + c * pull)

        sign = rate(t) > 0.0
        step = np.flatnonzero(sign[1:] != sign[:-1])
        found.append(
            _bisect(lambda at, rate=rate, of=sign[step]: (rate(at) > 0.0) == of, t[step], t[step + 1])
        )
    turns = np.sort(np.concatenate(found))
    return turns[np.append(True, np.diff(turns) > 1e-13)]


def _bisect(before: Callable[[Array], NDArray[np.bool_]], low: Array, high: Array, rounds: int = 52) -> Array:
    """Where ``before`` ends to hold."""
    low, high = low + 0.0, high + 0.0
    for _ in range(rounds):
        middle = 0.5 * (low + high)
        holds = before(middle)
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    return high


@dataclass(frozen=True)
class Interval:
    """The time between two turning points, whether ground grows in stick there, and the polygon o(G).

    If it grows, the polygon is the one at the end, of which an instant has the part up to n. Otherwise it is
    the one at the start, and slip clips it.
    """

    begin: float
    end: float
    grows: bool
    G: Array
    o: Array

    def front(self, n: Array, v: Array) -> tuple[Array, Array]:
        """G from which on springs slip, and the slope of o there, at instants."""
        if self.grows:
            return n, np.zeros_like(n)
        lower = np.minimum.accumulate(self.o - self.G)[::-1]
        upper = np.maximum.accumulate(self.o + self.G)
        up, down = np.interp(v - n, lower, self.G[::-1]), np.interp(v + n, upper, self.G)
        rises = (up < down) | ((up == down) & (v > self.o[-1]))
        return np.minimum(np.minimum(up, down), n), np.where(rises, 1.0, -1.0)


def _intervals(course: Course, chords: int, about: float | None, reach: float) -> list[Interval]:
    """The stationary cycle: the second one after the body was pressed on and moved to where it begins."""
    t = course.turns
    n, v = course.n(t), course.v(t)
    G = np.array([0.0, n[0]])
    rest = Interval(t[0], t[0], False, G, np.zeros(2))
    G, o = _clipped(rest, n[0], v[0])
    for _ in range(2):
        found = []
        for k in range(len(t) - 1):
            rise, pull = n[k + 1] - n[k], v[k + 1] - v[k]
            grows = rise > 0.0 and abs(pull) <= rise
            if grows:
                at = np.array([t[k], t[k + 1]])
                if not course.straight:
                    at = _graded(course, t[k], t[k + 1], chords, about, reach)
                new_G, new_o = course.n(at[1:]), course.v(at[1:])
                G, o = np.append(G, new_G), np.append(o, new_o)
                keep = np.append(True, np.diff(np.maximum.accumulate(G)) > 1e-15)
                G, o = G[keep], o[keep]
            found.append(Interval(t[k], t[k + 1], grows, G, o))
            if not grows:
                G, o = _clipped(found[-1], n[k + 1], v[k + 1])
    return found


def _graded(
    course: Course, begin: float, end: float, chords: int, about: float | None, reach: float
) -> Array:
    """Instants of the chords: cosine-spaced, and ever closer to that at which a spring is touched."""
    t = begin + (end - begin) * (0.5 - 0.5 * np.cos(pi * np.linspace(0.0, 1.0, chords + 1)))
    if about is None:
        return t
    n = course.n(np.array([begin, end]))
    if n[0] - reach < about < n[1] + reach:
        touch = np.clip(about, *n)
        at = _bisect(lambda of: course.n(of) < touch, np.array([begin]), np.array([end]))[0]
        close = (end - begin) * 2.0 ** np.linspace(-2.0, -24.0, 400)
        t = np.concatenate([t, at - close, at + close, [at]])
        t = np.unique(t[(t >= begin) & (t <= end)])
    return t


def _clipped(of: Interval, n: float, v: float) -> tuple[Array, Array]:
    """The polygon after slip."""
    (front,), (slope,) = of.front(np.array([n]), np.array([v]))
    inside = front > of.G
    at = np.interp(front, of.G, of.o)
    G, o = np.append(of.G[inside], front), np.append(of.o[inside], at)
    if front < n:
        G, o = np.append(G, n), np.append(o, v)
        if not inside.any():
            # Everything slides: not the rounding of what was there.
            o[0] = v - slope * n
    return G, o


class Running:
    """The running integrals of the surface at positions r, shape (X,), up to any ξ.

    T1 and T3 over the springs inside of r, Π and W = ∫ g′ dξ/(ξ + √(ξ²−r²)) over those outside.
    """

    def __init__(self, profile: Profile, r: Array) -> None:
        self.profile, self.r = profile, r
        b, largest = profile.b, float(np.hypot(profile.s[-1], profile.b))
        self.gap = r * r - b * b
        self.low = np.maximum(r, b)
        self.scale = np.sqrt(np.maximum(np.abs(self.gap), 1e-24 * largest**2))
        self.cells = RUNNING + int(20 * profile.waves * largest)
        strip, m = profile.strip, profile.m
        # Inside, over α = (π/2) u²: s = √(r²−b²) sin α.
        width = np.where(self.gap > 0.0, self.scale, 0.0)[:, None]
        u = np.linspace(0.0, 1.0, self.cells + 1)
        self.α = 0.5 * pi * u * u

        def inside(α: Array) -> Array:
            s = width * np.sin(α)
            of, ξ = 2.0 * m(s), np.hypot(s, b)
            if strip:
                return np.stack([of / np.maximum(ξ, 1e-300)] * 2)
            return np.stack([of, of * (ξ / r[:, None]) ** 2]) / r[:, None]

        self.inner = _cumulated(inside, self.α[None])
        # Outside, over y: √(ξ² − max(r, b)²) = √|r²−b²| sinh y.
        most = np.sqrt(np.maximum(largest**2 - self.low**2, 0.0))
        self.y_end = np.arcsinh(most / self.scale)
        y = self.y_end[:, None] * u
        beyond = (self.gap >= 0.0)[:, None]

        def outside(y: Array) -> Array:
            sinh, cosh = self.scale[:, None] * np.sinh(y), self.scale[:, None] * np.cosh(y)
            s, v = np.where(beyond, cosh, sinh), np.where(beyond, sinh, cosh)
            of = m(s) / np.hypot(s, b)
            return np.stack([of, of * v / (np.hypot(s, b) + v)])

        self.outer = _cumulated(outside, y)

    def inner_at(self, ξ: Array) -> Array:
        """T1 and T3, shape (2, X, …), up to ξ, shape (X, …) or broadcast to it."""
        gap = self.gap.reshape(-1, *(1,) * (ξ.ndim - 1))
        share = (ξ * ξ - self.profile.b**2) / np.where(gap > 0.0, gap, np.inf)
        α = np.arcsin(np.sqrt(np.clip(share, 0.0, 1.0)))
        α = np.where(ξ * ξ - self.profile.b**2 >= gap, np.where(gap > 0.0, 0.5 * pi, 0.0), α)
        k = np.clip((np.sqrt(α / (0.5 * pi)) * self.cells).astype(int), 0, self.cells - 1)
        return _looked_up(self.inner, k, α, self.α[k], self.α[k + 1])

    def outer_at(self, ξ: Array) -> Array:
        """Π and W, shape (2, X, …)."""
        shape = (-1, *(1,) * (ξ.ndim - 1))
        low, scale, end = (of.reshape(shape) for of in (self.low, self.scale, self.y_end))
        y = np.arcsinh(np.sqrt(np.maximum(ξ * ξ - low * low, 0.0)) / scale)
        step = np.maximum(end, 1e-300) / self.cells
        k = np.clip((y / step).astype(int), 0, self.cells - 1)
        return _looked_up(self.outer, k, y, k * step, (k + 1) * step)


def _cumulated(function: Callable[[Array], Array], ends: Array) -> tuple[Array, Array]:
    """The integral from the first of the ends, (kinds, X, k + 1), and the integrand there."""
    total = 0.0
    half = 0.5 * np.diff(ends, axis=-1)
    for node, weight in zip(_NODE, _WEIGHT, strict=True):
        total = total + weight * function(ends[:, :-1] + half * (1.0 + node))
    parts = np.asarray(half * total)
    start = np.zeros((*parts.shape[:-1], 1))
    return np.concatenate([start, np.cumsum(parts, axis=-1)], axis=-1), function(ends)


def _looked_up(table: tuple[Array, Array], k: Array, at: Array, low: Array, high: Array) -> Array:
    """Cubic values of a cumulated table in its cells k, shape (X, …)."""
    value, slope = table
    step = high - low
    x = np.clip((at - low) / np.where(step > 0.0, step, 1.0), 0.0, 1.0)
    rows = np.arange(k.shape[0]).reshape(-1, *(1,) * (k.ndim - 1))
    return np.stack(
        [
            _cubic(x, y[rows, k], y[rows, k + 1], d[rows, k] * step, d[rows, k + 1] * step)[0]
            for y, d in zip(value, slope, strict=True)
        ]
    )


class Line:
    """The surface line of a point, as `swtstudy.solve` takes its arguments."""

    def __init__(self, arguments: Mapping[str, Any]) -> None:
        defaults = {"frequency_ratio": "1/1", "phase": 0.0}
        self.given = {**defaults, **arguments}
        self.force = "tangential_force_amplitude" in arguments
        by_force = "normal_force_amplitude" in arguments
        deep = arguments["normal_force_amplitude" if by_force else "normal_amplitude"]
        self.profile = Profile.of(self.given, by_force, 1.0 + float(deep))
        self.course = Course.of(self.given, self.profile)
        self.ν, self.μ = float(arguments["poisson_ratio"]), float(arguments["friction"])
        self.bulk = bool(
            arguments.get("bulk_stress_amplitude", 0.0) or arguments.get("bulk_stress_mean", 0.0)
        )
        self.criterion = str(arguments.get("criterion", "swt"))
        self.γ = float(arguments.get("walker_exponent", 0.5))
        self.κ = float(arguments.get("normal_sensitivity", 0.0))

    def radius(self, G: Array) -> Array:
        """ξ at the diagram's coordinate."""
        return np.asarray(np.hypot(self.profile.s_at(self.force, G), self.profile.b))

    def coordinate(self, ξ: Array) -> Array:
        """The diagram's coordinate at ξ."""
        s = np.sqrt(np.maximum(ξ * ξ - self.profile.b**2, 0.0))
        return self.profile.value_at(self.force, s)

    def stress(self, intervals: list[Interval], r: Array, count: int) -> Array:
        """σ_xx, σ_yy, σ_zz by the normal load and σ_xx, σ_yy, σ_xz by the tangential one.

        Shape (6, X, J, count + 1): cosine-spaced instants of J parts between what passes the positions.
        """
        running = Running(self.profile, r)
        return np.concatenate([self._within(of, running, r, count) for of in intervals], axis=2)

    def _within(self, of: Interval, running: Running, r: Array, count: int) -> Array:
        course, G_x = self.course, self.coordinate(r)
        share = 0.5 - 0.5 * np.cos(pi * np.linspace(0.0, 1.0, count + 1))
        ends = self._passages(of, G_x, r)
        t = ends[:, :-1, None] + np.diff(ends, axis=1)[:, :, None] * share
        edge = self.radius(course.n(t))
        T1, T3 = self.sheared(of, t, running.inner_at)
        Π, _ = self.sheared(of, t, running.outer_at)
        pressure, W = running.outer_at(edge)
        p, ν, μ, x = pressure / pi, self.ν, self.μ, r[:, None, None]
        bulk = course.bulk(t)
        if self.profile.strip:
            pulled = μ / pi * T1
            return np.stack([bulk - p, ν * (bulk - 2.0 * p), -p, pulled, ν * pulled, μ / pi * Π])
        inner = np.minimum(edge, x)
        s_inner = np.sqrt(np.maximum(inner * inner - self.profile.b**2, 0.0))
        load = self.profile.value_at(True, s_inner) * self.profile.mean
        spread = (1.0 - 2.0 * ν) / pi * (load / (x * x) + W)
        normal = bulk + spread - p, -spread - 2.0 * ν * p, -p
        return np.stack([*normal, μ / pi * ((1.0 + ν) * T1 - ν * T3), μ / pi * ν * T3, μ / pi * Π])

    def sheared(self, of: Interval, t: Array, at: Callable[[Array], Array]) -> Array:
        """−Σ slope ΔA over the polygon up to the front, and over what slips beyond, at instants.

        ``t`` has the shape (X, …); ``at`` gives A, shape (kinds, X, …), at radii ξ.
        """
        n, v = self.course.n(t), self.course.v(t)
        front, slope = of.front(n, v)
        A = at(np.broadcast_to(self.radius(of.G), (len(t), of.G.size)))
        slopes = np.clip(np.diff(of.o) / np.diff(of.G), -1.0, 1.0)
        cell = np.clip(np.searchsorted(of.G, front, "right") - 1, 0, of.G.size - 2)
        total = np.cumsum(np.pad(slopes * np.diff(A), ((0, 0), (0, 0), (1, 0))), axis=-1)
        rows = np.arange(len(t)).reshape(-1, *(1,) * (t.ndim - 1))
        A_front, A_edge = at(self.radius(front)), at(self.radius(n))
        held = total[:, rows, cell] + slopes[cell] * (A_front - A[:, rows, cell])
        return -np.asarray(held + slope * (A_edge - A_front))

    def _passages(self, of: Interval, G_x: Array, r: Array) -> Array:
        """The instants at which the edge and the front pass positions, ascending with both ends, (X, k)."""
        course = self.course
        low, high = np.full(r.size, of.begin), np.full(r.size, of.end)
        n0, n1 = course.n(low[:1])[0], course.n(high[:1])[0]
        ends = [low, high]

        def passes(value: Callable[[Array], Array], target: Array) -> Array:
            rises = value(high[:1])[0] >= value(low[:1])[0]
            return _bisect(lambda t: (value(t) < target) == rises, low, high)

        ends.append(passes(course.n, G_x) if n0 != n1 else low)
        o_x = np.interp(G_x, of.G, of.o)
        if of.grows:
            ends += [low] * (4 if self.profile.b else 2)
        else:
            ends.append(passes(lambda t: course.v(t) - course.n(t), o_x - G_x))
            ends.append(passes(lambda t: course.v(t) + course.n(t), o_x + G_x))
            if self.profile.b:  # the front at the face's edge
                at_edge = np.full(r.size, of.o[0])
                ends.append(passes(lambda t: course.v(t) - course.n(t), at_edge))
                ends.append(passes(lambda t: course.v(t) + course.n(t), at_edge))
        return np.sort(np.stack(ends, axis=1), axis=1)

    def values(self, stress: Array, angles: Array, smooth: bool) -> Array:
        """The criterion at positions on planes, shape (2, X, planes), on the sides x > 0 and x < 0."""
        zz, found = stress[2], []
        for side in (1.0, -1.0):
            xx, yy, xz = stress[0] + side * stress[3], stress[1] + side * stress[4], stress[5]
            trace = xx + yy + zz
            planes = []
            for angle in angles:
                c, s = np.cos(angle), np.sin(angle)
                normal = xx * c**2 + zz * s**2 + 2.0 * xz * s * c
                if self.criterion == "swt":
                    swing = (1.0 + self.ν) * normal - self.ν * trace
                else:
                    swing = (zz - xx) * s * c + xz * (c**2 - s**2)
                largest, up, down = (_largest(each, smooth) for each in (normal, swing, -swing))
                planes.append(self._value(largest, 0.5 * (up + down)))
            found.append(np.stack(planes, axis=-1))
        return np.stack(found)

    def _value(self, tension: Array, amplitude: Array) -> Array:
        pull = np.maximum(tension, 0.0)
        if self.criterion == "fatemi_socie":
            return np.asarray(amplitude * (1.0 + self.κ * pull))
        if self.criterion == "findley":
            return np.maximum(amplitude + self.κ * tension, 0.0)
        E, γ = 1.0 - self.ν**2, self.γ
        return np.asarray(pull ** (2.0 - 2.0 * γ) * np.maximum(amplitude, 0.0) ** (2.0 * γ) / E)

    def far(self) -> float:
        """The value of the bulk stress alone."""
        t = np.linspace(0.0, 2.0 * pi, 20_001)
        bulk = self.course.bulk(t)[None, None]
        zero = np.zeros_like(bulk)
        yy = self.ν * bulk if self.profile.strip else zero
        return float(self.values(np.stack([bulk, yy, zero, zero, zero, zero]), _planes(720), False).max())


def _largest(of: Array, smooth: bool) -> Array:
    """The maximum over all parts and instants, (X,); by parabolas between the instants if ``smooth``."""
    highest = of.max(axis=(1, 2))
    if smooth:
        middle, before, after = of[..., 1:-1], of[..., :-2], of[..., 2:]
        bend = before - 2.0 * middle + after
        peak = (middle >= before) & (middle >= after) & (bend < 0.0)
        top = middle - np.where(peak, (after - before) ** 2 / np.where(peak, 8.0 * bend, 1.0), 0.0)
        highest = np.maximum(highest, np.where(peak, top, -np.inf).max(axis=(1, 2)))
    return np.asarray(highest)


def _planes(count: int) -> Array:
    return pi * (np.arange(count) / count - 0.5)


def line_s(arguments: Mapping[str, Any], share: float = 0.95) -> tuple[float, float, float]:
    """s of a point, the signed x of the critical point and the angle of its plane, degrees.

    Parameters
    ----------
    arguments
        Those of `swtstudy.solve`; a table has radius and height, a loop has vertices.
    share
        Peaks of the first look above this share of the highest are looked at more closely.
    """
    line = Line(arguments)
    peaks, cusps = _peaks(line)
    looks = [peak for peak in peaks[: KEPT[0]] if peak.height >= share * peaks[0].height]
    for kept in KEPT:
        looks = sorted(looks, key=lambda look: -look.height)[:kept]
        looks = [_closer(line, look, cusps) for look in looks]
    # Coarser instants of earlier rounds may be too high.
    found = [(look.height, look.x * look.side, float(np.degrees(look.angle))) for look in looks]
    return max([*found, (line.far() if line.bulk else 0.0, np.nan, 0.0)])


#: Peaks that are looked at in each round.
KEPT = 24, 10, 4, 3, 3, 2, 2, 2
#: Planes of the first look.
PLANES = 48


@dataclass(frozen=True)
class Peak:
    """A high value at x > 0 or on the side −1, and the ranges of x and of the plane's angle about it."""

    height: float
    side: float
    x: float
    down: float
    up: float
    angle: float
    turn: float
    instants: int


def _peaks(line: Line) -> tuple[list[Peak], Array]:
    """The local maxima of a plain grid of positions and planes, from the highest, and the cusps."""
    intervals = _intervals(line.course, 200, None, 0.0)
    r, cusps = _positions(line, intervals)
    angles = _planes(PLANES)
    looked = np.concatenate(
        [line.values(line.stress(intervals, part, 8), angles, False) for part in _parts(r, intervals)], axis=1
    )
    peaks = []
    for side, values in zip((1.0, -1.0), looked, strict=True):
        # Parabolas over the angle: a ridge of positions may lie between two planes.
        before, after = np.roll(values, 1, axis=1), np.roll(values, -1, axis=1)
        is_top = (values >= before) & (values >= after)
        bend = np.where(is_top, np.minimum(before - 2.0 * values + after, -1e-300), -1.0)
        heights = np.where(is_top, values - (after - before) ** 2 / (8.0 * bend), -1.0)
        turns = np.where(is_top, (before - after) / (2.0 * bend) * (pi / PLANES), 0.0)
        top = np.pad(heights.max(axis=1), 1, constant_values=-1.0)
        for k in np.flatnonzero((top[1:-1] >= top[:-2]) & (top[1:-1] >= top[2:])):
            down, up = r[k] - r[max(k - 2, 0)], r[min(k + 2, r.size - 1)] - r[k]
            for j in np.flatnonzero(is_top[k]):
                peaks.append(
                    Peak(heights[k, j], side, r[k], down, up, angles[j] + turns[k, j], pi / PLANES, 12)
                )
    return sorted(peaks, key=lambda peak: -peak.height), cusps


def _parts(r: Array, intervals: list[Interval]) -> Iterator[Array]:
    """Positions that are looked at together."""
    size = max(int(400_000 / (40 * len(intervals) + max(of.G.size for of in intervals))), 1)
    return (r[first : first + size] for first in range(0, r.size, size))


def _positions(line: Line, intervals: list[Interval]) -> tuple[Array, Array]:
    """Positions of the first look, cosine-spaced between cusps, and all cusps."""
    ends = np.array([of.end for of in intervals])
    n, v = line.course.n(ends), line.course.v(ends)
    fronts = np.concatenate([of.front(n[k : k + 1], v[k : k + 1])[0] for k, of in enumerate(intervals)])
    largest = float(line.radius(n).max())
    cusps = np.concatenate([line.radius(np.concatenate([n, fronts])), [1e-4 * largest, largest]])
    cusps = np.maximum(cusps, 1e-4 * largest)
    if line.profile.b:
        cusps = np.append(cusps, line.profile.b * (1.0 + 1e-9))
    if float(line.given.get("exponent", 2.0)) < 2.0:  # a sharp tip
        cusps = np.append(cusps, largest * np.geomspace(1e-11, 1e-5, 7))
    cusps = np.unique(cusps)
    cusps = cusps[np.append(True, np.diff(cusps) > SAME * largest)]
    count = int(np.clip(700 / len(cusps), 8, 48))
    share = 0.5 - 0.5 * np.cos(pi * np.arange(count) / count)
    r = (cusps[:-1, None] + np.diff(cusps)[:, None] * share).ravel()
    beyond = largest * (1.0 + np.geomspace(1e-4, 100.0 if line.bulk else 0.5, 60 if line.bulk else 12))
    return np.concatenate([r, [largest], beyond]), cusps


def _closer(line: Line, peak: Peak, cusps: Array) -> Peak:
    """The highest place of a finer grid about a peak, and narrower ranges about it."""
    low, high = max(peak.x - peak.down, 1e-4 * cusps[-1]), peak.x + peak.up
    within = cusps[(cusps > low) & (cusps < high)]
    at = np.unique(np.concatenate([np.linspace(low, peak.x, 7), np.linspace(peak.x, high, 7), within]))
    about = float(line.coordinate(np.array([peak.x]))[0])
    intervals = _intervals(line.course, 600, about, float(np.ptp(line.coordinate(at))))
    angles = peak.angle + peak.turn * np.linspace(-1.0, 1.0, 11)
    values = line.values(line.stress(intervals, at, peak.instants), angles, True)[int(peak.side < 0.0)]
    i, j = np.unravel_index(values.argmax(), values.shape)
    return Peak(
        float(values[i, j]),
        peak.side,
        float(at[i]),
        *(np.array([peak.down, peak.up]) * (0.25 if 0 < i < at.size - 1 else 1.0)),
        float(angles[j]),
        peak.turn * (0.3 if 0 < j < angles.size - 1 else 1.0),
        min(peak.instants + 8, 32),
    )
