"""Examples at the end of a command's help."""

from __future__ import annotations


def examples(*lines: str) -> str:
    """The epilog of a command: a line each, as typed."""
    return "\n".join(["\b", "Examples:", *(f"  {line}" for line in lines)])
