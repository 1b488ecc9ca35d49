"""One archive as a page."""

from __future__ import annotations

from html import escape
from typing import Any

import xarray as xr

from swtstudy.archive.describe import facts
from swtstudy.paper.statements.check import about_archive
from swtstudy.points.grid import SAMPLE
from swtstudy.points.validity import outside_words, validity_lines
from swtstudy.reports.findings import CRITERION, indices_of, sentences, worst_place
from swtstudy.reports.parts import Section, code, data, derived, figure, section, study_figure, table, whole
from swtstudy.reports.sections import (
    extrema_section,
    points_section,
    sensitivity_section,
    settings_section,
    sureness_section,
    tiles,
)
from swtstudy.reports.values import about, packed, rows_of, symbol_of, table_of
from swtstudy.study.figure import LINE_KINDS, FigureLayout
from swtstudy.study.shipped import shipped_studies
from swtstudy.vocabulary.variables import has_units

#: What the model is, for whoever is sent a page.
_MEANING = (
    "{symbol} is the largest Smith–Watson–Topper parameter (largest normal stress of a cycle times "
    "amplitude of the normal strain, over all planes and places) of a frictional contact of elastic "
    "bodies{over}. The larger, the sooner a crack begins."
)
#: What the figures of a sample are over.
_SAMPLED = {"scatter": "over each sampled parameter", "histogram": "at the points of the sample"}
_HINT = " <span data-script hidden>Point at it, or use the arrow keys, for values.</span>"
_SLICE = """<div class="controls"></div>
<p class="up"></p>
<div class="stage"></div>
<p class="across"></p>
<div class="legend"></div>"""


def page(dataset: xr.Dataset, name: str, home: str = "") -> str:
    """A page about the results in an archive, which needs no other file.

    Parameters
    ----------
    dataset
        Results, as from `swtstudy.open_results`.
    name
        Name of the archive without its ending.
    home
        Address of a page that lists this one among others; none without it.

    Returns
    -------
    str
        HTML. It shows everything without JavaScript but values under the pointer and slices.
    """
    title = str(dataset.attrs["title"])
    indices = indices_of(dataset)
    first, *others = [*sentences(dataset, indices), ""]
    outside = outside_words(dataset)
    shown, values = _figure_and_values(dataset, name)
    sections = [
        *shown,
        extrema_section(dataset),
        sensitivity_section(dataset, indices),
        points_section(dataset),
        settings_section(dataset),
        sureness_section(dataset, list(validity_lines(dataset, inside=True))),
        _paper(dataset, name),
        _origin(dataset, name),
    ]
    known = [each for each in sections if each.body]
    back = f'<a href="{escape(home)}">All reports</a> · ' if home else ""
    body = f"""<header class="top">
<p class="kicker">{back}{escape(name)}</p>
<h1>{escape(title)}</h1>
<p class="lead">{first}</p>
{f'<p class="outside">{escape(outside)}</p>' if outside else ""}
<p class="also">{" ".join(filter(None, others))}</p>
{tiles(dataset)}
<p class="note">{_meaning(dataset)}</p>
</header>
<nav aria-label="Contents"><div>{"".join(each.link for each in known)}</div></nav>
<main>
{chr(10).join(each.html for each in known)}
</main>
<footer>Made by {escape(str(dataset.attrs["source"]))} from {escape(name)}.nc.</footer>
{values}"""
    return whole(title, body, script=True)


def _meaning(dataset: xr.Dataset) -> str:
    """Say what s is; by criteria other than SWT the results say it."""
    if CRITERION not in dataset.coords:
        if has_units(dataset):
            return _MEANING.format(symbol="SWT", over="")
        return _MEANING.format(symbol="<i>s</i>", over=", over <i>E</i>*<i>δ</i><sub>0</sub>/<i>R</i>")
    return f"<i>s</i> by its criterion: {escape(str(dataset.s.attrs.get('comment', '')))}."


def _figure_and_values(dataset: xr.Dataset, name: str) -> tuple[list[Section], str]:
    """The study's figure, slices of the table, the table itself; and what their scripts must know."""
    sections: list[Section] = []
    rows = table_of(dataset)
    known: dict[str, Any] = about(dataset, rows) | {"panels": [], "derived": {}, "start": {"y": "s"}}
    if "figure" in dataset.attrs:
        shown, known["panels"], layout = study_figure(dataset)
        known["derived"] = derived(dataset, layout, rows_of(dataset))
        known["start"] = {"x": layout.x, "y": layout.y[0], "hue": layout.hue}
        known["start"]["fixed"] = worst_place(dataset)
        words = f"{', '.join(layout.y)} {_SAMPLED.get(layout.kind, f'over {layout.x}')}"
        caption = _caption(dataset, layout) + _HINT * bool(known["panels"])
        sections.append(section("figure", "Figure", figure(shown, words, caption, name="plot")))
    source = packed(rows)
    if not source:
        how = "<code>swtstudy.open_results(…).swt.to_table()</code>"
        note = f'<p class="note">{len(rows)} rows are too many for a page; in Python {how} has them.</p>'
        return [*sections, section("values", "Values", note)], data("about", known)
    sections.append(Section("slice", "Any slice", _SLICE, live=True))
    words = f'download="{escape(name)}.csv.gz" href="{source}">{escape(name)}.csv'
    link = f'<a class="button" id="table" {words}</a>'
    size = ", ".join(
        f"{n} {word}{'s' * (n != 1)}" for n, word in zip(rows.shape, ("row", "column"), strict=True)
    )
    note = f"{size}, to seven digits; all digits are in the archive."
    sections.append(section("values", "Values", f'<p>{link}</p><p class="note">{note}</p>'))
    return sections, data("about", known)


def _caption(dataset: xr.Dataset, layout: FigureLayout) -> str:
    """Caption of a figure: its quantities and parameters in symbols."""
    words = ", ".join(escape(y) if "/" in y else symbol_of(dataset[y]) for y in layout.y)
    mark = "a line" if layout.kind in LINE_KINDS else "a colour"
    along = {"x": "over", "vertical": "and", "hue": f"{mark} for each", "panels": "a panel for each"}
    parts = [
        _SAMPLED[layout.kind] if each == SAMPLE else f"{along[role]} {symbol_of(dataset[each])}"
        for role, each in layout.roles()
        if each in dataset
    ]
    own = f" {escape(layout.caption)}" if layout.caption else ""
    return f"{words} {', '.join(parts)}.".replace(", and", " and") + own


def _paper(dataset: xr.Dataset, name: str) -> Section:
    """List the statements of the paper on its own study, checked."""
    rows = []
    for outcome in about_archive(name, dataset):
        if outcome.finding is not None:
            mark = '<span class="yes">yes</span>' if outcome.finding.holds else '<span class="no">no</span>'
            said = outcome.statement
            rows.append((escape(said.place), escape(said.sentence), escape(outcome.finding.measured), mark))
    body = table(("place", "the paper says", "found", "holds"), rows, wide=True) if rows else ""
    return section("paper", "The paper", body)


def _origin(dataset: xr.Dataset, name: str) -> Section:
    """Where the values come from, and how to make them again."""
    attributes = dataset.attrs
    rows = [
        (escape(a), escape(b)) for a, b in facts(dataset) if a.split(" ")[0] in ("made", "history", "run")
    ]
    text = str(attributes.get("study", ""))
    own = name if _is_shipped(text, name) else f"{name}.toml"
    again = code(f"swtstudy run {own}\nswtstudy report results/{name}.nc")
    cited = f"{attributes.get('references', '')}; {attributes['source']}."
    return section(
        "origin",
        "Origin",
        table(("", ""), rows, wide=True),
        f"<h3>To make it again</h3>{again}" if text else "",
        f"<details><summary>The study, {escape(name)}.toml</summary>{code(text)}</details>" if text else "",
        f"<h3>To cite</h3><p>{escape(cited)}</p>",
    )


def _is_shipped(text: str, name: str) -> bool:
    """Return whether a study comes with the package, so that its name is enough."""
    path = shipped_studies().get(name)
    return path is not None and path.read_text("utf-8") == text
