"""The studies that come with the package."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).parent.parent

#: Where they are in an installed package, and in the source tree.
_PLACES = (_PACKAGE / "studies", _PACKAGE.parent / "studies")


def shipped_folder() -> Path:
    """The folder of the studies of the paper."""
    return next((place for place in _PLACES if (place / "figure3.toml").is_file()), _PLACES[0])


def shipped_studies() -> dict[str, Path]:
    """Paths of the studies by name, such as "figure3": those of the paper, then those for the audit."""
    folder = shipped_folder()
    return {
        path.stem: path for path in [*sorted(folder.glob("*.toml")), *sorted(folder.glob("audit/*.toml"))]
    }


def find_study(path: str) -> Path:
    """The file at ``path``, or else the study with that name that comes with the package."""
    if Path(path).exists() or Path(path).suffix:
        return Path(path)
    return shipped_studies().get(path, Path(path))
