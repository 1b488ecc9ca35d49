"""Figures as pictures in a page, and where their panels are: for values under the pointer."""

from __future__ import annotations

import base64
import re
from dataclasses import dataclass, replace
from io import BytesIO
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

from swtstudy.figures.draw import draw, layout_of
from swtstudy.figures.inspection import inspect
from swtstudy.figures.save import picture
from swtstudy.figures.sheet import PANEL
from swtstudy.figures.style import styled
from swtstudy.reports.findings import worst_place
from swtstudy.results.quantity import quantity, quantity_error
from swtstudy.study.figure import LINE_KINDS, FigureLayout

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

#: Larger drawings are pictures of pixels, bytes; so many in an inch.
_LARGEST_DRAWING = 400_000
_DPI, _DPI_POINT, _DPI_THUMBNAIL = 150.0, 96.0, 96.0
#: Colours of pixels: those of lines, maps and their blurred edges.
_COLOURS = 64
#: Coordinates in a drawing; their digits behind the point, in 1/72 inch; what is for who reads its source.
_COORDINATES, _LONG = re.compile(rb' (?:d|x|y|x1|x2|y1|y2|points)="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
_SOURCE = re.compile(rb"\s*<!--.*?-->|\s*\n\s*", re.DOTALL)
#: CSS pixels in an inch.
_INCH = 96.0


@dataclass(frozen=True)
class Picture:
    """A picture as HTML needs it.

    Attributes
    ----------
    source
        A data URI.
    width, height
        In CSS pixels.
    """

    source: str
    width: int
    height: int

    @property
    def size(self) -> str:
        """The attributes of its element that keep its place free."""
        return f'width="{self.width}" height="{self.height}"'


def embedded(figure: Figure, dpi: float = _DPI, drawing: bool = True) -> Picture:
    """A figure as a drawing, or as pixels where that is smaller or asked for."""
    width, height = (round(_INCH * inches) for inches in figure.get_size_inches())
    _settle(figure, dpi)
    content, kind = b"", ""
    if drawing:
        content, kind = _rounded(picture(figure, "svg")), "svg+xml"
    if not drawing or len(content) > _LARGEST_DRAWING:
        content, kind = _pixels(figure), "webp"
    return Picture(f"data:image/{kind};base64,{base64.b64encode(content).decode()}", width, height)


def _settle(figure: Figure, dpi: float) -> None:
    """Lay a figure out once and for all: else matplotlib does so, and draws twice, when it is saved."""
    figure.dpi = dpi
    engine = figure.get_layout_engine()
    if engine is not None:
        with styled(None, getattr(figure, "width", None)):
            engine.execute(figure)
        figure.set_layout_engine(None)


def _rounded(drawing: bytes) -> bytes:
    """A drawing with the digits that are seen, in one line."""
    return _COORDINATES.sub(lambda found: _LONG.sub(rb"\1", found[0]), _SOURCE.sub(b" ", drawing))


def _pixels(figure: Figure) -> bytes:
    """A figure as a WebP file, in the figure's own dots per inch, with as many colours as it needs."""
    canvas, content = FigureCanvasAgg(figure), BytesIO()
    with styled(None, getattr(figure, "width", None)):
        canvas.draw()
    seen = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    few = seen.quantize(_COLOURS, dither=Image.Dither.NONE)
    few.convert("RGB").save(content, "webp", lossless=True)
    return content.getvalue()


def study_figure(dataset: xr.Dataset) -> tuple[Picture, list[dict[str, Any]], FigureLayout]:
    """The figure of a study, its panels as the scripts of a page need them, and its layout.

    A panel is where it is, as shares of the picture from its upper left corner; the ends of its axes; and the
    columns of the table that it shows. The kinds of a sample's figures have none.
    """
    layout = layout_of(dataset)
    figure = draw(dataset, layout)
    shown = embedded(figure)
    return shown, list(_panels(figure, dataset, layout)), layout


def thumbnail(dataset: xr.Dataset) -> Picture:
    """A small picture of the study's figure: its first quantity where it is largest, without words around."""
    layout = layout_of(dataset)
    one = dataset
    if layout.panels:
        one = dataset.isel({layout.panels: worst_place(dataset).get(layout.panels, 0)})
    figure = draw(one, replace(layout, panels=None, y=layout.y[:1], title=None))
    for legend in figure.legends:
        legend.remove()
    if layout.kind != "scatter":
        figure.set_size_inches(*PANEL)
    return embedded(figure, _DPI_THUMBNAIL, drawing=False)


def of_point(parameters: dict[str, Any]) -> Picture:
    """The picture of a parameter point, as `swtstudy.inspect` draws it."""
    return embedded(inspect(**parameters), _DPI_POINT, drawing=False)


def _panels(figure: Figure, dataset: xr.Dataset, layout: FigureLayout) -> Any:
    lines = layout.kind in LINE_KINDS
    if not lines and layout.kind not in ("contour", "heatmap"):
        return
    count = dataset.sizes[layout.panels] if layout.panels else 1
    for index, axes in enumerate(figure.axes[: count * len(layout.y)]):
        row, column = divmod(index, count)
        box = axes.get_position()
        upright = layout.kind == "life"
        yield {
            "box": [round(v, 5) for v in (box.x0, 1.0 - box.y1, box.width, box.height)],
            "ends": [float(end) for end in (*axes.get_xlim(), *axes.get_ylim())],
            "log": [axes.get_xscale() == "log", axes.get_yscale() == "log"],
            "x": layout.x,
            "y": layout.y[row] if lines else layout.vertical,
            "value": layout.y[row],
            "upright": upright,
            "lines": lines,
            "cells": layout.kind == "heatmap",
            "hue": layout.hue if lines else None,
            "fixed": {layout.panels: column} if layout.panels else {},
        }


def derived(dataset: xr.Dataset, layout: FigureLayout, dims: list[str]) -> dict[str, Any]:
    """Quantities of a figure that are no columns of the table, over its rows, with their errors."""
    found: dict[str, Any] = {}
    for y in layout.y:
        if y in dataset.data_vars:
            continue
        for name, values in ((y, quantity(dataset, y)), (f"{y}_error", quantity_error(dataset, y))):
            if values is not None:
                flat = values.transpose(*dims).values.ravel()
                found[name] = [float(f"{v:.6g}") if np.isfinite(v) else None for v in flat.tolist()]
    return found
