"""A validated study, and several of them from files."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from swtstudy.points.grid import SAMPLE, Grid
from swtstudy.points.reading import Known, Range, read_distances, read_grid
from swtstudy.study.contacts import every_name, kept_cycles, read_blocks, read_given, rows_of, told_of_lives
from swtstudy.study.figure import FigureLayout, check_figure
from swtstudy.study.scatter import read_scatter, without_scatter
from swtstudy.study.shipped import find_study, shipped_studies
from swtstudy.study.writing import as_html, in_one_line, to_toml
from swtstudy.vocabulary.definition import Definition
from swtstudy.vocabulary.files import parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import (
    STORABLE,
    Mistake,
    Report,
    StudyError,
    literal,
    meant,
    nearest,
    storable,
)
from swtstudy.vocabulary.parameters import AXES
from swtstudy.vocabulary.quantities import DISTANCE, YIELD, Request, read_quantities

if TYPE_CHECKING:
    from swtstudy.study.sample import Sample
    from swtstudy.vocabulary.parameter import Parameter

_READABLE = "a readable study file (TOML)"


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
        What is asked beside s.
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
        source = str(path)
        file = find_study(source)
        try:
            text = read_text(file)
        except FileNotFoundError:
            allowed = "a study file (TOML)"
            if not Path(path).suffix:
                allowed += f", or a study of the paper: {nearest(source, shipped_studies())}"
            raise StudyError([Mistake("", "no such file", allowed, source)]) from None
        except (OSError, ValueError) as error:
            found = "an archive" if Path(path).suffix == ".nc" else reason_of(error)
            raise StudyError([Mistake("", found, _READABLE, source)]) from None
        return cls.from_text(text, source, file.parent)

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
        try:
            raw = parse_toml(text)
        except ValueError as error:
            raise StudyError([Mistake("", str(error), "TOML", source)]) from None
        study = study_from(raw, text, source, Path(folder))
        _unused(raw, study.grid, source).refuse()
        for name in _idle(study.grid):
            warnings.warn(
                f"{source}: axes.{name} has no effect: what it is of does not oscillate", stacklevel=2
            )
        if isinstance(raw.get("units"), dict):
            from swtstudy.units.contacts_at_rest import doubts_of_units

            for line in doubts_of_units(study.grid):  # type: ignore[arg-type]
                warnings.warn(f"{source}: {line}", stacklevel=2)
        return study


def _unused(raw: Mapping[str, Any], grid: Grid, source: str) -> Report:
    """Loops or profiles that a sound study defines, and of which it uses none: a key was forgotten."""
    report = Report(source)
    for parameter in ("load", "profile"):
        used = {*map(str, grid.values(parameter))}
        tables = raw.get(f"{parameter}s", {})
        # Cycles that are kept one by one are loads of their own.
        if used.isdisjoint(tables) and not any(
            table.get("keep_cycles") is True and kept_cycles(name, used) for name, table in tables.items()
        ):
            for name in tables:
                words = f"a {parameter} that is not used"
                report(f"{parameter}s.{name}", words, f"{parameter} = {literal(name)} in the study, or none")
    return report


def _idle(grid: Grid) -> list[str]:
    """Axes of phases and frequencies of what stands still, or of loops, which have their own."""
    harmonic = len(grid.loops) < len(grid.values("load"))
    moves = harmonic and any(grid.values(grid.control.given_for("normal_amplitude")))
    pulled = harmonic and any(grid.values("bulk_stress_amplitude"))
    idle = {"phase": not moves, "frequency_ratio": not moves, "bulk_stress_phase": not pulled}
    return [name for name, still in idle.items() if still and name in grid.axes]


def tables_of(path: str | PathLike[str]) -> dict[str, Any]:
    """Read the tables of a study file; a StudyError with the reason if that cannot be."""
    try:
        return parse_toml(read_text(path))
    except (OSError, ValueError) as error:
        raise StudyError([Mistake("", reason_of(error), _READABLE, str(path))]) from None


def study_from(raw: Mapping[str, Any], text: str, source: str, folder: Path) -> Study:
    """The study of the tables of a file; see `Study.from_text`."""
    from swtstudy.study.tables import read_structure

    places: dict[str, str] = {}
    report = Report(source, lambda name: f"{places.get(name, 'fixed')}.{name}")
    table, of_structure = read_structure(raw, source)
    report += of_structure
    if not storable(str(raw.get("title", ""))):
        report("title", literal(raw["title"]), STORABLE)
    fixed, axes = _parts(raw)
    known = _definitions(raw, folder, report)
    blocks = read_blocks(raw, known.get("load", {}), report)
    fixed, axes = with_loads(fixed, axes, [block.load for block in blocks])
    contacts, distance = read_given(raw, fixed, folder, report)
    if distance is not None:
        if DISTANCE in {*fixed, *axes}:
            report("material", f"a threshold and a fatigue limit beside a {DISTANCE}", "one of the two")
        fixed = {**fixed, DISTANCE: distance} if DISTANCE not in axes else fixed
        places[DISTANCE] = "material"
    if contacts is not None:
        contacts = replace(contacts, blocks=blocks, scatter=read_scatter(raw, contacts, report))
    elif isinstance(raw.get("sample"), dict):
        read_scatter(raw, None, report)
    raw = without_scatter(raw)
    rows = rows_of(contacts.units if contacts else None)
    sample, sampled = sample_of(raw, folder, known, report, rows)
    places |= dict.fromkeys(axes, "axes") | dict.fromkeys(sampled, "sample")
    places |= {"load": "blocks"} if blocks else {}
    samples = {name: sample.values[name] if sample else None for name in sampled}
    distances = read_distances(fixed, axes, report, {**AXES, **rows}[DISTANCE])
    names = read_quantities(raw.get("quantities", []), "quantities", report)
    if contacts is not None and contacts.yield_strengths:
        names = tuple(dict.fromkeys((*names, YIELD)))
    counts = contacts is not None and bool(contacts.materials or contacts.shear_materials)
    if blocks and contacts is not None and not counts:
        told_of_lives(raw, report)
    asked = Request(names, *distances, counts=counts)
    grid: Grid | None
    if isinstance(raw.get("sample"), dict) and not sampled:
        grid, found = None, Report()  # what is sampled is unknown: nothing else is missing
    elif contacts is None:
        grid, found = read_grid(
            fixed, axes, report.key, source, others=(DISTANCE,), known=known, samples=samples
        )
    else:
        from swtstudy.units.reading import read_contacts

        grid, found = read_contacts(
            fixed, axes, contacts, report.key, source, samples, known, asked.distances
        )
    report += found
    figure = _figure_from(raw)
    if figure is not None:
        others = every_name() if contacts and report else ()
        check_figure(figure, _dims(raw, grid), grid, asked, report, others)
    if report or table is None or grid is None:
        told = {mistake.key for mistake in of_structure}  # once
        raise StudyError(dict.fromkeys(m for m in report if m in of_structure or m.key not in told))
    if _names_files(raw):
        # An archive and what a killed run leaves are read in other folders, and when the files may be gone.
        text = to_toml(table.title, table.rtol, grid, figure, asked)
    return Study(table.title, grid, table.rtol, asked, figure, text, sample)


def with_loads(
    fixed: dict[str, Any], axes: dict[str, Any], of_blocks: Sequence[str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """The same with the loads of blocks, as the last axis if there are several."""
    loads = list(dict.fromkeys(of_blocks))
    if not loads:
        return fixed, axes
    fixed, axes = ({n: v for n, v in part.items() if n != "load"} for part in (fixed, axes))
    return (fixed, {**axes, "load": loads}) if len(loads) > 1 else ({**fixed, "load": loads[0]}, axes)


def _names_files(raw: Mapping[str, Any]) -> bool:
    """Return whether a sound study has parts in files of their own."""
    defined = [table for kind in ("loads", "profiles") for table in raw.get(kind, {}).values()]
    return any("file" in table for table in (raw.get("sample", {}), raw.get("material", {}), *defined))


def _dims(raw: Mapping[str, Any], grid: Grid | None) -> list[str]:
    """The dimensions that a figure may name, also where there is no grid because of mistakes."""
    # A misspelt axis counts as the one that was meant: it must not cause mistakes in the figure, too.
    axis_names = raw["axes"] if isinstance(raw.get("axes"), dict) else {}
    names = [name if name in AXES else meant(name, AXES) or name for name in axis_names]
    names += ["load"] if raw.get("blocks") and (grid is None or "load" in grid.dims) else []
    dims = [*((SAMPLE,) if "sample" in raw else ()), *names]
    return dims + ([] if grid is None else [dim for dim in grid.dims if dim not in dims])


def sample_of(
    raw: Mapping[str, Any], folder: Path, known: Known, report: Report, rows: Mapping[str, Parameter]
) -> tuple[Sample | None, list[str]]:
    """The sample, and the names of the parameters that are sampled."""
    if not isinstance(raw.get("sample"), dict):
        return None, []
    from swtstudy.study.sample import read_sample

    single = {name: row for name, row in rows.items() if name not in (DISTANCE, "body")}
    return read_sample(raw["sample"], folder, report, known, single)


def _definitions(raw: Mapping[str, Any], folder: Path, report: Report) -> dict[str, dict[str, Definition]]:
    """Return the definitions of the study, by parameter and name, as far as its structure is sound."""
    known: dict[str, dict[str, Definition]] = {}
    for parameter in ("load", "profile"):
        tables = raw.get(f"{parameter}s", {})
        if not tables or not isinstance(tables, dict):
            continue
        from swtstudy.study.loops_and_profiles import read_loops, read_profiles

        sound = {name: table for name, table in tables.items() if isinstance(table, dict)}
        labels = raw["units"] if isinstance(raw.get("units"), dict) else {}
        read = read_loops if parameter == "load" else read_profiles
        known[parameter] = read(sound, folder, report, labels)
    return known


def _parts(raw: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Fixed values and axes as far as their structure is sound, so that all mistakes are found at once."""
    from swtstudy.study.keys import read_keys
    from swtstudy.study.tables import RangeTable

    fixed, axes = (raw.get(key, {}) for key in ("fixed", "axes"))
    good: dict[str, Any] = {}
    for name, axis in axes.items() if isinstance(axes, dict) else ():
        sound = read_keys(RangeTable, axis)[0] if isinstance(axis, dict) else None
        good[name] = Range(**dict(sound)) if sound else axis if isinstance(axis, list) else None
    return (fixed if isinstance(fixed, dict) else {}), good


def _figure_from(raw: Mapping[str, Any]) -> FigureLayout | None:
    """The layout of a study's figure; None without one, or with mistakes, which are reported elsewhere."""
    from swtstudy.study.keys import read_keys
    from swtstudy.study.tables import FigureTable

    figure = raw.get("figure")
    table = read_keys(FigureTable, figure)[0] if isinstance(figure, dict) else None
    if table is None:
        return None
    y = (table.y,) if isinstance(table.y, str) else tuple(table.y)
    return FigureLayout(**{**dict(table), "y": y})


def read_studies(paths: Iterable[str]) -> dict[str, Study]:
    """The studies by path, each file once.

    Each path is that of a file or of a folder of files, or the name of a study of the paper, such as
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
