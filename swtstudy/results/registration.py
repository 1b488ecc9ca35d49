"""Registering the accessor ``swt`` as soon as xarray is imported, without importing xarray for it.

xarray has no entry point for accessors: a package registers its own when it is imported. This package imports
xarray, which takes ten times as long as the package itself, only when it is needed.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
from importlib.machinery import ModuleSpec
from types import ModuleType


def register_with_xarray() -> None:
    """Register the accessor: now if xarray has been imported, otherwise as soon as it is."""
    if "xarray" in sys.modules:
        importlib.import_module("swtstudy.accessor")
    else:
        sys.meta_path.insert(0, _AfterXarray())


class _AfterXarray:
    """An import hook that finds no modules itself; it makes the loader of xarray register the accessor."""

    def find_spec(self, name: str, *_: object) -> ModuleSpec | None:
        if name != "xarray":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def execute_and_register(module: ModuleType) -> None:
                execute(module)
                importlib.import_module("swtstudy.accessor")

            spec.loader.exec_module = execute_and_register  # type: ignore[method-assign]
        return spec
