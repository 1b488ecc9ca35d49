"""The largest von Mises stress over the cycle and over the body, to about 1 %: does it yield?

Where it is depends on friction, on the load and on the bulk stress: beneath the middle, at an edge or a
slip front, in between, or across the direction of sliding. So a mesh of the body is looked at, and from its
highest places a search goes uphill in ever smaller steps. In the surface the stress has cusps where edges
and fronts are: these are places of the mesh themselves.
"""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.body.body import SUBDIVISIONS, Body, TimeNodes, nodes_at, time_nodes
from swtstudy.mechanics.numerics.arrays import TINY_ROOT
from swtstudy.mechanics.points import FloatArray, IndexArray
from swtstudy.mechanics.stress.scene import Scene

#: Steps of each stretch of the cycle, and cells of a slope that is bent.
STEPS, CELLS = 3, 24
#: Distances from the axis and depths of the mesh over the largest contact radius, and angles from x. Outside
#: of the contact only a bulk stress is left.
RADII, DEPTHS, ANGLES = np.linspace(0.0, 1.2, 9), np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.8]), 5
#: Distances from the edge of a wide face and depths beneath, over the width of the ring beside it. Without:
#: 30 % low beneath a face 500 times as wide (tests/mechanics/test_von_mises.py).
BESIDE_FACE, BENEATH_EDGE = np.linspace(-2.0, 1.2, 9), np.array([0.0, 0.05, 0.15, 0.3, 0.5, 0.8, 1.5, 3.0])
#: Digits of the pressure at a tip; of power laws below n = 1.3 no mesh comes near to it
#: (tests/mechanics/test_von_mises.py).
TIP_DIGITS = 6.0
#: Instants of a long cycle that are looked at first.
MOST_INSTANTS = 128
#: Distances in each wave of a profile, and at most so many over the contact.
IN_A_WAVE, MOST_RADII = 6, 240
#: From how many of the highest places, how far apart and in which first steps, over the radius; how often a
#: step is tried, and halved where nothing is higher.
CLIMBS, APART, FIRST_STEP, TRIES = 4, 0.15, 0.1, 6


def von_mises(stress: FloatArray) -> FloatArray:
    """Von Mises stress of stresses of shape (…, 6), as of `Body.stress`."""
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.asarray(np.sqrt(0.5 * normal + 3.0 * (yz**2 + xz**2 + xy**2)))


def largest_von_mises(scene: Scene, unit: FloatArray) -> FloatArray:
    """The largest von Mises stress over cycle and body in E* √(δ0/R), to about 1 %, shape (n,).

    inf at the edge of a truncated paraboloid's face, at which the pressure is infinite.
    """
    return np.array([_of_one(scene.take(np.array([k]))) for k in range(len(scene))])


def _of_one(scene: Scene) -> float:
    profile, reach = scene.profile, float(scene.largest_radius[0])
    if profile.has_singular_edge and profile.flat_radius[0] > 0.0:
        return np.inf
    nodes, some = _instants(scene)
    surface = _passed(scene, some)
    ring = reach - float(profile.flat_radius[0])
    beside = _beside_face(scene, ring) if ring < 0.5 * reach else np.zeros((3, 0))
    place = np.concatenate([beside, _mesh(scene, reach), surface], axis=1)
    history = von_mises(Body(scene, some, CELLS).stress(*place))
    largest = history.max(axis=-1)
    starts = np.array(_highest(place, largest, APART * reach))
    instants = history[starts].argmax(axis=-1)
    step = FIRST_STEP * np.minimum(
        np.where(starts < beside.shape[1], ring, reach), float(profile.feature_length[0])
    )
    top = _climb(Body(scene, _around(scene, nodes, some, instants), CELLS), place[:, starts], step)
    # A cusp moves with its edge or front while the load changes: no step follows it.
    closer = _around(scene, nodes, some, instants[:1])
    moving = von_mises(Body(scene, closer, CELLS).stress(*_passed(scene, closer)))
    return max(top, float(largest.max()), float(moving.max()), _at_tip(scene), _far_away(scene))


def _instants(scene: Scene) -> tuple[TimeNodes, TimeNodes]:
    """All instants, and those looked at first: of a long cycle some, the load's extremes among them."""
    nodes = time_nodes(scene, STEPS if scene.cycle.end.shape[1] <= MOST_INSTANTS else 1)
    if scene.mirrored_half:  # the other half of the cycle is that of the other side
        nodes = nodes.take(nodes.instant <= np.pi)
    every = np.arange(nodes.instant.size)
    if every.size <= MOST_INSTANTS:
        return nodes, nodes
    normal, tangential = (
        of(nodes.instant[None])[0] for of in (scene.cycle.load.normal, scene.cycle.load.tangential)
    )
    courses = [normal, tangential, normal + tangential, normal - tangential]
    if scene.bulk is not None:
        courses.append(scene.bulk.at(nodes.instant[None])[0])
    ends = [find(course) for course in courses for find in (np.argmin, np.argmax)]
    return nodes, nodes.take(np.union1d(every[:: -(-every.size // MOST_INSTANTS)], ends))


def _mesh(scene: Scene, reach: float) -> FloatArray:
    """Places x, y, z in a_H all over the body, shape (3, m); nothing is different at −y."""
    waves = min(IN_A_WAVE * reach / float(scene.profile.feature_length[0]), MOST_RADII)
    radii = RADII if waves < len(RADII) else np.linspace(0.0, RADII[-1], int(waves))
    return _around_axis(scene, reach * radii, reach * DEPTHS)


def _beside_face(scene: Scene, ring: float) -> FloatArray:
    """Places about the edge of a face that is much wider than the ring of contact beside it, shape (3, m)."""
    radii = float(scene.profile.flat_radius[0]) + ring * BESIDE_FACE
    return _around_axis(scene, radii, ring * BENEATH_EDGE)


def _passed(scene: Scene, nodes: TimeNodes) -> FloatArray:
    """Places of the surface at which the edge and the front are at some instants, and where slopes turn."""
    states = scene.cycle.states(nodes.interval[None], nodes.instant[None])
    passed = scene.coordinate.radius(np.maximum(np.stack([states.edge, states.front]), 0.0).reshape(1, -1))[0]
    own = scene.profile
    return _around_axis(
        scene, np.unique(np.concatenate([passed, own.landmarks[0], own.flat_radius])), np.zeros(1)
    )


def _around_axis(scene: Scene, radius: FloatArray, depth: FloatArray) -> FloatArray:
    """Places at all angles that matter, shape (3, m)."""
    angle = np.linspace(0.0, np.pi, 2 if scene.profile.plane else ANGLES)
    r, θ, z = (each.ravel() for each in np.meshgrid(radius, angle, depth, indexing="ij"))
    # Exactly on the line: rounding would leave a y there.
    return np.stack([r * np.cos(θ), np.where(θ == np.pi, 0.0, r * np.sin(θ)), z])


def _highest(place: FloatArray, largest: FloatArray, apart: float) -> list[int]:
    """Numbers of the highest places, so far apart."""
    found: list[int] = []
    left = largest.copy()
    while len(found) < CLIMBS and np.isfinite(left).any():
        best = int(np.where(np.isfinite(left), left, -np.inf).argmax())
        found.append(best)
        left[np.linalg.norm(place - place[:, best : best + 1], axis=0) <= apart] = -np.inf
    return found


def _around(scene: Scene, nodes: TimeNodes, some: TimeNodes, number: IndexArray) -> TimeNodes:
    """Instants between those of numbers among some and their neighbours: all there are, and others."""
    near = np.unique(np.concatenate([number - 1, number]))
    near = near[(near >= 0) & (near < len(some.instant) - 1)]
    low, high = some.instant[near], some.instant[near + 1]
    gap = np.searchsorted(low, nodes.instant, "right") - 1
    between = nodes.instant[(gap >= 0) & (nodes.instant <= high[gap])]
    if len(some.instant) < len(nodes.instant):
        return nodes_at(scene, between)
    share = np.arange(1, SUBDIVISIONS) / SUBDIVISIONS
    return nodes_at(scene, np.union1d(between, low[:, None] + (high - low)[:, None] * share))


def _climb(body: Body, place: FloatArray, steps: FloatArray) -> float:
    """The highest value that steps uphill from places of shape (3, k) lead to, of shape (k,) at first."""
    across = [0.0] if body.scene.profile.plane else [-1.0, 0.0, 1.0]
    ways = np.stack(np.meshgrid([-1.0, 0.0, 1.0], across, [-1.0, 0.0, 1.0], indexing="ij")).reshape(3, -1)
    stays = ways.shape[1] // 2
    top = -np.inf
    for _ in range(TRIES):
        tried = place[:, :, None] + steps[:, None] * ways[:, None]
        tried[1:] = np.abs(tried[1:])  # the other half is a mirror image, and there is nothing above
        values = von_mises(body.stress(*tried)).max(axis=-1)
        best = values.argmax(axis=1)
        top = max(top, float(values.max()))
        steps = np.where(values.max(axis=1) <= values[:, stays], 0.5 * steps, steps)
        place = np.take_along_axis(tried, best[None, :, None], axis=2)[..., 0]
    return top


def _at_tip(scene: Scene) -> float:
    """Von Mises stress of the largest pressure alone in the middle of the surface, where a sharp tip has it.

    There the stresses along the surface are (½ + ν) p, and under a strip p and 2ν p.
    """
    profile, ν = scene.profile, float(scene.poisson_ratio[0])
    edge = scene.largest_radius[:, None]
    pressure = profile.primitives(TINY_ROOT * edge, TIP_DIGITS).pressure(edge[:, :, None])
    return float(pressure.max()) / np.pi * (1.0 - 2.0 * ν if profile.plane else 0.5 - ν)


def _far_away(scene: Scene) -> float:
    """Von Mises stress of the bulk stress alone, of plane strain under a plane contact."""
    if scene.bulk is None:
        return 0.0
    stress = np.zeros((2, 6))
    stress[:, 0] = scene.bulk.least[0], scene.bulk.largest[0]
    if scene.profile.plane:
        stress[:, 1] = scene.poisson_ratio[0] * stress[:, 0]
    return float(von_mises(stress).max())
