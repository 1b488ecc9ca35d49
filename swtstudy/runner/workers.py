"""Workers: threads of this process, local processes with one BLAS thread each, or workers of a dask cluster.

Each kind is used in a with block. It has ``submit`` as an executor has; ``size``, the number of tasks that
run at the same time; ``lost``, the exceptions of tasks that a worker lost; ``gone``, errors that say
that all workers are lost; and ``renew``, which drops all tasks after a loss.
"""

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
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import cloudpickle

if TYPE_CHECKING:
    from distributed import Client

_log = logging.getLogger(__name__)

#: Two workers with two BLAS threads each would fight for two cores.
THREADS = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
#: Seconds between two checks that a cluster has workers: the user who has just started a run still looks.
CHECK_SECONDS = 5.0

Errors = tuple[type[BaseException], ...]


def workers_of(count: int, processes: bool, client: Client | None) -> Workers:
    """Workers of a run: a cluster's workers, if there is a client of one."""
    if client is not None:
        return ClusterPool(client)
    return LocalPool(count) if processes else Workers(count)


class _Task:
    """A task for another process: to unpickle it is to do it.

    So a worker that lacks what the task needs reports that as the error of the task.
    """

    def __init__(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
        self._parts = function, arguments

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        return self._parts


class Workers:
    """Threads of this process, which the compiled solver lets run side by side; the base of other kinds."""

    lost: Errors = ()
    gone: Errors = ()
    _executor: Any = None

    def __init__(self, count: int) -> None:
        self.size = count

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self.renew(wait=True)

    def _start(self) -> Any:
        """Start an executor."""
        return ThreadPoolExecutor(self.size)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """As in `concurrent.futures.Executor`; the first task starts the workers."""
        self._executor = self._executor or self._start()
        return self._executor.submit(function, *arguments)

    def renew(self, wait: bool = False) -> None:
        """Drop all tasks; new workers start with the next one."""
        executor, self._executor = self._executor, None
        if executor is not None:
            executor.shutdown(wait, cancel_futures=True)


class LocalPool(Workers):
    """Worker processes on this machine, which start with the first task."""

    lost = (BrokenProcessPool,)

    def _start(self) -> ProcessPoolExecutor:
        return start_workers(self.size)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """See `Workers`."""
        try:
            return super().submit(pickle.loads, cloudpickle.dumps(_Task(function, arguments)))
        except BrokenProcessPool as error:
            lost: Future[Any] = Future()
            lost.set_exception(error)
            return lost

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

    def __init__(self, client: Client) -> None:
        from distributed.comm import CommClosedError
        from distributed.scheduler import KilledWorker

        super().__init__(max(1, sum(client.nthreads().values())))
        self._client, self._ended = client, threading.Event()
        self.lost, self.gone = (KilledWorker,), (CancelledError, CommClosedError)

    def _start(self) -> Any:
        return self._client.get_executor(pure=False)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """See `Workers`."""
        return super().submit(pickle.loads, cloudpickle.dumps(_Task(function, arguments)))

    def __enter__(self) -> Workers:
        threading.Thread(target=self._watch, daemon=True).start()
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._ended.set()
        if kind is None or not issubclass(kind, OSError):  # without a scheduler there is nothing to end
            self.renew()

    def renew(self, wait: bool = False) -> None:
        """See `Workers`: this executor knows no cancelling."""
        if self._executor is not None:
            self._executor.shutdown(wait=wait)
        self._executor = None

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
    """Start `count` worker processes; the caller has to shut the pool down."""
    # Spawned, not forked: forking a process with threads, such as a notebook's, can hang.
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_prepare)
    with _clean_start():
        # A submission that finds no idle worker starts one: these start them all, in this block.
        for _ in range(count):
            pool.submit(_warm_up)
    return pool


def _prepare() -> None:
    # Ctrl-C reaches the whole process group; the parent decides what happens.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # A worker whose parent was killed would otherwise wait for work forever.
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _warm_up() -> None:
    import swtstudy.kernel.batch  # noqa: F401


@contextmanager
def _clean_start() -> Iterator[None]:
    """Start processes with the environment of workers and without the calling script.

    Spawned processes import the calling script before any initializer can run: without
    ``if __name__ == "__main__"`` that script would start its run again in every worker.
    """
    before = {name: os.environ.get(name) for name in THREADS}
    main = sys.modules["__main__"]
    os.environ.update(THREADS)
    sys.modules["__main__"] = types.ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main
        for name, value in before.items():
            os.environ.pop(name) if value is None else os.environ.update({name: value})
