import itertools
import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import stand_in
from command import call
from drawn import draw, keys
from made_up import PANELS, made_up
from matplotlib.markers import MarkerStyle

from swtstudy import Study, StudyError, open_results, run


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    path = tmp_path_factory.mktemp("panels") / "panels.nc"
    run(Study.from_text(PANELS), path, solver=stand_in.smooth)
    return path


@pytest.fixture
def panels(archive):
    return open_results(archive)


@pytest.fixture
def one_panel(panels):
    """For tests of what is the same of any figure."""
    return panels.isel(phase=0)


@pytest.mark.usefixtures("unwrapped")
@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".pdf", b"%PDF"), (".svg", b"<?xml"), (".PNG", b"\x89PNG")]
)
def test_the_ending_is_the_format(archive, tmp_path, suffix, start):
    done = call("plot", archive, "--at", "phase=0", "-o", tmp_path / f"figure{suffix}")
    assert done.exit_code == 0, done.output
    assert (tmp_path / f"figure{suffix}").read_bytes().startswith(start)


@pytest.mark.usefixtures("unwrapped")
def test_other_endings_are_refused(archive, tmp_path):
    done = call("plot", archive, "-o", tmp_path / "figure.docx")
    assert "found .docx; allowed: .png" in done.stderr


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("normal_amplitude", 0.1, "0.1"),
        ("normal_amplitude", 2 / 3, "2/3"),
        ("normal_amplitude", 0.1 + 0.2, "0.3"),
        ("frequency_ratio", 0.25, "1/4"),
        ("wavelength", 5.5, "5.5"),
        ("wavelength", 4.47213595, "4.472"),
        ("phase", -np.pi / 4, "-π/4"),
        ("phase", 1.234, "1.234"),
        ("profile", "wavy_paraboloid", "wavy paraboloid"),
    ],
)
@pytest.mark.usefixtures("unwrapped")
def test_values_in_words(name, value, words):
    values = np.array([value, "paraboloid" if name == "profile" else 2.0])
    dataset = made_up(lambda friction, **_: friction, friction=[0.1, 0.2], **{name: values})
    (legend,) = draw(dataset, keys("friction", name)).legends
    assert words in [text.get_text().rpartition(" = ")[2] for text in legend.get_texts()]


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


@pytest.mark.parametrize(("scale", "turned"), [("cividis", "cividis_r"), ("cividis_r", "cividis")])
def test_long_lives_are_dark_as_a_small_s_is(surface, scale, turned):
    surface["cycles"] = surface.s.assign_attrs(surface.s.attrs | {"symbol": "N"})
    layout = keys("phase", y=("s", "cycles"), kind="heatmap", vertical="normal_amplitude")
    with mpl.rc_context({"image.cmap": scale}):
        meshes = [axes.collections[0] for axes in draw(surface.isel(friction=0), layout).axes[:2]]
    assert [mesh.get_cmap().name for mesh in meshes] == [scale, turned]


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
def test_the_user_has_the_last_word_on_the_look(archive, one_panel, tmp_path):
    assert draw(one_panel, style={"lines.linewidth": 5.0}).axes[0].lines[0].get_linewidth() == 5.0
    with mpl.rc_context({"font.size": 6.0, "axes.prop_cycle": mpl.cycler(color=["r", "g"])}):
        lines = draw(one_panel).axes[0].lines
    assert [line.get_color() for line in lines] == ["r", "g", "r"]
    assert {line.get_linestyle() for line in lines} == {"-"}
    with pytest.raises(StudyError, match="style: found 'gray_scale'; allowed: did you mean grayscale"):
        draw(one_panel, style="gray_scale")
    for wrong in ({"nix": 3}, {"lines.linewidth": "thick"}):
        with pytest.raises(ValueError, match=r"style: found \{.*allowed: rcParams of matplotlib"):
            draw(one_panel, style=wrong)
    for name in ("one", "two"):
        call("plot", archive, "--at", "phase=0", "-o", tmp_path / f"{name}.svg")
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()


@pytest.mark.slow
@pytest.mark.usefixtures("unwrapped")
def test_lines_differ_in_greyscale():
    """Of any five neighbours in the cycle none have the same dashes; later ones differ in the marker."""
    loops = [f"loop {number}" for number in range(35)]
    dataset = made_up(lambda friction, load: friction, friction=[0.1, 0.2], load=loops)
    looks = draw(dataset, keys("friction", "load")).axes[0].lines
    dashes = [str(line._dash_pattern) for line in looks]
    assert all(len({*dashes[i : i + 5]}) == 5 for i in range(30))
    markers = [MarkerStyle(line.get_marker()).get_marker() for line in looks]
    assert len({*zip(dashes, markers, strict=True)}) == len(looks) == 35


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


@pytest.mark.slow
def test_long_labels_of_neighbours_do_not_touch_on_a_screen(tmp_path):
    results = run(Study.from_text(SENSITIVITY), tmp_path / "k.nc", solver=stand_in.smooth)
    figure = results.swt.figure()
    figure.draw_without_rendering()
    boxes = [axes.xaxis.label.get_window_extent() for axes in figure.axes]
    assert len(boxes) == 3
    for one, other in itertools.pairwise(boxes):
        assert one.x1 + 10.0 < other.x0
    assert boxes[-1].x1 < figure.bbox.x1
