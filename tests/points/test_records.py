"""Records of points: taken, joined and filled in by rows, and kept in parts as plain columns."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np

from swtstudy.archive.parts import PartsWriter, read_parts
from swtstudy.mechanics.points import Solution
from swtstudy.points.canonical import ROW
from swtstudy.points.records import COMPUTED, FAILED, Records, Run, join, look_up


def some(count: int, status: int = COMPUTED, message: str = "", **quantities: float) -> Records:
    """Records of points that differ in their phase, and all say the same."""
    table = np.zeros(count, ROW)
    table["phase"] = np.arange(count)
    run = Run("1", 1e-3, "", "", seconds=1.0)
    found = replace(Records.of(table, Solution.blank(count), status, message), runs=(run,))
    values = {name: np.full(count, value) for name, value in quantities.items()}
    return replace(found, run=np.zeros(count, np.int32), quantities=values)


def test_records_are_joined_with_the_quantities_of_all() -> None:
    whole = join([some(2, FAILED, "why"), some(3, stick_radius=0.5)])
    assert whole.message.tolist() == ["why"] * 2 + [""] * 3
    assert whole.table["phase"].tolist() == [0, 1, 0, 1, 2]
    np.testing.assert_array_equal(whole.quantities["stick_radius"], [np.nan, np.nan, 0.5, 0.5, 0.5])
    assert whole.seconds == 2.0
    assert len(whole.runs) == 1
    part = whole.take(np.array([4, 1]))
    assert part.message.tolist() == ["", "why"]
    assert part.status.tolist() == [COMPUTED, FAILED]
    np.testing.assert_array_equal(part.quantities["stick_radius"], [0.5, np.nan])


def test_missing_points_are_of_no_run() -> None:
    known = some(2)
    assert join([Records.missing(known.table), known]).run.tolist() == [-1, -1, 0, 0]
    for candidates, found in (([True, False], [0, -1]), ([False, False], [-1, -1])):
        assert look_up(known.table, known, np.array(candidates)).tolist() == found


def test_of_equal_points_that_with_most_quantities_is_found_then_the_latest() -> None:
    none, one = some(1), some(1, stick_radius=0.5)
    (run,) = one.runs
    one = replace(one, runs=(replace(run, quantities=("stick_radius",)),))
    for parts, found in (((none, one, none), 1), ((one, none, one), 2)):
        known = join(parts)
        assert look_up(none.table, known, np.ones(3, bool)).tolist() == [found]


def test_a_run_in_two_parts_began_with_the_first_of_them() -> None:
    part = some(1)
    (run,) = part.runs
    parts = [replace(part, runs=(replace(run, started=day),)) for day in ("2025-03-02", "2025-03-01", "")]
    assert [run.started for run in join(parts).runs] == ["2025-03-01"]


def test_parts_hold_the_points_by_named_columns(tmp_path: Path) -> None:
    records = some(3, FAILED, "why", stick_radius=0.25)
    PartsWriter(tmp_path).add(records)
    (file,) = tmp_path.glob("*.npz")
    with np.load(io.BytesIO(file.read_bytes())) as part:
        assert part["table"].dtype == ROW
        assert part["table"]["phase"].tolist() == [0, 1, 2]
    read = read_parts(tmp_path)
    assert (read.table == records.table).all()
    assert read.message.tolist() == ["why"] * 3
    assert read.quantities.keys() == {"stick_radius"}
