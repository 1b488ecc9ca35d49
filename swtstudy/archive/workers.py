"""Workers: threads of this process, local processes with one BLAS thread each, or those of a dask cluster."""

from __future__ import annotations

import asyncio
import logging
import multiprocessing
import os
import pickle
import signal
import sys
import threading
import types
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from importlib import import_module
from itertools import islice
from queue import Empty, SimpleQueue
from typing import TYPE_CHECKING, Any, Self

import cloudpickle
import numpy as np

from swtstudy.points.chunk import Arrays, blank, solve_chunk
from swtstudy.vocabulary.arrays import IndexArray
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.quantities import FAILED
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    from distributed import Client

_log = logging.getLogger(__name__)

#: Two workers with two BLAS threads each would fight for two cores.
THREADS = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
#: Seconds between two checks that a cluster has workers: the user who has just started a run still looks.
CHECK_SECONDS = 5.0
#: Tasks in flight per worker: with two, no worker waits for the parent, and few are lost with a worker.
IN_FLIGHT = 2
#: Signals that stop a run.
_STOPS = (signal.SIGINT, signal.SIGTERM)
#: Seconds after which the main thread looks for signals, where waiting does not end with them.
_LOOK = 1.0

LOST_WORKER = "the worker process died while it computed this point"

#: Places and values of a chunk.
Solved = tuple[IndexArray, Arrays]
#: Gives the arguments of `swtstudy.points.chunk.solve_chunk` for the places of a chunk.
ArgumentsOf = Callable[[IndexArray], tuple[Any, ...]]


class WorkerError(OSError):
    """Workers that cannot do the work: they are gone, of another version, or lack the package."""


@contextmanager
def without_signals() -> Iterator[None]:
    """Signals that arrive in the block are handled at its end.

    A handler that raises in the midst of a submission leaves a lock of the executor closed. The process waits
    for that lock when it ends, so it would never end.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    raising = {each: handler for each in _STOPS if callable(handler := signal.getsignal(each))}
    for each in raising:
        signal.signal(each, lambda number, _: came.append(number))
    try:
        yield
    finally:
        for each, handler in raising.items():
            signal.signal(each, handler)
        for number in came[:1]:
            signal.raise_signal(number)


class _Task:
    """A task for another process: to unpickle it is to do it.

    So a worker that lacks what the task needs reports that as the error of the task.
    """

    def __init__(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
        self._parts = function, arguments

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        return self._parts


class Workers:
    """Threads of this process, which the compiled solver lets run side by side; the base of other kinds.

    Used in a with block.

    Parameters
    ----------
    count
        Number of tasks that run at the same time.
    start
        Starts an executor for so many tasks.

    Attributes
    ----------
    size
        Number of tasks that run at the same time.
    lost, gone
        The errors of tasks that were lost with a worker, and of tasks for which all workers are lost.
    apart
        Whether tasks are done in other processes.
    """

    lost: tuple[type[BaseException], ...] = ()
    gone: tuple[type[BaseException], ...] = ()
    apart = False
    _executor: Any = None
    _at_shutdown: Mapping[str, bool] = {"cancel_futures": True}

    def __init__(self, count: int, start: Callable[[int], Any] = ThreadPoolExecutor) -> None:
        self.size, self._start = count, start

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self.renew(wait=True)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """As in `concurrent.futures.Executor`; the first task starts the workers."""
        if self.apart:
            function, arguments = pickle.loads, (cloudpickle.dumps(_Task(function, arguments)),)
        try:
            self._executor = self._executor or self._start(self.size)
            return self._executor.submit(function, *arguments)
        except self.lost as error:
            lost: Future[Any] = Future()
            lost.set_exception(error)
            return lost

    def renew(self, wait: bool = False) -> None:
        """Drop all tasks; new workers start with the next one."""
        executor, self._executor = self._executor, None
        if executor is not None:
            executor.shutdown(wait=wait, **self._at_shutdown)

    def solve(self, chunks: Iterable[IndexArray], arguments_of: ArgumentsOf) -> Iterator[Solved]:
        """Yield the places and the values of all chunks, in any order.

        The points of chunks that were in flight when a worker died are solved again one by one, so that a
        point that kills workers fails alone.

        Parameters
        ----------
        chunks
            Places of points that are solved in one call.
        arguments_of
            Gives the arguments of `swtstudy.points.chunk.solve_chunk` for some places.

        Raises
        ------
        WorkerError
            If a worker cannot even begin to solve.
        """
        waiting = iter(chunks)
        while lost := (yield from self._until_loss(waiting, arguments_of)):
            for place in (place for chunk in lost for place in np.split(chunk, len(chunk))):
                if (yield from self._until_loss(iter([place]), arguments_of)):
                    yield place, blank(1, FAILED, LOST_WORKER)

    def _until_loss(
        self, waiting: Iterator[IndexArray], arguments_of: ArgumentsOf
    ) -> Generator[Solved, None, list[IndexArray]]:
        """Solve chunks until there are no more, or a worker dies; return the chunks lost in flight."""
        in_flight: dict[Future[Any], IndexArray] = {}
        # Not by `concurrent.futures.wait`, which Ctrl-C may leave with futures locked.
        done: SimpleQueue[Future[Any]] = SimpleQueue()
        while True:
            for chunk in islice(waiting, max(0, IN_FLIGHT * self.size - len(in_flight))):
                with without_signals():
                    future = self.submit(solve_chunk, *arguments_of(chunk))
                    in_flight[future] = chunk
                    future.add_done_callback(done.put)
            if not in_flight:
                return []
            try:
                future = done.get(timeout=_LOOK)
                version, arrays = future.result()
            except Empty:
                continue
            except self.lost:
                self.renew()
                return [*in_flight.values()]
            except self.gone as error:
                raise WorkerError("the dask scheduler is gone") from error
            except Exception as error:  # outside of the solver, such as while it is imported
                words = f"a worker cannot solve anything ({type(error).__name__}: {error})"
                raise WorkerError(words) from error
            if version != SOLVER_VERSION:
                words = f"a worker has version {version} of the solver, this machine {SOLVER_VERSION}"
                raise WorkerError(words)
            yield in_flight.pop(future), arrays


class LocalPool(Workers):
    """Worker processes on this machine, which start with the first task."""

    lost, apart = (BrokenProcessPool,), True

    def __init__(self, count: int) -> None:
        super().__init__(count, start_workers)

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        # Tasks in flight are lost anyway, and a second Ctrl-C must not find us waiting for them.
        for process in list((getattr(self._executor, "_processes", None) or {}).values()) if kind else ():
            process.kill()
        # An interpreter that exits meanwhile may print an error.
        self.renew(wait=kind is None)


class ClusterPool(Workers):
    """The workers of a dask.distributed cluster, which may come and go; its client stays open.

    dask itself reassigns the tasks of a lost worker; only a task that has killed several workers is lost.
    """

    apart = True
    _at_shutdown: Mapping[str, bool] = {}  # this executor knows no cancelling

    def __init__(self, client: Client) -> None:
        from distributed import Client
        from distributed.comm import CommClosedError
        from distributed.scheduler import KilledWorker

        if not isinstance(client, Client):
            raise refused("client", literal(client), "a Client of dask.distributed")
        count = max(1, sum(client.nthreads().values()))
        super().__init__(count, lambda _: client.get_executor(pure=False))
        self._client, self._ended = client, threading.Event()
        self.lost, self.gone = (KilledWorker,), (CancelledError, CommClosedError)

    def __enter__(self) -> Self:
        threading.Thread(target=self._watch, daemon=True).start()
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._ended.set()
        if kind is None or not issubclass(kind, OSError):  # without a scheduler there is nothing to end
            self.renew()

    def _watch(self) -> None:
        """Count the workers; warn when there are none: dask waits for them silently."""
        warned = False
        while not self._ended.wait(CHECK_SECONDS):
            try:
                present = sum(self._client.nthreads().values())
            except (Exception, asyncio.CancelledError):  # the scheduler is gone: the run will notice
                return
            if not present and not warned:
                _log.warning("the cluster has no workers; waiting for some")
            warned, self.size = not present, max(1, present)


def start_workers(count: int) -> ProcessPoolExecutor:
    """Start `count` worker processes; the caller has to shut the pool down.

    They start with the environment of workers and without the calling script. Spawned processes import that
    script before any initializer can run: without ``if __name__ == "__main__"`` it would start its run again
    in every worker.
    """
    # Spawned, not forked: forking a process with threads, such as a notebook's, can hang.
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_prepare)
    before = {name: os.environ.get(name) for name in THREADS}
    main = sys.modules["__main__"]
    os.environ.update(THREADS)
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        # A submission that finds no idle worker starts one: these start them all, in this block.
        for _ in range(count):
            pool.submit(import_module, "swtstudy.kernel.batch")
        return pool
    finally:
        sys.modules["__main__"] = main
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.update({name: value})


def _prepare() -> None:
    """Prepare a worker process for its end, which its parent decides."""
    # Ctrl-C reaches the whole process group.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # A worker whose parent was killed would otherwise wait for work forever.
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if (parent := multiprocessing.parent_process()) is not None:
        parent.join()
        os._exit(1)
