"""Check sums of single values and names, for which HDF5 has none.

HDF5 has them for arrays of numbers (fletcher32) and for attributes. The others are stored in a separate
group, which xarray does not copy: whoever changes an archive and saves it with xarray leaves one without
these check sums, not one with outdated ones.
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
    """Add check sums to the file of a Dataset."""
    import netCDF4

    with netCDF4.Dataset(path, "a") as file:
        file.createGroup(_GROUP).setncatts(
            {str(name): _check_sum(each) for name, each in dataset.variables.items() if not has_its_own(each)}
        )


def damaged(file: netCDF4.Dataset, dataset: xr.Dataset) -> list[str]:
    """Names of the variables read from a file that do not match their check sums in it, if there are any."""
    group = file.groups.get(_GROUP)
    written = {} if group is None else {name: group.getncattr(name) for name in group.ncattrs()}
    return [
        str(name)
        for name, each in dataset.variables.items()
        if name in written and not has_its_own(each) and written[str(name)] != _check_sum(each)
    ]


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
    values = variable.values.ravel().tolist()
    return f"{zlib.crc32(repr(values).encode()):08x}"
