"""The shape parameters of a grid: that its profiles have them, and that they are admissible."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.grid.canonical import SHAPE_COLUMNS
from swtstudy.grid.grid import Grid
from swtstudy.grid.values import Value, as_number
from swtstudy.mistakes import Report, literal
from swtstudy.named import Named
from swtstudy.parameters import PARAMETERS, families_with, family_of

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray

#: Shapes of one profile; each is looked at, a million in 0.1 s.
MOST_SHAPES = 50_000_000
#: Shapes that are looked at together: the working memory for one is some 100 bytes, and some 10 kB where the
#: depth has to be found from a force.
_SLAB, _TOGETHER = 500_000, 5_000


def check_shapes_given(
    fixed: Mapping[str, object],
    axes: Mapping[str, object],
    good_fixed: Mapping[str, Value],
    good_axes: Mapping[str, tuple[Value, ...]],
    keys: Callable[[str], str],
    report: Report,
) -> None:
    """Every profile needs its shape parameters; one that no profile has would change nothing."""
    if "profile" in good_fixed:
        profiles, sound = [str(good_fixed["profile"])], True
    elif "profile" in fixed or "profile" in axes:
        profiles, raw = [str(profile) for profile in good_axes.get("profile", ())], axes.get("profile")
        # A profile that could not be read may be the one that has the others.
        sound = isinstance(raw, Sequence) and len(profiles) == len(raw) > 0
    else:
        profiles, sound = [str(PARAMETERS["profile"].default)], True
    needed = shapes_needed(profiles)
    for name in needed:
        if name not in fixed and name not in axes:
            owners = ", ".join(profile for profile in profiles if name in family_of(profile).shape)
            report(keys(name), "nothing", f"{PARAMETERS[name].allowed} ({owners} needs it)")
    for name in SHAPE_COLUMNS:
        if name in needed or not sound or not (name in fixed or name in axes):
            continue
        found = literal(fixed[name]) if name in fixed else "an axis"
        allowed = f"only with the profile {' or '.join(families_with(name))}"
        report(keys(name), f"{found}, which no profile here has ({', '.join(profiles)})", allowed)


def shapes_needed(profiles: list[str]) -> tuple[str, ...]:
    """The shape parameters that at least one of the profiles has."""
    return tuple(n for n in SHAPE_COLUMNS if any(n in family_of(p).shape for p in profiles))


def check_shapes(grid: Grid, keys: Callable[[str], str], report: Report) -> None:
    """Profiles that are not admissible for any load, such as a waviness that breaks the contact up."""
    profile: Any
    for profile in grid.values("profile"):
        names = family_of(profile).shape
        axes = [np.array(grid.values(name), float) for name in names]
        if isinstance(profile, Named):
            _check_table(grid, profile, keys, report)
        if not names:
            continue
        count = math.prod(map(len, axes))
        if count > MOST_SHAPES:
            report(", ".join(map(keys, names)), f"{count} shapes of the {profile}", f"at most {MOST_SHAPES}")
            continue
        refused, first = _refused(grid, profile, axes)
        if first is not None:
            from swtstudy.mechanics.indenter import check_shape

            shape = {name: float(values[0]) for name, values in first.items()}
            found = ", ".join(f"{name} = {value:g}" for name, value in shape.items())
            more = f"; {refused - 1} more like it" if refused > 1 else ""
            allowed = check_shape(profile, shape, _largest_depths(grid, profile, first).item()) or ""
            report(", ".join(map(keys, names)), found + more, allowed)


def _check_table(grid: Grid, profile: Any, keys: Callable[[str], str], report: Report) -> None:
    """A profile that the user has defined, up to the largest depth."""
    from swtstudy.mechanics.indenter import check_shape

    wrong = check_shape(profile, {}, _largest_depths(grid, profile, {}).item())
    if wrong is not None:
        report(keys("profile"), str(profile), wrong)


def _refused(grid: Grid, profile: Any, axes: list[FloatArray]) -> tuple[int, dict[str, FloatArray] | None]:
    """How many of the shapes are not admissible, and the first of these."""
    from swtstudy.mechanics.indenter import compact_shapes

    lengths, refused, first = tuple(map(len, axes)), 0, None
    for start in range(0, math.prod(lengths), _SLAB):
        places = np.unravel_index(np.arange(start, min(start + _SLAB, math.prod(lengths))), lengths)
        values = [axis[place] for axis, place in zip(axes, places, strict=True)]
        shape = dict(zip(family_of(profile).shape, values, strict=True))
        depth = _largest_depths(grid, profile, shape)
        wrong = np.flatnonzero(~compact_shapes(profile, shape, depth))
        if wrong.size and first is None:
            first = {name: value[wrong[:1]] for name, value in shape.items()}
        refused += wrong.size
    return refused, first


def _largest_depths(grid: Grid, profile: Any, shape: dict[str, FloatArray]) -> FloatArray:
    """Largest depth of each shape in the grid, (n,): the largest contact is the hardest to keep compact."""
    from swtstudy.mechanics.control.diagram import largest_depth
    from swtstudy.mechanics.indenter import compact_shapes
    from swtstudy.mechanics.load.loop import Loop

    amplitude = max(map(as_number, grid.values(grid.control.given_for("normal_amplitude"))))
    reach = max(load.reach if isinstance(load, Loop) else 1.0 for load in grid.values("load"))
    normal = np.full(len(next(iter(shape.values()), (0,))), 1.0 + max(amplitude * reach, 0.0))
    if not grid.control.normal_force:
        return normal
    # The depth at a force is known for shapes that carry the force at δ0.
    depth = np.ones_like(normal)
    sound = np.flatnonzero(compact_shapes(profile, shape, depth))
    some = {name: values[sound] for name, values in shape.items()}
    for rows in np.array_split(np.arange(len(sound)), len(sound) // _TOGETHER + 1):
        own = {name: values[rows] for name, values in some.items()}
        depth[sound[rows]] = largest_depth(grid.control, profile, own, normal[rows])
    return depth
