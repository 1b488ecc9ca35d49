"""What figures draw of results, against the numbers that go in."""

import numpy as np
import pytest
import xarray as xr
from drawn import draw, keys
from made_up import made_up
from solved import REGIMES

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")


def results(function, **values):
    """Made-up results with the flags of the regime."""
    dataset = made_up(function, **values)
    return dataset.assign(
        regime=dataset.regime.assign_attrs(
            flag_values=np.arange(len(REGIMES)), flag_meanings=" ".join(REGIMES)
        )
    )


def test_a_line_is_drawn_in_the_order_of_x():
    dataset = results(lambda friction, phase: friction + phase, friction=[0.3, 0.1, 0.2], phase=[0.0, 1.0])
    (axes,) = draw(dataset, keys("friction", "phase")).axes
    for line, phase in zip(axes.lines, (0.0, 1.0), strict=True):
        assert line.get_xdata().tolist() == [0.1, 0.2, 0.3]
        np.testing.assert_allclose(line.get_ydata(), phase + np.array([0.1, 0.2, 0.3]))
    low, high = axes.get_xlim()
    assert 0.08 < low < 0.1 < 0.3 < high < 0.32  # room for the points of few, none on a line of many
    assert axes.get_xscale() == axes.get_yscale() == "linear"


@pytest.mark.parametrize(("share", "seen"), [(0.0039, False), (0.0041, True)])
def test_an_error_is_a_band_from_a_share_of_the_range_on(share, seen):
    dataset = results(lambda friction: friction, friction=[0.5, 1.0, 2.5])
    dataset["s_error"] = 0 * dataset.s + share * 2.0
    (axes,) = draw(dataset, keys("friction")).axes
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
    (axes,) = draw(dataset, keys("tangential_amplitude")).axes
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", scale)


def test_a_regime_is_marked_where_it_begins():
    dataset = results(lambda friction: 10.0 * friction, friction=np.arange(7.0))
    numbers = [*map(REGIMES.index, ("stick", "partial_slip", "gross_slip", "lift_off", "not_finite"))]
    unknown = [*numbers[:2], np.nan, *numbers[2:], numbers[-1]]
    dataset["regime"] = dataset.regime.copy(data=unknown)
    (axes,) = draw(dataset, keys("friction", regimes=True)).axes
    lines = [line for line in axes.lines if line.get_label().endswith(("begins", "from here on"))]
    marks = [(line.get_marker(), *map(float, (line.get_xdata()[0], line.get_ydata()[0]))) for line in lines]
    # What is not known begins nowhere; "not finite" is marked at the last point before it.
    assert marks == [("^", 1.0, 10.0), ("s", 4.0, 40.0), ("x", 4.0, 40.0)]
    words = [line.get_label() for line in lines]
    assert words == ["partial slip begins", "lift-off begins", "not finite from here on"]
    assert {line.get_color() for line in lines} == {"0.25"}  # of no line: the legend has one for all
    # On white, above lines: they are not buried where many come together.
    assert {line.get_markerfacecolor() for line in lines} == {"white"}
    assert min(line.get_zorder() for line in lines) > 2


@pytest.mark.parametrize(("end", "rotation"), [(4, 0), (5, 90)])
def test_where_no_line_has_a_value_is_said(end, rotation):
    """Of 0 to 6 one line ends at x = 2, one further on: beyond that there is none."""
    x = np.arange(7.0)
    dataset = results(
        lambda frequency_ratio, phase: frequency_ratio + phase, frequency_ratio=[0.5, 1.0], phase=x
    )
    dataset.regime[0, 3:] = dataset.regime[1, end + 1 :] = REGIMES.index("not_finite")
    dataset["s"] = dataset.s.where(dataset.regime == 1)
    layout = keys("phase", "frequency_ratio", regimes=True)
    (axes,) = draw(dataset, layout).axes
    (zone,) = axes.patches
    box = zone.get_extents().transformed(axes.transData.inverted())
    assert (box.x0, box.x1) == pytest.approx((end, axes.get_xlim()[1]))
    (words,) = axes.texts
    assert words.get_text() == "not finite"
    assert words.get_position()[0] == pytest.approx(0.5 * (box.x0 + box.x1))
    assert words.get_rotation() == rotation
    # A line that goes on leaves nothing to say.
    dataset.regime[1] = 1
    dataset["s"] = dataset.s.fillna(1.0)
    assert not draw(dataset, layout).axes[0].patches


@pytest.mark.parametrize("role", ["hue", "panels"])
@pytest.mark.parametrize("kind", ["lines", "heatmap"])
def test_a_place_on_the_axis_of_lines_or_panels(role, kind):
    """s over s at one of the lines is what the accessor says: each part alone lacks the place."""
    dataset = results(
        lambda friction, phase, normal_amplitude: friction + phase * friction**2 + normal_amplitude,
        friction=[0.5, 1.0],
        phase=[0.0, 1.0, 2.0],
        normal_amplitude=[0.25],
    )
    if kind == "heatmap" and role == "hue":
        pytest.skip("no lines")
    dataset = dataset.isel(normal_amplitude=0) if kind == "lines" else dataset
    y = "s/s(friction=0.5)"
    vertical = "normal_amplitude" if kind == "heatmap" else None
    layout = keys("phase", y=(y,), kind=kind, vertical=vertical, **{role: "friction"})
    panels = draw(dataset, layout).axes
    expected = dataset.swt.normalised("friction=0.5")
    assert float(expected.max()) > 2.0
    if kind == "lines":
        drawn = [line.get_ydata() for one in panels for line in one.lines]
    else:
        drawn = [np.asarray(one.collections[0].get_array()).ravel() for one in panels[:2]]
    np.testing.assert_array_equal(drawn, expected.transpose("friction", "phase", ...).values.reshape(2, 3))


def path_of(axes, label):
    return next(line.get_xydata() for line in axes.lines if line.get_label() == label)


def test_the_optimum_goes_through_the_end_of_a_period():
    """Least at ψ = 0.1 − 0.05 v, modulo the period π: it leaves at ψ = 0 and comes back below π."""
    v = np.linspace(0.0, 1.0, 11)
    phase = np.linspace(0.0, np.pi, 37)
    dataset = results(
        lambda friction, phase: 2 - np.cos(2 * (phase - 0.1 + 0.21 * friction)), friction=v, phase=phase
    )
    axes = draw(dataset, keys("phase", kind="contour", vertical="friction")).axes[0]
    path = path_of(axes, "minimum of $s$")
    path = path[np.isfinite(path[:, 0])]
    np.testing.assert_allclose(path[:, 1], v)
    # A parabola through points 5° apart misses the vertex of a cosine by less than 1e-3.
    np.testing.assert_allclose(path[:, 0], (0.1 - 0.21 * v) % np.pi, atol=1e-3)
    # Of what is no angle an end is an end.
    dataset = dataset.rename(phase="poisson_ratio").assign_coords(poisson_ratio=phase / 10)
    axes = draw(dataset, keys("poisson_ratio", kind="contour", vertical="friction")).axes[0]
    path = path_of(axes, "minimum of $s$")
    assert path[np.abs(path[:, 1] - 0.55) < 0.1, 0].tolist() == [0.0, 0.0]


def test_a_flat_row_and_a_few_rows_have_no_optimum():
    """s is flat at v = 0; at two rows the least is elsewhere."""
    v = np.linspace(0.0, 1.0, 31)
    shift = xr.DataArray(np.where((v > 0.39) & (v < 0.45), 1.8, 0.5), {"friction": v}, dims="friction")
    dataset = results(
        lambda friction, phase: 1 + (0.1 + friction) * (friction > 0) * (phase - shift) ** 2,
        friction=v,
        phase=np.linspace(0.0, 2.0, 21),
    )
    axes = draw(dataset, keys("phase", kind="contour", vertical="friction")).axes[0]
    path = path_of(axes, "minimum of $s$")
    path = path[np.isfinite(path[:, 0])]
    assert path[:, 1] == pytest.approx([*v[1:12], *v[14:]])
    np.testing.assert_allclose(path[:, 0], 0.5)


@pytest.mark.parametrize("kind", ["contour", "heatmap"])
def test_panels_have_scales_of_their_own_where_one_would_be_grey(kind):
    def scales(factor):
        dataset = results(
            lambda friction, phase, normal_amplitude: (
                1 + (phase + friction) * (1 + factor * normal_amplitude)
            ),
            friction=[0.1, 0.5, 1.0],
            phase=np.linspace(0.0, 2.0, 9),
            normal_amplitude=[0.0, 1.0],
        )
        layout = keys("phase", panels="normal_amplitude", kind=kind, vertical="friction")
        figure = draw(dataset, layout)
        assert [axes.get_title("left")[:3] for axes in figure.axes[:2]] == ["(A)", "(B)"]
        return [axes.collections[0].norm for axes in figure.axes[:2]], len(figure.axes)

    (one, other), count = scales(5.4)
    assert count == 3
    assert one is other
    (one, other), count = scales(5.6)
    assert count == 4
    assert one.vmax < 0.5 * other.vmax


def test_a_regime_of_one_point_and_unknown_ones_leave_a_border_straight():
    """One point of 1,600 has another regime, and beyond ψ = 35.5 nothing is known."""
    x = np.arange(40.0)
    dataset = results(lambda friction, phase: friction + phase, friction=1.0 + x, phase=x)
    flags = np.where(x > 35.5, np.nan, np.ones((40, 1)))
    flags[20, 7] = 2.0
    dataset["regime"] = dataset.regime.copy(data=flags)
    axes = draw(dataset, keys("phase", kind="contour", vertical="friction", regimes=True)).axes[0]
    assert "partial slip" in [text.get_text() for text in axes.texts]
    borders = [each.get_paths() for each in axes.collections if each.get_zorder() == 3]
    ends = np.concatenate([path.vertices[:, 0] for paths in borders for path in paths])
    np.testing.assert_allclose(ends, 35.5, atol=0.1)
