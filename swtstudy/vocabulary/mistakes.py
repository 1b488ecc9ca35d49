"""Mistakes in what a user gave, collected so that all of them are reported at once; the rtol allowed."""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from numbers import Integral, Real
from typing import TypeGuard

from swtstudy.vocabulary.parameters import OTHER_SYMBOLS, PARAMETERS, SYMBOLS, spelled


@dataclass(frozen=True)
class Mistake:
    """One mistake: where it is, what was found and what is allowed.

    Attributes
    ----------
    key
        Dotted path of the offending entry, e.g. ``axes.friction[2]``; empty for the input as a whole.
    found
        The value that was found, in words or as a literal.
    allowed
        The values that are allowed there.
    source
        File that holds the entry; empty for a call from Python.
    shown
        Lines that follow the message: a line of the file, and a mark beneath the place.
    """

    key: str
    found: str
    allowed: str
    source: str = ""
    shown: str = ""

    def __str__(self) -> str:
        place = ": ".join(part for part in (self.source, self.key) if part)
        message = f"found {self.found}; allowed: {self.allowed}"
        line = f"{place}: {message}" if place else message
        # One line, whatever characters a name or a value contains.
        return "\n".join(map(_escaped, (line, *self.shown.splitlines())))


def _escaped(line: str) -> str:
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


def refused(key: str, found: str, allowed: str, source: str = "") -> StudyError:
    """The error of a single mistake."""
    return StudyError([Mistake(key, found, allowed, source)])


class Report(list[Mistake]):
    """Mistakes in their order; called with key, found and allowed of one, it adds that.

    Parameters
    ----------
    source
        Where the input comes from.
    keys
        The key of a parameter, from its name.
    """

    def __init__(self, source: str = "", keys: Callable[[str], str] = str) -> None:
        super().__init__()
        self._source, self._keys = source, keys

    def __call__(self, key: str, found: str, allowed: str) -> None:
        self.append(Mistake(key, found, allowed, self._source))

    def key(self, names: str | Iterable[str]) -> str:
        """The key of one parameter, or of several."""
        return ", ".join(map(self._keys, [names] if isinstance(names, str) else names))

    def of(self, names: str | Iterable[str], found: str, allowed: str) -> None:
        """Add a mistake in one parameter, or in several."""
        self(self.key(names), found, allowed)

    def rtol(self, value: object) -> None:
        """Add a mistake unless a value is allowed as relative accuracy."""
        if not is_rtol(value):
            self("rtol", literal(value), ALLOWED_RTOL)

    def seed(self, value: object) -> None:
        """Add a mistake unless a value is allowed as seed of random numbers."""
        if not is_whole(value, 0, LARGEST_SEED):
            self("seed", literal(value), ALLOWED_SEED)

    def __enter__(self) -> Report:
        """Within a with block, the mistakes of a StudyError are added, and what is left of it is not done.

        Mistakes without a source get the report's.
        """
        return self

    def __exit__(self, kind: object, error: BaseException | None, *_: object) -> bool:
        if isinstance(error, StudyError):
            self += [replace(each, source=each.source or self._source) for each in error.mistakes]
        return isinstance(error, StudyError)

    def refuse(self) -> None:
        """Raise a StudyError with the mistakes, if there are any."""
        if self:
            raise StudyError(self)


def literal(value: object, longest: int = 60) -> str:
    """A value as shown in a message: its Python literal on one line, shortened if long."""
    try:
        text = re.sub(r"\s*\n\s*", " ", repr(plain(value)))
    except ValueError:  # Python refuses to write integers of more than 4,300 digits
        text = f"{type(value).__name__} with too many digits to be shown"
    except Exception:  # a failing repr of foreign code must not hide the mistake
        text = f"{type(value).__name__} that cannot be shown"
    return text if len(text) <= longest else text[: longest - 1] + "…"


#: As many allowed names at most are all said beside the likely ones.
_FEW = 12


def more_like_it(count: int) -> str:
    """Say behind the first of some mistakes how many others there are.

    Examples
    --------
    >>> more_like_it(1), more_like_it(3)
    ('', '; 2 more like it')
    """
    return f"; {count - 1} more like it" if count > 1 else ""


#: Allowed texts, for a text that cannot be stored.
STORABLE = "a text that an archive can hold, without a null character"


def storable(text: str) -> bool:
    """Return whether an archive gives a text back: netCDF ends it at a null character, and holds UTF-8."""
    return "\0" not in text and not any("\ud800" <= c <= "\udfff" for c in text)


def plain(value: object) -> object:
    """The value in a NumPy scalar or zero-dimensional array; anything else, or a masked value, unchanged."""
    array = getattr(value, "ndim", None) == 0 and hasattr(value, "item")
    # The item of a masked value or of a time would be a plain number.
    if not array or getattr(value, "mask", False) or getattr(value, "dtype", None).kind in "mM":  # type: ignore[union-attr]
        return value
    return value.item()  # type: ignore[attr-defined]


def is_number(value: object) -> TypeGuard[Real | Decimal]:
    """Return whether a value is a real number, and not a truth value or a time."""
    # Python's bool and NumPy's timedelta64 are registered as Real; the latter is detected without importing
    # NumPy.
    is_time = getattr(getattr(value, "dtype", None), "kind", "") == "m"
    return isinstance(value, Real | Decimal) and not isinstance(value, bool) and not is_time


def is_whole(value: object, least: int, largest: float = math.inf) -> TypeGuard[int]:
    """Return whether a value is a whole number in a range, and not a truth value."""
    return isinstance(value, Integral) and not isinstance(value, bool) and least <= int(value) <= largest


def plain_number(value: object) -> float:
    """A number as a float; NaN, which is in no range, for anything else."""
    value = plain(value)
    if not is_number(value):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf
    except ValueError:  # a signalling NaN
        return math.nan


def nearest(
    name: str, known: Iterable[str], symbols: Mapping[str, tuple[str, str]] = SYMBOLS, listed_by: str = ""
) -> str:
    """Say which names are allowed instead of an unknown one: those that were probably meant come first.

    Many names are not all said beside likely ones, nor where a command lists them.

    Examples
    --------
    >>> nearest("frictoin", ["friction", "phase"])
    'did you mean friction? known: friction, phase'
    >>> nearest("mu", ["friction", "phase"])
    'did you mean friction (μ)? known: friction, phase'
    >>> nearest("x", ["friction", "phase"])
    'one of friction, phase'
    >>> nearest("figre", [f"figure{n}" for n in range(20)], listed_by="swtstudy list")
    'did you mean figure9, figure8 or figure7? list all: swtstudy list'
    """
    known = list(known)
    close = _alike(name, known, symbols)
    named, letter = symbols.get(spelled(name), ("", ""))
    words = [f"{each} ({letter})" if each == named else each for each in close]
    hint = f"did you mean {_either(words)}?" if close else ""
    if PARAMETERS.keys() & {*known}:
        listed_by = listed_by or "swtstudy list --parameters"
    if len(known) > _FEW and (close or listed_by):
        place = f"list all: {listed_by}" if listed_by else ""
        return " ".join(filter(None, (hint or f"one of {len(known)} names,", place)))
    return f"{hint} known: {', '.join(known)}" if close else f"one of {', '.join(known)}"


def meant(name: str, known: Iterable[str], symbols: Mapping[str, tuple[str, str]] = SYMBOLS) -> str | None:
    """The known name whose symbol or misspelling an unknown name is, if there is one.

    Examples
    --------
    >>> meant("SWTT", ["status", "SWT"]), meant("Start_Up", ["start-up", "running"])
    ('SWT', 'start-up')
    """
    return next(iter(_alike(name, known, symbols)), None)


def _alike(name: str, known: Iterable[str], symbols: Mapping[str, tuple[str, str]]) -> list[str]:
    """The known names that are probably meant, at most three: by symbol, by spelling, or longer by words.

    Examples
    --------
    >>> _alike("P", ["normal_force", "phase"], SYMBOLS), _alike("flat", ["flat_radius", "phase"], {})
    (['normal_force'], ['flat_radius'])
    """
    letters = {_plain_letters(each): each for each in known}
    if symbols is SYMBOLS and (others := [each for each in OTHER_SYMBOLS.get(name, ()) if each in letters]):
        return others
    named, _ = symbols.get(spelled(name), ("", ""))
    if named in letters.values():
        return [named]
    typed = _plain_letters(name)
    close = difflib.get_close_matches(typed, letters, n=1, cutoff=0.6)
    longer = [each for each in letters if len(typed) > 3 and f"_{typed}_" in f"_{each}_"]
    close += [*longer, *difflib.get_close_matches(typed, letters, n=3, cutoff=0.8)]
    return [letters[each] for each in dict.fromkeys(close)][:3]


def _either(words: Sequence[str]) -> str:
    """Words with commas, and "or" before the last."""
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))


def _plain_letters(name: str) -> str:
    return name.lower().replace("-", "_")


DEFAULT_RTOL = 1e-4
#: Closer, rounding would be most of the error.
SMALLEST_RTOL = 1e-7
LARGEST_RTOL = 0.1

#: The allowed range in words, for messages.
ALLOWED_RTOL = f"a number in [{SMALLEST_RTOL:g}, {LARGEST_RTOL:g}]"


#: Largest seed: NumPy's and scipy's generators take it.
LARGEST_SEED = 2**32 - 1
ALLOWED_SEED = f"a whole number from 0 to {LARGEST_SEED}"


def is_rtol(raw: object) -> bool:
    """Return whether a value is allowed as relative accuracy."""
    return SMALLEST_RTOL <= plain_number(raw) <= LARGEST_RTOL
