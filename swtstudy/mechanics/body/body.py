"""swt at points of the body: one contact cycle, all plane orientations (eqs. 9, 15–18)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.events.stretches import cosine_nodes, stretches
from swtstudy.mechanics.planes.all_planes import CriticalPlane, swt_of_history
from swtstudy.mechanics.planes.weights import normal_weights
from swtstudy.mechanics.points import FloatArray, IndexArray, Rows
from swtstudy.mechanics.stress.contact_states import contact_states
from swtstudy.mechanics.stress.scene import Scene

#: Parts into which a gap between instants is divided beside an extreme over the cycle. Three: 5e-4 in 16
#: values of bodies, 10 % faster; twelve: 3e-5, 10 % slower.
SUBDIVISIONS = 6
#: Instants whose contact states are held at a time: memory grows with its square. 16: 20 % slower; 1024: 20 %
#: faster, 1 MB more at 229 instants. The cells follow it: s by up to 7e-6 in 16 values of bodies.
INSTANTS = 64
#: Points × instants whose planes are searched at a time: that takes about 1 kB for each. An eighth: 45 MB
#: less at 1,200 points, 40 % slower; eight times: 150 MB more, no faster.
VALUES = 65536


@dataclass(frozen=True)
class TimeNodes(Rows):
    """Instants of a cycle, each with its interval, shape (T,)."""

    interval: IndexArray
    instant: FloatArray


@dataclass(frozen=True)
class Body:
    """The elastic half-space under one contact cycle.

    Attributes
    ----------
    scene
        A batch of one point: cycle, profile, ν and μ.
    nodes
        The instants of the cycle.
    cells
        As for `contact_states`.
    """

    scene: Scene
    nodes: TimeNodes
    cells: int

    def stress(self, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> FloatArray:
        """Stress history at points of shape S in a_H, shape S + (T, 6), in E* √(δ0/R)."""
        scene, interval, instant = self.scene, self.nodes.interval, self.nodes.instant
        material = float(scene.friction[0]), float(scene.poisson_ratio[0])
        stress = np.empty((*np.broadcast_shapes(*map(np.shape, (x, y, z))), instant.size, 6))
        for first in range(0, instant.size, INSTANTS):
            part = slice(first, first + INSTANTS)
            states = contact_states(scene.cycle, scene.coordinate, interval[part], instant[part], self.cells)
            stress[..., part, :] = states.stress(x, y, z, *material)
        scene.add_bulk(stress, instant)
        return stress

    def swt(self, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> CriticalPlane:
        """swt over E* δ0/R at points of shape S, with the normals of the critical planes."""
        ν, criterion = float(self.scene.poisson_ratio[0]), self.scene.criterion
        x, y, z = np.broadcast_arrays(x, y, z)
        swt, normal = np.empty(x.size), np.empty((x.size, 3))
        columns = max(1, VALUES // self.nodes.instant.size)
        for first in range(0, x.size, columns):
            part = slice(first, first + columns)
            stress = self.stress(x.flat[part], y.flat[part], z.flat[part])
            swt[part], normal[part] = swt_of_history(stress, ν, 1.0 - ν**2, criterion)
        return CriticalPlane(swt.reshape(x.shape), normal.reshape(*x.shape, 3))


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
    coordinate = scene.coordinate.of(r) if r.size else 1.0 + scene.cycle.load.largest_normal[:, None]
    nodes, _ = cosine_nodes(scene.cycle, stretches(scene.cycle, coordinate), count)
    return _sorted_nodes(scene, nodes.instant[0])


def closer_nodes(
    scene: Scene, nodes: TimeNodes, point: tuple[float, ...], cells: int, looks: int = 3
) -> TimeNodes:
    """The same instants and others around those that make swt at one point.

    Parameters
    ----------
    scene
        A batch of one point.
    nodes
        Instants from which to start.
    point
        x, y, z in a_H.
    cells
        As for `contact_states`.
    looks
        How often the gaps beside the extremes over the cycle are divided.
    """
    share = np.arange(1, SUBDIVISIONS) / SUBDIVISIONS
    for _ in range(looks):
        body = Body(scene, nodes, cells)
        stress, swing = _on_critical_plane(body, point)
        extremes = np.array([stress.argmax(), swing.argmax(), swing.argmin()])
        left = np.concatenate([extremes - 1, extremes])
        left = left[(left >= 0) & (left < len(nodes.instant) - 1)]
        low, high = nodes.instant[left, None], nodes.instant[left + 1, None]
        nodes = _sorted_nodes(scene, np.concatenate([nodes.instant, (low + (high - low) * share).ravel()]))
    return nodes


def together(scene: Scene, *several: TimeNodes) -> TimeNodes:
    """All instants of several sets."""
    return _sorted_nodes(scene, np.concatenate([nodes.instant for nodes in several]))


def nodes_at(scene: Scene, instant: FloatArray) -> TimeNodes:
    """Instants φ in [0, 2π], in any order, with their intervals; two that meet share their stress."""
    interval = (instant[:, None] > scene.cycle.end[0]).sum(axis=1)
    return TimeNodes(np.minimum(interval, scene.cycle.end.shape[1] - 1), instant)


def _on_critical_plane(body: Body, point: tuple[float, ...]) -> tuple[FloatArray, FloatArray]:
    """σ_n and the swing (E ε_n) over the instants, shape (T,), on the critical plane of one point."""
    ν = float(body.scene.poisson_ratio[0])
    stress = body.stress(*point)
    criterion = body.scene.criterion
    normal = swt_of_history(stress, ν, 1.0 - ν**2, criterion).normal
    swing = criterion.swing.on_plane(criterion.swing.tensor(stress, ν), normal)
    return stress @ normal_weights(normal), swing


def _sorted_nodes(scene: Scene, instant: FloatArray) -> TimeNodes:
    return nodes_at(scene, np.unique(instant))
