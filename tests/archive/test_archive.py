import itertools
import subprocess
import sys
from fractions import Fraction

import netCDF4
import numpy as np
import pytest
import stand_in
import xarray as xr
from stand_in import Points, Solution

import swtstudy
from swtstudy import Study, open_results, run


def test_a_round_trip_keeps_values_and_names(small, tmp_path):
    dataset = run(small, tmp_path / "deep" / "small.nc", solver=stand_in.smooth)
    again = open_results(tmp_path / "deep" / "small.nc")
    xr.testing.assert_identical(dataset, again)
    assert again.s.dims == small.grid.dims
    assert np.isfinite(again.s).all()


def test_every_number_of_the_solver_comes_back_from_the_file(tmp_path):
    text = (
        'title = "t"\nrtol = 1e-3\n[fixed]\npoisson_ratio = 0.2\n[axes]\nfriction = [0.7, 0.1]\n'
        'frequency_ratio = ["3/2", "1/2"]\nphase = [0.3, 0.1]\n'
    )
    run(Study.from_text(text), tmp_path / "t.nc", solver=told_apart, workers=1)
    found = open_results(tmp_path / "t.nc")
    assert found.s.dims == ("friction", "frequency_ratio", "phase")
    assert found.friction.values.tolist() == [0.7, 0.1]
    assert found.frequency_ratio.values.tolist() == [1.5, 0.5]
    assert found.phase.values.tolist() == [0.3, 0.1]
    assert found.poisson_ratio.item() == 0.2
    for (i, friction), (j, ratio), (k, phase) in itertools.product(
        enumerate([0.7, 0.1]), enumerate([Fraction(3, 2), Fraction(1, 2)]), enumerate([0.3, 0.1])
    ):
        point = found.isel(friction=i, frequency_ratio=j, phase=k)
        number = friction + 10 * ratio.numerator + 100 * ratio.denominator + phase
        assert point.s.item() == pytest.approx(number, rel=1e-10)
        assert point.s_error.item() == pytest.approx(1e-3 * number, rel=1e-10)
        assert point.s_surface.item() == pytest.approx(1.5 * number, rel=1e-10)
        assert point.critical_x.item() == pytest.approx(-number, rel=1e-10)
        assert point.critical_angle.item() == pytest.approx(-80 * phase, rel=1e-10)
        assert point.regime.item() == ratio.denominator
        assert (point.status.item(), point.run.item()) == (0, 0)


def told_apart(points: Points, rtol: float) -> Solution:
    """Numbers that are different for every point and every variable."""
    number = points.friction + 10 * points.p + 100 * points.q + points.phase
    regime = points.q.astype(np.int8)
    return Solution(number, rtol * number, -number, -80 * points.phase, regime, 1.5 * number)


@pytest.mark.slow
def test_an_archive_opens_while_xarray_has_it_open(small, tmp_path):
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    code = (
        "import sys, xarray as xr, swtstudy\nlazy = xr.open_dataset(sys.argv[1])\n"
        "print([swtstudy.open_results(sys.argv[1]).identical(lazy.load()) for _ in range(3)])"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "small.nc")]
    # In a process of its own: reading the file twice, beside xarray, crashes.
    assert subprocess.run(command, capture_output=True, text=True).stdout == "[True, True, True]\n"


def test_provenance(small, tmp_path):
    attributes = run(small, tmp_path / "small.nc", solver=stand_in.smooth).attrs
    assert attributes["study"] == small.text
    assert attributes["title"] == small.title
    assert attributes["rtol"] == small.rtol
    assert attributes["Conventions"].startswith("CF-1.")
    assert f"swtstudy {swtstudy.__version__}" in attributes["history"]
    versions = dict(each.split(" ") for each in attributes["versions"].split(", "))
    assert list(versions) == ["python", "swtstudy", "numpy", "scipy", "xarray", "netCDF4", "dask"]
    for package in (swtstudy, np, xr, netCDF4):
        assert versions[package.__name__] == package.__version__
    assert attributes["wall_time_seconds"] > 0


def test_a_failed_write_leaves_the_old_file(small, tmp_path, monkeypatch):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth)
    before = path.read_bytes()

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(xr.Dataset, "dump_to_store", fail)
    with pytest.raises(OSError, match="No space left on device"):
        run(Study.from_text(f"{small.text}\n# changed"), path, solver=None)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_an_unwritable_folder_is_found_out_before(small, tmp_path):
    (tmp_path / "results").write_text("a file, not a folder")

    def never(points, rtol):
        raise AssertionError("computed")

    with pytest.raises(OSError, match=r"cannot write small\.nc into"):
        run(small, tmp_path / "results" / "small.nc", solver=never)
    with pytest.raises(OSError, match="is a folder"):
        run(small, tmp_path, solver=never)


def holding(content):
    return lambda path, _: path.write_bytes(content)


def without(name):
    return lambda path, dataset: dataset.drop_vars(name).to_netcdf(path)


@pytest.mark.parametrize(
    ("replace", "words"),
    [
        (holding(b""), "not a readable netCDF archive"),
        (holding(b"CDF"), "not a readable netCDF archive"),
        (holding(b"not a netCDF file at all"), "not a readable netCDF archive"),
        (holding(b"\x89HDF\r\n\x1a\n" + bytes(90)), "not a readable netCDF archive"),
        (lambda path, _: xr.Dataset({"t": ("x", [1.0])}).to_netcdf(path), "not an archive of swtstudy"),
        (without("s_surface"), "s_surface: found nothing; allowed: .*"),
    ],
)
def test_what_is_no_archive_is_refused_and_not_replaced(small, tmp_path, replace, words):
    path = tmp_path / "small.nc"
    replace(path, run(small, path, solver=stand_in.smooth))
    content = path.read_bytes()
    with pytest.raises(ValueError, match=rf"^{path}: .*{words}"):
        open_results(path)
    with pytest.raises(ValueError, match=rf"^{path}: .*{words}.*; move it away to start anew"):
        run(small, path, solver=stand_in.smooth)
    assert path.read_bytes() == content


def test_an_archive_that_is_not_there_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match="no such archive"):
        open_results(tmp_path / "absent.nc")


def test_an_archive_is_read_while_another_program_has_it_open_for_writing(small, tmp_path):
    """What is in the file is what its check sum says, or refused."""
    path = tmp_path / "small.nc"
    found = run(small, path, solver=stand_in.smooth)
    code = f"import netCDF4; file = netCDF4.Dataset({str(path)!r}, 'a'); print('open', flush=True); input()"
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as writer:
        assert writer.stdout.readline() == b"open\n"
        assert open_results(path).identical(found)
        writer.communicate(b"\n")
    assert open_results(path).identical(found)


def test_coordinates_have_no_fill_value(small, tmp_path):
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    with netCDF4.Dataset(tmp_path / "small.nc") as file:
        for name in ("phase", "normal_amplitude", "friction"):
            assert "_FillValue" not in file[name].ncattrs()
        assert file["s"].filters()["zlib"]
        assert file["s"].filters()["fletcher32"]
