"""Base of the definitions with names that users give, such as a loop of loads; reading numbers in them.

The content of a definition counts, not its name. Masked numbers become NaN, and anything that is
no number is a mistake.
"""

from __future__ import annotations

import hashlib
import json
from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.mistakes import (
    STORABLE,
    Mistake,
    is_number,
    literal,
    plain_number,
    refused,
    storable,
)
from swtstudy.vocabulary.parameters import PARAMETERS


def read_numbers(key: str, values: object, allowed: str) -> NDArray[np.float64]:
    """Numbers of any shape as floats.

    Parameters
    ----------
    key, allowed
        Name of the values, and what is allowed for them, for messages.
    values
        A number, also a Fraction, or nested sequences or an array of them.

    Returns
    -------
    array
        NaN where a value is masked.

    Raises
    ------
    StudyError
        If there is anything but real numbers, such as text, truth values, complex numbers, times or ragged
        sequences.
    """
    try:
        array: np.ma.MaskedArray = np.ma.asarray(values)
    except (TypeError, ValueError):
        raise refused(key, literal(values), allowed) from None
    if array.dtype.kind in "iuf":
        return np.asarray(np.ma.filled(array.astype(float), np.nan))
    if array.dtype.kind != "O" or not all(map(is_number, np.ma.filled(array, np.nan).flat)):
        raise refused(key, literal(values), allowed)
    known = np.ma.filled(array, np.nan)
    return np.array([plain_number(value) for value in known.flat]).reshape(known.shape)


#: Bytes of the check sum of a content that are its code, behind a 1 that makes it larger than built-in ones.
CODE_BYTES = 7


def wrong_name(name: object, parameter: str) -> Mistake | None:
    """Return the mistake in the name of a definition, as a value of a parameter."""
    if not isinstance(name, str) or not name.strip():
        return Mistake("name", literal(name), "a text that is not empty")
    if not storable(name):
        return Mistake("name", literal(name), STORABLE)
    if name in PARAMETERS[parameter].names:
        return Mistake("name", literal(name), f"another one: this is a built-in {parameter}")
    return None


class Definition(ABC):
    """Something with a name and a content that can be written as JSON.

    Attributes
    ----------
    name
        For people, files and figures. Two with the same content are the same whatever their names.
    """

    #: The parameter of which it is a value.
    parameter: ClassVar[str]

    name: str

    @abstractmethod
    def content(self) -> dict[str, Any]:
        """The content, as JSON can hold it to the last digit."""

    @classmethod
    @abstractmethod
    def of_content(cls, name: str, content: Mapping[str, Any]) -> Definition:
        """The inverse of `content`.

        Raises
        ------
        StudyError
            A ValueError with everything that is wrong in it.
        """

    @property
    def cost(self) -> int:
        """About how many times as long as the simplest one it takes."""
        return 1

    @property
    def scaled_by(self) -> tuple[str, ...]:
        """The parameters that scale it, which are 1 unless given."""
        return ()

    @cached_property
    def code(self) -> int:
        """The number that stands for its content in canonical rows; built-in values have smaller ones."""
        text = json.dumps(self.content(), sort_keys=True)
        return int.from_bytes(b"\1" + hashlib.sha256(text.encode()).digest()[:CODE_BYTES], "big")

    def notes(self) -> dict[str, Any]:
        """Facts that archives keep beside the content, as JSON can hold them."""
        return {}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Definition) and (self.name, self.code) == (other.name, other.code)

    def __hash__(self) -> int:
        return hash((self.name, self.code))

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name}>"
