"""From the tables of a study file to its points: loops, profiles, blocks, contacts, samples and axes."""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import Known, read_distances, read_grid
from swtstudy.points.values import read_angle
from swtstudy.solver.load_path import LoadPath
from swtstudy.solver.table import TabulatedProfile
from swtstudy.study.columns import read_columns
from swtstudy.study.figure import check_figure
from swtstudy.study.keys import (
    LoadTable,
    ProfileTable,
    RangeTable,
    SignalTable,
    Table,
    TraceTable,
    read_study,
    under,
)
from swtstudy.study.record import signal_from
from swtstudy.study.sample import ReadSample, SampleReader
from swtstudy.study.signal import BULK, COLUMNS, KINDS, Signal
from swtstudy.study.trace import trace_from
from swtstudy.study.units.grid import ContactDetails, PhysicalGrid, implied_amplitudes, labels_of
from swtstudy.study.units.life import Block
from swtstudy.study.units.material import PROPERTIES, read_given
from swtstudy.study.units.reading import ANY, ANY_MEASURED, check_distances, read_contacts
from swtstudy.study.units.rows import OF_BODIES, Units, read_units, rows
from swtstudy.study.writing import to_toml
from swtstudy.vocabulary.choices import AXISYMMETRIC, GEOMETRIES
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.derived import NAMES
from swtstudy.vocabulary.files import parse_toml
from swtstudy.vocabulary.mistakes import Report, StudyError, literal, meant, refused
from swtstudy.vocabulary.parameters import AXES, PARAMETERS, Parameter
from swtstudy.vocabulary.quantities import DISTANCE, EVERY_VARIABLE, Request, read_quantities

#: Columns of the file of a profile.
PROFILE_COLUMNS = ("radius", "height")
#: The keys that define a loop or a profile in each of its forms, and the keys that may stand beside them.
_LOADS = {
    ("vertices",): ("absolute", "mean_normal"),
    COLUMNS: (BULK, "mean_normal"),
    ("file",): (*SignalTable.model_fields, "keep_cycles"),
}
_PROFILES = {PROFILE_COLUMNS: ("smoothing", "geometry"), ("file",): (*TraceTable.model_fields, "two_sided")}
#: Stands for a wrong profile of a kind: its use is no mistake of its own.
_ANY_RADII = np.linspace(0.0, 1e3, 9)
_ANY_PROFILE = {
    each: TabulatedProfile("any", _ANY_RADII, _ANY_RADII**2, geometry=each) for each in GEOMETRIES
}


class StudyReader:
    """Reads the tables of a study, one part after another; every mistake goes into its report."""

    def __init__(self, raw: Mapping[str, Any], source: str, folder: Path) -> None:
        self.raw, self.folder, self.source = raw, folder, source
        #: The tables that parameters are given in, for their keys in messages.
        self.places: dict[str, str] = {}
        #: The names of the cycles of loads that keep them.
        self.cycles: dict[str, list[str]] = {}
        self.report = Report(source, lambda name: f"{self.places.get(name, 'fixed')}.{name}")
        self.parts, self.of_structure = read_study(raw, source)
        self.report += self.of_structure

    @cached_property
    def units(self) -> Units | None:
        """The units, None without any; their mistakes are reported once they are asked for."""
        return None if self.parts.units is None else read_units(self.parts.units, self.report)

    @cached_property
    def given(self) -> set[str]:
        """Names of the parameters that are fixed, axes or sampled."""
        sample = self.parts.sample
        sampled = (*sample.ranges, *sample.points) if sample else ()
        return {*self.parts.fixed, *self.parts.axes, *sampled}

    @cached_property
    def labels(self) -> Units | None:
        """The labels of units in files: of forces per length, if plane contacts have no length."""
        values = {**self.parts.fixed, **self.parts.axes}.get("profile")
        names = [each for each in (values if isinstance(values, list) else [values]) if isinstance(each, str)]
        tables = self.parts.profiles
        kinds = [str(getattr(tables.get(name), "geometry", "")) for name in names]
        profiles = [_ANY_PROFILE.get(kind, name) for name, kind in zip(names, kinds, strict=True)]
        return labels_of(self.units, profiles, self.given) if self.units else None

    def fields(self, text: str) -> dict[str, Any]:
        """The fields of a `Study` whose file has a text; a StudyError with every mistake."""
        parts, report = self.parts, self.report
        known = {"load": self._loads(), "profile": self._profiles()}
        blocks = self._blocks()
        fixed, axes = self.fixed_and_axes(block.load for block in blocks)
        contacts, fixed = self._contacts(fixed, axes)
        own = rows(contacts.units) if contacts else PARAMETERS
        samples, design, scatter = self._sample(own, known, contacts)
        is_sampled = "sample" in self.raw and (bool(samples) or scatter is None)
        self.places = {DISTANCE: "material"} if DISTANCE not in parts.fixed else {}
        self.places |= dict.fromkeys(axes, "axes") | dict.fromkeys(samples, "sample")
        self.places |= {"load": "blocks"} if blocks else {}
        distances = read_distances(fixed, axes, report, {**AXES, **own}[DISTANCE])
        asked = Request(read_quantities(parts.quantities, "quantities", report), *distances)
        if contacts is not None:
            contacts = replace(contacts, blocks=tuple(blocks), scatter=scatter)
            asked = contacts.request(asked.names, *distances)
            wrong_material = any(mistake.key.startswith("material") for mistake in report)
            if blocks and not contacts.has_lives and "material" in self.raw and not wrong_material:
                allowed = "constants of lives: Miner's sum needs them"
                report("blocks", "blocks with a [material] without lives", allowed)
        grid: Grid | None = None
        if not is_sampled or samples:  # else what is sampled is unknown: nothing else is missing
            given = report.key, self.source
            if contacts is None:
                grid, wrong = read_grid(fixed, axes, *given, (DISTANCE,), samples, known)
            else:
                grid, wrong = read_contacts(fixed, axes, contacts, *given, samples, known)
            report += wrong
            if isinstance(grid, PhysicalGrid):
                check_distances(grid, asked.distances, report)
        if parts.figure is not None:
            # A misspelt axis counts as the one that was meant: it must not cause mistakes in the figure, too.
            dims = [name if name in AXES else meant(name, AXES) or name for name in axes]
            dims += [dim for dim in (grid.dims if grid else ()) if dim not in (*dims, SAMPLE)]
            unsure = {*NAMES, *EVERY_VARIABLE} if contacts and report else set()
            check_figure(parts.figure, [SAMPLE] * is_sampled + dims, grid, asked, report, unsure)
        if report or grid is None:
            told = {mistake.key for mistake in self.of_structure}  # once
            raise StudyError(dict.fromkeys(m for m in report if m in self.of_structure or m.key not in told))
        tables = [parts.sample, *parts.loads.values(), *parts.profiles.values()]
        if "file" in (parts.material or ()) or any(table.file for table in tables if table):
            # An archive and what a killed run leaves are read in other folders, when files may be gone.
            text = to_toml(parts.title, parts.rtol, grid, parts.figure, asked)
        kept = {"title": parts.title, "rtol": parts.rtol, "figure": parts.figure}
        return {**kept, "grid": grid, "asked": asked, "text": text, "design": design}

    def _loads(self) -> dict[str, Definition]:
        """The loops by name; a wrong one stands for any, so that its use is no mistake of its own."""
        loads: dict[str, Definition] = {}
        for name, table in self.parts.loads.items():
            given = self.raw["loads"][name]
            measured = isinstance(given, dict) and {"absolute", "mean_normal"} & {*given}
            # Without units a measured load is a mistake of its own.
            loads[name] = ANY_MEASURED if measured and self.units else ANY
            if table is not None:
                part = "vertices" if table.vertices is not None else "file" if table.file is not None else ""
                with under(self.report, f"loads.{name}", part):
                    loads |= self._load(name, table)
        return loads

    def _load(self, name: str, table: LoadTable) -> dict[str, Definition]:
        """The loop of a table, and the loops of cycles that are kept; a StudyError with what is wrong."""
        form = _form_of(table, _LOADS)
        if form == COLUMNS:
            columns = [_harmonics(getattr(table, each) or (), each) for each in (*COLUMNS, BULK)]
            return {name: LoadPath.harmonic_sum(name, *columns, mean_normal=table.mean_normal)}
        if form == ("vertices",):
            if not table.absolute:
                return {name: LoadPath(name, table.vertices, table.mean_normal)}
            if table.mean_normal is not None:
                raise refused("absolute", "absolute and mean_normal", "true or false; without mean_normal")
            return {name: LoadPath.absolute(name, table.vertices)}
        if table.keep_cycles and table.harmonics is not None:
            allowed = "one of the two: kept cycles are as they were recorded"
            raise refused("", "keep_cycles and harmonics", allowed)
        # A depth and a displacement are recorded beside amplitudes of these.
        parts, given = self.parts, self.given | {*implied_amplitudes(self.given, (ANY_MEASURED,), ())}
        kinds = KINDS | {column: "length" for column in COLUMNS if f"{column}_amplitude" in given}
        kept = table.keep_cycles and bool(parts.blocks)
        if table.keep_cycles and not kept:
            warnings.warn(f"{name}: without [[blocks]] the mean of its cycles is the load", stacklevel=4)
        signal = signal_from(self.folder / str(table.file), name, table, self.labels, kinds, kept)
        if not table.keep_cycles:
            return {name: signal.loop}
        if kept and "bulk_stress_ratio" in given:
            words = "bulk_stress_ratio gives each cycle a mean bulk stress by its own range"
            warnings.warn(f"{name}: {words}; bulk_stress_mean is the same for all", stacklevel=4)
        single = {each.name: each for each in signal.loops}
        self.cycles[name] = [*single]
        for each in (each for each in single if each in parts.loads):
            self.report(f"loads.{each}", f"the name of a cycle of loads.{name}", "another name")
        return {name: signal.loop, **single}

    def _profiles(self) -> dict[str, Definition]:
        """The profiles that are tables, by name; a wrong one stands for any."""
        kinds = {name: getattr(table, "geometry", None) for name, table in self.parts.profiles.items()}
        profiles: dict[str, Definition] = {
            name: _ANY_PROFILE[kind if kind in GEOMETRIES else AXISYMMETRIC] for name, kind in kinds.items()
        }
        for name, table in ((name, table) for name, table in self.parts.profiles.items() if table):
            with under(self.report, f"profiles.{name}"):
                _form_of(table, _PROFILES)
                if "level" in table.model_fields_set and not table.two_sided:
                    raise refused("", "level", "level with two_sided only")
                profiles[name] = profile_from(name, table, self.folder, self.units)
        return profiles

    def _blocks(self) -> list[Block]:
        """The blocks; of a signal that keeps its cycles one for each."""
        raw, parts, report = self.raw, self.parts, self.report
        if parts.blocks and not ("units" in raw and "material" in raw):
            report("blocks", "blocks without [units] and [material]", "with both: Miner's sum needs lives")
        for part in ("fixed", "axes"):
            if parts.blocks and "load" in getattr(parts, part):
                report(f"{part}.load", literal(raw[part]["load"]), "nothing: [[blocks]] give the loads")
        blocks: list[Block] = []
        for block in parts.blocks:
            blocks += [replace(block, load=each) for each in self.cycles.get(block.load, [block.load])]
        return blocks

    def _contacts(
        self, fixed: dict[str, Any], axes: Mapping[str, Any]
    ) -> tuple[ContactDetails | None, dict[str, Any]]:
        """Units and materials, None without units; the fixed values with the materials' critical distance."""
        parts, report = self.parts, self.report
        if self.units is None:
            if "material" in self.raw and "units" not in self.raw:
                allowed = "with [units] only: a life needs a real contact"
                report("material", "constants without [units]", allowed)
            return None, fixed
        properties = [name for name in fixed if name in PROPERTIES and name not in AXES]
        for name in properties:
            report(f"fixed.{name}", "a property of a material", "this under [material]")
        fixed = {name: value for name, value in fixed.items() if name not in properties}
        # A modulus that is missing altogether is reported with the contacts: once.
        missing = [] if parts.sample else [name for name in OF_BODIES if name not in {*fixed, *axes}]
        told = {**dict.fromkeys(missing, 0.0), **fixed}
        contacts, distance = read_given(self.units, parts.material, told, self.folder, report)
        if distance is None:
            return contacts, fixed
        if DISTANCE in {*fixed, *axes}:
            report("material", f"a threshold and a fatigue limit beside a {DISTANCE}", "one of the two")
        return contacts, {**fixed, DISTANCE: distance} if DISTANCE not in axes else fixed

    def _sample(
        self, own: Mapping[str, Parameter], known: Known, contacts: ContactDetails | None = None
    ) -> ReadSample:
        """See `SampleReader.read`; nothing without a sample."""
        if self.parts.sample is None:
            return {}, None, None
        table, given = self.parts.sample, self.raw["sample"]
        single = {name: row for name, row in own.items() if name not in (DISTANCE, "body")}
        units = self.labels or Units()
        return SampleReader(table, given, self.folder, self.report, known, single, units, contacts).read()

    def firsts(self, axes: Mapping[str, Any]) -> dict[str, object]:
        """First values along axes, and of what is sampled; None where there is a mistake."""
        found = {n: v.start if isinstance(v, RangeTable) else (v or [None])[0] for n, v in axes.items()}
        samples, *_ = self._sample(rows(self.units) if self.units else PARAMETERS, {})
        return found | {name: values[0] if values else None for name, values in samples.items()}

    def fixed_and_axes(self, of_blocks: Iterable[str]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Fixed values and axes; the loads of blocks are the last axis if there are several."""
        fixed, axes, loads = {**self.parts.fixed}, {**self.parts.axes}, [*dict.fromkeys(of_blocks)]
        for table in (fixed, axes) if loads else ():
            table.pop("load", None)
        if len(loads) > 1:
            axes["load"] = loads
        elif loads:
            fixed["load"] = loads[0]
        return fixed, axes


def _form_of(table: Table, forms: Mapping[tuple[str, ...], Sequence[str]]) -> tuple[str, ...]:
    """The form in which a table defines something, by the keys that define it.

    A StudyError if there is no form or several, if a form is not complete, or with keys of another form.
    """
    given = [name for name in type(table).model_fields if name in table.model_fields_set]
    defining = [name for form in forms for name in form if name in given]
    shown = [form for form in forms if {*form} & {*given}]
    if len(shown) != 1 or {*shown[0]} - {*given}:
        raise refused("", " and ".join(defining) or "nothing", table.allowed)
    form, beside = shown[0], forms[shown[0]]
    if strange := [name for name in given if name not in (*form, *beside)]:
        words = " and ".join(form)
        raise refused("", f"{', '.join(strange)} beside {words}", f"beside {words} only {', '.join(beside)}")
    return form


def _harmonics(rows: Any, column: str) -> Any:
    """Rows of order, amplitude and phase, which may be a text as in studies."""
    read = [*rows] if isinstance(rows, list) else rows
    for number, row in enumerate(read if isinstance(rows, list) else ()):
        if isinstance(row, list) and len(row) == 3 and isinstance(row[-1], str):
            try:
                read[number] = (*row[:-1], float(read_angle(row[-1])))
            except ValueError as error:
                key, found = f"{column}[{number}]", f"{literal(row[-1])} ({error})"
                raise refused(key, found, "a phase") from None
    return read


def read_signal_of(text: str, name: str, folder: Path) -> Signal | None:
    """The signal that a load of a sound study is; None for one that comes from no file."""
    table = LoadTable.of(parse_toml(text).get("loads", {}).get(name, {}))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # told when the study was read
        return signal_from(folder / table.file, name, table) if table.file else None


def profile_from(
    name: str, table: ProfileTable, folder: Path, units: Units | None = None
) -> TabulatedProfile:
    """A profile from its table."""
    if table.file is None:
        radius, height = table.radius, table.height
    elif table.two_sided:
        return trace_from(folder / table.file, name, table, units)
    else:
        kinds = dict.fromkeys(PROFILE_COLUMNS, "length")
        radius, height = read_columns(folder / table.file, PROFILE_COLUMNS, (), table, kinds, units)[0].T
    return TabulatedProfile(name, radius, height, table.smoothing or 0.0, table.geometry)


def unused(raw: Mapping[str, Any], grid: Grid | None, source: str) -> Report:
    """Loops or profiles that a study defines, and of which it uses none: a key was forgotten.

    Without a grid, of a study with mistakes, it is known where the key is nowhere.
    """
    report, tables = Report(source), {key: own for key, own in raw.items() if isinstance(own, dict)}
    given = [str(key) for place in ("fixed", "axes") for key in tables.get(place, ())]
    for parameter in ("load", "profile"):
        used = [*map(str, grid.values(parameter))] if grid else []
        used += [re.sub(r" \d+$", "", each) for each in used]  # kept cycles have the number of each
        named = any(meant(key, [parameter], {}) for key in given) or {"sample", "blocks"} & raw.keys()
        names = tables.get(f"{parameter}s", {})
        for name in names if (grid or not named) and {*used}.isdisjoint(names) else ():
            found, use = f"a {parameter} that is not used", f"{parameter} = {literal(name)}"
            report(f"{parameter}s.{name}", found, f"{use} in [fixed] or [axes], or none")
    return report
