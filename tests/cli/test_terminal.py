"""What the commands print: aligned on a terminal, parted by tabs elsewhere, in lines that are not broken."""

import io
import re
from pathlib import Path

import pytest
import stand_in
import xarray as xr
from asking import EVERY
from command import call, shown
from folders import RESULTS, STUDIES
from words import PARAMETERS

import swtstudy
from swtstudy import StudyError
from swtstudy.cli.terminal import line_length, of_markdown

#: The tests look at what is written, not at the layout of figures.
pytestmark = pytest.mark.usefixtures("unwrapped")


def lines_of(*arguments: object) -> list[str]:
    return call(*arguments).stdout.splitlines()


def parted(*arguments: object) -> list[list[str]]:
    """The cells of a table, which are parted by tabs where it does not go to a terminal."""
    return [each.split("\t") for each in lines_of(*arguments)]


def test_columns_are_aligned_and_nothing_is_lost() -> None:
    arguments = ("solve", "--phase", "0,pi/2", "--rtol", "1e-2")
    table, printed = parted(*arguments), shown(200, *arguments)
    # A small number has another form there.
    assert [each.split()[:2] for each in printed] == [each[:2] for each in table]
    assert [len(each.split()) for each in printed] == [*map(len, table)]
    ends = [[found.end() for found in re.finditer(r"\S+", each)] for each in printed]
    assert ends[0][:-1] == ends[1][:-1] == ends[2][:-1]  # numbers; the last column is words
    assert len({each.index(words[-1]) for each, words in zip(printed, table, strict=True)}) == 1


def test_a_terminal_gets_columns_and_a_pipe_tabs() -> None:
    arguments = ("solve", "--friction", "0.1,0.2", "--rtol", "1e-2")
    head, first, _ = parted(*arguments)
    assert head[:2] == ["friction", "s"]
    printed = "\n".join(shown(80, *arguments))
    assert "\t" not in printed
    assert re.fullmatch(r"\d\.\de-0\d", first[2])
    digits, power = first[2].split("e-0")
    assert f"{float(digits):g}·10⁻{'⁰¹²³⁴⁵⁶⁷⁸⁹'[int(power)]}" in printed
    assert first[2] not in printed


def test_lines_of_info_are_broken_behind_their_names(tmp_path: Path) -> None:
    swtstudy.run(swtstudy.Study.from_text('title = "t"\nrtol = 1e-2\n'), tmp_path / "a.nc")
    whole = lines_of("info", tmp_path / "a.nc")
    found = shown(60, "info", tmp_path / "a.nc")
    assert max(map(len, found)) <= 60
    first = next(k for k, line in enumerate(found) if "made by" in line)
    indent = found[first].index("swtstudy")
    assert all(each[indent] != " " for each in found[1:])
    assert found[first + 1].startswith(" " * indent)
    assert " ".join(" ".join(found).split()) == " ".join(" ".join(whole).split())


WIDE = ("solve", "--rtol", "1e-2", "--quantities", "dissipation,stick_radius")
WIDE = (*WIDE, "--tangential-amplitude", "0.2,0.4,0.6")


def test_a_table_is_no_wider_than_the_terminal_and_uses_all_its_room() -> None:
    flat = shown(500, *WIDE)
    widest = max(map(len, flat))
    assert 100 < widest < 200
    assert shown(widest, *WIDE) == flat
    # One quantity a line for each point: its name, then its value. A point too wide is told all the same.
    head, *rows = [each.split() for each in flat]
    for columns in (20, 40, 100, widest - 1):
        printed = shown(columns, *WIDE)
        assert columns == 20 or max(map(len, printed)) <= columns
        blocks = [[line.split() for line in block.splitlines()] for block in "\n".join(printed).split("\n\n")]
        assert blocks == [[[name, value] for name, value in zip(head, row, strict=True)] for row in rows]


SAMPLE = """
title = "A sample"
[sample]
design = "saltelli"
size = 4
[sample.ranges]
friction = [0.1, 0.9]
poisson_ratio = [0, 0.5]
"""


@pytest.mark.filterwarnings("ignore:indices are known to")
def test_tables_of_markdown_are_set_in_columns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    (tmp_path / "mine.toml").write_text(SAMPLE)
    arguments = ("sensitivity", tmp_path / "mine.toml", "--results", tmp_path)
    *printed, _, _, _, _ = shown(80, *arguments)
    text = (tmp_path / "mine_indices.md").read_text("utf-8")
    assert "\n".join(lines_of(*arguments)).startswith(text)
    assert max(map(len, printed)) <= 80
    assert not [each for each in printed if "|" in each]
    words = re.sub(r"\|[-|]+\||\|", " ", text).split()
    assert sorted(" ".join(printed).split()) == sorted(words)


NOT_FINITE = ("--profile", "truncated_paraboloid", "--flat-radius", "0.5", "--friction", "1.9")


def test_a_closed_stream_has_lines_of_any_length(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    stream.close()
    for each in (stream, None):
        monkeypatch.setattr("sys.stdout", each)
        assert line_length() is None


MARKDOWN = """# A title that is longer than a line
* one, two, three, four, five, six
plain words that go on and on
| a | b |
|---|---|
| 1 | x |
"""
SET = """# A title that is
longer than a line
* one, two, three,
  four, five, six
plain words that go
on and on
a  b
1  x"""


@pytest.mark.parametrize(("width", "text"), [(None, MARKDOWN), (20, SET)])
def test_a_list_is_indented_where_it_is_broken(width: int | None, text: str) -> None:
    assert of_markdown(MARKDOWN, width) == text


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--profile", "truncated_paraboloid", "--flat-radius", "1", "--poisson-ratio", "0.3"), ""),
        (NOT_FINITE, "not_finite: s is infinite, since swt grows without bound towards the edge of the .*\n"),
        (
            ("--tangential-force-amplitude", "2"),
            "no_equilibrium: there is no s, since friction does not .*\n",
        ),
    ],
)
def test_a_regime_without_s_is_explained(arguments: list[str], said: str) -> None:
    outcome = call("solve", "--rtol", "1e-2", *arguments)
    assert outcome.exit_code == 0
    assert re.fullmatch(said, outcome.stderr)


def test_all_parameters_and_quantities_are_explained() -> None:
    text = "\n".join(lines_of("list", "--parameters"))
    for name in (*PARAMETERS, *EVERY, "critical_distance"):
        assert text.count(f"\n  {name} ") == 1


def test_new_and_run_name_the_next_command_on_a_terminal(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    assert "next: swtstudy run mine.toml" in shown(80, "new", "mine")
    assert "next: swtstudy report results/mine.nc" in shown(80, "run", "mine.toml")
    for arguments in (("new", "other"), ("run", "other.toml")):
        assert not [line for line in lines_of(*arguments) if line.startswith("next:")]


def test_studies_are_listed_in_groups_each_once() -> None:
    lines = lines_of("list")
    names = [path.stem for path in (*STUDIES.glob("*.toml"), *STUDIES.glob("audit/*.toml"))]
    assert sorted(each.split()[0] for each in lines if each.startswith("  ")) == sorted(names)
    groups = [each for each in lines if each[:1].strip()]
    assert groups[:2] == ["The paper", "Loads"]
    paper = lines[lines.index("The paper") + 1 : lines.index("Loads")]
    assert {"figure3", "figure4"} <= {each.split()[0] for each in paper if each}


def test_a_list_fits_80_columns_and_cuts_no_title() -> None:
    whole, lines = lines_of("list"), shown(80, "list")
    assert max(map(len, lines[:-1])) <= 80
    assert " ".join(" ".join(lines).split()) == " ".join(" ".join(whole).split())


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return swtstudy.solve(normal_amplitude=[0.25, 1.5], rtol=1e-2)


def test_an_archive_says_what_info_prints(results: xr.Dataset) -> None:
    archive = f"{RESULTS}/loops.nc"
    assert repr(swtstudy.open_results(archive).swt).splitlines() == lines_of("info", archive)
    assert not [each for each in lines_of("info", archive) if each.endswith("yes")]


@pytest.mark.parametrize(
    ("name", "said"),
    [("figure4", "none of 1490 points above rtol"), ("stability_small_motion", " of 565 points above rtol")],
)
def test_an_error_of_rtol_is_not_above_it(name: str, said: str) -> None:
    dataset = swtstudy.open_results(f"{RESULTS}/{name}.nc")
    (line,) = [each for each in repr(dataset.swt).splitlines() if each.startswith("  accurate")]
    assert line.endswith(said)
    known = (dataset.s_error / dataset.s).values.ravel()
    above = int((known > 1.001 * dataset.attrs["rtol"]).sum())
    assert f"; {above or 'none'} of" in line


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (5e5, 5e7, ("5·10⁵", "5·10⁷")),
        (3.9e-5, 0.5, ("3.9·10⁻⁵", "0.5")),
        (999.0, 1e9, ("999", "10⁹")),
        (1000.0, 1e9, ("10³", "10⁹")),
        (9.9e-3, 1e9, ("9.9·10⁻³", "10⁹")),
        (1e3, 5e5, ("1000", "500000")),
    ],
)
def test_numbers_side_by_side_are_of_one_kind(results: xr.Dataset, low: float, high: float, words) -> None:
    said = repr(results.assign(s=results.s.copy(data=[low, high])).swt)
    assert re.search(r"s = (\S+) \(.*?\) to (\S+) \(", said).groups() == words


def test_a_contact_in_pascals_has_no_computers_numbers() -> None:
    contact = swtstudy.physical(
        young_modulus=73.1e9, poisson_ratio=0.33, radius=0.05, normal_force=200.0, friction=0.5,
        tangential_force_amplitude=60.0,
    )  # fmt: skip
    constants = swtstudy.FatigueConstants(73.1e9, 927e6, -0.113, 0.409, -0.713)
    for said in (repr(contact), repr(contact.solve(rtol=1e-2, constants=constants).swt)):
        assert "7.31·10¹⁰" in said
        assert not re.search(r"\de[+-]?\d", said)


def test_flags_are_words_in_one_call_that_their_attributes_name(results: xr.Dataset) -> None:
    assert ".swt.words()" in results.regime.attrs["comment"]
    assert results.swt.words().values.tolist() == ["partial_slip", "lift_off"]
    lacking = results.assign(regime=results.regime.where(results.normal_amplitude < 1))
    lacking.regime.attrs = results.regime.attrs
    assert lacking.swt.words().values.tolist() == ["partial_slip", ""]
    with pytest.raises(StudyError, match="name: found 's'; allowed: a variable of flags: regime"):
        results.swt.words("s")


def test_the_axes_of_the_template_with_units_do_something(tmp_path) -> None:  # type: ignore[no-untyped-def]
    call("new", "--units", tmp_path / "mine")
    text = (
        (tmp_path / "mine.toml")
        .read_text()
        .replace("num = 13", "num = 3")
        .replace("rtol = 0.0001", "rtol = 0.01")
    )
    dataset = swtstudy.run(swtstudy.Study.from_text(text), tmp_path / "mine.nc")
    for dim in dataset.s.dims:
        assert float(dataset.swt.extrema(str(dim)).ratio.max()) > 1.1, dim


def test_directions_are_columns_and_make_no_rows() -> None:
    dataset = swtstudy.open_results(f"{RESULTS}/life.nc")
    table = dataset.swt.to_table()
    assert len(table) == dataset.sizes["tangential_amplitude"] * dataset.sizes["critical_distance"]
    assert not table.duplicated(["tangential_amplitude", "critical_distance"]).any()
    along = dataset.s_point.sel(direction="critical_plane").values.ravel()
    assert table["s_point[critical_plane]"].to_numpy() == pytest.approx(along)


def test_coordinates_of_extrema_keep_their_units() -> None:
    dataset = swtstudy.open_results(f"{RESULTS}/sphere_on_flat.nc")
    extremes = dataset.swt.extrema("phase")
    assert extremes.normal_force.attrs == dataset.normal_force.attrs
