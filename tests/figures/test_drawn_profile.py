"""The picture of a profile: what its curves are."""

from pathlib import Path

import numpy as np
import pytest
from command import call
from matplotlib.figure import Figure
from matplotlib.ticker import ScalarFormatter
from oracles import profiles as oracle

import swtstudy
from swtstudy import draw_profile

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


@pytest.mark.slow
@pytest.mark.parametrize("indenter", [oracle.rounded_punch(0.5), oracle.power_law(1.5)], ids=str)
def test_curves(indenter: oracle.Indenter) -> None:
    sketch, springs = draw_profile(profile=indenter.profile, **indenter.shape).axes
    x, height = sketch.lines[0].get_data()
    at = np.searchsorted(x, 1.1)
    f = oracle.integral(indenter.f_slope, indenter.flat_radius, float(x[at]))
    assert height[at] == pytest.approx(f - 1.0, abs=1e-5)
    np.testing.assert_array_equal(height, height[::-1])
    assert (sketch.get_xlabel(), sketch.get_ylabel()) == ("$x/a_H$", r"$-z/\delta_0$")
    depth, pressure = (line.get_data() for line in springs.lines if len(line.get_xdata()) > 2)
    # Both coordinates begin where the surfaces meet.
    arrows = [each for each in sketch.texts if each.get_text() == "" and each.xy[0] * each.xy[1] == 0.0]
    assert [each.xyann for each in arrows[:2]] == [(0.0, 0.0), (0.0, 0.0)]
    (push,) = [each for each in sketch.texts if each.get_text() == "" and each.xy[1] == each.xyann[1] > 0.0]
    assert sketch.get_xlim()[0] < push.xyann[0] < push.xy[0] < 0.0
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


@pytest.mark.slow
def test_lengths_of_a_shape_are_drawn():
    """b from the axis on; λ = Λ √h from one crest to the next, half a wave from the axis."""
    sketch = draw_profile(profile="rounded_punch", flat_radius=0.5).axes[0]
    (face,) = [text for text in sketch.texts if text.get_text() == "$b$"]
    assert face.get_position() == (0.25, -0.77)
    ends = [(text.xy[0], text.xyann[0]) for text in sketch.texts if text.get_text() == ""]
    assert (0.5, 0.0) in ends
    wavy = {"profile": "wavy_cylinder", "waviness_amplitude": 0.01, "wavelength": 5.0}
    sketch = draw_profile(**wavy).axes[0]
    (words,) = [text for text in sketch.texts if "lambda" in text.get_text()]
    assert words.get_text() == r"$\lambda$, height $2h$ = 0.02 $\delta_0$"
    (arrow,) = [t for t in sketch.texts if t.get_text() == "" and t.xyann[0] == words.get_position()[0]]
    assert arrow.xy[0] - arrow.xyann[0] == pytest.approx(0.5)
    assert arrow.xyann[0] / 0.5 % 1.0 == pytest.approx(0.5)
    assert not [t for t in draw_profile(profile="paraboloid").axes[0].texts if "b$" in t.get_text()]


RIG = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "friction": 0.5, "normal_force": 200.0}


def shown(axis):
    """The numbers at the ticks of an axis, and where these are."""
    words = [label.get_text().replace("−", "-") for label in axis.get_ticklabels()]
    return np.array([float(word) for word in words]), np.array(axis.get_ticklocs())


def test_a_profile_of_a_real_contact_has_its_lengths():
    """Hertz: δ0 = a²/R, p0 = 3F/(2πa²)."""
    contact = swtstudy.physical(**RIG, radius=50.0, tangential_amplitude=0.0)
    figure = contact.draw_profile()
    sketch, springs, pressures = figure.axes
    assert "$R$ = 50" in figure.get_suptitle()
    assert "\\mu" not in figure.get_suptitle()
    a, δ0 = contact.contact_radius, contact.contact_radius**2 / 50.0
    p0 = 3.0 * 200.0 / (2.0 * np.pi * a**2)
    radius, at = shown(springs.xaxis)
    np.testing.assert_allclose(radius, a * at, rtol=1e-5)  # a = a_H
    numbers, at = shown(pressures.yaxis)
    (p,) = [line for line in springs.lines if line.get_label() == "$p$"]
    largest = p.get_ydata().max()
    np.testing.assert_allclose(numbers, at * p0 / largest, rtol=1e-4)
    for axis in (springs.yaxis, sketch.yaxis):
        numbers, at = shown(axis)
        np.testing.assert_allclose(numbers, δ0 * at, rtol=1e-4)
    assert pressures.get_ylim() == springs.get_ylim()


def test_a_plane_profile_of_a_real_contact_has_lengths_and_pressures_but_line_loads_over_the_mean():
    """Hertz: p0 = 2P/(πa), the line load P per thickness."""
    contact = swtstudy.physical(**RIG, profile="cylinder", radius=50.0, tangential_force_amplitude=10.0)
    _, springs, pressures = contact.draw_profile().axes
    half_width, at = shown(springs.xaxis)
    np.testing.assert_allclose(half_width, contact.contact_radius * at, rtol=1e-5)
    # N is over that of the mean line load whatever the units are.
    assert isinstance(springs.yaxis.get_major_formatter(), ScalarFormatter)
    assert springs.lines[0].get_label() == "$N/P_0$"
    (p,) = [line for line in springs.lines if line.get_label() == "$p$"]
    numbers, at = shown(pressures.yaxis)
    largest = 2.0 * 200.0 / (np.pi * contact.contact_radius)
    np.testing.assert_allclose(numbers, at * largest / p.get_ydata().max(), rtol=1e-4)


STUDY = """
title = "A worn tip"
[units]
length = "mm"
force = "N"
stress = "MPa"
[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
friction = 0.5
normal_force = 200
[axes]
tangential_force_amplitude = [30, 60]
"""


def test_the_command_draws_a_table_with_a_study(tmp_path, monkeypatch):
    rows = np.random.default_rng(0).normal(0.0, 2e-5, 80) * (np.arange(80) > 0)
    radius = np.linspace(0.0, 2.0, 80)
    table = np.stack([radius, radius**2 / 100.0 + rows], axis=1)
    monkeypatch.chdir(tmp_path)
    np.savetxt("tip.csv", table, delimiter=",", header="radius,height", comments="")
    Path("rig.toml").write_text(STUDY, encoding="utf-8")
    drawn = []
    own = "swtstudy.faces.contacts.PhysicalContact.draw_profile"
    monkeypatch.setattr(own, lambda contact, **_: drawn.append(contact) or Figure())
    arguments = ["show", "rig.toml", "--profile", "tip.csv", "--smoothing", "2e-5"]
    done = call(*arguments)
    assert done.exit_code == 0, done.stderr
    (contact,) = drawn
    (table,) = contact.grid.values("profile")
    assert (table.name, table.smoothing, table.radius[-1]) == ("tip", 2e-5, 2.0)
    rough = call(*arguments[:4])
    assert rough.exit_code == 2
    assert "if its heights are noisy, smoothing takes that away" in rough.stderr
    still_rough = call(*arguments[:-1], "1e-12")
    assert "; its smoothing is 1e-12: more takes noise away, less leaves its shape" in still_rough.stderr
    none = call("show", "rig.toml", "--profile", "paraboloid", "--smoothing", "1")
    assert "smoothing: found 1 of 'paraboloid'; allowed: for a table alone" in none.stderr
