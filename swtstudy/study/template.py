"""A template for studies: small, valid and commented."""

from __future__ import annotations

from swtstudy.accuracy import ALLOWED_RTOL, DEFAULT_RTOL
from swtstudy.parameters import FAMILIES, PARAMETERS, QUANTITY_AXES
from swtstudy.quantities import DISTANCE, NAMED
from swtstudy.sampling.design import DESIGNS
from swtstudy.study.schema import SCHEMA_LINE
from swtstudy.study.writing import quoted

_USED = ("normal_amplitude", "phase")


def template(title: str) -> str:
    """The text of a study with two axes, and every other parameter as a comment."""
    return f"""\
{SCHEMA_LINE.strip()}
# Editors that know TOML schemas (Even Better TOML, Taplo) complete and explain this file.
#   swtstudy validate FILE    all mistakes at once
#   swtstudy plan FILE        how many points, how long
#   swtstudy run FILE         archive and figure, in the folder results
title = {quoted(title)}
rtol = {DEFAULT_RTOL:g}  # relative accuracy asked of s: {ALLOWED_RTOL}
# Computed beside s, as further results:
# quantities = [{", ".join(map(quoted, NAMED))}]

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


def _fixed() -> str:
    lines = [f"profile = {quoted(str(PARAMETERS['profile'].default))}"]
    for family in FAMILIES.values():
        needs = f", needs {' and '.join(family.shape)}" if family.shape else ""
        lines.append(f"#   {quoted(family.name)}{needs}")
    for name, parameter in (*PARAMETERS.items(), (DISTANCE, QUANTITY_AXES[DISTANCE])):
        if name == "profile" or name in _USED:
            continue
        lines.append(f"# {parameter.described}: {parameter.allowed}")
        default = parameter.default
        value = "…" if default is None else quoted(default) if isinstance(default, str) else f"{default:.6g}"
        lines.append(f"# {name} = {value}")
    return "\n".join(lines)
