"""The critical distance, and friction, with which lives fit those of tests, run-outs among them."""

from __future__ import annotations

import math
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from swtstudy.points.canonical import Distinct
from swtstudy.points.grid import SAMPLE
from swtstudy.points.labelled import margins
from swtstudy.solving import solve_grid
from swtstudy.study.columns import number
from swtstudy.study.definition import Study, study_from, tables_of
from swtstudy.study.keys import FileTable
from swtstudy.study.sample import read_points
from swtstudy.units.grid import PhysicalGrid
from swtstudy.units.results import LIVES
from swtstudy.vocabulary.arrays import BoolArray, FloatArray
from swtstudy.vocabulary.mistakes import (
    Mistake,
    Report,
    StudyError,
    is_number,
    literal,
    more_like_it,
    nearest,
    plain_number,
)
from swtstudy.vocabulary.parameters import AXES, DIRECTIONS
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import DISTANCE, Request

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline

#: The columns of a table of tests with the observed lives in load cycles, and with marks of run-outs.
LIFE, RUNOUT = "life", "runout"
#: Marks of a run-out, and of a test that ended with a crack.
YES, NO = ("1", "1.0", "true", "yes", "y", "x"), ("0", "0.0", "false", "no", "n", "")
#: Ratio of a name of a column to that of a parameter from which it is a misspelling (difflib).
MISSPELT = 0.8
#: log10 of a life that counts as unbounded, for tests that survived.
UNBOUNDED = 20.0
#: Least scatter of log10 N: lives are not computed closer. Rounds in which it is found, to a thousandth.
LEAST_SCATTER, ROUNDS, CLOSE = 1e-3, 100, 1e-3
#: Critical distances tried, over the smallest contact radius, as far as all lives are finite; lives between
#: them are interpolated.
DISTANCES = np.geomspace(0.004, 1.2, 17)
#: Relative accuracy of s: means are known to 1e-3.
RTOL = 1e-3
#: At relative changes of parameters, and of the sum of squares, below this the fit is done.
XTOL = 1e-4
#: Relative step of friction in difference quotients, well above what means are off by; its upper bound.
STEP, MOST_FRICTION = 0.02, 3.0
#: Nonlocal lives; the strictly local one knows no distance.
NONLOCAL_LIVES = tuple(name for name in LIVES if not name.endswith("cycles"))


def fit(
    study: str | PathLike[str],
    tests: str | PathLike[str] | Mapping[str, Sequence[object]],
    *,
    y: str = "cycles_volume",
    friction: bool = False,
    confidence: float = 0.95,
) -> xr.Dataset:
    """The critical distance with which predicted lives are nearest to those of tests.

    Maximum likelihood with normally distributed log10 N: least squares of log10 of predicted over observed
    life, by `scipy.optimize.least_squares`, if all tests ended with a crack. The life of a run-out is known
    to be above its number of cycles: it counts by the probability of that.

    Parameters
    ----------
    study
        A study file with units and constants: what all tests have in common. Its axes, sample and figure do
        not count, nor what the table of tests gives.
    tests
        A CSV file, or its columns by name: parameters, in the units of the study, and ``life``, the load
        cycles to a crack; a row for each test. A run-out has the cycles that it survived, as ">1e7" or with 1
        in a column ``runout``. Other columns, such as names of specimens, are left alone with a warning.
    y
        Name of the predicted life: "cycles_volume", "cycles_point" or "cycles_line", the latter two straight
        down; with ``FS_`` before the name, a life by the criterion of Fatemi and Socie.
    friction
        Whether friction is fitted, too; the study's is where that begins.
    confidence
        Level of the intervals, which hold for small residuals: from the curvature of the likelihood, and
        Student's t.

    Returns
    -------
    xarray.Dataset
        ``critical_distance`` and, if asked, ``friction``, with the ends of their intervals, ``_low`` and
        ``_high``; ``observed`` and ``predicted`` lives along ``test``, and ``runout``; ``scatter``, the
        standard deviation of log10 N; ``within_2`` and ``within_5``, the number of tests within these
        factors, among them run-outs whose predicted life is above, or below by less than the factor.

    Raises
    ------
    StudyError
        A ValueError with every mistake; also if the best distance is at an end of those that were tried.
    """
    if y not in NONLOCAL_LIVES:
        raise StudyError([Mistake("y", literal(y), nearest(str(y), NONLOCAL_LIVES))])
    if not is_number(confidence) or not 0.0 < float(confidence) < 1.0:
        raise StudyError([Mistake("confidence", literal(confidence), "a number between 0 and 1")])
    grid, observed, runout = _read(study, tests, 2 if friction else 1)
    known = [name for name in NONLOCAL_LIVES if name in grid.made(_asked(DISTANCES))]
    if y not in known:
        raise StudyError([Mistake("y", literal(y), f"one of {', '.join(known)}")])
    own = plain_number(grid.values("friction")[0])
    if friction and not 0.0 < own < MOST_FRICTION:
        allowed = f"a positive number below {MOST_FRICTION:g}, with which the fit begins"
        raise StudyError([Mistake("friction", f"{own:g}", allowed)])
    with Progress(None, "fit"):
        model = _Model.of(grid, np.log10(observed), runout, y, friction)
        low, high = model.bounds()
        best, scatter = model.fitted(low, high)
    if not low[0] + STEP < best[0] < high[0] - STEP:
        ends = " to ".join(f"{math.exp(end):.3g}" for end in (low[0], high[0]))
        words = f"the best one is at an end of those tried, {ends} {grid.labels.length}"
        raise StudyError([Mistake(DISTANCE, words, "tests whose lives depend on it within that range")])
    return _labelled(model, best, scatter, float(confidence))


@dataclass(frozen=True)
class _Model:
    """Predicted lives of n tests.

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
    friction
        Logarithm of the study's friction, where a fit of it begins; None if it is not fitted.
    distances
        Critical distances at which lives are computed.
    known
        log10 of the lives at all distances, by the logarithm of friction.
    """

    grid: PhysicalGrid
    observed: FloatArray
    runout: BoolArray
    y: str
    friction: float | None
    distances: FloatArray
    known: dict[float | None, FloatArray]

    @classmethod
    def of(
        cls, grid: PhysicalGrid, observed: FloatArray, runout: BoolArray, y: str, with_friction: bool
    ) -> _Model:
        """Distances are those up to the first at which a test has no finite life at the study's friction.

        Deep beneath the surface there may be no tension.
        """
        distances = DISTANCES * float(grid.at_rest.each(lambda contact: contact.contact_radius).min())
        lives = _bounded(_lives(grid, y, distances, None), runout)
        # A spline takes four.
        many = max(int(np.append(np.isfinite(lives).all(axis=0), False).argmin()), 4)
        own = math.log(float(grid.values("friction")[0])) if with_friction else None  # type: ignore[arg-type]
        return cls(grid, observed, runout, y, own, distances[:many], {own: _finite(lives[:, :many])})

    def start(self) -> FloatArray:
        """Logarithms of the parameters at the best distance that is computed."""
        own = np.array([] if self.friction is None else [self.friction])
        tried = [np.append(logarithm, own) for logarithm in np.log(self.distances)]
        return min(tried, key=lambda each: float((self.deviations(each, 1.0) ** 2).sum()))

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest logarithms: friction must bear the tangential forces."""
        low, high = [self.distances[0]], [self.distances[-1]]
        if self.friction is not None:
            ratios = margins(Distinct.of(self.grid), self.grid).get("prescribed_force_ratio", np.zeros(1))
            least = max(1.001 * float(np.max(ratios)) * math.exp(self.friction), 1e-3)
            if not least < MOST_FRICTION:
                found = f"tangential forces that need {least:.3g} at least"
                raise StudyError([Mistake("friction", found, f"forces that {MOST_FRICTION:g} bears")])
            low.append(least)
            high.append(MOST_FRICTION)
        return np.log(np.array(low)), np.log(np.array(high))

    def lives(self, logarithms: FloatArray) -> CubicSpline:
        """log10 of the lives over the logarithm of the distance, at that of friction."""
        from scipy.interpolate import CubicSpline

        own = None if self.friction is None else float(logarithms[1])
        if own not in self.known:
            friction = None if own is None else math.exp(own)
            lives = _lives(self.grid, self.y, self.distances, friction)
            self.known[own] = _finite(_bounded(lives, self.runout))
        return CubicSpline(np.log(self.distances), self.known[own], axis=1)

    def residuals(self, logarithms: FloatArray) -> FloatArray:
        """log10 of predicted over observed lives, shape (n,), at logarithms of the parameters."""
        return np.asarray(self.lives(logarithms)(logarithms[0])) - self.observed

    def slopes(self, logarithms: FloatArray) -> FloatArray:
        """Their derivatives, shape (n, number of parameters)."""
        columns = [self.lives(logarithms)(logarithms[0], 1)]
        if self.friction is not None:
            columns.append(
                (self.residuals(logarithms + np.array([0.0, STEP])) - self.residuals(logarithms)) / STEP
            )
        return np.stack(columns, axis=1)

    def fitted(self, low: FloatArray, high: FloatArray) -> tuple[FloatArray, float]:
        """Logarithms of the parameters between bounds, and the scatter, of the largest likelihood.

        The scatter follows from expected squares of what is left, those of run-outs above their bounds
        (expectation and maximisation).
        """
        from scipy.optimize import least_squares

        best = np.clip(self.start(), low, high)
        scatter = self.scatter(best, 1.0)
        for _ in range(ROUNDS):
            best = least_squares(
                lambda each, size: self.deviations(each, size),
                best,
                lambda each, size: self.deviation_slopes(each, size),
                bounds=(low, high),
                xtol=XTOL,
                ftol=XTOL,
                args=(scatter,),
            ).x
            last, scatter = scatter, self.scatter(best, scatter)
            if abs(math.log(scatter / last)) < CLOSE:
                break
        return best, scatter

    def deviations(self, logarithms: FloatArray, scatter: float) -> FloatArray:
        """Residuals over a scatter, shape (n,); of run-outs the root of −2 ln of the chance to survive."""
        from scipy.stats import norm

        z = self.residuals(logarithms) / scatter
        return np.where(self.runout, np.sqrt(-2.0 * norm.logcdf(z)), z)

    def deviation_slopes(self, logarithms: FloatArray, scatter: float) -> FloatArray:
        """Their derivatives, shape (n, number of parameters)."""
        z = self.residuals(logarithms) / scatter
        of_runouts = -_hazard(z) / np.maximum(self.deviations(logarithms, scatter), 1e-300)
        return self.slopes(logarithms) * (np.where(self.runout, of_runouts, 1.0) / scatter)[:, None]

    def scatter(self, logarithms: FloatArray, scatter: float) -> float:
        """Standard deviation of log10 N whose expected squares are those at another one."""
        residuals = self.residuals(logarithms)
        z = residuals / scatter
        squares = np.where(self.runout, scatter**2 * (1.0 - z * _hazard(z)), residuals**2)
        return max(float(np.sqrt(squares.mean())), LEAST_SCATTER)

    def freedom(self) -> int:
        """Number of cracked tests beyond that of parameters."""
        return int((~self.runout).sum()) - (1 if self.friction is None else 2)

    def spread(self, logarithms: FloatArray, scatter: float, confidence: float) -> FloatArray:
        """Half widths of the intervals of the logarithms, shape (number of parameters,).

        From the second derivatives of the likelihood by the parameters and the logarithm of the scatter.
        """
        from scipy.stats import t

        z, slopes = self.residuals(logarithms) / scatter, self.slopes(logarithms) / scatter
        hazard = _hazard(z)
        steep = np.where(self.runout, hazard * (hazard + z), 1.0)
        mixed = np.where(self.runout, hazard - z * steep, -2.0 * z)
        both = slopes.T @ mixed[:, None]
        whole = np.block([[slopes.T @ (steep[:, None] * slopes), both], [both.T, -(z * mixed).sum()]])
        variance = np.maximum(np.diag(np.linalg.pinv(whole))[:-1], 0.0)
        return np.asarray(t.ppf(0.5 + 0.5 * confidence, self.freedom()) * np.sqrt(variance))


def _hazard(z: FloatArray) -> FloatArray:
    """φ(z)/Φ(z) of the normal distribution."""
    from scipy.stats import norm

    return np.asarray(np.exp(norm.logpdf(z) - norm.logcdf(z)))


def _bounded(lives: FloatArray, runout: BoolArray) -> FloatArray:
    """log10 of lives, (n, k), where those of tests that survived may be unbounded."""
    return np.where(runout[:, None], np.minimum(lives, UNBOUNDED), lives)


def _finite(lives: FloatArray) -> FloatArray:
    """The lives, shape (n, k), if all are finite."""
    wrong = ~np.isfinite(lives).all(axis=1)
    if wrong.any():
        numbers = ", ".join(map(str, (np.flatnonzero(wrong) + 1).tolist()))
        raise StudyError(
            [Mistake("tests", f"no finite life of test {numbers}", "tests with equilibrium and tension")]
        )
    return lives


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


def _labelled(model: _Model, best: FloatArray, scatter: float, confidence: float) -> xr.Dataset:
    """The fit as a Dataset; the scatter is that of the likelihood, which is lower than the sample's."""
    residuals, freedom = model.residuals(best), model.freedom()
    scatter *= math.sqrt((freedom + len(best)) / freedom)
    spread = model.spread(best, scatter, confidence)
    found: dict[str, Any] = {}
    for name, value, half in zip((DISTANCE, "friction"), best, spread, strict=False):
        row = model.grid.row(name)
        words = {"long_name": row.meaning, "symbol": row.symbol, "units": row.units}
        for end, logarithm in (("", value), ("_low", value - half), ("_high", value + half)):
            with np.errstate(over="ignore"):
                found[f"{name}{end}"] = (), float(np.exp(logarithm)), words
    lives = {"observed": 10.0**model.observed, "predicted": 10.0 ** (model.observed + residuals)}
    found |= {
        name: ("test", values, {"long_name": f"{name} load cycles to a crack", "symbol": "N"})
        for name, values in lives.items()
    }
    found[RUNOUT] = "test", model.runout.astype("i1"), {"long_name": "1 for tests without a crack"}
    found["scatter"] = (), scatter, {"long_name": "standard deviation of log10 N"}
    for factor in (2, 5):
        off = np.where(model.runout, np.maximum(-residuals, 0.0), np.abs(residuals))
        within = int((off <= math.log10(factor)).sum())
        found[f"within_{factor}"] = (), within, {"long_name": f"tests within a factor of {factor}"}
    samples = {
        name: ("test", np.array(list(map(float, values))), {"units": model.grid.row(name).units})  # type: ignore[arg-type]
        for name, values in model.grid.samples.items()
        if model.grid.row(name).kind != "name"
    }
    numbers = {"test": np.arange(1, len(residuals) + 1)}
    return xr.Dataset(found, numbers | samples, {"y": model.y, "confidence": confidence})


def _read(
    study: str | PathLike[str], tests: object, parameters: int
) -> tuple[PhysicalGrid, FloatArray, BoolArray]:
    """The tests as a sample of the study's contacts, their lives, and which are lower bounds, shape (n,)."""
    columns = _columns(tests)
    report = Report()
    lives, runout = _observed(columns, parameters, report)
    columns = _of_parameters(columns)
    if not columns and not report:
        report("tests", f"the column {LIFE} alone", "parameters that vary, besides")
    grid = None
    if columns:
        with report:
            grid = _with_tests(Path(study), str(study), columns).grid
    report.refuse()
    if not isinstance(grid, PhysicalGrid) or not grid.materials:
        allowed = "a study with [units] and the constants of [material]: a life needs a real contact"
        raise StudyError([Mistake("", "neither", allowed, str(study))])
    if grid.dimension("friction") and parameters > 1:
        raise StudyError([Mistake("friction", "a column of the tests", "one value to fit, from the study")])
    return grid, np.array(lives), np.array(runout, bool)


def _observed(
    columns: Mapping[str, Sequence[object]], parameters: int, report: Report
) -> tuple[list[float], list[bool]]:
    """The lives, and whether each is that of a run-out; mistakes in both columns are reported."""
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
            report("tests", f"{RUNOUT} {literal(mark)} of test {k + 1}", "1 or 0, true or false, yes or no")
    wrong = [k for k, life in enumerate(numbers) if not 0.0 < life < math.inf]
    if wrong:
        found = f"{LIFE} {literal(given[wrong[0]])} of test {wrong[0] + 1}{more_like_it(len(wrong))}"
        report("tests", found, "positive numbers; of a run-out the cycles that it survived, as >1e7")
    runout = [bool(text and text[1]) or mark in YES for text, mark in zip(texts, marks, strict=False)]
    cracked = len(given) - sum(runout)
    if given and cracked <= parameters:
        report("tests", f"{cracked} tests{' with a crack' * any(runout)}", f"{parameters + 1} at least")
    return numbers, runout


def _of_parameters(columns: Mapping[str, list[Any]]) -> dict[str, list[Any]]:
    """The columns of parameters, and those with misspelt names, which are reported as such."""
    others = [
        name
        for name in columns
        if name not in (*AXES, LIFE, RUNOUT) and not get_close_matches(name, AXES, 1, MISSPELT)
    ]
    if others:
        warnings.warn(
            f"tests: columns that are no parameters are left alone: {', '.join(others)}", stacklevel=3
        )
    return {name: values for name, values in columns.items() if name not in (*others, LIFE, RUNOUT)}


def _with_tests(path: Path, source: str, columns: dict[str, list[Any]]) -> Study:
    """The study with the tests as its sample; mistakes in these are named as theirs."""
    raw = tables_of(path)
    kept = {name: table for name, table in raw.items() if name not in ("axes", "sample", "figure")}
    own = columns.keys() | {DISTANCE}
    kept["fixed"] = {name: value for name, value in raw.get("fixed", {}).items() if name not in own}
    kept["sample"] = {"points": columns}
    try:
        return study_from(kept, "", source, path.parent)
    except StudyError as error:
        raise StudyError(map(_of_tests, error.mistakes)) from None


def _of_tests(mistake: Mistake) -> Mistake:
    """A mistake in a study; one in its sample is one in the tests."""
    key = re.sub(r"\bsample(\.points)?\b", "tests", mistake.key)
    return mistake if key == mistake.key else replace(mistake, key=key, source="")


def _columns(tests: object) -> dict[str, list[Any]]:
    """The columns of a table of tests by name."""
    if isinstance(tests, Mapping):
        lone = [name for name, values in tests.items() if isinstance(values, str) or np.ndim(values) != 1]
        if lone:
            allowed = "a list, with a value for each test"
            raise StudyError([Mistake(f"tests.{name}", literal(tests[name]), allowed) for name in lone])
        return {str(name): list(values) for name, values in tests.items()}
    if not isinstance(tests, str | PathLike):
        raise StudyError([Mistake("tests", literal(tests), "a CSV file, or columns by name")])
    report = Report()
    found = read_points(Path(tests), report, FileTable(), AXES, (LIFE,))
    if found is None:
        raise StudyError(replace(mistake, key="tests") for mistake in report)
    return found
