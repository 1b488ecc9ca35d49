"""Options with which the kernel is compiled, the folder of compiled code, and how it gets there once."""

import os
import shutil
import sys
import tempfile
import time
from contextlib import contextmanager, suppress
from functools import wraps
from hashlib import sha256
from pathlib import Path
from threading import RLock

import numba
import numpy as np
from numba.core import event

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


_FOLDER = cache_folder()


def entry(function, **options):
    """Compile a function that Python calls, too: division by zero as in NumPy, no lock held, cached."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = _FOLDER
    try:
        own = {"cache": bool(_FOLDER), "error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
        compiled = numba.njit(**own, **options)(function)
    finally:
        numba.config.CACHE_DIR = before
    if not numba.config.DISABLE_JIT:
        _compile_literals_as_numbers(compiled)
    return compiled


def jit(function, **options):
    """Compile a function for compiled functions alone: code for calls from Python costs an eighth."""
    compiled = entry(function, no_cpython_wrapper=True, **options)
    if numba.config.DISABLE_JIT:
        return compiled

    def refuse(*arguments):
        raise TypeError(f"compiled code alone calls {function.__name__}; decorate it with entry for Python")

    # A call from Python looks for compiled code that was put in, and then compiles.
    compiled._insert, compiled._compile_for_args = lambda *code: None, refuse
    return compiled


def jit_inlined(function):
    """The same for a long step of one caller.

    The step becomes a part of the caller before the compiler optimises: it would optimise the step, and all
    that the step calls, once for each function above it.
    """
    return jit(function, inline="always")


def _compile_literals_as_numbers(compiled):
    """Let a call with a literal such as 0 use the code for all integers: Numba would compile it anew."""
    template = compiled.get_call_template

    def call_template(arguments, keywords):
        return template(tuple(numba.types.unliteral(each) for each in arguments), keywords)

    compiled.get_call_template = call_template


def entry_reordered(function):
    """Compile a loop over finite numbers whose order of summation does not matter."""
    return entry(function, fastmath=True)


def once(function):
    """Make a function of compiled calls run once in a process, and by one process at a time.

    The others find its compiled functions in the folder. Threads wait for one another, too.
    """
    lock, begun = RLock(), []

    @wraps(function)
    def first_call():
        with lock:
            if not begun:
                begun.append(True)
                with _locked(), _told():
                    function()

    return first_call


@contextmanager
def _locked():
    """Hold the lock of the folder; without one where the system has none."""
    if fcntl is None or not _FOLDER:
        yield
        return
    with open(Path(_FOLDER) / "lock", "w") as file:
        with suppress(OSError):  # a file system without locks
            fcntl.flock(file, fcntl.LOCK_EX)
        yield


class _Compiling(event.Listener):
    """Say on a terminal that something is compiled, which nothing in the folder has spared."""

    def __init__(self):
        self.begun = False

    def on_start(self, event):
        if not self.begun and sys.stderr is not None and sys.stderr.isatty():
            print("compiling the solver, once, about a minute", file=sys.stderr, flush=True)
        self.begun = True

    def on_end(self, event):
        pass


@contextmanager
def _told():
    """Tell of what is compiled in a with block, and tidy up afterwards."""
    compiling = _Compiling()
    with event.install_listener("numba:compile", compiling):
        yield
    if _FOLDER:
        with suppress(OSError):
            os.utime(_FOLDER)
        if compiling.begun:
            remove_unused(Path(_FOLDER))


def remove_unused(folder):
    """Remove the folders of compiled code beside this one that have not been used for long."""
    for other in folder.parent.glob("kernel-*"):
        with suppress(OSError):
            if other != folder and time.time() - other.stat().st_mtime > KEPT_DAYS * 86400.0:
                shutil.rmtree(other, ignore_errors=True)


def new_record(kind):
    """A record of zeros whose fields are attributes, also where nothing is compiled."""
    return new_records(1, kind)[0]


def new_records(count, kind):
    """An array of such records."""
    return np.zeros(count, kind).view(np.recarray)
