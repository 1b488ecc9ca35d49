import numpy as np
import pytest
import stand_in
from told import refused, sayings

import swtstudy
from swtstudy import optimise
from swtstudy.results.optimise import tangent_planes

OVER = {"normal_amplitude": (0.0, 0.9), "phase": ("pi/4", "pi")}


def kinked(points, rtol):
    """A sharp valley that runs askew, lowest at the largest amplitude and hardly higher at none."""
    bottom = 2.0 + 0.8 * points.normal_amplitude
    s = 0.15 + 0.05 * abs(points.phase - bottom) - 0.05 * (points.normal_amplitude - 0.4) ** 2
    return stand_in.smooth(points, rtol)._replace(s=s, s_surface=s)


@pytest.fixture(scope="module")
def found():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stand_in.SOLVER, kinked)
        return optimise(over=OVER, rtol=1e-3)


@pytest.fixture
def valley(monkeypatch):
    monkeypatch.setattr(stand_in.SOLVER, kinked)


@pytest.mark.slow
def test_no_point_of_a_fine_grid_is_better_or_worse(found, valley):
    amplitude, phase = np.linspace(0.0, 0.9, 31), np.linspace(np.pi / 4, np.pi, 31)
    grid = swtstudy.solve(normal_amplitude=amplitude, phase=phase, rtol=1e-3)
    best, worst = found.s.sel(case="best").item(), found.s.sel(case="worst").item()
    assert best <= grid.s.min() * (1 + 1e-6)
    assert worst >= grid.s.max() * (1 - 1e-6)
    # As the grid is fine, it has nearly the same: s rises by no more over a cell.
    assert best > 0.95 * grid.s.min()
    assert worst < 1.02 * grid.s.max()


@pytest.mark.slow
def test_the_best_point_is_a_minimum_of_a_very_fine_grid_around_it(found, valley):
    best = found.sel(case="best")
    around = {name: best[name].item() + 1e-3 * np.linspace(-1, 1, 21) for name in OVER}
    around["normal_amplitude"] = np.clip(around["normal_amplitude"], 0.0, 0.9)
    around = {name: np.unique(values) for name, values in around.items()}
    grid = swtstudy.solve(**around, rtol=1e-3)
    assert best.s <= grid.s.min() * (1 + 1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 8])
def test_no_phase_of_a_dense_grid_is_better_or_worse_in_random_cases(seed):
    rng = np.random.default_rng(seed)
    case = {
        "frequency_ratio": str(rng.choice(["1/2", "1", "3/2", "2"])),
        "friction": rng.uniform(0.1, 0.9),
        "normal_amplitude": rng.uniform(0.1, 0.9),
        "tangential_amplitude": rng.uniform(0.1, 1.5),
    }
    if seed % 2:
        case |= {"profile": "rounded_punch", "flat_radius": rng.uniform(0.1, 1.0)}
    optimum = optimise(over={"phase": (0, "2*pi")}, rtol=1e-2, **case)
    dense = swtstudy.solve(phase=np.linspace(0.0, 2.0 * np.pi, 361), rtol=1e-2, **case)
    for case, of_grid, sign in (("best", dense.s.min(), 1.0), ("worst", dense.s.max(), -1.0)):
        s = optimum.s.sel(case=case)
        # What the nodes of a grid miss of a kink is small, and never better than the optimum.
        assert -1e-6 * s <= sign * (of_grid - s) <= 0.01 * s


def test_the_values_are_those_of_the_solver(found, valley):
    for case in ("best", "worst"):
        one = found.sel(case=case)
        alone = swtstudy.solve(**{name: one[name].item() for name in OVER}, rtol=1e-3)
        for name in ("s", "critical_x", "critical_angle", "regime"):
            assert one[name].item() == pytest.approx(alone[name].item(), rel=1e-9)


def test_how_it_was_found(found):
    assert found.attrs["minimise"] == "s"
    assert found.attrs["without_value"] == 0
    assert (found.evaluations > 200).all()
    assert found.evaluations.long_name == "number of points solved"


def test_each_case_has_its_own_numbers(found):
    assert found.case.values.tolist() == ["best", "worst"]
    for name in ("s", "evaluations"):
        assert found[name].dims == ("case",), name


@pytest.mark.slow
def test_the_same_seed_gives_the_same_to_the_bit(monkeypatch):
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    over = {"phase": (0, 4), "friction": (0.1, 0.2)}
    one, same, other = (optimise(over=over, seed=seed) for seed in (1, 1, 2))
    assert one.identical(same)
    assert not one.identical(other)
    assert one.s.values == pytest.approx(other.s.values, rel=1e-6)
    assert one.phase.values == pytest.approx([np.pi, 0.0], abs=1e-3)
    assert one.friction.values.tolist() == [0.1, 0.2]


@pytest.mark.slow
def test_another_quantity():
    found = optimise(over={"friction": (0.1, 0.5)}, minimise="critical_x", rtol=1e-2)
    grid = swtstudy.solve(friction=np.linspace(0.1, 0.5, 21), rtol=1e-2)
    assert found.critical_x.sel(case="best") <= grid.critical_x.min() + 1e-6
    assert found.critical_x.sel(case="worst") >= grid.critical_x.max() - 1e-6


def test_an_optimum_at_an_end_of_a_range_is_told():
    """s grows with friction; the phases of its extremes are inside."""
    found = swtstudy.optimise({"friction": (0.2, 0.4), "phase": (0, "pi")}, rtol=1e-2)
    assert found.friction.values.tolist() == [0.2, 0.4]
    ends = "best at the lower end of friction, worst at the upper end of friction"
    assert found.attrs["at_ends"] == ends
    assert "at_ends" not in swtstudy.optimise({"phase": (0, "pi")}, friction=0.2, rtol=1e-2).attrs


@pytest.mark.slow
def test_a_quantity_beside_s(monkeypatch):
    # The work is that of the mechanics.
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    found = optimise(over={"tangential_amplitude": (0.2, 0.9)}, minimise="dissipation", rtol=1e-2)
    # A contact that sticks dissipates nothing, and the larger of two oscillations more.
    assert found.dissipation.sel(case="best") == pytest.approx(0.0, abs=1e-12)
    assert found.tangential_amplitude.sel(case="worst") == 0.9
    there = swtstudy.solve(tangential_amplitude=0.9, quantities=["dissipation"], rtol=1e-2)
    assert found.dissipation.sel(case="worst") == pytest.approx(there.dissipation.item(), rel=1e-9)


def test_a_life_without_a_bound_is_the_best():
    """A cylinder under so much pressure of the bulk stress that nothing is in tension."""
    alloy = swtstudy.FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
    contact = swtstudy.physical(
        young_modulus=73.1e3, poisson_ratio=0.33, radius=80.0, friction=0.6, normal_force=500.0,
        profile="cylinder", tangential_force_amplitude=100.0, body=1, bulk_stress_amplitude=20.0,
    )  # fmt: skip
    found = contact.optimise({"bulk_stress_mean": (-400, 200)}, "cycles", constants=alloy, rtol=1e-2)
    assert found.cycles.sel(case="best") == np.inf
    assert found.bulk_stress_mean.sel(case="worst") == 200.0
    assert found.attrs["without_value"] == 0
    assert (found.evaluations < 200).all()


def singular_beyond(points, rtol):
    """A smooth function of the friction that is infinite from 1.6 on."""
    found = stand_in.smooth(points, rtol)
    return found._replace(s=np.where(points.friction < 1.6, found.s, np.inf))


@pytest.mark.slow
def test_points_without_a_finite_value_are_left_out_and_counted(monkeypatch):
    monkeypatch.setattr(stand_in.SOLVER, singular_beyond)
    found = optimise(over={"friction": (0.2, 2.0)}, rtol=1e-2)
    assert found.attrs["without_value"] > 0
    assert np.isfinite(found.s).all()
    assert found.friction.sel(case="worst") == pytest.approx(1.6, abs=1e-4)


BAD = sayings(r"""
dict(over={}) » over: found {}; allowed: ranges by name
dict(over={"frequency_ratio": (1, 2)}) » over.frequency_ratio: found not a parameter that is a number
dict(over={"phase": (0, 1, 2)}) » over.phase: .* allowed: both ends of a range
dict(over={"phase": (1, 1)}) » over.phase\[1\]: .* distinct values
dict(over={"friction": (0, 11)}) » over.friction\[1\]: found 11
dict(over={"friction": (0, 1)}, friction=0.3) » over.friction: found both a fixed value and an axis
dict(over={"flat_radius": (0, 1)}) » over.flat_radius: .* only with the profile
dict(over={"phase": (0, 1)}, friction=[0.1, 0.2]) » friction:
dict(over={"phase": (0, 1)}, minimise="regime") » minimise: found 'regime'
dict(over={"phase": (0, 1)}, minimise="bulk_shift") » minimise: found 'bulk_shift'; allowed: one of s
""")


@pytest.mark.parametrize(("given", "words"), BAD)
def test_bad_input_is_named(given, words):
    refused(words[0], optimise, **eval(given))


#: Ranges of parameters from 0 to 1, as the surfaces below have them.
UNIT = {"normal_amplitude": (0.0, 1.0), "friction": (0.0, 1.0), "tangential_amplitude": (0.0, 1.0)}


@pytest.mark.slow
@pytest.mark.parametrize("dimensions", [1, 2, 3])
@pytest.mark.parametrize("seed", [7, 8])
def test_kinks_are_followed_to_their_lowest_point(dimensions, seed, monkeypatch):
    """The highest of curved surfaces, whose gradients cancel at the place where they meet."""
    rng, over = np.random.default_rng(seed), dict(list(UNIT.items())[:dimensions])
    kink = rng.uniform(0.1, 0.9, dimensions)
    slopes = rng.normal(size=(dimensions + 1, dimensions))
    slopes -= slopes.mean(axis=0)
    halves = rng.normal(size=(dimensions + 1, dimensions, dimensions))
    curvatures = np.einsum("kij,klj->kil", halves, halves) / 2.0

    def highest(points, rtol):
        away = np.stack([getattr(points, name) for name in over], axis=1) - kink
        s = 1.0 + (away @ slopes.T + np.einsum("ni,kij,nj->nk", away, curvatures, away)).max(axis=1)
        return stand_in.smooth(points, rtol)._replace(s=s, s_surface=s)

    monkeypatch.setattr(stand_in.SOLVER, highest)
    best = optimise(over=over, seed=3, rtol=1e-3).sel(case="best")
    assert float(best.s) == pytest.approx(1.0, abs=1e-5)
    np.testing.assert_allclose([float(best[name]) for name in over], kink, atol=1e-3)


def test_planes_that_touch_a_linear_function_are_that_function():
    points = np.array([[0.2, 0.3], [0.8, 0.1], [0.4, 0.9]])

    def linear(at):
        return 1.0 + at @ [3.0, -5.0]

    search = tangent_planes(points, 0.1)
    values = linear(next(search))
    with pytest.raises(StopIteration) as end:
        search.send(values)
    planes = end.value.value
    np.testing.assert_allclose(planes.gradients, [[3.0, -5.0]] * 3, rtol=1e-6)
    np.testing.assert_allclose(planes.values, linear(points))
