"""Tables of the normal load in the diagram's coordinate against the indenter's formulas."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from swtstudy import TabulatedProfile
from swtstudy.mechanics.control.coordinate import ForceCoordinate, unit_half_load
from swtstudy.mechanics.control.diagram import MappedLoad, diagram
from swtstudy.mechanics.control.normal_map import ByRadius, DepthOfForce, ForceOfDepth, TabledMap
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.numerics.chebyshev import EvenTable
from swtstudy.vocabulary.parameters import Control

Array = NDArray[np.float64]

R = np.linspace(0.0, 4.0, 60)
RIPPLED = TabulatedProfile("rippled", R, R * R * (1.0 + 0.05 * np.cos(2.0 * R)) / 1.05)
FACED = TabulatedProfile("faced", R, np.where(R > 0.5, (R - 0.5) ** 2, 0.0))
#: Waves of two shapes and depths, from few to hundreds of rad; of each the first and the third are the same.
WAVES = {
    "few": {"waviness_amplitude": np.array([0.02, 0.1, 0.02]), "wavelength": np.array([5.0, 4.5, 5.0])},
    "many": {"waviness_amplitude": np.array([1e-4, 2e-4, 1e-4]), "wavelength": np.array([4.5, 5.0, 4.5])},
}
DEPTHS = np.array([1.4, 1.9, 1.4])


def exact(name: str, kind: type[ByRadius]) -> ByRadius:
    """Three indenters."""
    family, shape = (RIPPLED, {}) if name == "rippled" else ("wavy_paraboloid", WAVES[name])
    profile = make_profile(family, shape, DEPTHS)
    return kind(ForceCoordinate(profile, unit_half_load(family, shape, 3)))


@pytest.fixture(params=[ForceOfDepth, DepthOfForce])
def kind(request: pytest.FixtureRequest) -> type[ByRadius]:
    return request.param


@pytest.fixture(params=["few", "many", "rippled"])
def of(request: pytest.FixtureRequest, kind: type[ByRadius]) -> ByRadius:
    return exact(request.param, kind)


def loads(of: ByRadius) -> Array:
    """Prescribed loads from next to none to the largest."""
    share = np.sort(np.concatenate([np.geomspace(1e-9, 1.0, 40), np.linspace(1e-3, 1.0, 301)]))
    profile = of.force.profile
    largest = profile.largest_depth[:, None]
    return share * (largest if isinstance(of, ForceOfDepth) else of.force.of(profile.radius(largest)))


def tabled(of: ByRadius) -> TabledMap:
    tables = of.force.profile.tables()
    assert tables is not None
    return TabledMap.of(of, tables)


def test_an_even_table_is_exact_for_quintics() -> None:
    coefficients = np.random.default_rng(3).normal(size=(2, 6))
    end, rows = np.array([0.7, 3.0]), np.array([1, 0, 1])
    quintics = [np.polynomial.Polynomial(c) for c in coefficients]
    nodes = end[:, None] * np.linspace(0.0, 1.0, 5)
    sampled = [
        np.stack([quintic.deriv(k)(at) for quintic, at in zip(quintics, nodes, strict=True)])
        for k in range(3)
    ]
    table = EvenTable(end, *sampled)
    at = np.random.default_rng(4).uniform(0.0, end[rows][:, None], (3, 50))
    at[:, -1] = end[rows]
    expected = [np.stack([quintics[r].deriv(k)(x) for r, x in zip(rows, at, strict=True)]) for k in range(3)]
    row = rows[:, None]
    np.testing.assert_allclose(table(row, at), expected[0], rtol=0.0, atol=1e-11)
    for found in (table.with_slope(row, at), table.with_derivatives(row, at)):
        for k, values in enumerate(found):
            np.testing.assert_allclose(values, expected[k], rtol=0.0, atol=1e-9)


def test_tables_are_what_they_stand_for(of: ByRadius) -> None:
    table, load = tabled(of), loads(of)
    expected = of.with_derivatives(load)
    for found in (table.with_derivatives(load), (table.value(load), table.slope(load))):
        for k, digits in enumerate((3e-11, 3e-7, 1e-3)[: len(found)]):
            scale = np.abs(expected[k]) + (np.abs(expected[k]).max() if k == 0 else 0.0)
            assert (np.abs(found[k] - expected[k]) <= digits * scale)[load > 1e-3].all(), k
    # Relative next to no load, where they turn the most.
    np.testing.assert_allclose(table.value(load), expected[0], rtol=1e-5)


def test_inverses_are_of_the_table_to_the_last_digit(of: ByRadius) -> None:
    # An edge that arrives at x is told from one that does not by less than 2e-15.
    table, load = tabled(of), loads(of)
    value = table.value(load)
    off = np.abs(table.value(table.inverse(value)) - value)
    assert off.max() <= 1.5e-15 * value.max()
    there, slope = table.inverse_and_slope(value)
    np.testing.assert_allclose(there, load, rtol=1e-5, atol=3e-11)
    np.testing.assert_allclose(slope, of.slope(load), rtol=1e-5)


@pytest.mark.parametrize("family", ["paraboloid", "rounded_punch", "truncated_paraboloid", "power_law"])
def test_the_slope_at_a_value_is_that_at_the_load(family: str, kind: type[ByRadius]) -> None:
    name = "exponent" if family == "power_law" else "flat_radius"
    shape = {} if family == "paraboloid" else {name: np.array([0.3, 1.2, 0.8]) + (family == "power_law")}
    profile = make_profile(family, shape, DEPTHS)
    assert profile.tables() is None
    of = kind(ForceCoordinate(profile, unit_half_load(family, shape, 3)))
    # Next to no load the radius beside a face is the difference of two.
    load = loads(of)[:, -300:]
    there, slope = of.inverse_and_slope(of.value(load))
    np.testing.assert_allclose(there, load, rtol=1e-9)
    np.testing.assert_allclose(slope, of.slope(load), rtol=1e-7)


def test_apart_the_map_is_the_load_itself() -> None:
    table = tabled(exact("few", ForceOfDepth))
    none = np.array([[-0.3, 0.0]] * 3)
    np.testing.assert_array_equal(table.value(none), none)
    np.testing.assert_array_equal(table.inverse(none), none)
    value, slope, bend = table.with_derivatives(none)
    np.testing.assert_array_equal(value, none)
    np.testing.assert_array_equal(slope, 1.0)
    np.testing.assert_array_equal(bend, 0.0)


def test_equal_indenters_share_a_table_and_keep_it_when_taken() -> None:
    of = exact("few", ForceOfDepth)
    table, load = tabled(of), loads(of)
    assert table.row[0] == table.row[2] != table.row[1]
    some = np.array([1, 1, 0])
    np.testing.assert_array_equal(table.take(some).value(load[some]), table.value(load)[some])


def test_a_face_keeps_its_formulas() -> None:
    load = BimodalLoad(*np.array([[0.2], [0.1], [1.0]]), 1, 1)
    kinds = []
    for profile in (RIPPLED, FACED):
        mapped, _ = diagram(Control(False, True), profile, {}, load)
        assert isinstance(mapped, MappedLoad)
        kinds.append(type(mapped.map))
    assert kinds == [TabledMap, ForceOfDepth]
