"""The audit of a study."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import xarray as xr
from command import call
from folders import STUDIES
from made_up import OFF_LINE, audit_of, made_up_audit, made_up_point, report, save

from swtstudy import Study, audit_study

PARAMETER_BOX = STUDIES / "audit" / "parameter_box.toml"
STUDY = """
title = "two points"
[fixed]
tangential_amplitude = 0.1
normal_amplitude = 0.5
[axes]
poisson_ratio = [0.3, 0.5]
phase = [0.6, "0.6 + 2*pi"]
"""


@pytest.fixture
def audited(monkeypatch):
    """The points that are audited, at no cost; s_error numbers them."""
    rows = []

    def audit_point(row, **_):
        rows.append(row)
        return made_up_point(s_error=float(len(rows)))

    monkeypatch.setattr("swtstudy.paper.audit.audit_point", audit_point)
    monkeypatch.setattr("swtstudy.archive.workers.start_workers", ThreadPoolExecutor)
    return rows


def verdicts_of(audit):
    """The verdicts in words, as a file has them."""
    words = audit.verdict.attrs["flag_meanings"].split()
    return [words[int(number)] for number in audit.verdict]


def verdict_of(point):
    return verdicts_of(audit_of([point]))[0]


def places_of(audit):
    """The points of an audit, by their coordinates."""
    return list(zip(*(audit[name].values.tolist() for name in sorted(audit.coords)), strict=True))


def test_points_are_distinct(audited, tmp_path):
    found = audit_study(Study.from_text(STUDY), tmp_path / "audit.nc", points=10, seed=1, workers=1)
    assert found.sizes["sample"] == len(audited) == 2


def test_a_larger_sample_extends_a_smaller_one(audited, tmp_path):
    study, path = Study.from_toml(PARAMETER_BOX), tmp_path / "audit.nc"
    few, many = (audit_study(study, path, points=count, workers=1) for count in (5, 12))
    assert len(audited) == many.sizes["sample"] == 12
    xr.testing.assert_identical(many.isel(sample=slice(5)), few)


@pytest.mark.parametrize(
    ("changes", "verdict"),
    [
        ({}, "none"),
        ({"s_body": 1.1}, "line_search"),
        ({"s_body": 1.1, "normal_x": 0.8, "normal_y": 0.6}, "plane_through_y"),
        ({"s_body": 1.1, "body_y": 0.5}, "symmetry_line"),
        ({"s_body": 1.1, "body_y": 0.5, "body_z": 0.1}, "surface"),
        ({"s_surface": np.nan}, "not_finite"),
    ],
)
def test_verdicts(changes, verdict):
    assert verdict_of(made_up_point(**changes)) == verdict


def test_audited_points_are_read_as_they_were_written(audited, tmp_path):
    study, path = Study.from_toml(PARAMETER_BOX), tmp_path / "audit.nc"
    written = audit_study(study, path, points=6, workers=1)
    assert written.verdict.dtype == written.regime.dtype == np.int8
    xr.testing.assert_identical(audit_study(study, path, points=6, workers=1), written)
    assert len(audited) == 6
    there = xr.load_dataset(path)
    for name in written.variables:
        np.testing.assert_array_equal(there[name], written[name])


def test_an_audit_may_be_older_than_a_shape_parameter(audited, tmp_path):
    study, path = Study.from_toml(PARAMETER_BOX), tmp_path / "audit.nc"
    found = audit_study(study, path, points=3, workers=1)
    old = found.flat_half_width
    assert not old.any()
    save(found.drop_vars("flat_half_width"), path)
    xr.testing.assert_identical(audit_study(study, path, points=3, workers=1).flat_half_width, old)
    assert len(audited) == 3


def test_other_files_are_not_taken_for_an_audit(tmp_path):
    save(made_up_audit().drop_vars("s_body"), tmp_path / "other.nc")
    with pytest.raises(ValueError, match="not an audit"):
        audit_study(Study.from_text(STUDY), tmp_path / "other.nc")
    with pytest.raises(ValueError, match=r"study: found 'figure3'; allowed: a Study"):
        audit_study("figure3", tmp_path / "audit.nc")


@pytest.mark.slow
def test_a_dense_look_says_whether_a_maximum_was_overlooked(tmp_path):
    path, study = tmp_path / "audit.nc", Study.from_text(STUDY)
    assert np.isnan(audit_study(study, path, workers=1).s_dense).all()
    # Points that were not looked at densely are audited again.
    found = audit_study(study, path, workers=1, dense=True)
    np.testing.assert_allclose(found.s_dense, found.s, rtol=2.5e-5)
    assert (found.shortfall == 0.0).all()
    assert "at 2 points: at 0 of them it is higher than s by more than s_error." in report(found)


def test_what_is_overlooked_is_said():
    points = [made_up_point(s_dense=1.5), made_up_point(s_dense=1.000009), made_up_point()]
    audit = audit_of(points)
    np.testing.assert_allclose(audit.shortfall, [(0.5 - 1e-5) / 1.5, 0.0, np.nan], rtol=1e-12)
    words = report(audit)
    assert "at 2 points: at 1 of them it is higher than s by more than s_error, by up to 3.3e-01." in words
    assert "dense look" not in report(made_up_audit())


def test_a_damaged_audit_is_named(tmp_path):
    path = tmp_path / "audit.nc"
    save(made_up_audit(), path)
    content = path.read_bytes()
    assert b"paraboloid" in content
    path.write_bytes(content.replace(b"paraboloid", b"qaraboloid"))
    with pytest.raises(ValueError, match=f"^{path}: a damaged file: wrong check sum"):
        audit_study(Study.from_text(STUDY), path)


def test_report():
    text = report(made_up_audit(on_line=3, off_line=1))
    assert "| on the surface, off the line | 1 | 4.0% | 0.45 |" in text
    assert "| 0.4–0.45 | 1 | 1 | 4.00% | 0.00% |" in text
    assert "at 1 points: 1 of the 1" in text


PLANE = """
title = "plane contacts"
[profiles.pad]
geometry = "plane"
radius = [0, 0.4, 0.8, 1.2, 1.6, 2, 2.4, 2.8, 3.2]
height = [0, 0.08, 0.32, 0.72, 1.28, 2, 2.88, 3.92, 5.12]
[fixed]
flat_half_width = 0.4
bulk_stress_amplitude = 0.05
normal_force_amplitude = 0.3
tangential_force_amplitude = 0.4
[axes]
profile = ["pad", "rounded_flat"]
"""


@pytest.mark.slow
def test_command_on_plane_contacts(tmp_path):
    """In the section: the body has s on the line, by the other route, and the dense look nothing more."""
    study = tmp_path / "plane.toml"
    study.write_text(PLANE)
    given = ["audit", str(study), "--dense", "--workers", "1", "--results", str(tmp_path)]
    outcome = call(*given)
    assert outcome.exit_code == 0, outcome.output
    found = xr.load_dataset(tmp_path / "audit_plane.nc")
    assert sorted(map(str, found.profile.values)) == ["pad", "rounded_flat"]
    assert verdicts_of(found) == ["none", "none"]
    np.testing.assert_allclose(found.s_all_planes, found.s, rtol=1e-4)
    np.testing.assert_array_equal(found.s_surface, found.s)
    assert (found.s_dense <= found.s + found.s_error).all()
    assert "| rounded flat | 1 | 0 | 0.00% | 0.00% |" in outcome.output


@pytest.mark.parametrize(("excess", "verdict"), [(0.999e-3, "none"), (1.001e-3, "line_search")])
def test_an_excess_counts_from_a_thousandth(excess, verdict):
    point = made_up_point(s=2.0, s_surface=2.0, s_body=2.0 * (1.0 + excess))
    assert verdict_of(point) == verdict
    for name in ("excess", "remainder"):
        assert float(audit_of([point])[name][0]) == pytest.approx(excess)


@pytest.mark.parametrize(("size", "zero"), [(0.99e-6, True), (1.01e-6, False)])
def test_what_counts_as_on_the_line(size, zero):
    for name, at, verdict in (
        ("body_y", size, "symmetry_line"),
        ("body_y", -size, "symmetry_line"),
        ("normal_y", size, "plane_through_y"),
        ("normal_y", -size, "plane_through_y"),
        ("body_z", size, "surface"),
    ):
        point = made_up_point(s_body=1.1, **{name: at})
        assert verdict_of(point) == ("line_search" if zero else verdict)


def test_excess_over_nothing_is_all_or_nothing():
    nothing = {"s": 0.0, "s_surface": 0.0}
    audit = audit_of(
        [
            made_up_point(s_body=0.0, **nothing),
            made_up_point(s_body=1e-9, **nothing),
            made_up_point(s=2.0, s_surface=2.5, s_body=3.0),
        ]
    )
    np.testing.assert_allclose(audit.excess, [0.0, 1.0, 0.5])
    np.testing.assert_allclose(audit.remainder, [0.0, 1.0, 0.2])
    assert verdicts_of(audit)[1] == "line_search"


def test_the_report_counts_every_point():
    """Four on the line (two of them 0.05 % above s), one above s_surface too, one that is not finite."""
    audited = [
        *[made_up_point(s_all_planes=1.0 + 2e-5)] * 2,
        *[made_up_point(s_body=1.0005, s_all_planes=1.0 - 4e-5)] * 2,
        made_up_point(s_body=1.08, s_surface=1.05, regime="gross_slip", **OFF_LINE),
        made_up_point(s_surface=np.nan, s_body=np.nan, s_all_planes=np.nan, regime="not_finite"),
    ]
    lines = report(audit_of(audited, poisson_ratio=[0.0, 0.1, 0.35, 0.36, 0.5, 0.2])).splitlines()
    assert lines[0] == "# made up"
    assert lines[2].startswith("6 points, each solved")
    assert "counts from 0.1%" in lines[2]
    assert lines[6:12] == [
        "| on the surface line, where the solver found it | 4 | | |",
        "| on the surface line, elsewhere | 0 | | |",
        "| on the surface line, on a plane that is not through y | 0 | | |",
        "| on the surface, off the line | 1 | 8.0% | 0.50 |",
        "| beneath the surface | 0 | | |",
        "| not searched: s is not finite, or at the edge r = b of the truncated paraboloid | 1 | | |",
    ]
    at = lines.index("| ν | points | above s | by up to | above s_surface by up to |")
    assert lines[at + 2 : at + 6] == [
        "| 0–0.1 | 2 | 0 | 0.00% | 0.00% |",
        "| 0.3–0.35 | 1 | 0 | 0.05% | 0.05% |",
        "| 0.35–0.4 | 1 | 0 | 0.05% | 0.05% |",
        "| 0.45–0.5 | 1 | 1 | 8.00% | 2.86% |",
    ]
    assert "| paraboloid | 5 | 1 | 8.00% | 2.86% |" in lines
    assert "| gross slip | 1 | 1 | 8.00% | 2.86% |" in lines
    assert "| partial slip | 4 | 0 | 0.05% | 0.05% |" in lines
    text = "\n".join(lines)
    assert (
        "s_surface is more than 0.1% above s at 1 points: 1 of the 1 at which the body's maximum is, and 0 "
        "others. The body's maximum exceeds s_surface at 1 points, by up to 2.86%:"
    ) in text
    assert "* 2.86% (symmetry_line): profile=paraboloid" in text
    assert "differ by 2e-05 (median), 4e-05 (99 %), 4e-05 (largest)." in text


def test_two_routes_to_nothing_do_not_differ():
    nothing = made_up_point(s=0.0, s_surface=0.0, s_body=0.0, s_all_planes=0.0)
    both = audit_of([nothing, made_up_point(s_all_planes=1.0 + 2e-5)])
    assert "differ by 2e-05 (median), 2e-05 (99 %), 2e-05 (largest)." in report(both)
    assert "two routes" not in report(both.isel(sample=[0]))


def test_another_plane_at_the_same_place_is_no_other_route_to_one_value():
    both = audit_of([made_up_point(s_all_planes=1.3), made_up_point(s_all_planes=1.0 + 2e-5)])
    text = report(both)
    assert "a plane that is not through y is higher at 1 points, by up to 30.00%." in text
    assert "of the other points the solver and the field beneath the contact, two routes" in text
    assert "differ by 2e-05 (median), 2e-05 (99 %), 2e-05 (largest)." in text


def test_the_report_says_where_a_bulk_stress_makes_the_line_doubtful():
    off = {"s_body": 1.08, "s_surface": 1.05, **OFF_LINE}
    audited = [made_up_point(), made_up_point(regime="gross_slip"), *[made_up_point(**off)] * 3]
    audited.append(made_up_point(regime="gross_slip", **off))
    columns = {
        "poisson_ratio": [0.3, 0.35, 0.36, 0.3, 0.5, 0.2],
        "bulk_stress_mean": [0.0, 0.1, 0.1, -0.1, -0.1, 0.1],
        "bulk_stress_amplitude": [0.2, 0.0, 0.0, 0.1, 0.0, 0.2],
        "profile": [0, 0, 0, 0, 0, 2],
    }
    lines = report(audit_of(audited, **columns)).splitlines()
    at = lines.index("| bulk stress | points | above s | by up to | above s_surface by up to |")
    enough, off_line = "0 | 0.00% | 0.00% |", "1 | 8.00% | 2.86% |"
    assert lines[at + 2 : at + 7] == [
        f"| mean ≥ 0, ν ≤ 0.35, no truncated paraboloid that slides | 2 | {enough}",
        f"| mean ≥ 0, ν ≤ 0.35, a truncated paraboloid that slides | 1 | {off_line}",
        f"| mean ≥ 0, ν > 0.35 | 1 | {off_line}",
        f"| mean < 0, ν ≤ 0.35 | 1 | {off_line}",
        f"| mean < 0, ν > 0.35 | 1 | {off_line}",
    ]
    assert lines[at + 8].startswith(
        "With mean ≥ 0, ν ≤ 0.35, no truncated paraboloid that slides, the surface"
    )
    assert lines[at + 8].endswith("is enough at 2 of 2 points.")
    plain = report(made_up_audit())
    assert "bulk stress" not in plain
    assert "The body's maximum exceeds s_surface at 0 points.\n" in plain


def test_a_sample_has_every_point_at_most_once(audited, tmp_path):
    """A small grid gives a permutation, a large one draws; physically equal points count once."""
    text = 'title = "t"\n[axes]\nfriction = {start = 0.1, stop = 0.9, num = %d}\n'
    small = audit_study(Study.from_text(text % 9), tmp_path / "small.nc", points=9, seed=3, workers=1)
    assert sorted(small.friction.values) == pytest.approx(np.linspace(0.1, 0.9, 9))
    one, other = (
        audit_study(Study.from_text(text % 401), tmp_path / "large.nc", points=40, seed=seed, workers=1)
        for seed in (3, 4)
    )
    assert len({*places_of(one)}) == one.sizes["sample"] == 40
    assert places_of(one) != places_of(other)


@pytest.mark.slow
def test_points_of_a_sample_are_drawn_and_a_grid_without_end_is_refused(audited, tmp_path):
    sample = "[sample]\ndesign = 'sobol'\nsize = 8\nranges = { phase = [0, 6], friction = [0.1, 0.5] }\n"
    found = audit_study(Study.from_text(f'title = "t"\n{sample}'), tmp_path / "a.nc", points=4, workers=1)
    assert len({*places_of(found)}) == found.sizes["sample"] == 4
    names = ("friction", "phase", "normal_amplitude", "tangential_amplitude", "poisson_ratio")
    axes = "\n".join(f"{name} = {{ start = 0.1, stop = 0.4, num = 7000 }}" for name in names)
    study = Study.from_text(f'title = "t"\n[axes]\n{axes}\n')
    with pytest.raises(ValueError, match=r"1\d* points are too many to sample, at most 9"):
        audit_study(study, tmp_path / "b.nc", points=1, workers=1)


def test_an_audit_keeps_the_points_of_other_draws_but_not_of_other_solvers(audited, tmp_path):
    study, path = Study.from_toml(PARAMETER_BOX), tmp_path / "audit.nc"
    first = audit_study(study, path, points=5, seed=1, workers=1)
    second = audit_study(study, path, points=3, seed=2, workers=1)
    assert (first.sizes["sample"], second.sizes["sample"]) == (5, 3)
    there = xr.load_dataset(path)
    assert {*places_of(there)} == {*places_of(first), *places_of(second)}
    save(there.assign_attrs(solver_version="1"), path)
    audit_study(study, path, points=1, seed=2, workers=1)
    assert xr.load_dataset(path).sizes["sample"] == 1
