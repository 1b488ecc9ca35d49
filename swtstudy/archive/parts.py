"""The parts of an unfinished archive: every finished chunk is a file, written atomically.

A part is an npz file with a check sum at its end: it is read exactly as it was written, or left out.

Parts are in a folder beside the archive, ``figure3.nc.parts``, until the archive is complete. Records of
points that the latest study does not have are kept as a part in another folder, ``figure3.nc.kept``, for
studies that have these points. All records known for the path of an archive are those in itself, in its
parts, and kept from other studies.
"""

from __future__ import annotations

import functools
import hashlib
import io
import json
import logging
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import fields
from pathlib import Path

import numpy as np

from swtstudy.archive.paths import ArchiveError, refuse_link
from swtstudy.points.canonical import NAMES, ROW, group_rows
from swtstudy.points.records import Records, Run, join
from swtstudy.solver.points import Solution
from swtstudy.vocabulary.choices import CRITERIA
from swtstudy.vocabulary.files import replacing, unfinished

_log = logging.getLogger(__name__)

_ARRAYS = tuple(item.name for item in fields(Solution))
#: What else is in every part; the rest are quantities.
_OWN = ("meta", "table", "status", "run")

_CHECK_SUM_SIZE = hashlib.sha256().digest_size

#: Names of parts: another file is not ours.
_NAME = re.compile(r"[0-9]{6,}\.npz")

#: What the numbers in a table mean; parts with another layout cannot be used.
_LAYOUT = {
    "columns": [[name, ROW[name].str] for name in ROW.names or ()],
    "profiles": list(NAMES),
    "criteria": list(CRITERIA),
}


def parts_folder(path: Path) -> Path:
    """The folder of the parts of the archive at `path`."""
    return path.with_name(path.name + ".parts")


def kept_folder(path: Path) -> Path:
    """The folder beside the archive at `path` for the points that its study does not have."""
    return path.with_name(path.name + ".kept")


class PartsWriter:
    """Writes records as parts into a folder of its own, beside those that are there.

    Parameters
    ----------
    folder
        Folder of the parts.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._number = _next_number(folder)

    def add(self, records: Records) -> None:
        """Write one more part; when this returns, it is safe."""
        _write(self._folder, self._number, records)
        self._number += 1


@contextmanager
def keeping(folder: Path, records: Records) -> Iterator[None]:
    """Make a folder hold exactly these records once the block has ended without an error."""
    old = _paths(folder)
    if len(records):
        folder.mkdir(exist_ok=True)
        _write(folder, _next_number(folder), records)
    yield
    _remove(old)
    clear_unfinished(folder)
    if folder.exists() and not any(folder.iterdir()):
        folder.rmdir()


def read_parts(folder: Path) -> Records:
    """The records in the parts of a folder, also while a run goes on; none if there is no such folder.

    A part that cannot be read is left out: its points will be computed again.
    """
    for _ in range(10):
        try:
            return join(part for path in _paths(folder) if (part := _read(path)) is not None)
        except FileNotFoundError:
            continue  # joined between listing and reading
    return join([])


def points_saved(folder: Path) -> int:
    """Number of distinct points in the parts of a folder."""
    # While parts are being joined, or if that was interrupted, points are in two of them.
    return len(group_rows(read_parts(folder).table)[0])


def clear_parts(folder: Path) -> None:
    """Remove the parts, once the archive has all their points, and unfinished files of killed runs."""
    _remove(_paths(folder))
    clear_unfinished(folder)


def clear_unfinished(folder: Path) -> None:
    """Remove unfinished files of killed runs: parts, and the archive whose parts they are."""
    refuse_link(folder)
    archive = re.escape(Path(folder.stem).stem)
    _remove(unfinished(folder, rf"\d{{6,}}|{archive}"))


def _next_number(folder: Path) -> int:
    # Whatever is there under such a name: it is not replaced.
    return 1 + max((int(path.stem) for path in folder.glob("*.npz") if _NAME.fullmatch(path.name)), default=0)


def _paths(folder: Path) -> list[Path]:
    refuse_link(folder)
    named = (path for path in folder.glob("*.npz") if _NAME.fullmatch(path.name))
    return sorted(path for path in named if path.is_file() and not path.is_symlink())


def _remove(paths: Iterable[Path]) -> None:
    for path in paths:
        path.unlink(missing_ok=True)


def _write(folder: Path, number: int, records: Records) -> Path:
    folder.mkdir(parents=True, exist_ok=True)  # without locks another run may have removed it
    path = folder / f"{number:06d}.npz"
    meta = {
        "layout": _LAYOUT,
        "runs": [run.to_json() for run in records.runs],
        "messages": {index: words for index, words in enumerate(records.message) if words},
    }
    content = io.BytesIO()
    np.savez(
        content,
        meta=np.array(json.dumps(meta)),
        table=records.table,
        status=records.status,
        run=records.run,
        **{name: getattr(records.solution, name) for name in _ARRAYS},
        **records.quantities,  # type: ignore[arg-type]
    )
    with replacing(path) as temporary, open(temporary, "wb") as file:
        file.write(content.getbuffer())
        file.write(_check_sum(content.getbuffer()))
    return path


def _read(path: Path) -> Records | None:
    try:
        return _records_from(path.read_bytes())
    except FileNotFoundError:
        raise
    except (OSError, ValueError, KeyError, TypeError) as error:
        _warn_left_out(path, str(error))
        return None


def _records_from(content: bytes) -> Records:
    # A zip file's own check sums do not cover its lengths, flags and offsets, which a reader trusts.
    written, check_sum = content[:-_CHECK_SUM_SIZE], content[-_CHECK_SUM_SIZE:]
    if _check_sum(written) != check_sum:
        raise ValueError("damaged")
    with np.load(io.BytesIO(written), allow_pickle=False) as part:
        meta = json.loads(part["meta"].item())
        if meta["layout"] != _LAYOUT:
            raise ValueError("made by another version of swtstudy")
        table = part["table"]
        message = np.full(len(table), "", object)
        for index, words in meta["messages"].items():
            message[int(index)] = words
        return Records(
            table,
            Solution(**{name: part[name] for name in _ARRAYS}),
            part["status"],
            part["run"],
            message,
            tuple(map(Run.from_json, meta["runs"])),
            {name: part[name] for name in part.files if name not in (*_OWN, *_ARRAYS)},
        ).without_unknown()


def _check_sum(content: bytes | memoryview) -> bytes:
    return hashlib.sha256(content).digest()


@functools.cache
def _warn_left_out(path: Path, reason: str) -> None:
    """Warn once, however often the part is read."""
    _log.warning("%s: left out, its points will be computed again (%s)", path, reason)


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
        from swtstudy.archive.netcdf import read_archive
        from swtstudy.archive.recall import records_of

        try:
            found.append(records_of(read_archive(path), path))
        except ArchiveError as error:
            raise ArchiveError(f"{error}; move it away to start anew") from None
    found += [read_parts(parts_folder(path)), read_parts(kept_folder(path))]
    return join(found)
