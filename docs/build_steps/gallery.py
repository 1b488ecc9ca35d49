"""Every study with its figure, and the pictures of scripts."""

from pathlib import Path

from swtstudy import open_results
from swtstudy.figures.draw import layout_of
from swtstudy.reports.findings import sentences
from swtstudy.reports.site import entry, gallery_of
from swtstudy.study.shipped import in_groups, shipped_studies


def gallery(root: Path) -> str:
    """Cards of all studies in groups, then the figure of each in full, then the pictures of scripts."""
    names = [name for name in shipped_studies() if (root / "results" / f"{name}.nc").is_file()]
    results = {name: open_results(root / "results" / f"{name}.nc") for name in names}
    entries = [entry(dataset, name) for name, dataset in results.items()]
    parts = [f"```{{raw}} html\n{gallery_of(entries, _address)}\n```\n"]
    for group, own in in_groups(names).items():
        parts.append(f"## {group}\n")
        for name in own:
            said = _plain(next(iter(sentences(results[name])), ""))
            caption = layout_of(results[name]).caption or ""
            title, source = str(results[name].title), f"studies/{name}.toml"
            parts.append(_entry(name, title, source, f"{said} {_plain(caption)}".strip(), root))
            parts.append(f"[A page of it](report.md) to send: `swtstudy report results/{name}.nc`\n")
    parts.append("## Scripts\n")
    for path in sorted((root / "studies" / "maps").glob("*.py")):
        title = path.read_text(encoding="utf-8").partition('"""')[2].partition("\n")[0].rstrip(".")
        parts.append(_entry(path.stem, title, path.relative_to(root).as_posix(), "", root))
    return "\n".join(parts)


def _address(name: str) -> str:
    """Of a target on this page, as Sphinx writes it."""
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
