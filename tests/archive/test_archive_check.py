"""Mistakes in an archive are named wherever it is read."""

import numpy as np
import stand_in
from command import call
from solved import FAILED, MISSING

from swtstudy import open_results, run


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


def test_a_mistake_is_named_wherever_an_archive_is_read(small, small_text, tmp_path):
    path = tmp_path / "small.nc"
    run(small, path, solver=stand_in.smooth).assign_attrs(history=3).to_netcdf(path)
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
        assert result.stderr.startswith(f"Error: {path}: attribute history: found 3; allowed: a text")
        assert len(result.stderr.splitlines()) == 1
