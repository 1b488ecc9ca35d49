"""Quantities with a dimension of their own: the critical distance."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from asking import EVERY, study
from click.testing import CliRunner
from curves import curves, whole
from real import ALLOY

import swtstudy
from swtstudy import Study, StudyError, open_results, run
from swtstudy.archive.merge import merge
from swtstudy.archive.netcdf import save
from swtstudy.archive.paths import ArchiveError
from swtstudy.cli import main
from swtstudy.mechanics import quantities
from swtstudy.mechanics.body.nonlocal_swt import DIRECTIONS, Estimate, NonlocalSwt
from swtstudy.points.unique import unique_points
from swtstudy.runner import chunk
from swtstudy.runner.chunk import chunks
from swtstudy.runner.workload import estimate
from swtstudy.units.variables import variables

NEAR = "phase = [0.5, 1.0]\ncritical_distance = {}"


@pytest.fixture(scope="module")
def two_distances(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    axes = "phase = [0.5, 1.0]\ncritical_distance = ['1/10', 0.2]"
    path = tmp_path_factory.mktemp("distances") / "a.nc"
    return run(study(axes=axes, quantities=EVERY[:1]), path, workers=1)


def test_critical_distances_are_an_axis_of_the_quantities_alone(two_distances: xr.Dataset) -> None:
    found = two_distances
    assert found.s.dims == found.dissipation.dims == ("phase",)
    assert found.s_volume.dims == ("phase", "critical_distance")
    assert found.s_line.dims == found.s_line_error.dims == ("phase", "critical_distance", "direction")
    assert found.critical_distance.values.tolist() == [0.1, 0.2]
    assert tuple(found.direction.values) == DIRECTIONS
    one = swtstudy.solve(phase=1.0, critical_distance=0.2, rtol=1e-3)
    for name, dims in (("s_volume", ()), ("s_point", ("direction",)), ("s_line", ("direction",))):
        assert one[name].dims == dims
        there = found.isel(phase=1, critical_distance=1)
        assert (abs(one[name] - there[name]) <= one[f"{name}_error"] + there[f"{name}_error"]).all()
        assert (found[name].isel(critical_distance=1) < found[name].isel(critical_distance=0)).all()
        assert (found[name] < found.s).all()
    assert one.critical_distance.item() == 0.2


def made_up_means(scene, position, angle, distance):
    """Stands in for `worst_means`, which takes seconds."""
    volume = np.abs(position)[:, None] * distance
    both = np.stack([volume + 1.0, volume + 2.0], axis=-1)
    x = np.broadcast_to(position[:, None], volume.shape)
    places = x, np.stack([x, x + 1.0], axis=-1), np.stack([x + 2.0, x + 3.0], axis=-1)
    return NonlocalSwt(volume, volume + 0.1, both, both + 0.1, both + 10.0, both + 10.1, *places)


def test_their_values_are_put_where_they_belong(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quantities, "worst_means", made_up_means)
    found = swtstudy.solve(phase=[0.5, 1.0, 0.5 + np.pi], critical_distance=[0.2, 0.05], rtol=1e-2)
    volume = abs(found.critical_x.drop_attrs()) * found.critical_distance

    def check(name: str, expected: xr.DataArray, **place: str) -> None:
        values = found[name].sel(place, drop=True)
        np.testing.assert_allclose(values, expected.transpose(*values.dims), rtol=1e-12)

    check("s_volume", volume)
    check("s_volume_error", volume + 0.1)
    for name, shift in (("s_point", 0.0), ("s_line", 10.0)):
        for number, direction in enumerate(DIRECTIONS, start=1):
            check(name, volume + number + shift, direction=direction)
            check(f"{name}_error", volume + number + shift + 0.1, direction=direction)


@pytest.mark.slow
def test_an_archive_gets_more_distances_and_is_merged_with_others(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "a.nc"
    few = run(study(axes=NEAR.format("[0.05]")), path, workers=1)
    asked: list[float] = []

    def counting(scene, position, angle, distance):
        asked.extend(distance.tolist())
        return whole(scene, position, angle, distance)

    whole = quantities.worst_means
    monkeypatch.setattr(quantities, "worst_means", counting)
    never = stand_in.Counting()
    # Written otherwise, the old distance is still the old one.
    more = run(study(axes=NEAR.format('["1/20", 0.1]')), path, workers=1, solver=never)
    assert never.points == 0
    assert set(asked) == {0.1}
    np.testing.assert_array_equal(more.s_line.isel(critical_distance=0), few.s_line.isel(critical_distance=0))
    xr.testing.assert_identical(open_results(path), more)
    one = run(study("[fixed]\ncritical_distance = 0.1\n", "phase = [2.0]"), tmp_path / "b.nc", workers=1)
    assert one.s_volume.dims == ("phase",)
    merged = merge([path, tmp_path / "b.nc"], sparse=True)
    assert merged.critical_distance.values.tolist() == [0.05, 0.1]
    assert np.isnan(merged.s_volume.values).tolist() == [[False, False], [False, False], [True, False]]
    save(merged, tmp_path / "merged.nc")
    asked.clear()
    done = run(Study.from_text(merged.attrs["study"]), tmp_path / "merged.nc", workers=1, solver=never)
    assert set(asked) == {0.05}
    assert np.isfinite(done.s_line).all()
    told = CliRunner().invoke(main, ["info", str(tmp_path / "merged.nc")]).output
    assert "distances      0.05, 0.1" in told


def test_figures_over_critical_distances(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quantities, "worst_means", made_up_means)
    figure = '[figure]\nx = "critical_distance"\nhue = "phase"\ny = "s_volume"\n'
    axes = "phase = [0.5, 1.0]\ncritical_distance = { start = 0.01, stop = 1, num = 3, spacing = 'log' }"
    found = run(Study.from_text(study(axes=axes).text + figure), tmp_path / "a.nc", workers=1)
    (panel,) = found.swt.figure().axes
    assert panel.get_xscale() == "log"
    assert "ell" in panel.get_xlabel()
    np.testing.assert_allclose(whole(curves(panel)[1])[1], found.s_volume.isel(phase=1))
    along = found.swt.slice(critical_distance=0.1).swt.panels(x="phase", hue="direction", y="s_line")
    assert [line.get_label() for line in along.axes[0].lines] == ["depth", "critical plane"]
    assert len(found.swt.to_table()) == 2 * 3
    for change, words in (
        (('"s_volume"', '"s"'), "'critical_distance', not an axis of s in this study"),
        (('"s_volume"', '"s_line"'), "no place for the axis direction"),
        (('y = "s_volume"', 'y = "s_volume"\nregimes = true'), r"figure\.regimes: found true over crit"),
    ):
        with pytest.raises(StudyError, match=words):
            Study.from_text(study(axes=axes).text + figure.replace(*change))


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        ("[fixed]\ncritical_distance = 0", r"fixed\.critical_distance: found 0 \(out of range\)"),
        ("[fixed]\ncritical_distance = 'far'", r"critical_distance: found 'far' \(.*\); allowed: a number"),
        ("[axes]\ncritical_distance = []", r"axes\.critical_distance: found an empty axis"),
        ("[axes]\ncritical_distance = [0.1, '1/10']", r"distance\[1\]: found '1/10', the same as"),
        ("[fixed]\ncritical_distance = 0.1\n[axes]\ncritical_distance = [0.1]", "a fixed value and an axis"),
        ("quantities = ['s_volume']", r"\[0\]: found 's_volume'; allowed: a value of critical_distance"),
        ("[fixed]\ncritical_distanse = 0.1", r"did you mean critical_distance\?"),
    ],
)
def test_bad_distances_are_named(entry: str, words: str) -> None:
    with pytest.raises(StudyError, match=words) as error:
        Study.from_text(f'title = "t"\n{entry}\n')
    assert len(error.value.mistakes) == 1


def test_one_point_has_no_critical_distance() -> None:
    with pytest.raises(StudyError, match="critical_distance: found unknown parameter"):
        swtstudy.inspect_point(critical_distance=0.1)
    with pytest.raises(StudyError, match=r"critical_distance: found .*; allowed: a single value or"):
        swtstudy.solve(critical_distance=[[0.1]])


def test_the_command_line_prints_a_column_for_each_distance() -> None:
    answer = CliRunner().invoke(main, ["solve", "--critical-distance", "0.05,0.2", "--rtol", "1e-2"])
    header, row = (line.split("\t") for line in answer.output.splitlines())
    values = dict(zip(header, row, strict=True))
    assert float(values["s_volume[0.05]"]) > float(values["s_volume[0.2]"]) > 0.0
    assert {"s_point[0.05,depth]", "s_line[0.2,critical_plane]"} <= values.keys()


def test_points_with_nonlocal_values_are_cut_into_small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(quantities, "worst_means", made_up_means)
    grid = study(axes="phase = {start = 0.1, stop = 3, num = 40}").grid
    points = unique_points(grid)
    every = np.ones(40, bool)
    for asked, lengths in (
        (chunk.Asked(EVERY[:1]), [40]),
        (chunk.Asked(("critical_distance=0.1",)), [8] * 5),
    ):
        (one,) = chunks(points, every, lambda: np.inf, asked)
        assert [*one.lengths] == lengths
        np.testing.assert_array_equal(np.sort(one.rows), np.arange(40))
    timed: list[int] = []
    asked = chunk.Asked(("critical_distance=0.1",))
    seconds = estimate(points, every, 1e-2, stand_in.smooth, lambda result: timed.append(len(result)), asked)
    assert timed == [8]
    assert seconds > 0.0


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda found: found.drop_vars("dissipation_error"), "dissipation_error: found nothing; allowed: a"),
        (lambda found: found.assign(s_volume=found.s), r"s_volume: found dimensions .*critical_distance"),
        (lambda found: found.isel(critical_distance=[0]), r"found no critical_distance=0\.2; allowed: those"),
        (
            lambda found: found.assign_attrs(runs=found.attrs["runs"].replace('"dissipation"', '"friction"')),
            "attribute runs: found .*quantities of a run",
        ),
        (
            lambda found: found.assign(dissipation=found.dissipation.assign_attrs(units="J")),
            "attribute units of dissipation: found 'J'; allowed: '1'",
        ),
    ],
)
def test_archives_with_damaged_quantities_are_refused(
    damage, words: str, two_distances: xr.Dataset, tmp_path: Path
) -> None:
    path = tmp_path / "a.nc"
    save(damage(two_distances), path)
    with pytest.raises(ArchiveError, match=words):
        open_results(path)


@pytest.mark.slow
def test_a_mean_far_beyond_the_contact_is_not_negative(tmp_path):
    """The mean over 10 a_H is almost 0, and interpolation may be below that."""
    study = Study.from_text(
        f"""
title = "Distances far beyond the contact"
rtol = 1e-3
{ALLOY}[fixed]
young_modulus = 73e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
normal_force = 200
tangential_force_amplitude = 47.7
bulk_stress_mean = -53.8
phase = 1.26
body = 1
[axes]
critical_distance = [1.5, 3, 5]
"""
    )
    found = run(study, tmp_path / "a.nc", workers=1)
    means = found.SWT_volume
    assert (means >= 0.0).all()
    # The larger the volume beyond the contact, the less: the error holds what was below 0.
    assert means[1] <= means[0]
    assert means[2] <= means[1] + found.SWT_volume_error[1] + found.SWT_volume_error[2]
    assert found.cycles_volume.notnull().all()
    both = Estimate(np.array([-3.0, 2.0]), np.array([0.5, 0.5]), np.array([1.0, 1.0])).not_negative
    assert (both.value.tolist(), both.error.tolist()) == ([0.0, 2.0], [4.0, 1.0])
    # Of a run of before.
    stored = found.s_volume.copy(data=[-1e-7, 0.0, 1e-3])
    grid = study.grid
    (life,) = (each for each in variables(grid, study.asked) if each.name == "cycles_volume")
    assert life.values(found.assign(s_volume=stored), grid)[:2].values.tolist() == [np.inf, np.inf]


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
            np.testing.assert_array_equal(found[f"{name}_error"], found.s_error)
        assert np.isnan(found.volume_x)
