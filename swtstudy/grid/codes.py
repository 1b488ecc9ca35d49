"""Names, and what is prescribed, as numbers in canonical rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.parameters import FAMILIES, Control

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray

#: The names by their code; archives' parts say which ones they count on.
NAMES = tuple(FAMILIES)


def code_of(profile: str) -> float:
    """The number that stands for a profile."""
    return float(NAMES.index(profile))


def name_of(code: float) -> str:
    """The profile that a number stands for."""
    return NAMES[int(code)]


def control_code(normal_force: NDArray[np.bool_], tangential_force: NDArray[np.bool_]) -> FloatArray:
    """The numbers that stand for what is prescribed, from whether each component is a force."""
    return normal_force + 2.0 * tangential_force


def control_of(code: float) -> Control:
    """What is prescribed, from its number."""
    return Control(bool(int(code) & 1), bool(int(code) & 2))
