"""Curves of one parameter point: the course of its load over the cycle, its springs at marked instants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from swtstudy.fields.forces import course
from swtstudy.fields.springs import spring_forces
from swtstudy.mechanics.body.body import TimeNodes, nodes_at, time_nodes, together
from swtstudy.mechanics.contact.cycle import NO_SLIP
from swtstudy.mechanics.planes.swing import NORMAL_STRAIN, SHEAR_STRESS
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.scene import Scene

Variables = dict[str, tuple[Any, Any, dict[str, str]]]

#: Uniform instants for smooth curves: 360 for each oscillation of a cycle of up to 4, no fewer than 90 for
#: each of longer cycles; and steps between two events.
_SPARSE, _UNIFORM, _FEW, _STEPS = 90, 360, 4, 8
#: How many instants are marked at most, and their least distance in cycles: their marks do not overlap.
_MARKED, _APART = 4, 0.08


def named(meaning: str, symbol: str) -> dict[str, str]:
    """Attributes of a non-dimensional variable."""
    return {"long_name": meaning, "units": "1", "symbol": symbol}


def instants_of(scene: Scene, special: list[float]) -> TimeNodes:
    """Instants of the cycle for smooth curves, with events; also those at some distances from the axis."""
    oscillations = max(scene.cycle.load.oscillations)
    count = max(_UNIFORM * min(oscillations, _FEW), _SPARSE * oscillations)
    uniform = nodes_at(scene, 2.0 * np.pi * np.arange(count + 1) / count)
    return together(scene, time_nodes(scene, _STEPS, special), uniform)


def course_of_load(scene: Scene, unit: FloatArray, nodes: TimeNodes) -> Variables:
    """Forces and displacements over time; see `swtstudy.fields.forces.course`. In the plane forces alone."""
    both = course(scene, unit, nodes)
    forces: Variables = {
        "normal_force": ("time", both.normal_force, named("normal force", "F_N/F_0")),
        "tangential_force": ("time", both.tangential_force, named("tangential force", r"F_x/(\mu F_0)")),
    }
    if scene.profile.plane:
        return forces
    return {
        "depth": ("time", both.depth, named("indentation depth", r"\delta/\delta_0")),
        "displacement": (
            "time",
            both.displacement,
            named("tangential displacement", r"G^* u/(\mu E^* \delta_0)"),
        ),
        **forces,
    }


def edge_states(scene: Scene, nodes: TimeNodes) -> NDArray[np.int8]:
    """State of the outermost springs between each instant and the next, numbered as in `slip_map`."""
    ends = np.append(nodes.instant[1:], nodes.instant[-1])
    middle = nodes_at(scene, 0.5 * (nodes.instant + ends))
    states = scene.cycle.states(middle.interval[None], middle.instant[None])
    slips = np.where(states.sign > 0.0, 2, 3)
    state = np.where(states.front >= (1.0 - NO_SLIP) * states.edge, 1, slips)
    return np.where(states.edge > 0.0, state, 0)[0].astype(np.int8)


def of_states(flags: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes of `edge_states`, from those of the states of a slip map."""
    return {**flags, "long_name": "state of the contact next to its edge, until the next instant"}


def marked_instants(share: FloatArray, curves: dict[str, FloatArray]) -> tuple[NDArray[np.intp], list[str]]:
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


def springs_of(scene: Scene, some: TimeNodes, radius: FloatArray) -> Variables:
    """The memory diagram over r at some instants; see `swtstudy.fields.springs.spring_forces`."""
    compression, force = spring_forces(scene, some, radius)
    dims = ("instant", "r")
    if scene.profile.plane:
        return {
            "compression": (dims, compression, named("normal force beyond that of the strip", "w/F_0")),
            "force": (dims, force, named("tangential force in the diagram", r"\tau/(\mu F_0)")),
        }
    return {
        "compression": (dims, compression, named("compression of the springs", r"w/\delta_0")),
        "force": (dims, force, named("tangential force of the springs", r"G^* u_{MDR}/(\mu E^* \delta_0)")),
    }
