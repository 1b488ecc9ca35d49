"""The blocks of a study, as far as they can be read before its loads are."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swtstudy.units.blocks import Block, wrong_rounds
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.mistakes import Report, literal


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
        wrong = wrong_rounds(table.get("rounds"), f"blocks.{number}.rounds")
        for mistake in wrong:
            report(mistake.key, mistake.found, mistake.allowed)
        rounds = 1.0 if wrong else float(table["rounds"])
        blocks += [Block(name, rounds) for name in _cycles(table["load"], raw, loads)]
    return tuple(blocks)


def _cycles(name: str, raw: Mapping[str, Any], loads: Mapping[str, Definition]) -> list[str]:
    """The names of the cycles of a load that keeps them, or its own."""
    table = raw.get("loads", {}).get(name) if isinstance(raw.get("loads"), dict) else None
    if not isinstance(table, dict) or table.get("keep_cycles") is not True:
        return [name]
    own = [each for each in loads if each.startswith(f"{name} ") and each not in raw["loads"]]
    return own or [name]
