"""Names whose numbers stand in tables of points: every table has them in one order."""

from __future__ import annotations

from swtstudy.archive.parts import _LAYOUT
from swtstudy.kernel.criterion import NAMES
from swtstudy.vocabulary.choices import CRITERIA


def test_each_table_of_criteria_has_the_same_ones_in_the_same_order() -> None:
    assert list(CRITERIA) == list(NAMES) == _LAYOUT["criteria"]
