"""Results outside of the model's limits, in words: how many points, and the worst point."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from swtstudy.kernel import INNERMOST
from swtstudy.points.values import index_at, unit_of
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.choices import REGIMES
from swtstudy.vocabulary.mistakes import plain
from swtstudy.vocabulary.parameters import NORMAL_AMPLITUDES
from swtstudy.vocabulary.quantities import COMPUTED, ZONES, has_units, require
from swtstudy.vocabulary.wording import line_words, number_words, numbers_words

#: Strain–life constants are known for lives between these.
KNOWN_LIVES = 1e2, 1e7
#: What the name of the limits that points exceed begins with.
OUTSIDE = "outside: "
_KNOWN = " to ".join(numbers_words(KNOWN_LIVES, 3))
#: Positions nearer to a sharp tip than this, in a_H, are at the tip.
BESIDE_TIP = 10.0 * INNERMOST
#: By how much s of a cylinder and, approximately, of a sphere is too low with the stick zone in place, by
#: `bulk_shift_ratio`: at constant P, Q = 0.2 μP, ν = 0.3 and a bulk stress in phase without mean; less at
#: larger Q (results/stick_zone_shift.md).
BULK_SHIFT_ERRORS = {0.1: (0.054, 0.057), 0.5: (0.21, 0.24), 1.0: (0.32, 0.38)}
#: Where the stick zone is in s, as flags of ``stick_zone``.
IN_PLACE, _, APPROXIMATE = range(len(ZONES))
#: Rounding of a ratio of a force to μ F_N that is 1.
ROUNDING = 1e-9


class Limit(NamedTuple):
    """Up to which value of a data variable the model holds.

    Attributes
    ----------
    variable, largest
        Its name, and the limit.
    words, value
        Words for a point beyond the limit, and for the variable.
    short, of
        Words for the limit, and for the whole of which the variable is a share.
    consequence
        On which side of the truth s is beyond it, and by how much; nothing if that is not known.
    """

    variable: str
    largest: float
    words: str
    value: str
    short: str
    of: str
    consequence: str = ""


_MISSING = ", ".join(f"{100 * max(both):.0f} % at {ratio:g}" for ratio, both in BULK_SHIFT_ERRORS.items())
_STRESS, _SHIFT = "largest von Mises stress over the yield strength", "shift over the width of the slip zone"
_TOO_LARGE = "shift of the stick zone by bulk strain too large to be left out"
_TOO_LOW = f"s is too low at the edge in tension, it should be up to {_MISSING} higher for Q ≥ 0.2 μP"
_TOO_WIDE, _TOO_LONG = "contact too large for half-spaces", "slide too long for a contact that stays in place"
LIMITS = (
    Limit("yield_ratio", 1.0, "beyond first yield", _STRESS, "first yield", "of the strength"),
    Limit("radius_ratio", 0.1, _TOO_WIDE, "contact radius over R", "half-spaces", "of R"),
    Limit("slide_ratio", 0.1, _TOO_LONG, "slide over contact radius", "slide", "of the contact radius"),
    Limit("bulk_shift_ratio", 0.1, _TOO_LARGE, _SHIFT, "stick-zone shift", "of the slip zone", _TOO_LOW),
)


#: A few words on points beyond a limit of the model, with their number and the worst value: empty where
#: another finding says it, None if all points are inside. Then the same in a line, with the worst point.
Finding = tuple[str | None, str]


def validity_lines(dataset: xr.Dataset, inside: bool = False) -> tuple[str, ...]:
    """One line for each limit of the model that points are outside of.

    Parameters
    ----------
    dataset
        Results, or a part of them.
    inside
        Whether to say, too, how far all points are from the limits that they are inside of.

    Raises
    ------
    StudyError
        A ValueError, if the results have been left without s or regime.
    """
    found = [*_found(dataset)]
    beyond = [line for short, line in found if short is not None]
    return (*beyond, *(line for short, line in found if inside and short is None))


def outside_words(dataset: xr.Dataset) -> str:
    """Say in one line what results are outside of; empty if they are inside of all limits.

    Examples
    --------
    >>> import swtstudy
    >>> forces = {"normal_force_amplitude": 0.5, "tangential_force_amplitude": [0.5, 1.4]}
    >>> outside_words(swtstudy.solve(rtol=1e-2, **forces))
    'Outside of the model: no equilibrium at 1 of 2 points.'
    """
    words = "; ".join(filter(None, (short for short, _ in _found(dataset))))
    return f"Outside of the model: {words}." if words else ""


def _found(dataset: xr.Dataset) -> Iterator[Finding]:
    """Yield what there is to say of every limit."""
    require(dataset, "s", "regime")
    if not dataset.s.size:
        return
    for out, words, more in _exceptions(dataset):
        if out.any():
            yield f"{words}{_where(out)}", f"{words}{_where(out)}{more}"
    yield from _lives(dataset)
    for limit in LIMITS:
        values = _limited(dataset, limit)
        out = values > limit.largest
        if not np.isfinite(values).any() and not out.any():
            continue
        worst = _number(np.nanmax(values))
        line = f"{limit.value} up to {worst}, limit {limit.largest:g}"
        if not out.any():
            yield None, line
            continue
        place = _place(dataset, values)
        line = "; ".join(filter(None, (line + f",{place}" * bool(place), limit.consequence)))
        yield f"{limit.short}{_where(out)} ({worst} {limit.of})", f"{limit.words}{_where(out)}: {line}"
    yield from _stick_zones(dataset)
    if has_units(dataset) and "yield_ratio" not in dataset and "peak_pressure" in dataset:
        pressure = dataset.peak_pressure
        words = f"{pressure.name} up to {_number(pressure.max())}{unit_of(pressure)}"
        yield None, f"{words}; whether that yields is unknown without a yield_strength"


def _stick_zones(dataset: xr.Dataset) -> Iterator[Finding]:
    """Points with the stick zone in its place among moved ones, and points at which it is moved roughly."""
    zone = _values(dataset, "stick_zone")
    left = (zone == IN_PLACE) & (_values(dataset, "bulk_shift_ratio") > 0.0)
    moved, roughly = zone > IN_PLACE, zone == APPROXIMATE
    if moved.any() and left.any():
        words = f"stick zone left in place{_where(left)}, moved by the bulk stress{_where(moved)}"
        yield words, words
    if roughly.any():
        words = "the rise of the stress at the edge in tension is right within 4 %, or within 9 % where "
        words += "the bulk stress follows the tangential load but nearly"
        yield None, f"stick zone moved approximately{_where(roughly)}: {words}"


def _exceptions(dataset: xr.Dataset) -> Iterator[tuple[BoolArray, str, str]]:
    """Which points are something, that in words, and what more there is to say of it."""
    state, s, surface = dataset.regime.values, _values(dataset, "s"), _values(dataset, "s_surface")
    computed = _values(dataset, "status", COMPUTED) == COMPUTED
    lost = computed & (state == REGIMES.index("no_equilibrium"))
    yield lost, "no equilibrium", _lacking(dataset, lost)
    infinite = computed & (state == REGIMES.index("not_finite"))
    yield infinite, "s is not finite", ": swt grows without bound towards an edge"
    at_tip = (_values(dataset, "exponent") < 2.0) & (np.abs(_values(dataset, "critical_x")) < BESIDE_TIP)
    yield at_tip, "swt is largest at the tip", ": s depends on how a real tip is rounded"
    out = _above_line(dataset)
    if out.any():
        with np.errstate(divide="ignore", invalid="ignore"):
            factor = np.where(out, surface / s, 0.0)
        times = f"s_surface is up to {_number(factor.max())} times as large"
        times = times if np.isfinite(factor.max()) else "s is 0, and s_surface is not,"
        yield out, "s is not the largest value", f": {times}{_place(dataset, factor)}"
    if "bulk_shift_ratio" in dataset:
        unknown = np.isnan(_values(dataset, "bulk_shift_ratio")) & (state == REGIMES.index("partial_slip"))
        words = "shift of the stick zone by bulk strain unknown"
        yield unknown, words, ": known of the paraboloid and the cylinder alone"
    if "s_surface" in dataset:
        edge = np.isfinite(s) & np.isnan(surface)
        words = "critical point at the singular edge of the face"
        yield edge, words, ": off the line y = 0 swt may have no bound there"


def _lacking(dataset: xr.Dataset, lost: BoolArray) -> str:
    """Say which force is too large at points in no equilibrium."""
    ratio = np.where(lost, _values(dataset, "prescribed_force_ratio", 0.0), 0.0)
    worst, name = ratio.max(), "tangential_force_amplitude"
    if not worst > 1.0 + ROUNDING:
        return ": the normal force pulls at some instant, or the bodies never touch"
    place = _place(dataset, ratio, besides=(name, "body"))
    if not np.isfinite(worst):
        return f": there is a tangential force while the normal force is 0 or pulls{place}"
    harmonic = "load" not in dataset.coords or bool((dataset["load"] == "harmonic").all())
    still = all(not np.any(dataset[each].values) for each in NORMAL_AMPLITUDES if each in dataset.coords)
    if not (harmonic and still and name in dataset.coords):
        return f": the tangential force is up to {_number(worst)} times μ F_N{place}"
    force = float(_values(dataset, name).flat[int(ratio.argmax())])
    if not has_units(dataset):
        return f": {name} {force:.4g} exceeds 1, in μ F_N{place}"
    # The numbers of a contact without names of units have no unit.
    unit = unit_of(dataset[name])
    return f": {name} {force:.4g}{unit} exceeds μ F_N = {force / worst:.4g}{unit}{place}"


def _limited(dataset: xr.Dataset, limit: Limit) -> FloatArray:
    """Values that a limit is for: no shift of the stick zone that s has; NaN where there are none."""
    values = _values(dataset, limit.variable)
    if limit.variable != "bulk_shift_ratio":
        return values
    return np.where(_values(dataset, "stick_zone", IN_PLACE) == IN_PLACE, values, np.nan)


def outside(dataset: xr.Dataset, values: xr.DataArray) -> xr.DataArray:
    """Which values of a quantity are outside of a limit.

    Parameters
    ----------
    dataset
        Results.
    values
        A quantity of theirs. For a life the range of its constants counts as well.

    Returns
    -------
    xarray.DataArray
        True and False over the dimensions of the values; its ``long_name`` says of which limits.
    """
    found = xr.zeros_like(values, bool).drop_attrs()
    limits = {limit.short: _limited(dataset, limit) > limit.largest for limit in LIMITS}
    if values.name != "s_surface":
        limits["the line y = 0"] = _above_line(dataset)
    for each in limits.values():
        of_points = dataset.s.copy(data=each).drop_attrs()
        found = found | of_points.any([dim for dim in of_points.dims if dim not in values.dims])
    if _is_life(dataset, str(values.name)):
        limits["extrapolated life"] = _beyond(values.values)
        found = found | limits["extrapolated life"]
    words = ", ".join(name for name, each in limits.items() if each.any())
    return found.transpose(*values.dims).assign_attrs(long_name=f"{OUTSIDE}{words}")


def _above_line(dataset: xr.Dataset) -> BoolArray:
    """Points with a maximum off the line y = 0, so that s, and all that is made of it, is too low."""
    return _values(dataset, "s_surface") > _values(dataset, "s") + _values(dataset, "s_error")


def _lives(dataset: xr.Dataset) -> Iterator[Finding]:
    """Points with lives beyond the range of their constants."""
    beyond: dict[str, list[str]] = {}  # their names by the words for where
    lines = []
    for name in map(str, dataset.data_vars):
        if not _is_life(dataset, name) or name.rpartition("_")[2].isdigit():  # percentiles go with their life
            continue
        # A point may have several values, such as the nonlocal ones.
        lives = dataset[name].transpose(*dataset.s.dims, ...).values.reshape(*dataset.s.shape, -1)
        where, line = extrapolated(name, lives)
        if line:
            beyond.setdefault(where, []).append(name)
            lines.append(line)
    places = (f"{', '.join(names)} extrapolated{where}" for where, names in beyond.items())
    short = f"{' and '.join(places)} (beyond {_KNOWN})"
    yield from ((short * (k == 0), line) for k, line in enumerate(lines))


def extrapolated(name: str, lives: FloatArray) -> tuple[str, str]:
    """Say at how many points a life is beyond the range of its constants, and how long it is there.

    Parameters
    ----------
    name
        Name of the life.
    lives
        Shape (..., n), n lives of each point.
    """
    out = _beyond(lives)
    if not out.any():
        return "", ""
    where = _where(np.asarray(out.any(axis=-1)))
    ends = " to ".join(dict.fromkeys(numbers_words((lives[out].min(), lives[out].max()), 3)))
    return where, f"{name} extrapolated{where}: {ends}, while the constants are known for {_KNOWN}"


def _is_life(dataset: xr.Dataset, name: str) -> bool:
    """Return whether a data variable is a life, in rounds."""
    return has_units(dataset) and name.removeprefix("FS_").partition("_")[0] == "cycles"


def _beyond(lives: FloatArray) -> BoolArray:
    """Which are beyond `KNOWN_LIVES`; where nothing is in tension a life is infinite."""
    low, high = KNOWN_LIVES
    return np.asarray(np.isfinite(lives) & ((lives < low) | (lives > high)))


def _values(dataset: xr.Dataset, name: str, otherwise: float = np.nan) -> FloatArray:
    """Values of a variable in the shape of s, or one where results do not have it."""
    shape = dataset.variables["s"].sizes
    if name not in dataset.variables:
        return np.full([*shape.values()], float(otherwise))
    return np.asarray(dataset.variables[name].set_dims(shape).transpose(*shape).values, float)


def _where(out: BoolArray) -> str:
    """Say at how many of how many points; nothing of a single one."""
    if out.size == 1:
        return ""
    return f" at {'all' if out.all() else f'{int(out.sum())} of'} {out.size} points"


def _place(dataset: xr.Dataset, values: FloatArray, besides: tuple[str, ...] = ()) -> str:
    """At which point values in the shape of s are largest, but for some dimensions."""
    words = point_words(dataset, int(np.nan_to_num(values, nan=-np.inf).argmax()), besides)
    return f" at {words}" if words else ""


def point_words(dataset: xr.Dataset, flat: int, besides: tuple[str, ...] = ()) -> str:
    """Where one of the flattened points lies, such as "friction = 0.5, normal_force = 100 N"."""
    place = index_at(dataset.s, flat)
    return index_words(dataset, {dim: number for dim, number in place.items() if dim not in besides})


def index_words(dataset: xr.Dataset, place: Mapping[str, int]) -> str:
    """The same of indices along dimensions."""
    words = []
    for dim, number in place.items():
        # A stacked dimension has the values of several axes.
        names = dataset.indexes[dim].names if dim in dataset.indexes else ()
        for name in map(str, names):
            value: Any = plain(dataset[name].values[number])
            named = line_words(name, value, dataset[name].attrs)
            words.append(f"{name} = {named}{unit_of(dataset[name])}")
        if not names:
            words.append(f"{dim} = {number}")
    return ", ".join(words)


def _number(value: Any) -> str:
    return number_words(float(value), 3)
