"""Datasets hold and say what is kept of them: variables, dimensions, words, units; so do messages."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import stand_in
import xarray as xr
from kept import Kept, told
from made_up import SALTELLI, made_up
from solved import REGIMES
from told import sayings

import swtstudy
from swtstudy import StudyError
from swtstudy.results.history import longest_chord, one_of_both, smallest_sphere
from swtstudy.results.inspection import load_and_springs, marked_instants
from swtstudy.results.optimise import Planes, lowest_of, newton, read_ranges, tangent_planes

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
    "point_of_face": lambda: swtstudy.inspect_point(profile="rounded_punch", flat_radius=0.5, phase=0.5),
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
    kept("told_optimum", told(found.drop_vars(["evaluations", "run"], errors="ignore")))


@pytest.mark.filterwarnings("ignore:indices are known to")
def test_indices(kept: Kept, tmp_path: Any) -> None:
    found = swtstudy.run(
        swtstudy.Study.from_text(SALTELLI), tmp_path / "a.nc", workers=1, solver=stand_in.smooth
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


def refusal(call: str) -> list[str]:
    with pytest.raises(ValueError) as caught:  # noqa: PT011
        eval(call)
    return [str(each) for each in getattr(caught.value, "mistakes", ())] or [str(caught.value)]


#: Slides on and on, and bodies that never touch.
LOST = {"normal_force_amplitude": 0.9, "tangential_force_amplitude": 0.9}
REFUSED = sayings(r"""
no forces » swtstudy.inspect_point(**LOST)
one force » swtstudy.inspect_point(tangential_force_amplitude=1.5)
pulls » swtstudy.stress_field(0, 0, 0, normal_force_amplitude=1.5)
never » swtstudy.inspect_point(normal_amplitude=0.5, load=swtstudy.LoadPath("up", [[-9, 0], [-8, 1]]))
place » swtstudy.swt_field("a", np.inf, [])
places » swtstudy.swt_field(np.zeros((2, 2)), 0, -1.5)
height » swtstudy.swt_field(0, 0, [0.5, -1.5])
many » swtstudy.swt_field(np.zeros(10_001), 0, np.zeros(1000))
apart » swtstudy.swt_field(xr.DataArray([0, 1], {"k": [0, 1]}, "k"), xr.DataArray([0, 1], {"k": [1, 2]}, "k"),
    0)
time » swtstudy.stress_field(xr.DataArray([0.0], dims="time"), xr.DataArray([0.0], dims="instant"), 0)
instant » swtstudy.stress_field(0, 0, 0, time=[np.nan])
instants » swtstudy.slip_map(0, time=[[0.0]])
radius » swtstudy.slip_map([])
parameters » swtstudy.slip_map(0, frictoin=1, phase="x")
history » swtstudy.swt_of_history(np.zeros((3, 5)), 0.7, -1, 1.0)
gap » swtstudy.swt_of_history([[np.nan] * 6], 0.3, np.inf, 0.0)
criterion » swtstudy.criterion_of_history(np.zeros((0, 6)), "swt", -0.1)
endless » swtstudy.criterion_of_history(np.zeros((2, 6)), "findly", np.inf)
y » some().swt.extrema("phase", "S")
flags » some().swt.extrema("phase", "regime")
dim » some().swt.extrema("fase")
ratio » some().swt.normalised("b")
name » some().swt.words("s")
slice » some().swt.slice(fase=0, phase=[], profile="cone", friction=1)
word » some().swt.slice(phase="2*", profile="wavy")
over » swtstudy.optimise(over={"phase": 1, "fase": (0, 1), "friction": (0.1, 0.2)}, minimise="S", rtol=2)
order » swtstudy.optimise(over={"phase": (1, 0), "friction": (0.3, 0.2)}, seed=-1)
nothing » swtstudy.optimise(over=3)
results » swtstudy.sensitivity(3)
level » swtstudy.sensitivity(some(), confidence=1.0)
seed » swtstudy.sensitivity(some(), seed=-1)
design » swtstudy.sensitivity(some())
whole » swtstudy.sensitivity(xr.Dataset(coords={"sample": ("sample", [0, 1], {"design": "saltelli",
    "parameters": "phase friction", "size": 1})}))
""")


def test_messages(kept: Kept) -> None:
    said = {name: refusal(call) for name, (call,) in REFUSED}
    said["apart"] = [words.partition(" (cannot")[0] for words in said["apart"]]  # xarray's own words
    kept("messages_of_results", said)


def test_a_search_that_ends_early_is_warned_of(monkeypatch: pytest.MonkeyPatch) -> None:
    found = np.ones(3), np.tile([1.0, 0.0, 0.0], (3, 1)), 2
    monkeypatch.setattr("swtstudy.kernel.all_planes.planes_of", lambda *_: found)
    words = "^the search over planes ended early at 2 of 3 histories: their values may be low$"
    with pytest.warns(RuntimeWarning, match=words) as caught:
        swtstudy.swt_of_history(np.ones((3, 2, 6)), 0.3)
    assert caught[0].filename == __file__


def test_a_quantity_that_is_finite_nowhere_has_no_optimum(monkeypatch: pytest.MonkeyPatch) -> None:
    def infinite(points: Any, rtol: float) -> stand_in.Solution:
        found = stand_in.smooth(points, rtol)
        return found._replace(s=np.full(len(found.s), np.inf))

    monkeypatch.setattr(stand_in.SOLVER, infinite)
    words = (
        r"^over: found no finite value at any of \d+ points; allowed: ranges in which the quantity is finite"
    )
    with pytest.raises(StudyError, match=words):
        swtstudy.optimise(over={"phase": (0, 1)})


def test_spheres_around_points() -> None:
    """The smallest one is on two, three or four of them; points inside, and equal ones, do not count."""
    corners = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
    turned = np.array([[np.cos(a), np.sin(a), 0.0] for a in (0.0, 2.0, 4.0)])
    tetrahedron = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    far = 1e6 + np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.5, 0.0]])
    for points, centre, radius in (
        (corners[:2], [0, 0, 0], 1.0),
        (corners, [0, 0, 0], 1.0),
        (turned, [0, 0, 0], 1.0),
        (tetrahedron, [0, 0, 0], 3.0**0.5),
        (np.tile(corners[:1], (4, 1)), corners[0], 0.0),
        (far, [1e6 + 1.0, 1e6, 1e6], 1.0),
    ):
        for order in (points, points[::-1], np.repeat(points, 2, axis=0)):
            middle, size = smallest_sphere(order)
            np.testing.assert_allclose(middle, centre, atol=1e-9)
            assert size == pytest.approx(radius, abs=1e-9)


def test_the_longest_chord_of_a_path() -> None:
    """Of many points, too, whose pairs are looked at in parts, and of one."""
    angle = np.linspace(0.0, 2.0 * np.pi, 2001)[:-1]
    ellipse = np.stack([3.0 + 2.0 * np.cos(angle), np.sin(angle)], axis=1)
    np.testing.assert_allclose(np.abs(longest_chord(ellipse)), [4.0, 0.0], atol=1e-12)
    np.testing.assert_array_equal(longest_chord(ellipse[:1]), [0.0, 0.0])
    cloud = np.random.default_rng(4).normal(size=(1500, 2))
    longest = np.sqrt(np.square(cloud[:, None] - cloud).sum(axis=-1)).max()
    assert np.linalg.norm(longest_chord(cloud)) == pytest.approx(longest, rel=1e-12)


def test_of_two_opposite_normals_the_one_with_a_positive_first_component_is_told() -> None:
    given = [[-0.6, 0.8, 0.0], [1e-10, -1.0, 0.0], [0.0, -0.0, -1.0], [0.6, -0.8, 0.0]]
    expected = [[0.6, -0.8, 0.0], [-1e-10, 1.0, 0.0], [0.0, 0.0, 1.0], [0.6, -0.8, 0.0]]
    np.testing.assert_array_equal(one_of_both(np.array(given)), expected)


def test_marked_instants() -> None:
    """Extremes that are apart, the stress first; not while the bodies are apart; else the widest gaps."""
    share = np.linspace(0.0, 1.0, 101)
    wave = {"depth": 1.0 + 1.5 * np.sin(2 * np.pi * share), "displacement": np.cos(2 * np.pi * (share - 0.3))}
    stress = {"normal_stress": np.cos(2 * np.pi * (share - 0.5)), "normal_strain": np.sin(2 * np.pi * share)}
    between = "in between"
    for curves, expected in (
        (wave, {25: "δ largest", 43: between, 61: between, 93: between}),
        (wave | stress, {0: between, 25: "δ largest", 50: "σ_n largest", 75: "ε_n smallest"}),
    ):
        at, reasons = marked_instants(share, curves)
        assert dict(zip(at.tolist(), reasons, strict=True)) == expected


def test_newton_goes_to_the_bottom_of_a_parabola() -> None:
    """In two dimensions, from the nearest point; no further than the distance, and within the cube."""
    bottom, curvature = np.array([0.52, 0.47]), np.array([[4.0, 1.0], [1.0, 2.0]])
    points = np.array([[0.5, 0.5], [0.55, 0.5], [0.5, 0.55], [0.45, 0.46]])
    away = points - bottom
    planes = Planes(points, 0.5 * np.einsum("ki,ij,kj->k", away, curvature, away), away @ curvature)
    np.testing.assert_allclose(newton(planes, np.array([0.5, 0.5]), 0.1), bottom, atol=1e-9)
    near = newton(planes, np.array([0.5, 0.5]), 0.01)
    assert np.abs(near - points[0]).max() == pytest.approx(0.01)
    flat = Planes(points, points @ [1.0, -1.0], np.tile([1.0, -1.0], (4, 1)))
    np.testing.assert_allclose(newton(flat, np.array([0.5, 0.5]), 0.1), [0.4, 0.6], atol=1e-9)
    np.testing.assert_allclose(newton(flat, np.array([0.5, 0.5]), 0.9), [0.0, 1.0], atol=1e-9)


def test_the_lowest_points_of_planes() -> None:
    """Of a roof turned over: in its valley, or at the end of the distance, all of it and 0.3 of it."""
    points = np.array([[0.45], [0.6]])
    roof = Planes(points, np.array([0.05, 0.1]), np.array([[-1.0], [1.0]]))
    whole, short = lowest_of(roof, np.array([0.45]), 0.05, 0.1)
    np.testing.assert_allclose([*whole, *short], [0.5, 0.48], atol=1e-9)
    first, _ = lowest_of(roof, np.array([0.45]), 0.05, 0.02)
    np.testing.assert_allclose(first, [0.47], atol=1e-9)
    # Beneath the value at the centre, and inside of the cube.
    high = Planes(np.array([[0.02]]), np.array([9.0]), np.array([[1.0]]))
    first, _ = lowest_of(high, np.array([0.02]), 0.5, 0.1)
    np.testing.assert_allclose(first, [0.0], atol=1e-9)


def test_planes_beside_a_kink_are_left_out() -> None:
    points = np.array([[0.2], [0.4985], [0.9], [0.7]])
    search = tangent_planes(points, 0.1)
    at = next(search)
    np.testing.assert_allclose(at[4:, 0], [0.203, 0.2015, 0.5015, 0.5, 0.897, 0.8985, 0.697, 0.6985])
    values = np.where(at[:, 0] > 0.695, np.inf, np.abs(at[:, 0] - 0.5))
    values[:4][2] = 1.0
    with pytest.raises(StopIteration) as end:
        search.send(values)
    planes = end.value.value
    np.testing.assert_allclose(planes.points, [[0.2]])
    np.testing.assert_allclose(planes.gradients, [[-1.0]])
    # The step of differences has a least length.
    np.testing.assert_allclose(np.diff(np.ravel(next(tangent_planes(points[:1], 1e-9)))), [1e-6, -5e-7])


def test_the_corners_of_a_box_are_its_ends() -> None:
    ranges, wrong = read_ranges(
        {"phase": (0.1, 0.7), "friction": np.array([0.1, 0.3])}, ["phase", "friction"]
    )
    assert not wrong
    assert ranges == {"phase": [0.1, 0.7], "friction": [0.1, 0.3]}


def test_a_place_may_be_an_array_of_no_dimension() -> None:
    found = some()
    assert found.swt.slice(phase=np.array(1.0)).identical(found.swt.slice(phase=1.0))
    assert found.swt.slice(phase=np.array([1.0])).identical(found.swt.slice(phase=[1.0]))
    assert found.swt.slice(phase=range(2)).phase.values.tolist() == [0.0, 1.0]
    assert found.swt.slice(phase=(3, 0)).phase.values.tolist() == [3.0, 0.0]
