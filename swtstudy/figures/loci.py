"""Where a surface is least and greatest along x, found between the points of its grid."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.points import FloatArray

#: A row whose range is a smaller share of the whole surface's is flat: it has no place of an extremum.
_FLAT = 0.02
#: Ends that differ by a smaller share of the range are one place of a period.
_SAME_ENDS = 1e-3
#: A step along x that is a larger share of its range leads to another extremum.
_JUMP = 0.1
#: A smaller share of the rows is no line.
_LEAST_SHARE = 0.08


def lowest(x: FloatArray, values: FloatArray, angle: bool) -> FloatArray:
    """Place of the least value in each row, as the vertex of the parabola through it and its neighbours.

    Parameters
    ----------
    x
        Shape (nx,), ascending.
    values
        Shape (ny, nx); NaN where unknown.
    angle
        Whether x may close to a turn: it does if both ends of all rows are equal.

    Returns
    -------
    numpy.ndarray
        Shape (ny,): NaN where a row is flat, and for runs of few rows between two jumps.
    """
    known = np.where(np.isfinite(values), values, np.inf)
    heights = np.array([np.ptp(row[np.isfinite(row)]) if np.isfinite(row).any() else 0.0 for row in values])
    whole = float(heights.max(initial=0.0))
    turn = float(x[-1] - x[0])
    closed = angle and bool(np.all(np.abs(values[:, 0] - values[:, -1]) <= _SAME_ENDS * whole))
    places = np.full(len(values), np.nan)
    for row, least in enumerate(known.argmin(axis=1)):
        if heights[row] > _FLAT * whole:
            places[row] = _vertex(x, known[row], int(least), turn if closed else None)
    return _runs(places, turn)


def _vertex(x: FloatArray, row: FloatArray, least: int, turn: float | None) -> float:
    """The lowest point of the parabola through three neighbours; at an end that is not closed the end."""
    last = len(x) - 1
    if 0 < least < last:
        at, values = x[least - 1 : least + 2], row[least - 1 : least + 2]
    elif turn is None or last < 2:
        return float(x[least])
    else:
        at = np.array([x[-2] - turn, x[0], x[1]]) + (turn if least == last else 0.0)
        values = row[[-2, least, 1]]
    left, right = (values[1] - values[0]) / (at[1] - at[0]), (values[2] - values[1]) / (at[2] - at[1])
    if not (np.isfinite(left) and np.isfinite(right) and right > left):
        return float(x[least])
    # The slope falls linearly from the middle of one step to that of the other.
    middle, next_middle = 0.5 * (at[0] + at[1]), 0.5 * (at[1] + at[2])
    place = float(np.clip(middle - left * (next_middle - middle) / (right - left), middle, next_middle))
    return place if turn is None else float(x[0] + (place - x[0]) % turn)


def _runs(places: FloatArray, turn: float) -> FloatArray:
    """Without runs of few rows between jumps."""
    kept = places.copy()
    for begin, end in pairwise([*jumps(places, turn), len(places)]):
        if end - begin < _LEAST_SHARE * len(places):
            kept[begin:end] = np.nan
    return kept


def jumps(places: FloatArray, turn: float) -> NDArray[np.intp]:
    """The rows at which another run begins."""
    step = np.abs(np.diff(places, prepend=np.nan))
    return np.flatnonzero(~(step <= _JUMP * turn))
