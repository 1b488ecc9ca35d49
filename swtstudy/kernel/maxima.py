"""Local maxima of the criterion along the surface line, above a lower limit.

The line is halved as in the search for the largest value (`swtstudy.kernel.line`), but until no interval
hides anything that exceeds its own ends by more than `MAPPED`, or the limit. Places as high as both
neighbours are maxima; about each of them intervals are halved until none hides more than `FOUND` above it.
"""

from math import sqrt

import numpy as np

from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import FIRST
from swtstudy.kernel.line import (
    MAX_INTERVALS,
    MAX_SEEN,
    MOST_POSITIONS,
    begin_search,
    bound_of,
    cut,
    halve,
    position,
)
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.shift import shift_of

#: What may be hidden between two places, over the values there, and above a maximum, over its value.
MAPPED, FOUND = 5e-3, 1e-4
#: Most maxima of a point.
MAX_MAXIMA = 2003
MAXIMA = np.dtype(
    [
        ("maxima", "i8"),
        ("place", "f8", (MAX_MAXIMA,)),  # s
        ("side", "i8", (MAX_MAXIMA,)),  # 0: x > 0, 1: x < 0
        ("x", "f8", (MAX_MAXIMA,)),
        ("angle", "f8", (MAX_MAXIMA,)),  # 2θ
        ("value", "f8", (MAX_MAXIMA,)),
        ("between", "f8", (MAX_MAXIMA, 2)),  # places s of its neighbours, in the end x
        ("rank", "i8", (MAX_SEEN,)),  # positions in the order of their places
        ("overflow", "i8"),
    ]
)


def maxima():
    """The memory for local maxima that one thread needs, beside its workspace."""
    return new_record(MAXIMA)


@jit
def excess(S, k, limit):
    """Bound of interval k over its ends and the limit: 1 at most where nothing matters."""
    most = 0.0
    for side in range(2):
        known = (1.0 + MAPPED) * max(S.at_ends[k, 0, side], S.at_ends[k, 1, side])
        most = max(most, bound_of(S, k, side) / max(known, limit))
    return most


@jit
def map_line(S, H, W, C, R, P, K, L, Q, limit):
    """Evaluate places until nothing above the limit is hidden; returns the number of intervals."""
    smallest, largest, cusp_count, m = begin_search(S, H, W, C, R, P, K, L, Q)
    while m + 2 <= MAX_INTERVALS and S.positions <= MOST_POSITIONS:
        k, most = FIRST, 0.0
        for i in range(m):
            hidden = excess(S, i, limit)
            if hidden > most:
                k, most = i, hidden
        if most <= 1.0:
            break
        m = cut(S, H, W, C, R, P, K, L, Q, smallest, largest, cusp_count, k, m, limit)
    return m


@jit
def rank_places(S, M):
    """Write the evaluated positions in the order of their places; returns how many there are."""
    count = min(S.positions, MAX_SEEN)
    for i in range(count):
        M.rank[i] = i
    step = count // 2
    while step > 0:  # Shell's method
        for i in range(step, count):
            k, j = M.rank[i], i
            while j >= step and S.seen[M.rank[j - step]] > S.seen[k]:
                M.rank[j] = M.rank[j - step]
                j -= step
            M.rank[j] = k
        step //= 2
    return count


@jit
def find_tops(S, M, side, limit):
    """Append the places of one side that are above the limit and as high as both neighbours."""
    count = 0
    for i in range(rank_places(S, M)):
        if S.seen_value[M.rank[i], side] >= 0.0:
            M.rank[count] = M.rank[i]
            count += 1
    for i in range(count):
        k, before, after = M.rank[i], M.rank[max(i - 1, 0)], M.rank[min(i + 1, count - 1)]
        value = S.seen_value[k, side]
        if value <= limit or value < S.seen_value[before, side]:
            continue
        if i + 1 < count and value <= S.seen_value[after, side]:
            continue
        m = M.maxima
        if m >= MAX_MAXIMA:
            M.overflow = 1
            return
        M.maxima += 1
        M.place[m], M.side[m], M.value[m], M.angle[m] = S.seen[k], side, value, S.seen_angle[k, side]
        M.between[m, 0], M.between[m, 1] = S.seen[before], S.seen[after]


@jit
def refine_top(S, M, H, W, C, R, P, K, L, Q, largest, top, m, limit):
    """Halve the intervals next to a maximum until none hides more; returns the number of intervals."""
    side, low, high = M.side[top], M.between[top, 0], M.between[top, 1]
    narrow = 1e-9 * (high - low)
    while m + 2 <= MAX_INTERVALS and S.positions < MAX_SEEN:
        k, most = FIRST, (1.0 + FOUND) * M.value[top]
        found = False
        for i in range(m):
            if S.cusps[i, 1] == 0 and bound_of(S, i, side) > most:
                left, right = position(S, i, S.ends[i, 0]), position(S, i, S.ends[i, 1])
                if left >= low - narrow and right <= high + narrow and right - left > narrow:
                    k, most, found = i, bound_of(S, i, side), True
        if not found:
            break
        halve(S, H, W, C, R, P, K, L, Q, largest, k, m, limit)
        m += 1
        last = S.positions - 1
        if S.seen_value[last, side] > M.value[top]:
            M.place[top], M.value[top] = S.seen[last], S.seen_value[last, side]
            M.angle[top] = S.seen_angle[last, side]
    return m


@jit
def find_maxima(C, R, S, H, W, K, M, P, L, Q, limit):
    """Find the local maxima above the limit of one point; those of a mirrored load at x > 0 alone."""
    M.maxima, M.overflow = 0, 0
    solve_cycle(C, L)
    if C.overflow or C.no_equilibrium:
        M.overflow = C.overflow
        return
    C.shift = shift_of(L, P, Q, C.event, C.events)
    lay_out(R, C, P, L, Q.growth)
    m = map_line(S, H, W, C, R, P, K, L, Q, limit)
    for side in range(1 if L.mirrored else 2):
        find_tops(S, M, side, limit)
    b = P.flat_radius
    for top in range(M.maxima):
        m = refine_top(S, M, H, W, C, R, P, K, L, Q, place_of(P, C.largest), top, m, limit)
        sign = 1.0 - 2.0 * M.side[top]
        M.x[top] = sign * sqrt(b * b + M.place[top] * abs(M.place[top]))
        for end in range(2):
            place = M.between[top, end]
            M.between[top, end] = sign * sqrt(b * b + place * abs(place))
    M.overflow = max(M.overflow, C.overflow)


@jit
def find_maxima_of(C, R, S, H, W, K, M, profiles, which, loads, asks, i, limit):
    """Local maxima of point i: profile which[i], loads[i], asks[i]."""
    find_maxima(C, R, S, H, W, K, M, profiles[which[i]], loads[i], asks[i], limit)
