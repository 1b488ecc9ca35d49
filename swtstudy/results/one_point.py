"""One parameter point from keywords, as given, and positions and instants in it as labelled arrays."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.kernel.field import Opened, open_cycle
from swtstudy.points.grid import canonical_points, points_from
from swtstudy.points.reading import read_grid
from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.margins import margins_of
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.definition import read_numbers
from swtstudy.vocabulary.mistakes import Report, StudyError, literal, refused
from swtstudy.vocabulary.parameters import PAIRS

#: Positions of one field: the values of each take 0.1 to 10 kB.
LARGEST_FIELD = 10_000_000


def read_point(parameters: Mapping[str, object]) -> Points:
    """A batch of one point.

    Parameters
    ----------
    parameters
        Single values by name, as for `swtstudy.solve`; the others have the values of Table 1.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters.
    """
    grid, mistakes = read_grid(dict(parameters), {})
    if grid is None:
        raise StudyError(mistakes)
    return points_from(canonical_points(grid, np.zeros(1, int), fold=False)[0], grid.definitions)


def read_cycle(parameters: Mapping[str, object]) -> LoadCycle:
    """The stationary load cycle of one point, for what is on the surface line; see `read_point`.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or if there is no equilibrium.
    """
    cycle = LoadCycle(read_point(parameters))
    if not cycle.equilibrium:
        raise _no_equilibrium(cycle.points, parameters)
    return cycle


def open_point(parameters: Mapping[str, object]) -> tuple[Points, Opened]:
    """A batch of one point, see `read_point`, and its load cycle in the kernel.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or if there is no equilibrium.
    """
    points = read_point(parameters)
    opened = open_cycle(**arguments_of(points))
    if opened is None:
        raise _no_equilibrium(points, parameters)
    return points, opened


def _no_equilibrium(points: Points, parameters: Mapping[str, object]) -> StudyError:
    """The force that friction does not carry, the normal force that pulls, or bodies that never touch."""
    control, ratio = points.control, float(margins_of(points)["force_ratio"][0])
    if not (control.tangential_force or control.normal_force):
        found = f"{literal(parameters['normal_amplitude'])}, at which the bodies never touch"
        return refused("normal_amplitude", found, "an indentation depth above 0 at some instant")
    pairs = (control.given_for("tangential_amplitude"), control.given_for("normal_amplitude"))
    name = next(name for name in pairs if name in PAIRS)
    found = f"{literal(parameters[name])}, at which the body slides away or is lifted off (no equilibrium)"
    if ratio > 1.0:
        found += f": |F_x| is up to {ratio:.3g} μ F_N"
    return refused(name, found, "forces with |F_x| ≤ μ F_N and F_N ≥ 0 at every instant")


#: Meanings of x, y and z.
_MEANINGS = ("position in the direction of sliding", "position across the direction of sliding", "depth")
#: Allowed coordinates, in words.
POSITIONS = "finite positions in a_H"


def read_places(
    x: Any, y: Any, z: Any, allowed: str = POSITIONS
) -> tuple[dict[str, xr.DataArray], tuple[Hashable, ...], FloatArray]:
    """Coordinates in a_H.

    Parameters
    ----------
    x, y, z
        Numbers; one-dimensional sequences, which span a grid with the dimensions x, y, z; or DataArrays,
        whose dimensions are kept: three DataArrays that share one dimension are a list of points.
    allowed
        Allowed values, in words.

    Returns
    -------
    given, dims, places
        The coordinates by name, with dimensions of their own; the dimensions of all of them; and the
        coordinates broadcast against one another, of shape (..., 3).

    Raises
    ------
    StudyError
        A ValueError, if a coordinate is not a finite number, z is negative, DataArrays have different
        coordinates along a shared dimension, or there are more than `LARGEST_FIELD` positions.
    """
    arrays: list[xr.DataArray] = []
    report = Report()
    for name, words, values in zip("xyz", _MEANINGS, (x, y, z), strict=True):
        with report:
            labelled = isinstance(values, xr.DataArray)
            numbers = read_numbers(name, values.values if labelled else values, allowed)
            if numbers.ndim > 1 and not labelled:
                raise refused(name, f"{numbers.ndim} dimensions", "a number, a sequence or a DataArray")
            if numbers.size == 0 or not np.isfinite(numbers).all():
                raise refused(name, "no or not finite values", allowed)
            if not labelled:
                values = xr.DataArray(numbers, dims=(name,) * numbers.ndim)
            meaning = named(f"{words}, in units of a_H = sqrt(R delta0)", rf"{name}/a_H")
            arrays.append(values.copy(data=numbers).assign_attrs(meaning))
    report.refuse()
    if float(arrays[2].min()) < 0.0:
        found = f"{float(arrays[2].min()):g}"
        raise refused("z", found, "depths z ≥ 0 into the body")
    count = math.prod({dim: size for each in arrays for dim, size in each.sizes.items()}.values())
    if count > LARGEST_FIELD:
        allowed = f"at most {LARGEST_FIELD:,}; sequences span a grid: for a list of points give DataArrays"
        raise refused("x, y, z", f"{count:,} positions", f'{allowed} such as xr.DataArray(x, dims="place")')
    try:
        placed = xr.broadcast(*xr.align(*arrays, join="exact"))
    except ValueError as error:
        found = f"DataArrays that do not fit together ({str(error).splitlines()[0]})"
        allowed = "the same coordinates along the dimensions that they share"
        raise refused("x, y, z", found, allowed) from None
    places = np.stack([place.values for place in placed], axis=-1)
    return dict(zip("xyz", arrays, strict=True)), placed[0].dims, places


def read_finite(name: str, values: object, allowed: str) -> FloatArray:
    """A finite number, or a one-dimensional sequence of them, one at least; the sign is not checked."""
    array = read_numbers(name, values, allowed)
    if array.ndim > 1 or array.size == 0 or not np.isfinite(array).all():
        raise refused(name, literal(values), allowed)
    return array


def named(meaning: str, symbol: str) -> dict[str, str]:
    """Attributes of a non-dimensional variable."""
    return {"long_name": meaning, "units": "1", "symbol": symbol}


def read_instants(points: Points, time: object) -> xr.DataArray:
    """ω1 t in rad, a number or a one-dimensional sequence, as `labelled_time` of the points."""
    given = read_finite("time", time, "a finite number or a sequence of them, ω1 t in rad")
    return labelled_time(points, given, ("time",) * given.ndim)


def turns_of(points: Points) -> int:
    """Ratio of ω1 t to the angle of the common period: q of ω2/ω1 = p/q; 1 for a loop, which has no ω1."""
    return 1 if points.path is not None else int(points.q[0])


def labelled_time(points: Points, time: FloatArray, dims: tuple[Hashable, ...]) -> xr.DataArray:
    """Instants as a labelled array: ω1 t of harmonic loads, else angles of the period of a loop."""
    loop = points.path is not None
    words, symbol = ("angle of the period", r"\varphi") if loop else ("omega1 t", r"\omega_1 t")
    attributes = {"long_name": f"{words}, in the stationary cycle", "units": "rad", "symbol": symbol}
    return xr.DataArray(time, dims=dims, attrs=attributes)
