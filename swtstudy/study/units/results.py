"""The door out: results of real contacts with units, and as the non-dimensional ones that they are."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from swtstudy.points.validity import index_words
from swtstudy.points.values import index_at
from swtstudy.study.units.life import Block, LifeCurve
from swtstudy.study.units.rows import LABELS, TABLES, Units
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, SWT
from swtstudy.vocabulary.derived import (
    DERIVED,
    FAILED,
    LIFE,
    LIVES,
    NORMALISED,
    PERCENTS,
    RANKS,
    REPETITIONS,
    SHARE,
)
from swtstudy.vocabulary.quantities import CONTACT, COUNTED, COUNTED_SIZES, Request, has_units
from swtstudy.vocabulary.wording import number_words, numbers_words

if TYPE_CHECKING:
    from swtstudy.study.units.at_rest import Contact
    from swtstudy.study.units.grid import PhysicalGrid
    from swtstudy.vocabulary.derived import Derived

#: Facts that an archive has even where there are none; others are left out then.
_ALWAYS = ("pairs", "materials", "similar", "bulk_stress_body")
#: More blocks than these are not named one by one.
MOST_BLOCKS = 6
#: Most lives in memory at once.
_AT_ONCE = 1_000_000
#: Comments of data variables by their kinds, and of lives without counted cycles.
COMMENTS: dict[str, str] = TABLES["comments"]


def scale_of(name: str, stresses: Sequence[float] = ()) -> Callable[[Contact, int], float]:
    """A property of a contact at rest as a scale of body 0 or 1, over a stress of each body if there are."""

    def scale(contact: Contact, body: int) -> float:
        found = getattr(contact, name)
        value: float = found(body) if callable(found) else found
        return value / stresses[body] if stresses else value

    return scale


def derived(grid: PhysicalGrid, asked: Request) -> Iterator[Derived]:
    """The data variables with units that a grid adds, in the words of its contacts."""
    known = {"", "s", "s_error", "critical_x", *asked.variables, *grid.margins}
    criteria = {"", *map(str, grid.values("criterion"))}
    words = {"radius": "half-width", "mean": "load"} if grid.plane else {"radius": "radius", "mean": "depth"}
    words["shear"] = " by shear constants" + " estimated from the tensile ones" * (not grid.shear_materials)
    words["target"] = number_words(grid.target_life)
    for row in DERIVED.values():
        given = not row.of and bool(grid.values(row.name)) and row.name != grid.of_loads
        lacks = bool(row.needs) and not any(getattr(grid, name) for name in row.needs)
        lacks |= row.kind in RANKS and not grid.scatters(row.criterion)
        given |= grid.plane and row.name == "depth"  # which a plane contact has not
        if row.of in known and row.criterion in criteria and not lacks and not given:
            known.add(row.name)
            yield row._replace(meaning=row.meaning.format(**words))


def attributes(row: Derived, labels: Units) -> dict[str, str]:
    """Attributes of a data variable with a unit."""
    return {"long_name": row.meaning, "units": labels.words(row.unit), "symbol": row.symbol}


def dims_of(grid: PhysicalGrid, asked: Request) -> dict[str, tuple[str, ...]]:
    """Names and dimensions of the data variables of a grid with units that one without does not have."""
    found = {new: grid.dims for old, new in NORMALISED.items() if old in asked.variables}
    for row in derived(grid, asked):
        of_points = (*grid.dims, *asked.variables.get(row.of, ())) if row.of else grid.at_rest_dims
        dims = found[row.of] if row.of in LIVES else of_points
        found[row.name] = tuple(dim for dim in dims if dim != "load" or not _is_of_sequence(row, grid))
    return found


def _is_of_sequence(row: Derived, grid: PhysicalGrid) -> bool:
    """True for a variable of a whole sequence of blocks, not of each load."""
    return REPETITIONS in row.name or (row.kind == FAILED and bool(grid.blocks))


def measures(dataset: xr.Dataset) -> list[str]:
    """The values of the criteria of results with units, in their order; none without units."""
    criteria = np.atleast_1d(dataset["criterion"]) if "criterion" in dataset.coords else [SWT]
    names = dict.fromkeys(CRITERIA[str(each)].name for each in criteria)
    return [name for name in names if name in dataset]


def usual_measure(dataset: xr.Dataset) -> str:
    """The value of the criterion of results with units; s without units, and where criteria are several."""
    own = measures(dataset)
    return own[0] if len(own) == 1 else "s"


def with_units(dataset: xr.Dataset, grid: PhysicalGrid, asked: Request) -> xr.Dataset:
    """Results of a grid of real contacts, with SWT, lives and all that has a unit."""
    found = dataset.rename({old: new for old, new in NORMALISED.items() if old in dataset.data_vars})
    ranks: dict[tuple[str, bool], xr.DataArray] = {}
    for row in derived(grid, asked):
        if row.kind in (REPETITIONS, SHARE):
            values = _of_blocks(found[row.of], row.kind, grid)
        elif row.kind in RANKS:
            key = row.of, _is_of_sequence(row, grid)
            if key not in ranks:
                kind = CRITERIA[row.criterion]
                of = found[f"{kind.name}{row.of.removeprefix(kind.life)}"]
                if key[1]:  # all loads together
                    of = (of if "load" in of.dims else of.expand_dims("load")).transpose(..., "load")
                ranks[key] = _of_constants(of, grid, found, row.criterion, drawn=True, in_turn=key[1])
            values = ranks[key].isel(rank=RANKS.index(row.kind))
        else:
            stresses = getattr(grid, row.needs[0]) if row.needs and row.kind != LIFE else ()
            scale = grid.of_bodies(scale_of(row.scale, stresses))
            values = found[NORMALISED.get(row.of, row.of)] * scale if row.of else xr.DataArray(scale)
            if row.criterion and grid.dimension("criterion") is not None:  # NaN at points of others
                is_own = np.array([value == row.criterion for value in grid.values("criterion")])
                values = values.where(grid.over_dimension("criterion", is_own))
            if row.kind == LIFE:
                values = _of_constants(values, grid, found, row.criterion, drawn=False)
        words: dict[str, Any] = attributes(row, grid.labels)
        comment = "uncounted" if row.kind == LIFE and not asked.counts else row.kind
        words |= {"comment": COMMENTS[comment]} if comment in COMMENTS else {}
        found[row.name] = values.dims, values.values, words
    if "SWT" in found:
        found.SWT.attrs["ancillary_variables"] = "SWT_error regime"
    for name in grid.pairs:
        own, parameter = grid.of_body(name), grid.row(name)
        words = {"long_name": parameter.meaning, "symbol": parameter.symbol, "units": parameter.units}
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
    if not has_units(dataset):
        return dataset
    known = {new: old for old, new in NORMALISED.items() if new in dataset}
    # The variable with a unit goes where two have one name; at the mean depth it has the quantity's name.
    return dataset.drop_vars([name for name in NORMALISED if name in dataset]).rename(known)


def _of_constants(
    value: xr.DataArray,
    grid: PhysicalGrid,
    dataset: xr.Dataset,
    criterion: str,
    drawn: bool,
    in_turn: bool = False,
) -> xr.DataArray:
    """Lives at values of a criterion, or ranks of lives, by the constants of each body.

    Parameters
    ----------
    value
        SWT, or a Fatemi–Socie parameter, or a mean of it.
    grid, dataset
        The contacts, and their results with counted cycles.
    criterion
        The name of the criterion.
    drawn
        True for the ranks of the lives by each draw of constants.
    in_turn
        True for ranks of repetitions of the sequence of blocks, instead of rounds of each load; the loads are
        the last dimension.

    Returns
    -------
    DataArray
        Of the value's shape, with the ranks before it if there are, and without the loads in turn.
    """
    value = value.clip(min=0.0)  # means that are below 0 by rounding
    names = COUNTED if COUNTED.keys() <= {*dataset.data_vars} else ()
    shares = [dataset[n].broadcast_like(value).transpose(*value.dims, *COUNTED_SIZES) for n in names]
    is_first = (xr.ones_like(value, bool) & (grid.bodies == 0)).transpose(*value.dims)
    both, dim = grid.of_both("poisson_ratio"), grid.dimension("poisson_ratio")
    # Estimated constants differ from one Poisson ratio to another.
    several = len({grid.constants(criterion, ratios) for ratios in both}) > 1
    rounds, parts = _rounds(grid) if in_turn else None, []
    for k, ratios in enumerate(both if several else both[:1]):
        at = {dim: [k]} if several else {}
        first, own, *counted = (each.isel(at).values for each in (is_first, value, *shares))
        one, other = grid.curves(criterion, ratios, drawn)
        of_bodies = [
            _ranks(curve, own, counted, grid.target_life, rounds) if drawn else curve.lives(own, counted)
            for curve in ([one] if np.array_equal(one, other) else [one, other])
        ]
        parts.append(np.where(first[..., 0] if in_turn else first, of_bodies[0], of_bodies[-1]))
    found = np.concatenate(parts, drawn + value.get_axis_num(dim)) if several else parts[0]
    return xr.DataArray(found, dims=(*("rank",) * drawn, *value.dims[: len(value.dims) - in_turn]))


def _of_blocks(life: xr.DataArray, kind: str, grid: PhysicalGrid) -> xr.DataArray:
    """Repetitions of a sequence of blocks to a crack, or the share of each load in its damage.

    D = Σ n_k / N_k, with n_k rounds of load k in the sequence and N_k rounds of it alone to a crack.
    """
    numbers, several = _rounds(grid), "load" in life.dims
    damage = 1.0 / life * (xr.DataArray(numbers, dims="load") if several else numbers[0])
    whole = damage.sum("load", skipna=False) if several else damage
    return 1.0 / whole if kind == REPETITIONS else damage / whole


def _rounds(grid: PhysicalGrid) -> FloatArray:
    """Rounds of each load in a repetition of the sequence of blocks."""
    names = map(str, grid.values("load"))
    return np.array([sum(each.rounds for each in grid.blocks if each.load == name) for name in names])


def sequence_words(dataset: xr.Dataset, blocks: Sequence[Block]) -> str:
    """Say how often a sequence is repeated to a crack, and which load does most of the damage.

    By each criterion that has lives, at the worst place, and by the mean over a volume where that is known;
    empty if there are none.
    """
    rounds = ", ".join(f"{number_words(each.rounds)} of {each.load}" for each in blocks)
    if len(blocks) > MOST_BLOCKS:
        rounds = f"{len(blocks)}, the first of {blocks[0].load}"
    several = []
    for row in CRITERIA.values() if rounds else ():
        start = row.life.removesuffix(LIFE)
        if not row.life or f"{start}{REPETITIONS}" not in dataset:
            continue
        times, shares, by = dataset[f"{start}{REPETITIONS}"], dataset[f"{start}{SHARE}"], row.by
        if "criterion" in times.dims:  # points of other criteria do not have it
            times = times.dropna("criterion", how="all")
            shares = shares.sel(criterion=times.criterion)
        known = times.values[np.isfinite(times.values)]
        if not known.size:
            several.append(f"no crack{by}")
            continue
        words = f"repeated {_ends(known)} times to a crack{by}"
        means = dataset.get(f"{start}{REPETITIONS}_volume", xr.DataArray([])).values
        if np.isfinite(means).any():
            words += f" (worst point), {_ends(means[np.isfinite(means)])} (mean over a volume)"
        if lost := times.size - known.size:
            words += f", unknown at {lost} of {times.size} points"
        place = index_at(times, int(np.nanargmin(times.values)))
        if (share := shares.isel(place)).ndim:
            most = share[int(share.values.argmax())]
            words += f"; {most.coords['load'].item()} does {float(most):.0%} of the damage"
            place.pop("criterion", None)
            words += f" at {where}" if (where := index_words(dataset, place)) else ""
        several.append(words)
    if not several:
        return ""
    return f"{rounds}{':' if several[0].startswith('no crack') else ','} {'; '.join(several)}"


def _ends(values: FloatArray) -> str:
    """The least and the largest of some numbers, in words."""
    return " to ".join(dict.fromkeys(numbers_words((values.min(), values.max()), 2)))


def _ranks(
    curve: LifeCurve, values: FloatArray, counted: list[FloatArray], target: float, rounds: FloatArray | None
) -> FloatArray:
    """Percentiles of lives over n draws, and the share of them below a target last, shape (4, ...).

    With the rounds of loads, the last dimension of the values, lives are repetitions of them all. The target
    is in rounds.
    """
    together = 1 if rounds is None else len(rounds)
    flat = values.reshape(-1, together)
    of_each = [each.reshape(*flat.shape, *each.shape[-2:]) for each in counted]
    found = np.full((len(PERCENTS) + 1, len(flat)), np.nan)
    cycles = of_each[0][0].size if of_each else together
    goal = target if rounds is None else target / rounds.sum()
    size = max(1, _AT_ONCE // (len(curve.level) * cycles))
    for begin in range(0, len(flat), size):  # in parts of the points, so that memory is bounded
        part = slice(begin, begin + size)
        known = np.isfinite(flat[part]).all(axis=1)
        own = [number[part][known].reshape(-1, *number.shape[-2:]) for number in of_each]
        each = curve.lives(flat[part][known].ravel(), own)
        if rounds is not None:
            damage = (rounds / each.reshape(len(each), -1, together)).sum(axis=-1)
            each = np.divide(1.0, damage, out=np.full_like(damage, np.inf), where=damage > 0.0)
        # Without interpolation: a life may be infinite.
        ranks = np.quantile(each, np.array(PERCENTS) / 100.0, axis=0, method="inverted_cdf")
        found[:, np.flatnonzero(known) + begin] = [*ranks, (each < goal).mean(axis=0)]
    return found.reshape(-1, *(values.shape if rounds is None else values.shape[:-1]))
