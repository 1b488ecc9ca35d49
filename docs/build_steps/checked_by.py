"""The role {checked-by}`test_x.py::test_y`: names a test of any room; the build breaks if there is none."""

import ast
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxRole

_TESTS = Path(__file__).parents[2] / "tests"


class CheckedBy(SphinxRole):
    """A test in a folder of the project's tests."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """The name as code; an error if it is not there."""
        file, _, name = self.text.partition("::")
        if not any(name in _functions(path) for path in _TESTS.rglob(file)):
            return [], [self.inliner.reporter.error(f"there is no test {self.text}", line=self.lineno)]
        return [nodes.literal(self.text, self.text)], []


def _functions(path: Path) -> set[str]:
    tree = ast.parse(path.read_text(encoding="utf-8"))
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the role."""
    app.add_role("checked-by", CheckedBy())
    return {"parallel_read_safe": True}
