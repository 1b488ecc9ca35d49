"""One flipped byte in the index of the chunks of an archive's arrays: does it open with another value?

python studies/checks/flips.py > results/flips.txt
"""

from __future__ import annotations

import argparse
import collections
import multiprocessing
import random
import re
import tempfile
from pathlib import Path

from cheap import cheap

from swtstudy import Study, open_results, run
from swtstudy.archive.paths import ArchiveError

STUDY = """
title = "Two profiles over phase and friction"
rtol = 1e-2
[fixed]
flat_radius = 0.5
[axes]
profile = ["paraboloid", "rounded_punch"]
phase = {start = 0, stop = 3, num = 30}
friction = {start = "0.1", stop = 1, num = 20}
"""

#: Bytes of a node of the index before its entries, and of an entry for an array of two axes.
HEAD, ENTRY = 24, 48


def places(content: bytes) -> list[int]:
    """The bytes of all nodes of the index in a file, up to the last entry that is used."""
    found = []
    for node in re.finditer(rb"TREE\x01", content):
        entries = int.from_bytes(content[node.start() + 6 : node.start() + 8], "little")
        found += range(node.start(), node.start() + HEAD + ENTRY * (entries + 1))
    return found


def what_opens(sound: Path, at: int, flip: int) -> str:
    """Open an archive with one byte changed, and name the outcome."""
    content = bytearray(sound.read_bytes())
    content[at] ^= flip
    changed = sound.with_stem("changed")
    changed.write_bytes(content)
    try:
        found = open_results(changed)
    except ArchiveError:
        return "refused"
    return "the right values" if found.identical(open_results(sound)) else "other values"


def main() -> None:
    arguments = argparse.ArgumentParser()
    arguments.add_argument("--quick", action="store_true", help="40 flips, to see that it runs")
    count = 40 if arguments.parse_args().quick else 2000
    draw = random.Random(29)
    outcomes: collections.Counter[str] = collections.Counter()
    # A process of its own: what HDF5 makes of a damaged file need not be an error.
    context = multiprocessing.get_context("fork")
    with tempfile.TemporaryDirectory() as folder, context.Pool(1, maxtasksperchild=100) as process:
        path = Path(folder) / "sound.nc"
        variables = run(Study.from_text(STUDY), path, solver=cheap, workers=1).variables
        index = places(path.read_bytes())
        for _ in range(count):
            task = process.apply_async(what_opens, (path, draw.choice(index), draw.randrange(1, 256)))
            try:
                outcomes[task.get(60)] += 1
            except multiprocessing.TimeoutError:
                outcomes["a crash"] += 1
    print(
        f"{count} flips of a byte at random among the {len(index)} of the index, {len(variables)} variables"
    )
    for outcome in ("refused", "the right values", "other values", "a crash"):
        print(f"{outcomes[outcome]:6d}  {outcome}")


if __name__ == "__main__":
    main()
