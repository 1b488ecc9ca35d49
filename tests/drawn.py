"""Figures of results through the accessor, by the keys of a study's ``[figure]``."""

from __future__ import annotations

from typing import Any

import xarray as xr
from matplotlib.figure import Figure


def keys(
    x: str, hue: str | None = None, panels: str | None = None, y: Any = ("s",), *more: Any, **others: Any
):
    """The keys of a figure, in the order of ``swt.panels``."""
    names = ("title", "kind", "vertical", "regimes", "validity")
    return {"x": x, "hue": hue, "panels": panels, "y": [*y], **dict(zip(names, more, strict=False)), **others}


def draw(dataset: xr.Dataset, layout: dict[str, Any] | None = None, **look: Any) -> Figure:
    """A figure with these keys, by default that of the study."""
    return dataset.swt.figure(**look) if layout is None else dataset.swt.panels(**layout, **look)
