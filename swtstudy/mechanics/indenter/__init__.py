"""The registry of profiles: a family is a class here, a line below and a row of `choices.FAMILIES`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swtstudy.mechanics.indenter.base import Primitives, Profile
from swtstudy.mechanics.indenter.paraboloid import Paraboloid, RoundedPunch, TruncatedParaboloid
from swtstudy.mechanics.indenter.plane import Cylinder, RoundedFlat
from swtstudy.mechanics.indenter.power_law import PowerLaw, PowerLawCylinder
from swtstudy.mechanics.indenter.profile_table import AnyProfile, TabulatedProfile
from swtstudy.mechanics.indenter.tabulated import Tabulated, TabulatedPlane
from swtstudy.mechanics.indenter.wavy import WavyCylinder, WavyParaboloid
from swtstudy.mechanics.points import BoolArray, FloatArray, IntArray, Shape

PROFILES: dict[str, type[Profile]] = {
    "paraboloid": Paraboloid,
    "rounded_punch": RoundedPunch,
    "truncated_paraboloid": TruncatedParaboloid,
    "wavy_paraboloid": WavyParaboloid,
    "power_law": PowerLaw,
    "cylinder": Cylinder,
    "rounded_flat": RoundedFlat,
    "wavy_cylinder": WavyCylinder,
    "power_law_cylinder": PowerLawCylinder,
}


def _class_of(profile: AnyProfile, shape: Mapping[str, Any]) -> tuple[type[Profile], dict[str, Any]]:
    """The class of a family or of tables, and its shape: the table is that of all n profiles."""
    if isinstance(profile, str):
        return PROFILES[profile], dict(shape)
    of_table: type[Profile] = TabulatedPlane if profile.plane else Tabulated
    return of_table, {"table": profile}


def make_profile(profile: AnyProfile, shape: Shape, largest_depth: FloatArray) -> Profile:
    """n profiles of a family with shape parameters (n,), or of one table, in contact up to a depth (n,).

    What cannot be resolved is left out, see `resolved_shape`.
    """
    own, given = _class_of(profile, shape)
    resolved, _ = own.resolved(largest_depth, **given)
    return own(largest_depth, **resolved)


def roughness(profile: AnyProfile, shape: Shape, largest_depth: FloatArray) -> IntArray:
    """Levels of `Profile.roughness` of n profiles."""
    own, given = _class_of(profile, shape)
    return own.roughness(largest_depth, **given)


def resolved_shape(profile: AnyProfile, shape: Shape, largest_depth: FloatArray) -> tuple[Shape, FloatArray]:
    """Shape parameters that can be resolved, and the relative error of s by what was left out, (n,)."""
    own, given = _class_of(profile, shape)
    return own.resolved(largest_depth, **given)


def compact_shapes(profile: AnyProfile, shape: Shape, largest_depth: FloatArray) -> BoolArray:
    """True where `check_shape` accepts a shape up to a depth, each of shape (n,)."""
    own, given = _class_of(profile, shape)
    return own.compact(largest_depth, **given)


def check_shape(profile: AnyProfile, shape: dict[str, float], largest_depth: float) -> str | None:
    """Why a profile cannot be used up to a depth, or None."""
    own, given = _class_of(profile, shape)
    return own.check(largest_depth, **given)


def length_law(profile: AnyProfile, shape: Mapping[str, float]) -> tuple[float, float]:
    """Coefficient c and power p in a_H = R (δ0/(c R))ᵖ."""
    own, given = _class_of(profile, shape)
    return own.length_law(**given)


def too_small(profile: AnyProfile, shape: dict[str, float], largest_depth: float) -> tuple[str, float] | None:
    """The shape parameter that no full disc up to a depth can have, and its least value, or None."""
    own, given = _class_of(profile, shape)
    return own.too_small(largest_depth, **given)


__all__ = [
    "PROFILES",
    "Primitives",
    "Profile",
    "TabulatedProfile",
    "check_shape",
    "compact_shapes",
    "length_law",
    "make_profile",
    "resolved_shape",
    "roughness",
    "too_small",
]
