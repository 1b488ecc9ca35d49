"""A validated study, and several of them from files."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.points.canonical import SHAPE_COLUMNS
from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import Range, read_distances, read_grid
from swtstudy.study.figure import FigureLayout, check_figure
from swtstudy.study.keys import Parts, read_study
from swtstudy.study.shipped import find_study, shipped_studies
from swtstudy.study.writing import as_html, in_one_line, to_toml
from swtstudy.units.rows import ONE_OF, REST_DEPENDS_ON, rows
from swtstudy.vocabulary.choices import SWT, families_with
from swtstudy.vocabulary.derived import NAMES
from swtstudy.vocabulary.files import TomlError, parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, meant, nearest
from swtstudy.vocabulary.parameters import AXES, PARAMETERS
from swtstudy.vocabulary.quantities import DISTANCE, EVERY_VARIABLE, YIELD, Request, read_quantities

if TYPE_CHECKING:
    from swtstudy.study.sample import Sample
    from swtstudy.units.grid import ContactDetails
    from swtstudy.vocabulary.parameter import Parameter

_READABLE = "a readable study file (TOML)"
_NAMED = 'a study (TOML) that names it: file = "…" under [loads.NAME], [profiles.NAME] or [sample]'
#: Files that are no studies, by how their names end: what they are, and what takes them.
_OTHER_FILES = {
    ".nc": ("an archive", f"{_READABLE}; archives are for swtstudy report, plot and info"),
    **dict.fromkeys((".csv", ".tsv", ".txt", ".dat"), ("a table of values (CSV)", _NAMED)),
    **dict.fromkeys((".xlsx", ".xlsm", ".xls"), ("an Excel workbook", _NAMED)),
}


def require_study(study: object) -> None:
    """Raise a StudyError if this is not a Study but, for example, the name or path of one."""
    if not isinstance(study, Study):
        raise StudyError([Mistake("study", literal(study), 'a Study, as from Study.from_toml("figure3")')])


@dataclass(frozen=True, repr=False)
class Study:
    """A study: what to compute, how accurately, and what to draw.

    Attributes
    ----------
    title
        One line that names it.
    grid
        Its points.
    rtol
        Relative accuracy asked of s.
    asked
        The quantities beside s.
    figure
        Layout of the figure, or None.
    text
        The study file as it was read, or, if that names other files, one that says the same without them; it
        is stored in the archive.
    sample
        Where the sample of the grid comes from, or None.

    Examples
    --------
    >>> import swtstudy
    >>> study = swtstudy.Study.from_text('''
    ... title = "Three phases"
    ... [axes]
    ... phase = { start = 0, stop = "pi", num = 3 }
    ... ''')
    >>> study.grid.shape, study.rtol
    ((3,), 0.0001)
    """

    title: str
    grid: Grid
    rtol: float
    asked: Request
    figure: FigureLayout | None
    text: str
    sample: Sample | None = None

    def __repr__(self) -> str:
        return in_one_line(self)

    def _repr_html_(self) -> str:
        return as_html(self)

    @classmethod
    def from_toml(cls, path: str | PathLike[str]) -> Study:
        """Read and validate a study file.

        Parameters
        ----------
        path
            The file, or the name of a study that comes with the package, such as "figure3".

        Raises
        ------
        StudyError
            A ValueError with every mistake in the file, or with the reason why it cannot be read.
        """
        if not isinstance(path, str | PathLike):
            raise StudyError([Mistake("path", literal(path), "the path or the name of a study")])
        source, file = str(path), find_study(str(path))
        return cls.from_text(_text_of(file, source), source, file.parent)

    @classmethod
    def from_text(cls, text: str, source: str = "study", folder: str | PathLike[str] = ".") -> Study:
        """Validate the text of a study file.

        Parameters
        ----------
        text
            The text.
        source
            Names it in messages.
        folder
            To which the paths of files in it are relative.

        Raises
        ------
        StudyError
            A ValueError with every mistake in the text.
        """
        if not isinstance(text, str):
            raise StudyError([Mistake("text", literal(text), "the text of a study file")])
        raw = _parsed(text, source)
        study = study_from(raw, text, source, Path(folder))
        _unused(raw, study.grid, source).refuse()
        for line in _doubts(study.grid, "units" in raw):
            warnings.warn(f"{source}: {line}", stacklevel=2)
        return study


def _unused(raw: Mapping[str, Any], grid: Grid, source: str) -> Report:
    """Loops or profiles that a sound study defines, and of which it uses none: a key was forgotten."""
    from swtstudy.study.loops_and_profiles import kept_cycles

    report = Report(source)
    for parameter in ("load", "profile"):
        used, tables = {*map(str, grid.values(parameter))}, raw.get(f"{parameter}s", {})
        # Cycles that are kept one by one are loads of their own.
        kept = (kept_cycles(name, used) for name, table in tables.items() if table.get("keep_cycles"))
        for name in tables if used.isdisjoint(tables) and not any(kept) else ():
            words = f"a {parameter} that is not used"
            report(f"{parameter}s.{name}", words, f"{parameter} = {literal(name)} in the study, or none")
    return report


def _doubts(grid: Grid, has_units: bool) -> Iterator[str]:
    """Axes of phases and frequencies of what stands still, or of loops, which have their own; odd units."""
    harmonic = len(grid.loops) < len(grid.values("load"))
    moves = harmonic and any(grid.values(grid.control.given_for("normal_amplitude")))
    pulled = harmonic and any(grid.values("bulk_stress_amplitude"))
    idle = {"phase": not moves, "frequency_ratio": not moves, "bulk_stress_phase": not pulled}
    for name in (name for name, still in idle.items() if still and name in grid.axes):
        yield f"axes.{name} has no effect: what it is of does not oscillate"
    if has_units:
        from swtstudy.units.reading import doubts_of_units

        yield from doubts_of_units(grid)  # type: ignore[arg-type]


def tables_of(path: str | PathLike[str]) -> dict[str, Any]:
    """Read the tables of a study file; a StudyError with the reason if that cannot be."""
    return _parsed(_text_of(Path(path), str(path)), str(path))


def _text_of(file: Path, source: str) -> str:
    """The text of a study file; a StudyError with the reason if that cannot be read."""
    try:
        return read_text(file)
    except FileNotFoundError as error:
        found, allowed = reason_of(error), "a study file (TOML)"
        if not file.suffix:
            known = nearest(source, shipped_studies())
            found, allowed = "no such file", f"{allowed}, or a study of the paper: {known}"
        raise StudyError([Mistake("", found, allowed, source)]) from None
    except OSError as error:
        raise StudyError([Mistake("", reason_of(error), _READABLE, source)]) from None
    except ValueError as error:
        found, allowed = _OTHER_FILES.get(file.suffix.lower(), (str(error), _READABLE))
        raise StudyError([Mistake("", found, allowed, source)]) from None


def _parsed(text: str, source: str) -> dict[str, Any]:
    """The tables in the text of a study; a StudyError if it is not TOML, such as a table that is none."""
    try:
        return parse_toml(text)
    except TomlError as error:
        other = _OTHER_FILES.get(Path(source).suffix.lower())
        mistake = (
            Mistake("", *other, source) if other else Mistake("", str(error), "TOML", source, error.shown)
        )
        raise StudyError([mistake]) from None


def study_from(raw: Mapping[str, Any], text: str, source: str, folder: Path) -> Study:
    """The study of the tables of a file; see `Study.from_text`."""
    from swtstudy.study.loops_and_profiles import read_blocks, read_definitions

    places: dict[str, str] = {}
    report = Report(source, lambda name: f"{places.get(name, 'fixed')}.{name}")
    parts, of_structure = read_study(raw, source)
    report += of_structure
    known = read_definitions(raw, parts, folder, report)
    blocks = read_blocks(raw, parts, known["load"], report)
    fixed, axes = with_loads(parts.fixed, parts.axes, [block.load for block in blocks])
    contacts, fixed = _contacts(raw, parts, fixed, axes, folder, report)
    places |= {DISTANCE: "material"} if DISTANCE not in parts.fixed else {}
    own: Mapping[str, Parameter] = rows(contacts.units) if contacts else PARAMETERS
    sample, scatter = None, None
    sampled: list[str] = []
    if parts.sample is not None:
        from swtstudy.study.sample import read_sample

        given, single = raw["sample"], _sampled_of(own)
        sample, sampled, scatter = read_sample(parts.sample, given, folder, report, known, single, contacts)
    is_sampled = "sample" in raw and (bool(sampled) or scatter is None)
    places |= dict.fromkeys(axes, "axes") | dict.fromkeys(sampled, "sample")
    places |= {"load": "blocks"} if blocks else {}
    samples = {name: sample.values[name] if sample else None for name in sampled}
    distances = read_distances(fixed, axes, report, {**AXES, **own}[DISTANCE])
    names = read_quantities(parts.quantities, "quantities", report)
    asked = Request(names, *distances)
    if contacts is not None:
        contacts = replace(contacts, blocks=tuple(blocks), scatter=scatter)
        strong = (YIELD,) if contacts.yield_strengths and YIELD not in asked.names else ()
        counts = bool(contacts.materials or contacts.shear_materials)
        asked = replace(asked, names=(*asked.names, *strong), counts=counts)
        wrong_material = any(mistake.key.startswith("material") for mistake in report)
        if blocks and not counts and "material" in raw and not wrong_material:
            found = "blocks with a [material] without lives"
            report("blocks", found, "constants of lives: Miner's sum needs them")
    grid, wrong = None, Report()
    if is_sampled and not sampled:
        pass  # what is sampled is unknown: nothing else is missing
    elif contacts is None:
        grid, wrong = read_grid(fixed, axes, report.key, source, (DISTANCE,), samples, known)
    else:
        from swtstudy.units.reading import read_contacts

        grid, wrong = read_contacts(
            fixed, axes, contacts, report.key, source, samples, known, asked.distances
        )
    report += wrong
    figure = parts.figure
    if figure is not None:
        # A misspelt axis counts as the one that was meant: it must not cause mistakes in the figure, too.
        dims = [name if name in AXES else meant(name, AXES) or name for name in axes]
        dims += [dim for dim in (grid.dims if grid else ()) if dim not in (*dims, SAMPLE)]
        unsure = {*NAMES, *EVERY_VARIABLE} if contacts and report else set()
        check_figure(figure, [SAMPLE] * is_sampled + dims, grid, asked, report, unsure)
    if report or grid is None:
        told = {mistake.key for mistake in of_structure}  # once
        raise StudyError(dict.fromkeys(m for m in report if m in of_structure or m.key not in told))
    tables = [parts.sample, *parts.loads.values(), *parts.profiles.values()]
    if "file" in (parts.material or ()) or any(table.file for table in tables if table):
        # An archive and what a killed run leaves are read in other folders, and when the files may be gone.
        text = to_toml(parts.title, parts.rtol, grid, figure, asked)
    return Study(parts.title, grid, parts.rtol, asked, figure, text, sample)


def _contacts(
    raw: Mapping[str, Any],
    parts: Parts,
    fixed: dict[str, Any],
    axes: Mapping[str, Any],
    folder: Path,
    report: Report,
) -> tuple[ContactDetails | None, dict[str, Any]]:
    """Units and materials, None without units; and the fixed values with the materials' critical distance."""
    if parts.units is None:
        if "material" in raw and "units" not in raw:
            report("material", "constants without [units]", "with [units] only: a life needs a real contact")
        return None, fixed
    from swtstudy.units.material import read_given

    contacts, distance = read_given(parts.units, parts.material, fixed, folder, report)
    if distance is None:
        return contacts, fixed
    if DISTANCE in {*fixed, *axes}:
        report("material", f"a threshold and a fatigue limit beside a {DISTANCE}", "one of the two")
    return contacts, {**fixed, DISTANCE: distance} if DISTANCE not in axes else fixed


def with_loads(
    fixed: Mapping[str, Any], axes: Mapping[str, Any], of_blocks: Sequence[str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """The same with the loads of blocks, as the last axis if there are several."""
    loads = list(dict.fromkeys(of_blocks))
    fixed, axes = ({n: v for n, v in part.items() if n != "load" or not loads} for part in (fixed, axes))
    if len(loads) > 1:
        return fixed, {**axes, "load": loads}
    return ({**fixed, "load": loads[0]} if loads else fixed), axes


def _sampled_of(own: Mapping[str, Parameter]) -> dict[str, Parameter]:
    """The parameters that may be sampled."""
    return {name: row for name, row in own.items() if name not in (DISTANCE, "body")}


#: Parts of a study that no single contact has.
_OF_STUDIES = ("axes", "sample", "figure", "blocks", "quantities")


def one_of_study(
    path: str, values: Mapping[str, object], smoothing: float | None = None, at_rest: bool = False
) -> Grid:
    """The one point of a study file, with other values of some parameters, or values along its axes.

    Parameters
    ----------
    path
        The study file, or the name of a study of the paper.
    values
        Its parameters, which replace the study's; the profile may be a CSV file.
    smoothing
        Smoothing of a profile that is a table; it replaces the study's.
    at_rest
        Whether only the contact at rest counts: then axes that do not change it need no value.

    Returns
    -------
    Grid
        One value of each parameter: a `PhysicalGrid`, but for both bodies, if the study has units.

    Raises
    ------
    StudyError
        With every mistake; also if an axis of the study, or what it samples, has no value here.
    """
    from swtstudy.units.material import STRENGTH

    path = str(find_study(path))
    raw = tables_of(path)
    parts, mistakes = read_study(raw, path)
    if mistakes:
        raise StudyError(mistakes)
    fixed, axes = with_loads(parts.fixed, parts.axes, [block.load for block in parts.blocks])
    profiles, name = dict(raw.get("profiles", {})), str(values.get("profile", fixed.get("profile")))
    if Path(name).suffix == ".csv":
        file, name = str(Path(name).resolve()), Path(name).stem
        profiles[name], values = {"file": file}, {**values, "profile": name}
    if smoothing is not None:
        if name not in profiles:
            raise StudyError([Mistake("smoothing", f"{smoothing:g} of {literal(name)}", "for a table alone")])
        profiles[name] = {**profiles[name], "smoothing": smoothing}
    replaced = {*values}.union(*(pair for pair in ONE_OF if {*pair} & values.keys()))
    if values.get("profile") in profiles and "radius" not in values:
        replaced |= {"radius"}  # a table has lengths of its own
    if "profile" in values:  # what the profile does not have
        replaced |= {name for name in SHAPE_COLUMNS if values["profile"] not in families_with(name)}
    if "criterion" in values:
        replaced |= {"normal_sensitivity" if values["criterion"] == SWT else "walker_exponent"}
    several = {
        name: axis.start if isinstance(axis, Range) else (axis or [None])[0] for name, axis in axes.items()
    }
    several |= _firsts_of_sample(parts, Path(path).parent)
    several = {n: first for n, first in several.items() if n not in (*replaced, DISTANCE, "body")}
    if at_rest:
        # Any of its values will do for what the contact at rest does not depend on.
        needed = REST_DEPENDS_ON if "units" in raw else ("profile", *SHAPE_COLUMNS)
        values = {**{name: first for name, first in several.items() if name not in needed}, **values}
        several = {name: first for name, first in several.items() if name in needed}
    if several:
        found = f"several values of {', '.join(several)}"
        option = f"--{next(iter(several)).replace('_', '-')} VALUE"
        raise StudyError([Mistake("", found, f"one of each, such as {option}", path)])
    kept = {key: table for key, table in raw.items() if key not in _OF_STUDIES}
    kept |= {"profiles": profiles} if profiles else {}
    if "criterion" in values and "material" in kept:
        own = {key: value for key, value in kept.pop("material").items() if key == STRENGTH}
        kept |= {"material": own} if own else {}
    others = {name: value for name, value in fixed.items() if name not in replaced and name != DISTANCE}
    kept["fixed"] = others | dict(values)
    return study_from(kept, "", path, Path(path).parent).grid


def _firsts_of_sample(parts: Parts, folder: Path) -> dict[str, object]:
    """The first values of the parameters that a study samples; None for parameters with mistakes."""
    if parts.sample is None:
        return {}
    from swtstudy.study.sample import read_sample
    from swtstudy.units.rows import read_units

    units = read_units(parts.units, Report()) if parts.units is not None else None
    own = _sampled_of(rows(units) if units else PARAMETERS)
    given = parts.sample.model_fields_set
    sample, sampled, _ = read_sample(parts.sample, given, folder, Report(), {}, own)
    return {name: sample.values[name][0] if sample else None for name in sampled}


def read_studies(paths: Iterable[str]) -> dict[str, Study]:
    """The studies by path, each file once.

    Each path leads to a file or a folder of files, or is the name of a study of the paper, such as
    "figure3".

    Raises
    ------
    StudyError
        A ValueError with every mistake in every file; also if two files would have the same archive.
    """
    report = Report()
    studies = sound_studies(paths, report)
    report.refuse()
    return studies


def sound_studies(paths: Iterable[str], report: Report) -> dict[str, Study]:
    """The studies that are sound; every mistake is reported. See `read_studies`."""
    studies: dict[str, Study] = {}
    names: dict[str, str] = {}
    for path in dict.fromkeys(_files(paths, report)):
        with report:
            studies[path] = Study.from_toml(path)
        first = names.setdefault(Path(path).stem, path)
        if first != path:
            report.append(Mistake("", f"the same name as {first}", "names that differ", path))
    return studies


def _files(paths: Iterable[str], report: Report) -> Iterator[str]:
    for path in paths:
        if not Path(path).is_dir():
            yield str(find_study(path))
            continue
        inside = sorted(map(str, Path(path).glob("*.toml")))
        if not inside:
            report.append(Mistake("", "a folder without studies", "studies (*.toml) in it", path))
        yield from inside
