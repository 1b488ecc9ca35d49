"""Criteria as functions of a plane's largest tension and of the range of its swing."""

import numpy as np
import pytest

from swtstudy.kernel.criterion import (
    SWT,
    ask,
    curvature_bound,
    degrees,
    far_field,
    lift,
    lifted,
    partials,
    sensitivities,
    value_of,
)

pytestmark = pytest.mark.xdist_group("kernel")
POISSON = 0.3
CRITERIA = {
    "swt": {},
    "walker, of the swing": {"walker_exponent": 0.7},
    "walker, of the tension": {"walker_exponent": 0.2},
    "fatemi_socie": {"criterion": "fatemi_socie", "normal_sensitivity": 0.8},
    "findley": {"criterion": "findley", "normal_sensitivity": 0.4},
}
CASES = pytest.mark.parametrize("given", CRITERIA.values(), ids=CRITERIA)


def asked(given):
    """The kernel's record of a criterion."""
    return ask(POISSON, 0.5, 1e-4, **given)


def formula(given, T, A):
    """The criterion as it is defined, of tension and range."""
    k = given.get("normal_sensitivity")
    if given.get("criterion") == "fatemi_socie":
        return 0.5 * A * (1.0 + k * max(T, 0.0))
    if given.get("criterion") == "findley":
        return max(0.5 * A + k * T, 0.0)
    gamma = given.get("walker_exponent", 0.5)
    return max(T, 0.0) ** (2 - 2 * gamma) * (0.5 * A) ** (2 * gamma) / (1 - POISSON**2)


@CASES
@pytest.mark.parametrize("T", [-0.2, 0.3, 1.7])
@pytest.mark.parametrize("A", [0.1, 0.9, 2.3])
def test_criterion_of_tension_and_range(given, T, A):
    record = asked(given)
    h = lifted(record, T, A, 0.0)
    assert value_of(record, h) == pytest.approx(formula(given, T, A), rel=1e-13)
    assert lift(record, value_of(record, h)) == pytest.approx(h, rel=1e-13)


def test_tension_of_rounding_alone_is_none():
    record = asked({})
    assert [lifted(record, T, 2.0, 0.1) for T in (0.1, 0.11)] == [0.0, pytest.approx(0.22)]


@CASES
@pytest.mark.parametrize(("T", "A"), [(0.4, 0.9), (1.5, 0.3)])
def test_derivatives_of_a_criterion(given, T, A):
    record, e = asked(given), 1e-4

    def h(t, a):
        return lifted(record, T + t, A + a, 0.0)

    slopes = [(h(e, 0) - h(-e, 0)) / (2 * e), (h(0, e) - h(0, -e)) / (2 * e)]
    bends = [
        (h(e, 0) + h(-e, 0) - 2 * h(0, 0)) / e**2,
        (h(e, e) - h(e, -e) - h(-e, e) + h(-e, -e)) / (4 * e**2),
        (h(0, e) + h(0, -e) - 2 * h(0, 0)) / e**2,
    ]
    assert partials(record, T, A) == pytest.approx([*slopes, *bends], abs=1e-6)
    value = formula(given, T, A)
    relative = [
        (formula(given, T + e, A) - formula(given, T - e, A)) / (2 * e) / value,
        (formula(given, T, A + e) - formula(given, T, A - e)) / (2 * e) / value,
    ]
    assert sensitivities(record, T, A) == pytest.approx(relative, rel=1e-6)


@pytest.mark.parametrize("given", [CRITERIA["fatemi_socie"], CRITERIA["swt"]], ids=["fatemi_socie", "swt"])
def test_compression_changes_no_criterion_that_opens_cracks(given):
    of_tension, of_swing = sensitivities(asked(given), -0.5, 0.8)
    assert (of_tension, of_swing) == ((0.0, 0.0) if not given else (0.0, pytest.approx(1 / 0.8)))


@CASES
@pytest.mark.parametrize("seed", range(3))
def test_no_criterion_bends_more_than_its_bound(given, seed):
    """Over the double angle of the plane, where there is tension."""
    rng, angle = np.random.default_rng(seed), np.linspace(0.0, 2 * np.pi, 4001)
    (a, b, c), (d, e, f) = rng.normal(size=(2, 3))
    T = a + b * np.cos(angle) + c * np.sin(angle)
    A = abs(d) + 1.5 * np.hypot(e, f) + e * np.cos(angle) + f * np.sin(angle)
    record = asked(given)
    h = np.array([lifted(record, *each, 0.0) for each in zip(T, A, strict=True)])
    bend = -np.diff(h, 2) / np.diff(angle)[0] ** 2
    of_tension, of_swing = np.hypot(b, c), np.hypot(e, f)
    bound = curvature_bound(record, max(T.max(), 0.0), A.max(), of_tension, of_swing, of_tension)
    assert bend[T[1:-1] > 0.05].max(initial=0.0) <= bound * (1 + 1e-3)


@CASES
@pytest.mark.parametrize("plane", [False, True])
@pytest.mark.parametrize("loads", [(0.7, -0.2), (0.3, 0.25), (-0.1, -0.8)])
def test_bulk_stress_alone(given, plane, loads):
    """The value is the largest over all planes of a body in tension along x, and one of these has it."""
    record, angle = asked(given), np.linspace(0.0, np.pi, 20_001)
    pull, swing = 0.5 * (1 + np.cos(angle)) * loads[0], loads[0] - loads[1]
    if record["criterion"] == SWT:  # E times the normal strain; in plane strain there is none across
        along, across = (1 - POISSON**2, POISSON / (1 - POISSON)) if plane else (1.0, POISSON)
        of_swing = swing * along * np.abs(0.5 * (1 + np.cos(angle)) - across * 0.5 * (1 - np.cos(angle)))
    else:
        of_swing = swing * 0.5 * np.sin(angle)
    values = np.array([formula(given, *each) for each in zip(pull, of_swing, strict=True)])
    found, at = far_field(record, *loads, plane)
    assert found == pytest.approx(max(values.max(), 0.0), rel=1e-6, abs=1e-12)
    if found > 0.0:
        assert np.interp(at, angle, values) == pytest.approx(found, rel=1e-6)


def test_plane_in_degrees():
    doubled = [0.0, np.pi / 2, np.pi, 1.5 * np.pi, -np.pi / 2, 5 * np.pi]
    assert [degrees(each) for each in doubled] == pytest.approx([0.0, 45.0, 90.0, -45.0, -45.0, 90.0])
