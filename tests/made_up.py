"""Made-up results for the tests of the statements."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import xarray as xr

#: Phases over one turn, its end included.
PHASES = np.linspace(0, 2 * np.pi, 49)


def made_up(function: Callable[..., xr.DataArray], **axes: object) -> xr.Dataset:
    """Results with s = function(axes), and everything else as it usually is."""
    arrays = {name: xr.DataArray(np.atleast_1d(values), dims=name) for name, values in axes.items()}
    coords = {name: array.values for name, array in arrays.items()}
    s = sum((0 * array for array in arrays.values() if array.dtype.kind == "f"), function(**arrays))
    for name in axes:
        s = s if name in s.dims else s.expand_dims({name: coords[name]})
    s = s.assign_coords(coords).transpose(*axes)
    zero = xr.zeros_like(s)
    return xr.Dataset(
        {"s": s, "s_error": zero + 1e-6, "critical_x": zero + 1, "critical_angle": zero, "regime": zero + 1}
    )
