"""Pages, contacts and histories say what is kept of them, from the first word to the last."""

import base64
import gzip
import json
import re
import sys
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
import real
import stand_in
import xarray as xr
from kept import Kept, told
from made_up import SALTELLI, made_up
from matplotlib.figure import Figure
from told import RIG, sayings

import swtstudy
from swtstudy import FatigueConstants, Study, StudyError, evaluate_history, physical, read_history, run
from swtstudy.archive.paths import ArchiveError
from swtstudy.faces import html, site
from swtstudy.faces import page as pages
from swtstudy.faces.elements import write_history
from swtstudy.results.optimise import ends_of

FIGURE = """
[figure]
x = "phase"
hue = "normal_amplitude"
panels = "profile"
y = ["s", "s/s(phase=0)"]
caption = "As <i> measured."
"""
PLAIN = f"""
title = "Plain"
rtol = 1e-3
[fixed]
flat_radius = 0.5
[axes]
phase = {{ start = 0, stop = "2*pi", num = 9 }}
normal_amplitude = [0.25, "8/9"]
profile = ["paraboloid", "rounded_punch"]
{FIGURE}"""
SAMPLE = f"""{SALTELLI}[figure]
kind = "scatter"
x = "sample"
hue = "normal_amplitude"
"""
MAP = """
title = "A map"
[axes]
phase = { start = 0, stop = 3, num = 4 }
friction = [0.1, 0.2, 0.4, 0.8, 1.6]
[figure]
kind = "heatmap"
x = "phase"
vertical = "friction"
message = "The less friction the better."
"""
LOADS = """
title = "Loads"
[loads.loop]
vertices = [[0, 1], [1, 0], [0, -1]]
[loads.smooth]
normal = [[1, 0.5, 0]]
tangential = [[1, 0.3, 1]]
[axes]
load = ["harmonic", "loop", "smooth"]
friction = [0.3, 0.5]
[fixed]
normal_amplitude = 0.5
tangential_amplitude = 0.4
"""
UNITS = (
    real.without(real.plain("critical_distance", "quantities"), "[figure]")
    + """
[figure]
kind = "life"
x = "tangential_amplitude"
hue = "phase"
panels = "normal_force"
y = ["cycles"]
"""
)
STUDIES = {
    "plain": PLAIN,
    "loads": LOADS,
    "sample": SAMPLE,
    "map": MAP,
    "units": UNITS,
    "one": 'title = "One"\nfixed.phase = 1\n',
}


def words_of(text: str) -> dict[str, Any]:
    """The words of each section of a page but for its origin, the data of its scripts, and its links."""
    head, *sections = re.split(r'<section id="(\w+)"', text.partition("</style>")[2])
    parts = {"head": head} | dict(zip(sections[::2], sections[1::2], strict=True))
    parts.pop("origin", None)
    said: dict[str, Any] = {}
    for name, part in parts.items():
        whole = re.sub(r'(?s)<script.*?</script>|href="data:[^"]*"', "", part)
        plain = re.sub(
            r"<(?!/?(?:i|sub|sup|b)\b)[^>]*>", "\n", whole.replace(swtstudy.__version__, "VERSION")
        )
        said[name] = [line.strip() for line in unescape(plain).splitlines() if line.strip()]
        said[f"alt of {name}"] = re.findall(r'alt="([^"]*)"', part)
    (data,) = re.findall(r'(?s)id="about">(.*?)</script>', text) or ["{}"]
    return {name: each for name, each in said.items() if each} | {"data": short(json.loads(data))}


def short(data: Any) -> Any:
    """Data with the places of panels left out, which depend on letters."""
    if isinstance(data, dict):
        return {name: short(each) for name, each in data.items() if name != "box"}
    if isinstance(data, list):
        return [short(each) for each in data]
    return float(data) if isinstance(data, int) and not isinstance(data, bool) else data


@pytest.mark.usefixtures("unwrapped")
@pytest.mark.filterwarnings("ignore:indices are known to")
@pytest.mark.parametrize("name", STUDIES)
def test_pages(name: str, kept: Kept, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    monkeypatch.setattr("swtstudy.faces.page.embedded", lambda *_, **__: pages.Picture("data:,", 400, 300))
    monkeypatch.setattr("swtstudy.faces.page.inspect", lambda **_: Figure())
    monkeypatch.setattr("swtstudy.faces.contacts.PhysicalContact.inspect", lambda *_: Figure())
    found = run(Study.from_text(STUDIES[name]), tmp_path / f"{name}.nc", workers=1)
    kept(f"page_of_{name}", words_of(pages.page(found, name, "index.html")))
    entry = site.entry(found, name)
    kept(f"entry_of_{name}", [*entry[:3], entry.picture is not None])


STEEL = FatigueConstants(2e5, 1000.0, -0.1, 0.5, -0.6)
CONTACTS: dict[str, dict[str, Any]] = {
    "plain": {"normal_force": 200.0, "tangential_amplitude": 0.002},
    "several": {
        "young_modulus": [210e3, 150e3],
        "poisson_ratio": [0.3, 0.33],
        "profile": "rounded_punch",
        "flat_radius": 0.2,
        "normal_force": [100.0, 200.0],
        "tangential_force_amplitude": [10.0, 20.0, 30.0],
        "bulk_stress_amplitude": 5.0,
        "bulk_stress_ratio": 0.1,
        "bulk_stress_body": 2,
        "bodies": ["pad", "rod"],
    },
    "of_load": {
        "normal_force": 200.0,
        "load": swtstudy.LoadPath("rig", [[-10, -60], [10, 60]]),
        "tangential_force_amplitude": 1,
        "normal_force_amplitude": 1,
    },
    "in_plane": {
        "profile": "cylinder",
        "normal_force": 200.0,
        "tangential_force_amplitude": 60.0,
        "criterion": "fatemi_socie",
        "normal_sensitivity": 0.3,
        "yield_strength": 350.0,
    },
}


@pytest.mark.filterwarnings("ignore:Dundurs")
@pytest.mark.parametrize("name", CONTACTS)
def test_contacts(name: str, kept: Kept) -> None:
    contact = physical(**RIG | CONTACTS[name])
    said: dict[str, Any] = {"repr": repr(contact).splitlines(), "table": contact._repr_html_()}
    names = {*dir(contact)} - {*dir(object)} & {*contact.grid.rows}
    for attribute in sorted(names):
        if not attribute.startswith("_") and not callable(value := getattr(contact, attribute)):
            values = value if isinstance(value, xr.DataArray) else None
            said[attribute] = (
                str(value) if values is None else [*map(str, values.dims), *map(str, values.values.ravel())]
            )
    if name != "several":
        said["parameters"] = {key: str(each) for key, each in contact.parameters().items()}
    kept(f"contact_{name}", said)


def test_fields_of_contacts(kept: Kept) -> None:
    one, plane = (physical(**RIG | CONTACTS[name]) for name in ("plain", "in_plane"))
    for name, each in {
        "stress": one.stress_field([0.0, 0.2], 0.0, 0.1, body=2, time=[0.0, 1.0]),
        "swt": one.swt_field([0.0, 0.2], 0.0, 0.1),
        "shear": plane.swt_field([0.0, 0.2], 0.0, 0.1),
        "point": one.inspect_point(),
    }.items():
        kept(f"contact_{name}", told(each))


def test_lives_of_contacts(kept: Kept) -> None:
    contact = physical(**RIG | CONTACTS["plain"])
    s = xr.DataArray([0.1, 0.2], {"body": [1, 2]}, "body")
    kept("contact_swt_of_s", told(contact.swt(s).to_dataset(name="SWT")))
    lives = contact.cycles((real.ALUMINIUM, STEEL), s)
    kept("contact_lives", told(lives.to_dataset(name="cycles")))
    np.testing.assert_allclose(contact.cycles(STEEL, 0.2), lives[1])
    np.testing.assert_allclose(contact.cycles((real.ALUMINIUM, STEEL), 0.2, body=2), lives[1])
    np.testing.assert_allclose(contact.swt([0.1, 0.2]), contact.swt(s))


ELEMENTS = f"""
{real.UNITS}[material]
strength = 1000
strength_exponent = -0.1
ductility = 0.5
ductility_exponent = -0.6
yield_strength = 500
findley_limit = 300
[fixed]
young_modulus = 2e5
poisson_ratio = 0.3
normal_sensitivity = 0.3
"""


def of_elements(folder: Path, head: str = "id,x,y,z,step,xx,yy,zz,yz,xz,xy") -> Path:
    stress = np.random.default_rng(1).normal(size=(3, 5, 6)) * 100.0
    rows = [[f"P{p}", 0.5 * p, 0.0, 0.5, step, *stress[p, step]] for p in range(3) for step in range(5)]
    text = "\n".join([head, *(",".join(map(str, row)) for row in rows)])
    (folder / "own.csv").write_text(text)
    (folder / "rig.toml").write_text(ELEMENTS)
    return folder / "own.csv"


def test_histories_of_elements(kept: Kept, tmp_path: Path) -> None:
    history = read_history(of_elements(tmp_path))
    found = evaluate_history(history, tmp_path / "rig.toml")
    kept(
        "elements",
        told(history.assign_attrs(source="own.csv")) | {"found": told(found.drop_attrs(deep=False))},
    )
    write_history(found, tmp_path / "found.csv")
    kept("elements_table", told(pd.read_csv(tmp_path / "found.csv").to_xarray()))
    write_history(found, tmp_path / "found.nc")
    with xr.open_dataset(tmp_path / "found.nc") as again:
        assert again.SWT.attrs == {"units": "MPa"}


#: What is asked of contacts, by a name.
ASKED = sayings(r"""
poisson » one().with_parameters(poisson_ratio=0.2)
several » several.with_parameters(friction=0.2)
with » one().with_parameters(frictoin=0.2)
constants » one().cycles((STEEL, 3), 0.1)
criterion » in_plane.swt(0.1)
body » one().swt(s, 1)
label » one().swt(s.assign_coords(body=[1, 3]))
which » several.swt(0.1)
which life » one().cycles((STEEL, real.ALUMINIUM), 0.1)
negative » one().swt(-0.1)
third » one().swt(0.1, 3)
asked » one(rtol=1e-3, constants=STEEL, quantities=["von_mises"])
pairs » one(yield_strength=-1, findley_limit=[1, "x"], shear_constants=STEEL, bulk_stress_body=3)
solve » one().solve(2.0, quantities=["x"], critical_distance=-1, constants=3, yield_strength=0)
blocks » one().solve(blocks={"harmonic": 3})
no life » physical(**RIG | CONTACTS["plain"], criterion="findley",
    normal_sensitivity=0.3).solve(constants=STEEL)
minimise » one().optimise({"friction": (0.5, 0.6)}, "cycles")
over » one().optimise({"friction": (0.6, 0.5), "profile": (1, 2)}, "SWTs", rtol=1, seed=-1)
distances » one().optimise({"friction": (0.5, 0.6)}, "SWT_volume", critical_distance=[0.1, 0.2])
optimise » several.optimise({"friction": (0.5, 0.6)})
field » one().stress_field("a", np.inf, 0.0)
no body » one().parameters("pad")
named » several.parameters("pod")
lost » physical(**RIG, normal_force=10.0, tangential_force_amplitude=9.0).inspect_point()
units » swtstudy.solve(rtol=1e-2).swt.contact()
unknown » one().depths
""")


def test_messages_of_contacts(kept: Kept) -> None:
    contacts: dict[str, Any] = {name: physical(**RIG | CONTACTS[name]) for name in ("several", "in_plane")}
    contacts["one"] = lambda **more: physical(**RIG | CONTACTS["plain"] | more)
    contacts["s"] = xr.DataArray([0.1, 0.2], {"body": [1, 2]}, "body")
    said = {}
    for name, (call,) in ASKED:
        with pytest.raises((StudyError, AttributeError)) as caught:
            eval(call, globals() | contacts)
        said[name] = [str(each) for each in getattr(caught.value, "mistakes", [caught.value])]
    kept("messages_of_contacts", said)


def test_messages_of_histories(kept: Kept, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    own = of_elements(Path())
    rows = own.read_text().splitlines()
    said: dict[str, list[str]] = {}

    def tell(name: str, lines: list[str], study: str = ELEMENTS, **form: Any) -> None:
        Path("a.csv").write_text("\n".join(lines))
        Path("rig.toml").write_text(study)
        body = form.pop("body", 1)
        with pytest.raises(StudyError) as caught:
            evaluate_history(read_history("a.csv", **form), "rig.toml", body)
        said[name] = [str(each) for each in caught.value.mistakes]

    tell("order", rows, order="nastran")
    tell("named", rows, order="abaqus")
    tell("headers", [rows[0].replace("xx", "a"), *rows[1:]])
    tell("few", ["step,a,b", "1,2,3"], order="abaqus")
    tell("steps", rows[:-1])
    tell("twice", [*rows[:2], rows[1], *rows[2:-1]])
    tell("one point", ["step,xx,yy,zz,yz,xz,xy", *["0,1,2,3,4,5,6"] * 2])
    tell("unknown", rows, scale={"S11": 2.0, "stress": 1.0})
    tell("scales", rows, body=3)
    tell("no units", rows, ELEMENTS.replace("[units]", "[limits]"))
    tell("values", rows, ELEMENTS.replace("2e5", "'stiff'").replace("poisson_ratio = 0.3\n", ""))
    tell("axis", rows, ELEMENTS.replace("young_modulus = 2e5\n", "") + "[axes]\nyoung_modulus = [1, 2]\n")
    kept("messages_of_histories", said)


def test_shares_values_and_symbols() -> None:
    """The words of a page for numbers, angles, names and symbols."""
    said = {share: html.share(share) for share in (0.0, 1.0, 0.5, 0.054, 0.9996, 9e-5, 0.00999, 0.9, 1.2)}
    assert said == {
        0.0: "0 %", 1.0: "100 %", 0.5: "50 %", 0.054: "5 %", 0.9996: "99.96 %", 9e-5: "0.009 %",
        0.00999: "1.0 %", 0.9: "90 %", 1.2: "120 %",
    }  # fmt: skip
    body = {"flag_values": [1, 2], "flag_meanings": "upper_pad rod"}
    for name, value, attributes, words in (
        ("phase", np.nan, {}, "–"),
        ("s", -np.inf, {}, "–"),
        ("s", -0.25, {}, "−0.25"),
        ("s", 3, {}, "3"),
        ("phase", 0.0, {}, "0"),
        ("phase", -0.5, {}, "−0.159π"),
        ("phase", np.pi / 2, {}, "π/2"),
        ("phase", True, {}, "True"),
        ("profile", "rounded_punch", {}, "rounded punch"),
        ("load", "a-b", {}, "a-b"),
        ("body", 1, body, "upper pad"),
        ("friction", -0.5, {}, "−0.5"),
    ):
        assert html.value_text(name, value, attributes) == words, (name, value)
    for latex, symbol in (
        (r"\delta_A/\delta_0", "<i>δ</i><sub><i>A</i></sub>/<i>δ</i><sub>0</sub>"),
        (r"G^* u", "<i>G</i><sup>*</sup><i>u</i>"),
        (r"\Delta s_{\mathrm{a, b}}", "<i>Δ</i><i>s</i><sub>a, b</sub>"),
        (r"\lambda/\sqrt{hR}", "<i>λ</i>/√(<i>h</i><i>R</i>)"),
        (r"\varphi\cdot\max x", "<i>φ</i>·max <i>x</i>"),
        (r"\ell_1^2 \approx \infty", "<i>ℓ</i><sub>1</sub><sup>2</sup>≈∞"),
        (r"<a>_{x_y}", "&lt;<i>a</i>&gt;<sub><i>x</i><sub><i>y</i></sub></sub>"),
        (r"-\text{two words}", "−two words"),
    ):
        assert html.symbol_html(latex) == symbol, latex


def test_what_a_page_cannot_draw_or_tell_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lines = (
        'title = "t"',
        "fixed.tangential_force_amplitude = 1.5",
        "axes.normal_force_amplitude = [0, 0.1]",
    )
    text = "\n".join(lines)
    monkeypatch.setattr("swtstudy.faces.page.embedded", lambda *_, **__: pages.Picture("data:,", 400, 300))
    monkeypatch.setattr(stand_in.SOLVER, stand_in.smooth)
    found = run(Study.from_text(text), tmp_path / "a.nc", workers=1)
    said = words_of(pages.page(found, "a"))["points"]
    assert said.count(next(line for line in said if line.startswith("Not drawn: "))) == 1
    assert "at which the body slides away or is lifted off (no equilibrium)" in " ".join(said)
    monkeypatch.setattr("swtstudy.faces.page.inspect", lambda **_: Figure())
    sample = run(Study.from_text(SAMPLE), tmp_path / "b.nc", workers=1)
    sample.s[0, 0] = np.nan
    assert "No indices: s: found no number at 1 of 64 points, such as friction=" in " ".join(
        words_of(
            pages.page(
                sample.drop_attrs(deep=False).assign_attrs(
                    {k: v for k, v in sample.attrs.items() if k != "figure"}
                ),
                "b",
            )
        )["matters"]
    )
    listed = site.listing(
        [site.Entry("a b", "Ä", "One.", None), site.Entry("c", "C", "", pages.Picture("data:,", 3, 2))]
    )
    assert re.findall('href="([^"d][^"]*)"', listed) == ["a%20b.html", "c.html"]
    assert [line for line in words_of(listed)["head"] if line[:4] in ("2 pa", "Ä", "One.", "C")] == [
        "2 parameter studies",
        "Ä",
        "One.",
        "C",
    ]
    assert "Made by swtstudy VERSION." in words_of(listed)["head"]


def test_other_parameters_of_the_same_bodies(kept: Kept) -> None:
    """Lengths follow from what they are measured in; loads of a pair replace one another."""
    one = physical(**RIG | CONTACTS["plain"])
    r = np.linspace(0.0, 2.0, 30)
    table = swtstudy.TabulatedProfile("pad", r, 0.5 * r * r, 0.0)
    said = {}
    for name, given in {
        "amplitude": {"normal_amplitude": 0.25, "friction": 0.7},
        "force": {"tangential_force_amplitude": 0.4},
        "shape": {"profile": "wavy_paraboloid", "waviness_amplitude": 0.02, "wavelength": 5.0},
        "table": {"profile": table},
    }.items():
        other = one.with_parameters(**given)
        said[name] = [
            *repr(other).splitlines(),
            *(f"{key} = {each}" for key, each in other.parameters().items()),
        ]
    kept("contact_with_parameters", said)


def test_a_mistake_of_a_place_is_told_as_it_is() -> None:
    contact = physical(**RIG | CONTACTS["plain"])
    x = xr.DataArray([0.0, 0.1], dims="time")
    with pytest.raises(StudyError, match=r"^x, y, z: found a dimension named time; allowed: other names"):
        contact.stress_field(x, 0.0, 0.0)


def test_a_table_may_lack_what_is_not_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    history = read_history(of_elements(tmp_path))
    (tmp_path / "rig.toml").write_text(ELEMENTS.replace("normal_sensitivity = 0.3\n", ""))
    found = evaluate_history(history, tmp_path / "rig.toml", 2)
    assert [*found.data_vars] == ["SWT", "SWT_normal", "cycles"]
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(StudyError) as caught:
        write_history(found, Path("a.vtu"))
    words = "output: found a.vtu; allowed: pip install meshio, which writes it; or a .csv file"
    assert str(caught.value) == words


def test_tables_of_pages_are_packed_for_spreadsheets() -> None:
    """Errors have two digits, other numbers seven; words that a spreadsheet runs have an apostrophe."""
    words = {"name": ["=1", "a=1"], "n": ["\t", ""], "sign": ["+1", "-1"], "function": ["@A", "\r"]}
    table = pd.DataFrame({"s": [1 / 3, 2.0], "s_error": [0.01234, 5e-9], **words})
    head, _, data = html.packed(table).partition(",")
    assert head == "data:application/gzip;base64"
    text = gzip.decompress(base64.b64decode(data)).decode()
    assert text.split("\n") == [
        "s,s_error,name,n,sign,function",
        "0.3333333,0.012,'=1,'\t,'+1,'@A",
        "2,5e-09,a=1,,'-1,'\r",
        "",
    ]


def test_reports_and_their_mistakes(kept: Kept, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is written where, in which order, and what is refused before anything is."""
    monkeypatch.chdir(tmp_path)
    for name in ("a/x.nc", "b/x.nc", "a/y.nc", "a/index.nc", "file", "c/z.nc"):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).touch()
    monkeypatch.setattr(site, "open_results", lambda path: broken() if Path(path).stem == "z" else path)
    monkeypatch.setattr(site, "page", lambda found, name, home="": f"page of {found}, {name}, {home}")
    monkeypatch.setattr(site, "entry", lambda _, name: site.Entry(name, f"title of {name}", "", None))

    def broken() -> None:
        raise ArchiveError("c/z.nc: not a readable archive")

    said: dict[str, Any] = {}
    for archives, output in (
        (["a/x.nc"], None),
        (["a/x.nc"], "page.HTM"),
        (["a/x.nc"], "site"),
        (["a/x.nc"], "v1.2/"),
        (["a/x.nc"], "a"),
        (["a/x.nc", "c/z.nc", "a/y.nc"], "site2"),
        (["c/z.nc"], "site3"),
        (["a/x.nc", "b/x.nc"], "site4"),
        (["a/index.nc"], "site4"),
        (["a/index.nc"], "index.html"),
        (["a/x.nc", "a/y.nc"], None),
        (["a/x.nc", "a/y.nc"], "one.html"),
        (["a/x.nc", "a/y.nc"], "file"),
        (["a/x.nc"], "page.pdf"),
    ):
        try:
            made = [f"{path.as_posix()}: {why}" for path, why in site.write_reports(archives, output, 1)]
        except ValueError as error:
            made = ["refused", *map(str, getattr(error, "mistakes", [error]))]
        texts = {
            p.as_posix(): p.read_text() for p in sorted(Path().rglob("*.[hH][tT]*")) if p.name != "index.html"
        }
        said[f"{archives} {output}"] = [made, texts]
        lists = [path for path in Path().rglob("index.html") if output]
        said[f"{archives} {output}"].append([re.findall('href="([^"]*html)"', p.read_text()) for p in lists])
        for path in [*map(Path, texts), *lists]:
            path.unlink()
    kept("reports", said)


@pytest.mark.filterwarnings("ignore:Dundurs")
def test_what_an_optimum_is_searched_over(kept: Kept, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is given in the place of a range is left out; both bodies and their materials stay."""
    searched: list[Any] = []
    monkeypatch.setattr("swtstudy.results.optimise.optimum_in", lambda *given: searched.append(given))
    one = physical(**RIG | CONTACTS["plain"])
    two = physical(
        **RIG | {"young_modulus": [210e3, 150e3], "normal_force": 100.0, "tangential_amplitude": 0.002}
    )
    one.optimise({"depth": (0.005, "0.01")})
    one.optimise(
        {"friction": (0.4, 0.5), "normal_amplitude": (0, 1e-3)}, "cycles", constants=real.ALUMINIUM, seed=3
    )
    two.optimise({"tangential_force_amplitude": (1, 9)}, "SWT_volume", critical_distance=0.1, rtol=1e-3)
    said = {}
    for corners, over, *asked in searched:
        low, high = ends_of(corners, over)
        ends = [*low.tolist(), *high.tolist()]
        axes = {name: [*map(str, values)] for name, values in corners.axes.items()}
        fixed = {name: str(value) for name, value in corners.fixed.items()}
        pairs = {name: [*map(float, both)] for name, both in corners.pairs.items()}
        middle = dict(zip(over, 0.5 * (low + high)[:, None], strict=True))
        more = [
            *map(str, asked),
            str(corners.materials),
            {name: [*map(float, v)] for name, v in middle.items()},
        ]
        said[", ".join(over)] = [ends, axes, fixed, pairs, *more]
    kept("contact_searches", said)


def test_a_table_keeps_s_where_it_is_the_same_everywhere() -> None:
    same = made_up(lambda phase, friction: 1.0 + 0.0 * (phase + friction), phase=[0.0, 1.0], friction=[0.3])
    assert {"phase", "s"} <= {*html.table_of(same)}
    assert [*html.table_of(same)] == ["phase", "friction", "s"]  # others with one value are told elsewhere
