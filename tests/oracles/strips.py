"""Plane profiles f(x), and what follows from their curvature by adaptive quadrature.

Half-widths in a_H, heights in δ0, line loads in E* δ0: the mean one is π/4. f″ is 0 up to the half-width b.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.integrate import quad
from scipy.special import beta


def integral(function: Callable[[float], float], low: float, high: float) -> float:
    """Adaptive quadrature to about 1e-10: integrals of integrals have no more digits."""
    return float(quad(function, low, high, epsabs=1e-11, epsrel=1e-10, limit=400)[0])


@dataclass(frozen=True)
class Strip:
    """One profile: f″(x), and the half-width b of its flat face."""

    profile: str
    shape: dict[str, float]
    bend: Callable[[float], float]
    flat: float = 0.0

    def __str__(self) -> str:
        return "-".join([self.profile, *(f"{value:g}" for value in self.shape.values())])

    def slope(self, xi: float) -> float:
        """N′(ξ) = ξ ∫ f″ dx/√(ξ² − x²), x = ξ sin θ."""
        first = np.arcsin(min(self.flat / xi, 1.0))
        # f″ ~ xⁿ⁻²: θ = c³ leaves nothing singular for n > 4/3.
        return xi * integral(
            lambda c: 3.0 * c * c * self.bend(xi * np.sin(c**3)), np.cbrt(first), np.cbrt(0.5 * np.pi)
        )

    def load(self, xi: float) -> float:
        """N(ξ) = ∫ √(ξ² − x²) f″ dx."""
        first = np.arcsin(min(self.flat / xi, 1.0))
        return xi**2 * integral(
            lambda c: 3.0 * c * c * np.cos(c**3) ** 2 * self.bend(xi * np.sin(c**3)),
            np.cbrt(first),
            np.cbrt(0.5 * np.pi),
        )

    def inner(self, x: float, radius: float) -> float:
        """A = ∫ 2 N′ dξ/√(x²−ξ²) up to ``radius``, in v = √(x²−ξ²)."""
        stop = min(radius, x)
        if stop <= self.flat:
            return 0.0
        low, high = (np.sqrt((x - xi) * (x + xi)) for xi in (stop, self.flat))
        return integral(lambda v: 2.0 * self._over(np.sqrt((x - v) * (x + v))), low, high)

    def outer(self, x: float, radius: float) -> float:
        """B = ∫ N′ dξ/√(ξ²−x²) up to ``radius``, in v = √(ξ²−x²)."""
        start = max(x, self.flat)
        if radius <= start:
            return 0.0
        low, high = (np.sqrt((xi - x) * (xi + x)) for xi in (start, radius))
        return integral(lambda v: self._over(np.hypot(x, v)), low, high)

    def _over(self, xi: float) -> float:
        return self.slope(xi) / xi if xi > self.flat else 0.0


def _wavy(h: float, wavelength: float) -> Strip:
    k = 2.0 * np.pi / (wavelength * np.sqrt(h))
    shape = {"waviness_amplitude": h, "wavelength": wavelength}
    return Strip("wavy_cylinder", shape, lambda x: 1.0 + h * k * k * np.cos(k * x))


def _power_law(n: float) -> Strip:
    # N = π/4 at ξ = 1: ∫ √(1 − x²) xⁿ⁻² dx = B((n − 1)/2, 3/2)/2.
    scale = 0.25 * np.pi / (0.5 * beta(0.5 * (n - 1.0), 1.5))
    return Strip("power_law_cylinder", {"exponent": n}, lambda x: scale * x ** (n - 2.0))


def _flat(b: float) -> Strip:
    return Strip("rounded_flat", {"flat_half_width": b}, lambda x: 1.0 * (x >= b), b)


STRIPS = (
    Strip("cylinder", {}, lambda x: 1.0),
    *map(_flat, (0.05, 0.5, 3.0)),
    *map(partial(_wavy, wavelength=5.0), (0.01, 0.1)),
    *map(_power_law, (1.5, 4.0, 10.0)),
)
