"""Mistakes in what a user gave, collected so that all of them are reported at once."""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable
from dataclasses import dataclass
from numbers import Real
from typing import TypeGuard


@dataclass(frozen=True)
class Mistake:
    """One mistake: where it is, what was found and what is allowed.

    Attributes
    ----------
    key
        Dotted path of the offending entry, e.g. ``axes.friction[2]``; empty for the input as a whole.
    found
        What was found, in words or as a literal.
    allowed
        What is allowed there.
    source
        File that holds the entry; empty for a call from Python.
    """

    key: str
    found: str
    allowed: str
    source: str = ""

    def __str__(self) -> str:
        place = ": ".join(part for part in (self.source, self.key) if part)
        message = f"found {self.found}; allowed: {self.allowed}"
        line = f"{place}: {message}" if place else message
        # One line whatever is in a name or a value.
        return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in line)


class StudyError(ValueError):
    """Input that is not a valid study.

    Attributes
    ----------
    mistakes
        Every mistake found, in the order of the input; the message has one line for each.
    """

    def __init__(self, mistakes: Iterable[Mistake]) -> None:
        self.mistakes = tuple(mistakes)
        super().__init__("\n".join(map(str, self.mistakes)))

    def __reduce__(self) -> tuple[type[StudyError], tuple[tuple[Mistake, ...]]]:
        return StudyError, (self.mistakes,)


def literal(value: object, longest: int = 60) -> str:
    """A value as it stands in a message: like Python writes it, shortened if long."""
    text = repr(value)
    return text if len(text) <= longest else text[: longest - 1] + "…"


def is_number(value: object) -> TypeGuard[Real]:
    """Whether a value is a real number, and neither a truth value nor a time."""
    # NumPy's bool is no Real, Python's is; and so is NumPy's timedelta64, told here without its import.
    is_time = getattr(getattr(value, "dtype", None), "kind", "") == "m"
    return isinstance(value, Real) and not isinstance(value, bool) and not is_time


def plain_number(value: object) -> float:
    """A plain number as a float; NaN, which no range holds, for all else."""
    if not is_number(value):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf


def nearest(name: str, known: Iterable[str]) -> str:
    """What is allowed where an unknown name stands: the nearest known one first.

    Examples
    --------
    >>> nearest("frictoin", ["friction", "phase"])
    'did you mean friction? known: friction, phase'
    """
    known = list(known)
    close = meant(name, known)
    hint = f"did you mean {close}? " if close else ""
    return f"{hint}known: {', '.join(known)}"


def meant(name: str, known: Iterable[str]) -> str | None:
    """The known name that an unknown one comes near to, if any."""
    close = difflib.get_close_matches(name.lower().replace("-", "_"), known, n=1, cutoff=0.5)
    return close[0] if close else None
