"""What counts as holding, from both sides of each bound that a criterion names."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up import PHASES, STATEMENTS, made_up, made_up_audit

CLOSE = 1e-3


def ratio_over(dim, ratios, **others):
    """Results whose largest over smallest s along a dimension is given for each δA/δ0."""
    amplitudes = list(ratios)
    axes = {"normal_amplitude": amplitudes, **others, dim: [0.1, 0.2, 0.3]}
    results = made_up(lambda **_: xr.DataArray(0.1), **axes)
    for i, ratio in enumerate(ratios.values()):
        results.s[i, ..., 1] *= ratio
    return results


@pytest.mark.parametrize("apart", [-CLOSE, CLOSE])
def test_how_much_the_phase_matters(apart):
    assert STATEMENTS["small_amplitude_is_flat"](ratio_over("phase", {0.1: 1.1 + apart, 0.5: 9.0})).holds == (
        apart < 0
    )
    for bound, sense in ((1.5, 1), (2.0, -1)):
        finding = STATEMENTS["almost_a_factor_of_two"](ratio_over("phase", {8 / 9: bound + apart}))
        assert finding.holds == (sense * apart > 0)


@pytest.mark.parametrize("apart", [-CLOSE, CLOSE])
@pytest.mark.parametrize(("low", "high"), [(-0.1, 0.5), (-0.5, 0.1)])
def test_markedly_is_ten_percent_either_way(apart, low, high):
    moved = (1.0 + low - apart, 1.5) if high == 0.5 else (0.5, 1.0 + high + apart)
    both = made_up(lambda phase: 0 * phase, phase=[0.0, 1.0])
    both["s"] = both.s.copy(data=np.array(moved))
    # s = 1 at the 5/6 of Table 1, between two points of the archive.
    without = made_up(
        lambda normal_amplitude, tangential_amplitude: 1.2 * tangential_amplitude,
        normal_amplitude=[0.0],
        tangential_amplitude=[0.8, 0.9],
    )
    finding = STATEMENTS["oscillation_raises_and_lowers"](both, both, without)
    assert finding.holds == (apart > 0)
    assert finding.measured.startswith("s = 1.0000 without; with: ")
    assert f"{moved[1] - 1:+.0%} to {moved[0] - 1:+.0%} at one frequency" in finding.measured
    smooth = made_up(
        lambda normal_amplitude, phase: 1 + 0 * phase, normal_amplitude=[0.25, 0.75], phase=[0.0]
    )
    wavy = made_up(
        lambda normal_amplitude, waviness_amplitude: 0 * waviness_amplitude,
        normal_amplitude=[0.25, 0.75],
        waviness_amplitude=[0.01, 0.02],
    )
    wavy["s"] = wavy.s.copy(data=np.array([moved, (0.5, 1.5)]))
    assert STATEMENTS["waviness_raises_and_lowers"](smooth, wavy).holds == (apart > 0)


@pytest.mark.parametrize("apart", [-CLOSE, CLOSE])
def test_waviness_matters_from_twenty_percent_on_every_curve(apart):
    results = ratio_over("waviness_amplitude", {0.25: 1.2 + apart, 0.75: 3.0}, wavelength=[5.0, 6.0])
    assert STATEMENTS["waviness_matters"](results).holds == (apart > 0)


@pytest.mark.parametrize(("larger", "holds"), [(1.249, True), (1.251, False), (0.751, True), (0.749, False)])
def test_effects_are_alike_up_to_a_quarter(larger, holds):
    ratios = {0.25: math.exp(0.4), 0.75: math.exp(0.4 * larger)}
    finding = STATEMENTS["effects_are_alike"](ratio_over("waviness_amplitude", ratios, wavelength=[5.0, 6.0]))
    assert finding.holds == holds
    assert (
        f"0.40 at the smaller, {0.4 * larger:.2f} at the larger δA/δ0 ({larger - 1:+.0%};" in finding.measured
    )


@pytest.mark.parametrize(("shift", "holds"), [(0.505, True), (0.51, False)])
def test_curves_are_alike_up_to_half_of_the_effect(shift, holds):
    """Two cosines shifted by α: the distance 2 sin(α/2) cos, over cos, is 1/2 at α = 0.5054."""
    x = np.arange(200) / 200
    results = made_up(
        lambda normal_amplitude, waviness_amplitude: 0 * waviness_amplitude,
        normal_amplitude=[0.25, 0.75],
        waviness_amplitude=x,
    )
    curves = [1 + 0.1 * np.cos(2 * np.pi * x + angle) for angle in (0.0, shift)]
    results["s"] = results.s.copy(data=np.array([curves[0], 3.0 * curves[1]]))
    assert STATEMENTS["wavy_curves_are_alike"](results).holds == holds


@pytest.mark.parametrize("apart", [-CLOSE, CLOSE])
def test_poisson_ratio_is_weak_up_to_five_percent_among_metals(apart):
    """ν = 0.25 and 0.35 count, the values beyond do not."""
    ν = [0.2, 0.25, 0.3, 0.35, 0.4]
    results = made_up(lambda friction, poisson_ratio: 1 + 0 * poisson_ratio, friction=[0.3], poisson_ratio=ν)
    mean = 1 + (0.05 + apart) / 3
    for end in (1, 3):
        results.s[0] = 1.0
        results.s[0, end] = 1 + (0.05 + apart) * mean
        results.s[0, 0], results.s[0, 4] = 3.0, 0.1
        finding = STATEMENTS["poisson_ratio_is_weak"](results)
        assert finding.holds == (apart < 0)
        assert finding.measured.endswith("s(ν = 0.4)/s(0.2), μ = 0.3: 0.03")


@pytest.mark.parametrize(("bound", "test"), [(0.01, "rounded_punch"), (0.1, "truncated_paraboloid")])
@pytest.mark.parametrize("apart", [-CLOSE, CLOSE])
def test_coupling_as_a_share_of_the_variance(bound, test, apart):
    """ln s = b + cψ with ±1 for b and ψ: the share of the product is c²/(1 + c²)."""
    share = bound + apart
    c = math.sqrt(share / (1 - share))
    results = made_up(
        lambda profile, flat_radius, phase: np.exp(flat_radius + c * flat_radius * phase),
        profile=[test],
        flat_radius=[-1.0, 1.0],
        phase=[-1.0, 1.0],
    )
    coupled = {
        "rounded_punch": STATEMENTS["rounded_punch_uncoupled"],
        "truncated_paraboloid": STATEMENTS["truncated_paraboloid_weakly_coupled"],
    }[test](results)
    assert coupled.holds == (apart < 0)
    assert coupled.measured.startswith(f"{share:.1%} of the variance")


@pytest.mark.parametrize(("apart", "holds"), [(0.0199, True), (0.0201, False)])
def test_curves_that_cannot_be_told_apart(apart, holds):
    results = made_up(
        lambda phase, frequency_ratio, flat_radius: (
            (1 + phase) * (1 - flat_radius * (1 - apart * (frequency_ratio - 1)))
        ),
        phase=[0.0, 1.0],
        frequency_ratio=[1.0, 2.0],
        flat_radius=[0.0, 0.25, 0.5],
    )
    finding = STATEMENTS["curves_fall_alike"](results)
    assert finding.holds == holds
    assert finding.measured.endswith("all: 2%")


def test_a_change_within_both_errors_is_none():
    results = made_up(lambda friction: friction, friction=[0.1, 0.2, 0.3])
    results["s"] = results.s.copy(data=np.array([0.2, 0.21, 0.2]))
    for error, holds in ((0.0051, True), (0.0049, False)):
        results["s_error"] = 0 * results.s + error
        finding = STATEMENTS["rises_with_friction"](results)
        assert finding.holds == holds
    # Relative to s where the fall begins.
    assert (
        finding.measured
        == "s falls by up to 9.5e-04 from one value to the next, μ from 0.1 to 0.3 on 1 curves"
    )


def of_points(number=100, **values):
    """Results of so many points over the phase, all alike but for what is given of some."""
    results = made_up(lambda phase: 0 * phase, phase=np.linspace(0, 2, number))
    for name, (some, value) in values.items():
        results[name][:some] = value
    return results


@pytest.mark.parametrize(("some", "holds"), [(5, True), (6, False)])
def test_basically_all_are_95_of_100(some, holds):
    for angle, good in ((10.01, holds), (-10.01, holds), (10.0, True), (-10.0, True)):
        finding = STATEMENTS["normal_along_x"](of_points(critical_angle=(some, angle)))
        assert finding.holds == good
    finding = STATEMENTS["slips_partially"](of_points(regime=(some, 2)))
    assert finding.holds == holds
    assert finding.measured == f"of 100 points: partial slip {100 - some}.0%, gross slip {some}.0%"
    finding = STATEMENTS["on_the_line"](made_up_audit(100 - some, some))
    assert finding.holds == holds
    assert finding.measured == (
        f"at {100 - some}.0% of 100 random points of all parameters the worst of all points and planes is on "
        "the line; beneath the surface 0, on an oblique plane 0, on the surface off the line "
        f"{some}, with swt up to 4.0% higher, for ν ≥ 0.45"
    )


@pytest.mark.parametrize(("x", "holds"), [(1.101, True), (-1.101, True), (1.099, False), (-1.099, False)])
def test_well_outside_is_a_tenth_of_the_stick_zone(x, holds):
    """With δA = 0 the stick zone is Cattaneo's: c² = 1 − U."""
    results = made_up(lambda phase: 0 * phase, phase=np.linspace(0, 2, 20))
    results = results.assign_coords(
        profile="paraboloid",
        poisson_ratio=0.3,
        friction=0.3,
        normal_amplitude=0.0,
        frequency_ratio=1.0,
        tangential_amplitude=0.36,
    )
    results.critical_x[:] = 1.5 * 0.8
    results.critical_x[:2] = x * 0.8
    finding = STATEMENTS["outside_of_stick"](results)
    assert finding.holds == holds
    assert finding.measured == (
        "20 of 20 points have a zone of permanent stick; |x| ≥ 1.1 times its radius at "
        f"{1.0 if holds else 0.9:.1%}, outside at 100.0%; smallest {abs(x):.3f}, median 1.50"
    )


def test_on_the_bound_itself_a_statement_holds():
    """2 over a stick radius of 2/1.1, and 19 of 20 points: exactly the bounds."""
    results = of_points(20, critical_angle=(1, 90.0))
    assert STATEMENTS["normal_along_x"](results).holds
    exact = ratio_over("phase", {0.1: 1.1, 0.5: 9.0})
    assert STATEMENTS["small_amplitude_is_flat"](exact.assign(s=exact.s.round(3) * 10)).holds


ZIGZAG_H = np.array([0.0, 1.0, 3.0, 4.0, 4.5, 6.0, 10.0, 11.0])
ZIGZAG_S = np.array([1.5, 4.0, 1.0, 4.0, 3.5, 6.0, 0.0, 2.0])


def of_curves(*curves):
    """Figure 7 with these curves over the h of the zigzag, one of each wavelength."""
    axes = {"normal_amplitude": [0.25], "wavelength": np.arange(5.0, 5.0 + len(curves))}
    results = made_up(lambda **_: xr.DataArray(0.0), **axes, waviness_amplitude=ZIGZAG_H)
    return results.assign(s=results.s.copy(data=np.array([curves])))


def test_periods_and_swings_are_those_of_the_turning_points():
    """A zigzag: turns at 1, 3, 6, 10 with the values 4, 1, 6, 0; ripples below a tenth do not count."""
    finding = STATEMENTS["oscillations_shrink"](of_curves(ZIGZAG_S))
    assert finding.holds
    assert finding.measured == (
        "with h grow 1 of 1 periods and 1 of 1 swings on 1 curves; the longest series: period 5 to 7, "
        "swing 3 to 6"
    )
    backwards = STATEMENTS["oscillations_shrink"](of_curves(ZIGZAG_S, 6.0 - ZIGZAG_S, ZIGZAG_S[::-1]))
    assert backwards.measured.startswith("with h grow 3 of 3 periods and 2 of 3 swings on 3 curves;")
    assert not backwards.holds
    ripple = ZIGZAG_S.copy()
    ripple[4] = 3.3
    finding = STATEMENTS["oscillations_shrink"](of_curves(ripple))
    assert "2 of 3 periods and 1 of 3 swings" in finding.measured
    straight = STATEMENTS["oscillations_shrink"](of_curves(np.arange(8.0)))
    assert not straight.holds
    assert straight.measured == (
        "with h grow 0 of 0 periods and 0 of 0 swings on 1 curves; the longest series: period none, "
        "swing none"
    )


@pytest.mark.parametrize(("growing", "holds"), [(4, True), (3, False)])
def test_a_rule_holds_in_four_of_five_cases(growing, holds):
    curves = [ZIGZAG_S] * growing + [ZIGZAG_S[::-1]] * (5 - growing)
    assert STATEMENTS["oscillations_shrink"](of_curves(*curves)).holds == holds


def test_phases_that_fall_where_they_should_rise_are_counted():
    results = made_up(
        lambda profile, flat_radius, phase: 1 + flat_radius + 0 * phase,
        profile=["truncated_paraboloid"],
        flat_radius=[0.0, 1.0, 2.0],
        phase=PHASES[:4],
    )
    results.s[0, 2, 1] = 1.9
    finding = STATEMENTS["truncated_paraboloid_rises"](results)
    assert not finding.holds
    degrees = math.degrees(PHASES[1])
    assert finding.measured == (
        "mean over ψ, against b = 0, at b/a_H = 0: 1.00, 1: 2.00, 2: 2.73; the opposite at 1 of 4 phases, "
        f"by up to 5.0% (b/a_H = 1 to 2, ψ = {degrees:.1f}°)"
    )


def test_how_curves_that_fall_are_described():
    results = made_up(
        lambda flat_radius, phase, frequency_ratio: (
            (2 - flat_radius * (1 - 0.2 * phase)) + 0 * frequency_ratio
        ),
        flat_radius=[1.0, 0.0, 0.5],
        phase=[0.0, 1.0],
        frequency_ratio=[0.5, 1.0],
    )
    finding = STATEMENTS["all_curves_fall"](results)
    assert finding.holds
    assert finding.measured == "s rises nowhere; at b/a_H = 1 it is 0.50 to 0.60 of s at 0"
    results.s[1, 0, 0] = 1.0
    finding = STATEMENTS["all_curves_fall"](results)
    assert not finding.holds
    assert finding.measured.startswith("s rises by up to 5.0e-01 from one b to the next;")


def test_how_the_phases_of_figure_4_and_8_are_described():
    """s(π)/s(0) at the larger amplitude; by |ln| a half is as far from 1 as 2."""
    ratios = [0.25, 0.5, 1.0]
    results = made_up(
        lambda normal_amplitude, frequency_ratio, phase: 1 + 0 * phase,
        normal_amplitude=[0.75, 0.25],
        frequency_ratio=ratios,
        phase=[0.0, math.pi],
    )
    results.s[0, :, 1] = [1.9, 0.5, 1.0]
    results.s[1, :, 1] = [9.0, 1.0, 1.0]
    finding = STATEMENTS["half_differs_most"](results)
    assert finding.holds
    assert finding.measured == "s(π)/s(0) at ω2/ω1 = 1/4: 1.90, 1/2: 0.50, 1: 1.00"
    results.s[0, 0, 1] = 2.1
    assert not STATEMENTS["half_differs_most"](results).holds
    finding = STATEMENTS["amplitude_amplifies"](results)
    assert finding.measured == (
        "max/min over ψ; δA/δ0 = 0.75: ω2/ω1 = 1/4: 2.10, 1/2: 2.00, 1: 1.00; "
        "δA/δ0 = 0.25: ω2/ω1 = 1/4: 9.00, 1/2: 1.00, 1: 1.00"
    )
    wavy = made_up(
        lambda frequency_ratio, phase, waviness_amplitude: 1 + 0 * phase,
        frequency_ratio=ratios,
        phase=[0.0, math.pi],
        waviness_amplitude=[0.01, 0.02],
    )
    wavy.s[0, 1] = [math.e, 1.0]
    wavy.s[1, 1] = [math.exp(-1.1), 1.0]
    finding = STATEMENTS["half_differs_most_with_waviness"](wavy)
    assert finding.holds
    assert finding.measured == "mean over h of |ln s(π)/s(0)| at ω2/ω1 = 1/4: 0.50, 1/2: 0.55, 1: 0.00"


def test_how_waviness_is_described():
    results = ratio_over("waviness_amplitude", {0.25: 1.5, 0.75: 3.0}, wavelength=[5.0, math.sqrt(20)])
    finding = STATEMENTS["waviness_matters"](results)
    assert finding.measured == (
        "max/min over h/δ0: λ/√(hR) = √20: 1.50/3.00, 5: 1.50/3.00 (δA/δ0 = 0.25/0.75)"
    )
