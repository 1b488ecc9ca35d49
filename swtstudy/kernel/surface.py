"""Stress functionals of a density over s at one position x of the surface line, as running integrals.

Springs inside x act on the in-plane stress by

    T1 = ∫ 2(ξ/x) dG/√(x²-ξ²),   T3 = ∫ 2(ξ/x)³ dG/√(x²-ξ²),

springs outside x on the tractions there, and all springs on the load within x, by

    B = ∫ dG/√(ξ²-x²),   V = ∫ (ξ - √(ξ²-x²)) dG/x²  (inside x: ∫ ξ dG/x²).

With X² = x² - b², s = X sin α inside and s = X cosh η outside remove the singularities; where x < b, all
springs are outside, and s = √(b²-x²) sinh η does.
"""

from math import asin, cosh, log, sin, sinh, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import GAUSS, ORDER, RUN, clenshaw, panel_of
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.contact import MAX_PIECES

MAX_TABLES = 17003
TABLE = np.dtype(
    [
        ("begin", "f8", (MAX_TABLES,)),  # s at the lower ends of the panels, split at x
        ("angle", "f8", (MAX_TABLES, 2)),  # α or η at both ends
        ("inside", "i8", (MAX_TABLES,)),
        ("before", "f8", (MAX_TABLES, 2)),  # T1, T3 or B, V at the lower end
        ("series", "f8", (MAX_TABLES, 2, ORDER + 1)),
        ("first", "i8", (MAX_PIECES + 1,)),  # panels of a density: 0 the profile, 1 + i what grew as piece i
        ("last", "i8", (MAX_PIECES + 1,)),
        ("total", "f8", (MAX_PIECES + 1, 2)),  # T1, T3 of all that is inside x
    ]
)
#: A smaller X/x is the edge of the face: there all springs count as outside.
AT_FACE = 1e-9


@jit
def acosh(c):
    """Inverse of cosh, 0 below 1."""
    return log(c + sqrt(max(c * c - 1.0, 0.0)))


@jit
def asinh(c):
    """Inverse of sinh."""
    return log(c + sqrt(c * c + 1.0))


@jit
def scale_at(x, b):
    """X, and 1 where all springs are outside x."""
    X2 = x * x - b * b
    X = sqrt(abs(X2))
    if X2 <= 0.0 or AT_FACE * max(x, b) > X:
        return max(X, AT_FACE), 1
    return X, 0


@jit
def tabulate(K, row, k, begin, end, density, p0, p1, top, b, x):
    """Tabulate panels p0 to p1 of a density up to s = top, from table k on; returns the next free table."""
    X, all_outside = scale_at(x, b)
    K.first[row] = k
    t1, t3, b1, v1 = 0.0, 0.0, 0.0, 0.0
    f, h = np.empty(ORDER), np.empty(ORDER)
    for p in range(p0, p1):
        if begin[p] >= top or k + 2 >= MAX_TABLES:
            break
        width = 2.0 / (end[p] - begin[p])
        for inside in (1, 0):
            if inside:
                if all_outside or begin[p] >= X:
                    continue
                K.begin[k] = begin[p]
                z0, z1 = asin(begin[p] / X), asin(min(end[p], X) / X)
            else:
                if end[p] <= X and not all_outside:
                    continue
                K.begin[k] = begin[p] if all_outside else max(begin[p], X)
                if all_outside:
                    z0, z1 = asinh(begin[p] / X), asinh(end[p] / X)
                else:
                    z0, z1 = acosh(K.begin[k] / X), acosh(end[p] / X)
            K.angle[k, 0], K.angle[k, 1], K.inside[k] = z0, z1, inside
            half = 0.5 * (z1 - z0)
            for i in range(ORDER):
                z = z0 + half * (GAUSS[i] + 1.0)
                if inside:
                    s = X * sin(z)
                    share = (b * b + s * s) / (x * x)
                    f[i] = 2.0 * sqrt(share) * half * clenshaw(density[p], (s - begin[p]) * width - 1.0)
                    h[i] = share * f[i]
                else:
                    s = X * (sinh(z) if all_outside else cosh(z))
                    root = X * (cosh(z) if all_outside else sinh(z))
                    f[i] = half * clenshaw(density[p], (s - begin[p]) * width - 1.0)
                    h[i] = f[i] * root / (sqrt(b * b + s * s) + root)
            F, H = K.series[k, 0], K.series[k, 1]
            for c in range(ORDER + 1):
                F[c] = f[0] * RUN[0, c]
                H[c] = h[0] * RUN[0, c]
            for i in range(1, ORDER):
                for c in range(ORDER + 1):
                    F[c] += f[i] * RUN[i, c]
                    H[c] += h[i] * RUN[i, c]
            of_f, of_h = 0.0, 0.0
            for c in range(ORDER + 1):
                of_f += F[c]
                of_h += H[c]
            if inside:
                K.before[k, 0], K.before[k, 1] = t1, t3
                t1 += of_f
                t3 += of_h
            else:
                K.before[k, 0], K.before[k, 1] = b1, v1
                b1 += of_f
                v1 += of_h
            k += 1
    K.last[row] = k
    K.total[row, 0], K.total[row, 1] = t1, t3
    return k


@jit
def running(K, row, s, X, all_outside):
    """T1, T3, B and the part of V outside x, of a density up to s."""
    first, last = K.first[row], K.last[row]
    if first == last or s <= K.begin[first]:
        return 0.0, 0.0, 0.0, 0.0
    k = panel_of(K.begin, first, last, s)
    if K.inside[k]:
        z = asin(min(s / X, 1.0))
    elif all_outside:
        z = asinh(s / X)
    else:
        z = acosh(s / X)
    y = min(2.0 * (z - K.angle[k, 0]) / (K.angle[k, 1] - K.angle[k, 0]) - 1.0, 1.0)
    of_f = K.before[k, 0] + clenshaw(K.series[k, 0], y)
    of_h = K.before[k, 1] + clenshaw(K.series[k, 1], y)
    if K.inside[k]:
        return of_f, of_h, 0.0, 0.0
    return K.total[row, 0], K.total[row, 1], of_f, of_h


@jit
def hertz(s, x):
    """T1, T3, B and the part of V outside x, of the paraboloid up to s, in closed form (Hamilton)."""
    if s >= x:
        w = sqrt(s * s - x * x)
        return np.pi * x, 0.75 * np.pi * x, 2.0 * w, 2.0 / 3.0 * ((s * s + s * w + w * w) / (s + w) - x)
    y = s / x
    c = sqrt(1.0 - y * y)
    f = asin(y)
    sc = y * c
    return 2.0 * x * (f - sc), 4.0 * x * (0.375 * f - 0.5 * sc + 0.125 * sc * (1.0 - 2.0 * y * y)), 0.0, 0.0
