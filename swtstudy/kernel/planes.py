"""The critical plane at one position: largest max_t σ_n · (max_t ε_n - min_t ε_n)/2 over planes through y.

With θ the angle of the plane's normal against x, both curves are sinusoids in 2θ at each instant,

    σ_n = a + b cos 2θ + c sin 2θ,    (1-ν²) ε_n = d + (1+ν)(b cos 2θ + c sin 2θ),

so swt(θ) is a maximum over triples of instants of smooth functions of θ. Its kinks point down: between two
planes only downward curvature can hide a higher value, and the amplitudes of the sinusoids bound it.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, LOBATTO, barycentric, tail
from swtstudy.kernel.compiled import jit, jit_reordered
from swtstudy.kernel.history import MAX_INSTANTS, MAX_PARTS

#: Planes of the first look, over 2θ.
PLANES = 16
STEP = 2.0 * pi / PLANES
COS_2, SIN_2 = np.cos(STEP * np.arange(PLANES)), np.sin(STEP * np.arange(PLANES))
#: Curves over time on a plane: σ_n, ε_n, -ε_n.
STRESS, STRAIN, MINUS_STRAIN = 0, 1, 2

#: Larger last coefficients of the finest series, over the range of its values: its peak is its largest value.
RESOLVED = 1e-5
WORK = np.dtype(
    [
        ("a", "f8", (MAX_INSTANTS,)),
        ("b", "f8", (MAX_INSTANTS,)),
        ("c", "f8", (MAX_INSTANTS,)),
        ("d", "f8", (MAX_INSTANTS,)),
        ("double", "i8", (MAX_PARTS,)),  # 1: parts to be doubled
        ("curve", "f8", (2, FINEST + 1)),  # of one part
        ("weight", "f8", (FINEST + 1,)),
        ("value", "f8", (PLANES,)),
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
def fill(H, W, side, nu):
    """Write a, b, c, d of all instants at side · x; returns the largest b² + c²."""
    largest = 0.0
    for i in range(H.instants):
        xx = H.within[i] - H.p[i] + side * H.xx[i]
        yy = -H.within[i] - 2.0 * nu * H.p[i] + side * H.yy[i]
        zz = -H.p[i]
        a, b, c = 0.5 * (xx + zz), 0.5 * (xx - zz), -H.q[i]
        W.a[i], W.b[i], W.c[i] = a, b, c
        W.d[i] = (1.0 + nu) * a - nu * (xx + yy + zz)
        largest = max(largest, b * b + c * c)
    return largest


@jit_reordered
def extremes(W, m, C, S, e):
    """Largest σ_n, largest and smallest (1-ν²) ε_n over the instants on one plane."""
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        g = W.b[i] * C + W.c[i] * S
        stress = W.a[i] + g
        strain = W.d[i] + e * g
        top = max(top, stress)
        high = max(high, strain)
        low = min(low, strain)
    return top, high, low


@jit
def curve_at(W, i, which, C, S, e):
    """One curve at one instant."""
    g = W.b[i] * C + W.c[i] * S
    if which == STRESS:
        return W.a[i] + g
    strain = W.d[i] + e * g
    return strain if which == STRAIN else -strain


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
def estimate(H, W, z, node, which, C, S, e):
    """Estimated maximum of a curve within part z, from its largest instant."""
    i = middle_node(node, H.first[z], H.intervals[z])
    step = FINEST // H.intervals[z]
    j = (i - H.first[z]) * step
    f = curve_at(W, node, which, C, S, e)
    y, height = vertex(
        LOBATTO[j - step],
        LOBATTO[j],
        LOBATTO[j + step],
        curve_at(W, i - 1, which, C, S, e),
        curve_at(W, i, which, C, S, e),
        curve_at(W, i + 1, which, C, S, e),
    )
    return max(f, height) if LOBATTO[j - step] < y < LOBATTO[j + step] else f


@jit
def find_peaks(H, W, C, S, e):
    """For each of the three curves on a plane, the part and the instant with its largest maximum."""
    for which in range(3):
        W.top[which] = -1e300
    for z in range(H.parts):
        first, last = H.first[z], H.first[z] + H.intervals[z]
        top, high, low = -1e300, -1e300, 1e300
        at_top, at_high, at_low = first, first, first
        for i in range(first, last + 1):
            g = W.b[i] * C + W.c[i] * S
            stress, strain = W.a[i] + g, W.d[i] + e * g
            if stress > top:
                top, at_top = stress, i
            if strain > high:
                high, at_high = strain, i
            if strain < low:
                low, at_low = strain, i
        for which in range(3):
            node = at_top if which == STRESS else at_high if which == STRAIN else at_low
            height = estimate(H, W, z, node, which, C, S, e)
            if height > W.top[which]:
                W.top[which], W.part[which], W.node[which] = height, z, node


@jit
def locate(H, W, which, C, S, e):
    """Write the coefficients of a curve at its maximum over time: parabolas on the series of its part."""
    z, node = W.part[which], W.node[which]
    first, intervals = H.first[z], H.intervals[z]
    step = FINEST // intervals
    values = W.curve[0]
    for j in range(intervals + 1):
        values[j] = curve_at(W, first + j, which, C, S, e)
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
    factor = 1.0 if which == STRESS else e
    W.at_peak[which, 0], W.at_peak[which, 1], W.at_peak[which, 2] = constant, factor * of_cos, factor * of_sin


@jit
def climb(H, W, angle, e, tolerance):
    """From the plane 2θ = angle to a local maximum, by turns: instants for the plane, plane for the instants.

    Returns the product of σ_n and the strain's range there, which never falls from turn to turn, and 2θ.
    """
    best, best_angle = 0.0, angle
    for _ in range(20):
        C, S = cos(angle), sin(angle)
        find_peaks(H, W, C, S, e)
        for which in range(3):
            locate(H, W, which, C, S, e)
        s0, s1, s2 = W.at_peak[0, 0], W.at_peak[0, 1], W.at_peak[0, 2]
        r0, r1 = W.at_peak[1, 0] - W.at_peak[2, 0], W.at_peak[1, 1] - W.at_peak[2, 1]
        r2 = W.at_peak[1, 2] - W.at_peak[2, 2]
        value = (s0 + s1 * C + s2 * S) * (r0 + r1 * C + r2 * S)
        gained = value - best
        if gained > 0.0:
            best, best_angle = value, angle
        if gained <= tolerance * best:
            break
        for _ in range(8):
            s, r = s0 + s1 * C + s2 * S, r0 + r1 * C + r2 * S
            ds, dr = s2 * C - s1 * S, r2 * C - r1 * S
            rate = ds * r + s * dr
            bend = (s0 - s) * r + 2.0 * ds * dr + s * (r0 - r)
            move = -rate / bend if bend < 0.0 else (0.1 if rate > 0.0 else -0.1)
            move = min(max(move, -0.3), 0.3)
            angle += move
            C, S = cos(angle), sin(angle)
            if abs(move) < 1e-5:
                break
        promised = (s0 + s1 * C + s2 * S) * (r0 + r1 * C + r2 * S)
        if promised <= best * (1.0 + tolerance):
            break
    return best, best_angle


@jit
def survey_planes(H, W, side, nu):
    """Write the value on each plane of the first look at side · x.

    Returns which is the largest, and the bound of all planes.
    """
    m = H.instants
    e = 1.0 + nu
    amplitude = sqrt(fill(H, W, side, nu))
    best, tops, ranges = 0, 0.0, 0.0
    for k in range(PLANES):
        top, high, low = extremes(W, m, COS_2[k], SIN_2[k], e)
        W.value[k] = max(top, 0.0) * (high - low)
        tops, ranges = max(tops, top), max(ranges, high - low)
        if W.value[k] > W.value[best]:
            best = k
    tops *= 1.1
    ranges *= 1.1
    swing = min(2.0 * e * amplitude, ranges)
    W.curvature = amplitude * ranges + 2.0 * amplitude * swing + tops * swing
    bound = 0.0
    for k in range(PLANES):
        bound = max(bound, above(W.value[k], W.value[(k + 1) % PLANES], W.curvature * STEP * STEP))
    return best, bound


@jit
def higher_plane(H, W, best, e, tolerance):
    """A plane after a survey whose value exceeds the best by more than the tolerance, if there is one.

    Returns its value and 2θ: between two planes there is none above the bound.
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
            top, high, low = extremes(W, H.instants, cos(angle + width), sin(angle + width), e)
            f = max(top, 0.0) * (high - low)
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
def unresolved(H, W, z, C, S, e, tolerance):
    """Possible rise of a curve of part z above the largest values of the cycle on a plane, relative.

    0 where the part is resolved. The last coefficients of its series tell what the interpolation misses. A
    part that stays below the largest maximum of each curve by more than that is resolved anyway.
    """
    first, intervals = H.first[z], H.intervals[z]
    at_top, at_high, at_low = first, first, first
    for j in range(intervals + 1):
        i = first + j
        g = W.b[i] * C + W.c[i] * S
        W.curve[0, j], W.curve[1, j] = W.a[i] + g, W.d[i] + e * g
        if W.curve[0, j] > W.curve[0, at_top - first]:
            at_top = i
        if W.curve[1, j] > W.curve[1, at_high - first]:
            at_high = i
        if W.curve[1, j] < W.curve[1, at_low - first]:
            at_low = i
    miss = 0.0
    for which in range(3):
        node = at_top if which == STRESS else at_high if which == STRAIN else at_low
        scale = W.top[STRESS] if which == STRESS else W.top[STRAIN] + W.top[MINUS_STRAIN]
        error = tail(W.curve[0 if which == STRESS else 1], intervals)
        rise = estimate(H, W, z, node, which, C, S, e) + 2.0 * error - W.top[which]
        if rise > 0.0 and error > tolerance * scale:
            miss = max(miss, min(rise, 2.0 * error) / scale)
    return miss
