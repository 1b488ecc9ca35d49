"""The engine: dask's scheduler gives chunks to the workers of a pool, and takes results back."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, NoReturn, Protocol

from swtstudy.records.result import Result
from swtstudy.runner.chunk import Chunk, Solver, given_up, solve_chunk

#: Takes every result as soon as it is there.
Deliver = Callable[[Result], None]

#: Chunks for each worker in the waves in which dask is given its tasks; the last number is for all later
#: waves. A wave ends with workers waiting for the last one; the first are short, to cut later chunks by
#: their timing.
_WAVES = (1, 8, 128)

#: Tasks on their way for every worker: with two none waits for the parent, and few are lost with a worker.
_AHEAD = 2

LOST_WORKER = "the worker process died while it computed this point"


class WorkerError(OSError):
    """Workers that cannot do the work: gone, of another version, or without the package."""


class Pool(Protocol):
    """Workers, as the engine needs them."""

    @property
    def lost(self) -> type[Exception]:
        """What a future raises if its task was lost with a worker."""

    def size(self) -> int:
        """Number of tasks that are solved at the same time, at least 1."""

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """As in `concurrent.futures.Executor`."""

    def renew(self) -> None:
        """Forget what was submitted and, after a loss, be ready for more."""


def solve(
    chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver, pool: Pool | None = None
) -> None:
    """Solve all chunks, in any order; return when every result is delivered.

    What was in hand when a worker died is solved again, one chunk after the other, and cut up until the
    point is found that kills workers, if there is one.

    Parameters
    ----------
    chunks
        Taken when they are needed.
    rtol, solver
        As in `run`.
    deliver
        Told about every result.
    pool
        The workers; without, this process solves.

    Raises
    ------
    WorkerError
        If a worker cannot even begin to solve.
    """
    if pool is None:
        for chunk in chunks:
            deliver(solve_chunk(chunk, rtol, solver))
        return
    waves = _Waves(rtol, solver, deliver, pool)
    waiting = iter(chunks)
    lengths = itertools.chain(_WAVES, itertools.repeat(_WAVES[-1]))
    while wave := list(itertools.islice(waiting, next(lengths) * pool.size())):
        waves.solve(wave)


@dataclass(frozen=True)
class _Waves:
    """Solves chunks that are all there; the parameters are those of `solve`."""

    rtol: float
    solver: Solver
    deliver: Deliver
    pool: Pool

    def solve(self, wave: list[Chunk]) -> None:
        """Solve all of them."""
        while wave:
            wave, lost = self._attempt(wave)
            for chunk in lost:
                self._alone(chunk)

    def _alone(self, chunk: Chunk) -> None:
        """Solve one chunk with nothing beside it; cut it up until the point that kills is found."""
        _, lost = self._attempt([chunk])
        if not lost:
            return
        if len(chunk) == 1:
            self.deliver(given_up(chunk, LOST_WORKER))
            return
        for part in chunk.split():
            self._alone(part)

    def _attempt(self, wave: list[Chunk]) -> tuple[list[Chunk], list[Chunk]]:
        """Solve chunks until a worker dies; what was not begun then, and what was in hand."""
        # The scheduler itself: dask.compute would import all of distributed, where that is installed.
        import cloudpickle
        from dask.local import get_async
        from dask.multiprocessing import pack_exception

        waiting = {chunk.name: chunk for chunk in wave}
        in_hand: dict[str, Chunk] = {}
        graph = {name: (solve_chunk, chunk, self.rtol, self.solver) for name, chunk in waiting.items()}

        def begun(name: str, *_: object) -> None:
            in_hand[name] = waiting.pop(name)

        def done(name: str, result: Result, *_: object) -> None:
            self.deliver(result)
            del in_hand[name]

        try:
            get_async(
                self.pool.submit,
                _AHEAD * self.pool.size(),
                graph,
                list(graph),
                callbacks=[(None, None, begun, done, None)],
                # Unpacked where its failure is told back: a worker may not have this package.
                dumps=cloudpickle.dumps,
                loads=cloudpickle.loads,
                pack_exception=pack_exception,
                raise_exception=_unable,
                chunksize=1,
            )
        except self.pool.lost:
            self.pool.renew()
        return list(waiting.values()), list(in_hand.values())


def _unable(error: BaseException, _: object) -> NoReturn:
    """What a worker raised outside of the solver, such as while it imported it."""
    raise WorkerError(f"a worker cannot solve anything ({type(error).__name__}: {error})") from error
