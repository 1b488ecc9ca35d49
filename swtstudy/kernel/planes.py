"""The critical plane at one position: largest value of the criterion over planes through y.

With θ the angle of the plane's normal against x, all curves are sinusoids in 2θ at each instant,

    σ_n = a + b cos 2θ + c sin 2θ,
    (1-ν²) ε_n = d + (1+ν)(b cos 2θ + c sin 2θ),    τ = c cos 2θ - b sin 2θ,

so the criterion is a maximum over triples of instants of smooth functions of θ. Its kinks point down: between
two planes only downward curvature can hide a higher value, and the amplitudes of the sinusoids bound it.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, LOBATTO, barycentric, tail
from swtstudy.kernel.compiled import jit, jit_reordered
from swtstudy.kernel.criterion import SWT, curvature_bound, lifted, partials, sensitivities, swing_weights
from swtstudy.kernel.history import MAX_INSTANTS, MAX_PARTS, MONOTONE

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
WORK = np.dtype(
    [
        ("a", "f8", (MAX_INSTANTS,)),
        ("b", "f8", (MAX_INSTANTS,)),
        ("c", "f8", (MAX_INSTANTS,)),
        ("d", "f8", (MAX_INSTANTS,)),
        ("double", "i8", (MAX_PARTS,)),  # 1: parts to be doubled
        ("change", "f8"),  # of the value by the last doubling
        ("curve", "f8", (2, FINEST + 1)),  # of one part
        ("weight", "f8", (FINEST + 1,)),
        ("value", "f8", (PLANES,)),
        ("noise", "f8"),  # tension that rounding may make
        ("curvature", "f8"),  # bound of -d²/d(2θ)²
        ("waiting", "f8", (128, 4)),  # intervals of planes: 2θ, value, width, value at the other end
        ("top", "f8", (3,)),  # largest estimate of each curve
        ("part", "i8", (3,)),  # and its part and instant
        ("node", "i8", (3,)),
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
def fill(H, W, side, Q):
    """Write a, b, c, d of all instants at side · x; returns the largest b² + c², and the largest |a|."""
    largest, of_a, nu = 0.0, 0.0, Q.poisson_ratio
    of_strain = 1.0 if Q.criterion == SWT else 0.0
    of_bulk = nu if H.plane else 0.0
    for i in range(H.instants):
        xx = H.within[i] - H.p[i] + side * H.xx[i] + H.bulk[i]
        yy = -H.within[i] - 2.0 * nu * H.p[i] + side * H.yy[i] + of_bulk * H.bulk[i]
        zz = -H.p[i]
        a, b, c = 0.5 * (xx + zz), 0.5 * (xx - zz), -H.q[i]
        W.a[i], W.b[i], W.c[i] = a, b, c
        W.d[i] = of_strain * ((1.0 + nu) * a - nu * (xx + yy + zz))
        largest = max(largest, b * b + c * c)
        of_a = max(of_a, abs(a))
    return largest, of_a


@jit_reordered
def extremes(W, m, C, S, of_b, of_c):
    """Largest σ_n, largest and smallest swing over the instants on one plane."""
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        b, c = W.b[i], W.c[i]
        stress = W.a[i] + b * C + c * S
        swing = W.d[i] + b * of_b + c * of_c
        top = max(top, stress)
        high = max(high, swing)
        low = min(low, swing)
    return top, high, low


@jit
def curve_at(W, Q, i, which, C, S):
    """One curve at one instant."""
    if which == STRESS:
        return W.a[i] + W.b[i] * C + W.c[i] * S
    of_b, of_c = swing_weights(Q, C, S)
    swing = W.d[i] + W.b[i] * of_b + W.c[i] * of_c
    return swing if which == SWING else -swing


@jit
def vertex(y0, y1, y2, f0, f1, f2):
    """Place of the maximum of the parabola through three points, and its height; y1, f1 where it has none."""
    left, right = (f1 - f0) / (y1 - y0), (f2 - f1) / (y2 - y1)
    bend = (right - left) / (y2 - y0)
    if bend >= 0.0:
        return y1, f1
    slope = left + bend * (y1 - y0)  # at y1
    move = -0.5 * slope / bend
    return y1 + move, f1 - 0.25 * slope * slope / bend


@jit
def middle_node(node, first, intervals):
    """The inner instant of a part next to `node`, or itself: three points about it are in the part."""
    return min(max(node, first + 1), first + intervals - 1)


@jit
def estimate(H, W, Q, z, node, which, C, S):
    """Estimated maximum of a curve within part z, from its largest instant."""
    i = middle_node(node, H.first[z], H.intervals[z])
    step = FINEST // H.intervals[z]
    j = (i - H.first[z]) * step
    f = curve_at(W, Q, node, which, C, S)
    y, height = vertex(
        LOBATTO[j - step],
        LOBATTO[j],
        LOBATTO[j + step],
        curve_at(W, Q, i - 1, which, C, S),
        curve_at(W, Q, i, which, C, S),
        curve_at(W, Q, i + 1, which, C, S),
    )
    return max(f, height) if LOBATTO[j - step] < y < LOBATTO[j + step] else f


@jit
def find_peaks(H, W, Q, C, S):
    """For each of the three curves on a plane, the part and the instant with its largest maximum."""
    of_b, of_c = swing_weights(Q, C, S)
    for which in range(3):
        W.top[which] = -1e300
    for z in range(H.parts):
        first, last = H.first[z], H.first[z] + H.intervals[z]
        top, high, low = -1e300, -1e300, 1e300
        at_top, at_high, at_low = first, first, first
        for i in range(first, last + 1):
            b, c = W.b[i], W.c[i]
            stress, swing = W.a[i] + b * C + c * S, W.d[i] + b * of_b + c * of_c
            if stress > top:
                top, at_top = stress, i
            if swing > high:
                high, at_high = swing, i
            if swing < low:
                low, at_low = swing, i
        for which in range(3):
            node = at_top if which == STRESS else at_high if which == SWING else at_low
            if H.intervals[z] == 1:
                height = top if which == STRESS else high if which == SWING else -low
            else:
                height = estimate(H, W, Q, z, node, which, C, S)
            if height > W.top[which]:
                W.top[which], W.part[which], W.node[which] = height, z, node


@jit
def in_swing(Q, b, c):
    """Coefficients of cos 2θ and sin 2θ in the swing, from those in σ_n."""
    if Q.criterion == SWT:
        return (1.0 + Q.poisson_ratio) * b, (1.0 + Q.poisson_ratio) * c
    return c, -b


@jit
def locate(H, W, Q, which, C, S):
    """Write the coefficients of a curve at its maximum over time: parabolas on the series of its part.

    Returns the place of the maximum on the part, from -1 to 1.
    """
    z, node = W.part[which], W.node[which]
    first, intervals = H.first[z], H.intervals[z]
    step = FINEST // intervals
    if intervals == 1:
        of_cos, of_sin = W.b[node], W.c[node]
        if which != STRESS:
            of_cos, of_sin = in_swing(Q, of_cos, of_sin)
        W.at_peak[which, 0] = W.a[node] if which == STRESS else W.d[node]
        W.at_peak[which, 1], W.at_peak[which, 2] = of_cos, of_sin
        return -1.0 if node == first else 1.0
    values = W.curve[0]
    for j in range(intervals + 1):
        values[j] = curve_at(W, Q, first + j, which, C, S)
    i = middle_node(node, first, intervals) - first
    y0, y1, y2 = LOBATTO[(i - 1) * step], LOBATTO[i * step], LOBATTO[(i + 1) * step]
    f0, f1, f2 = values[i - 1], values[i], values[i + 1]
    best, at = values[node - first], LOBATTO[(node - first) * step]
    span = max(abs(values[0] - best), abs(values[intervals] - best))
    resolved = intervals < FINEST or tail(values, intervals) <= RESOLVED * span
    for _ in range(4 if resolved else 0):
        y = vertex(y0, y1, y2, f0, f1, f2)[0]
        if not (y > y0 and y < y2) or abs(y - y1) < 1e-3 * (y2 - y0):
            break
        barycentric(y, intervals, W.weight)
        f = 0.0
        for j in range(intervals + 1):
            f += W.weight[j] * values[j]
        if f > best:
            best, at = f, y
        if (y > y1) == (f > f1):
            if f > f1:
                y0, f0, y1, f1 = y1, f1, y, f
            else:
                y0, f0 = y, f
        elif f > f1:
            y2, f2, y1, f1 = y1, f1, y, f
        else:
            y2, f2 = y, f
    barycentric(at, intervals, W.weight)
    constant, of_cos, of_sin = 0.0, 0.0, 0.0
    for j in range(intervals + 1):
        w = W.weight[j]
        constant += w * (W.a[first + j] if which == STRESS else W.d[first + j])
        of_cos += w * W.b[first + j]
        of_sin += w * W.c[first + j]
    if which != STRESS:
        of_cos, of_sin = in_swing(Q, of_cos, of_sin)
    W.at_peak[which, 0], W.at_peak[which, 1], W.at_peak[which, 2] = constant, of_cos, of_sin
    return at


@jit
def climb(H, W, Q, angle, tolerance):
    """From the plane 2θ = angle to a local maximum, by turns: instants for the plane, plane for the instants.

    Returns h of the criterion there, which never falls from turn to turn, and 2θ.
    """
    best, best_angle = 0.0, angle
    for _ in range(20):
        C, S = cos(angle), sin(angle)
        find_peaks(H, W, Q, C, S)
        for which in range(3):
            locate(H, W, Q, which, C, S)
        s0, s1, s2 = W.at_peak[0, 0], W.at_peak[0, 1], W.at_peak[0, 2]
        r0, r1 = W.at_peak[1, 0] - W.at_peak[2, 0], W.at_peak[1, 1] - W.at_peak[2, 1]
        r2 = W.at_peak[1, 2] - W.at_peak[2, 2]
        value = lifted(Q, s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S, W.noise)
        gained = value - best
        if gained > 0.0:
            best, best_angle = value, angle
        if gained <= tolerance * best:
            break
        for _ in range(8):
            T, A = s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S
            dT, dA = s2 * C - s1 * S, r2 * C - r1 * S
            of_T, of_A, of_TT, of_TA, of_AA = partials(Q, T, A)
            rate = of_T * dT + of_A * dA
            bend = of_T * (s0 - T) + of_A * (r0 - A)
            bend += of_TT * dT * dT + 2.0 * of_TA * dT * dA + of_AA * dA * dA
            h = lifted(Q, T, A, W.noise)
            bend = h * bend - rate * rate  # Newton's method for ln h
            move = -h * rate / bend if bend < 0.0 else (0.1 if rate > 0.0 else -0.1)
            move = min(max(move, -0.3), 0.3)
            angle += move
            C, S = cos(angle), sin(angle)
            if abs(move) < 1e-5:
                break
        promised = lifted(Q, s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S, W.noise)
        if promised <= best * (1.0 + tolerance):
            break
    return best, best_angle


@jit
def survey_planes(H, W, Q, side):
    """Write h on each plane of the first look at side · x.

    Returns which is the largest, and the bound of all planes.
    """
    m = H.instants
    largest, of_a = fill(H, W, side, Q)
    amplitude = sqrt(largest)
    W.noise = NOISE * (of_a + amplitude)
    best, tops, ranges = 0, 0.0, 0.0
    for k in range(PLANES):
        of_b, of_c = swing_weights(Q, COS_2[k], SIN_2[k])
        top, high, low = extremes(W, m, COS_2[k], SIN_2[k], of_b, of_c)
        W.value[k] = lifted(Q, top, high - low, W.noise)
        tops, ranges = max(tops, top), max(ranges, high - low)
        if W.value[k] > W.value[best]:
            best = k
    tops *= 1.1
    ranges *= 1.1
    of_plane = 1.0 + Q.poisson_ratio if Q.criterion == SWT else 1.0
    swing = min(2.0 * of_plane * amplitude, ranges)
    W.curvature = curvature_bound(Q, tops, ranges, amplitude, swing, amplitude)
    bound = 0.0
    for k in range(PLANES):
        bound = max(bound, above(W.value[k], W.value[(k + 1) % PLANES], W.curvature * STEP * STEP))
    return best, bound


@jit
def higher_plane(H, W, Q, best, tolerance, closely):
    """A plane after a survey whose h exceeds the best by more than the tolerance, if there is one.

    Returns its h and 2θ: between two planes there is none above the bound. Closely, maxima between the
    instants count.
    """
    where, limit = 0.0, best * (1.0 + tolerance)
    for k in range(PLANES):
        depth = 1
        W.waiting[0, 0], W.waiting[0, 1] = STEP * k, W.value[k]
        W.waiting[0, 2], W.waiting[0, 3] = STEP, W.value[(k + 1) % PLANES]
        while depth > 0:
            depth -= 1
            angle, f1 = W.waiting[depth, 0], W.waiting[depth, 1]
            width, f2 = W.waiting[depth, 2], W.waiting[depth, 3]
            if above(f1, f2, W.curvature * width * width) <= limit or width < 1e-4:
                continue
            width *= 0.5
            C, S = cos(angle + width), sin(angle + width)
            of_b, of_c = swing_weights(Q, C, S)
            top, high, low = extremes(W, H.instants, C, S, of_b, of_c)
            f = lifted(Q, top, high - low, W.noise)
            if closely and f > f1 and f > f2 and f > (1.0 - BETWEEN) * limit:
                find_peaks(H, W, Q, C, S)
                f = lifted(Q, W.top[STRESS], W.top[SWING] + W.top[MINUS_SWING], W.noise)
            if f > limit:
                best, where, limit = f, angle + width, f * (1.0 + tolerance)
            W.waiting[depth, 0], W.waiting[depth, 1], W.waiting[depth, 2], W.waiting[depth, 3] = (
                angle,
                f1,
                width,
                f,
            )
            depth += 1
            W.waiting[depth, 0], W.waiting[depth, 1] = angle + width, f
            W.waiting[depth, 2], W.waiting[depth, 3] = width, f2
            depth += 1
    return best, where


@jit
def unresolved(H, W, Q, z, C, S, tolerance):
    """Possible rise of the criterion by what a curve of part z may exceed its maximum on a plane, relative.

    0 where the part is resolved. The last coefficients of its series tell what the interpolation misses. A
    part that stays below the largest maximum of each curve by more than that is resolved anyway.
    """
    first, intervals = H.first[z], H.intervals[z]
    of_b, of_c = swing_weights(Q, C, S)
    at_top, at_high, at_low = first, first, first
    for j in range(intervals + 1):
        i = first + j
        b, c = W.b[i], W.c[i]
        W.curve[0, j], W.curve[1, j] = W.a[i] + b * C + c * S, W.d[i] + b * of_b + c * of_c
        if W.curve[0, j] > W.curve[0, at_top - first]:
            at_top = i
        if W.curve[1, j] > W.curve[1, at_high - first]:
            at_high = i
        if W.curve[1, j] < W.curve[1, at_low - first]:
            at_low = i
    of_tension, of_swing = sensitivities(Q, W.top[STRESS], W.top[SWING] + W.top[MINUS_SWING])
    miss = 0.0
    if H.cusps[z] == MONOTONE:
        return miss
    if intervals == 1:  # of a short side, between whose ends the stress is next to monotone
        db, dc = abs(W.b[first + 1] - W.b[first]), abs(W.c[first + 1] - W.c[first])
        of_b, of_c = max(abs(of_b), abs(of_c)), max(abs(of_b), abs(of_c))
        for which in range(3):
            if which == STRESS:
                top, moved = max(W.curve[0, 0], W.curve[0, 1]), abs(W.a[first + 1] - W.a[first]) + db + dc
            else:
                top = (
                    max(W.curve[1, 0], W.curve[1, 1])
                    if which == SWING
                    else -min(W.curve[1, 0], W.curve[1, 1])
                )
                moved = abs(W.d[first + 1] - W.d[first]) + of_b * db + of_c * dc
            share = of_tension if which == STRESS else of_swing
            rise = top + moved - W.top[which]
            if rise > 0.0 and moved * share > tolerance:
                miss = max(miss, min(rise, moved) * share)
        return miss
    for which in range(3):
        node = at_top if which == STRESS else at_high if which == SWING else at_low
        share = of_tension if which == STRESS else of_swing
        error = tail(W.curve[0 if which == STRESS else 1], intervals)
        rise = estimate(H, W, Q, z, node, which, C, S) + 2.0 * error - W.top[which]
        if rise > 0.0 and error * share > tolerance:
            miss = max(miss, min(rise, 2.0 * error) * share)
    return miss
