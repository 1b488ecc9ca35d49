"""The stress cycle at a place of the body, and the largest criterion there over planes of every orientation.

The cycle has the parts of `swtstudy.kernel.history`: near the surface a stretch is cut where the edge or the
slip front passes above the place. The parts that may hide a higher value on the critical plane are doubled
until none does; then the planes are searched again.
"""

from math import cos, sin, sqrt

import numpy as np

from swtstudy.kernel.all_planes import NO_TENSION, PLANES, ROWS, highest_plane, measure, strain_factor
from swtstudy.kernel.beneath import PLACE, open_place, stress_of_state
from swtstudy.kernel.chebyshev import barycentric
from swtstudy.kernel.climb import activate, climb_from
from swtstudy.kernel.compiled import fields, jit, jit_reordered
from swtstudy.kernel.contact import NONE
from swtstudy.kernel.criterion import SWT, lift, lifted, value_of
from swtstudy.kernel.history import write_stress
from swtstudy.kernel.load import bulk_at
from swtstudy.kernel.on_plane import project
from swtstudy.kernel.parts import COARSEST, MAX_INSTANTS, begin_parts, lay_parts, refine_marked
from swtstudy.kernel.planes import MINUS_SWING, STRESS, SWING, find_peaks, mark_highest, mark_unresolved

#: Intervals of a part for the von Mises stress, whose largest value is that at the instants.
OF_VON_MISES = 2 * COARSEST
#: If the singularity of the springs' field is farther from their line than this share of the contact, no
#: passage of edge or front has a part of its own.
DEEP = 0.25
#: Rows of a history that are room; no literals, for which Numba would compile anew.
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
        *fields("f8", "out other", (6,)),
        ("first", "f8", (3,)),  # normal of the best plane so far
        ("missing", "f8"),  # what the value may still lack, relative
        ("on_circle", "i8"),  # 1: the place is on a circle of the surface, at an angle from x
        ("angle", "f8"),
        ("unsure", "f8"),  # values h above it are confirmed
    ]
)
#: Kinds of the records that a thread needs for places of the body, beside those of points.
OF_BODY = PLACE, HERE, PLANES


@jit
def write_stresses(S, B, H, C, P, L, Q):
    """Write the stress at the new instants. A known one is copied, perhaps from half a cycle before."""
    for m in range(H.written, H.instants):
        i, z = H.known[m], H.part[m]
        if i != NONE:
            mirrored = H.mirror[z] != H.mirror[H.part[i]]
            for c in range(6):
                S.stress[c, m] = S.mirrored[c, i] if mirrored else S.stress[c, i]
            continue
        own = H.stretch[z], H.state[m, 0], H.state[m, 1], -1.0 if H.mirror[z] else 1.0
        stress_of_state(B, C, P, Q, *own, bulk_at(L, H.instant[m]), S.out, S.other)
        for c in range(6):
            S.stress[c, m], S.mirrored[c, m] = S.out[c], S.other[c]
    H.written = H.instants


@jit
def sample_place(S, B, H, C, R, P, L, Q, x, y, z, largest, coarsest):
    """All parts of the cycle at (x, y, z), coarsely.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    coarsest
        Intervals of a part.
    """
    open_place(B, C, R, P, Q, x, y, z, largest)
    S.on_circle, S.unsure, C.overflow = 0, np.inf, B.overflow  # each place on its own
    begin_parts(H, C, P, B.sigma if B.omega < DEEP * largest else 0.0, x, y, largest, C.shift)
    lay_parts(H, C, P, L, coarsest)
    write_stresses(S, B, H, C, P, L, Q)


@jit_reordered
def fill_circle(S, H, first, Q):
    """Write the stress at an angle of the circle, from an instant on: rr, φφ, zz, φz, rz, rφ for xx to xy."""
    nu, C, D, T = Q.poisson_ratio, cos(S.angle), sin(S.angle), S.stress
    of_sum = (nu - 0.5) / (1.0 + nu)
    for i in range(first, H.instants):
        p, within, bulk = H.p[i], H.within[i], H.bulk[i]
        T[0, i] = within - p + C * H.xx[i] + C * C * bulk
        T[1, i] = -within - 2.0 * nu * p + C * H.yy[i] + D * D * bulk
        T[2, i], T[3, i], T[4, i] = -p, D * H.q[i], -C * H.q[i]
        T[5, i] = D * (of_sum * (H.xx[i] + H.yy[i]) - H.yy[i]) - C * D * bulk


@jit
def write_new(S, B, H, C, P, K, L, Q):
    """Write the stress at the new instants: of a circle of the surface from the history on the line."""
    first = H.written
    if S.on_circle:
        write_stress(H, C, P, L, K, Q)
        fill_circle(S, H, first, Q)
    else:
        write_stresses(S, B, H, C, P, L, Q)
    for i in range(first, H.instants):
        S.stress[6, i] = strain_factor(Q) * (S.stress[0, i] + S.stress[1, i] + S.stress[2, i])


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
def add_peaks(S, H, W):
    """Write the stress at the maxima of the three curves behind the instants; returns the number of both."""
    for which in range(3):
        z, m = W.part[which], H.instants + which
        barycentric(W.place[which], H.intervals[z], W.weight)
        for c in range(7):
            S.stress[c, m] = 0.0
            for j in range(H.intervals[z] + 1):
                S.stress[c, m] += W.weight[j] * S.stress[c, H.first[z] + j]
    return H.instants + 3


@jit
def settle_place(body, tolerance):
    """Double parts that may hide a higher value on the best plane, until none does; returns h there.

    Values above a limit are confirmed as on the line (`swtstudy.kernel.at_place.resolve`), on the plane of
    the maxima between the instants.
    """
    S, B, H, W, G, C, R, P, K, L, Q = body
    h = value_on_plane(S, H, W, G, Q)
    for _ in range(ROUNDS):
        doubled, _, S.missing = mark_unresolved(H, W, C, Q, 1.0, 0.0, tolerance)
        confirming = doubled == 0 and h > S.unsure
        if confirming:
            doubled = mark_highest(H, W, C)
        if not refine_marked(H, C, P, L, doubled):
            break
        write_new(S, B, H, C, P, K, L, Q)
        G.best, before = 0.0, h
        climb_from(G, S.stress, H.instants, Q, G.normal[0], G.normal[1], G.normal[2])
        h = value_on_plane(S, H, W, G, Q)
        if confirming and abs(h - before) <= tolerance * h:
            break
    before = 0.0
    while h > max(S.unsure, before * (1.0 + tolerance)):
        G.best, before = 0.0, h
        climb_from(G, S.stress, add_peaks(S, H, W), Q, G.normal[0], G.normal[1], G.normal[2])
        h = value_on_plane(S, H, W, G, Q)
    return max(h, before)


@jit
def highest_here(body, least, tolerance, proof):
    """Largest h over all planes of the sampled cycle, with its plane's normal in G and what it may miss in S.

    The normal in G before is a guess, or 0. Parts are doubled on its plane, before all planes are searched.

    Parameters
    ----------
    body
        Records of HERE, PLACE, HISTORY, WORK, PLANES, CYCLE, GROWTH, PROFILE, TABLE, LOAD and ASK.
    least
        Values of h below it may be low.
    tolerance
        Relative, of the value on its plane.
    proof
        No plane is higher by more, relative, at the instants that there are.
    """
    S, B, H, W, G, C, R, P, K, L, Q = body
    allowed, n, first = 0.5 * tolerance, G.normal, S.first
    measure(G, S.stress, H.instants, Q)
    G.best, G.limit, S.missing = 0.0, 0.0, 0.0
    if Q.criterion == SWT and G.most[0] <= NO_TENSION * G.of_tension:
        return 0.0
    if n[0] != 0.0 or n[1] != 0.0 or n[2] != 0.0:
        climb_from(G, S.stress, H.instants, Q, n[0], n[1], n[2])
    if G.best <= (1.0 - CLOSE) * least or G.best <= 0.0:
        highest_plane(G, S.stress, H.instants, Q, least, proof)
    if G.best <= (1.0 - CLOSE) * least or G.best <= 0.0:
        return G.best
    h = settle_place(body, allowed)
    for _ in range(RIVALS):
        missing, first[0], first[1], first[2] = S.missing, n[0], n[1], n[2]
        best = highest_plane(G, S.stress, H.instants, Q, max((1.0 - allowed) * h, least), proof)
        if (
            best <= (1.0 - allowed) * h
            or abs(first[0] * n[0] + first[1] * n[1] + first[2] * n[2]) > SAME_PLANE
        ):
            break
        other = settle_place(body, allowed)
        if other <= h:
            n[0], n[1], n[2], S.missing = first[0], first[1], first[2], missing
            break
        h = other
    return h


@jit
def largest_at(body, x, y, z, largest, floor, tolerance, proof, coarsest):
    """The criterion at (x, y, z) over all planes, and what it may miss; parameters as of `highest_here`.

    Parameters
    ----------
    floor
        Values below it may be low.
    coarsest
        Intervals of a part at first.
    """
    S, B, H, W, G, C, R, P, K, L, Q = body
    sample_place(S, B, H, C, R, P, L, Q, x, y, z, largest, coarsest)
    if C.overflow:
        return np.nan, np.nan
    h = highest_here(body, lift(Q, floor), tolerance, proof)
    return value_of(Q, h), value_of(Q, h) * S.missing


@jit
def largest_at_places(
    S, B, H, W, G, C, R, P, K, L, Q, places, largest, floor, tolerance, coarsest, alone, found, normals
):
    """Write the criterion and what it may miss, (n, 2), and the normal of its plane at places, (n, 3).

    Each place takes the plane of the one before as a guess, unless it is alone.
    """
    body = S, B, H, W, G, C, R, P, K, L, Q
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    proof = 0.5 * tolerance if alone else PROOF * tolerance
    for i in range(places.shape[0]):
        if alone:
            G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        found[i, 0], found[i, 1] = largest_at(body, x, y, z, largest, floor, tolerance, proof, coarsest)
        for c in range(3):
            normals[i, c] = G.normal[c]
        if found[i, 0] == 0.0:  # no plane ever sees tension
            normals[i, 0], normals[i, 1], normals[i, 2] = np.nan, np.nan, np.nan


@jit
def von_mises_at_places(S, B, H, C, R, P, L, Q, places, largest, values):
    """Write the largest von Mises stress of the cycle at places, (n, 3)."""
    for i in range(places.shape[0]):
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        sample_place(S, B, H, C, R, P, L, Q, x, y, z, largest, OF_VON_MISES)
        if C.overflow:
            values[i] = np.nan
            continue
        largest_square = 0.0
        for j in range(H.instants):
            xx, yy, zz = S.stress[0, j], S.stress[1, j], S.stress[2, j]
            yz, xz, xy = S.stress[3, j], S.stress[4, j], S.stress[5, j]
            normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)
            largest_square = max(largest_square, 0.5 * normal + 3.0 * (yz * yz + xz * xz + xy * xy))
        values[i] = sqrt(largest_square)
