"""Places of the labels of contours: on straight stretches, inside the panel, apart from labels and lines."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.path import Path

from swtstudy.vocabulary.arrays import FloatArray

#: All in shares of the panel: steps along a contour; half of the stretch that a label covers.
_STEP, _HALF = 0.01, 0.07
#: A label's centre is so far inside of the frame, from other labels, and from lines that are drawn.
_INSIDE, _APART, _BESIDE = 0.09, 0.17, 0.06
#: A stretch is straight if its chord is no shorter than this share of it.
_STRAIGHT = 0.96


def places_of_labels(axes: Axes, lines: ContourSet, shown: Iterable[float]) -> list[tuple[float, float]]:
    """Points on contours where a label has room, in data coordinates.

    Parameters
    ----------
    axes
        The panel, with its lines that no label should cover.
    lines
        Contours.
    shown
        Levels to be labelled.

    Returns
    -------
    list of (x, y)
        At most one for each connected part of a contour; none where there is no room.
    """
    axes.autoscale_view()
    to_panel = axes.transData - axes.transAxes
    drawn = [to_panel.transform(line.get_xydata()) for line in axes.lines]
    others = np.concatenate([np.empty((0, 2)), *(_even(each) for each in drawn)])
    placed = np.empty((0, 2))
    wanted = {float(level) for level in shown}
    for level, path in zip(lines.levels, lines.get_paths(), strict=True):
        for part in parts_of(path) if float(level) in wanted else ():
            place = _place(_even(to_panel.transform(part.vertices)), placed, others)
            if place is not None:
                placed = np.vstack([placed, place])
    return [(float(x), float(y)) for x, y in to_panel.inverted().transform(placed)]


def parts_of(path: Path) -> Iterator[Path]:
    """The connected parts of a path."""
    codes = np.array([] if path.codes is None else path.codes, dtype=np.uint8)
    begins = np.flatnonzero(codes == Path.MOVETO).tolist()
    places: Any = path.vertices
    return (Path(places[a:b], codes[a:b]) for a, b in pairwise([*begins, len(codes)]))


def _even(places: FloatArray) -> FloatArray:
    """Points at equal steps along a line of points, shapes (n, 2) and (m, 2); gaps are left out."""
    places = places[np.isfinite(places).all(axis=1)]
    if len(places) < 2:
        return places
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(places, axis=0).T)))
    steps = np.arange(0.0, along[-1], _STEP)
    return np.stack([np.interp(steps, along, each) for each in places.T], axis=1)


def _place(stretch: FloatArray, placed: FloatArray, others: FloatArray) -> FloatArray | None:
    """The point of a contour with most room around it; None if a label has none."""
    half = round(_HALF / _STEP)
    if len(stretch) <= 2 * half:
        return None
    middle = stretch[half:-half]
    chord = np.hypot(*(stretch[2 * half :] - stretch[: -2 * half]).T)
    inside = np.minimum(middle, 1.0 - middle).min(axis=1)
    apart, beside = _distance(middle, placed), _distance(middle, others)
    good = (chord >= _STRAIGHT * 2.0 * _HALF) & (inside >= _INSIDE) & (apart >= _APART) & (beside >= _BESIDE)
    if not good.any():
        return None
    room = np.minimum(np.minimum(apart, 2.0 * beside), 2.0 * inside)
    return np.asarray(middle[np.where(good, room, -np.inf).argmax()])


def _distance(points: FloatArray, others: FloatArray) -> FloatArray:
    """Distance to the nearest of other points, shape (n,); 1 if there are none."""
    if not len(others):
        return np.ones(len(points))
    return np.asarray(np.hypot(*(points[:, None] - others[None]).T).min(axis=0))
