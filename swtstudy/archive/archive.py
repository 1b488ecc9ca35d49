"""The archive of a study: its labelled values, the state and origin of each, and full provenance."""

from __future__ import annotations

import json
from datetime import UTC, datetime
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.archive.attributes import definitions_text
from swtstudy.archive.versions import versions
from swtstudy.points.canonical import describe_point
from swtstudy.points.codes import Definitions
from swtstudy.points.columns import columns_at
from swtstudy.points.labelled import arrays_of, label
from swtstudy.points.margins import margins
from swtstudy.points.records import FAILED, Records
from swtstudy.points.unique import UniquePoints
from swtstudy.study.definition import Study
from swtstudy.vocabulary.version import __version__

REFERENCE = "E. Willert, Eng 2024, 5, 333-346, doi:10.3390/eng5010018"


def build(study: Study, points: UniquePoints, records: Records, history: str, seconds: float) -> xr.Dataset:
    """The archive of a study.

    Parameters
    ----------
    study
        The study.
    points
        The distinct points of its grid.
    records
        Their records, in the same order.
    history
        One line for each step, the latest first.
    seconds
        Wall time of the run that ends with this archive.
    """
    arrays = arrays_of(records.solution.take(points.index), points.mirrored)
    arrays |= margins(points, study.grid)
    arrays |= {"status": records.status[points.index], "run": records.run[points.index]}
    columns = columns_at(study.grid, study.asked, points, records.quantity)
    dataset = label(study.grid, arrays, study.asked, columns)
    if study.sample is not None and study.sample.design is not None:
        dataset.sample.attrs |= study.sample.design.attributes()
    dataset.s.attrs["ancillary_variables"] = "s_error regime s_surface status run"
    dataset.status.attrs["failures"] = json.dumps(failures(records, points.definitions))
    return dataset.assign_attrs(_provenance(study, records, history, seconds))


def failures(records: Records, definitions: Definitions) -> list[dict[str, Any]]:
    """The failed points: canonical row, description and message of each."""
    return [
        {
            "row": records.table[index].tolist(),
            "point": describe_point(records.table[index], definitions),
            "message": records.message[index],
        }
        for index in np.flatnonzero(records.status == FAILED)
    ]


def history_line(what: str) -> str:
    """A line for the history: the present time, and what was done."""
    now = datetime.now(UTC).isoformat(timespec="seconds")
    return f"{now}: {what} by swtstudy {__version__}"


def _provenance(study: Study, records: Records, history: str, seconds: float) -> dict[str, Any]:
    attributes: dict[str, Any] = {
        "Conventions": "CF-1.11",
        "title": study.title,
        "source": f"swtstudy {__version__}",
        "history": history,
        "references": REFERENCE,
        "versions": versions(),
        "rtol": study.rtol,
        "wall_time_seconds": round(seconds, 3),
        "computing_time_seconds": round(records.seconds, 3),
        "study": study.text,
        "runs": json.dumps([run.to_json() for run in records.runs]),
    }
    if study.grid.given:
        attributes["definitions"] = definitions_text(study.grid.given)
    if study.figure is not None:
        attributes["figure"] = study.figure.to_json()
    return attributes
