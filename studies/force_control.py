"""Prescribed forces beside prescribed displacements of the same mean load and the same amplitude ratios.

Result: forces give a lower s, by 3 to 35 %, because equal ratios of forces mean smaller motions
(depth and displacement change less than in proportion), and in most cases a greater influence of the phase.
Run from the project's folder: ``python studies/force_control.py``; it reads studies/force_control.toml and
writes results/force_and_displacement.png.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import xarray as xr

import swtstudy
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, styled
from swtstudy.figures.words import tick_in_pi
from swtstudy.vocabulary.wording import place_words

STUDY = Path(__file__).with_suffix(".toml")
#: The displacement that replaces each force.
PAIRS = {"normal_force_amplitude": "normal_amplitude", "tangential_force_amplitude": "tangential_amplitude"}


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
    with styled(width="page"):
        sheet = Sheet(1, len(ratios), "page", least_height=2.4)
        figure = sheet.figure()
        panels = sheet.panels(figure)[0]
        draw(panels, forces, displacements)
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=3)
    save_figure(figure, given.results / "force_and_displacement.png")


def draw(panels, forces: xr.Dataset, displacements: xr.Dataset) -> None:  # type: ignore[no-untyped-def]
    """s over the phase, a panel for each frequency ratio; numbers are printed."""
    looks = tuple(zip(COLOURS, MARKERS[1:], strict=False))
    for letter, axes, ratio in zip("ABCDEFG", panels, forces.frequency_ratio.values, strict=False):
        amplitudes = forces.tangential_force_amplitude.values
        for (colour, marker), amplitude in zip(looks, amplitudes, strict=False):
            at = {"frequency_ratio": ratio}
            force = forces.s.sel(tangential_force_amplitude=amplitude, **at)
            displacement = displacements.s.sel(tangential_amplitude=amplitude, **at)
            phase = forces.phase.values
            look = {"color": colour, "marker": marker, "markevery": 0.14}
            axes.plot(phase, force, linestyle="-", label=rf"$Q_A/(\mu F_0)$ = {amplitude:g}", **look)
            words = rf"$G^* u_A/(\mu E^* \delta_0)$ = {amplitude:g}"
            axes.plot(phase, displacement, linestyle="--", mfc="white", label=words, **look)
            swings = [float(each.max() / each.min()) for each in (force, displacement)]
            lower = 1.0 - (force.values / displacement.values)
            print(
                f"ω2/ω1 = {ratio:g}, {amplitude:g}: s by forces lower by {100 * lower.min():.0f} to "
                f"{100 * lower.max():.0f} %; largest over least s {swings[0]:.2f}, "
                f"by displacements {swings[1]:.2f}"
            )
        axes.set_title(f"({letter})  {place_words('frequency_ratio', ratio)}")
        axes.set_xlabel(r"$\psi$ (rad)")
        tick_in_pi(axes.xaxis, float(phase.min()), float(phase.max()))
    panels[0].set(ylabel="$s$", ylim=(0, None))


if __name__ == "__main__":
    main()
