"""Climbing over planes of every orientation: instants for the plane, plane for the instants, by turns."""

from math import acos, atan2, cos, sin, sqrt

import numpy as np

from swtstudy.kernel.compiled import jit
from swtstudy.kernel.criterion import SWT, lifted, partials
from swtstudy.kernel.on_plane import ends_along, longest_chord, set_path, set_tangents, tension_and_strain

#: Tolerance of chords while climbing.
CLIMBING = 1e-4
#: Share of the curvature below which it is rounding.
FLAT = 1e-9
#: Largest principal value of a deviator over √J2.
OF_J2 = 2.0 / np.sqrt(3.0)


@jit
def largest_principal(stresses, i):
    """Largest principal stress of instant i."""
    p = (stresses[0, i] + stresses[1, i] + stresses[2, i]) / 3.0
    a, b, c = stresses[0, i] - p, stresses[1, i] - p, stresses[2, i] - p
    yz, xz, xy = stresses[3, i], stresses[4, i], stresses[5, i]
    j2 = 0.5 * (a * a + b * b + c * c) + yz * yz + xz * xz + xy * xy
    if j2 <= 0.0:
        return p
    j3 = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)
    cosine = 1.5 * sqrt(3.0 / j2) * j3 / j2
    return p + OF_J2 * sqrt(j2) * cos(acos(min(max(cosine, -1.0), 1.0)) / 3.0)


@jit
def climb_from_principal(planes, stresses, m, ask):
    """Climb from the plane of the largest principal stress: tension may be confined to a narrow cone.

    The cofactors of σ - σ₁ are the products of the direction's components, times a factor.
    """
    i, top = planes.instant, planes.most[0]
    a, b, c = stresses[0, i] - top, stresses[1, i] - top, stresses[2, i] - top
    yz, xz, xy = stresses[3, i], stresses[4, i], stresses[5, i]
    xx, yy, zz = b * c - yz * yz, a * c - xz * xz, a * b - xy * xy
    yz, xz, xy = xy * xz - a * yz, xy * yz - b * xz, xz * yz - c * xy
    x, y, z = xx, xy, xz
    if yy >= xx and yy >= zz:
        x, y, z = xy, yy, yz
    elif zz >= xx:
        x, y, z = xz, yz, zz
    size = sqrt(x * x + y * y + z * z)
    if size > 0.0:
        climb_from(planes, stresses, m, ask, x / size, y / size, z / size)


@jit
def climb_from(planes, stresses, m, ask, x, y, z):
    """From a plane to a local maximum by turns: instants for the plane, plane for the instants."""
    n, best = planes.trial, -1.0
    n[0], n[1], n[2] = x, y, z
    for _ in range(20):
        h = activate(planes, stresses, m, ask)
        if h > best:
            planes.kept[0], planes.kept[1], planes.kept[2] = n[0], n[1], n[2]
        if h <= best * (1.0 + 1e-10):
            best = max(best, h)
            break
        best = h
        ascend(planes, ask)
    if best > planes.best:
        planes.best, planes.limit = best, max(best, planes.limit)
        planes.normal[0], planes.normal[1], planes.normal[2] = planes.kept[0], planes.kept[1], planes.kept[2]


@jit
def activate(planes, stresses, m, ask):
    """Write the tensors of σ_n and of the swing at the instants that count on a climb's plane; returns h."""
    x, y, z = planes.trial[0], planes.trial[1], planes.trial[2]
    i0, i1, i2 = 0, 0, 0
    if ask.criterion == SWT:
        of_stress, of_swing = 1.0 + ask.poisson_ratio, 1.0 + ask.poisson_ratio
        T, A = tension_and_strain(stresses, m, x, y, z, of_stress)
    else:
        of_stress, of_swing = 0.0, 1.0
        T = set_path(planes, stresses, m, x, y, z)
        longest_chord(planes, stresses, m, ask, T, CLIMBING)
        C, D, A = cos(planes.line), sin(planes.line), -1.0
        for _ in range(8):  # along a chord the path is no shorter than the chord
            j1, j2 = ends_along(stresses, m, C, D)
            p, q = stresses[7, j1] - stresses[7, j2], stresses[8, j1] - stresses[8, j2]
            length = sqrt(p * p + q * q)
            if length <= A:
                break
            A, i1, i2 = length, j1, j2
            C, D = p / length, q / length
        planes.chord[0], planes.chord[1] = C, D
    a, b, c, d, e, f = x * x, y * y, z * z, 2.0 * y * z, 2.0 * x * z, 2.0 * x * y
    top, high, low = -1e300, -1e300, 1e300
    for i in range(m):
        s = a * stresses[0, i] + b * stresses[1, i] + c * stresses[2, i]
        s += d * stresses[3, i] + e * stresses[4, i] + f * stresses[5, i]
        w = of_stress * s - stresses[6, i]
        if s > top:
            top, i0 = s, i
        if w > high and ask.criterion == SWT:
            high, i1 = w, i
        if w < low and ask.criterion == SWT:
            low, i2 = w, i
    turned = stresses[6, i1] - stresses[6, i2]
    for k in range(6):
        planes.form[0, k] = stresses[k, i0]
        planes.form[1, k] = of_swing * (stresses[k, i1] - stresses[k, i2]) - (turned if k < 3 else 0.0)
    return lifted(ask, T, A, planes.noise)


@jit
def ascend(planes, ask):
    """Newton's method for ln h over the planes, from the climb's plane, with the instants as they are."""
    n, p, q, J, K = planes.trial, planes.tangent[0], planes.tangent[1], planes.jet[0], planes.jet[1]
    for _ in range(8):
        set_tangents(planes, n[0], n[1], n[2])
        set_jet(planes.form[0], n, p, q, J)
        set_jet(planes.form[1], n, p, q, K)
        if ask.criterion != SWT:
            set_square(planes.form[1], planes.form[2])
            set_jet(planes.form[2], n, p, q, planes.jet[2])
            set_shear_jet(K, planes.jet[2])
        h = lifted(ask, J[0], K[0], planes.noise)
        of_T, of_A, of_TT, of_TA, of_AA = partials(ask, J[0], K[0])
        g1, g2 = h * (of_T * J[1] + of_A * K[1]), h * (of_T * J[2] + of_A * K[2])
        for k in range(3):
            i, j = (2 if k == 1 else 1), (1 if k == 0 else 2)
            both = of_TT * J[i] * J[j] + of_TA * (J[i] * K[j] + J[j] * K[i]) + of_AA * K[i] * K[j]
            planes.bend[k] = h * (both + of_T * J[3 + k] + of_A * K[3 + k])
            planes.bend[k] -= (of_T * J[i] + of_A * K[i]) * (of_T * J[j] + of_A * K[j])
        a, b = uphill(g1, g2, planes.bend[0], planes.bend[1], planes.bend[2])
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
def uphill(g1, g2, h11, h22, h12):
    """A step towards a maximum from the slopes there: Newton's along the axes of the curvature that fall off.

    Along the others it is a share of the slope's direction. Planes around an axis of symmetry are all alike:
    there is no curvature along that ring.
    """
    size = sqrt(g1 * g1 + g2 * g2)
    if size == 0.0:
        return 0.0, 0.0
    mean, half = 0.5 * (h11 + h22), 0.5 * (h11 - h22)
    radius = sqrt(half * half + h12 * h12)
    turn = 0.5 * atan2(h12, half)
    C, S = cos(turn), sin(turn)
    flat = FLAT * (abs(mean) + radius)
    one, other = C * g1 + S * g2, C * g2 - S * g1
    along = -one / (mean + radius) if mean + radius < -flat else 0.2 * one / size
    across = -other / (mean - radius) if mean - radius < -flat else 0.2 * other / size
    return C * along - S * across, S * along + C * across


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
