"""Words of the vocabulary, whole: numbers, values, mistakes, and what a variable lacks."""

import math
import pickle
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.special import struve

from swtstudy.vocabulary import choices, definition, derived, families, files, mistakes, wording
from swtstudy.vocabulary.quantities import Request, read_quantities


class Silent:
    """What cannot be shown."""

    def __repr__(self) -> str:
        raise ZeroDivisionError


def reported(use: Callable[[mistakes.Report], object]) -> list[str]:
    report = mistakes.Report("file", lambda name: f"fixed.{name}")
    use(report)
    return [str(each) for each in report]


def quantities(raw: object) -> tuple[tuple[str, ...], list[str]]:
    report = mistakes.Report()
    return read_quantities(raw, "q", report), [str(each) for each in report]


def toml(text: str) -> Any:
    try:
        return files.parse_toml(text)
    except files.TomlError as error:
        return str(error), error.shown


def failing(use: Callable[[], Any]) -> Any:
    try:
        return use()
    except ValueError as error:
        return str(error)


def facts(**own: object) -> SimpleNamespace:
    return SimpleNamespace(units="mm", **own)


def lacking(name: str, facts: object, criteria: list[str], distances: tuple[float, ...] = ()) -> list[str]:
    return derived.lacking(name, facts, criteria, Request(distances=distances))


CASES: list[tuple[Callable[[], Any], Any]] = [
    (lambda: wording.axis_words("friction"), "$\\mu$"),
    (lambda: wording.axis_words("phase"), "$\\psi$ (rad)"),
    (lambda: wording.axis_words("walker_exponent"), "Walker exponent, $\\gamma$"),
    (
        lambda: wording.axis_words("normal_sensitivity"),
        "sensitivity of a criterion of shear to the normal stress, $k$",
    ),
    (lambda: wording.axis_words("criterion"), "$\\mathrm{criterion}$"),
    (lambda: wording.axis_words("young_modulus", {"units": "US$", "symbol": "E_1"}), "$E_1$ (US\\$)"),
    (lambda: wording.parameter_words("friction", {"symbol": "m"}), "$m$"),
    (lambda: wording.value_words("phase", 0.0), "0"),
    (lambda: wording.value_words("phase", math.pi * 7 / 20), "7π/20"),
    (lambda: wording.value_words("phase", math.pi * 7 / 21), "π/3"),
    (lambda: wording.value_words("phase", math.pi / 23), "0.1366"),
    (lambda: wording.value_words("frequency_ratio", 63 / 64), "63/64"),
    (lambda: wording.value_words("frequency_ratio", 0.123456), "0.1235"),
    (lambda: wording.value_words("friction", 1 / 20), "0.05"),
    (lambda: wording.value_words("friction", 1 / 21), "0.04762"),
    (lambda: wording.value_words("friction", 1 / 3), "1/3"),
    (lambda: wording.value_words("friction", -1 / 3), "-1/3"),
    (lambda: wording.value_words("friction", 1 / 19), "1/19"),
    (lambda: wording.value_words("friction", math.sqrt(999)), "√999"),
    (lambda: wording.value_words("friction", math.sqrt(1000)), "31.62"),
    (lambda: wording.value_words("friction", math.sqrt(1001)), "31.64"),
    (lambda: wording.value_words("friction", -math.sqrt(2)), "-1.414"),
    (lambda: wording.value_words("friction", 2 / 3 * (1 + 1e-8)), "0.6667"),
    (lambda: wording.value_words("friction", 0.1234567), "0.1235"),
    (lambda: wording.value_words("friction", 123456.0), "123456"),
    (lambda: wording.value_words("friction", 1 / 3, {"units": "rad"}), "1/3"),
    (lambda: wording.value_words("friction", 1 / 3, {"units": ""}), "0.3333"),
    (lambda: wording.value_words("normal_force", 1 / 3), "0.3333"),
    (lambda: wording.value_words("nothing", 1 / 3), "1/3"),
    (lambda: wording.value_words("nothing", "2024-01-02T00:00:00.000"), "2024-01-02"),
    (lambda: wording.value_words("nothing", "2024-01-02T10:00:00"), "2024-01-02T10:00:00"),
    (lambda: wording.value_words("nothing", "2024-01-02 00:00:00"), "2024-01-02"),
    (lambda: wording.number_words(0.0), "0"),
    (lambda: wording.number_words(-123456.789), "-123500"),
    (lambda: wording.number_words(999999.6), "10⁶"),
    (lambda: wording.number_words(1e6), "10⁶"),
    (lambda: wording.number_words(1234567.0), "1.235·10⁶"),
    (lambda: wording.number_words(1e-5), "10⁻⁵"),
    (lambda: wording.number_words(0.0001), "0.0001"),
    (lambda: wording.number_words(-2.5e-7, 2), "-2.5·10⁻⁷"),
    (lambda: wording.number_words(math.inf), "inf"),
    (lambda: wording.number_words(math.nan), "nan"),
    (lambda: wording.number_words(100000.0), "100000"),
    (lambda: wording.number_words(123456.0, 3), "123000"),
    (lambda: wording.plain_words(3), "3"),
    (lambda: wording.plain_words(0.12345678), "0.123457"),
    (lambda: wording.printable("a\x00\tb\nc\x7f\x9f\x0bd\x1fe"), "a�\tb\nc���d�e"),
    (lambda: wording.raised("-1e+05"), "-10⁵"),
    (lambda: wording.raised("1.0e-03"), "10⁻³"),
    (lambda: wording.raised("12e+10"), "12·10¹⁰"),
    (lambda: wording.raised("2.50e+00"), "2.5·10⁰"),
    (lambda: wording.raised("1e5"), "1e5"),
    (lambda: wording.numbers_words([0.01, 999.0, 1e8]), ["0.01", "999", "10⁸"]),
    (lambda: wording.numbers_words([0.0099, 1000.0, 1e8]), ["9.9·10⁻³", "10³", "10⁸"]),
    (
        lambda: wording.numbers_words([-0.0099, -1000.0, 1e8, math.nan, -math.inf, 0.0]),
        ["-9.9·10⁻³", "-10³", "10⁸", "nan", "-inf", "0"],
    ),
    (lambda: wording.numbers_words([1e6, 5.0], 3), ["10⁶", "5"]),
    (lambda: wording.numbers_words([1.0, 2.0]), ["1", "2"]),
    (lambda: wording.number_of(0, "point"), "0 points"),
    (lambda: wording.listed(["a", "b", "c"], 3), "a, b, c"),
    (lambda: wording.listed(["a", "b", "c", "d"], 3), "a, b … d (4 values)"),
    (
        lambda: wording.html_table([("a<", "b", "c&", "d"), ("1", "2", "3", "4")]),
        (
            "<table><tr><td>a&lt;</td><td><b>b</b></td><td>c&amp;</td><td>d</td></tr><tr><td>1</td><t"
            "d><b>2</b></td><td>3</td><td>4</td></tr></table>"
        ),
    ),
    (lambda: wording.coordinate_words("body", "pad", {"flag_values": [1], "flag_meanings": "a_b"}), "pad"),
    (
        lambda: wording.coordinate_words(
            "body", 1.0, {"flag_values": [1, 2], "flag_meanings": "upper_pad b"}
        ),
        "upper pad",
    ),
    (lambda: wording.coordinate_words("friction", 1 / 3), "1/3"),
    (lambda: wording.place_words("criterion", "fatemi_socie"), "Fatemi-Socie parameter"),
    (lambda: wording.place_words("stick_zone_shift", "moved"), "stick zone moved"),
    (lambda: wording.place_words("stick_zone_shift", "none"), "stick zone in place"),
    (
        lambda: wording.place_words("body", 2, {"flag_values": [1, 2], "flag_meanings": "pad test_piece"}),
        "test piece",
    ),
    (lambda: wording.place_words("load", "start_up$"), "start up\\$"),
    (lambda: wording.place_words("normal_force", 12.5, {"units": "N", "symbol": "F"}), "$F$ = 12.5 N"),
    (lambda: wording.place_words("phase", math.pi, {"units": "rad"}), "$\\psi$ = π"),
    (lambda: wording.unit_words(""), ""),
    (lambda: wording.pi_words(Fraction(0)), "0"),
    (lambda: wording.pi_words(Fraction(-3, 4)), "-3π/4"),
    (lambda: wording.pi_words(Fraction(-1)), "-π"),
    (lambda: wording.duration(9.949), "9.9 s"),
    (lambda: wording.duration(10.0), "10 s"),
    (lambda: wording.duration(59.5), "1 min 0 s"),
    (lambda: wording.duration(60.0), "1 min 0 s"),
    (lambda: wording.duration(3599.6), "1 h 0 min"),
    (lambda: wording.duration(7325.0), "2 h 2 min"),
    (lambda: mistakes.literal("a\n  b"), "'a\\n  b'"),
    (lambda: mistakes.literal("x" * 58), "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'"),
    (lambda: mistakes.literal("x" * 59), "'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…"),
    (lambda: mistakes.literal(list(range(40)), 20), "[0, 1, 2, 3, 4, 5, …"),
    (lambda: mistakes.literal(10**5000), "int with too many digits to be shown"),
    (lambda: mistakes.literal(Silent()), "Silent that cannot be shown"),
    (lambda: mistakes.more_like_it(2), "; 1 more like it"),
    (lambda: mistakes.storable("a\0"), False),
    (lambda: mistakes.storable("a\ud800"), False),
    (lambda: mistakes.storable("a\udfff"), False),
    (lambda: mistakes.storable("a\ue000"), True),
    (lambda: mistakes.storable("ä"), True),
    (lambda: mistakes.plain(np.float64(2.5)), 2.5),
    (lambda: mistakes.plain(np.array(3)), 3),
    (lambda: mistakes.plain(np.array([3])).tolist(), [3]),
    (lambda: mistakes.plain("a"), "a"),
    (lambda: bool(mistakes.plain(np.datetime64("2020", "Y")) == np.datetime64("2020", "Y")), True),
    (lambda: mistakes.plain(np.ma.masked) is np.ma.masked, True),
    (lambda: mistakes.is_number(True), False),
    (lambda: mistakes.is_number(np.timedelta64(1, "s")), False),
    (lambda: mistakes.is_number(Fraction(1, 2)), True),
    (lambda: mistakes.is_number(Decimal("0.5")), True),
    (lambda: mistakes.is_number("1"), False),
    (lambda: mistakes.is_number(1j), False),
    (lambda: mistakes.is_whole(True, 0), False),
    (lambda: mistakes.is_whole(0, 0), True),
    (lambda: mistakes.is_whole(-1, 0), False),
    (lambda: mistakes.is_whole(3, 0, 3), True),
    (lambda: mistakes.is_whole(4, 0, 3), False),
    (lambda: mistakes.is_whole(2.0, 0), False),
    (lambda: mistakes.is_whole(np.int8(2), 2), True),
    (lambda: mistakes.plain_number(10**400), math.inf),
    (lambda: mistakes.plain_number("1"), math.nan),
    (lambda: mistakes.plain_number(True), math.nan),
    (lambda: mistakes.plain_number(Decimal("sNaN")), math.nan),
    (lambda: mistakes.plain_number(Fraction(1, 4)), 0.25),
    (lambda: mistakes.plain_number(np.array(0.5)), 0.5),
    (
        lambda: mistakes.nearest("u_A", ["tangential_amplitude", "phase"]),
        "did you mean tangential_amplitude (uA)? known: tangential_amplitude, phase",
    ),
    (
        lambda: mistakes.nearest("fricton", ["friction", "phase"]),
        "did you mean friction? known: friction, phase",
    ),
    (lambda: mistakes.nearest("zzz", ["friction", "phase"]), "one of friction, phase"),
    (lambda: mistakes.nearest("mu", ["phase"]), "one of phase"),
    (lambda: mistakes.meant("zzz", ["friction"]), None),
    (lambda: mistakes.meant("FRICTION", ["friction"]), "friction"),
    (lambda: mistakes.meant("start_up", ["start-up"]), "start-up"),
    (lambda: mistakes.meant("psi", ["phase", "friction"]), "phase"),
    (lambda: mistakes.is_rtol(1e-7), True),
    (lambda: mistakes.is_rtol(0.1), True),
    (lambda: mistakes.is_rtol(0.99e-7), False),
    (lambda: mistakes.is_rtol(0.1001), False),
    (lambda: mistakes.is_rtol("0.01"), False),
    (lambda: str(mistakes.Mistake("", "a", "b")), "found a; allowed: b"),
    (
        lambda: str(mistakes.Mistake("key", "a\x1b", "b", "file", "one\ntwo\t")),
        "file: key: found a\\x1b; allowed: b\none\ntwo\\t",
    ),
    (lambda: str(mistakes.Mistake("", "a", "b", "file")), "file: found a; allowed: b"),
    (lambda: str(mistakes.refused("key", "a", "b", "file")), "file: key: found a; allowed: b"),
    (
        lambda: reported(
            lambda report: (report("k", "f", "a"), report.of(["a", "b"], "x", "y"), report.of("c", "x", "y"))
        ),
        [
            "file: k: found f; allowed: a",
            "file: fixed.a, fixed.b: found x; allowed: y",
            "file: fixed.c: found x; allowed: y",
        ],
    ),
    (
        lambda: reported(
            lambda report: (
                report.rtol(0.1),
                report.rtol(0.2),
                report.seed(-1),
                report.seed(0),
                report.seed(2**32),
                report.seed(2**32 - 1),
                report.seed(True),
            )
        ),
        [
            "file: rtol: found 0.2; allowed: a number in [1e-07, 0.1]",
            "file: seed: found -1; allowed: a whole number from 0 to 4294967295",
            "file: seed: found 4294967296; allowed: a whole number from 0 to 4294967295",
            "file: seed: found True; allowed: a whole number from 0 to 4294967295",
        ],
    ),
    (lambda: str(pickle.loads(pickle.dumps(mistakes.refused("key", "a", "b")))), "key: found a; allowed: b"),
    (
        lambda: quantities("dissipation"),
        (
            (),
            [
                (
                    "q: found 'dissipation'; allowed: a list of dissipation, stick_radius, stick_left, "
                    "stick_right, contact_radius, force_ratio, von_mises"
                )
            ],
        ),
    ),
    (
        lambda: quantities(3),
        (
            (),
            [
                (
                    "q: found 3; allowed: a list of dissipation, stick_radius, stick_left, stick_right, "
                    "contact_radius, force_ratio, von_mises"
                )
            ],
        ),
    ),
    (lambda: quantities([]), ((), [])),
    (lambda: quantities(["dissipation", "stick_right"]), (("dissipation", "stick_right", "stick_left"), [])),
    (
        lambda: quantities(
            ["dissipation", 3, "dissipation", "s_volume", "counted", "dissipaton", "counted_number"]
        ),
        (
            ("dissipation",),
            [
                (
                    "q[1]: found 3; allowed: a list of dissipation, stick_radius, stick_left, stick_right, "
                    "contact_radius, force_ratio, von_mises"
                ),
                "q[2]: found 'dissipation', the same as q[0]; allowed: each quantity once",
                "q[3]: found 's_volume'; allowed: a value of critical_distance instead, which asks for it",
                "q[4]: found 'counted'; allowed: it in studies with [material], which have it",
                (
                    "q[5]: found unknown quantity 'dissipaton'; allowed: did you mean dissipation? known: "
                    "dissipation, stick_radius, stick_left, stick_right, contact_radius, force_ratio, "
                    "von_mises"
                ),
                "q[6]: found 'counted_number'; allowed: it in studies with [material], which have it",
            ],
        ),
    ),
    (
        lambda: toml("a = "),
        ("a syntax error: Invalid value (at end of document)", "   1 | a = \n     |     ^"),
    ),
    (
        lambda: toml("a = 1\na = 2"),
        ("a syntax error: the key 'a' twice (at end of document)", "   2 | a = 2\n     |      ^"),
    ),
    (
        lambda: toml("[a]\n[a]"),
        ("a syntax error: the table 'a' twice (at line 2, column 3)", "   2 | [a]\n     |   ^"),
    ),
    (
        lambda: toml("a = 0,5"),
        (
            (
                "a syntax error: Expected newline or end of document after a statement (at line 1, "
                "column 6); a decimal comma? Numbers have a decimal point: 0.5"
            ),
            "   1 | a = 0,5\n     |      ^",
        ),
    ),
    (
        lambda: toml("a = 1\nb = -1,25e3 # comment"),
        (
            (
                "a syntax error: Expected newline or end of document after a statement (at line 2, "
                "column 7); a decimal comma? Numbers have a decimal point: -1.25e3"
            ),
            "   2 | b = -1,25e3 # comment\n     |       ^",
        ),
    ),
    (
        lambda: toml("a = [1,2"),
        ("a syntax error: Unclosed array (at end of document)", "   1 | a = [1,2\n     |         ^"),
    ),
    (lambda: toml("x = 1" + "0" * 5000), ("an integer with too many digits", "")),
    (lambda: toml("a = " + "[" * 10000), ("a syntax error: nested too deeply", "")),
    (
        lambda: toml("a = 'x' " + "y" * 120),
        (
            ("a syntax error: Expected newline or end of document after a statement (at line 1, column 9)"),
            (
                "   1 | a = 'x' "
                "yyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyyy"
                "yyyy\n     |         ^"
            ),
        ),
    ),
    (lambda: toml(""), {}),
    (lambda: toml("a.b = 1"), {"a": {"b": 1}}),
    (
        lambda: toml("[a.b]\n[a.b]\n"),
        ("a syntax error: the table 'a', 'b' twice (at line 2, column 5)", "   2 | [a.b]\n     |     ^"),
    ),
    (lambda: files.plain_float("1.5"), 1.5),
    (lambda: failing(lambda: files.plain_float("1_0")), "not a number"),
    (lambda: failing(lambda: files.plain_float("x")), "could not convert string to float: 'x'"),
    (lambda: str(definition.wrong_name("", "load")), "name: found ''; allowed: a text that is not empty"),
    (lambda: str(definition.wrong_name("  ", "load")), "name: found '  '; allowed: a text that is not empty"),
    (lambda: str(definition.wrong_name(3, "load")), "name: found 3; allowed: a text that is not empty"),
    (
        lambda: str(definition.wrong_name("a\0", "profile")),
        "name: found 'a\\x00'; allowed: a text that an archive can hold, without a null character",
    ),
    (
        lambda: str(definition.wrong_name("harmonic", "load")),
        "name: found 'harmonic'; allowed: another one: this is a built-in load",
    ),
    (lambda: str(definition.wrong_name("cone", "profile")), "None"),
    (lambda: definition.read_numbers("k", [1, Fraction(1, 2)], "a").tolist(), [1.0, 0.5]),
    (lambda: definition.read_numbers("k", np.ma.masked_equal([1, 2], 2), "a").tolist(), [1.0, math.nan]),
    (lambda: definition.read_numbers("k", [[1, 2], [3, 4]], "a").tolist(), [[1.0, 2.0], [3.0, 4.0]]),
    (lambda: definition.read_numbers("k", 3, "a").tolist(), 3.0),
    (
        lambda: failing(lambda: definition.read_numbers("k", [1, "x"], "numbers")),
        "k: found [1, 'x']; allowed: numbers",
    ),
    (
        lambda: failing(lambda: definition.read_numbers("k", [1, [2]], "numbers")),
        "k: found [1, [2]]; allowed: numbers",
    ),
    (
        lambda: failing(lambda: definition.read_numbers("k", [True], "numbers")),
        "k: found [True]; allowed: numbers",
    ),
    (
        lambda: failing(lambda: definition.read_numbers("k", [1j], "numbers")),
        "k: found [1j]; allowed: numbers",
    ),
    (
        lambda: failing(lambda: definition.read_numbers("k", ["x"], "numbers")),
        "k: found ['x']; allowed: numbers",
    ),
    (lambda: lacking("SWT", None, []), ["units", 'the criterion "swt"']),
    (lambda: lacking("SWT", facts(), ["swt"]), []),
    (
        lambda: lacking("cycles", facts(), ["swt"]),
        ["fatigue constants ([material], swtstudy.FatigueConstants)"],
    ),
    (
        lambda: lacking("cycles_volume", facts(), ["findley"]),
        [
            "fatigue constants ([material], swtstudy.FatigueConstants)",
            'the criterion "swt"',
            "a critical_distance",
        ],
    ),
    (
        lambda: lacking("cycles_volume_50", None, ["swt"]),
        [
            "units",
            "constants that scatter",
            "fatigue constants ([material], swtstudy.FatigueConstants)",
            "a critical_distance",
        ],
    ),
    (lambda: lacking("FS_damage_share", facts(materials=(1,)), ["fatemi_socie"]), ["blocks"]),
    (lambda: lacking("yield_ratio", facts(), ["swt"]), ["a yield_strength"]),
    (lambda: lacking("findley_usage", facts(), ["findley"]), ["a findley_limit"]),
    (lambda: lacking("findley_usage_line", facts(findley_limits=(1,)), ["findley"], (0.1,)), []),
    (lambda: lacking("failure_probability", facts(materials=(1,)), ["swt"]), ["a target_life"]),
    (lambda: lacking("nothing", None, []), []),
    (lambda: choices.without_life([]), ""),
    (lambda: choices.without_life(["findley"]), "findley"),
    (lambda: choices.without_life(["findley", "swt"]), ""),
    (lambda: choices.families_with("flat_radius"), ["rounded_punch", "truncated_paraboloid"]),
    (lambda: choices.families_with("exponent"), ["power_law", "power_law_cylinder"]),
    (lambda: choices.is_plane("cylinder"), True),
    (lambda: choices.is_plane("mine"), False),
    (lambda: choices.with_values_of("swt of SWT0", "FS"), "FS of SWT0"),
    (lambda: choices.family_of("mine").shape, ()),
    (
        lambda: [choices.FAMILIES[name].plain for name in choices.FAMILIES],
        [
            None,
            ("flat_radius", 0.0),
            ("flat_radius", 0.0),
            ("waviness_amplitude", 0.0),
            ("exponent", 2.0),
            None,
            ("flat_half_width", 0.0),
            ("waviness_amplitude", 0.0),
            ("exponent", 2.0),
        ],
    ),
]


def test_waves_are_known_at_all_that_is_asked() -> None:
    """H₀(x) + x (2/π − H₁(x)) by SciPy, where that has a value."""
    x = np.concatenate([np.linspace(0.0, 60.0, 997), np.linspace(60.0, 3000.0, 997)])
    found, expected = families.wave(x), struve(0, x) + x * (2.0 / np.pi - struve(1, x))
    assert np.isfinite(found).all()
    there = np.isfinite(expected)
    np.testing.assert_allclose(found[there], expected[there], rtol=1e-8, atol=1e-7)


@pytest.mark.parametrize(("found", "expected"), CASES)
def test_words_are_these(found: Callable[[], Any], expected: object) -> None:
    assert repr(found()) == repr(expected)
