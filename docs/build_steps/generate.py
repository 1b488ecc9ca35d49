"""The pages and parts of pages that are made from the package, the studies and the README."""

import shutil
from pathlib import Path

from build_steps.citation import citation
from build_steps.commands import commands
from build_steps.gallery import gallery
from build_steps.house import draw_house
from build_steps.parameters import parameters
from build_steps.profiles import draw_profiles
from build_steps.rooms import MECHANICS, WHOLE, rooms
from build_steps.study_file import study_file
from build_steps.three_mistakes import three_mistakes

ROOT = Path(__file__).parent.parent.parent

#: Sections of the README that are shown in pages, by the file that they go to.
_SECTIONS = {
    "readme_start": "Two commands",
    "readme_ten_lines": "Ten lines",
    "readme_studies": "Studies and figures",
    "readme_physical": "Physical units",
    "readme_long_runs": "Studies that run long",
    "readme_accuracy": "How fast and how accurate",
    "readme_field": "The field beneath the contact",
    "readme_line": "Where the surface line is enough",
    "readme_stability": "Stable where methods fail",
    "readme_limits": "Honest limits",
}

#: Files to which the README links, by the page that shows them.
_PAGES = {
    "docs/index.md": "index.md",
    "docs/theory/face_edge.md": "theory/face_edge.md",
    "results/accuracy.md": "accuracy.md",
    "results/accuracy_speed.md": "accuracy.md",
    "results/audit_parameter_box.md": "accuracy.md",
    "results/field_speed.md": "accuracy.md",
    "results/scaling.md": "accuracy.md",
    "results/statements.md": "statements.md",
    "studies/explore.ipynb": "generated/explore.ipynb",
}


def generate(folder: Path) -> None:
    """Write everything into ``folder``."""
    folder.mkdir(exist_ok=True)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    texts = {name: section(readme, title) for name, title in _SECTIONS.items()}
    texts |= {
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
    shutil.copy2(ROOT / "studies" / "explore.ipynb", folder / "explore.ipynb")


def section(readme: str, title: str) -> str:
    """A section without its heading, its links as seen from the pages."""
    _, found, rest = readme.partition(f"\n## {title}\n")
    if not found:
        raise ValueError(f"README.md has no section {title!r}")
    body = rest.partition("\n## ")[0]
    for file, page in _PAGES.items():
        body = body.replace(f"]({file})", f"]({page})")
    for folder in ("results", "studies"):
        body = body.replace(f"]({folder}/", f"](../{folder}/")
    return body.strip() + "\n"


def write_if_new(path: Path, text: str) -> None:
    """Leave a file with the same text alone, so that Sphinx builds only what changed."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
