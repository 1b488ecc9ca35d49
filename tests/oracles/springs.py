"""The springs of the MDR, one by one, along any path: the clip rule in its exact form.

A spring in contact keeps its offset o = u − τ, clipped to [u − w, u + w] with w = δ − G. Along a stretch in
which δ, u − δ and u + δ are monotone the bounds at its end are the only ones that count, so that the
recursion over such stretches is exact. A spring that touches down starts with o = u at that instant.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Path:
    """A load path δ(t), u(t), with the instants at which δ, u − δ or u + δ turns."""

    depth: Callable[[Array], Array]
    displacement: Callable[[Array], Array]
    turns: Array


def polygon(depth: Array, displacement: Array) -> Path:
    """The path through the given corners, straight in between; t is the number of the corner."""
    corners = np.arange(len(depth), dtype=float)
    return Path(
        lambda t: np.interp(t, corners, depth), lambda t: np.interp(t, corners, displacement), corners
    )


def bimodal(
    normal_amplitude: float, tangential_amplitude: float, phase: float, p: int, q: int, periods: int = 1
) -> Path:
    """Eqs. (7), (8) over a number of common periods 2π; turns by sampling and bisection."""

    def depth(t: Array) -> Array:
        return 1.0 + normal_amplitude * np.sin(q * t + phase)

    def displacement(t: Array) -> Array:
        return tangential_amplitude * np.sin(p * t)

    def rate(t: Array, du: float, dd: float) -> Array:
        normal = q * normal_amplitude * np.cos(q * t + phase)
        return du * p * tangential_amplitude * np.cos(p * t) + dd * normal

    samples = np.linspace(0.0, 2.0 * np.pi, 4001 * max(p, q))
    found = [0.0]
    for du, dd in ((0.0, 1.0), (1.0, 1.0), (1.0, -1.0)):
        values = rate(samples, du, dd)
        for k in np.flatnonzero(values[1:] * values[:-1] < 0.0):
            found.append(brentq(rate, samples[k], samples[k + 1], args=(du, dd), xtol=1e-15))
    turns = np.add.outer(2.0 * np.pi * np.arange(periods), np.sort(found)).ravel()
    return Path(depth, displacement, np.append(turns, 2.0 * np.pi * periods))


def spring_forces(path: Path, g: Array, instants: Array) -> Array:
    """Tangential force τ of the springs at depths ``g``, shape (len(instants), len(g)).

    The path starts at its first turn, where all springs in contact have τ = 0; ``instants`` ascend.
    """
    times = np.union1d(path.turns, instants)
    offset = np.zeros_like(g) + path.displacement(times[:1])
    result = np.empty((len(instants), len(g)))
    before = path.depth(times[:1])
    for start, time in zip(np.append(times[0], times[:-1]), times, strict=True):
        now, u = path.depth(np.array([time])), path.displacement(np.array([time]))
        touches = (before <= g) & (g < now)
        if touches.any():
            offset[touches] = path.displacement(_touch_down(path, g[touches], start, time))
        w = np.maximum(now - g, 0.0)
        offset = np.clip(offset, u - w, u + w)
        for k in np.flatnonzero(instants == time):
            result[k] = np.where(w > 0.0, u - offset, 0.0)
        before = now
    return result


def _touch_down(path: Path, g: Array, start: float, stop: float) -> Array:
    low, high = np.full_like(g, start), np.full_like(g, stop)
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = path.depth(middle) > g
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    return high
