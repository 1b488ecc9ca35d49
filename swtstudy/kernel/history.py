"""The stress cycle at one position of the surface line, at instants from which it can be interpolated.

Within a stretch of the cycle the stress at x is smooth but where the edge or the slip front passes x: there
it has a root cusp in time. So a stretch has up to three parts at x. Each part has its instants at Lobatto
points of a variable in which root cusps at its ends are smooth; its series dies out exponentially.
"""

from math import hypot, pi, sqrt

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, LOBATTO
from swtstudy.kernel.compiled import jit
from swtstudy.kernel.contact import ALPHA, GROWN, MAX_PIECES, NONE, OPEN, SHORTEST, STICK, offset
from swtstudy.kernel.growth import places_at, solved_places
from swtstudy.kernel.load import DIFFERENCE, NORMAL, SUM, bulk_at, distinct, instant_of
from swtstudy.kernel.profile import coordinate_at, force_at
from swtstudy.kernel.shift import centre_of
from swtstudy.kernel.surface import MAX_TABLES, hertz, running, strip_hertz, tabulate

MAX_INSTANTS, MAX_PARTS = 300_011, 32_771
#: Intervals of a part at first.
#: Row and panel of the profile in the tables at x; no literal, for which Numba would compile anew.
FIRST = np.int64(0)
COARSEST = np.int64(4)
#: A short side of a polygon moves edge and front by at most this share of the contact.
SHORT = 0.05
#: A part of which the two ends are all.
MONOTONE = np.int64(-1)
#: Nearer to the edge of a face than this share of where the front begins, a passage has no time of its own.
NEXT_TO_FACE = 1e-3
#: Widths of the slip zone within which a passage has a part of its own.
NARROW = 30.0
#: Instants are kept free for one round of doubled parts.
ROOM = 2 * FINEST + 2
HISTORY = np.dtype(
    [
        ("instants", "i8"),
        ("parts", "i8"),
        ("x", "f8"),
        ("X", "f8"),  # √|x² - b²|
        ("G", "f8"),  # coordinate of the spring at x; negative on the face, infinite far outside
        ("all_outside", "i8"),
        ("shift", "f8"),  # of the stick zone, towards x
        ("load", "f8"),  # coordinate and place of the edge; constant where there is a shift
        ("reach", "f8"),
        ("front_G", "f8"),  # coordinate and place of the stick zone that ends at x
        ("front_X", "f8"),
        ("plane", "i8"),
        ("stretch", "i8", (MAX_PARTS,)),
        ("first", "i8", (MAX_PARTS,)),  # its first instant
        ("intervals", "i8", (MAX_PARTS,)),
        ("mirror", "i8", (MAX_PARTS,)),  # 1: of the mirrored half of the cycle
        ("cusps", "i8", (MAX_PARTS,)),  # 0 none, 1 at its begin, 2 at its end, 3 both
        ("time", "f8", (MAX_PARTS, 2)),
        ("places", "f8", (MAX_PARTS, 2, 2)),  # s of edge and front, at begin and end
        ("weight", "f8", (FINEST + 1,)),
        ("cut", "f8", (9,)),  # instants at which a stretch is cut
        ("p", "f8", (MAX_INSTANTS,)),  # pressure
        ("within", "f8", (MAX_INSTANTS,)),  # (1-2ν) P/(2πx²), P the load within x
        ("xx", "f8", (MAX_INSTANTS,)),  # of the tangential load, at +x
        ("yy", "f8", (MAX_INSTANTS,)),
        ("q", "f8", (MAX_INSTANTS,)),
        ("bulk", "f8", (MAX_INSTANTS,)),  # B, in σ_xx on both sides
        (
            "up_to_start",
            "f8",
            (MAX_PIECES, 3),
        ),  # ∫ (do/dG - its own slope) up to the start of a piece: T1, T3, B
    ]
)


def _spaced():
    """Shape (4, FINEST + 1): instants on [-1, 1] of a part with cusps at none, begin, end, both."""
    y = LOBATTO
    return np.array([y, 0.5 * (1 + y) ** 2 - 1, 1 - 0.5 * (1 - y) ** 2, np.sin(0.5 * pi * y)])


SPACED = _spaced()


@jit
def centre(P, H, s):
    """Centre of the stick zone of size s, towards x."""
    return centre_of(P, H.shift, H.load, H.reach, s)


@jit
def find_passing(H, P, x, y):
    """Note the stick zone that ends at (x, y): the smaller ones do not reach it."""
    H.front_G, H.front_X = H.G, H.X
    if H.shift == 0.0 or H.G < 0.0:
        return
    low, high = 0.0, H.reach
    if hypot(x, y) >= high:
        H.front_G = np.inf
        return
    for _ in range(60):
        s = 0.5 * (low + high)
        if hypot(x - centre(P, H, s), y) > s:
            low = s
        else:
            high = s
    H.front_G, H.front_X = coordinate_at(P, high), high


@jit
def functionals(P, K, s, H):
    """T1, T3, B, V of the profile up to s, about the centre of the stick zone of this size."""
    if P.is_hertz and H.shift == 0.0:
        return strip_hertz(s, H.x) if P.plane else hertz(s, H.x)
    if P.is_hertz:
        x = H.x - centre(P, H, s)
        t1, t3, b, v = strip_hertz(s, abs(x)) if P.plane else hertz(s, abs(x))
        return (t1, t3, b, v) if x >= 0.0 else (-t1, -t3, b, v)
    return running(K, FIRST, s, H.X, H.all_outside)


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
        H.up_to_start[i, 0], H.up_to_start[i, 1], H.up_to_start[i, 2] = (
            o1 + jump * t1,
            o3 + jump * t3,
            ob + jump * b1,
        )


@jit
def stress(H, m, C, P, K, k, edge, front, nu, mu):
    """Write instant m: the stress at x in stretch k with its edge and front at these places s.

    Pressure and σ_xx of the normal load and of the tangential load are the sums of section 3 of the paper
    over the pieces of the diagram, each a slope times a running integral. In plane strain
    σ_yy = ν (σ_xx + σ_zz).
    """
    push, i = C.push[k], C.piece[k]
    if push == OPEN or edge <= 0.0:
        H.p[m], H.within[m], H.xx[m], H.yy[m], H.q[m] = 0.0, 0.0, 0.0, 0.0, 0.0
        return
    n1, n3, nb, nv = functionals(P, K, edge, H)
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
    friction = mu / pi
    H.p[m], H.q[m] = nb / pi, friction * ob
    if P.plane:
        H.within[m], H.xx[m], H.yy[m] = 0.0, -friction * o1, -friction * nu * o1
        return
    if H.all_outside == 0:
        nv += force_at(P, min(edge, H.X)) / (H.x * H.x)
    H.within[m] = (1.0 - 2.0 * nu) / pi * nv
    H.xx[m] = -friction * ((1.0 + nu) * o1 - nu * o3)
    H.yy[m] = -friction * nu * o3


@jit
def sample(H, z, intervals, C, P, L, K, nu, mu):
    """Sample part z at the Lobatto points of so many intervals; known instants are copied."""
    k, cusps = H.stretch[z], H.cusps[z]
    begin, end = H.time[z, 0], H.time[z, 1]
    whole = cusps == 0 and begin == C.time[k, 0] and end == C.time[k, 1] and intervals <= C.intervals[k]
    old, known = H.first[z], H.intervals[z]
    m = H.instants
    step = FINEST // intervals
    for j in range(intervals + 1):
        if known > 0 and j * known % intervals == 0:
            i = old + j * known // intervals
            sign = -1.0 if H.mirror[z] else 1.0
            H.p[m + j], H.within[m + j] = H.p[i], H.within[i]
            H.xx[m + j], H.yy[m + j], H.q[m + j] = sign * H.xx[i], sign * H.yy[i], sign * H.q[i]
            H.bulk[m + j] = H.bulk[i]
            continue
        t = begin + 0.5 * (end - begin) * (SPACED[cusps, j * step] + 1.0)
        H.bulk[m + j] = bulk_at(L, t)
        if j == 0 or j == intervals:
            edge, front = H.places[z, j // intervals, 0], H.places[z, j // intervals, 1]
        elif whole:
            edge, front = C.place[k, j * step, 0], C.place[k, j * step, 1]
        else:
            edge, front = places_at(C, P, L, k, t, H.weight)
        stress(H, m + j, C, P, K, k, edge, front, nu, mu)
    H.first[z], H.intervals[z] = m, intervals
    H.instants = m + intervals + 1
    if H.mirror[z]:
        flip(H, m, H.instants, m)


@jit
def flip(H, a, b, to):
    """Copy instants a to b to where the mirrored load has them: the tangential stress changes its sign."""
    for i in range(b - a):
        H.p[to + i], H.within[to + i] = H.p[a + i], H.within[a + i]
        H.xx[to + i], H.yy[to + i], H.q[to + i] = -H.xx[a + i], -H.yy[a + i], -H.q[a + i]
        H.bulk[to + i] = H.bulk[a + i]  # constant in a mirrored load


@jit
def refine(H, z, C, P, L, K, nu, mu):
    """Double the intervals of part z, or give it some if only its ends are known; cut the finest in two."""
    if H.intervals[z] < FINEST:
        sample(H, z, max(2 * H.intervals[z], COARSEST), C, P, L, K, nu, mu)
        return
    k, begin, end = H.stretch[z], H.time[z, 0], H.time[z, 1]
    t = begin + 0.5 * (end - begin) * (SPACED[H.cusps[z], FINEST // 2] + 1.0)
    edge, front = places_at(C, P, L, k, t, H.weight)
    y = add_part(H, k, t, end, edge, H.places[z, 1, 0], front, H.places[z, 1, 1], H.cusps[z] & 2)
    H.mirror[y] = H.mirror[z]
    H.time[z, 1], H.cusps[z], H.intervals[z] = t, H.cusps[z] & 1, 0
    H.places[z, 1, 0], H.places[z, 1, 1] = edge, front
    sample(H, z, FINEST // 2, C, P, L, K, nu, mu)
    sample(H, y, FINEST // 2, C, P, L, K, nu, mu)


@jit
def may_be_refined(H, C, z):
    """True if part z can be sampled more closely: it is not yet as short as rounding."""
    if H.cusps[z] == MONOTONE:
        return False
    shortest = max(1e-6 * (H.time[z, 1] - C.time[0, 0]), SHORTEST)
    return H.intervals[z] < FINEST or (H.parts + 1 < MAX_PARTS and H.time[z, 1] - H.time[z, 0] > shortest)


@jit
def is_calm(H, C, L, k):
    """True if stretch k is short, on a straight side, and neither its edge nor its front passes x.

    Then stresses are next to monotone, and its ends tell how much higher they can be.
    """
    if L.sides == 0 or C.push[k] == OPEN:
        return False
    e0, e1 = C.edge[k, 0] - H.G, C.edge[k, 1] - H.G
    f0, f1 = C.front[k, 0] - H.front_G, C.front[k, 1] - H.front_G
    moved = max(abs(e1 - e0), abs(f1 - f0))
    return moved <= SHORT * C.largest and e0 * e1 > 0.0 and (f0 * f1 > 0.0 or C.push[k] == STICK)


@jit
def sample_ends(H, C, P, L, K, k, nu, mu):
    """A part for stretch k of which only the ends are sampled; they are shared with the part before."""
    edge, front = C.place[k, 0, 0], C.place[k, 0, 1]
    edge_end, front_end = C.place[k, FINEST, 0], C.place[k, FINEST, 1]
    near = approaches(H.G, C.edge[k, 0], C.edge[k, 1]) | approaches(H.front_G, C.front[k, 0], C.front[k, 1])
    z = add_part(H, k, C.time[k, 0], C.time[k, 1], edge, edge_end, front, front_end, near)
    m = H.instants
    if k > 0 and abs(C.time[k, 0] - C.time[k - 1, 1]) <= SHORTEST * L.period:
        m -= 1
    else:
        stress(H, m, C, P, K, k, edge, front, nu, mu)
        H.bulk[m] = bulk_at(L, C.time[k, 0])
    stress(H, m + 1, C, P, K, k, edge_end, front_end, nu, mu)
    H.bulk[m + 1] = bulk_at(L, C.time[k, 1])
    H.first[z], H.intervals[z], H.instants = m, 1, m + 2


@jit
def approaches(G, at_begin, at_end):
    """1 if a motion between two coordinates begins near G, 2 if it ends near G, 3 if both, else 0."""
    near = 0.25 * abs(at_end - at_begin)
    return (1 if abs(at_begin - G) <= near else 0) + (2 if abs(at_end - G) <= near else 0)


@jit
def add_part(H, k, begin, end, edge_begin, edge_end, front_begin, front_end, cusps):
    """A new part of stretch k, not yet sampled; returns its index."""
    z = H.parts
    H.parts += 1
    H.stretch[z], H.mirror[z], H.intervals[z], H.cusps[z] = k, 0, 0, cusps
    H.time[z, 0], H.time[z, 1] = begin, end
    H.places[z, 0, 0], H.places[z, 1, 0] = edge_begin, edge_end
    H.places[z, 0, 1], H.places[z, 1, 1] = front_begin, front_end
    return z


@jit
def split_towards_face(H, C, P, K, L, k, nu, mu):
    """Append the parts of stretch k whose front goes to the singular edge of the face, next to which x is.

    The stress goes like the logarithm of the front's place, and the front passes x within rounding of the
    end: the last part has no time of its own. From its begin to the passage the stress is monotone.
    """
    begin, end = C.time[k, 0], C.time[k, 1]
    t, edge, front = begin, C.place[k, 0, 0], C.place[k, 0, 1]
    cusps = approaches(H.G, C.edge[k, 0], C.edge[k, 1]) & 1
    for j in range(1, 12):
        stop = end - (end - begin) / 16.0**j
        e, f = solved_places(C, P, L, k, stop)
        if f <= 16.0 * H.X or f >= front:
            break
        add_part(H, k, t, stop, edge, e, front, f, cusps)
        t, edge, front, cusps = stop, e, f, 0
    z = add_part(H, k, t, end, edge, C.place[k, FINEST, 0], front, H.X, MONOTONE)
    m = H.instants
    stress(H, m, C, P, K, k, edge, front, nu, mu)
    stress(H, m + 1, C, P, K, k, C.place[k, FINEST, 0], H.X, nu, mu)
    H.bulk[m], H.bulk[m + 1] = bulk_at(L, t), bulk_at(L, end)
    H.first[z], H.intervals[z], H.instants = m, 1, m + 2


@jit
def split(H, C, P, K, L, k, nu, mu):
    """Append the parts of stretch k: it is cut where its edge and its front pass x."""
    begin, end = C.time[k, 0], C.time[k, 1]
    push, i, G = C.push[k], C.piece[k], H.G
    edge, front = C.place[k, 0, 0], C.place[k, 0, 1]
    edge_end, front_end = C.place[k, FINEST, 0], C.place[k, FINEST, 1]
    if push == OPEN:
        add_part(H, k, begin, end, edge, edge_end, front, front_end, 0)
        return
    if (
        P.singular
        and push != STICK
        and i != NONE
        and front_end <= 0.0
        and H.all_outside == 0
        and NEXT_TO_FACE * front > H.X
    ):
        split_towards_face(H, C, P, K, L, k, nu, mu)
        return
    at_edge, at_front, near = end, end, approaches(G, C.edge[k, 0], C.edge[k, 1])
    if (C.edge[k, 0] - G) * (C.edge[k, 1] - G) < 0.0:
        at_edge = instant_of(L, NORMAL, G, begin, end)
    if push != STICK and i != NONE:
        G = H.front_G
        near |= approaches(G, C.front[k, 0], C.front[k, 1])
        if (C.front[k, 0] - G) * (C.front[k, 1] - G) < 0.0:
            which = DIFFERENCE if push == ALPHA else SUM
            at_front = instant_of(L, which, offset(C, L, i, G) - push * G, begin, end)
    if C.edge[k, 0] <= 0.0:  # touch-down
        near |= 1
    if C.edge[k, 1] <= 0.0:
        near |= 2
    # Beside a passage the stress changes within the slip zone's width: if that is narrow, in its own part.
    cuts, m = H.cut, 0
    speed = abs(edge_end - edge) / (end - begin)
    for passage in (at_edge, at_front):
        if passage < end:
            cuts[m] = passage
            m += 1
            e, f = places_at(C, P, L, k, passage, H.weight)
            beside = NARROW * abs(e - f) / speed if speed > 0.0 else 0.0
            for t in (passage - beside, passage + beside):
                if 0.0 < beside < 0.25 * (end - begin) and begin + beside < t < end - beside:
                    cuts[m] = t
                    m += 1
    cuts[m] = end
    m = distinct(cuts, m + 1, SHORTEST)
    t, cusps = begin, near & 1
    for j in range(m):
        stop, e, f = cuts[j], edge_end, front_end
        if stop - t < SHORTEST:
            continue
        if stop < end:
            e, f = places_at(C, P, L, k, stop, H.weight)
            if stop == at_edge:
                e = H.X
            if stop == at_front or (stop == at_edge and push == STICK):
                f = H.front_X
        add_part(H, k, t, stop, edge, e, front, f, cusps | (2 if stop < end or near & 2 else 0))
        t, edge, front, cusps = stop, e, f, 1


@jit
def begin_history(H, C, R, P, K, place, largest, side):
    """Prepare a history at place s of the line, still without an instant; parameters as of `sample_cycle`."""
    H.instants, H.parts, H.plane = 0, 0, P.plane
    H.G = -1.0 if place <= 0.0 else coordinate_at(P, place) if place <= largest else np.inf
    H.x = sqrt(P.flat_radius * P.flat_radius + place * abs(place))
    H.X, H.all_outside = abs(place), 1 if place <= 0.0 else 0
    H.shift, H.load, H.reach = side * C.shift, C.largest, largest
    find_passing(H, P, H.x, 0.0)
    integrate_pieces(H, C, R, P, K, largest)


@jit
def sample_cycle(H, C, R, P, K, L, place, largest, nu, mu, side):
    """All parts of the cycle at x, coarsely; the mirror image of half a cycle is the other half.

    Parameters
    ----------
    place
        √(x² - b²), or -√(b² - x²) under the face.
    largest
        Place s of the largest contact.
    side
        1 or -1: towards which side x is, which matters where the stick zone is shifted.
    """
    begin_history(H, C, R, P, K, place, largest, side)
    for k in range(C.stretches):
        if H.parts + 7 >= MAX_PARTS or H.instants + ROOM >= MAX_INSTANTS:
            C.overflow = 1
            return
        if is_calm(H, C, L, k):
            sample_ends(H, C, P, L, K, k, nu, mu)
            continue
        before = H.parts
        split(H, C, P, K, L, k, nu, mu)
        for z in range(before, H.parts):
            if H.intervals[z] == 0:
                sample(H, z, COARSEST, C, P, L, K, nu, mu)
    if L.mirrored:
        parts, instants = H.parts, H.instants
        for y in range(parts):
            z = H.parts
            H.parts += 1
            H.stretch[z], H.mirror[z], H.cusps[z], H.intervals[z] = (
                H.stretch[y],
                1,
                H.cusps[y],
                H.intervals[y],
            )
            H.first[z] = H.first[y] + instants
            H.time[z, 0], H.time[z, 1] = H.time[y, 0], H.time[y, 1]
            for e in range(2):
                H.places[z, e, 0], H.places[z, e, 1] = H.places[y, e, 0], H.places[y, e, 1]
        flip(H, 0, instants, instants)
        H.instants = 2 * instants
