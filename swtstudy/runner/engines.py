"""Engines: what carries chunks to workers and results back."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from types import TracebackType
from typing import Any, Protocol

from swtstudy.records.result import Result
from swtstudy.runner.chunk import Chunk, Solver, given_up, solve_chunk
from swtstudy.runner.workers import kill_workers, start_workers

#: Takes every result as soon as it is there.
Deliver = Callable[[Result], None]

#: Chunks for each worker in the waves in which dask is given its tasks; the last number is for all later
#: waves. A wave ends with workers waiting for the last one; the first are short, to cut later chunks by
#: their timing.
_WAVES = (1, 8, 128)

LOST_WORKER = "the worker process died while it computed this point"


class Engine(Protocol):
    """What a run needs of an engine; the engine is ready inside a with block."""

    def __enter__(self) -> Engine: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """Solve all chunks, in any order; return when every result is delivered."""


class Here:
    """Solves in this process."""

    def __enter__(self) -> Here:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """See `Engine`."""
        for chunk in chunks:
            deliver(solve_chunk(chunk, rtol, solver))


class _TwiceAsWide:
    """A pool to which dask gives twice as many tasks as it has workers: none waits for the parent."""

    def __init__(self, pool: ProcessPoolExecutor, count: int) -> None:
        self._max_workers = 2 * count
        self.submit = pool.submit


class LocalWorkers:
    """Solves in worker processes of this machine, through dask.

    Parameters
    ----------
    count
        Number of worker processes.
    """

    def __init__(self, count: int = 2) -> None:
        self.count = count

    def __enter__(self) -> LocalWorkers:
        self._pool = start_workers(self.count)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None:
            # What they have in hand is lost anyway, and a second Ctrl-C must not find us waiting for it.
            kill_workers(self._pool)
        # Workers end while the archive is written.
        self._pool.shutdown(wait=False, cancel_futures=True)

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """See `Engine`; a lost worker is replaced, and what it had in hand is given out again."""
        waiting = iter(chunks)
        lengths = itertools.chain(_WAVES, itertools.repeat(_WAVES[-1]))
        while wave := list(itertools.islice(waiting, next(lengths) * self.count)):
            lost = self._attempt(wave, rtol, solver, deliver)
            if lost:
                lost = self._attempt(lost, rtol, solver, deliver)
            # Lost twice: one of them may be what kills workers.
            for chunk in lost:
                self._alone(chunk, rtol, solver, deliver)

    def _alone(self, chunk: Chunk, rtol: float, solver: Solver, deliver: Deliver) -> None:
        """Solve one chunk with nothing beside it; cut it up until the point that kills is found."""
        if not self._attempt([chunk], rtol, solver, deliver):
            return
        if len(chunk) == 1:
            deliver(given_up(chunk, LOST_WORKER))
            return
        for part in chunk.split():
            self._alone(part, rtol, solver, deliver)

    def _attempt(self, wave: list[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> list[Chunk]:
        """Solve chunks; those that were lost with a worker are returned."""
        # The scheduler itself: dask.compute would import all of distributed, where that is installed.
        from dask.callbacks import Callback
        from dask.multiprocessing import get

        missing = {chunk.name: chunk for chunk in wave}
        graph = {name: (solve_chunk, chunk, rtol, solver) for name, chunk in missing.items()}

        def done(key: str, result: Any, *_: object) -> None:
            if key in missing:
                deliver(result)
                del missing[key]

        pool = _TwiceAsWide(self._pool, self.count)
        try:
            with Callback(posttask=done):
                get(graph, list(graph), pool=pool, chunksize=1, optimize_graph=False)
        except BrokenProcessPool:
            self._pool.shutdown(wait=False, cancel_futures=True)
            self._pool = start_workers(self.count)
        return list(missing.values())
