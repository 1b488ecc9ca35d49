"""The stress at one place (x, y, z) of the body, from running integrals over the springs (15)-(18).

Each function of a punch (`swtstudy.kernel.punch`) is integrated over the radius with the density of the
profile and of what grew, from the axis up to any s. The stress at an instant is then a sum of few
of them, as on the surface line: each piece of the memory diagram a slope times a running integral.

Hertz's contacts have closed forms. Else panels are cut into cells on which a Chebyshev series is enough.
In s all functions have their singularity at the complex place s* = σ + iω with s*² = (r + iz)² - b². The
variable u of s = σ + ω sinh u spreads its neighbourhood and removes the root there, so that cells of equal
length do at every depth, their number growing like ln(1/z). In the surface (ω = 0) s = σ sin u inside and
s = σ cosh u outside do the same.

If a bulk stress shifts the stick zone (`swtstudy.kernel.shift`), each piece of the diagram has a centre of
its own, and its stresses are added instead of its functions.
"""

from math import asin, asinh, cos, cosh, exp, hypot, pi, sin, sinh, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import GAUSS, ORDER, RUN, clenshaw, panel_of
from swtstudy.kernel.compiled import fields, jit, jit_reordered
from swtstudy.kernel.contact import GROWN, MAX_PIECES, NONE, OPEN
from swtstudy.kernel.growth import find_stretch, solved_places
from swtstudy.kernel.load import bulk_at, load_at
from swtstudy.kernel.profile import MEAN_LOAD, place_of, radius_of
from swtstudy.kernel.punch import FUNCTIONS, components, disc, disc_moments, strip, strip_moments, upper_root
from swtstudy.kernel.shift import centre_of
from swtstudy.kernel.surface import acosh, inside_end

#: Row and cell of the profile; no literal, for which Numba would compile anew.
FIRST = np.int64(0)
MAX_CELLS = 9973
#: Variables of cells: s = σ + ω sinh u, σ sin u, σ cosh u.
BENEATH, INSIDE, OUTSIDE = np.arange(3)
#: Longest cell in u: its series of ORDER terms misses 1e-8 of the singular part.
LONGEST = 1.0
#: Largest logarithm of the growth of the density of ξⁿ in a cell, unless its load up to there is such a share
#: of the whole.
STEEPEST, NOTHING = 1.2, 1e-10
#: Widest cell over its distance from the branch of ξ = √(b² + s²) at s = ib.
BESIDE_FACE = 1.5
#: Depths below this share of the distance from the axis or from the face's edge are the surface's.
SHALLOW = 1e-13
#: Substitute for a distance of 0 in the surface, on the axis or at the edge of the face: its fifth power is
#: a number.
NEXT_TO_AXIS = 1e-40

PLACE = np.dtype(
    [
        *fields("f8", "x y z r"),
        ("overflow", "i8"),
        *fields("f8", "sigma omega"),
        ("begin", "f8", (MAX_CELLS,)),  # s at the lower ends of the cells
        ("scale", "f8", (MAX_CELLS, 2)),  # u at the lower end, and 2 over the length
        ("kind", "i8", (MAX_CELLS,)),
        ("series", "f8", (MAX_CELLS, ORDER + 1, FUNCTIONS)),  # of running integrals
        *fields("i8", "first last", (MAX_PIECES + 1,)),  # cells of a density: 0 the profile, 1 + i piece i
        ("total", "f8", (MAX_PIECES + 1, FUNCTIONS)),  # of all cells
        ("at_axis", "f8", (FUNCTIONS,)),  # of the closed forms
        ("up_to_start", "f8", (MAX_PIECES, FUNCTIONS)),  # ∫ (do/dG - own slope) up to a piece's start
        *fields("f8", "normal drag nothing", (FUNCTIONS,)),  # of the springs at an instant
        ("work", "f8", (2, FUNCTIONS)),
        ("other", "f8", (6,)),
        *fields("f8", "shift load reach"),  # of the stick zone; coordinate and place of the edge
        ("drag_to_start", "f8", (MAX_PIECES, 6)),  # the stress up to a piece's start, where there is a shift
        ("one_drag", "f8", (3, 6)),
    ]
)


@jit
def set_place(B, P, x, y, z):
    """Note a place, and where the functions are singular in s."""
    r = abs(x) if P.plane else hypot(x, y)
    B.x, B.y, B.z, B.r, B.overflow = x, y, z, r, 0
    b = P.flat_radius
    real, imaginary = (r - b) * (r + b) - z * z, 2.0 * r * z
    B.sigma, B.omega = upper_root(real, imaginary)
    if B.omega <= SHALLOW * B.sigma:
        B.omega = 0.0
    if B.sigma == 0.0 and B.omega == 0.0:  # the axis, or the edge of the face, in the surface
        B.omega = NEXT_TO_AXIS


@jit
def variable(B, kind, s):
    """The variable u of a kind of cells at s."""
    if kind == BENEATH:
        return asinh((s - B.sigma) / B.omega)
    if kind == INSIDE:
        return asin(min(s / B.sigma, 1.0))
    return acosh(s / B.sigma)


@jit
def cell_end(B, b, exponent, low, end):
    """Where the cell from `low` on ends, `end` at most."""
    longest = LONGEST
    high = end
    if exponent > 1.0:
        high = min(high, max(low * exp(STEEPEST / (exponent - 1.0)), B.reach * NOTHING ** (1.0 / exponent)))
    if B.omega > 0.0:
        high = min(high, B.sigma + B.omega * sinh(asinh((low - B.sigma) / B.omega) + longest))
    elif low >= B.sigma:
        high = min(high, B.sigma * cosh(acosh(low / B.sigma) + 2.0 * longest))
    else:
        high = inside_end(low, min(end, B.sigma), B.sigma)
    if b > 0.0:
        high = min(high, low + BESIDE_FACE * sqrt(b * b + low * low))
    # No sliver is left over.
    return end if high > low + 0.9 * (end - low) and (B.omega > 0.0 or low >= B.sigma) else high


@jit_reordered
def tabulate_cell(B, k, plane, exponent, density, begin, end, low, high, b, total):
    """Cell k: running integrals of a panel's density times the functions, added to the total up to there.

    The density of ξⁿ has no series at the axis: its exponent n is told, else 0.
    """
    kind = BENEATH if B.omega > 0.0 else INSIDE if high <= B.sigma else OUTSIDE
    u0, u1 = variable(B, kind, low), variable(B, kind, high)
    half, width = 0.5 * (u1 - u0), 2.0 / (end - begin)
    f, S = B.work[0], B.series[k]
    B.begin[k], B.kind[k], B.scale[k, 0], B.scale[k, 1] = low, kind, u0, 1.0 / half
    for c in range(ORDER + 1):
        for j in range(FUNCTIONS):
            S[c, j] = 0.0
    for i in range(ORDER):
        u = u0 + half * (GAUSS[i] + 1.0)
        if kind == BENEATH:
            s, rate = B.sigma + B.omega * sinh(u), B.omega * cosh(u)
        elif kind == INSIDE:
            s, rate = B.sigma * sin(u), B.sigma * cos(u)
        else:
            s, rate = B.sigma * cosh(u), B.sigma * sinh(u)
        weight = half * rate
        if exponent > 0.0:
            weight *= exponent * max(s, 0.0) ** (exponent - 1.0) * (MEAN_LOAD if plane else 1.0)
        else:
            weight *= clenshaw(density, (s - begin) * width - 1.0)
        if plane:
            strip(B.r, B.z, sqrt(b * b + s * s), f)
        else:
            disc(B.r, B.z, sqrt(b * b + s * s), f)
        for c in range(ORDER + 1):
            part = weight * RUN[i, c]
            for j in range(FUNCTIONS):
                S[c, j] += part * f[j]
    for j in range(FUNCTIONS):
        before = total[j]
        for c in range(ORDER + 1):
            total[j] += S[c, j]
        S[0, j] += before


@jit
def tabulate(B, row, k, plane, exponent, begin, end, density, p0, p1, top, b):
    """Tabulate panels p0 to p1 of a density up to s = top, from cell k on; returns the next free cell."""
    B.first[row] = k
    total = B.total[row]
    for j in range(FUNCTIONS):
        total[j] = 0.0
    for p in range(p0, p1):
        low = begin[p]
        if low >= top:
            break
        while low < end[p]:
            if k + 1 >= MAX_CELLS:
                B.overflow = 1
                return k
            high = cell_end(B, b, exponent, low, end[p])
            tabulate_cell(B, k, plane, exponent, density[p], begin[p], end[p], low, high, b, total)
            k += 1
            low = high
    B.last[row] = k
    return k


@jit_reordered
def running(B, row, s, f):
    """Write the running integrals of a density up to s."""
    first, last = B.first[row], B.last[row]
    if first == last or s <= B.begin[first]:
        for j in range(FUNCTIONS):
            f[j] = 0.0
        return
    k = panel_of(B.begin, first, last, s)
    y = min((variable(B, B.kind[k], s) - B.scale[k, 0]) * B.scale[k, 1] - 1.0, 1.0)
    S = B.series[k]
    for j in range(FUNCTIONS):
        f[j] = S[0, j] + y * S[1, j]
    t0, t1 = 1.0, y
    for c in range(2, ORDER + 1):
        t0, t1 = t1, 2.0 * y * t1 - t0
        for j in range(FUNCTIONS):
            f[j] += t1 * S[c, j]


@jit
def up_to(B, P, s, f):
    """Write the running integrals of the profile's density up to s."""
    if P.is_hertz == 0:
        running(B, FIRST, s, f)
        return
    if P.plane:
        strip_moments(B.r, B.z, s, f)
    else:
        disc_moments(B.r, B.z, s, f)
    for j in range(FUNCTIONS):
        f[j] -= B.at_axis[j]


@jit
def add(to, factor, f):
    """Add a multiple of some functions to others."""
    for j in range(FUNCTIONS):
        to[j] += factor * f[j]


@jit
def drag_of(B, P, Q, s):
    """Write the stress by Hertz's traction on the stick zone of size s about its own centre, times π."""
    d, f, z = centre_of(P, B.shift, B.load, B.reach, s), B.work[1], B.z
    x = B.x - d
    if P.plane:
        strip_moments(abs(x), z, s, f)
        f[0] += 0.5 * pi * abs(x)  # less those of size 0
        f[1] += 0.5 * pi * z
        f[2] += 0.5 * pi * z
    else:
        disc_moments(hypot(x, B.y), z, s, f)
    components(P.plane, B.nothing, f, x, B.y, z, Q.poisson_ratio, B.one_drag[0], B.one_drag[1])


@jit
def add_drag(B, P, Q, s, factor, to):
    """Add a multiple of the stress by the traction on a stick zone."""
    if factor == 0.0 or s <= 0.0:
        return
    drag_of(B, P, Q, s)
    for c in range(6):
        to[c] += factor * B.one_drag[0, c]


@jit
def open_drags(B, C, P, Q):
    """Sum the stress by the pieces up to the start of each."""
    for j in range(FUNCTIONS):
        B.nothing[j] = 0.0
    for i in range(C.pieces):
        if C.used[i] == 0:
            continue
        beneath, sums, jump = C.beneath[i], B.drag_to_start[i], -C.slope[i]
        for c in range(6):
            sums[c] = 0.0 if beneath == NONE else B.drag_to_start[beneath, c]
        if beneath != NONE:
            jump += C.slope[beneath]
        add_drag(B, P, Q, C.start_s[i], jump, sums)


@jit
def shifted_stress(B, C, P, Q, k, edge, front, sign, out, other):
    """`centred_stress` where the stick zone is shifted: stresses of pressure and of drag on their own."""
    push, i = C.push[k], C.piece[k]
    up_to(B, P, edge, B.normal)
    components(P.plane, B.normal, B.nothing, B.x, B.y, B.z, Q.poisson_ratio, out, other)
    drag = B.one_drag[2]
    for c in range(6):
        drag[c] = 0.0 if i == NONE else B.drag_to_start[i, c]
    slope = push if i == NONE else C.slope[i]
    if front < edge:
        add_drag(B, P, Q, front, slope - push, drag)
        slope = push
    add_drag(B, P, Q, edge, slope, drag)
    for c in range(6):
        pressure, shear = out[c] / pi, sign * Q.friction / pi * drag[c]
        out[c], other[c] = pressure + shear, pressure - shear


@jit
def open_place(B, C, R, P, Q, x, y, z, largest):
    """Tabulate the densities at a place, and ∫ o′ times the functions up to the start of each piece.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    """
    set_place(B, P, x, y, z)
    B.shift, B.load, B.reach = C.shift, C.largest, largest
    k, plane, b = FIRST, P.plane, P.flat_radius
    for j in range(FUNCTIONS):
        B.work[0, j], B.at_axis[j] = 0.0, 0.0
    if P.is_hertz == 0:
        panels = P.begin[:], P.end[:], P.density[:]
        k = tabulate(B, FIRST, k, plane, P.exponent, *panels, FIRST, P.panels, largest, b)
    elif plane:
        strip_moments(B.r, z, 0.0, B.at_axis)
    else:
        disc_moments(B.r, z, 0.0, B.at_axis)
    if B.shift != 0.0:
        open_drags(B, C, P, Q)
        return
    f = B.work[1]
    for i in range(C.pieces):
        if C.used[i] == 0 or B.overflow:
            continue
        if C.kind[i] == GROWN:
            panels = R.begin[:], R.end[:], R.density[:]
            k = tabulate(B, 1 + i, k, plane, 0.0, *panels, R.first[i], R.last[i], 1e300, b)
        beneath, s, sums = C.beneath[i], C.start_s[i], B.up_to_start[i]
        jump = -C.slope[i]
        for j in range(FUNCTIONS):
            sums[j] = 0.0
        if beneath != NONE:
            jump += C.slope[beneath]
            add(sums, 1.0, B.up_to_start[beneath])
            if C.kind[beneath] == GROWN:
                running(B, 1 + beneath, s, f)
                add(sums, 1.0, f)
        if jump != 0.0 and s > 0.0:
            up_to(B, P, s, f)
            add(sums, jump, f)


@jit
def centred_stress(B, C, P, Q, k, edge, front, sign, out, other):
    """`stress_of_state` without the bulk stress, where all springs are about the axis."""
    push, i, n, t, f = C.push[k], C.piece[k], B.normal, B.drag, B.work[1]
    up_to(B, P, edge, n)
    for j in range(FUNCTIONS):
        t[j] = push * n[j]  # ∫ o′ beyond the front
    if i != NONE:
        add(t, 1.0, B.up_to_start[i])
        if C.kind[i] == GROWN:
            running(B, 1 + i, front, f)
            add(t, 1.0, f)
        jump = C.slope[i] - push
        if jump != 0.0:
            if front < edge:
                up_to(B, P, front, f)
                add(t, jump, f)
            else:
                add(t, jump, n)
    pressure, friction = 1.0 / pi, sign * Q.friction / pi
    for j in range(FUNCTIONS):
        n[j] *= pressure
        t[j] *= friction
    components(P.plane, n, t, B.x, B.y, B.z, Q.poisson_ratio, out, other)


@jit
def stress_of_state(B, C, P, Q, k, edge, front, sign, bulk, out, other):
    """Write the stress in stretch k with its edge and front at these places s.

    Parameters
    ----------
    sign
        -1 in the mirrored half of the cycle, else 1.
    bulk
        The bulk stress along x, of plane strain in a plane contact.
    other
        The same under the opposite shear: of a mirrored load half a cycle later.
    """
    if C.push[k] == OPEN or edge <= 0.0:
        for j in range(6):
            out[j], other[j] = 0.0, 0.0
    elif B.shift != 0.0:
        shifted_stress(B, C, P, Q, k, edge, front, sign, out, other)
    else:
        centred_stress(B, C, P, Q, k, edge, front, sign, out, other)
    out[0] += bulk
    other[0] += bulk
    if P.plane:
        out[1] += Q.poisson_ratio * bulk
        other[1] += Q.poisson_ratio * bulk


@jit
def stress_field(B, C, R, P, L, Q, places, time, largest, out):
    """Write the stress at places (n, 3) and instants (m,) of the cycle, shape (n, m, 6)."""
    m = time.shape[0]
    stretch, sign, state, bulk = np.empty(m, np.int64), np.empty(m), np.empty((m, 2)), np.empty(m)
    for i in range(m):
        k, t, sign[i] = find_stretch(C, L, time[i])
        stretch[i], bulk[i] = k, bulk_at(L, t)
        state[i, 0], state[i, 1] = solved_places(C, P, L, k, t)
    for p in range(places.shape[0]):
        open_place(B, C, R, P, Q, places[p, 0], places[p, 1], places[p, 2], largest)
        if B.overflow:
            return
        for i in range(m):
            own = stretch[i], state[i, 0], state[i, 1], sign[i], bulk[i]
            stress_of_state(B, C, P, Q, *own, out[p, i], B.other)


@jit
def edges(P, L, time, radius):
    """Write the contact radius at instants."""
    for i in range(time.shape[0]):
        n = load_at(L, time[i])[0]
        radius[i] = radius_of(P, place_of(P, n)) if n > 0.0 else 0.0
