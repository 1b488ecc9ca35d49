"""Prescribed forces beside prescribed displacements of the same mean load and the same amplitude ratios.

What comes out: forces give a lower s, by 3 to 35 %, because equal ratios of forces mean smaller motions
(depth and displacement change less than in proportion), and in most cases a greater influence of the phase.
Run from the project's folder: ``python studies/force_control.py``; it reads studies/force_control.toml and
writes results/force_and_displacement.png.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

import swtstudy

STUDY = Path(__file__).with_suffix(".toml")
#: The displacement in the place of each force.
PAIRS = {
    "normal_force_amplitude": "normal_amplitude",
    "tangential_force_amplitude": "tangential_amplitude",
}
COLOURS = ("#0072B2", "#D55E00", "#009E73")


def both(phases: int | None) -> tuple[xr.Dataset, xr.Dataset]:
    """The study under forces and under displacements; at some of its phases, or at all of them."""
    grid = swtstudy.Study.from_toml(STUDY).grid
    given: dict[str, object] = {**grid.fixed, **{name: list(values) for name, values in grid.axes.items()}}
    if phases is not None:
        given["phase"] = list(grid.axes["phase"][:: len(grid.axes["phase"]) // phases])
    forces = swtstudy.solve(**given)  # type: ignore[arg-type]
    other = {PAIRS.get(name, name): value for name, value in given.items()}
    return forces, swtstudy.solve(**other)  # type: ignore[arg-type]


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="few phases, to see that it runs")
    given = arguments.parse_args()
    forces, displacements = both(4 if given.quick else None)
    ratios = forces.frequency_ratio.values
    figure = Figure((10.0, 3.8), layout=ConstrainedLayoutEngine())
    panels = figure.subplots(1, len(ratios), sharey=True)
    for axes, ratio in zip(panels, ratios, strict=True):
        for colour, amplitude in zip(COLOURS, forces.tangential_force_amplitude.values, strict=True):
            at = {"frequency_ratio": ratio}
            force = forces.s.sel(tangential_force_amplitude=amplitude, **at)
            displacement = displacements.s.sel(tangential_amplitude=amplitude, **at)
            degrees = np.degrees(forces.phase.values)
            axes.plot(degrees, force, color=colour, label=f"{amplitude:g}, forces")
            axes.plot(degrees, displacement, "--", color=colour, label=f"{amplitude:g}, displacements")
            swings = [float(each.max() / each.min()) for each in (force, displacement)]
            lower = 1.0 - (force.values / displacement.values)
            print(
                f"ω2/ω1 = {ratio:g}, {amplitude:g}: s by forces lower by {100 * lower.min():.0f} to "
                f"{100 * lower.max():.0f} %; largest over least s {swings[0]:.2f}, "
                f"by displacements {swings[1]:.2f}"
            )
        axes.set(
            title=rf"$\omega_2/\omega_1$ = {ratio:g}", xlabel=r"$\psi$ in degrees", xticks=range(0, 361, 90)
        )
        axes.grid(color="0.9", linewidth=0.6)
    panels[0].set(ylabel="s", ylim=(0, None))
    words = r"$Q_A/(\mu F_0)$ or $G^* u_A/(\mu E^* \delta_0)$;  $F_A/F_0$ or $\delta_A/\delta_0$ = 0.4"
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(
        handles, labels, title=words, loc="outside lower center", ncols=3, frameon=False, fontsize=8
    )
    figure.savefig(given.results / "force_and_displacement.png", dpi=150)


if __name__ == "__main__":
    main()
