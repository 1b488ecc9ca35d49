"""Cost of a loop against the number of its vertices: processor time of s at rtol 1e-4, on one core.

A cycle in k samples without noise, with 2 % of it, and with a bulk stress besides; forces on a paraboloid.
Run from the project's folder: ``OMP_NUM_THREADS=1 python studies/checks/vertices.py``; writes
results/vertices.png and results/vertices.md.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import COLOURS, MARKERS, save_figure, styled
from swtstudy.figures.words import tick_in_ratios

COUNTS = (50, 100, 200, 400, 800, 1400, 2000)
#: Noise over the amplitude, and whether there is a bulk stress.
KINDS = {"smooth": (0.0, False), "2 % noise": (0.02, False), "noise, bulk stress": (0.02, True)}


def loop(count: int, noise: float, bulk: bool) -> swtstudy.LoadPath:
    """A cycle in samples."""
    t = 2.0 * np.pi * np.arange(count) / count
    columns = [0.18 * np.sin(t + 1.0), 0.6 * np.sin(t), 0.18 * np.sin(t)]
    values = np.stack(columns[: 3 if bulk else 2], axis=1)
    random = np.random.default_rng(5).normal(size=values.shape)
    return swtstudy.LoadPath("cycle", values + 0.6 * noise * random)


def seconds(count: int, noise: float, bulk: bool) -> float:
    """Processor time of its s."""
    parameters = {"normal_force_amplitude": 1.0, "tangential_force_amplitude": 1.0, "friction": 0.5}
    parameters |= {"bulk_stress_amplitude": 0.1} if bulk else {}
    given = loop(count, noise, bulk)
    begin = time.process_time()
    swtstudy.solve(load=given, **parameters)
    return time.process_time() - begin


def chart(counts: list[int], found: dict[str, list[float]]) -> Figure:
    """Seconds over the number of vertices, and what k log k would be."""
    with styled(width="column"):
        sheet = Sheet(1, 1, "column")
        figure = sheet.figure()
        axes = sheet.panels(figure)[0, 0]
        for color, marker, (words, times) in zip(COLOURS, MARKERS[1:], found.items(), strict=False):
            axes.loglog(counts, times, color=color, linestyle="-", marker=marker, label=words)
        k = np.array(counts, dtype=float)
        law = k * np.log(k)
        last = next(reversed(found.values()))[-1]
        axes.loglog(k, last * law / law[-1], "k:", marker="", label=r"like $k\,\log k$")
        tick_in_ratios(axes.xaxis, k[0], k[-1])
        times = [each for row in found.values() for each in row]
        tick_in_ratios(axes.yaxis, min(times), max(times))
        axes.set(xlabel="vertices $k$", ylabel="processor time (s)")
        axes.legend(frameon=False)
    return figure


def main() -> None:
    """Measure, draw, write."""
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the files")
    arguments.add_argument("--quick", action="store_true", help="few vertices, to see that it runs")
    given = arguments.parse_args()
    given.results.mkdir(parents=True, exist_ok=True)
    swtstudy.solve(load=loop(8, 0.0, False))  # imports and tables
    counts = list(COUNTS[: 2 if given.quick else None])
    found = {words: [seconds(count, *kind) for count in counts] for words, kind in KINDS.items()}
    save_figure(chart(counts, found), given.results / "vertices.png")
    rows = [
        f"| {k} | {' | '.join(f'{times[i]:.2f}' for times in found.values())} |" for i, k in enumerate(counts)
    ]
    head = [f"| vertices | {' | '.join(found)} |", f"|---|{'---|' * len(found)}"]
    lines = ["Seconds of one core, for s at rtol 1e-4.", "", *head, *rows, ""]
    (given.results / "vertices.md").write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    main()
