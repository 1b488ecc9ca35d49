"""The critical plane at one position: largest value of the criterion over planes through y.

With θ the angle of the plane's normal against x, all curves are sinusoids in 2θ at each instant,

    σ_n = a + b cos 2θ + c sin 2θ,
    (1-ν²) ε_n = d + (1+ν)(b cos 2θ + c sin 2θ),    τ = c cos 2θ - b sin 2θ,

so the criterion is a maximum over triples of instants of smooth functions of θ. Its kinks point down: between
two planes only downward curvature can hide a higher value, and the amplitudes of the sinusoids bound it.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, LOBATTO, barycentric, peak, tail
from swtstudy.kernel.compiled import fields, jit, jit_reordered, larger, smaller
from swtstudy.kernel.criterion import SWT, curvature_bound, lifted, partials, sensitivities, swing_weights
from swtstudy.kernel.parts import MAX_INSTANTS, MAX_PARTS, may_be_refined

#: Planes of the first look, over 2θ.
PLANES = 16
STEP = 2.0 * pi / PLANES
COS_2, SIN_2 = np.cos(STEP * np.arange(PLANES)), np.sin(STEP * np.arange(PLANES))
#: Curves over time on a plane: σ_n, the swing, its negative.
STRESS, SWING, MINUS_SWING = 0, 1, 2

#: Tension that rounding may make on a plane, as a share of the stresses of which it is the sum, and some.
NOISE = 1e-11
#: Share of h by which the largest values at the instants may fall short of the maxima between them.
BETWEEN = 5e-3
#: Larger last coefficients of the finest series, over the range of its values: its peak is its largest value.
RESOLVED = 1e-5
CURVES = np.dtype(
    [
        *fields("f8", "a b c d", (MAX_INSTANTS,)),
        ("curve", "f8", (2, FINEST + 1)),  # of one part
        ("weight", "f8", (FINEST + 1,)),
        ("value", "f8", (PLANES,)),
        ("noise", "f8"),  # tension that rounding may make
        ("curvature", "f8"),  # bound of -d²/d(2θ)²
        ("waiting", "f8", (128, 4)),  # intervals of planes: 2θ, value, width, value at the other end
        ("top", "f8", (3,)),  # largest maximum of each curve
        ("part", "i8", (3,)),  # and its part, and its place there, from -1 to 1
        ("place", "f8", (3,)),
        ("height", "f8", (MAX_PARTS, 3)),  # of each curve in each part, or a bound of it
        ("highest", "i8", (MAX_PARTS, 3)),  # its largest instant
        ("at_peak", "f8", (3, 3)),  # coefficients (1, cos 2θ, sin 2θ) of each curve at its maximum over time
    ]
)


@jit
def above(f1, f2, drop):
    """Largest value between two ends a width w apart of a function with f″ ≥ -K; drop is K w²."""
    if drop <= 0.0 or 2.0 * abs(f2 - f1) >= drop:
        return max(f1, f2)
    return 0.5 * (f1 + f2) + 0.125 * drop + 0.5 * (f2 - f1) * (f2 - f1) / drop


@jit_reordered
def fill(history, curves, side, ask):
    """Write a, b, c, d of all instants at side · x; returns the largest b² + c², and the largest |a|."""
    largest, of_a, nu = 0.0, 0.0, ask.poisson_ratio
    of_strain = 1.0 if ask.criterion == SWT else 0.0
    of_bulk = nu if history.plane else 0.0
    for i in range(history.instants):
        xx = history.within[i] - history.p[i] + side * history.xx[i] + history.bulk[i]
        yy = -history.within[i] - 2.0 * nu * history.p[i] + side * history.yy[i] + of_bulk * history.bulk[i]
        zz = -history.p[i]
        a, b, c = 0.5 * (xx + zz), 0.5 * (xx - zz), -history.q[i]
        curves.a[i], curves.b[i], curves.c[i] = a, b, c
        curves.d[i] = of_strain * ((1.0 + nu) * a - nu * (xx + yy + zz))
        largest = max(largest, b * b + c * c)
        of_a = max(of_a, abs(a))
    return largest, of_a


@jit_reordered
def extremes(curves, m, C, S, of_b, of_c):
    """Largest σ_n, largest and smallest swing over the instants on one plane."""
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        b, c = curves.b[i], curves.c[i]
        stress = curves.a[i] + b * C + c * S
        swing = curves.d[i] + b * of_b + c * of_c
        top = larger(top, stress)
        high = larger(high, swing)
        low = smaller(low, swing)
    return top, high, low


@jit
def curve_at(curves, ask, i, which, C, S):
    """One curve at one instant."""
    if which == STRESS:
        return curves.a[i] + curves.b[i] * C + curves.c[i] * S
    of_b, of_c = swing_weights(ask, C, S)
    swing = curves.d[i] + curves.b[i] * of_b + curves.c[i] * of_c
    return swing if which == SWING else -swing


@jit
def find_peaks(history, curves, ask, C, S):
    """Write the largest maximum over time of each of the three curves on a plane, and of all parts.

    A part has the maximum of its series next to its largest instant, or a bound of it that is below the
    largest maximum.
    """
    of_b, of_c = swing_weights(ask, C, S)
    for which in range(3):
        curves.top[which] = -1e300
    for z in range(history.parts):
        first, last = history.first[z], history.first[z] + history.intervals[z]
        top, high, low = -1e300, -1e300, 1e300
        for i in range(first, last + 1):
            b, c = curves.b[i], curves.c[i]
            stress, swing = curves.a[i] + b * C + c * S, curves.d[i] + b * of_b + c * of_c
            if stress > top:
                top, curves.highest[z, STRESS] = stress, i
            if swing > high:
                high, curves.highest[z, SWING] = swing, i
            if swing < low:
                low, curves.highest[z, MINUS_SWING] = swing, i
        curves.height[z, STRESS], curves.height[z, SWING], curves.height[z, MINUS_SWING] = top, high, -low
        for which in range(3):
            if curves.height[z, which] > curves.top[which]:
                at = (curves.highest[z, which] - first) * (FINEST // history.intervals[z])
                curves.top[which], curves.part[which] = curves.height[z, which], z
                curves.place[which] = LOBATTO[at]
    for z in range(history.parts):
        if history.intervals[z] == 1:
            continue
        for which in range(3):
            curves.height[z, which] += rise_beside(history, curves, ask, z, which, C, S)
            if curves.height[z, which] > curves.top[which]:
                place, curves.height[z, which] = peak_of_part(history, curves, ask, z, which, C, S)
                if curves.height[z, which] > curves.top[which]:
                    curves.top[which], curves.part[which] = curves.height[z, which], z
                    curves.place[which] = place


@jit
def rise_beside(history, curves, ask, z, which, C, S):
    """Bound of the rise of a curve within part z above its largest instant, from the instants beside it."""
    i, first, last = curves.highest[z, which], history.first[z], history.first[z] + history.intervals[z]
    f = curves.height[z, which]
    if first < i < last:
        before, after = curve_at(curves, ask, i - 1, which, C, S), curve_at(curves, ask, i + 1, which, C, S)
        return 0.5 * (f - before + f - after)
    inwards = 1 if i == first else -1
    second = curve_at(curves, ask, i + inwards, which, C, S)
    third = curve_at(curves, ask, i + 2 * inwards, which, C, S)
    return abs(f - second) + abs(second - third)


@jit
def peak_of_part(history, curves, ask, z, which, C, S):
    """Place, from -1 to 1, and value of a curve's maximum next to its largest instant in part z."""
    first, intervals, values = history.first[z], history.intervals[z], curves.curve[0]
    for j in range(intervals + 1):
        values[j] = curve_at(curves, ask, first + j, which, C, S)
    node = curves.highest[z, which] - first
    best = values[node]
    span = max(abs(values[0] - best), abs(values[intervals] - best))
    if intervals == FINEST and tail(values, intervals) > RESOLVED * span:
        return LOBATTO[node], best
    return peak(values, intervals, node, curves.weight, 0.1 * ask.plane * abs(best))


@jit
def locate(history, curves, ask, which):
    """Write the coefficients of a curve at its maximum over time."""
    z = curves.part[which]
    first, intervals = history.first[z], history.intervals[z]
    barycentric(curves.place[which], intervals, curves.weight)
    constant, of_cos, of_sin = 0.0, 0.0, 0.0
    for j in range(intervals + 1):
        w = curves.weight[j]
        constant += w * (curves.a[first + j] if which == STRESS else curves.d[first + j])
        of_cos += w * curves.b[first + j]
        of_sin += w * curves.c[first + j]
    if which != STRESS and ask.criterion == SWT:
        of_cos, of_sin = (1.0 + ask.poisson_ratio) * of_cos, (1.0 + ask.poisson_ratio) * of_sin
    elif which != STRESS:
        of_cos, of_sin = of_sin, -of_cos
    curves.at_peak[which, 0], curves.at_peak[which, 1], curves.at_peak[which, 2] = constant, of_cos, of_sin


@jit
def climb(history, curves, ask, angle, tolerance):
    """From the plane 2θ = angle to a local maximum, by turns: instants for the plane, plane for the instants.

    Returns h of the criterion there, which never falls from turn to turn, and 2θ.
    """
    best, best_angle = 0.0, angle
    for _ in range(20):
        C, S = cos(angle), sin(angle)
        find_peaks(history, curves, ask, C, S)
        for which in range(3):
            locate(history, curves, ask, which)
        s0, s1, s2 = curves.at_peak[0, 0], curves.at_peak[0, 1], curves.at_peak[0, 2]
        r0, r1 = curves.at_peak[1, 0] - curves.at_peak[2, 0], curves.at_peak[1, 1] - curves.at_peak[2, 1]
        r2 = curves.at_peak[1, 2] - curves.at_peak[2, 2]
        value = lifted(ask, s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S, curves.noise)
        gained = value - best
        if gained > 0.0:
            best, best_angle = value, angle
        if gained <= tolerance * best:
            break
        for _ in range(8):
            T, A = s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S
            dT, dA = s2 * C - s1 * S, r2 * C - r1 * S
            of_T, of_A, of_TT, of_TA, of_AA = partials(ask, T, A)
            rate = of_T * dT + of_A * dA
            bend = of_T * (s0 - T) + of_A * (r0 - A)
            bend += of_TT * dT * dT + 2.0 * of_TA * dT * dA + of_AA * dA * dA
            h = lifted(ask, T, A, curves.noise)
            bend = h * bend - rate * rate  # Newton's method for ln h
            move = -h * rate / bend if bend < 0.0 else (0.1 if rate > 0.0 else -0.1)
            move = min(max(move, -0.3), 0.3)
            angle += move
            C, S = cos(angle), sin(angle)
            if abs(move) < 1e-5:
                break
        promised = lifted(ask, s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S, curves.noise)
        if promised <= best * (1.0 + tolerance):
            break
    return best, best_angle


@jit
def survey_planes(history, curves, ask, side):
    """Write h on each plane of the first look at side · x.

    Returns which is the largest, and the bound of all planes.
    """
    m = history.instants
    largest, of_a = fill(history, curves, side, ask)
    amplitude = sqrt(largest)
    curves.noise = NOISE * (of_a + amplitude)
    best, tops, ranges = 0, 0.0, 0.0
    for k in range(PLANES):
        of_b, of_c = swing_weights(ask, COS_2[k], SIN_2[k])
        top, high, low = extremes(curves, m, COS_2[k], SIN_2[k], of_b, of_c)
        curves.value[k] = lifted(ask, top, high - low, curves.noise)
        tops, ranges = max(tops, top), max(ranges, high - low)
        if curves.value[k] > curves.value[best]:
            best = k
    tops *= 1.1
    ranges *= 1.1
    of_plane = 1.0 + ask.poisson_ratio if ask.criterion == SWT else 1.0
    swing = min(2.0 * of_plane * amplitude, ranges)
    curves.curvature = curvature_bound(ask, tops, ranges, amplitude, swing, amplitude)
    bound = 0.0
    for k in range(PLANES):
        beside = curves.value[(k + 1) % PLANES]
        bound = max(bound, above(curves.value[k], beside, curves.curvature * STEP * STEP))
    return best, bound


@jit
def halve_top(waiting, depth, f):
    """Replace the interval at the top of a stack by its halves, with f in the middle; returns their number.

    Its row is an angle, the value there, the width, and the value at the other end.
    """
    lower, upper = waiting[depth - 1], waiting[depth]
    width = 0.5 * lower[2]
    upper[0], upper[1], upper[2], upper[3] = lower[0] + width, f, width, lower[3]
    lower[2], lower[3] = width, f
    return depth + 1


@jit
def higher_plane(history, curves, ask, best, tolerance, closely):
    """A plane after a survey whose h exceeds the best by more than the tolerance, if there is one.

    Returns its h and 2θ: between two planes there is none above the bound. Closely, maxima between the
    instants count.
    """
    where, limit = 0.0, best * (1.0 + tolerance)
    for k in range(PLANES):
        depth, row = 1, curves.waiting[0]
        row[0], row[1], row[2], row[3] = STEP * k, curves.value[k], STEP, curves.value[(k + 1) % PLANES]
        while depth > 0:
            row = curves.waiting[depth - 1]
            f1, width, f2 = row[1], row[2], row[3]
            if above(f1, f2, curves.curvature * width * width) <= limit or width < 1e-4:
                depth -= 1
                continue
            angle = row[0] + 0.5 * width
            C, S = cos(angle), sin(angle)
            of_b, of_c = swing_weights(ask, C, S)
            top, high, low = extremes(curves, history.instants, C, S, of_b, of_c)
            f = lifted(ask, top, high - low, curves.noise)
            if closely and f > f1 and f > f2 and f > (1.0 - BETWEEN) * limit:
                find_peaks(history, curves, ask, C, S)
                f = lifted(ask, curves.top[STRESS], curves.top[SWING] + curves.top[MINUS_SWING], curves.noise)
            if f > limit:
                best, where, limit = f, angle, f * (1.0 + tolerance)
            depth = halve_top(curves.waiting, depth, f)
    return best, where


@jit
def unresolved(history, curves, ask, z, C, S, tolerance):
    """Possible rise of the criterion by what a curve of part z may exceed its maximum on a plane, relative.

    0 where the part is resolved. The last coefficients of its series tell what the interpolation misses. A
    part that stays below the largest maximum of each curve by more than that is resolved anyway.
    `find_peaks` finds the maxima on the same plane.
    """
    first, intervals, miss = history.first[z], history.intervals[z], 0.0
    of_b, of_c = swing_weights(ask, C, S)
    of_tension, of_swing = sensitivities(ask, curves.top[STRESS], curves.top[SWING] + curves.top[MINUS_SWING])
    if intervals == 1:  # of a short side, between whose ends the stress is next to monotone
        db, dc = abs(curves.b[first + 1] - curves.b[first]), abs(curves.c[first + 1] - curves.c[first])
        of_b, of_c = max(abs(of_b), abs(of_c)), max(abs(of_b), abs(of_c))
        for which in range(3):
            moved = abs(curves.d[first + 1] - curves.d[first]) + of_b * db + of_c * dc
            if which == STRESS:
                moved = abs(curves.a[first + 1] - curves.a[first]) + db + dc
            share = of_tension if which == STRESS else of_swing
            rise = curves.height[z, which] + moved - curves.top[which]
            if rise > 0.0 and moved * share > tolerance:
                miss = max(miss, min(rise, moved) * share)
        return miss
    for j in range(intervals + 1):
        a, b, c, d = curves.a[first + j], curves.b[first + j], curves.c[first + j], curves.d[first + j]
        curves.curve[0, j], curves.curve[1, j] = a + b * C + c * S, d + b * of_b + c * of_c
    for which in range(3):
        share = of_tension if which == STRESS else of_swing
        error = tail(curves.curve[0 if which == STRESS else 1], intervals)
        rise = curves.height[z, which] + 2.0 * error - curves.top[which]
        if rise > 0.0 and error * share > tolerance:
            miss = max(miss, min(rise, 2.0 * error) * share)
    return miss


@jit
def mark_unresolved(history, curves, cycle, ask, Ct, St, tolerance):
    """Mark the parts of the cycle that may hide a higher value on a plane and can be refined.

    `find_peaks` finds the maxima on the same plane.

    Returns
    -------
    marked, most, missing
        Number of marked parts; what one of these may hide, and what any part may hide, relative.
    """
    marked, most, missing = 0, 0.0, 0.0
    for z in range(history.parts):
        history.marked[z] = 0
        miss = unresolved(history, curves, ask, z, Ct, St, tolerance)
        missing = max(missing, miss)
        if miss > 0.0 and may_be_refined(history, cycle, z):
            history.marked[z] = 1
            most = max(most, miss)
            marked += 1
    return marked, most, missing


@jit
def mark_highest(history, curves, cycle):
    """Mark the parts with the maxima of the three curves, unless they are finest; returns how many."""
    marked = 0
    for which in range(3):
        z = curves.part[which]
        if history.intervals[z] < FINEST and history.marked[z] == 0 and may_be_refined(history, cycle, z):
            history.marked[z] = 1
            marked += 1
    return marked
