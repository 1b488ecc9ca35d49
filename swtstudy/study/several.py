"""Reading several study files at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from swtstudy.study.definition import Study
from swtstudy.study.shipped import find_study
from swtstudy.vocabulary.mistakes import Mistake, Report


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
    report = Report()
    for path in dict.fromkeys(_files(paths, report)):
        with report:
            studies[path] = Study.from_toml(path)
        first = names.setdefault(Path(path).stem, path)
        if first != path:
            report.append(Mistake("", f"the same name as {first}", "names that differ", path))
    report.refuse()
    return studies


def _files(paths: Iterable[str], report: Report) -> Iterator[str]:
    for path in paths:
        if not Path(path).is_dir():
            yield str(find_study(path))
            continue
        inside = sorted(map(str, Path(path).glob("*.toml")))
        if not inside:
            report.append(Mistake("", "a folder without studies", "studies (*.toml) in it", path))
        yield from inside
