"""The gallery of the pages leads to the reports that are made."""

import re
from types import SimpleNamespace

import pytest
from build_steps import gallery as pages
from folders import ROOT


def entry_of(dataset: object, name: str) -> SimpleNamespace:
    return SimpleNamespace(name=name, title=name, sentence="What *matters*.", picture=None)


def test_a_card_leads_to_the_report_or_to_the_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    found = {name: pages.results_of(ROOT)[name] for name in ("figure3", "plane_contacts")}
    found["waviness"] = found["figure3"]  # a study that is in no group
    monkeypatch.setattr(pages, "results_of", lambda root: found)
    monkeypatch.setattr(pages, "entry", entry_of)
    text = pages.gallery(ROOT, ["figure3"])
    assert re.findall('<li><a href="([^"]*)"', text) == [
        "reports/figure3.html",
        "#plane-contacts",
        "#waviness",
    ]
    assert "## Others\n\n(waviness)=" in text
    assert text.count('<a href="reports/figure3.html">Its report</a>') == 1
    assert "(plane_contacts)=\n" in text
    assert r"What \*matters\*." in text
