"""The style of figures: legible in print, with any colour vision and in greyscale; saving them to files.

Users may change the style.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.style
from cycler import cycler
from matplotlib import rcParamsDefault
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swtstudy.vocabulary.files import replacing
from swtstudy.vocabulary.mistakes import literal, nearest, refused

#: Types that matplotlib accepts as a style: a name, a file, rcParams, or a list of these.
Style = str | Path | dict[str, Any] | list[str | Path | dict[str, Any]]

#: Okabe and Ito's colours, distinct with any colour vision; without yellow.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00")
#: Their number is coprime to the number of the colours, so that no pair repeats early.
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (8, 2, 3, 2)))
#: One marker for each repetition of the dashes.
MARKERS = ("", "o", "s", "^", "D", "v", "X")
_LINES = range(math.lcm(len(COLOURS), len(DASHES)))


@cache
def style_of(name: str) -> dict[str, Any]:
    """The rcParams of "screen", or of "print", which go on top of a screen's."""
    path = Path(__file__).with_name(f"{name}.mplstyle")
    own = dict(matplotlib.rc_params_from_file(path, use_default_template=False))
    if name == "print":
        return style_of("screen") | own
    cycle = {
        "color": [COLOURS[i % len(COLOURS)] for i in _LINES],
        "linestyle": [DASHES[i % len(DASHES)] for i in _LINES],
        "marker": [MARKERS[i // len(DASHES)] for i in _LINES],
    }
    return own | {"axes.prop_cycle": cycler(**cycle)}


def stroke(color: Any = "black", dashes: Any = "-", **own: Any) -> dict[str, Any]:
    """The look of a line that has nothing of the cycle of colours, dashes and markers."""
    return {"color": color, "linestyle": dashes, "marker": "", **own}


def dots(color: Any = "black", size: float = 1.0, **own: Any) -> dict[str, Any]:
    """The look of points without a line, so many times as large as the style's markers; no frame cuts it."""
    own = {"marker": "o", "markersize": size * matplotlib.rcParams["lines.markersize"], **own}
    return {"color": color, "linestyle": "none", "clip_on": False, "in_layout": False, **own}


def arrow(axes: Axes, start: Any, end: Any, ends: str = "-|>", color: Any = "black", **own: Any) -> None:
    """Draw an arrow from one place to another, with matplotlib's style of its ends."""
    look = {"arrowstyle": ends, "color": color, "shrinkA": 0.0, "shrinkB": 0.0, **own}
    axes.annotate("", end, start, arrowprops=look)


def entitle(axes: Axes, words: str) -> None:
    """Give a panel a title, flush left."""
    axes.set_title(words, loc="left")


@contextmanager
def styled(style: Style | None = None, width: str | None = None) -> Iterator[None]:
    """The package's style while a figure is drawn or saved.

    Parameters
    ----------
    style
        A matplotlib style that overrides everything else. Without it, every rcParam that differs from
        matplotlib's default stays as it is: a matplotlibrc or ``plt.style.use`` is honoured.
    width
        The use of the figure: a key of `swtstudy.figures.sheet.WIDTHS`, or None for a screen.

    Raises
    ------
    StudyError
        A ValueError, if there is no such style.
    """
    known: Any = matplotlib.rcParams
    wanted: Any = style_of("screen" if width is None else "print").items()
    own: Any = {name: value for name, value in wanted if known[name] == rcParamsDefault[name]}
    own["text.usetex"] = False  # our words are not LaTeX: it would stop at the first % or _
    with matplotlib.rc_context(own):
        if style is not None:
            try:
                matplotlib.style.use(style)
            except (OSError, KeyError, ValueError) as error:
                allowed = "rcParams of matplotlib and their values"
                if isinstance(error, OSError):
                    allowed = f"{nearest(str(style), matplotlib.style.available, {})}; or a .mplstyle file"
                raise refused("style", literal(style), allowed) from None
        yield


#: Time stamps, left out so that the same results give the same file.
_NO_DATE: dict[str, dict[str, None]] = {"pdf": {"CreationDate": None}, "svg": {"Date": None}}

FORMATS = (".png", ".pdf", ".svg")


def save_figure(figure: Figure, path: str | PathLike[str], style: Style | None = None) -> None:
    """Write a figure as PNG, PDF or SVG, according to the ending of its name; `style` as for `draw`.

    Raises
    ------
    ValueError
        If the name has another ending.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise ValueError(f"{path}: found {suffix or 'no ending'}; allowed: {', '.join(FORMATS)}")
    # Drawn in memory first: it takes seconds, and a process killed meanwhile would leave an unfinished file.
    content = picture(figure, suffix[1:], style)
    with replacing(path) as temporary:
        temporary.write_bytes(content)


def picture(figure: Figure, ending: str, style: Style | None = None, **options: Any) -> bytes:
    """The content of a file with a figure: png, pdf, svg or webp; ``options`` as of ``savefig``."""
    content = BytesIO()
    with styled(style, getattr(figure, "width", None)):
        figure.savefig(content, format=ending, metadata=_NO_DATE.get(ending), **options)
    return content.getvalue()
