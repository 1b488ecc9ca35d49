"""Every study with its figure, and the pictures of scripts."""

from collections.abc import Collection
from pathlib import Path

from swtstudy import open_results
from swtstudy.faces.site import entry, gallery_of
from swtstudy.figures.draw import layout_of
from swtstudy.study.shipped import in_groups, shipped_studies


def results_of(root: Path) -> dict[str, Path]:
    """The archives of the studies that come with the package, by their names."""
    paths = {name: root / "results" / f"{name}.nc" for name in shipped_studies()}
    return {name: path for name, path in paths.items() if path.is_file()}


def gallery(root: Path, reported: Collection[str]) -> str:
    """Cards of all studies in groups, then the figure of each in full, then the pictures of scripts.

    Parameters
    ----------
    root
        The project's folder.
    reported
        The studies whose reports are beside the pages; a card leads there, that of another to its figure.
    """
    results = {name: open_results(path) for name, path in results_of(root).items()}
    entries = [entry(dataset, name) for name, dataset in results.items()]
    cards = gallery_of(entries, lambda name: _report(name) if name in reported else _target(name))
    parts = [f"```{{raw}} html\n{cards}\n```\n"]
    for group, own in in_groups(results).items():
        parts.append(f"## {group}\n")
        for name in own:
            said = _plain(next(each.sentence for each in entries if each.name == name))
            caption = layout_of(results[name]).caption or ""
            title, source = str(results[name].title), f"studies/{name}.toml"
            parts.append(_entry(name, title, source, f"{said} {_plain(caption)}".strip(), root))
            link = (
                f'<a href="{_report(name)}">Its report</a>' if name in reported else "[Its report](report.md)"
            )
            parts.append(f"{link}: `swtstudy report results/{name}.nc`\n")
    parts.append("## Scripts\n")
    for path in sorted((root / "studies" / "maps").glob("*.py")):
        title = path.read_text(encoding="utf-8").partition('"""')[2].partition("\n")[0].rstrip(".")
        parts.append(_entry(path.stem, title, path.relative_to(root).as_posix(), "", root))
    return "\n".join(parts)


def _report(name: str) -> str:
    """Address of a report from this page."""
    return f"reports/{name}.html"


def _target(name: str) -> str:
    """Address of a figure on this page, as Sphinx writes it."""
    return f"#{name.replace('_', '-')}"


def _plain(said: str) -> str:
    """A sentence with HTML, which Markdown takes as it is, but for what it would read as its own."""
    return said.replace("*", r"\*")


def _entry(name: str, title: str, source: str, said: str, root: Path) -> str:
    figure = root / "results" / f"{name}.png"
    if not figure.is_file():
        raise FileNotFoundError(f"{figure} is missing: run {source}")
    picture = f"![{title}](../{figure.relative_to(root)})"
    return f"({name})=\n### {title}\n\n{said} [{source}](../{source})\n\n{picture}\n"
