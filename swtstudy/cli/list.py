"""swtstudy list"""

from __future__ import annotations

import click

from swtstudy.cli.examples import examples


@click.command("list", epilog=examples("swtstudy list", "swtstudy run figure3"))
def list_studies() -> None:
    """List the studies of the paper.

    They come with the package; other commands accept their names as STUDY.
    """
    from swtstudy.grid.unique import LARGEST_GRID
    from swtstudy.study.definition import Study
    from swtstudy.study.shipped import shipped_folder, shipped_studies

    studies = {name: Study.from_toml(path) for name, path in shipped_studies().items()}
    width = max(map(len, studies))
    for name, study in studies.items():
        size = study.grid.size
        points = "for swtstudy audit" if size > LARGEST_GRID else f"{size:11d} points"
        click.echo(f"{name:<{width}}  {points}  {study.title}")
    click.echo(f"files: {shipped_folder()}")
