"""One parameter point explained: everything that makes its s, as numbers.

Its load and its memory diagram are known without s, in milliseconds.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.cycle_curves import (
    Variables,
    course_of_load,
    edge_states,
    instants_of,
    marked_instants,
    named,
    of_states,
    springs_of,
)
from swtstudy.fields.one_point import cycle_at, label_time, read_point, turns
from swtstudy.fields.stress import slip_map
from swtstudy.mechanics.body.body import TimeNodes
from swtstudy.mechanics.contact.slip_front import stick_coordinate
from swtstudy.mechanics.control.coordinate import unit_half_load
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.line.first_look import Seen, first_look
from swtstudy.mechanics.line.look import Resolution
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.history import History, stresses
from swtstudy.mechanics.stress.line import SurfaceLine
from swtstudy.mechanics.stress.scene import Scene
from swtstudy.solving import solve

#: Distances from the axis, up to 1.3 of the largest contact radius: the fall of swt outside it is seen.
_RADII, _REACH = 240, 1.3
#: The same for stick and slip, whose map has a cell for each.
_SLIP_RADII, _SLIP_REACH = 601, 1.15
#: How finely swt along the line is sampled: enough for a drawing.
_RESOLUTION, _PLANES = Resolution(nodes=8, zooms=0, digits=8.0), 72


def inspect_point(**parameters: object) -> xr.Dataset:
    """The stationary cycle of one parameter point, with the reason why s is what it is.

    Parameters
    ----------
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each; the others are those of
        Table 1.

    Returns
    -------
    xarray.Dataset
        What `swtstudy.solve` gives, and

        - over time (ω1 t; of a loop the angle of its period): depth δ/δ0, displacement G*u/(μE*δ0) (these two
          not of plane contacts),
          normal_force F_N/F_0 and tangential_force F_x/(μF_0), two of which are prescribed; edge_state, that
          of the contact next to its edge (open, stick, forward or backward slip) from each instant to the
          next; contact_radius, slip_radius; normal_stress
          and normal_strain (by a criterion of shear shear_stress in its place) on the critical plane at the
          critical point, and sigma_xx, sigma_xz there; with a bulk stress bulk_stress, its part of sigma_xx;
        - over time and r: state (open, stick, forward or backward slip);
        - over x: s_local, that is swt, or the value of the criterion, on the surface line;
        - at a few marked instants, with their instant_time and reason: pressure p and traction q over x;
          compression w and force τ of the MDR springs (the memory diagram) over r;
        - shown_x and shown_angle, the point and plane of the stress cycle: the critical ones, or, where s is
          0 or not finite, those of the largest swt that was sampled;
        - dissipation, that is ∮ F_x du of the cycle over μF_0 · μE*δ0/G*, and dissipation_error;
        - permanent_stick_radius (NaN if the whole contact slides or is lost once a cycle), least_radius and
          largest_radius of the contact.

        Lengths in a_H, stresses in E* √(δ0/R), strains in √(δ0/R), swt in E* δ0/R, the values of other
        criteria in E* √(δ0/R).

    Raises
    ------
    StudyError
        A ValueError with every mistake in the parameters, or that they have no equilibrium.

    Examples
    --------
    >>> point = inspect_point(phase="pi/6")
    >>> amplitude = (point.normal_strain.max() - point.normal_strain.min()) / 2
    >>> round(float(point.normal_stress.max() * amplitude / point.s), 3)
    1.0
    """
    points = read_point(parameters)
    scene = cycle_at(points, parameters)
    solved = solve(quantities=["dissipation"], **parameters)  # type: ignore[arg-type]
    extent = _extent(scene)
    radius = _radii(scene, [*(float(v[1]) for v in extent.values()), abs(float(solved.critical_x))])
    line = first_look(scene, radius[None], _RESOLUTION, _PLANES)
    x, double_angle = _shown(solved, line, radius)
    nodes = instants_of(scene, [abs(x)])
    time = turns(scene) * nodes.instant
    unit = unit_half_load(points.profile, points.shape, 1)
    cycle = course_of_load(scene, unit, nodes) | _stress_cycle(scene, nodes, x, double_angle)
    marked, reasons = marked_instants(time / time[-1], {name: part[1] for name, part in cycle.items()})
    some = TimeNodes(nodes.interval[marked], nodes.instant[marked])
    shown: Variables = {
        "shown_x": ((), x, named("position at which the stress is shown", "x/a_H")),
        "shown_angle": ((), np.degrees(double_angle) / 2.0, {"long_name": "plane shown", "units": "degree"}),
        "s_local": (
            "x",
            _both_sides(line.swt[0, :, 0], line.swt[0, :, -1]),
            named(scene.criterion.words.replace("–", "-"), scene.criterion.symbol),
        ),
    }
    largest = float(extent["largest_radius"][1])
    slip = slip_map(np.linspace(0.0, _SLIP_REACH * largest, _SLIP_RADII), time=time, **parameters)
    coordinates = {
        "x": ("x", _both_sides(radius, -radius), named("position in the direction of sliding", "x/a_H")),
        "instant": np.arange(1, len(marked) + 1),
        "instant_time": ("instant", time[marked]),
        "reason": ("instant", reasons),
    }
    variables = (
        cycle | extent | shown | _tractions(scene, some, radius) | springs_of(scene, some, slip.r.values)
    )
    variables["edge_state"] = "time", edge_states(scene, nodes), of_states(slip.state.attrs)
    return slip.assign(variables).assign_coords(coordinates).merge(solved)


def _shown(solved: xr.Dataset, line: Seen, radius: FloatArray) -> tuple[float, float]:
    """Position and 2θ of the stress cycle shown: the critical ones, or those of the largest sample."""
    x, double_angle = float(solved.critical_x), 2.0 * np.radians(float(solved.critical_angle))
    if np.isfinite(x):
        return x, double_angle
    column, side = np.unravel_index(line.swt[0].argmax(), line.swt[0].shape)
    double_angle = float(line.double_angle[0, column, side])
    return float((radius, -radius)[side][column]), (double_angle + np.pi) % (2.0 * np.pi) - np.pi


def _both_sides(right: FloatArray, left: FloatArray) -> FloatArray:
    """Values at −r and at +r, from left to right along the last axis."""
    return np.concatenate([left[..., ::-1], right], axis=-1)


def _extent(scene: Scene) -> Variables:
    """Least and largest contact radius, and the radius of permanent stick."""
    load, coordinate = scene.cycle.load, scene.coordinate
    least, largest = coordinate.radius(np.stack([load.least_normal, load.largest_normal], axis=1))[0]
    stick = stick_coordinate(load)
    if load.least_normal[0] <= 0.0:
        least = 0.0
    permanent = coordinate.radius(stick[:, None])[0, 0] if stick[0] >= 0.0 else np.nan
    return {
        "permanent_stick_radius": ((), permanent, named("radius that always sticks", "c/a_H")),
        "least_radius": ((), least, named("least contact radius", "a/a_H")),
        "largest_radius": ((), largest, named("largest contact radius", "a/a_H")),
    }


def _radii(scene: Scene, special: list[float]) -> FloatArray:
    """Distances from the axis: evenly spaced, at special places, and none where the pressure is infinite."""
    largest = float(scene.largest_radius[0])
    b = float(scene.profile.flat_radius[0])
    places = [value for value in [*special, 1.001 * b, 0.999 * b] if np.isfinite(value)]
    radius = np.union1d(np.linspace(0.0, _REACH * largest, _RADII + 1), places)
    return radius[(radius > 1e-6) & (np.abs(radius - b) > 1e-6)]


def _history(scene: Scene, nodes: TimeNodes, radius: FloatArray) -> History:
    index = np.broadcast_to(np.arange(nodes.instant.size), (1, radius.size, nodes.instant.size))
    surface = SurfaceLine(scene.cycle, scene.coordinate, radius[None], _RESOLUTION.digits, scene.bulk)
    return surface.history(Nodes(nodes.interval[None], nodes.instant[None], index))


def _stress_cycle(scene: Scene, nodes: TimeNodes, x: float, double_angle: float) -> Variables:
    """Stress and strain over the cycle at one point, on one plane."""
    history, side = _history(scene, nodes, np.array([abs(x)])), float(np.sign(x))
    sigma_xx, _, _, sigma_xz = stresses(history, scene.poisson_ratio, scene.friction, side)
    bulk: Variables = {}
    if history.bulk is not None:
        bulk["bulk_stress"] = "time", history.bulk[0, 0], named("bulk stress", r"\sigma_B")
    swing = scene.criterion.swing
    on_plane = scene.planes(history, side).on_plane(np.array([[double_angle]]))
    return {
        "normal_stress": ("time", on_plane[0][0, 0], named("stress normal to the plane", r"\sigma_n")),
        swing.name: ("time", on_plane[1][0, 0], named(swing.words, swing.symbol)),
        "sigma_xx": ("time", sigma_xx[0, 0], named("stress xx", r"\sigma_{xx}")),
        "sigma_xz": ("time", sigma_xz[0, 0], named("stress xz", r"\sigma_{xz}")),
        **bulk,
    }


def _tractions(scene: Scene, some: TimeNodes, radius: FloatArray) -> Variables:
    """Pressure and traction on the half-space; both are even in x."""
    history = _history(scene, some, radius)
    p, q = history.pressure[0].T, -scene.friction * history.traction[0].T
    dims = ("instant", "x")
    return {
        "pressure": (dims, _both_sides(p, p), named("pressure", "p")),
        "traction": (dims, _both_sides(q, q), named("tangential traction in +x", "q")),
    }


#: Distances from the axis, for smooth curves.
_RADII_OF_SPRINGS = 301


def load_and_springs(**parameters: object) -> xr.Dataset:
    """The course of the load over one stationary cycle, and the MDR springs at a few marked instants.

    Parameters
    ----------
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each.

    Returns
    -------
    xarray.Dataset
        Of `swtstudy.inspect_point`: depth, displacement, normal_force, tangential_force and edge_state over
        time, compression and force over r at the instants at which depth or displacement is extreme,
        largest_radius and control.

    Raises
    ------
    StudyError
        As `swtstudy.inspect_point`.
    """
    points = read_point(parameters)
    scene = cycle_at(points, parameters)
    nodes = instants_of(scene, [])
    time = label_time(scene, turns(scene) * nodes.instant, ("time",))
    unit = unit_half_load(points.profile, points.shape, 1)
    cycle = course_of_load(scene, unit, nodes)
    curves = {name: part[1] for name, part in cycle.items()}
    marked, reasons = marked_instants(time.values / time.values[-1], curves)
    some = TimeNodes(nodes.interval[marked], nodes.instant[marked])
    largest = float(scene.largest_radius[0])
    radius = np.linspace(0.0, largest, _RADII_OF_SPRINGS)
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
