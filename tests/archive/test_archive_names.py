"""Names that no archive can have are refused before anything is computed."""

import re
from pathlib import Path

import pytest
import stand_in
from command import call

from swtstudy import StudyError, run


def told_by_commands(stem, words, *commands):
    """Words that commands on a study of this name say in their one line, and so does a merge."""
    for arguments in (
        *([each, f"{stem}.toml"] for each in commands),
        ["merge", "good.nc", "-o", f"{stem}.nc"],
    ):
        result = call(*arguments)
        assert result.exit_code == 2
        (line,) = result.stderr.splitlines()
        assert words in line


@pytest.mark.parametrize(
    ("stem", "words"),
    [
        ("back\\slash", "found a backslash, a null"),
        ("no\udcffutf8", "found a backslash, a null"),
        ("null\0", "found a backslash, a null"),
    ],
)
def test_a_name_that_no_archive_can_have_is_found_out_before(
    small, small_text, tmp_path, monkeypatch, stem, words
):
    counting = stand_in.Counting()
    with pytest.raises(StudyError, match=re.escape(words)):
        run(small, tmp_path / f"{stem}.nc", solver=counting)
    assert counting.points == 0
    if "\0" in stem:
        return  # no command is given that
    monkeypatch.chdir(tmp_path)
    Path(f"{stem}.toml").write_text(small_text)
    run(small, Path("good.nc"), solver=stand_in.smooth)
    before = sorted(tmp_path.iterdir())
    told_by_commands(stem, words, "validate", "plan", "run", "audit")
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("stem", ["n" * 243, "ν" * 122])
def test_a_name_that_is_too_long_is_found_out_before(small, small_text, tmp_path, monkeypatch, stem):
    """One that an unfinished file would have, too."""
    counting = stand_in.Counting()
    with pytest.raises(OSError, match=f"cannot write {stem}.nc into the folder .*: File name too long"):
        run(small, tmp_path / f"{stem}.nc", solver=counting)
    assert counting.points == 0
    monkeypatch.chdir(tmp_path)
    Path(f"{stem}.toml").write_text(small_text)
    run(small, Path("good.nc"), solver=stand_in.smooth)
    told_by_commands(stem, "File name too long", "run", "audit")


def test_the_longest_name_leaves_archive_and_figure(small_text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    stem = "n" * 241
    Path(f"{stem}.toml").write_text(small_text)
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    result = call("run", f"{stem}.toml")
    assert result.exit_code == 0, result.output
    assert {path.name for path in Path("results").iterdir()} == {f"{stem}.nc", f"{stem}.png"}


def test_a_file_in_place_of_the_results_is_found_out(small_text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("small.toml").write_text(small_text)
    Path("results").write_text("")
    result = call("run", "small.toml", "--results", "results/deeper")
    assert result.exit_code == 2
    assert "into the folder results/deeper: Not a directory" in result.stderr
