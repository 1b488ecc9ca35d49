"""Progress of a run: a bar on a terminal, otherwise a line in the log now and then."""

from __future__ import annotations

import logging
import sys
import time
from collections.abc import Callable
from typing import TextIO

from swtstudy.grid.cost import duration

_log = logging.getLogger(__name__)

#: Width of the bar in characters: with the words it fits into a line of 80.
_WIDTH = 30

#: Seconds between two lines in a log, and between two updates of the bar.
_LINE_SECONDS, _BAR_SECONDS = 30.0, 0.1


class ProgressBar:
    """Counts finished points, and shows their rate and the time left.

    Parameters
    ----------
    total
        Number of points to be computed.
    stream
        Where the bar goes if this is a terminal; otherwise a line goes to the log every half minute. By
        default `sys.stderr`, which is None in a process without one.
    clock
        Returns increasing seconds.
    """

    def __init__(
        self, total: int, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.total = total
        self.done = 0
        self._terminal = _terminal(sys.stderr if stream is None else stream)
        self._clock = clock
        self._begin = self._shown = clock()

    def add(self, points: int) -> None:
        """Count more points as done."""
        self.done += points
        now = self._clock()
        every = _LINE_SECONDS if self._terminal is None else _BAR_SECONDS
        if now - self._shown < every and self.done < self.total:
            return
        if self._terminal is not None:
            self._write(f"\r{bar(self.done, self.total)}  {self._words(now)}\x1b[K")
        elif now - self._begin >= _LINE_SECONDS:
            _log.info(self._words(now))
        self._shown = now

    def close(self) -> None:
        """End the line of the bar."""
        if self.done:
            self._write("\n")

    def _write(self, text: str) -> None:
        if self._terminal is None:
            return
        try:
            self._terminal.write(text)
            self._terminal.flush()
        except (OSError, ValueError):
            self._terminal = None  # closed in the meantime: no reason to stop computing

    def _words(self, now: float) -> str:
        return words(self.done, self.total, now - self._begin)


def _terminal(stream: TextIO | None) -> TextIO | None:
    """The stream if it is a terminal; None if not, or if it is missing or closed."""
    try:
        return stream if stream is not None and stream.isatty() else None
    except ValueError:
        return None


def bar(done: int, total: int) -> str:
    """A bar whose length shows how much is done.

    Examples
    --------
    >>> bar(50, 200)
    '███████▌                      '
    """
    eighths = round(8 * _WIDTH * done / total)
    full = "█" * (eighths // 8) + " ▏▎▍▌▋▊▉"[eighths % 8].strip()
    return f"{full:<{_WIDTH}}"


def words(done: int, total: int, seconds: float) -> str:
    """How far a run has got, in words.

    Examples
    --------
    >>> words(50, 200, 10.0)
    '50 of 200 points (25 %), 5/s, 30 s left'
    """
    rate = done / seconds if seconds > 0 else 0.0
    left = duration((total - done) / rate) + " left" if rate and done < total else duration(seconds)
    return f"{done} of {total} points ({100 * done / total:.0f} %), {rate:.3g}/s, {left}"
