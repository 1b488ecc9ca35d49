"""Progress of a run: a bar on a terminal, nothing elsewhere."""

from __future__ import annotations

import sys
import time
from typing import TextIO

_WIDTH = 30


class Progress:
    """Counts points, and draws a bar with their rate and the time left.

    Parameters
    ----------
    total
        Points to be computed.
    stream
        Where the bar goes; nothing is written unless it is a terminal.
    """

    def __init__(self, total: int, stream: TextIO | None = None) -> None:
        self.total = total
        self.done = 0
        self._stream = sys.stderr if stream is None else stream
        self._visible = self._stream.isatty()
        self._begin = time.monotonic()

    def add(self, points: int) -> None:
        """Count more points as done."""
        self.done += points
        if self._visible:
            line = bar(self.done, self.total, time.monotonic() - self._begin)
            self._stream.write(f"\r{line}\x1b[K")
            self._stream.flush()

    def close(self) -> None:
        """End the line of the bar."""
        if self._visible and self.done:
            self._stream.write("\n")
            self._stream.flush()


def bar(done: int, total: int, seconds: float) -> str:
    """One line that says how far a run is.

    Examples
    --------
    >>> bar(50, 200, 10.0)
    '███████▌                         25 %  50/200 points  5.0/s  30 s left'
    """
    eighths = round(8 * _WIDTH * done / total)
    full = "█" * (eighths // 8) + " ▏▎▍▌▋▊▉"[eighths % 8].strip()
    rate = done / seconds if seconds > 0 else 0.0
    left = duration((total - done) / rate) + " left" if rate and done < total else duration(seconds)
    return f"{full:<{_WIDTH}} {100 * done / total:4.0f} %  {done}/{total} points  {rate:.3g}/s  {left}"


def duration(seconds: float) -> str:
    """Seconds as people say them.

    Examples
    --------
    >>> duration(0.5), duration(75), duration(7500)
    ('0.5 s', '1 min 15 s', '2 h 5 min')
    """
    if seconds < 10:
        return f"{seconds:.1f} s"
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"
