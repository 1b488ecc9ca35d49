"""Recorded values off the surface line (`tests/data/truth`): a sample of them, through `solve` alone."""

import pytest
import truth

import swtstudy

#: Points of each scene that are solved.
EACH = 2
CIRCLES = truth.points("circle")


@pytest.mark.parametrize("scene", CIRCLES)
def test_the_largest_value_on_the_circle(scene: str) -> None:
    every = CIRCLES[scene]
    for point in every[:: -(-len(every) // EACH)]:
        found = swtstudy.solve(**point.arguments, rtol=1e-4)
        # The bound of s_surface is that of s.
        assert float(found.s_surface) == pytest.approx(point.s, rel=2e-4), point.name
        assert abs(float(found.critical_x)) == pytest.approx(abs(point.critical_x), abs=1e-3), point.name
