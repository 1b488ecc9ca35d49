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

from math import cos, pi, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST
from swtstudy.kernel.at_place import ASKED, MAX_SEEN, evaluate
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import MAX_STRETCHES, NONE
from swtstudy.kernel.cusps import GROUPS, cusps, ends_group
from swtstudy.kernel.history import FIRST, is_sharp
from swtstudy.kernel.planes import above
from swtstudy.kernel.profile import place_of

MAX_INTERVALS = 65_543
#: A search ends after so many positions.
MOST_POSITIONS = 20_000
SEARCH = np.dtype(
    [
        ("cusp", "f8", (14 * MAX_STRETCHES,)),
        ("last", "i8"),  # number of the last cusp
        ("positions", "i8"),  # that have been evaluated
        *fields("f8", "smallest largest"),  # places s of the smallest and the largest contact
        ("singular", "i8"),  # 1: the face's edge is singular
        ("crowd", "f8"),  # length over which many cusps are spread; 0 if there are few
        *fields("f8", "best place sign angle"),  # the largest value, its place s, the sign of x, and 2θ
        ("tension", "f8"),  # the smaller one of largest σ_n and half the range of the swing, where they count
        ("value", "f8", (2,)),  # at the last position, on both sides
        ("seen", "f8", (MAX_SEEN,)),  # places of the positions, in the order of the search
        *fields("f8", "seen_value seen_angle", (MAX_SEEN, 2)),  # values and 2θ there; -1 where not asked for
        ("intervals", "i8"),
        *fields("f8", "ends piece", (MAX_INTERVALS, 2)),  # ends in angles on the piece, ends of the piece
        ("beside", "f8", (MAX_INTERVALS, 2)),  # lengths of the pieces beside it
        ("cusps", "i8", (MAX_INTERVALS, 2)),  # a group of pieces: its first and last cusp; 0, 0 if it is none
        ("at_ends", "f8", (MAX_INTERVALS, 2, 2)),  # values at both ends, on both sides
        ("upper", "i8", (MAX_INTERVALS,)),  # 1: the upper half of what was halved
        ("unseen", "i8", (MAX_INTERVALS,)),  # 1: a piece on which the growth may turn, without a value within
        ("beyond", "f8", (MAX_INTERVALS, 2)),  # value at the other end of the other half
        ("drop", "f8", (MAX_INTERVALS, 2)),  # K w² on both sides
        # The bound; and among many cusps the relative rise over the root of the length.
        *fields("f8", "bound rise", (MAX_INTERVALS,)),
    ]
)
#: Places next to a sharp tip at first.
TIP = np.int64(8)
#: Bound of K w² of a piece of the line at first, in its values or their range; of twice the third difference
#: later on: that may change the second difference by four times as much.
TRUST = 8.0
#: Share of the bound of K w² of an interval that its halves keep, whatever they show.
MEMORY = 0.25
#: Wider pieces, as a share of the largest contact, may have a turn of the growth within.
NARROW = 1e-3
#: Values within a width w of many cusps, spread over d, are higher than at its ends by this times √(w/d) at
#: most, and by this times what is seen in a group.
RISE = 4.0
#: Cusps above this share of the best value are looked beside, up to where the value is so near to that at the
#: cusp, as a share of the tolerance; nowhere nearer than in this angle.
HIGH, BESIDE, FINEST_ANGLE = 0.99, 0.25, 1e-6
#: Largest ratio of the lengths of two pieces beside each other, where it matters, and of the ends of a piece
#: next to a singular edge that is not spaced in ln s.
GRADED = 20.0


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
def set_piece(S, k, left, right):
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
def set_group(S, k, first, last, L):
    """Make interval k the pieces between two cusps: a group, or a piece if there is but one."""
    left, right = S.cusp[first], S.cusp[last]
    S.cusps[k, 0], S.cusps[k, 1] = (first, last) if last > first + 1 else (0, 0)
    S.unseen[k] = 0
    if last == first + 1:
        inside = left >= S.smallest * (1.0 - 1e-9) and right <= S.largest * (1.0 + 1e-9)
        S.unseen[k] = L.sides == 0 and inside and right - left > NARROW * S.largest
        S.beside[k, 0] = left - S.cusp[first - 1] if first > 0 else right - left
        S.beside[k, 1] = S.cusp[last + 1] - right if last < S.last else right
    set_piece(S, k, left, right)


@jit
def grade(S, point, k):
    """Cut interval k beside much shorter pieces, where the value may be the largest.

    The cusps at the other end of a short piece are close to this one, too. A piece that is at most GRADED
    times as long as its neighbour has them at some distance, in its angle. New intervals are the last ones.
    """
    near, new = point[7].near * S.best, S.intervals
    while k < S.intervals and S.intervals + 1 < MAX_INTERVALS and S.cusps[k, 1] == 0:
        cut = False
        for end in range(2):
            length, f = S.piece[k, 1] - S.piece[k, 0], S.at_ends[k]
            if length <= 2.0 * GRADED * S.beside[k, end] or max(f[end, 0], f[end, 1]) < near:
                continue
            step, m = GRADED * S.beside[k, end], S.intervals
            x = S.piece[k, 1] - step if end else S.piece[k, 0] + step
            # A side that has not been looked at, since it cannot matter, has the value 0 at both ends.
            evaluate(S, point, x, max(f[0, 0], f[1, 0]) > 0.0, max(f[0, 1], f[1, 1]) > 0.0)
            near, outer = point[7].near * S.best, S.piece[k, end]
            for side in range(2):
                S.at_ends[m, end, side], S.at_ends[m, 1 - end, side] = f[end, side], S.value[side]
                f[end, side] = S.value[side]
            S.beside[m, end], S.beside[m, 1 - end], S.beside[k, end] = S.beside[k, end], length - step, step
            S.unseen[m], S.cusps[m, 0], S.cusps[m, 1], S.rise[m] = S.unseen[k], 0, 0, S.rise[k]
            set_piece(S, m, x if end else outer, outer if end else x)
            set_piece(S, k, S.piece[k, 0] if end else x, x if end else S.piece[k, 1])
            S.intervals += 1
            cut = True
        if not cut:
            k = max(k + 1, new)


@jit
def divide(S, point, k, limit):
    """Divide the group of pieces k at its middle cusp. A side without a value above the limit is left out."""
    first, last, m, L = S.cusps[k, 0], S.cusps[k, 1], S.intervals, point[6]
    middle = (first + last) // 2
    plus, minus = bound_of(S, k, 0) > limit, bound_of(S, k, 1) > limit
    evaluate(S, point, S.cusp[middle], plus, minus)
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
    set_group(S, k, first, middle, L)
    set_group(S, m, middle, last, L)
    S.intervals += 1
    grade(S, point, k)
    grade(S, point, m)


@jit
def first_intervals(S, point):
    """Evaluate cusps and make intervals of the pieces between them, and groups if there are many."""
    S.crowd, S.intervals, L = 0.0, 0, point[6]
    if S.last > 2 * GROUPS:
        k = 0
        while S.cusp[k] < 0.5 * S.smallest:
            k += 1
        S.crowd = max(S.largest - S.cusp[k], 1e-6 * S.largest)
    after, plus, minus = -1, 0.0, 0.0
    for j in range(S.last, -1, -1):  # the largest values are near the edges
        if not ends_group(S, j, S.last, S.largest):
            continue
        evaluate(S, point, S.cusp[j], ASKED, ASKED)
        if after > 0:
            m = S.intervals
            S.at_ends[m, 0, 0], S.at_ends[m, 0, 1] = S.value[0], S.value[1]
            S.at_ends[m, 1, 0], S.at_ends[m, 1, 1] = plus, minus
            S.rise[m] = RISE
            set_group(S, m, j, after, L)
            S.intervals += 1
        after, plus, minus = j, S.value[0], S.value[1]
    for k in range(S.intervals):
        grade(S, point, k)


@jit
def begin_search(S, point):
    """Make the first intervals of the line."""
    _, _, C, _, P, _, L, Q = point
    S.smallest, S.largest = place_of(P, C.smallest), place_of(P, C.largest)
    S.last = cusps(S, C, P, L, Q, S.largest) - 1
    S.best, S.place, S.sign, S.angle, S.tension = 0.0, 0.0, 1.0, 0.0, 0.0
    S.positions, S.singular = 0, P.singular
    first_intervals(S, point)


@jit
def search_tip(S, point):
    """Search next to a sharp tip, where the stress is linear in x^m: evenly spaced, then uphill.

    A maximum changes by the square of a distance from it, so the last step follows from the tolerance.
    """
    P, Q = point[4], point[7]
    power, best, at, step = 1.0 / (P.exponent - 1.0), -1.0, 0.0, 1.0 / TIP
    for j in range(TIP):
        evaluate(S, point, INNERMOST * S.largest * (j * step) ** power, ASKED, ASKED)
        if max(S.value[0], S.value[1]) > best:
            best, at = max(S.value[0], S.value[1]), j * step
    while best >= Q.near * S.best and step > 0.1 * sqrt(Q.line):
        step *= 0.5
        for other in (at - step, at + step):
            if 0.0 <= other < 1.0:
                evaluate(S, point, INNERMOST * S.largest * other**power, ASKED, ASKED)
                if max(S.value[0], S.value[1]) > best:
                    best, at = max(S.value[0], S.value[1]), other


@jit
def search_line(S, point):
    """Find the largest swt on the line; returns by how much a higher one may be hidden.

    Parameters
    ----------
    S
        Record of `SEARCH`.
    point
        Records of HISTORY, WORK, CYCLE, GROWTH, PROFILE, TABLE, LOAD and ASK.
    """
    P, L, Q = point[4], point[6], point[7]
    begin_search(S, point)
    if is_sharp(P):
        search_tip(S, point)
    while True:
        k, limit = highest_bound(S), S.best * (1.0 + Q.line)
        if S.bound[k] <= limit:
            share_curvature(S)
            if L.sides > 0 and L.bulk_moves:
                look_beside_cusps(S, limit)
            k = highest_bound(S)
        if S.bound[k] <= limit or S.intervals + 2 > MAX_INTERVALS or S.positions > MOST_POSITIONS:
            return max(S.bound[k] - S.best, 0.0)
        cut(S, point, k, limit)


@jit
def highest_bound(S):
    """The interval with the highest bound."""
    highest = FIRST
    for k in range(S.intervals):
        if S.bound[k] > S.bound[highest]:
            highest = k
    return highest


@jit
def share_curvature(S):
    """Give the two intervals that meet at the best place the curvature through their three values.

    A narrow interval shows a curvature that the wide one beside it has not met.
    """
    left, right, side = NONE, NONE, 0 if S.sign > 0.0 else 1
    for k in range(S.intervals):
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
def look_beside_cusps(S, limit):
    """Have intervals halved in which the value falls from a high cusp by more than the tolerance.

    At a vertex of the load the bulk stress may fall at once while slip begins, whose tension rises like a
    root. The sum has a peak beside the cusp, as narrow as the square of the friction: no value farther away
    shows it.
    """
    for k in range(S.intervals):
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
def cut(S, point, k, limit):
    """Cut interval k in two, be it a group of pieces or not; below the limit nothing matters."""
    if S.cusps[k, 1] > 0:
        divide(S, point, k, limit)
    else:
        halve(S, point, k, limit)


@jit
def halve(S, point, k, limit):
    """Halve interval k. Its upper half becomes the last interval.

    Curvature follows from the second difference, and from how far the new value is off the parabola through
    the three values before: four times that distance is what a third derivative changes in the drop.
    """
    middle, m = 0.5 * (S.ends[k, 0] + S.ends[k, 1]), S.intervals
    whole = S.ends[k, 1] - S.ends[k, 0] > 3.0
    plus, minus = bound_of(S, k, 0) > limit, bound_of(S, k, 1) > limit
    evaluate(S, point, position(S, k, middle), plus, minus)
    S.intervals += 1
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
