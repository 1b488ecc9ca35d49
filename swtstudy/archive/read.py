"""Reading archives."""

from __future__ import annotations

from pathlib import Path

import netCDF4
import xarray as xr

from swtstudy.archive.check import lacking, mistakes
from swtstudy.archive.check_sums import damaged, unreadable
from swtstudy.archive.error import ArchiveError
from swtstudy.archive.lock import LockedError, is_locked
from swtstudy.archive.recall import grid_of
from swtstudy.points.labelled import control_coordinate
from swtstudy.units.life import UNCOUNTED
from swtstudy.units.results import is_uncounted

#: What xarray and netCDF4 raise for files that they cannot read.
_UNREADABLE = (OSError, ValueError, RuntimeError, KeyError, AttributeError, IndexError, TypeError)


def read_archive(path: Path) -> xr.Dataset:
    """The Dataset in an archive file, loaded and checked; raises as `swtstudy.open_results` does."""
    loaded = load_file(path)
    absent = lacking(loaded)
    if absent:
        raise ArchiveError(f"{path}: a netCDF file, but not an archive of swtstudy (no {', '.join(absent)})")
    found = mistakes(loaded, str(path))
    if found:
        raise ArchiveError("\n".join(map(str, found)))
    # Archives from before forces could be prescribed do not say what is.
    if "control" not in loaded.coords:
        loaded = loaded.assign_coords(control=control_coordinate(grid_of(loaded)))
    # Nor do those from before strain cycles were counted that theirs are not.
    for name, variable in loaded.data_vars.items():
        if is_uncounted(loaded, str(name)):
            variable.attrs.setdefault("comment", UNCOUNTED)
    return loaded


def load_file(path: Path) -> xr.Dataset:
    """The Dataset in a file written by `swtstudy.archive.write.save`, loaded; its check sums are verified.

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
        # From memory: xarray and netCDF4 crash if a file is opened twice in one process.
        with netCDF4.Dataset(path.name, memory=path.read_bytes()) as file:
            try:
                loaded = xr.open_dataset(xr.backends.NetCDF4DataStore(file)).load()
                wrong = damaged(file, loaded)
            except _UNREADABLE:
                wrong = unreadable(file)
                if not wrong:
                    raise
    except _UNREADABLE as error:
        raise ArchiveError(f"{path}: not a readable netCDF archive ({error})") from None
    if wrong:
        raise ArchiveError(f"{path}: a damaged file: wrong check sum of {', '.join(wrong)}")
    for variable in loaded.variables.values():
        variable.encoding = {}  # a kept encoding would truncate longer labels when a file is written again
    return loaded
