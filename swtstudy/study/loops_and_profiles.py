"""The loops of loads, the profiles as tables and the blocks that a study defines, in its text or in files."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.loads.load_path import LoadPath
from swtstudy.points.reading import warn_of_degrees
from swtstudy.points.values import read_angle
from swtstudy.profiles.table import TabulatedProfile
from swtstudy.study.columns import read_columns
from swtstudy.study.keys import FileTable, LoadTable, Parts, ProfileTable, SignalTable, sound_keys, under
from swtstudy.study.signal import BULK, COLUMNS, KINDS, Signal, signal_from
from swtstudy.study.trace import trace_from
from swtstudy.units.life import Block, wrong_rounds
from swtstudy.units.reading import ANY, ANY_MEASURED
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.files import parse_toml
from swtstudy.vocabulary.mistakes import Report, literal, refused

#: Keys beside the definition of a loop.
_BESIDE = {
    "vertices": ("absolute", "mean_normal"),
    "normal": ("mean_normal",),
    "file": (*SignalTable.model_fields, "keep_cycles"),
}
#: Columns of the file of a profile.
PROFILE_COLUMNS = ("radius", "height")
#: Stands for a wrong profile.
_ANY_PROFILE = TabulatedProfile("any", np.linspace(0.0, 1e3, 9), np.linspace(0.0, 1e3, 9) ** 2)


def read_definitions(
    raw: Mapping[str, Any], parts: Parts, folder: Path, report: Report
) -> dict[str, dict[str, Definition]]:
    """The loops and profiles of a study, by parameter and name; mistakes are reported.

    A wrong definition stands for any: its use is no mistake of its own.

    Parameters
    ----------
    raw, parts
        The tables of the study, and the sound ones.
    folder
        That of the study, to which the paths of files are relative.
    report
        Told what is wrong with them.
    """
    loads: dict[str, Definition] = {}
    for name, load in parts.loads.items():
        given = raw["loads"][name]
        measured = isinstance(given, dict) and {"absolute", "mean_normal"} & {*given}
        loads[name] = ANY_MEASURED if measured else ANY
        if load is not None:
            part = next((each for each in ("vertices", "file") if getattr(load, each) is not None), "")
            with under(report, f"loads.{name}", part):
                loads |= _read_load(name, load, folder, parts, report)
    profiles: dict[str, Definition] = dict.fromkeys(parts.profiles, _ANY_PROFILE)
    for name, profile in parts.profiles.items():
        if profile is not None:
            with under(report, f"profiles.{name}"):
                profiles[name] = _read_profile(name, profile, folder, parts)
    return {"load": loads, "profile": profiles}


def _read_load(
    name: str, table: LoadTable, folder: Path, parts: Parts, report: Report
) -> dict[str, Definition]:
    """The loop of a table, and the loops of cycles that are kept; a StudyError with what is wrong."""
    own = _given(table)
    kinds = [each for each in ("vertices", "file", *COLUMNS, BULK) if each in own]
    if kinds not in (["vertices"], ["file"], [*COLUMNS], [*COLUMNS, BULK]):
        allowed = "vertices, file, or normal and tangential, with or without bulk"
        raise refused("", " and ".join(kinds) or "nothing", allowed)
    if strange := [each for each in own if each not in (*kinds, *_BESIDE[kinds[0]])]:
        of = {"vertices": "vertices", "normal": "harmonics", "file": "a file"}[kinds[0]]
        raise refused(
            "", f"{', '.join(strange)} beside {of}", f"with {of} only {', '.join(_BESIDE[kinds[0]])}"
        )
    if table.file is None:
        return {name: _loop(name, table, kinds[0])}
    if table.keep_cycles and table.harmonics is not None:
        allowed = "one of the two: kept cycles are as they were recorded"
        raise refused("", "keep_cycles and harmonics", allowed)
    signal = signal_from(folder / table.file, name, table, parts.units, _kinds(parts))
    kept = {each.name: each for each in signal.loops} if table.keep_cycles else {}
    for each in (each for each in kept if each in parts.loads):
        report(f"loads.{each}", f"the name of a cycle of loads.{name}", "another name")
    return {name: signal.loop, **kept}


def _kinds(parts: Parts) -> dict[str, str]:
    """The kinds of the columns of a record: a depth and a displacement beside amplitudes of these."""
    sampled = (*parts.sample.ranges, *parts.sample.points) if parts.sample else ()
    given = {*parts.fixed, *parts.axes, *sampled}
    depth = "normal_amplitude" in given
    moved = "tangential_amplitude" in given or (depth and "tangential_force_amplitude" not in given)
    return {**KINDS, **({"normal": "length"} if depth else {}), **({"tangential": "length"} if moved else {})}


def _given(table: FileTable) -> list[str]:
    """The keys of a table that have a value."""
    return [name for name in type(table).model_fields if name in table.model_fields_set]


def _loop(name: str, table: LoadTable, kind: str) -> Definition:
    """A loop of vertices or of harmonics."""
    if kind == "normal":
        rows = [_harmonics(getattr(table, each) or (), each) for each in (*COLUMNS, BULK)]
        return LoadPath.harmonic_sum(name, *rows, mean_normal=table.mean_normal)
    if not table.absolute:
        return LoadPath(name, table.vertices, table.mean_normal)
    if table.mean_normal is not None:
        allowed = "true or false; without mean_normal"
        raise refused("absolute", "absolute and mean_normal", allowed)
    return LoadPath.absolute(name, table.vertices)


def _harmonics(rows: Any, column: str) -> Any:
    """Rows of order, amplitude and phase, which may be a text as in studies."""
    read = list(rows) if isinstance(rows, list | tuple) else rows
    for number, row in enumerate(read if isinstance(read, list) else ()):
        if isinstance(row, list | tuple) and len(row) == 3:
            warn_of_degrees(column, row[-1])
            if isinstance(row[-1], str):
                try:
                    read[number] = (*row[:-1], float(read_angle(row[-1])))
                except ValueError as error:
                    key, found = f"{column}[{number}]", f"{literal(row[-1])} ({error})"
                    raise refused(key, found, "a phase") from None
    return read


def read_signal_of(text: str, name: str, folder: Path) -> Signal | None:
    """The signal that a load of a sound study is; None for one that comes from no file."""
    table = sound_keys(LoadTable, parse_toml(text).get("loads", {}).get(name, {}))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # told when the study was read
        return signal_from(folder / table.file, name, table) if table.file else None


def _read_profile(name: str, table: ProfileTable, folder: Path, parts: Parts) -> TabulatedProfile:
    """The profile of a table; a StudyError with what is wrong."""
    own = _given(table)
    kinds = [each for each in (*PROFILE_COLUMNS, "file") if each in own]
    if kinds not in (["file"], [*PROFILE_COLUMNS]):
        raise refused("", " and ".join(kinds) or "nothing", "radius and height, or file")
    beside: tuple[str, ...] = ("level",)
    words = "with two_sided"
    if kinds != ["file"]:
        beside, words = (*FileTable.model_fields, "two_sided", "level"), "with a file"
    strange = [each for each in beside if each in own]
    if strange and not (table.file and table.two_sided):
        raise refused("", ", ".join(strange), f"{strange[0]} {words} only")
    return profile_from(name, table, folder, parts.units)


def profile_from(
    name: str, table: ProfileTable, folder: Path, labels: Mapping[str, Any] | None = None
) -> TabulatedProfile:
    """A profile from its table."""
    if table.file is None:
        radius, height = table.radius, table.height
    elif table.two_sided:
        return trace_from(folder / table.file, name, table, labels)
    else:
        kinds = dict.fromkeys(PROFILE_COLUMNS, "length")
        radius, height = read_columns(folder / table.file, PROFILE_COLUMNS, (), table, kinds, labels)[0].T
    return TabulatedProfile(name, radius, height, table.smoothing or 0.0, table.geometry)


def read_blocks(raw: Mapping[str, Any], parts: Parts, names: Iterable[str], report: Report) -> list[Block]:
    """The blocks of a study, or of a signal that keeps its cycles one by one; mistakes are reported.

    Parameters
    ----------
    raw, parts
        The tables of the study, and the sound ones.
    names
        Those of its loops.
    report
        Called with key, found and allowed of each mistake.
    """
    if parts.blocks and not ("units" in raw and "material" in raw):
        report("blocks", "blocks without [units] and [material]", "with both: Miner's sum needs lives")
    given: dict[str, Mapping[str, Any]] = {"fixed": parts.fixed, "axes": parts.axes}
    for part, values in given.items():
        if parts.blocks and "load" in values:
            found = literal(raw[part]["load"])
            report(f"{part}.load", found, "nothing: the loads are those of [[blocks]]")
    blocks: list[Block] = []
    for number, block in enumerate(parts.blocks):
        wrong = wrong_rounds(block.rounds, f"blocks[{number}].rounds")
        for mistake in wrong:
            report(mistake.key, mistake.found, mistake.allowed)
        table = parts.loads.get(block.load)
        cycles = kept_cycles(block.load, names) if table and table.keep_cycles else []
        blocks += [Block(each, 1.0 if wrong else float(block.rounds)) for each in cycles or [block.load]]
    return blocks


def kept_cycles(load: str, names: Iterable[str]) -> list[str]:
    """The names that stand for kept cycles of a load."""
    return [each for each in names if re.fullmatch(rf"{re.escape(load)} \d+", each)]
