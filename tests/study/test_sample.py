import numpy as np
import pytest
import stand_in
from command import call, merged
from scipy import stats
from told import refused

from swtstudy import Study, run

DESIGNS = ("sobol", "latin_hypercube", "random", "saltelli")
HEAD = 'title = "t"\n'

SAMPLED = """
title = "A sample"
rtol = 1e-3
[sample]
design = "{design}"
size = {size}
seed = 3
[sample.ranges]
phase = [0, "2*pi"]
friction = {{ distribution = "normal", mean = 0.3, deviation = 0.1, low = 0.1, high = "1/2" }}
[axes]
profile = ["paraboloid", "rounded_punch"]
[fixed]
flat_radius = 0.5
[figure]
kind = "scatter"
x = "sample"
hue = "profile"
"""


def sampled(design="sobol", size=16):
    return Study.from_text(SAMPLED.format(design=design, size=size))


def cube(design, size, seed, dimensions):
    """The points of a design in the unit cube, shape (n, d)."""
    names = ("friction", "normal_amplitude", "tangential_amplitude")[:dimensions]
    ranges = "\n".join(f"{name} = [0, 1]" for name in names)
    text = f'{HEAD}[sample]\ndesign = "{design}"\nsize = {size}\nseed = {seed}\n[sample.ranges]\n{ranges}\n'
    samples = Study.from_text(text).grid.samples
    return np.array([samples[name] for name in names]).T


@pytest.mark.parametrize("design", DESIGNS)
def test_the_points_are_in_the_ranges_and_reproducible(design):
    grid, again = sampled(design).grid, sampled(design).grid
    assert grid == again
    n = 64 if design == "saltelli" else 16
    assert grid.dims == ("sample", "profile")
    assert grid.shape == (n, 2)
    phase, friction = (np.array(grid.samples[name]) for name in ("phase", "friction"))
    assert 0.0 <= phase.min() < 1.0 < 5.0 < phase.max() <= 2 * np.pi
    assert 0.1 <= friction.min() < 0.25 < 0.35 < friction.max() <= 0.5


@pytest.mark.parametrize("design", ["sobol", "random"])
def test_a_doubled_design_begins_with_the_points_of_the_single_one(design):
    single, doubled = sampled(design).grid.samples, sampled(design, 32).grid.samples
    for name, values in single.items():
        assert doubled[name][: len(values)] == values


def test_a_sobol_design_is_balanced():
    unit = cube("sobol", 64, 5, 3)
    for column in unit.T:
        assert sorted(np.floor(64 * column)) == list(range(64))
    assert not np.array_equal(unit, cube("sobol", 64, 6, 3))


def test_a_latin_hypercube_has_one_point_in_each_slice():
    unit = cube("latin_hypercube", 50, 0, 2)
    for column in unit.T:
        assert sorted(np.floor(50 * column)) == list(range(50))


def test_a_saltelli_design_mixes_two_samples():
    unit = cube("saltelli", 8, 1, 3).reshape(5, 8, 3)
    a, b = unit[:2]
    assert not (a == b).any()
    for i in range(3):
        for j in range(3):
            assert np.array_equal(unit[2 + i, :, j], (b if i == j else a)[:, j])


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ("[0.1, 0.7]", stats.uniform(0.1, 0.6)),
        ("{distribution='triangular', low=1, high=5, mode='4/2'}", stats.triang(0.25, 1.0, 4.0)),
        (
            "{distribution='normal', mean=2, deviation=0.5, low=1, high=3}",
            stats.truncnorm(-2.0, 2.0, 2.0, 0.5),
        ),
        ("{distribution='lognormal', median=0.3, deviation=0.2}", stats.lognorm(0.2, scale=0.3)),
    ],
)
def test_distributions_have_their_quantiles(entry, expected):
    table = f'[sample]\ndesign = "random"\nsize = 64\nseed = 7\n[sample.ranges]\nfriction = {entry}'
    drawn = Study.from_text(HEAD + table).grid.samples["friction"]
    assert drawn == pytest.approx(expected.ppf(cube("random", 64, 7, 1)[:, 0]), rel=1e-9)


def test_each_point_is_solved_with_its_own_parameters(tmp_path):
    study = sampled()
    found = run(study, tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    assert found.s.dims == ("sample", "profile")
    for name in ("phase", "friction"):
        assert found[name].dims == ("sample",)
        assert found[name].values.tolist() == list(study.grid.samples[name])
    # The stand-in's formula; a phase beyond π is that of the mirrored point.
    amplitude, tangential, ν, ratio = 0.75, 5 / 6, 0.3, 1.0
    cosine = np.cos(np.mod(found.phase, np.pi))
    plain = 0.1 + 0.01 * amplitude * cosine + found.friction + ratio + 0.1 * tangential + ν
    assert found.s.sel(profile="paraboloid").values == pytest.approx(plain.values, rel=1e-9)
    assert found.s.sel(profile="rounded_punch").values == pytest.approx(plain.values + 0.5, rel=1e-9)


def test_an_archive_is_read_back_as_it_was(tmp_path):
    study = sampled("saltelli", 4)
    found = run(study, tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    again = Study.from_text(merged(tmp_path / "a.nc").attrs["study"])
    assert (again.grid.samples, again.grid.axes) == (study.grid.samples, study.grid.axes)
    assert found.sample.attrs["design"] == "saltelli"
    assert (found.sample.attrs["size"], found.sample.attrs["seed"]) == (4, 3)
    assert run(study, tmp_path / "a.nc", workers=1, solver=stand_in.none).identical(found)


@pytest.mark.parametrize("design", ["sobol", "random", "saltelli"])
def test_a_doubled_design_computes_only_the_new_half(tmp_path, design):
    path, counting = tmp_path / "a.nc", stand_in.Counting()
    small = run(sampled(design, 16), path, workers=1, solver=counting)
    first = counting.points
    large = run(sampled(design, 32), path, workers=1, solver=counting)
    assert counting.points == 2 * first == large.s.size
    known = dict(
        zip(zip(small.phase.values, small.friction.values, strict=True), small.s.values, strict=True)
    )
    points = zip(large.phase.values.tolist(), large.friction.values.tolist(), strict=True)
    kept = [known[point] for point in points if point in known]
    assert len(kept) == small.sizes["sample"]


def test_points_from_a_file(tmp_path):
    (tmp_path / "points.csv").write_text(
        "profile, frequency_ratio, phase, flat_radius\n"
        "rounded_punch, 3/2, pi/2, 0.5\n"
        "paraboloid, 1, 0.25, 0.5\n"
        "\n"
        "rounded_punch, 1.5, 2, 0.25\n"
    )
    (tmp_path / "mine.toml").write_text(
        'title = "Mine"\nsample.file = "points.csv"\naxes.friction = [0.1, 0.2]\n'
    )
    study = Study.from_toml(tmp_path / "mine.toml")
    assert study.grid.shape == (3, 2)
    assert study.grid.samples["phase"] == (np.pi / 2, 0.25, 2.0)
    assert list(map(str, study.grid.samples["frequency_ratio"])) == ["3/2", "1", "3/2"]
    found = run(study, tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    assert found.profile.values.tolist() == ["rounded_punch", "paraboloid", "rounded_punch"]
    # What is stored does not need the file, which may change.
    (tmp_path / "points.csv").unlink()
    assert Study.from_text(found.attrs["study"]).grid == study.grid
    again = Study.from_text(merged(tmp_path / "a.nc").attrs["study"])
    assert again.grid.samples == study.grid.samples


def test_samples_of_the_same_parameters_are_merged(tmp_path):
    for size in (16, 32):
        run(sampled("random", size), tmp_path / f"{size}.nc", workers=1, solver=stand_in.smooth)
    both = merged(tmp_path / "16.nc", tmp_path / "32.nc")
    assert both.s.shape == (32, 2)
    assert (both.status == 0).all()


def test_results_of_a_sample_are_sliced_listed_and_searched(tmp_path):
    study = Study.from_text(
        'title = "t"\n[sample.points]\nphase = [0, 1, 2, 1]\nfriction = [0.1, 0.2, 0.3, 0.4]\n'
        "[axes]\nnormal_amplitude = [0.25, 0.5]\n"
    )
    found = run(study, tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    assert found.swt.slice(phase=1).friction.values.tolist() == [0.2, 0.4]
    assert found.swt.slice(phase=[0, 2], normal_amplitude=0.5).friction.values.tolist() == [0.1, 0.3]
    refused("friction: found 0.25, which is not in these results", found.swt.slice, friction=0.25)
    table = found.swt.to_table()
    assert len(table) == 8
    assert table.friction.tolist() == [0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.4, 0.4]
    assert table.phase[2] == 1.0
    extrema = found.swt.extrema("sample")
    assert extrema.at_maximum.values.tolist() == [3, 3]
    assert extrema.at_minimum.values.tolist() == [0, 0]
    html = study._repr_html_()
    assert "<b>friction</b>" in html
    assert "sampled" in html


def test_shapes_are_checked_row_by_row():
    # This waviness has a full disc up to the depth δ0, not up to 1.9 δ0.
    rows = (
        'title = "t"\nfixed.profile = "wavy_paraboloid"\n[sample.points]\nwavelength = [3.52, 5]\n'
        "waviness_amplitude = [5, 0.02]\nnormal_amplitude = {}\n"
    )
    assert Study.from_text(rows.format([0, 0.9])).grid.size == 2
    words = "sample.waviness_amplitude, sample.wavelength: found .* = 3.52"
    assert "more like it" not in str(refused(words, Study.from_text, rows.format([0.9, 0])))


def test_forces_may_be_sampled():
    text = f"{HEAD}[sample]\ndesign='sobol'\nsize=4\n[sample.ranges]\nnormal_force_amplitude=[0.1, 0.5]\n"
    grid = Study.from_text(text).grid
    assert grid.control.normal_force
    assert "normal_amplitude" not in grid.fixed


def test_the_sample_of_the_template_is_a_study(tmp_path):
    assert call("new", tmp_path / "mine").exit_code == 0
    text = (tmp_path / "mine.toml").read_text()
    begin = text.index("# [sample]")
    sample = "\n".join(
        line.removeprefix("# ") for line in text[begin : text.index("\n\n", begin)].splitlines()
    )
    study = Study.from_text('title = "A sample"\n' + sample + '\n[figure]\nkind = "scatter"\nx = "sample"\n')
    assert study.grid.shape == (256,)
    assert min(study.grid.samples["friction"]) >= 0.1
    assert all(name in text for name in DESIGNS)


RIG_POINTS = """title = "points"
units = { length = "mm", force = "N", stress = "MPa" }
[fixed]
young_modulus = 73e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
normal_force_amplitude = 0
[sample]
file = "points.csv"
columns = { normal_force = "P", tangential_force_amplitude = "Q" }
"""


@pytest.mark.filterwarnings("ignore:.*read as units")
def test_points_of_a_file_may_be_scaled(tmp_path):
    (tmp_path / "points.csv").write_text("P,Q\nkN,kN\n0.2,0.05\n0.3,0.06")
    scale = "scale = { normal_force = 1000, tangential_force_amplitude = 1000 }\n"
    (tmp_path / "mine.toml").write_text(RIG_POINTS + scale)
    assert Study.from_toml(tmp_path / "mine.toml").grid.samples["normal_force"] == (200.0, 300.0)


@pytest.mark.parametrize(
    ("header", "rows", "words"),
    [
        ("phase [deg]", "2\n5\n", r"'phase \[deg\]' in deg as phase, while angles are in rad"),
        ("phase (°)", "2\n5\n", "in ° as phase, while angles are in rad .* scale = { phase = 0.0174533 }"),
        ("phase", "1,0.2\n2,\n,0.3\n", r"a cell without a value; 1 more like it \(line 3\)"),
    ],
)
def test_angles_in_degrees_and_cells_without_a_value_are_told(tmp_path, header, rows, words):
    (tmp_path / "points.csv").write_text(f"{header}{',friction' * (',' in rows)}\n{rows}")
    study = f'{HEAD}[sample]\nfile = "points.csv"\ncolumns = {{ phase = "{header}" }}\n'
    (tmp_path / "study.toml").write_text(study)
    refused(words, Study.from_toml, tmp_path / "study.toml")
