"""The best normal oscillation for a given tangential one, at each ratio of their frequencies.

Result: at ω2/ω1 = 1/2 the best normal oscillation takes 56 % off s, and the worst, which is as large,
adds 79 %: the phase alone decides. At 1 the best takes off 26 %, and the worst adds 32 %. At 3/2 and 2 none
helps, whatever its phase and amplitude, and the worst adds 99 and 47 %.
Run from the project's folder: ``python studies/best_load.py``; it writes results/best_load.md, and
results/best_load.png: the grid against which the optima are held, with them marked on it.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import swtstudy
from swtstudy.figures.sheet import WIDTHS, new_figure, place_legend
from swtstudy.figures.style import save_figure, styled
from swtstudy.figures.surfaces import draw_contours

#: The paper's tangential amplitude, friction and Poisson's ratio are the defaults.
RATIOS = ("1/2", 1, "3/2", 2)
#: Largest normal amplitude: beyond it the contact is nearly lost once a cycle.
LARGEST = 0.9
#: Amplitudes and phases of the grid, phases in steps of 2.5°.
FINE, COARSE = (37, 145), (3, 5)
#: s over that without a normal oscillation: steps of the map.
LEVELS = np.arange(4, 21) / 10
#: Colours of ratios from 0 to 2, so that both sides of 1 are told apart.
COLOURS = ListedColormap(colormaps["PuOr_r"](0.25 * (LEVELS[:-1] + LEVELS[1:])))
MARKS: dict[str, dict[str, Any]] = {
    "best": {"marker": "*", "markersize": 13, "color": "white", "markeredgecolor": "black", "linestyle": ""},
    "worst": {"marker": "X", "markersize": 9, "color": "black", "markeredgecolor": "white", "linestyle": ""},
}


def fine_grid(ratios: tuple[object, ...], size: tuple[int, int], rtol: float) -> xr.Dataset:
    """s over all normal oscillations; amplitude 0 is none."""
    return swtstudy.solve(
        frequency_ratio=ratios,
        normal_amplitude=np.linspace(0.0, LARGEST, size[0]),
        phase=np.linspace(0.0, 2.0 * np.pi, size[1]),
        rtol=rtol,
    )


def rows(ratio: object, found: xr.Dataset, grid: xr.Dataset) -> list[str]:
    """A row of the table for the best and one for the worst oscillation."""
    s = grid.swt.slice(frequency_ratio=ratio).s
    without = float(s.sel(normal_amplitude=0.0)[0])
    worst = float(found.s.sel(case="worst"))
    lines = []
    for case, of_grid in (("best", float(s.min())), ("worst", float(s.max()))):
        at = found.sel(case=case)
        value, amplitude = float(at.s), float(at.normal_amplitude)
        phase = f"{np.degrees(float(at.phase)):.1f}°" if amplitude > 0.0 else "any"
        changes = " | ".join(
            percent(of / to) for of, to in ((value, without), (value, worst), (of_grid, value))
        )
        place = f"{amplitude:.3f} | {phase} | {value:.5f}"
        lines.append(f"| {ratio} | {case} | {place} | {changes} | {int(at.evaluations)} |")
    return lines


def percent(share: float) -> str:
    """The change that a share is."""
    return f"{round(100.0 * (share - 1.0), 2) + 0.0:+.2f} %"


def page(found: dict[object, xr.Dataset], grid: xr.Dataset) -> str:
    """The table, and what its columns mean."""
    head = "| ω2/ω1 | case | δ_A/δ0 | ψ | s | against none | against the worst | grid | points solved |"
    size = " × ".join(str(grid.sizes[name]) for name in ("normal_amplitude", "phase"))
    body = [line for ratio, each in found.items() for line in rows(ratio, each, grid)]
    return "\n".join(
        [
            "# The best normal oscillation",
            "",
            f"Of amplitudes δ_A/δ0 from 0 to {LARGEST:g} and all phases ψ, for the tangential oscillation of",
            f"the paper's Table 1 (paraboloid), s to a relative accuracy of {grid.attrs['rtol']:g}. Against",
            "none: change of s from that of the tangential oscillation alone. Grid: what the best or the",
            f"worst of a grid of {size} such oscillations has more than the optimum.",
            "",
            head,
            "|---" * 9 + "|",
            *body,
            "",
        ]
    )


def draw(found: dict[object, xr.Dataset], grid: xr.Dataset) -> Figure:
    """The grid, over s without a normal oscillation, with the optima on it."""
    best_of_all = min(found, key=lambda ratio: float(found[ratio].s.min()))
    with styled(width="page"):
        figure = new_figure((WIDTHS["page"], 4.6), "page")
        panels = figure.subplots(2, 2, sharex=True, sharey=True)
        for axes, (ratio, each) in zip(panels.flat, found.items(), strict=False):
            s = grid.swt.slice(frequency_ratio=ratio).s
            over_none = (s / s.sel(normal_amplitude=0.0)).rename("over_none")
            look = {"norm": BoundaryNorm(LEVELS, len(LEVELS) - 1), "cmap": COLOURS}
            filled = draw_contours(axes, over_none.transpose("normal_amplitude", "phase"), look)
            axes.grid(False)
            for covered in [text for text in axes.texts if text.get_text() == "1"]:
                covered.remove()  # by the thick line, which the legend explains
            axes.contour(s.phase, s.normal_amplitude, over_none, [1.0], colors="black", linewidths=1.8)
            for case, mark in MARKS.items():
                at = each.sel(case=case)
                amplitude = float(at.normal_amplitude)
                # Without a normal oscillation there is no phase: the mark is in the middle.
                phase = float(at.phase) if amplitude > 0.0 else np.pi
                axes.plot(phase, amplitude, **mark, label=f"{case} at this ratio", clip_on=False, zorder=5)
            title = rf"$\omega_2/\omega_1$ = {ratio}"
            axes.set_title(f"{title}: best of all" if ratio == best_of_all else title, pad=9)
        for axes in panels[-1]:
            axes.set_xlabel(r"$\psi$ (rad)")
        for axes in panels[:, 0]:
            axes.set_ylabel(r"$\delta_A/\delta_0$")
        figure.colorbar(filled, ax=panels, label="$s$ divided by $s$ without a normal oscillation")
        thick = Line2D([], [], color="black", linewidth=1.8, label="no change")
        handles = [*panels.flat[0].get_lines(), thick]
        place_legend(figure, handles, [str(handle.get_label()) for handle in handles], numpoints=1)
    return figure


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for what it writes")
    arguments.add_argument(
        "--quick", action="store_true", help="one ratio, of amplitude 0, to see that it runs"
    )
    given = arguments.parse_args()
    ratios = RATIOS[1:2] if given.quick else RATIOS
    rtol = 1e-1 if given.quick else 1e-3
    grid = fine_grid(ratios, COARSE if given.quick else FINE, rtol)
    # With an amplitude of 0 all phases are one point.
    over: dict[str, tuple[object, object]] = {"phase": (0, "2*pi")}
    over |= {} if given.quick else {"normal_amplitude": (0.0, LARGEST)}
    amplitude: dict[str, object] = {"normal_amplitude": 0.0} if given.quick else {}
    found = {
        ratio: swtstudy.optimise(over=over, rtol=rtol, frequency_ratio=ratio, **amplitude) for ratio in ratios
    }
    text = page(found, grid)
    print(text)
    (given.results / "best_load.md").write_text(text, encoding="utf-8")
    save_figure(draw(found, grid), given.results / "best_load.png")


if __name__ == "__main__":
    main()
