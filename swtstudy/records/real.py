"""Results of real contacts: with units, and as the non-dimensional ones that they are computed as."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.mistakes import literal
from swtstudy.quantities import Request
from swtstudy.units.blocks import Block, miner
from swtstudy.units.bodies import LABELS
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.labels import KINDS, Units
from swtstudy.units.life import FatigueConstants
from swtstudy.units.reading import Given
from swtstudy.units.rows import OF_BODIES
from swtstudy.units.variables import LIVES, NORMALISED, variables

#: The attribute of a Dataset that says what its coordinates do not say of its contacts.
ATTRIBUTE = "contact"


def is_real(dataset: xr.Dataset) -> bool:
    """Whether results are those of real contacts."""
    return ATTRIBUTE in dataset.attrs


def is_uncounted(dataset: xr.Dataset, name: str) -> bool:
    """Whether a data variable is a life for which no strain cycles have been counted."""
    return is_real(dataset) and name in LIVES and "counted" not in dataset


def with_units(dataset: xr.Dataset, grid: PhysicalGrid, asked: Request) -> xr.Dataset:
    """Results of a grid of real contacts, with SWT, cycles and all that has a unit."""
    known = {old: new for old, new in NORMALISED.items() if old in dataset.data_vars}
    found = dataset.rename(known)
    for each in variables(grid, asked):
        values = each.values(found, grid)
        found[each.name] = values.dims, values.values, each.attributes(grid.labels)
    if grid.blocks:
        found = found.assign(miner(found, grid.blocks, grid.values("load")))
    if "SWT" in found:
        found.SWT.attrs["ancillary_variables"] = "SWT_error regime"
    for name in grid.pairs:
        own = grid.of_body(name)
        found = found.assign_coords({name: (own.dims, own.values)})
        row = grid.row(name)
        found[name].attrs = {"long_name": row.meaning, "symbol": row.symbol, "units": row.units}
    if "body" in found.coords:
        found["body"] = found.body.astype(np.int64).assign_attrs(found.body.attrs)
    return found.assign_attrs({ATTRIBUTE: _text(grid)})


def without_units(dataset: xr.Dataset) -> xr.Dataset:
    """The data variables by the names of results without units."""
    taken = [old for old, new in NORMALISED.items() if new in dataset and old in dataset]
    known = {new: old for old, new in NORMALISED.items() if new in dataset}
    # That at the mean depth has the name of the quantity.
    others = [name for name in NORMALISED if name in dataset and name not in taken]
    return dataset.drop_vars([*taken, *others]).rename(known)


def _text(grid: PhysicalGrid) -> str:
    return json.dumps(
        {
            "units": asdict(grid.units),
            "pairs": dict(grid.pairs),
            "materials": [asdict(each) for each in grid.materials],
            "similar": grid.similar,
            "bulk_stress_body": grid.bulk_stress_body,
            **({"blocks": [asdict(each) for each in grid.blocks]} if grid.blocks else {}),
        }
    )


def read_contact(text: object) -> tuple[Given, dict[str, tuple[float, float]]]:
    """What the attribute says: see `swtstudy.units.grid.PhysicalGrid`.

    Raises
    ------
    ValueError
        With the reason, if it cannot be read.
    """
    try:
        raw: Any = json.loads(str(text))
    except RecursionError:
        raise ValueError("nested too deeply") from None
    try:
        units = Units(**{kind: str(raw["units"][kind]) for kind in KINDS})
        pairs = {name: (float(two[0]), float(two[1])) for name, two in raw["pairs"].items()}
        materials = tuple(FatigueConstants(**each) for each in raw["materials"])
        blocks = tuple(Block(str(each["load"]), float(each["rounds"])) for each in raw.get("blocks", ()))
        given = Given(units, materials, float(raw["similar"]), int(raw["bulk_stress_body"]), blocks)
    except (KeyError, TypeError, IndexError, AttributeError, OverflowError) as error:
        raise ValueError(f"not a contact: {literal(raw)} ({error})") from None
    if not pairs.keys() <= {*OF_BODIES} or len(materials) not in (0, len(LABELS)):
        raise ValueError(f"not a contact: {literal(raw)}")
    return given, pairs
