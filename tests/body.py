"""swt at places of the body of one point, as batches that `scenes` draws."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.kernel.field import Opened, criterion_at, instants_at, open_cycle, stress_at
from swtstudy.paper.audit.body_maximum import body_maximum as body_maximum
from swtstudy.paper.audit.dense import dense_maximum as dense_maximum
from swtstudy.solver.means import DOWN as DOWN
from swtstudy.solver.means import worst_means as worst_means
from swtstudy.solver.points import arguments_of

Array = NDArray[np.float64]


def opened(batch: Any) -> Opened:
    """The load cycle of a batch of one point."""
    return open_cycle(**arguments_of(batch))


def swt_at(
    batch: Any, x: ArrayLike, y: ArrayLike, z: ArrayLike, tolerance: float = 1e-4
) -> tuple[Array, Array]:
    """The criterion over all planes at places of shape S, and the normals of its planes, S + (3,)."""
    coordinates = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (x, y, z)))
    places = np.stack([v.ravel() for v in coordinates], axis=1)
    values, _, normals = criterion_at(opened(batch), places, tolerance)
    shape = coordinates[0].shape
    return values.reshape(shape), normals.reshape(*shape, 3)


def history_at(batch: Any, x: float, y: float, z: float) -> Array:
    """The stress at a place at the instants that tell its criterion, shape (T, 6)."""
    cycle, place = opened(batch), np.array([x, y, z])
    return stress_at(cycle, place[None], instants_at(cycle, place, 1e-5))[0]
