"""The largest swt along the surface line y = 0.

swt(x) is a maximum over planes and instants of smooth functions, so its kinks point down and only downward
curvature can hide a higher value between two positions: on an interval of width w,

    swt ≤ chord + K (x - x₁)(x₂ - x)/2,   K ≥ -swt″.

Pieces of the line end at its cusps, the places where the edge, a slip front or the growth turns. On a piece,
an angle makes root cusps at its ends smooth. The interval with the highest bound is halved until no bound
exceeds the best value by more than the tolerance; what is left is the error.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.contact import MAX_STRETCHES
from swtstudy.kernel.history import FIRST, MAX_INSTANTS, ROOM, refine, sample_cycle
from swtstudy.kernel.load import distinct
from swtstudy.kernel.planes import (
    MINUS_STRAIN,
    STEP,
    STRAIN,
    STRESS,
    above,
    climb,
    fill,
    find_peaks,
    higher_plane,
    survey_planes,
    unresolved,
)
from swtstudy.kernel.profile import coordinate_at, place_of, radius_of

MAX_INTERVALS = 65_543
ASK = np.dtype(
    [
        ("poisson_ratio", "f8"),
        ("friction", "f8"),
        ("line", "f8"),  # relative tolerances: of the search along the line,
        ("time", "f8"),  # of the series over time,
        ("plane", "f8"),  # of the search over planes,
        ("growth", "f8"),  # of the series of dv/dn
        ("near", "f8"),
        ("trust", "f8"),
        ("safety", "f8"),
        ("surprise", "f8"),
        ("memory", "f8"),
        ("narrow", "f8"),
    ]
)
SEARCH = np.dtype(
    [
        ("cusp", "f8", (4 * MAX_STRETCHES,)),
        ("positions", "i8"),  # that have been evaluated
        ("best", "f8"),
        ("x", "f8"),
        ("angle", "f8"),  # 2θ
        ("tension", "f8"),  # the smaller one of largest σ_n and half the range of ε_n there
        ("value", "f8", (2,)),  # at the last position, on both sides
        ("ends", "f8", (MAX_INTERVALS, 2)),  # angles on the piece
        ("piece", "f8", (MAX_INTERVALS, 2)),  # ends of the piece
        ("beside", "f8", (MAX_INTERVALS, 2)),  # lengths of the pieces beside it
        ("at_ends", "f8", (MAX_INTERVALS, 2, 2)),  # values at both ends, on both sides
        ("upper", "i8", (MAX_INTERVALS,)),  # 1: the upper half of what was halved
        ("unseen", "i8", (MAX_INTERVALS,)),  # 1: a piece on which the growth may turn, without a value within
        ("beyond", "f8", (MAX_INTERVALS, 2)),  # value at the other end of the other half
        ("drop", "f8", (MAX_INTERVALS, 2)),  # K w² on both sides
        ("bound", "f8", (MAX_INTERVALS,)),
    ]
)
#: Most rounds in which parts of a cycle are doubled.
ROUNDS = 12
#: A side that is asked for; no literal, for which Numba would compile anew.
ASKED = np.bool_(True)
#: Largest ratio of the lengths of two pieces beside each other, where it matters.
GRADED = 50.0
#: A position whose bound over planes is below this share of what is near the best is not looked at closer.
ROUGH = 0.9


def ask(
    poisson_ratio, friction, rtol, near=0.9, trust=8.0, safety=2.0, surprise=8.0, memory=0.25, narrow=1e-3
):
    """Bodies, tolerances and the numbers of the search."""
    record = new_record(ASK)
    record["poisson_ratio"], record["friction"] = poisson_ratio, friction
    record["line"], record["time"], record["plane"], record["growth"] = (
        0.5 * rtol,
        0.25 * rtol,
        0.1 * rtol,
        0.5 * rtol,
    )
    record["near"], record["trust"], record["safety"] = near, trust, safety
    record["surprise"], record["memory"], record["narrow"] = surprise, memory, narrow
    return record


@jit
def cusps(S, C, P, largest):
    """Write the sorted ends of the pieces of the line; returns how many, and the largest contact radius."""
    z = S.cusp
    radius = radius_of(P, largest)
    z[0], z[1], z[2] = 0.02 * radius, 1.3 * radius, 4.0 * radius
    m = 3
    if P.flat_radius > 0.0:
        z[m] = P.flat_radius * (1.0 + 1e-9)
        m += 1
    if not P.is_paraboloid:  # no piece is longer than half a wave of the profile
        for p in range(1, P.panels):
            if P.begin[p] < largest:
                z[m] = radius_of(P, P.begin[p])
                m += 1
    for k in range(C.stretches):
        for e in range(2):
            for G in (C.edge[k, e], C.front[k, e]):
                if G > 0.0:
                    s = place_of(P, G)
                    z[m] = radius_of(P, s)
                    m += 1
    for i in range(C.pieces):
        if C.used[i] and C.start_s[i] > 0.0 and m < z.shape[0]:
            z[m] = radius_of(P, C.start_s[i])
            m += 1
    return distinct(z, m, 1e-14 * radius), radius


@jit
def resolve(H, W, C, P, K, L, side, swt, angle, Q, best):
    """Double the parts of the cycle that may hide a higher value on the critical plane, until none does.

    A value that may become the best is confirmed: the parts with the maxima of its curves are doubled until
    it stays. Returns swt and 2θ.
    """
    e = 1.0 + Q.poisson_ratio
    unit = 0.5 / (1.0 - Q.poisson_ratio * Q.poisson_ratio)
    for _ in range(ROUNDS):
        Ct, St = cos(angle), sin(angle)
        find_peaks(H, W, Ct, St, e)
        most, doubled, confirming = 0.0, 0, False
        for z in range(H.parts):
            W.double[z] = 0
            miss = unresolved(H, W, z, Ct, St, e, Q.time)
            if miss > 0.0 and H.intervals[z] < FINEST:
                most = max(most, miss)
                W.double[z] = 1
                doubled += 1
        if doubled == 0 and swt > (1.0 - Q.line) * best:
            confirming = True
            for which in range(3):
                z = W.part[which]
                if H.intervals[z] < FINEST and W.double[z] == 0:
                    W.double[z] = 1
                    doubled += 1
        if (
            doubled == 0
            or swt * (1.0 + 2.0 * most) < Q.near * best
            or H.instants + doubled * ROOM > MAX_INSTANTS
        ):
            break
        for z in range(H.parts):
            if W.double[z]:
                refine(H, z, C, P, L, K, Q.poisson_ratio, Q.friction)
        fill(H, W, side, Q.poisson_ratio)
        before = swt
        value, angle = climb(H, W, angle, e, Q.plane)
        swt = unit * value
        if confirming and abs(swt - before) <= Q.time * swt:
            break
    return swt, angle


@jit
def swt_at(S, H, W, C, P, K, L, Q, side):
    """swt of the sampled cycle at side · x, and 2θ of its plane: rough where it cannot matter."""
    nu = Q.poisson_ratio
    e, unit = 1.0 + nu, 0.5 / (1.0 - nu * nu)
    floor = Q.near * S.best
    first, bound = survey_planes(H, W, side, nu)
    if unit * bound < ROUGH * floor or W.value[first] <= 0.0:
        return unit * W.value[first], STEP * first
    value, angle = climb(H, W, STEP * first, e, Q.plane)
    swt = unit * value
    for _ in range(4):
        instants = H.instants
        swt, angle = resolve(H, W, C, P, K, L, side, swt, angle, Q, S.best)
        if swt < floor:
            break
        if H.instants > instants:
            survey_planes(H, W, side, nu)
        value, other = higher_plane(H, W, swt / unit, e, Q.plane)
        if unit * value <= swt:
            break
        value, angle = climb(H, W, other, e, Q.plane)
        swt = unit * value
    return swt, angle


@jit
def evaluate(S, H, W, C, R, P, K, L, Q, largest, x, plus, minus):
    """Values at x and -x, where asked: few instants at first, more where the value may be the largest."""
    S.positions += 1
    b = P.flat_radius
    X2 = x * x - b * b
    G = -1.0 if x < b else coordinate_at(P, sqrt(X2)) if largest * largest >= X2 else np.inf
    sample_cycle(H, C, R, P, K, L, x, G, largest, Q.poisson_ratio, Q.friction)
    for side in range(2):
        if side == 1 and L.mirrored:
            S.value[1] = S.value[0]
            continue
        S.value[side] = 0.0
        if (side == 0 and not plus) or (side == 1 and not minus):
            continue
        sign = 1.0 - 2.0 * side
        swt, angle = swt_at(S, H, W, C, P, K, L, Q, sign)
        S.value[side] = swt
        if swt > S.best:
            S.best, S.x, S.angle = swt, sign * x, angle
            S.tension = min(W.top[STRESS], 0.5 * (W.top[STRAIN] + W.top[MINUS_STRAIN]))


@jit
def set_bound(S, k):
    """Bound of interval k over both sides."""
    plus = above(S.at_ends[k, 0, 0], S.at_ends[k, 1, 0], S.drop[k, 0])
    minus = above(S.at_ends[k, 0, 1], S.at_ends[k, 1, 1], S.drop[k, 1])
    S.bound[k] = 1e300 if S.unseen[k] else max(plus, minus)


@jit
def position(S, k, angle):
    """Position at an angle on the piece of interval k."""
    left, right = S.piece[k, 0], S.piece[k, 1]
    return 0.5 * (left + right) - 0.5 * (right - left) * cos(angle)


@jit
def set_piece(S, k, left, right, Q):
    """Make interval k a whole piece from left to right, between whose values the trust is a bound."""
    S.piece[k, 0], S.piece[k, 1], S.ends[k, 0], S.ends[k, 1] = left, right, 0.0, pi
    for side in range(2):
        S.drop[k, side] = Q.trust * max(S.at_ends[k, 0, side], S.at_ends[k, 1, side])
    set_bound(S, k)


@jit
def grade(S, H, W, C, R, P, K, L, Q, largest, m):
    """Cut pieces beside much shorter ones, where the value may be the largest; returns their number.

    The cusps at the other end of a short piece are close to this one, too. A piece that is at most GRADED
    times as long as its neighbour has them at some distance, in its angle.
    """
    k = 0
    while k < m and m + 1 < MAX_INTERVALS:
        cut = False
        for end in range(2):
            length = S.piece[k, 1] - S.piece[k, 0]
            near = max(S.at_ends[k, end, 0], S.at_ends[k, end, 1]) >= Q.near * S.best
            if length <= 2.0 * GRADED * S.beside[k, end] or not near:
                continue
            step = GRADED * S.beside[k, end]
            x = S.piece[k, 1] - step if end else S.piece[k, 0] + step
            evaluate(S, H, W, C, R, P, K, L, Q, largest, x, ASKED, ASKED)
            outer = S.piece[k, end]
            for side in range(2):
                S.at_ends[m, end, side], S.at_ends[m, 1 - end, side] = S.at_ends[k, end, side], S.value[side]
                S.at_ends[k, end, side] = S.value[side]
            S.beside[m, end], S.beside[m, 1 - end], S.beside[k, end] = S.beside[k, end], length - step, step
            S.unseen[m] = S.unseen[k]
            set_piece(S, m, x if end else outer, outer if end else x, Q)
            set_piece(S, k, S.piece[k, 0] if end else x, x if end else S.piece[k, 1], Q)
            m += 1
            cut = True
        if not cut:
            k += 1
    return m


@jit
def search_line(S, H, W, C, R, P, K, L, Q):
    """Find the largest swt on the line; returns by how much a higher one may be hidden."""
    largest = place_of(P, C.largest)
    m, radius = cusps(S, C, P, largest)
    m -= 1
    smallest = radius_of(P, place_of(P, C.smallest))
    S.best, S.x, S.angle, S.positions = 0.0, 0.0, 0.0, 0
    for j in range(m, -1, -1):  # the largest values are near the edges
        evaluate(S, H, W, C, R, P, K, L, Q, largest, S.cusp[j], ASKED, ASKED)
        for side in range(2):
            S.at_ends[j, 0, side] = S.value[side]
            if j > 0:
                S.at_ends[j - 1, 1, side] = S.value[side]
    for j in range(m):
        left, right = S.cusp[j], S.cusp[j + 1]
        inside = left >= smallest * (1.0 - 1e-9) and right <= radius * (1.0 + 1e-9)
        S.unseen[j] = inside and right - left > Q.narrow * radius
        S.beside[j, 0] = left - S.cusp[j - 1] if j > 0 else left
        S.beside[j, 1] = S.cusp[j + 2] - right if j + 1 < m else right
        set_piece(S, j, left, right, Q)
    m = grade(S, H, W, C, R, P, K, L, Q, largest, m)
    gap = 0.0
    while True:
        k = FIRST
        for i in range(m):
            if S.bound[i] > S.bound[k]:
                k = i
        gap = S.bound[k] - S.best
        if gap <= Q.line * S.best or m + 2 > MAX_INTERVALS or S.positions > 20_000:
            break
        halve(S, H, W, C, R, P, K, L, Q, largest, k, m)
        m += 1
    return max(gap, 0.0)


@jit
def halve(S, H, W, C, R, P, K, L, Q, largest, k, m):
    """Halve interval k; its upper half becomes interval m.

    Curvature follows from the second difference, and from how far the new value is off the parabola through
    the three values before: four times that distance is what a third derivative changes in the drop.
    """
    middle = 0.5 * (S.ends[k, 0] + S.ends[k, 1])
    whole = S.ends[k, 1] - S.ends[k, 0] > 3.0
    limit = S.best * (1.0 + Q.line)
    plus = S.unseen[k] > 0 or above(S.at_ends[k, 0, 0], S.at_ends[k, 1, 0], S.drop[k, 0]) > limit
    minus = S.unseen[k] > 0 or above(S.at_ends[k, 0, 1], S.at_ends[k, 1, 1], S.drop[k, 1]) > limit
    evaluate(S, H, W, C, R, P, K, L, Q, largest, position(S, k, middle), plus, minus)
    S.piece[m, 0], S.piece[m, 1] = S.piece[k, 0], S.piece[k, 1]
    S.ends[m, 0], S.ends[m, 1], S.ends[k, 1] = middle, S.ends[k, 1], middle
    S.unseen[k] = S.unseen[m] = 0
    upper = S.upper[k]
    S.upper[k], S.upper[m] = 0, 1
    for side in range(2):
        f1, f2, f = S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.value[side]
        if (side == 0 and plus) or (side == 1 and minus):
            drop = Q.safety * (2.0 * f - f1 - f2)
            if whole:
                drop = max(drop, Q.trust * (max(f1, f2, f) - min(f1, f2, f)))
            else:
                near, far = (f1, f2) if upper else (f2, f1)
                expected = 0.125 * (3.0 * far + 6.0 * near - S.beyond[k, side])
                drop = max(drop, 0.0) + Q.surprise * abs(f - expected)
                drop = max(drop, Q.memory * S.drop[k, side])
        else:  # nothing here can matter
            f1, f2, f, drop = 0.0, 0.0, 0.0, 0.0
        S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.beyond[k, side] = f1, f, f2
        S.at_ends[m, 0, side], S.at_ends[m, 1, side], S.beyond[m, side] = f, f2, f1
        S.drop[k, side] = S.drop[m, side] = drop
    set_bound(S, k)
    set_bound(S, m)
