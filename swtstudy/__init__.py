"""Parameter studies of the Smith–Watson–Topper parameter in frictional contacts."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

from swtstudy.results.registration import register_with_xarray
from swtstudy.vocabulary.version import __version__

if TYPE_CHECKING:
    from swtstudy.archive.archive import open_results
    from swtstudy.contacts.physical import physical
    from swtstudy.fields.history import criterion_of_history, swt_of_history
    from swtstudy.fields.inspection import inspect_point
    from swtstudy.fields.stress import slip_map, stress_field, swt_field
    from swtstudy.figures.inspection import inspect
    from swtstudy.figures.load import draw_load
    from swtstudy.figures.profile import draw_profile
    from swtstudy.mechanics.indenter.profile_table import TabulatedProfile
    from swtstudy.mechanics.load.load_path import LoadPath
    from swtstudy.paper.audit.audit import audit_study
    from swtstudy.results.fitting import fit
    from swtstudy.results.optimise import optimise
    from swtstudy.results.sensitivity import sensitivity
    from swtstudy.runner.run import run, run_suite
    from swtstudy.solving import solve
    from swtstudy.study.definition import Study
    from swtstudy.study.signal import read_signal
    from swtstudy.study.trace import read_trace
    from swtstudy.units.life import FatigueConstants, ShearConstants
    from swtstudy.vocabulary.mistakes import StudyError

__all__ = [
    "FatigueConstants",
    "LoadPath",
    "ShearConstants",
    "Study",
    "StudyError",
    "TabulatedProfile",
    "__version__",
    "audit_study",
    "criterion_of_history",
    "draw_load",
    "draw_profile",
    "fit",
    "inspect",
    "inspect_point",
    "open_results",
    "optimise",
    "physical",
    "read_signal",
    "read_trace",
    "run",
    "run_suite",
    "sensitivity",
    "slip_map",
    "solve",
    "stress_field",
    "swt_field",
    "swt_of_history",
]

# Imported on first use: the command line starts in a tenth of the time that xarray takes to import.
_HOMES = {
    "FatigueConstants": "swtstudy.units.life",
    "LoadPath": "swtstudy.mechanics.load.load_path",
    "ShearConstants": "swtstudy.units.life",
    "Study": "swtstudy.study.definition",
    "StudyError": "swtstudy.vocabulary.mistakes",
    "TabulatedProfile": "swtstudy.mechanics.indenter.profile_table",
    "audit_study": "swtstudy.paper.audit.audit",
    "criterion_of_history": "swtstudy.fields.history",
    "draw_load": "swtstudy.figures.load",
    "draw_profile": "swtstudy.figures.profile",
    "fit": "swtstudy.results.fitting",
    "inspect": "swtstudy.figures.inspection",
    "inspect_point": "swtstudy.fields.inspection",
    "open_results": "swtstudy.archive.archive",
    "optimise": "swtstudy.results.optimise",
    "physical": "swtstudy.contacts.physical",
    "read_signal": "swtstudy.study.signal",
    "read_trace": "swtstudy.study.trace",
    "run": "swtstudy.runner.run",
    "run_suite": "swtstudy.runner.run",
    "sensitivity": "swtstudy.results.sensitivity",
    "slip_map": "swtstudy.fields.stress",
    "solve": "swtstudy.solving",
    "stress_field": "swtstudy.fields.stress",
    "swt_field": "swtstudy.fields.stress",
    "swt_of_history": "swtstudy.fields.history",
}


def __getattr__(name: str) -> object:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)


register_with_xarray()
