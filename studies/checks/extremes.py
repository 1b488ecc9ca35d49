"""By how much the curves of the paper's figures miss their extremes, and where values would mend it.

python studies/checks/extremes.py > results/extremes.txt
python studies/checks/extremes.py --places figure3
"""

from __future__ import annotations

import argparse
import itertools
import re
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray

import swtstudy
from swtstudy import Study, run

Array = NDArray[np.float64]

#: The axis of the curves of each study whose extremes `swtstudy check` measures.
AXES = {
    "figure3": "phase",
    "figure4": "phase",
    "figure5": "phase",
    "figure6": "flat_radius",
    "figure7": "waviness_amplitude",
    "figure8": "waviness_amplitude",
    "other_frequencies": "phase",
}
#: Arguments of a point that `swtstudy.solve` does not have.
OTHERS = ("control",)
#: Extremes are looked for on curves of so many times the steps.
FINER = 4
#: Places of a curve that come so near to its extreme are looked at, in so many points, so often.
NEAR, POINTS, ROUNDS = 0.005, 13, 3
#: Extremes that are missed by more ask for a value of their own, of so many digits.
ENOUGH, DIGITS = 5e-4, 5


def curves(dataset: xr.Dataset, axis: str) -> Iterator[tuple[dict[str, object], Array]]:
    """The parameters of each curve, without its axis, and s along it."""
    dims = [dim for dim in dataset.s.dims if dim != axis]
    for index in itertools.product(*(range(dataset.sizes[dim]) for dim in dims)):
        curve = dataset.isel(dict(zip(dims, index, strict=True)))
        known = {name: value.item() for name, value in curve.coords.items() if not value.ndim}
        yield {name: value for name, value in known.items() if name not in OTHERS}, curve.s.values


def extreme(solve: Callable[[Array], Array], x: Array, s: Array) -> tuple[float, float]:
    """Place and value of the largest of s, looked for between the points beside every high place."""
    inside = np.r_[-np.inf, s, -np.inf]
    tops = (s >= inside[:-2]) & (s >= inside[2:]) & (s >= s.max() - NEAR * abs(s.max()))
    best = float(x[s.argmax()]), float(s.max())
    for top in np.flatnonzero(tops):
        low, high = x[max(top - 1, 0)], x[min(top + 1, len(x) - 1)]
        for _ in range(ROUNDS):
            places = np.linspace(low, high, POINTS)
            values = solve(places)
            at = int(values.argmax())
            best = max(best, (float(places[at]), float(values[at])), key=lambda found: found[1])
            low, high = places[max(at - 1, 0)], places[min(at + 1, POINTS - 1)]
    return best


def finer(study: Study, times: int) -> Study:
    """The study with so many times the steps."""
    return Study.from_text(
        re.sub(r"num = (\d+)", lambda num: f"num = {(int(num[1]) - 1) * times + 1}", study.text)
    )


def without_also(study: Study) -> Study:
    """The study with nothing but equal steps."""
    return Study.from_text(re.sub(r", also = \[[^]]*\]", "", study.text))


def missed(study: Study, axis: str, times: int) -> Iterator[tuple[float, float, float]]:
    """Place of each extreme of each curve, and the shares by which all points, or equal steps, miss it."""
    with tempfile.TemporaryDirectory() as folder:
        dataset = run(finer(study, times), Path(folder) / "curves.nc")
    x = dataset[axis].values
    drawn, equal = (np.isin(x, each.grid.axes[axis]) for each in (study, without_also(study)))
    for fixed, s in curves(dataset, axis):
        for sense in (1.0, -1.0):

            def signed(places: Array, fixed=fixed, sense=sense) -> Array:
                return sense * swtstudy.solve(**fixed, **{axis: places}, rtol=study.rtol).s.values

            place, best = extreme(signed, x, sense * s)
            misses = ((best - (sense * s)[points].max()) / abs(best) for points in (drawn, equal))
            yield place, *misses


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="Figure 3 alone, with twice its steps")
    arguments.add_argument("--places", action="store_true", help="print where extremes are missed instead")
    arguments.add_argument("studies", nargs="*", default=[*AXES], help="which of them; all unless given")
    given = arguments.parse_args()
    if not given.places:
        print(
            "Largest relative distance of a curve's extremes from those of its points, over all curves of a"
        )
        print("study: with all points of their axis, and with those of equal steps (or ratios) alone:\n")
        print("study              axis                points    missed    steps    missed")
    for name in given.studies[: 1 if given.quick else None]:
        axis = AXES[name]
        study = Study.from_toml(Path(__file__).parents[1] / f"{name}.toml")
        found = [*missed(study, axis, 2 if given.quick else FINER)]
        if given.places:
            needed = {f"{place:.{DIGITS}g}" for place, with_all, _ in found if with_all > ENOUGH}
            print(f"{name}: {', '.join(sorted(needed, key=float))}", flush=True)
            continue
        counts = (len(each.grid.axes[axis]) for each in (study, without_also(study)))
        worst = (max(each) for each in list(zip(*found, strict=True))[1:])
        words = "".join(f"{count:9}   {miss:.1e}" for count, miss in zip(counts, worst, strict=True))
        print(f"{name:<18} {axis:<17}{words}", flush=True)


if __name__ == "__main__":
    main()
