import math
import re
import subprocess
import sys
from fractions import Fraction

import pytest
import stand_in
from command import call, merged
from told import refused, warned

from swtstudy import Study, run

MINIMAL = 'title = "t"\n'


def mistakes_of(text: str) -> dict[str, str]:
    mistakes = refused("", Study.from_text, text, "study.toml").mistakes
    assert all(str(mistake).startswith("study.toml: ") for mistake in mistakes)
    return {mistake.key: f"{mistake.found}; {mistake.allowed}" for mistake in mistakes}


def test_defaults_are_table_1():
    study = Study.from_text(MINIMAL)
    assert study.grid.fixed == {
        "poisson_ratio": 0.3,
        "friction": 0.3,
        "normal_amplitude": 0.75,
        "frequency_ratio": Fraction(1),
        "tangential_amplitude": 5 / 6,
        "phase": 0.0,
        "bulk_stress_amplitude": 0.0,
        "bulk_stress_mean": 0.0,
        "bulk_stress_phase": 0.0,
        "bulk_strain_share": 1.0,
        "stick_zone_shift": "moved",
        "walker_exponent": 0.5,
        "normal_sensitivity": 0.0,
        "criterion": "swt",
        "profile": "paraboloid",
        "load": "harmonic",
    }
    assert study.grid.axes == {}
    assert study.grid.size == 1
    assert study.rtol == 1e-4


def test_axes_keep_their_order_and_exact_values(small):
    assert small.grid.dims == ("normal_amplitude", "phase")
    assert small.grid.axes["normal_amplitude"] == (0.25, 8 / 9)
    assert small.grid.axes["phase"] == pytest.approx([i * math.pi / 4 for i in range(9)], rel=1e-15)


def test_a_range_with_rational_ends_has_the_nearest_floats():
    study = Study.from_text(MINIMAL + "[axes]\nfriction = {start = 0, stop = 1, num = 11}")
    assert study.grid.axes["friction"] == tuple(i / 10 for i in range(11))


@pytest.mark.parametrize(("start", "stop", "sense"), [(0, 1, 1), (1, 0, -1)])
def test_values_beside_a_range_are_put_in_their_places(start, stop, sense):
    axis = f'friction = {{start = {start}, stop = {stop}, num = 3, also = ["1/3", 0.75, 1.5]}}'
    values = Study.from_text(MINIMAL + "[axes]\n" + axis).grid.axes["friction"]
    assert values == (0.0, 1 / 3, 0.5, 0.75, 1.0, 1.5)[::sense]


def test_ratios_are_exact():
    axis = 'frequency_ratio = ["1/4", 0.5, 1, "1.5", 2.0, 0.3333333333333333, 64, "1/64"]'
    study = Study.from_text(MINIMAL + "[axes]\n" + axis)
    ratios = (1, 4), (1, 2), (1, 1), (3, 2), (2, 1), (1, 3), (64, 1), (1, 64)
    expected = tuple(Fraction(*each) for each in ratios)
    assert study.grid.axes["frequency_ratio"] == expected


@pytest.mark.parametrize(
    ("axis", "key", "found"),
    [
        ("phase = [0, 1, 0.0]", "axes.phase[2]", "the same as axes.phase[0]"),
        ('friction = [0.30000000000000004, "3/10"]', "axes.friction[1]", "the same as"),
        ('frequency_ratio = [0.5, "1/2"]', "axes.frequency_ratio[1]", "the same as"),
        ("phase = [0, nan]", "axes.phase[1]", "not a finite number"),
        ("phase = {start = 0, stop = inf, num = 2}", "axes.phase.stop", "not a finite number"),
        ("phase = {start = 0, stop = 0x" + 4000 * "f" + ", num = 2}", "axes.phase.stop", "too many digits"),
        ("phase = {start = 0, stop = 1, num = 0x" + 4000 * "f" + "}", "axes.phase.num", "too many digits"),
        ("phase = {start = 0, stop = 1, num = 2.5}", "axes.phase.num", "a whole number"),
        ("phase = {start = 0, stop = 1, num = 3, step = 1}", "axes.phase.step", "did you mean stop?"),
        ("phase = {start = 0, stop = 1, num = 3, also = [0.2, 1e9]}", "axes.phase.also[1]", "out of range"),
    ],
)
def test_a_bad_axis_is_named(axis, key, found):
    mistakes = mistakes_of(MINIMAL + "[axes]\n" + axis)
    assert list(mistakes) == [key]
    assert found in mistakes[key]


@pytest.mark.parametrize(("text", "key"), [("", "title"), (MINIMAL + "rtol = nan", "rtol")])
def test_a_bad_structure_is_named(text, key):
    assert list(mistakes_of(text)) == [key]


WAVY = 'title = "t"\n[fixed]\nprofile = "wavy_paraboloid"\n[axes]\n'


@pytest.mark.parametrize("wavelength", ["5e-324", "1e-300"])
@pytest.mark.parametrize("amplitude", ["5e-324", "0.01"])
def test_waves_too_short_for_a_float_are_refused_without_a_warning(amplitude, wavelength):
    mistakes = mistakes_of(WAVY + f"waviness_amplitude = [{amplitude}]\nwavelength = [{wavelength}]")
    assert "is below 3.52" in next(iter(mistakes.values()))


FIGURE = '[axes]\nphase = [0, 1]\nfriction = [0.1, 0.3]\n[figure]\nx = "phase"\nhue = "friction"\n'


@pytest.mark.parametrize(
    "figure",
    [
        FIGURE + 'y = ["s", "s/s(phase=0)"]\ntitle = \'a "title"\'\nregimes = true',
        FIGURE.replace("hue", "vertical") + 'kind = "contour"',
    ],
)
def test_a_written_study_is_the_same_study(figure, tmp_path):
    study = Study.from_text('title = "t"\nrtol = 1e-3\n' + figure)
    run(study, tmp_path / "t.nc", workers=1, solver=stand_in.smooth)
    again = Study.from_text(merged(tmp_path / "t.nc").attrs["study"])
    assert (again.title, again.rtol, again.grid, again.figure) == ("t", 1e-3, study.grid, study.figure)


def test_every_data_variable_is_accepted():
    names = ("s", "s_error", "critical_x", "critical_angle", "regime", "status", "run", "s_surface")
    study = Study.from_text(MINIMAL + FIGURE + f"y = {[*names]}")
    assert study.figure is not None
    assert study.figure.y == names


@pytest.mark.parametrize("title", ["costs $5", r"$\frac{\mu}{2}$ of 5 \$", "$a$ and $b$", "plain"])
def test_titles_that_can_be_drawn_are_accepted(title):
    study = Study.from_text(MINIMAL + FIGURE + f"title = '{title}'")
    assert study.figure is not None
    assert study.figure.title == title


@pytest.mark.slow
def test_titles_are_checked_without_pyplot():
    code = f"""
import sys
from swtstudy import Study
text = {MINIMAL + FIGURE!r}
for title, imported in (("plain", set()), ("$x$", {{"matplotlib.mathtext"}})):
    Study.from_text(f"{{text}}title = {{title!r}}")
    assert set(sys.modules) & {{"matplotlib.mathtext", "matplotlib.pyplot", "xarray"}} == imported
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_normalised_quantities_are_accepted():
    study = Study.from_text(MINIMAL + FIGURE + 'y = ["s", "s/s(friction=1/10)", "s / s(phase = 0)"]')
    assert study.figure is not None
    assert len(study.figure.y) == 3


def test_the_place_of_a_normalised_quantity_is_found_as_in_a_slice():
    assert Study.from_text(MINIMAL + FIGURE + 'y = "s/s(friction=0.10000001)"').figure is not None


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("friction = .5", "numbers have a digit before the decimal point: 0.5;"),
        (r'load = "C:\Users\me\r.csv"', r"has / in place of \, or single quotes: 'C:\Users\me\r.csv';"),
    ],
)
def test_syntax_errors_name_the_key_and_the_decimal_point(line, words):
    error = refused("", Study.from_text, f'title = "t"\n[fixed]\n{line}\n')
    first, shown, mark = str(error).splitlines()
    assert words in first
    assert line.splitlines()[-1].rstrip() in shown
    assert mark.strip(" |") == "^"


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("r.nc", b"CDF\x01\xff", "found an archive; .* for swtstudy report, plot and info"),
        ("m.csv", b"normal,tangential\n0,1\n", r"found a table of values \(CSV\); .* file = "),
        ("m.xlsx", b"PK\x03\x04\xff", "found an Excel workbook; allowed: a study .TOML. that names it"),
    ],
)
def test_other_files_are_told_with_what_takes_them(tmp_path, name, content, words):
    (tmp_path / name).write_bytes(content)
    error = refused(words, Study.from_toml, tmp_path / name)
    assert len(error.mistakes) == 1
    assert "\n" not in str(error)
    assert call("show", tmp_path / name, "--phase", 1).stderr == f"Error: {error}\n"


def test_a_missing_file_is_searched_beside_it(tmp_path):
    (tmp_path / "messung.csv").write_text("normal,tangential\n0,1\n0,-1\n")
    (tmp_path / "mine.toml").write_text('title = "t"\nfixed.load = "a"\n[loads.a]\nfile = "mesung.csv"\n')
    where = re.escape(f"no such file in the folder {tmp_path.resolve()}: did you mean ")
    words = rf"loads\.a\.file: found {where}'messung\.csv'\?"
    refused(words, Study.from_toml, tmp_path / "mine.toml")
    words = rf"mime\.toml: found {where}'mine\.toml'\?; allowed: a study file"
    refused(words, Study.from_toml, tmp_path / "mime.toml")
    words = rf"found no folder {re.escape(str(tmp_path.resolve()))}.none"
    refused(words, Study.from_toml, tmp_path / "none" / "mine.toml")


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("absent.toml", None, "no such file"),
        ("binary.toml", b"\xff\xfe\x00", "not UTF-8"),
        ("nul\0.toml", None, "null"),
    ],
)
def test_a_file_that_cannot_be_read_is_one_message(tmp_path, name, content, message):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    assert len(refused(message, Study.from_toml, tmp_path / name).mistakes) == 1


def test_a_study_of_the_paper_by_its_name(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert Study.from_toml("figure3").title.startswith("Figure 3")


@pytest.mark.parametrize("wrong", [None, 3, b"figure3", ["figure3"]])
def test_what_is_no_path_and_no_text_is_no_study(wrong):
    refused("^path: found .*; allowed: the path or the name of a study$", Study.from_toml, wrong)
    refused("^text: found .*; allowed: the text of a study file$", Study.from_text, wrong)


def test_a_folder_is_no_study(tmp_path):
    refused("found a folder", Study.from_toml, tmp_path)


def test_a_range_in_equal_ratios():
    axis = '{ start = "1/100", stop = 1, num = 5, spacing = "log" }'
    values = Study.from_text(MINIMAL + "[axes]\nfriction = " + axis).grid.axes["friction"]
    assert values == pytest.approx([0.01, 10**-1.5, 0.1, 10**-0.5, 1], rel=1e-12)
    assert (values[0], values[-1]) == (0.01, 1)


@pytest.mark.parametrize(("start", "stop"), [("1e-310", "10"), ("10", "1e-310"), ("1e-280", "10")])
def test_equal_ratios_over_any_range(start, stop):
    axis = f'{{ start = "{start}", stop = "{stop}", num = 5, spacing = "log" }}'
    values = Study.from_text(MINIMAL + "[axes]\nfriction = " + axis).grid.axes["friction"]
    exponents = [math.log10(value) for value in values]
    first, last = math.log10(float(start)), math.log10(float(stop))
    assert exponents == pytest.approx([first + index * (last - first) / 4 for index in range(5)], rel=1e-12)


def test_a_study_shows_what_it_is(small):
    assert repr(small) == "<Study 'A small study': 18 points = 2 normal_amplitude × 9 phase, rtol 0.001>"
    html = small._repr_html_()
    shown = "A small study", "18 points", "0.25, 0.888889", "(9 values)", "figure: hue", "swtstudy plan"
    assert all(words in html for words in shown)


def test_a_study_of_one_point_shows_itself_without_markup():
    study = Study.from_text('title = "<b>"\n')
    assert repr(study) == "<Study '<b>': 1 point, rtol 0.0001>"
    assert "<b>&lt;b&gt;</b>" in study._repr_html_()


def test_a_name_that_is_no_study_is_told_of_those_of_the_paper(tmp_path):
    (mistake,) = refused("", Study.from_toml, "figure33").mistakes
    assert (mistake.source, mistake.key, mistake.found) == ("figure33", "", "no such file")
    start = "a study file (TOML), or a study of the paper: did you mean figure3, figure8 or "
    assert mistake.allowed.startswith(start)
    (tmp_path / "mine.toml").write_text(MINIMAL)
    (mistake,) = refused("", Study.from_toml, tmp_path / "mine").mistakes
    assert mistake.allowed == f"a study file (TOML): {tmp_path / 'mine.toml'} is there"
    (mistake,) = refused("", Study.from_toml, tmp_path / "figure33.toml").mistakes
    assert mistake.allowed == "a study file (TOML)"


def test_a_study_in_a_notebook_is_a_table_of_its_parameters():
    study = Study.from_text(
        'title = "t"\n[fixed]\nfriction = 0.4\n[axes]\nphase = {start = 0, stop = 6, num = 7}\n'
        'frequency_ratio = ["1/2", 1]\n[figure]\nx = "phase"\nhue = "frequency_ratio"\n'
    )
    html = study._repr_html_()
    assert html.startswith(
        "<div><b>t</b><br>14 points = 7 phase × 2 frequency_ratio, rtol 0.0001; swtstudy plan tells "
    )
    assert html.endswith("</td></tr></table></div>")
    rows = re.findall(r"<tr><td>(.*?)</td><td><b>(.*?)</b></td><td>(.*?)</td><td>(.*?)</td></tr>", html)
    found = {name: (kind, values, meaning.partition("; figure: ")[2]) for kind, name, values, meaning in rows}
    assert found["phase"] == ("axis", "0, 1 rad … 6 rad (7 values)", "x")
    assert found["frequency_ratio"] == ("axis", "1/2, 1", "hue")
    assert found["friction"] == ("fixed", "0.4", "")
    assert list(found)[:2] == ["phase", "frequency_ratio"]
    # Nothing stands between the rows.
    assert html.count("</tr><tr>") == len(rows) - 1


@pytest.mark.parametrize(
    ("fixed", "axes", "idle"),
    [
        ("normal_amplitude = 0", "phase = [0, 1]\nfrequency_ratio = [1, 2]", ["phase", "frequency_ratio"]),
        ("normal_amplitude = 0.5", "bulk_stress_phase = [0, 1]\nphase = [0, 1]", ["bulk_stress_phase"]),
        ("normal_amplitude = 0\nbulk_stress_amplitude = 0.1", "bulk_stress_phase = [0, 1]", []),
    ],
)
def test_axes_without_effect_are_warned_of(fixed: str, axes: str, idle: list[str]) -> None:
    _, told = warned(Study.from_text, f'title = "t"\n[fixed]\n{fixed}\n[axes]\n{axes}\n')
    assert [each.split()[1] for each in told] == [f"axes.{name}" for name in idle]


LOOP = 'title = "t"\nfixed.load = "mine"\n[loads.mine]\n'


def test_phases_of_harmonics_may_have_units() -> None:
    text = LOOP + "normal = [[1, 0.5, {}]]\ntangential = [[1, 1, 0]]\n"
    plain = Study.from_text(text.format(math.pi / 2))
    assert Study.from_text(text.format('"90 deg"')).grid.loops[0].code == plain.grid.loops[0].code
