"""Climbing to the critical plane: Newton's method on the sphere for a product of two quadratic forms.

For a triple of instants (of the largest σ_n, the largest and the smallest ε_n) the parameter is h(n) = (nᵀ
A n)(nᵀ B n), or powers of both, with A a stress and B half a difference of strains, and swt(n) ≥ h(n) with
equality for the triple that is active at n. A step that raises h raises swt, whichever triple is active
afterwards.

On every history of discrete instants swt(n) is scalloped: neighbouring triples have summits of their own
close by. `swap_instants` looks from one summit to those that a change of one instant reaches.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from swtstudy.mechanics.planes import criterion
from swtstudy.mechanics.planes.criterion import Walker
from swtstudy.mechanics.points import FloatArray

#: Largest step of a climb, rad. Half or twice: 2e-16 in 16 values of bodies.
LARGEST_STEP = 0.2
#: Last step of a climb, rad: the height's relative error is its square. 1e-11 or 1e-7: 2e-16.
SMALLEST_STEP = 1e-9
#: Steps of a climb at most. Half or twice: no change in 16 values of bodies.
LARGEST_ITERATIONS = 40
#: Instants that may take the place of an active one. Half or twice: no change in 16 values of bodies.
RIVALS = 16

#: The parameter on one plane a row, (n,), and the stress and half the strain change of its triple, (n, 6).
ActiveForms = tuple[FloatArray, FloatArray, FloatArray]
#: Some rows, or all.
Rows = NDArray[np.intp] | slice


def normal_weights(normal: FloatArray) -> FloatArray:
    """Weights of the components xx, yy, zz, yz, xz, xy in nᵀ σ n, shape (..., 6), for normals (..., 3)."""
    return bilinear_weights(normal, normal)


def bilinear_weights(left: FloatArray, right: FloatArray) -> FloatArray:
    """Weights of the six components in lᵀ σ r, shape (..., 6), for vectors of shape (..., 3)."""
    lx, ly, lz = left[..., 0], left[..., 1], left[..., 2]
    rx, ry, rz = right[..., 0], right[..., 1], right[..., 2]
    weights = np.empty((*np.broadcast_shapes(lx.shape, rx.shape), 6))
    weights[..., 0], weights[..., 1], weights[..., 2] = lx * rx, ly * ry, lz * rz
    weights[..., 3], weights[..., 4] = ly * rz + lz * ry, lx * rz + lz * rx
    weights[..., 5] = lx * ry + ly * rx
    return weights


def symmetric_tensor(components: FloatArray) -> FloatArray:
    """Matrices of shape (..., 3, 3) from the components xx, yy, zz, yz, xz, xy."""
    return components[..., [[0, 5, 4], [5, 1, 3], [4, 3, 2]]]


def climb(
    stress: FloatArray,
    strain: FloatArray,
    start: FloatArray,
    walker: Walker | None = None,
    last_step: float = SMALLEST_STEP,
) -> tuple[FloatArray, FloatArray]:
    """Climb to a summit of swt(n) for each history.

    Parameters
    ----------
    stress, strain
        Shape (n, time, 6).
    start
        Shape (n, 3): unit normals.
    walker
        The criterion, shape (n,); None for swt.
    last_step
        Last step of a climb, rad: the height's relative error is its square.

    Returns
    -------
    swt, normal
        Shapes (n,), (n, 3).
    """

    def active(rows: Rows, normal: FloatArray, own: Walker | None) -> ActiveForms:
        return _active_forms(stress[rows], strain[rows], normal, own)

    return climb_by(active, start, walker, last_step)


def climb_by(
    active: Callable[[Rows, FloatArray, Walker | None], ActiveForms],
    start: FloatArray,
    walker: Walker | None,
    last_step: float,
) -> tuple[FloatArray, FloatArray]:
    """`climb` with what is active on a plane each of some rows given by a function."""
    normal = start.copy()
    swt, tension, elongation = active(slice(None), normal, walker)
    trust = np.full(len(normal), LARGEST_STEP)
    going = np.flatnonzero(swt > 0.0)
    for _ in range(LARGEST_ITERATIONS):
        if not len(going):
            break
        here, own = normal[going], walker and walker.take(going)
        tangent = _tangent_basis(here)
        jets = _jet_weights(here, tangent)
        forms = _apply(jets, tension[going]), _apply(jets, elongation[going])
        step, _ = _newton_step(*forms, trust[going], own)
        trial = _move(here, tangent, step)
        value, new_tension, new_elongation = active(going, trial, own)
        up = value > swt[going]
        moved = going[up]
        swt[moved], normal[moved] = value[up], trial[up]
        tension[moved], elongation[moved] = new_tension[up], new_elongation[up]
        trust[going[~up]] = 0.25 * np.linalg.norm(step[~up], axis=-1)
        going = going[np.minimum(np.linalg.norm(step, axis=-1), trust[going]) > last_step]
    return swt, normal


def swap_instants(
    stress: FloatArray, strain: FloatArray, normal: FloatArray, walker: Walker | None = None
) -> FloatArray:
    """From each summit, the normal at which some other triple promises to be higher.

    Parameters
    ----------
    stress, strain
        Shape (n, time, 6).
    normal
        Shape (n, 3): summits for their active triples, with swt > 0.
    walker
        The criterion, shape (n,); None for swt.

    Returns
    -------
    start
        Shape (n, 3): where the quadratic model of ln h, for the triple that differs in one instant and
        promises most, has its summit.
    """
    tangent = _tangent_basis(normal)
    jets = _jet_weights(normal, tangent)[:, None]
    tension, elongation = _apply(jets, stress), _apply(jets, strain)
    # The active instants first, then their rivals.
    top, high, low = _ranked(tension), _ranked(elongation), _ranked(-elongation)
    low *= -1.0
    same = np.zeros_like(top)
    forms = np.concatenate([top, same + top[:, :1], same + top[:, :1]], axis=1)
    changes = 0.5 * np.concatenate(
        [same + high[:, :1] - low[:, :1], high - low[:, :1], high[:, :1] - low], axis=1
    )
    possible = (forms[..., 0] > 0.0) & (changes[..., 0] > 0.0)
    possible[:, :: top.shape[1]] = False
    forms[~possible] = changes[~possible] = 1.0
    of_all = walker and walker.take(np.repeat(np.arange(len(normal)), possible.shape[1]))
    steps, gain = _newton_step(
        forms.reshape(-1, 6), changes.reshape(-1, 6), np.full(possible.size, LARGEST_STEP), of_all
    )
    value = criterion.combined(forms[..., 0], changes[..., 0], of_all and of_all.reshape(*possible.shape))
    height = np.log(value) + gain.reshape(possible.shape)
    best = np.where(possible, height, -np.inf).argmax(axis=1)
    return _move(normal, tangent, steps.reshape(*possible.shape, 2)[np.arange(len(normal)), best])


def _ranked(jets: FloatArray) -> FloatArray:
    """The jets of the highest values in time, highest first, shape (n, rivals, 6)."""
    value = jets[..., 0]
    if value.shape[1] > RIVALS:
        highest = np.argpartition(-value, RIVALS, axis=1)[:, :RIVALS]
    else:
        highest = np.broadcast_to(np.arange(value.shape[1]), value.shape)
    row = np.arange(len(jets))[:, None]
    order = np.argsort(-value[row, highest], axis=1, kind="stable")
    return jets[row, np.take_along_axis(highest, order, axis=1)]


def _active_forms(
    stress: FloatArray, strain: FloatArray, normal: FloatArray, walker: Walker | None
) -> ActiveForms:
    """The parameter on one plane per history, with the stress and half the strain change of its triple.

    Returns
    -------
    swt, tension, elongation
        Shapes (n,), (n, 6), (n, 6).
    """
    weights = normal_weights(normal)[:, :, None]
    tension = (stress @ weights)[..., 0]
    elongation = (strain @ weights)[..., 0]
    row = np.arange(len(stress))
    top, high, low = tension.argmax(axis=1), elongation.argmax(axis=1), elongation.argmin(axis=1)
    swt = criterion.of_maxima(tension[row, top], elongation[row, high], -elongation[row, low], walker=walker)
    return swt, stress[row, top], 0.5 * (strain[row, high] - strain[row, low])


def _newton_step(
    first: FloatArray, second: FloatArray, trust: FloatArray, walker: Walker | None
) -> tuple[FloatArray, FloatArray]:
    """Step to the summit of ln swt within the trust region, and the gain that the model promises.

    Parameters
    ----------
    first, second
        Shape (n, 6): jets of the tension and of the amplitude, both positive.
    trust
        Shape (n,): largest length of the step, rad.
    walker
        The criterion, shape (n,); None for swt.

    Returns
    -------
    step, gain
        Shapes (n, 2) and (n,).
    """
    slope, stiffness = criterion.log_derivatives(first, second, walker)
    slope_1, slope_2 = slope.T
    # Positive definite on a summit.
    stiff_11, stiff_22, stiff_12 = stiffness.T
    # Where the function is not concave, raise the stiffness until it is, and the step no longer than allowed.
    mean, difference = 0.5 * (stiff_11 + stiff_22), 0.5 * (stiff_11 - stiff_22)
    softest = mean - np.hypot(difference, stiff_12)
    length = np.hypot(slope_1, slope_2)
    shift = np.maximum(np.maximum(length / trust, 1e-12) - softest, 0.0)
    concave = softest > 1e-12
    determinant = np.where(concave, stiff_11 * stiff_22 - stiff_12**2, 1.0)
    newton = np.hypot(stiff_22 * slope_1 - stiff_12 * slope_2, stiff_11 * slope_2 - stiff_12 * slope_1)
    shift[concave & (newton <= trust * determinant)] = 0.0
    stiff_11, stiff_22 = stiff_11 + shift, stiff_22 + shift
    determinant = stiff_11 * stiff_22 - stiff_12**2
    step = (
        np.stack([stiff_22 * slope_1 - stiff_12 * slope_2, stiff_11 * slope_2 - stiff_12 * slope_1], axis=-1)
        / determinant[:, None]
    )
    gain = 0.5 * (step[:, 0] * slope_1 + step[:, 1] * slope_2)
    return step, gain


def _jet_weights(normal: FloatArray, tangent: FloatArray) -> FloatArray:
    """Weights of the six components in nᵀ σ n and its derivatives along great circles, shape (n, 6, 6).

    The columns: value; first derivatives along the two tangents; second derivatives 11, 22, 12.
    """
    first, second = tangent[:, 0], tangent[:, 1]
    value = normal_weights(normal)
    return np.stack(
        [
            value,
            2.0 * bilinear_weights(normal, first),
            2.0 * bilinear_weights(normal, second),
            2.0 * (normal_weights(first) - value),
            2.0 * (normal_weights(second) - value),
            2.0 * bilinear_weights(first, second),
        ],
        axis=-1,
    )


def _apply(jets: FloatArray, components: FloatArray) -> FloatArray:
    """Contract the last axis of the components with the jets' weights."""
    if components.ndim == 2:
        return (components[:, None, :] @ jets)[:, 0]
    return components @ jets[:, 0]


def _move(normal: FloatArray, tangent: FloatArray, step: FloatArray) -> FloatArray:
    """The unit normal a small step away in the tangent plane."""
    moved = normal + (step[:, :, None] * tangent).sum(axis=1)
    return moved / np.linalg.norm(moved, axis=-1, keepdims=True)


def _tangent_basis(normal: FloatArray) -> FloatArray:
    """Two unit vectors normal to each normal and to one another, shape (n, 2, 3)."""
    least = np.argmin(np.abs(normal), axis=-1)
    first = _cross(normal, np.eye(3)[least])
    first /= np.linalg.norm(first, axis=-1, keepdims=True)
    return np.stack([first, _cross(normal, first)], axis=1)


def _cross(left: FloatArray, right: FloatArray) -> FloatArray:
    """``np.cross`` of vectors of shape (n, 3), several times as fast."""
    (a, b, c), (d, e, f) = left.T, right.T
    return np.stack([b * f - c * e, c * d - a * f, a * e - b * d], axis=-1)
