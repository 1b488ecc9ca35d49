"""Commands that say what matters, and check: sensitivity, fit, check and audit."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import click

import swtstudy
from swtstudy.archive.paths import archive_paths
from swtstudy.cli import terminal
from swtstudy.study.shipped import find_study, shipped_studies
from swtstudy.vocabulary.files import check_writable, write_text
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.wording import number_words, unit_words


@click.command()
@terminal.with_study
@click.option(
    "--y", multiple=True, help="A data variable; repeat for more.  [default: s, or such as SWT with units]"
)
@terminal.with_confidence
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Seed of the bootstrap.")
@terminal.with_results
@terminal.with_width
@terminal.with_workers
def sensitivity(
    study: str, y: tuple[str, ...], confidence: float, seed: int, results: str, width: Any, workers: int
) -> None:
    """Show which sampled parameters of STUDY matter: Sobol indices.

    The sample of STUDY has the design "saltelli". Points that are not computed yet are computed as
    by swtstudy run. Writes a table, a bar chart, and the indices as netCDF, beside the archive:
    NAME_indices, or NAME_indices_Y.

    \b
    Examples:
      swtstudy sensitivity sensitivity
    """
    from swtstudy.figures.statistics import draw_sensitivity
    from swtstudy.figures.style import save_figure
    from swtstudy.results.sensitivity import check_design

    one, file = swtstudy.Study.from_toml(study), find_study(study)
    check_design(one.design.name if one.design else None, study)
    target = archive_paths([study], results)[study]
    stem = "_".join((target.stem, "indices", *(re.sub(r"\W+", "_", each) for each in y)))
    targets = {end: target.with_name(f"{stem}{end}") for end in (".nc", ".md", ".png")}
    check_writable(target, *targets.values())

    from swtstudy.archive.archive import save
    from swtstudy.paper.markdown import table

    indices = swtstudy.sensitivity(swtstudy.run(one, target, workers=workers), y, confidence, seed)
    text = table(indices, file.resolve() in map(Path.resolve, shipped_studies().values()))
    save(indices, targets[".nc"])
    write_text(targets[".md"], text)
    save_figure(draw_sensitivity(indices, width=width), targets[".png"])
    click.echo(terminal.of_markdown(text, terminal.line_length()))
    click.echo("\n".join(map(str, (target, *targets.values()))))


#: The lives that are fitted unless others are named.
FITTED = "cycles_volume"


@click.command()
@terminal.with_study
@click.argument("tests")
@click.option("--y", default=FITTED, show_default=True, help="Which lives: cycles_volume, _point or _line.")
@click.option("--friction", is_flag=True, help="Fit friction, too.")
@terminal.with_confidence
@terminal.with_results
@terminal.with_width
def fit(study: str, tests: str, y: str, friction: bool, confidence: float, results: str, width: Any) -> None:
    """Fit the critical distance, and friction, to the lives of TESTS.

    STUDY is a study file with units and the constants of the material: what all tests have in common. TESTS
    is a CSV file with a row for each test: parameters, in the units of the study, and life, the load cycles
    to a crack; of a run-out the cycles that it survived, as >1e7 or with 1 in a column runout. Maximum
    likelihood of the logarithms of the lives. Writes the fit as netCDF and the figure of predicted over
    observed lives: NAME_fit, with --friction NAME_fit_friction, of cycles_point NAME_fit_point.

    \b
    Examples:
      swtstudy fit rig.toml tests.csv
    """
    from swtstudy.archive.archive import save
    from swtstudy.figures.statistics import draw_fit, fit_lines
    from swtstudy.figures.style import save_figure

    mean = "" if y == FITTED else f"_{y.replace('cycles_', '')}"
    stem = f"{Path(study).stem}_fit{mean}{'_friction' * friction}"
    targets = {end: Path(results) / f"{stem}{end}" for end in (".nc", ".png")}
    check_writable(*targets.values())
    found = swtstudy.fit(study, tests, y=y, friction=friction, confidence=confidence)
    save(found, targets[".nc"])
    save_figure(draw_fit(found, width=width), targets[".png"])
    for line in fit_lines(found):
        terminal.say(line)
    click.echo("\n".join(map(str, targets.values())))


#: Commands that make everything to be checked: audits are not part of the suite.
EVERYTHING = (
    "swtstudy run --all && swtstudy audit parameter_box && swtstudy audit figure3 figure4 --points 100"
)


@click.command()
@click.option("--results", default="results", show_default=True, help="Folder with the archives.")
@click.option("--output", "-o", help="Markdown file for the table; by default statements.md in that folder.")
def check(results: str, output: str | None) -> None:
    """Test what the paper says on the archives of its studies.

    Prints a table of the statements with what was measured, and writes it to a Markdown file. The exit code
    is 0 if every statement was checked, whether or not it holds; 2, without a file, if archives are missing
    or have gaps.

    \b
    Examples:
      swtstudy run --all
      swtstudy audit parameter_box
      swtstudy audit figure3 figure4 --points 100
      swtstudy check
    """
    from swtstudy.paper.statements import check as check_statements
    from swtstudy.paper.statements import markdown, summary

    target = Path(output) if output else Path(results) / "statements.md"
    outcomes = check_statements(results)
    rows = [
        (each.statement.place, f"{each.statement.sentence}\n", each.measured, each.verdict)
        for each in outcomes
        if each.holds is not None
    ]
    width, head = max(terminal.line_length() or 120, 80), ("where", "the paper says", "measured", "")
    click.echo(terminal.table(rows, width, head))
    click.echo(summary(outcomes))
    problems = dict.fromkeys(line for each in outcomes for line in each.problem.splitlines())
    if problems:
        raise ValueError("\n".join([*problems, f"all of them: {EVERYTHING}"]))
    check_writable(target)
    write_text(target, markdown(outcomes))
    click.echo(str(target))


@click.command()
@terminal.with_studies
@click.option("--points", default=1000, show_default=True, type=click.IntRange(1), help="Points to sample.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Seed of random numbers.")
@terminal.with_results
@terminal.with_workers
@click.option(
    "--dense", is_flag=True, help="Look densely at the surface line, too: was a maximum overlooked?"
)
def audit(studies: tuple[str, ...], points: int, seed: int, results: str, workers: int, dense: bool) -> None:
    """Solve random points of each STUDY in the whole body and on all planes.

    Writes the audited points, and a report that says where the maximum is not on the surface line, where the
    solver looks for s. Points already audited are not audited again.

    \b
    Examples:
      swtstudy audit figure3 --points 100
    """
    from swtstudy.paper.audit import AUDIT_PREFIX
    from swtstudy.study.definition import read_studies

    defined = read_studies(studies)
    targets = archive_paths(defined, results, AUDIT_PREFIX)
    check_writable(*targets.values())

    from swtstudy.paper.markdown import report

    for source, study in defined.items():
        target = targets[source]
        text = report(swtstudy.audit_study(study, target, points, seed, workers, dense))
        write_text(target.with_suffix(".md"), text)
        click.echo(terminal.of_markdown(text, terminal.line_length()))
        click.echo(f"{target}\n{target.with_suffix('.md')}")


@click.command()
@terminal.with_study
@click.argument("file")
@click.option("--order", help="Order of components with other headers: swtstudy, abaqus or ansys.")
@click.option("--column", multiple=True, metavar="NAME=HEADER", help="A column with another header; repeat.")
@click.option("--encoding", help="Encoding of FILE, such as cp1252.  [default: UTF-8]")
@click.option("--unit", help="Unit of the stresses, unless FILE says it.  [default: that of STUDY]")
@click.option("--body", default=1, show_default=True, type=click.IntRange(1, 2), help="Whose properties.")
@click.option(
    "--output", "-o", help="CSV, .vtu (ParaView) or .nc file; by default NAME_lives.csv beside FILE."
)
def history(
    study: str,
    file: str,
    order: str | None,
    column: tuple[str, ...],
    encoding: str | None,
    unit: str | None,
    body: int,
    output: str | None,
) -> None:
    """Evaluate the stress histories in FILE, as from finite elements: criteria, critical planes and lives.

    FILE is a table with a row for each point and step of one load cycle: id or x, y, z or both, step, and six
    stress components, such as S11, SXY or sigma_xy. STUDY is a study file with units, young_modulus and
    poisson_ratio; its [material] gives lives, its normal_sensitivity the criteria of Fatemi and Socie and of
    Findley.

    \b
    Examples:
      swtstudy history rig.toml stresses.csv -o lives.vtu
      swtstudy history rig.toml stresses.csv --column step=Time --column id=Point
    """
    from swtstudy.faces.elements import ENDINGS, write_history
    from swtstudy.study.definition import tables_of
    from swtstudy.study.units.rows import KNOWN

    target = Path(output) if output else Path(file).with_name(f"{Path(file).stem}_lives.csv")
    if target.suffix not in ENDINGS:
        raise refused("output", str(target), f"a file that ends with {', '.join(ENDINGS)}")
    check_writable(target)
    tables_of(study)  # wrong or not, it is told before a large table is read
    columns = terminal.pairs("--column", column, "a name and a header, such as step=Frame")
    read = swtstudy.read_history(file, order=order, columns=columns, encoding=encoding)
    if unit is not None:
        if unit not in KNOWN["stress"]:
            raise refused("--unit", literal(unit), f"one of {', '.join(KNOWN['stress'])}")
        read.stress.attrs.setdefault("units", unit)
    found = swtstudy.evaluate_history(read, study, body)
    write_history(found, target)
    for name, lives in (("SWT", "cycles"), ("FS", "FS_cycles"), ("findley_stress", "findley_usage")):
        if name in found:
            at = found.isel(point=int(found[name].values.argmax()))
            unit = unit_words(at[name].attrs.get("units", ""))
            words = f"largest {name} = {number_words(float(at[name]))}{unit}"
            words += f", {lives} = {number_words(float(at[lives]), 3)}" if lives in found else ""
            here = {each: at[each].item() for each in ("id", *"xyz") if each in at.coords}
            places = [f"{n} = {v if n == 'id' else number_words(v)}" for n, v in here.items()]
            terminal.say(f"{words} at {', '.join(places) or 'the only point'}")
        if line := found[lives].attrs.get("validity") if lives in found else None:
            terminal.say(f"{line}.")
    click.echo(str(target))
