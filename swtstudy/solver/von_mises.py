"""The largest von Mises stress over the cycle and over the body, to about 1 %: does it yield?

Its place depends on friction, on the load and on the bulk stress: beneath the middle, at an edge or a
slip front, in between, or across the direction of sliding. So a mesh of the body is looked at, and from its
highest places a search goes uphill in ever smaller steps. In the surface the stress has cusps where edges
and fronts are: these are places of the mesh themselves.
"""

from __future__ import annotations

import numpy as np

from swtstudy.kernel.field import Opened, largest_radius, open_cycle, passed_radii, von_mises_at
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.arrays import FloatArray

#: Tolerance of what grew in stick.
GROWTH = 1e-4
#: Distances from the axis and depths of the mesh over the largest contact radius, and angles from x. Outside
#: of the contact only a bulk stress is left.
RADII, DEPTHS, ANGLES = np.linspace(0.0, 1.2, 9), np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.8]), 5
#: Distances from the edge of a wide face and depths beneath, over the width of the ring beside it. Without:
#: 30 % low beneath a face 500 times as wide (tests/solver/test_von_mises.py).
BESIDE_FACE, BENEATH_EDGE = np.linspace(-2.0, 1.2, 9), np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.8, 1.5, 3.0])
#: Most radii of the surface that edges and fronts pass at which is looked.
MOST_PASSED = 48
#: Distances in each wave of a profile, and at most so many over the contact.
IN_A_WAVE, MOST_RADII = 6, 240
#: From how many of the highest places, how far apart and in which first steps, over the radius; how often a
#: step is tried, and halved where nothing is higher.
CLIMBS, APART, FIRST_STEP, TRIES = 4, 0.15, 0.1, 6


def largest_von_mises(points: Points) -> FloatArray:
    """The largest von Mises stress over cycle and body in E* √(δ0/R), to about 1 %, shape (n,).

    inf at the edge of a truncated paraboloid's face, at which the pressure is infinite; NaN without a cycle.
    """
    found = np.full(len(points), np.nan)
    for k in range(len(points)):
        opened = open_cycle(GROWTH, **arguments_of(points[[k]]))
        if opened is not None:
            found[k] = _of_one(opened)
    return found


def _of_one(opened: Opened) -> float:
    """The same of one point: from the highest places of a mesh uphill, at a tip, and far from the contact."""
    profile, reach = opened.point.profile, largest_radius(opened)
    face, feature = float(profile["flat_radius"]), 2.0 * float(profile["longest"])
    if profile["singular"] and face > 0.0:
        return np.inf
    # About the edge of a face that is much wider than the ring of contact beside it.
    ring, beside = reach - face, np.empty((0, 3))
    if ring < 0.5 * reach:
        beside = _around_axis(opened, face + ring * BESIDE_FACE, ring * BENEATH_EDGE)
    waves = min(IN_A_WAVE * reach / feature, MOST_RADII)
    radii = RADII if waves < len(RADII) else np.linspace(0.0, RADII[-1], int(waves))
    mesh = _around_axis(opened, reach * radii, reach * DEPTHS)
    passed = np.append(passed_radii(opened, MOST_PASSED), face)
    place = np.concatenate([beside, mesh, _around_axis(opened, np.unique(passed), np.zeros(1))])
    largest = von_mises_at(opened, place)
    starts = np.array(_highest(place, largest, APART * reach))
    step = FIRST_STEP * np.minimum(np.where(starts < len(beside), ring, reach), feature)
    top = _climb(opened, place[starts], largest[starts], step)
    return max(top, _at_tip(opened), _far_away(opened))


def _around_axis(opened: Opened, radius: FloatArray, depth: FloatArray) -> FloatArray:
    """Places x, y, z in a_H at all angles that matter, shape (m, 3); nothing is different at −y."""
    # Half a cycle later the stress of a mirrored load is the stress of the other side.
    angle = np.linspace(0.0, np.pi, 2 if opened.point.profile["plane"] else ANGLES)
    angle = angle[: (len(angle) + 1) // 2] if opened.point.load["mirrored"] else angle
    r, θ, z = (each.ravel() for each in np.meshgrid(radius, angle, depth, indexing="ij"))
    # Exactly on the line: rounding would leave a y there.
    return np.stack([r * np.cos(θ), np.where(θ == np.pi, 0.0, r * np.sin(θ)), z], axis=1)


def _highest(place: FloatArray, largest: FloatArray, apart: float) -> list[int]:
    """Numbers of the highest places, so far apart."""
    found: list[int] = []
    left = largest.copy()
    while len(found) < CLIMBS and np.isfinite(left).any():
        best = int(np.where(np.isfinite(left), left, -np.inf).argmax())
        found.append(best)
        left[np.linalg.norm(place - place[best], axis=1) <= apart] = -np.inf
    return found


def _climb(opened: Opened, place: FloatArray, value: FloatArray, steps: FloatArray) -> float:
    """The highest value that steps uphill from places of shape (k, 3) lead to, of shape (k,) at first."""
    axes = np.eye(3)[[0, 2]] if opened.point.profile["plane"] else np.eye(3)
    ways = np.concatenate([axes, -axes])
    every = np.arange(len(place))
    for _ in range(TRIES):
        tried = place[:, None] + steps[:, None, None] * ways
        tried[..., 1:] = np.abs(tried[..., 1:])  # the other half is its mirror image
        values = von_mises_at(opened, tried.reshape(-1, 3)).reshape(tried.shape[:2])
        best = values.argmax(axis=1)
        higher = values[every, best] > value
        place = np.where(higher[:, None], tried[every, best], place)
        value = np.maximum(value, values[every, best])
        steps = np.where(higher, steps, 0.5 * steps)
    return float(value.max())


def _at_tip(opened: Opened) -> float:
    """Von Mises stress of the largest pressure alone in the middle of the surface, where a sharp tip has it.

    There the stresses along the surface are (½ + ν) p, and under a strip p and 2ν p. The pressure under ξⁿ is
    in the middle n/(n − 1) aⁿ⁻¹/π.
    """
    profile, ν = opened.point.profile, float(opened.point.ask["poisson_ratio"])
    n = float(profile["exponent"])
    if n <= 1.0:
        return 0.0
    pressure = n / (n - 1.0) * largest_radius(opened) ** (n - 1.0)
    return float(pressure * (0.25 * (1.0 - 2.0 * ν) if profile["plane"] else (0.5 - ν) / np.pi))


def _far_away(opened: Opened) -> float:
    """Von Mises stress of the bulk stress alone, of plane strain under a plane contact."""
    ν = float(opened.point.ask["poisson_ratio"])
    bulk = float(np.abs(opened.point.load["bulk_range"]).max())
    return bulk * float(np.sqrt(1.0 - ν + ν * ν)) if opened.point.profile["plane"] else bulk
