"""Writing archives."""

from __future__ import annotations

from collections.abc import Hashable
from os import PathLike
from pathlib import Path
from typing import Any

import netCDF4
import xarray as xr

from swtstudy.archive.check_sums import has_its_own, write_check_sums
from swtstudy.vocabulary.files import replacing


def save(dataset: xr.Dataset, path: str | PathLike[str], beside: Path | None = None) -> None:
    """Write a Dataset as compressed netCDF-4 with check sums, atomically.

    Parameters
    ----------
    dataset
        What to write.
    path
        Path of the file, which is replaced if it exists.
    beside
        Folder for the unfinished file, as for `swtstudy.vocabulary.files.replacing`.
    """
    encoding: dict[Hashable, dict[str, Any]] = {
        name: {"fletcher32": True} if has_its_own(each) else {} for name, each in dataset.variables.items()
    }
    for name in dataset.coords:
        encoding[name]["_FillValue"] = None  # CF forbids the one that xarray would give to coordinates
    for name, variable in dataset.data_vars.items():
        if variable.ndim:
            encoding[name] |= {"zlib": True, "complevel": 4, "shuffle": True}
    with replacing(path, beside) as temporary:
        # Not by to_netcdf: that imports all of distributed where it is installed.
        with netCDF4.Dataset(temporary, "w", format="NETCDF4") as file:
            dataset.dump_to_store(xr.backends.NetCDF4DataStore(file), encoding=encoding)
        write_check_sums(temporary, dataset)
