"""Templates for studies: small, valid and commented."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from string import Template

from swtstudy.study.keys import DESIGNS
from swtstudy.study.schema import SCHEMA_LINE
from swtstudy.study.units.rows import Units, rows
from swtstudy.study.writing import quoted
from swtstudy.vocabulary.choices import FAMILIES, PLANE
from swtstudy.vocabulary.files import read_text
from swtstudy.vocabulary.mistakes import ALLOWED_RTOL, DEFAULT_RTOL
from swtstudy.vocabulary.parameters import PARAMETERS, QUANTITY_AXES, short
from swtstudy.vocabulary.quantities import DISTANCE, NAMED


def template(title: str, with_units: bool = False) -> str:
    """The text of a study with two axes, of real contacts if it has units.

    The profiles, and the parameters that it does not use with their defaults, are comments.
    """
    name, known = "template.toml", PARAMETERS | {DISTANCE: QUANTITY_AXES[DISTANCE]}
    if with_units:
        # Symbols and notes belong to parameters without units.
        own = rows(Units("mm", "N", "MPa")).values()
        name, known = "template_with_units.toml", {row.name: replace(row, note="", symbol="") for row in own}
    text = read_text(Path(__file__).with_name(name))
    used = re.findall(r"^(\w+) =", text, re.MULTILINE)
    lines = [f"profile = {quoted(str(PARAMETERS['profile'].default))}"]
    for family in FAMILIES.values():
        needs = f", needs {' and '.join(family.shape)}" if family.shape else ""
        plane = " (plane: forces alone)" if family.geometry == PLANE else ""
        lines.append(f"#   {quoted(family.name)}{plane}{needs}")
    for row in (row for key, row in known.items() if key not in (*used, "profile")):
        note = f"; {row.note}" if row.note else ""
        value = "…" if row.default is None else quoted(str(row.default)) if row.names else short(row.default)
        lines += [f"# {row.described}: {row.allowed}{note}", f"# {row.name} = {value}"]
    return Template(text).substitute(
        schema=SCHEMA_LINE,
        title=quoted(title),
        rtol=f"{DEFAULT_RTOL:g}",
        allowed_rtol=ALLOWED_RTOL,
        quantities=", ".join(map(quoted, NAMED)),
        designs=" or ".join(quoted(design) for design in DESIGNS if design != "sobol"),
        parameters="\n".join(lines),
    )
