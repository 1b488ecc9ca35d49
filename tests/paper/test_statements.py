"""Statements on made-up results that hold and that do not."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up import PHASES, STATEMENTS, made_up, made_up_audit

RATIOS = [0.25, 0.5, 1.0, 1.5, 2.0]
H = np.geomspace(0.002, 0.05, 201)


def of_amplitude(depth: float) -> xr.Dataset:
    amplitudes = [0.1, 0.5, 8 / 9]
    return made_up(
        lambda normal_amplitude, phase: 1 + depth * normal_amplitude**2 * np.sin(phase),
        normal_amplitude=amplitudes,
        phase=PHASES,
    )


def test_the_phase_matters_more_at_large_amplitudes():
    assert STATEMENTS["phase_matters_more_with_amplitude"](of_amplitude(0.3)).holds
    assert not STATEMENTS["phase_matters_more_with_amplitude"](of_amplitude(0.0)).holds


def of_ratio(depths: dict[float, float], orders: dict[float, int]) -> xr.Dataset:
    """s(ψ) with a depth and a number of waves for each frequency ratio, deeper at the larger amplitude."""

    def s(normal_amplitude: xr.DataArray, frequency_ratio: xr.DataArray, phase: xr.DataArray) -> xr.DataArray:
        depth = frequency_ratio.copy(data=[depths[ratio] for ratio in depths])
        order = frequency_ratio.copy(data=[float(orders[ratio]) for ratio in depths])
        return 1 + normal_amplitude * depth * np.cos(order * phase)

    return made_up(s, normal_amplitude=[0.25, 0.75], frequency_ratio=list(depths), phase=PHASES)


ORDERS = {0.25: 1, 0.5: 1, 1.0: 2, 1.5: 3, 2.0: 4}


def test_prominent_ratios():
    deep_one = of_ratio({0.25: 0.3, 0.5: 0.5, 1.0: 0.4, 1.5: 0.3, 2.0: 0.1}, ORDERS)
    assert not STATEMENTS["prominent_among_all"](deep_one).holds
    assert STATEMENTS["prominent_among_different"](deep_one).holds
    deep_two = of_ratio({0.25: 0.3, 0.5: 0.5, 1.0: 0.1, 1.5: 0.3, 2.0: 0.4}, ORDERS)
    assert not STATEMENTS["prominent_among_different"](deep_two).holds
    others = of_ratio({2 / 3: 0.1, 0.75: 0.2}, {2 / 3: 4, 0.75: 3})
    assert STATEMENTS["others_matter_little"](deep_one, others).holds
    others = of_ratio({2 / 3: 0.1, 0.75: 0.35}, {2 / 3: 4, 0.75: 3})
    assert not STATEMENTS["others_matter_little"](deep_one, others).holds


def test_periods():
    depths = dict.fromkeys(RATIOS, 0.3)
    shrinking = of_ratio(depths, ORDERS)
    finding = STATEMENTS["period_shrinks"](shrinking)
    assert finding.holds
    assert finding.measured.endswith("1/4: 2π, 1/2: 2π, 1: π, 3/2: 2π/3, 2: π/2")
    assert not STATEMENTS["period_shrinks"](of_ratio(depths, {**ORDERS, 2.0: 2})).holds
    others = of_ratio({2 / 3: 0.1}, {2 / 3: 4})
    assert not STATEMENTS["period_shrinks_in_between"](shrinking, others).holds
    constant = STATEMENTS["period_shrinks"](of_ratio({**depths, 2.0: 0.0}, ORDERS))
    assert not constant.holds
    assert constant.measured.endswith("3/2: 2π/3, 2: none")
    # Kinks between the points of the grid do not hide the period.
    waves = xr.DataArray([*ORDERS.values()], {"frequency_ratio": RATIOS})
    kinks = (2.0 + abs(np.cos(waves * shrinking.phase / 2 - 0.3))).expand_dims(normal_amplitude=1)
    assert STATEMENTS["period_shrinks"](kinks.to_dataset(name="s")).measured == finding.measured


def test_a_larger_normal_oscillation_amplifies():
    results = of_ratio(dict.fromkeys(RATIOS, 0.3), ORDERS)
    assert STATEMENTS["amplitude_amplifies"](results).holds
    assert STATEMENTS["amplitude_amplifies"](results.isel(normal_amplitude=[1, 0])).holds
    swapped = results.assign_coords(normal_amplitude=[0.75, 0.25])
    assert not STATEMENTS["amplitude_amplifies"](swapped).holds


def of_face(rounded: float, truncated: float, coupled: float = 0.0) -> xr.Dataset:
    def s(profile: xr.DataArray, flat_radius: xr.DataArray, phase: xr.DataArray) -> xr.DataArray:
        slope = xr.where(profile == "rounded_punch", rounded, truncated)
        return np.exp(slope * flat_radius) * (2 + np.cos(phase * (1 + coupled * flat_radius)))

    profiles = ["rounded_punch", "truncated_paraboloid"]
    return made_up(s, profile=profiles, flat_radius=[0.0, 0.5, 1.0, 2.0], phase=PHASES)


def test_the_face_of_the_punch():
    good, bad = of_face(-0.3, 0.3), of_face(0.01, -0.01)
    coupled = of_face(-0.3, 0.3, coupled=0.5)
    for statement, wrong in (
        (STATEMENTS["rounded_punch_falls"], bad),
        (STATEMENTS["truncated_paraboloid_rises"], bad),
        (STATEMENTS["rounded_punch_uncoupled"], coupled),
        (STATEMENTS["truncated_paraboloid_weakly_coupled"], coupled),
    ):
        assert statement(good).holds, statement.sentence
        assert not statement(wrong).holds, statement.sentence


def test_a_fall_within_the_error_is_none():
    results = of_face(-0.3, -1e-9)
    assert STATEMENTS["truncated_paraboloid_rises"](results).holds
    results["s_error"] = 0 * results.s_error
    finding = STATEMENTS["truncated_paraboloid_rises"](results)
    assert not finding.holds
    assert "49 of 49 phases" in finding.measured


@pytest.mark.parametrize(("coupled", "holds"), [(0.0, True), (0.05, False)])
def test_normalised_curves_are_alike(coupled, holds):
    results = made_up(
        lambda phase, frequency_ratio, flat_radius: (
            (1 + frequency_ratio + phase) * np.exp(-flat_radius * (0.4 + coupled * frequency_ratio))
        ),
        phase=[0.0, math.pi],
        frequency_ratio=RATIOS,
        flat_radius=np.linspace(0, 2, 21),
    )
    assert STATEMENTS["curves_fall_alike"](results).holds == holds
    assert STATEMENTS["all_curves_fall"](results).holds
    assert STATEMENTS["loads_do_not_couple"](results).holds
    rising = results.assign_coords(flat_radius=2 - results.flat_radius)
    assert not STATEMENTS["all_curves_fall"](rising).holds


def wave(h: xr.DataArray, power: float, shift: float = 0.0) -> xr.DataArray:
    return 0.15 + 0.05 * (h / 0.05) ** power * np.cos(2 / np.sqrt(h) + shift)


def test_waviness_and_frequency_ratio():
    def s(
        phase: xr.DataArray, frequency_ratio: xr.DataArray, waviness_amplitude: xr.DataArray
    ) -> xr.DataArray:
        load = xr.where((frequency_ratio == 0.5) & (phase > 1), 0.5, 1 + frequency_ratio)
        return load * wave(waviness_amplitude, 0.5)

    axes = {"phase": [0.0, math.pi], "frequency_ratio": RATIOS, "waviness_amplitude": H}
    good = made_up(s, **axes)
    of_figure8 = [each for each in STATEMENTS.values() if each.studies == ("figure8",)]
    for statement in of_figure8:
        assert statement(good).holds, statement.sentence
    coupled = made_up(
        lambda phase, frequency_ratio, waviness_amplitude: wave(
            waviness_amplitude, -0.2, frequency_ratio * (1 + phase)
        ),
        **axes,
    )
    for statement in of_figure8:
        assert not statement(coupled).holds, statement.sentence


def test_parameters():
    rising = made_up(lambda profile, friction: friction, profile=["paraboloid"], friction=[0.1, 0.2, 0.3])
    assert STATEMENTS["rises_with_friction"](rising).holds
    rising.s[0, 2] = 0.15
    assert not STATEMENTS["rises_with_friction"](rising).holds
    axes = {"friction": [0.1, 0.3], "poisson_ratio": np.linspace(0, 0.5, 11)}
    weak = made_up(lambda friction, poisson_ratio: 1 + 0.01 * np.sin(20 * poisson_ratio), **axes)
    assert STATEMENTS["poisson_ratio_is_intricate"](weak).holds
    strong = made_up(lambda friction, poisson_ratio: 1 - poisson_ratio, **axes)
    assert not STATEMENTS["poisson_ratio_is_intricate"](strong).holds


def random_curves(falls: dict[int, float], regime: int) -> xr.Dataset:
    """Twenty curves that rise, except for those that end with a fall, in a regime."""
    curves = made_up(
        lambda sample, tangential_amplitude: tangential_amplitude + 0 * sample,
        sample=np.arange(20.0),
        tangential_amplitude=[0.4, 0.8, 1.2],
    )
    for number, fall in falls.items():
        curves.s[number, 2] = 0.8 * (1.0 - fall)
        curves.regime[number, 2] = regime
    return curves


@pytest.mark.parametrize(
    ("falls", "regime", "holds"),
    [
        ({}, 1, (True, True)),
        ({3: 0.2}, 1, (False, True)),
        ({3: 0.01, 4: 0.01}, 1, (False, False)),
        ({number: 0.04 for number in range(20)}, 2, (False, True)),
        ({3: 0.06}, 2, (False, False)),
    ],
)
def test_a_fall_with_the_tangential_amplitude(falls, regime, holds):
    curves = random_curves(falls, regime)
    always, mostly = (
        test(curves)
        for test in (STATEMENTS["rises_with_tangential_amplitude"], STATEMENTS["rises_in_partial_slip"])
    )
    assert (always.holds, mostly.holds) == holds
    words = f"s falls on {len(falls) or 'none'} of 20 random curves"
    assert always.measured.startswith(words)
    assert f"{'in gross slip' if regime == 2 else 'up to gross slip'} {words}" in mostly.measured
    # A fall within the error is none.
    curves["s_error"] = curves.s_error + 1.0
    assert STATEMENTS["rises_with_tangential_amplitude"](curves).holds


@pytest.mark.parametrize(("share", "holds"), [(1.0, True), (0.5, True), (1.001, False)])
def test_the_critical_point_is_inside_of_the_contact(share, holds):
    figures = [made_up(lambda normal_amplitude: 1 + 0 * normal_amplitude, normal_amplitude=[0.0, 0.75])] * 2
    for figure in figures:
        figure["critical_x"] = -share * np.sqrt(1.0 + figure.normal_amplitude)
    audit = made_up_audit(off_line=1)
    assert STATEMENTS["inside_contact"](*figures, audit, audit).holds == holds
    audit["verdict"][0] = audit.verdict.attrs["flag_meanings"].split().index("surface")
    finding = STATEMENTS["inside_contact"](*figures, audit, audit)
    assert not finding.holds
    assert "beneath the surface at 2 of 8 randomly audited points" in finding.measured


@pytest.mark.parametrize(("power", "holds"), [(-1.0, True), (-2.1, False)])
def test_a_sharp_punch_is_the_limit_of_a_small_radius(power, holds):
    """At fixed b and δ0 SWT goes with s (b/a_H)², and R with (b/a_H)^−2."""
    annulus = made_up(
        lambda profile, friction, flat_radius: friction * flat_radius**power,
        profile=["rounded_punch"],
        friction=[0.1, 0.3],
        flat_radius=[0.1, 1.0, 10.0],
    )
    finding = STATEMENTS["sharp_edges_are_worst"](annulus)
    assert finding.holds == holds
    assert ("at the end like R^-0.50 to R^-0.50" in finding.measured) == holds


@pytest.mark.parametrize(("third", "holds"), [(0.2, True), (0.35, False)])
def test_long_cycles_matter_little(third, holds):
    depths = {1.0: 0.4, 0.5: 0.3, 1.5: 0.1, 1 / 3: third, 2 / 3: 0.1}
    finding = STATEMENTS["long_cycles_matter_little"](
        of_ratio(depths, {1.0: 2, 0.5: 1, 1.5: 3, 1 / 3: 1, 2 / 3: 2})
    )
    assert finding.holds == holds
    assert "q = 1: 0.86, 2: 0.58, 3: " in finding.measured


def test_formalisms_agree_and_a_wrong_one_would_not(monkeypatch):
    assert STATEMENTS["formalisms_agree"]().holds
    wrong = "swtstudy.paper.formalisms.march_springs"
    monkeypatch.setattr(wrong, lambda g, depth, *_, **__: (None, np.ones((len(depth), len(g)))))
    assert not STATEMENTS["formalisms_agree"]().holds


def test_what_an_archive_lacks_is_named():
    statement = STATEMENTS["almost_a_factor_of_two"]
    with pytest.raises(LookupError, match="no normal_amplitude = 8/9"):
        statement(of_amplitude(0.3).isel(normal_amplitude=[0, 1]))
    with pytest.raises(LookupError, match=r"no normal_amplitude$"):
        statement(of_amplitude(0.3).isel(normal_amplitude=2, drop=True))
    with pytest.raises(LookupError, match="no axis phase"):
        statement(of_amplitude(0.3).isel(phase=0))


@pytest.mark.parametrize(("away", "found"), [(1e-7, True), (1e-5, False)])
def test_values_in_an_archive_are_found_as_in_a_slice(away, found):
    results = of_amplitude(0.35)
    results["normal_amplitude"] = results.normal_amplitude * (1.0 + away)
    if found:
        assert STATEMENTS["almost_a_factor_of_two"](results).holds
    else:
        with pytest.raises(LookupError, match="no normal_amplitude = 8/9"):
            STATEMENTS["almost_a_factor_of_two"](results)


@pytest.mark.parametrize(
    ("places", "more", "coupled"),
    [
        (np.linspace(0.0, 2 * np.pi, 145), [1.5517, 2.6308, 2.6308 + np.pi, 2.631], "0.0%"),
        (np.geomspace(0.002, 0.05, 201), [0.002377, 0.028078], "0.0%"),
        ([0.0, 1.0], [0.3, 1.1], "10.0%"),
    ],
)
def test_values_put_in_among_equal_steps_or_ratios_do_not_count(places, more, coupled):
    """Only the values put in are coupled; without equal steps or ratios every value counts."""
    results = made_up(
        lambda profile, flat_radius, phase: np.exp(flat_radius * (1 + phase.isin(more))),
        profile=["rounded_punch"],
        flat_radius=[-1.0, 1.0],
        phase=[*more, *places],
    )
    finding = STATEMENTS["rounded_punch_uncoupled"](results)
    assert finding.holds == (coupled == "0.0%")
    assert finding.measured.startswith(f"{coupled} of the variance")
