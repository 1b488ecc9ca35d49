"""Run a study: look up known points, compute the missing ones, write the archive."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.files import check_writable
from swtstudy.grid.cost import SECONDS_PER_WEIGHT, weights
from swtstudy.records.records import Records, Run
from swtstudy.runner.chunk import Solver, solve_points
from swtstudy.runner.collector import Collector
from swtstudy.runner.cutting import chunks
from swtstudy.runner.engine import Pool, WorkerError, solve
from swtstudy.runner.work import Work, assess
from swtstudy.runner.workers import LocalPool
from swtstudy.study.definition import Study, require_study
from swtstudy.version import SOLVER_VERSION

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

_log = logging.getLogger(__name__)

#: Seconds of work that one process does alone: worker processes take as long to start.
_SMALL_SECONDS = 1.0


class Stopped(KeyboardInterrupt):
    """A run that was stopped by Ctrl-C; the message says what is saved and how to go on."""


def run(
    study: Study,
    path: str | PathLike[str],
    *,
    workers: int = 2,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = solve_points,
) -> xr.Dataset:
    """Compute a study and write its archive to `path`.

    Every finished chunk is saved beside the archive at once. A run that was killed continues where it was,
    and points that an archive at `path` already has are not computed again. Results for points that are no
    longer in the study are kept in a folder beside the archive, ``figure3.nc.kept``, and used again by a
    study that has them.

    Parameters
    ----------
    study
        The study.
    path
        Path of the netCDF archive, which may exist.
    workers
        Number of local worker processes; a study that takes less than about a second is computed without any.
    client
        Client of a dask.distributed cluster, to be used instead of local workers.
    retry_failed
        Whether to recompute points that failed before.
    solver
        Solves a batch of points; a function that worker processes can import.

    Returns
    -------
    xarray.Dataset
        The archive, loaded into memory. Points that failed are NaN, with their status and message.

    Raises
    ------
    StudyError
        A ValueError, if `study` is not a Study, or no archive can have that path.
    OSError
        If the archive cannot be written, which is checked before anything is computed; if another run is
        writing it (`LockedError`); or if the disk is full.
    WorkerError
        An OSError, if the scheduler of a cluster is gone, or its workers have another version of the solver
        or lack it.
    ArchiveError
        A ValueError, if the file at `path` is not an archive.
    Stopped
        A KeyboardInterrupt, on Ctrl-C.

    Notes
    -----
    In each of these cases everything computed so far is saved.
    """
    from swtstudy.archive.archive import build
    from swtstudy.archive.lock import locked
    from swtstudy.archive.names import check_archive_path
    from swtstudy.archive.parts import clear_unfinished, parts_folder

    require_study(study)
    path = Path(path)
    check_archive_path(path)
    check_writable(path)
    with locked(parts_folder(path)):
        clear_unfinished(parts_folder(path))
        begin = time.perf_counter()
        work = assess(study, path, retry_failed)
        finished = _finished(work, study, path)
        if finished is not None:
            return finished
        _log_known(work)
        what = _words(work)
        with _reporting_what_is_saved(work, path):
            records = _compute(work, study, path, _pool(work, workers, client), solver)
            history, seconds = _history(what, path), time.perf_counter() - begin
            return _leave(build(study, work.points, records.trimmed(), history, seconds), work.dropped, path)


def _finished(work: Work, study: Study, path: Path) -> xr.Dataset | None:
    """The archive, if it is that of exactly this study and nothing is left to do."""
    from swtstudy.archive.parts import clear_parts, parts_folder, read_parts
    from swtstudy.archive.read import read_archive

    if work.todo or not path.exists() or len(read_parts(parts_folder(path))):
        return None
    archive = read_archive(path)
    if archive.attrs["study"] != study.text:
        return None
    clear_parts(parts_folder(path))  # parts that could not be read
    return archive


def _words(work: Work) -> str:
    """What a run does, in the past tense, for the history."""
    words = f"{int(work.missing.sum())} of {len(work.records)} distinct points computed"
    more = int(work.incomplete.sum())
    return f"{words}, and {', '.join(work.quantities)} of {more} others" if more else words


def _log_known(work: Work) -> None:
    if work.outdated:
        _log.warning("%d points come from another version of the solver and are recomputed", work.outdated)
    if work.coarse:
        _log.info("%d points are less accurate than the study asks for and are recomputed", work.coarse)
    if work.incomplete.any():
        _log.info("%d points are computed, but lack quantities that the study asks", work.incomplete.sum())
    if 0 < work.todo < len(work.records):
        known = len(work.records) - work.todo
        _log.info("%d of %d distinct points are already computed", known, len(work.records))


@contextmanager
def _reporting_what_is_saved(work: Work, path: Path) -> Iterator[None]:
    """However the block is stopped, its error says what is saved and how to go on."""
    try:
        yield
    except KeyboardInterrupt:
        raise Stopped(f"stopped; {_saved(work, path)}; the same command continues from there") from None
    except OSError as error:
        kind = WorkerError if isinstance(error, WorkerError) else OSError
        reason = error.strerror or str(error)
        advice = "once that is fixed, the same command continues from there"
        raise kind(f"{reason}; {_saved(work, path)}; {advice}") from error


def _saved(work: Work, path: Path) -> str:
    # A run fills its records in place.
    saved = len(work.records) - work.todo
    return f"{saved} of {len(work.records)} distinct points are saved beside {path}"


def _pool(work: Work, workers: int, client: Client | None) -> AbstractContextManager[Pool | None]:
    """The workers of a run; none if this process alone is faster."""
    if client is not None:
        from swtstudy.runner.cluster import ClusterPool

        return ClusterPool(client)
    wanted = work.missing | work.incomplete
    seconds = weights(work.points.table[wanted]).sum() * SECONDS_PER_WEIGHT
    if workers < 2 or seconds < _SMALL_SECONDS:
        return nullcontext()
    return LocalPool(workers)


def _compute(
    work: Work, study: Study, path: Path, workers: AbstractContextManager[Pool | None], solver: Solver
) -> Records:
    """The records, with the missing points computed."""
    from swtstudy.archive.archive import versions
    from swtstudy.archive.parts import PartsWriter, parts_folder

    if not work.todo:
        return work.records
    writer = PartsWriter(parts_folder(path))
    now = datetime.now(UTC).isoformat(timespec="seconds")
    asked = tuple(sorted(study.quantities))
    own = Run(SOLVER_VERSION, study.rtol, study.text, versions(), now, quantities=asked)
    collector = Collector(work.records, own, writer, work.todo)
    weight = collector.pace.chunk_weight
    todo = (
        chunk for wanted, asked in list(work.tasks()) for chunk in chunks(work.points, wanted, weight, asked)
    )
    with collector, workers as pool:
        solve(todo, study.rtol, solver, collector.add, pool)
    return collector.records


def _history(what: str, path: Path) -> str:
    """What was done, followed by the history of the archive that is replaced."""
    from swtstudy.archive.archive import history_line
    from swtstudy.archive.read import read_archive

    before = [read_archive(path).attrs["history"]] if path.exists() else []
    return "\n".join([history_line(what), *before])


def _leave(dataset: xr.Dataset, dropped: Records, path: Path) -> xr.Dataset:
    """Write the archive, which replaces the parts, and keep the records that are not in it."""
    from swtstudy.archive.parts import clear_parts, keeping, kept_folder, parts_folder
    from swtstudy.archive.read import read_archive
    from swtstudy.archive.write import save

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
