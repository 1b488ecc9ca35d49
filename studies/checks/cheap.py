"""Cheap solvers for the checks of the runner, importable by worker processes."""

from __future__ import annotations

import os
import time

import numpy as np

from swtstudy.solver.points import Points, Solution, solve_points


def cheap(points: Points, rtol: float) -> Solution:
    """Next to no work: the time of a run with this solver is the runner's own."""
    s = 0.1 + 0.01 * points.normal_amplitude * np.cos(points.phase) + points.friction
    return Solution(s, rtol * s, 1 + points.phase, np.sin(points.phase), np.ones(len(points), np.int8), s)


def logged(log: str, points: Points, rtol: float) -> Solution:
    """The real solver; writes the number of points of every finished block to a log."""
    solution = solve_points(points, rtol)
    _append(log, f"{len(points)}")
    return solution


def asleep(seconds: float, log: str, points: Points, rtol: float) -> Solution:
    """Like `cheap`, but sleeps for some time per point; logs process, begin, end and number of points."""
    begin = time.perf_counter()
    time.sleep(seconds * len(points))
    solution = cheap(points, rtol)
    _append(log, f"{os.getpid()} {begin} {time.perf_counter()} {len(points)}")
    return solution


def spinning(seconds: float, points: Points, rtol: float) -> Solution:
    """Like `cheap`, but keeps a core busy for some CPU time per point."""
    end = time.thread_time() + seconds * len(points)
    solution = cheap(points, rtol)
    while time.thread_time() < end:
        pass
    return solution


def _append(log: str, line: str) -> None:
    handle = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
    os.write(handle, f"{line}\n".encode())
    os.close(handle)
