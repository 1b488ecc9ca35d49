"""Facts of the contacts of a study with units, besides the values of their parameters; blocks of loads."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.units.life import Block, wrong_rounds
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal
from swtstudy.vocabulary.quantities import EVERY_VARIABLE

if TYPE_CHECKING:
    from swtstudy.units.grid import ContactDetails
    from swtstudy.units.rows import Units
    from swtstudy.vocabulary.parameter import Parameter


def read_blocks(raw: Mapping[str, Any], loads: Mapping[str, Definition], report: Report) -> tuple[Block, ...]:
    """The blocks of a study, those of a signal that keeps its cycles one by one; see `Block`.

    Parameters
    ----------
    raw
        The study.
    loads
        The loops that it defines, by name.
    report
        Called with key, found and allowed of each mistake.
    """
    tables = raw.get("blocks")
    if not isinstance(tables, list) or not tables:
        return ()
    if not ("units" in raw and "material" in raw):
        report("blocks", "blocks without [units] and [material]", "with both: Miner's sum needs lives")
    for part in ("fixed", "axes"):
        if isinstance(raw.get(part), dict) and "load" in raw[part]:
            report(f"{part}.load", literal(raw[part]["load"]), "nothing: the loads are those of [[blocks]]")
    blocks: list[Block] = []
    for number, table in enumerate(tables):
        if not isinstance(table, dict) or not isinstance(table.get("load"), str):
            continue  # reported with the structure
        wrong = wrong_rounds(table.get("rounds"), f"blocks[{number}].rounds")
        for mistake in wrong:
            report(mistake.key, mistake.found, mistake.allowed)
        rounds = 1.0 if wrong else float(table["rounds"])
        blocks += [Block(name, rounds) for name in _cycles(table["load"], raw, loads)]
    return tuple(blocks)


def told_of_lives(raw: Mapping[str, Any], report: Report) -> None:
    """Report that blocks are of no use to a [material] that is sound, and has no lives."""
    if "material" in raw and not any(mistake.key.startswith("material") for mistake in report):
        report(
            "blocks", "blocks with a [material] without lives", "constants of lives: Miner's sum needs them"
        )


def _cycles(name: str, raw: Mapping[str, Any], loads: Mapping[str, Definition]) -> list[str]:
    """The names of the cycles of a load that keeps them, or its own."""
    table = raw.get("loads", {}).get(name) if isinstance(raw.get("loads"), dict) else None
    if not isinstance(table, dict) or table.get("keep_cycles") is not True:
        return [name]
    return kept_cycles(name, loads) or [name]


def kept_cycles(load: str, names: Iterable[str]) -> list[str]:
    """Which of the names are those of cycles that are kept of a load."""
    return [each for each in names if re.fullmatch(rf"{re.escape(load)} \d+", each)]


def read_given(
    raw: Mapping[str, Any], fixed: Mapping[str, object], folder: Path, report: Report
) -> tuple[ContactDetails | None, float | None]:
    """Units and materials, None for a study without units; and the critical distance of the materials."""
    if not isinstance(raw.get("units"), dict):
        if "material" in raw and "units" not in raw:
            report("material", "constants without [units]", "with [units] only: a life needs a real contact")
        return None, None
    from swtstudy.units.at_rest import Moduli
    from swtstudy.units.grid import ContactDetails
    from swtstudy.units.material import read_material, two_of, warn_of_units
    from swtstudy.units.rows import Units, read_units

    # Wrong units are reported: meanwhile others stand for them.
    units = read_units(raw["units"], report) or Units("the unit of length", "that of force", "that of stress")
    if not isinstance(raw.get("material"), dict):
        return ContactDetails(units), None
    young = fixed.get("young_modulus")
    sound = [_sound(each) for each in two_of(young)]
    # A wrong one is reported elsewhere: meanwhile any stands for it.
    known = None if young is None else (sound[0] or 1.0, sound[1] or 1.0)
    poisson = fixed.get("poisson_ratio")
    ratios = [_sound(each) for each in two_of(poisson)]
    shear = None if known is None or poisson is None else Moduli(known, (ratios[0], ratios[1])).shear
    given, distance = read_material(raw["material"], known, shear, units, folder, report)
    if all(sound):
        warn_of_units(given, (sound[0], sound[1]))
    return given, distance


def _sound(young: object) -> float:
    """A modulus, or Poisson ratio; 0 for one that is wrong."""
    from swtstudy.points.values import read_exact

    try:
        number = float(read_exact(young))
    except ValueError:
        return 0.0
    return max(number, 0.0)


def every_name() -> set[str]:
    """Names of all data variables that a study with units may have."""
    from swtstudy.units.variables import NAMES

    return {*NAMES, *EVERY_VARIABLE}


def rows_of(units: Units | None) -> Mapping[str, Parameter]:
    """The parameters that a study may have, with or without units."""
    from swtstudy.vocabulary.parameters import PARAMETERS

    if units is None:
        return PARAMETERS
    from swtstudy.units.rows import rows

    return rows(units)
