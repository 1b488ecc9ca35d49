"""All records known for the path of an archive: in itself, in its parts, and kept from other studies."""

from __future__ import annotations

from pathlib import Path

from swtstudy.archive.error import ArchiveError
from swtstudy.archive.parts import kept_folder, parts_folder, read_parts
from swtstudy.points.records import Records, join


def known_records(path: Path) -> Records:
    """The records in the archive at `path`, if there is one, in its parts, and kept beside it.

    Raises
    ------
    ArchiveError
        If the file is not an archive, and so must not be replaced.
    """
    found = []
    if path.exists():
        # Where nothing is known, workers start before xarray is imported here.
        from swtstudy.archive.read import read_archive
        from swtstudy.archive.recall import records_of

        try:
            found.append(records_of(read_archive(path), path))
        except ArchiveError as error:
            raise ArchiveError(f"{error}; move it away to start anew") from None
    found += [read_parts(parts_folder(path)), read_parts(kept_folder(path))]
    return join(found)
