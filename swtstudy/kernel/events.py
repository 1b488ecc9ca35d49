"""Events of the load cycle: the instants at which a component turns, or contact is made or lost.

And what follows from the load at these instants alone: equilibrium, and margins from where it ends.
"""

from math import ceil, inf, nan

import numpy as np

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.load import (
    DIFFERENCE,
    NORMAL,
    SUM,
    TANGENTIAL,
    UNMAPPED,
    bulk_rates,
    combined,
    distinct,
    load_at,
    rates_at,
)

#: Functions whose roots are events, besides the rates of n, v, α and β: n itself, and B′.
CONTACT, BULK_RATE = np.int64(4), np.int64(5)
#: Cells of the fastest harmonic in which turning points are searched, and of a half wave of the profile.
CELLS, CELLS_PER_WAVE = 24, 20
#: Instants closer than this share of the period are one.
SAME_INSTANT = 1e-10
#: Rounding of a load.
ROUNDING = 1e-12
#: Steps between two events at which the ratio of the forces is looked at, and how often, each time about the
#: highest one: in the end 1e-5 of the time between them, in which a maximum changes by its square.
STEPS, LOOKS = 32, 5


@jit
def event_function(load, which, t):
    """Value and rate of n′, v′, α′ or β′ (which 0 to 3), of n itself (4) or of B′ (5): roots are events."""
    if which == BULK_RATE:
        return bulk_rates(load, t)
    n, v, dn, dv, ddn, ddv = rates_at(load, t)
    if which == CONTACT:
        return n, dn
    return combined(which, dn, dv), combined(which, ddn, ddv)


@jit
def event_root(load, which, of_rate, a, b):
    """Root of an event function, or of its rate, whose signs at a and b differ: Illinois' method."""
    fa = event_function(load, which, a)[1 if of_rate else 0]
    fb = event_function(load, which, b)[1 if of_rate else 0]
    for _ in range(80):
        if fb == 0.0 or fa == fb:
            break
        c = b - fb * (b - a) / (fb - fa)
        f = event_function(load, which, c)[1 if of_rate else 0]
        if f * fb < 0.0:
            a, fa = b, fb
        else:
            fa *= 0.5
        done = abs(c - b) < 1e-14 * (1.0 + abs(c)) or f == 0.0
        b, fb = c, f
        if done:
            break
    return b


@jit
def is_constant(load, which):
    """True if n, v, α or β is constant up to rounding; its turning points would be noise."""
    largest, scale = 0.0, 0.0
    for i in range(load.terms):
        for of in (load.cosine, load.sine):
            n, v = of[0, i], of[1, i]
            largest = max(largest, abs(combined(which, n, v)))
            scale = max(scale, abs(n), abs(v))
    return largest <= 1e-14 * scale


@jit
def is_steady(load, which):
    """True if a function has no events: it is constant."""
    if which == CONTACT:
        return False
    if which == BULK_RATE:
        return load.bulk_moves == 0
    if load.map != UNMAPPED and which in (DIFFERENCE, SUM):  # no sum of harmonics
        return is_constant(load, NORMAL) and is_constant(load, TANGENTIAL)
    return is_constant(load, which)


@jit
def search_cell(load, which, a, before, b, now, out, m):
    """Append the roots of an event function between a and b, whose values and rates are given.

    Returns how many events there are now: one root, or two where the function turns within the cell.
    """
    up = now[0] >= 0.0
    if m + 2 >= out.shape[0]:
        return m
    if (before[0] >= 0.0) != up:
        out[m] = event_root(load, which, False, a, b)
        return m + 1
    if (before[1] >= 0.0) != (now[1] >= 0.0) and (before[1] < 0.0) == up:
        c = event_root(load, which, True, a, b)
        if (event_function(load, which, c)[0] >= 0.0) != up:
            out[m] = event_root(load, which, False, a, c)
            out[m + 1] = event_root(load, which, False, c, b)
            return m + 2
    return m


@jit
def turning_points(load, out):
    """Write the sorted instants at which n, v, α or β turn or n passes 0; returns how many.

    The first one is 0 and the last one the period.
    """
    m = 0
    if load.sides > 0:
        for j in range(load.sides + 1):
            out[m] = j
            m += 1
            if j < load.sides and load.vertex[0, j] * load.vertex[0, j + 1] < 0.0:
                out[m] = j + load.vertex[0, j] / (load.vertex[0, j] - load.vertex[0, j + 1])
                m += 1
        return m
    cells = ceil((CELLS + CELLS_PER_WAVE * load.waves) * load.fastest)
    step = load.period / cells
    out[0], out[1] = 0.0, load.period
    m = 2
    for which in (CONTACT, NORMAL, TANGENTIAL, DIFFERENCE, SUM, BULK_RATE):
        if is_steady(load, which):
            continue
        before = event_function(load, which, 0.0)
        for j in range(1, cells + 1):
            now = event_function(load, which, j * step)
            m = search_cell(load, which, (j - 1) * step, before, j * step, now, out, m)
            before = now
    m = distinct(out, m, SAME_INSTANT * load.period)
    out[m - 1] = load.period
    return m


@jit
def out_of_equilibrium(load, events, m):
    """True if there is no equilibrium at some of m events, so that there is no stationary cycle.

    A tangential force needs |v| ≤ n, and a normal force n ≥ 0. Bodies that never touch have none either.
    """
    largest, smallest, carried = -inf, inf, inf
    for i in range(m):
        n, v = load_at(load, events[i])
        largest, smallest = max(largest, n), min(smallest, n)
        carried = min(carried, max(n, 0.0) - abs(v))
    least = -ROUNDING * largest
    lost = largest <= 0.0 or (load.normal_force == 1 and smallest < least)
    return lost or (load.tangential_force == 1 and carried < least)


@jit
def stick_limit(load, events, m):
    """Coordinate up to which springs stick throughout the cycle; negative if the whole contact slides.

    A spring at G can keep one offset if that is in all of its bounds [α + G, β - G].
    """
    highest, lowest = -inf, inf
    for i in range(m):
        n, v = load_at(load, events[i])
        highest, lowest = max(highest, v - n), min(lowest, v + n)
    return 0.5 * (lowest - highest)


@jit
def slide(load, events, m):
    """By how much the tangential displacement exceeds the limit of partial slip.

    0 without gross slip; NaN where contact is lost, or the tangential force is prescribed.
    """
    for i in range(m):
        if load_at(load, events[i])[0] <= 0.0:
            return nan
    return nan if load.tangential_force else max(-stick_limit(load, events, m), 0.0)


@jit
def ratio_at(load, t):
    """|v|/n, inf where v is not 0 without n."""
    n, v = load_at(load, t)
    if v == 0.0:
        return 0.0
    return abs(v) / n if n > 0.0 else inf


@jit
def highest_ratio(load, a, b):
    """Largest |v|/n between two instants at which the load turns."""
    best = max(ratio_at(load, a), ratio_at(load, b))
    if load.sides > 0:  # monotone on a straight side
        return best
    for _ in range(LOOKS):
        step, top, at = (b - a) / STEPS, 0.0, a
        for j in range(STEPS + 1):
            ratio = ratio_at(load, a + step * j)
            if ratio > top:
                top, at = ratio, a + step * j
        best = max(best, top)
        a, b = max(at - step, a), min(at + step, b)
    return best


@jit
def force_ratio(load, events, m):
    """Largest |F_x|/(μ F_N) between m events; NaN where the tangential force is not prescribed."""
    if load.tangential_force == 0:
        return nan
    best = 0.0
    for i in range(m - 1):
        best = max(best, highest_ratio(load, events[i], events[i + 1]))
    return best
