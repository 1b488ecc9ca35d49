"""One load at two phases: s over the phase between the two motions, and the best and the worst course.

Run from the project's folder: python studies/maps/best_and_worst.py
It writes best_and_worst.png into ``--results``, and prints by which factor the phase changes s.
"""

import argparse
from pathlib import Path

import numpy as np

import swtstudy
from swtstudy.figures.sheet import WIDTHS, new_figure
from swtstudy.figures.style import COLOURS, save_figure, styled
from swtstudy.figures.words import tick_in_pi

#: ω2/ω1: the normal motion oscillates twice as fast as the tangential one.
RATIO = "1/2"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the figure")
    arguments.add_argument("--quick", action="store_true", help="few phases, to see that it runs")
    given = arguments.parse_args()
    phase = np.linspace(0.0, 2.0 * np.pi, 19 if given.quick else 721)
    s = swtstudy.solve(frequency_ratio=RATIO, phase=phase).s
    print(f"s from {s.min():.4f} to {s.max():.4f}: a factor of {s.max() / s.min():.3f}")
    ends = {"best": float(s.idxmin()), "worst": float(s.idxmax())}
    with styled(width="page"):
        figure = new_figure((WIDTHS["page"], 2.4), "page")
        over, *planes = figure.subplots(1, 3, width_ratios=(2.0, 1.0, 1.0))
        over.plot(phase, s, color="black", marker="")
        for (word, at), marker, colour, axes in zip(
            ends.items(), ("o", "s"), COLOURS[2:0:-1], planes, strict=True
        ):
            value = float(s.sel(phase=at))
            over.plot([at], [value], marker, markersize=7, color=colour)
            up, side = (9, "left") if word == "worst" else (-13, "right")
            look = {"color": colour, "weight": "bold", "ha": side, "textcoords": "offset points"}
            over.annotate(f"{word}: {value:.3f}", (at, value), (0, up), **look)
            point = swtstudy.inspect_point(frequency_ratio=RATIO, phase=at)
            axes.plot(point.displacement, point.depth, color=colour, linestyle="-", marker="")
            axes.set(title=f"{word} phase", xlabel="tangential motion", xticks=[], yticks=[])
        planes[0].set_ylabel("normal motion")
        over.set(xlabel=r"phase $\psi$ between the two motions", ylabel="$s$ (larger: earlier crack)")
        over.set(xlim=(0.0, 2.0 * np.pi), ylim=(0.0, 1.2 * float(s.max())))
        tick_in_pi(over.xaxis, 0.0, 2.0 * np.pi)
    save_figure(figure, given.results / "best_and_worst.png")


if __name__ == "__main__":
    main()
