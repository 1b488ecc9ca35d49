"""Measured signals: from the file of a rig to a loop and a study."""

import re
from collections.abc import Callable
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
import real
import stand_in
import told
from told import refused, warned

import swtstudy
from swtstudy import LoadPath, Study, open_results, read_signal, run

RIG = f"rtol = 1e-3{real.RIG}"
#: A cycle in N, N and MPa.
CYCLE = np.array(
    [[200, 0, 0], [220, 60, 30], [205, 20, 10], [190, -60, -30], [185, -60, -25], [200, -20, -10]]
)


def write(path: Path, values: np.ndarray, header: str, separator: str = ",", decimal: str = ".") -> None:
    rows = [separator.join(f"{value!r}".replace(".", decimal) for value in row) for row in values.tolist()]
    path.write_text("\n".join([header, *rows, ""]), encoding="utf-8")


def smooth(phase: np.ndarray) -> np.ndarray:
    """Loads of a smooth cycle at phases."""
    normal = 200.0 + 20.0 * np.sin(phase + 0.3)
    tangential = 60.0 * np.sin(phase) + 9.0 * np.cos(3.0 * phase)
    return np.stack([normal, tangential, 5.0 + 30.0 * np.sin(phase - 0.2)], axis=1)


def test_columns_are_read_by_their_headers_whatever_separates_them(tmp_path: Path) -> None:
    columns = {"normal": "Fn [N]", "tangential": "Ft", "bulk": "σ, MPa"}
    table = np.column_stack([np.arange(6.0), CYCLE[:, 2], CYCLE[:, 0] + 0.25, CYCLE[:, 1]])
    found = {}
    for name, separator, decimal in (("a", ";", ","), ("b", "\t", "."), ("c", "|", ","), ("d", ",", ".")):
        headers = ["t", "σ, MPa", "Fn [N]", "Ft"]
        header = separator.join(f'"{each}"' for each in headers)
        write(tmp_path / name, table, header, separator, decimal)
        own = {"separator": separator, "decimal": decimal, "absolute": True, "name": "rig"}
        found[name] = read_signal(tmp_path / name, columns=columns, **own).loop
    assert len({each.code for each in found.values()}) == 1
    shifted = CYCLE + np.array([0.25, 0.0, 0.0])
    whole = LoadPath.absolute("rig", shifted)
    np.testing.assert_allclose(found["a"].vertices, whole.vertices, atol=1e-12)
    assert found["a"].mean_normal == pytest.approx(shifted[:, 0].mean())
    # Columns in blanks, which are no fixed number.
    words = "\n".join("  ".join(f"{value:10.4f}" for value in row) for row in CYCLE)
    (tmp_path / "e.dat").write_text(f"normal   tangential bulk\n{words}\n")
    blank = read_signal(tmp_path / "e.dat", separator=" ", absolute=True).loop
    np.testing.assert_allclose(blank.vertices, LoadPath.absolute("rig", CYCLE).vertices, atol=1e-12)


def test_a_study_with_absolute_forces_needs_neither_the_mean_nor_amplitudes(tmp_path: Path) -> None:
    """The same SWT as that of the deviations, about the mean that was given; also from the archive."""
    write(tmp_path / "rig.csv", CYCLE, "normal,tangential,bulk")
    text = RIG + '[loads.rig]\nfile = "rig.csv"\n'
    study = Study.from_text(text + "absolute = true\n", "s", tmp_path)
    found = run(study, tmp_path / "absolute.nc")
    off = CYCLE - [200, 0, 0]
    write(tmp_path / "rig.csv", off, "normal,tangential,bulk")
    given = "normal_force = 200\nnormal_force_amplitude = 1\ntangential_force_amplitude = 1\n"
    same = run(
        Study.from_text(text.replace("[loads", f"{given}[loads"), "s", tmp_path), tmp_path / "given.nc"
    )
    assert same.normal_force.item() == 200.0
    np.testing.assert_allclose(found.SWT, same.SWT, rtol=1e-9)
    np.testing.assert_allclose(found.peak_pressure, same.peak_pressure, rtol=1e-12)
    assert found.normal_force.item() == pytest.approx(200.0, rel=1e-12)
    # What the archive holds says the same without the file, and is known to a second run.
    (tmp_path / "rig.csv").unlink()
    again = Study.from_text(open_results(tmp_path / "absolute.nc").attrs["study"])
    assert again.grid.values("normal_force") == (200.0,)
    run(again, tmp_path / "absolute.nc", solver=stand_in.none)
    contact = swtstudy.physical(**told.RIG, load=LoadPath.absolute("rig", CYCLE))
    np.testing.assert_allclose(contact.solve(rtol=1e-3).SWT, found.SWT, rtol=1e-9)


@pytest.mark.parametrize("normal", [0, 1])
def test_a_normal_amplitude_that_is_given_leaves_the_tangential_column_a_force(normal: int) -> None:
    table = f"[loads.rig]\nabsolute = true\nvertices = {CYCLE[:, :2].tolist()}\n"
    given = f"normal_force_amplitude = {normal}\n{table}"
    grid = Study.from_text(RIG + given).grid
    assert grid.fixed["tangential_force_amplitude"] == 1.0
    assert grid.control.name == "forces"


@pytest.mark.slow
def test_each_load_of_an_axis_has_its_own_mean(tmp_path: Path) -> None:
    text = RIG.replace('load = "rig"\n', "") + '[axes]\nload = ["low", "high"]\n'
    for name, factor in (("low", 1.0), ("high", 1.5)):
        text += f"[loads.{name}]\nabsolute = true\nvertices = {(factor * CYCLE).tolist()}\n"
    both = run(Study.from_text(text), tmp_path / "both.nc")
    assert both.normal_force.dims == ("load",)
    np.testing.assert_allclose(both.normal_force, [200.0, 300.0], rtol=1e-12)
    for name in ("low", "high"):
        one = text.replace('load = ["low", "high"]', f'load = ["{name}"]')
        alone = run(Study.from_text(one), tmp_path / f"{name}.nc")
        np.testing.assert_allclose(both.SWT.sel(load=name), alone.SWT.sel(load=name), rtol=1e-9)
    assert (both.peak_pressure[1] / both.peak_pressure[0]).item() == pytest.approx(1.5 ** (1 / 3), rel=1e-6)


def test_recorded_cycles_are_folded_into_their_mean(tmp_path: Path) -> None:
    """The noise of 20 cycles is divided by √20, and its size is what they scatter by."""
    noise = np.random.default_rng(1).normal(size=(8000, 3)) * [2.0, 0.6, 0.3]
    phase = 2.0 * np.pi * np.arange(8000) / 400
    write(tmp_path / "rig.csv", smooth(phase) + noise, "normal,tangential,bulk")
    found = read_signal(tmp_path / "rig.csv", recorded_cycles=20, absolute=True)
    assert found.cycles.shape == (20, 400, 3)
    np.testing.assert_allclose(found.scatter, [2.0, 0.6, 0.3], rtol=0.05)
    left = (found.mean_cycle - smooth(phase[:400])).std(axis=0)
    np.testing.assert_allclose(left, np.array([2.0, 0.6, 0.3]) / np.sqrt(20), rtol=0.15)
    assert found.mean_normal == pytest.approx(200.0, abs=5 * 2.0 / np.sqrt(8000))
    assert len(found.loops) == 20
    assert {one.mean_normal for one in found.loops} == {found.mean_normal}
    assert re.search(r"20 cycles of 400 samples; mean normal load 200.*scatter by 2 \(normal\)", found.words)


def test_a_period_in_time_folds_a_record_that_ends_within_a_cycle(tmp_path: Path) -> None:
    """Samples every 0.011 s of cycles of 1 s: straight lines between them miss (0.011 π)²/2 of each."""
    time = 3.0 + 0.011 * np.arange(480)
    phase = 2.0 * np.pi * (time - 3.0)
    write(tmp_path / "rig.csv", np.column_stack([time, smooth(phase)]), "s,normal,tangential,bulk")
    found = read_signal(tmp_path / "rig.csv", time="s", period=1.0)
    assert found.count == 5
    assert len(found.mean_cycle) == 91
    np.testing.assert_allclose(found.mean_cycle, smooth(2.0 * np.pi * np.arange(91) / 91), atol=0.1)
    assert np.all(found.scatter < 0.1)
    # Every cycle is sampled elsewhere: harmonics are not misled by that.
    fit = read_signal(tmp_path / "rig.csv", time="s", period=1.0, harmonics=3, absolute=True).loop
    np.testing.assert_allclose(fit.harmonics["normal"][0], [1, 20.0, 0.3], atol=1e-9)
    np.testing.assert_allclose(fit.harmonics["tangential"][3], [3, 9.0, 0.5 * np.pi], atol=1e-9)
    np.testing.assert_allclose(fit.harmonics["bulk"][0][1], 5.0, atol=1e-9)
    assert fit.mean_normal == pytest.approx(200.0, abs=1e-9)


#: Said of a normal load that is noise about its mean.
CONSTANT = "rig: the normal load is constant: it moves by 2, which is noise"


@pytest.mark.parametrize(("recorded_cycles", "is_told"), [(20, False), (7, True), (21, True)])
def test_cycles_that_are_no_cycles_are_refused(tmp_path: Path, recorded_cycles: int, is_told: bool) -> None:
    """Folded at a wrong period loads vanish from the mean; a constant one leaves noise at the right one."""
    noise = np.random.default_rng(1).normal(size=(8000, 3)) * [2.0, 0.6, 0.3]
    signal = smooth(2.0 * np.pi * np.arange(8000) / 400) * [0.0, 1.0, 1.0] + noise
    write(tmp_path / "rig.csv", signal, "normal,tangential,bulk")
    if is_told:
        words = f"recorded_cycles: found {recorded_cycles}: the .* loads of its .* cycles differ by"
        refused(words, read_signal, tmp_path / "rig.csv", recorded_cycles=recorded_cycles)
    else:
        assert told_of(tmp_path / "rig.csv", recorded_cycles=recorded_cycles) == [CONSTANT]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"period": 800}, "each cycle repeats 2 times: period = 400?"),
        ({"time": "time", "frequency": 5e-4}, "each cycle repeats 5 times: frequency = 0.0025?"),
    ],
)
def test_cycles_that_repeat_are_told_with_their_number(tmp_path: Path, given: dict, words: str) -> None:
    noise = np.random.default_rng(1).normal(size=(8000, 3)) * [2.0, 0.6, 0.3]
    values = smooth(2.0 * np.pi * np.arange(8000) / 400) * [0.0, 1.0, 1.0] + noise
    table = np.column_stack([np.arange(8000), values])
    write(tmp_path / "rig.csv", table, "time,normal,tangential,bulk")
    assert told_of(tmp_path / "rig.csv", **given) == [f"rig: {words}"]
    # Every fifth cycle is another one: they do not repeat.
    table[:, 2] += 12.0 * np.sin(2.0 * np.pi * np.arange(8000) / (800 if "2 times" in words else 2000))
    write(tmp_path / "rig.csv", table, "time,normal,tangential,bulk")
    assert told_of(tmp_path / "rig.csv", **given) == [CONSTANT]


def recorded(path: Path, shares: np.ndarray, seed: int = 1) -> Path:
    """A record of cycles of 50 samples, each with its share of a tangential amplitude of 160 N."""
    wave = 160.0 * np.outer(shares, np.sin(2.0 * np.pi * np.arange(50) / 50)).ravel()
    values = np.stack([np.full(len(wave), 350.0), wave], axis=1)
    write(
        path, values + np.random.default_rng(seed).normal(scale=1.2, size=values.shape), "normal,tangential"
    )
    return path


def told_of(path: Path, **given: object) -> list[str]:
    return warned(read_signal, path, **given)[1]


def test_kept_cycles_may_have_amplitudes_of_their_own(tmp_path: Path) -> None:
    """They are no mean, of which a start-up would be told; without blocks their mean is the load."""
    recorded(tmp_path / "rig.csv", np.minimum(1.0, np.arange(0.5, 40.0) / 10.0))
    text = RIG + '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 40\n'
    start_up = "the first 4 cycles have a tangential amplitude of 31.87, the last"
    mean = r"rig: without \[\[blocks\]\] the mean of its cycles is the load"
    with pytest.warns(UserWarning, match=start_up), pytest.warns(UserWarning, match=mean):
        Study.from_text(f"{text}keep_cycles = true\n", "s", tmp_path)
    text = text.replace('load = "rig"\n', "").replace("[fixed]", f"[material]\n{real.CONSTANTS}[fixed]")
    Study.from_text(f'{text}keep_cycles = true\n[[blocks]]\nload = "rig"\nrounds = 1\n', "s", tmp_path)


def test_amplitudes_that_only_scatter_are_not_told(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    for seed, count in enumerate([1, 2, 3, 4, 5, 6, 10, 20, 40] * 4):
        spread = (0.0, 0.03, 0.1, 0.3)[seed % 4]
        shares = 1.0 + spread * random.uniform(-1.0, 1.0, count)
        told = told_of(recorded(tmp_path / "rig.csv", shares, seed), recorded_cycles=count, absolute=True)
        # Beyond a tenth their mean is no longer the load.
        assert len(told) == (count > 1 and shares.std() > 0.1), (shares, told)


def test_harmonics_are_those_of_least_squares(tmp_path: Path) -> None:
    phase = np.sort(np.random.default_rng(2).uniform(0.0, 2.0 * np.pi, 50))
    phase[[0, -1]] = 0.0, 6.26
    values = 3.0 + 2.0 * np.sin(phase + 0.5) + np.sin(7.0 * phase)
    write(tmp_path / "rig.csv", np.stack([phase, np.sin(phase), values], axis=1), "t,normal,tangential")
    given = {"time": "t", "period": 2.0 * np.pi}
    rows = read_signal(tmp_path / "rig.csv", harmonics=7, **given).loop.harmonics["tangential"]
    np.testing.assert_allclose(rows[0], [0, 3.0, 0.5 * np.pi])
    np.testing.assert_allclose(rows[1], [1, 2.0, 0.5], atol=1e-10)
    # With one that is not fitted the rest is at right angles to all that are.
    with pytest.warns(UserWarning, match="harmonics = 3 takes 2.* off the range of the tangential load"):
        rows = read_signal(tmp_path / "rig.csv", harmonics=3, **given).loop.harmonics["tangential"]
    fit = sum(size * np.sin(order * phase + angle) for order, size, angle in rows)
    base = [np.ones(50), *(f(k * phase) for k in (1, 2, 3) for f in (np.sin, np.cos))]
    np.testing.assert_allclose(np.array(base) @ (values - fit), 0.0, atol=1e-10)


def test_the_mean_is_over_the_time_not_over_the_samples(tmp_path: Path) -> None:
    rows = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [1.5, 4.0, 0.0], [2.0, 0.0, 2.0], [3.5, 0.0, 0.5]])
    write(tmp_path / "rig.csv", rows, "time,normal,tangential")
    signal = read_signal(tmp_path / "rig.csv", time="time", period=4.0, absolute=True)
    assert signal.mean_normal == pytest.approx(0.5)
    assert np.isnan(signal.scatter).all()


def test_a_noisy_signal_with_harmonics_has_the_swt_of_the_smooth_cycle(tmp_path: Path) -> None:
    noise = np.random.default_rng(3).normal(size=(2000, 3)) * [2.0, 0.6, 0.3]
    phase = 2.0 * np.pi * np.arange(2000) / 400
    write(tmp_path / "rig.csv", smooth(phase) + noise, "normal,tangential,bulk")
    text = RIG + '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 5\nharmonics = 3\n'
    found = run(Study.from_text(text, "s", tmp_path), tmp_path / "rig.nc")
    pure = {"normal": [(1, 20, 0.3)], "tangential": [(1, 60, 0), (3, 9, np.pi / 2)]}
    loop = LoadPath.harmonic_sum("pure", **pure, bulk=[(0, 5, np.pi / 2), (1, 30, -0.2)], mean_normal=200.0)
    contact = swtstudy.physical(**told.RIG, load=loop)
    assert contact.normal_force == pytest.approx(200.0)
    np.testing.assert_allclose(found.SWT, contact.solve().SWT, rtol=5e-3)


def test_a_folder_is_no_signal() -> None:
    refused(r"^\.: found a folder; allowed: a CSV file that", read_signal, ".")


def test_a_measured_load_without_units_is_refused_unless_it_is_scaled() -> None:
    rig = LoadPath.absolute("rig", CYCLE[:, :2])
    words = r"'rig' with a mean normal load of 200, without units; allowed: \[units\]"
    refused(words, swtstudy.solve, load=rig)
    given = {"normal_force_amplitude": 1 / 200, "tangential_force_amplitude": 1 / 100, "friction": 0.5}
    assert swtstudy.solve(load=rig, **given, rtol=1e-2).s.item() > 0.0
    for mean in (0.0, -3.0, "much"):
        words = "mean_normal of rig: found .*; allowed: a positive number"
        refused(words, LoadPath, "rig", [[0, 1], [0, -1]], mean)


def test_a_study_tells_of_vertices_that_are_absolute_or_have_a_mean() -> None:
    vertices = CYCLE[:, :2].tolist()
    one = Study.from_text(RIG + f"[loads.rig]\nvertices = {vertices}\nabsolute = true\n").grid
    off = (CYCLE[:, :2] - [200, 0]).tolist()
    other = Study.from_text(RIG + f"[loads.rig]\nvertices = {off}\nmean_normal = 200\n").grid
    assert one.values("load") == other.values("load")
    assert one.values("normal_force") == other.values("normal_force") == (200.0,)
    # Given by itself, it is about that.
    given = RIG.replace("[fixed]", "[fixed]\nnormal_force = 300")
    about = Study.from_text(given + f"[loads.rig]\nvertices = {off}\nmean_normal = 200\n").grid
    assert about.values("normal_force") == (300.0,)


@pytest.mark.parametrize(
    "form", ["12:30:{:06.3f}", "2026-05-01 12:30:{:06.3f}", "01.05.2026 12:30:{:06.3f}", "0:12:30:{:06.3f}"]
)
def test_times_of_day_are_seconds_from_the_first(tmp_path: Path, form: str) -> None:
    wave = np.sin(2.0 * np.pi * np.arange(40) / 20)
    rows = [f"{form.format(0.5 * k)},{300.0 + 20.0 * each},{100.0 * each}" for k, each in enumerate(wave)]
    (tmp_path / "rig.csv").write_text("\n".join(["clock,normal,tangential", *rows]))
    read = {"time": "clock", "absolute": True, "period": 10.0}
    if form.startswith("0:"):
        words = r"line 2, clock: found '0:12:30:00.000'; allowed: a finite number"
        refused(words, read_signal, tmp_path / "rig.csv", **read)
        return
    found = read_signal(tmp_path / "rig.csv", **read)
    assert found.time.tolist() == [0.5 * k for k in range(40)]
    assert (found.count, found.period) == (2, 10.0)
    # Between semicolons, with decimal commas.
    text = (tmp_path / "rig.csv").read_text().replace(",", ";").replace(".", ",")
    (tmp_path / "rig.csv").write_text(text.replace("01,05,2026", "01.05.2026"))
    assert read_signal(tmp_path / "rig.csv", decimal=",", **read).time.tolist() == found.time.tolist()


#: Forms of dates and times, and their moments; fractions of zero are dropped where a form ends with a point.
ACROSS_MIDNIGHT = {
    "%Y-%m-%d %H:%M:%S.": "a workbook, or str(datetime)",
    "%Y-%m-%dT%H:%M:%S.%fZ": "ISO 8601",
    "%d.%m.%Y %H:%M:%S.%f": "the day first",
    "%d.%m.%y %H:%M:%S.": "the day first, and two digits",
    "%d/%m/%Y %H:%M:%S.": "the day first, by the shorter record",
    "%m/%d/%Y %I:%M:%S.%f %p": "the month first",
    "%H:%M:%S.": "times of day",
    "%H:%M:%S.%f": "times of day with fractions",
    "%I:%M:%S.%f PM": "half days",
    "%M:%S.": "minutes",
}


@pytest.mark.parametrize("form", ACROSS_MIDNIGHT, ids=ACROSS_MIDNIGHT.values())
@pytest.mark.parametrize("day", [1, 11, 12])
def test_dates_and_times_pass_midnight(tmp_path: Path, form: str, day: int) -> None:
    begin, rows = datetime(2026, 12, day, 23, 59, 50), []
    for k in range(40):
        at, load = begin + timedelta(seconds=0.5 * k), np.sin(2.0 * np.pi * k / 20)
        cell = at.strftime(form + "%f").removesuffix(".000000") if form.endswith(".") else at.strftime(form)
        cell = cell.replace("PM", "AM") if at.hour < 12 else cell
        rows.append(f"{cell},{300.0 + 20.0 * load},{100.0 * load}")
    (tmp_path / "rig.csv").write_text("\n".join(["clock,normal,tangential", *rows]))
    found = read_signal(tmp_path / "rig.csv", time="clock", absolute=True, period=10.0)
    np.testing.assert_allclose(found.time, 0.5 * np.arange(40), atol=1e-9)


def test_a_time_that_is_none_is_named_with_forms_of_times(tmp_path: Path) -> None:
    rows = ["2026-12-01 12:00:00,200,0", "2026-12-01 12:00:01,210,9", "2026-12-01 12:61:02,190,-9"]
    (tmp_path / "rig.csv").write_text("\n".join(["time,normal,tangential", *rows]))
    words = "line 4, time: found '2026-12-01 12:61:02'; allowed: a finite number, or times in all rows, such"
    refused(words, read_signal, tmp_path / "rig.csv", time="time")


def test_exchanged_columns_are_told(tmp_path: Path) -> None:
    wave = np.sin(2.0 * np.pi * np.arange(50) / 50)
    write(tmp_path / "rig.csv", np.stack([60.0 * wave, 200.0 + 20.0 * wave], axis=1), "normal,tangential")
    signal = read_signal(tmp_path / "rig.csv", absolute=True)
    refused("tangential loads are 180 and more: are the columns exchanged", lambda: signal.mean_normal)
    rows = np.stack([60.0 * wave + 1.0, 200.0 + 20.0 * wave], axis=1)  # about a small mean
    write(tmp_path / "rig.csv", rows, "normal,tangential")
    signal = read_signal(tmp_path / "rig.csv", absolute=True)
    refused("normal load of 1, down to -58.* are the columns exchanged", lambda: signal.mean_normal)


def test_a_gap_in_the_time_is_warned_of(tmp_path: Path) -> None:
    time = np.arange(400) / 2000.0
    wave = np.sin(40.0 * np.pi * time)
    rows = np.stack([time, 300.0 + 20.0 * wave, 100.0 * wave], axis=1)
    write(tmp_path / "gap.csv", np.delete(rows, slice(110, 210), axis=0), "time,normal,tangential")
    with pytest.warns(
        UserWarning, match=r"gap: a gap of 0.0505 in the time, at 0.0545, where most .* 0.0005"
    ):
        read_signal(tmp_path / "gap.csv", time="time", absolute=True, period=0.05)
    # A quarter of a period is none, nor are the corners of a slow cycle.
    for name, lost in (("less", slice(110, 130)), ("corners", np.flatnonzero(np.arange(400) % 25))):
        write(tmp_path / f"{name}.csv", np.delete(rows, lost, axis=0), "time,normal,tangential")
        read_signal(tmp_path / f"{name}.csv", time="time", absolute=True, period=0.05)


@pytest.mark.parametrize("pause", [20.0, 1000.0])
@pytest.mark.parametrize("despike", [False, True])
def test_a_long_pause_leaves_the_cycle_as_it_is(tmp_path: Path, pause: float, despike: bool) -> None:
    time = np.arange(2000) / 100.0
    wave = np.sin(2.0 * np.pi * time)
    time[1000:] += pause
    rows = np.stack([time, 200.0 + 20.0 * wave, 60.0 * wave**15], axis=1)
    write(tmp_path / "gap.csv", rows, "time,normal,tangential")
    words = f"{pause + 1:.0f} of {pause + 20:.0f} cycles are left out"
    with pytest.warns(UserWarning, match=words):
        signal = read_signal(tmp_path / "gap.csv", time="time", absolute=True, period=1, despike=despike)
    np.testing.assert_allclose(signal.mean_cycle[:, 1], rows[:100, 2], atol=1e-9)


def test_a_number_of_cycles_does_not_tell_their_length_beside_a_gap(tmp_path: Path) -> None:
    time = np.arange(2000) / 100.0
    wave = np.sin(2.0 * np.pi * time)
    time[1000:] += 0.3
    write(tmp_path / "gap.csv", np.stack([time, 200.0 + 0.1 * wave, wave], axis=1), "time,normal,tangential")
    words = "recorded_cycles: found 20, and a gap of 0.31 in the time, at 9.99; allowed: period = .*, 1 if"
    refused(words, read_signal, tmp_path / "gap.csv", time="time", absolute=True, recorded_cycles=20)
    words = "a file of the rows on one side of the gap in the time, at 9.99$"
    refused(words, read_signal, tmp_path / "gap.csv", time="time", absolute=True, period=1)


def test_cycles_with_a_gap_are_left_out(tmp_path: Path) -> None:
    time = np.arange(800) / 2000.0
    wave = np.sin(40.0 * np.pi * time)
    rows = np.stack([time, 300.0 + 20.0 * wave, 100.0 * wave], axis=1)
    lost = np.concatenate([np.arange(110, 160), np.arange(430, 490)])  # within cycles 2, and 5
    write(tmp_path / "gap.csv", np.delete(rows, lost, axis=0), "time,normal,tangential")
    words = "a gap of 0.0255 in the time, at 0.0545 and 1 more, where .*: 2 of 8 cycles are left out"
    with pytest.warns(UserWarning, match=words):
        signal = read_signal(tmp_path / "gap.csv", time="time", absolute=True, period=0.05)
    assert [each.name for each in signal.loops] == [f"gap {number}" for number in (1, 3, 4, 6, 7, 8)]
    phase = 2.0 * np.pi * np.arange(len(signal.mean_cycle)) / len(signal.mean_cycle)
    np.testing.assert_allclose(signal.mean_cycle[:, 1], 100.0 * np.sin(phase), atol=0.1)
    assert signal.mean_normal == pytest.approx(300.0, abs=1e-9)


def bursts(path: Path, at: list[float], length: float, frequency: float = 1.0, grow: float = 0.0) -> None:
    """Write cycles with noise that are recorded from some times on, 20 samples in a unit of time."""
    single = np.arange(round(20 * length)) / 20.0
    time = np.concatenate([begin + single for begin in at])
    phase = 2.0 * np.pi * frequency * time
    grown = np.repeat([1.0 - grow * 0.5**k for k in range(len(at))], len(single))
    loads = np.stack([300.0 + 20.0 * np.sin(phase), 100.0 * grown * np.sin(phase)], axis=1)
    loads += np.random.default_rng(3).normal(scale=0.5, size=loads.shape)
    write(path, np.column_stack([time, loads]), "time,normal,tangential")


def test_bursts_of_the_right_period_do_not_drift(tmp_path: Path) -> None:
    """Noise shifts three cycles by so little that the many cycles between bursts must not count."""
    bursts(tmp_path / "rig.csv", [1e4 * k for k in range(30)], 3.4)
    (line,) = told_of(tmp_path / "rig.csv", time="time", absolute=True, period=1.0)
    assert "cycles are left out" in line


@pytest.mark.parametrize("frequency", [1.01, 1.0003, 1.00003])
def test_bursts_that_do_not_fit_together_are_told_with_their_period(tmp_path: Path, frequency: float) -> None:
    """Within a burst the phase changes by a tenth of a cycle, or far less than noise tells."""
    bursts(tmp_path / "rig.csv", [1000.0 * k for k in range(20)], 10.2, frequency)
    given = {"time": "time", "absolute": True}
    try:
        said = " ".join(told_of(tmp_path / "rig.csv", frequency=1.0, **given))
    except swtstudy.StudyError as error:
        said = str(error)
    found = float(re.search("such as frequency = ([0-9.]+[0-9])", said)[1])
    assert found == pytest.approx(frequency, abs=1e-6)  # a fiftieth of a cycle in the whole record
    (line,) = told_of(tmp_path / "rig.csv", frequency=found, **given)
    assert "cycles are left out" in line


def test_a_start_up_in_bursts_is_no_drift(tmp_path: Path) -> None:
    """The cycles to skip are counted with the cycles in gaps."""
    bursts(tmp_path / "rig.csv", [100.0 * k for k in range(20)], 10.2, grow=0.5)
    given = {"time": "time", "absolute": True, "period": 1.0}
    _, line = told_of(tmp_path / "rig.csv", **given)
    assert "have a tangential amplitude of" in line
    skip = int(re.search("skip_cycles = ([0-9]+) leaves", line)[1])
    assert skip % 100 == 0
    (line,) = told_of(tmp_path / "rig.csv", skip_cycles=skip, **given)
    assert "cycles are left out" in line


def test_a_gap_of_any_length_takes_no_room(tmp_path: Path) -> None:
    given = {"time": "time", "absolute": True, "period": 1.0}
    bursts(tmp_path / "rig.csv", [0.0, 1e12], 10.2)
    (line,) = told_of(tmp_path / "rig.csv", **given)
    assert line.endswith(": 999999999990 of 1000000000010 cycles are left out")
    bursts(tmp_path / "rig.csv", [0.0, 1e12], 0.8)
    (line,) = told_of(tmp_path / "rig.csv", **given)
    assert line.endswith("the loads there are unknown")


def test_by_a_period_the_last_sample_is_of_the_next_cycle(tmp_path: Path) -> None:
    closed = np.array([[0.0, 200, 0], [0.25, 260, 60], [0.5, 200, 0], [0.75, 200, -60], [1.0, 200, 0]])
    write(tmp_path / "closed.csv", closed, "time,normal,tangential")
    signal = read_signal(tmp_path / "closed.csv", time="time", absolute=True, period=1.0)
    assert signal.mean_normal == pytest.approx(215.0)


@pytest.mark.parametrize("cycles", [1, 2, 3, 20])
@pytest.mark.parametrize("height", [25.0, 85.0, -350.0])
def test_a_single_spike_is_told_in_any_number_of_cycles(cycles: int, height: float, tmp_path: Path) -> None:
    phase = 2.0 * np.pi * np.arange(200 * cycles) / 200
    noise = np.random.default_rng(3).normal(scale=0.5, size=(len(phase), 2))
    clean = np.stack([500.0 + 0.0 * phase, 60.0 * np.sin(phase)], axis=1) + noise
    spoilt = clean.copy()
    spoilt[129, 1] += height
    given = {"recorded_cycles": cycles, "absolute": True}
    write(tmp_path / "spoilt.csv", spoilt, "normal,tangential")
    write(tmp_path / "clean.csv", clean, "normal,tangential")
    message = f"spoilt: tangential {spoilt[129, 1]:g} in cycle 1, line 131 of the file, .* despike = true"
    with pytest.warns(UserWarning, match=message):
        read_signal(tmp_path / "spoilt.csv", **given)
    expected = read_signal(tmp_path / "clean.csv", **given)
    with pytest.warns(UserWarning, match="spoilt: 1 spike replaced, tangential .* line 131 of the file, by"):
        found = read_signal(tmp_path / "spoilt.csv", despike=True, **given)
    # A phase of 2π/200 changes the load by 2 N, the noise by three times 0.5 N.
    np.testing.assert_allclose(found.values, expected.values, atol=3.5)
    assert np.count_nonzero(found.values != expected.values) == 1


@pytest.mark.parametrize("cycles", [1, 2])
@pytest.mark.parametrize("shape", ["trapezoid", "triangle", "sine"])
def test_a_spike_anywhere_leaves_the_samples_beside_it(shape: str, cycles: int, tmp_path: Path) -> None:
    """The first and the last sample, too: a cycle goes on with itself."""
    phase = 2.0 * np.pi * (np.arange(40 * cycles) / 40 + (0.025 if shape == "triangle" else 0.03))
    steep = {"trapezoid": np.clip(3.0 * np.sin(phase), -1.0, 1.0), "sine": np.sin(phase)}
    clean = 60.0 * steep.get(shape, 2.0 / np.pi * np.arcsin(np.sin(phase)))
    for place in [*range(0, len(clean), 1 if (shape, cycles) == ("trapezoid", 1) else 7), len(clean) - 1]:
        spoilt = clean.copy()
        spoilt[place] += 300.0 if place % 2 else -300.0
        write(tmp_path / "rig.csv", np.stack([20.0 * np.cos(phase), spoilt], axis=1), "normal,tangential")
        with pytest.warns(UserWarning, match="rig: 1 spike replaced, tangential"):
            found = read_signal(tmp_path / "rig.csv", recorded_cycles=cycles, despike=True).values[:, 1]
        assert np.flatnonzero(found != spoilt).tolist() == [place]
        # A corner of the trapezoid is off the line beside it by half of a step.
        assert abs(found[place] - clean[place]) < 15.0


def waves(cycles: int, samples: int = 100, shape: str = "sine") -> np.ndarray:
    """Cycles of a tangential load of 60 N with noise."""
    turn = np.mod(np.arange(cycles * samples) / samples, 1.0)
    load = {"sine": np.sin(2.0 * np.pi * turn), "square": np.where(turn < 0.5, 1.0, -1.0)}[shape]
    return 60.0 * load + np.random.default_rng(3).normal(scale=0.3, size=len(turn))


@pytest.mark.parametrize("width", [2, 3, 5])
@pytest.mark.parametrize("cycles", [1, 2, 3, 20])
@pytest.mark.parametrize("place", [25, 65])  # at a tip, and at a side
def test_a_spike_of_several_samples_is_taken_out(tmp_path: Path, cycles: int, width: int, place: int) -> None:
    clean = waves(cycles)
    spoilt = clean.copy()
    spoilt[place : place + width] += 25.0
    write(tmp_path / "rig.csv", np.stack([0.0 * clean + 500.0, spoilt], axis=1), "normal,tangential")
    given = {"recorded_cycles": cycles, "absolute": True}
    words = f"tangential .* in cycle 1, line {place + 2} of the file, .*, and {width - 1} more: a spike"
    assert re.search(words, " ".join(told_of(tmp_path / "rig.csv", **given)))
    with pytest.warns(UserWarning, match=f"rig: {width} spikes replaced"):
        found = read_signal(tmp_path / "rig.csv", despike=True, **given).values[:, 1]
    assert np.flatnonzero(found != spoilt).tolist() == [*range(place, place + width)]
    np.testing.assert_allclose(found, clean, atol=2.0)


#: Loads that are no spikes, of so many cycles: the shape, samples, and what is added to them.
NO_SPIKES = {
    "a pulse of a twelfth": (1, "sine", {(20, 28): 30.0}),
    "a swing after a step": (1, "square", {(0, 3): 50.0, (3, 7): -15.0, (50, 53): -50.0, (53, 57): 15.0}),
    "a pulse of both cycles": (2, "sine", {(25 + k, 28 + k): 30.0 for k in (0, 100)}),
    "a pulse of every fourth cycle": (24, "sine", {(25 + k, 28 + k): 30.0 for k in range(0, 2400, 400)}),
    "a pulse that comes late": (20, "sine", {(25 + k, 28 + k): 30.0 for k in (*range(0, 1900, 100), 1903)}),
    "a half-cycle of its own": (20, "square", {(1000, 1050): 30.0}),
    "a cycle of its own": (
        20,
        "sine",
        {(k, k + 1): 30.0 * np.sin(0.02 * np.pi * k) for k in range(300, 400)},
    ),
    "a small pulse": (20, "sine", {(25, 28): 10.0}),
}


@pytest.mark.parametrize(("cycles", "shape", "added"), NO_SPIKES.values(), ids=NO_SPIKES)
def test_loads_of_several_samples_are_no_spikes(
    tmp_path: Path, cycles: int, shape: str, added: dict[tuple[int, int], float]
) -> None:
    load = waves(cycles, shape=shape)
    for rows, height in added.items():
        load[slice(*rows)] += height
    write(tmp_path / "rig.csv", np.stack([0.0 * load + 500.0, load], axis=1), "normal,tangential")
    said = told_of(tmp_path / "rig.csv", recorded_cycles=cycles, absolute=True)
    assert not [line for line in said if "spike" in line]


def test_sharp_tips_steps_and_pulses_of_every_cycle_are_no_spikes(tmp_path: Path) -> None:
    turn = np.arange(64) / 64
    triangle = 60.0 * np.abs(4.0 * turn - 2.0) - 60.0
    coarse = 60.0 * np.sin(2.0 * np.pi * np.arange(16) / 16)
    step = np.where(turn < 0.5, 60.0, -60.0)
    pulses = np.tile(np.where(np.arange(16) == 15, 60.0, -60.0), 4)
    for name, load, cycles in (
        ("triangle", triangle, 1),
        ("coarse", coarse, 1),
        ("step", step, 1),
        ("pulses", pulses, 4),
        ("two pulses", pulses[:32], 2),
    ):
        write(tmp_path / f"{name}.csv", np.stack([500.0 + 0.0 * load, load], axis=1), "normal,tangential")
        read_signal(tmp_path / f"{name}.csv", recorded_cycles=cycles, absolute=True)


def test_steep_cycles_that_come_a_little_late_have_no_spikes(tmp_path: Path) -> None:
    late = np.random.default_rng(1).integers(0, 2, 25)
    square = np.concatenate([np.roll(np.repeat([60.0, -60.0], 25), each) for each in late])
    write(tmp_path / "square.csv", np.stack([np.full(1250, 200.0), square], axis=1), "normal,tangential")
    read_signal(tmp_path / "square.csv", recorded_cycles=25)


def test_loads_of_periods_of_their_own_do_not_repeat_together(tmp_path: Path) -> None:
    phase = 2.0 * np.pi * np.arange(500) / 500
    both = np.stack([20.0 * np.sin(5.0 * phase), 60.0 * np.sin(7.0 * phase)], axis=1)
    write(tmp_path / "both.csv", both, "normal,tangential")
    assert told_of(tmp_path / "both.csv") == []


def test_kept_cycles_that_ride_on_a_slower_one_are_told(tmp_path: Path) -> None:
    phase = 2.0 * np.pi * np.arange(1000) / 1000
    for slow, is_told in ((60.0, True), (0.0, False)):
        wave = slow * np.sin(phase) + 15.0 * np.sin(20.0 * phase)
        write(tmp_path / "rig.csv", np.stack([0.0 * wave + 300.0, wave], axis=1), "normal,tangential")
        text = RIG.replace('load = "rig"\n', "").replace("[fixed]", f"[material]\n{real.CONSTANTS}[fixed]")
        text += '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 20\nkeep_cycles = true\n'
        text += '[[blocks]]\nload = "rig"\nrounds = 1\n'
        _, words = warned(Study.from_text, text, "s", tmp_path)
        assert ["a slower cycle on which these ride is lost" in each for each in words] == [True] * is_told


@pytest.mark.parametrize("of_time", [{"recorded_cycles": 50}, {"period": 0.0501}, {"frequency": 1 / 0.0501}])
def test_cycles_of_a_start_up_are_left_out(tmp_path: Path, of_time: dict[str, float]) -> None:
    time = np.arange(50 * 31) * (0.0501 / 31)
    grown = np.minimum(1.0, 0.5 + time / 0.0501 / 24)
    wave = np.sin(2.0 * np.pi * time / 0.0501)
    rows = np.stack([time, 300.0 + 20.0 * wave, 100.0 * grown * wave], axis=1)
    write(tmp_path / "up.csv", rows, "time,normal,tangential")
    given = {"time": "time", "absolute": True, **of_time}
    with pytest.warns(UserWarning, match="skip_cycles = 11 leaves a start-up out"):
        read_signal(tmp_path / "up.csv", **given)
    signal = read_signal(tmp_path / "up.csv", skip_cycles=12, **given)
    assert signal.count == len(signal.cycles) == 38
    np.testing.assert_allclose(np.ptp(signal.mean_cycle, axis=0), [40.0, 200.0], rtol=3e-3)
    words = "skip_cycles: found 50 of 50 cycles; allowed: fewer than all"
    refused(words, read_signal, tmp_path / "up.csv", skip_cycles=50, **given)


def test_columns_in_two_units_contradict_each_other_without_a_study(tmp_path: Path) -> None:
    rows = np.array([[200.0, 0.0], [210.0, 10.0], [190.0, -10.0]])
    write(tmp_path / "two.csv", rows, "Fn [N],Ft [lbf]")
    given = {"columns": {"normal": "Fn [N]", "tangential": "Ft [lbf]"}, "absolute": True}
    words = r"'Ft \[lbf\]' in lbf beside normal in N; allowed: scale = { tangential = 4.44822 }: one unit"
    refused(words, read_signal, tmp_path / "two.csv", **given)
    scaled = read_signal(tmp_path / "two.csv", **given, scale={"tangential": 4.44822})
    assert scaled.values[:, 1].max() == pytest.approx(44.4822)
    write(tmp_path / "mixed.csv", rows, "Fn [N],u [µm]")  # a force and a displacement
    read_signal(tmp_path / "mixed.csv", columns={"normal": "Fn [N]", "tangential": "u [µm]"}, absolute=True)
    write(tmp_path / "trace.csv", rows, "position [mm],height [µm]")
    columns = {"position": "position [mm]", "height": "height [µm]"}
    refused("in µm beside position in mm", swtstudy.read_trace, tmp_path / "trace.csv", columns=columns)


def record_of(path: Path, *columns: Callable, samples: float, count: int = 400, noise: float = 0.0) -> Path:
    """A record of loads over turns, at so many samples a cycle."""
    turn = (np.arange(count) + 0.5) / samples
    rows = np.stack([turn, *(of(turn) for of in columns)], axis=1)
    rows[:, 1:] += noise * np.random.default_rng(5).normal(size=rows[:, 1:].shape)
    names = ("time", "normal", "tangential", "bulk")[: rows.shape[1]]
    np.savetxt(path, rows, "%.12g", ",", header=",".join(names), comments="")
    return path


def constant(turn: np.ndarray) -> np.ndarray:
    return 500.0 + 0.0 * turn


def sine(turn: np.ndarray) -> np.ndarray:
    return 150.0 * np.sin(2.0 * np.pi * turn)


def triangle(turn: np.ndarray) -> np.ndarray:
    return 300.0 / np.pi * np.arcsin(np.sin(2.0 * np.pi * turn))


def square(turn: np.ndarray) -> np.ndarray:
    return np.where(np.mod(turn, 1.0) < 0.5, 150.0, -150.0)


def held(turn: np.ndarray) -> np.ndarray:
    return 150.0 * np.clip(2.0 * np.sin(2.0 * np.pi * turn), -1.0, 1.0)


@pytest.mark.parametrize(
    ("load", "samples", "given", "words"),
    [
        (sine, 8, {}, r"8 samples a cycle: .* take 7\.3% off .*; harmonics = 1 takes nothing off"),
        (sine, 8, {"harmonics": 1}, ""),
        (sine, 40, {}, ""),
        (triangle, 12, {}, r"12 samples a cycle: .* off .*; more samples are needed, or vertices"),
        (triangle, 9.6, {}, r"at other phases in each.* off .*; more samples are needed, or vertices"),
        (triangle, 1000, {}, ""),
        (triangle, 200, {"harmonics": 3}, r"harmonics = 3 takes \S+% off the range of the tangential load"),
        (triangle, 9.6, {"harmonics": 3}, r"harmonics = 3 takes \S+% off the range of the tangential load"),
        (held, 200, {"harmonics": 5}, r"harmonics = 5 adds \S+% to the range of the tangential load"),
        (square, 16, {}, ""),
        (held, 20, {}, ""),
    ],
)
def test_tips_of_a_load_that_are_lost_are_told(
    load: Callable, samples: float, given: dict[str, int], words: str, tmp_path: Path
) -> None:
    path = record_of(tmp_path / "rig.csv", constant, load, samples=samples, count=int(40 * samples))
    told = warned(read_signal, path, time="time", absolute=True, period=1.0, **given)[1]
    assert len(told) == bool(words), told
    assert all(re.search(words, each) for each in told)


def test_noise_that_raises_the_tips_of_a_load_is_told(tmp_path: Path) -> None:
    path = record_of(tmp_path / "rig.csv", constant, sine, samples=1000, count=1000, noise=3.0)
    given = {"time": "time", "absolute": True, "period": 1.0}
    told = warned(read_signal, path, **given)[1]
    assert len(told) == 1
    assert re.search(r"noise of 3\S* raises the tips of the tangential load by some 4\.\d%", told[0])
    signals = [warned(read_signal, path, **given, **form)[0] for form in ({}, {"harmonics": 1})]
    ends = [np.ptp(signal.loop.ends[1]) for signal in signals]
    assert 1.03 < ends[0] / 300.0 < 1.08
    assert ends[1] / 300.0 == pytest.approx(1.0, rel=2e-3)


@pytest.mark.parametrize("noise", [0.5, 3.0])
def test_noise_does_not_take_a_bulk_stress_off_the_load_that_it_follows(noise: float, tmp_path: Path) -> None:
    def pulled(turn: np.ndarray) -> np.ndarray:
        return 40.0 + 0.25 * sine(turn)

    given = {"time": "time", "absolute": True, "period": 1.0}
    path = record_of(tmp_path / "rig.csv", constant, sine, pulled, samples=100, count=100, noise=noise)
    signal = warned(read_signal, path, **given)[0]
    normal, tangential, bulk = signal.loop.vertices.T
    assert np.ptp(normal) == 0.0
    np.testing.assert_allclose(
        bulk - bulk.mean(), 0.25 * (tangential - tangential.mean()), rtol=0.05, atol=1e-9
    )

    def late(turn: np.ndarray) -> np.ndarray:
        return pulled(turn - 0.2)

    path = record_of(tmp_path / "late.csv", constant, sine, late, samples=100, count=100, noise=noise)
    _, tangential, bulk = warned(read_signal, path, **given)[0].loop.vertices.T
    assert np.abs(np.corrcoef(tangential, bulk)[0, 1]) < 0.5
