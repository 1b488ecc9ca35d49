"""Means of the criterion about a place of the surface line: over half spheres or half discs, and along lines.

The field is known at nodes of cells, which are halved where it is least known; each cell's polynomial is
integrated over the spheres of all radii ℓ, or along the lines up to all 2ℓ, as far as they hold the cell.

A cell of a half sphere lies in the half plane through the axis and the centre: it is a range of u and w, with
d = ℓ u² the distance from the centre, ℓ the largest radius, and φ = φ_max w² (3 - 2w) the inclination. Edge
and slip fronts are circles about the axis, beside which the criterion grows like √d: it is smooth in u. A
sphere cuts an arc |θ| < Θ out of the circle through each place, and along it the criterion is an even
polynomial in θ: few values tell it, at Gauss's nodes of the arc of the largest sphere. A cell of a line is a
range of u alone.

With the terms of the two highest powers left out in u, or in w, a cell's integral changes: what cells lack
is a share of that.
"""

from math import acos, asin, cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.body import COARSEST, PROOF, largest_at
from swtstudy.kernel.compiled import jit, new_record

#: Nodes of a cell in u and w, and Gauss's points of its integrals.
NODES, FINE = 5, 8
#: Highest powers that tell what a cell lacks: an even and an odd one, one of which a kink in its middle has.
TOP = 2
#: Most cells, distances and values on half an arc.
MAX_CELLS, MAX_DISTANCES, MAX_ALONG = 1009, 61, 5
#: Largest radius of the spheres over the centre's distance from the axis up to which so many values, from one
#: on, are enough on half an arc.
REACH = np.array([0.35, 0.8, 1.0])
#: Cells at first in u and w, and on a line.
FIRST, ON_LINE = (2, 2), 4
#: Kinds of cells.
SPHERE, LINE = np.arange(2)
#: What a cell lacks over the change of its integral without the highest powers, and over the integral of the
#: amount of these, which does not cancel: of half spheres, in which kinks are at many places of a cell, and
#: of lines.
OF_CHANGE, OF_OFF = 0.15, np.array([0.06, 0.2])
#: Cells are halved until they lack such a share of the accuracy asked for; and what is claimed over what they
#: lack: a kink may hide in one cell (results/nonlocal_means.md).
ENOUGH, CLAIMED = 0.7, 2.5
#: Accuracy of single values and of those that are averaged, over that of the means; and the least error that
#: is claimed of a value, of planes and cells, and of a single one, in which a missed peak does not average
#: out; relative.
SINGLE, AVERAGED, OF_VALUE, OF_POINT = 0.03, 0.3, 1e-4, 1e-3
#: Values below this share of those at ℓ/2 are not told as closely; the least error claimed on lines, over the
#: largest value there.
FLOOR, OF_LARGEST = 0.02, 2e-5
#: Most values at places.
MOST_VALUES = 3000


def _nodes():
    """Gauss's nodes on [0, 1] of a cell, and the matrices that take values there to Legendre coefficients."""
    node, weight = np.polynomial.legendre.leggauss(NODES)
    legendre = np.polynomial.legendre.legvander(node, NODES - 1)
    to_series = (legendre * weight[:, None]).T * (np.arange(NODES) + 0.5)[:, None]
    return 0.5 + 0.5 * node, np.ascontiguousarray(to_series)


def _along():
    """For each number of values on half an arc their places over its length, and matrices to even powers."""
    places, to_powers = np.zeros((MAX_ALONG + 1, MAX_ALONG)), np.zeros((MAX_ALONG + 1, MAX_ALONG, MAX_ALONG))
    for count in range(1, MAX_ALONG + 1):
        node = np.polynomial.legendre.leggauss(2 * count)[0][count:]
        places[count, :count] = node
        to_powers[count, :count, :count] = np.linalg.inv(np.vander(node * node, increasing=True))
    return places, to_powers


NODE, TO_SERIES = _nodes()
ALONG, TO_POWERS = _along()
POINT, WEIGHT = np.polynomial.legendre.leggauss(FINE)
POINT, WEIGHT = 0.5 + 0.5 * POINT, 0.5 * WEIGHT
#: Values that a cell's polynomial is made of: the criterion, and what it may miss.
WHAT = 2
CELLS = np.dtype(
    [
        ("kind", "i8"),
        ("plane", "i8"),
        ("centre", "f8"),  # distance of the place from the axis
        ("x", "f8"),
        ("into", "f8", (2,)),  # a line's direction: right, down
        ("distances", "i8"),
        ("distance", "f8", (MAX_DISTANCES,)),  # ℓ
        ("reach", "f8"),  # the largest of them, or twice that
        ("along", "i8"),
        ("cells", "i8"),
        ("evaluated", "i8"),
        ("low", "f8", (MAX_CELLS, 2)),  # u and w
        ("high", "f8", (MAX_CELLS, 2)),
        ("value", "f8", (MAX_CELLS, WHAT, MAX_ALONG, NODES, NODES)),  # Legendre series by powers of θ²
        ("integral", "f8", (MAX_CELLS, MAX_DISTANCES)),
        ("missing", "f8", (MAX_CELLS, MAX_DISTANCES)),
        ("volume", "f8", (MAX_CELLS, MAX_DISTANCES)),
        ("lacking", "f8", (MAX_CELLS, MAX_DISTANCES, 2)),  # in u and w
        ("average", "f8", (MAX_DISTANCES,)),
        ("error", "f8", (MAX_DISTANCES,)),
        ("of_cells", "f8", (MAX_DISTANCES,)),
        ("largest", "f8"),  # value
        ("p", "f8", (2, NODES)),  # Legendre polynomials at a point
        ("of_theta", "f8", (MAX_ALONG,)),
    ]
)


def cells():
    """The memory for means that one thread needs, beside that of the body."""
    return new_record(CELLS)


@jit
def legendre(p, y):
    """Write Legendre polynomials at y in [-1, 1]."""
    p[0], p[1] = 1.0, y
    for k in range(2, NODES):
        p[k] = ((2.0 * k - 1.0) * y * p[k - 1] - (k - 1.0) * p[k - 2]) / k


@jit
def half_arc(M, size, d, r):
    """Half of the angle of the arc that a sphere of a radius cuts out of a circle about the axis."""
    chord = sqrt(max((size - d) * (size + d), 0.0))
    return 2.0 * asin(min(chord / max(2.0 * sqrt(M.centre * r), 1e-150), 1.0))


@jit
def place_in(M, u, w):
    """Distance from the centre, and radius and depth, of (u, w), and the largest inclination."""
    d = M.reach * u * u
    if M.kind == LINE:
        return d, 0.0, 0.0, 0.0
    most = pi
    if M.plane == 0:  # up to the axis
        most = acos(-M.centre / max(d, M.centre)) if M.centre > 0.0 else 0.5 * pi
    phi = most * w * w * (3.0 - 2.0 * w)
    return d, M.centre + d * cos(phi), d * sin(phi), most


@jit
def node_of(M, k, i, j, m):
    """Place x, y, z of node (i, j) of cell k, value number m on its arc."""
    u = M.low[k, 0] + (M.high[k, 0] - M.low[k, 0]) * NODE[i]
    w = M.low[k, 1] + (M.high[k, 1] - M.low[k, 1]) * NODE[j]
    d, r, z, _ = place_in(M, u, w)
    if M.kind == LINE:
        return M.x + d * M.into[0], 0.0, d * M.into[1]
    side = 1.0 if M.x >= 0.0 else -1.0
    if M.plane:
        return side * r, 0.0, z
    r = max(r, 0.0)
    theta = half_arc(M, M.reach, d, r) * ALONG[M.along, m]
    return side * r * cos(theta), r * sin(theta), z


@jit
def write_series(M, k, at):
    """Write the polynomial of cell k from values at its nodes, (WHAT, MAX_ALONG, NODES, NODES)."""
    rows = NODES if M.kind == SPHERE else 1
    for what in range(WHAT):
        for power in range(M.along):
            for a in range(NODES):
                for b in range(rows):
                    total = 0.0
                    for m in range(M.along):
                        for i in range(NODES):
                            for j in range(rows):
                                part = TO_SERIES[a, i] * (TO_SERIES[b, j] if rows > 1 else 1.0)
                                total += TO_POWERS[M.along, power, m] * part * at[what, m, i, j]
                    M.value[k, what, power, a, b] = total


@jit
def fill_cell(M, k, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, tolerance, proof):
    """Evaluate the criterion at the nodes of cell k, and integrate it."""
    at = np.empty((WHAT, MAX_ALONG, NODES, NODES))
    for i in range(NODES):
        for j in range(NODES if M.kind == SPHERE else 1):
            for m in range(M.along):
                x, y, z = node_of(M, k, i, j, m)
                at[0, m, i, j], at[1, m, i, j] = largest_at(
                    S, B, H, W, G, C, R, P, K, L, Q, x, y, z, largest, floor, tolerance, proof, COARSEST
                )
                M.largest = max(M.largest, at[0, m, i, j])
                M.evaluated += 1
    write_series(M, k, at)
    for n in range(M.distances):
        integrate_cell(M, k, n)


@jit
def integrate_cell(M, k, n):
    """Integrals of cell k over the part of it that is within ℓ number n, and what it lacks."""
    rows = NODES if M.kind == SPHERE else 1
    size = M.distance[n] * (1.0 if M.kind == SPHERE else 2.0)
    u0, u1, w0, w1 = M.low[k, 0], M.high[k, 0], M.low[k, 1], M.high[k, 1]
    end = min(u1, sqrt(size / M.reach))
    clipped = u1 >= end * (1.0 - 1e-12) and end < u1 + 1e-12 and end * end * M.reach >= size * (1.0 - 1e-9)
    whole, missing, volume = 0.0, 0.0, 0.0
    change_u, change_w, off_u, off_w = 0.0, 0.0, 0.0, 0.0
    for e in range(FINE if end > u0 else 0):
        # A sphere's arcs end like a root at its pole.
        t, of_u = POINT[e], WEIGHT[e] * (end - u0)
        if clipped and M.kind == SPHERE:
            of_u *= 2.0 * (1.0 - t)
            t = t * (2.0 - t)
        u = u0 + (end - u0) * t
        legendre(M.p[0], 2.0 * (u - u0) / (u1 - u0) - 1.0)
        for f in range(FINE if rows > 1 else 1):
            weight = of_u * 2.0 * M.reach * u
            if rows > 1:
                w = w0 + (w1 - w0) * POINT[f]
                legendre(M.p[1], 2.0 * POINT[f] - 1.0)
                d, r, _, most = place_in(M, u, w)
                weight *= WEIGHT[f] * (w1 - w0) * 6.0 * w * (1.0 - w) * most * d
                M.of_theta[0] = 1.0
                if M.plane == 0:
                    r = max(r, 0.0)
                    arc = half_arc(M, M.reach, d, r)
                    share = half_arc(M, size, d, r) / arc if arc > 0.0 else 0.0
                    weight *= r * arc * share
                    for power in range(M.along):
                        M.of_theta[power] = share ** (2 * power) / (2.0 * power + 1.0)
            else:
                M.p[1, 0], M.of_theta[0] = 1.0, 1.0
            value, lack, top_u, top_w = 0.0, 0.0, 0.0, 0.0
            for power in range(M.along):
                for a in range(NODES):
                    for b in range(rows):
                        base = M.of_theta[power] * M.p[0, a] * M.p[1, b]
                        term = base * M.value[k, 0, power, a, b]
                        value += term
                        lack += base * M.value[k, 1, power, a, b]
                        if a >= NODES - TOP:
                            top_u += term
                        if rows > 1 and b >= NODES - TOP:
                            top_w += term
            whole += weight * value
            missing += weight * lack
            volume += weight
            change_u += weight * top_u
            change_w += weight * top_w
            off_u += weight * abs(top_u)
            off_w += weight * abs(top_w)
    M.integral[k, n], M.missing[k, n], M.volume[k, n] = whole, missing, volume
    M.lacking[k, n, 0] = OF_CHANGE * abs(change_u) + OF_OFF[M.kind] * off_u
    M.lacking[k, n, 1] = OF_CHANGE * abs(change_w) + OF_OFF[M.kind] * off_w


@jit
def sum_cells(M):
    """Write the means and their errors."""
    for n in range(M.distances):
        whole, missing, volume, lacking = 0.0, 0.0, 0.0, 0.0
        for k in range(M.cells):
            whole += M.integral[k, n]
            missing += M.missing[k, n]
            volume += M.volume[k, n]
            lacking += M.lacking[k, n, 0] + M.lacking[k, n, 1]
        M.average[n], M.of_cells[n] = whole / volume, lacking / volume
        M.error[n] = CLAIMED * M.of_cells[n] + abs(missing / volume) + OF_VALUE * abs(M.average[n])
        if M.average[n] < 0.0:  # a mean of values that are never negative
            M.error[n] -= M.average[n]
            M.average[n] = 0.0


@jit
def worst_cell(M, rtol):
    """The cell that most is lacking in, and the axis; -1 if the means are accurate enough."""
    worst, of = 1.0, -1
    for n in range(M.distances):
        size, of_values = ENOUGH * rtol * M.average[n], M.error[n] - CLAIMED * M.of_cells[n]
        allowed = max(size - of_values, 0.5 * size, OF_LARGEST * M.largest)
        if M.of_cells[n] > worst * allowed:
            worst, of = M.of_cells[n] / allowed, n
    if of < 0:
        return -1, 0
    k, axis, most = 0, 0, 0.0
    for i in range(M.cells):
        for a in range(2):
            if M.lacking[i, of, a] > most:
                k, axis, most = i, a, M.lacking[i, of, a]
    return k, axis


@jit
def lay_cells(M):
    """Lay out the first cells."""
    first, second = (FIRST[0], FIRST[1]) if M.kind == SPHERE else (ON_LINE, 1)
    M.cells = 0
    for i in range(first):
        for j in range(second):
            k = M.cells
            M.cells += 1
            M.low[k, 0], M.high[k, 0] = i / first, (i + 1.0) / first
            M.low[k, 1], M.high[k, 1] = j / second, (j + 1.0) / second


@jit
def halve_cell(M, k, axis):
    """Halve cell k along an axis; the other half is the last cell."""
    y = M.cells
    M.cells += 1
    middle = 0.5 * (M.low[k, axis] + M.high[k, axis])
    for a in range(2):
        M.low[y, a], M.high[y, a] = M.low[k, a], M.high[k, a]
    M.high[k, axis], M.low[y, axis] = middle, middle


@jit
def mean_over(M, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, rtol):
    """Halve cells until the means are accurate, or there are too many values."""
    tolerance = AVERAGED * rtol
    proof = PROOF * tolerance
    M.evaluated = 0
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    lay_cells(M)
    for k in range(M.cells):
        fill_cell(M, k, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, tolerance, proof)
    while True:
        sum_cells(M)
        k, axis = worst_cell(M, rtol)
        if k < 0 or M.cells >= MAX_CELLS or M.evaluated >= MOST_VALUES:
            break
        halve_cell(M, k, axis)
        for cell in (k, M.cells - 1):
            fill_cell(M, cell, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, tolerance, proof)


@jit
def means_at(M, S, B, H, W, G, C, R, P, K, L, Q, x, double_angle, distance, largest, rtol, found):
    """Write means about the place x of the surface line for k distances, and their errors, shape (5, k, 2).

    Over half spheres; at ℓ/2 straight down, and along the critical plane; and over 0 … 2ℓ likewise.
    """
    reach, sine, cosine = 0.0, sin(0.5 * double_angle), cos(0.5 * double_angle)
    M.plane, M.x, M.centre, M.distances, M.largest = P.plane, x, abs(x), distance.shape[0], 0.0
    for n in range(M.distances):
        M.distance[n] = distance[n]
        reach = max(reach, distance[n])
    sign = 1.0 if cosine >= 0.0 else -1.0
    for n in range(M.distances):
        for way in range(2):
            right, down = (0.0, 1.0) if way == 0 else (-sine * sign, cosine * sign)
            G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
            half, tolerance = 0.5 * distance[n], SINGLE * rtol
            own = x + half * right, 0.0, half * down
            value, missing = largest_at(
                S, B, H, W, G, C, R, P, K, L, Q, *own, largest, 0.0, tolerance, 0.5 * tolerance, 2 * COARSEST
            )
            M.largest = max(M.largest, value)
            found[1 + way, n, 0] = value
            found[1 + way, n, 1] = max(missing + OF_VALUE * value, OF_POINT * value)
    floor = FLOOR * M.largest
    M.kind, M.reach, M.along = SPHERE, reach, 1
    if M.plane == 0:
        for i in range(REACH.shape[0]):
            M.along += reach > REACH[i] * M.centre
        M.along += M.distances > 1
    mean_over(M, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, rtol)
    for n in range(M.distances):
        found[0, n, 0], found[0, n, 1] = M.average[n], M.error[n]
    M.kind, M.reach, M.along = LINE, 2.0 * reach, 1
    for way in range(2):
        M.into[0], M.into[1] = (0.0, 1.0) if way == 0 else (-sine * sign, cosine * sign)
        mean_over(M, S, B, H, W, G, C, R, P, K, L, Q, largest, floor, rtol)
        for n in range(M.distances):
            found[3 + way, n, 0] = M.average[n]
            found[3 + way, n, 1] = M.error[n] + OF_LARGEST * M.largest
            found[1 + way, n, 1] += OF_LARGEST * M.largest
