"""The picture of a profile: what its curves are."""

import numpy as np
import pytest
from oracles import profiles as oracle

import swtstudy
from swtstudy.figures.profile import draw_profile


@pytest.mark.parametrize("indenter", [oracle.rounded_punch(0.5), oracle.power_law(1.5)], ids=str)
def test_curves(indenter: oracle.Indenter) -> None:
    sketch, springs = draw_profile(profile=indenter.profile, **indenter.shape).axes
    x, height = sketch.lines[0].get_data()
    at = np.searchsorted(x, 1.1)
    f = oracle.integral(indenter.f_slope, indenter.flat_radius, float(x[at]))
    assert height[at] == pytest.approx(f - 1.0, abs=1e-5)
    np.testing.assert_array_equal(height, height[::-1])
    depth, pressure = (line.get_data() for line in springs.lines if len(line.get_xdata()) > 2)
    # Both coordinates begin where the surfaces meet.
    arrows = [each for each in sketch.texts if each.get_text() == "" and each.xy[0] * each.xy[1] == 0.0]
    assert [each.xyann for each in arrows[:2]] == [(0.0, 0.0), (0.0, 0.0)]
    k = 900
    assert depth[1][k] == pytest.approx(indenter.depth(float(depth[0][k])), abs=1e-9)
    edge = springs.lines[1].get_xdata()[0]
    assert indenter.depth(edge) == pytest.approx(1.0, abs=1e-9)
    r = pressure[0][400]
    assert pressure[1][400] == pytest.approx(indenter.outer(r, edge)[0] / np.pi, abs=1e-7)


def test_a_table_is_drawn_with_its_points_and_its_fit() -> None:
    r = np.linspace(0.0, 2.0, 40)
    noisy = 0.5 * r * r + 1e-3 * np.cos(40.0 * r) * (r > 0.0)
    figure = draw_profile(profile=swtstudy.TabulatedProfile("pad", r, noisy, 1e-3))
    np.testing.assert_array_equal(figure.axes[0].lines[-1].get_ydata(), noisy - 1.0)
    assert "pad,  40 points, missed by" in figure.get_suptitle()


def test_a_load_is_no_part_of_a_profile() -> None:
    with pytest.raises(ValueError, match="friction: found a parameter of the load or the bodies"):
        draw_profile(profile="paraboloid", friction=0.3)


def test_lengths_of_a_shape_are_drawn():
    """b from the axis on; λ = Λ √h from one crest to the next, half a wave from the axis."""
    sketch = draw_profile(profile="rounded_punch", flat_radius=0.5).axes[0]
    (face,) = [text for text in sketch.texts if text.get_text() == "$b$"]
    assert face.get_position() == (0.25, -0.77)
    ends = [(text.xy[0], text.xyann[0]) for text in sketch.texts if text.get_text() == ""]
    assert (0.5, 0.0) in ends
    wavy = {"profile": "wavy_paraboloid", "waviness_amplitude": 0.01, "wavelength": 5.0}
    sketch = draw_profile(**wavy).axes[0]
    (words,) = [text for text in sketch.texts if "lambda" in text.get_text()]
    assert words.get_text() == r"$\lambda$, height $2h$ = 0.02 $\delta_0$"
    (arrow,) = [t for t in sketch.texts if t.get_text() == "" and t.xyann[0] == words.get_position()[0]]
    assert arrow.xy[0] - arrow.xyann[0] == pytest.approx(0.5)
    assert arrow.xyann[0] / 0.5 % 1.0 == pytest.approx(0.5)
    assert not [t for t in draw_profile(profile="paraboloid").axes[0].texts if "b$" in t.get_text()]
