"""Hertz's stress fields, from ContactMechanics: of its package, which takes seconds to import, one file.

And the stress at the edge of a sphere under a constant normal load, in closed form.
"""

from functools import cache
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
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


def at_the_edge(nu, mu, amplitude):
    """Stress at |x| = a for δA = 0 over p0 = 2/π, where the load turns (Cattaneo and Mindlin).

    σ_xx = −σ_yy by the pressure, then σ_xx and σ_yy by the traction.
    """
    width = np.arcsin(np.sqrt(amplitude))
    first = 0.5 * width + 0.25 * np.sin(2.0 * width)
    third = width / 8.0 - np.sin(4.0 * width) / 32.0
    return (1.0 - 2.0 * nu) / 3.0, 2.0 * mu * (first + nu * third), 2.0 * nu * mu * (first - third)


def s_at_the_edge(nu, mu, amplitude):
    """s of that stress."""
    spread, pull, across = at_the_edge(nu, mu, amplitude)
    return 4.0 / np.pi**2 * (spread + pull) * (pull - nu * across) / (1.0 - nu**2)
