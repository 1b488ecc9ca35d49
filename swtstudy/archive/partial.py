"""The results of an unfinished run."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from swtstudy.archive.archive import build, history_line
from swtstudy.archive.known import known_records
from swtstudy.archive.parts import parts_folder, read_parts
from swtstudy.points.records import matching
from swtstudy.points.unique import unique_points
from swtstudy.study.definition import Study


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
