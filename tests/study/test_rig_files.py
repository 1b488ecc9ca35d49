"""Files as rigs write them: other encodings, units, settings above the header, workbooks."""

import re
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest
import real
from command import call
from told import refused, warned

import swtstudy
from swtstudy import Study, StudyError, read_signal

RIG = f"""{real.RIG}[loads.rig]
file = "rig.csv"
absolute = true
"""
#: Time, normal and tangential force.
ROWS = [(0.0, 200.5, 0.0), (0.25, 220.0, 60.0), (0.5, 205.0, 20.0), (0.75, 190.0, -60.0)]
LOADS = np.array([row[1:] for row in ROWS])
#: The same from the vertex on that a loop begins with.
LOOP = np.roll(LOADS, 1, axis=0)


def table(header: str, separator: str = ",", decimal: str = ".", rows: list = ROWS) -> str:
    lines = (separator.join(str(value).replace(".", decimal) for value in row) for row in rows)
    return "\n".join([header, *lines, ""])


def loop_of(text: str, folder: Path) -> tuple[np.ndarray, list[str]]:
    """The loads of a study's loop, and what is told of them."""
    study, told = warned(Study.from_text, text, "s", folder)
    (loop,) = study.grid.values("load")
    loads = np.array(loop.vertices)
    loads[:, 0] += loop.mean_normal
    return loads, told


#: A file, keys for it, and what is told of it.
READ = {
    "units row": (table("time,normal,tangential\n(s),(N),(N)"), "", "line 2 is read as units: .s., .N., .N."),
    "units row by key": (table("time,normal,tangential\n1,2,3"), "units_row = true", ""),
    "settings": (
        table("# f: 15.0, P: 10.0\n\n# rig: 4\ntime,normal,tangential"),
        "",
        "header is found in line 4",
    ),
    "settings by key": (table('"not closed\ntime,normal,tangential'), "skip_rows = 1", ""),
    "lines in headers": (
        table('time,"Axial\n  Force (N)","Force"'),
        'columns = { normal = "Axial Force (N)", tangential = "Force" }',
        "",
    ),
    "German": (table("time;normal;tangential", ";", ","), "", "numbers with a comma are read with decimal"),
    "German by keys": (table("time;normal;tangential", ";", ","), "separator = ';'\ndecimal = ','", ""),
    "tabs": (table("time\tnormal\ttangential", "\t"), "", ""),
    "blanks": (table("time  normal tangential", "   "), "", ""),
    "kN": (
        table("t [s],Fn [kN],Ft", rows=[(t, n / 1000, q) for t, n, q in ROWS]),
        'columns = { normal = "Fn [kN]", tangential = "Ft" }\nscale = { normal = 1000 }',
        "",
    ),
    "exponents of Fortran": (
        table("time,normal,tangential", rows=[(t, f"{n / 1000:.5f}D+03", f"{q:.1f}d0") for t, n, q in ROWS]),
        "",
        "",
    ),
    "a long minus": (table("time,normal,tangential").replace("-", "\u2212"), "", ""),
    "the other sign": (
        table("time,normal,tangential", rows=[(t, -n, q) for t, n, q in ROWS]),
        "scale = { normal = -1 }",
        "",
    ),
    "frequency": (table("time,normal,tangential"), "time = 'time'\nfrequency = 1", ""),
    "a missing value": (
        table("time,normal,tangential", rows=[*ROWS[:2], (0.3, "", 50.0), *ROWS[2:]]),
        "time = 'time'\nfrequency = 1",
        "line 4 left out: a value is missing",
    ),
}


@pytest.mark.parametrize(("content", "keys", "words"), READ.values(), ids=READ)
def test_files_of_rigs_are_read(tmp_path: Path, content: str, keys: str, words: str) -> None:
    (tmp_path / "rig.csv").write_text(content, encoding="utf-8")
    loads, told = loop_of(RIG + keys, tmp_path)
    np.testing.assert_allclose(loads, LOOP, atol=1e-9)
    assert len(told) == bool(words)
    for line in told:
        assert re.search(words, line), line


@pytest.mark.parametrize("encoding", ["cp1252", "latin-1", "utf-16", "utf-8-sig"])
def test_encodings(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "rig.csv").write_text(table("delta [µm],normal,tangential"), encoding=encoding)
    key = f'encoding = "{encoding}"' if encoding in ("cp1252", "latin-1") else ""
    np.testing.assert_allclose(loop_of(RIG + key, tmp_path)[0], LOOP, atol=1e-9)


#: A file, keys for it, and the message.
REFUSED = {
    "encoding": (
        "#\ndelta [µm],normal,tangential\n1,200,0\n2,200,1\n".encode("cp1252"),
        "",
        r"file: found bytes in line 2 that are not UTF-8 \(.*\); allowed: encoding = \"cp1252\", which reads "
        "'delta .µm.,norm' there, or \"latin-1\"; or the file saved as UTF-8",
    ),
    "MATLAB": (
        b"MATLAB 5.0 MAT-file, Platform: GLNXA64\0",
        "",
        "file: found a MATLAB file .*; allowed: .*writetable",
    ),
    "old Excel": (b"\xd0\xcf\x11\xe0", "", "file: found an Excel workbook before 2007"),
    "zip": (b"PK\x03\x04", "", "file: found a zip archive"),
    "damaged Excel": (b"PK\x03\x04 xl/", "", "file: found a workbook that cannot be read"),
    "binary": (b"\0\1\2", "", "file: found a binary file"),
}


@pytest.mark.parametrize(("content", "keys", "words"), REFUSED.values(), ids=REFUSED)
def test_other_files_are_refused_with_the_way_out(
    tmp_path: Path, content: bytes, keys: str, words: str
) -> None:
    if content.startswith(b"PK\x03\x04 xl/"):
        pytest.importorskip("openpyxl")
    (tmp_path / "rig.csv").write_bytes(content)
    error = refused("", Study.from_text, RIG + keys, "s", tmp_path)
    (line,) = map(str, error.mistakes)
    assert re.match(f"s: loads.rig.{words}", line), line


@pytest.mark.parametrize("separator", [",", ";", "\t", "|"])
def test_blanks_within_headers_part_no_names(tmp_path: Path, separator: str) -> None:
    (tmp_path / "trace.csv").write_text(
        f"position [mm]{separator}height [µm]\n0{separator}1\n1{separator}2\n"
    )
    refused(r"found the columns position \[mm\], height \[µm\];", swtstudy.read_trace, tmp_path / "trace.csv")
    # A sign within a name is no separator, if the rows have none.
    (tmp_path / "rig.txt").write_text(f"normal tangential |F|{separator}N\n1 2 3\n2 3 4\n3 3 4\n")
    if separator in ",;":
        assert read_signal(tmp_path / "rig.txt").values.tolist() == [[1, 2], [2, 3], [3, 3]]


def test_a_stress_that_is_a_quotient_is_compared_with_the_units(tmp_path: Path) -> None:
    rows = [(200 + n / 10, q, t) for t, n, q in ROWS]
    (tmp_path / "rig.csv").write_text(table("normal,tangential,bulk\nN,N,N/mm²", rows=rows), encoding="utf-8")
    text = RIG.replace('length = "mm"', 'length = "m"').replace('stress = "MPa"', 'stress = "Pa"')
    words = r"in N/mm² as bulk, while \[units\] has stress in Pa .*; allowed: scale = { bulk = 1e.06 }"
    refused(words, Study.from_text, text + "units_row = true\n", "s", tmp_path)


def test_samples_are_named_by_the_lines_of_the_file(tmp_path: Path) -> None:
    """Also below settings, a row of units, an empty line and rows that are left out."""
    wave = 60.0 * np.sin(2.0 * np.pi * np.arange(40) / 40)
    wave[20] = 300.0
    rows = [f"{k},200,{load:.4f}" for k, load in enumerate(wave)]
    rows[3] += "\n3.2,,1\n"
    (tmp_path / "rig.csv").write_text("\n".join(["Rig 7", "", "t,normal,tangential", "s,N,N", *rows]))
    line = (tmp_path / "rig.csv").read_text().splitlines().index("20,200,300.0000") + 1
    assert line == 27
    _, told = warned(read_signal, tmp_path / "rig.csv", time="t")
    words = f"rig: tangential 300 in cycle 1, line {line} of the file, where"
    assert any(each.startswith(words) for each in told)


def test_a_sheet_of_a_workbook(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    sheet = book.create_sheet("run 2")
    for row in (["rig 4"], ["time", "Fn", "tangential"], ["s", "kN", "N"]):
        sheet.append(row)
    for t, n, q in ROWS:
        sheet.append([t, n / 1000, q])
    book.save(tmp_path / "rig.xlsx")
    given = {"columns": {"normal": "Fn"}, "scale": {"normal": 1000}, "absolute": True, "units_row": True}
    for own in ("run 2", 2):
        with pytest.warns(UserWarning, match=r"rig.xlsx: the header is found in line 2"):
            signal = read_signal(tmp_path / "rig.xlsx", sheet=own, **given)
        np.testing.assert_allclose(signal.values, LOADS, rtol=1e-12)
    with pytest.raises(StudyError, match="sheet: found 'run 3'; allowed: did you mean run 2"):
        read_signal(tmp_path / "rig.xlsx", sheet="run 3", **given)


def test_texts_with_decimal_commas_in_a_workbook_are_numbers(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in (["normal", "tangential"], ["200,5", 0], ["210,5", 60], ["200,5", -60]):
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    with pytest.warns(UserWarning, match="numbers with a comma are read with decimal = ','"):
        found = read_signal(tmp_path / "rig.xlsx", absolute=True)
    assert found.values.tolist() == [[200.5, 0.0], [210.5, 60.0], [200.5, -60.0]]


@pytest.mark.parametrize("decimal", [None, ","])
def test_texts_with_decimal_commas_beside_numbers_are_numbers(tmp_path: Path, decimal: str | None) -> None:
    """A number of a workbook has a point, whatever its texts have; 1,000 may be a thousand."""
    openpyxl = pytest.importorskip("openpyxl")
    book, given = openpyxl.Workbook(), {"time": "time", "frequency": 1, "absolute": True}
    for row in (
        ["time", "normal", "tangential"],
        [0.0, "200,500", 0],
        [0.25, "210,500", 60],
        [0.75, 190, -60],
    ):
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    if decimal:
        found = read_signal(tmp_path / "rig.xlsx", decimal=decimal, **given)
        assert found.values.tolist() == [[200.5, 0.0], [210.5, 60.0], [190.0, -60.0]]
        return
    refused("'200,500'; allowed: .* decimal = ',', if", read_signal, tmp_path / "rig.xlsx", **given)
    book.active["C4"] = "-60,5"
    book.save(tmp_path / "rig.xlsx")
    with pytest.warns(UserWarning, match="numbers with a comma are read with decimal = ','"):
        found = read_signal(tmp_path / "rig.xlsx", **given)
    assert found.values.tolist() == [[200.5, 0.0], [210.5, 60.0], [190.0, -60.5]]


def test_messages_name_the_sheets_of_a_workbook(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    book.active.title = "Info"
    book.active.append(["rig", 4])
    for name in ("run 1", "run 2"):
        sheet = book.create_sheet(name)
        for row in (["normal", "tangential"], [200, 0], [210, 60], [200, -60]):
            sheet.append(row)
    book.save(tmp_path / "rig.xlsx")
    words = r"rig\.xlsx, sheet 'Info' \(others: 'run 1', 'run 2'\): line 1: found the columns rig, 4; "
    refused(words, read_signal, tmp_path / "rig.xlsx")
    assert read_signal(tmp_path / "rig.xlsx", sheet="run 1").values.shape == (3, 2)


def test_errors_in_cells_of_a_workbook_are_told(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.Workbook()
    for row in (["normal", "tangential"], [200, 0], ["#DIV/0!", 60], [210, -60]):
        book.active.append(row)
    book.save(tmp_path / "rig.xlsx")
    refused("line 3, normal: found '#ERROR'; allowed: a finite number", read_signal, tmp_path / "rig.xlsx")


def test_a_workbook_without_openpyxl_says_what_it_needs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "openpyxl", None)
    (tmp_path / "rig.xlsx").write_bytes(b"PK\x03\x04 xl/")
    words = r"rig.xlsx: found an Excel workbook; allowed: pip install openpyxl, which reads it; or "
    refused(words, read_signal, tmp_path / "rig.xlsx")


def test_points_and_traces_are_read_by_the_same_rules(tmp_path: Path) -> None:
    (tmp_path / "points.csv").write_bytes("phase;frïction\n0,5;0,1\n1;0,2\n".encode("cp1252"))
    text = 'title = "t"\n[sample]\nfile = "points.csv"\nencoding = "cp1252"\n'
    text += 'columns = { friction = "frïction" }\n'
    with pytest.warns(UserWarning, match="read with decimal = ','"):
        grid = Study.from_text(text, "s", tmp_path).grid
    assert (grid.samples["phase"], grid.samples["friction"]) == ((0.5, 1.0), (0.1, 0.2))
    x = np.linspace(-2.0, 2.0, 201)
    rows = "\n".join(f"{a:.9g}\t{b:.9g}" for a, b in zip(x, -10.0 * x**2, strict=True))
    (tmp_path / "trace.txt").write_text(f"made by 4\nx [mm]\tz [µm]\n{rows}\n", encoding="utf-8")
    given = {
        "columns": {"position": "x [mm]", "height": "z [µm]"},
        "scale": {"height": -1e-3},
        "skip_rows": 1,
    }
    profile = swtstudy.read_trace(tmp_path / "trace.txt", **given)
    np.testing.assert_allclose(profile.height, profile.radius**2 / 100.0, atol=1e-9)


def test_all_mistakes_in_a_table_are_told_at_once(tmp_path: Path) -> None:
    """A wrong encoding, a key of no column, a unit and a number, of the first run."""
    content = "time [µs],Fn [kN],tangential\n0,0.2,0\n1,0.2,x\n2,0.2,1\n"
    (tmp_path / "rig.csv").write_bytes(content.encode("cp1252"))
    keys = 'columns = { normal = "Fn [kN]" }\nscale = { norml = 1000 }\n'
    for encoding, first in (
        ("", "file: found bytes in line 1"),
        ('encoding = "cp9"', "encoding: found 'cp9'"),
    ):
        error = refused("", Study.from_text, RIG + keys + encoding, "s", tmp_path)
        told = str(error)
        for words in (first, "scale.norml: found 'norml'; allowed: did you mean normal?", "in kN as normal"):
            assert words in told
        assert "found 'x' (" in told
        assert len(error.mistakes) == 4


def test_a_notice_is_told_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "rig.csv").write_text("Rig 7\n" + table("time,normal,tangential"))
    (tmp_path / "rig.toml").write_text(RIG)
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        warnings.simplefilter("always")
        found = call("show", "rig.toml", "--load", "rig")
    assert found.exit_code == 0
    assert found.output.count("header is found in line 2") == 1
