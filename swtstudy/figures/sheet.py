"""The sheet that a figure fills: a screen, a journal's column, or its page.

Notebooks display its figures. Titles and labels are broken into lines where they are longer than there is
room.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from io import BytesIO
from typing import Any, Literal

import matplotlib.figure
import numpy as np
from matplotlib.axes import Axes
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.text import Text
from numpy.typing import NDArray

from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal


class Figure(matplotlib.figure.Figure):
    """Independent of pyplot, yet displayed; IPython itself displays figures only once pyplot is imported.

    Attributes
    ----------
    width
        What it is made for: a key of `WIDTHS`, or None for a screen.
    """

    width: Any = None

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=self.get_dpi())
        return picture.getvalue()


#: What a figure is made for; without it for a screen, where it grows with its panels.
Width = Literal["column", "page"]

_INCH = 2.54
#: Widths of a journal's column and page, inches, and the height that a page has for figures.
WIDTHS: dict[str, float] = {"column": 8.5 / _INCH, "page": 17.5 / _INCH}
_TALLEST = 23.0 / _INCH
#: Panels side by side in print, where they are no more than fit.
_ACROSS = {"column": 1, "page": 3}
#: Size of a panel on a screen, and the width that panels side by side have there at most, inches.
PANEL = (4.0, 3.2)
_SCREEN = 13.5


@dataclass(frozen=True)
class Sheet:
    """The medium and the panels of a figure.

    Attributes
    ----------
    rows
        Rows of panels that belong together, such as a quantity each.
    count
        Panels of each row; they continue in the next line where the sheet ends.
    width
        "column", 8.5 cm; "page", 17.5 cm; or None for a screen.
    panel
        Width and height of a panel on a screen, inches.
    least_height
        Height of a panel in print, inches, where others would be lower.
    fold
        Whether there are more panels side by side in print where they would be longer than a page.
    """

    rows: int
    count: int
    width: Width | None = None
    panel: tuple[float, float] = PANEL
    least_height: float = 0.0
    fold: bool = True

    def __post_init__(self) -> None:
        check_width(self.width)

    @property
    def across(self) -> int:
        """Panels side by side."""
        most = max(1, int(_SCREEN / self.panel[0])) if self.width is None else _ACROSS[self.width]
        # No more side by side than the lines need: four panels are two by two.
        across = -(-self.count // -(-self.count // most))
        if self.width is not None and self.fold and self._height(across) > _TALLEST:
            across = min(self.count, max(across, most + 1))
        return across

    @property
    def size(self) -> tuple[float, float]:
        """Width and height, inches."""
        across = self.across
        if self.width is None:
            return self.panel[0] * across, self.panel[1] * self.rows * -(-self.count // across)
        return WIDTHS[self.width], self._height(across)

    def _height(self, across: int) -> float:
        """Height in print with so many panels side by side: flatter where they are wide, 8 cm at most."""
        each = min(0.85 + 0.45 * WIDTHS[self.width or "page"] / across, 8.0 / _INCH)
        return max(each, self.least_height) * self.rows * -(-self.count // across)

    def figure(self, beside: float = 0.0) -> Figure:
        """An empty figure; on a screen it has so many inches more in width, for scales beside the panels."""
        width, height = self.size
        return new_figure((width + beside if self.width is None else width, height), self.width)

    def panels(self, figure: Figure, share_x: str = "all", share_y: str = "row") -> NDArray[Any]:
        """Panels of shape (rows, count).

        Parameters
        ----------
        figure
            Where they are.
        share_x, share_y
            Which panels have the axis in common: "all", those of a "row", or "none".
        """
        across, panels = self.across, np.empty((self.rows, self.count), dtype=object)
        lines = -(-self.count // across)
        for row, index in np.ndindex(self.rows, self.count):
            line, column = divmod(index, across)
            first = {"all": panels[0, 0], "row": panels[row, 0], "none": None}
            cell = (self.rows * lines, across, (row * lines + line) * across + column + 1)
            one = figure.add_subplot(*cell, sharex=first[share_x], sharey=first[share_y])
            lowest = row == self.rows - 1 and index + across >= self.count
            one.tick_params(labelleft=column == 0 or share_y == "none")
            one.tick_params(labelbottom=lowest or share_x != "all")
            panels[row, index] = one
        return panels

    def first_of_lines(self, panels: NDArray[Any]) -> NDArray[Any]:
        """The panels at the left end of their lines, of shape (rows, lines)."""
        return panels[:, :: self.across]

    def lowest(self, panels: NDArray[Any]) -> list[Axes]:
        """The panels with nothing beneath them."""
        return list(panels[-1, max(self.count - self.across, 0) :])


def check_width(width: object) -> None:
    """Refuse a width that there is not.

    Raises
    ------
    StudyError
        A ValueError that names what is allowed.
    """
    if width is not None and width not in WIDTHS:
        allowed = ", ".join(f'"{name}"' for name in WIDTHS)
        raise StudyError([Mistake("width", literal(width), f"{allowed}, or None for a screen")])


def new_figure(size: tuple[float, float], width: Width | None = None) -> Figure:
    """An empty figure whose panels leave room for all that is written around them."""
    pad = 0.06 if width is None else 0.03
    layout = ConstrainedLayoutEngine(w_pad=pad, h_pad=pad, wspace=0.05 if width is None else 0.03)
    figure = Figure(size, layout=layout)
    figure.width = width
    return figure


#: A word with the blanks before it; a formula between $ is one word, also with the value that it has. No
#: formula begins with a dollar behind a backslash.
_WORD = re.compile(r"\s*(?:\\\$|\$(?:\\\$|[^$])*\$|[^\s$])+(?: = \S+)?")
#: Texts with fewer signs fit into the panels of a screen.
_LONG = 30


def wrap_texts(figure: Figure) -> None:
    """Break titles and labels that are longer than their panels, or than the figure; a word stays whole."""
    whole = figure._suptitle  # type: ignore[attr-defined]
    labels = [label for axes in figure.axes for label in (axes.xaxis.label, axes.yaxis.label)]
    titles = [(axes, each) for axes in figure.axes for each in (axes.title, axes._left_title)]  # type: ignore[attr-defined]
    texts = [*labels, *(title for _, title in titles), *([whole] if whole else [])]
    if figure.width is None and all(len(text.get_text()) <= _LONG for text in texts):
        return
    figure.draw_without_rendering()

    def wrap(text: Text, room: float, upright: bool = False) -> None:
        lines = []
        for given in text.get_text().splitlines():
            line = ""
            for word in _WORD.findall(given):
                text.set_text(line + word)
                box = text.get_window_extent()
                if line and (box.height if upright else box.width) > room:
                    lines.append(line)
                    line, word = "", word.lstrip()
                line += word
            lines.append(line)
        text.set_text("\n".join(lines))

    for axes, title in titles:
        ticks = axes.xaxis.get_tightbbox()
        wide = max(axes.bbox.width, (ticks.x1 if ticks else 0.0) - axes.bbox.x0)
        wrap(title, min(wide, figure.bbox.width - axes.bbox.x0))
    for axes in figure.axes:
        wrap(axes.xaxis.label, (1.0 if figure.width is None else 1.15) * axes.bbox.width)
        wrap(axes.yaxis.label, axes.bbox.height, upright=True)
    if whole:
        wrap(whole, 0.98 * figure.bbox.width)
