"""Profiles at rest: g from f, inverses, limits, pressure, compactness."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.strips import STRIPS, Strip
from scenes import DRAWN, PLANE_NAMES, points
from scipy.special import struve
from solved import solve_points

from swtstudy import TabulatedProfile
from swtstudy.solver.at_rest import AtRest, check_shape, compact_shapes, too_small
from swtstudy.vocabulary.choices import AXISYMMETRIC, FAMILIES, PLAIN, PLAIN_STRIP, PLANE, Family
from swtstudy.vocabulary.families import FORMS, power_law, wave
from swtstudy.vocabulary.parameters import PARAMETERS

Array = NDArray[np.float64]

#: Largest depth reached: δ0 + δA with δA = δ0.
DEEPEST = 2.0
every_indenter = pytest.mark.parametrize("indenter", oracle.INDENTERS, ids=str)
#: Those of discs; tests of strips are at the end.
ROUND = {name: family for name, family in FAMILIES.items() if family.geometry == AXISYMMETRIC}
every_family = pytest.mark.parametrize("family", ROUND.values(), ids=ROUND)
every_plain_shape = pytest.mark.parametrize(
    "indenter", [one for one in oracle.INDENTERS if FAMILIES[one.profile].plain], ids=str
)


def at_rest(indenter: oracle.Indenter) -> AtRest:
    """The package's profile of the same shape."""
    return AtRest(indenter.profile, indenter.shape)


def reached(indenter: oracle.Indenter, share: Array) -> Array:
    """Radii at a share of the way from the face or centre to the largest contact radius, shape (1, k)."""
    b, largest = indenter.flat_radius, at_rest(indenter).radius(np.array([[DEEPEST]]))
    return np.asarray(b + (largest - b) * share)


@every_family
def test_a_family_is_a_row_a_form_and_an_oracle(family: Family) -> None:
    """Nothing here may be left to itself: each family is looked at by all tests of this file."""
    assert oracle.ORACLES.get(family.name), f"{family.name} has no oracle in tests/oracles/profiles.py"
    assert family.name in FORMS, f"{family.name} has no form in swtstudy/vocabulary/families.py"
    density = FORMS[family.name].density
    if density is not power_law:
        assert len(inspect.signature(density).parameters) == 1 + len(family.shape)
    assert {*family.shape} <= {name for name, row in PARAMETERS.items() if row.part == "shape"}
    for indenter in oracle.ORACLES[family.name]:
        assert (indenter.profile, (*indenter.shape,)) == (family.name, family.shape)
    if family.plain:
        name, value = family.plain
        assert name in family.shape
        assert PARAMETERS[name].lower <= value <= PARAMETERS[name].upper


def test_the_tables_of_families_are_of_the_same_families() -> None:
    assert [*FORMS] == [*FAMILIES]
    assert [*ROUND] == [*oracle.ORACLES]
    assert FAMILIES[PLAIN] == Family(PLAIN)
    assert FAMILIES[PLAIN_STRIP] == Family(PLAIN_STRIP, geometry=PLANE)
    assert PARAMETERS["profile"].default == PLAIN
    shapes = {name for family in FAMILIES.values() for name in family.shape}
    assert shapes | {"profile"} == {name for name, row in PARAMETERS.items() if row.part == "shape"}


@every_indenter
def test_edges_of_faces(indenter: oracle.Indenter) -> None:
    """The pressure has no bound where g′ √(ξ² − b²) does not vanish at the edge of a face."""
    profile = at_rest(indenter)
    assert profile.flat_radius == indenter.flat_radius
    assert profile.singular == (indenter.flat_radius > 0.0 and indenter.weighted_slope(0.0) > 0.0)
    assert np.isinf(profile.largest_pressure()) == profile.singular


@every_family
def test_shapes_that_are_looked_at_together(family: Family) -> None:
    """Each profile is what it is alone, and so are depths of any shape."""
    for indenter in oracle.ORACLES[family.name]:
        shape = {name: value * np.array([1.0, 1.1, 1.2]) for name, value in indenter.shape.items()}
        together = AtRest(family.name, shape)
        n = len(together.flat_radius)
        radius = together.radius(np.broadcast_to(np.linspace(0.1, 2.0, 5), (n, 5)))
        for k in range(n):
            alone = AtRest(family.name, {name: values[k] for name, values in shape.items()})
            np.testing.assert_allclose(together.depth(radius)[k], alone.depth(radius[[k]])[0], rtol=1e-13)
            np.testing.assert_allclose(together.unit()[k], alone.unit()[0], rtol=1e-13)


@every_indenter
def test_radius_of_a_load(indenter: oracle.Indenter) -> None:
    """Also next to a face, where loads are the cube of what they are of."""
    profile = at_rest(indenter)
    largest = float(profile.radius(np.array([[DEEPEST]]))[0, 0])
    b = indenter.flat_radius
    radius = np.hypot(b, np.sqrt((largest - b) * (largest + b)) * np.geomspace(1e-4, 1.0, 200))[None]
    found = profile.radius_at(profile.half_load(radius))
    np.testing.assert_allclose(
        np.sqrt((found - b) * (found + b)), np.sqrt((radius - b) * (radius + b)), rtol=1e-6
    )


@every_family
def test_shapes_that_are_not_refused_are_compact(family: Family) -> None:
    """g′ ≥ 0 in the contact; `compact` and `check` refuse the same ones, and the message names them."""
    rng, depth = np.random.default_rng(0), 1.75
    shape = {name: DRAWN[name](rng, 200) * 10.0 ** rng.uniform(-1.0, 0.3, 200) for name in family.shape}
    compact = compact_shapes(family.name, shape, depth)
    for k in range(200 if family.shape else 0):
        one = {name: float(values[k]) for name, values in shape.items()}
        message = check_shape(family.name, one, depth)
        assert (message is None) == compact[k]
        for name, value in one.items() if message else ():
            assert f"{name} {value:g}" in message
    profile = AtRest(family.name, {name: values[compact] for name, values in shape.items()})
    b = profile.flat_radius
    largest = profile.radius(np.full_like(b, depth))
    s = np.sqrt((largest - b) * (largest + b)) * np.linspace(1e-3, 1.0, 400)
    assert np.all(profile.density(s) >= -1e-9)


@every_family
def test_what_is_too_small_is_refused_just_below_its_limit(family: Family) -> None:
    """For shapes at a hundredth of the usual ones, if one of their parameters has a limit at all."""
    for indenter in oracle.ORACLES[family.name]:
        for depth in (0.0, 1.75):
            small = {name: value / 100.0 for name, value in indenter.shape.items()}
            limit = too_small(family.name, small, depth)
            if limit is None:
                assert compact_shapes(family.name, {n: np.array([v]) for n, v in small.items()}, depth)
                continue
            name, _ = limit
            low, high = small[name], 100.0 * indenter.shape[name]
            while high - low > 1e-9 * high:
                middle = 0.5 * (low + high)
                refused = too_small(family.name, {**small, name: middle}, depth) is not None
                low, high = (middle, high) if refused else (low, middle)
            assert too_small(family.name, {**small, name: low}, depth) == (name, pytest.approx(high))


@every_indenter
def test_g_is_abels_transform_of_f(indenter: oracle.Indenter) -> None:
    xi = reached(indenter, np.linspace(0.01, 1.0, 30))
    expected = [indenter.depth(x) for x in xi[0]]
    np.testing.assert_allclose(at_rest(indenter).depth(xi)[0], expected, rtol=0.0, atol=1e-10)


@every_indenter
def test_slope_of_g(indenter: oracle.Indenter) -> None:
    xi = reached(indenter, np.linspace(0.01, 1.0, 30))
    step = 1e-6
    s = np.sqrt(xi**2 - indenter.flat_radius**2)
    slope = at_rest(indenter).density(s) * xi / s
    np.testing.assert_allclose(slope[0], [indenter.slope(x) for x in xi[0]], rtol=1e-9, atol=1e-9)
    # The oracle's own g′ against its g: the difference quotient's error is 1e-12 g‴ + 1e-13/1e-6.
    far = xi[0, 5:]
    quotient = [(indenter.depth(x + step) - indenter.depth(x - step)) / (2.0 * step) for x in far]
    np.testing.assert_allclose(slope[0, 5:], quotient, rtol=1e-6, atol=1e-6)


@every_indenter
def test_contact_radius_inverts_g(indenter: oracle.Indenter) -> None:
    depths = np.concatenate([[0.0], np.geomspace(1e-9, DEEPEST, 200)])[None]
    profile = at_rest(indenter)
    radius = profile.radius(depths)
    assert radius[0, 0] == indenter.flat_radius
    assert np.all(np.diff(radius[0]) >= 0.0)
    # Next to the face a double ξ knows w = √(ξ² − b²) to 2e-8 b only, and g may be as steep as b w.
    atol = 1e-11 + 2e-8 * indenter.flat_radius**2
    np.testing.assert_allclose(profile.depth(radius), depths, rtol=1e-9, atol=atol)


@pytest.mark.parametrize("flat_radius", [1e-9, 1e-7, 2.3e-6, 1e-4, 1e-3])
def test_contact_radius_over_a_small_face(flat_radius: float) -> None:
    profile = AtRest("rounded_punch", {"flat_radius": flat_radius})
    radius = flat_radius + np.geomspace(1e-3, 1.3, 1000)[None]
    np.testing.assert_allclose(profile.radius(profile.depth(radius)), radius, rtol=1e-13)


@every_indenter
def test_half_of_the_normal_load(indenter: oracle.Indenter) -> None:
    radius = reached(indenter, np.array([0.1, 0.5, 1.0]))
    # ∫ ξ g′ dξ = a g(a) − ∫ g dξ, smooth up to the face.
    b = indenter.flat_radius
    expected = [
        a * indenter.depth(a) - oracle.integral(lambda x: indenter.depth(x) if x > b else 0.0, b, a)
        for a in radius[0]
    ]
    np.testing.assert_allclose(at_rest(indenter).half_load(radius)[0], expected, rtol=1e-9, atol=1e-11)


@every_indenter
def test_pressure_against_quadrature(indenter: oracle.Indenter) -> None:
    """At the centre, under and around the edge of a face, and up to the edge of the contact."""
    profile, b = at_rest(indenter), indenter.flat_radius
    for depth in (0.25, DEEPEST):
        edge = profile.radius(np.array([[depth]]))
        position = np.concatenate(
            [b * np.array([0.01, 0.5, 0.99, 1.01]), edge[0, 0] * np.array([0.02, 0.3, 0.97])]
        )
        position = np.unique(position[(position > 0.0) & (position < edge[0, 0])])
        expected = [indenter.outer(r, float(edge[0, 0]))[0] / np.pi for r in position]
        np.testing.assert_allclose(profile.pressure(position[None], edge)[0], expected, rtol=1e-8, atol=1e-9)


@pytest.mark.quick(6)
@every_plain_shape
def test_s_of_a_plain_shape_is_that_of_the_paraboloid(indenter: oracle.Indenter) -> None:
    name, value = FAMILIES[indenter.profile].plain or ("", 0.0)
    load = {"normal_amplitude": [0.75, 0.3], "phase": [1.0, 2.5], "friction": [0.3, 0.9]}
    plain = solve_points(points(indenter.profile, **load, **{**indenter.shape, name: value}), 1e-5)
    expected = solve_points(points(PLAIN, **load), 1e-5)
    np.testing.assert_allclose(plain.s, expected.s, rtol=3e-5)
    np.testing.assert_allclose(np.abs(plain.critical_x), np.abs(expected.critical_x), rtol=1e-3)


LIMITS = [
    *(
        (one.profile, {**one.shape, plain[0]: plain[1]}, 1e-12)
        for one in oracle.INDENTERS
        if (plain := FAMILIES[one.profile].plain)
    ),
    # g differs by (π/2) b ξ, by b²/2 and by (π/2) h kξ H₀ ~ √(h kξ) h.
    ("rounded_punch", {"flat_radius": 1e-7}, 1e-6),
    ("truncated_paraboloid", {"flat_radius": 1e-4}, 1e-6),
    ("wavy_paraboloid", {"waviness_amplitude": 1e-5, "wavelength": 5.0}, 1e-3),
]


@pytest.mark.parametrize(("name", "shape", "tolerance"), LIMITS)
def test_the_paraboloid_is_the_limit(name: str, shape: dict[str, float], tolerance: float) -> None:
    limit, profile = AtRest(PLAIN), AtRest(name, shape)
    depth = np.linspace(0.01, DEEPEST, 50)[None]
    radius = limit.radius(depth)
    np.testing.assert_allclose(profile.radius(depth), radius, rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(profile.depth(radius), depth, rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(profile.half_load(radius), limit.half_load(radius), rtol=0.0, atol=tolerance)
    position = np.array([[0.1, 0.7, 1.0, 1.3]])
    found, expected = (one.pressure(position, np.full((1, 1), np.sqrt(2.0))) for one in (profile, limit))
    # A wave changes the slope by more than the depth: by √(h/δ0) for λ ~ √(hR).
    atol = 1e-9 + (tolerance if name != "wavy_paraboloid" else 10.0 * np.sqrt(shape["waviness_amplitude"]))
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=atol)


@pytest.mark.parametrize("largest", [0.0, 1.0, 66.0, 500.0])
def test_waves_are_made_of_struve_functions(largest: float) -> None:
    z = np.append(np.random.default_rng(0).uniform(0.0, largest, 2000), [0.0, largest])
    expected = struve(0, z) + z * (2.0 / np.pi - struve(1, z))
    known = ~np.isnan(expected)
    assert known.mean() > 0.99
    np.testing.assert_allclose(wave(z)[known], expected[known], rtol=0.0, atol=1e-12 * (1.0 + largest))
    assert np.isfinite(wave(z)).all()


@pytest.mark.parametrize(("h", "amplitude"), [(0.01, 1.75), (0.1, 1.75), (1e-4, 0.0), (0.5, 0.9)])
def test_waviness_is_refused_exactly_where_g_stops_growing(h: float, amplitude: float) -> None:
    low, high = 0.5, 8.0
    while high - low > 1e-6:
        wavelength = 0.5 * (low + high)
        shape = {"waviness_amplitude": h, "wavelength": wavelength}
        refused = check_shape("wavy_paraboloid", shape, 1.0 + amplitude) is not None
        low, high = (wavelength, high) if refused else (low, wavelength)
    limit = high

    def least_slope(wavelength: float) -> float:
        wavy = oracle.wavy_paraboloid(h, wavelength)
        wave_number = 2.0 * np.pi / (wavelength * np.sqrt(h))
        # Up to the contact radius and the wave around it.
        xi = np.linspace(1e-3, np.sqrt(1.0 + amplitude) + np.pi / wave_number, 4000)
        return min(wavy.slope(x) / x for x in xi)

    assert least_slope(limit) == pytest.approx(0.0, abs=1e-3)
    assert least_slope(0.98 * limit) < 0.0 < least_slope(1.02 * limit)


def test_the_message_of_a_contact_that_is_not_compact_names_the_limit() -> None:
    shape = {"waviness_amplitude": 0.01, "wavelength": 3.1}
    message = check_shape("wavy_paraboloid", shape, 1.75)
    assert message is not None
    assert "wavelength 3.1 is below 3.5" in message
    assert "waviness_amplitude 0.01" in message
    assert check_shape("wavy_paraboloid", {**shape, "wavelength": 3.6}, 1.75) is None
    assert check_shape("wavy_paraboloid", {**shape, "waviness_amplitude": 0.0}, 1.75) is None


def test_rounded_punch_of_the_literature() -> None:
    # Lengths in mm, forces in N: b = 20, R = 10, δ = 0.1, a rigid punch on E = 70 GPa, ν = 0.3.
    R, depth, effective = 10.0, 0.1, 70e3 / (1.0 - 0.3**2)
    unit = np.sqrt(R * depth)
    punch = AtRest("rounded_punch", {"flat_radius": 20.0 / unit})
    contact = punch.radius(np.ones((1, 1)))
    radius = contact[0, 0] * unit
    force = 2.0 * effective * depth * unit * punch.half_load(contact)[0, 0]
    assert radius == pytest.approx(20.38, abs=0.005)
    assert force == pytest.approx(311.21e3, abs=5.0)
    assert force / (np.pi * radius**2) == pytest.approx(238.49, abs=0.005)


#: A load N of a strip is N/(π/4) in units of the mean load.
MEAN = 0.25 * np.pi
every_strip = pytest.mark.parametrize("strip", STRIPS, ids=str)


def profile_of(strip: Strip) -> AtRest:
    return AtRest(strip.profile, strip.shape)


def test_each_plane_family_has_an_oracle_and_says_that_it_is_one() -> None:
    assert {strip.profile for strip in STRIPS} == {*PLANE_NAMES}
    for name, family in FAMILIES.items():
        assert AtRest(name, dict.fromkeys(family.shape, 2.5)).plane == (family.geometry == PLANE)


@every_strip
def test_loads_and_slopes_of_strips(strip: Strip) -> None:
    profile = profile_of(strip)
    widest = float(profile.radius(np.array([[1.8]]))[0, 0])
    radius = strip.flat + (widest - strip.flat) * np.array([1e-3, 0.02, 0.3, 0.7, 1.0])
    load = np.array([strip.load(xi) for xi in radius])
    np.testing.assert_allclose(profile.depth(radius[None])[0], load / MEAN, rtol=1e-9, atol=1e-13)
    np.testing.assert_allclose(profile.half_load(radius[None])[0], 0.5 * load, rtol=1e-9, atol=1e-13)
    rise = np.sqrt((radius - strip.flat) * (radius + strip.flat))
    slope = np.array([strip.slope(xi) for xi in radius])
    np.testing.assert_allclose(MEAN * profile.density(rise[None])[0], slope * rise / radius, rtol=1e-9)
    for given, inverse in ((profile.depth, profile.radius), (profile.half_load, profile.radius_at)):
        found = inverse(given(radius[None]))[0]
        np.testing.assert_allclose(np.sqrt((found - strip.flat) * (found + strip.flat)), rise, rtol=2e-7)


@every_strip
def test_pressure_of_strips(strip: Strip) -> None:
    profile = profile_of(strip)
    b, widest = strip.flat, profile.radius(np.array([[1.8]]))
    share = np.array([-0.5, 0.05, 0.4, 0.9]) if b else np.array([0.05, 0.4, 0.9])
    x = b + (widest[0] - b) * share
    x = x[x > 0.0]
    expected = [strip.outer(each, float(widest[0, 0])) / np.pi for each in x]
    np.testing.assert_allclose(profile.pressure(x[None], widest)[0], expected, rtol=1e-8, atol=1e-9)


@pytest.mark.parametrize("b", [0.0, 0.5])
@pytest.mark.parametrize("count", [60, 500])
def test_a_plane_table_is_at_rest_what_it_is_a_table_of(b: float, count: int) -> None:
    x = np.linspace(0.0, 2.0, count)
    table = TabulatedProfile("mine", x, 0.5 * np.maximum(x - b, 0.0) ** 2, geometry="plane")
    own, exact = AtRest(table), AtRest("rounded_flat", {"flat_half_width": b})
    radius = b + np.linspace(0.05, 1.2, 30)[None]
    for name in ("depth", "half_load"):
        np.testing.assert_allclose(getattr(own, name)(radius), getattr(exact, name)(radius), atol=2e-7)
    edge = np.array([[1.5]])
    np.testing.assert_allclose(own.pressure(radius, edge), exact.pressure(radius, edge), atol=1e-5)


@pytest.mark.parametrize("height", [0.002, 0.05])
def test_waves_are_compact_while_the_load_rises(height: float) -> None:
    """N′ ≥ 0 is 1 + h k² J₀ ≥ 0, h k² below 2.48; the least wavelength is said where it is refused."""
    least = 2.0 * np.pi / np.sqrt(2.4829)
    for share, refused in ((1.002, False), (0.998, True)):
        shape = {"waviness_amplitude": height, "wavelength": share * least}
        wrong = check_shape("wavy_cylinder", shape, 2.5)
        assert (wrong is not None) == refused
        assert not refused or "below 3.988, " in str(wrong)
        assert not refused or "up to the load 2.5 P0" in str(wrong)
        if not refused:
            slope = np.diff(
                profile_of(Strip("wavy_cylinder", shape, float)).depth(np.linspace(0, 1.5, 4000)[None])
            )
            assert (slope > 0.0).all()
