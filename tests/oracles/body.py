"""swt at a place of the body, over all planes, by Boussinesq's and Cerruti's point loads.

Rings of point loads under unit pressure, and under unit traction in x, are summed over their angles. A
spring at ξ presses like a flat punch, ρ/√(ξ² − ρ²) on the rings ρ: its stress is their sum, and that of the
contact the sum over the springs, which `oracles.line` tells, as it does the loads. At the surface it is
`oracles.circle`.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from oracles import circle
from oracles.line import _NODE, _WEIGHT, Interval, Line, _cubic, _intervals
from oracles.point_loads import boussinesq, cerruti

Array = NDArray[np.float64]
#: Nodes over half of a ring's angles, rings, and cells of the springs.
ANGLES, RINGS, CELLS = 40, 320, 160
#: Gauss's nodes between two rings.
_BETWEEN, _SHARE = np.polynomial.legendre.leggauss(3)
#: Instants of a part of an interval, in the first look at the planes and in the closer ones.
STEPS, CLOSER_STEPS = 12, 40
#: Rounds of closer looks at the planes, of so many normals about the best, and how they narrow.
ROUNDS, NARROWER = 9, 0.5


class Beneath:
    """Stress at a place by all springs within ξ, as a table over s = √(ξ² − b²).

    ``pressed`` and ``pulled`` give, of the pressure and of the same as traction in x, σ_xx, σ_yy, σ_zz, σ_yz,
    σ_xz and σ_xy at radii ξ, shape (6, …) of ξ.
    """

    def __init__(self, line: Line, place: tuple[float, float, float]) -> None:
        profile, (x, y, self.depth) = line.profile, place
        self.b, self.away = profile.b, float(np.hypot(x, y))
        largest = float(np.hypot(profile.s[-1], profile.b))
        rings = self._graded(largest, RINGS)
        of_rings = CubicSpline(rings, self._rings(rings, float(np.arctan2(y, x)), line.ν))
        cells = self._graded(largest, CELLS)
        s = np.sqrt(np.maximum(cells**2 - self.b**2, 0.0))
        near = largest * np.geomspace(1e-9, 1e-2, 15)  # roots at the tip of some profiles
        self.s = np.unique(np.concatenate([s, near[near < s[-1]]]))

        def slope(s: Array) -> Array:
            ξ = np.hypot(s, self.b)
            punch = np.concatenate([_punches(of_rings, rings, part) for part in np.array_split(ξ, 8)])
            # g′ dξ is m/ξ ds.
            return np.asarray((profile.m(s) / np.maximum(ξ, 1e-300))[:, None] * punch / np.pi)

        half = 0.5 * np.diff(self.s)
        at = self.s[:-1, None] + half[:, None] * (1.0 + _NODE)
        parts = np.einsum("k,kjc,j->kc", half, slope(at.ravel()).reshape(*at.shape, 12), _WEIGHT)
        self.sum = np.concatenate([np.zeros((1, 12)), np.cumsum(parts, axis=0)])
        self.slope = slope(self.s)

    def _graded(self, largest: float, count: int) -> Array:
        """Radii from 0 to the largest, the closer the nearer they are to the place."""
        ends = np.arcsinh((np.array([0.0, largest]) - self.away) / self.depth)
        radii = self.away + self.depth * np.sinh(np.linspace(ends[0], ends[1], count + 1))
        radii[[0, -1]] = 0.0, largest
        return radii

    def _rings(self, radii: Array, turn: float, ν: float) -> Array:
        """Stress by rings of unit load per area, over radius and width, shape (n, 12)."""
        # Nodes are the closer the nearer the place: its distance from the ring over the ring's size.
        near = np.hypot(radii - self.away, self.depth) / np.sqrt(np.maximum(radii * self.away, 1e-300))
        near = np.minimum(near, np.pi)[:, None]
        end = np.arcsinh(np.pi / near)
        node, weight = np.polynomial.legendre.leggauss(ANGLES)
        u = 0.5 * end * (1.0 + node)
        φ, weight = near * np.sinh(u), 0.5 * end * weight * near * np.cosh(u)
        total = np.zeros((12, len(radii)))
        for side in (1.0, -1.0):
            X = self.away * np.cos(turn) - radii[:, None] * np.cos(turn + side * φ)
            Y = self.away * np.sin(turn) - radii[:, None] * np.sin(turn + side * φ)
            both = np.concatenate([of(X, Y, self.depth, ν) for of in (boussinesq, cerruti)])
            total += (both * weight).sum(axis=-1)
        return np.asarray(total.T)

    def pressed(self, ξ: Array) -> Array:
        return self._at(ξ, slice(0, 6))

    def pulled(self, ξ: Array) -> Array:
        return self._at(ξ, slice(6, 12))

    def _at(self, ξ: Array, kinds: slice) -> Array:
        s = np.sqrt(np.maximum(ξ * ξ - self.b**2, 0.0))
        k = np.clip(np.searchsorted(self.s, s, "right") - 1, 0, len(self.s) - 2)
        step = (self.s[k + 1] - self.s[k])[..., None]
        share = np.clip((s - self.s[k])[..., None] / step, 0.0, 1.0)
        y, d = self.sum[:, kinds], self.slope[:, kinds]
        found = _cubic(share, y[k], y[k + 1], d[k] * step, d[k + 1] * step)[0]
        return np.moveaxis(np.asarray(found), -1, 0)


def _punches(of_rings: CubicSpline, rings: Array, ξ: Array) -> Array:
    """Stress by ρ/√(ξ² − ρ²) on the rings, shape (n, 12); w = √(ξ² − ρ²) takes the root away."""
    ends = np.sqrt(np.maximum(ξ[:, None] ** 2 - rings**2, 0.0))
    half = 0.5 * (ends[:, :-1] - ends[:, 1:])
    total = np.zeros((len(ξ), 12))
    for node, weight in zip(_BETWEEN, _SHARE, strict=True):
        w = ends[:, 1:] + half * (1.0 + node)
        ρ = np.sqrt(np.maximum(ξ[:, None] ** 2 - w * w, 0.0))
        total += weight * np.einsum("nk,nkc->nc", half, of_rings(ρ))
    return total


def history(line: Line, place: tuple[float, float, float], count: int) -> Array:
    """Stress over the cycle beneath the surface, shape (6, 1, J, count + 1), as `Line.stress` has it."""
    beneath = Beneath(line, place)
    r = np.array([max(beneath.away, 1e-6 * float(line.profile.s[-1]))])
    about = line.coordinate(r)
    intervals = _intervals(line.course, 400, float(about[0]), 1e-3)
    return np.concatenate([_within(line, of, beneath, r, count) for of in intervals], axis=2)


def _within(line: Line, of: Interval, beneath: Beneath, r: Array, count: int) -> Array:
    share = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, count + 1))
    # A front passes a place within about its depth.
    near = np.concatenate([r + beneath.depth * np.array([-1.0, 0.0, 1.0])])
    near = near[near > 0.0]
    ends = np.unique(line._passages(of, line.coordinate(near), near))
    t = (ends[:-1, None] + np.diff(ends)[:, None] * share)[None]
    found = beneath.pressed(line.radius(line.course.n(t))) - line.μ * line.sheared(of, t, beneath.pulled)
    found[0] += line.course.bulk(t)
    return np.asarray(found)


def body_s(arguments: Mapping[str, Any], place: tuple[float, float, float]) -> float:
    """swt at a place, over all planes; at the surface the largest one on the circle through it."""
    if place[2] == 0.0:
        return circle.circle_s(arguments, float(np.hypot(*place[:2])))[0]
    line = Line(arguments)
    if line.profile.strip:
        raise ValueError("of a plane contact there is the section alone")
    coarse, fine = (history(line, place, count) for count in (STEPS, CLOSER_STEPS))
    planes = circle.hemisphere(circle.PLANES)
    values, best = circle.on_planes(line, coarse, planes, False), 0.0
    for normal in circle.high_planes(values, planes):
        turn = 0.08
        for _ in range(ROUNDS):
            normals = circle.about(normal, turn)
            closer = circle.on_planes(line, fine, normals, True)
            normal, turn = normals[closer.argmax()], NARROWER * turn
        best = max(best, float(closer.max()))
    return best
