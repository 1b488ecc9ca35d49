"""Collecting results: each is saved in a part of the archive before it counts, and tells pace and progress.

The pace, seconds per point, makes the size of later chunks. Progress is a bar on a terminal, otherwise a line
in the log now and then.
"""

from __future__ import annotations

import logging
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from shutil import get_terminal_size
from typing import TYPE_CHECKING, TextIO

from swtstudy.mechanics.points import IntArray
from swtstudy.points.records import MISSING, Records, Run
from swtstudy.points.unique import SECONDS_PER_WEIGHT, duration, weights
from swtstudy.runner.engine import WorkerError
from swtstudy.vocabulary.version import SOLVER_VERSION

if TYPE_CHECKING:
    from swtstudy.archive.parts import PartsWriter

#: Seconds of work in a chunk: long compared with the cost of sending one, short enough to lose.
CHUNK_SECONDS = 0.7

#: Largest weight of a chunk: the part of the archive that it becomes is written quickly.
_LARGEST_WEIGHT = 10_000

#: Size of the first chunks, as a fraction of later ones: they are timed, and soon saved.
_FIRST_FRACTION = 0.2

#: Shortest time that counts, in seconds, so that none is 0: a coarse clock.
_CLOCK_TICK = 1e-9


class Pace:
    """Running mean of a worker's seconds per unit of weight."""

    def __init__(self) -> None:
        self.seconds_per_weight = SECONDS_PER_WEIGHT / _FIRST_FRACTION
        self._first = True

    def update(self, seconds: float, weight: int) -> None:
        """Take the timing of one more chunk into account."""
        timed = max(seconds, _CLOCK_TICK) / weight
        self.seconds_per_weight = timed if self._first else (self.seconds_per_weight + timed) / 2
        self._first = False

    def chunk_weight(self) -> float:
        """Weight of a chunk that takes `CHUNK_SECONDS`, within bounds."""
        return min(_LARGEST_WEIGHT, CHUNK_SECONDS / self.seconds_per_weight)


_log = logging.getLogger(__name__)

#: Most and fewest characters of the bar: without room for the fewest there is none.
_WIDTH, _LEAST = 30, 6

#: Seconds between two lines in a log, and between two updates of the bar.
_LINE_SECONDS, _BAR_SECONDS = 30.0, 0.1


class ProgressBar:
    """Counts finished points, and shows their rate and the time left; on a terminal at once.

    Parameters
    ----------
    total
        Number of points to be computed.
    stream
        Where the bar goes if this is a terminal; otherwise a line goes to the log every half minute. By
        default `sys.stderr`, which is None in a process without one.
    clock
        Returns increasing seconds.
    name
        What is computed.
    """

    def __init__(
        self,
        total: int,
        stream: TextIO | None = None,
        clock: Callable[[], float] = time.monotonic,
        name: str = "",
    ) -> None:
        self.total = total
        self._name = name
        self.done = 0
        self._terminal = _terminal(sys.stderr if stream is None else stream)
        self._clock = clock
        self._begin = self._shown = clock()
        if total:
            self._show(f"0 of {total} points")

    def add(self, points: int) -> None:
        """Count more points as done."""
        self.done += points
        now = self._clock()
        every = _LINE_SECONDS if self._terminal is None else _BAR_SECONDS
        if now - self._shown < every and self.done < self.total:
            return
        if self._terminal is not None:
            self._show(self._words(now))
        elif now - self._begin >= _LINE_SECONDS:
            _log.info(f"{self._name}: {self._words(now)}" if self._name else self._words(now))
        self._shown = now

    def close(self) -> None:
        """End the line of the bar."""
        if self.total:
            self._write("\n")

    def _show(self, said: str) -> None:
        if self._terminal is not None:
            columns = get_terminal_size().columns
            self._write(f"\r{line(self._name, self.done / self.total, said, columns)}\x1b[K")

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


def line(name: str, share: float, said: str, columns: int) -> str:
    """A name, a bar and words in a line that no terminal of so many columns breaks.

    Examples
    --------
    >>> line("figure3", 0.25, "50 of 200 points", 50)
    'figure3  █████▌                  50 of 200 points'
    >>> line("figure3", 0.25, "50 of 200 points", 30)
    'figure3  50 of 200 points'
    >>> line("a_long_name_of_a_study", 0.25, "50 of 200 points", 30)
    'a_long_nam…  50 of 200 points'
    """
    room = columns - 1 - len(said) - 2  # a line of all columns would be broken by some terminals
    if name and len(name) > room:
        name = f"{name[: room - 1]}…" if room > 1 else ""
    left = f"{name}  " if name else ""
    width = min(_WIDTH, room - len(left))
    drawn = f"{bar(share, width)}  " if width >= _LEAST else ""
    return f"{left}{drawn}{said}"[: columns - 1]


def bar(share: float, width: int) -> str:
    """A bar whose length shows how much is done.

    Examples
    --------
    >>> bar(0.25, 30)
    '███████▌                      '
    """
    eighths = round(8 * width * share)
    full = "█" * (eighths // 8) + " ▏▎▍▌▋▊▉"[eighths % 8].strip()
    return f"{full:<{width}}"


def words(done: int, total: int, seconds: float) -> str:
    """Say in words how far a run has got.

    Examples
    --------
    >>> words(50, 200, 10.0)
    '50 of 200 points (25 %), 5/s, 30 s left'
    """
    rate = done / seconds if seconds > 0 else 0.0
    left = duration((total - done) / rate) + " left" if rate and done < total else duration(seconds)
    return f"{done} of {total} points ({100 * done / total:.0f} %), {rate:.3g}/s, {left}"


class Collector:
    """Fills the results of a run into its records; shows progress inside a with block.

    Parameters
    ----------
    records
        Records of all points of the run; filled in place.
    run
        Origin of the results.
    writer
        Saves them as parts.
    todo
        Number of points to be computed.
    name
        Name of the study.
    """

    def __init__(self, records: Records, run: Run, writer: PartsWriter, todo: int, name: str) -> None:
        self.records = records
        self.pace = Pace()
        self._run = run
        self._writer = writer
        self._weights = weights(records.table)
        self._bar = ProgressBar(todo, name=name)

    def __enter__(self) -> Collector:
        return self

    def __exit__(self, *_: object) -> None:
        self._bar.close()

    def add(self, rows: IntArray, found: Records) -> None:
        """Save what was found of the points in some rows, and fill it in.

        Raises
        ------
        WorkerError
            If it comes from another version of the solver.
        OSError
            If it cannot be saved.
        """
        (own,) = found.runs
        if own.solver_version != SOLVER_VERSION:
            words = f"a worker has version {own.solver_version} of the solver"
            raise WorkerError(f"{words}, this machine {SOLVER_VERSION}")
        there = self.records.take(rows)
        if (there.status == MISSING).all():
            run = replace(self._run, seconds=own.seconds, quantities=own.quantities)
            part = replace(found, runs=(run,))
        else:
            part = there.trimmed().extended(found)
        self._writer.add(part)
        self.records = self.records.fill(rows, part)
        self.pace.update(own.seconds, int(self._weights[rows].sum()))
        self._bar.add(len(rows))
