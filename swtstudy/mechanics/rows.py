"""Base of what consists of rows: n points, loads, profiles or pieces, each an entry of every array."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, Self

import numpy as np


class Rows:
    """Arrays, and other rows, with common leading axes; what is neither all rows have in common.

    The arguments of the constructor are attributes: the fields of a dataclass; other classes name them in
    ``__match_args__``.
    """

    __match_args__: ClassVar[tuple[str, ...]]

    def take(self, index: Any, /) -> Self:
        """The rows at an index of NumPy's of the leading axes, repetitions allowed."""
        return self._made(_taken(getattr(self, name), index) for name in self.__match_args__)

    @classmethod
    def joined(cls, several: Sequence[Self]) -> Self:
        """The rows of several, one after another; they consist of arrays, or of None in all."""
        columns = ([getattr(one, name) for one in several] for name in cls.__match_args__)
        return cls._made(None if column[0] is None else np.concatenate(column) for column in columns)

    @classmethod
    def _made(cls, values: Any) -> Self:
        make: Any = cls
        return make(*values)


def _taken(value: Any, index: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value[index]
    return value.take(index) if isinstance(value, Rows) else value
