"""Testing every statement on the archives in a folder."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from swtstudy.paper.audit import AUDIT_PREFIX
from swtstudy.paper.statements import (
    critical_point,
    figure3,
    figure4,
    figure5,
    figure6,
    figure7,
    figure8,
    parameters,
)
from swtstudy.paper.statements.select import NotInArchiveError
from swtstudy.paper.statements.statement import Finding, Statement

if TYPE_CHECKING:
    import xarray as xr

#: All statements, in the order of the figures.
STATEMENTS: tuple[Statement, ...] = (
    *critical_point.STATEMENTS,
    *parameters.STATEMENTS,
    *figure3.STATEMENTS,
    *figure4.STATEMENTS,
    *figure5.STATEMENTS,
    *figure6.STATEMENTS,
    *figure7.STATEMENTS,
    *figure8.STATEMENTS,
)


#: Names of the archives and audits that the statements are about.
STUDIES = tuple(dict.fromkeys(name for statement in STATEMENTS for name in statement.studies))


@dataclass(frozen=True)
class Outcome:
    """A statement with its finding, or with the reason why there is none."""

    statement: Statement
    finding: Finding | None
    problem: str = ""


def check(results: str | PathLike[str] = "results") -> list[Outcome]:
    """Test every statement of the paper.

    Parameters
    ----------
    results
        Folder with the archives of the suite, named after their studies, and with the audit.

    Returns
    -------
    list of Outcome
        One for each statement, in the order of `STATEMENTS`; without a finding if an archive is missing or
        has gaps.

    Raises
    ------
    ArchiveError
        A ValueError, if one of the files is not an archive.
    """
    archives: dict[str, xr.Dataset] = {}
    problems: dict[str, str] = {}
    for name in STUDIES:
        path = Path(results) / f"{name}.nc"
        problem = _problem(name, path, archives)
        if problem:
            problems[name] = problem
    return [_outcome(statement, archives, problems) for statement in STATEMENTS]


def about_archive(name: str, dataset: xr.Dataset) -> list[Outcome]:
    """The statements about one archive of the suite alone; none about another one.

    Parameters
    ----------
    name
        Name of the archive's study.
    dataset
        Its results.
    """
    return [_outcome(each, {name: dataset}, {}) for each in STATEMENTS if each.studies == (name,)]


def _problem(name: str, path: Path, archives: dict[str, xr.Dataset]) -> str:
    """Add an archive to the others; return the reason if it cannot be used."""
    from swtstudy.archive.open import open_results
    from swtstudy.paper.audit.table import open_audit

    audited = name.startswith(AUDIT_PREFIX)
    command = f"swtstudy {'audit' if audited else 'run'} {name.removeprefix(AUDIT_PREFIX)}"
    if not path.is_file():
        return f"{path} is missing; made by: {command}"
    if audited:
        archives[name] = open_audit(path)
        return ""
    dataset = open_results(path)
    gaps = int(dataset.s.isnull().sum())
    if gaps:
        return f"{path} has no value at {gaps} of {dataset.s.size} points; made by: {command} --retry-failed"
    archives[name] = dataset
    return ""


def _outcome(statement: Statement, archives: dict[str, xr.Dataset], problems: dict[str, str]) -> Outcome:
    found = [problems[name] for name in statement.studies if name in problems]
    if found:
        return Outcome(statement, None, "\n".join(found))
    try:
        return Outcome(statement, statement.test(*(archives[name] for name in statement.studies)))
    except NotInArchiveError as error:
        return Outcome(statement, None, f"{', '.join(statement.studies)}: {error} in the archive")
