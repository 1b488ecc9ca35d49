"""Rules on what a criterion can be combined with."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from swtstudy.points.values import values_taken
from swtstudy.vocabulary.criteria import FATEMI_SOCIE, FINDLEY, SHARP, SWT
from swtstudy.vocabulary.mistakes import Report
from swtstudy.vocabulary.parameters import PARAMETERS


def check_criteria(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Parameters that the criteria need or do not have, and profiles that they do not allow.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """

    def values(name: str) -> Sequence[Any]:
        return values_taken(name, good)

    names, others = {*given}, [name for name in dict.fromkeys(values("criterion")) if name != SWT]
    if not others:
        if any(values("normal_sensitivity")):
            found = f"a value with the criterion {SWT}"
            report.of("normal_sensitivity", found, f"a value with {FATEMI_SOCIE} or {FINDLEY} only")
        return
    criteria = f"with the criterion {', '.join(others)}"
    if "normal_sensitivity" not in names:
        report.of("normal_sensitivity", "nothing", f"a number ≥ 0 {criteria}")
    if any(value != PARAMETERS["walker_exponent"].default for value in values("walker_exponent")):
        report.of("walker_exponent", f"a value {criteria}", f"a value with {SWT} only")
    if SHARP in map(str, values("profile")):
        why = "where slip reverses at its sharp edge, the amplitude of the shear stress has no bound"
        report.of("profile", f"{SHARP} {criteria}", f"another profile: {why}")
