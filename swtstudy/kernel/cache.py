"""The folder of compiled code: where it is, who writes to it, and when it is removed."""

import os
import shutil
import sys
import tempfile
import time
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path
from threading import RLock

import numba
import numpy as np
from numba.core.caching import CompileResultCacheImpl, FunctionCache, InTreeCacheLocator
from numba.core.event import Listener, install_listener
from numba.core.runtime import rtsys

try:
    import fcntl
except ImportError:  # Windows: two processes may both compile, each of them what is right
    fcntl = None  # type: ignore[assignment]

#: Folders of other sources are removed when they have not been used for so many days.
KEPT_DAYS = 30


def cache_folder():
    """Folder of compiled code, one for each state of the sources; "" if there is no place to write to.

    Numba itself sees changes in a function's own file only. The folder lies in ``NUMBA_CACHE_DIR`` if that is
    set, or in the user's cache, or else in the temporary folder: never beside the sources, which may be
    read-only.
    """
    sources = sha256(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))))
    sources.update(f"{numba.__version__} {np.__version__}".encode())
    for base in _bases():
        folder = Path(base) / f"kernel-{sources.hexdigest()[:16]}"
        try:
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=folder).close()
        except OSError:
            continue
        # Compiled code of another user is not run: anybody may make a folder in the temporary one.
        if not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid():
            return str(folder)
    return ""


def _bases():
    """Where the folder may be, the best place first."""
    if given := os.environ.get("NUMBA_CACHE_DIR"):
        yield given
    users = (
        os.environ.get("LOCALAPPDATA") or os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    )
    if os.path.isabs(users):
        yield Path(users) / "swtstudy"
    with suppress(OSError):  # there is no temporary folder either
        owner = f"-{os.getuid()}" if hasattr(os, "getuid") else ""
        yield Path(tempfile.gettempdir()) / f"swtstudy{owner}"


FOLDER = cache_folder()
_of_this_process = RLock()


class _InFolder(InTreeCacheLocator):
    """The folder as the place of a function's code, wherever the function's file is.

    Numba would look for the code by the path of the file, and compile it anew for each copy of the package.
    """

    def get_cache_path(self):
        return FOLDER


class _CodeInFolder(CompileResultCacheImpl):
    _locator_classes = [_InFolder]  # noqa: RUF012, of Numba


class KeptCode(FunctionCache):
    """Compiled code of a function, kept in the folder."""

    _impl_class = _CodeInFolder

    def load_overload(self, sig, target_context):
        """The code for a signature, or None; Numba's own way first loads all that is needed to compile."""
        rtsys.initialize(target_context)  # the memory of arrays
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)


@contextmanager
def compiling(name):
    """Let one thread of one process at a time compile a function: the others find its code in the folder."""
    with _of_this_process, install_listener("numba:compile", _telling):
        if fcntl is None or not FOLDER:
            yield
            return
        with open(Path(FOLDER) / f"{name}.lock", "w") as file:
            with suppress(OSError):  # a file system without locks
                fcntl.flock(file, fcntl.LOCK_EX)
            os.utime(FOLDER)
            yield


class _Telling(Listener):
    """Say on a terminal, once, that something is compiled which nothing in the folder has spared."""

    def __init__(self):
        self.begun = False

    def on_start(self, event):
        if not self.begun:
            if sys.stderr is not None and sys.stderr.isatty():
                print("compiling the solver, once, for up to a minute", file=sys.stderr, flush=True)
            if FOLDER:
                remove_unused(Path(FOLDER))
        self.begun = True

    def on_end(self, event):
        pass


_telling = _Telling()


def remove_unused(folder):
    """Remove the folders of compiled code beside this one that have not been used for long."""
    for other in folder.parent.glob("kernel-*"):
        with suppress(OSError):
            if other != folder and time.time() - other.stat().st_mtime > KEPT_DAYS * 86400.0:
                shutil.rmtree(other, ignore_errors=True)
