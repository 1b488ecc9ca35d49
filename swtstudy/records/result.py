"""What comes of solving some points together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import IntArray, Solution


@dataclass(frozen=True)
class Result:
    """What came of a chunk.

    Attributes
    ----------
    rows
        As in the chunk.
    solution
        NaN for points that failed.
    failed
        Shape (n,).
    messages
        Why a point failed, by its position in `rows`.
    seconds
        Time that the worker took.
    solver_version
        Of the mechanics on the worker.
    """

    rows: IntArray
    solution: Solution
    failed: NDArray[np.bool_]
    messages: dict[int, str]
    seconds: float
    solver_version: str

    def __len__(self) -> int:
        return len(self.rows)
