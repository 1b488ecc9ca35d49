"""The largest value of the criterion on a circle of the surface, over all angles and planes.

The stress cycle at one radius r serves the whole circle. With radial and hoop directions, at the angle φ from
x, the stress of the pressure is that on the line, and the stress of the tangential load on the line is turned
by one harmonic: with C = cos φ, S = sin φ, t = (σ_xx + σ_yy)/(1+ν) of the tangential load at φ = 0,

    σ_rr = within - p + C σ_xx + C² B,        σ_rφ = S ((ν - ½) t - σ_yy) - C S B,
    σ_φφ = -within - 2ν p + C σ_yy + S² B,    σ_rz = -C q,   σ_φz = S q,   σ_zz = -p.

The value is a maximum over planes and instants of smooth functions of φ, so that only downward curvature can
hide a higher one between two angles. As on the line (`swtstudy.kernel.line`) the curvature follows from the
values around, and the arc with the highest bound is halved until no bound exceeds the best value by more than
the tolerance. Where there is no tension, the curvature of the tension gives a bound. From the best place of
all circles a climb over angle and radius goes on to a maximum.

If a bulk stress shifts the stick zone (`swtstudy.kernel.shift`), each piece of the diagram has a centre of
its own and the stress is no harmonic of the angle. Then places of the circle are solved as places of the
body. The stress turns about as fast, so the same bound of the tension is a good estimate.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST, NEAREST
from swtstudy.kernel.all_planes import measure
from swtstudy.kernel.body import fill_circle, highest_here, sample_place
from swtstudy.kernel.climb import climb_from_principal
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.criterion import SWT, lift, lifted, value_of
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import sample_cycle
from swtstudy.kernel.line import drop_of_half
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
#: Circles between the least and the largest contact radius, and climbs, each with a circle after it.
BETWEEN, CLIMBS = 4, 3
#: First step of a climb, in rad and in the largest contact, and the narrowest one.
STEP, NARROWEST = 0.05, 1e-7
#: No plane is higher by more than this share, while a climb goes on.
ROUGHLY = 1.0
MAX_ARCS = 400
#: Arcs at first, over half a turn.
ARCS = np.int64(8)
#: Share of the best value below which the first angles do not matter.
FAR = 0.5
#: Intervals of a part at first; no literal, for which Numba would compile anew.
FIRST = np.int64(2 * COARSEST)
CIRCLE = np.dtype(
    [
        *fields("f8", "x place largest"),  # radius, its place s, and place of the largest contact
        ("places", "f8", (BETWEEN + 2,)),  # of the circles
        *fields("f8", "best angle summit"),  # h, and the angle and the place at which it is
        ("plane", "f8", (3,)),  # and the normal of its plane
        *fields("f8", "of_tension swing tension"),  # bounds of |T″| over φ, of A, and of T at the last angle
        # At both ends of arcs: φ, h or more where it does not matter, bound of T.
        *fields("f8", "ends value most", (MAX_ARCS, 2)),
        ("upper", "i8", (MAX_ARCS,)),  # 1: the upper half of what was halved
        # The value at the other end of the other half, and -h″ times the square of the width.
        *fields("f8", "beyond drop", (MAX_ARCS,)),
        ("normal", "f8", (MAX_ARCS, 2, 3)),
    ]
)


@jit
def begin_circle(circle, body):
    """Sample the cycle on the line, and write a bound of |T″| over φ: a norm of the stress that turns.

    A shifted stick zone has other stresses at both sides.
    """
    point, nu, history = body.point, body.point.ask.poisson_ratio, body.point.history
    of_sum, square, bulk = (nu - 0.5) / (1.0 + nu), 0.0, 0.0
    for number in range(2 if point.cycle.shift != 0.0 else 1):
        sample_cycle(point, circle.place, circle.largest, 1.0 - 2.0 * number, FIRST)
        for i in range(history.instants):
            xx, yy, q = history.xx[i], history.yy[i], history.q[i]
            w = of_sum * (xx + yy) - yy
            square = max(square, xx * xx + yy * yy + 2.0 * q * q, 2.0 * (w * w + q * q))
            bulk = max(bulk, abs(history.bulk[i]))
    circle.of_tension = sqrt(square) + 2.0 * bulk


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
def value_at(circle, body, angle, floor, proof):
    """Largest h over planes at an angle, the floor at least. No plane is higher by more than the proof."""
    planes, ask = body.planes, body.point.ask
    if not sample_angle(circle, body, angle):
        return floor
    h = highest_here(body, floor, ask.line, proof)
    circle.tension, circle.swing = planes.most[0], max(circle.swing, planes.most[1])
    if h > circle.best:
        set_best(circle, planes, h, angle)
    return max(h, floor)


@jit
def set_best(circle, planes, h, angle):
    """Make the last plane at an angle of the open circle the best one."""
    circle.best, circle.angle, circle.summit = h, angle, circle.place
    for c in range(3):
        circle.plane[c] = planes.normal[c]


@jit
def bound_of_arc(circle, ask, k):
    """Bound of h on arc k: by the curvature of T, and by that of h where there is tension at both ends."""
    width = circle.ends[k, 1] - circle.ends[k, 0]
    T = above(circle.most[k, 0], circle.most[k, 1], circle.of_tension * width * width)
    bound = lifted(ask, T, circle.swing, 0.0)
    if ask.criterion != SWT or min(circle.most[k, 0], circle.most[k, 1]) > 0.0:
        bound = min(bound, above(circle.value[k, 0], circle.value[k, 1], circle.drop[k]))
    return bound


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
    planes, ask, arcs = body.planes, body.point.ask, first_count(body.point.load)
    for k in range(arcs + 1):
        angle = pi * k / ARCS
        value = value_at(circle, body, angle, FAR * circle.best, 0.5 * ask.line)
        if k < arcs:
            set_end(circle, planes, k, 0, angle, value)
        if k > 0:
            set_end(circle, planes, k - 1, 1, angle, value)
    for k in range(arcs):  # the value is even about both ends
        f1, f2 = circle.value[k, 0], circle.value[k, 1]
        before = circle.value[k - 1, 0] if k > 0 else f2
        after = circle.value[k + 1, 1] if k < arcs - 1 else f1
        d1, d2 = 2.0 * f1 - before - f2, 2.0 * f2 - f1 - after
        circle.upper[k], circle.beyond[k] = 1, before
        circle.drop[k] = max(d1, d2, 0.0) + 2.0 * abs(d1 - d2)
    return arcs


@jit
def open_circle(circle, body, place):
    """Sample the cycle on the circle at a place s; False on the axis and at the singular edge of a face."""
    b, normal = body.point.profile.flat_radius, body.planes.normal
    circle.place, circle.x, circle.swing = place, sqrt(b * b + place * abs(place)), 0.0
    if not circle.x > 0.0 or beside_singular_edge(body.point.profile, circle.x, NEAREST):
        return False
    begin_circle(circle, body)
    normal[0], normal[1], normal[2] = 0.0, 0.0, 0.0
    return True


@jit
def search_circle(circle, body, place):
    """Raise the best value to the largest one on the circle at a place s, if that is higher."""
    ask = body.point.ask
    if not open_circle(circle, body, place):
        return
    m = first_arcs(circle, body)
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


@jit
def halve_arc(circle, body, k, m):
    """Halve arc k; its upper half becomes arc m."""
    planes, ask = body.planes, body.point.ask
    f1, f2, before = circle.value[k, 0], circle.value[k, 1], circle.drop[k]
    angle = 0.5 * (circle.ends[k, 0] + circle.ends[k, 1])
    for end in range(2):
        for of_ends in (circle.ends, circle.value, circle.most):
            of_ends[m, end] = of_ends[k, end]
        for c in range(3):
            circle.normal[m, end, c] = circle.normal[k, end, c]
    for c in range(3):
        planes.normal[c] = circle.normal[k, 1 if f2 > f1 else 0, c]
    # A value so low that its bound stays below the best does not matter.
    floor = max(circle.best - 0.125 * before, FAR * circle.best)
    value = value_at(circle, body, angle, floor, 0.5 * ask.line)
    set_end(circle, planes, k, 1, angle, value)
    set_end(circle, planes, m, 0, angle, value)
    drop = drop_of_half(f1, f2, value, circle.upper[k], circle.beyond[k], before)
    circle.drop[k] = circle.drop[m] = drop
    circle.upper[k], circle.upper[m], circle.beyond[k], circle.beyond[m] = 0, 1, f2, f1


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
            set_best(circle, planes, planes.best, angle)


@jit
def look_near(circle, body, place, angle, proof):
    """Look at an angle of the circle at a place s, from the best plane on; no place next to the axis.

    Returns h there, FAR times the best value at least.
    """
    if abs(place) >= INNERMOST * circle.largest and open_circle(circle, body, place):
        for c in range(3):
            body.planes.normal[c] = circle.plane[c]
        return value_at(circle, body, angle, FAR * circle.best, proof)
    return FAR * circle.best


@jit
def climb_surface(circle, body):
    """From the place of the best value to a maximum over angle and radius, by the method of Hooke and Jeeves.

    Where no step along or around leads to a higher value, steps are halved; the way of a round that did is
    tried once more. Where steps to both sides lower the value, by D at most, a parabola has its maximum at
    most D/8 higher: so the last step follows from the tolerance.
    """
    line, largest, step, along, around = body.point.ask.line, circle.largest, STEP, 0.0, 0.0
    while step > NARROWEST:
        place, angle, before, drop = circle.summit, circle.angle, circle.best, 0.0
        if along != 0.0 or around != 0.0:
            look_near(circle, body, place + along, angle + around, ROUGHLY)
        for axis in range(2):
            top = circle.best
            for side in (1.0, -1.0):
                if circle.best == top:
                    moved = circle.summit + (side * step * largest if axis == 0 else 0.0)
                    turned = circle.angle + (side * step if axis == 1 else 0.0)
                    drop = max(drop, top - look_near(circle, body, moved, turned, ROUGHLY))
        along, around = circle.summit - place, circle.angle - angle
        if circle.best > before * (1.0 + 0.1 * line):
            continue
        if drop <= 0.1 * line * circle.best:
            break
        step *= 0.5
    look_near(circle, body, circle.summit, circle.angle, 0.5 * line)


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
    count = choose_circles(circle, body, found)
    circle.best = floor = lift(ask, (1.0 + HIGHER) * found.s)
    for k in range(count if count > 1 else 0):  # one circle is searched at once
        glance(circle, body, circle.places[k])
    for k in range(count):
        search_circle(circle, body, circle.places[k])
    if circle.best <= floor:
        return found.s
    for _ in range(CLIMBS):
        climb_surface(circle, body)
        top = circle.best
        search_circle(circle, body, circle.summit)
        if circle.best <= top * (1.0 + ask.line):
            break
    return value_of(ask, circle.best)


@jit
def search_circles(circle, of_body, room, profiles, which, loads, asks, found):
    """Write the largest values on the circles of points, where the line may not be enough."""
    for i in range(which.shape[0]):
        if found[i].circle:
            point = Point(loads[i], profiles[which[i]], asks[i], *room)
            found[i].s_surface = surface_value(circle, Body(*of_body, point), found[i])
            found[i].overflow = point.cycle.overflow
