"""Names in docstrings as links: the package's by their short names, those of other packages to their pages.

With ``nitpicky``, a name that leads nowhere breaks the build.
"""

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment

#: The pages of other packages, {} for the name.
_ELSEWHERE = {
    "collections": "https://docs.python.org/3/library/collections.abc.html#{}",
    "fractions": "https://docs.python.org/3/library/fractions.html#{}",
    "xarray": "https://docs.xarray.dev/en/stable/generated/{}.html",
    "numpy": "https://numpy.org/doc/stable/reference/generated/{}.html",
    "scipy": "https://docs.scipy.org/doc/scipy/reference/generated/{}.html",
    "pandas": "https://pandas.pydata.org/docs/reference/api/{}.html",
    "matplotlib": "https://matplotlib.org/stable/api/figure_api.html#{}",
}
#: Sections of pages that show what a table in the package holds.
_TABLES = {
    "swtstudy.vocabulary.parameters.PARAMETERS": ("api/solve", "parameters"),
    "swtstudy.vocabulary.quantities.NAMED": ("study_file", "what-is-computed-beside-s"),
    "swtstudy.vocabulary.quantities.QUANTITIES": ("study_file", "what-is-computed-beside-s"),
}


def _resolve(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, shown: nodes.Element
) -> nodes.Element | None:
    name = node.get("reftarget", "")
    if name in _TABLES:
        page, section = _TABLES[name]
        there = app.builder.get_relative_uri(node["refdoc"], page)
        return nodes.reference("", "", shown, internal=True, refuri=f"{there}#{section}")
    if (package := name.partition(".")[0]) in _ELSEWHERE:
        return nodes.reference("", "", shown, internal=False, refuri=_ELSEWHERE[package].format(name))
    python = env.get_domain("py")
    matches = [each for each in python.get_objects() if each[0] == f"swtstudy.{name}"]
    if not matches and name[:1].isupper():
        matches = [each for each in python.get_objects() if each[0].endswith(f".{name}")]
    if len(matches) != 1:
        return None
    full, _, _, page, anchor, _ = matches[0]
    there = app.builder.get_relative_uri(node["refdoc"], page)
    return nodes.reference("", "", shown, internal=True, refuri=f"{there}#{anchor}", reftitle=full)


def _split_names(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Attributes that share a description, "a, b", become one entry each: napoleon takes a for a type."""
    start = next(
        (i + 2 for i, line in enumerate(lines[:-1]) if [line, set(lines[i + 1])] == ["Attributes", {"-"}]),
        None,
    )
    if start is None:
        return
    split: list[str] = []
    for index, line in enumerate(lines[start:], start):
        names = line.split(", ")
        if len(names) > 1 and all(each.isidentifier() for each in names):
            end = next(
                (i for i, text in enumerate(lines[index + 1 :], index + 1) if not text[:1].isspace()),
                len(lines),
            )
            for each in names[:-1]:
                split += [each, *lines[index + 1 : end]]
            split.append(names[-1])
        else:
            split.append(line)
    lines[start:] = split


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect both, the latter before napoleon."""
    app.setup_extension("sphinx.ext.autodoc")
    app.connect("missing-reference", _resolve)
    app.connect("autodoc-process-docstring", _split_names, priority=400)
    return {"parallel_read_safe": True}
