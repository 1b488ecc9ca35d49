"""Results of real contacts: with units, and as the non-dimensional ones that they are computed as."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from swtstudy.units.blocks import miner
from swtstudy.units.bodies import LABELS
from swtstudy.units.scatter import scattered
from swtstudy.units.variables import KINDS, LIVES, NORMALISED, variables
from swtstudy.vocabulary.choices import SWT
from swtstudy.vocabulary.quantities import Request
from swtstudy.vocabulary.variables import CONTACT, has_units

if TYPE_CHECKING:
    from swtstudy.units.grid import PhysicalGrid


#: Facts that an archive has even where there are none; without others it stays as those of before.
_ALWAYS = ("pairs", "materials", "similar", "bulk_stress_body")


def is_uncounted(dataset: xr.Dataset, name: str) -> bool:
    """Return whether a data variable is a life for which no strain cycles have been counted."""
    return has_units(dataset) and name in LIVES and "counted" not in dataset


def measures(dataset: xr.Dataset) -> list[str]:
    """The values of the criteria of results with units, in their order; none without units."""
    criteria = np.atleast_1d(dataset["criterion"]) if "criterion" in dataset.coords else [SWT]
    names = dict.fromkeys(KINDS[str(each)].name for each in criteria)
    return [name for name in names if name in dataset]


def with_units(dataset: xr.Dataset, grid: PhysicalGrid, asked: Request) -> xr.Dataset:
    """Results of a grid of real contacts, with SWT, cycles and all that has a unit."""
    known = {old: new for old, new in NORMALISED.items() if old in dataset.data_vars}
    found = dataset.rename(known)
    for each in variables(grid, asked):
        values = each.values(found, grid)
        found[each.name] = values.dims, values.values, each.attributes(grid.labels)
    if grid.blocks:
        found = found.assign(miner(found, grid.blocks, grid.values("load")))
    if grid.scatter:
        found = found.assign(scattered(found, grid, [name for name in LIVES if name in found]))
    if "SWT" in found:
        found.SWT.attrs["ancillary_variables"] = "SWT_error regime"
    for name in grid.pairs:
        own = grid.of_body(name)
        found = found.assign_coords({name: (own.dims, own.values)})
        row = grid.row(name)
        found[name].attrs = {"long_name": row.meaning, "symbol": row.symbol, "units": row.units}
    if "body" in found.coords:
        found["body"] = found.body.astype(np.int64).assign_attrs(found.body.attrs | _named(grid))
    return found.assign_attrs({CONTACT: _text(grid)})


def _named(grid: PhysicalGrid) -> dict[str, Any]:
    """Attributes of the coordinate ``body`` that say what the bodies are called, as flags have it."""
    if not grid.body_names:
        return {}
    meanings = " ".join("_".join(name.split()) for name in grid.body_names)
    return {"flag_values": np.array(LABELS), "flag_meanings": meanings}


def without_units(dataset: xr.Dataset) -> xr.Dataset:
    """The data variables by the names of results without units."""
    taken = [old for old, new in NORMALISED.items() if new in dataset and old in dataset]
    known = {new: old for old, new in NORMALISED.items() if new in dataset}
    # That at the mean depth has the name of the quantity.
    others = [name for name in NORMALISED if name in dataset and name not in taken]
    return dataset.drop_vars([*taken, *others]).rename(known)


def _text(grid: PhysicalGrid) -> str:
    facts = asdict(grid.about)
    return json.dumps({name: value for name, value in facts.items() if value or name in _ALWAYS})
