"""Studies with a few changes that somebody could make by mistake or on purpose, by a seed."""

import random
import re
from collections.abc import Iterator

from real import ALLOY

_HEAD = 'title = "t"\nrtol = 1e-2\n'
#: A contact with units, without its load.
_RIG = f"""
{ALLOY}[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
"""
_STUDIES = """[fixed]
profile = "rounded_punch"
flat_radius = 0.5
[axes]
phase = {start = 0, stop = "pi", num = 3}
frequency_ratio = ["1/2", 1]
[figure]
x = "phase"
hue = "frequency_ratio"
y = ["s", "s/s(phase=0)"]
====
quantities = ["dissipation"]
[fixed]
profile = "wavy_paraboloid"
waviness_amplitude = 0.1
wavelength = 6
bulk_stress_amplitude = 0.1
bulk_stress_phase = 1
[axes]
friction = [0.1, 0.3]
critical_distance = [0.05, 0.1]
[figure]
x = "friction"
hue = "critical_distance"
y = "s_volume"
====
[sample]
design = "sobol"
size = 4
seed = 1
[sample.ranges]
phase = [0, "2*pi"]
friction = {distribution = "normal", mean = 0.3, deviation = 0.1, low = 0.1, high = 0.5}
[axes]
profile = ["paraboloid", "power_law"]
[fixed]
exponent = 3
walker_exponent = 0.6
[figure]
kind = "scatter"
x = "sample"
hue = "profile"
====
[loads.a]
vertices = [[0, -0.5, -0.1], [0.4, -0.5, -0.1], [0.4, 0.5, 0.1]]
[loads.b]
normal = [[1, 0.2, 0]]
tangential = [[1, 0.5, 0], [3, 0.1, 1]]
bulk = [[1, 0.1, 0]]
[fixed]
normal_force_amplitude = 1
tangential_force_amplitude = 1
bulk_stress_mean = 0.1
[axes]
load = ["a", "b"]
====
[profiles.worn]
radius = [0, 0.4, 0.8, 1.2, 1.6, 2, 2.4, 2.8, 3.2]
smoothing = 0
height = [0, 0.08, 0.32, 0.72, 1.28, 2, 2.88, 3.92, 5.12]
[fixed]
normal_amplitude = 0.2
[axes]
profile = ["worn", "paraboloid"]
phase = [0, 1]
====
{RIG}normal_force = 200
tangential_amplitude = 2e-3
bulk_stress_amplitude = 30
bulk_stress_ratio = -1
critical_distance = 0.05
[axes]
normal_amplitude = [0, 2e-3]
phase = [0, "pi/2"]
[figure]
x = "phase"
hue = "normal_amplitude"
panels = "body"
y = ["SWT", "cycles"]
====
{RIG}normal_force = 200
tangential_force_amplitude = 40
profile = "rounded_punch"
flat_radius = 0.2
phase = 1
====
{RIG}normal_force = 200
normal_force_amplitude = 1
tangential_force_amplitude = 1
load = "rig"
[loads.rig]
vertices = [[0, -60, 10], [20, -60, 30], [20, 60, 30], [0, 60, -10]]
[axes]
body = [1, 2]
====

{ALLOY}[fixed]
young_modulus = 73.1e3
poisson_ratio = 0.33
friction = 0.5
depth = 5e-3
tangential_amplitude = 2e-3
profile = "pad"
[profiles.pad]
radius = [0, 0.2, 0.4, 0.6, 0.8, 1, 1.2, 1.4, 1.6]
height = [0, 4e-4, 1.6e-3, 3.6e-3, 6.4e-3, 1e-2, 1.44e-2, 1.96e-2, 2.56e-2]
====
{RIG}normal_force = 2000
contact_length = 10
normal_force_amplitude = 100
bulk_stress_amplitude = 30
bulk_stress_ratio = 0.1
critical_distance = 0.05
[axes]
profile = ["cylinder", "paraboloid"]
tangential_force_amplitude = [300, 500]
[figure]
x = "tangential_force_amplitude"
hue = "profile"
panels = "body"
y = ["SWT", "cycles_volume"]
====
quantities = ["dissipation", "stick_radius"]
[profiles.pad]
geometry = "plane"
radius = [0, 0.4, 0.8, 1.2, 1.6, 2, 2.4, 2.8, 3.2]
height = [0, 0.08, 0.32, 0.72, 1.28, 2, 2.88, 3.92, 5.12]
[fixed]
normal_force_amplitude = 0.2
flat_half_width = 0.4
waviness_amplitude = 0.01
wavelength = 6
exponent = 3
[axes]
profile = ["pad", "rounded_flat", "wavy_cylinder", "power_law_cylinder"]
tangential_force_amplitude = {start = 0.1, stop = 0.5, num = 2, also = [0.3]}
"""
_VALUES = """
0 ; -1 ; 1 ; 2 ; 3.7 ; 1e-300 ; 1e300 ; -1e300 ; 5e-324 ; nan ; inf ; -inf ; true ; -0.0 ; 1e20 ; "" ;
"a\\u0000b" ; "$$" ; "pi/0" ; "1/3" ; "2*pi" ; "sqrt(-1)" ; 1979-05-27 ; [] ; {} ; [1] ; [[1]] ; [1, 1] ;
["1", 2.5] ; [0, 1, 2] ; [1e300, 2] ; [nan] ; {start = 0, stop = 1, num = 3} ;
{start = 0, stop = 1, num = 3, also = [0.2, "2/3"]} ; {start = 0, stop = 1, num = 3, also = [nan, 0.5]} ;
{start = "pi/0", stop = 1, num = 3} ; {start = 1, stop = 1, num = 2} ;
{start = 1, stop = 1e9, num = 3, spacing = 'log'} ; {start = 0, stop = 1, num = 1000001} ; 1e-9 ; 1e9 ;
0.5 ; "paraboloid" ; "rounded_punch" ; "truncated_paraboloid" ; "cylinder" ; "rounded_flat" ;
"wavy_cylinder" ; "plane" ; "harmonic" ; "a" ; "worn" ; "body" ; "sample" ; "s" ; "SWT" ; "cycles" ;
"s/s(flat_radius=0)" ; "s/s(phase=pi/0)" ; "s/s(load=a)" ; "lines" ; "contour" ; "life" ; "histogram" ;
"saltelli" ; "lognormal" ; "/dev/zero" ; "." ; [1, 2] ; [0.2, 0.3, 0.4] ; 64
"""
_KEYS = """
young_modulus poisson_ratio radius depth normal_force friction normal_amplitude phase
tangential_amplitude normal_force_amplitude tangential_force_amplitude frequency_ratio load profile
flat_radius waviness_amplitude wavelength exponent bulk_stress_amplitude body bulk_stress_mean
bulk_stress_ratio bulk_stress_phase walker_exponent critical_distance similar x hue panels y kind
vertical regimes file size seed frictoin rtol quantities flat_half_width contact_length geometry also
"""
#: What the changes begin with: each part of a study is in one of them.
_WHOLE = _STUDIES.replace("{RIG}", _RIG).replace("{ALLOY}", ALLOY)
STUDIES = [f"{_HEAD}{text}" for text in _WHOLE.split("====\n")]
#: What may stand where a value stood, and where a key stood.
VALUES = ("9" * 400, "0x" + "f" * 300, "[" * 60 + "]" * 60, *(each.strip() for each in _VALUES.split(";")))
KEYS = _KEYS.split()
_LINE = re.compile(r"^(?!title|rtol)(\w+) = (.+)$", re.MULTILINE)
_NUMBER = re.compile(r"(?<![\w.\"-])-?\d[\d.]*(?:e-?\d+)?(?![\w.\"])")


def mutated(seed: int, count: int) -> Iterator[str]:
    """So many texts of studies, each with one to four changes."""
    dice = random.Random(seed)
    for _ in range(count):
        text = dice.choice(STUDIES)
        for _ in range(dice.choice([1, 1, 1, 2, 3])):
            text = dice.choice(_CHANGES)(text, dice)
        yield text


def _another_value(text: str, dice: random.Random) -> str:
    return _at(_LINE, text, dice, lambda line: f"{line[1]} = {dice.choice(VALUES)}")


def _another_key(text: str, dice: random.Random) -> str:
    return _at(_LINE, text, dice, lambda line: f"{dice.choice(KEYS)} = {line[2]}")


def _another_number(text: str, dice: random.Random) -> str:
    scale = dice.choice(
        ["1e-200", "1e-9", "1e-3", "0.1", "0.7", "-1", "0", "1.3", "10", "1e3", "1e9", "1e200"]
    )
    return _at(_NUMBER, text, dice, lambda number: _scaled(number[0], scale))


def _scaled(number: str, scale: str) -> str:
    try:
        return repr(float(number) * float(scale))
    except ValueError:
        return number


def _without_a_line(text: str, dice: random.Random) -> str:
    return _at(_LINE, text, dice, lambda _: "")


def _one_more_line(text: str, dice: random.Random) -> str:
    more = f"{dice.choice(KEYS)} = {dice.choice(VALUES)}"
    return _at(_LINE, text, dice, lambda line: f"{line[0]}\n{more}")


def _a_letter(text: str, dice: random.Random) -> str:
    place = dice.randrange(len(text) + 1)
    return (
        text[:place]
        + dice.choice(["", "$", '"', "[", "]", "\n", ",", "1", "µ"])
        + text[place + dice.randint(0, 2) :]
    )


def _at(pattern: re.Pattern[str], text: str, dice: random.Random, change) -> str:  # type: ignore[no-untyped-def]
    """The text with one of the places where a pattern is changed."""
    found = list(pattern.finditer(text))
    if not found:
        return text
    place = dice.choice(found)
    return text[: place.start()] + change(place) + text[place.end() :]


_CHANGES = [_another_value] * 4 + [_another_number] * 6 + [_another_key, _without_a_line] * 2
_CHANGES += [_one_more_line] * 3 + [_a_letter]
