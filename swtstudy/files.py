"""Files that are either complete or absent."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike
from pathlib import Path


def check_writable(path: str | PathLike[str]) -> None:
    """Make sure that a file can be written to `path`; its folder is created if needed.

    Raises
    ------
    OSError
        If it cannot be written; the message names the folder.
    """
    path = Path(path)
    if path.is_dir():
        raise IsADirectoryError(f"{path} is a folder, not a file")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = _temporary(path, path.parent)
        os.close(handle)
        os.unlink(name)
    except OSError as error:
        raise type(error)(f"cannot write into the folder {path.parent}: {error.strerror}") from error


@contextmanager
def replacing(path: str | PathLike[str], folder: Path | None = None) -> Iterator[Path]:
    """A temporary file that replaces the file at `path` when the block ends without an error.

    The temporary file is in the same folder, or in `folder`, which must be on the same file system. Its data
    is on the disk before it gets its name, so that neither a kill nor a power cut leaves half a file.
    """
    path = Path(path)
    handle, name = _temporary(path, folder or path.parent)
    os.close(handle)
    temporary = Path(name)
    try:
        yield temporary
        # mkstemp creates files that only their owner can read.
        temporary.chmod(0o666 & ~_umask())
        _sync(temporary)
        os.replace(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    _sync(path.parent)


def _temporary(path: Path, folder: Path) -> tuple[int, str]:
    return tempfile.mkstemp(prefix=f".{path.stem}-", suffix=path.suffix, dir=folder)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _sync(path: Path) -> None:
    if os.name == "nt" and path.is_dir():
        return  # folders cannot be opened there
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
