"""The picture of a profile: what its curves are."""

from pathlib import Path

import numpy as np
import pytest
from command import call
from matplotlib.figure import Figure
from real import UNITS

import swtstudy
from swtstudy import draw_profile

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


def test_a_load_is_no_part_of_a_profile() -> None:
    with pytest.raises(ValueError, match="friction: found a parameter of the load or the bodies"):
        draw_profile(profile="paraboloid", friction=0.3)


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


STUDY = f"""
title = "A worn tip"
{UNITS}[fixed]
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
