"""Paths of archives: names that they can have, a lock that allows one run at a time, and files that are none.

Names are checked before anything is computed.
"""

from __future__ import annotations

import errno
import logging
import os
import socket
import stat
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from os import PathLike
from pathlib import Path

from swtstudy.vocabulary.mistakes import Report, refused, storable

try:
    import fcntl
except ImportError:  # Windows: without a lock, the later of two runs wins, still with a complete archive
    fcntl = None  # type: ignore[assignment]

_log = logging.getLogger(__name__)


class ArchiveError(ValueError):
    """A file that is not an archive of a study, or a damaged one."""


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
        with report:
            check_archive_path(path)
    report.refuse()
    return paths


def check_archive_path(path: Path) -> None:
    """Raise a StudyError, a ValueError, for a path that netCDF cannot have."""
    whole = path.absolute()
    # netCDF takes a backslash for a slash; on Windows, where it is one, no part contains it.
    if not storable(str(whole)) or any("\\" in part for part in whole.parts[1:]):
        found = "a backslash, a null character, or bytes that are not UTF-8"
        raise refused("", found, "a path without these", str(path))


#: Errors of file systems without locks.
_NO_LOCKS = (errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL)
#: A link is not followed, and a pipe not waited for.
_NO_LINK = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)


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
    with ExitStack() as opened:
        while True:
            folder.mkdir(parents=True, exist_ok=True)
            with suppress(FileNotFoundError):  # the folder was removed in between
                try:
                    handle = os.open(path, os.O_RDWR | os.O_CREAT | _NO_LINK, 0o666)
                except OSError as error:
                    if error.errno in (errno.ELOOP, errno.EISDIR, errno.ENXIO):
                        raise OSError(f"{path} is no file of ours ({error.strerror}); remove it") from None
                    raise
                opened.callback(os.close, handle)
                _lock(handle, path)
                if os.stat(path).st_ino == os.fstat(handle).st_ino:
                    break
            opened.close()
        try:
            os.truncate(handle, 0)
            os.write(handle, f"process {os.getpid()} on {socket.gethostname()}".encode())
            yield
        finally:
            # Removed while held: whoever opened it in the meantime will find another file under its name.
            # Without locks another run may have removed it.
            with suppress(FileNotFoundError):
                if list(folder.iterdir()) == [path]:
                    path.unlink()
                    folder.rmdir()


def refuse_link(folder: Path) -> None:
    """Raise an OSError if a folder of ours is a link: what it points to is not ours to clear."""
    if folder.is_symlink():
        raise OSError(f"{folder} is a link; allowed: a folder that swtstudy makes")


def _lock(handle: int, path: Path) -> None:
    """Lock an open file, as far as the file system has locks."""
    if not stat.S_ISREG(os.fstat(handle).st_mode):
        raise OSError(f"{path} is no file of ours (not a regular file); remove it")
    target = path.parent.with_suffix("")
    try:
        if fcntl is not None:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        holder = os.read(handle, 200).decode(errors="replace") or "another process"
        raise LockedError(f"{target} is being written by {holder}; wait until it has finished") from None
    except OSError as error:
        if error.errno not in _NO_LOCKS:
            raise OSError(f"cannot lock {target} ({error.strerror}); choose another folder") from None
        _log.warning(f"{path.parent.parent}: a file system without locks; run {target.name} once at a time")
