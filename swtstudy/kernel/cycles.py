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
from swtstudy.kernel.history import sample_cycle, write_stress
from swtstudy.kernel.load import bulk_at
from swtstudy.kernel.parts import COARSEST, MAX_INSTANTS, MAX_PARTS, ROOM, refine
from swtstudy.kernel.planes import MINUS_SWING, STRESS, SWING, fill, find_peaks
from swtstudy.kernel.point import FINEST_GROWTH, tension_share
from swtstudy.kernel.profile import place_of
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
def sum_of(N, power):
    """Sum of the cycles' values to a power, over the largest value at the critical place."""
    total = 0.0
    for i in range(N.cycles):
        total += (N.value[i] / N.largest) ** power
    return total


@jit
def reach_of(N, Q, top, swing):
    """Height of the cycles of the history over what would be better for some power: 1 and more may be.

    Parameters
    ----------
    top, swing
        Largest σ_n, and range of the swing.
    """
    value = value_of(Q, lifted(Q, top, swing, 0.0)) / N.largest
    if value <= 0.0 or swing <= 0.0:
        return 0.0
    way, turns, last = 0.0, 0, N.swing[0] - N.swing[N.points - 1]
    for i in range(N.points):
        step = N.swing[(i + 1) % N.points] - N.swing[i]
        way += abs(step)
        if step * last < 0.0:
            turns += 1
        if step != 0.0:
            last = step
    number, of_swing = 0.5 * way / swing, sensitivities(Q, top, swing)[1] * swing
    most = 0.0
    for p in range(POWERS.shape[0]):
        power = POWERS[p] * of_swing
        # A root of the amplitudes adds up to most where all are equal.
        equal = max(turns, 1.0) ** max(1.0 - power, 0.0) * number ** min(power, 1.0)
        most = max(most, value * (SLACK * equal / ((1.0 + GAIN) * N.known[p])) ** (1.0 / POWERS[p]))
    return most


@jit
def sample_at(N, H, C, R, P, K, L, Q, place, largest, intervals, side):
    """Sample the cycle at place s on one side with so many intervals of each part."""
    sample_cycle(H, C, R, P, K, L, Q, place, largest, side, COARSEST)
    sample_closely(H, C, P, K, L, Q, intervals)
    rank_parts(N, H, L)


@jit
def sample_closely(H, C, P, K, L, Q, intervals):
    """Give all parts of the sampled cycle so many intervals, but short sides of which the ends are enough."""
    for z in range(H.parts):
        while 1 < H.intervals[z] < intervals and H.instants + ROOM < MAX_INSTANTS:
            refine(H, z, C, P, L)
    write_stress(H, C, P, L, K, Q)


@jit
def place_at(N, at):
    """Place s of a number of a piece and the share of its angle."""
    piece = min(int(at), N.ends - 1)
    left, right = N.end[piece], N.end[piece + 1]
    return left + (right - left) * (0.5 - 0.5 * cos(pi * (at - piece)))


@jit
def look_at(N, H, W, C, R, P, K, L, Q, at, largest):
    """Count cycles at one place if they may matter; returns their height over the height that matters."""
    highest = 0.0
    for number in range(1 if L.mirrored else 2):
        side = 1.0 - 2.0 * number
        if number == 0 or C.shift != 0.0:
            sample_at(N, H, C, R, P, K, L, Q, place_at(N, at), largest, COARSELY, side)
        fill(H, W, side, Q)
        for plane in range(PLANES):
            follow(N, H, W, Q, COS_2[plane], SIN_2[plane])
            top, high, low = -1e300, -1e300, 1e300
            for i in range(N.points):
                top, high, low = max(top, N.stress[i]), max(high, N.swing[i]), min(low, N.swing[i])
            reach = reach_of(N, Q, top, high - low)
            highest = max(highest, reach)
            if reach <= 1.0:
                continue
            count_cycles(N, Q)
            for p in range(POWERS.shape[0]):
                total = sum_of(N, POWERS[p])
                if total > N.better[p]:
                    N.better[p], N.found[p] = total, 1
                    N.where[p, 0], N.where[p, 1], N.where[p, 2] = at, side, STEP * plane
    return highest


@jit
def look_along(N, S, H, W, C, R, P, K, L, Q, largest):
    """Find the best places of a coarse look along the line: ends of pieces, and within what may matter."""
    last = cusps(S, C, P, L, Q, largest) - 1
    N.ends = -1
    for j in range(last + 1):
        if ends_group(S, j, last, largest):
            N.ends += 1
            N.end[N.ends] = S.cusp[j]
    for p in range(POWERS.shape[0]):
        N.better[p], N.found[p] = N.known[p], 0
    for j in range(N.ends + 1):
        N.reach[j] = look_at(N, H, W, C, R, P, K, L, Q, float(j), largest)
    for j in range(N.ends):
        if WITHIN * max(N.reach[j], N.reach[j + 1]) <= 1.0:
            continue
        for i in range(1, QUARTERS):
            look_at(N, H, W, C, R, P, K, L, Q, j + i / QUARTERS, largest)


@jit
def look_closer(N, H, W, C, R, P, K, L, Q, power, largest):
    """Count the cycles of the largest sum for one power near the best place and plane of a coarse look."""
    at, side, angle = N.where[power, 0], N.where[power, 1], N.where[power, 2]
    wide, turned, best_at, best_angle = 1.0 / QUARTERS, STEP, at, angle
    for _ in range(ROUNDS):
        best, at, angle = -1.0, best_at, best_angle
        for i in range(OFFSETS.shape[0]):
            here = min(max(at + wide * OFFSETS[i], 0.0), float(N.ends))
            sample_at(N, H, C, R, P, K, L, Q, place_at(N, here), largest, CLOSELY, side)
            fill(H, W, side, Q)
            for j in range(OFFSETS.shape[0]):
                plane = angle + turned * OFFSETS[j]
                follow(N, H, W, Q, cos(plane), sin(plane))
                count_cycles(N, Q)
                total = sum_of(N, POWERS[power])
                if total > best:
                    best, best_at, best_angle = total, here, plane
        wide *= SHRINKING
        turned *= SHRINKING
    sample_at(N, H, C, R, P, K, L, Q, place_at(N, best_at), largest, FINELY, side)
    fill(H, W, side, Q)
    follow(N, H, W, Q, cos(best_angle), sin(best_angle))
    count_cycles(N, Q)


@jit
def keep_cycles(N, out):
    """Append the cycles that were counted to the point's cycles."""
    k = out.begin[out.places]
    for i in range(N.cycles):
        share = N.value[i] / N.largest
        if share > SMALLEST:
            N.shares[k] = share
            k += 1
    out.places += 1
    out.begin[out.places] = k


@jit
def set_largest(N):
    """Note the largest cycle at the critical place, over which all others are told, and the sums there."""
    N.largest = 0.0
    for i in range(N.cycles):
        N.largest = max(N.largest, N.value[i])
    if N.largest > 0.0:
        for p in range(POWERS.shape[0]):
            N.known[p] = sum_of(N, POWERS[p])


@jit
def count_home(N, H, W, C, R, P, K, L, Q, x, angle, largest):
    """Count the cycles at the critical place and plane."""
    b, side = P.flat_radius, -1.0 if x < 0.0 else 1.0
    square = (abs(x) - b) * (abs(x) + b)
    place = sqrt(abs(square)) if square >= 0.0 else -sqrt(abs(square))
    if P.singular and place >= 0.0:
        place = max(place, sqrt(2.0 * BESIDE) * b)
    asked, needed = Q.growth, Q.growth
    while True:
        growth = lay_out(R, C, P, L, asked)
        sample_at(N, H, C, R, P, K, L, Q, place, largest, COARSELY, side)
        fill(H, W, side, Q)
        find_peaks(H, W, Q, cos(angle), sin(angle))
        swing = W.top[SWING] + W.top[MINUS_SWING]
        value = value_of(Q, lifted(Q, W.top[STRESS], swing, 0.0))
        if value > 0.0:  # as for s itself: what grew is told to a share of the tension
            needed = Q.growth * min(tension_share(C, Q, min(W.top[STRESS], 0.5 * swing)), 1.0)
        if growth > asked or R.panels == 0 or needed >= 0.5 * growth or growth <= FINEST_GROWTH:
            break
        asked = max(0.5 * needed, FINEST_GROWTH)
    resolve(H, W, C, P, K, L, side, value, angle, Q, value)
    sample_closely(H, C, P, K, L, Q, FINELY)
    rank_parts(N, H, L)
    fill(H, W, side, Q)
    follow(N, H, W, Q, cos(angle), sin(angle))
    count_cycles(N, Q)


@jit
def count_far(N, P, L, Q):
    """Count the cycles far from the contact, where there is a bulk stress alone."""
    angle = far_field(Q, L.bulk_range[1], L.bulk_range[0], P.plane)[1]
    C, S, nu = cos(angle), sin(angle), Q.poisson_ratio
    of_b, of_c = swing_weights(Q, C, S)
    of_tension = 0.5 * (1.0 + C)
    of_swing = 0.5 * of_b
    if Q.criterion == SWT:  # (1-ν²) ε_n
        of_swing += 0.5 * (1.0 + nu) - nu * (1.0 + nu if P.plane else 1.0)
    count = L.sides if L.sides > 0 else min(SAMPLES * L.fastest, MAX_INSTANTS)
    step = L.period / count
    for i in range(count):
        stress = bulk_at(L, i * step)
        if L.sides == 0:
            before, after = bulk_at(L, (i - 1) * step), bulk_at(L, (i + 1) * step)
            if (after - stress) * (stress - before) <= 0.0:
                top = vertex(-1.0, 0.0, 1.0, before, stress, after)[1]
                low = -vertex(-1.0, 0.0, 1.0, -before, -stress, -after)[1]
                stress = top if top > stress else low
        N.stress[i], N.swing[i] = of_tension * stress, of_swing * stress
    N.points = count
    count_cycles(N, Q)


@jit
def count_point(C, R, S, H, W, K, N, P, L, Q, x, angle, out):
    """Cycles of one point: on the critical plane, then at up to one place and plane for each power."""
    out.places = 0
    if isnan(angle):
        return
    solve_cycle(C, L)
    if not C.overflow and isnan(x):
        count_far(N, P, L, Q)
        set_largest(N)
        if N.largest > 0.0:
            keep_cycles(N, out)
    elif not C.overflow:
        C.shift, largest = shift_of(L, P, Q, C.event, C.events), place_of(P, C.largest)
        count_home(N, H, W, C, R, P, K, L, Q, x, angle, largest)
        set_largest(N)
        if N.largest > 0.0:
            keep_cycles(N, out)
            look_along(N, S, H, W, C, R, P, K, L, Q, largest)
            for power in range(POWERS.shape[0]):
                if not N.found[power]:
                    continue
                look_closer(N, H, W, C, R, P, K, L, Q, power, largest)
                if sum_of(N, POWERS[power]) > (1.0 + GAIN) * N.known[power]:
                    for p in range(POWERS.shape[0]):
                        N.known[p] = max(N.known[p], sum_of(N, POWERS[p]))
                    keep_cycles(N, out)
    out.overflow = C.overflow


@jit
def count_points(C, R, S, H, W, K, N, profiles, which, loads, asks, x, angle, first, out):
    """Point i from the first on: profile which[i], loads[i], asks[i], its critical x and 2θ.

    Returns the first point that has not been counted, for want of room for its cycles.
    """
    used = 0
    for i in range(first, which.shape[0]):
        if used + MAX_PLACES * MAX_INSTANTS // 2 > MAX_SHARES:
            return i
        out[i].begin[0] = used
        count_point(C, R, S, H, W, K, N, profiles[which[i]], loads[i], asks[i], x[i], angle[i], out[i])
        used = out[i].begin[out[i].places]
    return which.shape[0]
