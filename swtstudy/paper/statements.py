"""Statements of the paper: the rows of ``statements.toml``, each tested on the archives in a folder.

The functions that test them are in files beside it; the template of the table is ``statements.md``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from pkgutil import resolve_name
from typing import Any, NamedTuple

import xarray as xr

from swtstudy.paper.audit import AUDIT_PREFIX
from swtstudy.paper.markdown import rendered
from swtstudy.paper.measures import NotInArchiveError
from swtstudy.vocabulary.files import read_table

#: A test's result: whether the statement holds, and the values for the words of its measurement, by name.
Measured = tuple[Any, dict[str, Any]]


class Outcome(NamedTuple):
    """A statement with a measurement in words and whether it holds by it, or why there is no measurement."""

    statement: Statement
    measured: str = ""
    holds: bool | None = None
    problem: str = ""

    @property
    def verdict(self) -> str:
        """Holds, does not hold, or not checked."""
        return {True: "holds", False: "does not hold", None: "not checked"}[self.holds]


@dataclass(frozen=True)
class Statement:
    """A statement of the paper and how it is tested; ``statements.toml`` explains the attributes."""

    place: str
    sentence: str
    holds_if: str
    measured: str
    test: str
    studies: tuple[str, ...] = ()
    bounds: dict[str, Any] = field(default_factory=dict)

    @property
    def criterion(self) -> str:
        """The criterion with its bounds."""
        return self.holds_if.format(**self.bounds)

    def __call__(self, *archives: xr.Dataset) -> Outcome:
        """Test the statement on the archives of its studies, in their order."""
        holds, values = resolve_name(f"{__package__}.{self.test}")(*archives, **self.bounds)
        return Outcome(self, self.measured.format(**self.bounds, **values), bool(holds))


#: All statements by name, in the order of the paper.
STATEMENTS = {name: Statement(**row) for name, row in read_table(__file__, "statements").items()}


def check(results: str | PathLike[str] = "results") -> list[Outcome]:
    """Test every statement of the paper.

    Parameters
    ----------
    results
        Folder with the archives of the suite, named after their studies, and with the audit.

    Returns
    -------
    list of Outcome
        One for each statement, in the order of `STATEMENTS`; without a measurement if an archive is missing
        or has gaps.

    Raises
    ------
    ArchiveError
        A ValueError, if one of the files is not an archive.
    """
    from swtstudy.archive.archive import open_results
    from swtstudy.paper.audit import open_audit

    archives: dict[str, xr.Dataset] = {}
    problems: dict[str, str] = {}
    for name in dict.fromkeys(name for each in STATEMENTS.values() for name in each.studies):
        path, audited = Path(results) / f"{name}.nc", name.startswith(AUDIT_PREFIX)
        command = f"swtstudy {'audit' if audited else 'run'} {name.removeprefix(AUDIT_PREFIX)}"
        if not path.is_file():
            problems[name] = f"{path} is missing; made by: {command}"
            continue
        archives[name] = open_audit(path) if audited else open_results(path)
        gaps = 0 if audited else int(archives[name].s.isnull().sum())
        if gaps:
            lost = f"{gaps} of {archives[name].s.size} points"
            problems[name] = f"{path} has no value at {lost}; made by: {command} --retry-failed"
    return [_outcome(statement, archives, problems) for statement in STATEMENTS.values()]


def about_archive(name: str, dataset: xr.Dataset) -> list[Outcome]:
    """The statements about one archive of the suite alone; none about another one.

    Parameters
    ----------
    name
        Name of the archive's study.
    dataset
        Its results.
    """
    return [_outcome(each, {name: dataset}, {}) for each in STATEMENTS.values() if each.studies == (name,)]


def _outcome(
    statement: Statement, archives: Mapping[str, xr.Dataset], problems: Mapping[str, str]
) -> Outcome:
    if found := [problems[name] for name in statement.studies if name in problems]:
        return Outcome(statement, problem="\n".join(found))
    try:
        return statement(*(archives[name] for name in statement.studies))
    except NotInArchiveError as error:
        return Outcome(statement, problem=f"{', '.join(statement.studies)}: {error} in the archive")


def summary(outcomes: Sequence[Outcome]) -> str:
    """Number of statements that hold, do not hold, or were not checked, in words."""
    count = Counter(each.verdict for each in outcomes)
    words = f"{len(outcomes)} statements: {count['holds']} hold, {count['does not hold']} do not"
    return words + (f", {count['not checked']} not checked" if count["not checked"] else "")


def markdown(outcomes: Sequence[Outcome]) -> str:
    """The table as a Markdown file."""
    return rendered("statements.md", summary=summary(outcomes), outcomes=outcomes)
