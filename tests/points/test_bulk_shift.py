"""s leaves out the shift of the stick zone by the bulk strain: on which side it is, and by how much."""

from __future__ import annotations

import numpy as np
import pytest
from folders import ROOT

import swtstudy
from swtstudy.points.validity import BULK_SHIFT_ERRORS, LIMITS, validity_lines

FRICTION = 0.4


def _of_cylinder(load: float, ratio: float) -> tuple[float, float]:
    """s of a cylinder under a constant P and Q = ``load`` μP, and s with the stick zone in its place.

    In closed form (Nowell and Hills 1987): the stick zone of the half-width γ a, γ² = 1 − Q/(μP), moves by
    e = B_A/(2μ) in a_H, and σ_xx at the edge in tension becomes μ [√((1 + e)² − γ²) − e] in E* δ0/a_H.
    """
    γ = np.sqrt(1.0 - load)
    e = ratio * (1.0 - γ)
    bulk = 2.0 * FRICTION * e
    found = swtstudy.solve(
        rtol=1e-6,
        profile="cylinder",
        friction=FRICTION,
        normal_force_amplitude=0.0,
        tangential_force_amplitude=load,
        bulk_stress_amplitude=bulk,
    )
    assert float(found.bulk_shift_ratio) == pytest.approx(ratio, rel=1e-9)
    pull = FRICTION * np.array([np.sqrt(load), np.sqrt((1.0 + e) ** 2 - γ * γ) - e])
    left_out, exact = (pull + bulk) ** 2
    assert float(found.s) == pytest.approx(left_out, rel=1e-5)
    return float(found.s), float(exact)


@pytest.mark.parametrize("ratio", BULK_SHIFT_ERRORS)
def test_s_of_a_cylinder_is_too_low_by_what_the_words_say(ratio: float) -> None:
    found, exact = _of_cylinder(0.2, ratio)
    assert exact / found - 1.0 == pytest.approx(BULK_SHIFT_ERRORS[ratio][0], rel=0.02)
    for load in (0.5, 0.8):
        found, exact = _of_cylinder(load, ratio)
        assert 0.0 < exact / found - 1.0 < BULK_SHIFT_ERRORS[ratio][0]


def test_the_table_of_cylinders_in_the_docs() -> None:
    text = (ROOT / "docs" / "study_file.md").read_text(encoding="utf-8")
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if "|" in line]
    (ratios,) = (row[1:] for row in rows if row[0] == "`bulk_shift_ratio`")
    of_cylinders = [row for row in rows if row[0].startswith("cylinder, Q = ")]
    assert len(of_cylinders) == 3
    for head, *cells in of_cylinders:
        load = float(head.removeprefix("cylinder, Q = ").removesuffix(" μP"))
        for ratio, cell in zip(ratios, cells, strict=True):
            found, exact = _of_cylinder(load, float(ratio))
            word = cell.removesuffix(" %")
            assert 100.0 * (exact / found - 1.0) == pytest.approx(
                float(word), abs=0.06 if "." in word else 0.6
            )


def test_above_a_tenth_results_say_on_which_side_s_is() -> None:
    (limit,) = (each.largest for each in LIMITS if each.variable == "bulk_shift_ratio")
    assert limit == 0.1
    given = {"profile": "cylinder", "normal_force_amplitude": 0.0, "tangential_force_amplitude": 0.5}
    bulk = 2.0 * 0.3 * (1.0 - np.sqrt(0.5)) * np.array([0.09, 0.11])
    found = swtstudy.solve(rtol=1e-2, friction=0.3, bulk_stress_amplitude=bulk, **given)
    (line,) = validity_lines(found)
    assert "at 1 of 2 points" in line
    assert line.endswith(
        "; s is too low at the edge in tension, it should be up to 6 % at 0.1, 24 % at 0.5, 39 % at 1 higher "
        "for Q ≥ 0.2 μP"
    )
    assert "too low" in found.bulk_shift_ratio.comment
    assert not any("too low" in line for line in validity_lines(found.isel(bulk_stress_amplitude=[0])))
