"""s for named parameters, computed in threads of this process."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points.chunk import Arrays, blank, cut, fill, put, task_of
from swtstudy.points.grid import Distinct, Grid, check_count
from swtstudy.points.labelled import label, margins, values_at
from swtstudy.points.reading import listed, read_distances, read_grid, spanned
from swtstudy.points.rules import doubts
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.mistakes import DEFAULT_RTOL, Report, StudyError
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS, QUANTITY_AXES
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import DISTANCE, SOLVED, Request, read_quantities
from swtstudy.vocabulary.version import __version__


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
