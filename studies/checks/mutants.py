"""Tests that bite: random small changes of the package, each against the tests that cover its line.

python studies/checks/mutants.py --size 300 --seed 2

The changes are the changes of mutmut, which would make every change there is, for days; here each room of the
package has its share of a sample. A copy of the project is changed at one place, and the tests that cover the
place run, quickest first, until one fails; what they cover is found out before. Slow tests and tests of pages
do not run. Reasons why some changes may live stand in mutants_that_may_live.toml.
Needs the extra ``mutation``. Writes results/mutants.md.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import tomllib
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from pathlib import Path
from typing import Any

from covering import TARGET, Covered
from mutations import Mutant, sample

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
#: The quick suite.
OPTIONS = ["-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", "-m", "not slow and not pages"]

#: To collect many files of tests takes longer than most tests: so few files are tried before all others.
FIRST_FILES = 3

#: The last tests have so many times the time of the first tests.
LAST = 10

#: How a mutant ends.
KINDS = ("killed", "timeout", "survived", "may live")


def copy_of_project(folder: str) -> None:
    """The copy of the project that each process changes."""
    global tree
    tree = Path(folder) / str(os.getpid())
    ignored = shutil.ignore_patterns(".git", ".venv", "__pycache__", ".*_cache", ".hypothesis")
    shutil.copytree(PROJECT, tree, ignore=ignored)


def run_tests(arguments: list[str], limit: float, target: Path | None = None) -> int | None:
    """Exit code of pytest in the copy, None if it took too long; what the tests cover goes to a target."""
    environment = {**os.environ, "PYTHONPATH": f"{tree}:{HERE}", "OMP_NUM_THREADS": "1"}
    options = [*OPTIONS, f"--basetemp={tree}/tmp"]
    if target:
        options += ["-p", "covering"]
        environment[TARGET] = str(target)
    silent: dict[str, Any] = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
    command = [sys.executable, "-m", "pytest", *options, *arguments]
    process = subprocess.Popen(command, cwd=tree, env=environment, start_new_session=True, **silent)
    try:
        return process.wait(limit)
    except subprocess.TimeoutExpired:
        return None
    finally:
        # With what a test may have left running.
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def cover(names: list[str], target: Path) -> None:
    """Note what some tests cover."""
    run_tests(names, 3600.0, target)


def outcome(mutant: Mutant, tests: list[str], seconds: float) -> str:
    """Outcome of the tests for a mutant."""
    file = tree / mutant.file
    original, old = file.read_text(encoding="utf-8"), file.stat()
    file.write_text(mutant.text, encoding="utf-8")
    # A time of its own: else Python would take the bytecode of the last mutant for this one's.
    os.utime(file, ns=(old.st_atime_ns, old.st_mtime_ns + 2_000_000_000 * random.randrange(1, 10**6)))
    first = list(dict.fromkeys(test.split("::")[0] for test in tests))[:FIRST_FILES]
    parts = [[test for test in tests if (test.split("::")[0] in first) == early] for early in (True, False)]
    code: int | None = 0
    for part in parts:
        if part and code == 0:
            code = run_tests(["-x", *part], 60.0 + 10.0 * seconds)
    file.write_text(original, encoding="utf-8")
    os.utime(file, ns=(old.st_atime_ns, old.st_mtime_ns))
    return {None: "timeout", 0: "survived"}.get(code, "killed")


def reasons() -> dict[tuple[str, str, str], str]:
    """Why some mutants may live, by file and change."""
    table = tomllib.loads((HERE / "mutants_that_may_live.toml").read_text(encoding="utf-8"))["mutant"]
    return {(f"swtstudy/{each['file']}", each["was"], each["now"]): each["why"] for each in table}


def report(results: dict[Mutant, str], arguments: argparse.Namespace) -> Iterator[str]:
    """The outcome as Markdown, line by line."""
    known = reasons()
    why = {mutant: known.get((mutant.file, mutant.was, mutant.now), "") for mutant in results}
    counts: dict[str, Counter[str]] = defaultdict(Counter)
    for mutant, kind in results.items():
        counts[mutant.room]["may live" if kind == "survived" and why[mutant] else kind] += 1
    total = sum(counts.values(), Counter())
    rest = len(results) - total["may live"]
    yield "# Changes of the package that the tests notice\n"
    options = f"--size {arguments.size} --seed {arguments.seed} --limit {arguments.limit:g}"
    noticed = (rest - total["survived"]) / rest
    yield f"`python studies/checks/mutants.py {options}`: {len(results)} changes at random"
    yield "places of every room, each against the tests that cover its line, quickest first. Of the"
    yield f"{rest} that a test could tell from the package the tests notice {noticed:.0%}.\n"
    yield "| room | " + " | ".join(KINDS) + " |\n|---|" + "---|" * len(KINDS)
    for room, count in [*sorted(counts.items()), ("all", total)]:
        yield f"| {room} | " + " | ".join(str(count[kind]) for kind in KINDS) + " |"
    for title, excused in (("Survived", False), ("May live", True)):
        yield f"\n## {title}\n"
        for mutant, kind in results.items():
            if kind == "survived" and bool(why[mutant]) == excused:
                words = f" ({why[mutant]})" if excused else ""
                yield f"* {mutant.file}:{mutant.line}{words}\n  `{mutant.was}` → `{mutant.now}`"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--size", type=int, default=300, help="mutants, about")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--limit", type=float, default=20.0, help="seconds of tests for a mutant, at first")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--covered", type=Path, help="folder that keeps what the tests cover")
    parser.add_argument("--results", type=Path, default=PROJECT / "results", help="where mutants.md goes")
    parser.add_argument("--quick", action="store_true", help="few mutants and few tests, to see that it runs")
    arguments = parser.parse_args()
    files = sorted((PROJECT / "tests").rglob("test_*.py"))
    package, groups = "swtstudy", [["swtstudy"], *([str(file.relative_to(PROJECT))] for file in files)]
    if arguments.quick:
        package, groups, arguments.size = "swtstudy/study/units", [["tests/study/test_real_mistakes.py"]], 1
    with tempfile.TemporaryDirectory() as folder:
        covered = arguments.covered or Path(folder) / "covered"
        covered.mkdir(exist_ok=True, parents=True)
        pool = ProcessPoolExecutor(arguments.workers, initializer=copy_of_project, initargs=(folder,))
        with pool:
            missing = [(names, covered / f"{Path(names[0]).stem}.json") for names in groups]
            missing = [(names, target) for names, target in missing if not target.exists()]
            list(pool.map(cover, *zip(*missing, strict=True)) if missing else [])
            known = Covered(covered.iterdir(), PROJECT)
            mutants = sample(PROJECT, package, arguments.size, random.Random(arguments.seed))
            results = dict.fromkeys(mutants, "survived")
            # Other tests may notice what the quickest tests do not.
            for limit in (arguments.limit, LAST * arguments.limit):
                left = [mutant for mutant, kind in results.items() if kind == "survived"]
                tests = [known.tests(mutant.file, mutant.line, limit) for mutant in left]
                kinds = pool.map(outcome, left, *zip(*tests, strict=True)) if left else iter(())
                for mutant, kind in zip(left, kinds, strict=True):
                    results[mutant] = kind
                    print(f"{kind} {mutant.file}:{mutant.line} {mutant.was} → {mutant.now}", flush=True)
    text = "\n".join(report(results, arguments)) + "\n"
    (arguments.results / "mutants.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
