"""All that swtstudy info says of an archive, word for word, and what a repr says of changed results."""

# ruff: noqa: F401  names in expressions

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import call
from folders import DATA, sections
from kept import Kept
from made_up import having
from real import CONTACT, CRITERIA, STUDY
from stand_in import Points, Solution
from told import sayings

from swtstudy import Study, open_results, run

PLAIN = """title = "Plain"
rtol = 1e-3
quantities = ["dissipation", "stick_left"]
[fixed]
profile = "rounded_punch"
flat_radius = 0.5
[axes]
friction = {start = 0.1, stop = 0.8, num = 8}
phase = {start = 1, stop = 2.6, num = 9}
critical_distance = [0.123456, 0.2]
[figure]
x = "friction"
vertical = "phase"
kind = "contour"
panels = "critical_distance"
y = "s_volume"
"""
SEVERAL = 'title = "Several"\n[axes]\nfriction = [0.1, 0.5]\nphase = {start = 0, stop = 1.4, num = 8}\n'
SAMPLED = """title = "Sampled"
[sample]
design = "latin_hypercube"
size = 4
seed = 3
[sample.ranges]
friction = [0.1, 0.5]
"""
GIVEN = """title = "Given"
[sample.points]
friction = [0.2, 0.1, 0.2]
phase = [2, 0, 1]
profile = ["rounded_punch", "paraboloid", "paraboloid"]
flat_radius = [1, 0, 0]
"""
LIMITS = CRITERIA.replace("[fixed]", "findley_limit = [200, 300]\n[fixed]", 1)
SCATTER = """load = "start-up"
[sample]
design = "sobol"
size = 8
target_life = 2e5
[sample.ranges]
strength = { distribution = "normal", mean = 927, deviation = 30 }
"""
START = "[loads.start-up]\nabsolute = true\nvertices = [[150, -50, 10], [180, 60, -30], [150, 20, 5]]\n"
RECORDED = CONTACT.replace("yield_strength = 350", "yield_strength = [350, 300]") + SCATTER + START
RUNNING = "[loads.running]\nabsolute = true\nvertices = [[200, -60, 0], [210, 60, 0]]\n"
BLOCKS = '[[blocks]]\nload = "start-up"\nrounds = 10\n[[blocks]]\nload = "running"\nrounds = 1e3\n'


def unlike(points: Points, rtol: float) -> Solution:
    """Like `stand_in.smooth`, with errors that grow and a regime for each friction."""
    found = stand_in.smooth(points, rtol)
    place = np.round(10 * points.friction).astype(int) - 1
    regime = np.array([0, 1, 1, 2, 3, 4, 5, 0])[place]
    s = np.where(regime == 4, np.inf, np.where(regime == 5, np.nan, found.s))
    return found._replace(s=s, s_error=rtol * s * (1.0 + place), regime=regime.astype(np.int8))


def lines(text: str) -> str:
    """A text without versions and times, and without what is said of validity."""
    text = re.sub(r"\(python .*\)", "(versions)", text)
    text = re.sub(r"\d{4}-\d\d-\d\dT[\d:+]+", "now", text)
    text = re.sub(r"solver version \d+, \d\.\d s", "solver version 1, 0.0 s", text)
    return re.sub(r"  (validity|Outside of the model) .*\n", "", text)


ONE = """normal_force = 200
tangential_force_amplitude = 60
[axes]
critical_distance = [0.01, 0.02, 0.03, 0.05]
"""
STUDIES: dict[str, tuple[str, Callable]] = {
    "plain": (PLAIN, partial(stand_in.fail_at, 0.5)),
    "several": (SEVERAL, partial(stand_in.fail_at, 0.5)),
    "unlike": (SEVERAL.replace("[0.1, 0.5]", "{start = 0.1, stop = 0.8, num = 8}"), unlike),
    "sampled": (SAMPLED, stand_in.smooth),
    "given": (GIVEN, stand_in.smooth),
    "units": (STUDY, stand_in.smooth),
    "limits": (LIMITS, stand_in.smooth),
    "distances": (CONTACT.replace("yield_strength = 350\n", "") + ONE, stand_in.smooth),
    "recorded": (RECORDED, stand_in.smooth),
    "blocks": (CONTACT + START + RUNNING + BLOCKS, stand_in.smooth),
}
#: What swtstudy info says of each.
SAID = sections("info.txt")


@pytest.mark.parametrize("name", STUDIES)
def test_info_says_all_that_is_known_of_a_study(kept: Kept, tmp_path: Path, name: str) -> None:
    text, solver = STUDIES[name]
    stand_in.computed(text, tmp_path / "mine.nc", solver)
    kept.text(DATA / "info.txt", SAID[name], lines(call("info", tmp_path / "mine.nc").output))


def lacking(*names: str) -> Callable:
    """A change: without some attributes or variables."""

    def change(dataset: xr.Dataset) -> xr.Dataset:
        kept = {name: value for name, value in dataset.attrs.items() if name not in names}
        there = [name for name in names if name in dataset.variables]
        return dataset.drop_vars(there).drop_attrs(deep=False).assign_attrs(kept)

    return change


#: Results, a change of them, and what is new in the words about them, or a label that is gone.
CHANGES = sayings(r"""
several, lacking("versions")(several) » made by        swtstudy 0.1.0
several, lacking("source")(several) » no made by
several, lacking("title")(several) » Results
several, lacking("rtol")(several)
» no asked for
» no accurate
several, lacking("runs", "status", "critical_x")(several)
» no complete
» no run 0
» s = 1.585 (friction = 0.1, phase = 1.4 rad) to 1.991 (friction = 0.5, phase = 0).
several, having("status", 2, friction=0)(several)
» complete       2 computed, 2 missing
» regimes        2 partial_slip
several, having("s", 0.0)(several)
» s = 0 at all 4 points at x/a_H = 1.
» Outside of the model: s is not the largest value at all 4 points.
» accurate       s is 0 or unknown at all points
several, having("s", np.nan)(several)
» s is finite at no point.
» accurate       s is 0 or unknown at all points
several, having("s_error", 2e-4, phase=0)(several)
» accurate       relative error of s estimated up to 0.00013, median 0.0001
» 2 of 4 points above rtol
several, having("s_error", 3e-4)(several)
» accurate       relative error of s estimated up to 0.00019, median 0.00017
» 4 of 4 points above rtol
several, having("critical_x", np.nan)(several)
» s = 1.585 (friction = 0.1, phase = 1.4 rad) to 1.991 (friction = 0.5, phase = 0).
several, several.stack(place=("friction", "phase"))
» axis           place: 4 points of friction, phase
» sampled        friction: 0.1, 0.5
» sampled        phase: 0, 1.4 rad
several, several.isel(friction=0, phase=0)
» no axis
» s = 1.591 at x/a_H = 1.
» fixed          friction: 0.1
» fixed          phase: 0
» complete       1 computed
» accurate       relative error of s estimated 0.0001, not above rtol
» regimes        1 partial_slip
» run 0          1 point, rtol 0.0001, solver version 1, 0.0 s of computing, started now
several, several.assign_attrs(history="first\nsecond")
» history        first
» history        second
units, lacking("counted", "counted_number")(units)
» lives          uncounted: in load cycles, as if each had one strain cycle
units, having("counted", np.nan, phase=0)(units) » uncounted in 4
units, having("counted_number", 0.0, phase=0, counted_cycle=1)(units)
» lives          in load cycles, of counted strain cycles: several in 4 of 8 points
units, having("cycles", np.nan)(units)
» N = unknown load cycles (worst point), 170000 to 68000 (mean over 0.05 mm).
units, having("cycles", np.inf)(units) » N = ∞ load cycles (worst point), 170000 to 68000 (mean over 0.05 mm).
units, having("cycles", np.inf, phase=0)(units)
» N = ∞ to 150 load cycles (worst point), 170000 to 68000 (mean over 0.05 mm).
units, having("cycles", np.nan, phase=0)(units)
units, lacking("cycles")(units) » x = 0.568 mm).
units, lacking("figure")(units) » no figure
units, lacking("cycles_volume")(units) » N = 240 to 150 load cycles (worst point).
recorded, having("failure_probability", 0.0)(recorded)
» probability of a crack before 200000 load cycles, at the worst point: 0 in all draws.
recorded, having("failure_probability", 0.25)(recorded)
» probability of a crack before 200000 load cycles, at the worst point: up to 0.25.
recorded, lacking("failure_probability", "cycles_10")(recorded) » N = 230 load cycles (worst point).
recorded, lacking("definitions")(recorded)
» no load
» fixed          normal_force_amplitude: 1 N
» fixed          frequency_ratio: 1
» fixed          tangential_force_amplitude: 1 N
» fixed          phase: 0
» fixed          bulk_stress_amplitude: 1 MPa
recorded, recorded.assign_coords(bulk_stress_mean=5.0)
» load           start-up: F_N 150 to 180 N, F_x −50 to 60 N, σ_B −25 to 15 MPa
» fixed          bulk_stress_mean: 5
distances, distances.isel(critical_distance=slice(1, 4))
» N = 150 load cycles (worst point), 3800 (mean over 0.02 mm), 4000 (mean over 0.03 mm), 4500 (mean over 0.05
    mm).
» distances      0.02, 0.03, 0.05 mm
distances, distances.isel(critical_distance=0)
» N = 150 load cycles (worst point), 3600 (mean over 0.01 mm).
» distances      0.01 mm
distances, lacking("SWT")(distances) » s = 1.99 at x = 0.568 mm
distances, distances.isel(critical_distance=slice(0, 2))
» N = 150 load cycles (worst point), 3600 (mean over 0.01 mm), 3800 (mean over 0.02 mm).
» distances      0.01, 0.02 mm
blocks, having("repetitions", np.nan)(blocks)
» sequence of blocks: 10 of start-up, 1000 of running: no crack.
» sequence       10 of start-up, 1000 of running: no crack
blocks, lacking("repetitions")(blocks)
» no sequence
» N = 230 to 150 load cycles (worst point).
""")


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[str, xr.Dataset]:
    studies = {"several": (SEVERAL.replace("num = 8", "num = 2"), stand_in.smooth)}
    studies |= {name: STUDIES[name] for name in ("units", "distances", "recorded", "blocks")}
    return {
        name: stand_in.computed(text, tmp_path_factory.mktemp(name) / "mine.nc", solver)
        for name, (text, solver) in studies.items()
    }


def parts(dataset: xr.Dataset) -> list[str]:
    """What the repr of results says, in parts."""
    return re.split(r"\n +|; ", lines(repr(dataset.swt)))


def labels(said: list[str]) -> list[str]:
    return list(dict.fromkeys(part.partition("  ")[0] for part in said if "  " in part))


@pytest.mark.parametrize(("change", "new"), CHANGES)
def test_changed_results_say_what_they_are_now(
    results: dict[str, xr.Dataset], change: str, new: list[str]
) -> None:
    before, after = map(parts, eval(change, globals() | results))
    gone = [f"no {label}" for label in labels(before) if label not in labels(after)]
    assert gone + [part for part in after if part not in before] == new


@pytest.mark.filterwarnings("always:.*has no effect")
def test_what_is_told_of_a_study_is_kept(tmp_path: Path) -> None:
    """In its archive, and so in what `info` says."""
    text = 'title = "t"\naxes.phase = [0, 1]\n[fixed]\nnormal_amplitude = 0\n'
    line = "s: axes.phase has no effect: what it is of does not oscillate"
    with pytest.warns(UserWarning, match=line):
        study = Study.from_text(text, "s")
    assert study.told == (line,)
    run(study, tmp_path / "a.nc", solver=stand_in.smooth)
    assert f"  told           {line}\n" in call("info", tmp_path / "a.nc").output
    assert open_results(tmp_path / "a.nc").isel(phase=[0]).attrs["told"] == line
    quiet = run(Study.from_text(text.replace("= 0\n", "= 0.5\n")), tmp_path / "b.nc", solver=stand_in.smooth)
    assert "told" not in quiet.attrs
