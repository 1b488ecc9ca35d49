"""The displacement that goes with a line load, but for a constant share of it.

A strip of half-width ξ moves by −(2/π) ln ξ for each unit of load per E*: over μ δ0 and μ P_0, P_0 being
(π/4) E* δ0, that is −½ ln ξ. Far away the body moves with the load, too: displacements in the plane are known
but for a constant times the load, which adds nothing to the work along a loop.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.indenter.plane import PlaneProfile
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.rows import Rows


@dataclass(frozen=True)
class StripDisplacement(Rows):
    """∫ −½ ln ξ d(N/N_0) over n profiles: what in the plane stands beside the force as the other coordinate.

    Attributes
    ----------
    profile
        n profiles of one family.
    """

    profile: PlaneProfile

    def of(self, radius: FloatArray) -> FloatArray:
        """At half-widths ξ/a_H, shape (n, …)."""
        load = self.profile.depth(radius)
        logarithm = np.log(np.where(radius > 0.0, radius, 1.0))
        return 0.5 * (self.profile.depth_over_radius(radius) - load * logarithm)

    @staticmethod
    def compliance(radius: FloatArray) -> FloatArray:
        """Its derivative by N/N_0."""
        return -0.5 * np.log(radius)
