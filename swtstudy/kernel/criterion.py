"""Criteria: increasing functions of a plane's largest tension T and of the range A of its swing.

Both follow from maxima over the cycle of curves that are linear in the stress: T = max σ_n and
A = max w + max(-w). The swing w is (1-ν²) ε_n for the Smith–Watson–Topper parameter (9), with Walker's
exponent γ too, and the shear stress τ for the criteria of Fatemi and Socie and of Findley:

    SWT, Walker     T^(2-2γ) (A/2)^(2γ)/(1-ν²)
    Fatemi–Socie    A/2 (1 + k T⁺)
    Findley         A/2 + k T

The search over planes works with an increasing function h of the criterion that has no powers below 1, so
that the curvatures of T and A bound its curvature downwards: T A^m or A T^m with m ≥ 1 for Walker's form.
"""

from math import acos, atan2, hypot, pi, sqrt

import numpy as np

from swtstudy.kernel.compiled import fields, jit, new_record
from swtstudy.vocabulary.choices import CRITERIA

#: Numbers of the rows of `CRITERIA`.
SWT, FATEMI_SOCIE, FINDLEY = np.arange(len(CRITERIA))
CRITERION = [
    ("criterion", "i8"),
    ("sensitivity", "f8"),  # k
    ("of_swing", "i8"),  # 1: h = T A^m, 0: h = A T^m
    *fields("f8", "power outer factor"),  # m; value = factor · h^outer
]

ASK = np.dtype(
    [
        *fields("f8", "poisson_ratio friction"),
        ("pulled", "f8"),  # strain of the body with the bulk stress over the mean of both
        *CRITERION,
        # Relative tolerances of the search along the line, the series over time, the search over planes,
        # and the series of dv/dn.
        *fields("f8", "line time plane growth"),
        ("near", "f8"),  # positions below this share of the best are not looked at closer
    ]
)
#: Positions with a value, or a bound over planes, below this share of the best are not looked at closer.
NEAR = 0.9


def set_criterion(record, name, poisson_ratio, walker_exponent=0.5, normal_sensitivity=0.0):
    """Write the fields of `CRITERION`.

    Parameters
    ----------
    name
        swt, fatemi_socie or findley.
    poisson_ratio, walker_exponent, normal_sensitivity
        ν, γ and k, –; the last one in a_H/(E* δ0) for fatemi_socie.
    """
    kind, gamma = [*CRITERIA].index(name), walker_exponent
    record["criterion"], record["sensitivity"] = kind, normal_sensitivity
    record["of_swing"], record["power"], record["outer"], record["factor"] = 1, 1.0, 1.0, 0.5
    if kind == SWT:
        record["of_swing"] = gamma >= 0.5
        ratio = gamma / (1.0 - gamma)
        record["power"] = max(ratio, 1.0 / ratio)
        record["outer"] = min(2.0 * gamma, 2.0 - 2.0 * gamma)
        record["factor"] = 0.5 ** (2.0 * gamma) / (1.0 - poisson_ratio**2)


def ask(
    poisson_ratio, friction, rtol, criterion="swt", walker_exponent=0.5, normal_sensitivity=0.0, pulled=1.0
):
    """Bodies, criterion and tolerances."""
    record = new_record(ASK)
    record["poisson_ratio"], record["friction"], record["pulled"] = poisson_ratio, friction, pulled
    set_criterion(record, criterion, poisson_ratio, walker_exponent, normal_sensitivity)
    record["line"], record["time"] = 0.45 * rtol, 0.25 * rtol
    record["plane"] = record["growth"] = 0.1 * rtol
    record["near"] = NEAR
    return record


@jit
def swing_weights(ask, C, S):
    """Weights of b and c in the swing of the plane with cos 2θ = C, sin 2θ = S: ε_n or τ."""
    if ask.criterion == SWT:
        return (1.0 + ask.poisson_ratio) * C, (1.0 + ask.poisson_ratio) * S
    return -S, C


@jit
def lifted(ask, T, A, noise):
    """H of T and A, 0 at least; a tension up to noise is none."""
    if ask.criterion == SWT:
        T, A = T if noise < T else 0.0, max(A, 0.0)
        if ask.power == 1.0:
            return T * A
        return T * A**ask.power if ask.of_swing else A * T**ask.power
    if ask.criterion == FATEMI_SOCIE:
        return A * (1.0 + ask.sensitivity * max(T, 0.0))
    return max(A + 2.0 * ask.sensitivity * T, 0.0)


@jit
def value_of(ask, h):
    """The criterion from h."""
    return ask.factor * h if ask.outer == 1.0 else ask.factor * h**ask.outer


@jit
def lift(ask, value):
    """H from the criterion."""
    h = value / ask.factor
    return h if ask.outer == 1.0 else h ** (1.0 / ask.outer)


@jit
def partials(ask, T, A):
    """h_T, h_A, h_TT, h_TA, h_AA."""
    m, k = ask.power, ask.sensitivity
    if ask.criterion == SWT:
        T, A = max(T, 0.0), max(A, 0.0)
        if m == 1.0:
            return A, T, 0.0, 1.0, 0.0
        if ask.of_swing:
            x = m * A ** (m - 1.0)
            return A**m, T * x, 0.0, x, m * (m - 1.0) * T * A ** (m - 2.0) if A > 0.0 else 0.0
        x = m * T ** (m - 1.0)
        return A * x, T**m, m * (m - 1.0) * A * T ** (m - 2.0) if T > 0.0 else 0.0, x, 0.0
    if ask.criterion == FATEMI_SOCIE:
        if T <= 0.0:
            return 0.0, 1.0, 0.0, 0.0, 0.0
        return k * A, 1.0 + k * T, 0.0, k, 0.0
    return 2.0 * k, 1.0, 0.0, 0.0, 0.0


@jit
def curvature_bound(ask, T, A, of_tension, of_swing, slope):
    """Bound of -h″ over 2θ for given maxima of T and A, of |T″|, |A′| and |A″|, and of the slope |T′|.

    The terms with h_TT and h_AA, which are not negative, only help.
    """
    h_t, h_a, _, h_ta, _ = partials(ask, T, A)
    return h_t * of_tension + 2.0 * h_ta * slope * of_swing + h_a * of_swing


@jit
def slope_bound(of_tension, highest):
    """Bound of |T′| where T ≥ 0, from one of -T″ and the largest T: nearer to that the slope is less."""
    return min(of_tension, sqrt(2.0 * of_tension * max(highest, 0.0)))


@jit
def sensitivities(ask, T, A):
    """Relative change of the criterion by a change of T, and by one of A."""
    h = lifted(ask, T, A, 0.0)
    if h <= 0.0:
        return 0.0, 0.0
    h_t, h_a, _, _, _ = partials(ask, T, A)
    return ask.outer * h_t / h, ask.outer * h_a / h


@jit
def stress_of(ask, T, A):
    """The stress on whose relative error that of a value depends: of a product the smaller factor."""
    if ask.criterion == SWT:
        return min(0.5 * A, T)
    return 0.5 * A if ask.criterion == FATEMI_SOCIE else max(0.5 * A, ask.sensitivity * T)


@jit
def far_field(ask, largest, smallest, plane):
    """The criterion under a bulk stress along x alone, and 2θ of its plane (rad).

    Parameters
    ----------
    largest, smallest
        Range of the bulk stress over the cycle, in E* δ0/a_H.
    plane
        Whether the bulk stress is one of plane strain.
    """
    swing, nu, k = largest - smallest, ask.poisson_ratio, ask.sensitivity
    if ask.criterion == SWT:
        return value_of(ask, lifted(ask, largest, swing * (1.0 - nu * nu) if plane else swing, 0.0)), 0.0
    if ask.criterion == FATEMI_SOCIE:
        # sin 2θ (1 + m + m cos 2θ) is largest where its derivative, a quadratic form of the cosine, vanishes.
        m = 0.5 * k * max(largest, 0.0)
        cosine = 2.0 * m / (1.0 + m + sqrt((1.0 + m) * (1.0 + m) + 8.0 * m * m))
        T, A = 0.5 * largest * (1.0 + cosine), 0.5 * swing * sqrt(1.0 - cosine * cosine)
        return value_of(ask, lifted(ask, T, A, 0.0)), acos(cosine)
    pull, shear = k * largest, 0.5 * swing
    return max(0.5 * (pull + hypot(shear, pull)), 0.0), atan2(shear, pull)


@jit
def degrees(double_angle):
    """The plane's angle in (-90, 90] degrees from 2θ."""
    angle = double_angle % (2.0 * pi)
    return 90.0 / pi * (angle - 2.0 * pi if angle > pi else angle)
