"""Progress of whatever takes longer than two seconds: a bar for people, lines in a log."""

from __future__ import annotations

import logging
import sys
import time
from contextvars import ContextVar
from typing import Any, Self

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
        self._total, self._name, self._unit, self._delay = total, name, unit, delay
        self._done = 0
        self._bar: Any = None
        self._outer = _OUTER.get()
        self._begin = self._told = time.monotonic()

    def __enter__(self) -> Self:
        self._token = _OUTER.set(self._outer or self)
        if self._total and not self._delay and self._outer is None and _is_visible():
            self._show()
        return self

    def __exit__(self, *_: object) -> None:
        """End the line of the bar, or tell the end of what was told in lines."""
        _OUTER.reset(self._token)
        if self._bar is not None:
            self._bar.close()
        if self._told > self._begin:
            self._tell()

    def add(self, finished: int = 1) -> None:
        """Count more as done."""
        if self._outer is not None:
            self._outer.add(finished)
            return
        self._done += finished
        now = time.monotonic()
        if self._bar is not None:
            self._bar.update(finished)
        elif not _is_visible() and now - self._told >= LINE_SECONDS:
            self._told = now
            self._tell()
        elif _is_visible() and now - self._begin >= self._delay:
            self._show()

    def _show(self) -> None:
        """Show the bar; importing tqdm takes a while."""
        from tqdm.auto import tqdm

        self._bar = tqdm(
            total=self._total,
            initial=self._done,
            desc=self._name or None,
            unit=f" {self._unit}",
            leave=not _in_notebook(),
            dynamic_ncols=True,
            disable=False,
        )
        # The rate counts from the beginning, not from when the bar appeared.
        self._bar.start_t -= time.monotonic() - self._begin

    def _tell(self) -> None:
        """Write a line into the log."""
        seconds = time.monotonic() - self._begin
        of = f" of {self._total}" if self._total else ""
        rate = f", {self._done / seconds:.3g}/s" if seconds > 0.0 else ""
        _log.info(f"{self._name}: {self._done}{of} {self._unit}{rate}".removeprefix(": "))


def _in_notebook() -> bool:
    """True in a cell of a notebook; not where its kernel is merely imported."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return shell is not None and "IPKernelApp" in shell.config


def _is_visible() -> bool:
    """True in a notebook and on a terminal; not if that is missing or closed."""
    try:
        return _in_notebook() or (sys.stderr is not None and sys.stderr.isatty())
    except ValueError:
        return False
