"""The pages and parts of pages that are made from the package and the studies.

Parts that are to be read as text in a clone stand in their pages, between two comments with their name.
"""

import re
import shutil
from pathlib import Path

from build_steps.citation import citation
from build_steps.commands import commands
from build_steps.figure_kinds import figure_kinds
from build_steps.gallery import gallery, results_of
from build_steps.house import draw_house
from build_steps.parameters import parameters
from build_steps.profiles import draw_profiles
from build_steps.rooms import WHOLE, rooms
from build_steps.study_file import study_file
from build_steps.three_mistakes import three_mistakes
from swtstudy.faces.site import write_reports

ROOT = Path(__file__).parent.parent.parent
#: The study whose report is always made.
EXAMPLE = "figure3"
#: Pages whose parts stand in them, and these parts.
READABLE = ROOT / "docs" / "commands.md", ROOT / "docs" / "study_reference.md"
PARTS = {"commands": commands, "study_file": study_file, "three_mistakes": three_mistakes}


def generate(folder: Path, reports: bool = False) -> None:
    """Write everything into ``folder``, with the reports of all studies or of one of them alone."""
    folder.mkdir(exist_ok=True)
    archives = results_of(ROOT)
    reported = [*archives] if reports else [EXAMPLE]
    texts = {
        "citation": citation(ROOT / "CITATION.cff"),
        "figure_kinds": figure_kinds(),
        "gallery": gallery(ROOT, reported),
        "parameters": parameters(),
        "rooms_whole": rooms(WHOLE),
    }
    for name, text in texts.items():
        write_if_new(folder / f"{name}.md", text)
    for page in READABLE:
        write_if_new(page, filled(page))
    draw_house(WHOLE, folder / "house.svg")
    draw_profiles(folder)
    shutil.rmtree(folder / "pages", ignore_errors=True)
    for _, problem in write_reports([archives[name] for name in reported], folder / "pages" / "reports"):
        if problem:
            raise ValueError(problem)
    shutil.copy2(ROOT / "studies" / "explore.ipynb", folder / "explore.ipynb")


def filled(page: Path) -> str:
    """A page with its parts as they are made now."""
    text = page.read_text(encoding="utf-8")
    for name, made in PARTS.items():
        ends = f"<!-- {name} -->\n", f"<!-- end of {name} -->"
        text = re.sub(
            f"(?s)({ends[0]}).*({ends[1]})",
            lambda found, made=made: f"{found[1]}\n{made()}\n{found[2]}",
            text,
        )
    return text


def write_if_new(path: Path, text: str) -> None:
    """Leave a file with the same text alone, so that Sphinx builds only what changed."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
