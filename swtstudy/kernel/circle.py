"""The largest value of the criterion on a circle of the surface, over all angles and planes.

The stress cycle at one radius r serves the whole circle. With radial and hoop directions, at the angle φ from
x, the stress of the pressure is that on the line, and the stress of the tangential load on the line is turned
by one harmonic: with C = cos φ, S = sin φ, t = (σ_xx + σ_yy)/(1+ν) of the tangential load at φ = 0,

    σ_rr = within - p + C σ_xx + C² B,        σ_rφ = S ((ν - ½) t - σ_yy) - C S B,
    σ_φφ = -within - 2ν p + C σ_yy + S² B,    σ_rz = -C q,   σ_φz = S q,   σ_zz = -p.

On a fixed plane σ_n is a sinusoid of φ, so that the value, a maximum over planes and instants of smooth
functions, has a bounded downward curvature over φ: the arc with the highest bound is halved until no bound
exceeds the best value by more than the tolerance.

If a bulk stress shifts the stick zone (`swtstudy.kernel.shift`), each piece of the diagram has a centre of
its own and the stress is no harmonic of the angle. Then places of the circle are solved as places of the
body. The stress turns about as fast, so the same bounds are good estimates.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST, NEAREST
from swtstudy.kernel.all_planes import measure
from swtstudy.kernel.body import fill_circle, highest_here, sample_place
from swtstudy.kernel.climb import climb_from_principal
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.criterion import SWT, curvature_bound, lift, lifted, slope_bound, value_of
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import sample_cycle
from swtstudy.kernel.load import has_bulk
from swtstudy.kernel.parts import COARSEST
from swtstudy.kernel.planes import above
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.records import Body, Point

#: Up to this ν the line is never left (results/audit_parameter_box.md), unless a bulk stress or another
#: criterion has maxima outside of the contact or in mere pressure.
SAFE_POISSON_RATIO = 0.35
#: Relative height that counts as higher than the line: more than either search leaves.
HIGHER = 1e-4
#: Circles between the least and the largest contact radius, and climbs from the highest one.
BETWEEN, CLIMBS = 4, 3
#: First step of a climb over the largest contact, and the last one over the root of the tolerance.
STEP, NARROWEST = 0.05, 0.02
MAX_ARCS = 400
#: Arcs at first, over half a turn.
ARCS = np.int64(8)
#: Share of the best value below which the first angles do not matter.
FAR = 0.8
#: Intervals of a part at first; no literal, for which Numba would compile anew.
FIRST = np.int64(2 * COARSEST)
CIRCLE = np.dtype(
    [
        *fields("f8", "x place largest"),  # radius, its place s, and place of the largest contact
        ("places", "f8", (BETWEEN + 2,)),  # of the circles
        *fields("f8", "best angle summit"),  # h, and the angle and the place at which it is
        *fields("f8", "of_tension of_swing"),  # bounds of the derivatives over φ
        *fields("f8", "swing highest tension"),  # bounds of A and T, and of T at the last angle
        # At both ends of arcs: φ, h or more where it does not matter, bound of T.
        *fields("f8", "ends value most", (MAX_ARCS, 2)),
        ("normal", "f8", (MAX_ARCS, 2, 3)),
    ]
)


@jit
def begin_circle(circle, body):
    """Sample the cycle on the line, and write bounds of the derivatives of T and A over φ.

    The bounds are norms of the stresses that turn. A shifted stick zone has other stresses at both sides.
    """
    point, ask, history = body.point, body.point.ask, body.point.history
    nu, square, bulk, total = ask.poisson_ratio, 0.0, 0.0, 0.0
    of_sum = (nu - 0.5) / (1.0 + nu)
    for number in range(2 if point.cycle.shift != 0.0 else 1):
        sample_cycle(point, circle.place, circle.largest, 1.0 - 2.0 * number, FIRST)
        for i in range(history.instants):
            xx, yy, q = history.xx[i], history.yy[i], history.q[i]
            w = of_sum * (xx + yy) - yy
            square = max(square, xx * xx + yy * yy + 2.0 * q * q, 2.0 * (w * w + q * q))
            bulk, total = max(bulk, abs(history.bulk[i])), max(total, abs(xx + yy))
    circle.of_tension = sqrt(square) + 2.0 * bulk
    circle.of_swing = 2.0 * circle.of_tension
    if ask.criterion == SWT:
        circle.of_swing = 2.0 * ((1.0 + nu) * circle.of_tension + nu * total)


@jit
def sample_angle(circle, body, angle):
    """Write the stress cycle at an angle; False if it has more pieces than there is room for."""
    here, cycle = body.here, body.point.cycle
    if cycle.shift == 0.0:
        here.on_circle, here.angle, here.unsure = 1, angle, (1.0 - body.point.ask.line) * circle.best
        fill_circle(here, body.point.history, 0, body.point.ask)
        return True
    overflow = cycle.overflow
    sample_place(body, circle.x * cos(angle), circle.x * sin(angle), 0.0, circle.largest, FIRST)
    has_room = cycle.overflow == 0
    cycle.overflow = max(cycle.overflow, overflow)  # of all places together
    return has_room


@jit
def value_at(circle, body, angle, floor):
    """Largest h over the planes at an angle; below the floor it may be low."""
    planes, ask = body.planes, body.point.ask
    if not sample_angle(circle, body, angle):
        return floor
    h = highest_here(body, floor, ask.line, 0.5 * ask.line)
    circle.tension, circle.swing = planes.most[0], max(circle.swing, planes.most[1])
    if h > circle.best:
        circle.best, circle.angle, circle.summit = h, angle, circle.place
    return max(h, floor)


@jit
def curvature_over_angles(circle, ask, T):
    """Bound of -h″ over φ on an arc whose tension is bounded by T."""
    slope = slope_bound(circle.of_tension, circle.highest)
    return curvature_bound(ask, T, circle.swing, circle.of_tension, circle.of_swing, slope)


@jit
def bound_of_arc(circle, ask, k):
    """Bound of h on arc k."""
    square = (circle.ends[k, 1] - circle.ends[k, 0]) * (circle.ends[k, 1] - circle.ends[k, 0])
    T = above(circle.most[k, 0], circle.most[k, 1], circle.of_tension * square)
    K = curvature_over_angles(circle, ask, T)
    return min(above(circle.value[k, 0], circle.value[k, 1], K * square), lifted(ask, T, circle.swing, 0.0))


@jit
def set_end(circle, planes, k, end, angle, value):
    """Write one end of arc k, from what has just been seen there."""
    circle.ends[k, end], circle.value[k, end], circle.most[k, end] = angle, value, circle.tension
    for c in range(3):
        circle.normal[k, end, c] = planes.normal[c]


@jit
def first_count(load):
    """Number of arcs at first: of a mirrored load both quarters of the circle are alike."""
    return ARCS // 2 if load.mirrored else ARCS


@jit
def first_arcs(circle, body):
    """Look at evenly spaced angles; returns the number of arcs between them."""
    planes, arcs = body.planes, first_count(body.point.load)
    for k in range(arcs + 1):
        angle = pi * k / ARCS
        value = value_at(circle, body, angle, FAR * circle.best)
        if k < arcs:
            set_end(circle, planes, k, 0, angle, value)
        if k > 0:
            set_end(circle, planes, k - 1, 1, angle, value)
    return arcs


@jit
def open_circle(circle, body, place):
    """Sample the cycle on the circle at a place s; False on the axis, which has no circle."""
    b, normal = body.point.profile.flat_radius, body.planes.normal
    circle.place, circle.x = place, sqrt(b * b + place * abs(place))
    if not circle.x > 0.0:
        return False
    begin_circle(circle, body)
    normal[0], normal[1], normal[2] = 0.0, 0.0, 0.0
    return True


@jit
def search_circle(circle, body, place, known):
    """Largest value on the circle at a place s, if it is above what is known; else that."""
    ask = body.point.ask
    if not open_circle(circle, body, place):
        return known
    circle.swing, circle.highest = 0.0, 0.0
    circle.best = least = lift(ask, known)
    m = first_arcs(circle, body)
    for i in range(m):
        square = (circle.ends[i, 1] - circle.ends[i, 0]) * (circle.ends[i, 1] - circle.ends[i, 0])
        tension = above(circle.most[i, 0], circle.most[i, 1], circle.of_tension * square)
        circle.highest = max(circle.highest, tension)
    while m < MAX_ARCS:
        k, bound = 0, -1.0
        for i in range(m):
            own = bound_of_arc(circle, ask, i)
            if own > bound:
                k, bound = i, own
        if bound <= circle.best * (1.0 + ask.line):
            break
        halve_arc(circle, body, k, m)
        m += 1
    return value_of(ask, circle.best) if circle.best > least else known


@jit
def halve_arc(circle, body, k, m):
    """Halve arc k; its upper half becomes arc m."""
    planes, ask = body.planes, body.point.ask
    angle, half = 0.5 * (circle.ends[k, 0] + circle.ends[k, 1]), 0.5 * (circle.ends[k, 1] - circle.ends[k, 0])
    T = max(circle.most[k, 0], circle.most[k, 1])
    drop = curvature_over_angles(circle, ask, T) * half * half
    for end in range(2):
        for of_ends in (circle.ends, circle.value, circle.most):
            of_ends[m, end] = of_ends[k, end]
        for c in range(3):
            circle.normal[m, end, c] = circle.normal[k, end, c]
    # A value so low that its bound stays below the best does not matter.
    higher = 1 if circle.value[k, 1] > circle.value[k, 0] else 0
    for c in range(3):
        planes.normal[c] = circle.normal[k, higher, c]
    value = value_at(circle, body, angle, max(circle.best - 0.125 * drop, FAR * circle.best))
    set_end(circle, planes, k, 1, angle, value)
    set_end(circle, planes, m, 0, angle, value)


@jit
def needs_circle(load, profile, ask):
    """True if the circle may be higher than the line."""
    return not profile.plane and (ask.poisson_ratio > SAFE_POISSON_RATIO or may_be_anywhere(load, ask))


@jit
def beside_singular_edge(profile, x, share):
    """True if a place is nearer to the singular edge of a face than a share of the face."""
    return profile.singular and abs(abs(x) - profile.flat_radius) <= share * profile.flat_radius


@jit
def may_be_anywhere(load, ask):
    """True if places in mere pressure may be critical, or places outside of the contact."""
    return ask.criterion != SWT or has_bulk(load)


@jit
def climb_radius(circle, body):
    """From the place of the best value to a higher one at the same angle, by steps that are halved.

    A maximum changes by the square of a distance from it, so the last step follows from the tolerance.
    """
    ask, step, angle = body.point.ask, STEP * circle.largest, circle.angle
    while step > NARROWEST * sqrt(ask.line) * circle.largest:
        before = circle.best
        for side in (1.0, -1.0):
            new = circle.summit + side * step
            if abs(new) >= INNERMOST * circle.largest and open_circle(circle, body, new):
                value_at(circle, body, angle, FAR * before)
                if circle.best > before:
                    break
        if circle.best == before:
            step *= 0.5


@jit
def choose_circles(circle, body, found):
    """Write the places s of the circles that are searched; returns their number.

    One is the circle through the point's maximum. Under a bulk stress, and of criteria of shear, whose maxima
    may be anywhere, circles between the least and the largest contact radius count, too: outside of the
    contact the radial tension of the pressure is largest at the least one, and at its sides the bulk stress
    does not press on it.
    """
    load, profile, ask, cycle = body.point.load, body.point.profile, body.point.ask, body.point.cycle
    circle.largest, lowest = place_of(profile, cycle.largest), place_of(profile, max(cycle.smallest, 0.0))
    if profile.flat_radius > 0.0:  # at the very edge of a face tables of the radius have no scale
        lowest = max(lowest, INNERMOST * circle.largest)
    count = 0
    if found.s > found.s_error and not np.isnan(found.critical_x):
        circle.places[0], count = found.place, 1
    if may_be_anywhere(load, ask):
        steps = BETWEEN if circle.largest > lowest else 1  # one circle where the radius does not change
        for k in range(1 if profile.singular or steps == 1 else 0, steps + 1):
            circle.places[count] = lowest + (circle.largest - lowest) * k / steps
            count += 1
    return count


@jit
def glance(circle, body, place):
    """Raise the best value to what a climb over planes finds at the first angles of the circle at a place s.

    It begins at the largest principal stress. Whatever stays below the best value need not be searched.
    """
    here, planes, ask, history = body.here, body.planes, body.point.ask, body.point.history
    if not open_circle(circle, body, place):
        return
    for k in range(first_count(body.point.load) + 1):
        angle = pi * k / ARCS
        if not sample_angle(circle, body, angle):
            continue
        measure(planes, here.stress, history.instants, ask)
        planes.best, planes.limit = 0.0, 0.0
        climb_from_principal(planes, here.stress, history.instants, ask)
        if planes.best > circle.best:
            circle.best, circle.angle, circle.summit = planes.best, angle, place


@jit
def climb_circles(circle, body, top):
    """From the place of the best value to a maximum over angle and radius, by turns; returns it.

    It is at least ``top``, which is that of the begin.
    """
    ask = body.point.ask
    for _ in range(0 if body.point.profile.singular else CLIMBS):
        circle.best = lift(ask, top)
        climb_radius(circle, body)
        value = search_circle(circle, body, circle.summit, value_of(ask, circle.best))
        done = value <= top * (1.0 + ask.line)
        top = max(top, value)
        if done:
            break
    return top


@jit
def surface_value(circle, body, found):
    """Largest value on the surface off the line; s itself if that is not exceeded.

    NaN where the point's maximum is at the singular edge of a face: next to it the pressure has no bound.
    """
    load, profile, ask, cycle = body.point.load, body.point.profile, body.point.ask, body.point.cycle
    if found.s > found.s_error and beside_singular_edge(profile, found.critical_x, NEAREST):
        return np.nan
    solve_cycle(cycle, load)
    cycle.shift = found.shift
    lay_out(body.point.growth, cycle, profile, load, found.growth)
    count, known = choose_circles(circle, body, found), (1.0 + HIGHER) * found.s
    circle.best = floor = lift(ask, known)
    for k in range(count if count > 1 else 0):  # one circle is searched at once
        glance(circle, body, circle.places[k])
    top = value_of(ask, circle.best) if circle.best > floor else known
    for k in range(count):
        top = max(top, search_circle(circle, body, circle.places[k], top))
    return climb_circles(circle, body, top) if top > known else found.s


@jit
def search_circles(circle, of_body, room, profiles, which, loads, asks, found):
    """Write the largest values on the circles of points, where the line may not be enough."""
    for i in range(which.shape[0]):
        if found[i].circle:
            point = Point(loads[i], profiles[which[i]], asks[i], *room)
            found[i].s_surface = surface_value(circle, Body(*of_body, point), found[i])
            found[i].overflow = point.cycle.overflow
