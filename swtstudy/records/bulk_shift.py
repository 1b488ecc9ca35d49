"""The shift of the stick zone as a data variable, where there is an oscillating bulk stress."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.grid.blocks import block_ends
from swtstudy.grid.canonical import points_from, select
from swtstudy.grid.unique import UniquePoints
from swtstudy.mechanics.stress.bulk_shift import bulk_shift


def shifts(points: UniquePoints) -> dict[str, NDArray]:
    """``bulk_shift`` of the points of a grid, shape (grid.size,); nothing where no bulk stress oscillates."""
    if not select(points.table, ("bulk_stress_amplitude",)).any():
        return {}
    blocks = np.split(points.table, block_ends(points.table)[:-1])
    values = [bulk_shift(points_from(block, points.definitions)) for block in blocks]
    return {"bulk_shift": np.concatenate(values)[points.index]}
