"""Mistakes in an archive are named wherever it is read."""

import re

import numpy as np
import pytest
import stand_in
from command import call
from solved import FAILED, MISSING

from swtstudy import open_results, run


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("status", 7, "status: found 7 at normal_amplitude=0.25, phase=0.0 and 17 more; allowed: 0 to 2"),
        ("run", -2147483647, "run: found -2147483647 at .*; allowed: -1 to 0"),
        ("run", 1, "run: found 1 at .*; allowed: -1 to 0"),
        ("regime", 6, "regime: found 6 at .*; allowed: 0 to 5"),
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
    dataset.to_netcdf(path)
    with pytest.raises(ValueError, match=f"small.nc: {words}.*; move it away"):
        run(small, path, solver=stand_in.smooth, retry_failed=True)
    with pytest.raises(ValueError, match=f"small.nc: {words}"):
        open_results(path)


def test_s_need_not_be_finite_where_it_is_not_computed_or_the_regime_says_so(small, tmp_path):
    path = tmp_path / "small.nc"
    dataset = run(small, path, solver=stand_in.smooth)
    dataset.s[0, 0], dataset.status[0, 0] = np.nan, FAILED
    dataset.s[0, 1], dataset.status[0, 1], dataset.run[0, 1] = np.nan, MISSING, -1
    dataset.s[0, 2], dataset.regime[0, 2] = np.nan, 4
    dataset.s[0, 3], dataset.regime[0, 3] = np.inf, 4
    dataset.s[0, 4] = 0.0
    dataset.s[0, 5], dataset.regime[0, 5] = 0.0, 5
    dataset.to_netcdf(path)
    assert np.isfinite(open_results(path).s).sum() == 14


DEEP = "[" * 100_000 + "]" * 100_000
RUN = '{"solver_version": "3", "rtol": "1e-3", "study": "", "versions": ""}'
BAD_ATTRIBUTES = [
    ("figure", 3, "attribute figure: found 3"),
    ("figure", "[1]", r"attribute figure: found '\[1\]' \(Input should be an object\)"),
    ("figure", '{"x": null}', "attribute figure: found '{\"x\": null}'"),
    ("figure", '{"x": null, "y": ["s"]}', "attribute figure"),
    ("figure", '{"x": "phase", "y": ["s/t"]}', "attribute figure: .*not a quantity"),
    ("figure", '{"x": "phase", "y": [], "kind": "lines"}', r"attribute figure: .*\(y: found an empty list"),
    ("figure", '{"x": "phase", "y": ["s"], "kind": ["lines"]}', "attribute figure"),
    ("history", None, r"changed by another program \(no history\)"),
    ("history", 3, "attribute history: found 3; allowed: a text"),
    ("title", [1, 2], "attribute title: found"),
    ("source", None, r"\(no source\)"),
    ("study", 1.5, "attribute study: found 1.5"),
    ("versions", 1.5, "attribute versions: found 1.5"),
    ("rtol", "tight", "attribute rtol: found 'tight'; allowed: a number in"),
    ("rtol", 0.5, "attribute rtol: found 0.5; allowed: a number in"),
    ("wall_time_seconds", "long", "attribute wall_time_seconds: found 'long'"),
    ("runs", "{}", "attribute runs: .*should be a valid array"),
    ("runs", DEEP, "attribute runs: .*recursion limit exceeded"),
    ("runs", "[1]", r"attribute runs: .*\(0: Input should be an object\)"),
    ("runs", "no", "attribute runs: .*Invalid JSON"),
    ("runs", f"[{RUN}]", "attribute runs: .*0: rtol: Input should be a valid number"),
    ("runs", '[{"rtol": 1e-3}]', "attribute runs: .*0: solver_version: Field required"),
    ("regime flag_meanings", "slip stick", "attribute flag_meanings of regime: found 'slip stick'"),
    ("critical_angle units", "rad", "attribute units of critical_angle: found 'rad'; allowed: 'degree'"),
    ("phase units", "degree", "attribute units of phase: found 'degree'; allowed: 'rad'"),
]


@pytest.mark.quick(4)
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
    with pytest.raises(ValueError, match=f"^{path}: .*{words}"):
        open_results(path)
    (tmp_path / "small.toml").write_text(small_text)
    for arguments in (
        ["info", path],
        ["plot", path],
        ["merge", path, "-o", tmp_path / "merged.nc"],
        ["run", tmp_path / "small.toml", "--results", tmp_path],
        ["plan", tmp_path / "small.toml", "--results", tmp_path],
    ):
        result = call(*arguments)
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
        (dataset.assign(s=dataset.s[0]), rf"status: found .*\n{path}: run: found dimensions"),
        (dataset.assign(regime=dataset.regime.astype(str)), "regime: found values of type"),
    ):
        changed.to_netcdf(path)
        with pytest.raises(ValueError, match=f"^{path}: {words}"):
            open_results(path)
