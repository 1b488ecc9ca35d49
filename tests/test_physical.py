"""Real contacts against Hertz, Cattaneo and Mindlin, and the strain–life relation itself."""

import math
import runpy
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import trapezoid

import swtstudy
from swtstudy import FatigueConstants, physical
from swtstudy.units.moduli import Moduli

ALUMINIUM = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.5}


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
    assert [attributes["symbol"] for attributes in own.values()] == [
        r"\mathrm{SWT}",
        r"\Delta \mathrm{SWT}",
        "x",
    ]
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
    contact = physical(
        young_modulus=young,
        poisson_ratio=(0.3, 0.4),
        radius=10.0,
        depth=0.01,
        friction=0.3,
        tangential_amplitude=0.003,
    )
    assert contact.moduli.mismatch == pytest.approx(0.0, abs=1e-12)
    found = contact.solve(rtol=1e-3)
    for body, nu in enumerate((0.3, 0.4)):
        s = float(swtstudy.solve(**contact.parameters(body), rtol=1e-3).s)
        assert found.poisson_ratio.values[body] == nu
        expected = s * contact.stress_scale**2 / young[body] * (1 - nu**2)
        assert float(found.SWT[body]) == pytest.approx(expected)


@pytest.mark.parametrize(
    "parameters",
    [
        {},
        {"frequency_ratio": Fraction(3, 2), "phase": 1.0, "friction": 0.7, "tangential_amplitude": 0.4},
        {"profile": "rounded_punch", "flat_radius": 0.5},
        {"profile": "truncated_paraboloid", "flat_radius": 1.5, "normal_amplitude": 0},
        {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5},
    ],
)
def test_there_and_back(parameters):
    contact = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001).with_parameters(**parameters)
    back = contact.parameters()
    for name, value in parameters.items():
        assert back[name] == (value if name in ("profile", "frequency_ratio") else pytest.approx(value))
    lengths = {"profile": contact.profile, **contact.shape}
    again = physical(
        **{**ALUMINIUM, "friction": contact.friction},
        normal_force=contact.normal_force,
        tangential_amplitude=contact.tangential_amplitude,
        normal_amplitude=contact.normal_amplitude,
        frequency_ratio=contact.frequency_ratio,
        phase=contact.phase,
        **lengths,
    )
    assert again.depth == pytest.approx(0.02)
    for name, value in again.parameters().items():
        assert value == (value if isinstance(value, str) else pytest.approx(back[name]))


def test_pressures_of_other_profiles():
    made = physical(**ALUMINIUM, depth=0.02, tangential_amplitude=0.001)
    for b in (0.3, 2.0):
        rounded = made.with_parameters(profile="rounded_punch", flat_radius=b)
        truncated = made.with_parameters(profile="truncated_paraboloid", flat_radius=b)
        assert rounded.peak_pressure > rounded.mean_pressure
        assert truncated.peak_pressure == math.inf
        # The pressure adds up to the force.
        field = swtstudy.stress_field(
            np.linspace(0, rounded.contact_radius / rounded.length_scale, 2001)[:-1] + 1e-9,
            0.0,
            0.0,
            time=0.0,
            profile="rounded_punch",
            flat_radius=b,
            normal_amplitude=0,
        )
        p, r = -field.sigma_zz.values * rounded.stress_scale, field.x.values * rounded.length_scale
        assert trapezoid(2 * np.pi * r * p, r) == pytest.approx(rounded.normal_force, rel=3e-3)
        assert p.max() == pytest.approx(rounded.peak_pressure, rel=2e-3)
    blunt = made.with_parameters(profile="rounded_punch", flat_radius=0)
    assert blunt.peak_pressure == pytest.approx(made.peak_pressure, rel=1e-6)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"young_modulus": (210e3, 70e3), "poisson_ratio": (0.3, 0.33)},
            r"Dundurs' β = -0.117.*\|β\| ≤ 0.05",
        ),
        ({"young_modulus": -1}, "young_modulus: found -1"),
        ({"poisson_ratio": 0.6}, "poisson_ratio: found 0.6"),
        ({"normal_force": 1.0}, "one of the two"),
        ({"depth": None}, "neither"),
        ({"friction": -1}, "friction"),
        ({"frequency_ratio": math.pi}, "irrational"),
        ({"profile": "rounded_punch"}, "flat_radius: found nothing"),
        ({"profile": "cone"}, "no such profile"),
        ({"radius": math.nan}, "radius"),
        (
            {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-3, "wavelength": 0.1},
            "compact",
        ),
    ],
)
def test_mistakes_are_named(changes, words):
    with pytest.raises(ValueError, match=words):
        physical(**{**ALUMINIUM, "depth": 0.01, "tangential_amplitude": 0.002, **changes})


@pytest.mark.parametrize(
    ("changes", "messages"),
    [
        ({"profile": "rounded_punch", "flat_radius": -1}, ["flat_radius: found -1; allowed: a length ≥ 0"]),
        (
            {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-3, "wavelength": 1e-9},
            ["wavelength: found 1e-09 at waviness_amplitude 0.001; allowed: at least 0.62"],
        ),
        ({"friction": [0.5]}, ["friction: found [0.5] (not a number)"]),
        ({"friction": 0}, ["tangential_amplitude: found 0.002 without friction; allowed: 0"]),
        ({"young_modulus": -1}, ["young_modulus: found -1; allowed: a positive number"]),
        ({"normal_amplitude": "0"}, ["normal_amplitude: found '0'"]),
        ({"profile": ["paraboloid"]}, ["profile: found ['paraboloid'] (not a name)"]),
        ({"similar": None}, ["similar: found None"]),
        (
            {"radius": 0, "friction": -1, "tangential_amplitude": -1, "phase": None},
            ["friction: found -1", "phase: found None", "radius: found 0", "tangential_amplitude: found -1"],
        ),
        ({"normal_amplitude": 1}, ["normal_amplitude: found 1, non-dimensional 155.2"]),
    ],
)
def test_every_mistake_is_named_once_with_the_users_own_values(changes, messages):
    with pytest.raises(swtstudy.StudyError) as caught:
        physical(**{**ALUMINIUM, "normal_force": 200.0, "tangential_amplitude": 0.002, **changes})
    found = str(caught.value).splitlines()
    assert len(found) == len(messages)
    for line, start in zip(found, messages, strict=True):
        assert line.startswith(start)


def test_waves_too_short_to_follow_are_left_out_of_the_force_too():
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-30, "wavelength": 3e-14}
    contact = physical(**ALUMINIUM, normal_force=200.0, tangential_amplitude=0.002, **waves)
    plain = physical(**ALUMINIUM, normal_force=200.0, tangential_amplitude=0.002)
    assert contact.depth == pytest.approx(plain.depth)


def test_dundurs():
    # Steel on rubber: β = (1 − 2ν)/(2 − 2ν) of the soft body to first order.
    assert Moduli((1.0, 1e9), (0.3, 0.3)).mismatch == pytest.approx(0.4 / 1.4)
    assert Moduli((1.0, 1e9), (0.5, 0.3)).mismatch == pytest.approx(0.0, abs=1e-6)
    physical(
        **{**ALUMINIUM, "young_modulus": (210e3, 70e3)}, depth=0.01, tangential_amplitude=1e-3, similar=0.2
    )


STEEL = FatigueConstants(
    young_modulus=207e3, strength=1758.0, strength_exponent=-0.0977, ductility=2.12, ductility_exponent=-0.774
)


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
    for swt, words in ((-1.0, "swt: found -1; allowed: numbers ≥ 0"), ("x", "swt: found 'x'")):
        with pytest.raises(ValueError, match=words):
            STEEL.cycles(swt)
    with pytest.raises(ValueError, match="cycles: found -2"):
        STEEL.swt([1.0, np.nan, -2.0])


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
    with pytest.raises(swtstudy.StudyError) as caught:
        FatigueConstants("1", None, 0.1, 1.0, -0.5)
    assert str(caught.value).splitlines() == [
        "young_modulus: found '1'; allowed: a positive number",
        "strength: found None; allowed: a positive number",
        "strength_exponent: found 0.1; allowed: a negative number",
    ]


def test_the_worked_example():
    """The best phase of the example lets the aluminium live six times as long as the worst one."""
    example = runpy.run_path(str(Path(__file__).parent.parent / "studies" / "physical.py"))
    worst, best = (example["sphere_on_flat"](math.radians(degrees)) for degrees in (105, 150))
    lives = [float(one.cycles(example["MATERIAL"], one.solve(rtol=1e-3).s[0])) for one in (worst, best)]
    assert lives[1] / lives[0] == pytest.approx(6.2, abs=0.2)
    assert lives[0] == pytest.approx(1.03e5, rel=0.02)
