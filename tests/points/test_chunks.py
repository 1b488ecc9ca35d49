"""Values of points as arrays: cut into chunks, put together, found again, and of runs that can be used."""

from typing import Any

import numpy as np
import stand_in
from real import RIG

from swtstudy import Study
from swtstudy.points.chunk import (
    Found,
    Run,
    blank,
    cut,
    join,
    look_up,
    matching,
    put,
    solve_chunk,
    stacked,
    task_of,
)
from swtstudy.points.grid import ROW, Distinct
from swtstudy.vocabulary.quantities import NOTHING, Request

NAN = np.nan
COMPUTED, FAILED, MISSING = range(3)


def distinct(text: str) -> Distinct:
    return Distinct.of(Study.from_text(f'title = "t"\n{text}\n').grid)


def rows_of(*phases: float) -> Any:
    rows = np.zeros(len(phases), ROW)
    rows["phase"] = phases
    return rows


def run_of(version: str = "1", rtol: float = 1e-3, *quantities: str) -> Run:
    return Run(version, rtol, "study", "versions", quantities=quantities)


def found_of(
    phases: list[float], runs: tuple[Run, ...], run: list[int], status: list[int], **more: Any
) -> Found:
    arrays = blank(len(phases)) | {"row": rows_of(*phases), "run": np.array(run), "status": np.array(status)}
    return Found(arrays | {name: np.array(values) for name, values in more.items()}, runs)


def test_chunks_have_equal_work_and_long_cycles_come_first() -> None:
    points = distinct('axes.frequency_ratio = ["40/39", 1, "20/21"]\naxes.friction = [0.1, 0.2, 0.3, 0.4]')
    pieces = points.rows["p"] + points.rows["q"]
    every = np.ones(len(points.rows), bool)
    found = [pieces[each].tolist() for each in cut(points, every, NOTHING)]
    assert found == [[79], [79, 79], [79, 41], [41, 41, 41, 2, 2, 2, 2]]
    assert sorted(np.concatenate(cut(points, every, NOTHING)).tolist()) == [*range(12)]
    assert [each.size for each in cut(points, pieces == 2, NOTHING)] == [4]
    # A point of which means over the body are asked counts as sixteen pieces at least.
    means = Request((), (0.1,))
    assert [each.size for each in cut(points, every, means)] == [1, 2, 2, 5, 2]
    many = distinct("axes.friction = { start = 0.1, stop = 0.9, num = 20 }")
    every = np.ones(20, bool)
    assert [each.size for each in cut(many, every, NOTHING)] == [20]
    for asked in (means, Request(("von_mises",))):
        assert [each.size for each in cut(many, every, asked)] == [8, 8, 4]
    two = distinct('axes.profile = ["paraboloid", "rounded_punch"]\nfixed.flat_radius = 0.5')
    tasks = [task_of(two, each, NOTHING) for each in cut(two, np.ones(2, bool), NOTHING)]
    assert [own.profile for own, _ in tasks] == ["paraboloid", "rounded_punch"]
    assert cut(two, np.zeros(2, bool), NOTHING) == []


def test_a_point_that_fails_does_so_alone() -> None:
    points = distinct("axes.friction = [0.1, 0.2, 0.3]")
    (chunk,) = cut(points, np.ones(3, bool), NOTHING)

    def failing(own: stand_in.Points, rtol: float) -> stand_in.Solution:
        return stand_in.fail_at(0.2, own, rtol)

    for solver, message in (
        (failing, "ZeroDivisionError: an injected failure"),
        (lambda own, rtol: stand_in.lose_at(0.2, own, rtol), "ArithmeticError: the solver found no value"),
    ):
        _, found = solve_chunk(*task_of(points, chunk, NOTHING), 1e-3, solver)
        assert found["status"].tolist() == [COMPUTED, FAILED, COMPUTED]
        assert found["message"].tolist() == ["", message, ""]
        assert np.isfinite(found["s"]).tolist() == [True, False, True]
        assert (found["seconds"] > 0.0).all()
        assert found["run"].tolist() == [-1, -1, -1]


def test_arrays_are_put_together() -> None:
    one, other = blank(1, COMPUTED), blank(2, FAILED, "why")
    assert (one["status"].tolist(), other["status"].tolist()) == ([0], [1, 1])
    assert (other["message"].tolist(), other["seconds"].tolist()) == (["why"] * 2, [0.0] * 2)
    assert [str(other[name].dtype) for name in ("regime", "status", "run")] == ["int8", "int8", "int32"]
    one["wide"], other["wide"] = np.array([[1.0]]), np.array([[2.0, 3.0], [4.0, 5.0]])
    other["own"] = np.array([6.0, 7.0])
    found = stacked([one, other])
    np.testing.assert_array_equal(found["wide"], [[1.0, NAN], [2.0, 3.0], [4.0, 5.0]])
    np.testing.assert_array_equal(found["own"], [NAN, 6.0, 7.0])
    put(found, np.array([0, 2]), {"s": np.array([8.0, 9.0]), "new": np.array([[1.0, 2.0], [3.0, 4.0]])})
    np.testing.assert_array_equal(found["s"], [8.0, NAN, 9.0])
    np.testing.assert_array_equal(found["new"], [[1.0, 2.0], [NAN, NAN], [3.0, 4.0]])


def test_runs_are_numbered_anew() -> None:
    first, second, third = run_of("1"), run_of("2"), run_of("3")
    one = found_of([1.0, 2.0, 3.0], (first, second, third), [2, -1, 0], [0, 2, 0])
    taken = one.take([0, 1])
    assert (taken.runs, taken["run"].tolist(), taken["row"]["phase"].tolist()) == (
        (third,),
        [0, -1],
        [1.0, 2.0],
    )
    assert one.take([2, 0])["run"].tolist() == [0, 1]
    both = join([one, found_of([4.0], (third,), [0], [0])])
    assert (both.runs, both["run"].tolist(), len(both)) == ((first, second, third), [2, -1, 0, 2], 4)
    assert (len(join([])), join([]).runs) == (0, ())
    assert run_of().to_json().keys() == {"solver_version", "rtol", "study", "versions", "started", "seconds"}
    assert run_of("1", 1e-3, "a").to_json()["quantities"] == ("a",)


def test_which_values_can_be_used() -> None:
    runs = (run_of("1", 1e-3), run_of("1", 1e-4, "von_mises"), run_of("2", 1e-4))
    found = found_of([0.0] * 6, runs, [0, 1, 2, 1, -1, 1], [0, 0, 0, 1, 2, 2])
    assert found.usable(1e-3, "1").tolist() == [True, True, False, True, False, False]
    assert found.usable(1e-4, "1").tolist() == [False, True, False, True, False, False]
    assert found.usable(1e-3, "1", retry_failed=True).tolist() == [True, True, False, False, False, False]
    assert found.lacking(Request(("von_mises",))).tolist() == [True, False, True, False, False, False]
    assert found.lacking(NOTHING).tolist() == [False] * 6
    means = run_of("1", 1e-3, *Request((), (0.1,)).items)
    known = found_of([0.0] * 3, (means,), [0, 0, 0], [0, 0, 1], distance=[[0.1], [NAN], [NAN]])
    assert known.lacking(Request((), (0.1,))).tolist() == [False, True, False]
    del known.arrays["distance"]
    assert known.lacking(Request((), (0.1,))).tolist() == [True, True, False]


def test_the_best_of_several_values_is_found() -> None:
    runs = (run_of("1", 1e-3), run_of("1", 1e-4), run_of("1", 1e-3, "a", "b"))
    found = found_of(
        [1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0], runs, [0, 1, 2, 1, 0, 0, 1, 0], [0, 0, 0, 0, 0, 0, 1, 0]
    )
    rows, every = rows_of(4.0, 1.0, 5.0, 2.0, 3.0), np.ones(8, bool)
    assert look_up(rows, found, every).tolist() == [7, 1, -1, 2, 5]
    assert look_up(rows, found, np.arange(8) < 7).tolist() == [6, 1, -1, 2, 5]
    assert look_up(rows, found, ~every).tolist() == [-1] * 5
    assert look_up(rows[:0], found, every).tolist() == []


def test_means_are_found_by_row_and_distance() -> None:
    """One row may stand for contacts of several sizes."""
    run = run_of()
    known = found_of([1.0, 2.0, 2.0], (run,), [0, 0, 0], [0, 0, 0], s=[5.0, 6.0, 7.0],
                     distance=[[0.1, 0.2], [0.2, NAN], [0.3, 0.1]],
                     s_volume=[[1.0, 2.0], [3.0, NAN], [4.0, 5.0]])  # fmt: skip
    points = Distinct(
        rows_of(2.0, 1.0, 3.0),
        np.array([[0.1, 0.2], [0.2, 0.5], [0.1, 0.2]]),
        np.arange(3),
        np.zeros(3, bool),
        {},
    )
    found = matching(points, known, np.ones(3, bool))
    np.testing.assert_array_equal(found["s"], [7.0, 5.0, NAN])
    assert (found["status"].tolist(), found["run"].tolist(), found.runs) == ([0, 0, 2], [0, 0, -1], (run,))
    np.testing.assert_array_equal(found["distance"], [[0.1, 0.2], [0.2, NAN], [NAN, NAN]])
    np.testing.assert_array_equal(found["s_volume"], [[5.0, 3.0], [2.0, NAN], [NAN, NAN]])
    without = matching(points, known, np.array([True, True, False]))
    np.testing.assert_array_equal(without["s_volume"], [[NAN, 3.0], [2.0, NAN], [NAN, NAN]])


def test_a_distance_is_told_in_the_size_of_its_contact() -> None:
    text = RIG.replace('load = "rig"\n', "tangential_amplitude = 1e-3\ncritical_distance = 0.1\n")
    study = Study.from_text(f"{text}[axes]\ndepth = [0.01, 0.04]\n")
    points = Distinct.of(study.grid, study.asked)
    np.testing.assert_allclose(
        points.distances[points.index, 0], 0.1 / np.sqrt(50.0 * np.array([0.01, 0.04]))
    )
    some = Distinct.of(study.grid, study.asked, np.array([1]))
    assert (len(some.rows), some.index.tolist(), some.mirrored.tolist()) == (1, [0], [False])
