"""Searches of random points: all tolerances find one maximum, by no more positions than were needed."""

from fractions import Fraction

import numpy as np
import pytest

from swtstudy import LoadPath
from swtstudy.kernel.batch import memory, solve_batch
from swtstudy.kernel.field import mean_about, open_cycle
from swtstudy.kernel.mean import LINE, MEAN, POINT, SPHERE

pytestmark = pytest.mark.xdist_group("kernel")
POINTS = 6
TOLERANCES = 1e-2, 1e-3, 1e-5
#: A search may take so many times the positions that were recorded.
MORE = 1.02


def harmonic(rng, **more):
    """Points of two oscillations."""
    return {
        "poisson_ratio": rng.uniform(0.0, 0.5, POINTS),
        "friction": 10.0 ** rng.uniform(-1.5, 0.0, POINTS),
        "normal_amplitude": 10.0 ** rng.uniform(-2.0, -0.05, POINTS),
        "tangential_amplitude": 10.0 ** rng.uniform(-1.5, 0.2, POINTS),
        "frequency_ratio": [Fraction(*map(int, pair)) for pair in rng.integers(1, 5, (POINTS, 2))],
        "phase": rng.uniform(0.0, 2.0 * np.pi, POINTS),
    } | more


def polygons(rng, vertices):
    """Points of loops of vertices."""
    loops = [
        LoadPath("loop", np.column_stack([rng.uniform(0.3, 1.6, vertices), rng.uniform(-0.6, 0.6, vertices)]))
        for _ in range(POINTS)
    ]
    return harmonic(rng, loops=loops)


def bulk(rng, mean):
    """A bulk stress beside the load."""
    return {
        "bulk_amplitude": 10.0 ** rng.uniform(-3.0, -0.5, POINTS),
        "bulk_mean": mean * 10.0 ** rng.uniform(-2.0, 0.0, POINTS),
        "bulk_phase": rng.uniform(0.0, 2.0 * np.pi, POINTS),
    }


def shape(rng, name, low, high):
    return {"shape": {name: 10.0 ** rng.uniform(low, high, POINTS)}}


def scenes():
    """Name, profile, points, and the positions that each tolerance takes for all points."""
    rng = np.random.default_rng(11)
    small = {name: rng.uniform(0.02, 0.49, POINTS) for name in ("normal_amplitude", "tangential_amplitude")}
    forces = {"control": (True, True), **small}
    yield "spheres", "paraboloid", harmonic(rng), (654, 696, 809)
    yield "spheres under forces", "paraboloid", harmonic(rng, **forces), (547, 578, 659)
    constant = {**forces, "normal_amplitude": np.zeros(POINTS), "frequency_ratio": None}
    shifted = {"tangential_amplitude": rng.uniform(0.1, 0.95, POINTS), **bulk(rng, 0.0)}
    yield "shifted stick zones", "paraboloid", harmonic(rng, **constant | shifted), (110, 120, 135)
    yield "powers", "power_law", harmonic(rng, **shape(rng, "exponent", 0.05, 1.0)), (579, 610, 693)
    faces = shape(rng, "flat_radius", -2.0, 1.0)
    yield "rounded punches", "rounded_punch", harmonic(rng, **faces), (513, 555, 665)
    yield "edges", "truncated_paraboloid", harmonic(rng, **faces), (476, 512, 574)
    waves = {"waviness_amplitude": np.full(POINTS, 0.02), "wavelength": rng.uniform(5.0, 9.0, POINTS)}
    yield "waves", "wavy_paraboloid", harmonic(rng, shape=waves), (505, 551, 633)
    yield "cylinders", "cylinder", harmonic(rng, **small, **bulk(rng, 0.0)), (703, 740, 826)
    yield "short loops", "paraboloid", polygons(rng, 5), (173, 191, 215)
    yield "long loops", "paraboloid", polygons(rng, 60), (830, 878, 911)
    yield "tension", "paraboloid", harmonic(rng, **bulk(rng, 1.0)), (855, 888, 973)
    yield "compression", "paraboloid", harmonic(rng, **bulk(rng, -1.0)), (619, 648, 718)
    walker = {"walker_exponent": rng.uniform(0.1, 0.9, POINTS)}
    yield "Walker", "paraboloid", harmonic(rng, **walker), (565, 584, 657)
    for criterion, most in (("fatemi_socie", (579, 603, 658)), ("findley", (486, 509, 567))):
        own = {"criterion": criterion, "normal_sensitivity": rng.uniform(0.0, 1.0, POINTS)}
        yield criterion, "paraboloid", harmonic(rng, **own), most


SCENES = {name: rest for name, *rest in scenes()}


@pytest.mark.quick(13)
@pytest.mark.parametrize("name", SCENES)
def test_all_tolerances_find_one_maximum(name):
    profile, points, most = SCENES[name]
    found = [solve_batch(profile, **points, rtol=rtol) for rtol in TOLERANCES]
    best = found[-1]
    for one, rtol, positions in zip(found, TOLERANCES, most, strict=True):
        assert np.all(np.abs(one["s"] - best["s"]) <= one["s_error"] + best["s_error"])
        assert np.all(one["s_error"] <= rtol * one["s"] + 1e-8)
        np.testing.assert_allclose(one["s_surface"], best["s_surface"], rtol=rtol)
        assert one["positions"].sum() <= MORE * positions


#: Values of the criterion for means of some scenes at both tolerances.
MEANS = {
    "spheres": (240, 690),
    "shifted stick zones": (240, 540),
    "edges": (510, 1830),
    "cylinders": (860, 2580),
    "findley": (240, 390),
}


def only(points, k):
    """Point k alone."""
    one = {name: value[k : k + 1] for name, value in points.items() if isinstance(value, list | np.ndarray)}
    one |= {name: value for name, value in points.items() if isinstance(value, str | tuple)}
    return one | {"shape": {name: values[k : k + 1] for name, values in points.get("shape", {}).items()}}


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", MEANS)
def test_all_tolerances_find_one_mean(name):
    profile, points, _ = SCENES[name]
    taken = [0, 0]
    for k in range(2):
        one = only(points, k)
        opened, x = open_cycle(profile=profile, **one), solve_batch(profile, **one)["critical_x"][0]
        for kind, direction in ((SPHERE, (0.0, 1.0)), (POINT, (0.6, 0.8)), (LINE, (0.0, 1.0))):
            found = []
            for i, rtol in enumerate((3e-2, 3e-3)):
                value, error = mean_about(opened, kind, x, direction, 0.1, 0.0, rtol)
                assert 0.0 <= error <= (4e-4 if kind == LINE else 2.5 * rtol * value)
                found.append((value, error))
                taken[i] += int(memory(MEAN)[0]["evaluated"])
            assert abs(found[0][0] - found[1][0]) <= found[0][1] + found[1][1]
    assert taken[0] <= MEANS[name][0]
    assert taken[1] <= MEANS[name][1]
