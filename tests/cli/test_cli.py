import json
import os
import shutil
import signal
import subprocess
import sys
from functools import partial
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import stand_in
from command import call, main, succeeded
from drawn import curves, whole
from folders import STUDIES
from solved import MISSING
from soundness import SHAPES
from words import PARAMETERS, SAID

import swtstudy
from swtstudy import Study, run

#: The tests look at what is written, not at the layout of figures.
pytestmark = pytest.mark.usefixtures("unwrapped")

STUDY_FILES = sorted(STUDIES.glob("*.toml"))


@pytest.fixture
def study(small_text, tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(small_text)
    return path


@pytest.fixture(scope="module")
def finished(small_text, tmp_path_factory):
    """A folder with the study, its archive and its figure."""
    folder = tmp_path_factory.mktemp("finished")
    (folder / "small.toml").write_text(small_text)
    succeeded("run", folder / "small.toml", "--results", folder)
    return folder


@pytest.fixture
def drawn(monkeypatch):
    """Figures that commands draw, which are not saved."""
    figures = []
    save = "swtstudy.figures.style.save_figure"
    monkeypatch.setattr(save, lambda figure, path, style: figures.append(figure))
    return figures


@pytest.fixture
def ran(finished, tmp_path):
    """A copy of such a folder."""
    return shutil.copytree(finished, tmp_path, dirs_exist_ok=True)


def test_run_leaves_archive_and_figures(study, tmp_path):
    succeeded("run", study, "--results", tmp_path / "results", "--format", "png", "--format", "svg")
    assert {path.name for path in (tmp_path / "results").iterdir()} == {"small.nc", "small.png", "small.svg"}
    dataset = swtstudy.open_results(tmp_path / "results" / "small.nc")
    assert (dataset.s > 0).all()


def test_plot_needs_the_archive_alone(ran):
    (ran / "small.toml").unlink()
    succeeded("plot", ran / "small.nc", "-o", ran / "other.svg")
    assert (ran / "other.svg").stat().st_size > 1000


@pytest.fixture(scope="module")
def merged(tmp_path_factory):
    """Two archives as one, of studies without a figure."""
    tmp_path = tmp_path_factory.mktemp("merged")
    for friction in (0.1, 0.2):
        text = f'title = "t"\naxes.phase = [0, 1, 2]\nfixed.friction = {friction}\n'
        run(Study.from_text(text), tmp_path / f"{friction}.nc", solver=stand_in.smooth)
    succeeded("merge", tmp_path / "0.1.nc", tmp_path / "0.2.nc", "-o", tmp_path / "both.nc")
    return tmp_path / "both.nc"


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    "options",
    [
        ("--x", "phase", "--hue", "friction", "--y", "critical_x", "--y", "regime"),
        ("--x", "phase", "--panels", "friction", "--title", "critical", "--regimes"),
        ("--x", "phase", "--vertical", "friction", "--kind", "contour", "--y", "critical_angle"),
        ("--x", "friction", "--vertical", "phase", "--kind", "heatmap", "--y", "regime"),
    ],
)
def test_an_archive_without_a_figure_is_plotted_as_the_options_say(merged, options, drawn):
    succeeded("plot", merged, *options)
    own: dict = {"y": []}
    for key, value in zip(options[::2], (*options[1::2], True), strict=False):
        name = key.removeprefix("--")
        own[name] = [*own["y"], value] if name == "y" else value
    expected = swtstudy.open_results(merged).swt.panels(**{**own, "y": own["y"] or "s"})
    pictures = []
    for figure in (drawn[0], expected):
        picture = BytesIO()
        figure.savefig(picture, format="png", dpi=50)
        pictures.append(picture.getvalue())
    assert pictures[0] == pictures[1]


def test_options_change_the_figure_of_an_archive(finished, drawn):
    succeeded("plot", finished / "small.nc", "--y", "critical_x", "--title", "Where")
    (figure,) = drawn
    dataset = swtstudy.open_results(finished / "small.nc")
    for line, values in zip(curves(figure.axes[0]), dataset.critical_x, strict=True):
        np.testing.assert_array_equal(whole(line)[1], values)
    assert figure.get_suptitle() == "Where"


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ((), "have no figure of a study; allowed: a layout of your own, with x one of phase, friction"),
        (("--y", "critical_x"), "have no figure of a study"),
        (("--x", "fase", "--hue", "friction"), "figure.x: found 'fase', not an axis of these results; "),
        (("--x", "phase"), "no place for the axis friction"),
        (("--x", "phase", "--hue", "friction", "--y", "speed"), "figure.y: found 'speed' (not a quantity)"),
        (("--x", "phase", "--hue", "friction", "--kind", "pie"), "figure.kind: found 'pie'"),
        (("--x", "phase", "--hue", "friction", "--title", "$x^2^3$"), "figure.title: "),
    ],
)
def test_a_layout_that_cannot_be_drawn_is_one_line(merged, options, words):
    result = call("plot", merged, *options)
    assert result.exit_code == 2
    assert words in result.stderr
    assert "Traceback" not in result.stderr
    assert not merged.with_suffix(".png").exists()


def test_plot_says_that_nothing_is_finite(tmp_path):
    study, archive = tmp_path / "none.toml", tmp_path / "results/none.nc"
    forces = "[fixed]\nnormal_force_amplitude = 0\n[axes]\ntangential_force_amplitude = [2, 3]\n"
    study.write_text(f'title = "t"\n{forces}[figure]\nx = "tangential_force_amplitude"\n')
    call("run", study, "--results", archive.parent)
    result = call("plot", archive)
    assert result.exit_code == 0
    assert result.stderr == f"{archive}: s is finite at no point of the figure\n"


def test_plot_says_what_an_unfinished_archive_lacks(ran):
    archive = ran / "small.nc"
    assert call("plot", archive).stderr == ""
    dataset = swtstudy.open_results(archive)
    dataset.s[0], dataset.status[0] = np.nan, MISSING
    dataset.to_netcdf(archive)
    result = succeeded("plot", archive)
    lacking = dataset.s[0].size
    assert result.stderr == f"{archive}: {lacking} of {dataset.s.size} points are missing\n"
    assert result.stdout == f"{archive.with_suffix('.png')}\n"


def test_a_study_without_finite_values_says_so(tmp_path):
    path = tmp_path / "edge.toml"
    path.write_text(
        'title = "t"\n[fixed]\nprofile = "truncated_paraboloid"\nflat_radius = 1\nnormal_amplitude = 1.2\n'
        "tangential_amplitude = 1\n[axes]\nphase = [1, 2]\n"
    )
    result = succeeded("run", path, "--results", tmp_path)
    assert "s finite and positive at none of them" in result.output
    assert "nan" not in result.output


def test_a_style_is_the_users(ran, tmp_path):
    (tmp_path / "own.mplstyle").write_text("figure.facecolor: red\n")
    plain, own = (tmp_path / f"{name}.svg" for name in ("plain", "own"))
    succeeded("plot", tmp_path / "small.nc", "-o", plain)
    style = tmp_path / "own.mplstyle"
    succeeded("plot", tmp_path / "small.nc", "-o", own, "--style", style)
    assert "#ff0000" in own.read_text()
    assert "#ff0000" not in plain.read_text()
    result = call("plot", tmp_path / "small.nc", "--style", "no_such_style")
    assert result.exit_code == 2
    assert len(result.stderr.splitlines()) == 1


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        ("--psi=0", "--phase"),
        ("--u-a", "--tangential-amplitude"),
        ("--P", "--normal-force-amplitude"),
        ("--f", "--friction"),
    ],
)
def test_an_unknown_option_names_the_one_that_was_meant(typed, meant):
    result = call("solve", typed)
    assert result.exit_code == 2
    assert "Usage: swtstudy solve" in result.stderr.replace("main", "swtstudy")
    assert f"'{typed.removesuffix('=0')}'. Did you mean '{meant}'?" in result.stderr


def test_an_option_given_twice_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = call("show", "-o", "a.png", "--output", "b.png")
    assert result.exit_code == 2
    assert result.stderr == "Error: --output: found 2 times; allowed: once\n"
    assert not list(tmp_path.iterdir())


def test_plan_writes_nothing(study, tmp_path):
    succeeded("plan", study, "--results", tmp_path / "results")
    assert not (tmp_path / "results").exists()


@pytest.mark.parametrize(
    ("seconds", "parts", "words"),
    [
        (0.04, 1, "0.0 s"),
        # Only workers that have something to do count.
        (10, 2, "5.0 s"),
        (10, 9, "5.0 s"),
        (360_000, 1, "100 h 0 min"),
    ],
)
def test_plan_tells_the_time_of_the_workers(study, tmp_path, monkeypatch, seconds, parts, words):
    monkeypatch.setattr("swtstudy.archive.run.estimate", lambda work: (seconds, 1, parts))
    assert f"about {words} with 2 workers" in call("plan", study, "--results", tmp_path).output


def test_a_reader_that_has_enough_is_no_mistake():
    # Its help is printed where all is that a command prints.
    command = [sys.executable, "-m", "swtstudy", "new", "--help"]
    ours, theirs = os.pipe()
    os.close(ours)
    done = subprocess.run(command, stdout=theirs, stderr=subprocess.PIPE, check=False)
    os.close(theirs)
    assert done.stderr == b""
    assert done.returncode == 1


def test_merge_keeps_what_another_archive_in_its_place_had(merged, tmp_path):
    """Three points of it are in the merged archive, two are not, and a study that has these finds them."""
    text = 'title = "t"\n[axes]\nphase = [0, 1, 2, 2.5, 3]\n[fixed]\nfriction = 0.1\n'
    before = run(Study.from_text(text), tmp_path / "there.nc", solver=stand_in.smooth)
    parts = (merged.with_name("0.1.nc"), merged.with_name("0.2.nc"))
    for _ in range(2):
        result = succeeded("merge", *parts, "-o", tmp_path / "there.nc")
        assert f"2 points of before are kept in {tmp_path / 'there.nc.kept'}" in result.stderr
        assert swtstudy.open_results(tmp_path / "there.nc").s.size == 6
    again = run(Study.from_text(text), tmp_path / "there.nc", solver=None)
    np.testing.assert_allclose(again.s, before.s, rtol=1e-12)


def test_failed_points_are_recomputed_if_asked(study, tmp_path, monkeypatch):
    study.write_text(
        study.read_text().replace("[axes]", "[axes]\nfriction = [0.2, 0.3]\n").split("[figure]")[0]
    )
    monkeypatch.setattr(stand_in.SOLVER, partial(stand_in.fail_at, 0.2))
    result = call("run", study, "--results", tmp_path)
    assert result.exit_code == 3
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    assert call("run", study, "--results", tmp_path).exit_code == 3
    succeeded("run", study, "--results", tmp_path, "--retry-failed")


def test_ctrl_c_says_how_to_go_on(study, tmp_path, monkeypatch):
    monkeypatch.setattr(stand_in.SOLVER, stand_in.Interrupting(0))
    result = call("run", study, "--results", tmp_path)
    assert result.exit_code == 130
    assert "0 of 8 distinct points are saved" in result.stderr
    assert "the same command continues" in result.stderr


def test_a_second_ctrl_c_does_not_take_the_words_of_the_first(study, tmp_path, monkeypatch):
    def ctrl_c(*_):
        signal.raise_signal(signal.SIGINT)

    def stopped(words):  # where the words of the first are made
        ctrl_c()
        return KeyboardInterrupt(words)

    monkeypatch.setattr(stand_in.SOLVER, ctrl_c)
    monkeypatch.setattr("swtstudy.archive.run.Stopped", stopped)
    result = call("run", study, "--results", tmp_path)
    assert result.exit_code == 130
    assert "0 of 8 distinct points are saved" in result.stderr


@pytest.mark.slow
def test_a_scheduler_that_is_not_there(study, tmp_path):
    pytest.importorskip("distributed")
    code = (
        # The command has the name of its module.
        "from importlib import import_module\nfrom swtstudy.cli import main\n"
        "import_module('swtstudy.cli.run').CONNECT_SECONDS = 0.2\n"
        f"main(['run', {str(study)!r}, '--results', {str(tmp_path)!r}, '--scheduler', 'tcp://127.0.0.1:9'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 2
    assert "Error: no dask scheduler at tcp://127.0.0.1:9" in done.stderr
    assert "Traceback" not in done.stderr


def test_version_and_help():
    assert swtstudy.__version__ in call("--version").output
    for name in main.commands:
        assert name in call("--help").output
        assert call(name, "-h").output == call(name, "--help").output
        assert "  Examples:\n    swtstudy " in call(name, "--help").output


@pytest.mark.parametrize("path", STUDY_FILES, ids=lambda path: path.stem)
def test_the_studies_of_the_paper_are_valid(path):
    result = succeeded("validate", path)
    assert "valid" in result.output


def test_a_syntax_error_shows_the_line_beneath_it(tmp_path):
    (tmp_path / "bad.toml").write_text("title = ")
    result = call("validate", tmp_path / "bad.toml")
    assert result.exit_code == 2
    first, *shown = result.stderr.splitlines()
    assert first.startswith(f"Error: {tmp_path / 'bad.toml'}: found a syntax error: ")
    assert shown == ["Error:    1 | title = ", "Error:      |         ^"]


def test_unwritable_folders(study, tmp_path):
    (tmp_path / "file").write_text("")
    for arguments in (
        ("run", study, "--results", tmp_path / "file"),
        ("run", study, "--results", tmp_path / "file" / "deeper"),
    ):
        result = call(*arguments)
        assert result.exit_code == 2, arguments
        assert len(result.stderr.splitlines()) == 1
        assert isinstance(result.exception, SystemExit)


def test_two_studies_cannot_leave_the_same_archive(study, tmp_path):
    (tmp_path / "other").mkdir()
    twin = tmp_path / "other" / study.name
    twin.write_text(study.read_text())
    result = call("run", study, twin, "--results", tmp_path / "results")
    assert result.exit_code == 2
    assert f"{twin}: found the same name as {study}; allowed: names that differ" in result.stderr


@pytest.fixture
def template(tmp_path, monkeypatch):
    """The text of a new study."""
    monkeypatch.chdir(tmp_path)
    call("new", "mine")
    return Path("mine.toml").read_text()


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from swtstudy.cli import main; main(['-h'], standalone_mode=False); print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = set(done.stdout.split())
    assert not modules & {"numpy", "scipy", "xarray", "pydantic", "dask", "matplotlib", "netCDF4"}


def test_a_command_exits_without_looking_through_all_objects():
    code = (
        "import atexit, gc; from swtstudy.cli import main\n"
        "atexit.register(lambda: print(gc.get_freeze_count() > 1000))\n"
        "main(['new', '--help'])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "True"


def test_python_m(tmp_path):
    done = subprocess.run([sys.executable, "-m", "swtstudy", "--help"], capture_output=True, text=True)
    assert done.stdout.startswith("Usage: swtstudy [")


@pytest.fixture
def suite(small_text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for module in ("study.shipped", "archive.run"):
        monkeypatch.setattr(f"swtstudy.{module}.shipped_folder", lambda: tmp_path / "studies")
    (tmp_path / "studies").mkdir()
    for name, text in (("one", small_text.split("[figure]")[0]), ("two", small_text)):
        (tmp_path / "studies" / f"{name}.toml").write_text(text)
    return tmp_path


def test_all_studies_in_one_go(suite):
    succeeded("run", "--all", "--workers", 1)
    names = {path.name for path in (suite / "results").iterdir()}
    assert names == {"one.nc", "two.nc", "two.png"}
    again = swtstudy.run_suite(formats=["svg"], workers=1)
    assert list(again) == ["one", "two"]
    assert (suite / "results" / "two.svg").is_file()


def test_a_folder_stands_for_its_studies(suite):
    result = succeeded("validate", "studies")
    assert [line.split(":")[0] for line in result.output.splitlines()] == [
        "studies/one.toml",
        "studies/two.toml",
    ]
    (suite / "empty").mkdir()
    assert "a folder without studies" in call("validate", "empty").stderr


def test_a_study_of_the_paper_has_a_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    listed = call("list").output
    for name in ("figure3", "figure8"):
        assert name in listed
        assert "valid" in call("validate", name).output
    result = call("validate", "figur3")
    assert result.exit_code == 2
    assert "did you mean figure3?" in result.stderr
    # What is here comes first.
    (tmp_path / "figure3").mkdir()
    assert "a folder without studies" in call("validate", "figure3").stderr


def test_new_writes_a_valid_study_and_replaces_none(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    succeeded("new", "my_first")
    study = swtstudy.Study.from_toml("my_first.toml")
    assert study.title == "my first"
    assert study.figure is not None
    assert (tmp_path / "study.schema.json").is_file()
    assert not (tmp_path / ".toml").exists()
    (tmp_path / "my_first.toml").write_text("mine")
    result = call("new", "my_first.toml")
    assert result.exit_code == 2
    assert "already exists" in result.stderr
    assert (tmp_path / "my_first.toml").read_text() == "mine"


@pytest.mark.parametrize("profile", SHAPES)
def test_every_comment_of_a_new_study_is_a_parameter_that_may_be_given(template, profile):
    text = template.replace('"paraboloid"\n#', f'"{profile}"\n#', 1)
    # It goes with other criteria.
    names = {name for name in PARAMETERS if "default" in SAID[name]} - {"normal_sensitivity"}
    names |= {*SHAPES[profile]}
    for name in PARAMETERS:
        value = SAID[name].get("default", {"wavelength": 7, "exponent": 3}.get(name, 0.01))
        lines = [line for line in text.splitlines() if line.startswith(f"# {name} = ")]
        assert len(lines) == (name not in ("profile", "normal_amplitude", "phase"))
        for line in lines if name in names else ():
            text = text.replace(line, f"{name} = {json.dumps(value)}")
    study = swtstudy.Study.from_text(text)
    assert set(study.grid.fixed) | set(study.grid.axes) == names | {"normal_sensitivity"}


def test_a_new_study_of_a_cylinder_has_forces(template):
    assert '"cylinder" (plane: forces alone)' in template
    text = template.replace('profile = "paraboloid"', 'profile = "cylinder"')
    text = text.replace("# tangential_force_amplitude = …", "tangential_force_amplitude = 0.2")
    text = text.replace("normal_amplitude", "normal_force_amplitude")
    study = swtstudy.Study.from_text(text)
    assert study.grid.control.name == "forces"


@pytest.mark.parametrize(
    ("words", "typed", "offered"),
    [
        ("swtstudy run", "fig", {"plain,figure3", "plain,figure8"}),
        ("swtstudy run --workers 1 --workers 2", "fig", {"plain,figure3", "plain,figure8"}),
        ("swtstudy validate", "mi", {"plain,mine.toml"}),
        ("swtstudy validate", "stu", {"plain,studies/own.toml"}),
        ("swtstudy info", "", {"plain,results/mine.nc"}),
        ("swtstudy plan", "elsewhere/", {"file,elsewhere/"}),
        ("swtstudy", "me", {"plain,merge"}),
    ],
)
def test_the_shell_completes(tmp_path, monkeypatch, words, typed, offered):
    monkeypatch.chdir(tmp_path)
    for name in ("mine.toml", "studies/own.toml", "results/mine.nc"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("")
    variables = {
        "_SWTSTUDY_COMPLETE": "bash_complete",
        "COMP_WORDS": f"{words} {typed}",
        "COMP_CWORD": str(len(words.split())),
    }
    result = call(env=variables, prog_name="swtstudy")
    assert offered <= set(result.output.split())


def test_a_study_too_large_to_compute_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = call("run", "parameter_box")
    assert result.exit_code == 2
    assert "too many to compute" in result.stderr


def test_a_study_that_memory_cannot_hold_ends_in_one_line(monkeypatch):
    def refuse(*_):
        raise MemoryError("Unable to allocate 4.85 GiB")

    monkeypatch.setattr("swtstudy.archive.run.Work", refuse)
    result = call("plan", "figure3")
    assert result.exit_code == 2
    assert result.stderr == "Error: Unable to allocate 4.85 GiB\n"
