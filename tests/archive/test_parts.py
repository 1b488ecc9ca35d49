"""Parts of an unfinished archive are read as they were written, or left out with the reason."""

import hashlib
import io
import json
from pathlib import Path

import numpy as np
import pytest
import stand_in

from swtstudy import Study, run
from swtstudy.archive.archive import known_points
from swtstudy.archive.parts import (
    clear,
    keeping,
    kept_folder,
    part_paths,
    parts_folder,
    points_saved,
    read_parts,
    save_part,
)
from swtstudy.points.chunk import Found, read_runs

LINE = 'title = "t"\nrtol = 1e-3\n[axes]\nfriction = [0.1, 0.2, 0.3]\n'


@pytest.fixture
def found(tmp_path: Path) -> Found:
    """Values of three points, of which one has failed."""
    run(Study.from_text(LINE), tmp_path / "a.nc", workers=1, solver=lambda *a: stand_in.fail_at(0.2, *a))
    return known_points(tmp_path / "a.nc")


def equal(one: Found, other: Found) -> None:
    assert {*one.arrays} == {*other.arrays}
    for name, values in one.arrays.items():
        np.testing.assert_array_equal(values, other[name], err_msg=name)
        assert values.dtype == other[name].dtype
    assert one.runs == other.runs


def test_a_part_is_read_as_it_was_written(found: Found, tmp_path: Path) -> None:
    folder = tmp_path / "other.nc.parts"
    assert folder == parts_folder(tmp_path / "other.nc")
    save_part(folder, found)
    assert [path.name for path in folder.iterdir()] == ["000001.npz"]
    read = read_parts(folder)
    equal(read, found)
    assert read["message"].tolist() == ["", "ZeroDivisionError: an injected failure", ""]
    # The next one beside what is there, whose points count once.
    (folder / "000007.npz").write_bytes(b"")
    save_part(folder, found)
    assert sorted(path.name for path in folder.iterdir()) == ["000001.npz", "000007.npz", "000008.npz"]
    assert len(read_parts(folder)) == 6
    assert points_saved(folder) == 3
    clear(folder, part_paths(folder))
    assert not [*folder.iterdir()]
    assert len(read_parts(folder)) == 0
    assert len(read_parts(tmp_path / "absent")) == 0


def rewritten(path: Path, **changes: object) -> None:
    """A part with another description of itself, and the check sum of that."""
    with np.load(io.BytesIO(path.read_bytes()[:-32])) as part:
        arrays = dict(part)
    meta = json.loads(arrays.pop("meta").item())
    meta = {name: value for name, value in {**meta, **changes}.items() if value is not None}
    content = io.BytesIO()
    np.savez(content, meta=np.array(json.dumps(meta)), **arrays)
    path.write_bytes(content.getvalue() + hashlib.sha256(content.getvalue()).digest())


LAYOUT = {"columns": [], "profiles": [], "criteria": []}


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({}, ""),
        ({"layout": LAYOUT}, "made by another version of swtstudy"),
        ({"layout": None}, "'layout'"),
        ({"runs": "{}"}, "Input should be a valid array"),
        ({"messages": None}, "'messages'"),
        ({"runs": 3}, "JSON input should be string"),
    ],
)
def test_a_part_that_is_none_is_left_out_with_the_reason(
    found: Found, tmp_path: Path, caplog: pytest.LogCaptureFixture, changes: dict, reason: str
) -> None:
    folder = tmp_path / f"other{len(str(changes))}.nc.parts"
    save_part(folder, found)
    rewritten(folder / "000001.npz", **changes)
    for _ in range(2):
        assert len(read_parts(folder)) == (0 if reason else 3)
    said = f"{folder}/000001.npz: left out, its points will be computed again ("
    if not reason:
        assert not caplog.messages
    else:  # once, however often it is read
        (message,) = caplog.messages
        assert message.startswith(said + reason)


def test_the_layout_of_a_part_names_columns_profiles_and_criteria(found: Found, tmp_path: Path) -> None:
    save_part(tmp_path / "a.nc.parts", found)
    with np.load(io.BytesIO((tmp_path / "a.nc.parts" / "000001.npz").read_bytes()[:-32])) as part:
        meta = json.loads(part["meta"].item())
    assert [*meta] == ["layout", "runs", "messages"]
    assert [*meta["layout"]] == ["columns", "profiles", "criteria"]
    assert meta["layout"]["criteria"] == ["swt", "fatemi_socie", "findley"]
    assert ["friction", "<f8"] in meta["layout"]["columns"]
    assert "paraboloid" in meta["layout"]["profiles"]
    assert meta["messages"] == {"1": "ZeroDivisionError: an injected failure"}


def test_what_is_kept_replaces_what_was(found: Found, tmp_path: Path) -> None:
    folder = kept_folder(tmp_path / "b.nc")
    assert folder == tmp_path / "b.nc.kept"
    with keeping(folder, found):
        assert len(read_parts(folder)) == 3
    (folder / ".000002-abcd1234.npz").write_text("")
    with pytest.raises(ZeroDivisionError), keeping(folder, found):
        raise ZeroDivisionError
    assert len(read_parts(folder)) == 6
    assert len(known_points(tmp_path / "b.nc")) == 6
    with keeping(folder, found.take(np.array([True, False, False]))):
        pass
    assert [path.name for path in folder.iterdir()] == ["000003.npz"]
    with keeping(folder, found.take(np.zeros(3, bool))):
        pass
    assert not folder.exists()


def test_times_and_quantities_of_runs_are_checked(found: Found) -> None:
    text = [run.to_json() for run in found.runs]
    assert read_runs(json.dumps(text)) == found.runs
    for name, value, words in (
        ("seconds", -1.0, "seconds of a run: -1.0"),
        ("quantities", ["speed"], "quantities of a run: ('speed',)"),
    ):
        with pytest.raises(ValueError, match="of a run") as error:
            read_runs(json.dumps([{**text[0], name: value}]))
        assert str(error.value) == words
    for good in ({"seconds": 0.0}, {"quantities": ["dissipation", "strain_cycles", "critical_distance"]}):
        read_runs(json.dumps([{**text[0], **good}]))
