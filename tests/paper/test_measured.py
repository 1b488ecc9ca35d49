"""What is measured of each statement of the paper, and audits and tables, word by word."""

import re
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from folders import RESULTS
from kept import Kept, numbers, told
from made_up import STATEMENTS, audit_of, made_up_point, report
from solved import REGIMES

import swtstudy
from swtstudy.kernel import field
from swtstudy.paper.audit import audit_point, open_audit
from swtstudy.paper.markdown import table
from swtstudy.paper.maxima import body_maximum
from swtstudy.paper.statements import Outcome, about_archive, markdown, summary
from swtstudy.points.grid import canonical_points
from swtstudy.points.reading import read_grid
from swtstudy.results.one_point import read_point


@cache
def archive(name: str) -> xr.Dataset:
    path = RESULTS / f"{name}.nc"
    return open_audit(path) if name.startswith("audit_") else swtstudy.open_results(path)


TABLE = (RESULTS / "statements.md").read_text(encoding="utf-8")


#: It looks at the zones of permanent stick of all archives.
LONG = "outside_of_stick"


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=[pytest.mark.slow] * (n == LONG)) for n in STATEMENTS]
)
def test_a_statement_is_what_the_table_in_the_results_says(name: str) -> None:
    outcome = STATEMENTS[name](*map(archive, STATEMENTS[name].studies))
    row = next(line for line in TABLE.splitlines() if f"| {outcome.statement.sentence} |" in line)
    words = row.replace("\\", "").replace("**", "")
    measured = f"| {outcome.statement.criterion} | {outcome.measured} | {outcome.verdict} |"
    # A rounding has other digits on other machines.
    rounding = re.compile(r"\d+e-1\d")
    assert rounding.sub("…", words).endswith(rounding.sub("…", measured))


def test_an_audit_says_what_its_variables_are(kept: Kept) -> None:
    points = [
        made_up_point(s_dense=1.5),
        made_up_point(s_body=1.1, body_y=0.5),
        made_up_point(s_surface=np.nan),
    ]
    found = audit_of(points, poisson_ratio=[0.3, 0.4, 0.5])
    kept("told_audit", told(found))
    kept("report_of_audit", report(found).splitlines())


def test_a_table_of_indices(kept: Kept) -> None:
    shares = np.linspace(0.1, 0.8, 8).reshape(2, 2, 2)
    dims = ("quantity", "normal_amplitude", "parameter")
    found = xr.Dataset(
        {
            f"{name}{end}": (dims, shares + by)
            for name in ("first_order", "total")
            for end, by in (("", 0), ("_low", -0.05), ("_high", 0.1))
        },
        {
            "quantity": ["s", "critical_x"],
            "normal_amplitude": [0.25, 0.5],
            "parameter": ["friction", "poisson_ratio"],
        },
        {"title": "Indices", "size": 8, "confidence": 0.9, "seed": 1},
    ).assign_coords(symbol=("parameter", [r"\mu", r"\nu"]))
    found = found.assign(
        mean=found.total.isel(parameter=0, drop=True), variance=found.total.isel(parameter=1, drop=True)
    )
    for of_paper in (False, True):
        kept(f"table_of_indices_{of_paper}".lower(), table(found, of_paper).splitlines())


#: Points whose maximum is on the line, off it, beneath a plane contact, at a sharp edge, and far away.
POINTS: dict[str, dict[str, Any]] = {
    "line": {"normal_amplitude": 0.5, "tangential_amplitude": 0.1, "phase": 0.6},
    "off": {"normal_amplitude": 0.5, "tangential_amplitude": 0.1, "phase": 0.6, "poisson_ratio": 0.5},
    "edge": {"profile": "truncated_paraboloid", "flat_radius": 0.5, "phase": 0.3},
    "plane": {
        "profile": "rounded_flat",
        "flat_half_width": 0.4,
        "normal_force_amplitude": 0.2,
        "tangential_force_amplitude": 0.3,
        "bulk_stress_amplitude": 0.05,
    },
    "far": {"bulk_stress_amplitude": 5.0, "tangential_amplitude": 0.0, "normal_amplitude": 0.0},
    "sliding": {"profile": "truncated_paraboloid", "flat_radius": 1, "friction": 1.2, "phase": 1.5},
}


@pytest.mark.parametrize("name", POINTS)
def test_the_audit_of_a_point(name: str, kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    """What it finds, and where it looks at first."""
    grid, _ = read_grid(POINTS[name], {})
    row = canonical_points(grid, np.zeros(1, int), fold=False)[0][0]
    looked: list[list[Any]] = []
    known = field.criterion_at

    def criterion_at(opened: Any, places: Any, *more: float) -> Any:
        looked.append([*map(numbers, places.T), *map(float, more)])
        return known(opened, places, *more)

    monkeypatch.setattr(field, "criterion_at", criterion_at)
    found = audit_point(row.tolist(), {}, dense=name in ("plane", "far"))
    said = dict(zip(found.dtype.names, map(float, found.tolist()), strict=True))
    said["regime"] = REGIMES[int(said["regime"])]
    assert said.pop("s_error") <= 1e-4 * said["s"] or name == "sliding"
    kept(f"audit_of_{name}", {"found": said, "looked": looked[:3]})


@pytest.mark.slow
def test_a_maximum_is_found_from_wherever_the_search_begins() -> None:
    """Also where the line's own maximum is given as another place, or as none."""
    points = read_point(POINTS["line"])
    best, _ = body_maximum(points, -1.0163704)
    for begin in (0.3, np.nan):
        found, at_line = body_maximum(points, begin)
        assert found.swt == pytest.approx(best.swt, rel=1e-4)
        np.testing.assert_allclose(np.abs(found.position), [1.0164, 0.0, 0.0], atol=2e-3)
    assert at_line.position[0] == np.inf
    assert at_line.swt == 0.0


def test_an_audit_is_saved_as_it_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    saved, shown, clock = [], [], iter(range(0, 1000, 11))

    class Shown:
        def __init__(self, total: int, words: str) -> None:
            shown.append((total, words))

        def add(self, count: int) -> None:
            shown.append(count)

        def __enter__(self) -> object:
            return self

        def __exit__(self, *_: object) -> None:
            pass

    monkeypatch.setattr("swtstudy.paper.audit.Progress", Shown)
    monkeypatch.setattr("swtstudy.paper.audit.audit_point", lambda *_, **__: made_up_point())
    monkeypatch.setattr("swtstudy.archive.workers.start_workers", ThreadPoolExecutor)
    monkeypatch.setattr("swtstudy.archive.archive.save", lambda found, _: saved.append(found.sizes["sample"]))
    monkeypatch.setattr("time.monotonic", lambda: float(next(clock)))
    study = swtstudy.Study.from_text('title = "t"\naxes.friction = [0.1, 0.2, 0.3, 0.4, 0.5]\n')
    found = swtstudy.audit_study(study, tmp_path / "mine.nc", points=5, seed=7, workers=1)
    assert shown == [(5, "mine"), 0, 1, 1, 1, 1, 1]
    assert saved == [2, 4, 5]  # every 20 seconds, of a clock that goes by 11, and at the end
    assert {key: found.attrs[key] for key in ("title", "seed")} == {"title": "t", "seed": 7}


def test_a_table_of_statements(kept: Kept) -> None:
    first, second, third = [*STATEMENTS.values()][:3]
    outcomes = [
        Outcome(first, "a | b", True),
        Outcome(second, "c", False),
        Outcome(third, problem="x.nc is missing"),
    ]
    kept("table_of_statements", markdown(outcomes).splitlines())
    assert summary(outcomes[:2]) == "2 statements: 1 hold, 1 do not"


def test_what_an_archive_lacks_is_a_problem_of_the_statement() -> None:
    found = about_archive("figure3", archive("figure3").isel(phase=0))
    assert {each.problem for each in found} == {"figure3: no axis phase in the archive"}
    assert {each.verdict for each in found} == {"not checked"}
    assert about_archive("mine", archive("figure3")) == []


def test_where_the_maxima_off_the_line_are_is_counted() -> None:
    off = {"s_body": 1.1, "s_surface": 1.1}
    kinds = [{}, {"body_z": 0.1}, {"body_z": 0.2}, {"body_y": 0.5}, *[{"normal_x": 0.8, "normal_y": 0.6}] * 3]
    points = [made_up_point(**(off | kind if kind else {})) for kind in kinds]
    found = STATEMENTS["on_the_line"](audit_of(points, poisson_ratio=[0.3] * 6 + [0.25]))
    assert found.measured == (
        "at 14.3% of 7 random points of all parameters the worst of all points and planes is on the line; "
        "beneath the surface 2, on an oblique plane 3, on the surface off the line 1, with swt up to 10.0% "
        "higher, for ν ≥ 0.25"
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("line_x", "nearest"), [(0.5001, 0.9e-4), (-0.4999, 0.9e-4), (0.9, 1e-3 * 1.75**0.5)]
)
def test_the_search_keeps_as_far_from_an_edge_as_the_line_does(
    line_x: float, nearest: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    points, b = read_point(POINTS["edge"]), 0.5
    distances: list[float] = []
    known = field.criterion_at

    def criterion_at(opened: Any, places: Any, *more: float) -> Any:
        away = np.abs(np.hypot(places[:, 0], places[:, 1]) - b)
        distances.append(float(away.min()) if len(away) > 100 else np.inf)
        return known(opened, places, *more)

    monkeypatch.setattr(field, "criterion_at", criterion_at)
    body_maximum(points, line_x)
    assert min(distances) == pytest.approx(nearest, rel=0.05)
