"""Plane contacts in newtons and millimetres: line loads, or forces of a contact of some length."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from real import UNITS

import swtstudy
from swtstudy import Study, TabulatedProfile, run

E, NU, R, P, MU = 205e3, 0.3, 80.0, 795.0, 0.8
GIVEN: dict[str, Any] = {
    "profile": "cylinder",
    "young_modulus": E,
    "poisson_ratio": NU,
    "radius": R,
    "normal_force": P,
    "friction": MU,
}
MODULUS = E / (2.0 * (1.0 - NU**2))

RIG = f"""
title = "A cylinder on a flat"

{UNITS}
[fixed]
profile = "cylinder"
young_modulus = 205e3
poisson_ratio = 0.3
radius = 80
friction = 0.8
normal_force = 795
bulk_stress_amplitude = 90
bulk_stress_ratio = 0.1
body = 1

[axes]
tangential_force_amplitude = [137, 273]

[figure]
x = "tangential_force_amplitude"
y = "SWT"
"""


def test_a_cylinder_by_hand() -> None:
    """a = √(4PR/πE*), p0 = 2P/(πa), SWT = σ²(1−ν²)/E with σ = 2p0 √(μQ/P) at constant load."""
    pull = 273.0
    contact = swtstudy.physical(**GIVEN, tangential_force_amplitude=pull)
    a = np.sqrt(4.0 * P * R / (np.pi * MODULUS))
    peak = 2.0 * P / (np.pi * a)
    assert contact.contact_radius == pytest.approx(a, rel=1e-12)
    assert contact.peak_pressure == pytest.approx(peak, rel=1e-9)
    assert contact.mean_pressure == pytest.approx(P / (2.0 * a), rel=1e-12)
    assert contact.normal_force == pytest.approx(P, rel=1e-12)
    stress = 2.0 * peak * np.sqrt(MU * pull / P)
    swt = float(contact.swt(swtstudy.solve(**contact.parameters()).s))
    assert swt == pytest.approx(stress**2 * (1.0 - NU**2) / E, rel=1e-7)


def test_forces_of_a_length_are_line_loads() -> None:
    line = swtstudy.physical(**GIVEN, tangential_force_amplitude=100.0)
    other = GIVEN | {"normal_force": 12.0 * P}
    whole = swtstudy.physical(**other, tangential_force_amplitude=1200.0, contact_length=12.0)
    assert whole.parameters() == pytest.approx(line.parameters())
    assert whole.contact_radius == pytest.approx(line.contact_radius, rel=1e-14)
    assert whole.work_scale == pytest.approx(12.0 * line.work_scale, rel=1e-14)
    # μP_0 · μδ0, with δ0 = 4 P/(πE*).
    assert line.work_scale == pytest.approx((MU * P) * MU * 4.0 * P / (np.pi * MODULUS), rel=1e-12)


@pytest.mark.slow
def test_a_power_law_and_a_table_in_lengths() -> None:
    """f = |x|ⁿ/(n Rⁿ⁻¹): at n = 2 the cylinder; a table of the same in millimetres."""
    load = {"tangential_force_amplitude": 100.0}
    cylinder = swtstudy.physical(**GIVEN, **load)
    law = swtstudy.physical(**GIVEN | {"profile": "power_law_cylinder"}, exponent=2.0, **load)
    assert law.contact_radius == pytest.approx(cylinder.contact_radius, rel=1e-12)
    x = np.linspace(0.0, 8.0, 800)
    for n in (2.0, 3.0):
        table = TabulatedProfile("mine", x, x**n / (n * R ** (n - 1.0)), geometry="plane")
        own = {name: value for name, value in GIVEN.items() if name != "radius"} | {"profile": table}
        found = swtstudy.physical(**own, **load)
        law = swtstudy.physical(**GIVEN | {"profile": "power_law_cylinder"}, exponent=n, **load)
        assert found.contact_radius == pytest.approx(law.contact_radius, rel=1e-4)
        assert found.peak_pressure == pytest.approx(law.peak_pressure, rel=1e-4)
        swt = [float(one.swt(swtstudy.solve(**one.parameters()).s)) for one in (found, law)]
        assert swt[0] == pytest.approx(swt[1], rel=1e-4)


def test_a_study_says_newtons_per_millimetre(tmp_path: Path) -> None:
    found = run(Study.from_text(RIG), tmp_path / "rig.nc", workers=1)
    assert found.tangential_force_amplitude.attrs["units"] == "N/mm"
    assert found.normal_force.attrs["units"] == "N/mm"
    assert float(found.normal_force_amplitude) == 0.0
    assert found.control == "forces"
    assert "half-width" in found.contact_radius.attrs["long_name"]
    assert "depth" not in found
    expected = 90.0 / (2.0 * MU * MODULUS * 4.0 * P / (np.pi * MODULUS) / float(found.contact_radius))
    np.testing.assert_allclose(found.bulk_shift, expected * float(found.contact_radius), rtol=1e-9)
    assert found.bulk_shift.attrs["units"] == "mm"
    # With a length the same study is one of newtons.
    text = RIG.replace("normal_force = 795", "normal_force = 7950\ncontact_length = 10").replace(
        "137, 273", "1370, 2730"
    )
    grid = Study.from_text(text).grid
    assert grid.row("normal_force").units == "N"
    np.testing.assert_allclose(
        grid.numbers["tangential_amplitude"], found.tangential_force_amplitude / (MU * P)
    )


def test_beside_discs_strips_have_their_own_share_of_the_strain() -> None:
    """Those of a grid with both had been taken for discs."""
    different: dict[str, Any] = {"young_modulus": (E, 1.02 * E), "poisson_ratio": (0.3, 0.32), "similar": 0.1}
    more = {"tangential_force_amplitude": 400.0, "bulk_stress_amplitude": 100.0, "contact_length": 1.0}
    alone = swtstudy.physical(**GIVEN | different, **more)
    both = swtstudy.physical(**GIVEN | different | {"profile": ["paraboloid", "cylinder"]}, **more)
    shares = both.grid.at(np.arange(4), "body_share")[0].reshape(2, 2)
    np.testing.assert_allclose(shares[1], alone.grid.at(np.arange(2), "body_share")[0], rtol=1e-12)
    assert abs(shares[0, 0] - shares[1, 0]) > 1e-3
    found = alone.solve(1e-2)
    assert found.swt.slice(poisson_ratio=0.32).sizes == {"body": 1}
