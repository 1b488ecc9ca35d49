"""The outcomes as a table: for the terminal, and as a Markdown file."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

from swtstudy.paper.statements.check import Outcome

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
