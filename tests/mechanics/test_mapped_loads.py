"""Loads whose normal component is mapped: what they say of themselves, against samples of their cycles."""

from __future__ import annotations

import numpy as np
import pytest

from swtstudy.mechanics.contact.cycle import out_of_equilibrium
from swtstudy.mechanics.control.diagram import MappedLoad, diagram, largest_depth
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.vocabulary.parameters import Control

SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": np.array([0.5, 0.2])},
    "wavy_paraboloid": {"waviness_amplitude": np.array([0.02, 0.05]), "wavelength": np.array([5.0, 4.6])},
}
MIXED = [Control(True, False), Control(False, True)]
EVERY = [(name, control) for name in SHAPES for control in MIXED]
INSTANT = np.linspace(0.0, 2.0 * np.pi, 4001)[None]


def mapped(name: str, control: Control, p: int = 3, q: int = 2) -> MappedLoad:
    """Two loads without lift-off."""
    given = BimodalLoad(np.array([0.4, 0.7]), np.array([0.3, 0.1]), np.array([0.4, 2.0]), p, q)
    load, _ = diagram(control, name, SHAPES[name], given)
    assert isinstance(load, MappedLoad)
    return load


@pytest.mark.parametrize(("name", "control"), EVERY)
def test_ends_and_motion_are_those_of_the_cycle(name: str, control: Control) -> None:
    load, instant = mapped(name, control), np.repeat(INSTANT, 2, axis=0)
    normal, tangential = load.normal(instant), load.tangential(instant)
    np.testing.assert_allclose(load.least_normal, normal.min(axis=1), rtol=1e-5)
    np.testing.assert_allclose(load.largest_normal, normal.max(axis=1), rtol=1e-5)
    motion = 0.5 * (np.ptp(normal, axis=1) + np.ptp(tangential, axis=1))
    np.testing.assert_allclose(load.motion, motion, rtol=1e-5)
    later = instant + np.pi
    assert load.mirrored_half
    np.testing.assert_allclose(load.normal(later), normal, rtol=1e-12)
    np.testing.assert_allclose(load.tangential(later), -tangential, rtol=0.0, atol=1e-12)
    assert not mapped(name, control, 2, 1).mirrored_half


@pytest.mark.parametrize(("name", "control"), EVERY)
def test_rates_are_the_derivatives_of_loads_and_slip_lines(name: str, control: Control) -> None:
    load, step = mapped(name, control), 1e-4
    instant = np.linspace(0.1, 6.2, 50)
    both = np.repeat(instant[None], 2, axis=0)
    rate = (load.normal(both + step) - load.normal(both - step)) / (2.0 * step)
    np.testing.assert_allclose(load.normal_rate(both), rate, rtol=0.0, atol=1e-6)
    for sense in (1.0, -1.0):
        line, second = load._slip_line(sense), np.ones(len(instant), dtype=np.intp)
        values = [line(instant + k * step, second)[0] for k in (-1, 0, 1)]
        _, slope, bend = line(instant, second)
        assert values[1] == pytest.approx((sense * load.tangential(both) - load.normal(both))[1], abs=1e-14)
        assert slope == pytest.approx((values[2] - values[0]) / (2.0 * step), abs=1e-6)
        assert bend == pytest.approx((values[2] - 2.0 * values[1] + values[0]) / step**2, abs=1e-5)


@pytest.mark.parametrize(("name", "control"), EVERY)
def test_growth_leaves_the_ratio_of_the_rates(name: str, control: Control) -> None:
    load = mapped(name, control)
    instant = np.array([0.3, 1.9, 3.4, 5.0]) + np.zeros((2, 1))
    instant = np.where(load.normal_rate(instant) > 0.0, instant, instant + 0.5 * np.pi)
    branch, rate = load.branch(instant), load.normal_rate(instant)
    ratio = np.clip(load.tangential_rate(instant) / rate, -1.0, 1.0)
    rises = rate > 0.1
    assert rises.sum() > 4
    found = load.growth_slope(load.normal(instant), branch)
    np.testing.assert_allclose(found[rises], -ratio[rises], rtol=1e-7)
    at = load.touch_down(load.normal(instant), branch)
    np.testing.assert_allclose(np.mod(at, 2.0 * np.pi)[rises], np.mod(instant, 2.0 * np.pi)[rises], atol=1e-9)


def test_the_largest_depth_is_that_of_the_largest_normal_load() -> None:
    largest = np.array([1.3, 2.0])
    for tangential_force in (True, False):
        found = largest_depth(Control(False, tangential_force), "paraboloid", {}, largest)
        np.testing.assert_allclose(found, largest, rtol=1e-12)
        found = largest_depth(Control(True, tangential_force), "paraboloid", {}, largest)
        np.testing.assert_allclose(found, largest ** (2.0 / 3.0), rtol=1e-12)


def test_a_depth_that_lifts_off_carries_no_tangential_force_but_none() -> None:
    given = BimodalLoad(np.full(2, 1.3), np.array([0.0, 0.1]), np.zeros(2), 1, 1)
    load, _ = diagram(Control(False, True), "paraboloid", {}, given)
    assert out_of_equilibrium(load, Control(False, True)).tolist() == [False, True]
