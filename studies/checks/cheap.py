"""Cheap solvers for the checks of the runner, importable by worker processes."""

from __future__ import annotations

import os
import time

import numpy as np

from swtstudy.mechanics import solve_points
from swtstudy.mechanics.points import Points, Solution


def cheap(points: Points, rtol: float) -> Solution:
    """Next to no work: what a run takes with it is the runner's own."""
    s = 0.1 + 0.01 * points.normal_amplitude * np.cos(points.phase) + points.friction
    return Solution(s, rtol * s, 1 + points.phase, np.sin(points.phase), np.ones(len(points), np.int8), s)


def logged(log: str, points: Points, rtol: float) -> Solution:
    """The real solver; the number of points of every finished block goes to a log."""
    solution = solve_points(points, rtol)
    _append(log, f"{len(points)}")
    return solution


def asleep(seconds: float, log: str, points: Points, rtol: float) -> Solution:
    """Like `cheap`, but it takes a time for each point, without using a core; logs who, when, how many."""
    begin = time.perf_counter()
    time.sleep(seconds * len(points))
    solution = cheap(points, rtol)
    _append(log, f"{os.getpid()} {begin} {time.perf_counter()} {len(points)}")
    return solution


def spinning(seconds: float, points: Points, rtol: float) -> Solution:
    """Like `cheap`, but it uses a core for a time for each point, counted in CPU time."""
    end = time.thread_time() + seconds * len(points)
    solution = cheap(points, rtol)
    while time.thread_time() < end:
        pass
    return solution


def _append(log: str, line: str) -> None:
    handle = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
    os.write(handle, f"{line}\n".encode())
    os.close(handle)
