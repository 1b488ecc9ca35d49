"""The loops of loads, and the profiles as tables, that a study defines in its text or in files beside it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.loads.load_path import LoadPath
from swtstudy.points.reading import warn_of_degrees
from swtstudy.points.values import read_angle
from swtstudy.profiles.table import TabulatedProfile
from swtstudy.study.columns import FileTable, read_columns
from swtstudy.study.keys import place_of, read_keys
from swtstudy.study.signal import BULK, COLUMNS, Signal, SignalTable, signal_from
from swtstudy.study.tables import LoadTable, ProfileTable
from swtstudy.study.trace import trace_from
from swtstudy.units.reading import ANY, ANY_MEASURED
from swtstudy.vocabulary.choices import AXISYMMETRIC
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.files import parse_toml
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal

#: Numbers of a harmonic: order, amplitude, phase.
_OF_HARMONIC = 3
#: What may be said of a signal in a file.
KEYS = (*SignalTable.model_fields,)
#: What may be said of vertices and of harmonics besides.
_BESIDE = {
    "vertices": ("absolute", "mean_normal"),
    "normal": ("mean_normal",),
    "file": (*KEYS, "keep_cycles"),
}


def read_loops(
    tables: Mapping[str, Any], folder: Path, report: Report, labels: Mapping[str, Any]
) -> dict[str, Definition]:
    """The loops of a study, by name, as far as they are sound.

    Parameters
    ----------
    tables
        What the study has under ``loads``, as far as its structure is sound.
    folder
        That of the study, to which the paths of files are relative.
    report
        Told what is wrong with them.
    labels
        Those of the study's units by kind, as far as they are given.
    """
    found: dict[str, Definition] = {}
    for name, table in tables.items():
        key = f"loads.{name}"
        # A wrong loop stands for any: that it is used is no mistake of its own.
        found[name] = ANY_MEASURED if {"absolute", "mean_normal"} & {*table} else ANY
        form, _ = read_keys(LoadTable, table)
        if form is None:
            continue  # reported with the structure
        kind = _kind(table)
        if isinstance(kind, Mistake):
            report(key, kind.found, kind.allowed)
            continue
        try:
            if kind == "file":
                if table.get("keep_cycles") is True and table.get("harmonics") is not None:
                    allowed = "one of the two: kept cycles are as they were recorded"
                    report(key, "keep_cycles and harmonics", allowed)
                    continue
                signal = signal_from(folder / table["file"], name, form, labels)
                found[name] = signal.loop
                for each in signal.loops if table.get("keep_cycles") is True else ():
                    if each.name in tables:
                        report(f"loads.{each.name}", f"the name of a cycle of loads.{name}", "another name")
                    found[each.name] = each
            else:
                found[name] = _loop(name, table, kind)
        except StudyError as error:
            for mistake in error.mistakes:
                report(*_placed(mistake, key, kind))
    return found


def read_signal_of(text: str, name: str, folder: Path) -> Signal | None:
    """The signal that a load of a sound study is; None for one that comes from no file."""
    table = parse_toml(text).get("loads", {}).get(name, {})
    form, _ = read_keys(LoadTable, table)
    return signal_from(folder / table["file"], name, form) if form is not None and form.file else None


def _kind(table: Mapping[str, Any]) -> str | Mistake:
    """Key that defines a loop: its vertices, a file, or harmonics of which "normal" is the first."""
    given = [each for each in ("vertices", "file", *COLUMNS, BULK) if table.get(each) is not None]
    if given not in (["vertices"], ["file"], [*COLUMNS], [*COLUMNS, BULK]):
        allowed = "vertices, file, or normal and tangential, with or without bulk"
        return Mistake("", " and ".join(given) or "nothing", allowed)
    kind = given[0]
    known = (*_BESIDE["file"], "mean_normal")  # others are reported elsewhere
    strange = [key for key in known if table.get(key) is not None and key not in (*given, *_BESIDE[kind])]
    if strange:
        of = {"vertices": "vertices", "normal": "harmonics", "file": "a file"}[kind]
        return Mistake("", f"{', '.join(strange)} beside {of}", f"with {of} only {', '.join(_BESIDE[kind])}")
    return kind


def _placed(mistake: Mistake, key: str, kind: str) -> tuple[str, str, str]:
    """A mistake in a loop, at its key in the study."""
    first = mistake.key.partition(",")[0].partition(".")[0]
    if kind == "file" and first in KEYS and not mistake.source:
        return f"{key}.{mistake.key}", mistake.found, mistake.allowed
    where = key if kind == "normal" else f"{key}.{kind}"
    return where, f"{mistake.found}{place_of(mistake)}", mistake.allowed


def _loop(name: str, table: Mapping[str, Any], kind: str) -> Definition:
    mean, absolute = table.get("mean_normal"), table.get("absolute")
    if kind == "normal":
        rows = [_harmonics(table.get(each) or (), each) for each in (*COLUMNS, BULK)]
        return LoadPath.harmonic_sum(name, *rows, mean_normal=mean)
    if absolute not in (None, False, True) or (absolute and mean is not None):
        found = literal(absolute) if mean is None else "absolute and mean_normal"
        raise StudyError([Mistake("absolute", found, "true or false; without mean_normal")])
    if absolute:
        return LoadPath.absolute(name, table["vertices"])
    return LoadPath(name, table["vertices"], mean)


def _harmonics(rows: Any, column: str) -> Any:
    """Rows of order, amplitude and phase, which may be a text as in studies."""
    read = list(rows) if isinstance(rows, list | tuple) else rows
    for number, row in enumerate(read if isinstance(read, list) else ()):
        if isinstance(row, list | tuple) and len(row) == _OF_HARMONIC:
            warn_of_degrees(column, row[-1])
            if isinstance(row[-1], str):
                try:
                    read[number] = (*row[:-1], float(read_angle(row[-1])))
                except ValueError as error:
                    key, found = f"{column}[{number}]", f"{literal(row[-1])} ({error})"
                    raise StudyError([Mistake(key, found, "a phase")]) from None
    return read


#: Columns of the file of a profile.
PROFILE_COLUMNS = ("radius", "height")
#: What is said of a file, and of a trace.
OF_FILES = (*FileTable.model_fields, "two_sided", "level")

_RADII = np.linspace(0.0, 1e3, 9)
_ANY_PROFILE = TabulatedProfile("any", _RADII, _RADII**2)


def profile_from(
    name: str, table: Mapping[str, Any], folder: Path, labels: Mapping[str, Any] | None = None
) -> TabulatedProfile:
    """A profile from its table, whose keys are sound."""
    form, _ = read_keys(ProfileTable, table)
    if form is None or form.file is None:
        smoothing = table.get("smoothing") or 0.0
        return TabulatedProfile(
            name, table["radius"], table["height"], smoothing, table.get("geometry", AXISYMMETRIC)
        )
    if form.two_sided:
        return trace_from(folder / form.file, name, form, labels)
    kinds = dict.fromkeys(PROFILE_COLUMNS, "length")
    radius, height = read_columns(folder / form.file, PROFILE_COLUMNS, (), form, kinds, labels).T
    return TabulatedProfile(name, radius, height, form.smoothing or 0.0, form.geometry)


def read_profiles(
    tables: Mapping[str, Any], folder: Path, report: Report, labels: Mapping[str, Any]
) -> dict[str, Definition]:
    """The profiles of a study, by name; as `read_loops` for loads."""
    # A wrong profile stands for any: that it is used is no mistake of its own.
    found: dict[str, Definition] = {name: _ANY_PROFILE for name in tables}
    for name, table in tables.items():
        key = f"profiles.{name}"
        given = [each for each in (*PROFILE_COLUMNS, "file") if table.get(each) is not None]
        if read_keys(ProfileTable, table)[1]:
            continue  # reported with the structure
        if given not in (["file"], [*PROFILE_COLUMNS]):
            words = " and ".join(given) or "nothing"
            report(key, words, "radius and height, or file")
            continue
        beside = {"level": "with two_sided"} if given == ["file"] else dict.fromkeys(OF_FILES, "with a file")
        strange = [each for each in beside if table.get(each) is not None]
        if strange and not (given == ["file"] and table.get("two_sided") is True):
            report(key, ", ".join(strange), f"{strange[0]} {beside[strange[0]]} only")
            continue
        try:
            found[name] = profile_from(name, table, folder, labels)
        except StudyError as error:
            for each in error.mistakes:
                report(key, f"{each.found}{place_of(each)}", each.allowed)
    return found
