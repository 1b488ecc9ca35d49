"""The studies that come with the package."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from swtstudy.vocabulary.files import parse_toml, read_text

_PACKAGE = Path(__file__).parent.parent

#: The studies by what they are about, in the order in which they are listed.
GROUPS: dict[str, list[str]] = parse_toml(read_text(Path(__file__).with_name("groups.toml")))


def in_groups(names: Iterable[str]) -> dict[str, list[str]]:
    """Names of studies by group; studies without a group last."""
    names = list(names)
    known = [name for group in GROUPS.values() for name in group]
    found = {group: [name for name in own if name in names] for group, own in GROUPS.items()}
    found["Others"] = [name for name in names if name not in known]
    return {group: own for group, own in found.items() if own}


def shipped_folder() -> Path:
    """The folder of the studies of the paper: in an installed package, or in the source tree."""
    installed = _PACKAGE / "studies"
    return installed if installed.is_dir() else _PACKAGE.parent / "studies"


def shipped_studies() -> dict[str, Path]:
    """Paths of the studies by name, such as "figure3": the paper's studies, then the audit's."""
    folder = shipped_folder()
    files = [*sorted(folder.glob("*.toml")), *sorted(folder.glob("audit/*.toml"))]
    return {path.stem: path for path in files}


def find_study(path: str) -> Path:
    """The file at ``path``, or else the study with that name that comes with the package."""
    if Path(path).exists() or Path(path).suffix:
        return Path(path)
    return shipped_studies().get(path, Path(path))
