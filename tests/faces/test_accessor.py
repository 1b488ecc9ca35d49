"""ds.swt on results of solve, run and open_results, before and after xarray's own operations."""

import inspect
import json
import re
import subprocess
import sys

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import call
from folders import STUDIES
from made_up import PANELS, made_up
from told import RIG

import swtstudy
from swtstudy import Study, StudyError, run

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    path = tmp_path_factory.mktemp("archive") / "study.nc"
    run(Study.from_text(PANELS), path, solver=stand_in.smooth)
    return path


@pytest.fixture
def dataset(archive):
    return swtstudy.open_results(archive)


def test_slices_are_written_as_in_a_study(dataset):
    one = dataset.swt.slice(phase="pi", frequency_ratio="3/2", flat_radius=0.5)
    assert one.s.item() == dataset.s.values[1, 2, 1]
    assert one.phase.item() == np.pi
    several = dataset.swt.slice(frequency_ratio=["3/2", 0.5])
    assert several.frequency_ratio.values.tolist() == [1.5, 0.5]
    # A scalar coordinate may be named too; it must be the value.
    assert one.swt.slice(phase="pi", profile="rounded_punch").identical(one)
    assert dataset.swt.slice(phase=3.1, tolerance=0.1).phase.item() == np.pi


def test_a_name_is_offered_as_it_is_typed_and_taken_as_a_figure_has_it(dataset):
    assert dataset.swt.slice(profile="rounded punch").profile.item() == "rounded_punch"
    assert "fixed          profile: rounded_punch" in repr(dataset.swt)
    with pytest.raises(
        StudyError, match=r"profile: found 'rounded punsh' .no such profile.; allowed: rounded_punch$"
    ):
        dataset.swt.slice(profile="rounded punsh")


def test_results_of_which_a_part_is_masked_are_described(dataset):
    masked = dataset.where(dataset.s > dataset.s.mean())
    count = int(masked.s.count())
    assert f"  complete       {count} computed" in repr(masked.swt)
    assert repr(dataset.where(dataset.s < 0.0).swt)


def test_a_coordinate_in_another_unit_is_no_contact_of_the_study():
    rig = swtstudy.physical(**RIG, normal_force=200.0, tangential_force_amplitude=[60.0, 80.0])
    solved = rig.solve(1e-2)
    loads = solved.tangential_force_amplitude
    named = solved.assign_coords(tangential_force_amplitude=loads.assign_attrs(units="N"))
    assert named.swt.slice(tangential_force_amplitude="60 N").tangential_force_amplitude == 60.0
    other = solved.assign_coords(tangential_force_amplitude=(loads / 1e3).assign_attrs(units="kN"))
    with pytest.raises(StudyError, match="attribute units of tangential_force_amplitude: found 'kN'"):
        other.swt.contact()
    with pytest.raises(StudyError, match=r"found '60 kN' .*; allowed: 60, 80"):
        solved.swt.slice(tangential_force_amplitude="60 kN")


def test_values_are_told_apart_at_any_scale(dataset):
    tiny = dataset.assign_coords(phase=[5.62e-7, 1e-15])
    with pytest.raises(ValueError, match="found 5e-07, which is not in these results"):
        tiny.swt.slice(phase=5e-7)
    assert tiny.swt.slice(phase=5.6200001e-7).phase.item() == 5.62e-7
    # But rounding makes no value of 0.
    assert tiny.swt.slice(phase=0).phase.item() == 1e-15
    with pytest.raises(ValueError, match="found 0, which is not in these results"):
        dataset.assign_coords(phase=[1e-7, 1.0]).swt.slice(phase=0)


def test_normalised_is_s_over_s_there(dataset):
    ratio = dataset.swt.normalised("b=0")
    np.testing.assert_array_equal(ratio, dataset.s / dataset.s.isel(flat_radius=0).drop_vars("flat_radius"))
    xr.testing.assert_identical(ratio, dataset.swt.normalised("flat_radius=0"))
    assert dataset.swt.normalised("ψ=pi").dims == dataset.s.dims
    with pytest.raises(ValueError, match="not in these results"):
        dataset.swt.normalised("b=3")


def test_a_list_of_points_is_normalised_by_one_of_them():
    points = {"phase": [0.1, 0.2, 0.1, 0.3], "friction": [0.3, 0.4, 0.5, 0.3]}
    listed = swtstudy.solve(rtol=1e-2, **{name: xr.DataArray(own, dims="k") for name, own in points.items()})
    ratio = listed.swt.normalised("friction=0.4")
    np.testing.assert_array_equal(ratio, listed.s / listed.s.values[1])
    with pytest.raises(StudyError, match=r"found 2 points with friction = 0.3, of a list .*one such point"):
        listed.swt.normalised("friction=0.3")


@pytest.mark.usefixtures("without_points")
def test_errors_of_ratios_add_up(archive, dataset, tmp_path):
    """As the report tells them behind its figure: the stand-in's s has the relative error rtol."""
    assert call("report", archive, "-o", tmp_path / "page.html").exit_code == 0
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    ratio, error = (
        np.array(json.loads(re.search(rf'"s/s\(flat_radius=0\){end}": ?(\[.*?\])', page)[1]))
        for end in ("", "_error")
    )
    plain = np.broadcast_to(dataset.flat_radius == 0.0, dataset.s.shape).ravel()
    assert dataset.s.dims[-1] == "flat_radius"
    assert (error[plain] == 0.0).all()
    np.testing.assert_allclose(error[~plain], 2.0 * dataset.attrs["rtol"] * ratio[~plain], rtol=1e-4)


def test_extrema_leave_out_what_has_no_value():
    phase = np.linspace(0, np.pi, 37)
    dataset = made_up(
        lambda phase, friction: 2 + friction * np.cos(phase - 1), phase=phase, friction=[0.5, 1.0]
    )
    dataset.s[:, 0] = np.nan
    dataset.s[-1, 1] = np.nan
    found = dataset.swt.extrema("phase")
    assert np.isnan(found.minimum[0])
    assert np.isnan(found.at_minimum[0])
    assert found.at_minimum[1] == phase[-2]


def test_a_tidy_table(dataset):
    table = dataset.swt.to_table()
    assert len(table) == 30
    assert list(table.columns[:3]) == ["phase", "frequency_ratio", "flat_radius"]
    row = table[(table.phase > 3) & (table.frequency_ratio == 1.5) & (table.flat_radius == 0.5)]
    assert row.s.item() == dataset.s.values[1, 2, 1]
    assert set(table.regime) <= set(dataset.regime.attrs["flag_meanings"].split())
    assert (table.profile == "rounded_punch").all()
    assert len(dataset.isel(phase=0, frequency_ratio=0, flat_radius=0).swt.to_table()) == 1
    assert table.to_csv().startswith("point,phase,")


def test_tables_and_figures_after_xarrays_operations(dataset):
    masked = dataset.where(dataset.s > dataset.s.median())
    table = masked.swt.to_table()
    assert table.regime.isna().sum() == masked.s.isnull().sum() > 0
    joined = xr.concat([dataset.isel(phase=[0]), dataset.isel(phase=[1])], "phase")
    for one in (masked, joined, dataset[["s"]], dataset.sortby("flat_radius", ascending=False), 2 * dataset):
        figure = one.assign_attrs(dataset.attrs).isel(phase=1).swt.figure()
        # A value that the mask has left alone is a dot.
        assert sum(line.get_linestyle() != "None" for line in figure.axes[0].lines) == 3
        assert one.swt.extrema("flat_radius").ratio.shape == (2, 3)
        assert one.swt.slice(phase="pi").swt.normalised("b=0").shape == (3, 5)


def test_stacked_axes_are_named_with_their_values():
    found = swtstudy.solve(friction=[0.2, 0.3], profile=["paraboloid", "power_law"], exponent=3, rtol=1e-2)
    stacked = found.stack(point=("friction", "profile"))
    words = repr(stacked.swt)
    assert "axis           point: 4 points of friction, profile" in words
    assert "s = 0.08612 (friction = 0.2, profile = paraboloid; x/a_H = −1.32) to" in words
    assert stacked.swt.validity() == found.swt.validity()


def test_figures(dataset):
    assert len(dataset.swt.figure().axes) == 4
    # What has been sliced away leaves the layout.
    assert len(dataset.swt.slice(phase=0).swt.figure().axes) == 2
    assert len(dataset.swt.slice(phase=0, frequency_ratio=1).swt.figure().axes[0].lines) == 1
    assert (
        len(
            dataset.sel(flat_radius=slice(0.5, None))[["s", "s_error"]]
            .swt.panels("flat_radius", "phase", "frequency_ratio")
            .axes
        )
        == 3
    )
    with pytest.raises(ValueError, match="not an axis of these results"):
        dataset.swt.slice(flat_radius=0).swt.figure()


def test_a_figure_of_ones_own_has_all_keys_of_a_studys(dataset):
    dataset["regime"] = dataset.regime.copy(data=np.tile([0, 0, 1, 1, 2], (2, 3, 1)))
    plain, marked = (
        dataset.isel(phase=0).swt.panels("flat_radius", "frequency_ratio", regimes=regimes)
        for regimes in (False, True)
    )
    assert len(marked.axes[0].lines) > len(plain.axes[0].lines)
    own = set(inspect.signature(dataset.swt.panels).parameters) - {"style", "width"}
    # A caption and a message are the study's.
    schema = json.loads((STUDIES / "study.schema.json").read_text(encoding="utf-8"))
    assert own == {*schema["$defs"]["FigureLayout"]["properties"]} - {"caption", "message"}


def test_results_of_solve():
    dataset = swtstudy.solve(phase=[0, 1], rtol=1e-2)
    assert dataset.swt.slice(phase=1).s.ndim == 0
    with pytest.raises(ValueError, match="no figure"):
        dataset.swt.figure()


@pytest.mark.slow
@pytest.mark.parametrize(
    "imports",
    [
        "import swtstudy, xarray",
        "import xarray, swtstudy",
        "import swtstudy.faces.accessor",
        "from swtstudy import Study; import dask.array, xarray.core.dataset",
        "from swtstudy.archive.archive import open_results; import xarray",
        "from swtstudy.points.solve import solve",
        "import swtstudy.points.solve",
    ],
)
def test_the_accessor_is_there_whatever_is_imported_first(imports):
    code = f"{imports}\nfrom xarray import Dataset\nDataset({{'s': 1.0}}).swt.to_table"
    code += "\nimport sys\nassert not any('swtstudy' in type(finder).__module__ for finder in sys.meta_path)"
    subprocess.run([sys.executable, "-W", "error", "-c", code], check=True)


def test_importing_the_package_imports_nothing_heavy():
    code = "import swtstudy, sys; sys.exit('heavy' if {'numpy', 'xarray'} & set(sys.modules) else 0)"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_many_values_are_told_by_their_ends():
    few, many = (
        made_up(lambda friction: friction, friction=np.round(0.01 * np.arange(1, count + 1), 2))
        for count in (12, 13)
    )
    for results, allowed in (
        (few, "0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12"),
        (many, "0.01, 0.02, 0.03, 0.04, 0.05, 0.06, …, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, (13 values)"),
    ):
        with pytest.raises(swtstudy.StudyError) as caught:
            results.swt.slice(friction=0.5)
        (mistake,) = caught.value.mistakes
        assert (mistake.key, mistake.found, mistake.allowed) == (
            "friction",
            "0.5, which is not in these results",
            allowed,
        )


def test_a_part_of_results_says_what_it_lacks(dataset):
    with pytest.raises(StudyError, match="results: found none of regime; allowed: results that still have"):
        dataset[["s"]].swt.validity()
    with pytest.raises(StudyError, match="results: found none of s; allowed: results that still have them"):
        dataset[["regime"]].swt.contact()
    assert repr(dataset[["s"]].swt) == "<no results of swtstudy, or a part of them>"
    assert isinstance(dataset[["s", "regime"]].swt.validity(), tuple)
