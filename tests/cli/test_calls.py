"""What commands hand on to functions in Python, which are stand-ins here, and what they print and write."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import xarray as xr
from command import call
from made_up import STATEMENTS, made_up_audit, report
from matplotlib.figure import Figure
from real import STUDY

from swtstudy.paper.statements import Outcome

LOADS = """title = "Loads"
[loads.square]
vertices = [[0, 1], [0.5, 1], [0.5, -1], [0, -1]]
[fixed]
load = "square"
friction = 0.4
"""
WORN = "radius,height\n" + "".join(f"{r / 10},{(r / 10) ** 2 / 2}\n" for r in range(20))


@pytest.fixture
def called(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[..., list[tuple[Any, ...]]]:
    """Puts a stand-in in the place of a function, whose calls are then in a list."""
    monkeypatch.chdir(tmp_path)

    def stand_in(place: str, result: Any = None) -> list[tuple[Any, ...]]:
        calls: list[tuple[Any, ...]] = []

        def function(*arguments: Any, **named: Any) -> Any:
            calls.append((arguments, named))
            return result

        monkeypatch.setattr(place, function)
        return calls

    return stand_in


@pytest.mark.parametrize(
    ("arguments", "function", "given"),
    [
        (["--phase", "1"], "inspect", {"phase": "1"}),
        (["--profile", "cone"], "draw_profile", {"profile": "cone"}),
        (
            ["--profile", "rounded_punch", "--flat-radius", "0.5"],
            "draw_profile",
            {"profile": "rounded_punch", "flat_radius": "0.5"},
        ),
        (["--profile", "power_law", "--friction", "1"], "inspect", {"profile": "power_law", "friction": "1"}),
        (["loads.toml"], "inspect", {"load": "square", "friction": 0.4}),
        (["loads.toml", "--friction", "0.5"], "inspect", {"load": "square", "friction": 0.5}),
        (["loads.toml", "--profile", "paraboloid"], "draw_profile", {"profile": "paraboloid"}),
    ],
)
def test_show_draws_a_point_or_a_profile(
    called: Callable, arguments: list[str], function: str, given: dict[str, Any]
) -> None:
    drawn, saved = called(f"swtstudy.{function}", Figure()), called("swtstudy.figures.style.save_figure")
    Path("loads.toml").write_text(LOADS)
    done = call("show", *arguments, "-o", "a.svg", "--width", "page", "--style", "ggplot")
    assert done.output == "a.svg\n"
    (((), named),) = drawn
    look = {name: named.pop(name) for name in ("width", "style")}
    assert look == {"width": "page", "style": "ggplot"}
    named = {name: str(v) if name == "load" else v for name, v in named.items()}
    assert {name: value for name, value in named.items() if name in given or function != "inspect"} == given
    assert saved[0][0][1:] == ("a.svg", "ggplot")


@pytest.mark.parametrize(("option", "smoothing"), [([], 0.0), (["--smoothing", "0.001"], 0.001)])
def test_show_draws_a_table_of_a_profile(called: Callable, option: list[str], smoothing: float) -> None:
    drawn = called("swtstudy.draw_profile", Figure())
    called("swtstudy.figures.style.save_figure")
    Path("deeper").mkdir()
    Path("deeper/worn.csv").write_text(WORN)
    assert call("show", "--profile", "deeper/worn.csv", *option).output == "point.png\n"
    table = drawn[0][1]["profile"]
    assert (table.name, table.radius.size, table.smoothing) == ("worn", 20, smoothing)


@pytest.mark.parametrize(
    ("arguments", "method", "given"),
    [
        ([], "inspect", (1,)),
        (["--body", "2"], "inspect", (2,)),
        (["--body", "pad"], "inspect", ("pad",)),
        (["--profile", "paraboloid"], "draw_profile", ()),
    ],
)
def test_show_draws_a_contact_in_its_units(
    called: Callable, arguments: list[str], method: str, given: tuple[object, ...]
) -> None:
    drawn = called(f"swtstudy.faces.contacts.PhysicalContact.{method}", Figure())
    called("swtstudy.figures.style.save_figure")
    Path("rig.toml").write_text(STUDY)
    own = ["--normal-force", "200", "--tangential-amplitude", "1e-3", "--phase", "0"]
    done = call("show", "rig.toml", *(own if method == "inspect" else ["--normal-force", "200"]), *arguments)
    assert done.output == "point.png\n"
    ((_, *found), named) = drawn[0]
    assert (tuple(found), named) == (given, {"style": None, "width": None})


def test_show_of_a_study_without_units_has_no_bodies(called: Callable) -> None:
    called("swtstudy.figures.style.save_figure")
    Path("loads.toml").write_text(LOADS)
    refused = call("show", "loads.toml", "--body", "1")
    assert refused.output == "Error: body: found '1'; allowed: no body in a study without units\n"


def test_show_draws_a_load_of_a_study_alone(called: Callable) -> None:
    drawn, saved = called("swtstudy.draw_load", Figure()), called("swtstudy.figures.style.save_figure")
    Path("loads.toml").write_text(LOADS)
    assert call("show", "loads.toml", "--load", "square", "-o", "a.png").output == "a.png\n"
    ((study, *rest), named) = drawn[0]
    assert (study.title, rest, named) == ("Loads", ["square", None], {"style": None, "width": None})
    assert saved[0][0][1:] == ("a.png", None)


@pytest.mark.parametrize(("width", "height", "told"), [("column", 12.0, True), ("column", 5.0, False)])
def test_a_picture_that_is_higher_than_a_page_says_so(
    called: Callable, width: str, height: float, told: bool
) -> None:
    called("swtstudy.inspect", Figure(figsize=(3.0, height)))
    called("swtstudy.figures.style.save_figure")
    done = call("show", "--width", width)
    words = "point.png is 30 cm high, more than a page: --width page draws it lower\n"
    assert done.stdout == "point.png\n"
    assert done.stderr == words * told


def test_audit_writes_a_report_of_each_study(called: Callable) -> None:
    audited = called("swtstudy.audit_study", made_up_audit())
    for name in ("one", "two"):
        Path(f"{name}.toml").write_text(LOADS.replace("Loads", name))
    names = ("one.toml", "two.toml")
    done = call("audit", *names, "--points", 7, "--seed", 3, "--workers", 1, "--results", "found", "--dense")
    text = report(made_up_audit())
    assert done.output == "".join(
        f"{text}\nfound/audit_{name}.nc\nfound/audit_{name}.md\n" for name in ("one", "two")
    )
    assert Path("found/audit_one.md").read_text() == text == Path("found/audit_two.md").read_text()
    assert [(study.title, *rest) for (study, *rest), _ in audited] == [
        (name, Path(f"found/audit_{name}.nc"), 7, 3, 1, True) for name in ("one", "two")
    ]
    call("audit", "one.toml")
    assert audited[-1][0][1:] == (Path("results/audit_one.nc"), 1000, 0, 2, False)


@pytest.mark.parametrize("option", [[], ["-o", "deeper/table.md"]])
def test_check_writes_its_table_where_nothing_lacks(called: Callable, option: list[str]) -> None:
    first, second, third = [*STATEMENTS.values()][:3]
    outcomes = [Outcome(first, "0.25", True), Outcome(second, "1.5", False), Outcome(third, "2")]
    asked = called("swtstudy.paper.statements.check", outcomes)
    done = call("check", "--results", "found", *option)
    assert done.exit_code == 0, done.output
    assert asked == [(("found",), {})]
    *lines, target = done.output.splitlines()
    assert target == (option[1] if option else "found/statements.md")
    text = Path(target).read_text("utf-8")
    assert " statements: " in lines[-1]
    assert lines[-1] in text
    head, *rows = lines[:-1]
    assert head.split() == ["where", "the", "paper", "says", "measured"]
    said = " ".join(" ".join(rows).split())
    for part in (first.place, "0.25", "holds", second.place, "1.5", "does not hold"):
        assert part in said
    assert max(map(len, lines)) <= 120


POINTS = xr.Dataset(
    {
        "SWT": ("point", [1.25, 3.5, 2.0], {"units": "MPa"}),
        "cycles": ("point", [9e6, 12345.0, 1e5]),
        "FS": ("point", [0.5, 0.25, 0.125]),
        "findley_stress": ("point", [1.0, 2.0, 250.0], {"units": "MPa"}),
        "findley_usage": ("point", [0.1, 0.2, 1.5]),
    },
    coords={"id": ("point", [7, 8, 9]), "x": ("point", [0.5, 1.0, 1.5]), "z": ("point", [0.0, 0.1, 1e-7])},
)


def test_history_says_where_each_criterion_is_largest(called: Callable) -> None:
    read, found = called("swtstudy.read_history", "table"), called("swtstudy.evaluate_history", POINTS)
    written = called("swtstudy.faces.elements.write_history")
    Path("rig.toml").write_text(STUDY)
    done = call("history", "rig.toml", "deeper/stresses.csv", "--order", "abaqus", "--body", 2)
    assert done.output.splitlines() == [
        "largest SWT = 3.5 MPa, cycles = 12300 at id = 8, x = 1, z = 0.1",
        "largest FS = 0.5 at id = 7, x = 0.5, z = 0",
        "largest findley_stress = 250 MPa, findley_usage = 1.5 at id = 9, x = 1.5, z = 10⁻⁷",
        "deeper/stresses_lives.csv",
    ]
    assert read == [(("deeper/stresses.csv",), {"order": "abaqus", "columns": {}, "encoding": None})]
    assert found == [(("table", "rig.toml", 2), {})]
    assert written[0][0][1] == Path("deeper/stresses_lives.csv")
    alone = POINTS[["SWT"]].isel(point=[0]).drop_vars(["id", "x", "z"])
    called("swtstudy.evaluate_history", alone)
    done = call("history", "rig.toml", "a.csv", "-o", "b.vtu")
    assert done.output == "largest SWT = 1.25 MPa at the only point\nb.vtu\n"
    wrong = call("history", "rig.toml", "a.csv", "-o", "b.txt")
    assert wrong.output == "Error: output: found b.txt; allowed: a file that ends with .csv, .vtu, .nc\n"


def test_fit_prints_and_writes_what_it_found(called: Callable) -> None:
    found, drawn = called("swtstudy.fit", "found"), called("swtstudy.figures.statistics.draw_fit", "figure")
    called("swtstudy.figures.statistics.fit_lines", ["one", "two"])
    stored, saved = called("swtstudy.archive.archive.save"), called("swtstudy.figures.style.save_figure")
    own = ("--y", "cycles_line", "--friction", "--confidence", "0.9", "--results", "out", "--width", "column")
    done = call("fit", "deeper/rig.toml", "tests.csv", *own)
    assert done.output == "one\ntwo\nout/rig_fit_line_friction.nc\nout/rig_fit_line_friction.png\n"
    given = {"y": "cycles_line", "friction": True, "confidence": 0.9}
    assert found == [(("deeper/rig.toml", "tests.csv"), given)]
    assert drawn == [(("found",), {"width": "column"})]
    assert stored == [(("found", Path("out/rig_fit_line_friction.nc")), {})]
    assert saved == [(("figure", Path("out/rig_fit_line_friction.png")), {})]
    call("fit", "rig.toml", "tests.csv")
    assert found[1][1] == {"y": "cycles_volume", "friction": False, "confidence": 0.95}
    assert drawn[1][1] == {"width": None}


def test_report_tells_pages_and_what_is_none(called: Callable) -> None:
    pages = [(Path("a.html"), ""), (Path("b.nc"), "b.nc is none")]
    asked = called("swtstudy.faces.site.write_reports", pages)
    done = call("report", "a.nc", "b.nc", "-o", "site", "--workers", 3)
    assert (done.stdout, done.stderr) == ("a.html\n", "b.nc is none\n")
    assert asked == [((("a.nc", "b.nc"), "site", 3), {})]


def test_sensitivity_writes_beside_the_archive_by_the_names_of_its_quantities(called: Callable) -> None:
    computed = called("swtstudy.run", "results")
    found = called("swtstudy.sensitivity", "indices")
    drawn = called("swtstudy.figures.statistics.draw_sensitivity", "figure")
    table = called("swtstudy.paper.markdown.table", "| a |\n|---|\n| 1 |\n")
    stored, saved = called("swtstudy.archive.archive.save"), called("swtstudy.figures.style.save_figure")
    text = 'title = "t"\n[sample]\ndesign = "saltelli"\nsize = 4\n[sample.ranges]\nfriction = [0.1, 0.5]\n'
    Path("mine.toml").write_text(text)
    own = ("--y", "s", "--y", "s/s(phase=0)", "--confidence", "0.9", "--seed", 5, "--width", "page")
    done = call("sensitivity", "mine.toml", *own, "--workers", 1)
    stem = "results/mine_indices_s_s_s_phase_0_"
    assert done.output == (f"| a |\n|---|\n| 1 |\n\nresults/mine.nc\n{stem}.nc\n{stem}.md\n{stem}.png\n"), (
        done.output
    )
    assert Path(f"{stem}.md").read_text() == "| a |\n|---|\n| 1 |\n"
    assert computed[0][0][1:] == (Path("results/mine.nc"),)
    assert computed[0][1] == {"workers": 1}
    assert found == [(("results", ("s", "s/s(phase=0)"), 0.9, 5), {})]
    assert drawn == [(("indices",), {"width": "page"})]
    assert table == [(("indices", False), {})]
    assert stored == [(("indices", Path(f"{stem}.nc")), {})]
    assert saved == [(("figure", Path(f"{stem}.png")), {})]
    call("sensitivity", "sensitivity")
    assert table[1] == (("indices", True), {})
    assert Path("results/sensitivity_indices.md").is_file()
    refused = call("sensitivity", "figure3")
    assert refused.exit_code == 2
    assert refused.stderr.startswith("Error: figure3: ")
