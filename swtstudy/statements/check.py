"""Test every statement on the archives in a folder."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from swtstudy.statements import (
    critical_point,
    figure3,
    figure4,
    figure5,
    figure6,
    figure7,
    figure8,
    parameters,
)
from swtstudy.statements.select import NotInArchiveError
from swtstudy.statements.statement import Finding, Statement

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
        Folder with the archives of the suite, each named after its study.

    Returns
    -------
    list of Outcome
        One for each statement; those whose archives are missing have no finding.

    Raises
    ------
    swtstudy.archive.read.ArchiveError
        If a file is there that is not an archive.
    """
    from swtstudy.archive.read import open_results

    folder = Path(results)
    names = dict.fromkeys(name for statement in STATEMENTS for name in statement.studies)
    paths = {name: folder / f"{name}.nc" for name in names}
    archives = {name: open_results(path) for name, path in paths.items() if path.is_file()}
    outcomes = []
    for statement in STATEMENTS:
        missing = [str(paths[name]) for name in statement.studies if name not in archives]
        if missing:
            outcomes.append(Outcome(statement, None, f"missing: {', '.join(missing)}"))
            continue
        try:
            finding = statement.test(*(archives[name] for name in statement.studies))
        except NotInArchiveError as error:
            sources = ", ".join(str(paths[name]) for name in statement.studies)
            outcomes.append(Outcome(statement, None, f"{sources}: {error}"))
        else:
            outcomes.append(Outcome(statement, finding))
    return outcomes


def missing_studies(results: str | PathLike[str] = "results") -> list[str]:
    """Names of the studies whose archives are not in a folder."""
    names = dict.fromkeys(name for statement in STATEMENTS for name in statement.studies)
    return [name for name in names if not (Path(results) / f"{name}.nc").is_file()]
