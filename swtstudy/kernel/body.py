"""The stress cycle at a place of the body, and the largest criterion there over planes of every orientation.

The cycle has the parts of `swtstudy.kernel.history`: near the surface a stretch is cut where the edge or the
slip front passes above the place. The parts that may hide a higher value on the critical plane are doubled
until none does; then the planes are searched again.
"""

from math import sqrt

import numpy as np

from swtstudy.kernel.all_planes import (
    NO_TENSION,
    PLANES,
    ROWS,
    activate,
    climb_from,
    highest_plane,
    measure,
    project,
)
from swtstudy.kernel.beneath import PLACE, open_place, stress_of_state, with_bulk
from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.compiled import jit, new_record
from swtstudy.kernel.contact import SHORTEST
from swtstudy.kernel.criterion import SWT, lift, lifted, value_of
from swtstudy.kernel.growth import places_at
from swtstudy.kernel.history import (
    MAX_INSTANTS,
    MAX_PARTS,
    ROOM,
    SPACED,
    add_part,
    approaches,
    find_passing,
    is_calm,
    split,
)
from swtstudy.kernel.load import bulk_at
from swtstudy.kernel.planes import MINUS_SWING, STRESS, SWING, find_peaks, mark_unresolved
from swtstudy.kernel.profile import coordinate_at

#: Intervals of a part at first, and for the von Mises stress, whose largest value is that at the instants.
COARSEST, OF_VON_MISES = np.array([4, 8])
#: If the singularity of the springs' field is farther from their line than this share of the contact, no
#: passage of edge or front has a part of its own.
DEEP = 0.25
#: Purposes for which a part is sampled, and rows of a history that are room; no literals, for which Numba
#: would compile anew.
FOR_BOTH, FOR_ONE = np.array([True, False])
ALONG, ACROSS = np.array([7, 8])
#: Most rounds in which parts of a cycle are doubled.
ROUNDS = 8
#: Cosine of the angle between planes that are one, and most planes that may follow one another as the best.
SAME_PLANE, RIVALS = 0.9998, 4
#: Share of the tolerance to which no plane is higher, where values are averaged.
PROOF = 5.0
#: Values lower than a floor by more than this share are left as the first instants give them.
CLOSE = 0.2
HERE = np.dtype(
    [
        ("stress", "f8", (ROWS, MAX_INSTANTS)),
        ("mirrored", "f8", (6, MAX_INSTANTS)),  # half a cycle later
        ("out", "f8", (6,)),
        ("other", "f8", (6,)),
        ("first", "f8", (3,)),  # normal of the best plane so far
        ("missing", "f8"),  # what the value may still lack, relative
        ("overflow", "i8"),
    ]
)


def body_workspace():
    """The memory for places of the body that one thread needs, beside the line's memory."""
    return tuple(new_record(kind) for kind in (PLACE, HERE, PLANES))


@jit
def sample_instant(S, B, C, P, L, k, t, edge, front, sign, m, mirrored, nu, mu):
    """Write instant m of the history, and where asked what it is half a cycle later."""
    out = S.out
    stress_of_state(B, C, P, k, edge, front, sign, nu, mu, out, S.other)
    bulk = bulk_at(L, t)
    with_bulk(P, bulk, nu, out)
    for c in range(6):
        S.stress[c, m] = out[c]
    if mirrored:
        with_bulk(P, bulk, nu, S.other)
        for c in range(6):
            S.mirrored[c, m] = S.other[c]


@jit
def sample_part(S, B, H, z, intervals, C, P, L, nu, mu, both):
    """Sample part z at the Lobatto points of so many intervals; instants that it had before are copied.

    For both halves of a mirrored cycle, or for the one that the part is in.
    """
    k, cusps = H.stretch[z], H.cusps[z]
    begin, end = H.time[z, 0], H.time[z, 1]
    whole = cusps == 0 and begin == C.time[k, 0] and end == C.time[k, 1] and intervals <= C.intervals[k]
    old, known, m, step = H.first[z], H.intervals[z], H.instants, FINEST // intervals
    sign = -1.0 if H.mirror[z] else 1.0
    for j in range(intervals + 1):
        if known > 0 and j * known % intervals == 0:
            for c in range(6):
                S.stress[c, m + j] = S.stress[c, old + j * known // intervals]
            continue
        t = begin + 0.5 * (end - begin) * (SPACED[cusps, j * step] + 1.0)
        if j == 0 or j == intervals:
            edge, front = H.places[z, j // intervals, 0], H.places[z, j // intervals, 1]
        elif whole:
            edge, front = C.place[k, j * step, 0], C.place[k, j * step, 1]
        else:
            edge, front = places_at(C, P, L, k, t, H.weight)
        sample_instant(S, B, C, P, L, k, t, edge, front, sign, m + j, both and L.mirrored, nu, mu)
    H.first[z], H.intervals[z] = m, intervals
    H.instants = m + intervals + 1


@jit
def sample_ends(S, B, H, C, P, L, k, nu, mu):
    """A part for stretch k of which only the ends are sampled; they are shared with the part before."""
    edge, front = C.place[k, 0, 0], C.place[k, 0, 1]
    edge_end, front_end = C.place[k, FINEST, 0], C.place[k, FINEST, 1]
    near = approaches(H.G, C.edge[k, 0], C.edge[k, 1]) | approaches(H.front_G, C.front[k, 0], C.front[k, 1])
    z = add_part(H, k, C.time[k, 0], C.time[k, 1], edge, edge_end, front, front_end, near)
    m, mirrored = H.instants, L.mirrored
    if k > 0 and abs(C.time[k, 0] - C.time[k - 1, 1]) <= SHORTEST * L.period:
        m -= 1
    else:
        sample_instant(S, B, C, P, L, k, C.time[k, 0], edge, front, 1.0, m, mirrored, nu, mu)
    t = C.time[k, 1]
    sample_instant(S, B, C, P, L, k, t, edge_end, front_end, 1.0, m + 1, mirrored, nu, mu)
    H.first[z], H.intervals[z], H.instants = m, 1, m + 2


@jit
def sample_place(S, B, H, C, R, P, K, L, x, y, z, largest, nu, mu, coarsest):
    """All parts of the cycle at (x, y, z), coarsely.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    coarsest
        Intervals of a part.
    """
    open_place(B, C, R, P, x, y, z, largest, nu)
    S.overflow = B.overflow
    H.instants, H.parts, H.plane = 0, 0, P.plane
    H.X, H.all_outside, H.G = B.sigma, 1, -1.0
    if B.sigma > 0.0 and B.omega < DEEP * largest:
        H.G = coordinate_at(P, B.sigma) if B.sigma <= largest else np.inf
    H.shift, H.load, H.reach = C.shift, C.largest, largest
    find_passing(H, P, x, y)
    for k in range(C.stretches):
        if H.parts + 7 >= MAX_PARTS or H.instants + ROOM >= MAX_INSTANTS:
            S.overflow = 1
            return
        if is_calm(H, C, L, k):
            sample_ends(S, B, H, C, P, L, k, nu, mu)
            continue
        before = H.parts
        split(H, C, P, K, L, k, nu, mu)
        for part in range(before, H.parts):
            sample_part(S, B, H, part, coarsest, C, P, L, nu, mu, FOR_BOTH)
    if L.mirrored:
        parts, instants = H.parts, H.instants
        if 2 * parts >= MAX_PARTS or 2 * instants >= MAX_INSTANTS:
            S.overflow = 1
            return
        for y in range(parts):
            add_mirror_image(H, y, instants)
        for i in range(instants):
            for c in range(6):
                S.stress[c, instants + i] = S.mirrored[c, i]
        H.instants = 2 * instants


@jit
def add_mirror_image(H, y, instants):
    """A part like y of the mirrored half of the cycle."""
    z = H.parts
    H.parts += 1
    H.stretch[z], H.mirror[z], H.cusps[z], H.intervals[z] = H.stretch[y], 1, H.cusps[y], H.intervals[y]
    H.first[z], H.time[z, 0], H.time[z, 1] = H.first[y] + instants, H.time[y, 0], H.time[y, 1]
    for e in range(2):
        H.places[z, e, 0], H.places[z, e, 1] = H.places[y, e, 0], H.places[y, e, 1]


@jit
def refine_part(S, B, H, z, C, P, L, nu, mu):
    """Double the intervals of part z, or give it some if only its ends are known; cut the finest in two."""
    if H.intervals[z] < FINEST:
        sample_part(S, B, H, z, max(2 * H.intervals[z], COARSEST), C, P, L, nu, mu, FOR_ONE)
        return
    k, begin, end = H.stretch[z], H.time[z, 0], H.time[z, 1]
    t = begin + 0.5 * (end - begin) * (SPACED[H.cusps[z], FINEST // 2] + 1.0)
    edge, front = places_at(C, P, L, k, t, H.weight)
    y = add_part(H, k, t, end, edge, H.places[z, 1, 0], front, H.places[z, 1, 1], H.cusps[z] & 2)
    H.mirror[y] = H.mirror[z]
    H.time[z, 1], H.cusps[z], H.intervals[z] = t, H.cusps[z] & 1, 0
    H.places[z, 1, 0], H.places[z, 1, 1] = edge, front
    sample_part(S, B, H, z, FINEST // 2, C, P, L, nu, mu, FOR_ONE)
    sample_part(S, B, H, y, FINEST // 2, C, P, L, nu, mu, FOR_ONE)


@jit
def follow_plane(S, H, W, G, Q):
    """Write σ_n and the swing on the best plane where the parts' maxima are looked for."""
    m, x, y, z = H.instants, G.normal[0], G.normal[1], G.normal[2]
    if Q.criterion == SWT:
        project(S.stress, m, x, y, z, ACROSS, x, y, z)
        for i in range(m):
            across = S.stress[ACROSS, i]
            W.a[i], W.b[i], W.c[i] = across, 0.0, 0.0
            W.d[i] = (1.0 + Q.poisson_ratio) * across - S.stress[6, i]
        return
    G.trial[0], G.trial[1], G.trial[2] = x, y, z
    activate(G, S.stress, m, Q)
    F = G.form[1]  # the change of the stress that swings most: along its shear on the plane
    p, q, r = F[0] * x + F[5] * y + F[4] * z, F[5] * x + F[1] * y + F[3] * z, F[4] * x + F[3] * y + F[2] * z
    along = p * x + q * y + r * z
    p, q, r = p - along * x, q - along * y, r - along * z
    size = max(sqrt(p * p + q * q + r * r), 1e-300)
    project(S.stress, m, x, y, z, ALONG, p / size, q / size, r / size)
    project(S.stress, m, x, y, z, ACROSS, x, y, z)
    for i in range(m):
        W.a[i], W.b[i], W.c[i], W.d[i] = S.stress[ACROSS, i], 0.0, 0.0, S.stress[ALONG, i]


@jit
def value_on_plane(S, H, W, G, Q):
    """H of the best plane with the maxima between the instants."""
    follow_plane(S, H, W, G, Q)
    find_peaks(H, W, Q, 1.0, 0.0)
    return lifted(Q, W.top[STRESS], W.top[SWING] + W.top[MINUS_SWING], G.noise)


@jit
def settle_place(S, B, H, W, G, C, P, L, Q, tolerance):
    """Double parts that may hide a higher value on the best plane, until none does; returns h there."""
    m, nu = H.instants, Q.poisson_ratio if Q.criterion == SWT else 0.0
    for _ in range(ROUNDS):
        value_on_plane(S, H, W, G, Q)
        doubled, _, S.missing = mark_unresolved(H, W, C, Q, 1.0, 0.0, tolerance)
        if doubled == 0 or H.instants + doubled * ROOM > MAX_INSTANTS or H.parts + doubled >= MAX_PARTS:
            break
        for z in range(H.parts):
            if W.double[z]:
                refine_part(S, B, H, z, C, P, L, Q.poisson_ratio, Q.friction)
        for i in range(m, H.instants):
            S.stress[6, i] = nu * (S.stress[0, i] + S.stress[1, i] + S.stress[2, i])
        m, G.best = H.instants, 0.0
        climb_from(G, S.stress, m, Q, G.normal[0], G.normal[1], G.normal[2])
    return value_on_plane(S, H, W, G, Q)


@jit
def largest_at(S, B, H, W, G, C, R, P, K, L, Q, x, y, z, largest, floor, tolerance, proof, coarsest):
    """The criterion at (x, y, z) over all planes, with its plane's normal in G, and what it may miss.

    The normal in G before is a guess, or 0. Parts are doubled on its plane, before all planes are searched.

    Parameters
    ----------
    floor
        Values below it may be low.
    tolerance
        Relative, of the value on its plane.
    proof
        No plane is higher by more, relative, at the instants that there are.
    coarsest
        Intervals of a part at first.
    """
    sample_place(S, B, H, C, R, P, K, L, x, y, z, largest, Q.poisson_ratio, Q.friction, coarsest)
    if S.overflow:
        return np.nan, np.nan
    least, allowed, n, first = lift(Q, floor), 0.5 * tolerance, G.normal, S.first
    S.missing = 0.0
    measure(G, S.stress, H.instants, Q)
    G.best, G.limit = 0.0, 0.0
    if Q.criterion == SWT and G.most[0] <= NO_TENSION * G.of_tension:
        return 0.0, 0.0
    if n[0] != 0.0 or n[1] != 0.0 or n[2] != 0.0:
        climb_from(G, S.stress, H.instants, Q, n[0], n[1], n[2])
    if G.best <= (1.0 - CLOSE) * least or G.best <= 0.0:
        highest_plane(G, S.stress, H.instants, Q, least, proof)
    if G.best <= (1.0 - CLOSE) * least or G.best <= 0.0:
        return value_of(Q, G.best), 0.0
    h = settle_place(S, B, H, W, G, C, P, L, Q, allowed)
    for _ in range(RIVALS):
        missing, first[0], first[1], first[2] = S.missing, n[0], n[1], n[2]
        best = highest_plane(G, S.stress, H.instants, Q, max((1.0 - allowed) * h, least), proof)
        if (
            best <= (1.0 - allowed) * h
            or abs(first[0] * n[0] + first[1] * n[1] + first[2] * n[2]) > SAME_PLANE
        ):
            break
        other = settle_place(S, B, H, W, G, C, P, L, Q, allowed)
        if other <= h:
            n[0], n[1], n[2], S.missing = first[0], first[1], first[2], missing
            break
        h = other
    return value_of(Q, h), value_of(Q, h) * S.missing


@jit
def largest_at_places(
    S,
    B,
    H,
    W,
    G,
    C,
    R,
    P,
    K,
    L,
    Q,
    places,
    largest,
    floor,
    tolerance,
    coarsest,
    alone,
    values,
    missing,
    normals,
):
    """Write the criterion, what it may miss and the normal of its plane at places, (n, 3).

    Each place takes the plane of the one before as a guess, unless it is alone.
    """
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    proof = 0.5 * tolerance if alone else PROOF * tolerance
    for i in range(places.shape[0]):
        if alone:
            G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        values[i], missing[i] = largest_at(
            S, B, H, W, G, C, R, P, K, L, Q, x, y, z, largest, floor, tolerance, proof, coarsest
        )
        for c in range(3):
            normals[i, c] = G.normal[c]
        if values[i] == 0.0:  # no plane ever sees tension
            normals[i, 0], normals[i, 1], normals[i, 2] = np.nan, np.nan, np.nan


@jit
def von_mises_at_places(S, B, H, C, R, P, K, L, Q, places, largest, values):
    """Write the largest von Mises stress of the cycle at places, (n, 3)."""
    for i in range(places.shape[0]):
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        sample_place(S, B, H, C, R, P, K, L, x, y, z, largest, Q.poisson_ratio, Q.friction, OF_VON_MISES)
        if S.overflow:
            values[i] = np.nan
            continue
        largest_square = 0.0
        for j in range(H.instants):
            xx, yy, zz = S.stress[0, j], S.stress[1, j], S.stress[2, j]
            yz, xz, xy = S.stress[3, j], S.stress[4, j], S.stress[5, j]
            normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)
            largest_square = max(largest_square, 0.5 * normal + 3.0 * (yz * yz + xz * xz + xy * xy))
        values[i] = sqrt(largest_square)


@jit
def write_instants(H, L, time):
    """Write the instants of the parts of the cycle at a place; returns how many there are."""
    m = 0
    for z in range(H.parts):
        begin, end, step = H.time[z, 0], H.time[z, 1], FINEST // H.intervals[z]
        for j in range(H.intervals[z] + 1):
            if m >= time.shape[0]:
                return m
            time[m] = begin + 0.5 * (end - begin) * (SPACED[H.cusps[z] & 3, j * step] + 1.0)
            time[m] += 0.5 * L.period * H.mirror[z]
            m += 1
    return m
