"""Files that users made by hand or by a rig: what is in doubt in them is refused, with the line."""

import os
import re
from pathlib import Path

import numpy as np
import pytest
import real
from told import refused

import swtstudy
from swtstudy import LoadPath, Study

LOOP = 'title = "t"\nfixed.load = "mine"\n[loads.mine]\nfile = "cycle.csv"\n'
POINTS = 'title = "t"\nsample.file = "points.csv"\n'
PROFILE = 'title = "t"\nfixed.profile = "mine"\n[profiles.mine]\nfile = "worn.csv"\n'


def mistakes_of(text: str, folder: Path) -> list[str]:
    return [*map(str, refused("", Study.from_text, text, "s", folder).mistakes)]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("normal,tangential,blk\n0,1,9\n0,-1,-9\n", "found the column 'blk'"),
        ("normal,tangential,bulk,Bulk\n0,1,1,9\n0,-1,1,-9\n", r"found the column bulk twice \(.*line 1\)"),
        (
            "normal,tangential\n0,1_0\n0,-1\n",
            r"found '1_0' \(.*line 2, tangential\); allowed: a finite number",
        ),
        (
            f"normal,tangential\n0,1\n0,{'1' * 131_073}\n",
            r"found field larger than field limit .*cycle.csv\); allowed: a CSV file that can be read",
        ),
        (f"normal,tangential\n0,1{',' * 1000}\n", "found 1002 cells under 2 columns"),
        ("x" * 131_073, "found field larger than field limit .* a CSV file that can be read"),
    ],
)
def test_columns_in_doubt_are_refused_with_the_line(tmp_path: Path, content: str, words: str) -> None:
    (tmp_path / "cycle.csv").write_text(content)
    (line,) = mistakes_of(LOOP, tmp_path)
    assert re.match(f"s: loads.mine.file: {words}", line), line


@pytest.mark.parametrize("end", [b"\n", b"\r\n", b"\r"])
def test_other_columns_and_a_comma_at_the_end_are_left_alone(tmp_path: Path, end: bytes) -> None:
    (tmp_path / "cycle.csv").write_bytes(
        b"\xef\xbb\xbftime, Remark,tangential,normal,\n0,a,1,0,\n\n1,b,-1,0,\n2,c,0,1,\n".replace(b"\n", end)
    )
    (loop,) = Study.from_text(LOOP, "s", tmp_path).grid.values("load")
    assert loop == LoadPath("mine", [[0, 1], [0, -1], [1, 0]])


@pytest.mark.parametrize("kind", ["", "force_"])
def test_a_normal_column_that_is_no_deviation_is_refused(kind: str) -> None:
    """In newtons about 150 N, with 150 N given as the mean: half of the load would be counted twice."""
    moving = {f"normal_{kind}amplitude": 1e-2, f"tangential_{kind}amplitude": 1e-2}
    far = LoadPath("rig", [[140, -60], [160, -60], [160, 60], [140, 60]])
    smooth = LoadPath.harmonic_sum("smooth", [(0, 150, np.pi / 2), (1, 10, 0)], [(1, 60, 0)])
    beyond = LoadPath("just", [[0.26, -0.5], [0.75, 0.5]])
    for loop in (far, smooth, beyond, LoadPath("still", [[150, -60], [150, 60]])):
        refused("far from 0; allowed: deviations from the mean", swtstudy.solve, load=loop, **moving)
    # At twice half of the range it still may be meant; and without an amplitude it does not matter.
    swtstudy.solve(load=LoadPath("one", [[0.25, -0.5], [0.75, 0.5]]), rtol=1e-2)
    still = swtstudy.solve(load=far, rtol=1e-2, **(moving | {f"normal_{kind}amplitude": 0.0}))
    assert float(still.s) > 0.0


FILES = [
    (LOOP, "cycle.csv", "loads.mine.file: found {} "),
    (POINTS, "points.csv", "sample.file: found {} "),
    (PROFILE, "worn.csv", "profiles.mine: found {} "),
]


@pytest.mark.parametrize(("text", "name", "words"), FILES)
def test_only_regular_files_are_read(tmp_path: Path, text: str, name: str, words: str) -> None:
    """A device may have no end, and opening a pipe waits for somebody who writes into it."""
    for make in (lambda path: path.symlink_to("/dev/zero"), os.mkfifo):
        make(tmp_path / name)
        (line,) = mistakes_of(text, tmp_path)
        assert re.match(f"s: {words.format('not a regular file')}", line), line
        (tmp_path / name).unlink()


def test_a_study_is_a_regular_file_of_a_bounded_size(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    os.mkfifo(path)
    refused("found not a regular file; allowed: a readable study", Study.from_toml, path)
    path.unlink()
    with open(path, "wb") as file:
        file.truncate(2**30)
    error = refused("found more than [0-9]+ bytes", Study.from_toml, path)
    (largest,) = map(int, re.findall("more than ([0-9]+) bytes", str(error)))
    for size in (largest, largest + 1):
        os.truncate(path, size)
        assert ("found more than" in str(refused("", Study.from_toml, path))) == (size > largest)


MATERIAL = f"""
title = "t"
{real.UNITS}[material]
file = "materials.toml"
name = "steel"
[fixed]
young_modulus = 2e5
poisson_ratio = 0.3
radius = 10
depth = 0.01
friction = 0.5
tangential_amplitude = 1e-3
"""
STEEL = "[steel]\nstrength = 1e3\nstrength_exponent = -0.1\nductility = 0.5\nductility_exponent = -0.6\n"


def test_a_file_of_materials_is_read_as_a_study_is(tmp_path: Path) -> None:
    path = tmp_path / "materials.toml"
    path.write_bytes(b"\xef\xbb\xbf" + STEEL.encode())
    assert Study.from_text(MATERIAL, "s", tmp_path).grid.materials[0].strength == 1e3
    for content, words in (
        ("x = " + 5000 * "[" + 5000 * "]", "a syntax error: nested too deeply"),
        ("x = " + 5000 * "1", "an integer with too many digits"),
        ("x", "a syntax error: .*"),
    ):
        path.write_text(content)
        (line,) = mistakes_of(MATERIAL, tmp_path)
        assert re.match(rf"s: material.file: found 'materials.toml' \({words}\); allowed: a TOML file", line)
    path.unlink()
    os.mkfifo(path)
    (line,) = mistakes_of(MATERIAL, tmp_path)
    assert "(not a regular file)" in line


def test_a_study_with_a_byte_order_mark(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_bytes(b'\xef\xbb\xbftitle = "t"\r\n')
    study = Study.from_toml(tmp_path / "mine.toml")
    assert (study.title, study.text) == ("t", 'title = "t"\n')


@pytest.mark.slow
def test_more_rows_than_there_is_room_for_are_refused(tmp_path: Path) -> None:
    (tmp_path / "points.csv").write_text("phase\n" + 1_000_001 * "0\n")
    (line,) = mistakes_of(POINTS, tmp_path)
    assert re.search(r"found more than 1000000 rows \(.*\); allowed: at most 1000000", line)


def test_what_would_take_minutes_to_read_is_refused_at_once(tmp_path: Path) -> None:
    axes = "\n".join(
        f"{name} = {{start = 0.1, stop = 0.9, num = 1_000_000}}" for name in ("friction", "phase")
    )
    (line,) = mistakes_of(f'title = "t"\n[axes]\n{axes}\n', tmp_path)
    assert line == (
        "s: axes.friction, axes.phase: found 2000000 values, 1e+12 points; "
        "allowed: at most 1000000 values along all axes"
    )
    rows = "".join(f"{r},{r * r}\n" for r in range(20_000))
    (tmp_path / "worn.csv").write_text(f"radius,height\n{rows}")
    (line,) = mistakes_of(PROFILE, tmp_path)
    assert "found 20000 points (mine.radius, mine.height); allowed: at most 10000: one of every 2, or" in line
    (tmp_path / "points.csv").write_text(",".join(f"a{n}" for n in range(2_000)) + "\n1\n")
    (line,) = mistakes_of(POINTS, tmp_path)
    assert re.search(r"found more than 1000 columns \(.*: line 1\)", line)


def test_what_is_defined_and_not_used_is_told(tmp_path: Path) -> None:
    """Most likely its key was forgotten; cycles that are kept one by one are those of their record."""
    loop = "[loads.mine]\nvertices = [[0, 1], [0, -1]]\n"
    radii, heights = ([step**power for step in range(9)] for power in (1, 2))
    worn = f"[profiles.worn]\nradius = {radii}\nheight = {heights}\n"
    first, second = mistakes_of(f"{real.CONTACT}normal_force = 200\n{loop}", tmp_path)
    assert "loads.mine: found a load that is not used" in first
    assert "tangential_amplitude: found nothing" in second
    used = f'title = "t"\n[axes]\nprofile = ["paraboloid", "worn"]\n[fixed]\nload = "mine"\n{loop}{worn}'
    assert Study.from_text(used).grid.size == 2
    # One of several may wait for another run.
    assert Study.from_text(used + "[loads.later]\nvertices = [[0, 1], [0, -2]]\n").grid.size == 2


def test_headers_are_stripped_on_both_sides(tmp_path: Path) -> None:
    (tmp_path / "cycle.csv").write_text(" Fn [N] , Ft\n0,1\n0,-1\n")
    columns = 'columns = { normal = " Fn [N] ", tangential = "Ft" }\n'
    assert Study.from_text(LOOP + columns, "s", tmp_path).grid.values("load")


def test_a_stray_quote_beyond_the_search_for_the_header_is_named(tmp_path: Path) -> None:
    rows = "0,1\n0,-1\n" * 150
    (tmp_path / "cycle.csv").write_text(f'normal,tangential\n{rows}0,"{"1" * 131_073}\n')
    (line,) = mistakes_of(LOOP, tmp_path)
    assert re.match("s: loads.mine.file: found field larger than field limit .*a CSV file that can", line), (
        line
    )
