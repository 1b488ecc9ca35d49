"""Local worker processes: one BLAS thread each, and independent of the script that calls."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import types
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager

#: Two workers with two BLAS threads each would fight for two cores.
THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def start_workers(count: int) -> ProcessPoolExecutor:
    """Start `count` worker processes; the caller shuts the pool down."""
    # Spawned, not forked: a fork of a process with threads (a notebook's) can hang.
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_prepare)
    with _clean_start():
        # A worker is started by a submission that finds none idle: these start them all, here.
        for _ in range(count):
            pool.submit(_warm_up)
    return pool


def kill_workers(pool: ProcessPoolExecutor) -> None:
    """End the worker processes of a pool at once, whatever they are doing."""
    for process in list((pool._processes or {}).values()):
        process.kill()


def _prepare() -> None:
    # Ctrl-C reaches the whole process group; the parent decides what happens then.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # A worker whose parent was killed would wait for work forever.
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _warm_up() -> None:
    import swtstudy.mechanics  # noqa: F401


@contextmanager
def _clean_start() -> Iterator[None]:
    """One thread each, and without the calling script: a spawned process would import it once more."""
    before = {name: os.environ.get(name) for name in THREAD_VARIABLES}
    main = sys.modules["__main__"]
    os.environ.update(dict.fromkeys(THREAD_VARIABLES, "1"))
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
