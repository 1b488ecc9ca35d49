"""A statement of the paper, and what the archives say to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Finding:
    """What was measured.

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
    """One checkable statement.

    Attributes
    ----------
    place
        Where the paper says so.
    sentence
        What it says, in other words.
    criterion
        What counts as holding. The paper gives words where a test needs a bound, so the bounds are ours.
    studies
        Names of the studies whose archives are looked at.
    test
        Takes the archives in the order of `studies`.
    """

    place: str
    sentence: str
    criterion: str
    studies: tuple[str, ...]
    test: Callable[..., Finding]
