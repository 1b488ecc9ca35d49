"""A report of mistakes: it adds what it is told, and refuses them all at once."""

from __future__ import annotations

import pytest

from swtstudy.vocabulary.mistakes import Mistake, Report, StudyError

ONE = Mistake("x", "1", "2")


def test_a_report_knows_the_source_and_the_keys_of_parameters() -> None:
    report = Report("a.toml", lambda name: f"fixed.{name}")
    report("title", "nothing", "a text")
    report.of("phase", "1", "2")
    report.of(("radius", "depth"), "both", "one of the two")
    assert [str(mistake) for mistake in report] == [
        "a.toml: title: found nothing; allowed: a text",
        "a.toml: fixed.phase: found 1; allowed: 2",
        "a.toml: fixed.radius, fixed.depth: found both; allowed: one of the two",
    ]


def test_a_report_takes_mistakes_and_nothing_else() -> None:
    report = Report()
    report.refuse()  # nothing is wrong
    with report:
        raise StudyError([ONE])
    assert report == [ONE]
    with pytest.raises(KeyError), report:
        raise KeyError("x")
    with pytest.raises(StudyError) as caught:
        report.refuse()
    assert caught.value.mistakes == (ONE,)
