from functools import partial

import numpy as np
import pytest
import stand_in
import xarray as xr
from command import merged as merge
from solved import MISSING

from swtstudy import Study, open_results, run

FIGURE = '[figure]\nx = "phase"\nhue = "friction"\n'


def made(tmp_path, name, frictions, phases, more="", rtol=1e-3, solver=stand_in.smooth):
    text = (
        f'title = "{name}"\nrtol = {rtol}\n{more}[axes]\nfriction = {frictions}\nphase = {phases}\n{FIGURE}'
    )
    path = tmp_path / f"{name}.nc"
    run(Study.from_text(text), path, solver=solver)
    return path


def changed(path, factor):
    """A copy of an archive with s times a factor."""
    dataset = open_results(path)  # with errors of 1e-3 of s
    other = path.with_name("other.nc")
    dataset.assign(s=dataset.s * factor).to_netcdf(other)
    return other


def test_two_halves_are_the_whole(tmp_path):
    one = made(tmp_path, "one", [0.1, 0.3], [0, 1, 4])
    other = made(tmp_path, "other", [0.2, 0.1 + 0.2], [0, 1, 4])
    whole = open_results(made(tmp_path, "whole", [0.1, 0.2, 0.3], [0, 1, 4]))
    merged = merge(one, other)
    for name in ("s", "critical_x", "critical_angle", "regime", "status"):
        np.testing.assert_allclose(merged[name], whole[name], rtol=1e-11)
    # What was merged is a study too: running it computes nothing.
    counting = stand_in.Counting()
    again = run(Study.from_text(merged.attrs["study"]), tmp_path / "merged.nc", solver=counting)
    assert counting.points == 0
    assert Study.from_text(merged.attrs["study"]).figure is not None
    xr.testing.assert_equal(again, merged)


def test_what_neither_has_is_missing_and_a_fixed_value_becomes_an_axis(tmp_path):
    one = made(tmp_path, "one", [0.1], [0, 1], '[fixed]\nfrequency_ratio = "1/2"\n')
    other = made(tmp_path, "other", [0.2], [0, 1], "[fixed]\nfrequency_ratio = 1\n")
    with pytest.raises(
        ValueError, match=r"one\.nc, .*other\.nc has 4 of 8 points in none of them, such as .*"
    ):
        merge(one, other)
    merged = merge(one, other, sparse=True)
    assert merged.sizes == {"friction": 2, "phase": 2, "frequency_ratio": 2}
    assert int((merged.status == MISSING).sum()) == 4
    assert int(np.isnan(merged.s).sum()) == 4
    # The new axis has the role that is free.
    assert Study.from_text(merged.attrs["study"]).figure.panels == "frequency_ratio"
    assert "one.nc, other.nc, 4 of 8 points in none of them" in merged.attrs["history"].splitlines()[0]
    # What is missing already is no new gap.
    assert int((merge(tmp_path / "merged.nc", one, name="both.nc").status == MISSING).sum()) == 4


def test_what_symmetry_gives_is_no_gap(tmp_path):
    one = made(tmp_path, "one", [0.1], [0, 1])
    other = made(tmp_path, "other", [0.2], [0, 1 + np.pi])  # half a turn of phase mirrors x alone
    merged = merge(one, other)
    assert merged.s.shape == (2, 3)
    assert np.isfinite(merged.s).all()


@pytest.mark.quick(4)
@pytest.mark.parametrize("apart", [1.01, 0.99, 1 + 2.01e-3, 1 - 2.01e-3])
@pytest.mark.parametrize("order", [1, -1])
def test_conflicts_are_refused(tmp_path, apart, order):
    one = made(tmp_path, "one", [0.1, 0.2], [0, 1])
    other = changed(one, apart)
    match = r"values [\d.]+ in .*{}\.nc and [\d.]+ in .*{}\.nc at friction = 0.1, phase = 0; 3 more"
    with pytest.raises(ValueError, match=match.format(*["one", "other"][::order])):
        merge(*[one, other][::order])


@pytest.mark.parametrize(("frictions", "end"), [([0.1], "phase = 0"), ([0.1, 0.2], "; 1 more")])
def test_other_conflicts_are_counted(tmp_path, frictions, end):
    one = made(tmp_path, "one", frictions, [0])
    with pytest.raises(ValueError, match=r"friction = 0\.1.*" + end + "$"):
        merge(one, changed(one, 2.0))


@pytest.mark.parametrize("apart", [1 + 1.99e-3, 1 - 1.99e-3])
def test_values_within_both_errors_are_one(tmp_path, apart):
    one = made(tmp_path, "one", [0.1, 0.2], [0, 1])
    other = changed(one, apart)
    for order in ([one, other], [other, one]):
        assert merge(*order).s.shape == (2, 2)


def test_the_more_accurate_of_two_consistent_values_is_kept(tmp_path):
    coarse = made(tmp_path, "coarse", [0.1, 0.2], [0, 1], rtol=1e-2)
    fine = made(tmp_path, "fine", [0.2, 0.3], [0, 1], rtol=1e-4)
    for order in ([coarse, fine], [fine, coarse]):
        merged = merge(*order)
        relative = (merged.s_error / merged.s).isel(phase=0).values
        np.testing.assert_allclose(relative, [1e-2, 1e-4, 1e-4])


@pytest.mark.slow
def test_quantities_that_contradict_each_other_are_refused(tmp_path):
    more = 'quantities = ["dissipation"]\n[fixed]\ncritical_distance = 0.1\n'
    one = made(tmp_path, "one", [0.1, 0.2], [0, 1], more)
    dataset, other = open_results(one), tmp_path / "other.nc"
    dataset.assign(dissipation=dataset.dissipation * 1.5).to_netcdf(other)
    with pytest.raises(
        ValueError, match=r"conflicting values of dissipation .* in .*one.nc and .*other.nc at"
    ):
        merge(one, other)
    dataset.assign(dissipation=dataset.dissipation + dataset.dissipation_error).to_netcdf(other)
    assert np.isfinite(merge(one, other).dissipation).all()


def test_a_computed_value_replaces_a_failure(tmp_path):
    failed = made(tmp_path, "failed", [0.1, 0.2], [0, 1], solver=partial(stand_in.fail_at, 0.2))
    good = made(tmp_path, "good", [0.2, 0.3], [0, 1])
    merged = merge(failed, good)
    assert np.isfinite(merged.s).all()
    assert "message" not in merged


def test_other_solver_versions_are_refused(tmp_path, monkeypatch):
    one = made(tmp_path, "one", [0.1], [0, 1])
    dataset = open_results(one)
    dataset.attrs["runs"] = dataset.attrs["runs"].replace('"solver_version": "', '"solver_version": "0.')
    dataset.to_netcdf(tmp_path / "other.nc")
    with pytest.raises(ValueError, match=r"different solver versions .* in .*one\.nc"):
        merge(one, tmp_path / "other.nc")


def test_axes_that_differ_by_rounding_are_one(tmp_path):
    one = made(tmp_path, "one", [0.2, 0.3], [0, 1])
    other = made(tmp_path, "other", [0.1 + 0.2, 0.2 * (1 + 1e-13), 0.1], [0, 1])
    merged = merge(one, other)
    assert merged.friction.values.tolist() == [0.1, 0.2, 0.3]  # as the first has them, in order
    assert merged.phase.values.tolist() == [0.0, 1.0]


def test_axes_that_differ_by_more_are_two(tmp_path):
    one = made(tmp_path, "one", [0.2], [0, 1])
    other = made(tmp_path, "other", [0.2 * (1 + 1e-11)], [0, 1])
    assert merge(one, other).friction.values.tolist() == [0.2, 0.2 * (1 + 1e-11)]


@pytest.mark.slow
def test_contacts_that_share_a_point_keep_their_own_distances(tmp_path):
    """In different sizes of one non-dimensional contact a length is several distances."""
    head = (
        'title = "t"\nrtol = 1e-2\n[units]\nlength = "mm"\nforce = "N"\nstress = "MPa"\n[fixed]\n'
        "young_modulus = 115e3\npoisson_ratio = 0.32\nradius = 40\nfriction = 0.7\nbody = 1\n"
        "critical_distance = 0.05\n"
    )
    paths = []
    for force in (300, 500):
        paths.append(tmp_path / f"{force}.nc")
        text = f"{head}[axes]\nnormal_force = [{force}]\ntangential_force_amplitude = [60, 100]\n"
        run(Study.from_text(text), paths[-1], workers=1)
    merged = merge(*paths)
    assert np.isfinite(merged.SWT_volume).all()
    for path in paths:
        own = open_results(path)
        np.testing.assert_array_equal(merged.SWT_volume.sel(normal_force=own.normal_force), own.SWT_volume)
    # Again a study whose run has nothing to do.
    counting = stand_in.Counting()
    run(Study.from_text(merged.attrs["study"]), tmp_path / "merged.nc", solver=counting, workers=1)
    assert counting.points == 0


def test_different_loops_of_one_name_are_refused(tmp_path):
    paths = []
    for name, last in (("one", -1), ("other", -0.5)):
        paths.append(tmp_path / f"{name}.nc")
        loop = f"[loads.rig]\nvertices = [[0, 1], [0.1, 0], [0, {last}]]\n"
        text = f'title = "{name}"\nrtol = 1e-2\n{loop}[fixed]\nload = "rig"\n[axes]\nfriction = [0.3]\n'
        run(Study.from_text(text), paths[-1], solver=stand_in.smooth)
    with pytest.raises(ValueError, match=r"^rig: of this name each archive defines another one$"):
        merge(*paths)


@pytest.mark.slow
def test_means_of_measured_loads_are_no_axis(tmp_path):
    """Of two such loads each contact had been asked for with the mean of the other one."""
    fixed = '[units]\nlength = "mm"\nforce = "N"\nstress = "MPa"\n[fixed]\n'
    fixed += "young_modulus = 73100\npoisson_ratio = 0.33\nradius = 50\n"
    loads = "".join(
        f"[loads.{name}]\nabsolute = true\nvertices = [[{mean}, 40], [{mean}, -40]]\n"
        for name, mean in (("a", 200), ("b", 300))
    )
    archives = []
    for friction in (0.5, 0.6):
        text = f'title = "rig"\nrtol = 1e-2\n{fixed}'
        text += f'friction = {friction}\n[axes]\nload = ["a", "b"]\n{loads}'
        archives.append(tmp_path / f"{friction}.nc")
        run(Study.from_text(text), archives[-1], solver=stand_in.smooth)
    assert merge(*archives).sizes == {"load": 2, "friction": 2}
