"""The studies that `swtstudy new` begins with: every parameter, what it is and what is allowed."""

from collections.abc import Callable

import pytest
from folders import DATA

from swtstudy import Study
from swtstudy.study.template import template, template_with_units


@pytest.mark.parametrize(
    ("made", "name"), [(template, "template.toml"), (template_with_units, "template_with_units.toml")]
)
def test_a_template_is_the_kept_one(made: Callable[[str], str], name: str) -> None:
    """Where words of parameters have changed the kept one is to be written anew."""
    text = made("A study")
    assert text == (DATA / name).read_text(encoding="utf-8")
    assert Study.from_text(text).title == "A study"
    assert made('"') == text.replace('"A study"', r'"\""')
