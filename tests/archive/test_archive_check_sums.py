"""Damaged files are detected; results that a user changed and saved do not count as damaged."""

import random
import re
import struct
from collections.abc import Iterator
from functools import partial

import netCDF4
import numpy as np
import pytest
import stand_in
import xarray as xr
from command import call

from swtstudy import Study, open_results, run

ONE = """title = "t"
rtol = 1e-2
[fixed]
friction = 0.37
normal_amplitude = 0.71
flat_radius = 0.53
profile = "rounded_punch"
phase = 1.3
"""
SEVERAL = '[axes]\nprofile = ["rounded_punch", "truncated_paraboloid"]\nphase = [0.11, 1.3]\n'
NAMED = ONE[: ONE.index("profile")] + SEVERAL


def flipped(content: bytes, sought: bytes) -> Iterator[bytes]:
    """The content with one bit flipped in every place of what is sought."""
    assert sought in content
    for found in re.finditer(re.escape(sought), content):
        changed = bytearray(content)
        changed[found.start() + len(sought) // 2] ^= 0x10
        yield bytes(changed)


@pytest.mark.parametrize(
    ("name", "value"),
    [("friction", 0.37), ("flat_radius", 0.53), ("phase", 1.3), ("profile", "rounded_punch"), ("s", None)],
)
@pytest.mark.parametrize("single", [False, True])
def test_a_flipped_bit_is_noticed(tmp_path, name, value, single):
    path = tmp_path / "small.nc"
    dataset = run(Study.from_text(ONE if single else NAMED), path, solver=stand_in.smooth, workers=1)
    if value is None and not single:
        with netCDF4.Dataset(path) as file:
            assert all(
                v.filters()["fletcher32"] for v in file.variables.values() if v.ndim and v.dtype != str
            )
        return
    value = dataset.s.item() if value is None else value
    content = path.read_bytes()
    for changed in flipped(content, value.encode() if isinstance(value, str) else struct.pack("<d", value)):
        path.write_bytes(changed)
        with pytest.raises(ValueError, match=f"^{path}: (a damaged file|not a readable)"):
            open_results(path)


@pytest.mark.slow
def test_damage_anywhere_is_noticed_or_changes_nothing(tmp_path):
    text = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = {start = 0.1, stop = 1, num = 300}\n'
    path = tmp_path / "small.nc"
    dataset = run(Study.from_text(text), path, solver=stand_in.smooth, workers=1)
    content = path.read_bytes()
    damaged = 0
    for position in range(0, len(content), 797):
        changed = bytearray(content)
        changed[position] ^= 0xFF
        path.write_bytes(changed)
        try:
            xr.testing.assert_identical(open_results(path), dataset)
        except ValueError as error:
            damaged += bool(re.search("a damaged file: wrong check sum|not a readable", str(error)))
    assert damaged > 10


def index_of(content: bytes) -> list[int]:
    """The places of HDF5's index of the chunks of arrays of two axes in a file."""
    places = []
    for node in re.finditer(rb"TREE\x01", content):
        entries = int.from_bytes(content[node.start() + 6 : node.start() + 8], "little")
        places += range(node.start(), node.start() + 24 + 48 * (entries + 1))
    return places


@pytest.mark.slow
def test_a_flip_in_the_index_of_the_chunks_opens_with_no_other_value(tmp_path):
    """HDF5 itself has no check sum of it."""
    path = tmp_path / "small.nc"
    text = NAMED.replace("[0.11, 1.3]", "{start = 0, stop = 3, num = 30}")
    text += "friction = {start = 0.1, stop = 1, num = 20}\n"
    study = Study.from_text(text.replace("friction = 0.37\n", ""))
    dataset = run(study, path, solver=partial(stand_in.fail_at, 0.1), workers=1)
    assert 0 < int(np.isnan(dataset.s).sum()) < dataset.s.size
    content = path.read_bytes()
    places, draw, refused = index_of(content), random.Random(6), 0
    for _ in range(60):
        changed = bytearray(content)
        changed[draw.choice(places)] ^= draw.randrange(1, 256)
        path.write_bytes(changed)
        try:
            xr.testing.assert_identical(open_results(path), dataset)
        except ValueError as error:
            refused += bool(re.search("wrong check sum|not a readable", str(error)))
    assert refused > 10


@pytest.mark.parametrize(
    "change",
    [
        lambda ds: ds.assign(s=ds.s.where(ds.phase > 0.2)),  # a value is NaN
        lambda ds: ds.assign(s_error=ds.s_error.fillna(0.0)),  # a NaN is a value
        lambda ds: ds.assign(s=("phase", ds.s.values[::-1])),  # in another place
        lambda ds: ds.assign(regime=0 * ds.regime),
        lambda ds: ds.assign(s=ds.s.astype("float32")),
        lambda ds: ds.assign_coords(phase=ds.phase + 1.0),
        lambda ds: ds.drop_vars("critical_angle"),
    ],
)
def test_every_variable_and_axis_is_in_the_check_sum(tmp_path, change):
    """Of results with the check sum of others."""
    path, changed = tmp_path / "small.nc", tmp_path / "changed.nc"
    study = Study.from_text('title = "t"\nrtol = 1e-2\n[axes]\nphase = [0.11, 1.3, 2]\n')
    dataset = run(study, path, solver=partial(lacking_error, 1.3), workers=1)
    assert np.isnan(dataset.s_error).sum() == 1
    for each in (dataset, change(dataset)):
        each.to_netcdf(changed)
        with netCDF4.Dataset(path) as file, netCDF4.Dataset(changed, "a") as other:
            other.createGroup("check_sum").setncattr("crc32", file["check_sum"].crc32)
        if each is dataset:
            xr.testing.assert_identical(open_results(changed), dataset)
    with pytest.raises(ValueError, match="a damaged file: wrong check sum"):
        open_results(changed)


def lacking_error(phase, points, rtol):
    solution = stand_in.smooth(points, rtol)
    return solution._replace(s_error=np.where(np.isclose(points.phase, phase), np.nan, solution.s_error))


def test_what_xarray_makes_of_results_can_be_saved_and_opened(small, tmp_path):
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    for changed in (
        dataset.assign(s=dataset.s * 1.5),
        dataset.isel(phase=0),
        dataset.isel(phase=0, normal_amplitude=1),
        dataset.isel(phase=slice(2, 5)).transpose(),
        dataset.assign_coords(friction=0.5),
        dataset.assign_coords(phase=dataset.phase + 0.1),
        dataset.assign_coords(note="mine", temperature=20.0),
    ):
        changed.to_netcdf(tmp_path / "changed.nc")
        xr.testing.assert_equal(open_results(tmp_path / "changed.nc"), changed)
        assert call("info", tmp_path / "changed.nc").exit_code == 0


def test_a_single_point_changed_by_plain_xarray_opens_with_what_it_was_changed_to(tmp_path):
    path = tmp_path / "point.nc"
    run(Study.from_text('title = "t"\nrtol = 1e-2\n'), path, solver=stand_in.smooth)
    with xr.open_dataset(path) as opened:
        dataset = opened.load()
    dataset["s"] = dataset.s * 1.5
    dataset["phase"] = dataset.phase + 0.5
    dataset.to_netcdf(path)
    changed = open_results(path)
    assert (changed.s.item(), changed.phase.item()) == (dataset.s.item(), 0.5)
