"""Which parameters matter: sorted Sobol indices, and binned medians of s, of the study "sensitivity".

Run from the project's folder: python studies/maps/which_parameters.py
It draws the archives sensitivity.nc and sensitivity_indices.nc, and writes which_parameters.png.
"""

import argparse
from pathlib import Path

import numpy as np
import xarray as xr

import swtstudy
from swtstudy.figures.sheet import WIDTHS, add_legend, new_figure
from swtstudy.figures.style import COLOURS, save_figure, styled
from swtstudy.vocabulary.parameters import AXES

ARCHIVES = Path(__file__).parents[2] / "results"
#: Bins of each parameter, equally full, and parameters that have a panel.
BINS, SHOWN = 12, 3


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="few bins, to see that it runs")
    given = arguments.parse_args()
    count = 3 if given.quick else BINS
    sample = swtstudy.open_results(ARCHIVES / "sensitivity.nc")
    indices = xr.load_dataset(ARCHIVES / "sensitivity_indices.nc").isel(quantity=0)
    order = indices.parameter[np.argsort(-indices.total.mean("frequency_ratio").values)].values
    looks = list(zip(sample.frequency_ratio.values, ("1/2", "1"), COLOURS, ("o", "s"), strict=False))
    with styled(width="page"):
        figure = new_figure((WIDTHS["page"], 2.6), "page")
        bars, *panels = figure.subplots(1, 1 + SHOWN, width_ratios=[1.5] + [1.0] * SHOWN)
        for k, (ratio, word, colour, marker) in enumerate(looks):
            own = indices.sel(frequency_ratio=ratio, parameter=order)
            place = np.arange(len(order)) + 0.4 * (k - 0.5)
            ends = [own.total - own.total_low, own.total_high - own.total]
            look = {"color": colour, "alpha": (1.0, 0.6)[k], "error_kw": {"linewidth": 0.8}}
            bars.barh(place, own.total, 0.36, xerr=ends, capsize=1.5, **look)
            for axes, name in zip(panels, order, strict=False):
                x, s = sample[name].values, sample.s.sel(frequency_ratio=ratio).values
                bins = np.array_split(np.argsort(x), count)
                middle = [np.median(x[rows]) for rows in bins]
                low, median, high = np.transpose([np.quantile(s[rows], [0.1, 0.5, 0.9]) for rows in bins])
                label = rf"$\omega_2/\omega_1$ = {word}: median"
                axes.plot(middle, median, color=colour, marker=marker, linestyle="-", label=label)
                axes.fill_between(middle, low, high, color=colour, alpha=0.2, linewidth=0.0)
        symbols = [f"${AXES[name].symbol}$" for name in order]
        bars.set_yticks(range(len(order)), symbols)
        bars.invert_yaxis()
        bars.set(xlabel="total Sobol index of $s$", xlim=(0.0, None))
        for axes, symbol in zip(panels, symbols, strict=False):
            axes.set(xlabel=symbol, ylim=(0.0, 0.32))
        panels[0].set_ylabel("$s$; bands: 10 to 90 %")
        for axes in panels[1:]:
            axes.tick_params(labelleft=False)
        add_legend(figure)
    save_figure(figure, given.results / "which_parameters.png")


if __name__ == "__main__":
    main()
