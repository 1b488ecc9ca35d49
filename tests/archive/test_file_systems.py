"""File systems that lack modes, locks or the sync of folders; and what others put beside an archive."""

import errno
import io
import os
import stat
import subprocess
import sys

import netCDF4
import numpy as np
import pytest
import stand_in
from command import call, ends

from swtstudy import Study, open_results, run, solve

fcntl = pytest.importorskip("fcntl")
STUDY = Study.from_text('title = "t"\nrtol = 1e-2\n[axes]\nfriction = [0.1, 0.25]\n')
LARGER = Study.from_text('title = "t"\nrtol = 1e-2\n[axes]\nfriction = [0.1, 0.25, 0.5]\n')


def refused(number):
    def refuse(*_, **__):
        raise OSError(number, os.strerror(number))

    return refuse


def twice(path):
    """A run, a second one that finds nothing to do, and one of a grown study."""
    for study in (STUDY, STUDY, LARGER):
        assert np.isfinite(run(study, path, solver=stand_in.smooth).s).all()
    assert sorted(each.name for each in path.parent.iterdir()) == [path.name]


def test_a_file_system_without_modes(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "chmod", refused(errno.EPERM))
    twice(tmp_path / "t.nc")


def test_a_file_system_that_cannot_sync_folders(tmp_path, monkeypatch):
    fsync = os.fsync

    def sync(handle):
        if stat.S_ISDIR(os.fstat(handle).st_mode):
            raise OSError(errno.EINVAL, os.strerror(errno.EINVAL))
        fsync(handle)

    monkeypatch.setattr(os, "fsync", sync)
    twice(tmp_path / "t.nc")


@pytest.mark.parametrize("number", [errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP])
def test_a_file_system_without_locks_is_told(tmp_path, monkeypatch, caplog, number):
    monkeypatch.setattr(fcntl, "flock", refused(number))
    twice(tmp_path / "t.nc")
    assert "a file system without locks; run t.nc once at a time" in caplog.text


def test_a_disk_that_refuses_a_lock_says_what_to_do(tmp_path, monkeypatch):
    monkeypatch.setattr(fcntl, "flock", refused(errno.EIO))
    with pytest.raises(OSError, match=r"cannot lock .*t\.nc \(.*\); choose another folder"):
        run(STUDY, tmp_path / "t.nc", solver=stand_in.smooth)


def test_a_system_without_locks_runs_all_the_same(tmp_path, monkeypatch):
    monkeypatch.setattr("swtstudy.archive.paths.fcntl", None)
    twice(tmp_path / "t.nc")


def test_a_lock_that_may_not_be_opened_is_told_as_it_is(tmp_path, monkeypatch):
    own = os.open

    def refuse(path, *arguments, **named):
        if str(path).endswith("lock"):
            raise PermissionError(13, "Permission denied", str(path))
        return own(path, *arguments, **named)

    monkeypatch.setattr(os, "open", refuse)
    with pytest.raises(PermissionError, match="Permission denied"):
        run(STUDY, tmp_path / "t.nc", solver=stand_in.smooth)


@pytest.mark.parametrize("make", [os.mkfifo, lambda lock: lock.symlink_to(lock.parents[1] / "precious")])
def test_a_lock_that_is_a_pipe_or_a_link_is_left_alone(tmp_path, make):
    (tmp_path / "precious").write_text("precious")
    (tmp_path / "t.nc.parts").mkdir()
    make(tmp_path / "t.nc.parts" / "lock")
    with pytest.raises(OSError, match=r"lock is no file of ours \(.*\); remove it"):
        run(STUDY, tmp_path / "t.nc", solver=stand_in.smooth)
    assert (tmp_path / "precious").read_text() == "precious"


@pytest.mark.parametrize("kind", ["pipe", "device", "folder"])
def test_what_is_no_part_is_left_out(tmp_path, kind):
    folder = tmp_path / "t.nc.parts"
    folder.mkdir()
    part = folder / "000001.npz"
    if kind == "pipe":
        os.mkfifo(part)
    elif kind == "device":
        part.symlink_to("/dev/zero")
    else:
        part.mkdir()
    for study in (STUDY, LARGER):
        assert np.isfinite(run(study, tmp_path / "t.nc", solver=stand_in.smooth).s).all()
    assert os.path.lexists(part)


def test_a_file_that_claims_more_than_it_holds_is_not_read(tmp_path):
    path = tmp_path / "t.nc"
    run(STUDY, path, solver=stand_in.smooth)
    with netCDF4.Dataset(path, "a") as file:
        file.createDimension("endless", 4_000_000_000)
        file.createVariable("crafted", "f8", ("endless",), chunksizes=(1000,))
    with pytest.raises(ValueError, match=r"claims to hold 3.2e\+10 bytes"):
        open_results(path)


def test_results_of_solve_are_no_archive(tmp_path):
    solve(rtol=1e-2).to_netcdf(tmp_path / "s.nc")
    with pytest.raises(ValueError, match=r"s\.nc: results without a study, as of solve; xarray.open_dataset"):
        open_results(tmp_path / "s.nc")


@pytest.mark.parametrize("encoding", ["cp1252", "cp437"])
@pytest.mark.parametrize(
    "words", [("--help",), ("list",), ("schema",), ("solve", "--help"), ("validate", "figure3")]
)
def test_consoles_without_greek_letters(words, encoding, monkeypatch):
    streams = {name: io.TextIOWrapper(io.BytesIO(), encoding) for name in ("stdout", "stderr")}
    for name, stream in streams.items():
        monkeypatch.setattr(sys, name, stream)
    code = ends(*words)
    for stream in streams.values():
        stream.flush()
    out, errors = (stream.buffer.getvalue() for stream in streams.values())
    assert (code, errors) == (0, b"")
    assert out


def test_a_title_cannot_command_the_terminal(tmp_path):
    (tmp_path / "t.toml").write_text('title = "\\u001b[31mred"\n')
    run(Study.from_toml(tmp_path / "t.toml"), tmp_path / "t.nc", solver=stand_in.smooth)
    for words in (("info", tmp_path / "t.nc"), ("plan", tmp_path / "t.toml", "--results", tmp_path)):
        # With colours, as on a terminal: click removes such commands from what goes elsewhere.
        found = call(*words, color=True)
        assert found.exit_code == 0
        assert "red" in found.stdout
        assert "\x1b" not in found.stdout


@pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")
def test_a_closed_output_is_no_error(monkeypatch):
    closed = f'exec "{sys.executable}" -m swtstudy solve --help >&-'
    assert subprocess.run(closed, shell=True, timeout=300, stderr=subprocess.PIPE).stderr == b""
    monkeypatch.setattr(sys, "stdout", None)
    assert ends("list") == 0


def test_heights_below_a_flat_face_are_named(tmp_path):
    rows = [(r / 10, max(r / 10 - 0.4, 0.0) ** 2) for r in range(30)]
    rows[5] = 0.5, -0.1
    (tmp_path / "worn.csv").write_text("radius,height\n" + "".join(f"{r},{h}\n" for r, h in rows))
    text = 'title = "t"\n[fixed]\nprofile = "worn"\n[profiles.worn]\nfile = "worn.csv"\n'
    (tmp_path / "t.toml").write_text(text)
    with pytest.raises(ValueError, match=r"t\.toml: profiles\.worn: found -0\.1 at the radius 0\.5, below"):
        Study.from_toml(tmp_path / "t.toml")
