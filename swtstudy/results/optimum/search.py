"""The search of the whole box: differential evolution, a generation in one batch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.results.optimum.objective import Function

#: Points of a generation: so many for each parameter, about scipy's 15, and not fewer than the latter.
_EACH, _LEAST = 16, 64
#: The search goes so far beyond the ends of a range, which counts as the ends: extremes are often there, and
#: differential evolution sends what leaves its bounds back to anywhere inside.
_BEYOND = 0.1
#: Generations at most; most searches converge before.
_GENERATIONS = 100
#: A population has converged when its values differ by this fraction of their mean: the polish does the rest.
_SPREAD = 0.01


@dataclass(frozen=True)
class Found:
    """The result of a search.

    Attributes
    ----------
    progress
        Least value after each generation, the first population included.
    converged
        Whether the population has converged.
    """

    progress: FloatArray
    converged: bool


def search(function: Function, dimensions: int, seed: int) -> Found:
    """Search the unit cube for the least value of a function; the function keeps where that is."""
    from scipy.optimize import OptimizeResult, differential_evolution

    lowest: list[float] = []

    def batch(columns: FloatArray) -> FloatArray:
        values = function(np.clip(columns.T, 0.0, 1.0))
        lowest.append(float(values.min()))
        return values

    found: OptimizeResult = differential_evolution(
        batch,
        [(-_BEYOND, 1.0 + _BEYOND)] * dimensions,
        popsize=max(_EACH, _LEAST // dimensions),
        init="sobol",
        maxiter=_GENERATIONS,
        tol=_SPREAD,
        seed=seed,
        polish=False,
        updating="deferred",
        vectorized=True,
    )
    return Found(np.minimum.accumulate(lowest), bool(found.success))
