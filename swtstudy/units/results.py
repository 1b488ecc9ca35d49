"""The door out: results of real contacts with units, and as the non-dimensional ones that they are."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import xarray as xr

from swtstudy.points.values import index_at
from swtstudy.units.life import ROUNDS, UNCOUNTED, Block, FatigueConstants, ShearConstants, lives
from swtstudy.units.rows import LABELS
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, FATEMI_SOCIE, FINDLEY, SWT
from swtstudy.vocabulary.quantities import (
    COUNTED,
    COUNTED_SIZES,
    NONLOCAL,
    STICK_ENDS,
    YIELD,
    Request,
    error_of,
)
from swtstudy.vocabulary.variables import CONTACT, has_units
from swtstudy.vocabulary.wording import number_words, numbers_words

if TYPE_CHECKING:
    from swtstudy.units.at_rest import Contact
    from swtstudy.units.grid import PhysicalGrid

#: Names without units, for variables that have units in a study with units.
_OF_QUANTITIES = ("dissipation", "dissipation_error", "stick_radius", "contact_radius", YIELD, "bulk_shift")
NORMALISED = {name: f"normalised_{name}" for name in (*_OF_QUANTITIES, *STICK_ENDS)}
#: Nonlocal quantities that are swt, and nonlocal quantities that are places.
MEANS = tuple(name for name, row in NONLOCAL.items() if not row.is_place)
PLACES = tuple(name for name, row in NONLOCAL.items() if row.is_place)
#: Per cent of the bodies that have a crack before the life of that name.
PERCENTS = (10, 50, 90)
#: Facts that an archive has even where there are none; others are left out then.
_ALWAYS = ("pairs", "materials", "similar", "bulk_stress_body")
#: Most lives in memory at once.
_AT_ONCE = 1_000_000
#: Names that replace ``cycles``: of the life under blocks, and of its scatter.
REPETITIONS, SHARE, LIFE, FAILED = "repetitions", "damage_share", "cycles", "failure_probability"
#: Prefixes of these names, and the criterion of each in words.
STARTS = {"": "", "FS_": " by Fatemi and Socie"}
#: Comments of what blocks make of lives.
_REPEATED = (
    "repetitions of the sequence of blocks to the initiation of a crack, by Miner's sum of their damage, "
    "each at its own worst place: where these differ, the life is longer"
)
_SHARED = "share of a load's rounds in the damage of a repetition of the sequence of blocks"


class Variable(NamedTuple):
    """One data variable.

    Attributes
    ----------
    name, symbol, meaning
        As of a `swtstudy.vocabulary.quantities.Quantity`.
    kind
        "length", "force", "stress", "work", or "1".
    of
        The data variable that it is made of, by its name without units; empty for what a contact at rest has.
    scale
        The factor of the variable, or the contact's own value, for body 0 or 1.
    criterion
        Its criteria; empty for a variable of every criterion.
    is_life
        Whether it is the life at that.
    """

    name: str
    symbol: str
    meaning: str
    kind: str
    of: str
    scale: Callable[[Contact, int], float]
    criterion: str = ""
    is_life: bool = False


class Kind(NamedTuple):
    """Names and words that s of a criterion has with units.

    Attributes
    ----------
    criterion, name, symbol
        Its name, the variable's name and its symbol.
    unit
        "stress", or "1".
    scale
        Over s, of a contact and a body, 0 or 1.
    life, life_symbol
        Name and index of the life at this value; empty where there is none.
    """

    criterion: str
    name: str
    symbol: str
    unit: str
    scale: Callable[[Contact, int], float]
    life: str = ""
    life_symbol: str = ""


def _swt(contact: Contact, body: int) -> float:
    return contact.swt_scale * contact.moduli.swt_share(body)


def _strain(contact: Contact, body: int) -> float:
    return contact.stress_scale / contact.moduli.shear[body]


def _of(name: str) -> Callable[[Contact, int], float]:
    """A property of a contact at rest as a scale, the same for both bodies."""
    return lambda contact, _: getattr(contact, name)


def _over(stresses: Sequence[float]) -> Callable[[Contact, int], float]:
    """The unit of stress over a stress of each body."""
    return lambda contact, body: contact.stress_scale / stresses[body]


#: By criterion.
KINDS = {
    kind.criterion: kind
    for kind in (
        Kind(SWT, "SWT", r"\mathrm{SWT}", "stress", _swt, "cycles"),
        Kind(FATEMI_SOCIE, "FS", r"\mathrm{FS}", "1", _strain, "FS_cycles", "FS"),
        Kind(FINDLEY, "findley_stress", "f", "stress", _of("stress_scale")),
    )
}
#: Scales by kind of unit, where a contact gives the scales.
_SCALES = {"length": _of("length_scale"), "stress": _of("stress_scale"), "work": _of("work_scale")}


def variables(grid: PhysicalGrid, asked: Request) -> Iterator[Variable]:
    """The data variables with units that a grid has, beside those without."""
    criteria = {*map(str, grid.values("criterion"))}
    for kind in (kind for kind in KINDS.values() if kind.criterion in criteria):
        for name in ("s", *(name for name in MEANS if name in asked.variables)):
            yield from _of_criterion(kind, name, grid)
    radius, mean = ("half-width", "load") if grid.plane else ("radius", "depth")
    sides = {name: name.removeprefix("stick_") for name in STICK_ENDS}
    known = {"critical_x", *asked.variables, *grid.margins}
    work, largest = "work of friction in a cycle", r"a_\mathrm{max}"
    for of, name, symbol, meaning, unit in (
        ("critical_x", "critical_position", "x", "position of the critical point", "length"),
        *((place, position_of(place), "x", NONLOCAL[place].meaning, "length") for place in PLACES),
        ("dissipation", "dissipation", "W", work, "work"),
        ("dissipation_error", "dissipation_error", r"\Delta W", f"error of {work}", "work"),
        ("stick_radius", "stick_radius", "c", f"{radius} that always sticks", "length"),
        *(
            (end, end, rf"x_\mathrm{{{side}}}", f"{side} end of what always sticks", "length")
            for end, side in sides.items()
        ),
        ("contact_radius", "largest_contact_radius", largest, f"largest contact {radius}", "length"),
        ("bulk_shift", "bulk_shift", "e", "shift of the stick zone by the bulk strain", "length"),
        (YIELD, YIELD, r"\sigma_\mathrm{v}", "largest von Mises stress", "stress"),
    ):
        if of in known:
            yield Variable(name, symbol, meaning, unit, of, _SCALES[unit])
    if YIELD in known and grid.yield_strengths:
        symbol, over = r"\sigma_\mathrm{v}/\sigma_\mathrm{y}", _over(grid.yield_strengths)
        meaning = "largest von Mises stress over the yield strength"
        yield Variable("yield_ratio", symbol, meaning, "1", YIELD, over)
    for name, symbol, meaning, unit in (
        ("contact_radius", "a_0", f"contact {radius} at the mean {mean}", "length"),
        ("peak_pressure", "p_0", f"largest pressure at the mean {mean}", "stress"),
        ("depth", r"\delta_0", f"mean indentation {mean}", "length"),
        ("normal_force", "F_0", f"normal force at the mean {mean}", "force"),
    ):
        given = grid.values(name) and name != grid.of_loads
        if not given and not (grid.plane and name == "depth"):
            yield Variable(name, symbol, meaning, unit, "", _of(name))


def _of_criterion(kind: Kind, name: str, grid: PhysicalGrid) -> Iterator[Variable]:
    """The value of s or of a mean, its error, and its life or its usage of a limit, if these are known."""
    end = name.removeprefix("s")
    place, words = end.removeprefix("_"), end.replace("_", " ")
    meaning = CRITERIA[kind.criterion].values + words
    symbol = kind.symbol + rf"_\mathrm{{{place}}}" * bool(place)
    own: dict[str, Any] = {"of": name, "scale": kind.scale, "criterion": kind.criterion}
    yield Variable(f"{kind.name}{end}", symbol, meaning, kind.unit, **own)
    if kind.criterion == FINDLEY and grid.findley_limits:
        usage, over = own | {"scale": _over(grid.findley_limits)}, rf"{symbol}/f_\mathrm{{lim}}"
        yield Variable(f"findley_usage{end}", over, f"{meaning} over its limit", "1", **usage)
    if kind.life and (grid.materials or (grid.shear_materials and kind.criterion == FATEMI_SOCIE)):
        by = ""
        if kind.criterion == FATEMI_SOCIE:
            by = " by shear constants" + " estimated from the tensile ones" * (not grid.shear_materials)
        index = ", ".join(filter(None, (kind.life_symbol, place)))
        below = rf"N_\mathrm{{{index}}}" if index else "N"
        yield Variable(f"{kind.life}{end}", below, f"rounds to a crack{words}{by}", "1", **own, is_life=True)
    error, own["of"] = error_of(f"{kind.name}{end}"), error_of(name)
    yield Variable(error, rf"\Delta {symbol}", f"error of {meaning}", kind.unit, **own)


def position_of(place: str) -> str:
    """Name of a place with a unit."""
    return f"{place.removesuffix('_x')}_position"


def lives_in(names: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """The lives among data variables, and the names of what blocks make of each."""
    for name in names:
        start, life, end = name.partition(LIFE)
        if life and start in STARTS and end[:1] in ("", "_"):
            yield name, f"{start}{REPETITIONS}{end}", f"{start}{SHARE}{end}"


def scattered_in(names: Sequence[str], target: bool = True) -> Iterator[tuple[str, str]]:
    """Each life by tension among names, with the name of a variable that scatter adds to it."""
    for name in (name for name in names if name.startswith(LIFE)):
        yield from ((name, f"{name}_{percent}") for percent in PERCENTS)
        yield from [(name, f"{FAILED}{name.removeprefix(LIFE)}")] * target


def dims_of(grid: PhysicalGrid, asked: Request) -> dict[str, tuple[str, ...]]:
    """Names and dimensions of the data variables of a grid with units that one without does not have."""
    found = {new: grid.dims for old, new in NORMALISED.items() if old in asked.variables}
    for each in variables(grid, asked):
        found[each.name] = (*grid.dims, *asked.variables.get(each.of, ())) if each.of else grid.at_rest_dims
    for life, repetitions, share in lives_in([*found]) if grid.blocks else ():
        found[share] = found[life]
        found[repetitions] = tuple(dim for dim in found[life] if dim != "load")
    lives = [name for name in LIVES if name in found]
    for life, name in scattered_in(lives, grid.scatter.target > 0.0) if grid.scatter else ():
        found[name] = found[life]
    return found


_ENDS = tuple(name.removeprefix("s") for name in ("s", *MEANS))
#: Names of all lives that there may be, and of all that there may be.
LIVES = tuple(f"{kind.life}{end}" for kind in KINDS.values() if kind.life for end in _ENDS)
_VALUES = [f"{name}{end}" for name in (kind.name for kind in KINDS.values()) for end in _ENDS]
NAMES = (
    *(*_VALUES, *map(error_of, _VALUES), *map(position_of, PLACES), *LIVES),
    *(f"findley_usage{end}" for end in _ENDS),
    *(name for _, *both in lives_in(LIVES) for name in both),
    *(name for _, name in scattered_in(LIVES)),
    *("critical_position", "peak_pressure", "depth", "normal_force", "largest_contact_radius", "yield_ratio"),
    *(*NORMALISED, *NORMALISED.values()),
)


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
        values = grid.of_bodies(each.scale)
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
    # The variable with a unit goes where two have one name; at the mean depth it has the quantity's name.
    return dataset.drop_vars([name for name in NORMALISED if name in dataset]).rename(known)


def _counted_in(dataset: xr.Dataset) -> list[xr.DataArray]:
    """The counted strain cycles of results; none unless they are counted."""
    known = {*COUNTED} <= {*map(str, dataset.data_vars)}
    return [dataset[name] for name in COUNTED] if known else []


def _lives(value: xr.DataArray, grid: PhysicalGrid, dataset: xr.Dataset, criterion: str) -> xr.DataArray:
    """Rounds to a crack at SWT, or at a Fatemi–Socie parameter, of strain cycles if they are counted."""
    value = value.clip(min=0.0)  # means that are below 0 by rounding
    both: Sequence[tuple[FatigueConstants | ShearConstants, ...]] = [grid.materials]
    if criterion == FATEMI_SOCIE:
        both = [grid.shear_materials]
        if not grid.shear_materials:
            estimated = ShearConstants.estimated
            both = [tuple(map(estimated, grid.materials, ratios)) for ratios in grid.of_both("poisson_ratio")]

    def of_bodies(two: Sequence[FatigueConstants | ShearConstants], at: Mapping[str, Any]) -> xr.DataArray:
        own = value.isel(at, missing_dims="ignore")
        counted = [each.isel(at, missing_dims="ignore") for each in _counted_in(dataset)]
        one, other = (
            each.rounds(own, *counted) if counted else own.copy(data=each.cycles(own.values)) for each in two
        )
        return one.where(grid.bodies.isel(at, missing_dims="ignore") == 0, other)

    if len(both) == 1:
        return of_bodies(both[0], {}).transpose(*value.dims)
    dim = grid.dimension("poisson_ratio") or ""  # estimated ones differ from one Poisson ratio to another
    parts = [of_bodies(constants, {dim: [k]}) for k, constants in enumerate(both)]
    return xr.concat(parts, dim).transpose(*value.dims)


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
        values = dataset[f"SWT{end}"]
        dims = (*values.dims, *COUNTED_SIZES)
        counted = [each.broadcast_like(values).transpose(*dims).values for each in _counted_in(dataset)]
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
