"""Figures look as what is kept of them: each line, word, colour and scale."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import real
import xarray as xr
from drawn import draw, keys
from kept import Kept, drawn
from made_up import made_up
from solved import REGIMES

import swtstudy
from swtstudy import Study, draw_load, draw_profile
from swtstudy.figures.live import LiveFigure
from swtstudy.figures.statistics import draw_fit, draw_sensitivity, fit_lines

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


@pytest.mark.parametrize("kind", ["scatter", "histogram"])
def test_figures_of_samples(kind: str, kept: Kept) -> None:
    whole = results().isel(normal_amplitude=0).assign_coords(phase=np.linspace(0.0, 2.0, 13))
    flat = whole.stack(sample=["friction", "profile"]).reset_index("sample")
    flat = flat.assign_coords(sample=np.arange(flat.sizes["sample"])).isel(phase=[0, 12])
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


REAL: dict[str, Any] = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "friction": 0.5, "radius": 50.0}


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
    contact = swtstudy.physical(**REAL, **given)
    kept(name, drawn(contact.inspect()))
    kept(f"{name}_profile", drawn(contact.draw_profile()))


R = np.linspace(0.0, 2.0, 40)
SHAPES: dict[str, dict[str, Any]] = {
    "face": {"profile": "rounded_punch", "flat_radius": 0.5},
    "waves": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5.0},
    "table": {"profile": swtstudy.TabulatedProfile("pad", R, 0.5 * R * R + 1e-3 * np.sin(30.0 * R), 2e-3)},
    "flat": {"profile": "rounded_flat", "flat_half_width": 3.0},
}


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
