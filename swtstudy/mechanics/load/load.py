"""Bases of all loads, closed loops in the plane of normal and tangential load, and of those that users name.

Both components are measured in the coordinate of the memory diagram: the normal one is 1 at the reference
depth δ0, the tangential one is scaled so that friction reads |tangential| ≤ normal for each spring. Time is
an angle φ that runs over one common period; nothing depends on its speed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar, Protocol

import numpy as np

from swtstudy.mechanics.numerics.roots import Brackets
from swtstudy.mechanics.points import BoolArray, FloatArray, IntArray, Rows
from swtstudy.vocabulary.definition import Definition, wrong_name
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, plain_number
from swtstudy.vocabulary.parameters import PAIRS

#: Length of the common period in φ, rad.
PERIOD = 2.0 * np.pi


class Load(Rows, ABC):
    """n loads of one kind.

    Notes
    -----
    The methods take instants φ or values of the normal load of shape (n, …) and return arrays of the same
    shape. A *branch* is a stretch of time in which the normal load rises; branches are numbered.
    """

    @abstractmethod
    def __len__(self) -> int:
        """Number n of loads."""

    @abstractmethod
    def normal(self, instant: FloatArray) -> FloatArray:
        """Normal load; the bodies are apart where it is negative."""

    @abstractmethod
    def tangential(self, instant: FloatArray) -> FloatArray:
        """Tangential load."""

    @abstractmethod
    def normal_rate(self, instant: FloatArray) -> FloatArray:
        """Derivative of `normal` with respect to φ."""

    @abstractmethod
    def tangential_rate(self, instant: FloatArray) -> FloatArray:
        """Derivative of `tangential` with respect to φ."""

    @property
    @abstractmethod
    def least_normal(self) -> FloatArray:
        """Shape (n,): least normal load of the cycle."""

    @property
    @abstractmethod
    def largest_normal(self) -> FloatArray:
        """Shape (n,): largest normal load of the cycle."""

    @property
    @abstractmethod
    def motion(self) -> FloatArray:
        """Shape (n,): amplitude of normal and tangential load together, 0 for a load at rest."""

    @property
    def normal_motion(self) -> FloatArray:
        """Shape (n,): amplitude of the normal load alone."""
        return 0.5 * (self.largest_normal - self.least_normal)

    @property
    @abstractmethod
    def has_tangential(self) -> BoolArray:
        """Shape (n,): whether there is a tangential load at all, be it a constant one."""

    @property
    @abstractmethod
    def moves_tangentially(self) -> BoolArray:
        """Shape (n,): whether the tangential load changes at all."""

    @property
    @abstractmethod
    def oscillations(self) -> tuple[int, int]:
        """Numbers of oscillations of the normal and the tangential load in a period."""

    @property
    @abstractmethod
    def mirrored_half(self) -> bool:
        """True if half a period later the normal load is the same and the tangential one has changed sign."""

    @property
    def grows_in_lines(self) -> bool:
        """True if the ratio of both rates is constant between turning instants."""
        return False

    @abstractmethod
    def turning_instants(self) -> FloatArray:
        """All instants at which a component or a slip line turns, or contact is made or lost.

        Returns
        -------
        Shape (n, k), within [0, `PERIOD`], ascending; rows with fewer instants are filled up with `PERIOD`.
        """

    @abstractmethod
    def branch(self, instant: FloatArray) -> IntArray:
        """Number of the branch of each instant at which the normal load rises."""

    @abstractmethod
    def touch_down(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        """Instant at which the normal load reaches a value on a branch; its nearer end where it does not."""

    @abstractmethod
    def growth_slope(self, normal: FloatArray, branch: IntArray) -> FloatArray:
        """dτ/dG = −dT/dN that growth in stick leaves where the normal load reaches a value on a branch."""

    @abstractmethod
    def passage(self, normal: FloatArray, begin: FloatArray, end: FloatArray) -> FloatArray:
        """Instant at which the normal load has a value, in stretches of time in which it is monotone.

        Parameters
        ----------
        normal
            Shape (n, X).
        begin, end
            Shape (n, i): ends of the stretches.

        Returns
        -------
        Shape (n, X, i): within the stretch; its nearer end, or the end where the load never has the value.
        """

    @abstractmethod
    def slip_line_brackets(self, sense: float, low: FloatArray, high: FloatArray) -> Brackets:
        """Stretches of time, ends of shape (n,), in which the slip line sense·T − N is monotone."""

    @abstractmethod
    def slip_line_instant(self, sense: float, goal: FloatArray, brackets: Brackets) -> FloatArray:
        """Instant at which the slip line has the value ``goal``, shape (n,), in each of n brackets.

        Where the goal is not reached, the nearer end.
        """


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
    """The mean normal load as a part of the content of a loop."""
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
