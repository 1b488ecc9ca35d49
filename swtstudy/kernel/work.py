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
from swtstudy.kernel.events import force_ratio, slide, stick_limit, turning_points
from swtstudy.kernel.growth import MAX_GROWN, lay_out, solved_places
from swtstudy.kernel.load import load_at, rates_at
from swtstudy.kernel.loads import NODE, WEIGHT, rise
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
        ("moved", "i8"),  # 1: the bulk stress moves the stick zone; 2: nearly, it follows the load nearly
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
def weight_of(profile, conjugate, s):
    """dC over the density's ds, at a place s."""
    xi = radius_of(profile, s)
    if profile.plane:
        return -0.5 * log(xi) / MEAN_LOAD
    return 1.0 if profile.in_force else xi / conjugate.unit


@jit
def slope_at(profile, conjugate, s):
    """C′, by the diagram's coordinate."""
    xi = radius_of(profile, s)
    if profile.plane:
        return -0.5 * log(xi)
    return conjugate.unit / xi if profile.in_force else xi / conjugate.unit


@jit
def bend_at(profile, conjugate, s):
    """dC′/ds, without its sign."""
    xi = radius_of(profile, s)
    if profile.plane:
        return 0.5 * s / (xi * xi)
    return conjugate.unit * s / (xi * xi * xi) if profile.in_force else s / (xi * conjugate.unit)


@jit
def integral(profile, a, b):
    """∫ N dξ/ξ of a strip, or G, from s = a to b within a panel of the profile."""
    if profile.plane == 0:
        return rise(profile, a, b)
    p = panel_of(profile.begin, 0, profile.panels, 0.5 * (a + b))
    total = 0.0
    for i in range(NODE.shape[0]):
        s = a + 0.5 * (b - a) * (NODE[i] + 1.0)
        xi = radius_of(profile, s)
        total += WEIGHT[i] * coordinate_on(profile, p, s) * s / (xi * xi)
    return 0.5 * (b - a) * total


@jit
def other_at(profile, conjugate, s):
    """The other coordinate C at a place s."""
    if s <= 0.0:
        return 0.0
    n = profile.exponent
    if profile.plane == 0 and profile.in_force == 0:
        return force_at(profile, s) / conjugate.unit
    if n > 0.0:
        total = any_power(s, n)
        return total * (0.5 / n - 0.5 * log(s)) if profile.plane else total
    p = panel_of(profile.begin, 0, profile.panels, s)
    total = conjugate.before[p] + integral(profile, profile.begin[p], s)
    if profile.plane:
        total = 0.5 * (total - coordinate_on(profile, p, s) * log(radius_of(profile, s)))
    return total


@jit
def unit_of(profile):
    """∫ ξ dG up to G = 1."""
    n = profile.exponent
    if n > 0.0:
        return n / (n + 1.0)
    return profile.unit if profile.in_force else force_at(profile, place_of(profile, 1.0))


@jit
def tabulate_other(conjugate, profile):
    """Prepare the other coordinate of a profile."""
    conjugate.unit = 1.0 if profile.plane else unit_of(profile)
    if profile.exponent > 0.0 or (profile.plane == 0 and profile.in_force == 0):
        return
    conjugate.before[0] = 0.0
    for p in range(profile.panels):
        conjugate.before[p + 1] = conjugate.before[p] + integral(profile, profile.begin[p], profile.end[p])


@jit
def grown_from(growth, profile, conjugate, k, s):
    """∫ o′ dC over panel k of what grew, up to s."""
    a, b = growth.begin[k], min(s, growth.end[k])
    width, total = 2.0 / (growth.end[k] - a), 0.0
    for i in range(NODE.shape[0]):
        at = a + 0.5 * (b - a) * (NODE[i] + 1.0)
        density = clenshaw(growth.density[k], (at - a) * width - 1.0)
        total += WEIGHT[i] * density * weight_of(profile, conjugate, at)
    return 0.5 * (b - a) * total


@jit
def over_piece(cycle, growth, profile, conjugate, i, s):
    """∫ o′ dC over piece i, from its start up to s."""
    if s <= cycle.start_s[i]:
        return 0.0
    if cycle.kind[i] != GROWN:
        if cycle.slope[i] == 0.0:
            return 0.0
        start = other_at(profile, conjugate, cycle.start_s[i])
        return cycle.slope[i] * (other_at(profile, conjugate, s) - start)
    first, last = growth.first[i], growth.last[i]
    if first == last or s <= growth.begin[first]:
        return 0.0
    k = panel_of(growth.begin, first, last, s)
    return conjugate.grown[k] + grown_from(growth, profile, conjugate, k, s)


@jit
def tabulate_answer(conjugate, cycle, growth, profile):
    """Prepare the component that is not prescribed; the diagram lies on the radius."""
    for i in range(cycle.pieces):
        if cycle.used[i] == 0:
            continue
        if cycle.kind[i] == GROWN:
            total = 0.0
            for k in range(growth.first[i], growth.last[i]):
                conjugate.grown[k] = total
                total += grown_from(growth, profile, conjugate, k, growth.end[k])
        beneath = cycle.beneath[i]
        conjugate.inside[i] = 0.0
        if beneath != NONE:
            inside = over_piece(cycle, growth, profile, conjugate, beneath, cycle.start_s[i])
            conjugate.inside[i] = conjugate.inside[beneath] + inside


@jit
def answer_at(cycle, growth, profile, conjugate, k, edge, front):
    """The component that is not prescribed, in stretch k with its edge and front at these places s."""
    push, i = cycle.push[k], cycle.piece[k]
    if push == OPEN or edge <= 0.0:
        return 0.0
    if i == NONE:
        return push * other_at(profile, conjugate, edge)
    total = conjugate.inside[i] + over_piece(cycle, growth, profile, conjugate, i, front)
    if push != STICK:
        total += push * (other_at(profile, conjugate, edge) - other_at(profile, conjugate, front))
    return total


@jit
def slipped(profile, conjugate, n, edge, front, whole):
    """∫ (n - G) dC′ over the slip zone, without its sign, and n - G at the front."""
    if whole or (front <= 0.0 and profile.flat_radius == 0.0):
        return abs(other_at(profile, conjugate, edge)), n
    width = n - coordinate_at(profile, front)
    if edge - front > min(NARROW * edge, OF_WAVE * profile.longest):
        rise_of_other = other_at(profile, conjugate, edge) - other_at(profile, conjugate, front)
        return abs(rise_of_other - width * slope_at(profile, conjugate, front)), width
    total = 0.0
    for i in range(NODE.shape[0]):
        s = front + 0.5 * (edge - front) * (NODE[i] + 1.0)
        total += WEIGHT[i] * (n - coordinate_at(profile, s)) * bend_at(profile, conjugate, s)
    return 0.5 * (edge - front) * abs(total), width


@jit
def work_of(cycle, load, profile, ask, conjugate, k, m):
    """Work of stretch k by m points in time, and by how much rounding may change it."""
    begin, end, push, whole = cycle.time[k, 0], cycle.time[k, 1], cycle.push[k], cycle.piece[k] == NONE
    work, rounding = 0.0, 0.0
    for i in range(m, 2 * m):  # dense at both ends, where the front starts or arrives
        angle = 0.5 * pi * (TIME_NODE[i] + 1.0)
        t = begin + 0.5 * (end - begin) * (1.0 - cos(angle))
        n, v, dn, dv, ddn, ddv = rates_at(load, t)
        edge, front = solved_places(cycle, profile, load, k, t)
        zone, width = slipped(profile, conjugate, n, edge, front, whole)
        if cycle.shift != 0.0:
            force, rate = width, 1.0
            if profile.in_force == 0:
                force = other_at(profile, conjugate, edge) - other_at(profile, conjugate, front)
                rate = slope_at(profile, conjugate, front)
            zone += more_work(profile, cycle.shift, ask.poisson_ratio, width, force, rate)
        moved = 0.25 * pi * (end - begin) * sin(angle) * TIME_WEIGHT[i] * abs(dv - push * dn)
        work += zone * moved
        if width > 0.0:
            rounding += zone * moved * ROUNDING * cycle.largest / width
    return work, rounding


@jit
def dissipate(cycle, load, profile, ask, conjugate, out):
    """Write the work of a round, and its error."""
    total, change, rounding = 0.0, 0.0, 0.0
    for k in range(cycle.stretches):
        if cycle.push[k] != STICK and cycle.push[k] != OPEN:
            total += work_of(cycle, load, profile, ask, conjugate, k, LEAST_POINTS)[0]
    least, total = ENOUGH * total, 0.0
    for k in range(cycle.stretches):
        if cycle.push[k] == STICK or cycle.push[k] == OPEN:
            continue
        m = LEAST_POINTS
        work, noise = work_of(cycle, load, profile, ask, conjugate, k, m)
        while m < MOST_POINTS:
            m *= 2
            before = work
            work, noise = work_of(cycle, load, profile, ask, conjugate, k, m)
            if abs(work - before) <= least:
                break
        total += work
        change += abs(work - before)
        rounding += noise
    rounds = (2.0 if load.mirrored else 1.0) * load.rounds
    out.work = rounds * total
    out.work_error = rounds * (OF_CHANGE * change + rounding + (LEAST_ERROR + profile.left_out) * total)


@jit
def ratio_in(cycle, growth, profile, load, conjugate, k, t, least):
    """|F_x|/(μ F_N) in stretch k, 0 without contact."""
    n, v = load_at(load, t)
    if profile.in_force:
        return abs(v) / n if n > least else 0.0
    edge, front = solved_places(cycle, profile, load, k, t)
    normal = other_at(profile, conjugate, edge)
    tangential = answer_at(cycle, growth, profile, conjugate, k, edge, front)
    return abs(tangential) / normal if normal > least else 0.0


@jit
def highest_in(cycle, growth, profile, load, conjugate, k, least, low, high, steps):
    """Largest force ratio in stretch k between two angles, by parabolas, and the angle of the best sample."""
    begin, half, step = cycle.time[k, 0], 0.5 * (cycle.time[k, 1] - cycle.time[k, 0]), (high - low) / steps
    best, top, at, before, middle = 0.0, 0.0, low, 0.0, 0.0
    for j in range(steps + 1):
        angle = low + step * j
        ratio = ratio_in(cycle, growth, profile, load, conjugate, k, begin + half * (1.0 - cos(angle)), least)
        if ratio > top:
            top, at = ratio, angle
        best = max(best, ratio)
        if j > 1 and before < middle > ratio:
            best = max(best, vertex(-1.0, 0.0, 1.0, before, middle, ratio)[1])
        before, middle = middle, ratio
    return best, at


@jit
def largest_ratio(cycle, growth, profile, load, conjugate):
    """Largest |F_x|/(μ F_N) while there is contact."""
    force = cycle.largest
    if profile.in_force == 0:
        force = other_at(profile, conjugate, place_of(profile, cycle.largest))
    least, largest = LOST * force, 0.0
    for k in range(cycle.stretches):
        conjugate.top[k] = 0.0
        if cycle.push[k] != OPEN:
            top, _ = highest_in(cycle, growth, profile, load, conjugate, k, least, 0.0, pi, STEPS)
            conjugate.top[k] = top
            largest = max(largest, conjugate.top[k])
    if largest >= 1.0:
        return 1.0
    for k in range(cycle.stretches):
        if conjugate.top[k] <= 0.0 or conjugate.top[k] < largest - BELOW:
            continue
        low, high, steps, top = 0.0, pi, STEPS, 0.0
        for _ in range(LOOKS + 1):
            top, at = highest_in(cycle, growth, profile, load, conjugate, k, least, low, high, steps)
            step = (high - low) / steps
            low, high, steps = max(at - step, 0.0), min(at + step, pi), CLOSE_STEPS
        conjugate.top[k] = top
    largest = 0.0
    for k in range(cycle.stretches):
        largest = max(largest, conjugate.top[k])
    return min(largest, 1.0)


@jit
def permanent_stick(load, profile, events, m):
    """Radius inside of which springs never slip, NaN where there is none; there are m events."""
    limit = stick_limit(load, events, m)
    return radius_of(profile, place_of(profile, limit)) if limit >= 0.0 else nan


@jit
def largest_contact(load, profile):
    """Largest radius of the contact."""
    return radius_of(profile, place_of(profile, load.normal_range[1]))


@jit
def cycle_of(cycle, growth, profile, load, ask, conjugate, with_ratio, out):
    """Quantities of the cycle of one point: the force ratio only where asked, NaN out of equilibrium."""
    solve_cycle(cycle, load)
    out.no_equilibrium, out.overflow = cycle.no_equilibrium, cycle.overflow
    out.work, out.work_error, out.contact_radius, out.force_ratio = nan, nan, nan, nan
    out.stick_radius, out.stick_left, out.stick_right = nan, nan, nan
    if cycle.no_equilibrium or cycle.overflow:
        return
    tabulate_other(conjugate, profile)
    cycle.shift = shift_of(load, profile, ask, cycle.event, cycle.events)
    dissipate(cycle, load, profile, ask, conjugate, out)
    out.stick_radius = permanent_stick(load, profile, cycle.event, cycle.events)
    off = cycle.shift * (cycle.largest - max(stick_limit(load, cycle.event, cycle.events), 0.0))
    out.stick_left, out.stick_right = off - out.stick_radius, off + out.stick_radius
    out.contact_radius = largest_contact(load, profile)
    if with_ratio:
        if profile.in_force == 0:
            lay_out(growth, cycle, profile, load, GROWTH_TOLERANCE)
            tabulate_answer(conjugate, cycle, growth, profile)
        out.force_ratio = largest_ratio(cycle, growth, profile, load, conjugate)
        out.overflow = cycle.overflow


@jit
def cycles_of(cycle, growth, conjugate, with_ratio, profiles, which, loads, asks, out):
    """Quantities of the cycles of points: profile which[i], loads[i], asks[i]."""
    for i in range(which.shape[0]):
        cycle_of(cycle, growth, profiles[which[i]], loads[i], asks[i], conjugate, with_ratio, out[i])


@jit
def margins_of(cycle, profiles, which, loads, asks, out):
    """Write how far points are from where the model ends, by the load alone, also out of equilibrium."""
    for i in range(which.shape[0]):
        profile, load = profiles[which[i]], loads[i]
        m = turning_points(load, cycle.event)
        out[i].contact_radius = largest_contact(load, profile)
        out[i].stick_radius = permanent_stick(load, profile, cycle.event, m)
        out[i].force_ratio = force_ratio(load, cycle.event, m)
        out[i].slide = slide(load, cycle.event, m)
        is_moved = shift_of(load, profile, asks[i], cycle.event, m) != 0.0
        out[i].moved = (1 if load.bulk_exact else 2) if is_moved else 0
