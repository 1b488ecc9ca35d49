"""Folders of the project that tests read from or start programs in."""

from pathlib import Path

TESTS = Path(__file__).parent
DATA = TESTS / "data"
ROOT = TESTS.parent
RESULTS = ROOT / "results"
STUDIES = ROOT / "studies"
