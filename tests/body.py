"""swt at places of the body of one point, as batches that `scenes` draws."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.kernel.field import criterion_at, instants_at, open_cycle, stress_at
from swtstudy.solver.points import arguments_of

Array = NDArray[np.float64]


def swt_at(
    batch: Any, x: ArrayLike, y: ArrayLike, z: ArrayLike, tolerance: float = 1e-4
) -> tuple[Array, Array]:
    """The criterion over all planes at places of shape S, and the normals of its planes, S + (3,)."""
    coordinates = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (x, y, z)))
    places = np.stack([v.ravel() for v in coordinates], axis=1)
    values, _, normals = criterion_at(open_cycle(**arguments_of(batch)), places, tolerance)
    shape = coordinates[0].shape
    return values.reshape(shape), normals.reshape(*shape, 3)


def history_at(batch: Any, x: float, y: float, z: float) -> Array:
    """The stress at a place at the instants that tell its criterion, shape (T, 6)."""
    opened, place = open_cycle(**arguments_of(batch)), np.array([x, y, z])
    return stress_at(opened, place[None], instants_at(opened, place, 1e-5))[0]
