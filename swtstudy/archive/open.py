"""The results at the place of an archive."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import xarray as xr

from swtstudy.archive.partial import partial_results
from swtstudy.archive.read import read_archive


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
        dataset = partial_results(path)
        if dataset is not None:
            return dataset
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such archive")
    return read_archive(path)
