"""The relative accuracy that may be asked of s."""

from __future__ import annotations

from swtstudy.vocabulary.mistakes import plain_number

DEFAULT_RTOL = 1e-4
#: Closer, rounding would be most of the error.
SMALLEST_RTOL = 1e-7
LARGEST_RTOL = 0.1
#: Archives of earlier versions may have been asked for as much.
SMALLEST_STORED_RTOL = 1e-8

#: The allowed range in words, for messages.
ALLOWED_RTOL = f"a number in [{SMALLEST_RTOL:g}, {LARGEST_RTOL:g}]"


def is_rtol(raw: object, smallest: float = SMALLEST_RTOL) -> bool:
    """Return whether a value is allowed as relative accuracy."""
    return smallest <= plain_number(raw) <= LARGEST_RTOL
