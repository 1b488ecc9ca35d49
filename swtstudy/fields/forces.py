"""Forces and displacements over the cycle, whichever of them are prescribed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.body.body import TimeNodes
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.conjugate import LARGEST_SIZE, Conjugate
from swtstudy.mechanics.stress.scene import Scene

#: Gauss nodes for each growth of the memory: 1e-6 of the amplitude and better.
NODES = 64


@dataclass(frozen=True)
class Course:
    """Both components of load and answer at T instants, each of shape (T,).

    Attributes
    ----------
    depth, displacement
        δ/δ0 and G* u/(μ E* δ0); NaN in the plane, where only their changes at constant load are known.
    normal_force, tangential_force
        F_N/F_0 and F_x/(μ F_0).
    """

    depth: FloatArray
    displacement: FloatArray
    normal_force: FloatArray
    tangential_force: FloatArray


def course(scene: Scene, unit: FloatArray, nodes: TimeNodes) -> Course:
    """The prescribed loads and the responses over the cycle.

    Parameters
    ----------
    scene
        A batch of one point.
    unit
        Shape (1,), see `swtstudy.mechanics.control.force.unit_half_load`.
    nodes
        T instants of its cycle.
    """
    load, whole = scene.cycle.load, Conjugate.whole(scene, unit, NODES)
    normal, tangential = (f(nodes.instant[None])[0] for f in (load.normal, load.tangential))
    if scene.profile.plane:
        unknown = np.full_like(normal, np.nan)
        return Course(unknown, unknown, normal, tangential)
    other_normal = whole.other.of(scene.coordinate.radius(np.maximum(normal, 0.0)[None]))[0]
    size = max(1, LARGEST_SIZE // (scene.cycle.memory.start.shape[2] * NODES))
    answer = np.empty_like(tangential)
    for first in range(0, answer.size, size):
        part = slice(first, first + size)
        answer[part] = of_instants(whole, nodes.interval[part]).at(nodes.instant[part, None, None])[:, 0, 0]
    if whole.by_force:
        return Course(other_normal, answer, normal, tangential)
    return Course(normal, tangential, other_normal, answer)


def of_instants(whole: Conjugate, interval: NDArray[np.intp]) -> Conjugate:
    """That of one cycle at T instants, as T cycles of one interval each."""
    return whole.take_intervals(np.zeros(len(interval), dtype=np.intp), interval)
