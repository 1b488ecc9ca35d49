"""Collecting results: each is saved in a part of the archive before it counts."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from swtstudy.mechanics.points import IntArray
from swtstudy.points.cost import weights
from swtstudy.points.records import MISSING, Records, Run
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

    def add(self, rows: IntArray, found: Records) -> None:
        """Save what was found of the points in some rows, and fill it in.

        Raises
        ------
        WorkerError
            If it comes from another version of the solver.
        OSError
            If it cannot be saved.
        """
        (own,) = found.runs
        if own.solver_version != SOLVER_VERSION:
            words = f"a worker has version {own.solver_version} of the solver"
            raise WorkerError(f"{words}, this machine {SOLVER_VERSION}")
        there = self.records.take(rows)
        if (there.status == MISSING).all():
            run = replace(self._run, seconds=own.seconds, quantities=own.quantities)
            part = replace(found, runs=(run,))
        else:
            part = there.trimmed().extended(found)
        self._writer.add(part)
        self.records = self.records.fill(rows, part)
        self.pace.update(own.seconds, int(self._weights[rows].sum()))
        self._bar.add(len(rows))
