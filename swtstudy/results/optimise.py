"""`swtstudy.optimise`: the parameters for which a quantity is least, and those for which it is greatest.

What is found is a Dataset: an optimum, how it was found, its neighbourhood and the worst case.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.results.least import Least, least
from swtstudy.results.objective import Box, Objective, read_box, worst
from swtstudy.solving import solve_grid
from swtstudy.units.results import LIVES
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.mistakes import (
    ALLOWED_RTOL,
    ALLOWED_SEED,
    DEFAULT_RTOL,
    Report,
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

_NOT_ALWAYS = ("s_error", "run", *MARGINS)
#: The data variables that may be made least: those with values that are not flags, and what may be asked.
MINIMISED = (
    *(n for n, words in ATTRIBUTES.items() if "flag_values" not in words and n not in _NOT_ALWAYS),
    *NAMED,
)
#: Steps of the neighbourhood, as fractions of a range.
_STEPS = np.linspace(-0.1, 0.1, 41)


def dataset_of(
    box: Box, found: Mapping[str, Least], quantity: str, solve: Callable[[Grid], xr.Dataset]
) -> xr.Dataset:
    """The Dataset of the optima by case; see `swtstudy.optimise`."""
    units = np.array([each.unit for each in found.values()])
    cases = solve(box.sample(units)).drop_vars(SAMPLE).rename({SAMPLE: "case"})
    cases = cases.assign_coords(case=list(found))
    own = {key: words for key, words in cases[quantity].attrs.items() if key in ("units", "symbol")}
    progress = np.full((len(found), max(len(each.progress) for each in found.values())), np.nan)
    for row, each in zip(progress, found.values(), strict=True):
        row[: len(each.progress)] = each.progress
    columns = list(zip(*((e.searched, e.converged, e.evaluations) for e in found.values()), strict=True))
    how: dict[str, Any] = {
        "searched": ("case", np.array(columns[0]), {"long_name": f"{quantity} before the polish", **own}),
        "progress": (
            ("case", "generation"),
            progress,
            {"long_name": f"{quantity} after each generation", **own},
        ),
        "converged": ("case", np.array(columns[1], np.int8), {"long_name": "whether the search converged"}),
        "evaluations": ("case", np.array(columns[2]), {"long_name": "number of points solved"}),
    }
    return cases.assign(how).merge(_neighbourhood(box, units, quantity, own, solve))


def _neighbourhood(
    box: Box, units: FloatArray, quantity: str, own: dict[str, str], solve: Callable[[Grid], xr.Dataset]
) -> xr.Dataset:
    """The quantity along each parameter through each of n points of the unit cube, shape (n, d)."""
    d = units.shape[1]
    # Shape (cases, d, steps, d): every parameter is stepped by itself.
    places = units[:, None, None, :] + np.eye(d)[:, None, :] * _STEPS[:, None]
    inside = ((places >= 0.0) & (places <= 1.0)).all(axis=-1)
    found = np.full(inside.shape, np.nan)
    found[inside] = worst(solve(box.sample(places[inside]))[quantity])
    stepped = np.moveaxis(np.diagonal(box.values(places), axis1=1, axis2=3), -1, 1)
    along = ("case", "parameter", "step")
    values = np.where(inside, stepped, np.nan)
    words = {"long_name": "value of the parameter", "comment": "the others are those of the case"}
    return xr.Dataset(
        {"nearby": (along, found, {"long_name": f"{quantity} along each parameter", **own})},
        {
            "nearby_value": (along, values, words),
            "parameter": list(box.names),
            "step": ("step", _STEPS, {"long_name": "step as a fraction of the range"}),
        },
    )


#: What is looked for, and the sign that makes it the least of something.
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
    in one batch; a bundle method follows its best points into the kinks that s has where two local maxima
    over the body change places. The same call gives the same result.

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
        found: ``evaluations``, ``converged``, ``searched`` (the value before the polish) and ``progress``
        over ``generation``. The neighbourhood is ``nearby``, the quantity along each ``parameter`` through
        the point, at ``nearby_value``, ``step`` of its range away; NaN outside of the range.
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
        box = read_box(over, parameters)
        known += box.corners.margins
    check_asked(report, minimise, rtol, seed, known)
    report.refuse()
    return optimum_in(
        box, minimise, float(rtol), int(seed), Request((minimise,) if minimise in NAMED else ())
    )


def optimum_in(box: Box, minimise: str, rtol: float, seed: int, asked: Request) -> xr.Dataset:
    """The best and the worst points of a box; see `optimise`. Of a life the best is the longest."""
    turn = -1 if minimise in LIVES else 1
    solve = partial(solve_grid, rtol=rtol, asked=asked)
    objectives = [Objective(box, solve, minimise, turn * sign) for sign in CASES.values()]
    with Progress(None, "optimise"):
        found = {
            case: least(each, len(box.names), seed) for case, each in zip(CASES, objectives, strict=True)
        }
        dataset = dataset_of(box, found, minimise, solve)
    without = sum(int(np.isinf(objective.values).sum()) for objective in objectives)
    return dataset.assign_attrs(minimise=minimise, seed=seed, without_value=without)


def check_asked(report: Report, minimise: object, rtol: object, seed: object, known: Collection[str]) -> None:
    """Report mistakes in how an optimum is asked for; ``known`` may be minimised."""
    if minimise not in known:
        report("minimise", literal(minimise), nearest(str(minimise), known))
    if not is_rtol(rtol):
        report("rtol", literal(rtol), ALLOWED_RTOL)
    if not is_seed(seed):
        report("seed", literal(seed), ALLOWED_SEED)
