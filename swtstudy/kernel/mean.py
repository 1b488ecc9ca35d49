"""Means of the criterion about a place of the surface line: over half spheres or half discs, and along lines.

The field is known at nodes of cells, which are halved where it is least known.

A cell of a half sphere lies in the half plane through the axis and the centre: it is a range of u and w, with
d = ℓ u² the distance from the centre, ℓ the radius, and φ = φ_max w² (3 - 2w) the inclination. Edge and slip
fronts are circles about the axis, beside which the criterion grows like √d: it is smooth in u. The sphere
cuts an arc |θ| < Θ out of the circle through each place, along which the criterion is even and smooth: its
mean takes few values, at Gauss's nodes. A cell of a line is a range of u alone.

With the terms of the two highest powers left out in u, or in w, a cell's integral changes: what cells lack
is a share of that.
"""

from math import acos, asin, cos, pi, sin, sqrt

import numpy as np

from swtstudy.kernel.body import PROOF, largest_at
from swtstudy.kernel.chebyshev import gauss_legendre
from swtstudy.kernel.compiled import fields, jit
from swtstudy.kernel.parts import COARSEST

#: Nodes of a cell in u and w, and Gauss's points of its integrals.
NODES, FINE = 5, 8
#: Highest powers that tell what a cell lacks: an even and an odd one, one of which a kink in its middle has.
TOP = 2
#: Most cells, and values on half an arc.
MAX_CELLS, MAX_ALONG = 1009, 8
#: Radius of the sphere over the centre's distance from the axis up to which so many values, from one on, are
#: enough on half an arc; a larger sphere holds whole circles, on which the criterion has several peaks.
REACH = np.array([0.35, 0.8, 1.0, 1.2, 1.2, 1.5, 1.5])
#: Cells at first in u and w, the square of that on a line: of means that are told, and of rough ones.
FIRST, ROUGHLY = np.array([2, 1])
#: Kinds of mean: over a half sphere, at one place, along a line.
SPHERE, POINT, LINE = np.arange(3)
#: Error of a cell over the change of its integral without the highest powers, and over the integral of the
#: amount of these, which does not cancel: of half spheres, in which kinks are at many places of a cell, and
#: of lines.
OF_CHANGE, OF_OFF = 0.15, np.array([0.06, 0.0, 0.2])
#: Cells are halved until they lack such a share of the accuracy asked for; and what is claimed over what they
#: lack: a kink may hide in one cell (results/nonlocal_means.md).
ENOUGH, CLAIMED = 0.7, 2.5
#: Accuracy of single values and of averaged values, over the accuracy of the means; and the least error that
#: is claimed of a value, of planes and cells, and of a single one, in which a missed peak does not average
#: out; relative.
SINGLE, AVERAGED, OF_VALUE, OF_POINT = 0.03, 0.3, 1e-4, 1e-3
#: Values below this share of the mean, as far as that is known, are not told as closely; the least error
#: claimed on lines, over the largest value there.
FLOOR, OF_LARGEST = 0.02, 2e-5
#: Most values at places.
MOST_VALUES = 8000


def _nodes():
    """Gauss's nodes on [0, 1] of a cell, and the matrix that takes values there to Legendre coefficients."""
    node, weight = gauss_legendre(NODES)
    legendre = np.polynomial.legendre.legvander(node, NODES - 1)
    to_series = (legendre * weight[:, None]).T * (np.arange(NODES) + 0.5)[:, None]
    return 0.5 + 0.5 * node, np.ascontiguousarray(to_series)


def _along():
    """For each number of values on half an arc their places over its length, and their weights."""
    places, weights = np.zeros((2, MAX_ALONG + 1, MAX_ALONG))
    for count in range(1, MAX_ALONG + 1):
        node, weight = gauss_legendre(2 * count)
        places[count, :count], weights[count, :count] = node[count:], weight[count:]
    return places, weights


NODE, TO_SERIES = _nodes()
ALONG, OF_ALONG = _along()
GAUSS, WEIGHT = gauss_legendre(FINE)
GAUSS, WEIGHT = 0.5 + 0.5 * GAUSS, 0.5 * WEIGHT
#: Values that a cell's polynomial is made of: the criterion, and what it may miss.
WHAT = 2
CELLS = np.dtype(
    [
        *fields("i8", "kind plane along cells evaluated"),
        *fields("f8", "x centre"),  # the place, and its distance from the axis
        ("into", "f8", (2,)),  # a line's direction: right, down
        ("reach", "f8"),  # ℓ of a sphere, 2ℓ of a line
        *fields("f8", "low high lacking", (MAX_CELLS, 2)),  # of cells, in u and w
        *fields("f8", "integral missing volume", (MAX_CELLS,)),
        ("value", "f8", (WHAT, NODES, NODES)),  # Legendre series of one cell
        *fields("f8", "average error of_cells"),
        ("largest", "f8"),  # value
        ("p", "f8", (2, NODES)),  # Legendre polynomials at a point
    ]
)


@jit
def legendre(p, y):
    """Write Legendre polynomials at y in [-1, 1]."""
    p[0], p[1] = 1.0, y
    for k in range(2, NODES):
        p[k] = ((2.0 * k - 1.0) * y * p[k - 1] - (k - 1.0) * p[k - 2]) / k


@jit
def half_arc(M, d, r):
    """Half of the angle of the arc that the sphere cuts out of a circle about the axis."""
    chord = sqrt(max((M.reach - d) * (M.reach + d), 0.0))
    return 2.0 * asin(min(chord / max(2.0 * sqrt(M.centre * r), 1e-150), 1.0))


@jit
def place_in(M, u, w):
    """Distance from the centre, and radius and depth, of (u, w), and the largest inclination."""
    d, most = M.reach * u * u, pi
    if M.plane == 0:  # up to the axis
        most = acos(-M.centre / max(d, M.centre)) if M.centre > 0.0 else 0.5 * pi
    phi = most * w * w * (3.0 - 2.0 * w)
    r = M.centre + d * cos(phi)
    return d, r if M.plane else max(r, 0.0), d * sin(phi), most


@jit
def node_of(M, k, i, j, m):
    """Place x, y, z of node (i, j) of cell k, value number m on its arc."""
    u = M.low[k, 0] + (M.high[k, 0] - M.low[k, 0]) * NODE[i]
    w = M.low[k, 1] + (M.high[k, 1] - M.low[k, 1]) * NODE[j]
    if M.kind == LINE:
        d = M.reach * u * u
        return M.x + d * M.into[0], 0.0, d * M.into[1]
    d, r, z, _ = place_in(M, u, w)
    side = 1.0 if M.x >= 0.0 else -1.0
    theta = 0.0 if M.plane else half_arc(M, d, r) * ALONG[M.along, m]
    return side * r * cos(theta), r * sin(theta), z


@jit
def write_series(M, at):
    """Write the polynomials of a cell from values at its nodes, (WHAT, NODES, NODES)."""
    rows = NODES if M.kind == SPHERE else 1
    for what in range(WHAT):
        for a in range(NODES):
            for b in range(rows):
                total = 0.0
                for i in range(NODES):
                    for j in range(rows):
                        total += TO_SERIES[a, i] * (TO_SERIES[b, j] if rows > 1 else 1.0) * at[what, i, j]
                M.value[what, a, b] = total


@jit
def fill_cell(M, k, body, largest, floor, tolerance, proof):
    """Evaluate the criterion at the nodes of cell k, and integrate it."""
    at = np.zeros((WHAT, NODES, NODES))
    for i in range(NODES):
        for j in range(NODES if M.kind == SPHERE else 1):
            for m in range(M.along):
                x, y, z = node_of(M, k, i, j, m)
                value, missing = largest_at(body, x, y, z, largest, floor, tolerance, proof, COARSEST)
                at[0, i, j] += OF_ALONG[M.along, m] * value
                at[1, i, j] += OF_ALONG[M.along, m] * missing
                M.largest = max(M.largest, value)
                M.evaluated += 1
    write_series(M, at)
    integrate_cell(M, k)


@jit
def integrate_cell(M, k):
    """Integrals of cell k, and what it lacks."""
    rows = NODES if M.kind == SPHERE else 1
    u0, u1, w0, w1 = M.low[k, 0], M.high[k, 0], M.low[k, 1], M.high[k, 1]
    M.integral[k], M.missing[k], M.volume[k] = 0.0, 0.0, 0.0
    change_u, change_w, off_u, off_w = 0.0, 0.0, 0.0, 0.0
    for e in range(FINE):
        # A sphere's arcs end like a root at its pole.
        t, of_u = GAUSS[e], WEIGHT[e] * (u1 - u0)
        if u1 == 1.0 and M.kind == SPHERE:
            of_u *= 2.0 * (1.0 - t)
            t = t * (2.0 - t)
        u = u0 + (u1 - u0) * t
        legendre(M.p[0], 2.0 * t - 1.0)
        for f in range(FINE if rows > 1 else 1):
            weight = of_u * 2.0 * M.reach * u
            M.p[1, 0] = 1.0
            if rows > 1:
                w = w0 + (w1 - w0) * GAUSS[f]
                legendre(M.p[1], 2.0 * GAUSS[f] - 1.0)
                d, r, _, most = place_in(M, u, w)
                weight *= WEIGHT[f] * (w1 - w0) * 6.0 * w * (1.0 - w) * most * d
                if M.plane == 0:
                    weight *= r * half_arc(M, d, r)
            value, lack, top_u, top_w = 0.0, 0.0, 0.0, 0.0
            for a in range(NODES):
                for b in range(rows):
                    base = M.p[0, a] * M.p[1, b]
                    term = base * M.value[0, a, b]
                    value += term
                    lack += base * M.value[1, a, b]
                    if a >= NODES - TOP:
                        top_u += term
                    if rows > 1 and b >= NODES - TOP:
                        top_w += term
            M.integral[k] += weight * value
            M.missing[k] += weight * lack
            M.volume[k] += weight
            change_u += weight * top_u
            change_w += weight * top_w
            off_u += weight * abs(top_u)
            off_w += weight * abs(top_w)
    M.lacking[k, 0] = OF_CHANGE * abs(change_u) + OF_OFF[M.kind] * off_u
    M.lacking[k, 1] = OF_CHANGE * abs(change_w) + OF_OFF[M.kind] * off_w


@jit
def sum_cells(M):
    """Write the mean and its error."""
    whole, missing, volume, lacking = 0.0, 0.0, 0.0, 0.0
    for k in range(M.cells):
        whole += M.integral[k]
        missing += M.missing[k]
        volume += M.volume[k]
        lacking += M.lacking[k, 0] + M.lacking[k, 1]
    M.average, M.of_cells = whole / volume, lacking / volume
    M.error = CLAIMED * M.of_cells + abs(missing / volume) + OF_VALUE * abs(M.average)
    if M.average < 0.0:  # a mean of values that are never negative
        M.error -= M.average
        M.average = 0.0


@jit
def worst_cell(M, rtol):
    """The cell that most is lacking in, and the axis; -1 if the mean is accurate enough."""
    size, of_values = ENOUGH * rtol * M.average, M.error - CLAIMED * M.of_cells
    least = OF_LARGEST * M.largest if M.kind == LINE else 0.0
    if M.of_cells <= max(size - of_values, 0.5 * size, least):
        return -1, 0
    k, axis, most = 0, 0, 0.0
    for i in range(M.cells):
        for a in range(2):
            if M.lacking[i, a] > most:
                k, axis, most = i, a, M.lacking[i, a]
    return k, axis


@jit
def lay_cells(M, first):
    """Lay out the first cells."""
    along, across = (first, first) if M.kind == SPHERE else (first * first, 1)
    M.cells = along * across
    for k in range(M.cells):
        i, j = k // across, k % across
        M.low[k, 0], M.high[k, 0] = i / along, (i + 1.0) / along
        M.low[k, 1], M.high[k, 1] = j / across, (j + 1.0) / across


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
def mean_at(M, S, B, H, W, G, C, R, P, K, L, Q, kind, x, right, down, distance, largest, known, rtol, first):
    """Write the mean about the place x of the surface line, or the value at ℓ/2 from it, and its error.

    Cells are halved until the mean is accurate, or there are too many values.

    Parameters
    ----------
    kind
        `SPHERE`: over the half sphere of radius ℓ, or half disc; `POINT`: at ℓ/2; `LINE`: over 0 … 2ℓ.
    right, down
        Direction of the line.
    distance
        ℓ > 0 in a_H.
    known
        The mean as far as it is known: what is much lower is told roughly.
    first
        `FIRST`, or `ROUGHLY` of a mean that only leads to another.
    """
    body = S, B, H, W, G, C, R, P, K, L, Q
    M.kind, M.plane, M.x, M.centre, M.largest, M.evaluated = kind, P.plane, x, abs(x), 0.0, 0
    M.into[0], M.into[1] = right, down
    G.normal[0], G.normal[1], G.normal[2] = 0.0, 0.0, 0.0
    if kind == POINT:
        half, tolerance = 0.5 * distance, SINGLE * rtol
        own = x + half * right, 0.0, half * down, largest, 0.0, tolerance, 0.5 * tolerance, 2 * COARSEST
        value, missing = largest_at(body, *own)
        M.average, M.error = value, max(missing + OF_VALUE * value, OF_POINT * value)
        return
    M.reach, M.along = (distance if kind == SPHERE else 2.0 * distance), 1
    if kind == SPHERE and M.plane == 0:
        for i in range(REACH.shape[0]):
            M.along += distance > REACH[i] * M.centre
    floor, tolerance = FLOOR * known, AVERAGED * rtol
    proof = PROOF * tolerance
    lay_cells(M, first)
    for k in range(M.cells):
        fill_cell(M, k, body, largest, floor, tolerance, proof)
    while True:
        sum_cells(M)
        k, axis = worst_cell(M, rtol)
        if k < 0 or M.cells >= MAX_CELLS or M.evaluated >= MOST_VALUES:
            break
        halve_cell(M, k, axis)
        for cell in (k, M.cells - 1):
            fill_cell(M, cell, body, largest, floor, tolerance, proof)
    if kind == LINE:
        M.error += OF_LARGEST * M.largest
