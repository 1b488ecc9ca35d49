"""Strain cycles of a round of the load at its worst places and planes, by rainflow counting.

The place and plane with the largest value need not have the largest damage Σ 1/N_i. Between two
values 1/N goes like a power of the criterion, so places and planes are looked for at which the sum of the
values to the power of 1, 2, 4 or 8 is largest. Only those can be better whose value, to that power, times
V/(2A) is larger than the sum at the critical place, V being the way that the swing goes in a round and A its
range.
"""

from math import cos, isnan, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.at_place import resolve
from swtstudy.kernel.chebyshev import FINEST, vertex
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import MAX_STRETCHES, solve_cycle
from swtstudy.kernel.count import count_cycles, follow, rank_parts
from swtstudy.kernel.criterion import SWT, far_field, lifted, sensitivities, swing_weights, value_of
from swtstudy.kernel.cusps import cusps, ends_group
from swtstudy.kernel.growth import lay_out
from swtstudy.kernel.history import largest_pressure, sample_cycle, write_stress
from swtstudy.kernel.load import bulk_at
from swtstudy.kernel.parts import COARSEST, MAX_INSTANTS, MAX_PARTS, ROOM, refine
from swtstudy.kernel.planes import MINUS_SWING, STRESS, SWING, fill, find_peaks
from swtstudy.kernel.point import FINEST_GROWTH, tension_share
from swtstudy.kernel.profile import place_of
from swtstudy.kernel.records import Point
from swtstudy.kernel.shift import shift_of

#: Powers of the criterion of which the sum is made largest.
POWERS = np.array([1.0, 2.0, 4.0, 8.0])
#: The critical place, and one for each power.
MAX_PLACES = 1 + len(POWERS)
#: A place or plane with a sum larger by less than this is left out.
GAIN = 0.01
#: Share by which an upper bound may be low, since it is seen at instants.
SLACK = 1.05
#: Values between two ends of a piece are at most so much higher than at these.
WITHIN = 2.0
#: Places of a piece that are looked at, its lower end among them, and planes there.
QUARTERS, PLANES = 4, 32
STEP = 2.0 * pi / PLANES
COS_2, SIN_2 = np.cos(STEP * np.arange(PLANES)), np.sin(STEP * np.arange(PLANES))
#: Places and planes around the best ones in a closer look, in steps of the former ones, how the steps shrink,
#: and how often.
OFFSETS, SHRINKING, ROUNDS = np.array([-1.0, -0.5, 0.0, 0.5, 1.0]), 0.4, 4
#: Smallest cycle that counts, over the largest one's value.
SMALLEST = 1e-6
#: Cycles at the edge of a face, where the stress may have no bound, are counted so far from it, in its radii.
BESIDE = 1e-6
#: Instants to an oscillation of a bulk stress.
SAMPLES = 64
#: Room for the shares of the points of one call: any one point has room in it.
MAX_SHARES = MAX_PLACES * MAX_INSTANTS
#: Intervals of a part in a coarse and in a closer look and where they are counted in the end (with 8
#: instead of 32 small ones are 5 % off); no literals, for which Numba would compile anew.
COARSELY, CLOSELY, FINELY = np.int64(4), np.int64(8), np.int64(FINEST)
COUNTING = np.dtype(
    [
        ("rank", "i8", (MAX_PARTS,)),  # parts in the order of time
        ("points", "i8"),  # of the history on a plane
        *fields("f8", "swing stress", (MAX_INSTANTS,)),
        # Turning points whose cycles are still open, and the largest stress from one to the next.
        *fields("f8", "level highest", (MAX_INSTANTS,)),
        ("cycles", "i8"),  # closed cycles, and their values of the criterion
        ("value", "f8", (MAX_INSTANTS,)),
        ("ends", "i8"),  # pieces of the line that are looked at, less one
        # Ends of these pieces, and how high cycles are there, over what would matter.
        *fields("f8", "end reach", (4 * MAX_STRETCHES,)),
        ("largest", "f8"),  # value of the largest cycle at the critical place
        # By power: the largest sums that are kept, and larger ones that a look found.
        *fields("f8", "known better", (len(POWERS),)),
        ("found", "i8", (len(POWERS),)),  # whether there is a larger one
        ("where", "f8", (len(POWERS), 3)),  # and where: number of the piece and share of its angle, side, 2θ
        ("shares", "f8", (MAX_SHARES,)),  # values of cycles over the largest one's
    ]
)
COUNTED = np.dtype(
    [
        ("places", "i8"),
        ("begin", "i8", (MAX_PLACES + 1,)),  # of each place's shares
        ("overflow", "i8"),
    ]
)


@jit
def sum_of(counting, power):
    """Sum of the cycles' values to a power, over the largest value at the critical place."""
    total = 0.0
    for i in range(counting.cycles):
        total += (counting.value[i] / counting.largest) ** power
    return total


@jit
def reach_of(counting, ask, top, swing):
    """Height of the cycles of the history over what would be better for some power: 1 and more may be.

    Parameters
    ----------
    top, swing
        Largest σ_n, and range of the swing.
    """
    value = value_of(ask, lifted(ask, top, swing, 0.0)) / counting.largest
    if value <= 0.0 or swing <= 0.0:
        return 0.0
    way, turns, last = 0.0, 0, counting.swing[0] - counting.swing[counting.points - 1]
    for i in range(counting.points):
        step = counting.swing[(i + 1) % counting.points] - counting.swing[i]
        way += abs(step)
        if step * last < 0.0:
            turns += 1
        if step != 0.0:
            last = step
    number, of_swing = 0.5 * way / swing, sensitivities(ask, top, swing)[1] * swing
    most = 0.0
    for p in range(POWERS.shape[0]):
        power = POWERS[p] * of_swing
        # A root of the amplitudes adds up to most where all are equal.
        equal = max(turns, 1.0) ** max(1.0 - power, 0.0) * number ** min(power, 1.0)
        most = max(most, value * (SLACK * equal / ((1.0 + GAIN) * counting.known[p])) ** (1.0 / POWERS[p]))
    return most


@jit
def sample_at(counting, point, place, largest, intervals, side):
    """Sample the cycle at place s on one side with so many intervals of each part."""
    sample_cycle(point, place, largest, side, COARSEST)
    sample_closely(point, intervals)
    rank_parts(counting, point.history, point.load)


@jit
def sample_closely(point, intervals):
    """Give all parts of the sampled cycle so many intervals, but short sides of which the ends are enough."""
    load, profile, cycle, history = point.load, point.profile, point.cycle, point.history
    for z in range(history.parts):
        while 1 < history.intervals[z] < intervals and history.instants + ROOM < MAX_INSTANTS:
            refine(history, z, cycle, profile, load)
    write_stress(point)


@jit
def place_at(counting, at):
    """Place s of a number of a piece and the share of its angle."""
    piece = min(int(at), counting.ends - 1)
    left, right = counting.end[piece], counting.end[piece + 1]
    return left + (right - left) * (0.5 - 0.5 * cos(pi * (at - piece)))


@jit
def look_at(counting, point, at, largest):
    """Count cycles at one place if they may matter; returns their height over the height that matters."""
    load, ask, cycle, history, curves = point.load, point.ask, point.cycle, point.history, point.curves
    highest = 0.0
    for number in range(1 if load.mirrored else 2):
        side = 1.0 - 2.0 * number
        if number == 0 or cycle.shift != 0.0:
            sample_at(counting, point, place_at(counting, at), largest, COARSELY, side)
        fill(history, curves, side, ask)
        for plane in range(PLANES):
            follow(counting, history, curves, ask, COS_2[plane], SIN_2[plane])
            top, high, low = -1e300, -1e300, 1e300
            for i in range(counting.points):
                top, swing = max(top, counting.stress[i]), counting.swing[i]
                high, low = max(high, swing), min(low, swing)
            reach = reach_of(counting, ask, top, high - low)
            highest = max(highest, reach)
            if reach <= 1.0:
                continue
            count_cycles(counting, ask)
            for p in range(POWERS.shape[0]):
                total = sum_of(counting, POWERS[p])
                if total > counting.better[p]:
                    counting.better[p], counting.found[p] = total, 1
                    counting.where[p, 0], counting.where[p, 1], counting.where[p, 2] = at, side, STEP * plane
    return highest


@jit
def look_along(counting, search, point, largest):
    """Find the best places of a coarse look along the line: ends of pieces, and within what may matter."""
    load, profile, ask, cycle = point.load, point.profile, point.ask, point.cycle
    last = cusps(search, cycle, profile, load, ask, largest) - 1
    counting.ends = -1
    for j in range(last + 1):
        if ends_group(search, j, last, largest):
            counting.ends += 1
            counting.end[counting.ends] = search.cusp[j]
    for p in range(POWERS.shape[0]):
        counting.better[p], counting.found[p] = counting.known[p], 0
    for j in range(counting.ends + 1):
        counting.reach[j] = look_at(counting, point, float(j), largest)
    for j in range(counting.ends):
        if WITHIN * max(counting.reach[j], counting.reach[j + 1]) <= 1.0:
            continue
        for i in range(1, QUARTERS):
            look_at(counting, point, j + i / QUARTERS, largest)


@jit
def look_closer(counting, point, power, largest):
    """Count the cycles of the largest sum for one power near the best place and plane of a coarse look."""
    ask, history, curves = point.ask, point.history, point.curves
    at, side, angle = counting.where[power, 0], counting.where[power, 1], counting.where[power, 2]
    wide, turned, best_at, best_angle = 1.0 / QUARTERS, STEP, at, angle
    for _ in range(ROUNDS):
        best, at, angle = -1.0, best_at, best_angle
        for i in range(OFFSETS.shape[0]):
            here = min(max(at + wide * OFFSETS[i], 0.0), float(counting.ends))
            sample_at(counting, point, place_at(counting, here), largest, CLOSELY, side)
            fill(history, curves, side, ask)
            for j in range(OFFSETS.shape[0]):
                plane = angle + turned * OFFSETS[j]
                follow(counting, history, curves, ask, cos(plane), sin(plane))
                count_cycles(counting, ask)
                total = sum_of(counting, POWERS[power])
                if total > best:
                    best, best_at, best_angle = total, here, plane
        wide *= SHRINKING
        turned *= SHRINKING
    sample_at(counting, point, place_at(counting, best_at), largest, FINELY, side)
    fill(history, curves, side, ask)
    follow(counting, history, curves, ask, cos(best_angle), sin(best_angle))
    count_cycles(counting, ask)


@jit
def keep_cycles(counting, out):
    """Append the cycles that were counted to the point's cycles."""
    k = out.begin[out.places]
    for i in range(counting.cycles):
        share = counting.value[i] / counting.largest
        if share > SMALLEST:
            counting.shares[k] = share
            k += 1
    out.places += 1
    out.begin[out.places] = k


@jit
def set_largest(counting):
    """Note the largest cycle at the critical place, over which all others are told, and the sums there."""
    counting.largest = 0.0
    for i in range(counting.cycles):
        counting.largest = max(counting.largest, counting.value[i])
    if counting.largest > 0.0:
        for p in range(POWERS.shape[0]):
            counting.known[p] = sum_of(counting, POWERS[p])


@jit
def count_home(counting, point, x, angle, largest):
    """Count the cycles at the critical place and plane."""
    load, profile, ask, cycle = point.load, point.profile, point.ask, point.cycle
    growth, history, curves = point.growth, point.history, point.curves
    b, side = profile.flat_radius, -1.0 if x < 0.0 else 1.0
    square = (abs(x) - b) * (abs(x) + b)
    place = sqrt(abs(square)) if square >= 0.0 else -sqrt(abs(square))
    if profile.singular and place >= 0.0:
        place = max(place, sqrt(2.0 * BESIDE) * b)
    asked, needed = ask.growth, ask.growth
    while True:
        tolerance = lay_out(growth, cycle, profile, load, asked)
        sample_at(counting, point, place, largest, COARSELY, side)
        fill(history, curves, side, ask)
        find_peaks(history, curves, ask, cos(angle), sin(angle))
        swing = curves.top[SWING] + curves.top[MINUS_SWING]
        value = value_of(ask, lifted(ask, curves.top[STRESS], swing, 0.0))
        if value > 0.0:  # as for s itself: what grew is told to a share of the tension
            tension, pressure = min(curves.top[STRESS], 0.5 * swing), largest_pressure(history)
            needed = ask.growth * tension_share(cycle, ask, tension, pressure)
        if tolerance > asked or growth.panels == 0 or needed >= 0.5 * tolerance or tolerance <= FINEST_GROWTH:
            break
        asked = max(0.5 * needed, FINEST_GROWTH)
    resolve(point, side, value, angle, value)
    sample_closely(point, FINELY)
    rank_parts(counting, history, load)
    fill(history, curves, side, ask)
    follow(counting, history, curves, ask, cos(angle), sin(angle))
    count_cycles(counting, ask)


@jit
def count_far(counting, profile, load, ask):
    """Count the cycles far from the contact, where there is a bulk stress alone."""
    angle = far_field(ask, load.bulk_range[1], load.bulk_range[0], profile.plane)[1]
    C, S, nu = cos(angle), sin(angle), ask.poisson_ratio
    of_b, of_c = swing_weights(ask, C, S)
    of_tension = 0.5 * (1.0 + C)
    of_swing = 0.5 * of_b
    if ask.criterion == SWT:  # (1-ν²) ε_n
        of_swing += 0.5 * (1.0 + nu) - nu * (1.0 + nu if profile.plane else 1.0)
    count = load.sides if load.sides > 0 else min(SAMPLES * load.fastest, MAX_INSTANTS)
    step = load.period / count
    for i in range(count):
        stress = bulk_at(load, i * step)
        if load.sides == 0:
            before, after = bulk_at(load, (i - 1) * step), bulk_at(load, (i + 1) * step)
            if (after - stress) * (stress - before) <= 0.0:
                top = vertex(-1.0, 0.0, 1.0, before, stress, after)[1]
                low = -vertex(-1.0, 0.0, 1.0, -before, -stress, -after)[1]
                stress = top if top > stress else low
        counting.stress[i], counting.swing[i] = of_tension * stress, of_swing * stress
    counting.points = count
    count_cycles(counting, ask)


@jit
def count_point(counting, search, point, x, angle, out):
    """Cycles of one point: on the critical plane, then at up to one place and plane for each power."""
    load, profile, ask, cycle = point.load, point.profile, point.ask, point.cycle
    out.places = 0
    if isnan(angle):
        return
    solve_cycle(cycle, load)
    if not cycle.overflow and isnan(x):
        count_far(counting, profile, load, ask)
        set_largest(counting)
        if counting.largest > 0.0:
            keep_cycles(counting, out)
    elif not cycle.overflow:
        cycle.shift = shift_of(load, profile, ask, cycle.event, cycle.events)
        largest = place_of(profile, cycle.largest)
        count_home(counting, point, x, angle, largest)
        set_largest(counting)
        if counting.largest > 0.0:
            keep_cycles(counting, out)
            look_along(counting, search, point, largest)
            for power in range(POWERS.shape[0]):
                if not counting.found[power]:
                    continue
                look_closer(counting, point, power, largest)
                if sum_of(counting, POWERS[power]) > (1.0 + GAIN) * counting.known[power]:
                    for p in range(POWERS.shape[0]):
                        counting.known[p] = max(counting.known[p], sum_of(counting, POWERS[p]))
                    keep_cycles(counting, out)
    out.overflow = cycle.overflow


@jit
def count_points(counting, search, room, profiles, which, loads, asks, x, angle, first, out):
    """Point i from the first on: profile which[i], loads[i], asks[i], its critical x and 2θ.

    Returns the first point that has not been counted, for want of room for its cycles.
    """
    used = 0
    for i in range(first, which.shape[0]):
        if used + MAX_PLACES * MAX_INSTANTS // 2 > MAX_SHARES:
            return i
        out[i].begin[0] = used
        point = Point(loads[i], profiles[which[i]], asks[i], *room)
        count_point(counting, search, point, x[i], angle[i], out[i])
        used = out[i].begin[out[i].places]
    return which.shape[0]
