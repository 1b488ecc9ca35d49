"""The figure of a study: panels of lines, contours or cells."""

from __future__ import annotations

import itertools
from dataclasses import replace
from pkgutil import resolve_name
from string import ascii_uppercase

import numpy as np
import xarray as xr

from swtstudy.figures.lines import add_scale, draw_lines, hue_scale
from swtstudy.figures.sheet import Figure, Sheet, Width, add_legend, wrap_texts
from swtstudy.figures.style import Style, entitle, styled
from swtstudy.figures.surfaces import draw_maps
from swtstudy.figures.words import flag_words, parts_of, quantity_words, title_words
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside
from swtstudy.results.evaluate import known_regime, quantity, quantity_error, require_points
from swtstudy.solver.load_path import Loop
from swtstudy.study.figure import NO_AXIS, FigureLayout, wrong_axes, wrong_layout
from swtstudy.study.writing import defined_in
from swtstudy.vocabulary.choices import FIGURES
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import require
from swtstudy.vocabulary.wording import axis_words


def draw(
    dataset: xr.Dataset,
    layout: FigureLayout | None = None,
    style: Style | None = None,
    width: Width | None = None,
) -> Figure:
    """Draw a figure of results.

    Parameters
    ----------
    dataset
        Results, as from `open_results`.
    layout
        Axes and their roles; by default the layout stored in the archive.
    style
        A matplotlib style: a name, a file or rcParams. By default the look comes from
        `swtstudy.figures.style`, except for rcParams that the user has changed.
    width
        "column" for the 8.5 cm of a journal's column, "page" for 17.5 cm, with letters of 8 pt; by default
        the figure is for a screen, and grows with its panels.

    Returns
    -------
    matplotlib.figure.Figure
        One row of panels for every quantity, one column for every value of the panels' dimension, in several
        lines where the width ends. It is independent of pyplot.

    Raises
    ------
    ValueError
        With every mistake in the layout; or if there is no such width, no layout, or the results are empty.
    """
    layout = layout or layout_of(dataset)
    require_points(dataset)
    _check(dataset, layout)
    with styled(style, width):
        drawn = resolve_name(f"{__package__}.{FIGURES[layout.kind].drawn_by}")
        figure: Figure = drawn(dataset.compute(), layout, width)
        if layout.title:
            figure.suptitle(layout.title)
        loads = defined_in(dataset.attrs).get("load", {}) if layout.hue == "load" else {}
        loops = {name.replace("_", " "): load for name, load in loads.items() if isinstance(load, Loop)}
        # Loops at constant normal loads, or tangential ones, are lines that tell nothing.
        shaped = any(np.ptp(load.course()[:, :2], axis=0).all() for load in loops.values())
        add_legend(figure, loops if shaped else None)
        wrap_texts(figure)
    return figure


def layout_of(dataset: xr.Dataset) -> FigureLayout:
    """The layout of the figure in the study of these results, without dimensions that were sliced away.

    Raises
    ------
    ValueError
        If the results come from no study, or from one without a figure.
    """
    if "figure" not in dataset.attrs:
        numbers = (SAMPLE, *(name for name, row in AXES.items() if row.kind != "name"))
        known = ", ".join(str(dim) for dim in dataset.dims if dim in numbers)
        allowed = f"a layout of your own, with x one of {known}" if known else NO_AXIS
        raise ValueError(f"these results have no figure of a study; allowed: {allowed}")
    layout = FigureLayout.from_json(dataset.attrs["figure"])
    hue, panels = (None if name not in dataset.dims else name for name in (layout.hue, layout.panels))
    return replace(layout, hue=hue, panels=panels)


def _check(dataset: xr.Dataset, layout: FigureLayout) -> None:
    """Raise a StudyError with every mistake in a layout for these results."""
    found = [Mistake(*each) for each in wrong_layout(layout)]
    for y in layout.y:
        try:
            values = quantity(dataset, y)
        except StudyError as error:
            found += error.mistakes
            continue
        sizes = {str(name): size for name, size in values.sizes.items()}
        strange = [name for name in sizes if name not in (*AXES, SAMPLE)]
        if strange or values.dtype.kind not in "fiub":
            what = f"values over {', '.join(strange)}" if strange else f"values of type {values.dtype}"
            found.append(Mistake("figure.y", f"{y!r} with {what}", "numbers over parameters"))
        found += [Mistake(*each) for each in wrong_axes(layout, sizes, "these results")]
    if layout.regimes and not ("regime" in dataset and flag_words(dataset.regime)):
        found.append(Mistake("figure.regimes", "true", "false for results without regime"))
    if found:
        raise StudyError(dict.fromkeys(found))


def draw_rows(dataset: xr.Dataset, layout: FigureLayout, width: Width | None) -> Figure:
    """A row of panels for each quantity, a column for each value of the panels' dimension."""
    count = dataset.sizes[layout.panels] if layout.panels else 1
    lines, upright = FIGURES[layout.kind].of == "lines", layout.kind == "life"
    scale = hue_scale(dataset[layout.hue]) if layout.hue else None
    sheet = Sheet(len(layout.y), count, width)
    figure = sheet.figure(bool(scale) or not lines)
    shared = {"share_x": "row", "share_y": "all"} if upright else {"share_y": "row" if lines else "all"}
    axes = sheet.panels(figure, **shared)
    for row, y in enumerate(layout.y):
        values = quantity(dataset, y)
        words = quantity_words(values, y)
        shown = _shown(dataset, y, values, layout.validity)
        places, panels = zip(*parts_of(shown, layout.panels), strict=True)
        if lines:
            for one, panel in zip(axes[row], panels, strict=True):
                draw_lines(one, panel, y, layout, scale)
        else:
            draw_maps(figure, axes[row], panels, layout, values.name, words)
        across = axis_words(layout.x, dataset[layout.x].attrs)
        if upright:
            across, words = words, across
        elif not lines:
            words = axis_words(str(layout.vertical), dataset[layout.vertical].attrs)
        beneath = upright or row == len(layout.y) - 1
        for lowest in axes[row, max(count - sheet.across, 0) :] if beneath else ():
            lowest.set_xlabel(across)
        sheet.label_left(axes[row], words)
        for number, one, place in zip(itertools.count(row * count), axes[row], places, strict=False):
            # The letter of a panel, the quantity where that differs between rows, and its place.
            letter = f"({ascii_uppercase[number % 26]})" if axes.size > 1 else ""
            title = title_words(values, y) if len(layout.y) > 1 else ""
            entitle(one, f"{letter}  {',  '.join(filter(None, (title, place)))}".strip())
    if scale and layout.hue:
        add_scale(figure, axes, scale, dataset[layout.hue])
    return figure


def _shown(dataset: xr.Dataset, y: str, values: xr.DataArray, validity: bool) -> xr.Dataset:
    """Collect what is drawn of a quantity: values, errors or percentiles, and marks, where known."""
    # The whole results are meant: a part may lack the place that normalises the quantity.
    shown = {"value": values, "error": quantity_error(dataset, y)}
    if {f"{y}_10", f"{y}_90"} <= {*map(str, dataset.data_vars)}:
        shown |= {"early": dataset[f"{y}_10"], "late": dataset[f"{y}_90"]}
    # A value of a sequence of blocks is of all loads together.
    of_loads = [dim for dim in dataset.s.dims if dim not in values.dims] if "s" in dataset else []
    if "regime" in dataset:
        regime = known_regime(dataset)
        first = regime.isel(dict.fromkeys(of_loads, 0), drop=True)
        shown["regime"] = first.where((regime == first).all(of_loads)).assign_attrs(dataset.regime.attrs)
    if "stick_zone" in dataset and not of_loads:
        shown["zone"] = dataset.stick_zone.broadcast_like(values)
    if validity:
        require(dataset, "s")
        shown["outside"] = outside(dataset, values)
    return xr.Dataset({name: values for name, values in shown.items() if values is not None})
