"""Means of swt over critical distances: their quadrature, their histories of stress, and their values."""

from dataclasses import replace

import numpy as np
import pytest
from scenes import each_profile, points, random_points, take
from scipy.integrate import simpson
from solved import solve_points

from swtstudy import TabulatedProfile
from swtstudy.mechanics.body import local_swt, nonlocal_swt
from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.body.half_sphere import HalfSpheres, nested
from swtstudy.mechanics.body.histories import Histories, SpringCells
from swtstudy.mechanics.body.quick_planes import Peaks, rival_planes
from swtstudy.mechanics.planes.all_planes import CoarsePlanes
from swtstudy.mechanics.planes.criterion import SWT
from swtstudy.mechanics.stress.scene import scene_of


@pytest.mark.parametrize("profile", each_profile())
def test_histories_at_instants_of_each_place(profile):
    """The stress of each place at its own instants is that of the field at common ones."""
    batch = random_points(3, 3, profile)
    rng = np.random.default_rng(4)
    for k in range(len(batch)):
        scene = scene_of(take(batch, k))
        r, θ, z = rng.uniform(0.0, 2.0, 8), rng.uniform(0.0, np.pi, 8), rng.uniform(0.02, 1.0, 8)
        nodes = time_nodes(scene, 3)
        expected = Body(scene, nodes, 60).stress(r * np.cos(θ), r * np.sin(θ), z)
        springs = SpringCells.of(scene, 60)
        histories = Histories(scene, r, z, θ, springs)
        order = rng.permuted(np.tile(np.arange(nodes.instant.size), (8, 1)), axis=1)
        found = histories.stress(nodes.instant[order])
        expected = np.take_along_axis(expected, order[..., None], axis=1)
        np.testing.assert_allclose(found, expected, atol=1e-5 * np.abs(expected).max())


#: Means of monomials in the offsets over a half sphere of radius 1.
MOMENTS = {
    (0, 0, 0): 1.0,
    (1, 0, 0): 0.0,
    (0, 0, 1): 3 / 8,
    (2, 0, 0): 1 / 5,
    (0, 2, 0): 1 / 5,
    (0, 0, 2): 1 / 5,
}


@pytest.mark.parametrize("centre", [1.2, 0.5, 0.0])
@pytest.mark.parametrize("powers", MOMENTS)
def test_means_over_half_spheres_of_several_sizes(centre, powers):
    spheres, sizes = HalfSpheres(centre, 0.4, 2.0, 15, 15), np.array([0.4, 0.25, 0.05])

    def values(radius, depth, angle):
        offsets = radius * np.cos(angle) - centre, radius * np.sin(angle), depth
        return np.prod([v**p for v, p in zip(offsets, powers, strict=True)], axis=0)

    weights, grid = spheres.weights(sizes), values(*spheres.grid())
    mean = weights @ grid + spheres.side_weights(sizes) @ values(*spheres.side_places())
    expected = MOMENTS[powers] * sizes ** sum(powers)
    np.testing.assert_allclose(mean, expected, atol=8e-3 * 0.4 ** sum(powers))
    # Seen from every other place.
    change, _ = spheres.changes(weights, grid)
    assert (change < 0.1 * 0.4 ** sum(powers)).all()


@pytest.mark.parametrize("axis", [0, 1])
def test_finer_places_hold_the_coarse_ones(axis):
    """At every other place along the axis, from the second on, and only there."""
    spheres = HalfSpheres(1.2, 0.4, 1.5, 7, 15)
    every_other = np.s_[1::2] if axis == 0 else np.s_[:, 1::2]
    fine = spheres.finer(axis)
    for coarse, finer in zip(spheres.grid(), fine.grid(), strict=True):
        np.testing.assert_allclose(finer.reshape(fine.shape)[every_other], coarse.reshape(spheres.shape))


SCENES = {
    "paraboloid": points(phase=2.0, normal_amplitude=0.5),
    "rounded_punch": points("rounded_punch", phase=1.0, flat_radius=0.5),
    "truncated_paraboloid": points("truncated_paraboloid", phase=2.0, flat_radius=0.4),
    "wavy_paraboloid": points("wavy_paraboloid", waviness_amplitude=0.05, wavelength=5.0, friction=0.6),
}
DISTANCE = 0.15


def nonlocal_of(batch, distance, rtol=1e-3):
    """s, critical x, and the means of a batch."""
    solution = solve_points(batch, 1e-6)
    found = nonlocal_swt.nonlocal_swt(
        scene_of(batch), solution.critical_x, solution.critical_angle, np.atleast_1d(distance), rtol
    )
    return solution, found


def field(scene, x, y, z, steps=10):
    """swt over all planes at places of one distance from the axis, by the field of common instants."""
    r = np.hypot(x, y).flat[0]
    near = np.maximum(r + np.array([-0.1, -0.03, 0.0, 0.03]), 1e-3)
    return Body(scene, time_nodes(scene, steps, near), 60).swt(x, y, z).swt


def gauss(count):
    return (values / 2 for values in np.polynomial.legendre.leggauss(count))


def mean_of_field(scene, x, distance):
    """Mean over the half sphere in cylindrical coordinates about the axis: other places than ours."""
    total = volume = 0.0
    (u, of_u), (w, of_w), (v, of_v) = gauss(7), gauss(4), gauss(9)
    u, v, turn = u + 0.5, v + 0.5, np.pi / 2 * (w[:, None] + 0.5)
    # Depths end like a root where the circle leaves the sphere; y → −y is a symmetry.
    angle, of_angle = np.sin(turn), np.cos(turn) * of_w[:, None]
    for side in (-1, 1):
        # swt begins like a root at the circle through the centre, and in the depth.
        for share, weight in zip(u, of_u * 2 * u, strict=True):
            r = abs(x) + side * distance * share**2
            most = np.arccos(1 - (distance**2 - (r - abs(x)) ** 2) / (2 * abs(x) * r))
            across = r**2 + x**2 - 2 * r * abs(x) * np.cos(most * angle)
            deepest = np.sqrt(distance**2 - across)
            z = deepest * v**2
            weights = weight * most * r * of_angle * deepest * 2 * v * of_v
            place = r * np.cos(most * angle + 0 * v), r * np.sin(most * angle + 0 * v)
            total += (weights * field(scene, np.copysign(1.0, x) * place[0], place[1], z)).sum()
            volume += weights.sum()
    return total / volume


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SCENES)
def test_volume_means_are_those_of_the_field(name):
    scene = scene_of(SCENES[name])
    solution, found = nonlocal_of(SCENES[name], DISTANCE)
    expected = mean_of_field(scene, float(solution.critical_x[0]), DISTANCE)
    assert found.volume[0, 0] == pytest.approx(expected, rel=2e-3)
    assert found.volume_error[0, 0] < 2e-3 * found.volume[0, 0]


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SCENES)
def test_points_and_lines_are_those_of_the_field(name):
    """In both directions, by Simpson's rule in the root of the distance."""
    scene = scene_of(SCENES[name])
    solution, found = nonlocal_of(SCENES[name], DISTANCE)
    x, angle = float(solution.critical_x[0]), np.radians(solution.critical_angle[0])
    share = np.linspace(0.0, 1.0, 17)
    away = 2.0 * DISTANCE * share**2
    for number, (right, down) in enumerate([(0.0, 1.0), (-np.sin(angle), np.cos(angle))]):

        def along(distance, steps=10, right=right, down=down):
            at = np.array([x + distance * right]), 0.0, np.array([distance * down])
            return float(field(scene, *at, steps)[0])

        assert found.point[0, 0, number] == pytest.approx(along(0.5 * DISTANCE, steps=30), rel=1.5e-3)
        expected = simpson(2.0 * share * np.array([along(distance) for distance in away]), x=share)
        assert found.line[0, 0, number] == pytest.approx(expected, rel=4e-3)


@pytest.mark.parametrize("name", SCENES)
def test_all_means_tend_to_s(name):
    """Like the root of the distance: the surface's stress falls so at the contact edge."""
    solution, found = nonlocal_of(SCENES[name], np.array([1e-10, 1e-8, 1e-6]))
    for mean in (found.volume, found.point[..., 0], found.line[..., 0]):
        fall = 1.0 - mean[0] / solution.s
        assert abs(fall[0]) < 3e-4
        assert fall[2] < 1.5e-2


def test_several_distances_share_their_places():
    """Each mean is what it is alone, and critical points of either side have the same."""
    batch, distance = SCENES["paraboloid"], np.array([0.1, 0.002, 0.05])
    _, found = nonlocal_of(batch, distance)
    alone = [nonlocal_of(batch, each)[1] for each in distance]
    for name, values in vars(found).items():
        if not name.endswith("error"):
            one = np.concatenate([getattr(each, name) for each in alone], axis=1)
            np.testing.assert_allclose(values, one, rtol=2e-3)


def worn():
    """A paraboloid with a flat face of 0.4 a_H and a blend."""
    r = np.unique(np.concatenate([np.linspace(0.0, 2.0, 81), 0.4 + 0.1 * np.linspace(0.0, 1.5, 31)]))
    slope = np.interp(r, [0.0, 0.4, 0.5, 2.0], [0.0, 0.0, 0.5, 2.0])
    height = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]) * np.diff(r))])
    return TabulatedProfile("worn", r, height)


def with_bulk(batch):
    bulk = {"bulk_stress_mean": np.array([0.05]), "bulk_stress_amplitude": np.array([0.05])}
    return replace(batch, **bulk)


#: ℓ, and means over the half sphere, at ℓ/2 and over 0 … 2ℓ straight down, of the field with many instants
#: common to a circle and all planes searched at each place, by Gauss's rule in cylindrical coordinates
#: about the axis (10 × 4 × 14 places on either side; of the power law 14 × 4 × 18 with 24 instants on each
#: stretch: with 10 it is 1.3e-3 low) and by Simpson's rule (25 places).
KNOWN = [
    (points(phase=2.5, normal_amplitude=0.25), 0.1, 0.0454978, 0.0297589, 0.0215015),
    (points("rounded_punch", phase=0.7, p=1, q=2, flat_radius=0.5), 0.05, 0.0875051, 0.0716282, 0.0575010),
    (
        points("truncated_paraboloid", phase=1.0, tangential_amplitude=1.2, flat_radius=0.3),
        0.08,
        0.0649775,
        0.0479510,
        0.0367803,
    ),
    (
        with_bulk(
            points(
                "wavy_paraboloid", phase=4.0, normal_amplitude=0.4, waviness_amplitude=0.02, wavelength=5.0
            )
        ),
        0.1,
        0.0773251,
        0.0560010,
        0.0447141,
    ),
    (
        points("power_law", phase=1.0, normal_amplitude=0.5, tangential_amplitude=0.3, exponent=3.0),
        0.1,
        0.0155144,
        0.00457419,
        0.00605643,
    ),
    (
        replace(points(phase=5.0, normal_amplitude=0.5, tangential_amplitude=0.6), profile=worn()),
        0.06,
        0.0553035,
        0.0399547,
        0.0292321,
    ),
]


@pytest.mark.parametrize("known", KNOWN, ids=lambda known: str(known[0].profile))
def test_known_means(known):
    """In gross slip and partial slip, with bulk stress, of a table: as claimed."""
    batch, distance, *expected = known
    _, found = nonlocal_of(batch, distance)
    values = found.volume[0, 0], found.point[0, 0, 0], found.line[0, 0, 0]
    off = np.abs(np.subtract(values, expected)) / expected
    assert (off < [1.5e-3, 3e-4, 1e-3]).all()
    errors = found.volume_error[0, 0], found.point_error[0, 0, 0], found.line_error[0, 0, 0]
    # The other rule is off by up to 8e-4 itself.
    assert (off < np.array(errors) / expected + 8e-4).all()
    assert (np.array(errors) / expected < 2.1e-3).all()


#: ℓ, and swt at ℓ/2 in both directions, of the field with 60 instants on each stretch and six looks closer.
RIVALS = [
    (
        points(
            "power_law",
            poisson_ratio=0.094,
            friction=0.131,
            normal_amplitude=0.814,
            p=1,
            q=2,
            tangential_amplitude=0.143,
            phase=3.327,
            exponent=3.447,
        ),
        0.07,
        (0.01240658, 0.01240052),
    ),
    (
        replace(
            points(
                poisson_ratio=0.379,
                friction=0.161,
                normal_amplitude=0.393,
                p=2,
                q=1,
                tangential_amplitude=1.13,
                phase=0.949,
            ),
            profile=worn(),
        ),
        0.129,
        (0.00524621, 0.00509572),
    ),
]


@pytest.mark.parametrize("known", RIVALS, ids=lambda known: str(known[0].profile))
def test_planes_that_are_not_the_highest_at_first_have_instants_of_their_own(known):
    """Their peaks are narrower than the gaps between the instants; swt was 1 % low without."""
    batch, distance, expected = known
    np.testing.assert_allclose(nonlocal_of(batch, distance)[1].point[0, 0], expected, rtol=3e-4)


def test_rivals_show_which_gaps_between_instants_matter_nearby():
    """Where planes take turns straight down; of the field with 20 instants on each stretch, four looks."""
    batch = points(
        poisson_ratio=0.45,
        friction=0.369,
        normal_amplitude=0.321,
        p=1,
        q=3,
        tangential_amplitude=0.085,
        phase=3.153,
    )
    batch, distance = replace(batch, profile=worn()), 0.059
    x = float(solve_points(batch, 1e-6).critical_x[0])
    own = nonlocal_swt.Around(scene_of(batch), x, np.array([[0.0, 1.0]]), np.array([distance]))
    places = own._of_lines(distance * np.array([0.1, 0.2, 0.3]))
    found, _, _ = own.local.swt(places, np.zeros(3, dtype=bool))
    np.testing.assert_allclose(found, [0.00516506, 0.00124483, 0.00013743], rtol=2e-4)


def test_instants_that_meet_hide_no_peak():
    """A peak at two instants that are one has the gaps on either side divided."""
    instant = np.array([[0.0, 1.0, 2.0, 2.0, 3.0, 4.0]])
    found = Peaks.of(instant, -((instant - 2.2) ** 2), 1).beside
    np.testing.assert_allclose(np.sort(found), [[1.5, 2.2, 2.5]], atol=1e-9)


def test_what_peaks_may_hide():
    """Nothing where the curve is a parabola; where it is none, what its middles are off, if that tops it."""
    instant = np.array([[0.0, 1.0, 2.0, 2.5, 4.0, 5.0, 6.0]])
    parabola = -((instant - 2.2) ** 2)
    peaks = Peaks.of(instant, parabola, 1)
    beside = -((peaks.beside - 2.2) ** 2)
    np.testing.assert_allclose(peaks.hidden(beside), 0.0, atol=1e-12)
    beside[0, 2] += 0.125
    np.testing.assert_allclose(peaks.hidden(beside), 0.125)
    # A peak that is lower by 1 at 5 hides only what is more than that.
    two = parabola.copy()
    two[0, 5] = parabola.max() - 1.0
    both = Peaks.of(instant, two, 2)
    three = zip(both.instant[0], both.value[0], strict=True)
    exact = [np.polyval(np.polyfit(x, y, 2), both.beside[0, k::2]) for k, (x, y) in enumerate(three)]
    beside = np.stack(exact, axis=1).reshape(1, -1)
    lower = int(both.value[0, :, 1].argmin())
    beside[0, lower] += 1.25
    np.testing.assert_allclose(both.hidden(beside), 0.25)


def test_kinks_on_lines_are_seen():
    """They make the mean no more wrong than is said, and more places where that is too much."""
    own = nonlocal_swt.Around(scene_of(SCENES["paraboloid"]), 0.9, np.array([[0.0, 1.0]]), np.array([0.1]))
    share = nested(len(own.lines)) ** own.layout.line_power
    own.points[..., 0], own.points[..., 1] = 1.0, 0.0
    own.lines[:, 0, 0], own.lines[:, 0, 1] = 1.0 + np.abs(share - 0.3), 0.0
    found = own.on_lines()
    off = abs(found.value[1, 0, 0] - (1.0 + 0.5 * (0.3**2 + 0.7**2)))
    assert 5e-5 < off < found.of_places[1, 0, 0] < 100.0 * off
    assert not own._refine_lines(found, 0.05)
    assert own._refine_lines(found, 3e-4)
    assert np.isnan(own.lines[::2]).all()
    np.testing.assert_array_equal(own.lines[1::2, 0, 0], 1.0 + np.abs(share - 0.3))


def test_what_arcs_add_asks_for_no_places_elsewhere():
    """More distances and inclinations leave it; where these are what is too much, there are more."""
    distance = np.array([0.1, 0.05])
    own = nonlocal_swt.Around(scene_of(SCENES["paraboloid"]), 0.9, np.array([[0.0, 1.0]]), distance)
    share = nested(own.layout.distances)[:, None, None]
    own.grid[..., 0], own.grid[..., 1], own.side[:] = 1.0 + 1e-3 * np.abs(share - 0.3), 0.0, 0.0
    own.side[::2, 0] = 1.0
    found, of_axes = own.in_spheres()
    assert found.of_places[1] > found.allowed(1e-3)[1] > 10.0 * of_axes[:, 1].sum() > 0.0
    assert not own._refine_spheres(found, of_axes, 1e-3)
    assert own._refine_spheres(found, 1e3 * of_axes, 1e-3)


def test_means_over_lines_are_those_of_the_interpolation():
    """Also of one that changes its sign at every place."""
    distance = np.array([0.1, 0.06])
    own = nonlocal_swt.Around(scene_of(SCENES["paraboloid"]), 0.9, np.array([[0.0, 1.0]]), distance)
    count, power = 79, own.layout.line_power
    wave = np.polynomial.Chebyshev([0.0] * (count - 1) + [1.0], domain=[0.0, 1.0])
    node, weight = np.polynomial.legendre.leggauss(400)
    share = 0.5 + 0.5 * node
    for size, found in zip(distance, own._line_weights(count) @ wave(nested(count)), strict=True):
        values = wave((size / 0.1) ** (1.0 / power) * share)
        assert found == pytest.approx(0.5 * weight @ (power * share ** (power - 1) * values), abs=1e-9)


def test_tension_between_the_coarse_planes_is_found() -> None:
    """σ_xx = σ_yy = −1 press while σ_zz = 0.001 pulls: planes are in tension within 2° of the z axis."""
    pull, ν = 1e-3, 0.3
    stress = np.array([[[0.0] * 6, [-1.0, -1.0, pull, 0.0, 0.0, 0.0]]])
    towards = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
    every = CoarsePlanes.everywhere()
    planes = CoarsePlanes(every.normal @ towards, every.beside)
    assert planes.swt(stress, ν, SWT).max() == 0.0
    history, swt, normal = rival_planes(stress, planes, ν, SWT)
    assert history.tolist() == [0]
    # σ_max Δε/2 over E* = E/(1 − ν²) = 1, with ε = (σ_zz + 2ν)/E.
    assert swt[0] == pytest.approx(pull * 0.5 * (pull + 2.0 * ν) / (1.0 - ν**2), rel=1e-6)
    assert abs(normal[0, 2]) == pytest.approx(1.0, abs=1e-6)


def test_a_place_without_instants_of_its_own_keeps_one() -> None:
    instants, kept = np.array([[1.0, 2.0], [3.0, 4.0]]), np.array([[False, True], [False, False]])
    np.testing.assert_array_equal(local_swt._packed(instants, kept), [[2.0], [3.0]])


@pytest.mark.slow
def test_a_mean_of_a_thousandth_of_swt_is_known_to_a_hundredth():
    """By as many more places as that takes; 65,536 places all over the half sphere say 4.06e-6 ± 0.02e-6."""
    load = {"p": 2, "normal_amplitude": 0.31101609, "tangential_amplitude": 0.00193947, "phase": 1.01996498}
    point = points(poisson_ratio=0.47682492, friction=0.97499048, **load)
    solution = solve_points(point, 1e-5)
    at = solution.critical_x, solution.critical_angle
    found = nonlocal_swt.nonlocal_swt(scene_of(point), *at, np.array([0.15678342]))
    assert found.volume[0, 0] == pytest.approx(4.031e-6, rel=3e-3)
    assert found.volume_error[0, 0] < 0.01 * found.volume[0, 0]
