"""swt at points of the body: one contact cycle, all plane orientations (eqs. 9, 15–18)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from swtstudy.mechanics.critical_plane_3d import CriticalPlane, highest_coarse_swt, swt_of_history
from swtstudy.mechanics.field import ContactStates, contact_states
from swtstudy.mechanics.instants import cosine_nodes, stretches
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.swt_line import Scene


@dataclass(frozen=True)
class TimeNodes:
    """Instants of a cycle, each with its interval, shape (T,)."""

    interval: NDArray[np.intp]
    instant: FloatArray


@dataclass(frozen=True)
class Body:
    """The elastic half-space under one contact cycle.

    Attributes
    ----------
    scene
        A batch of one point: cycle, profile, ν and μ.
    states
        The contact at the instants of the cycle.
    """

    scene: Scene
    states: ContactStates

    @classmethod
    def of(cls, scene: Scene, nodes: TimeNodes, cells: int) -> Body:
        """The body at the given instants; ``cells`` as for `contact_states`."""
        return cls(
            scene, contact_states(scene.cycle, scene.profile, nodes.interval, nodes.instant, cells)
        )

    def stress(self, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> FloatArray:
        """Stress history at points of shape S in a_H, shape S + (T, 6), in E* √(δ0/R)."""
        return self.states.stress(
            *(np.asarray(v, dtype=float) for v in (x, y, z)),
            float(self.scene.friction[0]),
            float(self.scene.poisson_ratio[0]),
        )

    def swt(self, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> CriticalPlane:
        """swt over E* δ0/R at points of shape S, with the normals of the critical planes."""
        ν = float(self.scene.poisson_ratio[0])
        return swt_of_history(self.stress(x, y, z), ν, 1.0 - ν**2)

    def coarse_swt(self, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> FloatArray:
        """A lower bound of swt at points of shape S, within a few per cent, for a first look."""
        ν = float(self.scene.poisson_ratio[0])
        return highest_coarse_swt(self.stress(x, y, z), ν, 1.0 - ν**2)


def time_nodes(scene: Scene, count: int, radius: ArrayLike = ()) -> TimeNodes:
    """Cosine-spaced instants of the cycle, aligned with the events at some radii.

    Parameters
    ----------
    scene
        A batch of one point.
    count
        Steps on each stretch between two events.
    radius
        Shape (X,): distances from the axis in a_H at whose surface the stress has square-root cusps in time,
        when the contact edge or a slip front passes. Without any, all events but these are nodes.
    """
    r = np.asarray(radius, dtype=float).reshape(1, -1)
    # A spring that never touches sees neither edge nor front.
    depth = scene.profile.depth(r) if r.size else 2.0 + scene.cycle.protocol.normal_amplitude[:, None]
    nodes, _ = cosine_nodes(scene.cycle, stretches(scene.cycle, depth), count)
    interval, instant = nodes.interval[0], nodes.instant[0]
    real = (scene.cycle.end - scene.cycle.begin)[0, interval] > 0.0
    instant, first = np.unique(instant[real], return_index=True)
    return TimeNodes(interval[real][first], instant)
