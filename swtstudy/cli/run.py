"""swtstudy run"""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("studies", nargs=-1, required=True, metavar="STUDY...")
@click.option("--results", default="results", show_default=True, help="Folder for archives and figures.")
@click.option(
    "--format",
    "formats",
    multiple=True,
    default=("png",),
    show_default=True,
    type=click.Choice(["png", "pdf", "svg"]),
    help="Format of the figure; may be given more than once.",
)
@click.option("--workers", default=2, show_default=True, type=click.IntRange(1), help="Worker processes.")
def run(studies: tuple[str, ...], results: str, formats: tuple[str, ...], workers: int) -> None:
    """Compute each STUDY (a TOML file), and leave its archive and its figure."""
    from swtstudy.archive.files import check_writable
    from swtstudy.study.definition import Study
    from swtstudy.study.several import read_studies

    defined: dict[str, Study] = read_studies(studies)
    targets = {source: Path(results) / f"{Path(source).stem}.nc" for source in defined}
    for target in targets.values():
        check_writable(target)

    from swtstudy.runner.run import run as run_study

    for source, study in defined.items():
        target = targets[source]
        dataset = run_study(study, target, workers=workers)
        seconds = dataset.attrs["wall_time_seconds"]
        worst = float((dataset.s_error / dataset.s).max())
        click.echo(f"{target}: {dataset.s.size} points in {seconds:.1f} s, relative error up to {worst:.1e}")
        if study.figure is not None:
            from swtstudy.figures.draw import draw
            from swtstudy.figures.save import save_figure

            figure = draw(dataset)
            for ending in formats:
                save_figure(figure, target.with_suffix(f".{ending}"))
                click.echo(str(target.with_suffix(f".{ending}")))
