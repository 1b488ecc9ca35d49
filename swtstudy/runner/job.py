"""One study on its way to its archive: what is known, what is computed, and the file."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.points.chunk import Solver, chunks
from swtstudy.points.records import Records, Run
from swtstudy.runner.collector import Collector
from swtstudy.runner.engine import Pool, WorkerError, solve
from swtstudy.runner.workload import Workload, assess
from swtstudy.study.definition import Study, require_study
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    import xarray as xr

_log = logging.getLogger(__name__)


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
        self.study, self.path = study, path
        self._held = ExitStack()
        self._held.enter_context(locked(parts_folder(path)))
        try:
            clear_unfinished(parts_folder(path))
            self._begin = time.perf_counter()
            self.work = assess(study, path, retry_failed)
            self._known = _finished(self.work, study, path)
            self._what = _words(self.work)
            self._records = self.work.records
            if self._known is None:
                _log_known(self.work)
        except BaseException:
            self._held.close()
            raise

    def __enter__(self) -> Job:
        return self

    def __exit__(self, *_: object) -> None:
        self._held.close()

    def compute(self, pool: Pool, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        with self.reporting():
            self._records = _compute(self.work, self.study, self.path, pool, solver)

    def finish(self) -> xr.Dataset:
        """Write the archive, and return it."""
        from swtstudy.archive.archive import build

        if self._known is not None:
            return self._known
        with self.reporting():
            history, seconds = _history(self._what, self.path), time.perf_counter() - self._begin
            dataset = build(self.study, self.work.points, self._records.trimmed(), history, seconds)
            return _leave(dataset, self.work.dropped, self.path)

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
            reason = error.strerror or str(error)
            advice = "once that is fixed, the same command continues from there"
            raise kind(f"{reason}; {_saved(self.work, self.path)}; {advice}") from error


def _finished(work: Workload, study: Study, path: Path) -> xr.Dataset | None:
    """The archive, if it is that of exactly this study and nothing is left to do."""
    from swtstudy.archive.parts import clear_parts, parts_folder, read_parts

    if work.todo or not path.exists() or len(read_parts(parts_folder(path))):
        return None
    from swtstudy.archive.netcdf import read_archive

    archive = read_archive(path)
    if archive.attrs["study"] != study.text:
        return None
    clear_parts(parts_folder(path))  # parts that could not be read
    return archive


def _words(work: Workload) -> str:
    """The action of a run in the past tense, for the history."""
    words = f"{int(work.missing.sum())} of {len(work.records)} distinct points computed"
    more = int(work.incomplete.sum())
    return f"{words}, and quantities that {more} others lacked" if more else words


def _log_known(work: Workload) -> None:
    if work.outdated:
        _log.warning("%d points come from another version of the solver and are recomputed", work.outdated)
    if work.coarse:
        _log.info("%d points are less accurate than the study asks for and are recomputed", work.coarse)
    if work.incomplete.any():
        _log.info("%d points are computed, but lack quantities that the study asks", work.incomplete.sum())
    if 0 < work.todo < len(work.records):
        known = len(work.records) - work.todo
        _log.info("%d of %d distinct points are already computed", known, len(work.records))


def _saved(work: Workload, path: Path) -> str:
    # A run fills its records in place.
    saved = len(work.records) - work.todo
    return f"{saved} of {len(work.records)} distinct points are saved beside {path}"


def _compute(work: Workload, study: Study, path: Path, pool: Pool, solver: Solver) -> Records:
    """The records, with the missing points computed."""
    from swtstudy.archive.attributes import versions
    from swtstudy.archive.parts import PartsWriter, parts_folder

    if not work.todo:
        return work.records
    writer = PartsWriter(parts_folder(path))
    now = datetime.now(UTC).isoformat(timespec="seconds")
    own = Run(SOLVER_VERSION, study.rtol, study.text, versions(), now)
    todo = [chunk for wanted, asked in list(work.tasks()) for chunk in chunks(work.points, wanted, asked)]
    collector = Collector(work.records, own, writer, work.todo, path.stem)
    with collector:
        solve(todo, study.rtol, solver, collector.add, pool)
    return collector.records


def _history(what: str, path: Path) -> str:
    """Return the line of this run, followed by the history of the archive that is replaced."""
    from swtstudy.archive.archive import history_line
    from swtstudy.archive.netcdf import read_archive

    before = [read_archive(path).attrs["history"]] if path.exists() else []
    return "\n".join([history_line(what), *before])


def _leave(dataset: xr.Dataset, dropped: Records, path: Path) -> xr.Dataset:
    """Write the archive, which replaces the parts, and keep the records that are not in it."""
    from swtstudy.archive.netcdf import read_archive, save
    from swtstudy.archive.parts import clear_parts, keeping, kept_folder, parts_folder

    folder, kept = parts_folder(path), kept_folder(path)
    try:
        with keeping(kept, dropped):
            save(dataset, path, beside=folder)
    except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
        raise OSError(f"cannot write the archive ({error})") from error
    clear_parts(folder)
    if len(dropped):
        _log.info("%d points are not in this study: %s keeps them", len(dropped), kept)
    return read_archive(path)
