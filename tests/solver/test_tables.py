"""Profiles that are tables: their integrals against quadrature, s against that of closed forms."""

import numpy as np
import pytest
from hypothesis import given as sampled
from hypothesis import settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scenes import points, random_points
from solved import solve_points

import swtstudy
from swtstudy import StudyError, TabulatedProfile

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


@pytest.mark.parametrize(
    ("name", "coarse", "fine"),
    [("rounded_punch", 1e-6, 1e-6), pytest.param("wavy_paraboloid", 1e-5, 3e-7, marks=pytest.mark.slow)],
)
def test_s_converges_to_that_of_the_closed_form(name: str, coarse: float, fine: float) -> None:
    box = random_points(5, 3)
    names = ["poisson_ratio", "friction", "p", "q", "phase", "normal_amplitude", "tangential_amplitude"]
    columns = {name: getattr(box, name) for name in names}
    expected = solve_points(points(name, **columns, **SHAPES[name]), 1e-7)
    for count, tolerance in ((200, coarse), (2000, fine)):
        found = solve_points(points(table(name, count), **columns), 1e-7)
        np.testing.assert_allclose(found.s, expected.s, rtol=tolerance)
        np.testing.assert_allclose(found.critical_x, expected.critical_x, atol=1e-3)


@pytest.mark.parametrize("name", ["", " ", 3])
def test_a_table_without_a_name_is_refused(name: object) -> None:
    with pytest.raises(StudyError, match=f"^name: found {name!r}; allowed: a text that is not empty"):
        TabulatedProfile(name, R, R**2)  # type: ignore[arg-type]


def test_noise_is_smoothed_where_that_is_asked_for() -> None:
    """Heights that are off by 1e-3 δ0 leave s within 2 %; without smoothing g is not even monotone."""
    rng = np.random.default_rng(1)
    r = np.linspace(0.0, 2.0, 400)
    noisy = 0.5 * r * r + 1e-3 * rng.standard_normal(r.size) * (r > 0.0)
    raw, smooth = (TabulatedProfile("pad", r, noisy, smoothing) for smoothing in (0.0, 1e-3))
    assert "pad touches in several places: its fit is wavy at the radius 0." in str(raw.refused_at(1.75))
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


R = np.linspace(0.0, 2.0, 20)


def faced(face: float, sharp: bool, count: int, end: float = 2.9) -> TabulatedProfile:
    """A table of a truncated paraboloid, or of a rounded punch."""
    r = np.linspace(0.0, end, count)
    rise = 0.5 * (r * r - face * face) if sharp else 0.5 * (r - face) ** 2
    return TabulatedProfile(f"face {face:g}", r, np.where(r > face + 1e-9, rise, 0.0))


SOFT = {"normal_amplitude": 0.4, "tangential_amplitude": 0.3, "phase": 1.0}
PULLED = SOFT | {"bulk_stress_amplitude": 0.3, "bulk_stress_mean": 0.3}
PUNCH = faced(0.5, False, 61)


@pytest.mark.parametrize(
    ("profile", "given", "expected", "tolerance"),
    [
        (faced(0.8, True, 101), {"bulk_stress_amplitude": 0.01}, 0.178367, 1e-4),
        (PUNCH, SOFT | {"poisson_ratio": 0.1, "bulk_stress_amplitude": 0.01}, 0.0732657, 2e-6),
        (PUNCH, PULLED | {"poisson_ratio": 0.1}, 0.442225, 2e-6),
        (PUNCH, PULLED | {"poisson_ratio": 0.3}, 0.419470, 2e-6),
    ],
)
def test_a_faced_table_under_a_bulk_stress_has_known_values(
    profile: TabulatedProfile, given: dict[str, float], expected: float, tolerance: float
) -> None:
    assert float(swtstudy.solve(profile=profile, **given, rtol=1e-6).s) == pytest.approx(
        expected, rel=tolerance
    )


@settings(max_examples=4, deadline=None, derandomize=True)
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
    table = faced(face, sharp, count)
    name = "truncated_paraboloid" if sharp else "rounded_punch"
    given = {**others, "criterion": criterion, "normal_amplitude": 0.3, "tangential_amplitude": 0.4}
    if criterion != "swt":
        given["normal_sensitivity"] = 0.4
    twin = swtstudy.solve(rtol=1e-5, profile=name, flat_radius=face, **given)
    found = swtstudy.solve(rtol=1e-5, profile=table, **given)
    assert float(found.s) == pytest.approx(float(twin.s), rel=5e-4 if sharp else 2e-5)


def kinked(rows: int, kink: float, geometry: str = "axisymmetric") -> TabulatedProfile:
    """A paraboloid, or a cylinder, whose slope rises by the kink at r = 0.6."""
    r = np.linspace(0.0, 3.0, rows)
    return TabulatedProfile("kinked", r, r * r + kink * np.maximum(r - 0.6, 0.0), geometry=geometry)


#: s at the place of the maximum by `oracles.line.Line.stress`.
BESIDE_A_KINK = [
    ({"normal_amplitude": 0.7, "tangential_amplitude": 0.02, "phase": 1.5}, 0.1357617),
    ({"normal_amplitude": 0.5, "tangential_amplitude": 0.005, "phase": 0.0}, 0.0309130),
    ({"normal_amplitude": 0.7, "tangential_amplitude": 0.02, "phase": 3.0}, 0.0687762),
    (
        {
            "normal_amplitude": 0.5521182383810957,
            "tangential_amplitude": 0.019799361464862022,
            "phase": 4.712387497123581,
            "frequency_ratio": "1/4",
            "poisson_ratio": 0.0,
            "friction": 0.012129710167299315,
        },
        0.1404911,
    ),
]


@pytest.mark.parametrize(("given", "expected"), BESIDE_A_KINK)
@pytest.mark.parametrize("rtol", [1e-3, 1e-4, 1e-6])
def test_a_peak_of_the_pressure_at_a_kink_is_seen(
    given: dict[str, float], expected: float, rtol: float
) -> None:
    found = swtstudy.solve(profile=kinked(1500, 0.5), rtol=rtol, **given)
    assert float(found.s) == pytest.approx(expected, rel=rtol + 5e-6)
    assert abs(float(found.s) - expected) <= float(found.s_error) + 5e-6 * expected


@pytest.mark.parametrize(
    ("rows", "kink", "geometry"),
    [
        (400, 0.5, "axisymmetric"),
        (1500, 0.1, "plane"),
        (1500, 0.1, "axisymmetric"),
        (5000, 0.5, "axisymmetric"),
    ],
)
def test_s_beside_a_kink_is_the_same_at_every_tolerance(rows: int, kink: float, geometry: str) -> None:
    rng, profile = np.random.default_rng(rows), kinked(rows, kink, geometry)
    kind = "force_amplitude" if geometry == "plane" else "amplitude"
    for _ in range(6):
        given = {
            "friction": 10.0 ** rng.uniform(-2.0, -0.5),
            "phase": rng.uniform(0.0, 6.28),
            f"normal_{kind}": rng.uniform(0.3, 0.95),
            f"tangential_{kind}": 10.0 ** rng.uniform(-3.0, -0.5),
        }
        rough, fine = (swtstudy.solve(profile=profile, rtol=rtol, **given) for rtol in (1e-4, 1e-6))
        assert abs(float(rough.s) - float(fine.s)) <= float(rough.s_error) + float(fine.s_error)
