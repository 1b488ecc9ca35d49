"""All attributes of coordinates and of s, and which coordinates results have."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import xarray as xr

from swtstudy import Study
from swtstudy.points.solve import label, values_along


def labelled(text: str, **changes: Any) -> xr.Dataset:
    """Results of a study in which s counts the points."""
    study = Study.from_text(f'title = "t"\n{text}\n')
    grid = replace(study.grid, **changes)
    return label(grid, {"s": np.arange(float(grid.size))}, study.asked)


CONTROL = {
    "long_name": "what is prescribed",
    "comment": "one of displacements, forces, normal_force+tangential_displacement, "
    "normal_displacement+tangential_force",
}
BESIDE = (
    "on the surface line y = 0: a criterion of shear may be larger beside that line or beneath the surface, "
)
BESIDE += (
    "where friction is below 0.3, the Poisson ratio below 0.1 or the tangential motion small: swtstudy audit "
)
BESIDE += "compares"
#: Attributes of coordinates: the name, the meaning and the symbol, and more.
TOLD: dict[str, tuple[str, str, str, dict[str, str]]] = {
    "poisson_ratio": ("Poisson ratio", "Poisson ratio", r"\nu", {}),
    "friction": ("coefficient of friction", "coefficient of friction", r"\mu", {}),
    "normal_amplitude": ("normal amplitude", "amplitude of the normal oscillation", r"\delta_A/\delta_0", {}),
    "frequency_ratio": (
        "frequency ratio",
        "frequency of the tangential over that of the normal oscillation",
        r"\omega_2/\omega_1",
        {"fractions": "1"},
    ),
    "tangential_amplitude": (
        "tangential amplitude",
        "amplitude of the tangential oscillation",
        r"G^* u_A/(\mu E^* \delta_0)",
        {},
    ),
    "phase": ("phase", "phase of the normal oscillation", r"\psi", {"units": "rad"}),
    "profile": ("profile of the indenter", "profile of the indenter", "f", {}),
    "flat_radius": ("radius of the punch face", "radius of the punch face", "b/a_H", {}),
    "criterion": ("criterion", "criterion of which s is the largest value", r"\mathrm{criterion}", {}),
    "normal_sensitivity": (
        "normal sensitivity",
        "sensitivity of a criterion of shear to the normal stress",
        "k",
        {},
    ),
    "critical_distance": ("critical distance", "critical distance of the nonlocal values", r"\ell/a_H", {}),
}
PLAIN = ["poisson_ratio", "friction", "normal_amplitude", "frequency_ratio", "tangential_amplitude", "phase"]


@pytest.mark.parametrize(
    ("text", "dims", "others"),
    [
        ("", {}, ["profile"]),
        (
            'axes = {profile = ["rounded_punch", "paraboloid"], flat_radius = [0.5, 0.2]}',
            {"profile": ["rounded_punch", "paraboloid"], "flat_radius": [0.5, 0.2]},
            ["profile", "flat_radius"],
        ),
        (
            'fixed = {criterion = "findley", normal_sensitivity = 0.3}\naxes.phase = [1, 0]',
            {"phase": [1.0, 0.0]},
            ["profile", "criterion", "normal_sensitivity"],
        ),
        (
            "fixed.critical_distance = 0.1",
            {"direction": ["depth", "critical_plane"]},
            ["profile", "critical_distance"],
        ),
        (
            "axes.critical_distance = [0.2, 0.1]",
            {"critical_distance": [0.2, 0.1], "direction": ["depth", "critical_plane"]},
            ["profile", "critical_distance"],
        ),
        ("fixed.bulk_stress_amplitude = 0", {}, ["profile"]),
    ],
)
def test_coordinates_and_their_attributes(text: str, dims: dict[str, list[Any]], others: list[str]) -> None:
    found = labelled(text)
    said = {*PLAIN, *others, "control", *dims}
    assert {*found.coords} == said
    assert {name: found[name].values.tolist() for name in found.coords if found[name].dims} == dims
    for name in said - {"control", "direction"}:
        long_name, comment, symbol, more = TOLD[name]
        expected = {"long_name": long_name, "comment": comment, "symbol": symbol, **more}
        assert found[name].attrs == expected, name
    assert found.control.attrs == CONTROL
    if "direction" in dims:
        expected = {"long_name": "direction", "comment": "direction from the critical point"}
        assert found.direction.attrs == expected


@pytest.mark.parametrize(
    ("forces", "name"),
    [
        ("", "displacements"),
        ("fixed = {normal_force_amplitude = 0.1, tangential_force_amplitude = 0.1}", "forces"),
        ("fixed.normal_force_amplitude = 0.1", "normal_force+tangential_displacement"),
        ("fixed.tangential_force_amplitude = 0.1", "normal_displacement+tangential_force"),
    ],
)
def test_what_is_prescribed(forces: str, name: str) -> None:
    assert labelled(forces).control.item() == name


@pytest.mark.parametrize(
    ("criteria", "told"),
    [
        ('"swt"', {}),
        (
            '"findley"',
            {
                "long_name": "findley parameter s",
                "comment": f"maximum Findley stress over E* delta0 / a_H; {BESIDE}",
                "criterion": "findley",
            },
        ),
        (
            '"fatemi_socie", "swt"',
            {
                "long_name": "s by its criterion",
                "comment": "fatemi_socie: maximum Fatemi-Socie parameter times G over E* delta0 / a_H; swt: "
                f"maximum Smith-Watson-Topper parameter over SWT0 = E* delta0 / R; {BESIDE}",
                "criterion": "fatemi_socie swt",
            },
        ),
    ],
)
def test_s_says_of_which_criterion_it_is(criteria: str, told: dict[str, str]) -> None:
    sensitivity = "" if criteria == '"swt"' else "fixed.normal_sensitivity = 0.3\n"
    plain = labelled("").s.attrs
    assert labelled(f"{sensitivity}axes.criterion = [{criteria}]").s.attrs == plain | told


def test_a_sample_has_numbers_or_labels() -> None:
    text = "[sample.points]\nphase = [0, 1, 2]\nfriction = [0.1, 0.2, 0.3]"
    attributes = {"long_name": "number of the point", "parameters": "phase friction"}
    found = labelled(text)
    assert (found["sample"].values.tolist(), found["sample"].attrs) == ([0, 1, 2], attributes)
    named = labelled(text, sample_dim="test", sample_labels=("a", "b", "c"))
    assert (named.test.values.tolist(), named.test.attrs) == (["a", "b", "c"], attributes)
    along = labelled(text, sample_dim="phase")
    assert along.phase.attrs["long_name"] == "phase"
    assert along.s.dims == ("phase",)
    grid = Study.from_text(f'title = "t"\n{text}\n[axes]\nnormal_amplitude = [0.5, 0.2]').grid
    assert [values_along(grid, dim).tolist() for dim in grid.dims] == [[0, 1, 2], [0.5, 0.2]]


def test_ratios_and_names_of_an_axis_are_told_as_they_are() -> None:
    found = labelled('axes.frequency_ratio = ["3/2", 1]\n')
    assert found.frequency_ratio.values.tolist() == [1.5, 1.0]
    assert found.frequency_ratio.attrs["fractions"] == "3/2 1"
    assert found.s.values.tolist() == [0.0, 1.0]
    assert "units" not in found.s.attrs
