"""Forces instead of displacements, from the names of parameters to results."""

import numpy as np
import pytest
from solved import REGIMES
from told import RIG

import swtstudy
from swtstudy import Study, StudyError, open_results, run

FORCES = {"normal_force_amplitude": 0.4, "tangential_force_amplitude": 0.3}


def test_without_equilibrium_there_is_no_s_but_a_regime() -> None:
    limit = -0.6 * np.cos(1.0) + np.sqrt(1.0 - 0.36 * np.sin(1.0) ** 2)
    dataset = swtstudy.solve(
        normal_force_amplitude=0.6, tangential_force_amplitude=[0.999 * limit, 1.001 * limit], phase=1.0
    )
    names = [REGIMES[int(code)] for code in dataset.regime]
    assert names == ["partial_slip", "no_equilibrium"]
    assert np.isfinite(dataset.s.values).tolist() == [True, False]
    for name in ("s_error", "s_surface", "critical_x", "critical_angle"):
        assert np.isfinite(dataset[name].values).tolist() == [True, False]
    pulled = swtstudy.solve(normal_force_amplitude=[0.999, 1.001], tangential_amplitude=0.3)
    assert np.isfinite(pulled.s.values).tolist() == [True, False]
    lifted = swtstudy.solve(normal_amplitude=[0.5, 1.1], tangential_force_amplitude=0.1)
    assert np.isfinite(lifted.s.values).tolist() == [True, False]
    # Table 1's numbers taken as forces.
    table = swtstudy.solve(normal_force_amplitude=0.75, tangential_force_amplitude=5 / 6, phase=[0, 1, 2])
    assert np.isnan(table.s).all()


STUDY = """title = "Forces"
rtol = 1e-3
[fixed]
normal_force_amplitude = {normal}
[axes]
tangential_force_amplitude = [0.1, 0.3, 0.9]
phase = [0, 1]
"""


def test_a_run_keeps_what_has_no_equilibrium(tmp_path) -> None:
    path = tmp_path / "forces.nc"
    dataset = run(Study.from_text(STUDY.format(normal=0.4)), path, workers=1)
    assert (dataset.status == 0).all()
    assert np.isnan(dataset.s).values.tolist() == [[False, False], [False, False], [True, True]]
    found = open_results(path)
    assert found.control.item() == "forces"
    solved = swtstudy.solve(
        normal_force_amplitude=0.4, tangential_force_amplitude=[0.1, 0.3, 0.9], phase=[0, 1], rtol=1e-3
    )
    np.testing.assert_array_equal(found.s, solved.s)

    def fail(*_: object, **__: object) -> None:
        raise AssertionError("computed again")

    again = run(Study.from_text(STUDY.format(normal=0.4)), path, solver=fail, workers=1)
    np.testing.assert_array_equal(again.s, found.s)


def test_waves_are_refused_at_the_depth_that_a_force_reaches() -> None:
    """N grows faster than the depth: the force 1.4 is reached at the depth 1.25, the force 2 at 1.59."""
    waves = {"profile": "wavy_paraboloid", "waviness_amplitude": 10.0, "wavelength": 3.49}
    with pytest.raises(StudyError, match=r"wavelength 3\.49 is below .* up to the depth 1.4 δ0"):
        swtstudy.solve(**waves, normal_amplitude=0.4)
    assert swtstudy.solve(**waves, normal_force_amplitude=0.4, rtol=0.1).s > 0.0
    with pytest.raises(StudyError, match=r"wavelength 3\.49 is below .* up to the depth 1.58618 δ0"):
        swtstudy.solve(**waves, normal_force_amplitude=1.0)


def test_a_real_contact_takes_forces() -> None:
    contact = swtstudy.physical(
        **RIG, normal_force=200.0, normal_force_amplitude=80.0, tangential_force_amplitude=30.0
    )
    own = contact.parameters()
    assert own["normal_force_amplitude"] == pytest.approx(0.4)
    assert own["tangential_force_amplitude"] == pytest.approx(0.3)
    assert not {"normal_amplitude", "tangential_amplitude"} & {*own}
    s = swtstudy.solve(**FORCES, poisson_ratio=0.33, friction=0.5).s
    np.testing.assert_allclose(contact.solve().s, s, rtol=1e-6)
    other = contact.with_parameters(tangential_amplitude=0.5)
    assert other.tangential_force_amplitude is None
    assert other.tangential_amplitude == pytest.approx(0.5 * contact.slip_scale)
    assert contact.with_parameters(normal_force_amplitude=0.1).normal_force_amplitude == pytest.approx(20.0)
    for wrong, words in (
        ({"normal_amplitude": 0.001}, "normal_amplitude, normal_force_amplitude: found both"),
        (
            {"tangential_force_amplitude": -1.0},
            "tangential_force_amplitude: found -1.0 .out of range.; allowed: a force",
        ),
    ):
        given = {"normal_force_amplitude": 80.0, "tangential_force_amplitude": 30.0, **wrong}
        with pytest.raises(StudyError, match=words):
            swtstudy.physical(**RIG, normal_force=200.0, **given)
