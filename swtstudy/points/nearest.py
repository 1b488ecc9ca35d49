"""Which value of an axis a value means that a user typed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swtstudy.points.values import Value
from swtstudy.vocabulary.definition import Definition

#: Largest relative distance of a typed value from the value of an axis that it means: "3.141593" is π.
TOLERANCE = 1e-6
#: Largest distance where one of the two is 0, which nothing is relatively close to: rounding of a phase.
_ROUNDING = 1e-14


def index_of(value: Value, axis: Sequence[Value], tolerance: float = TOLERANCE) -> int | None:
    """Index of the value of an axis that a value means; None if there is none.

    Parameters
    ----------
    value
        A checked value.
    axis
        The values of the axis.
    tolerance
        Largest distance of numbers, relative to the larger of the two.

    Examples
    --------
    >>> index_of(3.141593, (0.0, 3.141592653589793)), index_of(3.1416, (0.0, 3.141592653589793))
    (1, None)
    """
    if isinstance(value, str | Definition):
        names = [str(each) for each in axis]
        return names.index(str(value)) if str(value) in names else None
    if not len(axis):
        return None  # its values are wrong, which is reported
    known, asked = np.array(axis, float), float(value)
    distance, scale = np.abs(known - asked), np.maximum(np.abs(known), abs(asked))
    allowed = np.where((known == 0.0) | (asked == 0.0), _ROUNDING, tolerance * scale)
    nearest = int(distance.argmin())
    return nearest if distance[nearest] <= allowed[nearest] else None
