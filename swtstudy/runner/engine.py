"""The engine: one loop that hands chunks to workers, of whatever kind, and collects the results."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future
from itertools import chain, islice
from queue import Empty, SimpleQueue
from typing import Any

from swtstudy.points.chunk import Arrays, Chunk, Solver, blank, solve_chunk
from swtstudy.runner.workers import Workers
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.variables import FAILED
from swtstudy.vocabulary.version import SOLVER_VERSION

#: Receives places and values of every chunk as soon as they arrive.
Deliver = Callable[[IndexArray, Arrays], None]

#: Tasks in flight per worker: with two, no worker waits for the parent, and few are lost with a worker.
IN_FLIGHT = 2
#: Seconds after which the main thread looks for signals, where waiting does not end with them.
_LOOK = 1.0

LOST_WORKER = "the worker process died while it computed this point"


class WorkerError(OSError):
    """Workers that cannot do the work: they are gone, of another version, or lack the package."""


def solve(chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver, workers: Workers) -> None:
    """Solve all chunks, in any order; return when every result has been delivered.

    The points of chunks that were in flight when a worker died are solved again one by one, so that a point
    that kills workers fails alone.

    Parameters
    ----------
    chunks
        Consumed as they are needed.
    rtol, solver
        As in `run`.
    deliver
        Called with every result.
    workers
        The workers.

    Raises
    ------
    WorkerError
        If a worker cannot even begin to solve.
    """

    waiting = iter(chunks)
    while lost := _until_loss(waiting, rtol, solver, deliver, workers):
        for one in chain.from_iterable(chunk.singly() for chunk in lost):
            if _until_loss(iter([one]), rtol, solver, deliver, workers):
                deliver(one.places, blank(1, FAILED, LOST_WORKER))


def _until_loss(
    waiting: Iterator[Chunk], rtol: float, solver: Solver, deliver: Deliver, workers: Workers
) -> list[Chunk]:
    """Solve chunks until there are no more, or a worker dies; return the chunks lost in flight."""
    in_flight: dict[Future[Any], Chunk] = {}
    # Not by `concurrent.futures.wait`, which Ctrl-C may leave with futures locked.
    done: SimpleQueue[Future[Any]] = SimpleQueue()
    while True:
        for chunk in islice(waiting, max(0, IN_FLIGHT * workers.size - len(in_flight))):
            future = workers.submit(solve_chunk, chunk, rtol, solver)
            in_flight[future] = chunk
            future.add_done_callback(done.put)
        if not in_flight:
            return []
        try:
            future = done.get(timeout=_LOOK)
            version, arrays = future.result()
        except Empty:
            continue
        except workers.lost:
            workers.renew()
            return [*in_flight.values()]
        except workers.gone as error:
            raise WorkerError("the dask scheduler is gone") from error
        except Exception as error:  # outside of the solver, such as while it is imported
            words = f"a worker cannot solve anything ({type(error).__name__}: {error})"
            raise WorkerError(words) from error
        if version != SOLVER_VERSION:
            words = f"a worker has version {version} of the solver"
            raise WorkerError(f"{words}, this machine {SOLVER_VERSION}")
        deliver(in_flight.pop(future).places, arrays)
