"""A real contact from what is known of it."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, overload

from swtstudy.contacts.contact import PhysicalContact
from swtstudy.contacts.contacts import PhysicalContacts, contacts_from
from swtstudy.named import Named
from swtstudy.solving import dimensions_of
from swtstudy.units.given import SIMILAR
from swtstudy.units.keywords import contact_from


@overload
def physical(
    *,
    young_modulus: float | tuple[float, float] | None = None,
    poisson_ratio: float | tuple[float, float] | None = None,
    radius: float | None = None,
    depth: float | None = None,
    normal_force: float | None = None,
    similar: float = SIMILAR,
    bulk_stress_ratio: float | None = None,
    contact_length: float | None = None,
    bulk_stress_body: int = 0,
    **parameters: float | str | Fraction | Named,
) -> PhysicalContact: ...


@overload
def physical(
    *,
    young_modulus: float | tuple[float, float] | None = None,
    poisson_ratio: float | tuple[float, float] | None = None,
    radius: object = None,
    depth: object = None,
    normal_force: object = None,
    similar: float = SIMILAR,
    bulk_stress_ratio: object = None,
    contact_length: object = None,
    bulk_stress_body: int = 0,
    **parameters: Any,
) -> Any: ...


def physical(
    *,
    young_modulus: Any = None,
    poisson_ratio: Any = None,
    radius: Any = None,
    depth: Any = None,
    normal_force: Any = None,
    similar: Any = SIMILAR,
    bulk_stress_ratio: Any = None,
    contact_length: Any = None,
    bulk_stress_body: Any = 0,
    **parameters: Any,
) -> PhysicalContact | PhysicalContacts:
    """A real contact, in any consistent set of units: with N, mm and MPa, SWT comes in MPa.

    Each parameter but young_modulus, poisson_ratio, similar and bulk_stress_body may be a one-dimensional
    sequence of values.

    Parameters
    ----------
    young_modulus, poisson_ratio
        Of both bodies: one value for two equal bodies, or a pair. These and radius must be given.
    radius
        R of the relative curvature, 1/R = 1/R1 + 1/R2. The power law is f = rⁿ/(n Rⁿ⁻¹), with the slope 1 at
        r = R. Not for a profile that is a `TabulatedProfile`: its radii and heights are lengths, the heights
        those of both bodies together.
    depth, normal_force
        One of them: the mean indentation depth δ0, or the normal force at that depth.
    similar
        Largest magnitude of Dundurs' β at which the bodies count as similar (eq. 1).
    bulk_stress_ratio
        Least over largest bulk stress, below 1, in the place of bulk_stress_mean.
    bulk_stress_body
        0 or 1: the body that carries the bulk stress; the other one has none.
    contact_length
        Length of a plane contact across its section: its loads are forces then. Without it they are forces
        per length. Plane contacts take forces alone, and a constant normal load unless told otherwise.
    **parameters
        The other names of `swtstudy.parameters.PARAMETERS`. Those with a scale are lengths:
        tangential_amplitude uA of the relative displacement of the bodies far from the contact, which must be
        given as must be friction μ; normal_amplitude δA of the indentation depth, 0 unless given; instead of
        them the forces tangential_force_amplitude QA and normal_force_amplitude FA; and flat_radius b,
        waviness_amplitude h and wavelength λ of profiles that have them. bulk_stress_amplitude and
        bulk_stress_mean are stresses, 0 unless given, but the amplitude is 1 for a loop with a bulk stress:
        its column is one of stresses then. Angles, numbers, frequency_ratio, profile and exponent
        are as for `swtstudy.solve`.

    Returns
    -------
    PhysicalContact or PhysicalContacts
        One contact; or, where some values are sequences, the contacts on the grid that these span: their
        ``solve`` gives the Dataset of a study with units.

    Raises
    ------
    StudyError
        A ValueError with every mistake; also if the bodies are not similar.

    Examples
    --------
    >>> import swtstudy
    >>> contact = swtstudy.physical(
    ...     young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, normal_force=200.0,
    ...     friction=0.5, tangential_amplitude=0.002,
    ... )
    >>> round(contact.peak_pressure), round(contact.contact_radius, 3)
    (296, 0.568)
    >>> contacts = swtstudy.physical(
    ...     young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, normal_force=[100.0, 200.0],
    ...     friction=0.5, tangential_amplitude=0.002,
    ... )
    >>> contacts
    <PhysicalContacts: 2 = 2 normal_force>
    >>> contacts.solve(rtol=1e-2).SWT.round(2).values.tolist()
    [0.52, 0.58]
    """
    sizes = {"radius": radius, "depth": depth, "normal_force": normal_force}
    several = {
        **sizes,
        "bulk_stress_ratio": bulk_stress_ratio,
        "contact_length": contact_length,
        **parameters,
    }
    if any(dimensions_of(value) == 1 for value in several.values() if not isinstance(value, Named)):
        of_bodies = {"young_modulus": young_modulus, "poisson_ratio": poisson_ratio}
        return contacts_from(of_bodies, several, similar, bulk_stress_body)
    return contact_from(
        PhysicalContact,
        parameters,
        young_modulus=young_modulus,
        poisson_ratio=poisson_ratio,
        radius=radius,
        depth=depth,
        normal_force=normal_force,
        similar=similar,
        bulk_stress_ratio=bulk_stress_ratio,
        contact_length=contact_length,
        bulk_stress_body=bulk_stress_body,
    )
