"""Accuracy against speed: ``OMP_NUM_THREADS=1 python studies/accuracy_speed``, from the project's folder.

Writes results/accuracy_speed.png, .csv and .md; with ``--redraw`` the picture alone, from the table that is
there. Needs the extra ``bench``.
"""

from __future__ import annotations

import argparse
import csv
from itertools import islice
from pathlib import Path

from chart import chart
from methods import METHODS, until_patience_ends
from scenes import COARSE, FINE, SCENES

from swtstudy.figures.style import save_figure


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the files")
    arguments.add_argument(
        "--quick", action="store_true", help="one scene, one sample a curve, to see that it runs"
    )
    arguments.add_argument("--redraw", action="store_true", help="draw the table that is there")
    given = arguments.parse_args()
    table = given.results / "accuracy_speed.csv"
    if not given.redraw:
        measure(given.results, given.quick)
    save_figure(chart(table), table.with_suffix(".png"))


def measure(results: Path, quick: bool) -> None:
    """Write the table of samples, and what confirms the reference values."""
    samples = 1 if quick else None
    scenes = SCENES[:samples]
    curves = {
        scene.title: {
            name: until_patience_ends(islice(method(scene), samples)) for name, method in METHODS.items()
        }
        for scene in scenes
    }
    references = {scene.title: scene.reference() for scene in scenes}
    results.mkdir(exist_ok=True)
    with (results / "accuracy_speed.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["scene", "method", "resolution", "s", "relative error", "seconds a value"])
        for title, methods in curves.items():
            for name, samples in methods.items():
                for resolution, s, seconds in samples:
                    error = abs(s / references[title] - 1.0)
                    writer.writerow([title, name, resolution, f"{s:.12f}", f"{error:.1e}", f"{seconds:.2e}"])
    lines = ["| scene | s at rtol 1e-9 | textbook, fine aligned grid | difference |", "|---|---|---|---|"]
    for scene in scenes:
        s, other = references[scene.title], scene.independent(COARSE if quick else FINE)
        lines.append(f"| {scene.title} | {s:.8f} | {other:.6f} | {other / s - 1.0:+.1e} |")
    text = "Reference values of the chart, and what confirms them.\n\n" + "\n".join(lines) + "\n"
    (results / "accuracy_speed.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
