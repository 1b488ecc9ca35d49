"""The door out: results of real contacts with units, and as the non-dimensional ones that they are."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from swtstudy.points.values import index_at
from swtstudy.units.life import ROUNDS, UNCOUNTED, Block, FatigueConstants, ShearConstants, lives
from swtstudy.units.rows import LABELS
from swtstudy.units.variables import (
    FAILED,
    KINDS,
    LIFE,
    LIVES,
    NORMALISED,
    PERCENTS,
    REPETITIONS,
    SHARE,
    STARTS,
    lives_in,
    variables,
)
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import FATEMI_SOCIE, SWT
from swtstudy.vocabulary.quantities import COUNTED, COUNTED_SIZES, Request
from swtstudy.vocabulary.variables import CONTACT, has_units
from swtstudy.vocabulary.wording import number_words, numbers_words

if TYPE_CHECKING:
    from swtstudy.units.grid import PhysicalGrid

#: Facts that an archive has even where there are none; others are left out then.
_ALWAYS = ("pairs", "materials", "similar", "bulk_stress_body")
#: Most lives in memory at once.
_AT_ONCE = 1_000_000


def is_uncounted(dataset: xr.Dataset, name: str) -> bool:
    """Return whether a data variable is a life for which no strain cycles have been counted."""
    return has_units(dataset) and name in LIVES and "counted" not in dataset


def measures(dataset: xr.Dataset) -> list[str]:
    """The values of the criteria of results with units, in their order; none without units."""
    criteria = np.atleast_1d(dataset["criterion"]) if "criterion" in dataset.coords else [SWT]
    names = dict.fromkeys(KINDS[str(each)].name for each in criteria)
    return [name for name in names if name in dataset]


def with_units(dataset: xr.Dataset, grid: PhysicalGrid, asked: Request) -> xr.Dataset:
    """Results of a grid of real contacts, with SWT, lives and all that has a unit."""
    found = dataset.rename({old: new for old, new in NORMALISED.items() if old in dataset.data_vars})
    of_lives = {"comment": ROUNDS if asked.counts else UNCOUNTED}
    for each in variables(grid, asked):
        values = each.scale(grid)
        if each.of:
            values = found[NORMALISED.get(each.of, each.of)] * values
        if each.criterion and grid.dimension("criterion") is not None:
            is_own = np.array([value == each.criterion for value in grid.values("criterion")])
            values = values.where(grid.over_dimension("criterion", is_own))
        if each.is_life:
            values = _lives(values, grid, found, each.criterion)
        label = "1" if each.kind == "1" else grid.labels.label(each.kind) or f"unit of {each.kind}"
        words: dict[str, Any] = {"long_name": each.meaning, "units": label, "symbol": each.symbol}
        found[each.name] = values.dims, values.values, words | (of_lives if each.is_life else {})
    if grid.blocks:
        found = found.assign(_of_blocks(found, grid.blocks, grid.values("load")))
    if grid.scatter:
        found = found.assign(_of_scatter(found, grid))
    if "SWT" in found:
        found.SWT.attrs["ancillary_variables"] = "SWT_error regime"
    for name in grid.pairs:
        own, row = grid.of_body(name), grid.row(name)
        words = {"long_name": row.meaning, "symbol": row.symbol, "units": row.units}
        found = found.assign_coords({name: (own.dims, own.values, words)})
    if "body" in found.coords:
        words = {**found.body.attrs}
        if grid.body_names:  # as flags have it
            meanings = " ".join("_".join(name.split()) for name in grid.body_names)
            words |= {"flag_values": np.array(LABELS), "flag_meanings": meanings}
        found["body"] = found.body.astype(np.int64).assign_attrs(words)
    facts = {name: value for name, value in asdict(grid.about).items() if value or name in _ALWAYS}
    return found.assign_attrs({CONTACT: json.dumps(facts)})


def without_units(dataset: xr.Dataset) -> xr.Dataset:
    """The data variables by the names of results without units."""
    known = {new: old for old, new in NORMALISED.items() if new in dataset}
    # Of two with one name that with a unit goes; at the mean depth it has the name of the quantity.
    return dataset.drop_vars([name for name in NORMALISED if name in dataset]).rename(known)


def _lives(value: xr.DataArray, grid: PhysicalGrid, dataset: xr.Dataset, criterion: str) -> xr.DataArray:
    """Rounds to a crack at SWT, or at a Fatemi–Socie parameter, of strain cycles if they are counted."""
    value = value.clip(min=0.0)  # means that are below 0 by rounding
    counted = dataset[[name for name in COUNTED if name in dataset.data_vars]]
    both: list[tuple[FatigueConstants | ShearConstants, ...]] = [grid.materials]
    if criterion == FATEMI_SOCIE:
        both = [grid.shear_materials]
        if not grid.shear_materials:
            estimated = ShearConstants.estimated
            both = [tuple(map(estimated, grid.materials, ratios)) for ratios in grid.of_both("poisson_ratio")]
    dim = grid.dimension("poisson_ratio") or ""
    if len(both) == 1:
        return _of_bodies(value, counted, grid.bodies, both[0])
    parts = []
    for k, constants in enumerate(both):  # estimated ones differ from one Poisson ratio to another
        at: dict[str, Any] = {"indexers": {dim: [k]}, "missing_dims": "ignore"}
        parts.append(_of_bodies(value.isel(**at), counted.isel(**at), grid.bodies.isel(**at), constants))
    return xr.concat(parts, dim).transpose(*value.dims)


def _of_bodies(
    value: xr.DataArray,
    counted: xr.Dataset,
    bodies: xr.DataArray,
    constants: Sequence[FatigueConstants | ShearConstants],
) -> xr.DataArray:
    """Rounds to a crack by the constants of each body."""
    if len(counted) == len(COUNTED):
        one, two = (each.rounds(value, *(counted[name] for name in COUNTED)) for each in constants)
    else:
        one, two = (value.copy(data=each.cycles(value.values)) for each in constants)
    return one.where(bodies == 0, two) if bodies.ndim else (one, two)[int(bodies)]


#: Comments of what blocks make of lives.
_REPEATED = (
    "repetitions of the sequence of blocks to the initiation of a crack, by Miner's sum of their damage, "
    "each at its own worst place: where these differ, the life is longer"
)
_SHARED = "share of a load's rounds in the damage of a repetition of the sequence of blocks"


def _of_blocks(dataset: xr.Dataset, blocks: Sequence[Block], loads: Sequence[Any]) -> dict[str, xr.DataArray]:
    """Repetitions of a sequence to a crack, and the share of each load in its damage, for every life.

    D = Σ n_k / N_k, with n_k rounds of load k in the sequence and N_k rounds of it alone to a crack.
    """
    numbers = [sum(each.rounds for each in blocks if each.load == str(load)) for load in loads]
    found = {}
    for name, repetitions, share in lives_in(list(map(str, dataset.data_vars))):
        life, several = dataset[name], "load" in dataset[name].dims
        damage = 1.0 / life * (xr.DataArray(numbers, dims="load") if several else numbers[0])
        whole = damage.sum("load", skipna=False) if several else damage
        where = life.attrs["long_name"].removeprefix("rounds to a crack")
        below = ", ".join(filter(None, ("seq", *(part.strip("_") for part in name.split(LIFE)))))
        for made, values, meaning, symbol, comment in (
            (repetitions, 1.0 / whole, "repetitions to a crack", rf"N_\mathrm{{{below}}}", _REPEATED),
            (share, damage / whole, "share of the damage", "D_k/D", _SHARED),
        ):
            words = {"long_name": f"{meaning}{where}", "units": "1", "symbol": symbol, "comment": comment}
            found[made] = values.drop_attrs().assign_attrs(words)
    return found


def sequence_words(dataset: xr.Dataset, blocks: Sequence[Block]) -> str:
    """Say how often a sequence is repeated to a crack, and which load does most of the damage.

    By each criterion that has lives, without means over a critical distance, at the worst place; empty if
    there are none.
    """
    rounds = ", ".join(f"{number_words(each.rounds)} of {each.load}" for each in blocks)
    several = []
    for start, by in STARTS.items() if rounds else ():
        if f"{start}{REPETITIONS}" not in dataset:
            continue
        times, shares = dataset[f"{start}{REPETITIONS}"], dataset[f"{start}{SHARE}"]
        if "criterion" in times.dims:  # points of other criteria do not have it
            times = times.dropna("criterion", how="all")
            shares = shares.sel(criterion=times.criterion)
        known = times.values[np.isfinite(times.values)]
        if not known.size:
            several.append(f"no crack{by}")
            continue
        ends = dict.fromkeys(numbers_words((known.min(), known.max()), 2))
        words = f"repeated {' to '.join(ends)} times to a crack{by}"
        if lost := times.size - known.size:
            words += f", unknown at {lost} of {times.size} points"
        share = shares.isel(index_at(times, int(np.nanargmin(times.values))))
        if share.ndim:
            most = share[int(share.values.argmax())]
            words += f"; {most.coords['load'].item()} does {float(most):.0%} of the damage"
        several.append(words)
    if not several:
        return ""
    return f"{rounds}{':' if several[0].startswith('no crack') else ','} {'; '.join(several)}"


def _of_scatter(dataset: xr.Dataset, grid: PhysicalGrid) -> dict[str, Any]:
    """Percentiles of lives, and failure probabilities, over the draws of a grid's constants.

    Parameters
    ----------
    dataset
        Results with SWT, its means, and counted strain cycles, if these are counted.
    grid
        Its contacts, with their scatter.

    Returns
    -------
    dict
        Dimensions, values and attributes by name.
    """
    scatter = grid.scatter
    assert scatter is not None
    found: dict[str, Any] = {}
    for name in (name for name in LIVES if name in dataset and name.startswith(LIFE)):
        end, words = name.removeprefix(LIFE), dataset[name].attrs
        values, counted = dataset[f"SWT{end}"], []
        if {*COUNTED} <= {*map(str, dataset.data_vars)}:
            dims = (*values.dims, *COUNTED_SIZES)
            counted = [dataset[each].broadcast_like(values).transpose(*dims).values for each in COUNTED]
        of_each = [
            _ranks(values.values, counted, *scatter.terms(constants), scatter.target)
            for constants in dict.fromkeys(grid.materials)
        ]
        first = xr.zeros_like(values, bool) | (grid.bodies == 0)
        ranks = np.where(first.transpose(*values.dims), of_each[0], of_each[-1])
        symbol = words["symbol"].removeprefix("N").removeprefix(r"_\mathrm{").removesuffix("}")
        for percent, each in zip(PERCENTS, ranks, strict=False):
            below = ", ".join(filter(None, (symbol, str(percent))))
            meaning = f"{words['long_name']}, before which {percent} % fail"
            own = {"long_name": meaning, "symbol": rf"N_\mathrm{{{below}}}", "units": "1"}
            found[f"{name}_{percent}"] = values.dims, each, own
        if scatter.target:
            meaning = f"probability of a crack before {number_words(scatter.target)} load cycles"
            own = {"long_name": meaning, "symbol": rf"P_\mathrm{{{symbol}}}" if symbol else "P", "units": "1"}
            found[f"{FAILED}{end}"] = values.dims, ranks[-1], own
    return found


def _ranks(
    values: FloatArray, counted: list[FloatArray], level: FloatArray, slopes: FloatArray, target: float
) -> FloatArray:
    """Percentiles of lives over n draws, and the share of them below a target last, shape (4, ...)."""
    flat = values.ravel()
    of_each = [each.reshape(len(flat), *each.shape[-2:]) for each in counted]
    found = np.full((len(PERCENTS) + 1, len(flat)), np.nan)
    size = max(1, _AT_ONCE // (len(level) * (of_each[0][0].size if of_each else 1)))
    for begin in range(0, len(flat), size):  # in parts of the points, so that memory is bounded
        part = slice(begin, begin + size)
        known = np.isfinite(flat[part])
        each = lives(level, slopes, flat[part][known], *(number[part][known] for number in of_each))
        # Without interpolation: a life may be infinite.
        ranks = np.quantile(each, np.array(PERCENTS) / 100.0, axis=0, method="inverted_cdf")
        found[:, np.flatnonzero(known) + begin] = [*ranks, (each < target).mean(axis=0)]
    return found.reshape(-1, *values.shape)
