"""Run a study: look up what is known, compute what is missing, write the archive."""

from __future__ import annotations

import logging
import time
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.archive.files import check_writable
from swtstudy.grid.cost import SECONDS_PER_WEIGHT, weights
from swtstudy.mechanics.version import SOLVER_VERSION
from swtstudy.records.records import MISSING, Records, Run
from swtstudy.records.result import Result
from swtstudy.runner.chunk import Solver, solve_points
from swtstudy.runner.cutting import chunks
from swtstudy.runner.engines import Engine, Here, LocalWorkers
from swtstudy.runner.pace import Pace
from swtstudy.runner.progress import Progress
from swtstudy.runner.work import Work, assess
from swtstudy.study.definition import Study, require_study

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.archive.parts import PartsWriter

_log = logging.getLogger(__name__)

#: Less work than this is done before a worker process has started.
_SMALL_SECONDS = 1.0


class Stopped(KeyboardInterrupt):
    """A run that was stopped by Ctrl-C; the message says what is saved and how to go on."""


class SolverMismatchError(RuntimeError):
    """Workers that have another version of the solver than this process."""


def run(
    study: Study,
    path: str | PathLike[str],
    *,
    workers: int = 2,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = solve_points,
) -> xr.Dataset:
    """Compute a study and leave its archive at `path`.

    Every finished chunk is saved beside the archive at once. A run that was killed goes on where it was;
    an archive that has some of the points already gives these. What is known of points that the study does
    not have is kept in a folder beside the archive, ``figure3.nc.kept``, where a study that has them finds
    them.

    Parameters
    ----------
    study
        The study.
    path
        Where the netCDF archive is or goes.
    workers
        Number of local worker processes; a study of less than about a second is computed without.
    client
        Of a dask.distributed cluster, which is used instead of local workers.
    retry_failed
        Whether to compute anew what failed before.
    solver
        What solves a batch of points; a function that worker processes can import.

    Returns
    -------
    xarray.Dataset
        The archive, loaded. Points that failed are NaN, with their status and message.

    Raises
    ------
    StudyError
        A ValueError, if `study` is none.
    OSError
        If the archive cannot be written, found out before anything is computed, or if another run is
        writing it (`LockedError`).
    ArchiveError
        A ValueError, if there is a file that is not an archive.
    Stopped
        A KeyboardInterrupt, on Ctrl-C.
    """
    from swtstudy.archive.lock import locked
    from swtstudy.archive.parts import parts_folder

    require_study(study)
    path = Path(path)
    check_writable(path)
    with locked(parts_folder(path)):
        return _run_locked(study, path, workers, client, retry_failed, solver)


def _run_locked(
    study: Study, path: Path, workers: int, client: Client | None, retry_failed: bool, solver: Solver
) -> xr.Dataset:
    from swtstudy.archive.archive import build, history_line, versions
    from swtstudy.archive.files import save
    from swtstudy.archive.parts import (
        PartsWriter,
        clear_parts,
        clear_unfinished,
        keeping,
        kept_folder,
        parts_folder,
        read_parts,
    )
    from swtstudy.archive.read import read_archive

    begin = time.perf_counter()
    folder, kept = parts_folder(path), kept_folder(path)
    clear_unfinished(folder)
    work = assess(study, path, retry_failed)
    records, todo = work.records, int(work.missing.sum())
    old = read_archive(path) if path.exists() else None
    present = read_parts(folder)
    if todo == 0 and old is not None and old.attrs["study"] == study.text and not len(present):
        clear_parts(folder)  # what could not be read
        return old
    _tell(work, todo)
    if todo:
        writer = PartsWriter(folder, present)
        now = datetime.now(UTC).isoformat(timespec="seconds")
        this = Run(SOLVER_VERSION, study.rtol, study.text, versions(), now)
        engine = _engine(work, workers, client)
        records = _compute(records, this, engine, solver, writer, path)
    history = history_line(f"{todo} of {len(records)} distinct points computed")
    if old is not None:
        history += "\n" + old.attrs["history"]
    dataset = build(study, work.points, records.trimmed(), history, time.perf_counter() - begin)
    try:
        with keeping(kept, work.dropped):
            save(dataset, path, beside=folder)
    except (OSError, RuntimeError) as error:  # netCDF4 raises the latter on a full disk
        raise _interrupted(OSError(f"cannot write the archive ({error})"), records, path) from error
    clear_parts(folder)
    if len(work.dropped):
        _log.info("%d points are not in this study: %s keeps them", len(work.dropped), kept)
    return read_archive(path)


def _tell(work: Work, todo: int) -> None:
    if work.outdated:
        _log.warning("%d points come from another version of the solver: computed anew", work.outdated)
    if work.coarse:
        _log.info("%d points are less accurate than the study asks for: computed anew", work.coarse)
    if 0 < todo < len(work.records):
        _log.info("%d of %d distinct points are there already", len(work.records) - todo, len(work.records))


def _engine(work: Work, workers: int, client: Client | None) -> Engine:
    if client is not None:
        from swtstudy.runner.cluster import Cluster

        return Cluster(client)
    seconds = weights(work.points.table[work.missing]).sum() * SECONDS_PER_WEIGHT
    return Here() if workers < 2 or seconds < _SMALL_SECONDS else LocalWorkers(workers)


def _compute(
    records: Records, this: Run, engine: Engine, solver: Solver, writer: PartsWriter, path: Path
) -> Records:
    """The records with all that was missing; every result is a part as soon as it is delivered."""
    missing = records.status == MISSING
    weight = weights(records.table)
    progress, pace = Progress(int(missing.sum())), Pace()

    def deliver(result: Result) -> None:
        nonlocal records
        if result.solver_version != SOLVER_VERSION:
            raise SolverMismatchError(
                f"a worker has version {result.solver_version} of the solver, this machine {SOLVER_VERSION}"
            )
        part = Records.of(result, records.table[result.rows], this)
        writer.add(part)
        records = records.put(result.rows, part)
        pace.update(result, int(weight[result.rows].sum()))
        progress.add(len(result))

    try:
        with engine:
            engine.solve(chunks(records.table, missing, pace.chunk_weight), this.rtol, solver, deliver)
    except KeyboardInterrupt:
        raise Stopped(f"stopped; {_saved(records, path)}; the same command goes on from there") from None
    except OSError as error:
        raise _interrupted(error, records, path) from error
    finally:
        progress.close()
    return records


def _interrupted(error: OSError, records: Records, path: Path) -> OSError:
    """Such as a full disk, or a scheduler that is gone: what is saved, and how to go on."""
    reason = error.strerror or str(error)
    return OSError(
        f"{reason}; {_saved(records, path)}; once that is mended the same command goes on from there"
    )


def _saved(records: Records, path: Path) -> str:
    saved = int((records.status != MISSING).sum())
    return f"{saved} of {len(records)} distinct points are saved beside {path}"
