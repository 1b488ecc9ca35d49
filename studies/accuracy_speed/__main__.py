"""Accuracy against speed: ``OMP_NUM_THREADS=1 python studies/accuracy_speed``, from the project's folder.

Writes results/accuracy_speed.png, .csv and .md. Needs the extra ``bench``.
"""

from __future__ import annotations

import csv
from pathlib import Path

from chart import chart
from methods import METHODS, until_patience_ends
from scenes import SCENES

RESULTS = Path("results")


def main() -> None:
    curves = {
        scene.title: {name: until_patience_ends(method(scene)) for name, method in METHODS.items()}
        for scene in SCENES
    }
    references = {scene.title: scene.reference() for scene in SCENES}
    RESULTS.mkdir(exist_ok=True)
    chart(curves, references).savefig(RESULTS / "accuracy_speed.png", dpi=150)
    with (RESULTS / "accuracy_speed.csv").open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(["scene", "method", "resolution", "s", "relative error", "seconds a value"])
        for title, methods in curves.items():
            for name, samples in methods.items():
                for resolution, s, seconds in samples:
                    error = abs(s / references[title] - 1.0)
                    table.writerow([title, name, resolution, f"{s:.12f}", f"{error:.1e}", f"{seconds:.2e}"])
    lines = ["| scene | s at rtol 1e-9 | textbook, fine aligned grid | difference |", "|---|---|---|---|"]
    for scene in SCENES:
        s, other = references[scene.title], scene.independent()
        lines.append(f"| {scene.title} | {s:.8f} | {other:.6f} | {other / s - 1.0:+.1e} |")
    text = "Reference values of the chart, and what confirms them.\n\n" + "\n".join(lines) + "\n"
    (RESULTS / "accuracy_speed.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
