"""The stress cycle at a place of the body, and the largest criterion there over planes of every orientation.

The cycle has the parts of `swtstudy.kernel.history`: near the surface a stretch is cut where the edge or the
slip front passes above the place. The parts that may hide a higher value on the critical plane are doubled
until none does; then the planes are searched again.
"""

from math import cos, sin, sqrt

import numpy as np

from swtstudy.kernel.all_planes import NO_TENSION, PLANES, ROWS, highest_plane, measure, strain_factor
from swtstudy.kernel.beneath import BELOW, open_place, stress_of_state
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
OF_BODY = HERE, BELOW, PLANES


@jit
def write_stresses(body):
    """Write the stress at the new instants. A known one is copied, perhaps from half a cycle before."""
    here, point = body.here, body.point
    history = point.history
    for m in range(history.written, history.instants):
        i, z = history.known[m], history.part[m]
        if i != NONE:
            mirrored = history.mirror[z] != history.mirror[history.part[i]]
            for c in range(6):
                here.stress[c, m] = here.mirrored[c, i] if mirrored else here.stress[c, i]
            continue
        edge, front, sign = history.state[m, 0], history.state[m, 1], -1.0 if history.mirror[z] else 1.0
        state = history.stretch[z], edge, front, sign, bulk_at(point.load, history.instant[m])
        stress_of_state(body.below, point.cycle, point.profile, point.ask, *state, here.out, here.other)
        for c in range(6):
            here.stress[c, m], here.mirrored[c, m] = here.out[c], here.other[c]
    history.written = history.instants


@jit
def sample_place(body, x, y, z, largest, coarsest):
    """All parts of the cycle at (x, y, z), coarsely.

    Parameters
    ----------
    largest
        Place s of the largest contact.
    coarsest
        Intervals of a part.
    """
    here, below, point = body.here, body.below, body.point
    load, profile, ask = point.load, point.profile, point.ask
    cycle, growth, history = point.cycle, point.growth, point.history
    open_place(below, cycle, growth, profile, ask, x, y, z, largest)
    here.on_circle, here.unsure, cycle.overflow = 0, np.inf, below.overflow  # each place on its own
    springs = below.sigma if below.omega < DEEP * largest else 0.0
    begin_parts(history, cycle, profile, springs, x, y, largest, cycle.shift)
    lay_parts(history, cycle, profile, load, coarsest)
    write_stresses(body)


@jit_reordered
def fill_circle(here, history, first, ask):
    """Write the stress at an angle of the circle, from an instant on: rr, φφ, zz, φz, rz, rφ for xx to xy."""
    nu, C, D, T = ask.poisson_ratio, cos(here.angle), sin(here.angle), here.stress
    of_sum = (nu - 0.5) / (1.0 + nu)
    for i in range(first, history.instants):
        p, within, bulk = history.p[i], history.within[i], history.bulk[i]
        T[0, i] = within - p + C * history.xx[i] + C * C * bulk
        T[1, i] = -within - 2.0 * nu * p + C * history.yy[i] + D * D * bulk
        T[2, i], T[3, i], T[4, i] = -p, D * history.q[i], -C * history.q[i]
        T[5, i] = D * (of_sum * (history.xx[i] + history.yy[i]) - history.yy[i]) - C * D * bulk


@jit
def write_new(body):
    """Write the stress at the new instants: of a circle of the surface from the history on the line."""
    here, point = body.here, body.point
    history, first = point.history, point.history.written
    if here.on_circle:
        write_stress(point)
        fill_circle(here, history, first, point.ask)
    else:
        write_stresses(body)
    for i in range(first, history.instants):
        trace = here.stress[0, i] + here.stress[1, i] + here.stress[2, i]
        here.stress[6, i] = strain_factor(point.ask) * trace


@jit
def follow_plane(body):
    """Write σ_n and the swing on the best plane where the parts' maxima are looked for."""
    stress, planes, ask, curves = body.here.stress, body.planes, body.point.ask, body.point.curves
    m, x, y, z = body.point.history.instants, planes.normal[0], planes.normal[1], planes.normal[2]
    if ask.criterion == SWT:
        project(stress, m, x, y, z, ACROSS, x, y, z)
        for i in range(m):
            across = stress[ACROSS, i]
            curves.a[i], curves.b[i], curves.c[i] = across, 0.0, 0.0
            curves.d[i] = (1.0 + ask.poisson_ratio) * across - stress[6, i]
        return
    planes.trial[0], planes.trial[1], planes.trial[2] = x, y, z
    activate(planes, stress, m, ask)
    F = planes.form[1]  # the change of the stress that swings most: along its shear on the plane
    p, q, r = F[0] * x + F[5] * y + F[4] * z, F[5] * x + F[1] * y + F[3] * z, F[4] * x + F[3] * y + F[2] * z
    along = p * x + q * y + r * z
    p, q, r = p - along * x, q - along * y, r - along * z
    size = max(sqrt(p * p + q * q + r * r), 1e-300)
    project(stress, m, x, y, z, ALONG, p / size, q / size, r / size)
    project(stress, m, x, y, z, ACROSS, x, y, z)
    for i in range(m):
        curves.a[i], curves.b[i], curves.c[i], curves.d[i] = stress[ACROSS, i], 0.0, 0.0, stress[ALONG, i]


@jit
def value_on_plane(body):
    """H of the best plane with the maxima between the instants."""
    ask, curves = body.point.ask, body.point.curves
    follow_plane(body)
    find_peaks(body.point.history, curves, ask, 1.0, 0.0)
    return lifted(ask, curves.top[STRESS], curves.top[SWING] + curves.top[MINUS_SWING], body.planes.noise)


@jit
def add_peaks(here, history, curves):
    """Write the stress at the maxima of the three curves behind the instants; returns the number of both."""
    for which in range(3):
        z, m = curves.part[which], history.instants + which
        barycentric(curves.place[which], history.intervals[z], curves.weight)
        for c in range(7):
            here.stress[c, m] = 0.0
            for j in range(history.intervals[z] + 1):
                here.stress[c, m] += curves.weight[j] * here.stress[c, history.first[z] + j]
    return history.instants + 3


@jit
def settle_place(body, tolerance):
    """Double parts that may hide a higher value on the best plane, until none does; returns h there.

    Values above a limit are confirmed as on the line (`swtstudy.kernel.at_place.resolve`), on the plane of
    the maxima between the instants.
    """
    here, planes, point = body.here, body.planes, body.point
    load, profile, ask = point.load, point.profile, point.ask
    cycle, history, curves = point.cycle, point.history, point.curves
    h, n = value_on_plane(body), planes.normal
    for _ in range(ROUNDS):
        doubled, _, here.missing = mark_unresolved(history, curves, cycle, ask, 1.0, 0.0, tolerance)
        confirming = doubled == 0 and h > here.unsure
        if confirming:
            doubled = mark_highest(history, curves, cycle)
        if not refine_marked(history, cycle, profile, load, doubled):
            break
        write_new(body)
        planes.best, before = 0.0, h
        climb_from(planes, here.stress, history.instants, ask, n[0], n[1], n[2])
        h = value_on_plane(body)
        if confirming and abs(h - before) <= tolerance * h:
            break
    before = 0.0
    while h > max(here.unsure, before * (1.0 + tolerance)):
        planes.best, before = 0.0, h
        climb_from(planes, here.stress, add_peaks(here, history, curves), ask, n[0], n[1], n[2])
        h = value_on_plane(body)
    return max(h, before)


@jit
def highest_here(body, least, tolerance, proof):
    """Largest h over all planes of the sampled cycle, with its plane's normal and what it may miss.

    The normal in ``planes`` is a guess, or 0, and that of the best plane afterwards; parts are doubled on
    this plane before all planes are searched. ``here.missing`` is what the value may miss.

    Parameters
    ----------
    body
        `swtstudy.kernel.records.Body`.
    least
        Values of h below it may be low.
    tolerance
        Relative, of the value on its plane.
    proof
        No plane is higher by more, relative, at the instants that there are.
    """
    here, planes, ask, history = body.here, body.planes, body.point.ask, body.point.history
    allowed, n, first = 0.5 * tolerance, planes.normal, here.first
    measure(planes, here.stress, history.instants, ask)
    planes.best, planes.limit, here.missing = 0.0, 0.0, 0.0
    if ask.criterion == SWT and planes.most[0] <= NO_TENSION * planes.of_tension:
        return 0.0
    if n[0] != 0.0 or n[1] != 0.0 or n[2] != 0.0:
        climb_from(planes, here.stress, history.instants, ask, n[0], n[1], n[2])
    if planes.best <= (1.0 - CLOSE) * least or planes.best <= 0.0:
        highest_plane(planes, here.stress, history.instants, ask, least, proof)
    if planes.best <= (1.0 - CLOSE) * least or planes.best <= 0.0:
        return planes.best
    h = settle_place(body, allowed)
    for _ in range(RIVALS):
        missing, first[0], first[1], first[2] = here.missing, n[0], n[1], n[2]
        floor = max((1.0 - allowed) * h, least)
        best = highest_plane(planes, here.stress, history.instants, ask, floor, proof)
        cosine = first[0] * n[0] + first[1] * n[1] + first[2] * n[2]
        if best <= (1.0 - allowed) * h or abs(cosine) > SAME_PLANE:
            break
        other = settle_place(body, allowed)
        if other <= h:
            n[0], n[1], n[2], here.missing = first[0], first[1], first[2], missing
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
    ask = body.point.ask
    sample_place(body, x, y, z, largest, coarsest)
    if body.point.cycle.overflow:
        return np.nan, np.nan
    h = highest_here(body, lift(ask, floor), tolerance, proof)
    return value_of(ask, h), value_of(ask, h) * body.here.missing


@jit
def largest_at_places(body, places, largest, floor, tolerance, coarsest, alone, found, normals):
    """Write the criterion and what it may miss, (n, 2), and the normal of its plane at places, (n, 3).

    Each place takes the plane of the one before as a guess, unless it is alone.
    """
    normal = body.planes.normal
    normal[0], normal[1], normal[2] = 0.0, 0.0, 0.0
    proof = 0.5 * tolerance if alone else PROOF * tolerance
    for i in range(places.shape[0]):
        if alone:
            normal[0], normal[1], normal[2] = 0.0, 0.0, 0.0
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        found[i, 0], found[i, 1] = largest_at(body, x, y, z, largest, floor, tolerance, proof, coarsest)
        for c in range(3):
            normals[i, c] = normal[c]
        if found[i, 0] == 0.0:  # no plane ever sees tension
            normals[i, 0], normals[i, 1], normals[i, 2] = np.nan, np.nan, np.nan


@jit
def von_mises_at_places(body, places, largest, values):
    """Write the largest von Mises stress of the cycle at places, (n, 3)."""
    stress, point = body.here.stress, body.point
    for i in range(places.shape[0]):
        x, y, z = places[i, 0], places[i, 1], places[i, 2]
        sample_place(body, x, y, z, largest, OF_VON_MISES)
        if point.cycle.overflow:
            values[i] = np.nan
            continue
        largest_square = 0.0
        for j in range(point.history.instants):
            xx, yy, zz = stress[0, j], stress[1, j], stress[2, j]
            yz, xz, xy = stress[3, j], stress[4, j], stress[5, j]
            normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)
            largest_square = max(largest_square, 0.5 * normal + 3.0 * (yz * yz + xz * xz + xy * xy))
        values[i] = sqrt(largest_square)
