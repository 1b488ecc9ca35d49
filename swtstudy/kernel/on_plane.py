"""A stress history on one plane: tension T, and range A of the swing of the normal or of the shear stress.

On the plane with the normal n the tension is T = max σ_n. The range of the swing is A = max w - min w of the
normal strain w = (1+ν) σ_n - ν tr σ, or the longest chord of the path of the shear stress vector.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.compiled import jit, jit_reordered, larger, smaller
from swtstudy.kernel.criterion import lifted
from swtstudy.kernel.planes import above, halve_top

#: Lines in a plane along which a chord is looked for at first; it may be longer than along these.
LINES = np.int64(8)
BESIDE_LINES = 1.0 / np.cos(0.5 * np.pi / LINES)
#: Planes whose value is below this share of the best are not looked at more closely.
NEAR = 0.9


@jit_reordered
def tension_and_strain(stresses, m, x, y, z, of_stress):
    """T and A of the strain on a plane."""
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        s = a * stresses[0, i] + b * stresses[1, i] + c * stresses[2, i]
        s += d * stresses[3, i] + e * stresses[4, i] + f * stresses[5, i]
        w = of_stress * s - stresses[6, i]
        top, high, low = larger(top, s), larger(high, w), smaller(low, w)
    return top, high - low


@jit
def set_tangents(planes, x, y, z):
    """Write two unit vectors that are normal to n = (x, y, z) and to one another."""
    if abs(z) < 0.9:
        w = 1.0 / sqrt(x * x + y * y)
        p, q, r = -y * w, x * w, 0.0
    else:
        w = 1.0 / sqrt(y * y + z * z)
        p, q, r = 0.0, -z * w, y * w
    planes.tangent[0, 0], planes.tangent[0, 1], planes.tangent[0, 2] = p, q, r
    other = planes.tangent[1]
    other[0], other[1], other[2] = y * r - z * q, z * p - x * r, x * q - y * p


@jit_reordered
def project(stresses, m, x, y, z, row, p, q, r):
    """Write the shear stress on a plane along (p, q, r) into a row of stresses; returns the largest σ_n."""
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    g, h, k, u, v, w = x * p, y * q, z * r, y * r + z * q, x * r + z * p, x * q + y * p
    top = -1e300
    for i in range(m):
        xx, yy, zz = stresses[0, i], stresses[1, i], stresses[2, i]
        yz, xz, xy = stresses[3, i], stresses[4, i], stresses[5, i]
        stresses[row, i] = g * xx + h * yy + k * zz + u * yz + v * xz + w * xy
        top = max(top, a * xx + b * yy + c * zz + d * yz + e * xz + f * xy)
    return top


@jit
def set_path(planes, stresses, m, x, y, z):
    """Write the path of the shear stress on a plane; returns the largest σ_n."""
    set_tangents(planes, x, y, z)
    for k in range(2):
        along = planes.tangent[k]
        top = project(stresses, m, x, y, z, 7 + k, along[0], along[1], along[2])
    return top


@jit_reordered
def width(stresses, m, C, D):
    """Extent of the path of the shear stress along the line (C, D)."""
    low, high = 1e300, -1e300
    for i in range(m):
        along = C * stresses[7, i] + D * stresses[8, i]
        low, high = smaller(low, along), larger(high, along)
    return high - low


@jit
def widest(planes, stresses, m):
    """Write the width of the path along evenly spaced lines; returns which is the largest."""
    best, step = 0, pi / LINES
    for k in range(LINES):
        planes.waiting[k, 0], planes.waiting[k, 2] = step * k, step
        planes.waiting[k, 1] = width(stresses, m, cos(step * k), sin(step * k))
        if planes.waiting[k, 1] > planes.waiting[best, 1]:
            best = k
    for k in range(LINES):
        planes.waiting[k, 3] = planes.waiting[(k + 1) % LINES, 1]
    return best


@jit
def longest_chord(planes, stresses, m, ask, T, tolerance):
    """Length of the longest chord of the path of the shear stress, from below and above.

    A chord's length is the largest width of the path over lines in the plane, whose second derivative is at
    least -1 times the width. Only where the criterion may exceed the limit do both agree to the tolerance.
    """
    k = widest(planes, stresses, m)
    planes.line, best = planes.waiting[k, 0], planes.waiting[k, 1]
    bound = BESIDE_LINES * best
    if lifted(ask, T, bound, planes.noise) <= NEAR * planes.limit:
        return best, bound
    depth = LINES
    while depth > 0:
        row = planes.waiting[depth - 1]
        if above(row[1], row[3], bound * row[2] * row[2]) <= best * (1.0 + tolerance) or row[2] < 1e-6:
            depth -= 1
            continue
        angle = row[0] + 0.5 * row[2]
        f = width(stresses, m, cos(angle), sin(angle))
        if f > best:
            planes.line, best = angle, f
        depth = halve_top(planes.waiting, depth, f)
    return best, best * (1.0 + tolerance)


@jit
def ends_along(stresses, m, C, D):
    """The instants at which the path of the shear stress is farthest along a line, one way and the other."""
    i1, i2, high, low = 0, 0, -1e300, 1e300
    for i in range(m):
        along = C * stresses[7, i] + D * stresses[8, i]
        if along > high:
            high, i1 = along, i
        if along < low:
            low, i2 = along, i
    return i1, i2
