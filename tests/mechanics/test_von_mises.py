"""The largest von Mises stress over cycle and body, against closed forms, published yield and dense looks."""

import itertools

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import swtstudy
from swtstudy.fields.one_point import read_scene
from swtstudy.mechanics.body.von_mises import largest_von_mises, von_mises
from swtstudy.mechanics.line.look import Look
from swtstudy.mechanics.stress.history import stresses

#: Peak pressure of a paraboloid and of a cylinder at the mean load, in E* δ0/a_H.
SPHERE, CYLINDER = 2.0 / np.pi, 0.5


def largest(**parameters):
    return float(swtstudy.solve(rtol=1e-2, quantities=["von_mises"], **parameters).von_mises)


def test_von_mises_stress_of_plain_states():
    tension, shear = [3.0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 2.0, 0]
    hydrostatic = [5.0, 5.0, 5.0, 0, 0, 0]
    np.testing.assert_allclose(
        von_mises(np.array([tension, shear, hydrostatic])), [3.0, 2.0 * np.sqrt(3.0), 0.0]
    )


def test_hertz_on_its_axis():
    """σ_zz − σ_rr on the axis is in closed form; ν = 0.3: p0 is 1.613 of the yield strength."""

    def negative(z, ν=0.3):
        axial = -1.0 / (1.0 + z * z)
        radial = -(1.0 + ν) * (1.0 - z * np.arctan(1.0 / z)) + 0.5 / (1.0 + z * z)
        return -abs(axial - radial)

    expected = -minimize_scalar(negative, bounds=(0.1, 1.0)).fun
    still = {"normal_amplitude": 0.0, "tangential_amplitude": 0.5, "poisson_ratio": 0.3}
    assert largest(friction=1e-9, **still) / SPHERE == pytest.approx(expected, rel=1.2e-2)
    assert 1.0 / expected == pytest.approx(1.613, abs=1e-3)


def test_a_pressed_cylinder_yields_beneath_its_middle():
    """In plane strain at ν = 0.3 McEwen's stresses on the axis give p0 = 1.79 yield strengths."""

    def negative(z, ν=0.3):
        root = np.sqrt(1.0 + z * z)
        along, down = -((1.0 + 2.0 * z * z) / root - 2.0 * z), -1.0 / root
        across = ν * (along + down)
        return -np.sqrt(0.5 * ((along - down) ** 2 + (down - across) ** 2 + (across - along) ** 2))

    expected = -minimize_scalar(negative, bounds=(0.1, 2.0)).fun
    found = largest(profile="cylinder", poisson_ratio=0.3, friction=1e-9, normal_force_amplitude=0.0,
                    tangential_force_amplitude=0.5)  # fmt: skip
    assert found / CYLINDER == pytest.approx(expected, rel=1.2e-2)


@pytest.mark.parametrize(("friction", "ratio"), [(0.5, 1.05), (0.8, 0.703)])
def test_a_sliding_sphere(friction, ratio):
    found = largest(poisson_ratio=0.3, friction=friction, normal_amplitude=0.0, tangential_amplitude=1.0)
    assert SPHERE / found == pytest.approx(ratio, rel=1e-2)


@pytest.mark.parametrize(("friction", "ratio"), [(0.5, 1.30), (0.8, 0.90)])
def test_a_sphere_in_partial_slip(friction, ratio):
    forces = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.6}
    assert SPHERE / largest(poisson_ratio=0.3, friction=friction, **forces) == pytest.approx(ratio, rel=1e-2)


def test_the_trailing_edge_of_a_sliding_cylinder():
    """There σ_xx = 2μp0 alone is left, σ_yy = ν σ_xx: at μ = 1 nothing is higher."""
    forces = {"normal_force_amplitude": 0.0, "tangential_force_amplitude": 1.0}
    found = largest(profile="cylinder", poisson_ratio=0.3, friction=1.0, **forces)
    edge = 2.0 * CYLINDER * np.sqrt(1.0 - 0.3 + 0.09)
    assert found >= 0.999 * edge
    line = dense_line(profile="cylinder", poisson_ratio=0.3, friction=1.0, **forces)
    assert found == pytest.approx(line, rel=1e-2)


def dense_line(**parameters):
    """The largest along the line y = 0 of the surface, by the stress of the line's own formulae."""
    scene = read_scene(parameters)
    a = scene.largest_radius[0]
    edge = np.geomspace(1e-6, 0.05, 40)
    x = np.unique(np.concatenate([np.linspace(0.01, 1.3, 400), 1.0 - edge, 1.0 + edge])) * a
    for _ in range(3):  # its cusps are sharp
        look = Look.at(scene, x[None], 6, 8.0)
        values = np.zeros(x.size)
        for side in (1.0, -1.0):
            xx, yy, zz, xz = stresses(look.history, scene.poisson_ratio, scene.friction, side)
            none = np.zeros_like(xx)
            stress = np.stack([xx, yy, zz, none, xz, none], axis=-1)
            values = np.maximum(values, von_mises(stress)[0].max(axis=-1))
        best = int(np.clip(values.argmax(), 1, x.size - 2))
        x = np.linspace(x[best - 1], x[best + 1], 100)
    return float(values.max())


#: At these the largest is on the surface line, where edges and fronts turn.
ON_THE_LINE = (
    {"profile": "rounded_flat", "flat_half_width": 1.3, "friction": 1.08, "poisson_ratio": 0.24,
     "normal_force_amplitude": 0.2, "tangential_force_amplitude": 0.08, "phase": 2.52},
    {"profile": "power_law", "exponent": 3.0, "friction": 0.9, "tangential_amplitude": 0.7},
    {"profile": "rounded_punch", "flat_radius": 1.4, "friction": 0.8, "phase": 1.0},
    {"friction": 1.0, "phase": 2.0, "frequency_ratio": "2", "tangential_amplitude": 0.6},
    # At its cusp, which moves with the edge: no step through places or instants alone leads there.
    {"friction": 0.7315, "poisson_ratio": 0.3207, "normal_force_amplitude": 0.2965,
     "tangential_force_amplitude": 0.2259, "phase": 5.039},
)  # fmt: skip


@pytest.mark.parametrize("parameters", ON_THE_LINE, ids=str)
def test_nothing_on_the_surface_line_is_higher(parameters):
    expected = dense_line(**parameters)
    found = largest(**parameters)
    assert 0.998 * expected <= found
    assert found <= 1.005 * expected


def test_off_the_line_and_far_away():
    """A bulk stress that presses adds to the hoop stress beside the contact, at y = a: Hertz's is known."""
    still = {"normal_amplitude": 0.0, "friction": 1e-6, "poisson_ratio": 0.3}
    radial, bulk = (1.0 - 0.6) / 3.0 * SPHERE, -0.6
    xx, yy = bulk - radial, radial
    expected = np.sqrt(xx * xx - xx * yy + yy * yy)
    assert largest(bulk_stress_mean=bulk, **still) == pytest.approx(expected, rel=1.2e-2)
    # A large tension everywhere: nothing beside the contact is much higher than it is at its edge.
    assert largest(bulk_stress_mean=8.0, **still) >= 8.0


def test_a_mirrored_load_has_the_same():
    one, other = (
        largest(
            friction=0.6,
            phase=0.7,
            load=swtstudy.LoadPath("way", vertices),
            normal_amplitude=0.5,
            tangential_amplitude=0.8,
        )
        for vertices in ([[0, -0.5], [1, -0.2], [0.5, 1]], [[0, 0.5], [1, 0.2], [0.5, -1]])
    )
    assert one == pytest.approx(other, rel=5e-3)


def test_a_long_noisy_loop_is_looked_at_where_it_matters():
    """The largest of a loop of 300 vertices is that of all its instants, not of those looked at first."""
    rng = np.random.default_rng(0)
    angle = 2.0 * np.pi * np.arange(300) / 300
    vertices = 0.5 * np.stack([np.cos(angle), np.sin(angle)], axis=1) + rng.normal(scale=0.01, size=(300, 2))
    scene = read_scene({"load": swtstudy.LoadPath("rig", vertices), "friction": 0.6})
    found = float(largest_von_mises(scene, np.ones(1))[0])
    expected = dense_line(load=swtstudy.LoadPath("rig", vertices), friction=0.6)
    assert found == pytest.approx(expected, rel=1e-2)


def test_infinite_at_a_sharp_edge_and_unknown_without_equilibrium():
    assert largest(profile="truncated_paraboloid", flat_radius=0.5) == np.inf
    assert np.isfinite(largest(profile="truncated_paraboloid", flat_radius=0.0))
    forces = {"normal_force_amplitude": 0.5, "phase": np.pi / 2}
    found = swtstudy.solve(
        rtol=1e-2, quantities=["von_mises"], tangential_force_amplitude=[0.5, 1.2], **forces
    )
    assert np.isfinite(found.von_mises.values).tolist() == [True, False]


@pytest.mark.parametrize("seed", range(2))
def test_random_points_are_not_below_a_dense_look_at_the_body(seed):
    """Over a mesh of the body that is three times as dense, and all instants of twice as many steps."""
    from swtstudy.mechanics.body.body import Body, time_nodes

    rng = np.random.default_rng(seed)
    parameters = {
        "poisson_ratio": rng.uniform(0.0, 0.5),
        "friction": rng.uniform(0.05, 1.0),
        "phase": rng.uniform(0.0, 6.0),
        "tangential_amplitude": rng.uniform(0.2, 1.2),
        "bulk_stress_mean": rng.uniform(-0.4, 0.4),
    }
    scene = read_scene(parameters)
    radius = np.linspace(0.0, 1.3, 25) * scene.largest_radius[0]
    angle, depth = np.linspace(0.0, np.pi, 9), np.append(0.0, np.geomspace(0.02, 1.2, 16))
    r, θ, z = (np.array(each) for each in zip(*itertools.product(radius, angle, depth), strict=True))
    body = Body(scene, time_nodes(scene, 6), 60)
    dense = von_mises(body.stress(r * np.cos(θ), r * np.sin(θ), z)).max()
    assert largest(**parameters) >= 0.998 * dense


@pytest.mark.parametrize(
    ("profile", "shape"), [("rounded_flat", "flat_half_width"), ("rounded_punch", "flat_radius")]
)
def test_beside_a_wide_face_the_ring_of_contact_is_looked_at(profile, shape):
    """Of 0.2 a_H beside a face of 100; a mesh over the contact had seen 30 % less."""
    parameters = {"profile": profile, shape: 100.0, "normal_amplitude": 0.0, "tangential_amplitude": 0.0}
    if profile == "rounded_flat":
        parameters = {name.replace("_amplitude", "_force_amplitude"): v for name, v in parameters.items()}
    scene = read_scene(parameters)
    from swtstudy.mechanics.body.body import Body, time_nodes

    ring = scene.largest_radius[0] - 100.0
    r, z = (
        each.ravel()
        for each in np.meshgrid(100.0 + ring * np.linspace(-1.5, 1.0, 26), ring * np.linspace(0.1, 2.0, 20))
    )
    dense = von_mises(Body(scene, time_nodes(scene, 1), 60).stress(r, 0.0 * r, z)).max()
    assert 0.998 * dense <= largest(**parameters) <= 1.01 * dense


@pytest.mark.parametrize("exponent", [1.02, 1.1, 1.3])
def test_at_a_sharp_tip_it_is_that_of_the_pressure_there(exponent):
    """(½ − ν) p with p = n/(π (n − 1)), of g′ = n ξⁿ⁻¹; a mesh had seen 1.5 of 8.1 at n = 1.02."""
    parameters = {"profile": "power_law", "exponent": exponent, "poisson_ratio": 0.0, "normal_amplitude": 0.0}
    expected = 0.5 * exponent / (np.pi * (exponent - 1.0))
    assert largest(**parameters, tangential_amplitude=0.0) == pytest.approx(expected, rel=1.2e-2)
