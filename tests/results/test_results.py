"""Names in results, and their least and greatest values, for any selection."""

import numpy as np
import pytest
import xarray as xr
from command import call
from made_up import made_up
from xarray.plot.utils import label_from_attrs

import swtstudy

PHASE = np.linspace(0, np.pi, 37)


@pytest.fixture
def waves():
    """s is greatest at ψ = 1 + friction and least at an end."""
    return made_up(lambda phase, friction: 2 + np.cos(phase - 1 - friction), phase=PHASE, friction=[0.5, 1.0])


def test_every_variable_and_parameter_has_a_label_of_one_line():
    shapes = {"flat_radius": 0.5, "waviness_amplitude": 0.01, "wavelength": 5, "exponent": 3}
    profiles = ["rounded_punch", "wavy_paraboloid", "power_law"]
    own = {"criterion": "findley", "normal_sensitivity": 0.25}
    dataset = swtstudy.solve(profile=profiles, phase=[0, 1], rtol=1e-2, **shapes, **own)
    assert {*shapes, *own, "control", "poisson_ratio", "friction"} <= {*dataset.coords}
    for variable in dataset.variables.values():
        label = label_from_attrs(xr.DataArray(variable))
        assert "\n" not in label
        assert len(label) > 4
    # What each parameter is, as the command line lists it; a number without a unit has none.
    listed = " ".join(call("list", "--parameters").output.split())
    for name in {*dataset.coords} - {"control", "load"}:
        assert f" {name} {dataset[name].attrs['comment']}" in listed, name
        assert dataset[name].attrs.get("units") == ("rad" if name.endswith("phase") else None)


def test_extrema_are_values_of_s_and_places_of_the_dimension(waves):
    found = waves.swt.extrema("phase")
    s = 2 + np.cos(PHASE[:, None] - 1 - np.array([0.5, 1.0]))
    np.testing.assert_array_equal(found.minimum, s.min(axis=0))
    np.testing.assert_array_equal(found.maximum, s.max(axis=0))
    np.testing.assert_array_equal(found.at_maximum, PHASE[s.argmax(axis=0)])
    np.testing.assert_array_equal(found.at_minimum, PHASE[s.argmin(axis=0)])
    np.testing.assert_array_equal(found.ratio, s.max(axis=0) / s.min(axis=0))
    assert found.friction.values.tolist() == [0.5, 1.0]


def test_chunks_make_no_difference(waves):
    pieces = waves.chunk(phase=5)
    xr.testing.assert_identical(pieces.swt.extrema("phase"), waves.swt.extrema("phase"))
    xr.testing.assert_identical(pieces.swt.normalised("ψ=0").compute(), waves.swt.normalised("ψ=0"))
    assert pieces.swt.to_table().equals(waves.swt.to_table())
    drawn, expected = (each.swt.panels("phase", "friction").axes[0] for each in (pieces, waves))
    for line, other in zip(drawn.lines, expected.lines, strict=True):
        np.testing.assert_array_equal(line.get_xydata(), other.get_xydata())


@pytest.mark.parametrize(
    "look",
    [
        lambda empty: empty.swt.extrema("phase"),
        lambda empty: empty.swt.extrema("friction"),
        lambda empty: empty.swt.panels("phase", "friction"),
        lambda empty: empty.swt.panels("phase", vertical="friction", kind="contour"),
        lambda empty: empty.swt.panels("phase", vertical="friction", kind="heatmap"),
        lambda empty: empty.swt.normalised("ψ=0"),
        lambda empty: empty.swt.slice(phase=0),
    ],
)
def test_an_empty_selection_is_named(waves, look):
    with pytest.raises(ValueError, match=r"^these results are empty: no value is left of phase$"):
        look(waves.isel(phase=[]))


def test_a_table_of_nothing_has_the_columns(waves):
    table = waves.isel(phase=[]).swt.to_table()
    assert len(table) == 0
    assert list(table.columns) == list(waves.swt.to_table().columns)


def test_a_slice_is_the_value_or_the_values_in_the_order_that_was_asked_for(waves):
    one, two = (waves.swt.slice(friction=value) for value in (1, [1, "1/2"]))
    np.testing.assert_array_equal(one.s, waves.s[:, 1])
    np.testing.assert_array_equal(two.s, waves.s[:, ::-1])
