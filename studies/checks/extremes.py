"""By how much the curves of the paper's figures miss their extremes, with how many points.

python studies/checks/extremes.py > results/extremes.txt
"""

from __future__ import annotations

import argparse
import itertools
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
#: What of a point is not told by `swtstudy.solve`.
OTHERS = ("control",)
#: Places of a curve that come so near to its extreme are looked at, in so many points, so often.
NEAR, POINTS, ROUNDS = 0.02, 13, 4
#: Every so many points are left.
THINNED = (1, 2, 4, 8)


def curves(dataset: xr.Dataset, axis: str) -> Iterator[tuple[dict[str, object], Array]]:
    """The parameters of each curve, without its axis, and s along it."""
    dims = [dim for dim in dataset.s.dims if dim != axis]
    for index in itertools.product(*(range(dataset.sizes[dim]) for dim in dims)):
        curve = dataset.isel(dict(zip(dims, index, strict=True)))
        known = {name: value.item() for name, value in curve.coords.items() if not value.ndim}
        yield {name: value for name, value in known.items() if name not in OTHERS}, curve.s.values


def extreme(solve: Callable[[Array], Array], x: Array, s: Array) -> float:
    """The largest of s, looked for between the points beside every high place."""
    inside = np.r_[-np.inf, s, -np.inf]
    tops = (s >= inside[:-2]) & (s >= inside[2:]) & (s >= s.max() - NEAR * abs(s.max()))
    best = float(s.max())
    for top in np.flatnonzero(tops):
        low, high = x[max(top - 1, 0)], x[min(top + 1, len(x) - 1)]
        for _ in range(ROUNDS):
            places = np.linspace(low, high, POINTS)
            values = solve(places)
            best = max(best, float(values.max()))
            at = int(values.argmax())
            low, high = places[max(at - 1, 0)], places[min(at + 1, POINTS - 1)]
    return best


def missed(study: Study, axis: str, thinned: tuple[int, ...]) -> Array:
    """Largest relative distance of any curve's extremes from those of its points, one for each thinning."""
    worst = np.zeros(len(thinned))
    with tempfile.TemporaryDirectory() as folder:
        dataset = run(study, Path(folder) / "curves.nc")
    x = dataset[axis].values
    for fixed, s in curves(dataset, axis):
        for sense in (1.0, -1.0):

            def signed(places: Array, fixed=fixed, sense=sense) -> Array:
                return sense * swtstudy.solve(**fixed, **{axis: places}, rtol=study.rtol).s.values

            best = extreme(signed, x, sense * s)
            found = [(best - (sense * s)[::step].max()) / abs(best) for step in thinned]
            worst = np.maximum(worst, found)
    return worst


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="Figure 3 alone, every eighth point of it")
    arguments.add_argument("studies", nargs="*", default=[*AXES], help="which of them; all unless given")
    given = arguments.parse_args()
    print("Largest relative distance of a curve's extremes from those of its points, over all curves of a")
    print("study: with all points of their axis, and with every second, fourth and eighth of them:\n")
    print("study              axis                points" + "".join(f"   every {step}" for step in THINNED))
    for name in given.studies[: 1 if given.quick else None]:
        axis = AXES[name]
        study = Study.from_toml(Path(__file__).parents[1] / f"{name}.toml")
        points = len(study.grid.axes[axis])
        thinned = THINNED
        if given.quick:
            text = study.text.replace(f"num = {points}", f"num = {(points - 1) // 8 + 1}")
            study, thinned = Study.from_text(text), (1,)
        words = "".join(f"   {each:.1e}" for each in missed(study, axis, thinned))
        print(f"{name:<18} {axis:<20} {len(study.grid.axes[axis]):5}{words}", flush=True)


if __name__ == "__main__":
    main()
