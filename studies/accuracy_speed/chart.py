"""The chart of the table of samples: error of s over processor time per value, a panel for each scene."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from swtstudy.figures.sheet import Sheet, add_legend
from swtstudy.figures.style import styled

#: Errors below this are rounding errors of the reference; they are drawn at this value.
SMALLEST_ERROR = 1e-9
STYLES = {
    "this solver, in batches of 64": ("#0072B2", "o", "-"),
    "this solver, one point alone": ("#56B4E9", "D", "--"),
    "textbook, fixed grids": ("#D55E00", "s", "-"),
    "textbook, aligned instants": ("#E69F00", "X", "--"),
    "FFT half-space (tamaas), same contact": ("#009E73", "^", "-"),
    "plane loop in Python, at the critical point": ("#CC79A7", "v", ":"),
}
SYMBOLS = {
    "δA/δ0": r"\delta_A/\delta_0",
    "ω2/ω1": r"\omega_2/\omega_1",
    "b/a_H": "b/a_H",
    "uA": "u_A",
    "ψ": r"\psi",
}


def chart(table: Path) -> Figure:
    """Draw the samples of every scene and method.

    A marker is a sample: what takes longer is at times less accurate. The line is the lower envelope, the
    least error that was reached by then.

    Parameters
    ----------
    table
        The CSV file of the samples.
    """
    with table.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    with styled(width="page"):
        sheet = Sheet(-(-len(scenes) // 2), 2, "page")
        figure = sheet.figure()
        panels = sheet.panels(figure, share_y="all")
        for axes, letter, scene in zip(panels.flat, "ABCDEF", scenes, strict=False):
            for method in STYLES:
                samples = [row for row in rows if (row["scene"], row["method"]) == (scene, method)]
                if samples:
                    _draw(axes, method, samples)
            axes.axhspan(0.0, 2.0 * SMALLEST_ERROR, color="0.92")
            place = {"transform": axes.get_yaxis_transform(), "ha": "right", "fontsize": "small"}
            axes.text(1.0, 2.2 * SMALLEST_ERROR, "no difference ", color="0.4", **place)
            axes.set_title(f"({letter})  {_in_symbols(scene)}", loc="left")
        for axes in panels.flat[len(scenes) :]:
            axes.set_visible(False)
        for axes in panels.flat[max(len(scenes) - 2, 0) : len(scenes)]:
            axes.set_xlabel("processor time a value, s")
            axes.tick_params(labelbottom=True)
        for axes in panels[:, 0]:
            axes.set_ylabel("relative error of $s$")
        add_legend(figure)
    return figure


def _draw(axes: Axes, method: str, samples: list[dict[str, str]]) -> None:
    colour, marker, line = STYLES[method]
    seconds = np.array([float(row["seconds a value"]) for row in samples])
    errors = np.maximum([float(row["relative error"]) for row in samples], SMALLEST_ERROR)
    order = np.argsort(seconds)
    asked = f"{samples[0]['resolution']} to {samples[-1]['resolution']}"
    envelope = np.minimum.accumulate(errors[order])
    axes.loglog(seconds, errors, marker, color=colour, linestyle="none", alpha=0.6)
    label = f"{method}: {asked}" if len(samples) > 1 else method
    axes.loglog(seconds[order], envelope, line, color=colour, marker="", label=label)
    # The marker of the legend; the line alone would not tell methods apart in grey.
    axes.lines[-1].set(marker=marker, markevery=np.flatnonzero(errors[order] == envelope).tolist())


def _in_symbols(title: str) -> str:
    for plain, symbol in SYMBOLS.items():
        title = title.replace(plain, f"${symbol}$")
    return title
