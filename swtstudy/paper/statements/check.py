"""Testing every statement on the archives in a folder, and the outcomes as a table.

There is one for the terminal, and one as a Markdown file.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path

import xarray as xr

from swtstudy.paper.audit import AUDIT_PREFIX
from swtstudy.paper.statements import critical_point, face, formalisms, parameters, phase, waviness
from swtstudy.paper.statements.statement import Finding, NotInArchiveError, Statement

#: All statements, in the order of the paper.
STATEMENTS: tuple[Statement, ...] = (
    *formalisms.STATEMENTS,
    *critical_point.STATEMENTS,
    *parameters.STATEMENTS,
    *phase.STATEMENTS,
    *face.STATEMENTS,
    *waviness.STATEMENTS,
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
    from swtstudy.archive.archive import open_results
    from swtstudy.paper.audit.report import open_audit

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


_INTRODUCTION = """\
# What the paper says, checked

Every statement of E. Willert, Eng 2024, 5, 333–346 (doi:10.3390/eng5010018) that the archives in this
folder can test, in our words. The paper says "almost", "little" or "weak" where a test needs a bound: the
bounds are ours, given in the third column. A statement that does not hold is reported as such.

Made by `swtstudy check`.
"""

#: Widths of the columns on the terminal: place, statement, measured, verdict.
_NARROWEST, _PLACE, _VERDICT = 80, 11, 13


def verdict(outcome: Outcome) -> str:
    """Holds, does not hold, or not checked."""
    if outcome.finding is None:
        return "not checked"
    return "holds" if outcome.finding.holds else "does not hold"


def summary(outcomes: Sequence[Outcome]) -> str:
    """Number of statements that hold, do not hold, or were not checked, in words."""
    verdicts = [verdict(outcome) for outcome in outcomes]
    counts = {kind: verdicts.count(kind) for kind in ("holds", "does not hold", "not checked")}
    words = f"{len(outcomes)} statements: {counts['holds']} hold, {counts['does not hold']} do not"
    return words + (f", {counts['not checked']} not checked" if counts["not checked"] else "")


def terminal_table(outcomes: Iterable[Outcome], width: int) -> str:
    """The table as plain text of a given width in characters, without the criteria."""
    rest = max(width, _NARROWEST) - _PLACE - _VERDICT - 6
    widths = (_PLACE, rest * 2 // 5, rest - rest * 2 // 5, _VERDICT)
    rule = "  ".join("-" * column for column in widths)
    rows = [_row(("where", "the paper says", "measured", ""), widths), rule]
    for outcome in outcomes:
        statement = outcome.statement
        cells = (statement.place, statement.sentence, _measured(outcome), verdict(outcome))
        rows += [_row(cells, widths), ""]
    return "\n".join(rows)


def markdown(outcomes: Sequence[Outcome]) -> str:
    """The table as a Markdown file."""
    lines = [_INTRODUCTION, f"**{summary(outcomes)}.**", ""]
    lines += ["| Where | The paper says | Counts as holding if | Measured | |", "|---|---|---|---|---|"]
    for outcome in outcomes:
        statement = outcome.statement
        word = verdict(outcome)
        cells = (
            *map(_escaped, (statement.place, statement.sentence, statement.criterion, _measured(outcome))),
            word if word == "holds" else f"**{word}**",
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _escaped(cell: str) -> str:
    """A cell with Markdown's special characters escaped."""
    return cell.replace("|", "\\|").replace("*", "\\*")


def _measured(outcome: Outcome) -> str:
    return outcome.finding.measured if outcome.finding else outcome.problem.replace("\n", "; ")


def _row(cells: Sequence[str], widths: Sequence[int]) -> str:
    columns = [textwrap.wrap(cell, width) or [""] for cell, width in zip(cells, widths, strict=True)]
    height = max(map(len, columns))
    padded = [column + [""] * (height - len(column)) for column in columns]
    lines = zip(*padded, strict=True)
    return "\n".join(
        "  ".join(f"{part:<{width}}" for part, width in zip(line, widths, strict=True)).rstrip()
        for line in lines
    )
