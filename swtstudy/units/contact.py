"""A real contact and its non-dimensional parameters (eqs. 1, 2, 19–21)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.families import family_of, is_plane, is_profile
from swtstudy.grid.canonical import canonical_number, rounded
from swtstudy.grid.reading import read_grid
from swtstudy.mechanics.indenter import Profile, TabulatedProfile, length_law, make_profile
from swtstudy.mistakes import Mistake, StudyError
from swtstudy.named import Named
from swtstudy.parameters import HARMONIC, PARAMETERS
from swtstudy.prescribed import PAIRS
from swtstudy.units.bodies import bodies_of, checked_body, cycles_from, swt_from
from swtstudy.units.moduli import Moduli
from swtstudy.units.scales import length_of, number_of

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.bodies import Values
    from swtstudy.units.life import FatigueConstants

#: Radii at which the largest pressure is looked for, and its digits.
_RADII, _DIGITS = 4001, 9.0


@lru_cache(maxsize=8)
def _scaled(table: TabulatedProfile, length: float, depth: float) -> TabulatedProfile:
    """`TabulatedProfile.scaled`, whose fit takes time."""
    return table.scaled(length, depth)


@lru_cache(maxsize=64)
def _pure(table: TabulatedProfile, length: float, depth: float) -> TabulatedProfile:
    """A table to the digits of canonical points: in whichever units it was given, it is the same."""
    pure = table.scaled(length, depth)
    smoothing = canonical_number(pure.smoothing)
    own = rounded(pure.radius), rounded(pure.height), smoothing
    return TabulatedProfile(pure.name, *own, pure.geometry)


def _contact_radius(table: TabulatedProfile, depth: float) -> float:
    """Contact radius of a table in lengths."""
    return float(make_profile(table, {}, np.array([depth])).radius(np.array([[depth]]))[0, 0])


@dataclass(frozen=True)
class Contact:
    """A real contact, in any consistent set of units, such as N, mm and MPa.

    Attributes
    ----------
    moduli
        Of the two bodies.
    radius
        R; of a power law f = rⁿ/(n Rⁿ⁻¹); None for a table.
    depth
        Mean indentation depth δ0.
    friction, frequency_ratio, phase, profile, load, walker_exponent, bulk_stress_phase
        As in `swtstudy.parameters.PARAMETERS`; the radii and heights of a table are lengths.
    normal_amplitude, tangential_amplitude
        δA and uA, lengths; None where a force is prescribed.
    shape
        What its profile has of flat_radius b, waviness_amplitude h and wavelength λ, lengths, and exponent n.
    normal_force_amplitude, tangential_force_amplitude
        FA and QA, forces; None where a displacement is prescribed.
    bulk_stress_amplitude, bulk_stress_mean
        Stresses.
    bulk_stress_body
        0 or 1: the body that carries them.
    contact_length
        Length of a plane contact across its section; None for loads per length, and for a disc.
    """

    moduli: Moduli
    radius: float | None
    depth: float
    friction: float
    normal_amplitude: float | None
    tangential_amplitude: float | None
    frequency_ratio: Fraction
    phase: float
    profile: str | TabulatedProfile
    shape: Mapping[str, float] = field(default_factory=dict)
    normal_force_amplitude: float | None = None
    tangential_force_amplitude: float | None = None
    load: str | Named = HARMONIC
    walker_exponent: float = 0.5
    bulk_stress_amplitude: float = 0.0
    bulk_stress_mean: float = 0.0
    bulk_stress_phase: float = 0.0
    bulk_stress_body: int = 0
    contact_length: float | None = None

    @property
    def length_scale(self) -> float:
        """The length a_H = √(R δ0), and of a power law or a table its contact radius at δ0."""
        if isinstance(self.profile, TabulatedProfile):
            return _contact_radius(self.profile, self.depth)
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
        """Whether it is a strip."""
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

    def parameters(self, body: int = 0) -> dict[str, Any]:
        """The non-dimensional parameters, for `swtstudy.solve` and all others.

        Parameters
        ----------
        body
            0 or 1. The bodies share all parameters but the Poisson ratio and the bulk stress: the tractions
            do not depend on these, and the stress beneath them on those of the body itself alone.
        """
        own = {**vars(self), **self.shape, "poisson_ratio": self.moduli.poisson[checked_body(body)]}
        own["profile"] = self.pure_profile
        if body != self.bulk_stress_body:
            own |= {name: row.default for name, row in PARAMETERS.items() if row.part == "bulk"}
        # What scales a loop is 1 unless it is given.
        scaling = self.load.scaled_by if isinstance(self.load, Named) else ()
        return {
            name: number_of(name, own[name], self)
            for name, row in PARAMETERS.items()
            if own.get(name) is not None and (name in scaling or not row.goes_without_saying(own[name]))
        }

    def with_parameters(self, **parameters: Any) -> Self:
        """The same bodies at the same R and δ0 with other non-dimensional parameters: lengths from those.

        Raises
        ------
        StudyError
            A ValueError with every mistake in the parameters.
        """
        if "poisson_ratio" in parameters:
            raise StudyError([Mistake("poisson_ratio", "a parameter", "that of the bodies, which stays")])
        profile = parameters.get("profile", self.profile)
        kept = family_of(profile).shape if isinstance(profile, Named) or is_profile(profile) else ()
        every = self.parameters(self.bulk_stress_body)
        own = {n: v for n, v in every.items() if n not in self.shape or n in kept}
        replaced = {name for pair in PAIRS.items() for name in pair if {*pair} & parameters.keys()}
        own = {name: value for name, value in own.items() if name not in replaced}
        grid, mistakes = read_grid({**own, **parameters}, {})
        if grid is None:
            raise StudyError(mistakes)
        own = {name: value for name, value in grid.fixed.items() if name in vars(self)}
        pure: dict[str, Any] = {name: value for name, value in own.items() if not PARAMETERS[name].scale}
        pure |= dict.fromkeys(replaced)
        if isinstance(pure.get("profile"), TabulatedProfile):
            pure["profile"] = (
                _scaled(pure["profile"], 1.0 / self.length_scale, 1.0 / self.depth)
                if "profile" in parameters
                else self.profile
            )
        contact = replace(self, **pure, shape={})
        # In the order of the table: a length may be measured in the one before it.
        for name, value in grid.fixed.items():
            if name in own and PARAMETERS[name].scale:
                contact = replace(contact, **{name: length_of(name, value, contact)})
            elif name in family_of(contact.profile).shape:
                contact = replace(contact, shape={**contact.shape, name: length_of(name, value, contact)})
        return contact

    def swt(self, s: ArrayLike | xr.DataArray, body: int | None = None) -> Values:
        """SWT of the bodies, in the unit of stress of the moduli, from s (eq. 19).

        Parameters
        ----------
        s
            From `parameters` of the body; also non-local values, or s_local of `swtstudy.swt_field`. In a
            DataArray with the coordinate ``body``, such as `solve` gives, each value is that of its body.
        body
            0 or 1, the body that has this s. Needed where the bodies differ and s does not say it.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            As s is, of the same shape.

        Raises
        ------
        StudyError
            A ValueError, if it is not said which body has this s, or s is negative or no number.
        """
        return swt_from(s, self.swt_scale, self.moduli, body)

    def cycles(
        self,
        constants: FatigueConstants | Sequence[FatigueConstants],
        s: ArrayLike | xr.DataArray,
        body: int | None = None,
        counted: xr.Dataset | None = None,
    ) -> Values:
        """Rounds of the load to the initiation of a crack; mind the caveat of `FatigueConstants.cycles`.

        Parameters
        ----------
        constants
            Of both bodies, or a pair for bodies of different materials.
        s, body
            As for `swt`: ``contact.cycles((steel, cast_iron), contact.solve().s)`` has a life of each body.
        counted
            Results with counted and counted_number, as of studies with [material], with which s is a
            DataArray; unless it is given a round counts as one strain cycle.

        Returns
        -------
        numpy.ndarray or xarray.DataArray
            As s is, of the same shape.

        Raises
        ------
        StudyError
            A ValueError, as of `swt`, or if the constants are none.
        """
        return cycles_from(constants, self.swt(s, body), bodies_of(s, self.moduli, body), counted)
