"""Pages about archives: what they say, that they are whole, and that nothing in an archive can break them."""

import base64
import gzip
import json
import os
import re
import shutil
import subprocess
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from io import StringIO
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from command import call
from folders import RESULTS
from matplotlib.figure import Figure
from real import ALLOY, CRITERIA, SPHERE

import swtstudy
from swtstudy import Study
from swtstudy.faces.findings import extreme_points, indices_of, levers, parameters_of, sentences
from swtstudy.faces.html import about, place_html, table_of
from swtstudy.faces.page import Picture, caption_of, derived, embedded, page
from swtstudy.figures.style import picture
from swtstudy.study.figure import FigureLayout

VOID = {"meta", "link", "img", "br"}


class Checked(HTMLParser):
    """Elements that are closed as they were opened, ids that differ, and what a page loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.wrong: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.tags: list[str] = []
        self.texts: list[str] = []
        self.alts: list[str | None] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        known = dict(attrs)
        if len(known) != len(attrs):
            self.wrong.append(f"{tag} has an attribute twice")
        self.tags.append(tag)
        self.ids += [known["id"]] if known.get("id") else []
        self.links += [known[name] for name in ("href", "src") if known.get(name)]
        if tag == "img":
            self.alts.append(known.get("alt"))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if not self.open or self.open.pop() != tag:
            self.wrong.append(f"</{tag}> closes nothing")

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] not in ("script", "style"):
            self.texts.append(data)

    @property
    def text(self) -> str:
        return " ".join("".join(self.texts).split())


def checked(text: str) -> Checked:
    found = Checked(text)
    assert not found.wrong
    assert not found.open
    assert len(set(found.ids)) == len(found.ids)
    inside = [link for link in found.links if link.startswith("#")]
    assert {link[1:] for link in inside} <= set(found.ids)
    assert None not in found.alts
    return found


def study(
    folder: Path, title: str = "A study", axes: str = "phase = [0, 1, 2]\nnormal_amplitude=[0.25, 0.75]"
) -> xr.Dataset:
    text = f'title = {json.dumps(title)}\nrtol = 1e-3\n[axes]\n{axes}\n[figure]\nx = "phase"\n'
    hue = "" if "normal_amplitude" not in axes else 'hue = "normal_amplitude"\n'
    return swtstudy.run(swtstudy.Study.from_text(text + hue), folder / "small.nc")


def plain(html: object) -> str:
    """Words without tags."""
    return re.sub("<[^>]*>", "", str(html))


def told(dataset: xr.Dataset) -> list[str]:
    """The sentences about results, as words."""
    return [plain(each) for each in sentences(dataset)]


def read_multiple(words: str) -> float:
    """A multiple of π such as 0.86π, π/18 or 0."""
    number, _, below = words.partition("π")
    return float(number or "1") / float(below.removeprefix("/") or "1")


def said_in(dataset: xr.Dataset, section: str, name: str = "any") -> str:
    """One section of a page without its figure, or its head, as HTML."""
    attributes = {key: value for key, value in dataset.attrs.items() if key != "figure"}
    text = page(dataset.drop_attrs(deep=False).assign_attrs({"title": "t", "source": "s"} | attributes), name)
    whole = text.partition(f'id="{section}"')[2] if section != "head" else text.partition("<header")[2]
    return whole[: whole.index("</section>" if section != "head" else "</header>")]


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> xr.Dataset:
    return study(tmp_path_factory.mktemp("small"))


@pytest.fixture(scope="module")
def small_page(small: xr.Dataset) -> str:
    """A whole page; both points have the picture of the first one, as each takes seconds."""
    drawn: list[Figure] = []

    def drawn_once(**parameters: object) -> Figure:
        drawn[:] = drawn or [swtstudy.inspect(**parameters)]
        return drawn[0]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("swtstudy.faces.page.inspect", drawn_once)
        patch.setattr("swtstudy.faces.page.embedded", cache(embedded))
        return page(small, "small")


def table_in(text: str) -> pd.DataFrame:
    source = re.search(r'id="table" download="[^"]*" href="data:application/gzip;base64,([^"]*)"', text)
    assert source
    return pd.read_csv(StringIO(gzip.decompress(base64.b64decode(source[1])).decode()))


def test_the_page_is_whole_and_needs_nothing_else(small_page: str) -> None:
    found = checked(small_page)
    assert [link for link in found.links if not link.startswith(("#", "data:"))] == []
    assert "http" not in re.sub(
        r"https?://(www\.w3\.org|doi\.org)", "", re.sub(r"data:[^\"]*", "", small_page)
    )
    assert {"h1", "table", "figure", "details"} <= set(found.tags)


def test_without_scripts_everything_but_slices_is_there(small_page: str) -> None:
    found = checked(re.sub(r"<script.*?</script>", "", small_page, flags=re.DOTALL))
    for words in ("Extremes", "Best and worst", "Settings", "How sure", "Origin", "relative error"):
        assert words in found.text
    hidden = re.findall(r'<section id="(\w+)" data-script hidden>', small_page)
    assert hidden == ["slice"]


def test_the_sentence_is_that_of_the_extrema() -> None:
    dataset = swtstudy.open_results(RESULTS / "figure3.nc")
    extremes = dataset.swt.extrema("phase")
    most = extremes.isel(normal_amplitude=int(extremes.ratio.argmax("normal_amplitude")))
    first = told(dataset)[0]
    assert f"changes s by a factor of {float(most.ratio):.3g} at δA/δ0 = 8/9" in first
    said = re.search(r"best at (.*), worst at (.*)\.$", first)
    assert said
    for words, place in zip(said.groups(), (most.at_minimum, most.at_maximum), strict=True):
        assert np.pi * read_multiple(words) == pytest.approx(float(place), rel=5e-3)


def test_the_phase_is_the_first_lever_and_others_go_by_their_ratio() -> None:
    found = levers(swtstudy.open_results(RESULTS / "figure5.nc"))
    assert [lever.name for lever in found] == ["phase", "profile", "flat_radius"]
    assert found[1].ratio > found[2].ratio


def test_of_real_contacts_with_lives_the_sentence_is_about_these(without_points: None) -> None:
    dataset = swtstudy.open_results(RESULTS / "sphere_on_flat.nc")
    extremes = {word: float(one.cycles) for word, one in extreme_points(dataset).items()}
    assert extremes == {"longest": float(dataset.cycles.max()), "shortest": float(dataset.cycles.min())}
    said = told(dataset)
    assert all("changes the life N by a factor of" in each for each in said[:3])
    assert said[0].startswith("The phase")  # which the figure is over
    assert "100 N" in said[0]
    # Where the constants are known for both lives.
    most, least = dataset.cycles.max("phase"), dataset.cycles.min("phase")
    ratio = float((most / least).where((least >= 1e2) & (most <= 1e7)).max())
    assert ratio < float((most / least).max())
    assert f"by a factor of {ratio:.3g} at" in said[0]
    constants = said_in(dataset, "settings").partition("Strain-life constants")[2]
    assert re.findall(">([^<]*)</td>", constants)[:4] == ["young modulus", "73100 MPa", "strength", "927 MPa"]
    assert '<td>young modulus</td><td class="n">73100 MPa</td>' in constants


def test_limits_of_the_stress_are_said_beside_the_constants(tmp_path: Path, without_points: None) -> None:
    text = RECORD.replace("yield_strength = 100", "yield_strength = [350, 420]")
    found = swtstudy.run(Study.from_text(text), tmp_path / "rig.nc")
    body = said_in(found, "settings").partition("Limits of the stress")[2]
    assert re.findall(">([^<]*)</td>", body) == ["yield strength", "350 MPa", "yield strength", "420 MPa"]


@pytest.mark.parametrize(
    "name", ["figure6", "sphere_on_flat", "sensitivity", "loops", "bulk_stress", "plane_contacts", "criteria"]
)
def test_a_point_is_inspected_with_what_it_was_solved_with(name: str) -> None:
    dataset = swtstudy.open_results(RESULTS / f"{name}.nc")
    for one in extreme_points(dataset).values():
        own = one.swt.contact().parameters() if "contact" in one.attrs else parameters_of(one)
        again = swtstudy.solve(rtol=1e-4, **own)
        assert float(again.s) == pytest.approx(float(one.s), rel=2e-3)


def test_values_of_several_criteria_are_not_compared() -> None:
    dataset = swtstudy.open_results(RESULTS / "criteria.nc")
    assert "criterion" not in [lever.name for lever in levers(dataset)]
    first = dataset.isel(criterion=0)
    assert {word: float(one.s) for word, one in extreme_points(dataset).items()} == {
        "lowest": float(first.s.min()),
        "highest": float(first.s.max()),
    }


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.* has no effect:UserWarning")
def test_criteria_in_units_are_each_in_their_own(tmp_path: Path, without_points: None) -> None:
    """A phase moves nothing where the normal load is constant."""
    still = swtstudy.run(Study.from_text(f"{CRITERIA}phase = [0, 1]\n"), tmp_path / "still.nc")
    values = {"SWT": " MPa", "f": " MPa", "FS": ""}
    names = dict(zip(values, ("SWT", "findley_stress", "FS"), strict=True))
    said = told(still)
    for line, (symbol, unit), criterion in zip(said, values.items(), still.criterion.values, strict=False):
        own = f"{float(still[names[symbol]].sel(criterion=criterion)[0]):.4g}"
        word = criterion.replace("_", " ")
        assert line == f"{word}: At all 2 points {symbol} is {own}{unit}: nothing that was varied changes it."
    assert [line.partition(" = ")[0] for line in said[3:]] == ["N by SWT", "N by FS"]
    assert "none without a value" in said_in(still, "head")
    # The sensitivity is that of the others: SWT is drawn without it.
    (worst,) = extreme_points(still).values()
    assert "normal_sensitivity" not in worst.swt.contact().parameters()
    again = swtstudy.solve(rtol=1e-3, **worst.swt.contact().parameters())
    assert float(again.s) == pytest.approx(float(worst.s), rel=1e-6)


@pytest.mark.slow
def test_what_moves_several_criteria_is_said_of_each_by_its_name_and_unit(
    tmp_path: Path, without_points: None
) -> None:
    text = CRITERIA.replace("tangential_force_amplitude = 60\n", "")
    text += "tangential_force_amplitude = [40, 60]\n"
    both = swtstudy.run(Study.from_text(text), tmp_path / "both.nc")
    said = told(both)[0]
    assert " QA changes SWT by a factor of " in said
    assert said.endswith(" for criterion swt: best at 40 N, worst at 60 N.")
    rows = re.findall(r"<tr>(.*?)</tr>", said_in(both, "extremes"))[1:]
    cells = {each[0]: each for each in (re.sub("<[^>]*>", "|", row).strip("|").split("||") for row in rows)}
    for criterion, name, unit in (("findley", "findley_stress", " MPa"), ("fatemi socie", "FS", "")):
        least = both[name].sel(criterion=criterion.replace(" ", "_")).min().item()
        assert cells[criterion][1:3] == [f"{least:.4g}{unit}", "40 N"]


def test_the_table_of_a_page_is_that_of_the_results(small: xr.Dataset, small_page: str) -> None:
    table, whole = table_in(small_page), small.swt.to_table()
    assert list(table.s) == pytest.approx(list(whole.s), rel=1e-6)
    assert list(table.regime) == list(whole.regime.astype(str))
    assert list(table.s_error) == pytest.approx(list(whole.s_error), rel=0.06)
    assert {"phase", "normal_amplitude", "critical_x"} <= {*table}


def test_ratios_that_a_figure_shows_go_with_the_table(small: xr.Dataset) -> None:
    layout = FigureLayout(x="phase", y=("s", "s/s(phase=0)"))
    found = derived(small, layout, ["normal_amplitude", "phase"])
    assert list(found) == ["s/s(phase=0)", "s/s(phase=0)_error"]
    s = small.s.transpose("normal_amplitude", "phase").values
    np.testing.assert_allclose(found["s/s(phase=0)"], (s / s[:, :1]).ravel(), rtol=1e-5)
    assert found["s/s(phase=0)_error"][::3] == [0.0, 0.0]


@pytest.mark.parametrize(("count", "spelled"), [(60, 60), (61, 0)])
def test_scripts_are_given_the_words_of_few_values(small: xr.Dataset, count: int, spelled: int) -> None:
    many = small.isel(phase=[0] * count)
    (phase,) = (dim for dim in about(many, table_of(many))["dims"] if dim["name"] == "phase")
    assert (phase["size"], phase["words"]) == (count, ["0"] * spelled)


@pytest.mark.slow
def test_hostile_names_and_titles_are_words(tmp_path: Path) -> None:
    title = '</title><script>alert("x")</script> & <img src=x onerror=alert(1)> "quoted" \'it\' \x1b[31m'
    text = page(study(tmp_path, title, axes="phase = [0, 1]"), '"><script>alert(2)</script>')
    found = checked(text)
    assert found.tags.count("script") == 2  # the values, and what shows them
    assert "x" not in found.links
    assert " ".join(title.replace("\x1b", "\N{REPLACEMENT CHARACTER}").split()) in found.text
    assert "\x1b" not in text


@pytest.mark.slow
def test_hostile_attributes_are_words(small: xr.Dataset) -> None:
    bad = "</script><b>bad</b>\\mathrm{<b>}"
    dataset = small.copy()
    for name in ("phase", "s", "critical_x"):
        dataset[name] = dataset[name].assign_attrs(symbol=bad, units="<i>m</i>", long_name=bad)
    dataset.attrs |= {"history": f"{bad}\n{bad}", "references": bad, "versions": bad, "source": bad}
    found = checked(page(dataset, "name"))
    assert found.tags.count("script") == 2
    assert "<b>bad</b>" in found.text


def test_every_symbol_is_html() -> None:
    symbols = set()
    for name in ("criteria", "sphere_on_flat", "life", "bulk_stress", "figure7"):
        found = swtstudy.open_results(RESULTS / f"{name}.nc")
        symbols |= {each["symbol"] for each in about(found, table_of(found))["columns"].values()}
        symbols |= {str(place_html(found[name])) for name in found.coords if not found[name].ndim}
    assert len(symbols) > 25
    for text in symbols:
        assert not set(text.partition(" = ")[0]) & set("\\{}^_$")
        checked(text)


def test_what_is_sure_has_regimes_where_points_have_one(
    small: xr.Dataset, monkeypatch: pytest.MonkeyPatch, without_points: None
) -> None:
    assert "<h3>Regimes</h3>" in said_in(small, "sure")
    monkeypatch.setattr("swtstudy.archive.describe.regime_counts", lambda _: {})
    assert "Regimes" not in said_in(small, "sure")


@pytest.mark.slow
def test_a_large_table_is_left_out(small: xr.Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("swtstudy.faces.html.LARGEST_TABLE", 100)
    text = page(small, "small")
    assert 'id="table"' not in text
    assert "too many for a page" in checked(text).text


@pytest.mark.slow
@pytest.mark.parametrize("name", ["figure5", "figure8"])
def test_pages_of_the_largest_figures_are_below_two_megabytes(name: str) -> None:
    assert len(page(swtstudy.open_results(RESULTS / f"{name}.nc"), name)) < 2_000_000


@pytest.mark.parametrize("y", ["s/s(load=<b>)", "s / s( load = <b> )"])
def test_a_name_in_a_quantity_of_a_figure_is_text(small: xr.Dataset, y: str) -> None:
    layout = replace(FigureLayout.from_json(small.attrs["figure"]), y=(y,))
    assert caption_of(small, layout).startswith(y.replace("<b>", "&lt;b&gt;"))


def constant(dataset: xr.Dataset, s: list[float]) -> xr.Dataset:
    """Results of one amplitude with other values of s."""
    one = dataset.isel(normal_amplitude=[0])
    return one.assign(s=one.s.copy(data=np.reshape(s, one.s.shape)))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ([np.nan] * 3, "No point has a finite s."),
        ([np.nan, 0.25, np.nan], "s is 0.25 at one of 3 points; the others have none."),
        ([0.25, 0.25, 0.2501], "At all 3 points s is 0.25: nothing that was varied changes it."),
        ([0.0, 0.0, 0.0], "At all 3 points s is 0: nothing that was varied changes it."),
        ([0.0, 0.1, 0.3], "Over 3 points s goes from 0 to 0.3, median 0.1."),
        ([np.nan, 0.1, 0.3], "The phase of the normal oscillation ψ changes s by a factor of 3: best at"),
    ],
)
def test_the_sentence_of_odd_studies(
    small: xr.Dataset, values: list[float], said: str, without_points: None
) -> None:
    dataset = constant(small, values)
    (sentence,) = told(dataset)
    assert sentence.startswith(said)
    missing = int(np.isnan(values).sum())
    assert f"3 × 1, {missing or 'none'} without a value" in re.sub("<[^>]*>", "", said_in(dataset, "head"))


@pytest.mark.quick(4)
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("figure5", "factor of 1.54 for the truncated paraboloid at "),
        ("figure5", ": lowest for the rounded punch, highest for the truncated paraboloid."),
        ("loops", "for load L: lowest at 0.05"),
        ("loops", "at μ = 1: best for diagonal, worst for L."),
        ("criteria", "for criterion swt at μ = 0.25: best at "),
        # The first answers the question of the study.
        ("figure7", "^The amplitude of the waviness h/δ0 changes s"),
        ("sensitivity", "^The coefficient of friction μ matters most, with a Sobol index of 0.63 to 0.68;"),
        ("life", "^The amplitude of the tangential oscillation uA changes the life Nvolume"),
    ],
)
@pytest.mark.filterwarnings("ignore:indices are known to")
def test_the_headline_has_no_name_as_a_place(name: str, said: str) -> None:
    dataset = swtstudy.open_results(RESULTS / f"{name}.nc")
    found = re.sub("<.*?>", "", " ".join(sentences(dataset, indices_of(dataset))))
    assert re.search(said, found)


@pytest.mark.filterwarnings("ignore:Dundurs")
def test_bodies_are_called_by_their_names() -> None:
    contacts = swtstudy.physical(
        young_modulus=[210e3, 150e3], poisson_ratio=0.3, radius=10.0, friction=0.5, normal_force=100.0,
        tangential_force_amplitude=[10.0, 20.0], bodies=["test_piece", "pad"],
    )  # fmt: skip
    words = " ".join(told(contacts.solve(rtol=1e-2)))
    assert "changes SWT by a factor of 1.88 for body test piece: best at 10, worst at 20." in words
    assert (
        "The body changes SWT by a factor of 1.4 at QA = 10: lowest for test piece, highest for pad." in words
    )


def test_the_page_of_a_figure_of_the_paper_holds_it_against_the_paper(without_points: None) -> None:
    dataset = swtstudy.open_results(RESULTS / "figure3.nc")
    dataset.attrs.pop("figure")
    text = page(dataset, "figure3").partition('id="paper"')[2]
    (paper,) = pd.read_html(StringIO(text[: text.index("</section>")]))
    assert [*paper.columns] == ["place", "the paper says", "found", "holds"]
    assert len(paper) > 2
    assert {*paper.holds} == {"yes"}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["life", "figure4", "sensitivity"])
@pytest.mark.filterwarnings("ignore:indices are known to")
def test_what_keeps_to_one_line_is_marked_once(name: str, without_points: None) -> None:
    text = page(swtstudy.open_results(RESULTS / f"{name}.nc"), name)
    tied = re.findall(r'<span class="tied">.*?</span>', text)
    assert len(tied) > 10
    assert not [each for each in tied if each.count("<span") > 1]


def test_signs_and_degrees_are_set_as_in_print() -> None:
    angle = xr.DataArray(-3.384, attrs={"units": "degree", "symbol": r"\varphi"}, name="critical_angle")
    assert re.sub("<.*?>", "", place_html(angle)) == "φ = −3.384°"


def test_one_point_with_units_is_said_as_at_the_end_of_its_run() -> None:
    dataset = swtstudy.open_results(RESULTS / "life.nc").isel(tangential_amplitude=0, critical_distance=0)
    (said,) = sentences(dataset)
    lives = r"N = [^ ]+ load cycles \(worst point\), [^ ]+ \(mean over 10 µm\)\."
    assert re.fullmatch(rf"SWT = [\d.]+ MPa at x = −[\d.]+ µm; {lives}", said)


def test_the_headline_is_about_the_quantity_of_the_figure(small: xr.Dataset) -> None:
    layout = replace(FigureLayout.from_json(small.attrs["figure"]), y=("critical_x", "work"))
    found = small.assign(work=(2.0 + small.phase + 0.0 * small.s).assign_attrs(symbol="W"))
    first = told(found.assign_attrs(figure=layout.to_json()))[0]
    assert first.endswith("ψ changes W by a factor of 2 at δA/δ0 = 0.25: best at 0, worst at 0.637π.")


RECORD = f"""title = "A record"
rtol = 1e-2
{ALLOY}yield_strength = 100
[loads.rig]
vertices = [[-10, -60], [10, 60]]
mean_normal = 250
[fixed]
load = "rig"
{SPHERE}"""


@pytest.mark.usefixtures("unwrapped")
def test_the_page_of_a_record_has_its_loads_and_all_columns(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = swtstudy.run(Study.from_text(RECORD), tmp_path / "rig.nc")
    drawn = []
    keep = lambda figure, *_, **__: drawn.append(figure) or Picture("data:,", 1, 1)  # noqa: E731
    monkeypatch.setattr("swtstudy.faces.page.embedded", keep)
    text = page(found, "rig")
    (table,) = (row for _, row in table_in(text).iterrows())
    for name in ("SWT", "cycles", "critical_position", "friction", "yield_ratio"):
        assert table[name] == pytest.approx(float(found[name]), rel=1e-6)
    assert "normal_force_amplitude" not in table  # a factor of 1
    words = checked(text).text
    assert "F_N 240 to 260 N, F_x −60 to 60 N" in words
    assert "amplitude of the normal force" not in words
    assert "rig: a measured loop of 2 vertices" in words
    assert "or the name of a loop" not in words
    assert re.search(r"Outside of the model: .*first yield \(", words)
    (figure,) = drawn
    labels = {axes.get_xlabel(): axes.get_ylabel() for axes in figure.axes}
    assert labels["$u$ (mm)"] == "$F_x$ (N)"
    assert labels["$x$ (mm)"]


def test_validity_is_shown_where_results_have_it(
    small: xr.Dataset, small_page: str, without_points: None
) -> None:
    assert "Where the model holds" not in small_page
    bare = small.drop_attrs(deep=False).assign_attrs({k: v for k, v in small.attrs.items() if k != "figure"})
    bare.attrs.pop("study")
    text = page(bare.assign(yield_ratio=0.0 * small.s + 1.5, radius_ratio=0.0 * small.s + 0.05), "small")
    assert re.search(r"</table></div>\s*<h3>To cite</h3>", text)  # and nothing to make it again
    assert (
        "beyond first yield at all 6 points: largest von Mises stress over the yield strength up to 1.5"
        in text
    )
    assert "<li>contact radius over R up to 0.05, limit 0.1</li>" in text


@pytest.mark.slow
def test_several_archives_get_a_page_that_lists_them(tmp_path: Path) -> None:
    for name in ("loops", "friction"):
        shutil.copy2(RESULTS / f"{name}.nc", tmp_path)
    (tmp_path / "none.nc").write_text("no archive")
    outcome = call("report", *sorted(tmp_path.glob("*.nc")), "-o", tmp_path / "site")
    assert outcome.exit_code == 0, outcome.output
    assert "none.nc" in outcome.stderr
    files = {path.name: path for path in (tmp_path / "site").iterdir()}
    assert {*files} == {"index.html", "loops.html", "friction.html"}
    index = checked(files["index.html"].read_text("utf-8"))
    assert {"loops.html", "friction.html"} <= {*index.links}
    assert sum(link.startswith("data:image/webp") for link in index.links) == 2
    assert 'href="index.html"' in files["loops.html"].read_text("utf-8")


@pytest.mark.slow
def test_pages_made_side_by_side_are_in_order(tmp_path: Path, small: xr.Dataset) -> None:
    archives = [tmp_path / f"{name}.nc" for name in "abcd"]
    for path in archives:
        path.write_text("no archive")
    study(tmp_path, axes="phase = [0, 1]")
    (tmp_path / "small.nc").replace(archives[2])
    done = call("report", *archives, "-o", tmp_path / "site", "--workers", 2)
    page_of_c, index = tmp_path / "site" / "c.html", tmp_path / "site" / "index.html"
    assert done.stdout.splitlines() == [str(page_of_c), str(index)]
    refused = [line.split(": ")[0] for line in done.stderr.splitlines()]
    assert refused == [str(archives[k]) for k in (0, 1, 3)]
    assert "<h1>1 parameter study</h1>" in index.read_text("utf-8")


def test_a_drawing_has_the_digits_that_are_seen(small: xr.Dataset) -> None:
    figure = small.swt.figure()
    whole = picture(figure, "svg").decode()
    (short,) = re.findall("base64,(.*)", embedded(figure).source)
    drawn = base64.b64decode(short).decode()
    assert len(drawn) < 0.9 * len(whole)
    assert "<!--" not in drawn
    lines = [re.findall(r' d="(M [^"]* L [^"]*)" clip', " ".join(text.split())) for text in (whole, drawn)]
    before, after = ([float(n) for d in each for n in re.findall(r"[-\d.]+", d)] for each in lines)
    assert after == pytest.approx(before, abs=0.5)  # laid out anew, at another size of pixels
    assert max(len(n.partition(".")[2]) for d in lines[1] for n in re.findall(r"[-\d.]+", d)) <= 2


CHROMIUM = next(
    filter(
        None,
        map(shutil.which, (os.environ.get("CHROMIUM", ""), "chromium", "chromium-browser", "google-chrome")),
    ),
    None,
)


def in_chromium(text: str, folder: Path) -> str:
    """The page as its scripts leave it."""
    (folder / "page.html").write_text(text, encoding="utf-8")
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000", "--dump-dom"]
    command = [
        str(CHROMIUM),
        *options,
        f"--user-data-dir={folder / 'profile'}",
        (folder / "page.html").as_uri(),
    ]
    return subprocess.run(command, capture_output=True, encoding="utf-8", timeout=120, check=True).stdout


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
def test_scripts_draw_slices_and_give_the_table(tmp_path: Path, small_page: str) -> None:
    shown = in_chromium(small_page, tmp_path)
    assert len(re.findall(r'<path class="c\d d0" d="M\d', shown)) == 4  # two lines, and their legend
    assert len(re.findall("<select>", shown)) == 3
    assert re.search(r'id="table" download="small\.csv" href="blob:', shown)
    assert "data-script hidden" not in shown.replace('data-script=""', "data-script")


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium is installed")
def test_scripts_draw_every_point_of_a_sample(tmp_path: Path, without_points: None) -> None:
    dataset = swtstudy.open_results(RESULTS / "sensitivity.nc")
    shown = in_chromium(page(dataset, "sensitivity"), tmp_path)
    places = [float(each) for each in re.findall(r'<circle class="c\d" cx="([^"]+)"', shown)]
    assert len(places) == dataset.s.size
    assert np.ptp(places) > 200.0


def test_a_life_is_told_of_the_body_that_has_a_crack_first(tmp_path):
    """The stronger one has the larger factor."""
    alloys = ALLOY.replace("strength = 927", "strength = [927, 1000]").replace("-0.113", "[-0.113, -0.1]")
    text = f"""title = "Two bodies"
rtol = 1e-2
{alloys}
[fixed]
{SPHERE}normal_force = 200
[axes]
tangential_force_amplitude = [85, 97]
[figure]
x = "tangential_force_amplitude"
y = "cycles"
hue = "body"
"""
    dataset = swtstudy.run(Study.from_text(text), tmp_path / "two.nc")
    least, most = (getattr(dataset.cycles, end)("tangential_force_amplitude") for end in ("min", "max"))
    assert least.idxmin("body") == 1
    ratio = most / least
    assert 1e2 < least.min() < most.max() < 1e7
    assert ratio[1] > ratio[0]
    line = next(line for line in sentences(dataset) if "tangential" in line)
    assert f"{float(ratio[0]):.3g}" in line
