"""The registry of profiles: a new profile is one file here and one line below."""

from __future__ import annotations

from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Primitives, Profile
from swtstudy.mechanics.profiles.paraboloid import Paraboloid

PROFILES: dict[str, type[Profile]] = {"paraboloid": Paraboloid}


def make_profile(name: str, shape: dict[str, FloatArray], count: int) -> Profile:
    """The ``count`` profiles of family ``name`` with the given shape parameters, each of shape (count,)."""
    return PROFILES[name](count, **shape)


def check_shape(profile: str, shape: dict[str, float], normal_amplitude: float) -> str | None:
    """Why a profile cannot be used up to the depth 1 + ``normal_amplitude``, or None."""
    return PROFILES[profile].check(1.0 + normal_amplitude, **shape)


__all__ = ["PROFILES", "Primitives", "Profile", "check_shape", "make_profile"]
