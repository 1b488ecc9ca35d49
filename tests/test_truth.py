"""Recorded values (`tests/data/truth`), a stratified sample, through `solve`, `run` and their sisters.

``python studies/checks/truth.py`` compares all of them.
"""

from dataclasses import replace

import numpy as np
import pytest
import truth

import swtstudy

#: Points of the sample: as many of each scene, all of it where it has fewer.
SAMPLE = 520
RTOL = 1e-4
#: Points with a trap each, which are always tried: a narrow interval beside a wide one, on the line; next to
#: no slip; two instants with peaks within 4e-5 of each other, one of them between coarse instants; a
#: second plane that is highest within one half of a piece; pieces 180 times as long as the one beside them; a
#: steep density, whose one panel reaches from the axis to the position.
HARD = (
    "bulk stress, all controls 147",
    "phases next to 0 and π 422",
    "phases next to 0 and π 635",
    "phases next to 0 and π 987",
    "phases next to 0 and π 1232",
    "phases next to 0 and π 1673",
    "criteria of shear 171",
    "power law 647",
    "points of tests 61",
    "power law 213",
)
#: Scenes of which every point is a case of its own.
NAMED = (
    *("turns within growth", "coincident phases", "bulk stress turns within growth", "steep powers"),
    "bulk stress falls at a vertex",
)
SCENES = [scene for scene in truth.points() if scene not in NAMED]


def verdict(point: truth.Point, rtol: float) -> str:
    found = swtstudy.solve(**point.arguments, rtol=rtol)
    return truth.verdict(point, float(found.s), float(found.s_error))


@pytest.mark.parametrize("scene", SCENES)
def test_recorded_values_are_reproduced(scene: str) -> None:
    every = truth.points()[scene]
    draw = np.random.default_rng(len(every)).permutation(len(every))[: SAMPLE // len(SCENES)]
    verdicts = {point.name: verdict(point, RTOL) for point in (every[k] for k in draw)}
    assert {name: word for name, word in verdicts.items() if word != "right"} == {}


@pytest.mark.slow
def test_recorded_points_may_be_a_study() -> None:
    several = truth.points()["criteria of shear"][::40]
    found = truth.solved(several, RTOL)
    assert list(map(truth.verdict, several, found["s"], found["s_error"])) == ["right"] * len(several)


#: Points that are cases of their own.
SINGLE = {
    point.name: point
    for point in (
        *(each for scene in NAMED for each in truth.points()[scene]),
        *(truth.points()[name.rpartition(" ")[0]][int(name.rpartition(" ")[2])] for name in HARD),
    )
}


@pytest.mark.parametrize("rtol", [1e-2, RTOL, 1e-6])
@pytest.mark.parametrize("name", SINGLE)
def test_hard_points(name: str, rtol: float) -> None:
    assert verdict(SINGLE[name], rtol) == "right"


def test_a_lower_bound_is_no_upper_one() -> None:
    bound = replace(truth.points()["displacements"][0], kind="at_least")
    assert truth.verdict(bound, 2.0 * bound.s, 0.0) == "right"
    assert truth.verdict(bound, 0.999 * bound.s, 0.0) == "low"


def test_a_value_is_compared_both_ways() -> None:
    point = truth.points()["displacements"][0]
    found = [truth.verdict(point, share * point.s, 1e-5 * point.s) for share in (0.999, 1.0, 1.001)]
    assert found == ["low", "right", "high"]


CIRCLES, BODIES, MEANS = (truth.points(name) for name in ("circle", "body", "mean"))


def some_of(records: dict[str, tuple[truth.Point, ...]], each: int) -> list[object]:
    """Records of each scene, as many of each."""
    return [
        pytest.param(point, id=point.name)
        for several in records.values()
        for point in several[:: -(-len(several) // each)]
    ]


@pytest.mark.parametrize("point", some_of(CIRCLES, 2))
def test_the_largest_value_on_the_circle(point: truth.Point) -> None:
    found = swtstudy.solve(**point.arguments, rtol=RTOL)
    # The bound of s_surface is that of s.
    assert float(found.s_surface) == pytest.approx(point.s, rel=2.0 * RTOL)
    assert abs(float(found.critical_x)) == pytest.approx(abs(point.critical_x), abs=1e-3)


@pytest.mark.parametrize("point", some_of(BODIES, 2))
def test_the_field_has_the_largest_value_of_the_body(point: truth.Point) -> None:
    if "x" not in point.values:
        pytest.skip("the bulk stress alone, far from the contact")
    place = point.values["x"], point.values["y"], point.values["z"]
    assert truth.swt_at(point, place) == pytest.approx(point.s, rel=1e-4, abs=point.error)
    field = swtstudy.swt_field(*place, **point.arguments)
    # Its instants are few.
    assert float(field.s_local) == pytest.approx(point.s, rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("point", some_of(BODIES, 1)[::3])
def test_an_audit_finds_the_largest_value_of_the_body(point: truth.Point) -> None:
    assert truth.largest_in_body(point) == pytest.approx(point.s, rel=1e-4, abs=point.error)


#: The scenes whose first record takes longer than the second, and those of which both take long.
LONG_FIRST = ("rounded punch", "bulk stress")
LONG = ("power law", "Walker's exponent", "loops of 4 to 200 vertices", "wavy paraboloid", "forces")


@pytest.mark.parametrize(
    "point",
    [
        pytest.param(each, id=each.name, marks=[pytest.mark.slow] * (slow or scene in LONG))
        for scene, several in MEANS.items()
        for each, slow in zip(several[:2], (scene in LONG_FIRST, scene not in LONG_FIRST), strict=True)
    ],
)
def test_means_over_a_critical_distance(point: truth.Point) -> None:
    assert truth.off_means(point) == {}


#: Of the contacts' lives the one that hangs on where the bulk stress turns.
TURNING = 50


@pytest.mark.parametrize("number", [*range(0, 60, 12), TURNING])
def test_counted_cycles(number: int) -> None:
    known = truth.contacts()[number]
    found = known.found()
    np.testing.assert_allclose(found.shares, known.shares, rtol=5e-3)
    # With more damage the solver has found a worse place.
    assert 0.9 * known.cycles <= found.cycles <= 1.01 * known.cycles
