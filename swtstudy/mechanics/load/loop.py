"""Base of the loops of load that a user defines and names."""

from __future__ import annotations

from abc import abstractmethod
from typing import ClassVar, Protocol

from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.points import FloatArray
from swtstudy.vocabulary.definition import Definition, wrong_name
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.vocabulary.prescribed import PAIRS

#: Largest number of a loop: squares of it are numbers still, whatever its unit.
LARGEST = 1e100
FINITE = f"finite numbers, in magnitude up to {LARGEST:g}"
#: How many times as far from 0 as half of its range the middle of a column of deviations may be.
FAR = 2.0


class BulkCourse(Protocol):
    """Course of a bulk stress over the angle φ of a loop."""

    def value(self, instant: FloatArray) -> FloatArray:
        """c_b at instants of any shape."""

    @property
    def turns(self) -> FloatArray:
        """Instants at which it turns while the load may not, shape (k,)."""

    @property
    def ends(self) -> tuple[float, float]:
        """Least and largest value."""


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
    def bulk(self) -> BulkCourse | None:
        """c_b; None where it is 0."""

    @property
    def scaled_by(self) -> tuple[str, ...]:
        return (*PAIRS.values(), *(("bulk_stress_amplitude",) if self.bulk else ()))

    @property
    @abstractmethod
    def turn_count(self) -> int:
        """Number of turning instants of its loads, about."""

    @abstractmethod
    def loads(self, normal_amplitude: FloatArray, tangential_amplitude: FloatArray) -> Load:
        """The n loads with these amplitudes, each of shape (n,)."""


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
        raise StudyError([Mistake(f"mean_normal of {name}", found, "a positive number: bodies are pressed")])
    return number


def mean_of(loop: Loop) -> dict[str, float]:
    """Read the mean normal load from the content of a loop."""
    return {} if loop.mean_normal is None else {"mean_normal": loop.mean_normal}


def checked_name(name: object) -> str:
    """The name of a loop.

    Raises
    ------
    StudyError
        A ValueError, if it is none, or that of a built-in load.
    """
    if mistake := wrong_name(name, "load"):
        raise StudyError([mistake])
    return str(name)
