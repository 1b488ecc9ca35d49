import re
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import call
from solved import REGIMES
from told import refused

from swtstudy import Study, StudyError, open_results, run, sensitivity

STUDY = """
title = "Ishigami"
[sample]
design = "saltelli"
size = {size}
seed = 2
[sample.ranges]
friction = [0, 1]
poisson_ratio = [0, 0.5]
tangential_amplitude = [0, 2]
[axes]
normal_amplitude = [0.25, 0.5]
"""


def ishigami(points, rtol):
    """Ishigami's function of three parameters mapped to [-π, π], times 4 normal_amplitude, and positive."""
    one, two, three = (
        np.pi * (2.0 * np.asarray(unit) - 1.0)
        for unit in (points.friction, points.poisson_ratio / 0.5, points.tangential_amplitude / 2.0)
    )
    value = np.sin(one) + 7.0 * np.sin(two) ** 2 + 0.1 * three**4 * np.sin(one)
    value = 4.0 * points.normal_amplitude * value
    plain = stand_in.smooth(points, rtol)
    return plain._replace(s=value + 60.0, critical_x=2.0 * points.friction + points.poisson_ratio)


#: Variance 1/2 + 7²/8 + 0.1 π⁴/5 + 0.1² π⁸/18 and its parts.
PARTS = np.array([0.5 * (1.0 + 0.1 * np.pi**4 / 5.0) ** 2, 49.0 / 8.0, 0.0])
BOTH = 0.01 * np.pi**8 * (1.0 / 18.0 - 1.0 / 50.0)
VARIANCE = PARTS.sum() + BOTH
FIRST = PARTS / VARIANCE
TOTAL = (PARTS + np.array([BOTH, 0.0, BOTH])) / VARIANCE


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    path = tmp_path_factory.mktemp("r") / "ishigami.nc"
    path.with_suffix(".toml").write_text(STUDY.format(size=1024))
    run(Study.from_toml(path.with_suffix(".toml")), path, workers=1, solver=ishigami)
    return open_results(path).assign_attrs(path=path)


@pytest.fixture
def told(monkeypatch):
    """What `swtstudy sensitivity` prints of a study, and the figure that it draws."""
    drawn = []
    monkeypatch.setattr("swtstudy.figures.style.save_figure", lambda figure, path: drawn.append(figure))

    def command(study, *options):
        result = call("sensitivity", study, "--results", Path(study).parent, "--workers", 1, *options)
        assert result.exit_code == 0, result.output
        return result.output, drawn[-1]

    return command


@pytest.fixture(scope="module")
def indices(results):
    return sensitivity(results, ["s", "critical_x"])


def test_rough_indices_are_told_with_the_size_that_is_needed(tmp_path):
    """Of 1,024 points they are not."""
    found = run(Study.from_text(STUDY.format(size=16)), tmp_path / "a.nc", workers=1, solver=ishigami)
    with pytest.warns(UserWarning, match=r"known to ±(0\.\d+) only, and may be below 0 or above 1") as told:
        indices = sensitivity(found)
    half, size, allowed = map(float, re.findall(r"[\d.]+\d", str(told[0].message)))
    widths = [indices[f"{name}_high"] - indices[f"{name}_low"] for name in ("first_order", "total")]
    assert half == pytest.approx(0.5 * max(float(width.max()) for width in widths), rel=0.01)
    assert allowed == 0.2
    assert 1.0 <= size / (16.0 * (half / allowed) ** 2) < 2.1


def test_the_indices_of_a_function_whose_indices_are_known(indices):
    of_s = indices.sel(quantity="s")
    assert of_s.first_order.dims == ("normal_amplitude", "parameter")
    assert of_s.parameter.values.tolist() == ["friction", "poisson_ratio", "tangential_amplitude"]
    assert of_s.total.attrs["comment"] == "share of the variance by this parameter, alone and with others"
    # 1,024 points have a standard error of 0.02 to 0.05: the widths of the confidence intervals.
    for place in range(2):
        assert of_s.first_order[place].values == pytest.approx(FIRST, abs=0.03)
        assert of_s.total[place].values == pytest.approx(TOTAL, abs=0.03)
    # The size of a quantity does not matter, that of its variance is known.
    assert np.allclose(of_s.first_order[0], of_s.first_order[1], rtol=1e-6)
    assert of_s.variance.values == pytest.approx([VARIANCE, 4.0 * VARIANCE], rel=0.02)
    assert of_s["mean"].values == pytest.approx([63.5, 67.0], rel=0.005)


def test_the_indices_of_another_data_variable(indices):
    # 2 μ + ν, of which the ranges are 1 and 1/2: variances as 2² and (1/2)².
    of_x = indices.sel(quantity="critical_x").isel(normal_amplitude=0)
    share = np.array([4.0, 0.25, 0.0]) / 4.25
    assert of_x.first_order.values == pytest.approx(share, abs=0.01)
    assert of_x.total.values == pytest.approx(share, abs=0.01)


def test_the_known_indices_are_in_the_confidence_intervals(indices, results):
    of_s = indices.sel(quantity="s").isel(normal_amplitude=0)
    for name, known in (("first_order", FIRST), ("total", TOTAL)):
        low, high = of_s[f"{name}_low"].values, of_s[f"{name}_high"].values
        assert (low <= of_s[name]).all()
        assert (of_s[name] <= high).all()
        assert (low <= known + 1e-12).all()
        assert (known - 1e-12 <= high).all()
        assert (high - low).max() < 0.25
    half = sensitivity(results, confidence=0.5).isel(quantity=0, normal_amplitude=0)
    width, wide = (each.total_high - each.total_low for each in (half, of_s))
    assert (width < 0.6 * wide).isel(parameter=[0, 1]).all()


@pytest.mark.slow
def test_the_same_seed_gives_the_same(results, indices):
    again = sensitivity(results, "critical_x")
    assert again.identical(indices.sel(quantity=["critical_x"]))
    other = sensitivity(results, seed=1).isel(quantity=0)
    assert np.array_equal(other.first_order, indices.first_order.isel(quantity=0))
    assert not np.array_equal(other.first_order_low, indices.first_order_low.isel(quantity=0))


def test_points_without_a_number_are_refused_by_name(results):
    broken = results.copy(deep=True)
    broken.s[7, 1] = np.inf
    broken.s[9, 1] = np.nan
    broken.regime[7, 1] = REGIMES.index("not_finite")
    friction = float(broken.friction[7])
    error = refused("", sensitivity, broken, ["critical_x", "s"])
    assert f"s: found no number at 2 of {results.s.size} points, such as friction={friction:.4g}, " in str(
        error
    )
    assert "normal_amplitude=0.5 (not finite)" in str(error)
    assert len(error.mistakes) == 1
    assert sensitivity(broken, "critical_x").first_order.notnull().all()


def test_a_variable_that_is_no_number_is_refused(results):
    refused("y: found 'regime', which is no number", sensitivity, results, y="regime")


def test_other_samples_are_refused(results, tmp_path):
    for part in (results.isel(sample=slice(100)), results.isel(sample=slice(None, None, -1))):
        refused(r"^sample: found .*; allowed: all points of a saltelli design", sensitivity, part)
    other = Study.from_text(STUDY.format(size=8).replace("saltelli", "sobol"))
    with pytest.raises(StudyError, match=r"sample.design: found the design sobol"):
        sensitivity(run(other, tmp_path / "a.nc", workers=1, solver=ishigami))


RIG = """
title = "What matters for the life of a rig, of which the names of all that varies make a very long title"
rtol = 1e-2
units = {length = "mm", force = "N", stress = "MPa"}
fixed = {young_modulus = 73e3, poisson_ratio = 0.33, radius = 50, friction = 0.5, bulk_stress_amplitude = 5}
[sample]
design = "saltelli"
size = 2
[sample.ranges]
normal_force = [100, 200]
tangential_force_amplitude = [20, 40]
[axes]
normal_force_amplitude = [0, 20]
"""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:indices are known to")
def test_a_study_with_units_has_its_own_symbols(tmp_path, told):
    (tmp_path / "mine.toml").write_text(RIG)
    text, figure = told(tmp_path / "mine.toml")
    assert "## SWT, normal_force_amplitude = 20 N, body = 2\n" in text
    assert "| F0 normal_force |" in text
    figure.draw_without_rendering()
    axes = figure.axes[0]
    assert [text.get_text() for text in axes.get_xticklabels()] == ["$F_0$", "$Q_A$"]
    assert figure.axes[-1].get_title(loc="left") == r"$F_A$ = 20 N, $\mathrm{body}$ = 2"
    box = figure._suptitle.get_window_extent()
    assert box.x0 >= 0.0
    assert box.x1 <= figure.bbox.width
    one_axis = RIG.replace("normal_force_amplitude = [0, 20]", "body = [1]")
    (tmp_path / "narrow.toml").write_text(one_axis)
    _, narrow = told(tmp_path / "narrow.toml")
    narrow.draw_without_rendering()
    box = narrow._suptitle.get_window_extent()
    assert box.x0 >= 0.0
    assert box.x1 <= narrow.bbox.width


def test_one_parameter_has_no_share():
    design = {"design": "saltelli", "parameters": "friction", "size": 2}
    dataset = xr.Dataset(coords={"sample": ("sample", np.arange(6), design)})
    refused(r"^sample\.ranges: found friction; allowed: at least two par", sensitivity, dataset)
