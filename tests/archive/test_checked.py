"""All that is said of an archive that no run has written, in whole messages."""

# ruff: noqa: F401  names in expressions

import json
import re
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from made_up import having
from real import CONTACT
from told import sayings

from swtstudy import open_results

PLAIN = """title = "t"
rtol = 1e-3
quantities = ["dissipation"]
[axes]
friction = [0.1, 0.2]
phase = [0, 1]
critical_distance = [0.1, 0.25]
[figure]
x = "phase"
hue = "friction"
y = ["s", "s/s(phase=0)", "dissipation"]
"""
RIG = f"""{CONTACT}normal_force = 200
[axes]
tangential_force_amplitude = [20, 60]
"""


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> dict[str, xr.Dataset]:
    """Archives as they are written, by the name of their study."""
    folder = tmp_path_factory.mktemp("archives")
    studies = {"plain": PLAIN, "rig": RIG}
    return {name: stand_in.computed(text, folder / f"{name}.nc") for name, text in studies.items()}


def said(dataset: xr.Dataset, folder: Path) -> list[str]:
    """Lines that opening an archive with this content says; none if it opens."""
    dataset.to_netcdf(folder / "a.nc")
    try:
        open_results(folder / "a.nc")
    except ValueError as error:
        text = str(error).replace(f"{folder}/a.nc: ", "")
        return re.sub("allowed: poisson_ratio, .*", "allowed: a parameter", text).splitlines()
    return []


def attribute(dataset: xr.Dataset, name: str, value: object = None, owner: str = "") -> xr.Dataset:
    """The archive with another attribute of a variable or of its own, or without it."""
    dataset = dataset.copy(deep=True)
    attributes = dataset[owner].attrs if owner else dataset.attrs
    attributes.pop(name)
    attributes |= {} if value is None else {name: value}
    return dataset


DEEP = "[" * 100_000 + "]" * 100_000
RUN = '[{"solver_version": "3", "rtol": "1e-3", "study": "", "versions": ""}]'
#: Archives with a change, and what is said of it.
CHANGES = sayings(r"""
plain
having("status", 7)(plain) » status: found 7 at friction=0.1, phase=0.0 and 3 more; allowed: 0 to 2
having("status", 3, friction=0, phase=1)(plain) » status: found 3 at friction=0.1, phase=1.0; allowed: 0 to 2
having("status", -1, friction=1)(plain)
» status: found -1 at friction=0.2, phase=0.0 and 1 more; allowed: 0 to 2
having("run", 1, friction=0)(plain) » run: found 1 at friction=0.1, phase=0.0 and 1 more; allowed: -1 to 0
having("run", -1, friction=0)(plain)
having("run", -2, friction=0)(plain) » run: found -2 at friction=0.1, phase=0.0 and 1 more; allowed: -1 to 0
having("regime", 6, friction=0)(plain)
» regime: found 6 at friction=0.1, phase=0.0 and 1 more; allowed: 0 to 5
having("regime", -1, friction=0)(plain)
» regime: found -1 at friction=0.1, phase=0.0 and 1 more; allowed: 0 to 5
having("s", np.nan, friction=0)(plain)
» s: found nan at friction=0.1, phase=0.0 and 1 more; allowed: a finite number, 0 or more
having("s", np.inf, friction=0, phase=0)(plain)
» s: found inf at friction=0.1, phase=0.0; allowed: a finite number, 0 or more
having("s", -1e-9, friction=0)(plain)
» s: found -1e-09 at friction=0.1, phase=0.0 and 1 more; allowed: a finite number, 0 or more
having("s", 0.0)(plain)
having("s_error", -1e-9, friction=0)(plain)
» s_error: found -1e-09 at friction=0.1, phase=0.0 and 1 more; allowed: 0 or more
having("s_error", 0.0)(plain)
having("s", -1.0)(having("regime", 4)(plain))
» s: found -1.0 at friction=0.1, phase=0.0 and 3 more; allowed: 0 or more
having("s", np.nan)(having("regime", 5)(plain))
having("s", -1.0)(having("status", 1)(plain))
plain.assign_coords(phase=[0.0, np.nan])
» phase: found nan (not a finite number); allowed: a finite angle in [-1000, 1000] rad, or "90 deg"
plain.assign_coords(friction=[-1.0, -2.0]) » friction: found -1.0 (out of range); allowed: a number in [0, 10]
plain.assign_coords(profile="qaraboloid", poisson_ratio=0.7)
» poisson_ratio: found 0.7 (out of range); allowed: a number in [0, 0.5]
» profile: found 'qaraboloid' (no such profile); allowed: one of paraboloid, rounded_punch,
    truncated_paraboloid, wavy_paraboloid, power_law, cylinder, rounded_flat, wavy_cylinder,
    power_law_cylinder
plain.assign_coords(profile="rounded_punch") » flat_radius: found nothing; allowed: a number in [0, 100]
plain.assign_coords(profile="rounded_punch", flat_radius=0.5)
plain.assign_coords(flat_radius=("phase", [0.1, 0.2]))
» flat_radius: found dimensions ('phase',); allowed: an axis of s, or a single value
plain.assign_coords(poisson_ratio=("body", [0.1, 0.2]))
» poisson_ratio: found dimensions ('body',); allowed: an axis of s, or a single value
» poisson_ratio: found nothing; allowed: a number in [0, 0.5]
plain.assign_coords(control="forces") » control: found 'forces'; allowed: 'displacements'
plain.assign_coords(normal_force_amplitude=0.1)
» normal_amplitude, normal_force_amplitude: found both; allowed: one of the two: it says what is prescribed
» control: found 'displacements'; allowed: 'normal_force+tangential_displacement'
plain.drop_vars("phase") » phase: found a dimension without values of a parameter; allowed: a parameter
plain.drop_vars("friction") » friction: found a dimension without values of a parameter; allowed: a parameter
plain.drop_vars(["poisson_ratio", "tangential_amplitude"])
» poisson_ratio: found nothing; allowed: a number in [0, 0.5]
» tangential_amplitude: found nothing; allowed: a number in [0, 100]
plain.drop_vars("frequency_ratio")
» frequency_ratio: found nothing; allowed: a positive rational p/q with p, q ≤ 64
plain.isel(friction=0)
plain.isel(friction=0, phase=0)
plain.transpose("phase", ...)
plain.expand_dims("sample") » sample: found a dimension without values of a parameter; allowed: a parameter
plain.expand_dims(sample=[1]) » sample: found a dimension without values of a parameter; allowed: a parameter
plain.drop_vars(["s_surface", "dissipation_error"])
» s_surface: found nothing; allowed: a variable that an archive of this version has
» dissipation_error: found nothing; allowed: a variable that an archive of this version has
plain.drop_vars("s_volume") » s_volume: found nothing; allowed: a variable that an archive of this version has
plain.drop_vars(["s_error", "status"]) » an archive changed by another program (no s_error, status)
plain.drop_vars("s") » an archive changed by another program (no s)
plain.drop_vars("control") » an archive changed by another program (no control)
plain.assign(run=plain.run[0], s_volume=plain.s_volume.isel(critical_distance=0))
» run: found dimensions ('phase',); allowed: those of s, ('friction', 'phase')
» s_volume: found dimensions ('friction', 'phase'); allowed: those of s, ('friction', 'phase') and
    critical_distance
plain.assign(regime=plain.regime.astype(str), s_error=plain.s_error.astype(str))
» s_error: found values of type <U21; allowed: numbers
» regime: found values of type <U1; allowed: numbers
attribute(plain, "history") » an archive changed by another program (no history)
attribute(plain, "rtol") » an archive changed by another program (no rtol)
attribute(plain, "flag_meanings", owner="status")
» an archive changed by another program (no flag_meanings of status)
plain.assign_attrs(title=3) » attribute title: found 3; allowed: a text
plain.assign_attrs(rtol=0.5) » attribute rtol: found 0.5; allowed: a number in [1e-07, 0.1]
plain.assign_attrs(rtol=1e-7)
plain.assign_attrs(rtol="tight") » attribute rtol: found 'tight'; allowed: a number in [1e-07, 0.1]
plain.assign_attrs(wall_time_seconds="long")
» attribute wall_time_seconds: found 'long'; allowed: a number of seconds
plain.assign_attrs(wall_time_seconds=-1.0)
» attribute wall_time_seconds: found -1.0; allowed: a number of seconds
plain.assign_attrs(wall_time_seconds=0.0)
plain.assign_attrs(wall_time_seconds=np.inf)
» attribute wall_time_seconds: found inf; allowed: a number of seconds
plain.assign_attrs(source=[1, 2]) » attribute source: found array([1, 2]); allowed: a text
plain.assign_attrs(runs="{}")
» attribute runs: found '{}' (Input should be a valid array); allowed: JSON as swtstudy writes it
plain.assign_attrs(runs="[]") » run: found 0 at friction=0.1, phase=0.0 and 3 more; allowed: -1 to -1
plain.assign_attrs(figure="[1]")
» attribute figure: found '[1]' (Input should be an object); allowed: JSON as swtstudy writes it
plain.assign_attrs(figure=json.dumps({"x": "phase", "y": []}))
» attribute figure: found '{"x": "phase", "y": []}' (y: found an empty list; allowed: at least one of s,
    s_error, critical_x, critical_angle, regime, s_surface, status, run, or "s/s(name=value)"); allowed: JSON
    as swtstudy writes it
plain.assign_attrs(figure=json.dumps({"x": "phase", "y": ["speed"]}))
» attribute figure: found '{"x": "phase", "y": ["speed"]}' ('speed' is not a quantity); allowed: JSON as
    swtstudy writes it
plain.assign_attrs(figure=json.dumps({"x": "phase", "y": ["SWT"]}))
» attribute figure: found '{"x": "phase", "y": ["SWT"]}' ('SWT' is not a quantity); allowed: JSON as swtstudy
    writes it
attribute(plain, "flag_meanings", "slip", "regime")
» attribute flag_meanings of regime: found 'slip'; allowed: 'stick partial_slip gross_slip lift_off not_finite
    no_equil…
attribute(plain, "flag_meanings", "no", "status")
» attribute flag_meanings of status: found 'no'; allowed: 'computed failed missing'
attribute(plain, "units", "rad", "critical_angle")
» attribute units of critical_angle: found 'rad'; allowed: 'degree'
attribute(plain, "units", "degree", "phase") » attribute units of phase: found 'degree'; allowed: 'rad'
plain.assign(dissipation=plain.dissipation.assign_attrs(units="J"))
» attribute units of dissipation: found 'J'; allowed: '1'
plain.assign_attrs(definitions="[3]")
» attribute definitions: found '[3]' (not definitions: '[3]' ('int' object is not subscriptable)); allowed:
    JSON as swtstudy writes it
plain.assign_attrs(definitions="no")
» attribute definitions: found 'no' (not definitions: 'no' (expected ident at line 1 column 2)); allowed: JSON
    as swtstudy writes it
plain.assign_attrs(contact="{}")
» young_modulus: found nothing; allowed: a positive stress
» radius: found nothing; allowed: a positive length
» depth, normal_force: found neither; allowed: one of the two: it says how deep the contact is
rig
rig.assign_attrs(contact="{}")
» attribute units of young_modulus: found 'MPa'; allowed: ''
» attribute units of radius: found 'mm'; allowed: ''
» attribute units of normal_force: found 'N'; allowed: ''
» attribute units of normal_amplitude: found 'mm'; allowed: ''
» attribute units of tangential_force_amplitude: found 'N'; allowed: ''
attribute(rig, "contact")
» attribute units of contact_radius: found 'mm'; allowed: '1'
» attribute units of von_mises: found 'MPa'; allowed: '1'
rig.drop_vars(["young_modulus", "friction"]) » friction: found nothing; allowed: a number in [0, 10]
rig.drop_vars("radius") » radius: found nothing; allowed: a positive length in mm
rig.assign_coords(depth=0.01)
» depth, normal_force: found both; allowed: one of the two: it says how deep the contact is
having("s", -1.0)(rig)
» s: found -1.0 at tangential_force_amplitude=20.0 and 1 more; allowed: a finite number, 0 or more
rig.assign_coords(tangential_force_amplitude=[-1.0, 60.0])
» tangential_force_amplitude: found -1.0 (out of range); allowed: a force in N, ≥ 0
rig.drop_vars("normal_force")
» depth, normal_force: found neither; allowed: one of the two: it says how deep the contact is
rig.drop_vars("SWT")
rig.rename(tangential_force_amplitude="tangential_amplitude")
» control: found 'normal_displacement+tangential_force'; allowed: 'displacements'
plain.assign(mine=plain.s).assign_attrs(figure='{"x": "phase", "y": ["mine"]}')
» attribute figure: found '{"x": "phase", "y": ["mine"]}' ('mine' is not a quantity); allowed: JSON as
    swtstudy writes it
plain.assign_attrs(history=3) » attribute history: found 3; allowed: a text
plain.assign_attrs(study=1.5) » attribute study: found 1.5; allowed: a text
plain.assign_attrs(versions=1.5) » attribute versions: found 1.5; allowed: a text
plain.assign_attrs(figure=3)
» attribute figure: found 3 (JSON input should be string, bytes or bytearray); allowed: JSON as swtstudy
    writes it
plain.assign_attrs(figure='{"x": null}')
» attribute figure: found '{"x": null}' (x: Input should be a valid string); allowed: JSON as swtstudy writes
    it
plain.assign_attrs(figure='{"x": "phase", "y": ["s"], "kind": ["lines"]}')
» attribute figure: found '{"x": "phase", "y": ["s"], "kind": ["lines"]}' (kind: Input should be a valid
    string); allowed: JSON as swtstudy writes it
plain.assign_attrs(runs=DEEP)
» attribute runs: found '[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[… (Invalid JSON: recursion
    limit exceeded at line 1 column 202); allowed: JSON as swtstudy writes it
plain.assign_attrs(runs="[1]")
» attribute runs: found '[1]' (0: Input should be an object); allowed: JSON as swtstudy writes it
plain.assign_attrs(runs="no")
» attribute runs: found 'no' (Invalid JSON: expected ident at line 1 column 2); allowed: JSON as swtstudy
    writes it
plain.assign_attrs(runs=RUN)
» attribute runs: found '[{"solver_version": "3", "rtol": "1e-3", "study": "", "ver… (0: rtol: Input should be
    a valid number); allowed: JSON as swtstudy writes it
plain.assign_attrs(runs='[{"rtol": 1e-3}]')
» attribute runs: found '[{"rtol": 1e-3}]' (0: solver_version: Field required); allowed: JSON as swtstudy
    writes it
""")


@pytest.mark.parametrize(("change", "words"), CHANGES)
def test_what_no_run_writes_is_named(
    archives: dict[str, xr.Dataset], tmp_path: Path, change: str, words: list[str]
) -> None:
    assert said(eval(change, globals() | archives), tmp_path) == words
