"""Check sums of what an archive's variables hold as they are read.

HDF5 has check sums of the chunks of an array (fletcher32) and of attributes, but none of the index that says
where the chunks are: a flipped bit there turns values into NaN, or into those of another place. So the values
of every variable have one here. They are stored in a separate group, which xarray does not copy: whoever
changes an archive and saves it with xarray leaves one without these check sums, not one with outdated ones.
"""

from __future__ import annotations

import zlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import netCDF4
    import xarray as xr

_GROUP = "check_sums"


def has_its_own(variable: xr.Variable | xr.DataArray) -> bool:
    """Return whether HDF5 can keep check sums of the chunks of the values."""
    return bool(variable.ndim) and variable.dtype.kind in "biuf"


def write_check_sums(path: Path, dataset: xr.Dataset) -> None:
    """Add check sums to the file of a Dataset."""
    import netCDF4

    with netCDF4.Dataset(path, "a") as file:
        file.createGroup(_GROUP).setncatts(
            {str(name): _check_sum(each) for name, each in dataset.variables.items()}
        )


def damaged(file: netCDF4.Dataset, dataset: xr.Dataset) -> list[str]:
    """Names of the variables read from a file that do not match their check sums in it, if there are any.

    Archives from before arrays had check sums here have only those of single values and texts.
    """
    group = file.groups.get(_GROUP)
    written = {} if group is None else {name: group.getncattr(name) for name in group.ncattrs()}
    read = dataset.variables
    return [name for name in written if name not in read or _check_sum(read[name]) != written[name]]


def unreadable(file: netCDF4.Dataset) -> list[str]:
    """Names of the variables in a file that cannot be read, for example because of a wrong check sum."""
    names = []
    for name, variable in file.variables.items():
        try:
            variable[...]
        except (OSError, RuntimeError, ValueError):
            names.append(name)
    return names


def _check_sum(variable: xr.Variable) -> str:
    """Of an array of numbers the axes, the type and the bytes, NaN being one; else the values in words."""
    values = variable.values
    if not has_its_own(variable):
        return f"{zlib.crc32(repr(values.ravel().tolist()).encode()):08x}"
    begin = zlib.crc32(repr((variable.dims, values.shape, values.dtype.kind, values.itemsize)).encode())
    if values.dtype.kind == "f":
        values = np.where(np.isnan(values), np.asarray(np.nan, values.dtype), values)
    little = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
    return f"{zlib.crc32(little.data, begin):08x}"
