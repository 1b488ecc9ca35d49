"""Figures that designers read: lives in decades, S–N-like curves, maps with the regimes."""

import numpy as np
import pytest
from drawn import draw, keys
from folders import RESULTS
from made_up import made_up
from solved import REGIMES

import swtstudy
from swtstudy import Study, open_results

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

AMPLITUDE, FRICTION = np.linspace(0.1, 1.0, 19), np.linspace(0.1, 0.9, 17)


@pytest.fixture
def results():
    """N = 10⁵ μ/u⁴; partial slip below u = μ, gross slip above."""
    dataset = made_up(
        lambda friction, tangential_amplitude: friction + 0 * tangential_amplitude,
        friction=FRICTION,
        tangential_amplitude=AMPLITUDE,
    )
    amplitude = dataset.tangential_amplitude
    cycles = 1e5 * dataset.friction / amplitude**4
    regime = regime_of(amplitude > dataset.friction + 1e-9).transpose(*dataset.s.dims)
    regime.attrs |= {"flag_values": np.arange(len(REGIMES)), "flag_meanings": " ".join(REGIMES)}
    return dataset.assign(cycles=cycles.assign_attrs(symbol="N"), regime=regime)


def regime_of(gross):
    return gross * (REGIMES.index("gross_slip") - 1) + 1


def test_lives_are_in_decades(results):
    (axes,) = draw(results.isel(friction=0), keys("tangential_amplitude", y=("cycles",))).axes
    assert (axes.get_xscale(), axes.get_yscale()) == ("linear", "log")
    short = results.isel(friction=0).assign(
        cycles=lambda found: (1e-6 * found.cycles).assign_attrs(found.cycles.attrs)
    )
    assert draw(short, keys("tangential_amplitude", y=("cycles",))).axes[0].get_yscale() == "log"
    (axes,) = draw(results.isel(friction=0), keys("tangential_amplitude")).axes
    assert axes.get_yscale() == "linear"


def test_a_map_of_lives_has_decades_and_the_border_of_regimes(results):
    layout = keys("tangential_amplitude", y=("cycles",), kind="contour", vertical="friction", regimes=True)
    axes, bar = draw(results, layout).axes
    outline, *_, filled, _ = axes.collections
    # From 10⁴ to 9·10⁸.
    np.testing.assert_allclose(filled.levels, 10.0 ** np.arange(4, 10))
    assert next(text.get_text() for text in bar.get_yticklabels()) == "$10^{4}$"
    names = {text.get_text(): text.get_position() for text in axes.texts if " slip" in text.get_text()}
    assert set(names) == {"partial slip", "gross slip"}
    for words, (amplitude, friction) in names.items():
        assert (amplitude > friction) == (words == "gross slip")
    border = np.concatenate([path.vertices for path in outline.get_paths() if len(path)])
    # Within half a step of the points, and no staircase: away from the frame as straight as u = μ.
    inner = border[(border > 0.2).all(axis=1) & (border < 0.8).all(axis=1)]
    assert len(inner) > 5
    assert np.ptp(inner[:, 0] - inner[:, 1]) < 0.02
    assert np.abs(inner[:, 0] - inner[:, 1]).max() < 0.05
    plain = draw(results, {**layout, "regimes": False}).axes[0]
    assert not [text for text in plain.texts if "slip" in text.get_text()]


def test_the_map_of_forces_ends_where_the_contact_slides():
    study = Study.from_toml("fretting_map")
    found = open_results(RESULTS / "fretting_map.nc").stack(
        point=["tangential_force_amplitude", "normal_force"]
    )
    slides = found.tangential_force_amplitude > 0.5 * found.normal_force + 1e-9
    assert (found.regime == REGIMES.index("no_equilibrium")).equals(
        slides.drop_vars("regime", errors="ignore")
    )
    assert found.cycles.isnull().equals(slides)
    at = {"tangential_force_amplitude": 40.0, "normal_force": 100.0}
    fixed = {
        name: study.grid.fixed[name] for name in ("young_modulus", "poisson_ratio", "radius", "friction")
    }
    alone = swtstudy.physical(**fixed, **at).solve(rtol=1e-4)
    np.testing.assert_allclose(found.SWT.sel(**at).item(), alone.SWT[0], rtol=1e-3)


def test_values_over_critical_distances_are_logarithmic():
    distance = np.geomspace(0.001, 0.1, 5)
    dataset = made_up(lambda friction: friction, friction=[0.3]).isel(friction=0)
    means = dataset.s.expand_dims(critical_distance=distance).rename("s_volume") / (1 + 30 * distance)
    (axes,) = draw(dataset.assign(s_volume=means), keys("critical_distance", y=("s_volume",))).axes
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 0.3 / (1 + 30 * distance))


@pytest.mark.parametrize(("amplitudes", "plain"), [([0.1, 0.4, 1.6], True), ([0.01, 0.1, 1.0, 10.0], False)])
def test_amplitudes_in_equal_ratios_are_in_decades_of_their_own(amplitudes, plain):
    results = made_up(lambda tangential_amplitude: tangential_amplitude, tangential_amplitude=amplitudes)
    (axes,) = draw(results, keys("tangential_amplitude", kind="life")).axes
    assert axes.get_yscale() == "log"
    np.testing.assert_allclose(axes.get_ylim(), (amplitudes[0], amplitudes[-1]), rtol=0.3)
    words = axes.yaxis.get_major_formatter()(0.2, 0)
    assert (words == "0.2") == plain
