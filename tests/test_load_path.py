"""Loops that a user defines: from their vertices to results."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

import swtstudy
from swtstudy import LoadPath, Study, StudyError, open_results, run
from swtstudy.archive.merge import merge
from swtstudy.grid.reading import read_grid
from swtstudy.grid.unique import unique_points
from swtstudy.parameters import CONTROLS, Control

SQUARE = [[0.0, 0.5], [0.5, 0.5], [0.5, -0.5], [0.0, -0.5]]
CONE = [[-0.3, -0.4], [0.1, 0.6], [0.5, 0.2], [0.2, -0.3]]


def s_of(vertices: object, **parameters: object) -> float:
    return swtstudy.solve(load=LoadPath("mine", vertices), **parameters).s.item()


def code(vertices: object) -> float:
    return LoadPath("mine", vertices).code


def test_a_loop_is_its_path_whatever_its_first_vertex_and_name() -> None:
    rolled = np.roll(CONE, 2, axis=0)
    between = np.insert(np.array(CONE), 1, [-0.1, 0.1], axis=0)
    assert code(CONE) == code(rolled) == code(between) == LoadPath("other", CONE).code
    others = [np.array(CONE)[::-1], np.array(CONE) * [1.0, -1.0], np.array(CONE) * (1.0 + 1e-15)]
    assert len({code(CONE), *map(code, others)}) == 4
    grid, _ = read_grid({}, {"load": [LoadPath("a", CONE), LoadPath("b", rolled)], "phase": [0, 1]})
    assert grid is not None
    assert len(unique_points(grid).table) == 1


@pytest.mark.parametrize("control", CONTROLS)
def test_the_amplitudes_scale_the_columns_of_what_is_prescribed(control: Control) -> None:
    if control.mixed:
        pytest.skip("needs a constant normal load")
    normal, tangential = (control.given_for(f"{name}_amplitude") for name in ("normal", "tangential"))
    scaled = np.array(CONE) * [0.5, 0.25]
    given = {normal: 0.5, tangential: 0.25}
    assert s_of(CONE, **given) == s_of(scaled, **dict.fromkeys(given, 1.0))
    if control == Control():
        assert s_of(scaled) == s_of(scaled, normal_amplitude=1.0, tangential_amplitude=1.0)


def test_a_mirrored_loop_has_its_critical_point_on_the_other_side_and_a_backward_one_another_s() -> None:
    loops = [LoadPath("there", CONE), LoadPath("mirrored", np.array(CONE) * [1.0, -1.0])]
    loops.append(LoadPath("back", CONE[::-1]))
    found = swtstudy.solve(load=loops, rtol=1e-6)
    there, mirrored, back = found.s.values
    assert mirrored == pytest.approx(there, rel=1e-6)
    assert found.critical_x[1].item() == pytest.approx(-found.critical_x[0].item(), rel=1e-5)
    assert abs(back / there - 1.0) > 1e-2


def test_the_cycle_of_the_paper_as_a_polygon_converges_to_it() -> None:
    """Within the envelope 12 k⁻² (relative) of the sampling."""
    smooth = swtstudy.solve(normal_amplitude=0.75, phase=2.3, rtol=1e-6).s.item()
    for count in (16, 64, 256):
        t = 2.0 * np.pi * np.arange(count) / count
        loop = np.stack([np.sin(t + 2.3), np.sin(t)], axis=1)
        found = s_of(loop, normal_amplitude=0.75, tangential_amplitude=5 / 6, rtol=1e-6)
        assert abs(found / smooth - 1.0) < 12.0 / count**2


@pytest.mark.parametrize("force", [True, False])
def test_a_constant_normal_load_takes_mixed_control(force: bool) -> None:
    """To and fro in straight lines is what the harmonic load does there."""
    tangential = "tangential_force_amplitude" if force else "tangential_amplitude"
    normal = "normal_amplitude" if force else "normal_force_amplitude"
    loop = s_of([[0.0, 1.0], [0.0, -1.0]], **{normal: 1.0, tangential: 0.4}, rtol=1e-6)
    harmonic = swtstudy.solve(normal_amplitude=0.0, **{tangential: 0.4}, rtol=1e-6).s.item()
    assert loop == pytest.approx(harmonic, rel=1e-6)


def test_a_loop_of_force_and_displacement_needs_a_constant_normal_load() -> None:
    with pytest.raises(StudyError, match="a normal load that is not constant") as caught:
        swtstudy.solve(load=LoadPath("mine", SQUARE), normal_force_amplitude=1.0, tangential_amplitude=0.5)
    assert len(caught.value.mistakes) == 1


def test_the_shapes_that_rigs_run() -> None:
    assert LoadPath.trapezoid("a", normal=(0.0, 0.5), tangential=(-0.5, 0.5)).code == code(SQUARE[::-1])
    assert LoadPath.triangle("b", normal=0.2, tangential=0.5).code == code([[0.2, 0.5], [-0.2, -0.5]])


STUDY = """title = "Loops"
rtol = 1e-3
[fixed]
load = "mine"
[axes]
friction = [0.3, 0.5]
[loads.mine]
"""


def test_a_study_has_loops_in_its_text_or_in_files(tmp_path: Path) -> None:
    (tmp_path / "cycle.csv").write_text(
        "time, tangential, normal\n" + "\n".join(f"{i}, {t}, {n}" for i, (n, t) in enumerate(SQUARE)) + "\n"
    )
    (tmp_path / "study.toml").write_text(STUDY + 'file = "cycle.csv"')
    by_file = Study.from_toml(tmp_path / "study.toml")
    by_text = Study.from_text(STUDY + f"vertices = {SQUARE}")
    assert by_file.grid == by_text.grid
    path = tmp_path / "loops.nc"
    dataset = run(by_file, path, workers=2)
    expected = swtstudy.solve(load=LoadPath("mine", SQUARE), friction=[0.3, 0.5], rtol=1e-3)
    np.testing.assert_allclose(dataset.s, expected.s, rtol=1e-12)
    (tmp_path / "cycle.csv").unlink()
    found = open_results(path)
    (defined,) = json.loads(found.attrs["definitions"])
    assert defined["content"] == {"vertices": LoadPath("mine", SQUARE).vertices.tolist()}
    assert found["load"].item() == "mine"

    def fail(*_: object) -> None:
        raise AssertionError("computed again")

    # Another name for the same path.
    again = run(Study.from_text(STUDY.replace("mine", "yours") + f"vertices = {SQUARE}"), path, solver=fail)
    np.testing.assert_array_equal(again.s, dataset.s)
    # The same name for another path.
    other = run(Study.from_text(STUDY + f"vertices = {CONE}"), path)
    assert (np.abs(other.s / dataset.s - 1.0) > 1e-2).all()
    merged = merge([path])
    assert Study.from_text(merged.attrs["study"]).grid == Study.from_text(STUDY + f"vertices = {CONE}").grid


def test_loops_on_an_axis_beside_the_harmonic_load(tmp_path: Path) -> None:
    text = """title = "t"
rtol = 1e-3
[fixed]
normal_amplitude = 0.5
tangential_amplitude = 0.5
[axes]
load = ["harmonic", "square", "cone"]
phase = [0, 1]
[loads.square]
vertices = {}
[loads.cone]
vertices = {}
"""
    dataset = run(Study.from_text(text.format(SQUARE, CONE)), tmp_path / "t.nc", workers=1)
    assert dataset["load"].values.tolist() == ["harmonic", "square", "cone"]
    s = dataset.s.values
    assert (s[1:, 0] == s[1:, 1]).all()
    assert s[0, 0] != s[0, 1]
    assert dataset.swt.slice(load="cone").s.values.tolist() == s[2].tolist()
    with pytest.raises(StudyError, match="load: found 'sphere'"):
        dataset.swt.slice(load="sphere")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("", "loads.mine: found neither; allowed: vertices or file"),
        ('vertices = [[0, 1], [0, 2]]\nfile = "a.csv"', "loads.mine: found both; allowed: vertices or file"),
        ("vertices = [[0, 1]]", r"loads.mine.vertices: found a single point .*; allowed: 2 distinct points"),
        ("vertices = [[0, 1], [0, 1]]", r"loads.mine.vertices: found a single point"),
        ("vertices = [[0, 1], [0, nan]]", r"loads.mine.vertices: found \[0.0, nan\] .*number 2"),
        ("vertices = [[0, 1], [0]]", r"loads.mine.vertices: found .*; allowed: a list of pairs of numbers"),
        ("vertices = [[0, 1, 2, 3]]", r"loads.mine.vertices: found an array of shape \(1, 4\)"),
        (
            'vertices = "square"',
            r"loads.mine.vertices: found 'square'.*; allowed: a list of pairs of numbers",
        ),
        ("file = 3", "loads.mine.file: found 3; allowed: the path of a CSV file"),
        ('file = "no.csv"', r"loads.mine.file: found No such file or directory \(.*no.csv\)"),
        ('file = "few.csv"', r"loads.mine.file: found the columns time, normal .*; allowed: a header with"),
        ('file = "hole.csv"', r"loads.mine.file: found nothing .*line 3, tangential\)"),
        ('file = "nan.csv"', r"loads.mine.file: found 'nan' .*line 3, tangential\)"),
        ('file = "long.csv"', r"loads.mine.file: found more than 100000 rows"),
        ('files = "a.csv"', "loads.mine.files: found unknown key 'files'"),
    ],
)
def test_one_message_for_each_mistake_in_a_loop(tmp_path: Path, table: str, words: str) -> None:
    (tmp_path / "few.csv").write_text("time,normal\n0,1\n")
    (tmp_path / "hole.csv").write_text("normal,tangential\n0,1\n0\n")
    (tmp_path / "nan.csv").write_text("normal,tangential\n0,1\n0,nan\n")
    if "long" in table:
        (tmp_path / "long.csv").write_text("normal,tangential\n" + "0,1\n1,2\n" * 60_000)
    with pytest.raises(StudyError) as caught:
        Study.from_text(STUDY + table, "study", tmp_path)
    found = [str(mistake) for mistake in caught.value.mistakes]
    assert any(re.match(f"study: {words}", line) for line in found), found
    assert len(found) == (2 if "files" in table else 1), found


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"load": "square"}, "load: found 'square' .no such load.; allowed: known: harmonic"),
        ({"load": 3.0}, "load: found 3.0 .not a name."),
        (
            {"load": [LoadPath("a", SQUARE), LoadPath("a", CONE)]},
            r"load\[1\]: found .*, the same as load\[0\]",
        ),
        (
            {"load": ["harmonic", LoadPath("a", SQUARE)], "tangential_amplitude": 1.0},
            "normal_amplitude: found",
        ),
    ],
)
def test_one_message_for_each_mistake_with_a_load(given: dict[str, object], words: str) -> None:
    with pytest.raises(StudyError) as caught:
        swtstudy.solve(**given)
    assert len(caught.value.mistakes) == 1
    assert re.match(words, str(caught.value)), str(caught.value)


@pytest.mark.parametrize("name", ["", "harmonic", None])
def test_a_loop_needs_a_name_of_its_own(name: object) -> None:
    with pytest.raises(StudyError, match="name: found"):
        LoadPath(name, SQUARE)  # type: ignore[arg-type]


def test_too_many_vertices_are_refused_but_not_those_that_do_not_matter() -> None:
    t = 2.0 * np.pi * np.arange(2001) / 2001
    with pytest.raises(StudyError, match=r"2001 vertices .*; allowed: at most 2000"):
        LoadPath("round", np.stack([np.sin(t), np.cos(t)], axis=1))
    line = np.linspace(-1.0, 1.0, 5001)
    to_and_fro = np.concatenate([line, line[::-1]])
    assert len(LoadPath("line", np.stack([0.0 * to_and_fro, to_and_fro], axis=1)).vertices) == 2


@pytest.mark.parametrize("definitions", ["[3]", '[{"parameter": "load", "name": "mine"}]', "{"])
def test_a_mangled_definition_is_refused(tmp_path: Path, definitions: str) -> None:
    from swtstudy.archive.error import ArchiveError
    from swtstudy.archive.write import save

    path = tmp_path / "loops.nc"
    run(Study.from_text(STUDY + f"vertices = {SQUARE}"), path, workers=1)
    save(open_results(path).assign_attrs(definitions=definitions), path)
    with pytest.raises(ArchiveError, match="attribute definitions: found"):
        open_results(path)
