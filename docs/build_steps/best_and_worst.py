"""The picture of the first screen: one load, whose best and whose worst phase are far apart."""

from pathlib import Path

import numpy as np

from swtstudy import inspect_point, open_results
from swtstudy.figures.sheet import new_figure
from swtstudy.figures.style import COLOURS, save_figure, styled
from swtstudy.figures.words import tick_in_pi
from swtstudy.reports.findings import Lever, levers
from swtstudy.reports.values import value_text


def lever(root: Path) -> Lever:
    """The phase of Figure 4, at the frequency ratio and amplitude at which it does most."""
    return levers(open_results(root / "results" / "figure4.nc"))[0]


def draw_best_and_worst(root: Path, path: Path) -> None:
    """s over the phase, and the two courses of the load."""
    found = lever(root)
    places = {name: found.there[name].item() for name in ("normal_amplitude", "frequency_ratio")}
    curve = open_results(root / "results" / "figure4.nc").swt.slice(**places).s
    ends = {"best": found.there.at_minimum.item(), "worst": found.there.at_maximum.item()}
    with styled():
        figure = new_figure((9.0, 3.2))
        over, *planes = figure.subplots(1, 3, width_ratios=(2.0, 1.0, 1.0))
        over.plot(curve.phase, curve, color=COLOURS[0])
        for (word, phase), colour, axes in zip(ends.items(), COLOURS[2:0:-1], planes, strict=True):
            s = float(curve.sel(phase=phase))
            over.plot([phase], [s], "o", markersize=9, color=colour)
            label = f"{word}: {s:.3f} at {value_text('phase', phase)}"
            up = 14 if word == "worst" else -20
            side = "right" if phase > np.pi else "left"
            look = {"color": colour, "weight": "bold", "ha": side}
            over.annotate(label, (phase, s), (0, up), textcoords="offset points", **look)
            point = inspect_point(**places, phase=phase)
            axes.plot(point.displacement, point.depth, color=colour, linestyle="-", marker="")
            axes.set(
                title=f"the {word} phase",
                xlabel="tangential motion",
                ylabel="normal motion",
                xticks=[],
                yticks=[],
            )
        over.set(xlabel=r"phase $\psi$ between the two motions", ylabel="$s$, the larger the sooner a crack")
        over.set_ylim(0.0, 1.2 * float(curve.max()))
        over.set_xlim(0.0, 2.0 * np.pi)
        tick_in_pi(over.xaxis, 0.0, 2.0 * np.pi)
    save_figure(figure, path)
