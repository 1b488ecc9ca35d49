"""Archives as pages: one, or several with a page that lists them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from html import escape
from os import PathLike
from pathlib import Path
from urllib.parse import quote

import xarray as xr

from swtstudy.archive.archive import open_results
from swtstudy.archive.paths import ArchiveError
from swtstudy.reports.findings import sentences
from swtstudy.reports.page import page
from swtstudy.reports.parts import Picture, thumbnail, whole
from swtstudy.runner.workers import LocalPool
from swtstudy.study.shipped import in_groups
from swtstudy.vocabulary.files import check_writable, write_text
from swtstudy.vocabulary.mistakes import Mistake, StudyError
from swtstudy.vocabulary.version import __version__

#: The page that lists the others.
INDEX = "index.html"
_PAGES = (".html", ".htm")
#: So many archives are worth the seconds that processes take to begin.
_SEVERAL = 4


@dataclass(frozen=True)
class Entry:
    """An archive in a list of several.

    Attributes
    ----------
    name
        Its name without the ending.
    title
        Title of its study.
    sentence
        What matters most in it, HTML.
    picture
        A thumbnail; None for a study without a figure.
    """

    name: str
    title: str
    sentence: str
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
    if output is not None and not _is_folder(output) and Path(output).suffix.lower() not in _PAGES:
        raise StudyError([Mistake("--output", str(output), "a file that ends with .html, or a folder")])
    if len(paths) > 1 or (output is not None and _is_folder(output)):
        yield from _write_several(paths, _checked_folder(paths, output), workers)
        return
    target = paths[0].with_suffix(".html") if output is None else Path(output)
    check_writable(target)
    write_text(target, page(open_results(paths[0]), paths[0].stem))
    yield target, ""


def _write_several(paths: Sequence[Path], folder: Path, workers: int) -> Iterator[tuple[Path, str]]:
    """A page for each archive, and one that lists them; see `write_reports`."""
    entries: list[Entry] = []
    problems: list[ArchiveError] = []
    for path, made in zip(paths, _made(paths, folder, workers), strict=True):
        if isinstance(made, ArchiveError):
            problems.append(made)
            yield path, str(made)
            continue
        entries.append(made)
        yield folder / f"{path.stem}.html", ""
    if not entries:
        raise problems[0]
    write_text(folder / INDEX, listing(entries))
    yield folder / INDEX, ""


def _made(paths: Sequence[Path], folder: Path, workers: int) -> Iterator[Entry | ArchiveError]:
    """Write the page of each archive, one after another or side by side."""
    if workers < 2 or len(paths) < _SEVERAL:
        yield from (_write_one(path, folder) for path in paths)
        return
    with LocalPool(workers) as pool:
        for task in [pool.submit(_write_one, path, folder) for path in paths]:
            yield task.result()


def _write_one(path: Path, folder: Path) -> Entry | ArchiveError:
    """The page of an archive in a folder of several; returns its entry, or what is wrong with the file."""
    try:
        dataset = open_results(path)
    except ArchiveError as error:
        return error
    write_text(folder / f"{path.stem}.html", page(dataset, path.stem, INDEX))
    return entry(dataset, path.stem)


def entry(dataset: xr.Dataset, name: str) -> Entry:
    """Summarise an archive for a list."""
    picture = thumbnail(dataset) if "figure" in dataset.attrs else None
    return Entry(name, str(dataset.attrs["title"]), next(iter(sentences(dataset)), ""), picture)


def listing(entries: Sequence[Entry]) -> str:
    """The page that lists archives: a picture and a sentence of each, in groups."""
    body = f"""<header class="top">
<p class="kicker">swtstudy</p>
<h1>{len(entries)} parameter {"study" if len(entries) == 1 else "studies"}</h1>
<p class="lead">Smith–Watson–Topper parameter in frictional contacts: where a crack begins, how soon, and
which load is the kindest. Each picture leads to a report.</p>
</header>
<main>
{gallery_of(entries, lambda name: quote(f"{name}.html"))}
</main>
<footer>Made by swtstudy {escape(__version__)}.</footer>"""
    return whole("Parameter studies", body)


def gallery_of(entries: Sequence[Entry], address: Callable[[str], str]) -> str:
    """Cards in groups, as HTML; each leads to the address of its name."""
    own = {each.name: each for each in entries}
    groups = in_groups(own)
    parts = []
    for title, names in groups.items():
        cards = "\n".join(_card(own[name], address(name)) for name in names)
        heading = f"<h2>{escape(title)}</h2>\n" if len(groups) > 1 else ""
        parts.append(f'<section>\n{heading}<ul class="gallery">\n{cards}\n</ul>\n</section>')
    return "\n".join(parts)


def _card(one: Entry, address: str) -> str:
    image = ""
    if one.picture:
        image = f'<img src="{one.picture.source}" {one.picture.size} alt="" loading="lazy">'
    words = f'<span class="name">{escape(one.title)}</span><p>{one.sentence}</p>'
    return f'<li><a href="{escape(address)}"><div class="frame">{image}</div>{words}</a></li>'


def _is_folder(output: str | PathLike[str]) -> bool:
    path = os.fspath(output)
    return Path(path).is_dir() or not Path(path).suffix or path.endswith(("/", os.sep))


def _checked_folder(paths: Sequence[Path], output: str | PathLike[str] | None) -> Path:
    """The folder for several pages, with room for each."""
    mistakes = []
    names = [path.stem for path in paths]
    for name in dict.fromkeys(names):
        same = [str(path) for path in paths if path.stem == name]
        if len(same) > 1:
            mistakes.append(Mistake("ARCHIVE", ", ".join(same), "names that differ: each has a page"))
        if f"{name}.html" == INDEX:
            mistakes.append(Mistake("ARCHIVE", same[0], f"another name: {INDEX} lists the others"))
    if output is None:
        mistakes.append(Mistake("--output", "nothing", f"a folder for {len(paths)} pages, such as -o site/"))
    elif not _is_folder(output) or Path(output).is_file():
        mistakes.append(Mistake("--output", str(output), f"a folder for {len(paths)} pages"))
    if mistakes or output is None:
        raise StudyError(mistakes)
    check_writable(Path(output) / INDEX)
    return Path(output)
