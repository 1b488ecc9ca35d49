"""Files and folders that are not the package's own are left as they are; its own are whole or absent."""

import os
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import stand_in
from command import call, succeeded

from swtstudy import Study, open_results, run

STUDY = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = [0.1, 0.2]\n'
FIGURE = '[figure]\nx = "friction"\n'


def computed(folder: Path, text: str = STUDY, **kwargs: object) -> Path:
    path = folder / "mine.nc"
    run(Study.from_text(text), path, workers=1, solver=stand_in.smooth, **kwargs)
    return path


def refused(*arguments: object) -> str:
    result = call(*arguments)
    assert result.exit_code == 2, (result.output, result.exception)
    assert isinstance(result.exception, SystemExit)
    return result.output


@pytest.mark.parametrize("folder", ["mine.nc.parts", "mine.nc.kept"])
def test_a_link_in_the_place_of_a_folder_is_refused(tmp_path: Path, folder: str) -> None:
    other = tmp_path / "other"
    other.mkdir()
    for name in (".profile", "000001.npz", "1.npz"):
        (other / name).write_text("mine")
    (tmp_path / folder).symlink_to(other)
    with pytest.raises(OSError, match="is a link; allowed: a folder that swtstudy makes"):
        computed(tmp_path)
    assert {path.name: path.read_text() for path in other.iterdir()} == dict.fromkeys(
        (".profile", "000001.npz", "1.npz"), "mine"
    )


def test_files_of_the_users_own_in_a_folder_of_parts_stay(tmp_path: Path) -> None:
    path, parts, kept = (tmp_path / f"mine.nc{end}" for end in ("", ".parts", ".kept"))
    study = Study.from_text(STUDY.replace("[0.1, 0.2]", "{start = 0.1, stop = 0.9, num = 400}"))
    with pytest.raises(KeyboardInterrupt):
        run(study, path, workers=1, solver=stand_in.Interrupting(192))
    assert list(parts.glob("0*.npz"))
    kept.mkdir()
    own = [
        parts / name
        for name in (".mine", "1.npz", "notes-12345678.npz", ".mine-abc.nc", ".other-a1b2c3d4.nc")
    ]
    own.append(kept / ".mine")
    ours = [parts / ".mine-a1b2c3d4.nc", parts / ".000002-_1b2c3d4.npz", kept / ".000001-_1b2c3d4.npz"]
    for each in (*own, *ours):
        each.write_text("x")
    run(study, path, workers=1, solver=stand_in.smooth)
    assert all(each.read_text() == "x" for each in own)
    assert not any(each.exists() for each in ours)
    assert not list(parts.glob("0*.npz"))
    assert open_results(path).s.notnull().all()


def test_nothing_but_a_regular_file_is_replaced(tmp_path: Path) -> None:
    path = computed(tmp_path, STUDY + FIGURE)
    os.mkfifo(tmp_path / "pipe.png")
    os.mkfifo(tmp_path / "pipe.nc")
    (tmp_path / "null.png").symlink_to("/dev/null")
    assert "pipe.nc: not a regular file" in refused("info", tmp_path / "pipe.nc")
    for arguments in (
        ["plot", path, "-o", tmp_path / "pipe.png"],
        ["plot", path, "-o", tmp_path / "null.png"],
        ["merge", path, path, "-o", tmp_path / "pipe.nc"],
        ["schema", "-o", "/dev/null"],
    ):
        assert "is not a regular file" in refused(*arguments)
    assert Path("/dev/null").is_char_device()
    assert (tmp_path / "pipe.png").is_fifo()
    assert (tmp_path / "pipe.nc").is_fifo()


def test_what_a_link_points_to_is_written(tmp_path: Path) -> None:
    far = tmp_path / "far"
    far.mkdir()
    computed(far).rename(far / "kept.nc")
    computed(far)
    (tmp_path / "mine.nc").symlink_to(far / "mine.nc")
    path = computed(tmp_path, STUDY.replace("0.2]", "0.2, 0.3]"))
    assert path.is_symlink()
    assert open_results(far / "mine.nc").s.size == 3
    (tmp_path / "merged.nc").symlink_to(far / "kept.nc")
    succeeded("merge", path, "-o", tmp_path / "merged.nc")
    assert (tmp_path / "merged.nc").is_symlink()
    assert open_results(far / "kept.nc").s.size == 3
    # Also where there is nothing yet.
    (tmp_path / "schema.json").symlink_to(far / "new")
    succeeded("schema", "-o", tmp_path / "schema.json")
    assert "properties" in (far / "new").read_text()
    assert {each.name for each in far.iterdir()} == {"kept.nc", "mine.nc", "new"}


@pytest.mark.skipif(not os.path.isdir("/dev/shm"), reason="there is no second file system")
def test_what_a_link_points_to_may_be_on_another_file_system(tmp_path: Path) -> None:
    with TemporaryDirectory(dir="/dev/shm") as far:
        (tmp_path / "mine.nc").symlink_to(Path(far) / "mine.nc")
        path = computed(tmp_path)
        assert path.is_symlink()
        assert os.listdir(far) == ["mine.nc"]
        assert open_results(path).s.size == 2


def full(*_: object, **__: object) -> None:
    raise OSError(28, "No space left on device")


def test_a_full_disk_leaves_no_half_of_a_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        assert "mine.toml" in refused("new", tmp_path / "mine")
    assert list(tmp_path.iterdir()) == []
    succeeded("new", tmp_path / "mine")
    before = (tmp_path / "mine.toml").read_text()
    assert "already exists" in refused("new", tmp_path / "mine")
    assert (tmp_path / "mine.toml").read_text() == before
    schema = tmp_path / "study.schema.json"
    schema.unlink()
    replace = os.replace

    def all_but_the_schema(source: Path, target: Path) -> None:
        full() if "schema" in target.name else replace(source, target)

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", all_but_the_schema)
        call("new", tmp_path / "other")
    assert sorted(each.name for each in tmp_path.iterdir()) == ["mine.toml", "other.toml"]


@pytest.mark.usefixtures("unwrapped")
def test_an_error_in_writing_names_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = computed(tmp_path, STUDY + FIGURE)
    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        assert f"No space left on device: '{tmp_path / 'mine.png'}'" in refused("plot", path)

    def fails(*_: object, **__: object) -> None:
        raise OSError("not of a file")

    monkeypatch.setattr(Path, "write_bytes", fails)
    assert refused("plot", path) == "Error: not of a file\n"
    assert not [each for each in tmp_path.iterdir() if each.name.startswith(".")]


@pytest.mark.usefixtures("unwrapped")
def test_a_line_that_is_no_style_is_told(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    path = computed(tmp_path, STUDY + FIGURE)
    style = tmp_path / "mine.mplstyle"
    style.write_text('axes.prop_cycle: cycler("color", ["r", "#00ff00"])  # wide\nlines.linewidth 2\n')
    succeeded("plot", path, "--style", style)
    assert f"Missing colon in file '{style}', line 2 ('lines.linewidth 2')" in caplog.text
