"""The table of data variables with units: what each is made of, and what that is multiplied by."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from swtstudy.vocabulary.choices import CRITERIA, FATEMI_SOCIE, FINDLEY, SWT
from swtstudy.vocabulary.quantities import NONLOCAL, STICK_ENDS, YIELD, Request, error_of

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.at_rest import Contact
    from swtstudy.units.grid import PhysicalGrid

#: What a study without units calls so, where the same has units in one with them.
_OF_QUANTITIES = ("dissipation", "dissipation_error", "stick_radius", "contact_radius", YIELD, "bulk_shift")
NORMALISED = {name: f"normalised_{name}" for name in (*_OF_QUANTITIES, *STICK_ENDS)}
#: Of the nonlocal quantities those that are swt, and those that are places.
MEANS = tuple(name for name, row in NONLOCAL.items() if not row.is_place)
PLACES = tuple(name for name, row in NONLOCAL.items() if row.is_place)
#: Per cent of the bodies that have a crack before the life of that name.
PERCENTS = (10, 50, 90)


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
        What that is multiplied by, or what the contact has.
    criterion
        Of which it is; empty for what every criterion has.
    is_life
        Whether it is the life at that.
    """

    name: str
    symbol: str
    meaning: str
    kind: str
    of: str
    scale: Callable[[PhysicalGrid], xr.DataArray]
    criterion: str = ""
    is_life: bool = False


class Kind(NamedTuple):
    """Names and words that s of a criterion has with units.

    Attributes
    ----------
    criterion, name, symbol
        Its name, that of the variable and its symbol.
    unit
        "stress", or "1".
    scale
        Over s, of a body, 0 or 1, of a contact.
    life, life_symbol
        Of the life at that its name and what is below N; empty where there is none.
    """

    criterion: str
    name: str
    symbol: str
    unit: str
    scale: Callable[[Contact, int], float]
    life: str = ""
    life_symbol: str = ""


def _of_body(grid: PhysicalGrid, of: Callable[[int], xr.DataArray]) -> xr.DataArray:
    """A value of the first or the second body, 0 or 1, where the grid has that body."""
    return of(0).where(grid.bodies == 0, of(1))


def _stress(grid: PhysicalGrid) -> xr.DataArray:
    return grid.at_rest.scale("E* δ0/a_H")


def _over(stresses: Sequence[float]) -> Callable[[PhysicalGrid], xr.DataArray]:
    """The unit of stress over a stress of each body."""
    return lambda grid: _of_body(grid, lambda body: _stress(grid) / stresses[body])


def _swt(contact: Contact, body: int) -> float:
    return contact.swt_scale * contact.moduli.swt_share(body)


def _strain(contact: Contact, body: int) -> float:
    return contact.stress_scale / contact.moduli.shear[body]


#: By criterion.
KINDS = {
    kind.criterion: kind
    for kind in (
        Kind(SWT, "SWT", r"\mathrm{SWT}", "stress", _swt, "cycles"),
        Kind(FATEMI_SOCIE, "FS", r"\mathrm{FS}", "1", _strain, "FS_cycles", "FS"),
        Kind(FINDLEY, "findley_stress", "f", "stress", lambda contact, body: contact.stress_scale),
    )
}
#: Scales by kind of unit, where these are those of a contact.
_SCALES: dict[str, Callable[[PhysicalGrid], xr.DataArray]] = {
    "length": lambda grid: grid.at_rest.scale("a_H"),
    "stress": _stress,
    "work": lambda grid: grid.at_rest.each(lambda contact: contact.work_scale),
}


def variables(grid: PhysicalGrid, asked: Request) -> Iterator[Variable]:
    """The data variables with units that a grid has, beside those without."""
    criteria = {*map(str, grid.values("criterion"))}
    means = ["s", *(name for name in MEANS if name in asked.variables)]
    for kind in (kind for kind in KINDS.values() if kind.criterion in criteria):
        for name in means:
            yield from _of_criterion(kind, name, grid)
    radius = "half-width" if grid.plane else "radius"
    places = {name: (position_of(name), "x", NONLOCAL[name].meaning, "length") for name in PLACES}
    ends = {name: name.removeprefix("stick_") for name in STICK_ENDS}
    made: dict[str, tuple[str, str, str, str]] = {
        "critical_x": ("critical_position", "x", "position of the critical point", "length"),
        **places,
        "dissipation": ("dissipation", "W", "work of friction in a cycle", "work"),
        "dissipation_error": (
            *("dissipation_error", r"\Delta W", "error of work of friction in a cycle", "work"),
        ),
        "stick_radius": ("stick_radius", "c", f"{radius} that always sticks", "length"),
        **{
            name: (name, rf"x_\mathrm{{{side}}}", f"{side} end of what always sticks", "length")
            for name, side in ends.items()
        },
        "contact_radius": (
            *("largest_contact_radius", r"a_\mathrm{max}", f"largest contact {radius}", "length"),
        ),
        "bulk_shift": ("bulk_shift", "e", "shift of the stick zone by the bulk strain", "length"),
        YIELD: (YIELD, r"\sigma_\mathrm{v}", "largest von Mises stress", "stress"),
    }
    known = {"critical_x", *asked.variables, *grid.margins}
    yield from (Variable(*row, of, _SCALES[row[3]]) for of, row in made.items() if of in known)
    if YIELD in known and grid.yield_strengths:
        symbol, meaning = (
            r"\sigma_\mathrm{v}/\sigma_\mathrm{y}",
            "largest von Mises stress over the yield strength",
        )
        yield Variable("yield_ratio", symbol, meaning, "1", YIELD, _over(grid.yield_strengths))
    mean = "load" if grid.plane else "depth"
    for name, symbol, meaning, kind_of_unit in (
        ("contact_radius", "a_0", f"contact {radius} at the mean {mean}", "length"),
        ("peak_pressure", "p_0", f"largest pressure at the mean {mean}", "stress"),
        ("depth", r"\delta_0", f"mean indentation {mean}", "length"),
        ("normal_force", "F_0", f"normal force at the mean {mean}", "force"),
    ):
        given = grid.values(name) and name != grid.of_loads
        if not given and not (grid.plane and name == "depth"):
            yield Variable(name, symbol, meaning, kind_of_unit, "", _at_rest(name))


def _at_rest(name: str) -> Callable[[PhysicalGrid], xr.DataArray]:
    return lambda grid: grid.at_rest.each(lambda contact: getattr(contact, name))


def _of_criterion(kind: Kind, name: str, grid: PhysicalGrid) -> Iterator[Variable]:
    """The value of s or of a mean, its error, and its life or its usage of a limit, if these are known."""
    end = name.removeprefix("s")
    place = end.removeprefix("_")
    meaning, below = (
        CRITERIA[kind.criterion].values + end.replace("_", " "),
        rf"_\mathrm{{{place}}}" * bool(place),
    )

    def scale(grid: PhysicalGrid) -> xr.DataArray:
        return _of_body(grid, lambda body: grid.at_rest.each(lambda contact: kind.scale(contact, body)))

    own: dict[str, Any] = {"of": name, "scale": scale, "criterion": kind.criterion}
    yield Variable(f"{kind.name}{end}", f"{kind.symbol}{below}", meaning, kind.unit, **own)
    if kind.criterion == FINDLEY and grid.findley_limits:
        symbol, usage = rf"{kind.symbol}{below}/f_\mathrm{{lim}}", own | {"scale": _over(grid.findley_limits)}
        yield Variable(f"findley_usage{end}", symbol, f"{meaning} over its limit", "1", **usage)
    if kind.life and (grid.materials or (grid.shear_materials and kind.criterion == FATEMI_SOCIE)):
        words = ""
        if kind.criterion == FATEMI_SOCIE:
            words = " by shear constants" + " estimated from the tensile ones" * (not grid.shear_materials)
        index = ", ".join(filter(None, (kind.life_symbol, place)))
        symbol = rf"N_\mathrm{{{index}}}" if index else "N"
        words = f"rounds to a crack{end.replace('_', ' ')}{words}"
        yield Variable(f"{kind.life}{end}", symbol, words, "1", **own, is_life=True)
    error, symbol = error_of(name), rf"\Delta {kind.symbol}{below}"
    yield Variable(
        error_of(f"{kind.name}{end}"), symbol, f"error of {meaning}", kind.unit, **own | {"of": error}
    )


def position_of(place: str) -> str:
    """Name of a place with a unit."""
    return f"{place.removesuffix('_x')}_position"


#: In names of what blocks make of a life, in the place of ``cycles``.
REPETITIONS, SHARE, LIFE = "repetitions", "damage_share", "cycles"
#: What is before these in names, and whose criterion that is in words.
STARTS = {"": "", "FS_": " by Fatemi and Socie"}
#: In the place of ``cycles`` in what scatter makes of a life.
FAILED = "failure_probability"


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
    *_VALUES,
    *map(error_of, _VALUES),
    *(f"findley_usage{end}" for end in _ENDS),
    *map(position_of, PLACES),
    *LIVES,
    *(name for _, *both in lives_in(LIVES) for name in both),
    *(name for _, name in scattered_in(LIVES)),
    *("critical_position", "peak_pressure", "depth", "normal_force", "largest_contact_radius", "yield_ratio"),
    *NORMALISED,
    *NORMALISED.values(),
)
