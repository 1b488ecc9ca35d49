"""The sheet that a figure fills, and what stands around its panels: titles, labels and a legend.

A sheet is a screen, a journal's column, or its page. Titles and labels are broken into lines where they are
longer than there is room; a legend stands below all panels.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Literal

import matplotlib.figure
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerLine2D
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.ticker import ScalarFormatter
from numpy.typing import NDArray

from swtstudy.figures.style import Style, picture, stroke, styled
from swtstudy.points.validity import OUTSIDE
from swtstudy.solver.load_path import Loop
from swtstudy.vocabulary.mistakes import literal, refused


class Figure(matplotlib.figure.Figure):
    """Independent of pyplot, yet displayed; IPython itself displays figures only once pyplot is imported.

    Attributes
    ----------
    width
        The use of the figure: a key of `WIDTHS`, or None for a screen.
    """

    width: Any = None

    def _repr_png_(self) -> bytes:
        return picture(self, "png", dpi="figure")


#: Uses of a figure in print; on a screen a figure grows with its panels.
Width = Literal["column", "page"]

#: In cm.
INCH = 2.54
#: Widths of a journal's column and page, inches, and the height that a page has for figures.
WIDTHS: dict[str, float] = {"column": 8.5 / INCH, "page": 17.5 / INCH}
TALLEST = 23.0 / INCH
#: Panels side by side in print, where they are no more than fit.
_ACROSS = {"column": 1, "page": 3}
#: Size of a panel on a screen, and the width that panels side by side have there at most, inches.
PANEL = (4.0, 3.2)
_SCREEN = 13.5
#: Width of a scale of colours on a screen, inches.
_SCALE = 1.5


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
        """Refuse a width that there is not."""
        if self.width is not None and self.width not in WIDTHS:
            allowed = ", ".join(f'"{name}"' for name in WIDTHS)
            raise refused("width", literal(self.width), f"{allowed}, or None for a screen")

    @property
    def across(self) -> int:
        """Panels side by side."""
        most = max(1, int(_SCREEN / self.panel[0])) if self.width is None else _ACROSS[self.width]
        # No more side by side than the lines need: four panels are two by two.
        across = -(-self.count // -(-self.count // most))
        if self.width is not None and self.fold and self._height(across) > TALLEST:
            across = min(self.count, max(across, most + 1))
        return across

    def _height(self, across: int) -> float:
        """Height in print with so many panels side by side: flatter where they are wide, 8 cm at most."""
        each = min(0.85 + 0.45 * WIDTHS[self.width or "page"] / across, 8.0 / INCH)
        return max(each, self.least_height) * self.rows * -(-self.count // across)

    def figure(self, beside: bool = False) -> Figure:
        """An empty figure; on a screen it is wider where a scale is to stand beside the panels."""
        across = self.across
        if self.width is not None:
            return new_figure((WIDTHS[self.width], self._height(across)), self.width)
        height = self.panel[1] * self.rows * -(-self.count // across)
        return new_figure((self.panel[0] * across + _SCALE * beside, height))

    @contextmanager
    def drawn(
        self, style: Style | None, share_x: str = "none", share_y: str = "none"
    ) -> Iterator[tuple[Figure, NDArray[Any]]]:
        """A figure and its `panels`, to be drawn in a style; at the end its texts are wrapped."""
        with styled(style, self.width):
            figure = self.figure()
            yield figure, self.panels(figure, share_x, share_y)
            wrap_texts(figure)

    def panels(self, figure: Figure, share_x: str = "all", share_y: str = "row") -> NDArray[Any]:
        """Panels of shape (rows, count).

        Parameters
        ----------
        figure
            Where they are.
        share_x, share_y
            Which panels have the axis in common: "all", the panels of a "row", or "none".
        """
        across, panels = self.across, np.empty((self.rows, self.count), dtype=object)
        lines = -(-self.count // across)
        for row, index in np.ndindex(self.rows, self.count):
            line, column = divmod(index, across)
            first = {"all": panels[0, 0], "row": panels[row, 0], "none": None}
            cell = (self.rows * lines, across, (row * lines + line) * across + column + 1)
            one = figure.add_subplot(*cell, sharex=first[share_x], sharey=first[share_y])
            lowest = row == self.rows - 1 and index + across >= self.count
            for axis, share in ((one.xaxis, share_x), (one.yaxis, share_y)):
                if first[share] is None:
                    axis.set_major_formatter(PlainNumbers())
            left, bottom = column == 0 or share_y == "none", lowest or share_x != "all"
            one.tick_params(labelleft=left, labelbottom=bottom)
            panels[row, index] = one
        return panels

    def label_left(self, panels: NDArray[Any], words: str) -> None:
        """Label the vertical axes of a row of panels, at the left end of each of its lines."""
        for first in panels[:: self.across]:
            first.set_ylabel(words)


class PlainNumbers(ScalarFormatter):
    """Numbers of ticks as plain text: matplotlib parses each formula, which takes longer.

    The power of ten at the end of an axis is a formula.
    """

    def set_locs(self, locs: Any) -> None:
        """Ticks at these places."""
        self.set_useMathText(False)
        super().set_locs(locs)
        self.set_useMathText(True)


def new_figure(size: tuple[float, float], width: Width | None = None) -> Figure:
    """An empty figure whose panels leave room for all that is written around them."""
    pad = 0.06 if width is None else 0.03
    layout = ConstrainedLayoutEngine(w_pad=pad, h_pad=pad, wspace=0.05 if width is None else 0.03)
    figure = Figure(size, layout=layout)
    FigureCanvasAgg(figure)  # keeps the sizes of texts: without it each is measured anew
    figure.width = width
    return figure


#: A word with the blanks before it; a formula between $ is one word, with its value and its unit. No
#: formula begins with a dollar behind a backslash.
_WORD = re.compile(r"\s*(?:\\\$|\$(?:\\\$|[^$])*\$|[^\s$])+(?: = \S+(?:(?: [^\s$,]+){1,2}(?:,|$))?)?")
#: Texts with fewer signs fit into the panels of a screen.
_LONG = 30


def wrap_texts(figure: Figure) -> None:
    """Break titles and labels that are longer than their panels, or than the figure; a word stays whole."""
    whole: Any = figure._suptitle  # type: ignore[attr-defined]
    texts: list[tuple[Text, Any]] = []
    for axes in figure.axes:
        own = axes.title, axes._left_title, axes.xaxis.label, axes.yaxis.label  # type: ignore[attr-defined]
        texts += [(text, axes) for text in own if text.get_text()]
    letters = [len(text.get_text()) for text in (whole, *(text for text, _ in texts)) if text]
    if figure.width is None and max(letters, default=0) <= _LONG:
        return
    # Panels get their places; drawing the figure would also do that, in twice the time.
    if engine := figure.get_layout_engine():
        engine.execute(figure)
    for axes in figure.axes:
        locator: Any = axes.get_axes_locator()
        axes.apply_aspect(locator(axes, None) if locator else None)
    for text, axes in texts:
        if text is axes.yaxis.label:
            _wrap(text, axes.bbox.height, "height")
        elif text is axes.xaxis.label:
            _wrap(text, (1.0 if figure.width is None else 1.15) * axes.bbox.width)
        else:  # a title may end where the last number below its panel ends
            ticks = axes.xaxis.get_tightbbox()
            end = max(axes.bbox.x1, ticks.x1 if ticks else 0.0)
            _wrap(text, min(end, figure.bbox.x1) - axes.bbox.x0)
    if whole:
        _wrap(whole, 0.98 * figure.bbox.width)


def _wrap(text: Text, room: float, along: str = "width") -> None:
    """Break each line of a text that is longer than there is room."""

    def fits(line: str) -> bool:
        text.set_text(line)
        return bool(getattr(text.get_window_extent(), along) <= room)

    lines: list[str] = []
    for given in text.get_text().splitlines():
        lines.append("")
        for word in [given] if fits(given) else _WORD.findall(given):
            if lines[-1] and not fits(lines[-1] + word):
                lines.append(word.lstrip())
            else:
                lines[-1] += word
    text.set_text("\n".join(lines))


class LoopHandler(HandlerLine2D):
    """A line's sample, and beside it the loop that the line is about: tangential across, normal upwards."""

    def __init__(self, loops: Mapping[str, Loop]) -> None:
        super().__init__()
        self._loops = loops

    def create_artists(
        self, legend: Any, handle: Any, left: Any, down: Any, width: Any, height: Any, *more: Any
    ) -> Any:
        sample = super().create_artists(legend, handle, left, down, 0.52 * width, height, *more)
        loop, side = self._loops.get(str(handle.get_label())), 0.85 * height
        if loop is None:
            return sample
        path = loop.course()[:, 1::-1]  # tangential across
        spread = np.ptp(path, axis=0)
        # A load that rests is in the middle.
        share = np.where(spread > 0.0, (path - path.min(axis=0)) / np.where(spread > 0.0, spread, 1.0), 0.5)
        corner = np.array([width - side - left, -down + 0.5 * (height - side)])
        drawn = stroke(handle.get_color(), linewidth=1.0, transform=more[-1])
        return [*sample, Line2D(*(corner + side * share).T, **drawn)]


def add_legend(figure: Figure, loops: Mapping[str, Loop] | None = None) -> None:
    """Add one legend for all panels, lines before bands beneath them and markers; no entry is cut off.

    Parameters
    ----------
    figure
        The figure, which grows by the height of the legend. On a screen it gets wider where an entry is wider
        than all panels; in print the letters of the legend get smaller there.
    loops
        Loops by the labels of their lines: they are drawn beside the lines' samples.
    """
    handles: dict[str, Any] = {}
    for one in figure.axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    if not handles:
        return
    # The mark of places outside of limits has one entry, with the limits of all panels.
    beyond = {label: handles.pop(label) for label in [*handles] if label.startswith(OUTSIDE)}
    if beyond:
        limits = dict.fromkeys(each for label in beyond for each in label.removeprefix(OUTSIDE).split(", "))
        handles[OUTSIDE + ", ".join(limits)] = next(iter(beyond.values()))

    def rank(label: str) -> tuple[bool, bool, float]:
        order = handles[label].get_zorder()
        return handles[label].get_linestyle() == "None", order < Line2D.zorder, order

    labels = sorted(handles, key=rank)
    look: dict[str, Any] = {}
    if loops:
        look = {"handler_map": {Line2D: LoopHandler(loops)}}
        look |= {"handlelength": 4.6, "handleheight": 1.9, "labelspacing": 0.7}
    place_legend(figure, [handles[label] for label in labels], labels, **look)


def place_legend(figure: Figure, handles: list[Any], labels: list[str], **look: Any) -> None:
    """Add a legend of these entries in as many columns as fit; see `add_legend`."""
    look |= {"handles": handles, "labels": labels, "loc": "outside lower center"}

    def placed(**own: Any) -> tuple[Legend, float, float]:
        """A legend with its width and height, inches, padding included."""
        legend = figure.legend(**look, **own)
        around = 2.0 * legend.borderaxespad * float(legend.get_texts()[0].get_fontsize()) / 72.0
        box = legend.get_window_extent()
        return legend, box.width / figure.dpi + around, box.height / figure.dpi + around

    room = figure.get_figwidth()
    for columns in range(len(labels), 0, -1):
        legend, width, height = placed(ncols=columns)
        if width <= room or columns == 1:
            break
        legend.remove()
    if width > room and figure.width is not None:
        size = float(legend.get_texts()[0].get_fontsize()) * room / width
        legend.remove()
        _, width, height = placed(fontsize=size)
    figure.set_size_inches(room if figure.width else max(room, width), figure.get_figheight() + height)
