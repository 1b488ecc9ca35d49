import contextlib

import netCDF4
import numpy as np
import pytest
import stand_in
import xarray as xr

import swtstudy
from swtstudy import Study, open_results, run
from swtstudy.archive.files import check_writable, replacing
from swtstudy.archive.read import ArchiveError
from swtstudy.parameters import PARAMETERS


def test_a_round_trip_keeps_values_and_names(small, tmp_path):
    dataset = run(small, tmp_path / "deep" / "small.nc", solver=stand_in.smooth)
    again = open_results(tmp_path / "deep" / "small.nc")
    xr.testing.assert_identical(dataset, again)
    assert again.s.dims == small.grid.dims
    assert np.isfinite(again.s).all()


def test_plain_xarray_reads_it(small, tmp_path):
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    with xr.open_dataset(tmp_path / "small.nc") as dataset:
        assert dataset.s.sel(phase=np.pi, normal_amplitude=0.25, method="nearest").item() > 0


def test_provenance(small, tmp_path):
    attributes = run(small, tmp_path / "small.nc", solver=stand_in.smooth).attrs
    assert attributes["study"] == small.text
    assert attributes["title"] == small.title
    assert attributes["rtol"] == small.rtol
    assert attributes["Conventions"].startswith("CF-1.")
    assert f"swtstudy {swtstudy.__version__}" in attributes["history"]
    assert "numpy" in attributes["versions"]
    assert attributes["wall_time_seconds"] > 0


def test_cf_rules(small, tmp_path):
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    assert {"title", "history", "source", "Conventions"} <= dataset.attrs.keys()
    for name, variable in dataset.variables.items():
        assert variable.attrs["long_name"]
        if name in PARAMETERS:
            assert variable.attrs["symbol"] == PARAMETERS[name].symbol
        if name not in ("regime", "status", "profile"):
            assert variable.attrs["units"] in ("1", "rad", "degree")
    assert all(name in dataset for name in dataset.s.attrs["ancillary_variables"].split())
    assert dataset.regime.attrs["flag_values"].dtype == dataset.regime.dtype


def test_a_failed_write_leaves_the_old_file(tmp_path):
    target = tmp_path / "file.txt"
    target.write_text("old")

    def fail():
        with replacing(target) as temporary:
            temporary.write_text("half")
            raise RuntimeError

    with pytest.raises(RuntimeError):
        fail()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_an_unwritable_folder_is_found_out_before(small, tmp_path):
    (tmp_path / "results").write_text("a file, not a folder")

    def never(points, rtol):
        raise AssertionError("computed")

    with pytest.raises(OSError, match="cannot write into the folder"):
        run(small, tmp_path / "results" / "small.nc", solver=never)
    with pytest.raises(OSError, match="is a folder"):
        check_writable(tmp_path)


@pytest.mark.parametrize(
    "content", [b"", b"CDF", b"not a netCDF file at all", b"\x89HDF\r\n\x1a\n" + bytes(90)]
)
def test_other_files_are_refused(tmp_path, content):
    path = tmp_path / "other.nc"
    path.write_bytes(content)
    with pytest.raises(ValueError, match="not a readable netCDF archive"):
        open_results(path)


def test_other_netcdf_files_are_refused(tmp_path):
    xr.Dataset({"t": ("x", [1.0])}).to_netcdf(tmp_path / "other.nc")
    with pytest.raises(ValueError, match="not an archive of swtstudy"):
        open_results(tmp_path / "other.nc")
    with pytest.raises(FileNotFoundError, match="no such archive"):
        open_results(tmp_path / "absent.nc")


def test_coordinates_have_no_fill_value(small, tmp_path):
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    with netCDF4.Dataset(tmp_path / "small.nc") as file:
        for name in ("phase", "normal_amplitude", "friction"):
            assert "_FillValue" not in file[name].ncattrs()
        assert file["s"].filters()["zlib"]
        assert file["s"].filters()["fletcher32"]


def test_a_damaged_value_is_noticed(tmp_path):
    text = 'title = "t"\nrtol = 1e-2\n[axes]\nfriction = {start = 0.1, stop = 1, num = 300}\n'
    path = tmp_path / "small.nc"
    dataset = run(Study.from_text(text), path, solver=stand_in.smooth, workers=1)
    content = bytearray(path.read_bytes())
    damaged = 0
    for position in range(0, len(content), 97):
        changed = content.copy()
        changed[position] ^= 0xFF
        path.write_bytes(changed)
        with contextlib.suppress(ValueError):
            np.testing.assert_array_equal(open_results(path).s, dataset.s)
            continue
        damaged += 1
    assert damaged


@pytest.mark.parametrize(("name", "value"), [("status", 7), ("run", -2147483647)])
def test_a_number_that_stands_for_nothing_is_noticed(small, tmp_path, name, value):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth)
    with netCDF4.Dataset(path, "a") as file:
        file[name][:] = value
    with pytest.raises(ArchiveError, match="a status or a run that there is not"):
        run(small, path, solver=stand_in.smooth, retry_failed=True)
