"""Effect of each tuning constant of the solver: s and time with it halved, doubled or taken away.

``python studies/checks/constants.py [part of a name ...] [--points a profile]`` writes results/constants.md:
all that the code says of constants, their tests among it, and effects of other values of named constants, if
there are names.
A constant's module is compiled with another value of it, in a process of its own, so that all that is made
from it follows.
"""

from __future__ import annotations

import argparse
import ast
import itertools
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from altered import ROOT, assigned, in_a_process

ROOMS = [ROOT / "swtstudy" / room for room in ("profiles", "kernel", "solver")]
RTOL, REFERENCE_RTOL = 1e-5, 1e-8
#: Samples that show what modules other than the search of the line do, by a part of their name.
KINDS = {"families": "wavy", "profiles.table": "table", "loops": "loop", ".control": "force"}
KINDS |= {"mean": "means", ".body": "body", ".beneath": "body", ".all_planes": "body"}
#: Numbers that mean something rather than tune something.
DEFINITIONS = ("GROWTH", "LAST", "T", "PERIOD", "NO_AMPLITUDE")
#: Other values than half and twice, or a hundredth and a hundred times: v is the constant.
OTHERS = {"mean.OF_OFF": ("v / 2", "2 * v")}
HEADER = "| constant | value | error | missed | change | time |\n|---|---|---|---|---|---|\n"


def constants() -> Iterator[tuple[str, str, str, tuple[str, ...]]]:
    """Module, name, value as it is written, and the other values of each constant."""
    for file in sorted(file for room in ROOMS for file in room.glob("*.py")):
        tree = ast.parse(file.read_text(encoding="utf-8"))
        module = ".".join(file.relative_to(ROOT).with_suffix("").parts)
        names = [n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
        for name in dict.fromkeys(n for n in names if n == n.upper() and n not in DEFINITIONS):
            for _, _, value in assigned(tree, name):
                text, others = ast.unparse(value), OTHERS.get(f"{file.stem}.{name}")
                try:
                    number = ast.literal_eval(value)
                except ValueError:
                    number = None
                if others is None and isinstance(number, int):
                    others = ("max(v // 2, 1)" if number > 1 else "0", "2 * v")
                elif others is None and isinstance(number, float):
                    others = ("v / 100", "100 * v") if number < 1e-5 else ("v / 2", "2 * v")
                yield module, name, text, others or ()


def comments() -> Iterator[str]:
    """A row for each statement that gives constants a value: their module and names, values, and comment."""
    for file in sorted(file for room in ROOMS for file in room.glob("*.py")):
        module = ".".join(file.relative_to(ROOT / "swtstudy").with_suffix("").parts)
        said, goes_on = "", False
        for line in file.read_text(encoding="utf-8").splitlines():
            found = re.match(r"([A-Z][A-Z_0-9, ]*)(?:: [^=]+)? = (.*)", line)
            if line.startswith("#: "):
                said = f"{said} {line[3:]}" if goes_on else line[3:]
            elif not found:
                said = ""
            # One comment may stand for several statements.
            elif said and not set(found[1].split(", ")) & {*DEFINITIONS}:
                yield f"| {module}.{found[1]} | {found[2].replace('|', '/')} | {said} |"
            goes_on = line.startswith("#: ")


class Sample:
    """A sample of points that tests altered constants."""

    def __init__(self, kind: str, count: int) -> None:
        self.kind, self.count = kind, count
        nothing = "swtstudy.solver.points", "", "v"
        self.unaltered, (self.reference, _, _) = in_a_process(*nothing, kind, count, (RTOL, REFERENCE_RTOL))

    def row(self, module: str, constant: str, expression: str) -> str:
        """Cells: largest error, points that miss s_error, largest change, all relative, and the time.

        Or what stops the solver with that constant.
        """
        try:
            [(s, claimed, now)] = in_a_process(module, constant, expression, self.kind, self.count, (RTOL,))
        except Exception as error:
            return f"{type(error).__name__} | | | "
        regular = np.isfinite(self.reference) & (self.reference > 0.0)
        reference, before = self.reference[regular], self.unaltered[0][regular]
        error, change = np.abs(s[regular] - reference), np.abs(s[regular] - before)
        missed = np.count_nonzero(error > claimed[regular])
        cells = f"{(error / reference).max():.1e}", f"{missed}", f"{(change / reference).max():.1e}"
        return " | ".join([*cells, f"{now / self.unaltered[2]:.2f}"])


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("names", nargs="*", help="parts of the constants' names")
    arguments.add_argument("--points", type=int, default=32, help="points of each source")
    arguments.add_argument("--results", type=Path, default=Path("results"), help="folder for the table")
    arguments.add_argument("--quick", action="store_true", help="one constant at one point a profile")
    given = arguments.parse_args()
    count, names = (1, ["solver.von_mises.CLIMBS"]) if given.quick else (given.points, given.names)
    samples: dict[str, Sample] = {}
    lines = []
    for part, (module, constant, text, others) in itertools.product(names, constants()):
        name = f"{module.removeprefix('swtstudy.')}.{constant}"
        if part not in name:
            continue
        kind = next((kind for part, kind in KINDS.items() if part in module), "line")
        if kind not in samples:
            samples[kind] = Sample(kind, count)
            lines.append(f"| as it is ({kind}) | | {samples[kind].row(module, constant, 'v')} |")
            print(lines[-1], flush=True)
        for expression in others:
            cells = samples[kind].row(module, constant, expression)
            lines.append(f"| {name} = {text} | {expression} | {cells} |")
            print(lines[-1], flush=True)
    listed = "What the code says of each constant, its test or its measurement where it has one:\n\n"
    listed += "| constant | value | what it is |\n|---|---|---|\n" + "\n".join(comments())
    title = f"Relative errors and changes of s at rtol = {RTOL:.0e}, {count} points of each source; "
    title += "times are over that of the constants as they are, and vary as much as its own rows.\n\n"
    given.results.mkdir(exist_ok=True)
    measured = f"\n\n{title}{HEADER}" + "\n".join(lines) if lines else ""
    (given.results / "constants.md").write_text(f"{listed}{measured}\n", "utf-8")


if __name__ == "__main__":
    main()
