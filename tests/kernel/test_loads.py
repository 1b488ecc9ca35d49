"""Loads of the compiled kernel: what they are at each instant, and what follows from them."""

from fractions import Fraction

import numpy as np
import pytest
from solved import REGIMES

import swtstudy
from swtstudy.kernel.batch import solve_batch
from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.contact import CYCLE, solve_cycle
from swtstudy.kernel.events import force_ratio, slide
from swtstudy.kernel.load import bulk_at, bulk_rates, load_at, rates_at
from swtstudy.kernel.loads import bimodal, harmonic_sum, polygon, prescribe
from swtstudy.kernel.loops import ends_of_sum, without_collinear

pytestmark = pytest.mark.xdist_group("kernel")


@pytest.mark.parametrize("ratio", ["1", "3/2", "2/3"])
def test_bulk_stress_oscillates_with_the_tangential_load(ratio: str) -> None:
    p, q = Fraction(ratio).as_integer_ratio()
    load = bimodal(0.4, Fraction(ratio), 0.3, 1.1, bulk_amplitude=0.02, bulk_mean=-0.01, bulk_phase=0.7)
    for t in np.linspace(0.0, 9.0, 7):
        assert bulk_at(load, t) == pytest.approx(-0.01 + 0.02 * np.sin(p * t + 0.7), abs=1e-15)
        rates = 0.02 * p * np.cos(p * t + 0.7), -0.02 * p * p * np.sin(p * t + 0.7)
        assert bulk_rates(load, t) == pytest.approx(rates, abs=1e-14)
        n, v = load_at(load, t)
        assert n == pytest.approx(1.0 + 0.4 * np.sin(q * t + 1.1), abs=1e-14)
        assert v == pytest.approx(0.3 * np.sin(p * t), abs=1e-14)
    assert tuple(load.bulk_range) == pytest.approx((-0.03, 0.01))
    assert not load["mirrored"]


def test_bulk_stress_of_a_polygon() -> None:
    load = polygon([1.0, 1.5, 1.0], [0.0, 0.2, -0.3], [0.01, 0.03, -0.02])
    assert [bulk_at(load, t) for t in (0.0, 0.5, 1.0, 2.5, 3.5)] == pytest.approx(
        [0.01, 0.02, 0.03, -0.005, 0.02]
    )
    assert tuple(load.bulk_range) == (-0.02, 0.03)
    assert rates_at(load, 0.5)[2:4] == pytest.approx((0.5, 0.2))


WITH_BULK = swtstudy.LoadPath("bulk stress", [[0, 0.5, 1], [0.5, 0.5, -1], [0.5, -0.5, 0.5], [0, -0.5, 0]])


@pytest.mark.parametrize(
    ("control", "normal", "tangential", "phase", "held"),
    [
        ((True, True), 0.6, 0.6, 1.0, False),
        ((True, True), 0.6, 0.4, 0.0, True),
        ((True, True), 0.3, 0.7, 0.0, True),  # |v| = n at an instant
        ((True, True), 0.3, 0.7 + 1e-9, 0.0, False),
        ((True, False), 1.0, 0.3, 1.0, True),
        ((True, False), 1.0 + 1e-9, 0.3, 1.0, False),
        ((False, False), 1.5, 0.3, 1.0, True),
        ((False, True), 1.2, 0.0, 1.0, True),
        ((False, True), 1.2, 1e-9, 1.0, False),
    ],
)
def test_friction_carries_the_forces_or_there_is_no_s(
    control: tuple[bool, bool], normal: float, tangential: float, phase: float, held: bool
) -> None:
    found = solve_batch("paraboloid", [0.3], [0.5], [normal], [tangential], [1], [phase], control=control)[0]
    assert np.isfinite(found["s"]) == held
    assert (REGIMES[found["regime"]] == "no_equilibrium") == (not held)


def test_margins_follow_from_the_load() -> None:
    cycle = new_record(CYCLE)

    def margins(
        control: tuple[bool, bool], normal: float, tangential: float, ratio: int
    ) -> tuple[float, float]:
        load = bimodal(normal, Fraction(ratio), tangential, 0.3)
        prescribe(load, control, None)
        solve_cycle(cycle, load)
        return force_ratio(load, cycle["event"], cycle["events"]), slide(
            load, cycle["event"], cycle["events"]
        )

    t = np.linspace(0.0, 2.0 * np.pi, 100_001)
    largest = np.max(0.3 * np.abs(np.sin(2 * t)) / (1.0 + 0.5 * np.sin(t + 0.3)))
    assert margins((True, True), 0.5, 0.3, 2)[0] == pytest.approx(largest, rel=1e-4)
    assert np.isnan(margins((True, True), 0.5, 0.3, 2)[1])
    assert np.isnan(margins((False, False), 0.5, 0.3, 2)[0])
    assert margins((False, False), 0.5, 0.3, 2)[1] == 0.0
    assert margins((False, False), 0.0, 1.25, 1)[1] == pytest.approx(0.25)
    assert np.isnan(margins((False, False), 1.5, 0.3, 2)[1])


def test_a_curved_side_is_refused() -> None:
    with pytest.raises(ValueError, match="needs two displacements or two forces"):
        solve_batch("paraboloid", [0.3], [0.5], [0.5], [0.3], loops=[WITH_BULK], control=(True, False))


def around(count: int, noise: float = 0.0) -> swtstudy.LoadPath:
    """A loop of vertices on a smooth cycle, or beside it."""
    t = 2.0 * np.pi * np.arange(count) / count
    loads = np.stack([np.sin(t + 1.0), np.sin(2.0 * t)], axis=1)
    off = np.random.default_rng(1).normal(size=(2, count)).T
    return swtstudy.LoadPath(f"{count} vertices", loads + noise * off)


def one_loop(loop: swtstudy.LoadPath, rtol: float = 1e-4) -> np.void:
    return solve_batch("paraboloid", [0.3], [0.5], [0.5], [0.3], loops=[loop], rtol=rtol)[0]


@pytest.mark.parametrize(
    ("count", "noise", "s"),
    [(200, 0.0, 0.1285864), (1600, 0.0, 0.1286002), (800, 0.01, 0.1304281), (1600, 0.1, 0.1742219)],
)
def test_long_loops_have_the_value_of_a_look_at_every_vertex(count: int, noise: float, s: float) -> None:
    found = one_loop(around(count, noise))
    assert abs(found["s"] - s) <= found["s_error"]
    assert found["s"] == pytest.approx(s, rel=2e-5)


@pytest.mark.parametrize("noise", [0.0, 0.01, 0.1])
def test_long_loops_are_looked_at_where_short_ones_are(noise: float) -> None:
    short, long = (int(one_loop(around(count, noise))["positions"]) for count in (200, 1600))
    assert long <= 1.5 * short


def test_sides_of_the_line_that_cannot_matter_stay_out() -> None:
    # Many cusps, and a maximum on one side of the line only.
    normal = [(14, 0.26, 1.6), (15, 0.3, 5.7), (11, 0.12, 1.7)]
    tangential = [(14, 0.14, 2.5), (16, 0.36, 1.5), (7, 0.39, 6.0), (9, 0.06, 3.6)]
    loop = swtstudy.LoadPath.harmonic_sum("many turns", normal, tangential)
    found = solve_batch("paraboloid", [0.3], [0.5], [0.3], [0.05], loops=[loop])[0]
    assert found["positions"] < 2000
    assert found["s_error"] <= 1.2e-4 * found["s"]


def test_harmonics_of_a_negative_amplitude_and_of_order_0() -> None:
    """A negative amplitude is half a turn of the phase; a harmonic of order 0 is at rest."""
    found = harmonic_sum([(2, -0.3, 0.4), (0, 0.5, 1.2)], [(3, 0.2, 0.1), (6, -0.1, 2.0)], [(0, -0.4, 0.3)])
    for t in np.linspace(0.0, 6.0, 5):
        n, v = load_at(found, t)
        assert n == pytest.approx(-0.3 * np.sin(2 * t + 0.4) + 0.5 * np.sin(1.2), abs=1e-14)
        assert v == pytest.approx(0.2 * np.sin(3 * t + 0.1) - 0.1 * np.sin(6 * t + 2.0), abs=1e-14)
        assert bulk_at(found, t) == pytest.approx(-0.4 * np.sin(0.3), abs=1e-14)
    assert (found["terms"], found["rounds"], found["fastest"]) == (3, 1, 6)


@pytest.mark.parametrize("seed", range(5))
def test_ends_of_a_sum_of_harmonics(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = [(int(k), rng.normal(), rng.uniform(0.0, 7.0)) for k in rng.integers(0, 9, 1 + seed)]
    t = np.linspace(0.0, 2.0 * np.pi, 100_001)
    values = sum((size * np.sin(order * t + phase) for order, size, phase in rows), np.zeros_like(t))
    assert ends_of_sum(rows) == pytest.approx((values.min(), values.max()), abs=1e-7)


def test_loops_without_vertices_that_tell_nothing() -> None:
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    more = np.insert(square, 1, [[0.0, 0.0], [0.25, 0.0], [0.5, 0.0]], axis=0)
    assert without_collinear(more).tolist() == square.tolist()
    back = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]])  # a line there and back: both of its ends
    assert without_collinear(back).tolist() == [[0.0, 0.0], [1.0, 0.0]]
    assert without_collinear(np.ones((3, 2))).tolist() == [[1.0, 1.0]]
