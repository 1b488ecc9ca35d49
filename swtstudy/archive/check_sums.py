"""Check sums of what HDF5 itself keeps none of: single values and names.

HDF5 has them for arrays of numbers (fletcher32) and for attributes. Those of the others are in a group of
their own: whoever changes what was read and saves it, with xarray say, leaves an archive without them, not
one with those of other values.
"""

from __future__ import annotations

import zlib
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr

_GROUP = "check_sums"


def has_its_own(variable: xr.Variable | xr.DataArray) -> bool:
    """Whether HDF5 can keep a check sum of the values."""
    return bool(variable.ndim) and variable.dtype.kind in "biuf"


def write_check_sums(path: Path, dataset: xr.Dataset) -> None:
    """Add the check sums to a file that holds a Dataset."""
    import netCDF4

    with netCDF4.Dataset(path, "a") as file:
        file.createGroup(_GROUP).setncatts(
            {str(name): _check_sum(each) for name, each in dataset.variables.items() if not has_its_own(each)}
        )


def damaged(file: netCDF4.Dataset, dataset: xr.Dataset) -> list[str]:
    """Names of the variables read from a file that do not agree with their check sums in it, if there are."""
    group = file.groups.get(_GROUP)
    written = {} if group is None else {name: group.getncattr(name) for name in group.ncattrs()}
    return [
        str(name)
        for name, each in dataset.variables.items()
        if name in written and not has_its_own(each) and written[str(name)] != _check_sum(each)
    ]


def unreadable(file: netCDF4.Dataset) -> list[str]:
    """Names of the variables in a file that cannot be read, such as for a wrong check sum."""
    names = []
    for name, variable in file.variables.items():
        try:
            variable[...]
        except (OSError, RuntimeError, ValueError):
            names.append(name)
    return names


def _check_sum(variable: xr.Variable) -> str:
    values = variable.values.ravel().tolist()
    return f"{zlib.crc32(repr(values).encode()):08x}"
