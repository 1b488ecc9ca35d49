"""A load cycle is the common period 2πq/ω1 of both oscillations, also where the normal load rests."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from real import ALUMINIUM, CONTACT
from scipy.integrate import trapezoid
from told import RIG

import swtstudy
from swtstudy import Study, run

RATIOS = ["4", "7/5", "1/2", "1"]
#: A normal load that rests, and one that nearly does.
RESTING = [0.0, 1e-12]


def _agree(values: object) -> None:
    """Both values along the first axis, to what the slight motion of the normal load changes."""
    resting, moving = np.asarray(values)
    np.testing.assert_allclose(resting, moving, rtol=1e-4)


@pytest.mark.parametrize("bulk", [0.0, 0.05])
@pytest.mark.parametrize("normal", ["normal_amplitude", "normal_force_amplitude"])
def test_dissipation_is_that_of_the_common_period(normal: str, bulk: float) -> None:
    given = {normal: RESTING, "frequency_ratio": RATIOS, "bulk_stress_amplitude": bulk, "phase": 0.7}
    given["stick_zone_shift"] = "none"  # it moves under a normal load that rests alone
    found = swtstudy.solve(rtol=1e-2, quantities=["dissipation"], **given)
    _agree(found.dissipation.transpose(normal, ...))
    one = found.dissipation.isel({normal: 0}).sel(frequency_ratio=1.0)
    np.testing.assert_allclose(found.dissipation.isel({normal: 0}) / one, [4.0, 7.0, 1.0, 1.0], rtol=1e-12)
    # s does not count cycles, and is solved once.
    assert len(set(found.s.isel({normal: 0}).values.tolist())) == 1


def test_dissipation_is_the_area_of_the_loop_that_inspect_shows() -> None:
    point = swtstudy.inspect_point(frequency_ratio="4", normal_amplitude=0)
    area = trapezoid(point.tangential_force, point.displacement)
    assert float(point.dissipation) == pytest.approx(float(area), rel=2e-3)


@pytest.mark.parametrize(("ratio", "bulk"), [("4", 0.0), pytest.param("7/5", 20.0, marks=pytest.mark.slow)])
def test_lives_count_the_strain_cycles_of_the_common_period(ratio: str, bulk: float) -> None:
    loads = {
        "normal_force": 200.0,
        "tangential_force_amplitude": 60.0,
        "frequency_ratio": ratio,
        "phase": 0.7,
    }
    loads |= {"normal_force_amplitude": np.multiply(RESTING, 200.0), "bulk_stress_mean": bulk}
    contact = swtstudy.physical(**RIG, **loads)
    asked = {"quantities": ["dissipation"], "constants": ALUMINIUM}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # such small forces are doubted
        found = contact.solve(1e-2, **asked)
    for name in ("dissipation", "cycles"):
        _agree(found[name].transpose("normal_force_amplitude", ...))
    counted = found.counted_number.transpose("normal_force_amplitude", ...).isel(counted_place=0)
    _agree(counted.sum("counted_cycle"))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*is it meant as a share of that")
def test_archives_keep_the_common_period(tmp_path: Path) -> None:
    """Values that a second run takes from an archive are those of the first one."""
    text = (
        f'{CONTACT}normal_force = 200\ntangential_force_amplitude = 60\nfrequency_ratio = "7/5"\n'
        "[axes]\nnormal_force_amplitude = [0, 1e-10]\n"
    ).replace("rtol = 1e-3", 'rtol = 1e-3\nquantities = ["dissipation"]')
    path = tmp_path / "archive.nc"
    first = run(Study.from_text(text), path)
    again = run(Study.from_text(text.replace("[0, 1e-10]", "[0, 1e-10, 20]")), path)
    assert again.sizes["normal_force_amplitude"] == 3
    for name in ("dissipation", "cycles"):
        _agree(first[name])
        np.testing.assert_array_equal(again[name][:2], first[name])
