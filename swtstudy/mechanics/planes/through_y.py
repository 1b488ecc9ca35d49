"""The critical plane (eq. 9) at points of the surface line, where σ_xy = σ_yz = 0.

On a plane whose normal lies at the angle θ from x towards z, both the tension and the swing of a criterion
are A + B cos 2θ + C sin 2θ at each instant. For given instants of their extremes it is a function of two such
functions, for swt their product, whose maximum Newton's method finds.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.numerics.arrays import pick
from swtstudy.mechanics.numerics.roots import NEWTON_STEPS
from swtstudy.mechanics.planes.ascent import LARGEST_STEP
from swtstudy.mechanics.planes.criterion import SWT, Criterion
from swtstudy.mechanics.points import FloatArray, IndexArray

#: Largest step of 2θ in one Newton step, rad: that of a plane.
LARGEST_TURN = 2.0 * LARGEST_STEP
#: Points of a block whose planes are tried together: it stays in the processor's cache. All 256 points of a
#: batch: 1.4 times the time; 8: 1.5 times.
BLOCK = 64
#: Share of a point's largest swt below which the planes of a coarse look are not improved: what is followed
#: is within `swtstudy.mechanics.line.first_look.SHARE`. 0: no change, 3 % slower.
IMPROVED_SHARE = 0.6


@dataclass(frozen=True)
class PlaneHistory:
    """σ_n and the swing of a criterion over the planes through y, at many points and instants.

    Attributes
    ----------
    stress
        Shape (3, …, T): A, B, C of σ_n in E* √(δ0/R).
    swing
        Shape (3, …, T): A, B, C of the swing, of ε_n in √(δ0/R).
    criterion
        Shape (…) or broadcast to it.
    """

    stress: FloatArray
    swing: FloatArray
    criterion: Criterion

    @classmethod
    def from_stresses(
        cls,
        sigma: tuple[FloatArray, FloatArray, FloatArray, FloatArray],
        poisson_ratio: FloatArray,
        criterion: Criterion = SWT,
    ) -> PlaneHistory:
        """From σ_xx, σ_yy, σ_zz, σ_xz of shape (n, …, T), ν and criterion of shape (n,); E = (1 − ν²) E*."""
        xx, yy, zz, xz = sigma
        nu = poisson_ratio.reshape((-1,) + (1,) * (xx.ndim - 1))
        stress = np.stack([0.5 * (xx + zz), 0.5 * (xx - zz), np.broadcast_to(xz, xx.shape)])
        return cls(stress, criterion.swing.in_section(stress, yy, nu), criterion.reshape(*nu.shape[:-1]))

    def take(self, *index: IndexArray | slice) -> PlaneHistory:
        """Return the histories at ``index`` of the points' axes."""
        # The criterion is that of the point at all its positions.
        criterion = self.criterion.take((index[0], *(0 for _ in index[1:])))
        return PlaneHistory(self.stress[:, *index], self.swing[:, *index], criterion)

    def on_plane(self, double_angle: FloatArray) -> tuple[FloatArray, FloatArray]:
        """σ_n and the swing, shape (…, T), on the planes at 2θ, shape (…)."""
        cosine, sine = np.cos(double_angle)[..., None], np.sin(double_angle)[..., None]
        stress, swing = (a + b * cosine + c * sine for a, b, c in (self.stress, self.swing))
        return stress, swing


def apart(turn: FloatArray) -> FloatArray:
    """Angle between planes, rad in 2θ, from a difference of 2θ that may hold whole turns."""
    return np.asarray(np.abs(np.angle(np.exp(1j * turn))))


def coarse_swt(history: PlaneHistory, count: int) -> tuple[FloatArray, FloatArray]:
    """Largest swt over all planes, from ``count`` equally spaced ones, an even number.

    Parameters
    ----------
    history
        At n × X positions of n points.
    count
        Number of planes.

    Returns
    -------
    swt, double_angle
        Shape (n, X): swt over E* δ0/R on a plane near the best of these, improved once where it comes near to
        the point's largest; 2θ in rad.
    """
    blocks = range(0, history.stress.shape[1], BLOCK)
    table = np.concatenate([on_planes(history.take(slice(k, k + BLOCK)), count) for k in blocks], axis=1)
    step, best, swt = 2.0 * np.pi / count, table.argmax(axis=0), table.max(axis=0)
    angle = best * step
    at = np.nonzero(swt >= IMPROVED_SHARE * swt.max(axis=1, keepdims=True))
    left, right = (table[((best[at] + k) % count, *at)] for k in (-1, 1))
    # Two maxima may lie between the same planes.
    starts = np.stack([best[at], np.where(left > right, best[at] - 1, best[at] + 1)]) * step
    some = history.take(*at)
    starts = turned(some, starts, some.criterion.curves(*some.on_plane(starts)))
    tops = (curve.max(axis=-1) for curve in some.criterion.curves(*some.on_plane(starts)))
    found = some.criterion.of_maxima(*tops)
    swt[at], angle[at] = found.max(axis=0), np.where(found[1] > found[0], starts[1], starts[0])
    return swt, angle


def on_planes(history: PlaneHistory, count: int) -> FloatArray:
    """swt of histories, (…), on each of ``count`` evenly spaced planes, an even number, shape (count, …)."""
    # Extremes over the first axis are the fastest.
    stress, swing = (np.ascontiguousarray(np.moveaxis(v, -1, 1)) for v in (history.stress, history.swing))
    table = np.empty((count, *stress.shape[2:]))
    step, half = 2.0 * np.pi / count, count // 2
    curve, criterion = np.empty_like(stress[0]), history.criterion
    for k in range(half):
        of_stress, of_swing = (b * np.cos(k * step) + c * np.sin(k * step) for _, b, c in (stress, swing))
        # Half a turn of 2θ further the wave has the other sign.
        for plane, combine in ((k, np.add), (k + half, np.subtract)):
            tension = combine(stress[0], of_stress, out=curve).max(axis=0)
            combine(swing[0], of_swing, out=curve)
            table[plane] = criterion.of_maxima(tension, curve.max(axis=0), -curve.min(axis=0))
    return table


def turned(history: PlaneHistory, double_angle: FloatArray, curves: Iterable[FloatArray]) -> FloatArray:
    """Planes of locally largest swt near some, by the instants at which the curves are highest there.

    Parameters
    ----------
    history
        At points (…).
    double_angle
        2θ to start from, shape (s, …) or (…), rad.
    curves
        The three curves of the criterion on these planes, each with the T instants as its last axis.
    """
    parts = history.stress, history.swing, history.swing
    instants = (curve.argmax(axis=-1) for curve in curves)
    peak, high, low = (
        np.stack([pick(part, at) for part in own]) for own, at in zip(parts, instants, strict=True)
    )
    return best_angle(peak, 0.5 * (high - low), double_angle, history.criterion)


def best_angle(
    peak: FloatArray, amplitude: FloatArray, double_angle: FloatArray, criterion: Criterion
) -> FloatArray:
    """Maximum over 2θ of a criterion of A + B cos + C sin and D + E cos + F sin, near ``double_angle``.

    Parameters
    ----------
    peak, amplitude
        Shape (3, …): coefficients of σ_n at its maximum, and of half the swing's change between its extremes.
    double_angle
        Shape (…), rad.
    criterion
        Shape (…) or broadcast to it.
    """
    (a, b, c), (d, e, f) = peak, amplitude
    angle = double_angle
    for _ in range(NEWTON_STEPS):
        cosine, sine = np.cos(angle), np.sin(angle)
        u, v = b * cosine + c * sine, e * cosine + f * sine
        du, dv = c * cosine - b * sine, f * cosine - e * sine
        slope, bend = criterion.derivatives((a + u, du, -u), (d + v, dv, -v))
        step = np.where(bend < 0.0, -slope / np.where(bend < 0.0, bend, 1.0), np.sign(slope) * LARGEST_TURN)
        angle = angle + np.clip(step, -LARGEST_TURN, LARGEST_TURN)
    return angle
