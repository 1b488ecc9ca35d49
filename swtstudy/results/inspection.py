"""One parameter point explained: everything that makes its s, as numbers.

Its load and its memory diagram are known without s, in milliseconds; forces whichever of them are prescribed.
"""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import xarray as xr

from swtstudy.points.solve import solve
from swtstudy.results.one_point import labelled_time, named, read_cycle, turns_of
from swtstudy.results.stress import STATES, slip_map
from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.vocabulary.arrays import FloatArray, IndexArray
from swtstudy.vocabulary.choices import CRITERIA, NORMAL_STRAIN, SHEAR_STRESS
from swtstudy.vocabulary.quantities import flag_attributes

#: States of the contact at its instants, `swtstudy.kernel.course.STATE`.
States = Any
#: Dimensions, values and attributes of variables, by their names.
Variables = dict[str, tuple[Any, Any, dict[str, Any]]]

#: Uniform instants for smooth curves: 360 for each oscillation of a cycle of up to 4, no fewer than 90 for
#: each of longer cycles; and steps between two events.
_SPARSE, _UNIFORM, _FEW, _STEPS = 90, 360, 4, 8
#: How many instants are marked at most, and their least distance in cycles: their marks do not overlap.
_MARKED, _APART = 4, 0.08
#: Letters of the curves at whose extremes instants are marked; the first ones have precedence.
_OF_PLANE = {"normal_stress": "σ_n", NORMAL_STRAIN.name: "ε_n", SHEAR_STRESS.name: "τ"}
_LETTERS = {"depth": "δ", "displacement": "u", "normal_force": "F_N", "tangential_force": "F_x", **_OF_PLANE}
_OF_NO_MATTER = (("normal_stress", "smallest"), (NORMAL_STRAIN.name, "largest"))
#: Distances from the axis, up to 1.3 of the largest contact radius: the fall of swt outside it is seen.
_RADII, _REACH = 240, 1.3
#: No place is shown so near to the singular edge of a face, in a_H, where the pressure is infinite.
_BESIDE_EDGE = 1e-6
#: The same for stick and slip, whose map has a cell for each, and for the springs alone.
_SLIP_RADII, _SLIP_REACH, _SPRING_RADII = 601, 1.15, 301


def inspect_point(**parameters: object) -> xr.Dataset:
    """The stationary cycle of one parameter point, with the reason why s is what it is.

    Parameters
    ----------
    **parameters
        Names of `swtstudy.vocabulary.parameters.PARAMETERS`, a single value each; the others are as in
        Table 1.

    Returns
    -------
    xarray.Dataset
        The results of `swtstudy.solve`, and

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
          0 or not finite, or at the singular edge of a face, the largest swt that was sampled;
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
    (permanent, least, largest), (left, right) = cycle.radii, cycle.stick_zone
    b = float(cycle.profile.flat_radius)
    special = np.abs([left, right, permanent, least, largest, float(solved.critical_x), 1.001 * b, 0.999 * b])
    radius = np.union1d(np.linspace(0.0, _REACH * largest, _RADII + 1), special[np.isfinite(special)])
    # None where the pressure is infinite; the centre where a sharp tip has its maximum there.
    at_tip = (radius == 0.0) & (float(solved.critical_x) == 0.0)
    radius = radius[at_tip | ((radius > _BESIDE_EDGE) & (np.abs(radius - b) > _BESIDE_EDGE))]
    values, double_angles = cycle.along(radius)
    if float(solved.s) == 0.0:  # what is there is rounding
        values = np.zeros_like(values)
    x, double_angle = float(solved.critical_x), 2.0 * np.radians(float(solved.critical_angle))
    at_edge = bool(cycle.profile.singular) and abs(abs(x) - b) <= _BESIDE_EDGE
    if not np.isfinite(x) or at_edge:
        column, side = np.unravel_index(values.argmax(), values.shape)
        x = float((radius, -radius)[side][column])
        double_angle = (float(double_angles[column, side]) + np.pi) % (2.0 * np.pi) - np.pi
    instant = _instants(cycle, x)
    states = cycle.states(instant)
    criterion = CRITERIA[cycle.points.criterion]
    normal, moved = cycle.on_plane(x, double_angle, states)
    stress = cycle.stress(x, states)
    of_plane: Variables = {
        "normal_stress": ("time", normal, named("stress normal to the plane", r"\sigma_n")),
        criterion.swing.name: ("time", moved, named(criterion.swing.words, criterion.swing.symbol)),
        "sigma_xx": ("time", stress["xx"], named("stress xx", r"\sigma_{xx}")),
        "sigma_xz": ("time", stress["xz"], named("stress xz", r"\sigma_{xz}")),
    }
    if cycle.load.bulk_range.any():
        of_plane["bulk_stress"] = "time", stress["bulk"], named("bulk stress", r"\sigma_B")
    slip_radius = _SLIP_REACH * np.linspace(-largest if cycle.moved else 0.0, largest, _SLIP_RADII)
    time = turns_of(cycle.points) * instant
    slip = slip_map(slip_radius, time=time, **parameters)
    course, marked = _load_and_springs(cycle, instant, states, of_plane, np.abs(slip_radius))
    some: States = states[marked]

    def tractions(at: FloatArray) -> list[FloatArray]:
        """Pressure and traction on the half-space, (instant, x)."""
        stress = [cycle.stress(float(each), some) for each in at]
        return [-np.stack([each[name] for each in stress], axis=-1) for name in ("zz", "xz")]

    pressure, traction = tractions(radius)
    # Both are even in x if nothing moves the stick zone.
    both_tractions = _both_sides(tractions(-radius)[1] if cycle.moved else traction, traction)
    variables: Variables = {
        "stick_left": ((), left, named("left end of what always sticks", "x/a_H")),
        "stick_right": ((), right, named("right end of what always sticks", "x/a_H")),
        "permanent_stick_radius": ((), permanent, named("radius that always sticks", "c/a_H")),
        "least_radius": ((), least, named("least contact radius", "a/a_H")),
        "largest_radius": ((), largest, named("largest contact radius", "a/a_H")),
        "shown_x": ((), x, named("position at which the stress is shown", "x/a_H")),
        "shown_angle": ((), np.degrees(double_angle) / 2.0, {"long_name": "plane shown", "units": "degree"}),
        "s_local": ("x", _both_sides(values[:, 1], values[:, 0]), named(criterion.words, criterion.symbol)),
        "pressure": (("instant", "x"), _both_sides(pressure, pressure), named("pressure", "p")),
        "traction": (("instant", "x"), both_tractions, named("tangential traction in +x", "q")),
    }
    position = named("position in the direction of sliding", "x/a_H")
    found = slip.assign(variables).assign_coords(x=("x", _both_sides(-radius, radius), position))
    return found.assign(course.drop_vars(("time", "r"))).merge(solved)


def _both_sides(left: FloatArray, right: FloatArray) -> FloatArray:
    """Values at −r and at +r, from left to right along the last axis."""
    return np.concatenate([left[..., ::-1], right], axis=-1)


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
    instant = _instants(cycle)
    radius = np.linspace(0.0, cycle.radii[2], _SPRING_RADII)
    found, _ = _load_and_springs(cycle, instant, cycle.states(instant), {}, radius)
    found["largest_radius"] = (), cycle.radii[2], named("largest contact radius", "a/a_H")
    return found.assign_coords(control=cycle.points.control.name)


def _instants(cycle: LoadCycle, x: float | None = None) -> FloatArray:
    """Instants of the cycle for smooth curves, as angles of its period, with events, also at x/a_H."""
    count = max(_UNIFORM * min(cycle.oscillations, _FEW), _SPARSE * cycle.oscillations)
    return np.union1d(cycle.instants(_STEPS, x), 2.0 * np.pi * np.arange(count + 1) / count)


def _load_and_springs(
    cycle: LoadCycle, instant: FloatArray, states: States, of_plane: Variables, radius: FloatArray
) -> tuple[xr.Dataset, IndexArray]:
    """The course of the load over the cycle, and the springs at marked instants.

    Parameters
    ----------
    cycle
        Parameters of one point.
    instant, states
        T instants, as angles of the period, and the states of the contact there.
    of_plane
        Further curves over time: stress and strain on the critical plane.
    radius
        Distances of springs from the axis.

    Returns
    -------
    found, marked
        Loads, responses and the edge's state over time; compression and force over the marked instants and r,
        which show the memory diagram. And the indices of the marked instants.
    """
    plane = cycle.profile.plane
    given = states["normal"].copy(), states["tangential"].copy()
    answers = states["other_normal"].copy(), states["answer"].copy()
    forces, motion = (given, answers) if plane or cycle.profile.in_force else (answers, given)
    curves: Variables = {}
    if not plane:  # there only changes of displacements at constant load are known
        curves["depth"] = "time", motion[0], named("indentation depth", r"\delta/\delta_0")
        words = named("tangential displacement", r"G^* u/(\mu E^* \delta_0)")
        curves["displacement"] = "time", motion[1], words
    curves["normal_force"] = "time", forces[0], named("normal force", "F_N/F_0")
    curves["tangential_force"] = "time", forces[1], named("tangential force", r"F_x/(\mu F_0)")
    curves |= of_plane
    time = turns_of(cycle.points) * instant
    marked, reasons = marked_instants(time / time[-1], {name: part[1] for name, part in curves.items()})
    # The state of the outermost springs between each instant and the next, numbered as in `slip_map`.
    middle = cycle.states(0.5 * (instant + np.append(instant[1:], instant[-1])))
    sticks = middle.front >= (1.0 - 1e-12) * middle.normal
    edge = np.where(middle.normal > 0.0, np.where(sticks, 1, np.where(middle.push > 0, 2, 3)), 0)
    compression, force = cycle.springs(radius, states[marked])
    of_compression = named("compression of the springs", r"w/\delta_0")
    of_force = named("tangential force of the springs", r"G^* u_{MDR}/(\mu E^* \delta_0)")
    if plane:
        of_compression = named("normal force beyond that of the strip", "w/F_0")
        of_force = named("tangential force in the diagram", r"\tau/(\mu F_0)")
    curves["compression"] = ("instant", "r"), compression, of_compression
    curves["force"] = ("instant", "r"), force, of_force
    words = {"long_name": "state of the contact next to its edge, until the next instant"}
    curves["edge_state"] = "time", edge.astype(np.int8), words | flag_attributes(STATES)
    coordinates = {
        "time": labelled_time(cycle.points, time, ("time",)),
        "r": ("r", radius, named("distance from the axis", "r/a_H")),
        "instant": np.arange(1, len(marked) + 1),
        "instant_time": ("instant", time[marked]),
        "reason": ("instant", reasons),
    }
    return xr.Dataset(curves, coordinates), marked


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
    normal, tangential, *_ = (name for name in _LETTERS if name in curves)
    of_plane = [name for name in _OF_PLANE if name in curves]
    touching = curves[normal] > 0.0
    marked: dict[int, str] = {}

    def distance() -> FloatArray:
        """Distance in cycles to the nearest instant that is marked already."""
        away = (np.abs((share - share[index] + 0.5) % 1.0 - 0.5) for index in marked)
        return np.min([np.ones(share.size), *away], axis=0)

    for name, end in itertools.product((*of_plane, normal, tangential), ("largest", "smallest")):
        index = int(curves[name].argmax() if end == "largest" else curves[name].argmin())
        free = len(marked) < _MARKED and distance()[index] >= _APART
        # The largest normal stress, and the swing of the strain up to it, make s.
        if free and (name in of_plane or touching[index]) and (name, end) not in _OF_NO_MATTER:
            marked[index] = f"{_LETTERS[name]} {end}"
    moving = curves[of_plane[-1] if of_plane else tangential]
    while len(marked) < _MARKED and np.ptp(moving) > 0.0:
        marked[int(np.where(touching, distance(), -1.0).argmax())] = "in between"
    order = sorted(marked)
    return np.array(order), [marked[index] for index in order]
