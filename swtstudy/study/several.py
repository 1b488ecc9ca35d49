"""Reading several study files at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from swtstudy.study.definition import Study
from swtstudy.study.shipped import find_study
from swtstudy.vocabulary.mistakes import Mistake, StudyError


def read_studies(paths: Iterable[str]) -> dict[str, Study]:
    """The studies by path, each file once.

    Each path is that of a file or of a folder of files, or the name of a study of the paper, such as
    "figure3".

    Raises
    ------
    StudyError
        A ValueError with every mistake in every file; also if two files would have the same archive.
    """
    studies: dict[str, Study] = {}
    names: dict[str, str] = {}
    mistakes: list[Mistake] = []
    for path in dict.fromkeys(_files(paths, mistakes)):
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


def _files(paths: Iterable[str], mistakes: list[Mistake]) -> Iterator[str]:
    for path in paths:
        if not Path(path).is_dir():
            yield str(find_study(path))
            continue
        inside = sorted(map(str, Path(path).glob("*.toml")))
        if not inside:
            mistakes.append(Mistake("", "a folder without studies", "studies (*.toml) in it", path))
        yield from inside
