"""Where the contact sticks and slips over position and time."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from swtstudy.fields.one_point import read_scene
from swtstudy.fields.places import read_distances, read_time, turns
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal

#: Instants of a cycle by default: slip fronts are seen to move, and the map is computed in milliseconds.
_INSTANTS = 64
#: States of the surface, in the order of the flag values.
_STATES = ("open", "stick", "forward_slip", "backward_slip")


def slip_map(r: object, *, time: object | None = None, **parameters: object) -> xr.Dataset:
    """State of the contact at distances from its centre over one stationary cycle.

    Parameters
    ----------
    r
        Distance from the axis in a_H, a number or a one-dimensional sequence.
    time
        ω1 t in rad: a number or a one-dimensional sequence; by default 64 instants of one common period.
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        state (a flag) over time and r; slip_radius and contact_radius in a_H over time: the contact slips
        between the two. In forward slip the body under the indenter is dragged towards +x.

    Raises
    ------
    ValueError
        If a distance, an instant or a parameter is not allowed.
    """
    scene = read_scene(parameters)
    if time is None:
        time = 2.0 * np.pi * turns(scene) * np.arange(_INSTANTS) / _INSTANTS
    instants, nodes = read_time(scene, time)
    allowed = "a finite distance r ≥ 0 in a_H or a sequence of them"
    distances = read_distances("r", r, allowed)
    if (distances < 0.0).any():
        raise StudyError([Mistake("r", literal(r), allowed)])
    radius = xr.DataArray(distances, dims="r")
    radius.attrs.update(long_name="distance from the axis, in units of a_H", units="1", symbol="r/a_H")
    states = scene.cycle.states(nodes.interval[None], nodes.instant[None])
    edge, front, sign = states.edge, states.front, states.sign
    at = scene.coordinate.of(radius.values[None])[0]
    slips = np.where(sign[0] > 0.0, 2, 3)[:, None]
    state = np.where(at < front[0][:, None], 1, np.where(at < edge[0][:, None], slips, 0)).astype(np.int8)
    flags = {
        "long_name": "state of the contact",
        "flag_values": np.arange(len(_STATES), dtype=np.int8),
        "flag_meanings": " ".join(_STATES),
    }
    variables: dict[str, Any] = {
        "state": ((*instants.dims, "r"), state.reshape(*instants.shape, radius.size), flags)
    }
    for name, values in (("slip_radius", front), ("contact_radius", edge)):
        there = np.where(edge > 0.0, scene.coordinate.radius(values), 0.0).reshape(instants.shape)
        meaning = {"long_name": f"{name.replace('_', ' ')}, in units of a_H", "units": "1"}
        variables[name] = (instants.dims, there, meaning)
    return xr.Dataset(variables, {"time": instants, "r": radius})
