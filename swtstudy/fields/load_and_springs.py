"""The load of one parameter point and its memory diagram: what is known without s, in milliseconds."""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.cycle_curves import (
    course_of_load,
    edge_states,
    instants_of,
    marked_instants,
    named,
    springs_of,
)
from swtstudy.fields.one_point import read_point
from swtstudy.fields.places import label_time, turns
from swtstudy.mechanics.body.body import TimeNodes
from swtstudy.mechanics.control.force import unit_half_load
from swtstudy.mechanics.stress.scene import scene_of

#: Distances from the axis, for smooth curves.
_RADII = 301


def load_and_springs(**parameters: object) -> xr.Dataset:
    """The course of the load over one stationary cycle, and the MDR springs at a few marked instants.

    Parameters
    ----------
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each, of a point that is in
        equilibrium.

    Returns
    -------
    xarray.Dataset
        Of `swtstudy.inspect_point`: depth, displacement, normal_force, tangential_force and edge_state over
        time, compression and force over r at the instants at which depth or displacement is extreme,
        largest_radius and control.
    """
    points = read_point(parameters)
    scene = scene_of(points)
    nodes = instants_of(scene, [])
    time = label_time(scene, turns(scene) * nodes.instant, ("time",))
    unit = unit_half_load(points.profile, points.shape, 1)
    cycle = course_of_load(scene, unit, nodes)
    curves = {name: part[1] for name, part in cycle.items()}
    marked, reasons = marked_instants(time.values / time.values[-1], curves)
    some = TimeNodes(nodes.interval[marked], nodes.instant[marked])
    largest = float(scene.largest_radius[0])
    radius = np.linspace(0.0, largest, _RADII)
    return xr.Dataset(
        {
            **cycle,
            **springs_of(scene, some, radius),
            "edge_state": ("time", edge_states(scene, nodes)),
            "largest_radius": ((), largest, named("largest contact radius", "a/a_H")),
        },
        {
            "time": time,
            "r": ("r", radius, named("distance from the axis", "r/a_H")),
            "instant": np.arange(1, len(marked) + 1),
            "instant_time": ("instant", time.values[marked]),
            "reason": ("instant", reasons),
            "control": points.control.name,
        },
    )
