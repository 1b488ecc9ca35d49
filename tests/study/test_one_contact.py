"""One contact and those that sequences span are of one kind: the same keywords, results and words."""

import re
from typing import Any

import numpy as np
import pytest
from real import ALUMINIUM
from told import refused

import swtstudy
from swtstudy import FatigueConstants, Study, StudyError, physical

RIG: dict[str, Any] = {"young_modulus": 73e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.5}
MOVING = RIG | {"tangential_amplitude": 2e-3, "phase": 1.0}
BRASS = FatigueConstants(73.1e3, 600.0, -0.1, 0.3, -0.6)


def test_a_value_and_a_sequence_of_one_give_the_same() -> None:
    asked = {"quantities": ["dissipation"], "critical_distance": [0.02, 0.05]}
    asked |= {"constants": (ALUMINIUM, BRASS)}
    one, several = physical(**MOVING, normal_force=150.0), physical(**MOVING, normal_force=[150.0])
    assert type(one) is type(several)
    first = [repr(each).splitlines()[0] for each in (one, several)]
    assert first == ["<PhysicalContact: one>", "<PhysicalContact: 1 normal_force>"]
    assert re.search(r"at rest +contact_radius +[\d.]+ +contact radius\n", repr(one))
    single, many = one.solve(1e-3, **asked), several.solve(1e-3, **asked)
    assert {*single.variables} == {*many.variables}
    assert single.cycles_volume.dims == ("body", "critical_distance")
    assert many.cycles_volume.dims == ("normal_force", "body", "critical_distance")
    assert single.body.values.tolist() == [1, 2]
    for name in single.data_vars:
        np.testing.assert_array_equal(many[name].squeeze(), single[name], err_msg=str(name))
    assert several.peak_pressure.item() == one.peak_pressure
    assert several.peak_pressure.normal_force.values.tolist() == [150.0]
    assert (one.phase, one.normal_amplitude, one.normal_force_amplitude) == (1.0, 0.0, None)
    np.testing.assert_array_equal(several.swt(many.s), many.SWT)
    np.testing.assert_allclose(several.cycles((ALUMINIUM, BRASS), many.s), many.cycles, rtol=1e-12)


def test_several_contacts_have_values_over_their_dimensions() -> None:
    forces = {"normal_force": [100.0, 200.0], "tangential_amplitude": [1e-3, 2e-3]}
    bulk = {"bulk_stress_ratio": 0.5, "bulk_stress_amplitude": [3.0]}
    contacts = physical(**RIG, **forces, **bulk, profile=["paraboloid", "power_law"], exponent=3.0)
    assert contacts.contact_radius.dims == ("normal_force", "profile")
    assert contacts.tangential_amplitude.values.tolist() == [1e-3, 2e-3]
    assert contacts.profile.values.tolist() == ["paraboloid", "power_law"]
    assert contacts.bulk_stress_mean == pytest.approx(9.0)
    assert contacts.shape == {"exponent": 3.0}
    for text in ("0.001, 0.002", "paraboloid, power_law", " to "):
        assert text in contacts._repr_html_()
    assert "without units" not in contacts._repr_html_()
    for call in (contacts.parameters, contacts.with_parameters):
        refused(r"normal_force, .* found several contacts; allowed: one", call)
    found = contacts.solve(1e-2)
    swt = contacts.swt(found.s)
    assert swt.dims == found.SWT.dims
    np.testing.assert_allclose(swt, found.SWT, rtol=1e-12)
    assert swt.attrs["symbol"] == r"\mathrm{SWT}"


def test_the_bodies_are_1_and_2() -> None:
    pulled = {"bulk_stress_amplitude": 30.0, "normal_force": 200.0}
    first, second = (physical(**MOVING, **pulled, bulk_stress_body=body) for body in (1, 2))
    assert "bulk_strain_share" not in first.parameters(1)
    assert first.parameters(2)["bulk_strain_share"] == -1.0
    one, other = first.solve(1e-2).SWT, second.solve(1e-2).SWT
    assert one.sel(body=1) > 1.1 * one.sel(body=2)
    np.testing.assert_array_equal(other, one[::-1])
    alone = physical(**MOVING, **pulled, body=1).solve(1e-2)
    assert alone.SWT.dims == ()
    assert float(alone.SWT) == float(one.sel(body=1))
    for call in (
        lambda: first.parameters(0),
        lambda: first.swt(0.1, body=0),
        lambda: physical(**MOVING, bulk_stress_body=0, **pulled),
    ):
        refused("body: found 0; allowed: 1 or 2", call)


def test_of_two_materials_a_life_is_that_of_one() -> None:
    """The bodies are alike and have one SWT; a number alone does not say which constants are meant."""
    contact = physical(**MOVING, normal_force=200.0)
    with pytest.raises(StudyError, match="body: found nothing; allowed: 1 or 2, since the bodies differ"):
        contact.cycles((ALUMINIUM, BRASS), 0.1)
    lives = [float(contact.cycles((ALUMINIUM, BRASS), 0.1, body=body)) for body in (1, 2)]
    assert lives == [float(each.cycles(contact.swt(0.1))) for each in (ALUMINIUM, BRASS)]
    assert float(contact.cycles(ALUMINIUM, 0.1)) == lives[0]


@pytest.mark.parametrize("force", [150.0, [150.0], [100.0, 150.0]])
def test_a_modulus_in_gigapascals_with_a_stress_ratio(force: Any) -> None:
    """The mean that comes of the ratio is beyond its range: of the ratio there is no scale."""
    soft = MOVING | {"young_modulus": 110.0, "bulk_stress_amplitude": 30.0, "bulk_stress_ratio": 0.5}
    error = refused("", physical, **soft, normal_force=force)
    (mistake,) = error.mistakes
    assert mistake.key == "bulk_stress_ratio"
    assert mistake.found.startswith("0.5 at radius = 50, normal_force = 1")
    assert mistake.allowed == "a mean of at most 10 E* δ0/a_H"


def test_a_shape_and_no_axis_of_the_contact() -> None:
    punch = MOVING | {"profile": "rounded_punch", "flat_radius": 0.2, "depth": 6e-3, "normal_amplitude": 1e-3}
    alone = [physical(**punch | {"phase": phase}).solve(1e-2).SWT for phase in (1.0, 1.3)]
    both = physical(**punch | {"phase": [1.0, 1.3]}).solve(1e-2).SWT
    np.testing.assert_array_equal(both, alone)
    fixed = "\n".join(f"{n} = {v!r}" for n, v in punch.items() if n != "phase")
    units = 'units = {length = "mm", force = "N", stress = "MPa"}'
    study = Study.from_text(f'title = "t"\n{units}\n[fixed]\n{fixed}\n[axes]\nphase = [1, 1.3]\n')
    assert study.grid.shape == (2,)
    wide = punch | {"normal_amplitude": [0.0, 1e-3], "flat_radius": 0.2}
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 1e-3, "wavelength": 0.35}
    with pytest.raises(StudyError, match=r"waviness_amplitude, wavelength: found radius = 50, .*compact"):
        physical(**{n: v for n, v in wide.items() if n != "flat_radius"} | waves)


def test_an_amplitude_of_a_loop_is_asked_for() -> None:
    """0, as of sines, would leave its normal load out."""
    square = swtstudy.LoadPath("square", [[-20, -60], [20, -60], [20, 60], [-20, 60]])
    given = RIG | {"normal_force": 150.0, "load": square, "tangential_force_amplitude": 1.0}
    refused(r"normal_amplitude: found nothing; allowed: 1 if the column normal", physical, **given)
    own = physical(**given, normal_force_amplitude=1.0).parameters()
    assert own["normal_force_amplitude"] == pytest.approx(1.0 / 150.0)


def test_a_cylinder_at_rest_under_a_loop_is_inspected() -> None:
    """Its normal load has no amplitude: what scales the loop is that of a force there."""
    loop = swtstudy.LoadPath("stroke", [[0.0, -300.0], [0.0, 300.0]])
    bodies = {"young_modulus": 210e3, "poisson_ratio": 0.3, "radius": 40.0, "friction": 0.6}
    load = {"normal_force": 1000.0, "tangential_force_amplitude": 1.0, "load": loop}
    contact = physical(**bodies, profile="cylinder", **load)
    alone = swtstudy.solve(**contact.parameters())
    np.testing.assert_allclose(alone.s, contact.solve().s[0], rtol=1e-9)
    assert contact.inspect_point(1).dissipation > 0.0
