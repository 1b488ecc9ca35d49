"""A figure that a notebook shows."""

from __future__ import annotations

from io import BytesIO

import matplotlib.figure


class Figure(matplotlib.figure.Figure):
    """Independent of pyplot, yet shown in a notebook: IPython itself knows figures only from pyplot on."""

    def _repr_png_(self) -> bytes:
        picture = BytesIO()
        self.savefig(picture, format="png", dpi=self.get_dpi())
        return picture.getvalue()
