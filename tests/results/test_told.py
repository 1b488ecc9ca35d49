"""Datasets hold and say what is kept of them: variables, dimensions, words, units; so do messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import stand_in
import xarray as xr
from kept import Kept, told
from made_up import made_up
from solved import REGIMES

import swtstudy
from swtstudy.results.inspection import load_and_springs

POINT: dict[str, Any] = {"frequency_ratio": "1/2", "phase": 0.4, "normal_amplitude": 0.5, "friction": 0.5}
LOOP = swtstudy.LoadPath("loop", [[0, 1], [1, 0], [0, -1], [-1, 0]])
#: Pulled along, so that its stick zone moves.
PLANE: dict[str, Any] = {
    "profile": "cylinder",
    "normal_force_amplitude": 0.2,
    "tangential_force_amplitude": 0.3,
    "bulk_stress_amplitude": 0.1,
}
SHEAR: dict[str, Any] = {"criterion": "findley", "normal_sensitivity": 0.3}
CASES: dict[str, Callable[[], xr.Dataset]] = {
    "point": lambda: swtstudy.inspect_point(**POINT),
    "point_in_plane": lambda: swtstudy.inspect_point(**PLANE),
    "springs": lambda: load_and_springs(load=LOOP),
    "springs_of_forces": lambda: load_and_springs(normal_force_amplitude=0.3, tangential_force_amplitude=0.5),
    "stress": lambda: swtstudy.stress_field([-1.0, 0.5], 0.0, [0.0, 0.4], **POINT),
    "stress_at_times": lambda: swtstudy.stress_field(0.5, 0.1, 0.2, time=[0.0, 1.0, 2.0], load=LOOP),
    "swt": lambda: swtstudy.swt_field([-1.0, 0.5], 0.1, [0.0, 0.4], **POINT),
    "findley": lambda: swtstudy.swt_field([-1.0, 0.5], 0.1, 0.3, **SHEAR),
    "slip": lambda: swtstudy.slip_map([-0.9, 0.0, 0.4, 0.9], **PLANE),
    "slip_at_a_time": lambda: swtstudy.slip_map(0.3, time=1.0, **POINT),
}


@pytest.mark.parametrize("name", CASES)
def test_fields_and_points(name: str, kept: Kept) -> None:
    kept(f"told_{name}", told(CASES[name]()))


def some() -> xr.Dataset:
    found = made_up(
        lambda phase, profile: 2.0 + np.cos(phase) * (1.0 + (profile == "paraboloid")),
        phase=np.linspace(0.0, 3.0, 4),
        profile=["paraboloid", "rounded_punch"],
    )
    flags = {
        "flag_values": np.arange(len(REGIMES)),
        "flag_meanings": " ".join(REGIMES),
        "long_name": "regime",
    }
    regime = found.regime.astype(np.int8).assign_attrs(flags)
    regime[0, 0] = 2
    depths = found.s.expand_dims(direction=["depth", "critical_plane"]) * xr.DataArray(
        [1.0, 0.5], dims="direction"
    )
    return found.assign(regime=regime, s_point=depths)


def test_what_follows_from_results(kept: Kept) -> None:
    found = some()
    for name, each in {
        "extrema": found.swt.extrema("phase"),
        "extrema_of_names": found.swt.extrema("profile", "critical_x"),
        "ratio": found.swt.normalised("ψ=0").to_dataset(name="ratio"),
        "words": found.swt.words().to_dataset(name="words"),
        "table": found.swt.to_table().to_xarray(),
    }.items():
        kept(f"told_{name}", told(each))


def test_optima(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    found = swtstudy.optimise(over={"phase": (0, 4)}, rtol=1e-3)
    kept("told_optimum", told(found.drop_vars(["progress", "evaluations", "run"], errors="ignore")))


SAMPLE = """
title = "A sample"
[sample]
design = "saltelli"
size = 8
seed = 2
[sample.ranges]
friction = [0, 1]
phase = [0, 3]
[axes]
normal_amplitude = [0.25, 0.5]
"""


def test_indices(kept: Kept, tmp_path: Any) -> None:
    found = swtstudy.run(
        swtstudy.Study.from_text(SAMPLE), tmp_path / "a.nc", workers=1, solver=stand_in.smooth
    )
    kept("told_indices", told(swtstudy.sensitivity(found, ["s", "critical_x"], confidence=0.9, seed=3)))
    kept("told_indices_of_s", told(swtstudy.sensitivity(found.drop_attrs(deep=False))))


@pytest.mark.parametrize("criterion", ["swt", "fatemi_socie", "findley", "crossland"])
def test_histories(criterion: str, kept: Kept) -> None:
    stress = np.random.default_rng(5).normal(size=(2, 3, 7, 6)) * 100.0
    stress[0, 0] = -abs(stress[0, 0, :1])  # nothing changes
    if criterion == "swt":
        value, normal = swtstudy.swt_of_history(stress, 0.3, 2e5, 0.4)
    else:
        value, normal = swtstudy.criterion_of_history(stress, criterion, 1e-3 if "_" in criterion else 0.3)
    found = xr.Dataset({"value": (("a", "b"), value), "normal": (("a", "b", "axis"), normal)})
    kept(f"told_history_of_{criterion}", told(found))


def refusal(ask: Callable[[], object]) -> list[str]:
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        ask()
    return [str(each) for each in getattr(caught.value, "mistakes", ())] or [str(caught.value)]


#: Slides on and on, and bodies that never touch.
LOST = {"normal_force_amplitude": 0.9, "tangential_force_amplitude": 0.9}
REFUSED: dict[str, Callable[[], object]] = {
    "no forces": lambda: swtstudy.inspect_point(**LOST),
    "one force": lambda: swtstudy.inspect_point(tangential_force_amplitude=1.5),
    "pulls": lambda: swtstudy.stress_field(0, 0, 0, normal_force_amplitude=1.5),
    "never": lambda: swtstudy.inspect_point(
        normal_amplitude=0.5, load=swtstudy.LoadPath("up", [[-9, 0], [-8, 1]])
    ),
    "place": lambda: swtstudy.swt_field("a", np.inf, []),
    "places": lambda: swtstudy.swt_field(np.zeros((2, 2)), 0, -1.5),
    "height": lambda: swtstudy.swt_field(0, 0, [0.5, -1.5]),
    "many": lambda: swtstudy.swt_field(np.zeros(10_001), 0, np.zeros(1000)),
    "apart": lambda: swtstudy.swt_field(
        xr.DataArray([0, 1], {"k": [0, 1]}, "k"), xr.DataArray([0, 1], {"k": [1, 2]}, "k"), 0
    ),
    "time": lambda: swtstudy.stress_field(
        xr.DataArray([0.0], dims="time"), xr.DataArray([0.0], dims="instant"), 0
    ),
    "instant": lambda: swtstudy.stress_field(0, 0, 0, time=[np.nan]),
    "instants": lambda: swtstudy.slip_map(0, time=[[0.0]]),
    "radius": lambda: swtstudy.slip_map([]),
    "parameters": lambda: swtstudy.slip_map(0, frictoin=1, phase="x"),
    "history": lambda: swtstudy.swt_of_history(np.zeros((3, 5)), 0.7, -1, 1.0),
    "gap": lambda: swtstudy.swt_of_history([[np.nan] * 6], 0.3, np.inf, 0.0),
    "criterion": lambda: swtstudy.criterion_of_history(np.zeros((0, 6)), "swt", -0.1),
    "endless": lambda: swtstudy.criterion_of_history(np.zeros((2, 6)), "findly", np.inf),
    "y": lambda: some().swt.extrema("phase", "S"),
    "flags": lambda: some().swt.extrema("phase", "regime"),
    "dim": lambda: some().swt.extrema("fase"),
    "ratio": lambda: some().swt.normalised("b"),
    "name": lambda: some().swt.words("s"),
    "slice": lambda: some().swt.slice(fase=0, phase=[], profile="cone", friction=1),
    "word": lambda: some().swt.slice(phase="2*", profile="wavy"),
    "over": lambda: swtstudy.optimise(
        over={"phase": 1, "fase": (0, 1), "friction": (0.1, 0.2)}, minimise="S", rtol=2
    ),
    "order": lambda: swtstudy.optimise(over={"phase": (1, 0), "friction": (0.3, 0.2)}, seed=-1),
    "nothing": lambda: swtstudy.optimise(over=3),
    "results": lambda: swtstudy.sensitivity(3),
    "level": lambda: swtstudy.sensitivity(some(), confidence=1.0),
    "seed": lambda: swtstudy.sensitivity(some(), seed=-1),
    "design": lambda: swtstudy.sensitivity(some()),
    "whole": lambda: swtstudy.sensitivity(
        xr.Dataset(
            coords={
                "sample": (
                    "sample",
                    [0, 1],
                    {"design": "saltelli", "parameters": "phase friction", "size": 1},
                )
            }
        )
    ),
}


def test_messages(kept: Kept) -> None:
    said = {name: refusal(ask) for name, ask in REFUSED.items()}
    said["apart"] = [words.partition(" (cannot")[0] for words in said["apart"]]  # xarray's own words
    kept("messages_of_results", said)
