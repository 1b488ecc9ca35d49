"""Prescribed forces: the memory diagram in the other coordinate, against springs marched one by one."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise

import numpy as np
import pytest
from memory import slopes
from numpy.typing import NDArray
from oracles import profiles as oracle
from oracles.force_march import ForceMarch, second_round
from scipy.special import struve

from swtstudy.mechanics.control.prescribed import Prescribed
from swtstudy.mechanics.line.climb import Accuracy
from swtstudy.mechanics.line.maximum import Maximum, maximum
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.stress.scene import Scene, prescribed_scene

Array = NDArray[np.float64]
INDENTERS = {
    "paraboloid": oracle.paraboloid(),
    "rounded_punch": oracle.rounded_punch(0.6),
    "truncated_paraboloid": oracle.truncated_paraboloid(0.5),
    "wavy_paraboloid": oracle.wavy_paraboloid(0.03, 4.5),
}
EVERY = [(normal, tangential) for normal in (False, True) for tangential in (False, True)]


def scene_of(load: Load, prescribed: Prescribed, name: str = "paraboloid", mu: float = 0.5) -> Scene:
    many = np.ones(len(load))
    shape = {key: value * many for key, value in INDENTERS[name].shape.items()}
    return prescribed_scene(load, prescribed, 0.3 * many, mu * many, name, shape)


def largest(scene: Scene, rtol: float = 1e-6) -> Maximum:
    return maximum(scene, Accuracy.for_tolerance(rtol))


def harmonic(f: float, q: float, psi: float, p: int = 1, periods: int = 1) -> BimodalLoad:
    return BimodalLoad(np.array([f]), np.array([q]), np.array([psi]), p, periods)


def depth_of(name: str, xi: Array) -> Array:
    """g(ξ)/δ0 of the profiles of `INDENTERS` (eq. 11)."""
    b = INDENTERS[name].flat_radius
    w = np.sqrt(np.maximum(xi**2 - b**2, 0.0))
    if name == "rounded_punch":
        return np.asarray(xi * (w - b * np.arctan2(w, b)))
    if name == "truncated_paraboloid":
        return xi * w
    if name == "paraboloid":
        return xi**2
    return np.interp(xi, *wavy_depth())


@lru_cache
def wavy_depth() -> tuple[Array, Array]:
    """g of the wavy one in a fine table: the Struve function is slow."""
    xi = np.linspace(0.0, 2.5, 20001)
    h, wavelength = INDENTERS["wavy_paraboloid"].shape.values()
    z = 2.0 * np.pi / (wavelength * np.sqrt(h)) * xi
    return xi, np.asarray(xi**2 + 0.5 * np.pi * h * z * struve(0, z))


def package_forces(scene: Scene, name: str, radius: Array, instant: float) -> Array:
    """τ of springs at radii: −∫ τ′ dG from the edge inwards, over the pieces of the package's diagram."""
    node, weight = np.polynomial.legendre.leggauss(10)
    share = 0.5 - 0.5 * np.cos(np.pi * np.linspace(0.0, 1.0, 7))
    tau = np.zeros_like(radius)
    for begin, end, slope in slopes(scene.cycle, instant):
        first, last = scene.coordinate.radius(np.array([[begin, end]]))[0]
        for ends in pairwise(first + (last - first) * share):
            inside = np.clip(radius, *ends)
            half = 0.5 * (ends[1] - inside)
            xi = inside[:, None] + half[:, None] * (1.0 + node)
            at = scene.coordinate.of(xi.reshape(1, -1))[0]
            values = np.broadcast_to(slope(at), at.shape).reshape(xi.shape)
            rate = (depth_of(name, xi + 1e-6) - depth_of(name, xi - 1e-6)) / 2e-6
            tau -= (half[:, None] * weight * values * rate).sum(axis=1)
    return tau


def random_harmonic(rng: np.random.Generator, prescribed: Prescribed) -> BimodalLoad:
    """A load that leaves the contact in equilibrium, with slip."""
    p, q = [(1, 1), (1, 2), (2, 1), (3, 2)][rng.integers(4)]
    f, psi = rng.uniform(0.2, 0.7), rng.uniform(0.0, 2.0 * np.pi)
    t = np.linspace(0.0, 2.0 * np.pi, 2001)
    normal = 1.0 + f * np.sin(q * t + psi)
    if prescribed.tangential_force and not prescribed.normal_force:
        normal = np.maximum(normal, 0.0) ** 1.5 * 0.7  # no profile's force is smaller
    limit = np.min(normal / np.maximum(np.abs(np.sin(p * t)), 1e-9))
    return harmonic(f, rng.uniform(0.5, 0.9) * limit, psi, p, q)


@pytest.mark.parametrize(("normal_force", "tangential_force"), EVERY)
@pytest.mark.parametrize("name", INDENTERS)
def test_every_spring_carries_what_a_march_with_solved_displacements_gives_it(
    name: str, normal_force: bool, tangential_force: bool
) -> None:
    prescribed = Prescribed(normal_force, tangential_force)
    rng = np.random.default_rng([normal_force, tangential_force, *map(ord, name)])
    load = random_harmonic(rng, prescribed)
    scene = scene_of(load, prescribed, name)
    edges = np.linspace(0.0, 1.02 * scene.profile.radius(scene.profile.largest_depth)[0], 241)
    radius = 0.5 * (edges[1:] + edges[:-1])
    steps = 320
    t = 2.0 * np.pi * np.arange(steps) / steps
    springs = ForceMarch(depth_of(name, radius), np.diff(edges))
    expected = second_round(
        springs, load.normal(t[None])[0], load.tangential(t[None])[0], normal_force, tangential_force
    )
    some = rng.choice(steps, 3, replace=False)
    found = np.stack([package_forces(scene, name, radius, t[k]) for k in some])
    assert np.abs(expected[some]).max() > 0.05
    # The march's steps and springs.
    np.testing.assert_allclose(found, expected[some], rtol=0.0, atol=5e-4)
