"""The built documentation: tables of the notebook, and a third column that fits beside the text."""

import importlib.resources
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from folders import ROOT, STUDIES
from kept import Kept


@pytest.mark.pages
def test_tables_that_the_notebook_prints_are_tables(tmp_path):
    pytest.importorskip("myst_nb")
    shutil.copy2(STUDIES / "explore.ipynb", tmp_path / "index.ipynb")
    settings = (ROOT / "docs" / "conf.py").read_text(encoding="utf-8")
    of_notebooks = re.findall(r"^(?:nb|myst)_\w+ = .*$", settings, re.MULTILINE)
    (tmp_path / "conf.py").write_text(
        "\n".join(['extensions = ["myst_nb"]', *of_notebooks]), encoding="utf-8"
    )
    build = [sys.executable, "-m", "sphinx", "-q", "-b", "html", tmp_path, tmp_path / "html"]
    subprocess.run(build, check=True, capture_output=True)
    page = (tmp_path / "html" / "index.html").read_text(encoding="utf-8")
    assert re.search(r"<td[^>]*>(?:<p>)?best(?:</p>)?</td>", page)
    assert "|---|" not in page


@pytest.mark.pages
def test_the_contents_of_a_page_fit_beside_its_text():
    """What the text leaves free is as wide as furo's column "On this page" and the padding of the text."""
    furo = pytest.importorskip("furo")
    sheet = next(Path(furo.__file__).parent.rglob("furo.css")).read_text(encoding="utf-8")
    column = float(re.search(r"\.toc-drawer\{[^}]*?width:([\d.]+)em", sheet)[1])
    padding = float(re.search(r"\.content\{[^}]*?padding:0 ([\d.]+)em", sheet)[1])
    own = (ROOT / "docs" / "static" / "style.css").read_text(encoding="utf-8")
    beside, left = re.search(
        r"max-width: (\S+)em\) { \.content { width: min\(53em, 100% - (\S+)em\)", own
    ).groups()
    assert float(left) == column + 2.0 * padding
    assert f"@media(max-width:{beside}em)" in sheet


def test_types_are_told_to_those_who_import_the_package():
    with (ROOT / "pyproject.toml").open("rb") as file:
        assert "Typing :: Typed" in tomllib.load(file)["project"]["classifiers"]
    assert (importlib.resources.files("swtstudy") / "py.typed").is_file()


def test_pages_to_be_read_in_a_clone_are_as_they_are_made_now(kept: Kept):
    made = pytest.importorskip("build_steps.generate")
    for page in made.READABLE:
        kept.text(page, page.read_text(encoding="utf-8"), made.filled(page))
