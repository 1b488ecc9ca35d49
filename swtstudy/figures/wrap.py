"""Titles and labels in print: broken into lines where they are longer than there is room."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.text import Text

    from swtstudy.figures.figure import Figure

#: A word with the blanks before it; a formula between $ is one word, also with the value that it has. No
#: formula begins with a dollar behind a backslash.
_WORD = re.compile(r"\s*(?:\\\$|\$(?:\\\$|[^$])*\$|[^\s$])+(?: = \S+)?")
#: What of a formula is one letter, and what none.
_COMMAND, _NO_LETTER = re.compile(r"\\[a-zA-Z]+"), re.compile(r"[\\${}_^,]")
#: Labels of so many letters may be longer than a panel.
_LONG = 30


def wrap_texts(figure: Figure) -> None:
    """Break titles and labels of axes that are longer than their panels; on a screen upright labels alone."""
    if figure.width is None:
        tall = [axes for axes in figure.axes if letters(axes.get_ylabel()) > _LONG]
        if tall:
            figure.draw_without_rendering()
        for axes in tall:
            _wrap(axes.yaxis.label, axes.bbox.height, True)
        return
    figure.draw_without_rendering()
    wrap_title(figure)
    room = figure.bbox.width
    for axes in figure.axes:
        ticks = axes.xaxis.get_tightbbox()
        wide = max(axes.bbox.width, (ticks.x1 if ticks else 0.0) - axes.bbox.x0)
        for text in (axes.title, axes._left_title, axes._right_title):  # type: ignore[attr-defined]
            _wrap(text, min(wide, room - axes.bbox.x0), False)
        _wrap(axes.xaxis.label, 1.15 * axes.bbox.width, False)
        _wrap(axes.yaxis.label, axes.bbox.height, True)


def letters(words: str) -> int:
    r"""Return about the number of letters of a label: of a formula those that are seen.

    Examples
    --------
    >>> letters("stress"), letters(r"$\sigma_n\,a_H/(E^* \delta_0)$")
    (6, 12)
    """
    return len(_NO_LETTER.sub("", _COMMAND.sub("x", words)))


def wrap_title(figure: Figure) -> None:
    """Break the title of a figure that is longer than the figure."""
    if figure._suptitle is not None:  # type: ignore[attr-defined]
        _wrap(figure._suptitle, 0.98 * figure.bbox.width, False)  # type: ignore[attr-defined]


def _wrap(text: Text, room: float, upright: bool) -> None:
    """Break a text into lines no longer than the room, in pixels; a single word stays whole."""
    lines = []
    for given in text.get_text().splitlines():
        line = ""
        for word in _WORD.findall(given):
            if line and _length(text, line + word, upright) > room:
                lines.append(line)
                word = word.lstrip()
                line = ""
            line += word
        lines.append(line)
    text.set_text("\n".join(lines))


def _length(text: Text, words: str, upright: bool) -> Any:
    before = text.get_text()
    text.set_text(words)
    box = text.get_window_extent()
    text.set_text(before)
    return box.height if upright else box.width
