"""The shape parameters of a grid: that its profiles have them, and that they are admissible."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.grid import Grid
from swtstudy.points.values import as_number, values_taken
from swtstudy.vocabulary.choices import families_with, family_of
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal, more_like_it
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS

if TYPE_CHECKING:
    from swtstudy.vocabulary.arrays import FloatArray, Shape

#: Shapes of one profile; each is looked at, a million in 0.1 s.
MOST_SHAPES = 50_000_000
#: Shapes that are looked at together: the working memory for one is some 100 bytes, and some 7 kB where the
#: depth has to be found from a force.
_SLAB, _TOGETHER = 500_000, 5_000


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


def check_shapes(grid: Grid, report: Report) -> None:
    """Profiles that are not admissible for any load, such as a waviness that breaks the contact up."""
    for profile in dict.fromkeys(grid.values("profile")):
        if isinstance(profile, Definition):
            _check_table(grid, profile, report)
            continue
        profile = str(profile)
        names = family_of(profile).shape
        if not names:
            continue
        shapes = _shapes_of(grid, profile)
        if shapes.size > MOST_SHAPES:
            found = f"{shapes.size} shapes of the {profile}"
            report.of(names, found, f"at most {MOST_SHAPES}")
            continue
        refused, first = _refused(grid, profile, shapes)
        if first is not None:
            from swtstudy.profiles.at_rest import check_shape

            shape, depth = first
            found = ", ".join(f"{name} = {value:g}" for name, value in shape.items())
            report.of(names, found + more_like_it(refused), check_shape(profile, shape, depth) or "")


def _check_table(grid: Grid, profile: Any, report: Report) -> None:
    """A profile that the user has defined, up to the largest depth."""
    from swtstudy.profiles.at_rest import check_shape

    depth = largest_depths(grid, profile, {}, 1.0 + np.maximum(np.array([_largest_course(grid)]), 0.0))
    wrong = check_shape(profile, {}, depth.item())
    if wrong is not None:
        report.of("profile", str(profile), wrong)


def _largest_course(grid: Grid) -> float:
    """Largest deviation of the normal load from its mean."""
    return max(map(as_number, grid.values(grid.control.given_for("normal_amplitude")))) * largest_reach(grid)


def largest_reach(grid: Grid) -> float:
    """By how many amplitudes the normal load rises at most."""
    from swtstudy.loads.loop import Loop

    return max(load.reach if isinstance(load, Loop) else 1.0 for load in grid.values("load"))


def _shapes_of(grid: Grid, profile: str) -> Grid:
    """The grid of the shapes of a profile; with the normal amplitude where both are sampled."""
    names = family_of(profile).shape
    sampled = {name: grid.samples[name] for name in names if name in grid.samples}
    amplitude = grid.control.given_for("normal_amplitude")
    if sampled and amplitude in grid.samples:
        sampled[amplitude] = grid.samples[amplitude]
    if "profile" in grid.samples:
        own = np.flatnonzero(np.array(grid.samples["profile"]) == profile).tolist()
        sampled = {name: tuple(values[row] for row in own) for name, values in sampled.items()}
    axes = {name: values for name, values in grid.axes.items() if name in names}
    return Grid({name: value for name, value in grid.fixed.items() if name in names}, axes, sampled)


def _refused(grid: Grid, profile: str, shapes: Grid) -> tuple[int, tuple[dict[str, float], float] | None]:
    """Number of shapes that are not admissible; the first of these, and its largest depth."""
    from swtstudy.profiles.at_rest import compact_shapes

    names, amplitude = family_of(profile).shape, grid.control.given_for("normal_amplitude")
    refused, first = 0, None
    # The largest contact of a shape is the hardest to keep compact.
    largest, reach = max(map(as_number, grid.values(amplitude))), largest_reach(grid)
    for start in range(0, shapes.size, _SLAB):
        stop = min(start + _SLAB, shapes.size)
        columns = shapes.columns(np.arange(start, stop))
        shape = {name: np.broadcast_to(columns[name], stop - start) for name in names}
        own = columns["normal_amplitude"] if shapes.values(amplitude) else np.array(largest)
        depth = largest_depths(
            grid, profile, shape, np.broadcast_to(1.0 + np.maximum(own * reach, 0.0), stop - start)
        )
        wrong = np.flatnonzero(~compact_shapes(profile, shape, depth))
        if wrong.size and first is None:
            first = {name: float(values[wrong[0]]) for name, values in shape.items()}, float(depth[wrong[0]])
        refused += wrong.size
    return refused, first


def largest_depths(grid: Grid, profile: Any, shape: Shape, normal: FloatArray) -> FloatArray:
    """Largest depth of each of n shapes, from the largest value of what is prescribed, both (n,)."""
    from swtstudy.profiles.at_rest import compact_shapes, largest_depth

    if not grid.control.normal_force:
        return normal
    # The depth at a force is known for shapes that carry the force at δ0.
    depth = np.ones_like(normal)
    sound = np.flatnonzero(compact_shapes(profile, shape, depth))
    some = {name: values[sound] for name, values in shape.items()}
    for rows in np.array_split(np.arange(len(sound)), len(sound) // _TOGETHER + 1):
        own = {name: values[rows] for name, values in some.items()}
        depth[sound[rows]] = largest_depth(profile, own, normal[rows])
    return depth
