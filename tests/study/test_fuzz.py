"""Any content of a file gives success or a clear message, never another exception, never a damaged file."""

import functools
import multiprocessing
import random
import tempfile
import tomllib
from pathlib import Path

import pytest
import stand_in
from click.testing import CliRunner
from folders import STUDIES
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from mutated import mutated

from swtstudy import Study, StudyError, open_results, run
from swtstudy.archive.archive import known_points
from swtstudy.archive.parts import parts_folder, read_parts, save_part
from swtstudy.cli import main
from swtstudy.points.solve import solve_grid
from swtstudy.study.definition import study_from
from swtstudy.study.writing import to_toml

NAMES = ["title", "rtol", "fixed", "axes", "figure", "x", "hue", "panels", "y", "start", "stop", "num"]
NAMES += [
    "friction",
    "phase",
    "profile",
    "frequency_ratio",
    "flat_radius",
    "waviness_amplitude",
    "wavelength",
    "exponent",
]
TEXTS = ["phase", "friction", "wavy_paraboloid", "rounded_punch", "3/2", "pi", "3/0", "s", "s/s(phase=0)"]

scalars = (
    st.sampled_from(TEXTS) | st.text(max_size=8) | st.integers() | st.floats() | st.booleans() | st.dates()
)
values = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.sampled_from(NAMES) | st.text(max_size=5), inner, max_size=5)
    ),
    max_leaves=12,
)
tables = st.dictionaries(st.sampled_from(NAMES) | st.text(max_size=5), values, max_size=6)
studies = st.fixed_dictionaries(
    {"title": st.just("t")},
    optional={"fixed": tables, "axes": tables, "figure": tables, "rtol": scalars, "other": values},
)


@given(studies | tables)
@example({"title": "t", "axes": {"title": "wrong", "friction": [0.3]}})
@example({"title": "t", "axes": {"\ud800": 3}})
@settings(max_examples=50, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_any_tables_are_a_study_or_a_study_error(raw):
    try:
        study = study_from(raw, "", "fuzz", Path("."))
    except StudyError as error:
        assert error.mistakes
        assert all(
            str(mistake).startswith("fuzz: ") and "\n" not in str(mistake) for mistake in error.mistakes
        )
    else:
        assert study.grid.size >= 1


@given(st.binary(max_size=200) | st.text(max_size=200).map(str.encode))
@settings(max_examples=50, deadline=None)
def test_any_bytes_are_a_study_or_a_study_error(content):
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "fuzz.toml"
        path.write_bytes(content)
        result = CliRunner().invoke(main, ["validate", str(path)])
        assert result.exit_code in (0, 2)
        assert result.exception is None or isinstance(result.exception, SystemExit)


STUDY = (STUDIES / "figure4.toml").read_text()


# What has no effect is told, as a warning.
@pytest.mark.filterwarnings("ignore:study: ")
@given(st.integers(0, len(STUDY) - 1), st.integers(0, 20), st.text(max_size=4))
@settings(max_examples=200, deadline=None)
def test_a_mangled_study_is_a_study_or_a_study_error(position, removed, inserted):
    text = STUDY[:position] + inserted + STUDY[position + removed :]
    try:
        Study.from_text(text)
    except StudyError as error:
        assert error.mistakes
    else:
        assert tomllib.loads(text)


#: Points of a study that are solved, and how many of the changed studies are.
FEW, SOLVED = 4, 10


# Strengths and phases that are odd, but allowed.
@pytest.mark.filterwarnings("ignore::UserWarning")
def test_changed_studies_are_studies_or_study_errors(request):
    """From a seed; `pytest tests/study/test_fuzz.py -k changed --changed-studies 8700` makes many."""
    count, sound = request.config.getoption("--changed-studies"), 0
    for number, text in enumerate(mutated(20240508, count)):
        try:
            study = Study.from_text(text)
        except StudyError as error:
            assert error.mistakes, text
            continue
        except Exception as error:
            raise AssertionError(f"{error!r} of the study\n{text}") from error
        sound += 1
        assert study.title in study._repr_html_()
        again = to_toml(study.title, study.rtol, study.grid, study.figure, study.asked)
        assert Study.from_text(again).grid == study.grid, text
        if study.grid.size <= FEW and number % SOLVED == 0:
            assert solve_grid(study.grid, 1e-2, study.asked).s.size == study.grid.size
    assert sound > 0.1 * count


SMALL = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = [0.1, 0.2]\nphase = [0, 1]\n'


@functools.cache
def archive() -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        run(Study.from_text(SMALL), Path(folder) / "small.nc", solver=stand_in.smooth)
        return (Path(folder) / "small.nc").read_bytes()


def survives(content: bytes) -> None:
    """`info`, `run`, `plot`, `merge` and `open_results` deal with a file of this content."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "small.nc"
        path.write_bytes(content)
        (Path(folder) / "small.toml").write_text(SMALL)
        try:
            readable = open_results(path) is not None
        except ValueError as error:
            readable = False
            assert str(path) in str(error)
        for arguments in (
            ["info", str(path)],
            ["plan", str(Path(folder) / "small.toml"), "--results", folder],
            ["merge", str(path), str(path), "-o", str(Path(folder) / "merged.nc")],
        ):
            result = CliRunner().invoke(main, arguments)
            assert result.exit_code in (0, 2), (arguments, result.exception)
            assert result.exception is None or isinstance(result.exception, SystemExit)
        assert path.read_bytes() == content
        try:
            run(Study.from_text(SMALL), path, solver=stand_in.smooth)
        except ValueError as error:
            assert "move it away" in str(error)
            assert path.read_bytes() == content
        else:
            assert readable
        assert not Path(f"{path}.parts").exists()


# HDF5 may take a mangled file to be one of an enormous size; netCDF4 then warns or fails in its own ways.
@pytest.mark.filterwarnings("ignore")
@given(st.floats(0, 1, exclude_max=True))
@settings(max_examples=15, deadline=None)
def test_truncated_archives(part):
    survives(archive()[: int(part * len(archive()))])


def all_survive(contents: list[bytes]) -> None:
    for content in contents:
        survives(content)


@pytest.mark.slow
@given(st.lists(st.tuples(st.floats(0, 1, exclude_max=True), st.binary(min_size=1, max_size=8)), min_size=12))
@settings(max_examples=2, deadline=None)
def test_mangled_archives(changes):
    contents = []
    for part, noise in changes:
        position = int(part * len(archive()))
        contents.append(archive()[:position] + noise + archive()[position + len(noise) :])
    # HDF5 itself may crash, or not come back, from such a file: in a process of its own.
    process = multiprocessing.get_context("spawn").Process(target=all_survive, args=(contents,))
    process.start()
    process.join(60)
    process.kill()
    process.join()
    # Killed by a signal: what no Python code can prevent.
    assert process.exitcode <= 0


def part_of(folder: Path) -> Path:
    """A run of four points, all saved, whose archive is not there yet; its only part."""
    run(Study.from_text(SMALL), folder / "small.nc", solver=stand_in.smooth)
    parts = parts_folder(folder / "small.nc")
    parts.mkdir()
    save_part(parts, known_points(folder / "small.nc"))
    (folder / "small.nc").unlink()
    (part,) = parts.glob("*.npz")
    return part


def test_a_flipped_bit_anywhere_in_a_part_leaves_it_out(tmp_path):
    part = part_of(tmp_path)
    whole = part.read_bytes()
    assert len(read_parts(part.parent)) == 4
    dice = random.Random(1)
    for position in range(0, len(whole), 23):
        content = bytearray(whole)
        content[position] ^= 1 << dice.randrange(8)
        part.write_bytes(content)
        assert len(read_parts(part.parent)) == 0, position
    for length in range(0, len(whole), 97):
        part.write_bytes(whole[:length])
        assert len(read_parts(part.parent)) == 0, length


def test_a_damaged_part_is_said_once_and_computed_again(tmp_path, caplog):
    part = part_of(tmp_path)
    content = bytearray(part.read_bytes())
    content[content.rindex(b"PK\x01\x02") + 8] |= 1  # "encrypted"
    part.write_bytes(content)
    (tmp_path / "small.toml").write_text(SMALL)
    planned = CliRunner().invoke(main, ["plan", str(tmp_path / "small.toml"), "--results", str(tmp_path)])
    assert planned.exit_code == 0
    informed = CliRunner().invoke(main, ["info", str(tmp_path / "small.nc")])
    assert isinstance(informed.exception, SystemExit)  # there is nothing else
    counting = stand_in.Counting()
    run(Study.from_text(SMALL), tmp_path / "small.nc", solver=counting)
    assert counting.points == 4
    assert [message for message in caplog.messages if "left out" in message] == [
        f"{part}: left out, its points will be computed again (damaged)"
    ]
