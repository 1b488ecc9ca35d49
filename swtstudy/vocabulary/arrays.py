"""Types of arrays, and named arrays with one common leading axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]
#: Numbers of points, columns and the like.
IndexArray = NDArray[np.intp]
#: Shape parameters of n profiles of a family, by name.
Shape = dict[str, FloatArray]


class Columns:
    """A dataclass of arrays, dictionaries of arrays, and other such, of one length; all else is in common."""

    __match_args__: ClassVar[tuple[str, ...]]

    def __getitem__(self, index: Any) -> Self:
        """The values at an index of NumPy's, repetitions allowed."""
        return type(self)(*(_at(getattr(self, name), index) for name in self.__match_args__))

    def __setitem__(self, index: Any, other: Self) -> None:
        """Write others at an index of NumPy's; they consist of arrays alone."""
        for name in self.__match_args__:
            getattr(self, name)[index] = getattr(other, name)

    @classmethod
    def joined(cls, several: Sequence[Self]) -> Self:
        """Several, one after another; common values are taken from the first."""
        return cls(*(_joined([getattr(one, name) for one in several]) for name in cls.__match_args__))


def _at(value: Any, index: Any) -> Any:
    if isinstance(value, dict):
        return {name: _at(each, index) for name, each in value.items()}
    return value[index] if isinstance(value, np.ndarray | Columns) else value


def _joined(several: list[Any]) -> Any:
    first = several[0]
    if isinstance(first, dict):
        return {name: _joined([each[name] for each in several]) for name in first}
    if isinstance(first, Columns):
        return first.joined(several)
    return np.concatenate(several) if isinstance(first, np.ndarray) else first
