"""Commands on results: report, plot, info and merge."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import click

import swtstudy
from swtstudy.archive.paths import check_archive_path, locked
from swtstudy.cli import terminal
from swtstudy.vocabulary.choices import FIGURES
from swtstudy.vocabulary.files import check_writable
from swtstudy.vocabulary.mistakes import literal, refused
from swtstudy.vocabulary.wording import number_of, place_words


@click.command()
@terminal.with_archives
@click.option(
    "--output", "-o", help="HTML file, by default beside the archive; of several archives a folder."
)
@terminal.with_workers
def report(archives: tuple[str, ...], output: str | None, workers: int) -> None:
    """Write an HTML page about each ARCHIVE, to send to people without Python.

    A page needs no other file and no network: what matters in a sentence, the figure with its values, slices,
    extrema, the best and the worst point, settings, errors, a CSV file, and how to make it again.

    Several archives also get a page that lists them. Files that are no archives are left out.

    \b
    Examples:
      swtstudy report results/figure3.nc
      swtstudy report results/figure3.nc -o to_send.html
      swtstudy report results/*.nc -o site/
    """
    from swtstudy.faces.site import write_reports

    for path, problem in write_reports(archives, output, workers):
        click.echo(problem or str(path), err=bool(problem))


@click.command()
@terminal.with_archive
@click.option("--output", "-o", help="PNG, PDF or SVG file; by default a PNG beside the archive.")
@terminal.with_style
@terminal.with_width
@click.option("--x", help="The axis along the horizontal axis.")
@click.option("--hue", help="The axis whose values are the lines.")
@click.option("--panels", help="The axis whose values are the panels.")
@click.option("--vertical", help="The axis along the vertical axis of contours and heat maps.")
@click.option("--kind", help=f"{', '.join(FIGURES)}.  [default: lines]")
@click.option(
    "--y", multiple=True, help="What is drawn, such as s, critical_x or regime; repeat for more rows."
)
@click.option(
    "--at", multiple=True, metavar="AXIS=VALUE", help="Draw an axis at one value; repeat for more axes."
)
@click.option("--title", help="A title over the figure.")
@click.option("--regimes", is_flag=True, default=None, help="Mark where a regime of the contact begins.")
@click.option(
    "--validity", is_flag=True, default=None, help="Mark what is outside of what the model holds for."
)
def plot(
    archive: str, output: str | None, style: str | None, width: Any, at: tuple[str, ...], **own: Any
) -> None:
    """Draw a figure of an ARCHIVE, from the archive alone.

    Values of --at are written as in a study file, such as --at friction=0.6; the title says them. With --x
    the options alone define the layout; without it they change the layout stored in the archive.

    \b
    Examples:
      swtstudy plot results/figure3.nc --width column -o figure3.pdf
      swtstudy plot results/figure3.nc --y critical_x --y regime
      swtstudy plot results/figure4.nc --at normal_amplitude=0.75
      swtstudy plot results/contour.nc --kind heatmap --y critical_angle
    """
    import numpy as np

    from swtstudy.figures.draw import draw, layout_of
    from swtstudy.figures.style import save_figure
    from swtstudy.results.evaluate import quantity
    from swtstudy.study.figure import FigureLayout
    from swtstudy.vocabulary.quantities import MISSING

    target = Path(output) if output else Path(archive).with_suffix(".png")
    dataset = swtstudy.open_results(archive)
    check_writable(target)
    if at:
        places = terminal.pairs("--at", at, "an axis and a value, such as friction=0.6")
        dataset = dataset.swt.slice(**places)
        words = (place_words(name, dataset[name].item(), dataset[name].attrs) for name in places)
        own["title"] = own["title"] or ",  ".join(words)
    given = {key: value for key, value in own.items() if value not in (None, ())}
    layout = FigureLayout(**given) if own["x"] else replace(layout_of(dataset), **given)
    save_figure(draw(dataset, layout, style, width), target, style)
    for y in layout.y:
        if not np.isfinite(quantity(dataset, y)).any():
            click.echo(f"{archive}: {y} is finite at no point of the figure", err=True)
    missing = int((dataset.status == MISSING).sum())
    if missing:
        click.echo(f"{archive}: {missing} of {dataset.s.size} points are missing", err=True)
    click.echo(str(target))


@click.command()
@terminal.with_archive
def info(archive: str) -> None:
    """Describe an ARCHIVE.

    Shows its study and versions, how complete and how accurate it is.

    \b
    Examples:
      swtstudy info results/figure3.nc
    """
    from swtstudy.archive.describe import INDENT, describe
    from swtstudy.archive.parts import kept_folder, parts_folder, points_saved

    for line in describe(swtstudy.open_results(archive)):
        terminal.say(line, INDENT)
    if saved := points_saved(parts_folder(Path(archive))):
        click.echo(f"  unfinished     {saved} distinct points are saved by an unfinished run")
    folder = kept_folder(Path(archive))
    if kept := points_saved(folder):
        click.echo(f"  kept           {kept} distinct points of other studies are in {folder}")


@click.command()
@terminal.with_archives
@click.option("--output", "-o", required=True, help="File for the merged archive.")
@click.option(
    "--sparse", is_flag=True, help="Allow points that are in none of the archives; they are missing."
)
def merge(archives: tuple[str, ...], output: str, sparse: bool) -> None:
    """Merge several ARCHIVEs into one.

    Along every axis the merged grid has the values of all archives. Points of it that are in none of them
    are refused without --sparse; contradictory values are always refused. If the merged archive replaces one
    that has more, the rest is kept in a folder beside it.

    \b
    Examples:
      swtstudy merge results/a.nc results/b.nc -o results/both.nc
    """
    from swtstudy.archive.archive import known_points, save
    from swtstudy.archive.merge import merge as merge_archives
    from swtstudy.archive.parts import keeping, kept_folder, parts_folder
    from swtstudy.archive.recall import grid_of, request_of
    from swtstudy.archive.run import not_in
    from swtstudy.points.grid import Distinct
    from swtstudy.vocabulary.quantities import MISSING

    target = Path(output)
    check_archive_path(target)
    if target.suffix != ".nc":
        raise refused("--output", literal(output), "a file that ends with .nc")
    check_writable(target)
    with locked(parts_folder(target)):
        before = known_points(target)
        dataset = merge_archives([Path(archive) for archive in archives], sparse)
        asked = request_of(dataset)
        dropped = not_in(Distinct.of(grid_of(dataset), asked), asked, before)
        with keeping(kept_folder(target), dropped):
            save(dataset, target)
    missing = int((dataset.status == MISSING).sum())
    click.echo(f"{target}: {number_of(dataset.s.size, 'point')}, {missing} of them missing")
    if len(dropped):
        click.echo(f"{len(dropped)} points of before are kept in {kept_folder(target)}", err=True)
