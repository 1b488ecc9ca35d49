"""Margins of points: in closed form, and from samples of the loads as from their pieces."""

from typing import Any

import numpy as np
import pytest

from swtstudy import LoadPath, TabulatedProfile
from swtstudy.solver.margins import foreseen, margins_of
from swtstudy.solver.points import Points, arguments_of
from swtstudy.vocabulary.parameters import Control

FORCES, MIXED, OTHER = Control(True, True), Control(False, True), Control(True, False)
SQUARE = LoadPath("square", [[0.0, 0.2], [0.3, 0.5], [0.3, -0.4], [-0.2, -0.1]])
BULK = LoadPath("bulk", [[0.0, 0.5, 0.1], [0.0, -0.5, -0.3]])
SUM = LoadPath.harmonic_sum("sum", [(1, 0.3, 0.2), (3, 0.1, 1.0)], [(2, 0.4, 0.0)], [(2, 0.2, 0.0)])
TABLE = TabulatedProfile("table", np.linspace(0.0, 3.0, 90), np.linspace(0.0, 3.0, 90) ** 2 / 2.0)


def points(profile: Any = "paraboloid", count: int = 4, **own: Any) -> Points:
    """Some points that differ in all that is not given."""
    share = np.linspace(0.0, 1.0, count)
    given = {
        "poisson_ratio": 0.1 + 0.3 * share,
        "friction": 0.3 + 0.4 * share,
        "normal_amplitude": 0.6 * share,
        "p": np.full(count, 1),
        "q": np.full(count, 1),
        "tangential_amplitude": 0.2 + 0.4 * share[::-1],
        "phase": 0.1 + share,
    }
    return Points(profile, **{**given, **{k: fitted(v, count) for k, v in own.items()}})


def fitted(value: Any, count: int) -> Any:
    if isinstance(value, dict):
        return {name: fitted(each, count) for name, each in value.items()}
    return np.full(count, value) if isinstance(value, int | float) else value


def test_what_is_not_given_has_its_default() -> None:
    two = points(count=2)
    found = arguments_of(two)
    numbers = {name: value.tolist() for name, value in found.items() if isinstance(value, np.ndarray)}
    given = ("poisson_ratio", "friction", "normal_amplitude", "tangential_amplitude", "phase")
    assert {name: value for name, value in numbers.items() if name not in given} == {
        "walker_exponent": [0.5, 0.5],
        "normal_sensitivity": [0.0, 0.0],
        "bulk_amplitude": [0.0, 0.0],
        "bulk_mean": [0.0, 0.0],
        "bulk_phase": [0.0, 0.0],
        "pulled": [1.0, 1.0],
    }
    rest = {name: value for name, value in found.items() if name not in numbers}
    assert rest == {
        "profile": "paraboloid",
        "shape": {},
        "criterion": "swt",
        "frequency_ratio": [1, 1],
        "loops": None,
        "control": (False, False),
    }
    one = points("rounded_punch", shape={"flat_radius": np.array([0.1, 0.2, 0.3, 0.4])}, path=SQUARE)[[2]]
    assert arguments_of(one)["shape"]["flat_radius"].tolist() == [0.3]
    assert arguments_of(one)["loops"] == [SQUARE]
    assert one.friction == pytest.approx(0.3 + 0.8 / 3.0)


CASES: dict[str, Points] = {
    "plain": points(),
    "fast": points(p=3, q=2),
    "slow": points(p=np.array([1, 2, 1, 2]), q=np.array([2, 1, 2, 1])),
    "forces": points(control=FORCES),
    "mixed": points(control=MIXED, normal_amplitude=0.5),
    "other": points(control=OTHER),
    "parting": points(normal_amplitude=np.array([0.9, 0.98, 1.1, 1.5])),
    "parting under force": points(control=OTHER, normal_amplitude=np.array([0.5, 0.9, 1.1, 1.5])),
    "sliding": points(tangential_amplitude=3.0, normal_amplitude=0.2),
    "punch": points("rounded_punch", control=MIXED, shape={"flat_radius": np.array([0.1, 0.3, 0.3, 1.0])}),
    "waves": points("wavy_paraboloid", control=OTHER, shape={"waviness_amplitude": 0.03, "wavelength": 4.5}),
    "cylinder": points("cylinder", control=FORCES),
    "flat": points("rounded_flat", control=FORCES, shape={"flat_half_width": 0.4}),
    "table": points(TABLE, control=MIXED),
    "polygon": points(path=SQUARE, normal_amplitude=0.7, tangential_amplitude=0.8),
    "polygon of forces": points(path=SQUARE, control=FORCES, normal_amplitude=0.7),
    "sum": points(path=SUM),
    "moved": points(normal_amplitude=0.0, bulk_stress_amplitude=np.array([0.0, 0.05, 0.1, 0.9])),
    "out of phase": points(normal_amplitude=0.0, bulk_stress_amplitude=0.05, bulk_stress_phase=1.0),
    "moved by a loop": points(path=BULK, normal_amplitude=0.3, bulk_stress_amplitude=0.1),
    "moved by a sum": points(path=SUM, normal_amplitude=0.0, bulk_stress_amplitude=0.1),
    "moved under a cylinder": points(
        "cylinder", control=FORCES, normal_amplitude=0.0, bulk_stress_amplitude=0.1
    ),
    "not shared": points(normal_amplitude=0.0, bulk_stress_amplitude=0.1, bulk_strain_share=0.0),
}


@pytest.mark.parametrize("case", CASES)
def test_samples_foresee_what_pieces_give(case: str) -> None:
    found, exact = foreseen(CASES[case]), margins_of(CASES[case])
    assert [*found] == [*exact]
    for name, values in exact.items():
        np.testing.assert_allclose(found[name], values, 1e-4, 3e-5, err_msg=name)


def test_a_constant_depth_in_closed_form() -> None:
    """A Hertz contact sticks where 1 − U is above ξ², and slides by what U is above 1."""
    found = foreseen(points(normal_amplitude=0.0, tangential_amplitude=np.array([0.0, 0.36, 0.99, 1.25])))
    np.testing.assert_allclose(found["contact_radius"], 1.0, rtol=1e-12)
    assert found["force_ratio"].tolist() == pytest.approx([np.nan] * 4, nan_ok=True)
    np.testing.assert_allclose(found["stick_radius"], [1.0, 0.8, 0.1, np.nan], rtol=1e-6)
    np.testing.assert_allclose(found["slide"], [0.0, 0.0, 0.0, 0.25], atol=1e-12)
    forces = foreseen(points(control=FORCES, normal_amplitude=0.0, tangential_amplitude=0.488))
    np.testing.assert_allclose(forces["stick_radius"], 0.8, rtol=1e-9)
    np.testing.assert_allclose(forces["force_ratio"], 0.488, rtol=1e-12)
