import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

import swtstudy
from swtstudy.cli import main

STUDIES = sorted((Path(__file__).parent.parent / "studies").glob("*.toml"))


@pytest.fixture
def study(small_text, tmp_path):
    path = tmp_path / "small.toml"
    path.write_text(small_text)
    return path


def call(*arguments):
    return CliRunner().invoke(main, list(map(str, arguments)))


def test_run_leaves_archive_and_figures(study, tmp_path):
    result = call("run", study, "--results", tmp_path / "results", "--format", "png", "--format", "pdf")
    assert result.exit_code == 0, result.output
    assert {path.name for path in (tmp_path / "results").iterdir()} == {"small.nc", "small.png", "small.pdf"}
    dataset = swtstudy.open_results(tmp_path / "results" / "small.nc")
    assert (dataset.s > 0).all()


def test_plot_needs_the_archive_alone(study, tmp_path):
    call("run", study, "--results", tmp_path)
    study.unlink()
    assert call("plot", tmp_path / "small.nc", "-o", tmp_path / "other.svg").exit_code == 0
    assert (tmp_path / "other.svg").stat().st_size > 1000


def test_solve_prints_a_table():
    result = call("solve", "--phase", "0, pi/2", "--rtol", "1e-2")
    assert result.exit_code == 0, result.output
    lines = result.output.splitlines()
    assert lines[0].split("\t")[:3] == ["phase", "s", "s_error"]
    assert len(lines) == 3


def test_version_and_help():
    assert swtstudy.__version__ in call("--version").output
    for command in ("run", "validate", "plot", "solve"):
        assert command in call("--help").output
        assert call(command, "--help").exit_code == 0


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_the_studies_of_the_paper_are_valid(path):
    result = call("validate", path)
    assert result.exit_code == 0, result.output
    assert "valid" in result.output


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        ('title = "t"\n[fixed]\nfriction = nan', 1),
        ('title = "t"\n[fixed]\nfriction = -1\npoisson_ratio = 0.7', 2),
        ('title = "t"\n[fixed]\nfrequency_ratio = "3/0"', 1),
        ('title = "t"\n[fixed]\nfrequency_ratio = "pi"', 1),
        ('title = "t"\n[axes]\nfrction = [1, 2]', 1),
        ("title = ", 1),
    ],
)
@pytest.mark.parametrize("command", ["run", "validate"])
def test_bad_studies_end_with_a_line_each(tmp_path, monkeypatch, command, text, lines):
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "bad.toml"
    path.write_text(text)
    result = call(command, path)
    assert result.exit_code == 2
    assert len(result.stderr.splitlines()) == lines
    assert all(line.startswith(f"Error: {path}: ") for line in result.stderr.splitlines())
    assert [entry.name for entry in tmp_path.iterdir()] == ["bad.toml"]


def test_missing_files_and_unwritable_folders(study, tmp_path):
    (tmp_path / "file").write_text("")
    for arguments in (
        ("run", tmp_path / "absent.toml"),
        ("plot", tmp_path / "absent.nc"),
        ("plot", study),
        ("run", study, "--results", tmp_path / "file"),
        ("run", study, "--results", tmp_path / "file" / "deeper"),
        ("solve", "--friction", "x"),
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
    assert "the same name as" in result.stderr


def test_help_imports_nothing_heavy():
    code = (
        "import sys; from swtstudy.cli import main; main(['-h'], standalone_mode=False); print(*sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    modules = set(done.stdout.split())
    assert not modules & {"numpy", "scipy", "xarray", "pydantic", "dask", "matplotlib", "netCDF4"}


def test_python_m(tmp_path):
    done = subprocess.run([sys.executable, "-m", "swtstudy", "--version"], capture_output=True, text=True)
    assert swtstudy.__version__ in done.stdout
