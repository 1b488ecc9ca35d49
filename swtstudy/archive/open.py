"""The results at the path of an archive."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import xarray as xr

from swtstudy.archive.archive import build, history_line
from swtstudy.archive.known import known_records
from swtstudy.archive.parts import parts_folder, read_parts
from swtstudy.archive.read import read_archive
from swtstudy.points.records import matching
from swtstudy.points.unique import unique_points
from swtstudy.study.definition import Study


def open_results(path: str | PathLike[str], partial: bool = False) -> xr.Dataset:
    """The results in an archive, loaded into memory; the file is closed again.

    While there is no archive yet, because its first run is going on or was killed, these are the results
    saved so far; the other points are NaN, with the status "missing".

    Parameters
    ----------
    path
        The archive.
    partial
        Whether to open what an unfinished run has saved even if there is an archive of an earlier run.

    Returns
    -------
    xarray.Dataset
        The results over the dimensions of the study, with their provenance as attributes.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
    LockedError
        An OSError, if another program has it open for writing.
    ArchiveError
        A ValueError, if the file is not a sound archive of swtstudy; the message names the file and
        everything that is wrong in it.

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


def partial_results(path: Path) -> xr.Dataset | None:
    """Open what the latest run for the archive at `path` has saved so far; None if there are no parts."""
    parts = read_parts(parts_folder(path))
    if not parts.runs:
        return None
    latest = max(parts.runs, key=lambda run: run.started)
    study = Study.from_text(latest.study, str(path))
    points = unique_points(study.grid)
    known = known_records(path)
    usable = known.usable(study.rtol, latest.solver_version, retry_failed=False)
    records = matching(points.table, known, usable)
    return build(study, points, records, history_line("opened unfinished"), 0.0)
