"""swt at places of the body of one point, as batches that `scenes` draws."""

from fractions import Fraction
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray
from solved import Points

from swtstudy.kernel.field import Opened, criterion_at, instants_at, open_cycle, stress_at
from swtstudy.paper.maxima import body_maximum as body_maximum
from swtstudy.paper.maxima import dense_maximum as dense_maximum

Array = NDArray[np.float64]

#: Straight down, to the right and down.
DOWN = (0.0, 1.0)


def opened(batch: Points) -> Opened:
    """The load cycle of a batch of one point."""
    given: dict[str, Any] = {
        name.replace("bulk_stress", "bulk"): value for name, value in vars(batch).items()
    }
    p, q, path, control = (given.pop(name) for name in ("p", "q", "path", "control"))
    given["pulled"] = given.pop("bulk_strain_share")
    given["frequency_ratio"] = [*map(Fraction, p.tolist(), q.tolist())]
    given["loops"] = None if path is None else [path] * len(batch)
    return open_cycle(**given, control=control)


def von_mises(field: xr.Dataset) -> Array:
    """The von Mises stress in results of `swtstudy.stress_field`."""
    xx, yy, zz, yz, xz, xy = (field[f"sigma_{name}"].values for name in ("xx", "yy", "zz", "yz", "xz", "xy"))
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * normal + 3.0 * (yz**2 + xz**2 + xy**2)))


def swt_at(
    batch: Points, x: ArrayLike, y: ArrayLike, z: ArrayLike, tolerance: float = 1e-4
) -> tuple[Array, Array]:
    """The criterion over all planes at places of shape S, and the normals of its planes, S + (3,)."""
    coordinates = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (x, y, z)))
    places = np.stack([v.ravel() for v in coordinates], axis=1)
    values, _, normals = criterion_at(opened(batch), places, tolerance)
    shape = coordinates[0].shape
    return values.reshape(shape), normals.reshape(*shape, 3)


def history_at(batch: Points, x: float, y: float, z: float) -> Array:
    """The stress at a place at the instants that tell its criterion, shape (T, 6)."""
    cycle, place = opened(batch), np.array([x, y, z])
    return stress_at(cycle, place[None], instants_at(cycle, place, 1e-5))[0]
