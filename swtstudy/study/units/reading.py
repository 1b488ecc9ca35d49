"""A grid of real contacts read from what a user wrote, with every mistake reported at once.

Contacts that cannot be, or are beyond a range, are told in the user's own quantities and units.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from swtstudy.points import rules
from swtstudy.points.grid import SHAPE_COLUMNS, Grid
from swtstudy.points.reading import NOTHING_KNOWN, GivenAxes, Known, read_values
from swtstudy.points.values import NamedValues, Value, as_number, index_at, read_value
from swtstudy.solver.load_path import LoadPath, Loop
from swtstudy.study.figure import reference
from swtstudy.study.units import grid as grids
from swtstudy.study.units import rows as units
from swtstudy.study.units.at_rest import Moduli
from swtstudy.study.units.grid import ContactDetails, PhysicalGrid
from swtstudy.vocabulary.choices import CRITERIA, FATEMI_SOCIE, is_plane, without_life
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.files import read_json
from swtstudy.vocabulary.mistakes import Report, StudyError, literal, meant, more_like_it, plain_number
from swtstudy.vocabulary.parameters import (
    AXES,
    FORCE_OF,
    HARMONIC,
    LOOP_AMPLITUDE,
    PARAMETERS,
    Parameter,
    replaced_by,
)
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.wording import unit_words

#: Loads that stand for wrong ones: one in shares of the mean load, and one that was measured.
ANY = LoadPath("any", [[0.0, 0.0], [0.0, 1.0]])
ANY_MEASURED = LoadPath("any", ANY.vertices, 1.0)
#: More contacts than these take minutes.
MOST_CONTACTS = 300_000
#: Words for a contact in every message.
_SAID = ("radius", *units.MEAN_LOADS, *SHAPE_COLUMNS)
#: Pressure over E* that no metal sustains.
LARGEST_PRESSURE = 0.1
#: Mean pressure over E* at which the contact of any metal is plastic.
LARGEST_MEAN_PRESSURE = 0.04
#: Friction of no metal, a factor of a measured load that is probably a load itself, and a force over the
#: normal load that is probably meant as a share of it. How near to the mean load deviations from it are on
#: average that are probably the load itself.
MOST_FRICTION, MOST_TIMES, SMALL_SHARE, NEAR_MEAN = 2.0, 10.0, 0.02, 0.2


def read_contacts(
    fixed: Mapping[str, object],
    axes: GivenAxes,
    given: ContactDetails,
    keys: Callable[[str], str] = str,
    source: str = "",
    samples: Mapping[str, tuple[Value, ...] | None] | None = None,
    known: Known = NOTHING_KNOWN,
    keywords: Sequence[str] = (),
) -> tuple[PhysicalGrid | None, Report]:
    """The grid of real contacts spanned by fixed values and axes; as `swtstudy.points.reading.read_grid`.

    An unknown parameter may be one of other keywords, misspelt.
    """
    report, samples = Report(source, keys), samples or {}
    everything = {**fixed, **axes, **samples}
    raw, tables = everything.get("profile", PARAMETERS["profile"].default), known.get("profile", {})
    several = raw if isinstance(raw, list | tuple) else [raw]
    profiles = [tables.get(each, each) if isinstance(each, str) else each for each in several]
    labels = grids.labels_of(given.units, profiles, everything)
    own = {name: row for name, row in units.rows(labels).items() if name != DISTANCE}
    given, single = _read_bodies(fixed, given, own, report)
    for name in (name for name in units.OF_ALL if name in axes):
        report.of(name, "an axis", "one for all points, under [fixed]")
    others = (DISTANCE, *units.OF_ALL, *given.pairs, *keywords)
    good_fixed, good_axes = read_values(single, axes, report, others, samples, known, own)
    good_samples = {name: values for name, values in samples.items() if values is not None}
    good = good_axes | good_samples | {name: (value,) for name, value in good_fixed.items()}
    _check_lengths(profiles, everything, report)
    _check_given({*everything} - {*units.OF_ALL}, good, own, report)
    rules.check_amplitudes(everything, good, report)
    rules.check_criteria(everything, good, report)
    _check_units_of_criteria({*good.get("criterion", ())}, given, report)
    rules.check_shapes_given(single, {**axes, **samples}, good, report, own)
    if report or None in (*samples.values(), *axes.values()):  # reported elsewhere
        rules.check_loops_alone(good, report)
        return None, report
    grid = completed(good_fixed, good_axes, good_samples, given)
    check_bodies(grid, report)
    if given.body_names and grid.is_pulled and units.CARRIER_KEY not in fixed:
        one, other = map(literal, given.body_names)
        words = f"{one} carries the bulk stress, as the first of bodies"
        warnings.warn(f"{words}; if it is the other one, {units.CARRIER_KEY} = {other}", stacklevel=3)
    rules.check_loops(grid, report)
    # Sizes of what stands for a wrong load are no mistakes.
    if not report and not any(load is ANY or load is ANY_MEASURED for load in grid.values("load")):
        check_contacts(grid, report)
    return (None if report else grid), report


def _check_units_of_criteria(criteria: set[Value], given: ContactDetails, report: Report) -> None:
    """Report constants without their criterion, and criteria without their constants."""
    rows = {str(name): CRITERIA[str(name)] for name in criteria}
    for name, row in rows.items():
        if row.normal_unit and not getattr(given, row.normal_unit):
            allowed = f"a stress: the criterion {name} measures the normal stress in it"
            report(f"material.{row.normal_unit.removesuffix('s')}", "nothing", allowed)
    if given.scatter and rows and not any(map(given.scatters, rows)):
        found = f"{', '.join(given.scatter.names)}, of which no life by {', '.join(rows)} is made"
        report("sample", found, "scatter of the constants of that life")
    if (names := without_life(criteria)) and given.has_lives:
        allowed = "none: the Findley stress is compared with a limit, and has no life"
        report("material", f"constants with the criterion {names} alone", allowed)
    elif given.shear_materials and not (given.materials or any(row.constants[1:] for row in rows.values())):
        allowed = f"the criterion {FATEMI_SOCIE}, of whose life they are, or tensile ones as well"
        report("material", "shear constants alone", allowed)


def _check_lengths(profiles: Sequence[object], given: Collection[str], report: Report) -> None:
    """A depth of plane contacts, a length where none has one, and none where loads need it."""
    plane, length = [is_plane(profile) for profile in profiles], "contact_length"
    if any(plane) and "depth" in given:
        why = "a plane contact has no depth, only a load"
        report.of("depth", "a depth with a plane profile", f"normal_force: {why}")
    if length in given and not any(plane):
        report.of(length, "a length without a plane profile", "only with profiles such as cylinder")
    if any(plane) and not all(plane) and length not in given:
        allowed = "the length of the plane contacts: beside axisymmetric ones their loads are forces"
        report.of(length, "nothing", allowed)


def completed(
    fixed: dict[str, Value], axes: NamedValues, samples: NamedValues, about: ContactDetails
) -> PhysicalGrid:
    """A grid with what contacts have unless it is given; and with both bodies, if they differ."""
    named = Grid(fixed, axes, samples)
    loads, profiles, given = named.values("load"), named.values("profile"), {*named.names, *about.pairs}
    fixed = fixed | grids.implied_amplitudes(given, loads, profiles)
    given |= {*fixed} | replaced_by({*given, *fixed})
    table = units.rows(grids.labels_of(about.units, profiles, given))
    defaults = {n: read_value(row, row.default) for n, row in table.items() if row.default is not None}
    if "bulk_stress_amplitude" in grids.scaling_of(loads):
        defaults["bulk_stress_amplitude"] = LOOP_AMPLITUDE
    if "bulk_stress_ratio" in given:
        del defaults["bulk_stress_mean"]
    fixed = fixed | {name: value for name, value in defaults.items() if name not in given}
    own = {name: fixed[name] for name in table if name in fixed}
    grid = PhysicalGrid(own, axes, samples, **vars(about))
    # Bodies with different s, SWT or cycles are both there.
    of_both = (grid.materials, grid.yield_strengths, grid.shear_materials, grid.findley_limits)
    if "body" not in given and (grid.pairs or grid.is_pulled or any(len({*each}) > 1 for each in of_both)):
        return replace(grid, axes={**axes, "body": (1.0, 2.0)})
    return grid


def _read_bodies(
    fixed: Mapping[str, object], given: ContactDetails, own: Mapping[str, Parameter], report: Report
) -> tuple[ContactDetails, dict[str, object]]:
    """The facts of the two bodies, and the other fixed values, in which the name of a body becomes 1 or 2.

    A pair of values is empty if one of them is wrong.
    """
    pairs, single = dict[str, Any](), dict(fixed)
    for name in (name for name in units.OF_BODIES if isinstance(fixed.get(name), list | tuple)):
        raw: Any = single.pop(name)
        both = {f"{name}[{i}]": one for i, one in enumerate(raw)} if len(raw) == 2 else {}
        if not both:
            report.of(name, literal(raw), f"{own[name].allowed}; or two, one for each body")
        read, _ = read_values(both, {}, report, rows=dict.fromkeys(both, own[name]))
        two = tuple(map(as_number, read.values()))
        if len({*two}) < len(two) == 2:
            single[name] = two[0]
        else:
            pairs[name] = two if len(two) == 2 else ()
    similar = plain_number(single.pop(units.SIMILAR_KEY, given.similar))
    if not 0.0 <= similar < math.inf:
        found = literal(fixed[units.SIMILAR_KEY])
        report.of(units.SIMILAR_KEY, found, "a number ≥ 0: the largest |β|/μ of similar bodies")
    raw = single.pop(units.NAMES_KEY, given.body_names or None)
    names = tuple(raw) if isinstance(raw, list | tuple) else ()
    sound = all(isinstance(name, str) and name.isprintable() and name.strip() for name in names)
    if raw is not None and (len(names) != 2 or not sound or names[0] == names[1]):
        report.of(units.NAMES_KEY, literal(raw), 'two names, such as ["pad", "specimen"]')
        names = ()
    carrier, raw = 1, single.pop(units.CARRIER_KEY, given.bulk_stress_body + 1)
    with report:
        carrier = units.checked_body(raw, report.key(units.CARRIER_KEY), names)
    body = single.get("body")
    if names and isinstance(body, str) and body not in map(str, units.LABELS):
        single["body"] = 1
        with report:
            single["body"] = units.checked_body(body, report.key("body"), names)
    details = replace(given, pairs=pairs, similar=similar, body_names=names, bulk_stress_body=carrier - 1)
    return details, single


def _check_given(everything: set[str], good: NamedValues, own: dict[str, Parameter], report: Report) -> None:
    """Report which values a contact lacks, and which exclude one another."""
    profiles = good.get("profile", ("paraboloid",))
    has_radius = not all(isinstance(profile, Definition) for profile in profiles)
    # A misspelt key is not lacking, too.
    everything |= {meant(name, own) or name for name in everything if name not in own}
    # A wrong load is reported: nothing else is lacking because of it.
    measured = good.get("load") or ((ANY_MEASURED,) if "load" in everything else ())
    everything |= {*grids.implied_amplitudes(everything, measured, profiles)}
    for name in ("young_modulus", "poisson_ratio", "radius", "friction"):
        if name not in everything and (name != "radius" or has_radius):
            report.of(name, "nothing", own[name].allowed)
    if "radius" in everything and not has_radius and profiles:
        report.of("radius", "a radius", "nothing: the table of the profile has lengths")
    loops = [load for load in good.get("load", ()) if isinstance(load, Loop)]
    mean = grids.mean_of_loads(everything, measured)
    if wrong := units.wrong_mean_load([*everything, *([mean] if mean else [])]):
        found, allowed = wrong
        for load in [load for load in loops if load.is_absolute][:1]:
            allowed += f"; or absolute = true under [loads.{load}], whose normal column is far from 0"
        report.of(units.MEAN_LOADS, found, allowed)
    if {"bulk_stress_mean", "bulk_stress_ratio"} <= everything:
        report.of(("bulk_stress_mean", "bulk_stress_ratio"), "both", "one of the two")
    if any(value not in (1.0, 2.0) for value in good.get("body", ())):
        report.of("body", literal(list(good["body"])), "1 or 2")
    scaling = grids.scaling_of(loops)
    sized = {"bulk_stress_amplitude", "bulk_stress_mean"} & (everything | scaling)
    if "bulk_stress_ratio" in everything and not sized:
        report.of("bulk_stress_amplitude", "nothing", "a stress, which bulk_stress_ratio needs")
    mixed = len(loops) < len(good.get("load", ()))  # what scales both kinds is asked for by check_amplitudes
    if any(map(is_plane, profiles)):
        rules.check_forces(everything, good, report)
        return
    for name in ("tangential_amplitude", "normal_amplitude"):
        force = FORCE_OF[name]
        needed = own[name].default is None or name in scaling
        if name in everything or force in everything or not needed or (name in scaling and mixed):
            continue
        allowed = f"{own[name].allowed}; or {force}"
        if name in scaling:
            column = name.partition("_")[0]
            length, unit = own[name].units or "lengths", own[force].units or "forces"
            allowed = f"1 if the column {column} of the loop is in {length}; or {force}, 1 if it is in {unit}"
        report.of(name, "nothing", allowed)


def check_bodies(grid: PhysicalGrid, report: Report) -> None:
    """Refuse bodies that are not similar, and warn of bodies that are not quite.

    Without friction nothing is dragged along, and bodies of any moduli are right.
    """
    rubbing = [value for value in map(as_number, grid.values("friction")) if value > 0.0]
    pairs = itertools.product(*map(grid.of_both, units.OF_BODIES))
    beta, friction = max((Moduli(*both).mismatch for both in pairs), key=abs), min(rubbing, default=math.inf)
    ratio = abs(beta) / friction
    found = f"Dundurs' β = {beta:.3g} is {ratio:.2g} times the friction {friction:g}"
    if ratio > grid.similar:
        enough = math.ceil(100.0 * ratio) / 100.0
        allowed = f"|β|/μ ≤ {grid.similar:g}, since (1 − 2ν1)/G1 = (1 − 2ν2)/G2 is assumed (eq. 1)"
        way = f"{units.SIMILAR_KEY} = {enough:g} accepts them: s leaves out tangential tractions of about β p"
        report.of(units.OF_BODIES, f"bodies that are not similar: {found}", f"{allowed}; {way}")
    elif ratio > units.NOTICEABLE_MISMATCH:
        words = f"{found}: pressure p drags tangential tractions of about β p along, which s leaves out"
        warnings.warn(words, stacklevel=2)


def read_contact(text: object) -> ContactDetails:
    """Read the attribute of results; see `swtstudy.study.units.grid.PhysicalGrid`.

    Raises
    ------
    ValueError
        With the reason, if it cannot be read.
    """
    try:
        given: ContactDetails = read_json(ContactDetails, text)
    except ValueError as error:
        raise ValueError(f"not a contact: {error}") from None
    several = [each for name, each in vars(given).items() if isinstance(each, tuple) and name != "blocks"]
    sound = given.pairs.keys() <= {*units.OF_BODIES} and math.isfinite(given.similar)
    if not sound or {*map(len, several)} - {0, len(units.LABELS)}:
        raise ValueError(f"not a contact: {literal(text)}")
    return given


def check_contacts(grid: PhysicalGrid, report: Report) -> None:
    """Contacts that cannot be made, parameters beyond their range, and shapes that are not compact."""

    def told(at: dict[str, int]) -> str:
        here, name = _at(grid, at), grid.control.given_for("normal_amplitude")
        load = f"{name} = {as_number(here[name]):g}{unit_words(grid.row(name).units)}"
        return f"{_words(grid, here)}, {load}"

    dims = grid.at_rest_dims
    count = math.prod(grid.sizes[dim] for dim in dims)
    if count > MOST_CONTACTS:
        report.of(dims, f"{count} different contacts at rest", f"at most {MOST_CONTACTS}")
    elif wrong := [each for each in grid.distinct if isinstance(each, StudyError)]:
        here = _at(grid, index_at(grid.at_rest, [*grid.at_rest.values.flat].index(wrong[0])))
        for mistake in wrong[0].mistakes:
            unit, there = unit_words(grid.row(mistake.key).units), _words(grid, here, mistake.key)
            found = f"{mistake.found}{unit} at {there}{more_like_it(len(wrong))}"
            report.of(mistake.key, found, mistake.allowed)
    else:
        for column in grid.numbers:
            _check_range(grid, column, report)
        if not report:
            rules.check_shapes(grid, report, told)


def doubts_of_units(grid: PhysicalGrid, shown: Collection[str] = ()) -> Iterator[str]:
    """Hints at a wrong unit or number, and at a figure's ratio of s that is none of SWT.

    Contacts larger than their radius or pressed beyond any metal, friction of no metal, forces that multiply
    a measured load, and forces that look like shares of the normal load.
    """
    if (most := max(map(as_number, grid.values("friction")))) > MOST_FRICTION:
        yield f"friction {most:g}: metals have some 0.1 to 1.5"
    if grid.has_lives and HARMONIC in grid.values("load") and len({*grid.values("frequency_ratio")}) > 1:
        words = "a load cycle at frequency_ratio p/q has p tangential and q normal oscillations"
        yield f"{words}: cycles at several ratios are not of one length"
    measured = [str(load) for load in grid.loops if load.mean_normal is not None]
    for amplitude in rules.AMPLITUDES:
        name, share = grid.control.given_for(amplitude), float(grid.numbers[amplitude].max())
        most, is_force = max(map(as_number, grid.values(name)), default=0.0), name != amplitude
        if measured and most > MOST_TIMES:
            column = f"the column {name.partition('_')[0]} of {', '.join(measured)}"
            yield f"{name} {most:g} multiplies {column}: 1 takes it as it is"
        if HARMONIC in grid.values("load") and is_force and 0.0 < most <= 1.0 and share < SMALL_SHARE:
            of = "friction times " * (amplitude == "tangential_amplitude") + "the normal force"
            found = f"{name} {most:g}{unit_words(grid.labels.force)} is {share:.2g} of {of}"
            yield f"{found}: is it meant as a share of that?"
    for load in (load for load in grid.loops if load.mean_normal is None):
        middle = 0.5 * sum(load.normal_ends)
        # Deviations from the mean load whose own mean is that load are likely the load itself.
        if np.any(np.abs(middle * grid.numbers["normal_amplitude"].values - 1.0) < NEAR_MEAN):
            found = f"the normal loads of {load} are {middle:.4g} on average, as large as the mean load"
            yield f"{found} that they are added to: absolute = true, if they are the loads themselves"
    for y, place in zip(shown, map(reference, shown), strict=True):
        if place and place[0] in units.REST_DEPENDS_ON - {"body"}:
            yield f"figure.y: in {y} s is over E* δ0/R, which changes with {place[0]}: SWT has another ratio"
    lines: dict[str, str] = {}
    unit = unit_words(grid.labels.length)
    for contact in grid.distinct:
        radius, edge, profile = contact.radius, contact.contact_radius, contact.profile
        if not isinstance(profile, str):
            ratio, pressure = contact.depth / edge, contact.peak_pressure / contact.moduli.normal
            if pressure > LARGEST_PRESSURE:
                sizes = f"a contact radius of {edge:.4g}{unit} over R is {ratio:.3g}"
                found = f"profile {profile.name}: {sizes}, p0 over E* is {pressure:.3g}"
                lines.setdefault("table", f"{found}: are heights and positions in one unit?")
        elif radius is not None and (curved := edge - contact.flat) > radius:
            face = " beside its flat face" * (contact.flat > 0.0)
            found = f"radius {radius:g}{unit} is smaller than the contact{face} ({curved:.3g}{unit})"
            lines.setdefault("radius", f"{found}: is the radius in another unit, such as metres?")
        elif (share := contact.mean_pressure / contact.moduli.normal) > LARGEST_MEAN_PRESSURE:
            size = f"{contact.mean_pressure:.4g}{unit_words(grid.labels.stress)}"
            found = f"a mean pressure of {size} is {share:.2g} of E*; metals yield below 0.03"
            doubt = "is the force or the modulus in another unit?"
            if contact.plane and contact.contact_length is None:
                doubt = "is a contact_length missing, or the force per length in another unit?"
            lines.setdefault("pressure", f"{found}: {doubt}")
    yield from lines.values()


def check_distances(grid: PhysicalGrid, distances: Sequence[float], report: Report) -> None:
    """A critical distance beyond its range in the smallest contact."""
    unit, length = unit_words(grid.row(DISTANCE).units), grid.each(units.SCALES["a_H"].of)
    largest, smallest, upper = max(distances, default=0.0), float(length.min()), AXES[DISTANCE].upper
    if largest > upper * smallest:
        words = _words(grid, _at(grid, index_at(length, int(length.values.argmin()))))
        found = f"{largest:g}{unit} at {words}, {largest / smallest:.4g} a_H"
        report.of(DISTANCE, found, f"at most {upper * smallest:.4g}{unit}, {upper:g} a_H")


def _check_range(grid: PhysicalGrid, column: str, report: Report) -> None:
    """Report the first value of a parameter that is out of its range, if it has a unit."""
    row, values = PARAMETERS[column], grid.numbers[column]
    if column in rules.AMPLITUDES:
        # The largest load of a loop counts: its vertices are multiplied.
        loads = grid.values("load")
        values = values * max(rules.sizes_of(v)[column] if isinstance(v, Loop) else 1.0 for v in loads)
    source = grid.control.given_for(column)
    if column == "bulk_stress_mean" and grid.values("bulk_stress_ratio"):
        source = "bulk_stress_ratio"
    low, high = (values < row.lower).values, ~(values <= row.upper).values
    wrong = low | high | ((values == row.lower).values & row.open_lower & bool(grid.values(source)))
    if column in SHAPE_COLUMNS:
        wrong &= values.values != 0.0  # the profile has none of it
    if not wrong.any() or not row.scale:
        return
    at = index_at(values, int(wrong.argmax()))
    first, here = tuple(at.values()), _at(grid, at)
    own, number = as_number(here[source]), float(values.values[first])
    unit = unit_words(grid.row(source).units)
    words, more, scale = _words(grid, here, source), more_like_it(int(wrong.sum())), AXES[source].scale
    most, bound = ("at most", row.upper) if high[first] else ("at least", row.lower)
    if not np.isfinite(number):
        words += f", friction = {as_number(here['friction']):g}" * (grid.dimension("friction") is None)
        report.of(source, f"{own:g}{unit} at {words}{more}", "0: without friction the contact slides at once")
    elif not scale:  # a ratio, to which the number is not in proportion
        allowed = f"a mean of {most} {bound:g} {row.scale}"
        report.of(source, f"{own:g} at {words}, a mean of {number:.4g} {row.scale}{more}", allowed)
    else:
        allowed = f"{most} {bound * own / number:.4g}{unit}, {bound:g} {scale}"
        report.of(source, f"{own:g}{unit} at {words}, {number:.4g} {scale}{more}", allowed)


def _at(grid: PhysicalGrid, at: Mapping[str, Any]) -> dict[str, Value]:
    """The values of the parameters at a place, or the first ones along dimensions that it leaves open."""
    values = {name: grid.values(name) for name in grid.rows}
    return {n: each[int(at.get(grid.dimension(n) or "", 0))] for n, each in values.items() if each}


def _words(grid: PhysicalGrid, here: Mapping[str, Value], but: str = "") -> str:
    """Which contact it is: its size and load, and whatever else of it varies, but for one parameter."""
    words = []
    for name in (name for name in units.AT_REST_NAMES if name in here and name != but):
        value = here[name]
        if not isinstance(value, str | Definition) and (name in _SAID or grid.dimension(name)):
            words.append(f"{name} = {as_number(value):g}{unit_words(grid.row(name).units)}")
    return ", ".join(words)
