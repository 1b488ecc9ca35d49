"""Testing every statement on the archives in a folder, and the outcomes as a table.

There is one for the terminal, and one as a Markdown file.
"""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from os import PathLike
from pathlib import Path

import xarray as xr

from swtstudy.paper.audit import AUDIT_PREFIX
from swtstudy.paper.statements import critical_point, face, formalisms, parameters, phase, waviness
from swtstudy.paper.statements.statement import Finding, NotInArchiveError, Statement

#: All statements, in the order of the paper.
STATEMENTS = tuple(
    each
    for file in (formalisms, critical_point, parameters, phase, face, waviness)
    for each in vars(file).values()
    if isinstance(each, Statement)
)
#: Names of the archives and audits that the statements are about.
STUDIES = tuple(dict.fromkeys(name for statement in STATEMENTS for name in statement.studies))


@dataclass(frozen=True)
class Outcome:
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

    @property
    def measured(self) -> str:
        """The numbers, or the reason why there are none, in one line."""
        return self.finding.measured if self.finding else self.problem.replace("\n", "; ")


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


#: Widths of the terminal's table and of its first and last column: the place and the verdict.
_NARROWEST, _PLACE, _VERDICT = 80, 11, 13


def terminal_table(outcomes: Iterable[Outcome], width: int) -> str:
    """The table as plain text of a given width in characters, without the criteria."""
    rest = max(width, _NARROWEST) - _PLACE - _VERDICT - 6
    widths = (_PLACE, rest * 2 // 5, rest - rest * 2 // 5, _VERDICT)
    rows = [("where", "the paper says", "measured", "")]
    for each in outcomes:
        rows.append((each.statement.place, each.statement.sentence, each.measured, each.verdict))
    lines: list[str] = []
    for row in rows:
        cells = [textwrap.wrap(cell, column) for cell, column in zip(row, widths, strict=True)]
        for parts in zip_longest(*cells, fillvalue=""):
            line = (f"{part:<{column}}" for part, column in zip(parts, widths, strict=True))
            lines.append("  ".join(line).rstrip())
        lines.append("" if len(lines) > 1 else "  ".join("-" * column for column in widths))
    return "\n".join(lines)


_INTRODUCTION = """\
# What the paper says, checked

Every statement of E. Willert, Eng 2024, 5, 333–346 (doi:10.3390/eng5010018) that the archives in this
folder can test, in our words. The paper says "almost", "little" or "weak" where a test needs a bound: the
bounds are ours, given in the third column. A statement that does not hold is reported as such.

Made by `swtstudy check`.
"""


def markdown(outcomes: Sequence[Outcome]) -> str:
    """The table as a Markdown file."""
    lines = [_INTRODUCTION, f"**{summary(outcomes)}.**", ""]
    lines += ["| Where | The paper says | Counts as holding if | Measured | |", "|---|---|---|---|---|"]
    for each in outcomes:
        texts = (each.statement.place, each.statement.sentence, each.statement.criterion, each.measured)
        cells = [text.replace("|", "\\|").replace("*", "\\*") for text in texts]
        verdict = each.verdict if each.verdict == "holds" else f"**{each.verdict}**"
        lines.append(f"| {' | '.join(cells)} | {verdict} |")
    return "\n".join(lines) + "\n"
