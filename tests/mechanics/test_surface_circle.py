"""The surface off the line y = 0 from the line's building blocks."""

import numpy as np
import pytest
from scenes import points

import swtstudy
from swtstudy.fields.one_point import read_scene
from swtstudy.mechanics import solve_points
from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.contact.cycle import solve_cycle
from swtstudy.mechanics.control.coordinate import DepthCoordinate
from swtstudy.mechanics.events.stretches import Nodes
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.line import surface_circle
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.stress.contact_states import contact_states
from swtstudy.mechanics.stress.history import circle_stress
from swtstudy.mechanics.stress.line import SurfaceLine


def contact():
    one = (np.array([v]) for v in (0.5, 0.1, 0.6))
    return solve_cycle(BimodalLoad(*one, 1, 1)), make_profile("paraboloid", {}, np.array([1.5]))


@pytest.mark.parametrize("r", [0.4, 0.9, 1.2, 1.5])
def test_stress_is_that_of_the_field(r):
    cycle, profile = contact()
    interval = np.repeat(np.arange(cycle.begin.shape[1]), 3)
    share = np.tile([0.1, 0.5, 0.9], cycle.begin.shape[1])
    instant = cycle.begin[0, interval] + share * (cycle.end - cycle.begin)[0, interval]
    angle = np.linspace(0.0, np.pi, 7)
    line = SurfaceLine(cycle, DepthCoordinate(profile), np.array([[r]]), 8.0)
    history = line.history(Nodes(interval[None], instant[None], np.arange(instant.size)[None, None]))
    blocks = history.take(0)
    states = contact_states(cycle, DepthCoordinate(profile), interval, instant, cells=200)
    expected = states.stress(r * np.cos(angle), r * np.sin(angle), 0.0, 0.4, 0.3)
    found = circle_stress(blocks, np.array([0.3]), np.array([0.4]), angle[None])[0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6)


NARROW_SLIP = {"normal_amplitude": 0.5, "tangential_amplitude": 0.1, "phase": 0.6, "poisson_ratio": 0.5}
#: The maximum is at x < 0, on a plane that is inclined by 22°.
INCLINED = {
    "profile": "rounded_punch",
    "flat_radius": 2.0,
    "normal_amplitude": 0.475,
    "tangential_amplitude": 0.2,
    "phase": 2.618,
    "friction": 0.975,
    "poisson_ratio": 0.5,
}


@pytest.mark.parametrize("parameters", [NARROW_SLIP, INCLINED])
def test_gain_is_that_of_the_field(parameters):
    solved = swtstudy.solve(rtol=1e-5, **parameters)
    x = float(solved.critical_x)
    angle = np.linspace(0.2, 0.8, 25)
    scene = read_scene(parameters)
    body = Body(scene, time_nodes(scene, 40, [abs(x)]), cells=60)
    swt = body.swt(x * np.cos(angle), x * np.sin(angle), 0.0).swt
    assert float(solved.s_surface) > 1.005 * float(solved.s)
    assert float(solved.s_surface) == pytest.approx(swt.max(), rel=5e-4)


#: With what `dense_circle` of studies/checks/off_line.py finds there.
CIRCLES = [
    # A bulk stress: other instants than the line's.
    (
        {
            "normal_amplitude": 0.17947362,
            "tangential_amplitude": 0.0248599,
            "phase": 1.2546567,
            "poisson_ratio": 0.4987338,
            "friction": 0.4127386,
            "bulk_stress_amplitude": 0.004575401,
            "bulk_stress_mean": -0.01078477,
            "bulk_stress_phase": 5.0540309,
        },
        "3",
        0.005518343,
    ),
    # Instants that four steps of a stretch do not tell apart.
    (
        {
            "profile": "wavy_paraboloid",
            "waviness_amplitude": 0.094358728,
            "wavelength": 9.7104941,
            "normal_amplitude": 0.30861073,
            "tangential_amplitude": 0.05299352,
            "phase": 2.0605469,
            "poisson_ratio": 0.47024462,
            "friction": 0.83081176,
        },
        "3",
        0.05644375,
    ),
    # A ridge beside a higher one, whose planes are 10° from it.
    (
        {
            "normal_force_amplitude": 0.047248676,
            "tangential_force_amplitude": 0.17364532,
            "phase": 4.3070632,
            "poisson_ratio": 0.4989036,
            "friction": 0.84880752,
        },
        "2",
        0.14391736,
    ),
    # Two planes close to one another, each with instants of its own.
    (
        {
            "profile": "wavy_paraboloid",
            "waviness_amplitude": 0.055907132,
            "wavelength": 5.337221,
            "normal_amplitude": 0.018785796,
            "tangential_amplitude": 0.085610956,
            "phase": 0.24791074,
            "poisson_ratio": 0.47431964,
            "friction": 0.5486751,
        },
        "3",
        0.03796671,
    ),
    # The higher one of two maxima is the lower one at the first angles.
    (
        {
            "profile": "truncated_paraboloid",
            "flat_radius": 1.3394178,
            "normal_amplitude": 0.052659046,
            "tangential_amplitude": 0.39145783,
            "phase": 4.3890133,
            "poisson_ratio": 0.45549385,
            "friction": 0.56359335,
        },
        "1",
        0.29500192,
    ),
    # Two instants at which the normal strain is least, the lower one between two nodes of a short stretch.
    (
        {
            "profile": "wavy_paraboloid",
            "waviness_amplitude": 0.064670071,
            "wavelength": 7.1832622,
            "normal_amplitude": 0.054366492,
            "tangential_amplitude": 0.006378438,
            "phase": 2.1908372,
            "poisson_ratio": 0.49466201,
            "friction": 0.67285351,
        },
        "3",
        0.00345027832,
    ),
    # The same: what is seen of either tells the wrong one.
    (
        {
            "profile": "rounded_punch",
            "flat_radius": 0.33066515,
            "normal_amplitude": 0.12218225,
            "tangential_amplitude": 0.0095301119,
            "phase": 5.2195242,
            "poisson_ratio": 0.4679046,
            "friction": 0.82916397,
        },
        "3",
        0.00463082464,
    ),
    # Ridges whose planes are 2° from one another.
    (
        {
            "profile": "rounded_punch",
            "flat_radius": 1.4102593,
            "normal_amplitude": 0.022873104,
            "tangential_amplitude": 0.34318169,
            "phase": 4.5312632,
            "poisson_ratio": 0.47954282,
            "friction": 0.91714728,
        },
        "4/3",
        0.23364991705,
    ),
]


@pytest.mark.quick(5)
@pytest.mark.parametrize(("point", "ratio", "highest"), CIRCLES)
def test_no_maximum_of_the_circle_is_overlooked(point, ratio, highest):
    solved = swtstudy.solve(**point, frequency_ratio=ratio)
    assert float(solved.s_surface) == pytest.approx(highest, rel=1e-4)
    assert float(solved.s_surface) > 1.001 * float(solved.s)


def test_a_ridge_is_followed_farther_than_the_first_steps_go():
    """Where it is first seen it is lower; the value is that of `dense_circle`."""
    point = points(
        poisson_ratio=0.48356659824250975,
        friction=0.933354169353668,
        normal_amplitude=0.012078575610872095,
        tangential_amplitude=0.1320909533233835,
        phase=3.422809004373904,
    )
    assert solve_points(point).s_surface[0] == pytest.approx(0.189634188, rel=1e-4)


@pytest.mark.parametrize(
    ("friction", "mean"), [(0.15, -0.075), pytest.param(0.05, -0.1, marks=pytest.mark.slow)]
)
def test_where_a_bulk_stress_presses_the_smallest_contact_has_tension_at_its_side(friction, mean):
    """On the line s is a fourth of it, or 0."""
    point = {
        "normal_amplitude": 0.15,
        "tangential_amplitude": 0.1,
        "phase": 0.785398,
        "poisson_ratio": 0.44,
        "friction": friction,
        "bulk_stress_mean": mean,
        "walker_exponent": 0.6,
        "frequency_ratio": "3/4",
    }
    solved, scene = swtstudy.solve(**point), read_scene(point)
    r, angle = np.sqrt(0.85), np.linspace(0.0, np.pi, 181)
    body = Body(scene, time_nodes(scene, 40, [r]), cells=60)
    swt = body.swt(r * np.cos(angle), r * np.sin(angle), 0.0).swt
    assert float(solved.s_surface) > 1.2 * float(solved.s)
    assert float(solved.s_surface) == pytest.approx(swt.max(), rel=1e-3)


def test_only_places_that_meet_on_one_circle_and_one_ridge_are_one():
    along_x, along_y, _ = np.eye(3)
    places = surface_circle._Places(
        circle=np.array([0, 0, 0, 0, 1]),
        angle=np.array([0.2, 0.5, 0.5, 0.9, 0.9]),
        normal=np.stack([along_x, along_x, along_x, along_y, along_y]),
        width=np.full(5, surface_circle.ANGLES[1]),
    )
    kept = surface_circle._leading(places, np.array([1.0, 0.999, 1.0, 1.0, 1.0]), np.ones(2))
    assert kept.tolist() == [0, 2, 3, 4]


def test_circles_do_not_know_of_one_another():
    phases = [0.6, 0.601, 0.602]
    together = swtstudy.solve(**(NARROW_SLIP | {"phase": phases})).s_surface
    alone = [float(swtstudy.solve(**(NARROW_SLIP | {"phase": phase})).s_surface) for phase in phases]
    np.testing.assert_allclose(together, alone, rtol=1e-12)


def test_the_line_is_enough_for_more_compressible_bodies():
    solved = swtstudy.solve(**(NARROW_SLIP | {"poisson_ratio": [0.0, 0.3]}))
    np.testing.assert_array_equal(solved.s_surface, solved.s)


def test_a_safe_ratio_is_not_looked_at(monkeypatch):
    """The bound only saves time: without it the line has the maximum all the same."""
    monkeypatch.setattr(surface_circle, "SAFE_POISSON_RATIO", -1.0)
    solved = swtstudy.solve(**(NARROW_SLIP | {"poisson_ratio": [0.0, 0.3]}), friction=[0.1, 0.8])
    np.testing.assert_array_equal(solved.s_surface, solved.s)


@pytest.mark.slow
def test_a_loop_and_its_mirror_image_have_the_same_where_the_line_has_none():
    """A bulk stress presses, so that s is 0 and no side of the circle is the critical point's."""
    vertices = [(0.064, 0.602, 0.293), (0.651, 0.631, -0.852), (0.334, -0.394, 0.320), (0.227, 0.516, -0.109)]
    own = {
        "profile": "power_law",
        "exponent": 1.05,
        "poisson_ratio": 0.5,
        "friction": 0.24,
        "walker_exponent": 0.85,
        "normal_amplitude": 1.2,
    }
    bulk = {"tangential_amplitude": 0.375, "bulk_stress_amplitude": 0.214, "bulk_stress_mean": -0.194}
    found = [
        swtstudy.solve(
            load=swtstudy.LoadPath("loop", [(n, sign * t, b) for n, t, b in vertices]), **own, **bulk
        )
        for sign in (1.0, -1.0)
    ]
    assert [float(each.s) for each in found] == [0.0, 0.0]
    assert float(found[0].s_surface) > 1e-4
    assert float(found[0].s_surface) == pytest.approx(float(found[1].s_surface), rel=1e-9)
