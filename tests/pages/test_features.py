"""The list of features names tests that exist."""

import re

import pytest
from folders import TESTS

LINES = re.findall(r"^(\d+)\. (.+)$", (TESTS / "features.md").read_text(encoding="utf-8"), re.MULTILINE)


def test_there_are_45_of_them() -> None:
    assert [int(number) for number, _ in LINES] == list(range(1, 46))


@pytest.mark.parametrize(("number", "line"), LINES, ids=lambda value: value[:12])
def test_each_has_a_test(number: str, line: str) -> None:
    files = re.findall(r"`([\w/]+\.py)`", line)
    assert files, f"feature {number} has no test"
    for file in files:
        assert re.search(r"^def test_", (TESTS / file).read_text(encoding="utf-8"), re.MULTILINE), file
