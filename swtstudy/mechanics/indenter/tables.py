"""Full-slip primitives without a closed form: Chebyshev tables of their running integrals."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import align
from swtstudy.mechanics.points import FloatArray


class InnerTable:
    """T1 and T3 as series in α, ξ² = b² + (r² − b²) sin²α, up to the largest contact radius.

    Parameters
    ----------
    profile
        n profiles with b ≥ 0.
    position
        Shape (n, X), r = |x| > b; 0 results where r ≤ b.
    count
        Number of Chebyshev nodes.
    largest
        Shape (n,): largest contact radius.
    """

    def __init__(self, profile: Profile, position: FloatArray, count: int, largest: FloatArray) -> None:
        self.flat = profile.flat_radius[:, None]
        self.gap = np.maximum(position**2 - self.flat**2, 0.0)
        #: Largest α.
        self.span: FloatArray | float = 0.5 * np.pi
        outside = position > largest[:, None]
        if np.any(outside):
            share = (largest[:, None] ** 2 - self.flat**2) / np.maximum(self.gap, 1e-300)
            self.span = np.where(outside, np.arcsin(np.sqrt(np.minimum(share, 1.0))), self.span)[..., None]
        angle = 0.5 * self.span * (1.0 + chebyshev.nodes(count))
        radius2 = self.flat[..., None] ** 2 + self.gap[..., None] * np.sin(angle) ** 2
        weight = self.span * profile.weighted_slope(np.sqrt(radius2)) / position[..., None]
        weight = np.where(self.gap[..., None] > 0.0, weight, 0.0)
        self.integrals = chebyshev.RunningIntegrals(self.densities(weight, radius2, position))

    def densities(self, weight: FloatArray, radius2: FloatArray, position: FloatArray) -> FloatArray:
        """Integrand over α, from 2 m/r and the squares of the radii at the nodes."""
        return np.stack([weight, weight * radius2 / position[..., None] ** 2])

    def __call__(self, radius: FloatArray) -> FloatArray:
        gap, flat = align(self.gap, radius), align(self.flat, radius)
        share = np.maximum(radius * radius - flat * flat, 0.0) / np.maximum(gap, 1e-300)
        angle = np.arcsin(np.sqrt(np.minimum(share, 1.0)))
        if isinstance(self.span, float):
            y = angle * (4.0 / np.pi) - 1.0
        else:
            y = np.minimum(angle * (2.0 / align(self.span[..., 0], radius)), 2.0) - 1.0
        return self.integrals.up_to(y)


class OuterTable:
    """Π and W as series: in v = √(ξ² − r²), or, about a flat face, in ω with ε = √|r² − b²|.

    For r > b: v = ε sinh ω; for r < b: √(ξ² − b²) = ε sinh ω. Then dΠ = (m/ξ) dω, which takes the
    logarithmic singularity at r = b out of the integrand. Without a face W turns within v ~ r, so that it has
    fewer digits next to the axis, where swt is never largest.

    Parameters
    ----------
    profile
        n profiles.
    position
        Shape (n, X), r = |x|.
    count
        Number of Chebyshev nodes.
    largest
        Shape (n,): largest contact radius.
    """

    def __init__(self, profile: Profile, position: FloatArray, count: int, largest: FloatArray) -> None:
        flat = profile.flat_radius[:, None]
        self.has_face = bool(np.any(flat > 0.0))
        self.low2 = np.maximum(position, flat) ** 2
        self.position = position
        if self.has_face:
            distance = np.abs((position - flat) * (position + flat))
            self.scale = np.sqrt(np.maximum(distance, 1e-20 * largest[:, None] ** 2))
        else:
            self.scale = np.ones_like(position)
        self.span = np.maximum(self._abscissa(largest[:, None], self.low2, self.scale), 1e-300)
        node = self.span[..., None] * 0.5 * (1.0 + chebyshev.nodes(count))
        rise = self.scale[..., None] * np.sinh(node) if self.has_face else node
        radius = np.sqrt(self.low2[..., None] + rise * rise)
        r = position[..., None]
        v = np.sqrt(np.maximum((radius - r) * (radius + r), 0.0))
        m = profile.weighted_slope(radius) / radius
        if not self.has_face:
            m = m / radius
        values = 0.5 * self.span[..., None] * np.stack([m, m * v / (radius + v)])
        self.integrals = chebyshev.RunningIntegrals(values)
        self.of_pressure = self.integrals.component(0)

    def _abscissa(self, radius: FloatArray, low2: FloatArray, scale: FloatArray) -> FloatArray:
        rise = np.sqrt(np.maximum(radius * radius - low2, 0.0))
        return np.asarray(np.arcsinh(rise / scale)) if self.has_face else rise

    def __call__(self, radius: FloatArray) -> FloatArray:
        """Π and W up to the radii (n, X, …), shape (2, n, X, …)."""
        return self._up_to(radius, self.integrals)

    def pressure(self, radius: FloatArray) -> FloatArray:
        """Π alone."""
        return self._up_to(radius, self.of_pressure)[0]

    def _up_to(self, radius: FloatArray, integrals: chebyshev.RunningIntegrals) -> FloatArray:
        low2, scale, span = (align(v, radius) for v in (self.low2, self.scale, self.span))
        y = np.minimum(2.0 * self._abscissa(radius, low2, scale) / span, 2.0) - 1.0
        return integrals.up_to(y)


class TablePrimitives(Primitives):
    """Primitives of any profile from its m(ξ) alone; see `InnerTable` and `OuterTable`."""

    def __init__(
        self, profile: Profile, position: FloatArray, inner_nodes: int, outer_nodes: int, largest: FloatArray
    ) -> None:
        self._inner = InnerTable(profile, position, inner_nodes, largest)
        self._outer = OuterTable(profile, position, outer_nodes, largest)

    def inner(self, radius: FloatArray) -> FloatArray:
        return self._inner(radius)

    def outer(self, radius: FloatArray) -> FloatArray:
        return self._outer(radius)

    def pressure(self, radius: FloatArray) -> FloatArray:
        return self._outer.pressure(radius)
