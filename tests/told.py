"""What tests of several rooms ask of studies and archives as a user does: by calls, files and commands."""

import re
import textwrap
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import stand_in
from command import merged

from swtstudy import Study, StudyError, run

#: A sphere of aluminium on its like, in newtons and millimetres; its loads are to follow.
RIG: dict[str, Any] = {"young_modulus": 73.1e3, "poisson_ratio": 0.33, "radius": 50.0, "friction": 0.5}


def refused(words: str, function: Callable[..., Any], *arguments: Any, **given: Any) -> StudyError:
    """The error with which a call is refused, in which the words are found; any without words."""
    with pytest.raises(StudyError, match=words or None) as caught:
        function(*arguments, **given)
    return caught.value


def written(study: Study, folder: Path) -> Study:
    """The study that an archive of it keeps when it is merged."""
    run(study, folder / "kept.nc", workers=1, solver=stand_in.smooth)
    return Study.from_text(merged(folder / "kept.nc").attrs["study"])


def warned(function: Callable[..., Any], *arguments: Any, **given: Any) -> tuple[Any, list[str]]:
    """The value of a call, and its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = function(*arguments, **given)
    return found, [str(each.message) for each in caught]


def sayings(text: str) -> list[tuple[str, list[str]]]:
    """Expressions of Python, and what each gives, by lines.

    It stands behind a », in the line of the expression or below it; lines that are set in go on. Lines that
    begin with # say what the expressions below are there for.
    """
    found: list[tuple[str, list[str]]] = []
    for line in re.sub(r"\n    ", " ", text).strip("\n").splitlines():
        if line.startswith("#"):
            continue
        expression, *said = f" {line}".split(" » ")
        if expression:
            found.append((expression.strip(), []))
        found[-1][1].extend(said)
    return found


def set_in(lines: list[str]) -> str:
    """Lines as a file of texts has them: what is longer than a line goes on set in."""
    style = {"subsequent_indent": "  ", "break_long_words": False, "break_on_hyphens": False}
    return "\n".join(textwrap.fill(line, 110, **style) for line in lines)  # type: ignore[arg-type]


def lines_of(found: object) -> list[str]:
    """A text by lines, and other values as Python shows them."""
    return found.split("\n") if isinstance(found, str) and found else [repr(found)]
