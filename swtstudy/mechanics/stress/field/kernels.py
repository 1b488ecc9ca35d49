"""Kernels that are superposed over the springs beneath the surface: the fields of discs, or of strips."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.field import punch, strip
from swtstudy.mechanics.stress.field.primitives import primitives


@dataclass(frozen=True)
class Kernels:
    """The field of one disc or strip.

    Attributes
    ----------
    functions
        Named tuple of the functions of which it is made, or of their integrals over ξ.
    distance
        From x and y to the distance at which the functions are taken.
    primitives
        From distances, depths and radii to the functions integrated over ξ, weighted with 1 and with ξ.
    normal, tangential
        From the functions, x, y, z and ν to the stress by pressure and by shear in +x.
    """

    functions: type[punch.PunchFunctions] | type[strip.StripFunctions]
    distance: Callable[[FloatArray, FloatArray], FloatArray]
    primitives: Callable[[FloatArray, FloatArray, FloatArray], tuple[Any, Any]]
    normal: Callable[..., FloatArray]
    tangential: Callable[..., FloatArray]


DISC = Kernels(
    punch.PunchFunctions, np.hypot, primitives, punch.normal_components, punch.tangential_components
)
STRIP = Kernels(
    strip.StripFunctions,
    lambda x, _: np.abs(x),
    strip.strip_primitives,
    strip.normal_components,
    strip.tangential_components,
)


def kernels_of(profile: Profile) -> Kernels:
    """Return the kernels of a profile's contact."""
    return STRIP if profile.plane else DISC
