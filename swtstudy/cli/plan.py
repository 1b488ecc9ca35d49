"""swtstudy plan"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swtstudy.cli.options import examples, study_completion

if TYPE_CHECKING:
    from swtstudy.points.records import Records
    from swtstudy.runner.work import Work
    from swtstudy.study.definition import Study


@click.command(epilog=examples("swtstudy plan figure3", "swtstudy plan mine.toml --workers 8"))
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...", shell_complete=study_completion)
@click.option("--results", default="results", show_default=True, help="Folder of the archives.")
@click.option("--workers", default=2, show_default=True, type=click.IntRange(1), help="Worker processes.")
def plan(studies: tuple[str, ...], results: str, workers: int) -> None:
    """Show what a run of each STUDY would compute, and how long it would take.

    A few points are computed to time them, loops of many vertices with fewer; nothing is written.
    """
    from swtstudy.archive.names import archive_paths
    from swtstudy.study.several import read_studies

    defined = read_studies(studies)
    targets = archive_paths(defined, results)
    for source, study in defined.items():
        for line in describe(study, targets[source], workers):
            click.echo(line)


def describe(study: Study, target: Path, workers: int) -> list[str]:
    """Describe in lines what a run would do."""
    from swtstudy.points.unique import loads
    from swtstudy.runner.work import assess

    work = assess(study, target)
    missing, todo = work.missing, work.todo
    grid, distinct = study.grid, len(missing)
    panels = study.figure.panels if study.figure else None
    count = len(grid.values(panels)) if panels else 1
    shared = int(missing.sum()) - loads(work.points.table[missing])
    return [
        study.title,
        f"  prescribed         {grid.control.name}",
        f"  archive            {target}{'' if target.exists() else ' (does not exist yet)'}",
        f"  points             {grid.size}" + (f" in {count} panels" if count > 1 else ""),
        *_quantities(study),
        f"  distinct points    {distinct} ({grid.size - distinct} saved by symmetry)",
        f"  already computed   {distinct - todo}",
        f"  to be computed     {todo} ({shared} of them share another's contact solution)",
        *_again(work),
        *(_time(work, study.rtol, workers) if todo else ()),
    ]


def _quantities(study: Study) -> Iterator[str]:
    from swtstudy.vocabulary.quantities import DISTANCE, distance_of

    if study.asked.items:
        unit = study.grid.row(DISTANCE).units.replace("1", "")
        asked = [f"{item} {unit}".strip() if distance_of(item) else item for item in study.asked.items]
        yield f"  quantities         {', '.join(asked)}"


def _again(work: Work) -> Iterator[str]:
    """Which of the points to be computed are known in part."""
    if work.incomplete.any():
        yield f"  without s          {int(work.incomplete.sum())} of them lack quantities alone"
    if work.outdated:
        yield f"  recomputed         {work.outdated} come from another version of the solver"
    if work.coarse:
        yield f"  recomputed         {work.coarse} are less accurate than the study asks for"


def _time(work: Work, rtol: float, workers: int) -> Iterator[str]:
    """Estimate the time of a run from a few points that are solved."""
    from swtstudy.points.cost import duration
    from swtstudy.runner.chunk import solve_points
    from swtstudy.runner.estimate import estimate
    from swtstudy.runner.pace import CHUNK_SECONDS

    timed: list[int] = []

    def count(found: Records) -> None:
        timed.append(len(found))

    seconds = sum(
        estimate(work.points, wanted, rtol, solve_points, count, asked) for wanted, asked in work.tasks()
    )
    of = f"{sum(timed)} point" + ("s" if sum(timed) > 1 else "")
    yield f"  chunks             about {min(max(1, round(seconds / CHUNK_SECONDS)), work.todo)}"
    yield (
        f"  time               about {duration(seconds / workers)} with {workers} workers "
        f"({1e3 * seconds / work.todo:.3g} ms a point, from {of} timed)"
    )
