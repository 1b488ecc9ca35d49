"""Hertz's stress fields, from ContactMechanics: of its package, which takes seconds to import, one file."""

from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path

package = find_spec("ContactMechanics")
assert package
assert package.submodule_search_locations
file = Path(package.submodule_search_locations[0]) / "ReferenceSolutions" / "Hertz.py"
of_file = spec_from_file_location("hertz_of_contact_mechanics", file)
assert of_file
assert of_file.loader
fields = module_from_spec(of_file)
of_file.loader.exec_module(fields)

#: σ_xx, σ_yy, σ_zz, σ_yz, σ_xz, σ_xy by the pressure, and by the same traction in +x.
pressed, dragged = fields.stress_Cartesian, fields.stress_for_tangential_loading
