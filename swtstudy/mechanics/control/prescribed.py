"""What is prescribed in each direction, displacement or force, and the diagram that follows from it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from swtstudy.mechanics.control.coordinate import Coordinate, DepthCoordinate
from swtstudy.mechanics.control.force import ForceCoordinate, profile_up_to_force, unit_half_load
from swtstudy.mechanics.control.mapped import MappedLoad
from swtstudy.mechanics.control.normal_map import DepthOfForce, ForceOfDepth, NormalMap
from swtstudy.mechanics.indenter import make_profile
from swtstudy.mechanics.load.bimodal import BimodalLoad
from swtstudy.mechanics.load.load import Load
from swtstudy.mechanics.load.polygon import PolygonLoad
from swtstudy.mechanics.points import FloatArray


@dataclass(frozen=True)
class Prescribed:
    """Whether the normal and the tangential load are forces; displacements otherwise.

    A normal force is in units of that at the depth δ0, a tangential one over μ times that.
    """

    normal_force: bool = False
    tangential_force: bool = False

    @property
    def mixed(self) -> bool:
        """Whether a force and a displacement are prescribed."""
        return self.normal_force != self.tangential_force

    def diagram(self, name: str, shape: dict[str, FloatArray], load: Load) -> tuple[Load, Coordinate]:
        """The load in the coordinate of its memory diagram, and that coordinate.

        Parameters
        ----------
        name, shape
            Family and shape parameters, each of shape (n,), of n profiles.
        load
            n loads as they are prescribed.

        Raises
        ------
        ValueError
            If a polygon is prescribed by a force and a displacement and its normal load is not constant:
            its sides are no straight lines of the diagram.
        """
        if self.normal_force:
            profile, unit = profile_up_to_force(name, shape, load.largest_normal)
        else:
            profile = make_profile(name, shape, load.largest_normal)
            unit = unit_half_load(name, shape, len(load)) if self.tangential_force else np.ones(0)
        coordinate = ForceCoordinate(profile, unit) if self.tangential_force else DepthCoordinate(profile)
        if not self.mixed:
            return load, coordinate
        force = ForceCoordinate(profile, unit)
        return _mapped(load, DepthOfForce(force) if self.normal_force else ForceOfDepth(force)), coordinate


def _mapped(load: Load, normal_map: NormalMap) -> Load:
    """The load with its normal component mapped."""
    if isinstance(load, BimodalLoad):
        return MappedLoad(load, normal_map)
    if not isinstance(load, PolygonLoad) or np.any(load.largest_normal != load.least_normal):
        raise ValueError(
            "a loop whose normal load is not constant needs two displacements or two forces: "
            "with one of each its straight sides are curved in the memory diagram"
        )
    return replace(load, corner_normal=normal_map.value(load.corner_normal))
