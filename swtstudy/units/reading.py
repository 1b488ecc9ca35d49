"""A grid of real contacts read from what a user wrote, with every mistake reported at once."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from swtstudy.loads.load_path import LoadPath
from swtstudy.loads.loop import Loop
from swtstudy.points.reading import NOTHING_KNOWN, GivenAxes, Known, read_values
from swtstudy.points.rules import (
    check_amplitudes,
    check_criteria,
    check_forces,
    check_loops,
    check_shapes_given,
)
from swtstudy.points.values import NamedValues, Value, amplitudes_of, as_number, read_value, values_taken
from swtstudy.units.at_rest import Moduli
from swtstudy.units.contacts_at_rest import check_contacts, check_distances
from swtstudy.units.grid import (
    ContactDetails,
    PhysicalGrid,
    labels_of,
    mean_of_loads,
    measured_amplitudes,
    still_load,
)
from swtstudy.units.rows import (
    LABELS,
    MEAN_LOADS,
    NAMES_KEY,
    NOTICEABLE_MISMATCH,
    OF_BODIES,
    SIMILAR_KEY,
    labels_or,
    rows,
    wrong_mean_load,
)
from swtstudy.vocabulary.choices import FATEMI_SOCIE, FINDLEY, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal, meant, plain_number
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import FORCE_OF, LOOP_AMPLITUDE, PARAMETERS, replaced_by
from swtstudy.vocabulary.quantities import DISTANCE

#: Loads that stand for wrong ones: one in shares of the mean load, and one that was measured.
ANY = LoadPath("any", [[0.0, 0.0], [0.0, 1.0]])
ANY_MEASURED = LoadPath("any", ANY.vertices, 1.0)


def read_contacts(
    fixed: Mapping[str, object],
    axes: GivenAxes,
    given: ContactDetails,
    keys: Callable[[str], str] = str,
    source: str = "",
    samples: Mapping[str, tuple[Value, ...] | None] | None = None,
    known: Known = NOTHING_KNOWN,
    distances: Sequence[float] = (),
) -> tuple[PhysicalGrid | None, Report]:
    """The grid of real contacts spanned by fixed values and axes; as `swtstudy.points.reading.read_grid`.

    Critical distances are held against their range, too.
    """
    report, samples = Report(source, keys), samples or {}
    everything = {**fixed, **axes, **samples}
    raw = everything.get("profile", PARAMETERS["profile"].default)
    tables = known.get("profile", {})
    profiles = [
        tables.get(each, each) if isinstance(each, str) else each
        for each in (raw if isinstance(raw, list | tuple) else [raw])
    ]
    labels = labels_of(given.units, profiles, everything)
    own = {name: row for name, row in rows(labels).items() if name != DISTANCE}
    pairs, single = _pairs(fixed, own, report)
    similar = single.pop(SIMILAR_KEY, given.similar)
    body_names = _body_names(single, given.body_names, report)
    if not 0.0 <= plain_number(similar) < math.inf:
        report.of(SIMILAR_KEY, literal(similar), "a number ≥ 0: the largest |β|/μ of similar bodies")
    good_fixed, good_axes = read_values(
        single, axes, report, (DISTANCE, SIMILAR_KEY, NAMES_KEY, *pairs), samples, known, own
    )
    good_samples = {name: values for name, values in samples.items() if values is not None}
    _check_lengths(profiles, everything, report)
    good = good_axes | good_samples | {name: (value,) for name, value in good_fixed.items()}
    _check_given(everything, good, own, report)
    check_amplitudes(everything, good, report)
    check_criteria(everything, good, report)
    _check_units_of_criteria(good, given, report)
    check_shapes_given(single, {**axes, **samples}, good, report, own)
    if report or None in (*samples.values(), *axes.values()):  # reported elsewhere
        return None, report
    about = replace(given, pairs=pairs, similar=plain_number(similar), body_names=body_names)
    grid = completed(good_fixed, good_axes, good_samples, about)
    check_bodies(grid, report)
    check_loops(grid, report)
    # Sizes of what stands for a wrong load are no mistakes.
    if not report and not any(load is ANY or load is ANY_MEASURED for load in grid.values("load")):
        check_contacts(grid, report)
    if not report:
        check_distances(grid, distances, report)
    return (None if report else grid), report


def _check_units_of_criteria(
    good: Mapping[str, Sequence[Any]], given: ContactDetails, report: Report
) -> None:
    """The criterion that needs the strength of the bodies, the one that has no life, and those of tension."""
    criteria = values_taken("criterion", good)
    if FATEMI_SOCIE in criteria and not given.yield_strengths:
        allowed = f"a stress: the criterion {FATEMI_SOCIE} measures the normal stress in it"
        report("material.yield_strength", "nothing", allowed)
    if {*criteria} == {FINDLEY} and (given.materials or given.shear_materials):
        allowed = "none: the Findley stress is compared with a limit, and has no life"
        report("material", f"constants with the criterion {FINDLEY} alone", allowed)
    elif given.shear_materials and not given.materials and criteria and FATEMI_SOCIE not in criteria:
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
    pairs = {name: two for name, two in about.pairs.items() if two[0] != two[1]}
    fixed = fixed | {name: two[0] for name, two in about.pairs.items() if name not in pairs}
    about = replace(about, pairs=pairs)
    given = {*fixed, *axes, *samples, *pairs}
    given |= replaced_by(given)
    profiles = (*axes.get("profile", ()), *samples.get("profile", ()), fixed.get("profile"))
    loads = axes.get("load") or samples.get("load") or tuple(v for n, v in fixed.items() if n == "load")
    scaling = amplitudes_of(loads)
    fixed = fixed | still_load(profiles, given | scaling)
    fixed = fixed | measured_amplitudes(given, loads)
    given |= {*fixed} | replaced_by(fixed)
    table = rows(labels_of(about.units, profiles, given))
    defaults = {n: read_value(row, row.default) for n, row in table.items() if row.default is not None}
    if "bulk_stress_amplitude" in scaling:
        defaults["bulk_stress_amplitude"] = LOOP_AMPLITUDE
    if "bulk_stress_ratio" in given:
        del defaults["bulk_stress_mean"]
    fixed = fixed | {name: value for name, value in defaults.items() if name not in given}
    own = {name: fixed[name] for name in table if name in fixed}
    grid = PhysicalGrid(own, dict(axes), dict(samples), **vars(about))
    # Bodies with different s, SWT or cycles are both there.
    pulled = any(v != 0.0 for n in ("bulk_stress_amplitude", "bulk_stress_mean") for v in grid.values(n))
    of_both = (grid.materials, grid.yield_strengths, grid.shear_materials, grid.findley_limits)
    if "body" not in given and (grid.pairs or pulled or any(len({*each}) > 1 for each in of_both)):
        return completed(fixed, {**axes, "body": (1.0, 2.0)}, samples, about)
    return grid


def _body_names(single: dict[str, object], given: tuple[str, ...], report: Report) -> tuple[str, ...]:
    """Names of the bodies, taken from the fixed values, in which a name becomes 1 or 2."""
    raw = single.pop(NAMES_KEY, given or None)
    if raw is None:
        return ()
    names = tuple(raw) if isinstance(raw, list | tuple) else ()
    sound = all(isinstance(name, str) and name.isprintable() and name.strip() for name in names)
    if len(names) != 2 or not sound or names[0] == names[1]:
        report.of(NAMES_KEY, literal(raw), 'two names, such as ["pad", "specimen"]')
        return ()
    body = single.get("body")
    if isinstance(body, str) and body not in map(str, LABELS):
        if body not in names:
            report.of("body", literal(body), labels_or(names))
        single["body"] = names.index(body) + 1 if body in names else 1
    return names


def _pairs(
    fixed: Mapping[str, object], own: Mapping[str, Parameter], report: Report
) -> tuple[dict[str, tuple[float, float]], dict[str, object]]:
    """Split the fixed values into those of each body and the others; an empty pair for one that is wrong."""
    pairs: dict[str, Any] = {}
    for name in OF_BODIES:
        raw = fixed.get(name)
        if not isinstance(raw, list | tuple):
            continue
        pairs[name] = ()
        if len(raw) != 2:
            report.of(name, literal(raw), f"{own[name].allowed}; or two, one for each body")
            continue
        both = {f"{name}[{i}]": one for i, one in enumerate(raw)}
        read, _ = read_values(both, {}, report, rows=dict.fromkeys(both, own[name]))
        if len(read) == 2:
            pairs[name] = tuple(map(as_number, read.values()))
    return pairs, {name: value for name, value in fixed.items() if name not in pairs}


def _check_given(
    everything: Collection[str], good: NamedValues, own: Mapping[str, Parameter], report: Report
) -> None:
    """Report which values a contact lacks, and which exclude one another."""
    tables = [isinstance(profile, Definition) for profile in good.get("profile", ("paraboloid",))]
    # What is misspelt is not lacking, too.
    everything = {*everything, *(meant(name, own) or name for name in everything if name not in own)}
    # A wrong load is reported: nothing else is lacking because of it.
    measured = good.get("load") or ((ANY_MEASURED,) if "load" in everything else ())
    everything |= {*measured_amplitudes(everything, measured)}
    for name in ("young_modulus", "poisson_ratio", "radius", "friction"):
        if name not in everything and not (name == "radius" and all(tables)):
            report.of(name, "nothing", own[name].allowed)
    if "radius" in everything and all(tables) and tables:
        report.of("radius", "a radius", "nothing: the table of the profile has lengths")
    mean = mean_of_loads(everything, measured)
    if wrong := wrong_mean_load({*everything, *([mean] if mean else [])}):
        loads = [load for load in measured if isinstance(load, Loop) and load.is_absolute]
        hint = (
            f"; or absolute = true under [loads.{loads[0]}], whose normal column is far from 0"
            if loads
            else ""
        )
        report.of(MEAN_LOADS, wrong[0], wrong[1] + hint)
    if {"bulk_stress_mean", "bulk_stress_ratio"} <= {*everything}:
        report.of(("bulk_stress_mean", "bulk_stress_ratio"), "both", "one of the two")
    if any(value not in (1.0, 2.0) for value in good.get("body", ())):
        report.of("body", literal(list(good["body"])), "1 or 2")
    loops = [load for load in good.get("load", ()) if isinstance(load, Loop)]
    scaling = amplitudes_of(loops)
    sized = {"bulk_stress_amplitude", "bulk_stress_mean"} & {*everything, *scaling}
    if "bulk_stress_ratio" in everything and not sized:
        report.of("bulk_stress_amplitude", "nothing", "a stress, which bulk_stress_ratio needs")
    mixed = len(loops) < len(good.get("load", ()))  # what scales both kinds is asked for by check_amplitudes
    if all(load.normal_ends == (0.0, 0.0) for load in loops):
        scaling.discard("normal_amplitude")  # it scales nothing
    profiles = good.get("profile", ())
    if any(map(is_plane, profiles)):
        named = {*everything, *still_load(profiles, {*everything, *scaling})}
        check_forces(named, good, report)
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
    rubbing = [as_number(value) for value in grid.values("friction") if as_number(value) > 0.0]
    pairs = [Moduli(*both) for both in itertools.product(*map(grid.of_both, OF_BODIES))]
    if not rubbing or not pairs:
        return
    friction, beta = min(rubbing), max((pair.mismatch for pair in pairs), key=abs)
    ratio = abs(beta) / friction
    found = f"Dundurs' β = {beta:.3g} is {ratio:.2g} times the friction {friction:g}"
    if ratio > grid.similar:
        enough = math.ceil(100.0 * ratio) / 100.0
        allowed = (
            f"|β|/μ ≤ {grid.similar:g}, since (1 − 2ν1)/G1 = (1 − 2ν2)/G2 is assumed (eq. 1); "
            f"{SIMILAR_KEY} = {enough:g} accepts them: s leaves out tangential tractions of about β p"
        )
        report.of(OF_BODIES, f"bodies that are not similar: {found}", allowed)
    elif ratio > NOTICEABLE_MISMATCH:
        words = f"{found}: pressure p drags tangential tractions of about β p along, which s leaves out"
        warnings.warn(words, stacklevel=2)


def read_contact(text: object) -> ContactDetails:
    """Read the attribute of results; see `swtstudy.units.grid.PhysicalGrid`.

    Raises
    ------
    ValueError
        With the reason, if it cannot be read.
    """
    from pydantic import TypeAdapter, ValidationError

    try:
        given = TypeAdapter(ContactDetails).validate_json(str(text))
    except ValidationError as error:
        raise ValueError(f"not a contact: {error.errors()[0]['msg']}") from None
    several = [each for name, each in vars(given).items() if isinstance(each, tuple) and name != "blocks"]
    sound = given.pairs.keys() <= {*OF_BODIES} and math.isfinite(given.similar)
    if not sound or {*map(len, several)} - {0, len(LABELS)}:
        raise ValueError(f"not a contact: {literal(text)}")
    return given
