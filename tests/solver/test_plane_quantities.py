"""Quantities of plane contacts, and what results say of them."""

import numpy as np
import pytest

import swtstudy

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


def test_one_point_in_curves_and_in_a_figure() -> None:
    given = {
        "profile": "cylinder",
        "normal_force_amplitude": 0.4,
        "tangential_force_amplitude": 0.3,
        "phase": 1.0,
    }
    point = swtstudy.inspect_point(**given)
    assert not {"depth", "displacement"} & {*point}
    np.testing.assert_allclose(point.normal_force.max(), 1.4, rtol=1e-4)
    swing = float(np.ptp(point.normal_strain.values)) / 2.0
    assert float(point.normal_stress.max()) * swing == pytest.approx(float(point.s), rel=1e-3)
    # The diagram: within its bounds, and its integral over the loads is the tangential force.
    assert (np.abs(point.force) <= point.compression + 1e-12).all()
    figure = swtstudy.inspect(**given)
    titles = [axes.get_title("left") for axes in figure.axes if axes.get_title("left")]
    assert len(titles) == 7
    assert not any("displacement" in title for title in titles)


def test_swt_along_a_cylinder_does_not_depend_on_y() -> None:
    given = {
        "profile": "cylinder",
        "normal_force_amplitude": 0.0,
        "tangential_force_amplitude": 0.5,
        "friction": 0.6,
    }
    field = swtstudy.swt_field(x=-1.0, y=0.0, z=0.0, **given)
    assert float(field.s_local) == pytest.approx(0.18, rel=1e-6)
    given["normal_force_amplitude"] = 0.4
    # Alone, each place has the instants at which the edge passes its x.
    alone = [float(swtstudy.swt_field(x=-1.1, y=y, z=0.0, **given).s_local) for y in (0.0, 3.0)]
    assert alone[0] == alone[1]
    stress = swtstudy.stress_field(
        x=[-1.2, 0.4], y=2.0, z=[0.0, 0.2], time=[0.3], bulk_stress_mean=0.1, **given
    )
    expected = 0.3 * (stress.sigma_xx + stress.sigma_zz)
    np.testing.assert_allclose(stress.sigma_yy, expected, atol=1e-15)
