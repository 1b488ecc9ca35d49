"""Stress histories of finite elements: the round trip of a contact's own stress, lives and files."""

from pathlib import Path

import numpy as np
import pytest
from command import call, succeeded
from told import refused

import swtstudy
from swtstudy import FatigueConstants, StudyError, evaluate_history, read_history

NU = 0.3
NAMES = ("xx", "yy", "zz", "yz", "xz", "xy")
#: Points that have other steps than one another.
STEPS = ((1, 0), (1, 1), (1, 2), (2, 0), (2, 2), (2, 3))
#: With E = 1 − ν² the SWT of stress_field is s.
STUDY = """
[units]
length = "mm"
force = "N"
stress = "MPa"
[material]
{material}
[fixed]
young_modulus = {young}
poisson_ratio = 0.3
normal_sensitivity = 0.3
"""
STEEL = "strength = 1000\nstrength_exponent = -0.1\nductility = 0.5\nductility_exponent = -0.6\n"
CONSTANTS = FatigueConstants(2e5, 1000.0, -0.1, 0.5, -0.6)


def write(path: Path, stress: np.ndarray, header: str = "id,x,y,z,step,xx,yy,zz,yz,xz,xy") -> None:
    """A table of stresses (points, steps, 6)."""
    rows = [header]
    for point, history in enumerate(stress):
        for step, values in enumerate(history):
            cells = [f"P{point}", float(point), 0.0, 0.5, step, *values]
            rows.append(",".join(map(str, cells[-6 - (5 if header.startswith("id") else 1) :])))
    path.write_text("\n".join(rows) + "\n")


def study(folder: Path, material: str = STEEL, young: float = 2e5) -> Path:
    (folder / "rig.toml").write_text(STUDY.format(material=material, young=young))
    return folder / "rig.toml"


@pytest.mark.filterwarnings("ignore:stresses up to")
def test_the_stress_of_a_contact_gives_s(tmp_path: Path) -> None:
    """In either order of the components, and by the command."""
    parameters = {"friction": 0.4, "phase": 1.0}
    solved = swtstudy.solve(**parameters, rtol=1e-5)
    field = swtstudy.stress_field([solved.critical_x.item(), 0.3], 0.0, 0.0, **parameters)
    names = ("xx", "yy", "zz", "yz", "xz", "xy")
    stress = np.stack([field[f"sigma_{name}"].transpose("x", "instant").values for name in names], axis=-1)
    write(tmp_path / "ours.csv", stress)
    write(tmp_path / "theirs.csv", stress[..., [0, 1, 2, 5, 4, 3]], "id,x,y,z,step,S11,S22,S33,S12,S13,S23")
    write(tmp_path / "other.csv", stress[..., [0, 1, 2, 5, 4, 3]], "id,x,y,z,step,a,b,c,d,e,f")
    young = 1.0 - NU**2
    rig = study(tmp_path, f"yield_strength = {young * 1e-2}", young)
    for name, order in (("ours", None), ("theirs", None), ("other", "abaqus")):
        found = evaluate_history(read_history(tmp_path / f"{name}.csv", order=order), rig)
        assert found.SWT.values[0] == pytest.approx(solved.s.item(), rel=3e-5)
        assert found.id.values.tolist() == ["P0", "P1"]
        findley, _ = swtstudy.criterion_of_history(stress, "findley", 0.3)
        np.testing.assert_allclose(found.findley_stress, findley, rtol=1e-9)
        shear, _ = swtstudy.criterion_of_history(stress, "fatemi_socie", 0.3 / (young * 1e-2))
        np.testing.assert_allclose(found.FS, shear * 2.0 * (1.0 + NU) / young, rtol=1e-9)
    done = succeeded("history", rig, tmp_path / "theirs.csv", "-o", tmp_path / "lives.csv")
    assert f"largest SWT = {solved.s.item():.4g} MPa at id = P0, x = 0, y = 0, z = 0.5" in done.stdout
    header, first, _ = (tmp_path / "lives.csv").read_text().splitlines()
    assert dict(zip(header.split(","), first.split(","), strict=True))["SWT_normal_y"] in ("0.0", "-0.0")


def test_lives_are_by_counted_cycles(tmp_path: Path) -> None:
    """Of a load along x with small cycles on a large one, as the library rainflow counts them."""
    rainflow = pytest.importorskip("rainflow")
    wave = np.array([0.0, 400, 100, 300, 100, 300, -400, -100, -250, 0])
    stress = np.zeros((2, len(wave), 6))
    stress[0, :, 0] = wave
    stress[1, :, 5] = 0.5 * wave
    found = evaluate_history(_written(tmp_path, stress), study(tmp_path, STEEL + "yield_strength = 500\n"))
    turned = np.roll(wave, -1)  # from the largest value on each cycle closes
    damage = 0.0
    for size, _, count, begin, end in rainflow.extract_cycles(np.append(turned, turned[0])):
        largest = max(np.append(turned, turned[0])[begin : end + 1])
        damage += count / CONSTANTS.cycles(max(largest, 0.0) * 0.5 * size / 2e5)
    assert found.cycles.values[0] == pytest.approx(1.0 / damage, rel=0.02)
    assert found.cycles.values[0] < CONSTANTS.cycles(found.SWT.values[0])
    assert np.abs(found.SWT_normal.values[0]).tolist() == [1.0, 0.0, 0.0]
    assert found.FS_cycles.values[1] < swtstudy.ShearConstants.estimated(CONSTANTS, NU).cycles(
        found.FS.values[1]
    )


def _written(folder: Path, stress: np.ndarray) -> Path:
    write(folder / "stress.csv", stress)
    return folder / "stress.csv"


def test_paraview_reads_the_points(tmp_path: Path) -> None:
    meshio = pytest.importorskip("meshio")
    stress = np.zeros((3, 2, 6))
    stress[:, 1, 0] = [100, 200, 300]
    succeeded("history", study(tmp_path), _written(tmp_path, stress), "-o", tmp_path / "lives.vtu")
    mesh = meshio.read(tmp_path / "lives.vtu")
    np.testing.assert_array_equal(mesh.points[:, 0], [0, 1, 2])
    np.testing.assert_allclose(mesh.point_data["SWT"], np.array([100, 200, 300]) ** 2 / 4e5, rtol=1e-6)
    assert mesh.point_data["SWT_normal"].shape == (3, 3)
    assert "id" not in mesh.point_data  # texts
    rows = ["id,step,xx,yy,zz,yz,xz,xy", *(f"7,{k},{100 * k},0,0,0,0,0" for k in range(2))]
    (tmp_path / "nodes.csv").write_text("\n".join(rows))
    done = call("history", study(tmp_path), tmp_path / "nodes.csv", "-o", tmp_path / "nodes.vtu")
    assert "nodes.vtu, and points without x, y, z; allowed: a .csv file" in done.output
    (tmp_path / "nodes.csv").write_text("\n".join(f"{row},{z}" for row, z in zip(rows, "z55", strict=True)))
    assert not call(
        "history", study(tmp_path), tmp_path / "nodes.csv", "-o", tmp_path / "nodes.vtu"
    ).exit_code
    mesh = meshio.read(tmp_path / "nodes.vtu")
    assert mesh.point_data["id"].tolist() == [7]
    assert mesh.points.tolist() == [[0, 0, 5]]


def test_a_single_point_needs_no_place(tmp_path: Path) -> None:
    stress = np.zeros((1, 2, 6))
    stress[0, 1, 0] = 100.0
    write(tmp_path / "one.csv", stress, "step,xx,yy,zz,yz,xz,xy")
    assert float(evaluate_history(tmp_path / "one.csv", study(tmp_path)).SWT[0]) == pytest.approx(0.025)


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ("id,xx,yy,zz,yz,xz,xy\n1,0,0,0,0,0,0\n", "the columns id, xx, .*; allowed: a header with step"),
        ("step,xx,yy,zz,yz,xz,xy\n0,0,0,0,0,0,-\n", "line 2, xy: found '-'"),
        ("step,xx,yy,zz,yz,xz,xy\n", "found no rows; allowed: a row for each step of each point"),
        (
            f"id,step,xx,yy,zz,yz,xz,xy\n{''.join(f'{k},{step},0,0,0,0,0,0' + chr(10) for k, step in STEPS)}",
            "other steps at the point 2 than at 1; allowed: the same steps at each point",
        ),
    ],
)
def test_wrong_tables_are_named(tmp_path: Path, table: str, words: str) -> None:
    (tmp_path / "stress.csv").write_text(table)
    refused(words, evaluate_history, tmp_path / "stress.csv", study(tmp_path))


@pytest.mark.parametrize("names", ["S11,S22,S33,S12", "xx,yy,zz,xy"])
def test_plane_elements_have_no_shear_across(tmp_path: Path, names: str) -> None:
    file = tmp_path / "plane.csv"
    file.write_text(f"id,step,{names}\na,0,1,2,3,4\na,1,5,6,7,8\n")
    with pytest.warns(UserWarning, match=r"(S13 = S23|yz = xz) = 0, of plane elements"):
        found = read_history(file)
    assert found.stress.values.tolist() == [[[1, 2, 3, 0, 0, 4], [5, 6, 7, 0, 0, 8]]]
    file.write_text(f"id,step,{names.rpartition(',')[0]}\na,0,1,2,3\n")
    words = "found no yz or xz or xy among id, step, .*; allowed: .* of plane elements without the two across"
    refused(words, read_history, file)


def test_the_command_names_files_of_another_kind(tmp_path: Path) -> None:
    (tmp_path / "stresses.csv").write_text("step,xx,yy,zz,yz,xz,xy\n0,100,0,0,0,0,0\n1,0,0,0,0,0,0\n")
    file, own = tmp_path / "stresses.csv", study(tmp_path)
    other = call("history", own, file, "-o", tmp_path / "lives.vtk")
    assert "lives.vtk; allowed: a file that ends with .csv, .vtu, .nc" in other.output
    assert not (tmp_path / "lives.vtk").exists()
    assert (
        "stresses.csv: found a table of values (CSV); allowed: a study" in call("history", file, own).output
    )


def of_a_point(folder: Path, units: str = "") -> Path:
    """A cycle of one point, with a row of units."""
    write(
        folder / "own.csv", np.random.default_rng(1).normal(size=(1, 5, 6)) * 100.0, "step,xx,yy,zz,yz,xz,xy"
    )
    head, *rows = (folder / "own.csv").read_text().splitlines()
    (folder / "own.csv").write_text("\n".join([head, *[units] * bool(units), *rows]))
    return folder / "own.csv"


def test_components_go_by_their_names(tmp_path: Path) -> None:
    history, rig = read_history(of_a_point(tmp_path)), study(tmp_path)
    right = float(evaluate_history(history, rig).SWT[0])
    assert float(evaluate_history(history.sortby("component"), rig).SWT[0]) == right
    abaqus = history.isel(component=[0, 1, 2, 5, 4, 3])
    abaqus["component"] = ["S11", "S22", "S33", "S12", "S13", "S23"]
    assert float(evaluate_history(abaqus.isel(component=[5, 1, 2, 4, 3, 0]), rig).SWT[0]) == right
    assert float(evaluate_history(history.drop_vars("component"), rig).SWT[0]) == right
    with pytest.raises(StudyError, match=r"component: found xx, .*; allowed: xx, yy, zz, yz, xz, xy or S11"):
        evaluate_history(history.isel(component=[0, 1, 2]), rig)


@pytest.mark.filterwarnings("ignore:.*read as units")
def test_stresses_in_another_unit_than_the_study_are_converted(tmp_path: Path) -> None:
    rig = study(tmp_path)
    own, scaled = {}, dict.fromkeys(NAMES, 1e6)
    for unit, form in (
        ("MPa", {}),
        ("Pa", {"scale": scaled}),
        ("GPa", {"scale": dict.fromkeys(NAMES, 1e-3)}),
    ):
        history = read_history(of_a_point(tmp_path, ",".join(["-", *["MPa"] * 6])), **form)
        assert history.stress.attrs == {"units": unit}
        own[unit] = float(evaluate_history(history, rig).SWT[0])
    assert own["Pa"] == pytest.approx(own["MPa"], rel=1e-12) == own["GPa"]
    in_pascal = read_history(of_a_point(tmp_path, "-,Pa,Pa,Pa,Pa,Pa,Pa"))
    assert float(evaluate_history(in_pascal, rig).SWT[0]) == pytest.approx(1e-12 * own["MPa"])


@pytest.mark.filterwarnings("ignore:.*read as units")
@pytest.mark.parametrize(("unit", "of_study"), [("N/mm²", "MPa"), ("N/mm2", "N/mm²"), ("Pa", "torr")])
def test_units_of_one_size_and_unknown_units_are_let_pass(tmp_path: Path, unit: str, of_study: str) -> None:
    history = read_history(of_a_point(tmp_path, ",".join(["-", *[unit] * 6])))
    assert history.stress.attrs == {"units": unit}
    rig = study(tmp_path)
    rig.write_text(rig.read_text().replace("MPa", of_study))
    assert evaluate_history(history, rig).SWT.attrs["units"] == of_study


@pytest.mark.filterwarnings("ignore:.*read as units", "ignore:.*= 0, of plane elements")
@pytest.mark.parametrize(
    ("form", "unit"),
    [
        ({"scale": dict.fromkeys(NAMES, 1e-6)}, "MPa"),
        ({"scale": dict.fromkeys(NAMES, -1e-3)}, "kPa"),
        ({"scale": dict.fromkeys(NAMES, 1.0)}, None),  # the unit in the file is wrong
        ({"scale": {"xy": -1.0}}, "Pa"),
    ],
)
def test_a_scale_gives_the_unit(tmp_path: Path, form: dict[str, dict[str, float]], unit: str | None) -> None:
    in_pascal = of_a_point(tmp_path, "-,Pa,Pa,Pa,Pa,Pa,Pa")
    assert read_history(in_pascal, **form).stress.attrs.get("units") == unit


@pytest.mark.filterwarnings("ignore:.*read as units")
@pytest.mark.parametrize(
    ("units", "form", "words"),
    [
        ("-,Pa,Pa,Pa,Pa,Pa,Pa", {"scale": {"xx": 1e-6}}, "scale: found .* times 1 and 'xx' times 1e-06"),
        ("-,Pa,MPa,Pa,Pa,Pa,Pa", {}, "one unit of all components"),
        (",mm,Pa,Pa,Pa,Pa,Pa", {}, "'xx' in mm as xx, which is a stress"),
    ],
)
def test_columns_without_one_unit_are_refused(
    tmp_path: Path, units: str, form: dict[str, dict[str, float]], words: str
) -> None:
    refused(words, read_history, of_a_point(tmp_path, units), **form)


@pytest.mark.filterwarnings("ignore:.*decimal = ','")
def test_stresses_with_decimal_commas(tmp_path: Path) -> None:
    """The step, which is needed, has none."""
    rows = ["step;xx;yy;zz;yz;xz;xy", "0;1,5;0;0;0;0;0", "1;-2,5;0;0;0;0;1"]
    (tmp_path / "a.csv").write_text("\n".join(rows))
    assert read_history(tmp_path / "a.csv").stress.values[0, :, 0].tolist() == [1.5, -2.5]


def test_other_headers_have_units_and_places_of_their_own(tmp_path: Path) -> None:
    """Without the step, wherever it stands."""
    rows = ["a [Pa],b [Pa],c [Pa],d [Pa],e [Pa],f [Pa],step", *(f"1,2,3,4,5,{k}e6,{k}" for k in (6, 7))]
    (tmp_path / "other.csv").write_text("\n".join(rows))
    history = read_history(tmp_path / "other.csv", order="abaqus")
    assert history.stress.attrs == {"units": "Pa"}
    assert history.stress.values[0].tolist() == [[1, 2, 3, k, 5, 4] for k in (6e6, 7e6)]
    (tmp_path / "other.csv").write_text("\n".join(f"Mises,{row}" for row in rows))
    with pytest.raises(StudyError, match=r"Mises, a \[Pa\], .*; allowed: six columns of components beside"):
        read_history(tmp_path / "other.csv", order="abaqus")
    (tmp_path / "other.csv").write_text("\n".join(row.partition(",")[2] for row in rows))
    with pytest.raises(StudyError, match=r"found .*; allowed: six columns of components beside step"):
        read_history(tmp_path / "other.csv", order="abaqus")


@pytest.mark.parametrize(
    ("headers", "places"),
    [
        ("SX,SY,SZ,SXY,SYZ,SXZ", [0, 1, 2, 5, 3, 4]),  # of Ansys
        ("s11,s22,s33,s12,s13,s23", [0, 1, 2, 5, 4, 3]),
        ("sigma_x,sigma_y,sigma_z,tau_xy,tau_yz,tau_zx", [0, 1, 2, 5, 3, 4]),
        (
            "Stress XX [MPa],Stress YY [MPa],Stress ZZ [MPa],Stress XY [MPa],Stress YZ [MPa],Stress ZX [MPa]",
            [0, 1, 2, 5, 3, 4],
        ),
        ("S.S12,S.S11,S.S22,S.S33,S.S13,S.S23", [5, 0, 1, 2, 4, 3]),
    ],
)
def test_headers_say_the_components(tmp_path: Path, headers: str, places: list[int]) -> None:
    """In capitals or not, and so the other columns: X and Step are x and step."""
    file = tmp_path / "stresses.csv"
    rows = [f"{step},0.5,{','.join(str(10 * step + place) for place in places)}" for step in (1, 2)]
    file.write_text("\n".join([f"Step,X,{headers}", *rows]))
    found = read_history(file)
    assert found.stress.values.tolist() == [[[10 * step + k for k in range(6)] for step in (1, 2)]]
    refused(r"allowed: no order: the headers .* name the components", read_history, file, order="swtstudy")
    file.write_text("\n".join([f"Step,X,{headers},xx", *(f"{row},0" for row in rows)]))
    refused("each xx; allowed: one of them", read_history, file)


def test_an_id_of_each_row_is_told(tmp_path: Path) -> None:
    rows = ["id,step,xx,yy,zz,yz,xz,xy", *(f"{k},{k},{100 * k},0,0,0,0,0" for k in range(3))]
    (tmp_path / "stresses.csv").write_text("\n".join(rows))
    with pytest.warns(UserWarning, match="one step at each point, .* have the same id"):
        read_history(tmp_path / "stresses.csv")


def test_coordinates_of_two_kinds_are_no_components(tmp_path: Path) -> None:
    rows = ["step,x1,y1,z1,T,xx,yy,zz,yz,xz,xy", *(f"{step},9,9,9,20,1,2,3,4,5,6" for step in (0, 1))]
    (tmp_path / "stresses.csv").write_text("\n".join(rows))
    assert read_history(tmp_path / "stresses.csv").stress.values.tolist() == [[[1, 2, 3, 4, 5, 6]] * 2]


def test_the_command_takes_other_headers(tmp_path: Path) -> None:
    rows = ["Frame,Node,a,b,c,d,e,f", *(f"{step},7,{100 * step},0,0,0,0,0" for step in (0, 1))]
    (tmp_path / "stresses.csv").write_text("\n".join(rows))
    own = "history", study(tmp_path), tmp_path / "stresses.csv", "--order", "ansys"
    assert "largest SWT = 0.025 MPa" in call(*own, "--column", "step=Frame", "--column", "id = Node").stdout
    assert "--column: found 'step'; allowed: a name and a header" in call(*own, "--column", "step").output


@pytest.mark.filterwarnings("always:stresses up to")
def test_the_command_takes_other_encodings_and_units(tmp_path: Path) -> None:
    """Stresses of a size that no metal has are in another unit."""
    rows = ["Node Label,Frame,Größe,SX,SY,SZ,SXY,SYZ,SXZ"]
    rows += [f"7,{step},1,{1e8 * step},0,0,0,0,0" for step in (0, 1)]
    (tmp_path / "stresses.csv").write_text("\n".join(rows), "latin-1")
    own = "history", study(tmp_path), tmp_path / "stresses.csv", "--encoding", "latin-1"
    assert "largest SWT = 0.025 MPa" in call(*own, "--unit", "Pa").stdout
    told = call(*own).output
    assert "Warning: stresses up to 1e+08 MPa are 500 of young_modulus: are they in another unit?" in told
    assert "--unit: found 'kPsi'; allowed: one of Pa, " in call(*own, "--unit", "kPsi").output


def test_labels_of_nodes_and_elements_are_ids_where_there_is_one(tmp_path: Path) -> None:
    rows = ["Element Label,Step,xx,yy,zz,yz,xz,xy", "7,0,0,0,0,0,0,0", "7,1,1,0,0,0,0,0"]
    (tmp_path / "one.csv").write_text("\n".join(rows))
    assert read_history(tmp_path / "one.csv").id.values.tolist() == ["7"]
    both = [f"{node},{row}" for node, row in zip(("Node", "1", "1"), rows, strict=True)]
    (tmp_path / "both.csv").write_text("\n".join(both))
    assert "id" not in read_history(tmp_path / "both.csv").coords
    named = read_history(tmp_path / "both.csv", columns={"id": "Node"})
    assert named.id.values.tolist() == ["1"]


def test_an_axis_is_not_a_property_of_a_history(tmp_path: Path) -> None:
    rig = study(tmp_path)
    rig.write_text(rig.read_text() + "[axes]\nwalker_exponent = [0.4, 0.5]\n")
    with pytest.raises(StudyError, match=r"axes.walker_exponent: found an axis; allowed: one number"):
        evaluate_history(_written(tmp_path, np.zeros((1, 2, 6))), rig)


@pytest.mark.parametrize("shift", [1e-3, 1e-12])
def test_coordinates_that_change_from_step_to_step_are_told(tmp_path: Path, shift: float) -> None:
    """All steps at places of their own, and steps at one of two places."""
    count = 4 if shift > 1e-6 else 2
    rows = [f"{1.0 + shift * (step % count)!r},0,0,{step},{step},0,0,0,0,0" for step in range(4)]
    (tmp_path / "moves.csv").write_text("\n".join(["x,y,z,step,xx,yy,zz,yz,xz,xy", *rows]))
    words = "rows of one point have the same id, whatever its coordinates"
    if count == 4:
        with pytest.warns(UserWarning, match=f"one step at each point, which is no load cycle: {words}"):
            read_history(tmp_path / "moves.csv")
        return
    with pytest.raises(
        StudyError, match=rf"found other steps at the point \(1.0\d+1, 0.0, 0.0\) .*; {words}"
    ):
        read_history(tmp_path / "moves.csv")


def test_lives_beyond_the_range_of_the_constants_are_told(tmp_path: Path) -> None:
    """In the words of a run, as an attribute and by the command."""
    stress = np.zeros((3, 2, 6))
    stress[:, 1, 0] = 0.1, 700.0, 0.0
    write(tmp_path / "nodes.csv", stress)
    found = evaluate_history(tmp_path / "nodes.csv", study(tmp_path))
    words = found.cycles.attrs["validity"]
    assert words.startswith("cycles extrapolated at 1 of 3 points: ")
    assert words.endswith(", while the constants are known for 100 to 10⁷")
    done = call("history", study(tmp_path), tmp_path / "nodes.csv")
    assert f"{words}." in " ".join(done.stdout.split())
    write(tmp_path / "nodes.csv", stress[1:])
    assert "validity" not in evaluate_history(tmp_path / "nodes.csv", study(tmp_path)).cycles.attrs
