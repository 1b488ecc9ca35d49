"""Loops and tables that users define: what they hold, what follows, and what is said of wrong ones."""

# ruff: noqa: F401  names in expressions

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from told import lines_of, refused, sayings

import swtstudy
from swtstudy import LoadPath, TabulatedProfile
from swtstudy.study.writing import defined_in, definitions_text

SQUARE = [[0, 1], [0.5, 1], [0.5, -1], [0, -1]]
r = np.linspace(0.0, 2.0, 21)
PAD = TabulatedProfile("pad", r, r**2 / 2)
FACED = TabulatedProfile("faced", r, np.maximum(r - 0.5, 0.0) ** 2)
STRIP = TabulatedProfile("strip", r, r**2 / 2, geometry="plane")
WAVY = TabulatedProfile("wavy", r, r**2 / 2 + 0.05 * (1.0 - np.cos(9.0 * r)))
SMOOTHED = TabulatedProfile("smoothed", r, r**2 / 2 + 0.05 * (1.0 - np.cos(9.0 * r)), 1e-3)
HARMONIC = LoadPath.harmonic_sum(
    "sum", [(1, 0.5, 0)], [(2, 1, 0.1), (0, 0.2, 1.5)], [(3, 0.1, 0)], mean_normal=5
)


def failing(use: Callable[[], Any]) -> Any:
    try:
        return use()
    except ValueError as error:
        return str(error)


def path(vertices: Any, name: str = "a", **more: Any) -> Any:
    return failing(lambda: LoadPath(name, vertices, **more).content())


def sum_of(*columns: Any) -> Any:
    return failing(lambda: LoadPath.harmonic_sum("a", *columns).content())


def sampled(course: Any) -> Any:
    return failing(lambda: LoadPath.sampled("a", course).content())


def table(radius: Any = r, height: Any = PAD.height, name: str = "a", **more: Any) -> Any:
    return failing(lambda: TabulatedProfile(name, radius, height, **more).content().keys())


def changed(values: Any, place: Any, value: Any) -> Any:
    values = np.array(values)
    values[place] = value
    return values


def rounded(found: Any) -> list[Any]:
    return [np.round(np.asarray(each, float), 9).tolist() for each in found]


CASES = sayings(r"""
path(SQUARE) » {'vertices': [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0]]}
path(SQUARE[2:] + SQUARE[:2]) » {'vertices': [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0]]}
path([[0, 1], [0, 0], [0, -1]]) » {'vertices': [[0.0, -1.0], [0.0, 1.0]]}
path([[0, 1, 0.5], [0, 0, 0.5], [0.2, -1, 0.5]])
» {'vertices': [[0.0, 0.0, 0.5], [0.2, -1.0, 0.5], [0.0, 1.0, 0.5]]}
path([[0, 1, 0.0], [0.2, -1, 0.0]]) » {'vertices': [[0.0, 1.0], [0.2, -1.0]]}
path(SQUARE, mean_normal=3)
» {'vertices': [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0]], 'mean_normal': 3.0}
path([[1, 1]]) » vertices of a: found a single point; allowed: 2 distinct points at least
path([[1, 1], [1, 1]]) » vertices of a: found a single point; allowed: 2 distinct points at least
path([1, 2])
» vertices of a: found an array of shape (2,); allowed: pairs of numbers, shape (k, 2), or triples with the
    bulk stress, (k, 3)
path([[1, 2, 3, 4]])
» vertices of a: found an array of shape (1, 4); allowed: pairs of numbers, shape (k, 2), or triples with the
    bulk stress, (k, 3)
path([[1, 2], [1, 2, 3]])
» vertices of a, number 2: found [1, 2, 3]; allowed: 2 numbers, as before: the third one is the bulk stress
path([[1, 2, 3], [1, 2]])
» vertices of a, number 2: found [1, 2]; allowed: 3 numbers, as before: the third one is the bulk stress
path([[1, "x"], [2, 3]])
» vertices of a: found [[1, 'x'], [2, 3]]; allowed: a list of pairs of numbers, or of triples with the bulk
    stress
path([[0, 1], [np.inf, 2]])
» vertices of a, number 2: found [inf, 2.0]; allowed: finite numbers, in magnitude up to 1e+100
path([[0, 1], [1e300, 2]])
» vertices of a, number 2: found [1e+300, 2.0]; allowed: finite numbers, in magnitude up to 1e+100
path(SQUARE, mean_normal=0) » mean_normal of a: found 0; allowed: a positive number: bodies are pressed
path(SQUARE, mean_normal="much")
» mean_normal of a: found 'much'; allowed: a positive number: bodies are pressed
path(SQUARE, mean_normal=-2.0) » mean_normal of a: found -2; allowed: a positive number: bodies are pressed
path(SQUARE, "") » name: found ''; allowed: a text that is not empty
path(SQUARE, "harmonic") » name: found 'harmonic'; allowed: another one: this is a built-in load
path([[np.sin(k), np.cos(k)] for k in range(2001)])
» vertices of a: found 2001 vertices that are not on a line between their neighbours; allowed: at most 2000;
    of more a smooth loop is the harmonic sum (LoadPath.harmonic_sum; harmonics of a signal), and several
    cycles are folded (recorded_cycles)
LoadPath("a", SQUARE).ends » [(0.0, 0.5), (-1.0, 1.0)]
LoadPath("a", SQUARE).normal_ends » (0.0, 0.5)
LoadPath("a", SQUARE).bulk_ends » None
LoadPath("a", SQUARE).is_absolute » False
LoadPath("a", [[-1, 1], [1, -1]]).is_absolute » False
LoadPath("a", [[5, 1], [6, -1]]).is_absolute » True
LoadPath("a", SQUARE).cost » 1
LoadPath("a", [[np.sin(k), np.cos(k)] for k in range(36)]).cost » 4
LoadPath("a", SQUARE).scaled_by » ('normal_amplitude', 'tangential_amplitude')
LoadPath("a", [[0, 1, 0.5], [0.2, -1, 0.0]]).scaled_by
» ('normal_amplitude', 'tangential_amplitude', 'bulk_stress_amplitude')
LoadPath("a", SQUARE).course().tolist() » [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0], [0.0, -1.0]]
LoadPath("a", SQUARE, 3.0).thinned(2).content() » {'vertices': [[0.0, -1.0], [0.5, 1.0]], 'mean_normal': 3.0}
LoadPath("a", SQUARE).thinned(4).content() » {'vertices': [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5, -1.0]]}
LoadPath("a", [[np.sin(k), np.cos(k)] for k in range(36)]).thinned(10).vertices.shape » (9, 2)
LoadPath.absolute("a", [[10, 1], [20, -1], [30, 0.5]]).content()
» {'vertices': [[-10.0, 1.0], [0.0, -1.0], [10.0, 0.5]], 'mean_normal': 20.0}
LoadPath.absolute("a", [[10, 1, 0.1], [20, -1, 0.2]]).content()
» {'vertices': [[-5.0, 1.0, 0.1], [5.0, -1.0, 0.2]], 'mean_normal': 15.0}
LoadPath.trapezoid("a", normal=(0.1, 0.5), tangential=(-0.2, 0.3), bulk=(0.4, 0.6)).content()
» {'vertices': [[0.1, -0.2, 0.4], [0.5, -0.2, 0.4], [0.5, 0.3, 0.6], [0.1, 0.3, 0.6]]}
LoadPath.trapezoid("a").content() » {'vertices': [[0.0, -1.0], [1.0, -1.0], [1.0, 1.0], [0.0, 1.0]]}
LoadPath.triangle("a", normal=0.1, bulk=0.2).content() » {'vertices': [[-0.1, -1.0, -0.2], [0.1, 1.0, 0.2]]}
LoadPath.triangle("a").content() » {'vertices': [[0.0, -1.0], [0.0, 1.0]]}
LoadPath("a", SQUARE) == LoadPath("a", SQUARE[1:] + SQUARE[:1]) » True
LoadPath("a", SQUARE) == LoadPath("b", SQUARE) » False
LoadPath("a", SQUARE) == "a" » False
len({LoadPath("a", SQUARE), LoadPath("a", SQUARE), LoadPath("b", SQUARE)}) » 2
LoadPath("a", SQUARE).code == LoadPath("b", SQUARE).code » True
LoadPath("a", SQUARE).code.bit_length() » 57
repr(LoadPath("a", SQUARE)) » <LoadPath a>
str(LoadPath("a", SQUARE)) » a
HARMONIC.content()
» {'normal': [[1, 0.5, 0.0]], 'tangential': [[2, 1.0, 0.1], [0, 0.2, 1.5]], 'bulk': [[3, 0.1, 0.0]],
    'mean_normal': 5.0}
rounded(HARMONIC.ends) » [[-0.5, 0.5], [-0.800501003, 1.199498997], [-0.1, 0.1]]
HARMONIC.cost » 4
HARMONIC.scaled_by » ('normal_amplitude', 'tangential_amplitude', 'bulk_stress_amplitude')
HARMONIC.course().shape » (721, 3)
rounded(HARMONIC.course()[[0, 180]]) » [[0.0, 0.299332414, 0.0], [0.5, 0.099665581, -0.1]]
sum_of([(1, 0.5, 0)], []) » {'normal': [[1, 0.5, 0.0]], 'tangential': []}
sum_of([(1, 0.5, 0)], [], [(1, 0.0, 0)]) » {'normal': [[1, 0.5, 0.0]], 'tangential': []}
sum_of([], []) » harmonics of a: found nothing that changes; allowed: a loop
sum_of([(0, 1, 0)], [(1, 0, 0)]) » harmonics of a: found nothing that changes; allowed: a loop
sum_of([(1.5, 1, 0)], [])
» normal of a: found (1.5, 1, 0); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(65, 1, 0)], [])
» normal of a: found (65, 1, 0); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(64, 1, 0)], []) » {'normal': [[64, 1.0, 0.0]], 'tangential': []}
sum_of([(-1, 1, 0)], [])
» normal of a: found (-1, 1, 0); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(1, 1)], [])
» normal of a: found (1, 1); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of("abc", [])
» normal of a: found 'abc'; allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(1, "x", 0)], [])
» normal of a: found (1, 'x', 0); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(1, 1e300, 0)], [])
» normal of a: found (1, 1e+300, 0); allowed: rows of order (a whole number up to 64), amplitude and phase
sum_of([(1, 1, 0)], 3)
» tangential of a: found 3; allowed: rows of order (a whole number up to 64), amplitude and phase
LoadPath.harmonic_sum("a", [(5, 0, 0), (2, 1, 0)], []).cost » 3
sampled(lambda turn: (0.5, np.zeros_like(turn))) » harmonics of a: found nothing that changes; allowed: a loop
[rows[0][0] for rows in sampled(lambda turn: (np.sin(3 * turn), np.cos(turn), np.sin(2 * turn))).values()]
» [3, 1, 2]
rounded(sampled(lambda turn: (0.5 + np.cos(turn), np.sin(2 * turn)))["normal"])
» [[0.0, 0.5, 1.570796327], [1.0, 1.0, 1.570796327]]
sampled(lambda turn: np.sin(turn))
» course of a: found a function that fails (1024 columns); allowed: c_n and c_t, or c_n, c_t and c_b, each of
    the shape of φ
sampled(lambda turn: (turn, turn, turn, turn))
» course of a: found a function that fails (4 columns); allowed: c_n and c_t, or c_n, c_t and c_b, each of the
    shape of φ
sampled(lambda turn: (np.sin(turn), "x"))
» course of a: found a function that fails (could not convert string to float: 'x'); allowed: c_n and c_t, or
    c_n, c_t and c_b, each of the shape of φ
sampled(lambda turn: (np.sin(turn), np.nan))
» course of a: found a value that is no finite number; allowed: finite numbers
sampled(lambda turn: (np.sin(65 * turn), np.cos(turn)))
» course of a: found harmonics beyond the order 64, of up to 1; allowed: a smooth loop; one with corners has
    vertices: LoadPath(name, vertices)
sampled(lambda turn: (np.sin(turn), np.abs(turn - 3)))
» course of a: found harmonics beyond the order 64, of up to 0.001; allowed: a smooth loop; one with corners
    has vertices: LoadPath(name, vertices)
repr(PAD) » TabulatedProfile('pad', 21 points up to 2)
[*PAD.content().keys()] » ['radius', 'height', 'smoothing']
STRIP.content()["geometry"] » plane
PAD.flat_radius » 0.0
FACED.flat_radius » 0.5
round(PAD.deviation, 12) » 0.0
round(SMOOTHED.deviation, 3) » 0.003
[*PAD.notes().keys()] » ['deviation']
PAD.scaled(2.0, 0.5).radius.tolist()[1:3] » [0.05, 0.1]
PAD.scaled(2.0, 0.5).height.tolist()[1:3] » [0.010000000000000002, 0.04000000000000001]
SMOOTHED.scaled(2.0, 0.5).smoothing » 0.002
STRIP.scaled(2.0, 0.5).geometry » plane
round(PAD.deepest, 6) » 4.0
round(STRIP.deepest, 6) » 4.0
round(FACED.deepest, 4) » 5.1097
round(WAVY.compact_radius, 3) » 0.374
round(PAD.compact_radius, 9) » 2.0
PAD.refused_at(PAD.deepest) » None
PAD.refused_at(5.0)
» the depth 5 is beyond the table of pad, which ends at the radius 2: the contact is as large as that at the
    depth 4
STRIP.refused_at(5.0)
» the load 4P/(πE*) = 5 is beyond the table of strip, which ends at the half-width 2: the contact is as large
    as that at the load 4P/(πE*) = 4
WAVY.refused_at(5.0)
» at the depth 5 wavy touches in several places: its fit is wavy at the radius 0.3745; if its heights are
    noisy, smoothing takes that away
SMOOTHED.refused_at(5.0)
» at the depth 5 smoothed touches in several places: its fit is wavy at the radius 0.378; its smoothing is
    0.001: more takes noise away, less leaves its shape as it is
TabulatedProfile("wavy", WAVY.radius, WAVY.height, geometry="plane").refused_at(5.0)
» at the load 4P/(πE*) = 5 wavy touches in several places: its fit is wavy at the half-width 0.3285; if its
    heights are noisy, smoothing takes that away
WAVY.least_smoothing(1.0) » None
SMOOTHED.least_smoothing(1e9) » None
0.001 < SMOOTHED.least_smoothing(1.0) < 0.032 » True
rounded(PAD.rise(np.array([0.0, 0.5, 1.0, 2.0])))
» [[0.0, 0.25, 1.0, 4.0], [0.0, 0.083333333, 0.666666667, 5.333333333]]
rounded(STRIP.rise(np.array([0.0, 0.5, 1.0])))
» [[0.0, 0.196349541, 0.785398163], [0.0, 0.196349541, 0.785398163]]
rounded([PAD.density(np.array([0.5, 2.0, 4.0])), PAD.slope(np.array([0.5, 2.0]))])
» [[1.0, 4.0, 8.0], [1.0, 4.0]]
rounded([STRIP.density(np.array([0.5, 2.0])), STRIP.slope(np.array([0.5, 2.0]))])
» [[0.785398163, 3.141592654], [0.785398163, 3.141592654]]
TabulatedProfile.of_content("b", STRIP.content()) == TabulatedProfile("b", r, r ** 2 / 2, geometry="plane")
» True
TabulatedProfile.of_content("b", SMOOTHED.content()).smoothing » 0.001
PAD.radius.flags.writeable » False
table(name="") » name: found ''; allowed: a text that is not empty
table(name="", smoothing=-1.0)
» name: found ''; allowed: a text that is not empty
» profile.smoothing: found -1.0; allowed: a number ≥ 0
table(name="paraboloid") » name: found 'paraboloid'; allowed: another one: this is a built-in profile
table(r[:7], r[:7] ** 2)
» a.radius, a.height: found 7 radii and 7 heights; allowed: as many of each, at least 8
len(table(r[:8], r[:8] ** 2)) » 3
table(r, r[:-1] ** 2)
» a.radius, a.height: found 21 radii and 20 heights; allowed: as many of each, at least 8
table("x") » a.radius: found no one-dimensional array of numbers; allowed: a list of numbers, or an array
table(changed(r, 3, np.nan))
» a.radius: found nan at point 4; allowed: finite numbers: leave out points without a value
table(changed(r, [3, 5], np.nan))
» a.radius: found nan at point 4; 1 more like it; allowed: finite numbers: leave out points without a value
table(height=changed(r**2, 4, np.inf))
» a.height: found inf at point 5; allowed: finite numbers: leave out points without a value
table(changed(r, 20, 1e200)) » a.radius: found up to 1e+200; allowed: in magnitude from 1e-20 to 1e+20
table(1e-200 * r) » a.radius: found up to 2e-200; allowed: in magnitude from 1e-20 to 1e+20
table(np.linspace(0.0, 1.0, 10001), np.linspace(0.0, 1.0, 10001) ** 2)
» a.radius, a.height: found 10001 points; allowed: at most 10000: one of every 2, or the mean of so many
table(np.linspace(0.0, 1.0, 25000), np.linspace(0.0, 1.0, 25000) ** 2)
» a.radius, a.height: found 25000 points; allowed: at most 10000: one of every 3, or the mean of so many
table(r + 1.0)
» a.radius, a.height: found a first point at the radius 1 with the height 0; allowed: 0 and 0: the axis, and
    heights above it
table(height=r**2 + 1.0)
» a.radius, a.height: found a first point at the radius 0 with the height 1; allowed: 0 and 0: the axis, and
    heights above it
table(changed(r, 3, 0.1))
» a.radius: found 0.1 after 0.2; allowed: ascending radii, by 1e-12 of the largest at least
table(changed(r, 3, 0.2))
» a.radius: found 0.2 after 0.2; allowed: ascending radii, by 1e-12 of the largest at least
table(height=-r) » a.height: found heights that fall from the axis; allowed: heights with the other sign
table(height=0.0 * r) » a.height: found a flat face alone; allowed: at least 6 points beside it
table(height=changed(0.0 * r, slice(-5, None), 1.0))
» a.height: found a flat face alone; allowed: at least 6 points beside it
len(table(height=changed(0.0 * r, slice(-6, None), np.arange(1.0, 7.0)))) » 3
table(height=changed(np.maximum(r - 0.5, 0.0), 6, -0.1))
» a.height: found -0.1 at the radius 0.6, below the flat face; allowed: heights above the face: it is the
    lowest part of a profile
table(height=changed(np.maximum(r - 0.5, 0.0), 7, -0.1))
» a.height: found -0.1 at the radius 0.7, below the flat face; allowed: heights above the face: it is the
    lowest part of a profile
list(table(height=changed(r**2, 1, -0.1))) » ['radius', 'height', 'smoothing']
table(smoothing=-1.0) » a.smoothing: found -1.0; allowed: a number ≥ 0
table(smoothing="x") » a.smoothing: found 'x'; allowed: a number ≥ 0
table(smoothing=np.inf) » a.smoothing: found inf; allowed: a number ≥ 0
table(geometry="round") » a.geometry: found 'round'; allowed: one of axisymmetric, plane
definitions_text([LoadPath("a", SQUARE), HARMONIC])
» [{"parameter": "load", "name": "a", "content": {"vertices": [[0.0, -1.0], [0.0, 1.0], [0.5, 1.0], [0.5,
    -1.0]]}}, {"parameter": "load", "name": "sum", "content": {"normal": [[1, 0.5, 0.0]], "tangential": [[2,
    1.0, 0.1], [0, 0.2, 1.5]], "bulk": [[3, 0.1, 0.0]], "mean_normal": 5.0}}]
[*map(str, defined_in({"definitions": definitions_text([HARMONIC, PAD])})["profile"].values())] » ['pad']
defined_in({"definitions": definitions_text([HARMONIC])})["load"]["sum"] == HARMONIC » True
defined_in({}) » {}
failing(lambda: defined_in({"definitions": "{}"})) » {}
failing(lambda: defined_in({"definitions": '[{"parameter": "load"}]'}))
» not definitions: '[{"parameter": "load"}]' ('name')
failing(lambda: defined_in({"definitions": "3"})) » not definitions: '3' ('int' object is not iterable)
""")


@pytest.mark.parametrize(("expression", "said"), CASES)
def test_a_definition_is_what_it_is_made_of(expression: str, said: list[str]) -> None:
    assert lines_of(eval(expression)) == said


@pytest.mark.parametrize("units", [(2.0, 0.5), (1e-4, 1e-6), (1e5, 1e3)])
@pytest.mark.parametrize("table", [PAD, FACED, STRIP, SMOOTHED], ids=str)
def test_a_table_in_other_units_is_as_if_it_were_fitted_in_them(
    table: TabulatedProfile, units: tuple[float, float]
) -> None:
    scaled = table.scaled(*units)
    fitted = TabulatedProfile("anew", scaled.radius, scaled.height, scaled.smoothing, scaled.geometry)
    s = np.linspace(0.1, 1.1, 11) * fitted.end
    for one, other in (
        (scaled.density(s), fitted.density(s)),
        (scaled.rise(s), fitted.rise(s)),
        (scaled.fit(scaled.radius[1:]), fitted.fit(fitted.radius[1:])),
        (scaled.compact_radius, fitted.compact_radius),
        (scaled.smoothed_share(0.2 / units[1]), fitted.smoothed_share(0.2 / units[1])),
    ):
        np.testing.assert_allclose(one, other, rtol=1e-6, atol=1e-9 * np.max(other))


@pytest.mark.parametrize("profile", ["paraboloid", "cylinder"])
def test_a_profile_from_a_function_is_that_profile(profile: str) -> None:
    geometry = "plane" if profile == "cylinder" else "axisymmetric"
    own = TabulatedProfile.sampled("own", lambda x: 0.5 * x**2, 4.0, geometry)
    found = swtstudy.solve(profile=[own, profile], normal_force_amplitude=0.5, tangential_force_amplitude=0.5)
    np.testing.assert_allclose(found.s[0], found.s[1], rtol=1e-4)
    for wrong in (3.0, lambda x: x[:3], lambda x: "high"):
        refused("own.height: found a function that fails", TabulatedProfile.sampled, "own", wrong, 4.0)
    refused("own.radius: found nan", TabulatedProfile.sampled, "own", np.square, "wide")
