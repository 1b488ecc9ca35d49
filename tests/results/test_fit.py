"""The critical distance from properties, and fitted to tests."""

import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from click.testing import CliRunner
from kept import told
from real import ALLOY, ALUMINIUM, SPHERE
from told import refused, sayings, warned

import swtstudy
from swtstudy import LoadPath, Study, StudyError, physical
from swtstudy.cli import main
from swtstudy.figures.statistics import draw_fit, fit_lines
from swtstudy.results import fitting

#: Each round has two cycles.
LOOP = [[0, 1], [0, -1], [0, 0.9], [0, -0.9]]
STUDY = f"""
title = "Tests of a rig"
{ALLOY}[fixed]
{SPHERE}normal_force = 200
load = "two"
[loads.two]
vertices = {LOOP}
"""
#: Three tests, and the distance with which their lives are made.
FORCES, LOADS, MADE_WITH = (30.0, 55.0, 80.0), (150.0, 200.0, 300.0), 0.06


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """A study, and the lives of its tests, by contacts that are solved one by one."""
    file = tmp_path_factory.mktemp("rig") / "rig.toml"
    file.write_text(STUDY, encoding="utf-8")
    lives = []
    for force, load in zip(FORCES, LOADS, strict=True):
        contact = physical(
            young_modulus=73.1e3, poisson_ratio=0.33, radius=50.0, friction=0.5, normal_force=load,
            tangential_force_amplitude=force, load=LoadPath("two", LOOP),
        )  # fmt: skip
        solved = contact.solve(1e-3, critical_distance=MADE_WITH, constants=ALUMINIUM)
        lives.append(float(solved.cycles_volume[0]))
    return file, lives


def table(lives):
    return {"tangential_force_amplitude": FORCES, "normal_force": LOADS, "life": lives}


@pytest.mark.slow
def test_a_fit_finds_the_distance_with_which_lives_are_made(rig):
    file, lives = rig
    found = swtstudy.fit(file, table(lives))
    assert float(found.critical_distance) == pytest.approx(MADE_WITH, rel=5e-3)
    assert found.critical_distance.attrs["units"] == "mm"
    np.testing.assert_allclose(found.predicted, lives, rtol=0.02)
    assert int(found.within_2) == 3
    assert float(found.scatter) < 0.01


def test_single_values_along_axes_are_of_all_tests(tmp_path, monkeypatch):
    """Several are refused, and so are samples and blocks that the tests do not have."""
    seen = []

    def lives(grid, y, distances, friction):
        seen.append((grid.values("walker_exponent"), grid.values("body")))
        return np.log10(1e6 * np.outer(np.ones(3), distances))

    monkeypatch.setattr(fitting, "_lives", lives)
    file = tmp_path / "rig.toml"
    file.write_text(f"{STUDY}[axes]\nwalker_exponent = [0.4]\nbody = [2]\nnormal_force = [1, 2]\n")
    swtstudy.fit(file, table([1e4, 2e4, 3e4]))
    assert {*seen} == {((0.4,), (2.0,))}
    blocks = STUDY.replace('load = "two"\n', "") + '[[blocks]]\nload = "two"\nrounds = 1\n'
    for text, words in (
        (f"{STUDY}[axes]\nradius = [40, 50]\n", "axes.radius: found several values of radius; allowed: one"),
        (f'{STUDY}[sample]\ndesign = "random"\nsize = 2\nranges.phase = [0, 1]\n', "sample.phase: found"),
        (blocks, "blocks: found a sequence of blocks"),
    ):
        file.write_text(text)
        refused(words, swtstudy.fit, file, table([1e4, 2e4, 3e4]))


class Law:
    """Lives that are a power of distance and friction times the force: the fit has a closed form."""

    def __init__(self, forces, friction=1.0):
        self.forces, self.power = np.array(forces), friction

    def __call__(self, grid, y, distances, friction):
        friction = 0.5 if friction is None else friction
        pull = np.log10(self.forces)[:, None]
        return 6.0 + 2.0 * np.log10(distances) - self.power * pull * np.log10(friction) - pull


@pytest.mark.slow
def test_lives_of_a_fit_are_by_counted_cycles(rig):
    file, lives = rig
    grid, *_ = fitting._read(file, {name: values[:1] for name, values in table(lives).items()}, 0)
    found = fitting._lives(grid, "cycles_volume", np.array([MADE_WITH]), None)
    assert found.item() == pytest.approx(np.log10(lives[0]), rel=1e-6)
    # A trial friction takes the place of the study's; of a mean along a line the one straight down counts.
    given = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.6}
    load = {"normal_force": LOADS[0], "tangential_force_amplitude": FORCES[0], "load": LoadPath("two", LOOP)}
    solved = physical(**given, **load).solve(1e-3, critical_distance=MADE_WITH, constants=ALUMINIUM)
    found = fitting._lives(grid, "cycles_line", np.array([MADE_WITH]), 0.6)
    assert 10.0 ** found.item() == pytest.approx(
        float(solved.cycles_line.sel(direction="depth").min()), rel=1e-6
    )


def test_noise_has_the_interval_of_linear_regression(rig, monkeypatch):
    """log N is linear in log ℓ with the slope 2: an average, with its Student interval."""
    forces = np.linspace(30.0, 80.0, 12)
    law = Law(forces)
    monkeypatch.setattr(fitting, "_lives", law)
    noise = np.random.default_rng(3).normal(scale=0.2, size=12)
    observed = 10.0 ** (law(None, "", np.array([0.05]), None)[:, 0] + noise)
    tests = {"tangential_force_amplitude": forces, "life": observed}
    found = swtstudy.fit(rig[0], tests, confidence=0.9)
    assert np.log10(found.critical_distance / 0.05) == pytest.approx(noise.mean() / 2.0, abs=1e-4)
    half = 1.7959 * noise.std(ddof=1) / np.sqrt(12) / 2.0  # Student's t of 11 degrees of freedom
    assert np.log10(found.critical_distance_high / found.critical_distance) == pytest.approx(half, rel=1e-3)
    assert float(found.scatter) == pytest.approx(noise.std(ddof=1), rel=1e-6)


@pytest.mark.parametrize("distance", [0.01, 0.04, 0.15])
@pytest.mark.parametrize("scatter", [0.0, 1e-3, 1e-2])
def test_tests_that_scatter_little_have_a_narrow_interval(distance, scatter, rig, monkeypatch):
    """Lives bend over log ℓ, and differently from test to test: the misfit is a narrow valley."""
    forces = np.linspace(30.0, 80.0, 8)

    def bent(grid, y, distances, friction):
        x = np.log10(distances) + 2.0
        return 5.0 + x + forces[:, None] / 80.0 * (x**2 + np.sin(3.0 * x))

    monkeypatch.setattr(fitting, "_lives", bent)
    noise = np.random.default_rng(4).normal(scale=scatter, size=8)
    observed = 10.0 ** (bent(None, "", np.array([distance]), None)[:, 0] + noise)
    found = swtstudy.fit(rig[0], {"tangential_force_amplitude": forces, "life": observed})
    assert float(found.critical_distance) == pytest.approx(distance, rel=2.0 * scatter + 1e-4)
    assert 1.0 < found.critical_distance_high / found.critical_distance < 1.0 + 5.0 * max(scatter, 1e-3)


def test_distances_without_a_life_are_not_tried(rig, monkeypatch):
    """Deep beneath the surface there may be no tension; where there is none at all, that is said."""
    forces, end = np.linspace(30.0, 80.0, 8), [0.2]
    law = Law(forces)
    observed = 10.0 ** law(None, "", np.array([0.05]), None)[:, 0]
    tests = {"tangential_force_amplitude": forces, "life": observed}

    def ending(grid, y, distances, friction):
        lives = law(grid, y, distances, friction)
        lives[4, distances > end[0]] = np.inf
        return lives

    monkeypatch.setattr(fitting, "_lives", ending)
    assert float(swtstudy.fit(rig[0], tests).critical_distance) == pytest.approx(0.05, rel=1e-3)
    end[0] = 0.0
    refused("no finite life of test 5; allowed", swtstudy.fit, rig[0], tests)


def test_tests_may_have_frictions_and_loads_of_their_own(rig, monkeypatch):
    forces = np.linspace(30.0, 80.0, 8)
    law = Law(forces)
    monkeypatch.setattr(fitting, "_lives", law)
    observed = 10.0 ** law(None, "", np.array([0.05]), None)[:, 0]
    tests = {"tangential_force_amplitude": forces, "friction": np.linspace(0.5, 0.7, 8), "life": observed}
    tests["load"] = ["two"] * 8
    found = swtstudy.fit(rig[0], tests)
    assert float(found.critical_distance) == pytest.approx(0.05, rel=1e-3)
    np.testing.assert_array_equal(found.friction, tests["friction"])
    refused("friction: found a column of the tests", swtstudy.fit, rig[0], tests, friction=True)


def test_friction_is_fitted_beside_it(rig, monkeypatch):
    forces = np.linspace(30.0, 80.0, 8)
    law = Law(forces)
    tried = []

    def lives(grid, y, distances, friction):
        tried.append(friction)
        return law(grid, y, distances, friction)

    monkeypatch.setattr(fitting, "_lives", lives)
    observed = 10.0 ** law(None, "", np.array([0.05]), 0.7)[:, 0]
    tests = {"tangential_force_amplitude": forces, "life": observed}
    found = swtstudy.fit(rig[0], tests, friction=True)
    assert float(found.friction) == pytest.approx(0.7, rel=1e-2)
    assert float(found.critical_distance) == pytest.approx(0.05, rel=2e-2)
    # All frictions that are tried bear the tangential forces: 80 N at 200 N.
    assert min(filter(None, tried)) > 0.4


def test_a_trial_friction_without_a_life_is_no_candidate(rig, monkeypatch):
    """A large friction leaves a test without tension, or with tension at small distances only."""
    forces = np.linspace(30.0, 80.0, 8)
    law = Law(forces)

    def lives(grid, y, distances, friction):
        found = law(grid, y, distances, friction)
        found[3, distances > 0.02 / (friction or 0.5) ** 6] = np.inf
        return found

    monkeypatch.setattr(fitting, "_lives", lives)
    observed = 10.0 ** law(None, "", np.array([0.05]), 0.7)[:, 0]
    tests = {"tangential_force_amplitude": forces, "life": observed}
    found = swtstudy.fit(rig[0], tests, friction=True)
    assert float(found.friction) == pytest.approx(0.7, rel=1e-2)


def test_a_fit_says_what_it_is(rig, monkeypatch, kept):
    marks = [0, "no", "", "No", "yes", "TRUE", " x ", 1, "1", "1.0", "y", "0.0", "false", "n", "nan", "0"]
    forces = np.linspace(30.0, 80.0, 16)
    law = Law(forces)
    monkeypatch.setattr(fitting, "_lives", law)
    factors = 10.0 ** np.tile([0.3, -0.28, 0.1, -0.1, 0.72, -0.68, 0.0, 0.05], 2)
    lives = factors * 10.0 ** law(None, "", np.array([0.05]), None)[:, 0]
    tests = {"tangential_force_amplitude": forces, "life": lives, "load": ["two"] * 16, "runout": marks}
    kept("told_fit", told(swtstudy.fit(rig[0], tests, friction=True, confidence=0.8)))
    kept("told_fit_of_distance", told(swtstudy.fit(rig[0], {**tests, "runout": [0] * 16})))


def test_forces_that_no_friction_bears_are_refused(rig, monkeypatch, tmp_path):
    monkeypatch.setattr(fitting, "_lives", Law([300.0, 599.5, 400.0]))
    other = tmp_path / "other.toml"
    other.write_text(STUDY.replace("friction = 0.5", "friction = 2.999"), encoding="utf-8")
    tests = {"tangential_force_amplitude": [300.0, 599.5, 400.0], "life": [1e6, 1e5, 1e4]}
    words = r"^friction: found tangential forces that need 3 at least; allowed: forces that 3 bears$"
    refused(words, swtstudy.fit, other, tests, friction=True)


def test_a_test_that_slides_is_refused_before_anything_is_solved(rig, monkeypatch):
    monkeypatch.setattr(fitting, "_lives", None)
    tests = {"tangential_force_amplitude": [30.0, 106.0, 120.0], "life": [1e6, 1e5, 1e4]}
    words = (
        "tests: found test 2, whose tangential force is 1.06 times the friction limit: it slides; 1 more like"
    )
    for friction in (False, True):
        error = refused(words, swtstudy.fit, rig[0], tests, friction=friction)
        assert "allowed: a friction of 0.53 at least for this test, or less force" in str(error)


def likelihood(law, distance, scatter, bounds, runout):
    """Logarithm of the likelihood of tests, by the distributions of scipy."""
    from scipy.stats import norm

    predicted = law(None, "", np.array([distance]), None)[:, 0]
    cracked = norm.logpdf(np.log10(bounds), predicted, scatter)
    return np.where(runout, norm.logsf(np.log10(bounds), predicted, scatter), cracked).sum()


def test_a_friction_that_the_tests_do_not_determine_has_no_narrow_interval(rig, monkeypatch):
    forces = np.linspace(30.0, 80.0, 6)
    law = Law(forces, friction=0.0)
    monkeypatch.setattr(fitting, "_lives", law)
    noise = np.random.default_rng(3).normal(scale=0.2, size=6)
    lives = 10.0 ** (law(None, "", np.array([0.05]), None)[:, 0] + noise)
    found = swtstudy.fit(rig[0], {"tangential_force_amplitude": forces, "life": lives}, friction=True)
    assert found.friction_low < 0.01 * found.friction
    assert found.friction_high > 100.0 * found.friction


@pytest.mark.usefixtures("unwrapped")
def test_run_outs_are_lower_bounds_of_life(rig, monkeypatch, tmp_path):
    """The largest likelihood by brute force; leaving them out, or taking them for cracks, is too short."""
    from scipy.optimize import minimize

    forces = np.linspace(30.0, 80.0, 12)
    law = Law(forces)
    monkeypatch.setattr(fitting, "_lives", law)
    noise = np.random.default_rng(3).normal(scale=0.3, size=12)
    lives = 10.0 ** (law(None, "", np.array([0.05]), None)[:, 0] + noise)
    runout = lives > np.sort(lives)[7]
    bounds = np.where(runout, np.sort(lives)[7], lives)
    best = minimize(lambda x: -likelihood(law, *np.exp(x), bounds, runout), np.log([0.05, 0.3]), tol=1e-8)
    texts = [
        f">{bound:.17g}" if out else repr(float(bound)) for bound, out in zip(bounds, runout, strict=True)
    ]
    tests = {"tangential_force_amplitude": forces, "life": texts}
    found = swtstudy.fit(rig[0], tests)
    assert float(found.critical_distance) == pytest.approx(np.exp(best.x[0]), rel=2e-3)
    # Of the sample: 12 tests, of which 8 cracked, and one parameter.
    assert float(found.scatter) == pytest.approx(np.exp(best.x[1]) * np.sqrt(8 / 7), rel=5e-3)
    assert found.runout.values.tolist() == runout.astype(int).tolist()
    # Everything has a unit; the text of the study has the tests and the constants.
    assert {found[name].attrs["units"] for name in ("observed", "predicted", "scatter")} == {"1"}
    again = Study.from_text(found.attrs["study"]).grid
    np.testing.assert_array_equal(again.samples["tangential_force_amplitude"], forces)
    assert again.materials == (ALUMINIUM, ALUMINIUM)
    assert str(again.values("load")[0]) == "two"
    # In the figure they are open marks that point to longer lives, with a word in the legend.
    figure = draw_fit(found)
    (axes,), (legend,) = figure.axes, figure.legends
    assert [text.get_text() for text in axes.texts] == [str(number) for number in range(1, 13)]
    place = float(found.observed[3]), float(found.predicted[3])
    assert axes.texts[3].xy == pytest.approx(place)
    cracked, survived = axes.lines[-2:]
    np.testing.assert_allclose(cracked.get_xdata(), bounds[~runout])
    np.testing.assert_allclose(survived.get_xdata(), bounds[runout])
    assert (survived.get_marker(), survived.get_fillstyle()) == (">", "none")
    assert [text.get_text() for text in legend.get_texts()][-2:] == [
        "tests with a crack",
        "run-outs: no crack so far",
    ]
    half = np.log(found.critical_distance_high / found.critical_distance)
    curve = [
        likelihood(law, np.exp(best.x[0] + step), np.exp(best.x[1]), bounds, runout)
        for step in (-0.1, 0, 0.1)
    ]
    alone = 2.3646 / np.sqrt((2 * curve[1] - curve[0] - curve[2]) / 0.01)  # at a known scatter
    assert alone < float(half) < 1.3 * alone
    for other in (bounds[~runout], bounds):
        few = forces[~runout] if len(other) < 12 else forces
        monkeypatch.setattr(fitting, "_lives", Law(few))
        shorter = swtstudy.fit(rig[0], {"tangential_force_amplitude": few, "life": other})
        assert float(shorter.critical_distance) < 0.97 * float(found.critical_distance)
    monkeypatch.setattr(fitting, "_lives", law)
    # A mark is no unit.
    rows = [
        f"{force},{text}" for force, text in sorted(zip(forces, texts, strict=True), key=lambda row: row[1])
    ]
    (tmp_path / "tests.csv").write_text("\n".join(["tangential_force_amplitude,life", *reversed(rows)]))
    monkeypatch.setattr(fitting, "_lives", Law([float(row.split(",")[0]) for row in reversed(rows)]))
    again = swtstudy.fit(rig[0], tmp_path / "tests.csv")
    assert float(again.critical_distance) == pytest.approx(float(found.critical_distance), rel=1e-6)
    monkeypatch.setattr(fitting, "_lives", law)
    # The same from a table as rigs write it, with names of specimens and marks.
    rows = [
        f"A{k};{f};{life};{'yes' if out else ''}"
        for k, (f, life, out) in enumerate(zip(forces, bounds, runout, strict=True))
    ]
    (tmp_path / "tests.csv").write_text("\n".join(["specimen;tangential_force_amplitude;life;runout", *rows]))
    with pytest.warns(UserWarning, match="columns that are no parameters are left alone: specimen"):
        again = swtstudy.fit(rig[0], tmp_path / "tests.csv")
    assert float(again.critical_distance) == float(found.critical_distance)


WRONG = sayings(r"""
dict(tangential_force_amplitude=[30, 60], life=[">1e7", 1e6]) » found 1 test with a crack; allowed: 2
dict(tangential_force_amplitude=[30, 60], life=["", 1e6]) » life '' of test 1; allowed: .* as >1e7
dict(tangential_force_amplitude=[30, 60, 70], life=[1e5, 1e6, 1e7], runout=[0, 1, "perhaps"])
» tests: found runout 'perhaps' of test 3; allowed: 1 or 0, true or false
dict(tangential_force_amplitude=[30.0, 60.0]) » tests: found the columns tangential_
dict(tangential_force_amplitude=[30.0], life=[1e5]) » tests: found 1 test; allowed: 2 at least
dict(life=[1e5, 1e6]) » tests: found the column life alone
dict(tangential_force_amplitude=[30, 60], life=[1e5, -1]) » life -1.0 of test 2; allowed
dict(tangential_force_amplitude=[30, 60], life=[1e5, "no"]) » life 'no' of test 2
dict(tangential_force_amp=[30, 60], life=[1e5, 1e6]) » unknown parameter
"nowhere.csv" » nowhere.csv: found no such file in the folder
3 » tests: found 3 \(.*\); allowed: a CSV file
dict(tangential_force_amplitude=[30, 60, 70], life=[1e5, 1e6])
» ^tests: found .*same length.*; allowed: a CSV file, or columns by name, with a value for each
dict(tangential_force_amplitude=["", 60, 70], life=[1e5, 1e6, 1e7])
» ^tests.tangential_force_amplitude: found '' .not a number, .*. at \[0\]; allowed: a force
""")


@pytest.mark.parametrize(("tests", "words"), WRONG)
def test_wrong_tables_are_named(rig, tests, words):
    refused(words[0], swtstudy.fit, rig[0], eval(tests))


def test_a_table_of_pandas_is_one_of_tests(rig, monkeypatch):
    tests = {"tangential_force_amplitude": FORCES, "life": [100.0, 60.0, 40.0]}
    monkeypatch.setattr(fitting, "_lives", Law(FORCES))
    table = pd.DataFrame(tests, index=range(5, 5 + len(FORCES)))
    xr.testing.assert_identical(swtstudy.fit(rig[0], table), swtstudy.fit(rig[0], tests))


def test_a_study_is_given_as_its_file(rig):
    tests = {"tangential_force_amplitude": [30, 60], "life": [1e5, 1e6]}
    with pytest.raises(StudyError, match=r"^study: found <Study .*; allowed: the path of a study file"):
        swtstudy.fit(Study.from_toml("figure3"), tests)  # type: ignore[arg-type]


def test_mistakes_in_a_file_of_tests_are_named_by_file_and_line(rig, tmp_path):
    path = tmp_path / "tests.csv"
    for rows, words in (
        ("30,0,\n60,1e5,\n70,-1,", "line 3: found life 0.*; 1 more like it; allowed: positive"),
        ("30,1e5,\n60,1e5,\n70,1e6,perhaps", "line 5: found runout 'perhaps'; allowed: 1 or 0"),
        ("30,1e5,", "found 1 test; allowed: 2 at least"),
        ("", "found no tests; allowed: a row for each"),
    ):
        path.write_text(f"tangential_force_amplitude,life,runout\n\n{rows}\n")
        refused(f"^{re.escape(str(path))}: {words}", swtstudy.fit, rig[0], path)


def test_a_table_of_tests_is_told_no_keys_that_it_has_not(rig, tmp_path):
    path = tmp_path / "tests.csv"
    path.write_bytes("tangential_force_amplitude;life;by\n30;1e5;Müller\n60;1e6;Müller\n".encode("latin-1"))
    refused(r"that are not UTF-8; allowed: the file saved as UTF-8$", swtstudy.fit, rig[0], path)
    path.write_text("tangential_force_amplitude;Nf\n30;1e5\n")
    refused(r"line 1: found the columns .*; allowed: a header with life$", swtstudy.fit, rig[0], path)


@pytest.mark.filterwarnings("ignore:tests.csv")
def test_tables_of_spreadsheets_are_read_as_they_are_meant(rig, monkeypatch, tmp_path):
    """With decimal commas, headers of other spelling, and marks of run-outs."""
    path, forces, lives = tmp_path / "tests.csv", [30.5, 60.0, 70.0], [100.0, 60.0, 45.0]
    monkeypatch.setattr(fitting, "_lives", Law(forces))
    expected = swtstudy.fit(
        rig[0], {"tangential_force_amplitude": forces, "life": lives, "runout": [0, 0, 1]}
    )
    for text in (
        "tangential_force_amplitude;life\n30,5;100\n60;60\n70;>4,5e1\n",
        "Tangential_Force_Amplitude,Life,Run_Out\n30.5,100,no\n60,60,no\n70,45,yes\n",
    ):
        path.write_text(text)
        xr.testing.assert_identical(swtstudy.fit(rig[0], path), expected)
    frame = pd.DataFrame({"tangential_force_amplitude": forces, "Life": lives, "Run-out": [0, 0, 1]})
    xr.testing.assert_identical(swtstudy.fit(rig[0], frame), expected)


@pytest.mark.filterwarnings("ignore:.*read as units")
def test_tests_in_another_unit_are_refused(rig, tmp_path):
    path = tmp_path / "tests.csv"
    path.write_text("tangential_force_amplitude,life\nkN,cycles\n0.03,1e5\n0.06,1e4\n")
    words = "tests.csv: found 'tangential_force_amplitude' in kN .* in N; allowed: a column in N: .* 1000$"
    refused(words, swtstudy.fit, rig[0], path)


@pytest.mark.filterwarnings("ignore:.*read as units")
@pytest.mark.parametrize("unit", ["kcycles", "[Mcycles]", "thousands"])
def test_lives_in_thousands_of_cycles_are_refused(rig, tmp_path, unit):
    path = tmp_path / "tests.csv"
    path.write_text(f"tangential_force_amplitude,life\nN,{unit}\n30,100\n60,10\n")
    words = rf"tests.csv: found life in {unit.strip('[]')}; allowed: load cycles, not thousands"
    refused(words, swtstudy.fit, rig[0], path)


def test_mistakes_in_a_file_of_tests_name_it(rig, tmp_path):
    path = tmp_path / "tests.csv"
    path.write_text("normal_forc,tangential_force_amplitude,life\n200,60,1e6\n200,80,1e5\n")
    refused(r"tests\.csv: normal_forc: found unknown parameter", swtstudy.fit, rig[0], path)
    refused(r"tests\.csv: found a table of values \(CSV\); allowed: a study", swtstudy.fit, path, rig[0])


def test_all_mistakes_of_a_table_are_named_as_its_own(rig):
    wrong = {"normal_force": [-5, 200, 300], "frictoin": [1, 2, 3], "life": [0, "no", 1e5]}
    error = refused("", swtstudy.fit, rig[0], {"tangential_force_amplitude": FORCES, **wrong})
    life, force, friction = str(error).splitlines()
    assert life.startswith(
        "tests: found life 0 of test 1; 1 more like it; allowed: positive numbers; of a run"
    )
    assert force.startswith("tests.normal_force: found -5 (out of range) at [0]; allowed: a positive force")
    assert friction.startswith(
        "tests.frictoin: found unknown parameter 'frictoin'; allowed: did you mean fric"
    )


def test_wrong_requests_are_named(rig, tmp_path):
    tests = {"tangential_force_amplitude": [30, 60], "life": [1e5, 1e6]}
    refused("y: found 'cycles'", swtstudy.fit, rig[0], tests, y="cycles")
    refused(r"y: found 'FS_cycles'; allowed: .*FS_cycles_volume", swtstudy.fit, rig[0], tests, y="FS_cycles")
    words = "y: found 'FS_cycles_volume'; allowed: one of cycles_volume, cycles_p"
    refused(words, swtstudy.fit, rig[0], tests, y="FS_cycles_volume")
    other = tmp_path / "other.toml"
    other.write_text(STUDY.replace("friction = 0.5", "friction = 5"), encoding="utf-8")
    three = {"tangential_force_amplitude": [30, 60, 80], "life": [1e5, 1e6, 1e7]}
    with pytest.raises(StudyError, match="friction: found 5; allowed: a positive number below 3"):
        swtstudy.fit(other, three, friction=True)
    refused("confidence: found 2", swtstudy.fit, rig[0], tests, confidence=2)
    plain = tmp_path / "plain.toml"
    plain.write_text('title = "t"', encoding="utf-8")
    with pytest.raises(StudyError, match=r"a study with \[units\] and the constants"):
        swtstudy.fit(plain, {"phase": [0, 1], "life": [1e5, 1e6]})
    with pytest.raises(StudyError, match=r"no such file in the folder .*allowed: a study file"):
        swtstudy.fit(tmp_path / "none.toml", tests)


def test_a_best_distance_at_the_end_is_no_fit(rig, monkeypatch):
    monkeypatch.setattr(fitting, "_lives", Law([30.0, 60.0]))
    with pytest.raises(StudyError, match=r"at the upper end of the range tried, .* are still shorter"):
        swtstudy.fit(rig[0], {"tangential_force_amplitude": [30, 60], "life": [1e9, 1e9]})


def test_the_command_writes_the_figure(rig, monkeypatch, tmp_path):
    forces = np.linspace(30.0, 80.0, 6)
    law = Law(forces)
    monkeypatch.setattr(fitting, "_lives", law)
    factors = np.array([1.0, 3.0, 0.5, 1.5, 0.9, 6.0])
    observed = factors * 10.0 ** law(None, "", np.array([0.05]), None)[:, 0]
    file = tmp_path / "tests.csv"
    rows = [f"{force},{life}" for force, life in zip(forces, observed, strict=True)]
    file.write_text("\n".join(["tangential_force_amplitude,life", *rows]), encoding="utf-8")
    done = CliRunner().invoke(main, ["fit", str(rig[0]), str(file), "--results", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert done.stdout.startswith("critical_distance = 0.0")
    assert "of 6 tests 4 within a factor of 2, 6 within a factor of 5" in done.stdout
    assert (tmp_path / "rig_fit.nc").exists()
    assert (tmp_path / "rig_fit.png").exists()
    other = ["--y", "cycles_point", "--results", str(tmp_path)]
    assert "rig_fit_point.nc" in CliRunner().invoke(main, ["fit", str(rig[0]), str(file), *other]).stdout
    found = swtstudy.fit(rig[0], file)
    assert fit_lines(found)[0] == done.stdout.splitlines()[0]
    # Friction may be a column of the tests, and is no result then.
    of_tests = {"tangential_force_amplitude": forces, "friction": np.full(6, 0.5), "life": observed}
    assert fit_lines(swtstudy.fit(rig[0], of_tests)) == fit_lines(found)


def with_material(*lines):
    text = STUDY.replace("[material]", "\n".join(["[material]", *lines]))
    return text.replace("friction = 0.5", "friction = 0.5\ntangential_force_amplitude = 60")


RANGES = ("threshold_stress_intensity_range = 110", "fatigue_limit_range = 280")


def test_the_moduli_of_both_bodies_are_looked_at():
    text = with_material().replace("young_modulus = 73.1e3", "young_modulus = [72, 73.1]")
    said = " ".join(warned(Study.from_text, text)[1])
    assert "over young_modulus 72 is 12.9" in said
    assert "over young_modulus 73.1 is 12.7" in said


def test_properties_of_a_file_and_alone(tmp_path):
    (tmp_path / "materials.toml").write_text(
        "[alloy]\nyield_strength = 300\n" + "\n".join(RANGES), encoding="utf-8"
    )
    head, _, tail = with_material().partition("[material]")
    text = (
        head + '[material]\nfile = "materials.toml"\nname = "alloy"\n[fixed]' + tail.partition("[fixed]")[2]
    )
    study = Study.from_text(text, "s", tmp_path)
    assert study.grid.yield_strengths == (300.0, 300.0)
    assert study.grid.materials == ()
    assert study.asked.names == ("von_mises",)
    # The text that the archive keeps needs no file.
    again = Study.from_text(study.text)
    assert (again.grid.yield_strengths, again.asked.distances) == ((300.0, 300.0), study.asked.distances)
