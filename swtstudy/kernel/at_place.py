"""The largest value of the criterion at one place of the surface line, over planes and instants.

The cycle is sampled roughly at first. Parts of it that may hide a higher value on the critical plane are
doubled, and planes are searched anew, where the value may be the largest of the line.
"""

from math import cos, sin

import numpy as np

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import FINDLEY, SWT, lift, value_of
from swtstudy.kernel.history import sample_cycle, write_stress
from swtstudy.kernel.parts import COARSEST, refine_marked
from swtstudy.kernel.planes import (
    BETWEEN,
    MINUS_SWING,
    STEP,
    STRESS,
    SWING,
    climb,
    fill,
    find_peaks,
    higher_plane,
    mark_highest,
    mark_unresolved,
    survey_planes,
)

#: Most places of a search that are kept.
MAX_SEEN = 24_001
#: Most rounds in which parts of a cycle are doubled.
ROUNDS = 12
#: A side that is asked for; no literal, for which Numba would compile anew.
ASKED = np.bool_(True)


@jit
def evaluate(S, point, place, plus, minus):
    """Values at place s at x > 0 and x < 0, where asked: more instants where the value may be the largest."""
    H, W, C, R, P, K, L, Q = point
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
            sample_cycle(H, C, R, P, K, L, Q, place, S.largest, sign, COARSEST)
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
def resolve(H, W, C, P, K, L, side, swt, angle, Q, best):
    """Double the parts of the cycle that may hide a higher value on the critical plane, until none does.

    A value that may become the best is confirmed: the parts with the maxima of its curves are doubled until
    it stays. Returns swt and 2θ.
    """
    for _ in range(ROUNDS):
        Ct, St = cos(angle), sin(angle)
        find_peaks(H, W, Q, Ct, St)
        doubled, most, _ = mark_unresolved(H, W, C, Q, Ct, St, Q.time)
        confirming = doubled == 0 and swt > (1.0 - Q.line) * best
        if confirming:
            doubled = mark_highest(H, W, C)
        if swt * (1.0 + 2.0 * most) < Q.near * best or not refine_marked(H, C, P, L, doubled):
            break
        write_stress(H, C, P, L, K, Q)
        fill(H, W, side, Q)
        before = swt
        h, angle = climb(H, W, Q, angle, Q.plane)
        swt = value_of(Q, h)
        if confirming and abs(swt - before) <= Q.time * swt:
            break
    return swt, angle
