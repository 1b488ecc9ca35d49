"""Run studies: look up known points, compute the missing ones, write the archives."""

from __future__ import annotations

from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.archive.paths import archive_paths
from swtstudy.points.chunk import Solver
from swtstudy.runner.job import Finished, Job, Stopped
from swtstudy.runner.workers import workers_of
from swtstudy.study.definition import Study, read_studies
from swtstudy.study.shipped import shipped_folder
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.figures.sheet import Width

__all__ = ["Stopped", "run", "run_and_draw", "run_several", "run_suite"]


def run(
    study: Study,
    path: str | PathLike[str],
    *,
    workers: int = 2,
    processes: bool = False,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = None,
) -> xr.Dataset:
    """Compute a study and write its archive to ``path``.

    Finished points are saved beside the archive within a second, or within a hundredth of the time of a long
    run. A run that was killed continues where it was, and points that an archive at ``path`` already has are
    not computed again. Results for points that are no longer in the study are kept in a folder beside the
    archive, ``figure3.nc.kept``, and used again by a study that has them.

    Parameters
    ----------
    study
        The study.
    path
        Path of the netCDF archive, which may exist.
    workers
        Number of threads that compute, or of processes.
    processes
        Whether processes compute instead of threads. They take seconds to start, and a point that kills its
        process then fails alone.
    client
        Client of a dask.distributed cluster, to be used instead of local workers.
    retry_failed
        Whether to recompute points that failed before.
    solver
        Solves a batch of points, several batches at a time, instead of the package's own; processes must be
        able to import it.

    Returns
    -------
    xarray.Dataset
        The archive, loaded into memory. Points that failed are NaN, with their status and message.

    Raises
    ------
    StudyError
        A ValueError, if ``study`` is not a Study, the path cannot be an archive's, or there are no workers.
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
    After each of these errors everything computed so far is saved.
    """
    found: list[xr.Dataset] = []
    given: dict[str, Any] = {"workers": workers, "processes": processes, "client": client}
    given |= {"retry_failed": retry_failed, "solver": solver}
    run_several([(study, Path(path))], lambda study, path, dataset: found.append(dataset), **given)
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
        The use of the figures: "column", "page", or None for a screen.
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
    studies = read_studies([str(shipped_folder() if folder is None else folder)])
    targets = archive_paths(studies, results)
    found: dict[str, xr.Dataset] = {}
    pairs = [(study, targets[path]) for path, study in studies.items()]
    run_and_draw(
        pairs, formats, lambda _, path, dataset: found.update({path.stem: dataset}), width, **options
    )
    return found


def run_and_draw(
    studies: Iterable[tuple[Study, Path]],
    formats: Iterable[str],
    done: Finished,
    width: Width | None = None,
    **options: Any,
) -> None:
    """Run studies with the same workers, and draw the figures that they have beside their archives.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    formats
        Formats of the figures.
    done
        Called with every archive once its figure is drawn; not always in this thread.
    width
        The use of the figures, as for `swtstudy.accessor.SwtAccessor.figure`.
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
    processes: bool = False,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = None,
) -> None:
    """Compute studies with the same workers, and write their archives.

    While the workers compute a study, the archive of the one before is written in another thread. An error in
    one study ends all; what is computed of the others is saved.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    finished
        Called with every archive, one after the other, not always in this thread.
    workers, processes, client, retry_failed, solver
        As for `run`.
    """
    if not isinstance(workers, int) or workers < 1:
        raise StudyError([Mistake("workers", literal(workers), "a number of workers, from 1 on")])
    with ExitStack() as held:
        background = held.enter_context(ThreadPoolExecutor(1))
        pool = held.enter_context(workers_of(workers, processes, client))
        before: Job | None = None
        try:
            for study, path in studies:
                job = Job(study, path, retry_failed)
                held.callback(job.close)
                writing = before and (before, background.submit(before.finish, finished))
                before = None
                try:
                    job.compute(pool, solver)
                finally:
                    if writing:
                        with writing[0].reporting():
                            writing[1].result()
                before = job
        finally:
            if before is not None:
                before.finish(finished)
