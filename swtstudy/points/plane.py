"""Plane contacts have forces alone prescribed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from swtstudy.points.values import values_taken
from swtstudy.vocabulary.families import is_plane
from swtstudy.vocabulary.mistakes import Report
from swtstudy.vocabulary.prescribed import PAIRS


def check_forces(given: Iterable[str], good: Mapping[str, Sequence[Any]], report: Report) -> None:
    """Displacements have no meaning in the plane, and they are what is not given as a force.

    Parameters
    ----------
    given
        Names of all parameters that are given, soundly or not.
    good
        Sound values.
    """
    plane = [str(profile) for profile in values_taken("profile", good) if is_plane(profile)]
    names = set(given)
    wanted = [force for force in PAIRS if force not in names]
    if not plane or not wanted:
        return
    instead = [PAIRS[force] for force in wanted if PAIRS[force] in names]
    found = "a displacement" if instead else "nothing"
    why = "depths and displacements of a plane contact have no meaning, only forces have"
    allowed = f"{' and '.join(wanted)}: {why}"
    report.of(instead or wanted, f"{found} with the profile {', '.join(plane)}", allowed)
