"""The stress beneath one rigid punch, a disc or a strip of radius ξ, pressed or dragged, in closed form.

The punch carries the traction 1/√(ξ² - r²) on r < ξ, as a pressure or as a shear in +x (13), (14). With the
complex depth ζ = z + iξ the potential of a point load becomes that of a disc: every stress is the imaginary
part of a function of R = √(r² + ζ²) and L = 1/(R + ζ). All components are sums of ten of them,

    1/R, L/R, L²/R, L³/R, L, L², z/R³, zζ/R³, zD, zB,    D = L²/R² + L/R³,  B = 2L³/R² + L²/R³,

with factors in x, y, z and ν that do not depend on ξ. A strip has w = |x| + iz and I = 1/√(w² - ξ²), ~ 1/w
far away; four functions make its field: Re I, Im I, z Re I′ and z Im I′. The same sums serve one punch and,
with the functions integrated over ξ with a density, many. Nothing divides by r or z: axis and surface are
ordinary places.

The density of Hertz's contacts is proportional to ξ, and its integrals are closed forms. With U = R + ζ one
has dζ/R = dU/U, so that with η = iξ, I[n, m] = ∫ ηⁿ Lᵐ/R dζ and J[n, m] = ∫ ηⁿ Lᵐ dζ follow by parts:

    I[0, 0] = ln U,   I[0, m] = -Lᵐ/m,   I[1, 0] = R - z ln U,
    I[1, m] = (-η Lᵐ + I[0, m-1] - z I[0, m])/(m + 1),
    J[1, m] = (η² Lᵐ + m (I[1, m-1] - z I[1, m]))/(m + 2),

and the functions with 1/R³ are derivatives: 1/R³ = -(L/R)′, ζ/R³ = -(1/R)′, D = -(L²/R)′, B = -(L³/R)′.
"""

from math import atan2, log, pi, sqrt

import numpy as np

from swtstudy.kernel.compiled import jit

#: Functions of a disc; a strip has the first four places.
FUNCTIONS = 10
#: Components of the stress, in this order.
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
#: Smaller squares lie at the edge of the punch itself.
TINY = 1e-300


@jit
def upper_root(a, b):
    """Both parts, which are not negative, of √(a + ib) with b ≥ 0."""
    m = sqrt(a * a + b * b)
    if a >= 0.0:
        p = sqrt(0.5 * (m + a))
        return p, 0.5 * b / p if p > 0.0 else 0.0
    q = sqrt(0.5 * (m - a))
    return 0.5 * b / q, q


@jit
def disc(r, z, xi, f):
    """Write the ten functions of a disc of radius ξ."""
    p, q = upper_root((r - xi) * (r + xi) + z * z, 2.0 * z * xi)
    m = 1.0 / max(p * p + q * q, TINY)
    over = complex(p * m, -q * m)
    p += z
    q += xi
    m = 1.0 / max(p * p + q * q, TINY)
    L = complex(p * m, -q * m)
    L_over = L * over
    L2_over = L * L_over
    over2 = over * over
    D = L_over * (L_over + over2)
    f[0], f[1], f[2], f[3] = over.imag, L_over.imag, L2_over.imag, (L * L2_over).imag
    f[4], f[5] = L.imag, (L * L).imag
    f[6] = z * (over2 * over).imag
    f[7] = z * (complex(z, xi) * over2 * over).imag
    f[8], f[9] = z * D.imag, z * (L * (D + L_over * L_over)).imag


@jit
def disc_moments(r, z, xi, f):
    """Write the indefinite integrals of 2ξ times the ten functions."""
    p, q = upper_root((r - xi) * (r + xi) + z * z, 2.0 * z * xi)
    R = complex(p, q)
    m = p * p + q * q
    z_over = complex(z * p / m, -z * q / m) if m > 0.0 else complex(0.0, 0.0)
    p += z
    q += xi
    m = p * p + q * q
    L = complex(p / m, -q / m) if m > TINY else complex(0.0, 0.0)
    i0 = complex(0.5 * log(max(m, TINY)), atan2(q, p))
    eta = complex(0.0, xi)
    L2 = L * L
    L3 = L * L2
    i1, i2, i3 = -L, -0.5 * L2, L3 / -3.0
    j0 = R - z * i0
    j1 = 0.5 * (i0 - z * i1 - eta * L)
    j2 = (i1 - z * i2 - eta * L2) / 3.0
    j3 = 0.25 * (i2 - z * i3 - eta * L3)
    f[0], f[1], f[2], f[3] = -2.0 * j0.imag, -2.0 * j1.imag, -2.0 * j2.imag, -2.0 * j3.imag
    f[4] = -2.0 / 3.0 * (eta * eta * L + j0 - z * j1).imag
    f[5] = -0.5 * (eta * eta * L2 + 2.0 * (j1 - z * j2)).imag
    f[6] = 2.0 * (xi * (z_over * L).real - z * i1.imag)
    f[7] = 2.0 * (xi * z_over.real - z * i0.imag)
    f[8] = 2.0 * (xi * (z_over * L2).real - z * i2.imag)
    f[9] = 2.0 * (xi * (z_over * L3).real - z * i3.imag)


@jit
def reciprocal(w):
    """1/w; where w is 0, which only the edge of the punch itself is, 0."""
    m = w.real * w.real + w.imag * w.imag
    return complex(w.real / m, -w.imag / m) if m > TINY else complex(0.0, 0.0)


@jit
def strip(x, z, xi, f):
    """Write the four functions of a strip of half-width ξ at x ≥ 0."""
    w = complex(x, z)
    over = reciprocal(np.sqrt(w - xi) * np.sqrt(w + xi))
    rate = -z * w * over * over * over
    f[0], f[1], f[2], f[3] = over.real, over.imag, rate.real, rate.imag


@jit
def strip_moments(x, z, xi, f):
    """Write the indefinite integrals of (π/2) ξ times the four functions."""
    w = complex(x, z)
    root = np.sqrt(w - xi) * np.sqrt(w + xi)
    rate = z * w * reciprocal(root)
    f[0], f[1] = -0.5 * pi * root.real, -0.5 * pi * root.imag
    f[2], f[3] = -0.5 * pi * rate.real, -0.5 * pi * rate.imag


@jit
def components(plane, n, t, x, y, z, nu, s, other):
    """Write the stress at (x, y, z): xx, yy, zz, yz, xz, xy; and in `other` that under the opposite shear.

    Parameters
    ----------
    plane
        Whether n and t are the functions of strips.
    n, t
        The functions integrated over the springs, of the pressure and of the shear in +x.
    """
    if plane:
        side = 1.0 if x > 0.0 else -1.0 if x < 0.0 else 0.0
        xx, zz, xz = n[1] + n[2], n[1] - n[2], -side * n[3]
        of_xx, of_zz, of_xz = side * (t[3] - 2.0 * t[0]), -side * t[3], t[1] + t[2]
        s[0], s[2], s[4] = xx + of_xx, zz + of_zz, xz + of_xz
        other[0], other[2], other[4] = xx - of_xx, zz - of_zz, xz - of_xz
        s[1], other[1] = nu * (s[0] + s[2]), nu * (other[0] + other[2])
        s[3], s[5], other[3], other[5] = 0.0, 0.0, 0.0, 0.0
        return
    axial = 2.0 * nu * n[0] - z * n[1] + (1.0 - 2.0 * nu) * n[4]
    radial = n[8] - (1.0 - 2.0 * nu) * n[2]
    down = z * t[2]
    twist = 2.0 * nu * x * (x * x * t[3] - 1.5 * t[5])
    s[0] = x * (2.0 * (1.0 + nu) * t[1] - 3.0 * down + x * x * t[9]) + twist
    s[1] = x * (y * y * t[9] - down) - twist
    s[2] = x * t[6]
    s[3] = x * y * t[8]
    s[4] = t[0] - z * t[1] + x * x * t[8]
    s[5] = y * (2.0 * nu * (x * x * t[3] - 0.5 * t[5]) + t[1] - down + x * x * t[9])
    other[0], other[1], other[2] = axial + x * x * radial, axial + y * y * radial, n[0] + n[7]
    other[3], other[4], other[5] = y * n[6], x * n[6], x * y * radial
    for c in range(6):
        drag = s[c]
        s[c] = other[c] + drag
        other[c] -= drag
