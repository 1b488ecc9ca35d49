"""Names, and what is prescribed, as numbers in canonical rows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.prescribed import Control

if TYPE_CHECKING:
    from swtstudy.mechanics.points import FloatArray

#: The built-in profiles by their code; archives' parts say which ones they count on.
NAMES = PARAMETERS["profile"].names

#: What a user has defined, by its code.
Definitions = Mapping[float, Definition]


def code_of(value: str | Definition, parameter: str = "profile") -> float:
    """The number that stands for a value of a parameter that has names."""
    return value.code if isinstance(value, Definition) else float(PARAMETERS[parameter].names.index(value))


def value_of(code: float, definitions: Definitions, parameter: str = "profile") -> str | Definition:
    """The value that a number stands for."""
    names = PARAMETERS[parameter].names
    return names[int(code)] if code < len(names) else definitions[code]


def control_code(normal_force: NDArray[np.bool_], tangential_force: NDArray[np.bool_]) -> FloatArray:
    """The numbers that stand for what is prescribed, from whether each component is a force."""
    return normal_force + 2.0 * tangential_force


def control_of(code: float) -> Control:
    """Control of a number; see `code_of_control`."""
    return Control(bool(int(code) & 1), bool(int(code) & 2))
