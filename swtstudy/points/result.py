"""The result of solving a chunk of points."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray, IntArray, Solution


@dataclass(frozen=True)
class Result:
    """The result of a chunk of n points.

    Attributes
    ----------
    rows
        Indices of the points in the table of the run, as in the chunk, shape (n,).
    solution
        Arrays of shape (n,); NaN for points that failed.
    failed
        Whether a point failed, shape (n,).
    messages
        Why a point failed, by its position in `rows`.
    seconds
        Time that the worker took.
    solver_version
        Version of the solver on the worker.
    items
        The quantities that were asked beside s, as in `swtstudy.vocabulary.quantities.Request.items`.
    quantities
        Their values by `swtstudy.vocabulary.quantities.columns_of`, each of shape (n,); NaN for points that
        failed.
    """

    rows: IntArray
    solution: Solution
    failed: NDArray[np.bool_]
    messages: dict[int, str]
    seconds: float
    solver_version: str
    items: tuple[str, ...] = ()
    quantities: dict[str, FloatArray] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.rows)
