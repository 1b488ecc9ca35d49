"""swtstudy list"""

from __future__ import annotations

from shutil import get_terminal_size
from typing import TYPE_CHECKING

import click

from swtstudy.cli.options import examples, on_terminal

if TYPE_CHECKING:
    from swtstudy.study.definition import Study


@click.command("list", epilog=examples("swtstudy list", "swtstudy run figure3"))
def list_studies() -> None:
    """List the studies of the paper.

    They come with the package; other commands accept their names as STUDY.
    """
    from swtstudy.study.definition import Study
    from swtstudy.study.shipped import in_groups, shipped_folder, shipped_studies

    studies = {name: Study.from_toml(path) for name, path in shipped_studies().items()}
    width = max(map(len, studies))
    columns = get_terminal_size().columns - 1 if on_terminal() else None
    for group, names in in_groups(studies).items():
        click.echo(group)
        for name in names:
            title = studies[name].title
            click.echo(cut(f"  {name:<{width}}  {_points(studies[name]):>12}  {title}", columns))
        click.echo()
    click.echo(f"files: {shipped_folder()}")


def _points(study: Study) -> str:
    """Number of points to be computed; those of random boxes are drawn."""
    from swtstudy.points.unique import LARGEST_GRID

    return "random" if study.grid.size > LARGEST_GRID else f"{study.grid.size} points"


def cut(line: str, columns: int | None) -> str:
    """A line no longer than so many columns, with an ellipsis where words are left out.

    Examples
    --------
    >>> cut("Figure 3: s over the phase", 12)
    'Figure 3: s…'
    """
    return line if columns is None or len(line) <= columns else f"{line[: columns - 1].rstrip()}…"
