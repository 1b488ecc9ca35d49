"""Numbers that are no numbers of a computer, masked ones, and texts nested without end."""

import json
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import stand_in
from told import refused

import swtstudy
from swtstudy import LoadPath, Study, StudyError, TabulatedProfile, open_results, run

HUGE = 10**400
R = np.linspace(0.0, 3.0, 9)
SQUARE = [[0.0, -1.0], [0.5, -1.0], [0.5, 1.0], [0.0, 1.0]]


@pytest.mark.parametrize("number", [HUGE, -HUGE, 1e300, 1e101, float("nan")])
def test_vertices_that_cannot_be_computed_with(number: float) -> None:
    vertices = [[0.0, 1.0], [number, 0.0], [0.0, -1.0]]
    words = r"vertices of a, number 2: found .*allowed: finite numbers, in magnitude"
    refused(words, LoadPath, "a", vertices)
    refused("allowed: rows of order", LoadPath.harmonic_sum, "a", [(1, number, 0.0)], [(1, 1.0, 0.0)])
    refused("allowed: rows of order", LoadPath.harmonic_sum, "a", [(number, 1.0, 0.0)], [(1, 1.0, 0.0)])


@pytest.mark.parametrize("kind", ["vertices", "radius", "normal"])
def test_integers_of_many_digits_in_a_study(kind: str) -> None:
    tables = {
        "vertices": f"[loads.a]\nvertices = [[0, 1], [0, {HUGE}]]",
        "normal": f"[loads.a]\nnormal = [[1, {HUGE}, 0]]\ntangential = [[1, 1, 0]]",
        "radius": f"[profiles.a]\nradius = {[*range(7), HUGE]}\nheight = [0, 1, 4, 9, 16, 25, 36, 49]",
    }
    error = refused("", Study.from_text, f'title = "t"\n{tables[kind]}\n')
    assert len(error.mistakes) == 1


@pytest.mark.parametrize(
    "vertices", [[[1e10, 1], [0, 0], [0, -1]], [[0, 1e10], [0, -1]], [[0, 1, 1e10], [0, -1, 0]]]
)
def test_loads_beside_which_the_mean_is_rounding(vertices: list[list[float]]) -> None:
    loop = LoadPath("rig", vertices)
    words = r"load: found 'rig' with a \w+( stress)? of 1e\+10; allowed: at most 1e\+09"
    refused(words, swtstudy.solve, load=loop)
    # Scaled, as by a unit, it is like any other.
    bulk = {"bulk_stress_amplitude": 1e-10} if loop.bulk_ends else {}
    small = swtstudy.solve(load=loop, normal_amplitude=1e-10, tangential_amplitude=1e-10, rtol=1e-2, **bulk)
    assert float(small.s_error) <= 1e-2 * float(small.s)
    rig: dict[str, Any] = {"young_modulus": 7e4, "poisson_ratio": 0.3, "radius": 50.0, "depth": 0.01}
    moving = {"friction": 0.5, "normal_amplitude": 0.05, "tangential_amplitude": 0.05}
    with pytest.raises(StudyError, match=r"_amplitude: found .* at radius = 50, .*; allowed: at most"):
        swtstudy.physical(**rig, **moving, load=LoadPath("rig", 1e4 * np.array(vertices)))


def test_masked_values_are_no_data() -> None:
    mask = np.zeros((4, 2), bool)
    assert LoadPath("a", np.ma.array(SQUARE, mask=mask)) == LoadPath("a", SQUARE)
    mask[2, 0] = True
    refused(r"vertices of a, number 3: found \[nan, 1.0\]", LoadPath, "a", np.ma.array(SQUARE, mask=mask))
    with pytest.raises(StudyError, match=r"a.height: found nan at point .*; allowed: finite numbers"):
        TabulatedProfile("a", R, np.ma.array(R**2, mask=R == 3.0))
    with pytest.raises(StudyError, match=r"a.radius: found nan at point .*; allowed: finite numbers"):
        TabulatedProfile("a", np.ma.array(R, mask=R == 1.5), R**2)


@pytest.mark.parametrize(
    "values",
    [
        R**2 + 0j,
        (1e9 * R).astype("datetime64[s]"),
        (1e9 * R).astype("timedelta64[s]"),
        R > 0.0,
        [*"abcdefghi"],
    ],
)
def test_what_is_no_number_is_no_profile_and_no_loop(values: Any) -> None:
    refused(r"a.height: found no one-dimensional array of numbers", TabulatedProfile, "a", R, values)
    refused("allowed: a list of pairs of numbers", LoadPath, "a", np.reshape(values[:8], (4, 2)))


@pytest.mark.parametrize("scale", [3e150, 1e21, 1e-22, 1e-200, HUGE])
def test_profiles_of_no_size(scale: float) -> None:
    for radius, height in (([r * scale for r in range(9)], R**2), (R, [r * scale for r in range(9)])):
        with pytest.raises(StudyError):
            TabulatedProfile("a", radius, height)
    sound = TabulatedProfile("a", 1e20 * R / 3.0, 1e-20 * R**2 / 9.0)
    assert sound.refused_at(5e-21) is None


LOOP = 'title = "t"\nrtol = 1e-2\nfixed.load = "a"\naxes.friction = [0.1, 0.2]\n[loads.a]\nvertices = {}\n'
REAL = """
title = "t"
rtol = 1e-2
units = {length = "mm", force = "N", stress = "MPa"}
fixed = {young_modulus = 7e4, poisson_ratio = 0.3, radius = 50, depth = 0.01, tangential_amplitude = 1e-3}
axes.friction = [0.3, 0.4]
"""
DEEP = 5000 * "[" + 5000 * "]"


@pytest.mark.parametrize(
    ("text", "attribute", "value", "words"),
    [
        (LOOP.format(SQUARE), "definitions", None, "attribute definitions: .*finite numbers"),
        (LOOP.format(SQUARE), "definitions", DEEP, "attribute definitions: .*recursion limit exceeded"),
        (REAL, "contact", DEEP, "attribute contact: .*not a contact: Invalid JSON"),
        (REAL, "contact", '{"units": 1}', "attribute contact: .*not a contact"),
        (REAL, "contact", "similar", "attribute contact: .*not a contact"),
    ],
)
def test_attributes_of_an_archive(
    tmp_path: Path, text: str, attribute: str, value: str | None, words: str
) -> None:
    dataset = run(Study.from_text(text), tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    if attribute == "definitions" and value is None:
        raw = json.loads(dataset.attrs["definitions"])
        raw[0]["content"]["vertices"][0][0] = HUGE
        value = json.dumps(raw)
    if value == "similar":
        value = json.dumps(json.loads(dataset.attrs["contact"]) | {"similar": HUGE})
    dataset.attrs[attribute] = value
    dataset.to_netcdf(tmp_path / "a.nc")
    with pytest.raises(ValueError, match=words):
        open_results(tmp_path / "a.nc")


@pytest.mark.parametrize("other", ["[0.5]", "{start = 0.1, stop = 1, num = 500000}"])
def test_axes_that_are_too_long_only_together_are_told_of_at_once(other: str) -> None:
    text = f'title = "t"\n[axes]\nphase = {{start = 0, stop = 1, num = 1000000}}\nfriction = {other}'
    begin = time.process_time()
    refused(r"axes.phase, axes.friction: .* at most 1000000 values along all axes", Study.from_text, text)
    assert time.process_time() - begin < 1.0
