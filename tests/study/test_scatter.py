"""Constants that scatter: percentiles of lives and failure probabilities against lives of each draw."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from real import ALUMINIUM, CONTACT
from told import refused, written

import swtstudy
from swtstudy import FatigueConstants, Study

LOADS = "normal_force = 200\nfrequency_ratio = 3\nnormal_amplitude = 5e-4\n"
AXES = "[axes]\ntangential_amplitude = [1e-3, 2e-3, 3e-3]\n"
SAMPLE = '[sample]\ndesign = "sobol"\nsize = 64\ntarget_life = 2e5\n'
RANGE = '[sample.ranges]\nstrength = { distribution = "normal", mean = 927, deviation = 30 }\n'
COVARIANCE = """[sample.covariance]
strength = { strength = 900, ductility = -0.9 }
ductility = { ductility = 1.6e-3 }
strength_exponent = { strength_exponent = 4e-6 }
"""
SOUND = f"{CONTACT}{LOADS}{AXES}{SAMPLE}{RANGE}"


def results(tmp_path: Path, more: str, name: str = "mine") -> xr.Dataset:
    return swtstudy.run(Study.from_text(f"{CONTACT}{LOADS}{AXES}{more}"), tmp_path / f"{name}.nc")


def draws_of(dataset: xr.Dataset) -> list[FatigueConstants]:
    """The constants of each draw."""
    scatter = json.loads(dataset.attrs["contact"])["scatter"]
    own = [dict(zip(scatter["names"], each, strict=True)) for each in zip(*scatter["draws"], strict=True)]
    return [FatigueConstants(**{**vars(ALUMINIUM), **each}) for each in own]


@pytest.mark.quick(1)
@pytest.mark.parametrize("more", [SAMPLE + RANGE, SAMPLE + COVARIANCE])
def test_percentiles_are_those_of_the_lives_of_all_draws(tmp_path: Path, more: str) -> None:
    found = results(tmp_path, more)
    assert found.s.dims == ("tangential_amplitude",)  # no further points
    assert (found.counted_number.sum("counted_cycle") > 1.0).any()  # several cycles in a round
    draws = draws_of(found)
    assert len(draws) == 64
    lives = np.array([each.rounds(found.SWT, found.counted, found.counted_number).values for each in draws])
    for percent in (10, 50, 90):
        ranked = np.sort(lives, axis=0)[int(np.ceil(0.01 * percent * len(draws))) - 1]
        np.testing.assert_allclose(found[f"cycles_{percent}"], ranked, rtol=1e-9)
    np.testing.assert_allclose(found.failure_probability, (lives < 2e5).mean(axis=0))
    assert 0.0 < float(found.failure_probability[1]) < 1.0
    np.testing.assert_allclose(found.cycles_50, found.cycles, rtol=0.05)


def test_sequences_of_blocks_scatter(tmp_path: Path) -> None:
    loads = """[loads.small]
    vertices = [[0, 0.5], [0, -0.5]]
    [loads.large]
    vertices = [[0, 1], [0, -1]]
    [[blocks]]
    load = "small"
    rounds = 1000
    [[blocks]]
    load = "large"
    rounds = 10
    """
    text = f"{CONTACT}normal_force = 200\n{AXES}{loads}{SAMPLE}{RANGE}"
    found = swtstudy.run(Study.from_text(text), tmp_path / "blocks.nc")
    rounds = xr.DataArray([1000.0, 10.0], dims="load")
    each = [1.0 / (rounds / draw.cycles(found.SWT)).sum("load") for draw in draws_of(found)]
    for percent in (10, 50, 90):
        ranked = np.sort([one.values for one in each], axis=0)[int(np.ceil(0.64 * percent)) - 1]
        np.testing.assert_allclose(found[f"repetitions_{percent}"], ranked, rtol=1e-9)
    # In load cycles, of which a repetition has 1010.
    early = np.mean([one.values < 2e5 / 1010.0 for one in each], axis=0)
    np.testing.assert_allclose(found.failure_probability, early)
    assert re.search(r"shortest lives \(repetitions\): N10 = \d", repr(found.swt))


@pytest.mark.slow
def test_draws_have_the_covariance(tmp_path: Path) -> None:
    draws = draws_of(results(tmp_path, SAMPLE.replace("64", "4096") + COVARIANCE))
    columns = np.array([[each.strength, each.ductility, each.strength_exponent] for each in draws])
    wanted = np.array([[900.0, -0.9, 0.0], [-0.9, 1.6e-3, 0.0], [0.0, 0.0, 4e-6]])
    scale = np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))
    np.testing.assert_allclose(np.cov(columns.T) / scale, wanted / scale, atol=0.02)
    np.testing.assert_allclose(columns.mean(axis=0), [927.0, 0.409, -0.113], rtol=1e-3)


def test_another_scatter_solves_nothing_again(tmp_path: Path) -> None:
    first = results(tmp_path, "")
    second = results(tmp_path, SAMPLE + RANGE)
    assert {*second.data_vars} > {*first.data_vars}
    np.testing.assert_array_equal(first.s, second.s)
    assert len(json.loads(second.attrs["runs"])) == 1


@pytest.mark.slow
def test_parameters_may_be_sampled_beside_constants(tmp_path: Path) -> None:
    more = SAMPLE.replace("64", "8") + RANGE + "friction = [0.4, 0.6]\n"
    text = f"{CONTACT}{LOADS}{more}tangential_amplitude = [1e-3, 3e-3]\n".replace("friction = 0.5\n", "")
    found = swtstudy.run(Study.from_text(text), tmp_path / "both.nc")
    assert found.cycles_10.dims == ("sample",)
    assert bool((found.cycles_10 <= found.cycles_90).all())


def test_a_study_is_written_with_its_draws(tmp_path: Path) -> None:
    study = Study.from_text(f"{CONTACT}{LOADS}{AXES}{SAMPLE}{COVARIANCE}")
    assert written(study, tmp_path).grid.scatter == study.grid.scatter  # type: ignore[attr-defined]


@pytest.mark.slow
def test_each_body_has_lives_of_its_own_modulus(tmp_path: Path) -> None:
    text = SOUND.replace("= 73.1e3", "= [73.1e3, 60e3]")
    text = text.replace("[fixed]", "[fixed]\nsimilar = 1")
    found = swtstudy.run(Study.from_text(text), tmp_path / "two.nc")
    one, other = (found.sel(body=body) for body in (1, 2))
    assert not np.allclose(one.cycles, other.cycles, rtol=1e-3)
    np.testing.assert_allclose(one.cycles_50 / other.cycles_50, one.cycles / other.cycles, rtol=1e-4)


@pytest.mark.usefixtures("unwrapped")
def test_percentiles_are_told_and_drawn(tmp_path: Path) -> None:
    figure = '[figure]\nx = "tangential_amplitude"\ny = ["cycles", "failure_probability"]\n'
    found = results(tmp_path, SAMPLE + RANGE + figure)
    told = repr(found.swt)
    assert re.search(r"scatter        64 draws: strength 9\d\d(\.\d)? ± 30", told)
    assert "scatter of the constants, shortest lives: N10 = " in told
    assert "probability of a crack before 200000 load cycles, at the worst point: up to 1." in told
    assert "cycles_10 extrapolated" not in told
    upper, lower = found.swt.figure().axes
    (band,) = upper.collections
    ends = band.get_paths()[0].vertices[:, 1]
    assert float(found.cycles_10.min()) == pytest.approx(ends.min())
    assert float(found.cycles_90.max()) == pytest.approx(ends.max())
    assert (
        lower.get_ylabel().replace("\n", " ")
        == "probability of a crack before 200000 load cycles, at the worst point, $P$"
    )


@pytest.mark.slow
def test_a_probability_is_told_of_the_life_that_is_named(tmp_path: Path) -> None:
    more = f'{SAMPLE}{RANGE}[figure]\nx = "tangential_amplitude"\ny = ["cycles_volume"]\n'
    axes = AXES.replace("2e-3, 3e-3", "3e-3")
    text = f"{CONTACT}critical_distance = 0.05\n{LOADS}{axes}{more}"
    found = swtstudy.run(Study.from_text(text), tmp_path / "mean.nc")
    mean = found.failure_probability_volume
    assert float(mean.max()) < float(found.failure_probability.max())
    words = "probability of a crack before 200000 load cycles, by the mean of SWT over a volume"
    assert float(mean.max()) == 0.0
    assert f"{words}: 0 in all draws." in repr(found.swt)
    # Percentiles, which are as far out, go with their life.
    assert "cycles_volume extrapolated" in repr(found.swt)
    assert not re.search(r"cycles_volume_\d+ extrapolated", repr(found.swt))
    assert mean.attrs["long_name"] == words


TORSION = """shear_strength = 535
shear_strength_exponent = -0.1
shear_ductility = 0.7
shear_ductility_exponent = -0.6
"""
SHEAR = 'criterion = "fatemi_socie"\nnormal_sensitivity = 0.3\n'
SHEAR_RANGES = "[sample.ranges]\nshear_strength = [480, 590]\nshear_ductility = [0.5, 0.9]\n"


def of_shear(more: str, given: str = "") -> str:
    text = f"{CONTACT}{SHEAR}{LOADS}{AXES}{more}"
    return text.replace("[material]", f"[material]\n{given}")


@pytest.mark.slow
def test_constants_in_torsion_scatter(tmp_path: Path) -> None:
    found = swtstudy.run(Study.from_text(of_shear(SAMPLE + SHEAR_RANGES, TORSION)), tmp_path / "torsion.nc")
    scatter = json.loads(found.attrs["contact"])["scatter"]
    modulus = ALUMINIUM.young_modulus / 2.66
    draws = [
        swtstudy.ShearConstants(modulus, s, -0.1, g, -0.6) for s, g in zip(*scatter["draws"], strict=True)
    ]
    lives = np.array([each.rounds(found.FS, found.counted, found.counted_number).values for each in draws])
    ranked = np.sort(lives, axis=0)
    np.testing.assert_allclose(found.FS_cycles_10, ranked[6], rtol=1e-9)
    np.testing.assert_allclose(found.FS_failure_probability, (lives < 2e5).mean(axis=0))
    assert "cycles_10" not in found
    assert "N10 = " in repr(found.swt)


@pytest.mark.slow
def test_estimated_constants_in_torsion_scatter_with_tensile_ones(tmp_path: Path) -> None:
    text = of_shear(SAMPLE + RANGE.replace("30 }", "30 }\nductility = [0.3, 0.5]"))
    text = text.replace("poisson_ratio = 0.33\n", "").replace("[axes]", "[axes]\npoisson_ratio = [0.3, 0.4]")
    found = swtstudy.run(Study.from_text(text), tmp_path / "estimated.nc")
    draws = draws_of(found)
    for nu in (0.3, 0.4):
        own = found.sel(poisson_ratio=nu)
        shear = [swtstudy.ShearConstants.estimated(each, nu) for each in draws]
        lives = [each.rounds(own.FS, own.counted, own.counted_number).values for each in shear]
        np.testing.assert_allclose(own.FS_cycles_50, np.sort(lives, axis=0)[31], rtol=1e-9)


def test_each_point_of_a_sample_has_constants_estimated_by_its_own_poisson_ratio(tmp_path: Path) -> None:
    """Also where the first and the last Poisson ratio are the same."""
    text = f"{CONTACT}{SHEAR}{LOADS}tangential_amplitude = 2e-3\n".replace("poisson_ratio = 0.33\n", "")
    points = "[sample.points]\npoisson_ratio = [0.3, 0.4, 0.3]\n"
    found = swtstudy.run(Study.from_text(text + points), tmp_path / "sample.nc")
    for k, nu in enumerate((0.3, 0.4, 0.3)):
        own, shear = found.isel(sample=k), swtstudy.ShearConstants.estimated(ALUMINIUM, nu)
        lives = shear.rounds(own.FS, own.counted, own.counted_number)
        np.testing.assert_allclose(own.FS_cycles, lives, rtol=1e-9)


@pytest.mark.slow
def test_bodies_of_different_materials_have_ranges_of_their_own(tmp_path: Path) -> None:
    ranges = "[sample.ranges]\nstrength_1 = [900, 950]\nstrength_2 = [1800, 2200]\n"
    text = f"{CONTACT}{LOADS}{AXES}{SAMPLE}{ranges}".replace("strength = 927", "strength = [927, 2000]")
    found = swtstudy.run(Study.from_text(text), tmp_path / "two.nc")
    scatter = json.loads(found.attrs["contact"])["scatter"]
    assert scatter["names"] == ["strength_1", "strength_2"]
    for body, strengths in zip((1, 2), scatter["draws"], strict=True):
        own = found.sel(body=body)
        draws = [FatigueConstants(**{**vars(ALUMINIUM), "strength": each}) for each in strengths]
        lives = [each.rounds(own.SWT, own.counted, own.counted_number).values for each in draws]
        np.testing.assert_allclose(own.cycles_90, np.sort(lives, axis=0)[57], rtol=1e-9)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (of_shear(SAMPLE + RANGE, TORSION), "strength, of which no life by fatemi_socie is made"),
        (of_shear(SAMPLE + SHEAR_RANGES), "shear_strength, a constant without a value; allowed: shear_str"),
    ],
)
def test_constants_that_make_no_life_are_refused(text: str, words: str) -> None:
    refused(words, Study.from_text, text)
