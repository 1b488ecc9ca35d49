"""Plane contacts with units: their loads are per length, unless their length is given."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from swtstudy.units.labels import Units
from swtstudy.vocabulary.families import is_plane
from swtstudy.vocabulary.mistakes import Report

#: The length of a plane contact along its axis.
LENGTH = "contact_length"


@dataclass(frozen=True)
class LineUnits(Units):
    """Labels where forces, and work, are per length."""

    def label(self, kind: str) -> str:
        if kind == "force" and self.force:
            return f"{self.force}/{self.length}"
        return self.force if kind == "work" else super().label(kind)


def labels_of(units: Units, profiles: Iterable[object], given: Collection[str]) -> Units:
    """The labels of a study with these profiles, in which parameters of some names are given."""
    if LENGTH in given or not any(map(is_plane, profiles)):
        return units
    return LineUnits(**vars(units))


def check_lengths(profiles: Iterable[object], given: Collection[str], report: Report) -> None:
    """A depth of plane contacts, a length where none has one, and none where loads need it."""
    plane = [is_plane(profile) for profile in profiles]
    if any(plane) and "depth" in given:
        why = "a plane contact has no depth, only a load"
        report.of("depth", "a depth with a plane profile", f"normal_force: {why}")
    if LENGTH in given and not any(plane):
        report.of(LENGTH, "a length without a plane profile", "only with profiles such as cylinder")
    if any(plane) and not all(plane) and LENGTH not in given:
        allowed = "the length of the plane contacts: beside axisymmetric ones their loads are forces"
        report.of(LENGTH, "nothing", allowed)


def still_load(profiles: Iterable[object], given: Collection[str]) -> dict[str, float]:
    """A constant normal load of plane contacts, unless something is said of it."""
    silent = not {"normal_amplitude", "normal_force_amplitude"} & {*given}
    return {"normal_force_amplitude": 0.0} if silent and any(map(is_plane, profiles)) else {}
