"""Reading the package's memory diagram: the force of any spring at any instant of the stationary cycle."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.cycle import Cycle, solve_cycle
from swtstudy.mechanics.contact.memory import GROWTH
from swtstudy.mechanics.control.diagram import diagram
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]


def harmonic(
    normal_amplitude: float = 0.75,
    tangential_amplitude: float = 5 / 6,
    phase: float = 0.0,
    p: int = 1,
    q: int = 1,
) -> BimodalLoad:
    """One load."""
    return BimodalLoad(
        np.array([normal_amplitude]), np.array([tangential_amplitude]), np.array([phase]), p, q
    )


def front_at(cycle: Cycle, instants: Array) -> tuple[Array, Array, NDArray[np.intp], NDArray[np.intp]]:
    """Slip front, sense of slip, piece in which the front lies, and interval, of the first cycle."""
    interval = np.minimum(np.searchsorted(cycle.end[0], instants, side="left"), cycle.end.shape[1] - 1)
    states = cycle.states(interval[None], instants[None])
    return states.front[0], states.sign[0], states.piece[0], interval


def tangential_force(cycle: Cycle, g: Array, instants: Array) -> Array:
    """τ of the springs at depths ``g`` of the first cycle, shape (len(instants), len(g))."""
    load = cycle.load
    front, sign, _, interval = front_at(cycle, instants)
    depth, displacement = load.normal(instants[None])[0], load.tangential(instants[None])[0]
    result = np.empty((len(instants), len(g)))
    for k, i in enumerate(interval):
        memory = cycle.memory.take((slice(0, 1), slice(i, i + 1)))
        start, offset, slope, branch = (
            getattr(memory, name)[0, 0] for name in ("start", "offset", "slope", "branch")
        )
        if start[0] > 0.0:  # nothing is held from before this interval
            start = np.append(0.0, start[1:])
        piece = np.searchsorted(start, g, side="right") - 1
        line = offset[piece] + np.where(slope[piece] == GROWTH, 0.0, slope[piece]) * (g - start[piece])
        grown = load.tangential(load.touch_down(g[None], branch[piece][None]))[0]
        held = np.where(slope[piece] == GROWTH, grown, line)
        w = depth[k] - g
        result[k] = np.where(g < front[k], displacement[k] - held, sign[k] * w)
        result[k][w <= 0.0] = 0.0
    return result


def slopes(cycle: Cycle, instant: float) -> list[tuple[float, float, Callable[[float], float]]]:
    """dτ/dG of the first cycle at an instant: from depth, to depth, slope over G."""
    load = cycle.load
    front, sign, piece, interval = (values[0] for values in front_at(cycle, np.array([instant])))
    start, slope, branch = (getattr(cycle.memory, name)[0, interval] for name in ("start", "slope", "branch"))

    def piece_slope(g: float, k: int) -> float:
        if slope[k] != GROWTH:
            return -float(slope[k])
        touch = load.touch_down(np.reshape(g, (1, -1)), branch[k : k + 1])
        rate = -load.tangential_rate(touch) / load.normal_rate(touch)
        return rate.reshape(np.shape(g))[()]

    ends = np.append(np.minimum(start[: piece + 1], front), front)
    found: list[tuple[float, float, Callable[[float], float]]] = [
        (ends[k], ends[k + 1], partial(piece_slope, k=k)) for k in range(piece + 1) if ends[k] < ends[k + 1]
    ]
    depth = load.normal(np.array([[instant]]))[0, 0]
    if depth > front:
        found.append((front, depth, lambda g: -float(sign)))
    return found


def prescribed_scene(
    load: Load,
    control: Control,
    poisson_ratio: NDArray[np.float64],
    friction: NDArray[np.float64],
    profile: str = "paraboloid",
    shape: Mapping[str, NDArray[np.float64]] | None = None,
) -> Scene:
    """The scenes of n loads, which need be none of points."""
    in_diagram, coordinate = diagram(control, profile, dict(shape or {}), load)
    return Scene(solve_cycle(in_diagram), coordinate, poisson_ratio, friction)
