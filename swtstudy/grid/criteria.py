"""What goes with which criterion."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from swtstudy.criteria import FATEMI_SOCIE, FINDLEY, SHARP, SWT
from swtstudy.mistakes import Report
from swtstudy.quantities import DISTANCE


def check_criteria(
    given: Iterable[str],
    fixed: Mapping[str, Any],
    along: Mapping[str, Sequence[Any]],
    keys: Callable[[str], str],
    report: Report,
) -> None:
    """Parameters that the criteria need or do not have, and profiles that they do not allow.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    fixed, along
        Sound values.
    """
    names, criteria = set(given), [*along.get("criterion", (fixed.get("criterion", SWT),))]
    others = [name for name in dict.fromkeys(criteria) if name != SWT]
    if not others:
        if "normal_sensitivity" in names:
            found = "a value with the criterion swt"
            report(keys("normal_sensitivity"), found, f"it with {FATEMI_SOCIE} or {FINDLEY}")
        return
    if "normal_sensitivity" not in names:
        report(keys("normal_sensitivity"), "nothing", f"a number ≥ 0 with the criterion {', '.join(others)}")
    if "walker_exponent" in names:
        found = f"a value with the criterion {', '.join(others)}"
        report(keys("walker_exponent"), found, f"it with {SWT} alone")
    if DISTANCE in names:
        found = f"a value with the criterion {', '.join(others)}"
        report(keys(DISTANCE), found, f"it with {SWT} alone: means of others are not computed")
    profiles = map(str, along.get("profile", (fixed.get("profile"),)))
    if SHARP in profiles:
        why = "next to its edge the stress has no bound, and where these are finite is not known"
        report(keys("profile"), f"{SHARP} with the criterion {', '.join(others)}", f"another one: {why}")
