"""One run at a time for each archive."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows: without this lock the last of two runs wins, still with a whole archive
    fcntl = None  # type: ignore[assignment]


class LockedError(OSError):
    """An archive that someone else is writing."""


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, which is made for it, and removed in the end if nothing else is in it.

    The lock is the kernel's: it ends with the process, whatever ends that.

    Raises
    ------
    LockedError
        If another process holds it; the message says which.
    """
    path = folder / "lock"
    handle = _acquire(path)
    try:
        os.truncate(handle, 0)
        os.write(handle, f"process {os.getpid()} on {socket.gethostname()}".encode())
        yield
    finally:
        # Removed while it is held: whoever opened it meanwhile finds another file at its name.
        if list(folder.iterdir()) == [path]:
            path.unlink()
            folder.rmdir()
        os.close(handle)


def is_locked(path: Path) -> bool:
    """Whether a program has a file open for writing, by the lock that HDF5 keeps on it."""
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
