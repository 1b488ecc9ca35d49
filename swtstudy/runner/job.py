"""One study on its way to its archive: what is known, what is computed and saved, and the file."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.archive import parts
from swtstudy.archive.attributes import versions
from swtstudy.archive.paths import check_archive_path, locked
from swtstudy.points.chunk import Arrays, Solver, chunks, put, stacked
from swtstudy.points.found import Found, Run
from swtstudy.runner.work import Work, assess
from swtstudy.runner.workers import WorkerError, Workers
from swtstudy.study.definition import Study, require_study
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    import xarray as xr

_log = logging.getLogger(__name__)

#: Receives the study, the path and the content of an archive as soon as it is written.
Finished = Callable[[Study, Path, "xr.Dataset"], None]

#: Seconds after which results are saved, and the share of a long run that this may be instead: so much is
#: lost with the process, and a run of any length leaves some hundred files.
PART_SECONDS, PART_SHARE = 0.5, 0.01


class Stopped(KeyboardInterrupt):
    """A run that was stopped by Ctrl-C; the message says what is saved and how to go on."""


class Job:
    """A study to be computed, and the lock of its archive until it is closed.

    Parameters
    ----------
    study
        The study.
    path
        Path of its archive.
    retry_failed
        Whether to recompute points that failed before.
    """

    def __init__(self, study: Study, path: Path, retry_failed: bool) -> None:
        require_study(study)
        check_archive_path(path)
        check_writable(path)
        self.study, self.path, self._folder = study, path, parts.parts_folder(path)
        with ExitStack() as held:
            held.enter_context(locked(self._folder))
            parts.clear_unfinished(self._folder)
            self._begin = self._saved = time.perf_counter()
            self.work = assess(study, path, retry_failed)
            self._what, self._complete = _told(self.work), not self.work.todo.any()
            self._unsaved: list[tuple[IndexArray, Arrays]] = []
            self._reported: OSError | None = None
            self.close = held.pop_all().close

    def compute(self, workers: Workers, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        work, rtol = self.work, self.study.rtol
        started = datetime.now(UTC).isoformat(timespec="seconds")
        run = Run(SOLVER_VERSION, rtol, self.study.text, versions(), started, work.asked.items)
        work.found.runs = tuple(dict.fromkeys((*work.found.runs, run)))
        number, todo = work.found.runs.index(run), int(work.todo.sum())
        missing = chunks(work.points, work.todo, work.asked)
        with self.reporting(), Progress(todo, self.path.stem, delay=0.0) as shown:
            try:
                for places, arrays in workers.solve(missing, rtol, solver):
                    arrays["run"][:] = number
                    self._unsaved.append((places, arrays))
                    now = time.perf_counter()
                    if now - self._saved >= max(PART_SECONDS, PART_SHARE * (now - self._begin)):
                        self._save()
                    shown.add(len(places))
            finally:
                self._save()

    def _save(self) -> None:
        """Save the results of chunks as a part; only then they count."""
        if self._unsaved:
            several, of_chunks = zip(*self._unsaved, strict=True)
            places, arrays = np.concatenate(several), stacked(of_chunks)
            part = Found(arrays | {"row": self.work.points.rows[places]}, self.work.found.runs)
            parts.save_part(self._folder, part.take(slice(None)))
            put(self.work.found.arrays, places, arrays)
            self._unsaved, self._saved = [], time.perf_counter()

    def finish(self, finished: Finished) -> None:
        """Write the archive, which replaces the parts, and release it; what is not in it is kept.

        An archive that exactly this study wrote stays as it is, if nothing had to be done.
        """
        from swtstudy.archive.netcdf import read_archive

        with self.reporting():
            archive = read_archive(self.path) if self.path.exists() else None
            same = archive is not None and archive.attrs["study"] == self.study.text
            if archive is None or not (same and self._complete) or len(parts.read_parts(self._folder)):
                archive = self._written(archive)
            parts.clear_parts(self._folder)
        self.close()
        finished(self.study, self.path, archive)

    def _written(self, before: xr.Dataset | None) -> xr.Dataset:
        """Write the archive in the place of one from before."""
        from swtstudy.archive.archive import build, history_line
        from swtstudy.archive.netcdf import read_archive, save

        work, kept = self.work, parts.kept_folder(self.path)
        lines = [history_line(self._what)] + ([] if before is None else [before.attrs["history"]])
        seconds = time.perf_counter() - self._begin
        dataset = build(self.study, work.points, work.found.take(slice(None)), "\n".join(lines), seconds)
        try:
            with parts.keeping(kept, work.others):
                save(dataset, self.path, beside=self._folder)
        except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
            raise OSError(f"cannot write the archive ({error})") from error
        if len(work.others):
            _log.info("%d points are not in this study: %s keeps them", len(work.others), kept)
        return read_archive(self.path)

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """However the block is stopped, its error says what is saved and how to go on."""
        count = len(self.work.found)
        try:
            yield
        except (KeyboardInterrupt, OSError) as error:
            if error is self._reported:
                raise
            saved = f"{count - self.work.todo.sum()} of {count} distinct points are saved beside {self.path}"
            if isinstance(error, KeyboardInterrupt):
                raise Stopped(f"stopped; {saved}; the same command continues from there") from None
            kind = WorkerError if isinstance(error, WorkerError) else OSError
            advice = "once that is fixed, the same command continues from there"
            self._reported = kind(f"{error.strerror or error}; {saved}; {advice}")
            raise self._reported from error


def _told(work: Work) -> str:
    """Say in the log what is known; what the run does, for the history."""
    count, todo, more = len(work.found), int(work.todo.sum()), int(work.incomplete.sum())
    for number, level, words in (
        (work.outdated, logging.WARNING, "come from another version of the solver and are recomputed"),
        (work.coarse, logging.INFO, "are less accurate than the study asks for and are recomputed"),
        (more, logging.INFO, "are computed, but lack quantities that the study asks"),
    ):
        if number:
            _log.log(level, "%d points %s", number, words)
    if 0 < todo < count:
        _log.info("%d of %d distinct points are already computed", count - todo, count)
    words = f", {more} of them for quantities that they lacked" if more else ""
    return f"{todo} of {count} distinct points computed{words}"
