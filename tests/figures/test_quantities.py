"""How each quantity is drawn: values, places, names and colours."""

import numpy as np
import pytest
import xarray as xr
from folders import RESULTS
from made_up import made_up
from matplotlib.mathtext import MathTextParser

#: The tests look at what is drawn, not at its layout.
pytestmark = pytest.mark.usefixtures("unwrapped")

PHASE = np.linspace(0, np.pi, 13)
FRICTION = np.array([0.1, 0.2, 0.4])
REGIMES = ["stick", "partial slip", "gross slip", "lift off", "not finite", "no equilibrium"]


@pytest.fixture(scope="module")
def said():
    """What the archives say of each variable."""
    found = {}
    for path in sorted(RESULTS.glob("*.nc")):
        with xr.open_dataset(path) as results:
            found |= {str(name): values.attrs for name, values in results.variables.items()}
    return found


@pytest.fixture
def dataset(said):
    """Each variable over ψ and μ is another function, of which a sum of the two parameters is a part."""
    found = made_up(lambda phase, friction: 2 + phase + 5 * friction, phase=PHASE, friction=FRICTION)
    found = found.assign(s_surface=3 * found.s, s_error=1e-9 * found.s, critical_x=found.s - 4)
    found = found.assign(critical_angle=10 * found.s - 50)
    codes = np.zeros((13, 3), np.int8)
    codes[4:], codes[8:, 1:] = 1, 2
    found["regime"] = ("phase", "friction"), codes
    for name, values in found.data_vars.items():
        values.attrs = dict(said[name])
    return found


def test_every_symbol_is_a_formula(said):
    symbols = {attributes["symbol"] for attributes in said.values() if "symbol" in attributes}
    assert len(symbols) > 20
    for symbol in symbols:
        assert MathTextParser("path").parse(f"${symbol}$").width > 0


@pytest.mark.parametrize("name", ["s", "regime"])
def test_surfaces_do_not_depend_on_the_order_of_values(dataset, name):
    mixed = dataset.isel(phase=[5, 0, 12, *range(1, 5), *range(6, 12)], friction=[2, 0, 1])
    keys = {"vertical": "friction", "kind": "contour", "y": name}
    one, other = (each.swt.panels("phase", **keys).axes[0] for each in (dataset, mixed))
    assert one.get_xlim() == other.get_xlim()
    for first, second in zip(one.collections, other.collections, strict=True):
        np.testing.assert_array_equal(first.get_array(), second.get_array())
        for path, again in zip(first.get_paths(), second.get_paths(), strict=True):
            np.testing.assert_array_equal(path.vertices, again.vertices)


@pytest.mark.parametrize("kind", ["contour", "heatmap"])
def test_regimes_are_colours_with_names(dataset, kind):
    figure = dataset.swt.panels("phase", vertical="friction", kind=kind, y="regime")
    axes, bar = figure.axes
    (mesh,) = axes.collections
    np.testing.assert_array_equal(mesh.get_array(), dataset.regime.transpose())
    assert [tick.get_text() for tick in bar.get_yticklabels()] == REGIMES
    np.testing.assert_array_equal(bar.get_yticks(), range(6))
    assert bar.get_ylabel() == "regime"
    colours = [mesh.cmap(mesh.norm(code)) for code in range(5)]
    lightness = np.array(colours)[:, :3] @ [0.299, 0.587, 0.114]
    assert (np.diff(lightness) > 0.1).all()
    if kind == "contour":
        assert axes.get_xlim() == (0.0, np.pi)
        assert axes.get_ylim() == (0.1, 0.4)
        corners = mesh.get_coordinates()
        np.testing.assert_allclose(corners[0, 1:-1, 0], (PHASE[1:] + PHASE[:-1]) / 2)
        np.testing.assert_allclose(corners[1:-1, 0, 1], [0.15, 0.3])


def test_points_that_are_missing_or_failed_have_no_regime(dataset):
    dataset["status"] = dataset.regime.copy(data=np.zeros((13, 3), np.int8))
    dataset.regime[5:7, 0], dataset.status[5, 0], dataset.status[6, 0] = 4, 1, 2
    figure = dataset.swt.panels("phase", vertical="friction", kind="heatmap", y="regime")
    assert np.argwhere(figure.axes[0].collections[0].get_array().mask).tolist() == [[0, 5], [0, 6]]
    (axes,) = dataset.swt.panels("phase", "friction", regimes=True).axes
    marks = [line for line in axes.lines if line.get_linestyle() == "None"]
    places = [(line.get_label(), *line.get_xydata()[0]) for line in marks]
    s = dataset.s.values
    assert places == [
        ("partial slip begins", PHASE[4], s[4, 0]),
        ("partial slip begins", PHASE[4], s[4, 1]),
        ("gross slip begins", PHASE[8], s[8, 1]),
        ("partial slip begins", PHASE[4], s[4, 2]),
        ("gross slip begins", PHASE[8], s[8, 2]),
    ]


def test_what_is_not_finite_leaves_the_scale_of_colours_alone(dataset):
    dataset.s[0, 0], dataset.s[1, 0] = np.inf, np.nan
    rest = dataset.s.values[np.isfinite(dataset.s.values)]
    for kind in ("contour", "heatmap"):
        figure = dataset.swt.panels("phase", vertical="friction", kind=kind)
        norm = figure.axes[0].collections[0].norm
        assert norm.vmin <= rest.min() < rest.max() <= norm.vmax < 20
        assert "no value" in [text.get_text() for text in figure.legends[0].get_texts()]
    everywhere = dataset.assign(s=np.nan * dataset.s)
    (axes,) = everywhere.swt.panels("phase", vertical="friction", kind="heatmap").axes  # no scale of colours
    assert axes.collections[0].get_array().mask.all()


def test_a_variable_of_ones_own_is_drawn(dataset):
    dataset["cycles"] = (1e4 / dataset.s).assign_attrs(units="kilocycles")
    dataset["alone"] = 0.0 * dataset.s.drop_attrs()
    figure = dataset.swt.panels("phase", "friction", y=["cycles", "alone"])
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert labels == ["cycles (kilocycles)", "alone"]
    np.testing.assert_array_equal(figure.axes[0].lines[1].get_ydata(), dataset.cycles[:, 1])
    found = dataset.swt.extrema("phase").swt.panels("friction", y=["ratio", "at_maximum"])
    assert [axes.get_ylabel() for axes in found.axes] == ["ratio", "at maximum"]
    np.testing.assert_array_equal(found.axes[0].lines[0].get_ydata(), dataset.s[-1] / dataset.s[0])
    np.testing.assert_array_equal(found.axes[1].lines[0].get_ydata(), np.pi)


def test_long_ranges_are_logarithmic_where_values_allow_it():
    friction = np.geomspace(1e-3, 10, 9)
    dataset = made_up(lambda friction: friction**2, friction=friction)
    dataset["critical_x"] = dataset.s * [-1, 1, 1, 1, 1, 1, 1, 1, 1]
    figure = dataset.swt.panels("friction", y=["s", "critical_x", "critical_angle"])
    assert [axes.get_xscale() for axes in figure.axes] == ["log"] * 3
    assert [axes.get_yscale() for axes in figure.axes] == ["log", "linear", "linear"]


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"y": "s/s(b=0)"}, "flat_radius"),
        ({"y": "s/s(ψ=9)"}, "phase: found 9"),
        ({"y": "s/s"}, "not a quantity"),
        ({"y": "name"}, "values of type"),
        ({"y": "path"}, "values over step"),
        ({"hue": None, "kind": "contour"}, "vertical: found nothing"),
        ({"kind": "heatmap", "vertical": "friction"}, "hue"),
        ({"vertical": "friction"}, "vertical"),
        ({"regimes": True}, "figure.regimes"),
    ],
)
def test_what_cannot_be_drawn_is_named(dataset, keys, words):
    dataset["name"] = dataset.s.astype(str)
    dataset["path"] = dataset.s.expand_dims(step=2)
    del dataset.regime.attrs["flag_meanings"]
    with pytest.raises(ValueError, match=words):
        dataset.swt.panels(**{"x": "phase", "hue": "friction", **keys})


def test_contours_of_a_single_value_are_refused_and_cells_are_not(dataset):
    single = dataset.isel(friction=[0])
    with pytest.raises(ValueError, match=r"figure.vertical: found friction with a single value"):
        single.swt.panels("phase", vertical="friction", kind="contour")
    assert len(single.swt.panels("phase", vertical="friction", kind="heatmap").axes) == 2


def test_a_single_point_has_no_figure(dataset):
    point = dataset.isel({dim: 0 for dim in dataset.s.dims}).drop_attrs(deep=False)
    for draw in (point.swt.figure, lambda: point.swt.panels("phase")):
        with pytest.raises(
            ValueError, match="a figure needs an axis of numbers; swtstudy show STUDY draws one point"
        ):
            draw()
    names = point.assign_coords(load="two").expand_dims("load")
    with pytest.raises(ValueError, match=r"figure\.x: found 'load'; allowed: an axis of numbers"):
        names.swt.panels("load")


def test_all_mistakes_of_a_layout_come_at_once(dataset):
    with pytest.raises(ValueError, match="pie") as caught:
        dataset.swt.panels("fase", "friction", kind="pie", y=["s", "speed"], title="$x^2^3$")
    assert len(str(caught.value).splitlines()) == 4
    assert isinstance(caught.value.mistakes, tuple)


def test_the_title_of_a_panel_is_a_whole_symbol(dataset) -> None:
    words = {"long_name": "load cycles", "symbol": r"N_{\mathrm{FS, volume}}", "units": "1"}
    dataset["FS_cycles_volume"] = dataset.s.drop_attrs().assign_attrs(words)
    figure = dataset.swt.panels("phase", "friction", y=["FS_cycles_volume", "s"])
    titles = [axes.get_title("left") for axes in figure.axes]
    assert titles == [r"(A)  $N_{\mathrm{FS, volume}}$", "(B)  $s$"]
