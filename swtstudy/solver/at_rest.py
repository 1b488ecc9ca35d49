"""Depth, normal force, radius and pressure of profiles in contact, from dG/ds alone; nothing is compiled.

The kernel has tables of them for one profile each (`swtstudy.kernel.profiles`). Here many shapes are looked
at together, when a study is read, and a few contacts by themselves.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from swtstudy.solver.table import AnyProfile, TabulatedProfile
from swtstudy.vocabulary.arrays import BoolArray, FloatArray, Shape
from swtstudy.vocabulary.choices import family_of, is_plane
from swtstudy.vocabulary.families import FORMS, MEAN_LOAD, Form, power_law, smallest_wavelength, wave_number

#: Integrals from 0 to s are over panels that are halved towards 0 so often at most, with so many Gauss
#: points each: singularities at s = ±ib are as far away as a panel is long, wherever they are.
HALVINGS, POINTS = 48, 10
#: Longest panel in rad of waves, panels over a table, which has knots, and halvings of the smallest face.
PHASE, OF_TABLE, BESIDE = 4.0, 64, 3.0
#: Waves with more rad in a_H are left out: s is within 1e-5 of that without.
SHORT = 512.0
#: A root is found to this, relative, in so many steps of Newton's method or halvings at most.
SAME, MOST_STEPS = 1e-13, 80
#: Radii at which the largest pressure is looked for, and how often, each time about the highest one.
RADII, LOOKS = 201, 4

#: Shapes whose depths are found together from forces: the working memory for one is some 7 kB.
_TOGETHER = 5_000


class AtRest:
    """n profiles of one family, or one table. Arrays of radii, depths and the like have shape (n, m).

    Parameters
    ----------
    profile
        Name of a family, or a table.
    shape
        Its shape parameters, each of shape (n,); empty for families without one, and for a table: n is 1.

    Attributes
    ----------
    plane
        True for strips: radii are half-widths then, and depths line loads over the mean one.
    flat_radius
        Shape (n, 1): b.
    """

    def __init__(self, profile: AnyProfile, shape: Mapping[str, Any] | None = None) -> None:
        self.plane = is_plane(profile)
        self._table = profile if isinstance(profile, TabulatedProfile) else None
        self._form = Form(power_law) if self._table else FORMS[str(profile)]
        names = family_of(profile).shape
        values = [np.atleast_1d(np.asarray((shape or {})[name], float))[:, None] for name in names]
        #: Largest wave number.
        self._waves, self._is_wavy = 0.0, "wavelength" in names
        if self._is_wavy:
            k = wave_number(*values)
            values[0] = np.where(k > SHORT, 0.0, values[0])
            self._waves = float(k[k <= SHORT].max(initial=0.0))
        self._values = values or [np.full((1, 1), 2.0)]
        face = self._table.flat_radius if self._table else values[0] if self._form.faced else 0.0
        self.flat_radius = np.asarray(face, float) + np.zeros_like(self._values[0])

    def density(self, s: FloatArray) -> FloatArray:
        """dG/ds, of shape (n, …)."""
        if self._table:
            return self._table.density(s) / (MEAN_LOAD if self.plane else 1.0)
        return self._form.density(s, *(value.reshape(-1, *(1,) * (s.ndim - 1)) for value in self._values))

    def rise(self, s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """G, and half of the normal force over E* δ0 a_H or E* δ0, up to s = √(ξ² − b²)."""
        if self._table:
            depth, half_load = self._table.rise(s)
            return (depth / MEAN_LOAD, 0.5 * depth) if self.plane else (depth, half_load)
        if self._form.density is power_law:
            n = self._values[0]
            depth = s**n
            return depth, (0.5 * MEAN_LOAD * depth if self.plane else n / (n + 1.0) * s * depth)
        largest = float(s.max(initial=0.0))
        node, weight = _rule(self._panels(largest), self._halvings(largest))
        at = s[..., None] * node
        rate = self.density(at) * weight
        depth = s * rate.sum(axis=-1)
        if self.plane:
            return depth, 0.5 * MEAN_LOAD * depth
        return depth, s * (rate * np.hypot(at, self.flat_radius[..., None])).sum(axis=-1)

    def depth(self, radius: FloatArray) -> FloatArray:
        """G = g(ξ)/δ0 (eq. 11), or N/N_0."""
        return self.rise(self._place(radius))[0]

    def radius(self, depth: FloatArray) -> FloatArray:
        """Contact radius ξ/a_H at a depth, b at depth 0."""
        return self._radius_where(0, depth)

    def radius_at(self, half_load: FloatArray) -> FloatArray:
        """Contact radius ξ/a_H at half of a normal force."""
        return self._radius_where(1, half_load)

    def unit(self) -> FloatArray:
        """Half of the normal force at the depth δ0, shape (n, 1)."""
        return self.rise(self._place(self.radius(np.ones_like(self.flat_radius))))[1]

    def pressure(self, radius: FloatArray, edge: FloatArray) -> FloatArray:
        """Pressure over E* δ0/a_H at radii, ∫ dG/(π √(ξ² − r²)) up to the contact radius ``edge``, (n, 1)."""
        b = self.flat_radius
        square, end = (radius - b) * (radius + b), self._place(edge)
        inner = np.sqrt(np.maximum(square, 0.0))
        width = np.sqrt(np.maximum((end - inner) * (end + inner), 0.0))
        node, weight = _rule(self._panels(float(end.max(initial=0.0))), HALVINGS)
        at = width[..., None] * node
        rate = self.density(np.hypot(inner[..., None], at)) / np.sqrt(at * at + np.abs(square)[..., None])
        scale = MEAN_LOAD if self.plane else 1.0
        return np.asarray(scale / np.pi * width * (rate * weight).sum(axis=-1))

    def largest_pressure(self) -> float:
        """The largest pressure of the first profile at the depth δ0; inf at the edge of a sharp face."""
        if self._form.singular and self.flat_radius[0, 0] > 0.0:
            return np.inf
        n = float(self._values[0][0, 0])
        if self._form.density is power_law and not self._table and n <= 2.0:
            # At the centre; of a sharp tip it rises within any radius.
            return (MEAN_LOAD if self.plane else 1.0) / np.pi * n / (n - 1.0)
        edge = self.radius(np.ones_like(self.flat_radius))[:1]
        low, high, best = 0.0, 1.0, 0.0
        for _ in range(LOOKS):
            share = np.linspace(low, high, RADII)
            r = edge * np.sin(0.5 * np.pi * share)
            found = self.pressure(r, edge)[0]
            k = int(found.argmax())
            best, step = max(best, float(found[k])), share[1] - share[0]
            low, high = max(share[k] - step, 0.0), min(share[k] + step, 1.0)
        return best

    def _place(self, radius: FloatArray) -> FloatArray:
        """s of radii, 0 on the face."""
        return np.asarray(np.sqrt(np.maximum((radius - self.flat_radius) * (radius + self.flat_radius), 0.0)))

    def _panels(self, largest: float) -> int:
        """Even panels on the way up to s."""
        return OF_TABLE if self._table else 1 + int(self._waves * largest / PHASE)

    def _halvings(self, largest: float) -> int:
        """Halvings towards 0 on the way up to s: none of waves, all where no face says how many."""
        if not self._form.faced:
            return 0 if self._is_wavy else HALVINGS
        b = self.flat_radius[self.flat_radius > 0.0]
        halvings = np.log2(largest / b.min()) + BESIDE if largest > 0.0 and b.size else 0.0
        return int(min(max(halvings, 0.0), HALVINGS))

    def _radius_where(self, which: int, goal: FloatArray) -> FloatArray:
        """Radius where G (0) or half of a force (1) has a value: Newton's method in logarithms."""
        goal = np.maximum(goal, 0.0) + np.zeros_like(self.flat_radius)
        s = np.where(goal > 0.0, 1.0, 0.0)
        low, high = np.zeros_like(s), np.full_like(s, np.inf)
        for _ in range(MOST_STEPS):
            found = self.rise(s)[which]
            low, high = np.where(found < goal, s, low), np.where(found >= goal, s, high)
            with np.errstate(all="ignore"):
                rate = self.density(s)  # of G, and of half of the force so many times that
                if which == 1:
                    rate = rate * (0.5 * MEAN_LOAD if self.plane else np.hypot(s, self.flat_radius))
                new = s * np.exp(np.log(goal / found) * found / (s * rate))
            middle = np.where(np.isfinite(high), 0.5 * (low + high), 2.0 * s)
            # A last step may lead out of the bracket by its rounding.
            inside = (new > low) & (new < high) | (np.abs(new - s) <= SAME * s)
            new = np.where((goal == 0.0) | (found == goal), s, np.where(inside, new, middle))
            moved, s = np.abs(new - s), new
            if np.all(moved <= SAME * s):
                break
        return np.hypot(s, self.flat_radius)


@lru_cache(maxsize=32)
def _rule(even: int, halvings: int) -> tuple[FloatArray, FloatArray]:
    """Nodes and weights on (0, 1), of even panels whose ends are halved towards 0."""
    edges = np.union1d(np.linspace(0.0, 1.0, even + 1), 0.5 ** np.arange(halvings + 1))
    node, weight = np.polynomial.legendre.leggauss(POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    return (edges[:-1, None] + half * (1.0 + node)).ravel(), (half * weight).ravel()


def largest_depths(profile: AnyProfile, shape: Shape, force: FloatArray) -> FloatArray:
    """Largest depths of n profiles at the largest normal forces over those at δ0, both of shape (n,).

    They are known for shapes whose contact carries the force at δ0, and 1 for others.
    """
    depth = np.ones_like(force)
    sound = np.flatnonzero(compact_shapes(profile, shape, depth))
    for rows in np.array_split(sound, len(sound) // _TOGETHER + 1) if len(sound) else ():
        depth[rows] = force[rows]
        if not is_plane(profile):
            at_rest = AtRest(profile, {name: values[rows] for name, values in shape.items()})
            own = force[rows].reshape(len(at_rest.flat_radius), -1) * at_rest.unit()
            depth[rows] = at_rest.depth(at_rest.radius_at(own)).ravel()
    return depth


def compact_shapes(profile: AnyProfile, shape: Shape, largest: Any) -> BoolArray:
    """True where the contact of n shapes is a full disc or strip up to the largest depths, (n,) or one."""
    if isinstance(profile, TabulatedProfile):
        return np.asarray(np.asarray(largest) <= profile.deepest)
    if "wavelength" not in shape:
        return np.ones(np.broadcast_shapes(np.shape(largest), *map(np.shape, shape.values())), bool)
    h, wavelength = shape["waviness_amplitude"], shape["wavelength"]
    return (h == 0.0) | (wavelength >= smallest_wavelength(profile, largest, h, wavelength))


def too_small(profile: str, shape: Mapping[str, float], largest: float) -> tuple[str, float] | None:
    """The shape parameter that no full disc up to a depth can have, and its least value, or None."""
    h, wavelength = (np.array([shape.get(name, 0.0)]) for name in ("waviness_amplitude", "wavelength"))
    if "wavelength" not in shape or h[0] == 0.0:
        return None
    least = float(smallest_wavelength(profile, largest, h, wavelength)[0])
    return None if wavelength[0] >= least else ("wavelength", least)


def check_shape(profile: AnyProfile, shape: Mapping[str, float], largest: float) -> str | None:
    """Why a profile cannot be used up to a depth, or None."""
    if isinstance(profile, TabulatedProfile):
        return profile.refused_at(largest)
    limit = too_small(profile, shape, largest)
    if limit is None:
        return None
    name, least = limit
    others = ", ".join(f"{other} {value:g}" for other, value in shape.items() if other != name)
    load, unit = ("load", "P0") if is_plane(profile) else ("depth", "δ0")
    return (
        f"{name} {shape[name]:g} is below {least:.4g}, the smallest for which the contact stays compact"
        f"{' at ' * bool(others)}{others} up to the {load} {largest:g} {unit}"
    )
