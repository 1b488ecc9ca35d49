"""All that is said of studies with tables in files, word by word: warnings, which begin with !, and mistakes.

In the file of the texts ==== parts the cases, and --- the keys of a table, the file that it names, and what
is said of it. What is said begins with ! or », and may go on in lines that are set in.
"""

import re
from pathlib import Path

import pytest
import real
from folders import DATA
from kept import Kept
from told import set_in, warned

from swtstudy import Study, StudyError

_FORCES = "normal_force = 100\ntangential_force_amplitude = 10\n"
_RIG = f"{real.RIG}normal_force = 200\n"
_BODIES = f'title = "t"\n{real.UNITS}[fixed]\nyoung_modulus = 73e3\npoisson_ratio = 0.33\nfriction = 0.5\n'
_STRIP = f'{_BODIES}radius = 50\nprofile = "cylinder"\nload = "rig"\n'
#: Studies that name the file.
HEADS = {
    "{rig}": f"{real.RIG}[loads.rig]\n",
    "{strip}": f"{_STRIP}[loads.rig]\n",
    "{long strip}": f"{_STRIP}contact_length = 8\n[loads.rig]\n",
    "{rig with forces}": f"{_RIG}normal_force_amplitude = 1\ntangential_force_amplitude = 1\n[loads.rig]\n",
    "{rig with a displacement}": f"{_RIG}normal_force_amplitude = 1\ntangential_amplitude = 1\n[loads.rig]\n",
    "{rig with a depth}": f"{_RIG}normal_amplitude = 1\ntangential_force_amplitude = 1\n[loads.rig]\n",
    "{points}": 'title = "t"\n[sample]\n',
    "{points with units}": f"{_BODIES}radius = 50\nnormal_force_amplitude = 0\n[sample]\n",
    "{profile}": f'{_BODIES}{_FORCES}profile = "pad"\n[profiles.pad]\n',
}
TEXTS = DATA / "told_of_files.txt"
CASES = TEXTS.read_text(encoding="utf-8").rstrip("\n").split("\n====\n")


def mistakes_of(text: str, folder: Path) -> list[str]:
    try:
        Study.from_text(text, "s", folder)
    except StudyError as error:
        return [str(each).removeprefix("s: ") for each in error.mistakes]
    return []


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_whole_words_on_files(kept: Kept, case: str, tmp_path: Path) -> None:
    keys, content, said = re.split(r"^---\n?", case, flags=re.MULTILINE)
    head, _, keys = keys.partition("\n")
    (tmp_path / "f.csv").write_text(content.removesuffix("\n"), encoding="utf-8")
    mistakes, told = warned(mistakes_of, f'{HEADS[head]}file = "f.csv"\n{keys}', tmp_path)
    found = [*(f"! {each}" for each in told), *(f"» {each}" for each in mistakes)]
    found = [each.replace(str(tmp_path), "{folder}") for each in found]
    if found != re.sub(r"\n  ", " ", said).strip().split("\n"):
        kept.text(TEXTS, case, case.removesuffix(said) + set_in(found))
