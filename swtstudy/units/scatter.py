"""Lives where the constants of the material scatter: percentiles, and the probability of an earlier crack."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.units.life import FatigueConstants, life
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.quantities import COUNTED, COUNTED_SIZES
from swtstudy.vocabulary.wording import number_words

if TYPE_CHECKING:
    import xarray as xr

    from swtstudy.units.grid import PhysicalGrid

#: Constants that may scatter, in the order of `FatigueConstants`.
SCATTERED = ("strength", "strength_exponent", "ductility", "ductility_exponent")
#: Per cent of the bodies that have a crack before the life of that name.
PERCENTS = (10, 50, 90)
#: Newton steps for a life: from the larger of both terms six reach rounding.
_STEPS = 12
#: Most lives in memory at once.
_AT_ONCE = 1_000_000


@dataclass(frozen=True)
class Scatter:
    """Draws of constants of the materials of both bodies.

    Attributes
    ----------
    names
        The constants that scatter, of `SCATTERED`.
    draws
        The values of each, all of one length.
    target
        A life in load cycles, before which the probability of a crack is asked for; 0 for none.
    """

    names: tuple[str, ...]
    draws: tuple[tuple[float, ...], ...]
    target: float = 0.0

    def terms(self, constants: FatigueConstants) -> tuple[FloatArray, FloatArray]:
        """Levels and slopes of both terms of the life over the logarithm of 2N, each of shape (n, 2)."""
        own = dict(zip(self.names, np.array(self.draws), strict=True))
        count = len(self.draws[0])
        strength, b, ductility, c = (
            own.get(name, np.full(count, getattr(constants, name))) for name in SCATTERED
        )
        level = 2.0 * np.log(strength) - np.log(constants.young_modulus), np.log(strength) + np.log(ductility)
        return np.stack(level, axis=-1), np.stack([2.0 * b, b + c], axis=-1)


def scattered_in(lives: Sequence[str], target: bool) -> Iterator[tuple[str, str]]:
    """Each life by tension among names, with the name of a variable that scatter adds to it."""
    for name in lives:
        if name.startswith("cycles"):
            yield from ((name, f"{name}_{percent}") for percent in PERCENTS)
            yield from [(name, f"failure_probability{name.removeprefix('cycles')}")] * target


def scattered(dataset: xr.Dataset, grid: PhysicalGrid, lives: Sequence[str]) -> dict[str, Any]:
    """Percentiles of lives, and failure probabilities, over the draws of a grid.

    Parameters
    ----------
    dataset
        Results with SWT, its means, and counted strain cycles, if these are counted.
    grid
        Its contacts, with their scatter.
    lives
        Names of lives.

    Returns
    -------
    dict
        Dimensions, values and attributes by name.
    """
    scatter = grid.scatter
    assert scatter is not None
    found: dict[str, Any] = {}
    for name in (each for each in lives if each.startswith("cycles")):
        values = dataset[f"SWT{name.removeprefix('cycles')}"]
        ranks = _of_bodies(values, dataset, grid, scatter)
        words = dataset[name].attrs
        symbol = words["symbol"].removeprefix("N").removeprefix(r"_\mathrm{").removesuffix("}")
        for percent, each in zip(PERCENTS, ranks, strict=False):
            below = ", ".join(filter(None, (symbol, str(percent))))
            meaning = f"{words['long_name']}, before which {percent} % fail"
            own = {"long_name": meaning, "symbol": rf"N_\mathrm{{{below}}}", "units": "1"}
            found[f"{name}_{percent}"] = values.dims, each, own
        if scatter.target:
            meaning = f"probability of a crack before {number_words(scatter.target)} load cycles"
            own = {"long_name": meaning, "symbol": rf"P_\mathrm{{{symbol}}}" if symbol else "P", "units": "1"}
            found[f"failure_probability{name.removeprefix('cycles')}"] = values.dims, ranks[-1], own
    return found


def _of_bodies(values: xr.DataArray, dataset: xr.Dataset, grid: PhysicalGrid, scatter: Scatter) -> FloatArray:
    """Percentiles, and the failure probability last, of each point's own body, shape (4, ...)."""
    import xarray as xr

    counted: list[FloatArray] = []
    if {*COUNTED} <= {*map(str, dataset.data_vars)}:
        dims = (*values.dims, *COUNTED_SIZES)
        counted = [dataset[name].broadcast_like(values).transpose(*dims).values for name in COUNTED]
    own = [
        _ranks(values.values, counted, *scatter.terms(constants), scatter.target)
        for constants in dict.fromkeys(grid.materials)
    ]
    first = xr.zeros_like(values, bool) | (grid.bodies == 0)
    return np.where(first.transpose(*values.dims), own[0], own[-1])


def _ranks(
    values: FloatArray, counted: list[FloatArray], level: FloatArray, slopes: FloatArray, target: float
) -> FloatArray:
    """See `_of_bodies`; in parts of the points, so that memory is bounded."""
    flat = values.ravel()
    of_each = [each.reshape(len(flat), *each.shape[-2:]) for each in counted]
    found = np.full((len(PERCENTS) + 1, len(flat)), np.nan)
    size = max(1, _AT_ONCE // (len(level) * (of_each[0][0].size if of_each else 1)))
    for begin in range(0, len(flat), size):
        part = slice(begin, begin + size)
        known = np.isfinite(flat[part])
        lives = _lives(flat[part][known], [each[part][known] for each in of_each], level, slopes)
        # Without interpolation: a life may be infinite.
        ranks = np.quantile(lives, np.array(PERCENTS) / 100.0, axis=0, method="inverted_cdf")
        found[:, np.flatnonzero(known) + begin] = [*ranks, (lives < target).mean(axis=0)]
    return found.reshape(-1, *values.shape)


def _lives(value: FloatArray, counted: list[FloatArray], level: FloatArray, slopes: FloatArray) -> FloatArray:
    """Load cycles to a crack at m values for n draws, shape (n, m); see `FatigueConstants.rounds`."""
    level, slopes = level[:, None, :], slopes[:, None, :]
    lives = life(level, slopes, value, _STEPS)
    if not counted or not len(value):
        return lives
    ratio, number = counted
    known = (ratio > 0.0) & (number > 0.0)
    damage = np.zeros((len(level), *known.shape))
    with np.errstate(divide="ignore"):  # no damage at 0
        each = life(level, slopes, (value[:, None, None] * ratio)[known], _STEPS)
        damage[:, known] = number[known] / each
        rounds = 1.0 / damage.sum(axis=-1).max(axis=-1)
    return np.where(known.any(axis=(-2, -1)), rounds, lives)
