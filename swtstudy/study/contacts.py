"""What a study with units says of its contacts, beside the values of their parameters."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.mistakes import Report

if TYPE_CHECKING:
    from swtstudy.parameters import Parameter
    from swtstudy.units.reading import Given


def read_given(
    raw: Mapping[str, Any], fixed: Mapping[str, object], folder: Path, report: Report
) -> Given | None:
    """Units and fatigue constants; None for a study without units, whose parameters have none."""
    if not isinstance(raw.get("units"), dict):
        if "material" in raw and "units" not in raw:
            report("material", "constants without [units]", "with [units] only: a life needs a real contact")
        return None
    from swtstudy.units.labels import Units, read_units
    from swtstudy.units.material import read_material
    from swtstudy.units.reading import Given

    # Wrong units are reported: meanwhile others stand for them.
    units = read_units(raw["units"], report) or Units("the unit of length", "that of force", "that of stress")
    if not isinstance(raw.get("material"), dict):
        return Given(units)
    young = fixed.get("young_modulus")
    pair = (young[0], young[1]) if isinstance(young, list) and len(young) == 2 else (young, young)
    return Given(
        units, read_material(raw["material"], None if young is None else pair, units, folder, report)
    )


def rows_of(contacts: Given | None) -> Mapping[str, Parameter]:
    """The parameters that a study may have."""
    from swtstudy.parameters import PARAMETERS

    if contacts is None:
        return PARAMETERS
    from swtstudy.units.rows import rows

    return rows(contacts.units)
