"""Figures 7 and 8 over a logarithmic axis, and beside it over a linear one, as in the paper.

Run from the project's folder: python studies/maps/waviness.py
It draws the archives of the two studies, and writes waviness.png into ``--results``.
"""

import argparse
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

import swtstudy
from swtstudy.figures.sheet import WIDTHS, new_figure
from swtstudy.figures.style import save_figure, styled

ARCHIVES = Path(__file__).parents[2] / "results"


def draw_row(
    pair: tuple[Axes, Axes], number: int, step: int, lines: str, label: Callable[[float], str], **place: float
) -> None:
    """The lines of an archive over both axes, every so many values, at one place of its other axis."""
    s = swtstudy.open_results(ARCHIVES / f"figure{number}.nc").swt.slice(**place).s
    for axes, scale in zip(pair, ("log", "linear"), strict=True):
        for value in s[lines].values:
            curve = s.sel({lines: value})
            axes.plot(curve.waviness_amplitude[::step], curve[::step], label=label(value))
        axes.set(xscale=scale, xlim=(0.002, 0.05))
        axes.set_xticks([0.002, 0.005, 0.01, 0.02, 0.05] if scale == "log" else np.arange(1, 6) / 100)
        axes.xaxis.set_major_formatter("{x:g}")
        axes.minorticks_off()
    pair[0].set_ylabel("$s$")
    pair[1].legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def wavelength(value: float) -> str:
    """A wavelength of Figure 7."""
    return rf"$\lambda/\sqrt{{hR}}$ = {'√20' if abs(value**2 - 20.0) < 1e-9 else f'{value:g}'}"


def ratio(value: float) -> str:
    """A frequency ratio of Figure 8."""
    return rf"$\omega_2/\omega_1$ = {Fraction(value)}"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="few values, to see that it runs")
    given = arguments.parse_args()
    step = 20 if given.quick else 1
    with styled(width="page"):
        figure = new_figure((WIDTHS["page"], 7.6), "page")
        panels = figure.subplots(4, 2, sharey="row")
        for row, amplitude in enumerate((0.25, 0.75)):
            draw_row(panels[row], 7, step, "wavelength", wavelength, normal_amplitude=amplitude)
            panels[row, 0].set_title(rf"Figure 7, $\delta_A/\delta_0$ = {amplitude:g}")
        for row, (phase, word) in enumerate(((0.0, "0"), (np.pi, "π")), 2):
            draw_row(panels[row], 8, step, "frequency_ratio", ratio, phase=phase)
            panels[row, 0].set_title(rf"Figure 8, $\psi$ = {word}")
        for axes in panels[-1]:
            axes.set_xlabel(r"$h/\delta_0$")
    save_figure(figure, given.results / "waviness.png")


if __name__ == "__main__":
    main()
