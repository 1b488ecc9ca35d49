import itertools
import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import stand_in
from drawn import draw, keys
from made_up import PANELS

from swtstudy import Study, StudyError, run
from swtstudy.figures.style import save_figure, style_of
from swtstudy.results.evaluate import quantity
from swtstudy.vocabulary.wording import value_words


@pytest.fixture(scope="module")
def known(tmp_path_factory):
    path = tmp_path_factory.mktemp("panels") / "panels.nc"
    return run(Study.from_text(PANELS), path, solver=stand_in.smooth)


@pytest.fixture
def panels(known):
    return known.copy(deep=True)


@pytest.fixture
def one_panel(panels):
    """For tests of what is the same of any figure."""
    return panels.isel(phase=0)


def test_lines_ticks_and_legend(small, tmp_path):
    figure = draw(run(small, tmp_path / "small.nc", solver=stand_in.smooth))
    (axes,) = figure.axes
    assert len(axes.lines) == 2
    assert axes.get_xlabel() == r"$\psi$ (rad)"
    assert axes.get_ylabel() == r"$s = \mathrm{SWT}/\mathrm{SWT}_0$"
    assert [tick.get_text() for tick in axes.get_xticklabels()] == ["0", "π/2", "π", "3π/2", "2π"]
    texts = [text.get_text() for text in figure.legends[0].get_texts()]
    assert texts == [r"$\delta_A/\delta_0$ = 0.25", r"$\delta_A/\delta_0$ = 8/9"]


@pytest.mark.usefixtures("unwrapped")
def test_panels_are_values_of_a_dimension_and_rows_are_quantities(panels):
    figure = draw(panels)
    assert len(figure.axes) == 4
    titles = [axes.get_title("left") for axes in figure.axes]
    ratio = "$s$ / $s$($b/a_H$ = 0)"
    assert titles == [
        r"(A)  $s$,  $\psi$ = 0",
        r"(B)  $s$,  $\psi$ = π",
        rf"(C)  {ratio},  $\psi$ = 0",
        rf"(D)  {ratio},  $\psi$ = π",
    ]
    assert figure.axes[2].get_ylabel() == "$s$ / $s$($b/a_H$ = 0)"
    assert all(line.get_ydata()[0] == 1 for line in figure.axes[2].lines)
    assert figure.get_suptitle() == "A title"
    np.testing.assert_array_equal(figure.axes[0].lines[1].get_ydata(), panels.s[0, 1])


@pytest.mark.usefixtures("unwrapped")
def test_lines_differ_in_colour_and_style(panels):
    lines = draw(panels).axes[0].lines
    assert len({line.get_color() for line in lines}) == len(lines)
    assert len({str(line.get_linestyle()) + str(line._dash_pattern) for line in lines}) == len(lines)


@pytest.mark.usefixtures("unwrapped")
@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".svg", b"<?xml"), (".PNG", b"\x89PNG")]
)
def test_the_ending_is_the_format(one_panel, tmp_path, suffix, start):
    save_figure(draw(one_panel), tmp_path / f"figure{suffix}")
    assert (tmp_path / f"figure{suffix}").read_bytes().startswith(start)


@pytest.mark.usefixtures("unwrapped")
def test_other_endings_are_refused(one_panel, tmp_path):
    with pytest.raises(ValueError, match=r"found \.docx; allowed: \.png"):
        save_figure(draw(one_panel), tmp_path / "figure.docx")


def test_what_cannot_be_drawn_is_refused(panels):
    with pytest.raises(ValueError, match="not an axis of these results"):
        draw(panels, keys(x="friction"))
    with pytest.raises(ValueError, match="no figure"):
        draw(panels.drop_attrs())


def test_the_reference_of_a_normalised_quantity(panels):
    ratio = quantity(panels, "s/s(flat_radius=0)")
    np.testing.assert_allclose(ratio * panels.s.isel(flat_radius=0), panels.s)


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("normal_amplitude", 0.1, "0.1"),
        ("normal_amplitude", 2 / 3, "2/3"),
        ("frequency_ratio", 0.25, "1/4"),
        ("wavelength", 5.5, "5.5"),
        ("wavelength", 4.47213595, "4.472"),
        ("phase", -np.pi / 4, "-π/4"),
        ("phase", 1.234, "1.234"),
        ("profile", "wavy_paraboloid", "wavy_paraboloid"),
    ],
)
def test_values_in_words(name, value, words):
    assert value_words(name, value) == words


SURFACE = """
title = "Surface"
[axes]
phase = {start = 0, stop = "pi", num = 13}
normal_amplitude = [0, 0.25, 0.5]
friction = [0.1, 0.3]
[figure]
kind = "contour"
x = "phase"
vertical = "normal_amplitude"
panels = "friction"
"""


@pytest.fixture
def surface(tmp_path):
    return run(Study.from_text(SURFACE), tmp_path / "surface.nc", solver=stand_in.smooth)


@pytest.mark.usefixtures("unwrapped")
def test_contours_with_the_optimum(surface):
    figure = draw(surface)
    # Two panels and the scale of colours of each: the first would have few colours on that of the other.
    assert len(figure.axes) == 4
    one = figure.axes[0]
    assert one.get_ylabel() == r"$\delta_A/\delta_0$"
    assert [tick.get_text() for tick in one.get_xticklabels()] == ["0", "π/4", "π/2", "3π/4", "π"]
    least = next(line for line in one.lines if line.get_label() == "least $s$")
    assert np.isfinite(least.get_xdata()).any()


def test_a_heat_map_has_a_cell_for_each_point(surface):
    layout = keys("friction", None, "phase", ("s",), None, "heatmap", "normal_amplitude")
    surface.s[0, 0, 0] = np.nan
    figure = draw(surface.isel(phase=[0, 1]), layout)
    (mesh,) = figure.axes[0].collections
    assert mesh.get_array().shape == (3, 2)
    assert mesh.get_array().mask.sum() == 1
    assert [tick.get_text() for tick in figure.axes[0].get_yticklabels()] == ["0", "0.25", "0.5"]


@pytest.mark.parametrize(("scale", "turned"), [("cividis", "cividis_r"), ("cividis_r", "cividis")])
def test_long_lives_are_dark_as_a_small_s_is(surface, scale, turned):
    surface["cycles"] = surface.s.assign_attrs(surface.s.attrs | {"symbol": "N"})
    layout = keys("phase", y=("s", "cycles"), kind="heatmap", vertical="normal_amplitude")
    with mpl.rc_context({"image.cmap": scale}):
        meshes = [axes.collections[0] for axes in draw(surface.isel(friction=0), layout).axes[:2]]
    assert [mesh.get_cmap().name for mesh in meshes] == [scale, turned]


@pytest.mark.parametrize(
    ("layout", "words"),
    [
        (keys("phase", kind="contour"), "vertical: found nothing"),
        (keys("phase", "friction", kind="heatmap", vertical="normal_amplitude"), "hue"),
        (keys("phase", vertical="friction"), "vertical"),
        (keys("phase", kind="pie"), "found 'pie'"),
        (keys("phase", y=()), "figure.y: found an empty list; allowed: at least one of"),
    ],
)
def test_roles_that_do_not_fit_the_kind_are_refused(surface, layout, words):
    with pytest.raises(ValueError, match=words):
        draw(surface, layout)


@pytest.mark.usefixtures("unwrapped")
def test_an_error_that_can_be_seen_is_a_band(small, tmp_path):
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth)
    dataset["s_error"] = 1e-6 * dataset.s
    assert not draw(dataset).axes[0].collections
    dataset["s_error"] = 0.05 * dataset.s
    band = draw(dataset).axes[0].collections[0].get_paths()[0].vertices
    s = dataset.s.isel(normal_amplitude=0)
    assert band[:, 1].max() == pytest.approx(1.05 * float(s.max()))


@pytest.mark.usefixtures("unwrapped")
def test_a_value_without_neighbours_is_a_dot_and_without_any_that_is_said(small, tmp_path):
    dataset = run(small, tmp_path / "small.nc", solver=stand_in.smooth).isel(normal_amplitude=0)
    one = dataset.isel(phase=[1])
    (axes,) = draw(one, keys(x="phase", y=("s",))).axes
    _, dot = axes.get_lines()
    assert dot.get_marker() == "o"
    np.testing.assert_array_equal(dot.get_ydata(), one.s.values.ravel())
    assert np.mean(axes.get_xlim()) == pytest.approx(float(one.phase[0]))
    (axes,) = draw(dataset.assign(s=np.nan * dataset.s), keys(x="phase", y=("s",))).axes
    assert [text.get_text() for text in axes.texts] == ["no value"]


@pytest.mark.usefixtures("unwrapped")
def test_the_user_has_the_last_word_on_the_look(one_panel, tmp_path):
    import matplotlib

    assert draw(one_panel, style={"lines.linewidth": 5.0}).axes[0].lines[0].get_linewidth() == 5.0
    with matplotlib.rc_context({"font.size": 6.0, "axes.prop_cycle": matplotlib.cycler(color=["r", "g"])}):
        lines = draw(one_panel).axes[0].lines
    assert [line.get_color() for line in lines] == ["r", "g", "r"]
    assert {line.get_linestyle() for line in lines} == {"-"}
    with pytest.raises(StudyError, match="style: found 'gray_scale'; allowed: did you mean grayscale"):
        draw(one_panel, style="gray_scale")
    for wrong in ({"nix": 3}, {"lines.linewidth": "thick"}):
        with pytest.raises(ValueError, match=r"style: found \{.*allowed: rcParams of matplotlib"):
            draw(one_panel, style=wrong)
    for name in ("one", "two"):
        save_figure(draw(one_panel), tmp_path / f"{name}.svg")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


def test_lines_differ_in_greyscale():
    """Of any five neighbours in the cycle none have the same dashes; later ones differ in the marker."""
    looks = list(style_of("screen")["axes.prop_cycle"])
    assert all(len({str(look["linestyle"]) for look in looks[i : i + 5]}) == 5 for i in range(30))
    assert len({(str(look["linestyle"]), look["marker"]) for look in looks}) == len(looks) == 35


@pytest.mark.slow
def test_a_notebook_shows_a_figure_without_pyplot(one_panel):
    formatters = pytest.importorskip("IPython.core.formatters")
    # Of its own, a formatter knows nothing of matplotlib.
    assert formatters.PNGFormatter()(draw(one_panel)).startswith(b"\x89PNG")


def test_pyplot_is_not_touched():
    package = Path(sys.modules["swtstudy"].__file__).parent
    assert not any(
        "pyplot" in path.read_text() and "import" in path.read_text().split("pyplot")[0][-20:]
        for path in package.rglob("*.py")
    )


@pytest.mark.usefixtures("unwrapped")
def test_regimes_are_marked_where_they_begin_and_long_ranges_are_logarithmic(tmp_path):
    text = """
title = "Regimes"
[axes]
normal_amplitude = [0.1, 0.75]
tangential_amplitude = {start = 1e-4, stop = 10, num = 6, spacing = "log"}
[figure]
x = "tangential_amplitude"
hue = "normal_amplitude"
regimes = true
"""
    results = run(Study.from_text(text), tmp_path / "regimes.nc")
    figure = draw(results)
    (axes,) = figure.axes
    assert axes.get_xscale() == "log"
    marks = [line for line in axes.lines if line.get_marker() == "o"]
    first = (results.regime.values == 2).argmax(axis=1)
    np.testing.assert_array_equal(
        [line.get_xdata()[0] for line in marks], results.tangential_amplitude[first]
    )
    assert [text.get_text() for text in figure.legends[0].get_texts()][-1] == "gross slip begins"
    assert len(figure.legends[0].get_texts()) == 4  # and where partial slip begins


SENSITIVITY = """
title = "A long label below each of three panels"
[fixed]
criterion = "findley"
[axes]
normal_sensitivity = [0.1, 0.2, 0.3]
phase = [0, 1, 2]
[figure]
x = "normal_sensitivity"
panels = "phase"
"""


def test_long_labels_of_neighbours_do_not_touch_on_a_screen(tmp_path):
    results = run(Study.from_text(SENSITIVITY), tmp_path / "k.nc", solver=stand_in.smooth)
    figure = results.swt.figure()
    figure.draw_without_rendering()
    boxes = [axes.xaxis.label.get_window_extent() for axes in figure.axes]
    assert len(boxes) == 3
    for one, other in itertools.pairwise(boxes):
        assert one.x1 + 10.0 < other.x0
    assert boxes[-1].x1 < figure.bbox.x1
