"""Means of swt over critical distances: their quadrature, their histories of stress, and their values."""

import numpy as np
import pytest
from scenes import PROFILE_NAMES, random_points, take

from swtstudy.mechanics.body.body import Body, time_nodes
from swtstudy.mechanics.body.half_sphere import HalfSpheres
from swtstudy.mechanics.body.histories import Histories
from swtstudy.mechanics.stress.field.contact_states import resolving_cells
from swtstudy.mechanics.stress.scene import scene_of


@pytest.mark.parametrize("profile", PROFILE_NAMES)
def test_histories_at_instants_of_each_place(profile):
    """The stress of each place at its own instants is that of the field at common ones."""
    batch = random_points(3, 3, profile)
    rng = np.random.default_rng(4)
    for k in range(len(batch)):
        scene = scene_of(take(batch, k))
        r, θ, z = rng.uniform(0.0, 2.0, 8), rng.uniform(0.0, np.pi, 8), rng.uniform(0.02, 1.0, 8)
        nodes = time_nodes(scene, 3)
        expected = Body(scene, nodes, 60).stress(r * np.cos(θ), r * np.sin(θ), z)
        histories = Histories(scene, r, z, θ, *resolving_cells(scene.cycle, scene.coordinate, 60))
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
    spheres, sizes = HalfSpheres(centre, 0.4, 13), np.array([0.4, 0.25, 0.05])
    radius, depth, angle = spheres.places()
    offsets = radius * np.cos(angle) - centre, radius * np.sin(angle), depth
    values = np.prod([v**p for v, p in zip(offsets, powers, strict=True)], axis=0)
    mean, *change = spheres.weights(sizes) @ values
    expected = MOMENTS[powers] * sizes ** sum(powers)
    np.testing.assert_allclose(mean, expected, atol=8e-3 * 0.4 ** sum(powers))
    np.testing.assert_allclose(change, 0.0, atol=8e-3 * 0.4 ** sum(powers))
