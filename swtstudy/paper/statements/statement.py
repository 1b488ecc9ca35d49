"""A statement of the paper, and the finding from the archives."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """A measurement, and whether the statement holds by it.

    Attributes
    ----------
    measured
        The numbers, in words.
    holds
        Whether they meet the criterion of the statement.
    """

    measured: str
    holds: bool


@dataclass(frozen=True)
class Statement:
    """A statement that can be tested.

    Attributes
    ----------
    place
        Where it is in the paper.
    sentence
        What the paper says, in other words.
    criterion
        When it counts as holding. The paper uses words where a test needs a bound, so the bounds are ours.
    studies
        Names of the studies whose archives it is tested on.
    test
        Called with these archives, in this order.
    """

    place: str
    sentence: str
    criterion: str
    studies: tuple[str, ...]
    test: Callable[..., Finding]
