"""The contacts of a grid at rest: what the scales of everything else are made of."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.values import Value, as_number
from swtstudy.units.at_rest import Contact
from swtstudy.units.moduli import Moduli
from swtstudy.units.scales import SCALES
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.families import family_of
from swtstudy.vocabulary.mistakes import StudyError

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
    from swtstudy.units.depth import depth_at, refuse_beyond

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
