"""Stress histories of finite elements: from a table of a user to criteria, critical planes and lives."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Iterable
from itertools import chain
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from swtstudy.points.validity import extrapolated
from swtstudy.points.values import read_exact
from swtstudy.results.history import TINY, criterion_of_history, longest_chord, swt_of_history
from swtstudy.study.column_units import unit_said, wrong_unit
from swtstudy.study.columns import UserTable, read_table, unknown_names
from swtstudy.study.definition import tables_of
from swtstudy.study.keys import FileTable, with_keys
from swtstudy.study.units.grid import ContactDetails
from swtstudy.study.units.material import read_given, two_of
from swtstudy.study.units.rows import KNOWN, OF_BODIES, read_units, unit_factor
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import FATEMI_SOCIE, FINDLEY, SWT
from swtstudy.vocabulary.mistakes import Report, literal, nearest, refused

#: The stress components in our order, and those that plane elements lack.
COMPONENTS, ACROSS = ("xx", "yy", "zz", "yz", "xz", "xy"), ("yz", "xz")
#: Headers of the components in the order of programs.
ORDERS = {
    "swtstudy": COMPONENTS,
    "abaqus": ("S11", "S22", "S33", "S12", "S13", "S23"),
    "ansys": ("SX", "SY", "SZ", "SXY", "SYZ", "SXZ"),
}
_HEADERS = " or ".join(map(", ".join, ORDERS.values()))
#: Axes of a component in a header, in small letters, and what stands before them; a normal stress may have
#: one axis alone.
_COMPONENT = re.compile(
    r"(?:s|sig|sigma|t|tau|stress)*([xyz]{2})|(?:s|sig|sigma|t|tau|stress)+([123]{2}|[xyz])"
)
STEP, ID, POSITION = "step", "id", ("x", "y", "z")
#: Stress over Young's modulus that no metal sustains.
MOST_STRAIN = 0.05
#: Other headers of steps and points, in small letters, as finite elements write them.
ALIASES = {
    **dict.fromkeys(("frame", "increment", "substep"), STEP),
    **dict.fromkeys(("node", "node label", "node number", "element", "element label"), ID),
}
#: How the files end that results at points are written to.
ENDINGS = (".csv", ".vtu", ".nc")


@with_keys(FileTable)
def read_history(path: str | PathLike[str], *, order: str | None = None, **form: Any) -> xr.Dataset:
    """Stress histories at points, from a table with a row for each point and step.

    Parameters
    ----------
    path
        The file: columns ``step``, six components, and ``id`` or ``x``, ``y``, ``z`` or both, in any order.
    order
        "swtstudy" for xx, yy, zz, yz, xz, xy, "abaqus" for S11, S22, S33, S12, S13, S23 or "ansys" for SX,
        SY, SZ, SXY, SYZ, SXZ. Found from the headers unless given: S12, SXY, sigma_xy and xy are one. With
        headers that do not say it the other six columns are taken in that order.
    columns, separator, decimal, encoding, scale, skip_rows, units_row, sheet
        As of `swtstudy.read_signal`.

    Returns
    -------
    xarray.Dataset
        ``stress`` over point, step and component, in our order, and the coordinates of the points.

    Raises
    ------
    StudyError
        A ValueError with what is wrong, and where in the file.
    """
    given = FileTable.of(form)
    if order not in (None, *ORDERS):
        raise refused("order", literal(order), nearest(str(order), ORDERS, {}))
    table = read_table(Path(path), (STEP,), (ID, *POSITION, *chain(*ORDERS.values())), given, aliases=ALIASES)
    stress, unit = _components(table, order)
    if not len(stress):
        raise refused("", "no rows", "a row for each step of each point", table.source)
    positions = [name for name in POSITION if table.has(name)]
    place = table.numbers(positions) if positions else np.zeros((len(stress), 0))
    names = table.texts(ID) if table.has(ID) else list(map(str, map(tuple, place.tolist())))
    rank, labels = pd.factorize(np.array(names))  # points in the order of the file
    counts = np.bincount(rank)
    if counts.min() != counts.max():
        found = f"{counts.min()} steps at the point {labels[counts.argmin()]}, {counts.max()} at others"
        raise refused("", found, "as many steps at each point", str(path))
    steps = table.numbers([STEP])[:, 0]
    rows = np.lexsort([steps, rank]).reshape(len(counts), -1)
    for point, k in np.argwhere(np.diff(steps[rows]) == 0.0)[:1]:
        where = f" at the point {labels[point]}" * (len(labels) > 1)
        allowed = f"each step once at a point; {ID}, or {', '.join(POSITION)}, of each point"
        raise refused("", f"step {steps[rows[point, k]]:g} in several rows{where}", allowed, table.source)
    one_id = f"rows of one point have the same {ID}, whatever its coordinates"
    if rows.shape[1] == 1:
        words = "one step at each point, which is no load cycle"
        warnings.warn(f"{path}: {words}: {one_id}", stacklevel=2)
    elif (other := np.flatnonzero((steps[rows] != steps[rows[0]]).any(axis=1))).size:
        found = f"other steps at the point {labels[other[0]]} than at {labels[0]}"
        raise refused("", found, f"the same steps at each point; {one_id}", table.source)
    coords: dict[str, Any] = {name: ("point", place[rows[:, 0], k]) for k, name in enumerate(positions)}
    if table.has(ID):
        coords[ID] = "point", labels
    unit_of = {"units": unit} if unit else {}
    variables = {"stress": (("point", STEP, "component"), stress[rows], unit_of)}
    return xr.Dataset(variables, {"component": [*COMPONENTS], **coords}, {"source": str(path)})


def component_of(header: str) -> str | None:
    """The component of stress that a header names, such as xy of S12, "Sigma_xy [MPa]" or TXY; or None."""
    plain = re.sub(r"[\[(].*|[^a-z0-9]", "", header.lower())
    if not (found := _COMPONENT.fullmatch(plain)):
        return None
    axes = (found[1] or found[2]).translate(str.maketrans("123", "xyz"))
    return "".join(sorted(axes * 2 if len(axes) == 1 else axes))


def _components(table: UserTable, order: str | None) -> tuple[FloatArray, str]:
    """The stress components in our order, shape (rows, 6), and their unit; empty if unknown."""
    renamed = {table.form.header(name): name for name in table.form.columns}
    others = {table.form.header(name) for name in (STEP, ID, *POSITION)}
    names = [renamed.get(header, header) for header in table.headers if header not in others]
    own = {name: found for name in names if (found := component_of(name))}
    place = f"line {table.line}"
    for component in COMPONENTS:
        if len(twice := [name for name in own if own[name] == component]) > 1:
            raise refused(place, f"{' and '.join(twice)}, each {component}", "one of them", table.source)
    if {*own.values()} not in ({*COMPONENTS}, {*COMPONENTS} - {*ACROSS}):
        if order is None:
            lacking = [component for component in COMPONENTS if component not in own.values()]
            words = f"no {' or '.join(lacking)} among " if own else ""
            allowed = f"columns {_HEADERS}; of plane elements without the two across; with other headers an "
            allowed += f"order of six columns, {' or '.join(ORDERS)}"
            raise refused(place, words + ", ".join(table.headers), allowed, table.source)
        if len(names) != len(COMPONENTS):
            allowed = f"six columns of components beside {STEP}, {ID} and the coordinates"
            raise refused(place, ", ".join(names), allowed, table.source)
        own = dict(zip(names, map(str, map(component_of, ORDERS[order])), strict=True))
    elif order is not None and [*own.values()] != [*map(component_of, ORDERS[order])]:
        allowed = f"no order: the headers {', '.join(own)} name the components"
        raise refused("order", literal(order), allowed, table.source)
    unknown_names(table.form, (STEP, ID, *POSITION, *own)).refuse()
    values = np.zeros((len(table.cells), len(COMPONENTS)))
    values[:, [COMPONENTS.index(name) for name in own.values()]] = table.numbers([*own])
    if lacking := [name for name in COMPONENTS if name not in own.values()]:
        warnings.warn(f"{table.source}: {' = '.join(lacking)} = 0, of plane elements", stacklevel=4)
    return values, _unit_of(table, own)


def _unit_of(table: UserTable, names: Iterable[str]) -> str:
    """The unit of columns of stresses, scaled; empty if none is said, or if ``scale`` is 1 for each."""
    report, known, scale = Report(), KNOWN["stress"], table.form.scale
    sizes: dict[str, float] = {}
    for name in names:
        report += wrong_unit(table, name, "stress", "")
        if (unit := unit_said(table, name, "stress")[0]) in known:
            sizes[name] = known[unit] / abs(scale.get(name, 1.0))
    report.refuse()
    if not sizes or all(scale.get(name) == 1.0 for name in names):
        return ""
    least, largest = min(sizes, key=sizes.__getitem__), max(sizes, key=sizes.__getitem__)
    if not math.isclose(sizes[least], sizes[largest]):
        found = " and ".join(
            f"{literal(table.form.header(name))} times {scale.get(name, 1):g}" for name in (least, largest)
        )
        raise refused("scale", found, "factors that give one unit of all components", table.source)
    units = [unit_said(table, least, "stress")[0], *known]
    return next((unit for unit in units if math.isclose(known[unit], sizes[least])), "")


def evaluate_history(
    history: xr.Dataset | str | PathLike[str], study: str | PathLike[str], body: int = 1
) -> xr.Dataset:
    """Criteria, critical planes and lives of stress histories, one load cycle each.

    Parameters
    ----------
    history
        From `read_history`, or the path of its table.
    study
        A study file with [units], and young_modulus and poisson_ratio among its fixed values. Constants in
        [material] give lives; normal_sensitivity gives the criteria of shear.
    body
        The body whose properties count, 1 or 2.

    Returns
    -------
    xarray.Dataset
        Over point: ``SWT``, ``FS`` and ``findley_stress`` as far as their properties are given, each with the
        unit normal of its plane (``SWT_normal`` and so on); ``cycles`` and ``FS_cycles``, load cycles to a
        crack by the cycles that rainflow closes on that plane, with the attribute validity where they are
        beyond the range of their constants; ``findley_usage``.

    Raises
    ------
    StudyError
        A ValueError with every mistake.
    """
    details, own = _properties(study, body)
    given = history if isinstance(history, xr.Dataset) else read_history(history)
    young, poisson = own["young_modulus"], own["poisson_ratio"]
    stress = _in_our_order(given, details.units.stress)
    unit = {"units": details.units.stress}
    if (largest := float(np.abs(stress).max(initial=0.0))) > MOST_STRAIN * young:
        words = f"stresses up to {largest:.4g} {unit['units']} are {largest / young:.3g} of young_modulus"
        doubt = "are they in another unit? A row of units, or a header, says it"
        warnings.warn(f"{words}: {doubt}", stacklevel=2)
    found = given.drop_dims("component")
    gamma, sensitivity = own.get("walker_exponent", 0.5), own.get("normal_sensitivity")

    def add(name: str, value: FloatArray, normal: FloatArray, words: Any = None) -> None:
        found[name], found[f"{name}_normal"] = ("point", value, words), (("point", "axis"), normal)

    def add_lives(name: str, constants: Any, of: str, criterion: str, **parameters: float) -> None:
        counted = cycle_shares(stress, found[f"{of}_normal"].values, criterion, poisson, **parameters)
        one, pairs = np.zeros((1, 1)), zip(found[of].values, counted, strict=True)
        lives = np.array([float(constants.rounds(value, one + shares, one + 1.0)) for value, shares in pairs])
        _, beyond = extrapolated(name, lives[:, np.newaxis])
        found[name] = "point", lives, {"validity": beyond} if beyond else None

    add("SWT", *swt_of_history(stress, poisson, young, gamma), unit)
    if details.materials:
        add_lives("cycles", details.materials[body - 1], "SWT", SWT, walker_exponent=gamma)
    if sensitivity is None:
        return found
    value, normal = criterion_of_history(stress, FINDLEY, sensitivity)
    found["findley_stress"], found["findley_normal"] = ("point", value, unit), (("point", "axis"), normal)
    if details.findley_limits:
        found["findley_usage"] = "point", value / details.findley_limits[body - 1], {"units": "1"}
    if details.yield_strengths:
        kappa = sensitivity / details.yield_strengths[body - 1]
        value, normal = criterion_of_history(stress, FATEMI_SOCIE, kappa)
        add("FS", value * (2.0 + 2.0 * poisson) / young, normal)
        if torsion := details.constants(FATEMI_SOCIE, (poisson, poisson)):
            add_lives("FS_cycles", torsion[body - 1], "FS", FATEMI_SOCIE, normal_sensitivity=kappa)
    return found


def _in_our_order(history: xr.Dataset, unit: str) -> FloatArray:
    """The stress of a history, shape (points, steps, 6), in a unit of stress."""
    stress = history["stress"]
    factor = unit_factor("stress", stress.attrs.get("units", ""), unit)
    if "component" in stress.coords:
        labels = list(map(str, stress["component"].values))
        found = [component_of(label) for label in labels]
        if sorted(map(str, found)) != sorted(COMPONENTS):
            raise refused("component", ", ".join(labels), _HEADERS)
        stress = stress.assign_coords(component=found).sel(component=[*COMPONENTS])
    return np.asarray(stress.transpose("point", STEP, "component").values) * factor


def _properties(study: str | PathLike[str], body: int) -> tuple[ContactDetails, dict[str, float]]:
    """The materials of a study file, and the plain numbers among its fixed values, of one body."""
    tables: dict[str, Any] = {key: each for key, each in tables_of(study).items() if isinstance(each, dict)}
    report, details, fixed = Report(str(study)), ContactDetails(), tables.get("fixed", {})
    if "units" in tables:
        units, material = read_units(tables["units"], report), tables.get("material")
        details, _ = read_given(units, material, fixed, Path(study).parent, report)
    else:
        report("units", "nothing", "a table with length, force and stress")
    if body not in (1, 2):
        raise refused("body", literal(body), "1 or 2")
    own: dict[str, float] = {}
    for name in ("young_modulus", "poisson_ratio", "normal_sensitivity", "walker_exponent"):
        value = two_of(fixed.get(name))[body - 1]
        try:
            own |= {} if value is None else {name: float(read_exact(value))}
        except ValueError as error:
            report(f"fixed.{name}", f"{literal(value)} ({error})", "a number, or one for each body")
        if name in tables.get("axes", {}):
            report(f"axes.{name}", "an axis", f"one number in [fixed], {name} = …, for a stress history")
        elif value is None and name in OF_BODIES:
            report(f"fixed.{name}", "nothing", "a number, or one for each body")
    report.refuse()
    return details, own


def cycle_shares(
    stress: FloatArray, normals: FloatArray, criterion: str, poisson_ratio: float, **parameters: float
) -> list[FloatArray]:
    """Values of the cycles that rainflow closes on the plane of each point, over the largest one.

    Parameters
    ----------
    stress
        Shape (n, T, 6), one load cycle at each point.
    normals
        Shape (n, 3), of the planes; NaN where there is none.
    criterion, poisson_ratio, **parameters
        As of `swtstudy.kernel.criterion.ask`. The shear stress counts along the longest chord of its path.
    """
    from swtstudy.kernel.compiled import new_record
    from swtstudy.kernel.count import count_cycles
    from swtstudy.kernel.criterion import ask
    from swtstudy.kernel.cycles import COUNTING
    from swtstudy.kernel.field import curves_on_plane

    memory, own, found = new_record(COUNTING), ask(poisson_ratio, 0.0, 1e-6, criterion, **parameters), []
    memory["points"] = count = stress.shape[1]
    if count > len(memory["swing"]):
        raise refused(STEP, f"{count} steps", f"at most {len(memory['swing'])} for counted cycles")
    for history, normal in zip(stress, normals, strict=True):
        tension, *curves = curves_on_plane(history, normal, poisson_ratio, criterion == SWT)
        swing = curves[0]
        if criterion != SWT:
            shear = np.stack(curves, axis=1)
            chord = longest_chord(shear)
            swing = shear @ chord / max(float(np.linalg.norm(chord)), TINY)
        memory["swing"][:count], memory["stress"][:count] = swing, tension
        count_cycles(memory, own)
        values = memory["value"][: memory["cycles"]]
        sound = np.isfinite(normal).all() and values.size and values.max() > 0.0
        found.append(values / values.max() if sound else np.ones(1))
    return found


def write_history(found: xr.Dataset, path: Path) -> None:
    """Write results at points: a .vtu file for ParaView (by meshio), a CSV table, or netCDF (`ENDINGS`)."""
    if path.suffix == ".nc":
        from swtstudy.archive.archive import save

        save(found, path)
        return
    columns = {str(name): each.values for name, each in found.variables.items() if each.dims == ("point",)}
    for name, each in found.data_vars.items():
        for k in range(each.sizes.get("axis", 0)):
            columns[f"{name}_{POSITION[k]}"] = each.values[:, k]
    if path.suffix != ".vtu":
        pd.DataFrame(columns).to_csv(path, index=False)
        return
    try:
        import meshio
    except ImportError:
        allowed = "pip install meshio, which writes it; or a .csv file"
        raise refused("output", str(path), allowed) from None
    if not {*POSITION} & columns.keys():
        raise refused(
            "output", f"{path}, and points without x, y, z", "a .csv file, or points with coordinates"
        )
    places = np.stack([columns.get(name, np.zeros(found.sizes["point"])) for name in POSITION], axis=1)
    fields = {str(name): each.values for name, each in found.data_vars.items()}
    ids = pd.to_numeric(pd.Series(columns.get(ID, [])), errors="coerce")
    if ids.notna().any():  # of nodes and elements; fields of this format are numbers
        fields[ID] = ids.to_numpy()
    meshio.Mesh(places, [("vertex", np.arange(len(places))[:, None])], fields).write(path)
