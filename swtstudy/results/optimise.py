"""`swtstudy.optimise`: the parameters for which a quantity is least, and those for which it is greatest.

s is the largest of many local maxima, over points, planes and instants, each of which depends smoothly on the
parameters. Its least value is mostly in a kink, where some of them are equal: there a descent along gradients
zigzags and a simplex collapses. Differential evolution compares values alone: its population contracts upon a
kink as fast as upon a smooth minimum, and a generation is one batch.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import read_grid
from swtstudy.points.values import NUMERIC
from swtstudy.solving import solve_grid
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.derived import LIVES
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    ALLOWED_SEED,
    DEFAULT_RTOL,
    Mistake,
    Report,
    StudyError,
    is_rtol,
    is_seed,
    literal,
    nearest,
)
from swtstudy.vocabulary.naming import with_parameters
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import NAMED, Request
from swtstudy.vocabulary.variables import ATTRIBUTES, MARGINS


@dataclass(frozen=True)
class Box:
    """Ranges of d parameters; the others are fixed. A point of it is a point of the unit cube.

    Attributes
    ----------
    corners
        The grid of the ends of all ranges; of real contacts of both bodies, too.
    names
        The parameters that are searched over.
    low, high
        Shape (d,): the ends of the ranges, in the order of the names.
    """

    corners: Grid
    names: tuple[str, ...]
    low: FloatArray
    high: FloatArray

    @classmethod
    def of(cls, corners: Grid, over: Mapping[str, object]) -> Box:
        """That of a grid of the ends of ranges; a StudyError if one of them is the wrong way round."""
        low, high = np.array([corners.axes[name] for name in over], float).T
        names = [name for name, wrong in zip(over, low > high, strict=True) if wrong]
        if names:
            raise StudyError([Mistake(f"over.{n}", literal(over[n]), "the lower end first") for n in names])
        return cls(corners, tuple(over), low, high)

    def values(self, unit: FloatArray) -> FloatArray:
        """Values of the parameters at points of the unit cube, shape (n, d)."""
        # Not low + unit (high - low): rounding must not leave the range.
        return self.low * (1.0 - unit) + self.high * unit

    def sample(self, unit: FloatArray) -> Grid:
        """The grid whose sample is n points of the unit cube, shape (n, d)."""
        columns = zip(self.names, self.values(unit).T, strict=True)
        axes = {name: values for name, values in self.corners.axes.items() if name not in self.names}
        samples = {name: tuple(column.tolist()) for name, column in columns}
        return replace(self.corners, axes=axes, samples=samples)


def read_ranges(over: object, names: Collection[str]) -> tuple[dict[str, list[object] | None], Report]:
    """The ranges by name, ``(low, high)`` each, of parameters of some names, None for one that is none."""
    if not isinstance(over, Mapping) or not over:
        raise StudyError([Mistake("over", literal(over), 'ranges by name, such as {"phase": (0, "2*pi")}')])
    report = Report()
    axes: dict[str, list[object] | None] = {}
    for name, ends in over.items():
        key = f"over.{name}"
        if name not in names:
            report(key, "not a parameter that is a number", nearest(str(name), names))
            continue
        axes[name] = None
        if not isinstance(ends, list | tuple | np.ndarray) or np.shape(ends) != (2,):
            report(key, literal(ends), "both ends of a range, (low, high)")
        else:
            axes[name] = list(ends)
    return axes, report


def worst(values: xr.DataArray) -> FloatArray:
    """Values of the points of a sample: of both bodies, and both directions, that which is worse."""
    others = [dim for dim in values.dims if dim != SAMPLE]
    return np.asarray((values.min(others) if values.name in LIVES else values.max(others)).values, float)


#: Points of a generation: so many for each parameter, about scipy's 15, and not fewer than the latter.
_POINTS_EACH, _LEAST = 16, 64
#: The search goes so far beyond the ends of a range, which counts as the ends: extremes are often there, and
#: differential evolution sends what leaves its bounds back to anywhere inside.
_BEYOND = 0.1
#: Shares of a difference between two points by which a third is moved: smaller ones than scipy's contract a
#: population in fewer generations.
_MUTATION = (0.3, 0.7)
#: Strategies one after the other, and the fraction of their mean by which values differ when each has
#: converged: around points at random fewer minima are missed, around the best one a population contracts in
#: half the generations. Rounding of s is 1e-8.
_STRATEGIES = {"rand1bin": 3e-3, "best1bin": 1e-7}
#: Generations of each at most; most searches converge before.
_GENERATIONS = 150


class Least(NamedTuple):
    """The least value of a function in the unit cube, and how it was found.

    Attributes
    ----------
    unit
        Shape (d,): where it is.
    progress
        Least value after each generation of the search; infinite before there was a finite one.
    converged
        Whether the population of the search has converged.
    evaluations, without_value
        Number of points evaluated, and number of those among them without a finite value.
    """

    unit: FloatArray
    progress: FloatArray
    converged: bool
    evaluations: int
    without_value: int


def least(function: Callable[[FloatArray], FloatArray], dimensions: int, seed: int) -> Least:
    """The least value of a function of n points of the unit cube, shape (n, d) to (n,).

    Raises
    ------
    StudyError
        If it has no finite value anywhere.
    """
    from scipy.optimize import differential_evolution

    batches: list[FloatArray] = []

    def batch(columns: FloatArray) -> FloatArray:
        found = function(np.clip(columns.T, 0.0, 1.0))
        batches.append(np.where(np.isfinite(found), found, np.inf))
        return batches[-1]

    population: Any = "sobol"
    for strategy, spread in _STRATEGIES.items():
        found = differential_evolution(
            batch,
            [(-_BEYOND, 1.0 + _BEYOND)] * dimensions,
            strategy=strategy,
            popsize=max(_POINTS_EACH, _LEAST // dimensions),
            init=population,
            maxiter=_GENERATIONS,
            tol=spread,
            mutation=_MUTATION,
            seed=seed,
            polish=False,
            updating="deferred",
            vectorized=True,
        )
        population = found.population
    values = np.concatenate(batches)
    if not np.isfinite(found.fun):
        words = f"no finite value at any of {len(values)} points"
        raise StudyError([Mistake("over", words, "ranges in which the quantity is finite somewhere")])
    progress = np.minimum.accumulate([each.min() for each in batches])
    without = int(np.isinf(values).sum())
    return Least(np.clip(found.x, 0.0, 1.0), progress, bool(found.success), len(values), without)


_NOT_ALWAYS = ("s_error", "run", *MARGINS)
#: The data variables that may be made least: those with values that are not flags, and what may be asked.
MINIMISED = (
    *(n for n, words in ATTRIBUTES.items() if "flag_values" not in words and n not in _NOT_ALWAYS),
    *NAMED,
)
#: Steps of the neighbourhood, as fractions of a range.
_STEPS = np.linspace(-0.1, 0.1, 41)


def _neighbourhood(box: Box, units: FloatArray, values: Callable[[FloatArray], FloatArray]) -> xr.Dataset:
    """The quantity along each parameter through each of n points of the unit cube, shape (n, d)."""
    # Shape (cases, d, steps, d): every parameter is stepped by itself.
    places = units[:, None, None, :] + np.eye(units.shape[1])[:, None, :] * _STEPS[:, None]
    inside = ((places >= 0.0) & (places <= 1.0)).all(axis=-1)
    found = np.full(inside.shape, np.nan)
    found[inside] = values(places[inside])
    stepped = np.moveaxis(np.diagonal(box.values(places), axis1=1, axis2=3), -1, 1)
    along = ("case", "parameter", "step")
    words = {"long_name": "value of the parameter", "comment": "the others are those of the case"}
    return xr.Dataset(
        {"nearby": (along, found)},
        {
            "nearby_value": (along, np.where(inside, stepped, np.nan), words),
            "parameter": [*box.names],
            "step": ("step", _STEPS, {"long_name": "step as a fraction of the range"}),
        },
    )


#: Goals, and the sign that makes each the least of something.
CASES = {"best": 1, "worst": -1}


@with_parameters(PARAMETERS.values())
def optimise(
    *,
    over: Mapping[str, tuple[object, object]],
    minimise: str = "s",
    rtol: float = DEFAULT_RTOL,
    seed: int = 0,
    **parameters: object,
) -> xr.Dataset:
    """The parameters in given ranges for which a quantity is least, and those for which it is greatest.

    Differential evolution (`scipy.optimize.differential_evolution`) searches the ranges, a generation solved
    in one batch, until its points meet, also in a kink, which s has where two local maxima over the body
    change places. The same call gives the same result.

    Parameters
    ----------
    over
        Ranges by name, ``(low, high)``, of parameters that are numbers. Ends may be texts such as "2*pi".
    minimise
        The data variable that is made least, "s" by default; or a quantity of
        `swtstudy.vocabulary.quantities.NAMED`.
    rtol
        Relative accuracy asked of s.
    seed
        Seed of the random numbers, 0 or more.
    **parameters
        The names below, each a single value, as for `swtstudy.solve`.

    Returns
    -------
    xarray.Dataset
        Along ``case``, "best" and "worst": the data variables of `swtstudy.solve` at the least and at the
        greatest value of the quantity, with the parameters of ``over`` as coordinates; and how they were
        found: ``evaluations``, ``converged``, and ``progress`` over ``generation``. The neighbourhood is
        ``nearby``, the quantity along each ``parameter`` through the point, at ``nearby_value``, ``step`` of
        its range away; NaN outside of the range.
        Points where the quantity is not finite are left out; ``without_value`` counts them.

    Raises
    ------
    StudyError
        A ValueError with every mistake, or if the quantity is finite nowhere.

    Examples
    --------
    >>> import swtstudy
    >>> found = swtstudy.optimise(over={"phase": (0, "pi")}, normal_amplitude=0.75)
    >>> found.phase.sel(case="best").round(3).item(), found.s.sel(case="best").round(4).item()
    (2.662, 0.1053)
    """
    report, known = Report(), MINIMISED
    with report:
        axes, wrong = read_ranges(over, NUMERIC)
        corners, found = read_grid(parameters, axes, lambda name: f"over.{name}" if name in axes else name)
        if corners is None or wrong:
            raise StudyError([*wrong, *found])
        box = Box.of(corners, over)
        known += box.corners.margins
    check_asked(report, minimise, rtol, seed, known)
    report.refuse()
    return optimum_in(
        box, minimise, float(rtol), int(seed), Request((minimise,) if minimise in NAMED else ())
    )


def optimum_in(box: Box, minimise: str, rtol: float, seed: int, asked: Request) -> xr.Dataset:
    """The best and the worst points of a box; see `optimise`. Of a life the best is the longest."""
    turn, solve = -1 if minimise in LIVES else 1, partial(solve_grid, rtol=rtol, asked=asked)

    def values(unit: FloatArray, sign: int = 1) -> FloatArray:
        return sign * worst(solve(box.sample(unit))[minimise])

    with Progress(None, "optimise"):
        optima = [least(partial(values, sign=turn * sign), len(box.names), seed) for sign in CASES.values()]
        units = np.array([each.unit for each in optima])
        cases = solve(box.sample(units)).drop_vars(SAMPLE).rename({SAMPLE: "case"})
        nearby = _neighbourhood(box, units, values)
    own = {key: words for key, words in cases[minimise].attrs.items() if key in ("units", "symbol")}
    nearby["nearby"].attrs = {"long_name": f"{minimise} along each parameter", **own}
    rows = [turn * sign * each.progress for sign, each in zip(CASES.values(), optima, strict=True)]
    progress = np.array([*itertools.zip_longest(*rows, fillvalue=np.nan)]).T
    converged = np.array([each.converged for each in optima], np.int8)
    evaluations = [each.evaluations for each in optima]
    how = xr.Dataset(
        {
            "progress": (
                ("case", "generation"),
                progress,
                {"long_name": f"{minimise} after each generation", **own},
            ),
            "converged": ("case", converged, {"long_name": "whether the search converged"}),
            "evaluations": ("case", evaluations, {"long_name": "number of points solved"}),
        },
        {"case": [*CASES]},
    )
    without = sum(each.without_value for each in optima)
    return cases.merge(how).merge(nearby).assign_attrs(minimise=minimise, seed=seed, without_value=without)


def check_asked(report: Report, minimise: object, rtol: object, seed: object, known: Collection[str]) -> None:
    """Report mistakes in how an optimum is asked for; ``known`` may be minimised."""
    if minimise not in known:
        report("minimise", literal(minimise), nearest(str(minimise), known))
    if not is_rtol(rtol):
        report("rtol", literal(rtol), ALLOWED_RTOL)
    if not is_seed(seed):
        report("seed", literal(seed), ALLOWED_SEED)
