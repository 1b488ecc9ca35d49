"""The compiled kernel: values in closed form, recorded values, and the same values without a compiler."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from folders import ROOT
from oracles.hertz import s_at_the_edge

import swtstudy
from swtstudy.kernel.batch import solve_batch
from swtstudy.kernel.chebyshev import FINEST
from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.contact import CYCLE
from swtstudy.kernel.history import HISTORY
from swtstudy.kernel.parts import may_be_refined

pytestmark = pytest.mark.xdist_group("kernel")
TABLE_1 = {
    "poisson_ratio": [0.3],
    "friction": [0.3],
    "normal_amplitude": [0.75],
    "tangential_amplitude": [5 / 6],
}


def solve_one(name: str = "paraboloid", **given: object) -> np.void:
    """One point; what is not given is as in Table 1, with loads in phase and of one frequency."""
    arguments: dict[str, object] = TABLE_1 | {"frequency_ratio": [1], "phase": [0.0]}
    return solve_batch(name, **(arguments | given))[0]  # type: ignore[arg-type]


@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_next_to_nothing_slips(rtol: float) -> None:
    nu, mu, U = 0.11823350538566824, 0.0014235323712547415, 1.740968841677401e-05
    found = solve_one(
        poisson_ratio=[nu], friction=[mu], normal_amplitude=[0.0], tangential_amplitude=[U], rtol=rtol
    )
    assert found["s"] == pytest.approx(s_at_the_edge(nu, mu, U), rel=1e-6)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "given"), [("paraboloid", {}), ("rounded_punch", {"flat_radius": [0.3]})])
def test_a_search_ends_where_rounding_alone_is_left(name: str, given: dict[str, list[float]]) -> None:
    """The slip zone is as wide as the rounding of its ends: s, which goes like √U, is within its error."""
    larger, smaller = 1e-8, 1e-13
    found = [
        solve_one(name, shape=given, normal_amplitude=[0.0], tangential_amplitude=[U])
        for U in (larger, smaller)
    ]
    expected = found[0]["s"] * np.sqrt(smaller / larger)
    assert abs(found[1]["s"] - expected) <= found[1]["s_error"]
    assert found[1]["positions"] <= 1000


def test_a_value_of_nothing_is_no_side_that_is_ruled_out() -> None:
    """Under residual compression a piece of the line has its maximum between two places without tension."""
    found = solve_one(
        "power_law",
        shape={"exponent": [2.19796134]},
        poisson_ratio=[0.172504164938],
        friction=[0.0350220880655],
        normal_amplitude=[0.338241602461],
        tangential_amplitude=[0.0724240387401],
        frequency_ratio=[2],
        phase=[3.89787496937],
        bulk_amplitude=[0.0228070735816],
        bulk_mean=[-0.182505484362],
        bulk_phase=[2.21341879387],
        rtol=1e-4,
    )
    assert found["s_error"] <= 1e-4 * found["s"]


def test_the_bulk_stress_alone_may_be_a_little_less_than_the_contact_makes_of_it() -> None:
    """The far field is exact, but a tolerance does not tell it from a higher value beside the contact."""
    given: dict[str, Any] = {
        "shape": {"exponent": [1.0924212]},
        "poisson_ratio": [0.46208893],
        "friction": [0.03470021],
        "normal_amplitude": [0.011865183],
        "tangential_amplitude": [0.0032639349],
        "frequency_ratio": ["1/5"],
        "phase": [4.5561661],
        "bulk_amplitude": [0.95515567],
        "bulk_mean": [1.188604],
        "bulk_phase": [4.9560819],
        "criterion": "findley",
        "normal_sensitivity": [0.49582243],
        "control": (True, False),
    }
    rough, known = (solve_one("power_law_cylinder", **given, rtol=rtol) for rtol in (1e-2, 1e-6))
    assert 0.0 < known["s"] - rough["s"] <= rough["s_error"] <= 1e-2 * rough["s"]


def test_a_peak_of_shear_stress_beside_a_cusp_of_a_polygon_is_found() -> None:
    path = [[-0.703, -0.667], [-0.434, -1.0], [1.0, 0.629], [0.113, 0.423], [0.15, 0.595], [-0.126, 0.02]]
    rough, known = (
        solve_batch(
            "wavy_cylinder",
            [0.279],
            [0.841],
            [0.071],
            [0.816],
            loops=[swtstudy.LoadPath("polygon", np.array(path))],
            shape={"waviness_amplitude": [0.00325], "wavelength": [5.179]},
            bulk_mean=[0.16],
            criterion="findley",
            normal_sensitivity=[0.725],
            rtol=rtol,
        )[0]
        for rtol in (1e-3, 1e-6)
    )
    assert abs(rough["s"] - known["s"]) <= rough["s_error"]


def test_no_part_of_a_cycle_is_cut_without_end() -> None:
    """Next to the begin of the cycle, where times are exact, a part may be short, but not without a limit."""
    history, cycle = new_record(HISTORY), new_record(CYCLE)
    history["intervals"][0] = FINEST
    for end, refined in ((1e-3, True), (1e-12, True), (1e-14, False)):
        history["time"][0] = 0.0, end
        assert may_be_refined(history, cycle, np.int64(0)) == refined


@pytest.mark.parametrize("shift", [0.0, 1e-13, -1e-12, 1e-11, 1e-9])
def test_unloading_that_retraces_growth(shift: float) -> None:
    at = {"frequency_ratio": ["1/2"], "tangential_amplitude": [0.3]}
    found = solve_one(**at, phase=[1.5 * np.pi + shift], rtol=1e-6)
    # The front stays near the edge, by the root of what the phase is off.
    assert found["s"] == pytest.approx(0.02698515, rel=2e-6 + 2.0 * np.sqrt(abs(shift)))


CODE = """
from swtstudy.kernel.batch import solve_batch
found = solve_batch("rounded_punch", [0.3], [0.4], [0.5], [0.3], [1], [2.0], shape={"flat_radius": [0.5]})[0]
print(*(float(found[name]) for name in ("s", "critical_x", "critical_angle")))
"""


#: Scenes whose points take minutes each without a compiler.
LONG = ("phases", "coincident", "ratios", "bulk stress, all")
#: Prints s, s_error, critical_x and critical_angle of recorded points, the same number of every scene.
RECORDED = """
import sys
import swtstudy, truth

count, rtol, *without = sys.argv[1:]
some = [
    point
    for scene, several in truth.points().items()
    for point in several[:: -(-len(several) // int(count))]
    if not scene.startswith(tuple(without))
]
for point in some:
    found = swtstudy.solve(**point.arguments, rtol=float(rtol))
    print(*(repr(float(found[name])) for name in ("s", "s_error", "critical_x", "critical_angle")))
"""


def agree(printed_values: list[str], other_values: list[str]) -> None:
    """The same values to 1e-10 but where rounding decides which of two ways a search goes: to s_error/100."""
    found, known = (np.array(values, float).reshape(-1, 4) for values in (printed_values, other_values))
    same = np.isclose(found, known, rtol=1e-10, atol=0.0, equal_nan=True)[:, [0, 2, 3]].all(axis=1)
    assert np.all(np.abs(found[:, 0] - known[:, 0])[~same] <= 0.01 * known[~same, 1])
    assert same.sum() >= max(20, 0.75 * len(known))


@pytest.mark.slow
def test_without_a_compiler_values_are_the_same() -> None:
    agree(printed(RECORDED, "1", "1e-2", *LONG, NUMBA_DISABLE_JIT="1"), printed(RECORDED, "1", "1e-2", *LONG))


@pytest.mark.slow
def test_no_index_is_out_of_bounds(tmp_path: Path) -> None:
    checked = printed(RECORDED, "12", "1e-4", NUMBA_BOUNDSCHECK="1", NUMBA_CACHE_DIR=str(tmp_path))
    np.testing.assert_allclose(
        np.array(checked, float), np.array(printed(RECORDED, "12", "1e-4"), float), rtol=1e-10
    )


@pytest.mark.slow
def test_compiled_code_of_other_sources_is_not_used(tmp_path: Path) -> None:
    shutil.copytree(ROOT / "swtstudy", tmp_path / "swtstudy")
    environment = {"PYTHONPATH": str(tmp_path), "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    before = printed(CODE, cwd=tmp_path, **environment)
    load = tmp_path / "swtstudy" / "kernel" / "surface.py"
    load.write_text(load.read_text().replace("f[i] = 2.0 * half", "f[i] = 2.1 * half"))
    assert printed(CODE, cwd=tmp_path, **environment)[0] != before[0]


def printed(code: str, *arguments: str, cwd: Path = ROOT / "tests", **environment: str) -> list[str]:
    """What a process of its own prints."""
    run = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(
        run, cwd=cwd, env=os.environ | environment, capture_output=True, text=True, check=True
    )
    return done.stdout.split()
