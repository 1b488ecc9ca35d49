"""The tangential component that is not prescribed, and what follows from it: work and force ratio of a cycle.

With o the offsets of the springs over the diagram's coordinate (`swtstudy.kernel.contact`) it is

    ∫ o′ dC,   C = N(ξ)/N(δ0), g(ξ)/δ0 or -½ ∫ ln ξ dN:

C is the other coordinate of the contact radius. The force answers to displacements, the displacement to
forces, in a plane contact but for a constant share of the force. In units of μF_0 and μE*δ0/G*.

The spring at G dissipates |τ do|, and slips with τ = n - G while α rises or β falls. So the work is

    ∮ |d(v ∓ n)| ∫ (n - G) dC′,   G from the front f to the edge n,
    ∫ (n - G) dC′ = C(n) - C(f) - (n - f) C′(f),

with the sign of C″ positive for displacements and negative for forces. A stick zone that a bulk stress moves
leaves all of this as it is but for the work, which rises by `swtstudy.kernel.shift.more_work`.
"""

from math import cos, log, nan, pi, sin

import numpy as np

from swtstudy.kernel.chebyshev import clenshaw, gauss_legendre, panel_of, vertex
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import GROWN, MAX_PIECES, NONE, OPEN, STICK, solve_cycle
from swtstudy.kernel.control import NODE, WEIGHT, rise
from swtstudy.kernel.events import force_ratio, slide, stick_limit, turning_points
from swtstudy.kernel.growth import MAX_GROWN, lay_out, solved_places
from swtstudy.kernel.load import load_at, rates_at
from swtstudy.kernel.profile import (
    MAX_PANELS,
    MEAN_LOAD,
    any_power,
    coordinate_at,
    coordinate_on,
    force_at,
    place_of,
    radius_of,
)
from swtstudy.kernel.shift import more_work, shift_of

CONJUGATE = np.dtype(
    [
        ("unit", "f8"),  # ∫ ξ dG up to G = 1: half the normal force at the depth δ0
        ("before", "f8", (MAX_PANELS + 1,)),  # what C needs up to the lower ends of the profile's panels
        ("grown", "f8", (MAX_GROWN + 1,)),  # ∫ o′ dC from the start of what grew up to its panels' lower ends
        # By piece ∫ o′ dC up to its start; by stretch the largest force ratio, as seen.
        *fields("f8", "inside top", (MAX_PIECES,)),
    ]
)
OF_CYCLE = np.dtype(
    [
        *fields("f8", "work work_error"),  # of a round, over μF_0 · μE*δ0/G*
        ("stick_radius", "f8"),  # NaN where nothing sticks throughout
        *fields("f8", "stick_left stick_right"),  # x of the ends of the permanent stick zone
        ("contact_radius", "f8"),  # largest of the cycle
        ("force_ratio", "f8"),  # largest |F_x|/(μ F_N)
        *fields("i8", "no_equilibrium overflow"),
    ]
)
MARGIN = np.dtype(
    [
        ("contact_radius", "f8"),  # largest of the cycle
        ("stick_radius", "f8"),  # of permanent stick; NaN where there is none
        ("force_ratio", "f8"),  # as prescribed; NaN where it is not
        ("slide", "f8"),  # displacement beyond the limit of partial slip; NaN if there is none to tell
        ("moved", "i8"),  # 1: the bulk stress moves the stick zone
    ]
)

#: Slip zones narrower than this share of the radius have a small difference of large C: it is integrated.
NARROW, OF_WAVE = 0.02, 0.25
#: Gauss points in time, doubled from the first to the last, all on [-1, 1] in one array.
LEAST_POINTS, MOST_POINTS = np.int64(8), np.int64(256)


def _rules():
    """Nodes and weights of Gauss's rule of m points from m on, m a power of two."""
    nodes, weights = np.zeros((2, 2 * MOST_POINTS))
    m = int(LEAST_POINTS)
    while m <= MOST_POINTS:
        nodes[m : 2 * m], weights[m : 2 * m] = gauss_legendre(m)
        m *= 2
    return nodes, weights


TIME_NODE, TIME_WEIGHT = _rules()
#: A stretch of time has points enough where twice as many change the work of the cycle by less than this.
ENOUGH = 1e-8
#: Error of the work over its last change, its least relative one, and of a coordinate over the largest one.
OF_CHANGE, LEAST_ERROR, ROUNDING = 6.0, 1e-8, 4e-16
#: Contact is lost where the normal force is below this share of its largest value.
LOST = 1e-9
#: Steps of a stretch of time between which the largest force ratio is looked for, steps of a closer look,
#: how often there is one, and how far below the largest sample a stretch is still looked at closely.
STEPS, CLOSE_STEPS, LOOKS, BELOW = np.int64(16), np.int64(8), 2, 0.01
#: Series of what grew in stick, relative to dv/dn.
GROWTH_TOLERANCE = 1e-9


@jit
def weight_of(P, U, s):
    """dC over the density's ds, at a place s."""
    xi = radius_of(P, s)
    if P.plane:
        return -0.5 * log(xi) / MEAN_LOAD
    return 1.0 if P.in_force else xi / U.unit


@jit
def slope_at(P, U, s):
    """C′, by the diagram's coordinate."""
    xi = radius_of(P, s)
    if P.plane:
        return -0.5 * log(xi)
    return U.unit / xi if P.in_force else xi / U.unit


@jit
def bend_at(P, U, s):
    """dC′/ds, without its sign."""
    xi = radius_of(P, s)
    if P.plane:
        return 0.5 * s / (xi * xi)
    return U.unit * s / (xi * xi * xi) if P.in_force else s / (xi * U.unit)


@jit
def integral(P, a, b):
    """∫ N dξ/ξ of a strip, or G, from s = a to b within a panel of the profile."""
    if P.plane == 0:
        return rise(P, a, b)
    p = panel_of(P.begin, 0, P.panels, 0.5 * (a + b))
    total = 0.0
    for i in range(NODE.shape[0]):
        s = a + 0.5 * (b - a) * (NODE[i] + 1.0)
        xi = radius_of(P, s)
        total += WEIGHT[i] * coordinate_on(P, p, s) * s / (xi * xi)
    return 0.5 * (b - a) * total


@jit
def other_at(P, U, s):
    """The other coordinate C at a place s."""
    if s <= 0.0:
        return 0.0
    n = P.exponent
    if P.plane == 0 and P.in_force == 0:
        return force_at(P, s) / U.unit
    if n > 0.0:
        total = any_power(s, n)
        return total * (0.5 / n - 0.5 * log(s)) if P.plane else total
    p = panel_of(P.begin, 0, P.panels, s)
    total = U.before[p] + integral(P, P.begin[p], s)
    return 0.5 * (total - coordinate_on(P, p, s) * log(radius_of(P, s))) if P.plane else total


@jit
def unit_of(P):
    """∫ ξ dG up to G = 1."""
    n = P.exponent
    if n > 0.0:
        return n / (n + 1.0)
    return P.unit if P.in_force else force_at(P, place_of(P, 1.0))


@jit
def tabulate_other(U, P):
    """Prepare the other coordinate of a profile."""
    U.unit = 1.0 if P.plane else unit_of(P)
    if P.exponent > 0.0 or (P.plane == 0 and P.in_force == 0):
        return
    U.before[0] = 0.0
    for p in range(P.panels):
        U.before[p + 1] = U.before[p] + integral(P, P.begin[p], P.end[p])


@jit
def grown_from(R, P, U, k, s):
    """∫ o′ dC over panel k of what grew, up to s."""
    a, b = R.begin[k], min(s, R.end[k])
    width, total = 2.0 / (R.end[k] - a), 0.0
    for i in range(NODE.shape[0]):
        at = a + 0.5 * (b - a) * (NODE[i] + 1.0)
        total += WEIGHT[i] * clenshaw(R.density[k], (at - a) * width - 1.0) * weight_of(P, U, at)
    return 0.5 * (b - a) * total


@jit
def over_piece(C, R, P, U, i, s):
    """∫ o′ dC over piece i, from its start up to s."""
    if s <= C.start_s[i]:
        return 0.0
    if C.kind[i] != GROWN:
        slope = C.slope[i]
        return slope * (other_at(P, U, s) - other_at(P, U, C.start_s[i])) if slope != 0.0 else 0.0
    first, last = R.first[i], R.last[i]
    if first == last or s <= R.begin[first]:
        return 0.0
    k = panel_of(R.begin, first, last, s)
    return U.grown[k] + grown_from(R, P, U, k, s)


@jit
def tabulate_answer(U, C, R, P):
    """Prepare the component that is not prescribed; the diagram lies on the radius."""
    for i in range(C.pieces):
        if C.used[i] == 0:
            continue
        if C.kind[i] == GROWN:
            total = 0.0
            for k in range(R.first[i], R.last[i]):
                U.grown[k] = total
                total += grown_from(R, P, U, k, R.end[k])
        beneath = C.beneath[i]
        U.inside[i] = 0.0
        if beneath != NONE:
            U.inside[i] = U.inside[beneath] + over_piece(C, R, P, U, beneath, C.start_s[i])


@jit
def answer_at(C, R, P, U, k, edge, front):
    """The component that is not prescribed, in stretch k with its edge and front at these places s."""
    push, i = C.push[k], C.piece[k]
    if push == OPEN or edge <= 0.0:
        return 0.0
    if i == NONE:
        return push * other_at(P, U, edge)
    total = U.inside[i] + over_piece(C, R, P, U, i, front)
    if push != STICK:
        total += push * (other_at(P, U, edge) - other_at(P, U, front))
    return total


@jit
def slipped(P, U, n, edge, front, whole):
    """∫ (n - G) dC′ over the slip zone, without its sign, and n - G at the front."""
    if whole or (front <= 0.0 and P.flat_radius == 0.0):
        return abs(other_at(P, U, edge)), n
    width = n - coordinate_at(P, front)
    if edge - front > min(NARROW * edge, OF_WAVE * P.longest):
        return abs(other_at(P, U, edge) - other_at(P, U, front) - width * slope_at(P, U, front)), width
    total = 0.0
    for i in range(NODE.shape[0]):
        s = front + 0.5 * (edge - front) * (NODE[i] + 1.0)
        total += WEIGHT[i] * (n - coordinate_at(P, s)) * bend_at(P, U, s)
    return 0.5 * (edge - front) * abs(total), width


@jit
def work_of(C, L, P, Q, U, k, m):
    """Work of stretch k by m points in time, and by how much rounding may change it."""
    begin, end, push, whole = C.time[k, 0], C.time[k, 1], C.push[k], C.piece[k] == NONE
    work, rounding = 0.0, 0.0
    for i in range(m, 2 * m):  # dense at both ends, where the front starts or arrives
        angle = 0.5 * pi * (TIME_NODE[i] + 1.0)
        t = begin + 0.5 * (end - begin) * (1.0 - cos(angle))
        n, v, dn, dv, ddn, ddv = rates_at(L, t)
        edge, front = solved_places(C, P, L, k, t)
        zone, width = slipped(P, U, n, edge, front, whole)
        if C.shift != 0.0:
            force, rate = width, 1.0
            if P.in_force == 0:
                force, rate = other_at(P, U, edge) - other_at(P, U, front), slope_at(P, U, front)
            zone += more_work(P, C.shift, Q.poisson_ratio, width, force, rate)
        moved = 0.25 * pi * (end - begin) * sin(angle) * TIME_WEIGHT[i] * abs(dv - push * dn)
        work += zone * moved
        if width > 0.0:
            rounding += zone * moved * ROUNDING * C.largest / width
    return work, rounding


@jit
def dissipate(C, L, P, Q, U, out):
    """Write the work of a round, and its error."""
    total, change, rounding = 0.0, 0.0, 0.0
    for k in range(C.stretches):
        if C.push[k] != STICK and C.push[k] != OPEN:
            total += work_of(C, L, P, Q, U, k, LEAST_POINTS)[0]
    least, total = ENOUGH * total, 0.0
    for k in range(C.stretches):
        if C.push[k] == STICK or C.push[k] == OPEN:
            continue
        m = LEAST_POINTS
        work, noise = work_of(C, L, P, Q, U, k, m)
        while m < MOST_POINTS:
            m *= 2
            before = work
            work, noise = work_of(C, L, P, Q, U, k, m)
            if abs(work - before) <= least:
                break
        total += work
        change += abs(work - before)
        rounding += noise
    rounds = (2.0 if L.mirrored else 1.0) * L.rounds
    out.work = rounds * total
    out.work_error = rounds * (OF_CHANGE * change + rounding + (LEAST_ERROR + P.left_out) * total)


@jit
def ratio_in(C, R, P, L, U, k, t, least):
    """|F_x|/(μ F_N) in stretch k, 0 without contact."""
    n, v = load_at(L, t)
    if P.in_force:
        return abs(v) / n if n > least else 0.0
    edge, front = solved_places(C, P, L, k, t)
    normal = other_at(P, U, edge)
    return abs(answer_at(C, R, P, U, k, edge, front)) / normal if normal > least else 0.0


@jit
def highest_in(C, R, P, L, U, k, least, low, high, steps):
    """Largest force ratio in stretch k between two angles, by parabolas, and the angle of the best sample."""
    begin, half, step = C.time[k, 0], 0.5 * (C.time[k, 1] - C.time[k, 0]), (high - low) / steps
    best, top, at, before, middle = 0.0, 0.0, low, 0.0, 0.0
    for j in range(steps + 1):
        angle = low + step * j
        ratio = ratio_in(C, R, P, L, U, k, begin + half * (1.0 - cos(angle)), least)
        if ratio > top:
            top, at = ratio, angle
        best = max(best, ratio)
        if j > 1 and before < middle > ratio:
            best = max(best, vertex(-1.0, 0.0, 1.0, before, middle, ratio)[1])
        before, middle = middle, ratio
    return best, at


@jit
def largest_ratio(C, R, P, L, U):
    """Largest |F_x|/(μ F_N) while there is contact."""
    force = C.largest if P.in_force else other_at(P, U, place_of(P, C.largest))
    least, largest = LOST * force, 0.0
    for k in range(C.stretches):
        U.top[k] = 0.0
        if C.push[k] != OPEN:
            U.top[k] = highest_in(C, R, P, L, U, k, least, 0.0, pi, STEPS)[0]
            largest = max(largest, U.top[k])
    if largest >= 1.0:
        return 1.0
    for k in range(C.stretches):
        if U.top[k] <= 0.0 or U.top[k] < largest - BELOW:
            continue
        low, high, steps, top = 0.0, pi, STEPS, 0.0
        for _ in range(LOOKS + 1):
            top, at = highest_in(C, R, P, L, U, k, least, low, high, steps)
            step = (high - low) / steps
            low, high, steps = max(at - step, 0.0), min(at + step, pi), CLOSE_STEPS
        U.top[k] = top
    largest = 0.0
    for k in range(C.stretches):
        largest = max(largest, U.top[k])
    return min(largest, 1.0)


@jit
def permanent_stick(L, P, T, m):
    """Radius inside of which springs never slip, NaN where there is none; T has m events."""
    limit = stick_limit(L, T, m)
    return radius_of(P, place_of(P, limit)) if limit >= 0.0 else nan


@jit
def largest_contact(L, P):
    """Largest radius of the contact."""
    return radius_of(P, place_of(P, L.normal_range[1]))


@jit
def cycle_of(C, R, P, L, Q, U, with_ratio, out):
    """Quantities of the cycle of one point: the force ratio only where asked, NaN out of equilibrium."""
    solve_cycle(C, L)
    out.no_equilibrium, out.overflow = C.no_equilibrium, C.overflow
    out.work, out.work_error, out.contact_radius, out.force_ratio = nan, nan, nan, nan
    out.stick_radius, out.stick_left, out.stick_right = nan, nan, nan
    if C.no_equilibrium or C.overflow:
        return
    tabulate_other(U, P)
    C.shift = shift_of(L, P, Q, C.event, C.events)
    dissipate(C, L, P, Q, U, out)
    out.stick_radius = permanent_stick(L, P, C.event, C.events)
    off = C.shift * (C.largest - max(stick_limit(L, C.event, C.events), 0.0))
    out.stick_left, out.stick_right = off - out.stick_radius, off + out.stick_radius
    out.contact_radius = largest_contact(L, P)
    if with_ratio:
        if P.in_force == 0:
            lay_out(R, C, P, L, GROWTH_TOLERANCE)
            tabulate_answer(U, C, R, P)
        out.force_ratio = largest_ratio(C, R, P, L, U)
        out.overflow = C.overflow


@jit
def cycles_of(C, R, U, with_ratio, profiles, which, loads, asks, out):
    """Quantities of the cycles of points: profile which[i], loads[i], asks[i]."""
    for i in range(which.shape[0]):
        cycle_of(C, R, profiles[which[i]], loads[i], asks[i], U, with_ratio, out[i])


@jit
def margins_of(C, profiles, which, loads, asks, out):
    """Write how far points are from where the model ends, by the load alone, also out of equilibrium."""
    for i in range(which.shape[0]):
        P, L = profiles[which[i]], loads[i]
        m = turning_points(L, C.event)
        out[i].contact_radius = largest_contact(L, P)
        out[i].stick_radius = permanent_stick(L, P, C.event, m)
        out[i].force_ratio = force_ratio(L, C.event, m)
        out[i].slide = slide(L, C.event, m)
        out[i].moved = shift_of(L, P, asks[i], C.event, m) != 0.0
