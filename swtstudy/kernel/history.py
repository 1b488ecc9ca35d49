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
def functionals(profile, table, s, history):
    """T1, T3, B, V of the profile up to s, about the centre of the stick zone of this size."""
    if profile.is_hertz:
        x = history.x - centre_of(profile, history.shift, history.load, history.reach, s)
        t1, t3, b, v = strip_hertz(s, abs(x)) if profile.plane else hertz(s, abs(x))
        return (t1, t3, b, v) if x >= 0.0 else (-t1, -t3, b, v)
    return running(table, FIRST, s, history.X, history.all_outside)


@jit
def is_sharp(profile):
    """True for ξⁿ with 1 < n < 2, a tip sharper than a paraboloid."""
    return 0.0 < profile.exponent < 2.0


@jit
def turn_at_centre(profile):
    """κ/t of a sharp tip."""
    m, half = profile.exponent - 1.0, 0.5 if profile.plane else 1.0
    of_t = gamma(half + 0.5 * m) / gamma(half + 0.5 + 0.5 * m)
    return gamma(1.0 - 0.5 * m) / (m * gamma(0.5 - 0.5 * m) * of_t)


@jit
def slope_of(cycle, i):
    """do/dG of a piece that did not grow."""
    return 0.0 if i == NONE else cycle.slope[i]


@jit
def integrate_pieces(history, cycle, growth, profile, table, largest):
    """Tabulate the profile and what grew at x, and ∫ o′ (T1, T3, B) up to the start of each piece."""
    k, b, plane = FIRST, profile.flat_radius, profile.plane
    x, X, outside = history.x, history.X, history.all_outside
    if not profile.is_hertz:
        panels = profile.begin[:], profile.end[:], profile.density[:]
        k = tabulate(table, FIRST, FIRST, *panels, FIRST, profile.panels, largest, b, x, X, outside, plane)
    for i in range(cycle.pieces):
        if cycle.used[i] == 0:
            continue
        if cycle.kind[i] == GROWN:
            first, last = growth.first[i], growth.last[i]
            panels = growth.begin[:], growth.end[:], growth.density[:]
            k = tabulate(table, 1 + i, k, *panels, first, last, 1e300, b, x, X, outside, plane)
        if k + 2 >= MAX_TABLES:
            cycle.overflow = 1
        beneath, s = cycle.beneath[i], cycle.start_s[i]
        t1, t3, b1, v1 = functionals(profile, table, s, history)
        o1, o3, ob = 0.0, 0.0, 0.0
        if beneath != NONE:
            before = history.up_to_start[beneath]
            o1, o3, ob = before[0], before[1], before[2]
            if cycle.kind[beneath] == GROWN:
                g1, g3, gb, gv = running(table, 1 + beneath, s, history.X, history.all_outside)
                o1 += g1
                o3 += g3
                ob += gb
        jump = slope_of(cycle, beneath) - slope_of(cycle, i)
        history.up_to_start[i, 0], history.up_to_start[i, 1] = o1 + jump * t1, o3 + jump * t3
        history.up_to_start[i, 2] = ob + jump * b1


@jit
def stress(history, m, cycle, profile, table, k, edge, front, sign, ask):
    """Write instant m: the stress at x in stretch k with its edge and front at these places s.

    The sign is -1 in the mirrored half of the cycle, else 1.
    Pressure and σ_xx of the normal load and of the tangential load are the sums of section 3 of the paper
    over the pieces of the diagram, each a slope times a running integral. In plane strain
    σ_yy = ν (σ_xx + σ_zz).
    """
    push, i = cycle.push[k], cycle.piece[k]
    if push == OPEN or edge <= 0.0:
        history.p[m], history.within[m], history.xx[m], history.yy[m], history.q[m] = 0.0, 0.0, 0.0, 0.0, 0.0
        return
    n1, n3, nb, nv = functionals(profile, table, edge, history)
    rise = history.turn * n1  # of B, up to the centre
    o1, o3, ob = push * n1, push * n3, push * nb  # ∫ o′ beyond the front
    if i != NONE:
        o1 += history.up_to_start[i, 0]
        o3 += history.up_to_start[i, 1]
        ob += history.up_to_start[i, 2]
        if cycle.kind[i] == GROWN:
            g1, g3, gb, gv = running(table, 1 + i, front, history.X, history.all_outside)
            o1 += g1
            o3 += g3
            ob += gb
        jump = slope_of(cycle, i) - push
        if jump != 0.0:
            if push != STICK:
                n1, n3, f_b, f_v = functionals(profile, table, front, history)
            else:
                f_b = nb
            o1 += jump * n1
            o3 += jump * n3
            ob += jump * f_b
    ob += history.rest * history.turn * o1
    o1, o3 = (1.0 - history.rest) * o1, (1.0 - history.rest) * o3
    nu, friction = ask.poisson_ratio, sign * ask.friction / pi
    history.p[m], history.q[m] = (nb + history.rest * rise) / pi, friction * ob
    if profile.plane:
        history.within[m], history.xx[m], history.yy[m] = 0.0, -friction * o1, -friction * nu * o1
        return
    if history.all_outside == 0:
        nv += force_at(profile, min(edge, history.X)) / (history.x * history.x)
    history.within[m] = (1.0 - 2.0 * nu) / pi * ((1.0 - history.rest) * nv + history.rest * 0.5 * (nb + rise))
    history.xx[m] = -friction * ((1.0 + nu) * o1 - nu * o3)
    history.yy[m] = -friction * nu * o3


@jit
def write_stress(point):
    """Write the stress at the new instants; a known one is copied, perhaps to where the load is mirrored."""
    load, profile, ask = point.load, point.profile, point.ask
    cycle, table, history = point.cycle, point.table, point.history
    for m in range(history.written, history.instants):
        i, z = history.known[m], history.part[m]
        if i == NONE:
            edge, front, sign = history.state[m, 0], history.state[m, 1], -1.0 if history.mirror[z] else 1.0
            stress(history, m, cycle, profile, table, history.stretch[z], edge, front, sign, ask)
            history.bulk[m] = bulk_at(load, history.instant[m])
            continue
        sign = 1.0 if history.mirror[z] == history.mirror[history.part[i]] else -1.0
        history.p[m], history.within[m], history.bulk[m] = history.p[i], history.within[i], history.bulk[i]
        history.xx[m], history.yy[m] = sign * history.xx[i], sign * history.yy[i]
        history.q[m] = sign * history.q[i]
    history.written = history.instants


@jit
def largest_pressure(history):
    """The largest pressure at the instants of a history."""
    most = 0.0
    for i in range(history.instants):
        most = max(most, history.p[i])
    return most


@jit
def begin_history(point, place, largest, side):
    """Prepare a history at place s of the line, still without an instant; parameters as of `sample_cycle`."""
    profile, history = point.profile, point.history
    history.turn, history.rest, innermost = 0.0, 0.0, INNERMOST * largest
    if is_sharp(profile) and place < innermost:
        history.turn = turn_at_centre(profile)
        history.rest = 1.0 - (place / innermost) ** (profile.exponent - 1.0)
        place = innermost
    x = sqrt(profile.flat_radius * profile.flat_radius + place * abs(place))
    begin_parts(history, point.cycle, profile, place, x, 0.0, largest, side * point.cycle.shift)
    history.plane = profile.plane
    integrate_pieces(history, point.cycle, point.growth, profile, point.table, largest)


@jit
def sample_cycle(point, place, largest, side, coarsest):
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
    begin_history(point, place, largest, side)
    lay_parts(point.history, point.cycle, point.profile, point.load, coarsest)
    write_stress(point)
