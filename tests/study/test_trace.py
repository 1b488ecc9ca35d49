"""Traces of profilometers: two sides become one profile."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from folders import DATA
from told import RIG, refused, warned

import swtstudy
from swtstudy import read_trace

#: A sphere of R = 50, and a flat face of half-width 0.5 with rounded edges.
SHAPES = {"sphere": lambda x: x**2 / 100.0, "flat": lambda x: np.maximum(np.abs(x) - 0.5, 0.0) ** 2 / 20.0}


def trace(shape: str, noise: float, tilt: float, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Positions and heights about 0.13, at an offset of 3."""
    x = np.linspace(-2.0, 2.3, 861)
    error = noise * np.random.default_rng(seed).normal(size=x.size)
    return x, 3.0 + tilt * (x - 0.13) + SHAPES[shape](x - 0.13) + error


def write(path: Path, x: np.ndarray, z: np.ndarray, header: str = "position,height") -> Path:
    """A file of a trace; with semicolons between the headers numbers have a comma."""
    rows = "\n".join(f"{a!r};{b!r}" for a, b in zip(x.tolist(), z.tolist(), strict=True))
    text = rows.replace(".", ",") if ";" in header else rows.replace(";", ",")
    path.write_text(f"{header}\n{text}\n")
    return path


@pytest.fixture
def folded(tmp_path: Path) -> Callable[..., tuple[np.ndarray, np.ndarray, float]]:
    """Radii, heights and noise of a trace: what it is smoothed by unless more is needed."""

    def fold(x: np.ndarray, z: np.ndarray, level: bool) -> tuple[np.ndarray, np.ndarray, float]:
        found, _ = warned(read_trace, write(tmp_path / "fold.csv", x, z), level=level)
        return found.radius, found.height, found.smoothing

    return fold


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("tilt", [0.004, 0.0])
@pytest.mark.quick(1)
def test_tilt_offset_and_the_middle_are_found(folded: Any, shape: str, tilt: float) -> None:
    """A tilted parabola is one about another middle, with the same heights about it."""
    radius, height, noise = folded(*trace(shape, 0.0, tilt), level=True)
    np.testing.assert_allclose(height, SHAPES[shape](radius), atol=2e-5)
    assert noise < 1e-5
    if tilt:
        assert folded(*trace("flat", 0.0, tilt), level=False)[2] > 1e-4


def test_the_noise_is_that_of_the_mean_of_both_sides(folded: Any) -> None:
    radius, height, noise = folded(*trace("flat", 1e-4, 0.004), level=True)
    assert noise == pytest.approx(1e-4 / np.sqrt(2.0), rel=0.25)
    left = height[1:] - SHAPES["flat"](radius[1:])
    assert np.std(left) == pytest.approx(noise, rel=0.25)


@pytest.mark.slow
def test_one_grain_of_dust_in_the_middle_does_not_shift_all_heights(folded: Any) -> None:
    x, z = trace("flat", 0.0, 0.0)
    dust = np.where(np.abs(x - 0.13) < 0.003, 1e-3, 0.0)
    assert 0.0 < dust.sum() < 3e-3
    _, height, _ = folded(x, z, level=True)
    shifted = folded(x, z + dust, level=True)[1] - height
    assert np.abs(shifted[10:]).max() < 1e-4


@pytest.mark.slow
def test_a_trace_may_go_either_way(folded: Any) -> None:
    x, z = trace("flat", 1e-4, 0.004)
    np.testing.assert_allclose(folded(-x, z, level=True)[1], folded(x, z, level=True)[1], atol=1e-8)


def test_a_trace_is_a_profile_of_a_contact(tmp_path: Path) -> None:
    x, z = trace("sphere", 2e-5, 0.004)
    write(tmp_path / "ball.csv", x, z, "x [mm];z [mm]")
    columns = {"position": "x [mm]", "height": "z [mm]"}
    ball = read_trace(tmp_path / "ball.csv", columns=columns, separator=";", decimal=",")
    same = RIG | {"normal_force": 2000.0, "tangential_force_amplitude": 300.0}
    measured, exact = (swtstudy.physical(**same | own) for own in ({"profile": ball, "radius": None}, {}))
    assert measured.contact_radius == pytest.approx(exact.contact_radius, rel=0.01)


def test_a_trace_upside_down_is_named(tmp_path: Path) -> None:
    x, z = trace("sphere", 2e-5, 0.004)
    cap = write(tmp_path / "cap.csv", x, -z)
    refused("cap.csv: found heights that fall by .* scale = . height = -1 .", read_trace, cap)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_trace_of_one_side_is_told(tmp_path: Path, side: float) -> None:
    """With a flat face, too, of which both sides of some middle are alike."""
    radius = np.linspace(0.0, 1.0, 200)
    for height in (0.01 * radius**2, np.maximum(radius - 0.3, 0.0) ** 2):
        half = write(tmp_path / "half.csv", side * radius, height)
        for level in (True, False):
            refused("half.csv: found one side only: heights are lowest at an", read_trace, half, level=level)


def test_a_study_reads_a_trace_beside_tables_in_a_form_of_their_own(tmp_path: Path) -> None:
    x, z = trace("sphere", 2e-5, 0.004)
    write(tmp_path / "ball.csv", x, z, "x;height")
    text = """
title = "t"
[units]
length = "mm"
force = "N"
stress = "MPa"
[profiles.ball]
file = "ball.csv"
two_sided = true
columns = { position = "x" }
separator = ";"
decimal = ","
[fixed]
profile = "ball"
young_modulus = 73.1e3
poisson_ratio = 0.33
friction = 0.5
normal_force = 2000
tangential_force_amplitude = 300
"""
    study = swtstudy.Study.from_text(text, "s", tmp_path)
    (ball,) = study.grid.values("profile")
    given = {"columns": {"position": "x"}, "separator": ";", "decimal": ","}
    own = read_trace(tmp_path / "ball.csv", **given)
    assert ball == own
    # Between two samples there is less of it.
    assert 0.5e-5 * np.sqrt(2.0) < own.smoothing < 1.5e-5


def test_a_trace_at_one_position_is_told(tmp_path: Path) -> None:
    still = write(tmp_path / "still.csv", np.ones(40), np.zeros(40))
    refused("still.csv: found 40 points at one position; allowed: a trace", read_trace, still)


#: What the contacts of the tests below have in common: a contact radius of 0.7.
GIVEN = RIG | {"radius": None, "normal_force": 200.0}
GIVEN |= {"normal_force_amplitude": 20.0, "tangential_force_amplitude": 60.0, "phase": 1.0}
#: SWT of the clean trace of `pad`.
CLEAN = 0.28933


def pad() -> tuple[np.ndarray, np.ndarray]:
    """A trace across a flat with rounded edges: positions every 0.01, heights to 1e-8."""
    return np.loadtxt(DATA / "trace_of_pad.csv", delimiter=",", skiprows=1).T


def read(folder: Path, x: np.ndarray, z: np.ndarray) -> tuple[swtstudy.TabulatedProfile, list[str]]:
    """The profile of a trace, and what is told of it."""
    write(folder / "pad.csv", x.round(9), z.round(9))
    return warned(read_trace, folder / "pad.csv")


def swt(profile: swtstudy.TabulatedProfile) -> float:
    return swtstudy.physical(profile=profile, **GIVEN).solve(rtol=1e-3).SWT.values[0]


@pytest.fixture(scope="module")
def clean(tmp_path_factory: pytest.TempPathFactory) -> swtstudy.TabulatedProfile:
    """The profile of the trace with nothing on it."""
    profile, told = read(tmp_path_factory.mktemp("clean"), *pad())
    assert told == []
    return profile


def test_a_clean_trace_has_its_swt(clean: swtstudy.TabulatedProfile) -> None:
    assert swt(clean) == pytest.approx(CLEAN, rel=1e-3)


#: What lies on a trace, of so many samples.
LITTER = [("dust", 6), ("dust", 1), ("dust", 2), ("pit", 6), ("zero", 8), ("sentinel", 8)]
#: Quickly tested: all of it at one place.
QUICK = 0.8


@pytest.mark.parametrize(
    ("place", "kind", "samples"),
    [
        pytest.param(place, *litter, marks=[pytest.mark.slow] * (place != QUICK))
        for place in (-1.8, -0.9, 0.2, 0.8, 1.69)
        for litter in LITTER
    ],
)
def test_dust_pits_and_dropouts_anywhere_are_set_aside(
    tmp_path: Path, clean: swtstudy.TabulatedProfile, place: float, kind: str, samples: int
) -> None:
    x, z = pad()
    first = int(np.searchsorted(x, place))
    some = slice(first, first + samples)
    if kind in ("dust", "pit"):
        z[some] += 2e-3 if kind == "dust" else -2e-3
    else:
        z[some] = 0.0 if kind == "zero" else -9999.0
    profile, told = read(tmp_path, x, z)
    off = np.interp(clean.radius, profile.radius, profile.height) - clean.height
    assert np.abs(off[clean.radius < 0.8]).max() < 1e-6
    if (kind, place) != ("zero", 0.2):  # there the heights are 0
        lines = f"lines {first + 2} to {first + samples + 1}" if samples > 1 else f"line {first + 2}"
        plural = "s" * (samples > 1)
        words = f"{samples} sample{plural} set aside that the other side does not have: {lines}"
        assert told[0] == f"pad: {words} of the file"


@pytest.mark.slow
def test_dust_far_outside_of_the_contact_does_not_change_swt(tmp_path: Path) -> None:
    x, z = pad()
    z[367:373] += 2e-3
    assert swt(read(tmp_path, x, z)[0]) == pytest.approx(CLEAN, rel=1e-3)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("count", "shift"), [(101, 2.0), (201, 0.3333), (201, 2.0), (401, 0.01)])
def test_the_zero_of_positions_does_not_matter(tmp_path: Path, count: int, shift: float) -> None:
    x = np.linspace(-2.0, 2.0, count)
    profile, told = read(tmp_path, x + shift, x**2 / 100.0)
    assert told == []
    exact = swtstudy.physical(**GIVEN | {"radius": 50.0}).solve(rtol=1e-4).SWT.values[0]
    found = swtstudy.physical(profile=profile, **GIVEN).solve(rtol=1e-4).SWT.values[0]
    assert found == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(
    "place", [0.9, *(pytest.param(place, marks=pytest.mark.slow) for place in (-1.4, -0.6, -0.25, 0.3))]
)
def test_a_gap_is_told_and_bridged_by_the_other_side(tmp_path: Path, place: float) -> None:
    x, z = pad()
    lost = (x > place) & (x < place + 0.5)
    profile, told = read(tmp_path, x[~lost], z[~lost])
    assert len(told) == 1
    ends = x[np.flatnonzero(lost)[[0, -1]] + [-1, 1]]
    assert told[0] == (
        f"pad: a gap of {np.diff(ends)[0]:.4g} in the positions, from {ends[0]:.4g} to {ends[1]:.4g}, "
        "where most steps are 0.01: the heights there are unknown"
    )
    # A gap across the middle has no other side.
    assert swt(profile) == pytest.approx(CLEAN, rel=2e-3 if place * (place + 0.5) > 0.0 else 0.1)


def test_many_gaps_are_told_in_one_line(tmp_path: Path) -> None:
    x, z = pad()
    lost = np.zeros(x.size, bool)
    for first, samples in ((90, 9), (150, 12), (300, 7)):
        lost[first : first + samples] = True
    _, told = read(tmp_path, x[~lost], z[~lost])
    assert len(told) == 1
    assert re.match(
        r"pad: a gap of 0.13 in the positions, from .* to .*, and 2 more, none wider, where", told[0]
    )


@pytest.mark.parametrize("tilt", [4e-3, pytest.param(4e-4, marks=pytest.mark.slow)])
def test_a_tilt_of_a_worn_pad_changes_nothing(folded: Any, tilt: float) -> None:
    x, z = np.loadtxt(DATA / "trace_of_worn_pad.csv", delimiter=",", skiprows=1).T
    for one, two in zip(folded(x, z, level=True), folded(x, z + tilt * x, level=True), strict=True):
        np.testing.assert_allclose(two, one, atol=1e-6)


@pytest.mark.parametrize("degrees", [0.5, pytest.param(0.2, marks=pytest.mark.slow)])
def test_a_tilted_flat_has_its_middle_between_its_edges(folded: Any, degrees: float) -> None:
    """Its lowest heights are at an edge."""
    x = np.arange(-4.0, 4.0, 0.01)
    z = np.maximum(np.abs(x) - 1.0, 0.0) ** 2 / 160.0
    radius, height, _ = folded(x, z + np.tan(np.radians(degrees)) * x, level=True)
    np.testing.assert_allclose(height, np.maximum(radius - 1.0, 0.0) ** 2 / 160.0, atol=1e-6)


def test_the_edges_of_a_clean_flat_are_no_outliers(folded: Any) -> None:
    """Between samples lines miss a curved edge, and the face has nothing else to differ in."""
    x = np.linspace(-4.0, 4.0, 801) + 0.037
    radius, height, _ = folded(x, np.maximum(np.abs(x - 0.1) - 3.0, 0.0) ** 2 / 20.0, level=True)
    np.testing.assert_allclose(height, np.maximum(radius - 3.0, 0.0) ** 2 / 20.0, atol=1e-6)


@pytest.mark.parametrize(
    ("positions", "seeds"),
    [
        ("even", [5, 8]),
        ("random", [4]),
        *(pytest.param(each, range(12), marks=pytest.mark.slow) for each in ("even", "random")),
    ],
)
def test_noise_is_smoothed_whatever_its_chance(tmp_path: Path, positions: str, seeds: Sequence[int]) -> None:
    """A fit that misses less than the noise of the mean follows it, by some 10 % of SWT."""
    given = GIVEN | {
        "normal_force": 500.0,
        "normal_force_amplitude": 0.0,
        "tangential_force_amplitude": 150.0,
    }
    own = {"profile": "cylinder", "radius": 80.0}
    exact = float(swtstudy.physical(**given | own).solve(rtol=1e-3).SWT[0])
    for seed in seeds:
        generator = np.random.default_rng(seed)
        x = np.linspace(-4.0, 4.0, 401) if positions == "even" else generator.uniform(-4.0, 4.0, 401)
        path = write(tmp_path / "noisy.csv", x, x**2 / 160.0 + 2e-4 * generator.normal(size=x.size))
        noisy, _ = warned(read_trace, path, geometry="plane")
        found, told = warned(swtstudy.physical(**given | {"profile": noisy}).solve, rtol=1e-3)
        assert "its smoothing is" in told[0]
        assert float(found.SWT[0]) == pytest.approx(exact, rel=0.03)


def test_a_trace_of_which_much_is_unused_is_told(tmp_path: Path) -> None:
    x, z = pad()
    profile, told = read(tmp_path, x[x < 0.9], z[x < 0.9])
    assert len(told) == 1
    assert re.match(r"pad: the middle is at .*, so that only 6\d% of the trace has two sides", told[0])
    assert swt(profile) == pytest.approx(CLEAN, rel=2e-3)


@pytest.mark.quick(1)
@pytest.mark.parametrize("geometry", ["axisymmetric", "plane"])
def test_a_rough_trace_is_smoothed_to_one_contact_area(tmp_path: Path, geometry: str) -> None:
    """Smoothed by the difference of its sides alone, a wavy pad touches in several places."""
    words = (
        r"smoothing = .*, 3\.?\d* times the r.m.s. difference of both sides: with less it touches in several"
    )
    x, z = np.loadtxt(DATA / "trace_of_worn_pad.csv", delimiter=",", skiprows=1).T
    path = write(tmp_path / "wavy.csv", x, z + 1e-4 * np.cos(25.0 * (x + 0.0037)))
    with pytest.warns(UserWarning, match=words):
        found = read_trace(path, geometry=geometry)
    assert found.compact_radius >= 0.75
    less = read_trace(path, geometry=geometry, smoothing=found.smoothing / 1.3)
    assert less.compact_radius < 0.75
    assert found.smoothing < 2e-4


@pytest.mark.slow
@pytest.mark.parametrize("tilt", [3e-4, 0.0])
@pytest.mark.parametrize(
    ("half_width", "radius", "end", "noise"),
    [(1.0, 13.0, 2.0, 0.0), (1.0, 13.0, 2.0, 2e-5), (2.5, 2.0, 3.0, 2e-5), (2.5, 10.0, 3.5, 2e-5)],
)
def test_a_flat_face_with_noise_is_the_flat_face(
    tmp_path: Path, half_width: float, radius: float, end: float, noise: float, tilt: float
) -> None:
    """Only its edges tell where the middle of a flat face is."""
    x = np.arange(-end, end, 0.004)
    beyond = np.maximum(np.abs(x - 0.05) - half_width, 0.0)
    z = beyond**2 / (2.0 * radius) + noise * np.random.default_rng(4).normal(size=x.size) + tilt * x
    path = write(tmp_path / "flat.csv", x, z)
    given = GIVEN | {"normal_force": 400.0 * half_width, "normal_force_amplitude": 0.0}
    worn, told = warned(read_trace, path, geometry="plane")
    assert told == []
    own = {"profile": "rounded_flat", "radius": radius, "flat_half_width": half_width}
    found, exact = (swtstudy.physical(**given | each) for each in ({"profile": worn}, own))
    assert found.contact_radius == pytest.approx(exact.contact_radius, rel=0.003)
    one, two = (float(each.solve(rtol=1e-3).SWT[0]) for each in (found, exact))
    assert one == pytest.approx(two, rel=0.15 if noise else 0.01)


def recorded(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Traces with a tilt, sentinels above and below, grit, a gap, samples twice, and few heights."""
    if name == "worn":
        x, z = np.loadtxt(DATA / "trace_of_worn_pad.csv", delimiter=",", skiprows=1).T
        z += 4e-4 * x
        z[40:46], z[120] = 9999.0, -9999.0
        z[200:203] += 3e-3
    elif name == "gap":
        x, z = pad()
        z += 2e-5 * np.sin(37.0 * x) * np.cos(11.0 * x**2) - 1e-3 * x
        x, z = (np.delete(each, slice(90, 130)) for each in (x, z))
    elif name == "twice":
        x = np.concatenate([np.linspace(-1.5, 2.2, 301), np.linspace(-0.4, 0.6, 60)])
        z = 5.0 + (x - 0.1) ** 2 / 80.0
    elif name == "face":
        x = np.linspace(-2.0, 2.6, 161)
        z = np.maximum(np.abs(x - 0.2) - 0.7, 0.0) ** 2 / 30.0 + 1e-5 * np.cos(97.0 * x**2)
    else:
        x = np.linspace(-2.0, 2.0, 81)
        z = np.round(x**2 / 8.0, 1)
    return x, z


@pytest.mark.parametrize(
    ("name", "given", "expected"),
    [
        ("worn", {}, [125, 1.4989464, 0.0, 0.0011549955, 0.0153885796, 0.601687684, 3.82530465e-05]),
        ("gap", {}, [180, 1.98632787, 0.0, 1.33776698e-3, 0.0284367542, 1.45476148, 1.37281141e-5]),
        (
            "twice",
            {"level": False},
            [180, 1.59999988, 0.000483381313, 0.00359539244, 0.0319999948, 1.92536278, 3.62381983e-09],
        ),
        (
            "face",
            {"geometry": "plane"},
            [80, 2.20005143, 0.0, 1.21919509e-5, 0.0750067044, 1.38440675, 6.71426066e-6],
        ),
        ("coarse", {"smoothing": 1e-3}, [40, 2.0, 0.0, 0.1106532118, 0.500001962, 6.740553896, 1e-3]),
    ],
)
def test_a_trace_that_is_read_again_is_the_same_profile(
    tmp_path: Path, name: str, given: dict[str, Any], expected: list[float]
) -> None:
    """Else what an archive has of it would be computed again: the numbers are those of this version."""
    found, _ = warned(read_trace, write(tmp_path / "pad.csv", *recorded(name)), **given)
    count, height = len(found.radius), found.height
    told = [count, found.radius[-1], height[count // 8], height[count // 3], height[-1], height.sum()]
    assert [*told, found.smoothing] == pytest.approx(expected, rel=1e-7, abs=1e-11)
