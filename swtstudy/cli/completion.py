"""Shell completion of arguments: studies of the paper, study files, archives."""

from __future__ import annotations

from pathlib import Path

from click import Context, Parameter
from click.shell_completion import CompletionItem


def study_completion(context: Context, parameter: Parameter, incomplete: str) -> list[CompletionItem]:
    """Studies of the paper by name, and study files here or in the folder studies."""
    from swtstudy.study.shipped import shipped_studies

    return _offered([*shipped_studies(), *_files("*.toml", "studies/*.toml")], incomplete)


def archive_completion(context: Context, parameter: Parameter, incomplete: str) -> list[CompletionItem]:
    """Archives here or in the folder results."""
    return _offered(_files("*.nc", "results/*.nc"), incomplete)


def _files(*patterns: str) -> list[str]:
    return [str(path) for pattern in patterns for path in sorted(Path().glob(pattern))]


def _offered(names: list[str], incomplete: str) -> list[CompletionItem]:
    """Names that begin with the incomplete word, or else the files that the shell finds."""
    items = [CompletionItem(name) for name in names if name.startswith(incomplete)]
    return items or [CompletionItem(incomplete, type="file")]
