"""Progress of whatever takes longer than two seconds: a bar for people, lines in a log."""

from __future__ import annotations

import logging
import sys
import time
from contextvars import ContextVar, Token
from typing import Any, Self, TextIO

_log = logging.getLogger(__name__)

#: Seconds after which a bar appears, unless it is there from the first moment.
PATIENCE = 2.0
#: Seconds between two lines in a log.
LINE_SECONDS = 30.0
#: Progress of the search, or of the fit, in which something is solved.
_OUTER: ContextVar[Progress | None] = ContextVar("_OUTER", default=None)


class Progress:
    """Counts what is finished inside a with block, and shows its rate and the time left.

    Steps that are counted inside another block count there.

    Parameters
    ----------
    total
        How many there are; None if that is not known.
    name
        The work, in a word.
    unit
        The unit of a step.
    delay
        Seconds before the bar appears.
    """

    def __init__(
        self, total: int | None, name: str = "", unit: str = "points", delay: float = PATIENCE
    ) -> None:
        self._total, self._name, self._unit = total, name, unit
        self._delay, self._done = delay, 0
        self._bar: Any = None
        self._outer = _OUTER.get()
        self._token: Token[Progress | None] | None = None
        self._begin = self._told = time.monotonic()
        self._hidden = total == 0
        if not delay and self._outer is None:
            self._show()

    def __enter__(self) -> Self:
        if self._outer is None:
            self._token = _OUTER.set(self)
        return self

    def __exit__(self, *_: object) -> None:
        if self._token is not None:
            _OUTER.reset(self._token)
        self.close()

    def add(self, finished: int = 1) -> None:
        """Count more as done."""
        if self._outer is not None:
            self._outer.add(finished)
            return
        self._done += finished
        now = time.monotonic()
        if self._bar is not None:
            self._bar.update(finished)
        elif not self._hidden and now - self._begin >= self._delay:
            self._show()
        if self._hidden and self._total != 0 and now - self._told >= LINE_SECONDS:
            self._told = now
            _log.info(self._words(now - self._begin))

    def close(self) -> None:
        """End the line of the bar, or tell the end of what was told in lines."""
        if self._bar is not None:
            self._bar.close()
        elif self._told > self._begin:
            _log.info(self._words(time.monotonic() - self._begin))

    def _show(self) -> None:
        """Show the bar where there is somebody to see it; importing tqdm takes a while."""
        notebook = _in_notebook()
        self._hidden = self._total == 0 or not (notebook or _is_terminal(sys.stderr))
        if self._hidden:
            return
        if notebook:
            from tqdm.auto import tqdm
        else:
            from tqdm import tqdm
        self._bar = tqdm(
            total=self._total,
            initial=self._done,
            desc=self._name or None,
            unit=f" {self._unit}",
            leave=not notebook,
            dynamic_ncols=True,
            mininterval=0.1,
            **({} if notebook else {"file": sys.stderr}),
        )
        # The rate counts from the beginning, not from when the bar appeared.
        self._bar.start_t -= time.monotonic() - self._begin

    def _words(self, seconds: float) -> str:
        of = f" of {self._total}" if self._total else ""
        rate = f", {self._done / seconds:.3g}/s" if seconds > 0.0 else ""
        return f"{self._name}: {self._done}{of} {self._unit}{rate}".removeprefix(": ")


def _in_notebook() -> bool:
    """True in a cell of a notebook; not where its kernel is merely imported."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return shell is not None and "IPKernelApp" in shell.config


def _is_terminal(stream: TextIO | None) -> bool:
    """True if a stream is a terminal; not if it is missing or closed."""
    try:
        return stream is not None and stream.isatty()
    except ValueError:
        return False
