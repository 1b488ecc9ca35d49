"""Sobol indices: the share of a quantity's variance that each sampled parameter is responsible for."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from swtstudy.points.grid import SAMPLE
from swtstudy.results.evaluate import quantity
from swtstudy.study.sample import saltelli
from swtstudy.study.units.results import usual_measure
from swtstudy.vocabulary.mistakes import Report, literal, plain_number, refused
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.wording import value_words

#: Bootstrap samples: the ends of a confidence interval of 95 % are then known to a tenth of its width.
_RESAMPLES = 999

#: Half of an interval above which indices are told to be rough: intervals shrink with the root of the size.
KNOWN_TO = 0.2

_MEANINGS = {
    "first_order": "share of the variance by this parameter alone",
    "total": "share of the variance by this parameter, alone and with others",
}
#: The index itself, and the ends of its interval, as in the names of variables.
_ENDS = {"": "", "_low": ", lower end", "_high": ", upper end"}


def sensitivity(
    dataset: xr.Dataset, y: str | Sequence[str] = (), confidence: float = 0.95, seed: int = 0
) -> xr.Dataset:
    """Sobol indices of quantities over the parameters of a sample.

    Parameters
    ----------
    dataset
        Results of a study with a sample of the design "saltelli".
    y
        Quantities: names of data variables, or "s/s(name=value)". By default s; of results with units
        the quantity of the criterion, such as SWT.
    confidence
        Level of the confidence intervals, between 0 and 1.
    seed
        Seed of the bootstrap that gives the intervals.

    Returns
    -------
    xarray.Dataset
        ``first_order`` and ``total`` over ``quantity``, ``parameter`` and the axes of the results, with the
        ends of their confidence intervals, ``first_order_low``, ``first_order_high``, ``total_low`` and
        ``total_high``; and the ``mean`` and ``variance`` of each quantity.

    Raises
    ------
    StudyError
        A ValueError, if the sample is of another design or only a part of one, or if a quantity has no number
        at some of the points. Without these points the indices would have another meaning.

    Notes
    -----
    Computed by `scipy.stats.sobol_indices`, the confidence intervals by `scipy.stats.bootstrap`.
    """
    if not isinstance(dataset, xr.Dataset):
        raise refused("dataset", literal(dataset), "results, as of swtstudy.run or swtstudy.open_results")
    check_confidence(confidence)
    report = Report()
    report.seed(seed)
    report.refuse()
    names, size = _design(dataset)
    quantities = [y] if isinstance(y, str) else list(y) or [usual_measure(dataset)]
    values = {name: quantity(dataset, name) for name in quantities}
    for name, each in values.items():
        _check(name, each, dataset, report)
    report.refuse()
    parts = [_of_one(each, len(names), size, float(confidence), seed) for each in values.values()]
    symbols = ("parameter", [dataset[name].attrs.get("symbol", AXES[name].symbol) for name in names])
    whole = xr.concat(parts, xr.Variable("quantity", quantities))
    half = max(float((whole[f"{name}_high"] - whole[f"{name}_low"]).max()) for name in _MEANINGS) / 2.0
    if half > KNOWN_TO:
        needed = 2 ** math.ceil(math.log2(size * (half / KNOWN_TO) ** 2))
        words = f"indices are known to ±{half:.2g} only, and may be below 0 or above 1: a sample of some "
        warnings.warn(f"{words}size = {needed} gives ±{KNOWN_TO:g}", stacklevel=2)
    title = f"Sobol indices: {dataset.attrs['title']}" if "title" in dataset.attrs else "Sobol indices"
    found = whole.assign_coords(parameter=names, symbol=symbols)
    return found.assign_attrs(title=title, size=size, confidence=float(confidence), seed=seed)


def _of_one(values: xr.DataArray, count: int, size: int, confidence: float, seed: int) -> xr.Dataset:
    """Indices and moments of one quantity over the axes."""
    axes = [str(dim) for dim in values.dims if dim != SAMPLE]
    flat = values.transpose(*axes, SAMPLE).values.astype(float)
    rows = flat.reshape(-1, count + 2, size)
    with Progress(len(rows) * (_RESAMPLES + 2), "sensitivity", "resamples") as progress:
        found = np.array([_indices(row, confidence, seed, progress) for row in rows])
    variables: dict[str, Any] = {}
    for i, (end, name) in enumerate(itertools.product(_ENDS, _MEANINGS)):
        long_name = f"Sobol index, {name}{_ENDS[end]}".replace("_", " ")
        words = {"long_name": long_name, "comment": _MEANINGS[name], "units": "1"}
        variables[f"{name}{end}"] = (*axes, "parameter"), found[:, i].reshape(*flat.shape[:-1], -1), words
    both = flat[..., : 2 * size]  # independent points; the others are mixed from these
    variables["mean"] = axes, both.mean(-1), {"long_name": "mean of the quantity"}
    variables["variance"] = axes, both.var(-1), {"long_name": "variance of the quantity"}
    return xr.Dataset(variables, {axis: values[axis] for axis in axes})


def check_confidence(level: object) -> None:
    """Raise a StudyError unless a value is the level of a confidence interval."""
    if not 0.0 < plain_number(level) < 1.0:
        raise refused("confidence", literal(level), "a number between 0 and 1")


def check_design(design: str | None, source: str = "") -> None:
    """Raise a StudyError unless a sample has the design that Sobol indices need."""
    if design != "saltelli":
        found = f"the design {design}" if design else "no design"
        raise refused("sample.design", found, '"saltelli": Sobol indices need its points', source)


def _design(dataset: xr.Dataset) -> tuple[list[str], int]:
    """The sampled parameters and the size of the base of a Saltelli design."""
    attributes = dataset[SAMPLE].attrs if SAMPLE in dataset.coords else {}
    check_design(attributes.get("design"))
    names, size = str(attributes["parameters"]).split(), int(attributes["size"])
    if len(names) < 2:
        raise refused("sample.ranges", names[0], "at least two parameters")
    if dataset.sizes.get(SAMPLE) == size * (len(names) + 2):
        table = np.stack([dataset[name].values for name in names], axis=-1)
        if np.array_equal(table, saltelli(table[:size], table[size : 2 * size])):
            return names, size
    found = f"{dataset.sizes.get(SAMPLE)} of its points, or in another order"
    raise refused("sample", found, "all points of a saltelli design, as they were computed")


def _check(name: str, values: xr.DataArray, dataset: xr.Dataset, report: Report) -> None:
    """Report why a quantity cannot be analysed: it is no number, or not known everywhere."""
    if SAMPLE not in values.dims or "flag_values" in values.attrs or values.dtype.kind not in "fiu":
        report("y", f"{literal(name)}, which is no number over the sample", "a quantity such as 's'")
        return
    wrong = np.argwhere(~np.isfinite(values.values))
    if not len(wrong):
        return
    at = dict(zip(values.dims, wrong[0].tolist(), strict=True))
    place = values.isel(at)
    varying = [*str(dataset[SAMPLE].attrs["parameters"]).split(), *(d for d in values.dims if d != SAMPLE)]
    where = ", ".join(f"{name}={value_words(str(name), place[name].item())}" for name in varying)
    # A mean over several distances has more dimensions than the points.
    regime = dataset["regime"].isel(at, missing_dims="ignore")
    state = dataset["regime"].attrs["flag_meanings"].split()[int(regime)].replace("_", " ")
    found = f"no number at {len(wrong)} of {values.size} points, such as {where} ({state})"
    report(name, found, "a number at every point: other ranges, or another quantity")


def _indices(rows: NDArray[Any], confidence: float, seed: int, progress: Progress) -> NDArray[Any]:
    """First-order and total indices, and the lower and upper ends of their intervals, shape (6, d).

    Parameters
    ----------
    rows
        Shape (d + 2, n): values at the two samples, and at the first with one parameter of the second.
    confidence, seed
        As for `sensitivity`.
    progress
        Counts resamples.
    """
    from scipy.stats import bootstrap, sobol_indices

    n = rows.shape[1]

    def both(chosen: NDArray[np.int64]) -> NDArray[Any]:
        progress.add()
        some = rows[:, chosen]
        found = sobol_indices(func={"f_A": some[0], "f_B": some[1], "f_AB": some[2:, None]}, n=n)
        return np.array([found.first_order, found.total_order])

    every = np.arange(n)
    how: dict[str, Any] = {"vectorized": False, "method": "percentile", "random_state": seed}
    found = bootstrap((every,), both, n_resamples=_RESAMPLES, confidence_level=confidence, **how)
    ends = found.confidence_interval
    return np.concatenate([both(every), ends.low, ends.high])
