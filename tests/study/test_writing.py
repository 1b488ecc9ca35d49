"""A study as the text that archives keep of it: every table, value and sign of it."""

import pytest

from swtstudy import Study
from swtstudy.study.writing import to_toml

WITH_UNITS = r"""title = "All of \"it\" \u007f é"
rtol = 1e-3
quantities = ["dissipation", "von_mises"]
[units]
length = "mm"
force = "N"
stress = "MPa"
[material]
young_modulus = [73.1e3, 70e3]
strength = [927, 900]
strength_exponent = -0.113
ductility = 0.409
ductility_exponent = -0.713
shear_strength = 500
shear_strength_exponent = -0.1
shear_ductility = [0.5, 0.6]
shear_ductility_exponent = -0.6
shear_modulus = 28e3
yield_strength = 350
findley_limit = [200, 210]
[fixed]
young_modulus = [73.1e3, 73e3]
poisson_ratio = 0.33
friction = 0.5
bodies = ["pad", "specimen"]
similar = 0.2
profile = "worn"
critical_distance = 0.05
[sample]
points = {strength_1 = [900, 910.5], ductility_2 = [0.4, 0.41]}
target_life = 1e5
[loads.start-up]
absolute = true
vertices = [[150, -50], [180, 60], [150, 20]]
[loads."run 1"]
normal = [[0, 0, 0], [1, 5, 0]]
tangential = [[1, 20, "90 deg"]]
mean_normal = 200
[profiles.worn]
radius = [0, 1, 2, 3, 4, 5, 6, 7]
height = [0, 0.01, 0.04, 0.09, 0.16, 0.25, 0.36, 0.49]
[[blocks]]
load = "start-up"
rounds = 10
[[blocks]]
load = "run 1"
rounds = 2.5
[figure]
kind = "heatmap"
x = "load"
vertical = "body"
y = "cycles"
title = "a title"
validity = true
"""
WRITTEN_WITH_UNITS = r"""title = "All of \"it\" \u007f é"
rtol = 0.001
quantities = ["dissipation", "von_mises"]

[units]
length = "mm"
force = "N"
stress = "MPa"

[material]
young_modulus = [73100.0, 70000.0]
strength = [927.0, 900.0]
strength_exponent = [-0.113, -0.113]
ductility = [0.409, 0.409]
ductility_exponent = [-0.713, -0.713]
shear_modulus = [28000.0, 28000.0]
shear_strength = [500.0, 500.0]
shear_strength_exponent = [-0.1, -0.1]
shear_ductility = [0.5, 0.6]
shear_ductility_exponent = [-0.6, -0.6]
yield_strength = [350.0, 350.0]
findley_limit = [200.0, 210.0]

[fixed]
poisson_ratio = 0.33
friction = 0.5
normal_force_amplitude = 1.0
frequency_ratio = "1"
tangential_force_amplitude = 1.0
phase = 0.0
profile = "worn"
bulk_stress_amplitude = 0.0
bulk_stress_mean = 0.0
bulk_stress_phase = 0.0
stick_zone_shift = "moved"
criterion = "swt"
walker_exponent = 0.5
normal_sensitivity = 0.0
critical_distance = 0.05
young_modulus = [73100.0, 73000.0]
bodies = ["pad", "specimen"]
similar = 0.2

[axes]
body = [1.0, 2.0]

[sample]
target_life = 100000.0

[sample.points]
strength_1 = [900.0, 910.5]
ductility_2 = [0.4, 0.41]

[profiles."worn"]
radius = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]
height = [0.0, 0.01, 0.04, 0.09, 0.16, 0.25, 0.36, 0.49]
smoothing = 0.0

[loads."start-up"]
vertices = [[-10.0, -50.0], [20.0, 60.0], [-10.0, 20.0]]
mean_normal = 160.0

[loads."run 1"]
normal = [[0, 0.0, 0.0], [1, 5.0, 0.0]]
tangential = [[1, 20.0, 1.5707963267948966]]
mean_normal = 200.0

[[blocks]]
load = "start-up"
rounds = 10.0

[[blocks]]
load = "run 1"
rounds = 2.5

[figure]
x = "load"
y = ["cycles"]
title = "a title"
kind = "heatmap"
vertical = "body"
validity = true
"""
PLAIN = """title = "b"
[axes]
frequency_ratio = ["3/2", 1]
critical_distance = [0.1, 0.2]
load = ["harmonic", "a"]
[fixed]
normal_amplitude = 0.5
tangential_amplitude = 0.2
bulk_stress_amplitude = 0.1
[sample.points]
phase = [0, 1]
friction = [0.1, 0.2]
[loads.a]
vertices = [[0.0, 1.0, 0.5], [0.0, -1.0, 0]]
"""
WRITTEN_PLAIN = """title = "b"
rtol = 0.0001

[fixed]
poisson_ratio = 0.3
normal_amplitude = 0.5
tangential_amplitude = 0.2
profile = "paraboloid"
bulk_stress_amplitude = 0.1
bulk_stress_mean = 0.0
bulk_stress_phase = 0.0
bulk_strain_share = 1.0
stick_zone_shift = "moved"
criterion = "swt"
walker_exponent = 0.5
normal_sensitivity = 0.0

[axes]
frequency_ratio = ["3/2", "1"]
load = ["harmonic", "a"]
critical_distance = [0.1, 0.2]

[sample.points]
phase = [0.0, 1.0]
friction = [0.1, 0.2]

[loads."a"]
vertices = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.5]]
"""


def written(text: str) -> str:
    study = Study.from_text(text)
    return to_toml(study.title, study.rtol, study.grid, study.figure, study.asked)


@pytest.mark.parametrize(("text", "expected"), [(WITH_UNITS, WRITTEN_WITH_UNITS), (PLAIN, WRITTEN_PLAIN)])
def test_a_study_is_written_with_all_that_is_known_of_it(text: str, expected: str) -> None:
    assert written(text) == expected
    assert written(expected) == expected
    assert Study.from_text(expected).grid == Study.from_text(text).grid
