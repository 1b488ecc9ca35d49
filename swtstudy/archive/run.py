"""Run studies: look up known points, compute the missing ones, write the archives; how long that takes."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from datetime import UTC, datetime
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from swtstudy.archive import parts
from swtstudy.archive.paths import archive_paths, check_archive_path, locked
from swtstudy.archive.workers import ClusterPool, LocalPool, WorkerError, Workers, without_signals
from swtstudy.points.chunk import (
    Found,
    Run,
    Solver,
    cut,
    look_up,
    matching,
    put,
    solve_chunk,
    task_of,
    versions,
)
from swtstudy.points.grid import Distinct, group_rows
from swtstudy.solver.load_path import LoadPath
from swtstudy.study.definition import Study, read_studies, require_study
from swtstudy.study.shipped import shipped_folder
from swtstudy.vocabulary.arrays import BoolArray, IndexArray
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.progress import Progress
from swtstudy.vocabulary.quantities import MISSING, Request
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client

    from swtstudy.figures.sheet import Width

_log = logging.getLogger(__name__)

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
    finished: Callable[[Study, Path, xr.Dataset], None],
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
        Called with the study, the path and the content of every archive, once its figure is drawn, one after
        the other, in the other thread.
    formats
        Formats of the figures: "png", "pdf", "svg". Without one nothing is drawn.
    width
        The use of the figures, as for `swtstudy.faces.accessor.SwtAccessor.figure`.
    workers, processes, client, retry_failed, solver
        As for `run`.
    """
    if not isinstance(workers, int) or workers < 1:
        raise refused("workers", literal(workers), "a number of workers, from 1 on")

    def complete(work: Work, held: ExitStack) -> None:
        with held, work.reporting():
            dataset = work.finish()
        study, path = work.study, work.path
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
                folder = parts.parts_folder(path)
                held.enter_context(locked(folder))
                parts.clear(folder)
                work = Work(study, path, retry_failed)
                try:
                    with work.reporting():
                        work.compute(pool, solver)
                finally:
                    before.result()
                with without_signals():
                    before = other.submit(complete, work, held.pop_all())
        before.result()


class Work:
    """The work for a study: the points that it needs, and which of them are known.

    To find that computes no point. The lock of the archive is held while points are computed and written.

    Parameters
    ----------
    study
        The study.
    path
        Path of its archive.
    retry_failed
        Whether to recompute points that failed before.

    Attributes
    ----------
    points
        The distinct points of the study.
    found
        Known values of these points; a run fills in the others.
    others
        Known values of points and quantities that the study does not have.
    outdated, coarse
        Number of points known only from another version of the solver, or only with less accuracy.
    """

    def __init__(self, study: Study, path: Path, retry_failed: bool = False) -> None:
        self._begin = self._saved = time.perf_counter()
        self.study, self.path, self._folder = study, path, parts.parts_folder(path)
        if path.exists():
            from swtstudy.archive.archive import known_points
        else:  # workers start before xarray is imported
            known_points = parts.known_beside
        self.points, known = Distinct.of(study.grid, study.asked), known_points(path)
        usable = known.usable(study.rtol, SOLVER_VERSION, retry_failed)
        self.found = matching(self.points, known, usable)
        self.others = not_in(self.points, study.asked, known)
        lost, own = self.points.rows[self.found["status"] == MISSING], known.usable(np.inf, SOLVER_VERSION)
        candidates = (known["status"] != MISSING) & ~own, own & ~known.usable(study.rtol, SOLVER_VERSION)
        self.outdated, self.coarse = (int((look_up(lost, known, some) >= 0).sum()) for some in candidates)
        self._count, self._unsaved = int(self.todo.sum()), list[IndexArray]()

    @property
    def incomplete(self) -> BoolArray:
        """True where s is known, but a quantity is not, shape (n,): these points are computed again."""
        return self.found.lacking(self.study.asked)

    @property
    def todo(self) -> BoolArray:
        """Which points are to be computed, shape (n,)."""
        return np.asarray((self.found["status"] == MISSING) | self.incomplete)

    def compute(self, workers: Workers, solver: Solver) -> None:
        """Compute what is missing, saved in parts as it comes."""
        self._what = self._told()
        study, found = self.study, self.found
        started = datetime.now(UTC).isoformat(timespec="seconds")
        run = Run(SOLVER_VERSION, study.rtol, study.text, versions(), started, study.asked.items)
        found.runs = tuple(dict.fromkeys((*found.runs, run)))
        number, chunks = found.runs.index(run), cut(self.points, self.todo, study.asked)

        def arguments_of(places: IndexArray) -> tuple[Any, ...]:
            return *task_of(self.points, places, study.asked), study.rtol, solver

        with Progress(self._count, self.path.stem, delay=0.0) as shown:
            try:
                for places, arrays in workers.solve(chunks, arguments_of):
                    arrays["run"][:] = number
                    put(found.arrays, places, arrays)
                    self._unsaved.append(places)
                    now = time.perf_counter()
                    if now - self._saved >= max(PART_SECONDS, PART_SHARE * (now - self._begin)):
                        self._save()
                    shown.add(len(places))
            finally:
                self._save()

    def _told(self) -> str:
        """Say in the log what is known; what the run does, for the history."""
        count, todo, more = len(self.found), self._count, int(self.incomplete.sum())
        for number, level, words in (
            (self.outdated, logging.WARNING, "come from another version of the solver and are recomputed"),
            (self.coarse, logging.INFO, "are less accurate than the study asks for and are recomputed"),
            (more, logging.INFO, "are computed, but lack quantities that the study asks"),
        ):
            if number:
                _log.log(level, "%d points %s", number, words)
        if 0 < todo < count:
            _log.info("%d of %d distinct points are already computed", count - todo, count)
        words = f", {more} of them for quantities that they lacked" if more else ""
        return f"{todo} of {count} distinct points computed{words}"

    def _save(self) -> None:
        """Save the results of chunks as a part; only then they count."""
        if self._unsaved:
            parts.save_part(self._folder, self.found.take(np.concatenate(self._unsaved)))
            self._unsaved, self._saved = [], time.perf_counter()

    def finish(self) -> xr.Dataset:
        """Write the archive, which replaces the parts, and read it; what is not in it is kept.

        An archive that exactly this study wrote stays as it is, if nothing had to be done.
        """
        from swtstudy.archive.archive import build, history_line, read_archive, save

        archive, history = None, [history_line(self._what)]
        if self.path.exists():
            archive = read_archive(self.path)
            history.append(archive.attrs["history"])
        same = archive is not None and archive.attrs["study"] == self.study.text
        if archive is None or not same or self._count or len(parts.read_parts(self._folder)):
            seconds, kept = time.perf_counter() - self._begin, parts.kept_folder(self.path)
            dataset = build(self.study, self.points, self.found, "\n".join(history), seconds)
            try:
                with parts.keeping(kept, self.others):
                    save(dataset, self.path, beside=self._folder)
            except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
                raise OSError(f"cannot write the archive ({error})") from error
            if len(self.others):
                _log.info("%d points are not in this study: %s keeps them", len(self.others), kept)
            archive = read_archive(self.path)
        parts.clear(self._folder, parts.part_paths(self._folder))
        return archive

    @contextmanager
    def reporting(self) -> Iterator[None]:
        """However the block is stopped, its error says what is saved and how to go on."""
        count = len(self.found)
        try:
            yield
        except (KeyboardInterrupt, OSError) as error:
            known = count - self.todo.sum() - sum(map(len, self._unsaved))
            saved = f"{known} of {count} distinct points are saved beside {self.path}"
            if isinstance(error, KeyboardInterrupt):
                raise Stopped(f"stopped; {saved}; the same command continues from there") from None
            kind = WorkerError if isinstance(error, WorkerError) else OSError
            advice = "once that is fixed, the same command continues from there"
            raise kind(f"{error.strerror or error}; {saved}; {advice}") from error


def not_in(points: Distinct, asked: Request, known: Found) -> Found:
    """All that is known of points that are not among these, or of more quantities than are asked."""
    if not len(known):
        return known
    own = Found.blank(points.rows)
    elsewhere = look_up(known["row"], own, np.ones(len(own), bool)) < 0
    elsewhere |= known.of_runs((not {*run.quantities} <= {*asked.items} for run in known.runs), False)
    others = known.take(elsewhere & (known["status"] != MISSING))
    # A kill may have left a value in two places.
    first, _ = group_rows(others["row"], others["run"])
    return others.take(np.sort(first))


#: Seconds that timing points may take, since a plan is quick, and groups of chunks that are timed.
_BUDGET, _TIMED = 4.0, 16
#: A loop of more vertices is timed by one with some of its own, no more than so many.
_VERTICES = 200


def estimate(work: Work) -> tuple[float, int, int]:
    """Estimate the time of what is left from some points that are solved.

    Chunks are timed at even distances of the list of all, which is sorted by the length of their cycles; each
    stands for its neighbours.

    Returns
    -------
    seconds
        Computing time.
    timed
        Number of points that have been timed.
    parts
        Number of chunks, which workers share.
    """
    lean, growth = dict(work.points.definitions), dict[int, float]()
    for code, loop in work.points.definitions.items():
        if isinstance(loop, LoadPath) and len(loop.vertices) > _VERTICES:
            lean[code] = thin = loop.thinned(_VERTICES)
            # As k log k: results/vertices.md.
            many, few = len(loop.vertices), len(thin.vertices)
            growth[code] = many * np.log(many) / (few * np.log(few))
    points, asked = replace(work.points, definitions=lean), work.study.asked
    todo, rtol = cut(points, work.todo, asked), work.study.rtol
    if not todo:
        return 0.0, 0, 0

    def timed(places: IndexArray) -> float:
        """Time for each of some points."""
        return float(solve_chunk(*task_of(points, places, asked), rtol)[1]["seconds"].mean())

    timed(todo[-1][:1])  # imports, and compiles
    groups = np.array_split(np.arange(len(todo)), min(_TIMED, len(todo)))
    begin, seconds, count, counted = time.perf_counter(), 0.0, 0, 0
    # The middle groups first: if time is up, the timed groups stand for all.
    for group in sorted(groups, key=lambda each: abs(int(each[0]) - len(todo) // 2)):
        places = todo[group[len(group) // 2]]
        left = _BUDGET - (time.perf_counter() - begin)
        if count and left < 0.0:
            break
        one, own = timed(places[:1]), 1
        if len(places) * one < left / len(groups):
            one, own = timed(places), len(places)
        of_group = sum(len(todo[k]) for k in group)
        seconds += growth.get(int(points.rows["load"][places[0]]), 1.0) * one * of_group
        count, counted = count + own, counted + of_group
    return seconds * sum(map(len, todo)) / counted, count, len(todo)
