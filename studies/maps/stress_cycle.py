"""The stress over one cycle at the critical point of Table 1's parameters, and a tenth of a_H beneath it.

Run from the project's folder: python studies/maps/stress_cycle.py
"""

import argparse
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes

import swtstudy
from swtstudy.figures.point import draw_time_axis
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import COLOURS, DASHES, save_figure, stroke, styled


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="on coarse grids, to see that it runs")
    given = arguments.parse_args()
    x = float(swtstudy.solve().critical_x)
    time = np.linspace(0.0, 2.0 * np.pi, 73 if given.quick else 721)
    with styled(width="page"):
        sheet = Sheet(1, 2, "page")
        figure = sheet.figure()
        for axes, letter, z in zip(sheet.panels(figure)[0], "AB", (0.0, 0.1), strict=True):
            draw_stress_cycle(axes, swtstudy.stress_field(x, 0.0, z, time=time))
            axes.label_outer()
            axes.set_title(f"({letter})  $x/a_H$ = ${x:.3f}$, $z/a_H$ = {z:g}", loc="left")
    save_figure(figure, given.results / "stress_cycle.png")


def draw_stress_cycle(axes: Axes, dataset: xr.Dataset) -> None:
    """Draw the stress components that are not 0, but for rounding, over one cycle at one point."""
    names = [str(name) for name in dataset.data_vars if str(name).startswith("sigma_")]
    largest = {name: float(abs(dataset[name]).max()) for name in names}
    shown = [name for name in names if largest[name] > 1e-9 * max(largest.values())]
    for index, name in enumerate(shown):
        look = stroke(COLOURS[index], DASHES[index % len(DASHES)], label=f"${dataset[name].attrs['symbol']}$")
        axes.plot(dataset.time, dataset[name], **look)
    draw_time_axis(axes, dataset.time)
    axes.set_ylabel(r"$\sigma\,a_H/(E^* \delta_0)$")
    axes.legend(frameon=False)


if __name__ == "__main__":
    main()
