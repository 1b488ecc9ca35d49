"""Stress integrals over the springs that touched down and stuck: their slope do/dG = u̇/δ̇ is not constant.

Both the kernels and the slope are smooth in an angle α (inner springs) or in v = √(ξ²−r²) (outer ones) but
for square roots at the two ends; a sin² map removes these, so that a short Chebyshev series of the running
integral is exact to rounding.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics import cumulative
from swtstudy.mechanics.contact import GROWTH, Cycle, Memory
from swtstudy.mechanics.gather import gather, packed
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile

#: Chebyshev nodes for each oscillation of u while the ground grows.
NODES_PER_OSCILLATION = 1.6


class GrowthIntegrals:
    """Running integrals of the primitives' kernels times −u̇/δ̇ over each growth of each cycle.

    Parameters
    ----------
    cycle, profile
        n cycles and n profiles.
    position
        Shape (n, X), r = |x|.
    digits
        Digits that the stress is to have.
    """

    def __init__(self, cycle: Cycle, profile: Profile, position: FloatArray, digits: float) -> None:
        # u may oscillate several times while δ rises once.
        oscillations = cycle.protocol.p / cycle.protocol.q
        smooth = max(4.0 * digits - 6.0, 6.0 * digits - 16.0) + NODES_PER_OSCILLATION * oscillations
        count = math.ceil(smooth) + profile.extra_nodes(digits)
        memory = cycle.memory
        n = len(memory.start)
        grown = (memory.slope == GROWTH) & np.isfinite(memory.start)
        key = np.where(grown, _identity(memory), np.inf).reshape(n, -1)
        order = np.argsort(key, axis=1, kind="stable")
        key, start, stop, branch = (
            gather(v.reshape(n, -1), order) for v in (key, memory.start, memory.stop, memory.branch)
        )
        first = np.isfinite(key)
        first[:, 1:] &= key[:, 1:] != key[:, :-1]
        self.count = int(first.sum(axis=1).max(initial=0))
        if not self.count:
            return
        # Rows with fewer growths repeat one; nothing refers to it.
        first[:, 0] = True
        begin = np.where(np.isfinite(key), start, 0.0)
        begin, end, branch, key = packed(first, begin, stop, branch, key)
        #: Shape (n, k): tells the growths apart.
        self.key = key
        # Axes from here on: profile n, position X, growth k, node.
        self.position = position[:, :, None]
        self.flat = profile.flat_radius[:, None, None]
        low, high = (profile.radius(g)[:, None, :] for g in (begin, end))
        y = np.sin(0.25 * np.pi * (1.0 + cumulative.nodes(count)))
        share, rate = y * y, 0.5 * np.pi * y * np.sqrt(1.0 - y * y)

        def slope(radius: FloatArray) -> FloatArray:
            instant = cycle.protocol.touch_down(profile.depth(radius), branch[:, None, :, None])
            du, dd = cycle.protocol.displacement_rate(instant), cycle.protocol.depth_rate(instant)
            # At a common turning point of u and δ the ratio is bounded by 1, as everywhere in stick.
            ratio = np.divide(du, dd, out=np.zeros_like(du), where=np.abs(dd) > 1e-300)
            return -np.clip(ratio, -1.0, 1.0)

        r, b = self.position[..., None], self.flat[..., None]
        self.inner_low, inner_high = self._inner_angle(low), self._inner_angle(high)
        self.inner_span = inner_high - self.inner_low
        angle = self.inner_low[..., None] + self.inner_span[..., None] * share
        radius = np.sqrt(b * b + np.maximum(r * r - b * b, 0.0) * np.sin(angle) ** 2)
        # Under a flat face there are no springs inside r.
        rate_inside = np.where(r > b, rate, 0.0) * self.inner_span[..., None]
        density = profile.weighted_slope(radius) * slope(radius) * rate_inside
        first = density * 2.0 / r
        inner = np.stack([first, first * (radius / r) ** 2])

        self.outer_low, outer_high = self._outer_root(low), self._outer_root(high)
        self.outer_span = outer_high - self.outer_low
        root = self.outer_low[..., None] + self.outer_span[..., None] * share
        radius = np.sqrt(root * root + r * r)
        gap = np.sqrt(np.maximum(radius * radius - b * b, 1e-300))
        outer = profile.weighted_slope(radius) / (radius * gap) * slope(radius)
        values = np.concatenate([inner, (outer * rate * self.outer_span[..., None])[None]])
        #: Shape (3, n, X, k, count + 1): series for T1, T3 and Π.
        self.series = cumulative.running_integral(values)

    def _inner_angle(self, radius: FloatArray) -> FloatArray:
        r, b = self.position, self.flat
        sine = np.maximum(radius**2 - b**2, 0.0) / np.maximum(r**2 - b**2, 1e-300)
        return np.asarray(np.arcsin(np.sqrt(np.clip(sine, 0.0, 1.0))))

    def _outer_root(self, radius: FloatArray) -> FloatArray:
        return np.sqrt(np.maximum(radius**2 - self.position**2, 0.0))

    def index(self, cycle: Cycle) -> NDArray[np.intp]:
        """Number of the growth that left each piece of the memory, shape (n, i, d); 0 for lines."""
        same = _identity(cycle.memory)[..., None] == self.key[:, None, None, :]
        return np.asarray(same.argmax(axis=-1))

    def up_to(
        self,
        row: NDArray[np.intp],
        column: NDArray[np.intp],
        index: NDArray[np.intp],
        radius: FloatArray,
    ) -> FloatArray:
        """Integrals T1, T3, Π over single growths up to ``radius``, shape (3, m).

        Parameters
        ----------
        row, column, index, radius
            Shape (m,): point, position, number of the growth (see `index`), upper limit ξ.
        """
        columns, count = self.position.shape[1], self.count
        at = (row * columns + column) * count + index
        r2 = self.position.take(row * columns + column) ** 2
        b2 = self.flat.take(row) ** 2
        sine = np.maximum(radius**2 - b2, 0.0) / np.maximum(r2 - b2, 1e-300)
        angle = np.arcsin(np.sqrt(np.clip(sine, 0.0, 1.0)))
        root = np.sqrt(np.maximum(radius**2 - r2, 0.0))
        inner = _share(angle, self.inner_low.take(at), self.inner_span.take(at))
        outer = _share(root, self.outer_low.take(at), self.outer_span.take(at))
        series = self.series.reshape(3, -1, self.series.shape[-1]).take(at, axis=1)
        both = cumulative.evaluate(series[:2], inner)
        return np.concatenate([both, cumulative.evaluate(series[2:], outer)])


def _identity(memory: Memory) -> FloatArray:
    """A number of its own for every growth: depths are below 4π."""
    return memory.start + 2.0 * memory.branch


def _share(value: FloatArray, low: FloatArray, span: FloatArray) -> FloatArray:
    """Abscissa in [−1, 1] of the sin² map."""
    part = np.divide(value - low, span, out=np.zeros_like(value), where=span > 0.0)
    return np.arcsin(np.sqrt(np.clip(part, 0.0, 1.0))) * (4.0 / np.pi) - 1.0
