"""Contacts of a grid that cannot be, or are beyond a range, in the user's own quantities and units."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from swtstudy.loads.loop import Loop
from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.rules import AMPLITUDES, largest_depths, largest_reach, sizes_of
from swtstudy.points.values import Value, as_number, index_at
from swtstudy.profiles.at_rest import check_shape, compact_shapes
from swtstudy.units.grid import AT_REST_NAMES, PhysicalGrid
from swtstudy.units.rows import MEAN_LOADS
from swtstudy.vocabulary.choices import family_of
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, more_like_it
from swtstudy.vocabulary.parameters import AXES, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.wording import unit_words

#: More contacts than these take minutes.
MOST_CONTACTS = 300_000
#: What is said of a contact in every message.
_SAID = ("radius", *MEAN_LOADS, *SHAPE_COLUMNS)
#: Largest pressure over E* that no metal sustains, and contact radius over R of a table, far above the limit
#: of half-spaces.
LARGEST_PRESSURE, LARGEST_RATIO = 0.1, 0.2


def check_contacts(grid: PhysicalGrid, report: Report) -> None:
    """Contacts that cannot be made, parameters beyond their range, and shapes that are not compact."""
    dims = grid.at_rest_dims
    count = int(np.prod([size for dim, size in zip(grid.dims, grid.shape, strict=True) if dim in dims]))
    if count > MOST_CONTACTS:
        report.of(dims, f"{count} different contacts at rest", f"at most {MOST_CONTACTS}")
    elif wrong := grid.at_rest.wrong:
        error, own = wrong[0]
        for mistake in error.mistakes:
            unit, there = unit_words(grid.row(mistake.key).units), _words(grid, own, mistake.key)
            found = f"{mistake.found}{unit} at {there}{more_like_it(len(wrong))}"
            report.of(mistake.key, found, mistake.allowed)
    elif all([_in_range(grid, column, report) for column in grid.numbers]):
        for profile in dict.fromkeys(grid.values("profile")):
            _check_shapes(grid, profile, report)


def doubts_of_units(grid: PhysicalGrid) -> list[str]:
    """Contacts at rest that hint at a wrong unit: one larger than its radius, or pressed beyond any metal."""
    lines: dict[str, str] = {}
    unit = unit_words(grid.labels.length)
    for contact in {id(each): each for each in grid.at_rest.contacts.flat}.values():
        radius, edge, profile = contact.radius, contact.contact_radius, contact.profile
        if not isinstance(profile, str):
            ratio, pressure = contact.depth / edge, contact.peak_pressure / contact.moduli.normal
            if ratio > LARGEST_RATIO or (np.isfinite(pressure) and pressure > LARGEST_PRESSURE):
                found = f"a contact radius of {edge:.4g}{unit} over R is {ratio:.3g}, "
                found += f"p0 over E* is {pressure:.3g}"
                found = f"profile {profile.name}: {found}: are heights and positions in one unit?"
                lines.setdefault("table", found)
        elif radius is not None and edge - contact.shape.get("flat_radius", 0.0) > radius:
            found = f"radius {radius:g}{unit} is smaller than the contact ({edge:.3g}{unit})"
            lines.setdefault("radius", f"{found}: is the radius in another unit, such as metres?")
    return list(lines.values())


def check_distances(grid: PhysicalGrid, distances: Sequence[float], report: Report) -> None:
    """A critical distance beyond its range in the smallest contact."""
    unit, length = unit_words(grid.row(DISTANCE).units), grid.at_rest.scale("a_H")
    largest, smallest, upper = max(distances, default=0.0), float(length.min()), AXES[DISTANCE].upper
    if largest > upper * smallest:
        words = _words(grid, _at(grid, index_at(length, int(length.values.argmin()))))
        found = f"{largest:g}{unit} at {words}, {largest / smallest:.4g} a_H"
        report.of(DISTANCE, found, f"at most {upper * smallest:.4g}{unit}, {upper:g} a_H")


def _in_range(grid: PhysicalGrid, column: str, report: Report) -> bool:
    """Return whether a parameter is in its range everywhere; report the first value that is not."""
    row, values = PARAMETERS[column], grid.numbers[column]
    if column in AMPLITUDES:
        # Of a loop, by which its vertices are multiplied, the largest load counts.
        loads = grid.values("load")
        values = values * max(sizes_of(load)[column] if isinstance(load, Loop) else 1.0 for load in loads)
    source = grid.control.given_for(column)
    if column == "bulk_stress_mean" and grid.values("bulk_stress_ratio"):
        source = "bulk_stress_ratio"
    low, high = (values < row.lower).values, ~(values <= row.upper).values
    wrong = low | high | ((values == row.lower).values & row.open_lower & bool(grid.values(source)))
    if column in SHAPE_COLUMNS and row.open_lower:
        wrong &= values.values != 0.0  # the profile has none of it
    if not wrong.any() or not row.scale:
        return True
    at = index_at(values, int(wrong.argmax()))
    first, here = tuple(at.values()), _at(grid, at)
    own, unit, number = as_number(here[source]), grid.row(source).units, float(values.values[first])
    words, more, scale = _words(grid, here, source), more_like_it(int(wrong.sum())), AXES[source].scale
    found, bound = f"{own:g} {unit}".strip(), row.upper if high[first] else row.lower
    most = "at most" if high[first] else "at least"
    if not np.isfinite(number):
        found = f"{found} at {words}, friction = {as_number(here['friction']):g}{more}"
        report.of(source, found, "0: without friction the contact slides at once")
    elif not scale:  # a ratio, to which the number is not in proportion
        allowed = f"a mean of {most} {bound:g} {row.scale}"
        report.of(source, f"{own:g} at {words}, a mean of {number:.4g} {row.scale}{more}", allowed)
    else:
        allowed = f"{most} {bound * own / number:.4g} {unit}".strip()
        report.of(source, f"{found} at {words}, {number:.4g} {scale}{more}", f"{allowed}, {bound:g} {scale}")
    return False


def _check_shapes(grid: PhysicalGrid, profile: Value, report: Report) -> None:
    """A profile whose contact is no full disc, up to the largest depth of each load."""
    import xarray as xr

    names = family_of(profile).shape
    if not names and not isinstance(profile, Definition):
        return
    contacts, dims = grid.at_rest.contacts, grid.at_rest.dims
    tables = np.vectorize(lambda contact: contact.pure_profile, otypes=[object])(contacts)
    owned = np.vectorize(lambda contact: contact.profile == profile, otypes=[bool])(contacts)
    amplitude, is_own, pure, *shapes = xr.broadcast(
        grid.numbers["normal_amplitude"],
        *(xr.DataArray(each, dims=dims) for each in (owned, tables)),
        *(grid.numbers[name] for name in names),
    )
    rows = np.flatnonzero(is_own.values)
    reach, tables = amplitude.values.ravel()[rows] * largest_reach(grid), pure.values.ravel()[rows]
    shape = {name: each.values.ravel()[rows] for name, each in zip(names, shapes, strict=True)}
    largest = 1.0 + np.maximum(reach, 0.0)
    wrong, depth = np.zeros(len(rows), bool), np.empty_like(largest)
    for table in dict.fromkeys(tables):
        own = np.flatnonzero(tables == table)
        some = {name: values[own] for name, values in shape.items()}
        depth[own] = largest_depths(grid, table, some, largest[own])
        wrong[own] = ~compact_shapes(table, some, depth[own])
    if wrong.any():
        first = int(wrong.argmax())
        here = _at(grid, index_at(is_own, int(rows[first])))
        name = grid.control.given_for("normal_amplitude")
        words = f"{_words(grid, here)}, {name} = {as_number(here[name]):g} {grid.row(name).units}".rstrip()
        why = check_shape(tables[first], {n: float(v[first]) for n, v in shape.items()}, depth[first])
        report.of(names or "profile", words + more_like_it(int(wrong.sum())), f"{why} (in a_H and δ0)")


def _at(grid: PhysicalGrid, at: Mapping[str, Any]) -> dict[str, Value]:
    """The values of the parameters at a place, or the first ones along dimensions that it leaves open."""
    values = {name: grid.values(name) for name in grid.rows}
    return {n: each[int(at.get(grid.dimension(n) or "", 0))] for n, each in values.items() if each}


def _words(grid: PhysicalGrid, here: Mapping[str, Value], but: str = "") -> str:
    """Which contact it is: its size and load, and whatever else of it varies, but for one parameter."""
    words = []
    for name in (name for name in AT_REST_NAMES if name in here and name != but):
        value = here[name]
        if not isinstance(value, str | Definition) and (name in _SAID or grid.dimension(name)):
            words.append(f"{name} = {as_number(value):g}{unit_words(grid.row(name).units)}")
    return ", ".join(words)
