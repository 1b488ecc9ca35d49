"""The stress cycle at one position of the surface line, at instants from which it can be interpolated.

Next to a tip sharper than a paraboloid, G = ξⁿ with n < 2, the stress is linear in x^m, m = n - 1. There the
density n ξ^m has

    T1(x) = t x^m,   B(x) = B(0) - κ x^m,   κ = n √π Γ(1 - m/2)/(m Γ((1 - m)/2)),

t = n √π Γ(1 + m/2)/Γ((3 + m)/2), in the plane n √π Γ((1 + m)/2)/Γ(1 + m/2). So T1 and B at the innermost
tabulated x give B(0). At the centre itself T1 and T3 are 0, and V is B/2; between, all are linear in x^m.
"""

from math import gamma, pi, sqrt

import numpy as np

from swtstudy.kernel import INNERMOST
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import GROWN, MAX_PIECES, NONE, OPEN, STICK
from swtstudy.kernel.load import bulk_at
from swtstudy.kernel.parts import MAX_INSTANTS, OF_PARTS, begin_parts, lay_parts
from swtstudy.kernel.profile import force_at
from swtstudy.kernel.shift import centre_of
from swtstudy.kernel.surface import MAX_TABLES, hertz, running, strip_hertz, tabulate

#: Row and panel of the profile in the tables at x; no literal, for which Numba would compile anew.
FIRST = np.int64(0)
HISTORY = np.dtype(
    [
        *OF_PARTS,
        ("plane", "i8"),
        # Next to a sharp tip: κ/t, and the share of x^m that the tabulated x has more than the place; else 0.
        *fields("f8", "turn rest"),
        # Pressure, (1-2ν) P/(2πx²) with P the load within x, and B, in σ_xx on both sides.
        *fields("f8", "p within bulk", (MAX_INSTANTS,)),
        *fields("f8", "xx yy q", (MAX_INSTANTS,)),  # of the tangential load, at +x
        ("up_to_start", "f8", (MAX_PIECES, 3)),  # ∫ (do/dG - own slope) up to a piece's start: T1, T3, B
    ]
)


@jit
def functionals(P, K, s, H):
    """T1, T3, B, V of the profile up to s, about the centre of the stick zone of this size."""
    if P.is_hertz:
        x = H.x - centre_of(P, H.shift, H.load, H.reach, s)
        t1, t3, b, v = strip_hertz(s, abs(x)) if P.plane else hertz(s, abs(x))
        return (t1, t3, b, v) if x >= 0.0 else (-t1, -t3, b, v)
    return running(K, FIRST, s, H.X, H.all_outside)


@jit
def is_sharp(P):
    """True for ξⁿ with 1 < n < 2, a tip sharper than a paraboloid."""
    return 0.0 < P.exponent < 2.0


@jit
def turn_at_centre(P):
    """κ/t of a sharp tip."""
    m, half = P.exponent - 1.0, 0.5 if P.plane else 1.0
    of_t = gamma(half + 0.5 * m) / gamma(half + 0.5 + 0.5 * m)
    return gamma(1.0 - 0.5 * m) / (m * gamma(0.5 - 0.5 * m) * of_t)


@jit
def slope_of(C, i):
    """do/dG of a piece that did not grow."""
    return 0.0 if i == NONE else C.slope[i]


@jit
def integrate_pieces(H, C, R, P, K, largest):
    """Tabulate the profile and what grew at x, and ∫ o′ (T1, T3, B) up to the start of each piece."""
    k, b, x, X, outside, plane = FIRST, P.flat_radius, H.x, H.X, H.all_outside, P.plane
    if not P.is_hertz:
        panels = P.begin[:], P.end[:], P.density[:]
        k = tabulate(K, FIRST, FIRST, *panels, FIRST, P.panels, largest, b, x, X, outside, plane)
    for i in range(C.pieces):
        if C.used[i] == 0:
            continue
        if C.kind[i] == GROWN:
            first, last = R.first[i], R.last[i]
            panels = R.begin[:], R.end[:], R.density[:]
            k = tabulate(K, 1 + i, k, *panels, first, last, 1e300, b, x, X, outside, plane)
        if k + 2 >= MAX_TABLES:
            C.overflow = 1
        beneath, s = C.beneath[i], C.start_s[i]
        t1, t3, b1, v1 = functionals(P, K, s, H)
        o1, o3, ob = 0.0, 0.0, 0.0
        if beneath != NONE:
            o1, o3, ob = H.up_to_start[beneath, 0], H.up_to_start[beneath, 1], H.up_to_start[beneath, 2]
            if C.kind[beneath] == GROWN:
                g1, g3, gb, gv = running(K, 1 + beneath, s, H.X, H.all_outside)
                o1 += g1
                o3 += g3
                ob += gb
        jump = slope_of(C, beneath) - slope_of(C, i)
        H.up_to_start[i, 0], H.up_to_start[i, 1] = o1 + jump * t1, o3 + jump * t3
        H.up_to_start[i, 2] = ob + jump * b1


@jit
def stress(H, m, C, P, K, k, edge, front, sign, Q):
    """Write instant m: the stress at x in stretch k with its edge and front at these places s.

    The sign is -1 in the mirrored half of the cycle, else 1.
    Pressure and σ_xx of the normal load and of the tangential load are the sums of section 3 of the paper
    over the pieces of the diagram, each a slope times a running integral. In plane strain
    σ_yy = ν (σ_xx + σ_zz).
    """
    push, i = C.push[k], C.piece[k]
    if push == OPEN or edge <= 0.0:
        H.p[m], H.within[m], H.xx[m], H.yy[m], H.q[m] = 0.0, 0.0, 0.0, 0.0, 0.0
        return
    n1, n3, nb, nv = functionals(P, K, edge, H)
    rise = H.turn * n1  # of B, up to the centre
    o1, o3, ob = push * n1, push * n3, push * nb  # ∫ o′ beyond the front
    if i != NONE:
        o1 += H.up_to_start[i, 0]
        o3 += H.up_to_start[i, 1]
        ob += H.up_to_start[i, 2]
        if C.kind[i] == GROWN:
            g1, g3, gb, gv = running(K, 1 + i, front, H.X, H.all_outside)
            o1 += g1
            o3 += g3
            ob += gb
        jump = slope_of(C, i) - push
        if jump != 0.0:
            if push != STICK:
                n1, n3, f_b, f_v = functionals(P, K, front, H)
            else:
                f_b = nb
            o1 += jump * n1
            o3 += jump * n3
            ob += jump * f_b
    ob += H.rest * H.turn * o1
    o1, o3 = (1.0 - H.rest) * o1, (1.0 - H.rest) * o3
    nu, friction = Q.poisson_ratio, sign * Q.friction / pi
    H.p[m], H.q[m] = (nb + H.rest * rise) / pi, friction * ob
    if P.plane:
        H.within[m], H.xx[m], H.yy[m] = 0.0, -friction * o1, -friction * nu * o1
        return
    if H.all_outside == 0:
        nv += force_at(P, min(edge, H.X)) / (H.x * H.x)
    H.within[m] = (1.0 - 2.0 * nu) / pi * ((1.0 - H.rest) * nv + H.rest * 0.5 * (nb + rise))
    H.xx[m] = -friction * ((1.0 + nu) * o1 - nu * o3)
    H.yy[m] = -friction * nu * o3


@jit
def write_stress(H, C, P, L, K, Q):
    """Write the stress at the new instants; a known one is copied, perhaps to where the load is mirrored."""
    for m in range(H.written, H.instants):
        i, z = H.known[m], H.part[m]
        if i == NONE:
            sign = -1.0 if H.mirror[z] else 1.0
            stress(H, m, C, P, K, H.stretch[z], H.state[m, 0], H.state[m, 1], sign, Q)
            H.bulk[m] = bulk_at(L, H.instant[m])
            continue
        sign = 1.0 if H.mirror[z] == H.mirror[H.part[i]] else -1.0
        H.p[m], H.within[m], H.bulk[m] = H.p[i], H.within[i], H.bulk[i]
        H.xx[m], H.yy[m], H.q[m] = sign * H.xx[i], sign * H.yy[i], sign * H.q[i]
    H.written = H.instants


@jit
def begin_history(H, C, R, P, K, place, largest, side):
    """Prepare a history at place s of the line, still without an instant; parameters as of `sample_cycle`."""
    H.turn, H.rest, innermost = 0.0, 0.0, INNERMOST * largest
    if is_sharp(P) and place < innermost:
        H.turn, H.rest = turn_at_centre(P), 1.0 - (place / innermost) ** (P.exponent - 1.0)
        place = innermost
    x = sqrt(P.flat_radius * P.flat_radius + place * abs(place))
    begin_parts(H, C, P, place, x, 0.0, largest, side * C.shift)
    H.plane = P.plane
    integrate_pieces(H, C, R, P, K, largest)


@jit
def sample_cycle(H, C, R, P, K, L, Q, place, largest, side, coarsest):
    """All parts of the cycle at x, coarsely.

    Parameters
    ----------
    place
        √(x² - b²), or -√(b² - x²) under the face.
    largest
        Place s of the largest contact.
    side
        1 or -1: towards which side x is, which matters where the stick zone is shifted.
    coarsest
        Intervals of a part.
    """
    begin_history(H, C, R, P, K, place, largest, side)
    lay_parts(H, C, P, L, coarsest)
    write_stress(H, C, P, L, K, Q)
