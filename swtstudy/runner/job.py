"""One run of a study: its known, computed and saved points, and its archive."""

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
from swtstudy.runner.engine import WorkerError, solve
from swtstudy.runner.work import Work, assess
from swtstudy.runner.workers import Workers
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
            self.close = held.pop_all().close

    def compute(self, workers: Workers, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        work, rtol = self.work, self.study.rtol
        now = datetime.now(UTC).isoformat(timespec="seconds")
        run = Run(SOLVER_VERSION, rtol, self.study.text, versions(), now, work.asked.items)
        work.found.runs = tuple(dict.fromkeys((*work.found.runs, run)))

        def deliver(places: IndexArray, arrays: Arrays) -> None:
            arrays["run"][:] = work.found.runs.index(run)
            self._unsaved.append((places, arrays))
            now = time.perf_counter()
            if now - self._saved >= max(PART_SECONDS, PART_SHARE * (now - self._begin)):
                self._save()
            shown.add(len(places))

        todo = int(work.todo.sum())
        with self.reporting(), Progress(todo, self.path.stem, delay=0.0) as shown:
            try:
                solve(chunks(work.points, work.todo, work.asked), rtol, solver, deliver, workers)
            except OSError:  # such as a full disk
                raise
            except BaseException:
                self._save()
                raise
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
        """Write the archive, which replaces the parts, and release it; what is not in it is kept."""
        with self.reporting():
            dataset = self._known() or self._written()
        self.close()
        finished(self.study, self.path, dataset)

    def _known(self) -> xr.Dataset | None:
        """The archive, if exactly this study wrote it and nothing had to be done."""
        from swtstudy.archive.netcdf import read_archive

        if not (self._complete and self.path.exists()) or len(parts.read_parts(self._folder)):
            return None
        archive = read_archive(self.path)
        if archive.attrs["study"] != self.study.text:
            return None
        parts.clear_parts(self._folder)  # parts that could not be read
        return archive

    def _written(self) -> xr.Dataset:
        from swtstudy.archive.archive import build, history_line
        from swtstudy.archive.netcdf import read_archive, save

        work, kept = self.work, parts.kept_folder(self.path)
        before = [read_archive(self.path).attrs["history"]] if self.path.exists() else []
        history = "\n".join([history_line(self._what), *before])
        seconds = time.perf_counter() - self._begin
        dataset = build(self.study, work.points, work.found.take(slice(None)), history, seconds)
        try:
            with parts.keeping(kept, work.others):
                save(dataset, self.path, beside=self._folder)
        except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
            raise OSError(f"cannot write the archive ({error})") from error
        parts.clear_parts(self._folder)
        if len(work.others):
            _log.info("%d points are not in this study: %s keeps them", len(work.others), kept)
        return read_archive(self.path)

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """However the block is stopped, its error says what is saved and how to go on."""
        try:
            yield
        except Stopped:
            raise
        except KeyboardInterrupt:
            words = f"stopped; {_saved(self.work, self.path)}; the same command continues from there"
            raise Stopped(words) from None
        except OSError as error:
            kind = WorkerError if isinstance(error, WorkerError) else OSError
            advice = "once that is fixed, the same command continues from there"
            raise kind(f"{error.strerror or error}; {_saved(self.work, self.path)}; {advice}") from error


def _saved(work: Work, path: Path) -> str:
    """Say how much is saved."""
    count = len(work.found)
    return f"{count - work.todo.sum()} of {count} distinct points are saved beside {path}"


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
