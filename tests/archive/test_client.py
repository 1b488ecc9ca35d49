"""Runs on a cluster whose client is a stand-in: what is asked of it, and what is said."""

from __future__ import annotations

import logging
import sys
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
import stand_in
from command import call

from swtstudy import Study, run
from swtstudy.vocabulary.version import SOLVER_VERSION

LINE = 'title = "t"\nrtol = 1e-3\n[axes]\nfriction = {start = "0.01", stop = 2, num = 400}\n'


class Client:
    """A client with some threads, whose executor is one of this process."""

    dashboard_link = "http://here"
    made: ClassVar[list[Client]] = []

    def __init__(self, address: str = "", timeout: float = 0.0) -> None:
        if address == "nowhere":
            raise OSError("Timed out")
        self.address, self.timeout = address, timeout
        self.threads: list[dict[str, int]] = [{"a": 1, "b": 2}]
        self.pure: list[bool] = []
        self.stopped: list[bool] = []
        self.waiting, self.most = 0, 0
        Client.made.append(self)

    def nthreads(self) -> dict[str, int]:
        """The threads of each worker; the last of several answers stays."""
        return self.threads.pop(0) if len(self.threads) > 1 else self.threads[0]

    def get_executor(self, pure: bool) -> Executor:
        self.pure.append(pure)
        return Executor(self)


class Executor:
    """The executor of a client, which knows no cancelling."""

    def __init__(self, client: Client) -> None:
        self.client, self.own = client, ThreadPoolExecutor(1)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        self.client.waiting += 1
        self.client.most = max(self.client.most, self.client.waiting)
        future = self.own.submit(function, *arguments)
        future.add_done_callback(self._done)
        return future

    def _done(self, _: Future[Any]) -> None:
        self.client.waiting -= 1

    def shutdown(self, wait: bool) -> None:
        self.client.stopped.append(wait)
        self.own.shutdown(wait=wait)


@pytest.fixture(autouse=True)
def distributed(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The stand-in in its place, and its loggers as they were."""
    module = pytest.importorskip("distributed")
    monkeypatch.setattr(module, "Client", Client)
    loggers = [logging.getLogger(name) for name in ("distributed", "distributed.client")]
    levels = [each.level for each in loggers]
    Client.made.clear()
    yield
    for each, level in zip(loggers, levels, strict=True):
        each.setLevel(level)


def test_a_cluster_computes_what_this_process_computes(tmp_path: Path) -> None:
    study, client = Study.from_text(LINE), Client()
    found = run(study, tmp_path / "there.nc", client=client, solver=stand_in.smooth)  # type: ignore[arg-type]
    np.testing.assert_array_equal(found.s, run(study, tmp_path / "here.nc", solver=stand_in.smooth).s)
    # Equal tasks are done again, such as those of a lost worker.
    assert client.pure == [False]
    assert client.stopped == [False]


def test_the_command_connects_and_is_silent_about_lost_connections(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    (tmp_path / "line.toml").write_text(LINE)
    arguments = ("run", tmp_path / "line.toml", "--results", tmp_path, "--scheduler")
    done = call(*arguments, "tcp://here:8786")
    assert done.exit_code == 0, done.output
    assert done.stderr == "dashboard: http://here\n"
    (client,) = Client.made
    assert (client.address, client.timeout) == ("tcp://here:8786", 10.0)
    for name in ("distributed", "distributed.client"):
        assert logging.getLogger(name).level == logging.CRITICAL
    refused = call(*arguments, "nowhere")
    assert refused.stderr == "Error: no dask scheduler at nowhere (Timed out)\n"
    monkeypatch.setitem(sys.modules, "distributed", None)
    lacking = '--scheduler needs the extra "distributed": pip install "swtstudy[distributed]"'
    assert call(*arguments, "tcp://here:8786").stderr == f"Error: {lacking}\n"


def test_a_cluster_that_loses_its_workers_is_said_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("swtstudy.archive.workers.CHECK_SECONDS", 0.01)
    client = Client()
    client.threads = [{"a": 2}, {}, {}, {"a": 1}, {}, {"a": 3}]

    def solver(points: stand_in.Points, rtol: float) -> stand_in.Solution:
        while len(client.threads) > 1:
            time.sleep(0.005)
        return stand_in.smooth(points, rtol)

    monkeypatch.setattr(stand_in.SOLVER, solver)
    run(Study.from_text(LINE), tmp_path / "a.nc", client=client)  # type: ignore[arg-type]
    said = [each.getMessage() for each in caplog.records if each.levelno == logging.WARNING]
    assert said == ["the cluster has no workers; waiting for some"] * 2


@pytest.mark.parametrize(("threads", "tasks"), [({"a": 1, "b": 1}, 4), ({"a": 1}, 2), ({}, 2)])
def test_each_thread_of_a_cluster_has_a_task_and_one_to_go_on_with(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, threads: dict[str, int], tasks: int
) -> None:
    client = Client()
    client.threads = [threads]

    def solver(points: stand_in.Points, rtol: float) -> stand_in.Solution:
        end = time.monotonic() + 10.0
        while not done and client.most < tasks and time.monotonic() < end:
            time.sleep(0.001)
        done.append(True)
        return stand_in.smooth(points, rtol)

    done: list[bool] = []
    monkeypatch.setattr(stand_in.SOLVER, solver)
    run(Study.from_text(LINE), tmp_path / "a.nc", client=client)  # type: ignore[arg-type]
    assert client.most == tasks


def failing(client: Client, error: BaseException, at_once: bool = False) -> None:
    """Let every task of a client end with an error, or fail when it is given to it."""

    def submit(*_: object) -> Future[Any]:
        if at_once:
            raise error
        future: Future[Any] = Future()
        future.set_exception(error)
        return future

    executor = Executor(client)
    executor.submit = submit  # type: ignore[method-assign]
    client.get_executor = lambda pure: executor  # type: ignore[method-assign]


def test_a_client_whose_scheduler_ends_says_so(tmp_path: Path) -> None:
    client = Client()
    failing(client, CancelledError())
    with pytest.raises(OSError, match=r"^the dask scheduler is gone; 0 of 400 distinct points are saved"):
        run(Study.from_text(LINE), tmp_path / "a.nc", client=client)  # type: ignore[arg-type]
    assert not client.stopped


@pytest.mark.parametrize("at_once", [False, True])
def test_points_whose_workers_are_killed_fail_one_by_one(tmp_path: Path, at_once: bool) -> None:
    from distributed.scheduler import KilledWorker

    client = Client()
    failing(client, KilledWorker("a task", None, 0), at_once)  # type: ignore[arg-type]
    found = run(Study.from_text(LINE.replace("400", "3")), tmp_path / "a.nc", client=client)  # type: ignore[arg-type]
    assert found.message.values.tolist() == ["the worker process died while it computed this point"] * 3


def test_workers_of_another_version_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("swtstudy.points.chunk.SOLVER_VERSION", "other")
    words = (
        f"a worker has version other of the solver, this machine {SOLVER_VERSION}; 0 of 400 distinct points"
    )
    with pytest.raises(OSError, match=f"^{words} are saved beside"):
        run(Study.from_text(LINE), tmp_path / "a.nc", solver=stand_in.smooth)


def test_what_is_no_client_is_named(tmp_path: Path) -> None:
    words = "^client: found 'tcp://here'; allowed: a Client of dask.distributed$"
    with pytest.raises(ValueError, match=words):
        run(Study.from_text(LINE), tmp_path / "a.nc", client="tcp://here")  # type: ignore[arg-type]


def test_a_run_in_another_thread_leaves_signals_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    (tmp_path / "line.toml").write_text(LINE)
    done: list[int] = []
    thread = threading.Thread(
        target=lambda: done.append(call("run", tmp_path / "line.toml", "--results", tmp_path).exit_code)
    )
    thread.start()
    thread.join()
    assert done == [0]
