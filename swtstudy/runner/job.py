"""One study on its way to its archive: what is known, what is computed and saved, and the file."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from swtstudy.points.chunk import Solver
from swtstudy.points.found import Found, Run, join
from swtstudy.runner.engine import Pool, WorkerError, solve
from swtstudy.runner.work import Work, assess
from swtstudy.study.definition import Study, require_study
from swtstudy.vocabulary.arrays import IntArray
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    import xarray as xr

_log = logging.getLogger(__name__)

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
        from swtstudy.archive.parts import clear_unfinished, parts_folder
        from swtstudy.archive.paths import check_archive_path, locked

        require_study(study)
        check_archive_path(path)
        check_writable(path)
        self.study, self.path, self._folder = study, path, parts_folder(path)
        with ExitStack() as held:
            held.enter_context(locked(self._folder))
            clear_unfinished(self._folder)
            self._begin = time.perf_counter()
            self.work = assess(study, path, retry_failed)
            self._known = self._finished()
            self._what = self._told()
            self.close = held.pop_all().close

    def _finished(self) -> xr.Dataset | None:
        """The archive, if it is that of exactly this study and nothing is left to do."""
        from swtstudy.archive.parts import clear_parts, read_parts

        if self.work.todo.any() or not self.path.exists() or len(read_parts(self._folder)):
            return None
        from swtstudy.archive.netcdf import read_archive

        archive = read_archive(self.path)
        if archive.attrs["study"] != self.study.text:
            return None
        clear_parts(self._folder)  # parts that could not be read
        return archive

    def _told(self) -> str:
        """Say in the log what is known; what the run does, for the history."""
        work, count = self.work, len(self.work.found)
        todo, more = int(work.todo.sum()), int(work.incomplete.sum())
        if work.outdated:
            _log.warning(
                "%d points come from another version of the solver and are recomputed", work.outdated
            )
        if work.coarse:
            _log.info("%d points are less accurate than the study asks for and are recomputed", work.coarse)
        if more:
            _log.info("%d points are computed, but lack quantities that the study asks", more)
        if 0 < todo < count:
            _log.info("%d of %d distinct points are already computed", count - todo, count)
        words = f"{todo} of {count} distinct points computed"
        return f"{words}, {more} of them for quantities that they lacked" if more else words

    def compute(self, pool: Pool, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        if not self.work.todo.any():
            return
        from swtstudy.archive.attributes import versions

        now, study = datetime.now(UTC).isoformat(timespec="seconds"), self.study
        run = Run(SOLVER_VERSION, study.rtol, study.text, versions(), now, self.work.asked.items)
        with self.reporting(), _Saving(self, run) as saving:
            solve(self.work.chunks(), study.rtol, solver, saving.add, pool)

    def finish(self) -> xr.Dataset:
        """Write the archive, which replaces the parts, and return it; what is not in it is kept."""
        from swtstudy.archive.archive import build, history_line
        from swtstudy.archive.netcdf import read_archive, save
        from swtstudy.archive.parts import clear_parts, keeping, kept_folder

        if self._known is not None:
            return self._known
        work, kept = self.work, kept_folder(self.path)
        with self.reporting():
            before = [read_archive(self.path).attrs["history"]] if self.path.exists() else []
            history = "\n".join([history_line(self._what), *before])
            seconds = time.perf_counter() - self._begin
            dataset = build(self.study, work.points, work.found.take(slice(None)), history, seconds)
            try:
                with keeping(kept, work.others):
                    save(dataset, self.path, beside=self._folder)
            except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
                raise OSError(f"cannot write the archive ({error})") from error
            clear_parts(self._folder)
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


class _Saving:
    """Saves the results of a run as parts, inside a with block; only then they count."""

    def __init__(self, job: Job, run: Run) -> None:
        self._work, self._folder, self._run = job.work, job._folder, run
        self._progress = Progress(int(job.work.todo.sum()), job.path.stem, delay=0.0)
        self._unsaved: list[tuple[IntArray, Found]] = []
        self._begin = self._saved = time.monotonic()

    def __enter__(self) -> _Saving:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._progress.close()
        if kind is None or not issubclass(kind, OSError):
            self._save()

    def add(self, places: IntArray, version: str, found: Found) -> None:
        """Take what a worker has found of the points in some places."""
        if version != SOLVER_VERSION:
            words = f"a worker has version {version} of the solver"
            raise WorkerError(f"{words}, this machine {SOLVER_VERSION}")
        found["run"][:] = 0
        self._unsaved.append((places, Found(found.arrays, (self._run,))))
        now = time.monotonic()
        if now - self._saved >= max(PART_SECONDS, PART_SHARE * (now - self._begin)):
            self._save()
        self._progress.add(len(places))

    def _save(self) -> None:
        from swtstudy.archive.parts import save_part

        if self._unsaved:
            places, parts = zip(*self._unsaved, strict=True)
            part = join(parts)
            save_part(self._folder, part)
            self._work.found = self._work.found.put(np.concatenate(places), part)
            self._unsaved, self._saved = [], time.monotonic()
