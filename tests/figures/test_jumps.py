"""Curves of places break where another maximum takes over; maps can be read on dark cells, ratios about 1."""

from collections.abc import Callable
from itertools import pairwise

import matplotlib.text
import numpy as np
import pytest
import xarray as xr
from drawn import draw, keys
from made_up import made_up
from matplotlib.axes import Axes

from swtstudy.figures.sheet import Figure, new_figure, wrap_texts

X = np.linspace(0.0, 2.0 * np.pi, 49)


def jumps_of(curve: np.ndarray, name: str = "critical_x", **attributes: str) -> list[int]:
    """The points at which the line of a quantity begins anew, each with a mark after a mark before it."""
    dataset = made_up(lambda phase: 1.0 + 0.0 * phase, phase=X[: len(curve)])
    dataset[name] = dataset.s.copy(data=curve).assign_attrs(attributes)
    _, *marks = draw(dataset, keys("phase", y=(name,))).axes[0].lines
    if not marks:
        return []
    at = np.searchsorted(X, marks[0].get_xdata()).tolist()
    assert [k + 1 for k in at[: len(at) // 2]] == at[len(at) // 2 :]
    return at[len(at) // 2 :]


@pytest.mark.parametrize(
    ("curve", "jumps"),
    [
        (np.where(X < 3.0, 1.0 - 0.01 * X, -1.0), [int(np.argmax(X >= 3.0))]),
        (np.cos(X), []),
        (np.tanh(4.0 * (X - np.pi)), []),  # steep, with steps of its length beside one another
        (np.full(49, 0.9), []),
        (np.where(X < 3.0, 1e10, 1e10 + 1e-5), []),  # a rounding
        (np.round(-0.95 - 0.002 * X, 3), []),  # steps of a tolerance
        (np.where(np.arange(49) == 20, 0.8, -0.9), [20, 21]),  # a point between two jumps
        (np.where(X < 1.0, np.nan, np.where(X < 4.0, 0.5, 0.9)), [int(np.argmax(X >= 4.0))]),
        (
            np.where(X < 2.0, 1.0, np.where(X < 5.0, 0.0, 1.0)),
            [int(np.argmax(X >= 2.0)), int(np.argmax(X >= 5.0))],
        ),
    ],
)
def test_a_jump_is_a_step_much_longer_than_those_beside_it(curve: np.ndarray, jumps: list[int]) -> None:
    assert jumps_of(curve) == jumps


def test_a_plane_at_90_degrees_is_that_at_minus_90() -> None:
    turning = (np.linspace(80.0, 100.0, 21) + 90.0) % 180.0 - 90.0
    assert np.ptp(turning) > 170.0
    assert jumps_of(turning, "critical_angle") == []
    assert len(jumps_of(turning)) == 1


def places() -> xr.Dataset:
    dataset = made_up(lambda phase: 1.0 + 0.0 * phase, phase=X)
    dataset["critical_x"] = dataset.critical_x.copy(data=np.where(X < 3.0, 0.9, -0.8))
    return dataset


def test_the_line_of_a_place_breaks_and_both_ends_are_marked() -> None:
    (axes,) = draw(places(), keys("phase", y=("critical_x",))).axes
    line, marks = axes.lines
    assert np.isnan(line.get_ydata()).sum() == 1
    assert marks.get_ydata() == pytest.approx([0.9, -0.8])
    assert marks.get_linestyle() == "None"
    (whole,) = draw(places(), keys("phase", y=("s",))).axes[0].lines
    assert np.isfinite(whole.get_ydata()).all()


def test_in_an_upright_figure_the_marks_are_at_the_ends_too() -> None:
    dataset = places()
    dataset["critical_x"] = np.exp(5.0 * dataset.critical_x).assign_attrs(dataset.critical_x.attrs)
    (axes,) = draw(dataset, keys("phase", y=("critical_x",), kind="life")).axes
    _, marks = axes.lines
    first = int(np.argmax(X >= 3.0))
    assert marks.get_xdata() == pytest.approx(np.exp([4.5, -4.0]))
    assert marks.get_ydata() == pytest.approx([X[first - 1], X[first]])


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [(2.0, 900.0, ["5", "10", "20"]), (6e4, 8e6, [r"$10^{5}$", r"$2\cdot10^{5}$", r"$5\cdot10^{5}$"])],
)
def test_numbers_of_a_short_logarithmic_axis_are_of_one_kind(
    low: float, high: float, words: list[str]
) -> None:
    dataset = made_up(lambda friction: friction, friction=np.geomspace(0.1, 1.0, 5))
    dataset["s"] = dataset.s.copy(data=np.geomspace(low, high, 5))
    (axes,) = draw(dataset, keys("friction")).axes
    axes.figure.draw_without_rendering()
    shown = [text.get_text() for text in axes.get_yticklabels()]
    at = shown.index(words[0])
    assert shown[at : at + 3] == words
    assert len({"$" in each for each in shown}) == 1


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("low", "high"), [(0.25, 0.71), (0.12, 8.0), (510.0, 640.0), (1.2e6, 1.8e6), (1.3e5, 1.4e7), (6e5, 5e9)]
)
def test_numbers_of_a_life_have_room(low: float, high: float) -> None:
    dataset = places()
    values = np.geomspace(low, high, dataset.critical_x.size)
    dataset["critical_x"] = dataset.critical_x.copy(data=values.reshape(dataset.critical_x.shape))
    (axes,) = draw(dataset, keys("phase", y=("critical_x",), kind="life")).axes
    axes.figure.draw_without_rendering()
    ticks = [*axes.xaxis.get_major_ticks(), *axes.xaxis.get_minor_ticks()]
    ends = axes.get_xlim()
    shown = [tick.label1 for tick in ticks if ends[0] <= tick.get_loc() <= ends[1] and tick.label1.get_text()]
    assert len(shown) >= 2
    for label in shown:  # The digits of a number with a power are its own.
        digits, power, exponent = label.get_text().strip("$").partition(r"\cdot10^{")
        if power:
            value = float(digits) * 10.0 ** int(exponent.rstrip("}"))
            assert value == pytest.approx(label.get_position()[0])
    boxes = sorted((label.get_window_extent() for label in shown), key=lambda box: box.x0)
    assert all(one.x1 < other.x0 for one, other in pairwise(boxes))


def test_a_long_label_is_no_taller_than_its_panel() -> None:
    figure = Figure((4.0, 3.2))
    figure.width = None
    axes = figure.subplots()
    axes.set_ylabel("mean of SWT over a volume of the body, $\\mathrm{SWT}_V$ (MPa)")
    wrap_texts(figure)
    figure.draw_without_rendering()
    assert axes.yaxis.label.get_window_extent().height <= axes.bbox.height
    assert "\n" in axes.get_ylabel()


@pytest.mark.parametrize(
    "narrow",
    [
        lambda axes: axes.set_yticks([0.5], ["a long name beside the panel"]),
        lambda axes: axes.set_box_aspect(1.3),
    ],
    ids=["names", "aspect"],
)
def test_a_title_is_no_wider_than_the_panel_as_it_is_drawn(narrow: Callable[[Axes], object]) -> None:
    figure = new_figure((4.0, 3.2))
    axes = figure.subplots()
    title = axes.set_title("as many words as are wider than it", loc="left")
    narrow(axes)
    wrap_texts(figure)
    assert "\n" in title.get_text()
    figure.draw_without_rendering()
    assert title.get_window_extent().width <= axes.bbox.width


def test_a_title_may_end_above_the_end_of_the_last_number() -> None:
    figure = new_figure((4.0, 3.2))
    axes = figure.subplots()
    axes.set_xticks([1.0], ["the name of the last number"])
    title = axes.set_title("as many words as are wider than it", loc="left")
    wrap_texts(figure)
    assert "\n" not in title.get_text()
    figure.draw_without_rendering()
    assert axes.bbox.width < title.get_window_extent().width < axes.xaxis.get_tightbbox().x1 - axes.bbox.x0


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("critical_x", True),
        ("volume_x", True),
        ("critical_position", True),
        ("s", False),
        ("cycles", False),
        ("cycles_volume", False),  # the largest mean of all places
    ],
)
def test_which_quantities_are_places(name: str, place: bool) -> None:
    assert bool(jumps_of(np.where(X < 3.0, 0.9, 0.8), name)) is place


def luminance(colour: object) -> float:
    from matplotlib.colors import to_rgb

    return float(np.dot(np.array(to_rgb(colour)) ** 2.2, [0.2126, 0.7152, 0.0722]))  # type: ignore[arg-type]


def test_words_on_contours_differ_from_what_is_beneath_them() -> None:
    dataset = made_up(
        lambda phase, normal_amplitude: 1.0 + normal_amplitude * (1.0 + 0.2 * np.cos(phase)),
        phase=X,
        normal_amplitude=np.linspace(0.1, 0.9, 20),
    )
    figure = draw(dataset, keys("phase", kind="contour", vertical="normal_amplitude"))
    filled = next(each for each in figure.axes[0].collections if each.get_array() is not None)
    labels = [
        each
        for each in figure.axes[0].findobj(matplotlib.text.Text)
        if each.get_text().startswith(("1.", "2."))
    ]
    assert {each.get_color() for each in labels} == {(0.0, 0.0, 0.0), (1.0, 1.0, 1.0)}
    for each in labels:
        beneath = luminance(filled.to_rgba(float(each.get_text()))[:3])
        light, dark = sorted((luminance(each.get_color()), beneath), reverse=True)
        assert (light + 0.05) / (dark + 0.05) > 4.0, each.get_text()


def test_a_map_of_a_ratio_is_pale_where_it_is_1() -> None:
    dataset = made_up(
        lambda phase, normal_amplitude: 1.0 + normal_amplitude * np.sin(phase),
        phase=X,
        normal_amplitude=np.linspace(0.1, 0.9, 20),
    )
    layout = keys("phase", y=("s/s(phase=0)",), kind="heatmap", vertical="normal_amplitude")
    mesh = draw(dataset, layout).axes[0].collections[0]
    assert mesh.norm.vmin + mesh.norm.vmax == pytest.approx(2.0)
    assert luminance(mesh.to_rgba(1.0)[:3]) > 0.85
    assert max(luminance(mesh.to_rgba(end)[:3]) for end in mesh.get_clim()) < 0.15


@pytest.mark.parametrize("over", [("phase",), ()])
def test_a_line_breaks_where_the_stick_zone_is_of_another_model(over: tuple[str, ...]) -> None:
    dataset = made_up(lambda phase: np.cos(phase), phase=X)
    zone = np.where(X < 2.0, 1, 0).astype("i1") if over else np.int8(1)
    dataset["stick_zone"] = over, zone
    figure = draw(dataset, keys("phase"))
    line, *marks = figure.axes[0].lines
    assert int(np.isnan(line.get_ydata()).sum()) == len(marks) == len(over)
    words = [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert words == ["another model of the stick zone"] * len(over)
    for mark in marks:
        assert np.searchsorted(X, mark.get_xdata()).tolist() == [
            int(np.argmax(X >= 2.0)) - 1,
            int(np.argmax(X >= 2.0)),
        ]
