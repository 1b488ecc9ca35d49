"""Saving figures to files."""

from __future__ import annotations

from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.figures.style import Style, styled
from swtstudy.vocabulary.files import replacing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Time stamps, left out so that the same results give the same file.
_NO_DATE: dict[str, dict[str, None]] = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}

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


def picture(figure: Figure, ending: str, style: Style | None = None) -> bytes:
    """The content of a file with a figure: png, pdf or svg; `figure` and `style` as for `save_figure`."""
    content = BytesIO()
    with styled(style, getattr(figure, "width", None)):
        figure.savefig(content, format=ending, metadata=_NO_DATE.get(f".{ending}"))
    return content.getvalue()
