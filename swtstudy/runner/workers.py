"""Local worker processes: one BLAS thread each, independent of the calling script."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import types
from collections.abc import Callable, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Any

#: Two workers with two BLAS threads each would fight for two cores.
THREADS = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")


class LocalPool:
    """Worker processes on this machine, inside a with block; see `swtstudy.runner.engine.Pool`.

    They start with the first task, or when they are told to.

    Parameters
    ----------
    count
        Number of worker processes.
    """

    lost, gone = BrokenProcessPool, ()

    def __init__(self, count: int) -> None:
        self._count = count
        self._executor: ProcessPoolExecutor | None = None

    def __enter__(self) -> LocalPool:
        return self

    @property
    def started(self) -> bool:
        """True if the processes have been started."""
        return self._executor is not None

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        if kind is not None and self._executor is not None:
            # Tasks in flight are lost anyway, and a second Ctrl-C must not find us waiting for them.
            kill_workers(self._executor)
        self.close(wait=kind is None)

    def close(self, wait: bool = True) -> None:
        """Let the processes exit, and wait: an interpreter that exits meanwhile may print an error."""
        executor, self._executor = self._executor, None
        if executor is not None:
            executor.shutdown(wait, cancel_futures=True)

    def start(self) -> LocalPool:
        """Start the processes, which import what they need while this one goes on."""
        if self._executor is None:
            self._executor = start_workers(self._count)
        return self

    def size(self) -> int:
        """See `Pool`."""
        return self._count

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """See `Pool`."""
        executor = self.start()._executor
        assert executor is not None
        return executor.submit(function, *arguments)

    def renew(self) -> None:
        """See `Pool`; one lost worker breaks the executor for all."""
        if self._executor is not None:
            self._executor.shutdown(wait=False, cancel_futures=True)
        self._executor = start_workers(self._count)


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


def kill_workers(pool: ProcessPoolExecutor) -> None:
    """End the worker processes of a pool at once, whatever they are doing."""
    for process in list((pool._processes or {}).values()):
        process.kill()


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
    # Tasks arrive as dask's.
    import dask.local  # noqa: F401

    import swtstudy.solver.solve  # noqa: F401


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
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
