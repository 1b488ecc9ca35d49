"""Margins of the points of a grid, as data variables: how far they are from where the model ends."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.margins import Margins
from swtstudy.points.blocks import block_ends
from swtstudy.points.canonical import points_from
from swtstudy.points.grid import Grid
from swtstudy.points.unique import UniquePoints


def margins(points: UniquePoints, grid: Grid) -> dict[str, NDArray]:
    """Data variables of the points of a grid, each of shape (grid.size,), by `Grid.margins`.

    ``bulk_shift`` as long as it is no larger than the width of the slip zone.
    """
    names = grid.margins
    if not names:
        return {}
    blocks = np.split(points.table, block_ends(points.table)[:-1])
    every = [Margins.of(points_from(block, points.definitions)) for block in blocks]
    radius, width, shift, ratio = (
        np.concatenate([getattr(each, name) for each in every])[points.index] for name in vars(every[0])
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        found = {
            "bulk_shift": np.where(shift <= width, shift, np.nan),
            "bulk_shift_ratio": shift / width,
            "prescribed_force_ratio": ratio,
        }
    if "radius_ratio" in names:
        found["radius_ratio"] = radius * grid.curvatures
    return {name: found[name] for name in names}
