"""The engine for a dask.distributed cluster (extra "distributed")."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from swtstudy.runner.chunk import Chunk, Solver, given_up, solve_chunk
from swtstudy.runner.engines import LOST_WORKER, Deliver

if TYPE_CHECKING:
    from distributed import Client, Future

#: Chunks on their way for every thread of the cluster: enough that none waits, few to lose.
_AHEAD = 3


class Cluster:
    """Solves on the workers of a dask.distributed cluster, also if they come and go.

    Parameters
    ----------
    client
        Connected to the cluster; remains open.
    """

    def __init__(self, client: Client) -> None:
        self._client = client

    def __enter__(self) -> Cluster:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def solve(self, chunks: Iterable[Chunk], rtol: float, solver: Solver, deliver: Deliver) -> None:
        """See `Engine`; dask gives out again what a lost worker had in hand."""
        from distributed import as_completed
        from distributed.scheduler import KilledWorker

        waiting = iter(chunks)
        pending: dict[Future, Chunk] = {}
        completed = as_completed()

        def submit(chunk: Chunk) -> None:
            future = self._client.submit(solve_chunk, chunk, rtol, solver, pure=False)
            pending[future] = chunk
            completed.add(future)

        def top_up() -> None:
            while len(pending) < _AHEAD * max(1, sum(self._client.nthreads().values())):
                chunk = next(waiting, None)
                if chunk is None:
                    return
                submit(chunk)

        try:
            top_up()
            for future in completed:
                chunk = pending.pop(future)
                try:
                    deliver(future.result())
                except KilledWorker:
                    # It outlived several workers: one of its points may be what kills them.
                    if len(chunk) == 1:
                        deliver(given_up(chunk, LOST_WORKER))
                    else:
                        for part in chunk.split():
                            submit(part)
                top_up()
        finally:
            self._client.cancel(list(pending))
