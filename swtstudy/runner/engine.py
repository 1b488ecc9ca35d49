"""The engine: dask's scheduler hands chunks to the workers of a pool and collects the results."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, NoReturn, Protocol

from swtstudy.mechanics.points import IntArray
from swtstudy.points.records import Records
from swtstudy.runner.chunk import Chunk, Solver, given_up, solve_chunk

#: Receives every result as soon as it arrives.
Deliver = Callable[[IntArray, Records], None]

#: Chunks per worker in the successive waves of tasks that dask receives; the last number holds for all later
#: waves. Each wave ends with idle workers; the first ones are short, so that later chunks are cut by their
#: timing.
_WAVES = (1, 8, 128)

#: Tasks in flight per worker: with two, no worker waits for the parent, and few are lost with a worker.
_IN_FLIGHT = 2

LOST_WORKER = "the worker process died while it computed this point"


class WorkerError(OSError):
    """Workers that cannot do the work: they are gone, of another version, or lack the package."""


class Pool(Protocol):
    """Workers, as the engine needs them."""

    @property
    def lost(self) -> type[Exception]:
        """Exception that a future raises if its task was lost with a worker."""

    def size(self) -> int:
        """Number of tasks that run at the same time, at least 1."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """As in `concurrent.futures.Executor`."""

    def renew(self) -> None:
        """Drop all submitted tasks, and be ready for new ones after a loss."""


def solve(
    chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver, pool: Pool | None = None
) -> None:
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
        The workers; without them, this process solves.

    Raises
    ------
    WorkerError
        If a worker cannot even begin to solve.
    """
    if pool is None:
        for chunk in chunks:
            deliver(chunk.rows, solve_chunk(chunk, rtol, solver))
        return
    waves = _Waves(rtol, solver, deliver, pool)
    waiting = iter(chunks)
    lengths = itertools.chain(_WAVES, itertools.repeat(_WAVES[-1]))
    while wave := list(itertools.islice(waiting, next(lengths) * pool.size())):
        waves.solve(wave)


@dataclass(frozen=True)
class _Waves:
    """Solves a list of chunks; the parameters are those of `solve`."""

    rtol: float
    solver: Solver
    deliver: Deliver
    pool: Pool

    def solve(self, wave: list[Chunk]) -> None:
        """Solve all chunks of a wave."""
        while wave:
            wave, lost = self._attempt(wave)
            for chunk in lost:
                self._alone(chunk)

    def _alone(self, chunk: Chunk) -> None:
        """Solve one chunk with nothing beside it; split it until the point that kills is found."""
        _, lost = self._attempt([chunk])
        if not lost:
            return
        if len(chunk) == 1:
            self.deliver(chunk.rows, given_up(chunk, self.rtol, LOST_WORKER))
            return
        for part in chunk.split():
            self._alone(part)

    def _attempt(self, wave: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
        """Solve chunks until a worker dies; return those not yet submitted, and those lost in flight."""
        # Called directly: dask.compute would import all of distributed where that is installed.
        import cloudpickle
        from dask.local import get_async
        from dask.multiprocessing import pack_exception

        waiting = {chunk.name: chunk for chunk in wave}
        in_flight: dict[str, Chunk] = {}
        graph = {name: (solve_chunk, chunk, self.rtol, self.solver) for name, chunk in waiting.items()}

        def submitted(name: str, *_: object) -> None:
            in_flight[name] = waiting.pop(name)

        def done(name: str, found: Records, *_: object) -> None:
            self.deliver(in_flight[name].rows, found)
            del in_flight[name]

        try:
            get_async(
                self.pool.submit,
                _IN_FLIGHT * self.pool.size(),
                graph,
                list(graph),
                callbacks=[(None, None, submitted, done, None)],
                # Unpickled where a failure is reported back: a worker may lack this package.
                dumps=cloudpickle.dumps,
                loads=cloudpickle.loads,
                pack_exception=pack_exception,
                raise_exception=_unable,
                chunksize=1,
            )
        except self.pool.lost:
            self.pool.renew()
        return list(waiting.values()), list(in_flight.values())


def _unable(error: BaseException, _: object) -> NoReturn:
    """Raise what a worker raised outside of the solver, such as while importing it."""
    raise WorkerError(f"a worker cannot solve anything ({type(error).__name__}: {error})") from error
