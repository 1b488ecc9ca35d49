"""What may be asked of a whole cycle: dissipated work, largest force ratio, radii."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.numerics.cosine import between
from swtstudy.mechanics.numerics.peaks import parabola
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.conjugate import Conjugate
from swtstudy.mechanics.stress.scene import Scene

#: Gauss nodes for each growth and interval, doubled until that changes the work by no more than this share of
#: it: at most 2e-6 of it is wrong then at 320 points, and as a rule nothing.
NODES, MOST_NODES, TOLERANCE = 16, 512, 1e-5
#: Least relative error of the work: tables of wavy profiles (1.6e-7 at 1 of 80 points); and rounding's share
#: of the way, along which works of either sign cancel.
LEAST_ERROR, ROUNDING = 2e-7, 1e-15
#: Cycles times intervals times pieces times nodes that are integrated together: some 100 MB.
LARGEST_SIZE = 2_000_000
#: Steps of each interval between which the largest force ratio is looked for, and into which those beside its
#: maximum are divided. Half of the former: 4e-5 at 300 points, 30 % faster; both as they are: 3e-6.
SAMPLES, CLOSE_SAMPLES = 32, 8
#: A maximum so far below the largest sample is not looked at again. The samples miss 1e-3 at most.
MARGIN = 0.01
#: A normal force below this share of the largest is none. 0, 1e-12 or 1e-6: no change at 305 points.
NO_CONTACT = 1e-9


def dissipated_work(scene: Scene, unit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Work by friction in a cycle, ∮ F_x du_x over μF_0 · μE* δ0/G*, F_0 the normal force at the depth δ0.

    Parameters
    ----------
    scene
        n points.
    unit
        Shape (n,), see `swtstudy.mechanics.control.force.unit_half_load`.

    Returns
    -------
    work, error
        Shape (n,): the work and its estimated absolute error.
    """
    conjugate = Conjugate.of(scene, unit, NODES)
    work, moved = _work(conjugate)
    error = np.zeros_like(work)
    rows, nodes = np.arange(len(work)), NODES
    while rows.size and nodes < MOST_NODES:
        nodes *= 2
        for some in _bounded(conjugate, rows, nodes):
            finer, _ = _work(conjugate.take(some, nodes))
            error[some], work[some] = np.abs(finer - work[some]), finer
        rows = rows[(error > TOLERANCE * work + ROUNDING * moved)[rows]]
    return np.maximum(work, 0.0), error + LEAST_ERROR * np.abs(work) + ROUNDING * moved


def _bounded(conjugate: Conjugate, rows: NDArray[np.intp], nodes: int) -> list[NDArray[np.intp]]:
    """The rows in groups of `LARGEST_SIZE`."""
    _, intervals, pieces = conjugate.cycle.memory.start.shape
    return np.array_split(rows, -(-len(rows) * intervals * pieces * nodes // LARGEST_SIZE))


def _work(conjugate: Conjugate) -> tuple[FloatArray, FloatArray]:
    """∮ F_x du_x, and the way of what is prescribed, each of shape (n,)."""
    cycle = conjugate.cycle
    # Dense at both ends of the intervals, where the front starts or arrives.
    node, weight = conjugate.rule()
    angle = 0.5 * np.pi * (1.0 + node)
    instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
    weight = 0.25 * np.pi * np.sin(angle) * weight * (cycle.end - cycle.begin)[..., None]
    moved = cycle.load.tangential_rate(instant) * weight
    share = 0.5 if cycle.load.mirrored_half else 1.0
    work = (conjugate.at(instant) * moved).sum(axis=(1, 2)) / share
    return (-work if conjugate.by_force else work), np.abs(moved).sum(axis=(1, 2)) / share


def largest_force_ratio(scene: Scene, unit: FloatArray) -> FloatArray:
    """Largest |F_x|/(μ F_N) while there is contact, shape (n,); parameters as of `dissipated_work`."""
    conjugate = Conjugate.of(scene, unit, NODES)
    least = NO_CONTACT * conjugate.normal_force(scene.cycle.load.largest_normal[:, None])[:, 0]
    angle = np.pi * np.arange(SAMPLES + 1) / SAMPLES
    ratio = _ratio(conjugate, angle, least)
    largest = ratio.max(axis=(1, 2))
    top, place = _peaks(ratio)
    row, interval = np.nonzero((top > largest[:, None] - MARGIN) & (largest[:, None] < 1.0))
    if row.size:
        step = np.pi / SAMPLES
        first = np.clip((place[row, interval] - 1.0) * step, 0.0, np.pi - 2.0 * step)
        angle = first[:, None, None] + 2.0 * step / CLOSE_SAMPLES * np.arange(CLOSE_SAMPLES + 1)
        top, _ = _peaks(_ratio(conjugate.take_intervals(row, interval), angle, least[row]))
        np.maximum.at(largest, row, top[:, 0])
    return np.minimum(largest, 1.0)


def _ratio(conjugate: Conjugate, angle: FloatArray, least: FloatArray) -> FloatArray:
    """|F_x|/(μ F_N) at angles of shape (…, k) in each interval, 0 without contact, shape (n, i, k)."""
    cycle = conjugate.cycle
    instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
    normal = conjugate.normal_force(np.maximum(cycle.load.normal(instant), 0.0))
    size = np.abs(cycle.load.tangential(instant) if conjugate.by_force else conjugate.at(instant))
    return np.divide(size, normal, out=np.zeros_like(size), where=normal > least[:, None, None])


def _peaks(ratio: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Largest values along the last axis, by parabolas through three samples, and their places in steps."""
    best = ratio.argmax(axis=-1)
    middle = np.clip(best, 1, ratio.shape[-1] - 2)
    left, top, right = (
        np.take_along_axis(ratio, (middle + shift)[..., None], axis=-1)[..., 0] for shift in (-1, 0, 1)
    )
    shift, rise = parabola(left, top, right)
    inside = middle == best
    place = best + np.where(inside, shift, 0.0)
    return np.where(inside, top + rise, np.maximum(left, right)), place


def permanent_stick_radius(scene: Scene, unit: FloatArray) -> FloatArray:
    """Radius in a_H inside of which springs never slip, NaN where there are none, shape (n,).

    Parameters as of `dissipated_work`.
    """
    stick = stick_coordinate(scene.cycle.load)
    radius = scene.coordinate.radius(np.maximum(stick, 0.0)[:, None])[:, 0]
    return np.where(stick >= 0.0, radius, np.nan)


def largest_contact_radius(scene: Scene, unit: FloatArray) -> FloatArray:
    """Largest contact radius in a_H, shape (n,); parameters as of `dissipated_work`."""
    return scene.coordinate.radius(np.maximum(scene.cycle.load.largest_normal, 0.0)[:, None])[:, 0]
