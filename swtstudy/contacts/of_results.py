"""The contacts of results with units."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.archive.recall import grid_of
from swtstudy.contacts.contact import PhysicalContact
from swtstudy.mistakes import Mistake, StudyError
from swtstudy.units.grid import PhysicalGrid

if TYPE_CHECKING:
    import xarray as xr


def contact_of(dataset: xr.Dataset) -> PhysicalContact:
    """The contacts of results.

    Raises
    ------
    StudyError
        If they have no units, or what a contact needs has been dropped.
    """
    grid = grid_of(dataset)
    if not isinstance(grid, PhysicalGrid):
        raise StudyError([Mistake("units", "results without units", "those of a study with [units]")])
    return PhysicalContact(grid)
