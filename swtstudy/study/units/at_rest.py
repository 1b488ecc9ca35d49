"""A real contact at rest, and the scales of all else (eqs. 1, 2, 19–21).

It is made of the moduli of two bodies and of its depth, which may follow from a normal force.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any

import numpy as np

from swtstudy.points.grid import rounded
from swtstudy.solver.at_rest import AtRest, too_small
from swtstudy.solver.table import AnyProfile, TabulatedProfile
from swtstudy.study.units.rows import SCALES
from swtstudy.vocabulary.choices import is_plane
from swtstudy.vocabulary.families import MEAN_LOAD, length_law
from swtstudy.vocabulary.mistakes import refused
from swtstudy.vocabulary.parameters import PARAMETERS


@dataclass(frozen=True)
class Moduli:
    """Young's moduli and Poisson ratios of the two bodies, E in any unit of stress."""

    young: tuple[float, float]
    poisson: tuple[float, float]

    @property
    def alike(self) -> bool:
        """True if the two bodies are elastically the same."""
        return self.young[0] == self.young[1] and self.poisson[0] == self.poisson[1]

    @property
    def shear(self) -> tuple[float, float]:
        """Shear moduli G = E/(2 + 2ν)."""
        one, two = (e / (2.0 + 2.0 * nu) for e, nu in zip(self.young, self.poisson, strict=True))
        return one, two

    @property
    def normal(self) -> float:
        """The modulus E* (eq. 2)."""
        return 1.0 / sum((1.0 - nu) / (2.0 * g) for g, nu in zip(self.shear, self.poisson, strict=True))

    @property
    def tangential(self) -> float:
        """The modulus G* with 2 − ν; eq. 2 is printed with 1 − 2ν, with which eq. 21 would not hold."""
        return 1.0 / sum((2.0 - nu) / (4.0 * g) for g, nu in zip(self.shear, self.poisson, strict=True))

    @property
    def mismatch(self) -> float:
        """Dundurs' β, 0 for bodies that are similar after eq. 1.

        β = ½ [(1 − 2ν1)/G1 − (1 − 2ν2)/G2] / [(1 − ν1)/G1 + (1 − ν2)/G2]. Pressure p then drags tangential
        tractions of the order β p along, which the uncoupled solution leaves out; friction bears μ p.

        Examples
        --------
        >>> Moduli((210e3, 210e3), (0.3, 0.3)).mismatch
        0.0
        >>> round(Moduli((210e3, 70e3), (0.3, 0.33)).mismatch, 3)
        -0.117
        """
        unlike = [(1.0 - 2.0 * nu) / g for g, nu in zip(self.shear, self.poisson, strict=True)]
        return (unlike[0] - unlike[1]) * self.normal / 4.0

    def swt_share(self, body: int) -> float:
        """SWT of a body over SWT of the half-space with E*, under the same stress: (1 − ν²) E*/E.

        The solver's half-space has E = (1 − ν²) E*; of two equal bodies each has half of its SWT.
        """
        return (1.0 - self.poisson[body] ** 2) * self.normal / self.young[body]

    def strain_share(self, body: int, plane: bool) -> float:
        """Strain of a body's surface along a traction, over the mean of both: 1 of equal bodies.

        That within a disc under a traction along x, like √(1 − r²/a²), goes with (4 − 3ν)/G (Mindlin), that
        of a strip with (1 − ν)/G.
        """
        numbers = [1.0 - ν if plane else 4.0 - 3.0 * ν for ν in self.poisson]
        of_both = [number / g for number, g in zip(numbers, self.shear, strict=True)]
        return 2.0 * of_both[body] / sum(of_both)


@lru_cache(maxsize=64)
def _pure(table: TabulatedProfile, length: float, depth: float) -> TabulatedProfile:
    """A table to the digits of canonical points: in whichever units it was given, it is the same."""
    return table.scaled(length, depth, rounded)


@dataclass(frozen=True, eq=False)
class Contact:
    """A real contact at rest, in any consistent set of units, such as N, mm and MPa.

    Attributes
    ----------
    moduli
        One of each body.
    radius
        R; of a power law f = rⁿ/(n Rⁿ⁻¹); None for a table.
    depth
        Mean indentation depth δ0.
    friction
        μ, to which its slip is in proportion.
    profile
        Name of a family, or a table, whose radii and heights are lengths.
    shape
        Its profile's flat_radius b, waviness_amplitude h and wavelength λ, lengths, and its exponent n.
    contact_length
        Length of a plane contact across its section; None for loads per length, and for a disc.
    """

    moduli: Moduli
    radius: float | None
    depth: float
    friction: float
    profile: AnyProfile
    shape: Mapping[str, float] = field(default_factory=dict)
    contact_length: float | None = None

    @cached_property
    def length_scale(self) -> float:
        """The length a_H = √(R δ0), and of a power law or a table its contact radius at δ0."""
        if isinstance(self.profile, TabulatedProfile):
            return float(AtRest(self.profile).radius(np.array([[self.depth]]))[0, 0])
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
    def waviness_scale(self) -> float:
        """The length √(hR) of a wavy profile."""
        return math.sqrt(self.shape["waviness_amplitude"] * (self.radius or math.nan))

    def swt_of(self, body: int) -> float:
        """Unit of SWT of body 0 or 1."""
        return self.swt_scale * self.moduli.swt_share(body)

    def strain_of(self, body: int) -> float:
        """Unit of the shear strain of body 0 or 1."""
        return self.stress_scale / self.moduli.shear[body]

    @property
    def flat(self) -> float:
        """Radius of its flat face, or half its width; 0 without one."""
        return max((self.shape.get(name, 0.0) for name in ("flat_radius", "flat_half_width")), default=0.0)

    @cached_property
    def contact_radius(self) -> float:
        """The contact radius a at the mean depth δ0; half the width of a strip."""
        return self.length_scale * float(self._at_rest.radius(np.ones((1, 1)))[0, 0])

    @property
    def normal_force(self) -> float:
        """Force at the mean depth δ0, 2 E* ∫ (δ0 − g) dξ over the springs.

        For a strip (π/4) E* δ0 per length, times the length if there is one.
        """
        across = (self.contact_length or 1.0) if self.plane else self.length_scale
        return self.force_factor * self.moduli.normal * self.depth * across

    @property
    def plane(self) -> bool:
        """True if it is a strip."""
        return is_plane(self.profile)

    @property
    def friction_force(self) -> float:
        """The friction times the normal force, at which the whole contact slides."""
        return self.friction * self.normal_force

    @property
    def work_scale(self) -> float:
        """Unit of the work of friction."""
        slip = self.friction * self.depth if self.plane else self.slip_scale
        return self.friction * self.normal_force * slip

    @cached_property
    def force_factor(self) -> float:
        """Force at the mean depth over E* δ0 a_H, 4/3 for a paraboloid; of a strip per length over E* δ0."""
        return 2.0 * float(self._at_rest.unit()[0, 0])

    @property
    def mean_pressure(self) -> float:
        """Force over the area of contact at the mean depth."""
        if self.plane:
            return self.normal_force / (2.0 * self.contact_radius * (self.contact_length or 1.0))
        return self.normal_force / (math.pi * self.contact_radius**2)

    @property
    def peak_pressure(self) -> float:
        """Largest pressure at the mean depth, p0 of a paraboloid; inf at the edge of a truncated one."""
        return self.stress_scale * self._at_rest.largest_pressure()

    @cached_property
    def _at_rest(self) -> AtRest:
        return AtRest(self.pure_profile, self.shape_parameters)

    @cached_property
    def pure_profile(self) -> AnyProfile:
        """The non-dimensional profile, a table in a_H and δ0."""
        if isinstance(self.profile, str):
            return self.profile
        return _pure(self.profile, self.length_scale, self.depth)

    @property
    def shape_parameters(self) -> dict[str, float]:
        """The non-dimensional parameters of its profile; what is no length stays as it is."""
        found = dict(self.shape)
        for name, value in self.shape.items():
            if scale := PARAMETERS[name].scale:
                unit = SCALES[scale].of(self)
                found[name] = value / unit if unit else math.inf if value else 0.0
        return found

    def length_of(self, name: str, number: Any) -> Any:
        """The length of a non-dimensional parameter; what is no length stays as it is."""
        scale = PARAMETERS[name].scale
        return number * SCALES[scale].of(self) if scale else number


def depth_at(contact: Contact, force: float) -> float:
    """Indentation depth at a normal force, which rises with it; a StudyError if its shape fits at none."""
    from scipy.optimize import brentq

    if contact.plane:
        return force / (contact.contact_length or 1.0) / (MEAN_LOAD * contact.moduli.normal)
    if isinstance(contact.profile, TabulatedProfile):
        profile, half = AtRest(contact.profile), np.array([[0.5 * force / contact.moduli.normal]])
        return float(profile.depth(profile.radius_at(half))[0, 0])
    if limit := too_small(contact.profile, contact.shape_parameters, 0.0):
        name, number = limit
        shortest = f"at least {contact.length_of(name, number):.4g}"
        allowed = f"{shortest}: with less no contact is compact, at whatever depth"
        raise refused(name, f"{contact.shape[name]:g}", allowed)
    assert contact.radius is not None
    (coefficient, power), log_radius = length_law(contact.profile, contact.shape), math.log(contact.radius)

    def excess(logarithm: float) -> float:
        # In logarithms: a force out of the range of numbers is too large or too small like others.
        factor = replace(contact, depth=math.exp(logarithm)).force_factor
        length = log_radius + power * (logarithm - math.log(coefficient) - log_radius)
        return math.log(factor) + math.log(contact.moduli.normal) + logarithm + length - math.log(force)

    # Below a least depth a shape parameter that grows as the depth falls is beyond its range.
    least, name = 0.0, ""
    for own, number in contact.shape_parameters.items():
        row = PARAMETERS[own]
        if row.scale and (exponent := SCALES[row.scale].power):
            depth = contact.depth * (number / row.upper) ** (1.0 / exponent)
            least, name = max((least, name), (depth, own))
    if least > 0.0 and excess(math.log(least)) > 0.0:
        row = PARAMETERS[name]
        allowed = f"a length of at most {row.upper:g} {row.scale} at this force"
        raise refused(name, f"{contact.shape[name]:g}", allowed)
    # Hertz's depth, and from there outwards.
    hertz = (2.0 / 3.0) * math.log(0.75 * force / (contact.moduli.normal * math.sqrt(contact.radius)))
    low = high = max(hertz, math.log(least)) if least > 0.0 else hertz
    while excess(low) > 0.0:
        low -= 1.0
    while excess(high) < 0.0:
        high += 1.0
    return math.exp(brentq(excess, low, high, xtol=1e-14)) if high > low else math.exp(low)
