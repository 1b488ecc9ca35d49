"""Engines: what carries chunks to workers and results back."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from concurrent.futures.process import BrokenProcessPool
from types import TracebackType
from typing import Any, Protocol

from swtstudy.runner.chunk import Chunk, Result, Solver, solve_chunk
from swtstudy.runner.workers import start_workers

#: Takes every result as soon as it is there.
Deliver = Callable[[Result], None]

#: Chunks a worker is given at once; the others wait at the end of such a wave for the last one.
_WAVE = 16

#: Times that a chunk may lose its worker before it is given up.
_ATTEMPTS = 3


class Engine(Protocol):
    """What a run needs of an engine."""

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """Solve all chunks, in any order; return when every result is delivered."""


class Here:
    """Solves in this process."""

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """See `Engine`."""
        for chunk in chunks:
            deliver(solve_chunk(chunk, rtol, solver))


class LocalWorkers:
    """Solves in worker processes of this machine, through dask.

    Use as a context manager: the workers start with it and end with it.

    Parameters
    ----------
    count
        Number of worker processes.
    """

    def __init__(self, count: int = 2) -> None:
        self.count = count
        self._pool = start_workers(count)

    def __enter__(self) -> LocalWorkers:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._pool.shutdown(wait=kind is None, cancel_futures=True)

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """See `Engine`; a lost worker is replaced and what it had in hand is given out again."""
        waiting = iter(chunks)
        while wave := list(itertools.islice(waiting, _WAVE * self.count)):
            for attempt in range(_ATTEMPTS):
                missing = {chunk.start: chunk for chunk in wave}

                def received(result: Result, missing: dict[int, Chunk] = missing) -> None:
                    del missing[result.start]
                    deliver(result)

                try:
                    self._solve_wave(wave, rtol, solver, received)
                    break
                except BrokenProcessPool:
                    if attempt == _ATTEMPTS - 1:
                        raise
                    self._pool.shutdown(wait=False, cancel_futures=True)
                    self._pool = start_workers(self.count)
                    wave = list(missing.values())

    def _solve_wave(self, wave: list[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        import dask
        from dask.callbacks import Callback

        tasks = [
            dask.delayed(solve_chunk, pure=False, traverse=False)(
                chunk, rtol, solver, dask_key_name=f"chunk-{chunk.start}"
            )
            for chunk in wave
        ]

        def done(_key: str, result: Any, _graph: Any, _state: Any, _worker: Any) -> None:
            if isinstance(result, Result):
                deliver(result)

        with Callback(posttask=done):
            dask.compute(*tasks, scheduler="processes", pool=self._pool, chunksize=1, optimize_graph=False)
