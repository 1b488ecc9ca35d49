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
]


def _spaced():
    """Shape (4, FINEST + 1): instants on [-1, 1] of a part with cusps at none, begin, end, both."""
    y = LOBATTO
    return np.array([y, 0.5 * (1 + y) ** 2 - 1, 1 - 0.5 * (1 - y) ** 2, np.sin(0.5 * pi * y)])


SPACED = _spaced()


@jit
def begin_parts(history, cycle, profile, place, x, y, largest, shift):
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
    history.instants, history.written, history.parts = 0, 0, 0
    history.G = -1.0 if place <= 0.0 else coordinate_at(profile, place) if place <= largest else np.inf
    history.x, history.X, history.all_outside = x, abs(place), 1 if place <= 0.0 else 0
    history.shift, history.load, history.reach = shift, cycle.largest, largest
    find_passing(history, profile, x, y)


@jit
def find_passing(history, profile, x, y):
    """Note the stick zone that ends at (x, y): the smaller ones do not reach it."""
    history.front_G, history.front_X = history.G, history.X
    if history.shift == 0.0 or history.G < 0.0:
        return
    low, high = 0.0, history.reach
    if hypot(x, y) >= high:
        history.front_G = np.inf
        return
    for _ in range(60):
        s = 0.5 * (low + high)
        if hypot(x - centre_of(profile, history.shift, history.load, history.reach, s), y) > s:
            low = s
        else:
            high = s
    history.front_G, history.front_X = coordinate_at(profile, high), high


@jit
def add_part(history, k, begin, end, edge_begin, edge_end, front_begin, front_end, cusps):
    """A new part of stretch k, not yet sampled; returns its index."""
    z = history.parts
    history.parts += 1
    history.stretch[z], history.mirror[z], history.intervals[z], history.cusps[z] = k, 0, 0, cusps
    history.time[z, 0], history.time[z, 1] = begin, end
    history.places[z, 0, 0], history.places[z, 1, 0] = edge_begin, edge_end
    history.places[z, 0, 1], history.places[z, 1, 1] = front_begin, front_end
    return z


@jit
def add_instant(history, z, t, edge, front, known):
    """A new instant of part z with its edge and front at these places s."""
    m = history.instants
    history.part[m], history.instant[m], history.known[m] = z, t, known
    history.state[m, 0], history.state[m, 1] = edge, front
    history.instants += 1


@jit
def sample(history, z, intervals, cycle, profile, load):
    """Sample part z at the Lobatto points of so many intervals; it may have some of these instants."""
    k, cusps = history.stretch[z], history.cusps[z]
    begin, end = history.time[z, 0], history.time[z, 1]
    whole = cusps == 0 and begin == cycle.time[k, 0] and end == cycle.time[k, 1]
    whole = whole and intervals <= cycle.intervals[k]
    old, known, step = history.first[z], history.intervals[z], FINEST // intervals
    history.first[z], history.intervals[z] = history.instants, intervals
    for j in range(intervals + 1):
        t = begin + 0.5 * (end - begin) * (SPACED[cusps, j * step] + 1.0)
        if known > 0 and j * known % intervals == 0:
            add_instant(history, z, t, 0.0, 0.0, old + j * known // intervals)
            continue
        if j == 0 or j == intervals:
            edge, front = history.places[z, j // intervals, 0], history.places[z, j // intervals, 1]
        elif whole:
            edge, front = cycle.place[k, j * step, 0], cycle.place[k, j * step, 1]
        else:
            edge, front = places_at(cycle, profile, load, k, t)
        add_instant(history, z, t, edge, front, NONE)


@jit
def refine(history, z, cycle, profile, load):
    """Double the intervals of part z, or give it some if only its ends are known; cut the finest in two."""
    if history.intervals[z] < FINEST:
        sample(history, z, max(2 * history.intervals[z], COARSEST), cycle, profile, load)
        return
    k, begin, end = history.stretch[z], history.time[z, 0], history.time[z, 1]
    t = begin + 0.5 * (end - begin) * (SPACED[history.cusps[z], FINEST // 2] + 1.0)
    edge, front = places_at(cycle, profile, load, k, t)
    last = history.places[z, 1]
    y = add_part(history, k, t, end, edge, last[0], front, last[1], history.cusps[z] & 2)
    history.mirror[y] = history.mirror[z]
    history.time[z, 1], history.cusps[z], history.intervals[z] = t, history.cusps[z] & 1, 0
    history.places[z, 1, 0], history.places[z, 1, 1] = edge, front
    sample(history, z, FINEST // 2, cycle, profile, load)
    sample(history, y, FINEST // 2, cycle, profile, load)


@jit
def refine_marked(history, cycle, profile, load, count):
    """Refine the marked parts, as many as told; returns whether there was one, and room for them."""
    if count == 0 or history.instants + count * ROOM > MAX_INSTANTS or history.parts + count >= MAX_PARTS:
        return False
    for z in range(history.parts):
        if history.marked[z]:
            refine(history, z, cycle, profile, load)
    return True


@jit
def may_be_refined(history, cycle, z):
    """True if part z can be sampled more closely: it is not yet as short as rounding."""
    shortest = max(1e-6 * (history.time[z, 1] - cycle.time[0, 0]), SHORTEST)
    has_length = history.time[z, 1] - history.time[z, 0] > shortest
    return history.intervals[z] < FINEST or (history.parts + 1 < MAX_PARTS and has_length)


@jit
def is_calm(history, cycle, load, k):
    """True if stretch k is short, on a straight side, and neither its edge nor its front passes x.

    Then stresses are next to monotone, and its ends tell how much higher they can be.
    """
    if load.sides == 0 or cycle.push[k] == OPEN:
        return False
    e0, e1 = cycle.edge[k, 0] - history.G, cycle.edge[k, 1] - history.G
    f0, f1 = cycle.front[k, 0] - history.front_G, cycle.front[k, 1] - history.front_G
    moved = max(abs(e1 - e0), abs(f1 - f0))
    return moved <= SHORT * cycle.largest and e0 * e1 > 0.0 and (f0 * f1 > 0.0 or cycle.push[k] == STICK)


@jit
def approaches(G, at_begin, at_end):
    """1 if a motion between two coordinates begins near G, 2 if it ends near G, 3 if both, else 0."""
    near = 0.25 * abs(at_end - at_begin)
    return (1 if abs(at_begin - G) <= near else 0) + (2 if abs(at_end - G) <= near else 0)


@jit
def split(history, cycle, profile, load, k):
    """Append the parts of stretch k: it is cut where its edge and its front pass x."""
    begin, end = cycle.time[k, 0], cycle.time[k, 1]
    push, i, G = cycle.push[k], cycle.piece[k], history.G
    edge, front = cycle.place[k, 0, 0], cycle.place[k, 0, 1]
    edge_end, front_end = cycle.place[k, FINEST, 0], cycle.place[k, FINEST, 1]
    if push == OPEN:
        add_part(history, k, begin, end, edge, edge_end, front, front_end, 0)
        return
    at_edge, at_front, near = end, end, approaches(G, cycle.edge[k, 0], cycle.edge[k, 1])
    if (cycle.edge[k, 0] - G) * (cycle.edge[k, 1] - G) < 0.0:
        at_edge = instant_of(load, NORMAL, G, begin, end)
    if push != STICK and i != NONE:
        G = history.front_G
        near |= approaches(G, cycle.front[k, 0], cycle.front[k, 1])
        if (cycle.front[k, 0] - G) * (cycle.front[k, 1] - G) < 0.0:
            which = DIFFERENCE if push == ALPHA else SUM
            at_front = instant_of(load, which, offset(cycle, load, i, G) - push * G, begin, end)
    if cycle.edge[k, 0] <= 0.0:  # touch-down
        near |= 1
    if cycle.edge[k, 1] <= 0.0:
        near |= 2
    t, cusps = begin, near & 1
    for stop in (min(at_edge, at_front), max(at_edge, at_front), end):
        if stop - t < SHORTEST:
            continue
        e, f = edge_end, front_end
        if stop < end:
            e, f = places_at(cycle, profile, load, k, stop)
            if stop == at_edge:
                e = history.X
            if stop == at_front or (stop == at_edge and push == STICK):
                f = history.front_X
        add_part(history, k, t, stop, edge, e, front, f, cusps | (2 if stop < end or near & 2 else 0))
        t, edge, front, cusps = stop, e, f, 1


@jit
def lay_parts(history, cycle, profile, load, coarsest):
    """Lay out all parts of the cycle, coarsely; the mirror image of half a cycle is the other half."""
    for k in range(cycle.stretches):
        if 2 * (history.parts + 7) >= MAX_PARTS or 2 * (history.instants + ROOM) >= MAX_INSTANTS:
            cycle.overflow = 1
            return
        before, begin, end = history.parts, cycle.time[k, 0], cycle.time[k, 1]
        if is_calm(history, cycle, load, k):
            near = approaches(history.G, cycle.edge[k, 0], cycle.edge[k, 1])
            near |= approaches(history.front_G, cycle.front[k, 0], cycle.front[k, 1])
            first, last = cycle.place[k, 0], cycle.place[k, FINEST]
            z = add_part(history, k, begin, end, first[0], last[0], first[1], last[1], near)
            # Else the part before has its first instant.
            if k == 0 or abs(begin - cycle.time[k - 1, 1]) > SHORTEST * load.period:
                add_instant(history, z, begin, first[0], first[1], NONE)
            history.first[z], history.intervals[z] = history.instants - 1, 1
            add_instant(history, z, end, last[0], last[1], NONE)
            continue
        split(history, cycle, profile, load, k)
        for z in range(before, history.parts):
            if history.intervals[z] == 0:
                sample(history, z, coarsest, cycle, profile, load)
    if load.mirrored:
        parts, instants = history.parts, history.instants
        for y in range(parts):
            begin, end = history.places[y, 0], history.places[y, 1]
            own = begin[0], end[0], begin[1], end[1], history.cusps[y]
            z = add_part(history, history.stretch[y], history.time[y, 0], history.time[y, 1], *own)
            history.mirror[z], history.intervals[z] = 1, history.intervals[y]
            history.first[z] = history.first[y] + instants
        for i in range(instants):
            edge, front = history.state[i, 0], history.state[i, 1]
            add_instant(history, history.part[i] + parts, history.instant[i], edge, front, i)
