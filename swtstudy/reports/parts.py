"""Pieces of HTML, and figures as pictures in a page, with their panels' places for values under the pointer.

Whoever calls the pieces escapes what an archive says.
"""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from html import escape
from importlib.resources import files
from io import BytesIO
from typing import Any, NamedTuple, cast

import numpy as np
import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from swtstudy.contacts import contact_of
from swtstudy.figures.draw import draw, layout_of
from swtstudy.figures.inspection import inspect
from swtstudy.figures.sheet import PANEL
from swtstudy.figures.style import picture, styled
from swtstudy.reports.findings import parameters_of, worst_place
from swtstudy.results.evaluate import quantity, quantity_error
from swtstudy.study.figure import LINE_KINDS, FigureLayout
from swtstudy.vocabulary.variables import has_units

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
    """Lay a figure out once and for all: else matplotlib does so, and draws twice, when it is saved.

    With its canvas of pixels, too: what that has measured of the letters needs no second look to draw them.
    """
    figure.dpi = dpi
    FigureCanvasAgg(figure)
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
    canvas, content = cast(FigureCanvasAgg, figure.canvas), BytesIO()
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


def of_point(one: xr.Dataset) -> Picture:
    """The picture of a point, as `swtstudy.inspect` draws it; of a real contact in its units."""
    if has_units(one):
        body = int(one.body) if "body" in one.coords and not one.body.ndim else 1
        return embedded(contact_of(one).inspect(body), _DPI_POINT, drawing=False)
    return embedded(inspect(**parameters_of(one)), _DPI_POINT, drawing=False)


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


#: A dot: without an icon, browsers ask the place where a page lies for one.
_ICON = (
    "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E"
    "%3Ccircle cx='8' cy='8' r='7' fill='%230072b2'/%3E%3C/svg%3E"
)


class Section(NamedTuple):
    """A part of a page.

    Attributes
    ----------
    name
        Its address in the page.
    title
        Its heading, HTML.
    body
        Its content, HTML; empty where there is nothing to say.
    live
        Whether it is for scripts alone.
    """

    name: str
    title: str
    body: str
    live: bool = False

    @property
    def html(self) -> str:
        """The section with its heading."""
        hidden = " data-script hidden" if self.live else ""
        return f'<section id="{self.name}"{hidden}>\n<h2>{self.title}</h2>\n{self.body}\n</section>'

    @property
    def link(self) -> str:
        """A link to it."""
        return f'<a href="#{self.name}"{" data-script hidden" if self.live else ""}>{self.title}</a>'


def section(name: str, title: str, *parts: str) -> Section:
    """A section of several parts, some of which may be empty."""
    return Section(name, title, "\n".join(filter(None, parts)))


def table(
    head: Sequence[str], rows: Iterable[Sequence[str]], numbers: Sequence[int] = (), wide: bool = False
) -> str:
    """A table; columns of numbers are set flush right."""

    def cells(row: Sequence[str], kind: str) -> str:
        marks = (' class="n"' if index in numbers else "" for index in range(len(row)))
        return "".join(f"<{kind}{mark}>{cell}</{kind}>" for mark, cell in zip(marks, row, strict=True))

    body = "\n".join(f"<tr>{cells(row, 'td')}</tr>" for row in rows)
    top = f"<thead><tr>{cells(head, 'th')}</tr></thead>" if any(head) else ""
    look = ' class="wide"' if wide else ""
    return f'<div class="scroll"><table{look}>{top}<tbody>\n{body}\n</tbody></table></div>'


def figure(picture: Picture, words: str, caption: str = "", name: str = "") -> str:
    """A picture on paper, as wide as it is drawn; `words` say it to those who do not see it."""
    own = f' id="{name}"' if name else ""
    room = f"max-width:{round(1.4 * picture.width)}px;min-width:{round(min(0.75 * picture.width, 560))}px"
    image = f'<img src="{picture.source}" {picture.size} alt="{escape(words)}">'
    below = f"<figcaption>{caption}</figcaption>" if caption else ""
    plot = f'<div class="plot"{own} style="{room}">{image}</div>'
    return f'<figure><div class="paper">{plot}</div>{below}</figure>'


def code(text: str) -> str:
    """Lines as they are."""
    return f"<pre><code>{escape(text)}</code></pre>"


def data(name: str, content: Any) -> str:
    """Values for the scripts of a page; nothing in them can end their element."""
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    for sign in "<>&":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return f'<script type="application/json" id="{name}">{text}</script>'


def whole(title: str, body: str, script: bool = False) -> str:
    """A page that needs no other file."""
    style, act = (
        files("swtstudy.reports").joinpath(f"page.{end}").read_text("utf-8") for end in ("css", "js")
    )
    own = f"<script>\n{act}</script>\n" if script else ""
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<link rel="icon" href="{_ICON}">
<style>
{style}</style>
</head>
<body>
{body}
{own}</body>
</html>
"""
