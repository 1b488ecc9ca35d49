"""The registry of profiles: a family is a file here, a line below and a row of `parameters.FAMILIES`."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.indenter.flat_faced import RoundedPunch, TruncatedParaboloid
from swtstudy.mechanics.indenter.paraboloid import Paraboloid
from swtstudy.mechanics.indenter.power_law import PowerLaw
from swtstudy.mechanics.indenter.wavy_paraboloid import WavyParaboloid
from swtstudy.mechanics.points import FloatArray, IntArray

PROFILES: dict[str, type[Profile]] = {
    "paraboloid": Paraboloid,
    "rounded_punch": RoundedPunch,
    "truncated_paraboloid": TruncatedParaboloid,
    "wavy_paraboloid": WavyParaboloid,
    "power_law": PowerLaw,
}


def make_profile(name: str, shape: dict[str, FloatArray], largest_depth: FloatArray) -> Profile:
    """n profiles of family ``name`` with shape parameters of shape (n,), in contact up to a depth (n,).

    What cannot be resolved is left out, see `resolved_shape`.
    """
    resolved, _ = resolved_shape(name, shape, largest_depth)
    return PROFILES[name](largest_depth, **resolved)


def roughness(name: str, shape: dict[str, FloatArray], largest_depth: FloatArray) -> IntArray:
    """Levels of `Profile.roughness` of n profiles."""
    return PROFILES[name].roughness(largest_depth, **shape)


def resolved_shape(
    name: str, shape: dict[str, FloatArray], largest_depth: FloatArray
) -> tuple[dict[str, FloatArray], FloatArray]:
    """Shape parameters that can be resolved, and the relative error of s by what was left out, (n,)."""
    return PROFILES[name].resolved(largest_depth, **shape)


def compact_shapes(
    profile: str, shape: dict[str, FloatArray], largest_depth: FloatArray
) -> NDArray[np.bool_]:
    """Whether `check_shape` has nothing against each of n shapes up to a depth, each of shape (n,)."""
    return PROFILES[profile].compact(largest_depth, **shape)


def check_shape(profile: str, shape: dict[str, float], largest_depth: float) -> str | None:
    """Why a profile cannot be used up to a depth, or None."""
    return PROFILES[profile].check(largest_depth, **shape)


def length_law(profile: str, shape: Mapping[str, float]) -> tuple[float, float]:
    """Coefficient c and power p in a_H = R (δ0/(c R))ᵖ."""
    return PROFILES[profile].length_law(**shape)


def too_small(profile: str, shape: dict[str, float], largest_depth: float) -> tuple[str, float] | None:
    """The shape parameter that no full disc up to a depth can have, and its least value, or None."""
    return PROFILES[profile].too_small(largest_depth, **shape)


__all__ = [
    "PROFILES",
    "Primitives",
    "Profile",
    "check_shape",
    "compact_shapes",
    "length_law",
    "make_profile",
    "resolved_shape",
    "roughness",
    "too_small",
]
