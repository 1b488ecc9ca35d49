"""All that is said of studies with mistakes, word by word.

The file of the texts has studies but for their titles, each with all that is said of it. Every message begins
with », and may go on in lines that are set in.
"""

import re
from pathlib import Path

import pytest
from folders import DATA
from kept import Kept
from real import CONSTANTS, UNITS
from told import refused, set_in

from swtstudy import Study

_BODIES = "[fixed]\nyoung_modulus = 73.1e3\npoisson_ratio = 0.33"
_ALLOY = f"[material]\n{CONSTANTS.strip()}"
_FORCES = "normal_force = 200\ntangential_force_amplitude = 60"
#: What stands for some lines in the file.
SHORT = {
    "{figure}": '[axes]\nphase = [0, 1]\nfriction = [0.1, 0.3]\n[figure]\nx = "phase"',
    "{drawn}": '[sample]\ndesign = "random"\nsize = 2',
    "{rig}": "{mm}\n{contact}\n{forces}",
    "{rig of alloy}": "{mm}\n{alloy}\n{contact}\n{forces}",
    "{mm}": UNITS.strip(),
    "{alloy}": _ALLOY,
    "{contact}": f"{_BODIES}\nradius = 50\nfriction = 0.5",
    "{bodies}": _BODIES,
    "{forces}": _FORCES,
    "{folder}": str(Path.cwd()),
}
TEXTS = DATA / "told_of_studies.txt"
TOLD = TEXTS.read_text(encoding="utf-8").strip().split("\n\n")


@pytest.mark.parametrize("case", TOLD, ids=range(len(TOLD)))
def test_whole_messages(kept: Kept, case: str) -> None:
    text, *lines = re.sub(r"\n  ", " ", case).split("\n» ")
    head = case.partition("\n» ")[0]
    for words, meant in SHORT.items():
        text = text.replace(words, meant)
    title = "" if text.startswith("title") else 'title = "t"\n'
    told = refused("", Study.from_text, f"{title}{text}\n", "s").mistakes
    found = [str(each).removeprefix("s: ").replace(str(Path.cwd()), "{folder}") for each in told]
    if found != lines:
        kept.text(TEXTS, case, f"{head}\n{set_in([f'» {each}' for each in found])}")
