import itertools
import re
import struct
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import stand_in
import xarray as xr
from click.testing import CliRunner

import swtstudy
from swtstudy import Study, StudyError, open_results, run
from swtstudy.archive.files import check_writable, replacing, save
from swtstudy.archive.lock import LockedError
from swtstudy.archive.merge import merge
from swtstudy.archive.read import ArchiveError
from swtstudy.cli import main
from swtstudy.mechanics.points import Points, Solution
from swtstudy.parameters import PARAMETERS
from swtstudy.records.records import FAILED, MISSING


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


#: What stands beside the numbers of an archive, and makes sense of them.
UNITS = {
    "s": "1",
    "s_error": "1",
    "s_surface": "1",
    "critical_x": "1",
    "critical_angle": "degree",
    "run": "1",
    "phase": "rad",
    "normal_amplitude": "1",
    "frequency_ratio": "1",
    "friction": "1",
}


def test_what_is_written_says_what_the_numbers_mean(small, tmp_path):
    run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    with netCDF4.Dataset(tmp_path / "small.nc") as file:
        assert {name: file[name].units for name in UNITS} == UNITS
        regime, status = file["regime"], file["status"]
        assert regime.flag_meanings == "stick partial_slip gross_slip lift_off not_finite"
        assert list(regime.flag_values) == [0, 1, 2, 3, 4]
        assert status.flag_meanings == "computed failed missing"
        assert list(status.flag_values) == [0, 1, 2]
        assert status.failures == "[]"
        assert file["s"].ancillary_variables == "s_error regime s_surface status run"
        assert file["frequency_ratio"].fractions == "1"
        assert file["normal_amplitude"].symbol == r"\delta_A/\delta_0"
        assert "in units of a_H" in file["critical_x"].long_name
        assert "against the x axis" in file["critical_angle"].long_name


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
    ("stem", "words"),
    [
        ("back\\slash", "found a backslash"),
        ("no\udcffutf8", "found bytes that are no UTF-8"),
        ("n" * 242, "found a name of 245 bytes; allowed: at most 244"),
        ("ν" * 121, "found a name of 245 bytes; allowed: at most 244"),
        ("null\0", "found a null character"),
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
    Path("good.nc").write_bytes((Path(__file__).parent / "data" / "without_check_sums.nc").read_bytes())
    before = sorted(tmp_path.iterdir())
    for arguments in (
        ["validate", f"{stem}.toml"],
        ["plan", f"{stem}.toml"],
        ["run", f"{stem}.toml"],
        ["audit", f"{stem}.toml"],
        ["merge", "good.nc", "-o", f"{stem}.nc"],
    ):
        result = CliRunner().invoke(main, arguments)
        assert result.exit_code == 2
        (line,) = result.stderr.splitlines()
        assert words.split(" of ")[0] in line
    assert sorted(tmp_path.iterdir()) == before


def test_the_longest_name_leaves_archive_and_figure(small_text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    stem = "n" * 241
    Path(f"{stem}.toml").write_text(small_text)
    monkeypatch.setattr("swtstudy.mechanics.solve_points", stand_in.smooth)
    result = CliRunner().invoke(main, ["run", f"{stem}.toml"])
    assert result.exit_code == 0, result.output
    assert {path.name for path in Path("results").iterdir()} == {f"{stem}.nc", f"{stem}.png"}


def test_a_file_in_place_of_the_results_is_found_out_by_plan(small_text, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("small.toml").write_text(small_text)
    Path("results").write_text("")
    result = CliRunner().invoke(main, ["plan", "small.toml", "--results", "results/deeper"])
    assert result.exit_code == 2
    assert "which is a file; allowed: a folder for archives" in result.stderr


@pytest.mark.parametrize(
    "content", [b"", b"CDF", b"not a netCDF file at all", b"\x89HDF\r\n\x1a\n" + bytes(90)]
)
def test_other_files_are_refused(tmp_path, content):
    path = tmp_path / "other.nc"
    path.write_bytes(content)
    with pytest.raises(ValueError, match="not a readable netCDF archive"):
        open_results(path)


def test_an_archive_that_someone_writes_is_called_locked(small, small_text, tmp_path):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth)
    (tmp_path / "small.toml").write_text(small_text)
    code = f"import netCDF4; file = netCDF4.Dataset({str(path)!r}, 'a'); print('open', flush=True); input()"
    with subprocess.Popen(
        [sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as writer:
        assert writer.stdout.readline() == b"open\n"
        with pytest.raises(LockedError, match=f"^{path} is locked: another program has it open for writing$"):
            open_results(path)
        for arguments in (["info", path], ["run", tmp_path / "small.toml", "--results", tmp_path]):
            result = CliRunner().invoke(main, [*map(str, arguments)])
            assert result.exit_code == 2
            assert result.stderr == f"Error: {path} is locked: another program has it open for writing\n"
        writer.communicate(b"\n")
    assert open_results(path).s.shape == small.grid.shape


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
        assert isinstance(value, str) or re.search(rf"damaged file: {name}\w* not", str(caught.value))


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
            damaged.update(re.findall(r"damaged file: (\w+) not", str(error)))
    assert damaged
    assert damaged <= {*dataset.data_vars, "friction"}


def test_an_archive_without_check_sums_opens_as_ever(tmp_path):
    path = Path(__file__).parent / "data" / "without_check_sums.nc"
    dataset = open_results(path)
    assert dataset.s.dims == ("profile", "phase")
    np.testing.assert_array_equal(dataset.phase, [0.0, np.pi / 2])
    np.testing.assert_allclose(dataset.s, [[0.155137, 0.151461], [0.122635, 0.118161]], atol=1e-6)
    assert dataset.run.attrs["long_name"].startswith("run that made the value")
    xr.testing.assert_equal(merge([path]), dataset)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("status", 7, "status: found 7 at normal_amplitude=0.25, phase=0.0 and 17 more; allowed: 0 to 2"),
        ("run", -2147483647, "run: found -2147483647 at .*; allowed: -1 to 0"),
        ("run", 1, "run: found 1 at .*; allowed: -1 to 0"),
        ("regime", 5, "regime: found 5 at .*; allowed: 0 to 4"),
        ("regime", -1, "regime: found -1 at"),
        ("s", np.nan, "s: found nan at .*; allowed: a finite number, 0 or more"),
        ("s", np.inf, "s: found inf at .*; allowed: a finite number, 0 or more"),
        ("s", -1e-9, "s: found -1e-09 at .*; allowed: a finite number, 0 or more"),
        ("s_error", -1e-9, "s_error: found -1e-09 at .*; allowed: 0 or more"),
        ("phase", np.nan, r"phase: found nan \(not a finite number\); allowed: a finite angle"),
        ("friction", -1.0, r"friction: found -1.0 \(out of range\); allowed: a number in"),
    ],
)
def test_a_value_that_stands_for_nothing_is_noticed(small, tmp_path, name, value, words):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth)
    dataset = open_results(path)
    dataset[name] = (dataset[name].dims, np.full_like(dataset[name].values, value), dataset[name].attrs)
    save(dataset, path)
    with pytest.raises(ArchiveError, match=f"small.nc: {words}.*; move it away"):
        run(small, path, solver=stand_in.smooth, retry_failed=True)
    with pytest.raises(ArchiveError, match=f"small.nc: {words}"):
        open_results(path)


def test_s_need_not_be_finite_where_it_is_not_computed_or_the_regime_says_so(small, tmp_path):
    path = tmp_path / "small.nc"
    dataset = run(small, path, solver=stand_in.smooth)
    dataset.s[0, 0], dataset.status[0, 0] = np.nan, FAILED
    dataset.s[0, 1], dataset.status[0, 1], dataset.run[0, 1] = np.nan, MISSING, -1
    dataset.s[0, 2], dataset.regime[0, 2] = np.nan, 4
    dataset.s[0, 3], dataset.regime[0, 3] = np.inf, 4
    dataset.s[0, 4] = 0.0
    save(dataset, path)
    assert np.isfinite(open_results(path).s).sum() == 14


DEEP = "[" * 100_000 + "]" * 100_000
RUN = '{"solver_version": "3", "rtol": "1e-3", "study": "", "versions": ""}'
BAD_ATTRIBUTES = [
    ("figure", 3, "attribute figure: found 3"),
    ("figure", "[1]", r"attribute figure: found '\[1\]' \(no table\)"),
    ("figure", '{"x": null}', "attribute figure: found '{\"x\": null}'"),
    ("figure", '{"x": null, "y": ["s"]}', "attribute figure"),
    ("figure", '{"x": "phase", "y": ["t"]}', "attribute figure: .*not a quantity"),
    ("figure", '{"x": "phase", "y": [], "kind": "lines"}', "attribute figure: .*y: found an empty list"),
    ("figure", '{"x": "phase", "y": ["s"], "kind": ["lines"]}', "attribute figure"),
    ("history", None, r"not an archive of swtstudy \(no history\)"),
    ("history", 3, "attribute history: found 3; allowed: a text"),
    ("title", [1, 2], "attribute title: found"),
    ("source", None, r"\(no source\)"),
    ("study", 1.5, "attribute study: found 1.5"),
    ("versions", 1.5, "attribute versions: found 1.5"),
    ("rtol", "tight", "attribute rtol: found 'tight'; allowed: a number in"),
    ("rtol", 0.5, "attribute rtol: found 0.5; allowed: a number in"),
    ("wall_time_seconds", "long", "attribute wall_time_seconds: found 'long'"),
    ("runs", "{}", "attribute runs: .*no list"),
    ("runs", DEEP, "attribute runs: .*nested too deeply"),
    ("runs", "[1]", "attribute runs: .*no run: 1"),
    ("runs", "no", "attribute runs: .*no JSON"),
    ("runs", f"[{RUN}]", "attribute runs: .*rtol of a run: '1e-3'"),
    ("runs", '[{"rtol": 1e-3}]', "attribute runs: .*solver_version of a run: nothing"),
    ("status failures", "[3]", "attribute failures of status: .*no failure: 3"),
    ("status failures", '[{"row": [[]], "point": "", "message": ""}]', "attribute failures of status"),
    ("status failures", DEEP, "attribute failures of status: .*nested too deeply"),
    ("status failures", None, r"\(no attribute failures of status\)"),
    ("regime flag_meanings", "slip stick", "attribute flag_meanings of regime: found 'slip stick'"),
    ("critical_angle units", "rad", "attribute units of critical_angle: found 'rad'; allowed: 'degree'"),
    ("phase units", "degree", "attribute units of phase: found 'degree'; allowed: 'rad'"),
]


@pytest.mark.parametrize(("name", "value", "words"), BAD_ATTRIBUTES, ids=lambda value: str(value)[:25])
def test_an_attribute_that_is_none_is_named_wherever_an_archive_is_read(
    small, small_text, tmp_path, name, value, words
):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth)
    dataset = open_results(path)
    owner, _, attribute = name.rpartition(" ")
    attributes = dataset[owner].attrs if owner else dataset.attrs
    attributes.pop(attribute, None)
    if value is not None:
        attributes[attribute] = value
    dataset.to_netcdf(path)
    with pytest.raises(ArchiveError, match=f"^{path}: .*{words}"):
        open_results(path)
    (tmp_path / "small.toml").write_text(small_text)
    for arguments in (
        ["info", path],
        ["plot", path],
        ["merge", path, "-o", tmp_path / "merged.nc"],
        ["run", tmp_path / "small.toml", "--results", tmp_path],
        ["plan", tmp_path / "small.toml", "--results", tmp_path],
    ):
        result = CliRunner().invoke(main, [*map(str, arguments)])
        assert result.exit_code == 2
        (line,) = result.stderr.splitlines()
        assert re.search(f"^Error: {path}: .*{words}", line), line


def test_coordinates_are_those_of_a_study(small, tmp_path):
    path = tmp_path / "small.nc"
    dataset = run(small, path, solver=stand_in.smooth)
    for changed, words in (
        (dataset.drop_vars("phase"), "phase: found a dimension without values of a parameter"),
        (dataset.drop_vars("friction"), r"friction: found nothing; allowed: a number in \[0, 10\]"),
        (dataset.expand_dims("sample"), "sample: found a dimension without values"),
        (dataset.assign_coords(profile="rounded_punch"), "flat_radius: found nothing"),
        (dataset.assign_coords(profile="qaraboloid"), r"profile: found 'qaraboloid' \(no such profile\)"),
        (dataset.assign(run=dataset.run[0]), r"run: found dimensions \('phase',\)"),
        (dataset.assign(regime=dataset.regime.astype(str)), "regime: found values of type"),
    ):
        changed.to_netcdf(path)
        with pytest.raises(ArchiveError, match=f"^{path}: {words}"):
            open_results(path)


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
