"""The largest value of the criterion along the surface line y = 0.

Positions are places s = √(x² - b²) on the profile, in which roots at the edge of a face are smooth, and
-√(b² - x²) under the face. The value, here swt, is a maximum over planes and instants of smooth functions, so
that its kinks point down and only downward curvature can hide a higher one between two places: on an interval
of width w,

    swt ≤ chord + K (s - s₁)(s₂ - s)/2,   K ≥ -swt″.

Pieces of the line end at its cusps, the places where the edge, a slip front or the growth turns. On a piece,
an angle makes root cusps at its ends smooth. The interval with the highest bound is halved until no bound
exceeds the best value by more than the tolerance; what is left is the error.
"""

from math import cos, exp, pi, sin, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST
from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.contact import MAX_STRETCHES, NONE
from swtstudy.kernel.criterion import CRITERION, FINDLEY, SWT, lift, set_criterion, value_of
from swtstudy.kernel.history import FIRST, MAX_INSTANTS, ROOM, may_be_refined, refine, sample_cycle
from swtstudy.kernel.load import distinct, has_bulk
from swtstudy.kernel.planes import (
    BETWEEN,
    MINUS_SWING,
    STEP,
    STRESS,
    SWING,
    above,
    climb,
    fill,
    find_peaks,
    higher_plane,
    mark_unresolved,
    survey_planes,
)
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.shift import centre_of

MAX_INTERVALS, MAX_SEEN = 65_543, 24_001
#: A search ends after so many positions.
MOST_POSITIONS = 20_000
ASK = np.dtype(
    [
        ("poisson_ratio", "f8"),
        ("friction", "f8"),
        ("pulled", "f8"),  # strain of the body with the bulk stress over the mean of both
        *CRITERION,
        ("line", "f8"),  # relative tolerances: of the search along the line,
        ("time", "f8"),  # of the series over time,
        ("plane", "f8"),  # of the search over planes,
        ("growth", "f8"),  # of the series of dv/dn
        ("near", "f8"),  # positions below this share of the best are not looked at closer
    ]
)
SEARCH = np.dtype(
    [
        ("cusp", "f8", (14 * MAX_STRETCHES,)),
        ("positions", "i8"),  # that have been evaluated
        ("singular", "i8"),  # 1: the face's edge is singular
        ("crowd", "f8"),  # length over which many cusps are spread; 0 if there are few
        ("best", "f8"),
        ("place", "f8"),  # s there
        ("sign", "f8"),  # of x
        ("angle", "f8"),  # 2θ
        ("tension", "f8"),  # the smaller one of largest σ_n and half the range of the swing, where they count
        ("value", "f8", (2,)),  # at the last position, on both sides
        ("seen", "f8", (MAX_SEEN,)),  # places of the positions, in the order of the search
        ("seen_value", "f8", (MAX_SEEN, 2)),  # values there on both sides; -1 where none was asked for
        ("seen_angle", "f8", (MAX_SEEN, 2)),  # 2θ
        ("ends", "f8", (MAX_INTERVALS, 2)),  # angles on the piece
        ("piece", "f8", (MAX_INTERVALS, 2)),  # ends of the piece
        ("beside", "f8", (MAX_INTERVALS, 2)),  # lengths of the pieces beside it
        ("rise", "f8", (MAX_INTERVALS,)),  # among many cusps: relative, over the root of the length
        ("cusps", "i8", (MAX_INTERVALS, 2)),  # a group of pieces: its first and last cusp; 0, 0 if it is none
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
#: Positions with a value, or a bound over planes, below this share of the best are not looked at closer.
NEAR = 0.9
#: Bound of K w² of a piece of the line at first, in its values or their range; of twice the third difference
#: later on: that may change the second difference by four times as much.
TRUST = 8.0
#: Share of the bound of K w² of an interval that its halves keep, whatever they show.
MEMORY = 0.25
#: Wider pieces, as a share of the largest contact, may have a turn of the growth within.
NARROW = 1e-3
#: With more than twice as many pieces these are looked at in so many groups at first.
GROUPS = 48
#: Values within a width w of many cusps, spread over d, are higher than at its ends by this times √(w/d) at
#: most, and by this times what is seen in a group.
RISE = 4.0
#: Cusps above this share of the best value are looked beside, up to where the value is so near to that at the
#: cusp, as a share of the tolerance; nowhere nearer than in this angle.
HIGH, BESIDE, FINEST_ANGLE = 0.99, 0.25, 1e-6
#: Largest ratio of the lengths of two pieces beside each other, where it matters, and of the ends of a piece
#: next to a singular edge that is not spaced in ln s.
GRADED = 20.0


#: Ends of pieces outside of the contact, in its radii: without and with a stress that reaches far.
BEYOND, FAR_BEYOND = np.array([1.3, 4.0]), np.array([1.3, 4.0, 12.0, 40.0])
#: Friction from which a contact may have its maximum at the singular edge of a face.
TEARING = 0.8


def ask(
    poisson_ratio, friction, rtol, criterion="swt", walker_exponent=0.5, normal_sensitivity=0.0, pulled=1.0
):
    """Bodies, criterion and tolerances."""
    record = new_record(ASK)
    record["poisson_ratio"], record["friction"], record["pulled"] = poisson_ratio, friction, pulled
    set_criterion(record, criterion, poisson_ratio, walker_exponent, normal_sensitivity)
    record["line"], record["time"], record["plane"], record["growth"] = (
        0.45 * rtol,
        0.25 * rtol,
        0.1 * rtol,
        0.1 * rtol,
    )
    record["near"] = NEAR
    return record


@jit
def shifted(C, P, z, m):
    """Make the last of m cusps, the size of a stick zone, the ends of that zone about its own centre."""
    if C.shift == 0.0 or m + 1 > z.shape[0]:
        return m
    s, largest = z[m - 1], place_of(P, C.largest)
    off = abs(centre_of(P, C.shift, C.largest, largest, s))
    if off == 0.0:
        return m
    z[m - 1], z[m] = s + off, max(abs(s - off), INNERMOST * largest)
    return m + 1


@jit
def cusps(S, C, P, L, Q, largest):
    """Write the sorted ends of the pieces of the line, places s; returns how many."""
    z, b = S.cusp, P.flat_radius
    radius = sqrt(b * b + largest * largest)
    m = 1
    z[0] = INNERMOST * largest
    if P.singular and Q.friction >= TEARING:
        # With L = ln(b/(|x| - b)) the strain rises like L and σ_n falls like (1 - μ) L, to 0 at the last one.
        L_edge = 4.0
        while L_edge < min(20.0 * (1.0 + radius / b) / max(1.0 - Q.friction, 1e-2), 600.0):
            z[m] = b * sqrt(2.0) * exp(-0.5 * L_edge)
            L_edge *= 2.0
            m += 1
    if Q.criterion != SWT or has_bulk(L):  # places in mere pressure, and outside of the contact
        if b > 0.0:
            z[m] = -b * (1.0 - INNERMOST)
            m += 1
        z[m] = 2.0 * largest - place_of(P, C.smallest)
        m += 1
        for factor in FAR_BEYOND:
            z[m] = sqrt(factor * factor * radius * radius - b * b)
            m += 1
    else:
        for factor in BEYOND:
            z[m] = sqrt(factor * factor * radius * radius - b * b)
            m += 1
    for j in range(1, min(int(largest / P.longest) + 1, MAX_STRETCHES)):  # half waves of the profile
        z[m] = j * P.longest
        m += 1
    for k in range(C.stretches):
        for e in range(2):
            for G in (C.edge[k, e], C.front[k, e]):
                if G > 0.0:
                    z[m] = place_of(P, G)
                    m += 1
                    m = shifted(C, P, z, m)
    for i in range(C.pieces):
        if C.used[i] and C.start_s[i] > 0.0 and m < z.shape[0]:
            z[m] = C.start_s[i]
            m += 1
            m = shifted(C, P, z, m)
    return distinct(z, m, 1e-14 * largest)


@jit
def resolve(H, W, C, P, K, L, side, swt, angle, Q, best):
    """Double the parts of the cycle that may hide a higher value on the critical plane, until none does.

    A value that may become the best is confirmed: the parts with the maxima of its curves are doubled until
    it stays. Returns swt and 2θ.
    """
    for _ in range(ROUNDS):
        Ct, St = cos(angle), sin(angle)
        find_peaks(H, W, Q, Ct, St)
        doubled, most, _ = mark_unresolved(H, W, C, Q, Ct, St, Q.time)
        confirming = False
        if doubled == 0 and swt > (1.0 - Q.line) * best:
            confirming = True
            for which in range(3):
                z = W.part[which]
                if H.intervals[z] < FINEST and W.double[z] == 0 and may_be_refined(H, C, z):
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
        fill(H, W, side, Q)
        before = swt
        h, angle = climb(H, W, Q, angle, Q.plane)
        swt = value_of(Q, h)
        if confirming and abs(swt - before) <= Q.time * swt:
            break
    return swt, angle


@jit
def swt_at(S, H, W, C, P, K, L, Q, side):
    """swt of the sampled cycle at side · x, and 2θ of its plane: rough where it cannot matter."""
    floor = Q.near * S.best
    first, bound = survey_planes(H, W, Q, side)
    if value_of(Q, bound) < floor or W.value[first] <= 0.0:
        return value_of(Q, W.value[first]), STEP * first
    h, angle = climb(H, W, Q, STEP * first, Q.plane)
    swt = value_of(Q, h)
    for _ in range(4):
        instants = H.instants
        swt, angle = resolve(H, W, C, P, K, L, side, swt, angle, Q, S.best)
        if swt < floor:
            return swt, angle
        if H.instants > instants:
            survey_planes(H, W, Q, side)
        known = lift(Q, swt)
        h, other = higher_plane(H, W, Q, known, Q.plane, swt > (1.0 - BETWEEN) * S.best)
        if h <= known:
            break
        h, other = climb(H, W, Q, other, Q.plane)
        if h <= known:
            break
        swt, angle = value_of(Q, h), other
    return swt, angle


@jit
def evaluate(S, H, W, C, R, P, K, L, Q, largest, place, plus, minus):
    """Values at place s at x > 0 and x < 0, where asked: more instants where the value may be the largest."""
    number = min(S.positions, MAX_SEEN - 1)
    S.positions += 1
    S.seen[number], S.seen_value[number, 0], S.seen_value[number, 1] = place, -1.0, -1.0
    sampled = False
    for side in range(2):
        if side == 1 and L.mirrored:
            S.value[1] = S.value[0]
            continue
        S.value[side] = 0.0
        if (side == 0 and not plus) or (side == 1 and not minus):
            continue
        sign = 1.0 - 2.0 * side
        if not sampled or C.shift != 0.0:
            sample_cycle(H, C, R, P, K, L, place, largest, Q.poisson_ratio, Q.friction, sign)
            sampled = True
        swt, angle = swt_at(S, H, W, C, P, K, L, Q, sign)
        S.value[side] = swt
        S.seen_value[number, side], S.seen_angle[number, side] = swt, angle
        if swt > S.best:
            S.best, S.place, S.sign, S.angle = swt, place, sign, angle
            find_peaks(H, W, Q, cos(angle), sin(angle))
            S.tension = 0.5 * (W.top[SWING] + W.top[MINUS_SWING])
            if Q.criterion == SWT:
                S.tension = min(S.tension, W.top[STRESS])
            elif Q.criterion == FINDLEY:
                S.tension = max(S.tension, Q.sensitivity * W.top[STRESS])


@jit
def bound_of(S, k, side):
    """Bound of interval k on one side."""
    f1, f2, drop = S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.drop[k, side]
    if S.unseen[k] and (S.crowd == 0.0 or max(f1, f2) > 0.0):  # else this side has been ruled out
        return 1e300
    if S.crowd > 0.0 and S.ends[k, 1] - S.ends[k, 0] > 3.0:
        return max(f1, f2) + 0.125 * drop
    return above(f1, f2, drop)


@jit
def set_bound(S, k):
    """Bound of interval k over both sides."""
    S.bound[k] = max(bound_of(S, k, 0), bound_of(S, k, 1))


@jit
def position(S, k, angle):
    """Place at an angle on the piece of interval k."""
    left, right = S.piece[k, 0], S.piece[k, 1]
    share = 0.5 - 0.5 * cos(angle)
    if S.singular and left > 0.0 and right > GRADED * left:
        return left * (right / left) ** share
    return left + (right - left) * share


@jit
def set_piece(S, k, left, right, Q):
    """Make interval k a whole piece from left to right, between whose values the trust is a bound."""
    S.piece[k, 0], S.piece[k, 1], S.ends[k, 0], S.ends[k, 1] = left, right, 0.0, pi
    S.upper[k] = 0
    trust = TRUST
    if S.crowd > 0.0:  # roots of distances within the piece
        trust *= min(1.0, S.rise[k] * sqrt((right - left) / S.crowd))
    for side in range(2):
        S.drop[k, side] = trust * max(S.at_ends[k, 0, side], S.at_ends[k, 1, side])
    set_bound(S, k)


@jit
def set_group(S, k, first, last, cusps, L, Q, smallest, largest):
    """Make interval k the pieces between two cusps: a group, or a piece if there is but one."""
    left, right = S.cusp[first], S.cusp[last]
    S.cusps[k, 0], S.cusps[k, 1] = (first, last) if last > first + 1 else (0, 0)
    S.unseen[k] = 0
    if last == first + 1:
        inside = left >= smallest * (1.0 - 1e-9) and right <= largest * (1.0 + 1e-9)
        S.unseen[k] = L.sides == 0 and inside and right - left > NARROW * largest
        S.beside[k, 0] = left - S.cusp[first - 1] if first > 0 else right - left
        S.beside[k, 1] = S.cusp[last + 1] - right if last < cusps else right
    set_piece(S, k, left, right, Q)


@jit
def grade(S, H, W, C, R, P, K, L, Q, largest, k, m):
    """Cut interval k beside much shorter pieces, where the value may be the largest; returns their number.

    The cusps at the other end of a short piece are close to this one, too. A piece that is at most GRADED
    times as long as its neighbour has them at some distance, in its angle. Of m intervals, new ones are the
    last.
    """
    new = m
    while k < m and m + 1 < MAX_INTERVALS and S.cusps[k, 1] == 0:
        cut = False
        for end in range(2):
            length = S.piece[k, 1] - S.piece[k, 0]
            near = max(S.at_ends[k, end, 0], S.at_ends[k, end, 1]) >= Q.near * S.best
            if length <= 2.0 * GRADED * S.beside[k, end] or not near:
                continue
            step = GRADED * S.beside[k, end]
            x = S.piece[k, 1] - step if end else S.piece[k, 0] + step
            # A side that has not been looked at, since it cannot matter, has the value 0 at both ends.
            plus = max(S.at_ends[k, 0, 0], S.at_ends[k, 1, 0]) > 0.0
            minus = max(S.at_ends[k, 0, 1], S.at_ends[k, 1, 1]) > 0.0
            evaluate(S, H, W, C, R, P, K, L, Q, largest, x, plus, minus)
            outer = S.piece[k, end]
            for side in range(2):
                S.at_ends[m, end, side], S.at_ends[m, 1 - end, side] = S.at_ends[k, end, side], S.value[side]
                S.at_ends[k, end, side] = S.value[side]
            S.beside[m, end], S.beside[m, 1 - end], S.beside[k, end] = S.beside[k, end], length - step, step
            S.unseen[m], S.cusps[m, 0], S.cusps[m, 1], S.rise[m] = S.unseen[k], 0, 0, S.rise[k]
            set_piece(S, m, x if end else outer, outer if end else x, Q)
            set_piece(S, k, S.piece[k, 0] if end else x, x if end else S.piece[k, 1], Q)
            m += 1
            cut = True
        if not cut:
            k = max(k + 1, new)
    return m


@jit
def divide(S, H, W, C, R, P, K, L, Q, smallest, largest, cusps, k, m, limit):
    """Divide the group of pieces k at its middle cusp; returns the number of intervals.

    A side on which nothing exceeds the limit does not matter.
    """
    first, last = S.cusps[k, 0], S.cusps[k, 1]
    middle = (first + last) // 2
    plus, minus = bound_of(S, k, 0) > limit, bound_of(S, k, 1) > limit
    evaluate(S, H, W, C, R, P, K, L, Q, largest, S.cusp[middle], plus, minus)
    left, right, seen = S.piece[k, 0], S.piece[k, 1], 0.0
    share = (S.cusp[middle] - left) / (right - left)
    for side in range(2):
        f1, f2, f = S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.value[side]
        if plus if side == 0 else minus:
            seen = max(seen, abs(f - f1 - share * (f2 - f1)) / max(f1, f2, f))
        else:  # nothing here can matter
            S.at_ends[k, 0, side], S.at_ends[k, 1, side] = 0.0, 0.0
        S.at_ends[m, 0, side], S.at_ends[m, 1, side] = S.value[side], S.at_ends[k, 1, side]
        S.at_ends[k, 1, side] = S.value[side]
    seen *= RISE * sqrt(S.crowd / (right - left))
    S.rise[k] = S.rise[m] = min(max(seen, MEMORY * S.rise[k]), RISE)
    set_group(S, k, first, middle, cusps, L, Q, smallest, largest)
    set_group(S, m, middle, last, cusps, L, Q, smallest, largest)
    upper = m
    m = grade(S, H, W, C, R, P, K, L, Q, largest, k, m + 1)
    return grade(S, H, W, C, R, P, K, L, Q, largest, upper, m)


@jit
def ends_group(S, j, last, largest):
    """True if cusp j of last + 1 ends a group of pieces: each if there are few, or a long piece ends."""
    step = max(last // GROUPS, 1) if last > 2 * GROUPS else 1
    gap = max(S.cusp[min(j + 1, last)] - S.cusp[j], S.cusp[j] - S.cusp[max(j - 1, 0)])
    return j % step == 0 or j == last or GROUPS * gap > largest


@jit
def first_intervals(S, H, W, C, R, P, K, L, Q, smallest, largest, cusps):
    """Evaluate cusps and make intervals of the pieces between them, and groups if there are many.

    Returns the number of intervals.
    """
    S.crowd = 0.0
    if cusps > 2 * GROUPS:
        k = 0
        while S.cusp[k] < 0.5 * smallest:
            k += 1
        S.crowd = max(largest - S.cusp[k], 1e-6 * largest)
    m, after, plus, minus = 0, -1, 0.0, 0.0
    for j in range(cusps, -1, -1):  # the largest values are near the edges
        if not ends_group(S, j, cusps, largest):
            continue
        evaluate(S, H, W, C, R, P, K, L, Q, largest, S.cusp[j], ASKED, ASKED)
        if after > 0:
            S.at_ends[m, 0, 0], S.at_ends[m, 0, 1] = S.value[0], S.value[1]
            S.at_ends[m, 1, 0], S.at_ends[m, 1, 1] = plus, minus
            S.rise[m] = RISE
            set_group(S, m, j, after, cusps, L, Q, smallest, largest)
            m += 1
        after, plus, minus = j, S.value[0], S.value[1]
    for k in range(m):
        m = grade(S, H, W, C, R, P, K, L, Q, largest, k, m)
    return m


@jit
def begin_search(S, H, W, C, R, P, K, L, Q):
    """Places s of the smallest and the largest contact, the last cusp's number, and the first intervals'."""
    smallest, largest = place_of(P, C.smallest), place_of(P, C.largest)
    cusp_count = cusps(S, C, P, L, Q, largest) - 1
    S.best, S.place, S.sign, S.angle, S.tension = 0.0, 0.0, 1.0, 0.0, 0.0
    S.positions, S.singular = 0, P.singular
    m = first_intervals(S, H, W, C, R, P, K, L, Q, smallest, largest, cusp_count)
    return smallest, largest, cusp_count, m


@jit
def search_line(S, H, W, C, R, P, K, L, Q):
    """Find the largest swt on the line; returns by how much a higher one may be hidden."""
    smallest, largest, cusp_count, m = begin_search(S, H, W, C, R, P, K, L, Q)
    while True:
        k, limit = highest_bound(S, m), S.best * (1.0 + Q.line)
        if S.bound[k] <= limit:
            share_curvature(S, m)
            if L.sides > 0 and L.bulk_moves:
                look_beside_cusps(S, m, limit)
            k = highest_bound(S, m)
        if S.bound[k] <= limit or m + 2 > MAX_INTERVALS or S.positions > MOST_POSITIONS:
            return max(S.bound[k] - S.best, 0.0)
        m = cut(S, H, W, C, R, P, K, L, Q, smallest, largest, cusp_count, k, m, limit)


@jit
def highest_bound(S, m):
    """The interval of m with the highest bound."""
    highest = FIRST
    for k in range(m):
        if S.bound[k] > S.bound[highest]:
            highest = k
    return highest


@jit
def share_curvature(S, m):
    """Give the two intervals that meet at the best place the curvature through their three values.

    A narrow interval shows a curvature that the wide one beside it has not met.
    """
    left, right, side = NONE, NONE, 0 if S.sign > 0.0 else 1
    for k in range(m):
        if S.cusps[k, 1] == 0 and S.piece[k, 0] < S.place < S.piece[k, 1]:
            if position(S, k, S.ends[k, 1]) == S.place:
                left = k
            elif position(S, k, S.ends[k, 0]) == S.place:
                right = k
    if left == NONE or right == NONE:
        return
    before, after = S.ends[left, 1] - S.ends[left, 0], S.ends[right, 1] - S.ends[right, 0]
    rise, fall = S.best - S.at_ends[left, 0, side], S.best - S.at_ends[right, 1, side]
    curvature = 2.0 * (rise / before + fall / after) / (before + after)
    S.drop[left, side] = max(S.drop[left, side], curvature * before * before)
    S.drop[right, side] = max(S.drop[right, side], curvature * after * after)
    set_bound(S, left)
    set_bound(S, right)


@jit
def look_beside_cusps(S, m, limit):
    """Have intervals halved in which the value falls from a high cusp by more than the tolerance.

    At a vertex of the load the bulk stress may fall at once while slip begins, whose tension rises like a
    root. The sum has a peak beside the cusp, as narrow as the square of the friction: no value farther away
    shows it.
    """
    for k in range(m):
        if S.cusps[k, 1] > 0 or S.ends[k, 1] - S.ends[k, 0] < FINEST_ANGLE:
            continue
        for end in range(2):
            if S.ends[k, end] != (0.0 if end == 0 else pi):
                continue
            for side in range(2):
                f = S.at_ends[k, end, side]
                fall = f - S.at_ends[k, 1 - end, side]
                if f > HIGH * S.best and fall > BESIDE * (limit - S.best):
                    S.drop[k, side] = max(S.drop[k, side], 8.0 * (limit - f) + 4.0 * fall)  # a bound above
                    set_bound(S, k)


@jit
def cut(S, H, W, C, R, P, K, L, Q, smallest, largest, cusps, k, m, limit):
    """Cut interval k in two, be it a group of pieces or not; returns the number of intervals."""
    if S.cusps[k, 1] > 0:
        return divide(S, H, W, C, R, P, K, L, Q, smallest, largest, cusps, k, m, limit)
    halve(S, H, W, C, R, P, K, L, Q, largest, k, m, limit)
    return m + 1


@jit
def halve(S, H, W, C, R, P, K, L, Q, largest, k, m, limit):
    """Halve interval k; its upper half becomes interval m. Below the limit nothing matters.

    Curvature follows from the second difference, and from how far the new value is off the parabola through
    the three values before: four times that distance is what a third derivative changes in the drop.
    """
    middle = 0.5 * (S.ends[k, 0] + S.ends[k, 1])
    whole = S.ends[k, 1] - S.ends[k, 0] > 3.0
    plus, minus = bound_of(S, k, 0) > limit, bound_of(S, k, 1) > limit
    evaluate(S, H, W, C, R, P, K, L, Q, largest, position(S, k, middle), plus, minus)
    S.piece[m, 0], S.piece[m, 1] = S.piece[k, 0], S.piece[k, 1]
    S.ends[m, 0], S.ends[m, 1], S.ends[k, 1] = middle, S.ends[k, 1], middle
    # On a piece on which the growth may turn, values at three places within tell what the first one does not.
    unseen = 1 if whole and S.unseen[k] else 0
    S.unseen[k], S.unseen[m], S.cusps[m, 0], S.cusps[m, 1] = unseen, unseen, 0, 0
    upper = S.upper[k]
    S.upper[k], S.upper[m] = 0, 1
    for side in range(2):
        f1, f2, f = S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.value[side]
        if (side == 0 and plus) or (side == 1 and minus):
            drop = 2.0 * f - f1 - f2
            if whole:
                drop = max(drop, TRUST * (max(f1, f2, f) - min(f1, f2, f)))
            else:
                near, far = (f1, f2) if upper else (f2, f1)
                expected = 0.125 * (3.0 * far + 6.0 * near - S.beyond[k, side])
                drop = max(drop, 0.0) + TRUST * abs(f - expected)
                drop = max(drop, MEMORY * S.drop[k, side])
        else:  # nothing here can matter
            f1, f2, f, drop = 0.0, 0.0, 0.0, 0.0
        S.at_ends[k, 0, side], S.at_ends[k, 1, side], S.beyond[k, side] = f1, f, f2
        S.at_ends[m, 0, side], S.at_ends[m, 1, side], S.beyond[m, side] = f, f2, f1
        S.drop[k, side] = S.drop[m, side] = drop
    set_bound(S, k)
    set_bound(S, m)
