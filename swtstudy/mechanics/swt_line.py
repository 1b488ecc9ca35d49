"""swt at given positions of the surface line: the extremes over the cycle and over the planes.

First all event-aligned instants are looked at; then the stress is sampled anew around the three instants
that make swt (the largest σ_n, the largest and the smallest ε_n), ever closer.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from swtstudy.mechanics.contact import Cycle
from swtstudy.mechanics.critical_plane import PlaneHistory, best_angle, coarse_swt, parabola, pick, product
from swtstudy.mechanics.instants import cosine_nodes, stretches
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.profiles.base import Profile
from swtstudy.mechanics.surface_stress import History, SurfaceLine, stresses

#: Half the number of steps into which a zoom divides the two steps around an extreme.
ZOOM_STEPS = 3


@dataclass(frozen=True)
class Resolution:
    """How finely swt is computed.

    Attributes
    ----------
    nodes
        Steps of the cosine-spaced instants of each stretch.
    zooms
        How often the extremes are looked at more closely.
    growth_nodes
        Chebyshev nodes for the springs that stuck at touch-down.
    """

    nodes: int
    zooms: int
    growth_nodes: int


@dataclass(frozen=True)
class Scene:
    """n points: what the stress on the surface line depends on.

    Attributes
    ----------
    cycle, profile
        n contact cycles and n profiles.
    poisson_ratio, friction
        Shape (n,).
    """

    cycle: Cycle
    profile: Profile
    poisson_ratio: FloatArray
    friction: FloatArray

    def __len__(self) -> int:
        return len(self.friction)

    def take(self, index: np.ndarray) -> Scene:
        """The points at ``index``, repetitions allowed."""
        return Scene(
            self.cycle.take(index), self.profile.take(index), self.poisson_ratio[index], self.friction[index]
        )

    def planes(self, history: History, side: FloatArray | float) -> PlaneHistory:
        """σ_n and ε_n on the planes through y, on the given side of the contact."""
        sigma = stresses(history, self.poisson_ratio, self.friction, side)
        return PlaneHistory.from_stresses(sigma, self.poisson_ratio)


def scan(
    scene: Scene, position: FloatArray, resolution: Resolution, planes: int
) -> tuple[FloatArray, FloatArray]:
    """swt on both sides of the contact, to the accuracy of a first look.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    resolution
        Its zooms are not used.
    planes
        Number of planes that are tried.

    Returns
    -------
    swt, double_angle
        Shape (n, 2, X): at x = +r and x = −r; 2θ in rad.
    """
    line = SurfaceLine(scene.cycle, scene.profile, position, resolution.growth_nodes)
    ends = stretches(scene.cycle, scene.profile.depth(position))
    history = line.history(*cosine_nodes(ends, resolution.nodes))
    sides = (coarse_swt(scene.planes(history, side), planes) for side in (1.0, -1.0))
    swt, angle = (np.stack(both, axis=1) for both in zip(*sides, strict=True))
    return swt, angle


def refine(
    scene: Scene, position: FloatArray, side: FloatArray, double_angle: FloatArray, resolution: Resolution
) -> tuple[FloatArray, FloatArray]:
    """swt on one side of the contact, with the extremes found closely.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n, X): r = |x|.
    side
        Shape (n,): sign of x.
    double_angle
        Shape (n, X): 2θ to start from, rad.
    resolution
        How closely.

    Returns
    -------
    swt, double_angle
        Shape (n, X).
    """
    line = SurfaceLine(scene.cycle, scene.profile, position, resolution.growth_nodes)
    ends = stretches(scene.cycle, scene.profile.depth(position))
    side = side[:, None, None]
    interval, instant = cosine_nodes(ends, resolution.nodes)
    planes = scene.planes(line.history(interval, instant), side)
    angle = double_angle
    for _ in range(2):
        at = _extremes(planes, angle)
        angle = best_angle(*_active(planes, at), angle)
    at = _extremes(planes, angle)

    # Each extreme lies between the neighbours of its node, in the angle of the cosine-spaced nodes.
    steps = resolution.nodes
    stretch, node = at // (steps + 1), at % (steps + 1)
    n, columns = position.shape
    low, high = (ends[..., k : k + 3].reshape(n, columns, -1) for k in (0, 1))
    low, high = (np.take_along_axis(v, np.moveaxis(stretch, 0, -1), axis=-1) for v in (ends[..., :-1].reshape(n, columns, -1), ends[..., 1:].reshape(n, columns, -1)))
    which = np.moveaxis(stretch // 3, 0, -1)
    centre = np.moveaxis(node, 0, -1) * (np.pi / steps)
    width = np.pi / steps
    swt = np.zeros(position.shape)
    offsets = np.arange(-ZOOM_STEPS, ZOOM_STEPS + 1) / ZOOM_STEPS
    for _ in range(resolution.zooms):
        centre = np.clip(centre, width, np.pi - width)
        alpha = centre[..., None] + width * offsets
        instant = low[..., None] + (high - low)[..., None] * (0.5 - 0.5 * np.cos(alpha))
        interval = np.repeat(which, offsets.size, axis=-1)
        planes = scene.planes(line.history(interval, instant.reshape(n, columns, -1)), side)
        parts = [
            PlaneHistory(*(c[..., k * offsets.size : (k + 1) * offsets.size] for c in (planes.stress, planes.strain)))
            for k in range(3)
        ]
        swt, angle, shift = _from_parts(parts, angle)
        width /= ZOOM_STEPS
        centre = centre + width * shift
    return swt, angle


def _extremes(planes: PlaneHistory, angle: FloatArray) -> np.ndarray:
    """Indices of the instants of largest σ_n, largest ε_n, smallest ε_n, shape (3, …)."""
    stress, strain = planes.on_plane(angle)
    return np.stack([stress.argmax(axis=-1), strain.argmax(axis=-1), strain.argmin(axis=-1)])


def _active(planes: PlaneHistory, at: np.ndarray) -> tuple[FloatArray, FloatArray]:
    """Coefficients of σ_n at its maximum and of ε_n between its extremes, each (3, …)."""
    return pick(planes.stress, at[0]), pick(planes.strain, at[1]) - pick(planes.strain, at[2])


def _from_parts(
    parts: list[PlaneHistory], angle: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """swt from the three neighbourhoods; the angle, improved; the vertices in steps from their centres."""
    def curves(angle):
        return parts[0].on_plane(angle)[0], parts[1].on_plane(angle)[1], -parts[2].on_plane(angle)[1]
    at = [c.argmax(axis=-1) for c in curves(angle)]
    peak = pick(parts[0].stress, at[0])
    swing = pick(parts[1].strain, at[1]) - pick(parts[2].strain, at[2])
    angle = best_angle(peak, swing, angle)
    tops, shifts = [], []
    for curve in curves(angle):
        index = curve.argmax(axis=-1)
        middle = np.clip(index, 1, curve.shape[-1] - 2)
        values = [pick(curve, middle + k) for k in (-1, 0, 1)]
        shift, rise = parabola(*values)
        top = pick(curve, index)
        vertex = values[1] + rise
        shifts.append(np.where(vertex >= top, middle + shift, index) - ZOOM_STEPS)
        tops.append(np.maximum(vertex, top))
    return product(tops[0], tops[1], -tops[2]), angle, np.stack(shifts, axis=-1)
