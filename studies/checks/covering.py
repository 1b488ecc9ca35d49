"""Which tests run which lines of the package, and how long they take, by a plugin of pytest."""

from __future__ import annotations

import ast
import json
import os
from collections import Counter, defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import Any

#: Name of the plugin's file, in the environment of the tests.
TARGET = "COVERING"

#: Marks what fixtures run before a test.
_SETUP = "|setup"


class Covering:
    """Notes the lines of each test."""

    def __init__(self, target: Path) -> None:
        from coverage import Coverage

        self.target, self.root = target, Path.cwd()
        self.seconds: Counter[str] = Counter()
        self.failed: set[str] = set()
        self.coverage = Coverage(data_file=None, source=["swtstudy"], messages=False)
        self.coverage.start()

    def pytest_runtest_setup(self, item: Any) -> None:
        self.coverage.switch_context(item.nodeid + _SETUP)

    def pytest_runtest_call(self, item: Any) -> None:
        self.coverage.switch_context(item.nodeid)

    def pytest_runtest_logreport(self, report: Any) -> None:
        self.seconds[report.nodeid] += report.duration
        if report.failed:
            self.failed.add(report.nodeid)

    def pytest_sessionfinish(self) -> None:
        self.coverage.stop()
        data = self.coverage.get_data()
        lines = {
            os.path.relpath(file, self.root): data.contexts_by_lineno(file) for file in data.measured_files()
        }
        seconds = {test: time for test, time in self.seconds.items() if test not in self.failed}
        self.target.write_text(json.dumps({"seconds": seconds, "lines": lines}), encoding="utf-8")


if TARGET in os.environ:
    plugin = Covering(Path(os.environ[TARGET]))

    pytest_runtest_setup = plugin.pytest_runtest_setup
    pytest_runtest_call = plugin.pytest_runtest_call
    pytest_runtest_logreport = plugin.pytest_runtest_logreport
    pytest_sessionfinish = plugin.pytest_sessionfinish


class Covered:
    """Read the output of the plugin, in one file or in several."""

    def __init__(self, files: Iterable[Path], project: Path) -> None:
        self.project = project
        self.seconds: dict[str, float] = {}
        self.lines: dict[str, dict[int, set[str]]] = defaultdict(lambda: defaultdict(set))
        for file in files:
            found = json.loads(file.read_text(encoding="utf-8"))
            self.seconds |= found["seconds"]
            for source, lines in found["lines"].items():
                for line, tests in lines.items():
                    self.lines[source][int(line)] |= set(tests) - {""}

    def tests(self, file: str, line: int, limit: float) -> tuple[list[str], float]:
        """The tests of a line, quickest first, as many as the time allows, and how long they take.

        A line that no test runs by itself has the tests of its file, or of its folder. A line of compiled
        code, of which nobody knows when it runs, has the tests of its folder.
        """
        span, inside, compiled = _statement((self.project / file).read_text(encoding="utf-8"), line)
        lines = self.lines[file]
        found = _together(lines.get(line, set()) for line in span) if inside else set()
        found = found or _together(lines.values())
        if compiled or not found:
            beside = [source for source in self.lines if Path(source).parent == Path(file).parent]
            found = _together(tests for source in beside for tests in self.lines[source].values())
        # Lines that a fixture runs may be for all tests of the file.
        fixtures = {test.split("::")[0] for test in found if test.endswith(_SETUP)}
        chosen, spent = [], 0.0
        for test in sorted(self.seconds, key=self.seconds.__getitem__):
            if test in found or test.split("::")[0] in fixtures:
                if spent + self.seconds[test] > limit:
                    break
                spent += self.seconds[test]
                chosen.append(test)
        return chosen, spent


def _together(sets: Iterable[set[str]]) -> set[str]:
    return set().union(*sets)


def _statement(text: str, line: int) -> tuple[range, bool, bool]:
    """Lines of the statement (of its head, if it has a body) at a line, and whether it runs in a function.

    What a cached function does, or a module as it is loaded, only the first test runs. The third value says
    whether the function is compiled.
    """
    span, inside, compiled = range(line, line + 1), False, False
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.stmt) and node.lineno <= line <= (node.end_lineno or node.lineno):
            body = getattr(node, "body", None)
            if not body or line < body[0].lineno:
                span = range(node.lineno, body[0].lineno if body else (node.end_lineno or line) + 1)
            elif isinstance(node, ast.FunctionDef):
                decorators = [ast.unparse(each) for each in node.decorator_list]
                inside = not any("cache" in each for each in decorators)
                compiled = any(each.startswith("jit") for each in decorators)
    return span, inside, compiled
