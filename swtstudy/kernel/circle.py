"""The largest value of the criterion on a circle of the surface, over all angles and planes.

The stress cycle at one radius r serves the whole circle. With radial and hoop directions, at the angle φ from
x, the stress of the pressure is that on the line, and the stress of the tangential load on the line is turned
by one harmonic: with C = cos φ, S = sin φ, t = (σ_xx + σ_yy)/(1+ν) of the tangential load at φ = 0,

    σ_rr = within - p + C σ_xx + C² B,        σ_rφ = S ((ν - ½) t - σ_yy) - C S B,
    σ_φφ = -within - 2ν p + C σ_yy + S² B,    σ_rz = -C q,   σ_φz = S q,   σ_zz = -p.

On a fixed plane σ_n is a sinusoid of φ, so that the value, a maximum over planes and instants of smooth
functions, has a bounded downward curvature over φ: the arc with the highest bound is halved until no bound
exceeds the best value by more than the tolerance.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST, NEAREST
from swtstudy.kernel.all_planes import PLANES, ROWS, activate, climb_from, highest_plane, measure
from swtstudy.kernel.chebyshev import FINEST, barycentric
from swtstudy.kernel.compiled import jit, jit_reordered, new_record
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.criterion import SWT, curvature_bound, lift, lifted, slope_bound, value_of
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import MAX_INSTANTS, MAX_PARTS, ROOM, may_be_refined, refine, sample_cycle
from swtstudy.kernel.line import ROUNDS
from swtstudy.kernel.load import has_bulk
from swtstudy.kernel.planes import BETWEEN, above, find_peaks, mark_unresolved
from swtstudy.kernel.profile import place_of

#: Up to this ν the line is never left (results/audit_parameter_box.md), unless a bulk stress or another
#: criterion has maxima outside of the contact or in mere pressure.
SAFE_POISSON_RATIO = 0.35
#: Relative height that counts as higher than the line: more than either search leaves.
HIGHER = 1e-4
MAX_PEAKS, MAX_ARCS = 120, 400
#: Arcs at first, over half a turn.
ARCS = np.int64(8)
#: Share of the best value below which the first angles do not matter.
FAR = 0.8
#: Nearer to one another than this, on a part of the cycle from -1 to 1, two maxima over time are one.
ONE_PEAK = 0.02
CIRCLE = np.dtype(
    [
        ("angles", "i8"),  # that have been looked at
        ("peaks", "i8"),  # maxima over time between the instants
        ("next", "i8"),  # the peak that is replaced next
        ("part", "i8", (MAX_PEAKS,)),  # part of the cycle, and place on it from -1 to 1
        ("at", "f8", (MAX_PEAKS,)),
        ("parts", "i8"),  # parts of the cycle that have been seen
        ("sure", "i8", (MAX_PARTS,)),  # 1: doubled once more than needed
        ("best", "f8"),  # h
        ("of_tension", "f8"),  # bounds of the derivatives over φ
        ("of_swing", "f8"),
        ("swing", "f8"),  # bound of A
        ("highest", "f8"),  # and of T
        ("tension", "f8"),  # the same at the last angle
        ("ends", "f8", (MAX_ARCS, 2)),  # φ
        ("value", "f8", (MAX_ARCS, 2)),  # h at both ends, or more where it does not matter
        ("most", "f8", (MAX_ARCS, 2)),  # bound of T there
        ("normal", "f8", (MAX_ARCS, 2, 3)),
    ]
)


def circles():
    """The memory that one thread needs for circles, beside the points' memory."""
    return new_record(CIRCLE), new_record(PLANES), np.zeros((ROWS, MAX_INSTANTS))


@jit_reordered
def fill_circle(H, S, m, nu, angle):
    """Write the stress at an angle of the circle: rr, φφ, zz, φz, rz, rφ instead of xx to xy."""
    C, D, of_sum = cos(angle), sin(angle), (nu - 0.5) / (1.0 + nu)
    for i in range(m):
        p, within, bulk = H.p[i], H.within[i], H.bulk[i]
        S[0, i] = within - p + C * H.xx[i] + C * C * bulk
        S[1, i] = -within - 2.0 * nu * p + C * H.yy[i] + D * D * bulk
        S[2, i], S[3, i], S[4, i] = -p, D * H.q[i], -C * H.q[i]
        S[5, i] = D * (of_sum * (H.xx[i] + H.yy[i]) - H.yy[i]) - C * D * bulk


@jit
def bound_turning(D, H, Q):
    """Write bounds of the derivatives of T and A over φ: by the norms of the stresses that turn."""
    nu, square, bulk, total = Q.poisson_ratio, 0.0, 0.0, 0.0
    of_sum = (nu - 0.5) / (1.0 + nu)
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
def set_curves(G, S, H, W, Q):
    """Write σ_n and the swing of all instants on the best plane as the curves of `planes`, of constants."""
    n = G.trial
    for c in range(3):
        n[c] = G.normal[c]
    activate(G, S, H.instants, Q)
    C, D, of_stress = G.chord[0], G.chord[1], 1.0 + Q.poisson_ratio
    a, b, c = n[0] * n[0], n[1] * n[1], n[2] * n[2]
    d, e, f = 2.0 * n[1] * n[2], 2.0 * n[0] * n[2], 2.0 * n[0] * n[1]
    for i in range(H.instants):
        s = a * S[0, i] + b * S[1, i] + c * S[2, i] + d * S[3, i] + e * S[4, i] + f * S[5, i]
        W.a[i], W.b[i], W.c[i] = s, 0.0, 0.0
        W.d[i] = of_stress * s - S[6, i] if Q.criterion == SWT else C * S[7, i] + D * S[8, i]
    W.noise = G.noise


@jit
def add_peak(D, z, at):
    """Keep a maximum over time in part z; nearly the same one is replaced."""
    if at == -1.0 or at == 1.0:  # an instant
        return
    k = -1
    for i in range(D.peaks):
        if D.part[i] == z and abs(D.at[i] - at) < ONE_PEAK:
            k = i
    if k < 0 and D.peaks < MAX_PEAKS:
        k = D.peaks
        D.peaks += 1
    elif k < 0:  # they only sharpen what the instants show
        k = D.next
        D.next = (k + 1) % MAX_PEAKS
    D.part[k], D.at[k] = z, at


@jit
def forget_peaks(D, z):
    """Drop the peaks of a part that is cut in two."""
    i = 0
    while i < D.peaks:
        if D.part[i] == z:
            D.peaks -= 1
            D.part[i], D.at[i] = D.part[D.peaks], D.at[D.peaks]
        else:
            i += 1


@jit
def place_peaks(D, H, W):
    """Write the stress cycle at the peaks behind the instants; returns the number of both."""
    m = H.instants
    if m + MAX_PEAKS > MAX_INSTANTS:
        return m
    for k in range(D.peaks):
        first, intervals = H.first[D.part[k]], H.intervals[D.part[k]]
        barycentric(D.at[k], intervals, W.weight)
        p, within, xx, yy, q, bulk = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for j in range(intervals + 1):
            w, i = W.weight[j], first + j
            p += w * H.p[i]
            within += w * H.within[i]
            xx += w * H.xx[i]
            yy += w * H.yy[i]
            q += w * H.q[i]
            bulk += w * H.bulk[i]
        H.p[m + k], H.within[m + k], H.bulk[m + k] = p, within, bulk
        H.xx[m + k], H.yy[m + k], H.q[m + k] = xx, yy, q
    return m + D.peaks


@jit
def refill(D, S, H, W, G, Q, angle):
    """Write and measure the stress at an angle; returns the number of its instants."""
    m = place_peaks(D, H, W)
    fill_circle(H, S, m, Q.poisson_ratio, angle)
    measure(G, S, m, Q)
    return m


@jit
def settle(D, G, S, H, W, C, P, K, L, Q, angle):
    """Refine the cycle until the value at an angle on its best plane, and the planes beside it, stays.

    Parts of the cycle are doubled as on the line (`swtstudy.kernel.line.resolve`), parts of the maxima once
    more than they need. The maxima over time of the three curves become instants.
    """
    n = G.normal
    for _ in range(ROUNDS):
        before = G.best
        set_curves(G, S, H, W, Q)
        find_peaks(H, W, Q, 1.0, 0.0)
        doubled, _, _ = mark_unresolved(H, W, C, Q, 1.0, 0.0, Q.time)
        for which in range(3):
            z = W.part[which]
            add_peak(D, z, W.place[which])
            is_high = before > (1.0 - Q.line) * D.best and D.sure[z] == 0 and W.double[z] == 0
            if is_high and H.intervals[z] < FINEST and may_be_refined(H, C, z):
                W.double[z], D.sure[z] = 1, 1
                doubled += 1
        if H.instants + doubled * ROOM > MAX_INSTANTS:
            break
        for z in range(H.parts):
            if W.double[z]:
                if H.intervals[z] == FINEST:
                    forget_peaks(D, z)
                refine(H, z, C, P, L, K, Q.poisson_ratio, Q.friction)
        see_parts(D, H)
        m = refill(D, S, H, W, G, Q, angle)
        G.best = 0.0
        climb_from(G, S, m, Q, n[0], n[1], n[2])
        if doubled == 0 and G.best <= before * (1.0 + Q.plane):
            break


@jit
def see_parts(D, H):
    """Note new parts of the cycle."""
    for z in range(D.parts, H.parts):
        D.sure[z] = 0
    D.parts = H.parts


@jit
def value_at(D, G, S, H, W, C, P, K, L, Q, angle, floor):
    """Largest h over the planes at an angle; below the floor it may be low."""
    D.angles += 1
    for _ in range(4):
        m = refill(D, S, H, W, G, Q, angle)
        h, instants = highest_plane(G, S, m, Q, floor, Q.plane), H.instants
        D.tension, D.swing = G.most[0], max(D.swing, G.most[1])
        if h <= (1.0 - BETWEEN) * floor:
            break
        settle(D, G, S, H, W, C, P, K, L, Q, angle)
        h = G.best
        if H.instants == instants:
            break
    D.best = max(D.best, h)
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
def first_arcs(D, G, S, H, W, C, P, K, L, Q):
    """Look at evenly spaced angles; returns the number of arcs between them."""
    arcs = ARCS // 2 if L.mirrored else ARCS
    for k in range(arcs + 1):
        angle = pi * k / ARCS
        value = value_at(D, G, S, H, W, C, P, K, L, Q, angle, FAR * D.best)
        if k < arcs:
            set_end(D, G, k, 0, angle, value)
        if k > 0:
            set_end(D, G, k - 1, 1, angle, value)
    return arcs


@jit
def search_circle(D, G, S, H, W, C, R, P, K, L, Q, largest, place, known):
    """Largest value on the circle at a place s, if it is above what is known; else that."""
    sample_cycle(H, C, R, P, K, L, place, largest, Q.poisson_ratio, Q.friction, 1.0)
    bound_turning(D, H, Q)
    D.angles, D.peaks, D.next, D.parts, D.swing, D.highest = 0, 0, 0, 0, 0.0, 0.0
    D.best = least = lift(Q, known)
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    see_parts(D, H)
    m = first_arcs(D, G, S, H, W, C, P, K, L, Q)
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
        halve_arc(D, G, S, H, W, C, P, K, L, Q, k, m)
        m += 1
    return value_of(Q, D.best) if D.best > least else known


@jit
def halve_arc(D, G, S, H, W, C, P, K, L, Q, k, m):
    """Halve arc k; its upper half becomes arc m."""
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
    value = value_at(D, G, S, H, W, C, P, K, L, Q, angle, max(D.best - 0.125 * drop, FAR * D.best))
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
def surface_value(D, G, S, C, R, H, W, K, P, L, Q, found):
    """Largest value on the circle through the point's maximum; s itself if that is not exceeded.

    NaN where the maximum is at the singular edge of a face: next to it the pressure has no bound. Where a
    bulk stress leaves no tension on the line, or s is that of the bulk stress, it is the circle of the
    largest contact radius. With a bulk stress the circle of the smallest contact radius counts, too: outside
    of the contact the radial tension of the pressure is largest there, and at its sides the bulk stress does
    not press on it.
    """
    s, known, place = found.s, (1.0 + HIGHER) * found.s, found.place
    at_infinity = np.isnan(found.critical_x)
    nowhere = (s <= found.s_error or at_infinity) and may_be_anywhere(L, Q)
    if at_infinity and not nowhere:
        return s
    if not nowhere and beside_singular_edge(P, found.critical_x, NEAREST):
        return np.nan
    solve_cycle(C, L)
    lay_out(R, C, P, L, found.growth)
    largest, b = place_of(P, C.largest), P.flat_radius
    if nowhere:
        place = largest
    top = known
    if b * b + place * abs(place) > 0.0:
        top = search_circle(D, G, S, H, W, C, R, P, K, L, Q, largest, place, top)
    if has_bulk(L) and not P.singular:
        place = place_of(P, max(C.smallest, 0.0))
        if b > 0.0:  # at the very edge of a face tables of the radius have no scale
            place = max(place, INNERMOST * largest)
        if b * b + place * abs(place) > 0.0:
            top = search_circle(D, G, S, H, W, C, R, P, K, L, Q, largest, place, top)
    return top if top > known else s


@jit
def search_circles(D, G, S, C, R, _, H, W, K, profiles, which, loads, asks, found):
    """Write the largest values on the circles of points, where the line may not be enough.

    Not where the stick zone is shifted (`swtstudy.kernel.shifted_circle`).
    """
    for i in range(which.shape[0]):
        if found[i].circle and found[i].shift == 0.0:
            profile, load = profiles[which[i]], loads[i]
            top = surface_value(D, G, S, C, R, H, W, K, profile, load, asks[i], found[i])
            found[i].s_surface, found[i].overflow = top, C.overflow
