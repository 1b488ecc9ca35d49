"""The memory diagram on the radius of a profile: starts of pieces, what grew, places of edge and front."""

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, GAUSS, LOBATTO, ORDER, fit, panel_of, tail
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
def lay_out(growth, cycle, profile, load, tolerance):
    """Place the starts of pieces, and tabulate do/ds of pieces that grew and the places of edge and front.

    Returns the tolerance of the tables, a coarser one where there is no room for theirs.
    """
    while True:
        growth.panels, growth.crowded = 0, 0
        for i in range(cycle.pieces):
            if cycle.used[i]:
                cycle.start_s[i] = place_of(profile, cycle.start[i])
                if cycle.kind[i] == GROWN:
                    tabulate_growth(growth, cycle, profile, load, i, tolerance)
        if growth.crowded == 0 or tolerance >= 1.0:
            break
        tolerance *= 4.0
    for k in range(cycle.stretches):
        tabulate_places(cycle, profile, load, k, tolerance)
    return tolerance


@jit
def tabulate_growth(growth, cycle, profile, load, i, tolerance):
    """Panels of do/ds = (dv/dn) dG/ds of one piece, halved until the series of dv/dn has died out."""
    growth.first[i] = growth.panels
    begin, end = cycle.born[i, 0], cycle.born[i, 1]
    lowest, highest = place_of(profile, load_at(load, begin)[0]), place_of(profile, load_at(load, end)[0])
    waiting = np.empty((WAITING, 2))
    slope, values, series = np.empty(ORDER), np.empty(ORDER), np.empty(ORDER)
    m = 0
    # The profile is smooth within its panels only.
    top = panel_of(profile.begin, 0, profile.panels, highest)
    for p in range(top, panel_of(profile.begin, 0, profile.panels, lowest) - 1, -1):
        a, b = max(lowest, profile.begin[p]), min(highest, profile.end[p])
        if b - a > ROUNDED * b:
            waiting[m, 0], waiting[m, 1] = a, b
            m += 1
    while m > 0:
        m -= 1
        a, b = waiting[m, 0], waiting[m, 1]
        t = begin
        for j in range(ORDER - 1, -1, -1):
            s = a + 0.5 * (b - a) * (GAUSS[j] + 1.0)
            t = instant_of(load, NORMAL, coordinate_at(profile, s), t, end)
            n, v, dn, dv, ddn, ddv = rates_at(load, t)
            slope[j] = min(max(dv / dn, -1.0), 1.0) if dn > 0.0 else 0.0
            values[j] = slope[j] * density_at(profile, s)
        fit(slope, series)
        rough = max(abs(series[ORDER - 1]), abs(series[ORDER - 2])) > tolerance
        room = m + 2 < WAITING and growth.panels < MAX_GROWN - 512
        if rough and b - a > THINNEST and not room:
            growth.crowded = 1
        elif rough and b - a > THINNEST:
            middle = 0.5 * (a + b)
            waiting[m + 1, 0], waiting[m + 1, 1] = a, middle
            waiting[m, 0], waiting[m, 1] = middle, b
            m += 2
            continue
        if growth.panels >= MAX_GROWN:
            cycle.overflow = 1
            return
        growth.begin[growth.panels], growth.end[growth.panels] = a, b
        fit(values, growth.density[growth.panels])
        growth.panels += 1
    growth.last[i] = growth.panels


@jit
def places_at(cycle, profile, load, k, t):
    """Places s of the edge and of the front at an instant of stretch k, by the barycentric formula."""
    if cycle.interpolated[k] == 0:
        return solved_places(cycle, profile, load, k, t)
    begin, end, step = cycle.time[k, 0], cycle.time[k, 1], FINEST // cycle.intervals[k]
    y, sign, total, edge, front = 2.0 * (t - begin) / (end - begin) - 1.0, 1.0, 0.0, 0.0, 0.0
    for j in range(0, FINEST + 1, step):
        gap = y - LOBATTO[j]
        if gap == 0.0:
            return cycle.place[k, j, 0], cycle.place[k, j, 1]
        weight = (0.5 if j == 0 or j == FINEST else 1.0) * sign / gap
        total += weight
        edge += weight * cycle.place[k, j, 0]
        front += weight * cycle.place[k, j, 1]
        sign = -sign
    # Pressure follows the root of the edge's rounding: one that rests has none.
    rests = cycle.edge[k, 0] == cycle.edge[k, 1]
    return cycle.place[k, 0, 0] if rests else edge / total, front / total


@jit
def coordinates_at(cycle, load, k, t):
    """Coordinates of the edge and of the front at an instant of stretch k, from the load and the diagram."""
    push, i = cycle.push[k], cycle.piece[k]
    if push == OPEN:
        return 0.0, 0.0
    n, v = load_at(load, t)
    if push == STICK:
        return n, n
    return n, 0.0 if i == NONE else front_on(cycle, load, i, push, v - push * n, n)


@jit
def solved_places(cycle, profile, load, k, t):
    """Places s of the edge and of the front at an instant of stretch k."""
    n, front = coordinates_at(cycle, load, k, t)
    edge = place_of(profile, n)
    return edge, edge if front == n else place_of(profile, front)


@jit
def tabulate_places(cycle, profile, load, k, tolerance):
    """Tabulate places of edge and front over stretch k, until their series give them at any instant.

    Tractions follow the root of a distance within the slip zone, or within the contact. So the last
    coefficients of such a series are at most the square of half the tolerance, over that width.
    """
    begin, end = cycle.time[k, 0], cycle.time[k, 1]
    values = np.empty((2, FINEST + 1))
    for e in range(2):
        cycle.place[k, e * FINEST, 0] = place_of(profile, cycle.edge[k, e])
        cycle.place[k, e * FINEST, 1] = place_of(profile, cycle.front[k, e])
    scale = max(cycle.place[k, 0, 0], cycle.place[k, FINEST, 0])
    known, intervals = 1, 4
    while True:
        step = FINEST // intervals
        for j in range(step, FINEST, step):
            if j % (FINEST // known) != 0:
                t = begin + 0.5 * (end - begin) * (LOBATTO[j] + 1.0)
                cycle.place[k, j, 0], cycle.place[k, j, 1] = solved_places(cycle, profile, load, k, t)
        cycle.intervals[k] = known = intervals
        apart = 0.0
        for j in range(intervals + 1):
            values[0, j], values[1, j] = cycle.place[k, j * step, 0], cycle.place[k, j * step, 1]
            apart = max(apart, values[0, j] - values[1, j])
        rough = max(tail(values[0], intervals), tail(values[1], intervals))
        width = scale if cycle.push[k] == STICK else apart
        cycle.interpolated[k] = 1 if rough <= 0.25 * tolerance * tolerance * width else 0
        if cycle.interpolated[k] or intervals == FINEST:
            return
        intervals *= 2


@jit
def find_stretch(cycle, load, t):
    """The stretch of an instant in [0, period], the instant within it, and the sign of the tangential load.

    Where two stretches meet it is the earlier one.
    """
    last, sign = cycle.stretches - 1, 1.0
    if t <= cycle.time[0, 0] + SAME_INSTANT * load.period:
        t += load.period
    if t > cycle.time[last, 1] and load.mirrored:
        t -= 0.5 * load.period
        sign = -1.0
    low, high = 0, last
    while low < high:
        middle = (low + high) // 2
        if cycle.time[middle, 1] >= t - SAME_INSTANT * load.period:
            high = middle
        else:
            low = middle + 1
    return low, min(max(t, cycle.time[low, 0]), cycle.time[low, 1]), sign
