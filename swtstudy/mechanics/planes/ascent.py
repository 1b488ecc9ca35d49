"""Climbing to the critical plane: Newton's method on the sphere for a criterion of one triple of instants.

For a triple of instants (of the largest tension, the largest and the smallest swing) swt, for instance, is
h(n) = (nᵀ A n)(nᵀ B n), with A a stress and B half a difference of strains. What the criterion says of all
instants is at least that, with equality for the triple that is active at n. A step that raises h raises it,
whichever triple is active afterwards.

On every history of discrete instants it is scalloped: neighbouring triples have summits of their own close
by. `swap_instants` looks from one summit to those that a change of one instant reaches.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from swtstudy.mechanics.numerics.arrays import ROUNDING, SAME
from swtstudy.mechanics.numerics.roots import MOST_STEPS
from swtstudy.mechanics.planes.criterion import Criterion
from swtstudy.mechanics.planes.weights import apply_jets, jet_weights, normal_weights, tangent_basis
from swtstudy.mechanics.points import FloatArray, IndexArray

#: Largest step of a climb, rad. Half or twice: 2e-16 in 16 values of bodies.
LARGEST_STEP = 0.2
#: The same where it only says where to look next. 1e-9: twice the steps.
ROUGH_STEP = 3e-3
#: Instants that may take the place of an active one. Half or twice: no change in 16 values of bodies.
RIVALS = 16

#: The value on one plane a row, (n,), and of its triple the stress and half the change of the tensor, (n, 6).
ActiveForms = tuple[FloatArray, FloatArray, FloatArray]
#: Some rows, or all.
Rows = IndexArray | slice


def climb(
    stress: FloatArray, tensor: FloatArray, start: FloatArray, criterion: Criterion, last_step: float = SAME
) -> tuple[FloatArray, FloatArray]:
    """Climb to a summit over the planes for each history.

    Parameters
    ----------
    stress, tensor
        Shape (n, time, 6): stress, and the tensor of the swing.
    start
        Shape (n, 3): unit normals.
    criterion
        Shape (n,).
    last_step
        Last step of a climb, rad: the height's relative error is its square.

    Returns
    -------
    value, normal
        Shapes (n,), (n, 3).
    """

    def active(rows: Rows, normal: FloatArray, own: Criterion) -> ActiveForms:
        return _active_forms(stress[rows], tensor[rows], normal, own)

    return climb_by(active, start, criterion, last_step)


def climb_by(
    active: Callable[[Rows, FloatArray, Criterion], ActiveForms],
    start: FloatArray,
    criterion: Criterion,
    last_step: float,
) -> tuple[FloatArray, FloatArray]:
    """`climb` with what is active on a plane each of some rows given by a function."""
    normal = start.copy()
    height, tension, change = active(slice(None), normal, criterion)
    trust = np.full(len(normal), LARGEST_STEP)
    going = np.flatnonzero(height > 0.0)
    for _ in range(MOST_STEPS):
        if not len(going):
            break
        here, own = normal[going], criterion.take(going)
        tangent = tangent_basis(here)
        jets = jet_weights(here, tangent)
        forms = apply_jets(jets, tension[going]), own.swing.amplitude_jets(jets, change[going])
        step, _ = _newton_step(*forms, trust[going], own)
        trial = _move(here, tangent, step)
        value, new_tension, new_change = active(going, trial, own)
        up = value > height[going]
        moved = going[up]
        height[moved], normal[moved] = value[up], trial[up]
        tension[moved], change[moved] = new_tension[up], new_change[up]
        trust[going[~up]] = 0.25 * np.linalg.norm(step[~up], axis=-1)
        going = going[np.minimum(np.linalg.norm(step, axis=-1), trust[going]) > last_step]
    return height, normal


def swap_instants(
    stress: FloatArray, tensor: FloatArray, normal: FloatArray, criterion: Criterion
) -> FloatArray:
    """From each summit, the normal at which some other triple promises to be higher.

    Parameters
    ----------
    stress, tensor
        Shape (n, time, 6): stress, and the tensor of the swing.
    normal
        Shape (n, 3): summits for their active triples, with values above 0.
    criterion
        Shape (n,).

    Returns
    -------
    start
        Shape (n, 3): where the quadratic model of ln h, for the triple that differs in one instant and
        promises most, has its summit.
    """
    tangent = tangent_basis(normal)
    jets = jet_weights(normal, tangent)
    tension, swing = apply_jets(jets, stress), criterion.swing.curve_jets(jets, normal, tangent, tensor)
    # The active instants first, then their rivals.
    top, high, low = _ranked(tension), _ranked(swing), _ranked(-swing)
    low *= -1.0
    same = np.zeros_like(top)
    forms = np.concatenate([top, same + top[:, :1], same + top[:, :1]], axis=1)
    changes = 0.5 * np.concatenate(
        [same + high[:, :1] - low[:, :1], high - low[:, :1], high[:, :1] - low], axis=1
    )
    of_all = criterion.take(np.repeat(np.arange(len(normal)), forms.shape[1]))
    value = of_all.value(forms[..., 0].ravel(), changes[..., 0].ravel()).reshape(forms.shape[:2])
    possible = (value > 0.0) & (changes[..., 0] > 0.0)
    possible[:, :: top.shape[1]] = False
    forms[~possible] = changes[~possible] = 1.0
    trust = np.full(possible.size, LARGEST_STEP)
    steps, gain = _newton_step(forms.reshape(-1, 6), changes.reshape(-1, 6), trust, of_all)
    height = np.log(np.where(possible, value, 1.0)) + gain.reshape(possible.shape)
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
    stress: FloatArray, tensor: FloatArray, normal: FloatArray, criterion: Criterion
) -> ActiveForms:
    """The value on one plane per history, with the stress and half the change of the tensor of its triple.

    Returns
    -------
    value, tension, change
        Shapes (n,), (n, 6), (n, 6).
    """
    tension = (stress @ normal_weights(normal)[:, :, None])[..., 0]
    swing = criterion.swing.on_plane(tensor, normal)
    row = np.arange(len(stress))
    top, high, low = tension.argmax(axis=1), swing.argmax(axis=1), swing.argmin(axis=1)
    value = criterion.of_maxima(tension[row, top], swing[row, high], -swing[row, low])
    return value, stress[row, top], 0.5 * (tensor[row, high] - tensor[row, low])


def _newton_step(
    first: FloatArray, second: FloatArray, trust: FloatArray, criterion: Criterion
) -> tuple[FloatArray, FloatArray]:
    """Step to the summit of the logarithm within the trust region, and the gain that the model promises.

    Parameters
    ----------
    first, second
        Shape (n, 6): jets of the tension and of the amplitude.
    trust
        Shape (n,): largest length of the step, rad.
    criterion
        Shape (n,).

    Returns
    -------
    step, gain
        Shapes (n, 2) and (n,).
    """
    slope, stiffness = criterion.log_derivatives(first, second)
    slope_1, slope_2 = slope.T
    # Positive definite on a summit.
    stiff_11, stiff_22, stiff_12 = stiffness.T
    # Where the function is not concave, raise the stiffness until it is, and the step no longer than allowed.
    mean, difference = 0.5 * (stiff_11 + stiff_22), 0.5 * (stiff_11 - stiff_22)
    softest = mean - np.hypot(difference, stiff_12)
    length = np.hypot(slope_1, slope_2)
    shift = np.maximum(np.maximum(length / trust, ROUNDING) - softest, 0.0)
    concave = softest > ROUNDING
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


def _move(normal: FloatArray, tangent: FloatArray, step: FloatArray) -> FloatArray:
    """The unit normal a small step away in the tangent plane."""
    moved = normal + (step[:, :, None] * tangent).sum(axis=1)
    return moved / np.linalg.norm(moved, axis=-1, keepdims=True)
