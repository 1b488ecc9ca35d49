"""Limits of the model that `swtstudy validate` tells before anything is computed."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from command import call
from real import UNITS

STUDY = f"""
title = "Limits"
{UNITS}[fixed]
young_modulus = 115e3
poisson_ratio = 0.32
normal_force = 250
friction = 0.5
"""


def told(folder: Path, text: str) -> str:
    """What `swtstudy validate` says of a sound study."""
    (folder / "mine.toml").write_text(text)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        done = call("validate", folder / "mine.toml")
    assert done.exit_code == 0, done.output
    assert "valid, " in done.output
    return " ".join(done.output.split())


def test_a_sound_contact_is_told_nothing_of(tmp_path: Path) -> None:
    words = told(tmp_path, STUDY + "radius = 25\ntangential_force_amplitude = 60\n")
    assert "validity" not in words
    assert "Warning" not in words


def test_a_tangential_force_above_friction_is_told(tmp_path: Path) -> None:
    words = told(tmp_path, STUDY + "radius = 25\n[axes]\ntangential_force_amplitude = [60, 150]\n")
    assert "validity: no equilibrium at 1 of 2 points: tangential_force_amplitude 150 N exceeds" in words


def test_a_radius_in_metres_is_told(tmp_path: Path) -> None:
    words = told(tmp_path, STUDY + "radius = 0.025\ntangential_force_amplitude = 60\n")
    assert "radius 0.025 mm is smaller than the contact (0.0418 mm)" in words
    assert "validity: contact too large for half-spaces: contact radius over R up to 1.67" in words


@pytest.mark.quick(1)
@pytest.mark.parametrize("face", [0.0, 0.2])
def test_heights_in_micrometres_are_told(tmp_path: Path, face: float) -> None:
    x = np.linspace(-2.0, 2.0, 201)
    z = np.maximum(np.abs(x) - face, 0.0) ** 2 / 50.0
    profile = '[profiles.pad]\nfile = "pad.csv"\ntwo_sided = true\n'
    given = (
        STUDY.replace("[fixed]", f'{profile}[fixed]\nprofile = "pad"') + "tangential_force_amplitude = 60\n"
    )
    for factor, wrong in ((1.0, False), (1e3, True)):
        np.savetxt(
            tmp_path / "pad.csv",
            np.stack([x, factor * z], 1),
            delimiter=",",
            header="position,height",
            comments="",
        )
        assert ("are heights and positions in one unit?" in told(tmp_path, given)) == wrong
