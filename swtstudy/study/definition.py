"""A validated study, and several of them from files."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any

from swtstudy.points.grid import SAMPLE, SHAPE_COLUMNS, Grid
from swtstudy.points.rules import doubts
from swtstudy.points.values import Value
from swtstudy.study.figure import FigureLayout
from swtstudy.study.reading import StudyReader, unused
from swtstudy.study.sample import Design
from swtstudy.study.shipped import find_study, shipped_studies
from swtstudy.study.units.grid import PhysicalGrid
from swtstudy.study.units.material import STRENGTH
from swtstudy.study.units.reading import doubts_of_units
from swtstudy.study.units.rows import REST_DEPENDS_ON, with_replaced
from swtstudy.vocabulary.choices import SWT, families_with
from swtstudy.vocabulary.files import TomlError, parse_toml, read_text, reason_of
from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError, literal, nearest, refused
from swtstudy.vocabulary.quantities import DISTANCE, QUANTITIES, Request
from swtstudy.vocabulary.wording import html_table, listed, number_of, plain_words, unit_words, with_rad

#: How many values of an axis are listed one by one: a cell of a table in a notebook.
_LISTED = 6
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
        raise refused("study", literal(study), 'a Study, as from Study.from_toml("figure3")')


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
    design
        The design of its sample, or None.
    told
        What was warned of when it was read, such as spikes in a file: archives and reports keep it.

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
    design: Design | None = None
    told: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Study {self.title!r}: {self._size}, rtol {self.rtol:g}>"

    def _repr_html_(self) -> str:
        """A table for a notebook: axes, fixed parameters, points, cost, and the places in the figure."""
        roles = {name: role for role, name in self.figure.roles()} if self.figure else {}
        grid, asked = self.grid, self.asked

        def row_of(
            kind: str, name: str, values: tuple[Value, ...], place: str = ""
        ) -> tuple[str, str, str, str]:
            row, role = grid.row(name), roles.get(place)
            several = [with_rad(plain_words(value), {"units": row.units}) for value in values]
            words = listed(several, _LISTED) + unit_words(row.units)
            return kind, name, words, row.described + (f"; figure: {role}" if role else "")

        rows = [row_of("axis", name, values, name) for name, values in grid.axes.items()]
        rows += [row_of("sampled", name, values, SAMPLE) for name, values in grid.samples.items()]
        if asked.distances:
            rows.append(row_of("axis" if asked.is_axis else "fixed", DISTANCE, asked.distances, DISTANCE))
        rows += [("quantity", name, "", QUANTITIES[name].meaning) for name in asked.names]
        rows += [row_of("fixed", name, (value,)) for name, value in grid.fixed.items()]
        rows += [row_of("of each body", name, two) for name, two in getattr(grid, "pairs", {}).items()]
        return (
            f"<div><b>{escape(self.title)}</b><br>{escape(self._size)}, rtol {self.rtol:g}; "
            f"swtstudy plan tells how long it takes{html_table(rows)}</div>"
        )

    @property
    def _size(self) -> str:
        """Number of points, and of the values of each axis."""
        axes = " × ".join(f"{size} {name}" for name, size in self.grid.sizes.items())
        points = number_of(self.grid.size, "point")
        return f"{points} = {axes}" if axes else points

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
            raise refused("path", literal(path), "the path or the name of a study")
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
            raise refused("text", literal(text), "the text of a study file")
        raw = _parsed(text, source)
        with _telling() as told:
            try:
                study = study_from(raw, text, source, Path(folder))
            except StudyError as error:
                keys = [mistake.key for mistake in error.mistakes]
                unsaid = unused(raw, None, source)
                forgotten = [m for m in unsaid if not any(key.startswith(m.key) for key in keys)]
                raise StudyError([*forgotten, *error.mistakes]) from None
            unused(raw, study.grid, source).refuse()
            shown = study.figure.y if study.figure else ()
            odd = doubts_of_units(study.grid, shown) if isinstance(study.grid, PhysicalGrid) else ()
            for line in (*doubts(study.grid, "axes."), *odd):
                warnings.warn(f"{source}: {line}", stacklevel=2)
        return replace(study, told=tuple(str(each.message) for each in told))


@contextmanager
def _telling() -> Iterator[list[warnings.WarningMessage]]:
    """Collect warnings, and warn of them at the end."""
    caught = list[warnings.WarningMessage]()
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            yield caught
    finally:
        for each in caught:
            warnings.warn(each.message, stacklevel=4)


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
            found, here = "no such file", f"{source}.toml"
            likely = nearest(source, shipped_studies(), listed_by="swtstudy list")
            of_paper = f", or a study of the paper: {likely}"
            allowed += f": {here} is there" if Path(here).exists() else of_paper
    except OSError as error:
        found, allowed = reason_of(error), _READABLE
    except ValueError as error:
        found, allowed = _OTHER_FILES.get(file.suffix.lower(), (str(error), f"{_READABLE}, saved as UTF-8"))
    raise refused("", found, allowed, source)


def _parsed(text: str, source: str) -> dict[str, Any]:
    """The tables in the text of a study; a StudyError if it is not TOML, such as a table that is none."""
    try:
        return parse_toml(text)
    except TomlError as error:
        found = _OTHER_FILES.get(Path(source).suffix.lower())
        mistake = Mistake("", str(error), "TOML", source, error.shown)
        raise StudyError([Mistake("", *found, source) if found else mistake]) from None


def study_from(raw: Mapping[str, Any], text: str, source: str, folder: Path) -> Study:
    """The study of the tables of a file; see `Study.from_text`."""
    return Study(**StudyReader(raw, source, folder).fields(text))


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
    path = str(find_study(path))
    raw = tables_of(path)
    reader = StudyReader(raw, path, Path(path).parent)
    reader.report.refuse()
    fixed, axes = reader.fixed_and_axes(block.load for block in reader.parts.blocks)
    alone = {axis: one[0] for axis, one in axes.items() if isinstance(one, list) and len(one) == 1}
    fixed |= alone
    profiles, name = dict(raw.get("profiles", {})), str(values.get("profile", fixed.get("profile")))
    if Path(name).suffix == ".csv":
        file, name = str(Path(name).resolve()), Path(name).stem
        profiles[name], values = {"file": file}, {**values, "profile": name}
    if smoothing is not None:
        if name not in profiles:
            raise refused("smoothing", f"{smoothing:g} of {literal(name)}", "for a table alone")
        profiles[name] = {**profiles[name], "smoothing": smoothing}
    replaced = with_replaced(values) | {DISTANCE}
    if values.get("profile") in profiles and "radius" not in values:
        replaced |= {"radius"}  # a table has lengths of its own
    if "profile" in values:  # what the profile does not have
        replaced |= {name for name in SHAPE_COLUMNS if values["profile"] not in families_with(name)}
    if "criterion" in values:
        replaced |= {"normal_sensitivity" if values["criterion"] == SWT else "walker_exponent"}
    chosen = replaced | {*alone, "body"}
    several = {axis: one for axis, one in reader.firsts(axes).items() if axis not in chosen}
    if at_rest:
        # Any of its values will do for what the contact at rest does not depend on.
        needed = REST_DEPENDS_ON if "units" in raw else ("profile", *SHAPE_COLUMNS)
        values = {**{name: first for name, first in several.items() if name not in needed}, **values}
        several = {name: first for name, first in several.items() if name in needed}
    if several:
        option = f"--{next(iter(several)).replace('_', '-')} VALUE"
        raise refused("", f"several values of {', '.join(several)}", f"one of each, such as {option}", path)
    kept = {key: table for key, table in raw.items() if key not in _OF_STUDIES}
    kept |= {"profiles": profiles} if profiles else {}
    if "criterion" in values and "material" in kept:
        own = {key: value for key, value in kept.pop("material").items() if key == STRENGTH}
        kept |= {"material": own} if own else {}
    kept["fixed"] = {name: value for name, value in fixed.items() if name not in replaced} | dict(values)
    return study_from(kept, "", path, Path(path).parent).grid


def read_studies(paths: Iterable[str], mistakes: Report | None = None) -> dict[str, Study]:
    """The sound studies by path, each file once.

    Each path leads to a file or a folder of files, or is the name of a study of the paper, such as
    "figure3".

    Raises
    ------
    StudyError
        A ValueError with every mistake in every file, unless ``mistakes`` collects them; also if two files
        would have the same archive.
    """
    report, files = Report() if mistakes is None else mistakes, list[str]()
    for path in paths:
        is_folder = Path(path).is_dir()
        inside = sorted(map(str, Path(path).glob("*.toml"))) if is_folder else [str(find_study(path))]
        if not inside:
            report.append(Mistake("", "a folder without studies", "studies (*.toml) in it", path))
        files += inside
    studies: dict[str, Study] = {}
    names: dict[str, str] = {}
    for path in dict.fromkeys(files):
        with report:
            studies[path] = Study.from_toml(path)
        first = names.setdefault(Path(path).stem, path)
        if first != path:
            report.append(Mistake("", f"the same name as {first}", "names that differ", path))
    if mistakes is None:
        report.refuse()
    return studies
