"""A real contact at rest, and the scales of all else (eqs. 1, 2, 19–21)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np

from swtstudy.mechanics.indenter import Profile, TabulatedProfile, length_law, make_profile
from swtstudy.points.canonical import canonical_number, rounded
from swtstudy.units.moduli import Moduli
from swtstudy.units.scales import number_of
from swtstudy.vocabulary.families import is_plane

#: Radii at which the largest pressure is looked for, and its digits.
_RADII, _DIGITS = 4001, 9.0


@lru_cache(maxsize=64)
def _pure(table: TabulatedProfile, length: float, depth: float) -> TabulatedProfile:
    """A table to the digits of canonical points: in whichever units it was given, it is the same."""
    pure = table.scaled(length, depth)
    smoothing = canonical_number(pure.smoothing)
    own = rounded(pure.radius), rounded(pure.height), smoothing
    return TabulatedProfile(pure.name, *own, pure.geometry)


@dataclass(frozen=True)
class Contact:
    """A real contact at rest, in any consistent set of units, such as N, mm and MPa.

    Attributes
    ----------
    moduli
        Of the two bodies.
    radius
        R; of a power law f = rⁿ/(n Rⁿ⁻¹); None for a table.
    depth
        Mean indentation depth δ0.
    friction
        μ, to which its slip is in proportion.
    profile
        Name of a family, or a table, whose radii and heights are lengths.
    shape
        What its profile has of flat_radius b, waviness_amplitude h and wavelength λ, lengths, and exponent n.
    contact_length
        Length of a plane contact across its section; None for loads per length, and for a disc.
    """

    moduli: Moduli
    radius: float | None
    depth: float
    friction: float
    profile: str | TabulatedProfile
    shape: Mapping[str, float] = field(default_factory=dict)
    contact_length: float | None = None

    @property
    def length_scale(self) -> float:
        """The length a_H = √(R δ0), and of a power law or a table its contact radius at δ0."""
        if isinstance(self.profile, TabulatedProfile):
            profile = make_profile(self.profile, {}, np.array([self.depth]))
            return float(profile.radius(np.array([[self.depth]]))[0, 0])
        assert self.radius is not None
        coefficient, power = length_law(self.profile, self.shape)
        return self.radius * (self.depth / (coefficient * self.radius)) ** power

    @property
    def slip_scale(self) -> float:
        """The tangential displacement μ E* δ0/G* at which a contact of constant depth slides as a whole."""
        return self.friction * self.moduli.normal * self.depth / self.moduli.tangential

    @property
    def stress_scale(self) -> float:
        """E* δ0/a_H, the unit of every stress."""
        return self.moduli.normal * self.depth / self.length_scale

    @property
    def swt_scale(self) -> float:
        """Unit of SWT, E* (δ0/a_H)², of the half-space with E*; E* δ0/R (eq. 19) where a_H = √(R δ0)."""
        return self.moduli.normal * (self.depth / self.length_scale) ** 2

    @property
    def contact_radius(self) -> float:
        """a at the mean depth δ0; of a strip half its width."""
        return self.length_scale * float(self._profile().radius(np.ones((1, 1)))[0, 0])

    @property
    def normal_force(self) -> float:
        """Force at the mean depth δ0, 2 E* ∫ (δ0 − g) dξ over the springs.

        Of a strip (π/4) E* δ0 per length, times the length if there is one.
        """
        across = (self.contact_length or 1.0) if self.plane else self.length_scale
        return self.force_factor * self.moduli.normal * self.depth * across

    @property
    def plane(self) -> bool:
        """True if it is a strip."""
        return is_plane(self.profile)

    @property
    def work_scale(self) -> float:
        """Unit of the work of friction."""
        slip = self.friction * self.depth if self.plane else self.slip_scale
        return self.friction * self.normal_force * slip

    @property
    def force_factor(self) -> float:
        """Force at the mean depth over E* δ0 a_H, 4/3 for a paraboloid; of a strip per length over E* δ0."""
        edge = self._profile().radius(np.ones((1, 1)))
        return 2.0 * float(self._profile().half_load(edge)[0, 0])

    @property
    def mean_pressure(self) -> float:
        """Force over the area of contact at the mean depth."""
        if self.plane:
            return self.normal_force / (2.0 * self.contact_radius * (self.contact_length or 1.0))
        return self.normal_force / (math.pi * self.contact_radius**2)

    @property
    def peak_pressure(self) -> float:
        """Largest pressure at the mean depth, p0 of a paraboloid; inf at the edge of a truncated one."""
        profile = self._profile()
        if profile.has_singular_edge and profile.flat_radius[0] > 0.0:
            return math.inf
        edge = profile.radius(np.ones((1, 1)))
        r = edge * np.sin(np.linspace(1e-6, 0.5 * np.pi, _RADII))[None]
        r = np.append(r, profile.singular_approach, axis=1)
        outer = profile.primitives(r, _DIGITS).outer(edge[:, :, None])[0]
        return self.stress_scale * float(outer.max()) / math.pi

    def _profile(self) -> Profile:
        shape = {name: np.array([value]) for name, value in self.shape_parameters.items()}
        return make_profile(self.pure_profile, shape, np.ones(1))

    @property
    def pure_profile(self) -> str | TabulatedProfile:
        """The non-dimensional profile, a table in a_H and δ0."""
        if isinstance(self.profile, str):
            return self.profile
        return _pure(self.profile, self.length_scale, self.depth)

    @property
    def shape_parameters(self) -> dict[str, float]:
        """The non-dimensional parameters of its profile."""
        return {name: number_of(name, value, self) for name, value in self.shape.items()}
