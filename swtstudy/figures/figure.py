"""A figure that notebooks display."""

from __future__ import annotations

from io import BytesIO
from typing import Any

import matplotlib.figure


class Figure(matplotlib.figure.Figure):
    """Independent of pyplot, yet displayed; IPython itself displays figures only once pyplot is imported.

    Attributes
    ----------
    width
        What it is made for: a key of `swtstudy.figures.sheet.WIDTHS`, or None for a screen.
    """

    width: Any = None

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=self.get_dpi())
        return picture.getvalue()
