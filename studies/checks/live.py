"""Time from a slider to the new picture of the live notebook, in processor time of one core.

python studies/checks/live.py > results/live.txt
"""

from __future__ import annotations

import argparse
import time

import numpy as np

from swtstudy.figures.live import SLIDERS, Explorer
from swtstudy.vocabulary.choices import FAMILIES

#: Places of a slider, as fractions of its range.
PLACES = np.linspace(0.1, 0.9, 7)
RATIOS = ["1/2", "1", "4/3", "3"]


def seconds(live: Explorer, name: str, values: np.ndarray) -> np.ndarray:
    """Processor time of the redraw for each value of a control, of which none is the one before."""
    found = []
    for value in values:
        begin = time.process_time()
        live.controls[name].value = value
        found.append(time.process_time() - begin)
    return np.array(found)


def places(name: str, count: int) -> np.ndarray:
    """Values of a slider."""
    low, high, *_ = SLIDERS[name]
    return low + PLACES[:count] * (high - low)


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="few redraws, to see that it runs")
    quick = arguments.parse_args().quick
    count, ratios, profiles = (1, ["1/2"], [*FAMILIES][1:2]) if quick else (len(PLACES), RATIOS, [*FAMILIES])
    live = Explorer()
    # The first pictures of a ratio fill caches.
    seconds(live, "phase", places("phase", 2))
    print("moved                    ω2/ω1  profile                redraw     at most")
    for ratio in ratios:
        live.controls["frequency_ratio"].value = ratio
        for name in ("phase", "normal_amplitude", "tangential_amplitude", "friction"):
            show(name, ratio, "paraboloid", seconds(live, name, places(name, count)))
    live.controls["frequency_ratio"].value = "1"
    for profile in profiles:
        live.controls["profile"].value = profile
        for name in ("phase", *FAMILIES[profile].shape):
            show(name, "1", profile, seconds(live, name, places(name, count)))


def show(name: str, ratio: str, profile: str, found: np.ndarray) -> None:
    """A row of the table."""
    times = f"{1e3 * np.median(found):6.0f} ms  {1e3 * found.max():6.0f} ms"
    print(f"{name:<24} {ratio:<6} {profile:<20} {times}", flush=True)


if __name__ == "__main__":
    main()
