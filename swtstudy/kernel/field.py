"""Stress and criterion at places of the body of one point: named arrays in, arrays out."""

from typing import NamedTuple

import numpy as np

from swtstudy.kernel.along import map_line, plane_at
from swtstudy.kernel.at_place import MAX_SEEN
from swtstudy.kernel.batch import _refuse_overflow, chunks, memory
from swtstudy.kernel.beneath import edges, stress_field
from swtstudy.kernel.body import OF_BODY, largest_at_places, von_mises_at_places
from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.criterion import SWT, far_field
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.line import SEARCH
from swtstudy.kernel.mean import FIRST, MEAN, mean_at
from swtstudy.kernel.parts import COARSEST
from swtstudy.kernel.point import OF_POINT
from swtstudy.kernel.profile import place_of, radius_of
from swtstudy.kernel.records import Body, Point
from swtstudy.kernel.shift import centre_of, shift_of

#: Tolerance of what grew, of the stress itself: 1e-8 of the largest pressure.
OF_GROWTH = 1e-7
#: Intervals of the smooth parts of the cycle at first, where many values are averaged and for single ones.
MANY, SINGLE = COARSEST, 2 * COARSEST
#: Whether a place takes the plane of the one before as a guess: its value depends on the others then.
AVERAGED, ALONE = np.arange(2)
#: Radii at which something turns are left out only where there are so many times as many as were asked for.
CUSPS = 20
#: The gaps beside the extremes of a history are divided so finely, so often.
CLOSER, LOOKS = 6, 3


class Opened(NamedTuple):
    """The load cycle of one point, solved; in the memory of the thread until it opens the next one.

    Attributes
    ----------
    point
        The records of the point.
    largest
        Place s of the largest contact.
    """

    point: Point
    largest: float


def open_cycle(tolerance=OF_GROWTH, **given):
    """Solve the load cycle of one point.

    Parameters
    ----------
    tolerance
        Accuracy of the tables of the growth.
    given
        As of `swtstudy.kernel.batch.chunks`, of one point.

    Returns
    -------
    Opened
        None if there is no equilibrium.
    """
    _, profiles, _, loads, asks = next(iter(chunks(**given)))
    load, profile, ask, cycle, growth, *_ = point = Point(loads[0], profiles[0], asks[0], *memory(*OF_POINT))
    solve_cycle(cycle, load)
    if cycle["no_equilibrium"]:
        return None
    _refuse_overflow(cycle["overflow"])
    cycle["shift"] = shift_of(load, profile, ask, cycle["event"], np.int64(cycle["events"]))
    lay_out(growth, cycle, profile, load, tolerance)
    return Opened(point, float(place_of(profile, float(cycle["largest"]))))


def body_of(opened):
    """The records for places of the body of an opened point."""
    return Body(*memory(*OF_BODY), opened.point)


def instants_of(opened, angle):
    """Instants of the record from angles of the common period, [0, 2π)."""
    load = opened.point.load
    return np.mod(angle * (load["rounds"] * load["period"] / (2.0 * np.pi)), load["period"])


def contact_radii(opened, angle):
    """Contact radius at angles of the common period, (m,), in a_H; 0 out of contact."""
    radius = np.empty(angle.size)
    edges(opened.point.profile, opened.point.load, instants_of(opened, angle), radius)
    return radius


def largest_radius(opened):
    """Largest contact radius of the cycle in a_H."""
    return float(radius_of(opened.point.profile, opened.largest))


def passed_radii(opened, most):
    """Radii at which pieces start and at which edges and fronts turn, and some that these pass, ascending.

    At the former the stress has its cusps: of a usual cycle all are there, however few the others are. There
    are at most so many of the others, and `CUSPS` times as many of the former.
    """
    cycle, profile = opened.point.cycle, opened.point.profile
    pieces, stretches = int(cycle["pieces"]), int(cycle["stretches"])
    starts = cycle["start_s"][:pieces][cycle["used"][:pieces] == 1]
    passed = cycle["place"][:stretches, :: FINEST // 4]
    turns = np.unique(np.concatenate([starts, passed[:, [0, -1]].ravel()]))
    between = _some_of(np.setdiff1d(passed, turns), max(most - len(turns), 0))
    every = np.concatenate([_some_of(turns, CUSPS * most), between])
    if cycle["shift"] != 0.0:
        off = [centre_of(profile, cycle["shift"], cycle["largest"], opened.largest, s) for s in every]
        every = np.unique(np.abs(np.concatenate([every, every + off, every - off])))
    return np.sqrt(np.sort(every) ** 2 + float(profile["flat_radius"]) ** 2)


def _some_of(values, most):
    """At most so many of ascending values, evenly by their number."""
    return values[np.linspace(0, len(values) - 1, min(most, len(values))).round().astype(int)]


def far_field_of(opened):
    """The criterion far from the contact, where there is the bulk stress alone."""
    low, high = map(float, opened.point.load["bulk_range"])
    return float(far_field(opened.point.ask, high, low, opened.point.profile["plane"])[0])


def stress_at(opened, places, angle):
    """Stress at places (n, 3) in a_H and angles of the common period (m,), shape (n, m, 6)."""
    body, stress = body_of(opened), np.empty((len(places), angle.size, 6))
    stress_field(body, places, instants_of(opened, angle), opened.largest, stress)
    _refuse_overflow(body.below["overflow"])
    return stress


def criterion_at(opened, places, tolerance, floor=0.0, coarsest=SINGLE):
    """The criterion at places of the body, over planes of every orientation.

    Parameters
    ----------
    opened
        The load cycle.
    places
        Shape (n, 3): x, y, z in a_H.
    tolerance
        Relative.
    floor
        Values below it may be low.
    coarsest
        Intervals of the smooth parts of the cycle at first: `SINGLE`, or `MANY` for what is averaged.

    Returns
    -------
    values, missing
        Shape (n,): over E* δ0/R or E* δ0/a_H, and what they may miss.
    normals
        Shape (n, 3): unit normals of the planes; n and -n are one plane.
    """
    found, normals = np.empty((len(places), 2)), np.empty((len(places), 3))
    alone = AVERAGED if coarsest == MANY else ALONE
    own = opened.largest, floor, tolerance, coarsest, alone
    largest_at_places(body_of(opened), places, *own, found, normals)
    _refuse_overflow(np.isnan(found).any())
    return *found.T, normals


def mean_about(opened, kind, x, direction, distance, known, rtol, first=FIRST):
    """Mean of the criterion about a place of the surface line, and its absolute error.

    Parameters
    ----------
    opened
        The load cycle.
    kind
        Of `swtstudy.kernel.mean`: `SPHERE`, over a half sphere of radius ℓ, or half disc in the plane;
        `POINT`, at ℓ/2; `LINE`, over 0 … 2ℓ.
    x
        Signed, in a_H.
    direction
        Direction of the line: to the right, and down.
    distance
        ℓ > 0 in a_H.
    known
        The mean as far as it is known, or 0: values that are much lower are told roughly.
    rtol
        Relative accuracy asked for.
    first
        `FIRST`, or `ROUGHLY` of a mean that only leads to another: cells at first.
    """
    (mean,) = memory(MEAN)
    own = kind, float(x), *direction, float(distance), opened.largest, float(known), float(rtol), first
    mean_at(mean, body_of(opened), *own)
    _refuse_overflow(np.isnan(mean["average"]))
    return float(mean["average"]), float(mean["error"])


def surface_above(opened, limit, s):
    """The criterion along the surface line, closely where it exceeds a limit.

    Parameters
    ----------
    opened
        The load cycle.
    limit, s
        The limit, and the largest value.

    Returns
    -------
    x, values
        Shape (n,): ascending signed places in a_H, only x ≥ 0 of a mirrored load, and the values;
        values below the limit may be low.
    """
    (search,), ask = memory(SEARCH), opened.point.ask.copy()
    ask["near"] = min(float(ask["near"]), limit / s)
    map_line(search, opened.point._replace(ask=ask), float(limit))
    count = min(int(search["positions"]), MAX_SEEN)
    place, value = search["seen"][:count], search["seen_value"][:count]
    x = np.sqrt(np.maximum(float(opened.point.profile["flat_radius"]) ** 2 + place * np.abs(place), 0.0))
    if not opened.point.load["mirrored"]:
        x, value = np.concatenate([-x, x]), np.concatenate([value[:, 1], value[:, 0]])
    else:
        value = value[:, 0]
    order = np.argsort(x, kind="stable")
    order = order[value[order] >= 0.0]
    return x[order], value[order]


def direction_at(opened, x):
    """Direction into the body along the critical plane at x of the surface line: to the right, and down."""
    angle = 0.5 * plane_at(*memory(SEARCH), opened.point, opened.largest, float(x))
    sign = 1.0 if np.cos(angle) >= 0.0 else -1.0
    return -np.sin(angle) * sign, np.cos(angle) * sign


def von_mises_at(opened, places):
    """Largest von Mises stress of the cycle at places (n, 3), in E* δ0/a_H."""
    values = np.empty(len(places))
    von_mises_at_places(body_of(opened), places, opened.largest, values)
    _refuse_overflow(np.isnan(values).any())
    return values


def instants_at(opened, place, tolerance):
    """Angles of the common period, ascending, that tell the criterion at a place (3,) to a tolerance.

    They include the angles that gave the value, and others close to the extremes of its curves.
    """
    normal = criterion_at(opened, place[None], tolerance)[2][0]
    load, history, ask = opened.point.load, opened.point.history, opened.point.ask
    time = [
        history["instant"][first : first + count + 1] + 0.5 * load["period"] * mirrored
        for first, count, mirrored in zip(
            *(history[name][: history["parts"]] for name in ("first", "intervals", "mirror")), strict=True
        )
    ]
    angle = np.mod(np.concatenate(time) * (2.0 * np.pi / load["period"]), 2.0 * np.pi)
    angle = np.unique(np.concatenate([angle, [0.0, 2.0 * np.pi]]))
    nu = float(ask["poisson_ratio"]) if ask["criterion"] == SWT else 0.0
    share = np.arange(1, CLOSER) / CLOSER
    for _ in range(LOOKS):
        stress = stress_at(opened, place[None], angle / load["rounds"])[0]
        curves = curves_on_plane(stress, normal, nu, ask["criterion"] == SWT)
        ends = np.array([index for curve in curves for index in (curve.argmin(), curve.argmax())])
        left = np.unique(np.concatenate([ends - 1, ends]))
        left = left[(left >= 0) & (left < len(angle) - 1)]
        low, high = angle[left, None], angle[left + 1, None]
        angle = np.unique(np.concatenate([angle, (low + (high - low) * share).ravel()]))
    rounds = np.arange(load["rounds"])[:, None] * 2.0 * np.pi
    return ((angle + rounds) / load["rounds"]).ravel()


def curves_on_plane(stress, normal, nu, is_swt):
    """σ_n and the swing of a history (m, 6) on a plane; of a shear stress its two components."""
    rows = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])
    traction = stress[:, rows] @ normal
    tension = traction @ normal
    if is_swt:
        return tension, (1.0 + nu) * tension - nu * stress[:, :3].sum(axis=1)
    shear = traction - tension[:, None] * normal
    return tension, *shear.T
