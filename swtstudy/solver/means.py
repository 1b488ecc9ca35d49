"""swt not at a point but over a critical distance ℓ: means over a volume or a line, and the point method.

The field swt(x, y, z), each value with its own critical plane, is averaged over the half sphere of radius ℓ
about the critical point, in a plane contact over the half disc in its section; or taken at the depth ℓ/2
(point method), or as the mean over the depths 0 … 2ℓ, straight down or along the critical plane. These are
means of a parameter that is quadratic in stress, not of stress, as Taylor's volume and line methods are.

With ℓ → 0 all three tend to the largest swt over all planes at the critical point. That is s, unless a plane
that does not hold the y axis is higher there, or unless the critical point is the edge r = b of a truncated
paraboloid: beside that the pressure is infinite like a logarithm, and so slow is the limit.

Means are taken about whichever place of the surface line has most of them: the critical point has the largest
swt, but about another local maximum swt may fall off more slowly.
"""

from __future__ import annotations

import numpy as np

from swtstudy.kernel.batch import maxima_batch
from swtstudy.kernel.field import means_about, open_cycle
from swtstudy.kernel.mean import OF_VALUE
from swtstudy.solver.points import Points, Solution
from swtstudy.solver.solve import arguments_of
from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.parameters import DIRECTIONS

#: What each place may be the worst of.
KINDS = ("volume", "point", "line")
#: Relative accuracy of means, and of swt at local maxima; tolerance of what grew in stick.
RTOL, OF_MAXIMA, GROWTH = 1e-3, 1e-4, 1e-5


#: swt over k critical distances at n points, over E* δ0/R as s, NaN without s. ``volume``, shape (n, k), are
#: means over half spheres, or half discs in the plane; ``point`` and ``line``, shape (n, k, 2), values at ℓ/2
#: and means over 0 … 2ℓ in both `DIRECTIONS`. Each has its absolute error, such as ``volume_error``, and the
#: signed x of the points of the surface line that it is about, such as ``volume_x``.
Means = dict[str, FloatArray]


def means_at(
    points: Points, x: FloatArray, angle: FloatArray, distance: FloatArray, rtol: float = RTOL
) -> Means:
    """Means about one place each of n points.

    Parameters
    ----------
    points
        n points.
    x, angle
        Shape (n,): signed x of the places on the surface line, in a_H, and the angle between the normal of
        the worst plane there and the x axis, degrees; NaN where there is none.
    distance
        Shape (k,): ℓ > 0 in a_H.
    rtol
        Relative accuracy asked for.
    """
    shape = len(x), len(distance), len(DIRECTIONS)
    found = {
        f"{kind}{end}": np.full(shape[:2] if kind == "volume" else shape, np.nan)
        for kind in KINDS
        for end in ("", "_error", "_x")
    }
    for row in np.flatnonzero(np.isfinite(x)):
        opened = open_cycle(GROWTH, **arguments_of(points[[row]]))
        means = means_about(opened, x[row], np.radians(2.0 * angle[row]), distance, rtol)
        _raise(found, int(row), means, float(x[row]))
    return found


def _raise(found: Means, row: int, means: FloatArray, x: float) -> None:
    """Take the means about x, (5, k, 2), where they are larger, or where there are none."""
    volume, *rest = means
    for kind, own in zip(KINDS, (volume, np.stack(rest[:2], 1), np.stack(rest[2:], 1)), strict=True):
        value, error, place = (found[f"{kind}{end}"][row] for end in ("", "_error", "_x"))
        # It is not by noise that one of two is taken.
        larger = np.isnan(value) | (own[..., 0] > (1.0 + OF_VALUE) * value)
        value[larger], error[larger], place[larger] = own[larger, 0], own[larger, 1], x


def _least(found: Means, row: int) -> float:
    """The smallest mean of a point."""
    return min(float(found[kind][row].min()) for kind in KINDS)


def worst_means(points: Points, solution: Solution, distance: FloatArray) -> Means:
    """The largest means about the critical points and all other local maxima of swt along the line.

    Each kind, distance and direction has its own place. A maximum is tried if its swt is above one of the
    means found so far: no mean about it could be larger otherwise, but where what is nearby is higher, which
    is tried itself.

    Parameters
    ----------
    points, solution
        n points and their solution.
    distance
        As of `means_at`.
    """
    x, angle = solution.critical_x, solution.critical_angle
    found = means_at(points, x, angle, distance)
    # Where s is 0, or that of the bulk stress far from the contact, no mean anywhere is larger.
    far = np.flatnonzero(np.isnan(x) & np.isfinite(solution.s))
    for kind in KINDS:
        for name, own in ((kind, solution.s), (f"{kind}_error", solution.s_error)):
            found[name][far] = own[far].reshape(-1, *(1,) * (found[name].ndim - 1))
    rows = np.flatnonzero(np.isfinite(x))
    limits = np.array([max(_least(found, int(row)), 0.0) for row in rows]), solution.s[rows]
    others = maxima_batch(*limits, **arguments_of(points[rows]), rtol=OF_MAXIMA) if rows.size else ()
    for row, maxima in zip(rows.tolist(), others, strict=True):
        opened, mirrored = None, (maxima[0] > 0.0).all()  # what is at -x is that of x then
        for place, double_angle, swt, ends in zip(*maxima, strict=True):
            critical = abs(x[row]) if mirrored else x[row]
            # The critical point itself is between the neighbours of one of them.
            if swt <= _least(found, row) or ends.min() <= critical <= ends.max():
                continue
            opened = opened or open_cycle(GROWTH, **arguments_of(points[[row]]))
            _raise(found, row, means_about(opened, place, double_angle, distance, RTOL), float(place))
    return found
