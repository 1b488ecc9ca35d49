"""Testing every statement on the archives in a folder, and the outcomes as a table.

The template of the table is ``statements.md``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import xarray as xr

from swtstudy.paper.audit import AUDIT_PREFIX
from swtstudy.paper.rendered import rendered
from swtstudy.paper.statements.measures import NotInArchiveError
from swtstudy.paper.statements.statement import STATEMENTS, Finding, Statement

#: Names of the archives and audits that the statements are about.
STUDIES = tuple(dict.fromkeys(name for each in STATEMENTS.values() for name in each.studies))


class Outcome(NamedTuple):
    """A statement with its finding, or with the reason why there is none."""

    statement: Statement
    finding: Finding | None
    problem: str = ""

    @property
    def verdict(self) -> str:
        """Holds, does not hold, or not checked."""
        if self.finding is None:
            return "not checked"
        return "holds" if self.finding.holds else "does not hold"


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
    from swtstudy.archive.archive import open_results
    from swtstudy.paper.audit.dataset import open_audit

    archives: dict[str, xr.Dataset] = {}
    problems: dict[str, str] = {}
    for name in STUDIES:
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
        return Outcome(statement, None, "\n".join(found))
    try:
        return Outcome(statement, statement(*(archives[name] for name in statement.studies)))
    except NotInArchiveError as error:
        return Outcome(statement, None, f"{', '.join(statement.studies)}: {error} in the archive")


def summary(outcomes: Sequence[Outcome]) -> str:
    """Number of statements that hold, do not hold, or were not checked, in words."""
    count = Counter(each.verdict for each in outcomes)
    words = f"{len(outcomes)} statements: {count['holds']} hold, {count['does not hold']} do not"
    return words + (f", {count['not checked']} not checked" if count["not checked"] else "")


def markdown(outcomes: Sequence[Outcome]) -> str:
    """The table as a Markdown file."""
    return rendered("statements/statements.md", summary=summary(outcomes), outcomes=outcomes)
