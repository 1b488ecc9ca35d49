"""s for named parameters, computed in threads of this process, as the Dataset that users see."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points.chunk import Arrays, blank, cut, fill, put, task_of
from swtstudy.points.grid import Distinct, Grid, alike, check_count, code_of, points_from
from swtstudy.points.reading import listed, read_distances, read_grid, spanned
from swtstudy.points.rules import doubts
from swtstudy.points.validity import ROUNDING, validity_lines
from swtstudy.points.values import Value, as_number
from swtstudy.vocabulary.arrays import BoolArray, IndexArray
from swtstudy.vocabulary.choices import BENEATH, CRITERIA, REGIMES, SWT, is_plane, with_values_of
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, Report, StudyError
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import (
    CONTROLS,
    DIRECTIONS,
    HARMONIC,
    PARAMETERS,
    QUANTITY_AXES,
    SHIFT,
    Parameter,
)
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import (
    DISTANCE,
    QUANTITIES,
    SOLVED,
    STICK_ENDS,
    Request,
    attributes_of,
    read_quantities,
)
from swtstudy.vocabulary.version import __version__

#: xarray breaks the labels of its own plots after 30 characters, including the unit.
_LONGEST_NAME = 24
#: Points whose margins are found together: the working memory for one is some kB.
_TOGETHER = 2000
#: Larger grids are not looked at before they are solved: a point takes some 30 µs.
MOST_FORESEEN = 100_000


@with_parameters((*PARAMETERS.values(), QUANTITY_AXES[DISTANCE]))
def solve(*, rtol: float = DEFAULT_RTOL, quantities: Sequence[str] = (), **parameters: object) -> xr.Dataset:
    """Normalised SWT parameter s on the grid spanned by named parameters, or at points given one by one.

    Computes in this process; for a large grid write a study and `swtstudy.run` it.

    Parameters
    ----------
    rtol
        Relative accuracy asked of s.
    quantities
        Names of `swtstudy.vocabulary.quantities.QUANTITIES`, computed beside s.
    **parameters
        The names below, each a single value or a one-dimensional sequence of values; strings such as "3/2" or
        "pi/2" stand for numbers. DataArrays that share a dimension are one list of points: they vary together
        along this dimension.

    Returns
    -------
    xarray.Dataset
        s, s_error, critical_x (in a_H), critical_angle (degrees), regime and s_surface (greater than s where
        the surface line is not enough). Sequences become dimensions, in the order given, after that of a list
        of points; single values become scalar coordinates. The attributes state the version and rtol. The
        quantities that are asked are further data variables.
        Where s is 0 or not finite there is no critical point: critical_x and critical_angle are NaN. Nor is
        there where the bulk stress alone makes s, far from the contact: critical_x is NaN. With a
        bulk_stress_amplitude there is bulk_shift, too: by how much, in a_H, the bulk strain would move the
        stick zone, and stick_zone: whether s has that shift. If it has not, s is too low at the edge in
        tension: bulk_shift_ratio tells by how much.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters.

    Notes
    -----
    Axes that are arrays of dask are solved lazily, by `xarray.apply_ufunc` (dask="parallelized"): the data
    variables are arrays of dask, whose chunks are the products of the axes' chunks, with the same values.

    Examples
    --------
    >>> import swtstudy
    >>> dataset = swtstudy.solve(phase=[0, 1.5, 3.0], normal_amplitude=[0.25, 0.75])
    >>> dataset.s.dims
    ('phase', 'normal_amplitude')

    Two chunks of ten phases, each solved in a thread of its own:

    >>> import dask.array
    >>> lazy = swtstudy.solve(phase=dask.array.linspace(0, 3, 20, chunks=10), rtol=1e-2)
    >>> lazy.s.chunks
    ((10, 10),)
    >>> round(float(lazy.s.max()), 3)
    0.157
    """
    report = Report()
    samples, dim, labels, others = listed(parameters, report)
    lazy = {
        dim if name in samples else name: raw.chunks[0]  # type: ignore[attr-defined]
        for name, raw in parameters.items()
        if getattr(raw, "chunks", None)
    }
    fixed, axes = spanned(others, report)
    report.rtol(rtol)
    names = read_quantities(quantities, "quantities", report)
    asked = Request(names, *read_distances(fixed, axes, report))
    grid, found = read_grid(fixed, axes, others=("rtol", "quantities", DISTANCE), samples=samples)
    if grid is None or report:
        raise StudyError([*found, *report])
    for words in doubts(grid):
        warnings.warn(words, stacklevel=2)
    return solve_grid(replace(grid, sample_dim=dim, sample_labels=labels), float(rtol), asked, lazy)


def solve_grid(grid: Grid, rtol: float, asked: Request, lazy: Mapping[str, Any] | None = None) -> xr.Dataset:
    """s on a grid, and what is ``asked`` beside it, solved in this process.

    Parameters
    ----------
    grid, rtol, asked
        The points, the relative accuracy of s, and the quantities beside s.
    lazy
        Chunks of dask along dimensions. If there are some, data variables are arrays of dask.
    """
    check_count(grid)
    points = None
    if lazy:
        own: dict[str, tuple[str, ...]] = dict.fromkeys(SOLVED, ()) | asked.variables
        along = [xr.DataArray(np.arange(n), dims=d).chunk({d: lazy.get(d, n)}) for d, n in grid.sizes.items()]
        made = xr.apply_ufunc(  # of a part: unlike a function in a function it can be pickled
            partial(_values_of_block, grid, rtol, asked, own),
            *along,
            output_core_dims=[*own.values()],
            dask="parallelized",
            output_dtypes=[np.int8 if name == "regime" else float for name in own],
            dask_gufunc_kwargs={"output_sizes": {d: asked.sizes[d] for dims in own.values() for d in dims}},
        )
        arrays = {name: each.data for name, each in zip(own, made, strict=True)}
    else:
        points, arrays = _solved(grid, rtol, asked, np.arange(grid.size))
    arrays |= margins(grid, points)
    return label(grid, arrays, asked).assign_attrs(source=f"swtstudy {__version__}", rtol=rtol)


def _values_of_block(
    grid: Grid, rtol: float, asked: Request, own: Mapping[str, tuple[str, ...]], *positions: IndexArray
) -> tuple[NDArray[Any], ...]:
    """Values of a block of the grid by ``own`` names and dimensions, from positions along its dimensions."""
    places = np.ravel_multi_index(np.broadcast_arrays(*positions), grid.shape)
    _, arrays = _solved(grid, rtol, asked, places.ravel())
    sizes = {name: [asked.sizes[dim] for dim in dims] for name, dims in own.items()}
    return tuple(arrays[name].reshape(*places.shape, *sizes[name]) for name in own)


def _solved(grid: Grid, rtol: float, asked: Request, places: IndexArray) -> tuple[Distinct, Arrays]:
    """The distinct points at places of a grid, and the values there; raises if a point has no value."""
    points = Distinct.of(grid, asked, places)
    count = len(points.rows)
    found = blank(count)
    chunks = cut(points, np.ones(count, bool), asked)

    def solved(chunk: IndexArray) -> Arrays:
        arrays = blank(len(chunk))
        fill(arrays, *task_of(points, chunk, asked), rtol)
        return arrays

    with Progress(count) as progress, ThreadPoolExecutor(os.cpu_count()) as threads:
        # The first thread starts with the second chunk: to start one takes as long as to solve a point.
        each = threads.map(solved, chunks) if len(chunks) > 1 else map(solved, chunks)
        for chunk, arrays in zip(chunks, each, strict=True):
            put(found, chunk, arrays)
            progress.add(len(chunk))
    return points, values_at(grid, points, found, asked, places)


def label(grid: Grid, arrays: Mapping[str, NDArray[Any]], asked: Request) -> xr.Dataset:
    """The Dataset of a grid.

    Parameters
    ----------
    grid
        Names and values of the dimensions.
    arrays
        Data variables by name, each of shape (grid.size, …) in C order, or the grid's shape; quantities over
        critical distances have these next.
    asked
        The quantities beside s.

    Returns
    -------
    xarray.Dataset
        With units, if the grid is one of real contacts.
        Dimensions in the order of the grid's; single-valued parameters are scalar coordinates, but for
        optional ones at their default; parameters of a sample are coordinates along its dimension, which
        numbers its points. The coordinate ``control`` says what is prescribed.
    """
    variables: dict[str, xr.Variable] = {}
    for name, values in arrays.items():
        dims = asked.variables.get(name, ())
        tail = values.shape[values.ndim - len(dims) :]  # of one distance there is no dimension
        whole = values.reshape((*grid.shape, *tail))
        variables[name] = _variable((*grid.dims, *dims), whole, attributes_of(name))
    dataset = xr.Dataset(variables, {name: _variable(*own) for name, *own in _coordinates(grid, asked)})
    _name_criteria(dataset, grid, asked)
    dataset = grid.presented(dataset, asked)
    for variable in dataset.variables.values():
        # By the CF conventions what has no unit has no dimension; with the unit 1 xarray's labels end in [1].
        if variable.attrs.get("units") == "1":
            del variable.attrs["units"]
    # Arrays of dask are not known before they are computed.
    lines = validity_lines(dataset) if "regime" in arrays and not dataset.chunks else ()
    return dataset.assign_attrs(validity="\n".join(lines)) if lines else dataset


def _coordinates(grid: Grid, asked: Request) -> Iterator[tuple[str, tuple[str, ...], Any, dict[str, str]]]:
    """Name, dimensions, values and attributes of each coordinate."""
    for name, values in (grid.samples | grid.axes).items():
        yield name, (str(grid.dimension(name)),), plain_values(values), _attributes(grid.row(name), values)
    if grid.samples and grid.sample_dim not in grid.samples:
        words = {"long_name": "number of the point", "parameters": " ".join(grid.samples)}
        yield grid.sample_dim, (grid.sample_dim,), values_along(grid, grid.sample_dim), words
    for name, value in grid.fixed.items():
        says = name == SHIFT and "stick_zone" in grid.margins
        if says or not grid.row(name).goes_without_saying(value):
            yield name, (), plain_values((value,))[0], _attributes(grid.row(name), (value,))
    words = {"long_name": "what is prescribed", "comment": f"one of {', '.join(CONTROLS.values())}"}
    yield "control", (), grid.control.name, words
    if asked.distances:
        dims, distances = (DISTANCE,) * asked.is_axis, np.array(asked.distances)
        words = _attributes(grid.row(DISTANCE), asked.distances)
        yield DISTANCE, dims, distances if asked.is_axis else distances[0], words
        words = {"long_name": (along := QUANTITY_AXES["direction"]).name, "comment": along.meaning}
        yield "direction", ("direction",), np.array(DIRECTIONS, dtype=object), words


def _variable(dims: tuple[str, ...], values: Any, attributes: Mapping[str, str]) -> xr.Variable:
    """A variable that xarray need not convert: for that it would first import the arrays of dask."""
    values = values if hasattr(values, "dask") else np.asarray(values)
    return xr.Variable(dims, values, attributes, fastpath=True)


def values_at(
    grid: Grid, points: Distinct, found: Arrays, asked: Request, places: IndexArray | None = None
) -> dict[str, NDArray[Any]]:
    """Values at n places of a grid, by default at all, and what is asked beside s, NaN where it is not known.

    ``points`` are the distinct ones of these places, and ``found`` their values.
    """
    arrays = {name: found[name][points.index] for name in SOLVED}
    for row in asked.rows:
        nothing = np.full((len(points.rows), *(asked.sizes[dim] for dim in row.dims)), np.nan)
        arrays |= {name: found.get(name, nothing)[points.index] for name in row.variables}
    return turned(arrays, points.mirrored, grid, np.arange(grid.size) if places is None else places)


def turned(
    arrays: Mapping[str, NDArray[Any]],
    mirrored: BoolArray,
    grid: Grid,
    places: IndexArray,
    per_cycle: np.ufunc = np.multiply,
) -> dict[str, NDArray[Any]]:
    """Values at n places of a grid from values of distinct points; and back, with ``np.divide``.

    Where a point is mirrored, places and angles have the other sign. A load cycle lasts for the common period
    2πq/ω1 of the point's own frequencies. The distinct point of a resting normal load has ω2 = ω1: its
    tangential load passes once, and p times in that period. + 0.0 removes the sign of zero.
    """
    found = dict(arrays)
    for name in ("critical_x", "critical_angle", *(n for n, row in QUANTITIES.items() if row.is_place)):
        if name in found:
            flips = mirrored.reshape(-1, *(1,) * (found[name].ndim - 1))
            found[name] = np.where(flips, -found[name], found[name]) + 0.0
    if {*STICK_ENDS} <= found.keys():
        left, right = (found[name] for name in STICK_ENDS)
        ends = np.where(mirrored, -right, left) + 0.0, np.where(mirrored, -left, right) + 0.0
        found |= zip(STICK_ENDS, ends, strict=True)
    angle = found["critical_angle"]
    found["critical_angle"] = np.where(angle <= -90, angle + 180, angle)
    for name in (n for row in QUANTITIES.values() if row.per_cycle for n in row.variables if n in found):
        amplitude, load, p = grid.at(places, "normal_amplitude", "load", "p")
        cycles = np.where((amplitude == 0.0) & (load == code_of(HARMONIC, "load")), p, 1.0)
        found[name] = per_cycle(found[name], cycles.reshape(-1, *(1,) * (found[name].ndim - 1)))
    return found


def _name_criteria(dataset: xr.Dataset, grid: Grid, asked: Request) -> None:
    """Say of s and of what is made of it which criterion it is, unless it is the paper's."""
    criteria = list(dict.fromkeys(map(str, grid.values("criterion"))))
    if criteria == [SWT]:
        return
    single = len(criteria) == 1
    words = "; ".join(f"{name}: " * (not single) + CRITERIA[name].meaning for name in criteria)
    dataset.s.attrs |= {
        "long_name": f"{criteria[0].replace('_', ' ')} parameter s" if single else "s by its criterion",
        "comment": f"{words}; on the surface line y = 0: {BENEATH}",
        "criterion": " ".join(criteria),
    }
    value = CRITERIA[criteria[0]].values if single else "criterion"
    for name in asked.variables:
        own = dataset[name].attrs
        own |= {key: with_values_of(own[key], value) for key in ("long_name", "comment")}
        own["symbol"] = own["symbol"].replace(r"\mathrm{SWT}", "s")


def values_along(grid: Grid, dim: str) -> NDArray:
    """Values along a dimension of a grid."""
    if values := grid.values(dim):
        return plain_values(values)
    return np.array(grid.sample_labels or range(grid.sizes[dim]))


def plain_values(values: tuple[Value, ...]) -> NDArray:
    """Values of a parameter as numbers, or as texts if some are names."""
    if any(isinstance(value, str | Definition) for value in values):
        return np.array([str(value) for value in values], dtype=object)
    return np.array([as_number(value) for value in values])


def _attributes(parameter: Parameter, values: tuple[Value, ...]) -> dict[str, str]:
    short = len(parameter.meaning) <= _LONGEST_NAME
    name = parameter.meaning if short else parameter.name.replace("_", " ")
    attributes = {"long_name": name, "comment": parameter.meaning, "symbol": parameter.symbol}
    if parameter.kind != "name":
        attributes["units"] = parameter.units
    if isinstance(values[0], Fraction):
        attributes["fractions"] = " ".join(map(str, values))
    return attributes


def margins(
    grid: Grid, points: Distinct | None = None, without_compiler: bool = False
) -> dict[str, NDArray[Any]]:
    """Data variables of the points of a grid, each of shape (grid.size,), by `Grid.margins`.

    ``bulk_shift`` as long as it is no larger than the width of the slip zone. Without a compiler they are
    known to 1e-5. ``points`` are the distinct points of the grid, if they are known.
    """
    if not (grid.margins and grid.size):
        return {}
    points = points or Distinct.of(grid)
    found = {name: own[points.index] for name, own in _margins_of(points, without_compiler).items()}
    names = "curvature", "face", "slip_scale", "body_share", "bulk_stress_amplitude"
    curvature, face, slip, share, pull = grid.at(np.arange(grid.size), *names)
    # The stick zone is both bodies', whichever of them carries the bulk stress.
    shift = np.where(pull == 0.0, 0.0, found["unit_shift"] * pull * np.abs(share))
    radius = found["contact_radius"]
    width = radius - found["stick_radius"]  # of the slip zone
    with np.errstate(divide="ignore", invalid="ignore"):
        told: dict[str, NDArray] = {
            "stick_zone": found["stick_zone"].astype(np.int8),
            "bulk_shift": np.where(shift <= width, shift, np.nan),
            "bulk_shift_ratio": shift / width,
            "prescribed_force_ratio": found["force_ratio"],
            "radius_ratio": (radius - face) * curvature,
            "slide_ratio": found["slide"] * slip / radius,
        }
    return {name: told[name] for name in grid.margins}


def _margins_of(points: Distinct, without_compiler: bool) -> dict[str, NDArray[Any]]:
    """Margins of distinct points in the units of the solver, and ``stick_zone``."""
    from swtstudy.solver.margins import foreseen, margins_of

    found: dict[str, NDArray[Any]] = {}
    for rows in alike(points.rows):
        for some in np.array_split(rows, len(rows) // _TOGETHER + 1):
            own = points_from(points.rows[some], points.definitions)
            with np.errstate(all="ignore"):
                made = foreseen(own) if without_compiler else margins_of(own)
            approximately = 1.0 + (not is_plane(own.profile))
            made["stick_zone"] = np.where(made["moved"] > 0.0, np.maximum(made["moved"], approximately), 0.0)
            for name, values in made.items():
                found.setdefault(name, np.full(len(points.rows), np.nan))[some] = values
    return found


def foreseen_lines(grid: Grid) -> tuple[str, ...]:
    """The lines on validity that results of a grid will have whatever their s; none of a very large grid.

    They tell tangential forces above μ F_N, contacts too large for half-spaces, and bulk strains that shift
    the stick zone: limits of the model that loads alone tell, before a point is solved.
    """
    if grid.size > MOST_FORESEEN or not grid.margins:
        return ()
    found = margins(grid, without_compiler=True)
    lost = found.get("prescribed_force_ratio", np.zeros(grid.size)) > 1.0 + ROUNDING
    states = [REGIMES.index(name) for name in ("no_equilibrium", "stick")]
    arrays = {name: np.full(grid.size, np.nan) for name in SOLVED}
    arrays["regime"] = np.where(lost, *states).astype(np.int8)
    return tuple(str(label(grid, arrays | found, Request()).attrs.get("validity", "")).splitlines())
