"""Loops that a user defines: from their vertices to results."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from command import call
from solved import REGIMES
from told import refused, sayings

import swtstudy
from swtstudy import LoadPath, Study, StudyError, open_results, run

PLAIN = ("normal_amplitude", "tangential_amplitude")
FORCED = ("normal_force_amplitude", "tangential_force_amplitude")
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
    with pytest.warns(UserWarning, match="phase has no effect"):
        same = swtstudy.solve(load=[LoadPath("a", CONE), LoadPath("b", rolled)], phase=[0, 1], rtol=0.01)
    assert (same.s == same.s[0, 0]).all()


@pytest.mark.parametrize("force", ["", "force_"])
def test_the_amplitudes_scale_the_columns_of_what_is_prescribed(force: str) -> None:
    normal, tangential = (f"{name}_{force}amplitude" for name in ("normal", "tangential"))
    scaled = np.array(CONE) * [0.5, 0.25]
    given = {normal: 0.5, tangential: 0.25}
    assert s_of(CONE, **given) == s_of(scaled, **dict.fromkeys(given, 1.0))
    if not force:
        assert s_of(scaled) == s_of(scaled, normal_amplitude=1.0, tangential_amplitude=1.0)


@pytest.mark.parametrize(
    ("ratio", "normal", "tangential", "phase", "quick"),
    [
        ((2, 1), 0.757, 0.989, 5.492, True),
        ((1, 2), 0.445, 0.486, 4.161, False),
        pytest.param((1, 1), 0.591, 0.513, 3.470, True, marks=pytest.mark.slow),
        pytest.param((1, 2), 0.582, 0.823, 3.579, False, marks=pytest.mark.slow),
    ],
)
def test_what_points_on_a_smooth_cycle_miss_of_it(ratio, normal, tangential, phase, quick) -> None:
    """A few cycles next to nothing, others nearly 3/k; a function of the time misses nothing."""
    p, q = ratio
    load = {"normal_amplitude": normal, "tangential_amplitude": tangential, "rtol": 1e-5}

    def course(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.sin(q * t + phase), np.sin(p * t)

    whole = swtstudy.solve(phase=phase, frequency_ratio=f"{p}/{q}", **load).s.item()
    smooth = swtstudy.solve(load=LoadPath.sampled("smooth", course), **load).s.item()
    assert smooth == pytest.approx(whole, rel=1e-5)
    missed = {}
    for k in (64, 128):
        at = 2.0 * np.pi * (np.arange(k) + 0.3) / k
        missed[k] = abs(s_of(np.stack(course(at), axis=1), **load) / whole - 1.0)
        assert missed[k] < (20.0 / k**2 if quick else 2.5 / k)
    assert (missed[128] > 50.0 / 128**2) != quick


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
    mixed = {"normal_force_amplitude": 1.0, "tangential_amplitude": 0.5, "friction": -1}
    error = refused("", swtstudy.solve, load=LoadPath("mine", SQUARE), **mixed)
    friction, load = error.mistakes
    assert friction.key == "friction"
    assert load.key == "load"
    assert "or scale = { normal = 0 } under [loads.NAME]" in load.allowed
    contact = {"young_modulus": 7e4, "poisson_ratio": 0.3, "radius": -5.0, "normal_force": 100.0}
    error = refused("", swtstudy.physical, load=LoadPath("mine", SQUARE), **contact, **mixed)
    assert [mistake.key for mistake in error.mistakes] == ["radius", "friction", "load"]


def test_a_measured_load_without_units_is_told_of_alone() -> None:
    """What stands for it in the checks of its use is no load that the user knows."""
    study = 'title = "t"\nfixed.load = "rig"\n[loads.rig]\nabsolute = true\nvertices = [[0, 1], [0, -1]]\n'
    error = refused("", Study.from_text, study)
    assert [mistake.key for mistake in error.mistakes] == ["loads.rig.vertices"]


@pytest.mark.quick(1)
@pytest.mark.parametrize("forces", [True, False])
def test_harmonic_sums_are_what_two_oscillations_are(forces: bool) -> None:
    """The paper's own load, as a loop of one harmonic each."""
    names = FORCED if forces else PLAIN
    for p, q in ((1, 1), (1, 2), (3, 2)):
        own = dict(zip(names, (0.45, 0.3), strict=True))
        loop = LoadPath.harmonic_sum("mine", [(q, 1.0, 0.7)], [(p, 1.0, 0.0)])
        found = swtstudy.solve(load=loop, **own, rtol=1e-6)
        expected = swtstudy.solve(frequency_ratio=f"{p}/{q}", phase=0.7, **own, rtol=1e-6)
        assert found.s.item() == pytest.approx(expected.s.item(), rel=1e-6)
        assert abs(found.critical_x.item()) == pytest.approx(abs(expected.critical_x.item()), rel=1e-4)


@pytest.mark.slow
def test_major_and_minor_cycles_are_their_polygon_of_many_sides() -> None:
    normal, tangential = [(1, 1.0, 0.4), (3, 0.3, 1.0)], [(1, 0.8, 0.0), (2, 0.2, 0.5), (0, 0.1, 1.5)]
    own = {"normal_amplitude": 0.5, "tangential_amplitude": 0.5, "rtol": 1e-5}
    smooth = swtstudy.solve(load=LoadPath.harmonic_sum("mine", normal, tangential), **own).s.item()

    def course(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        found = [sum(a * np.sin(k * t + b) for k, a, b in rows) for rows in (normal, tangential)]
        return found[0], found[1]

    by_samples = swtstudy.solve(load=LoadPath.sampled("mine", course), **own).s.item()
    assert by_samples == pytest.approx(smooth, rel=1e-6)
    errors = []
    for count in (100, 400):
        t = 2.0 * np.pi * np.arange(count) / count
        errors.append(abs(s_of(np.stack(course(t), axis=1), **own) / smooth - 1.0))
    assert errors[1] < 3e-4
    assert errors[1] < 0.5 * errors[0]


# Normal loads that almost stop while they rise: instants, and what sticks there, change at once.
ALMOST_STOPPING = [
    [(5, 0.0288138, 1.36408761), (1, 0.64085263, 5.56455201), (2, 0.20727671, 2.30102214)],
    [(1, 0.73251138, 3.85995961), (5, 0.12092728, 1.47432116), (2, 0.12053666, 3.66847055)],
]


@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_a_normal_load_that_almost_stops_while_all_sticks(rtol: float) -> None:
    tangential = [(2, 0.20445448, 3.67845041), (1, 0.93671587, 2.84211607)]
    own = {"poisson_ratio": 0.3, "friction": 0.5, "normal_amplitude": 1.15467, "tangential_amplitude": 0.2352}
    own |= {"load": LoadPath.harmonic_sum("mine", ALMOST_STOPPING[1], tangential)}
    found, closest = swtstudy.solve(**own, rtol=rtol), swtstudy.solve(**own, rtol=1e-7)
    assert abs(found.s.item() - closest.s.item()) <= found.s_error.item()
    assert found.s_error.item() <= rtol * found.s.item()
    # Its polygon of 800 sides.
    assert found.s.item() == pytest.approx(0.161137934, rel=3e-5)


def merged_with_itself(path: Path) -> xr.Dataset:
    """An archive that `swtstudy merge` writes anew."""
    target = path.with_name("merged.nc")
    assert call("merge", path, "-o", target).exit_code == 0
    return open_results(target)


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
    merged = merged_with_itself(path)
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
    refused("load: found 'sphere'", dataset.swt.slice, load="sphere")
    refused("load: found 'sphere'", dataset.swt.normalised, "load=sphere")
    ratio = dataset.swt.normalised("load=square")
    np.testing.assert_array_equal(ratio, s / s[1])
    figure = '[figure]\nx = "phase"\nhue = "load"\ny = "s/s(load={})"\n'
    Study.from_text(text.format(SQUARE, CONE) + figure.format("square"))
    with pytest.raises(StudyError, match="sphere is not on that axis; allowed: a value of the axis load"):
        Study.from_text(text.format(SQUARE, CONE) + figure.format("sphere"))


MISTAKES = sayings(r"""
"" » loads.mine: found nothing; allowed: a table with vertices, with normal and tangential
'vertices = [[0, 1], [0, 2]]\nfile = "a.csv"' » loads.mine: found vertices and file;
"vertices = [[0, 1]]" » loads.mine.vertices: found a single point .*; allowed: 2 distinct points
"vertices = [[0, 1], [0, 1]]" » loads.mine.vertices: found a single point
"vertices = [[0, 1], [0, nan]]" » loads.mine.vertices: found \[0.0, nan\] .*number 2
"vertices = [[0, 1], [0]]" » loads.mine.vertices: found .*; allowed: a list of pairs of numbers
"vertices = [[0, 1, 2, 3]]" » loads.mine.vertices: found an array of shape \(1, 4\)
'vertices = "square"' » loads.mine.vertices: found 'square'.*; allowed: a list of pairs of numbers
"file = 3" » loads.mine.file: found 3; allowed: the path of a CSV file
'file = "no.csv"' » loads.mine.file: found no such file in the folder .* \(.*no.csv\)
'file = "few.csv"' » loads.mine.file: found the columns time, normal .*; allowed: a header with
'file = "hole.csv"' » loads.mine.file: found nothing .*line 3, tangential\)
'file = "nan.csv"' » loads.mine.file: found 'nan' .*line 3, tangential\)
'file = "long.csv"' » loads.mine.file: found 3000 vertices .*; allowed: at most 2000; .*recorded_cycles
"normal = [[1, 1, 0]]" » loads.mine: found normal; allowed: a table with vertices, with normal and tang
"normal = [[1, 1, 0]]\ntangential = [[0.5, 1, 0]]" » loads.mine: found \[0.5, 1, 0\] .tangential of
"normal = []\ntangential = [[0, 1, 0]]" » loads.mine: found nothing that changes
'files = "a.csv"' » loads.mine.files: found unknown key 'files'
""")


@pytest.mark.parametrize(("table", "words"), MISTAKES)
def test_one_message_for_each_mistake_in_a_loop(tmp_path: Path, table: str, words: list[str]) -> None:
    (tmp_path / "few.csv").write_text("time,normal\n0,1\n")
    (tmp_path / "hole.csv").write_text("normal,tangential\n0,1\n0\n")
    (tmp_path / "nan.csv").write_text("normal,tangential\n0,1\n0,nan\n")
    if "long" in table:
        rows = "".join(f"{k},{k * k}\n" for k in range(3_000))
        (tmp_path / "long.csv").write_text("normal,tangential\n" + rows)
    error = refused("", Study.from_text, STUDY + eval(table), "study", tmp_path)
    found = [str(mistake) for mistake in error.mistakes]
    assert re.match(f"study: {words[0]}", found[0]), found
    assert len(found) == 1, found


def test_too_many_vertices_are_refused_but_not_those_that_do_not_matter() -> None:
    t = 2.0 * np.pi * np.arange(2001) / 2001
    with pytest.raises(StudyError, match=r"2001 vertices .*; allowed: at most 2000"):
        LoadPath("round", np.stack([np.sin(t), np.cos(t)], axis=1))
    line = np.linspace(-1.0, 1.0, 5001)
    to_and_fro = np.concatenate([line, line[::-1]])
    assert len(LoadPath("line", np.stack([0.0 * to_and_fro, to_and_fro], axis=1)).vertices) == 2


@pytest.mark.slow
def test_an_audit_knows_loops_by_their_content(tmp_path: Path) -> None:
    study = Study.from_text(STUDY.replace("[0.3, 0.5]", "[0.4]") + f"vertices = {SQUARE}")
    found = swtstudy.audit_study(study, tmp_path / "audit.nc", points=1, workers=1)
    s = swtstudy.solve(load=LoadPath("mine", SQUARE), friction=0.4).s.item()
    assert found.s.item() == pytest.approx(s, rel=1e-3)
    assert found["load"].values.tolist() == ["mine"]
    again = swtstudy.audit_study(study, tmp_path / "audit.nc", points=1, workers=1)
    xr.testing.assert_identical(again.drop_attrs(), found.drop_attrs())


@pytest.mark.parametrize("profile", [{}, {"profile": "rounded_punch", "flat_radius": 0.5}])
@pytest.mark.parametrize("more", [{}, {"bulk_stress_mean": 0.05}])
def test_bodies_that_never_touch_are_said_and_leave_their_neighbours_alone(
    profile: dict[str, object], more: dict[str, float]
) -> None:
    """The first of two points gave its s to the second one."""
    fixed = {"load": LoadPath("apart", [[-1.0, 0.0], [-0.2, 1.0], [-1.0, -1.0]]), **profile, **more}
    found = swtstudy.solve(normal_amplitude=[4.0, 5.0, 10.0], rtol=1e-3, quantities=["von_mises"], **fixed)
    alone = swtstudy.solve(normal_amplitude=4.0, rtol=1e-3, **fixed)
    assert found.s[0] == pytest.approx(alone.s.item(), rel=1e-6)
    assert np.isnan(found.s[1:]).all()
    assert np.isnan(found.von_mises[1:]).all()
    assert (found.regime[1:] == REGIMES.index("no_equilibrium")).all()
    with pytest.raises(StudyError, match=r"normal_amplitude: found 10\.0, at which the bodies never touch"):
        swtstudy.inspect_point(normal_amplitude=10.0, **fixed)


def harmonics(phase: object) -> str:
    return (
        STUDY.partition("[loads")[0]
        + f"[loads.mine]\nnormal = [[1, 0.5, 0]]\ntangential = [[2, 1, {phase}]]\n"
    )


def test_phases_of_harmonics_are_written_as_other_angles() -> None:
    (expected,) = Study.from_text(harmonics(np.pi / 2)).grid.loops
    for words in ('"pi/2"', '"90 deg"'):
        assert Study.from_text(harmonics(words)).grid.loops[0].code == expected.code
    words = r'tangential of mine: a phase of 90 is in radians; for degrees np.radians\(90\), .* "90 deg"'
    with pytest.warns(UserWarning, match=words) as told:
        Study.from_text(harmonics(90))
    assert len(told) == 1
    with pytest.warns(UserWarning, match=words):
        LoadPath.harmonic_sum("mine", [(1, 0.5, 0.0)], [(2, 1.0, 90)])
    refused(r"found .x. .*; allowed: a phase", Study.from_text, harmonics('"x"'))


def with_offset(kind: str, moved: float) -> LoadPath:
    """Loops with a constant tangential load, but for a small motion."""
    if kind == "harmonics":
        moving = [(1, moved, 0.0)] if moved else []
        return LoadPath.harmonic_sum("offset", [(1, 0.5, 0.0)], [(0, 0.5, 0.5 * np.pi), *moving])
    if kind == "bulk":
        return LoadPath("offset", [[0.0, 0.5, 1.0], [0.0, 0.5 + moved, -1.0]])
    return LoadPath("offset", [[-0.5, 0.5], [0.5, 0.5 + moved]])


@pytest.mark.parametrize("kind", ["polygon", "harmonics", "bulk"])
@pytest.mark.parametrize("names", [PLAIN, FORCED])
def test_a_constant_tangential_load_keeps_its_traction(kind: str, names: tuple[str, str]) -> None:
    """It had been taken for none, and s was up to four times too low."""
    given = dict(zip(names, (1.0, 0.8), strict=True))
    given |= {"bulk_stress_amplitude": 0.1} if kind == "bulk" else {}
    constant, moving = (
        swtstudy.solve(load=with_offset(kind, moved), rtol=1e-5, **given) for moved in (0.0, 1e-10)
    )
    assert constant.s.item() == pytest.approx(moving.s.item(), rel=5e-5)
    if kind == "bulk":
        other = LoadPath("other", [[0.0, -0.5, 1.0], [0.0, -0.5, -1.0]])
        assert swtstudy.solve(load=other, rtol=1e-5, **given).s.item() == pytest.approx(constant.s.item())
    if kind == "polygon":
        seen = swtstudy.inspect_point(load=with_offset(kind, 0.0), **given)
        assert constant.s.item() == pytest.approx(seen.s_local.max().item(), rel=2e-3)


def test_harmonics_know_no_mixed_control() -> None:
    still = LoadPath.harmonic_sum("still", [], [(1, 1.0, 0.0)])
    words = r"load: found harmonics, 'still', and normal_force\+tangential_disp"
    refused(words, swtstudy.solve, load=still, normal_force_amplitude=1.0, tangential_amplitude=0.5)
    moving = LoadPath.harmonic_sum("moving", [(1, 0.3, 0.0)], [(1, 1.0, 0.0)])
    given = {"load": moving, "normal_force_amplitude": 0.0, "tangential_amplitude": 0.5}
    seen = swtstudy.inspect_point(**given)
    assert seen.s_local.max().item() == pytest.approx(swtstudy.solve(**given).s.item(), rel=2e-3)
