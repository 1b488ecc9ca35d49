"""The studies that `swtstudy new` begins with: every parameter, what it is and what is allowed."""

import pytest
from folders import DATA
from kept import Kept

from swtstudy import Study
from swtstudy.study.template import template


@pytest.mark.parametrize("with_units", [False, True])
def test_a_template_is_the_kept_one(kept: Kept, with_units: bool) -> None:
    text = template("A study", with_units)
    path = DATA / ("template_with_units.toml" if with_units else "template.toml")
    kept.text(path, path.read_text(encoding="utf-8"), text)
    assert Study.from_text(text).title == "A study"
    assert template('"', with_units) == text.replace('"A study"', r'"\""')
