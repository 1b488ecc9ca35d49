"""s of recorded points (`tests/data/truth`), a stratified sample, through `solve` and `run`.

``python studies/checks/truth.py`` compares all of them.
"""

from dataclasses import replace

import numpy as np
import pytest
import truth

import swtstudy

#: Points of the sample: as many of each scene, all of it where it has fewer.
SAMPLE = 400
RTOL = 1e-4
#: Points that the present solver misses beyond s_error. A test fails as soon as one of them is right.
MISSED: tuple[str, ...] = ()
#: Scenes of which every point is a case of its own.
NAMED = ("turns within growth", "coincident phases")
SCENES = [scene for scene in truth.points() if scene not in NAMED]


def verdict(point: truth.Point) -> str:
    found = swtstudy.solve(**point.arguments, rtol=RTOL)
    return truth.verdict(point, float(found.s), float(found.s_error))


@pytest.mark.parametrize("scene", SCENES)
def test_recorded_values_are_reproduced(scene: str) -> None:
    every = truth.points()[scene]
    draw = np.random.default_rng(len(every)).permutation(len(every))[: SAMPLE // len(SCENES)]
    some = [every[k] for k in draw if every[k].name not in MISSED]
    found = truth.solved(some, RTOL)
    verdicts = map(truth.verdict, some, found["s"], found["s_error"])
    assert {point.name: word for point, word in zip(some, verdicts, strict=True) if word != "right"} == {}


#: Points that are cases of their own.
SINGLE = {
    point.name: point
    for scene, several in truth.points().items()
    for point in several
    if scene in NAMED or point.name in MISSED
}


@pytest.mark.parametrize("name", SINGLE)
def test_hard_points(name: str, request: pytest.FixtureRequest) -> None:
    if name in MISSED:
        request.applymarker(pytest.mark.xfail(strict=True, reason="a maximum that the search misses"))
    assert verdict(SINGLE[name]) == "right"


def test_a_lower_bound_is_no_upper_one() -> None:
    bound = replace(truth.points()["displacements"][0], kind="at_least")
    assert truth.verdict(bound, 2.0 * bound.s, 0.0) == "right"
    assert truth.verdict(bound, 0.999 * bound.s, 0.0) == "low"


def test_a_value_is_compared_both_ways() -> None:
    point = truth.points()["displacements"][0]
    found = [truth.verdict(point, share * point.s, 1e-5 * point.s) for share in (0.999, 1.0, 1.001)]
    assert found == ["low", "right", "high"]
