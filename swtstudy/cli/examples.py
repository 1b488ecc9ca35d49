"""Examples at the end of a command's help."""

from __future__ import annotations


def examples(*lines: str) -> str:
    """The epilog of a command: one line per example, as typed."""
    return "\n".join(["\b", "Examples:", *(f"  {line}" for line in lines)])
