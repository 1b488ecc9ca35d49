"""Collecting results: they are saved in parts of the archive, and counted."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.points.records import MISSING, Records, Run, join
from swtstudy.runner.engine import WorkerError
from swtstudy.vocabulary.arrays import IntArray
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    from swtstudy.archive.parts import PartsWriter

#: Seconds after which results are saved, and the share of a long run that this may be instead: so much is
#: lost with the process, and a run of any length leaves some hundred files.
PART_SECONDS, PART_SHARE = 0.5, 0.01


class Collector:
    """Fills the results of a run into its records, inside a with block, once they are saved as parts.

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

    def __init__(self, records: Records, run: Run, writer: PartsWriter, todo: int, name: str) -> None:
        self.records = records
        self._run = run
        self._writer = writer
        self._progress = Progress(todo, name, delay=0.0)
        self._unsaved: list[tuple[IntArray, Records]] = []
        self._begin = time.monotonic()
        self._lock = threading.Lock()
        self._timer: threading.Timer | None = None
        self._error: Exception | None = None

    def __enter__(self) -> Collector:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._progress.close()
        if self._timer is not None:
            self._timer.cancel()
        if self._error is None:
            self._save()
        if self._error is not None and kind is None:
            raise self._error

    def add(self, rows: IntArray, found: Records) -> None:
        """Take what was found of the points in some rows; it is saved with others, half a second later.

        Raises
        ------
        WorkerError
            If it comes from another version of the solver.
        OSError
            If results could not be saved.
        """
        if self._error is not None:
            raise self._error
        (own,) = found.runs
        if own.solver_version != SOLVER_VERSION:
            words = f"a worker has version {own.solver_version} of the solver"
            raise WorkerError(f"{words}, this machine {SOLVER_VERSION}")
        with self._lock:
            there = self.records[rows]
            if (there.status == MISSING).all():
                run = replace(self._run, seconds=own.seconds, quantities=own.quantities)
                part = replace(found, runs=(run,))
            else:
                part = there.trimmed().extended(found)
            self._unsaved.append((rows, part))
            if self._timer is None:
                passed = time.monotonic() - self._begin
                self._timer = threading.Timer(max(PART_SECONDS, PART_SHARE * passed), self._save)
                self._timer.daemon = True
                self._timer.start()
        self._progress.add(len(rows))

    def _save(self) -> None:
        """Save as a part what has been found since the last one; only then it counts."""
        with self._lock:
            self._timer = None
            if not self._unsaved:
                return
            rows, parts = zip(*self._unsaved, strict=True)
            part = join(parts)
            try:
                self._writer.add(part)
            except Exception as error:
                self._error = error
                return
            self.records = self.records.fill(np.concatenate(rows), part)
            self._unsaved = []
