"""swtstudy audit"""

from __future__ import annotations

import click

from swtstudy.cli.options import examples, study_completion


@click.command(epilog=examples("swtstudy audit figure3 --points 100"))
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...", shell_complete=study_completion)
@click.option("--points", default=1000, show_default=True, type=click.IntRange(1), help="Points to sample.")
@click.option("--seed", default=0, show_default=True, help="Seed of the random numbers.")
@click.option("--results", default="results", show_default=True, help="Folder for audit and report.")
@click.option("--workers", default=2, show_default=True, type=click.IntRange(1), help="Worker processes.")
@click.option(
    "--dense", is_flag=True, help="Look densely at the surface line, too: was a maximum overlooked?"
)
def audit(studies: tuple[str, ...], points: int, seed: int, results: str, workers: int, dense: bool) -> None:
    """Solve random points of each STUDY in the whole body and on all planes.

    Writes the audited points, and a report that says where the maximum is not on the surface line, where the
    solver looks for s. Points already audited are not audited again.
    """
    from swtstudy.archive.names import archive_paths
    from swtstudy.paper.audit import AUDIT_PREFIX
    from swtstudy.study.several import read_studies
    from swtstudy.vocabulary.files import check_writable, write_text

    defined = read_studies(studies)
    targets = archive_paths(defined, results, AUDIT_PREFIX)
    for target in targets.values():
        check_writable(target)

    from swtstudy.paper.audit.audit import audit_study
    from swtstudy.paper.audit.report import report

    for source, study in defined.items():
        target = targets[source]
        with click.progressbar(length=min(points, study.grid.size), label=source) as bar:
            dataset = audit_study(study, target, points, seed, workers, dense, progress=bar.update)
        text = report(dataset)
        write_text(target.with_suffix(".md"), text)
        click.echo(text)
        click.echo(f"{target}\n{target.with_suffix('.md')}")
