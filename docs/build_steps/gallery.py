"""Every study with its figure."""

from pathlib import Path

from swtstudy.study.definition import Study


def gallery(root: Path) -> str:
    """The studies that have a figure, in the order of their names, then the pictures of scripts."""
    parts = []
    for path in sorted((root / "studies").glob("*.toml")):
        title = Study.from_toml(path).title
        parts.append(_entry(title, path.relative_to(root), root / "results" / f"{path.stem}.png", root))
    for path in sorted((root / "studies" / "maps").glob("*.py")):
        title = path.read_text(encoding="utf-8").partition('"""')[2].partition("\n")[0].rstrip(".")
        parts.append(_entry(title, path.relative_to(root), root / "results" / f"{path.stem}.png", root))
    return "\n".join(parts)


def _entry(title: str, source: Path, figure: Path, root: Path) -> str:
    if not figure.is_file():
        raise FileNotFoundError(f"{figure} is missing: run {source}")
    picture = f"![{title}](../{figure.relative_to(root)})"
    return f"## {title}\n\n[{source}](../{source})\n\n{picture}\n"
