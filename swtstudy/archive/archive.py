"""The archive of a study: its labelled values, the state and origin of each, full provenance; opening it."""

from __future__ import annotations

import json
from dataclasses import replace
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.netcdf import read_archive
from swtstudy.archive.parts import known_points, parts_folder, read_parts
from swtstudy.points.canonical import Distinct
from swtstudy.points.chunk import Found, matching
from swtstudy.points.labelled import label, margins, values_at
from swtstudy.solver.definitions import definitions_text
from swtstudy.study.definition import Study
from swtstudy.vocabulary.quantities import FAILED
from swtstudy.vocabulary.version import __version__, versions

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
