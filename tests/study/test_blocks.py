"""Blocks of loads: Miner's sum, held against the same by hand."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from real import ALLOY

import swtstudy
from swtstudy import FatigueConstants, LoadPath, Study, StudyError, open_results, run
from swtstudy.archive.describe import describe
from swtstudy.archive.work import assess
from swtstudy.study.units.life import Block
from swtstudy.study.units.results import sequence_words
from swtstudy.vocabulary.wording import number_words

RIG = f"""
title = "Blocks"
rtol = 1e-3
{ALLOY}[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
body = 1
"""
#: With means, each of which has a life.
WITH_MEANS = RIG + "critical_distance = 0.05\n"
START = "[loads.start-up]\nabsolute = true\nvertices = [[150, -50], [180, 60], [150, 20]]\n"
RUNNING = "[loads.running]\nabsolute = true\nvertices = [[200, -60], [210, 60]]\n"
ALUMINIUM = FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)


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
    worst = f"{float(found.damage_share.sel(load='running')):.0%}"
    times = number_words(found.repetitions.item(), 2)
    words = f"10 of start-up, 1000 of running, 5.5 of start-up, repeated {times} times to a crack; "
    words += f"running does {worst} of the damage"
    assert f"  sequence       {words}" in describe(found)
    # The archive knows its blocks, also where they come from files.
    archived = open_results(tmp_path / "blocks.nc")
    assert assess(Study.from_text(archived.attrs["study"]), tmp_path / "blocks.nc").todo.sum() == 0
    np.testing.assert_array_equal(archived.repetitions, found.repetitions)


def test_a_single_load_and_a_contact_in_python_have_blocks_too(tmp_path: Path) -> None:
    found = run(Study.from_text(RIG + RUNNING + block("running", 250)), tmp_path / "one.nc")
    np.testing.assert_allclose(found.repetitions, found.cycles / 250.0, rtol=1e-12)
    assert found.damage_share.item() == 1.0
    same = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.5, "body": 1}
    loads = [
        LoadPath.absolute("start-up", [[150, -50], [180, 60], [150, 20]]),
        LoadPath.absolute("running", [[200, -60], [210, 60]]),
    ]
    contact = swtstudy.physical(**same, load=loads)
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
        with pytest.raises(StudyError, match=words):
            contact.solve(constants=ALUMINIUM, blocks=blocks)
    with pytest.raises(StudyError, match="blocks: found blocks without constants"):
        contact.solve(blocks={"running": 1, "start-up": 1})


@pytest.mark.quick(1)
@pytest.mark.parametrize("count", [2, 5, 10])
def test_equal_cycles_in_a_round_have_so_many_times_the_damage(count: int) -> None:
    """As blocks of a single one have; exactly, since all of them are the same."""
    same = {
        "young_modulus": 73.1e3,
        "poisson_ratio": 0.33,
        "radius": 50.0,
        "normal_force": 200.0,
        "friction": 0.5,
    }
    newton = {"normal_force_amplitude": 1.0, "tangential_force_amplitude": 1.0, "body": 1}
    loads = [LoadPath("one", [[0, 60], [0, -60]]), LoadPath("many", [[0, 60], [0, -60]] * count)]
    found = swtstudy.physical(**same, load=loads, **newton).solve(constants=ALUMINIUM)
    one, many = found.cycles.values
    assert one / many == pytest.approx(count, rel=1e-9)


def test_recorded_cycles_are_blocks_one_by_one_if_they_are_kept(tmp_path: Path) -> None:
    cycles = np.array([[200, 0], [210, 60], [190, -60]])[None] * np.array([1.0, 0.9, 1.0, 0.8])[:, None, None]
    lines = [f"{normal!r},{tangential!r}" for normal, tangential in cycles.reshape(-1, 2).tolist()]
    (tmp_path / "rig.csv").write_text("\n".join(["normal,tangential", *lines]))
    table = '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 4\nkeep_cycles = true\n'
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
    assert assess(again, tmp_path / "rig.nc").todo.sum() == 0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (RUNNING + block("running", 0), r"blocks\[0\].rounds: found 0; allowed: a positive number of rounds"),
        (
            RUNNING + block("running", '"many"'),
            r"blocks\[0\].rounds: found 'many'; allowed: a positive number",
        ),
        (RUNNING + block("runing", 1), r"blocks.load: found 'runing' .*; allowed: did you mean running"),
        (RUNNING + '[[blocks]]\nload = "running"\n', r"blocks\[0\].rounds: found nothing; allowed: "),
        (RUNNING + block("running", 1) + "times = 2\n", r"blocks\[0\].times: found unknown key 'times'"),
        (
            "[axes]\nload = ['running']\n" + RUNNING + block("running", 1),
            r"axes.load: found \['running'\]; allowed: nothing: \[\[blocks\]\] give the loads",
        ),
    ],
)
def test_one_message_for_each_mistake_in_blocks(text: str, words: str) -> None:
    with pytest.raises(StudyError) as caught:
        Study.from_text(RIG + text, "s")
    (line,) = map(str, caught.value.mistakes)
    assert re.match(f"s: {words}", line), line


def test_blocks_need_lives() -> None:
    text = re.sub(r"\[material\][^\[]*", "", RIG) + RUNNING + block("running", 1)
    with pytest.raises(StudyError, match=r"blocks: found blocks without \[units\] and \[material\]"):
        Study.from_text(text)
    strength = re.sub(r"\[material\][^\[]*", "[material]\nyield_strength = 350\n", RIG)
    with pytest.raises(StudyError) as caught:
        Study.from_text(strength + RUNNING + block("running", 1), "s")
    assert [*map(str, caught.value.mistakes)] == [
        "s: blocks: found blocks with a [material] without lives; "
        "allowed: constants of lives: Miner's sum needs them"
    ]


def test_a_figure_shows_the_share_of_each_load(tmp_path: Path) -> None:
    text = RIG + "[axes]\nwalker_exponent = [0.4, 0.5]\n" + START + RUNNING
    text += block("start-up", 10) + block("running", 1e3)
    text += '[figure]\nx = "walker_exponent"\nhue = "load"\ny = "damage_share"\n'
    results = run(Study.from_text(text), tmp_path / "shares.nc")
    (axes,) = results.swt.figure().axes
    lines = {line.get_label(): line.get_ydata() for line in axes.get_lines()}
    np.testing.assert_allclose(lines["running"], results.damage_share.sel(load="running"))
    assert Study.from_text(text.replace('hue = "load"\n', "").replace("damage_share", "repetitions")).figure


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
    times = number_words(alone.FS_repetitions.item(), 2)
    assert f"repeated {times} times to a crack by Fatemi and Socie; running does" in "\n".join(
        describe(alone)
    )
    both = text.replace('criterion = "fatemi_socie"\n', '[axes]\ncriterion = ["swt", "fatemi_socie"]\n')
    found = run(Study.from_text(both), tmp_path / "both.nc")
    np.testing.assert_allclose(found.FS_repetitions.sel(criterion="fatemi_socie"), alone.FS_repetitions)
    times = number_words(found.repetitions.sel(criterion="swt").item(), 2)
    (line,) = [each for each in describe(found) if each.startswith("  sequence")]
    assert f"repeated {times} times to a crack; running does" in line
    assert " times to a crack by Fatemi and Socie; running does" in line
    assert "of the damage; repeated" in line


RECORD = 'file = "rig.csv"\nabsolute = true\nrecorded_cycles = 2\nkeep_cycles = true\n'


def test_cycles_that_are_kept_are_those_of_their_load_alone(tmp_path: Path) -> None:
    """Cycles of "rig b" had counted as those of "rig", too."""
    (tmp_path / "rig.csv").write_text("normal,tangential\n" + "200,0\n210,60\n190,-60\n" * 2)
    both = f'[loads.rig]\n{RECORD}[loads."rig b"]\n{RECORD}' + block("rig", 25) + block("rig b", 1)
    found = Study.from_text(RIG + both, "s", tmp_path).grid.blocks
    assert [each.load for each in found] == ["rig 1", "rig 2", "rig b 1", "rig b 2"]
    same = f'[loads."rig 2"]\n{START.partition(chr(10))[2]}[loads.rig]\n{RECORD}' + block("rig", 25)
    with pytest.raises(
        StudyError, match=r"loads.rig 2: found the name of a cycle of loads.rig; allowed: another"
    ):
        Study.from_text(RIG + same, "s", tmp_path)


def test_repetitions_that_are_not_known_are_counted(tmp_path: Path) -> None:
    strong = RUNNING.replace("-60]", "-90]").replace("60]", "90]")
    text = (
        RIG.replace("friction = 0.5\n", "")
        + "[axes]\nfriction = [0.4, 0.6]\n"
        + strong
        + block("running", 1e3)
    )
    found = run(Study.from_text(text), tmp_path / "rig.nc", workers=1)
    assert np.isnan(found.repetitions[0])
    assert "times to a crack, unknown at 1 of 2 points" in sequence_words(
        found, Study.from_text(text).grid.blocks
    )


def test_a_sequence_without_damage_makes_no_crack() -> None:
    found = xr.Dataset({"repetitions": ((), np.inf), "damage_share": ("load", [np.nan])})
    assert sequence_words(found, (Block("running", 2.0),)) == "2 of running: no crack"
