"""Quantities with a dimension of their own: the critical distance."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from asking import EVERY, study
from command import call, merged
from told import refused

import swtstudy
from swtstudy import Study, open_results, run

NEAR = "phase = [0.5, 1.0]\ncritical_distance = {}"


@pytest.fixture(scope="module")
def two_distances(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    axes = "phase = [0.5, 1.0]\ncritical_distance = ['1/10', 0.2]"
    path = tmp_path_factory.mktemp("distances") / "a.nc"
    return run(study(axes=axes, quantities=EVERY[:1]), path, workers=1)


@pytest.mark.slow
def test_critical_distances_are_an_axis_of_the_quantities_alone(two_distances: xr.Dataset) -> None:
    found = two_distances
    assert found.s.dims == found.dissipation.dims == ("phase",)
    assert found.s_volume.dims == ("phase", "critical_distance")
    assert found.s_line.dims == found.s_line_error.dims == ("phase", "critical_distance", "direction")
    assert found.critical_distance.values.tolist() == [0.1, 0.2]
    assert tuple(found.direction.values) == ("depth", "critical_plane")
    one = swtstudy.solve(phase=1.0, critical_distance=0.2, rtol=1e-3)
    for name, dims in (("s_volume", ()), ("s_point", ("direction",)), ("s_line", ("direction",))):
        assert one[name].dims == dims
        there = found.isel(phase=1, critical_distance=1)
        assert (abs(one[name] - there[name]) <= one[f"{name}_error"] + there[f"{name}_error"]).all()
        assert (found[name].isel(critical_distance=1) < found[name].isel(critical_distance=0)).all()
        assert (found[name] < found.s).all()
    assert one.critical_distance.item() == 0.2


@pytest.mark.slow
def test_an_archive_gets_more_distances_and_is_merged_with_others(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    few = run(study(axes=NEAR.format("[0.05]")), path, workers=1)
    # Written otherwise, the old distance is still the old one.
    more = run(study(axes=NEAR.format('["1/20", 0.1]')), path, workers=1)
    np.testing.assert_array_equal(more.s_line.isel(critical_distance=0), few.s_line.isel(critical_distance=0))
    xr.testing.assert_identical(open_results(path), more)
    one = run(study("[fixed]\ncritical_distance = 0.1\n", "phase = [2.0]"), tmp_path / "b.nc", workers=1)
    assert one.s_volume.dims == ("phase",)
    both = merged(path, tmp_path / "b.nc", sparse=True)
    assert both.critical_distance.values.tolist() == [0.05, 0.1]
    assert np.isnan(both.s_volume.values).tolist() == [[False, False], [False, False], [True, False]]
    done = run(Study.from_text(both.attrs["study"]), tmp_path / "merged.nc", workers=1)
    assert np.isfinite(done.s_line).all()
    assert "distances      0.05, 0.1" in call("info", tmp_path / "merged.nc").output


def test_one_point_has_no_critical_distance() -> None:
    refused("critical_distance: found unknown", swtstudy.inspect_point, critical_distance=0.1)
    words = "critical_distance: found .*; allowed: a single value or"
    refused(words, swtstudy.solve, critical_distance=[[0.1]])


def test_means_of_what_is_the_same_everywhere() -> None:
    """Pressure alone swings no tension at ν = 1/2; where a bulk stress is the worst, s is that far away."""
    nothing = swtstudy.solve(friction=0.0, poisson_ratio=0.5, critical_distance=0.05)
    assert nothing.s == 0.0
    far = swtstudy.solve(friction=0.0, poisson_ratio=0.5, bulk_stress_amplitude=0.5, critical_distance=0.05)
    assert far.s > 0.0
    for found in nothing, far:
        assert np.isnan(found.critical_x)
        for name in ("s_volume", "s_point", "s_line"):
            np.testing.assert_array_equal(found[name], found.s)
            assert (found[f"{name}_error"] <= found.s_error).all()
        assert np.isnan(found.volume_x)
