"""Run studies: look up known points, compute the missing ones, write the archives."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import AbstractContextManager, ExitStack, nullcontext
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.archive.paths import archive_paths
from swtstudy.runner.chunk import Solver, solve_points
from swtstudy.runner.engine import Pool
from swtstudy.runner.job import Job, Stopped
from swtstudy.runner.workers import LocalPool
from swtstudy.study.definition import Study, read_studies
from swtstudy.study.shipped import shipped_folder
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.figures.sheet import Width

__all__ = ["Stopped", "run", "run_and_draw", "run_several", "run_suite"]

#: Seconds of work that one process does alone: worker processes take as long to start.
_SMALL_SECONDS = 1.0

#: Receives the study, the path and the content of an archive as soon as it is written.
Finished = Callable[[Study, Path, "xr.Dataset"], None]


def run(
    study: Study,
    path: str | PathLike[str],
    *,
    workers: int = 2,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = solve_points,
) -> xr.Dataset:
    """Compute a study and write its archive to ``path``.

    Every finished chunk is saved beside the archive at once. A run that was killed continues where it was,
    and points that an archive at ``path`` already has are not computed again. Results for points that are no
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
        A ValueError, if ``study`` is not a Study, no archive can have that path, or there are no workers.
    OSError
        If the archive cannot be written, which is checked before anything is computed; if another run is
        writing it (`LockedError`); or if the disk is full.
    WorkerError
        An OSError, if the scheduler of a cluster is gone, or its workers have another version of the solver
        or lack it.
    ArchiveError
        A ValueError, if the file at ``path`` is not an archive.
    Stopped
        A KeyboardInterrupt, on Ctrl-C.

    Notes
    -----
    In each of these cases everything computed so far is saved.
    """
    found: list[xr.Dataset] = []
    run_several(
        [(study, Path(path))],
        lambda study, path, dataset: found.append(dataset),
        workers=workers,
        client=client,
        retry_failed=retry_failed,
        solver=solver,
    )
    return found[0]


def run_suite(
    folder: str | PathLike[str] | None = None,
    results: str | PathLike[str] = "results",
    formats: Iterable[str] = ("png",),
    width: Width | None = None,
    **options: Any,
) -> dict[str, xr.Dataset]:
    """Compute every study in a folder, and write their archives and figures.

    Parameters
    ----------
    folder
        Folder with study files (TOML); by default the studies of the paper, which come with the package.
    results
        Folder for archives and figures, which are named after their studies.
    formats
        Formats of the figures: "png", "pdf", "svg".
    width
        What the figures are made for: "column", "page", or None for a screen.
    **options
        Further arguments of `swtstudy.run`.

    Returns
    -------
    dict of xarray.Dataset
        The archives, loaded, by the name of the study.

    Raises
    ------
    StudyError
        A ValueError with every mistake in every study, before anything is computed.
    """
    folder = shipped_folder() if folder is None else folder
    studies = read_studies([str(folder)])
    targets = archive_paths(studies, results)
    found: dict[str, xr.Dataset] = {}

    def done(study: Study, path: Path, dataset: xr.Dataset) -> None:
        found[path.stem] = dataset

    pairs = [(study, targets[path]) for path, study in studies.items()]
    run_and_draw(pairs, formats, done, width, **options)
    return found


def run_and_draw(
    studies: Iterable[tuple[Study, Path]],
    formats: Iterable[str],
    done: Finished,
    width: Width | None = None,
    **options: Any,
) -> None:
    """Run studies with the same workers, and draw the figures of those that have one beside their archives.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    formats
        Formats of the figures.
    done
        Called with every archive once its figure is drawn; not always in this thread.
    width
        What the figures are made for, as for `swtstudy.accessor.SwtAccessor.figure`.
    **options
        Further arguments of `swtstudy.run`.
    """

    def finished(study: Study, path: Path, dataset: xr.Dataset) -> None:
        if study.figure is not None:
            from swtstudy.figures.draw import draw
            from swtstudy.figures.style import save_figure

            figure = draw(dataset, width=width)
            for ending in formats:
                save_figure(figure, path.with_suffix(f".{ending}"))
        done(study, path, dataset)

    run_several(studies, finished, **options)


def run_several(
    studies: Iterable[tuple[Study, Path]],
    finished: Finished,
    *,
    workers: int = 2,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = solve_points,
) -> None:
    """Compute studies with the same workers, and write their archives.

    While the workers compute a study, the archive of the one before is written in another thread: netCDF is
    not thread-safe, but computing only writes parts. An error in one study ends all; what is computed of the
    others is saved.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    finished
        Called with every archive, one after the other, not always in this thread.
    workers, client, retry_failed, solver
        As for `run`.
    """
    if not isinstance(workers, int) or workers < 1:
        raise StudyError([Mistake("workers", literal(workers), "a number of processes, from 1 on")])
    with ExitStack() as held:
        background = held.enter_context(ThreadPoolExecutor(1))
        local = held.enter_context(LocalPool(workers))
        before: Job | None = None
        for study, path in studies:
            try:
                job = Job(study, path, retry_failed)
            except BaseException:
                if before is not None:
                    _finish(before, finished)
                raise
            held.callback(job.__exit__)
            writing = None if before is None else background.submit(_finish, before, finished)
            try:
                pool = _pool(job, local, client)
                if before is None:
                    background.submit(_prepare_archives)
                job.compute(pool, solver)
            finally:
                _wait(writing, before)
            before = job
        # Workers exit while the last archive is written.
        background.submit(local.close)
        if before is not None:
            _finish(before, finished)


def _prepare_archives() -> None:
    """Import what archives need while the workers compute, after what hands them their work."""
    import dask.local  # noqa: F401

    import swtstudy.archive.archive  # noqa: F401


def _finish(job: Job, finished: Finished) -> None:
    """Write the archive of a job, and release it."""
    dataset = job.finish()
    job.__exit__()
    finished(job.study, job.path, dataset)


def _wait(writing: Future[None] | None, job: Job | None) -> None:
    """Wait for an archive that is being written; its error counts."""
    if writing is not None and job is not None:
        with job.reporting():
            writing.result()


def _pool(job: Job, local: LocalPool, client: Client | None) -> AbstractContextManager[Pool | None]:
    """The workers for a study; none if this process alone is faster."""
    if client is not None:
        from swtstudy.runner.cluster import ClusterPool

        return ClusterPool(client)
    alone = local.size() < 2 or (not local.started and job.seconds < _SMALL_SECONDS)
    # Not with the first task: workers import while this process does.
    return nullcontext(None if alone else local.start() if job.work.todo else local)
