"""Hertz's stress fields, from ContactMechanics: of its package, which takes seconds to import, one file."""

from functools import cache
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path

import pytest


@cache
def _fields():
    package = find_spec("ContactMechanics")
    if package is None:
        pytest.skip("needs ContactMechanics")
    file = Path(package.submodule_search_locations[0]) / "ReferenceSolutions" / "Hertz.py"
    of_file = spec_from_file_location("hertz_of_contact_mechanics", file)
    module = module_from_spec(of_file)
    of_file.loader.exec_module(module)
    return module


def pressed(x, y, z, nu):
    """σ_xx, σ_yy, σ_zz, σ_yz, σ_xz, σ_xy by the pressure."""
    return _fields().stress_Cartesian(x, y, z, nu)


def dragged(x, y, z, nu):
    """The same by that traction in +x."""
    return _fields().stress_for_tangential_loading(x, y, z, nu)
