"""Studies in units of the user's own: arrays in Python, loops, tables, samples and materials."""

import numpy as np
import pytest
import stand_in
import told
from command import merged
from real import ALUMINIUM, STUDY, plain, without
from scipy import constants
from told import refused

import swtstudy
from swtstudy import FatigueConstants, Study, open_results, physical, run

RIG = told.RIG | {"normal_amplitude": 2e-3}


@pytest.mark.slow
def test_arrays_in_python_are_the_study(solved):
    swings = {"normal_force": [150, 200], "tangential_amplitude": [1e-3, 2.5e-3], "phase": [0, "pi/2"]}
    contacts = physical(**RIG, **swings)
    asked = ["dissipation", "stick_radius", "contact_radius"]
    both = contacts.solve(1e-2, quantities=asked, critical_distance=0.05, constants=ALUMINIUM)
    assert both.s.dims == ("normal_force", "tangential_amplitude", "phase", "body")
    assert (both.SWT[..., 0] == both.SWT[..., 1]).all()
    found = both.sel(body=2)
    assert (
        repr(contacts).splitlines()[0]
        == "<PhysicalContact: 8 = 2 normal_force × 2 tangential_amplitude × 2 phase>"
    )
    assert {*found.data_vars} == {*solved.data_vars} - {"status", "run"}
    for name in found.data_vars:
        np.testing.assert_allclose(found[name], solved[name], rtol=1e-9, err_msg=name)
    pair = (ALUMINIUM, FatigueConstants(73.1e3, 800.0, -0.113, 0.409, -0.713))
    symbols = {"contact_radius": "a_0", "peak_pressure": "p_0", "depth": r"\delta_0"}
    assert {name: found[name].attrs["symbol"] for name in symbols} == symbols
    sizes = {name: value for name, value in RIG.items() if name != "radius"}
    deeper = physical(**sizes, radius=[50.0, 60.0], depth=[1e-3, 2e-3], tangential_amplitude=1e-3)
    assert repr(deeper).splitlines()[0] == "<PhysicalContact: 4 = 2 radius × 2 depth>"
    both = physical(**RIG, normal_force=[150.0], tangential_amplitude=1e-3).solve(1e-3, constants=pair)
    assert both.cycles.dims == ("normal_force", "body")
    assert both.cycles[0, 1] < both.cycles[0, 0]
    assert both.SWT[0, 1] == both.SWT[0, 0]


def test_an_axis_of_contacts_without_effect_is_warned_of():
    still = RIG | {"normal_amplitude": 0, "normal_force": 150, "tangential_amplitude": 1e-3, "phase": [0, 1]}
    with pytest.warns(UserWarning, match="^phase has no effect: what it is of does not oscillate"):
        physical(**still).solve(1e-2)


def test_a_contact_in_a_notebook():
    contact = physical(**RIG, tangential_amplitude=1e-3, normal_force=200.0)
    text = contact._repr_html_()
    for words in ("73100", "<b>radius</b></td><td>50<", "0.567588", "296.418", "0.310408", "δA/δ0"):
        assert words in text, words
    assert "bulk_stress" not in text
    assert "waviness" not in text


LOOP = """
[loads.cycle]
vertices = [[0, -60, 10], [20, -60, 30], [20, 60, 30], [0, 60, -10]]
"""


def test_the_columns_of_a_loop_are_in_newtons_and_megapascals(tmp_path):
    text = without(
        STUDY, "critical_distance", "normal_amplitude", "tangential_amplitude", "phase", "[figure]"
    )
    text = without(text, "x =", "hue =", "panels =", "y =", "quantities")
    loop = "normal_force_amplitude = 1\ntangential_force_amplitude = 1\nload = 'cycle'\n[axes]"
    study = Study.from_text(text.replace("[axes]", loop) + LOOP)
    numbers = study.grid.numbers
    np.testing.assert_allclose(numbers["normal_amplitude"], [1 / 150, 1 / 200])
    np.testing.assert_allclose(numbers["tangential_amplitude"], [1 / 75, 1 / 100])
    stress = numbers["bulk_stress_amplitude"]
    p0 = physical(**RIG, tangential_amplitude=0, normal_force=150.0).peak_pressure
    np.testing.assert_allclose(stress[0], 1 / (np.pi * p0 / 2))
    assert (numbers["bulk_strain_share"] == [1.0, -1.0]).all()  # that of the first body
    found = run(study, tmp_path / "loop.nc", workers=1)
    vertices = np.array([[0, -60, 10], [20, -60, 30], [20, 60, 30], [0, 60, -10]])
    factors = dict.fromkeys(
        ("normal_force_amplitude", "tangential_force_amplitude", "bulk_stress_amplitude"), 1.0
    )
    alone = physical(**told.RIG, normal_force=200.0, load=swtstudy.LoadPath("cycle", vertices), **factors)
    np.testing.assert_allclose(found.SWT[1], alone.solve(1e-2).SWT, rtol=1e-6)


PAD = """
[profiles.pad]
radius = [0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6]
height = [0, 4e-4, 1.6e-3, 3.6e-3, 6.4e-3, 1e-2, 1.44e-2, 1.96e-2, 2.56e-2]
"""


@pytest.mark.slow
def test_a_table_in_lengths_is_a_profile(tmp_path):
    """f = r²/(2 · 50): the table of the paraboloid of R = 50."""
    text = plain("critical_distance", "radius = 50")
    text = text.replace('phase = [0, "pi/2"]', "").replace("[axes]", "profile = 'pad'\n[axes]")
    found = run(Study.from_text(text + PAD), tmp_path / "pad.nc", workers=1)
    smooth = text.replace("profile = 'pad'", "radius = 50")
    like = run(Study.from_text(smooth), tmp_path / "like.nc", workers=1)
    for name in ("SWT", "contact_radius", "peak_pressure", "depth", "dissipation", "cycles"):
        np.testing.assert_allclose(found[name], like[name], rtol=1e-4, atol=1e-9, err_msg=name)
    assert open_results(tmp_path / "pad.nc").identical(found)


def test_a_sample_of_what_is_known_badly(tmp_path):
    text = without(
        STUDY, "critical_distance", "friction", "normal_force", "tangential", "phase", "[axes]", "[figure]"
    )
    text = without(text, "x =", "hue =", "panels =", "y =", "quantities")
    text += """
tangential_amplitude = 1e-3
[sample]
design = "sobol"
size = 4
[sample.ranges]
friction = [0.3, 0.6]
normal_force = { distribution = "normal", mean = 200, deviation = 20 }
"""
    study = Study.from_text(text)
    found = run(study, tmp_path / "sample.nc", workers=1)
    assert found.SWT.dims == ("sample",)
    assert found.normal_force.attrs["units"] == "N"
    e_star = 73.1e3 / (2 * (1 - 0.33**2))
    np.testing.assert_allclose(found.contact_radius**3, 0.75 * found.normal_force * 50 / e_star)
    again = Study.from_text(merged(tmp_path / "sample.nc").attrs["study"])
    assert again.grid.samples == study.grid.samples


MATERIALS = """
[weak]
strength = 600
strength_exponent = -0.1
ductility = 0.2
ductility_exponent = -0.6
source = "nobody"
[strong]
young_modulus = 70e3
strength = 1200
strength_exponent = -0.1
ductility = 0.2
ductility_exponent = -0.6
"""


def test_materials_come_by_name_from_a_file(tmp_path):
    (tmp_path / "materials.toml").write_text(MATERIALS)
    start, rest = STUDY.split("[material]")[0], STUDY[STUDY.index("[fixed]") :]
    rest = without(rest[: rest.index("[figure]")], "critical_distance")

    def study(table):
        return Study.from_text(f"{start}[material]\n{table}\n{rest}", "mine.toml", tmp_path)

    both = study('file = "materials.toml"\nname = ["weak", "strong"]')
    grid = both.grid
    assert grid.materials == (
        FatigueConstants(73.1e3, 600.0, -0.1, 0.2, -0.6),
        FatigueConstants(70e3, 1200.0, -0.1, 0.2, -0.6),
    )
    assert grid.dims[-1] == "body"
    assert stand_in.distinct(both) == 8  # s is that of both
    for table, words in (
        ('file = "materials.toml"\nname = "wek"', "material.name: found 'wek'; allowed: a material in"),
        ('file = "materials.toml"', "material.name: found nothing; allowed: a material in materials.toml"),
    ):
        error = refused("", study, table)
        assert str(error).startswith(f"mine.toml: {words}"), error
        assert len(error.mistakes) == 1


#: Units in m, N and Pa.
PREFIXES = {"k": 1e3, "M": 1e6, "G": 1e9, "c": 1e-2, "m": 1e-3, "µ": 1e-6, "μ": 1e-6, "u": 1e-6, "n": 1e-9}
INCHES = {"in": constants.inch, "ft": constants.foot}
POUNDS = {"lbf": constants.lbf, "kip": 1e3 * constants.lbf, "kgf": constants.kgf}
STRESSES = {"N/mm²": 1e6, "N/mm2": 1e6, "psi": constants.psi, "ksi": 1e3 * constants.psi}


@pytest.mark.parametrize(
    ("length", "force", "stress", "value"),
    [
        *((f"{letter}m", "N", "Pa", size**-2.0) for letter, size in PREFIXES.items() if letter not in "kMG"),
        *((name, "N", "Pa", size**-2.0) for name, size in INCHES.items()),
        *(("m", f"{letter}N", "Pa", PREFIXES[letter]) for letter in "kMm"),
        *(("m", name, "Pa", size) for name, size in POUNDS.items()),
        *(("m", "N", f"{letter}Pa", 1.0 / PREFIXES[letter]) for letter in "kMG"),
        *(("m", "N", name, 1.0 / size) for name, size in STRESSES.items()),
    ],
)
def test_known_units_are_those_of_scipy(length, force, stress, value):
    """A set that is not consistent is told with its ratio, to three digits."""
    text = STUDY
    for old, new in (("mm", length), ("N", force), ("MPa", stress)):
        text = text.replace(f'= "{old}"', f'= "{new}"')
    told = str(refused(f"units: found {force} over {length}², which is", Study.from_text, text))
    assert f"which is {value:.3g} {stress}; allowed: a consistent set" in told
