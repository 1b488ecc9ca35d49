"""The critical distance, and friction, with which lives fit tests, run-outs among them."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Callable, Collection, Mapping, Sequence
from copy import copy
from dataclasses import replace
from difflib import get_close_matches
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any, Self

import numpy as np
import pandas as pd
import xarray as xr

from swtstudy.points.grid import SAMPLE
from swtstudy.points.solve import margins, solve_grid
from swtstudy.points.values import as_number
from swtstudy.results.sensitivity import check_confidence
from swtstudy.study.column_units import strange_unit, wrong_units
from swtstudy.study.columns import UserTable, by_aliases, number, read_table
from swtstudy.study.definition import study_from, tables_of
from swtstudy.study.units.grid import PhysicalGrid
from swtstudy.study.units.rows import kinds_of, with_replaced
from swtstudy.study.writing import to_toml
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.derived import LIVES
from swtstudy.vocabulary.mistakes import (
    Mistake,
    Report,
    StudyError,
    literal,
    more_like_it,
    nearest,
    plain_number,
    refused,
)
from swtstudy.vocabulary.parameters import AXES, DIRECTIONS
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import DISTANCE, Request
from swtstudy.vocabulary.version import __version__
from swtstudy.vocabulary.wording import number_of

#: The columns of a table of tests with the observed lives in load cycles, and with marks of run-outs.
LIFE, RUNOUT = "life", "runout"
#: Other headers of them, in small letters.
ALIASES = {LIFE: LIFE} | dict.fromkeys((RUNOUT, "run_out", "run-out", "run out", "runouts"), RUNOUT)
#: Marks of a run-out, and of a test that ended with a crack.
YES, NO = ("1", "1.0", "true", "yes", "y", "x"), ("0", "0.0", "false", "no", "n", "", "nan")
#: What units of thousands or millions of load cycles begin with.
PREFIXES = ("k", "K", "M", "mega", "mio", "thousand", "million")
#: Likeness of a column's name to a parameter's name from which it is a misspelling (difflib).
MISSPELT = 0.8
#: log10 of a life that counts as unbounded, for tests that survived.
UNBOUNDED = 20.0
#: Least scatter of log10 N: lives are not computed closer.
LEAST_SCATTER = 1e-3
#: Critical distances tried, over the smallest contact radius, as far as all lives are finite; lives between
#: them are interpolated.
DISTANCES = np.geomspace(0.004, 1.2, 17)
#: Relative accuracy of s: means are known to 1e-3.
RTOL = 1e-3
#: Distances on each side of the best one, with which other frictions are tried; how closely a friction is
#: found, since lives are known no closer than means.
BESIDE, OF_FRICTION = 4, 3e-3
#: Step of logarithms in second differences, well above what means are off by; upper bound of friction.
STEP, MOST_FRICTION = 0.02, 3.0
#: Distances of the first look for the best one.
FINE = 100
#: A cubic spline takes so many lives.
_LEAST_OF_SPLINE = 4
#: Misfit where a test has no finite life: finite, since searches subtract misfits.
_IMPOSSIBLE = 1e12
#: Nonlocal lives; the strictly local one knows no distance.
NONLOCAL_LIVES = tuple(name for name in LIVES if not name.endswith("cycles"))


def fit(
    study: str | PathLike[str],
    tests: str | PathLike[str] | Mapping[str, Sequence[object]] | pd.DataFrame,
    *,
    y: str = "cycles_volume",
    friction: bool = False,
    confidence: float = 0.95,
) -> xr.Dataset:
    """The critical distance with which predicted lives are nearest to the tests' lives.

    Maximum likelihood with normally distributed log10 N: least squares of log10 of predicted over observed
    life if all tests ended with a crack. The life of a run-out is above its number of cycles, and
    counts by the probability of that.

    Parameters
    ----------
    study
        A study file with units and constants, common to all tests. What the table of tests gives replaces
        what it has; another axis has a single value. Its figure does not count.
    tests
        A CSV file, a DataFrame, or columns by name: parameters, in the units of the study, and ``life``, the
        load cycles to a crack; a row for each test. A run-out has the cycles that it survived, as ">1e7" or
        with 1 in a column ``runout``. Other columns, such as names of specimens, are left alone with a
        warning.
    y
        Name of the predicted life: "cycles_volume", "cycles_point" or "cycles_line", the latter two straight
        down; with ``FS_`` before the name, a life by the criterion of Fatemi and Socie.
    friction
        Whether friction is fitted, too, starting from the study's friction.
    confidence
        Level of the intervals, which hold for small residuals; from the curvature of the likelihood and
        Student's t.

    Returns
    -------
    xarray.Dataset
        ``critical_distance`` and, if asked, ``friction``, with the ends of their intervals, ``_low`` and
        ``_high``; ``observed`` and ``predicted`` lives along ``test``, and ``runout``; ``scatter``, the
        standard deviation of log10 N; ``within_2`` and ``within_5``, the number of tests within these
        factors, among them run-outs whose predicted life is above, or below by less than the factor. The
        attribute ``study`` has the tests with the study's constants as a study of their own.

    Raises
    ------
    StudyError
        A ValueError with every mistake; also if the best distance is at an end of the tried distances.
    """
    if y not in NONLOCAL_LIVES:
        raise refused("y", literal(y), nearest(str(y), NONLOCAL_LIVES))
    check_confidence(confidence)
    grid, observed, runout = _read(study, tests, 2 if friction else 1)
    known = [name for name in NONLOCAL_LIVES if name in grid.made(_asked(DISTANCES))]
    if y not in known:
        raise refused("y", literal(y), f"one of {', '.join(known)}")
    own = plain_number(grid.values("friction")[0])
    if friction and not 0.0 < own < MOST_FRICTION:
        allowed = f"a positive number below {MOST_FRICTION:g}, with which the fit begins"
        raise refused("friction", f"{own:g}", allowed)
    ratio = _force_ratio(grid)
    with Progress(None, "fit"):
        # The least friction that bears the tangential forces.
        least = max(1.001 * ratio * own, 1e-3) if friction else None
        tests_of, best = _likeliest(_Tests(grid, np.log10(observed), runout, y), least)
    if not tests_of.is_within(best[0]):
        ends = " to ".join(f"{end:.3g}" for end in tests_of.distances[[0, -1]])
        end, lives = (
            ("lower", "longer") if best[0] < np.log(tests_of.distances).mean() else ("upper", "shorter")
        )
        words = f"the best one is at the {end} end of the range tried, {ends} {grid.labels.length}, where "
        words += f"predicted lives are still {lives} than the tests'"
        raise refused(DISTANCE, words, "tests whose lives depend on it within that range")
    return _labelled(tests_of, best, float(confidence), Path(study).stem)


class _Tests:
    """Observed and predicted lives of n tests.

    Attributes
    ----------
    grid
        The tests, as a sample.
    observed
        Shape (n,): log10 of their lives.
    runout
        Shape (n,): True for lives that are lower bounds.
    y
        The data variable.
    distances
        Critical distances at which lives are computed: up to the first at which a test has no finite life at
        the study's friction, since deep beneath the surface there may be no tension.
    curve
        See `_curve`, which it calls once for each friction.
    """

    def __init__(self, grid: PhysicalGrid, observed: FloatArray, runout: BoolArray, y: str) -> None:
        self.grid, self.observed, self.runout, self.y = grid, observed, runout, y
        self.distances = DISTANCES * float(grid.each(lambda contact: contact.contact_radius).min())
        self.curve = cache(self._curve)
        self.distances = self.distances[: self.curve(None).x.size]

    def beside(self, logarithm: float) -> Self:
        """The same tests, with no other distances than those beside one."""
        k, found = int(np.searchsorted(np.log(self.distances), logarithm)), copy(self)
        found.distances = self.distances[max(k - BESIDE, 0) : k + BESIDE]
        found.curve = cache(found._curve)
        return found

    def is_within(self, logarithm: float) -> bool:
        """True if a distance is not at an end of the distances."""
        low, high = np.log(self.distances[[0, -1]])
        return bool(low + STEP < logarithm < high - STEP)

    def _curve(self, friction: float | None) -> Any:
        """log10 of lives, shape (n,), over the logarithm of the distance, as far as all are finite.

        Lives of tests that survived may be unbounded. At a trial friction None if there are too few of them;
        at the study's friction, None, a StudyError.
        """
        from scipy.interpolate import CubicSpline

        lives = _lives(self.grid, self.y, self.distances, friction)
        lives = np.where(self.runout[:, None], np.minimum(lives, UNBOUNDED), lives)
        finite = np.isfinite(lives)
        many = int(np.append(finite.all(axis=0), False).argmin())
        if many >= _LEAST_OF_SPLINE:
            return CubicSpline(np.log(self.distances[:many]), lives[:, :many], axis=1)
        if friction is None:
            wrong = np.flatnonzero(~finite[:, :_LEAST_OF_SPLINE].all(axis=1)) + 1
            found = f"no finite life of test {', '.join(map(str, wrong.tolist()))}"
            raise refused("tests", found, "tests with equilibrium and tension")
        return None

    def residuals(self, logarithms: Any) -> FloatArray:
        """log10 of predicted over observed lives, shape (n,), at logarithms of distance and friction.

        They are inf where a trial friction leaves a test without a finite life.
        """
        curve = self.curve(math.exp(logarithms[1]) if len(logarithms) > 1 else None)
        if curve is None or logarithms[0] > curve.x[-1]:  # unlike any test
            return np.full(len(self.observed), np.inf)
        return np.asarray(curve(logarithms[0])) - self.observed

    def spread(self, logarithms: Any) -> float:
        """Logarithm of the scatter, but for run-outs that are predicted to survive; see `residuals`."""
        off = self.residuals(logarithms)
        counted = off[~self.runout | (off < 0.0)]
        scatter = math.sqrt(np.mean(counted**2)) if np.isfinite(off).all() else 0.0
        return math.log(max(scatter, LEAST_SCATTER))

    def misfit(self, x: Any) -> float:
        """−ln of the likelihood at logarithms of distance, friction if it is fitted, and scatter."""
        from scipy.special import log_ndtr

        z = self.residuals(x[:-1]) / math.exp(x[-1])
        if np.isinf(z).all():
            return _IMPOSSIBLE
        return float(np.where(self.runout, -log_ndtr(z), 0.5 * z * z + x[-1]).sum())


def _likeliest(tests: _Tests, least: float | None) -> tuple[_Tests, FloatArray]:
    """The tests with the distances that were tried, and the arguments of the least misfit.

    ``least`` is the least friction, None if it is not fitted. Means over large distances take longest: other
    frictions are tried with distances beside the best one at the study's friction, and with all of them only
    if the best distance is not among those.
    """
    best = _best_distance(tests).x
    if least is None:
        return tests, np.array([best, _best_scatter(tests, best).x])
    if not least < MOST_FRICTION:
        found = f"tangential forces that need {least:.3g} at least"
        raise refused("friction", found, f"forces that {MOST_FRICTION:g} bears")
    some = tests.beside(best)
    own = _best_friction(some, least)
    if not some.is_within(own[0]):
        some, own = tests, _best_friction(tests, least)
    return some, np.array([*own, _best_scatter(some, *own).x])


def _best_friction(tests: _Tests, least: float) -> tuple[float, float]:
    """Logarithms of the best distance and friction."""
    ends = math.log(least), math.log(MOST_FRICTION)
    friction = _least(lambda own: _best_distance(tests, own).fun, *ends, OF_FRICTION).x
    return _best_distance(tests, friction).x, friction


def _least(misfit: Callable[[float], float], low: float, high: float, within: float = 1e-7) -> Any:
    from scipy.optimize import minimize_scalar

    return minimize_scalar(misfit, bounds=(low, high), method="bounded", options={"xatol": within})


def _best_scatter(tests: _Tests, *x: float) -> Any:
    """The least misfit over the scatter at logarithms of distance and friction."""
    return _least(lambda scatter: tests.misfit([*x, scatter]), math.log(LEAST_SCATTER), 5.0)


def _best_distance(tests: _Tests, *own: float) -> Any:
    """The least misfit over distance and scatter at a friction: beside the best distance of a first look.

    With little scatter the misfit over both is a narrow valley. Over the distance alone, with the best
    scatter at each, it falls towards the best one from afar.
    """
    first, last = np.log(tests.distances[[0, -1]])
    distances = np.linspace(first, last, FINE)
    k = int(np.argmin([tests.misfit([each, *own, tests.spread([each, *own])]) for each in distances]))
    low, high = distances[max(k - 1, 0)], distances[min(k + 1, FINE - 1)]
    return _least(lambda distance: _best_scatter(tests, distance, *own).fun, low, high)


def _force_ratio(grid: PhysicalGrid) -> float:
    """Largest tangential force of the tests over the friction limit; 0 where no force is prescribed.

    Tests whose force exceeds the limit are refused before anything is solved.
    """
    ratios = np.asarray(margins(grid).get("prescribed_force_ratio", np.zeros(1)), float)
    if (wrong := np.flatnonzero(ratios > 1.0 + 1e-9)).size:
        k = int(wrong[0])
        friction = grid.values("friction")
        least = ratios[k] * plain_number(friction[k if len(friction) > 1 else 0])
        found = f"test {k + 1}, whose tangential force is {ratios[k]:.3g} times the friction limit: it slides"
        allowed = f"a friction of {least:.3g} at least for this test, or less force"
        raise refused("tests", found + more_like_it(len(wrong)), allowed)
    return float(ratios.max())


def _half_widths(tests: _Tests, best: FloatArray, confidence: float, cracked: int) -> FloatArray:
    """Half widths of the intervals of the logarithms, from the curvature of the likelihood at its maximum.

    Variances are those of the sample's scatter. Where the curvature has no inverse the tests do not determine
    the values, and the half widths are infinite.
    """
    from scipy.stats import t

    f, step, values = tests.misfit, STEP * np.ones(len(best)), len(best) - 1
    # Residuals bend: over a longer step than the scatter that would be seen in the differences.
    step[:-1] = min(STEP, math.exp(best[-1]))
    steps = np.diag(step)
    rows = [
        [f(best + a + b) - f(best + a - b) - f(best - a + b) + f(best - a - b) for b in steps] for a in steps
    ]
    curvature, freedom = np.array(rows) / (4.0 * np.outer(step, step)), cracked - values
    if best[-1] < math.log(LEAST_SCATTER) + STEP:  # the least scatter is no maximum
        curvature = curvature[:values, :values]
    if np.linalg.eigvalsh(curvature)[0] <= 0.0:
        return np.full(values, np.inf)
    variance = np.diag(np.linalg.inv(curvature))[:values] * (cracked / freedom)
    return np.asarray(t.ppf(0.5 + 0.5 * confidence, freedom) * np.sqrt(variance))


def _lives(grid: PhysicalGrid, y: str, distances: FloatArray, friction: float | None) -> FloatArray:
    """log10 of the lives of n tests at k critical distances, shape (n, k): of both bodies the shorter one."""
    if friction is not None:
        grid = replace(grid, fixed={**grid.fixed, "friction": friction})
    found = solve_grid(grid, RTOL, _asked(distances))[y]
    if "direction" in found.dims:
        found = found.sel(direction=DIRECTIONS[0])
    others = [dim for dim in found.dims if dim not in (SAMPLE, DISTANCE)]
    return np.asarray(np.log10(found.min(others).transpose(SAMPLE, DISTANCE).values))


def _asked(distances: FloatArray) -> Request:
    """The request with which lives at distances are computed."""
    return Request((), tuple(distances.tolist()), is_axis=True, counts=True)


def _labelled(tests: _Tests, best: FloatArray, confidence: float, title: str) -> xr.Dataset:
    """The fit as a Dataset; the scatter comes from the likelihood and is lower than the sample's."""
    residuals, runout, grid = tests.residuals(best[:-1]), tests.runout, tests.grid
    cracked = int((~runout).sum())
    spread = _half_widths(tests, best, confidence, cracked)
    scatter = math.exp(best[-1] + 0.5 * math.log(cracked / (cracked - len(best) + 1)))
    found: dict[str, Any] = {}
    for name, value, half in zip((DISTANCE, "friction"), best, spread, strict=False):
        row = grid.row(name)
        words = {"long_name": row.meaning, "symbol": row.symbol, "units": row.units}
        for end, logarithm in (("", value), ("_low", value - half), ("_high", value + half)):
            with np.errstate(over="ignore"):
                found[f"{name}{end}"] = (), float(np.exp(logarithm)), words
    for name, lives in (("observed", tests.observed), ("predicted", tests.observed + residuals)):
        words = {"long_name": f"{name} load cycles to a crack", "symbol": "N", "units": "1"}
        found[name] = "test", 10.0**lives, words
    found[RUNOUT] = "test", runout.astype("i1"), {"long_name": "1 for tests without a crack"}
    found["scatter"] = (), scatter, {"long_name": "standard deviation of log10 N", "units": "1"}
    off = np.where(runout, np.maximum(-residuals, 0.0), np.abs(residuals))
    for factor in (2, 5):
        within = int((off <= math.log10(factor)).sum())
        found[f"within_{factor}"] = (), within, {"long_name": f"tests within a factor of {factor}"}
    coordinates: dict[str, Any] = {"test": np.arange(1, len(residuals) + 1)}
    for name, values in grid.samples.items():
        if grid.row(name).kind != "name":
            coordinates[name] = "test", np.array([*map(as_number, values)]), {"units": grid.row(name).units}
    # The tests with the study's constants, as a study of its own.
    text = to_toml(f"Tests of {title}", RTOL, grid, None)
    attributes = {"y": tests.y, "confidence": confidence, "source": f"swtstudy {__version__}", "study": text}
    return xr.Dataset(found, coordinates, attributes)


def _read(
    study: str | PathLike[str], tests: object, parameters: int
) -> tuple[PhysicalGrid, FloatArray, BoolArray]:
    """The tests as a sample of the study's contacts, their lives, and which are lower bounds, shape (n,)."""
    if not isinstance(study, str | PathLike):
        raise refused("study", literal(study), "the path of a study file")
    raw, (columns, table) = tables_of(study), _columns(tests)
    lines = [line for line, _ in table.cells] if table else []
    place = str(tests) if lines else ""
    lives, runout, report = _observed(columns, lines, place, parameters)
    own = {name: values for name, values in columns.items() if name not in (LIFE, RUNOUT)}
    # Misspelt names of parameters stay, and are reported as such.
    others = [name for name in own if name not in AXES and not get_close_matches(name, AXES, 1, MISSPELT)]
    if others:
        warnings.warn(
            f"tests: columns that are no parameters are left alone: {', '.join(others)}", stacklevel=3
        )
    columns = {name: values for name, values in own.items() if name not in others}
    if not columns and not report:
        report("tests", f"the column {LIFE} alone", "parameters that vary, besides")
    grid = None
    if columns:
        # The tests are the sample of the study: mistakes in it are mistakes in them, or in their file.
        kept = {name: table for name, table in raw.items() if name not in ("axes", "sample", "figure")}
        replaced = with_replaced(columns) | {DISTANCE}
        fixed = raw.get("fixed", {}) | _single(raw, replaced, str(study))
        kept["fixed"] = {name: value for name, value in fixed.items() if name not in replaced}
        kept["sample"] = {"points": columns}
        try:
            grid = study_from(kept, "", str(study), Path(study).parent).grid
        except StudyError as error:
            for mistake in error.mistakes:
                key = re.sub(r"\bsample(\.points)?\b", "tests", mistake.key)
                if key != mistake.key:
                    mistake = replace(mistake, key=key.removeprefix("tests.") if place else key, source=place)
                report.append(mistake)
    if table and (unit := strange_unit(table, LIFE)).startswith(PREFIXES):
        report.append(Mistake("", f"{LIFE} in {unit}", "load cycles, not thousands or millions", place))
    if table and isinstance(grid, PhysicalGrid):
        report += wrong_units(table, kinds_of(name for name in columns if name in AXES), grid.labels)
    report.refuse()
    if not isinstance(grid, PhysicalGrid) or not grid.materials:
        allowed = "a study with [units] and the constants of [material]: a life needs a real contact"
        raise refused("", "neither", allowed, str(study))
    if grid.dimension("friction") and parameters > 1:
        raise refused("friction", "a column of the tests", "one value to fit, from the study")
    return grid, np.array(lives), np.array(runout, bool)


def _single(raw: Mapping[str, Any], replaced: Collection[str], source: str) -> dict[str, object]:
    """The single values along axes of a study that its tests do not replace; others are refused."""
    report, single = Report(source), dict[str, object]()
    if raw.get("blocks"):
        report("blocks", "a sequence of blocks", "a study of one load: a test has the load cycles of that")
    tables = {key: table for key, table in raw.items() if isinstance(table, dict)}
    sample = tables.get("sample", {})
    axes = {f"axes.{name}": values for name, values in tables.get("axes", {}).items()}
    axes |= {f"sample.{name}": None for part in ("ranges", "points") for name in sample.get(part, ())}
    for key, values in axes.items():
        name = key.partition(".")[2]
        if name in replaced or name not in AXES:
            continue
        if isinstance(values, list) and len(values) == 1:
            single[name] = values[0]
        elif name != "body":  # the shorter life of both counts
            report(key, f"several values of {name}", "one for all tests, or a column of the tests")
    report.refuse()
    return single


def _observed(
    columns: Mapping[str, Sequence[object]], lines: Sequence[int], source: str, parameters: int
) -> tuple[list[float], list[bool], Report]:
    """The lives, whether each is a run-out, and mistakes in both columns, by the lines of a file."""
    report = Report(source)

    def told(test: int, found: str, more: str, allowed: str) -> None:
        place, of = (f"line {lines[test]}", "") if lines else ("tests", f" of test {test + 1}")
        report(place, f"{found}{of}{more}", allowed)

    given = list(columns.get(LIFE, []))
    if not given:
        names = ", ".join(columns)
        report("tests", f"the columns {names}", f"a column {LIFE}, the load cycles to a crack")
    texts = [re.match(r"\s*(>=?|≥)?\s*(.*)", value) if isinstance(value, str) else None for value in given]
    numbers = [
        number(text[2], ".") if text else plain_number(value)
        for text, value in zip(texts, given, strict=True)
    ]
    marks = [str(mark).strip().lower() for mark in columns.get(RUNOUT, [""] * len(given))]
    for k, mark in enumerate(marks):
        if mark not in (*YES, *NO):
            told(k, f"{RUNOUT} {literal(mark)}", "", "1 or 0, true or false, yes or no")
    wrong = [k for k, life in enumerate(numbers) if not 0.0 < life < math.inf]
    if wrong:
        allowed = "positive numbers; of a run-out the cycles that it survived, as >1e7"
        told(wrong[0], f"{LIFE} {literal(given[wrong[0]])}", more_like_it(len(wrong)), allowed)
    runout = [bool(text and text[1]) or mark in YES for text, mark in zip(texts, marks, strict=False)]
    cracked = len(given) - sum(runout)
    if given and cracked <= parameters:
        found = number_of(cracked, "test") + " with a crack" * any(runout)
        report("" if source else "tests", found, f"{parameters + 1} at least")
    return numbers, runout, report


def _columns(tests: object) -> tuple[dict[str, list[Any]], UserTable | None]:
    """The columns of a table of tests by name, and the table in a file."""
    if not isinstance(tests, str | PathLike):
        try:
            frame = pd.DataFrame(tests)
        except (TypeError, ValueError) as error:
            allowed = "a CSV file, or columns by name, with a value for each test"
            raise refused("tests", f"{literal(tests)} ({error})", allowed) from None
        named = by_aliases([*map(str, frame)], ALIASES)
        return {name: frame[own].tolist() for name, own in zip(named, frame, strict=True)}, None
    table = read_table(Path(tests), (LIFE,), {*AXES, RUNOUT}, None, ALIASES)
    if not table.cells:
        raise refused("", "no tests", "a row for each test", str(tests))
    columns = {name: table.values(name) for name in table.headers if name}
    if table.decimal == ",":  # also in ">1,5e7", which is no number
        columns[LIFE] = [each.replace(",", ".") if isinstance(each, str) else each for each in columns[LIFE]]
    return columns, table
