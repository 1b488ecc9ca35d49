"""Quantities on request: their values, and that they are computed, stored and continued like s."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from click.testing import CliRunner
from scenes import PROFILE_NAMES, random_points
from scenes import points as batch

import swtstudy
from swtstudy import Study, StudyError, open_results, run
from swtstudy.archive.merge import GapsError, merge
from swtstudy.archive.parts import kept_folder, parts_folder, points_saved
from swtstudy.archive.write import save
from swtstudy.cli import main
from swtstudy.mechanics import quantities
from swtstudy.mechanics.body.nonlocal_swt import DIRECTIONS, NonlocalSwt
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.of_points import load_of
from swtstudy.mechanics.stress import work
from swtstudy.quantities import NAMED, NONLOCAL, QUANTITIES, Request, attributes_of
from swtstudy.records.solutions import blank
from swtstudy.runner import chunk
from swtstudy.runner.run import Stopped

EVERY = tuple(NAMED)
VARIABLES = tuple(Request(EVERY).variables)


def study(more: str = "", axes: str = "phase = [0.5, 1.0, 2.0, 4.0]", quantities: tuple[str, ...] = ()):
    asked = f"quantities = {list(quantities)}\n" if quantities else ""
    return Study.from_text(f'title = "t"\nrtol = 1e-3\n{asked}{more}[axes]\n{axes}\n')


def computed(points, names):
    """Quantities that need no solution."""
    return quantities.quantities_of(points, names, blank(len(points)))


def test_the_table_is_complete() -> None:
    assert all(callable(getattr(work, row.function)) for row in NAMED.values())
    assert all(row.function in NonlocalSwt.__annotations__ for row in NONLOCAL.values())
    for row in QUANTITIES.values():
        assert len(row.meaning) <= 30
        for name in row.variables:
            attributes = attributes_of(name)
            assert {"long_name", "comment", "units", "symbol"} <= attributes.keys()
            for other in attributes.get("ancillary_variables", "").split():
                assert other in row.variables


def test_under_a_constant_normal_load_they_are_those_of_cattaneo_and_mindlin() -> None:
    u = np.array([0.1, 0.4, 0.9, 1.4])
    found = swtstudy.solve(normal_amplitude=0, tangential_amplitude=u, quantities=EVERY, rtol=1e-2)
    stick = np.maximum(1.0 - u, 0.0)
    expected = np.where(
        u <= 1.0, 4.0 * u * (1.0 + stick**1.5) - 3.2 * (1.0 - stick**2.5), 0.8 + 4.0 * (u - 1.0)
    )
    np.testing.assert_allclose(found.dissipation, expected, rtol=1e-9)
    assert (np.abs(found.dissipation - expected) <= found.dissipation_error).all()
    np.testing.assert_allclose(found.stick_radius, np.where(u < 1.0, np.sqrt(stick), np.nan), rtol=1e-12)
    np.testing.assert_allclose(found.contact_radius, 1.0)
    np.testing.assert_allclose(found.force_ratio, 1.0 - stick**1.5, rtol=1e-9)
    assert found.dissipation.attrs["ancillary_variables"] == "dissipation_error"


def test_under_a_prescribed_force_they_are_those_of_the_displacement_that_belongs_to_it() -> None:
    u = np.array([0.2, 0.6])
    force = 1.0 - (1.0 - u) ** 1.5
    own = swtstudy.solve(normal_amplitude=0, tangential_amplitude=u, quantities=EVERY, rtol=1e-2)
    asked = {"quantities": EVERY, "rtol": 1e-2, "normal_force_amplitude": 0}
    found = swtstudy.solve(tangential_force_amplitude=force, **asked)
    for name in EVERY:
        np.testing.assert_allclose(found[name], own[name], rtol=1e-6)
    lost = swtstudy.solve(tangential_force_amplitude=1.1, **asked)
    assert lost.regime.attrs["flag_meanings"].split()[int(lost.regime)] == "no_equilibrium"
    for name in VARIABLES:
        assert np.isnan(lost[name])


def test_a_loop_on_a_line_has_those_of_the_harmonic_load() -> None:
    line = swtstudy.LoadPath("line", [[0, 1], [0, -1]])
    found = swtstudy.solve(load=line, tangential_amplitude=0.6, quantities=EVERY, rtol=1e-2)
    harmonic = swtstudy.solve(normal_amplitude=0, tangential_amplitude=0.6, quantities=EVERY, rtol=1e-2)
    for name in EVERY:
        assert float(found[name]) == pytest.approx(float(harmonic[name]), rel=1e-6)


def marched(points, index: int, springs: int = 3000, steps: int = 6000) -> tuple[float, float, float]:
    """Work, largest force ratio and contact radius from springs that are marched through two periods."""
    one = points.take(np.array([index]))
    load, shape = load_of(one), {name: float(values[0]) for name, values in one.shape.items()}
    profile = make_profile(one.profile, {k: np.array([v]) for k, v in shape.items()}, load.largest_normal)
    largest = float(profile.radius(load.largest_normal[:, None])[0, 0])
    edges = largest * np.linspace(0.0, 1.0, springs + 1)
    width, g = np.diff(edges), profile.depth(0.5 * (edges[1:] + edges[:-1])[None])[0]
    instant = np.linspace(0.0, 4.0 * np.pi, 2 * steps + 1)
    depth, u = load.normal(instant[None])[0], load.tangential(instant[None])[0]
    unit = np.maximum(1.0 - g, 0.0) @ width
    tau, before, force, normal = np.zeros(springs), 1.0, [0.0], [1.0]
    for k in range(1, len(instant)):
        compression = np.maximum(depth[k] - g, 0.0)
        # A spring that touches within the step takes part in what is moved from then on.
        part = np.where(before > g, 1.0, np.clip((depth[k] - g) / max(depth[k] - before, 1e-300), 0.0, 1.0))
        tau = np.clip(tau + part * (u[k] - u[k - 1]), -compression, compression)
        before = depth[k]
        force.append(tau @ width / unit)
        normal.append(compression @ width / unit)
    force, normal, moved = np.array(force), np.array(normal), np.diff(u)[steps:]
    done = 0.5 * (force[steps:-1] + force[steps + 1 :]) @ moved
    ratio = np.divide(np.abs(force), normal, out=np.zeros_like(force), where=normal > 1e-3)
    return float(done), float(ratio[steps:].max()), largest


@pytest.mark.parametrize("profile", PROFILE_NAMES)
def test_they_are_those_of_marched_springs(profile: str) -> None:
    points = random_points(41, 3, profile, largest_term=3)
    found = computed(points, EVERY)
    for index in range(3):
        work_done, ratio, largest = marched(points, index)
        assert found["dissipation"][index] == pytest.approx(work_done, rel=3e-3, abs=3e-6)
        assert found["force_ratio"][index] == pytest.approx(ratio, rel=2e-3)
        assert found["contact_radius"][index] == pytest.approx(largest, rel=1e-12)


@pytest.mark.parametrize("profile", PROFILE_NAMES)
def test_errors_are_honest(profile: str, monkeypatch: pytest.MonkeyPatch) -> None:
    points = random_points(42, 10, profile)
    found = computed(points, ["dissipation", "force_ratio"])
    monkeypatch.setattr(work, "NODES", 32)
    monkeypatch.setattr(work, "TOLERANCE", 3e-7)
    monkeypatch.setattr(work, "SAMPLES", 100)
    finer = computed(points, ["dissipation", "force_ratio"])
    error = np.abs(found["dissipation"] - finer["dissipation"])
    assert (error <= found["dissipation_error"]).all()
    assert (found["dissipation_error"] <= 1.1e-5 * finer["dissipation"] + 1e-12).all()
    np.testing.assert_allclose(found["force_ratio"], finer["force_ratio"], rtol=2e-5)


def test_they_do_not_depend_on_what_is_computed_together(monkeypatch: pytest.MonkeyPatch) -> None:
    points = random_points(43, 30, "rounded_punch")
    whole = computed(points, EVERY)
    monkeypatch.setattr(work, "LARGEST_SIZE", 5_000)
    for part in (np.arange(7), np.array([29, 3])):
        for name, values in computed(points.take(part), EVERY).items():
            np.testing.assert_allclose(values, whole[name][part], rtol=1e-9, atol=1e-14)


def test_mirrored_points_have_the_same_and_are_computed_once() -> None:
    phase = np.array([0.7, 0.7 + np.pi])
    found = swtstudy.solve(phase=phase, quantities=EVERY, rtol=1e-2)
    assert found.critical_x[0] == -found.critical_x[1]
    # Computed as given, not as their canonical point.
    own = computed(batch(phase=phase), EVERY)
    for name in EVERY:
        assert found[name].values[0] == pytest.approx(found[name].values[1], rel=0, nan_ok=True)
        np.testing.assert_allclose(own[name], found[name], rtol=1e-6)


def test_a_stick_zone_there_is_not_is_nan() -> None:
    found = swtstudy.solve(tangential_amplitude=[0.2, 1.5], quantities=["stick_radius"], rtol=1e-2)
    assert np.isfinite(found.stick_radius[0])
    assert np.isnan(found.stick_radius[1])


def test_a_study_without_them_neither_computes_nor_stores_any(tmp_path: Path, monkeypatch) -> None:
    def never(*_: object) -> None:
        raise AssertionError

    monkeypatch.setattr(quantities, "quantities_of", never)
    found = run(study(), tmp_path / "a.nc", workers=1)
    assert not {*found.data_vars} & {*VARIABLES}
    assert "quantities" not in found.attrs["runs"]


def test_an_archive_gets_what_it_lacks_and_keeps_s(tmp_path: Path) -> None:
    path = tmp_path / "a.nc"
    plain = run(study(), path, workers=1)
    never = stand_in.Counting()
    more = run(study(quantities=("dissipation",)), path, workers=1, solver=never)
    assert never.points == 0
    xr.testing.assert_equal(more[[*plain.data_vars]].drop_vars("run"), plain.drop_vars("run"))
    assert "0 of 4 distinct points computed, and quantities that 4 others lacked" in more.attrs["history"]
    both = run(study(quantities=("stick_radius", "dissipation")), path, workers=1, solver=never)
    at_once = swtstudy.solve(phase=both.phase.values, rtol=1e-3, quantities=EVERY)
    for name in ("dissipation", "dissipation_error", "stick_radius"):
        np.testing.assert_allclose(both[name], at_once[name], rtol=1e-9)
    (one,) = json.loads(both.attrs["runs"])
    assert one["quantities"] == ["dissipation", "stick_radius"]
    # The time of all three runs is told.
    assert one["seconds"] > json.loads(plain.attrs["runs"])[0]["seconds"]
    xr.testing.assert_identical(
        both, run(study(quantities=("stick_radius", "dissipation")), path, solver=never)
    )


def test_an_extension_computes_them_at_the_new_points_alone(tmp_path: Path, monkeypatch) -> None:
    path, asked = tmp_path / "a.nc", ("contact_radius", "force_ratio")
    run(study(axes="phase = [0.5, 1.0]", quantities=asked), path, workers=1)
    counted: list[int] = []

    def counting(points, items, solution):
        counted.append(len(points))
        return quantities_of(points, items, solution)

    quantities_of = quantities.quantities_of
    monkeypatch.setattr(quantities, "quantities_of", counting)
    grown = run(study(quantities=asked), path, workers=1)
    assert sum(counted) == 2
    assert np.isfinite(grown.force_ratio).all()
    # What is asked no more is kept, not computed again.
    fewer = run(study(quantities=asked[:1]), path, workers=1)
    assert "force_ratio" not in fewer
    assert points_saved(kept_folder(path)) == 4
    again = run(study(quantities=asked), path, workers=1)
    assert sum(counted) == 2
    xr.testing.assert_equal(again.drop_vars("run"), grown.drop_vars("run"))
    assert not kept_folder(path).exists()


def test_a_run_that_is_stopped_between_them_goes_on(tmp_path: Path, monkeypatch) -> None:
    path, axes = tmp_path / "a.nc", "phase = {start = 0.01, stop = 0.2, num = 60}"
    # Long cycles, so that a block has some thirty points.
    long = '[fixed]\nfrequency_ratio = "1/15"\n'
    plain = run(study(long, axes), path, workers=1, solver=stand_in.smooth)
    whole = quantities.quantities_of
    counted = [0]

    def stopping(points, items, solution):
        if counted[0] >= 20:
            raise KeyboardInterrupt
        counted[0] += len(points)
        return whole(points, items, solution)

    monkeypatch.setattr(quantities, "quantities_of", stopping)
    asked = study(long, axes, ("dissipation",))
    with pytest.raises(Stopped, match="of 60 distinct points are saved") as stopped:
        run(asked, path, workers=1)
    assert str(stopped.value).split()[1] == str(counted[0])
    saved = counted[0]
    assert np.isfinite(open_results(path, partial=True).s).all()
    monkeypatch.setattr(quantities, "quantities_of", whole)
    again = stand_in.Counting()
    done = run(asked, path, workers=1, solver=again)
    assert again.points == 0
    assert 0 < saved < 60
    np.testing.assert_array_equal(done.s, plain.s)
    assert np.isfinite(done.dissipation).all()


def test_a_killed_run_goes_on_with_its_quantities(tmp_path: Path) -> None:
    file, axes = tmp_path / "a.toml", "phase = {start = 0.1, stop = 3, num = 150}\nfriction = [0.2, 0.3, 0.4]"
    file.write_text(study(axes=axes, quantities=EVERY).text)
    command = [sys.executable, "-m", "swtstudy", "run", str(file), "--results", str(tmp_path)]
    command += ["--workers", "1"]
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    path = tmp_path / "a.nc"
    deadline = time.monotonic() + 60.0
    while not points_saved(parts_folder(path)) and time.monotonic() < deadline and running.poll() is None:
        time.sleep(0.02)
    os.kill(running.pid, signal.SIGKILL)
    running.wait()
    saved = points_saved(parts_folder(path))
    assert 0 < saved < 450
    half = open_results(path)
    assert np.isfinite(half.dissipation.values[half.status.values == 0]).all()
    done = run(Study.from_toml(file), path, workers=1)
    direct = swtstudy.solve(phase=done.phase.values[::50], friction=[0.3], rtol=1e-3, quantities=EVERY)
    for name in VARIABLES:
        np.testing.assert_allclose(
            done[name].sel(friction=0.3)[::50], direct[name].isel(friction=0), 1e-9, 1e-14
        )


def test_a_point_at_which_one_fails_is_told_and_keeps_its_s(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "a.nc"
    plain = run(study(), path, workers=1)
    whole = quantities.quantities_of

    def failing(points, items, solution):
        if np.isclose(points.phase, 1.0).any():
            raise ArithmeticError("an injected failure")
        return whole(points, items, solution)

    monkeypatch.setattr(quantities, "quantities_of", failing)
    found = run(study(quantities=("dissipation",)), path, workers=1)
    assert found.status.values.tolist() == [0, 1, 0, 0]
    assert "an injected failure" in found.status.attrs["failures"]
    assert np.isnan(found.dissipation.values).tolist() == [False, True, False, False]
    np.testing.assert_array_equal(found.s, plain.s)
    monkeypatch.setattr(quantities, "quantities_of", whole)
    mended = run(study(quantities=("dissipation",)), path, workers=1, retry_failed=True)
    assert np.isfinite(mended.dissipation).all()


def test_merged_archives_have_what_all_have_or_say_what_lacks(tmp_path: Path) -> None:
    for name, phase, asked in (
        ("a", "0.5, 1.0", EVERY[:1]),
        ("b", "1.0, 2.0", EVERY[:1]),
        ("c", "1.0, 4.0", ()),
    ):
        run(study(axes=f"phase = [{phase}]", quantities=asked), tmp_path / f"{name}.nc", workers=1)
    both = merge([tmp_path / "a.nc", tmp_path / "b.nc"])
    assert np.isfinite(both.dissipation).all()
    assert Study.from_text(both.attrs["study"]).asked.names == EVERY[:1]
    with pytest.raises(GapsError, match=r"dissipation is known of some points .* not of 1 others"):
        merge([tmp_path / "a.nc", tmp_path / "c.nc"])
    sparse = merge([tmp_path / "a.nc", tmp_path / "c.nc"], sparse=True)
    assert np.isnan(sparse.dissipation.values).tolist() == [False, False, True]
    save(sparse, tmp_path / "sparse.nc")
    never = stand_in.Counting()
    filled = run(Study.from_text(sparse.attrs["study"]), tmp_path / "sparse.nc", solver=never, workers=1)
    assert never.points == 0
    assert np.isfinite(filled.dissipation).all()


def test_an_archive_made_before_there_were_any_opens_and_goes_on(tmp_path: Path) -> None:
    old = Path(__file__).with_name("data") / "without_quantities.nc"
    opened = open_results(old)
    assert opened.s.shape == (2,)
    assert opened.s.values[0] == pytest.approx(0.155137, rel=1e-4)
    path = tmp_path / "old.nc"
    path.write_bytes(old.read_bytes())
    text = opened.attrs["study"].replace("[axes]", 'quantities = ["stick_radius"]\n[axes]', 1)
    more = run(Study.from_text(text), path, workers=1)
    np.testing.assert_allclose(more.s, opened.s, rtol=1e-4)
    assert np.isfinite(more.stick_radius[0])


def test_figures_show_them_with_their_errors(tmp_path: Path) -> None:
    figure = '[figure]\nx = "phase"\ny = ["s", "dissipation"]\n'
    text = study(quantities=("dissipation",)).text + figure
    found = run(Study.from_text(text), tmp_path / "a.nc", workers=1)
    assert r"W/(\mu F_0" in found.swt.figure().axes[1].get_ylabel()
    from swtstudy.results.quantity import quantity_error

    xr.testing.assert_equal(quantity_error(found, "dissipation"), found.dissipation_error)
    assert quantity_error(found, "critical_x") is None
    with pytest.raises(
        StudyError, match=r"figure\.y: found 'dissipation', which this study does not ask for"
    ):
        Study.from_text(study().text + figure)


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (
            '["disipation"]',
            r"quantities\[0\]: found unknown quantity 'disipation'; .*did you mean dissipation\?",
        ),
        (
            '["force_ratio", "force_ratio"]',
            r"quantities\[1\]: found 'force_ratio', the same as quantities\[0\]",
        ),
        ('"dissipation"', "quantities: found 'dissipation'; allowed: a list of dissipation, "),
        ("[3]", r"quantities\[0\]: found 3; allowed: a list of dissipation"),
        ("{a = 1}", "quantities: found .*; allowed: a list of dissipation"),
    ],
)
def test_bad_ones_are_named(raw: str, words: str, tmp_path: Path) -> None:
    text = f'title = "t"\nquantities = {raw}\n[axes]\nphase = [0, 1]\n'
    with pytest.raises(StudyError, match=words):
        Study.from_text(text)
    (tmp_path / "bad.toml").write_text(text)
    answer = CliRunner().invoke(main, ["validate", str(tmp_path / "bad.toml")])
    assert answer.exit_code == 2
    assert len(answer.stderr.strip().splitlines()) == 1


def test_bad_ones_of_solve_are_named() -> None:
    with pytest.raises(StudyError, match=r"quantities\[1\]: found unknown quantity 'friction'"):
        swtstudy.solve(quantities=["dissipation", "friction"])
    with pytest.raises(StudyError, match="did you mean quantities"):
        swtstudy.solve(quantitys=["dissipation"])


def test_the_command_line_prints_and_plans_them(tmp_path: Path) -> None:
    answer = CliRunner().invoke(
        main,
        ["solve", "--quantities", "dissipation,contact_radius", "--normal-amplitude", "0", "--rtol", "1e-2"],
    )
    header, row = (line.split("\t") for line in answer.output.splitlines())
    values = dict(zip(header, row, strict=True))
    assert float(values["dissipation"]) == pytest.approx(0.39643, rel=1e-4)
    assert float(values["contact_radius"]) == 1.0
    assert "dissipation_error" in values
    file = tmp_path / "a.toml"
    file.write_text(study(quantities=("dissipation",)).text)
    plain = tmp_path / "a.nc"
    run(study(), plain, workers=1)
    planned = CliRunner().invoke(main, ["plan", str(file), "--results", str(tmp_path)]).output
    assert "quantities         dissipation" in planned
    assert "to be computed     4" in planned
    assert "4 of them lack quantities alone" in planned
    run(Study.from_toml(file), plain, workers=1)
    assert "quantities     dissipation" in CliRunner().invoke(main, ["info", str(plain)]).output


def test_a_worker_that_dies_gives_up_quantities_too() -> None:
    table = np.zeros((1, 12))
    lost = chunk.Chunk(np.arange(1), table, (1,), {}, chunk.Asked(("dissipation",)))
    result = chunk.given_up(lost, "gone")
    assert result.failed.all()
    assert np.isnan(result.quantities["dissipation_error"]).all()


NEAR = "phase = [0.5, 1.0]\ncritical_distance = {}"


def test_critical_distances_are_an_axis_of_the_quantities_alone() -> None:
    found = swtstudy.solve(phase=[0.5, 1.0], critical_distance=["1/20", 0.2], quantities=EVERY[:1], rtol=1e-3)
    assert found.s.dims == found.dissipation.dims == ("phase",)
    assert found.s_volume.dims == ("phase", "critical_distance")
    assert found.s_line.dims == found.s_line_error.dims == ("phase", "critical_distance", "direction")
    assert found.critical_distance.values.tolist() == [0.05, 0.2]
    assert tuple(found.direction.values) == DIRECTIONS
    one = swtstudy.solve(phase=1.0, critical_distance=0.2, rtol=1e-3)
    for name, dims in (("s_volume", ()), ("s_point", ("direction",)), ("s_line", ("direction",))):
        assert one[name].dims == dims
        there = found.isel(phase=1, critical_distance=1)
        assert (abs(one[name] - there[name]) <= one[f"{name}_error"] + there[f"{name}_error"]).all()
        assert (found[name].isel(critical_distance=1) < found[name].isel(critical_distance=0)).all()
        assert (found[name] < found.s).all()
    assert one.critical_distance.item() == 0.2


def test_their_values_are_put_where_they_belong(monkeypatch: pytest.MonkeyPatch) -> None:
    def known(scene, position, angle, distance):
        volume = np.abs(position)[:, None] * distance
        both = np.stack([volume + 1.0, volume + 2.0], axis=-1)
        return NonlocalSwt(volume, volume + 0.1, both, both + 0.1, both + 10.0, both + 10.1)

    monkeypatch.setattr(quantities, "nonlocal_swt", known)
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


def test_an_archive_gets_more_distances_and_is_merged_with_others(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "a.nc"
    few = run(study(axes=NEAR.format("[0.05]")), path, workers=1)
    asked: list[float] = []

    def counting(scene, position, angle, distance):
        asked.extend(distance.tolist())
        return whole(scene, position, angle, distance)

    whole = quantities.nonlocal_swt
    monkeypatch.setattr(quantities, "nonlocal_swt", counting)
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


def test_figures_over_critical_distances(tmp_path: Path) -> None:
    figure = '[figure]\nx = "critical_distance"\nhue = "phase"\ny = "s_volume"\n'
    axes = "phase = [0.5, 1.0]\ncritical_distance = { start = 0.01, stop = 1, num = 3, spacing = 'log' }"
    found = run(Study.from_text(study(axes=axes).text + figure), tmp_path / "a.nc", workers=1)
    (panel,) = found.swt.figure().axes
    assert panel.get_xscale() == "log"
    assert "ell" in panel.get_xlabel()
    np.testing.assert_allclose(panel.lines[1].get_ydata(), found.s_volume.isel(phase=1))
    along = found.swt.slice(critical_distance=0.1).swt.panels(x="phase", hue="direction", y="s_line")
    assert [line.get_label() for line in along.axes[0].lines] == ["depth", "critical plane"]
    assert len(found.swt.to_table()) == 2 * 3 * 2
    for change, words in (
        (('"s_volume"', '"s"'), "'critical_distance', not an axis of s in this study"),
        (('"s_volume"', '"s_line"'), "no place for the axis direction"),
        (
            ('y = "s_volume"', 'y = "s_volume"\nregimes = true'),
            r"figure\.regimes: found true over crit",
        ),
    ):
        with pytest.raises(StudyError, match=words):
            Study.from_text(study(axes=axes).text + figure.replace(*change))


@pytest.mark.parametrize(
    ("entry", "words"),
    [
        (
            "[fixed]\ncritical_distance = 0",
            r"fixed\.critical_distance: found 0 \(out of range\)",
        ),
        ("[fixed]\ncritical_distance = 'far'", r"critical_distance: found 'far' \(.*\); allowed: a number"),
        ("[axes]\ncritical_distance = []", r"axes\.critical_distance: found an empty axis"),
        ("[axes]\ncritical_distance = [0.1, '1/10']", r"distance\[1\]: found '1/10', the same as"),
        ("[fixed]\ncritical_distance = 0.1\n[axes]\ncritical_distance = [0.1]", "a fixed value and an axis"),
        ("quantities = ['s_volume']", r"\[0\]: found 's_volume'; allowed: it by giving critical_distance"),
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
