"""Samples: parameters that vary together, and constants of [material] that scatter.

A design fills the unit cube (`scipy.stats.qmc`), and distributions make values of its points; or the points
are given, in the study or in a file with a header of names and a row for each point. Constants need no
further points: each draw of theirs has a life at every point.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.points.grid import Grid, Table, canonical_points, group_rows
from swtstudy.points.reading import LONGEST_AXIS, Known, read_points
from swtstudy.points.values import Value, as_number, read_value
from swtstudy.study.column_units import wrong_units
from swtstudy.study.columns import COMMA_HINT, read_table, unknown_names
from swtstudy.study.keys import DesignName, FileTable, SampleTable, under
from swtstudy.study.units.grid import ContactDetails
from swtstudy.study.units.life import CONSTANTS, SCATTERED, TORSION, Scatter
from swtstudy.study.units.material import KEYS
from swtstudy.study.units.rows import Units, kinds_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import Report, literal, more_like_it, nearest, plain_number, refused
from swtstudy.vocabulary.parameters import AXES, Parameter

#: Designs whose size is a power of 2: a Sobol sequence is balanced only there.
BALANCED = ("sobol", "saltelli")
ALLOWED_RANGE = (
    'both ends, [low, high], or a table such as {distribution = "normal", mean = …, deviation = …}'
)
#: Parameters of each distribution beside its bounds; the bounds of the last ones may be left out.
DISTRIBUTIONS: dict[str, tuple[str, ...]] = {
    "uniform": (),
    "triangular": ("mode",),
    "normal": ("mean", "deviation"),
    "lognormal": ("median", "deviation"),
}
_UNBOUNDED = ("normal", "lognormal")
#: Deviation of a logarithm: ten times as much or a tenth are as near to the median.
_LARGEST_DEVIATION = 2.3
#: A distribution of which the bounds leave less than this is not meant so.
_LEAST_SHARE = 1e-6
#: Constants of a material as what may be sampled: exponents are negative, and others positive.
_CONSTANTS = {
    name: Parameter(name, name, "", name, lower=low, upper=high, open_lower=high > 0.0)
    for name, row in SCATTERED.items()
    for low, high in [(-10.0, 0.0) if row.constant.endswith("exponent") else (0.0, 1e12)]
}
#: Words for `SCATTERED`.
_CAN_SCATTER = (
    f"{', '.join(CONSTANTS)}, with {TORSION} before it in torsion, with _1 or _2 behind it of one body"
)
#: Allowed in a file of points.
_PARAMETERS_ALONE = "columns of parameters; constants that scatter are in sample.ranges or sample.points"
_POINTS = "a CSV file: a row with names of parameters, then a row with their values for each point"
_MATRIX = "a table of variances and covariances, such as strength = { strength = 900, ductility = -0.5 }"


@dataclass(frozen=True)
class Design:
    """A design of points.

    Attributes
    ----------
    name
        One of `swtstudy.study.keys.DESIGNS`.
    size
        Number of points; for "saltelli" the points of its base, of which it has d + 2 variants.
    seed
        Seed of the random numbers.
    """

    name: DesignName
    size: int
    seed: int

    def points(self, dimensions: int) -> FloatArray:
        """The points in the unit cube, shape (n, d)."""
        from scipy.stats import qmc

        if self.name == "random":
            return np.random.default_rng(self.seed).random((self.size, dimensions))
        if self.name == "latin_hypercube":
            return np.asarray(qmc.LatinHypercube(dimensions, seed=self.seed).random(self.size))
        twice = self.name == "saltelli"
        unit = np.asarray(qmc.Sobol((1 + twice) * dimensions, seed=self.seed).random(self.size))
        return saltelli(unit[:, :dimensions], unit[:, dimensions:]) if twice else unit


def saltelli(a: FloatArray, b: FloatArray) -> FloatArray:
    """The points for Sobol indices: a, b, and for each parameter a with the values of b for this one.

    Parameters
    ----------
    a, b
        Shape (n, d).

    Returns
    -------
    array
        Shape (n (d + 2), d).

    References
    ----------
    A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270.
    """
    d = a.shape[1]
    mixed = np.where(np.eye(d, dtype=bool)[:, None, :], b, a)
    return np.concatenate([a, b, mixed.reshape(-1, d)])


#: Checked values of sampled parameters, by name; None where there are mistakes.
Sampled = dict[str, tuple[Value, ...] | None]
#: The sampled parameters, the design of values that are not given, and draws of constants.
ReadSample = tuple[Sampled, Design | None, Scatter | None]


@dataclass(frozen=True)
class SampleReader:
    """Reads the table of a sample, as far as it is sound; mistakes are reported.

    Attributes
    ----------
    table
        The table.
    given
        The keys that are given in it, also keys with mistakes, which are not in the table.
    folder
        Where a file of points is, if its path is relative.
    report
        Called with key, found and allowed of each mistake.
    known
        Definitions of the user, by parameter and name.
    rows
        The parameters that may be sampled.
    units
        The labels of units in a file.
    contacts
        The contacts, with the constants that may scatter; None without units.
    """

    table: SampleTable
    given: Collection[str]
    folder: Path
    report: Report
    known: Known
    rows: Mapping[str, Parameter]
    units: Units
    contacts: ContactDetails | None = None

    def read(self) -> ReadSample:
        """The sampled parameters, the design of values that are not given, and draws of constants."""
        table, report = self.table, self.report
        forms = [form for form in ("design", "file", "points") if form in self.given]
        if len(forms) != 1:
            allowed = "one of: design, size and ranges; or file; or points"
            report("sample", " and ".join(forms) or "nothing", allowed)
            return {}, None, None
        is_design = forms == ["design"]
        strange = {} if is_design else dict.fromkeys(("size", "seed", "ranges", "covariance"), "a design")
        strange |= {} if forms == ["file"] else dict.fromkeys(FileTable.model_fields, "a file")
        for name, form in strange.items():
            if name in self.given:
                found = f"{literal(getattr(table, name))} beside {forms[0]}"
                report(f"sample.{name}", found, f"only with {form}")
        every: Mapping[str, Any] = table.ranges if is_design else table.points
        scatter = self._scatter({name: every[name] for name in SCATTERED if name in every})
        if table.file is not None:
            every = self._points_of_file(self.folder / table.file)
            if not every:
                return {}, None, scatter
            for name in (each for each in every if each in SCATTERED):
                report("sample.file", f"the column {name}, a constant", _PARAMETERS_ALONE)
        own = {name: each for name, each in every.items() if name not in SCATTERED}
        if not own and (table.covariance or every):
            return {}, None, scatter  # constants alone
        if is_design:
            return *self._designed(own), scatter
        sampled = read_points(own, report, self.rows, self.known, f"sample.{forms[0]}", COMMA_HINT)
        return sampled, None, scatter

    def _points_of_file(self, path: Path) -> dict[str, list[object]]:
        """The columns of a file by name: numbers, and other texts as they are; empty with mistakes."""
        form = self.table
        with under(self.report, "sample", "file"):
            table = read_table(path, (), self.rows, form)
            names = {form.header(name): name for name in self.rows}
            own = [names.get(header, header) for header in table.headers if header]
            lost = [n for n in form.columns if n in self.rows and form.header(n) not in table.headers]
            found = unknown_names(form, (*own, *lost))
            for name in lost:
                header = form.columns[name]
                found(f"columns.{name}", literal(header), nearest(header, table.headers, {}))
            there = [name for name in own if name in self.rows and name not in lost]
            plain = Units(**vars(self.units)) if "contact_length" in there else self.units
            found += wrong_units(table, kinds_of(there), plain)
            if empty := table.incomplete(there):
                words = f"a cell without a value{more_like_it(len(empty))}"
                found(f"line {empty[0]}", words, "a value of each parameter at each point")
            table.leave_out(empty)
            with under(self.report, "sample", "file"):  # and the values are told, too
                found.refuse()
            if table.cells or empty:
                return {} if lost else {name: table.values(name) for name in own}
            self.report("sample.file", f"{path} without points", _POINTS)
        return {}

    def _designed(self, ranges: Mapping[str, Any]) -> tuple[Sampled, Design | None]:
        """Values of parameters in their ranges, at the points of a design."""
        numeric = {name: row for name, row in self.rows.items() if row.kind == "number"}
        sound = {name: raw for name, raw in ranges.items() if name in numeric}
        if not ranges:
            self.report("sample.ranges", "nothing", "at least one parameter with its range")
        for name in (name for name in ranges if name not in sound):
            found, allowed = f"unknown parameter {literal(name)}", nearest(name, numeric)
            if name in KEYS:
                found = f"{name}, a constant that cannot scatter"
                allowed = f"constants that can: {_CAN_SCATTER}; or a parameter"
            if name in AXES:
                found, allowed = f"{name}, which has no range", "a fixed value or an axis"
            if name in self.rows:
                found, allowed = f"{name}, which is not a number", "an axis, or points from a file"
            self.report(f"sample.ranges.{name}", found, allowed)
        design, values, _ = self._at_design(sound, numeric)
        if design is None or len(sound) < len(ranges):
            return dict.fromkeys(sound), None
        return {name: tuple(column.tolist()) for name, column in values.items()}, design

    def _at_design(
        self, ranges: Mapping[str, Any], rows: Mapping[str, Parameter], more: int = 0
    ) -> tuple[Design | None, dict[str, FloatArray], FloatArray]:
        """The design, values in ranges at its points, and more of its columns; no design if one is wrong."""
        table, report, size, dimensions = self.table, self.report, self.table.size, len(ranges) + more
        before, read, is_balanced = len(report), {}, table.design in BALANCED
        if table.design is None:  # reported with the structure
            pass
        elif size is None or (is_balanced and size & (size - 1)):
            allowed = f"a {'power of 2' if is_balanced else 'whole number'} from 1 to {LONGEST_AXIS}"
            report("sample.size", "nothing" if size is None else literal(size), allowed)
        elif table.design == "saltelli" and (count := size * (dimensions + 2)) > LONGEST_AXIS:
            report("sample.size", f"{count} points", f"at most {LONGEST_AXIS} points")
        for name, raw in ranges.items():
            with report:
                read[name] = _distribution(rows[name], raw, f"sample.ranges.{name}")
        if table.design is None or size is None or not dimensions or len(report) > before:
            return None, {}, np.empty((0, more))
        design = Design(table.design, size, table.seed)
        unit = design.points(dimensions)
        values = {name: read[name](column) for name, column in zip(ranges, unit.T, strict=False)}
        return design, values, unit[:, len(ranges) :]

    def _scatter(self, given: Mapping[str, Any]) -> Scatter | None:
        """Draws of constants; None if none of them scatters, or with mistakes, which are reported."""
        table, contacts, report = self.table, self.contacts, self.report
        if not given and {"covariance", "target_life"}.isdisjoint(self.given):
            return None
        if contacts is None or not contacts.has_lives:
            if not any(mistake.key.startswith("material") for mistake in report):
                report("sample", "constants that scatter", "with the constants of lives in [material]")
            return None
        before = len(report)
        found = {name: np.array(column) for name, column in self._drawn(given, contacts).items()}
        for name, column in found.items():
            own, row = _own_values(name, contacts), SCATTERED[name]
            base = f"{TORSION * row.torsion}{row.constant}"
            if len({*own}) > 1:
                words = " and ".join(f"{value:g}" for value in own)
                allowed = f"{name}_1, {name}_2, or one of them"
                report(f"sample.{name}", f"{name}, which is {words} in the bodies", allowed)
            elif not own:
                report(f"sample.{name}", f"{name}, a constant without a value", f"{base} in [material]")
            if name != base and base in found:
                report(f"sample.{name}", f"{name} beside {base}", "one of the two")
            if wrong := int((column * (-1.0 if row.constant.endswith("exponent") else 1.0) <= 0.0).sum()):
                allowed = "less scatter, or a distribution that is cut off"
                report(f"sample.{name}", f"{wrong} of {len(column)} draws with the wrong sign", allowed)
        if not found and len(report) == before and table.target_life is not None:
            allowed = "a life beside constants that scatter"
            report("sample.target_life", literal(table.target_life), allowed)
        if len(report) > before or not found:
            return None
        names = tuple(name for name in SCATTERED if name in found)
        draws = tuple(tuple(float(f"{value:.6g}") for value in found[name]) for name in names)
        return Scatter(names, draws, table.target_life or 0.0)

    def _drawn(self, given: Mapping[str, Any], contacts: ContactDetails) -> Mapping[str, Any]:
        """Draws of constants: given ones, or from ranges and from a covariance about the constants."""
        table, report, before = self.table, self.report, len(self.report)
        if given and "points" in self.given:
            listed = read_points(given, report, _CONSTANTS, {}, "sample.points", COMMA_HINT)
            return {name: column for name, column in listed.items() if column is not None}
        correlated, root = list[str](), np.empty((0, 0))
        with report:
            correlated, root = _root(table.covariance, given)
        if table.design == "saltelli":
            allowed = "a design other than saltelli, for draws of constants"
            report("sample.design", literal(table.design), allowed)
        design, draws, unit = self._at_design(given, _CONSTANTS, len(correlated))
        if design is None or len(report) > before:
            return {}
        from scipy.special import ndtri

        about = np.array([(_own_values(name, contacts) or [math.nan])[0] for name in correlated])
        normal = ndtri(np.clip(unit, 1e-12, 1.0 - 1e-12))
        return draws | dict(zip(correlated, (about + normal @ root.T).T, strict=False))


def _distribution(parameter: Parameter, raw: object, key: str) -> Callable[[FloatArray], FloatArray]:
    """The values of a distribution that a user wrote, at points of the unit interval.

    It is cut off at its bounds. The deviation of "lognormal" is a deviation of the natural logarithm.

    Raises
    ------
    StudyError
        A ValueError with the mistakes in it.
    """
    if isinstance(raw, list) and len(raw) == 2:
        raw = {"distribution": "uniform", "low": raw[0], "high": raw[1]}
    if not isinstance(raw, Mapping):
        raise refused(key, literal(raw), ALLOWED_RANGE)
    kind = raw.get("distribution")
    if not isinstance(kind, str) or kind not in DISTRIBUTIONS:
        found = literal(kind) if "distribution" in raw else "nothing"
        raise refused(f"{key}.distribution", found, nearest(str(kind or ""), DISTRIBUTIONS))
    report, known = Report(), ("distribution", "low", "high", *DISTRIBUTIONS[kind])
    for name in (each for each in raw if each not in known):
        report(f"{key}.{name}", f"unknown key {literal(name)}", nearest(str(name), known))
    # An open end is a bound, although it is no value.
    bound = replace(parameter, open_lower=False, words=parameter.allowed)
    any_number = replace(bound, lower=-math.inf, upper=math.inf, words="a number")
    positive = replace(any_number, lower=0.0, open_lower=True, words="a number greater than 0")
    rows = {"low": bound, "high": bound, "deviation": positive, "median": positive}
    ends, numbers = {"low": parameter.lower, "high": parameter.upper}, dict[str, float]()
    for name in known[1:]:
        row, own = rows.get(name, any_number), raw.get(name, ends.get(name) if kind in _UNBOUNDED else None)
        try:
            if own is None:
                raise ValueError
            numbers[name] = as_number(read_value(row, own))
        except ValueError as error:
            found = "nothing" if own is None else f"{literal(own)} ({error})"
            report(f"{key}.{name}", found, row.words)
    report.refuse()
    low, high, deviation = numbers["low"], numbers["high"], numbers.get("deviation", 1.0)
    bounds, mode = f"the bounds {low:g} and {high:g}", numbers.get("mode", low)
    if not low < high:
        raise refused(key, bounds, "the lower bound first, and a higher one")
    if kind == "lognormal" and deviation > _LARGEST_DEVIATION:
        factor = math.exp(deviation) if deviation < 700.0 else math.inf
        allowed = f"that of the natural logarithm, at most {_LARGEST_DEVIATION:g}: about the relative one"
        raise refused(f"{key}.deviation", f"{deviation:g}, as a factor {factor:.3g}", allowed)
    if not low <= mode <= high:
        raise refused(f"{key}.mode", f"{mode:g}", f"a number in [{low:g}, {high:g}]")
    if kind == "uniform":
        return lambda unit: low * (1.0 - unit) + high * unit
    from scipy import stats

    if kind == "normal":
        whole: Any = stats.norm(numbers["mean"], deviation)
    elif kind == "lognormal":
        whole = stats.lognorm(deviation, scale=numbers["median"])
    else:
        whole = stats.triang((mode - low) / (high - low), low, high - low)
    below = whole.cdf(low)
    share = float(whole.cdf(high) - below)
    if share < _LEAST_SHARE:
        raise refused(key, f"{bounds}, which hold none of the distribution", "bounds that hold some of it")
    return lambda unit: np.clip(whole.ppf(below + unit * share), low, high)


def _own_values(name: str, contacts: ContactDetails) -> list[float]:
    """The values of a constant of `SCATTERED` in [material], of each of its bodies; none without one."""
    torsion, constant, bodies = SCATTERED[name]
    materials = contacts.shear_materials if torsion else contacts.materials
    return [getattr(materials[body], constant) for body in bodies if materials]


def _root(covariance: Mapping[str, Any], ranges: Mapping[str, Any]) -> tuple[list[str], FloatArray]:
    """Names of the constants of a covariance, and its root, shape (k, k); a StudyError with its mistakes."""
    key, report = "sample.covariance", Report()
    if wrong := [name for name, row in covariance.items() if not isinstance(row, dict)]:
        raise refused(f"{key}.{wrong[0]}", literal(covariance[wrong[0]]), _MATRIX)
    names = [*dict.fromkeys([*covariance, *(name for row in covariance.values() for name in row)])]
    given = {(i, j): value for i, row in covariance.items() for j, value in row.items()}
    for name in names:
        if name in ranges:
            report(f"{key}.{name}", f"{name}, which has a range", "one of the two")
        if name not in SCATTERED:
            report(f"{key}.{name}", literal(name), f"constants that can scatter: {_CAN_SCATTER}")
        elif not 0.0 < plain_number(given.get((name, name), 0.0)) < math.inf:
            found = literal(given[name, name]) if (name, name) in given else "no variance"
            report(f"{key}.{name}.{name}", found, "its variance, a finite number > 0")
    for i, j in itertools.combinations(names, 2):
        twice = [given[each] for each in ((i, j), (j, i)) if each in given]
        both = [*map(plain_number, twice)]
        if both and not (np.isfinite(both).all() and math.isclose(both[0], both[-1], rel_tol=1e-8)):
            allowed = "one finite number, said once or twice the same"
            report(f"{key}.{i}.{j}", " and ".join(map(literal, twice)), allowed)
    report.refuse()
    matrix = np.array([float(given.get((i, j), given.get((j, i), 0.0))) for i in names for j in names])
    matrix = matrix.reshape(len(names), len(names))
    deviation = np.sqrt(np.diag(matrix))
    correlation = matrix / np.outer(deviation, deviation)
    values, vectors = np.linalg.eigh(correlation)
    if values.min(initial=0.0) < -1e-9:
        i, j = divmod(int(np.abs(np.tril(correlation, -1)).argmax()), len(names))
        found = f"a correlation of {correlation[i, j]:.3g} between {names[i]} and {names[j]}"
        raise refused(key, found, "correlations within ±1 that are possible together")
    return names, deviation[:, None] * vectors * np.sqrt(values.clip(0.0))


#: The largest index that NumPy's random numbers can be.
LARGEST_SAMPLED = 2**63 - 1


def drawn_rows(grid: Grid, points: int, seed: int) -> Table:
    """Canonical rows of random points of a grid, without repetition, shape (n,).

    Raises
    ------
    ValueError
        If it has more than `LARGEST_SAMPLED` points.
    """
    if grid.size > LARGEST_SAMPLED:
        raise ValueError(f"{grid.size} points are too many to sample, at most {LARGEST_SAMPLED}")
    rng = np.random.default_rng(seed)
    # More than asked for: two points of the grid can be physically the same.
    is_small = grid.size <= 4 * points
    index = rng.permutation(grid.size) if is_small else rng.integers(grid.size, size=2 * points)
    rows, _ = canonical_points(grid, index)
    first, _ = group_rows(rows)
    return rows[np.sort(first)[:points]]
