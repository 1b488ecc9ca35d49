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

BELOW = np.dtype(
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
def set_place(below, profile, x, y, z):
    """Note a place, and where the functions are singular in s."""
    r = abs(x) if profile.plane else hypot(x, y)
    below.x, below.y, below.z, below.r, below.overflow = x, y, z, r, 0
    b = profile.flat_radius
    real, imaginary = (r - b) * (r + b) - z * z, 2.0 * r * z
    below.sigma, below.omega = upper_root(real, imaginary)
    if below.omega <= SHALLOW * below.sigma:
        below.omega = 0.0
    if below.sigma == 0.0 and below.omega == 0.0:  # the axis, or the edge of the face, in the surface
        below.omega = NEXT_TO_AXIS


@jit
def variable(below, kind, s):
    """The variable u of a kind of cells at s."""
    if kind == BENEATH:
        return asinh((s - below.sigma) / below.omega)
    if kind == INSIDE:
        return asin(min(s / below.sigma, 1.0))
    return acosh(s / below.sigma)


@jit
def cell_end(below, b, exponent, low, end):
    """Where the cell from `low` on ends, `end` at most."""
    longest = LONGEST
    high = end
    if exponent > 1.0:
        next_to_nothing = below.reach * NOTHING ** (1.0 / exponent)
        high = min(high, max(low * exp(STEEPEST / (exponent - 1.0)), next_to_nothing))
    if below.omega > 0.0:
        high = min(high, below.sigma + below.omega * sinh(asinh((low - below.sigma) / below.omega) + longest))
    elif low >= below.sigma:
        high = min(high, below.sigma * cosh(acosh(low / below.sigma) + 2.0 * longest))
    else:
        high = inside_end(low, min(end, below.sigma), below.sigma)
    if b > 0.0:
        high = min(high, low + BESIDE_FACE * sqrt(b * b + low * low))
    # No sliver is left over.
    return end if high > low + 0.9 * (end - low) and (below.omega > 0.0 or low >= below.sigma) else high


@jit_reordered
def tabulate_cell(below, k, plane, exponent, density, begin, end, low, high, b, total):
    """Cell k: running integrals of a panel's density times the functions, added to the total up to there.

    The density of ξⁿ has no series at the axis: its exponent n is told, else 0.
    """
    kind = BENEATH if below.omega > 0.0 else INSIDE if high <= below.sigma else OUTSIDE
    u0, u1 = variable(below, kind, low), variable(below, kind, high)
    half, width = 0.5 * (u1 - u0), 2.0 / (end - begin)
    f, here = below.work[0], below.series[k]
    below.begin[k], below.kind[k], below.scale[k, 0], below.scale[k, 1] = low, kind, u0, 1.0 / half
    for c in range(ORDER + 1):
        for j in range(FUNCTIONS):
            here[c, j] = 0.0
    for i in range(ORDER):
        u = u0 + half * (GAUSS[i] + 1.0)
        if kind == BENEATH:
            s, rate = below.sigma + below.omega * sinh(u), below.omega * cosh(u)
        elif kind == INSIDE:
            s, rate = below.sigma * sin(u), below.sigma * cos(u)
        else:
            s, rate = below.sigma * cosh(u), below.sigma * sinh(u)
        weight = half * rate
        if exponent > 0.0:
            weight *= exponent * max(s, 0.0) ** (exponent - 1.0) * (MEAN_LOAD if plane else 1.0)
        else:
            weight *= clenshaw(density, (s - begin) * width - 1.0)
        if plane:
            strip(below.r, below.z, sqrt(b * b + s * s), f)
        else:
            disc(below.r, below.z, sqrt(b * b + s * s), f)
        for c in range(ORDER + 1):
            part = weight * RUN[c, i]
            for j in range(FUNCTIONS):
                here[c, j] += part * f[j]
    for j in range(FUNCTIONS):
        before = total[j]
        for c in range(ORDER + 1):
            total[j] += here[c, j]
        here[0, j] += before


@jit
def tabulate(below, row, k, plane, exponent, begin, end, density, p0, p1, top, b):
    """Tabulate panels p0 to p1 of a density up to s = top, from cell k on; returns the next free cell."""
    below.first[row] = k
    total = below.total[row]
    for j in range(FUNCTIONS):
        total[j] = 0.0
    for p in range(p0, p1):
        low = begin[p]
        if low >= top:
            break
        while low < end[p]:
            if k + 1 >= MAX_CELLS:
                below.overflow = 1
                return k
            high = cell_end(below, b, exponent, low, end[p])
            tabulate_cell(below, k, plane, exponent, density[p], begin[p], end[p], low, high, b, total)
            k += 1
            low = high
    below.last[row] = k
    return k


@jit_reordered
def running(below, row, s, f):
    """Write the running integrals of a density up to s."""
    first, last = below.first[row], below.last[row]
    if first == last or s <= below.begin[first]:
        for j in range(FUNCTIONS):
            f[j] = 0.0
        return
    k = panel_of(below.begin, first, last, s)
    y = min((variable(below, below.kind[k], s) - below.scale[k, 0]) * below.scale[k, 1] - 1.0, 1.0)
    here = below.series[k]
    for j in range(FUNCTIONS):
        f[j] = here[0, j] + y * here[1, j]
    t0, t1 = 1.0, y
    for c in range(2, ORDER + 1):
        t0, t1 = t1, 2.0 * y * t1 - t0
        for j in range(FUNCTIONS):
            f[j] += t1 * here[c, j]


@jit
def up_to(below, profile, s, f):
    """Write the running integrals of the profile's density up to s."""
    if profile.is_hertz == 0:
        running(below, FIRST, s, f)
        return
    if profile.plane:
        strip_moments(below.r, below.z, s, f)
    else:
        disc_moments(below.r, below.z, s, f)
    for j in range(FUNCTIONS):
        f[j] -= below.at_axis[j]


@jit
def add(to, factor, f):
    """Add a multiple of some functions to others."""
    for j in range(FUNCTIONS):
        to[j] += factor * f[j]


@jit
def drag_of(below, profile, ask, s):
    """Write the stress by Hertz's traction on the stick zone of size s about its own centre, times π."""
    d, f, z = centre_of(profile, below.shift, below.load, below.reach, s), below.work[1], below.z
    x = below.x - d
    if profile.plane:
        strip_moments(abs(x), z, s, f)
        f[0] += 0.5 * pi * abs(x)  # less those of size 0
        f[1] += 0.5 * pi * z
        f[2] += 0.5 * pi * z
    else:
        disc_moments(hypot(x, below.y), z, s, f)
    both = below.one_drag[0], below.one_drag[1]
    components(profile.plane, below.nothing, f, x, below.y, z, ask.poisson_ratio, *both)


@jit
def add_drag(below, profile, ask, s, factor, to):
    """Add a multiple of the stress by the traction on a stick zone."""
    if factor == 0.0 or s <= 0.0:
        return
    drag_of(below, profile, ask, s)
    for c in range(6):
        to[c] += factor * below.one_drag[0, c]


@jit
def open_drags(below, cycle, profile, ask):
    """Sum the stress by the pieces up to the start of each."""
    for j in range(FUNCTIONS):
        below.nothing[j] = 0.0
    for i in range(cycle.pieces):
        if cycle.used[i] == 0:
            continue
        beneath, sums, jump = cycle.beneath[i], below.drag_to_start[i], -cycle.slope[i]
        for c in range(6):
            sums[c] = 0.0 if beneath == NONE else below.drag_to_start[beneath, c]
        if beneath != NONE:
            jump += cycle.slope[beneath]
        add_drag(below, profile, ask, cycle.start_s[i], jump, sums)


@jit
def shifted_stress(below, cycle, profile, ask, k, edge, front, sign, out, other):
    """`centred_stress` where the stick zone is shifted: stresses of pressure and of drag on their own."""
    push, i = cycle.push[k], cycle.piece[k]
    up_to(below, profile, edge, below.normal)
    at = below.x, below.y, below.z
    components(profile.plane, below.normal, below.nothing, *at, ask.poisson_ratio, out, other)
    drag = below.one_drag[2]
    for c in range(6):
        drag[c] = 0.0 if i == NONE else below.drag_to_start[i, c]
    slope = push if i == NONE else cycle.slope[i]
    if front < edge:
        add_drag(below, profile, ask, front, slope - push, drag)
        slope = push
    add_drag(below, profile, ask, edge, slope, drag)
    for c in range(6):
        pressure, shear = out[c] / pi, sign * ask.friction / pi * drag[c]
        out[c], other[c] = pressure + shear, pressure - shear


@jit
def open_place(below, cycle, growth, profile, ask, x, y, z, largest):
    """Tabulate the densities at a place, and ∫ o′ times the functions up to the start of each piece.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    """
    set_place(below, profile, x, y, z)
    below.shift, below.load, below.reach = cycle.shift, cycle.largest, largest
    k, plane, b = FIRST, profile.plane, profile.flat_radius
    for j in range(FUNCTIONS):
        below.work[0, j], below.at_axis[j] = 0.0, 0.0
    if profile.is_hertz == 0:
        panels = profile.begin[:], profile.end[:], profile.density[:]
        k = tabulate(below, FIRST, k, plane, profile.exponent, *panels, FIRST, profile.panels, largest, b)
    elif plane:
        strip_moments(below.r, z, 0.0, below.at_axis)
    else:
        disc_moments(below.r, z, 0.0, below.at_axis)
    if below.shift != 0.0:
        open_drags(below, cycle, profile, ask)
        return
    f = below.work[1]
    for i in range(cycle.pieces):
        if cycle.used[i] == 0 or below.overflow:
            continue
        if cycle.kind[i] == GROWN:
            panels = growth.begin[:], growth.end[:], growth.density[:]
            k = tabulate(below, 1 + i, k, plane, 0.0, *panels, growth.first[i], growth.last[i], 1e300, b)
        beneath, s, sums = cycle.beneath[i], cycle.start_s[i], below.up_to_start[i]
        jump = -cycle.slope[i]
        for j in range(FUNCTIONS):
            sums[j] = 0.0
        if beneath != NONE:
            jump += cycle.slope[beneath]
            add(sums, 1.0, below.up_to_start[beneath])
            if cycle.kind[beneath] == GROWN:
                running(below, 1 + beneath, s, f)
                add(sums, 1.0, f)
        if jump != 0.0 and s > 0.0:
            up_to(below, profile, s, f)
            add(sums, jump, f)


@jit
def centred_stress(below, cycle, profile, ask, k, edge, front, sign, out, other):
    """`stress_of_state` without the bulk stress, where all springs are about the axis."""
    push, i, n, t, f = cycle.push[k], cycle.piece[k], below.normal, below.drag, below.work[1]
    up_to(below, profile, edge, n)
    for j in range(FUNCTIONS):
        t[j] = push * n[j]  # ∫ o′ beyond the front
    if i != NONE:
        add(t, 1.0, below.up_to_start[i])
        if cycle.kind[i] == GROWN:
            running(below, 1 + i, front, f)
            add(t, 1.0, f)
        jump = cycle.slope[i] - push
        if jump != 0.0:
            if front < edge:
                up_to(below, profile, front, f)
                add(t, jump, f)
            else:
                add(t, jump, n)
    pressure, friction = 1.0 / pi, sign * ask.friction / pi
    for j in range(FUNCTIONS):
        n[j] *= pressure
        t[j] *= friction
    components(profile.plane, n, t, below.x, below.y, below.z, ask.poisson_ratio, out, other)


@jit
def stress_of_state(below, cycle, profile, ask, k, edge, front, sign, bulk, out, other):
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
    if cycle.push[k] == OPEN or edge <= 0.0:
        for j in range(6):
            out[j], other[j] = 0.0, 0.0
    elif below.shift != 0.0:
        shifted_stress(below, cycle, profile, ask, k, edge, front, sign, out, other)
    else:
        centred_stress(below, cycle, profile, ask, k, edge, front, sign, out, other)
    out[0] += bulk
    other[0] += bulk
    if profile.plane:
        out[1] += ask.poisson_ratio * bulk
        other[1] += ask.poisson_ratio * bulk


@jit
def stress_field(body, places, time, largest, out):
    """Write the stress at places (n, 3) and instants (m,) of the cycle, shape (n, m, 6)."""
    below, point, m = body.below, body.point, time.shape[0]
    load, profile, ask, cycle = point.load, point.profile, point.ask, point.cycle
    stretch, sign, state, bulk = np.empty(m, np.int64), np.empty(m), np.empty((m, 2)), np.empty(m)
    for i in range(m):
        k, t, sign[i] = find_stretch(cycle, load, time[i])
        stretch[i], bulk[i] = k, bulk_at(load, t)
        state[i, 0], state[i, 1] = solved_places(cycle, profile, load, k, t)
    for p in range(places.shape[0]):
        x, y, z = places[p, 0], places[p, 1], places[p, 2]
        open_place(below, cycle, point.growth, profile, ask, x, y, z, largest)
        if below.overflow:
            return
        for i in range(m):
            own = stretch[i], state[i, 0], state[i, 1], sign[i], bulk[i]
            stress_of_state(below, cycle, profile, ask, *own, out[p, i], below.other)


@jit
def edges(profile, load, time, radius):
    """Write the contact radius at instants."""
    for i in range(time.shape[0]):
        n = load_at(load, time[i])[0]
        radius[i] = radius_of(profile, place_of(profile, n)) if n > 0.0 else 0.0
