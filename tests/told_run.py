"""`swtstudy run` as a process of its own, which tells what it does.

python told_run.py STUDY RESULTS FRICTION GATE

It prints "saved" whenever points are saved. From a friction on its workers wait at a gate, so that it never
ends by itself. Stopped, it prints "leaving", and waits for a line before it leaves its workers.
"""

from __future__ import annotations

import sys
from functools import partial
from typing import Any

import stand_in

from swtstudy.archive import parts
from swtstudy.archive.run import run_several
from swtstudy.archive.workers import LocalPool
from swtstudy.cli import main

save_part, leave = parts.save_part, LocalPool.__exit__


def told_save(*arguments: Any) -> None:
    save_part(*arguments)
    print("saved", flush=True)


def told_leave(pool: LocalPool, *arguments: object) -> None:
    print("leaving", flush=True)
    sys.stdin.readline()
    leave(pool, *arguments)


if __name__ == "__main__":
    study, results, friction, gate = sys.argv[1:]
    parts.save_part, LocalPool.__exit__ = told_save, told_leave
    run_several.__kwdefaults__["solver"] = partial(stand_in.up_to, float(friction), gate)
    main(["run", study, "--results", results, "--processes"])
