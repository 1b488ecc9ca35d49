"""Batches of points for the tests: Table 1 unless said otherwise, or drawn at random."""

from collections.abc import Callable
from dataclasses import replace
from math import gcd
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from solved import Control, Points

#: The shape parameters of each profile.
SHAPES: dict[str, tuple[str, ...]] = {
    "paraboloid": (),
    "rounded_punch": ("flat_radius",),
    "truncated_paraboloid": ("flat_radius",),
    "wavy_paraboloid": ("waviness_amplitude", "wavelength"),
    "power_law": ("exponent",),
    "cylinder": (),
    "rounded_flat": ("flat_half_width",),
    "wavy_cylinder": ("waviness_amplitude", "wavelength"),
    "power_law_cylinder": ("exponent",),
}
#: Profiles of strips, and profiles of discs, which all that is prescribed goes with.
PLANE_NAMES = ("cylinder", "rounded_flat", "wavy_cylinder", "power_law_cylinder")
PROFILE_NAMES = tuple(name for name in SHAPES if name not in PLANE_NAMES)
#: What is prescribed: both forces, or the tangential one beside the depth.
FORCES, TANGENTIAL_FORCE = Control(True, True), Control(False, True)


def each_profile(*quick: str) -> list[Any]:
    """The profiles as values of a parameter of costly tests, all but some marked as slow.

    Quick are those that are least alike, if nothing else is said.
    """
    import pytest  # scripts that draw points do without

    some = quick or ("truncated_paraboloid", "wavy_paraboloid")
    return [pytest.param(name, marks=() if name in some else pytest.mark.slow) for name in PROFILE_NAMES]


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


def shape_of(profile: str) -> tuple[str, ...]:
    """Names of the shape parameters of a profile."""
    return SHAPES[profile]


def take(batch: Points, index: ArrayLike) -> Points:
    """The points at ``index``."""
    return batch[np.atleast_1d(index)]


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
    "flat_half_width": lambda rng, count: rng.uniform(0.05, 2.0, count),
    "waviness_amplitude": lambda rng, count: 10.0 ** rng.uniform(-3.5, -1.0, count),
    "wavelength": lambda rng, count: rng.uniform(3.6, 10.0, count),
    "exponent": lambda rng, count: rng.uniform(1.1, 6.0, count),
}


def random_shape(
    rng: np.random.Generator, count: int, profile: str, normal_amplitude: NDArray[np.float64]
) -> dict[str, ArrayLike]:
    """Shape parameters of a compact contact."""
    shape = {name: DRAWN[name](rng, count) for name in shape_of(profile)}
    if profile == "wavy_cylinder":  # it is compact from 3.99 on
        shape["wavelength"] += 0.4
    return dict(shape)


#: What points have beside a load and a shape.
_FURTHER = (
    "walker_exponent",
    "normal_sensitivity",
    "bulk_stress_amplitude",
    "bulk_stress_mean",
    "bulk_stress_phase",
)


def plane_points(
    profile: str = "cylinder",
    poisson_ratio: ArrayLike = 0.3,
    friction: ArrayLike = 0.3,
    normal_force_amplitude: ArrayLike = 0.0,
    tangential_force_amplitude: ArrayLike = 0.5,
    phase: ArrayLike = 0.0,
    p: ArrayLike = 1,
    q: ArrayLike = 1,
    **others: ArrayLike,
) -> Points:
    """A batch of points of plane contacts, of forces; what is not a shape parameter is one of `_FURTHER`."""
    further = {name: others.pop(name) for name in _FURTHER if name in others}
    own = poisson_ratio, friction, normal_force_amplitude, tangential_force_amplitude, phase, p, q
    count = np.broadcast(*map(np.asarray, (*own, *others.values(), *further.values()))).size
    batch = points(profile, np.broadcast_to(poisson_ratio, count), *own[1:], **others)
    more = {name: np.broadcast_to(value, count).astype(float) for name, value in further.items()}
    return replace(batch, control=FORCES, **more)


def random_plane_points(seed: int, count: int, profile: str) -> Points:
    """Points in equilibrium all over the box, with bulk stresses and exponents."""
    rng = np.random.default_rng(seed)
    normal = rng.uniform(0.0, 0.9, count)
    p, q = np.array([(1, 1), (1, 2), (2, 1), (3, 2)])[rng.integers(4, size=count)].T
    return plane_points(
        profile,
        rng.uniform(0.0, 0.5, count),
        rng.uniform(0.1, 1.5, count),
        normal,
        rng.uniform(0.05, 1.0, count) * (1.0 - normal),
        rng.uniform(0.0, 2.0 * np.pi, count),
        p,
        q,
        walker_exponent=rng.choice([0.5, 0.35, 0.7], count),
        bulk_stress_amplitude=rng.choice([0.0, 0.1, 0.4], count),
        bulk_stress_mean=rng.choice([0.0, 0.2], count),
        bulk_stress_phase=rng.uniform(0.0, 6.0, count),
        **random_shape(rng, count, profile, normal),
    )
