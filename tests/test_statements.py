"""Statements on made-up results that hold and that do not, and the command that checks them."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from click.testing import CliRunner

from swtstudy import Study, run
from swtstudy.cli import main
from swtstudy.labelled import ATTRIBUTES
from swtstudy.statements import (
    critical_point,
    figure3,
    figure4,
    figure5,
    figure6,
    figure7,
    figure8,
    parameters,
)
from swtstudy.statements.check import STATEMENTS, STUDIES, check
from swtstudy.statements.measures import coupling, largest_fall, largest_rise, period, turning_points
from swtstudy.statements.report import markdown, summary, terminal_table
from swtstudy.statements.select import NotInArchiveError, at
from swtstudy.statements.stick_zone import stick_radius
from tests import stand_in

PHASES = np.linspace(0, 2 * np.pi, 49)
FOLDER = Path(__file__).parent.parent / "studies"
RATIOS = [0.25, 0.5, 1.0, 1.5, 2.0]
H = np.geomspace(0.002, 0.05, 201)


def made_up(function: Callable[..., xr.DataArray], **axes: object) -> xr.Dataset:
    """Results with s = function(axes), and everything else as it usually is."""
    arrays = {name: xr.DataArray(np.atleast_1d(values), dims=name) for name, values in axes.items()}
    coords = {name: array.values for name, array in arrays.items()}
    s = sum((0 * array for array in arrays.values() if array.dtype.kind == "f"), function(**arrays))
    for name in axes:
        s = s if name in s.dims else s.expand_dims({name: coords[name]})
    s = s.assign_coords(coords).transpose(*axes)
    zero = xr.zeros_like(s)
    return xr.Dataset(
        {"s": s, "s_error": zero + 1e-6, "critical_x": zero + 1, "critical_angle": zero, "regime": zero + 1}
    )


def test_measures():
    curve = made_up(lambda friction: friction**2, friction=[0.1, 0.2, 0.3])
    assert largest_fall(curve, "friction") == 0
    assert largest_rise(curve, "friction") == pytest.approx(3, abs=1e-3)
    assert largest_fall(curve.isel(friction=[2, 0, 1]), "friction") == 0
    product = made_up(
        lambda friction, phase: friction * (2 + np.cos(phase)), friction=[1.0, 2.0], phase=PHASES
    )
    assert coupling(product.s, "friction") < 1e-20
    coupled = made_up(lambda friction, phase: 2 + np.cos(friction * phase), friction=[1.0, 2.0], phase=PHASES)
    assert coupling(coupled.s, "friction") > 0.3


@pytest.mark.parametrize("waves", [1, 2, 3, 4, 6])
def test_the_period_is_found_with_kinks_and_without(waves):
    assert period(2 + np.cos(waves * PHASES)) == pytest.approx(2 * np.pi / waves)
    assert period(2 + abs(np.cos(waves * PHASES / 2 - 0.3))) == pytest.approx(2 * np.pi / waves)


def test_a_constant_has_no_period():
    assert period(np.ones(49)) == math.inf


def test_turning_points_leave_out_ripples_and_ends():
    x = np.linspace(0, 6 * np.pi, 601)
    curve = np.sin(x) + 0.01 * np.sin(40 * x)
    assert x[turning_points(curve, 0.2)] == pytest.approx(np.pi * np.arange(0.5, 6), abs=0.1)
    assert turning_points(x, 0.2) == []


def of_amplitude(depth: float) -> xr.Dataset:
    amplitudes = [0.1, 0.5, 8 / 9]
    return made_up(
        lambda normal_amplitude, phase: 1 + depth * normal_amplitude**2 * np.sin(phase),
        normal_amplitude=amplitudes,
        phase=PHASES,
    )


@pytest.mark.parametrize(("depth", "holds"), [(0.35, True), (0.2, False), (0.5, False)])
def test_almost_a_factor_of_two(depth, holds):
    finding = figure3.almost_a_factor_of_two(of_amplitude(depth))
    assert finding.holds == holds
    reached = (1 + depth * (8 / 9) ** 2) / (1 - depth * (8 / 9) ** 2)
    assert finding.measured.endswith(f"{reached:.2f}")


def test_the_phase_matters_little_at_small_amplitudes():
    assert figure3.small_amplitude_is_flat(of_amplitude(0.3)).holds
    assert not figure3.small_amplitude_is_flat(of_amplitude(0.9).isel(normal_amplitude=[1, 2])).holds
    assert figure3.phase_matters_more_with_amplitude(of_amplitude(0.3)).holds
    assert not figure3.phase_matters_more_with_amplitude(of_amplitude(0.0)).holds


@pytest.mark.parametrize(("low", "high", "holds"), [(0.8, 1.3, True), (0.95, 1.3, False), (0.8, 1.05, False)])
def test_a_normal_oscillation_raises_and_lowers(low, high, holds):
    s = {0.0: low, math.pi: high}
    both = made_up(lambda phase: xr.where(phase > 1, s[math.pi], s[0.0]), phase=[0.0, math.pi])
    without = made_up(
        lambda normal_amplitude, tangential_amplitude: tangential_amplitude * 1.2,
        normal_amplitude=[0.0],
        tangential_amplitude=[0.8, 0.9],
    )
    assert figure3.oscillation_raises_and_lowers(both, both, without).holds == holds


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
    assert not figure4.prominent_among_all(deep_one).holds
    assert figure4.prominent_among_different(deep_one).holds
    deep_two = of_ratio({0.25: 0.3, 0.5: 0.5, 1.0: 0.1, 1.5: 0.3, 2.0: 0.4}, ORDERS)
    assert not figure4.prominent_among_different(deep_two).holds
    others = of_ratio({2 / 3: 0.1, 0.75: 0.2}, {2 / 3: 4, 0.75: 3})
    assert figure4.others_matter_little(deep_one, others).holds
    others = of_ratio({2 / 3: 0.1, 0.75: 0.35}, {2 / 3: 4, 0.75: 3})
    assert not figure4.others_matter_little(deep_one, others).holds


def test_periods():
    depths = dict.fromkeys(RATIOS, 0.3)
    shrinking = of_ratio(depths, ORDERS)
    finding = figure4.period_shrinks(shrinking)
    assert finding.holds
    assert finding.measured.endswith("1/4: 2π, 1/2: 2π, 1: π, 3/2: 2π/3, 2: π/2")
    assert not figure4.period_shrinks(of_ratio(depths, {**ORDERS, 2.0: 2})).holds
    others = of_ratio({2 / 3: 0.1}, {2 / 3: 4})
    assert not figure4.period_shrinks_everywhere(shrinking, others).holds


def test_a_larger_normal_oscillation_amplifies():
    results = of_ratio(dict.fromkeys(RATIOS, 0.3), ORDERS)
    assert figure4.amplitude_amplifies(results).holds
    assert figure4.amplitude_amplifies(results.isel(normal_amplitude=[1, 0])).holds
    swapped = results.assign_coords(normal_amplitude=[0.75, 0.25])
    assert not figure4.amplitude_amplifies(swapped).holds


def test_the_phases_differ_most_at_one_half():
    assert figure4.half_differs_most(of_ratio({0.25: 0.2, 0.5: 0.5, 1.5: 0.3}, ORDERS)).holds
    assert not figure4.half_differs_most(of_ratio({0.25: 0.6, 0.5: 0.5, 1.5: 0.3}, ORDERS)).holds


def of_face(rounded: float, truncated: float, coupled: float = 0.0) -> xr.Dataset:
    def s(profile: xr.DataArray, flat_radius: xr.DataArray, phase: xr.DataArray) -> xr.DataArray:
        slope = xr.where(profile == "rounded_punch", rounded, truncated)
        return np.exp(slope * flat_radius) * (2 + np.cos(phase * (1 + coupled * flat_radius)))

    profiles = ["rounded_punch", "truncated_paraboloid"]
    return made_up(s, profile=profiles, flat_radius=[0.0, 1.0, 2.0], phase=PHASES)


def test_the_face_of_the_punch():
    good, bad = of_face(-0.3, 0.3), of_face(0.01, -0.01)
    for statement in figure5.STATEMENTS:
        assert statement.test(good).holds, statement.sentence
    for statement in figure5.STATEMENTS[:2]:
        assert not statement.test(bad).holds, statement.sentence
    for statement in figure5.STATEMENTS[2:]:
        assert not statement.test(of_face(-0.3, 0.3, coupled=0.5)).holds, statement.sentence


def test_a_fall_within_the_error_is_none():
    results = of_face(-0.3, -1e-9)
    assert figure5.truncated_paraboloid_rises(results).holds
    results["s_error"] = 0 * results.s_error
    finding = figure5.truncated_paraboloid_rises(results)
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
    assert figure6.curves_are_alike(results).holds == holds
    assert figure6.all_curves_fall(results).holds
    assert figure6.loads_do_not_couple(results).holds
    rising = results.assign_coords(flat_radius=2 - results.flat_radius)
    assert not figure6.all_curves_fall(rising).holds


def wave(h: xr.DataArray, power: float, shift: float = 0.0) -> xr.DataArray:
    return 0.15 + 0.05 * (h / 0.05) ** power * np.cos(2 / np.sqrt(h) + shift)


def of_waviness(power: float, shift: float) -> xr.Dataset:
    return made_up(
        lambda normal_amplitude, wavelength, waviness_amplitude: wave(
            waviness_amplitude, power, shift * normal_amplitude
        ),
        normal_amplitude=[0.25, 0.75],
        wavelength=[4.5, 5.5],
        waviness_amplitude=H,
    )


def test_waviness():
    good = of_waviness(0.5, 0.0)
    for test in (figure7.waviness_matters, figure7.effects_are_alike, figure7.curves_are_alike):
        assert test(good).holds
    assert figure7.oscillations_shrink(good).holds
    assert not figure7.oscillations_shrink(of_waviness(-0.5, 0.0)).holds
    assert not figure7.curves_are_alike(of_waviness(0.5, 4.0)).holds
    flat = made_up(
        lambda normal_amplitude, wavelength, waviness_amplitude: 0.15 + waviness_amplitude * normal_amplitude,
        normal_amplitude=[0.25, 0.75],
        wavelength=[4.5, 5.5],
        waviness_amplitude=H,
    )
    for test in (figure7.waviness_matters, figure7.effects_are_alike, figure7.oscillations_shrink):
        assert not test(flat).holds


@pytest.mark.parametrize(("smooth", "holds"), [(0.15, True), (0.11, False)])
def test_waviness_raises_and_lowers(smooth, holds):
    paraboloid = made_up(
        lambda normal_amplitude, phase: smooth + 0 * phase, normal_amplitude=[0.25, 0.75], phase=[0.0]
    )
    assert figure7.waviness_raises_and_lowers(paraboloid, of_waviness(0.5, 0.0)).holds == holds


def test_waviness_and_frequency_ratio():
    def s(
        phase: xr.DataArray, frequency_ratio: xr.DataArray, waviness_amplitude: xr.DataArray
    ) -> xr.DataArray:
        load = xr.where((frequency_ratio == 0.5) & (phase > 1), 0.5, 1 + frequency_ratio)
        return load * wave(waviness_amplitude, 0.5)

    axes = {"phase": [0.0, math.pi], "frequency_ratio": RATIOS, "waviness_amplitude": H}
    good = made_up(s, **axes)
    for statement in figure8.STATEMENTS:
        assert statement.test(good).holds, statement.sentence
    coupled = made_up(
        lambda phase, frequency_ratio, waviness_amplitude: wave(
            waviness_amplitude, -0.2, frequency_ratio * (1 + phase)
        ),
        **axes,
    )
    for statement in figure8.STATEMENTS:
        assert not statement.test(coupled).holds, statement.sentence


def test_parameters():
    rising = made_up(lambda profile, friction: friction, profile=["paraboloid"], friction=[0.1, 0.2, 0.3])
    assert parameters.rises_with_friction(rising).holds
    rising.s[0, 2] = 0.15
    assert not parameters.rises_with_friction(rising).holds
    axes = {"friction": [0.1, 0.3], "poisson_ratio": np.linspace(0, 0.5, 11)}
    weak = made_up(lambda friction, poisson_ratio: 1 + 0.01 * np.sin(20 * poisson_ratio), **axes)
    assert parameters.poisson_ratio_is_weak(weak).holds
    assert parameters.poisson_ratio_is_intricate(weak).holds
    strong = made_up(lambda friction, poisson_ratio: 1 - poisson_ratio, **axes)
    assert not parameters.poisson_ratio_is_weak(strong).holds
    assert not parameters.poisson_ratio_is_intricate(strong).holds


def located(profile: str = "paraboloid", **shape: float) -> xr.Dataset:
    results = made_up(lambda phase: 1 + phase, phase=[0.0, math.pi / 2])
    table = {
        "poisson_ratio": 0.3,
        "friction": 0.3,
        "normal_amplitude": 0.75,
        "frequency_ratio": 1.0,
        "tangential_amplitude": 5 / 6,
        "profile": profile,
    }
    return results.assign_coords({**table, **shape})


def test_the_radius_of_permanent_stick():
    # Table 1: u + δ ≥ 1 − 19/12 and u − δ ≤ −1 + 1/12 for ψ = 0, so G_s = 1/6; for ψ = π/2 all slides.
    np.testing.assert_allclose(stick_radius(located()), [math.sqrt(1 / 6), 0], rtol=1e-9)
    np.testing.assert_allclose(stick_radius(located("rounded_punch", flat_radius=0.0)), [math.sqrt(1 / 6), 0])
    punch = stick_radius(located("truncated_paraboloid", flat_radius=0.5)).values
    assert punch[0] ** 2 * (punch[0] ** 2 - 0.25) == pytest.approx(1 / 36)
    assert punch[1] == 0


@pytest.mark.parametrize(("x", "holds"), [(-1.0, True), (0.42, False), (0.1, False)])
def test_the_critical_point_lies_outside_of_stick(x, holds):
    results = located()
    results["critical_x"] = results.critical_x * x
    finding = critical_point.outside_of_stick(results, results)
    assert finding.holds == holds
    assert finding.measured.startswith("2 of 4 points")


@pytest.mark.parametrize(("angle", "holds"), [(-9.0, True), (12.0, False)])
def test_the_critical_plane(angle, holds):
    results = located()
    results["critical_angle"] = results.critical_angle + angle
    assert critical_point.normal_along_x(results).holds == holds


@pytest.mark.parametrize(("regime", "holds"), [(1, True), (2, False)])
def test_the_regime(regime, holds):
    results = located()
    results["regime"] = results.regime * regime
    finding = critical_point.slips_partially(results)
    assert finding.holds == holds
    assert ATTRIBUTES["regime"]["flag_meanings"].split()[regime].replace("_", " ") in finding.measured


def test_what_an_archive_lacks_is_named():
    with pytest.raises(NotInArchiveError, match="no normal_amplitude = 8/9"):
        at(of_amplitude(0.3).isel(normal_amplitude=[0, 1]), normal_amplitude=8 / 9)
    with pytest.raises(NotInArchiveError, match="no axis phase"):
        figure3.small_amplitude_is_flat(of_amplitude(0.3).isel(phase=0))


def test_missing_archives_are_named_with_the_command_that_makes_them(tmp_path):
    result = CliRunner().invoke(main, ["check", "--results", str(tmp_path)])
    assert result.exit_code == 2
    assert f"{len(STATEMENTS)} not checked" in result.stdout
    for name in STUDIES:
        assert f"{tmp_path / name}.nc is missing; made by: swtstudy run studies/{name}.toml" in result.stderr
    assert "swtstudy run --all" in result.stderr
    assert not list(tmp_path.iterdir())


def test_all_archives_make_a_table(tmp_path):
    for name in STUDIES:
        study = Study.from_toml(FOLDER / f"{name}.toml")
        run(study, tmp_path / f"{name}.nc", solver=stand_in.smooth, workers=1)
    result = CliRunner().invoke(main, ["check", "--results", str(tmp_path)])
    assert result.exit_code == 0, result.output
    table = (tmp_path / "statements.md").read_text(encoding="utf-8")
    rows = [line for line in table.splitlines() if line.startswith("| ")][1:]
    assert len(rows) == len(STATEMENTS)
    assert all(row.count(" | ") >= 4 for row in rows)
    assert summary(check(tmp_path)) in table


def test_tables_fit():
    outcomes = check("nowhere")
    assert max(map(len, terminal_table(outcomes, 100).splitlines())) <= 100
    assert "**not checked**" in markdown(outcomes)
