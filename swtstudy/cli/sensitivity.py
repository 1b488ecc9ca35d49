"""swtstudy sensitivity"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from swtstudy.cli.options import examples, study_completion, with_width


@click.command(epilog=examples("swtstudy sensitivity sensitivity"))
@click.argument("study", shell_complete=study_completion)
@click.option(
    "--y", multiple=True, default=("s",), show_default=True, help="A data variable; repeat for more."
)
@click.option("--confidence", default=0.95, show_default=True, help="Level of the confidence intervals.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0), help="Seed of the bootstrap.")
@click.option(
    "--results", default="results", show_default=True, help="Folder for archive, indices and figure."
)
@with_width
@click.option("--workers", default=2, show_default=True, type=click.IntRange(1), help="Worker processes.")
def sensitivity(
    study: str, y: tuple[str, ...], confidence: float, seed: int, results: str, width: Any, workers: int
) -> None:
    """Show which sampled parameters of STUDY matter: Sobol indices.

    The sample of STUDY has the design "saltelli". Points that are not computed yet are computed as
    by swtstudy run. Writes a table, a bar chart, and the indices as netCDF, beside the archive:
    NAME_indices.
    """
    from swtstudy.archive.names import archive_paths
    from swtstudy.study.several import read_studies
    from swtstudy.vocabulary.files import check_writable, write_text

    defined = read_studies([study])
    if len(defined) > 1:
        raise ValueError(f"{study}: found {len(defined)} studies; allowed: one")
    (source, one), *_ = defined.items()
    design = one.sample.design if one.sample else None
    if design is None or design.name != "saltelli":
        found = f"the design {design.name}" if design else "no design"
        raise ValueError(
            f'{source}: sample.design: found {found}; allowed: "saltelli": Sobol indices need its points'
        )
    target = archive_paths(defined, results)[source]
    targets = {end: target.with_name(f"{target.stem}_indices{end}") for end in (".nc", ".md", ".png")}
    for path in (target, *targets.values()):
        check_writable(path)

    from swtstudy.archive.write import save
    from swtstudy.figures.bars import draw_sensitivity
    from swtstudy.figures.save import save_figure
    from swtstudy.paper.statements.influence import table
    from swtstudy.results.sensitivity import sensitivity as indices_of
    from swtstudy.runner.run import run
    from swtstudy.study.shipped import shipped_studies

    indices = indices_of(run(one, target, workers=workers), y, confidence, seed)
    text = table(indices, Path(source).resolve() in map(Path.resolve, shipped_studies().values()))
    save(indices, targets[".nc"])
    write_text(targets[".md"], text)
    save_figure(draw_sensitivity(indices, width=width), targets[".png"])
    click.echo(text)
    for path in (target, *targets.values()):
        click.echo(str(path))
