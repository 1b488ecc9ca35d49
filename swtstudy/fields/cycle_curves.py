"""Curves of one parameter point: forces and displacements over the cycle, its springs at marked instants.

The springs show the memory diagram over the radius; forces are known whichever of them are prescribed.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.criteria import NORMAL_STRAIN, SHEAR_STRESS

#: States of the contact at its instants, `swtstudy.kernel.course.STATE`.
States = Any

Variables = dict[str, tuple[Any, Any, dict[str, str]]]

#: Uniform instants for smooth curves: 360 for each oscillation of a cycle of up to 4, no fewer than 90 for
#: each of longer cycles; and steps between two events.
_SPARSE, _UNIFORM, _FEW, _STEPS = 90, 360, 4, 8
#: How many instants are marked at most, and their least distance in cycles: their marks do not overlap.
_MARKED, _APART = 4, 0.08


def named(meaning: str, symbol: str) -> dict[str, str]:
    """Attributes of a non-dimensional variable."""
    return {"long_name": meaning, "units": "1", "symbol": symbol}


def instants_of(cycle: LoadCycle, x: float | None = None) -> FloatArray:
    """Instants of the cycle for smooth curves, as angles of its period: with events, also those at x/a_H."""
    count = max(_UNIFORM * min(cycle.oscillations, _FEW), _SPARSE * cycle.oscillations)
    return np.union1d(cycle.instants(_STEPS, x), 2.0 * np.pi * np.arange(count + 1) / count)


def course_of_load(cycle: LoadCycle, states: States) -> Variables:
    """The prescribed loads and the responses over time; in the plane forces alone.

    Parameters
    ----------
    cycle
        Of one point.
    states
        T states of its contact.
    """
    normal, tangential, other, answer = (
        states[name].copy() for name in ("normal", "tangential", "other_normal", "answer")
    )
    if cycle.profile.plane:  # of displacements only changes at constant load are known
        return _over_time(normal_force=normal, tangential_force=tangential)
    given, answers = (normal, tangential), (other, answer)
    forces, motion = (given, answers) if cycle.profile.in_force else (answers, given)
    return _over_time(
        depth=motion[0], displacement=motion[1], normal_force=forces[0], tangential_force=forces[1]
    )


_MEANINGS = {
    "depth": named("indentation depth", r"\delta/\delta_0"),
    "displacement": named("tangential displacement", r"G^* u/(\mu E^* \delta_0)"),
    "normal_force": named("normal force", "F_N/F_0"),
    "tangential_force": named("tangential force", r"F_x/(\mu F_0)"),
}


def _over_time(**curves: FloatArray) -> Variables:
    return {name: ("time", values, _MEANINGS[name]) for name, values in curves.items()}


def edge_states(cycle: LoadCycle, instant: FloatArray) -> NDArray[np.int8]:
    """State of the outermost springs between each instant and the next, numbered as in `slip_map`."""
    ends = np.append(instant[1:], instant[-1])
    middle = cycle.states(0.5 * (instant + ends))
    slips = np.where(middle.push > 0, 2, 3)
    state = np.where(middle.front >= (1.0 - 1e-12) * middle.normal, 1, slips)
    return np.where(middle.normal > 0.0, state, 0).astype(np.int8)


def of_states(flags: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes of `edge_states`, from those of the states of a slip map."""
    return {**flags, "long_name": "state of the contact next to its edge, until the next instant"}


def marked_instants(share: FloatArray, curves: dict[str, FloatArray]) -> tuple[IndexArray, list[str]]:
    """Instants at which curves over the cycle are extreme, in the order of time, and the reason for each.

    Parameters
    ----------
    share
        Shape (T,): time in cycles.
    curves
        Depth and displacement over it, or without them the forces; if stress and strain, or shear stress, on
        the critical plane are there, they come first.
    """
    of_swt: dict[str, np.intp] = {}
    if "normal_stress" in curves:
        of_swt["σ_n largest"] = curves["normal_stress"].argmax()
    if NORMAL_STRAIN.name in curves:
        of_swt["ε_n smallest"] = curves[NORMAL_STRAIN.name].argmin()
    if SHEAR_STRESS.name in curves:
        of_swt |= {
            "τ largest": curves[SHEAR_STRESS.name].argmax(),
            "τ smallest": curves[SHEAR_STRESS.name].argmin(),
        }
    names = {"δ": "depth", "u": "displacement"}
    if "depth" not in curves:
        names = {"F_N": "normal_force", "F_x": "tangential_force"}
    (normal, tangential), extremes = names.values(), of_swt
    for letter, name in names.items():
        extremes = extremes | {
            f"{letter} largest": curves[name].argmax(),
            f"{letter} smallest": curves[name].argmin(),
        }
    touching = curves[normal] > 0.0
    distance = np.full(share.size, 1.0)  # to the nearest instant that is marked already
    marked: dict[int, str] = {}

    def mark(index: int, reason: str) -> None:
        marked[index] = reason
        nonlocal distance
        distance = np.minimum(distance, np.abs((share - share[index] + 0.5) % 1.0 - 0.5))

    for reason, index in extremes.items():
        if len(marked) < _MARKED and distance[index] >= _APART and (reason in of_swt or touching[index]):
            mark(int(index), reason)
    swings = (NORMAL_STRAIN.name, SHEAR_STRESS.name)
    moving = next((curves[name] for name in swings if name in curves), curves[tangential])
    while len(marked) < _MARKED and np.ptp(moving) > 0.0:
        mark(int(np.where(touching, distance, -1.0).argmax()), "in between")
    order = sorted(marked)
    return np.array(order), [marked[index] for index in order]


def springs_of(cycle: LoadCycle, states: States, radius: FloatArray) -> Variables:
    """The memory diagram over r at some instants; see `LoadCycle.springs`."""
    compression, force = cycle.springs(radius, states)
    dims = ("instant", "r")
    if cycle.profile.plane:
        return {
            "compression": (dims, compression, named("normal force beyond that of the strip", "w/F_0")),
            "force": (dims, force, named("tangential force in the diagram", r"\tau/(\mu F_0)")),
        }
    return {
        "compression": (dims, compression, named("compression of the springs", r"w/\delta_0")),
        "force": (dims, force, named("tangential force of the springs", r"G^* u_{MDR}/(\mu E^* \delta_0)")),
    }
