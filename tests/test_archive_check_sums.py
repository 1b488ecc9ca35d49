"""Damaged files are detected; results that a user changed and saved do not count as damaged."""

import re
import shutil
import struct
from collections.abc import Iterator
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import stand_in
import xarray as xr
from click.testing import CliRunner

from swtstudy import Study, open_results, run
from swtstudy.archive.error import ArchiveError
from swtstudy.archive.merge import merge
from swtstudy.cli import main

NAMED = (
    'title = "t"\nrtol = 1e-2\n[fixed]\nfriction = 0.37\nnormal_amplitude = 0.71\nflat_radius = 0.53\n'
    '[axes]\nprofile = ["rounded_punch", "truncated_paraboloid"]\nphase = [0.11, 1.3]\n'
)
ONE = (
    'title = "t"\nrtol = 1e-2\n[fixed]\nfriction = 0.37\nnormal_amplitude = 0.71\nflat_radius = 0.53\n'
    'profile = "rounded_punch"\nphase = 1.3\n'
)


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
    text = NAMED.replace("[axes]\n", "").replace(
        '["rounded_punch", "truncated_paraboloid"]', '"rounded_punch"'
    )
    text = text.replace("[0.11, 1.3]", "1.3") if single else NAMED
    dataset = run(Study.from_text(text), path, solver=stand_in.smooth, workers=1)
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
        with pytest.raises(ArchiveError, match=f"^{path}: ") as caught:
            open_results(path)
        named = f"damaged file: wrong check sum of {name}" in str(caught.value)
        assert isinstance(value, str) or named


def test_damaged_values_are_named(tmp_path):
    text = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = {start = 0.1, stop = 1, num = 300}\n'
    path = tmp_path / "small.nc"
    dataset = run(Study.from_text(text), path, solver=stand_in.smooth, workers=1)
    content = path.read_bytes()
    damaged = set()
    for position in range(0, len(content), 397):
        changed = bytearray(content)
        changed[position] ^= 0xFF
        path.write_bytes(changed)
        try:
            xr.testing.assert_identical(open_results(path), dataset)
        except ArchiveError as error:
            damaged.update(re.findall(r"damaged file: wrong check sum of (\w+)", str(error)))
    assert damaged
    assert damaged <= {*dataset.variables}


def test_an_archive_without_check_sums_opens_as_ever(tmp_path):
    path = Path(__file__).parent / "data" / "without_check_sums.nc"
    dataset = open_results(path)
    assert dataset.s.dims == ("profile", "phase")
    np.testing.assert_array_equal(dataset.phase, [0.0, np.pi / 2])
    np.testing.assert_allclose(dataset.s, [[0.155137, 0.151461], [0.122635, 0.118161]], atol=1e-6)
    assert dataset.run.attrs["long_name"].startswith("run that made the value")
    xr.testing.assert_equal(merge([path]), dataset)


def test_an_archive_that_does_not_say_what_is_prescribed_opens_as_ever(tmp_path):
    """It is from before forces could be; its points are those of today."""
    path = tmp_path / "old.nc"
    shutil.copy(Path(__file__).parent / "data" / "without_control.nc", path)
    with netCDF4.Dataset(path) as file:
        assert "control" not in file.variables
    dataset = open_results(path)
    assert dataset.control.item() == "displacements"
    np.testing.assert_allclose(dataset.s, [[0.155137, 0.151461], [0.122635, 0.118161]], atol=1e-6)
    xr.testing.assert_equal(merge([path]), dataset)
    again = run(Study.from_text(dataset.attrs["study"]), path, workers=1)
    np.testing.assert_allclose(again.s, dataset.s, rtol=1e-6)
    assert again.control.item() == "displacements"


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
        assert CliRunner().invoke(main, ["info", str(tmp_path / "changed.nc")]).exit_code == 0


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
