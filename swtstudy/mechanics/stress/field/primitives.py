"""Closed-form integrals of a punch's field over its radius, with the weights 1 and ξ.

With U = R + ζ one has dζ/R = dU/U: every function of `punch` times a power of η = iξ = ζ − z integrates to
powers of L = 1/U and one logarithm. Write I[n, m] = ∫ ηⁿ Lᵐ/R dζ and J[n, m] = ∫ ηⁿ Lᵐ dζ; integration by
parts gives

    I[0, 0] = ln U,   I[0, m] = −Lᵐ/m,   I[1, 0] = R − z ln U,
    I[n, m] = (−ηⁿ Lᵐ + n (I[n−1, m−1] − z I[n−1, m])) / (m + n),
    J[n, m] = (ηⁿ⁺¹ Lᵐ + m (I[n, m−1] − z I[n, m])) / (m + n + 1),

and the functions with 1/R³ are derivatives: 1/R³ = −(L/R)′, ζ/R³ = −(1/R)′, D = −(L²/R)′, B = −(L³/R)′.
Nothing here divides by r or z, so that the axis and the surface are ordinary places.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field.punch import PunchFunctions, complex_distance

#: Below this |U| (the origin, seen from the punch of radius 0) the primitives are cut off: U⁻³ is a number. A
#: slope that starts with g′(0) = 0 gives that end of its cell no weight. 1e-82 or 1e-78: no change.
SMALLEST_U = 1e-80


def primitives(r: FloatArray, z: FloatArray, radius: FloatArray) -> tuple[PunchFunctions, PunchFunctions]:
    """Indefinite integrals over ξ of the ten functions' imaginary parts, weighted with 1 and with ξ.

    Parameters
    ----------
    r, z, radius
        Distance from the axis, depth z ≥ 0 and punch radius ξ ≥ 0, broadcastable, in one unit of length.

    Returns
    -------
    plain, weighted
        Real: ∫ Im f dξ and ∫ ξ Im f dξ.
    """
    R = complex_distance(r, z, radius)
    η = 1j * radius
    U = R + (z + η)
    origin = np.abs(U) < SMALLEST_U
    U[origin] = SMALLEST_U
    L = 1.0 / U
    L[origin] = 0.0
    # At the edge of the punch in the surface z/R is 0/0, with the limit 0.
    z_over_R = np.divide(z, R, out=np.zeros_like(R), where=R != 0.0)

    logU = np.log(U)
    L2 = L * L
    L3 = L2 * L
    I0 = (logU, -L, L2 * -0.5, L3 * (-1.0 / 3.0))
    # What both recursions need: I[n, m−1] − z I[n, m] for n = 0.
    K0 = (I0[0] - z * I0[1], I0[1] - z * I0[2], I0[2] - z * I0[3])
    ηL, ηL2, ηL3 = η * L, η * L2, η * L3
    I1 = (R - z * logU, (K0[0] - ηL) * 0.5, (K0[1] - ηL2) * (1.0 / 3.0), (K0[2] - ηL3) * 0.25)
    J0 = ((ηL + K0[0]) * 0.5, (ηL2 + 2.0 * K0[1]) * (1.0 / 3.0))
    J1 = ((η * ηL + I1[0] - z * I1[1]) * (1.0 / 3.0), (η * ηL2 + 2.0 * (I1[1] - z * I1[2])) * 0.25)
    boundary = (-z_over_R * L, -z_over_R, -z_over_R * L2, -z_over_R * L3)

    # ∫ f dξ = −i ∫ f dζ, and ξ = −iη: the imaginary parts are −Re and −Im.
    plain = PunchFunctions(*(-f.real for f in (*I0, *J0, *boundary)))
    inner = (I0[1], I0[0], I0[2], I0[3])
    weighted = PunchFunctions(
        *(-f.imag for f in (*I1, *J1)),
        *(-(radius * f.real + z * g.imag) for f, g in zip(boundary, inner, strict=True)),
    )
    return plain, weighted
