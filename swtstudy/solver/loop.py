"""Base of the closed loops of loads that users name."""

from __future__ import annotations

from abc import abstractmethod
from typing import Any, ClassVar

from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.definition import Definition, wrong_name
from swtstudy.vocabulary.mistakes import StudyError, literal, plain_number, refused
from swtstudy.vocabulary.parameters import PAIRS

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

    def __init__(self, name: object, mean_normal: object) -> None:
        self.name = checked_name(name)
        #: The mean normal load, in the unit of its column, from which c_n deviates; None if it is unknown.
        self.mean_normal = None if mean_normal is None else plain_number(mean_normal)
        if self.mean_normal is not None and not 0.0 < self.mean_normal <= LARGEST:
            found = literal(mean_normal) if isinstance(mean_normal, str) else f"{self.mean_normal:g}"
            raise refused(f"mean_normal of {name}", found, "a positive number: bodies are pressed")

    @property
    @abstractmethod
    def ends(self) -> list[tuple[float, float]]:
        """Least and largest c_n, c_t and, with a bulk stress, c_b."""

    @property
    def normal_ends(self) -> tuple[float, float]:
        """Least and largest c_n."""
        return self.ends[0]

    @property
    def bulk_ends(self) -> tuple[float, float] | None:
        """Least and largest c_b; None where there is no bulk stress."""
        return self.ends[2] if len(self.ends) > 2 else None

    @property
    def is_absolute(self) -> bool:
        """True if c_n looks like a load itself, not like its deviation from the mean."""
        low, high = self.normal_ends
        return abs(low + high) > FAR * (high - low)

    @property
    def scaled_by(self) -> tuple[str, ...]:
        return (*PAIRS.values(), *(("bulk_stress_amplitude",) if self.bulk_ends else ()))

    def content(self) -> dict[str, Any]:
        """The mean normal load, where it is known; the kinds of loops add what they are made of."""
        return {} if self.mean_normal is None else {"mean_normal": self.mean_normal}

    @abstractmethod
    def course(self) -> FloatArray:
        """c_n, c_t and, with a bulk stress, c_b over a round, its begin once more at the end: (T, 2 or 3)."""


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
