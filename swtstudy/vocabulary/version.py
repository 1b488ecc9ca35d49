"""The versions of the package and of the solver's values."""

from __future__ import annotations

from functools import cache

__version__ = "0.1.0"

#: To be raised whenever a change moves values of s by more than a tenth of their s_error: archives
#: remember it, and values of different versions are never mixed.
SOLVER_VERSION = "40"

#: Packages whose versions can affect the numbers or the file.
_PACKAGES = ("numpy", "scipy", "xarray", "netCDF4", "dask")


@cache
def versions() -> str:
    """Versions of Python, of this package and of packages that affect its numbers and files."""
    import platform
    from importlib.metadata import version

    packages = (f"{name} {version(name)}" for name in _PACKAGES)
    return ", ".join([f"python {platform.python_version()}", f"swtstudy {__version__}", *packages])
