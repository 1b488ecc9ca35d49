"""What a study with three mistakes is told."""

from swtstudy.study.definition import Study
from swtstudy.study.template import template
from swtstudy.vocabulary.mistakes import StudyError

_SLIPS = {
    "normal_amplitude = [": "normal_amplitud = [",
    '= "paraboloid"': '= "parabola"',
    "num = 49": "num = 1",
}


def three_mistakes() -> str:
    """The lines that are wrong, and the messages."""
    text = template("mine")
    for right, wrong in _SLIPS.items():
        text = text.replace(right, wrong, 1)
    lines = [line for line in text.splitlines() if any(wrong in line for wrong in _SLIPS.values())]
    try:
        Study.from_text(text, "mine.toml")
    except StudyError as error:
        return "```toml\n" + "\n".join(lines) + f"\n```\n\n```text\n{error}\n```\n"
    raise ValueError("the study has no mistakes")
