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
MEAN = np.dtype(
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
def half_arc(mean, d, r):
    """Half of the angle of the arc that the sphere cuts out of a circle about the axis."""
    chord = sqrt(max((mean.reach - d) * (mean.reach + d), 0.0))
    return 2.0 * asin(min(chord / max(2.0 * sqrt(mean.centre * r), 1e-150), 1.0))


@jit
def place_in(mean, u, w):
    """Distance from the centre, and radius and depth, of (u, w), and the largest inclination."""
    d, most = mean.reach * u * u, pi
    if mean.plane == 0:  # up to the axis
        most = acos(-mean.centre / max(d, mean.centre)) if mean.centre > 0.0 else 0.5 * pi
    phi = most * w * w * (3.0 - 2.0 * w)
    r = mean.centre + d * cos(phi)
    return d, r if mean.plane else max(r, 0.0), d * sin(phi), most


@jit
def node_of(mean, k, i, j, m):
    """Place x, y, z of node (i, j) of cell k, value number m on its arc."""
    u = mean.low[k, 0] + (mean.high[k, 0] - mean.low[k, 0]) * NODE[i]
    w = mean.low[k, 1] + (mean.high[k, 1] - mean.low[k, 1]) * NODE[j]
    if mean.kind == LINE:
        d = mean.reach * u * u
        return mean.x + d * mean.into[0], 0.0, d * mean.into[1]
    d, r, z, _ = place_in(mean, u, w)
    side = 1.0 if mean.x >= 0.0 else -1.0
    theta = 0.0 if mean.plane else half_arc(mean, d, r) * ALONG[mean.along, m]
    return side * r * cos(theta), r * sin(theta), z


@jit
def write_series(mean, at):
    """Write the polynomials of a cell from values at its nodes, (WHAT, NODES, NODES)."""
    rows = NODES if mean.kind == SPHERE else 1
    for what in range(WHAT):
        for a in range(NODES):
            for b in range(rows):
                total = 0.0
                for i in range(NODES):
                    for j in range(rows):
                        total += TO_SERIES[a, i] * (TO_SERIES[b, j] if rows > 1 else 1.0) * at[what, i, j]
                mean.value[what, a, b] = total


@jit
def fill_cell(mean, k, body, largest, floor, tolerance, proof):
    """Evaluate the criterion at the nodes of cell k, and integrate it."""
    at = np.zeros((WHAT, NODES, NODES))
    for i in range(NODES):
        for j in range(NODES if mean.kind == SPHERE else 1):
            for m in range(mean.along):
                x, y, z = node_of(mean, k, i, j, m)
                value, missing = largest_at(body, x, y, z, largest, floor, tolerance, proof, COARSEST)
                at[0, i, j] += OF_ALONG[mean.along, m] * value
                at[1, i, j] += OF_ALONG[mean.along, m] * missing
                mean.largest = max(mean.largest, value)
                mean.evaluated += 1
    write_series(mean, at)
    integrate_cell(mean, k)


@jit
def integrate_cell(mean, k):
    """Integrals of cell k, and what it lacks."""
    rows = NODES if mean.kind == SPHERE else 1
    u0, u1, w0, w1 = mean.low[k, 0], mean.high[k, 0], mean.low[k, 1], mean.high[k, 1]
    mean.integral[k], mean.missing[k], mean.volume[k] = 0.0, 0.0, 0.0
    change_u, change_w, off_u, off_w = 0.0, 0.0, 0.0, 0.0
    for e in range(FINE):
        # A sphere's arcs end like a root at its pole.
        t, of_u = GAUSS[e], WEIGHT[e] * (u1 - u0)
        if u1 == 1.0 and mean.kind == SPHERE:
            of_u *= 2.0 * (1.0 - t)
            t = t * (2.0 - t)
        u = u0 + (u1 - u0) * t
        legendre(mean.p[0], 2.0 * t - 1.0)
        for f in range(FINE if rows > 1 else 1):
            weight = of_u * 2.0 * mean.reach * u
            mean.p[1, 0] = 1.0
            if rows > 1:
                w = w0 + (w1 - w0) * GAUSS[f]
                legendre(mean.p[1], 2.0 * GAUSS[f] - 1.0)
                d, r, _, most = place_in(mean, u, w)
                weight *= WEIGHT[f] * (w1 - w0) * 6.0 * w * (1.0 - w) * most * d
                if mean.plane == 0:
                    weight *= r * half_arc(mean, d, r)
            value, lack, top_u, top_w = 0.0, 0.0, 0.0, 0.0
            for a in range(NODES):
                for b in range(rows):
                    base = mean.p[0, a] * mean.p[1, b]
                    term = base * mean.value[0, a, b]
                    value += term
                    lack += base * mean.value[1, a, b]
                    if a >= NODES - TOP:
                        top_u += term
                    if rows > 1 and b >= NODES - TOP:
                        top_w += term
            mean.integral[k] += weight * value
            mean.missing[k] += weight * lack
            mean.volume[k] += weight
            change_u += weight * top_u
            change_w += weight * top_w
            off_u += weight * abs(top_u)
            off_w += weight * abs(top_w)
    mean.lacking[k, 0] = OF_CHANGE * abs(change_u) + OF_OFF[mean.kind] * off_u
    mean.lacking[k, 1] = OF_CHANGE * abs(change_w) + OF_OFF[mean.kind] * off_w


@jit
def sum_cells(mean):
    """Write the mean and its error."""
    whole, missing, volume, lacking = 0.0, 0.0, 0.0, 0.0
    for k in range(mean.cells):
        whole += mean.integral[k]
        missing += mean.missing[k]
        volume += mean.volume[k]
        lacking += mean.lacking[k, 0] + mean.lacking[k, 1]
    mean.average, mean.of_cells = whole / volume, lacking / volume
    mean.error = CLAIMED * mean.of_cells + abs(missing / volume) + OF_VALUE * abs(mean.average)
    if mean.average < 0.0:  # a mean of values that are never negative
        mean.error -= mean.average
        mean.average = 0.0


@jit
def worst_cell(mean, rtol):
    """The cell that most is lacking in, and the axis; -1 if the mean is accurate enough."""
    size, of_values = ENOUGH * rtol * mean.average, mean.error - CLAIMED * mean.of_cells
    least = OF_LARGEST * mean.largest if mean.kind == LINE else 0.0
    if mean.of_cells <= max(size - of_values, 0.5 * size, least):
        return -1, 0
    k, axis, most = 0, 0, 0.0
    for i in range(mean.cells):
        for a in range(2):
            if mean.lacking[i, a] > most:
                k, axis, most = i, a, mean.lacking[i, a]
    return k, axis


@jit
def lay_cells(mean, first):
    """Lay out the first cells."""
    along, across = (first, first) if mean.kind == SPHERE else (first * first, 1)
    mean.cells = along * across
    for k in range(mean.cells):
        i, j = k // across, k % across
        mean.low[k, 0], mean.high[k, 0] = i / along, (i + 1.0) / along
        mean.low[k, 1], mean.high[k, 1] = j / across, (j + 1.0) / across


@jit
def halve_cell(mean, k, axis):
    """Halve cell k along an axis; the other half is the last cell."""
    y = mean.cells
    mean.cells += 1
    middle = 0.5 * (mean.low[k, axis] + mean.high[k, axis])
    for a in range(2):
        mean.low[y, a], mean.high[y, a] = mean.low[k, a], mean.high[k, a]
    mean.high[k, axis], mean.low[y, axis] = middle, middle


@jit
def mean_at(mean, body, kind, x, right, down, distance, largest, known, rtol, first):
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
    plane, normal = body.point.profile.plane, body.planes.normal
    mean.kind, mean.plane, mean.x, mean.centre = kind, plane, x, abs(x)
    mean.largest, mean.evaluated = 0.0, 0
    mean.into[0], mean.into[1] = right, down
    normal[0], normal[1], normal[2] = 0.0, 0.0, 0.0
    if kind == POINT:
        half, tolerance = 0.5 * distance, SINGLE * rtol
        own = x + half * right, 0.0, half * down, largest, 0.0, tolerance, 0.5 * tolerance, 2 * COARSEST
        value, missing = largest_at(body, *own)
        mean.average, mean.error = value, max(missing + OF_VALUE * value, OF_POINT * value)
        return
    mean.reach, mean.along = (distance if kind == SPHERE else 2.0 * distance), 1
    if kind == SPHERE and mean.plane == 0:
        for i in range(REACH.shape[0]):
            mean.along += distance > REACH[i] * mean.centre
    floor, tolerance = FLOOR * known, AVERAGED * rtol
    proof = PROOF * tolerance
    lay_cells(mean, first)
    for k in range(mean.cells):
        fill_cell(mean, k, body, largest, floor, tolerance, proof)
    while True:
        sum_cells(mean)
        k, axis = worst_cell(mean, rtol)
        if k < 0 or mean.cells >= MAX_CELLS or mean.evaluated >= MOST_VALUES:
            break
        halve_cell(mean, k, axis)
        for cell in (k, mean.cells - 1):
            fill_cell(mean, cell, body, largest, floor, tolerance, proof)
    if kind == LINE:
        mean.error += OF_LARGEST * mean.largest
