"""Blocks of loads: Miner's sum, held against the same by hand."""

from pathlib import Path

import numpy as np
import pytest
import stand_in
import told
from command import succeeded
from real import ALLOY, ALUMINIUM, SPHERE
from told import refused

import swtstudy
from swtstudy import LoadPath, Study, open_results, run

RIG = f"""
title = "Blocks"
rtol = 1e-3
{ALLOY}[fixed]
{SPHERE}body = 1
"""
#: With means, each of which has a life.
WITH_MEANS = RIG + "critical_distance = 0.05\n"
START = "[loads.start-up]\nabsolute = true\nvertices = [[150, -50], [180, 60], [150, 20]]\n"
RUNNING = "[loads.running]\nabsolute = true\nvertices = [[200, -60], [210, 60]]\n"
#: Parameters and loads of the same in Python.
SAME = told.RIG | {"body": 1}
LOADS = [
    LoadPath.absolute("start-up", [[150, -50], [180, 60], [150, 20]]),
    LoadPath.absolute("running", [[200, -60], [210, 60]]),
]


def block(load: str, rounds: object) -> str:
    return f'[[blocks]]\nload = "{load}"\nrounds = {rounds}\n'


@pytest.mark.slow
def test_the_sequence_ends_when_the_damage_of_its_blocks_is_one(tmp_path: Path) -> None:
    """Both loads with a mean of their own, one of them in two blocks; lives of each in studies of its own."""
    blocks = block("start-up", 10) + block("running", 1e3) + block("start-up", 5.5)
    study = Study.from_text(WITH_MEANS + START + RUNNING + blocks)
    found = run(study, tmp_path / "blocks.nc")
    own = []
    for name, load in (("start-up", START), ("running", RUNNING)):
        text = WITH_MEANS.replace("[fixed]", f'[fixed]\nload = "{name}"') + load
        own.append(run(Study.from_text(text), tmp_path / f"{name}.nc"))
    for end in ("", "_volume", "_point", "_line"):
        starting, running = (each[f"cycles{end}"] for each in own)
        damage = 15.5 / starting, 1e3 / running
        np.testing.assert_allclose(found[f"repetitions{end}"], 1.0 / sum(damage), rtol=1e-9)
        share = found[f"damage_share{end}"]
        np.testing.assert_allclose(share.sel(load="running"), damage[1] / sum(damage), rtol=1e-9)
        np.testing.assert_allclose(share.sum("load"), 1.0, rtol=1e-12)
    assert found.repetitions.dims == ()
    assert found.cycles.dims == ("load",)
    assert "worst place" in found.repetitions.comment
    # The archive knows its blocks, also where they come from files.
    archived = open_results(tmp_path / "blocks.nc")
    run(Study.from_text(archived.attrs["study"]), tmp_path / "blocks.nc", solver=stand_in.none)
    np.testing.assert_array_equal(archived.repetitions, found.repetitions)


def test_a_single_load_and_a_contact_in_python_have_blocks_too(tmp_path: Path) -> None:
    found = run(Study.from_text(RIG + RUNNING + block("running", 250)), tmp_path / "one.nc")
    np.testing.assert_allclose(found.repetitions, found.cycles / 250.0, rtol=1e-12)
    assert found.damage_share.item() == 1.0
    contact = swtstudy.physical(**SAME, load=LOADS)
    both = contact.solve(rtol=1e-3, constants=ALUMINIUM, blocks={"start-up": 10, "running": 1e3})
    damage = (np.array([10, 1e3]) / both.cycles).sum("load")
    np.testing.assert_allclose(both.repetitions, 1.0 / damage, rtol=1e-12)
    np.testing.assert_allclose(both.cycles.sel(load="running"), found.cycles, rtol=1e-9)
    for blocks, words in (
        ({"runing": 1, "start-up": 1}, r"blocks: found 'runing'; allowed: did you mean running"),
        ({"running": -1, "start-up": 1}, r"blocks.running: found -1; allowed: a positive number of rounds"),
        ([("running", 1)], r"blocks: found \[\('running', 1\)\]; allowed: rounds by the name of each load"),
        ({"running": 1}, r"blocks: found no rounds of 'start-up'; allowed: rounds of each load"),
    ):
        refused(words, contact.solve, constants=ALUMINIUM, blocks=blocks)


@pytest.mark.quick(1)
@pytest.mark.parametrize("count", [2, 5, 10])
def test_equal_cycles_in_a_round_have_so_many_times_the_damage(count: int) -> None:
    """As blocks of a single one have; exactly, since all of them are the same."""
    newton = {"normal_force": 200.0, "normal_force_amplitude": 1.0, "tangential_force_amplitude": 1.0}
    loads = [LoadPath("one", [[0, 60], [0, -60]]), LoadPath("many", [[0, 60], [0, -60]] * count)]
    found = swtstudy.physical(**SAME, load=loads, **newton).solve(constants=ALUMINIUM)
    one, many = found.cycles.values
    assert one / many == pytest.approx(count, rel=1e-9)


def test_recorded_cycles_are_blocks_one_by_one_if_they_are_kept(tmp_path: Path) -> None:
    cycles = np.array([[200, 0], [210, 60], [190, -60]])[None] * np.array([1.0, 0.9, 1.0, 0.8])[:, None, None]
    lines = [f"{normal!r},{tangential!r}" for normal, tangential in cycles.reshape(-1, 2).tolist()]
    (tmp_path / "rig.csv").write_text("\n".join(["normal,tangential", *lines]))
    table = '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 4\nkeep_cycles = true\n'
    with pytest.warns(UserWarning, match="means of the normal load in its cycles range over 40"):
        study = Study.from_text(RIG + table + block("rig", 25), "s", tmp_path)
    assert list(map(str, study.grid.values("load"))) == [f"rig {k}" for k in (1, 2, 3, 4)]
    found = run(study, tmp_path / "rig.nc")
    np.testing.assert_allclose(found.repetitions, 1.0 / (25.0 / found.cycles).sum("load"), rtol=1e-12)
    # The first and the third cycle are the same.
    share = found.damage_share.values
    assert share[0] == share[2] > share[1] > share[3]
    (tmp_path / "rig.csv").unlink()
    again = Study.from_text(study.text)
    assert again.grid.blocks == study.grid.blocks
    run(again, tmp_path / "rig.nc", solver=stand_in.none)


def test_a_figure_shows_the_share_of_each_load(tmp_path: Path) -> None:
    text = RIG + "[axes]\nwalker_exponent = [0.4, 0.5]\n" + START + RUNNING
    text += block("start-up", 10) + block("running", 1e3)
    text += '[figure]\nx = "walker_exponent"\nhue = "load"\ny = "damage_share"\n'
    results = run(Study.from_text(text), tmp_path / "shares.nc")
    (axes,) = results.swt.figure().axes
    lines = {line.get_label(): line.get_ydata() for line in axes.get_lines()}
    np.testing.assert_allclose(lines["running"], results.damage_share.sel(load="running"))
    assert Study.from_text(text.replace('hue = "load"\n', "").replace("damage_share", "repetitions")).figure


def test_repetitions_are_drawn_and_reported(tmp_path: Path) -> None:
    """Of loads with stick zones that differ: a bulk stress moves that of the second one alone."""
    loads = "[loads.one]\nvertices = [[0, 0.5], [0, -0.5]]\n"
    loads += "[loads.other]\nvertices = [[0, 1, 1], [0, -1, -1]]\n" + block("one", 1000) + block("other", 10)
    fixed = "normal_force = 200\ntangential_force_amplitude = 60\nbulk_stress_amplitude = 20\n"
    text = RIG.replace("friction = 0.5\n", "") + fixed + "[axes]\nfriction = [0.5, 0.6, 0.7]\n" + loads
    text += '[figure]\nx = "friction"\ny = "repetitions"\nvalidity = true\nregimes = true\n'
    results = run(Study.from_text(text), tmp_path / "several.nc")
    assert np.ptp(results.stick_zone.values) > 0
    (axes,) = results.swt.figure().axes
    np.testing.assert_allclose(axes.get_lines()[0].get_ydata(), results.repetitions)
    succeeded("report", tmp_path / "several.nc", "-o", tmp_path / "several.html")


@pytest.mark.slow
def test_lives_of_shear_are_summed_as_those_of_tension(tmp_path: Path) -> None:
    """By hand; of one criterion alone, and beside the other one."""
    text = RIG.replace("[fixed]", "yield_strength = 350\n[fixed]\nnormal_sensitivity = 0.3")
    text += 'criterion = "fatemi_socie"\n' + START + RUNNING + block("start-up", 10) + block("running", 1e3)
    alone = run(Study.from_text(text), tmp_path / "alone.nc")
    damage = np.array([10, 1e3]) / alone.FS_cycles
    np.testing.assert_allclose(alone.FS_repetitions, 1.0 / damage.sum("load"), rtol=1e-12)
    np.testing.assert_allclose(alone.FS_damage_share, damage / damage.sum("load"), rtol=1e-12)
    assert alone.FS_repetitions.long_name.startswith("repetitions to a crack by shear constants")
    assert alone.FS_repetitions.symbol == r"N_\mathrm{seq, FS}"
    both = text.replace('criterion = "fatemi_socie"\n', '[axes]\ncriterion = ["swt", "fatemi_socie"]\n')
    found = run(Study.from_text(both), tmp_path / "both.nc")
    np.testing.assert_allclose(found.FS_repetitions.sel(criterion="fatemi_socie"), alone.FS_repetitions)


RECORD = 'file = "rig.csv"\nabsolute = true\nrecorded_cycles = 2\nkeep_cycles = true\n'


def test_cycles_that_are_kept_are_those_of_their_load_alone(tmp_path: Path) -> None:
    """Cycles of "rig b" had counted as those of "rig", too."""
    (tmp_path / "rig.csv").write_text("normal,tangential\n" + "200,0\n210,60\n190,-60\n" * 2)
    both = f'[loads.rig]\n{RECORD}[loads."rig b"]\n{RECORD}' + block("rig", 25) + block("rig b", 1)
    found = Study.from_text(RIG + both, "s", tmp_path).grid.blocks
    assert [each.load for each in found] == ["rig 1", "rig 2", "rig b 1", "rig b 2"]
    same = f'[loads."rig 2"]\n{START.partition(chr(10))[2]}[loads.rig]\n{RECORD}' + block("rig", 25)
    words = "loads.rig 2: found the name of a cycle of loads.rig; allowed: another"
    refused(words, Study.from_text, RIG + same, "s", tmp_path)


def test_a_mean_bulk_stress_of_each_kept_cycle_is_told(tmp_path: Path) -> None:
    (tmp_path / "rig.csv").write_text("normal,tangential,bulk\n" + "200,0,0\n200,60,40\n200,-60,-40\n" * 2)
    study = f"{RIG}bulk_stress_amplitude = 1\nbulk_stress_ratio = 0\n"
    study += f'[loads.rig]\n{RECORD}columns = {{ bulk = "bulk" }}\n'
    with pytest.warns(UserWarning, match="each cycle a mean bulk stress by its own range; bulk_stress_mean"):
        Study.from_text(study + block("rig", 25), "s", tmp_path)
