"""Words of the vocabulary, whole: numbers, values, mistakes, and what a variable lacks."""

# ruff: noqa: F401  names in expressions

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
from told import lines_of, sayings

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


CASES = sayings(r"""
wording.axis_words("friction") » $\mu$
wording.axis_words("phase") » $\psi$ (rad)
wording.axis_words("walker_exponent") » Walker exponent, $\gamma$
wording.axis_words("normal_sensitivity") » sensitivity of a criterion of shear to the normal stress, $k$
wording.axis_words("criterion") » $\mathrm{criterion}$
wording.axis_words("young_modulus", {"units": "US$", "symbol": "E_1"}) » $E_1$ (US\$)
wording.parameter_words("friction", {"symbol": "m"}) » $m$
wording.value_words("phase", 0.0) » 0
wording.value_words("phase", math.pi * 7 / 20) » 7π/20
wording.value_words("phase", math.pi * 7 / 21) » π/3
wording.value_words("phase", math.pi / 23) » 0.1366
wording.value_words("frequency_ratio", 63 / 64) » 63/64
wording.value_words("frequency_ratio", 0.123456) » 0.1235
wording.value_words("friction", 1 / 20) » 0.05
wording.value_words("friction", 1 / 21) » 0.04762
wording.value_words("friction", 1 / 3) » 1/3
wording.value_words("friction", -1 / 3) » -1/3
wording.value_words("friction", 1 / 19) » 1/19
wording.value_words("friction", math.sqrt(999)) » √999
wording.value_words("friction", math.sqrt(1000)) » 31.62
wording.value_words("friction", math.sqrt(1001)) » 31.64
wording.value_words("friction", -math.sqrt(2)) » -1.414
wording.value_words("friction", 2 / 3 * (1 + 1e-8)) » 0.6667
wording.value_words("friction", 0.1234567) » 0.1235
wording.value_words("friction", 123456.0) » 123456
wording.value_words("friction", 1 / 3, {"units": "rad"}) » 1/3
wording.value_words("friction", 1 / 3, {"units": ""}) » 0.3333
wording.value_words("normal_force", 1 / 3) » 0.3333
wording.value_words("nothing", 1 / 3) » 1/3
wording.value_words("nothing", "2024-01-02T00:00:00.000") » 2024-01-02
wording.value_words("nothing", "2024-01-02T10:00:00") » 2024-01-02T10:00:00
wording.value_words("nothing", "2024-01-02 00:00:00") » 2024-01-02
wording.number_words(0.0) » 0
wording.number_words(-123456.789) » -123500
wording.number_words(999999.6) » 10⁶
wording.number_words(1e6) » 10⁶
wording.number_words(1234567.0) » 1.235·10⁶
wording.number_words(1e-5) » 10⁻⁵
wording.number_words(0.0001) » 0.0001
wording.number_words(-2.5e-7, 2) » -2.5·10⁻⁷
wording.number_words(math.inf) » inf
wording.number_words(math.nan) » nan
wording.number_words(100000.0) » 100000
wording.number_words(123456.0, 3) » 123000
wording.plain_words(3) » 3
wording.plain_words(0.12345678) » 0.123457
wording.printable("a\x00\tb c\x7f\x9f\x0bd\x1fe").replace("\t", "TAB") » a�TABb c���d�e
wording.printable("a\nb")
» a
» b
wording.raised("-1e+05") » -10⁵
wording.raised("1.0e-03") » 10⁻³
wording.raised("12e+10") » 12·10¹⁰
wording.raised("2.50e+00") » 2.5·10⁰
wording.raised("1e5") » 1e5
wording.numbers_words([0.01, 999.0, 1e8]) » ['0.01', '999', '10⁸']
wording.numbers_words([0.0099, 1000.0, 1e8]) » ['9.9·10⁻³', '10³', '10⁸']
wording.numbers_words([-0.0099, -1000.0, 1e8, math.nan, -math.inf, 0.0])
» ['-9.9·10⁻³', '-10³', '10⁸', 'nan', '-inf', '0']
wording.numbers_words([1e6, 5.0], 3) » ['10⁶', '5']
wording.numbers_words([1.0, 2.0]) » ['1', '2']
wording.number_of(0, "point") » 0 points
wording.listed(["a", "b", "c"], 3) » a, b, c
wording.listed(["a", "b", "c", "d"], 3) » a, b … d (4 values)
wording.html_table([("a<", "b", "c&", "d")])
» <table><tr><td>a&lt;</td><td><b>b</b></td><td>c&amp;</td><td>d</td></tr></table>
wording.coordinate_words("body", "pad", {"flag_values": [1], "flag_meanings": "a_b"}) » pad
wording.coordinate_words("body", 1.0, {"flag_values": [1, 2], "flag_meanings": "upper_pad b"}) » upper pad
wording.coordinate_words("friction", 1 / 3) » 1/3
wording.place_words("criterion", "fatemi_socie") » Fatemi-Socie parameter
wording.place_words("stick_zone_shift", "moved") » stick zone moved
wording.place_words("stick_zone_shift", "none") » stick zone in place
wording.place_words("body", 2, {"flag_values": [1, 2], "flag_meanings": "pad test_piece"}) » test piece
wording.place_words("load", "start_up$") » start up\$
wording.place_words("normal_force", 12.5, {"units": "N", "symbol": "F"}) » $F$ = 12.5 N
wording.place_words("phase", math.pi, {"units": "rad"}) » $\psi$ = π
wording.unit_words("") » ''
wording.pi_words(Fraction(0)) » 0
wording.pi_words(Fraction(-3, 4)) » -3π/4
wording.pi_words(Fraction(-1)) » -π
wording.duration(9.949) » 9.9 s
wording.duration(10.0) » 10 s
wording.duration(59.5) » 1 min 0 s
wording.duration(60.0) » 1 min 0 s
wording.duration(3599.6) » 1 h 0 min
wording.duration(7325.0) » 2 h 2 min
mistakes.literal("a\n  b") » 'a\n  b'
mistakes.literal("x" * 58) » 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx'
mistakes.literal("x" * 59) » 'xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…
mistakes.literal(list(range(40)), 20) » [0, 1, 2, 3, 4, 5, …
mistakes.literal(10**5000) » int with too many digits to be shown
mistakes.literal(Silent()) » Silent that cannot be shown
mistakes.more_like_it(2) » ; 1 more like it
mistakes.storable("a\0") » False
mistakes.storable("a\ud800") » False
mistakes.storable("a\udfff") » False
mistakes.storable("a\ue000") » True
mistakes.storable("ä") » True
mistakes.plain(np.float64(2.5)) » 2.5
mistakes.plain(np.array(3)) » 3
mistakes.plain(np.array([3])).tolist() » [3]
mistakes.plain("a") » a
bool(mistakes.plain(np.datetime64("2020", "Y")) == np.datetime64("2020", "Y")) » True
mistakes.plain(np.ma.masked) is np.ma.masked » True
mistakes.is_number(True) » False
mistakes.is_number(np.timedelta64(1, "s")) » False
mistakes.is_number(Fraction(1, 2)) » True
mistakes.is_number(Decimal("0.5")) » True
mistakes.is_number("1") » False
mistakes.is_number(1j) » False
mistakes.is_whole(True, 0) » False
mistakes.is_whole(0, 0) » True
mistakes.is_whole(-1, 0) » False
mistakes.is_whole(3, 0, 3) » True
mistakes.is_whole(4, 0, 3) » False
mistakes.is_whole(2.0, 0) » False
mistakes.is_whole(np.int8(2), 2) » True
mistakes.plain_number(10**400) » inf
mistakes.plain_number("1") » nan
mistakes.plain_number(True) » nan
mistakes.plain_number(Decimal("sNaN")) » nan
mistakes.plain_number(Fraction(1, 4)) » 0.25
mistakes.plain_number(np.array(0.5)) » 0.5
mistakes.nearest("u_A", ["tangential_amplitude", "phase"])
» did you mean tangential_amplitude (uA)? known: tangential_amplitude, phase
mistakes.nearest("fricton", ["friction", "phase"]) » did you mean friction? known: friction, phase
mistakes.nearest("zzz", ["friction", "phase"]) » one of friction, phase
mistakes.nearest("mu", ["phase"]) » one of phase
mistakes.meant("zzz", ["friction"]) » None
mistakes.meant("FRICTION", ["friction"]) » friction
mistakes.meant("start_up", ["start-up"]) » start-up
mistakes.meant("psi", ["phase", "friction"]) » phase
mistakes.is_rtol(1e-7) » True
mistakes.is_rtol(0.1) » True
mistakes.is_rtol(0.99e-7) » False
mistakes.is_rtol(0.1001) » False
mistakes.is_rtol("0.01") » False
str(mistakes.Mistake("", "a", "b")) » found a; allowed: b
str(mistakes.Mistake("key", "a\x1b", "b", "file", "one\ntwo\t"))
» file: key: found a\x1b; allowed: b
» one
» two\t
str(mistakes.Mistake("", "a", "b", "file")) » file: found a; allowed: b
str(mistakes.refused("key", "a", "b", "file")) » file: key: found a; allowed: b
reported(lambda report: (report("k", "f", "a"), report.of(["a", "b"], "x", "y"), report.of("c", "x", "y")))
» ['file: k: found f; allowed: a', 'file: fixed.a, fixed.b: found x; allowed: y', 'file: fixed.c: found x;
    allowed: y']
reported(lambda report: (report.rtol(0.1), report.rtol(0.2), report.seed(-1), report.seed(0), report.seed(2 **
    32), report.seed(2 ** 32 - 1), report.seed(True)))
» ['file: rtol: found 0.2; allowed: a number in [1e-07, 0.1]', 'file: seed: found -1; allowed: a whole number
    from 0 to 4294967295', 'file: seed: found 4294967296; allowed: a whole number from 0 to 4294967295',
    'file: seed: found True; allowed: a whole number from 0 to 4294967295']
str(pickle.loads(pickle.dumps(mistakes.refused("key", "a", "b")))) » key: found a; allowed: b
quantities("dissipation")
» ((), ["q: found 'dissipation'; allowed: a list of dissipation, stick_radius, stick_left, stick_right,
    contact_radius, force_ratio, von_mises"])
quantities(3)
» ((), ['q: found 3; allowed: a list of dissipation, stick_radius, stick_left, stick_right, contact_radius,
    force_ratio, von_mises'])
quantities([]) » ((), [])
quantities(["dissipation", "stick_right"]) » (('dissipation', 'stick_right', 'stick_left'), [])
quantities(["dissipation", 3, "dissipation", "s_volume", "counted", "dissipaton", "counted_number"])
» (('dissipation',), ['q[1]: found 3; allowed: a list of dissipation, stick_radius, stick_left, stick_right,
    contact_radius, force_ratio, von_mises', "q[2]: found 'dissipation', the same as q[0]; allowed: each
    quantity once", "q[3]: found 's_volume'; allowed: a value of critical_distance instead, which asks for
    it", "q[4]: found 'counted'; allowed: it in studies with [material], which have it", "q[5]: found unknown
    quantity 'dissipaton'; allowed: did you mean dissipation? known: dissipation, stick_radius, stick_left,
    stick_right, contact_radius, force_ratio, von_mises", "q[6]: found 'counted_number'; allowed: it in
    studies with [material], which have it"])
toml("a = ") » ('a syntax error: Invalid value (at end of document)', '   1 | a = \n     |     ^')
toml("a = 1\na = 2")
» ("a syntax error: the key 'a' twice (at end of document)", '   2 | a = 2\n     |      ^')
toml("[a]\n[a]") » ("a syntax error: the table 'a' twice (at line 2, column 3)", '   2 | [a]\n     |   ^')
toml("a = 0,5")
» ('a syntax error: Expected newline or end of document after a statement (at line 1, column 6); a decimal
    comma? Numbers have a decimal point: 0.5', '   1 | a = 0,5\n     |      ^')
toml("a = 1\nb = -1,25e3 # comment")
» ('a syntax error: Expected newline or end of document after a statement (at line 2, column 7); a decimal
    comma? Numbers have a decimal point: -1.25e3', '   2 | b = -1,25e3 # comment\n     |       ^')
toml("a = [1,2")
» ('a syntax error: Unclosed array (at end of document)', '   1 | a = [1,2\n     |         ^')
toml("x = 1" + "0" * 5000) » ('an integer with too many digits', '')
toml("a = " + "[" * 10000) » ('a syntax error: nested too deeply', '')
toml("a = 'x' " + "y" * 120)[1].count("y") » 92
toml("") » {}
toml("a.b = 1") » {'a': {'b': 1}}
toml("[a.b]\n[a.b]\n")
» ("a syntax error: the table 'a', 'b' twice (at line 2, column 5)", '   2 | [a.b]\n     |     ^')
files.plain_float("1.5") » 1.5
failing(lambda: files.plain_float("1_0")) » not a number
failing(lambda: files.plain_float("x")) » could not convert string to float: 'x'
str(definition.wrong_name("", "load")) » name: found ''; allowed: a text that is not empty
str(definition.wrong_name("  ", "load")) » name: found '  '; allowed: a text that is not empty
str(definition.wrong_name(3, "load")) » name: found 3; allowed: a text that is not empty
str(definition.wrong_name("a\0", "profile"))
» name: found 'a\x00'; allowed: a text that an archive can hold, without a null character
str(definition.wrong_name("harmonic", "load"))
» name: found 'harmonic'; allowed: another one: this is a built-in load
str(definition.wrong_name("cone", "profile")) » None
definition.read_numbers("k", [1, Fraction(1, 2)], "a").tolist() » [1.0, 0.5]
definition.read_numbers("k", np.ma.masked_equal([1, 2], 2), "a").tolist() » [1.0, nan]
definition.read_numbers("k", [[1, 2], [3, 4]], "a").tolist() » [[1.0, 2.0], [3.0, 4.0]]
definition.read_numbers("k", 3, "a").tolist() » 3.0
failing(lambda: definition.read_numbers("k", [1, "x"], "numbers")) » k: found [1, 'x']; allowed: numbers
failing(lambda: definition.read_numbers("k", [1, [2]], "numbers")) » k: found [1, [2]]; allowed: numbers
failing(lambda: definition.read_numbers("k", [True], "numbers")) » k: found [True]; allowed: numbers
failing(lambda: definition.read_numbers("k", [1j], "numbers")) » k: found [1j]; allowed: numbers
failing(lambda: definition.read_numbers("k", ["x"], "numbers")) » k: found ['x']; allowed: numbers
lacking("SWT", None, []) » ['units', 'the criterion "swt"']
lacking("SWT", facts(), ["swt"]) » []
lacking("cycles", facts(), ["swt"]) » ['fatigue constants ([material], swtstudy.FatigueConstants)']
lacking("cycles_volume", facts(), ["findley"])
» ['fatigue constants ([material], swtstudy.FatigueConstants)', 'the criterion "swt"', 'a critical_distance']
lacking("cycles_volume_50", None, ["swt"])
» ['units', 'constants that scatter', 'fatigue constants ([material], swtstudy.FatigueConstants)', 'a
    critical_distance']
lacking("FS_damage_share", facts(materials=(1,)), ["fatemi_socie"]) » ['blocks']
lacking("yield_ratio", facts(), ["swt"]) » ['a yield_strength']
lacking("findley_usage", facts(), ["findley"]) » ['a findley_limit']
lacking("findley_usage_line", facts(findley_limits=(1,)), ["findley"], (0.1,)) » []
lacking("failure_probability", facts(materials=(1,)), ["swt"]) » ['a target_life']
lacking("nothing", None, []) » []
choices.without_life([]) » ''
choices.without_life(["findley"]) » findley
choices.without_life(["findley", "swt"]) » ''
choices.families_with("flat_radius") » ['rounded_punch', 'truncated_paraboloid']
choices.families_with("exponent") » ['power_law', 'power_law_cylinder']
choices.is_plane("cylinder") » True
choices.is_plane("mine") » False
choices.with_values_of("swt of SWT0", "FS") » FS of SWT0
choices.family_of("mine").shape » ()
[choices.FAMILIES[name].plain for name in choices.FAMILIES]
» [None, ('flat_radius', 0.0), ('flat_radius', 0.0), ('waviness_amplitude', 0.0), ('exponent', 2.0), None,
    ('flat_half_width', 0.0), ('waviness_amplitude', 0.0), ('exponent', 2.0)]
""")


def test_waves_are_known_at_all_that_is_asked() -> None:
    """H₀(x) + x (2/π − H₁(x)) by SciPy, where that has a value."""
    x = np.concatenate([np.linspace(0.0, 60.0, 997), np.linspace(60.0, 3000.0, 997)])
    found, expected = families.wave(x), struve(0, x) + x * (2.0 / np.pi - struve(1, x))
    assert np.isfinite(found).all()
    there = np.isfinite(expected)
    np.testing.assert_allclose(found[there], expected[there], rtol=1e-8, atol=1e-7)


@pytest.mark.parametrize(("expression", "said"), CASES)
def test_words_are_these(expression: str, said: list[str]) -> None:
    assert lines_of(eval(expression)) == said
