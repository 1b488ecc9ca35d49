"""From a table of f(r) to g′(ξ) as pieces of polynomials.

f is a cubic spline, so that g′ = ∫ (r f′)′ dr/√(ξ² − r²) has a closed form, a sum over the knots inside ξ.
That sum is fitted once, by pieces that are as long as g′ lets them be: in w = √(ξ² − b²), in which it is
smooth also behind a flat face.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial.polynomial import polyval

from swtstudy.mechanics.numerics.arrays import TINY, polynomial_in
from swtstudy.mechanics.points import BoolArray, FloatArray, IndexArray

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

#: Degree of g′/ξ on a piece.
DEGREE = 4
#: What the pieces miss of g′, over its largest value, and over what a table of every other point misses.
TOLERANCE, SHARE_OF_COARSE = 1e-8, 0.1
#: Radii at which the two tables are compared.
COMPARED = 400
#: Pieces are halved until they fit, but not further than this share of the whole: a corner of 20,000 points
#: would take 54,000; nor than a quarter of the steps of the table.
SHORTEST = 1e-3
FIRST_PIECES = 8
#: Pieces shorter than this share of the whole are of two degrees less: in powers of w high ones lose digits.
NARROW = 0.015
#: Numbers that are worked on at once.
_SLAB = 2_000_000


def spline(radius: FloatArray, height: FloatArray, smoothing: float) -> PPoly:
    """f from where it rises first, with no slope there, and 0 there.

    Parameters
    ----------
    radius, height
        Shape (k,), ascending from 0; heights of 0 at the begin are a flat face.
    smoothing
        Root mean square of what it may miss of the heights; 0 to miss none.
    """
    # As long to import as all else, and few need it.
    from scipy.interpolate import CubicSpline, PPoly, make_smoothing_spline
    from scipy.optimize import brentq

    face = int(np.argmax(height != 0.0)) - 1
    r, f = radius[face:].copy(), height[face:]
    if face > 0:
        # Behind a face f rises like a square: where that would begin.
        rise = np.sqrt(f[1:3])
        r[0] = np.clip(r[1] - rise[0] * (r[2] - r[1]) / (rise[1] - rise[0]), r[0], r[1] - 0.1 * (r[1] - r[0]))
    if smoothing == 0.0:
        return CubicSpline(r, f, bc_type=((1, 0.0), "not-a-knot"))
    # Even in r: that makes the slope vanish at the begin.
    both = np.concatenate([2.0 * r[0] - r[:0:-1], r]), np.concatenate([f[:0:-1], f])

    def smooth(logarithm: float) -> PPoly:
        return PPoly.from_spline(make_smoothing_spline(*both, lam=10.0**logarithm))

    def excess(logarithm: float) -> float:
        missed = smooth(logarithm)(r) - f
        return float(np.sqrt(np.mean(missed**2))) - smoothing

    lowest, highest = -18.0, 6.0
    if excess(lowest) >= 0.0:
        found = smooth(lowest)
    elif excess(highest) <= 0.0:
        found = smooth(highest)
    else:
        found = smooth(brentq(excess, lowest, highest, xtol=1e-6))
    first = int(np.searchsorted(found.x, r[0], "right")) - 1
    part = PPoly(found.c[:, first:].copy(), found.x[first:])
    part.c[-1] -= part.c[-1, 0]
    return part


def exact_slope(f: PPoly, radius: FloatArray) -> FloatArray:
    """g′ of a cubic spline with f′ = 0 at its begin, at radii ξ of shape (m,)."""
    knots = f.x[:-1]
    c3, c2, c1 = f.c[:3]
    # (r f′)′ on each piece in powers of r, and its jumps at the knots.
    bend = 2.0 * c2 - 6.0 * c3 * knots
    powers = np.stack([c1 - 2.0 * c2 * knots + 3.0 * c3 * knots**2, 2.0 * bend, 9.0 * c3])
    jumps = np.diff(powers, axis=1, prepend=0.0)
    result = np.empty_like(radius)
    step = max(_SLAB // len(knots), 1)
    for begin in range(0, len(radius), step):
        ξ = radius[begin : begin + step, None]
        ratio = np.minimum(knots / np.maximum(ξ, 1e-200), 1.0)
        cosine = np.sqrt((1.0 - ratio) * (1.0 + ratio))
        rest = np.arccos(ratio)
        # Integrals of rᵏ/√(ξ² − r²) from the knot to ξ.
        square = 0.5 * ξ * ξ * (rest + ratio * cosine)
        result[begin : begin + step] = rest @ jumps[0] + (ξ * cosine) @ jumps[1] + square @ jumps[2]
    return result


def exact_load_slope(f: PPoly, radius: FloatArray) -> FloatArray:
    """N′ = ξ ∫ f″ dx/√(ξ² − x²) of a cubic spline with f′ = 0 at its begin, at half-widths ξ, (m,)."""
    knots = f.x[:-1]
    c3, c2 = f.c[:2]
    jumps = np.diff(np.stack([2.0 * c2 - 6.0 * c3 * knots, 6.0 * c3]), axis=1, prepend=0.0)
    result = np.empty_like(radius)
    step = max(_SLAB // len(knots), 1)
    for begin in range(0, len(radius), step):
        ξ = radius[begin : begin + step, None]
        ratio = np.minimum(knots / np.maximum(ξ, TINY), 1.0)
        cosine = np.sqrt((1.0 - ratio) * (1.0 + ratio))
        result[begin : begin + step] = ξ[:, 0] * (np.arccos(ratio) @ jumps[0] + (ξ * cosine) @ jumps[1])
    return result


#: From a spline f and radii, (m,), to g′ there, or to N′.
SlopeOf = Callable[["PPoly", FloatArray], FloatArray]


@dataclass(frozen=True)
class Exact:
    """The slope of a spline f over w = √(ξ² − b²), of any shape."""

    f: PPoly
    slope_of: SlopeOf

    @property
    def b(self) -> float:
        """Where f begins to rise."""
        return float(self.f.x[0])

    def slope(self, w: FloatArray) -> FloatArray:
        """g′ at w."""
        return self.slope_of(self.f, np.hypot(w, self.b).ravel()).reshape(w.shape)

    def over_radius(self, w: FloatArray) -> FloatArray:
        """g′/ξ at w; on the axis as next to it."""
        radius = np.maximum(np.hypot(w, self.b), 1e-6 * self.f.x[-1])
        return self.slope_of(self.f, radius.ravel()).reshape(w.shape) / radius


@dataclass(frozen=True)
class SlopePieces:
    """g′, or in the plane N′, as pieces of polynomials over w = √(ξ² − b²).

    Attributes
    ----------
    flat_radius
        b.
    start
        Shape (m,): w at which each piece begins, ascending from 0; the last one goes on for ever.
    over_radius, slope
        Coefficients of g′/ξ and of g′ in powers of w − start, shapes (DEGREE + 1, m) and (DEGREE + 2, m).
    """

    flat_radius: float
    start: FloatArray
    over_radius: FloatArray
    slope: FloatArray

    @classmethod
    def of(cls, f: PPoly, missed: float, slope_of: SlopeOf = exact_slope) -> SlopePieces:
        """The pieces that fit a spline to so much of its g′; beyond its end g′/ξ is constant."""
        b, end = float(f.x[0]), float(f.x[-1])
        last = np.sqrt((end - b) * (end + b))
        exact = Exact(f, slope_of)
        edges = _edges(exact, last, missed)
        start, width = edges[:-1], np.diff(edges)
        over_radius = _fitted(exact.over_radius, start, width, DEGREE, width < NARROW * last)
        if b > 0.0:
            slope = _fitted(exact.slope, start, width, DEGREE + 1, width < NARROW * last)
        else:
            slope = _times_w(over_radius, start)
        beyond, rise = (float(polyval(width[-1], values[:, -1])) for values in (over_radius, slope))
        tail = np.zeros((DEGREE + 1, 1)), np.zeros((DEGREE + 2, 1))
        tail[0][0], tail[1][:2, 0] = beyond, (rise, beyond)
        return cls(
            b, edges, *(np.append(c, t, axis=1) for c, t in zip((over_radius, slope), tail, strict=True))
        )

    @cached_property
    def depth(self) -> FloatArray:
        """Coefficients of g, as of the others, (DEGREE + 3, m): its derivative by w is w g′/ξ."""
        return self._integrated(_times_w(self.over_radius, self.start))

    @cached_property
    def half_load(self) -> FloatArray:
        """Coefficients of ∫ ξ g′ dξ, (DEGREE + 4, m): its derivative by w is w g′."""
        return self._integrated(_times_w(self.slope, self.start))

    def _integrated(self, rate: FloatArray) -> FloatArray:
        power = np.arange(1, len(rate) + 1)[:, None]
        integral = np.concatenate([np.zeros_like(rate[:1]), rate / power])
        gains = polyval(np.diff(self.start), integral[:, :-1], tensor=False)
        integral[0, 1:] = np.cumsum(gains)
        return integral

    def piece(self, w: FloatArray) -> IndexArray:
        """The piece in which each w lies."""
        return np.searchsorted(self.start[1:], w, "right")

    def value(self, coefficients: FloatArray, w: FloatArray, piece: IndexArray) -> FloatArray:
        """One of the functions at w in its pieces."""
        return polynomial_in(coefficients, piece, w - self.start.take(piece))


def resolved(f: PPoly, coarse: PPoly, slope_of: SlopeOf = exact_slope) -> float:
    """Estimate the error of g′, from the splines through all points and through every other one."""
    radius = np.linspace(max(f.x[0], coarse.x[0]), min(f.x[-1], coarse.x[-1]), COMPARED)
    fine = slope_of(f, radius)
    differs = np.abs(slope_of(coarse, radius) - fine)
    return float(max(TOLERANCE * np.abs(fine).max(), SHARE_OF_COARSE * np.quantile(differs, 0.9)))


def _edges(exact: Exact, last: float, allowed: float) -> FloatArray:
    """Ends of the pieces, in w."""
    edges = np.linspace(0.0, last, FIRST_PIECES + 1)
    narrowest = max(0.5 * float(np.diff(exact.f.x).min()), SHORTEST * last)
    settled: list[FloatArray] = []
    start, width = edges[:-1], np.diff(edges)
    between = (np.arange(DEGREE + 3) + 0.5) / (DEGREE + 3)
    while start.size:
        over_radius = _fitted(exact.over_radius, start, width, DEGREE, width < NARROW * last)
        slope = _fitted(exact.slope, start, width, DEGREE + 1, width < NARROW * last)
        w = start[:, None] + width[:, None] * between
        found = np.stack(
            [polyval(w - start[:, None], fit[:, :, None], tensor=False) for fit in (over_radius, slope)]
        )
        missed = np.abs(found * np.stack([np.hypot(w, exact.b), np.ones_like(w)]) - exact.slope(w)).max(
            axis=0
        )
        bad = (missed.max(axis=1) > allowed) & (width > narrowest)
        settled.append(start[~bad])
        start, width = start[bad], 0.5 * width[bad]
        start, width = np.concatenate([start, start + width]), np.tile(width, 2)
    return np.append(np.sort(np.concatenate(settled)), last)


def _fitted(  # type: ignore[no-untyped-def]
    function, start: FloatArray, width: FloatArray, degree: int, narrow: BoolArray
) -> FloatArray:
    """Coefficients (degree + 1, m) of polynomials through the function, of lower degree where narrow."""
    coefficients = np.zeros((degree + 1, start.size))
    for some, own in ((~narrow, degree), (narrow, degree - 2)):
        coefficients[: own + 1, some] = _through_points(function, start[some], width[some], own)
    return coefficients


def _through_points(function, start: FloatArray, width: FloatArray, degree: int) -> FloatArray:  # type: ignore[no-untyped-def]
    """Coefficients (degree + 1, m) of the polynomials through Chebyshev's points, ends included."""
    share = 0.5 - 0.5 * np.cos(np.pi * np.arange(degree + 1) / degree)
    values = function(start[:, None] + width[:, None] * share)
    matrix = np.linalg.inv(share[:, None] ** np.arange(degree + 1))
    return np.einsum("ij,mj->im", matrix, values) / width ** np.arange(degree + 1)[:, None]


def _times_w(coefficients: FloatArray, start: FloatArray) -> FloatArray:
    """The functions times w."""
    longer = np.zeros((len(coefficients) + 1, len(start)))
    longer[:-1] = coefficients * start
    longer[1:] += coefficients
    return longer
