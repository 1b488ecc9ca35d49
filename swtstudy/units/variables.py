"""Data variables with units: what they are made of, and what that is multiplied by."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.units.at_rest import Contact
from swtstudy.units.blocks import lives_in
from swtstudy.units.labels import Units
from swtstudy.units.life import ROUNDS, UNCOUNTED, FatigueConstants, ShearConstants
from swtstudy.units.scatter import scattered_in
from swtstudy.vocabulary.choices import CRITERIA, FATEMI_SOCIE, FINDLEY, SWT
from swtstudy.vocabulary.quantities import COUNTED, NONLOCAL, STICK_ENDS, YIELD, Request, error_of

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.grid import PhysicalGrid

#: What a study without units calls so, where the same has units in one with them.
NORMALISED = {
    name: f"normalised_{name}"
    for name in (
        *("dissipation", "dissipation_error", "stick_radius", "contact_radius", "von_mises", "bulk_shift"),
        *STICK_ENDS,
    )
}


@dataclass(frozen=True)
class Variable:
    """One data variable.

    Attributes
    ----------
    name, symbol, meaning
        As of a `swtstudy.vocabulary.quantities.Quantity`.
    kind
        "length", "force", "stress", "work", or "1".
    of
        The data variable that it is made of; empty for what a contact at rest has.
    scale
        What that is multiplied by, or what the contact has.
    to_cycles
        Whether it is the life at that.
    counts
        Whether that is of counted strain cycles.
    criterion
        Of which it is; empty for what every criterion has.
    """

    name: str
    symbol: str
    meaning: str
    kind: str
    of: str
    scale: Callable[[PhysicalGrid], xr.DataArray]
    to_cycles: bool = False
    counts: bool = False
    criterion: str = ""

    def attributes(self, units: Units) -> dict[str, Any]:
        """CF attributes."""
        label = "1" if self.kind == "1" else units.label(self.kind) or f"unit of {self.kind}"
        words = {"long_name": self.meaning, "units": label, "symbol": self.symbol}
        return words | ({"comment": ROUNDS if self.counts else UNCOUNTED} if self.to_cycles else {})

    def values(self, dataset: xr.Dataset, grid: PhysicalGrid) -> xr.DataArray:
        """Its values over the dimensions of a Dataset."""
        if not self.of:
            return self.scale(grid)
        found = dataset[self.of] * self.scale(grid)
        if self.criterion and grid.dimension("criterion") is not None:
            own = np.array([value == self.criterion for value in grid.values("criterion")])
            found = found.where(grid.over_dimension("criterion", own))
        return _cycles(found, grid, dataset, self.criterion) if self.to_cycles else found


def variables(grid: PhysicalGrid, asked: Request) -> Iterator[Variable]:
    """The data variables with units that a grid has, beside those without."""
    criteria = {*map(str, grid.values("criterion"))}
    for kind in KINDS.values():
        for end in _ends(asked) if kind.criterion in criteria else ():
            yield from kind.variables(end, grid, asked.counts)
    yield Variable(
        "critical_position", "x", "position of the critical point", "length", "critical_x", _length
    )
    for of in (place for place in PLACES if place in asked.variables):
        yield Variable(position_of(of), "x", NONLOCAL[of].meaning, "length", of, _length)
    yield from _at_rest(grid)
    radius = "half-width" if grid.plane else "radius"
    if "dissipation" in asked.names:
        for end, symbol, words in (("", "W", ""), ("_error", r"\Delta W", "error of ")):
            of, meaning = NORMALISED[f"dissipation{end}"], f"{words}work of friction in a cycle"
            yield Variable(f"dissipation{end}", symbol, meaning, "work", of, _work)
    if "stick_radius" in asked.names:
        of, meaning = NORMALISED["stick_radius"], f"{radius} that always sticks"
        yield Variable("stick_radius", "c", meaning, "length", of, _length)
    for name in STICK_ENDS if {*STICK_ENDS} <= {*asked.names} else ():
        side = name.rpartition("_")[2]
        meaning, symbol = f"{side} end of what always sticks", rf"x_\mathrm{{{side}}}"
        yield Variable(name, symbol, meaning, "length", NORMALISED[name], _length)
    if "contact_radius" in asked.names:
        of, meaning = NORMALISED["contact_radius"], f"largest contact {radius}"
        yield Variable("largest_contact_radius", r"a_\mathrm{max}", meaning, "length", of, _length)
    if "bulk_shift" in grid.margins:
        meaning = "shift of the stick zone by the bulk strain"
        yield Variable("bulk_shift", "e", meaning, "length", NORMALISED["bulk_shift"], _length)
    if YIELD in asked.names:
        of, words = NORMALISED[YIELD], "largest von Mises stress"
        yield Variable(YIELD, r"\sigma_\mathrm{v}", words, "stress", of, _stress)
        if grid.yield_strengths:
            symbol, words = r"\sigma_\mathrm{v}/\sigma_\mathrm{y}", f"{words} over the yield strength"
            yield Variable(
                "yield_ratio", symbol, words, "1", of, lambda grid: _over(grid, grid.yield_strengths)
            )


#: Of the nonlocal quantities those that are swt, and those that are places.
MEANS = tuple(name for name, row in NONLOCAL.items() if not row.is_place)
PLACES = tuple(name for name, row in NONLOCAL.items() if row.is_place)


def position_of(place: str) -> str:
    """Name of a place with a unit."""
    return f"{place.removesuffix('_x')}_position"


@dataclass(frozen=True)
class _Kind:
    """Names and words that s of a criterion has with units.

    Attributes
    ----------
    criterion, name, symbol
        Its name, that of the variable and its symbol.
    unit
        "stress", or "1".
    scale
        Over s.
    life, life_symbol
        Of the life at that its name and what is below N; empty where there is none.
    """

    criterion: str
    name: str
    symbol: str
    unit: str
    scale: Callable[[PhysicalGrid], xr.DataArray]
    life: str = ""
    life_symbol: str = ""

    def variables(self, end: str, grid: PhysicalGrid, counts: bool) -> Iterator[Variable]:
        """The value of s, of a mean or of an error; its life, or its usage of a limit, if these are known."""
        error, words = end.endswith("error"), end.replace("_", " ")
        place = end.removesuffix("_error").removeprefix("_")
        sign, below = r"\Delta " * error, rf"_\mathrm{{{place}}}" * bool(place)
        meaning = f"{'error of ' * error}{CRITERIA[self.criterion].values}{words.removesuffix(' error')}"
        own: dict[str, Any] = {"of": f"s{end}", "scale": self.scale, "criterion": self.criterion}
        yield Variable(f"{self.name}{end}", f"{sign}{self.symbol}{below}", meaning, self.unit, **own)
        if self.criterion == FINDLEY and grid.findley_limits and not error:
            symbol, meaning = rf"{self.symbol}{below}/f_\mathrm{{lim}}", f"{meaning} over its limit"
            usage = {**own, "scale": lambda grid: _over(grid, grid.findley_limits)}
            yield Variable(f"findley_usage{end}", symbol, meaning, "1", **usage)
        if self.life and not error and _constants(grid, self.criterion):
            below = ", ".join(filter(None, (self.life_symbol, place)))
            symbol = rf"N_\mathrm{{{below}}}" if below else "N"
            meaning = f"rounds to a crack{words}{_life_words(grid, self.criterion)}"
            life = f"{self.life}{end}", symbol, meaning, "1"
            yield Variable(*life, to_cycles=True, counts=counts, **own)


def dims_of(grid: PhysicalGrid, asked: Request) -> dict[str, tuple[str, ...]]:
    """Names and dimensions of the data variables of a grid with units that one without does not have."""
    found = {new: grid.dims for old, new in NORMALISED.items() if old in asked.variables}
    for each in variables(grid, asked):
        found[each.name] = (*grid.dims, *asked.variables.get(each.of, ())) if each.of else grid.at_rest.dims
    for life, repetitions, share in lives_in([*found]) if grid.blocks else ():
        found[share] = found[life]
        found[repetitions] = tuple(dim for dim in found[life] if dim != "load")
    lives = [name for name in LIVES if name in found]
    for life, name in scattered_in(lives, grid.scatter.target > 0.0) if grid.scatter else ():
        found[name] = found[life]
    return found


def _ends(asked: Request) -> Iterator[str]:
    """Endings of the names of s, its means and their errors."""
    for name in ("s", *(name for name in MEANS if name in asked.variables)):
        for of in (name, error_of(name)):
            yield of.removeprefix("s")


def _at_rest(grid: PhysicalGrid) -> Iterator[Variable]:
    """Variables of a contact at rest."""
    rest: tuple[tuple[str, str, str, str, Callable[[Contact], float]], ...] = (
        ("contact_radius", "a_0", "contact radius at the mean depth", "length", lambda c: c.contact_radius),
        ("peak_pressure", "p_0", "largest pressure at the mean depth", "stress", lambda c: c.peak_pressure),
        ("depth", r"\delta_0", "mean indentation depth", "length", lambda c: c.depth),
        ("normal_force", "F_0", "normal force at the mean depth", "force", lambda c: c.normal_force),
    )
    for name, symbol, meaning, kind, value in rest:
        if grid.plane:
            meaning = meaning.replace("contact radius", "contact half-width").replace("depth", "load")
        known = grid.values(name) and name != grid.of_loads
        if not known and not (grid.plane and name == "depth"):
            yield Variable(name, symbol, meaning, kind, "", partial(_each, value))


def _each(value: Callable[[Contact], float], grid: PhysicalGrid) -> xr.DataArray:
    return grid.at_rest.each(value)


def _of_body(grid: PhysicalGrid, value: Callable[[int], xr.DataArray]) -> xr.DataArray:
    """A value of the first or the second body, 0 or 1, where the grid has that body."""
    one, two = (value(body) for body in (0, 1))
    return one.where(grid.bodies == 0, two)


def _swt_scale(grid: PhysicalGrid) -> xr.DataArray:
    """SWT of each body over s."""
    return _of_body(grid, lambda body: grid.at_rest.each(lambda c: c.swt_scale * c.moduli.swt_share(body)))


def _strain_scale(grid: PhysicalGrid) -> xr.DataArray:
    """The unit of stress over the shear modulus of each body."""
    return _of_body(grid, lambda body: grid.at_rest.each(lambda c: c.stress_scale / c.moduli.shear[body]))


def _length(grid: PhysicalGrid) -> xr.DataArray:
    return grid.at_rest.scale("a_H")


def _stress(grid: PhysicalGrid) -> xr.DataArray:
    return grid.at_rest.scale("E* δ0/a_H")


def _over(grid: PhysicalGrid, stresses: Sequence[float]) -> xr.DataArray:
    """The unit of stress over a stress of each body."""
    return _of_body(grid, lambda body: _stress(grid) / stresses[body])


def _work(grid: PhysicalGrid) -> xr.DataArray:
    return grid.at_rest.each(lambda contact: contact.work_scale)


def _cycles(value: xr.DataArray, grid: PhysicalGrid, dataset: xr.Dataset, criterion: str) -> xr.DataArray:
    """Rounds to a crack at SWT, or at a Fatemi–Socie parameter, of strain cycles if they are counted."""
    import xarray as xr

    # Runs of before have means that are below 0 by rounding.
    value = value.clip(min=0.0)
    counted = dataset[[name for name in COUNTED if name in dataset.data_vars]]
    constants, dim = _constants(grid, criterion), grid.dimension("poisson_ratio")
    if len(constants) == 1:
        return _of_bodies(value, counted, grid.bodies, constants[0])
    # Estimated ones, which differ from one Poisson ratio to another.
    parts = []
    for k, both in enumerate(constants):
        at: dict[str, Any] = {"indexers": {dim: [k]}, "missing_dims": "ignore"}
        parts.append(_of_bodies(value.isel(**at), counted.isel(**at), grid.bodies.isel(**at), both))
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
    return one.where(bodies == 0, two) if np.ndim(bodies) else (one, two)[int(bodies)]


def _constants(grid: PhysicalGrid, criterion: str) -> list[tuple[FatigueConstants | ShearConstants, ...]]:
    """Constants of both bodies for the life of a criterion, of each Poisson ratio where that matters."""
    given = grid.shear_materials if criterion == FATEMI_SOCIE else grid.materials
    if given or not grid.materials:
        return [given] if given else []
    return [
        tuple(ShearConstants.estimated(*each) for each in zip(grid.materials, both, strict=True))
        for both in grid.of_both("poisson_ratio")
    ]


def _life_words(grid: PhysicalGrid, criterion: str) -> str:
    """Which constants of shear a life rests on, for its meaning."""
    if criterion != FATEMI_SOCIE:
        return ""
    return " by shear constants" + " estimated from the tensile ones" * (not grid.shear_materials)


#: By criterion.
KINDS = {
    kind.criterion: kind
    for kind in (
        _Kind(SWT, "SWT", r"\mathrm{SWT}", "stress", _swt_scale, "cycles"),
        _Kind(FATEMI_SOCIE, "FS", r"\mathrm{FS}", "1", _strain_scale, "FS_cycles", "FS"),
        _Kind(FINDLEY, "findley_stress", "f", "stress", _stress),
    )
}

#: Names of all lives that there may be, and of all that there may be.
LIVES = tuple(
    f"{kind.life}{name.removeprefix('s')}" for kind in KINDS.values() if kind.life for name in ("s", *MEANS)
)
NAMES = (
    *(
        f"{kind.name}{of.removeprefix('s')}"
        for kind in KINDS.values()
        for each in ("s", *MEANS)
        for of in (each, error_of(each))
    ),
    *(f"findley_usage{name.removeprefix('s')}" for name in ("s", *MEANS)),
    *(position_of(place) for place in PLACES),
    *LIVES,
    *(name for _, *both in lives_in(LIVES) for name in both),
    *(name for _, name in scattered_in(LIVES, True)),
    *("critical_position", "contact_radius", "peak_pressure", "depth", "normal_force", "dissipation"),
    *("dissipation_error", "stick_radius", *STICK_ENDS, "largest_contact_radius", *NORMALISED.values()),
    *("von_mises", "yield_ratio", "bulk_shift"),
)
