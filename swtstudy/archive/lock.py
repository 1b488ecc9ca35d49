"""A lock that allows one run at a time for each archive."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: without a lock, the later of two runs wins, still with a complete archive
    fcntl = None  # type: ignore[assignment]


class LockedError(OSError):
    """An archive that another process is writing."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which is created if needed, and removed at the end if nothing else is in it.

    The lock is the kernel's: it ends with the process, however that ends.

    Raises
    ------
    LockedError
        If another process holds it; the message says which.
    """
    refuse_link(folder)
    path = folder / "lock"
    handle = _acquire(path)
    try:
        os.truncate(handle, 0)
        os.write(handle, f"process {os.getpid()} on {socket.gethostname()}".encode())
        yield
    finally:
        # Removed while held: whoever opened it in the meantime will find another file under its name.
        if list(folder.iterdir()) == [path]:
            path.unlink()
            folder.rmdir()
        os.close(handle)


def refuse_link(folder: Path) -> None:
    """Raise an OSError if a folder of ours is a link: what it points to is not ours to clear."""
    if folder.is_symlink():
        raise OSError(f"{folder} is a link; allowed: a folder that swtstudy makes")


def is_locked(path: Path) -> bool:
    """Return whether a program has a file open for writing: HDF5 then holds a lock on it."""
    if fcntl is None:
        return False
    try:
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False  # not even readable
    return False


def _acquire(path: Path) -> int:
    while True:
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            handle = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except FileNotFoundError:
            continue  # the folder was removed in between
        if fcntl is None:
            return handle
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.read(handle, 200).decode(errors="replace") or "another process"
            os.close(handle)
            target = path.parent.with_suffix("")
            raise LockedError(f"{target} is being written by {holder}; wait until it has finished") from None
        if path.exists() and os.stat(path).st_ino == os.fstat(handle).st_ino:
            return handle
        os.close(handle)
