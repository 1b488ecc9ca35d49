"""The profiles f, four of them of the paper (eqs. 3–6), and what follows from them, by adaptive quadrature.

Lengths in a_H, depths in δ0.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from itertools import chain, pairwise

import numpy as np
from scipy.integrate import quad
from scipy.special import beta, struve


def one(xi: float) -> float:
    """No weight."""
    return 1.0


@dataclass(frozen=True)
class Indenter:
    """One profile: f′(r), the radius b of its flat face, and m = g′ w over w = √(ξ² − b²)."""

    profile: str
    shape: dict[str, float]
    f_slope: Callable[[float], float]
    weighted_slope: Callable[[float], float]
    flat_radius: float = 0.0

    def __str__(self) -> str:
        return "-".join([self.profile, *(f"{value:g}" for value in self.shape.values())])

    def depth(self, xi: float) -> float:
        """g(ξ) of eq. (11), with r = ξ sin θ."""
        kink = np.arcsin(min(self.flat_radius / xi, 1.0))
        return xi * integral(lambda theta: self.f_slope(xi * np.sin(theta)), kink, 0.5 * np.pi)

    def slope(self, xi: float) -> float:
        """g′(ξ)."""
        rise = np.sqrt(xi * xi - self.flat_radius**2)
        return self.weighted_slope(rise) / rise

    def inner(
        self, r: float, radius: float, weight: Callable[[float], float] = one, start: float = 0.0
    ) -> tuple[float, float]:
        """T1, T3 = ∫ 2 (ξ/r)ⁿ g′ dξ/√(r²−ξ²), n = 1, 3, with w = √(r²−b²) sin α.

        From ξ = ``start`` to ``radius``, with a further ``weight`` over ξ.
        """
        b2 = self.flat_radius**2
        gap = r * r - b2
        if gap <= 0.0:
            return 0.0, 0.0
        first, last = (np.arcsin(np.sqrt(min(max(end**2 - b2, 0.0) / gap, 1.0))) for end in (start, radius))

        def kernel(alpha: float, power: int) -> float:
            rise = np.sqrt(gap) * np.sin(alpha)
            xi = np.hypot(rise, self.flat_radius)
            return 2.0 * (xi / r) ** (power - 1) / r * self.weighted_slope(rise) * weight(xi)

        return integral(partial(kernel, power=1), first, last), integral(
            partial(kernel, power=3), first, last
        )

    def outer(
        self, r: float, radius: float, weight: Callable[[float], float] = one, start: float = 0.0
    ) -> tuple[float, float]:
        """Π = ∫ g′ dξ/u and W = ∫ g′ dξ/(ξ+u), u = √(ξ²−r²), over v = √(ξ² − max(r, b)²)."""
        b, low = self.flat_radius, max(r, self.flat_radius)
        if radius <= max(low, start):
            return 0.0, 0.0
        first, last = (np.sqrt(max(end**2 - low**2, 0.0)) for end in (start, radius))
        near = np.sqrt(abs(r - b) * (r + b))

        def kernel(v: float, share: float) -> float:
            xi, other = np.hypot(v, low), np.hypot(v, near)
            if r < b:
                return self.weighted_slope(v) / xi / (other + share * xi) * weight(xi)
            # 1 for Π, where v cancels.
            factor = v / (v + share * xi) if share else 1.0
            return self.weighted_slope(other) / other * factor / xi * weight(xi)

        # Next to the face's edge the integrand turns within v ~ near: geometric steps.
        steps = np.geomspace(max(near, 1e-9), last, 12) if 0.0 < near < last else np.array([last])
        ends = np.concatenate([[first], steps[steps > first]])
        pressure, load = (
            sum(integral(partial(kernel, share=share), *pair) for pair in pairwise(ends))
            for share in (0.0, 1.0)
        )
        return pressure, load


def integral(function: Callable[[float], float], low: float, high: float) -> float:
    """Adaptive quadrature to about 1e-12."""
    return float(quad(function, low, high, epsabs=1e-13, epsrel=1e-12, limit=400)[0])


def paraboloid() -> Indenter:
    """Eq. (3)."""
    return Indenter("paraboloid", {}, lambda r: r, lambda w: 2.0 * w * w)


def rounded_punch(b: float) -> Indenter:
    """Eq. (4): g′ = 2w − b arccos(b/ξ)."""
    return Indenter(
        "rounded_punch",
        {"flat_radius": b},
        lambda r: max(r - b, 0.0),
        lambda w: w * (2.0 * w - b * np.arctan(w / b)),
        b,
    )


def truncated_paraboloid(b: float) -> Indenter:
    """Eq. (5): g′ = (2ξ² − b²)/w."""
    return Indenter(
        "truncated_paraboloid",
        {"flat_radius": b},
        lambda r: r if r >= b else 0.0,
        lambda w: 2.0 * w * w + b * b,
        b,
    )


def wavy_paraboloid(h: float, wavelength: float) -> Indenter:
    """Eq. (6), the wavelength in √(hR)."""
    k = 2.0 * np.pi / (wavelength * np.sqrt(h))

    def weighted_slope(xi: float) -> float:
        z = k * xi
        return xi * (2.0 * xi + 0.5 * np.pi * h * k * (struve(0, z) + z * (2.0 / np.pi - struve(1, z))))

    return Indenter(
        "wavy_paraboloid",
        {"waviness_amplitude": h, "wavelength": wavelength},
        lambda r: r + h * k * np.sin(k * r),
        weighted_slope,
    )


def power_law(n: float) -> Indenter:
    """g = ξⁿ: f′ = n rⁿ⁻¹ over ∫ sinⁿ⁻¹θ dθ from 0 to π/2."""
    wallis = 0.5 * beta(0.5 * n, 0.5)
    return Indenter("power_law", {"exponent": n}, lambda r: r ** (n - 1.0) / wallis, lambda w: n * w**n)


#: Every family at the shapes that the tests look at.
ORACLES: dict[str, tuple[Indenter, ...]] = {
    "paraboloid": (paraboloid(),),
    "rounded_punch": tuple(map(rounded_punch, (0.5, 0.05, 2.0))),
    "truncated_paraboloid": tuple(map(truncated_paraboloid, (0.5, 0.05, 2.0))),
    # Shallow, steep and fine waves.
    "wavy_paraboloid": (wavy_paraboloid(0.01, 5.0), wavy_paraboloid(0.1, 3.6), wavy_paraboloid(5e-4, 4.5)),
    "power_law": tuple(map(power_law, (1.1, 1.5, 4.0, 10.0, 20.0))),
}
INDENTERS = tuple(chain.from_iterable(ORACLES.values()))
