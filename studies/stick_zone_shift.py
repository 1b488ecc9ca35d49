"""How much s rises where a bulk stress moves the stick zone, over the tangential force and the bulk stress.

Run from the project's folder: python studies/stick_zone_shift.py
It writes stick_zone_shift.md and stick_zone_shift.png into ``--results``.

A cylinder and a sphere under a constant normal load P, with a bulk stress in phase with the tangential load Q
and without a mean. Beyond the grey line the stick zone would leave the contact: there it stays in place.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import save_figure, styled

#: Largest pressure in E* δ0/a_H.
PRESSURE = {"cylinder": 0.5, "paraboloid": 2.0 / np.pi}
NAMES = {"cylinder": "cylinder", "paraboloid": "sphere"}
#: The rise does not depend on friction while s is at the edge in tension.
FRICTION = 0.5
#: e/(a − c) and Q/(μP) of the table.
RATIOS, FORCES = (0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0), (0.2, 0.5, 0.8)
#: Per cent.
LEVELS = (0.5, 1, 2, 5, 10, 20, 30)


def rise(profile: str, force: object, bulk: object) -> xr.DataArray:
    """By how many per cent s rises; NaN where the stick zone stays in place."""
    found = swtstudy.solve(
        profile=profile,
        friction=FRICTION,
        normal_force_amplitude=0.0,
        tangential_force_amplitude=force,
        bulk_stress_amplitude=bulk,
        stick_zone_shift=["moved", "none"],
        rtol=1e-5,
    )
    moved, none = found.sel(stick_zone_shift="moved"), found.sel(stick_zone_shift="none")
    return (100.0 * (moved.s / none.s - 1.0)).where(moved.stick_zone > 0)


def bulk_at(profile: str, force: float, ratio: float) -> float:
    """Bulk stress over E* δ0/a_H that moves the stick zone by so much of the width of the slip zone."""
    given = {"profile": profile, "friction": FRICTION, "normal_force_amplitude": 0.0, "rtol": 1e-2}
    found = swtstudy.solve(**given, tangential_force_amplitude=force, bulk_stress_amplitude=1e-3)
    return 1e-3 * ratio / float(found.bulk_shift_ratio)


def table() -> str:
    """Rows of the rises in per cent."""
    heads = " | ".join(f"{ratio:g}" for ratio in RATIOS)
    lines = [f"| `bulk_shift_ratio` | {heads} |", "|---" * (len(RATIOS) + 1) + "|"]
    for profile, words in NAMES.items():
        for force in FORCES:
            # Rounding of 1 would leave the contact.
            stresses = [(1.0 - 1e-9) * bulk_at(profile, force, ratio) for ratio in RATIOS]
            values = rise(profile, force, stresses).values
            cells = " | ".join(f"{value:.{1 if value < 10.0 else 0}f} %" for value in values)
            lines.append(f"| {words}, Q = {force:g} μP | {cells} |")
    return "\n".join(lines) + "\n"


def draw(count: int) -> Figure:
    """Lines of equal rise over Q/(μP) and σ_B/(μ p0), up to where the stick zone reaches the edge."""
    force, bulk = np.linspace(0.02, 0.98, count), np.linspace(0.01, 2.0, count)
    with styled(width="page"):
        sheet = Sheet(1, len(PRESSURE), "page", least_height=3.4)
        figure = sheet.figure()
        for axes, (profile, pressure) in zip(sheet.panels(figure)[0], PRESSURE.items(), strict=True):
            unit = FRICTION * pressure
            found = rise(profile, force, unit * bulk).transpose("bulk_stress_amplitude", ...)
            lines = axes.contour(force, bulk, found.values, LEVELS, colors="black", linewidths=0.8)
            axes.clabel(lines, fmt="%g %%", fontsize="x-small")
            axes.plot(force, [bulk_at(profile, each, 1.0) / unit for each in force], color="0.5")
            axes.set(xlabel=r"$Q/(\mu P)$", xlim=(0, 1), ylim=(0, 2), title=NAMES[profile])
            axes.set_ylabel(r"$\sigma_B/(\mu p_0)$")
    return figure


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for what it writes")
    arguments.add_argument("--quick", action="store_true", help="few points, to see that it runs")
    given = arguments.parse_args()
    (given.results / "stick_zone_shift.md").write_text(table(), encoding="utf-8")
    save_figure(draw(8 if given.quick else 60), given.results / "stick_zone_shift.png")


if __name__ == "__main__":
    main()
