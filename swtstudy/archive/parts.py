"""The parts of an unfinished archive: every finished chunk is a file, written atomically.

A part is an npz file with a check sum at its end: it is read exactly as it was written, or left out.

Parts are in a folder beside the archive, ``figure3.nc.parts``, until the archive is complete. Values of
points that the latest study does not have are kept as a part in another folder, ``figure3.nc.kept``, for
studies that have these points. All values known for the path of an archive are the values in itself, in its
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
from contextlib import contextmanager, suppress
from pathlib import Path

import numpy as np

from swtstudy.archive.paths import refuse_link
from swtstudy.points.chunk import Found, join, read_runs
from swtstudy.points.grid import ROW, group_rows
from swtstudy.vocabulary.choices import CRITERIA, FAMILIES
from swtstudy.vocabulary.files import replacing, unfinished

_log = logging.getLogger(__name__)

_CHECK_SUM_SIZE = hashlib.sha256().digest_size

#: Names of parts: another file is not ours.
_NAME = re.compile(r"[0-9]{6,}\.npz")

#: Layout of the numbers in a table; parts with another layout cannot be used.
_LAYOUT = {
    "columns": [[name, ROW[name].str] for name in ROW.names or ()],
    "profiles": list(FAMILIES),
    "criteria": list(CRITERIA),
}


def parts_folder(path: Path) -> Path:
    """The folder of the parts of the archive at `path`."""
    return path.with_name(path.name + ".parts")


def kept_folder(path: Path) -> Path:
    """The folder beside the archive at `path` for the points that its study does not have."""
    return path.with_name(path.name + ".kept")


@contextmanager
def keeping(folder: Path, found: Found) -> Iterator[None]:
    """Make a folder hold exactly these values once the block has ended without an error."""
    old = part_paths(folder)
    if len(found):
        save_part(folder, found)
    yield
    clear(folder, old)
    if folder.exists() and not any(folder.iterdir()):
        folder.rmdir()


def read_parts(folder: Path) -> Found:
    """The values in the parts of a folder, also while a run goes on; none if there is no such folder.

    A part that cannot be read is left out: its points will be computed again.
    """
    for _ in range(10):
        with suppress(FileNotFoundError):  # the archive has been completed between listing and reading
            return join(part for path in part_paths(folder) if (part := _read(path)) is not None)
    return join([])


def points_saved(folder: Path) -> int:
    """Number of distinct points in the parts of a folder."""
    # While parts are being joined, or if that was interrupted, points are in two of them.
    return len(group_rows(read_parts(folder)["row"])[0])


def clear(folder: Path, parts: Iterable[Path] = ()) -> None:
    """Remove parts, and unfinished files of killed runs: parts, and the archive whose parts they are."""
    refuse_link(folder)
    archive = re.escape(Path(folder.stem).stem)
    for path in (*parts, *unfinished(folder, rf"\d{{6,}}|{archive}")):
        path.unlink(missing_ok=True)


def part_paths(folder: Path) -> list[Path]:
    """The files of the parts in a folder, the oldest first."""
    refuse_link(folder)
    return sorted(path for path in _named(folder) if path.is_file() and not path.is_symlink())


def _named(folder: Path) -> list[Path]:
    return [path for path in folder.glob("*.npz") if _NAME.fullmatch(path.name)]


def save_part(folder: Path, found: Found) -> None:
    """Write one more part, beside the parts that are there; when this returns, it is safe."""
    folder.mkdir(parents=True, exist_ok=True)  # without locks another run may have removed it
    # Whatever is there under such a name: it is not replaced.
    number = 1 + max((int(path.stem) for path in _named(folder)), default=0)
    arrays = dict(found.arrays)
    messages = {place: words for place, words in enumerate(arrays.pop("message")) if words}
    runs = json.dumps([run.to_json() for run in found.runs])
    meta = json.dumps({"layout": _LAYOUT, "runs": runs, "messages": messages})
    content = io.BytesIO()
    np.savez(content, meta=np.array(meta), **arrays)  # type: ignore[arg-type]
    with replacing(folder / f"{number:06d}.npz") as temporary, open(temporary, "wb") as file:
        file.write(content.getbuffer())
        file.write(hashlib.sha256(content.getbuffer()).digest())


def _read(path: Path) -> Found | None:
    """The values in a part; None, with a warning, if it cannot be read."""
    try:
        content = path.read_bytes()
        # A zip file's own check sums do not cover its lengths, flags and offsets, which a reader trusts.
        written, check_sum = content[:-_CHECK_SUM_SIZE], content[-_CHECK_SUM_SIZE:]
        if hashlib.sha256(written).digest() != check_sum:
            raise ValueError("damaged")
        with np.load(io.BytesIO(written), allow_pickle=False) as part:
            arrays = dict(part)
        meta = json.loads(arrays.pop("meta").item())
        if meta["layout"] != _LAYOUT:
            raise ValueError("made by another version of swtstudy")
        words = (meta["messages"].get(str(place), "") for place in range(len(arrays["row"])))
        return Found(arrays | {"message": np.array([*words], object)}, read_runs(meta["runs"]))
    except FileNotFoundError:
        raise
    except (OSError, ValueError, KeyError, TypeError) as error:
        _warn_left_out(path, str(error))
        return None


@functools.cache
def _warn_left_out(path: Path, reason: str) -> None:
    """Warn once, however often the part is read."""
    _log.warning("%s: left out, its points will be computed again (%s)", path, reason)


def known_beside(path: Path) -> Found:
    """All that is in the parts of the archive at `path`, and kept beside it."""
    return join([read_parts(parts_folder(path)), read_parts(kept_folder(path))])
