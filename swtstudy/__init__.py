"""Parameter studies of the Smith–Watson–Topper parameter in frictional contacts."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from typing import TYPE_CHECKING

from swtstudy.vocabulary.version import __version__ as __version__

if TYPE_CHECKING:
    from importlib.machinery import ModuleSpec
    from types import ModuleType

    from swtstudy.archive.archive import open_results as open_results
    from swtstudy.archive.run import run as run
    from swtstudy.archive.run import run_suite as run_suite
    from swtstudy.faces.contacts import physical as physical
    from swtstudy.faces.elements import evaluate_history as evaluate_history
    from swtstudy.faces.elements import read_history as read_history
    from swtstudy.figures.definitions import draw_load as draw_load
    from swtstudy.figures.definitions import draw_profile as draw_profile
    from swtstudy.figures.point import inspect as inspect
    from swtstudy.paper.audit import audit_study as audit_study
    from swtstudy.points.solve import solve as solve
    from swtstudy.results.fitting import fit as fit
    from swtstudy.results.history import criterion_of_history as criterion_of_history
    from swtstudy.results.history import swt_of_history as swt_of_history
    from swtstudy.results.inspection import inspect_point as inspect_point
    from swtstudy.results.optimise import optimise as optimise
    from swtstudy.results.sensitivity import sensitivity as sensitivity
    from swtstudy.results.stress import slip_map as slip_map
    from swtstudy.results.stress import stress_field as stress_field
    from swtstudy.results.stress import swt_field as swt_field
    from swtstudy.solver.load_path import LoadPath as LoadPath
    from swtstudy.solver.table import TabulatedProfile as TabulatedProfile
    from swtstudy.study.definition import Study as Study
    from swtstudy.study.record import read_signal as read_signal
    from swtstudy.study.trace import read_trace as read_trace
    from swtstudy.study.units.life import FatigueConstants as FatigueConstants
    from swtstudy.study.units.life import ShearConstants as ShearConstants
    from swtstudy.vocabulary.mistakes import StudyError as StudyError

# Imported on first use: the command line starts in a tenth of the time that xarray takes to import.
_HOMES = {
    "FatigueConstants": "swtstudy.study.units.life",
    "LoadPath": "swtstudy.solver.load_path",
    "ShearConstants": "swtstudy.study.units.life",
    "Study": "swtstudy.study.definition",
    "StudyError": "swtstudy.vocabulary.mistakes",
    "TabulatedProfile": "swtstudy.solver.table",
    "audit_study": "swtstudy.paper.audit",
    "criterion_of_history": "swtstudy.results.history",
    "draw_load": "swtstudy.figures.definitions",
    "draw_profile": "swtstudy.figures.definitions",
    "evaluate_history": "swtstudy.faces.elements",
    "fit": "swtstudy.results.fitting",
    "inspect": "swtstudy.figures.point",
    "inspect_point": "swtstudy.results.inspection",
    "open_results": "swtstudy.archive.archive",
    "optimise": "swtstudy.results.optimise",
    "physical": "swtstudy.faces.contacts",
    "read_history": "swtstudy.faces.elements",
    "read_signal": "swtstudy.study.record",
    "read_trace": "swtstudy.study.trace",
    "run": "swtstudy.archive.run",
    "run_suite": "swtstudy.archive.run",
    "sensitivity": "swtstudy.results.sensitivity",
    "slip_map": "swtstudy.results.stress",
    "solve": "swtstudy.points.solve",
    "stress_field": "swtstudy.results.stress",
    "swt_field": "swtstudy.results.stress",
    "swt_of_history": "swtstudy.results.history",
}

__all__ = ["__version__", *_HOMES]


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


class _AfterXarray:
    """An import hook that finds no modules itself; it makes the loader of xarray register ``Dataset.swt``.

    xarray has no entry point for accessors: a package registers its own when it is imported. This package
    imports xarray, which takes ten times as long as the package itself, only when it is needed.
    """

    def find_spec(self, name: str, *_: object) -> ModuleSpec | None:
        if name != "xarray":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def execute_and_register(module: ModuleType) -> None:
                execute(module)
                importlib.import_module("swtstudy.faces.accessor")

            spec.loader.exec_module = execute_and_register  # type: ignore[method-assign]
        return spec


if "xarray" in sys.modules:
    importlib.import_module("swtstudy.faces.accessor")
else:
    sys.meta_path.insert(0, _AfterXarray())
