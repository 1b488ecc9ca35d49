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
from swtstudy.kernel.body import fill_circle, highest_here, largest_at
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.criterion import SWT, curvature_bound, lift, lifted, slope_bound, value_of
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import sample_cycle
from swtstudy.kernel.load import has_bulk
from swtstudy.kernel.parts import COARSEST
from swtstudy.kernel.planes import above
from swtstudy.kernel.profile import place_of

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
        *fields("f8", "best angle"),  # h, and the angle at which it is
        *fields("f8", "of_tension of_swing"),  # bounds of the derivatives over φ
        *fields("f8", "swing highest tension"),  # bounds of A and T, and of T at the last angle
        # At both ends of arcs: φ, h or more where it does not matter, bound of T.
        *fields("f8", "ends value most", (MAX_ARCS, 2)),
        ("normal", "f8", (MAX_ARCS, 2, 3)),
    ]
)


@jit
def begin_circle(D, H, C, R, P, K, L, Q):
    """Sample the cycle on the line, and write bounds of the derivatives of T and A over φ.

    The bounds are norms of the stresses that turn. A shifted stick zone has other stresses at both sides.
    """
    nu, square, bulk, total = Q.poisson_ratio, 0.0, 0.0, 0.0
    of_sum = (nu - 0.5) / (1.0 + nu)
    for number in range(2 if C.shift != 0.0 else 1):
        sample_cycle(H, C, R, P, K, L, Q, D.place, D.largest, 1.0 - 2.0 * number, FIRST)
        for i in range(H.instants):
            xx, yy, q = H.xx[i], H.yy[i], H.q[i]
            w = of_sum * (xx + yy) - yy
            square = max(square, xx * xx + yy * yy + 2.0 * q * q, 2.0 * (w * w + q * q))
            bulk, total = max(bulk, abs(H.bulk[i])), max(total, abs(xx + yy))
    D.of_tension = sqrt(square) + 2.0 * bulk
    D.of_swing = 2.0 * D.of_tension
    if Q.criterion == SWT:
        D.of_swing = 2.0 * ((1.0 + nu) * D.of_tension + nu * total)


@jit
def value_at(D, body, angle, floor):
    """Largest h over the planes at an angle; below the floor it may be low."""
    S, B, H, W, G, C, R, P, K, L, Q = body
    tolerance = Q.line, 0.5 * Q.line
    if C.shift == 0.0:
        S.on_circle, S.angle, S.unsure = 1, angle, (1.0 - Q.line) * D.best
        fill_circle(S, H, 0, Q)
        h = highest_here(body, floor, *tolerance)
    else:
        place = D.x * cos(angle), D.x * sin(angle), 0.0, D.largest
        own, overflow = (value_of(Q, floor), *tolerance, FIRST), C.overflow
        h = lift(Q, largest_at(body, *place, *own)[0])
        C.overflow = max(C.overflow, overflow)  # of all places together
    D.tension, D.swing = G.most[0], max(D.swing, G.most[1])
    if h > D.best:
        D.best, D.angle = h, angle
    return max(h, floor)


@jit
def curvature_over_angles(D, Q, T):
    """Bound of -h″ over φ on an arc whose tension is bounded by T."""
    slope = slope_bound(D.of_tension, D.highest)
    return curvature_bound(Q, T, D.swing, D.of_tension, D.of_swing, slope)


@jit
def bound_of_arc(D, Q, k):
    """Bound of h on arc k."""
    square = (D.ends[k, 1] - D.ends[k, 0]) * (D.ends[k, 1] - D.ends[k, 0])
    T = above(D.most[k, 0], D.most[k, 1], D.of_tension * square)
    K = curvature_over_angles(D, Q, T)
    return min(above(D.value[k, 0], D.value[k, 1], K * square), lifted(Q, T, D.swing, 0.0))


@jit
def set_end(D, G, k, end, angle, value):
    """Write one end of arc k, from what has just been seen there."""
    D.ends[k, end], D.value[k, end], D.most[k, end] = angle, value, D.tension
    for c in range(3):
        D.normal[k, end, c] = G.normal[c]


@jit
def first_arcs(D, body):
    """Look at evenly spaced angles; returns the number of arcs between them."""
    G, L = body[4], body[9]
    arcs = ARCS // 2 if L.mirrored else ARCS
    for k in range(arcs + 1):
        angle = pi * k / ARCS
        value = value_at(D, body, angle, FAR * D.best)
        if k < arcs:
            set_end(D, G, k, 0, angle, value)
        if k > 0:
            set_end(D, G, k - 1, 1, angle, value)
    return arcs


@jit
def open_circle(D, body, place):
    """Sample the cycle on the circle at a place s; False on the axis, which has no circle."""
    S, B, H, W, G, C, R, P, K, L, Q = body
    D.place, D.x = place, sqrt(P.flat_radius * P.flat_radius + place * abs(place))
    if not D.x > 0.0:
        return False
    begin_circle(D, H, C, R, P, K, L, Q)
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    return True


@jit
def search_circle(D, body, place, known):
    """Largest value on the circle at a place s, if it is above what is known; else that."""
    Q = body[10]
    if not open_circle(D, body, place):
        return known
    D.swing, D.highest = 0.0, 0.0
    D.best = least = lift(Q, known)
    m = first_arcs(D, body)
    for i in range(m):
        square = (D.ends[i, 1] - D.ends[i, 0]) * (D.ends[i, 1] - D.ends[i, 0])
        D.highest = max(D.highest, above(D.most[i, 0], D.most[i, 1], D.of_tension * square))
    while m < MAX_ARCS:
        k, bound = 0, -1.0
        for i in range(m):
            own = bound_of_arc(D, Q, i)
            if own > bound:
                k, bound = i, own
        if bound <= D.best * (1.0 + Q.line):
            break
        halve_arc(D, body, k, m)
        m += 1
    return value_of(Q, D.best) if D.best > least else known


@jit
def halve_arc(D, body, k, m):
    """Halve arc k; its upper half becomes arc m."""
    G, Q = body[4], body[10]
    angle, half = 0.5 * (D.ends[k, 0] + D.ends[k, 1]), 0.5 * (D.ends[k, 1] - D.ends[k, 0])
    T = max(D.most[k, 0], D.most[k, 1])
    drop = curvature_over_angles(D, Q, T) * half * half
    for end in range(2):
        D.ends[m, end], D.value[m, end], D.most[m, end] = D.ends[k, end], D.value[k, end], D.most[k, end]
        for c in range(3):
            D.normal[m, end, c] = D.normal[k, end, c]
    # A value so low that its bound stays below the best does not matter.
    higher = 1 if D.value[k, 1] > D.value[k, 0] else 0
    for c in range(3):
        G.normal[c] = D.normal[k, higher, c]
    value = value_at(D, body, angle, max(D.best - 0.125 * drop, FAR * D.best))
    set_end(D, G, k, 1, angle, value)
    set_end(D, G, m, 0, angle, value)


@jit
def needs_circle(L, P, Q):
    """True if the circle may be higher than the line."""
    return not P.plane and (Q.poisson_ratio > SAFE_POISSON_RATIO or may_be_anywhere(L, Q))


@jit
def beside_singular_edge(P, x, share):
    """True if a place is nearer to the singular edge of a face than a share of the face."""
    return P.singular and abs(abs(x) - P.flat_radius) <= share * P.flat_radius


@jit
def may_be_anywhere(L, Q):
    """True if places in mere pressure may be critical, or places outside of the contact."""
    return Q.criterion != SWT or has_bulk(L)


@jit
def climb_radius(D, body, place):
    """From a place s to a higher one at the angle of the best value, by steps that are halved.

    A maximum changes by the square of a distance from it, so the last step follows from the tolerance.
    """
    Q, step, angle = body[10], STEP * D.largest, D.angle
    while step > NARROWEST * sqrt(Q.line) * D.largest:
        before = D.best
        for side in (1.0, -1.0):
            new = place + side * step
            if abs(new) >= INNERMOST * D.largest and open_circle(D, body, new):
                value_at(D, body, angle, FAR * before)
                if D.best > before:
                    place = new
                    break
        if D.best == before:
            step *= 0.5
    return place


@jit
def surface_value(D, body, found):
    """Largest value on the surface off the line; s itself if that is not exceeded.

    The circle through the point's maximum is searched. Under a bulk stress, and of criteria of shear, whose
    maxima may be anywhere, circles between the least and the largest contact radius count, too: outside of
    the contact the radial tension of the pressure is largest at the least one, and at its sides the bulk
    stress does not press on it. From the highest circle a climb leads to the maximum over the radius.
    NaN where the point's maximum is at the singular edge of a face: next to it the pressure has no bound.
    """
    S, B, H, W, G, C, R, P, K, L, Q = body
    s, known, anywhere = found.s, (1.0 + HIGHER) * found.s, may_be_anywhere(L, Q)
    at_infinity = np.isnan(found.critical_x)
    nowhere = (s <= found.s_error or at_infinity) and anywhere
    if at_infinity and not nowhere:
        return s
    if not nowhere and beside_singular_edge(P, found.critical_x, NEAREST):
        return np.nan
    solve_cycle(C, L)
    C.shift = found.shift
    lay_out(R, C, P, L, found.growth)
    D.largest, lowest = place_of(P, C.largest), place_of(P, max(C.smallest, 0.0))
    if P.flat_radius > 0.0:  # at the very edge of a face tables of the radius have no scale
        lowest = max(lowest, INNERMOST * D.largest)
    top = known if nowhere else search_circle(D, body, found.place, known)
    best, angle = found.place, D.angle
    steps = BETWEEN if D.largest > lowest else 1  # one circle where the radius does not change
    for k in range(1 if P.singular or steps == 1 else 0, steps + 1 if anywhere else 0):
        place = lowest + (D.largest - lowest) * k / steps
        value = search_circle(D, body, place, top)
        if value > top:
            top, best, angle = value, place, D.angle
    if top <= known:
        return s
    for _ in range(0 if P.singular else CLIMBS):
        D.best, D.angle = lift(Q, top), angle
        place = climb_radius(D, body, best)
        value = search_circle(D, body, place, value_of(Q, D.best))
        done = value <= top * (1.0 + Q.line)
        top = max(top, value)
        if done:
            break
        best, angle = place, D.angle
    return top


@jit
def search_circles(D, B, S, G, C, R, _, H, W, K, profiles, which, loads, asks, found):
    """Write the largest values on the circles of points, where the line may not be enough."""
    for i in range(which.shape[0]):
        if found[i].circle:
            body = S, B, H, W, G, C, R, profiles[which[i]], K, loads[i], asks[i]
            found[i].s_surface = surface_value(D, body, found[i])
            found[i].overflow = C.overflow
