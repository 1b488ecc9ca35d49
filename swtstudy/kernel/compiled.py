"""Options with which the kernel is compiled, and the folder of compiled code."""

import os
import tempfile
from hashlib import sha256
from pathlib import Path

import numba
import numpy as np


def cache_folder():
    """Folder of compiled code, one for each state of the sources.

    Numba itself sees changes in a function's own file only. The folder lies in ``NUMBA_CACHE_DIR`` if that is
    set, or in the user's cache, or else in the temporary folder.
    """
    sources = sha256(b"".join(path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py"))))
    users = os.environ.get("LOCALAPPDATA") or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    for base in (
        os.environ.get("NUMBA_CACHE_DIR"),
        Path(users) / "swtstudy",
        Path(tempfile.gettempdir()) / "swtstudy",
    ):
        if base:
            folder = Path(base) / sources.hexdigest()[:16]
            try:
                folder.mkdir(parents=True, exist_ok=True)
                tempfile.TemporaryFile(dir=folder).close()
            except OSError:
                continue
            return str(folder)
    return ""


_FOLDER = cache_folder()


def jit(function, **options):
    """Compile a function: division by zero as in NumPy, no lock held, cached in the kernel's own folder."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = _FOLDER
    try:
        return numba.njit(cache=bool(_FOLDER), error_model="numpy", nogil=True, **options)(function)
    finally:
        numba.config.CACHE_DIR = before


def jit_reordered(function):
    """Compile a loop over finite numbers whose order of summation does not matter."""
    return jit(function, fastmath=True)


def new_record(kind):
    """A record of zeros whose fields are attributes, also where nothing is compiled."""
    return new_records(1, kind)[0]


def new_records(count, kind):
    """An array of such records."""
    return np.zeros(count, kind).view(np.recarray)
