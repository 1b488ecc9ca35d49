"""Contacts of a grid that cannot be: said in the user's own quantities and units."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.mechanics.indenter import check_shape, compact_shapes
from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.loops import check_largest
from swtstudy.points.shapes import largest_depths, largest_reach
from swtstudy.points.values import Value, as_number
from swtstudy.units.contacts_at_rest import AT_REST_NAMES, MOST_CONTACTS, at_rest_dims
from swtstudy.units.rows import MEAN_LOADS
from swtstudy.vocabulary.axes import AXES
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.families import family_of
from swtstudy.vocabulary.mistakes import Report
from swtstudy.vocabulary.parameters import PARAMETERS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from swtstudy.units.grid import PhysicalGrid

#: What is said of a contact in every message.
_SAID = ("radius", *MEAN_LOADS, *SHAPE_COLUMNS)


def check_contacts(grid: PhysicalGrid, report: Report) -> None:
    """Contacts that cannot be made, parameters beyond their range, and shapes that are not compact."""
    dims = at_rest_dims(grid)
    count = int(np.prod([size for dim, size in zip(grid.dims, grid.shape, strict=True) if dim in dims]))
    if count > MOST_CONTACTS:
        report.of(dims, f"{count} different contacts at rest", f"at most {MOST_CONTACTS}")
        return
    wrong = grid.at_rest.wrong
    if wrong:
        error, own = wrong[0]
        more = f"; {len(wrong) - 1} more like it" if len(wrong) > 1 else ""
        for mistake in error.mistakes:
            there = _words(grid, {name: value for name, value in own.items() if name != mistake.key})
            report.of(mistake.key, f"{mistake.found} at {there}{more}", mistake.allowed)
        return
    if all([_in_range(grid, column, report) for column in grid.numbers]):
        check_largest(grid, {n: float(values.max()) for n, values in grid.numbers.items()}, report)
        for profile in dict.fromkeys(grid.values("profile")):
            _check_shapes(grid, profile, report)


def _in_range(grid: PhysicalGrid, column: str, report: Report) -> bool:
    """Return whether a parameter is in its range everywhere; report the first value that is not."""
    row, values = PARAMETERS[column], grid.numbers[column]
    source = grid.control.given_for(column)
    if column == "bulk_stress_mean" and grid.values("bulk_stress_ratio"):
        source = "bulk_stress_ratio"
    low, high = (values < row.lower).values, ~(values <= row.upper).values
    wrong = low | high | ((values == row.lower).values & row.open_lower & bool(grid.values(source)))
    if column in SHAPE_COLUMNS and row.open_lower:
        wrong &= values.values != 0.0  # the profile has none of it
    if not wrong.any() or not row.scale:
        return True
    first = np.unravel_index(int(wrong.argmax()), wrong.shape)
    at = dict(zip(map(str, values.dims), first, strict=True))
    here = _at(grid, at)
    own, unit = as_number(here[source]), grid.row(source).units
    number = float(values.values[first])
    words = _words(grid, {name: here[name] for name in AT_REST_NAMES if name in here and name != source})
    more = f"; {int(wrong.sum()) - 1} more like it" if wrong.sum() > 1 else ""
    scale = AXES[source].scale or row.scale
    found = f"{own:g} {unit}".strip()
    if not np.isfinite(number):
        friction = f"friction = {as_number(here['friction']):g}"
        allowed = "0: without friction the contact slides at once"
        report.of(source, f"{found} at {words}, {friction}{more}", allowed)
        return False
    bound = row.upper if high[first] else row.lower
    if not AXES[source].scale:  # a ratio, to which the number is not in proportion
        allowed = f"a mean of {'at most' if high[first] else 'at least'} {bound:g} {scale}"
        report.of(source, f"{own:g} at {words}, a mean of {number:.4g} {scale}{more}", allowed)
        return False
    most = f"{'at most' if high[first] else 'at least'} {bound * own / number:.4g} {unit}".strip()
    report.of(source, f"{found} at {words}, {number:.4g} {scale}{more}", f"{most}, {bound:g} {scale}")
    return False


def _at(grid: PhysicalGrid, at: Mapping[str, Any]) -> dict[str, Value]:
    """The values of the parameters at a place, or the first ones along dimensions that it leaves open."""
    found: dict[str, Value] = {}
    for name in grid.rows:
        values = grid.values(name)
        if values:
            dim = grid.dimension(name)
            found[name] = values[int(at.get(dim, 0))] if dim else values[0]
    return found


def _words(grid: PhysicalGrid, values: Mapping[str, Value]) -> str:
    """Which contact it is: its size and load, and whatever else varies."""
    words = []
    for name, value in values.items():
        if isinstance(value, str | Definition) or (name not in _SAID and grid.dimension(name) is None):
            continue
        unit = grid.row(name).units
        words.append(f"{name} = {as_number(value):g}{'' if unit in ('1', '') else f' {unit}'}")
    return ", ".join(words)


def _check_shapes(grid: PhysicalGrid, profile: Value, report: Report) -> None:
    """A profile whose contact is no full disc, up to the largest depth of each load."""
    names = family_of(profile).shape
    if not names and not isinstance(profile, Definition):
        return
    places, numbers = _largest(grid, profile, names)
    shape = {name: numbers[name] for name in names}
    wrong = np.zeros(len(numbers["depth"]), bool)
    for pure in dict.fromkeys(numbers["pure"]):
        own = np.flatnonzero(numbers["pure"] == pure)
        some = {name: values[own] for name, values in shape.items()}
        wrong[own] = ~compact_shapes(pure, some, numbers["depth"][own])
    if not wrong.any():
        return
    first = int(np.flatnonzero(wrong)[0])
    here = _at(grid, {dim: index[first] for dim, index in places.items()})
    amplitude = grid.control.given_for("normal_amplitude")
    words = _words(grid, {name: here[name] for name in AT_REST_NAMES if name in here})
    words += f", {amplitude} = {as_number(here[amplitude]):g} {grid.row(amplitude).units}".rstrip()
    more = f"; {int(wrong.sum()) - 1} more like it" if wrong.sum() > 1 else ""
    why = check_shape(
        numbers["pure"][first], {name: float(v[first]) for name, v in shape.items()}, numbers["depth"][first]
    )
    report.of(names or ("profile",), words + more, f"{why} (in a_H and δ0)")


def _largest(
    grid: PhysicalGrid, profile: Value, names: tuple[str, ...]
) -> tuple[dict[str, NDArray[np.intp]], dict[str, Any]]:
    """Places of the contacts of a profile, their shapes, tables and largest depths, of shape (n,)."""
    import xarray as xr

    at_rest = grid.at_rest
    pure = xr.DataArray(
        np.vectorize(lambda c: c.pure_profile, otypes=[object])(at_rest.contacts), dims=at_rest.dims
    )
    own = np.vectorize(lambda c: c.profile == profile, otypes=[bool])(at_rest.contacts)
    parts = [grid.numbers[name] for name in names]
    every = xr.broadcast(grid.numbers["normal_amplitude"], xr.DataArray(own, dims=at_rest.dims), pure, *parts)
    amplitude, is_own, pure, *shapes = every
    rows = np.flatnonzero(is_own.values)
    index = np.argwhere(is_own.values).T
    places = dict(zip(map(str, is_own.dims), index, strict=True))
    numbers: dict[str, Any] = {n: v.values.reshape(-1)[rows] for n, v in zip(names, shapes, strict=True)}
    numbers["pure"] = pure.values.reshape(-1)[rows]
    largest = 1.0 + np.maximum(amplitude.values.reshape(-1)[rows] * largest_reach(grid), 0.0)
    numbers["depth"] = _depths(grid, numbers, names, largest)
    return places, numbers


def _depths(
    grid: PhysicalGrid, numbers: dict[str, Any], names: tuple[str, ...], largest: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Largest depths from the largest values of what is prescribed."""
    depth = np.empty_like(largest)
    for pure in dict.fromkeys(numbers["pure"]):
        own = np.flatnonzero(numbers["pure"] == pure)
        some = {name: numbers[name][own] for name in names}
        depth[own] = largest_depths(grid, pure, some, largest[own])
    return depth
