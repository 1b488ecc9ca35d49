"""Batches of points for the tests: Table 1 unless said otherwise, or drawn at random."""

from __future__ import annotations

from collections.abc import Callable
from math import gcd

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.families import FAMILIES, family_of
from swtstudy.mechanics import Points
from swtstudy.mechanics.indenter import check_shape

PROFILE_NAMES = tuple(FAMILIES)


def points(
    profile: str = "paraboloid",
    poisson_ratio: ArrayLike = 0.3,
    friction: ArrayLike = 0.3,
    normal_amplitude: ArrayLike = 0.75,
    tangential_amplitude: ArrayLike = 5 / 6,
    phase: ArrayLike = 0.0,
    p: ArrayLike = 1,
    q: ArrayLike = 1,
    **shape: ArrayLike,
) -> Points:
    """A batch of points; single values are repeated."""
    given = (poisson_ratio, friction, normal_amplitude, tangential_amplitude, phase, *shape.values(), p, q)
    *numbers, p, q = (np.array(v) for v in np.broadcast_arrays(*(np.atleast_1d(v) for v in given)))
    nu, mu, d, u, psi, *kappa = (v.astype(float) for v in numbers)
    return Points(profile, nu, mu, d, p, q, u, psi, dict(zip(shape, kappa, strict=True)))


def take(batch: Points, index: ArrayLike) -> Points:
    """The points at ``index``."""
    return batch.take(np.atleast_1d(index))


def random_points(seed: int, count: int, profile: str = "paraboloid", largest_term: int = 5) -> Points:
    """Points all over the parameter box in which s is asked to be accurate."""
    rng = np.random.default_rng(seed)
    pairs = [(p, q) for p in range(1, largest_term + 1) for q in range(1, largest_term + 1) if gcd(p, q) == 1]
    p, q = np.array([pairs[k] for k in rng.integers(len(pairs), size=count)]).T
    normal_amplitude = rng.uniform(0.0, 0.95, count)
    return points(
        profile,
        rng.uniform(0.0, 0.5, count),
        rng.uniform(0.05, 1.0, count),
        normal_amplitude,
        rng.uniform(0.05, 1.2, count),
        rng.uniform(0.0, 2.0 * np.pi, count),
        p,
        q,
        **random_shape(rng, count, profile, normal_amplitude),
    )


#: How the tests draw a shape parameter, among those of compact contacts.
DRAWN: dict[str, Callable[[np.random.Generator, int], NDArray[np.float64]]] = {
    "flat_radius": lambda rng, count: rng.uniform(0.05, 2.0, count),
    "waviness_amplitude": lambda rng, count: 10.0 ** rng.uniform(-3.5, -1.0, count),
    "wavelength": lambda rng, count: rng.uniform(3.6, 10.0, count),
    "exponent": lambda rng, count: rng.uniform(1.1, 6.0, count),
}


def random_shape(
    rng: np.random.Generator, count: int, profile: str, normal_amplitude: NDArray[np.float64]
) -> dict[str, ArrayLike]:
    """Shape parameters of a compact contact."""
    shape = {name: DRAWN[name](rng, count) for name in family_of(profile).shape}
    for k, d in enumerate(normal_amplitude):
        assert check_shape(profile, {name: values[k] for name, values in shape.items()}, 1.0 + d) is None
    return dict(shape)
