"""Archives as pages: one, or several with a page that lists them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack
from functools import partial
from os import PathLike
from pathlib import Path
from typing import NamedTuple
from urllib.parse import quote

import xarray as xr
from markupsafe import Markup

from swtstudy.archive.archive import open_results
from swtstudy.archive.paths import ArchiveError
from swtstudy.archive.workers import LocalPool
from swtstudy.faces.findings import sentences
from swtstudy.faces.html import rendered
from swtstudy.faces.page import Picture, page, thumbnail
from swtstudy.study.shipped import in_groups
from swtstudy.vocabulary.files import check_writable, write_text
from swtstudy.vocabulary.mistakes import Report
from swtstudy.vocabulary.version import __version__

#: The page that lists the others.
INDEX = "index.html"
#: So many archives are worth the seconds that processes take to begin.
_SEVERAL = 4


class Entry(NamedTuple):
    """An archive in a list of several.

    Attributes
    ----------
    name
        Its name without the ending.
    title
        Title of its study.
    sentence
        The headline, HTML.
    picture
        A thumbnail; None for a study without a figure.
    """

    name: str
    title: str
    sentence: Markup
    picture: Picture | None


def write_reports(
    archives: Sequence[str | PathLike[str]], output: str | PathLike[str] | None = None, workers: int = 2
) -> Iterator[tuple[Path, str]]:
    """Write a page for each archive, and one that lists them if there are several.

    Parameters
    ----------
    archives
        Their paths.
    output
        The HTML file of a single archive, by default beside it, or a folder for the pages.
    workers
        Processes that make the pages of several archives; with 1 this one does.

    Yields
    ------
    pathlib.Path
        A file that has been written, or an archive that has been left out.
    str
        Why it has been left out; empty for a file.

    Raises
    ------
    StudyError
        A ValueError with everything that is wrong with the paths, before anything is written.
    ArchiveError
        A ValueError, if none of the files is an archive.
    """
    paths = [Path(each) for each in archives]
    report, place = Report(), "" if output is None else os.fspath(output)
    of_folder = Path(place).is_dir() or not Path(place).suffix or place.endswith(("/", os.sep))
    is_folder = output is not None and of_folder
    several = len(paths) > 1 or is_folder
    names = [path.stem for path in paths]
    for name in dict.fromkeys(names) if several else ():
        same = [str(path) for path in paths if path.stem == name]
        if len(same) > 1:
            report("ARCHIVE", ", ".join(same), "names that differ: each has a page")
        if f"{name}.html" == INDEX:
            report("ARCHIVE", same[0], f"another name: {INDEX} lists the others")
    if several and (not is_folder or Path(place).is_file()):
        report("--output", place or "nothing", f"a folder for {len(paths)} pages, such as -o site/")
    elif place and not is_folder and Path(place).suffix.lower() not in (".html", ".htm"):
        report("--output", place, "a file that ends with .html, or a folder")
    report.refuse()
    target = paths[0].with_suffix(".html") if output is None else Path(output)
    check_writable(target / INDEX if several else target)
    if several:
        yield from _write_several(paths, target, workers)
    else:
        write_text(target, page(open_results(paths[0]), paths[0].stem))
        yield target, ""


def _write_several(paths: Sequence[Path], folder: Path, workers: int) -> Iterator[tuple[Path, str]]:
    """A page for each archive, and one that lists them; see `write_reports`."""
    entries: list[Entry] = []
    problems: list[ArchiveError] = []
    with ExitStack() as stack:
        pages: list[Callable[[], Entry]] = [partial(_write_one, path, folder) for path in paths]
        if workers > 1 and len(paths) >= _SEVERAL:
            pool = stack.enter_context(LocalPool(workers))
            pages = [pool.submit(_write_one, path, folder).result for path in paths]
        for path, made in zip(paths, pages, strict=True):
            try:
                entries.append(made())
            except ArchiveError as error:
                problems.append(error)
                yield path, str(error)
            else:
                yield folder / f"{path.stem}.html", ""
    if problems and not entries:
        raise problems[0]
    write_text(folder / INDEX, listing(entries))
    yield folder / INDEX, ""


def _write_one(path: Path, folder: Path) -> Entry:
    """The page of an archive in a folder of several; returns its entry."""
    dataset = open_results(path)
    write_text(folder / f"{path.stem}.html", page(dataset, path.stem, INDEX))
    return entry(dataset, path.stem)


def entry(dataset: xr.Dataset, name: str) -> Entry:
    """Summarise an archive for a list."""
    picture = thumbnail(dataset) if "figure" in dataset.attrs else None
    return Entry(name, str(dataset.attrs["title"]), sentences(dataset)[0], picture)


def listing(entries: Sequence[Entry]) -> str:
    """The page that lists archives: a picture and a sentence of each, in groups."""
    gallery = Markup(gallery_of(entries, lambda name: quote(f"{name}.html")))
    count, title = len(entries), "Parameter studies"
    return rendered("list.html", title=title, count=count, gallery=gallery, version=__version__)


def gallery_of(entries: Sequence[Entry], address: Callable[[str], str]) -> str:
    """Cards in groups, as HTML; each leads to the address of its name."""
    own = {each.name: each for each in entries}
    groups = {group: [(own[n], address(n)) for n in names] for group, names in in_groups(own).items()}
    return rendered("gallery.html", groups=groups)
