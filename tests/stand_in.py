"""Stand-ins for the solver of the mechanics, importable by worker processes."""

from __future__ import annotations

import os
import signal
import time

import numpy as np

from swtstudy.mechanics.points import Points, Solution


def smooth(points: Points, rtol: float) -> Solution:
    """A cheap function of every parameter."""
    s = 0.1 + 0.01 * points.normal_amplitude * np.cos(points.phase) + points.friction
    s = s + points.p / points.q + 0.1 * points.tangential_amplitude + points.poisson_ratio
    for index, shape in enumerate(points.shape.values()):
        s = s + (index + 1) * shape
    angle = 10 * np.sin(points.phase)
    return Solution(s, rtol * s, 1 + points.phase, angle, np.ones(len(points), np.int8))


def slow(points: Points, rtol: float) -> Solution:
    """The same, 20 ms a point: enough work for worker processes."""
    time.sleep(0.02 * len(points))
    return smooth(points, rtol)


def process(points: Points, rtol: float) -> Solution:
    """Like `slow`, but critical_x is the number of the process and s its number of BLAS threads."""
    solution = slow(points, rtol)
    threads = float(os.environ.get("OPENBLAS_NUM_THREADS", "nan"))
    return Solution(
        np.full(len(points), threads),
        solution.s_error,
        np.full(len(points), float(os.getpid())),
        solution.critical_angle,
        solution.regime,
    )


def kill_once(mark: str, points: Points, rtol: float) -> Solution:
    """Like `smooth`, but the first worker that comes here is killed; `mark` is a file that says so."""
    try:
        os.close(os.open(mark, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return smooth(points, rtol)
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError
