"""Run studies: look up known points, compute the missing ones, write the archives."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.archive import parts
from swtstudy.archive.paths import archive_paths, check_archive_path, locked
from swtstudy.archive.work import Work, assess
from swtstudy.archive.workers import ClusterPool, LocalPool, WorkerError, Workers, without_signals
from swtstudy.points.chunk import Run, Solver, chunks, put
from swtstudy.study.definition import Study, read_studies, require_study
from swtstudy.study.shipped import shipped_folder
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.version import SOLVER_VERSION, versions

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.figures.sheet import Width

_log = logging.getLogger(__name__)

#: Receives the study, the path and the content of an archive as soon as it is written.
Finished = Callable[[Study, Path, "xr.Dataset"], None]

#: Seconds after which results are saved, and the share of a long run that this may be instead: so much is
#: lost with the process, and a run of any length leaves some hundred files.
PART_SECONDS, PART_SHARE = 0.5, 0.01


class Stopped(KeyboardInterrupt):
    """A run that was stopped by Ctrl-C; the message says what is saved and how to go on."""


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
    run_several(
        [(study, Path(path))],
        lambda study, path, dataset: found.append(dataset),
        workers=workers,
        processes=processes,
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
    run_several(
        [(study, targets[path]) for path, study in studies.items()],
        lambda _, path, dataset: found.update({path.stem: dataset}),
        tuple(formats),
        width,
        **options,
    )
    return found


def run_several(
    studies: Iterable[tuple[Study, Path]],
    finished: Finished,
    formats: Sequence[str] = (),
    width: Width | None = None,
    *,
    workers: int = 2,
    processes: bool = False,
    client: Client | None = None,
    retry_failed: bool = False,
    solver: Solver = None,
) -> None:
    """Compute studies with the same workers, write their archives, and draw their figures beside these.

    An archive is written and its figure drawn in another thread, while the workers compute the next study. An
    error in one study ends all; what is computed of the others is saved.

    Parameters
    ----------
    studies
        Studies and the paths of their archives.
    finished
        Called with every archive, once its figure is drawn, one after the other, in the other thread.
    formats
        Formats of the figures: "png", "pdf", "svg". Without one nothing is drawn.
    width
        The use of the figures, as for `swtstudy.faces.accessor.SwtAccessor.figure`.
    workers, processes, client, retry_failed, solver
        As for `run`.
    """
    if not isinstance(workers, int) or workers < 1:
        raise refused("workers", literal(workers), "a number of workers, from 1 on")

    def complete(job: Job, held: ExitStack) -> None:
        with held, job.reporting():
            dataset = job.finish()
        study, path = job.study, job.path
        if study.figure is not None and formats:
            from swtstudy.figures.draw import draw
            from swtstudy.figures.style import save_figure

            figure = draw(dataset, width=width)
            for ending in formats:
                save_figure(figure, path.with_suffix(f".{ending}"))
        finished(study, path, dataset)

    local, before = LocalPool if processes else Workers, Future[None]()
    before.set_result(None)
    with local(workers) if client is None else ClusterPool(client) as pool, ThreadPoolExecutor(1) as other:
        for study, path in studies:
            require_study(study)
            check_archive_path(path)
            check_writable(path)
            with ExitStack() as held:
                held.enter_context(locked(parts.parts_folder(path)))
                job = Job(study, path, retry_failed)
                try:
                    with job.reporting():
                        job.compute(pool, solver)
                finally:
                    before.result()
                with without_signals():
                    before = other.submit(complete, job, held.pop_all())
        before.result()


class Job:
    """A study to be computed, while the lock of its archive is held.

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
        self.study, self.path, self._folder = study, path, parts.parts_folder(path)
        parts.clear_unfinished(self._folder)
        self._begin = self._saved = time.perf_counter()
        self.work = assess(study, path, retry_failed)
        self._todo, self._what = int(self.work.todo.sum()), _told(self.work)
        self._unsaved: list[IndexArray] = []

    def compute(self, workers: Workers, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        work, rtol = self.work, self.study.rtol
        started = datetime.now(UTC).isoformat(timespec="seconds")
        run = Run(SOLVER_VERSION, rtol, self.study.text, versions(), started, work.asked.items)
        work.found.runs = tuple(dict.fromkeys((*work.found.runs, run)))
        number, missing = work.found.runs.index(run), chunks(work.points, work.todo, work.asked)
        with Progress(self._todo, self.path.stem, delay=0.0) as shown:
            try:
                for places, arrays in workers.solve(missing, rtol, solver):
                    arrays["run"][:] = number
                    put(work.found.arrays, places, arrays)
                    self._unsaved.append(places)
                    now = time.perf_counter()
                    if now - self._saved >= max(PART_SECONDS, PART_SHARE * (now - self._begin)):
                        self._save()
                    shown.add(len(places))
            finally:
                self._save()

    def _save(self) -> None:
        """Save the results of chunks as a part; only then they count."""
        if self._unsaved:
            parts.save_part(self._folder, self.work.found.take(np.concatenate(self._unsaved)))
            self._unsaved, self._saved = [], time.perf_counter()

    def finish(self) -> xr.Dataset:
        """Write the archive, which replaces the parts, and read it; what is not in it is kept.

        An archive that exactly this study wrote stays as it is, if nothing had to be done.
        """
        from swtstudy.archive.archive import build, history_line
        from swtstudy.archive.netcdf import read_archive, save

        archive, history = None, [history_line(self._what)]
        if self.path.exists():
            archive = read_archive(self.path)
            history.append(archive.attrs["history"])
        same = archive is not None and archive.attrs["study"] == self.study.text
        if archive is None or not same or self._todo or len(parts.read_parts(self._folder)):
            work, kept = self.work, parts.kept_folder(self.path)
            seconds = time.perf_counter() - self._begin
            dataset = build(self.study, work.points, work.found, "\n".join(history), seconds)
            try:
                with parts.keeping(kept, work.others):
                    save(dataset, self.path, beside=self._folder)
            except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
                raise OSError(f"cannot write the archive ({error})") from error
            if len(work.others):
                _log.info("%d points are not in this study: %s keeps them", len(work.others), kept)
            archive = read_archive(self.path)
        parts.clear_parts(self._folder)
        return archive

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """However the block is stopped, its error says what is saved and how to go on."""
        count = len(self.work.found)
        try:
            yield
        except (KeyboardInterrupt, OSError) as error:
            known = count - self.work.todo.sum() - sum(map(len, self._unsaved))
            saved = f"{known} of {count} distinct points are saved beside {self.path}"
            if isinstance(error, KeyboardInterrupt):
                raise Stopped(f"stopped; {saved}; the same command continues from there") from None
            kind = WorkerError if isinstance(error, WorkerError) else OSError
            advice = "once that is fixed, the same command continues from there"
            raise kind(f"{error.strerror or error}; {saved}; {advice}") from error


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
