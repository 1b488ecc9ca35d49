"""The pages and parts of pages that are made from the package and the studies."""

import shutil
from pathlib import Path

from build_steps.best_and_worst import draw_best_and_worst
from build_steps.citation import citation
from build_steps.commands import commands
from build_steps.gallery import gallery
from build_steps.house import draw_house
from build_steps.parameters import parameters
from build_steps.profiles import draw_profiles
from build_steps.rooms import MECHANICS, WHOLE, rooms
from build_steps.study_file import study_file
from build_steps.three_mistakes import three_mistakes
from swtstudy import open_results
from swtstudy.reports.page import page

ROOT = Path(__file__).parent.parent.parent


def generate(folder: Path) -> None:
    """Write everything into ``folder``."""
    folder.mkdir(exist_ok=True)
    texts = {
        "citation": citation(ROOT / "CITATION.cff"),
        "commands": commands(),
        "gallery": gallery(ROOT),
        "parameters": parameters(),
        "rooms_mechanics": rooms(MECHANICS),
        "rooms_whole": rooms(WHOLE),
        "study_file": study_file(),
        "three_mistakes": three_mistakes(),
    }
    for name, text in texts.items():
        write_if_new(folder / f"{name}.md", text)
    draw_house(WHOLE, folder / "house.svg")
    draw_house(MECHANICS, folder / "mechanics.svg")
    draw_profiles(folder)
    draw_best_and_worst(ROOT, folder / "best_and_worst.svg")
    report = folder / "example" / "report_figure3.html"
    report.parent.mkdir(exist_ok=True)
    report.write_text(page(open_results(ROOT / "results" / "figure3.nc"), "figure3"), encoding="utf-8")
    shutil.copy2(ROOT / "studies" / "explore.ipynb", folder / "explore.ipynb")


def write_if_new(path: Path, text: str) -> None:
    """Leave a file with the same text alone, so that Sphinx builds only what changed."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
