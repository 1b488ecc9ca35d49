"""The workers of a dask.distributed cluster (extra "distributed")."""

from __future__ import annotations

import asyncio
import logging
import threading
from collections.abc import Callable
from concurrent.futures import CancelledError, Future
from typing import TYPE_CHECKING, Any

from distributed.comm import CommClosedError
from distributed.scheduler import KilledWorker

if TYPE_CHECKING:
    from distributed import Client

_log = logging.getLogger(__name__)

#: Seconds between two checks that the cluster has workers: the user who has just started a run still looks.
_CHECK_SECONDS = 5.0


class ClusterPool:
    """The workers of a cluster, which may come and go, inside a with block; see `Pool`.

    dask itself reassigns the tasks of a lost worker; only a task that has killed several workers is lost.

    Parameters
    ----------
    client
        Client of the cluster; it stays open.
    """

    lost, gone = KilledWorker, (CancelledError, CommClosedError)

    def __init__(self, client: Client) -> None:
        self._client = client
        self._ended = threading.Event()

    def __enter__(self) -> ClusterPool:
        self._executor = self._client.get_executor(pure=False)
        threading.Thread(target=self._watch, daemon=True).start()
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self._ended.set()
        if kind is None or not issubclass(kind, OSError):  # without a scheduler there is nothing to end
            self._executor.shutdown(wait=False)

    def size(self) -> int:
        """See `Pool`."""
        return max(1, sum(self._client.nthreads().values()))

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """See `Pool`."""
        return self._executor.submit(function, *arguments)

    def renew(self) -> None:
        """See `Pool`."""
        self._executor.shutdown(wait=False)
        self._executor = self._client.get_executor(pure=False)

    def _watch(self) -> None:
        """Warn when there are no workers: dask waits for them silently."""
        warned = False
        while not self._ended.wait(_CHECK_SECONDS):
            try:
                present = bool(self._client.nthreads())
            except (Exception, asyncio.CancelledError):  # the scheduler is gone: the engine will notice
                return
            if not present and not warned:
                _log.warning("the cluster has no workers; waiting for some")
            warned = not present
