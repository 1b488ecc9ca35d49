"""Lives of shear by given constants, and the usage of a limit of the Findley stress."""

import math
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from command import merged, succeeded
from drawn import draw
from real import UNITS
from told import refused

import swtstudy
from swtstudy import Study, open_results, run

LIMIT = "findley_limit = 150"
TENSILE = "strength = 900\nstrength_exponent = -0.1\nductility = 0.5\nductility_exponent = -0.6"
SHEAR = (
    "shear_strength = 530\nshear_strength_exponent = -0.09\n"
    "shear_ductility = 0.8\nshear_ductility_exponent = -0.55"
)
BODY = {"young_modulus": 210e3, "poisson_ratio": 0.3, "radius": 50.0, "normal_force": 200.0, "friction": 0.5}
OWN = BODY | {"tangential_force_amplitude": 60.0, "normal_sensitivity": 0.3}
FIXED = "\n".join(f"{name} = {value}" for name, value in OWN.items())


def study(*material: str, criterion: str = '"fatemi_socie"') -> Study:
    """One contact with these properties of its bodies."""
    lines = "\n".join(("yield_strength = 400", *material))
    fixed = FIXED if criterion != '"swt"' else FIXED.replace("normal_sensitivity = 0.3", "")
    fixed = f"[fixed]\n{fixed}\n" + "[axes]\n" * criterion.startswith("[")
    return Study.from_text(
        f'title = "t"\nrtol = 1e-3\n{UNITS}[material]\n{lines}\n{fixed}criterion = {criterion}\n'
    )


def solved(of: Study, path: Path) -> xr.Dataset:
    return run(of, path, workers=1)


def root(fs: float, modulus: float, strength: float, b: float, ductility: float, c: float) -> float:
    """Cycles at which the curve of a specimen in torsion is at a strain, by halving an interval."""
    low, high = 0.0, 40.0  # decades of reversals 2N
    for _ in range(200):
        middle = 0.5 * (low + high)
        strain = strength / modulus * 10.0 ** (b * middle) + ductility * 10.0 ** (c * middle)
        low, high = (middle, high) if strain > fs else (low, middle)
    return 0.5 * 10.0**low


def test_life_by_given_shear_constants(tmp_path):
    """γ = (τf′/G) (2N)^b + γf′ (2N)^c with G = E/(2 + 2ν), or the given one; no tensile constants."""
    own = solved(study(SHEAR), tmp_path / "own.nc")
    fs = float(own.FS.values.item())
    expected = root(fs, 210e3 / 2.6, 530.0, -0.09, 0.8, -0.55)
    assert own.FS_cycles.item() == pytest.approx(expected, rel=1e-9)
    assert own.FS_cycles.attrs["long_name"] == "load cycles to a crack by shear constants"
    assert "cycles" not in own
    softer = solved(study(SHEAR, "shear_modulus = [70e3, 90e3]"), tmp_path / "own.nc")
    for body, modulus in ((1, 70e3), (2, 90e3)):
        found = softer.sel(body=body)
        assert found.FS.item() == pytest.approx(fs, rel=1e-12)
        expected = root(fs, modulus, 530.0, -0.09, 0.8, -0.55)
        assert found.FS_cycles.item() == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_given_constants_take_the_place_of_estimated_ones(tmp_path):
    """Without a new run, and with words that say which."""
    path = tmp_path / "t.nc"
    estimated = solved(study(TENSILE), path)
    assert "estimated from the tensile ones" in estimated.FS_cycles.attrs["long_name"]
    given = solved(study(TENSILE, SHEAR), path)
    assert "0 of 1 distinct points computed" in given.attrs["history"]
    assert "estimated" not in given.FS_cycles.attrs["long_name"]
    assert given.FS_cycles.item() == pytest.approx(
        root(given.FS.item(), 210e3 / 2.6, 530.0, -0.09, 0.8, -0.55), rel=1e-9
    )
    assert given.FS_cycles.item() != pytest.approx(estimated.FS_cycles.item(), rel=0.1)
    lines = (
        f"shear_strength = {900 / math.sqrt(3)!r}\nshear_strength_exponent = -0.1\n"
        f"shear_ductility = {0.5 * math.sqrt(3)!r}\nshear_ductility_exponent = -0.6"
    )
    same = solved(study(TENSILE, lines), path)
    assert same.FS_cycles.item() == pytest.approx(estimated.FS_cycles.item(), rel=1e-12)


def test_estimated_constants_are_of_each_poisson_ratio(tmp_path):
    """G is E/(2 + 2ν): lives of an axis are those of its values one by one."""
    fixed = FIXED.replace("poisson_ratio = 0.3", 'criterion = "fatemi_socie"')
    fixed = fixed.replace("normal_sensitivity = 0.3", "")
    text = f'title = "t"\nrtol = 1e-2\n{UNITS}[material]\nyield_strength = 400\n{TENSILE}\n[fixed]\n{fixed}\n'
    text += "[axes]\nnormal_sensitivity = [0.2, 0.3]\npoisson_ratio = [0.2, 0.3, 0.4]\n"
    found = solved(Study.from_text(text), tmp_path / "t.nc")
    assert found.FS_cycles.dims == found.FS.dims
    for ratio in (0.2, 0.3, 0.4):
        each = found.sel(poisson_ratio=ratio)
        for fs, life in zip(each.FS.values.ravel(), each.FS_cycles.values.ravel(), strict=True):
            strength, ductility = 900.0 / math.sqrt(3.0), 0.5 * math.sqrt(3.0)
            expected = root(fs, 210e3 / (2.0 + 2.0 * ratio), strength, -0.1, ductility, -0.6)
            assert life == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_usage_is_the_stress_over_the_limit_of_the_body(tmp_path):

    both = '["swt", "findley"]'
    found = solved(study("findley_limit = [150, 200]", criterion=both), tmp_path / "t.nc")
    without = solved(study(criterion=both), tmp_path / "u.nc")
    assert not [name for name in without.data_vars if "usage" in name]
    findley = found.sel(criterion="findley")
    for body, limit in ((1, 150.0), (2, 200.0)):
        stress = without.findley_stress.sel(criterion="findley").item()
        assert findley.findley_usage.sel(body=body).item() == pytest.approx(stress / limit, rel=1e-12)
    assert found.findley_usage.sel(criterion="swt").isnull().all()
    assert "units" not in found.findley_usage.attrs
    assert "findley_usage_error" not in found


@pytest.mark.slow
def test_properties_of_shear_of_a_contact_in_python():
    """As of a study, with means over a critical distance."""
    shear = swtstudy.ShearConstants(80e3, 530.0, -0.09, 0.8, -0.55)
    near = {"rtol": 1e-3, "critical_distance": 0.05}
    contact = swtstudy.physical(**OWN, criterion="findley", findley_limit=(150.0, 200.0))
    found = contact.solve(**near)
    limits = np.array([150.0, 200.0])
    for end in ("", "_volume", "_point", "_line"):
        ratio = found[f"findley_stress{end}"] / found[f"findley_usage{end}"]
        np.testing.assert_allclose(ratio.transpose("body", ...).values.T - limits, 0.0, atol=1e-9)
    own = OWN | {"criterion": "fatemi_socie", "yield_strength": 400.0}
    found = swtstudy.physical(**own, shear_constants=shear).solve(**near)
    assert (
        found.FS_cycles_volume.attrs["long_name"]
        == "load cycles to a crack by the mean of Fatemi-Socie parameter over a volume by shear constants"
    )
    for end in ("", "_volume"):
        for body in (0, 1):
            value = found[f"FS{end}"].values[body]
            expected = root(value, 80e3, 530.0, -0.09, 0.8, -0.55)
            assert found[f"FS_cycles{end}"].values[body] == pytest.approx(expected, rel=1e-9)


def test_a_shear_modulus_is_asked_for_where_the_bodies_have_none(tmp_path):
    several = FIXED.replace("poisson_ratio = 0.3", "").replace("0.3", '0.3\ncriterion = "fatemi_socie"')
    text = f'title = "t"\n{UNITS}[material]\nyield_strength = 400\n{SHEAR}\n[fixed]\n{several}\n'
    text += "[axes]\npoisson_ratio = [0.3, 0.4]\n"
    refused("material.shear_modulus: found nothing; .*since that of", Study.from_text, text)
    Study.from_text(text.replace(SHEAR, f"shear_modulus = 80e3\n{SHEAR}"))
    (tmp_path / "materials.toml").write_text(
        f"[a]\nyield_strength = 400\n{SHEAR}\n[b]\nyield_strength = 400\n"
    )
    named = text.replace(f"yield_strength = 400\n{SHEAR}", 'file = "materials.toml"\nname = ["a", "b"]')
    words = "shear_strength: found that of one body; allowed: that of both"
    refused(words, Study.from_text, named, "s", tmp_path)


FIGURE = """
tangential_force_amplitude = [30, 60]
[figure]
x = "tangential_force_amplitude"
y = ["FS_cycles", "findley_usage", "FS", "findley_stress"]
hue = "criterion"
"""


@pytest.mark.slow
def test_from_a_study_to_lives_of_shear_and_usage(tmp_path: Path) -> None:
    """Study file, archive, info, figure and page; and the study that the archive keeps."""
    text = FIXED.replace("tangential_force_amplitude = 60.0\n", "")
    text = (
        f'title = "t"\nrtol = 1e-2\n{UNITS}'
        f"[material]\nyield_strength = 400\n{SHEAR}\n{LIMIT}\n[fixed]\n{text}\n[axes]\n"
        f'criterion = ["fatemi_socie", "findley"]{FIGURE}'
    )
    (tmp_path / "t.toml").write_text(text, encoding="utf-8")

    succeeded("run", tmp_path / "t.toml", "--results", tmp_path, "--workers", 1)
    found = open_results(tmp_path / "t.nc")
    for each in ("FS_cycles", "findley_usage"):
        assert found[each].notnull().sum() == 2
    info = succeeded("info", tmp_path / "t.nc").output
    assert "Findley limit" in info
    assert "150 MPa" in info
    assert "shear_modulus 80769.2, strength 530" in info
    assert [axes.get_ylabel() for axes in draw(found).axes] == [
        r"load cycles to a crack, $N_\mathrm{FS}$",
        r"Findley stress over its limit, $f/f_\mathrm{lim}$",
        r"$\mathrm{FS}$",
        "$f$ (MPa)",
    ]
    succeeded("report", tmp_path / "t.nc", "-o", tmp_path / "t.html")
    page = (tmp_path / "t.html").read_text(encoding="utf-8")
    assert "Strain-life constants in torsion" in page
    kept = Study.from_text(found.attrs["study"]).grid
    assert kept.findley_limits == (150.0, 150.0)
    assert kept.shear_materials == (swtstudy.ShearConstants(210e3 / 2.6, 530.0, -0.09, 0.8, -0.55),) * 2
    again = Study.from_text(merged(tmp_path / "t.nc").attrs["study"]).grid
    assert (again.findley_limits, again.shear_materials) == (kept.findley_limits, kept.shear_materials)
    short = found.assign(FS_cycles=found.FS_cycles.where(found.FS_cycles.isnull(), 12.0))
    assert any(line.startswith("FS_cycles extrapolated at ") for line in short.swt.validity())


def test_constants_are_estimated_for_a_poisson_ratio_that_a_body_can_have():
    tensile = swtstudy.FatigueConstants(200e3, 1000.0, -0.1, 0.5, -0.6)
    words = r"poisson_ratio: found 0.7; allowed: a number in \(-1, 0.5\]"
    refused(words, swtstudy.ShearConstants.estimated, tensile, 0.7)
