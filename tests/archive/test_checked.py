"""All that is said of an archive that no run has written, in whole messages."""

import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import stand_in
import xarray as xr
from made_up import having
from real import CONTACT

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


def said(dataset: xr.Dataset, folder: Path) -> str:
    """What opening an archive with this content says."""
    dataset.to_netcdf(folder / "a.nc")
    try:
        open_results(folder / "a.nc")
    except ValueError as error:
        text = str(error).replace(f"{folder}/a.nc: ", "")
        return re.sub("allowed: poisson_ratio, .*", "allowed: a parameter", text)
    return ""


def attribute(value: object, name: str, owner: str = "") -> Callable:
    def change(dataset: xr.Dataset) -> xr.Dataset:
        dataset = dataset.copy(deep=True)
        attributes = dataset[owner].attrs if owner else dataset.attrs
        attributes.pop(name)
        attributes |= {} if value is None else {name: value}
        return dataset

    return change


def without(*names: str) -> Callable:
    return lambda dataset: dataset.drop_vars(names)


DEEP = "[" * 100_000 + "]" * 100_000
RUN = '[{"solver_version": "3", "rtol": "1e-3", "study": "", "versions": ""}]'
CHANGES: list[tuple[str, Callable, str]] = [
    ("plain", lambda found: found, ("")),
    (
        "plain",
        having("status", 7),
        ("status: found 7 at friction=0.1, phase=0.0 and 3 more; allowed: 0 to 2"),
    ),
    (
        "plain",
        having("status", 3, friction=0, phase=1),
        ("status: found 3 at friction=0.1, phase=1.0; allowed: 0 to 2"),
    ),
    (
        "plain",
        having("status", -1, friction=1),
        ("status: found -1 at friction=0.2, phase=0.0 and 1 more; allowed: 0 to 2"),
    ),
    (
        "plain",
        having("run", 1, friction=0),
        ("run: found 1 at friction=0.1, phase=0.0 and 1 more; allowed: -1 to 0"),
    ),
    ("plain", having("run", -1, friction=0), ("")),
    (
        "plain",
        having("run", -2, friction=0),
        ("run: found -2 at friction=0.1, phase=0.0 and 1 more; allowed: -1 to 0"),
    ),
    (
        "plain",
        having("regime", 6, friction=0),
        ("regime: found 6 at friction=0.1, phase=0.0 and 1 more; allowed: 0 to 5"),
    ),
    (
        "plain",
        having("regime", -1, friction=0),
        ("regime: found -1 at friction=0.1, phase=0.0 and 1 more; allowed: 0 to 5"),
    ),
    (
        "plain",
        having("s", np.nan, friction=0),
        ("s: found nan at friction=0.1, phase=0.0 and 1 more; allowed: a finite number, 0 or more"),
    ),
    (
        "plain",
        having("s", np.inf, friction=0, phase=0),
        ("s: found inf at friction=0.1, phase=0.0; allowed: a finite number, 0 or more"),
    ),
    (
        "plain",
        having("s", -1e-9, friction=0),
        ("s: found -1e-09 at friction=0.1, phase=0.0 and 1 more; allowed: a finite number, 0 or more"),
    ),
    ("plain", having("s", 0.0), ("")),
    (
        "plain",
        having("s_error", -1e-9, friction=0),
        ("s_error: found -1e-09 at friction=0.1, phase=0.0 and 1 more; allowed: 0 or more"),
    ),
    ("plain", having("s_error", 0.0), ("")),
    (
        "plain",
        lambda found: having("s", -1.0)(having("regime", 4)(found)),
        ("s: found -1.0 at friction=0.1, phase=0.0 and 3 more; allowed: 0 or more"),
    ),
    ("plain", lambda found: having("s", np.nan)(having("regime", 5)(found)), ("")),
    ("plain", lambda found: having("s", -1.0)(having("status", 1)(found)), ("")),
    (
        "plain",
        lambda found: found.assign_coords(phase=[0.0, np.nan]),
        ('phase: found nan (not a finite number); allowed: a finite angle in [-1000, 1000] rad, or "90 deg"'),
    ),
    (
        "plain",
        lambda found: found.assign_coords(friction=[-1.0, -2.0]),
        ("friction: found -1.0 (out of range); allowed: a number in [0, 10]"),
    ),
    (
        "plain",
        lambda found: found.assign_coords(profile="qaraboloid", poisson_ratio=0.7),
        (
            "poisson_ratio: found 0.7 (out of range); allowed: a number in [0, 0.5]\n"
            "profile: found 'qaraboloid' (no such profile); allowed: one of paraboloid, "
            "rounded_punch, truncated_paraboloid, wavy_paraboloid, power_law, cylinder, "
            "rounded_flat, wavy_cylinder, power_law_cylinder"
        ),
    ),
    (
        "plain",
        lambda found: found.assign_coords(profile="rounded_punch"),
        ("flat_radius: found nothing; allowed: a number in [0, 100]"),
    ),
    ("plain", lambda found: found.assign_coords(profile="rounded_punch", flat_radius=0.5), ("")),
    (
        "plain",
        lambda found: found.assign_coords(flat_radius=("phase", [0.1, 0.2])),
        ("flat_radius: found dimensions ('phase',); allowed: an axis of s, or a single value"),
    ),
    (
        "plain",
        lambda found: found.assign_coords(poisson_ratio=("body", [0.1, 0.2])),
        (
            "poisson_ratio: found dimensions ('body',); allowed: an axis of s, or a single value\n"
            "poisson_ratio: found nothing; allowed: a number in [0, 0.5]"
        ),
    ),
    (
        "plain",
        lambda found: found.assign_coords(control="forces"),
        ("control: found 'forces'; allowed: 'displacements'"),
    ),
    (
        "plain",
        lambda found: found.assign_coords(normal_force_amplitude=0.1),
        (
            "normal_amplitude, normal_force_amplitude: found both; allowed: one of the two: it "
            "says what is prescribed\n"
            "control: found 'displacements'; allowed: 'normal_force+tangential_displacement'"
        ),
    ),
    (
        "plain",
        without("phase"),
        ("phase: found a dimension without values of a parameter; allowed: a parameter"),
    ),
    (
        "plain",
        without("friction"),
        ("friction: found a dimension without values of a parameter; allowed: a parameter"),
    ),
    (
        "plain",
        without("poisson_ratio", "tangential_amplitude"),
        (
            "poisson_ratio: found nothing; allowed: a number in [0, 0.5]\n"
            "tangential_amplitude: found nothing; allowed: a number in [0, 100]"
        ),
    ),
    (
        "plain",
        without("frequency_ratio"),
        ("frequency_ratio: found nothing; allowed: a positive rational p/q with p, q ≤ 64"),
    ),
    ("plain", lambda found: found.isel(friction=0), ("")),
    ("plain", lambda found: found.isel(friction=0, phase=0), ("")),
    ("plain", lambda found: found.transpose("phase", ...), ("")),
    (
        "plain",
        lambda found: found.expand_dims("sample"),
        ("sample: found a dimension without values of a parameter; allowed: a parameter"),
    ),
    (
        "plain",
        lambda found: found.expand_dims(sample=[1]),
        ("sample: found a dimension without values of a parameter; allowed: a parameter"),
    ),
    (
        "plain",
        without("s_surface", "dissipation_error"),
        (
            "s_surface: found nothing; allowed: a variable that an archive of this version has\n"
            "dissipation_error: found nothing; allowed: a variable that an archive of this "
            "version has"
        ),
    ),
    (
        "plain",
        without("s_volume"),
        ("s_volume: found nothing; allowed: a variable that an archive of this version has"),
    ),
    ("plain", without("s_error", "status"), ("an archive changed by another program (no s_error, status)")),
    ("plain", without("s"), ("an archive changed by another program (no s)")),
    ("plain", without("control"), ("an archive changed by another program (no control)")),
    (
        "plain",
        lambda found: found.assign(run=found.run[0], s_volume=found.s_volume.isel(critical_distance=0)),
        (
            "run: found dimensions ('phase',); allowed: those of s, ('friction', 'phase')\n"
            "s_volume: found dimensions ('friction', 'phase'); allowed: those of s, ('friction', "
            "'phase') and critical_distance"
        ),
    ),
    (
        "plain",
        lambda found: found.assign(regime=found.regime.astype(str), s_error=found.s_error.astype(str)),
        (
            "s_error: found values of type <U21; allowed: numbers\n"
            "regime: found values of type <U1; allowed: numbers"
        ),
    ),
    ("plain", attribute(None, "history"), ("an archive changed by another program (no history)")),
    ("plain", attribute(None, "rtol"), ("an archive changed by another program (no rtol)")),
    (
        "plain",
        attribute(None, "flag_meanings", "status"),
        ("an archive changed by another program (no flag_meanings of status)"),
    ),
    ("plain", attribute(3, "title"), ("attribute title: found 3; allowed: a text")),
    ("plain", attribute(0.5, "rtol"), ("attribute rtol: found 0.5; allowed: a number in [1e-07, 0.1]")),
    ("plain", attribute(1e-7, "rtol"), ("")),
    (
        "plain",
        attribute("tight", "rtol"),
        ("attribute rtol: found 'tight'; allowed: a number in [1e-07, 0.1]"),
    ),
    (
        "plain",
        attribute("long", "wall_time_seconds"),
        ("attribute wall_time_seconds: found 'long'; allowed: a number of seconds"),
    ),
    (
        "plain",
        attribute(-1.0, "wall_time_seconds"),
        ("attribute wall_time_seconds: found -1.0; allowed: a number of seconds"),
    ),
    ("plain", attribute(0.0, "wall_time_seconds"), ("")),
    (
        "plain",
        attribute(np.inf, "wall_time_seconds"),
        ("attribute wall_time_seconds: found inf; allowed: a number of seconds"),
    ),
    ("plain", attribute([1, 2], "source"), ("attribute source: found [1, 2]; allowed: a text")),
    (
        "plain",
        attribute("{}", "runs"),
        ("attribute runs: found '{}' (Input should be a valid array); allowed: JSON as swtstudy writes it"),
    ),
    (
        "plain",
        attribute("[]", "runs"),
        ("run: found 0 at friction=0.1, phase=0.0 and 3 more; allowed: -1 to -1"),
    ),
    (
        "plain",
        attribute("[1]", "figure"),
        ("attribute figure: found '[1]' (Input should be an object); allowed: JSON as swtstudy writes it"),
    ),
    (
        "plain",
        attribute(json.dumps({"x": "phase", "y": []}), "figure"),
        (
            'attribute figure: found \'{"x": "phase", "y": []}\' (y: found an empty list; allowed: '
            "at least one of s, s_error, critical_x, critical_angle, regime, s_surface, status, "
            'run, or "s/s(name=value)"); allowed: JSON as swtstudy writes it'
        ),
    ),
    (
        "plain",
        attribute(json.dumps({"x": "phase", "y": ["speed"]}), "figure"),
        (
            'attribute figure: found \'{"x": "phase", "y": ["speed"]}\' (\'speed\' is not a '
            "quantity); allowed: JSON as swtstudy writes it"
        ),
    ),
    (
        "plain",
        attribute(json.dumps({"x": "phase", "y": ["SWT"]}), "figure"),
        (
            'attribute figure: found \'{"x": "phase", "y": ["SWT"]}\' (\'SWT\' is not a quantity); '
            "allowed: JSON as swtstudy writes it"
        ),
    ),
    (
        "plain",
        attribute("slip", "flag_meanings", "regime"),
        (
            "attribute flag_meanings of regime: found 'slip'; allowed: 'stick partial_slip "
            "gross_slip lift_off not_finite no_equil…"
        ),
    ),
    (
        "plain",
        attribute("no", "flag_meanings", "status"),
        ("attribute flag_meanings of status: found 'no'; allowed: 'computed failed missing'"),
    ),
    (
        "plain",
        attribute("rad", "units", "critical_angle"),
        ("attribute units of critical_angle: found 'rad'; allowed: 'degree'"),
    ),
    (
        "plain",
        attribute("degree", "units", "phase"),
        ("attribute units of phase: found 'degree'; allowed: 'rad'"),
    ),
    (
        "plain",
        lambda found: found.assign(dissipation=found.dissipation.assign_attrs(units="J")),
        ("attribute units of dissipation: found 'J'; allowed: '1'"),
    ),
    (
        "plain",
        lambda found: found.assign_attrs(definitions="[3]"),
        (
            "attribute definitions: found '[3]' (not definitions: '[3]' ('int' object is not "
            "subscriptable)); allowed: JSON as swtstudy writes it"
        ),
    ),
    (
        "plain",
        lambda found: found.assign_attrs(definitions="no"),
        (
            "attribute definitions: found 'no' (not definitions: 'no' (expected ident at line 1 "
            "column 2)); allowed: JSON as swtstudy writes it"
        ),
    ),
    (
        "plain",
        lambda found: found.assign_attrs(contact="{}"),
        (
            "young_modulus: found nothing; allowed: a positive stress\n"
            "radius: found nothing; allowed: a positive length\n"
            "depth, normal_force: found neither; allowed: one of the two: it says how deep the "
            "contact is"
        ),
    ),
    ("rig", lambda found: found, ("")),
    ("rig", attribute("{}", "contact"), ("")),
    (
        "rig",
        attribute(None, "contact"),
        (
            "attribute units of normal_amplitude: found 'mm'; allowed: '1'\n"
            "attribute units of tangential_force_amplitude: found 'N'; allowed: '1'\n"
            "attribute units of contact_radius: found 'mm'; allowed: '1'\n"
            "attribute units of von_mises: found 'MPa'; allowed: '1'"
        ),
    ),
    ("rig", without("young_modulus", "friction"), ("friction: found nothing; allowed: a number in [0, 10]")),
    ("rig", without("radius"), ("radius: found nothing; allowed: a positive length in mm")),
    (
        "rig",
        lambda found: found.assign_coords(depth=0.01),
        ("depth, normal_force: found both; allowed: one of the two: it says how deep the contact is"),
    ),
    (
        "rig",
        having("s", -1.0),
        ("s: found -1.0 at tangential_force_amplitude=20.0 and 1 more; allowed: a finite number, 0 or more"),
    ),
    (
        "rig",
        lambda found: found.assign_coords(tangential_force_amplitude=[-1.0, 60.0]),
        ("tangential_force_amplitude: found -1.0 (out of range); allowed: a force in N, ≥ 0"),
    ),
    (
        "rig",
        without("normal_force"),
        ("depth, normal_force: found neither; allowed: one of the two: it says how deep the contact is"),
    ),
    ("rig", lambda found: found.drop_vars("SWT"), ("")),
    (
        "rig",
        lambda found: found.rename(tangential_force_amplitude="tangential_amplitude"),
        ("control: found 'normal_displacement+tangential_force'; allowed: 'displacements'"),
    ),
    (
        "plain",
        lambda found: found.assign(mine=found.s).assign_attrs(figure='{"x": "phase", "y": ["mine"]}'),
        'attribute figure: found \'{"x": "phase", "y": ["mine"]}\' (\'mine\' is not a quantity); '
        "allowed: JSON as swtstudy writes it",
    ),
    *(
        ("plain", attribute(value, name), f"attribute {name}: found {value}; allowed: a text")
        for name, value in (("history", 3), ("study", 1.5), ("versions", 1.5))
    ),
    *(
        (
            "plain",
            attribute(value, name),
            f"attribute {name}: found {words}; allowed: JSON as swtstudy writes it",
        )
        for name, value, words in (
            ("figure", 3, "3 (JSON input should be string, bytes or bytearray)"),
            ("figure", '{"x": null}', """'{"x": null}' (x: Input should be a valid string)"""),
            (
                "figure",
                '{"x": "phase", "y": ["s"], "kind": ["lines"]}',
                """'{"x": "phase", "y": ["s"], "kind": ["lines"]}' (kind: Input should be a valid string)""",
            ),
            ("runs", DEEP, f"'{DEEP[:58]}… (Invalid JSON: recursion limit exceeded at line 1 column 202)"),
            ("runs", "[1]", "'[1]' (0: Input should be an object)"),
            ("runs", "no", "'no' (Invalid JSON: expected ident at line 1 column 2)"),
            ("runs", RUN, f"'{RUN[:58]}… (0: rtol: Input should be a valid number)"),
            ("runs", '[{"rtol": 1e-3}]', """'[{"rtol": 1e-3}]' (0: solver_version: Field required)"""),
        )
    ),
]


@pytest.mark.parametrize(("name", "change", "words"), CHANGES)
def test_what_no_run_writes_is_named(
    archives: dict[str, xr.Dataset], tmp_path: Path, name: str, change: Callable, words: str
) -> None:
    assert said(change(archives[name]), tmp_path) == words
