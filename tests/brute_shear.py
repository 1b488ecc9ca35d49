"""The criteria of shear by plain loops: every position, plane and instant, with the stress tensor turned."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.solver.load_cycle import LoadCycle
from swtstudy.solver.points import Points
from swtstudy.vocabulary.arrays import FloatArray

#: Steps between two cusps of the line, and between two events of the cycle; planes; rounds of closer looks.
STEPS, INSTANTS, PLANES, ROUNDS = 60, 4, 90, 4


def value_of(criterion: str, sensitivity: float, normal: FloatArray, shear: FloatArray) -> FloatArray:
    """The criteria's definitions, from σ_n and τ of planes over time, (..., T)."""
    amplitude, tension = 0.5 * np.ptp(shear, axis=-1), normal.max(axis=-1)
    if criterion == "findley":
        return amplitude + sensitivity * tension
    return amplitude * (1.0 + sensitivity * np.maximum(tension, 0.0))


def highest_at(
    cycle: LoadCycle, own: tuple[str, float], x: FloatArray, angles: FloatArray, steps: int
) -> tuple:
    """Largest value over the planes whose normals are at angles from x, and that angle, at each place."""
    best, plane = np.empty(x.size), np.empty(x.size)
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    for k, place in enumerate(x.tolist()):
        stress = cycle.stress(place, cycle.states(cycle.instants(steps, place)))
        xx, zz, xz = stress["xx"], stress["zz"], stress["xz"]
        normal = c * c * xx + s * s * zz + 2.0 * s * c * xz
        value = value_of(*own, normal, s * c * (zz - xx) + (c * c - s * s) * xz)
        best[k], plane[k] = value.max(), angles[value.argmax()]
    return best, plane


def brute(points: Points, criterion: str, sensitivity: float, steps: int = STEPS) -> tuple[float, float]:
    """The largest value on the line y = 0 of a batch of one point, and x there."""
    cycle, own = LoadCycle(points), (criterion, sensitivity)
    ends = cycle.radius(cycle.cusps())
    share = 0.5 - 0.5 * np.cos(np.pi / steps * np.arange(steps))
    r = np.append((ends[:-1, None] + np.diff(ends)[:, None] * share).ravel(), ends[-1])
    best, place = -np.inf, np.nan
    step = np.pi / PLANES
    for side in (1.0, -1.0):
        value, plane = highest_at(cycle, own, side * r, step * np.arange(PLANES), INSTANTS)
        framed = np.pad(value, 1, constant_values=-np.inf)
        peaks = np.flatnonzero((value >= framed[:-2]) & (value >= framed[2:]) & (value > 0.9 * value.max()))
        for k in sorted(peaks, key=lambda k: -value[k])[:4]:
            low, high, angle, turn = r[max(k - 1, 0)], r[min(k + 1, r.size - 1)], plane[k], step
            for _ in range(ROUNDS):
                x: NDArray = np.unique(np.append(np.linspace(low, high, 17), r[k]))
                found, planes = highest_at(cycle, own, side * x, angle + turn * np.linspace(-1, 1, 17), 12)
                top = int(found.argmax())
                if found[top] > best:
                    best, place = float(found[top]), float(side * x[top])
                low, high = x[max(top - 1, 0)], x[min(top + 1, x.size - 1)]
                angle, turn = planes[top], 0.2 * turn
    return best, place
