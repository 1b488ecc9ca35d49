"""All profiles as data of the compiled kernel: depth, force and functionals."""

from collections.abc import Callable

import numpy as np
import pytest
from scenes import PLANE_NAMES, PROFILE_NAMES
from scipy.integrate import quad
from scipy.special import j1, struve

import swtstudy
from swtstudy.kernel.batch import solve_batch
from swtstudy.kernel.compiled import new_record
from swtstudy.kernel.profile import MAX_PANELS, coordinate_at, density_at, force_at, place_of, radius_of
from swtstudy.kernel.profiles import profile_record
from swtstudy.kernel.surface import TABLE, hertz, running, strip_hertz, tabulate

pytestmark = pytest.mark.xdist_group("kernel")
#: Amplitude h/δ0 and k of the waves below.
H, K = 0.05, 2.0 * np.pi / (6.5 * np.sqrt(0.05))
#: Depth in δ0, or line load in N_0, over ξ: (3) to (6) and those of plane contacts.
DEPTHS: list[tuple[str, dict[str, float], Callable[[float], float]]] = [
    ("paraboloid", {}, lambda x: x * x),
    ("power_law", {"exponent": 1.0005}, lambda x: x**1.0005),
    ("power_law", {"exponent": 3.3}, lambda x: x**3.3),
    ("power_law", {"exponent": 20.0}, lambda x: x**20),
    *(
        (
            "rounded_punch",
            {"flat_radius": b},
            lambda x, b=b: x * np.sqrt(x * x - b * b) - b * x * np.arccos(b / x),
        )
        for b in (0.5, 100.0)
    ),
    *(
        ("truncated_paraboloid", {"flat_radius": b}, lambda x, b=b: x * np.sqrt(x * x - b * b))
        for b in (0.5, 100.0)
    ),
    (
        "wavy_paraboloid",
        {"waviness_amplitude": H, "wavelength": 6.5},
        lambda x: x * x + 0.5 * np.pi * H * K * x * struve(0, K * x),
    ),
    ("cylinder", {}, lambda x: x * x),
    ("power_law_cylinder", {"exponent": 1.5}, lambda x: x**1.5),
    *(
        (
            "rounded_flat",
            {"flat_half_width": b},
            lambda x, b=b: (x * x * np.arccos(b / x) - b * np.sqrt(x * x - b * b)) * 2.0 / np.pi,
        )
        for b in (0.5, 100.0)
    ),
    (
        "wavy_cylinder",
        {"waviness_amplitude": H, "wavelength": 6.5},
        lambda x: x * x + 2.0 * H * K * x * j1(K * x),
    ),
]
#: Densities below 1e-3 are not resolved further.
FLOOR = 1e-12
IDS = [f"{name} {next(iter(shape.values()), '')}" for name, shape, _ in DEPTHS]


def test_all_families_are_tested() -> None:
    assert {name for name, _, _ in DEPTHS} == {*PROFILE_NAMES, *PLANE_NAMES}


@pytest.mark.parametrize(("name", "shape", "depth"), DEPTHS, ids=IDS)
def test_depth_and_force_are_those_of_the_formulae(
    name: str, shape: dict[str, float], depth: Callable[[float], float]
) -> None:
    in_depth = profile_record(name, shape, False, 2.0, 1e-7)
    s = place_of(in_depth, 2.0) * np.linspace(0.05, 1.0, 12)
    radius = [radius_of(in_depth, one) for one in s]
    known = [depth(x) for x in radius]
    rounding = 1e-7 if radius[0] > 10.0 else 1e-12  # of the formulae on a large face
    assert [coordinate_at(in_depth, one) for one in s] == pytest.approx(known, rel=1e-9, abs=rounding)
    if name in PLANE_NAMES:
        return
    # ∫ ξ dg = ξ g - ∫ g dξ, over the value at the radius where g = 1.
    b = in_depth.flat_radius
    load = [x * depth(x) - quad(depth, b, x, epsabs=1e-12)[0] for x in radius]
    assert [force_at(in_depth, one) for one in s] == pytest.approx(load, rel=1e-8, abs=100.0 * rounding)
    in_force = profile_record(name, shape, True, 2.0, 1e-7)
    unit = force_at(in_depth, place_of(in_depth, 1.0))
    for one, value in zip(s, load, strict=True):
        if value <= 2.0 * unit:
            assert coordinate_at(in_force, one) == pytest.approx(value / unit, rel=1e-7, abs=100.0 * rounding)


@pytest.mark.parametrize("in_force", [False, True])
@pytest.mark.parametrize(("name", "shape", "depth"), DEPTHS, ids=IDS)
def test_places_are_known_to_rounding_down_to_the_smallest_depth(
    name: str, shape: dict[str, float], depth: object, in_force: bool
) -> None:
    record = profile_record(name, shape, in_force, 2.0, 1e-6)
    coordinate = np.append(0.0, 10.0 ** np.linspace(-60.0, np.log10(2.0), 500))
    place = np.array([place_of(record, one) for one in coordinate])
    assert np.all(np.diff(place) > 0.0)
    assert [coordinate_at(record, one) for one in place] == pytest.approx(coordinate, rel=1e-12, abs=0.0)


@pytest.mark.parametrize(("name", "shape", "depth"), DEPTHS, ids=IDS)
def test_functionals_are_the_integrals(name: str, shape: dict[str, float], depth: object) -> None:
    record = profile_record(name, shape, True, 2.0, 1e-7)
    b, top, plane = record.flat_radius, place_of(record, 2.0), name in PLANE_NAMES
    table = new_record(TABLE)

    def density(s: float) -> float:
        return float(density_at(record, s))

    for X in (0.03 * top, 0.6 * top, 0.97 * top):
        x = float(np.hypot(X, b))
        if record.is_hertz:
            inside = (strip_hertz if plane else hertz)(0.5 * X, x)
            outside = (strip_hertz if plane else hertz)(top, x)
        else:
            panels = record.begin, record.end, record.density
            tabulate(table, 0, 0, *panels, 0, record.panels, top, b, x, X, 0, record.plane)
            inside, outside = (running(table, 0, s, X, 0) for s in (0.5 * X, top))

        def within(angle: float, power: int, X: float = X, x: float = x) -> float:
            s = X * np.sin(angle)
            return 2.0 * (np.hypot(s, b) / x) ** power * density(s)

        def beyond(angle: float, X: float = X) -> float:
            return density(X * np.cosh(angle))

        first = quad(within, 0.0, np.pi / 6.0, (0 if plane else 1,), epsrel=1e-10, limit=200)[0]
        third = 0.0 if plane else quad(within, 0.0, np.pi / 6.0, (3,), epsrel=1e-10, limit=200)[0]
        pressure = quad(beyond, 0.0, np.arccosh(top / X), epsrel=1e-10, limit=200)[0]
        assert inside[0] == pytest.approx(first, rel=1e-6, abs=FLOOR)
        assert plane or inside[1] == pytest.approx(third, rel=1e-6, abs=1e-6 * abs(outside[1]) + FLOOR)
        assert outside[2] == pytest.approx(pressure, rel=1e-7)


@pytest.mark.parametrize("name", ["rounded_punch", "truncated_paraboloid", "rounded_flat"])
def test_functionals_under_a_face_are_the_integrals(name: str) -> None:
    width = "flat_half_width" if name == "rounded_flat" else "flat_radius"
    record, table = profile_record(name, {width: 0.5}, True, 2.0, 1e-7), new_record(TABLE)
    b, top = record.flat_radius, place_of(record, 2.0)
    x, X = 0.8 * b, 0.6 * b
    panels = record.begin, record.end, record.density
    tabulate(table, 0, 0, *panels, 0, record.panels, top, b, x, X, 1, record.plane)
    for s in (0.5 * X, top):
        pressure = quad(lambda z: float(density_at(record, X * np.sinh(z))), 0.0, np.arcsinh(s / X))[0]
        assert running(table, 0, s, X, 1)[2] == pytest.approx(pressure, rel=1e-6)


@pytest.mark.parametrize("mu", [0.1, 0.7])
@pytest.mark.parametrize("rtol", [1e-4, 1e-6])
def test_a_cylinder_under_a_constant_load(mu: float, rtol: float) -> None:
    """The closed form: s = μ² Q_A/(μP), at the edge."""
    found = solve_batch("cylinder", [0.3], [mu], [0.0], [0.6], [1], [0.0], control=(True, True), rtol=rtol)[0]
    assert abs(found["s"] - mu * mu * 0.6) <= found["s_error"] <= rtol * found["s"]
    assert abs(found["critical_x"]) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("geometry", ["axisymmetric", "plane"])
@pytest.mark.parametrize("b", [0.0, 0.5])
def test_a_fine_table_is_its_profile(geometry: str, b: float) -> None:
    plane = geometry == "plane"
    name = ("rounded_flat" if b else "cylinder") if plane else ("rounded_punch" if b else "paraboloid")
    r = np.linspace(0.0, 3.0, 601)
    # Of discs f = r²/2 is the paraboloid in δ0 and a_H; b is one of the radii.
    table = swtstudy.TabulatedProfile("table", r, 0.5 * np.maximum(r - b, 0.0) ** 2, geometry=geometry)
    own = [0.3], [0.5], [0.5], [0.3], ["3/2"], [1.0]
    shape = {"flat_half_width" if plane else "flat_radius": [b]}
    found = solve_batch(table, *own, control=(True, True), rtol=1e-6)[0]
    known = solve_batch(name, *own, shape=shape, control=(True, True), rtol=1e-6)[0]
    assert found["s"] == pytest.approx(known["s"], rel=1e-5)


@pytest.mark.slow
def test_a_rough_table_says_what_is_left_out() -> None:
    r = np.linspace(0.0, 2.0, 1501)
    noise = 1e-6 * np.random.default_rng(1).standard_normal(r.size)
    table = swtstudy.TabulatedProfile("rough", r, np.maximum(0.5 * r * r + noise * (r > 0.1), 0.0))
    record = profile_record(table, {}, False, 1.0, 1e-6)
    assert record.panels <= MAX_PANELS
    assert record.left_out > 1e-6


def test_waves_too_short_to_follow_are_left_out() -> None:
    own = [0.3], [0.5], [0.5], [0.3], [1], [1.0]
    amplitude, wavelength = 1e-7, 20.0
    shape = {"waviness_amplitude": [amplitude], "wavelength": [wavelength]}
    found, known = solve_batch("wavy_paraboloid", *own, shape=shape)[0], solve_batch("paraboloid", *own)[0]
    assert found["s"] == known["s"]
    slope = 2.0 * np.pi * np.sqrt(amplitude) / wavelength
    assert found["s_error"] - known["s_error"] == pytest.approx(4.0 * slope * known["s"], rel=1e-9)
