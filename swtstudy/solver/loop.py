"""Base of the closed loops of loads that users name."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from swtstudy.vocabulary.definition import Definition, wrong_name
from swtstudy.vocabulary.mistakes import StudyError, literal, plain_number, refused
from swtstudy.vocabulary.parameters import PAIRS

FloatArray = NDArray[np.float64]
#: Length of the common period in φ, rad.
PERIOD = 2.0 * np.pi


#: Largest number of a loop: squares of it are numbers still, whatever its unit.
LARGEST = 1e100
FINITE = f"finite numbers, in magnitude up to {LARGEST:g}"
#: How many times as far from 0 as half of its range the middle of a column of deviations may be.
FAR = 2.0


class Loop(Definition):
    """A closed loop of the normal and the tangential load, run through again and again.

    The normal load is 1 + its amplitude times c_n, the tangential one its amplitude times c_t, of whatever is
    prescribed. A bulk stress may go with it: its mean plus its amplitude times c_b.
    """

    parameter: ClassVar[str] = "load"

    #: The mean normal load, in the unit of its column, from which c_n deviates; None if it is unknown.
    mean_normal: float | None = None

    @property
    @abstractmethod
    def normal_ends(self) -> tuple[float, float]:
        """Least and largest c_n."""

    @property
    @abstractmethod
    def tangential_ends(self) -> tuple[float, float]:
        """Least and largest c_t."""

    @property
    def reach(self) -> float:
        """Largest c_n."""
        return self.normal_ends[1]

    @property
    def is_steady(self) -> bool:
        """True if the normal load is constant."""
        low, high = self.normal_ends
        return low == high

    @property
    def is_absolute(self) -> bool:
        """True if c_n looks like a load itself, not like its deviation from the mean."""
        low, high = self.normal_ends
        return abs(low + high) > FAR * (high - low)

    @property
    @abstractmethod
    def bulk_ends(self) -> tuple[float, float] | None:
        """Least and largest c_b; None where there is no bulk stress."""

    @property
    def scaled_by(self) -> tuple[str, ...]:
        return (*PAIRS.values(), *(("bulk_stress_amplitude",) if self.bulk_ends else ()))

    @abstractmethod
    def course(self) -> FloatArray:
        """c_n, c_t and, with a bulk stress, c_b over a round, its begin once more at the end: (T, 2 or 3)."""


def checked_mean(mean: object, name: str) -> float | None:
    """The mean normal load of a loop.

    Raises
    ------
    StudyError
        A ValueError, if it is no positive number.
    """
    if mean is None:
        return None
    number = plain_number(mean)
    if not 0.0 < number <= LARGEST:
        found = literal(mean) if isinstance(mean, str) else f"{number:g}"
        raise refused(f"mean_normal of {name}", found, "a positive number: bodies are pressed")
    return number


def mean_of(loop: Loop) -> dict[str, float]:
    """The mean normal load as a part of the content of a loop."""
    return {} if loop.mean_normal is None else {"mean_normal": loop.mean_normal}


def checked_name(name: object) -> str:
    """The name of a loop.

    Raises
    ------
    StudyError
        A ValueError if it is not a name, or the name of a built-in load.
    """
    if mistake := wrong_name(name, "load"):
        raise StudyError([mistake])
    return str(name)
