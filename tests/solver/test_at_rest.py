"""Contacts at rest: radius, depth, force and pressure of every profile by quadrature; compactness."""

import re
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.strips import STRIPS, Strip
from scenes import points
from solved import solve_points
from told import refused

import swtstudy
from swtstudy import Study, TabulatedProfile
from swtstudy.solver.at_rest import AtRest
from swtstudy.vocabulary.choices import FAMILIES, Family
from swtstudy.vocabulary.families import FORMS, Form

Array = NDArray[np.float64]
#: Heights over lengths: real contacts are flat. Lengths are in a_H, heights in δ0 and forces in E* δ0 a_H.
FLAT = 1e-4
#: A load N of a strip is N/(π/4) in units of the mean load.
MEAN = 0.25 * np.pi
every_indenter = pytest.mark.parametrize("indenter", oracle.INDENTERS, ids=str)
every_strip = pytest.mark.parametrize("strip", STRIPS, ids=str)
#: The parameter and its value with which a shape is that of a paraboloid.
PLAIN = {"flat_radius": 0.0, "waviness_amplitude": 0.0, "exponent": 2.0}


def contact(profile: oracle.Indenter | Strip, **load: float) -> Any:
    """A contact whose profile is that of an oracle in the units above."""
    shape, radius, n = {**profile.shape}, 1.0, profile.shape.get("exponent", 2.0)
    if n != 2.0:
        slope = profile.bend(1.0) / (n - 1.0) if isinstance(profile, Strip) else profile.f_slope(1.0)
        radius = slope ** (1.0 / (1.0 - n))
    if "wavelength" in shape:
        shape["wavelength"] *= np.sqrt(shape["waviness_amplitude"])
        shape["waviness_amplitude"] *= FLAT
    bodies = {"young_modulus": 2.0 / FLAT, "poisson_ratio": 0.0, "radius": radius * FLAT ** (1.0 / (1.0 - n))}
    still = "tangential_force_amplitude" if isinstance(profile, Strip) else "tangential_amplitude"
    return swtstudy.physical(**bodies, friction=0.5, profile=profile.profile, **shape, **load, **{still: 0.0})


def pressure(name: str, shape: dict[str, float], x: Array, **load: float) -> Array:
    """The pressure at rest, at the mean load."""
    field = swtstudy.stress_field(x, 0.0, 0.0, time=0.0, profile=name, **shape, **load)
    return -field.sigma_zz.values


@pytest.mark.parametrize("b", [1e-3, 0.5])
def test_a_new_form_needs_no_panels_of_its_own(monkeypatch: pytest.MonkeyPatch, b: float) -> None:
    """A cone with a round tip, f = b (√(r² + b²) − b)."""
    density = lambda s, b: b * (np.arctan2(s, b) + s * b / (s * s + b * b))  # noqa: E731
    monkeypatch.setitem(FORMS, "cone", Form(density))
    monkeypatch.setitem(FAMILIES, "cone", Family("cone", ("tip",)))
    radius = np.array([[0.1, 1.0, 3.0]])
    np.testing.assert_allclose(
        AtRest("cone", {"tip": b}).depth(radius), b * radius * np.arctan(radius / b), 1e-12
    )


def test_every_profile_has_an_oracle() -> None:
    error = refused("profile: found 'cone'", swtstudy.solve, profile="cone")
    (names,) = re.findall("one of (.*?);", str(error))
    assert {*names.split(", ")} == {*oracle.ORACLES} | {strip.profile for strip in STRIPS}


@every_indenter
@pytest.mark.parametrize(
    "depth", [0.25, *(pytest.param(depth, marks=pytest.mark.slow) for depth in (0.05, 2.0))]
)
def test_radius_depth_and_force(indenter: oracle.Indenter, depth: float) -> None:
    """g(a) = δ, and F = 2 ∫ (δ − g) dξ; the other way round, too."""
    found, b = contact(indenter, depth=depth * FLAT), indenter.flat_radius
    a = found.contact_radius
    assert indenter.depth(a) == pytest.approx(depth, rel=1e-9, abs=1e-11 + 2e-8 * b * b)
    force = 2.0 * (a * depth - oracle.integral(lambda x: indenter.depth(x) if x > b else 0.0, b, a))
    assert found.normal_force == pytest.approx(force, rel=1e-8, abs=1e-9)
    again = contact(indenter, normal_force=found.normal_force)
    assert again.depth == pytest.approx(depth * FLAT, rel=1e-9)
    # The pressure has no bound where g′ √(ξ² − b²) does not vanish at the edge of a face.
    if b > 0.0 and indenter.weighted_slope(0.0) > 0.0:
        assert found.peak_pressure == np.inf
    elif indenter.shape.get("exponent", 2.0) >= 2.0:  # at a tip it is known in closed form
        r = np.append(np.linspace(1e-6, a, 8), b + (a - b) * np.linspace(1e-3, 1.0, 25))
        largest = max(indenter.outer(each, a)[0] for each in r) / np.pi
        assert largest * (1.0 - 1e-9) <= found.peak_pressure <= largest * 1.01


@pytest.mark.quick(8)
@every_indenter
def test_pressure_against_quadrature(indenter: oracle.Indenter) -> None:
    """Under and around the edge of a face, and up to the edge of the contact."""
    b, edge = indenter.flat_radius, contact(indenter, depth=FLAT).contact_radius
    x = np.unique(np.concatenate([b * np.array([0.01, 0.5, 0.99, 1.01]), edge * np.array([0.02, 0.3, 0.97])]))
    x = x[(x > 0.0) & (x < edge)]
    expected = [indenter.outer(r, edge)[0] / np.pi for r in x]
    found = pressure(indenter.profile, indenter.shape, x, normal_amplitude=0.0)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("b", [1e-9, 1e-7, 2.3e-6, 1e-4, 1e-3])
@pytest.mark.parametrize("depth", [1e-4, 0.1, 1.7])
def test_contact_radius_over_a_small_face(b: float, depth: float) -> None:
    a = contact(oracle.rounded_punch(b), depth=depth * FLAT).contact_radius
    assert a * np.sqrt((a - b) * (a + b)) - b * a * np.arccos(b / a) == pytest.approx(depth, rel=1e-12)


@pytest.mark.quick(6)
@pytest.mark.parametrize("indenter", [one for one in oracle.INDENTERS if one.shape], ids=str)
def test_s_of_a_plain_shape_is_that_of_the_paraboloid(indenter: oracle.Indenter) -> None:
    plain = {name: PLAIN.get(name, value) for name, value in indenter.shape.items()}
    load = {"normal_amplitude": [0.75, 0.3], "phase": [1.0, 2.5], "friction": [0.3, 0.9]}
    found, expected = (
        solve_points(points(name, **load, **shape), 1e-5)
        for name, shape in ((indenter.profile, plain), ("paraboloid", {}))
    )
    np.testing.assert_allclose(found.s, expected.s, rtol=3e-5)
    np.testing.assert_allclose(np.abs(found.critical_x), np.abs(expected.critical_x), rtol=1e-3)


def is_refused(profile: str, height: float, wavelength: float, **load: float) -> str:
    """Why waves are refused, or nothing."""
    given = {"profile": profile, "waviness_amplitude": height, "wavelength": float(wavelength), **load}
    fixed = "\n".join(f"{name} = {value!r}" for name, value in given.items())
    try:
        Study.from_text(f'title = "t"\n[fixed]\n{fixed}\n')
    except swtstudy.StudyError as error:
        return str(error)
    return ""


@pytest.mark.quick(1)
@pytest.mark.parametrize(("h", "amplitude"), [(0.01, 0.75), (0.1, 0.75), (0.5, 0.9)])
def test_waviness_is_refused_exactly_where_g_stops_growing(h: float, amplitude: float) -> None:
    low, high = 0.5, 8.0
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        refused = is_refused("wavy_paraboloid", h, middle, normal_amplitude=amplitude)
        low, high = (middle, high) if refused else (low, middle)

    def least_slope(wavelength: float) -> float:
        wavy = oracle.wavy_paraboloid(h, wavelength)
        # Up to the contact radius and the wave around it.
        half_wave = 0.5 * wavelength * np.sqrt(h)
        xi = np.linspace(1e-3, np.sqrt(1.0 + amplitude) + half_wave, 4000)
        return min(wavy.slope(x) / x for x in xi)

    assert least_slope(high) == pytest.approx(0.0, abs=1e-3)
    assert least_slope(0.98 * high) < 0.0 < least_slope(1.02 * high)


def test_the_message_of_a_contact_that_is_not_compact_names_the_limit() -> None:
    message = is_refused("wavy_paraboloid", 0.01, 3.1, normal_amplitude=0.75)
    assert "wavelength 3.1 is below 3.5" in message
    assert "waviness_amplitude 0.01" in message
    assert not is_refused("wavy_paraboloid", 0.01, 3.6, normal_amplitude=0.75)
    assert not is_refused("wavy_paraboloid", 0.0, 3.1, normal_amplitude=0.75)


@pytest.mark.parametrize("height", [0.002, 0.05])
def test_waves_are_compact_while_the_load_rises(height: float) -> None:
    """N′ ≥ 0 is 1 + h k² J₀ ≥ 0, h k² below 2.48; the least wavelength is said where it is refused."""
    least = 2.0 * np.pi / np.sqrt(2.4829)
    load = {"normal_force_amplitude": 1.5, "tangential_force_amplitude": 0.0}
    assert not is_refused("wavy_cylinder", height, 1.002 * least, **load)
    message = is_refused("wavy_cylinder", height, 0.998 * least, **load)
    assert "below 3.988, " in message
    assert "up to the load 1 P0" in message


def test_the_largest_depth_under_a_force() -> None:
    """Of a paraboloid it goes with F to the power of 2/3."""
    r = np.linspace(0.0, 1.2, 40)
    given = {"profile": TabulatedProfile("short", r, 0.5 * r**2), "tangential_force_amplitude": 0.1}
    words = "the depth 1.5874 is beyond the table of short, which ends at the radius 1.2"
    refused(words, swtstudy.solve, **given, normal_force_amplitude=1.0)


def test_rounded_punch_of_the_literature() -> None:
    # Lengths in mm, forces in N: b = 20, R = 10, δ = 0.1, a rigid punch on E = 70 GPa, ν = 0.3.
    bodies = {"young_modulus": 140e3, "poisson_ratio": 0.3, "radius": 10.0, "friction": 0.5}
    punch = {"profile": "rounded_punch", "flat_radius": 20.0, "depth": 0.1, "tangential_amplitude": 0.0}
    found = swtstudy.physical(**bodies, **punch)
    assert found.contact_radius == pytest.approx(20.38, abs=0.005)
    assert found.normal_force == pytest.approx(311.21e3, abs=5.0)
    assert found.mean_pressure == pytest.approx(238.49, abs=0.005)


@every_strip
@pytest.mark.parametrize("load", [0.01, 0.3, 1.0, 1.8])
def test_loads_and_slopes_of_strips(strip: Strip, load: float) -> None:
    """N(a) = P; the slope N′ by two loads next to one another."""
    one, two = (contact(strip, normal_force=load * MEAN * share).contact_radius for share in (1.0, 1.0001))
    assert strip.load(one) == pytest.approx(load * MEAN, rel=1e-8)
    assert strip.slope(0.5 * (one + two)) == pytest.approx(1e-4 * load * MEAN / (two - one), rel=1e-3)


@every_strip
def test_pressure_of_strips(strip: Strip) -> None:
    b, edge = strip.flat, contact(strip, normal_force=MEAN).contact_radius
    share = np.array([-0.5, 0.05, 0.4, 0.9]) if b else np.array([0.05, 0.4, 0.9])
    x = b + (edge - b) * share
    x = x[x > 0.0]
    expected = [strip.outer(each, edge) / np.pi for each in x]
    load = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.0}
    np.testing.assert_allclose(
        pressure(strip.profile, strip.shape, x, **load), expected, rtol=1e-6, atol=1e-8
    )


@pytest.mark.parametrize("b", [0.0, 0.5])
@pytest.mark.parametrize("count", [60, 500])
def test_a_plane_table_is_at_rest_what_it_is_a_table_of(b: float, count: int) -> None:
    x = np.linspace(0.0, 2.0, count)
    height = 0.5 * FLAT * np.maximum(x - b, 0.0) ** 2
    given = {"young_modulus": 2.0 / FLAT, "poisson_ratio": 0.0, "friction": 0.5, "normal_force": MEAN}
    given["tangential_force_amplitude"] = 0.0
    table = TabulatedProfile("mine", x, height, geometry="plane")
    flat = {"profile": "rounded_flat", "flat_half_width": b, "radius": 1.0 / FLAT}
    found, exact = (swtstudy.physical(**given, **each) for each in ({"profile": table}, flat))
    assert found.contact_radius == pytest.approx(exact.contact_radius, abs=2e-7)
    assert found.peak_pressure == pytest.approx(exact.peak_pressure, abs=1e-5)
