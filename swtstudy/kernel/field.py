"""Stress and criterion at places of the body of one point: named arrays in, arrays out."""

from typing import NamedTuple

import numpy as np

from swtstudy.kernel.along import map_line, plane_at
from swtstudy.kernel.at_place import MAX_SEEN
from swtstudy.kernel.batch import _refuse_overflow, chunks, memory
from swtstudy.kernel.beneath import PLACE, edges, stress_field
from swtstudy.kernel.body import HERE, OF_BODY, largest_at_places, von_mises_at_places
from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.contact import CYCLE, solve_cycle
from swtstudy.kernel.criterion import SWT, far_field
from swtstudy.kernel.growth import GROWTH, lay_out
from swtstudy.kernel.history import HISTORY
from swtstudy.kernel.mean import CELLS, FIRST, mean_at
from swtstudy.kernel.parts import COARSEST
from swtstudy.kernel.point import OF_POINT
from swtstudy.kernel.profile import place_of, radius_of
from swtstudy.kernel.shift import centre_of, shift_of

#: Tolerance of what grew, of the stress itself: 1e-8 of the largest pressure.
OF_GROWTH = 1e-7
#: Intervals of the smooth parts of the cycle at first, where many values are averaged and for single ones.
MANY, SINGLE = COARSEST, 2 * COARSEST
#: Whether a place takes the plane of the one before as a guess: its value depends on the others then.
AVERAGED, ALONE = np.arange(2)
#: The gaps beside the extremes of a history are divided so finely, so often.
CLOSER, LOOKS = 6, 3


class Opened(NamedTuple):
    """The load cycle of one point, solved; in the memory of the thread until it opens the next one.

    Attributes
    ----------
    contact, growth, profile, load, ask
        Records of CYCLE, GROWTH, PROFILE, LOAD and ASK.
    largest
        Place s of the largest contact.
    """

    contact: np.record
    growth: np.record
    profile: np.record
    load: np.record
    ask: np.record
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
    C, R = memory(CYCLE, GROWTH)
    P, L, Q = profiles[0], loads[0], asks[0]
    solve_cycle(C, L)
    if C["no_equilibrium"]:
        return None
    _refuse_overflow(C["overflow"])
    C["shift"] = shift_of(L, P, Q, C["event"], np.int64(C["events"]))
    lay_out(R, C, P, L, tolerance)
    return Opened(C, R, P, L, Q, float(place_of(P, float(C["largest"]))))


def instants_of(opened, angle):
    """Instants of the record from angles of the common period, [0, 2π)."""
    load = opened.load
    return np.mod(angle * (load["rounds"] * load["period"] / (2.0 * np.pi)), load["period"])


def contact_radii(opened, angle):
    """Contact radius at angles of the common period, (m,), in a_H; 0 out of contact."""
    radius = np.empty(angle.size)
    edges(opened.profile, opened.load, instants_of(opened, angle), radius)
    return radius


def largest_radius(opened):
    """Largest contact radius of the cycle in a_H."""
    return float(radius_of(opened.profile, opened.largest))


def passed_radii(opened, most):
    """Radii that edges and fronts pass and at which pieces start, ascending; at most so many."""
    C, _, P, *_ = opened
    pieces, stretches = int(C["pieces"]), int(C["stretches"])
    starts = C["start_s"][:pieces][C["used"][:pieces] == 1]
    every = np.unique(np.concatenate([starts, C["place"][:stretches, :: FINEST // 4].ravel()]))
    if C["shift"] != 0.0:
        off = [centre_of(P, C["shift"], C["largest"], opened.largest, s) for s in every]
        every = np.unique(np.abs(np.concatenate([every, every + off, every - off])))
    if len(every) > most:
        every = every[np.round(np.linspace(0, len(every) - 1, most)).astype(int)]
    return np.sqrt(every * every + float(P["flat_radius"]) ** 2)


def far_field_of(opened):
    """The criterion far from the contact, where there is the bulk stress alone."""
    low, high = map(float, opened.load["bulk_range"])
    return float(far_field(opened.ask, high, low, opened.profile["plane"])[0])


def stress_at(opened, places, angle):
    """Stress at places (n, 3) in a_H and angles of the common period (m,), shape (n, m, 6)."""
    C, R, P, L, Q, largest = opened
    (B,) = memory(PLACE)
    stress = np.empty((len(places), angle.size, 6))
    stress_field(B, C, R, P, L, Q, places, instants_of(opened, angle), largest, stress)
    _refuse_overflow(B["overflow"])
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
    C, R, P, L, Q, largest = opened
    B, S, G, H, W, K = memory(*OF_BODY, *OF_POINT[3:])
    found, normals = np.empty((len(places), 2)), np.empty((len(places), 3))
    own = places, largest, floor, tolerance, coarsest, AVERAGED if coarsest == MANY else ALONE
    largest_at_places(S, B, H, W, G, C, R, P, K, L, Q, *own, found, normals)
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
    C, R, P, L, Q, largest = opened
    B, S, G, H, W, K, M = memory(*OF_BODY, *OF_POINT[3:], CELLS)
    own = kind, float(x), *direction, float(distance), largest, float(known), float(rtol), first
    mean_at(M, S, B, H, W, G, C, R, P, K, L, Q, *own)
    _refuse_overflow(np.isnan(M["average"]))
    return float(M["average"]), float(M["error"])


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
    C, R, P, L, Q, _ = opened
    S, H, W, K = memory(*OF_POINT[2:])
    Q = Q.copy()
    Q["near"] = min(float(Q["near"]), limit / s)
    map_line(S, H, W, C, R, P, K, L, Q, float(limit))
    count = min(int(S["positions"]), MAX_SEEN)
    place, value = S["seen"][:count], S["seen_value"][:count]
    x = np.sqrt(np.maximum(float(P["flat_radius"]) ** 2 + place * np.abs(place), 0.0))
    if not L["mirrored"]:
        x, value = np.concatenate([-x, x]), np.concatenate([value[:, 1], value[:, 0]])
    else:
        value = value[:, 0]
    order = np.argsort(x, kind="stable")
    order = order[value[order] >= 0.0]
    return x[order], value[order]


def direction_at(opened, x):
    """Direction into the body along the critical plane at x of the surface line: to the right, and down."""
    C, R, P, L, Q, largest = opened
    S, H, W, K = memory(*OF_POINT[2:])
    angle = 0.5 * plane_at(S, H, W, C, R, P, K, L, Q, largest, float(x))
    sign = 1.0 if np.cos(angle) >= 0.0 else -1.0
    return -np.sin(angle) * sign, np.cos(angle) * sign


def von_mises_at(opened, places):
    """Largest von Mises stress of the cycle at places (n, 3), in E* δ0/a_H."""
    C, R, P, L, Q, largest = opened
    H, B, S = memory(HISTORY, PLACE, HERE)
    values = np.empty(len(places))
    von_mises_at_places(S, B, H, C, R, P, L, Q, places, largest, values)
    _refuse_overflow(np.isnan(values).any())
    return values


def instants_at(opened, place, tolerance):
    """Angles of the common period, ascending, that tell the criterion at a place (3,) to a tolerance.

    They include the angles that gave the value, and others close to the extremes of its curves.
    """
    normal = criterion_at(opened, place[None], tolerance)[2][0]
    load, (H,) = opened.load, memory(HISTORY)
    time = [
        H["instant"][first : first + count + 1] + 0.5 * load["period"] * mirrored
        for first, count, mirrored in zip(
            *(H[name][: H["parts"]] for name in ("first", "intervals", "mirror")), strict=True
        )
    ]
    angle = np.mod(np.concatenate(time) * (2.0 * np.pi / load["period"]), 2.0 * np.pi)
    angle = np.unique(np.concatenate([angle, [0.0, 2.0 * np.pi]]))
    nu = float(opened.ask["poisson_ratio"]) if opened.ask["criterion"] == SWT else 0.0
    share = np.arange(1, CLOSER) / CLOSER
    for _ in range(LOOKS):
        stress = stress_at(opened, place[None], angle / load["rounds"])[0]
        curves = curves_on_plane(stress, normal, nu, opened.ask["criterion"] == SWT)
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
