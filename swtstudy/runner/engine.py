"""The engine: dask's scheduler hands chunks to threads, processes or a cluster, and collects the results."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, NoReturn, Protocol

from swtstudy.points.chunk import Chunk, Solver, solve_chunk
from swtstudy.points.found import Found
from swtstudy.vocabulary.arrays import IntArray
from swtstudy.vocabulary.variables import FAILED
from swtstudy.vocabulary.version import SOLVER_VERSION

#: Receives places, version of the solver and values of every chunk as soon as they arrive.
Deliver = Callable[[IntArray, str, Found], None]

#: Chunks per worker that dask receives at a time: it holds on to their results.
_WAVE = 256

#: Tasks in flight per worker: with two, no worker waits for the parent, and few are lost with a worker.
_IN_FLIGHT = 2

LOST_WORKER = "the worker process died while it computed this point"


class WorkerError(OSError):
    """Workers that cannot do the work: they are gone, of another version, or lack the package."""


class NeverLostError(Exception):
    """The loss of a thread, which cannot be lost without the process."""


class Pool(Protocol):
    """Workers, as the engine needs them."""

    @property
    def lost(self) -> type[Exception]:
        """Exception that a future raises if its task was lost with a worker."""

    @property
    def gone(self) -> tuple[type[Exception], ...]:
        """Exceptions that say that all workers are lost."""

    def size(self) -> int:
        """Number of tasks that run at the same time, at least 1."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """As in `concurrent.futures.Executor`."""

    def renew(self) -> None:
        """Drop all submitted tasks, and be ready for new ones after a loss."""


class ThreadPool(ThreadPoolExecutor):
    """Threads of this process; see `Pool`. The compiled solver lets them run side by side."""

    lost, gone = NeverLostError, ()

    def __exit__(self, *_: object) -> None:
        self.shutdown(wait=True, cancel_futures=True)

    def size(self) -> int:
        """See `Pool`."""
        return self._max_workers

    def renew(self) -> None:
        """See `Pool`."""


def solve(chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver, pool: Pool) -> None:
    """Solve all chunks, in any order; return when every result has been delivered.

    Chunks that were in flight when a worker died are solved again, one after the other, and split until the
    point that kills workers is found, if there is one.

    Parameters
    ----------
    chunks
        Consumed as they are needed.
    rtol, solver
        As in `run`.
    deliver
        Called with every result.
    pool
        The workers.

    Raises
    ------
    WorkerError
        If a worker cannot even begin to solve.
    """
    tasks, waiting = _Tasks(rtol, solver, deliver, pool), iter(chunks)
    while wave := list(itertools.islice(waiting, _WAVE * pool.size())):
        while wave:
            wave, lost = tasks.attempt(wave)
            for chunk in lost:
                tasks.alone(chunk)


@dataclass(frozen=True)
class _Tasks:
    """Solves lists of chunks; the parameters are those of `solve`."""

    rtol: float
    solver: Solver
    deliver: Deliver
    pool: Pool

    def alone(self, chunk: Chunk) -> None:
        """Solve one chunk with nothing beside it; split it until the point that kills is found."""
        _, lost = self.attempt([chunk])
        if not lost:
            return
        if len(chunk) == 1:
            self.deliver(chunk.places, SOLVER_VERSION, Found.blank(chunk.rows, FAILED, LOST_WORKER))
            return
        for half in chunk.halves():
            self.alone(half)

    def attempt(self, wave: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
        """Solve chunks until a worker dies; return those not yet submitted, and those lost in flight."""
        # Called directly: dask.compute would import all of distributed where that is installed.
        import cloudpickle
        from dask.local import get_async
        from dask.multiprocessing import pack_exception

        # Of tasks that need no others dask takes that with the last name first.
        waiting = {f"points-{number:06d}": chunk for number, chunk in enumerate(reversed(wave))}
        in_flight: dict[str, Chunk] = {}
        graph = {name: (solve_chunk, chunk, self.rtol, self.solver) for name, chunk in waiting.items()}

        def submitted(name: str, *_: object) -> None:
            in_flight[name] = waiting.pop(name)

        def done(name: str, found: tuple[str, Found], *_: object) -> None:
            self.deliver(in_flight[name].places, *found)
            del in_flight[name]

        in_threads = isinstance(self.pool, ThreadPool)
        try:
            get_async(
                self.pool.submit,
                _IN_FLIGHT * self.pool.size(),
                graph,
                list(graph),
                callbacks=[(None, None, submitted, done, None)],
                # Unpickled where a failure is reported back: a worker may lack this package.
                **({} if in_threads else {"dumps": cloudpickle.dumps, "loads": cloudpickle.loads}),
                pack_exception=pack_exception,
                raise_exception=_unable,
                chunksize=1,
            )
        except self.pool.lost:
            self.pool.renew()
        except self.pool.gone as error:
            raise WorkerError("the dask scheduler is gone") from error
        return list(waiting.values()), list(in_flight.values())


def _unable(error: BaseException, _: object) -> NoReturn:
    """Raise what a worker raised outside of the solver, such as while importing it."""
    if isinstance(error, KeyboardInterrupt):
        raise error
    raise WorkerError(f"a worker cannot solve anything ({type(error).__name__}: {error})") from error
