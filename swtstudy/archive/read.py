"""Reading archives."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr


class ArchiveError(ValueError):
    """A file that is not an archive of a study."""


def open_results(path: str | PathLike[str]) -> xr.Dataset:
    """The results in an archive, loaded into memory; the file is closed again.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    ArchiveError
        A ValueError, if the file is not an archive of swtstudy.
    """
    import xarray as xr

    if not Path(path).is_file():
        raise FileNotFoundError(f"{path}: no such archive")
    try:
        with xr.open_dataset(path, engine="netcdf4") as dataset:
            loaded = dataset.load()
    except (OSError, ValueError, RuntimeError, KeyError, AttributeError) as error:
        raise ArchiveError(f"{path}: not a readable netCDF archive ({error})") from None
    if "s" not in loaded or "study" not in loaded.attrs:
        raise ArchiveError(f"{path}: a netCDF file, but not an archive of swtstudy")
    for variable in loaded.variables.values():
        variable.encoding = {}  # kept encodings cut longer labels short when a file is written again
    return loaded
