"""Folders of the project that tests read from or start programs in."""

from pathlib import Path

TESTS = Path(__file__).parent
DATA = TESTS / "data"
ROOT = TESTS.parent
RESULTS = ROOT / "results"
STUDIES = ROOT / "studies"


def sections(name: str) -> dict[str, str]:
    """The texts beneath the headings of a file of texts, which begin with #."""
    parts = (DATA / name).read_text(encoding="utf-8").split("\n# ")
    return dict(part.split("\n", 1) for part in parts[1:])
