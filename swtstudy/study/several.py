"""Several study files at once."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from swtstudy.mistakes import Mistake, StudyError
from swtstudy.study.definition import Study


def read_studies(paths: Iterable[str]) -> dict[str, Study]:
    """The studies by path, each file once.

    Raises
    ------
    StudyError
        With every mistake in every file; also if two files would leave the same archive.
    """
    studies: dict[str, Study] = {}
    names: dict[str, str] = {}
    mistakes: list[Mistake] = []
    for path in dict.fromkeys(paths):
        try:
            studies[path] = Study.from_toml(path)
        except StudyError as error:
            mistakes += error.mistakes
        first = names.setdefault(Path(path).stem, path)
        if first != path:
            mistakes.append(Mistake("", f"the same name as {first}", "names that differ", path))
    if mistakes:
        raise StudyError(mistakes)
    return studies
