"""Every picture of the pages has words for whoever does not see it."""

import re

import pytest
import shown

PAGES = [shown.ROOT / "README.md", *sorted((shown.ROOT / "docs").rglob("*.md"))]
PAGES = [page for page in PAGES if "generated" not in page.parts]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_picture_has_an_alt_text(page):
    text = page.read_text(encoding="utf-8")
    words = [alt for alt, _ in re.findall(r"!\[([^\]]*)\]\(([^)]*)\)", text)]
    directives = re.findall(r"^```+\{(?:figure|image)\}.*?^```+$", text, re.MULTILINE | re.DOTALL)
    for each in directives:
        words += re.findall(r"^:alt: *(.*)$", each, re.MULTILINE) or [""]
    assert all(len(alt.split()) > 1 for alt in words), words
