"""Names and units are a user's own: an archive gives them back, and figures write them as they are."""

from pathlib import Path

import pytest
import stand_in
from drawn import draw
from matplotlib.figure import Figure

from swtstudy import Study, open_results, run

LOOPS = """
title = "t"
rtol = 1e-2
[axes]
load = ["harmonic", {name}]
friction = [0.1, 0.2]
[fixed]
normal_amplitude = 0.5
tangential_amplitude = 0.5
[loads.{name}]
vertices = [[0, 1], [0.5, 0], [0, -1]]
[figure]
x = "friction"
{role} = "load"
{more}
"""
NAMES = ["$$", "US$", "$x", "a$b$", r"\\$", "_^{", "%", "öü"]


def drawn(figure: Figure) -> str:
    """All words of a figure, which can be drawn."""
    figure.draw_without_rendering()
    return " ".join(text.get_text() for text in figure.findobj(lambda each: hasattr(each, "get_text")))


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", NAMES)
def test_names_are_written_as_they_are(tmp_path: Path, name: str) -> None:
    words = name.replace("\\\\", "\\")
    roles = [("hue", ""), ("panels", ""), ("vertical", 'kind = "heatmap"')]
    # Each kind of mark in all three places, all others in a legend.
    for role, more in roles if name in ("a$b$", "_^{") else roles[:1]:
        text = LOOPS.format(name=f'"{name}"', role=role, more=more)
        found = run(Study.from_text(text), tmp_path / f"{role}.nc", workers=1, solver=stand_in.smooth)
        assert open_results(tmp_path / f"{role}.nc")["load"].values.tolist() == ["harmonic", words]
        assert words.replace("$", r"\$").replace("_", " ") in drawn(draw(found))


@pytest.mark.slow
@pytest.mark.parametrize("unit", ["$$", "$x"])
def test_units_are_written_as_they_are(tmp_path: Path, unit: str) -> None:
    study = Study.from_text(
        f"""
title = "a $$ title"
rtol = 1e-2
units = {{length = "{unit}", force = "N", stress = "MPa"}}
fixed = {{young_modulus = 7e4, poisson_ratio = 0.3, radius = 50, friction = 0.5, body = 1}}
[sample]
design = "saltelli"
size = 2
[sample.ranges]
depth = [0.01, 0.02]
tangential_amplitude = [1e-3, 2e-3]
[axes]
normal_amplitude = [0, 1e-3]
[figure]
kind = "scatter"
x = "sample"
hue = "normal_amplitude"
y = ["critical_position", "SWT"]
"""
    )
    found = run(study, tmp_path / "a.nc", workers=1, solver=stand_in.smooth)
    label = unit.replace("$", r"\$")
    # A label that is longer than its panel has two lines.
    words = drawn(draw(found)).replace("\n", " ")
    for each in (f"$x$ ({label})", f"$u_A$ ({label})", f"0.001 {label}"):
        assert each in words, words
