"""What the commands print: aligned on a terminal, parted by tabs elsewhere, in lines that are not broken."""

from __future__ import annotations

import io
import re
from importlib import import_module
from pathlib import Path

import pytest
import xarray as xr
from click.testing import CliRunner
from folders import RESULTS
from solved import REGIMES

import swtstudy
from swtstudy.cli import _SECTIONS, main
from swtstudy.cli.points import WHY
from swtstudy.cli.terminal import fitted, of_markdown, wrapped
from swtstudy.study.shipped import GROUPS, OTHERS, in_groups, shipped_studies
from swtstudy.study.template import template_with_units
from swtstudy.vocabulary.mistakes import StudyError
from swtstudy.vocabulary.parameters import PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE, NAMED
from swtstudy.vocabulary.wording import numbers_words, raised

#: The tests look at what is written, not at the layout of figures.
pytestmark = pytest.mark.usefixtures("unwrapped")


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def lines_of(*arguments: str) -> list[str]:
    return CliRunner().invoke(main, list(arguments)).stdout.splitlines()


def test_columns_are_aligned_and_nothing_is_lost() -> None:
    head, *rows = parted = [
        each.split("\t") for each in lines_of("solve", "--phase", "0,pi/2", "--rtol", "1e-2")
    ]
    printed = fitted(head, rows, 200).splitlines()
    assert [each.split() for each in printed] == parted
    ends = [[found.end() for found in re.finditer(r"\S+", each)] for each in printed]
    assert ends[0][:-1] == ends[1][:-1] == ends[2][:-1]  # numbers; the last column is words
    assert len({each.index(words[-1]) for each, words in zip(printed, parted, strict=True)}) == 1


def test_a_terminal_gets_columns_and_a_pipe_tabs(monkeypatch: pytest.MonkeyPatch) -> None:
    arguments = ["solve", "--friction", "0.1,0.2", "--rtol", "1e-2"]
    piped = CliRunner().invoke(main, arguments).stdout
    assert piped.splitlines()[0].startswith("friction\ts\t")
    monkeypatch.setattr(import_module("swtstudy.cli.terminal"), "line_length", lambda: 80)
    shown = CliRunner().invoke(main, arguments)
    assert "\t" not in shown.stdout
    error = piped.splitlines()[1].split("\t")[2]
    assert re.fullmatch(r"\d\.\de-0\d", error)
    assert raised(error) in shown.stdout
    assert error not in shown.stdout


def test_lines_of_info_are_broken_behind_their_names(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    swtstudy.run(swtstudy.Study.from_text('title = "t"\nrtol = 1e-2\n'), tmp_path / "a.nc")
    monkeypatch.setattr(import_module("swtstudy.cli.terminal"), "line_length", lambda: 60)
    found = lines_of("info", str(tmp_path / "a.nc"))
    first = next(k for k, line in enumerate(found) if "made by" in line)
    assert len(found[first]) <= 60
    assert found[first + 1].startswith(" " * found[first].index("swtstudy"))


WIDE = [
    "solve",
    "--rtol",
    "1e-2",
    "--quantities",
    "dissipation,stick_radius",
    "--tangential-amplitude",
    "0.2,0.4,0.6",
]


@pytest.mark.parametrize("columns", [40, 60, 80, 100, 200])
def test_a_table_is_no_wider_than_the_terminal(columns: int) -> None:
    head, *rows = parted = [each.split("\t") for each in lines_of(*WIDE)]
    printed = fitted(head, rows, columns)
    assert max(map(len, printed.splitlines())) <= columns
    if columns == 200:
        assert [each.split() for each in printed.splitlines()] == parted
        return
    # One quantity a line for each point: its name, then its value.
    blocks = [[line.split() for line in block.splitlines()] for block in printed.split("\n\n")]
    assert blocks == [[[name, value] for name, value in zip(head, row, strict=True)] for row in rows]


def test_room_is_used_to_the_last_letter() -> None:
    head, rows = ["name", "b"], [["12345", "6"], ["7", "89"], ["3", "4"]]
    assert fitted(head, rows, 9).splitlines() == [" name   b", "12345   6", "    7  89", "    3   4"]
    assert fitted(head, rows, 8).splitlines()[:2] == ["name  12345", "b         6"]


def test_a_point_too_wide_for_any_terminal_is_still_told() -> None:
    assert fitted(["name"], [["x" * 30]], 20) == "name  " + "x" * 30


def test_lines_are_broken_between_words_below_their_own() -> None:
    line = "  axis           phase: 0, 0.04363 … 2π (151 values), a-hyphen-stays"
    for columns in (35, 40, 60):
        first, *others = wrapped(line, columns, 17).split("\n")
        assert others
        assert max(map(len, (first, *others))) <= columns
        assert all(each.startswith(" " * 17) and each[17] != " " for each in others)
        assert " ".join([first, *map(str.strip, others)]) == line
    assert wrapped(line, None, 17) == line


@pytest.mark.parametrize("name", ["sensitivity_indices", "audit_parameter_box", "audit_criteria_box"])
def test_tables_of_markdown_are_set_in_columns(name: str) -> None:
    text = (RESULTS / f"{name}.md").read_text("utf-8")
    assert of_markdown(text, None) == text
    shown = of_markdown(text, 80).splitlines()
    assert max(map(len, shown)) <= 80
    assert not [each for each in shown if "|" in each]
    words = re.sub(r"\|[-|]+\||\|", " ", text).split()
    assert sorted(" ".join(shown).split()) == sorted(words)


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        (["--profile", "truncated_paraboloid", "--flat-radius", "1", "--poisson-ratio", "0.3"], None),
        (["--tangential-force-amplitude", "2"], "no_equilibrium"),
    ],
)
def test_a_regime_without_s_is_explained(arguments: list[str], name: str | None) -> None:
    outcome = CliRunner().invoke(main, ["solve", "--rtol", "1e-2", *arguments])
    assert outcome.exit_code == 0
    assert outcome.stderr == ("" if name is None else f"{name}: {WHY[name]}\n")


def test_every_regime_without_s_has_an_explanation() -> None:
    assert {*WHY} == {"not_finite", "no_equilibrium"}
    assert {*WHY} <= {*REGIMES}


def test_every_command_is_in_one_section_and_says_a_whole_sentence() -> None:
    listed = [str(command.name) for commands in _SECTIONS.values() for command in commands]
    assert sorted(listed) == sorted(main.commands)
    text = " ".join(" ".join(lines_of("--help")).split())
    assert "..." not in text.split("Examples:")[0].replace("[ARGS]...", "")
    for name in listed:
        assert " ".join(str(main.commands[name].help).split("\n\n")[0].split()) in text


def test_parameters_are_listed_by_what_they_are_a_part_of() -> None:
    text = CliRunner().invoke(main, ["solve", "--help"]).stdout
    places = [text.index(f"\n{title}:") for title in ("The load", "The profile and its shape", "The bodies")]
    assert places == sorted(places)
    phase, flat = (text.index(f"\n  --{name} ") for name in ("phase", "flat-radius"))
    assert places[0] < phase < places[1] < flat < places[2]
    for name in PARAMETERS:
        assert text.count(f"\n  --{name.replace('_', '-')} ") == 1
    assert len(text.splitlines()) <= 40
    assert max(map(len, text.splitlines())) <= 80


def test_all_parameters_and_quantities_are_explained() -> None:
    text = "\n".join(lines_of("list", "--parameters"))
    for name in (*PARAMETERS, *NAMED, DISTANCE):
        assert text.count(f"\n  {name} ") == 1


@pytest.mark.parametrize("on_a_terminal", [True, False])
def test_new_and_run_name_the_next_command(tmp_path, monkeypatch, on_a_terminal: bool) -> None:
    monkeypatch.chdir(tmp_path)
    terminal = import_module("swtstudy.cli.terminal")
    monkeypatch.setattr(terminal, "line_length", lambda: 80 if on_a_terminal else None)
    assert ("next: swtstudy run mine.toml" in lines_of("new", "mine")) is on_a_terminal
    assert ("next: swtstudy report results/mine.nc" in lines_of("run", "mine.toml")) is on_a_terminal


def test_studies_are_listed_in_groups_each_once() -> None:
    names = [name for group in GROUPS.values() for name in group]
    assert sorted(names) == sorted(shipped_studies())
    assert in_groups(["figure4", "mine", "figure3"]) == {
        "The paper": ["figure3", "figure4"],
        OTHERS: ["mine"],
    }
    listed = lines_of("list")
    assert [each for each in listed if each in GROUPS] == [*GROUPS]


def test_a_list_fits_80_columns_and_cuts_no_title(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = " ".join(" ".join(lines_of("list")).split())
    monkeypatch.setattr(import_module("swtstudy.cli.terminal"), "line_length", lambda: 80)
    shown = lines_of("list")
    assert max(map(len, shown[:-1])) <= 80
    assert " ".join(" ".join(shown).split()) == whole


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return swtstudy.solve(normal_amplitude=[0.25, 1.5], rtol=1e-2)


def test_results_say_what_they_are(results: xr.Dataset) -> None:
    said = repr(results.swt)
    for words in ("normal_amplitude: 0.25, 1.5", "friction: 0.3", "rtol 0.01", "1 partial_slip, 1 lift_off"):
        assert words in said
    assert repr(results.drop_vars("s").swt) == "<no results of swtstudy, or a part of them>"


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


def test_numbers_side_by_side_are_of_one_kind() -> None:
    assert numbers_words([5e7, 5e5], 2) == ["5·10⁷", "5·10⁵"]
    assert numbers_words([3.9e-5, 1e-4, 0.5, -2000.0], 2) == ["3.9·10⁻⁵", "10⁻⁴", "0.5", "-2·10³"]
    assert numbers_words([999.0, 1000.0, 1e-2, 9.9e-3, 1e9]) == ["999", "10³", "0.01", "9.9·10⁻³", "10⁹"]
    assert numbers_words([5e5, 1e3]) == ["500000", "1000"]
    assert numbers_words([]) == []


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
    text = template_with_units("mine").replace("num = 13", "num = 3").replace("rtol = 0.0001", "rtol = 0.01")
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
