"""How the cost of a value scales, and how long start-up takes.

Processor time per value over the points solved in one call, over 1/rtol, and over q in ω2/ω1 = 1/q and p in
ω2/ω1 = p; the memory of a call; start-up of new processes. Run from the project's folder:
``OMP_NUM_THREADS=1 python studies/scaling.py``; writes results/scaling.png and results/scaling.md.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from swtstudy.figures.sheet import Sheet
from swtstudy.figures.style import save_figure, styled
from swtstudy.solver.points import Points, solve_points

COUNTS = (1, 4, 16, 64, 256, 1024, 4096)
RTOLS = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
TERMS = (1, 2, 4, 8, 16, 32, 64)
REPEATS = 3
#: Number of samples of each sweep in a quick run.
FEW = 3
#: Points in a call, p and q, whose memory is measured.
BATCHES = ((1, 1, 1), (64, 1, 1), (4096, 1, 1), (64, 1, 4), (2, 1, 64), (2, 32, 1))
#: The words of sweeps as formulae.
LABELS = {
    "q, ω2/ω1 = 1/q": r"$q$, with $\omega_2/\omega_1 = 1/q$",
    "p, ω2/ω1 = p": r"$p$, with $\omega_2/\omega_1 = p$",
}
#: A process that imports the same libraries and calls one line that Numba has compiled before.
LIBRARIES = """import xarray, dask.array, numba

@numba.njit("f8(f8)", cache=True)
def next_number(x):
    return x + 1.0

next_number(1.0)
"""
START_UP = {
    "python -c pass": ["-c", "pass"],
    "swtstudy --help": ["-m", "swtstudy", "--help"],
    "import swtstudy": ["-c", "import swtstudy"],
    "xarray, dask and numba, and one compiled line": ["libraries.py"],
    "import swtstudy and the first value": ["-c", "import swtstudy; swtstudy.solve(phase=0.3)"],
}
PEAK = (
    "import sys; from scaling import batch; from swtstudy.solver.points import solve_points;"
    "solve_points(batch(*map(int, sys.argv[1:])));"
    "print(next(line.split()[1] for line in open('/proc/self/status') if line.startswith('VmHWM')))"
)


def batch(count: int, p: int = 1, q: int = 1) -> Points:
    """Points of Table 1 that differ in ψ; the tangential path has the same length for every frequency."""
    one = np.ones(count)
    whole = np.ones(count, dtype=int)
    amplitude = 5 / 6 * min(1.0, q / p) * one
    phase = np.linspace(0.01, 3.1, count)
    return Points("paraboloid", 0.3 * one, 0.3 * one, 0.75 * one, p * whole, q * whole, amplitude, phase, {})


def milliseconds(points: Points, rtol: float) -> float:
    """Median processor time per value, ms; from a single run where that takes long."""
    times: list[float] = []
    while len(times) < REPEATS and sum(times) < 20.0:
        begin = time.process_time()
        solve_points(points, rtol)
        times.append(time.process_time() - begin)
    return 1e3 * float(np.median(times)) / len(points)


def growth(x: Sequence[float], y: Sequence[float]) -> float:
    """Exponent of the power law fitted to the second half of the samples."""
    half = len(x) // 2
    return float(np.polyfit(np.log(x[half:]), np.log(y[half:]), 1)[0])


def start_up(arguments: list[str], repeats: int) -> float:
    """Median wall time of a new process, in seconds; what it compiles it has compiled before."""
    times = []
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "libraries.py").write_text(LIBRARIES, encoding="utf-8")
        for _ in range(repeats + 1):
            begin = time.perf_counter()
            subprocess.run([sys.executable, *arguments], check=True, capture_output=True, cwd=folder)
            times.append(time.perf_counter() - begin)
    return float(np.median(times[1:]))


def peak_memory(*arguments: int) -> float:
    """Largest memory of a process that solves a `batch` in one call, MB."""
    command = [sys.executable, "-c", PEAK, *map(str, arguments)]
    run = subprocess.run(command, check=True, capture_output=True, text=True, cwd=Path(__file__).parent)
    return float(run.stdout) / 1024


def chart(samples: list[tuple[str, Sequence[float], Sequence[float]]]) -> Figure:
    """The cost over each sweep, of which there are words, places and milliseconds."""
    with styled(width="page"):
        sheet = Sheet(1, len(samples), "page")
        figure = sheet.figure()
        panels = sheet.panels(figure, share_x="none")
        for axes, letter, (words, x, y) in zip(panels[0], "ABCD", samples, strict=True):
            axes.loglog(x, y, "o-", color="#0072B2")
            axes.set_xlabel(LABELS.get(words, words))
            axes.set_title(f"({letter})  like the power ${growth(x, y):.2f}$ at the end", loc="left")
        sheet.label_left(panels[0], "ms a value")
    return figure


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the files")
    arguments.add_argument("--quick", action="store_true", help="short and cheap lists, to see that it runs")
    given = arguments.parse_args()
    report(given.results, *((FEW, 1, 4, 1) if given.quick else (None, None, 64, 5)))


def report(results: Path, few: int | None, batches: int | None, some: int, repeats: int) -> None:
    """Measure, and write chart and tables: ``few`` samples of each sweep, ``some`` points in a call."""
    sweeps: dict[str, tuple[str, Sequence[float], Callable[[float], float]]] = {
        "points": ("points in a call", COUNTS, lambda n: milliseconds(batch(int(n)), 1e-4)),
        "rtol": ("1/rtol", [1 / r for r in RTOLS], lambda r: milliseconds(batch(some), 1 / r)),
        "q": (
            "q, ω2/ω1 = 1/q",
            TERMS,
            lambda q: milliseconds(batch(max(some // int(q), 2), 1, int(q)), 1e-4),
        ),
        "p": ("p, ω2/ω1 = p", TERMS, lambda p: milliseconds(batch(max(some // int(p), 2), int(p), 1), 1e-4)),
    }
    lines = ["Processor time a value (paraboloid, Table 1), one thread.", ""]
    samples = []
    for words, all_x, cost in sweeps.values():
        x = all_x[:few]
        y = [cost(value) for value in x]
        samples.append((words, x, y))
        lines += [f"| {words} | " + " | ".join(f"{value:.4g}" for value in x) + " |"]
        lines += ["|---" * (len(x) + 1) + "|"]
        lines += ["| ms a value | " + " | ".join(f"{value:.3g}" for value in y) + " |", ""]
        lines += [
            f"Over the second half of the samples the cost grows like the power {growth(x, y):.2f}.",
            "",
        ]
    lines += ["| points in a call, p, q | peak memory of the process, MB |", "|---|---|"]
    lines += [f"| {n}, {p}, {q} | {peak_memory(n, p, q):.0f} |" for n, p, q in BATCHES[:batches]]
    lines += ["", f"| start-up (median of {repeats} processes) | s |", "|---|---|"]
    lines += [
        f"| {words} | {start_up(arguments, repeats):.2f} |" for words, arguments in [*START_UP.items()][:few]
    ]
    results.mkdir(exist_ok=True)
    save_figure(chart(samples), results / "scaling.png")
    (results / "scaling.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
