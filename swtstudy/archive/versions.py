"""The versions with which an archive was made; without xarray, which workers need not wait for."""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version

from swtstudy.vocabulary.version import __version__

#: Packages whose versions can affect the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")


def versions() -> str:
    """Versions of Python, of this package and of those that affect its numbers and files."""
    found = [f"python {platform.python_version()}", f"swtstudy {__version__}"]
    for name in _PACKAGES:
        try:
            found.append(f"{name} {version(name)}")
        except PackageNotFoundError:
            continue
    return ", ".join(found)
