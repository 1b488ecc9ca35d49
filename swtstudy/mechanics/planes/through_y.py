"""The critical plane (eq. 9) at points of the surface line, where σ_xy = σ_yz = 0.

On a plane whose normal lies at the angle θ from x towards z, both σ_n and ε_n are A + B cos 2θ + C sin 2θ at
each instant. For given instants of their extremes swt(θ) is a product of two such functions, whose maximum
Newton's method finds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.numerics.arrays import pick
from swtstudy.mechanics.planes import criterion
from swtstudy.mechanics.planes.criterion import Walker
from swtstudy.mechanics.points import FloatArray

#: Newton steps over the planes. One: 7e-6 at rtol 1e-4, the same time; six: rounding.
NEWTON_STEPS = 3
#: Largest step of 2θ in one Newton step, rad. Half or twice: no change at 128 points.
LARGEST_STEP = 0.4


@dataclass(frozen=True)
class PlaneHistory:
    """σ_n and ε_n over the planes through y, at many points and instants.

    Attributes
    ----------
    stress
        Shape (3, …, T): A, B, C of σ_n in E* √(δ0/R).
    strain
        Shape (3, …, T): A, B, C of ε_n in √(δ0/R).
    walker
        Shape (…) or broadcast to it: the criterion; None for swt.
    """

    stress: FloatArray
    strain: FloatArray
    walker: Walker | None = None

    @classmethod
    def from_stresses(
        cls,
        sigma: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
        poisson_ratio: FloatArray,
        walker_exponent: FloatArray | None = None,
    ) -> PlaneHistory:
        """From σ_xx, σ_yy, σ_zz, σ_xz of shape (n, …, T), with E = (1 − ν²) E*; ν and γ of shape (n,)."""
        xx, yy, zz, xz = sigma
        nu = poisson_ratio.reshape((-1,) + (1,) * (xx.ndim - 1))
        stress = np.stack([0.5 * (xx + zz), 0.5 * (xx - zz), np.broadcast_to(xz, xx.shape)])
        strain = stress / (1.0 - nu)
        strain[0] -= (nu / (1.0 - nu * nu)) * (2.0 * stress[0] + yy)
        if walker_exponent is None:
            return cls(stress, strain)
        γ = walker_exponent.reshape(nu.shape[:-1])
        return cls(stress, strain, Walker(γ, 1.0 - nu[..., 0] ** 2))

    def on_plane(self, double_angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """σ_n and ε_n, shape (…, T), on the planes at 2θ, shape (…)."""
        cosine, sine = np.cos(double_angle)[..., None], np.sin(double_angle)[..., None]
        stress, strain = (a + b * cosine + c * sine for a, b, c in (self.stress, self.strain))
        return stress, strain


def coarse_swt(history: PlaneHistory, count: int) -> tuple[FloatArray, FloatArray]:
    """Largest swt over all planes, from ``count`` equally spaced ones, an even number.

    Returns
    -------
    swt, double_angle
        Shape of the points (…): swt over E* δ0/R on a plane near the best of these, improved once; 2θ in rad.
    """
    # Extremes over the first axis are the fastest.
    stress, strain = (np.ascontiguousarray(np.moveaxis(v, -1, 1)) for v in (history.stress, history.strain))
    table = np.empty((count, *stress.shape[2:]))
    step, half = 2.0 * np.pi / count, count // 2
    curve = np.empty_like(stress[0])
    for k in range(half):
        of_stress, of_strain = (b * np.cos(k * step) + c * np.sin(k * step) for _, b, c in (stress, strain))
        # Half a turn of 2θ further the wave has the other sign.
        for plane, combine in ((k, np.add), (k + half, np.subtract)):
            tension = combine(stress[0], of_stress, out=curve).max(axis=0)
            combine(strain[0], of_strain, out=curve)
            table[plane] = criterion.of_maxima(
                tension, curve.max(axis=0), -curve.min(axis=0), walker=history.walker
            )
    best = table.argmax(axis=0)
    cell = np.arange(best.size).reshape(best.shape)
    left, right = (table.take((best + k) % count * best.size + cell) for k in (-1, 1))
    # Two maxima may lie between the same planes.
    starts = np.stack([best, np.where(left > right, best - 1, best + 1)]) * step
    angle = climb_over_planes(history, starts, 1)
    tops = (curve.max(axis=-1) for curve in criterion.curves(*history.on_plane(angle)))
    swt = criterion.of_maxima(*tops, walker=history.walker)
    return swt.max(axis=0), np.where(swt[1] > swt[0], angle[1], angle[0])


def climb_over_planes(history: PlaneHistory, double_angle: FloatArray, rounds: int) -> FloatArray:
    """Planes of locally largest swt, by looking up the instants of the extremes so many times.

    Parameters
    ----------
    history
        At points (…).
    double_angle
        2θ to start from, shape (s, …) or (…), rad.
    rounds
        Number of times.
    """
    for _ in range(rounds):
        stress, strain = history.on_plane(double_angle)
        peak, high, low = (
            np.stack([pick(part, at) for part in parts])
            for parts, at in (
                (history.stress, stress.argmax(axis=-1)),
                (history.strain, strain.argmax(axis=-1)),
                (history.strain, strain.argmin(axis=-1)),
            )
        )
        double_angle = best_angle(peak, high - low, double_angle, history.walker)
    return double_angle


def best_angle(
    peak: FloatArray, swing: FloatArray, double_angle: FloatArray, walker: Walker | None = None
) -> FloatArray:
    """Maximum over 2θ of (A + B cos + C sin)(D + E cos + F sin), or of powers of both, near ``double_angle``.

    Parameters
    ----------
    peak, swing
        Shape (3, …): coefficients of σ_n at its maximum, and of ε_n between its extremes.
    double_angle
        Shape (…), rad.
    walker
        The criterion; None for swt.
    """
    (a, b, c), (d, e, f) = peak, swing
    angle = double_angle
    for _ in range(NEWTON_STEPS):
        cosine, sine = np.cos(angle), np.sin(angle)
        u, v = b * cosine + c * sine, e * cosine + f * sine
        du, dv = c * cosine - b * sine, f * cosine - e * sine
        slope, bend = criterion.derivatives((a + u, du, -u), (d + v, dv, -v), walker)
        step = np.where(bend < 0.0, -slope / np.where(bend < 0.0, bend, 1.0), np.sign(slope) * LARGEST_STEP)
        angle = angle + np.clip(step, -LARGEST_STEP, LARGEST_STEP)
    return angle
