"""Names in results, and their least and greatest values, for any selection."""

import numpy as np
import pytest
import xarray as xr
from made_up import made_up
from matplotlib.figure import Figure
from xarray.plot.utils import label_from_attrs

import swtstudy
from swtstudy.results.evaluate import slice_at, to_table
from swtstudy.study.figure import VARIABLES
from swtstudy.vocabulary.parameters import PAIRS, PARAMETERS
from swtstudy.vocabulary.variables import ATTRIBUTES

PHASE = np.linspace(0, np.pi, 37)


@pytest.fixture
def waves():
    """s is greatest at ψ = 1 + friction and least at an end."""
    return made_up(lambda phase, friction: 2 + np.cos(phase - 1 - friction), phase=PHASE, friction=[0.5, 1.0])


def test_every_variable_and_parameter_has_a_label_of_one_line():
    shapes = {"flat_radius": 0.5, "waviness_amplitude": 0.01, "wavelength": 5, "exponent": 3}
    profiles = ["rounded_punch", "wavy_paraboloid", "power_law"]
    shapes |= {"criterion": "findley"}
    optional = {name: 0.25 for name, row in PARAMETERS.items() if row.optional and row.kind == "number"}
    del optional["walker_exponent"]
    dataset = swtstudy.solve(profile=profiles, phase=[0, 1], rtol=1e-2, **shapes, **optional)
    # That of plane contacts goes with forces.
    without = (*PAIRS, "load", "flat_half_width", "walker_exponent")
    own = {name: parameter for name, parameter in PARAMETERS.items() if name not in without}
    assert {*own, "control"} == {*dataset.coords}
    named = [*dataset.variables.values()]
    named += [xr.Variable((), 0, attributes) for attributes in ATTRIBUTES.values()]
    for variable in named:
        label = label_from_attrs(xr.DataArray(variable))
        assert "\n" not in label
        assert len(label) > 4
    for name, parameter in own.items():
        assert dataset[name].attrs["comment"] == parameter.meaning
        # A number without a unit has none: xarray would show it as [1].
        unit = parameter.units if parameter.kind != "name" and parameter.units != "1" else None
        assert dataset[name].attrs.get("units") == unit


def test_xarrays_own_plot_says_what_it_shows():
    dataset = swtstudy.solve(phase=[0, 1, 2], rtol=1e-2)
    axes = Figure().subplots()
    dataset.s.plot(ax=axes)
    assert axes.get_xlabel() == "phase [rad]"
    assert axes.get_ylabel() == "SWT parameter SWT/SWT0"
    axes = Figure().subplots()
    dataset.critical_angle.plot(ax=axes)
    assert axes.get_ylabel() == "critical plane angle [degree]"


MARGINS = ("bulk_shift", "bulk_shift_ratio", "prescribed_force_ratio", "radius_ratio", "slide_ratio")


def test_what_a_reader_is_told_of_each_variable():
    units = {name: attributes.get("units") for name, attributes in ATTRIBUTES.items()}
    assert units == {
        "s": "1",
        "s_error": "1",
        "s_surface": "1",
        **dict.fromkeys(MARGINS, "1"),
        "critical_x": "1",
        "critical_angle": "degree",
        "regime": None,
        "stick_zone": None,
        "status": None,
        "run": "1",
        "message": None,
    }
    symbols = {
        name: attributes["symbol"] for name, attributes in ATTRIBUTES.items() if "symbol" in attributes
    }
    assert symbols == {
        "s": "s",
        "s_error": r"\Delta s",
        "s_surface": r"s_\mathrm{surface}",
        "bulk_shift": "e/a_H",
        "bulk_shift_ratio": "e/(a - c)",
        "prescribed_force_ratio": r"\max |F_x|/(\mu F_N)",
        "radius_ratio": r"a_\mathrm{max}/R",
        "slide_ratio": r"(u_\mathrm{A} - u_\mathrm{slip})/a_\mathrm{max}",
        "critical_x": "x/a_H",
        "critical_angle": r"\varphi",
    }
    meanings = "stick partial_slip gross_slip lift_off not_finite no_equilibrium"
    assert ATTRIBUTES["regime"]["flag_meanings"] == meanings
    assert ATTRIBUTES["regime"]["flag_values"].tolist() == [0, 1, 2, 3, 4, 5]
    assert ATTRIBUTES["status"]["flag_meanings"] == "computed failed missing"
    assert ATTRIBUTES["status"]["flag_values"].tolist() == [0, 1, 2]
    assert "a_H = sqrt(R delta0)" in ATTRIBUTES["critical_x"]["comment"]
    assert "SWT0 = E* delta0 / R" in ATTRIBUTES["s"]["comment"]
    # What is there with a bulk stress, with forces, with units or where points failed alone.
    assert {*ATTRIBUTES} - {*MARGINS, "stick_zone", "message"} == {*VARIABLES}


def test_extrema_are_values_of_s_and_places_of_the_dimension(waves):
    found = waves.swt.extrema("phase")
    s = 2 + np.cos(PHASE[:, None] - 1 - np.array([0.5, 1.0]))
    np.testing.assert_array_equal(found.minimum, s.min(axis=0))
    np.testing.assert_array_equal(found.maximum, s.max(axis=0))
    np.testing.assert_array_equal(found.at_maximum, PHASE[s.argmax(axis=0)])
    np.testing.assert_array_equal(found.at_minimum, PHASE[s.argmin(axis=0)])
    np.testing.assert_array_equal(found.ratio, s.max(axis=0) / s.min(axis=0))
    assert found.friction.values.tolist() == [0.5, 1.0]


def test_extrema_say_what_they_are():
    dataset = swtstudy.solve(phase=[0, 1, 2], rtol=1e-2)
    found = dataset.swt.extrema("phase")
    assert dataset.swt.extrema("phase", "critical_angle").minimum.attrs["units"] == "degree"
    names = {name: values.attrs["long_name"] for name, values in found.data_vars.items()}
    assert names == {
        "minimum": "minimum of s",
        "at_minimum": "phase of minimum s",
        "maximum": "maximum of s",
        "at_maximum": "phase of maximum s",
        "ratio": "maximum over minimum of s",
    }
    assert {name: values.attrs["units"] for name, values in found.data_vars.items()} == {
        "minimum": "1",
        "at_minimum": "rad",
        "maximum": "1",
        "at_maximum": "rad",
        "ratio": "1",
    }
    assert found.minimum.attrs["comment"] == "along phase"
    assert "ancillary_variables" not in found.minimum.attrs


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
    table = to_table(waves.isel(phase=[]))
    assert len(table) == 0
    assert list(table.columns) == list(to_table(waves).columns)


def test_no_values_are_no_slice(waves):
    with pytest.raises(ValueError, match=r"^friction: found \[\]; allowed: at least one value$"):
        slice_at(waves, {"friction": []})


def test_a_slice_is_the_value_or_the_values_in_the_order_that_was_asked_for(waves):
    one, two = (slice_at(waves, {"friction": value}) for value in (1, [1, "1/2"]))
    np.testing.assert_array_equal(one.s, waves.s[:, 1])
    np.testing.assert_array_equal(two.s, waves.s[:, ::-1])


def test_a_table_has_each_value_at_its_place(waves):
    waves = waves.assign(regime=waves.regime.astype(np.int8))
    waves.regime.attrs = {"flag_meanings": "stick partial_slip", "flag_values": [0, 1]}
    waves.regime[0, 1] = 0
    table = waves.isel(friction=1).swt.to_table()
    assert list(table.columns) == [
        "phase",
        "friction",
        "s",
        "s_error",
        "critical_x",
        "critical_angle",
        "regime",
    ]
    np.testing.assert_array_equal(table.s, waves.s[:, 1])
    np.testing.assert_array_equal(table.phase, PHASE)
    assert table.friction.tolist() == [1.0] * 37
    assert table.regime.tolist() == ["stick"] + 36 * ["partial_slip"]
