"""swt(x, z) and swt(x, y) around the critical point of Table 1's parameters, the dot.

Run from the project's folder: python studies/maps/swt_near_critical_point.py
"""

import argparse
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh

import swtstudy
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import save_figure, styled

#: How many times larger the depth is drawn than the distance along the surface.
STRETCH = 20


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="on coarse grids, to see that it runs")
    given = arguments.parse_args()
    fine = 0.1 if given.quick else 1.0
    point = swtstudy.solve()
    x = float(point.critical_x)
    near = x + np.linspace(-0.3, 0.3, 1 + round(120 * fine))
    depth = 0.03 * np.linspace(0.0, 1.0, 1 + round(40 * fine)) ** 2
    across = np.linspace(-0.3, 0.3, 1 + round(60 * fine))
    section = swtstudy.swt_field(x=near, y=0.0, z=depth)
    surface = swtstudy.swt_field(x=near, y=across, z=0.0)

    with styled(width="page"):
        sheet = Sheet(1, 2, "page")
        figure = sheet.figure()
        panels = sheet.panels(figure, share_x="none", share_y="none")[0]
        for axes, dataset, words in zip(
            panels, (section, surface), ("(A)  $y$ = 0", "(B)  $z$ = 0"), strict=True
        ):
            mesh = draw_swt_map(axes, dataset, float(point.s), STRETCH if dataset is section else 1.0)
            dot = {"marker": "o", "markerfacecolor": "white", "markeredgecolor": "black", "clip_on": False}
            axes.plot(x, 0.0, **dot)
            axes.set_title(words, loc="left")
            axes.grid(False)
        figure.colorbar(mesh, ax=panels, label=r"$\mathrm{swt}/\mathrm{SWT}_0$")
    save_figure(figure, given.results / "swt_near_critical_point.png")


def draw_swt_map(axes: Axes, dataset: xr.Dataset, highest: float, stretch: float) -> QuadMesh:
    """Draw swt over a section, depth downwards, on a scale from 0; the upright direction may be stretched."""
    across, along = sorted(map(str, dataset.s_local.dims))
    swt = dataset.s_local.transpose(along, across)
    look = {"cmap": "cividis", "shading": "gouraud", "rasterized": True}
    mesh = axes.pcolormesh(swt[across], swt[along], swt, vmin=0.0, vmax=highest, **look)
    stretched = "" if stretch == 1.0 else f", drawn {stretch:g} times larger"
    axes.set(xlabel=f"${across}/a_H$", ylabel=f"${along}/a_H${stretched}", aspect=stretch)
    if along == "z":
        axes.invert_yaxis()
    return mesh


if __name__ == "__main__":
    main()
