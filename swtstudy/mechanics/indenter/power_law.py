"""The power laws: f ∝ rⁿ, with g = ξⁿ in the contact radius at δ0 and δ0, and f ∝ |x|ⁿ in the plane.

In the plane N/N_0 = ξⁿ in the half-width at the mean load.
"""

from __future__ import annotations

import math

import numpy as np

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.indenter.plane import MEAN_LOAD, PlanePrimitives, PlaneProfile
from swtstudy.mechanics.numerics import chebyshev
from swtstudy.mechanics.numerics.arrays import TINY, align
from swtstudy.mechanics.points import FloatArray, IndexArray

#: Chebyshev nodes of the series over the inner springs besides one for each digit, and for each digit of the
#: outer ones. Errors at exponents up to 20: 4e-6 at 6 digits, 2e-8 at 8, 1e-10 at 10, over 20.
INNER_NODES, OUTER_NODES_PER_DIGIT = 6, 1.3
#: r/a at which the two outer series meet: their singularities, at 0 and at 1, are equally far in (r/a)².
MEETING = math.sqrt(0.5)
#: Terms of the power series from which the series for small r/a is made: 2⁻⁵² at `MEETING`.
TERMS = 52


class PowerLaw(Profile):
    """n profiles g = ξⁿ.

    Parameters
    ----------
    largest_depth
        Shape (n,), δ0.
    exponent
        Shape (n,): above 1.
    """

    __match_args__ = ("largest_depth", "exponent")

    evenly_smooth = False

    def __init__(self, largest_depth: FloatArray, exponent: FloatArray) -> None:
        super().__init__(largest_depth)
        self.exponent = exponent

    @classmethod
    def length_law(cls, **shape: float) -> tuple[float, float]:
        # f = rⁿ/(n Rⁿ⁻¹), whose slope at R is 1: g = ξ/2 B(n/2, 1/2) (ξ/R)ⁿ⁻¹, and a_H = √(R δ0) at n = 2.
        from scipy.special import beta  # as long to import as all else, and few need it

        n = shape["exponent"]
        return 0.5 * float(beta(0.5 * n, 0.5)), 1.0 / n

    def depth(self, radius: FloatArray) -> FloatArray:
        return np.asarray(radius ** align(self.exponent, radius))

    def radius(self, depth: FloatArray) -> FloatArray:
        return np.asarray(np.maximum(depth, 0.0) ** (1.0 / align(self.exponent, depth)))

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return np.asarray(align(self.exponent, radius) * self.depth(radius))

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth = self.depth(radius)
        return depth, align(self.exponent, radius) * depth

    def half_load(self, radius: FloatArray) -> FloatArray:
        n = align(self.exponent, radius)
        return np.asarray(n / (n + 1.0) * radius ** (n + 1.0))

    def radius_of_half_load(self, half_load: FloatArray) -> FloatArray:
        n = align(self.exponent, half_load)
        return np.asarray(((n + 1.0) / n * np.maximum(half_load, 0.0)) ** (1.0 / (n + 1.0)))

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return PowerPrimitives(self.exponent, position, digits)


class PowerPrimitives(Primitives):
    """Incomplete Beta functions, by series that the positions share."""

    def __init__(self, exponent: FloatArray, position: FloatArray, digits: float) -> None:
        self.exponent, self.position = exponent, position
        self._inner = inner_series(exponent, digits)
        self._near, self._far = _near_series(exponent, digits), _FarSeries(exponent, digits)
        #: rⁿ⁻¹.
        self.power = position ** (exponent[:, None] - 1.0)

    def inner(self, radius: FloatArray) -> FloatArray:
        r, n, scale = (align(v, radius) for v in (self.position, self.exponent, self.power))
        sine = np.minimum(radius / r, 1.0)
        power = sine ** (n + 1.0)
        first = power * evaluate_inner(self._inner, sine)
        third = ((n + 1.0) * first - power * np.sqrt(1.0 - sine * sine)) / (n + 2.0)
        return np.stack([first, third]) * (2.0 * n * scale)

    def outer(self, radius: FloatArray) -> FloatArray:
        r, n, scale = (align(v, radius) for v in (self.position, self.exponent, self.power))
        radius = np.maximum(radius, r)
        v = np.sqrt((radius - r) * (radius + r))
        share = v / radius
        power = radius ** (n - 1.0)
        # Up to share² = 1/2; the others are put below.
        y = np.minimum(4.0 * share * share, 2.0) - 1.0
        first = n * power * share * chebyshev.evaluate(_aligned(self._near, radius), y)
        row, *_ = far = np.nonzero(r < MEETING * radius)
        if row.size:
            ratio = np.broadcast_to(r, radius.shape)[far] / radius[far]
            first[far] = power[far] * self._far(row, ratio)
        # W by parts: it is made of Π and of what is no integral.
        second = (first + n * (power * (radius / (radius + v)) - scale)) / (n + 1.0)
        return np.stack([first, second])


def _aligned(series: FloatArray, like: FloatArray) -> FloatArray:
    """Series of shape (k, n) for abscissae of shape (n, …)."""
    return series.reshape(series.shape + (1,) * (like.ndim - 1))


def evaluate_inner(series: FloatArray, sine: FloatArray) -> FloatArray:
    """∫ sinⁿα dα over sinⁿ⁺¹α, which is analytic and even in α up to π, by `inner_series`."""
    y = 2.0 * (np.arcsin(sine) * (2.0 / np.pi)) ** 2 - 1.0
    return chebyshev.evaluate(_aligned(series, sine), y)


def inner_series(exponent: FloatArray, digits: float) -> FloatArray:
    """∫ sinⁿα dα over sinⁿ⁺¹α in (2α/π)², for exponents n above 0."""
    from scipy.special import beta, betainc

    count = math.ceil(digits) + INNER_NODES
    n = exponent[:, None]
    sine = np.sin(0.5 * np.pi * np.sqrt(0.5 * (1.0 + chebyshev.nodes(count))))
    half = 0.5 * (n + 1.0)
    return chebyshev.series(0.5 * beta(half, 0.5) * betainc(half, 0.5, sine**2) / sine ** (n + 1.0))


def _near_series(exponent: FloatArray, digits: float) -> FloatArray:
    """Π over n aⁿ⁻¹ S, S² = 1 − (r/a)², in S² up to 1/2."""
    from scipy.special import hyp2f1

    count = math.ceil(OUTER_NODES_PER_DIGIT * digits)
    return chebyshev.series(
        hyp2f1(1.0, 1.0 - 0.5 * exponent[:, None], 1.5, 0.25 * (1.0 + chebyshev.nodes(count)))
    )


class _FarSeries:
    """Π over aⁿ⁻¹ at small c = r/a: a series in c², and cⁿ⁻¹.

    With (1 − c²/t²)^(−1/2) = Σ b_k (c/t)²ᵏ the terms are n b_k c²ᵏ/(n − 1 − 2k). That with 2k + 1 nearest to
    n, by ε, is taken together with cⁿ⁻¹, as n b_k c²ᵏ (1 − cᵋ)/ε; the rest of cⁿ⁻¹ is what makes both series
    agree where they meet.
    """

    def __init__(self, exponent: FloatArray, digits: float) -> None:
        from scipy.special import binom, hyp2f1

        k = np.arange(TERMS)
        pole = np.rint(0.5 * (exponent - 1.0))
        self.even, self.offset = 2.0 * pole, exponent - 1.0 - 2.0 * pole
        coefficient = exponent[:, None] * np.abs(binom(-0.5, k))
        distance = exponent[:, None] - 1.0 - 2.0 * k
        at_pole = k == pole[:, None]
        self.at_pole = coefficient[at_pole]
        terms = np.where(at_pole, 0.0, coefficient / np.where(at_pole, 1.0, distance))
        count = math.ceil(OUTER_NODES_PER_DIGIT * digits)
        square = 0.25 * (1.0 + chebyshev.nodes(count))
        self.series = chebyshev.series(np.einsum("nk,kj->nj", terms, square ** k[:, None]))
        self.rest = np.zeros_like(exponent)  # until it is known
        meeting = exponent * MEETING * hyp2f1(1.0, 1.0 - 0.5 * exponent, 1.5, 0.5)
        exact = np.einsum("nk,k->n", terms, 0.5**k)
        rows = np.arange(len(exponent))
        self.rest = (meeting - exact - self._pole(rows, np.full(len(rows), MEETING))) / MEETING ** (
            exponent - 1.0
        )

    def __call__(self, row: IndexArray, ratio: FloatArray) -> FloatArray:
        """At ratios c of shape (m,) of the profiles ``row``."""
        return chebyshev.evaluate(self.series, 4.0 * ratio * ratio - 1.0, row) + self._pole(row, ratio)

    def _pole(self, row: IndexArray, ratio: FloatArray) -> FloatArray:
        """The two terms that are taken together."""
        offset, logarithm = self.offset[row], np.log(np.maximum(ratio, TINY))
        rise = np.expm1(offset * logarithm)
        difference = np.divide(-rise, offset, out=-logarithm, where=offset != 0.0)
        together = self.at_pole[row] * difference + self.rest[row] * (1.0 + rise)
        return np.asarray(np.exp(self.even[row] * logarithm) * together)


class PowerLawCylinder(PlaneProfile, PowerLaw):
    """n profiles N/N_0 = ξⁿ: the disc's g, so that its tables serve both."""

    @classmethod
    def length_law(cls, **shape: float) -> tuple[float, float]:
        # f = |x|ⁿ/(n Rⁿ⁻¹), as the disc's: N = E* ξⁿ/Rⁿ⁻¹ ∫ sⁿ/√(1 − s²) ds, and N = (π/4) E* δ0 at a_H.
        from scipy.special import beta  # as long to import as all else, and few need it

        n = shape["exponent"]
        return 0.5 * float(beta(0.5 * (n + 1.0), 0.5)) / MEAN_LOAD, 1.0 / n

    def weighted_slope(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * super().weighted_slope(radius)

    def depth_and_weighted_slope(self, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
        depth = self.depth(radius)
        return depth, MEAN_LOAD * align(self.exponent, radius) * depth

    def depth_over_radius(self, radius: FloatArray) -> FloatArray:
        return self.depth(radius) / align(self.exponent, radius)

    def primitives(self, position: FloatArray, digits: float) -> Primitives:
        return PowerStripPrimitives(self.exponent, position, digits)


class PowerStripPrimitives(PlanePrimitives):
    """The disc's integral over the outer springs, and over the inner ones that of the exponent n − 1."""

    def __init__(self, exponent: FloatArray, position: FloatArray, digits: float) -> None:
        self.exponent, self.position = exponent, position
        self._of_disc = PowerPrimitives(exponent, position, digits)
        self._inner = inner_series(exponent - 1.0, digits)

    def inner(self, radius: FloatArray) -> FloatArray:
        r, n, scale = (align(v, radius) for v in (self.position, self.exponent, self._of_disc.power))
        sine = np.minimum(radius / r, 1.0)
        return (2.0 * MEAN_LOAD * n * scale * sine**n * evaluate_inner(self._inner, sine))[None]

    def pressure(self, radius: FloatArray) -> FloatArray:
        return MEAN_LOAD * self._of_disc.pressure(radius)
