"""Commands on studies that leave archives alone: new, validate, plan, list and schema."""

from __future__ import annotations

import os
from collections.abc import Iterator
from operator import attrgetter
from pathlib import Path
from typing import TYPE_CHECKING

import click

import swtstudy
from swtstudy.archive.paths import archive_paths
from swtstudy.cli import terminal
from swtstudy.study.shipped import in_groups, shipped_folder, shipped_studies
from swtstudy.vocabulary.files import check_writable, write_text
from swtstudy.vocabulary.mistakes import Report, literal, refused
from swtstudy.vocabulary.parameters import AXES, CONTACT_AXES, PARAMETERS, QUANTITY_AXES
from swtstudy.vocabulary.quantities import DISTANCE, NAMED
from swtstudy.vocabulary.wording import duration, number_of, unit_words

if TYPE_CHECKING:
    from swtstudy.points.grid import Grid
    from swtstudy.study.definition import Study

#: Sizes of so many contacts at rest are said at most.
MOST_CONTACTS = 10_000


@click.command()
@click.argument("name")
@click.option("--units", is_flag=True, help="A study of real contacts, in N, mm and MPa.")
def new(name: str, units: bool) -> None:
    """Write NAME.toml, a small commented study to start from.

    Beside it goes the schema that editors use to complete and check studies. An existing study is never
    replaced.

    \b
    Examples:
      swtstudy new mine
      swtstudy plan mine.toml
      swtstudy run mine.toml
    """
    from swtstudy.study.schema import SCHEMA_FILE, schema_text
    from swtstudy.study.template import template

    if Path(name).name in ("", ".toml"):
        raise refused("NAME", literal(name), "a name for the study, such as mine")
    target = Path(name if name.endswith(".toml") else f"{name}.toml")
    check_writable(target)
    if os.path.lexists(target):
        raise FileExistsError(f"{target} already exists; choose another name")
    write_text(target, template(target.stem.replace("_", " "), units))
    click.echo(str(target))
    schema = target.with_name(SCHEMA_FILE)
    if not schema.exists():
        write_text(schema, schema_text())
        click.echo(str(schema))
    terminal.say_next(f"swtstudy run {target}")


@click.command()
@terminal.with_studies
def validate(studies: tuple[str, ...]) -> None:
    """Check each STUDY (a TOML file) without computing anything.

    Says, too, which limits of the model points exceed, as far as their loads alone tell.

    \b
    Examples:
      swtstudy validate mine.toml
      swtstudy validate studies
    """
    from swtstudy.points.solve import foreseen_lines
    from swtstudy.study.definition import read_studies

    report = Report()
    defined = read_studies(studies, report)
    for source, study in defined.items():
        grid = study.grid
        sizes = " × ".join(f"{n} {name}" for name, n in grid.sizes.items())
        words = f"{source}: valid, {number_of(grid.size, 'point')}" + (f" = {sizes}" if sizes else "")
        with report:
            archive_paths([source], "")
            terminal.say(words, 2)
            if at_rest := rest_of(grid):
                terminal.say(f"contact at rest: {at_rest}", 2)
            for line in foreseen_lines(grid):
                click.echo(f"validity: {line}", err=True)
    report.refuse()


@click.command()
@terminal.with_studies
@click.option("--results", default="results", show_default=True, help="Folder of the archives.")
@terminal.with_workers
def plan(studies: tuple[str, ...], results: str, workers: int) -> None:
    """Show what a run of each STUDY would compute, and how long it would take.

    A few points are computed to time them, loops of many vertices with fewer; nothing is written.

    \b
    Examples:
      swtstudy plan figure3
      swtstudy plan mine.toml --workers 8
    """
    from swtstudy.study.definition import read_studies

    defined = read_studies(studies)
    targets = archive_paths(defined, results)
    for source, study in defined.items():
        terminal.say(study.title, 21)
        for label, words in describe(study, targets[source], workers):
            terminal.say(f"  {label:<19}{words}", 21)


def describe(study: Study, target: Path, workers: int) -> Iterator[tuple[str, str]]:
    """Describe a run in labels and words, with its time from a few points that are solved."""
    from swtstudy.archive.run import Work, estimate
    from swtstudy.points.solve import foreseen_lines

    work = Work(study, target)
    grid, distinct, todo = study.grid, len(work.found), int(work.todo.sum())
    count = len(grid.values(study.figure.panels)) if study.figure and study.figure.panels else 1
    panels = f" in {count} panels" if count > 1 else ""
    yield "prescribed", grid.control.name
    if at_rest := rest_of(grid):
        yield "contact at rest", at_rest
    yield from (("validity", line) for line in foreseen_lines(grid))
    yield "archive", f"{target}{'' if target.exists() else ' (does not exist yet)'}"
    yield "points", f"{grid.size}{panels}"
    if study.asked.items:
        unit = unit_words(grid.row(DISTANCE).units)
        asked = [item for item in study.asked.items if item != DISTANCE]
        asked += [f"{DISTANCE}={distance:.6g}{unit}" for distance in study.asked.distances]
        yield "quantities", ", ".join(asked)
    yield "distinct points", f"{distinct} ({grid.size - distinct} saved by symmetry)"
    yield "already computed", str(distinct - todo)
    yield "to be computed", str(todo)
    if work.incomplete.any():
        yield "incomplete", f"{int(work.incomplete.sum())} of them lack quantities"
    if work.outdated:
        yield "recomputed", f"{work.outdated} come from another version of the solver"
    if work.coarse:
        yield "recomputed", f"{work.coarse} are less accurate than the study asks for"
    if todo:
        seconds, timed, parts = estimate(work)
        each = f"{1e3 * seconds / todo:.3g} ms a point, from {number_of(timed, 'point')} timed"
        wall = duration(seconds / min(workers, parts))
        yield "time", f"about {wall} with {workers} workers ({each})"


def rest_of(grid: Grid) -> str:
    """Sizes of real contacts at rest, in words; empty without units, and for very many contacts."""
    import xarray as xr

    from swtstudy.archive.describe import TOLD_AT_REST, rest_words
    from swtstudy.study.units.grid import PhysicalGrid

    if not isinstance(grid, PhysicalGrid) or grid.at_rest.size > MOST_CONTACTS:
        return ""
    found = {name: grid.each(attrgetter(name)) for name in TOLD_AT_REST}
    units = {name: {"units": grid.labels.label(kind)} for name, kind in TOLD_AT_REST.items()}
    return rest_words({name: xr.DataArray(found[name], attrs=units[name]) for name in TOLD_AT_REST})


@click.command("list")
@click.option("--parameters", is_flag=True, help="List the parameters of a point, and what may be computed.")
@click.pass_context
def list_studies(context: click.Context, parameters: bool) -> None:
    """List the studies of the paper, or the parameters.

    The studies come with the package; other commands accept their names as STUDY.

    \b
    Examples:
      swtstudy list
      swtstudy list --parameters
      swtstudy run figure3
    """
    if parameters:
        formatter = context.make_formatter()
        for title, names in terminal.by_section((*PARAMETERS, *CONTACT_AXES)).items():
            with formatter.section(title):
                formatter.write_dl([(name, AXES[name].explained) for name in names])
        with formatter.section("Quantities beside s"):
            quantities = [(name, f"{row.meaning}.") for name, row in NAMED.items()]
            formatter.write_dl([*quantities, (DISTANCE, QUANTITY_AXES[DISTANCE].explained)])
        click.echo(formatter.getvalue(), nl=False)
        return
    from swtstudy.points.grid import LARGEST_GRID

    studies = {name: swtstudy.Study.from_toml(path) for name, path in shipped_studies().items()}
    width = max(map(len, studies))
    for group, names in in_groups(studies).items():
        click.echo(group)
        for name in names:
            size = studies[name].grid.size
            points = "random" if size > LARGEST_GRID else f"{size} points"  # random boxes are drawn
            terminal.say(f"  {name:<{width}}  {points:>12}  {studies[name].title}", indent=width + 18)
        click.echo()
    click.echo(f"files: {shipped_folder()}")


@click.command()
@click.option("--output", "-o", help="File for the schema; by default it is printed.")
def schema(output: str | None) -> None:
    """Write the JSON schema of study files.

    Editors that know TOML schemas (Even Better TOML in VS Code, Taplo) use it to complete, explain and check
    a study whose first line is "#:schema study.schema.json".

    \b
    Examples:
      swtstudy schema
      swtstudy schema -o study.schema.json
    """
    from swtstudy.study.schema import schema_text

    if output is None:
        click.echo(schema_text(), nl=False)
        return
    check_writable(output)
    write_text(output, schema_text())
    click.echo(output)
