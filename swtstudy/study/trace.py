"""A profilometer's trace across a body: two sides, with a tilt, an offset and noise."""

from __future__ import annotations

from collections.abc import Mapping
from os import PathLike
from pathlib import Path

import numpy as np

from swtstudy.mechanics.indenter.profile_table import FEWEST, TabulatedProfile
from swtstudy.mechanics.points import FloatArray
from swtstudy.study.columns import read_as_given
from swtstudy.vocabulary.choices import AXISYMMETRIC
from swtstudy.vocabulary.mistakes import Mistake, StudyError

#: The columns of a trace.
COLUMNS = ("position", "height")
#: Middles that are tried at a time, and how often closer ones are.
MIDDLES, ROUNDS = 101, 4
#: Middles whose sides are unlike by so much more than those of the best one are as good: the tilt decides.
AS_GOOD = 1.05
#: Share of the points, at least so many, of whose parabola the lowest point is the zero of heights.
INNERMOST, LEAST = 0.1, 5
#: Share of its largest rise that a trace has at both of its ends.
LEAST_RISE = 0.02


def read_trace(
    path: str | PathLike[str],
    *,
    name: str | None = None,
    columns: Mapping[str, str] | None = None,
    separator: str = ",",
    decimal: str = ".",
    level: bool = True,
    smoothing: float | None = None,
    geometry: str = AXISYMMETRIC,
) -> TabulatedProfile:
    """A profile from a trace across it: the mean of both sides, smoothed by what they are unlike.

    Parameters
    ----------
    path
        The file, a table with a header, in UTF-8.
    name
        Name of the profile; that of the file unless given.
    columns
        Headers of the columns ``position`` and ``height``, where they are not these words; both in lengths
        of one unit, heights growing away from the other body.
    separator, decimal
        As of `swtstudy.read_signal`.
    level
        Whether to take off the tilt that makes both sides most alike. An offset is always taken off.
    smoothing
        As of a `TabulatedProfile`, in the place of what the sides are unlike.
    geometry
        As of a `TabulatedProfile`.

    Raises
    ------
    StudyError
        A ValueError with what is wrong.
    """
    own, given = Path(path), {"columns": columns, "separator": separator, "decimal": decimal}
    position, height = read_as_given(own, COLUMNS, given).T
    if len(position) < 4 * FEWEST:
        raise StudyError([Mistake("", f"{len(position)} points", f"{4 * FEWEST} at least", str(own))])
    if not np.ptp(position) > 0.0:
        raise StudyError([Mistake("", f"{len(position)} points at one position", "a trace across", str(own))])
    radius, mean, noise = folded(position, height, level)
    if -mean.min() > mean.max():
        found = f"heights that fall by {-mean.min():.3g} from the middle to the sides"
        allowed = "heights that grow away from the other body: with the other sign"
        raise StudyError([Mistake("", found, allowed, str(own))])
    if _one_sided(position, height):
        found = "one side only: heights are lowest at an end of the trace"
        allowed = "both sides, with the lowest point between them; of one side a table of radius and height"
        raise StudyError([Mistake("", found, allowed, str(own))])
    smoothing = noise if smoothing is None else smoothing
    return TabulatedProfile(own.stem if name is None else name, radius, mean, smoothing, geometry)


def _one_sided(position: FloatArray, height: FloatArray) -> bool:
    """Return whether a trace hardly rises towards one of its ends: nothing there is to be folded."""
    order = np.argsort(position)
    outer = max(1, len(order) // 100)
    ends = [height[order[:outer]].mean(), height[order[-outer:]].mean()]
    return bool(min(ends) - height.min() < LEAST_RISE * np.ptp(height))


def folded(position: FloatArray, height: FloatArray, level: bool) -> tuple[FloatArray, FloatArray, float]:
    """Radii and heights of both sides of a trace together, and how unlike these are.

    Parameters
    ----------
    position, height
        Shape (k,), in any order.
    level
        Whether a tilt is taken off.

    Returns
    -------
    radius, height
        Shape (m,): even radii from 0 on, and the mean of both sides above the lowest point.
    noise
        Root mean square of half of the difference of both sides, which that mean has, too.
    """
    order = np.argsort(position)
    position, height = position[order], height[order]
    count = len(position) // 2
    ends = position[0] + np.array([0.25, 0.75]) * np.ptp(position)
    for _ in range(ROUNDS):
        middles = np.linspace(ends[0], ends[1], MIDDLES)
        found = [_sides(position, height, middle, count, level) for middle in middles]
        unlike = np.array([each[2] for each in found])
        tilt = np.where(unlike <= AS_GOOD * unlike.min(), [abs(each[3]) for each in found], np.inf)
        best = int(tilt.argmin()) if level else int(unlike.argmin())
        ends = middles[best] + np.array([-2.0, 2.0]) * (middles[1] - middles[0])
    radius, mean, noise, _ = found[best]
    inner = slice(max(LEAST, int(INNERMOST * count)))
    mean = mean - np.polynomial.Polynomial.fit(radius[inner] ** 2, mean[inner], 1)(0.0)
    mean[0] = 0.0
    return radius, mean, noise


def _sides(
    position: FloatArray, height: FloatArray, middle: float, count: int, level: bool
) -> tuple[FloatArray, FloatArray, float, float]:
    """Radii, the mean of both sides, by how much they are unlike, and the tilt, about a middle."""
    radius = np.linspace(0.0, min(middle - position[0], position[-1] - middle), count)
    right, left = (np.interp(middle + side * radius, position, height) for side in (1.0, -1.0))
    odd = 0.5 * (right - left)
    tilt = float((odd * radius).sum() / (radius * radius).sum()) if level else 0.0
    return radius, 0.5 * (right + left), float(np.sqrt(np.mean((odd - tilt * radius) ** 2))), tilt
