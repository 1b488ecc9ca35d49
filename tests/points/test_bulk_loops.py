"""Loops with a bulk stress as their third column."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from command import merged
from numpy.typing import NDArray
from told import RIG

import swtstudy
from swtstudy import LoadPath, Study, open_results, run, swt_of_history

Array = NDArray[np.float64]
COMPONENTS = tuple(f"sigma_{name}" for name in ("xx", "yy", "zz", "yz", "xz", "xy"))

#: From its first vertex on; at the fourth and at the last one only the bulk stress turns.
LOOP = np.array(
    [
        [-0.4, -0.3, 0.1],
        [0.1, 0.7, 0.3],
        [0.5, 0.2, -0.2],
        [0.5, 0.2, 0.4],
        [0.2, -0.3, 0.0],
        [-0.1, -0.3, 0.35],
    ]
)


def solved(vertices: object, **parameters: Any) -> xr.Dataset:
    return swtstudy.solve(load=LoadPath("mine", vertices), **parameters)


def edge_tension(nu: float) -> float:
    """Of Hertz's pressure at |x| = a: (1 − 2ν) P/(2π a²)."""
    return (1.0 - 2.0 * nu) * 2.0 / (3.0 * np.pi)


@pytest.mark.parametrize("friction", [0.0, 0.5])
@pytest.mark.parametrize("exponent", [0.5, 0.3])
def test_at_rest_it_has_a_closed_form(friction: float, exponent: float) -> None:
    """Nothing moves but the bulk stress: its largest value and half its range count."""
    nu, mean, amplitude, course = 0.3, 0.02, 0.2, np.array([0.5, -0.3, 0.1, 0.8, 0.2])
    still = np.zeros(course.size)
    own = {"friction": friction, "walker_exponent": exponent, "bulk_stress_mean": mean, "rtol": 1e-7}
    found = solved(np.stack([still, still, course], axis=1), bulk_stress_amplitude=amplitude, **own)
    tension = mean + amplitude * 0.8 + edge_tension(nu)
    swing = amplitude * 0.5 * (0.8 + 0.3)
    expected = tension ** (2.0 - 2.0 * exponent) * swing ** (2.0 * exponent) / (1.0 - nu**2)
    assert float(found.s) == pytest.approx(expected, rel=1e-7)
    assert abs(float(found.critical_x)) == pytest.approx(1.0, rel=1e-9)


def dense(vertices: Array, per_side: int) -> Array:
    """Places on the closed polygon, the vertices among them."""
    share = np.arange(per_side)[:, None] / per_side
    after = np.roll(vertices, -1, axis=0)
    return np.concatenate([a + share * (b - a) for a, b in zip(vertices, after, strict=True)])


@pytest.mark.parametrize("seed", range(3))
def test_without_friction_against_brute_force(seed: int) -> None:
    """Hertz's pressure that goes up and down and a bulk stress, at every instant, x and plane."""
    rng = np.random.default_rng(seed)
    nu, vertices = 0.3, rng.uniform(-0.6, 0.6, (5, 3)) * [1.0, 0.0, 0.3]
    vertices[1, 0] = vertices[0, 0]
    found = solved(vertices, friction=0.0, rtol=1e-6)
    depth, _, bulk = dense(vertices, 60).T
    depth = 1.0 + depth
    edges = np.sqrt(1.0 + vertices[:, 0])
    x = np.unique(
        np.concatenate([edges, np.linspace(0.01, edges.max(), 500), edges.max() * np.geomspace(1, 60, 99)])
    )
    inside = np.maximum(1.0 - x[:, None] ** 2 / depth, 0.0)
    pressure = 2.0 / np.pi * np.sqrt(depth * inside)
    spread = (1.0 - 2.0 * nu) * (2.0 / 3.0) * depth**1.5 * (1.0 - inside**1.5) / (np.pi * x[:, None] ** 2)
    xx, yy, zz = bulk + spread - pressure, -spread - 2.0 * nu * pressure, -pressure
    best = 0.0
    for angle in np.linspace(0.0, 0.5 * np.pi, 61):
        stress = xx * np.cos(angle) ** 2 + zz * np.sin(angle) ** 2
        strain = (1.0 + nu) * stress - nu * (xx + yy + zz)
        swing = 0.5 * np.ptp(strain, axis=1)
        best = max(best, float((np.maximum(stress.max(1), 0.0) * swing).max()) / (1.0 - nu**2))
    assert best == pytest.approx(float(found.s), rel=2e-3)
    assert best < float(found.s) * (1.0 + 1e-5)


def test_it_is_added_to_sigma_xx_in_straight_lines_and_to_nothing_else() -> None:
    rng = np.random.default_rng(5)
    places = [xr.DataArray(v, dims="place") for v in (*rng.normal(size=(2, 8)), rng.uniform(0, 2, 8))]
    time = rng.uniform(0.0, 2.0 * np.pi, 9)

    def stress(**own: float) -> Array:
        field = swtstudy.stress_field(*places, time=time, load=LoadPath("mine", LOOP), **own)
        return np.stack([field[name].values for name in COMPONENTS], axis=-1)

    with_it = stress(bulk_stress_amplitude=0.6, bulk_stress_mean=-0.05)
    difference = with_it - stress(bulk_stress_amplitude=0.0)
    corner = np.append(LOOP[:, 2], LOOP[0, 2])
    bulk = -0.05 + 0.6 * np.interp(time, np.linspace(0.0, 2.0 * np.pi, 7), corner)
    np.testing.assert_allclose(difference[..., 0], np.broadcast_to(bulk[:, None], (9, 8)), atol=1e-13)
    np.testing.assert_array_equal(difference[..., 1:], 0.0)
    # The contact itself is that of the first two columns, whose own vertices are fewer.
    lean = LoadPath("lean", LOOP[:, :2])
    assert len(lean.vertices) == 4
    plain = float(solved(LOOP, bulk_stress_amplitude=0.0, rtol=1e-6).s)
    assert plain == pytest.approx(float(swtstudy.solve(load=lean, rtol=1e-6).s), rel=1e-6)


def test_the_history_at_the_critical_point_has_s_and_so_have_field_and_inspection() -> None:
    own: dict[str, Any] = {"load": LoadPath("mine", LOOP), "bulk_stress_mean": 0.05, "friction": 0.5}
    found = swtstudy.solve(**own)
    x = float(found.critical_x)
    field = swtstudy.stress_field(x, 0.0, 0.0, **own)
    history = np.stack([field[name].values for name in COMPONENTS], axis=-1)
    assert swt_of_history(history, 0.3, 0.91).swt.item() == pytest.approx(float(found.s), rel=1e-4)
    local = swtstudy.swt_field([x, 3e3], 0.0, 0.0, **own).s_local.values.ravel()
    # Far away only the bulk stress is left.
    expected = [float(found.s), (0.05 + 0.4) * 0.5 * (0.4 + 0.2) / 0.91]
    np.testing.assert_allclose(local, expected, rtol=3e-3)
    point = swtstudy.inspect_point(**own)
    corner = np.append(LOOP[:, 2], LOOP[0, 2])
    course = np.interp(point.time.values, np.linspace(0.0, 2.0 * np.pi, 7), corner)
    np.testing.assert_allclose(point.bulk_stress, 0.05 + course, atol=1e-12)
    assert float(point.s) == float(found.s)


@pytest.mark.slow
@pytest.mark.parametrize(("psi", "of_bulk"), [(0.4, 1.0), (2.3, 3.0)])
def test_the_harmonic_load_as_a_polygon_converges_to_it(psi: float, of_bulk: float) -> None:
    own = {"normal_amplitude": 0.75, "friction": 0.4, "bulk_stress_amplitude": 0.15, "bulk_stress_mean": 0.04}
    exact = swtstudy.solve(phase=psi, bulk_stress_phase=of_bulk, **own, rtol=1e-6)
    for count in (16, 64, 256):
        t = 2.0 * np.pi * np.arange(count) / count
        vertices = np.stack([np.sin(t + psi), np.sin(t), np.sin(t + of_bulk)], axis=1)
        found = solved(vertices, tangential_amplitude=5 / 6, **own, rtol=1e-6)
        assert abs(float(found.s / exact.s) - 1.0) < 3.0 / count**1.5
    assert float(found.critical_x) == pytest.approx(float(exact.critical_x), rel=1e-2)


def test_as_a_harmonic_sum_it_is_the_harmonic_load() -> None:
    own: dict[str, Any] = {"normal_amplitude": 0.1, "bulk_stress_amplitude": 0.05, "rtol": 1e-6}
    exact = swtstudy.solve(frequency_ratio="3/2", phase=0.7, bulk_stress_phase=2.0, **own)
    own["tangential_amplitude"] = 5 / 6
    rows = [(2, 1.0, 0.7)], [(3, 1.0, 0.0)], [(3, 1.0, 2.0)]
    by_sums = LoadPath.harmonic_sum("a", *rows)
    by_samples = LoadPath.sampled("b", lambda t: (np.sin(2 * t + 0.7), np.sin(3 * t), np.sin(3 * t + 2.0)))
    for loop in (by_sums, by_samples):
        found = swtstudy.solve(load=loop, **own)
        assert float(found.s) == pytest.approx(float(exact.s), rel=1e-6)
        assert float(found.bulk_shift) == pytest.approx(float(exact.bulk_shift), rel=1e-9)
    # The bulk stress alone: the fundamental is largest where the third harmonic is least.
    still = LoadPath.harmonic_sum("c", [], [], [(1, 1.0, 0.0), (3, 0.5, 0.0)])
    t = np.linspace(0.0, 2.0 * np.pi, 100001)
    top = float((np.sin(t) + 0.5 * np.sin(3.0 * t)).max())
    s = float(swtstudy.solve(load=still, bulk_stress_amplitude=0.1, rtol=1e-7).s)
    assert s == pytest.approx((0.1 * top + edge_tension(0.3)) * 0.1 * top / 0.91, rel=1e-7)
    # Its turns are many, and few of them count.
    rough = LoadPath.harmonic_sum("d", [], [], [(1, 1.0, 0.0), (37, 0.3, 0.4)])
    course = np.sin(t) + 0.3 * np.sin(37.0 * t + 0.4)
    s = float(swtstudy.solve(load=rough, bulk_stress_amplitude=0.1, rtol=1e-6).s)
    swing = 0.05 * np.ptp(course)
    assert s == pytest.approx((0.1 * course.max() + edge_tension(0.3)) * swing / 0.91, rel=1e-5)


def test_neither_the_first_vertex_nor_what_is_on_a_line_matters() -> None:
    rolled = np.roll(LOOP, 2, axis=0)
    between = np.insert(LOOP, 1, 0.25 * LOOP[1] + 0.75 * LOOP[0], axis=0)
    resting = np.insert(LOOP, 3, [0.5, 0.2, 0.1], axis=0)
    every = (LOOP, rolled, between, resting, np.repeat(LOOP, 2, axis=0))
    same = [LoadPath("a", each).code for each in every]
    assert len({*same}) == 1
    assert len(LoadPath("a", LOOP).vertices) == len(LOOP)
    for column in range(3):
        other = between.copy()
        other[1, column] += 0.01
        assert LoadPath("a", other).code != same[0]
        assert len(LoadPath("a", other).vertices) == len(LOOP) + 1


def test_mirrored_it_has_its_critical_point_on_the_other_side_and_turned_over_another_s() -> None:
    there, mirrored, over, back = (
        solved(each, rtol=1e-6) for each in (LOOP, LOOP * [1, -1, 1], LOOP * [1, -1, -1], LOOP[::-1])
    )
    assert float(mirrored.s) == pytest.approx(float(there.s), rel=1e-6)
    assert float(mirrored.critical_x) == pytest.approx(-float(there.critical_x), rel=1e-5)
    assert float(mirrored.critical_angle) == pytest.approx(-float(there.critical_angle), abs=1e-3)
    for other in (over, back):
        assert abs(float(other.s / there.s) - 1.0) > 1e-2


def test_a_third_column_of_zeros_is_none() -> None:
    plain = LoadPath("a", LOOP[:, :2])
    assert LoadPath("a", LOOP * [1.0, 1.0, 0.0]).code == plain.code
    sums = [(1, 0.5, 0.4)], [(1, 0.5, 0.0)]
    assert LoadPath.harmonic_sum("a", *sums, [(2, 0.0, 1.0)]).code == LoadPath.harmonic_sum("a", *sums).code
    # Parts of unfinished archives know loops by these.
    assert plain.code == 83487874368525005
    assert LoadPath.harmonic_sum("a", *sums).code == 75606363235903598


def test_its_amplitude_is_1_unless_given_and_only_loops_that_have_it_know_it() -> None:
    loops = [LoadPath("with", LOOP), LoadPath("without", LOOP[:, :2])]
    assert float(solved(LOOP).s) == float(solved(LOOP, bulk_stress_amplitude=1.0).s)
    scaled = LOOP * [0.5, 0.6, 0.7]
    own = {"normal_amplitude": 0.5, "tangential_amplitude": 0.6, "bulk_stress_amplitude": 0.7}
    assert float(solved(LOOP, **own).s) == float(solved(scaled).s)
    both = swtstudy.solve(load=loops, bulk_stress_amplitude=[0.0, 0.4], bulk_stress_mean=0.01)
    assert float(both.s[1, 0]) == float(both.s[1, 1])
    assert float(both.s[0, 1]) > 1.1 * float(both.s[0, 0])
    assert both.bulk_shift[1].values.tolist() == [0.0, 0.0]
    with pytest.warns(UserWarning, match="bulk_stress_phase has no effect"):
        phases = swtstudy.solve(load=loops, bulk_stress_amplitude=0.4, bulk_stress_phase=[0.0, 1.0, 4.0])
    assert (phases.s == phases.s[:, :1]).all()
    assert (phases.critical_x == phases.critical_x[:, :1]).all()


def test_the_shift_of_the_stick_zone_is_that_of_half_its_range() -> None:
    """Between fixed ends, and however it goes in between; beyond a − c it has no meaning."""
    vertices = np.array([[0, 0.75, 0.1], [0, 0, 0.0], [0, -0.75, 0.4], [0, 0.1, 0.05]])
    amplitude = np.array([0.05, 0.5, 5.0])
    found = solved(vertices, bulk_stress_amplitude=amplitude).bulk_shift.values
    shift = 2.0 * (amplitude * 0.2) / (0.3 * 1.3 * 3.1)
    np.testing.assert_allclose(found, np.where(shift <= 1.0 - np.sqrt(0.25), shift, np.nan), rtol=1e-12)
    assert np.isnan(found).tolist() == [False, False, True]


STUDY = """title = "Loops"
rtol = 1e-3
[fixed]
load = "mine"
[axes]
bulk_stress_mean = [0.0, 0.05]
[loads.mine]
"""


def test_a_study_has_it_in_its_text_or_in_files(tmp_path: Path) -> None:
    rows = "\n".join(f"{b}, {t}, {n}" for n, t, b in LOOP)
    (tmp_path / "cycle.csv").write_text(f"bulk, tangential, normal\n{rows}\n")
    by_file = Study.from_text(STUDY + 'file = "cycle.csv"', "study", tmp_path)
    by_text = Study.from_text(STUDY + f"vertices = {LOOP.tolist()}")
    assert by_file.grid == by_text.grid
    path = tmp_path / "loops.nc"
    dataset = run(by_file, path, workers=1)
    expected = solved(LOOP, bulk_stress_mean=[0.0, 0.05], rtol=1e-3)
    np.testing.assert_allclose(dataset.s, expected.s, rtol=1e-12)
    found = open_results(path)
    assert float(found.bulk_stress_amplitude) == 1.0
    (defined,) = json.loads(found.attrs["definitions"])
    assert defined["content"] == {"vertices": LOOP.tolist()}
    assert Study.from_text(merged(path).attrs["study"]).grid == by_file.grid
    sums = "normal = [[1, 0.5, 0.4]]\ntangential = [[1, 0.5, 0]]\nbulk = [[2, 0.1, 0.3]]"
    study = Study.from_text(STUDY + sums)
    loop = LoadPath.harmonic_sum("mine", [(1, 0.5, 0.4)], [(1, 0.5, 0.0)], [(2, 0.1, 0.3)])
    assert study.grid.values("load") == (loop,)
    again = run(study, path, workers=1)
    assert Study.from_text(open_results(path).attrs["study"]).grid == study.grid
    np.testing.assert_allclose(again.s, swtstudy.solve(load=loop, bulk_stress_mean=[0.0, 0.05], rtol=1e-3).s)


def test_of_a_real_contact_its_column_is_one_of_stresses() -> None:
    still = LoadPath("mine", [[0, 1.0, -20.0], [0, -1.0, 80.0], [0, 0.2, 100.0]])
    given = RIG | {"normal_force": 200.0, "tangential_amplitude": 0.002, "load": still}
    contact = swtstudy.physical(**given, bulk_stress_mean=10.0)
    own, other = contact.parameters(1), contact.parameters(2)
    assert own["bulk_stress_amplitude"] == pytest.approx(1.0 / contact.stress_scale)
    assert own["bulk_stress_mean"] == pytest.approx(10.0 / contact.stress_scale)
    assert other["bulk_strain_share"] == -1.0
    scaled = still.vertices * [1.0, 1.0, 1.0 / contact.stress_scale]
    own_s = swtstudy.solve(**{**own, "load": LoadPath("scaled", scaled), "bulk_stress_amplitude": 1.0})
    found = contact.solve()
    assert float(found.s[0]) == pytest.approx(float(own_s.s), rel=1e-9)
    lean = LoadPath("lean", still.vertices[:, :2])
    without = {**own, "load": lean, "bulk_stress_amplitude": 0.0, "bulk_stress_mean": 0.0}
    assert float(found.s[1]) == pytest.approx(float(swtstudy.solve(**without).s), rel=1e-6)
    # From -20 to 100: R = 0.25 wants 60 more, so that it goes from 40 to 160.
    assert swtstudy.physical(**given, bulk_stress_ratio=0.25).bulk_stress_mean == pytest.approx(60.0)
    assert contact.with_parameters(friction=0.4).bulk_stress_amplitude == pytest.approx(1.0)


def swt_at(x: Array, y: Array, z: Array, **own: Any) -> Array:
    """swt of the stress field at places, at many common instants."""
    time = np.linspace(0.0, 2.0 * np.pi, 301)
    places = [xr.DataArray(values, dims="place") for values in (x, y, z)]
    field = swtstudy.stress_field(*places, time=time, load=LoadPath("mine", LOOP), **own)
    stress = np.stack([field[name].transpose("place", "time").values for name in COMPONENTS], axis=-1)
    return swt_of_history(stress, 0.3, 1.0 - 0.3**2).swt


@pytest.mark.slow
def test_nonlocal_means_hold_it() -> None:
    """Against the field at the places of Gauss's rule in spherical coordinates about the worst place."""
    own = {"bulk_stress_amplitude": 0.25, "bulk_stress_mean": 0.05}
    distance = 0.2
    found = solved(LOOP, critical_distance=[1e-8, distance], **own)
    x = float(found.volume_x[1])
    np.testing.assert_allclose([found.s_volume[0], *found.s_point[0]], float(found.s), rtol=2e-3)
    nodes = (np.polynomial.legendre.leggauss(count) for count in (4, 4, 6))
    (u, of_u), (v, of_v), (w, of_w) = ((0.5 + 0.5 * node, 0.5 * weight) for node, weight in nodes)
    # Denser towards the point, beside which swt falls like a root, and towards the surface.
    u, v, w = np.meshgrid(u**2, v**2, np.pi * w, indexing="ij")
    out = distance * u * np.sqrt(1.0 - v**2)
    swt = swt_at(*(a.ravel() for a in (x + out * np.cos(w), out * np.sin(w), distance * u * v)), **own)
    weight = of_u[:, None, None] * u**2.5 * of_v[:, None] * np.sqrt(v) * of_w
    expected = (weight.ravel() @ swt) / weight.sum()
    assert float(found.s_volume[1]) == pytest.approx(expected, rel=5e-3)
    x = float(found.point_x.sel(direction="depth")[1])
    below = swt_at(np.array([x]), np.zeros(1), np.array([0.5 * distance]), **own)
    assert float(found.s_point.sel(direction="depth")[1]) == pytest.approx(float(below[0]), rel=1e-3)


def test_far_beneath_the_contact_there_is_nothing_else() -> None:
    mean, amplitude = 3.0, 5.0
    own = {"bulk_stress_amplitude": amplitude, "bulk_stress_mean": mean, "critical_distance": 10.0}
    found = solved(LOOP, **own)
    expected = (mean + 0.4 * amplitude) * 0.5 * (0.4 + 0.2) * amplitude / (1.0 - 0.3**2)
    assert float(found.s_point.sel(direction="depth")) == pytest.approx(expected, rel=3e-3)
