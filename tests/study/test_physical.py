"""Real contacts against Hertz, Cattaneo and Mindlin, and the strain–life relation itself."""

import inspect
import math
import re
import runpy
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import told
import xarray as xr
from command import call
from folders import STUDIES
from oracles.profiles import INDENTERS
from scipy.integrate import trapezoid
from told import refused, sayings

import swtstudy
from swtstudy import FatigueConstants, physical
from swtstudy.vocabulary.choices import CRITERIA

LABELLED = xr.DataArray([0.1, 0.2], {"body": [1, 2]})
STEEL = FatigueConstants(
    young_modulus=207e3, strength=1758.0, strength_exponent=-0.0977, ductility=2.12, ductility_exponent=-0.774
)
ALUMINIUM = told.RIG
#: A depth and a tangential amplitude, in mm.
LOADED = {"depth": 0.01, "tangential_amplitude": 0.002}
WAVES = {"profile": "wavy_paraboloid", "waviness_amplitude": 2e-4, "wavelength": 0.7}


def test_hertz():
    force, e_star = 200.0, 73.1e3 / (2 * (1 - 0.33**2))
    contact = physical(**ALUMINIUM, normal_force=force, tangential_amplitude=1e-3)
    radius = (3 * force * 50.0 / (4 * e_star)) ** (1 / 3)
    assert contact.moduli.normal == pytest.approx(e_star)
    assert contact.contact_radius == pytest.approx(radius)
    assert contact.depth == pytest.approx(radius**2 / 50.0)
    assert contact.peak_pressure == pytest.approx(3 * force / (2 * math.pi * radius**2))
    assert contact.mean_pressure == pytest.approx(contact.peak_pressure / 1.5)
    assert contact.normal_force == pytest.approx(force)


def test_the_tangential_amplitude_is_mindlins():
    """Under a constant normal force the contact slides at u = μ E* δ0/G* = 3 μ N/(8 G* a) · 2."""
    contact = physical(**ALUMINIUM, depth=0.01, tangential_amplitude=0.002)
    g_star = 4 * (73.1e3 / 2.66) / (2 * (2 - 0.33))
    full = 3 * 0.5 * contact.normal_force / (4 * g_star * contact.contact_radius)
    assert contact.parameters()["tangential_amplitude"] == pytest.approx(0.002 / full)
    assert contact.moduli.tangential / contact.moduli.normal == pytest.approx((2 - 2 * 0.33) / (2 - 0.33))


def test_swt_of_a_sliding_contact_in_numbers():
    """δA = 0 at the onset of sliding: SWT from Hamilton's stress at the trailing edge, with the body's E."""
    nu, mu, e = 0.33, 0.5, 73.1e3
    contact = physical(**ALUMINIUM, normal_force=200.0, tangential_amplitude=0.001)
    contact = contact.with_parameters(tangential_amplitude=1)
    p0 = contact.peak_pressure
    normal = (1 - 2 * nu) / 3 * p0
    drag_x, drag_y = math.pi * mu * (4 + nu) / 8 * p0, math.pi * mu * 3 * nu / 8 * p0
    # At x = a: σ_xx = normal ± drag_x, σ_yy = −normal ± drag_y, σ_zz = 0.
    amplitude = (drag_x - nu * drag_y) / e
    found = contact.solve(rtol=1e-5)
    assert found.SWT.values == pytest.approx([(normal + drag_x) * amplitude] * 2, rel=1e-4)
    assert abs(found.critical_position.values) == pytest.approx([contact.contact_radius] * 2, rel=1e-6)
    np.testing.assert_allclose(found.SWT_error / found.SWT, found.s_error / found.s)
    own = {name: found[name].attrs for name in ("SWT", "SWT_error", "critical_position")}
    symbols = [r"\mathrm{SWT}", r"\Delta \mathrm{SWT}", "x"]
    assert [attributes["symbol"] for attributes in own.values()] == symbols
    assert own["critical_position"]["units"] == "unit of length"
    assert own["SWT"]["ancillary_variables"] == "SWT_error regime"
    assert not {"comment", "ancillary_variables"} & {*own["SWT_error"], *own["critical_position"]}
    assert "comment" not in own["SWT"]
    assert found.s.attrs["symbol"] == "s"


def test_each_of_two_equal_bodies_has_half_of_swt0_s():
    contact = physical(**ALUMINIUM, depth=0.01, tangential_amplitude=0.002, normal_amplitude=0.004)
    s = float(swtstudy.solve(**contact.parameters()).s)
    assert float(contact.swt(s)) == pytest.approx(0.5 * s * contact.moduli.normal * 0.01 / 50.0)


def test_bodies_of_different_stiffness():
    # (1 − 2ν)/G alike, E not: steel-like against something with a higher Poisson ratio.
    shear = 80e3
    other = shear * (1 - 2 * 0.4) / (1 - 2 * 0.3)
    young = (2 * shear * 1.3, 2 * other * 1.4)
    own = {"young_modulus": young, "poisson_ratio": (0.3, 0.4), "radius": 10.0, "friction": 0.3}
    contact = physical(**own, depth=0.01, tangential_amplitude=0.003)
    assert contact.moduli.mismatch == pytest.approx(0.0, abs=1e-12)
    found = contact.solve(rtol=1e-3)
    for body, nu in enumerate((0.3, 0.4)):
        s = float(swtstudy.solve(**contact.parameters(body + 1), rtol=1e-3).s)
        assert found.poisson_ratio.values[body] == nu
        expected = s * contact.stress_scale**2 / young[body] * (1 - nu**2)
        assert float(found.SWT[body]) == pytest.approx(expected)


def test_each_body_has_its_own_life():
    """The same stress strains the softer body more: its SWT is higher by E1/E2, its life shorter."""
    contact = physical(**ALUMINIUM | LOADED | {"young_modulus": (210e3, 180e3)})
    found = contact.solve(rtol=1e-2)
    assert found.s.dims == ("body",)
    stiff, soft = contact.swt(found.s)
    assert float(soft / stiff) == pytest.approx(210 / 180)
    assert soft.attrs["long_name"] == "SWT"
    lives = contact.cycles(STEEL, found.s)
    assert lives.attrs == {
        "long_name": "load cycles to a crack",
        "units": "1",
        "symbol": "N",
        "comment": contact.cycles(STEEL, found.s[1]).comment,
    }
    assert lives.values == pytest.approx([float(STEEL.cycles(stiff)), float(STEEL.cycles(soft))])
    assert contact.swt(1e308, body=1) == np.inf  # without a warning
    # In any order, one body alone, and from plain numbers.
    assert contact.cycles(STEEL, found.s[::-1]).values == pytest.approx(lives.values[::-1])
    assert float(contact.cycles(STEEL, found.s[1])) == pytest.approx(float(lives[1]))
    s = found.s.values[1]
    assert float(contact.cycles(STEEL, s, body=2)) == pytest.approx(float(lives[1]))
    grid = found.s.expand_dims(phase=[0.0, 1.0])
    np.testing.assert_allclose(contact.swt(grid), [contact.swt(found.s)] * 2)
    weak = FatigueConstants(200e3, 900.0, -0.1, 1.0, -0.7)
    pair = contact.cycles((STEEL, weak), found.s).values
    assert pair == pytest.approx([float(lives[0]), float(weak.cycles(soft))])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda contact: contact.parameters(-1), "body: found -1; allowed: 1 or 2"),
        (lambda contact: contact.parameters(np.timedelta64(1, "s")), "body: found n.*timedelta64"),
        (lambda contact: contact.cycles([STEEL], LABELLED), "constants: found"),
        (lambda contact: contact.cycles(None, LABELLED), "constants: found None; allowed: a Fatigue"),
    ],
)
def test_a_body_that_is_not_known_is_asked_for(call, words):
    bodies = {**ALUMINIUM, "young_modulus": (210e3, 180e3)}
    refused(words, call, physical(**bodies, **LOADED))


@pytest.mark.quick(8)
@pytest.mark.parametrize(
    "parameters",
    [
        {},
        {"frequency_ratio": Fraction(3, 2), "phase": 1.0, "friction": 0.7, "tangential_amplitude": 0.4},
        {"profile": "truncated_paraboloid", "flat_radius": 1.5, "normal_amplitude": 0},
        *({"profile": one.profile, "normal_amplitude": 0.5, **one.shape} for one in INDENTERS),
    ],
)
def test_there_and_back(parameters):
    contact = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001).with_parameters(**parameters)
    back = contact.parameters()
    for name, value in parameters.items():
        assert back[name] == (value if name in ("profile", "frequency_ratio") else pytest.approx(value))
    lengths = {"profile": contact.profile, **contact.shape}
    names = ["friction", "normal_force", "frequency_ratio", "phase"]
    names += ["tangential_amplitude", "normal_amplitude"]
    again = physical(**ALUMINIUM | {name: getattr(contact, name) for name in names} | lengths)
    assert again.depth == pytest.approx(0.02)
    for name, value in again.parameters().items():
        assert value == (value if isinstance(value, str) else pytest.approx(back[name]))


#: Keywords of contacts that are no parameters of their points.
ABOUT = {"units", "bulk_stress_body", "bodies", "body", "similar"}
ABOUT |= {"yield_strength", "findley_limit", "shear_constants"}


def test_every_parameter_is_known_of_a_contact():
    """Each one that is listed is a keyword and an attribute of a contact; None without a value."""
    contact = physical(**ALUMINIUM, depth=0.01, tangential_amplitude=1e-3)
    own = {*inspect.signature(physical).parameters} - ABOUT
    assert own <= {*dir(contact)}
    listed, *_ = call("list", "--parameters").output.partition("Quantities")
    assert own | {"body", "bulk_strain_share"} == {*re.findall(r"^  (\w+)  ", listed, re.MULTILINE)}
    for name in ("normal_force_amplitude", "flat_radius", "exponent", "bulk_stress_ratio"):
        assert getattr(contact, name) is None
    with pytest.raises(AttributeError, match="a contact has no 'colour'"):
        contact.colour  # noqa: B018


@pytest.mark.parametrize(
    ("name", "power"),
    [
        *(("length_scale", 0.5), ("slip_scale", 1.0), ("stress_scale", 0.5), ("swt_scale", 1.0)),
        *(("work_scale", 2.5), ("contact_radius", 0.5), ("normal_force", 1.5)),
    ],
)
def test_scales_grow_with_a_power_of_the_depth(name, power):
    shallow, deep = (physical(**ALUMINIUM, tangential_amplitude=1e-3, depth=each) for each in (0.02, 0.08))
    assert getattr(deep, name) / getattr(shallow, name) == pytest.approx(4**power)


def test_lengths_over_their_scales():
    """In mm: a_H = √(50 · 0.02) = 1, √(hR) = 0.1, and μ E* δ0/G* of two equal bodies."""
    moving = {"depth": 0.02, "tangential_amplitude": 0.001, "normal_amplitude": 0.005}
    found = physical(**ALUMINIUM, **moving, **WAVES).parameters()
    assert found["normal_amplitude"] == pytest.approx(0.25)
    assert found["tangential_amplitude"] == pytest.approx(0.001 / (0.5 * 0.02) * 2 * 0.67 / 1.67)
    assert found["waviness_amplitude"] == pytest.approx(0.01)
    assert found["wavelength"] == pytest.approx(7.0)
    face = {"profile": "rounded_punch", "flat_radius": 0.3}
    found = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001, **face).parameters()
    assert found["flat_radius"] == pytest.approx(0.3)


def test_a_shape_that_is_no_length_is_the_number_itself():
    pure = ALUMINIUM | {"tangential_amplitude": 0.001, "profile": "power_law"}
    for load in ({"depth": 0.04}, {"normal_force": 20.0}):
        contact = physical(**pure, **load, exponent=3.5)
        assert contact.parameters()["exponent"] == contact.shape["exponent"] == 3.5
        assert contact.with_parameters(exponent=1.5).shape == {"exponent": 1.5}
    refused(r"exponent: found nothing; allowed: a number in \(1, 20\]", physical, **pure, depth=0.04)
    plain = pure | {"profile": "paraboloid", "depth": 0.04, "exponent": 3.5}
    refused(r"exponent: found 3\.5, which no profile here has", physical, **plain)


def test_another_profile_leaves_the_lengths_of_the_old_one_behind():
    contact = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001, **WAVES)
    punch = contact.with_parameters(profile="rounded_punch", flat_radius=0.5)
    assert punch.shape == pytest.approx({"flat_radius": 0.5})  # a_H = √(50 · 0.02) = 1
    assert punch.with_parameters(profile="truncated_paraboloid").shape == pytest.approx(punch.shape)
    refused("wavelength: found 7, which no profile here has", punch.with_parameters, wavelength=7)
    refused("profile: found 'parabola'", punch.with_parameters, profile="parabola")


@pytest.mark.parametrize(
    "given",
    [
        {"criterion": "fatemi_socie", "normal_sensitivity": 0.3, "yield_strength": 325.0},
        {"profile": "cylinder", "contact_length": 10.0},
        {"profile": "rounded_punch", "flat_radius": 0.2},
        {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-4, "wavelength": 1.0},
    ],
)
def test_the_same_parameters_give_the_same_contact(given: dict[str, Any]) -> None:
    contact = physical(**ALUMINIUM, normal_force=2000.0, tangential_force_amplitude=600.0, **given)
    again = contact.with_parameters(phase=contact.phase).with_parameters(friction=contact.friction)
    for name in ({*given} - {"yield_strength"}) | {"normal_force", "tangential_force_amplitude"}:
        own = getattr(contact, name)
        assert getattr(again, name) == (own if isinstance(own, str) else pytest.approx(own, rel=1e-12))
    y = CRITERIA[given.get("criterion", "swt")].name
    np.testing.assert_allclose(again.solve(1e-2)[y], contact.solve(1e-2)[y], rtol=1e-9)


def test_a_table_has_no_radius_for_another_profile() -> None:
    table = swtstudy.TabulatedProfile("mine", np.linspace(0.0, 4.0, 41), np.linspace(0.0, 4.0, 41) ** 2 / 100)
    own = {name: value for name, value in ALUMINIUM.items() if name != "radius"}
    contact = physical(**own, profile=table, normal_force=200.0, tangential_force_amplitude=60.0)
    refused("profile: found 'paraboloid'; allowed: a table", contact.with_parameters, profile="paraboloid")


def test_waves_are_judged_at_the_largest_depth():
    """With h = 0.05 δ0 a contact is compact up to 1.75 δ0 if λ is at least 3.52 √(hR)."""
    own = {**ALUMINIUM, "depth": 0.02, "tangential_amplitude": 0.001, "normal_amplitude": 0.75 * 0.02}
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 0.001}
    assert physical(**own, **waves, wavelength=3.55 * np.sqrt(0.001 * 50.0)).shape
    short = 3.4 * np.sqrt(0.001 * 50.0)
    refused(r"wavelength 3\.4 is below 3\.52", physical, **own, **waves, wavelength=short)


def test_pressures_of_other_profiles():
    made = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001)
    for b in (0.3, 2.0):
        rounded = made.with_parameters(profile="rounded_punch", flat_radius=b)
        truncated = made.with_parameters(profile="truncated_paraboloid", flat_radius=b)
        assert rounded.peak_pressure > rounded.mean_pressure
        assert truncated.peak_pressure == math.inf
        # The pressure adds up to the force; it is steep at the contact's edge and at that of the face.
        edge = rounded.contact_radius / rounded.length_scale
        at = edge * np.sin(np.linspace(0.0, np.pi / 2, 201)[:-1]) + 1e-9
        at = np.sort(np.append(at, b * np.array([1 - 1e-3, 1 - 1e-6, 1 + 1e-6, 1 + 1e-3])))
        kind = {"profile": "rounded_punch", "flat_radius": b, "normal_amplitude": 0}
        field = swtstudy.stress_field(at, 0.0, 0.0, time=0.0, **kind)
        p, r = -field.sigma_zz.values * rounded.stress_scale, field.x.values * rounded.length_scale
        assert trapezoid(2 * np.pi * r * p, r) == pytest.approx(rounded.normal_force, rel=1e-4)
        assert p.max() == pytest.approx(rounded.peak_pressure, rel=2e-5)
    for profile in ("rounded_punch", "truncated_paraboloid"):
        blunt = made.with_parameters(profile=profile, flat_radius=0)
        assert blunt.peak_pressure == pytest.approx(made.peak_pressure, rel=1e-6)


def test_a_contact_without_friction_does_not_move():
    contact = physical(**{**ALUMINIUM, "friction": 0}, depth=0.02, tangential_amplitude=0)
    assert contact.parameters()["tangential_amplitude"] == 0.0


MISTAKES = sayings(r"""
dict(profile="rounded_punch", flat_radius=-1) » flat_radius: found -1 (out of range); allowed: a length, ≥ 0
dict(profile="wavy_paraboloid", waviness_amplitude=1e-3, wavelength=1e-9)
» wavelength: found 1e-09 at radius = 50, normal_force = 200, waviness_amplitude = 0.001
dict(friction=[[0.5]]) » friction: found [[0.5]]; allowed: a single value or a one-dimensional
dict(friction=0) » tangential_amplitude: found 0.002 at radius = 50, normal_force = 200, friction = 0;
dict(profile=[["paraboloid"]]) » profile: found [['paraboloid']]; allowed: a single value or
dict(similar=None) » similar: found None
dict(young_modulus=5e-324) » young_modulus: found 5e-324 (out of range); allowed: a positive stress
dict(young_modulus=1e308) » young_modulus: found 1e+308 (out of range); allowed: a positive stress
dict(radius=[50.0, -1.0]) » radius[1]: found -1.0 (out of range); allowed: a positive length
dict(radius=5e-324) » radius: found 5e-324 (out of range); allowed: a positive length
dict(normal_force=1e308) » normal_force: found 1e+308 (out of range); allowed: a positive force
dict(friction=5e-324) » tangential_amplitude: found 0.002 at radius = 50, normal_force = 200, frict
dict(E=1) » E: found unknown parameter 'E'; allowed: did you mean young_modulus (E)?
dict(E=1, P=1, F=1, Q=1, u=1, f=1)
» E: found unknown parameter 'E'; allowed: did you mean young_modulus (E)?
» P: found unknown parameter 'P'; allowed: did you mean normal_force or
» F: found unknown parameter 'F'; allowed: did you mean normal_force or
» Q: found unknown parameter 'Q'; allowed: did you mean tangential_force
» u: found unknown parameter 'u'; allowed: did you mean tangential_amplitude
» f: found unknown parameter 'f'; allowed: did you mean friction or profile
dict(yield_strenght=300)
» yield_strenght: found unknown parameter 'yield_strenght'; allowed: did you mean yield_strength?
dict(criterion="fatemi_socie", normal_sensitivity=1) » yield_strength: found nothing; allowed: a stress
dict(psi=1) » psi: found unknown parameter 'psi'; allowed: did you mean phase (ψ)?
dict(youngs_modulus=1, young_modulus=None, radius=None)
» youngs_modulus: found unknown parameter 'youngs_modulus'; allowed: did you mean young_mod
» radius: found nothing; allowed: a positive length
dict(profile="wavy_paraboloid", waviness_amplitude=0, wavelength=0)
» waviness_amplitude: found 0 (out of range); allowed: a positive length
» wavelength: found 0 (out of range); allowed: a positive length
dict(flat_radius=0.5, profile="cone") » profile: found 'cone'
dict(flat_radius=1e77, profile="truncated_paraboloid")
» flat_radius: found 1e+77 at radius = 50, normal_force = 200; allowed: a
dict(flat_radius=1e-4, profile="rounded_punch", normal_force=5e-89)
» flat_radius: found 0.0001 at radius = 50, normal_force = 5e-89; allowed
dict(waviness_amplitude=1.0, wavelength=100.0, profile="wavy_paraboloid")
» waviness_amplitude: found 1 at radius = 50, normal_force = 200, wave
dict(radius=0, friction=-1, tangential_amplitude=-1, phase=None)
» radius: found 0
» friction: found -1
» tangential_amplitude: found -1
» phase: found None
""")


@pytest.mark.parametrize(("changes", "messages"), MISTAKES)
def test_every_mistake_is_named_once_with_the_users_own_values(changes, messages):
    given = ALUMINIUM | {"normal_force": 200.0, "tangential_amplitude": 0.002} | eval(changes)
    found = str(refused("", physical, **given)).splitlines()
    assert len(found) == len(messages)
    for line, start in zip(found, messages, strict=True):
        assert line.startswith(start)


@pytest.mark.parametrize("profile", ["rounded_punch", "truncated_paraboloid"])
def test_the_depth_of_a_face_as_large_as_it_may_be(profile):
    # b/a_H = 100 is the limit: a little more force, and so depth, than there.
    b, modulus = 3.0, 73.1e3 / (2 * (1 - 0.33**2))
    depth = 1.02 * (b / 100) ** 2 / 50.0
    contact = physical(**ALUMINIUM, depth=depth, tangential_amplitude=0, profile=profile, flat_radius=b)
    force = contact.normal_force
    assert force > 2 * modulus * b * depth  # that of a flat punch of this radius
    again = physical(**ALUMINIUM, normal_force=force, tangential_amplitude=0, profile=profile, flat_radius=b)
    assert again.depth == pytest.approx(depth, rel=1e-9)


def test_what_is_not_given_is_named():
    found = {mistake.key: mistake.found for mistake in refused("", physical).mistakes}
    names = ("young_modulus", "poisson_ratio", "radius", "friction", "tangential_amplitude")
    assert found == dict.fromkeys(names, "nothing") | {"depth, normal_force": "neither"}


def test_any_plain_numbers_make_the_same_contact():
    numbers = ALUMINIUM | LOADED
    for kind in (np.float64, np.array, lambda value: Decimal(str(value))):
        assert physical(**{name: kind(value) for name, value in numbers.items()}) == physical(**numbers)
    pairs = {"young_modulus": np.array([210e3, 180e3]), "poisson_ratio": [0.3, 0.3]}
    assert physical(**{**numbers, **pairs}).moduli.young == (210e3, 180e3)


def test_waves_too_short_to_follow_are_left_out_of_the_force_too():
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-30, "wavelength": 3e-14}
    contact = physical(**ALUMINIUM, normal_force=200.0, tangential_amplitude=0.002, **waves)
    plain = physical(**ALUMINIUM, normal_force=200.0, tangential_amplitude=0.002)
    assert contact.depth == pytest.approx(plain.depth)


def test_dundurs():
    # Steel on rubber: β = (1 − 2ν)/(2 − 2ν) of the soft body to first order.
    given = ALUMINIUM | LOADED | {"young_modulus": (1.0, 1e9), "similar": 10}
    with pytest.warns(UserWarning, match="times the friction"):
        rubber = physical(**given | {"poisson_ratio": (0.3, 0.3)})
    assert rubber.moduli.mismatch == pytest.approx(0.4 / 1.4)
    stiff = physical(**given | {"poisson_ratio": (0.5, 0.3)})
    assert stiff.moduli.mismatch == pytest.approx(0.0, abs=1e-6)
    with pytest.warns(UserWarning, match="β = -0.127 is 0.25 times the friction"):
        physical(**{**ALUMINIUM, "young_modulus": (210e3, 70e3)}, depth=0.01, tangential_amplitude=1e-3)


@pytest.mark.parametrize("cycles", [10.0, 1e3, 1e5, 1e9])
def test_life_at_a_known_strain_amplitude(cycles):
    """Fully reversed: σ_max ε_a with Basquin's σ_a and Coffin–Manson's ε_a at the same life."""
    stress = 1758.0 * (2 * cycles) ** -0.0977
    strain = stress / 207e3 + 2.12 * (2 * cycles) ** -0.774
    assert float(STEEL.cycles(stress * strain)) == pytest.approx(cycles, rel=1e-9)


def test_lives_of_arrays_and_limits():
    lives = STEEL.cycles([[0.0, np.nan], [1.0, 2.0]])
    assert lives[0, 0] == np.inf
    assert np.isnan(lives[0, 1])
    assert lives[1, 0] > lives[1, 1]
    contact = physical(**ALUMINIUM, depth=0.01, tangential_amplitude=0.002)
    s = np.array([0.1, 0.2])
    np.testing.assert_allclose(contact.cycles(STEEL, s), STEEL.cycles(contact.swt(s)))
    refused("swt: found -1; allowed: numbers ≥ 0", STEEL.cycles, -1.0)
    refused("swt: found 'x'", STEEL.cycles, "x")
    refused("cycles: found -2", STEEL.swt, [1.0, np.nan, -2.0])


def test_lives_of_labelled_values_are_labelled():
    swt = xr.DataArray(
        [[1.0, 2.0]], {"phase": [0.5], "friction": [0.3, 0.6]}, name="SWT", attrs={"units": "MPa"}
    )
    lives = STEEL.cycles(swt)
    assert lives.coords.identical(swt.coords)
    assert lives.dims == swt.dims
    assert (lives.name, lives.attrs) == ("cycles", {})
    assert lives.values.tolist() == STEEL.cycles(swt.values).tolist()


@pytest.mark.parametrize("swt", [5e-324, 1e-300, 1e-60, 1e60, 1e300, np.inf])
def test_lives_at_any_swt(swt):
    """One term alone rules far out: elastic at long lives, (σf′²/E) (2N)^(2b), plastic at short ones."""
    if swt < 1.0:
        logarithm = (math.log(swt) - math.log(1758.0**2 / 207e3)) / (2 * -0.0977)
    else:
        logarithm = (math.log(swt) - math.log(1758.0 * 2.12)) / (-0.0977 - 0.774)
    expected = 0.5 * math.exp(logarithm) if logarithm < 709.0 else math.inf
    assert float(STEEL.cycles(swt)) == pytest.approx(expected, rel=1e-6)


def test_lives_of_two_extremes():
    assert STEEL.swt([0.0, np.inf]).tolist() == [np.inf, 0.0]
    brittle = FatigueConstants(1e100, 1e100, -1e-100, 1e-100, -1e100)
    assert brittle.cycles([1.0, 1e200, 1e300]).tolist() == [np.inf, 0.5, 0.5]  # (2N)^(−1e100) alone
    assert FatigueConstants(Decimal(2), np.float32(3), -1, 4, -1).young_modulus.hex() == (2.0).hex()


def test_what_is_masked_has_no_life():
    """The number behind a mask, here even one that is no SWT, counts for nothing."""
    masked = np.ma.array([1.0, -5.0, 2.0], mask=[0, 1, 0])
    contact = physical(**ALUMINIUM, depth=0.01, tangential_amplitude=0.002)
    for lives, plain in (
        (STEEL.cycles(masked), STEEL.cycles([1.0, np.nan, 2.0])),
        (STEEL.swt(masked), STEEL.swt([1.0, np.nan, 2.0])),
        (contact.cycles(STEEL, masked), contact.cycles(STEEL, [1.0, np.nan, 2.0])),
    ):
        np.testing.assert_array_equal(lives, plain)
        assert np.isnan(lives).tolist() == [False, True, False]


def test_wrong_constants_are_named_at_once():
    wrong = 5e-324, 1e308, -1e-310, True, -np.inf
    error = refused(r"in magnitude from 1e-100 to 1e\+100", FatigueConstants, *wrong)
    assert [mistake.key for mistake in error.mistakes] == list(vars(STEEL))
    assert str(refused("", FatigueConstants, "1", None, 0.1, 1.0, -0.5)).splitlines() == [
        "young_modulus: found '1'; allowed: a positive number",
        "strength: found None; allowed: a positive number",
        "strength_exponent: found 0.1; allowed: a negative number",
    ]


def test_the_worked_example():
    """The best phase of the example lets the aluminium live six times as long as the worst one."""
    example = runpy.run_path(str(STUDIES / "physical.py"))
    worst, best = (example["sphere_on_flat"](math.radians(degrees)) for degrees in (105, 150))
    lives = [float(one.cycles(example["MATERIAL"], one.solve(rtol=1e-3).s[0])) for one in (worst, best)]
    assert lives[1] / lives[0] == pytest.approx(6.2, abs=0.2)
    assert lives[0] == pytest.approx(1.03e5, rel=0.02)


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        *(("strength", value, "a positive number") for value in (0, -1.0)),
        ("strength", 9e-101, r"a positive number, in magnitude from 1e-100 to 1e\+100"),
        ("strength_exponent", -2e100, r"a negative number, in magnitude from 1e-100 to 1e\+100"),
    ],
)
def test_sizes_that_cannot_be_computed_with(name, value, allowed):
    sound = vars(STEEL) | {"young_modulus": 1e-100, "ductility": 1e100}
    assert FatigueConstants(**sound)
    refused(f"^{name}: found .*; allowed: {allowed}$", FatigueConstants, **sound | {name: value})


@pytest.mark.parametrize("scale", [1.0, 1e-3])
def test_loops_are_in_range_by_their_size_not_by_their_factor(scale):
    """Micrometres in millimetres, or in metres: a factor of 1 is 150 δ0 then."""
    own = {"young_modulus": 73.1e3 / scale**2, "poisson_ratio": 0.33, "radius": 50.0 * scale, "friction": 0.5}
    vertices = np.array([[0.0064, -0.001], [0.008, 0.0015], [0.006, 0.0005]]) * scale
    loop = swtstudy.LoadPath.absolute("rig", vertices)
    found = swtstudy.physical(**own, load=loop, normal_amplitude=1.0, tangential_amplitude=1.0, body=1)
    assert found.solve().SWT.item() == pytest.approx(0.36364926 / scale**2, rel=1e-4)
    far = own | {"load": loop, "normal_amplitude": 1.0, "tangential_amplitude": 1e4, "body": 1}
    refused(": found 10000 at .*, 3540 μ E.*allowed: at most 28", physical, **far)


def test_a_plane_contact_under_a_constant_normal_load_is_controlled_by_forces() -> None:
    rig = ALUMINIUM | {"normal_force": 200.0, "profile": "cylinder"}
    load = swtstudy.LoadPath("swing", [[0, 60], [0, -60]])
    loop = physical(**rig, load=load, tangential_force_amplitude=1.0).solve(1e-3)
    sines = physical(**rig, tangential_force_amplitude=60.0).solve(1e-3)
    assert loop.control.item() == sines.control.item() == "forces"
    np.testing.assert_allclose(loop.SWT, sines.SWT, rtol=1e-3)


def test_units_may_be_named_in_python() -> None:
    """A figure and xarray's own labels say them; the numbers are as they are."""
    given = {**ALUMINIUM, "normal_force": 200.0, "tangential_force_amplitude": [60.0, 80.0]}
    newtons = {"length": "mm", "force": "N", "stress": "MPa"}
    found, plain = physical(**given, units=newtons).solve(1e-2), physical(**given).solve(1e-2)
    np.testing.assert_array_equal(found.SWT, plain.SWT)
    assert (found.SWT.units, found.tangential_force_amplitude.units) == ("MPa", "N")
    assert found.swt.contact().units == newtons
    refused(
        "units.force: found 'newton'; allowed: did you mean N",
        physical,
        **given,
        units={**newtons, "force": "newton"},
    )
    refused("units.stress: found nothing", physical, **given, units={"length": "mm", "force": "N"})
