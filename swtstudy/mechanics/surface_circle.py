"""swt on the circle through a point of the surface line: the line's assumption y = 0, tested cheaply.

The stress at (r cos θ, r sin θ) on the surface is made of the same building blocks as on the line. By
pressure it is axisymmetric; by shear, with c = cos θ, s = sin θ, j = T1 − T3 and k = (3/2) T1 − 2 T3,

    σ_xx = (1 + ν) T1 c + σ,   σ_yy = −σ,   σ_xy = T1 s/2 + ν s (2 c² k − j),   σ = ν c (2 c² k − 3 j),

since ζ = iξ at the surface makes the functions of `field.punch` depend on one another: r² L³/R = 2 L² − L/R.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.critical_plane_3d import swt_of_history
from swtstudy.mechanics.instants import cosine_nodes, stretches
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.surface_stress import History, SurfaceLine
from swtstudy.mechanics.swt_line import Scene

#: Angles between the line and the y axis that are looked at.
_ANGLES = np.linspace(0.0, 0.5 * np.pi, 25)
_TIME_STEPS, _DIGITS = 4, 5.5


def circle_gain(scene: Scene, position: FloatArray) -> tuple[FloatArray, FloatArray]:
    """By how much swt on the circle through a point of the surface line exceeds swt on the line.

    Parameters
    ----------
    scene
        n points.
    position
        Shape (n,): signed x in a_H of the line's maximum.

    Returns
    -------
    gain, angle
        Shape (n,): the relative excess, 0 where the line has the maximum, and where on the circle it is, rad
        from the line; over all plane orientations.
    """
    r = np.abs(position)[:, None]
    line = SurfaceLine(scene.cycle, scene.profile, r, _DIGITS)
    nodes, _ = cosine_nodes(scene.cycle, stretches(scene.cycle, scene.profile.depth(r)), _TIME_STEPS)
    history = line.history(nodes)
    gain, angle = np.zeros(len(position)), np.zeros(len(position))
    for row, x in enumerate(position):
        ν, μ = float(scene.poisson_ratio[row]), float(scene.friction[row])
        blocks = History(*(getattr(history, name)[row, 0] for name in history.__dataclass_fields__))
        stress = circle_stress(blocks, ν, μ, np.where(x >= 0.0, _ANGLES, np.pi - _ANGLES))
        swt = swt_of_history(stress, ν, 1.0 - ν**2).swt
        best = int(swt.argmax())
        if swt[best] > 0.0 and best:
            gain[row] = swt[best] / swt[0] - 1.0 if swt[0] > 0.0 else np.inf
            angle[row] = _ANGLES[best]
    return gain, angle


def circle_stress(history: History, poisson_ratio: float, friction: float, angle: FloatArray) -> FloatArray:
    """Stress on a circle of the surface, shape (k, T, 6), components xx, yy, zz, yz, xz, xy in E* √(δ0/R).

    Parameters
    ----------
    history
        Building blocks at one r, shape (T,).
    poisson_ratio, friction
        ν, μ.
    angle
        Shape (k,): θ from the x axis.
    """
    ν = poisson_ratio
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    spread = 0.5 * (1.0 - 2.0 * ν) * history.mean_pressure
    radial, hoop = spread - history.pressure, -spread - 2.0 * ν * history.pressure
    t1, t3 = friction * history.tangential_1, friction * history.tangential_3
    j, k = t1 - t3, 1.5 * t1 - 2.0 * t3
    across = ν * c * (2.0 * c * c * k - 3.0 * j)
    stress = np.zeros((*np.broadcast_shapes(c.shape, t1.shape), 6))
    stress[..., 0] = radial * c * c + hoop * s * s + (1.0 + ν) * t1 * c + across
    stress[..., 1] = radial * s * s + hoop * c * c - across
    stress[..., 2] = -history.pressure
    stress[..., 4] = friction * history.traction
    stress[..., 5] = (radial - hoop) * c * s + 0.5 * t1 * s + ν * s * (2.0 * c * c * k - j)
    return stress
