"""One archive as a page: what is shown, and in which words; ``page.html`` is its form."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from jinja2.utils import htmlsafe_json_dumps
from markupsafe import Markup, escape
from matplotlib.figure import Figure

from swtstudy.archive import describe
from swtstudy.faces import findings, html
from swtstudy.faces.contacts import contact_of
from swtstudy.figures.draw import draw, layout_of
from swtstudy.figures.point import inspect
from swtstudy.figures.sheet import PANEL
from swtstudy.figures.statistics import draw_sensitivity
from swtstudy.figures.style import picture
from swtstudy.figures.words import is_life
from swtstudy.paper.statements import about_archive
from swtstudy.points.grid import SAMPLE
from swtstudy.points.values import index_at
from swtstudy.results.evaluate import quantity, quantity_error
from swtstudy.study.figure import FigureLayout
from swtstudy.study.shipped import shipped_studies
from swtstudy.study.units.reading import read_contact
from swtstudy.study.units.results import measures
from swtstudy.study.writing import defined_in
from swtstudy.vocabulary.choices import CRITERIA, FIGURES
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import COMPUTED, CONTACT, has_units
from swtstudy.vocabulary.wording import number_words

#: Larger drawings are pictures of pixels, bytes; so many in an inch.
_LARGEST_DRAWING, _DPI, _DPI_SMALL = 400_000, 150, 96
#: Coordinates in a drawing; their digits behind the point, in 1/72 inch; what is for who reads its source.
_COORDINATES, _LONG = re.compile(rb' (?:d|x|y|x1|x2|y1|y2|points)="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
_SOURCE = re.compile(rb"\s*<!--.*?-->|\s*\n\s*", re.DOTALL)
#: Most rows of a table of extrema, and values of an axis that are listed one by one.
_ROWS, _LISTED = 12, 8


class Picture(NamedTuple):
    """A picture as HTML needs it: a data URI, and its size in CSS pixels."""

    source: str
    width: int
    height: int


def embedded(figure: Figure, dpi: float = _DPI, drawing: bool = True) -> Picture:
    """A figure as a drawing, or as pixels where that is smaller or asked for."""
    width, height = (round(96.0 * inches) for inches in figure.get_size_inches())
    kind, content = "svg+xml", b""
    if drawing:
        whole = _SOURCE.sub(b" ", picture(figure, "svg"))
        content = _COORDINATES.sub(lambda found: _LONG.sub(rb"\1", found[0]), whole)
    if not drawing or len(content) > _LARGEST_DRAWING:
        kind, content = "webp", picture(figure, "webp", dpi=dpi, pil_kwargs={"lossless": True})
    return Picture(f"data:image/{kind};base64,{base64.b64encode(content).decode()}", width, height)


def thumbnail(dataset: xr.Dataset) -> Picture:
    """A small picture of the study's figure: its first quantity where it is largest, without words around."""
    layout = layout_of(dataset)
    if layout.panels:
        worst = findings.extreme_places(dataset).get("worst", {})
        dataset = dataset.isel({layout.panels: worst.get(layout.panels, 0)})
    figure = draw(dataset, replace(layout, panels=None, y=layout.y[:1], title=None))
    for legend in figure.legends:
        legend.remove()
    if layout.kind != "scatter":
        figure.set_size_inches(*PANEL)
    return embedded(figure, _DPI_SMALL, drawing=False)


def page(dataset: xr.Dataset, name: str, home: str = "") -> str:
    """A page about the results in an archive, which needs no other file.

    Parameters
    ----------
    dataset
        Results, as from `swtstudy.open_results`.
    name
        Name of the archive without its ending.
    home
        Address of a page that lists this one among others; none without it.

    Returns
    -------
    str
        HTML. It shows everything without JavaScript but values under the pointer and slices.
    """
    indices = findings.indices_of(dataset)
    rows = html.table_of(dataset)
    known = html.about(dataset, rows) | {"panels": [], "derived": {}, "start": {"y": "s"}}
    shown = _study_figure(dataset, known) if "figure" in dataset.attrs else None
    shipped, ends = shipped_studies().get(name), findings.extreme_points(dataset)
    text = str(dataset.attrs.get("study", ""))
    return html.rendered(
        "page.html",
        ds=dataset,
        name=name,
        home=home,
        title=dataset.attrs["title"],
        sentences=findings.sentences(dataset, indices),
        tiles=tiles(dataset, ends),
        contact=read_contact(dataset.attrs[CONTACT]) if has_units(dataset) else None,
        figure=shown,
        source=html.packed(rows),
        size=rows.shape,
        extremes=[*_extremes(dataset)],
        indices=_indices(dataset, indices),
        points=points_of(dataset, ends),
        settings=_settings(dataset),
        paper=[each for each in about_archive(name, dataset) if each.holds is not None],
        own=name if shipped and shipped.read_text("utf-8") == text else f"{name}.toml",
        about=htmlsafe_json_dumps(known, separators=(",", ":"), ensure_ascii=False),
    )


def _study_figure(dataset: xr.Dataset, known: dict[str, Any]) -> dict[str, Any]:
    """The figure of a study with its words; what scripts must know of it goes to ``known``."""
    layout = layout_of(dataset)
    figure = draw(dataset, layout)
    shown = embedded(figure)
    known["panels"] = [*_panels(figure, dataset, layout)]
    known["derived"] = derived(dataset, layout, html.rows_of(dataset))
    fixed = findings.extreme_places(dataset).get("worst", {})
    known["start"] = {"x": layout.x, "y": layout.y[0], "hue": layout.hue, "fixed": fixed}
    words = f"{', '.join(layout.y)} {FIGURES[layout.kind].over or f'over {layout.x}'}"
    live = bool(known["panels"])
    return {"picture": shown, "words": words, "caption": caption_of(dataset, layout), "live": live}


def _panels(figure: Figure, dataset: xr.Dataset, layout: FigureLayout) -> Iterator[dict[str, Any]]:
    """The panels as scripts need them; the kinds of a sample's figures have none.

    A panel is where it is, as shares of the picture from its upper left corner; the ends of its axes; and the
    columns of the table that it shows.
    """
    lines = FIGURES[layout.kind].of == "lines"
    count = dataset.sizes[layout.panels] if layout.panels else 1
    known = FIGURES[layout.kind].of != "sample"
    for index, axes in enumerate(figure.axes[: count * len(layout.y)] if known else ()):
        row, column = divmod(index, count)
        box = axes.get_position()
        yield {
            "box": [round(v, 5) for v in (box.x0, 1.0 - box.y1, box.width, box.height)],
            "ends": [float(end) for end in (*axes.get_xlim(), *axes.get_ylim())],
            "log": [axes.get_xscale() == "log", axes.get_yscale() == "log"],
            "x": layout.x,
            "y": layout.y[row] if lines else layout.vertical,
            "value": layout.y[row],
            "upright": layout.kind == "life",
            "lines": lines,
            "cells": layout.kind == "heatmap",
            "hue": layout.hue if lines else None,
            "fixed": {layout.panels: column} if layout.panels else {},
        }


def derived(dataset: xr.Dataset, layout: FigureLayout, dims: list[str]) -> dict[str, Any]:
    """Quantities of a figure that are no columns of the table, over its rows, with their errors."""
    found: dict[str, Any] = {}
    for y in (y for y in layout.y if y not in dataset.data_vars):
        for name, values in ((y, quantity(dataset, y)), (f"{y}_error", quantity_error(dataset, y))):
            if values is not None:
                flat = values.transpose(*dims).values.ravel()
                found[name] = [float(f"{v:.6g}") if np.isfinite(v) else None for v in flat.tolist()]
    return found


def caption_of(dataset: xr.Dataset, layout: FigureLayout) -> Markup:
    """Caption of a figure: its quantities and parameters in symbols."""
    words = Markup(", ").join(y if "/" in y else html.symbol_of(dataset[y]) for y in layout.y)
    mark = "a line" if FIGURES[layout.kind].of == "lines" else "a colour"
    role_words = {"x": "over", "vertical": "and", "hue": f"{mark} for each", "panels": "a panel for each"}
    parts = [
        escape(FIGURES[layout.kind].over)
        if each == SAMPLE
        else Markup("{} {}").format(role_words[role], html.symbol_of(dataset[each]))
        for role, each in layout.roles()
        if each in dataset
    ]
    said = Markup("{} {}.").format(words, Markup(", ").join(parts)).replace(", and", " and")
    return said + escape(f" {layout.caption}" if layout.caption else "")


def tiles(dataset: xr.Dataset, ends: dict[str, xr.Dataset]) -> Iterator[tuple[Any, str, Any]]:
    """The numbers that one asks for first: what each is, its value, and a note."""
    values = findings.measured(dataset)
    beside = [dim for dim in values.dims if dim not in dataset.s.dims]
    known = (np.isfinite(values) & (dataset.status == COMPUTED)).any(beside)
    shape, missing = " × ".join(map(str, known.shape)) or "one", int((~known).sum())
    yield "points", f"{known.size:,}".replace(",", " "), f"{shape}, {missing or 'none'} without a value"
    lives, single = [row.life for row in CRITERIA.values()], values.size == 1 and has_units(dataset)
    for end, one in ends.items():
        first = findings.measured(one)
        names = (*measures(one), *(n for n in one if n in lives)) if single else ()
        for value in ({name: one[name] for name in names} | {first.name: first}).values():
            label = Markup("{} {}").format(end, html.symbol_of(value)).strip()
            yield label, html.with_unit(number_words(float(value)), value), _where(dataset, one)
    relative = describe.relative_errors(dataset)
    if relative.size:
        largest, middle = (html.share(float(each)) for each in (relative.max(), np.median(relative)))
        words = f"estimated, half of them below {middle}" if middle != largest else "estimated"
        yield "relative error, at most", largest, words


def _where(dataset: xr.Dataset, one: xr.Dataset) -> Markup:
    """The parameters of a point that differ from point to point."""
    dims = {*dataset.s.dims}
    own = [name for name in map(str, dataset.coords) if name in AXES and {*dataset[name].dims} & dims]
    return Markup(", ").join(
        html.place_html(one[name]) for name in own if dataset[name].size > 1 and not one[name].ndim
    )


def _extremes(dataset: xr.Dataset) -> Iterator[dict[str, Any]]:
    """Tables of the lowest and highest values along every dimension, for each place of the others."""
    symbol = html.symbol_of(findings.measured(dataset))
    for lever in findings.levers(dataset):
        ratio = lever.table.ratio
        others, flat = [str(name) for name in ratio.dims], ratio.values.ravel()
        order = np.argsort(-np.nan_to_num(flat, nan=-1.0, posinf=-0.5), kind="stable")
        known = order[np.isfinite(flat[order])]
        chosen = order if len(order) <= _ROWS else known[[0, len(known) // 2, -1]]
        rows = []
        for place in chosen:
            one = lever.table.isel(index_at(ratio, int(place)))
            cells = [html.along(one[name]) for name in others]
            for end in ("minimum", "maximum"):
                value = html.with_unit(number_words(float(one[end])), findings.measured_at(dataset, one))
                cells += [value, html.along(one[f"at_{end}"].rename(lever.name))]
            rows.append([*cells, number_words(float(one.ratio), 3)])
        yield {
            "symbol": html.symbol_of(dataset[lever.name]),
            "meaning": AXES[lever.name].meaning,
            "of": ratio.size if ratio.size > len(rows) else 0,
            "others": [html.symbol_of(dataset[name]) for name in others],
            "quantity": symbol,
            "rows": rows,
        }


def _indices(dataset: xr.Dataset, indices: xr.Dataset | StudyError | None) -> Any:
    """Sobol indices of a sample whose design has them, or in words why there are none."""
    if not isinstance(indices, xr.Dataset):
        return str(indices or "")
    axes = [str(dim) for dim in indices.total.dims if dim not in ("quantity", "parameter")]
    flat = indices.isel(quantity=0).stack(row=[*axes, "parameter"]).transpose("row", ...)
    rows = []
    for one in (flat.isel(row=k) for k in range(flat.sizes["row"])):
        cells = [html.along(dataset[name].sel({name: one[name].item()})) for name in axes]
        cells += [html.symbol_html(str(one.symbol.item())), AXES[str(one.parameter.item())].meaning]
        for name in ("first_order", "total"):
            value, low, high = (float(one[f"{name}{end}"]) for end in ("", "_low", "_high"))
            cells.append(f"{value:.2f} ({low:.2f} to {high:.2f})".replace("-", "−"))
        rows.append(cells)
    y = str(indices["quantity"].values[0])
    return {
        "quantity": Markup("<i>s</i>") if y == "s" else html.symbol_of(dataset[y]),
        "picture": embedded(draw_sensitivity(indices)),
        "head": [html.symbol_of(dataset[name]) for name in axes],
        "rows": rows,
    }


def points_of(dataset: xr.Dataset, ends: dict[str, xr.Dataset]) -> list[dict[str, Any]]:
    """The best and the worst point with their pictures, as `swtstudy.inspect` draws them."""
    parts = []
    for end, one in ends.items():
        symbol = html.symbol_of(findings.measured(one))
        part: dict[str, Any] = {"end": end, "where": _where(dataset, one), "symbol": symbol}
        try:
            if has_units(one):  # a real contact, in its units
                body = int(one.body) if "body" in one.coords and not one.body.ndim else 1
                figure = contact_of(one).inspect(body)
            else:
                figure = inspect(**findings.parameters_of(one))
            part["picture"] = embedded(figure, _DPI_SMALL, drawing=False)
            part["line"] = Markup("; ").join(_point_line(one))
        except StudyError as error:
            part["problem"] = str(error)
        parts.append(part)
    return parts


def _point_line(one: xr.Dataset) -> Iterator[Any]:
    """The results of one point."""
    s, error = number_words(float(one.s)), number_words(float(one.s_error), 2)
    yield Markup("<i>s</i> = {} ± {}").format(s, error)
    place = "critical_position" if "critical_position" in one else "critical_x"
    lives = [n for n in map(str, one) if is_life(one[n].attrs) or n.startswith("failure_probability")]
    for name in (*measures(one), *lives, place, "critical_angle"):
        if name in one and not one[name].ndim and np.isfinite(one[name].item()):
            yield html.place_html(one[name])
    yield one.regime.attrs["flag_meanings"].split()[int(one.regime)].replace("_", " ")


def _settings(dataset: xr.Dataset) -> Iterator[tuple[xr.DataArray, str, str]]:
    """Every parameter that there is something to say of: coordinate, meaning, and values with their unit."""
    hidden = ("body", "direction", *describe.unsaid(dataset))
    for name in dict.fromkeys([*map(str, dataset.s.dims), *map(str, dataset.coords)]):
        if name in AXES and name not in hidden:
            values = dataset[name]
            known = np.atleast_1d(values.values)
            said = list(dict.fromkeys(html.value_text(name, each, values.attrs) for each in known.tolist()))
            if len(known) > _LISTED and known.dtype.kind in "fiu":
                ends = (html.value_text(name, float(end), values.attrs) for end in (known.min(), known.max()))
                said = [f"{' to '.join(ends)} ({len(np.unique(known))} values)"]
            meaning = AXES[name].meaning
            if name == "load":
                loops = defined_in(dataset.attrs).get("load", {}).items()
                of_name = {html.value_text("load", each): loop for each, loop in loops}
                said = [f"{each}: {_course(of_name.get(each))}" for each in said]
                meaning = meaning.partition(":")[0]
            yield values, meaning, html.with_unit(", ".join(said), values)


def _course(loop: Any) -> str:
    """Words for a loop, or for None, the built-in load."""
    if loop is None:
        return "two oscillations"
    vertices = getattr(loop, "vertices", None)
    measured = "measured " if loop.mean_normal is not None else ""
    return f"a {measured}loop of {'harmonics' if vertices is None else f'{len(vertices)} vertices'}"
