"""Every script of the studies in its own process, as the pages show it; with --quick if it has that."""

import ast
import os
import re
import shlex
import subprocess
import sys
import tomllib
from functools import cache
from importlib.util import find_spec

import pytest
import shown
from folders import RESULTS, ROOT, STUDIES

SCRIPTS = {str(script.relative_to(ROOT)): script for script in shown.scripts()}
#: Scripts that need what the tests can do without; their texts say so.
NEEDS = {"extra ``bench``": "tamaas", "extra ``mutation``": "mutmut", "distributed": "distributed"}
#: The seconds after which a script counts as stuck, on whatever machine.
STUCK = 3000


def text_of(script):
    return ((script / "__main__.py") if script.is_dir() else script).read_text(encoding="utf-8")


def arguments_of(name):
    """The arguments with which pages show a script, if they do."""
    commands = [shlex.split(each) for page in shown.PAGES for each in shown.commands_in_prose(page)]
    return max((words[2:] for words in commands if words[:2] == ["python", name]), default=[])


def run(name, results):
    text = text_of(SCRIPTS[name])
    command = [sys.executable, str(SCRIPTS[name]), *arguments_of(name)]
    command += ["--quick"] if "--quick" in text else []
    command += ["--results", str(results)] if "--results" in text else []
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        command, cwd=results, env=environment, capture_output=True, text=True, timeout=STUCK, check=False
    )


@pytest.mark.pages
@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script(name, tmp_path):
    text = text_of(SCRIPTS[name])
    for words, module in NEEDS.items():
        if words in text and find_spec(module) is None:
            pytest.skip(f"without {module}")
    done = run(name, tmp_path)
    assert done.returncode == 0, done.stderr
    # What it leaves or prints has its place in results; where nothing was left out, it is what is there.
    for file in re.findall(r"(?<=> results/)\w+\.txt", text):
        (tmp_path / file).write_text(done.stdout, encoding="utf-8")
    left = sorted(path.name for path in tmp_path.iterdir())
    assert left
    for file in left:
        assert (tmp_path / file).stat().st_size > 0
        kept = RESULTS / file
        assert kept.is_file()
        if "--quick" not in text:
            assert done.stdout == kept.read_text(encoding="utf-8")


def test_every_file_is_a_script_or_of_use_to_one():
    modules = [file for file in (STUDIES).rglob("*.py") if file not in SCRIPTS.values()]
    for module in modules:
        if module.name != "__main__.py":
            assert module.stem in imported_in(module.parent), f"{module} is not run"


def test_mutants_that_may_live_are_changes_of_the_package():
    """Of lines that are there: others would excuse nothing."""
    table = tomllib.loads((STUDIES / "checks" / "mutants_that_may_live.toml").read_text(encoding="utf-8"))
    for mutant in table["mutant"]:
        text = (ROOT / "swtstudy" / mutant["file"]).read_text(encoding="utf-8")
        assert mutant["was"] in " ".join(text.split()), mutant["file"]


@cache
def imported_in(folder):
    """Names of the modules that files of a folder import."""
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in folder.glob("*.py")]
    return {node.module for tree in trees for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
