"""One point of a study: what is left of its axes, samples and blocks when values are chosen."""

from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from real import CONTACT, CRITERIA
from told import refused

from swtstudy import StudyError, inspect_point
from swtstudy.cli import main
from swtstudy.faces.contacts import PhysicalContact
from swtstudy.study.definition import one_of_study
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import DISTANCE

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

FORCES = {"normal_force_amplitude": "0.2", "tangential_force_amplitude": "0.3"}
BLOCKS = """
[loads.gentle]
absolute = true
vertices = [[200, 40], [200, -40]]
[loads.rough]
absolute = true
vertices = [[200, 80], [200, -80]]
[[blocks]]
load = "gentle"
rounds = 100
"""
MORE = '[[blocks]]\nload = "rough"\nrounds = 1\n'


def file_of(folder: Path, text: str) -> str:
    (folder / "rig.toml").write_text(text, encoding="utf-8")
    return str(folder / "rig.toml")


def test_a_profile_of_an_axis_has_its_own_shape_alone() -> None:
    """The study fixes the shapes of two other profiles."""
    found = one_of_study("plane_contacts", {"profile": "paraboloid", **FORCES})
    assert not {"flat_half_width", "exponent", "profile"} & {*found.axes}
    own = inspect_point(**found.fixed)
    same = inspect_point(phase="pi/2", **FORCES)
    np.testing.assert_array_equal(own.s_local, same.s_local)
    other = one_of_study("plane_contacts", {"profile": "power_law_cylinder", **FORCES})
    assert (other.fixed["exponent"], "flat_half_width" in other.fixed) == (4.0, False)
    with pytest.raises(StudyError, match=r"fixed.exponent: found 3, which no profile here has"):
        one_of_study("plane_contacts", {"profile": "paraboloid", "exponent": 3, **FORCES})


def test_every_axis_and_every_sampled_parameter_needs_a_value() -> None:
    words = r"several values of frequency_ratio, friction, .*, flat_radius; allow"
    refused(words, one_of_study, "sensitivity", {})
    given = {"frequency_ratio": "1/2", "friction": "0.3", "poisson_ratio": "0.3", "phase": "1"}
    given |= {"normal_amplitude": "0.5", "tangential_amplitude": "0.5"}
    refused("several values of flat_radius; allowed: one of each", one_of_study, "sensitivity", given)
    assert one_of_study("sensitivity", {**given, "flat_radius": "0.5"}).size == 1


def test_an_axis_of_one_value_has_that_value(tmp_path: Path) -> None:
    path = file_of(tmp_path, 'title = "t"\n[axes]\nfriction = [0.3]\nphase = [0, 1]\n')
    refused("several values of phase; allowed", one_of_study, path, {})
    assert one_of_study(path, {"phase": 1}).fixed["friction"] == 0.3
    assert one_of_study(path, {"phase": 1, "friction": 0.4}).fixed["friction"] == 0.4
    # The profile alone does not depend on the others.
    drawn = one_of_study("sensitivity", {"flat_radius": "0.5"}, at_rest=True)
    assert drawn.fixed["flat_radius"] == 0.5


@pytest.mark.parametrize("criterion", ["swt", "findley", "fatemi_socie"])
def test_a_criterion_of_an_axis_needs_no_constants_of_the_others(tmp_path: Path, criterion: str) -> None:
    contact = PhysicalContact(one_of_study(file_of(tmp_path, CRITERIA), {"criterion": criterion}))
    assert contact.parameters().get("criterion", "swt") == criterion
    assert contact.grid.yield_strengths == (350.0, 350.0)


def test_the_contact_of_one_load_of_blocks(tmp_path: Path) -> None:
    one = file_of(tmp_path, CONTACT + BLOCKS)
    assert str(one_of_study(one, {}).fixed["load"]) == "gentle"
    both = file_of(tmp_path, CONTACT + BLOCKS + MORE)
    refused("several values of load; allowed: one of each, such as --load VALUE", one_of_study, both, {})
    contact = PhysicalContact(one_of_study(both, {"load": "rough"}))
    assert str(contact.parameters()["load"]) == "rough"


def test_with_a_body_the_contact_is_drawn_under_a_load_not_the_load(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = []
    monkeypatch.setattr("swtstudy.figures.style.save_figure", lambda figure, *_: drawn.append(figure))
    both = file_of(tmp_path, CONTACT + BLOCKS + MORE)
    for more, panels in (((), 3), (("--body", "2"), 9)):
        done = CliRunner().invoke(
            main, ["show", both, "--load", "rough", *more, "-o", str(tmp_path / "a.png")]
        )
        assert done.exit_code == 0, done.stderr
        assert len([axes for axes in drawn[-1].axes if axes.get_title("left")]) >= panels
    assert len(drawn[0].axes) < len(drawn[1].axes)


@pytest.mark.slow
def test_each_axis_of_a_study_has_an_option(tmp_path: Path) -> None:
    """Those of contacts with units, too: the one that the message advises."""
    names = {*AXES} - {DISTANCE, "direction"}
    assert names <= {str(option.name) for option in main.commands["show"].params}
    sizes = {"young_modulus": "73.1e3", "radius": 50, "normal_force": 200, "bulk_stress_ratio": -1}
    axes = "".join(f"{name} = [{value}, {float(value) * 0.9}]\n" for name, value in sizes.items())
    text = CONTACT.replace("young_modulus = 73.1e3\n", "").replace("radius = 50\n", "")
    rig = file_of(
        tmp_path, f"{text}tangential_force_amplitude = 40\nbulk_stress_amplitude = 9\n[axes]\n{axes}"
    )
    refused(r"several values of young_modulus.*such as --young-modulus VALUE", one_of_study, rig, {})
    options = [word for name, value in sizes.items() for word in (f"--{name.replace('_', '-')}", str(value))]
    done = CliRunner().invoke(main, ["show", rig, *options, "-o", str(tmp_path / "a.png")])
    assert done.exit_code == 0, done.stderr
    # Of two one takes the place of the other.
    others = {"young_modulus": "73.1e3", "radius": 50, "depth": 1e-3, "bulk_stress_mean": 2}
    found = one_of_study(rig, {**others, "tangential_force_amplitude": 1})
    assert found.fixed["depth"] == 1e-3
    assert "normal_force" not in found.fixed
    assert "bulk_stress_ratio" not in found.fixed


def test_sizes_of_a_contact_need_a_study_with_units() -> None:
    done = CliRunner().invoke(main, ["show", "--normal-force", "200"])
    assert done.exit_code == 2
    assert "normal_force: found a parameter of real contacts; allowed: this in a study with" in done.stderr


def test_without_equilibrium_the_forces_are_said_in_the_units_of_the_study(tmp_path: Path) -> None:
    rig = file_of(tmp_path, f"{CONTACT}normal_force = 200\n[axes]\ntangential_force_amplitude = [60, 120]\n")
    words = (
        "tangential_force_amplitude: found no equilibrium: tangential_force_amplitude 120 N exceeds μ F_N "
    )
    words += "= 100 N; allowed: forces with |F_x| ≤ μ F_N and F_N ≥ 0 at every instant"
    done = CliRunner().invoke(main, ["show", rig, "--tangential-force-amplitude", "120"])
    assert (done.exit_code, done.stderr) == (2, f"Error: {words}\n")
    contact = PhysicalContact(one_of_study(rig, {"tangential_force_amplitude": 120}))
    for inspect in (
        contact.inspect_point,
        lambda: contact.stress_field(0, 0, 0),
        lambda: contact.swt_field(0, 0, 0),
    ):
        refused("tangential_force_amplitude 120 N exceeds", inspect)


def test_what_is_sampled_in_units_is_in_the_ranges_of_these(tmp_path: Path) -> None:
    """Forces of more than 10 N are none without units, and had no value."""
    sample = '[sample]\ndesign = "sobol"\nsize = 4\nranges.tangential_force_amplitude = [30, 60]\n'
    drawn = one_of_study(file_of(tmp_path, f"{CONTACT}normal_force = 200\n{sample}"), {}, at_rest=True)
    assert 30.0 <= drawn.fixed["tangential_force_amplitude"] <= 60.0
