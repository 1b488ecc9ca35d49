"""Collecting results: each is saved in a part of the archive before it counts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from swtstudy.points.cost import weights
from swtstudy.points.records import MISSING, Records, Run
from swtstudy.points.result import Result
from swtstudy.runner.engine import WorkerError
from swtstudy.runner.pace import Pace
from swtstudy.runner.progress import ProgressBar
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    from swtstudy.archive.parts import PartsWriter


class Collector:
    """Fills the results of a run into its records; shows progress inside a with block.

    Parameters
    ----------
    records
        Records of all points of the run; filled in place.
    run
        Origin of the results.
    writer
        Saves them as parts.
    todo
        Number of points to be computed.
    name
        Name of the study.
    """

    def __init__(self, records: Records, run: Run, writer: PartsWriter, todo: int, name: str = "") -> None:
        self.records = records
        self.pace = Pace()
        self._run = run
        self._writer = writer
        self._weights = weights(records.table)
        self._bar = ProgressBar(todo, name=name)

    def __enter__(self) -> Collector:
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.close()

    def add(self, result: Result) -> None:
        """Save a result and fill it in.

        Raises
        ------
        WorkerError
            If it comes from another version of the solver.
        OSError
            If it cannot be saved.
        """
        if result.solver_version != SOLVER_VERSION:
            found = f"a worker has version {result.solver_version} of the solver"
            raise WorkerError(f"{found}, this machine {SOLVER_VERSION}")
        there = self.records.take(result.rows)
        if (there.status == MISSING).all():
            part = Records.of(result, there.table, self._run)
        else:
            part = there.trimmed().extended(result)
        self._writer.add(part)
        self.records = self.records.fill(result.rows, part)
        self.pace.update(result, int(self._weights[result.rows].sum()))
        self._bar.add(len(result))
