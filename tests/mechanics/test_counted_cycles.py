"""The strain cycles of a round, and the rounds that a place lives through."""

from __future__ import annotations

import itertools
import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose
from real import ALUMINIUM, BODIES, STUDY, plain, without
from scenes import points, random_points, take

import swtstudy
from swtstudy import FatigueConstants, LoadPath, Study
from swtstudy.archive.describe import describe
from swtstudy.archive.netcdf import save
from swtstudy.mechanics.line.counted import FewCycles, few
from swtstudy.mechanics.line.look import Look
from swtstudy.mechanics.planes.rainflow import closed_cycles
from swtstudy.mechanics.solver import scenes, solve_points
from swtstudy.runner.workload import assess
from swtstudy.units.life import UNCOUNTED
from swtstudy.vocabulary.quantities import COUNTED_SIZES

BRITTLE = FatigueConstants(200e3, 900.0, -0.06, 1.0, -0.5)
CONTACT = {
    "young_modulus": 73.1e3,
    "poisson_ratio": 0.33,
    "radius": 50.0,
    "friction": 0.5,
    "normal_force": [200.0],
    "tangential_amplitude": 1.5e-3,
}


def cycles_of(batch, rtol=1e-4):
    """The solution of points and their few cycles."""
    solution = solve_points(batch, rtol)
    share, number = np.full((2, len(batch), *COUNTED_SIZES.values()), np.nan)
    for index, scene in scenes(batch):
        angle = np.radians(2.0 * solution.critical_angle[index])
        found = FewCycles.of(scene, solution.critical_x[index], angle)
        share[index], number[index] = found.share, found.number
    return solution, share, number


def lives(**given):
    """Rounds of real contacts by counted cycles, and as if each had one."""
    found = swtstudy.physical(**{**CONTACT, **given}).solve(rtol=1e-3, constants=ALUMINIUM)
    found = found.isel(body=0)
    return found.cycles.values.ravel(), ALUMINIUM.cycles(found.SWT).ravel()


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


def swing(u, ν=0.33, μ=0.5):
    """σ_xx, and ε_xx times E, at the edge of a sphere by a first displacement u < 1 (theory, section 4)."""
    θ = np.arcsin(np.sqrt(1.0 - u))
    i, j = (np.pi / 2 - θ) / 2 + np.sin(2 * θ) / 4, (np.pi / 2 - θ) / 8 + np.sin(4 * θ) / 32
    x, y = 2 * μ * (i + ν * j), 2 * ν * μ * (i - j)
    return x, x - ν * y


@pytest.mark.parametrize("γ", [0.5, 0.4, 0.8])
def test_a_nested_cycle_is_that_of_the_closed_form_at_the_edge_where_it_is_worse(γ: float) -> None:
    """Under a constant normal load the loop 1, −1, 0.4, −0.4 has a small cycle from 0.4 or from −0.4.

    Both edges have the same swt. At one of them the small cycle begins and ends with the larger stress.
    """
    load = LoadPath("nested", [[0.0, 1.0], [0.0, -1.0], [0.0, 0.6], [0.0, -0.2]])
    given = {"poisson_ratio": 0.33, "friction": 0.5, "normal_amplitude": 0.0, "tangential_amplitude": 0.5}
    contact = swtstudy.solve(load=load, walker_exponent=γ, rtol=1e-6, **given)
    path = 0.5 * np.array([1.0, -1.0, 0.6, -0.2])
    # After a reversal the stress goes twice as far as half of the way would bring it from rest.
    stress = [swing(path[0])[0]]
    for before, after in itertools.pairwise(path):
        stress.append(stress[-1] + np.sign(after - before) * 2.0 * swing(0.5 * abs(after - before))[0])
    strain = np.array([swing(0.5)[1], swing(0.5 * abs(path[3] - path[2]))[1]])
    pressure = (1.0 - 2.0 * 0.33) / 3.0
    edges = []
    for sign in (1.0, -1.0):
        tension = pressure + np.array([swing(0.5)[0], max(sign * stress[2], sign * stress[3])])
        swt = np.maximum(tension, 0.0) ** (2.0 - 2.0 * γ) * strain ** (2.0 * γ)
        edges.append(swt[1] / swt[0])
    batch = points(poisson_ratio=0.33, friction=0.5, normal_amplitude=0.0, tangential_amplitude=0.5)
    batch = replace(batch, path=load, walker_exponent=np.array([γ]))
    solution, share, number = cycles_of(batch)
    assert_allclose(solution.s, contact.s, rtol=1e-4)
    best = np.nanmax(share[0, :, 1])
    assert edges[0] > 1.1 * edges[1]
    assert_allclose(best, edges[0], rtol=2e-3)
    assert (number[0][np.isfinite(number[0])] == 1.0).all()


def dense_swt(scene, swt, planes=45):
    """swt of the cycles, over a largest one, at many places on both sides and planes, shape (h, k)."""
    top = float(scene.largest_radius[0])
    r = top * np.sqrt(np.linspace(0.05, 1.2, 100))
    edges = scene.coordinate.radius(np.maximum(scene.cycle.load.normal(scene.cycle.begin), 0.0))[0]
    r = np.concatenate([r, edges * 0.9999, edges, edges * 1.0001])
    look = Look.at(scene, np.maximum(r, 0.01)[None], 8, 5.0)
    found = []
    for side in (1.0, -1.0):
        history = scene.planes(look.history, side)
        for angle in 2.0 * np.pi * np.arange(planes) / planes:
            stress, strain = (v[0] for v in history.on_plane(np.full((1, r.size), angle)))
            cycles = closed_cycles(strain, stress)
            own = scene.criterion.value(cycles.tension, cycles.amplitude) / swt
            found.append(own[own.max(axis=1) > 0.4])
    most = max(own.shape[1] for own in found)
    return np.concatenate([np.pad(own, ((0, 0), (0, most - own.shape[1]))) for own in found])


@pytest.mark.slow
def test_no_place_and_plane_has_much_more_damage() -> None:
    """Over planes and places, for constants of two materials at short and long lives."""
    batch = take(random_points(5, 40), [3, 22, 25, 30])
    batch = replace(batch, walker_exponent=np.array([0.7, 0.5, 0.7, 0.5]))
    solution, share, number = cycles_of(batch)
    more = []
    for index, scene in scenes(batch):
        split = scene.split_at_breakpoints()
        for row, i in enumerate(index):
            swt = dense_swt(split.take(np.array([row])), solution.s[i])
            for material in (ALUMINIUM, BRITTLE):
                for life in (1e3, 1e5, 1e7):
                    top = float(material.swt(life))
                    own = 1.0 / material.rounds(top, share[i], number[i])
                    at_home = 1.0 / material.rounds(top, share[i, :1], number[i, :1])
                    # Its damage: each cycle's own life, the small ones left out.
                    damage = np.zeros(len(swt))
                    large = swt > 1e-3
                    np.add.at(damage, np.nonzero(large)[0], 1.0 / material.cycles(top * swt[large]))
                    assert damage.max() < 1.06 * own
                    more.append(own / at_home)
    # The critical place and plane of the largest swt alone would not do.
    assert max(more) > 1.2


def test_a_place_with_the_largest_sum_of_swt_is_among_them() -> None:
    """That sum is the damage at the shortest lives; the critical place has less of it."""
    batch = take(random_points(5, 30), [7])
    solution, share, number = cycles_of(batch, 1e-2)
    ((_, scene),) = scenes(batch)
    upright = dense_swt(scene.split_at_breakpoints(), solution.s[0], planes=1).sum(axis=1).max()
    found = np.nansum(share * number, axis=2)[0]
    assert upright > 1.05 * found[0]
    assert found.max() > 0.99 * upright


@pytest.mark.parametrize("seed", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_the_damage_is_never_less_than_that_of_one_cycle(seed: int) -> None:
    _, share, number = cycles_of(random_points(seed, 5), 1e-3)
    known = np.isfinite(share[:, 0, 0])
    assert known.sum() > 3
    assert (share[known, 0, 0] == 1.0).all()
    assert (number[known, 0, 0] >= 1.0).all()
    assert (np.nan_to_num(share) <= 1.0 + 1e-3).all()
    for material in (ALUMINIUM, BRITTLE):
        top = material.swt([1e3, 1e6])[:, None]
        rounds = material.rounds(np.broadcast_to(top, (2, known.sum())), share[known], number[known])
        assert (rounds <= material.cycles(top) * (1.0 + 1e-12)).all()


def test_far_from_the_contact_the_cycles_of_the_bulk_stress_count() -> None:
    up, down = [0.0, 0.1, 1.0], [0.0, -0.1, -1.0]
    load = LoadPath("three", [up, down, up, down, up, [0.0, -0.1, -0.5]])
    still = points(poisson_ratio=0.5, friction=0.0, normal_amplitude=0.0, tangential_amplitude=0.1)
    batch = replace(still, path=load, bulk_stress_amplitude=np.array([2.0]))
    ((_, scene),) = scenes(batch)
    found = FewCycles.of(scene, np.array([np.nan]), np.array([0.0]))
    share, number = found.share, found.number
    assert share[0, 0, :2].tolist() == pytest.approx([1.0, 0.75])
    assert number[0, 0, :2].tolist() == [2.0, 1.0]
    assert np.isnan(share[0, 0, 2:]).all()
    assert np.isnan(share[0, 1:]).all()


def test_many_cycles_are_few_of_nearly_the_same_damage() -> None:
    rng = np.random.default_rng(3)
    for _ in range(100):
        shares = -np.sort(-(rng.uniform(0.0, 1.0, rng.integers(1, 300)) ** rng.uniform(0.5, 4.0)))
        shares /= shares[0]
        own, number = few(shares, 8)
        assert len(own) <= 8
        assert own[0] == 1.0
        assert number.sum() == len(shares)
        assert (np.diff(own) < 0.0).all()
        for power, error in ((1.0, 0.15), (2.0, 0.08), (4.0, 1e-9), (6.0, 0.06), (9.0, 0.12)):
            assert (number * own**power).sum() == pytest.approx((shares**power).sum(), rel=error)


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


def test_other_constants_need_no_new_run(two, tmp_path) -> None:
    found = two[0]
    shutil.copy2(two[1], tmp_path)
    other = Study.from_text(TWO.replace("strength = 927", "strength = 700"))
    assert assess(other, tmp_path / "a.nc").todo == 0
    again = swtstudy.run(other, tmp_path / "a.nc")
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


def test_archives_of_before_say_that_they_are_uncounted_and_a_run_counts(two, tmp_path) -> None:
    study, found = Study.from_text(TWO), two[0]
    (words,) = [line for line in describe(found) if "strain cycles" in line]
    assert words.endswith("several in 1 of 2 points")
    runs = json.loads(found.attrs["runs"])
    for run in runs:
        run["quantities"].remove("strain_cycles")
    before = found.drop_vars(["counted", "counted_number"]).assign_attrs(runs=json.dumps(runs))
    for name in ("cycles", "cycles_volume", "cycles_point", "cycles_line"):
        before[name] = before[name].copy(data=ALUMINIUM.cycles(before[f"SWT{name[6:]}"]))
        before[name].attrs.pop("comment")
    save(before, tmp_path / "before.nc")
    opened = swtstudy.open_results(tmp_path / "before.nc")
    assert opened.cycles.comment == opened.cycles_line.comment == UNCOUNTED
    assert any("uncounted" in line for line in describe(opened))
    again = swtstudy.run(study, tmp_path / "before.nc")
    assert_allclose(again.cycles, found.cycles, rtol=1e-12)
    assert_allclose(again.SWT, found.SWT, rtol=0)


@pytest.mark.parametrize("size", [1e-12, 1e-13, 1e-14])
def test_next_to_nothing_is_counted_too(size: float) -> None:
    """No plane of the search is then worse than the critical one."""
    load = LoadPath.harmonic_sum("small", [(1, size, 0.0)], [(1, size, 0.3)])
    steel = FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
    forces = {"normal_force": 200, "normal_force_amplitude": 1, "tangential_force_amplitude": 1}
    contact = swtstudy.physical(
        young_modulus=73.1e3, poisson_ratio=0.33, radius=50, friction=0.6, load=load, **forces
    )
    assert (contact.solve(rtol=1e-3, constants=steel).cycles > 1e30).all()
