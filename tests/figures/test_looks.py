"""Figures look as what is kept of them: each line, word, colour and scale."""

import sys
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pytest
import real
import xarray as xr
from drawn import draw, keys
from kept import Kept, colour, drawn, line_of
from made_up import made_up
from matplotlib import colormaps
from matplotlib.colors import LogNorm, Normalize
from matplotlib.transforms import IdentityTransform
from PIL import Image
from solved import REGIMES
from told import RIG

import swtstudy
from swtstudy import Study, StudyError, draw_load, draw_profile
from swtstudy.figures import point as panels
from swtstudy.figures.lines import hue_scale, in_equal_ratios
from swtstudy.figures.live import Explorer, LiveFigure, phases
from swtstudy.figures.sheet import LoopHandler, Sheet, new_figure
from swtstudy.figures.statistics import draw_fit, draw_sensitivity, fit_lines
from swtstudy.figures.style import style_of
from swtstudy.figures.surfaces import lowest, mark_cells
from swtstudy.figures.words import (
    is_life,
    power_words,
    quantity_words,
    tick_in_pi,
    tick_in_ratios,
    tick_names,
    title_words,
)
from swtstudy.results.inspection import load_and_springs

#: The layout of a figure depends on the sizes of letters.
pytestmark = pytest.mark.usefixtures("unwrapped")


def results() -> xr.Dataset:
    """Over four parameters: s, places that jump, lives with early and late ones, regimes, and first yield."""
    found = made_up(
        lambda friction, phase, normal_amplitude, profile: (
            1.0 + friction * (1.5 + np.cos(phase - friction)) + 2.0 * normal_amplitude * friction
        ),
        friction=np.geomspace(0.1, 1.6, 5),
        phase=np.linspace(0.0, 2.0 * np.pi, 13),
        normal_amplitude=[0.25, 0.75],
        profile=["paraboloid", "rounded_punch"],
    )
    dims, s = found.s.dims, found.s
    regime = (1 + (found.phase > 3.0) + 2 * (found.phase > 5.5) + 0 * s).transpose(*dims).astype(np.int8)
    flags = {
        "flag_values": np.arange(len(REGIMES)),
        "flag_meanings": " ".join(REGIMES),
        "long_name": "regime",
    }
    life = {"symbol": "N", "units": "1", "long_name": "load cycles"}
    lives = {
        f"cycles{end}": (by * 1e7 / s**8).assign_attrs(life)
        for end, by in (("", 1.0), ("_10", 0.3), ("_90", 4.0))
    }
    return (
        found.assign(
            regime=regime.assign_attrs(flags),
            s=s.where(regime < 4).assign_attrs(long_name="s"),
            s_error=0.05 * s,
            critical_x=xr.where(found.phase > 4.0, 1.0, -1.0 + 0.0 * s)
            .transpose(*dims)
            .assign_attrs(symbol="x/a_H", units="1"),
            yield_ratio=(s / 3.0).transpose(*dims),
            **lives,
        )
        .assign_coords(flat_radius=0.5)
        .assign_attrs(contact="{}")
    )


#: Layouts, and the places along all other axes.
LAYOUTS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "lines": (
        keys(
            "phase",
            "friction",
            "normal_amplitude",
            ("s", "critical_x", "s/s(phase=0)"),
            "A title",
            regimes=True,
            validity=True,
        ),
        {"profile": 0, "friction": [0, 2, 4]},
    ),
    "lines_of_many": (keys("friction", "phase", y=("s", "regime")), {"profile": 0, "normal_amplitude": 0}),
    "lines_of_lives": (keys("friction", "profile", y=("cycles",)), {"phase": 2, "normal_amplitude": 0}),
    "lives": (
        keys("friction", "normal_amplitude", "profile", ("cycles",), kind="life", validity=True),
        {"phase": 2},
    ),
    "contours": (
        keys(
            "phase",
            panels="normal_amplitude",
            kind="contour",
            vertical="friction",
            regimes=True,
            validity=True,
        ),
        {"profile": 0},
    ),
    "contours_of_lives": (
        keys(
            "phase", y=("cycles", "regime", "critical_x", "s/s(phase=0)"), kind="contour", vertical="friction"
        ),
        {"profile": 0, "normal_amplitude": 0},
    ),
    "cells": (
        keys(
            "phase", panels="profile", y=("s", "cycles"), kind="heatmap", vertical="friction", validity=True
        ),
        {"normal_amplitude": 0},
    ),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_figures_of_results(name: str, kept: Kept) -> None:
    layout, at = LAYOUTS[name]
    kept(name, drawn(draw(results().isel(at), layout)))


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", ["histogram", "scatter"])
def test_figures_of_samples(kind: str, kept: Kept) -> None:
    whole = results().isel(normal_amplitude=0).assign_coords(phase=np.linspace(0.0, 2.0, 13))
    flat = whole.stack(sample=["friction", "profile"]).reset_index("sample")
    flat = flat.assign_coords(sample=np.arange(flat.sizes["sample"])).isel(
        phase=[0, 12] if kind == "histogram" else [0, 2, 4, 6, 8, 10, 12]
    )
    role = {"hue": "phase"} if kind == "scatter" else {"panels": "phase"}
    layout = keys("sample", y=("s", "cycles", "regime"), kind=kind, validity=kind == "scatter", **role)
    kept(kind, drawn(draw(flat, layout)))
    if kind == "histogram":
        kept("histogram_of_one_panel", drawn(draw(flat, keys("sample", "phase", y=("s",), kind=kind))))


SCENES: dict[str, dict[str, Any]] = {
    "point": {"frequency_ratio": "1/2", "phase": 0.4, "normal_amplitude": 0.5, "friction": 0.5},
    "point_without_bound": {
        "profile": "truncated_paraboloid",
        "flat_radius": 1,
        "friction": 1.2,
        "phase": 1.5,
    },
    "point_in_plane": {
        "profile": "cylinder",
        "normal_force_amplitude": 0.0,
        "tangential_force_amplitude": 0.3,
        "bulk_stress_amplitude": 0.1,
    },
}


@pytest.mark.parametrize("name", SCENES)
def test_figures_of_points(name: str, kept: Kept) -> None:
    kept(name, drawn(swtstudy.inspect(**SCENES[name])))


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("real", {"normal_force": 200.0, "tangential_force_amplitude": 60.0, "bodies": ["pad", "rod"]}),
        (
            "real_in_plane",
            {
                "normal_force": 200.0, "tangential_force_amplitude": 60.0, "profile": "cylinder",
                "criterion": "fatemi_socie", "normal_sensitivity": 0.3, "yield_strength": 350.0,
            },
        ),
    ],
)  # fmt: skip
def test_figures_of_real_contacts(name: str, given: dict[str, Any], kept: Kept) -> None:
    contact = swtstudy.physical(**RIG, **given)
    kept(name, drawn(contact.inspect()))
    kept(f"{name}_profile", drawn(contact.draw_profile()))


R = np.linspace(0.0, 2.0, 40)
SHAPES: dict[str, dict[str, Any]] = {
    "table": {"profile": swtstudy.TabulatedProfile("pad", R, 0.5 * R * R + 1e-3 * np.sin(30.0 * R), 2e-3)},
    "flat": {"profile": "rounded_flat", "flat_half_width": 3.0},
    "face": {"profile": "rounded_punch", "flat_radius": 0.5},
    "waves": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5.0},
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SHAPES)
def test_figures_of_profiles(name: str, kept: Kept) -> None:
    kept(f"profile_{name}", drawn(draw_profile(**SHAPES[name])))


def test_figures_of_loads(kept: Kept, tmp_path: Path) -> None:
    cycle = np.array([[200, 0, 0], [220, 60, 30], [205, 20, 10], [190, -57, -30]])
    rows = (np.tile(cycle, (2, 1)) + 3.0 * np.sin(np.arange(24)).reshape(8, 3)).tolist()
    file = tmp_path / "rig.csv"
    file.write_text("\n".join(["normal,tangential,bulk", *(",".join(map(repr, row)) for row in rows)]))
    form = {"absolute": True, "recorded_cycles": 2}
    rig = real.RIG + '[loads.rig]\nfile = "rig.csv"\nabsolute = true\nrecorded_cycles = 2\n'
    signal = swtstudy.read_signal(file, **form)
    kept("load_of_rig", drawn(draw_load(Study.from_text(rig, "rig", tmp_path), "rig", signal)))
    smooth = (
        'title = "t"\nfixed.load = "mine"\n[loads.mine]\nnormal = [[1, 0.5, 0]]\ntangential = [[1, 0.3, 1]]\n'
    )
    kept("load_of_harmonics", drawn(draw_load(Study.from_text(smooth), "mine")))
    fixed = ("normal_force_amplitude = 0.5", "tangential_force_amplitude = 0.6", "friction = 0.4")
    forces = smooth.replace("[loads", "\n".join(["[fixed]", *fixed, 'load = "mine"', "[loads"]))
    forces = forces.replace('fixed.load = "mine"\n', "")
    kept("load_of_forces", drawn(draw_load(Study.from_text(forces), "mine")))


def test_figures_of_fits_and_indices(kept: Kept) -> None:
    test = {"test": [1, 2, 3, 4]}
    fitted = xr.Dataset(
        {
            "observed": ("test", [1e4, 1e5, 1e6, 1e7]),
            "predicted": ("test", [2e4, 0.5e5, 3e6, 1e8]),
            "runout": ("test", [0, 0, 0, 1]),
            "scatter": ((), 0.3),
            "within_2": ((), 2),
            "within_5": ((), 4),
        },
        test,
        {"confidence": 0.95},
    )
    for name, symbol, unit in (("critical_distance", r"\ell", "mm"), ("friction", r"\mu", "1")):
        for end, value in (("", 0.05), ("_low", 0.02), ("_high", 0.09)):
            fitted[f"{name}{end}"] = (), value, {"symbol": symbol, "units": unit}
    kept("fit", drawn(draw_fit(fitted)))
    kept("fit_of_cracks", drawn(draw_fit(fitted.isel(test=[0, 1, 2]).drop_vars("friction_low"))))
    assert fit_lines(fitted) == [
        "critical_distance = 0.05 mm (95 %: 0.02 to 0.09)",
        "friction = 0.05 (95 %: 0.02 to 0.09)",
        "scatter: a factor of 2",
        "of 4 tests 2 within a factor of 2, 4 within a factor of 5",
    ]
    shares = np.linspace(0.1, 0.8, 8).reshape(2, 2, 2)
    dims = ("quantity", "normal_amplitude", "parameter")
    ends = {"": 0.0, "_low": -0.05, "_high": 0.1}
    indices = xr.Dataset(
        {
            f"{name}{end}": (dims, shares + by)
            for name in ("first_order", "total")
            for end, by in ends.items()
        },
        {
            "quantity": ["s", "critical_x"],
            "normal_amplitude": [0.25, 0.5],
            "parameter": ["friction", "phase"],
        },
        {"title": "Indices of 50 % $x^2^3$"},
    ).assign_coords(symbol=("parameter", [r"\mu", r"\psi"]))
    kept("indices", drawn(draw_sensitivity(indices)))
    kept(
        "indices_of_one",
        drawn(draw_sensitivity(indices.isel(normal_amplitude=0, drop=True).assign_attrs(title="Shares"))),
    )


@pytest.mark.parametrize("name", ["live", "live_without_bound"])
def test_live_figures(name: str, kept: Kept) -> None:
    given: dict[str, Any] = {"phase": 1.0, "frequency_ratio": "1/2"}
    if name == "live_without_bound":
        given = {"profile": "truncated_paraboloid", "flat_radius": 0.5, "friction": 1.9}
    live = LiveFigure()
    live.redraw(**given)
    kept(name, drawn(live.figure))


def test_sliders(kept: Kept) -> None:
    """What they are called, from where to where they go, what is shown of them, and what they ask for."""
    pytest.importorskip("ipywidgets")
    explorer = Explorer()
    said: dict[str, Any] = {"caption": explorer.caption.value, "picture": explorer.picture.value[:4].hex()}
    for profile, control in (("wavy_paraboloid", "displacements"), ("paraboloid", "forces")):
        explorer.controls["control"].value, explorer.controls["profile"].value = control, profile
        for name, each in explorer.controls.items():
            ends = [getattr(each, end, 0.0) for end in ("min", "max", "step")]
            words = [each.description, each.tooltip, each.layout.display, each.layout.width]
            words += [each.style.description_width, getattr(each, "readout_format", "")]
            choices = [*map(str, getattr(each, "options", ()))]
            said[f"{name} of {control}"] = [*map(str, words), *map(float, ends), str(each.value), *choices]
        said[f"parameters of {control}"] = {name: str(each) for name, each in explorer.parameters.items()}
    said["refused"] = explorer.caption.value
    kept("sliders", said)


def test_without_widgets_there_are_no_sliders(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    with pytest.raises(ImportError, match=r'^sliders need the extra "live": pip install "swtstudy\[live\]"$'):
        Explorer()


def test_a_live_figure_is_saved_with_300_dots_per_inch(tmp_path: Path) -> None:
    live = LiveFigure()
    live.figure.set_size_inches(1.0, 0.5)
    live.save(tmp_path / "a.png")
    with Image.open(tmp_path / "a.png") as picture:
        assert picture.size == (300, 150)
    with Image.open(BytesIO(live.png())) as picture:
        assert picture.size == (80, 40)
    with Image.open(BytesIO(new_figure((1.0, 0.5))._repr_png_())) as picture:
        assert picture.size[0] == 100.0


@pytest.mark.parametrize("phase_of", [(1, 72), ("1/2", 72), ("4/3", 288), (3, 216), ("2/3", 144)])
def test_phases_of_a_live_figure(phase_of: tuple[Any, int]) -> None:
    ratio, count = phase_of
    np.testing.assert_allclose(phases(ratio), np.linspace(0.0, 2.0 * np.pi, count + 1))


#: Rows, panels of each, width and more of a sheet.
SHEETS: list[tuple[Any, ...]] = [
    *((1, count, width) for count in (1, 4, 7) for width in (None, "column", "page")),
    (4, 9, "column"),
    (1, 13, "column", (4.0, 3.2), 2.4, False),
    (1, 5, "page", (4.0, 3.2), 3.0),
    (1, 2, None, (20.0, 3.0)),
]


def test_sheets(kept: Kept) -> None:
    said: dict[str, Any] = {}
    for given in SHEETS:
        sheet = Sheet(*given)
        figure = sheet.figure(True)
        pads = figure.get_layout_engine().get()
        size = [*figure.get_size_inches(), *(pads[name] for name in ("w_pad", "h_pad", "wspace", "hspace"))]
        said[str(given)] = [sheet.across, [*map(float, size)], str(figure.width)]
    for share_x, share_y in (("all", "row"), ("row", "all"), ("none", "none")):
        sheet = Sheet(2, 4)
        figure = sheet.figure()
        axes = sheet.panels(figure, share_x, share_y)
        sheet.label_left(axes[0], "words")
        for name, one in zip("ABCDEFGH", axes.ravel(), strict=True):
            across = one.xaxis.get_tick_params()["labelbottom"], one.yaxis.get_tick_params()["labelleft"]
            joined = [other for other in axes.ravel() if one.get_shared_x_axes().joined(one, other)]
            beside = [other for other in axes.ravel() if one.get_shared_y_axes().joined(one, other)]
            place = one.get_subplotspec().get_geometry()
            said[f"{name} {share_x} {share_y}"] = [
                *place,
                *across,
                len(joined),
                len(beside),
                one.get_ylabel(),
            ]
    kept("sheets", said)
    with pytest.raises(StudyError) as caught:
        Sheet(1, 1, "screen")  # type: ignore[arg-type]
    assert str(caught.value) == 'width: found \'screen\'; allowed: "column", "page", or None for a screen'


def test_loops_in_a_legend(kept: Kept) -> None:
    loops = {
        "up": swtstudy.LoadPath("up", [[0, 1], [1, 0], [0, -1]]),
        "rest": swtstudy.LoadPath("rest", [[0, 1], [0, -1]]),
    }
    figure = new_figure((3.0, 3.0))
    axes = figure.subplots()
    lines = [axes.plot([0.0, 1.0], [0.0, 1.0], label=name, color="C1")[0] for name in ("up", "rest", "none")]
    legend = axes.legend()
    said = {}
    for line in lines:
        made = LoopHandler(loops).create_artists(
            legend, line, 1.0, 2.0, 100.0, 20.0, 8.0, IdentityTransform()
        )
        said[str(line.get_label())] = [line_of(each) for each in made]
    kept("loops_in_a_legend", said)


def test_words_and_ticks(kept: Kept) -> None:
    """Ticks in π, of ratios, of names and of flags; words of quantities and their titles."""
    figure = new_figure((3.0, 3.0))
    axes = figure.subplots()
    said: dict[str, Any] = {}
    for ends in (
        (0.0, 1.0),
        (0.0, 6.3),
        (-7.0, 9.0),
        (0.0, 10.0),
        (0.0, 40.0),
        (0.1, 4.7),
        (0.0, 1.5 * np.pi),
    ):
        tick_in_pi(axes.xaxis, *ends)
        said[f"π {ends}"] = [
            [float(f"{at:.6g}") for at in axes.get_xticks()],
            [t.get_text() for t in axes.get_xticklabels()],
        ]
    for ends in (
        (0.3, 4.0),
        (2.1, 4.6),
        (10.0, 9999.0),
        (1.0, 1000.0),
        (9e-6, 1e-3),
        (6e4, 8e6),
        (1e5, 2e6),
        (0.0, 3.0),
        (1e-5, 1e-4),
        (1e5, 1.3e5),
        (1.0, 2.0),
        (2.0, 5.0),
        (1e5, 1e7),
        (1.0, 999.0),
        (1e4, 1e5),
    ):
        for axis in (axes.xaxis, axes.yaxis):
            one = new_figure((3.0, 3.0)).subplots()
            one.set(xscale="log", yscale="log")
            own = one.xaxis if axis is axes.xaxis else one.yaxis
            (one.set_xlim if axis is axes.xaxis else one.set_ylim)(max(ends[0], 1e-9), ends[1])
            tick_in_ratios(own, *ends)
            inside = [at for at in own.get_majorticklocs() if ends[0] <= at <= ends[1]]
            said[f"{axis.axis_name} {ends}"] = [
                *own.get_major_formatter().format_ticks(inside),
                type(own.get_minor_formatter()).__name__,
            ]
    for count, letters in ((3, 4), (12, 4), (40, 2), (9, 40)):
        for axis, most in ((axes.xaxis, 9), (axes.yaxis, 20)):
            tick_names(axis, [f"{k % 7}" * letters for k in range(count)], most)
            said[f"names {count} {letters} {axis.axis_name}"] = [t.get_text() for t in axis.get_ticklabels()]
    said["powers"] = [
        power_words(value) for value in (-1.0, 0.0, 1.0, 2.0, 9.9999, 10.0, 5e6, 1e-7, 1234.0, 1000.0)
    ]
    said["life"] = [is_life({"symbol": "N_1"}), is_life({"symbol": "n"}), is_life({})]
    known = {
        "critical_x": {"symbol": "x/a_H", "units": "1", "long_name": "critical point x/a_H"},
        "critical_angle": {"symbol": r"\varphi", "units": "degree"},
        "critical_position": {"symbol": "x", "units": "mm", "long_name": "critical point"},
        "SWT": {"symbol": r"\mathrm{SWT}", "units": "MPa"},
        "SWT_volume": {"symbol": r"\mathrm{SWT}_V", "units": "MPa", "long_name": "mean"},
        "findley_usage": {"symbol": "f/f_0", "units": "1", "long_name": "usage"},
        "FS_cycles": {"symbol": "N_{FS}", "long_name": "rounds"},
        "mine": {"symbol": r"\varphi", "units": "a_b"},
        "plain_words": {},
        "s": {"criterion": "findley"},
    }
    for name, words in known.items():
        values = xr.DataArray(1.0, name=name, attrs=words)
        said[f"words of {name}"] = [quantity_words(values, name), title_words(values, name)]
    s = xr.DataArray(1.0, name="s")
    said["words of s"] += [
        quantity_words(s, "s"),
        quantity_words(s.assign_attrs(criterion="three"), "s"),
        title_words(s, " s "),
    ]
    said["words of s"] += [quantity_words(s, "s/s(phase=pi/2)"), quantity_words(s, "s/s(profile=cone)")]
    kept("words_and_ticks", said)


def test_styles(kept: Kept) -> None:
    kept(
        "styles",
        {name: {key: str(each) for key, each in style_of(name).items()} for name in ("screen", "print")},
    )


def test_a_map_of_one_regime_has_no_border() -> None:
    found = results().isel(profile=0, normal_amplitude=0, phase=[0, 1, 2])
    layout = keys("phase", kind="contour", vertical="friction", regimes=True)
    assert not [text for text in draw(found, layout).axes[0].texts if "slip" in text.get_text()]
    short = results().isel(profile=0, normal_amplitude=0, friction=0, phase=[0, 11])
    assert len(draw(short, keys("phase", y=("critical_x",))).axes[0].lines) == 1


def test_a_shape_without_sense_is_refused() -> None:
    with pytest.raises(StudyError, match=r"^flat_radius: found -1 \(out of range\); allowed: "):
        draw_profile(profile="rounded_punch", flat_radius=-1)


def test_values_in_equal_ratios() -> None:
    """A decade at least, and all ratios but a tenth are one."""
    ten = [*(2.0 ** np.arange(10)), 1000.0]
    for x, equal in (
        ([1.0, 10.0**0.5, 10.0], True),
        ([1.0, 9.9**0.5, 9.9], False),
        ([1.0, 100.0], False),
        ([0.0, 1.0, 100.0], False),
        ([-1.0, 1.0, 100.0], False),
        (ten, True),
        (np.geomspace(1e-3, 1.0, 4) * (1 + 1e-8 * np.arange(4) ** 2), True),
        (np.geomspace(1e-3, 1.0, 4) * (1 + 1e-5 * np.arange(4) ** 2), False),
        ([*ten, 2e4], False),
    ):
        assert in_equal_ratios(np.array(x)) is equal, x


def test_a_scale_is_for_eight_values_and_more() -> None:
    for values, kind in (
        (np.arange(7.0), None),
        (np.arange(8.0), Normalize),
        (np.arange(8), Normalize),
        (np.geomspace(10.0, 1.0, 8), LogNorm),
        (np.array([*"abcdefgh"]), None),
    ):
        scale = hue_scale(xr.DataArray(values, dims="x"))
        assert scale is kind or type(scale.norm) is kind
    (low, high), colours = scale_of(np.arange(8.0)).get_clim(), scale_of(np.arange(8.0)).cmap
    assert (low, high, colours.N) == (0.0, 7.0, 256)
    assert [colour(colours(end)) for end in (0.0, 1.0)] == [
        colour(colormaps["cividis"](end)) for end in (0.0, 0.9)
    ]


def scale_of(values: np.ndarray) -> Any:
    with matplotlib.rc_context({"image.cmap": "cividis"}):
        return hue_scale(xr.DataArray(values, dims="x"))


def test_clouds_and_histograms_of_much_and_of_nothing(kept: Kept) -> None:
    flat = results().stack(sample=["friction", "profile", "phase", "normal_amplitude"]).reset_index("sample")
    flat = flat.assign_coords(sample=np.arange(flat.sizes["sample"]))
    kept("scatter_of_many", drawn(draw(flat, keys("sample", y=("s",), kind="scatter"))))
    nothing = flat.isel(sample=[0, 1]).assign(s=lambda found: np.nan * found.s)
    kept("histogram_of_nothing", drawn(draw(nothing, keys("sample", y=("s",), kind="histogram"))))


def test_loads_with_means_of_their_own(kept: Kept) -> None:
    loops = "".join(
        f"[loads.{name}]\nabsolute = true\nvertices = [[{low}, -{pull}], [{high}, {pull}]]\n"
        for name, low, high, pull in (("one", 300, 320, 80), ("two", 200, 240, 50))
    )
    study = real.RIG.replace('load = "rig"', "") + loops + '[axes]\nload = ["one", "two"]\n'
    kept("load_of_two", drawn(draw_load(Study.from_text(study), "two")))
    with pytest.raises(StudyError) as caught:
        draw_load(Study.from_text(study), "tow")
    assert str(caught.value) == "load: found 'tow'; allowed: did you mean two? known: one, two"
    with pytest.raises(StudyError, match=r"^load: found 'one'; allowed: a loop$"):
        draw_load(Study.from_text('title = "t"'), "one")


@pytest.mark.parametrize("name", ["lost", "to_and_fro", "at_rest"])
def test_paths_of_loads(name: str, kept: Kept) -> None:
    """With a lost contact; with instants that have one place; with nothing that moves."""
    amplitudes = {"lost": (1.5, 0.8), "to_and_fro": (0.0, 0.4), "at_rest": (0.0, 0.0)}[name]
    given = dict(zip(("normal_amplitude", "tangential_amplitude"), amplitudes, strict=True))
    figure = new_figure((9.0, 3.0))
    axes = figure.subplots(1, 3)
    found = load_and_springs(**given, frequency_ratio="1/2")
    for one, draw_one in zip(
        axes, (panels.draw_load, panels.draw_load_plane, panels.draw_springs), strict=True
    ):
        draw_one(one, found)
    kept(f"path_{name}", drawn(figure))


def test_dots_of_large_maps_are_thinned(kept: Kept) -> None:
    rows, columns = np.mgrid[:40, :70]
    outside = xr.DataArray(rows + columns > 50, dims=("friction", "phase"), attrs={"long_name": "outside"})
    outside = outside.assign_coords(friction=np.linspace(0.0, 1.0, 40), phase=np.linspace(0.0, 2.0, 70))
    figure = new_figure((6.0, 3.0))
    one, other = figure.subplots(1, 2)
    mark_cells(one, outside, True)
    mark_cells(other, outside[:32, :33], False)
    kept("dots", drawn(figure))


def test_places_of_least_values() -> None:
    """Vertices of parabolas, walls at the ends, gaps where rows are flat, turns that close."""
    x = np.linspace(0.0, 2.0 * np.pi, 25)
    shifts = np.array([0.1, 0.2, 0.4, 0.6, 6.2])
    values = -np.cos(x - shifts[:, None])
    np.testing.assert_allclose(lowest(x, values, True), shifts, atol=3e-3)
    np.testing.assert_allclose(lowest(x, values, False)[:4], [0.1, 0.2, 0.4, 0.6], atol=0.14)
    x -= 2.0
    found = lowest(x, -np.cos(x - shifts[:, None]), True)
    np.testing.assert_allclose(found, [*shifts[:4], 6.2 - 2.0 * np.pi], atol=3e-3)
    odd = np.array([0.0, 1.0, 3.0, 4.0])
    rows = np.array(
        [(odd - 1.5) ** 2, (odd - 3.2) ** 2, odd, 4.0 - odd, 0.0 * odd, odd + np.nan, [1, np.nan, 0, 1]]
    )
    np.testing.assert_allclose(lowest(odd, rows, False), [1.5, 3.2, 0.0, 4.0, np.nan, np.nan, 3.0], atol=1e-9)
