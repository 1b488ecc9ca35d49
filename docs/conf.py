"""Sphinx: pages in MyST Markdown; what the package says of itself is generated, never retyped."""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent)]

from build_steps.generate import generate  # noqa: E402

import swtstudy  # noqa: E402

project = "swtstudy"
author = "The swtstudy developers"
version = release = swtstudy.__version__

extensions = [
    "build_steps.checked_by",
    "build_steps.mathml",
    "build_steps.references",
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
]
exclude_patterns = ["build_steps", "generated/*.md"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
# The notebook is shown with the outputs that are committed; a test holds them against a run.
nb_execution_mode = "off"
nb_render_markdown_format = "myst"  # CommonMark has no tables
default_role = "py:obj"
nitpicky = True
# Types of attributes that have no page of their own.
nitpick_ignore = [
    ("py:class", name)
    for name in (
        *("swtstudy.points.grid.Grid", "swtstudy.study.figure.FigureLayout", "swtstudy.study.sample.Design"),
        *("swtstudy.vocabulary.definition.Definition", "swtstudy.vocabulary.quantities.Request"),
        "swtstudy.study.units.grid.PhysicalGrid",
    )
]
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings say shapes and units
napoleon_google_docstring = False
napoleon_use_ivar = True
html_math_renderer = "mathml"
html_theme = "furo"
html_static_path = ["static"]
html_extra_path = ["generated/pages"]  # pages that are none of Sphinx's, as they are
html_css_files = ["style.css"]
html_title = f"swtstudy {release}"
html_show_copyright = False

# Reports of all studies take minutes: they are made where asked for, as by ``sphinx-build -t reports``.
generate(HERE / "generated", reports=tags.has("reports"))  # noqa: F821


def name_functions(app, what, name, obj, options, signature, returns):
    """Write defaults that are functions by their names: not where these lie in memory."""
    return (re.sub(r"<function (\w+) at \w+>", r"\1", signature), returns) if signature else None


def setup(app):
    """Connect what is done to signatures."""
    app.connect("autodoc-process-signature", name_functions)
