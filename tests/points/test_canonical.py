"""What a point is computed as: what does not matter is left out, and what is equal is computed once."""

import numpy as np
import pytest
from told import sayings, warned

from swtstudy import Study
from swtstudy.kernel.loops import fold_bulk_phase, fold_phase
from swtstudy.points.grid import Grid, alike, canonical_points, describe_point, group_rows, rounded
from swtstudy.points.solve import turned

BODIES = "friction=0.3, poisson_ratio=0.3"
WAVY = (
    '{profile = "wavy_paraboloid", waviness_amplitude = 0.001, wavelength = 5, normal_force_amplitude = 0.3, '
)
WAVY += 'tangential_force_amplitude = 0.25, phase = 4, frequency_ratio = "2/3", bulk_stress_amplitude = 0.1, '
WAVY += "bulk_stress_mean = 0.05, bulk_stress_phase = 1}"
PULL = "normal_amplitude = 0, tangential_amplitude = 0.5, bulk_stress_amplitude = 0.1"
CAP = "[profiles.cap]\nradius = [0, 1, 2, 3, 4, 5, 6, 7]\nheight = [0, 1, 4, 9, 16, 25, 36, 49]"


def grid_of(text: str) -> Grid:
    study, _ = warned(Study.from_text, f'title = "t"\n{text}\n')  # of axes without effect
    return study.grid


#: A study of one point; what it is in words; and its control and strain share, as far as there are some.
POINTS = sayings(r"""
""
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0.75, tangential_amplitude=0.833333, phase=0,
    friction=0.3, poisson_ratio=0.3
# A normal load at rest has neither phase nor frequency.
'fixed = {normal_force_amplitude = 0, tangential_force_amplitude = 0.5, phase = 1, frequency_ratio = "3/2"}'
» profile=paraboloid, frequency_ratio=1/1, normal_force_amplitude=0, tangential_force_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3
» control 3
# It is prescribed as the tangential load is, a tangential one as the normal load.
"fixed = {normal_force_amplitude = 0, tangential_amplitude = 0.5}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3
"fixed = {normal_force_amplitude = 0.5, tangential_amplitude = 0}"
» profile=paraboloid, frequency_ratio=1/1, normal_force_amplitude=0.5, tangential_force_amplitude=0, phase=0,
    friction=0.3, poisson_ratio=0.3
» control 3
"fixed = {normal_force_amplitude = 0, tangential_force_amplitude = 0}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0, phase=0, friction=0.3,
    poisson_ratio=0.3
"fixed = {normal_force_amplitude = 0.2, tangential_amplitude = 0.5}"
» profile=paraboloid, frequency_ratio=1/1, normal_force_amplitude=0.2, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3
» control 1
f"fixed = {WAVY}"
» profile=wavy_paraboloid, waviness_amplitude=0.001, wavelength=5, frequency_ratio=2/3,
    normal_force_amplitude=0.3, tangential_force_amplitude=0.25, phase=0.858407, friction=0.3,
    poisson_ratio=0.3, bulk_stress_amplitude=0.1, bulk_stress_mean=0.05, bulk_stress_phase=1
» control 3
# A plain shape is that of the plain profile; a sensitivity is that of criteria of shear.
'fixed = {criterion = "findley", normal_sensitivity = 0.3, profile = "rounded_punch", flat_radius = 0}'
» profile=paraboloid, frequency_ratio=1/1, criterion=findley, normal_amplitude=0.75,
    tangential_amplitude=0.833333, phase=0, friction=0.3, poisson_ratio=0.3, normal_sensitivity=0.3
'fixed = {profile = "power_law", exponent = 2, walker_exponent = 0.4}'
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0.75, tangential_amplitude=0.833333, phase=0,
    friction=0.3, poisson_ratio=0.3, walker_exponent=0.4
'fixed = {profile = "rounded_flat", flat_half_width = 0, normal_force_amplitude = 0.1,
    tangential_force_amplitude = 0.2}'
» profile=cylinder, frequency_ratio=1/1, normal_force_amplitude=0.1, tangential_force_amplitude=0.2, phase=0,
    friction=0.3, poisson_ratio=0.3
» control 3
f'fixed.profile = "cap"\n{CAP}'
» profile=cap, frequency_ratio=1/1, normal_amplitude=0.75, tangential_amplitude=0.833333, phase=0,
    friction=0.3, poisson_ratio=0.3
# The bulk stress moves the stick zone where it is known by how much: then its share matters.
f"fixed = {{{PULL}}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3, bulk_stress_amplitude=0.1
» share 1.0
f"fixed = {{{PULL}, bulk_strain_share = 0.8, poisson_ratio = 0.25}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.25, bulk_stress_amplitude=0.1, bulk_strain_share=0.8
» share 0.8
f'fixed = {{{PULL}, stick_zone_shift = "none"}}'
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3, bulk_stress_amplitude=0.1
f"fixed = {{{PULL}, friction = 0}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0, friction=0,
    poisson_ratio=0.3, bulk_stress_amplitude=0.1
f"fixed = {{{PULL.replace('normal_amplitude = 0', 'normal_amplitude = 0.1')}, friction = 0.2}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0.1, tangential_amplitude=0.5, phase=0,
    friction=0.2, poisson_ratio=0.3, bulk_stress_amplitude=0.1
f"fixed = {{{PULL.replace('= 0.1', '= 0')}, bulk_stress_phase = 1}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3
f'fixed = {{{PULL}, profile = "rounded_punch", flat_radius = 0.5}}'
» profile=rounded_punch, flat_radius=0.5, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5,
    phase=0, friction=0.3, poisson_ratio=0.3, bulk_stress_amplitude=0.1
# The bulk stress reaches the other body by the stick zone alone.
f"fixed = {{{PULL}, bulk_strain_share = -0.8, bulk_stress_mean = 0.5}}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0, tangential_amplitude=0.5, phase=0,
    friction=0.3, poisson_ratio=0.3, bulk_stress_amplitude=0.1, bulk_strain_share=-0.8
» share -0.8
"fixed = {bulk_stress_amplitude = 0.2, bulk_stress_phase = 1, bulk_strain_share = -0.8}"
» profile=paraboloid, frequency_ratio=1/1, normal_amplitude=0.75, tangential_amplitude=0.833333, phase=0,
    friction=0.3, poisson_ratio=0.3
# A loop has a course of its own: an amplitude that does not scale it does not matter.
'fixed = {load = "mine", normal_amplitude = 0.5, bulk_stress_amplitude = 0.4, phase = 3}\nloads.mine.vertices
    = [[0, 1, 1], [0.5, -1, -1]]'
» profile=paraboloid, load=mine, normal_amplitude=0.5, tangential_amplitude=1, friction=0.3,
    poisson_ratio=0.3, bulk_stress_amplitude=0.4
» share 1.0
""")


@pytest.mark.parametrize(("text", "said"), POINTS)
def test_what_a_point_is_computed_as(text: str, said: list[str]) -> None:
    grid = grid_of(eval(text))
    rows, mirrored = canonical_points(grid, np.arange(1))
    control, share = rows["control"][0], rows["bulk_strain_share"][0]
    numbers = [f"control {control}"] * bool(control) + [f"share {share}"] * bool(share)
    assert [describe_point(rows[0], grid.definitions), *numbers] == said
    assert mirrored.tolist() == [False]


def test_the_time_of_a_point_may_keep_its_origin() -> None:
    grid = grid_of('fixed = {normal_force_amplitude = 0, phase = 4, frequency_ratio = "3/2"}')
    rows, mirrored = canonical_points(grid, np.arange(1), fold=False)
    words = "frequency_ratio=3/2, normal_amplitude=0, tangential_amplitude=0.833333, phase=4"
    assert describe_point(rows[0], grid.definitions) == f"profile=paraboloid, {words}, {BODIES}"
    assert mirrored.tolist() == [False]


def test_phases_of_one_motion_are_one_point() -> None:
    """Also where rounding puts them beside a multiple of the period."""
    phases = [0.5, 0.5 + np.pi, 0.5 - 2.0 * np.pi, 0.0, 2.0 * np.pi, 2.0 * np.pi - 1e-15, 1e-15, 20.0 * np.pi]
    rows, mirrored = canonical_points(grid_of(f"axes.phase = {phases[:5]}"), np.arange(5))
    assert rows["phase"].tolist() == pytest.approx([0.5, 0.5, 0.5, 0.0, 0.0], abs=1e-11)
    assert len({*rows["phase"].tolist()}) == 2
    assert mirrored.tolist() == [False, True, False, False, False]
    for phase in phases[4:]:
        rows, mirrored = canonical_points(grid_of(f"fixed.phase = {phase}"), np.arange(1))
        assert (rows["phase"][0], mirrored[0]) == (0.0, False)


def test_phases_are_folded_into_a_period_of_s() -> None:
    """ψ of odd and even q, and ψ_B beside it: of a point that ψ mirrors or not, and without a motion."""
    phase, p, q = [0.0, 4.0, 7.0, -1.0], [1, 1, 2, 1], [1, 1, 1, 2]
    folded, mirrored = fold_phase(np.array(phase), np.array(p), np.array(q))
    np.testing.assert_allclose(folded, [0.0, 4.0 - np.pi, 7.0 - 2.0 * np.pi, 2.0 * np.pi - 1.0])
    assert mirrored.tolist() == [False, True, False, False]
    moves, by_load = np.array([1, 1, 1, 0, 1], bool), np.array([0, 0, 1, 1, 1], bool)
    both_ways = np.array([1, 1, 0, 1, 1], bool)
    folded, mirrored = fold_bulk_phase(np.array([0.0, 4.0, 4.0, 1.0, 1.0]), moves, by_load, both_ways)
    np.testing.assert_allclose(folded, [0.0, 4.0 - np.pi, 4.0 - np.pi, 0.0, 1.0])
    assert mirrored.tolist() == [False, True, True, True, False]


def test_equal_numbers_are_equal_to_twelve_digits_and_zero_has_no_sign() -> None:
    values = np.array([[0.1 + 0.2, 0.3], [-0.0, 1.00000000000149], [1.0, 2e-300]])
    found = rounded(values)
    assert found.tolist() == [[0.3, 0.3], [0.0, 1.00000000000], [1.0, 2e-300]]
    assert not np.signbit(found).any()
    assert rounded(np.array([1.0000000000051]))[0] != 1.0


def test_rows_are_grouped_by_all_of_their_columns() -> None:
    table = np.zeros(
        5, [("profile", int), ("control", int), ("load", int), ("criterion", int), ("phase", float)]
    )
    table["phase"], table["control"] = [2.0, 1.0, 2.0, 1.0, 2.0], [0, 0, 0, 3, 0]
    first, group = group_rows(table)
    assert (first.tolist(), group.tolist()) == ([1, 0, 3], [1, 0, 1, 2, 1])
    first, group = group_rows(table, np.array([5.0, 5.0, 4.0, 5.0, 5.0]))
    assert (first.tolist(), group.tolist()) == ([1, 2, 0, 3], [2, 0, 1, 3, 2])
    assert [each.tolist() for each in alike(table)] == [[0, 1, 2, 4], [3]]
    assert [each.tolist() for each in alike(table, np.array([5.0, 5.0, 4.0, 5.0, 5.0]))] == [
        [2],
        [0, 1, 4],
        [3],
    ]
    assert alike(table[:0]) == []
    assert [each.tolist() for each in group_rows(table[:0])] == [[], []]


def test_values_of_mirrored_points_have_the_other_sign() -> None:
    grid = grid_of('axes.frequency_ratio = ["1/2", 3]\nfixed.normal_amplitude = 0\naxes.phase = [0, 1]')
    nan, mirrored = np.nan, np.array([True, True, False, True])
    arrays = {
        "s": np.array([1.0, 2.0, 3.0, 4.0]),
        "critical_x": np.array([1.0, 0.0, -2.0, nan]),
        "critical_angle": np.array([-90.0, 90.0, -90.0, 0.0]),
        "stick_left": np.array([-1.0, -0.5, -3.0, 0.0]),
        "stick_right": np.array([0.5, 0.0, 2.0, 0.0]),
        "volume_x": np.array([[1.0, -2.0], [0.0, 3.0], [4.0, 5.0], [nan, 0.0]]),
        "dissipation": np.array([1.0, 1.0, 2.0, 2.0]),
        "dissipation_error": np.array([0.1, 0.1, 0.2, 0.2]),
    }
    expected = arrays | {
        "critical_x": [-1.0, 0.0, -2.0, nan],
        "critical_angle": [90.0, 90.0, 90.0, 0.0],
        "stick_left": [-0.5, 0.0, -3.0, 0.0],
        "stick_right": [1.0, 0.5, 2.0, 0.0],
        "volume_x": [[-1.0, 2.0], [0.0, -3.0], [4.0, 5.0], [nan, 0.0]],
        # A tangential load passes p times in the period of a normal load at rest.
        "dissipation": [1.0, 1.0, 6.0, 6.0],
        "dissipation_error": [0.1, 0.1, 0.6, 0.6],
    }
    found = turned(arrays, mirrored, grid, np.arange(4))
    assert found.keys() == expected.keys()
    for name, values in expected.items():
        np.testing.assert_allclose(found[name], values, rtol=1e-15, err_msg=name)
        assert not np.signbit(found[name][found[name] == 0.0]).any(), name
    back = turned(found, mirrored, grid, np.arange(4), np.divide)
    for name in arrays.keys() - {"critical_angle"}:
        np.testing.assert_allclose(back[name], arrays[name], rtol=1e-15, err_msg=name)
    # Under loops and moving loads a period is that of the point.
    moving = turned(arrays, mirrored, grid_of("axes.frequency_ratio = [1, 3, 2, 4]"), np.arange(4))
    np.testing.assert_array_equal(moving["dissipation"], arrays["dissipation"])
