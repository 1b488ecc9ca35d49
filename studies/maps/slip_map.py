"""Stick and slip over position and time for three phases at Table 1's other parameters.

Run from the project's folder: python studies/maps/slip_map.py
"""

import argparse
from pathlib import Path

import numpy as np

import swtstudy
from swtstudy.figures.point import draw_slip_map
from swtstudy.figures.sheet import Sheet, place_legend
from swtstudy.figures.style import save_figure, styled


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="on coarse grids, to see that it runs")
    given = arguments.parse_args()
    fine = 0.1 if given.quick else 1.0
    position = np.linspace(0.0, 1.4, 1 + round(280 * fine))
    time = np.linspace(0.0, 2.0 * np.pi, 1 + round(360 * fine))
    with styled(width="page"):
        sheet = Sheet(1, 3, "page")
        figure = sheet.figure()
        panels = sheet.panels(figure)[0]
        for axes, letter, phase in zip(panels, "ABC", (0.0, 0.5, 2.0), strict=True):
            handles = draw_slip_map(axes, swtstudy.slip_map(position, time=time, phase=phase))
            axes.label_outer()
            axes.set_title(rf"({letter})  $\psi$ = {phase:g}", loc="left")
        place_legend(figure, handles, [str(handle.get_label()) for handle in handles])
    save_figure(figure, given.results / "slip_map.png")


if __name__ == "__main__":
    main()
