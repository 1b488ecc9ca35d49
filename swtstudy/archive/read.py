"""Reading archives."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import xarray as xr

#: What xarray and netCDF4 raise for files that are not what they expect.
_UNREADABLE = (OSError, ValueError, RuntimeError, KeyError, AttributeError, IndexError, TypeError)


class ArchiveError(ValueError):
    """A file that is not an archive of a study, or a damaged one."""


def open_results(path: str | PathLike[str], partial: bool = False) -> xr.Dataset:
    """The results in an archive, loaded into memory; the file is closed again.

    As long as there is no archive, because its first run goes on or was killed, these are the results that
    have been saved so far: NaN, with the status "missing", for the others.

    Parameters
    ----------
    path
        The archive.
    partial
        Whether to show what an unfinished run has saved even if there is an archive of an earlier one.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    LockedError
        An OSError, if another program has it open for writing.
    ArchiveError
        A ValueError, if the file is not a sound archive of swtstudy: it names the file, and what in it
        cannot be as it is.

    Examples
    --------
    >>> import tempfile, swtstudy
    >>> study = swtstudy.Study.from_text('''
    ... title = "Two amplitudes"
    ... rtol = 1e-2
    ... axes.tangential_amplitude = [0.5, "5/6"]
    ... ''')
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     computed = swtstudy.run(study, f"{folder}/mine.nc")
    ...     found = swtstudy.open_results(f"{folder}/mine.nc")
    >>> found.swt.slice(tangential_amplitude="5/6").s.round(2).item()
    0.16
    """
    path = Path(path)
    if partial or not path.exists():
        from swtstudy.archive.partial import partial_results

        dataset = partial_results(path)
        if dataset is not None:
            return dataset
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such archive")
    return read_archive(path)


def read_archive(path: Path) -> xr.Dataset:
    """The Dataset in an archive file, loaded and found sound; raises as `open_results` does."""
    from swtstudy.archive.check import lacking, mistakes

    loaded = load_file(path)
    absent = lacking(loaded)
    if absent:
        raise ArchiveError(f"{path}: a netCDF file, but not an archive of swtstudy (no {', '.join(absent)})")
    found = mistakes(loaded, str(path))
    if found:
        raise ArchiveError("\n".join(map(str, found)))
    return loaded


def load_file(path: Path) -> xr.Dataset:
    """The Dataset in a file that `swtstudy.archive.files.save` wrote, loaded, if its check sums agree.

    Raises
    ------
    LockedError
        An OSError, if another program has it open for writing.
    ArchiveError
        If it cannot be read or is damaged.
    """
    import netCDF4
    import xarray as xr

    from swtstudy.archive.check_sums import damaged, unreadable
    from swtstudy.archive.lock import LockedError, is_locked

    if is_locked(path):
        raise LockedError(f"{path} is locked: another program has it open for writing")
    try:
        # From memory: xarray and netCDF4 crash where a file is opened again that is open in this process.
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
        raise ArchiveError(f"{path}: a damaged file: {', '.join(wrong)} not as written (check sum)")
    for variable in loaded.variables.values():
        variable.encoding = {}  # kept encodings cut longer labels short when a file is written again
    return loaded
