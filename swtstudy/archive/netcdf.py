"""Reading and writing archives, with check sums of what their variables hold as they are read.

HDF5 has check sums of the chunks of an array (fletcher32) and of attributes, but none of the index that says
where the chunks are: a flipped bit there turns values into NaN, or into those of another place. So the values
of every variable have one here. They are stored in a separate group, which xarray does not copy: whoever
changes an archive and saves it with xarray leaves one without these check sums, not one with outdated ones.
"""

from __future__ import annotations

import math
import threading
import zlib
from collections.abc import Hashable
from os import PathLike
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from swtstudy.archive.check import lacking, mistakes
from swtstudy.archive.paths import ArchiveError, LockedError, is_locked
from swtstudy.vocabulary.files import replacing

_GROUP = "check_sums"
#: netCDF and HDF5 are not thread-safe: one thread at a time reads or writes a file.
_ONE_AT_A_TIME = threading.RLock()
#: More bytes of values for each byte of a file than deflate can make, and bytes that any file may hold.
_MOST_PACKED, _ANY = 1100, 2**24


def has_its_own(variable: xr.Variable | xr.DataArray) -> bool:
    """Return whether HDF5 can keep check sums of the chunks of the values."""
    return bool(variable.ndim) and variable.dtype.kind in "biuf"


def write_check_sums(path: Path, dataset: xr.Dataset) -> None:
    """Add check sums to the file of a Dataset."""
    with netCDF4.Dataset(path, "a") as file:
        file.createGroup(_GROUP).setncatts(
            {str(name): _check_sum(each) for name, each in dataset.variables.items()}
        )


def damaged(file: netCDF4.Dataset, dataset: xr.Dataset) -> list[str]:
    """Names of the variables read from a file that do not match their check sums in it, if there are any."""
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


#: What xarray and netCDF4 raise for files that they cannot read.
_UNREADABLE = (OSError, ValueError, RuntimeError, KeyError, AttributeError, IndexError, TypeError)


def read_archive(path: Path) -> xr.Dataset:
    """The Dataset in an archive file, loaded and checked; raises as `swtstudy.open_results` does."""
    loaded = load_file(path)
    absent = lacking(loaded)
    if absent:
        words = f"{path}: a netCDF file, but not an archive of swtstudy"
        if str(loaded.attrs.get("source", "")).startswith("swtstudy") or "s" in loaded:
            words = f"{path}: an archive changed by another program"
        raise ArchiveError(f"{words} (no {', '.join(absent)})")
    found = mistakes(loaded, str(path))
    if found:
        raise ArchiveError("\n".join(map(str, found)))
    return loaded


def load_file(path: Path) -> xr.Dataset:
    """The Dataset in a file written by `save`, loaded; its check sums are verified.

    Raises
    ------
    LockedError
        An OSError, if another program has it open for writing.
    ArchiveError
        If it cannot be read or is damaged.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        raise ArchiveError(f"{path}: not a regular file")
    if is_locked(path):
        raise LockedError(f"{path} is locked: another program has it open for writing")
    try:
        content = path.read_bytes()
        # From memory: xarray and netCDF4 crash if a file is opened twice in one process.
        with _ONE_AT_A_TIME, netCDF4.Dataset(path.name, memory=content) as file:
            _refuse_more_than_fits(file, len(content))
            try:
                loaded = xr.open_dataset(xr.backends.NetCDF4DataStore(file)).load()
                wrong = damaged(file, loaded)
            except _UNREADABLE:
                wrong = unreadable(file)
                if not wrong:
                    raise
    except _UNREADABLE as error:
        if path.suffix == ".toml":
            raise ArchiveError(f"{path}: a study, not an archive; swtstudy run {path} makes one") from None
        raise ArchiveError(f"{path}: not a readable netCDF archive ({error})") from None
    if wrong:
        raise ArchiveError(f"{path}: a damaged file: wrong check sum of {', '.join(wrong)}")
    loaded.set_close(None)  # the file is closed; what would close it again cannot be pickled
    for variable in loaded.variables.values():
        variable.encoding = {}  # a kept encoding would truncate longer labels when a file is written again
    return loaded


def _refuse_more_than_fits(file: netCDF4.Dataset, size: int) -> None:
    """Refuse a file that claims to hold more than so many bytes can: reading it would fill the memory."""
    claimed = sum(
        math.prod(each.shape) * (each.dtype.itemsize if isinstance(each.dtype, np.dtype) else 8)
        for each in file.variables.values()
    )
    if claimed > max(_ANY, _MOST_PACKED * size):
        raise ValueError(f"it claims to hold {claimed:.2g} bytes of values in {size} bytes")


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
    with _ONE_AT_A_TIME, replacing(path, beside) as temporary:
        # Not by to_netcdf: that imports all of distributed where it is installed.
        with netCDF4.Dataset(temporary, "w", format="NETCDF4") as file:
            dataset.dump_to_store(xr.backends.NetCDF4DataStore(file), encoding=encoding)
        write_check_sums(temporary, dataset)
