"""Rules on what can be combined: criteria, plane contacts, loops of the load and what is prescribed."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from swtstudy.points.grid import Grid
from swtstudy.points.values import amplitudes_of, values_taken
from swtstudy.vocabulary.choices import FATEMI_SOCIE, FINDLEY, SHARP, SWT, is_plane
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal
from swtstudy.vocabulary.parameters import NORMAL_AMPLITUDES, PAIRS, PARAMETERS, replaced_by

if TYPE_CHECKING:
    from swtstudy.loads.loop import Loop


def check_criteria(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Parameters that the criteria need or do not have, and profiles that they do not allow.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """

    def values(name: str) -> Sequence[Any]:
        return values_taken(name, good)

    names, others = {*given}, [name for name in dict.fromkeys(values("criterion")) if name != SWT]
    if not others:
        if any(values("normal_sensitivity")):
            found = f"a value with the criterion {SWT}"
            report.of("normal_sensitivity", found, f"a value with {FATEMI_SOCIE} or {FINDLEY} only")
        return
    criteria = f"with the criterion {', '.join(others)}"
    if "normal_sensitivity" not in names:
        report.of("normal_sensitivity", "nothing", f"a number ≥ 0 {criteria}")
    if any(value != PARAMETERS["walker_exponent"].default for value in values("walker_exponent")):
        report.of("walker_exponent", f"a value {criteria}", f"a value with {SWT} only")
    if SHARP in map(str, values("profile")):
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
    wanted = [force for force in PAIRS if force not in names]
    if not plane or not wanted:
        return
    instead = [PAIRS[force] for force in wanted if PAIRS[force] in names]
    found = "a displacement" if instead else "nothing"
    why = "depths and displacements of a plane contact have no meaning, only forces have"
    allowed = f"{' and '.join(wanted)}: {why}"
    report.of(instead or wanted, f"{found} with the profile {', '.join(plane)}", allowed)


#: What scales the columns of a loop.
AMPLITUDES = ("normal_amplitude", "tangential_amplitude", "bulk_stress_amplitude")
#: Largest load of a loop over the mean one: at 1e12 of them s has an error of 1 %.
LARGEST_LOAD = 1e9


def check_amplitudes(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """An amplitude that is not given is 1 for a loop, and that of Table 1 for two oscillations.

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
    _check_bulk_stress(grid, report)
    if not any(grid.values(grid.control.given_for("normal_amplitude"))):
        return
    for load in grid.loops:
        if load.is_absolute and load.mean_normal is None:
            low, high = load.normal_ends
            found = f"{literal(load.name)} with a normal column from {low:g} to {high:g}, far from 0"
            allowed = f"deviations from the mean normal load: take its mean, {0.5 * (low + high):g}, off"
            allowed += " (absolute = true, LoadPath.absolute)"
            report.of("load", found, allowed)
    loops = grid.loops if grid.control.mixed else ()
    moving = [literal(load.name) for load in loops if not load.is_steady]
    if moving:
        found = f"{', '.join(moving)} with a normal load that is not constant, and {grid.control.name}"
        report.of("load", found, "two displacements or two forces")
    elif smooth := [literal(load.name) for load in loops if not hasattr(load, "vertices")]:
        found = f"harmonics, {', '.join(smooth)}, and {grid.control.name}"
        report.of("load", found, "two displacements or two forces; or vertices")


def check_sizes(grid: Grid, given: Collection[str], report: Report) -> None:
    """Loads in units of their own, where nothing has units: only amplitudes over the mean load fit them."""
    sized = [load for load in grid.loops if load.mean_normal is not None]
    for load in sized[: NORMAL_AMPLITUDES.isdisjoint(given)]:
        found = f"{literal(load.name)} with a mean normal load of {load.mean_normal:g}, without units"
        allowed = (
            f"[units], or swtstudy.physical; or normal_force_amplitude = 1/{load.mean_normal:g} or the like"
        )
        report.of("load", found, allowed)


def sizes_of(load: Loop) -> dict[str, float]:
    """Largest size of the values of a loop, by the amplitude that multiplies them."""
    bulk = load.bulk_ends or (0.0, 0.0)
    ends = zip(AMPLITUDES, (load.normal_ends, load.tangential_ends, bulk), strict=True)
    return {name: max(map(abs, each)) for name, each in ends}


def check_largest(grid: Grid, amplitudes: Mapping[str, float], report: Report) -> None:
    """Loads so large that rounding is left of the mean one, with these largest non-dimensional amplitudes."""
    for load in grid.loops:
        for name, largest in sizes_of(load).items():
            size = amplitudes.get(name, 0.0) * largest
            if not size <= LARGEST_LOAD:
                found = (
                    f"{literal(load.name)} with a {name.rpartition('_')[0].replace('_', ' ')} of {size:.3g}"
                )
                report.of("load", found, f"at most {LARGEST_LOAD:g}, {PARAMETERS[name].scale}")


def _check_bulk_stress(grid: Grid, report: Report) -> None:
    name = "bulk_stress_amplitude"
    loops = [load for load in grid.values("load") if isinstance(load, Definition)]
    oscillating = [value for value in grid.values(name) if value != 0.0]
    if loops and oscillating and not any(name in load.scaled_by for load in loops):
        found = f"{literal(oscillating[0])} with a loop of two columns, {literal(loops[0].name)}"
        allowed = "0, or a loop with the bulk stress as its third column; bulk_stress_mean goes with all"
        report.of(name, found, allowed)
