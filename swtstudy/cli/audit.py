"""swtstudy audit"""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...")
@click.option("--points", default=1000, show_default=True, type=click.IntRange(1), help="Points to sample.")
@click.option("--seed", default=0, show_default=True, help="Of the random numbers.")
@click.option("--results", default="results", show_default=True, help="Folder for the tables.")
@click.option("--workers", default=2, show_default=True, type=click.IntRange(1), help="Worker processes.")
def audit(studies: tuple[str, ...], points: int, seed: int, results: str, workers: int) -> None:
    """Solve random points of each STUDY in the whole body and for all planes.

    Leaves a table and says where the maximum is not on the surface line, on which s is looked for.
    """
    from swtstudy.archive.files import check_writable
    from swtstudy.study.several import read_studies

    defined = read_studies(studies)
    targets = {source: Path(results) / f"audit_{Path(source).stem}.csv" for source in defined}
    for target in targets.values():
        check_writable(target)

    from swtstudy.audit.audit import audit_study
    from swtstudy.audit.table import summary, write_table

    for source, study in defined.items():
        with click.progressbar(length=min(points, study.grid.size), label=source) as bar:
            dataset = audit_study(study, points, seed, workers, progress=bar.update)
        write_table(dataset, targets[source])
        click.echo(str(targets[source]))
        for line in summary(dataset):
            click.echo(line)
