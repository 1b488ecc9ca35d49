"""A real contact from what is known of it."""

from __future__ import annotations

from typing import Any

from swtstudy.contacts.contact import PhysicalContact
from swtstudy.solving import dimensions_of, spanned
from swtstudy.units.bodies import LABELS, checked_body, shear_constants_of_both, stresses_of_both
from swtstudy.units.grid import ContactDetails
from swtstudy.units.labels import Units
from swtstudy.units.reading import read_contacts
from swtstudy.units.rows import NAMES_KEY, SIMILAR, SIMILAR_KEY, rows
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, StudyError
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.quantities import DISTANCE

#: What is asked of contacts, not given of them.
_ASKED = ("rtol", "quantities", DISTANCE, "constants")


@with_parameters(row for name, row in rows(Units()).items() if name != DISTANCE)
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
    bulk_stress_body: Any = 1,
    bodies: Any = None,
    yield_strength: Any = None,
    findley_limit: Any = None,
    shear_constants: Any = None,
    **parameters: Any,
) -> PhysicalContact:
    """A real contact, in any consistent set of units: with N, mm and MPa, SWT comes in MPa.

    Each parameter but young_modulus, poisson_ratio, similar and bulk_stress_body may be a one-dimensional
    sequence of values: then it is all contacts on the grid that these span.

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
        Largest ``|β|/μ`` at which the bodies count as similar (eq. 1); β is Dundurs' constant.
    bulk_stress_ratio
        Least over largest bulk stress, below 1, in the place of bulk_stress_mean.
    bulk_stress_body
        1 or 2: the body that carries the bulk stress; the other one has none.
    bodies
        Names of the two bodies, such as ("pad", "specimen"), in results and figures beside 1 and 2.
    yield_strength
        A stress, of both bodies or a pair: the criterion "fatemi_socie" measures σ_n in it.
    findley_limit
        A stress, of both bodies or a pair: with the criterion "findley" results have findley_usage, the
        Findley stress over it.
    shear_constants
        `swtstudy.ShearConstants` of both bodies, or a pair: for FS_cycles by the criterion "fatemi_socie".
        Unless given they are estimated from the constants that ``solve`` is given.
    contact_length
        Length of a plane contact across its section: its loads are forces then. Without it they are forces
        per length. Plane contacts take forces alone, and a constant normal load unless told otherwise.
    **parameters
        The names below. Those with a scale are lengths:
        tangential_amplitude uA of the relative displacement of the bodies far from the contact, which must be
        given as must be friction μ; normal_amplitude δA of the indentation depth, 0 unless given; instead of
        them the forces tangential_force_amplitude QA and normal_force_amplitude FA; and flat_radius b,
        waviness_amplitude h and wavelength λ of profiles that have them. bulk_stress_amplitude and
        bulk_stress_mean are stresses, 0 unless given, but the amplitude is 1 for a loop with a bulk stress:
        its column is one of stresses then. Angles, numbers, frequency_ratio, profile and exponent
        are as for `swtstudy.solve`.

    Returns
    -------
    PhysicalContact
        Its ``solve`` gives the Dataset of a study with units, of both bodies.

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
    >>> repr(contacts).splitlines()[0]
    '<PhysicalContact: 2 normal_force>'
    >>> contacts.solve(rtol=1e-2).SWT.sel(body=1).round(2).values.tolist()
    [0.52, 0.58]
    """
    of_bodies = {"young_modulus": young_modulus, "poisson_ratio": poisson_ratio}
    sizes = {"radius": radius, "depth": depth, "normal_force": normal_force}
    sizes |= {"bulk_stress_ratio": bulk_stress_ratio, "contact_length": contact_length}
    parameters = {name: value for name, value in sizes.items() if value is not None} | parameters
    report = Report()
    for name in _ASKED:
        if name in parameters:
            report(name, "a keyword of a contact", f"one of its solve: physical(...).solve({name}=...)")
    wrong = Report()
    fixed, axes = spanned({n: value for n, value in parameters.items() if n not in _ASKED}, wrong)
    fixed |= {n: _pair(value) for n, value in of_bodies.items() if value is not None}
    properties: dict[str, Any] = {
        "yield_strengths": stresses_of_both("yield_strength", yield_strength, report),
        "findley_limits": stresses_of_both("findley_limit", findley_limit, report),
        "shear_materials": shear_constants_of_both(shear_constants, report),
    }
    about = ContactDetails()
    with report:
        carrier = checked_body(bulk_stress_body, "bulk_stress_body") - 1
        about = ContactDetails(bulk_stress_body=carrier, **properties)
    if "body" not in parameters:
        axes = {**axes, "body": LABELS}
    named = {} if bodies is None else {NAMES_KEY: bodies}
    grid, found = read_contacts(
        {**fixed, **named, SIMILAR_KEY: similar}, axes, about, known=_defined(parameters)
    )
    if grid is None or report or wrong:
        raise StudyError([*report, *wrong, *found])
    return PhysicalContact(grid)


def _pair(value: object) -> object:
    """A value, or a list of one for each body."""
    return list(value) if dimensions_of(value) == 1 else value  # type: ignore[call-overload]


def _defined(parameters: dict[str, Any]) -> dict[str, dict[str, Definition]]:
    """The loops and tables among the values, by parameter and name."""
    found: dict[str, dict[str, Definition]] = {}
    for name in ("load", "profile"):
        given = parameters.get(name)
        several = given if isinstance(given, list | tuple) else [given]
        found[name] = {each.name: each for each in several if isinstance(each, Definition)}
    return found
