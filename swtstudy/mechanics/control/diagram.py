"""The memory diagram from what is prescribed: the load in its coordinate, and that coordinate."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.control.coordinate import Coordinate, DepthCoordinate
from swtstudy.mechanics.control.force import ForceCoordinate, profile_up_to_force, unit_half_load
from swtstudy.mechanics.control.mapped import MappedLoad
from swtstudy.mechanics.control.normal_map import DepthOfForce, ForceOfDepth, NormalMap
from swtstudy.mechanics.control.tabled_map import TabledMap
from swtstudy.mechanics.indenter import TabulatedProfile, make_profile
from swtstudy.mechanics.indenter.base import Profile
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.load.polygon import PolygonLoad
from swtstudy.mechanics.points import FloatArray
from swtstudy.vocabulary.families import is_plane
from swtstudy.vocabulary.prescribed import Control


def largest_depth(
    control: Control, name: str | TabulatedProfile, shape: dict[str, FloatArray], largest_normal: FloatArray
) -> FloatArray:
    """Largest indentation depth over δ0 at the largest normal load, as it is prescribed; shape (n,)."""
    if not control.normal_force:
        return largest_normal
    return profile_up_to_force(name, shape, largest_normal)[0].largest_depth


def diagram(
    control: Control, name: str | TabulatedProfile, shape: dict[str, FloatArray], load: Load
) -> tuple[Load, Coordinate]:
    """The load in the coordinate of its memory diagram, and that coordinate.

    The coordinate is that of the tangential load, into which the normal load is mapped where the two differ.

    Parameters
    ----------
    control
        What is prescribed.
    name, shape
        Family and shape parameters, each of shape (n,), of n profiles of one roughness.
    load
        n loads as they are prescribed.

    Raises
    ------
    ValueError
        If a polygon is prescribed by a force and a displacement and its normal load is not constant: its
        sides are no straight lines of the diagram.
    """
    if control.normal_force or is_plane(name):
        profile, unit = profile_up_to_force(name, shape, load.largest_normal)
    else:
        profile = make_profile(name, shape, load.largest_normal)
        unit = unit_half_load(name, shape, len(load)) if control.tangential_force else np.ones(0)
    if profile.plane:
        # A load that rests may be said to be of displacements: there are only forces.
        return load, ForceCoordinate(profile, unit)
    coordinate = ForceCoordinate(profile, unit) if control.tangential_force else DepthCoordinate(profile)
    if not control.mixed:
        return load, coordinate
    force = ForceCoordinate(profile, unit)
    exact = DepthOfForce(force) if control.normal_force else ForceOfDepth(force)
    if not isinstance(load, BimodalLoad):
        return _mapped_polygon(load, exact), coordinate
    tables = profile.tables()
    return MappedLoad(
        load, exact if tables is None else TabledMap.of(exact, tables), _waves(profile)
    ), coordinate


def _mapped_polygon(load: Load, normal_map: NormalMap) -> Load:
    """The polygon with its normal component mapped."""
    if not isinstance(load, PolygonLoad) or np.any(load.largest_normal != load.least_normal):
        raise ValueError(
            "a loop whose normal load is not constant needs two displacements or two forces: "
            "with one of each its straight sides are curved in the memory diagram"
        )
    return load.with_normal(normal_map.value)


def _waves(profile: Profile) -> float:
    """Largest number of waves of the profiles that the edge passes."""
    reach = profile.radius(profile.largest_depth)
    return float(np.max(reach / profile.feature_length, initial=0.0))
