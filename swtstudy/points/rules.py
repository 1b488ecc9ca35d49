"""Rules on what can be combined: criteria, plane contacts, loops of the load, and shapes of profiles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from swtstudy.points.grid import SHAPE_COLUMNS, Grid, complete, numbers_at, value_of
from swtstudy.points.values import amplitudes_of, as_number, press_steadily, values_taken
from swtstudy.solver.at_rest import check_shape, compact_shapes, largest_depths
from swtstudy.solver.load_path import Loop
from swtstudy.solver.table import ROUGH, TabulatedProfile
from swtstudy.vocabulary.choices import CRITERIA, SHARP, SWT, families_with, family_of, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal, more_like_it
from swtstudy.vocabulary.parameters import NORMAL_AMPLITUDES, PAIRS, PARAMETERS, Parameter, replaced_by

#: Parameters that scale the columns of a loop.
AMPLITUDES = ("normal_amplitude", "tangential_amplitude", "bulk_stress_amplitude")
#: Largest load of a loop over the mean one: at 1e12 of them s has an error of 1 %.
LARGEST_LOAD = 1e9
#: Shapes of one profile; each is looked at, a million in 0.1 s.
MOST_SHAPES = 50_000_000
#: Shapes that are looked at together: the working memory for one is some 100 bytes.
_SLAB = 500_000


def check_criteria(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Parameters that the criteria need or do not have, and profiles that they do not allow.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """
    others = [name for name in dict.fromkeys(values_taken("criterion", good)) if name != SWT]
    if not others:
        if any(values_taken("normal_sensitivity", good)):
            found = f"a value with the criterion {SWT}"
            of_shear = " or ".join(name for name in CRITERIA if name != SWT)
            report.of("normal_sensitivity", found, f"a value with {of_shear} only")
        return
    criteria = f"with the criterion {', '.join(others)}"
    if "normal_sensitivity" not in {*given}:
        report.of("normal_sensitivity", "nothing", f"a number ≥ 0 {criteria}")
    default = PARAMETERS["walker_exponent"].default
    if any(value != default for value in values_taken("walker_exponent", good)):
        report.of("walker_exponent", f"a value {criteria}", f"a value with {SWT} only")
    if SHARP in map(str, values_taken("profile", good)):
        why = "where slip reverses at its sharp edge, the amplitude of the shear stress has no bound"
        report.of("profile", f"{SHARP} {criteria}", f"another profile: {why}")


def check_forces(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Displacements have no meaning in the plane, and they are what is not given as a force.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """
    plane = [str(profile) for profile in values_taken("profile", good) if is_plane(profile)]
    names = set(given)
    if "normal_amplitude" not in names and press_steadily(values_taken("load", good)):
        names.add("normal_force_amplitude")  # it would scale nothing: `grid.complete` makes it 0
    wanted = [force for force in PAIRS if force not in names]
    if not plane or not wanted:
        return
    instead = [PAIRS[force] for force in wanted if PAIRS[force] in names]
    found = "a displacement" if instead else "nothing"
    why = "depths and displacements of a plane contact have no meaning, only forces have"
    allowed = f"{' and '.join(wanted)}: {why}"
    report.of(instead or wanted, f"{found} with the profile {', '.join(plane)}", allowed)


def check_amplitudes(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """An amplitude that is not given is 1 for a loop, and Table 1's for two oscillations.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """
    loads = values_taken("load", good)
    if len({isinstance(load, Definition) for load in loads}) < 2:
        return
    names = {*given}
    names |= replaced_by(names)
    if any(is_plane(profile) for profile in values_taken("profile", good)):
        names |= {*PAIRS.values()}  # forces alone have a meaning: check_forces asks for them
    scaling = amplitudes_of(loads)
    for name in (each for each in PARAMETERS if each in scaling and each not in names):
        allowed = "a value: it scales the loops, and is the amplitude of the harmonic load"
        report.of(name, "nothing", allowed)


def check_loops(grid: Grid, report: Report) -> None:
    """With a force and a displacement the straight sides of a loop are curved in the memory diagram.

    Nor does a bulk stress oscillate with a loop that has no course of it. And a normal load that stays far
    from 0 is the load itself, where its deviation from the mean is asked for.
    """
    name, loops, control = "bulk_stress_amplitude", grid.loops, grid.control
    oscillating = [value for value in grid.values(name) if value != 0.0]
    if loops and oscillating and not any(name in load.scaled_by for load in loops):
        found = f"{literal(oscillating[0])} with a loop of two columns, {literal(loops[0].name)}"
        allowed = "0, or a loop with the bulk stress as its third column; bulk_stress_mean goes with all"
        report.of(name, found, allowed)
    if not any(grid.values(control.given_for("normal_amplitude"))):
        return
    for load in (load for load in loops if load.is_absolute and load.mean_normal is None):
        low, high = load.normal_ends
        found = f"{literal(load.name)} with a normal column from {low:g} to {high:g}, far from 0"
        allowed = f"deviations from the mean normal load: take its mean, {0.5 * (low + high):g}, off"
        report.of("load", found, f"{allowed} (absolute = true, LoadPath.absolute)")
    names = [literal(load.name) for load in loops if control.mixed and len({*load.normal_ends}) > 1]
    smooth = [literal(load.name) for load in loops if control.mixed and not hasattr(load, "vertices")]
    if names:
        found = f"{', '.join(names)} with a normal load that is not constant, and {control.name}"
        absolute = any(load.mean_normal is not None for load in loops)
        held = f"scale = {{ normal = 0 }}{' without absolute' * absolute} under [loads.NAME]"
        allowed = f"a normal load at rest ({control.given_for('normal_amplitude')} = 0, or {held})"
        report.of("load", found, f"two displacements or two forces; or {allowed}")
    elif smooth:
        found = f"harmonics, {', '.join(smooth)}, and {control.name}"
        report.of("load", found, "two displacements or two forces; or vertices")


def check_loops_alone(good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Check loops where other mistakes leave no grid: only if both amplitudes are given, soundly and once."""
    own = {name: tuple(good[name]) for name in ("load", *PAIRS, *PAIRS.values()) if good.get(name)}
    if "load" in own and all(len({*pair} & own.keys()) == 1 for pair in PAIRS.items()):
        check_loops(complete({}, own), report)


def doubts(grid: Grid, where: str = "") -> Iterator[str]:
    """Words on axes without effect, and on tables smoothed by much of their rise within the contact.

    Parameters
    ----------
    grid
        Points without mistakes.
    where
        What the keys of axes begin with, such as "axes.".
    """
    harmonic = len(grid.loops) < len(grid.values("load"))
    moves = harmonic and any(grid.values(grid.control.given_for("normal_amplitude")))
    pulled = harmonic and any(grid.values("bulk_stress_amplitude"))
    idle = {"phase": not moves, "frequency_ratio": not harmonic, "bulk_stress_phase": not pulled}
    for name in (name for name, still in idle.items() if still and name in grid.axes):
        yield f"{where}{name} has no effect: what it is of does not oscillate"
    if harmonic and not moves and {*grid.values("frequency_ratio")} > {1.0}:
        words = "changes no stress under a constant normal load, only how many oscillations a load cycle has"
        yield f"{where * ('frequency_ratio' in grid.axes)}frequency_ratio {words}: 1 has one"
    largest: dict[str, float] = {}
    for table in grid.definitions.values():
        if isinstance(table, TabulatedProfile):
            largest[table.name] = max(table.smoothed_share(1.0), largest.get(table.name, 0.0))
    for name, share in largest.items():
        if share > ROUGH:
            yield (
                f"profile {name}: its smoothing is {share:.2g} of its rise within the contact at the mean "
                "load, so that the largest local values, such as s, may be off by more than that share; "
                "a mean over a critical_distance is nearer"
            )


def sizes_of(load: Loop) -> dict[str, float]:
    """Largest size of the values of a loop, by the amplitude that multiplies them."""
    sizes = {name: max(map(abs, each)) for name, each in zip(AMPLITUDES, load.ends, strict=False)}
    return dict.fromkeys(AMPLITUDES, 0.0) | sizes


def check_sizes(grid: Grid, given: Collection[str], report: Report) -> None:
    """Loads so large that rounding is left of the mean one, and loads in units where nothing has units.

    Only amplitudes over the mean load fit the latter.
    """
    sized = [load for load in grid.loops if load.mean_normal is not None]
    if sized and NORMAL_AMPLITUDES.isdisjoint(given):
        mean = f"{sized[0].mean_normal:g}"
        found = f"{literal(sized[0].name)} with a mean normal load of {mean}, without units"
        allowed = f"[units], or swtstudy.physical; or normal_force_amplitude = 1/{mean} or the like"
        report.of("load", found, allowed)
    for load, name in itertools.product(grid.loops, AMPLITUDES):
        amplitudes = map(as_number, grid.values(grid.control.given_for(name)))
        size, words = sizes_of(load)[name] * max(amplitudes, default=0.0), name.rpartition("_")[0]
        if not size <= LARGEST_LOAD:
            found = f"{literal(load.name)} with a {words.replace('_', ' ')} of {size:.3g}"
            report.of("load", found, f"at most {LARGEST_LOAD:g}, {PARAMETERS[name].scale}")


def check_shapes_given(
    fixed: Mapping[str, object],
    along: Mapping[str, object],
    good: Mapping[str, Sequence[Any]],
    report: Report,
    rows: Mapping[str, Parameter] = PARAMETERS,
) -> None:
    """Every profile needs its shape parameters; one that no profile has would change nothing."""
    given, read = {*fixed, *along}, good.get("profile", ())
    profiles = list(dict.fromkeys(map(str, read if "profile" in given else values_taken("profile", {}))))
    # A profile that could not be read may be the one that has the others.
    raw = along.get("profile", read)
    sound = isinstance(raw, Sequence) and len(raw) == len(read) and bool(profiles)
    needed = shapes_needed(profiles)
    for name in needed:
        if name not in given:
            owners = ", ".join(profile for profile in profiles if name in family_of(profile).shape)
            report.of(name, "nothing", f"{rows[name].allowed} ({owners} needs it)")
    for name in SHAPE_COLUMNS:
        if name in needed or not sound or name not in given:
            continue
        found = literal(fixed[name]) if name in fixed else "an axis"
        allowed = f"only with the profile {' or '.join(families_with(name))}"
        report.of(name, f"{found}, which no profile here has ({', '.join(profiles)})", allowed)


def shapes_needed(profiles: list[str]) -> tuple[str, ...]:
    """The shape parameters that at least one of the profiles has."""
    return tuple(n for n in SHAPE_COLUMNS if any(n in family_of(p).shape for p in profiles))


def check_shapes(grid: Grid, report: Report, told: Callable[[dict[str, int]], str] | None = None) -> None:
    """Profiles that are not admissible for any load, such as a waviness that breaks the contact up.

    Parameters
    ----------
    grid
        The points.
    report
        Told the first wrong shape of each profile.
    told
        Says where a place of the grid is, so that each load is looked at. Without it the largest load of a
        shape counts, whose contact is the hardest to keep compact.
    """
    # By how many amplitudes the normal load rises at most.
    reach = max(load.normal_ends[1] if isinstance(load, Loop) else 1.0 for load in grid.values("load"))
    # A table of real contacts is another one in a_H and δ0 from depth to depth.
    known, profiles = grid.definitions, dict[str, dict[int, Any]]()
    for code in dict.fromkeys(grid.columns["profile"][1].ravel().tolist()):
        table: Any = value_of(code, known)
        if family_of(table).shape or isinstance(table, Definition):
            profiles.setdefault(str(table), {})[code] = table
    for profile, tables in profiles.items():
        names = family_of(profile).shape
        columns = {name: grid.columns[name] for name in ("profile", *names)}
        along = {dim for dims, _ in columns.values() for dim in dims}
        dims, loads = grid.columns["normal_amplitude"]
        if told is None:
            loads = loads.max(tuple(k for k, dim in enumerate(dims) if dim not in along))
            dims = tuple(dim for dim in dims if dim in along)
        columns["normal_amplitude"], along = (dims, loads), along | {*dims}
        sizes = {dim: size for dim, size in grid.sizes.items() if dim in along}
        if (count := math.prod(size for dim, size in sizes.items() if dim != "profile")) > MOST_SHAPES:
            report.of(names, f"{count} shapes of the {profile}", f"at most {MOST_SHAPES}")
            continue
        refused, found, why = 0, "", None
        for start in range(0, math.prod(sizes.values()), _SLAB):
            places = np.arange(start, min(start + _SLAB, math.prod(sizes.values())))
            code, *shapes, load = numbers_at(columns.values(), sizes, places)
            for own, table in tables.items():
                same = np.flatnonzero(code == own)
                shape = {name: values[same] for name, values in zip(names, shapes, strict=True)}
                normal = 1.0 + np.maximum(load[same] * reach, 0.0)
                depth = largest_depths(table, shape, normal) if grid.control.normal_force else normal
                wrong = np.flatnonzero(~np.atleast_1d(compact_shapes(table, shape, depth)))
                if wrong.size and not refused:
                    first = {name: float(values[wrong[0]]) for name, values in shape.items()}
                    found = ", ".join(f"{name} = {value:g}" for name, value in first.items()) or profile
                    why = check_shape(table, first, float(depth[wrong[0]]))
                    if told is not None:
                        at = np.unravel_index(places[same[wrong[0]]], [*sizes.values()])
                        found = told(dict(zip(sizes, map(int, at), strict=True)))
                        why = f"{why} (in a_H and δ0)"
                refused += wrong.size
        if refused:
            report.of(names or "profile", found + more_like_it(refused), why or "")
