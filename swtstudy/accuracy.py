"""The relative accuracy that may be asked of s."""

from __future__ import annotations

from swtstudy.mistakes import plain_number

DEFAULT_RTOL = 1e-4
SMALLEST_RTOL = 1e-8
LARGEST_RTOL = 0.1

#: The allowed range in words, for messages.
ALLOWED_RTOL = f"a number in [{SMALLEST_RTOL:g}, {LARGEST_RTOL:g}]"


def is_rtol(raw: object) -> bool:
    """Whether a value is allowed as relative accuracy."""
    return SMALLEST_RTOL <= plain_number(raw) <= LARGEST_RTOL
