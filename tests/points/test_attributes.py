"""What stands beside the numbers of fields, averages and one point, in words that are not the package's."""

import numpy as np
import pytest
from told import RIG

import swtstudy


@pytest.mark.slow
@pytest.mark.parametrize(
    ("criterion", "value"),
    [
        ("findley", "Findley stress"),
        ("fatemi_socie", "Fatemi-Socie parameter"),
        (["findley", "swt"], "criterion"),
    ],
)
def test_nonlocal_values_are_of_the_criterion(criterion, value):
    given = {"normal_sensitivity": 0.3, "critical_distance": 0.1, "tangential_amplitude": 0.5}
    found = swtstudy.solve(criterion=criterion, **given, rtol=1e-2)
    others = {*found} - {*swtstudy.solve(rtol=1e-2)}
    told = {name: found[name].attrs for name in others}
    assert told["s_volume"]["long_name"] == f"mean of {value} over a volume"
    assert told["s_point"]["long_name"] == f"{value} at a distance"
    assert told["s_line"]["comment"] == (
        f"largest mean of {value} in the unit of s over twice the critical distance from places of the "
        "surface line, which is that from line_x"
    )
    assert not [each for each in told.values() if "swt" in " ".join(map(str, each.values())).lower()]


def test_counted_cycles_are_of_the_criterion():
    own = RIG | {"normal_force": 200.0, "tangential_force_amplitude": [30.0, 60.0]}
    own |= {"criterion": "fatemi_socie", "normal_sensitivity": 0.3, "yield_strength": 400.0}
    contacts = swtstudy.physical(**own)
    found = contacts.solve(constants=swtstudy.FatigueConstants(73.1e3, 900.0, -0.1, 0.5, -0.6), rtol=1e-2)
    assert found.counted.attrs["symbol"] == "s_i/s"
    assert not [each for each in found.counted.attrs.values() if "swt" in str(each).lower()]


@pytest.mark.parametrize(
    ("parameters", "regime"),
    [
        ({"normal_amplitude": 0.5, "tangential_amplitude": 0.0}, "stick"),
        ({"normal_amplitude": 0.0, "tangential_amplitude": 0.99}, "partial_slip"),
        ({"normal_amplitude": 0.0, "tangential_amplitude": 1.01}, "gross_slip"),
        ({"normal_amplitude": 1.01, "tangential_amplitude": 0.1}, "lift_off"),
    ],
)
def test_regimes_of_known_motions(parameters, regime):
    """With δA = 0 all slides from u_A = 1 (in δ0 of the springs) on; δA > δ0 loses the contact."""
    found = swtstudy.solve(rtol=1e-2, **parameters)
    names = found.regime.attrs["flag_meanings"].split()
    assert names[int(found.regime)] == regime
    assert np.isfinite(found.s)


def test_xarray_labels_its_own_plots():
    """Short, in one line each, and with units where there are some: no [1]."""
    pytest.importorskip("matplotlib.pyplot")
    from matplotlib.figure import Figure

    found = swtstudy.solve(phase=[0.0, 1.0, 2.0], flat_radius=[0.1, 0.5], profile="rounded_punch", rtol=1e-2)
    axes = Figure().subplots()
    found.s.plot.line(x="phase", ax=axes, add_legend=False)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("phase [rad]", "SWT parameter SWT/SWT0")
    axes = Figure().subplots()
    found.critical_angle.isel(phase=0).plot(ax=axes)
    assert axes.get_ylabel() == "critical plane angle [degree]"
    assert "\n" not in axes.get_xlabel()
    assert "[" not in axes.get_xlabel()
