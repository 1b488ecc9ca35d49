"""The memory diagram on the radius of a profile: starts of pieces, what grew, places of edge and front."""

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, GAUSS, LOBATTO, ORDER, barycentric, fit, panel_of, tail
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import GROWN, MAX_PIECES, NONE, OPEN, STICK, front_on
from swtstudy.kernel.events import SAME_INSTANT
from swtstudy.kernel.load import NORMAL, instant_of, load_at, rates_at
from swtstudy.kernel.profile import MAX_PANELS, coordinate_at, density_at, place_of

MAX_GROWN = 8191
#: No panel is thinner: its share of the tractions is the root of its width. Where both loads turn nearly at
#: the same instant the slope changes from one way of slip to the other within as little.
THINNEST = 1e-12
#: Panels that wait to be looked at: the profile's panels, and some 50 halvings.
WAITING = MAX_PANELS + 103
GROWTH = np.dtype(
    [
        ("panels", "i8"),
        ("crowded", "i8"),  # 1: there was no room for as many panels as the tolerance needs
        *fields("i8", "first last", (MAX_PIECES,)),  # panels of a piece that grew
        *fields("f8", "begin end", (MAX_GROWN,)),  # ends of the panels in s
        ("density", "f8", (MAX_GROWN, ORDER)),  # do/ds
    ]
)
#: A panel of no more of its place than this is none: within it places are rounding.
ROUNDED = 1e-13


@jit
def lay_out(R, C, P, L, tolerance):
    """Place the starts of pieces, and tabulate do/ds of pieces that grew and the places of edge and front.

    Returns the tolerance of the tables, a coarser one where there is no room for theirs.
    """
    while True:
        R.panels, R.crowded = 0, 0
        for i in range(C.pieces):
            if C.used[i]:
                C.start_s[i] = place_of(P, C.start[i])
                if C.kind[i] == GROWN:
                    tabulate_growth(R, C, P, L, i, tolerance)
        if R.crowded == 0 or tolerance >= 1.0:
            break
        tolerance *= 4.0
    for k in range(C.stretches):
        tabulate_places(C, P, L, k, tolerance)
    return tolerance


@jit
def tabulate_growth(R, C, P, L, i, tolerance):
    """Panels of do/ds = (dv/dn) dG/ds of one piece, halved until the series of dv/dn has died out."""
    R.first[i] = R.panels
    begin, end = C.born[i, 0], C.born[i, 1]
    lowest, highest = place_of(P, load_at(L, begin)[0]), place_of(P, load_at(L, end)[0])
    waiting = np.empty((WAITING, 2))
    slope, values, series = np.empty(ORDER), np.empty(ORDER), np.empty(ORDER)
    m = 0
    # The profile is smooth within its panels only.
    for p in range(panel_of(P.begin, 0, P.panels, highest), panel_of(P.begin, 0, P.panels, lowest) - 1, -1):
        a, b = max(lowest, P.begin[p]), min(highest, P.end[p])
        if b - a > ROUNDED * b:
            waiting[m, 0], waiting[m, 1] = a, b
            m += 1
    while m > 0:
        m -= 1
        a, b = waiting[m, 0], waiting[m, 1]
        t = begin
        for j in range(ORDER - 1, -1, -1):
            s = a + 0.5 * (b - a) * (GAUSS[j] + 1.0)
            t = instant_of(L, NORMAL, coordinate_at(P, s), t, end)
            n, v, dn, dv, ddn, ddv = rates_at(L, t)
            slope[j] = min(max(dv / dn, -1.0), 1.0) if dn > 0.0 else 0.0
            values[j] = slope[j] * density_at(P, s)
        fit(slope, series)
        rough = max(abs(series[ORDER - 1]), abs(series[ORDER - 2])) > tolerance
        room = m + 2 < WAITING and R.panels < MAX_GROWN - 512
        if rough and b - a > THINNEST and not room:
            R.crowded = 1
        elif rough and b - a > THINNEST:
            middle = 0.5 * (a + b)
            waiting[m + 1, 0], waiting[m + 1, 1] = a, middle
            waiting[m, 0], waiting[m, 1] = middle, b
            m += 2
            continue
        if R.panels >= MAX_GROWN:
            C.overflow = 1
            return
        R.begin[R.panels], R.end[R.panels] = a, b
        fit(values, R.density[R.panels])
        R.panels += 1
    R.last[i] = R.panels


@jit
def places_at(C, P, L, k, t, weight):
    """Places s of the edge and of the front at an instant of stretch k; weight has FINEST + 1 places."""
    if C.interpolated[k]:
        begin, end, intervals = C.time[k, 0], C.time[k, 1], C.intervals[k]
        barycentric(2.0 * (t - begin) / (end - begin) - 1.0, intervals, weight)
        step = FINEST // intervals
        edge, front = 0.0, 0.0
        for j in range(intervals + 1):
            edge += weight[j] * C.place[k, j * step, 0]
            front += weight[j] * C.place[k, j * step, 1]
        # Pressure follows the root of the edge's rounding: one that rests has none.
        return C.place[k, 0, 0] if C.edge[k, 0] == C.edge[k, 1] else edge, front
    return solved_places(C, P, L, k, t)


@jit
def coordinates_at(C, L, k, t):
    """Coordinates of the edge and of the front at an instant of stretch k, from the load and the diagram."""
    push, i = C.push[k], C.piece[k]
    if push == OPEN:
        return 0.0, 0.0
    n, v = load_at(L, t)
    if push == STICK:
        return n, n
    return n, 0.0 if i == NONE else front_on(C, L, i, push, v - push * n, n)


@jit
def solved_places(C, P, L, k, t):
    """Places s of the edge and of the front at an instant of stretch k."""
    n, front = coordinates_at(C, L, k, t)
    edge = place_of(P, n)
    return edge, edge if front == n else place_of(P, front)


@jit
def tabulate_places(C, P, L, k, tolerance):
    """Tabulate places of edge and front over stretch k, until their series give them at any instant.

    Tractions follow the root of a distance within the slip zone, or within the contact. So the last
    coefficients of such a series are at most the square of half the tolerance, over that width.
    """
    begin, end = C.time[k, 0], C.time[k, 1]
    values = np.empty((2, FINEST + 1))
    for e in range(2):
        C.place[k, e * FINEST, 0] = place_of(P, C.edge[k, e])
        C.place[k, e * FINEST, 1] = place_of(P, C.front[k, e])
    scale = max(C.place[k, 0, 0], C.place[k, FINEST, 0])
    known, intervals = 1, 4
    while True:
        step = FINEST // intervals
        for j in range(step, FINEST, step):
            if j % (FINEST // known) != 0:
                t = begin + 0.5 * (end - begin) * (LOBATTO[j] + 1.0)
                C.place[k, j, 0], C.place[k, j, 1] = solved_places(C, P, L, k, t)
        C.intervals[k] = known = intervals
        apart = 0.0
        for j in range(intervals + 1):
            values[0, j], values[1, j] = C.place[k, j * step, 0], C.place[k, j * step, 1]
            apart = max(apart, values[0, j] - values[1, j])
        rough = max(tail(values[0], intervals), tail(values[1], intervals))
        width = scale if C.push[k] == STICK else apart
        C.interpolated[k] = 1 if rough <= 0.25 * tolerance * tolerance * width else 0
        if C.interpolated[k] or intervals == FINEST:
            return
        intervals *= 2


@jit
def find_stretch(C, L, t):
    """The stretch of an instant in [0, period], the instant within it, and the sign of the tangential load.

    Where two stretches meet it is the earlier one.
    """
    last, sign = C.stretches - 1, 1.0
    if t <= C.time[0, 0] + SAME_INSTANT * L.period:
        t += L.period
    if t > C.time[last, 1] and L.mirrored:
        t -= 0.5 * L.period
        sign = -1.0
    low, high = 0, last
    while low < high:
        middle = (low + high) // 2
        if C.time[middle, 1] >= t - SAME_INSTANT * L.period:
            high = middle
        else:
            low = middle + 1
    return low, min(max(t, C.time[low, 0]), C.time[low, 1]), sign
