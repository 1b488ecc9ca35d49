"""The profiles: g from f, inverses, limits, the integrals of the surface stress, compactness."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
from numpy.typing import NDArray
from oracles import profiles as oracle
from scenes import DRAWN, points
from scipy.special import struve, y0
from solved import solve_points

from swtstudy.mechanics.indenter import (
    PROFILES,
    Profile,
    check_shape,
    compact_shapes,
    make_profile,
    too_small,
)
from swtstudy.mechanics.indenter.struve import struve_expansions, struve_functions, struve_integrals
from swtstudy.vocabulary.choices import AXISYMMETRIC, FAMILIES, PLAIN, PLAIN_STRIP, PLANE, Family
from swtstudy.vocabulary.parameters import PARAMETERS

Array = NDArray[np.float64]

#: Largest depth reached: δ0 + δA with δA = δ0.
DEEPEST = 2.0
every_indenter = pytest.mark.parametrize("indenter", oracle.INDENTERS, ids=str)
#: Those of discs; strips are in tests/mechanics/test_plane.py.
ROUND = {name: family for name, family in FAMILIES.items() if family.geometry == AXISYMMETRIC}
every_family = pytest.mark.parametrize("family", ROUND.values(), ids=ROUND)
every_plain_shape = pytest.mark.parametrize(
    "indenter", [one for one in oracle.INDENTERS if FAMILIES[one.profile].plain], ids=str
)


def batch(indenter: oracle.Indenter, count: int = 1, depth: float = DEEPEST) -> Profile:
    """The package's profiles of the same shape, ``count`` times."""
    shape = {name: np.full(count, value) for name, value in indenter.shape.items()}
    return make_profile(indenter.profile, shape, np.full(count, depth))


def reached(indenter: oracle.Indenter, share: Array) -> Array:
    """Radii at a share of the way from the face or centre to the largest contact radius, shape (1, k)."""
    b, largest = indenter.flat_radius, batch(indenter).radius(np.array([[DEEPEST]]))
    return b + (largest - b) * share


@every_family
def test_a_family_is_a_row_a_class_and_an_oracle(family: Family) -> None:
    """Nothing here may be left to itself: each family is looked at by all tests of this file."""
    assert oracle.ORACLES.get(family.name), f"{family.name} has no oracle in tests/oracles/profiles.py"
    assert family.name in PROFILES, f"{family.name} has no class in swtstudy/mechanics/indenter"
    of_class = list(inspect.signature(PROFILES[family.name]).parameters)
    assert of_class == ["largest_depth", *family.shape]
    assert {*family.shape} <= {name for name, row in PARAMETERS.items() if row.part == "shape"}
    for indenter in oracle.ORACLES[family.name]:
        assert (indenter.profile, (*indenter.shape,)) == (family.name, family.shape)
    if family.plain:
        name, value = family.plain
        assert name in family.shape
        assert PARAMETERS[name].lower <= value <= PARAMETERS[name].upper


def test_the_tables_of_families_are_of_the_same_families() -> None:
    assert [*PROFILES] == [*FAMILIES]
    assert [*ROUND] == [*oracle.ORACLES]
    assert FAMILIES[PLAIN] == Family(PLAIN)
    assert FAMILIES[PLAIN_STRIP] == Family(PLAIN_STRIP, geometry=PLANE)
    assert PARAMETERS["profile"].default == PLAIN
    shapes = {name for family in FAMILIES.values() for name in family.shape}
    assert shapes | {"profile"} == {name for name, row in PARAMETERS.items() if row.part == "shape"}


@every_indenter
def test_edges_of_faces(indenter: oracle.Indenter) -> None:
    """The stress has no bound where m = g′ w does not vanish at the edge of a face."""
    profile = batch(indenter)
    assert profile.flat_radius == indenter.flat_radius
    assert profile.has_singular_edge == (indenter.flat_radius > 0.0 and indenter.weighted_slope(0.0) > 0.0)
    sharp_tip = indenter.flat_radius == 0.0 and indenter.slope(1e-6) > 1e-3
    assert bool(profile.singular_approach.size) == profile.has_singular_edge or sharp_tip


@every_indenter
def test_profiles_that_are_taken(indenter: oracle.Indenter) -> None:
    """A part of a batch, in another order: each profile is what it was, of other depths and shapes."""
    depths = np.array([2.0, 0.7, 1.3])
    shape = {name: value * np.array([1.0, 1.1, 1.2]) for name, value in indenter.shape.items()}
    whole, index = make_profile(indenter.profile, shape, depths), np.array([2, 0, 2])
    part = whole.take(index)
    assert type(part) is type(whole)
    np.testing.assert_array_equal(part.largest_depth, depths[index])
    radius = whole.radius(depths[:, None] * np.linspace(0.1, 1.0, 7))
    for name in ("depth", "weighted_slope", "half_load"):
        found, expected = (getattr(one, name)(r) for one, r in ((part, radius[index]), (whole, radius)))
        np.testing.assert_allclose(found, expected[index], rtol=1e-13)
    np.testing.assert_allclose(part.radius(depths[index, None]), radius[index, -1:], rtol=1e-12)


@every_indenter
def test_depth_and_weighted_slope_in_one(indenter: oracle.Indenter) -> None:
    profile, xi = batch(indenter), reached(indenter, np.linspace(0.0, 1.0, 9))
    both = profile.depth_and_weighted_slope(xi)
    np.testing.assert_array_equal(both, (profile.depth(xi), profile.weighted_slope(xi)))


@every_indenter
def test_radius_of_a_load(indenter: oracle.Indenter) -> None:
    """Also next to a face, where loads are the cube of what they are of."""
    profile = batch(indenter)
    largest = float(profile.radius(profile.largest_depth[:, None])[0, 0])
    b = indenter.flat_radius
    radius = np.hypot(b, np.sqrt((largest - b) * (largest + b)) * np.geomspace(1e-4, 1.0, 200))[None]
    found = profile.radius_of_half_load(profile.half_load(radius))
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
    kept = {name: values[compact] for name, values in shape.items()}
    count = int(compact.sum()) if family.shape else 1
    profile = make_profile(family.name, kept, np.full(count, depth))
    b, largest = profile.flat_radius[:, None], profile.radius(np.full((count, 1), depth))
    assert np.all(profile.weighted_slope(b + (largest - b) * np.linspace(1e-3, 1.0, 400)) >= -1e-9)


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
    np.testing.assert_allclose(batch(indenter).depth(xi)[0], expected, rtol=0.0, atol=1e-10)


@every_indenter
def test_slope_of_g(indenter: oracle.Indenter) -> None:
    xi = reached(indenter, np.linspace(0.01, 1.0, 30))
    profile, step = batch(indenter), 1e-6
    slope = profile.weighted_slope(xi) / np.sqrt(xi**2 - indenter.flat_radius**2)
    np.testing.assert_allclose(slope[0], [indenter.slope(x) for x in xi[0]], rtol=1e-9, atol=1e-9)
    # The oracle's own g′ against its g: the difference quotient's error is 1e-12 g‴ + 1e-13/1e-6.
    far = xi[0, 5:]
    quotient = [(indenter.depth(x + step) - indenter.depth(x - step)) / (2.0 * step) for x in far]
    np.testing.assert_allclose(slope[0, 5:], quotient, rtol=1e-6, atol=1e-6)


@every_indenter
def test_contact_radius_inverts_g(indenter: oracle.Indenter) -> None:
    depths = np.concatenate([[0.0], np.geomspace(1e-9, DEEPEST, 200)])[None]
    profile = batch(indenter)
    radius = profile.radius(depths)
    assert radius[0, 0] == indenter.flat_radius
    assert np.all(np.diff(radius[0]) >= 0.0)
    # Next to the face a double ξ knows w = √(ξ² − b²) to 2e-8 b only, and g may be as steep as b w.
    atol = 1e-11 + 2e-8 * indenter.flat_radius**2
    np.testing.assert_allclose(profile.depth(radius), depths, rtol=1e-9, atol=atol)


@pytest.mark.parametrize("flat_radius", [1e-9, 1e-7, 2.3e-6, 1e-4, 1e-3])
def test_contact_radius_over_a_small_face(flat_radius: float) -> None:
    # Beside the contact edge the stress shows the square root of what the radius misses.
    profile = make_profile("rounded_punch", {"flat_radius": np.array([flat_radius])}, np.array([DEEPEST]))
    radius = flat_radius + np.geomspace(1e-3, 1.3, 1000)[None]
    np.testing.assert_allclose(profile.radius(profile.depth(radius)), radius, rtol=2e-15)


@every_indenter
def test_half_of_the_normal_load(indenter: oracle.Indenter) -> None:
    radius = reached(indenter, np.array([0.1, 0.5, 1.0]))
    # ∫ ξ g′ dξ = a g(a) − ∫ g dξ, smooth up to the face.
    b = indenter.flat_radius
    expected = [
        a * indenter.depth(a) - oracle.integral(lambda x: indenter.depth(x) if x > b else 0.0, b, a)
        for a in radius[0]
    ]
    np.testing.assert_allclose(batch(indenter).half_load(radius)[0], expected, rtol=1e-9, atol=1e-11)


def stress_positions(indenter: oracle.Indenter) -> Array:
    """Positions near the centre, under and around the edge of a face, and near the contact's edges."""
    b = indenter.flat_radius
    edges = batch(indenter).radius(np.array([[0.25, 1.0, DEEPEST]]))[0]
    around_face = b * np.array([0.01, 0.5, 0.99, 1.0 - 1e-5, 1.0 + 1e-5, 1.01])
    around_edges = np.outer(edges, [0.97, 1.0 - 1e-6, 1.0, 1.02]).ravel()
    inside = np.array([0.02, 0.3]) * edges[-1]
    return np.unique(np.concatenate([around_face[around_face > 0.0], around_edges, inside]))


@every_indenter
def test_stress_integrals_against_quadrature(indenter: oracle.Indenter) -> None:
    position = stress_positions(indenter)
    radius = np.append(position, batch(indenter).radius(np.array([[0.6]]))[0])
    radius = np.sort(np.minimum(radius, batch(indenter).radius(np.array([[DEEPEST]]))[0, 0]))
    primitives = batch(indenter).primitives(position[None], 9.0)
    upper = np.broadcast_to(radius, (1, position.size, radius.size))
    inner, outer = (f(upper)[:, 0] for f in (primitives.inner, primitives.outer))
    np.testing.assert_array_equal(primitives.pressure(upper)[0], outer[0])
    largest = max(inner.max(), outer.max(), 1.0)
    for k, r in enumerate(position):
        for j in range(k % 5, radius.size, 5):
            assert inner[:, k, j] == pytest.approx(indenter.inner(r, radius[j]), abs=1e-9 * largest)
            pressure, load = indenter.outer(r, radius[j])
            assert outer[0, k, j] == pytest.approx(pressure, abs=1e-9 * largest)
            # Next to the axis W turns within v ~ r.
            near_axis = r < 0.2 * radius[-1] and indenter.flat_radius == 0.0
            assert outer[1, k, j] == pytest.approx(load, abs=(1e-5 if near_axis else 1e-9) * largest)


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
    deepest = np.array([DEEPEST])
    limit = make_profile(PLAIN, {}, deepest)
    profile = make_profile(name, {key: np.array([value]) for key, value in shape.items()}, deepest)
    depth = np.linspace(0.01, DEEPEST, 50)[None]
    radius = limit.radius(depth)
    np.testing.assert_allclose(profile.radius(depth), radius, rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(profile.depth(radius), depth, rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(profile.half_load(radius), limit.half_load(radius), rtol=0.0, atol=tolerance)
    position = np.array([[0.1, 0.7, 1.0, 1.3]])
    upper = np.broadcast_to(radius, (1, 4, 50))
    for integrals in ("inner", "outer"):
        found, expected = (
            getattr(one.primitives(position, 9.0), integrals)(upper) for one in (profile, limit)
        )
        # A wave changes the slope by more than the depth: by √(h/δ0) for λ ~ √(hR).
        atol = 1e-9 + (
            tolerance if name != "wavy_paraboloid" else 10.0 * np.sqrt(shape["waviness_amplitude"])
        )
        np.testing.assert_allclose(found[:, :, 1:], expected[:, :, 1:], rtol=0.0, atol=atol)
        # Next to the axis W turns within v ~ r.
        np.testing.assert_allclose(found[:, :, :1], expected[:, :, :1], rtol=0.0, atol=max(atol, 1e-5))


def test_struve_functions_next_to_a_zero_where_the_library_fails() -> None:
    z = 25.765363129500482
    assert np.isnan(struve(0, z))  # else the integrals have become superfluous
    value = struve_integrals(np.array([z - 1e-9, z, z + 1e-9]))[0]
    # Its asymptotic series (DLMF 11.6.1), whose first neglected term is below 1e-12 here.
    series = sum(c / z**k for c, k in ((1, 1), (-1, 3), (9, 5), (-225, 7), (11025, 9), (-893025, 11)))
    np.testing.assert_allclose(value, y0(z) + 2.0 / np.pi * series, atol=1e-9)


@pytest.mark.parametrize("largest", [0.0, 1.0, 66.0])
def test_struve_functions_by_their_integrals(largest: float) -> None:
    z = np.append(np.random.default_rng(0).uniform(0.0, largest, 2000), [0.0, largest])
    for order, value in enumerate(struve_integrals(z)):
        expected = struve(order, z)
        known = ~np.isnan(expected)
        assert known.sum() > 1990
        np.testing.assert_allclose(value[known], expected[known], rtol=0.0, atol=1e-13 * (1.0 + largest))


@pytest.mark.parametrize("largest", [100.0, 1e5])
def test_struve_functions_by_their_expansions(largest: float) -> None:
    z = np.append(np.random.default_rng(0).uniform(64.0, largest, 2000), [64.0, largest])
    np.testing.assert_allclose(struve_expansions(z), struve([[0], [1]], z), rtol=0.0, atol=2e-13)


@pytest.mark.parametrize("largest", [60.0, 900.0, 5000.0])
def test_struve_functions_of_the_table(largest: float) -> None:
    z = np.random.default_rng(0).uniform(0.0, largest, (40, 50))
    expected = struve(np.arange(2)[:, None, None], z)
    known = ~np.isnan(expected)
    assert known.mean() > 0.99
    np.testing.assert_allclose(np.array(struve_functions(z))[known], expected[known], rtol=0.0, atol=1e-10)


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
    punch = make_profile("rounded_punch", {"flat_radius": np.array([20.0 / unit])}, np.ones(1))
    contact = punch.radius(np.ones((1, 1)))
    radius = contact[0, 0] * unit
    force = 2.0 * effective * depth * unit * punch.half_load(contact)[0, 0]
    assert radius == pytest.approx(20.38, abs=0.005)
    assert force == pytest.approx(311.21e3, abs=5.0)
    assert force / (np.pi * radius**2) == pytest.approx(238.49, abs=0.005)
