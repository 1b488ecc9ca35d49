"""The style of figures: legible in print, with any colour vision and in greyscale; saving them to files.

Users may change the style.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import matplotlib
import matplotlib.style
from cycler import cycler
from matplotlib import rcParamsDefault
from matplotlib.figure import Figure

from swtstudy.vocabulary.files import read_text, replacing
from swtstudy.vocabulary.mistakes import Mistake, StudyError, literal, nearest

#: What matplotlib accepts as a style: a name, a file, rcParams, or a list of these.
Style = str | Path | dict[str, Any] | list[str | Path | dict[str, Any]]

#: Okabe and Ito's colours, distinct with any colour vision; without yellow.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#56B4E9", "#E69F00")
#: Their number is coprime to that of the colours, so that no pair repeats early.
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (6, 1.5, 1.2, 1.5)), (0, (8, 2, 3, 2)))
#: One marker for each repetition of the dashes.
MARKERS = ("", "o", "s", "^", "D", "v", "X")

_LINES = range(math.lcm(len(COLOURS), len(DASHES)))

#: rcParams of every figure, except those that the user has changed.
STYLE: dict[str, Any] = {
    "axes.prop_cycle": cycler(
        color=[COLOURS[i % len(COLOURS)] for i in _LINES],
        linestyle=[DASHES[i % len(DASHES)] for i in _LINES],
        marker=[MARKERS[i // len(DASHES)] for i in _LINES],
    ),
    "axes.axisbelow": True,
    "axes.formatter.limits": (-3, 6),  # lengths of micrometres in mm: a power at the end of the axis
    "axes.formatter.use_mathtext": True,
    "axes.grid": True,
    "axes.titlelocation": "left",
    "axes.titlesize": "medium",
    "grid.color": "0.9",
    "grid.linewidth": 0.6,
    "image.cmap": "cividis",
    "legend.frameon": False,
    "legend.handlelength": 2.8,
    "lines.linewidth": 1.6,
    "lines.markersize": 4.0,
    "pdf.fonttype": 42,  # publishers refuse the default, Type 3
    "savefig.dpi": 150,
    "svg.hashsalt": "swtstudy",  # the same figure gives the same file
}

#: Further rcParams for print: 8 pt, and thinner lines. Other letters are relative to a user's font.size.
PRINT: dict[str, Any] = {
    "axes.labelpad": 2.0,
    "axes.linewidth": 0.6,
    "axes.titlepad": 4.0,
    "figure.titlesize": "medium",
    "font.size": 8.0,
    "grid.linewidth": 0.4,
    "legend.columnspacing": 1.4,
    "legend.fontsize": "small",
    "legend.handlelength": 2.6,
    "legend.handletextpad": 0.5,
    "legend.labelspacing": 0.3,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.0,
    "patch.linewidth": 0.6,
    "savefig.dpi": 300,
    "xtick.labelsize": "small",
    "xtick.major.size": 2.5,
    "xtick.major.width": 0.6,
    "xtick.minor.size": 1.5,
    "xtick.minor.width": 0.4,
    "ytick.labelsize": "small",
    "ytick.major.size": 2.5,
    "ytick.major.width": 0.6,
    "ytick.minor.size": 1.5,
    "ytick.minor.width": 0.4,
}


def stroke(color: Any = "black", dashes: Any = "-", **own: Any) -> dict[str, Any]:
    """The look of a line that has nothing of the cycle of colours, dashes and markers."""
    return {"color": color, "linestyle": dashes, "marker": "", **own}


@contextmanager
def styled(style: Style | None = None, width: str | None = None) -> Iterator[None]:
    """The package's style while a figure is drawn or saved.

    Parameters
    ----------
    style
        A matplotlib style that overrides everything else. Without it, every rcParam that differs from
        matplotlib's default stays as it is: a matplotlibrc or ``plt.style.use`` is honoured.
    width
        What the figure is made for: a key of `swtstudy.figures.sheet.WIDTHS`, or None for a screen.

    Raises
    ------
    StudyError
        A ValueError, if there is no such style, or a file is none.
    """
    for each in style if isinstance(style, list) else [style]:
        if isinstance(each, str | Path) and each not in matplotlib.style.library and Path(each).exists():
            _check_file(each)

    wanted = STYLE if width is None else STYLE | PRINT
    own: Any = {name: value for name, value in wanted.items() if _untouched(name)}
    own["text.usetex"] = False  # our words are not LaTeX: it would stop at the first % or _
    with ExitStack() as stack:
        stack.enter_context(matplotlib.rc_context(own))
        if style is not None:
            try:
                stack.enter_context(matplotlib.style.context(style))
            except OSError:
                allowed = f"{nearest(str(style), matplotlib.style.available, {})}; or a .mplstyle file"
                raise StudyError([Mistake("style", literal(style), allowed)]) from None
            except (KeyError, ValueError):
                allowed = "rcParams of matplotlib and their values"
                raise StudyError([Mistake("style", literal(style), allowed)]) from None
        yield


def _check_file(path: str | Path) -> None:
    """Raise unless each line of a file is one of a style: matplotlib itself only warns of others."""
    for number, line in enumerate(read_text(path).splitlines(), 1):
        words = re.sub(r'("[^"]*")|#.*', r"\1", line).strip()  # without the comment
        name, _, value = (part.strip() for part in words.partition(":"))
        try:
            if words:
                matplotlib.RcParams({name: value.strip('"')})
        except (KeyError, ValueError):
            allowed = "a line of a matplotlib style, such as lines.linewidth: 2"
            raise StudyError([Mistake(f"line {number}", literal(line), allowed, str(path))]) from None


def _untouched(name: Any) -> bool:
    return bool(matplotlib.rcParams[name] == rcParamsDefault[name])


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
