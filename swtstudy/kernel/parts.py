"""The parts of a load cycle at one place, and the instants at which its stress is sampled.

Within a stretch of the cycle the stress at a place is smooth, except where the edge or the slip front passes:
there it has a root cusp in time. So a stretch has up to three parts. Each part has its instants at Lobatto
points of a variable in which root cusps at its ends are smooth. Its series dies out exponentially.

Parts and instants are laid out here. The stress at new instants is written by `swtstudy.kernel.history` on
the surface line, and by `swtstudy.kernel.body` elsewhere.
"""

from math import hypot, pi

import numpy as np

from swtstudy.kernel.chebyshev import FINEST, LOBATTO
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.contact import ALPHA, NONE, OPEN, SHORTEST, STICK, offset
from swtstudy.kernel.growth import places_at
from swtstudy.kernel.load import DIFFERENCE, NORMAL, SUM, instant_of
from swtstudy.kernel.profile import coordinate_at
from swtstudy.kernel.shift import centre_of

MAX_INSTANTS, MAX_PARTS = 300_011, 32_771
#: Intervals of a part at first.
COARSEST = np.int64(4)
#: A short side of a polygon moves edge and front by at most this share of the contact.
SHORT = 0.05
#: Instants are kept free for one round of doubled parts, and for three maxima between instants.
ROOM = 2 * FINEST + 5
#: Fields of a record of parts.
OF_PARTS = [
    *fields("i8", "instants parts"),
    ("written", "i8"),  # instants whose stress is written
    *fields("f8", "x X"),  # the place, and √|x² - b²|
    ("G", "f8"),  # coordinate of the spring at x; negative on the face, infinite far outside
    ("all_outside", "i8"),
    ("shift", "f8"),  # of the stick zone, towards x
    *fields("f8", "load reach"),  # coordinate and place of the edge; constant where there is a shift
    *fields("f8", "front_G front_X"),  # coordinate and place of the stick zone that ends at x
    *fields("i8", "stretch first intervals", (MAX_PARTS,)),  # of a part; its first instant
    ("mirror", "i8", (MAX_PARTS,)),  # 1: of the mirrored half of the cycle
    ("cusps", "i8", (MAX_PARTS,)),  # 0 none, 1 at its begin, 2 at its end, 3 both
    ("time", "f8", (MAX_PARTS, 2)),
    ("places", "f8", (MAX_PARTS, 2, 2)),  # s of edge and front, at begin and end
    ("marked", "i8", (MAX_PARTS,)),  # 1: parts to be refined
    *fields("i8", "part known", (MAX_INSTANTS,)),  # of an instant; an earlier one with its stress, or NONE
    ("instant", "f8", (MAX_INSTANTS,)),
    ("state", "f8", (MAX_INSTANTS, 2)),  # s of edge and front
    ("weight", "f8", (FINEST + 1,)),
]


def _spaced():
    """Shape (4, FINEST + 1): instants on [-1, 1] of a part with cusps at none, begin, end, both."""
    y = LOBATTO
    return np.array([y, 0.5 * (1 + y) ** 2 - 1, 1 - 0.5 * (1 - y) ** 2, np.sin(0.5 * pi * y)])


SPACED = _spaced()


@jit
def begin_parts(H, C, P, place, x, y, largest, shift):
    """Prepare parts at (x, y), with the place s of the springs there; no part yet.

    Parameters
    ----------
    place
        Not positive if no spring is there.
    largest
        Place s of the largest contact.
    shift
        Of the stick zone, towards x.
    """
    H.instants, H.written, H.parts = 0, 0, 0
    H.G = -1.0 if place <= 0.0 else coordinate_at(P, place) if place <= largest else np.inf
    H.x, H.X, H.all_outside = x, abs(place), 1 if place <= 0.0 else 0
    H.shift, H.load, H.reach = shift, C.largest, largest
    find_passing(H, P, x, y)


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
        if hypot(x - centre_of(P, H.shift, H.load, H.reach, s), y) > s:
            low = s
        else:
            high = s
    H.front_G, H.front_X = coordinate_at(P, high), high


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
def add_instant(H, z, t, edge, front, known):
    """A new instant of part z with its edge and front at these places s."""
    m = H.instants
    H.part[m], H.instant[m], H.state[m, 0], H.state[m, 1], H.known[m] = z, t, edge, front, known
    H.instants += 1


@jit
def sample(H, z, intervals, C, P, L):
    """Sample part z at the Lobatto points of so many intervals; it may have some of these instants."""
    k, cusps = H.stretch[z], H.cusps[z]
    begin, end = H.time[z, 0], H.time[z, 1]
    whole = cusps == 0 and begin == C.time[k, 0] and end == C.time[k, 1] and intervals <= C.intervals[k]
    old, known, step = H.first[z], H.intervals[z], FINEST // intervals
    H.first[z], H.intervals[z] = H.instants, intervals
    for j in range(intervals + 1):
        t = begin + 0.5 * (end - begin) * (SPACED[cusps, j * step] + 1.0)
        if known > 0 and j * known % intervals == 0:
            add_instant(H, z, t, 0.0, 0.0, old + j * known // intervals)
            continue
        if j == 0 or j == intervals:
            edge, front = H.places[z, j // intervals, 0], H.places[z, j // intervals, 1]
        elif whole:
            edge, front = C.place[k, j * step, 0], C.place[k, j * step, 1]
        else:
            edge, front = places_at(C, P, L, k, t, H.weight)
        add_instant(H, z, t, edge, front, NONE)


@jit
def refine(H, z, C, P, L):
    """Double the intervals of part z, or give it some if only its ends are known; cut the finest in two."""
    if H.intervals[z] < FINEST:
        sample(H, z, max(2 * H.intervals[z], COARSEST), C, P, L)
        return
    k, begin, end = H.stretch[z], H.time[z, 0], H.time[z, 1]
    t = begin + 0.5 * (end - begin) * (SPACED[H.cusps[z], FINEST // 2] + 1.0)
    edge, front = places_at(C, P, L, k, t, H.weight)
    y = add_part(H, k, t, end, edge, H.places[z, 1, 0], front, H.places[z, 1, 1], H.cusps[z] & 2)
    H.mirror[y] = H.mirror[z]
    H.time[z, 1], H.cusps[z], H.intervals[z] = t, H.cusps[z] & 1, 0
    H.places[z, 1, 0], H.places[z, 1, 1] = edge, front
    sample(H, z, FINEST // 2, C, P, L)
    sample(H, y, FINEST // 2, C, P, L)


@jit
def refine_marked(H, C, P, L, count):
    """Refine the marked parts, as many as told; returns whether there was one, and room for them."""
    if count == 0 or H.instants + count * ROOM > MAX_INSTANTS or H.parts + count >= MAX_PARTS:
        return False
    for z in range(H.parts):
        if H.marked[z]:
            refine(H, z, C, P, L)
    return True


@jit
def may_be_refined(H, C, z):
    """True if part z can be sampled more closely: it is not yet as short as rounding."""
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
def approaches(G, at_begin, at_end):
    """1 if a motion between two coordinates begins near G, 2 if it ends near G, 3 if both, else 0."""
    near = 0.25 * abs(at_end - at_begin)
    return (1 if abs(at_begin - G) <= near else 0) + (2 if abs(at_end - G) <= near else 0)


@jit
def split(H, C, P, L, k):
    """Append the parts of stretch k: it is cut where its edge and its front pass x."""
    begin, end = C.time[k, 0], C.time[k, 1]
    push, i, G = C.push[k], C.piece[k], H.G
    edge, front = C.place[k, 0, 0], C.place[k, 0, 1]
    edge_end, front_end = C.place[k, FINEST, 0], C.place[k, FINEST, 1]
    if push == OPEN:
        add_part(H, k, begin, end, edge, edge_end, front, front_end, 0)
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
    t, cusps = begin, near & 1
    for stop in (min(at_edge, at_front), max(at_edge, at_front), end):
        if stop - t < SHORTEST:
            continue
        e, f = edge_end, front_end
        if stop < end:
            e, f = places_at(C, P, L, k, stop, H.weight)
            if stop == at_edge:
                e = H.X
            if stop == at_front or (stop == at_edge and push == STICK):
                f = H.front_X
        add_part(H, k, t, stop, edge, e, front, f, cusps | (2 if stop < end or near & 2 else 0))
        t, edge, front, cusps = stop, e, f, 1


@jit
def lay_parts(H, C, P, L, coarsest):
    """Lay out all parts of the cycle, coarsely; the mirror image of half a cycle is the other half."""
    for k in range(C.stretches):
        if 2 * (H.parts + 7) >= MAX_PARTS or 2 * (H.instants + ROOM) >= MAX_INSTANTS:
            C.overflow = 1
            return
        before, begin, end = H.parts, C.time[k, 0], C.time[k, 1]
        if is_calm(H, C, L, k):
            near = approaches(H.G, C.edge[k, 0], C.edge[k, 1])
            near |= approaches(H.front_G, C.front[k, 0], C.front[k, 1])
            first, last = C.place[k, 0], C.place[k, FINEST]
            z = add_part(H, k, begin, end, first[0], last[0], first[1], last[1], near)
            if k == 0 or abs(begin - C.time[k - 1, 1]) > SHORTEST * L.period:  # else the part before has it
                add_instant(H, z, begin, first[0], first[1], NONE)
            H.first[z], H.intervals[z] = H.instants - 1, 1
            add_instant(H, z, end, last[0], last[1], NONE)
            continue
        split(H, C, P, L, k)
        for z in range(before, H.parts):
            if H.intervals[z] == 0:
                sample(H, z, coarsest, C, P, L)
    if L.mirrored:
        parts, instants = H.parts, H.instants
        for y in range(parts):
            begin, end = H.places[y, 0], H.places[y, 1]
            own = begin[0], end[0], begin[1], end[1], H.cusps[y]
            z = add_part(H, H.stretch[y], H.time[y, 0], H.time[y, 1], *own)
            H.mirror[z], H.intervals[z], H.first[z] = 1, H.intervals[y], H.first[y] + instants
        for i in range(instants):
            add_instant(H, H.part[i] + parts, H.instant[i], H.state[i, 0], H.state[i, 1], i)
