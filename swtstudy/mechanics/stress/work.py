"""Quantities of a whole cycle: dissipated work, largest force ratio, radii."""

from __future__ import annotations

import numpy as np

from swtstudy.mechanics.contact.stick_zone import stick_coordinate
from swtstudy.mechanics.numerics.cosine import between
from swtstudy.mechanics.numerics.peaks import parabola
from swtstudy.mechanics.points import FloatArray
from swtstudy.mechanics.stress.conjugate import Conjugate
from swtstudy.mechanics.stress.scene import Scene

#: Gauss nodes for each growth and interval, doubled until the error claimed is no more than this share of the
#: work: at most 2e-6 of it is wrong then at 320 points, and as a rule nothing.
NODES, MOST_NODES, TOLERANCE = 16, 512, 1e-5
#: The error claimed, over the last change: 1 is too little at 2 of 320 points all over the ranges, by 5.
OF_CHANGE = 6.0
#: Least relative error of the work: tables of wavy profiles (1.6e-7 at 1 of 80 points); and rounding's share
#: of the way, along which works of either sign cancel.
LEAST_ERROR, ROUNDING = 2e-7, 1e-15
#: Steps of each interval between which the largest force ratio is looked for, and into which those beside its
#: maximum are divided. Half of the former: 4e-5 at 300 points, 30 % faster; both as they are: 3e-6.
SAMPLES, CLOSE_SAMPLES = 32, 8
#: A maximum so far below the largest sample is not looked at again. The samples miss 1e-3 at most.
MARGIN = 0.01
#: A normal force below this share of the largest is none. 0, 1e-12 or 1e-6: no change at 305 points.
NO_CONTACT = 1e-9


def dissipated_work(scene: Scene, unit: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Work by friction in a cycle, ∮ F_x du_x over μF_0 · μE* δ0/G*, F_0 the normal force at the depth δ0.

    In the plane per length, over μP_0 · μδ0.

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
        finer, _ = _work(conjugate.take(rows, nodes))
        error[rows], work[rows] = OF_CHANGE * np.abs(finer - work[rows]), finer
        rows = rows[(error > TOLERANCE * work + ROUNDING * moved)[rows]]
    return np.maximum(work, 0.0), error + LEAST_ERROR * np.abs(work) + ROUNDING * moved


def _work(conjugate: Conjugate) -> tuple[FloatArray, FloatArray]:
    """∮ F_x du_x, and the way of what is prescribed, each of shape (n,)."""
    # Dense at both ends of the intervals, where the front starts or arrives.
    node, weight = conjugate.rule()
    angle = 0.5 * np.pi * (1.0 + node)
    weight = 0.25 * np.pi * np.sin(angle) * weight
    work, way = np.zeros((2, len(conjugate.unit)))
    for part in conjugate.parts(len(node)):
        cycle = part.cycle
        instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
        moved = cycle.load.tangential_rate(instant) * weight * (cycle.end - cycle.begin)[..., None]
        work += (part.at(instant) * moved).sum(axis=(1, 2))
        way += np.abs(moved).sum(axis=(1, 2))
    share = 0.5 if conjugate.cycle.load.mirrored_half else 1.0
    return (-work if conjugate.by_force else work) / share, way / share


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
    found = []
    for part in conjugate.parts(angle.shape[-1]):
        cycle = part.cycle
        instant = between(cycle.begin[..., None], cycle.end[..., None], angle)
        normal = part.normal_force(np.maximum(cycle.load.normal(instant), 0.0))
        size = np.abs(cycle.load.tangential(instant) if part.by_force else part.at(instant))
        found.append(np.divide(size, normal, out=np.zeros_like(size), where=normal > least[:, None, None]))
    return np.concatenate(found, axis=1)


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
