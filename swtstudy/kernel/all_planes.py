"""The critical plane of a stress history: largest value of the criterion over planes of every orientation.

The tension T and the range A of the swing (`swtstudy.kernel.on_plane`) are maxima, over instants or pairs of
instants, of smooth functions of the normal n. Along a great circle σ_n is a sinusoid of twice the angle. So
is the component of a shear stress along a line that turns with the plane: its second derivative is at least
-4 times itself, and its first one at most twice the largest shear of the change. So over twice the angle the
bounds of `swtstudy.kernel.criterion.curvature_bound` hold with the largest √J2 of a stress, and of a change
of it, and no slope of T is steeper than its height above 0 allows (`swtstudy.kernel.criterion.slope_bound`).
In a triangle of normals the value is at most that of the plane through the values at its corners, plus what
such a curvature adds. Triangles that may hold a higher value are cut in two, until there is none.
"""

from math import sqrt

import numpy as np

from swtstudy.kernel.climb import OF_J2, climb_from, climb_from_principal, largest_principal
from swtstudy.kernel.compiled import fields, jit, new_record
from swtstudy.kernel.criterion import SWT, curvature_bound, lifted, slope_bound, value_of
from swtstudy.kernel.on_plane import longest_chord, set_path, tension_and_strain
from swtstudy.kernel.planes import NOISE, above

#: Rows of a history: xx, yy, zz, yz, xz, xy; ν tr σ or 0; two components of the shear stress on a plane.
ROWS = 9
#: So many triangles are cut in the order in which they came, the others depth first.
IN_ORDER = np.int64(60)
MAX_TRIANGLES = 256
#: Most planes of a search.
MOST_PLANES = 200_000
#: Tension below this share of the largest √J2 is none: a principal stress is no more exact.
NO_TENSION = 1e-7
#: Where tension is next to nothing, what counts is this share of the tolerance of the largest possible value.
NEXT_TO_NOTHING = 1e-6
PLANES = np.dtype(
    [
        ("normal", "f8", (3,)),  # of the best plane; before the search a guess, or 0
        *fields("f8", "best limit"),  # h there, and what a higher value must exceed
        ("planes", "i8"),  # that have been looked at
        ("unsettled", "i8"),  # 1: the search ended before its bound was met
        ("noise", "f8"),  # tension that rounding may make
        ("instant", "i8"),  # of the largest principal stress
        *fields("f8", "of_tension of_swing"),  # bounds of the derivatives over twice the angle
        ("most", "f8", (2,)),  # bounds of T and A
        ("seen", "f8", (3,)),  # h, T, A of the last plane, from above
        *fields("f8", "trial kept", (3,)),  # normals of a climb: the last one and the highest
        ("tangent", "f8", (2, 3)),
        ("form", "f8", (3, 6)),  # tensors of σ_n and of the swing at a climb's instants, the square of this
        ("jet", "f8", (3, 6)),  # value, first derivatives 1, 2, second ones 11, 22, 12 of each on the sphere
        ("bend", "f8", (3,)),  # h² times the second derivatives 11, 22, 12 of ln h
        ("corner", "f8", (MAX_TRIANGLES, 3, 6)),  # normal, h, T, A at the corners of triangles
        ("line", "f8"),  # angle of the longest chord in the last plane
        ("chord", "f8", (2,)),  # direction of a climb
        ("waiting", "f8", (64, 4)),  # intervals of lines: angle, width of the path, step, width at its end
    ]
)


@jit
def deviator(stresses, i, T):
    """J2 of instant i less a tensor T."""
    p, q, r = stresses[0, i] - T[0], stresses[1, i] - T[1], stresses[2, i] - T[2]
    normal = ((p - q) * (p - q) + (q - r) * (q - r) + (r - p) * (r - p)) / 6.0
    yz, xz, xy = stresses[3, i] - T[3], stresses[4, i] - T[4], stresses[5, i] - T[5]
    return normal + yz * yz + xz * xz + xy * xy


@jit
def strain_factor(ask):
    """Factor ν of tr σ in the normal strain; 0 of a shear stress."""
    return ask.poisson_ratio if ask.criterion == SWT else 0.0


@jit
def measure(planes, stresses, m, ask):
    """Write what of the history bounds T and A, and their derivatives."""
    nu = strain_factor(ask)
    mid, zero = planes.form[0], planes.form[1]
    for c in range(6):
        low, high = stresses[c, 0], stresses[c, 0]
        for i in range(m):
            low, high = min(low, stresses[c, i]), max(high, stresses[c, i])
        mid[c], zero[c] = 0.5 * (low + high), 0.0
    stress, change, low, high, tension = 0.0, 0.0, 1e300, -1e300, -1e300
    for i in range(m):
        p = (stresses[0, i] + stresses[1, i] + stresses[2, i]) / 3.0
        stresses[6, i] = 3.0 * nu * p
        j2 = deviator(stresses, i, zero)
        stress, low, high = max(stress, j2), min(low, p), max(high, p)
        change = max(change, deviator(stresses, i, mid))
        if p + OF_J2 * sqrt(j2) > tension:
            principal = largest_principal(stresses, i)
            if principal > tension:
                tension, planes.instant = principal, i
    stress, change = sqrt(stress), 2.0 * sqrt(change)
    planes.noise = NOISE * (stress + max(abs(low), abs(high)))
    planes.of_tension, planes.of_swing = stress, change
    planes.most[0], planes.most[1] = tension, change
    if ask.criterion == SWT:
        planes.of_swing = (1.0 + nu) * change
        planes.most[1] = OF_J2 * planes.of_swing + (1.0 - 2.0 * nu) * (high - low)


@jit
def look_at(planes, stresses, m, ask, x, y, z, tolerance):
    """Write h, T and A of a plane, from above; returns h from below."""
    planes.planes += 1
    if ask.criterion == SWT:
        T, A = tension_and_strain(stresses, m, x, y, z, 1.0 + ask.poisson_ratio)
        bound = A
    else:
        T = set_path(planes, stresses, m, x, y, z)
        A, bound = longest_chord(planes, stresses, m, ask, T, tolerance)
    planes.seen[0], planes.seen[1], planes.seen[2] = lifted(ask, T, bound, planes.noise), T, bound
    return lifted(ask, T, A, planes.noise)


@jit
def consider(planes, stresses, m, ask, x, y, z, tolerance):
    """Look at a plane, and climb from there if it is the highest so far."""
    h = look_at(planes, stresses, m, ask, x, y, z, tolerance)
    if h > planes.best * (1.0 + 1e-7):
        planes.best, planes.limit = h, max(h, planes.limit)
        planes.normal[0], planes.normal[1], planes.normal[2] = x, y, z
        climb_from(planes, stresses, m, ask, x, y, z)


@jit
def highest(f1, f2, f3, a, b, c, K):
    """Largest value in a triangle of a function whose second derivatives are at least -K.

    Parameters
    ----------
    f1, f2, f3
        Values at the corners.
    a, b, c
        Squares of the sides opposite to them.
    """
    top = max(above(f1, f2, K * c), above(f2, f3, K * a), above(f1, f3, K * b))
    along = 0.5 * (b + c - a)
    det = b * c - along * along
    if K <= 0.0 or det <= 0.0:
        return top
    # Within, the plane through the values plus K/2 (r² - |x|²) has its maximum at x = u (2-1) + v (3-1).
    r, s = (f2 - f1) / K + 0.5 * c, (f3 - f1) / K + 0.5 * b
    u, v = (r * b - s * along) / det, (s * c - r * along) / det
    if u > 0.0 and v > 0.0 and u + v < 1.0:
        top = max(top, f1 + 0.5 * K * (u * r + v * s))
    return top


@jit
def bound_in(planes, ask, k, limit):
    """Bound of h in triangle k, or anything below the limit; and the first corner of its longest side."""
    v = planes.corner
    a, b, c = 0.0, 0.0, 0.0
    for e in range(3):
        a += (v[k, 1, e] - v[k, 2, e]) * (v[k, 1, e] - v[k, 2, e])
        b += (v[k, 2, e] - v[k, 0, e]) * (v[k, 2, e] - v[k, 0, e])
        c += (v[k, 0, e] - v[k, 1, e]) * (v[k, 0, e] - v[k, 1, e])
    longest = 1 if a >= b and a >= c else 2 if b >= c else 0
    # On the flat triangle, which no point leaves by more than the radius, arcs are seen longer.
    near = 1.0 - 0.36 * max(a, b, c)
    flat = 4.0 * (1.0 / near + 0.6 * sqrt(max(a, b, c)) / (near * sqrt(near)))
    T = min(highest(v[k, 0, 4], v[k, 1, 4], v[k, 2, 4], a, b, c, flat * planes.of_tension), planes.most[0])
    A = min(highest(v[k, 0, 5], v[k, 1, 5], v[k, 2, 5], a, b, c, flat * planes.of_swing), planes.most[1])
    bound = lifted(ask, T, A, planes.noise)
    if bound > limit:
        slope = slope_bound(planes.of_tension, planes.most[0])
        K = flat * curvature_bound(ask, T, A, planes.of_tension, planes.of_swing, slope)
        bound = min(bound, highest(v[k, 0, 3], v[k, 1, 3], v[k, 2, 3], a, b, c, K))
    return bound, longest


@jit
def cut_triangle(planes, stresses, m, ask, k, longest, at, tolerance):
    """Halve the longest side of triangle k; the halves become triangles `at` and `at` + 1."""
    v, i, j = planes.corner, longest, (longest + 1) % 3
    x, y, z = v[k, i, 0] + v[k, j, 0], v[k, i, 1] + v[k, j, 1], v[k, i, 2] + v[k, j, 2]
    shrink = 1.0 / sqrt(x * x + y * y + z * z)
    x, y, z = shrink * x, shrink * y, shrink * z
    consider(planes, stresses, m, ask, x, y, z, tolerance)
    for c in range(3):
        for e in range(6):
            value = v[k, c, e]
            v[at, c, e], v[at + 1, c, e] = value, value
    for half in range(2):
        corner = v[at + half, j if half == 0 else i]
        corner[0], corner[1], corner[2] = x, y, z
        for e in range(3):
            corner[3 + e] = planes.seen[e]


@jit
def first_triangles(planes, stresses, m, ask, tolerance):
    """Look at the planes normal to the axes, corners of a quarter each of the upper half of all normals."""
    for axis in range(3):
        x, y, z = 1.0 if axis == 0 else 0.0, 1.0 if axis == 1 else 0.0, 1.0 if axis == 2 else 0.0
        consider(planes, stresses, m, ask, x, y, z, tolerance)
        for k in range(4):
            corner = planes.corner[k, axis]
            corner[0], corner[1], corner[2] = x, y, z
            if (axis == 0 and k & 1) or (axis == 1 and k & 2):
                corner[axis] = -1.0
            for e in range(3):
                corner[3 + e] = planes.seen[e]


@jit
def highest_plane(planes, stresses, m, ask, floor, tolerance):
    """Largest h over all planes, to a tolerance. Below the floor it may be low.

    Parameters
    ----------
    planes
        Record of `PLANES`. Its normal is a first guess, or 0, and the plane's normal afterwards.
    stresses, m
        Array of `ROWS` rows: the six components at m instants, and room.
    ask
        The criterion.
    floor
        The least value of interest, as h (`swtstudy.kernel.criterion.lift`).
    tolerance
        Relative, of h.
    """
    measure(planes, stresses, m, ask)
    planes.best, planes.limit, planes.planes, planes.unsettled = 0.0, floor, 0, 0
    if ask.criterion == SWT and planes.most[0] <= NO_TENSION * planes.of_tension:
        return 0.0
    x, y, z = planes.normal[0], planes.normal[1], planes.normal[2]
    if x != 0.0 or y != 0.0 or z != 0.0:
        climb_from(planes, stresses, m, ask, x, y, z)
    if planes.best == 0.0:
        climb_from_principal(planes, stresses, m, ask)
    slack = NEXT_TO_NOTHING * tolerance * lifted(ask, planes.most[0], planes.most[1], 0.0)
    first_triangles(planes, stresses, m, ask, 0.25 * tolerance)
    done, count = 0, 4
    while count > done:
        k = done
        if done < IN_ORDER:
            done += 1
        else:
            count -= 1
            k = count
        limit = planes.limit * (1.0 + tolerance) + slack
        bound, longest = bound_in(planes, ask, k, limit)
        if bound <= limit:
            continue
        if count + 2 > MAX_TRIANGLES or planes.planes > MOST_PLANES:
            planes.unsettled = 1
            continue
        cut_triangle(planes, stresses, m, ask, k, longest, count, 0.25 * tolerance)
        count += 2
    return planes.best


@jit
def highest_planes(planes, stresses, histories, ask, tolerance, values, normals):
    """Write the criterion and the normal of its plane for each of some histories, (n, m, 6).

    Returns for how many the search ended before its bound was met.
    """
    m, unsettled = histories.shape[1], 0
    for j in range(histories.shape[0]):
        for i in range(m):
            for c in range(6):
                stresses[c, i] = histories[j, i, c]
        planes.normal[0], planes.normal[1], planes.normal[2] = 0.0, 0.0, 0.0
        values[j] = value_of(ask, highest_plane(planes, stresses, m, ask, 0.0, tolerance))
        unsettled += planes.unsettled
        for c in range(3):
            normals[j, c] = planes.normal[c]
    return unsettled


def planes_of(histories, ask, tolerance):
    """Critical planes of histories.

    Parameters
    ----------
    histories
        Shape (n, m, 6).
    ask
        Record of `swtstudy.kernel.criterion.ASK`.
    tolerance
        Relative, of h.

    Returns
    -------
    values, normals, unsettled
        The criterion, (n,); unit normals, (n, 3), 0 where the criterion is 0; and for how many histories the
        search ended before its bound was met.
    """
    n, m = histories.shape[:2]
    values, normals = np.empty(n), np.empty((n, 3))
    histories = np.ascontiguousarray(histories, dtype=float)
    room = new_record(PLANES), np.zeros((ROWS, m))
    unsettled = highest_planes(*room, histories, ask, float(tolerance), values, normals)
    return values, normals, int(unsettled)
