"""The largest value of the criterion at one place of the surface line, over planes and instants.

The cycle is sampled roughly at first. Parts of it that may hide a higher value on the critical plane are
doubled, and planes are searched anew, where the value may be the largest of the line.
"""

from math import cos, sin

import numpy as np

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import lift, stress_of, value_of
from swtstudy.kernel.history import largest_pressure, sample_cycle, write_stress
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
#: Value of a side that is not asked for: it cannot matter there.
RULED_OUT = -1.0


@jit
def evaluate(search, point, place, plus, minus):
    """Values at place s at x > 0 and x < 0, where asked; else they are `RULED_OUT`.

    Where a value may be the largest there are more instants.
    """
    load, ask, cycle, history, curves = point.load, point.ask, point.cycle, point.history, point.curves
    number = min(search.positions, MAX_SEEN - 1)
    search.positions += 1
    search.seen[number], sampled = place, False
    for side in range(2):
        search.seen_value[number, side] = RULED_OUT
        if side == 1 and load.mirrored:
            search.value[1] = search.value[0]
            continue
        search.value[side] = RULED_OUT
        if (side == 0 and not plus) or (side == 1 and not minus):
            continue
        sign = 1.0 - 2.0 * side
        if not sampled or cycle.shift != 0.0:
            sample_cycle(point, place, search.largest, sign, COARSEST)
            sampled = True
        swt, angle = swt_at(search, point, sign)
        search.value[side] = swt
        search.seen_value[number, side], search.seen_angle[number, side] = swt, angle
        if swt > search.best:
            search.best, search.place, search.sign, search.angle = swt, place, sign, angle
            find_peaks(history, curves, ask, cos(angle), sin(angle))
            search.tension = stress_of(ask, curves.top[STRESS], curves.top[SWING] + curves.top[MINUS_SWING])
            search.pressure = largest_pressure(history)


@jit
def swt_at(search, point, side):
    """swt of the sampled cycle at side · x, and 2θ of its plane: rough where it cannot matter."""
    ask, history, curves = point.ask, point.history, point.curves
    floor = ask.near * search.best
    first, bound = survey_planes(history, curves, ask, side)
    if value_of(ask, bound) < floor or curves.value[first] <= 0.0:
        return value_of(ask, curves.value[first]), STEP * first
    h, angle = climb(history, curves, ask, STEP * first, ask.plane)
    swt = value_of(ask, h)
    for _ in range(4):
        instants = history.instants
        swt, angle = resolve(point, side, swt, angle, search.best)
        if swt < floor:
            return swt, angle
        if history.instants > instants:
            survey_planes(history, curves, ask, side)
        known = lift(ask, swt)
        h, other = higher_plane(history, curves, ask, known, ask.plane, swt > (1.0 - BETWEEN) * search.best)
        if h <= known:
            break
        h, other = climb(history, curves, ask, other, ask.plane)
        if h <= known:
            break
        swt, angle = value_of(ask, h), other
    return swt, angle


@jit
def resolve(point, side, swt, angle, best):
    """Double the parts of the cycle that may hide a higher value on the critical plane, until none does.

    A value that may become the best is confirmed: the parts with the maxima of its curves are doubled until
    it stays. Returns swt and 2θ.
    """
    load, profile, ask = point.load, point.profile, point.ask
    cycle, history, curves = point.cycle, point.history, point.curves
    for _ in range(ROUNDS):
        Ct, St = cos(angle), sin(angle)
        find_peaks(history, curves, ask, Ct, St)
        doubled, most, _ = mark_unresolved(history, curves, cycle, ask, Ct, St, ask.time)
        confirming = doubled == 0 and swt > (1.0 - ask.line) * best
        if confirming:
            doubled = mark_highest(history, curves, cycle)
        too_low = swt * (1.0 + 2.0 * most) < ask.near * best
        if too_low or not refine_marked(history, cycle, profile, load, doubled):
            break
        write_stress(point)
        fill(history, curves, side, ask)
        before = swt
        h, angle = climb(history, curves, ask, angle, ask.plane)
        swt = value_of(ask, h)
        if confirming and abs(swt - before) <= ask.time * swt:
            break
    return swt, angle
