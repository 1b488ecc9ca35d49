"""Base of what consists of rows: n points, loads, profiles or pieces, each an entry of every array."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, Self

import numpy as np


class Rows:
    """Arrays, other rows, and both by name, with common leading axes; all else the rows have in common.

    The arguments of the constructor are attributes: the fields of a dataclass; other classes name them in
    ``__match_args__``.
    """

    __match_args__: ClassVar[tuple[str, ...]]

    def take(self, index: Any, /) -> Self:
        """The rows at an index of NumPy's of the leading axes, repetitions allowed."""
        return self._made(_taken(getattr(self, name), index) for name in self.__match_args__)

    @classmethod
    def joined(cls, several: Sequence[Self]) -> Self:
        """The rows of several, one after another; what is no rows is that of the first."""
        return cls._made(_joined([getattr(one, name) for one in several]) for name in cls.__match_args__)

    @classmethod
    def _made(cls, values: Any) -> Self:
        make: Any = cls
        return make(*values)


def _taken(value: Any, index: Any) -> Any:
    if isinstance(value, np.ndarray):
        return value[index]
    if isinstance(value, dict):
        return {name: _taken(each, index) for name, each in value.items()}
    return value.take(index) if isinstance(value, Rows) else value


def _joined(several: list[Any]) -> Any:
    first = several[0]
    if isinstance(first, dict):
        return {name: _joined([each[name] for each in several]) for name in first}
    if isinstance(first, Rows):
        return first.joined(several)
    return np.concatenate(several) if isinstance(first, np.ndarray) else first
