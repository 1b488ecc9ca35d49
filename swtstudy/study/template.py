"""A template for studies: small, valid and commented."""

from __future__ import annotations

from swtstudy.study.design import DESIGNS
from swtstudy.study.schema import SCHEMA_LINE
from swtstudy.study.writing import quoted
from swtstudy.units.labels import Units
from swtstudy.units.rows import rows
from swtstudy.vocabulary.choices import FAMILIES, PLANE
from swtstudy.vocabulary.mistakes import ALLOWED_RTOL, DEFAULT_RTOL
from swtstudy.vocabulary.parameter import Parameter
from swtstudy.vocabulary.parameters import PARAMETERS, QUANTITY_AXES
from swtstudy.vocabulary.quantities import DISTANCE, NAMED

_USED = ("normal_amplitude", "phase")


def _head(title: str, results: str) -> str:
    """Return the head of every template."""
    return f"""\
{SCHEMA_LINE.strip()}
# Editors that know TOML schemas (Even Better TOML, Taplo) complete and explain this file.
#   swtstudy validate FILE    all mistakes at once
#   swtstudy plan FILE        how many points, how long
#   swtstudy run FILE         archive and figure, in the folder results
title = {quoted(title)}
rtol = {DEFAULT_RTOL:g}  # relative accuracy asked of s: {ALLOWED_RTOL}
# Computed beside {results}, as further results:
# quantities = [{", ".join(map(quoted, NAMED))}]"""


def template(title: str) -> str:
    """The text of a study with two axes, and every other parameter as a comment."""
    return f"""\
{_head(title, "s")}

# Parameters with one value. Those not given have the values of the paper's Table 1, shown in the comments.
# Numbers may also be texts: "8/9", "pi/2", "sqrt(20)".
[fixed]
{_fixed()}

# Parameters with several values, in the order of the dimensions: a list, or both ends and their number.
# Any parameter from above may be an axis instead.
[axes]
normal_amplitude = [0.25, 0.5, 0.75]
phase = {{ start = 0, stop = "2*pi", num = 49 }}  # spacing = "log" gives equal ratios

# Or points drawn from ranges, instead of axes or beside them: then x = "sample" below, with kind = "scatter".
# [sample]
# design = "sobol"  # or {" or ".join(quoted(name) for name in DESIGNS if name != "sobol")}
# size = 256
# seed = 1
# ranges = {{ friction = [0.1, 0.5], phase = [0, "2*pi"] }}  # or a table: distribution = "normal", …

# Every axis needs a place here. Without this table there is an archive, but no figure.
[figure]
x = "phase"
hue = "normal_amplitude"
# panels = "friction"          # one panel for each of its values
# y = "s/s(phase=0)"           # s over its value there, instead of "s"
"""


def template_with_units(title: str) -> str:
    """The text of a study of real contacts, with every parameter that is not used as a comment."""
    return f"""\
{_head(title, "SWT and cycles")}

[units]  # any consistent set
length = "mm"
force = "N"
stress = "MPa"

# Strain-life constants, for cycles: each a value, or two in brackets, one for each body; Young's modulus is
# that of the bodies unless it is given. Or file = "materials.toml", name = "2024-T351": a table in that file.
[material]  # aluminium 2024-T351; N. E. Dowling, Mechanical Behavior of Materials, 4th ed., Table 14.1
strength = 927
strength_exponent = -0.113
ductility = 0.409
ductility_exponent = -0.713
# yield_strength = …  # a stress: tells where the contact begins to yield
# findley_limit = …  # a stress, for the criterion findley; for fatemi_socie shear_strength = … and so on

# A load that was measured, by its file: then load = "mine" below, and neither normal_force nor amplitudes.
# [loads.mine]
# file = "rig.csv"
# columns = {{ normal = "Fn [kN]", tangential = "Ft [N]" }}
# scale = {{ normal = 1000 }}  # kN to N; or -1 where compression is negative
# absolute = true
# recorded_cycles = 20  # or period, or frequency, with time = "t [s]"

# Parameters with one value; numbers may also be texts: "1/3", "pi/2".
[fixed]
young_modulus = 73.1e3  # of both bodies; or of each, [73.1e3, 71e3]
poisson_ratio = 0.33
radius = 50             # 1/R = 1/R1 + 1/R2
normal_force = 200      # or depth
normal_amplitude = 2e-3 # of the depth; with 0 the phase would do nothing
friction = 0.5
{_with_units()}

# Parameters with several values, in the order of the dimensions: a list, or both ends and their number.
# Any parameter from above may be an axis instead.
[axes]
tangential_amplitude = [1e-3, 1.5e-3, 2e-3]
phase = {{ start = 0, stop = "pi", num = 13 }}  # spacing = "log" gives equal ratios

# Every axis needs a place here. Without this table there is an archive, but no figure.
[figure]
x = "phase"
hue = "tangential_amplitude"
y = ["SWT", "cycles"]
"""


#: What the template with units uses.
_USED_WITH_UNITS = (
    *("young_modulus", "poisson_ratio", "radius", "normal_force", "friction", "profile"),
    *("normal_amplitude", "tangential_amplitude", "phase"),
)


def _with_units() -> str:
    lines = [_profiles()]
    for name, row in rows(Units("mm", "N", "MPa")).items():
        if name not in _USED_WITH_UNITS:
            lines += [f"# {row.meaning}: {row.allowed}", f"# {name} = {_default(row)}"]
    return "\n".join(lines)


def _default(row: Parameter) -> str:
    """The default of a parameter as in a study."""
    default = row.default
    return "…" if default is None else quoted(default) if isinstance(default, str) else f"{default:.6g}"


def _profiles() -> str:
    lines = [f"profile = {quoted(str(PARAMETERS['profile'].default))}"]
    for family in FAMILIES.values():
        needs = f", needs {' and '.join(family.shape)}" if family.shape else ""
        plane = " (plane: forces alone)" if family.geometry == PLANE else ""
        lines.append(f"#   {quoted(family.name)}{plane}{needs}")
    return "\n".join(lines)


def _fixed() -> str:
    lines = [_profiles()]
    for name, parameter in (*PARAMETERS.items(), (DISTANCE, QUANTITY_AXES[DISTANCE])):
        if name == "profile" or name in _USED:
            continue
        note = f"; {parameter.note}" if parameter.note else ""
        lines.append(f"# {parameter.described}: {parameter.allowed}{note}")
        lines.append(f"# {name} = {_default(parameter)}")
    return "\n".join(lines)
