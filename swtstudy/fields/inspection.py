"""One parameter point explained: everything that makes its s, as numbers.

Its load and its memory diagram are known without s, in milliseconds.
"""

from __future__ import annotations

import numpy as np
import xarray as xr

from swtstudy.fields.cycle_curves import (
    States,
    Variables,
    course_of_load,
    edge_states,
    instants_of,
    marked_instants,
    named,
    of_states,
    springs_of,
)
from swtstudy.fields.one_point import labelled_time, read_cycle, turns_of
from swtstudy.fields.stress import slip_map
from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solving import solve
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.criteria import CRITERIA

#: Distances from the axis, up to 1.3 of the largest contact radius: the fall of swt outside it is seen.
_RADII, _REACH = 240, 1.3
#: The same for stick and slip, whose map has a cell for each.
_SLIP_RADII, _SLIP_REACH = 601, 1.15


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
        - dissipation, the work of friction in the cycle over μF_0 · μE*δ0/G*, which is ∮ F_x du but for what
          a bulk stress adds that moves the stick zone, and dissipation_error;
        - permanent_stick_radius (NaN if the whole contact slides or is lost once a cycle), stick_left and
          stick_right, where that zone ends, least_radius and largest_radius of the contact.

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
    cycle = read_cycle(parameters)
    solved = solve(quantities=["dissipation"], **parameters)  # type: ignore[arg-type]
    extent = _extent(cycle)
    radius = _radii(cycle, [*(abs(float(v[1])) for v in extent.values()), abs(float(solved.critical_x))])
    values, double_angles = cycle.along(radius)
    if float(solved.s) == 0.0:  # what is there is rounding
        values = np.zeros_like(values)
    x, double_angle = _shown(solved, values, double_angles, radius)
    instant = instants_of(cycle, x)
    states = cycle.states(instant)
    time = turns_of(cycle.points) * instant
    course = course_of_load(cycle, states) | _stress_cycle(cycle, states, x, double_angle)
    marked, reasons = marked_instants(time / time[-1], {name: part[1] for name, part in course.items()})
    some = states[marked]
    criterion = CRITERIA[cycle.points.criterion]
    shown: Variables = {
        "shown_x": ((), x, named("position at which the stress is shown", "x/a_H")),
        "shown_angle": ((), np.degrees(double_angle) / 2.0, {"long_name": "plane shown", "units": "degree"}),
        "s_local": ("x", _both_sides(values[:, 0], values[:, 1]), named(criterion.words, criterion.symbol)),
    }
    largest = float(extent["largest_radius"][1])
    first = -largest if cycle.moved else 0.0
    slip = slip_map(_SLIP_REACH * np.linspace(first, largest, _SLIP_RADII), time=time, **parameters)
    coordinates = {
        "x": ("x", _both_sides(radius, -radius), named("position in the direction of sliding", "x/a_H")),
        "instant": np.arange(1, len(marked) + 1),
        "instant_time": ("instant", time[marked]),
        "reason": ("instant", reasons),
    }
    variables = (
        course
        | extent
        | shown
        | _tractions(cycle, some, radius)
        | springs_of(cycle, some, abs(slip.r.values))
    )
    variables["edge_state"] = "time", edge_states(cycle, instant), of_states(slip.state.attrs)
    return slip.assign(variables).assign_coords(coordinates).merge(solved)


def _shown(
    solved: xr.Dataset, values: FloatArray, double_angles: FloatArray, radius: FloatArray
) -> tuple[float, float]:
    """Position and 2θ of the stress cycle shown: the critical ones, or those of the largest sample."""
    x, double_angle = float(solved.critical_x), 2.0 * np.radians(float(solved.critical_angle))
    if np.isfinite(x):
        return x, double_angle
    column, side = np.unravel_index(values.argmax(), values.shape)
    double_angle = float(double_angles[column, side])
    return float((radius, -radius)[side][column]), (double_angle + np.pi) % (2.0 * np.pi) - np.pi


def _both_sides(right: FloatArray, left: FloatArray) -> FloatArray:
    """Values at −r and at +r, from left to right along the last axis."""
    return np.concatenate([left[..., ::-1], right], axis=-1)


def _extent(cycle: LoadCycle) -> Variables:
    """Ends and radius of permanent stick, least and largest contact radius."""
    permanent, least, largest = cycle.radii
    left, right = cycle.stick_zone
    return {
        "stick_left": ((), left, named("left end of what always sticks", "x/a_H")),
        "stick_right": ((), right, named("right end of what always sticks", "x/a_H")),
        "permanent_stick_radius": ((), permanent, named("radius that always sticks", "c/a_H")),
        "least_radius": ((), least, named("least contact radius", "a/a_H")),
        "largest_radius": ((), largest, named("largest contact radius", "a/a_H")),
    }


def _radii(cycle: LoadCycle, special: list[float]) -> FloatArray:
    """Distances from the axis: evenly spaced, at special places, and none where the pressure is infinite."""
    b = float(cycle.profile.flat_radius)
    places = [value for value in [*special, 1.001 * b, 0.999 * b] if np.isfinite(value)]
    radius = np.union1d(np.linspace(0.0, _REACH * cycle.radii[2], _RADII + 1), places)
    return radius[(radius > 1e-6) & (np.abs(radius - b) > 1e-6)]


def _stress_cycle(cycle: LoadCycle, states: States, x: float, double_angle: float) -> Variables:
    """Stress and strain over the cycle at one point, on one plane."""
    normal, moved = cycle.on_plane(x, double_angle, states)
    stress = cycle.stress(x, states)
    bulk: Variables = {}
    if cycle.load.bulk_range.any():
        bulk["bulk_stress"] = "time", stress["bulk"], named("bulk stress", r"\sigma_B")
    swing = CRITERIA[cycle.points.criterion].swing
    return {
        "normal_stress": ("time", normal, named("stress normal to the plane", r"\sigma_n")),
        swing.name: ("time", moved, named(swing.words, swing.symbol)),
        "sigma_xx": ("time", stress["xx"], named("stress xx", r"\sigma_{xx}")),
        "sigma_xz": ("time", stress["xz"], named("stress xz", r"\sigma_{xz}")),
        **bulk,
    }


def _tractions(cycle: LoadCycle, some: States, radius: FloatArray) -> Variables:
    """Pressure and traction on the half-space; both are even in x if nothing moves the stick zone."""

    def at(x: FloatArray) -> list[FloatArray]:
        stress = [cycle.stress(float(each), some) for each in x]
        return [-np.stack([each[name] for each in stress], axis=-1) for name in ("zz", "xz")]

    p, q = at(radius)
    left = at(-radius)[1] if cycle.moved else q
    dims = ("instant", "x")
    return {
        "pressure": (dims, _both_sides(p, p), named("pressure", "p")),
        "traction": (dims, _both_sides(q, left), named("tangential traction in +x", "q")),
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
    cycle = read_cycle(parameters)
    instant = instants_of(cycle)
    states = cycle.states(instant)
    time = labelled_time(cycle.points.path is None, turns_of(cycle.points) * instant, ("time",))
    course = course_of_load(cycle, states)
    curves = {name: part[1] for name, part in course.items()}
    marked, reasons = marked_instants(time.values / time.values[-1], curves)
    largest = cycle.radii[2]
    radius = np.linspace(0.0, largest, _RADII_OF_SPRINGS)
    return xr.Dataset(
        {
            **course,
            **springs_of(cycle, states[marked], radius),
            "edge_state": ("time", edge_states(cycle, instant)),
            "largest_radius": ((), largest, named("largest contact radius", "a/a_H")),
        },
        {
            "time": time,
            "r": ("r", radius, named("distance from the axis", "r/a_H")),
            "instant": np.arange(1, len(marked) + 1),
            "instant_time": ("instant", time.values[marked]),
            "reason": ("instant", reasons),
            "control": cycle.points.control.name,
        },
    )
