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


def cattaneo_mindlin(nu: float, mu: float, U: float) -> float:
    """s at the edge of a paraboloid under a constant normal load."""
    theta = np.arcsin(np.sqrt(1.0 - U))
    one = (np.pi / 2 - theta) / 2 + np.sin(2 * theta) / 4
    other = (np.pi / 2 - theta) / 8 + np.sin(4 * theta) / 32
    x, y = 2 * mu * (one + nu * other), 2 * nu * mu * (one - other)
    return float((4 / np.pi**2) * ((1 - 2 * nu) / 3 + x) * (x - nu * y) / (1 - nu**2))


@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_next_to_nothing_slips(rtol: float) -> None:
    nu, mu, U = 0.11823350538566824, 0.0014235323712547415, 1.740968841677401e-05
    found = solve_one(
        poisson_ratio=[nu], friction=[mu], normal_amplitude=[0.0], tangential_amplitude=[U], rtol=rtol
    )
    assert found["s"] == pytest.approx(cattaneo_mindlin(nu, mu, U), rel=1e-6)


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


@pytest.mark.parametrize("rtol", [1e-2, 1e-4, 1e-6])
@pytest.mark.parametrize(("nu", "mu", "U"), [(0.3, 0.3, 5 / 6), (0.1, 0.8, 0.3), (0.45, 0.5, 0.6)])
def test_constant_normal_load_is_cattaneo_mindlin(nu: float, mu: float, U: float, rtol: float) -> None:
    s = cattaneo_mindlin(nu, mu, U)
    found = solve_one(
        poisson_ratio=[nu], friction=[mu], normal_amplitude=[0.0], tangential_amplitude=[U], rtol=rtol
    )
    assert abs(found["s"] - s) <= found["s_error"] <= rtol * s
    assert abs(found["critical_x"]) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize(
    ("given", "s"),
    [
        ({}, 0.155137),
        (
            {"friction": [0.5], "normal_amplitude": [0.5], "tangential_amplitude": [0.35], "phase": [1.1]}
            | {"control": (True, True)},
            0.1238493,
        ),
        # Maxima within half a wave of the tangential load, where it turns as the contact grows.
        (
            {"poisson_ratio": [0.303093], "friction": [0.551323], "normal_amplitude": [0.159597]}
            | {"tangential_amplitude": [0.00695342], "phase": [1.38303], "frequency_ratio": ["7/2"]},
            0.016958,
        ),
        (
            {"poisson_ratio": [0.473292027], "friction": [0.786048526], "normal_amplitude": [0.0711952675]}
            | {"tangential_amplitude": [0.00765546352], "phase": [5.34499867], "frequency_ratio": ["7/3"]},
            0.0110759416,
        ),
        (
            {"poisson_ratio": [0.474451158], "friction": [0.562014958], "normal_amplitude": [0.314495667]}
            | {"tangential_amplitude": [0.00179822349], "phase": [0.720519484], "frequency_ratio": [5]},
            0.00124041143,
        ),
        (
            {"poisson_ratio": [0.480959063], "friction": [0.652829181], "normal_amplitude": [0.492215259]}
            | {"tangential_amplitude": [0.0912375257], "phase": [1.98295504], "frequency_ratio": ["7/3"]},
            0.0801615816,
        ),
    ],
    ids=["Table 1", "forces", "7/2", "7/3, small motion", "5", "7/3"],
)
@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_recorded_values(given: dict[str, object], s: float, rtol: float) -> None:
    found = solve_one(**given, rtol=rtol)
    digits = 0.5 * 10.0 ** -len(f"{s}".split(".")[1])
    assert abs(found["s"] - s) <= found["s_error"] + digits + 3e-5 * s


@pytest.mark.parametrize("phase", [0.0, 1.0, np.pi])
@pytest.mark.parametrize("ratio", [1, 2])
def test_a_polygon_on_the_cycle_is_nearly_the_cycle(phase: float, ratio: int) -> None:
    t = 2.0 * np.pi * np.arange(1200) / 1200
    loop = swtstudy.LoadPath("polygon", np.stack([np.sin(t + phase), np.sin(ratio * t)], axis=1))
    polygon = solve_batch("paraboloid", [0.3], [0.3], [0.75], [0.5], loops=[loop])[0]
    cycle = solve_one(tangential_amplitude=[0.5], frequency_ratio=[ratio], phase=[phase])
    assert polygon["s"] == pytest.approx(cycle["s"], rel=2e-4)


@pytest.mark.parametrize("shift", [0.0, 1e-13, -1e-12, 1e-11, 1e-9])
def test_unloading_that_retraces_growth(shift: float) -> None:
    at = {"frequency_ratio": ["1/2"], "tangential_amplitude": [0.3]}
    found = solve_one(**at, phase=[1.5 * np.pi + shift], rtol=1e-6)
    # The front stays near the edge, by the root of what the phase is off.
    assert found["s"] == pytest.approx(0.02698515, rel=2e-6 + 2.0 * np.sqrt(abs(shift)))


def test_a_value_depends_on_its_point_alone() -> None:
    phase = np.linspace(0.0, 6.0, 7)
    many = {key: values * 7 for key, values in TABLE_1.items()}
    together = solve_batch("paraboloid", **many, frequency_ratio=[1] * 7, phase=phase)  # type: ignore[arg-type]
    alone = [solve_one(phase=[each]) for each in phase[::-1]]
    assert np.array(alone[::-1], together.dtype).tobytes() == together.tobytes()


def test_a_tighter_tolerance_is_kept() -> None:
    found = [
        solve_one(phase=[2.3], frequency_ratio=["3/2"], rtol=rtol) for rtol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-7)
    ]
    for each in found[:-1]:
        assert abs(each["s"] - found[-1]["s"]) <= each["s_error"]
    assert np.all(np.diff([each["s_error"] for each in found]) < 0.0)


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
