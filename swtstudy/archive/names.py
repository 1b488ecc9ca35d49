"""Names that an archive can have; checked before anything is computed."""

from __future__ import annotations

import os
from collections.abc import Iterable
from os import PathLike
from pathlib import Path

from swtstudy.vocabulary.mistakes import Mistake, Report

#: Bytes to spare: the longest name made from ``name.nc`` is ``.name-12345678.png``, of an unfinished figure.
_ADDED = 11

#: Longest name in bytes where the file system does not report it.
_LONGEST_NAME = 255


def archive_paths(studies: Iterable[str], folder: str | PathLike[str], prefix: str = "") -> dict[str, Path]:
    """Paths of the archives of study files, by study file.

    Raises
    ------
    StudyError
        With every path that no archive can have.
    """
    paths = {study: Path(folder) / f"{prefix}{Path(study).stem}.nc" for study in studies}
    report = Report()
    for path in paths.values():
        _check(path, report)
    existing = _existing(Path(folder))
    if not existing.is_dir():
        report.append(Mistake("", f"{existing}, which is a file", "a folder for archives", str(folder)))
    report.refuse()
    return paths


def check_archive_path(path: Path) -> None:
    """Raise a StudyError, a ValueError, for a path that no archive can have."""
    _check(path, report := Report())
    report.refuse()


def _check(path: Path, report: Report) -> None:
    whole = path.absolute()
    found = []
    try:
        str(whole).encode()
    except UnicodeEncodeError:
        found.append(("bytes that are not UTF-8", "a path in UTF-8"))
    # netCDF takes it for a slash; on Windows, where it is one, no part contains it.
    if any("\\" in part for part in whole.parts[1:]):
        found.append(("a backslash", "a path without one"))
    if "\0" in str(whole):
        found.append(("a null character", "a path without one"))
    if not found:
        longest = _longest_name(_existing(path.parent)) - _ADDED
        length = len(os.fsencode(path.name))
        if length > longest:
            found.append((f"a name of {length} bytes", f"at most {longest}"))
    report += [Mistake("", *parts, str(path)) for parts in found]


def _existing(folder: Path) -> Path:
    """The folder, or the nearest existing one above it."""
    absolute = folder.absolute()
    return next(each for each in (absolute, *absolute.parents) if each.exists())


def _longest_name(folder: Path) -> int:
    try:
        return os.pathconf(folder, "PC_NAME_MAX")
    except (AttributeError, OSError, ValueError):
        return _LONGEST_NAME
