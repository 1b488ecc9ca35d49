"""Criteria of a user's own stress history, with every mistake in it reported."""

from __future__ import annotations

import math
import warnings
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from swtstudy.vocabulary.arrays import FloatArray
from swtstudy.vocabulary.choices import CRITERIA, SWT
from swtstudy.vocabulary.definition import read_numbers
from swtstudy.vocabulary.mistakes import Report, literal, nearest, plain_number
from swtstudy.vocabulary.parameters import PARAMETERS

#: The criterion that has no plane, and all but swt.
CROSSLAND = "crossland"
_KNOWN = (*(name for name in CRITERIA if name != SWT), CROSSLAND)
#: No plane has a value that is higher than the largest one by more than this, relative.
TOLERANCE = 1e-5
#: Rounding error of a distance, as a share of the size of a path, and of a unit normal's component.
ROUNDING, SAME = 1e-12, 1e-9
#: Less than this is nothing: it divides nothing.
TINY = 1e-300
#: Steps towards the smallest sphere for each point and each dimension.
MOST_STEPS = 60
#: Pairs of points of a path that are looked at together.
PAIRS = 1_000_000


class CriticalPlane(NamedTuple):
    """The critical plane of each history.

    Attributes
    ----------
    swt
        Shape (...): σ_n^max Δε_n/2, in the unit of stress²/modulus; 0 where no plane ever sees tension.
    normal
        Shape (..., 3): unit normal, its first non-zero component positive; NaN where swt is 0.
    """

    swt: FloatArray
    normal: FloatArray


def swt_of_history(
    stress: ArrayLike, poisson_ratio: float, young_modulus: float = 1.0, walker_exponent: float = 0.5
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
    >>> float(swt.round(6)), abs(normal).round(6).tolist()
    (0.5, [1.0, 0.0, 0.0])
    """
    history, report = _checked(stress, poisson_ratio, young_modulus)
    row = PARAMETERS["walker_exponent"]
    if not row.lower < plain_number(walker_exponent) <= row.upper:
        report(row.name, literal(walker_exponent), row.allowed)
    report.refuse()
    ν, E, γ = map(plain_number, (poisson_ratio, young_modulus, walker_exponent))
    return _over_all_planes(history, ν, SWT, (1.0 - ν**2) / E, walker_exponent=γ)


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
    On a plane the amplitude is half of the largest chord of the path of its shear stress. For a path that is
    not a line other definitions give more, such as the radius of the smallest circle around it. √J2,a is the
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
        hydrostatic = history[..., :3].mean(axis=-1, keepdims=True)
        deviator = history.copy()
        deviator[..., :3] = (history[..., :3] - hydrostatic) / np.sqrt(2.0)
        paths = deviator.reshape(-1, *deviator.shape[-2:])
        radius = np.array([smallest_sphere(path)[1] for path in paths]).reshape(history.shape[:-2])
        value = np.maximum(radius + sensitivity * hydrostatic[..., 0].max(axis=-1), 0.0)
        return value, np.full((*value.shape, 3), np.nan)
    return _over_all_planes(history, 0.3, criterion, 1.0, normal_sensitivity=sensitivity)


def _over_all_planes(
    history: FloatArray, poisson_ratio: float, criterion: str, factor: float, **parameters: float
) -> CriticalPlane:
    """Largest value over all planes, times a factor, of histories (…, T, 6)."""
    # The kernel takes half a second to import, and what validates a study does without it.
    from swtstudy.kernel.all_planes import planes_of
    from swtstudy.kernel.criterion import ask

    batch = history.shape[:-2]
    # Large powers of a stress leave the range of floats.
    size = float(np.abs(history).max(initial=0.0)) or 1.0
    if CRITERIA[criterion].normal_unit:  # the sensitivity is one over a stress
        parameters["normal_sensitivity"] *= size
    own = ask(poisson_ratio, 0.0, TOLERANCE, criterion, **parameters)
    value, normal, unsettled = planes_of(history.reshape(-1, *history.shape[-2:]) / size, own, TOLERANCE)
    if unsettled:
        words = f"the search over planes ended early at {unsettled} of {len(value)} histories"
        warnings.warn(f"{words}: their values may be low", RuntimeWarning, stacklevel=3)
    normal[value == 0.0] = np.nan
    value *= factor * size ** CRITERIA[criterion].degree
    return CriticalPlane(value.reshape(batch), one_of_both(normal).reshape(*batch, 3))


def one_of_both(normal: FloatArray) -> FloatArray:
    """Unit normals, (n, 3), with a positive first component that is not 0: n and −n are the same plane."""
    first = np.argmax(np.abs(normal) > SAME, axis=1)
    return normal * np.sign(np.take_along_axis(normal, first[:, None], axis=1)) + 0.0


def smallest_sphere(points: FloatArray) -> tuple[FloatArray, float]:
    """Centre and radius of the smallest sphere around points, (k, d).

    The centre walks towards the points on the sphere, which shrinks until another point is on it, or until it
    is between them (Fischer, Gärtner and Kutz 2003).
    """
    centre = points[0].copy()
    on = [int(((points - centre) ** 2).sum(axis=1).argmax())]
    size = max(float(np.ptp(points, axis=0).max()), TINY)
    for _ in range(MOST_STEPS * (points.shape[1] + len(points))):
        base, others = points[on[0]], points[on[1:]] - points[on[0]]
        share = np.linalg.lstsq(others.T, centre - base, rcond=None)[0]
        way = base + share @ others - centre
        if np.linalg.norm(way) <= ROUNDING * size:
            shares = np.append(1.0 - share.sum(), share)
            if shares.min() >= -ROUNDING:
                break
            on.pop(int(shares.argmin()))
            continue
        short = ((points - centre) ** 2).sum(axis=1) - ((base - centre) ** 2).sum()
        nears = 2.0 * (base - points) @ way
        nears[on] = 0.0
        reaches = nears > ROUNDING * size**2
        stop = np.full(len(points), np.inf)
        stop[reaches] = np.maximum(-short[reaches], 0.0) / nears[reaches]
        first = int(stop.argmin())
        centre = centre + min(stop[first], 1.0) * way
        if stop[first] < 1.0:
            on.append(first)
    return centre, float(np.sqrt(((points - centre) ** 2).sum(axis=1).max()))


def longest_chord(path: FloatArray) -> FloatArray:
    """The longest difference of two of the points of a path, shape (k, d)."""
    found = np.zeros(path.shape[1])
    for some in np.array_split(path, len(path) ** 2 // PAIRS + 1):
        chords = (some[:, None] - path).reshape(-1, path.shape[1])
        longest = chords[np.square(chords).sum(axis=1).argmax()]
        found = max(found, longest, key=np.linalg.norm)
    return found


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
