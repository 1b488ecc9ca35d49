"""The figure of a study: panels of lines, contours or cells."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from swtstudy.figures.lines import draw_lines
from swtstudy.figures.style import Style, styled
from swtstudy.figures.surfaces import colours_of, draw_cells, draw_contours
from swtstudy.figures.words import axis_words, place_words
from swtstudy.results.normalise import normalised
from swtstudy.study.figure import FigureLayout, reference, wrong_roles

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Every panel of every figure is so large, in inches.
_PANEL_WIDTH, _PANEL_HEIGHT, _LEGEND_WIDTH = 4.0, 3.2, 1.5


def draw(dataset: xr.Dataset, layout: FigureLayout | None = None, style: Style | None = None) -> Figure:
    """Draw the figure of an archive.

    Parameters
    ----------
    dataset
        Results, as from `open_results`.
    layout
        What goes where; that of the archive if not given.
    style
        A matplotlib style of one's own: a name, a file or rcParams. Without one the look is that of
        `swtstudy.figures.style`, but for rcParams that are not matplotlib's own any more.

    Returns
    -------
    matplotlib.figure.Figure
        One row of panels for every quantity, one column for every value of the panels' dimension. It is
        independent of pyplot.

    Raises
    ------
    ValueError
        If the archive has no figure, or lacks a dimension of it.
    """
    layout = layout or layout_of(dataset)
    for key, found, allowed in wrong_roles(layout):
        raise ValueError(f"figure{key}: found {found}; allowed: {allowed}")
    roles = dict(layout.roles())
    for role, name in roles.items():
        if name not in dataset.s.dims:
            raise ValueError(f"the figure's {role} is {name}, which is not a dimension of these results")
    spare = [str(name) for name in dataset.s.dims if name not in roles.values()]
    if spare:
        raise ValueError(f"the figure has no place for {', '.join(spare)}: slice these results first")
    with styled(style):
        return _draw_rows(dataset, layout)


def layout_of(dataset: xr.Dataset) -> FigureLayout:
    """The layout of the figure that the study of these results asks for, without dimensions sliced away.

    Raises
    ------
    ValueError
        If the results come from no study, or from one without a figure.
    """
    if "figure" not in dataset.attrs:
        raise ValueError("these results have no figure of a study; allowed: a layout of your own")
    layout = FigureLayout.from_json(dataset.attrs["figure"])
    hue, panels = (None if name not in dataset.dims else name for name in (layout.hue, layout.panels))
    return replace(layout, hue=hue, panels=panels)


def _draw_rows(dataset: xr.Dataset, layout: FigureLayout) -> Figure:
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    from swtstudy.figures.figure import Figure

    columns = _slices(dataset, layout.panels)
    rows = len(layout.y)
    beside = layout.hue is not None or layout.kind != "lines"
    size = (_PANEL_WIDTH * len(columns) + _LEGEND_WIDTH * beside, _PANEL_HEIGHT * rows)
    figure = Figure(size, layout=ConstrainedLayoutEngine(w_pad=0.06, h_pad=0.06, wspace=0.05))
    sharey: Any = "row" if layout.kind == "lines" else "all"
    axes = figure.subplots(rows, len(columns), sharex=True, sharey=sharey, squeeze=False)
    for row, y in enumerate(layout.y):
        if layout.kind == "lines":
            for one, panel in zip(axes[row], columns, strict=True):
                draw_lines(one, panel, layout, y)
        else:
            surfaces = [normalised(panel, y).transpose(layout.vertical, layout.x) for panel in columns]
            norm = colours_of(surfaces, 13 if layout.kind == "contour" else None)
            fill = draw_contours if layout.kind == "contour" else draw_cells
            mappables = [fill(one, s, norm) for one, s in zip(axes[row], surfaces, strict=True)]
            figure.colorbar(mappables[-1], ax=axes[row], label=_quantity_words(y), pad=0.02)
        for column, panel in enumerate(columns):
            number = row * len(columns) + column
            _head_panel(axes[row, column], panel, layout, number, rows * len(columns))
        axes[row, 0].set_ylabel(
            _quantity_words(y) if layout.vertical is None else axis_words(layout.vertical)
        )
    for bottom in axes[-1]:
        bottom.set_xlabel(axis_words(layout.x))
    # What the panels have in common is said once, the lines before the marks.
    handles: dict[str, Any] = {}
    for one in axes.flat:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    labels = sorted(handles, key=lambda label: handles[label].get_linestyle() == "None")
    if labels:
        below = layout.kind != "lines"
        place: Any = "outside lower center" if below else "outside right upper"
        columns_of_legend = len(labels) if below else 1
        figure.legend([handles[label] for label in labels], labels, loc=place, ncols=columns_of_legend)
    if layout.title:
        figure.suptitle(layout.title)
    return figure


def _slices(dataset: xr.Dataset, name: str | None) -> list[xr.Dataset]:
    return [dataset] if name is None else [dataset.isel({name: i}) for i in range(dataset.sizes[name])]


def _head_panel(axes: Axes, panel: xr.Dataset, layout: FigureLayout, index: int, count: int) -> None:
    words = []
    if count > 1:
        words.append(f"({chr(ord('A') + index % 26)})")
    if layout.panels:
        words.append(place_words(layout.panels, panel[layout.panels].item()))
    axes.set_title("  ".join(words), loc="left")


def _quantity_words(y: str) -> str:
    place = reference(y)
    if place is None:
        return r"$s = \mathrm{SWT}/\mathrm{SWT}_0$"
    name, value = place
    return f"$s$ / $s$({place_words(name, value if isinstance(value, str) else float(value))})"
