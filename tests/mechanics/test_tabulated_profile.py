"""Profiles that are tables: their integrals against quadrature, s against that of closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given as sampled
from hypothesis import settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from oracles import profiles as oracle
from scenes import points, random_points
from scipy.integrate import quad

import swtstudy
from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body import Body, closer_nodes, time_nodes
from swtstudy.mechanics.indenter import TabulatedProfile, make_profile
from swtstudy.mechanics.indenter.slope_fit import SlopePieces, exact_slope, spline
from swtstudy.mechanics.line.positions import cusps
from swtstudy.mechanics.stress.scene import scene_of
from swtstudy.vocabulary.mistakes import StudyError

Array = NDArray[np.float64]

H, WAVELENGTH = 0.05, 5.0
SHAPES = {
    "paraboloid": {},
    "rounded_punch": {"flat_radius": 0.5},
    "wavy_paraboloid": {"waviness_amplitude": H, "wavelength": WAVELENGTH},
}


def height(name: str, r: Array) -> Array:
    """f of the paper's profiles (eqs. 3, 4, 6), over δ0."""
    if name == "rounded_punch":
        return np.where(r > 0.5, 0.5 * (r - 0.5) ** 2, 0.0)
    waves = H * (1.0 - np.cos(2.0 * np.pi / (WAVELENGTH * np.sqrt(H)) * r))
    return 0.5 * r * r + (waves if name == "wavy_paraboloid" else 0.0)


def table(name: str, count: int = 200, end: float = 2.5) -> TabulatedProfile:
    r = np.linspace(0.0, end, count)
    return TabulatedProfile(f"{name} of {count}", r, height(name, r))


def worn(face: float = 0.4, blend: float = 0.1) -> TabulatedProfile:
    """A paraboloid with a flat face and a blend, finer there."""
    r = np.unique(np.concatenate([np.linspace(0.0, 2.0, 81), face + blend * np.linspace(0.0, 1.5, 31)]))
    slope = np.interp(r, [0.0, face, face + blend, 2.0], [0.0, 0.0, face + blend, 2.0])
    f = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(r))])
    return TabulatedProfile("worn", r, f)


@pytest.mark.parametrize("face", [0.0, 0.35])
def test_g_is_abels_transform_of_the_spline(face: float) -> None:
    """Few, uneven points: the closed form over the pieces, not what it stands for."""
    r = np.array([0.0, 0.1, 0.35, 0.5, 0.6, 0.9, 1.0, 1.3, 1.4])
    f = spline(r, np.where(r > face, (r - face) ** 2 + 0.3 * (r - face) ** 3, 0.0), 0.0)
    rate, bend = f.derivative(), f.derivative(2)

    def integrand(θ: float, ξ: float) -> float:
        x = ξ * np.sin(θ)
        return float(rate(x) + x * bend(x)) if x > f.x[0] else 0.0

    for ξ in (0.42, 0.55, 1.07, 1.38):
        kinks = np.arcsin(np.minimum(f.x / ξ, 1.0))
        expected = quad(integrand, kinks[0], 0.5 * np.pi, (ξ,), points=kinks[kinks < 1.5], epsabs=1e-12)[0]
        assert exact_slope(f, np.array([ξ]))[0] == pytest.approx(expected, abs=1e-9)
    assert f(f.x[0]) == rate(f.x[0]) == 0.0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::scipy.integrate.IntegrationWarning")
@pytest.mark.parametrize("one", [table("wavy_paraboloid", 60), worn()], ids=lambda one: one.name)
def test_integrals_of_the_pieces(one: TabulatedProfile) -> None:
    """Pressure, tractions and load of the pieces as they are, over all of them and within one."""
    profile = make_profile(one, {}, np.array([1.5]))
    b = float(profile.flat_radius[0])

    def weighted_slope(w: float) -> float:
        return float(profile.weighted_slope(np.array([[np.hypot(w, b)]]))[0, 0])

    of_table = oracle.Indenter(one.name, {}, lambda r: 0.0, weighted_slope, b)
    largest = float(profile.radius(np.array([[1.5]]))[0, 0])
    position = np.array([0.3, 0.39, 0.41, 0.45, 0.7, 1.1]) * largest
    radius = np.append(position[1:], largest)
    primitives = profile.primitives(position[None], 9.0)
    every = np.broadcast_to(radius, (1, position.size, radius.size))
    inner, outer = primitives.inner(every)[:, 0], primitives.outer(every)[:, 0]
    # The same radii for all positions.
    np.testing.assert_array_equal(primitives.inner(radius[None, None])[:, 0], inner)
    np.testing.assert_array_equal(primitives.outer(radius[None, None])[:, 0], outer)
    for k, r in enumerate(position.tolist()):
        for j in {k, (k + 3) % radius.size}:
            np.testing.assert_allclose(inner[:, k, j], of_table.inner(r, radius[j]), rtol=0.0, atol=2e-8)
            # Behind a face g′ and g′/ξ are fitted each by itself, at a kink to what 105 points tell.
            np.testing.assert_allclose(outer[:, k, j], of_table.outer(r, radius[j]), rtol=0.0, atol=2e-5)


@pytest.mark.parametrize("one", [table("wavy_paraboloid", 60), worn()], ids=lambda one: one.name)
def test_contact_radius_and_load(one: TabulatedProfile) -> None:
    depths = np.concatenate([[0.0], np.geomspace(1e-9, 1.5, 100)])[None]
    profile = make_profile(one, {}, np.array([1.5]))
    radius = profile.radius(depths)
    assert radius[0, 0] == profile.flat_radius[0]
    np.testing.assert_allclose(profile.depth(radius), depths, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(profile.radius_of_half_load(profile.half_load(radius)), radius, rtol=1e-7)
    # ∫ ξ g′ dξ = ξ g − ∫ g dξ.
    ξ = np.linspace(radius[0, 0], radius[0, -1], 20001)
    g = profile.depth(ξ[None])[0]
    expected = ξ[-1] * g[-1] - np.trapezoid(g, ξ)
    assert profile.half_load(radius[:, -1:])[0, 0] == pytest.approx(expected, rel=3e-6)


@pytest.mark.parametrize(
    ("name", "coarse", "fine"),
    [("rounded_punch", 1e-6, 1e-6), pytest.param("wavy_paraboloid", 1e-5, 3e-7, marks=pytest.mark.slow)],
)
def test_s_converges_to_that_of_the_closed_form(name: str, coarse: float, fine: float) -> None:
    box = random_points(5, 3)
    columns = {
        name: getattr(box, name)
        for name in (
            "poisson_ratio",
            "friction",
            "p",
            "q",
            "phase",
            "normal_amplitude",
            "tangential_amplitude",
        )
    }
    expected = solve_points(points(name, **columns, **SHAPES[name]), 1e-7)
    for count, tolerance in ((200, coarse), (2000, fine)):
        found = solve_points(points(table(name, count), **columns), 1e-7)
        np.testing.assert_allclose(found.s, expected.s, rtol=tolerance)
        np.testing.assert_allclose(found.critical_x, expected.critical_x, atol=1e-3)


def test_without_a_face_the_heights_begin_at_the_axis() -> None:
    """However flat they are there."""
    r = np.linspace(0.0, 1.0, 20)
    assert spline(r, r**4, 0.0).x[0] == 0.0
    assert spline(np.append(-0.1, r) + 0.1, np.append(0.0, r**4), 0.0).x[0] > 0.1


def test_heights_that_are_smoothed_begin_at_0() -> None:
    r = np.linspace(0.0, 1.0, 40)
    assert spline(r, r * r + 1e-3 * np.sin(50.0 * r), 1e-3)(0.0) == 0.0


@pytest.mark.parametrize("name", ["", " ", 3])
def test_a_table_without_a_name_is_refused(name: object) -> None:
    with pytest.raises(StudyError, match=f"^name: found {name!r}; allowed: a text that is not empty"):
        TabulatedProfile(name, R, R**2)  # type: ignore[arg-type]


def test_s_over_a_blend_is_that_of_the_field() -> None:
    batch = points(worn(), phase=[0.3, 2.0], friction=[0.3, 0.6])
    found = solve_points(batch, 1e-6)
    for k, x in enumerate(found.critical_x.tolist()):
        scene = scene_of(batch.take(np.array([k])))
        nodes = closer_nodes(scene, time_nodes(scene, 5, [abs(x)]), (x, 0.0, 0.0), cells=80)
        assert float(Body(scene, nodes, cells=80).swt(x, 0.0, 0.0).swt) == pytest.approx(found.s[k], rel=2e-5)


def test_noise_is_smoothed_where_that_is_asked_for() -> None:
    """Heights that are off by 1e-3 δ0 leave s within 2 %; without smoothing g is not even monotone."""
    rng = np.random.default_rng(1)
    r = np.linspace(0.0, 2.0, 400)
    noisy = 0.5 * r * r + 1e-3 * rng.standard_normal(r.size) * (r > 0.0)
    raw, smooth = (TabulatedProfile("pad", r, noisy, smoothing) for smoothing in (0.0, 1e-3))
    assert "g′ < 0 at the radius 0." in str(raw.refused_at(1.75))
    assert smooth.refused_at(1.75) is None
    assert raw.deviation < 1e-15
    assert 1.5e-3 < smooth.deviation < 6e-3
    load = {"phase": np.linspace(0.0, 6.0, 7)}
    found, expected = (solve_points(points(profile, **load), 1e-5).s for profile in (smooth, "paraboloid"))
    missed = np.abs(found / expected - 1.0)
    assert 1e-4 < missed.max() < 2e-2


def test_the_largest_depth_of_a_table() -> None:
    one = table("paraboloid", end=1.5)
    assert one.deepest == pytest.approx(2.25, rel=1e-9)
    assert one.refused_at(2.2) is None
    assert one.refused_at(2.3) == (
        "the depth 2.3 is beyond the table of paraboloid of 200, which ends at the radius 1.5: the contact "
        "is as large as that at the depth 2.25"
    )


def test_beyond_its_end_a_table_goes_on_as_it_ends() -> None:
    """Here the last piece is wider than the one before it."""
    r = np.linspace(0.0, 2.0, 30)
    f = spline(r, 0.5 * r * r + 0.2 * np.maximum(r - 1.6, 0.0) ** 2, 0.0)
    pieces = SlopePieces.of(f, 1e-4)
    assert pieces.start[-1] == 2.0
    assert np.diff(pieces.start, 2)[-1] > 0.0
    ξ = np.array([2.0 - 1e-9, 2.0 + 1e-9])
    slope, over_radius = (pieces.value(c, ξ, pieces.piece(ξ)) for c in (pieces.slope, pieces.over_radius))
    np.testing.assert_allclose(slope, exact_slope(f, np.full(2, 2.0)), rtol=1e-4)
    np.testing.assert_allclose(over_radius * ξ, slope, rtol=1e-4)


R = np.linspace(0.0, 2.0, 20)


@pytest.mark.parametrize(
    ("radius", "heights", "smoothing", "message"),
    [
        (R[:7], R[:7] ** 2, 0.0, "found 7 radii and 7 heights; allowed: as many of each, at least 8"),
        (R, R[1:], 0.0, "found 20 radii and 19 heights"),
        (R + 0.1, R**2, 0.0, "found a first point at the radius 0.1 with the height 0; allowed: 0 and 0"),
        (R, R**2 + 0.5, 0.0, "found a first point at the radius 0 with the height 0.5"),
        (np.where(R[7] == R, R[6], R), R**2, 0.0, "found 0.631579 after 0.631579; allowed: ascending radii"),
        (
            R,
            np.where(R > 1.0, np.nan, R),
            0.0,
            "pad.height: found no one-dimensional array of finite numbers",
        ),
        (R, 0.0 * R, 0.0, "found a flat face alone"),
        (R, -R * R, 0.0, "found heights that fall from the axis; allowed: heights with the other sign"),
        (R, np.maximum(R - R[-6], 0.0), 0.0, "allowed: at least 6 points beside it"),
        (R, R**2, -1.0, "pad.smoothing: found -1.0; allowed: a number ≥ 0"),
        ("no", R**2, 0.0, "pad.radius: found no one-dimensional"),
    ],
)
def test_tables_that_are_refused(radius: Array, heights: Array, smoothing: float, message: str) -> None:
    with pytest.raises(StudyError) as caught:
        TabulatedProfile("pad", radius, heights, smoothing)
    assert message in str(caught.value)


def test_landmarks_part_the_line_with_a_bulk_stress_too() -> None:
    """The slope is bent there, whatever else the search has to look at."""
    point = replace(points(phase=0.7), profile=worn())
    for some in (point, replace(point, bulk_stress_amplitude=np.array([0.01]))):
        scene = scene_of(some)
        ends = cusps(scene.cycle, scene.coordinate, scene.critical_everywhere)
        landmarks = scene.profile.landmarks
        within = landmarks[landmarks < scene.largest_radius[:, None]]
        assert within.size > 0
        assert np.isin(within, ends).all()


def faced(face: float, sharp: bool, count: int, end: float = 2.9) -> TabulatedProfile:
    """A table of a truncated paraboloid, or of a rounded punch."""
    r = np.linspace(0.0, end, count)
    rise = 0.5 * (r * r - face * face) if sharp else 0.5 * (r - face) ** 2
    return TabulatedProfile(f"face {face:g}", r, np.where(r > face + 1e-9, rise, 0.0))


SOFT = {"normal_amplitude": 0.4, "tangential_amplitude": 0.3, "phase": 1.0}


@pytest.mark.parametrize(
    ("profile", "given", "expected", "tolerance"),
    [
        (faced(0.8, True, 101), {"bulk_stress_amplitude": 0.01}, 0.178367, 1e-4),
        (
            faced(0.5, False, 61),
            SOFT | {"poisson_ratio": 0.1, "bulk_stress_amplitude": 0.01},
            0.0732657,
            2e-6,
        ),
        (
            faced(0.5, False, 61),
            SOFT | {"poisson_ratio": 0.1, "bulk_stress_amplitude": 0.3, "bulk_stress_mean": 0.3},
            0.442225,
            2e-6,
        ),
        (
            faced(0.5, False, 61),
            SOFT | {"poisson_ratio": 0.3, "bulk_stress_amplitude": 0.3, "bulk_stress_mean": 0.3},
            0.419470,
            2e-6,
        ),
    ],
)
def test_a_faced_table_under_a_bulk_stress_has_known_values(
    profile: TabulatedProfile, given: dict[str, float], expected: float, tolerance: float
) -> None:
    assert float(swtstudy.solve(profile=profile, **given).s) == pytest.approx(expected, rel=tolerance)


@settings(max_examples=8, deadline=None, derandomize=True)
@sampled(
    face=st.sampled_from([0.1, 0.3, 0.55, 0.8, 1.2]),
    sharp=st.booleans(),
    count=st.integers(61, 140),
    criterion=st.sampled_from(["swt", "findley", "fatemi_socie"]),
    poisson_ratio=st.sampled_from([0.0, 0.1, 0.3, 0.5]),
    bulk_stress_amplitude=st.sampled_from([0.0, 0.01, 0.3]),
    bulk_stress_mean=st.sampled_from([0.0, 0.3]),
    phase=st.floats(0.0, 6.0),
)
def test_a_faced_table_agrees_with_its_built_in_twin(
    face: float, sharp: bool, count: int, criterion: str, **others: float
) -> None:
    """To what the table leaves open: its edge may lie anywhere between two of its radii."""
    sharp = sharp and criterion == "swt"  # shear has no bound at a sharp edge
    name = "truncated_paraboloid" if sharp else "rounded_punch"
    given = {**others, "criterion": criterion, "normal_amplitude": 0.3, "tangential_amplitude": 0.4}
    if criterion != "swt":
        given["normal_sensitivity"] = 0.4
    twin = swtstudy.solve(rtol=1e-5, profile=name, flat_radius=face, **given)
    found = swtstudy.solve(rtol=1e-5, profile=faced(face, sharp, count), **given)
    assert float(found.s) == pytest.approx(float(twin.s), rel=5e-4 if sharp else 2e-5)
