"""The contacts of a grid at rest: what the scales of everything else are made of, and which cannot be.

That is said in the user's own quantities and units.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.loads.loop import Loop
from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.rules import AMPLITUDES, sizes_of
from swtstudy.points.shapes import largest_depths, largest_reach
from swtstudy.points.values import Value, as_number, index_at
from swtstudy.profiles.at_rest import check_shape, compact_shapes
from swtstudy.units.at_rest import Contact, Moduli, depth_at, refuse_beyond
from swtstudy.units.rows import MEAN_LOADS, SCALES
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.choices import family_of
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, StudyError, more_like_it
from swtstudy.vocabulary.parameters import AXES, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE
from swtstudy.vocabulary.wording import unit_words

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.grid import PhysicalGrid

#: What a contact at rest depends on, and its slip with it.
AT_REST_NAMES = (
    *("young_modulus", "poisson_ratio", "radius", "depth", "normal_force", "friction", "profile"),
    "contact_length",
    *SHAPE_COLUMNS,
)
#: More contacts than these take minutes.
MOST_CONTACTS = 300_000


@dataclass(frozen=True)
class ContactsAtRest:
    """The contacts of a grid at rest, over the dimensions that they depend on.

    Attributes
    ----------
    dims
        The dimensions of the grid that they depend on.
    contacts
        An array of `Contact` over these dimensions; None where there is none.
    wrong
        What is wrong with contacts, and the values of theirs: the first ones.
    """

    dims: tuple[str, ...]
    contacts: Any
    wrong: tuple[tuple[StudyError, dict[str, Value]], ...] = ()

    def each(self, value: Callable[[Contact], float]) -> xr.DataArray:
        """A number of every contact."""
        import xarray as xr

        numbers = {id(each): value(each) for each in {id(each): each for each in self.contacts.flat}.values()}
        found = [numbers[id(each)] for each in self.contacts.flat]
        return xr.DataArray(np.reshape(np.array(found, float), self.contacts.shape), dims=self.dims)

    def scale(self, name: str) -> xr.DataArray:
        """One of `SCALES` that is not made of another parameter."""
        return self.each(SCALES[name].of)

    def shape(self, name: str) -> xr.DataArray:
        """A non-dimensional shape parameter; 0 where the profile has none of it."""
        return self.each(lambda contact: contact.shape_parameters.get(name, 0.0))


def at_rest_dims(grid: PhysicalGrid) -> tuple[str, ...]:
    """The dimensions of a grid that its contacts at rest depend on."""
    varying = {grid.dimension(name) for name in AT_REST_NAMES}
    return tuple(dim for dim in grid.dims if dim in varying)


def contacts_at_rest(grid: PhysicalGrid) -> ContactsAtRest:
    """The contacts at rest of a grid."""
    varying = {name: dim for name in AT_REST_NAMES if (dim := grid.dimension(name)) is not None}
    dims = at_rest_dims(grid)
    lengths = dict(zip(grid.dims, grid.shape, strict=True))
    shape = tuple(lengths[dim] for dim in dims)
    known: dict[tuple[Value, ...], Contact | None] = {}
    wrong: list[tuple[StudyError, dict[str, Value]]] = []
    contacts = np.empty(shape, object)
    values = {name: grid.values(name) for name in AT_REST_NAMES if grid.values(name)}
    for place in itertools.product(*map(range, shape)):
        at = dict(zip(dims, place, strict=True))
        own = {name: each[at[varying[name]]] if name in varying else each[0] for name, each in values.items()}
        key = tuple(own.values())
        if key not in known:
            try:
                known[key] = _contact(grid, own)
            except StudyError as error:
                known[key] = None
                wrong.append((error, own))
        contacts[place] = known[key]
    return ContactsAtRest(dims, contacts, tuple(wrong))


def _contact(grid: PhysicalGrid, own: dict[str, Value]) -> Contact:
    """The contact with values of `AT_REST_NAMES`."""

    numbers = {
        name: as_number(value) for name, value in own.items() if not isinstance(value, str | Definition)
    }
    young, poisson = (
        grid.pairs.get(name) or (numbers[name],) * 2 for name in ("young_modulus", "poisson_ratio")
    )
    profile: Any = own["profile"]
    contact = Contact(
        Moduli(young, poisson),
        radius=numbers.get("radius"),
        depth=numbers.get("depth", 1.0),
        friction=numbers["friction"],
        profile=profile,
        shape={name: numbers[name] for name in family_of(profile).shape},
        contact_length=numbers.get("contact_length"),
    )
    if "normal_force" in numbers:
        contact = replace(contact, depth=depth_at(contact, numbers["normal_force"]))
    if isinstance(profile, Definition):
        refuse_beyond(contact.profile, contact.depth)  # type: ignore[arg-type]
    return contact


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
        more = more_like_it(len(wrong))
        for mistake in error.mistakes:
            there = _words(grid, {name: value for name, value in own.items() if name != mistake.key})
            unit = unit_words(grid.row(mistake.key).units)
            report.of(mistake.key, f"{mistake.found}{unit} at {there}{more}", mistake.allowed)
        return
    if all([_in_range(grid, column, report) for column in grid.numbers]):
        for profile in dict.fromkeys(grid.values("profile")):
            _check_shapes(grid, profile, report)


#: Largest pressure over E* that no metal sustains, and contact radius over R of a table, far above the limit
#: of half-spaces.
LARGEST_PRESSURE, LARGEST_RATIO = 0.1, 0.2


def doubts_of_units(grid: PhysicalGrid) -> list[str]:
    """Contacts at rest that hint at a wrong unit: one larger than its radius, or pressed beyond any metal."""
    lines: dict[str, str] = {}
    unit = unit_words(grid.labels.length)
    for contact in {id(each): each for each in grid.at_rest.contacts.flat}.values():
        radius, edge = contact.radius, contact.contact_radius
        profile = contact.profile
        if not isinstance(profile, str):
            ratio, pressure = contact.depth / edge, contact.peak_pressure / contact.moduli.normal
            if ratio > LARGEST_RATIO or (np.isfinite(pressure) and pressure > LARGEST_PRESSURE):
                found = (
                    f"profile {profile.name}: a contact radius of {edge:.4g}{unit} over R is {ratio:.3g}, p0"
                )
                found += f" over E* is {pressure:.3g}"
                lines.setdefault("table", f"{found}: are heights and positions in one unit?")
        elif radius is not None and edge - contact.shape.get("flat_radius", 0.0) > radius:
            found = f"radius {radius:g}{unit} is smaller than the contact ({edge:.3g}{unit})"
            lines.setdefault("radius", f"{found}: is the radius in another unit, such as metres?")
    return list(lines.values())


def check_distances(grid: PhysicalGrid, distances: Sequence[float], report: Report) -> None:
    """A critical distance beyond its range in the smallest contact."""
    row, length = grid.row(DISTANCE), grid.at_rest.scale("a_H")
    largest, smallest, upper = max(distances, default=0.0), float(length.min()), AXES[DISTANCE].upper
    if largest <= upper * smallest:
        return
    here = _at(grid, index_at(length, int(length.values.argmin())))
    words = _at_rest_words(grid, here)
    found = f"{largest:g}{unit_words(row.units)} at {words}, {largest / smallest:.4g} a_H"
    report.of(DISTANCE, found, f"at most {upper * smallest:.4g}{unit_words(row.units)}, {upper:g} a_H")


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
    own, unit = as_number(here[source]), grid.row(source).units
    number = float(values.values[first])
    words = _at_rest_words(grid, here, source)
    more = more_like_it(int(wrong.sum()))
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


def _at_rest_words(grid: PhysicalGrid, here: Mapping[str, Value], but: str = "") -> str:
    """The values that a contact at rest depends on, but for one, in words."""
    return _words(grid, {name: here[name] for name in AT_REST_NAMES if name in here and name != but})


def _words(grid: PhysicalGrid, values: Mapping[str, Value]) -> str:
    """Which contact it is: its size and load, and whatever else varies."""
    words = []
    for name, value in values.items():
        if isinstance(value, str | Definition) or (name not in _SAID and grid.dimension(name) is None):
            continue
        words.append(f"{name} = {as_number(value):g}{unit_words(grid.row(name).units)}")
    return ", ".join(words)


def _check_shapes(grid: PhysicalGrid, profile: Value, report: Report) -> None:
    """A profile whose contact is no full disc, up to the largest depth of each load."""
    names = family_of(profile).shape
    if not names and not isinstance(profile, Definition):
        return
    places, numbers, largest = _largest(grid, profile, names)
    shape = {name: numbers[name] for name in names}
    wrong, depth = np.zeros(len(largest), bool), np.empty_like(largest)
    for pure in dict.fromkeys(numbers["pure"]):
        own = np.flatnonzero(numbers["pure"] == pure)
        some = {name: values[own] for name, values in shape.items()}
        depth[own] = largest_depths(grid, pure, some, largest[own])
        wrong[own] = ~compact_shapes(pure, some, depth[own])
    if not wrong.any():
        return
    first = int(np.flatnonzero(wrong)[0])
    here = _at(grid, {dim: index[first] for dim, index in places.items()})
    amplitude = grid.control.given_for("normal_amplitude")
    words = _at_rest_words(grid, here)
    words += f", {amplitude} = {as_number(here[amplitude]):g} {grid.row(amplitude).units}".rstrip()
    more = more_like_it(int(wrong.sum()))
    why = check_shape(numbers["pure"][first], {n: float(v[first]) for n, v in shape.items()}, depth[first])
    report.of(names or ("profile",), words + more, f"{why} (in a_H and δ0)")


def _largest(
    grid: PhysicalGrid, profile: Value, names: tuple[str, ...]
) -> tuple[dict[str, IndexArray], dict[str, Any], FloatArray]:
    """Places of the contacts of a profile, their shapes, tables and largest loads, of shape (n,)."""
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
    return places, numbers, largest
