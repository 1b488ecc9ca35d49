"""The role {checked-by}`test_x.py::test_y`: names a test, and breaks the build if there is no such test."""

import ast
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole

_TESTS = Path(__file__).parent.parent.parent / "tests"


class CheckedBy(SphinxRole):
    """A test in the project's folder of tests."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """The name as code; an error if it is not there."""
        file, _, name = self.text.partition("::")
        if name not in _functions(_TESTS / file):
            return [], [self.inliner.reporter.error(f"there is no test {self.text}", line=self.lineno)]
        return [nodes.literal(self.text, self.text)], []


def _functions(path: Path) -> set[str]:
    if not path.is_file():
        return set()
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the role."""
    app.add_role("checked-by", CheckedBy())
    return {"parallel_read_safe": True}
