"""Values over critical distances about the place that has most of it."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
import pytest
from asking import study
from brute_shear import value_of
from numpy.testing import assert_allclose
from scenes import points

import swtstudy
from swtstudy.archive.netcdf import save
from swtstudy.mechanics.body.nonlocal_swt import nonlocal_swt
from swtstudy.mechanics.line.look import Look, Resolution
from swtstudy.mechanics.line.maximum import candidates
from swtstudy.mechanics.line.refine import refine
from swtstudy.mechanics.planes.through_y import coarse_swt
from swtstudy.mechanics.quantities import worst_means
from swtstudy.mechanics.solver import scenes, solve_points
from swtstudy.runner.workload import assess

#: Beside a jump of the critical point, of the contact of studies/life.toml.
JUMP = {"poisson_ratio": 0.33, "friction": 0.5, "normal_amplitude": 0.31}


@lru_cache
def jump(count: int) -> tuple[np.ndarray, float, float]:
    """Amplitudes around that at which the critical point jumps, and its places before and after."""

    def place(u: float) -> float:
        return float(swtstudy.solve(tangential_amplitude=u, rtol=1e-3, **JUMP).critical_x)

    low, high = 0.3, 0.8
    before, after = place(low), place(high)
    assert before * after < 0.0
    for _ in range(12):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if place(middle) * before > 0.0 else (low, middle)
    return np.linspace(low - 0.01, high + 0.01, count), before, after


@pytest.mark.slow
def test_values_that_join_a_jump_of_the_critical_point_have_none() -> None:
    amplitudes, before, after = jump(6)
    found = swtstudy.solve(tangential_amplitude=amplitudes, critical_distance=[0.02, 0.1], rtol=1e-3, **JUMP)
    assert (np.sign(found.critical_x.values) == np.sign([before] * 3 + [after] * 3)).all()
    for name in ("volume", "point", "line"):
        values = found[f"s_{name}"].transpose("tangential_amplitude", ...).values
        steps = np.diff(np.log(values), axis=0)
        # The step across the jump is as those beside it.
        assert_allclose(steps[2], 0.5 * (steps[1] + steps[3]), rtol=0.2, atol=2e-3)
        places = found[f"{name}_x"].transpose("tangential_amplitude", ...).values
        assert (np.sign(places[:3]) != np.sign(before)).any()
        assert (np.sign(places[3:]) == np.sign(after)).all()


def test_about_the_critical_point_alone_they_jump() -> None:
    """So what the test before is about is there."""
    amplitudes, _, _ = jump(6)
    both = amplitudes[2:4]
    batch = points(tangential_amplitude=both, **JUMP)
    solution = solve_points(batch, 1e-3)
    ((_, scene),) = scenes(batch)
    found = nonlocal_swt(scene, solution.critical_x, solution.critical_angle, np.array([0.02, 0.1]))
    assert (found.volume[1] > 1.03 * found.volume[0]).all()


@pytest.mark.slow
def test_they_are_the_largest_of_those_about_every_local_maximum() -> None:
    batch = points(
        poisson_ratio=0.33,
        friction=0.5,
        normal_amplitude=[0.31, 0.6],
        tangential_amplitude=[0.5, 0.7],
        phase=[0.0, 1.0],
    )
    solution = solve_points(batch, 1e-3)
    distance = np.array([0.02, 0.1])
    for index, scene in scenes(batch):
        found = worst_means(scene, solution.critical_x[index], solution.critical_angle[index], distance)
        some = candidates(scene, np.zeros(len(scene)))
        for row in range(len(scene)):
            own = np.flatnonzero(some.rows == row)
            assert own.size > 1
            each = [
                nonlocal_swt(
                    scene.take(np.array([row])),
                    some.position[[k]],
                    np.degrees(0.5 * some.double_angle[[k]]),
                    distance,
                )
                for k in own
            ]
            for kind in ("volume", "point", "line"):
                values = np.stack([getattr(one, kind)[0] for one in each])
                assert_allclose(getattr(found, kind)[row], values.max(axis=0), rtol=2e-4)
                place = some.position[own][values.argmax(axis=0)]
                assert_allclose(getattr(found, f"{kind}_x")[row], place, rtol=1e-4)


@pytest.mark.parametrize("phase", [pytest.param(0.0, marks=pytest.mark.slow), 1.2])
def test_candidates_are_the_local_maxima_of_a_dense_look(phase: float) -> None:
    batch = points(normal_amplitude=0.6, tangential_amplitude=0.7, phase=phase, p=2)
    ((_, scene),) = scenes(batch)
    split = scene.split_at_breakpoints()
    s = solve_points(batch, 1e-4).s[0]
    found = candidates(scene, np.array([0.3 * s]))
    assert found.swt[0] == pytest.approx(s, rel=1e-4)
    assert (np.diff(found.swt) <= 0.0).all()
    r = np.linspace(0.05, 1.4, 900)
    look = Look.at(split, r[None], 6, 5.0)
    for side in (1.0, -1.0):
        swt, angle = coarse_swt(split.planes(look.history, side), 36)
        swt, _ = refine(split, r[None], np.array([side]), angle, Resolution(6, 2, 5.0))
        swt = swt[0]
        peak = np.flatnonzero((swt[1:-1] > swt[:-2]) & (swt[1:-1] >= swt[2:]) & (swt[1:-1] > 0.31 * s)) + 1
        own = found.position[np.sign(found.position) == side] * side
        for at in peak:
            near = np.abs(r - r[at]) < 0.1
            if swt[near].max() > swt[at]:
                continue  # a cusp beside a higher maximum, about which the mean is larger
            assert np.abs(own - r[at]).min() < 4e-3


@pytest.mark.slow
def test_places_go_with_their_points_and_archives_of_before_open(tmp_path: Path) -> None:
    own = study(
        "[fixed]\ncritical_distance = 0.1\n", "phase = [1.55, 4.6915926535897932]\nnormal_amplitude = [0.3]"
    )
    found = swtstudy.run(own, tmp_path / "a.nc")
    assert found.volume_x.dims == ("phase", "normal_amplitude")
    assert_allclose(found.volume_x[0], -found.volume_x[1], rtol=1e-9)
    # The mean is larger about a local maximum on the other side.
    assert_allclose(np.sign(found.volume_x), -np.sign(found.critical_x))
    assert_allclose(swtstudy.open_results(tmp_path / "a.nc").line_x, found.line_x)
    before = found.drop_vars(["volume_x", "point_x", "line_x"])
    before["s_volume"] = 0.5 * before.s_volume.assign_attrs(before.s_volume.attrs)
    save(before, tmp_path / "before.nc")
    assert_allclose(swtstudy.open_results(tmp_path / "before.nc").s_volume, 0.5 * found.s_volume)
    # What is about critical points alone is made anew, but s is known.
    work = assess(own, tmp_path / "before.nc")
    assert not work.missing.any()
    assert work.incomplete.all()
    again = swtstudy.run(own, tmp_path / "before.nc")
    assert_allclose(again.s_volume, found.s_volume, rtol=1e-12)
    assert_allclose(again.volume_x, found.volume_x, rtol=1e-12)


def test_with_units_places_are_lengths() -> None:
    found = swtstudy.physical(
        young_modulus=73.1e3,
        poisson_ratio=0.33,
        radius=50.0,
        friction=0.5,
        normal_force=[200.0],
        tangential_amplitude=1.5e-3,
        normal_amplitude=2e-3,
    ).solve(rtol=1e-3, critical_distance=0.02)
    scale = found.critical_position / found.critical_x
    assert_allclose(found.volume_position, found.volume_x * scale)
    assert found.point_position.dims == found.s_point.dims


@pytest.mark.parametrize(
    "given",
    [
        {"poisson_ratio": 0.2533, "friction": 0.6096, "normal_amplitude": 0.1695, "phase": 1.8705}
        | {"tangential_amplitude": 0.8437},
        pytest.param(
            {"poisson_ratio": 0.1656, "friction": 0.5721, "normal_amplitude": 0.1804, "phase": 1.2093}
            | {"tangential_amplitude": 0.4424},
            marks=pytest.mark.slow,
        ),
        pytest.param(
            {"criterion": "findley", "normal_sensitivity": 0.3, "friction": 0.6}
            | {"normal_amplitude": 0.3, "phase": 1.0},
            marks=pytest.mark.slow,
        ),
    ],
)
def test_values_are_about_local_maxima_not_about_flanks(given: dict[str, object]) -> None:
    found = swtstudy.solve(critical_distance=[0.05, 0.2], **given)
    names = "volume_x", "point_x", "line_x"
    places = np.unique(np.round(np.concatenate([found[name].values.ravel() for name in names]), 6))
    for x in places:
        near = x + np.array([-0.01, -0.003, 0.0, 0.003, 0.01])
        value = on_planes(near, given)
        assert value[2] >= (1.0 - 1e-3) * value.max()


def test_on_a_flank_values_may_be_larger() -> None:
    """Where swt falls off as slowly inwards as along the line, half the distance beneath a flank has more."""
    given = {"normal_amplitude": 0.31, "tangential_amplitude": 0.25, "poisson_ratio": 0.33, "friction": 0.5}
    batch = points(**given)
    ((_, scene),) = scenes(batch)
    found = swtstudy.solve(critical_distance=0.05, **given)
    flank = nonlocal_swt(scene, np.array([0.9152]), np.array([0.0]), np.array([0.05])).point[0, 0, 0]
    swt_0 = float(found.s) / float(solve_points(batch).s[0])
    assert 1.3 < flank * swt_0 / float(found.s_point.sel(direction="depth")) < 1.4
    # It is no maximum: swt falls from there outwards.
    assert (np.diff(on_planes(np.array([0.9, 0.91, 0.92, 0.93]), given)) < 0.0).all()


def on_planes(x: np.ndarray, given: dict[str, object]) -> np.ndarray:
    """The criterion on the planes through y, half a degree apart, by the body's stress."""
    field = swtstudy.stress_field(x, 0.0, 0.0, **given)
    xx, yy, zz, xz = (
        field[f"sigma_{name}"].transpose("x", "instant").values[:, None] for name in ("xx", "yy", "zz", "xz")
    )
    angle = np.radians(np.arange(-90.0, 90.0, 0.5))[:, None]
    cosine, sine = np.cos(angle), np.sin(angle)
    tension = xx * cosine**2 + zz * sine**2 + 2.0 * xz * sine * cosine
    if "criterion" in given:
        shear = (zz - xx) * sine * cosine + xz * (cosine**2 - sine**2)
        values = value_of(given["criterion"], given["normal_sensitivity"], tension, shear)
    else:
        ν = given["poisson_ratio"]
        strain = ((1.0 + ν) * tension - ν * (xx + yy + zz)) / (1.0 - ν**2)
        values = np.maximum(tension.max(axis=-1), 0.0) * 0.5 * np.ptp(strain, axis=-1)
    return values.max(axis=-1)
