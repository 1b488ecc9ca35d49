"""The largest value on a circle of the surface where a bulk stress shifts the stick zone.

There the stress is no harmonic of the angle, since each piece of the diagram has a centre of its own. So the
places of the circle are solved as places of the body (`swtstudy.kernel.body`): a look at even angles, and one
about the highest.
"""

from math import cos, isnan, pi, sin

import numpy as np

from swtstudy.kernel.body import COARSEST, largest_at
from swtstudy.kernel.circle import HIGHER, may_be_anywhere
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.contact import solve_cycle
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.profile import place_of

#: Angles of the first look, over half a turn, and how often the step about the highest is halved.
ANGLES, CLOSER = np.int64(12), 6
#: Share of the largest value below which a place of the first look does not matter.
FAR = 0.8
#: Intervals of a part at first; no literal, for which Numba would compile anew.
FIRST = np.int64(COARSEST)


@jit
def value_at(S, B, H, W, G, C, R, P, K, L, Q, radius, angle, largest, floor, tolerance):
    """The criterion at an angle of a circle, over all planes; below the floor it may be low."""
    y = radius * sin(angle) if angle < pi else 0.0
    for c in range(3):
        G.normal[c] = 0.0
    own = radius * cos(angle), y, 0.0, largest, floor, tolerance, 0.5 * tolerance, FIRST
    return largest_at(S, B, H, W, G, C, R, P, K, L, Q, *own)[0]


@jit
def highest_on_circle(S, B, H, W, G, C, R, P, K, L, Q, radius, largest, known):
    """Largest value on a circle, if it is above what is known; else that."""
    step, best, at = pi / ANGLES, 0.0, 0.0
    for j in range(ANGLES + 1):
        floor = FAR * max(known, best)
        value = value_at(S, B, H, W, G, C, R, P, K, L, Q, radius, j * step, largest, floor, Q.line)
        if value > best:
            best, at = value, j * step
    if best < FAR * known:
        return known
    for _ in range(CLOSER):
        step *= 0.5
        middle = at
        for angle in (middle - step, middle + step):
            if 0.0 <= angle <= pi:
                value = value_at(S, B, H, W, G, C, R, P, K, L, Q, radius, angle, largest, best, Q.line)
                if value > best:
                    best, at = value, angle
    return max(best, known)


@jit
def search_shifted_circles(B, S, G, C, R, _, H, W, K, profiles, which, loads, asks, found):
    """Write the largest values on the circles of points with a shifted stick zone.

    The circles are the circle through the critical point, and the edge.
    """
    for i in range(which.shape[0]):
        out = found[i]
        if not out.circle or out.shift == 0.0:
            continue
        P, L, Q = profiles[which[i]], loads[i], asks[i]
        at_infinity = isnan(out.critical_x)
        if at_infinity and not may_be_anywhere(L, Q):
            continue
        solve_cycle(C, L)
        C.shift = out.shift
        lay_out(R, C, P, L, out.growth)
        largest, known = place_of(P, C.largest), (1.0 + HIGHER) * out.s
        top = highest_on_circle(S, B, H, W, G, C, R, P, K, L, Q, largest, largest, known)
        if not at_infinity and abs(out.critical_x) < (1.0 - HIGHER) * largest:
            own = abs(out.critical_x)
            top = highest_on_circle(S, B, H, W, G, C, R, P, K, L, Q, own, largest, top)
        out.s_surface = top if top > known else out.s
        out.overflow = max(C.overflow, S.overflow)
