"""A study in newtons and millimetres, for the tests of such studies."""

from swtstudy import FatigueConstants

#: Units, and the constants of an aluminium alloy with them.
UNITS = """\
[units]
length = "mm"
force = "N"
stress = "MPa"
"""
CONSTANTS = """\
strength = 927
strength_exponent = -0.113
ductility = 0.409
ductility_exponent = -0.713
"""
ALLOY = f"{UNITS}[material]\n{CONSTANTS}"
#: A sphere on a flat.
SPHERE = """\
young_modulus = 73.1e3
poisson_ratio = 0.33
radius = 50
friction = 0.5
"""
#: A contact with the load of a rig, whose table is to follow.
RIG = f"""
title = "A rig"
{UNITS}[fixed]
{SPHERE}load = "rig"
"""
STUDY = f"""
title = "A sphere on a flat"
rtol = 1e-2
quantities = ["dissipation", "stick_radius", "contact_radius"]
{ALLOY}[fixed]
{SPHERE}normal_amplitude = 2e-3
critical_distance = 0.05
[axes]
normal_force = [150, 200]
tangential_amplitude = [1e-3, 2.5e-3]
phase = [0, "pi/2"]
[figure]
x = "phase"
hue = "tangential_amplitude"
panels = "normal_force"
y = ["SWT", "cycles", "SWT_volume", "critical_position"]
"""
#: A contact that lacks its loads, of a metal that yields.
CONTACT = f"""
title = "A contact"
rtol = 1e-3
{ALLOY}yield_strength = 350
[fixed]
{SPHERE}"""
#: It with two forces, by all criteria.
CRITERIA = f"""{CONTACT}normal_force = 200
tangential_force_amplitude = 60
normal_sensitivity = 0.3
[axes]
criterion = ["swt", "findley", "fatemi_socie"]
"""
ALUMINIUM = FatigueConstants(73.1e3, 927.0, -0.113, 0.409, -0.713)
#: Two bodies of which each has its own constants, alike in (1 − 2ν)/G as steel and brass nearly are.
BODIES = (
    STUDY.replace("73.1e3", "[210e3, 150e3]")
    .replace("0.33", "[0.3, 0.33]")
    .replace("ductility = 0.409", "ductility = [0.409, 0.2]")
)


def without(text, *lines):
    return "\n".join(line for line in text.splitlines() if not line.startswith(lines))


def plain(*lines):
    """The study without a figure, and without some lines."""
    return without(STUDY, "[figure]", "x =", "hue =", "panels =", "y =", *lines)
