"""What makes sense of the numbers of results: the attributes of all variables, as in data/attributes.txt."""

from pathlib import Path

import pytest
import stand_in
import xarray as xr
from asking import EVERY
from folders import DATA, sections
from kept import Kept
from real import CONTACT, CRITERIA

import swtstudy

PLAIN = f"""title = "t"
quantities = {list(EVERY)}
[fixed]
frequency_ratio = "1/2"
bulk_stress_amplitude = 0.1
[axes]
friction = [0.1, 0.2]
critical_distance = [0.1, 0.2]
"""
FORCES = """title = "t"
[fixed]
criterion = "findley"
normal_sensitivity = 0.3
normal_force_amplitude = 0
tangential_force_amplitude = 0.3
profile = "wavy_cylinder"
waviness_amplitude = 0.01
wavelength = 7
[axes]
poisson_ratio = [0.1, 0.2]
"""
UNITS = (
    CRITERIA.replace("[fixed]", "findley_limit = 200\n[fixed]\nbulk_stress_amplitude = 20", 1)
    .replace("rtol = 1e-3", f"rtol = 1e-3\nquantities = {list(EVERY)}")
    .replace("[axes]", "critical_distance = 0.05\nbulk_stress_phase = 0\n[axes]")
)
LOADS = """body = 1
[loads.start-up]
absolute = true
vertices = [[150, -50, 10], [180, 60, -30], [150, 20, 5]]
[[blocks]]
load = "start-up"
rounds = 10
[sample]
design = "sobol"
size = 8
target_life = 2e5
[sample.ranges]
strength = { distribution = "normal", mean = 927, deviation = 30 }
"""
STUDIES = {"plain": PLAIN, "forces": FORCES, "units": UNITS, "loads": CONTACT + LOADS}
SAID = sections("attributes.txt")


def attributes(dataset: xr.Dataset) -> str:
    """The attributes of all variables but comments, a line for each."""
    lines = []
    for name, variable in sorted(dataset.variables.items(), key=str):
        lines.append(f"{name} ({', '.join(map(str, variable.dims))})")
        # Comments are texts of tables.
        own = {key: value for key, value in variable.attrs.items() if key != "comment"}
        lines += [f"    {key}: {value}" for key, value in own.items()]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("name", STUDIES)
def test_all_attributes_are_these(kept: Kept, tmp_path: Path, name: str) -> None:
    found = stand_in.computed(STUDIES[name], tmp_path / "a.nc")
    kept.text(DATA / "attributes.txt", SAID[name].strip(), attributes(found).strip())


def test_what_is_not_always_there_is_not_minimised() -> None:
    with pytest.raises(ValueError, match="minimise: ") as error:
        swtstudy.optimise({"friction": (0.1, 0.5)}, "radius_ratio")
    known = "s, s_surface, critical_x, critical_angle"
    assert str(error.value).endswith(f"known: {known}, {', '.join(EVERY)}")
