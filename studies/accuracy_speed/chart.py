"""The chart: error of s over processor time per value, with a panel for each scene."""

from __future__ import annotations

from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from methods import Sample

#: Errors below this are rounding errors of the reference; they are drawn at this value.
SMALLEST_ERROR = 1e-9
STYLES = {
    "this solver, in batches of 64": ("#0072B2", "o", "-"),
    "this solver, one point alone": ("#56B4E9", "o", "--"),
    "textbook, fixed grids": ("#D55E00", "s", "-"),
    "textbook, aligned instants": ("#E69F00", "s", "--"),
    "FFT half-space (tamaas), same contact": ("#009E73", "^", "-"),
    "plane loop in Python, at the critical point": ("#CC79A7", "v", ":"),
}
SYMBOLS = {"δA/δ0": r"\delta_A/\delta_0", "ω2/ω1": r"\omega_2/\omega_1", "b/a_H": "b/a_H", "ψ": r"\psi"}


def chart(curves: dict[str, dict[str, list[Sample]]], references: dict[str, float]) -> Figure:
    """Draw the samples of every scene and method.

    Parameters
    ----------
    curves
        Samples by scene and method.
    references
        s of every scene.
    """
    figure = Figure((9.0, 7.4), layout=ConstrainedLayoutEngine())
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for axes, (title, methods) in zip(panels.flat, curves.items(), strict=True):
        for method, samples in methods.items():
            colour, marker, line = STYLES[method]
            errors = [max(abs(sample.s / references[title] - 1.0), SMALLEST_ERROR) for sample in samples]
            seconds = [sample.seconds for sample in samples]
            axes.loglog(seconds, errors, line, color=colour, marker=marker, markersize=4.5, label=method)
        axes.axhspan(0.0, 2.0 * SMALLEST_ERROR, color="0.92")
        axes.text(
            1.0,
            2.2 * SMALLEST_ERROR,
            "no difference ",
            transform=axes.get_yaxis_transform(),
            ha="right",
            color="0.4",
            fontsize="small",
        )
        axes.set_title(_in_symbols(title), fontsize="medium")
        axes.grid(color="0.9", linewidth=0.6)
    for axes in panels[-1]:
        axes.set_xlabel("processor time a value, s")
    for axes in panels[:, 0]:
        axes.set_ylabel("relative error of s")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _in_symbols(title: str) -> str:
    for plain, symbol in SYMBOLS.items():
        title = title.replace(plain, f"${symbol}$")
    return title
