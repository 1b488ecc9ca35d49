"""Modules of the solver with another value of a constant, so that all that is made from it follows."""

from __future__ import annotations

import ast
import multiprocessing
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from pathlib import Path

import scipy.sparse
import scipy.special  # noqa: F401 -- once for all processes

ROOT = Path(__file__).parents[2]


class Altered(SourceFileLoader):
    """Loads a module with another value of a constant, an expression in v."""

    module = constant = expression = ""

    def get_code(self, fullname: str):
        tree = ast.parse(self.get_data(self.path))
        wrapped = ast.parse(f"(lambda v: {self.expression})(0)").body[0].value
        for node, at, value in assigned(tree, self.constant):
            wrapped.args = [value]
            if at is None:
                node.value = wrapped
            else:
                node.value.elts[at] = wrapped
        return compile(ast.fix_missing_locations(tree), self.path, "exec")

    @classmethod
    def find_spec(cls, name: str, path, target=None) -> ModuleSpec | None:
        if not name.endswith(cls.module):
            return None
        spec = PathFinder.find_spec(name, path)
        spec.loader = cls(name, spec.origin)
        return spec


def assigned(tree: ast.Module, constant: str) -> Iterator[tuple[ast.Assign, int | None, ast.expr]]:
    """Find where a module gives a constant its value: the statement, the place in it, the value."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Tuple):
            for at, target in enumerate(node.targets[0].elts):
                if target.id == constant and isinstance(node.value, ast.Tuple):
                    yield node, at, node.value.elts[at]
        elif isinstance(node, ast.Assign) and node.targets[0].id == constant:
            yield node, None, node.value


def measure(
    module: str, constant: str, expression: str, kind: str, count: int, rtols: tuple[float, ...]
) -> list[tuple]:
    """s, s_error and the processor time in s of each rtol with an altered constant."""
    Altered.module, Altered.constant, Altered.expression = module, constant, expression
    if constant and ".kernel." in module:  # compiled code of the unaltered sources knows nothing of it
        os.environ["NUMBA_CACHE_DIR"] = tempfile.mkdtemp()
    sys.meta_path.insert(0, Altered)
    sys.path[:0] = [str(ROOT), str(ROOT / "studies")]
    from samples import solved

    found = []
    for rtol in rtols:
        begin = time.process_time()
        found.append((*solved(kind, count, rtol), time.process_time() - begin))
    return found


def in_a_process(*what: object) -> list[tuple]:
    """`measure` in a process of its own."""
    with multiprocessing.get_context("fork").Pool(1) as pool:
        return pool.apply(measure, what)
