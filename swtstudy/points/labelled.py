"""Plain arrays as the Dataset that users see, with names, units, meanings and margins of the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from fractions import Fraction
from types import MappingProxyType
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points import requested
from swtstudy.points.canonical import alike, points_from
from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.records import STATES, Records
from swtstudy.points.unique import UniquePoints, columns_at
from swtstudy.points.validity import validity_lines
from swtstudy.points.values import Value, as_number
from swtstudy.solver.points import Solution
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.choices import BENEATH, MEANING, REGIMES, SWT, WORDS, is_plane, with_values_of
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import CONTROLS, SHIFT
from swtstudy.vocabulary.quantities import DISTANCE, NOTHING, Request, attributes_of

#: xarray breaks the labels of its own plots after 30 characters, including the unit.
_LONGEST_NAME = 24

#: Points whose margins are found together: the working memory for one is some kB.
_TOGETHER = 2000

#: Where the stick zone is in s, under a bulk stress that moves.
ZONES = ("in_place", "moved", "moved_approximately")
#: Data variables that results have where something is given that they are about.
MARGINS = (
    "stick_zone",
    "bulk_shift",
    "bulk_shift_ratio",
    "prescribed_force_ratio",
    "radius_ratio",
    "slide_ratio",
)
#: Attributes of the data variables, following the CF conventions. Long names are short, since xarray's plots
#: use them as labels. The unit 1 is left out of a Dataset.
ATTRIBUTES: dict[str, dict[str, Any]] = {
    "s": {
        "long_name": "SWT parameter SWT/SWT0",
        "units": "1",
        "symbol": r"s",
        "ancillary_variables": "s_error regime s_surface",
        "comment": (
            "maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R; "
            "one elastic half-space with E*, G* against a rigid indenter"
        ),
    },
    "s_error": {
        "long_name": "absolute error of s",
        "comment": "estimated",
        "units": "1",
        "symbol": r"\Delta s",
    },
    "s_surface": {
        "long_name": "s on the surface circle",
        "comment": "s over the circle on the surface through the critical point and over all planes; "
        "in plane contacts s itself",
        "units": "1",
        "symbol": r"s_\mathrm{surface}",
    },
    "stick_zone": {
        "long_name": "stick zone in s",
        "comment": "whether s and all beside it have the stick zone moved by the bulk stress: exactly, of a "
        "cylinder, or approximately, of a paraboloid, where the rise of the stress at the edge in tension is "
        "right within 4 %; it is in place where that is asked for, and where its motion is not known",
        "flag_values": np.arange(len(ZONES), dtype=np.int8),
        "flag_meanings": " ".join(ZONES),
    },
    "bulk_shift": {
        "long_name": "shift of the stick zone",
        "comment": "by the strain of the bulk stress, in a_H: where stick_zone is in_place, s leaves it out "
        "and is too low at the edge in tension, see bulk_shift_ratio; NaN for other profiles than the "
        "paraboloid and the cylinder, without friction or stick, and where it exceeds the width of the slip "
        "zone",
        "units": "1",
        "symbol": r"e/a_H",
    },
    "bulk_shift_ratio": {
        "long_name": "shift over slip zone",
        "comment": "shift of the stick zone by the strain of the bulk stress over the width of the slip "
        "zone, however large: where stick_zone is in_place, s leaves it out and is too low at the edge in "
        "tension, it should be up to 6 % at 0.1, 24 % at 0.5 and 38 % at 1 higher for Q >= 0.2 mu P; NaN as "
        "the shift, without a permanent stick zone",
        "units": "1",
        "symbol": r"e/(a - c)",
    },
    "prescribed_force_ratio": {
        "long_name": "prescribed force ratio",
        "comment": "largest |F_x| over mu F_N that is prescribed in a cycle: above 1 there is no equilibrium",
        "units": "1",
        "symbol": r"\max |F_x|/(\mu F_N)",
    },
    "radius_ratio": {
        "long_name": "contact radius over R",
        "comment": "largest contact radius of a cycle, half the width in plane contacts, over the radius R; "
        "of a table over that of the paraboloid with its contact radius and depth at rest",
        "units": "1",
        "symbol": r"a_\mathrm{max}/R",
    },
    "slide_ratio": {
        "long_name": "slide over contact radius",
        "comment": "by how much the tangential displacement exceeds the limit of partial slip, over the "
        "largest contact radius of a cycle; 0 without gross slip, NaN where the bodies part",
        "units": "1",
        "symbol": r"(u_\mathrm{A} - u_\mathrm{slip})/a_\mathrm{max}",
    },
    "critical_x": {
        "long_name": "critical point x/a_H",
        "comment": "position of the critical point on the surface, in units of a_H = sqrt(R delta0); NaN "
        "where s is 0, not finite or that of the bulk stress alone: no point is critical there",
        "units": "1",
        "symbol": r"x/a_H",
    },
    "critical_angle": {
        "long_name": "critical plane angle",
        "comment": "angle of the normal of the critical plane against the x axis, in (-90, 90]; NaN where "
        "s is 0 or not finite: no plane is critical there",
        "units": "degree",
        "symbol": r"\varphi",
    },
    "regime": {
        "long_name": "regime of the contact",
        "comment": "over the stationary cycle; in Python dataset.swt.words() gives its words",
        "flag_values": np.arange(len(REGIMES), dtype=np.int8),
        "flag_meanings": " ".join(REGIMES),
    },
    "status": {
        "long_name": "state of the point",
        "comment": "whether the point has been computed",
        "flag_values": np.arange(len(STATES), dtype=np.int8),
        "flag_meanings": " ".join(STATES),
    },
    "run": {
        "long_name": "run that made the value",
        "comment": "an index into the attribute runs; -1 if missing",
        "units": "1",
    },
}


def label(
    grid: Grid,
    arrays: dict[str, NDArray],
    asked: Request = NOTHING,
    columns: Mapping[str, NDArray] = MappingProxyType({}),
) -> xr.Dataset:
    """The Dataset of a grid.

    Parameters
    ----------
    grid
        Names and values of the dimensions.
    arrays
        Data variables by name, each of shape (grid.size,) in C order.
    asked
        What was asked beside s.
    columns
        Its values by `swtstudy.vocabulary.quantities.columns_of`, each of shape (grid.size,).

    Returns
    -------
    xarray.Dataset
        With units, if the grid is one of real contacts.
        Dimensions in the order of the grid's; single-valued parameters are scalar coordinates, but for
        optional ones at their default; those of a sample are coordinates along its dimension, which numbers
        its points. The coordinate ``control`` says what is prescribed.
    """
    coordinates: dict[str, Any] = {
        name: (grid.dimension(name), _values(values), _attributes(grid.row(name), values))
        for name, values in (grid.samples | grid.axes).items()
    }
    if grid.samples:
        coordinates[SAMPLE] = (SAMPLE, np.arange(grid.shape[0]), {"long_name": "number of the point"})
        coordinates[SAMPLE][2]["parameters"] = " ".join(grid.samples)
    for name, value in grid.fixed.items():
        says = name == SHIFT and "stick_zone" in grid.margins
        if says or not grid.row(name).goes_without_saying(value):
            coordinates[name] = ((), _values((value,))[0], _attributes(grid.row(name), (value,)))
    coordinates["control"] = control_coordinate(grid)
    variables = {
        name: (grid.dims, array.reshape(grid.shape), dict(ATTRIBUTES[name])) for name, array in arrays.items()
    }
    for name, (dims, values) in requested.variables(asked, columns).items():
        shaped = values.reshape((*grid.shape, *values.shape[1:]))
        variables[name] = (*grid.dims, *dims), shaped, attributes_of(name)
    dataset = xr.Dataset(variables, coordinates | requested.coordinates(asked, grid.row(DISTANCE)))
    _name_criteria(dataset, grid, asked)
    dataset = grid.presented(dataset, asked)
    for variable in dataset.variables.values():
        # By the CF conventions what has no unit has no dimension; with the unit 1 xarray's labels end in [1].
        if variable.attrs.get("units") == "1":
            del variable.attrs["units"]
    lines = validity_lines(dataset) if "regime" in arrays else ()
    return dataset.assign_attrs(validity="\n".join(lines)) if lines else dataset


def label_records(
    grid: Grid, points: UniquePoints, records: Records, asked: Request, of_runs: bool = True
) -> xr.Dataset:
    """The Dataset of a grid whose distinct points have these records; ``of_runs`` with status and run."""
    arrays = arrays_of(records.solution[points.index], points.mirrored) | margins(points, grid)
    if of_runs:
        arrays |= {"status": records.status[points.index], "run": records.run[points.index]}
    return label(grid, arrays, asked, columns_at(grid, asked, points, records.quantity))


def _name_criteria(dataset: xr.Dataset, grid: Grid, asked: Request) -> None:
    """Say of s and of what is made of it which criterion it is, unless it is the paper's."""
    criteria = list(dict.fromkeys(map(str, grid.values("criterion"))))
    if criteria == [SWT]:
        return
    single = len(criteria) == 1
    words = MEANING[criteria[0]] if single else "; ".join(f"{name}: {MEANING[name]}" for name in criteria)
    dataset.s.attrs |= {
        "long_name": f"{criteria[0].replace('_', ' ')} parameter s" if single else "s by its criterion",
        "comment": f"{words}; on the surface line y = 0: {BENEATH}",
        "criterion": " ".join(criteria),
    }
    value = WORDS[criteria[0]] if single else "criterion"
    for name in asked.variables:
        own = dataset[name].attrs
        own |= {key: with_values_of(own[key], value) for key in ("long_name", "comment")}
        own["symbol"] = own["symbol"].replace(r"\mathrm{SWT}", "s")


def zones(moved: FloatArray, grid: Grid) -> NDArray[np.int8]:
    """Index into `ZONES` of each point of a grid, from where the stick zone is moved, (grid.size,)."""
    plane = [is_plane(value) for value in grid.values("profile")]
    dim = grid.dimension("profile")
    if dim is None:
        of_points: NDArray = np.full(grid.size, plane[0])
    else:
        place = np.unravel_index(np.arange(grid.size), grid.shape)[grid.dims.index(dim)]
        of_points = np.array(plane)[place]
    return np.where(moved == 1.0, np.where(of_points, 1, 2), 0).astype(np.int8)


def control_coordinate(grid: Grid) -> xr.Variable:
    """The scalar coordinate ``control``: what is prescribed on a grid."""
    attributes = {"long_name": "what is prescribed", "comment": f"one of {', '.join(CONTROLS.values())}"}
    return xr.Variable((), grid.control.name, attributes)


def arrays_of(solution: Solution, mirrored: BoolArray) -> dict[str, NDArray]:
    """Data variables of points, from the solutions of their canonical points, mirrored back where needed."""
    angle = np.where(mirrored, -solution.critical_angle, solution.critical_angle)
    return {
        "s": solution.s,
        "s_error": solution.s_error,
        # + 0.0 removes the sign of zero.
        "critical_x": np.where(mirrored, -solution.critical_x, solution.critical_x) + 0.0,
        "critical_angle": np.where(angle <= -90, angle + 180, angle) + 0.0,
        "regime": solution.regime,
        "s_surface": solution.s_surface,
    }


def _values(values: tuple[Value, ...]) -> NDArray:
    if any(isinstance(value, str | Definition) for value in values):
        return np.array([str(value) for value in values], dtype=object)
    return np.array([as_number(value) for value in values])


def _attributes(parameter: Parameter, values: tuple[Value, ...]) -> dict[str, str]:
    short = len(parameter.meaning) <= _LONGEST_NAME
    attributes = {
        "long_name": parameter.meaning if short else parameter.name.replace("_", " "),
        "comment": parameter.meaning,
        "symbol": parameter.symbol,
    }
    if parameter.kind != "name":
        attributes["units"] = parameter.units
    if isinstance(values[0], Fraction):
        attributes["fractions"] = " ".join(map(str, values))
    return attributes


def margins(points: UniquePoints, grid: Grid, foreseen: bool = False) -> dict[str, NDArray]:
    """Data variables of the points of a grid, each of shape (grid.size,), by `Grid.margins`.

    ``bulk_shift`` as long as it is no larger than the width of the slip zone. Those that are ``foreseen`` are
    known without a compiler, to 1e-5.
    """
    from swtstudy.solver.margins import Margins

    names = grid.margins
    if not names:
        return {}
    of = Margins.foreseen if foreseen else Margins.of
    every = np.full((len(fields(Margins)), len(points.table)), np.nan)
    for rows in alike(points.table):
        for some in np.array_split(rows, len(rows) // _TOGETHER + 1):
            with np.errstate(all="ignore"):
                found_here = of(points_from(points.table[some], points.definitions))
            every[:, some] = list(vars(found_here).values())
    radius, stick, shift, ratio, slide, moved = every[:, points.index]
    width = radius - stick  # of the slip zone
    if "bulk_shift" in names:
        shift = shift * np.abs(grid.strain_shares)
    with np.errstate(divide="ignore", invalid="ignore"):
        found = {
            "stick_zone": zones(moved, grid),
            "bulk_shift": np.where(shift <= width, shift, np.nan),
            "bulk_shift_ratio": shift / width,
            "prescribed_force_ratio": ratio,
        }
    if "radius_ratio" in names:
        found["radius_ratio"] = radius * grid.curvatures
    if "slide_ratio" in names:
        found["slide_ratio"] = slide * grid.slip_scales / radius
    return {name: found[name] for name in names}
