"""The archive of a study: its labelled values, the state and origin of each, full provenance; its file.

HDF5 has check sums of the chunks of an array (fletcher32) and of attributes, but none of the index that says
where the chunks are: a flipped bit there turns values into NaN, or into another place's values. So there is
one of all variables here. It is stored in a separate group, which xarray does not copy: whoever changes an
archive and saves it with xarray leaves one without it, not one with an outdated one.
"""

from __future__ import annotations

import json
import math
import threading
import zlib
from collections.abc import Hashable
from dataclasses import replace
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from swtstudy.archive.parts import known_beside, parts_folder, read_parts
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.recall import check_archive, found_in, lacking
from swtstudy.points.chunk import Found, join, matching, versions
from swtstudy.points.grid import Distinct
from swtstudy.points.solve import label, margins, values_at
from swtstudy.study.definition import Study
from swtstudy.study.writing import definitions_text
from swtstudy.vocabulary.files import replacing
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.quantities import FAILED
from swtstudy.vocabulary.version import __version__

REFERENCE = "E. Willert, Eng 2024, 5, 333-346, doi:10.3390/eng5010018"


def build(study: Study, points: Distinct, found: Found, history: str, seconds: float) -> xr.Dataset:
    """The archive of a study.

    Parameters
    ----------
    study
        The study.
    points
        The distinct points of its grid.
    found
        Their values, in the same order; runs that made none of them are left out.
    history
        One line for each step, the latest first.
    seconds
        Wall time of the run that ends with this archive.
    """
    found = found.take(slice(None))
    names = ("status", "run", *("message",) * bool((found["status"] == FAILED).any()))
    arrays = values_at(study.grid, points, found.arrays, study.asked)
    arrays |= {name: found[name][points.index] for name in names}
    dataset = label(study.grid, arrays | margins(study.grid, points), study.asked)
    if (design := study.design) is not None:
        dataset.sample.attrs |= {"design": design.name, "size": design.size, "seed": design.seed}
    message = " message" * ("message" in dataset)
    dataset.s.attrs["ancillary_variables"] = f"s_error regime s_surface status run{message}"
    made = found["run"] >= 0
    of_runs = np.bincount(found["run"][made], found["seconds"][made], len(found.runs))
    each = zip(found.runs, of_runs.tolist(), strict=True)
    runs = [replace(run, seconds=round(own, 6)).to_json() for run, own in each]
    attributes: dict[str, Any] = {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"swtstudy {__version__}",
        "history": history,
        "references": REFERENCE,
        "versions": versions(),
        "rtol": study.rtol,
        "wall_time_seconds": round(seconds, 3),
        "computing_time_seconds": round(float(of_runs.sum()), 3),
        "study": study.text,
        "told": "\n".join(study.told) or None,
        "runs": json.dumps(runs),
        "definitions": definitions_text(study.grid.given) if study.grid.given else None,
        "figure": study.figure and study.figure.to_json(),
    }
    return dataset.assign_attrs({name: value for name, value in attributes.items() if value is not None})


def history_line(what: str) -> str:
    """A line for the history: the present time, and what was done."""
    now = datetime.now(UTC).isoformat(timespec="seconds")
    return f"{now}: {what} by swtstudy {__version__}"


def open_results(path: str | PathLike[str], partial: bool = False) -> xr.Dataset:
    """The results in an archive, loaded into memory; the file is closed again.

    While there is no archive yet, because its first run is going on or was killed, these are the results
    saved so far; the other points are NaN, with the status "missing".

    Parameters
    ----------
    path
        The archive.
    partial
        Whether to open the saved results of an unfinished run even if an earlier run left an archive.

    Returns
    -------
    xarray.Dataset
        The results over the dimensions of the study, with their provenance as attributes.

    Raises
    ------
    FileNotFoundError
        If there is no such file.
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
        parts = read_parts(parts_folder(path))
        if parts.runs:
            latest = max(parts.runs, key=lambda run: run.started)
            study = Study.from_text(latest.study, str(path))
            points, known = Distinct.of(study.grid, study.asked), known_points(path)
            found = matching(points, known, known.usable(study.rtol, latest.solver_version))
            return build(study, points, found, history_line("opened unfinished"), 0.0)
    if not path.exists():
        raise FileNotFoundError(f"{path}: no such archive")
    return read_archive(path)


_GROUP = "check_sum"
#: netCDF and HDF5 are not thread-safe: one thread at a time reads or writes a file.
_ONE_AT_A_TIME = threading.RLock()
#: More bytes of values for each byte of a file than deflate can make, and bytes that any file may hold.
_MOST_PACKED, _ANY = 1100, 2**24


def _check_sum(dataset: xr.Dataset) -> str:
    """Check sum over axes, types and bytes of all variables. All NaN count as one, other objects as words."""
    total = 0
    for name, variable in sorted(dataset.variables.items(), key=lambda item: str(item[0])):
        values, kind = variable.values, variable.dtype.kind
        said: tuple[Any, ...] = name, variable.dims, values.shape
        if kind == "f":
            values = np.where(np.isnan(values), np.asarray(np.nan, values.dtype), values)
        if kind in "biuf":
            said = *said, kind, values.itemsize
            little = np.ascontiguousarray(values, values.dtype.newbyteorder("<"))
            total = zlib.crc32(little.data, total)
        else:
            said = *said, values.ravel().tolist()
        total = zlib.crc32(repr(said).encode(), total)
    return f"{total:08x}"


#: Errors of xarray and netCDF4 for files that they cannot read.
_UNREADABLE = (OSError, ValueError, RuntimeError, KeyError, AttributeError, IndexError, TypeError)


def read_archive(path: Path) -> xr.Dataset:
    """The Dataset in an archive file, loaded and checked; raises as `swtstudy.open_results` does."""
    loaded = load_file(path)
    if absent := lacking(loaded):
        words = f"{path}: a netCDF file, but not an archive of swtstudy"
        if str(loaded.attrs.get("source", "")).startswith("swtstudy") or "s" in loaded:
            words = f"{path}: an archive changed by another program"
            if {"status", "study"} <= {*absent}:
                words = f"{path}: results without a study, as of solve; xarray.open_dataset opens them"
        raise ArchiveError(f"{words} (no {', '.join(absent)})")
    try:
        check_archive(loaded, str(path))
    except StudyError as error:
        raise ArchiveError(str(error)) from None
    return loaded


def known_points(path: Path) -> Found:
    """All that is in the archive at `path`, if there is one, in its parts, and kept beside it.

    Raises
    ------
    ArchiveError
        If the file is not an archive, and so must not be replaced.
    """
    beside = known_beside(path)
    if not path.exists():
        return beside
    try:
        return join([found_in(read_archive(path)), beside])
    except ArchiveError as error:
        raise ArchiveError(f"{error}; move it away to start anew") from None


def load_file(path: Path) -> xr.Dataset:
    """The Dataset in a file written by `save`, loaded; its check sum is verified.

    Raises
    ------
    ArchiveError
        If it cannot be read or is damaged.
    """
    if path.is_dir():
        raise ArchiveError(f"{path}: a folder; give an archive in it, {path}/NAME.nc")
    if path.exists() and not path.is_file():
        raise ArchiveError(f"{path}: not a regular file")
    try:
        content = path.read_bytes()
        # From memory: xarray and netCDF4 crash if a file is opened twice in one process.
        with _ONE_AT_A_TIME, netCDF4.Dataset(path.name, memory=content) as file:
            _refuse_more_than_fits(file, len(content))
            loaded = xr.open_dataset(xr.backends.NetCDF4DataStore(file)).load()
            sound = _GROUP not in file.groups or file.groups[_GROUP].crc32 == _check_sum(loaded)
    except _UNREADABLE as error:
        if path.suffix == ".toml":
            raise ArchiveError(f"{path}: a study, not an archive; swtstudy run {path} makes one") from None
        raise ArchiveError(f"{path}: not a readable netCDF archive ({error})") from None
    if not sound:
        raise ArchiveError(f"{path}: a damaged file: wrong check sum")
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
    """Write a Dataset as compressed netCDF-4 with a check sum, atomically.

    Parameters
    ----------
    dataset
        The results to write.
    path
        Path of the file, which is replaced if it exists.
    beside
        Folder for the unfinished file, as for `swtstudy.vocabulary.files.replacing`.
    """
    encoding: dict[Hashable, dict[str, Any]] = {}
    for name, variable in dataset.variables.items():
        # CF forbids the fill value that xarray would give to coordinates.
        own = encoding[name] = {"_FillValue": None} if name in dataset.coords else {}
        if variable.ndim and variable.dtype.kind in "biuf":  # texts take no filter
            own["fletcher32"] = True
            own |= {"zlib": True, "complevel": 4, "shuffle": True} if name in dataset.data_vars else {}
    with (
        _ONE_AT_A_TIME,
        replacing(path, beside) as temporary,
        netCDF4.Dataset(temporary, "w", format="NETCDF4") as file,
    ):
        # Not by to_netcdf: that imports all of distributed where it is installed.
        dataset.dump_to_store(xr.backends.NetCDF4DataStore(file), encoding=encoding)
        file.createGroup(_GROUP).setncattr("crc32", _check_sum(dataset))
