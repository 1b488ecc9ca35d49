"""What figures draw of results, against the numbers that go in."""

import numpy as np
import pytest
import xarray as xr
from made_up import made_up
from matplotlib import colormaps
from matplotlib.figure import Figure

import swtstudy
from swtstudy.figures.draw import draw
from swtstudy.figures.maps import draw_slip_map, draw_stress_cycle, draw_swt_map
from swtstudy.figures.regimes import in_equal_ratios, mark_regimes
from swtstudy.figures.scale import hue_scale
from swtstudy.figures.style import STYLE
from swtstudy.figures.ticks import tick_in_pi
from swtstudy.mechanics.points import REGIMES
from swtstudy.study.figure import FigureLayout


@pytest.fixture
def axes():
    return Figure().subplots()


def results(function, **values):
    """Made-up results with the flags of the regime."""
    dataset = made_up(function, **values)
    return dataset.assign(regime=dataset.regime.assign_attrs(flag_meanings=" ".join(REGIMES)))


def test_a_line_is_drawn_in_the_order_of_x():
    dataset = results(lambda friction, phase: friction + phase, friction=[0.3, 0.1, 0.2], phase=[0.0, 1.0])
    (axes,) = draw(dataset, FigureLayout("friction", "phase")).axes
    for line, phase in zip(axes.lines, (0.0, 1.0), strict=True):
        assert line.get_xdata().tolist() == [0.1, 0.2, 0.3]
        np.testing.assert_allclose(line.get_ydata(), phase + np.array([0.1, 0.2, 0.3]))
    assert axes.get_xlim() == (0.1, 0.3)
    assert axes.get_xscale() == axes.get_yscale() == "linear"


@pytest.mark.parametrize(("share", "seen"), [(0.0039, False), (0.0041, True)])
def test_an_error_is_a_band_from_a_share_of_the_range_on(share, seen):
    dataset = results(lambda friction: friction, friction=[0.5, 1.0, 2.5])
    dataset["s_error"] = 0 * dataset.s + share * 2.0
    (axes,) = draw(dataset, FigureLayout("friction")).axes
    assert bool(axes.collections) == seen
    if seen:
        corners = axes.collections[0].get_paths()[0].vertices
        for x in (0.5, 1.0, 2.5):
            edges = corners[corners[:, 0] == x, 1]
            assert (edges.min(), edges.max()) == pytest.approx((x - share * 2.0, x + share * 2.0))


@pytest.mark.parametrize(("top", "scale"), [(99.0, "linear"), (101.0, "log")])
def test_long_ranges_are_logarithmic(top, scale):
    x = np.geomspace(1.0, 1000.0, 7)
    dataset = results(lambda tangential_amplitude: tangential_amplitude, tangential_amplitude=x)
    dataset["s"] = dataset.s.copy(data=np.linspace(1.0, top, 7))
    (axes,) = draw(dataset, FigureLayout("tangential_amplitude")).axes
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", scale)


def test_equal_ratios():
    assert in_equal_ratios(np.array([0.01, 0.1, 1.0]))
    assert not in_equal_ratios(np.array([0.0101, 0.1005, 1.0]))  # less than two decades
    assert not in_equal_ratios(np.array([0.01, 1.0]))
    assert not in_equal_ratios(np.array([0.0, 1.0, 100.0]))
    assert in_equal_ratios(np.geomspace(1e-3, 1.0, 4) * (1 + 1e-8 * np.arange(4) ** 2))
    assert not in_equal_ratios(np.geomspace(1e-3, 1.0, 4) * (1 + 1e-5 * np.arange(4) ** 2))


def test_a_regime_is_marked_where_it_begins(axes):
    x, s = np.arange(7.0), 10.0 * np.arange(7)
    regimes = ["stick", "partial_slip", None, "gross_slip", "lift_off", "not_finite", "not_finite"]
    mark_regimes(axes, x, s, regimes, "red")
    marks = [
        (line.get_marker(), *map(float, (line.get_xdata()[0], line.get_ydata()[0]))) for line in axes.lines
    ]
    # What is not known begins nowhere; "not finite" is marked at the last point before it.
    assert marks == [("^", 1.0, 10.0), ("s", 4.0, 40.0), ("x", 4.0, 40.0)]
    words = [line.get_label() for line in axes.lines]
    assert words == ["partial slip begins", "lift-off begins", "not finite from here on"]
    assert {line.get_color() for line in axes.lines} == {"red"}


def test_flags_are_steps_with_their_meanings():
    dataset = results(lambda friction: friction, friction=[0.1, 0.2, 0.3])
    dataset.regime[:] = [1, 2, 2]
    (axes,) = draw(dataset, FigureLayout("friction", y=("regime",))).axes
    assert axes.lines[0].get_drawstyle() == "steps-mid"
    assert axes.lines[0].get_ydata().tolist() == [1, 2, 2]
    assert [tick.get_text() for tick in axes.get_yticklabels()] == [
        name.replace("_", " ") for name in REGIMES
    ]
    assert axes.get_ylim() == (-0.5, 5.5)


def test_eight_values_have_a_scale():
    few, many = (xr.DataArray(np.linspace(2.0, 3.0, count), dims="friction") for count in (7, 8))
    assert hue_scale(few) is None
    scale = hue_scale(many[::-1])
    assert (scale.norm.vmin, scale.norm.vmax) == (2.0, 3.0)
    assert hue_scale(xr.DataArray(list("abcdefgh"), dims="profile")) is None
    logarithmic = hue_scale(xr.DataArray(np.geomspace(0.01, 1.0, 9), dims="friction"))
    assert logarithmic.norm(0.1) == pytest.approx(0.5)
    assert scale.norm(2.5) == pytest.approx(0.5)
    dataset = results(lambda friction, phase: friction + 0 * phase, friction=many.values, phase=[0.0, 1.0])
    figure = draw(dataset, FigureLayout("phase", "friction"))
    colours = [line.get_color() for line in figure.axes[0].lines]
    assert len({tuple(colour) for colour in colours}) == 8
    # Up to nine tenths of the map: its lightest end cannot be seen on white.
    expected = colormaps[STYLE["image.cmap"]](0.9 * np.linspace(0.0, 1.0, 8))
    np.testing.assert_allclose(colours, expected, atol=0.01)


def surface():
    """s = (x − v)² + 1 over phases x and frictions v: least at x = v."""
    return results(
        lambda friction, phase: 1 + (phase - friction) ** 2,
        friction=[0.5, 1.0, 1.5],
        phase=np.linspace(0.0, 2.0, 9),
    )


def test_contours_have_their_values_and_the_optimum():
    figure = draw(surface(), FigureLayout("phase", kind="contour", vertical="friction"))
    axes = figure.axes[0]
    lines = {line.get_label(): line for line in axes.lines}
    np.testing.assert_allclose(lines["least $s$"].get_xdata(), [0.5, 1.0, 1.5])
    assert lines["least $s$"].get_ydata().tolist() == [0.5, 1.0, 1.5]
    # The greatest leaps from x = 2 to x = 0: there it is broken.
    np.testing.assert_array_equal(lines["greatest $s$"].get_xdata(), [2.0, np.nan, 0.0])
    words = {text.get_text(): text.get_position() for text in axes.texts}
    assert words["57°"] == pytest.approx((1.0, 1.0))  # 1 rad
    filled = axes.collections[0]
    levels = filled.levels
    assert levels[0] <= 1.0
    assert levels[-1] >= 1 + 1.5**2
    assert 8 <= len(levels) <= 15


def test_cells_have_the_values_of_the_points():
    dataset = surface().isel(phase=slice(0, 4))
    figure = draw(dataset, FigureLayout("phase", kind="heatmap", vertical="friction"))
    (mesh,) = figure.axes[0].collections
    np.testing.assert_array_equal(np.asarray(mesh.get_array()).reshape(3, 4), dataset.s)
    assert (mesh.norm.vmin, mesh.norm.vmax) == (dataset.s.min(), dataset.s.max())
    assert [tick.get_text() for tick in figure.axes[0].get_yticklabels()] == ["0.5", "1", "1.5"]
    assert [tick.get_text() for tick in figure.axes[0].get_xticklabels()] == ["0", "0.25", "0.5", "0.75"]


def test_sizes_of_figures():
    dataset = results(lambda friction, phase: friction + phase, friction=[0.1, 0.2, 0.3], phase=[0.0, 1.0])
    for layout, size in (
        (FigureLayout("friction", None, "phase"), (8.0, 3.2)),
        (FigureLayout("friction", None, "phase", ("s", "critical_x")), (8.0, 6.4)),
        (FigureLayout("friction", kind="heatmap", vertical="phase"), (5.5, 3.2)),
    ):
        assert draw(dataset, layout).get_size_inches() == pytest.approx(size)


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (0.0, 1.5, ["0", "π/4", "π/2", "3π/4", "π", "5π/4", "3π/2"]),
        (0.0, 1.51, ["0", "π/2", "π", "3π/2"]),
        (-0.5, 2.5, ["-π/2", "0", "π/2", "π", "3π/2", "2π", "5π/2"]),
        (0.0, 6.0, ["0", "π", "2π", "3π", "4π", "5π", "6π"]),
        (0.0, 13.0, ["0", "3π", "6π", "9π", "12π"]),
        (0.1, 0.9, ["π/4", "π/2", "3π/4"]),
    ],
)
def test_ticks_in_pi(axes, low, high, words):
    tick_in_pi(axes.xaxis, low * np.pi, high * np.pi)
    assert [tick.get_text() for tick in axes.get_xticklabels()] == words


def test_map_of_swt(axes):
    field = swtstudy.swt_field([-1.0, 0.0, 1.0], 0.0, [0.1, 0.3])
    mesh = draw_swt_map(axes, field, highest=0.2)
    drawn = np.asarray(mesh.get_array()).reshape(2, 3)
    np.testing.assert_array_equal(drawn, field.s_local.transpose("z", "x"))
    assert mesh.get_clim() == (0.0, 0.2)
    assert axes.yaxis_inverted()
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("$x/a_H$", "$z/a_H$")
    assert mesh.get_coordinates()[..., 0].tolist() == [[-1.0, 0.0, 1.0]] * 2
    with pytest.raises(ValueError, match="found swt over x; allowed: two of x, y and z"):
        draw_swt_map(axes, field.isel(z=0), 0.2)


def test_stress_cycle_leaves_out_what_is_zero(axes):
    field = swtstudy.stress_field(0.5, 0.0, 0.2, time=np.linspace(0.0, 2 * np.pi, 7))
    draw_stress_cycle(axes, field)
    names = ["sigma_xx", "sigma_yy", "sigma_zz", "sigma_xz"]
    assert len(axes.lines) == 4
    drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
    for name in names:
        np.testing.assert_array_equal(drawn[f"${field[name].attrs['symbol']}$"], field[name])
    assert axes.get_xlim() == pytest.approx((0.0, 2 * np.pi))


def test_slip_map(axes):
    states = swtstudy.slip_map([0.2, 0.9, 1.4], time=[0.0, 1.0, 2.0, 3.0], phase=0.5)
    patches = draw_slip_map(axes, states)
    assert [patch.get_label() for patch in patches] == ["open", "stick", "forward slip", "backward slip"]
    (mesh,) = axes.collections
    drawn = np.asarray(mesh.get_array()).reshape(3, 4)
    np.testing.assert_array_equal(drawn, states.state.transpose("r", "time"))
    # Each state has the colour of its word.
    for code, patch in enumerate(patches):
        assert mesh.cmap(mesh.norm(code)) == patch.get_facecolor()
    np.testing.assert_array_equal(axes.lines[0].get_ydata(), states.contact_radius)


def test_places_of_the_optimum_are_labelled():
    """At five of thirteen heights, half a sixth from the ends on; at the frame on its inner side."""
    dataset = results(
        lambda friction, phase: 1 + (phase - friction) ** 2,
        friction=np.linspace(0.0, 1.2, 13),
        phase=np.linspace(0.0, 1.0, 41),
    )
    axes = draw(dataset, FigureLayout("phase", kind="contour", vertical="friction")).axes[0]
    labels = [text for text in axes.texts if text.get_text().endswith("°") and text.get_zorder() == 4]
    least = {text.get_position()[1]: text for text in labels[:5]}
    np.testing.assert_allclose(list(least), [0.2, 0.4, 0.6, 0.8, 1.0])
    for height, text in least.items():
        assert text.get_position()[0] == pytest.approx(height)
        assert text.get_text() == f"{np.degrees(height):.0f}°"
        assert text.get_ha() == ("right" if height > 0.96 else "center")
    greatest = labels[5:]
    assert [text.get_position()[0] for text in greatest] == [1.0, 1.0, 0.0, 0.0, 0.0]
    assert [text.get_ha() for text in greatest] == ["right", "right", "left", "left", "left"]
