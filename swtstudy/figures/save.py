"""Figures as files."""

from __future__ import annotations

from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.figures.style import Style, styled
from swtstudy.files import replacing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What tells the time of making, left out so that the same results give the same file.
_NO_DATE: dict[str, dict[str, None]] = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}}

FORMATS = (".png", ".pdf", ".svg")


def save_figure(figure: Figure, path: str | PathLike[str], style: Style | None = None) -> None:
    """Write a figure as PNG, PDF or SVG, by the ending of its name; `style` as for `draw`.

    Raises
    ------
    ValueError
        For another ending.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise ValueError(f"{path}: a figure's name ends in one of {', '.join(FORMATS)}")
    # Drawing takes seconds, in which a process that is ended would leave an unfinished file.
    picture = BytesIO()
    with styled(style):
        figure.savefig(picture, format=suffix[1:], metadata=_NO_DATE.get(suffix))
    with replacing(path) as temporary:
        temporary.write_bytes(picture.getvalue())
