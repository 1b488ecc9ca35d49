"""Criteria of a user's own stress history, with every mistake in it reported."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.mechanics.planes import all_planes
from swtstudy.mechanics.planes.all_planes import CriticalPlane, crossland
from swtstudy.mechanics.planes.criterion import SWT_EXPONENT, FatemiSocie, Findley, Swt
from swtstudy.mechanics.points import FloatArray
from swtstudy.vocabulary.definition import read_numbers
from swtstudy.vocabulary.mistakes import Report, literal, nearest, plain_number
from swtstudy.vocabulary.parameters import PARAMETERS

#: What has no plane, and the criteria of shear.
CROSSLAND = "crossland"
_OF_SHEAR = {each.name: each for each in (FatemiSocie, Findley)}
_KNOWN = (*_OF_SHEAR, CROSSLAND)


def swt_of_history(
    stress: ArrayLike, poisson_ratio: float, young_modulus: float = 1.0, walker_exponent: float = SWT_EXPONENT
) -> CriticalPlane:
    """Largest Smith–Watson–Topper parameter over all planes (eq. 9).

    Parameters
    ----------
    stress
        Shape (..., time, 6): one cycle, components xx, yy, zz, yz, xz, xy; tension positive.
    poisson_ratio, young_modulus
        ν and E of Hooke's law. In this package's units (stress in E* √(δ0/R), s = swt/(E* δ0/R)) the half-
        space has E = 1 − ν².
    walker_exponent
        γ in (0, 0.9] of σ_n^(2 − 2γ) (E ε_n)^(2γ)/E, of largest σ_n and amplitude of ε_n; 1/2 is swt.

    Returns
    -------
    CriticalPlane
        ``swt`` of shape (...), in the unit of stress²/modulus, and the unit ``normal`` of shape (..., 3).

    Raises
    ------
    StudyError
        A ValueError with every mistake in the input. NaN or a masked component is a mistake: a history has no
        gaps.

    Examples
    --------
    Uniaxial tension from 0 to 1 along x, E = 1: σ_max = 1, Δε/2 = 1/2.

    >>> swt, normal = swt_of_history([[0, 0, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0]], poisson_ratio=0.3)
    >>> float(swt), abs(normal).round(6).tolist()
    (0.5, [1.0, 0.0, 0.0])
    """
    history, report = _checked(stress, poisson_ratio, young_modulus)
    row = PARAMETERS["walker_exponent"]
    if not row.lower < plain_number(walker_exponent) <= row.upper:
        report(row.name, literal(walker_exponent), row.allowed)
    report.refuse()
    ν, E, γ = map(plain_number, (poisson_ratio, young_modulus, walker_exponent))
    return all_planes.swt_of_history(history, ν, E, Swt.of(np.full(1, γ), np.full(1, E)))


def criterion_of_history(
    stress: ArrayLike, criterion: str, normal_sensitivity: float
) -> tuple[FloatArray, FloatArray]:
    """Largest value over all planes of a criterion of shear, or Crossland's, which has no plane.

    Parameters
    ----------
    stress
        Shape (..., time, 6): one cycle, components xx, yy, zz, yz, xz, xy; tension positive.
    criterion
        "fatemi_socie", γ_a G (1 + κ σ_n⁺), where γ_a G is the amplitude of the shear stress; "findley", that
        amplitude + k max σ_n; or "crossland", √J2,a + α max σ_H. `swt_of_history` is the other one.
    normal_sensitivity
        κ = k/σ_y over the unit of stress (the parameter as a strain is the value over G); k; or α.

    Returns
    -------
    value
        Shape (...), in the unit of stress.
    normal
        Shape (..., 3): unit normals of the planes, NaN for Crossland's.

    Raises
    ------
    StudyError
        A ValueError with every mistake in the input.

    Notes
    -----
    On a plane the amplitude is half of the largest chord of the path of its shear stress: of a path that is
    not along a line others take more, such as the radius of the smallest circle around it. √J2,a is the
    radius of the smallest sphere around the path of the deviator s, in the norm √(s:s/2).

    Examples
    --------
    Uniaxial stress of swing ±1: Findley's is ½ [k + √(1 + k²)].

    >>> wave = [[1, 0, 0, 0, 0, 0], [-1, 0, 0, 0, 0, 0]]
    >>> value, _ = criterion_of_history(wave, "findley", 0.3)
    >>> round(float(value), 6)
    0.672015
    >>> round(float(criterion_of_history(wave, "crossland", 0.3)[0]), 6)
    0.67735
    """
    history, report = _checked(stress, 0.3, 1.0)
    if criterion not in _KNOWN:
        report("criterion", literal(criterion), nearest(str(criterion), _KNOWN))
    if not 0.0 <= plain_number(normal_sensitivity) < math.inf:
        report("normal_sensitivity", literal(normal_sensitivity), "a number ≥ 0")
    report.refuse()
    sensitivity = plain_number(normal_sensitivity)
    if criterion == CROSSLAND:
        value = crossland(history, sensitivity)
        return value, np.full((*value.shape, 3), np.nan)
    found = all_planes.swt_of_history(history, 0.3, 1.0, _OF_SHEAR[criterion](np.full(1, sensitivity)))
    return found.swt, found.normal


def _checked(stress: ArrayLike, poisson_ratio: float, young_modulus: float) -> tuple[FloatArray, Report]:
    """A history as an array, and what is wrong with it and with constants."""
    history = np.zeros((1, 6))
    report = Report()
    with report:
        history = read_numbers("stress", stress, "an array of numbers")
        if history.ndim < 2 or history.shape[-1] != 6 or history.shape[-2] == 0:
            report("stress", f"the shape {history.shape}", "(..., time, 6), one instant or more")
        elif not np.isfinite(history).all():
            wrong = np.count_nonzero(~np.isfinite(history))
            found = f"{wrong} components that are not finite or masked"
            report("stress", found, "finite numbers")
    if not -1.0 < plain_number(poisson_ratio) <= 0.5:
        report("poisson_ratio", literal(poisson_ratio), "a number in (-1, 0.5]")
    if not 0.0 < plain_number(young_modulus) < math.inf:
        report("young_modulus", literal(young_modulus), "a positive number")
    return history, report
