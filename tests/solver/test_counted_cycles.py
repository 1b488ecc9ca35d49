"""The strain cycles of a round, and the rounds that a place lives through."""

import shutil

import numpy as np
import pytest
import stand_in
from numpy.testing import assert_allclose
from real import ALUMINIUM, BODIES, STUDY, plain, without
from told import RIG

import swtstudy
from swtstudy import FatigueConstants, LoadPath, Study

pytestmark = pytest.mark.filterwarnings("ignore:.*a load cycle at frequency_ratio")

CONTACT = RIG | {"normal_force": [200.0], "tangential_amplitude": 1.5e-3}


def lives(**given):
    """Rounds of real contacts by counted cycles, and as if each had one."""
    found = swtstudy.physical(**{**CONTACT, **given}).solve(rtol=1e-3, constants=ALUMINIUM)
    found = found.isel(body=0)
    return found.cycles.values.ravel(), ALUMINIUM.cycles(found.SWT).values.ravel()


def test_equal_cycles_do_so_many_times_the_damage_of_one() -> None:
    loads = [LoadPath(f"of {n}", [[0.0, 1.0], [0.0, -1.0]] * n) for n in (1, 2, 5, 10)]
    loads += [LoadPath.harmonic_sum(f"sines {n}", [], [(n, 1.0, 0.0)]) for n in (1, 2, 5, 10)]
    rounds, one = lives(load=loads, normal_amplitude=1e-3)
    assert_allclose(one / rounds, [1.0, 2.0, 5.0, 10.0] * 2, rtol=1e-9)


def test_one_closed_cycle_has_the_life_at_its_swt() -> None:
    rounds, one = lives(tangential_amplitude=[1e-3, 2e-3], walker_exponent=[0.4, 0.5, 0.7])
    assert_allclose(rounds, one, rtol=1e-12)


def test_four_tangential_cycles_in_a_slow_normal_one_do_about_four_times_the_damage() -> None:
    rounds, one = lives(normal_amplitude=6e-10, frequency_ratio=[1, 4, 7])
    assert_allclose(one / rounds, [1.0, 4.0, 7.0], rtol=0.01)


def test_rounds_are_those_of_the_place_with_most_damage() -> None:
    counted = np.array([[1.0, 0.5], [0.9, 0.9]])
    number = np.array([[1.0, 2.0], [1.0, 3.0]])
    swt = float(ALUMINIUM.swt(1e5))
    N = ALUMINIUM.cycles
    first, second = 1.0 / N(swt) + 2.0 / N(0.5 * swt), 4.0 / N(0.9 * swt)
    assert ALUMINIUM.rounds(swt, counted, number) == pytest.approx(1.0 / max(first, second))
    assert ALUMINIUM.rounds(0.0, counted, number) == np.inf
    assert np.isnan(ALUMINIUM.rounds(np.nan, counted, number))
    # Nothing counted is one cycle a round.
    assert ALUMINIUM.rounds(swt, np.nan * counted, np.nan * number) == pytest.approx(1e5)


TWO = (
    plain("phase")
    .replace("2e-3", "2e-4")
    .replace("[axes]", "[axes]\nfrequency_ratio = [1, 3]")
    .replace("[150, 200]", "[200]")
    .replace("[1e-3, 2.5e-3]", "[1e-3]")
)


@pytest.fixture(scope="module")
def two(tmp_path_factory):
    path = tmp_path_factory.mktemp("two") / "a.nc"
    return swtstudy.run(Study.from_text(TWO), path, workers=1), path


@pytest.mark.slow
def test_other_constants_need_no_new_run(two, tmp_path) -> None:
    found = two[0]
    shutil.copy2(two[1], tmp_path)
    other = Study.from_text(TWO.replace("strength = 927", "strength = 700"))
    again = swtstudy.run(other, tmp_path / "a.nc", solver=stand_in.none)
    weaker = FatigueConstants(73.1e3, 700.0, -0.113, 0.409, -0.713)
    for end in ("", "_volume", "_line"):
        expected = weaker.rounds(found[f"SWT{end}"], found.counted, found.counted_number)
        assert_allclose(again[f"cycles{end}"], expected, rtol=1e-12)
        assert again[f"cycles{end}"].dims == found[f"SWT{end}"].dims
        several = (found[f"cycles{end}"] < ALUMINIUM.cycles(found[f"SWT{end}"])).sel(frequency_ratio=3)
        assert several.all()
    assert "rounds of the load" in found.cycles.comment
    table = found.drop_dims("direction").swt.to_table()
    assert len(table) == 2
    assert not {"counted", "counted_number"} & {*table.columns}


@pytest.mark.slow
def test_each_body_counts_with_its_own_constants(tmp_path) -> None:
    text = without(BODIES, "critical_distance", "[figure]", "x =", "hue =", "panels =", "y =")
    text = text.replace('phase = [0, "pi/2"]', "frequency_ratio = [3]")
    found = swtstudy.run(Study.from_text(text), tmp_path / "a.nc")
    first = FatigueConstants(210e3, 927.0, -0.113, 0.409, -0.713)
    second = FatigueConstants(150e3, 927.0, -0.113, 0.2, -0.713)
    for body, constants in ((1, first), (2, second)):
        own = found.sel(body=body)
        expected = constants.rounds(own.SWT, own.counted, own.counted_number)
        assert_allclose(own.cycles, expected, rtol=1e-12)


def test_without_a_material_nothing_is_counted() -> None:
    text = STUDY.replace("[material]", "[unused]")
    start, end = text.index("[unused]"), text.index("[fixed]")
    text = (text[:start] + text[end:]).replace('"cycles", ', "")
    study = Study.from_text(text)
    assert not study.asked.counts
    assert Study.from_text(STUDY).asked.counts
    with pytest.raises(ValueError, match="counted"):
        Study.from_text('title = "t"\nquantities = ["counted"]\n')
    with pytest.raises(ValueError, match="several values at a point"):
        Study.from_text(STUDY.replace('"SWT", "cycles"', '"counted"'))


@pytest.mark.parametrize("size", [1e-12, 1e-13, 1e-14])
def test_next_to_nothing_is_counted_too(size: float) -> None:
    """No plane of the search is then worse than the critical one."""
    load = LoadPath.harmonic_sum("small", [(1, size, 0.0)], [(1, size, 0.3)])
    forces = {"normal_force": 200, "normal_force_amplitude": 1, "tangential_force_amplitude": 1}
    contact = swtstudy.physical(**RIG | {"friction": 0.6}, load=load, **forces)
    assert (contact.solve(rtol=1e-3, constants=ALUMINIUM).cycles > 1e30).all()
