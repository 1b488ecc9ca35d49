"""The critical plane of a stress history: largest value of the criterion over planes of every orientation.

On the plane with the normal n the tension is T = max σ_n. The range of the swing is A = max w - min w of the
normal strain w = (1+ν) σ_n - ν tr σ, or the longest chord of the path of the shear stress vector.

Both are maxima, over instants or pairs of instants, of smooth functions of n. Along a great circle σ_n is a
sinusoid of twice the angle. So is the component of a shear stress along a line that turns with the plane: its
second derivative is at least -4 times itself, and its first one at most twice the largest shear of the
change. So over twice the angle the bounds of `swtstudy.kernel.criterion.curvature_bound` hold with the
largest √J2 of a stress, and of a change of it, and no slope of T is steeper than its height above 0 allows
(`swtstudy.kernel.criterion.slope_bound`). In a triangle of normals the value is at most that of the
plane through the values at its corners, plus what such a curvature adds. Triangles that may hold a higher
value are cut in two, until there is none.
"""

from math import acos, cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.compiled import fields, jit, jit_reordered, new_record
from swtstudy.kernel.criterion import SWT, curvature_bound, lifted, partials, slope_bound, value_of
from swtstudy.kernel.planes import NOISE, above, halve_top

#: Rows of a history: xx, yy, zz, yz, xz, xy; ν tr σ or 0; two components of the shear stress on a plane.
ROWS = 9
#: So many triangles are cut in the order in which they came, the others depth first.
IN_ORDER = np.int64(60)
MAX_TRIANGLES = 256
#: Most planes of a search.
MOST_PLANES = 200_000
#: Lines in a plane along which a chord is looked for at first; it may be longer than along these.
LINES = np.int64(8)
BESIDE_LINES = 1.0 / np.cos(0.5 * np.pi / LINES)
#: Tolerance of chords while climbing.
CLIMBING = 1e-4
#: Planes whose value is below this share of the best are not looked at more closely.
NEAR = 0.9
#: Tension below this share of the largest √J2 is none: a principal stress is no more exact.
NO_TENSION = 1e-7
#: Where tension is next to nothing, what counts is this share of the tolerance of the largest possible value.
NEXT_TO_NOTHING = 1e-6
#: Largest principal value of a deviator over √J2.
OF_J2 = 2.0 / np.sqrt(3.0)
PLANES = np.dtype(
    [
        ("normal", "f8", (3,)),  # of the best plane; before the search a guess, or 0
        *fields("f8", "best limit"),  # h there, and what a higher value must exceed
        ("planes", "i8"),  # that have been looked at
        ("unsettled", "i8"),  # 1: the search ended before its bound was met
        ("noise", "f8"),  # tension that rounding may make
        ("instant", "i8"),  # of the largest principal stress
        *fields("f8", "of_tension of_swing"),  # bounds of the derivatives over twice the angle
        ("most", "f8", (2,)),  # bounds of T and A
        ("seen", "f8", (3,)),  # h, T, A of the last plane, from above
        *fields("f8", "trial kept", (3,)),  # normals of a climb: the last one and the highest
        ("tangent", "f8", (2, 3)),
        ("form", "f8", (3, 6)),  # tensors of σ_n and of the swing at a climb's instants, the square of this
        ("jet", "f8", (3, 6)),  # value, first derivatives 1, 2, second ones 11, 22, 12 of each on the sphere
        ("bend", "f8", (3,)),  # h² times the second derivatives 11, 22, 12 of ln h
        ("corner", "f8", (MAX_TRIANGLES, 3, 6)),  # normal, h, T, A at the corners of triangles
        ("line", "f8"),  # angle of the longest chord in the last plane
        ("chord", "f8", (2,)),  # direction of a climb
        ("waiting", "f8", (64, 4)),  # intervals of lines: angle, width of the path, step, width at its end
    ]
)


@jit
def largest_principal(S, i):
    """Largest principal stress of instant i."""
    p = (S[0, i] + S[1, i] + S[2, i]) / 3.0
    a, b, c = S[0, i] - p, S[1, i] - p, S[2, i] - p
    yz, xz, xy = S[3, i], S[4, i], S[5, i]
    j2 = 0.5 * (a * a + b * b + c * c) + yz * yz + xz * xz + xy * xy
    if j2 <= 0.0:
        return p
    j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    cosine = 1.5 * sqrt(3.0 / j2) * j3 / j2
    return p + OF_J2 * sqrt(j2) * cos(acos(min(max(cosine, -1.0), 1.0)) / 3.0)


@jit
def climb_from_principal(G, S, m, Q):
    """Climb from the plane of the largest principal stress: tension may be confined to a narrow cone.

    The cofactors of σ - σ₁ are the products of the direction's components, times a factor.
    """
    i, top = G.instant, G.most[0]
    a, b, c, yz, xz, xy = S[0, i] - top, S[1, i] - top, S[2, i] - top, S[3, i], S[4, i], S[5, i]
    xx, yy, zz = b * c - yz * yz, a * c - xz * xz, a * b - xy * xy
    yz, xz, xy = xy * xz - a * yz, xy * yz - b * xz, xz * yz - c * xy
    x, y, z = xx, xy, xz
    if yy >= xx and yy >= zz:
        x, y, z = xy, yy, yz
    elif zz >= xx:
        x, y, z = xz, yz, zz
    size = sqrt(x * x + y * y + z * z)
    if size > 0.0:
        climb_from(G, S, m, Q, x / size, y / size, z / size)


@jit
def deviator(S, i, T):
    """J2 of instant i less a tensor T."""
    p, q, r = S[0, i] - T[0], S[1, i] - T[1], S[2, i] - T[2]
    normal = ((p - q) * (p - q) + (q - r) * (q - r) + (r - p) * (r - p)) / 6.0
    yz, xz, xy = S[3, i] - T[3], S[4, i] - T[4], S[5, i] - T[5]
    return normal + yz * yz + xz * xz + xy * xy


@jit
def strain_factor(Q):
    """Factor ν of tr σ in the normal strain; 0 of a shear stress."""
    return Q.poisson_ratio if Q.criterion == SWT else 0.0


@jit
def measure(G, S, m, Q):
    """Write what of the history bounds T and A, and their derivatives."""
    nu = strain_factor(Q)
    mid, zero = G.form[0], G.form[1]
    for c in range(6):
        low, high = S[c, 0], S[c, 0]
        for i in range(m):
            low, high = min(low, S[c, i]), max(high, S[c, i])
        mid[c], zero[c] = 0.5 * (low + high), 0.0
    stress, change, low, high, tension = 0.0, 0.0, 1e300, -1e300, -1e300
    for i in range(m):
        p = (S[0, i] + S[1, i] + S[2, i]) / 3.0
        S[6, i] = 3.0 * nu * p
        j2 = deviator(S, i, zero)
        stress, low, high = max(stress, j2), min(low, p), max(high, p)
        change = max(change, deviator(S, i, mid))
        if p + OF_J2 * sqrt(j2) > tension:
            principal = largest_principal(S, i)
            if principal > tension:
                tension, G.instant = principal, i
    stress, change = sqrt(stress), 2.0 * sqrt(change)
    G.noise = NOISE * (stress + max(abs(low), abs(high)))
    G.of_tension, G.of_swing = stress, change
    G.most[0], G.most[1] = tension, change
    if Q.criterion == SWT:
        G.of_swing = (1.0 + nu) * change
        G.most[1] = OF_J2 * G.of_swing + (1.0 - 2.0 * nu) * (high - low)


@jit_reordered
def tension_and_strain(S, m, x, y, z, of_stress):
    """T and A of the strain on a plane."""
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        s = a * S[0, i] + b * S[1, i] + c * S[2, i] + d * S[3, i] + e * S[4, i] + f * S[5, i]
        w = of_stress * s - S[6, i]
        top, high, low = max(top, s), max(high, w), min(low, w)
    return top, high - low


@jit_reordered
def project(S, m, x, y, z, row, p, q, r):
    """Write the shear stress on a plane along (p, q, r) into a row of S; returns the largest σ_n."""
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    g, h, k, u, v, w = x * p, y * q, z * r, y * r + z * q, x * r + z * p, x * q + y * p
    top = -1e300
    for i in range(m):
        xx, yy, zz, yz, xz, xy = S[0, i], S[1, i], S[2, i], S[3, i], S[4, i], S[5, i]
        S[row, i] = g * xx + h * yy + k * zz + u * yz + v * xz + w * xy
        top = max(top, a * xx + b * yy + c * zz + d * yz + e * xz + f * xy)
    return top


@jit_reordered
def width(S, m, C, D):
    """Extent of the path of the shear stress along the line (C, D)."""
    low, high = 1e300, -1e300
    for i in range(m):
        along = C * S[7, i] + D * S[8, i]
        low, high = min(low, along), max(high, along)
    return high - low


@jit
def set_tangents(G, x, y, z):
    """Write two unit vectors that are normal to n = (x, y, z) and to one another."""
    if abs(z) < 0.9:
        w = 1.0 / sqrt(x * x + y * y)
        p, q, r = -y * w, x * w, 0.0
    else:
        w = 1.0 / sqrt(y * y + z * z)
        p, q, r = 0.0, -z * w, y * w
    G.tangent[0, 0], G.tangent[0, 1], G.tangent[0, 2] = p, q, r
    G.tangent[1, 0], G.tangent[1, 1], G.tangent[1, 2] = y * r - z * q, z * p - x * r, x * q - y * p


@jit
def set_path(G, S, m, x, y, z):
    """Write the path of the shear stress on a plane; returns the largest σ_n."""
    set_tangents(G, x, y, z)
    for k in range(2):
        top = project(S, m, x, y, z, 7 + k, G.tangent[k, 0], G.tangent[k, 1], G.tangent[k, 2])
    return top


@jit
def widest(G, S, m):
    """Write the width of the path along evenly spaced lines; returns which is the largest."""
    best, step = 0, pi / LINES
    for k in range(LINES):
        G.waiting[k, 0], G.waiting[k, 2] = step * k, step
        G.waiting[k, 1] = width(S, m, cos(step * k), sin(step * k))
        if G.waiting[k, 1] > G.waiting[best, 1]:
            best = k
    for k in range(LINES):
        G.waiting[k, 3] = G.waiting[(k + 1) % LINES, 1]
    return best


@jit
def longest_chord(G, S, m, Q, T, tolerance):
    """Length of the longest chord of the path of the shear stress, from below and above.

    A chord's length is the largest width of the path over lines in the plane, whose second derivative is at
    least -1 times the width. Only where the criterion may exceed the limit do both agree to the tolerance.
    """
    k = widest(G, S, m)
    G.line, best = G.waiting[k, 0], G.waiting[k, 1]
    bound = BESIDE_LINES * best
    if lifted(Q, T, bound, G.noise) <= NEAR * G.limit:
        return best, bound
    depth = LINES
    while depth > 0:
        row = G.waiting[depth - 1]
        if above(row[1], row[3], bound * row[2] * row[2]) <= best * (1.0 + tolerance) or row[2] < 1e-6:
            depth -= 1
            continue
        angle = row[0] + 0.5 * row[2]
        f = width(S, m, cos(angle), sin(angle))
        if f > best:
            G.line, best = angle, f
        depth = halve_top(G.waiting, depth, f)
    return best, best * (1.0 + tolerance)


@jit
def look_at(G, S, m, Q, x, y, z, tolerance):
    """Write h, T and A of a plane, from above; returns h from below."""
    G.planes += 1
    if Q.criterion == SWT:
        T, A = tension_and_strain(S, m, x, y, z, 1.0 + Q.poisson_ratio)
        bound = A
    else:
        T = set_path(G, S, m, x, y, z)
        A, bound = longest_chord(G, S, m, Q, T, tolerance)
    G.seen[0], G.seen[1], G.seen[2] = lifted(Q, T, bound, G.noise), T, bound
    return lifted(Q, T, A, G.noise)


@jit
def consider(G, S, m, Q, x, y, z, tolerance):
    """Look at a plane, and climb from there if it is the highest so far."""
    h = look_at(G, S, m, Q, x, y, z, tolerance)
    if h > G.best * (1.0 + 1e-7):
        G.best, G.limit = h, max(h, G.limit)
        G.normal[0], G.normal[1], G.normal[2] = x, y, z
        climb_from(G, S, m, Q, x, y, z)


@jit
def climb_from(G, S, m, Q, x, y, z):
    """From a plane to a local maximum by turns: instants for the plane, plane for the instants."""
    n, best = G.trial, -1.0
    n[0], n[1], n[2] = x, y, z
    for _ in range(20):
        h = activate(G, S, m, Q)
        if h > best:
            G.kept[0], G.kept[1], G.kept[2] = n[0], n[1], n[2]
        if h <= best * (1.0 + 1e-10):
            best = max(best, h)
            break
        best = h
        ascend(G, Q)
    if best > G.best:
        G.best, G.limit = best, max(best, G.limit)
        G.normal[0], G.normal[1], G.normal[2] = G.kept[0], G.kept[1], G.kept[2]


@jit
def activate(G, S, m, Q):
    """Write the tensors of σ_n and of the swing at the instants that count on a climb's plane; returns h."""
    x, y, z = G.trial[0], G.trial[1], G.trial[2]
    i0, i1, i2 = 0, 0, 0
    if Q.criterion == SWT:
        of_stress, of_swing = 1.0 + Q.poisson_ratio, 1.0 + Q.poisson_ratio
        T, A = tension_and_strain(S, m, x, y, z, of_stress)
    else:
        of_stress, of_swing = 0.0, 1.0
        T = set_path(G, S, m, x, y, z)
        longest_chord(G, S, m, Q, T, CLIMBING)
        C, D, A = cos(G.line), sin(G.line), -1.0
        for _ in range(8):  # along a chord the path is no shorter than the chord
            j1, j2 = ends_along(S, m, C, D)
            p, q = S[7, j1] - S[7, j2], S[8, j1] - S[8, j2]
            length = sqrt(p * p + q * q)
            if length <= A:
                break
            A, i1, i2 = length, j1, j2
            C, D = p / length, q / length
        G.chord[0], G.chord[1] = C, D
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        s = a * S[0, i] + b * S[1, i] + c * S[2, i] + d * S[3, i] + e * S[4, i] + f * S[5, i]
        w = of_stress * s - S[6, i]
        if s > top:
            top, i0 = s, i
        if w > high and Q.criterion == SWT:
            high, i1 = w, i
        if w < low and Q.criterion == SWT:
            low, i2 = w, i
    turned = S[6, i1] - S[6, i2]
    for k in range(6):
        G.form[0, k] = S[k, i0]
        G.form[1, k] = of_swing * (S[k, i1] - S[k, i2]) - (turned if k < 3 else 0.0)
    return lifted(Q, T, A, G.noise)


@jit
def ends_along(S, m, C, D):
    """The instants at which the path of the shear stress is farthest along a line, one way and the other."""
    i1, i2, high, low = 0, 0, -1e300, 1e300
    for i in range(m):
        along = C * S[7, i] + D * S[8, i]
        if along > high:
            high, i1 = along, i
        if along < low:
            low, i2 = along, i
    return i1, i2


@jit
def bilinear(F, u, v):
    """uᵀ F v."""
    return (
        F[0] * u[0] * v[0]
        + F[1] * u[1] * v[1]
        + F[2] * u[2] * v[2]
        + F[3] * (u[1] * v[2] + u[2] * v[1])
        + F[4] * (u[0] * v[2] + u[2] * v[0])
        + F[5] * (u[0] * v[1] + u[1] * v[0])
    )


@jit
def set_jet(F, n, p, q, J):
    """Write nᵀ F n and its two derivatives along the great circles of p and q."""
    J[0], J[1], J[2] = bilinear(F, n, n), 2.0 * bilinear(F, n, p), 2.0 * bilinear(F, n, q)
    J[3], J[4] = 2.0 * (bilinear(F, p, p) - J[0]), 2.0 * (bilinear(F, q, q) - J[0])
    J[5] = 2.0 * bilinear(F, p, q)


@jit
def set_square(F, E):
    """Write the square of a tensor."""
    E[0] = F[0] * F[0] + F[5] * F[5] + F[4] * F[4]
    E[1] = F[5] * F[5] + F[1] * F[1] + F[3] * F[3]
    E[2] = F[4] * F[4] + F[3] * F[3] + F[2] * F[2]
    E[3] = F[5] * F[4] + F[1] * F[3] + F[3] * F[2]
    E[4] = F[0] * F[4] + F[5] * F[3] + F[4] * F[2]
    E[5] = F[0] * F[5] + F[5] * F[1] + F[4] * F[3]


@jit
def set_shear_jet(N, E):
    """Make the jet of |F n - n nᵀ F n| from the jets of nᵀ F n and nᵀ F² n, which replaces the first one."""
    square = max(E[0] - N[0] * N[0], 1e-24 * E[0] + 1e-300)
    a = sqrt(square)
    d1, d2 = 0.5 * (E[1] - 2.0 * N[0] * N[1]) / a, 0.5 * (E[2] - 2.0 * N[0] * N[2]) / a
    d11 = (0.5 * E[3] - N[1] * N[1] - N[0] * N[3] - d1 * d1) / a
    d22 = (0.5 * E[4] - N[2] * N[2] - N[0] * N[4] - d2 * d2) / a
    d12 = (0.5 * E[5] - N[1] * N[2] - N[0] * N[5] - d1 * d2) / a
    N[0], N[1], N[2], N[3], N[4], N[5] = a, d1, d2, d11, d22, d12


@jit
def ascend(G, Q):
    """Newton's method for ln h over the planes, from the climb's plane, with the instants as they are."""
    n, p, q, J, K = G.trial, G.tangent[0], G.tangent[1], G.jet[0], G.jet[1]
    for _ in range(8):
        set_tangents(G, n[0], n[1], n[2])
        set_jet(G.form[0], n, p, q, J)
        set_jet(G.form[1], n, p, q, K)
        if Q.criterion != SWT:
            set_square(G.form[1], G.form[2])
            set_jet(G.form[2], n, p, q, G.jet[2])
            set_shear_jet(K, G.jet[2])
        h = lifted(Q, J[0], K[0], G.noise)
        of_T, of_A, of_TT, of_TA, of_AA = partials(Q, J[0], K[0])
        g1, g2 = h * (of_T * J[1] + of_A * K[1]), h * (of_T * J[2] + of_A * K[2])
        for k in range(3):
            i, j = (2 if k == 1 else 1), (1 if k == 0 else 2)
            both = of_TT * J[i] * J[j] + of_TA * (J[i] * K[j] + J[j] * K[i]) + of_AA * K[i] * K[j]
            G.bend[k] = h * (both + of_T * J[3 + k] + of_A * K[3 + k])
            G.bend[k] -= (of_T * J[i] + of_A * K[i]) * (of_T * J[j] + of_A * K[j])
        h11, h22, h12 = G.bend[0], G.bend[1], G.bend[2]
        det = h11 * h22 - h12 * h12
        size = sqrt(g1 * g1 + g2 * g2)
        if h11 < 0.0 and det > 0.0:
            a, b = (g2 * h12 - g1 * h22) / det, (g1 * h12 - g2 * h11) / det
        elif size > 0.0:
            a, b = 0.2 * g1 / size, 0.2 * g2 / size
        else:
            return
        step = sqrt(a * a + b * b)
        if step > 0.3:
            a, b = 0.3 * a / step, 0.3 * b / step
        for c in range(3):
            n[c] += a * p[c] + b * q[c]
        shrink = 1.0 / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
        for c in range(3):
            n[c] *= shrink
        if step < 1e-6:
            return


@jit
def highest(f1, f2, f3, a, b, c, K):
    """Largest value in a triangle of a function whose second derivatives are at least -K.

    Parameters
    ----------
    f1, f2, f3
        Values at the corners.
    a, b, c
        Squares of the sides opposite to them.
    """
    top = max(above(f1, f2, K * c), above(f2, f3, K * a), above(f1, f3, K * b))
    along = 0.5 * (b + c - a)
    det = b * c - along * along
    if K <= 0.0 or det <= 0.0:
        return top
    # Within, the plane through the values plus K/2 (r² - |x|²) has its maximum at x = u (2-1) + v (3-1).
    r, s = (f2 - f1) / K + 0.5 * c, (f3 - f1) / K + 0.5 * b
    u, v = (r * b - s * along) / det, (s * c - r * along) / det
    if u > 0.0 and v > 0.0 and u + v < 1.0:
        top = max(top, f1 + 0.5 * K * (u * r + v * s))
    return top


@jit
def bound_in(G, Q, k, limit):
    """Bound of h in triangle k, or anything below the limit; and the first corner of its longest side."""
    v = G.corner
    a, b, c = 0.0, 0.0, 0.0
    for e in range(3):
        a += (v[k, 1, e] - v[k, 2, e]) * (v[k, 1, e] - v[k, 2, e])
        b += (v[k, 2, e] - v[k, 0, e]) * (v[k, 2, e] - v[k, 0, e])
        c += (v[k, 0, e] - v[k, 1, e]) * (v[k, 0, e] - v[k, 1, e])
    longest = 1 if a >= b and a >= c else 2 if b >= c else 0
    # On the flat triangle, which no point leaves by more than the radius, arcs are seen longer.
    near = 1.0 - 0.36 * max(a, b, c)
    flat = 4.0 * (1.0 / near + 0.6 * sqrt(max(a, b, c)) / (near * sqrt(near)))
    T = min(highest(v[k, 0, 4], v[k, 1, 4], v[k, 2, 4], a, b, c, flat * G.of_tension), G.most[0])
    A = min(highest(v[k, 0, 5], v[k, 1, 5], v[k, 2, 5], a, b, c, flat * G.of_swing), G.most[1])
    bound = lifted(Q, T, A, G.noise)
    if bound > limit:
        slope = slope_bound(G.of_tension, G.most[0])
        K = flat * curvature_bound(Q, T, A, G.of_tension, G.of_swing, slope)
        bound = min(bound, highest(v[k, 0, 3], v[k, 1, 3], v[k, 2, 3], a, b, c, K))
    return bound, longest


@jit
def cut_triangle(G, S, m, Q, k, longest, at, tolerance):
    """Halve the longest side of triangle k; the halves become triangles `at` and `at` + 1."""
    v, i, j = G.corner, longest, (longest + 1) % 3
    x, y, z = v[k, i, 0] + v[k, j, 0], v[k, i, 1] + v[k, j, 1], v[k, i, 2] + v[k, j, 2]
    shrink = 1.0 / sqrt(x * x + y * y + z * z)
    x, y, z = shrink * x, shrink * y, shrink * z
    consider(G, S, m, Q, x, y, z, tolerance)
    for c in range(3):
        for e in range(6):
            value = v[k, c, e]
            v[at, c, e], v[at + 1, c, e] = value, value
    for half in range(2):
        corner = v[at + half, j if half == 0 else i]
        corner[0], corner[1], corner[2] = x, y, z
        for e in range(3):
            corner[3 + e] = G.seen[e]


@jit
def first_triangles(G, S, m, Q, tolerance):
    """Look at the planes normal to the axes, corners of a quarter each of the upper half of all normals."""
    for axis in range(3):
        x, y, z = 1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0
        consider(G, S, m, Q, x, y, z, tolerance)
        for k in range(4):
            corner = G.corner[k, axis]
            corner[0], corner[1], corner[2] = x, y, z
            if (axis == 0 and k & 1) or (axis == 1 and k & 2):
                corner[axis] = -1.0
            for e in range(3):
                corner[3 + e] = G.seen[e]


@jit
def highest_plane(G, S, m, Q, floor, tolerance):
    """Largest h over all planes, to a tolerance. Below the floor it may be low.

    Parameters
    ----------
    G
        Record of `PLANES`. Its normal is a first guess, or 0, and the plane's normal afterwards.
    S, m
        Array of `ROWS` rows: the six components at m instants, and room.
    Q
        The criterion.
    floor
        The least value of interest, as h (`swtstudy.kernel.criterion.lift`).
    tolerance
        Relative, of h.
    """
    measure(G, S, m, Q)
    G.best, G.limit, G.planes, G.unsettled = 0.0, floor, 0, 0
    if Q.criterion == SWT and G.most[0] <= NO_TENSION * G.of_tension:
        return 0.0
    x, y, z = G.normal[0], G.normal[1], G.normal[2]
    if x != 0.0 or y != 0.0 or z != 0.0:
        climb_from(G, S, m, Q, x, y, z)
    if G.best == 0.0:
        climb_from_principal(G, S, m, Q)
    slack = NEXT_TO_NOTHING * tolerance * lifted(Q, G.most[0], G.most[1], 0.0)
    first_triangles(G, S, m, Q, 0.25 * tolerance)
    done, count = 0, 4
    while count > done:
        k = done
        if done < IN_ORDER:
            done += 1
        else:
            count -= 1
            k = count
        limit = G.limit * (1.0 + tolerance) + slack
        bound, longest = bound_in(G, Q, k, limit)
        if bound <= limit:
            continue
        if count + 2 > MAX_TRIANGLES or G.planes > MOST_PLANES:
            G.unsettled = 1
            continue
        cut_triangle(G, S, m, Q, k, longest, count, 0.25 * tolerance)
        count += 2
    return G.best


@jit
def highest_planes(G, S, histories, Q, tolerance, values, normals):
    """Write the criterion and the normal of its plane for each of some histories, (n, m, 6).

    Returns for how many the search ended before its bound was met.
    """
    m, unsettled = histories.shape[1], 0
    for j in range(histories.shape[0]):
        for i in range(m):
            for c in range(6):
                S[c, i] = histories[j, i, c]
        G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
        values[j] = value_of(Q, highest_plane(G, S, m, Q, 0.0, tolerance))
        unsettled += G.unsettled
        for c in range(3):
            normals[j, c] = G.normal[c]
    return unsettled


def planes_of(histories, Q, tolerance):
    """Critical planes of histories.

    Parameters
    ----------
    histories
        Shape (n, m, 6).
    Q
        Record of `swtstudy.kernel.line.ASK`.
    tolerance
        Relative, of h.

    Returns
    -------
    values, normals, unsettled
        The criterion, (n,); unit normals, (n, 3), 0 where the criterion is 0; and for how many histories the
        search ended before its bound was met.
    """
    n, m = histories.shape[:2]
    values, normals = np.empty(n), np.empty((n, 3))
    histories = np.ascontiguousarray(histories, dtype=float)
    room = new_record(PLANES), np.zeros((ROWS, m))
    unsettled = highest_planes(*room, histories, Q, float(tolerance), values, normals)
    return values, normals, int(unsettled)
