"""Stress functionals of a density over s at one position x of the surface line, as running integrals.

Springs inside x act on the in-plane stress by

    T1 = ∫ 2(ξ/x) dG/√(x²-ξ²),   T3 = ∫ 2(ξ/x)³ dG/√(x²-ξ²),

springs outside x on the tractions there, and all springs on the load within x, by

    B = ∫ dG/√(ξ²-x²),   V = ∫ (ξ - √(ξ²-x²)) dG/x²  (inside x: ∫ ξ dG/x²).

In a plane contact a strip has T1 = ∫ 2 dN/√(x²-ξ²) inside x instead of T1 and T3, and B with N for G.

With X² = x² - b², s = X sin α inside and s = X cosh η outside remove the singularities; where x < b, all
springs are outside, and s = √(b²-x²) sinh η does.
"""

from math import asin, ceil, cosh, log, sin, sinh, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import GAUSS, ORDER, RUN, clenshaw, panel_of
from swtstudy.kernel.compiled import fields, jit, jit_reordered
from swtstudy.kernel.contact import MAX_PIECES

MAX_TABLES = 17003
TABLE = np.dtype(
    [
        ("begin", "f8", (MAX_TABLES,)),  # s at the lower ends of the panels, split at x
        ("angle", "f8", (MAX_TABLES, 2)),  # α or η at both ends
        ("inside", "i8", (MAX_TABLES,)),
        ("before", "f8", (MAX_TABLES, 2)),  # T1, T3 or B, V at the lower end
        ("series", "f8", (MAX_TABLES, 2, ORDER + 1)),
        *fields("i8", "first last", (MAX_PIECES + 1,)),  # panels of a density: 0 the profile, 1 + i piece i
        ("total", "f8", (MAX_PIECES + 1, 2)),  # T1, T3 of all that is inside x
        ("density", "f8", (2, ORDER)),  # of a table's two integrals, at its Gauss points
    ]
)
#: Largest ratio of the ends of a table outside of x: its variable is as the logarithm of s there.
SPAN = 8.0
#: Longest table inside of x in its angle α: a series of ORDER terms misses 1e-8 of the density times sin α.
LONGEST = 0.8


@jit
def acosh(c):
    """Inverse of cosh, 0 below 1."""
    return log(c + sqrt(max(c * c - 1.0, 0.0)))


@jit
def asinh(c):
    """Inverse of sinh."""
    return log(c + sqrt(c * c + 1.0))


@jit
def inside_end(low, end, X):
    """Where the table from `low` on ends, `end` at most: in equal steps of α, none longer than `LONGEST`."""
    first, last = asin(low / X), asin(end / X)
    tables = ceil((last - first) / LONGEST)
    return end if tables <= 1 else X * sin(first + (last - first) / tables)


@jit
def tabulate(table, row, k, begin, end, density, p0, p1, top, b, x, X, all_outside, plane):
    """Tabulate panels p0 to p1 of a density up to s = top, from table k on; returns the next free table."""
    table.first[row] = k
    table.total[row, 0], table.total[row, 1] = 0.0, 0.0
    sums, inner = np.zeros(4), 0.0 if all_outside else X
    for p in range(p0, p1):
        if begin[p] >= top or k + 2 >= MAX_TABLES:
            break
        low, last = begin[p], min(end[p], inner)
        while low < last and k + 1 < MAX_TABLES:
            high = inside_end(low, last, X)
            tabulate_panel(
                table, k, density[p], begin[p], end[p], low, high, b, x, X, 1, all_outside, plane, sums
            )
            k += 1
            low = high
        while low < end[p] and k + 1 < MAX_TABLES:
            high = min(end[p], SPAN * max(low, X))
            if high > 0.9 * end[p]:
                high = end[p]
            tabulate_panel(
                table, k, density[p], begin[p], end[p], low, high, b, x, X, 0, all_outside, plane, sums
            )
            k += 1
            low = high
    table.last[row] = k
    table.total[row, 0], table.total[row, 1] = sums[0], sums[1]
    return k


@jit_reordered
def tabulate_panel(table, k, density, begin, end, low, high, b, x, X, inside, all_outside, plane, sums):
    """Table k: running integrals of the panel's density from low to high, added to the sums up to there."""
    f, h = table.density[0], table.density[1]
    table.begin[k] = low
    if inside:
        z0, z1 = asin(low / X), asin(high / X)
    elif all_outside:
        z0, z1 = asinh(low / X), asinh(high / X)
    else:
        z0, z1 = acosh(low / X), acosh(high / X)
    table.angle[k, 0], table.angle[k, 1], table.inside[k] = z0, z1, inside
    half, width = 0.5 * (z1 - z0), 2.0 / (end - begin)
    for i in range(ORDER):
        z = z0 + half * (GAUSS[i] + 1.0)
        if inside:
            s = X * sin(z)
            share = (b * b + s * s) / (x * x)
            f[i] = 2.0 * half * clenshaw(density, (s - begin) * width - 1.0)
            if plane == 0:
                f[i] *= sqrt(share)
            h[i] = share * f[i]
        else:
            s = X * (sinh(z) if all_outside else cosh(z))
            root = X * (cosh(z) if all_outside else sinh(z))
            f[i] = half * clenshaw(density, (s - begin) * width - 1.0)
            h[i] = f[i] * root / (sqrt(b * b + s * s) + root)
    first = 0 if inside else 2
    table.before[k, 0], table.before[k, 1] = sums[first], sums[first + 1]
    for c in range(ORDER + 1):
        of_f, of_h = 0.0, 0.0
        for i in range(ORDER):
            of_f += f[i] * RUN[c, i]
            of_h += h[i] * RUN[c, i]
        table.series[k, 0, c], table.series[k, 1, c] = of_f, of_h
        sums[first] += of_f
        sums[first + 1] += of_h


@jit
def running(table, row, s, X, all_outside):
    """T1, T3, B and the part of V outside x, of a density up to s."""
    first, last = table.first[row], table.last[row]
    if first == last or s <= table.begin[first]:
        return 0.0, 0.0, 0.0, 0.0
    k = panel_of(table.begin, first, last, s)
    if table.inside[k]:
        z = asin(min(s / X, 1.0))
    elif all_outside:
        z = asinh(s / X)
    else:
        z = acosh(s / X)
    y = min(2.0 * (z - table.angle[k, 0]) / (table.angle[k, 1] - table.angle[k, 0]) - 1.0, 1.0)
    of_f = table.before[k, 0] + clenshaw(table.series[k, 0], y)
    of_h = table.before[k, 1] + clenshaw(table.series[k, 1], y)
    if table.inside[k]:
        return of_f, of_h, 0.0, 0.0
    return table.total[row, 0], table.total[row, 1], of_f, of_h


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


@jit
def strip_hertz(s, x):
    """T1 and B of the cylinder up to s, in closed form (McEwen), where `hertz` has its own."""
    if s >= x:
        return np.pi * x, 0.0, 0.5 * np.pi * sqrt((s - x) * (s + x)), 0.0
    return np.pi * s * s / (x + sqrt((x - s) * (x + s))), 0.0, 0.0, 0.0
